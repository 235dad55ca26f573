/* deform.h - moves the vertices of a mesh of a scene, whose faces stay: nothing is checked,
   welded, cut into chunks or sorted again, and the bits are those of a new mesh.

       renderer_moved m = { .positions = p, .vertex_count = n, .faces = f, .index_count = 3 * k };
       renderer_deform(scene, number, &m);

   Pictures that are being drawn keep the vertices that they began with: two copies of a mesh that
   moves take turns. */
#ifndef SHARED_DEFORM_H
#define SHARED_DEFORM_H

#include "renderer.h"

typedef enum renderer_shading {
    RENDERER_FLAT,   /* a vertex for each corner, with the normal of its face */
    RENDERER_SMOOTH, /* the mean of the faces at a vertex, by their angles */
    RENDERER_GIVEN
} renderer_shading;

typedef struct renderer_moved {
    const float *positions; /* of each vertex, as finite numbers */
    float *given;           /* normals of each vertex; NULL: none are given */
    const uint32_t *faces;  /* corners, all below vertex_count */
    int vertex_count, index_count;
    int normals; /* renderer_shading */
    int unused;
    double origin[3];
} renderer_moved;

/* The plane of face i, and its normal */
static inline shade_vec3 renderer_plane_of(renderer_shape *s, int i, shade_vec3 a, shade_vec3 b,
                                           shade_vec3 c)
{
    const size_t row = renderer_plane_row(s);
    const shade_vec3 n = shade_face_normal(a, b, c);
    float *plane = s->planes + i;
    plane[0] = n.x;
    plane[row] = n.y;
    plane[2 * row] = n.z;
    plane[3 * row] = shade_dot(n, a);
    return n;
}

/* Planes of all faces, and of a flat mesh its corners and their normals, in one pass */
static inline void renderer_move_faces(renderer_shape *s, const renderer_moved *m)
{
    for (int i = 0; i < m->index_count; i += 3) {
        shade_vec3 p[3], n;
        float *to = s->positions + 3 * (size_t)i, *normal = s->normals + 3 * (size_t)i;
        for (int k = 0; k < 3; k++) p[k] = renderer_get(m->positions + 3 * (size_t)m->faces[i + k]);
        n = renderer_plane_of(s, i / 3, p[0], p[1], p[2]);
        if (m->normals != RENDERER_FLAT) continue;
        memcpy(to, p, sizeof p);
        for (int k = 0; k < 3; k++) memcpy(normal + 3 * k, &n, sizeof n);
    }
}

static inline shade_result renderer_move_vertices(renderer_shape *s, const renderer_moved *m)
{
    const size_t bytes = (size_t)m->vertex_count * 3 * sizeof(float);
    const shade_mesh moved = { .positions = s->positions,
                               .vertex_count = m->vertex_count,
                               .indices = s->indices,
                               .index_count = m->index_count };
    if (m->normals == RENDERER_FLAT) return SHADE_OK;
    memcpy(s->positions, m->positions, bytes);
    if (m->normals == RENDERER_GIVEN) memcpy(s->normals, m->given, bytes);
    if (m->normals == RENDERER_GIVEN) return SHADE_OK;
    return shade_mesh_normals(&moved, (shade_vec3 *)(void *)s->normals);
}

/* The sphere around all vertices of the shape */
static inline void renderer_move_bounds(renderer_shape *s)
{
    shade_vec3 low = shade_v3(1e30f, 1e30f, 1e30f), high = shade_neg(low);
    for (int i = 0; i < s->vertex_count; i++) {
        const shade_vec3 a = renderer_get(s->positions + 3 * (size_t)i);
        low = shade_min(low, a);
        high = shade_max(high, a);
    }
    s->centre = shade_scale(shade_add(low, high), 0.5f);
    s->radius = 0.5001f * shade_distance(low, high);
}

/* A shape with all that does not move of another one, and room for the rest.  0: out of memory */
static inline int renderer_shape_like(renderer_shape *s, const renderer_shape *of)
{
    const size_t vertices = (size_t)of->vertex_count, planes = 4 * renderer_plane_row(of);
    *s = *of;
    s->users = renderer_count_new();
    s->positions = (float *)malloc(vertices * 3 * sizeof(float) + 1);
    s->normals = (float *)malloc(vertices * 3 * sizeof(float) + 1);
    s->planes = (float *)calloc(planes + 1, sizeof(float));
    s->indices = (uint32_t *)renderer_twin(of->indices, of->index_count, sizeof *s->indices);
    s->texcoords = s->colors = NULL;
    if (s->users && s->positions && s->normals && s->planes && s->indices &&
        renderer_copy(&s->texcoords, of->texcoords, of->vertex_count, 2) &&
        renderer_copy(&s->colors, of->colors, of->vertex_count, 3))
        return 1;
    renderer_shape_free(s);
    return 0;
}

/* Takes the copy that rests, or else makes one of what is drawn, which is held until then.  1:
   done, 0: out of memory, -1: the mesh has other counts */
static inline int renderer_take_spare(renderer_scene *scene, int number, const renderer_moved *m,
                                      renderer_shape *s)
{
    static const renderer_shape none;
    const int vertices = m->normals == RENDERER_FLAT ? m->index_count : m->vertex_count;
    renderer_shape now;
    int there = 0, same;
    renderer_lock();
    now = number < scene->mesh_count ? scene->meshes[number] : none;
    same = now.users && m->index_count == now.index_count && vertices == now.vertex_count;
    if (same && number < scene->spare_count && scene->spares[number].users) {
        *s = scene->spares[number];
        scene->spares[number] = none;
        there = 1;
    } else if (same)
        ++*now.users;
    renderer_unlock();
    if (there || !same) return there ? 1 : -1;
    there = renderer_shape_like(s, &now);
    renderer_lock();
    renderer_shape_free(&now);
    renderer_unlock();
    return there;
}

/* Puts a shape in the place of a mesh, which rests where no picture has it. */
static inline int renderer_put_moved(renderer_scene *scene, int number, renderer_shape *s)
{
    renderer_shape *all, old;
    renderer_lock();
    all = (renderer_shape *)renderer_reach_to(scene->spares, &scene->spare_count, number,
                                              sizeof *all);
    if (all) scene->spares = all;
    if (!all || !renderer_own(scene)) {
        renderer_shape_free(s);
        renderer_unlock();
        return 0;
    }
    old = scene->meshes[number];
    scene->meshes[number] = *s;
    scene->version++;
    renderer_shape_free(&all[number]);
    if (*old.users == 1)
        all[number] = old;
    else
        renderer_shape_free(&old);
    renderer_unlock();
    return 1;
}

/* Moves the vertices of a mesh.  1: done, 0: out of memory, -1: it has other counts, -2: a
   position is not finite; but for 1 nothing has changed */
static inline int renderer_deform(renderer_scene *scene, int number, const renderer_moved *m)
{
    renderer_shape s;
    int taken;
    for (size_t i = 0; i < 3 * (size_t)m->vertex_count; i++)
        if (!(m->positions[i] <= 3e38f && m->positions[i] >= -3e38f)) return -2;
    taken = renderer_take_spare(scene, number, m, &s);
    if (taken < 1) return taken;
    renderer_move_faces(&s, m);
    if (renderer_move_vertices(&s, m)) {
        renderer_lock();
        renderer_shape_free(&s);
        renderer_unlock();
        return 0;
    }
    renderer_move_bounds(&s);
    memcpy(s.origin, m->origin, sizeof s.origin);
    return renderer_put_moved(scene, number, &s);
}
#endif
