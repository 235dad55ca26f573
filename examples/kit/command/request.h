/* request.h - how a model is read and lit: the options that all programs with a model have, in the
   same words, with the same ranges and defaults. */
#ifndef MODEL_REQUEST_H
#define MODEL_REQUEST_H

#include "options.h"
#include "../../elsewhere/words.h"

#define MODEL_USAGE                                                                                \
    "  --color COLOR         one colour for all surfaces, instead of the file's materials:\n"      \
    "                        RRGGBB, #RGB or a name\n"                                             \
    "  --material NAME       one material for all surfaces: clay, or a name that\n"                \
    "                        --material list prints, or another program's numbers, as in\n"        \
    "                        'vtk(color=1,.5,.2, specular=.8, power=30)'\n"                        \
    "  --model NAME          phong, blinn-phong, lambert, ambient, emissive, cool-to-warm\n"       \
    "                        (blinn-phong)\n"                                                      \
    "  --shading NAME        fragment, vertex, face (fragment)\n"                                  \
    "  --up x|y|z|-x|-y|-z   the model's upright axis (what the format says, or a guess: y, for\n" \
    "                        STL z, or that of the feet it stands on)\n"                           \
    "  --view VIEW           from where it is seen: front, right, back, left, top, bottom, iso,\n" \
    "                        or degrees AZIMUTH,ELEVATION or AZIMUTH,ELEVATION,ZOOM; azimuth\n"    \
    "                        -36000 .. 36000, 90: right; elevation -90 .. 90; zoom 0.05 .. 20\n"   \
    "  --section AXIS[=N]    x, y or z: cuts the model open across that axis of the file, at N\n"  \
    "                        or in its middle, on the viewer's side, and hatches the cut\n"        \
    "  --quick               light without shadows among parts, in a part of the time\n"           \
    "  --no-shadow           no shadow on the ground\n"                                            \
    "  --threads N           1 .. 256 (one a core); the picture is the same\n"                     \
    "  --max-triangles N     refuses larger models, 0 .. 700000000 (20000000; 0: no limit)\n"      \
    "  --max-memory N        megabytes, 32 .. 1000000, that the program may ask for (a quarter\n"  \
    "                        of what is free, 1000 at least)\n"                                    \
    "  --outside             reads pictures outside of the model's folder, too\n"                  \
    "  --quiet               prints errors only, no progress and no warnings\n"                    \
    "  --verbose             says which axis was guessed to be upright\n"

/* The side that the first picture of every program shows: the model has turned so far, and the eye
   is so far above it, beside its distance along the ground */
#define MODEL_FIRST_TURN 30 /* degrees */
#define MODEL_FIRST_RISE 0.36f

/* After all options: what is read, as this program is built */
#ifdef MODEL_ASSIMP
#define MODEL_FORMATS                                                                              \
    "formats: OBJ with MTL, STL, PLY, OFF, glTF, GLB, 3MF; by assimp FBX, 3DS, DAE, LWO and "      \
    "more\n"
#else
#define MODEL_FORMATS "formats: OBJ with MTL, STL, PLY, OFF, glTF, GLB, 3MF\n"
#endif

typedef struct model_options {
    int up;                                 /* 0 .. 5 for x y z -x -y -z; -1: by the file */
    int threads, max_triangles, max_memory; /* threads 0: all cores */
    int quiet, verbose;
    int no_lines;                /* lines of the model are left out */
    int outside;                 /* pictures outside of the model's folder are read */
    int plain, no_shadow;        /* plain: one material instead of the file's */
    int quick;                   /* no maps of shadows are drawn */
    int viewed;                  /* the view is said: */
    int section, section_placed; /* section: 0 none, 1 .. 3 across x, y, z; placed: at */
    double section_at;
    float azimuth, elevation, zoom; /* radians: 0 sees the front, a right angle the right side */
    shade_material material;
    shade_model model;
    shade_shading shading;
} model_options;

/* ---- names ----------------------------------------------------------------------------------- */

