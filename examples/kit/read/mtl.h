/* mtl.h - reads the surfaces of OBJ files from MTL: newmtl, Kd, Ks, Ke, Ns, illum, d or Tr, map_Kd,
   map_Ke, map_d, and map_Bump, bump and norm with their -bm; -o and -s of map_Kd.  Pr, with Pm,
   becomes the nearest Phong as in glTF, whatever Ks and Ns say.  Other statements are told as
   mtl_known says; surfaces that the model does not use are skipped.  The alpha of
   map_Kd counts only where map_d or d < 1 asks for it, because exporters often keep other masks
   there.  Colours are sRGB values.  Ka is ignored, because files hold anything there: k_a = k_d, as
   daylight wants it. */
#ifndef MODEL_MTL_H
#define MODEL_MTL_H

#include "known.h"

/* Of surfaces whose physics are no Phong's the nearest Phong is drawn. */
static const known_name mtl_known[] = {
    { "newmtl", KNOWN_DRAWN },  { "kd", KNOWN_DRAWN },         { "ks", KNOWN_DRAWN },
    { "ke", KNOWN_DRAWN },      { "ns", KNOWN_DRAWN },         { "d", KNOWN_DRAWN },
    { "tr", KNOWN_DRAWN },      { "map_kd", KNOWN_DRAWN },     { "map_ke", KNOWN_DRAWN },
    { "map_d", KNOWN_DRAWN },   { "map_bump", KNOWN_DRAWN },   { "bump", KNOWN_DRAWN },
    { "norm", KNOWN_DRAWN },    { "map_kn", KNOWN_DRAWN },     { "ka", KNOWN_SILENT },
    { "map_ka", KNOWN_SILENT }, { "ni", KNOWN_SILENT },        { "illum", KNOWN_DRAWN },
    { "tf", KNOWN_SILENT },     { "sharpness", KNOWN_SILENT }, { "map_aat", KNOWN_SILENT },
    { "pr", KNOWN_DRAWN },      { "pm", KNOWN_DRAWN },         { "ps", KNOWN_TOLD },
    { "pc", KNOWN_SILENT },     { "pcr", KNOWN_SILENT },       { "aniso", KNOWN_SILENT },
    { "anisor", KNOWN_SILENT }, { "map_pr", KNOWN_SILENT },    { "map_pm", KNOWN_SILENT },
    { "map_ps", KNOWN_SILENT }, { "map_pc", KNOWN_SILENT },    { "map_pcr", KNOWN_SILENT },
    { "map_ks", KNOWN_TOLD },   { "map_ns", KNOWN_TOLD },      { "map_tr", KNOWN_TOLD },
    { "map_refl", KNOWN_TOLD }, { "refl", KNOWN_TOLD },        { "disp", KNOWN_TOLD },
    { "map_disp", KNOWN_TOLD }, { "decal", KNOWN_TOLD },       { "map_decal", KNOWN_TOLD },
    { NULL, KNOWN_TOLD }
};

/* A colour: three numbers, or one number for all three, which are white at 1, or at 255 */
static inline int mtl_color(mesh_reader *r, float white, shade_vec3 *out)
{
    float v[3];
    for (int k = 0; k < 3; k++) {
        mesh_skip_blanks(r, 1);
        if (k == 1 && mesh_at_word_end(r)) {
            v[1] = v[2] = v[0];
            break;
        }
        if (mesh_take_number(r, &v[k])) return 1;
    }
    *out = shade_linear_from_srgb(shade_v3(v[0] / white, v[1] / white, v[2] / white));
    return 0;
}

/* White of a file: 1, or 255 where a surface reflects more than twice the light there is. */
static inline float mtl_white(mesh_reader r)
{
    float number, most = 0;
    r.error_size = 0;
    for (; r.at < r.end; mesh_next_line(&r, 1)) {
        mesh_skip_blanks(&r, 1);
        if (!mesh_take_word(&r, "kd")) continue;
        mesh_skip_blanks(&r, 1);
        while (!mesh_take_number(&r, &number)) {
            most = fmaxf(most, number);
            mesh_skip_blanks(&r, 1);
        }
    }
    return most > 2 ? 255 : 1;
}

static inline int mtl_number(mesh_reader *r, float lowest, float highest, float *out)
{
    mesh_skip_blanks(r, 1);
    mesh_take_word(r, "-halo");
    mesh_skip_blanks(r, 1);
    if (mesh_take_number(r, out)) return 1;
    *out = *out < lowest ? lowest : *out > highest ? highest : *out;
    return 0;
}

/* What a surface says of its transparency besides the number, and of the places of pictures other
   than map_Kd */
