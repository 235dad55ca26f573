/* section.h - cuts a model open by a plane across an axis of its file, and fills and hatches the
   cut.

   Triangles are clipped, and each of those that the plane crosses leaves a piece of the cut's
   outline.  The cut is filled in rows along the lines of the hatch, between the heights at which
   pieces of the outline begin and end: in a row no two pieces cross, and the part lies where they
   wind around a point.  Meshes with holes or turned both ways are filled between every second
   pair of crossings, sheets are not; a line says so. */
#ifndef MODEL_SECTION_H
#define MODEL_SECTION_H

#include "../read/read.h"
#include "cut.h"

enum {
    SECTION_LINES = 24,         /* of the hatch across the model */
    SECTION_CROSSINGS = 2000000 /* as in cut_rows */
};
#define SECTION_DARK 0.28 /* the part of a row of the hatch that is drawn dark */

/* The model as it becomes; value: positions, normals, texture coordinates, colours */
typedef struct section {
    const model *from;
    int axis, failed;
    double sign, where;     /* cut away is what has sign (coordinate - where) > 0 */
    double low[3], high[3]; /* the box around the model */
    mesh_floats value[4];
    mesh_uints index, object, fill[2]; /* fill: the triangles of the cut, plain and dark */
    uint32_t *place;                   /* the new number of each vertex, from 1 on; 0: none yet */
    cut_outline outline;               /* along the hatch and across it */
    double spacing;                    /* of the lines of the hatch */
    model_part *part;
    int parts;
} section;

static const size_t section_width[4] = { 3, 3, 2, 3 };

static inline const float *section_value(const owned_mesh *m, int k)
{
    return k == 0 ? m->positions : k == 1 ? m->normals : k == 2 ? m->texcoords : m->colors;
}

static inline uint32_t section_count(const section *s) { return (uint32_t)s->value[0].count / 3; }

/* ---- clipping -------------------------------------------------------------------------------- */

/* How far a vertex lies beyond the plane */
static inline double section_beyond(const section *s, uint32_t i)
{
    const float at = s->from->mesh.positions[3 * (size_t)i + (size_t)s->axis];
    return s->sign * ((double)at - s->where);
}

/* The number of a vertex that stays */
static inline uint32_t section_keep(section *s, uint32_t i)
{
    if (s->place[i]) return s->place[i] - 1;
    for (int k = 0; k < 4; k++) {
        const float *v = section_value(&s->from->mesh, k);
        const size_t n = section_width[k];
        if (v) s->failed |= mesh_push(&s->value[k], v + n * i, n);
    }
    s->place[i] = section_count(s);
    return s->place[i] - 1;
}

/* The number of a new vertex, where the edge from a kept vertex to one beyond meets the plane.
   Both triangles at the edge find the same bits. */
static inline uint32_t section_meet(section *s, uint32_t kept, uint32_t beyond)
{
    const double a = section_beyond(s, kept), b = section_beyond(s, beyond), t = a / (a - b);
    for (int k = 0; k < 4; k++) {
        const float *v = section_value(&s->from->mesh, k);
        const size_t n = section_width[k];
        float mixed[3] = { 0, 0, 0 };
        for (size_t i = 0; i < n && v; i++) {
            const double from = (double)v[n * kept + i], to = (double)v[n * beyond + i];
            mixed[i] = (float)(from + (to - from) * t);
        }
        if (!k) mixed[s->axis] = (float)s->where;
        if (v) s->failed |= mesh_push(&s->value[k], mixed, n);
    }
    return section_count(s) - 1;
}

/* A point of the plane, along the hatch and across it */
static inline void section_flatten(const section *s, uint32_t i, double out[2])
{
    const float *p = s->value[0].v + 3 * (size_t)i;
    const double u = (double)p[(s->axis + 1) % 3], v = (double)p[(s->axis + 2) % 3];
    out[0] = v + u;
    out[1] = v - u;
}

