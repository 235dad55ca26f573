/* outline.h - the edges of a mesh, each once, sorted by what they are in a drawing: sharp and open
   ones, which every view shows; those that are the outline of some view; and the others, which lie
   in a plane. */
#ifndef MODEL_OUTLINE_H
#define MODEL_OUTLINE_H

#include "../read/pieces.h"

#define OUTLINE_CREASE 0.906f /* the cosine below which an edge is sharp, that of 25 degrees */

/* The edges of a mesh whose vertices of equal position are one */
typedef struct outline {
    float *position;    /* by place */
    shade_edge *edge;   /* the sharp and open ones; those that may be outlines; the others */
    shade_vec3 *normal; /* by triangle */
    size_t places;
    int sharp, bent, count; /* where these end */
} outline;

static inline void outline_free(outline *o)
{
    free(o->position);
    free(o->edge);
    free(o->normal);
}

static inline void outline_normals(outline *o, const shade_mesh *m)
{
    for (int t = 0; t < m->index_count / 3; t++) {
        shade_vec3 p[3];
        for (int k = 0; k < 3; k++)
            memcpy(&p[k], m->positions + 3 * (size_t)m->indices[3 * t + k], sizeof *p);
        o->normal[t] = shade_face_normal(p[0], p[1], p[2]);
    }
}

static inline int outline_has_area(shade_vec3 n) { return shade_dot(n, n) > 0.5f; }

/* 2: an edge that is drawn in each view; 1: perhaps; 0: it lies in a plane, or beside a triangle
   without area, of which nobody knows how it bends. */
static inline int outline_kind(const outline *o, const shade_edge *e)
{
    shade_vec3 n0 = o->normal[e->triangle[0]], n1;
    if (e->triangle[1] < 0) return outline_has_area(n0) ? 2 : 0;
    n1 = o->normal[e->triangle[1]];
    if (!outline_has_area(n0) || !outline_has_area(n1)) return 0;
    if (shade_is_crease(n0, n1, OUTLINE_CREASE)) return 2;
    return shade_dot(n0, n1) < 0.999999f;
}

/* Sorts the edges: sharp and open ones, then those that may be outlines, then the others. */
static inline int outline_sort(outline *o, int edges)
{
    shade_edge *sorted = (shade_edge *)malloc(((size_t)edges + 1) * sizeof *sorted);
    for (int kind = 2; sorted && kind >= 0; kind--) {
        for (int i = 0; i < edges; i++)
            if (outline_kind(o, &o->edge[i]) == kind) sorted[o->count++] = o->edge[i];
        if (kind == 2) o->sharp = o->count;
        if (kind == 1) o->bent = o->count;
    }
    free(o->edge);
    o->edge = sorted;
    return !sorted;
}

/* Finds the edges of all triangles but those of a section's cut, whose outline the others leave;
   index: the places of all corners, of which those of the cut are dropped.  Non-zero: out of
   memory */
static inline int outline_edges(outline *o, const model *whole, shade_mesh *welded, uint32_t *index)
{
    const int n = welded->index_count;
    int *triangle = (int *)malloc(((size_t)n / 3 + 1) * sizeof *triangle);
    int corners = 0, count = 0, failed = !triangle;
    for (int i = 0; i < whole->part_count && triangle; i++) {
        const model_part *part = &whole->part[i];
        if (model_is_section(whole, i)) continue;
        for (int k = part->first; k < part->first + part->count; k++) {
            triangle[corners / 3] = k / 3;
            index[corners++] = index[k];
        }
    }
    welded->index_count = corners;
    failed = failed || shade_mesh_edges(welded, o->edge, n, &count);
    for (int i = 0; i < 2 * count && !failed; i++) {
        int *of = &o->edge[i / 2].triangle[i % 2];
        if (*of >= 0) *of = triangle[*of];
    }
    free(triangle);
    return failed || outline_sort(o, count);
}

/* Non-zero: out of memory */
static inline int outline_find(outline *o, const model *whole)
{
    const owned_mesh *m = &whole->mesh;
    uint32_t *at = NULL, *place = mesh_places(m, &at, &o->places);
    size_t n = (size_t)m->view.index_count;
    uint32_t *index = (uint32_t *)malloc((n + 1) * sizeof *index);
    int failed = 1;
    shade_mesh welded = { 0 };
    o->position = (float *)malloc((3 * o->places + 1) * sizeof *o->position);
    o->edge = (shade_edge *)malloc((n + 1) * sizeof *o->edge);
    o->normal = (shade_vec3 *)malloc((n / 3 + 1) * sizeof *o->normal);
    if (place && index && o->position && o->edge && o->normal) {
        for (size_t i = 0; i < o->places; i++)
            memcpy(o->position + 3 * i, m->positions + 3 * (size_t)at[i], 12);
        for (size_t i = 0; i < n; i++) index[i] = place[m->indices[i]];
        welded.positions = o->position;
        welded.vertex_count = (int)o->places;
        welded.indices = index;
        welded.index_count = (int)n;
        outline_normals(o, &welded);
        failed = outline_edges(o, whole, &welded, index);
    }
    free(index);
    if (place) free(at);
    free(place);
    return failed;
}

static inline shade_vec3 outline_place(const outline *o, uint32_t place)
{
    const float *p = o->position + 3 * (size_t)place;
    return shade_v3(p[0], p[1], p[2]);
}

/* 1: the edge is on the outline as seen from the direction to_eye. */
static inline int outline_is_seen(const outline *o, const shade_edge *e, shade_vec3 to_eye)
{
    return shade_is_silhouette(to_eye, o->normal[e->triangle[0]], o->normal[e->triangle[1]]);
}
#endif