/* 1: the names are equal.  Capitals equal small letters, dashes and underlines equal spaces. */
static inline int same_name(const char *a, const char *b)
{
    for (;; a++, b++) {
        int x = *a == '-' || *a == '_' ? ' ' : *a, y = *b == '-' || *b == '_' ? ' ' : *b;
        if (x >= 'A' && x <= 'Z') x += 'a' - 'A';
        if (x != y) return 0;
        if (!x) return 1;
    }
}

/* The index of a name in a list of n, or -1 */
static inline int find_name(const char *name, const char *const *list, int n)
{
    for (int i = 0; i < n; i++)
        if (same_name(name, list[i])) return i;
    return -1;
}

/* Reads an sRGB colour: RRGGBB or RGB, with or without #, or one of a few names. */
static inline int take_color(const char *text, shade_vec3 *out)
{
    static const char *const names[] = { "black", "white", "gray",   "grey",  "red",
                                         "green", "blue",  "yellow", "orange" };
    static const uint32_t values[] = { 0x000000, 0xFFFFFF, 0x808080, 0x808080, 0xFF0000,
                                       0x008000, 0x0000FF, 0xFFFF00, 0xFFA500 };
    int name = find_name(text, names, 9);
    uint32_t value = 0;
    size_t n = 0;
    if (name >= 0) {
        *out = shade_rgb(values[name]);
        return 1;
    }
    text += *text == '#';
    for (; n < 7 && text[n]; n++) {
        const char *digits = "0123456789abcdef", *at;
        at = strchr(digits, text[n] >= 'A' && text[n] <= 'F' ? text[n] | 32 : text[n]);
        if (!at) return 0;
        value = value << 4 | (uint32_t)(at - digits);
    }
    if (n == 3) value = (value & 0xF00) * 0x1100 | (value & 0xF0) * 0x110 | (value & 0xF) * 0x11;
    *out = shade_rgb(value);
    return n == 3 || n == 6;
}

/* A slightly glossy surface of a linear colour */
static inline shade_material gloss(shade_vec3 color)
{
    shade_material m = { { 0, 0, 0 }, color, color, { 0.10f, 0.10f, 0.10f }, 50 };
    return m;
}

static inline shade_material clay(void) { return gloss(shade_v3(0.52f, 0.45f, 0.38f)); }

/* Returns 0 where no material has that name. */
static inline int find_material(const char *name, shade_material *out)
{
    int i = 0;
    if (same_name(name, "clay")) {
        *out = clay();
        return 1;
    }
    while (i < SHADE_PRESET_COUNT && !same_name(name, shade_preset_name((shade_preset)i))) i++;
    *out = shade_linear_material(shade_preset_material((shade_preset)i));
    return i < SHADE_PRESET_COUNT;
}

static inline void list_materials(void)
{
    puts("clay");
    for (const elsewhere_row *row = elsewhere_rows; row->name; row++)
        if (row->look) puts(row->name);
    for (int m = 0; m < SHADE_PRESET_COUNT; m++) puts(shade_preset_name((shade_preset)m));
}

/* ---- options --------------------------------------------------------------------------------- */

static inline model_options model_options_new(void)
{
    model_options o = { .up = -1, .max_triangles = 20000000, .zoom = 1 };
    o.material = clay();
    return o;
}

static inline int model_take_color(void *to, const char *value)
{
    model_options *o = (model_options *)to;
    o->plain = 1;
    o->material = clay();
    if (!take_color(value, &o->material.diffuse)) return OPTION_BAD;
    o->material.ambient = o->material.diffuse;
    return OPTION_TAKEN;
}

static inline int model_take_material(void *to, const char *value)
{
    model_options *o = (model_options *)to;
    unsigned flags; /* the studio's lamps have their own */
    char said[400];
    if (!strcmp(value, "list")) {
        list_materials();
        return OPTIONS_ANSWERED;
    }
    o->plain = 1;
    if (find_material(value, &o->material)) return OPTION_TAKEN;
    if (!elsewhere_row_of(value, strcspn(value, "( "), 0)) return OPTION_BAD;
    if (!elsewhere_apply_text(value, &o->material, &o->model, &flags, said, sizeof said))
        return OPTION_TAKEN;
    complain("--material %s: %s", value, said);
    return OPTION_TOLD;
}