/* Adds a part of the outline, with the solid always on the same side. */
static inline void section_outline(section *s, uint32_t from, uint32_t to)
{
    cut_outline *o = &s->outline;
    cut_edge *grown;
    double begin[2], end[2];
    if (s->failed) return;
    section_flatten(s, from, begin);
    section_flatten(s, to, end);
    grown = (cut_edge *)mesh_grow(o->edge, o->edges, &o->room, sizeof *grown);
    s->failed |= !grown;
    if (!grown) return;
    o->edge = grown;
    cut_piece(&grown[o->edges++], begin, end);
}

/* Adds what stays of a triangle. */
static inline void section_triangle(section *s, const uint32_t *corner)
{
    int out[3], count = 0, alone = 0;
    uint32_t a, b, c, first, second;
    for (int k = 0; k < 3; k++) count += out[k] = section_beyond(s, corner[k]) > 0;
    if (count == 3) return;
    while (count && out[alone] != (count == 1)) alone++; /* the corner that is alone on its side */
    a = corner[alone];
    b = corner[(alone + 1) % 3];
    c = corner[(alone + 2) % 3];
    if (!count) {
        a = section_keep(s, a);
        b = section_keep(s, b);
        s->failed |= mesh_push_triangle(&s->index, a, b, section_keep(s, c));
    } else if (count == 2) {
        first = section_meet(s, a, b);
        second = section_meet(s, a, c);
        s->failed |= mesh_push_triangle(&s->index, section_keep(s, a), first, second);
        section_outline(s, first, second);
    } else {
        first = section_meet(s, b, a);
        second = section_meet(s, c, a);
        b = section_keep(s, b);
        c = section_keep(s, c);
        s->failed |= mesh_push_triangle(&s->index, first, b, c) ||
                     mesh_push_triangle(&s->index, first, c, second);
        section_outline(s, second, first);
    }
}

/* Clips all parts, of which those stay that are not empty.  Non-zero: out of memory */
static inline int section_clip(section *s)
{
    const model *m = s->from;
    s->place = (uint32_t *)calloc((size_t)m->mesh.view.vertex_count + 1, sizeof *s->place);
    s->part = (model_part *)calloc((size_t)m->part_count + 2, sizeof *s->part);
    if (!s->place || !s->part) return 1;
    for (int i = 0; i < m->part_count && !s->failed; i++) {
        const model_part *part = &m->part[i];
        model_part *kept = &s->part[s->parts];
        *kept = (model_part){ (int)s->index.count, 0, part->surface, 0, 0 };
        for (int t = part->first; t < part->first + part->count && !s->failed; t += 3) {
            section_triangle(s, m->mesh.indices + t);
            while (m->object && 3 * s->object.count < s->index.count && !s->failed)
                s->failed |= mesh_push_uint(&s->object, m->object[t / 3]);
        }
        kept->count = (int)s->index.count - kept->first;
        s->parts += kept->count > 0;
        if (s->index.count > INT_MAX / 2) s->failed = 1;
    }
    return s->failed;
}

/* ---- filling --------------------------------------------------------------------------------- */

/* Adds a point of the cut, whose place in the plane is along and across the hatch. */
static inline uint32_t section_point(section *s, double along, double across)
{
    const int u = (s->axis + 1) % 3, v = (s->axis + 2) % 3;
    float value[4][3] = { { 0, 0, 0 }, { 0, 0, 0 }, { 0, 0, 0 }, { 1, 1, 1 } };
    value[0][s->axis] = (float)s->where;
    value[0][u] = (float)fmin(s->high[u], fmax(s->low[u], (along - across) / 2));
    value[0][v] = (float)fmin(s->high[v], fmax(s->low[v], (along + across) / 2));
    value[1][s->axis] = (float)s->sign;
    for (int k = 0; k < 4; k++)
        if (section_value(&s->from->mesh, k))
            s->failed |= mesh_push(&s->value[k], value[k], section_width[k]);
    return section_count(s) - 1;
}

/* Adds the quadrangle between two crossings of a row, dark or plain.  Rows reach a little over each
   other, so that no pixel falls between them. */
