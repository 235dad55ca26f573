/* 33_not_lambert.c - two surfaces that Lambert's law does not fit, by a fragment shader (Shirley's
   exercises).  The full moon is as bright at its rim as in its middle, velvet is brightest at its
   rims.  Both are a layer of grains or fibres, which scatter light once, over a ground:
       I = k_d (N.L) T + k (N.L) / ((N.L) + (N.V)) (1 - T),   T = e^-(tau / (N.L) + tau / (N.V))
   tau = 0 is no layer: Lambert.  A large tau is the Lommel-Seeliger law, with k = 2 for 1 at full
   moon as in A. McEwen, Lunar and Planetary Science 27 (1996), 841.  With a small tau the layer
   adds tau / (N.V), a bright rim (J. Koenderink, S. Pont, "The secret of velvety skin", Machine
   Vision and Applications 14 (2003), 260-268).
   Try shade_v3(1, 0, 0) for the moon's sun: half moons, of which the right one's edge to the night
   is twice as steep.

   cc -O2 -I. examples/lessons/33_not_lambert.c -lm -o not_lambert && ./not_lambert */
#define SHADE_IMPLEMENTATION
#include "shade.h"
#include "../shared/shapes.h"
#include "../shared/paint.h"
#include "../shared/label.h"

static const shade_vec3 eye = { 0, 0, 100 };
typedef struct scene {
    mesh_scene place;
    shade_light sun;
    shade_vec3 k_d, k;
    float tau, seas;    /* dark plains of the moon */
} scene;

static void scatter(const void *uniforms, const shade_fragments *SHADE_RESTRICT in,
                    shade_colors *SHADE_RESTRICT out)
{
    const scene *s = (const scene *)uniforms;
    const float (*v)[SHADE_LANES] = in->varying;
    float L[3][SHADE_LANES], amount[SHADE_LANES];
    shade_light_at_lanes(&s->sun, v[0], L[0], amount);
    SHADE_EACH_LANE(i) {
        shade_vec3 P = lane(v[0], i), at = shade_add(P, shade_v3(0.4f, -0.2f, 0.3f));
        shade_vec3 N = shade_normalize(lane(v[3], i));
        float NL = shade_lambert(N, lane(L[0], i)) + 1e-6f;
        float NV = shade_lambert(N, shade_normalize(shade_sub(eye, P))) + 1e-6f;
        float T = shade_power(0.36787944f, s->tau / NL + s->tau / NV);
        float sea = s->seas * noise(shade_scale(at, 3.1f)) * noise(shade_scale(at, 5));
        float E = NL * (amount[i] - sea), layer = E / (NL + NV) * (1 - T);
        shade_vec3 I = shade_madd(shade_scale(s->k_d, E * T), layer, s->k);
        lane_put(out->color[0], i, I);
    }
}

int main(int argc, char **argv)
{
    static const char *const name[4] = { "moon, Lambert", "moon, Lommel-Seeliger, τ = 100",
                                         "pot, Lambert", "pot, velvet, τ = 0.05" };
    static const char *const formula[4] = { "N·L", "2 N·L / (N·L + N·V)", "k_d N·L",
                                            "k_d N·L T + k N·L / (N·L + N·V) (1 − T)" };
    static const float tau[4] = { 0, 100, 0, 0.05f };
    const shade_vec3 moon = { 0.8f, 0.78f, 0.72f }, red = { 0.35f, 0.008f, 0.02f };
    const shade_vec3 fibre = { 1.5f, 0.6f, 0.7f }, grey = { 0.7f, 0.7f, 0.7f };
    owned_mesh of[2] = { mesh_sphere(128, 64), shape_teapot(24) };
    const shade_mat4 tilt = shade_mat4_rotation(0.45f, shade_v3(1, 0, 0));
    const shade_mat4 place[2] = {
        shape_at(0, 0, 0, 1, 0), shade_mat4_mul(tilt, shape_at(-0.05f, -0.8f, 0, 0.55f, 0.3f)) };
    canvas c = canvas_new(960, 750, 4);
    shade_mat4 view = shade_mat4_look_at(eye, shade_v3(0, 0, 0), shade_v3(0, 1, 0));
    view = shade_mat4_mul(shade_mat4_perspective(0.0228f, 480 / 300.0f, 90, 110), view);
    canvas_dark(&c.target);
    for (int i = 0; i < 4; i++) {
        int x = 480 * (i % 2), y = 360 * (i / 2), pot = i / 2;
        shade_target panel = canvas_panel(&c, x, y, 480, 300);
        scene s = { .place = { &of[pot], place[pot], view }, .tau = tau[i], .seas = pot ? 0 : 1 };
        s.k_d = pot ? red : moon;
        s.k = pot ? fibre : shade_scale(moon, 2);
        s.sun = shade_directional_light(pot ? shade_v3(0.2f, -0.4f, -1) : shade_v3(0, 0, -1), moon);
        shade_pipeline pipeline = { mesh_vertex, scatter, &s, .varyings = 8 };
        mesh_draw(&panel, &pipeline, &of[pot]);
        label_caption(&c, x + 240, y + 322, grey, name[i], formula[i]);
        if (i == 3) label_center(&c, 720, 735, 19, grey, "T = e^{−τ/(N·L) − τ/(N·V)}");
    }
    mesh_free(&of[0]);
    mesh_free(&of[1]);
    return canvas_save(&c, argc, argv, "not_lambert.ppm");
}
