/* words.h - looks and lamps of elsewhere.h by their program's name, as text:

       vtk(specular=.5, power=30)    or    vtk(specular=.5 power=30)

   Numbers that are not named have the program's defaults.  A colour is three numbers with commas,
   or one number for all three. */
#ifndef ELSEWHERE_WORDS_H
#define ELSEWHERE_WORDS_H

#include "elsewhere.h"
#include <stdio.h>
#include <stdlib.h>

/* A program as words name it: numbers holds the names of its struct's fields, in order, with the
   program's defaults.  It makes a look or a lamp. */
typedef struct elsewhere_row {
    const char *name, *numbers;
    void (*look)(const float *numbers, elsewhere_look *out);
    void (*lamp)(const float *numbers, elsewhere_lamp *out);
} elsewhere_row;

#define ELSEWHERE_ROW(program, result)                                                             \
    static inline void elsewhere_row_##program(const float *numbers, elsewhere_##result *out)      \
    {                                                                                              \
        elsewhere_##program##_numbers v;                                                           \
        memcpy(&v, numbers, sizeof v);                                                             \
        *out = elsewhere_##program(v);                                                             \
    }
ELSEWHERE_ROW(vtk, look)
ELSEWHERE_ROW(povray, look)
ELSEWHERE_ROW(opengl_lamp, lamp)
ELSEWHERE_ROW(vtk_lamp, lamp)
ELSEWHERE_ROW(povray_lamp, lamp)
ELSEWHERE_ROW(three_phong, look)
ELSEWHERE_ROW(three_mtl, look)
ELSEWHERE_ROW(three_lambert, look)
ELSEWHERE_ROW(three_toon, look)
ELSEWHERE_ROW(babylon, look)
ELSEWHERE_ROW(x_ite, look)
ELSEWHERE_ROW(x3dom, look)
ELSEWHERE_ROW(view3dscene, look)
ELSEWHERE_ROW(three_lamp, lamp)
ELSEWHERE_ROW(babylon_lamp, lamp)
ELSEWHERE_ROW(x3d_lamp, lamp)
ELSEWHERE_ROW(p5, look)
ELSEWHERE_ROW(xeokit, look)
ELSEWHERE_ROW(p5_lamp, lamp)
ELSEWHERE_ROW(vtkjs, look)
ELSEWHERE_ROW(vtkjs_lamp, lamp)
ELSEWHERE_ROW(tachyon, look)
ELSEWHERE_ROW(raster3d, look)
ELSEWHERE_ROW(pymol, look)
ELSEWHERE_ROW(tachyon_lamp, lamp)
ELSEWHERE_ROW(gnuplot, look)
ELSEWHERE_ROW(mplot3d, look)
ELSEWHERE_ROW(surfl, look)
ELSEWHERE_ROW(gdal, look)
ELSEWHERE_ROW(opengl, look)
ELSEWHERE_ROW(inventor, look)
ELSEWHERE_ROW(mtl, look)
ELSEWHERE_ROW(irrlicht, look)
ELSEWHERE_ROW(mathgl, look)
ELSEWHERE_ROW(seen, look)
ELSEWHERE_ROW(inventor_lamp, lamp)
ELSEWHERE_ROW(osg, look)
ELSEWHERE_ROW(deck, look)
ELSEWHERE_ROW(processing, look)
ELSEWHERE_ROW(processing_lamp, lamp)
ELSEWHERE_ROW(playcanvas, look)
ELSEWHERE_ROW(rasmol, look)
ELSEWHERE_ROW(jmol, look)

