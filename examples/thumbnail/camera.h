/* camera.h - the camera that sees all of a model, from as near as it can. */
#ifndef THUMBNAIL_CAMERA_H
#define THUMBNAIL_CAMERA_H

#include "../shared/mesh.h"

typedef struct camera {
    shade_mat4 view, projection;
    shade_vec3 eye;
} camera;

/* The camera looks along a fixed direction.  Every point must lie inside four planes through the
   eye, and each plane gives one linear bound: their extremes give the nearest eye, and the
   sideways shift that centres. */
static camera camera_frame(const owned_mesh *m, float aspect)
{
    const float half = shade_radians(14), margin = 1.10f;
    shade_mat4 turn =
        shade_mat4_look_at(shade_v3(0, 0.36f, 1), shade_v3(0, 0, 0), shade_v3(0, 1, 0));
    shade_mat4 lens, world;
    float slope_y, slope_x, left = -9, right = -9, below = -9, above = -9, front = -9, back = 9, d;
    camera c;
    turn.col[3] = shade_v4(0, 0, 0, 1);
    lens = shade_mat4_perspective(2 * half, 1, 1, 2);
    slope_y = 1 / lens.col[1].y;
    slope_x = slope_y * aspect;
    for (size_t i = 0; i < 3 * (size_t)m->view.vertex_count; i += 3) {
        const float *p = m->positions + i;
        shade_vec3 q = shade_mat4_transform_direction(turn, shade_v3(p[0], p[1], p[2]));
        right = fmaxf(right, q.x + slope_x * q.z);
        left = fmaxf(left, -q.x + slope_x * q.z);
        above = fmaxf(above, q.y + slope_y * q.z);
        below = fmaxf(below, -q.y + slope_y * q.z);
        front = fmaxf(front, q.z);
        back = fminf(back, q.z);
    }
    d = fmaxf((right + left) / (2 * slope_x), (above + below) / (2 * slope_y)) * margin;
    d = fmaxf(d, front + 0.05f);
    c.view = shade_mat4_mul(
        shade_mat4_translation(shade_v3((left - right) / 2, (below - above) / 2, -d)), turn);
    c.projection =
        shade_mat4_perspective(2 * half, aspect, 0.04f * (d - front) + 0.001f, d - back + 4);
    world = shade_mat4_inverse(c.view);
    c.eye = shade_v3(world.col[3].x, world.col[3].y, world.col[3].z);
    return c;
}
#endif
