/* obj.h - reads OBJ: v (with optional w or red green blue, or #MRGB of ZBrush), vt, vn and f, every
   form of index (v, v/vt, v//vn, v/vt/vn, negative ones count back from the last), polygons of any
   shape, l where lines are wanted, usemtl, mtllib, o and g, continued lines, comments, any line
   ends.  obj_known has the other statements.  One vertex is made for each different v/vt/vn. */
#ifndef MODEL_OBJ_H
#define MODEL_OBJ_H

#include "faces.h"
#include "points.h"

/* Statements.  Those about curves change nothing but curves, which are told. */
static const known_name obj_known[] = {
    { "v", KNOWN_DRAWN },          { "vt", KNOWN_DRAWN },      { "vn", KNOWN_DRAWN },
    { "f", KNOWN_DRAWN },          { "o", KNOWN_DRAWN },       { "g", KNOWN_DRAWN },
    { "usemtl", KNOWN_DRAWN },     { "mtllib", KNOWN_DRAWN },  { "s", KNOWN_SILENT },
    { "vp", KNOWN_SILENT },        { "mg", KNOWN_SILENT },     { "deg", KNOWN_SILENT },
    { "bmat", KNOWN_SILENT },      { "step", KNOWN_SILENT },   { "cstype", KNOWN_SILENT },
    { "parm", KNOWN_SILENT },      { "trim", KNOWN_SILENT },   { "hole", KNOWN_SILENT },
    { "scrv", KNOWN_SILENT },      { "sp", KNOWN_SILENT },     { "end", KNOWN_SILENT },
    { "con", KNOWN_SILENT },       { "bevel", KNOWN_SILENT },  { "c_interp", KNOWN_SILENT },
    { "d_interp", KNOWN_SILENT },  { "lod", KNOWN_SILENT },    { "ctech", KNOWN_SILENT },
    { "stech", KNOWN_SILENT },     { "maplib", KNOWN_SILENT }, { "shadow_obj", KNOWN_SILENT },
    { "trace_obj", KNOWN_SILENT }, { "usemap", KNOWN_TOLD },   { "p", KNOWN_TOLD },
    { "l", KNOWN_DRAWN },          { "curv", KNOWN_TOLD },     { "curv2", KNOWN_TOLD },
    { "surf", KNOWN_TOLD },        { "call", KNOWN_TOLD },     { "csh", KNOWN_TOLD },
    { NULL, KNOWN_TOLD }
};

enum { OBJ_V, OBJ_VT, OBJ_VN };
static const char *const obj_names[3] = { "v", "vt", "vn" };

/* A corner, its hash, and where in the stream of faces its number goes */
enum { OBJ_WAITING = 64 };
typedef struct obj_corner_place {
    mesh_triple corner;
    uint64_t hash;
    size_t place;
} obj_corner_place;

typedef struct obj_data {
    mesh_floats list[3], color; /* color: of the first so many v, NAN where there is none, as the
                                   file has it and at the end in linear light; empty: none */
    mesh_floats painted;        /* colours of ZBrush for as many v before them */
    float bright;               /* the greatest of color */
    float clearest;             /* the least number behind them, which is alpha */
    mesh_origin origin;
    mesh_set corners; /* v, vt, vn, counted from 1; 0: absent */
    faces faces;
    mesh_uints lines; /* three for each: two numbers of v, and the surface from 1 on, or 0 */
    uint32_t surface; /* of the lines that come, counted so */
    obj_corner_place waiting[OBJ_WAITING]; /* corners that corners does not have yet */
    size_t waits;
    int has_objects;     /* an o was read: groups do not count */
    uint32_t highest[3]; /* index used so far, and where: it may be defined later */
    long long highest_line[3];
} obj_data;

/* v, vt or vn: numbers wanted, as many as allowed are taken */
static inline int obj_numbers(mesh_reader *r, double *out, int wanted, int allowed, int *count)
{
    for (*count = 0; *count < allowed; ++*count) {
        mesh_skip_blanks(r, 1);
        if (*count >= wanted && mesh_at_word_end(r)) break;
        if (mesh_take_coordinate(r, &out[*count])) return 1;
    }
    return 0;
}

/* The first so many numbers of v have colours, or NAN where there are none. */
static inline int obj_color_to(mesh_reader *r, obj_data *o, size_t count)
{
    static const float none[3] = { NAN, NAN, NAN };
    while (o->color.count < count)
        if (mesh_push(&o->color, none, 3)) return mesh_fail(r, "out of memory");
    return 0;
}