static inline int section_between(void *user, const cut_crossing *c, const double *height)
{
    section *s = (section *)user;
    const double middle = (height[0] + height[1]) / 2 / s->spacing;
    const double low = height[0] - 2e-4 * s->spacing, high = height[1];
    const uint32_t a = section_point(s, c[0].low, low), b = section_point(s, c[1].low, low);
    const uint32_t d = section_point(s, c[1].high, high), e = section_point(s, c[0].high, high);
    mesh_uints *to = &s->fill[middle - floor(middle) < SECTION_DARK];
    s->failed |= s->sign > 0 ? mesh_push_triangle(to, a, b, d) || mesh_push_triangle(to, a, d, e)
                             : mesh_push_triangle(to, a, d, b) || mesh_push_triangle(to, a, e, d);
    return s->failed;
}

/* Fills the cut.  Non-zero: out of memory */
static inline int section_fill(section *s)
{
    size_t rows = 0;
    double *height;
    if (!s->outline.edges) return 0;
    height = cut_rows(&s->outline, s->spacing, SECTION_DARK, SECTION_CROSSINGS, &rows);
    s->failed |= !height || cut_fill(&s->outline, height, rows, 0, section_between, s);
    free(height);
    return s->failed;
}

/* ---- the model ------------------------------------------------------------------------------- */

/* Adds the two surfaces of the cut, the first of which is that of the options.  Returns the first's
   number, or -1 where memory is out. */
static inline int section_surfaces(model *m, const model_options *o)
{
    const int whole = m->surface_count ? 0 : model_add_surface(m, "", 0);
    const int plain = whole < 0 ? -1 : model_add_surface(m, "section", 7);
    const int dark = plain < 0 ? -1 : model_add_surface(m, "hatch", 5);
    model_surface *s;
    if (dark < 0) return -1;
    m->surface[plain].section = 1;
    s = &m->surface[dark];
    s->section = s->set = 1;
    s->material = o->material;
    s->material.ambient = shade_scale(s->material.ambient, 0.25f);
    s->material.diffuse = shade_scale(s->material.diffuse, 0.25f);
    return plain;
}

/* Adds the triangles of the cut as two parts.  Non-zero: out of memory */
static inline int section_join(section *s, model *m, const model_options *o)
{
    const int plain = section_surfaces(m, o);
    const int object = m->object ? model_add_object(m, "section", 7) : 0;
    if (plain < 0 || object < 0) return 1;
    for (int k = 0; k < 2; k++) {
        const int first = (int)s->index.count, count = (int)s->fill[k].count;
        if (count) s->part[s->parts++] = (model_part){ first, count, plain + k, 0, 0 };
        for (size_t i = 0; i < s->fill[k].count && !s->failed; i++)
            s->failed |= mesh_push_uint(&s->index, s->fill[k].v[i]);
        while (m->object && 3 * s->object.count < s->index.count && !s->failed)
            s->failed |= mesh_push_uint(&s->object, (uint32_t)object);
    }
    return s->failed || s->index.count > INT_MAX / 2;
}

/* Clips the lines. */
static inline void section_lines(const section *s, model *m)
{
    size_t kept = 0;
    for (size_t i = 0; i < m->line_count; i++) {
        model_line line = m->line[i];
        float at[2][3];
        double out[2];
        memcpy(at, line.end, sizeof at);
        for (int k = 0; k < 2; k++) out[k] = s->sign * ((double)at[k][s->axis] - s->where);
        if (out[0] > 0 && out[1] > 0) continue;
        for (int k = 0; k < 2; k++)
            if (out[k] > 0)
                line.end[k] = shade_lerp(line.end[k], line.end[1 - k],
                                         (float)(out[k] / (out[k] - out[1 - k])));
        m->line[kept++] = line;
    }
    m->line_count = kept;
}

