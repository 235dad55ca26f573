/* ply.h - reads PLY, as text or binary of both byte orders: x y z, nx ny nz, red green blue (or r g
   b, diffuse_red ..., or f_dc_0 ... of Gaussian splats, with their opacity, scale_0 ... and rot_0
   ...), u v (or s t, texture_u texture_v) of vertices, lists of corners of faces and of their
   texture coordinates, red green blue of faces where vertices have none, triangle strips, and the
   picture named by a comment TextureFile.
   Other elements and properties are skipped. */
#ifndef MODEL_PLY_H
#define MODEL_PLY_H

#include "faces.h"
#include "points.h"

enum { PLY_TEXT, PLY_LITTLE, PLY_BIG };
enum { PLY_OTHER, PLY_VERTEX, PLY_FACE, PLY_STRIP }; /* kinds of elements */
enum { PLY_POSITION, PLY_NORMAL, PLY_COLOR, PLY_PLACE, PLY_SPLAT, PLY_COLUMNS };
enum {
    PLY_X,
    PLY_NX = 3,
    PLY_RED = 6,
    PLY_U = 9,
    PLY_OPACITY = 11,
    PLY_SCALE,
    PLY_TURN = 15,
    PLY_VALUES = 19,
    PLY_CORNERS,
    PLY_TEXCOORD,
    PLY_ALPHA,
    PLY_A, /* the same, by its other name */
    PLY_UNUSED
};
enum { PLY_MOST = 256 }; /* properties in all */
static const int ply_first[PLY_COLUMNS + 1] = { PLY_X, PLY_NX,      PLY_RED,
                                                PLY_U, PLY_OPACITY, PLY_VALUES };

/* signed and unsigned integers of 1, 2, 4 bytes, floats of 4 and 8 */
typedef enum ply_type {
    PLY_INT8,
    PLY_UINT8,
    PLY_INT16,
    PLY_UINT16,
    PLY_INT32,
    PLY_UINT32,
    PLY_FLOAT,
    PLY_DOUBLE,
    PLY_TYPES
} ply_type;

typedef struct ply_property {
    ply_type type, count_type;
    int is_list, meaning;
    int splat; /* a colour as the first coefficient of a spherical harmonic */
} ply_property;
typedef struct ply_element {
    int kind, first, properties;
    double count;
} ply_element;

typedef struct ply_data {
    int format, elements, properties;
    ply_element element[PLY_MOST];
    ply_property property[PLY_MOST];
    int has[PLY_VALUES];
    mesh_floats column[PLY_COLUMNS]; /* of vertices; empty: the file has none */
    faces faces;
    mesh_origin origin;
    double highest;     /* corner */
    float bright;       /* the greatest colour of more than a byte, and ... */
    double whole;       /* ... what full light is in its type; 0: floats */
    const char *alpha;  /* its name */
    int clear;          /* an alpha of bytes is less than all, or ... */
    double least, most; /* ... where it is of another type, the least and the greatest */
    /* where faces have texture coordinates for their corners, as MeshLab writes them, or colours */
    int by_corner, placed, tinted;
    mesh_uints corner;       /* the vertex of each corner, which becomes a vertex at the end */
    mesh_floats place, list; /* u and v of each corner; of the face that is read, as they come */
    size_t begin;            /* the first corner of that face */
} ply_data;

static const known_name ply_elements[] = { { "vertex", KNOWN_DRAWN },
                                           { "face", KNOWN_DRAWN },
                                           { "tristrips", KNOWN_DRAWN },
                                           { "camera", KNOWN_SILENT },
                                           { NULL, KNOWN_TOLD } };