static const elsewhere_row elsewhere_rows[] = {
    { "vtk", "color=1,1,1 specular_color=1,1,1 ambient=0 diffuse=1 specular=0 power=1",
      elsewhere_row_vtk, NULL },
    { "povray",
      "color=0,0,0 ambient=.1 diffuse=.6 phong=0 phong_size=40 specular=0 roughness=.05 "
      "brilliance=1 albedo=0",
      elsewhere_row_povray, NULL },
    { "lamp",
      "at=0,0,1,0 color=1,1,1 ambient=0,0,0 attenuation=1,0,0 aim=0,0,0 cutoff=180 exponent=0",
      NULL, elsewhere_row_opengl_lamp },
    { "vtk_lamp", "at=0,0,1,0 color=1,1,1 aim=0,0,0 cone=30 exponent=1 attenuation=1,0,0", NULL,
      elsewhere_row_vtk_lamp },
    { "povray_lamp",
      "at=0,0,1,0 color=1,1,1 aim=0,0,0 fade_distance=0 fade_power=0 radius=0 falloff=0 "
      "tightness=0 shadowless=0",
      NULL, elsewhere_row_povray_lamp },
    { "three_phong", "color=1,1,1 specular=.0056,.0056,.0056 emissive=0,0,0 shininess=30",
      elsewhere_row_three_phong, NULL },
    { "three_mtl", "Kd=1,1,1 Ks=.0667,.0667,.0667 Ke=0,0,0 Ns=30 illum=2", elsewhere_row_three_mtl,
      NULL },
    { "three_lambert", "color=1,1,1 emissive=0,0,0", elsewhere_row_three_lambert, NULL },
    { "three_toon", "color=1,1,1 emissive=0,0,0", elsewhere_row_three_toon, NULL },
    { "babylon", "diffuse=1,1,1 specular=1,1,1 ambient=0,0,0 emissive=0,0,0 power=64",
      elsewhere_row_babylon, NULL },
    { "x_ite", "diffuseColor=.8,.8,.8 specularColor=0,0,0 emissiveColor=0,0,0 shininess=.2",
      elsewhere_row_x_ite, NULL },
    { "x3dom", "diffuseColor=.8,.8,.8 specularColor=0,0,0 emissiveColor=0,0,0 shininess=.2",
      elsewhere_row_x3dom, NULL },
    { "view3dscene", "diffuseColor=.8,.8,.8 specularColor=0,0,0 emissiveColor=0,0,0 shininess=.2",
      elsewhere_row_view3dscene, NULL },
    { "three_lamp",
      "at=0,0,1,0 color=1,1,1 aim=0,0,0 intensity=1 distance=0 decay=2 angle=1.0471976 "
      "penumbra=0",
      NULL, elsewhere_row_three_lamp },
    { "babylon_lamp", "at=0,0,1,0 color=1,1,1 aim=0,0,0 range=0 angle=3.1415927 exponent=0", NULL,
      elsewhere_row_babylon_lamp },
    { "x3d_lamp",
      "at=0,0,1,0 color=1,1,1 attenuation=1,0,0 aim=0,0,0 intensity=1 radius=100 "
      "beamWidth=.7853982 cutOffAngle=1.5707963",
      NULL, elsewhere_row_x3d_lamp },
    { "p5", "fill=1,1,1 specular=0,0,0 emissive=0,0,0 shininess=1", elsewhere_row_p5, NULL },
    { "xeokit", "diffuse=1,1,1 specular=1,1,1 emissive=0,0,0 shininess=80", elsewhere_row_xeokit,
      NULL },
    { "p5_lamp",
      "at=0,0,1,0 color=1,1,1 attenuation=1,0,0 aim=0,0,0 angle=1.0471976 concentration=100", NULL,
      elsewhere_row_p5_lamp },
    { "vtkjs", "color=1,1,1 specular_color=1,1,1 ambient=0 diffuse=1 specular=0 power=1",
      elsewhere_row_vtkjs, NULL },
    { "vtkjs_lamp", "at=0,0,1,0 color=1,1,1 aim=0,0,0 cone=30 exponent=1 attenuation=1,0,0", NULL,
      elsewhere_row_vtkjs_lamp },
    { "tachyon", "color=1,1,1 ambient=0 diffuse=1 phong=0 phong_size=40 shade_phong=0",
      elsewhere_row_tachyon, NULL },
    { "raster3d", "color=1,1,1 phong=25 straight=.15 ambient=.05 specular=.25",
      elsewhere_row_raster3d, NULL },
    { "pymol", "color=1,1,1 ambient=.14 direct=.45 reflect=.45 specular_intensity=.5 shininess=55",
      elsewhere_row_pymol, NULL },
    { "tachyon_lamp", "at=0,0,1,0 color=1,1,1 attenuation=1,0,0 aim=0,0,0 start=20 end=40", NULL,
      elsewhere_row_tachyon_lamp },
    { "gnuplot", "color=1,1,1 primary=.5 specular=0", elsewhere_row_gnuplot, NULL },
    { "mplot3d", "color=1,1,1 azdeg=225 altdeg=19.4712", elsewhere_row_mplot3d, NULL },
    { "gdal", "azimuth=315 altitude=45", elsewhere_row_gdal, NULL },
    { "surfl", "ambient=.55 diffuse=.6 specular=.4 shine=10", elsewhere_row_surfl, NULL },
    { "opengl",
      "ambient=.2,.2,.2 diffuse=.8,.8,.8 specular=0,0,0 emission=0,0,0 shininess=0 "
      "local_viewer=0",
      elsewhere_row_opengl, NULL },
    { "inventor",
      "ambientColor=.2,.2,.2 diffuseColor=.8,.8,.8 specularColor=0,0,0 emissiveColor=0,0,0 "
      "shininess=.2",
      elsewhere_row_inventor, NULL },
    { "mtl", "Ka=0,0,0 Kd=.8,.8,.8 Ks=0,0,0 Ke=0,0,0 Ns=0 illum=2", elsewhere_row_mtl, NULL },
    { "irrlicht", "DiffuseColor=1,1,1 EmissiveColor=0,0,0", elsewhere_row_irrlicht, NULL },
    { "mathgl", "color=1,1,1 ambient=.5", elsewhere_row_mathgl, NULL },
    { "inventor_lamp",
      "at=0,0,1,0 color=1,1,1 attenuation=1,0,0 aim=0,0,0 cutOffAngle=.7853982 dropOffRate=0", NULL,
      elsewhere_row_inventor_lamp },
    { "osg", "ambient=.2,.2,.2 diffuse=.8,.8,.8 specular=0,0,0 emission=0,0,0 shininess=0",
      elsewhere_row_osg, NULL },
    { "deck", "color=0,0,0 specularColor=.15,.15,.15 ambient=.35 diffuse=.6 shininess=32",
      elsewhere_row_deck, NULL },
    { "processing", "fill=1,1,1 ambient=.5,.5,.5 specular=.5,.5,.5 emissive=0,0,0 shininess=1",
      elsewhere_row_processing, NULL },
    { "processing_lamp",
      "at=0,0,1,0 color=1,1,1 attenuation=1,0,0 aim=0,0,0 angle=1.0471976 concentration=100", NULL,
      elsewhere_row_processing_lamp },
    { "playcanvas", "diffuse=1,1,1 specular=0,0,0 emissive=0,0,0 gloss=.25",
      elsewhere_row_playcanvas, NULL },
    { "rasmol", "color=1,1,1 ambient=40 specular=0 specpower=10", elsewhere_row_rasmol, NULL },
    { "jmol", "color=1,1,1 ambientPercent=45 diffusePercent=84 specularPercent=22 phongExponent=64",
      elsewhere_row_jmol, NULL },
    { "seen", "color=.5,.5,.5 specularColor=1,1,1 specularExponent=15", elsewhere_row_seen, NULL },
    { NULL, NULL, NULL, NULL }
};