/* #MRGB in comments of ZBrush: eight digits of base 16 for each v, of which the first two are a
   mask */
static inline int obj_comment(mesh_reader *r, obj_data *o)
{
    if (!mesh_take_word(r, "#mrgb")) return 0;
    for (mesh_skip_blanks(r, 0); mesh_hex(r->at, r->end, 8) >= 0; r->at += 8) {
        float rgb[3];
        for (int k = 0; k < 3; k++) rgb[k] = (float)mesh_hex(r->at + 2 + 2 * k, r->end, 2) / 255;
        if (mesh_push(&o->painted, rgb, 3)) return mesh_fail(r, "out of memory");
    }
    return 0;
}

/* Gives the last v the colours that stand in comments behind them. */
static inline int obj_paint(mesh_reader *r, obj_data *o, model *m)
{
    const size_t n = o->painted.count, all = o->list[OBJ_V].count;
    o->painted.count = 0;
    if (!n) return 0;
    if (o->color.count + n > all) return known_take(r, m, KNOWN_TOLD, 0, "#MRGB", 5);
    o->bright = fmaxf(o->bright, 1);
    if (obj_color_to(r, o, all - n)) return 1;
    for (size_t i = 0; i < n; i += 3)
        if (mesh_push(&o->color, o->painted.v + i, 3)) return mesh_fail(r, "out of memory");
    return 0;
}

static inline int obj_vertex(mesh_reader *r, obj_data *o, model *m)
{
    double v[7];
    float place[3], rgb[3];
    int count;
    if (obj_paint(r, o, m) || obj_numbers(r, v, 3, 7, &count)) return 1;
    mesh_relative(&o->origin, v, place);
    for (int k = 0; k < 3 && count >= 6; k++) {
        rgb[k] = mesh_or_zero(v[3 + k]);
        o->bright = fmaxf(o->bright, rgb[k]);
    }
    if (count == 7) o->clearest = fminf(o->clearest, mesh_or_zero(v[6]));
    if (count >= 6 && obj_color_to(r, o, o->list[OBJ_V].count)) return 1;
    if (count >= 6 && mesh_push(&o->color, rgb, 3)) return mesh_fail(r, "out of memory");
    if (mesh_push(&o->list[OBJ_V], place, 3)) return mesh_fail(r, "out of memory");
    return 0;
}

static inline int obj_texcoord(mesh_reader *r, obj_data *o)
{
    double v[3] = { 0, 0, 0 };
    int count;
    float uv[2];
    if (obj_numbers(r, v, 1, 3, &count)) return 1;
    uv[0] = mesh_or_zero(v[0]);
    uv[1] = 1 - mesh_or_zero(v[1]); /* OBJ counts v upward, shade.h downward */
    return mesh_push(&o->list[OBJ_VT], uv, 2) ? mesh_fail(r, "out of memory") : 0;
}

static inline int obj_normal(mesh_reader *r, obj_data *o)
{
    double v[3];
    float n[3];
    int count;
    if (obj_numbers(r, v, 3, 3, &count)) return 1;
    mesh_normal(v, n);
    return mesh_push(&o->list[OBJ_VN], n, 3) ? mesh_fail(r, "out of memory") : 0;
}

/* Reads one index of a corner; *out counts from 1. */
static inline int obj_index(mesh_reader *r, obj_data *o, int kind, uint32_t *out)
{
    long long count = (long long)(o->list[kind].count / (kind == OBJ_VT ? 2 : 3)), value = 0;
    mesh_reader begin = *r;
    int negative = r->at < r->end && *r->at == '-';
    r->at += negative;
    for (; r->at < r->end && *r->at >= '0' && *r->at <= '9'; r->at++)
        if (value <= INT_MAX) value = value * 10 + (*r->at - '0');
    if (negative) value = count + 1 - value;
    if (r->at == begin.at + negative)
        return mesh_fail(&begin, "expected an index, found %s", mesh_here(&begin).text);
    if (value < 1 || value > INT_MAX || (negative && value > count))
        return mesh_fail(&begin, "index %s is out of range: %lld %s stand before it",
                         mesh_here(&begin).text, count, obj_names[kind]);
    *out = (uint32_t)value;
    if (*out > o->highest[kind]) {
        o->highest[kind] = *out;
        o->highest_line[kind] = r->line;
    }
    return 0;
}

