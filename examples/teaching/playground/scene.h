/* scene.h - what the playground can show beside teapot and sphere: a row of balls, an open ribbon,
   a floor with a back wall. */
#ifndef PLAYGROUND_SCENE_H
#define PLAYGROUND_SCENE_H

#include "../../shared/shapes.h"

/* Five balls along x, from -1 to 1, so that each is farther from a lamp at one end */
static inline owned_mesh scene_balls(int detail)
{
    owned_mesh row = { { 0 }, 0, 0, 0, 0, 0, 0, 0 };
    for (int i = 0; i < 5; i++) {
        owned_mesh ball = mesh_sphere(4 * detail, 2 * detail);
        for (int k = 0; k < 3 * ball.view.vertex_count; k++) ball.positions[k] *= 0.17f;
        ball = shape_moved(ball, shade_mat4_translation(shade_v3(0.415f * (float)i - 0.83f, 0, 0)));
        row = i ? shape_join(row, ball) : ball;
    }
    return row;
}

/* A band that winds one and three quarters of a turn about y: the outside in front, the inside
   behind it.  Its normals point outward on both sides. */
static inline owned_mesh scene_ribbon(int detail)
{
    const int cells = 6 * detail;
    owned_mesh m = mesh_plane(1, cells);
    for (int i = 0; i < m.view.vertex_count; i++) {
        const float u = (float)(i % (cells + 1)) / (float)cells;
        const float v = (float)(i / (cells + 1)) / (float)cells;
        const shade_vec2 a = mesh_turn(1.75f * u - 0.05f);
        const shade_vec3 n = shade_v3(a.x, 0, -a.y);
        const float r = 0.55f + 0.3f * u;
        mesh_put(&m, i, shade_v3(r * a.x, 0.75f * (u - 0.5f) - 0.4f * (v - 0.5f), -r * a.y), n, u,
                 v);
    }
    return m;
}

/* A floor in y = 0 and a wall behind it in z = -2, matte and grey */
static inline owned_mesh scene_room(void)
{
    const shade_mat4 upright = shade_mat4_mul(shade_mat4_translation(shade_v3(0, 6, -2)),
                                              shade_mat4_rotation(1.57079633f, shade_v3(1, 0, 0)));
    owned_mesh floor = shape_moved(mesh_plane(6, 24), shade_mat4_translation(shade_v3(0, 0, 4)));
    return shape_join(floor, shape_moved(mesh_plane(6, 24), upright));
}

static const shade_material scene_grey = { { 0, 0, 0 }, { 0.4f, 0.4f, 0.4f }, { 0.4f, 0.4f, 0.4f },
                                           { 0, 0, 0 }, 1 };

/* Draws the room as state says, below a model that pitch alone tilts. */
static inline void scene_draw_room(const shade_target *target, const shade_mesh *room,
                                   shade_draw_state state, float pitch, float floor)
{
    state.material = &scene_grey;
    state.raster.cull = SHADE_CULL_BACK;             /* from below it hides nothing */
    state.model = shade_mat4_mul(shade_mat4_rotation(pitch, shade_v3(1, 0, 0)),
                                 shade_mat4_translation(shade_v3(0, floor, 0)));
    shade_draw_mesh(target, room, &state, NULL);
}
#endif