/* Of vertices.  Alpha, which is 255 in most files, is told of where it is less. */
static const known_name ply_of_vertex[] = { { "x", KNOWN_DRAWN },
                                            { "y", KNOWN_DRAWN },
                                            { "z", KNOWN_DRAWN },
                                            { "nx", KNOWN_DRAWN },
                                            { "ny", KNOWN_DRAWN },
                                            { "nz", KNOWN_DRAWN },
                                            { "red", KNOWN_DRAWN },
                                            { "green", KNOWN_DRAWN },
                                            { "blue", KNOWN_DRAWN },
                                            { "r", KNOWN_DRAWN },
                                            { "g", KNOWN_DRAWN },
                                            { "b", KNOWN_DRAWN },
                                            { "diffuse_red", KNOWN_DRAWN },
                                            { "diffuse_green", KNOWN_DRAWN },
                                            { "diffuse_blue", KNOWN_DRAWN },
                                            { "f_dc_0", KNOWN_DRAWN },
                                            { "f_dc_1", KNOWN_DRAWN },
                                            { "f_dc_2", KNOWN_DRAWN },
                                            { "u", KNOWN_DRAWN },
                                            { "v", KNOWN_DRAWN },
                                            { "s", KNOWN_DRAWN },
                                            { "t", KNOWN_DRAWN },
                                            { "texture_u", KNOWN_DRAWN },
                                            { "texture_v", KNOWN_DRAWN },
                                            { "alpha", KNOWN_TOLD },
                                            { "a", KNOWN_TOLD },
                                            { "quality", KNOWN_SILENT },
                                            { "confidence", KNOWN_SILENT },
                                            { "intensity", KNOWN_SILENT },
                                            { "value", KNOWN_SILENT },
                                            { "flags", KNOWN_SILENT },
                                            { "radius", KNOWN_SILENT },
                                            { "curvature", KNOWN_SILENT },
                                            { NULL, KNOWN_TOLD } };
static const known_name ply_of_face[] = { { "vertex_indices", KNOWN_DRAWN },
                                          { "vertex_index", KNOWN_DRAWN },
                                          { "texcoord", KNOWN_DRAWN },
                                          { "flags", KNOWN_SILENT },
                                          { "quality", KNOWN_SILENT },
                                          { "alpha", KNOWN_SILENT },
                                          { "nx", KNOWN_SILENT },
                                          { "ny", KNOWN_SILENT },
                                          { "nz", KNOWN_SILENT },
                                          { "red", KNOWN_DRAWN },
                                          { "green", KNOWN_DRAWN },
                                          { "blue", KNOWN_DRAWN },
                                          { "texnumber", KNOWN_TOLD },
                                          { NULL, KNOWN_TOLD } };

/* In the order of SPLAT_OPACITY ... */
static const char *const ply_splat_names[SPLAT_VALUES] = { "opacity", "scale_0", "scale_1",
                                                           "scale_2", "rot_0",   "rot_1",
                                                           "rot_2",   "rot_3" };

/* ---- the header ----------------------------------------------------------------------------- */

static inline int ply_take_type(mesh_reader *r, ply_type *out)
{
    static const char *const names[2][PLY_TYPES] = {
        { "char", "uchar", "short", "ushort", "int", "uint", "float", "double" },
        { "int8", "uint8", "int16", "uint16", "int32", "uint32", "float32", "float64" }
    };
    mesh_skip_blanks(r, 0);
    for (int k = 0; k < 2 * PLY_TYPES; k++) {
        if (!mesh_take_word(r, names[k / PLY_TYPES][k % PLY_TYPES])) continue;
        *out = (ply_type)(k % PLY_TYPES);
        return 0;
    }
    return mesh_fail(r, "expected a type, found %s", mesh_here(r).text);
}

/* The meaning of a property of a kind of element */
static inline int ply_meaning(mesh_reader *r, int kind, int is_list)
{
    static const char *const names[] = { "x",
                                         "y",
                                         "z",
                                         "nx",
                                         "ny",
                                         "nz",
                                         "red",
                                         "green",
                                         "blue",
                                         "u",
                                         "v",
                                         "s",
                                         "t",
                                         "texture_u",
                                         "texture_v",
                                         "r",
                                         "g",
                                         "b",
                                         "diffuse_red",
                                         "diffuse_green",
                                         "diffuse_blue",
                                         "f_dc_0",
                                         "f_dc_1",
                                         "f_dc_2" };
    static const int meaning[] = { 0,  1, 2,  3, 4, 5, 6, 7, 8, 9, 10, 9,
                                   10, 9, 10, 6, 7, 8, 6, 7, 8, 6, 7,  8 };
    if (is_list && kind > PLY_VERTEX &&
        (mesh_take_word(r, "vertex_indices") || mesh_take_word(r, "vertex_index")))
        return PLY_CORNERS;
    if (is_list && kind == PLY_FACE && mesh_take_word(r, "texcoord")) return PLY_TEXCOORD;
    if (!is_list && kind == PLY_VERTEX && mesh_take_word(r, "alpha")) return PLY_ALPHA;
    if (!is_list && kind == PLY_VERTEX && mesh_take_word(r, "a")) return PLY_A;
    for (size_t k = 0; kind == PLY_VERTEX && !is_list && k < sizeof names / sizeof *names; k++)
        if (mesh_take_word(r, names[k])) return meaning[k];
    for (int k = PLY_RED; kind == PLY_FACE && !is_list && k < PLY_U; k++)
        if (mesh_take_word(r, names[k])) return k;
    for (int k = 0; kind == PLY_VERTEX && !is_list && k < SPLAT_VALUES; k++)
        if (mesh_take_word(r, ply_splat_names[k])) return PLY_OPACITY + k;
    return PLY_UNUSED;
}

