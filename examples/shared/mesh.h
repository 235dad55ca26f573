/* mesh.h - meshes that own their arrays, simple shapes, and a vertex shader for them.

   The shapes are made for lessons: they exit where memory runs out.  The readers of kit/read
   return an error instead. */
#ifndef SHARED_MESH_H
#define SHARED_MESH_H

#include "lane.h"
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

/* Zeroed: empty.  The arrays may be NULL but for positions; view points into them and is what
   shade_draw_mesh takes. */
typedef struct owned_mesh {
    shade_mesh view;
    float *positions, *normals, *texcoords, *colors;
    uint32_t *indices;
    shade_chunk *chunks; /* of mesh_chunks */
    int apart;           /* it is known that no two vertices have the same position */
} owned_mesh;

static inline void mesh_free(owned_mesh *m)
{
    static const owned_mesh empty;
    free(m->positions);
    free(m->normals);
    free(m->texcoords);
    free(m->colors);
    free(m->indices);
    free(m->chunks);
    *m = empty;
}

/* Points the view at the arrays of the mesh, of which nothing else is known. */
static inline void mesh_link(owned_mesh *m, int vertices, int indices)
{
    m->apart = 0;
    m->view.positions = m->positions;
    m->view.normals = m->normals;
    m->view.texcoords = m->texcoords;
    m->view.colors = m->colors;
    m->view.indices = m->indices;
    m->view.vertex_count = vertices;
    m->view.index_count = indices;
}

static inline void *example_memory(size_t count, size_t size)
{
    void *memory = calloc(count ? count : 1, size); /* of 0 bytes calloc may return NULL */
    if (memory) return memory;
    fprintf(stderr, "out of memory\n");
    exit(1);
}

/* A mesh with room for positions, normals, texcoords and indices, all zero */
static inline owned_mesh mesh_new(int vertices, int indices)
{
    owned_mesh m = { { 0 }, 0, 0, 0, 0, 0, 0, 0 };
    m.positions = (float *)example_memory((size_t)vertices, 3 * sizeof(float));
    m.normals = (float *)example_memory((size_t)vertices, 3 * sizeof(float));
    m.texcoords = (float *)example_memory((size_t)vertices, 2 * sizeof(float));
    m.indices = (uint32_t *)example_memory((size_t)indices, sizeof(uint32_t));
    mesh_link(&m, vertices, indices);
    return m;
}

static inline void mesh_put(owned_mesh *m, int at, shade_vec3 p, shade_vec3 n, float u, float v)
{
    m->positions[3 * at] = p.x;
    m->positions[3 * at + 1] = p.y;
    m->positions[3 * at + 2] = p.z;
    m->normals[3 * at] = n.x;
    m->normals[3 * at + 1] = n.y;
    m->normals[3 * at + 2] = n.z;
    m->texcoords[2 * at] = u;
    m->texcoords[2 * at + 1] = v;
}

/* Cosine and sine of a part of a full turn.  They are entries of a rotation of shade.h, so that
   their bits do not depend on the C library. */
static inline shade_vec2 mesh_turn(float turn)
{
    shade_mat4 m = shade_mat4_rotation(6.2831853f * turn, shade_v3(0, 0, 1));
    return shade_v2(m.col[0].x, m.col[0].y);
}

/* Unit sphere: stacks from pole to pole (+y first), slices around; normals are exact, no
   triangle is without area. */
static inline owned_mesh mesh_sphere(int slices, int stacks)
{
    owned_mesh m = mesh_new((slices + 1) * (stacks + 1), 6 * slices * (stacks - 1));
    uint32_t *out = m.indices;
    for (int i = 0; i <= stacks; i++) {
        shade_vec2 polar = mesh_turn(0.5f * (float)i / (float)stacks);
        if (i == stacks) polar = shade_v2(-1, 0);
        for (int j = 0; j <= slices; j++) {
            shade_vec2 around = mesh_turn((float)(j % slices) / (float)slices);
            shade_vec3 n = shade_v3(polar.y * around.x, polar.x, -(polar.y * around.y));
            uint32_t a = (uint32_t)(i * (slices + 1) + j), c = a + (uint32_t)slices + 1;
            mesh_put(&m, (int)a, n, n, (float)j / (float)slices, (float)i / (float)stacks);
            if (i == stacks || j == slices) continue;
            if (i < stacks - 1) {
                *out++ = a;
                *out++ = c;
                *out++ = c + 1;
            }
            if (i > 0) {
                *out++ = a;
                *out++ = c + 1;
                *out++ = a + 1;
            }
        }
    }
    return m;
}

