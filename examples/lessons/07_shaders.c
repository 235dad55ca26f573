/* 07_shaders.c - a fragment and a vertex shader of your own, as UW and Massey write them in GLSL.
   The fragment shader computes N.L, cuts it into steps, paints stripes and inks rims.  The vertex
   shader moves each P along its N by a wave, and tilts N to match.  GLSL calls main() once for each
   pixel; here one call has a packet of them, so the body of the loop is GLSL's main.
   Try it without the line that tilts N: the outline keeps its ripples, the light ignores them.

   cc -O2 -I. examples/lessons/07_shaders.c -lm -o shaders && ./shaders        writes shaders.ppm */
#define SHADE_IMPLEMENTATION
#include "shade.h"
#include "../shared/shapes.h"
#include "../shared/label.h"

static const float height = 0.03f, waves = 3.2f;    /* of a wave, and how many in a unit of y */
typedef struct scene {    /* the uniforms */
    shade_mat4 camera;    /* projection times view */
    shade_vec3 eye, L;    /* the lamp is at infinity: L is the same everywhere */
    const shade_mesh *pot;
} scene;

static void toon(const void *uniforms, const shade_fragments *SHADE_RESTRICT in,
                 shade_colors *SHADE_RESTRICT out)
{
    shade_vec3 sand = { .95f, .55f, .16f }, sea = { .1f, .32f, .4f }, white = { 1, 1, 1 };
    const scene *s = (const scene *)uniforms;
    SHADE_EACH_LANE(i) {
        shade_vec3 P = lane(in->varying[0], i), N = shade_normalize(lane(in->varying[3], i));
        shade_vec3 V = shade_normalize(shade_sub(s->eye, P));
        float light = 0.1f + 0.9f * shade_lambert(N, s->L);    /* N.L, and ambient light */
        float step = (float)(int)(4 * light + 0.6f) / 4;          /* 0, 1/4, 1/2 ... */
        float stripe = 1.6f * P.y - (float)(int)(1.6f * P.y);     /* from 0 to 1, again and again */
        shade_vec3 color = shade_scale(stripe < 0.5f ? sand : sea, step);
        if (shade_blinn_phong_specular(N, s->L, V, 60) > 0.5f) color = white;
        if (shade_dot(N, V) < 0.25f && in->front[i]) color = shade_scale(color, 0.1f);    /* ink */
        lane_put(out->color[0], i, color);
    }
}

static void ripple(const void *uniforms, const shade_vertex_ids *SHADE_RESTRICT in,
                   shade_vertices *SHADE_RESTRICT out)
{
    const scene *s = (const scene *)uniforms;
    SHADE_EACH_LANE(i) {
        const float *p = s->pot->positions + 3 * in->index[i];
        const float *n = s->pot->normals + 3 * in->index[i];
        shade_vec3 P = { p[0], p[1], p[2] }, N = { n[0], n[1], n[2] };
        shade_vec2 turn = mesh_turn(waves * P.y);    /* cosine and sine of 2 pi waves y */
        float h = height * turn.y, slope = 6.2831853f * waves * height * turn.x;    /* dh/dy */
        shade_vec3 up = shade_madd(shade_v3(0, 1, 0), -N.y, N);    /* (0,1,0) less its part on N */
        P = shade_madd(P, h, N);    /* P + h N */
        N = shade_madd(N, -slope, up);    /* N - slope up: uphill is up, so N leans back from it */
        lane_put4(out->clip[0], i, shade_mat4_transform(s->camera, shade_v4(P.x, P.y, P.z, 1)));
        lane_put(out->varying[0], i, P);
        lane_put(out->varying[3], i, N);
    }
}

int main(int argc, char **argv)
{
    const shade_vec3 ink = { 0 }, aim = { 0.3f, 1.2f, 0 }, up = { 0, 1, 0 };
    owned_mesh pot = shape_teapot(40);
    canvas c = canvas_new(960, 640, 3);
    scene s = { .pot = &pot.view, .eye = { -1.2f, 4.6f, 9 } };
    shade_pipeline pipeline = { ripple, toon, &s, .varyings = 6 };
    s.L = shade_normalize(shade_v3(-0.6f, 0.8f, 0.7f));
    s.camera = shade_mat4_mul(shade_mat4_perspective(0.55f, 960 / 640.0f, 4, 20),
                              shade_mat4_look_at(s.eye, aim, up));
    canvas_gradient(&c.target, shade_v3(0.75f, 0.80f, 0.80f), shade_v3(0.95f, 0.88f, 0.75f));
    mesh_draw(&c.target, &pipeline, &pot);
    label_draw(&c, 24, 592, 22, ink, "fragment shader: N·L in steps, ink where N·V < 1/4");
    label_print(&c, 24, 622, 22, ink, "vertex shader: P + h N, h = %g sin(2π %g y), N tilted",
                (double)height, (double)waves);
    mesh_free(&pot);
    return canvas_save(&c, argc, argv, "shaders.ppm");
}