/* Numbers the corners that wait: until now memory has fetched what that takes. */
static inline int obj_number(mesh_reader *r, obj_data *o)
{
    int failed = !o->corners.slots && mesh_set_reserve(&o->corners, o->list[OBJ_V].count / 3 + 1);
    for (size_t i = 0; i < o->waits && !failed; i++) {
        const obj_corner_place *w = &o->waiting[i];
        failed = mesh_set_put(&o->corners, w->corner, w->hash, &o->faces.stream.v[w->place]);
    }
    o->waits = 0;
    return failed ? mesh_fail(r, "out of memory") : 0;
}

static inline int obj_corner(mesh_reader *r, obj_data *o)
{
    obj_corner_place *w = &o->waiting[o->waits];
    mesh_triple corner = { { 0, 0, 0 } };
    for (int kind = OBJ_V; kind <= OBJ_VN; kind++) {
        int absent = kind && (mesh_at_word_end(r) || *r->at == '/');
        if (!absent && obj_index(r, o, kind, &corner.k[kind])) return 1;
        if (r->at == r->end || *r->at != '/' || kind == OBJ_VN) break;
        r->at++;
    }
    if (!mesh_at_word_end(r)) return mesh_fail(r, "expected v/vt/vn, found %s", mesh_here(r).text);
    w->corner = corner;
    w->hash = mesh_hash(corner);
    w->place = o->faces.stream.count;
    if (o->corners.slots) MESH_FETCH(&o->corners.slot[w->hash & (o->corners.slots - 1)]);
    if (faces_corner(&o->faces, 0)) return mesh_fail(r, "out of memory");
    return ++o->waits == OBJ_WAITING ? obj_number(r, o) : 0;
}

static inline int obj_face(mesh_reader *r, obj_data *o)
{
    size_t corners = 0;
    if (faces_begin(&o->faces)) return mesh_fail(r, "out of memory");
    for (mesh_skip_blanks(r, 1); !mesh_at_word_end(r); mesh_skip_blanks(r, 1), corners++)
        if (obj_corner(r, o)) return 1;
    /* places move where a face is dropped, or is the first with more than three corners */
    if ((corners < 3 || (corners > 3 && !o->faces.mixed)) && obj_number(r, o)) return 1;
    /* drops faces of fewer than three corners, which real files have */
    if (faces_end(&o->faces)) return mesh_fail(r, "out of memory");
    return mesh_check_triangles(r, o->faces.triangles);
}

/* A line through vertices, whose texture coordinates do not count */
static inline int obj_line(mesh_reader *r, obj_data *o, model *m)
{
    uint32_t last = 0, next = 0;
    if (!m->lines_wanted) {
        model_leave_out(m, r->name, "its lines");
        return 0;
    }
    for (mesh_skip_blanks(r, 1); !mesh_at_word_end(r); mesh_skip_blanks(r, 1)) {
        if (obj_index(r, o, OBJ_V, &next)) return 1;
        while (!mesh_at_word_end(r)) r->at++;
        if (last && mesh_push_triangle(&o->lines, last, next, o->surface))
            return mesh_fail(r, "out of memory");
        last = next;
    }
    return 0;
}

/* usemtl and mtllib: a name to the end of the line, which may have spaces */
static inline int obj_surface(mesh_reader *r, obj_data *o, model *m)
{
    const unsigned char *begin = mesh_take_line(r);
    int none = !m->surface_count && o->faces.stream.count && model_find_surface(m, "", 0, 1) < 0;
    int surface = none ? -1 : model_find_surface(m, begin, (size_t)(r->at - begin), 1);
    if (surface < 0) return mesh_fail(r, "out of memory, or more than 10000 materials");
    o->surface = (uint32_t)surface + 1;
    return faces_surface(&o->faces, surface) ? mesh_fail(r, "out of memory") : 0;
}

/* o and g: a name to the end of the line.  Groups are objects where the file has no o. */
static inline int obj_object(mesh_reader *r, obj_data *o, model *m, int is_object)
{
    const unsigned char *begin = mesh_take_line(r);
    int object;
    if (!is_object && o->has_objects) return 0;
    if (is_object) o->has_objects = 1;
    if (!m->object_count && o->faces.stream.count && model_find_object(m, "", 0) < 0)
        return mesh_fail(r, "out of memory");
    object = model_find_object(m, begin, (size_t)(r->at - begin));
    if (object < 0 || faces_object(&o->faces, object)) return mesh_fail(r, "out of memory");
    return 0;
}

static inline int obj_library(mesh_reader *r, model *m)
{
    const unsigned char *begin = mesh_take_line(r);
    if (m->library_count >= 100 || r->at == begin) return 0;
    return model_add_library(m, begin, (size_t)(r->at - begin)) ? mesh_fail(r, "out of memory") : 0;
}

