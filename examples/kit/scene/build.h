/* build.h - meshes as callers of the packages have them become meshes as shade.h draws them:
   normals, colours by face, corners that are alike, where they lie, and the edges that are drawn.

       build_asked asked = { .positions = p, .vertices = n, .indices = f, .corners = 3 * m };
       build b;
       if (!build_mesh(&b, &asked)) shade_draw(&target, &b.mesh, &state, NULL);
       build_free(&b);

   The caller checks lengths and indices before.  Arrays that need not change are the caller's. */
#ifndef SCENE_BUILD_H
#define SCENE_BUILD_H

#include <math.h>
#include <stdlib.h>
#include <string.h>
#include "shade.h"
#include "../core/camera.h"
#include "../read/reader.h"

/* Normals of corners are made where that is quick: not of larger meshes, nor where more faces meet
   at one vertex. */
enum { BUILD_TRIANGLES = 200000, BUILD_FACES = 2000 };
#define BUILD_COS_CREASE 0.766f            /* faces that meet at less than 40 degrees are rounded */
#define BUILD_COS_EDGE 0.86602540378443871 /* edges of 30 degrees and more are drawn */
enum { BUILD_FLAT, BUILD_AUTO, BUILD_SMOOTH };

typedef struct build_asked {
    const float *positions;
    float *normals;      /* a row for each vertex, directed in place; NULL: by normals_kind */
    const float *colors; /* linear light, of each vertex or of each face; NULL: none */
    const float *uv;     /* v downward */
    const uint32_t *indices;
    int vertices, corners, color_count, normals_kind;
} build_asked;

typedef struct build {
    shade_mesh mesh; /* what is drawn */
    void *owned[40];
    int owned_count, no_room;
    double bytes; /* of what it owns */
} build;

static inline void build_free(build *b)
{
    for (int i = 0; i < b->owned_count; i++) free(b->owned[i]);
    b->owned_count = 0;
}

/* Memory that is freed with the mesh.  NULL is remembered. */
static inline void *build_keep(build *b, void *memory)
{
    if (memory)
        b->owned[b->owned_count++] = memory;
    else
        b->no_room = 1;
    return memory;
}
static inline void *build_room(build *b, size_t count, size_t size)
{
    b->bytes += (double)(count + 1) * (double)size;
    return build_keep(b, calloc(count + 1, size));
}

/* ---- corners that are alike become one vertex ------------------------------------------------ */

/* Gives each corner the number of the first one with its vertex and its value, of width floats, and
   returns how many differ.  made has their corners.  Of a vertex with many values the last ones
   alone are compared.  first, of vertex_count, and next, of count, are scratch. */
static inline int build_weld(const uint32_t *vertex, int count, const float *value, int width,
                             uint32_t *index, uint32_t *made, int32_t *first, int32_t *next)
{
    const size_t floats = (size_t)width, bytes = floats * sizeof *value;
    int n = 0;
    for (int i = 0; i < count; i++) {
        int32_t *head = &first[vertex[i]], at = *head;
        int steps = 0;
        while (at >= 0 && memcmp(value + floats * made[at], value + floats * (size_t)i, bytes))
            at = ++steps < 16 ? next[at] : -1;
        if (at < 0) {
            made[n] = (uint32_t)i;
            next[n] = *head;
            *head = at = n++;
        }
        index[i] = (uint32_t)at;
    }
    return n;
}

/* Floats of the rows at[0], at[1], ..., each of width floats */
static inline float *build_gathered(build *b, const float *from, int width, const uint32_t *at,
                                    int count)
{
    const size_t floats = (size_t)width;
    float *to = (float *)build_room(b, (size_t)count, floats * sizeof *to);
    for (int i = 0; to && i < count; i++)
        memcpy(to + floats * (size_t)i, from + floats * at[i], floats * sizeof *to);
    return to;
}

/* What tells the vertices at one corner apart: its normal, its texcoords, its face's colour */
static inline float *build_values(build *b, const float *const part[3], int *width)
{
    static const size_t size[3] = { 3, 2, 3 };
    const int count = b->mesh.index_count;
    size_t all = 0;
    float *value, *to;
    for (int k = 0; k < 3; k++) all += part[k] ? size[k] : 0;
    value = to = (float *)build_room(b, (size_t)count, all * sizeof *value);
    for (size_t i = 0; value && i < (size_t)count; i++)
        for (int k = 0; k < 3; k++) {
            if (!part[k]) continue;
            memcpy(to, part[k] + size[k] * (k == 2 ? i / 3 : i), size[k] * sizeof *to);
            to += size[k];
        }
    *width = (int)all;
    return value;
}

/* Gives corners with a normal, texcoords or a face's colour of their own, each of which may be
   NULL, a vertex for each of these; without weld one for each corner. */