enum { ELSEWHERE_NUMBERS = 40 }; /* floats of the largest struct, with room */

/* Numbers with commas at *text, which moves behind them: how many, at most most; -1 where one is
   none */
static inline int elsewhere_take_numbers(const char **text, float *out, int most)
{
    for (int n = 0; n < most;) {
        char *end;
        const size_t decimal = strspn(*text, "+-.0123456789eE");
        const double value = strtod(*text, &end);
        if (end == *text || (size_t)(end - *text) > decimal || !(value > -1e30 && value < 1e30))
            return -1;
        out[n++] = (float)value;
        *text = end;
        if (**text != ',' || !strspn(*text + 1, "+-.0123456789")) return n;
        ++*text;
    }
    return -1;
}

/* Fills numbers with the defaults of a row.  Where name is not NULL, also finds where its own
   begin, and how many they are: 0 for an unknown name. */
static inline int elsewhere_defaults(const elsewhere_row *row, const char *name, size_t length,
                                     float *numbers, int *first)
{
    int at = 0, found = 0;
    for (const char *t = row->numbers; *t; t += *t == ' ') {
        const char *word = t;
        int n;
        t += strcspn(t, "=");
        if (name && (size_t)(t - word) == length && !memcmp(word, name, length)) *first = at;
        found |= name && (size_t)(t - word) == length && !memcmp(word, name, length) ? at + 1 : 0;
        t++;
        n = elsewhere_take_numbers(&t, numbers + at, 4);
        if (found == at + 1) found = -n;
        at += n;
    }
    return found < 0 ? -found : 0;
}

