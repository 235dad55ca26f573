/* off.h - reads OFF files of text: OFF with C (colours of vertices), N (normals), ST (texture
   coordinates, which are skipped) in any order, counts, comments; each vertex and face begins a
   line and may go on in the next ones; colours behind the corners of faces, as whole numbers to 255
   or as fractions, and behind vertices without a C, as OpenCTM writes them.  Polygons may be
   concave.  4OFF, nOFF and OFF BINARY are refused. */
#ifndef MODEL_OFF_H
#define MODEL_OFF_H

#include "faces.h"

/* What a file may begin with.  Normals are made anew. */
static const known_name off_known[] = { { "OFF", KNOWN_DRAWN },    { "COFF", KNOWN_DRAWN },
                                        { "NOFF", KNOWN_DRAWN },   { "CNOFF", KNOWN_DRAWN },
                                        { "NCOFF", KNOWN_DRAWN },  { "STOFF", KNOWN_TOLD },
                                        { "4OFF", KNOWN_REFUSED }, { "OFF BINARY", KNOWN_REFUSED },
                                        { NULL, KNOWN_REFUSED } };

typedef struct off_data {
    mesh_floats position, color; /* color: of vertices, three each, as the file has them */
    mesh_floats shown;           /* of faces, likewise; NAN: none */
    mesh_uints tint;             /* of each face: 1 + its red, green and blue in bytes, or 0 */
    mesh_origin origin;
    faces faces;
    int has_color, has_normal, tinted;
    int guessed;             /* the header has no C, and the first vertex a colour */
    int others;              /* there are numbers behind vertices or faces that are no colours */
    float brightest;         /* of all colours: those to 1 are fractions */
    int fractions;           /* some have a point: to 2 they are fractions */
    float clearest, fullest; /* the least alpha, and the greatest */
} off_data;

/* Moves to the next line with something on it.  Returns 1 where there is none. */
static inline int off_line(mesh_reader *r)
{
    mesh_next_line(r, 0);
    for (;;) {
        mesh_skip_lines(r);
        if (r->at == r->end || *r->at != '#') return r->at == r->end;
        mesh_next_line(r, 0);
    }
}

/* Moves to the next number, which may stand on the next line. */
static inline void off_next(mesh_reader *r)
{
    const long long line = r->line;
    mesh_skip_blanks(r, 0);
    if (mesh_at_word_end(r) && off_line(r)) r->line = line;
}

static inline int off_number(mesh_reader *r, double *out)
{
    off_next(r);
    return mesh_take_double(r, out);
}

static inline int off_coordinate(mesh_reader *r, double *out)
{
    off_next(r);
    return mesh_take_coordinate(r, out);
}

static inline int off_count(mesh_reader *r, double *out)
{
    if (off_number(r, out)) return 1;
    if (*out >= 0 && *out < INT_MAX && *out == floor(*out)) return 0;
    return mesh_fail(r, "a count is no whole number");
}

/* 1: there is more on the line. */
static inline int off_goes_on(mesh_reader *r)
{
    mesh_skip_blanks(r, 0);
    return !mesh_at_word_end(r);
}

/* The rest of a line as red, green and blue, and 4 with alpha, else 3; 0: there are none. */
static inline int off_color(mesh_reader *r, off_data *o, float rgb[3])
{
    mesh_reader ahead = *r;
    int point = 0;
    float alpha = FLT_MAX;
    mesh_skip_blanks(&ahead, 0);
    if (mesh_at_word_end(&ahead)) return 0;
    ahead.error_size = 0;
    for (int k = 0; k < 3; k++) {
        const unsigned char *from;
        mesh_skip_blanks(&ahead, 0);
        from = ahead.at;
        if (mesh_take_number(&ahead, &rgb[k])) return 0;
        point |= memchr(from, '.', (size_t)(ahead.at - from)) != NULL;
    }
    for (int k = 0; k < 3; k++) o->brightest = fmaxf(o->brightest, rgb[k]);
    o->fractions |= point;
    mesh_skip_blanks(&ahead, 0);
    if (mesh_take_number(&ahead, &alpha)) return 3;
    o->clearest = fminf(o->clearest, alpha);
    o->fullest = fmaxf(o->fullest, alpha);
    return 4;
}

/* Numbers behind the first vertex without C are colours where they are four, none of them negative:
   three may be a normal. */
static inline void off_guess(mesh_reader *r, off_data *o)
{
    off_data asked = *o;
    float rgb[3];
    if (off_color(r, &asked, rgb) != 4 || rgb[0] < 0 || rgb[1] < 0 || rgb[2] < 0) return;
    o->has_color = o->guessed = 1;
}