static inline int ply_take_property(mesh_reader *r, ply_data *p, model *m)
{
    ply_property *at = &p->property[p->properties];
    const unsigned char *name;
    ply_element *e;
    if (!p->elements) return mesh_fail(r, "a property before any element");
    if (p->properties == PLY_MOST) return mesh_fail(r, "more than %d properties", PLY_MOST);
    e = &p->element[p->elements - 1];
    mesh_skip_blanks(r, 0);
    at->is_list = mesh_take_word(r, "list");
    if (at->is_list && ply_take_type(r, &at->count_type)) return 1;
    if (at->is_list && at->count_type >= PLY_FLOAT)
        return mesh_fail(r, "a list counts in integers");
    if (ply_take_type(r, &at->type)) return 1;
    mesh_skip_blanks(r, 0);
    name = r->at;
    at->splat = r->end - name > 5 && !memcmp(name, "f_dc_", 5);
    at->meaning = ply_meaning(r, e->kind, at->is_list);
    if (at->meaning == PLY_UNUSED && e->kind != PLY_OTHER &&
        known_word(r, m, e->kind == PLY_VERTEX ? ply_of_vertex : ply_of_face))
        return 1;
    if (at->meaning < PLY_VALUES && p->has[at->meaning]++) { /* twice: the first counts */
        at->meaning = PLY_UNUSED;
        if (known_take(r, m, KNOWN_TOLD, 0, name, (size_t)(r->at - name))) return 1;
    }
    p->tinted |= e->kind == PLY_FACE && at->meaning >= PLY_RED && at->meaning < PLY_U;
    p->properties++;
    e->properties++;
    return 0;
}

static inline int ply_take_element(mesh_reader *r, ply_data *p, model *m)
{
    ply_element *e = &p->element[p->elements];
    if (p->elements == PLY_MOST) return mesh_fail(r, "more than %d elements", PLY_MOST);
    mesh_skip_blanks(r, 0);
    e->kind = mesh_take_word(r, "vertex")      ? PLY_VERTEX
              : mesh_take_word(r, "face")      ? PLY_FACE
              : mesh_take_word(r, "tristrips") ? PLY_STRIP
                                               : PLY_OTHER;
    if (e->kind == PLY_OTHER && known_word(r, m, ply_elements)) return 1;
    while (!mesh_at_word_end(r)) r->at++;
    mesh_skip_blanks(r, 0);
    if (mesh_take_double(r, &e->count)) return 1;
    if (e->count < 0 || e->count != floor(e->count))
        return mesh_fail(r, "a count is no whole number");
    e->first = p->properties;
    e->properties = 0;
    p->elements++;
    return 0;
}

static inline int ply_take_format(mesh_reader *r, ply_data *p)
{
    mesh_skip_blanks(r, 0);
    p->format = mesh_take_word(r, "ascii")                  ? PLY_TEXT
                : mesh_take_word(r, "binary_little_endian") ? PLY_LITTLE
                : mesh_take_word(r, "binary_big_endian")    ? PLY_BIG
                                                            : -1;
    return p->format < 0 ? mesh_fail(r, "unknown format %s", mesh_here(r).text) : 0;
}

