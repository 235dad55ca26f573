/* shapes.h - more meshes: the teapot, shapes of a lathe, a star, a knot; and two meshes as one. */
#ifndef SHARED_SHAPES_H
#define SHARED_SHAPES_H

#include "mesh.h"
#include "teapot.h"

/* The teapot, with n pieces along each edge of a patch */
static inline owned_mesh shape_teapot(int n)
{
    owned_mesh m = mesh_new(teapot_vertex_count(n), teapot_index_count(n));
    teapot_build(n, m.positions, m.normals, m.texcoords, m.indices);
    return m;
}

/* A profile of (radius, height), from above down as one sees it right of the axis, turned about y.
   A point given twice makes a sharp edge; u goes round, v down the profile. */
static inline owned_mesh shape_turned(const shade_vec2 *profile, int points, int slices)
{
    owned_mesh m = mesh_new((slices + 1) * points, 6 * slices * (points - 1));
    uint32_t *out = m.indices;
    for (int i = 0; i < points; i++) {
        shade_vec2 p = profile[i], before = profile[i > 0 ? i - 1 : 0];
        shade_vec2 after = profile[i < points - 1 ? i + 1 : i], along = { 0, 0 };
        if (p.x != before.x || p.y != before.y) along = shade_sub2(p, before);
        if (p.x != after.x || p.y != after.y) along = shade_add2(along, shade_sub2(after, p));
        for (int j = 0; j <= slices; j++) {
            shade_vec2 a = mesh_turn((float)(j % slices) / (float)slices);
            shade_vec3 n = shade_v3(-along.y * a.x, along.x, along.y * a.y);
            uint32_t k = (uint32_t)(i * (slices + 1) + j), below = k + (uint32_t)slices + 1;
            mesh_put(&m, (int)k, shade_v3(p.x * a.x, p.y, -p.x * a.y), shade_normalize(n),
                     (float)j / (float)slices, (float)i / (float)(points - 1));
            if (i == points - 1 || j == slices) continue;
            *out++ = k;
            *out++ = below;
            *out++ = below + 1;
            *out++ = k;
            *out++ = below + 1;
            *out++ = k + 1;
        }
    }
    return m;
}

/* A candle of radius .34 at its foot and height .9 */
static inline owned_mesh shape_candle(void)
{
    static const shade_vec2 rod[4] = { { 0, 0.85f }, { 0.3f, 0.9f }, { 0.3f, 0.9f }, { 0.34f, 0 } };
    return shape_turned(rod, 4, 48);
}

/* A jar of glass without a lid, 2.6 high */
static inline owned_mesh shape_jar(void)
{
    enum { RINGS = 40 };
    shade_vec2 belly[RINGS];
    for (int i = 0; i < RINGS; i++) {
        float t = (float)i / (RINGS - 1);
        belly[i] = shade_v2(0.68f - 0.08f * t + 0.38f * mesh_turn(0.5f * t).y, 2.6f * (1 - t));
    }
    return shape_turned(belly, RINGS, 64);
}

/* A matrix that scales by size, turns about y and moves to x, y, z */
static inline shade_mat4 shape_at(float x, float y, float z, float size, float turn)
{
    shade_mat4 m = shade_mat4_mul(shade_mat4_rotation(turn, shade_v3(0, 1, 0)),
                                  shade_mat4_scaling(shade_v3(size, size, size)));
    return shade_mat4_mul(shade_mat4_translation(shade_v3(x, y, z)), m);
}

/* The place of leaf i of those around a jar at the origin: on the ground, and every eighth one in
   the air */
static inline shade_mat4 shape_fallen(int i)
{
    float random[5] = { 0.7549f, 0.41f, 0.33f, 0.618034f, 0.57f };
    for (int k = 0; k < 5; k++) {
        float x = (float)(i + 1) * random[k];
        random[k] = x - (float)(int)x;
    }
    float r = 1.3f + (i % 8 ? 4 : 2.0f) * random[0], y = i % 8 ? 0 : 2.6f * random[1];
    float tilt = i % 8 ? 0.2f : 6 * random[2];
    shade_vec2 a = mesh_turn(random[3]);
    return shade_mat4_mul(shape_at(r * a.x, 0.05f + y, r * a.y, 0.22f, 40 * random[4]),
                          shade_mat4_rotation(tilt, shade_v3(1, 0, 0)));
}

/* A star in the plane y = 0: triangles from its middle outward, as wide as the gaps between them */
static inline owned_mesh shape_star(int rays)
{
    owned_mesh m = mesh_new(3 * rays, 3 * rays);
    for (int i = 0; i < 3 * rays; i++) {
        shade_vec2 a = mesh_turn(((float)(i / 3) + (i % 3 == 2 ? 0.5f : 0)) / (float)rays);
        float r = i % 3 ? 5.0f : 0.0f;
        mesh_put(&m, i, shade_v3(r * a.x, 0, -r * a.y), shade_v3(0, 1, 0), 0, 0);
        m.indices[i] = (uint32_t)i;
    }
    return m;
}