/* The greatest value of a colour.  One number may have no point, where the others are fractions. */
static inline float off_white(const off_data *o)
{
    return o->brightest > (o->fractions ? 2 : 1) ? 255 : 1;
}

/* A colour as bytes */
static inline uint32_t off_bytes(const off_data *o, const float rgb[3])
{
    const float scale = 255 / off_white(o);
    uint32_t bytes = 0;
    for (int k = 0; k < 3; k++)
        bytes = bytes << 8 | (uint32_t)(fminf(255, fmaxf(0, scale * rgb[k])) + 0.5f);
    return bytes;
}

static inline shade_vec3 off_linear(uint32_t bytes)
{
    return shade_linear_from_srgb(shade_v3(
        (float)(bytes >> 16) / 255, (float)(bytes >> 8 & 255) / 255, (float)(bytes & 255) / 255));
}

static inline int off_vertex(mesh_reader *r, off_data *o)
{
    double v[3], unused;
    float place[3], rgb[3] = { -1, -1, -1 };
    long long line = 0;
    for (int k = 0; k < 3; k++) {
        if (off_coordinate(r, &v[k])) return 1;
        if (!k) line = r->line;
    }
    for (int k = 0; k < 3 && o->has_normal; k++)
        if (off_coordinate(r, &unused)) return 1;
    mesh_relative(&o->origin, v, place);
    if (!o->position.count && !o->has_color) off_guess(r, o);
    if (mesh_push(&o->position, place, 3)) return mesh_fail(r, "out of memory");
    if (!o->has_color && off_goes_on(r)) { /* of the next vertex, where lines break anywhere */
        if (r->line != line) return mesh_fail(r, "a vertex ends in the middle of the line");
        o->others = 1;
    }
    if (!o->has_color) return 0;
    if (!off_color(r, o, rgb)) {
        if (!o->guessed) return mesh_fail(r, "a vertex of COFF has no colour");
        o->others = 1;
    }
    return mesh_push(&o->color, rgb, 3) ? mesh_fail(r, "out of memory") : 0;
}

static inline int off_face(mesh_reader *r, off_data *o, double vertices)
{
    float rgb[3] = { NAN, NAN, NAN };
    const size_t before = o->faces.triangles;
    double corners, corner;
    if (off_count(r, &corners)) return 1;
    if (faces_begin(&o->faces)) return mesh_fail(r, "out of memory");
    for (double i = 0; i < corners; i++) {
        if (off_number(r, &corner)) return 1;
        if (!(corner >= 0 && corner < vertices) || corner != floor(corner))
            return mesh_fail(r, "a corner is none of %lu vertices", (unsigned long)vertices);
        if (faces_corner(&o->faces, (uint32_t)corner)) return mesh_fail(r, "out of memory");
    }
    if (faces_end(&o->faces)) return mesh_fail(r, "out of memory");
    if (off_color(r, o, rgb)) {
        o->tinted = 1;
    } else {
        o->others |= off_goes_on(r);
        rgb[0] = NAN;
    }
    if (o->faces.triangles > before && mesh_push(&o->shown, rgb, 3))
        return mesh_fail(r, "out of memory");
    return mesh_check_triangles(r, o->faces.triangles);
}

/* Takes OFF with the letters before it; the counts may follow without a blank. */
static inline int off_letters(mesh_reader *r)
{
    const unsigned char *p = r->at;
    mesh_reader behind = *r;
    while (r->end - p > 3 && strchr("STCN", *p) && *p) p++;
    behind.at = p;
    if (r->end - p > 3 && !memcmp(p, "OFF", 3) && p[3] >= '0' && p[3] <= '9')
        behind.at += 3;
    else if (!mesh_take_word(&behind, "off"))
        return 0;
    r->at = behind.at;
    return 1;
}

static inline int off_header(mesh_reader *r, off_data *o, model *m, double *vertices, double *count)
{
    const unsigned char *begin;
    double edges;
    long long line;
    mesh_skip_lines(r);
    while (r->at < r->end && *r->at == '#') off_line(r);
    begin = r->at;
    if (!off_letters(r)) return mesh_fail(r, "expected OFF, found %s", mesh_here(r).text);
    for (; begin < r->at; begin++) {
        o->has_color |= *begin == 'C';
        o->has_normal |= *begin == 'N';
        if (*begin == 'T') known_take(r, m, KNOWN_TOLD, 0, "ST", 2);
    }
    mesh_skip_blanks(r, 0);
    if (mesh_take_word(r, "binary")) return mesh_fail(r, "binary OFF is not read");
    if (mesh_at_word_end(r) && off_line(r)) return mesh_fail(r, "ends before the counts");
    line = r->line;
    if (off_count(r, vertices) || off_count(r, count)) return 1;
    return r->line != line && off_count(r, &edges); /* which some leave out on one line */
}

