/* 09_terms.c - what each term of the lighting equation contributes.  Above: emission, ambient,
   diffuse and specular light, each alone.  Below: their running sums.  The last of them is UW's
   iteration three.  The four terms add up to it exactly, because light is additive.
   Try SHADE_MODEL_LAMBERT in state.lighting: the specular term is empty.

   cc -O2 -I. examples/09_terms.c -lm -o terms && ./terms        writes terms.ppm */
#define SHADE_IMPLEMENTATION
#include "shade.h"
#include "shared/shapes.h"
#include "shared/label.h"

int main(int argc, char **argv)
{
    static const char *const name[8] = { "emission", "ambient", "diffuse", "specular",
                                         "emission", "+ ambient", "+ diffuse", "+ specular" };
    static const char *const term[4] = { "k_e", "k_a I_a", "Σ k_d I (N·L)", "Σ k_s I (N·H)^n" };
    const shade_vec3 grey = { 0.7f, 0.7f, 0.7f };
    const shade_material glaze = { { 0.05f, 0.012f, 0.003f }, { 0.03f, 0.20f, 0.24f },
                                   { 0.03f, 0.20f, 0.24f }, { 0.6f, 0.6f, 0.6f }, 50 };
    shade_light lamps[2];
    shade_draw_state state = { .material = &glaze };
    owned_mesh pot = shape_teapot(16);
    canvas c = canvas_new(960, 445, 3);

    lamps[0] = shade_directional_light(shade_v3(0.5f, -0.8f, -0.9f), shade_v3(1, 0.96f, 0.9f));
    lamps[1] = shade_directional_light(shade_v3(-1, -0.3f, 0.1f), shade_v3(0.25f, 0.3f, 0.45f));
    state.model = shape_at(-0.4f, -1.5f, -0.17f, 1, -0.45f);
    state.view = shade_mat4_look_at(shade_v3(0, 5, 13), shade_v3(0, -0.05f, 0), shade_v3(0, 1, 0));
    state.projection = shade_mat4_perspective(0.33f, 240 / 180.0f, 9, 19);
    state.lighting.lights = lamps;
    state.lighting.light_count = 2;
    state.lighting.ambient = shade_v3(0.11f, 0.12f, 0.13f);
    canvas_dark(&c.target);
    for (int i = 0; i < 8; i++) {
        int x = 240 * (i % 4), y = 232 * (i / 4);
        shade_target panel = canvas_panel(&c, x, y, 240, 180);
        state.lighting.terms = i < 4 ? 1u << i : (2u << i % 4) - 1;
        shade_draw_mesh(&panel, &pot.view, &state, NULL);
        label_caption(&c, x + 120, y + 198, grey, name[i], i < 4 ? term[i] : "");
        if (i > 0 && i < 4) label_center(&c, x, 95, 30, grey, "+");
        if (i > 4) label_center(&c, x, y + 95, 30, grey, "→");
    }
    mesh_free(&pot);
    return canvas_save(&c, argc, argv, "terms.ppm");
}