static inline void build_corners(build *b, const float *normals, const float *uv, int by_face,
                                 int weld)
{
    shade_mesh *s = &b->mesh;
    const int count = s->index_count;
    const size_t corners = (size_t)count;
    const float *const part[3] = { normals, uv, by_face ? s->colors : NULL }, *value = NULL;
    int width = 0, made_count = count;
    uint32_t *index = (uint32_t *)build_room(b, corners, 4);
    uint32_t *made = (uint32_t *)build_room(b, corners, 4);
    uint32_t *vertex = (uint32_t *)build_room(b, corners, 4);
    int32_t *first = NULL, *next = NULL;
    if (weld) {
        value = build_values(b, part, &width);
        first = (int32_t *)build_room(b, (size_t)s->vertex_count, 4);
        next = (int32_t *)build_room(b, corners, 4);
    }
    if (b->no_room) return;
    if (weld) {
        memset(first, 255, 4 * (size_t)s->vertex_count);
        made_count = build_weld(s->indices, count, value, width, index, made, first, next);
    }
    for (int i = 0; !weld && i < count; i++) index[i] = made[i] = (uint32_t)i;
    for (int i = 0; i < made_count; i++) vertex[i] = s->indices[made[i]];
    s->positions = build_gathered(b, s->positions, 3, vertex, made_count);
    if (normals)
        s->normals = build_gathered(b, normals, 3, made, made_count);
    else if (s->normals)
        s->normals = build_gathered(b, s->normals, 3, vertex, made_count);
    if (uv)
        s->texcoords = build_gathered(b, uv, 2, made, made_count);
    else if (s->texcoords)
        s->texcoords = build_gathered(b, s->texcoords, 2, vertex, made_count);
    for (int i = 0; by_face && i < made_count; i++) made[i] /= 3;
    if (s->colors) s->colors = build_gathered(b, s->colors, 3, by_face ? made : vertex, made_count);
    s->indices = index;
    s->vertex_count = made_count;
}

/* ---- normals --------------------------------------------------------------------------------- */

/* Directs normals that a caller gives, one for each vertex, as those of files are; those without a
   direction, zero or NaN, are made anew. */
static inline shade_result build_direct(const shade_mesh *mesh, float *normals)
{
    shade_result result = SHADE_OK;
    shade_vec3 *made = NULL;
    for (int i = 0; i < mesh->vertex_count && !result; i++) {
        float *n = normals + 3 * (size_t)i;
        const double given[3] = { (double)n[0], (double)n[1], (double)n[2] };
        mesh_normal(given, n);
        if (n[0] != 0 || n[1] != 0 || n[2] != 0) continue;
        if (!made) {
            made = (shade_vec3 *)malloc((size_t)mesh->vertex_count * sizeof *made);
            result = made ? shade_mesh_normals(mesh, made) : SHADE_ERROR_CAPACITY;
        }
        if (!result) memcpy(n, &made[i], sizeof *made);
    }
    free(made);
    return result;
}

/* Do so many faces meet at a vertex that normals of corners would take too long? */
static inline int build_is_hub(build *b)
{
    const shade_mesh *s = &b->mesh;
    int *faces = (int *)build_room(b, (size_t)s->vertex_count, sizeof *faces), most = 0;
    for (int i = 0; faces && i < s->index_count; i++) {
        const int n = ++faces[s->indices[i]];
        if (n > most) most = n;
    }
    return most > BUILD_FACES;
}

/* One normal for each corner, rounded between faces; NULL: none are made */
static inline const float *build_creased(build *b, shade_result *result)
{
    const size_t bytes = shade_mesh_corner_normals_bytes(&b->mesh);
    shade_vec3 *normals;
    void *memory;
    if (!b->mesh.index_count || b->mesh.index_count > 3 * BUILD_TRIANGLES) return NULL;
    if (build_is_hub(b)) return NULL;
    normals = (shade_vec3 *)build_room(b, (size_t)b->mesh.index_count, sizeof *normals);
    memory = malloc(bytes);
    if (!normals || !memory)
        *result = SHADE_ERROR_CAPACITY;
    else
        *result = shade_mesh_corner_normals(&b->mesh, BUILD_COS_CREASE, normals, memory, bytes);
    free(memory);
    return *result ? NULL : &normals->x;
}

/* The unit normal of each corner's face */
static inline const float *build_flat(build *b)
{
    const shade_mesh *s = &b->mesh;
    float *normals = (float *)build_room(b, (size_t)s->index_count, 3 * sizeof *normals);
    for (int i = 0; normals && i < s->index_count; i += 3) {
        shade_vec3 p[3], N;
        for (int k = 0; k < 3; k++)
            memcpy(&p[k], s->positions + 3 * (size_t)s->indices[i + k], sizeof p[k]);
        N = shade_face_normal(p[0], p[1], p[2]);
        for (size_t k = 0; k < 3; k++) memcpy(normals + 3 * ((size_t)i + k), &N, sizeof N);
    }
    return normals;
}