static inline int obj_statement(mesh_reader *r, obj_data *o, model *m)
{
    if (mesh_take_word(r, "v")) return obj_vertex(r, o, m);
    if (mesh_take_word(r, "vt")) return obj_texcoord(r, o);
    if (mesh_take_word(r, "vn")) return obj_normal(r, o);
    if (mesh_take_word(r, "f")) return obj_face(r, o);
    if (mesh_take_word(r, "l")) return obj_line(r, o, m);
    if (mesh_take_word(r, "usemtl")) return obj_surface(r, o, m);
    if (mesh_take_word(r, "mtllib")) return obj_library(r, m);
    if (mesh_take_word(r, "o")) return obj_object(r, o, m, 1);
    if (mesh_take_word(r, "g")) return obj_object(r, o, m, 0);
    return known_word(r, m, obj_known);
}

static inline int obj_no_faces(mesh_reader *r, const obj_data *o)
{
    r->line = 0;
    return mesh_fail(r, o->list[OBJ_V].count ? "no faces in it"
                                             : "is no OBJ: it has neither vertices nor faces");
}

/* Brings the colours to linear light; they are sRGB values from 0 to 1, or to 255 where one is
   brighter than any light of 1 would be. */
static inline void obj_light(mesh_reader *r, obj_data *o, model *out)
{
    const float white = o->bright > 2 ? 255 : 1;
    if (o->clearest < white) known_take(r, out, KNOWN_TOLD, 0, "alpha", 5);
    for (size_t i = 0; i < o->color.count; i += 3) {
        float *c = o->color.v + i;
        const shade_vec3 seen = shade_v3(c[0] / white, c[1] / white, c[2] / white);
        const int none = !(c[0] <= FLT_MAX);
        const shade_vec3 light = none ? shade_v3(1, 1, 1) : shade_linear_from_srgb(seen);
        memcpy(c, &light, sizeof light);
    }
}

/* Vertices of a file without a single corner */
static inline int obj_points(mesh_reader *r, const obj_data *o, model *out)
{
    const size_t n = o->list[OBJ_V].count / 3;
    owned_mesh *m = &out->mesh;
    if (!strcmp(out->unread, "p")) out->unread[0] = 0; /* the points are drawn */
    r->line = 0;
    m->positions = (float *)malloc(3 * sizeof(float) * n);
    if (o->color.count) m->colors = (float *)malloc(3 * sizeof(float) * n);
    if (!m->positions || (o->color.count && !m->colors)) return mesh_fail(r, "out of memory");
    memcpy(m->positions, o->list[OBJ_V].v, 3 * sizeof(float) * n);
    for (size_t i = 0; m->colors && i < 3 * n; i++)
        m->colors[i] = i < o->color.count ? o->color.v[i] : 1;
    model_placed(out, &o->origin);
    return points_finish(r, out, n);
}

/* The lines, each with the mean colour of its ends */
static inline int obj_join(mesh_reader *r, const obj_data *o, model *out)
{
    for (size_t i = 0; i < o->lines.count; i += 3) {
        const uint32_t *line = o->lines.v + i;
        const float *end[2];
        shade_vec3 color[2];
        for (int k = 0; k < 2; k++) {
            const size_t at = 3 * ((size_t)line[k] - 1);
            const float *c = o->color.v + at;
            end[k] = o->list[OBJ_V].v + at;
            color[k] = at < o->color.count ? shade_v3(c[0], c[1], c[2]) : shade_v3(1, 1, 1);
        }
        if (model_add_line(out, end[0], end[1], shade_lerp(color[0], color[1], 0.5f),
                           (int)line[2] - 1))
            return mesh_fail(r, "out of memory");
    }
    return 0;
}

/* Faces may name texture coordinates or normals that the file does not have: those corners do
   without.  VTK counts vt on over parts that have none. */
static inline void obj_forget(obj_data *o, int kind, size_t count, model *out, const char *name)
{
    char text[120];
    for (size_t i = 0; i < o->corners.count; i++) {
        uint32_t *index = &o->corners.triple[i].k[kind];
        if (*index > count) *index = 0;
    }
    o->highest[kind] = (uint32_t)count;
    if (count)
        snprintf(text, sizeof text, "faces name a %s past the last of %lu: they do without",
                 obj_names[kind], (unsigned long)count);
    else
        snprintf(text, sizeof text, "faces name a %s, and the file has none: they do without",
                 obj_names[kind]);
    model_warn(out, name, text);
}

