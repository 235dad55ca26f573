/* teapot.c      cc -O2 teapot.c -lm && ./a.out      writes teapot.ppm */
#define SHADE_IMPLEMENTATION
#include "shade.h"
#include "examples/teapot.h"                  /* any arrays of floats will do */

static uint32_t pixels[480 * 640], indices[3 * 4096];
static float depth[480 * 640], positions[3 * 2560], normals[3 * 2560];

int main(void)
{
    shade_target target = { .width = 640, .height = 480, .color = pixels, .depth = depth, .srgb = 1 };
    shade_mesh mesh = { .positions = positions, .normals = normals, .vertex_count = teapot_vertex_count(8),
                        .indices = indices, .index_count = teapot_index_count(8) };
    shade_light lamp = shade_point_light(shade_v3(4, 6, 5), shade_v3(1, 1, 1));
    shade_material gold = shade_linear_material(shade_preset_material(SHADE_PRESET_GOLD));
    shade_draw_state state = { .material = &gold };

    teapot_build(8, positions, normals, NULL, indices);
    state.view = shade_mat4_look_at(shade_v3(0, 4, 8), shade_v3(0, 1.4f, 0), shade_v3(0, 1, 0));
    state.projection = shade_mat4_perspective(0.7f, 640 / 480.0f, 0.1f, 100);
    state.lighting.lights = &lamp, state.lighting.light_count = 1;
    shade_clear(&target, shade_v4(0.02f, 0.02f, 0.05f, 1), 1);
    shade_draw_mesh(&target, &mesh, &state, NULL);
    return shade_write_ppm("teapot.ppm", &target);
}
