/* 02_iterations.c - one sphere, five times: the lighting equation as UW builds it up, from left to
   right.  Iteration zero has emission alone.  One adds ambient light, two the diffuse light of a
   lamp, three its highlight.  Four sums many lamps, some weakened by distance, one held in a cone.
   Try shininess 5 for 40: the highlight spreads over the whole lit half.

   cc -O2 -I. examples/lessons/02_iterations.c -lm -o iterations && ./iterations */
#define SHADE_IMPLEMENTATION
#include "shade.h"
#include "../shared/mesh.h"
#include "../shared/label.h"

int main(int argc, char **argv)
{
    static const shade_model model[5] = { SHADE_MODEL_EMISSIVE, SHADE_MODEL_AMBIENT,
                                          SHADE_MODEL_LAMBERT, SHADE_MODEL_BLINN_PHONG,
                                          SHADE_MODEL_BLINN_PHONG };
    static const char *const name[5] = { "zero", "one", "two", "three", "four" };
    static const char *const adds[5] = { "k_e", "+ k_a I_{La}", "+ k_d I_L B (N·L)",
                                         "+ k_s I_L B (N·H)^n", "Σ_j, over four lamps" };
    shade_material clay = { { 0.035f, 0.006f, 0.004f }, { 0.75f, 0.16f, 0.09f },
                            { 0.75f, 0.16f, 0.09f }, { 0.35f, 0.35f, 0.35f }, 40 };
    const shade_vec3 grey = { 0.8f, 0.8f, 0.8f };
    shade_light lamps[4];
    shade_draw_state state = { 0 };
    owned_mesh sphere = mesh_sphere(96, 48);
    canvas c = canvas_new(1000, 316, 3);

    lamps[0] = shade_point_light(shade_v3(-2.6f, 3, 3.4f), shade_v3(1, 0.96f, 0.9f));
    lamps[0].ambient = shade_v3(0.11f, 0.12f, 0.15f);
    lamps[1] = shade_point_light(shade_v3(1.5f, -0.9f, 0.9f), shade_v3(0.15f, 0.5f, 1.4f));
    lamps[1].constant = 0.2f;
    lamps[1].quadratic = 0.8f;
    lamps[2] = shade_point_light(shade_v3(-1.5f, -1, 0.6f), shade_v3(0.2f, 1.2f, 0.35f));
    lamps[2].quadratic = 1;
    lamps[3] = shade_spot_light(shade_v3(2, 1, 4), shade_v3(-1.75f, -1.1f, -3.2f), 0.12f, 150,
                                shade_v3(1.8f, 1.5f, 0.7f));
    state.view = shade_mat4_look_at(shade_v3(0, 0, 6), shade_v3(0, 0, 0), shade_v3(0, 1, 0));
    state.projection = shade_mat4_perspective(0.40f, 1, 1, 10);
    state.material = &clay;
    state.lighting.lights = lamps;

    canvas_dark(&c.target);
    for (int i = 0; i < 5; i++) {
        shade_target panel = canvas_panel(&c, 200 * i, 4, 200, 200);
        state.lighting.model = model[i];
        state.lighting.light_count = i < 4 ? 1 : 4;
        shade_draw_mesh(&panel, &sphere.view, &state, NULL);
        label_center(&c, 200 * i + 100, 226, 24, grey, name[i]);
        label_center(&c, 200 * i + 100, 257, 22, grey, adds[i]);
    }
    label_center(&c, 500, 300, 24, grey, "four: I = k_e + Σ_j { k_a I_{La,j} + "
                 "(L·S)^e β_j / (a + b r_j + c r_j^2) I_{L,j} B_j [k_d (N·L) + k_s (N·H)^n] }");
    mesh_free(&sphere);
    return canvas_save(&c, argc, argv, "iterations.ppm");
}
