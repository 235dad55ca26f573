/* 03_phong_vs_blinn.c - Phong's highlight beside Blinn's, on Massey's three spheres.  With the same
   n Blinn's is twice as wide, because H turns half as fast as R: it falls to one half where N is
   16.7 degrees off H, Phong's at 8.4 degrees.  With 4 n, from shade_blinn_exponent, Blinn's falls
   to one half at 8.4 degrees too.
   Try 0.6f for the -1 of the lamp, which then stands behind the spheres: Phong's highlight becomes
   an arc along the rim, Blinn's a broader one, and 4 n leaves a spot that is like neither.

   cc -O2 -I. examples/lessons/03_phong_vs_blinn.c -lm -o phong && ./phong */
#define SHADE_IMPLEMENTATION
#include "shade.h"
#include "../shared/mesh.h"
#include "../shared/label.h"

int main(int argc, char **argv)
{
    static const char *const name[3] = { "Phong, n = 16", "Blinn-Phong, n = 16",
                                         "Blinn-Phong, 4n = 64" };
    static const char *const term[3] = { "k_s (R·V)^{16}", "k_s (N·H)^{16}", "k_s (N·H)^{64}" };
    static const shade_model model[3] = { SHADE_MODEL_PHONG, SHADE_MODEL_BLINN_PHONG,
                                          SHADE_MODEL_BLINN_PHONG };
    const float n = 16;
    const shade_vec3 grey = { 0.7f, 0.7f, 0.7f };
    shade_material teal = { { 0, 0, 0 }, { 0.03f, 0.22f, 0.25f }, { 0.03f, 0.22f, 0.25f },
                            { 0.75f, 0.75f, 0.75f }, 0 };
    shade_light lamp = shade_directional_light(shade_v3(0.45f, -0.5f, -1),
                                               shade_v3(1, 0.97f, 0.9f));
    shade_draw_state state = { 0 };
    owned_mesh sphere = mesh_sphere(128, 64);
    canvas c = canvas_new(960, 390, 2);

    state.view = shade_mat4_look_at(shade_v3(0, 0, 6), shade_v3(0, 0, 0), shade_v3(0, 1, 0));
    state.projection = shade_mat4_perspective(0.36f, 1, 1, 10);
    state.material = &teal;
    state.lighting.lights = &lamp;
    state.lighting.light_count = 1;
    state.lighting.ambient = shade_v3(0.22f, 0.23f, 0.27f);

    canvas_dark(&c.target);
    for (int i = 0; i < 3; i++) {
        shade_target panel = canvas_panel(&c, 320 * i, 8, 320, 320);
        teal.shininess = i < 2 ? n : shade_blinn_exponent(n);
        state.lighting.model = model[i];
        shade_draw_mesh(&panel, &sphere.view, &state, NULL);
        label_caption(&c, 320 * i + 160, 350, grey, name[i], term[i]);
    }
    mesh_free(&sphere);
    return canvas_save(&c, argc, argv, "phong_vs_blinn.ppm");
}
