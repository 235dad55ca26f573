/* 47_by_hand.c - UW's iteration four in the letters of the notes, beside shade.h: three lamps, one
   weakened by distance, one in a cone.  Right: the difference, 10,000 times as bright.
   Try 1 for the 0 of B: behind the terminator N.L is negative, and lamps take light away.

   cc -O2 -I. examples/47_by_hand.c -lm -o by_hand && ./by_hand           writes by_hand.ppm */
#define SHADE_IMPLEMENTATION
#include "shade.h"
#include "shared/shapes.h"
#include "shared/label.h"

enum { SIZE = 318, HEIGHT = 262, LAMPS = 3, STEP = 321 };
typedef struct scene { shade_material k; shade_light lamp[LAMPS]; shade_vec3 eye; } scene;

static shade_vec3 by_hand(const scene *s, shade_vec3 P, shade_vec3 N)
{
    shade_vec3 I = s->k.emission, V = shade_normalize(shade_sub(s->eye, P));
    for (int j = 0; j < LAMPS; j++) {
        const shade_light *l = &s->lamp[j];
        const shade_vec3 Q = { l->position.x, l->position.y, l->position.z };
        const shade_vec3 S = shade_neg(shade_normalize(l->spot_direction));
        const float r = shade_distance(Q, P), a = l->constant, b = l->linear, c = l->quadratic;
        const shade_vec3 L = shade_normalize(shade_sub(Q, P));
        const shade_vec3 H = shade_normalize(shade_add(L, V));
        const float NL = shade_dot(N, L), NH = shade_dot(N, H), LS = shade_dot(L, S);
        const float B = NL > 0 ? 1 : 0, beta = LS >= l->spot_cos_cutoff ? 1 : 0;
        const float f_spot = shade_dot(S, S) > 0 ? beta * shade_power(LS, l->spot_exponent) : 1;
        const float f_atten = a + b + c > 0 ? 1 / (a + b * r + c * r * r) : 1;
        shade_vec3 k = shade_scale(s->k.diffuse, NL);
        k = shade_madd(k, shade_power(NH, s->k.shininess), s->k.specular);
        I = shade_add(I, shade_mul(s->k.ambient, l->ambient));
        I = shade_madd(I, f_spot * f_atten * B, shade_mul(l->diffuse, k));
    }
    return I;
}

static void fragment(const void *u, const shade_fragments *SHADE_RESTRICT in,
                     shade_colors *SHADE_RESTRICT out)
{
    SHADE_EACH_LANE(i) {
        shade_vec3 P = lane(in->varying[0], i), N = shade_normalize(lane(in->varying[3], i));
        lane_put(out->color[0], i, by_hand(u, P, N));
    }
}

int main(int argc, char **argv)
{
    const shade_vec3 grey = { 0.7f, 0.7f, 0.7f }, none = { 0, 0, 0 };
    scene s = { { none, grey, { 0.05f, 0.3f, 0.35f }, { 0.5f, 0.5f, 0.5f }, 40 },
                { shade_point_light(shade_v3(-5, 9, 7), grey),
                  shade_point_light(shade_v3(4, 1.5f, 2.5f), shade_v3(1.5f, 0.5f, 0.1f)),
                  shade_spot_light(shade_v3(-2, 2, 8), shade_v3(1, -2, -6), 0.11f, 90, grey) },
                { 0, 5, 13 } };
    shade_draw_state state = { .material = &s.k, .uniforms = &s };
    owned_mesh pot = shape_teapot(16);
    canvas c = canvas_new(960, 340, 1);
    shade_target panel[3];
    char text[60];
    float most;
    state.lighting.lights = s.lamp;
    state.lighting.light_count = LAMPS;
    s.lamp[0].ambient = shade_v3(0.03f, 0.03f, 0.04f);
    s.lamp[1].constant = s.lamp[1].quadratic = 0.3f;
    state.model = shape_at(-0.5f, -1.5f, -0.17f, 1, -0.45f);
    state.view = shade_mat4_look_at(s.eye, shade_v3(0, -0.05f, 0), shade_v3(0, 1, 0));
    state.projection = shade_mat4_perspective(0.37f, (float)SIZE / HEIGHT, 9, 19);
    canvas_dark(&c.target);
    for (int i = 0; i < 3; i++) {
        panel[i] = canvas_panel(&c, STEP * i, 0, SIZE, HEIGHT);
        state.fragment = i ? NULL : fragment;
        if (i < 2) shade_draw_mesh(&panel[i], &pot.view, &state, NULL);
    }
    sprintf(text, "%d of %d pixels differ",
            canvas_difference(&panel[0], &panel[1], &panel[2], 1e4f, &most), SIZE * HEIGHT);
    label_caption(&c, SIZE / 2, 292, grey, "by hand", "iteration four, 18 lines");
    label_caption(&c, SIZE / 2 + STEP, 292, grey, "shade.h", "the same draw, no shader");
    label_caption(&c, SIZE / 2 + 2 * STEP, 292, grey, "difference × 10000", text);
    mesh_free(&pot);
    return canvas_save(&c, argc, argv, "by_hand.ppm");
}
