/* 07_shaders.c - a vertex and a fragment shader of your own, as UW and Massey write them in GLSL.
   The vertex shader moves each point along its normal and tilts the normal to match.  The fragment
   shader cuts light into steps, paints stripes and inks rims.  Each works on a row of lanes.
   Try it without the line that tilts N: the outline keeps its ripples, the light ignores them.

   cc -O2 -I. examples/lessons/07_shaders.c -lm -o shaders && ./shaders        writes shaders.ppm */
#define SHADE_IMPLEMENTATION
#include "shade.h"
#include "../shared/shapes.h"
#include "../shared/label.h"

typedef struct scene {    /* the uniforms */
    shade_mat4 clip_from_world;
    shade_vec3 eye;
    shade_lighting lighting;
    shade_material material;
    const shade_vec3 *positions, *normals;
} scene;

static void ripple(const void *uniforms, const shade_vertex_ids *SHADE_RESTRICT in,
                   shade_vertices *SHADE_RESTRICT out)
{
    const float height = 0.03f, waves = 3.2f;    /* of a wave, and how many in a unit of y */
    const scene *s = (const scene *)uniforms;
    SHADE_EACH_LANE(i) {
        shade_vec3 P = s->positions[in->index[i]], N = s->normals[in->index[i]];
        shade_vec2 turn = mesh_turn(waves * P.y);    /* cosine and sine */
        float h = height * turn.y, dh = 6.2831853f * waves * height * turn.x;    /* dh/dy */
        shade_vec3 along = shade_madd(shade_v3(0, 1, 0), -N.y, N);    /* y's part in the surface */
        P = shade_madd(P, h, N);
        N = shade_madd(N, -dh, along);    /* what rises along the surface tilts the normal back */
        shade_vec4 clip = shade_mat4_transform(s->clip_from_world, shade_v4(P.x, P.y, P.z, 1));
        lane_put4(out->clip[0], i, clip);
        lane_put(out->varying[0], i, P);
        lane_put(out->varying[3], i, N);
    }
}

static void toon(const void *uniforms, const shade_fragments *SHADE_RESTRICT in,
                 shade_colors *SHADE_RESTRICT out)
{
    const shade_vec3 sand = { 0.95f, 0.55f, 0.16f }, blue = { 0.10f, 0.32f, 0.40f };
    const shade_vec3 shadow = { 0.02f, 0.01f, 0.03f };
    const scene *s = (const scene *)uniforms;
    const shade_rows rows = { .position = in->varying[0], .normal = in->varying[3] };
    float light[3][SHADE_LANES];
    shade_lit_lanes(&s->lighting, &s->material, s->eye, &rows, light[0]);
    SHADE_EACH_LANE(i) {
        shade_vec3 P = lane(in->varying[0], i), N = shade_normalize(lane(in->varying[3], i));
        shade_vec3 V = shade_normalize(shade_sub(s->eye, P));
        float step = (float)(int)(4 * light[0][i] + 0.6f) / 4;    /* 0, 1/4, 1/2 ... */
        float stripe = 1.6f * P.y - (float)(int)(1.6f * P.y);     /* from 0 to 1, again and again */
        float ink = shade_dot(N, V) < 0.25f && in->front[i] ? 0.1f : 1;
        shade_vec3 color = shade_madd(shadow, step, stripe < 0.5f ? sand : blue);
        lane_put(out->color[0], i, shade_scale(color, ink));
    }
}

int main(int argc, char **argv)
{
    const shade_vec3 ink = { 0, 0, 0 }, grey = { 0.85f, 0.85f, 0.85f };
    shade_light lamp = shade_directional_light(shade_v3(0.6f, -0.8f, -0.7f), shade_v3(1, 1, 1));
    owned_mesh pot = shape_teapot(40);
    canvas c = canvas_new(960, 640, 3);
    scene s = { .eye = { -1.2f, 4.6f, 9 }, .lighting = { &lamp, 1 },
                .material = { { 0 }, { 0 }, grey, shade_scale(grey, 0.6f), 60 },
                .positions = (const shade_vec3 *)pot.positions,
                .normals = (const shade_vec3 *)pot.normals };
    shade_pipeline pipeline = { ripple, toon, &s, .varyings = 6 };
    shade_mat4 view = shade_mat4_look_at(s.eye, shade_v3(0.3f, 1.2f, 0), shade_v3(0, 1, 0));

    s.clip_from_world = shade_mat4_mul(shade_mat4_perspective(0.55f, 960 / 640.0f, 4, 20), view);
    canvas_gradient(&c.target, shade_v3(0.75f, 0.80f, 0.80f), shade_v3(0.95f, 0.88f, 0.75f));
    mesh_draw(&c.target, &pipeline, &pot);
    label_draw(&c, 24, 592, 22, ink, "vertex shader: P + h N, h = 0.03 sin(2π 3.2 y), N tilted");
    label_draw(&c, 24, 622, 22, ink, "fragment shader: light in steps, ink where N·V < 1/4");
    mesh_free(&pot);
    return canvas_save(&c, argc, argv, "shaders.ppm");
}
