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

enum {
    SECTION_LINES = 24,         /* of the hatch across the model */
    SECTION_CROSSINGS = 2000000 /* of outlines and rows; beyond, there are fewer rows */
};
#define SECTION_DARK 0.28 /* the part of a row of the hatch that is drawn dark */

/* A part of the outline in the plane, from low to high; along the hatch and across it */
typedef struct section_edge {
    double low[2], high[2];
    int way; /* 1: it came from low to high; -1: from high to low */
} section_edge;

/* Where an edge crosses a row, at its lower and upper border */
typedef struct section_crossing {
    int row, way;
    double low, high;
} section_crossing;

/* The model as it becomes; value: positions, normals, texture coordinates, colours */
typedef struct section {
    const model *from;
    int axis, failed;
    double sign, where;     /* cut away is what has sign (coordinate - where) > 0 */
    double low[3], high[3]; /* the box around the model */
    mesh_floats value[4];
    mesh_uints index, object, fill[2]; /* fill: the triangles of the cut, plain and dark */
    uint32_t *place;                   /* the new number of each vertex, from 1 on; 0: none yet */
    section_edge *edge;
    size_t edges, edge_room;
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

/* A part of the outline from one point of the plane to another */
static inline void section_piece(section_edge *e, const double begin[2], const double end[2])
{
    e->way = begin[1] > end[1] ? -1 : 1;
    memcpy(e->low, e->way > 0 ? begin : end, sizeof e->low);
    memcpy(e->high, e->way > 0 ? end : begin, sizeof e->high);
}

/* Adds a part of the outline, with the solid always on the same side. */
static inline void section_outline(section *s, uint32_t from, uint32_t to)
{
    section_edge *grown;
    double begin[2], end[2];
    if (s->failed) return;
    section_flatten(s, from, begin);
    section_flatten(s, to, end);
    grown = (section_edge *)mesh_grow(s->edge, s->edges, &s->edge_room, sizeof *grown);
    s->failed |= !grown;
    if (!grown) return;
    s->edge = grown;
    section_piece(&grown[s->edges++], begin, end);
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

static inline int section_number(const void *a, const void *b)
{
    const double x = *(const double *)a, y = *(const double *)b;
    return (x > y) - (x < y);
}

static inline int section_along(const void *a, const void *b)
{
    const section_crossing *x = (const section_crossing *)a, *y = (const section_crossing *)b;
    const double p = x->low + x->high, q = y->low + y->high;
    if (x->row != y->row) return x->row > y->row ? 1 : -1;
    return (p > q) - (p < q);
}

/* The first of n sorted numbers that is not below x */
static inline size_t section_find(const double *sorted, size_t n, double x)
{
    size_t low = 0;
    while (low < n) {
        const size_t middle = (low + n) / 2;
        if (sorted[middle] < x)
            low = middle + 1;
        else
            n = middle;
    }
    return low;
}

/* Where an edge is at a height; on itself, whatever the height */
static inline double section_at(const section_edge *e, double height)
{
    const double t = (height - e->low[1]) / (e->high[1] - e->low[1]);
    if (t >= 1) return e->high[0];
    return t > 0 ? e->low[0] + (e->high[0] - e->low[0]) * t : e->low[0];
}

/* How far the outline is open along a line through the plane: where it is closed an even number of
   its parts end in each point, and in the order of the line two and two ends are the same.  With
   directed it is also wrong where parts do not begin where others end.  Huge: out of memory */
static inline double section_gap(const section *s, double x, double y, int directed)
{
    const size_t n = s->edges, step = directed ? 1 : 2, apart = directed ? n : 1;
    double *at = (double *)malloc((2 * n + 1) * sizeof *at), sum = 0;
    if (!at) return HUGE_VAL;
    for (size_t i = 0; i < n; i++) {
        const section_edge *e = &s->edge[i];
        const size_t low = e->way > 0 ? i : n + i, high = e->way > 0 ? n + i : i;
        at[low] = x * e->low[0] + y * e->low[1];
        at[high] = x * e->high[0] + y * e->high[1];
    }
    qsort(at, directed ? n : 2 * n, sizeof *at, section_number);
    if (directed) qsort(at + n, n, sizeof *at, section_number);
    for (size_t i = 0; i < n; i++) sum += fabs(at[step * i] - at[step * i + apart]);
    free(at);
    return sum;
}

/* The larger gap along two lines that few parts have sides along */
static inline double section_gaps(const section *s, int directed)
{
    return fmax(section_gap(s, 1, 0.382, directed), section_gap(s, -0.382, 1, directed));
}

/* 0: the outline is closed; SECTION_TORN: it is open by more than a thousandth of the model, and
   than what rounding makes of edges that meet in the middle of others, or turned both ways;
   SECTION_OPEN: by so much of its length that it is one of sheets, which have no inside */
enum { SECTION_TORN = 1, SECTION_OPEN };
static inline int section_state(const section *s, double extent)
{
    const double least = (1e-3 + 3e-7 * (double)s->edges) * extent;
    const double gap = section_gaps(s, 0);
    double length = 0;
    for (size_t i = 0; i < s->edges; i++)
        length +=
            hypot(s->edge[i].high[0] - s->edge[i].low[0], s->edge[i].high[1] - s->edge[i].low[1]);
    if (gap > least && gap > 0.05 * length) return SECTION_OPEN;
    return gap > least || section_gaps(s, 1) > least ? SECTION_TORN : 0;
}

/* How many rows the edges cross */
static inline size_t section_spans(const section *s, const double *height, size_t n)
{
    size_t sum = 0;
    for (size_t i = 0; i < s->edges; i++)
        sum += section_find(height, n, s->edge[i].high[1]) -
               section_find(height, n, s->edge[i].low[1]);
    return sum;
}

/* The borders of rows, sorted: those of the hatch, whose lines are spacing apart, and the ends of
   all edges or, where that would be too many, as many even ones as may be.  NULL: out of memory */
static inline double *section_rows(const section *s, double spacing, size_t *count)
{
    double low = s->edge[0].low[1], high = low, *height;
    size_t hatch = 0, n = 0, even;
    for (size_t i = 0; i < s->edges; i++) {
        low = fmin(low, s->edge[i].low[1]);
        high = fmax(high, s->edge[i].high[1]);
    }
    hatch = (size_t)fmin(1000, ceil((high - low) / spacing));
    even = SECTION_CROSSINGS / s->edges;
    height = (double *)malloc((2 * s->edges + 2 * hatch + even + 8) * sizeof *height);
    if (!height) return NULL;
    for (int attempt = 0; attempt < 2; attempt++) {
        n = 0;
        for (size_t i = 0; i <= hatch; i++) {
            height[n] = (floor(low / spacing) + (double)i) * spacing;
            height[n + 1] = height[n] + SECTION_DARK * spacing;
            n += 2;
        }
        for (size_t i = 0; i < s->edges && !attempt; i++) {
            height[n++] = s->edge[i].low[1];
            height[n++] = s->edge[i].high[1];
        }
        for (size_t i = 0; i <= even && attempt; i++)
            height[n++] = low + (high - low) * (double)i / (double)(even + 1);
        qsort(height, n, sizeof *height, section_number);
        *count = 0;
        for (size_t i = 0; i < n; i++)
            if (!*count || height[i] > height[*count - 1]) height[(*count)++] = height[i];
        if (section_spans(s, height, *count) <= SECTION_CROSSINGS) break;
    }
    return height;
}

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

/* Adds the quadrangle between two crossings of a row from low to high. */
static inline void section_between(section *s, const section_crossing *c, double low, double high,
                                   int dark)
{
    const uint32_t a = section_point(s, c[0].low, low), b = section_point(s, c[1].low, low);
    const uint32_t d = section_point(s, c[1].high, high), e = section_point(s, c[0].high, high);
    mesh_uints *to = &s->fill[dark];
    s->failed |= s->sign > 0 ? mesh_push_triangle(to, a, b, d) || mesh_push_triangle(to, a, d, e)
                             : mesh_push_triangle(to, a, d, b) || mesh_push_triangle(to, a, e, d);
}

/* Fills a row of count crossings, sorted along it. */
static inline void section_fill_row(section *s, const section_crossing *c, int count,
                                    const double *height, double spacing)
{
    const double *at = height + c->row, middle = (at[0] + at[1]) / 2 / spacing;
    const int dark = middle - floor(middle) < SECTION_DARK;
    /* rows reach a little over each other, so that no pixel falls between them */
    const double low = at[0] - 2e-4 * spacing;
    int total = 0, winding = 0;
    for (int i = 0; i < count; i++) total += c[i].way;
    for (int i = 0; i + 1 < count && !s->failed; i++) {
        winding = total ? i % 2 == 0 : winding + c[i].way;
        if (winding) section_between(s, c + i, low, at[1], dark);
    }
}

/* Finds all crossings and fills the rows between them.  Non-zero: out of memory */
static inline int section_fill(section *s, double spacing)
{
    size_t n = 0, rows = 0, crossings = 0;
    double *height = s->edges ? section_rows(s, spacing, &rows) : NULL;
    section_crossing *list = NULL;
    if (!s->edges) return 0;
    if (height) n = section_spans(s, height, rows);
    if (height) list = (section_crossing *)malloc((n + 1) * sizeof *list);
    for (size_t i = 0; i < s->edges && list; i++) {
        const section_edge *e = &s->edge[i];
        const size_t end = section_find(height, rows, e->high[1]);
        for (size_t k = section_find(height, rows, e->low[1]); k < end && k + 1 < rows; k++)
            list[crossings++] = (section_crossing){ (int)k, e->way, section_at(e, height[k]),
                                                    section_at(e, height[k + 1]) };
    }
    if (list) qsort(list, crossings, sizeof *list, section_along);
    for (size_t i = 0, end; i < crossings && list && !s->failed; i = end) {
        for (end = i; end < crossings && list[end].row == list[i].row;) end++;
        section_fill_row(s, list + i, (int)(end - i), height, spacing);
    }
    s->failed |= !list;
    free(height);
    free(list);
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
    free(s->edge);
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
    if (!failed) state = section_state(s, extent);
    if (state && !o->quiet)
        complain("--section: the mesh is open%s where it is cut: the cut is %s",
                 state == SECTION_OPEN ? "" : ", or turned both ways,",
                 state == SECTION_OPEN ? "not filled"
                                       : "filled between each second pair of its lines");
    if (!failed && state != SECTION_OPEN) failed = section_fill(s, 2 * extent / SECTION_LINES);
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