/* Makes a mesh of what is asked.  build_free is to be called whatever it returns. */
static inline shade_result build_mesh(build *b, const build_asked *asked)
{
    const int by_face = asked->colors && asked->color_count != asked->vertices;
    shade_result result = SHADE_OK;
    const float *corner = NULL;
    int flat;
    *b = (build){ .mesh = { .positions = asked->positions,
                            .vertex_count = asked->vertices,
                            .indices = asked->indices,
                            .index_count = asked->corners } };
    if (asked->normals)
        result = build_direct(&b->mesh, asked->normals);
    else if (asked->normals_kind == BUILD_AUTO)
        corner = build_creased(b, &result);
    else if (asked->normals_kind == BUILD_SMOOTH && asked->corners) {
        shade_vec3 *normals = (shade_vec3 *)build_room(b, (size_t)asked->vertices, sizeof *normals);
        if (normals) result = shade_mesh_normals(&b->mesh, normals);
        if (normals && !result) b->mesh.normals = &normals->x;
    }
    if (asked->normals) b->mesh.normals = asked->normals;
    b->mesh.colors = asked->colors;
    b->mesh.texcoords = asked->uv;
    flat = !result && !corner && !b->mesh.normals;
    if (flat) corner = build_flat(b);
    if (!result && !b->no_room && (corner || by_face))
        build_corners(b, corner, NULL, by_face, !flat);
    return b->no_room ? SHADE_ERROR_CAPACITY : result;
}

/* ---- where they lie -------------------------------------------------------------------------- */

/* Number i of positions, which are in exact or, where that is NULL, in local */
static inline double build_number(const float *local, const double *exact, size_t i)
{
    return exact ? exact[i] : (double)local[i];
}

/* Marks the vertices of triangles, but not of those that have two corners at one place, which
   cannot be seen, unless all are such. */
static inline void build_seen(const float *local, const double *exact, const uint32_t *corner,
                              size_t count, uint8_t *seen)
{
    int any = 0;
    for (size_t i = 0; i < count; i += 3) {
        int hidden = 0;
        for (size_t k = 0; k < 3; k++) {
            const size_t p = 3 * (size_t)corner[i + k], q = 3 * (size_t)corner[i + (k + 1) % 3];
            int same = 1;
            for (size_t c = 0; c < 3; c++)
                same &= build_number(local, exact, p + c) == build_number(local, exact, q + c);
            hidden |= same;
        }
        for (size_t k = 0; k < 3 && !hidden; k++) seen[corner[i + k]] = 1;
        any |= !hidden;
    }
    for (size_t i = 0; i < count && !any; i++) seen[corner[i]] = 1;
}

/* The box around the positions that are finite and fit floats, of vertices that are used; used
   NULL: of all.  Of none it is a point at 0. */
static inline void build_box(const float *local, const double *exact, const uint8_t *used,
                             size_t vertices, double low[3], double high[3])
{
    int any = 0;
    for (int k = 0; k < 3; k++) low[k] = high[k] = 0;
    for (size_t i = 0; i < vertices; i++) {
        double at[3];
        for (size_t k = 0; k < 3; k++) at[k] = build_number(local, exact, 3 * i + k);
        if (used && !used[i]) continue;
        if (!(fabs(at[0]) <= 1e30 && fabs(at[1]) <= 1e30 && fabs(at[2]) <= 1e30)) continue;
        for (int k = 0; k < 3; k++) {
            low[k] = any ? fmin(low[k], at[k]) : at[k];
            high[k] = any ? fmax(high[k], at[k]) : at[k];
        }
        any = 1;
    }
}

/* Positions in double become floats that count from an origin: 0, or for a mesh far away a round
   number near what can be seen of it, of which doubles subtract without rounding.  Non-zero: out
   of memory */
static inline int build_local(const double *exact, size_t vertices, const uint32_t *corner,
                              size_t corners, float *local, double origin[3])
{
    double low[3], high[3];
    uint8_t *used = (uint8_t *)calloc(vertices + 1, 1);
    if (!used) return 1;
    build_seen(NULL, exact, corner, corners, used);
    build_box(NULL, exact, corners ? used : NULL, vertices, low, high);
    core_origin(low, high, origin);
    for (size_t i = 0; i < 3 * vertices; i++) local[i] = (float)(exact[i] - origin[i % 3]);
    free(used);
    return 0;
}

