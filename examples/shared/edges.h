/* edges.h - for drawings by edges: joins meshes into one whose faces share their vertices, and
   sorts its edges into the kinds that illustrators know. */
#ifndef SHARED_EDGES_H
#define SHARED_EDGES_H

#include "mesh.h"

static inline uint32_t edges_hash(shade_vec3 P)
{
    uint32_t bits[3], h;
    memcpy(bits, &P, sizeof bits);
    h = bits[0] * 73856093u ^ bits[1] * 19349663u ^ bits[2] * 83492791u;
    h *= 2654435761u;
    return h ^ h >> 15;
}

/* Appends part, moved by at, to all (room is the caller's), and frees it.  Vertices of equal
   position become one. */
static inline void edges_add(owned_mesh *all, owned_mesh part, shade_mat4 at)
{
    uint32_t size = 1, used = (uint32_t)all->view.vertex_count;
    int *slot;
    while (size < 2 * (used + (uint32_t)part.view.vertex_count)) size *= 2;
    slot = (int *)example_memory(size, sizeof(int));    /* 1 + number of a vertex */
    for (int i = -(int)used; i < part.view.index_count; i++) {
        const float *q;
        shade_vec3 P;
        uint32_t h;
        if (i < 0) {
            q = all->positions + 3 * (i + (int)used);
            P = shade_v3(q[0], q[1], q[2]);
        } else {
            q = part.positions + 3 * part.indices[i];
            P = shade_mat4_transform_point(at, shade_v3(q[0], q[1], q[2]));
        }
        P = shade_add(P, shade_v3(0, 0, 0));            /* -0 becomes 0 */
        for (h = edges_hash(P); slot[h & (size - 1)]; h++) {
            q = all->positions + 3 * (slot[h & (size - 1)] - 1);
            if (q[0] == P.x && q[1] == P.y && q[2] == P.z) break;
        }
        h &= size - 1;
        if (!slot[h] && i >= 0) mesh_put(all, all->view.vertex_count++, P, P, 0, 0);
        if (!slot[h]) slot[h] = i < 0 ? i + (int)used + 1 : all->view.vertex_count;
        if (i >= 0) all->indices[all->view.index_count++] = (uint32_t)(slot[h] - 1);
    }
    free(slot);
    mesh_free(&part);
}

enum { EDGE_SILHOUETTE = 0, EDGE_CREASE, EDGE_BOUNDARY, EDGE_OTHER, EDGE_KINDS };

/* The edges of each kind, as pairs of points for shade_draw_lines */
typedef struct edge_lines { shade_vec3 *points[EDGE_KINDS]; int count[EDGE_KINDS]; } edge_lines;

static inline shade_vec3 edges_point(const owned_mesh *m, uint32_t vertex)
{
    const float *p = m->positions + 3 * vertex;
    return shade_v3(p[0], p[1], p[2]);
}

static inline shade_vec3 edges_normal(const owned_mesh *m, int triangle)
{
    const uint32_t *v = m->indices + 3 * triangle;
    return shade_face_normal(edges_point(m, v[0]), edges_point(m, v[1]), edges_point(m, v[2]));
}

/* Sorts the edges of a mesh.  An edge is a crease where the cosine between the normals of its two
   faces is below crease. */
static inline edge_lines edges_sort(const owned_mesh *m, shade_vec3 eye, float crease)
{
    edge_lines lines;
    int room = m->view.index_count, count = 0;
    shade_edge *edge = (shade_edge *)example_memory((size_t)room + 1, sizeof *edge);
    for (int k = 0; k < EDGE_KINDS; k++) {
        lines.points[k] = (shade_vec3 *)example_memory(2 * (size_t)room + 1, sizeof(shade_vec3));
        lines.count[k] = 0;
    }
    shade_mesh_edges(&m->view, edge, room, &count);
    for (int i = 0; i < count; i++) {
        shade_vec3 a = edges_point(m, edge[i].a), b = edges_point(m, edge[i].b);
        int kind = EDGE_BOUNDARY;
        if (edge[i].triangle[1] >= 0) {
            shade_vec3 n0 = edges_normal(m, edge[i].triangle[0]);
            shade_vec3 n1 = edges_normal(m, edge[i].triangle[1]);
            kind = shade_is_silhouette(shade_sub(eye, a), n0, n1) ? EDGE_SILHOUETTE
                 : shade_is_crease(n0, n1, crease) ? EDGE_CREASE : EDGE_OTHER;
        }
        lines.points[kind][lines.count[kind]++] = a;
        lines.points[kind][lines.count[kind]++] = b;
    }
    free(edge);
    return lines;
}

static inline void edges_free(edge_lines *lines)
{
    for (int k = 0; k < EDGE_KINDS; k++) free(lines->points[k]);
}
#endif