/* Square of cells x cells in the plane y = 0, from -half to half in x and z, facing +y */
static inline owned_mesh mesh_plane(float half, int cells)
{
    owned_mesh m = mesh_new((cells + 1) * (cells + 1), 6 * cells * cells);
    uint32_t *out = m.indices;
    for (int i = 0; i <= cells; i++) {
        for (int j = 0; j <= cells; j++) {
            float u = (float)j / (float)cells, v = (float)i / (float)cells;
            uint32_t a = (uint32_t)(i * (cells + 1) + j), c = a + (uint32_t)cells + 1;
            mesh_put(&m, (int)a, shade_v3(half * (2 * u - 1), 0, half * (2 * v - 1)),
                     shade_v3(0, 1, 0), u, v);
            if (i == cells || j == cells) continue;
            *out++ = a;
            *out++ = c;
            *out++ = c + 1;
            *out++ = a;
            *out++ = c + 1;
            *out++ = a + 1;
        }
    }
    return m;
}

/* A cube from -1 to 1 of 24 vertices, so that each face has its own normal */
static inline owned_mesh mesh_cube(void)
{
    owned_mesh m = mesh_new(24, 36);
    static const uint32_t quad[6] = { 0, 1, 2, 0, 2, 3 };
    for (int face = 0; face < 6; face++) {
        float sign = face & 1 ? -1.0f : 1.0f, e[9] = { 0, 0, 0, 0, 0, 0, 0, 0, 0 };
        /* the normal, and two edges that have it as cross product */
        e[face / 2] = sign;
        e[3 + (face / 2 + 1) % 3] = sign;
        e[6 + (face / 2 + 2) % 3] = 1;
        for (int k = 0; k < 4; k++) {
            float u = k == 1 || k == 2 ? 1.0f : -1.0f, v = k >= 2 ? 1.0f : -1.0f;
            shade_vec3 n = shade_v3(e[0], e[1], e[2]), p;
            p = shade_madd(n, u, shade_v3(e[3], e[4], e[5]));
            p = shade_madd(p, v, shade_v3(e[6], e[7], e[8]));
            mesh_put(&m, 4 * face + k, p, n, (1 + u) / 2, (1 - v) / 2);
        }
        for (int k = 0; k < 6; k++) m.indices[6 * face + k] = quad[k] + 4 * (uint32_t)face;
    }
    return m;
}

/* Moves the floats of each vertex to its new place, which counts from 1.  Returns 1 where memory is
   out. */
static inline int mesh_permute(float *v, size_t size, const uint32_t *place, size_t n)
{
    float *moved = v ? (float *)malloc((n + 1) * size * sizeof *v) : NULL;
    if (v && !moved) return 1;
    for (size_t i = 0; v && i < n; i++)
        memcpy(moved + size * (place[i] - 1), v + size * i, 4 * size);
    if (v && n) memcpy(v, moved, n * size * sizeof *v);
    free(moved);
    return 0;
}

/* Numbers the vertices as triangles come to them, so that what is used together lies together: a
   sorted mesh with a vertex for each corner is drawn in 0.6 of the time.  1: out of memory, and
   the mesh is of no use */
static inline int mesh_renumber(owned_mesh *m)
{
    const size_t n = (size_t)m->view.vertex_count;
    uint32_t *place = (uint32_t *)calloc(n + 1, sizeof *place), next = 0;
    int failed = !place;
    for (int i = 0; i < m->view.index_count && !failed; i++) {
        uint32_t *index = &m->indices[i];
        if (!place[*index]) place[*index] = ++next; /* NOLINT: who calls has filled the indices */
        *index = place[*index] - 1;
    }
    for (size_t i = 0; i < n && !failed; i++)
        if (!place[i]) place[i] = ++next;
    failed = failed || mesh_permute(m->positions, 3, place, n) ||
             mesh_permute(m->normals, 3, place, n) || mesh_permute(m->texcoords, 2, place, n) ||
             mesh_permute(m->colors, 3, place, n);
    free(place);
    return failed;
}

/* Sorts the triangles in space and finds the boxes around runs of them, by which draws skip what
   they do not see; once, when positions and indices are as they stay.  1: out of memory, and
   the mesh is of no use */
static inline int mesh_chunks(owned_mesh *m)
{
    const int n = m->view.index_count, count = shade_chunk_count(n, 0);
    uint32_t *sorted = (uint32_t *)malloc(((size_t)n + 1) * sizeof *sorted);
    shade_chunk *chunks = (shade_chunk *)malloc(((size_t)count + 1) * sizeof *chunks);
    if (!sorted || !chunks || shade_mesh_chunks(&m->view, 0, chunks, count, sorted)) {
        free(sorted);
        free(chunks);
        return 1;
    }
    free(m->indices);
    free(m->chunks);
    m->view.indices = m->indices = sorted;
    m->view.chunks = m->chunks = chunks;
    m->view.chunk_count = count;
    return mesh_renumber(m);
}

/* For each vertex T, unit, the way u grows: the mean of dP/du over its triangles, whose edges are
   e1 = T du1 + B dv1 and e2 = T du2 + B dv2, weighted by their area in u, v.  Three floats a
   vertex, to be freed */
