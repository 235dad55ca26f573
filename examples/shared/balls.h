/* balls.h - balls on a floor under lamps, with their shadows: each pixel sends a ray to each lamp,
   which gives the lamp's visibility. */
#ifndef SHARED_BALLS_H
#define SHARED_BALLS_H

#include "shapes.h"
#include <math.h>

enum { BALLS_LAMPS = 2 };    /* no more lamps than these */

typedef struct balls {
    int count;
    const shade_vec4 *at; /* centres and, as w, radii */
    const shade_vec3 *color;
    shade_vec3 floor; /* colour of the plane y = 0 */
    shade_lighting lighting;
    shade_vec3 eye, center; /* the camera, and the point it looks at */
    float fovy;
    int no_shadows;
} balls;

typedef struct balls_uniforms {
    mesh_scene place;
    const balls *scene;
    shade_material material;
} balls_uniforms;

/* The distance along a ray at which it enters a ball (a centre; w: the radius); -1: never */
static inline float balls_meet(shade_ray ray, shade_vec4 ball)
{
    shade_vec3 from = shade_sub(ray.origin, shade_v3(ball.x, ball.y, ball.z));
    float b = shade_dot(from, ray.direction);
    float d = b * b - shade_dot(from, from) + ball.w * ball.w;
    return d > 0 ? -b - sqrtf(d) : -1;
}

/* 1 where no ball stands between P and the lamp.  A ball does not hide its own lit side, whose rays
   leave it. */
static inline float balls_visibility(const balls *b, const shade_light *lamp, shade_vec3 P)
{
    shade_vec3 L;
    float r;
    shade_light_at(lamp, P, &L, &r);
    for (int i = 0; i < b->count && !b->no_shadows; i++) {
        shade_vec3 to = shade_sub(shade_v3(b->at[i].x, b->at[i].y, b->at[i].z), P);
        float along = shade_dot(to, L), beside = shade_dot(to, to) - along * along;
        if (along > 0 && along < r && beside < b->at[i].w * b->at[i].w) return 0;
    }
    return 1;
}

static inline void balls_fragment(const void *uniforms, const shade_fragments *SHADE_RESTRICT in,
                                  shade_colors *SHADE_RESTRICT out)
{
    const balls_uniforms *u = (const balls_uniforms *)uniforms;
    const shade_lighting *lighting = &u->scene->lighting;
    float visibility[BALLS_LAMPS][SHADE_LANES];
    const shade_rows rows = { .position = in->varying[0], .normal = in->varying[3],
                              .visibility = visibility[0] };
    for (int k = 0; k < lighting->light_count; k++) {
        SHADE_EACH_LANE(i) {
            shade_vec3 P = lane(in->varying[0], i);
            visibility[k][i] = balls_visibility(u->scene, &lighting->lights[k], P);
        }
    }
    shade_lit_lanes(lighting, &u->material, u->scene->eye, &rows, out->color[0]);
}

/* Draws a mesh at the place at, scaled by at.w. */
static inline void balls_part(const shade_target *target, balls_uniforms *u, const owned_mesh *m,
                              shade_vec4 at)
{
    shade_pipeline pipeline = { mesh_vertex, balls_fragment, u, .varyings = 8 };
    u->place.mesh = m;
    u->place.model = shape_at(at.x, at.y, at.z, at.w, 0);
    mesh_draw(target, &pipeline, m);
}

/* Draws floor and balls, and lamps that are not at infinity as small bright balls. */
static inline void balls_draw(const shade_target *target, const balls *b)
{
    owned_mesh plane = mesh_plane(60, 1), sphere = mesh_sphere(96, 48);
    float aspect = (float)target->width / (float)target->height;
    balls_uniforms u = { .scene = b };
    u.place.clip_from_world =
        shade_mat4_mul(shade_mat4_perspective(b->fovy, aspect, 0.5f, 80),
                       shade_mat4_look_at(b->eye, b->center, shade_v3(0, 1, 0)));
    u.material.ambient = u.material.diffuse = b->floor;
    balls_part(target, &u, &plane, shade_v4(0, 0, 0, 1));
    u.material.specular = shade_v3(0.4f, 0.4f, 0.4f);
    u.material.shininess = 60;
    for (int i = 0; i < b->count; i++) {
        u.material.ambient = u.material.diffuse = b->color[i];
        balls_part(target, &u, &sphere, b->at[i]);
    }
    u.material.ambient = u.material.diffuse = u.material.specular = shade_v3(0, 0, 0);
    u.material.emission = shade_v3(1, 0.95f, 0.85f);
    for (int i = 0; i < b->lighting.light_count; i++) {
        shade_vec4 at = b->lighting.lights[i].position;
        if (at.w != 0) balls_part(target, &u, &sphere, shade_v4(at.x, at.y, at.z, 0.07f));
    }
    mesh_free(&plane);
    mesh_free(&sphere);
}
#endif