/* comment TextureFile NAME: the surface of all faces */
static inline int ply_take_comment(mesh_reader *r, model *m)
{
    const unsigned char *begin;
    mesh_skip_blanks(r, 0);
    if (m->surface_count || !mesh_take_word(r, "texturefile")) return 0;
    begin = mesh_take_line(r);
    if (model_find_surface(m, "", 0, 1) < 0) return mesh_fail(r, "out of memory");
    m->surface->map = model_file_name(begin, (size_t)(r->at - begin));
    m->surface->set = 1;
    m->surface->material.diffuse = m->surface->material.ambient = shade_v3(1, 1, 1);
    return m->surface->map ? 0 : mesh_fail(r, "out of memory");
}

static inline int ply_read_header(mesh_reader *r, ply_data *p, model *m)
{
    p->format = -1;
    for (int line = 0, failed = 0; r->at < r->end && !failed; line++) {
        if (!line && !mesh_take_word(r, "ply")) return mesh_fail(r, "does not begin with ply");
        mesh_skip_blanks(r, 0);
        if (mesh_take_word(r, "end_header")) {
            if (p->format < 0) return mesh_fail(r, "the header names no format");
            if (!p->has[PLY_X] || !p->has[PLY_X + 1] || !p->has[PLY_X + 2])
                return mesh_fail(r, "vertices need x, y and z");
            mesh_next_line(r, 0);
            if (p->format != PLY_TEXT) r->line = 0;
            return 0;
        }
        if (mesh_take_word(r, "format"))
            failed = ply_take_format(r, p);
        else if (mesh_take_word(r, "element"))
            failed = ply_take_element(r, p, m);
        else if (mesh_take_word(r, "property"))
            failed = ply_take_property(r, p, m);
        else if (mesh_take_word(r, "comment"))
            failed = ply_take_comment(r, m);
        if (failed) return 1;
        mesh_next_line(r, 0);
    }
    return mesh_fail(r, "the header does not end");
}

/* ---- the body ------------------------------------------------------------------------------- */

/* An integer of some bytes */
static inline uint64_t ply_bits(const unsigned char *p, int size, int format)
{
    const int big = format == PLY_BIG;
    if (size == 1) return *p;
    if (size == 2) return big ? (uint32_t)p[0] << 8 | p[1] : mesh_uint16(p);
    if (size == 4 && !big) return mesh_uint32(p);
    if (size == 4) return (uint32_t)p[0] << 24 | (uint32_t)p[1] << 16 | (uint32_t)p[2] << 8 | p[3];
    return ply_bits(p + (big ? 0 : 4), 4, format) << 32 | ply_bits(p + (big ? 4 : 0), 4, format);
}

static inline int ply_number(mesh_reader *r, int format, ply_type type, double *out)
{
    static const int sizes[PLY_TYPES] = { 1, 1, 2, 2, 4, 4, 4, 8 };
    const int size = sizes[type];
    uint64_t bits;
    if (format == PLY_TEXT) {
        mesh_skip_lines(r);
        return type < PLY_FLOAT ? mesh_take_double(r, out) : mesh_take_coordinate(r, out);
    }
    if (r->end - r->at < size) return mesh_fail(r, "ends too early");
    bits = ply_bits(r->at, size, format);
    r->at += size;
    if (type == PLY_FLOAT)
        *out = (double)mesh_float((uint32_t)bits);
    else if (type == PLY_DOUBLE)
        memcpy(out, &bits, sizeof *out);
    else
        *out = (double)bits;
    if (type < PLY_FLOAT && type % 2 == 0 && bits >> (8 * size - 1))
        *out -= (double)((uint64_t)1 << 8 * size);
    return 0;
}

/* A corner as the file has it; whether there is such a vertex shows at the end. */
static inline int ply_corner(mesh_reader *r, ply_data *p, double value)
{
    uint32_t number = (uint32_t)p->corner.count;
    if (!(value >= 0 && value < INT_MAX)) return mesh_fail(r, "a corner is out of range");
    if (number == INT_MAX) return mesh_fail(r, "more than 2^31 - 1 corners");
    if (value > p->highest) p->highest = value;
    if (!p->by_corner)
        number = (uint32_t)value;
    else if (mesh_push_uint(&p->corner, (uint32_t)value))
        return mesh_fail(r, "out of memory");
    return faces_corner(&p->faces, number) ? mesh_fail(r, "out of memory") : 0;
}