typedef struct mtl_clear {
    int has_kd, has_d, mapped, others; /* mapped: there is a map_d; others: another picture */
    char *map;
    float move[4];
    float white;        /* of the colours of all surfaces */
    int dull;           /* illum 1: no highlight */
    float metal, rough; /* Pm and Pr; rough below 0: not said */
} mtl_clear;
static const mtl_clear mtl_fresh = { 0, 0, 0, 0, NULL, { 0, 0, 1, 1 }, 1, 0, 0, -1 };

/* illum 0 is a colour without light.  Few readers obey it, and files have it by accident: it is
   lit, and told.  illum 1 has no highlight; the numbers above are as 2 here. */
static inline int mtl_illum(mesh_reader *r, model *m, mtl_clear *c)
{
    float number;
    if (mtl_number(r, 0, 10, &number)) return 1;
    c->dull = number == 1;
    return number < 1 ? known_take(r, m, KNOWN_TOLD, 0, "illum 0", 7) : 0;
}

/* Ps, the sheen of cloth, is told where there is any. */
static inline int mtl_sheen(mesh_reader *r, model *m)
{
    float number;
    if (mtl_number(r, 0, 1, &number)) return 1;
    return number > 0 ? known_take(r, m, KNOWN_TOLD, 0, "Ps", 2) : 0;
}

/* Options of a picture, which begin with a dash: the numbers after one are its own, and of those
   that take a word the word.  *strength becomes the number behind -bm, move the first two numbers
   behind -o and then those behind -s; both may be missing.  -clamp on and -mm are told. */
static inline void mtl_options(mesh_reader *r, model *m, float *strength, float *move)
{
    static const char *const worded[6] = { "-blendu", "-blendv",  "-cc",
                                           "-clamp",  "-imfchan", "-type" };
    for (;;) {
        mesh_reader ahead;
        char unheard[4];
        float number;
        float *to = NULL; /* two numbers */
        int k = 0, bm, count = 0;
        mesh_skip_blanks(r, 0);
        if (r->at == r->end || *r->at != '-') return;
        bm = strength && r->end - r->at > 3 && !memcmp(r->at, "-bm", 3);
        ahead = *r;
        if (mesh_take_word(&ahead, "-mm")) known_take(r, m, KNOWN_TOLD, 0, "-mm", 3);
        if (mesh_take_word(&ahead, "-clamp")) {
            mesh_skip_blanks(&ahead, 0);
            if (mesh_take_word(&ahead, "on")) known_take(r, m, KNOWN_TOLD, 0, "-clamp on", 9);
        }
        if (move && r->end - r->at > 3 && !memcmp(r->at, "-o ", 3)) to = move;
        if (move && r->end - r->at > 3 && !memcmp(r->at, "-s ", 3)) to = move + 2;
        while (k < 6 && !mesh_take_word(r, worded[k])) k++;
        while (!mesh_at_word_end(r)) r->at++;
        mesh_skip_blanks(r, 0);
        for (; k < 6 && !mesh_at_word_end(r);) r->at++;
        ahead = *r;
        ahead.error = unheard;
        ahead.error_size = sizeof unheard;
        while (k == 6 && !mesh_take_number(&ahead, &number)) {
            r->at = ahead.at;
            if (bm) *strength = fmaxf(fabsf(number), 1e-9f);
            if (to && count < 2) to[count++] = number;
            mesh_skip_blanks(&ahead, 0);
        }
    }
}

/* How much of a line is the name of a file: what stands before options, behind an extension */
static inline size_t mtl_name(const unsigned char *line, size_t n)
{
    static const char *const options[7] = {
        "-bm ", "-o ", "-s ", "-t ", "-mm ", "-clamp ", "-blend"
    };
    int dot = 0;
    for (size_t i = 0; i < n; i++) {
        dot |= line[i] == '.';
        for (int k = 0; dot && mesh_is_blank(line[i]) && k < 7; k++)
            if (n - i > strlen(options[k]) &&
                !memcmp(line + i + 1, options[k], strlen(options[k]))) {
                while (i && mesh_is_blank(line[i - 1])) i--;
                return i;
            }
    }
    return n;
}

/* The name of a picture, and options before or behind it */
static inline int mtl_map(mesh_reader *r, model *m, char **map, float *strength, float *move)
{
    const unsigned char *begin;
    size_t n;
    mtl_options(r, m, strength, move);
    begin = mesh_take_line(r);
    if (r->at == begin || !*begin) return 0;
    n = mtl_name(begin, (size_t)(r->at - begin));
    free(*map);
    *map = model_file_name(begin, n);
    r->at = begin + n;
    mtl_options(r, m, strength, move);
    return *map ? 0 : mesh_fail(r, "out of memory");
}

/* A picture of its own for d is left out; mostly map_d names that of map_Kd again. */
static inline int mtl_map_of_d(mesh_reader *r, model *m, mtl_clear *c)
{
    c->mapped = 1;
    return mtl_map(r, m, &c->map, NULL, NULL);
}

