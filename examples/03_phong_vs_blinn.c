/* 03_phong_vs_blinn.c - Phong's highlight beside Blinn's: the same exponent gives Blinn's twice the
   width, four times the exponent nearly the same picture.

   cc -O2 -I. examples/03_phong_vs_blinn.c -lm -o phong && ./phong */
#define SHADE_IMPLEMENTATION
#include "shade.h"
#include "mesh.h"
#include "label.h"

int main(int argc, char **argv)
{
    static const char *const name[3] = { "phong, n = 16", "blinn-phong, n = 16",
                                         "blinn-phong, n = 64" };
    static const shade_model model[3] = { SHADE_MODEL_PHONG, SHADE_MODEL_BLINN_PHONG,
                                          SHADE_MODEL_BLINN_PHONG };
    const float n = 16;
    shade_material teal = { { 0, 0, 0 }, { 0.03f, 0.22f, 0.25f }, { 0.03f, 0.22f, 0.25f },
                            { 0.75f, 0.75f, 0.75f }, 0 };
    shade_light lamp = shade_directional_light(shade_v3(0.45f, -0.5f, -1),
                                               shade_v3(1, 0.97f, 0.9f));
    shade_draw_state state = { 0 };
    owned_mesh sphere = mesh_sphere(128, 64);
    canvas c = canvas_new(960, 380, 2);

    state.view = shade_mat4_look_at(shade_v3(0, 0, 6), shade_v3(0, 0, 0), shade_v3(0, 1, 0));
    state.projection = shade_mat4_perspective(0.39f, 1, 1, 10);
    state.material = &teal;
    state.lighting.lights = &lamp, state.lighting.light_count = 1;
    state.lighting.ambient = shade_v3(0.22f, 0.23f, 0.27f);

    canvas_gradient(&c.target, shade_v3(0.045f, 0.05f, 0.06f), shade_v3(0.012f, 0.013f, 0.016f));
    for (int i = 0; i < 3; i++) {
        shade_target panel = canvas_panel(&c, 320 * i, 12, 320, 320);
        teal.shininess = i < 2 ? n : shade_blinn_exponent(n);
        state.lighting.model = model[i];
        shade_draw_mesh(&panel, &sphere.view, &state, NULL);
        label_center(&c, 320 * i + 160, 359, 22, shade_v3(0.7f, 0.7f, 0.7f), name[i]);
    }
    mesh_free(&sphere);
    return canvas_save(&c, argc, argv, "phong_vs_blinn.ppm");
}