/* The row of a name that makes a look, or a lamp; NULL: none does */
static inline const elsewhere_row *elsewhere_row_of(const char *name, size_t length, int lamp)
{
    for (const elsewhere_row *row = elsewhere_rows; row->name; row++) {
        const int makes = lamp ? row->lamp != NULL : row->look != NULL;
        if (makes && strlen(row->name) == length && !memcmp(row->name, name, length)) return row;
    }
    return NULL;
}

/* Reads name=value at *text, which moves behind it, into the row's numbers.  Returns 0, or 1 with a
   sentence in said. */
static inline int elsewhere_read_number(const elsewhere_row *row, const char **text, float *numbers,
                                        char *said, size_t room)
{
    const char *name = *text;
    const size_t n = strcspn(name, "= ,)");
    float value[ELSEWHERE_NUMBERS];
    int first = 0, got;
    const int count = elsewhere_defaults(row, name, n, value, &first);
    if (!count || name[n] != '=') {
        snprintf(said, room, "%s has no number %.*s; it has %s", row->name, (int)(n < 40 ? n : 40),
                 name, row->numbers);
        return 1;
    }
    *text = name + n + 1;
    got = elsewhere_take_numbers(text, value, 4);
    if (got != count && got != 1) {
        snprintf(said, room, "%s: %.*s takes %d number%s", row->name, (int)n, name, count,
                 count > 1 ? "s, or one for all" : "");
        return 1;
    }
    for (int k = 0; k < count; k++) numbers[first + k] = value[got == 1 ? 0 : k];
    return 0;
}

/* Reads NAME or NAME(number=value, ...) at *text, which moves behind it, into look or lamp, of
   which one is NULL.  Returns 0, or 1 with a sentence in said. */
static inline int elsewhere_read(const char **text, elsewhere_look *look, elsewhere_lamp *lamp,
                                 char *said, size_t room)
{
    const char *t = *text;
    const size_t length = strcspn(t, "( ");
    const elsewhere_row *row = elsewhere_row_of(t, length, lamp != NULL);
    float numbers[ELSEWHERE_NUMBERS];
    if (!row) {
        snprintf(said, room, "no program is named %.*s", (int)(length < 40 ? length : 40), t);
        return 1;
    }
    elsewhere_defaults(row, NULL, 0, numbers, NULL);
    t += length;
    if (*t == '(') {
        for (t += 1 + strspn(t + 1, " ,"); *t != ')'; t += strspn(t, " ,"))
            if (elsewhere_read_number(row, &t, numbers, said, room)) return 1;
        t++;
    }
    if (look) row->look(numbers, look);
    if (lamp) row->lamp(numbers, lamp);
    *text = t;
    return 0;
}
/* What a scene with lamps and a camera of its own can say of a look: its material, model and flags.
   Lamps of intensity 1 stand for those that give the program's colour; F of ELSEWHERE_LAW_SCHLICK
   is that of light from the viewer; encoding and viewer stay the scene's.  Returns NULL, or what it
   cannot say. */
static inline const char *elsewhere_apply(const elsewhere_look *k, shade_material *material,
                                          shade_model *kind, unsigned *flags)
{
    const float d = k->diffuse + k->head_diffuse, s = k->specular + k->head_specular;
    if (k->refused) return k->refused;
    if (k->law != ELSEWHERE_LAW_FOUR && k->law != ELSEWHERE_LAW_SCHLICK)
        return "its law of light is not iteration four: elsewhere_fragment draws it";
    *material = k->material;
    if (d < s || d > s) {
        material->diffuse = shade_scale(material->diffuse, d);
        material->specular = shade_scale(material->specular, s);
    }
    if (k->law == ELSEWHERE_LAW_SCHLICK)
        material->specular = shade_scale(material->specular, k->number);
    *kind = k->model;
    *flags = k->flags & ~(unsigned)SHADE_FLAG_TWO_SIDED;
    return NULL;
}

/* The same for text such as "vtk(specular=.5, power=30)".  Returns 0, or 1 with a sentence in
   said. */
static inline int elsewhere_apply_text(const char *text, shade_material *material,
                                       shade_model *kind, unsigned *flags, char *said, size_t room)
{
    elsewhere_look look;
    const char *why;
    if (elsewhere_read(&text, &look, NULL, said, room)) return 1;
    why = *text ? "something stands behind it" : elsewhere_apply(&look, material, kind, flags);
    if (why) snprintf(said, room, "%s", why);
    return why != NULL;
}
#endif