/* The face that was read gets its texture coordinates and its colour, wherever they stand in it. */
static inline int ply_place(mesh_reader *r, ply_data *p, const double *rgb)
{
    const float none = 0,
                color[3] = { mesh_or_zero(rgb[0]), mesh_or_zero(rgb[1]), mesh_or_zero(rgb[2]) };
    int failed = 0;
    for (size_t i = 2 * p->begin; i < 2 * p->corner.count && p->placed && !failed; i++) {
        const size_t at = i - 2 * p->begin;
        failed = mesh_push(&p->place, at < p->list.count ? &p->list.v[at] : &none, 1);
    }
    for (size_t i = p->begin; i < p->corner.count && p->tinted && !failed; i++)
        failed = mesh_push(&p->column[PLY_COLOR], color, 3);
    if (failed) return mesh_fail(r, "out of memory");
    p->begin = p->corner.count;
    p->list.count = 0;
    return 0;
}

/* A strip ends at -1.  Every second triangle of it has its corners reversed. */
static inline int ply_strip(mesh_reader *r, ply_data *p, double value, uint32_t *pair, int *length)
{
    if (value < 0) return *length = 0;
    if (!(value < INT_MAX)) return mesh_fail(r, "a corner is out of range");
    if (++*length > 2) {
        const uint32_t *first = &pair[1 - *length % 2], *second = &pair[*length % 2];
        p->highest = fmax(p->highest, fmax(value, fmax((double)*first, (double)*second)));
        if (faces_triangle(&p->faces, *first, *second, (uint32_t)value))
            return mesh_fail(r, "out of memory");
    }
    pair[0] = pair[1];
    pair[1] = (uint32_t)value;
    return mesh_check_triangles(r, p->faces.triangles);
}

static inline int ply_list(mesh_reader *r, ply_data *p, const ply_property *at, int kind)
{
    double count, value;
    uint32_t pair[2] = { 0, 0 };
    int length = 0, used = at->meaning == PLY_CORNERS;
    float single;
    if (ply_number(r, p->format, at->count_type, &count)) return 1;
    if (!(count >= 0)) return mesh_fail(r, "a list of less than nothing");
    if (used && kind == PLY_FACE && faces_begin(&p->faces)) return mesh_fail(r, "out of memory");
    for (double i = 0; i < count; i++) {
        if (ply_number(r, p->format, at->type, &value)) return 1;
        if (used && kind == PLY_FACE && ply_corner(r, p, value)) return 1;
        single = mesh_or_zero(value);
        if (at->meaning == PLY_TEXCOORD && mesh_push(&p->list, &single, 1))
            return mesh_fail(r, "out of memory");
        if (used && kind == PLY_STRIP && ply_strip(r, p, value, pair, &length)) return 1;
    }
    if (used && kind == PLY_FACE && faces_end(&p->faces)) return mesh_fail(r, "out of memory");
    return mesh_check_triangles(r, p->faces.triangles);
}

/* Colours of bytes go from 0 to 1 at once; the greatest value tells what others mean. */
static inline double ply_color(ply_data *p, ply_type type, double value)
{
    static const double whole[PLY_FLOAT] = { 127, 255, 32767, 65535, 2147483647, 4294967295 };
    const double white = type < PLY_FLOAT ? whole[type] : 0;
    if (type < PLY_INT16) return value / white;
    p->bright = fmaxf(p->bright, mesh_or_zero(value));
    p->whole = fmax(p->whole, white);
    return value;
}

/* Notes an alpha. */
static inline void ply_alpha(ply_data *p, const ply_property *at, double value)
{
    p->alpha = at->meaning == PLY_A ? "a" : "alpha";
    if (at->type < PLY_INT16) p->clear |= value < (at->type == PLY_INT8 ? 127 : 255);
    if (at->type < PLY_INT16) return;
    if (value < p->least) p->least = value;
    if (value > p->most) p->most = value;
}

/* What full light is: 1 or 255 in floats, 255 or the greatest value in integers of several bytes */
static inline double ply_white(const ply_data *p)
{
    if (p->bright <= 2 && p->whole <= 0) return 1;
    return p->bright > 255 && p->whole > 0 ? p->whole : 255;
}