static inline float *mesh_tangents(const owned_mesh *m)
{
    shade_vec3 *T = (shade_vec3 *)example_memory((size_t)m->view.vertex_count, sizeof *T);
    for (int i = 0; i < m->view.index_count; i++) {
        const uint32_t *corner = m->indices + i - i % 3;
        shade_vec3 P[3], e1, e2, t;
        shade_vec2 uv[3], d1, d2;
        for (int k = 0; k < 3; k++) {
            memcpy(&P[k], m->positions + 3 * corner[k], sizeof P[k]);
            memcpy(&uv[k], m->texcoords + 2 * corner[k], sizeof uv[k]);
        }
        e1 = shade_sub(P[1], P[0]);
        e2 = shade_sub(P[2], P[0]);
        d1 = shade_sub2(uv[1], uv[0]);
        d2 = shade_sub2(uv[2], uv[0]);
        t = shade_sub(shade_scale(e1, d2.y), shade_scale(e2, d1.y));
        if (d1.x * d2.y < d1.y * d2.x) t = shade_neg(t);
        T[m->indices[i]] = shade_add(T[m->indices[i]], t);
    }
    for (int i = 0; i < m->view.vertex_count; i++) T[i] = shade_normalize(T[i]);
    return (float *)T;
}

/* The box around the corners of all triangles, or where there are none around all vertices;
   without vertices low is above high. */
static inline void mesh_box(const owned_mesh *m, double low[3], double high[3])
{
    const size_t corners = m->indices ? (size_t)m->view.index_count : 0;
    const size_t n = corners ? corners : (size_t)m->view.vertex_count;
    float least[3] = { FLT_MAX, FLT_MAX, FLT_MAX };
    float most[3] = { -FLT_MAX, -FLT_MAX, -FLT_MAX };
    for (size_t i = 0; i < n; i++) {
        const float *p = m->positions + 3 * (corners ? (size_t)m->indices[i] : i);
        for (int k = 0; k < 3; k++) {
            least[k] = p[k] < least[k] ? p[k] : least[k];
            most[k] = p[k] > most[k] ? p[k] : most[k];
        }
    }
    for (int k = 0; k < 3; k++) {
        low[k] = (double)least[k];
        high[k] = (double)most[k];
    }
}

/* Moves the middle of the mesh's box to the origin and makes its largest distance from there 1;
   z up becomes y up.  In double: the place of a model can be far greater than its size. */
static inline float mesh_normalize(owned_mesh *m, int z_up)
{
    double low[3], high[3], radius = 0;
    size_t n = 3 * (size_t)m->view.vertex_count;
    mesh_box(m, low, high);
    for (size_t i = 0; i < n; i += 3) {
        double square = 0;
        for (size_t k = 0; k < 3; k++) {
            double d = (double)m->positions[i + k] - (low[k] + high[k]) / 2;
            square += d * d;
        }
        if (square > radius) radius = square;
    }
    radius = radius > 0 ? sqrt(radius) : 1;
    for (size_t i = 0; i < n; i++) {
        size_t k = i % 3;
        m->positions[i] = (float)(((double)m->positions[i] - (low[k] + high[k]) / 2) / radius);
    }
    for (size_t i = 0; z_up && i < n; i += 3) {
        float y = m->positions[i + 1], ny = m->normals[i + 1];
        m->positions[i + 1] = m->positions[i + 2];
        m->positions[i + 2] = -y;
        m->normals[i + 1] = m->normals[i + 2];
        m->normals[i + 2] = -ny;
    }
    return (float)(1 / radius);
}

/* Draws all triangles of a mesh with a pipeline. */
static inline shade_result mesh_draw(const shade_target *target, const shade_pipeline *pipeline,
                                     const owned_mesh *m)
{
    return shade_draw(target, pipeline, m->indices, m->view.index_count, m->view.vertex_count,
                      NULL);
}

/* The uniforms of mesh_vertex.  Those of a fragment shader can follow them in a larger struct. */
typedef struct mesh_scene {
    const owned_mesh *mesh;
    shade_mat4 model, clip_from_world;
} mesh_scene;

/* A vertex shader of eight varyings: P and N in world space, then u, v.  The model matrix must not
   scale. */
static inline void mesh_vertex(const void *uniforms, const shade_vertex_ids *SHADE_RESTRICT in,
                               shade_vertices *SHADE_RESTRICT out)
{
    const mesh_scene *s = (const mesh_scene *)uniforms;
    SHADE_EACH_LANE(i) {
        const float *p = s->mesh->positions + 3 * in->index[i];
        const float *n = s->mesh->normals + 3 * in->index[i];
        const float *uv = s->mesh->texcoords + 2 * in->index[i];
        shade_vec4 P = shade_mat4_transform(s->model, shade_v4(p[0], p[1], p[2], 1));
        shade_vec4 clip = shade_mat4_transform(s->clip_from_world, P);
        shade_vec3 N = shade_mat4_transform_direction(s->model, shade_v3(n[0], n[1], n[2]));
        lane_put4(out->clip[0], i, clip);
        lane_put(out->varying[0], i, shade_v3(P.x, P.y, P.z));
        lane_put(out->varying[3], i, N);
        out->varying[6][i] = uv[0];
        out->varying[7][i] = uv[1];
    }
}
#endif