/* Hands the arrays over to the model; the old ones become those of the section. */
static inline void section_hand_over(section *s, model *m)
{
    static const owned_mesh empty;
    const int indices = (int)s->index.count, vertices = (int)section_count(s);
    mesh_free(&m->mesh);
    free(m->part);
    free(m->object);
    m->mesh = empty;
    m->mesh.positions = s->value[0].v;
    m->mesh.normals = s->value[1].v;
    m->mesh.texcoords = s->value[2].v;
    m->mesh.colors = s->value[3].v;
    m->mesh.indices = s->index.v;
    mesh_link(&m->mesh, vertices, indices);
    m->part = s->part;
    m->part_count = s->parts;
    m->object = s->object.v;
    for (int k = 0; k < 4; k++) s->value[k].v = NULL;
    s->index.v = s->object.v = NULL;
    s->part = NULL;
}

static inline void section_free(section *s)
{
    for (int k = 0; k < 4; k++) free(s->value[k].v);
    for (int k = 0; k < 2; k++) free(s->fill[k].v);
    free(s->index.v);
    free(s->object.v);
    free(s->place);
    free(s->outline.edge);
    free(s->part);
}

/* The way of an axis of the file toward an eye, which sees the model upright and turned; where the
   eye looks along the plane, toward who sees front, right and top. */
static inline double section_side(int axis, int up, float turn, shade_vec3 eye)
{
    const double at[3] = { (double)eye.x, (double)eye.y, (double)eye.z };
    double row[3][3], sum = 0, plain = 0;
    upright_rows(up, turn, row);
    for (int i = 0; i < 3; i++) sum += row[i][axis] * at[i];
    upright_rows(up, 0, row);
    for (int i = 0; i < 3; i++) plain += row[i][axis];
    return (fabs(sum) > 0.01 ? sum : plain) < 0 ? -1 : 1;
}

/* Cuts a model by the plane of a section, of which from, axis, sign, where and the box are set.
   Non-zero: out of memory */
static inline int section_cut(section *s, model *m, const model_options *o)
{
    double extent = 0;
    int state = 0, failed = !m->normals_given && mesh_crease(&m->mesh, 0, CREASE_40_DEGREES);
    m->normals_given = 1;
    for (int i = 0; i < 3; i++) extent = fmax(extent, s->high[i] - s->low[i]);
    failed = failed || section_clip(s);
    if (!failed) state = cut_state(&s->outline, extent);
    if (state && !o->quiet)
        complain("--section: the mesh is open%s where it is cut: the cut is %s",
                 state == CUT_OPEN ? "" : ", or turned both ways,",
                 state == CUT_OPEN ? "not filled" : "filled between each second pair of its lines");
    s->spacing = 2 * extent / SECTION_LINES;
    if (!failed && state != CUT_OPEN) failed = section_fill(s);
    failed = failed || section_join(s, m, o);
    if (!failed) section_lines(s, m);
    if (!failed) section_hand_over(s, m);
    section_free(s);
    return failed;
}

/* Cuts a model open as the options say, on the side of the eye; picture as in model_up.  Returns 1
   with a line on stderr. */
static inline int model_cut(model *m, const model_options *o, int picture, float turn,
                            shade_vec3 eye)
{
    const int k = o->section - 1;
    section s = { .from = m, .axis = k };
    if (k < 0) return 0;
    if (!m->mesh.view.index_count)
        return complain("--section cuts faces, and there are lines alone");
    m->up = 1 + model_up(m, o, picture);
    mesh_box(&m->mesh, s.low, s.high);
    s.sign = section_side(k, m->up - 1, turn, eye);
    s.where = o->section_placed ? o->section_at - m->origin[k] : (s.low[k] + s.high[k]) / 2;
    if (!(s.where > s.low[k] && s.where < s.high[k]))
        return complain("--section %s=%g does not cut the model, which reaches from %g to %g",
                        option_axes[k], s.where + m->origin[k], s.low[k] + m->origin[k],
                        s.high[k] + m->origin[k]);
    if (section_cut(&s, m, o)) return complain("out of memory");
    return m->mesh.view.index_count ? 0 : complain("--section leaves no triangle of the model");
}
#endif