/* A picture that moves as map_Kd does, or there is a warning */
static inline int mtl_other(mesh_reader *r, model *m, mtl_clear *c, char **map, float *strength)
{
    c->others = 1;
    return mtl_map(r, m, map, strength, c->move);
}

/* One statement about a surface.  Programs disagree about Tr: d is believed where both stand. */
static inline int mtl_statement(mesh_reader *r, model *m, model_surface *s, mtl_clear *c)
{
    shade_material *k = &s->material;
    float number;
    if (mesh_take_word(r, "kd")) {
        c->has_kd = 1;
        return mtl_color(r, c->white, &k->diffuse);
    }
    if (mesh_take_word(r, "ks")) return mtl_color(r, c->white, &k->specular);
    if (mesh_take_word(r, "ke")) return mtl_color(r, c->white, &k->emission);
    if (mesh_take_word(r, "ns")) return mtl_number(r, 0, 10000, &k->shininess);
    if (mesh_take_word(r, "illum")) return mtl_illum(r, m, c);
    if (mesh_take_word(r, "pr")) return mtl_number(r, 0, 1, &c->rough);
    if (mesh_take_word(r, "pm")) return mtl_number(r, 0, 1, &c->metal);
    if (mesh_take_word(r, "ps")) return mtl_sheen(r, m);
    if (mesh_take_word(r, "map_kd")) return mtl_map(r, m, &s->map, NULL, s->move);
    if (mesh_take_word(r, "map_ke")) return mtl_other(r, m, c, &s->glow_map, NULL);
    if (mesh_take_word(r, "map_d")) return mtl_map_of_d(r, m, c);
    if (mesh_take_word(r, "map_bump") || mesh_take_word(r, "bump") || mesh_take_word(r, "norm") ||
        mesh_take_word(r, "map_kn"))
        return mtl_other(r, m, c, &s->relief.map, &s->relief.strength);
    if (mesh_take_word(r, "tr")) return mtl_number(r, 0, 1, c->has_d ? &number : &s->transparency);
    if (!mesh_take_word(r, "d")) return known_word(r, m, mtl_known);
    if (mtl_number(r, 0, 1, &number)) return 1;
    s->transparency = 1 - number;
    c->has_d = 1;
    return 0;
}

/* The surface s, which may be NULL, is complete: decides whether the alpha of its map counts. */
static inline void mtl_finish(model *m, model_surface *s, mtl_clear *c)
{
    const float white = c->white;
    if (s && c->others && !s->map) memcpy(s->move, c->move, sizeof s->move);
    if (s && c->others && memcmp(c->move, s->move, sizeof s->move) != 0)
        model_warn(m, s->map,
                   "the -o and -s of the other pictures are not its own, and do not count");
    if (s && s->map && !c->has_kd) s->material.diffuse = shade_v3(0, 0, 0);
    if (s && c->dull) s->material.specular = shade_v3(0, 0, 0);
    if (s && c->rough >= 0) {
        s->shine = shade_v3(0.04f, 0.04f, 0.04f);
        model_rough(s, c->metal, c->rough);
    }
    if (s && s->map) s->opaque = !c->mapped && s->transparency <= 0;
    if (s && c->map && (!s->map || strcmp(c->map, s->map) != 0))
        model_warn(m, c->map, "map_d counts only where it is the picture of map_Kd");
    free(c->map);
    *c = mtl_fresh;
    c->white = white;
}

/* Fills the surfaces of m that stand in the text; of two with one name the first counts.  A
   statement that is wrong costs no other one.  0: all is well; else r->error names the first. */
static inline int mtl_read(mesh_reader *r, model *m)
{
    model_surface *s = NULL;
    mtl_clear clear = mtl_fresh;
    int failed = 0;
    clear.white = mtl_white(*r);
    while (r->at < r->end) {
        mesh_skip_blanks(r, 1);
        if (mesh_take_word(r, "newmtl")) {
            const unsigned char *begin = mesh_take_line(r);
            int number = model_find_surface(m, begin, (size_t)(r->at - begin), 0);
            mtl_finish(m, s, &clear);
            s = number < 0 || m->surface[number].set ? NULL : &m->surface[number];
            if (s) s->set = 1;
        } else if (s && r->at < r->end && *r->at != '#' && mtl_statement(r, m, s, &clear)) {
            failed = 1;
            r->error_size = 0;
        }
        mesh_next_line(r, 1);
    }
    mtl_finish(m, s, &clear);
    for (int i = 0; m->surface && i < m->surface_count; i++) {
        shade_material *k = &m->surface[i].material;
        model_show_map(&m->surface[i]);
        k->ambient = k->diffuse;
        model_glow(&m->surface[i], 0);
        if (k->shininess < 1) k->specular = shade_v3(0, 0, 0); /* too wide */
    }
    return failed;
}
#endif
