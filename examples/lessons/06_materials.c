/* 06_materials.c - teapots in the twenty-four materials of the OpenGL "teapots" program, Massey's
   brass (n = 27.9) among them: k_a, k_d, k_s and n alone make metal, stone, plastic and rubber.
   That table is older than sRGB.  Its numbers are sRGB values, which shade_linear_material turns
   into linear light.
   Try the presets without shade_linear_material: all colours are pale, and gold is khaki.

   cc -O2 -I. examples/lessons/06_materials.c -lm -o materials && ./materials */
#define SHADE_IMPLEMENTATION
#include "shade.h"
#include "../shared/shapes.h"
#include "../shared/label.h"

int main(int argc, char **argv)
{
    const int width = 160, height = 140;
    shade_light lamps[2];
    shade_draw_state state = { 0 };
    owned_mesh pot = shape_teapot(16);
    canvas c = canvas_new(6 * width, 4 * height, 2);

    lamps[0] = shade_directional_light(shade_v3(0.5f, -0.8f, -0.9f), shade_v3(1.3f, 1.3f, 1.3f));
    lamps[1] = shade_directional_light(shade_v3(-1, -0.3f, 0.4f), shade_v3(0.35f, 0.4f, 0.5f));
    state.model = shade_mat4_mul(shade_mat4_rotation(-0.45f, shade_v3(0, 1, 0)),
                                 shade_mat4_translation(shade_v3(-0.38f, -1.5f, 0)));
    state.view = shade_mat4_look_at(shade_v3(0, 5, 13), shade_v3(0, -0.25f, 0), shade_v3(0, 1, 0));
    state.projection = shade_mat4_perspective(0.44f, (float)width / (float)height, 5, 25);
    state.lighting.lights = lamps;
    state.lighting.light_count = 2;
    state.lighting.ambient = shade_v3(0.5f, 0.5f, 0.5f);
    state.lighting.flags = SHADE_FLAG_TWO_SIDED; /* the gap below the lid shows the inside */

    canvas_gradient(&c.target, shade_v3(0.10f, 0.11f, 0.13f), shade_v3(0.035f, 0.037f, 0.045f));
    for (int i = 0; i < SHADE_PRESET_COUNT; i++) {
        int x = i % 6 * width, y = i / 6 * height;
        shade_target panel = canvas_panel(&c, x, y, width, height);
        shade_material material = shade_linear_material(shade_preset_material((shade_preset)i));
        state.material = &material;
        shade_draw_mesh(&panel, &pot.view, &state, NULL);
        label_center(&c, x + width / 2, y + height - 10, 18, shade_v3(0.6f, 0.6f, 0.6f),
                     shade_preset_name((shade_preset)i));
    }
    mesh_free(&pot);
    return canvas_save(&c, argc, argv, "materials.ppm");
}