/* Makes a vertex for each different corner that was read. */
static inline int obj_finish(mesh_reader *r, obj_data *o, model *out)
{
    owned_mesh *m = &out->mesh;
    size_t n;
    int missing = 0;
    if (obj_number(r, o) || obj_paint(r, o, out)) return 1;
    obj_light(r, o, out);
    n = o->corners.count;
    if (!n && o->list[OBJ_V].count && !o->lines.count) return obj_points(r, o, out);
    if (!o->faces.triangles && !o->lines.count) return obj_no_faces(r, o);
    for (int k = 0; k < 3; k++) {
        const size_t count = o->list[k].count / (k == OBJ_VT ? 2 : 3);
        if (o->highest[k] <= count) continue;
        if (k != OBJ_V) obj_forget(o, k, count, out, r->name);
        if (k != OBJ_V) continue;
        r->line = o->highest_line[k];
        return mesh_fail(r, "there is no %s number %lu: the file has %lu", obj_names[k],
                         (unsigned long)o->highest[k], (unsigned long)count);
    }
    if (obj_join(r, o, out)) return 1;
    if (!o->faces.triangles) {
        model_placed(out, &o->origin);
        return 0;
    }
    m->positions = (float *)malloc(3 * sizeof(float) * n);
    m->normals = (float *)calloc(n, 3 * sizeof(float));
    if (o->highest[OBJ_VT]) m->texcoords = (float *)calloc(n, 2 * sizeof(float));
    if (o->color.count) m->colors = (float *)malloc(3 * sizeof(float) * n);
    if (!m->positions || !m->normals || (o->highest[OBJ_VT] && !m->texcoords) ||
        (o->color.count && !m->colors))
        return mesh_fail(r, "out of memory");
    for (size_t i = 0; i < n; i++) {
        const uint32_t *k = o->corners.triple[i].k;
        size_t v = 3 * ((size_t)k[OBJ_V] - 1);
        memcpy(m->positions + 3 * i, o->list[OBJ_V].v + v, 3 * sizeof(float));
        for (size_t c = 0; m->colors && c < 3; c++)
            m->colors[3 * i + c] = v + c < o->color.count ? o->color.v[v + c] : 1;
        if (k[OBJ_VT])
            memcpy(m->texcoords + 2 * i, o->list[OBJ_VT].v + 2 * ((size_t)k[OBJ_VT] - 1), 8);
        if (k[OBJ_VN])
            memcpy(m->normals + 3 * i, o->list[OBJ_VN].v + 3 * ((size_t)k[OBJ_VN] - 1), 12);
        missing |=
            m->normals[3 * i] == 0 && m->normals[3 * i + 1] == 0 && m->normals[3 * i + 2] == 0;
    }
    if (out->surface_count && !out->library_count && out->surface[out->surface_count - 1].name[0])
        model_warn(out, r->name, "it names materials, and no library of them");
    if (faces_finish(r, &o->faces, out, n)) return 1;
    mesh_link(m, (int)n, 3 * (int)o->faces.triangles);
    model_placed(out, &o->origin);
    out->normals_given = !missing;
    return missing && mesh_fill_normals(m, 0) ? mesh_fail(r, "out of memory") : 0;
}

/* FreeCAD, whose world has z upward, names itself in the first line of its OBJ. */
static inline int obj_is_freecad(const mesh_reader *r)
{
    for (const unsigned char *p = r->at; r->end - p >= 7 && !mesh_line_end(r, p); p++)
        if (!memcmp(p, "FreeCAD", 7)) return *r->at == '#';
    return 0;
}

static inline int obj_read(mesh_reader *r, model *m)
{
    static const obj_data empty;
    obj_data o = empty;
    int failed = 0;
    o.clearest = FLT_MAX;
    model_place(m, &o.origin);
    m->z_up = m->up_told = obj_is_freecad(r);
    for (size_t i = 0; r->at < r->end && !failed; i++) {
        int comment;
        mesh_skip_blanks(r, 1);
        comment = r->at < r->end && *r->at == '#';
        failed = mesh_tell(r, i);
        if (!failed) failed = comment ? obj_comment(r, &o) : obj_statement(r, &o, m);
        if (!failed) mesh_next_line(r, !comment && !(r->at < r->end && *r->at == '#'));
    }
    if (!failed) failed = obj_finish(r, &o, m);
    for (int k = 0; k < 3; k++) free(o.list[k].v);
    free(o.color.v);
    free(o.painted.v);
    free(o.lines.v);
    mesh_set_free(&o.corners);
    faces_free(&o.faces);
    return failed;
}
#endif
