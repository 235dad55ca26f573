/* 18_supersampling.c - One, 2 x 2 and 4 x 4 samples a pixel; below, the handle eight times as
   large.  A pixel of n samples has n + 1 levels between two colours, and their mean is taken in
   linear light.  The large picture never exists as a whole: each strip of 16 rows of the small
   picture is drawn large and averaged by shade_resolve, in a sixteenth of the memory.
   Try MOST 8 and f = 1 << (i + (i > 1)): 64 samples can hardly be told from 16.

   cc -O2 -I. examples/lessons/18_supersampling.c -lm -o supersampling && ./supersampling */
#define SHADE_IMPLEMENTATION
#include "shade.h"
#include "../shared/shapes.h"
#include "../shared/label.h"

enum { WIDTH = 310, HEIGHT = 256, ROWS = 16, MOST = 4 };

int main(int argc, char **argv)
{
    static const char *const name[3] = { "one sample", "2 × 2", "4 × 4" };
    static const char *const steps[3] = { "2 levels at an edge", "5 levels at an edge",
                                          "17 levels at an edge" };
    const shade_vec3 grey = { 0.7f, 0.7f, 0.7f };
    static float color[WIDTH * MOST * ROWS * MOST * 4];
    static float depth[WIDTH * MOST * ROWS * MOST];
    shade_material glaze = { { 0, 0, 0 }, { 0.5f, 0.16f, 0.02f }, { 0.5f, 0.16f, 0.02f },
                             { 0.6f, 0.6f, 0.6f }, 60 };
    shade_light lamp = shade_directional_light(shade_v3(0.5f, -0.8f, -0.7f), shade_v3(1, 1, 1));
    shade_draw_state state = { 0 };
    owned_mesh rays = shape_star(90), pot = shape_teapot(20);
    canvas c = canvas_new(960, 505, 1);

    state.view = shade_mat4_look_at(shade_v3(-1, 7, 12), shade_v3(0.1f, 1, 0), shade_v3(0, 1, 0));
    state.projection = shade_mat4_perspective(0.50f, (float)WIDTH / HEIGHT, 5, 25);
    state.lighting.lights = &lamp;
    state.lighting.light_count = 1;
    state.lighting.ambient = shade_v3(0.15f, 0.16f, 0.18f);
    canvas_dark(&c.target);
    for (int i = 0; i < 3; i++) {
        shade_target panel = canvas_panel(&c, 5 + 320 * i, 5, WIDTH, HEIGHT);
        int f = 1 << i;
        for (int y = 0; y < HEIGHT; y += ROWS) {
            shade_target out = panel, strip = { .width = f * WIDTH, .height = f * HEIGHT };
            out.color = (float *)panel.color + 4 * 960 * y;
            out.row_offset = y;
            out.row_count = ROWS;
            strip.format = SHADE_FORMAT_RGBA32F;
            strip.color = color;
            strip.depth = depth;
            strip.row_offset = f * y;
            strip.row_count = f * ROWS;
            shade_clear(&strip, shade_v4(0.03f, 0.035f, 0.045f, 1), 1);
            state.material = NULL;
            shade_draw_mesh(&strip, &rays.view, &state, NULL);
            state.material = &glaze;
            shade_draw_mesh(&strip, &pot.view, &state, NULL);
            shade_resolve(&out, &strip, f);
        }
        canvas_zoom(&c, 31 + 320 * i, 102, 38, 22, 8 + 320 * i, 268, 8);
        label_caption(&c, 320 * i + 160, 468, grey, name[i], steps[i]);
    }
    mesh_free(&rays);
    mesh_free(&pot);
    return canvas_save(&c, argc, argv, "supersampling.ppm");
}