/* ---- edges ----------------------------------------------------------------------------------- */

/* The lowest vertex with the same position, for each vertex; -0 is 0.  NULL: out of memory */
static inline uint32_t *build_lowest(const float *positions, int count)
{
    uint32_t size = 2, *table, *lowest = (uint32_t *)malloc(4 * ((size_t)count + 1));
    while (size < 2 * (uint32_t)count) size *= 2;
    table = (uint32_t *)calloc(size, 4); /* vertices from 1 on; 0: free */
    for (int i = 0; lowest && table && i < count; i++) {
        const float *p = positions + 3 * (size_t)i;
        const float q[3] = { p[0] + 0.0f, p[1] + 0.0f, p[2] + 0.0f };
        uint32_t bits[3], at;
        memcpy(bits, q, 12);
        at = (bits[0] * 0x9E3779B1u ^ bits[1] * 0x85EBCA77u ^ bits[2] * 0xC2B2AE3Du) * 0x27D4EB2Fu;
        for (at = (at ^ at >> 15) & (size - 1); table[at]; at = (at + 1) & (size - 1)) {
            const float *t = positions + 3 * ((size_t)table[at] - 1);
            const float r[3] = { t[0] + 0.0f, t[1] + 0.0f, t[2] + 0.0f };
            if (!memcmp(q, r, 12)) break;
        }
        if (!table[at]) table[at] = (uint32_t)i + 1;
        lowest[i] = table[at] - 1;
    }
    if (!table) free(lowest);
    free(table);
    return table ? lowest : NULL;
}

/* In double; NaN for a face without area. */
static inline void build_face_normal(const float *positions, const uint32_t *corner, double *n)
{
    double a[3], b[3];
    for (size_t k = 0; k < 3; k++) {
        const double p = (double)positions[3 * (size_t)corner[0] + k];
        a[k] = (double)positions[3 * (size_t)corner[1] + k] - p;
        b[k] = (double)positions[3 * (size_t)corner[2] + k] - p;
    }
    core_cross(a, b, n);
    const double length = core_length(n);
    for (int k = 0; k < 3; k++) n[k] /= length;
}

/* Lists each edge of a mesh once, where vertices of one position count as one, with normals of
   faces, three numbers each.  edges and normals have room for as many as there are corners. */
static inline shade_result build_edges(const shade_mesh *mesh, shade_edge *edges, double *normals,
                                       int *count)
{
    uint32_t *lowest = build_lowest(mesh->positions, mesh->vertex_count);
    uint32_t *welded = (uint32_t *)malloc(4 * ((size_t)mesh->index_count + 1));
    shade_mesh whole = { .positions = mesh->positions, .vertex_count = mesh->vertex_count };
    shade_result result = lowest && welded ? SHADE_OK : SHADE_ERROR_CAPACITY;
    *count = 0;
    for (int i = 0; !result && i < mesh->index_count; i += 3) {
        uint32_t *to = welded + whole.index_count;
        for (int k = 0; k < 3; k++) to[k] = lowest[mesh->indices[i + k]];
        if (to[0] == to[1] || to[1] == to[2] || to[0] == to[2]) continue;
        build_face_normal(mesh->positions, to, normals + whole.index_count);
        whole.index_count += 3;
    }
    whole.indices = welded;
    if (!result && whole.index_count)
        result = shade_mesh_edges(&whole, edges, mesh->index_count, count);
    free(lowest);
    free(welded);
    return result;
}

/* Pairs of points of the edges that an illustrator draws from an eye, which counts from the origin
   of the mesh: silhouettes, boundaries, and creases whose normals have no larger cosine.  parallel:
   eye is the way toward it.  Returns how many points there are, two for each edge at most. */
static inline int build_drawn_edges(const float *positions, const shade_edge *edges, int count,
                                    const double *normals, const double eye[3], int parallel,
                                    double cosine, shade_vec3 *points)
{
    int n = 0;
    for (const shade_edge *e = edges; e < edges + count; e++) {
        const float *p = positions + 3 * (size_t)e->a;
        const double *n0 = normals + 3 * (size_t)e->triangle[0], *n1 = n0;
        double to_eye[3];
        for (int k = 0; k < 3; k++) to_eye[k] = parallel ? eye[k] : eye[k] - (double)p[k];
        if (e->triangle[1] >= 0) {
            n1 = normals + 3 * (size_t)e->triangle[1];
            if (!(core_dot(n0, to_eye) * core_dot(n1, to_eye) <= 0) &&
                !(core_dot(n0, n1) <= cosine))
                continue;
        }
        memcpy(&points[n++], p, sizeof *points);
        memcpy(&points[n++], positions + 3 * (size_t)e->b, sizeof *points);
    }
    return n;
}
#endif