static inline int model_take_model(void *to, const char *value)
{
    model_options *o = (model_options *)to;
    static const char *const models[] = { "blinn phong", "phong",    "lambert",
                                          "ambient",     "emissive", "cool to warm" };
    int k = find_name(value, models, 6);
    o->model = (shade_model)(k < 0 ? 0 : k);
    return k >= 0;
}

static inline int model_take_shading(void *to, const char *value)
{
    model_options *o = (model_options *)to;
    static const char *const shadings[] = { "fragment", "vertex", "face" };
    int k = find_name(value, shadings, 3);
    o->shading = (shade_shading)(k < 0 ? 0 : k);
    return k >= 0;
}

/* Reads a number of lowest .. highest at *text, which moves behind it and a comma. */
static inline int view_number(const char **text, double lowest, double highest, double *out)
{
    if (!option_number(text, lowest, highest, out)) return 0;
    *text += **text == ',' && (*text)[1];
    return 1;
}

static inline int model_take_view(void *to, const char *value)
{
    model_options *o = (model_options *)to;
    static const char *const names[] = { "front", "right", "back", "left", "top", "bottom", "iso" };
    static const double angles[][2] = { { 0, 0 },  { 90, 0 },  { 180, 0 },          { 270, 0 },
                                        { 0, 90 }, { 0, -90 }, { 45, 35.264389683 } };
    const int name = find_name(value, names, 7);
    double azimuth = 0, elevation = 0, zoom = 1;
    if (name >= 0) {
        azimuth = angles[name][0];
        elevation = angles[name][1];
    } else if (!strchr(value, ',') || !view_number(&value, -36000, 36000, &azimuth) ||
               !view_number(&value, -90, 90, &elevation) ||
               (*value && !view_number(&value, 0.05, 20, &zoom)) || *value) {
        return OPTION_BAD;
    }
    o->viewed = 1;
    o->azimuth = (float)(azimuth * 0.017453292519943295);
    o->elevation = (float)(elevation * 0.017453292519943295);
    o->zoom = (float)zoom;
    return OPTION_TAKEN;
}

static inline int model_take_section(void *to, const char *value)
{
    model_options *o = (model_options *)to;
    if (*value < 'x' || *value > 'z') return OPTION_BAD;
    o->section = *value - 'x' + 1;
    o->section_placed = value[1] == '=';
    if (!value[1]) return OPTION_TAKEN;
    value += 2;
    return o->section_placed && option_number(&value, -1e30, 1e30, &o->section_at) && !*value;
}

static const option_pair model_pair[] = { { "--color", "--material", 0 }, { NULL, NULL, 0 } };
static const option model_option[] = {
    { "--color", model_take_color, 0, 0, 0 },
    { "--material", model_take_material, 0, 0, 0 },
    { "--model", model_take_model, 0, 0, 0 },
    { "--shading", model_take_shading, 0, 0, 0 },
    { "--view", model_take_view, 0, 0, 0 },
    { "--section", model_take_section, 0, 0, 0 },
    { "--up", option_axis, offsetof(model_options, up), 0, 0 },
    { "--threads", NULL, offsetof(model_options, threads), 1, 256 },
    { "--max-triangles", NULL, offsetof(model_options, max_triangles), 0, 700000000 },
    { "--max-memory", NULL, offsetof(model_options, max_memory), 32, 1000000 },
    { "--no-shadow", NULL, offsetof(model_options, no_shadow), 1, 0 },
    { "--quick", NULL, offsetof(model_options, quick), 1, 0 },
    { "--outside", NULL, offsetof(model_options, outside), 1, 0 },
    { "--quiet", NULL, offsetof(model_options, quiet), 1, 0 },
    { "--verbose", NULL, offsetof(model_options, verbose), 1, 0 },
    { NULL, NULL, 0, 0, 0 }
};
#endif
