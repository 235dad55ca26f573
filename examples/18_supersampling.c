/* 18_supersampling.c - one, 2 x 2 and 4 x 4 samples a pixel; below, the handle eight times larger.
   The large picture never exists as a whole: strips of it, as high as 16 rows of the small one, are
   drawn and averaged in linear light by shade_resolve, in a sixteenth of the memory.

   cc -O2 -I. examples/18_supersampling.c -lm -o supersampling && ./supersampling */
#define SHADE_IMPLEMENTATION
#include "shade.h"
#include "shapes.h"
#include "label.h"

enum { WIDTH = 310, HEIGHT = 256, ROWS = 16, MOST = 4 };

/* Rays of black and white about the pot */
static owned_mesh star(int rays)
{
    owned_mesh m = mesh_new(3 * rays, 3 * rays);
    for (int i = 0; i < 3 * rays; i++) {
        shade_vec2 a = mesh_turn(((float)(i / 3) + (i % 3 == 2 ? 0.5f : 0)) / (float)rays);
        float r = i % 3 ? 5.0f : 0.0f;
        mesh_put(&m, i, shade_v3(r * a.x, 0, -r * a.y), shade_v3(0, 1, 0), 0, 0);
        m.indices[i] = (uint32_t)i;
    }
    return m;
}

int main(int argc, char **argv)
{
    static const char *const name[3] = { "one sample", "2 by 2", "4 by 4" };
    static float color[WIDTH * MOST * ROWS * MOST * 4];
    static float depth[WIDTH * MOST * ROWS * MOST];
    shade_material glaze = { { 0, 0, 0 }, { 0.5f, 0.16f, 0.02f }, { 0.5f, 0.16f, 0.02f },
                             { 0.6f, 0.6f, 0.6f }, 60 };
    shade_light lamp = shade_directional_light(shade_v3(0.5f, -0.8f, -0.7f), shade_v3(1, 1, 1));
    shade_draw_state state = { 0 };
    owned_mesh rays = star(90), pot = shape_teapot(20);
    canvas c = canvas_new(960, 480, 1);

    state.view = shade_mat4_look_at(shade_v3(-1, 7, 12), shade_v3(0.1f, 1, 0), shade_v3(0, 1, 0));
    state.projection = shade_mat4_perspective(0.50f, (float)WIDTH / HEIGHT, 5, 25);
    state.lighting.lights = &lamp, state.lighting.light_count = 1;
    state.lighting.ambient = shade_v3(0.15f, 0.16f, 0.18f);
    shade_clear(&c.target, shade_v4(0.02f, 0.02f, 0.025f, 1), 1);
    for (int i = 0; i < 3; i++) {
        shade_target panel = canvas_panel(&c, 5 + 320 * i, 5, WIDTH, HEIGHT);
        const float *from = (const float *)panel.color + 4 * (26 + 97 * 960);
        int f = 1 << i;
        for (int y = 0; y < HEIGHT; y += ROWS) {
            shade_target out = panel, strip = { .width = f * WIDTH, .height = f * HEIGHT };
            out.color = (float *)panel.color + 4 * 960 * y;
            out.row_offset = y, out.row_count = ROWS;
            strip.format = SHADE_FORMAT_RGBA32F, strip.color = color, strip.depth = depth;
            strip.row_offset = f * y, strip.row_count = f * ROWS;
            shade_clear(&strip, shade_v4(0.03f, 0.035f, 0.045f, 1), 1);
            state.material = NULL, shade_draw_mesh(&strip, &rays.view, &state, NULL);
            state.material = &glaze, shade_draw_mesh(&strip, &pot.view, &state, NULL);
            shade_resolve(&out, &strip, f);
        }
        for (int k = 0; k < 38 * 22; k++) {    /* each pixel as a block of 8 x 8 */
            shade_target block = canvas_panel(&c, 8 + 320 * i + k % 38 * 8, 268 + k / 38 * 8, 8, 8);
            const float *p = from + 4 * (k % 38 + k / 38 * 960);
            shade_clear(&block, shade_v4(p[0], p[1], p[2], 1), 1);
        }
        label_center(&c, 320 * i + 160, 470, 22, shade_v3(0.7f, 0.7f, 0.7f), name[i]);
    }
    mesh_free(&rays), mesh_free(&pot);
    return canvas_save(&c, argc, argv, "supersampling.ppm");
}