/* 1: the file has such a column; normals may lack a coordinate, splats opacity and turn. */
static inline int ply_has(const ply_data *p, int column)
{
    const int *has = p->has + ply_first[column];
    if (column == PLY_SPLAT)
        return has[SPLAT_SCALE] && has[SPLAT_SCALE + 1] && has[SPLAT_SCALE + 2];
    return has[0] || (column == PLY_NORMAL && (has[1] || has[2]));
}

/* The colour of a display that a splat has from all sides alike: it is stored as the factor of
   the constant spherical harmonic, 1 / (2 sqrt(pi)), from the middle of 0 .. 1. */
static inline double ply_splat(double value)
{
    return fmin(fmax(0.5 + 0.28209479177387814 * value, 0), 1);
}

static inline int ply_instance(mesh_reader *r, ply_data *p, const ply_element *e)
{
    double v[PLY_VALUES] = { 0, 0, 0, 0, 0, 0, 1, 1, 1, 0, 0, 1e30, 0, 0, 0, 1 }; /* solid */
    float single[PLY_VALUES];
    for (int k = e->first; k < e->first + e->properties; k++) {
        const ply_property *at = &p->property[k];
        double value;
        if (at->is_list) {
            if (ply_list(r, p, at, e->kind)) return 1;
            continue;
        }
        if (ply_number(r, p->format, at->type, &value)) return 1;
        if (at->meaning >= PLY_RED && at->meaning < PLY_U && at->splat)
            value = ply_splat(value);
        else if (at->meaning >= PLY_RED && at->meaning < PLY_U)
            value = ply_color(p, at->type, value);
        if (at->meaning == PLY_ALPHA || at->meaning == PLY_A) ply_alpha(p, at, value);
        if (at->meaning < PLY_VALUES) v[at->meaning] = value;
    }
    if (e->kind == PLY_FACE && p->by_corner && ply_place(r, p, v + PLY_RED)) return 1;
    if (e->kind != PLY_VERTEX) return 0;
    for (int k = PLY_RED; k < PLY_OPACITY; k++) single[k] = mesh_or_zero(v[k]);
    for (int k = PLY_OPACITY; k < PLY_VALUES; k++) /* not finite: of no size */
        single[k] = fabs(v[k]) <= 1e30 ? (float)v[k] : -1e30f;
    mesh_normal(v + PLY_NX, single + PLY_NX);
    single[PLY_U + 1] = 1 - single[PLY_U + 1];
    mesh_relative(&p->origin, v, single);
    if (p->column->count / 3 >= INT_MAX) return mesh_fail(r, "more than 2^31 - 1 vertices");
    for (int k = 0; k < PLY_COLUMNS; k++) {
        const int first = ply_first[k], width = ply_first[k + 1] - first;
        if (ply_has(p, k) && !(k == PLY_COLOR && p->tinted) &&
            mesh_push(&p->column[k], single + first, (size_t)width))
            return mesh_fail(r, "out of memory");
    }
    return 0;
}

static inline int ply_read_body(mesh_reader *r, ply_data *p, model *m)
{
    int strips = 0;
    for (int k = 0; k < p->elements; k++) strips |= p->element[k].kind == PLY_STRIP;
    for (int k = 0; k < p->properties && !strips; k++)
        p->placed |= p->property[k].meaning == PLY_TEXCOORD;
    if (p->tinted && strips) known_take(r, m, KNOWN_TOLD, 0, "colours of faces", 16);
    p->tinted &= !strips;
    p->by_corner = p->placed || p->tinted;
    for (int k = 0; k < p->elements; k++) {
        const ply_element *e = &p->element[k];
        for (double i = 0; i < e->count && e->properties; i++) {
            if (mesh_tell(r, (size_t)i) || ply_instance(r, p, e)) return 1;
        }
    }
    mesh_skip_lines(r);
    if (r->at < r->end)
        model_leave_out(m, r->name, "bytes behind the elements that its header counts");
    return 0;
}