/* Gives each vertex one for each colour that its faces have, and counts these. */
static inline int off_paint(off_data *o, size_t *count, mesh_set *made)
{
    size_t face = 0;
    int failed = 0;
    for (size_t i = 0; i < o->shown.count && !failed; i += 3) {
        const float *c = o->shown.v + i;
        failed = mesh_push_uint(&o->tint, c[0] <= FLT_MAX ? 1 + off_bytes(o, c) : 0);
    }
    for (size_t at = 0; at < o->faces.stream.count && !failed; face++) {
        size_t corners;
        uint32_t *corner = faces_next(&o->faces, &at, &corners);
        for (size_t k = 0; k < corners && !failed; k++) {
            const mesh_triple key = { { corner[k], o->tint.v[face], 0 } };
            failed = mesh_set_add(made, key, &corner[k]);
        }
    }
    *count = made->count;
    return failed;
}

static inline int off_finish(mesh_reader *r, off_data *o, model *out)
{
    static const mesh_set empty;
    mesh_set made = empty;
    owned_mesh *m = &out->mesh;
    size_t n = o->position.count / 3;
    int failed = 0;
    r->line = 0;
    if (!o->faces.triangles) return mesh_fail(r, "no face of it has three corners");
    if (o->tinted) failed = off_paint(o, &n, &made);
    m->positions = (float *)malloc((n + 1) * 12);
    m->normals = (float *)calloc(n + 1, 12);
    if (o->tinted || o->has_color) m->colors = (float *)malloc((n + 1) * 12);
    failed |= !m->positions || !m->normals || (!m->colors && (o->tinted || o->has_color));
    for (size_t i = 0; i < n && !failed; i++) {
        const size_t vertex = o->tinted ? made.triple[i].k[0] : i;
        const uint32_t tint = o->tinted ? made.triple[i].k[1] : 0;
        uint32_t bytes = tint ? tint - 1 : 0xBFBFBFu;
        shade_vec3 c;
        memcpy(m->positions + 3 * i, o->position.v + 3 * vertex, 12);
        if (!m->colors) continue;
        if (!tint && o->has_color && (o->color.v[3 * vertex] >= 0 || !o->guessed))
            bytes = off_bytes(o, o->color.v + 3 * vertex);
        c = off_linear(bytes);
        memcpy(m->colors + 3 * i, &c, sizeof c);
    }
    mesh_set_free(&made);
    if (failed) return mesh_fail(r, "out of memory");
    if (o->others && !out->unread[0])
        model_leave_out(out, r->name, "numbers behind its vertices or faces that are no colours");
    if (o->clearest < off_white(o) && (o->fullest > 0 || !o->guessed))
        known_take(r, out, KNOWN_TOLD, 0, "alpha", 5);
    if (faces_finish(r, &o->faces, out, n)) return 1;
    mesh_link(m, (int)n, 3 * (int)o->faces.triangles);
    model_placed(out, &o->origin);
    return mesh_fill_normals(m, 0) ? mesh_fail(r, "out of memory") : 0;
}

static inline int off_read(mesh_reader *r, model *m)
{
    static const off_data empty;
    off_data o = empty;
    double vertices = 0, count = 0;
    int failed;
    model_place(m, &o.origin);
    o.clearest = FLT_MAX;
    failed = off_header(r, &o, m, &vertices, &count);
    for (double i = 0; i < vertices + count && !failed; i++) {
        failed = mesh_tell(r, (size_t)i);
        if (!failed && off_line(r))
            failed = mesh_fail(r, "ends after %lu of %lu vertices and %lu faces", (unsigned long)i,
                               (unsigned long)vertices, (unsigned long)count);
        else if (!failed)
            failed = i < vertices ? off_vertex(r, &o) : off_face(r, &o, vertices);
    }
    if (!failed && !off_line(r))
        model_leave_out(m, r->name, "lines behind the vertices and faces that it counts");
    if (!failed) failed = off_finish(r, &o, m);
    free(o.position.v);
    free(o.color.v);
    free(o.tint.v);
    free(o.shown.v);
    faces_free(&o.faces);
    return failed;
}

/* 1: the bytes begin as OFF does, behind blanks and comments. */
static inline int off_begins(const unsigned char *bytes, size_t size)
{
    mesh_reader r = mesh_of(bytes, size, "", NULL, 0);
    mesh_skip_lines(&r);
    while (r.at < r.end && *r.at == '#') off_line(&r);
    return r.end - r.at > 2 && *r.at != 'o' && off_letters(&r);
}
#endif
