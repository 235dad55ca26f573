/* 47_by_hand.c - UW's iteration four in the letters of the notes, a channel at a time as on the
   board, beside shade.h: three lamps, one weakened by distance, one in a cone.
   Try 1 for the 0 of B: behind the terminator N.L is negative, and lamps take light away.

   cc -O2 -I. examples/lessons/47_by_hand.c -lm -o by_hand && ./by_hand        writes by_hand.ppm */
#define SHADE_IMPLEMENTATION
#include "shade.h"
#include "../shared/shapes.h"
#include "../shared/label.h"

enum { SIZE = 318, HEIGHT = 262, LAMPS = 3, STEP = 321 };
typedef struct scene { shade_material k; shade_light lamp[LAMPS]; shade_vec3 eye; } scene;

static float of(shade_vec3 v, int c) { return c == 0 ? v.x : c == 1 ? v.y : v.z; }

/* One channel of the light from P to the eye: 0 red, 1 green, 2 blue */
static float by_hand(const scene *s, shade_vec3 P, shade_vec3 N, int c)
{
    const float k_a = of(s->k.ambient, c), k_d = of(s->k.diffuse, c), k_s = of(s->k.specular, c);
    const shade_vec3 V = shade_normalize(shade_sub(s->eye, P));
    float I = of(s->k.emission, c);
    for (int j = 0; j < LAMPS; j++) {
        const shade_light *l = &s->lamp[j];
        const shade_vec3 Q = { l->position.x, l->position.y, l->position.z };
        const shade_vec3 S = shade_neg(shade_normalize(l->spot_direction));
        const float r = shade_distance(Q, P);
        const shade_vec3 L = shade_normalize(shade_sub(Q, P)), H = shade_halfway(L, V);
        const float NL = shade_dot(N, L), NH = shade_dot(N, H), LS = shade_dot(L, S);
        const float B = NL > 0 ? 1 : 0, beta = LS >= l->spot_cos_cutoff ? 1 : 0;
        const float f_spot = shade_dot(S, S) > 0 ? beta * shade_power(LS, l->spot_exponent) : 1;
        const float f = l->constant + l->linear * r + l->quadratic * r * r;
        I += k_a * of(l->ambient, c) + f_spot * (f > 0 ? 1 / f : 1) * of(l->diffuse, c) * B *
             (k_d * NL + k_s * shade_power(NH, s->k.shininess));
    }
    return I;
}

static void fragment(const void *u, const shade_fragments *SHADE_RESTRICT in,
                     shade_colors *SHADE_RESTRICT out)
{
    SHADE_EACH_LANE(i) {
        shade_vec3 P = lane(in->varying[0], i), N = shade_normalize(lane(in->varying[3], i));
        for (int c = 0; c < 3; c++) out->color[c][i] = by_hand(u, P, N, c);
    }
}

int main(int argc, char **argv)
{
    const shade_vec3 grey = { 0.7f, 0.7f, 0.7f }, none = { 0, 0, 0 };
    scene s = { { none, grey, { 0.05f, 0.3f, 0.35f }, { 0.5f, 0.5f, 0.5f }, 40 },
                { shade_point_light(shade_v3(-5, 9, 7), grey),
                  shade_point_light(shade_v3(4, 1.5f, 2.5f), shade_v3(1.5f, .5f, .1f)),
                  shade_spot_light(shade_v3(-2, 2, 8), shade_v3(1, -2, -6), 0.11f, 90, grey) },
                { 0, 5, 13 } };
    shade_draw_state state = { .material = &s.k, .uniforms = &s,
                               .lighting = { .lights = s.lamp, .light_count = LAMPS } };
    owned_mesh pot = shape_teapot(16);
    canvas c = canvas_new(960, 340, 1);
    shade_target panel[3];
    char text[60];
    s.lamp[0].ambient = shade_v3(0.03f, 0.03f, 0.04f);
    s.lamp[1].constant = s.lamp[1].quadratic = 0.3f;
    state.model = shape_at(-0.5f, -1.5f, -0.17f, 1, -0.45f);
    state.view = shade_mat4_look_at(s.eye, shade_v3(0, -0.05f, 0), shade_v3(0, 1, 0));
    state.projection = shade_mat4_perspective(0.39f, (float)SIZE / HEIGHT, 9, 19);
    canvas_dark(&c.target);
    for (int i = 0; i < 3; i++) {
        panel[i] = canvas_panel(&c, STEP * i, 0, SIZE, HEIGHT);
        state.fragment = i ? NULL : fragment;
        if (i < 2) shade_draw_mesh(&panel[i], &pot.view, &state, NULL);
    }
    int differ = canvas_difference(&panel[0], &panel[1], &panel[2], 9);
    sprintf(text, "%d of %d", differ, SIZE * HEIGHT);
    label_caption(&c, SIZE / 2, 292, grey, "by hand", "a channel at a time");
    label_caption(&c, SIZE / 2 + STEP, 292, grey, "shade.h", "the same draw, no shader");
    label_caption(&c, SIZE / 2 + 2 * STEP, 292, grey, "pixels that differ", text);
    mesh_free(&pot);
    return canvas_save(&c, argc, argv, "by_hand.ppm");
}