/* A tube that winds thrice around a torus while going twice along it, striped like candy */
static inline owned_mesh shape_knot(int cells)
{
    owned_mesh m = mesh_plane(1, cells);
    m.view.colors = m.colors = (float *)example_memory((size_t)m.view.vertex_count, 12);
    for (int i = 0; i < m.view.vertex_count; i++) {
        int u = i % (cells + 1) % cells, v = i / (cells + 1) % cells, pale = v * 8 / cells % 2;
        float t = (float)u / (float)cells, s = (float)v / (float)cells;
        shade_vec2 a = mesh_turn(2 * t), b = mesh_turn(3 * t), c = mesh_turn(s + 6 * t);
        float r = 2.1f + b.x;
        shade_vec3 up = shade_v3(b.x * a.x, b.x * a.y, b.y);
        shade_vec3 T = shade_v3(-3 * b.y * a.x - 2 * r * a.y, 2 * r * a.x - 3 * b.y * a.y, 3 * b.x);
        shade_vec3 N = shade_madd(shade_scale(up, c.x), c.y, shade_cross(shade_normalize(T), up));
        mesh_put(&m, i, shade_madd(shade_v3(r * a.x, r * a.y, b.y), 0.55f, N), N, 0, 0);
        m.colors[3 * i] = pale ? 0.82f : 0.62f;
        m.colors[3 * i + 1] = pale ? 0.72f : 0.02f;
        m.colors[3 * i + 2] = pale ? 0.58f : 0.03f;
    }
    return m;
}

/* A square with round corners of so many facets, radius .5, from y = -1 to y = 1.  The normals are
   those of its round side; triangles come in fours: two of the side, one of each lid. */
static inline owned_mesh shape_block(int facets)
{
    const uint32_t ring = 4 * ((uint32_t)facets + 1), top = 2 * ring, below = top + 1;
    owned_mesh m = mesh_new((int)below + 1, (int)(12 * ring));
    uint32_t *out = m.indices;
    for (uint32_t i = 0; i < ring; i++) {
        uint32_t a = i, b = (i + 1) % ring, c = a + ring, d = b + ring;
        uint32_t triangles[12] = { a, c, d, a, d, b, top, a, b, below, d, c };
        int quarter = (int)i / (facets + 1);
        float part = (float)((int)i % (facets + 1)) / (float)facets;
        shade_vec2 t = mesh_turn(((float)quarter + part) / 4);
        shade_vec2 corner = mesh_turn(((float)quarter + 0.5f) / 4);
        float x = 0.5f * t.x + 0.707107f * corner.x, z = -0.5f * t.y - 0.707107f * corner.y;
        mesh_put(&m, (int)a, shade_v3(x, 1, z), shade_v3(t.x, 0, -t.y), 0, 0);
        mesh_put(&m, (int)c, shade_v3(x, -1, z), shade_v3(t.x, 0, -t.y), 0, 0);
        for (int k = 0; k < 12; k++) *out++ = triangles[k];
    }
    mesh_put(&m, (int)top, shade_v3(0, 1, 0), shade_v3(0, 1, 0), 0, 0);
    mesh_put(&m, (int)below, shade_v3(0, -1, 0), shade_v3(0, -1, 0), 0, 0);
    return m;
}

/* Transforms points and normals by a matrix that does not scale. */
static inline owned_mesh shape_moved(owned_mesh m, shade_mat4 at)
{
    for (int i = 0; i < m.view.vertex_count; i++) {
        const float *p = m.positions + 3 * i, *n = m.normals + 3 * i;
        mesh_put(&m, i, shade_mat4_transform_point(at, shade_v3(p[0], p[1], p[2])),
                 shade_mat4_transform_direction(at, shade_v3(n[0], n[1], n[2])),
                 m.texcoords[2 * i], m.texcoords[2 * i + 1]);
    }
    return m;
}

/* Joins two meshes into one, the triangles of a first, and frees both. */
static inline owned_mesh shape_join(owned_mesh a, owned_mesh b)
{
    int first = a.view.vertex_count, corners = a.view.index_count;
    owned_mesh m = mesh_new(first + b.view.vertex_count, corners + b.view.index_count);
    for (int i = 0; i < m.view.vertex_count; i++) {
        const owned_mesh *from = i < first ? &a : &b;
        int k = i < first ? i : i - first;
        const float *p = from->positions + 3 * k, *n = from->normals + 3 * k;
        mesh_put(&m, i, shade_v3(p[0], p[1], p[2]), shade_v3(n[0], n[1], n[2]),
                 from->texcoords[2 * k], from->texcoords[2 * k + 1]);
    }
    for (int i = 0; i < m.view.index_count; i++)
        m.indices[i] = i < corners ? a.indices[i] : b.indices[i - corners] + (uint32_t)first;
    mesh_free(&a);
    mesh_free(&b);
    return m;
}
#endif