/* Makes a vertex of each corner, with its own place in the picture, or colour. */
static inline int ply_spread(mesh_reader *r, ply_data *p)
{
    for (int k = 0; k < PLY_COLUMNS; k++) {
        mesh_floats spread = { NULL, 0, 0 }, *from = &p->column[k];
        const size_t width = (size_t)(ply_first[k + 1] - ply_first[k]);
        if ((k == PLY_COLOR && p->tinted) || (k == PLY_PLACE && p->placed)) continue;
        for (size_t i = 0; i < p->corner.count && from->count; i++) {
            if (mesh_push(&spread, from->v + width * p->corner.v[i], width)) {
                free(spread.v);
                return mesh_fail(r, "out of memory");
            }
        }
        free(from->v);
        *from = spread;
    }
    if (!p->placed) return 0;
    free(p->column[PLY_PLACE].v);
    p->column[PLY_PLACE] = p->place;
    memset(&p->place, 0, sizeof p->place);
    for (size_t i = 1; i < p->column[PLY_PLACE].count; i += 2)
        p->column[PLY_PLACE].v[i] = 1 - p->column[PLY_PLACE].v[i];
    return 0;
}

static inline float *ply_take(ply_data *p, int column)
{
    float *v = p->column[column].v;
    p->column[column].v = NULL;
    return v;
}

static inline int ply_finish(mesh_reader *r, ply_data *p, model *out)
{
    size_t n = p->column->count / 3;
    const float bright = (float)(1 / ply_white(p));
    owned_mesh *m = &out->mesh;
    int missing = 1, has_faces = 0;
    for (int k = 0; k < p->elements; k++)
        has_faces |= p->element[k].kind >= PLY_FACE && p->element[k].count > 0;
    if (!p->faces.triangles && (!n || has_faces))
        return known_nothing(
            r, out, n ? "no face of it has three corners" : "neither vertices nor faces in it");
    if (p->highest >= (double)n)
        return mesh_fail(r, "there is no vertex %lu", (unsigned long)p->highest);
    if (p->corner.count && ply_spread(r, p)) return 1;
    n = p->column->count / 3;
    m->positions = ply_take(p, PLY_POSITION);
    m->colors = ply_take(p, PLY_COLOR);
    for (size_t i = 0; m->colors && i < n; i++) {
        float *c = m->colors + 3 * i;
        shade_vec3 seen = shade_scale(shade_v3(c[0], c[1], c[2]), bright);
        seen = shade_linear_from_srgb(seen);
        memcpy(c, &seen, sizeof seen);
    }
    model_placed(out, &p->origin);
    if ((p->clear || p->least < p->most || p->least < 1) &&
        known_take(r, out, KNOWN_TOLD, 0, p->alpha, strlen(p->alpha)))
        return 1;
    for (int k = 0; k < SPLAT_VALUES && (has_faces || !ply_has(p, PLY_SPLAT)); k++)
        if (p->has[PLY_OPACITY + k] &&
            known_take(r, out, KNOWN_TOLD, 0, ply_splat_names[k], strlen(ply_splat_names[k])))
            return 1;
    if (!has_faces && ply_has(p, PLY_SPLAT))
        return points_splats(r, out, n, p->column[PLY_SPLAT].v);
    if (!has_faces) return points_finish(r, out, n);
    m->texcoords = ply_take(p, PLY_PLACE);
    m->normals = ply_take(p, PLY_NORMAL);
    if (m->normals)
        missing = 0;
    else
        m->normals = (float *)calloc(n, 3 * sizeof(float));
    if (!m->normals) return mesh_fail(r, "out of memory");
    for (size_t i = 0; i < 3 * n && !missing; i += 3)
        missing = m->normals[i] == 0 && m->normals[i + 1] == 0 && m->normals[i + 2] == 0;
    if (faces_finish(r, &p->faces, out, n)) return 1;
    mesh_link(m, (int)n, 3 * (int)p->faces.triangles);
    out->normals_given = !missing;
    return missing && mesh_fill_normals(m, 0) ? mesh_fail(r, "out of memory") : 0;
}

static inline int ply_read(mesh_reader *r, model *m)
{
    ply_data *p = (ply_data *)calloc(1, sizeof *p);
    int failed;
    if (!p) return mesh_fail(r, "out of memory");
    model_place(m, &p->origin);
    p->least = 1e300;
    p->most = -1e300;
    failed = ply_read_header(r, p, m) || ply_read_body(r, p, m) || ply_finish(r, p, m);
    for (int k = 0; k < PLY_COLUMNS; k++) free(p->column[k].v);
    free(p->corner.v);
    free(p->place.v);
    free(p->list.v);
    faces_free(&p->faces);
    free(p);
    return failed;
}
#endif
