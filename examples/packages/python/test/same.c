/* same.c - draws the scene of test_same.py without Python: positions, normals and indices come from
   standard input, RGBA bytes go to standard output. */
#define SHADE_IMPLEMENTATION
#include "shade.h"
#include <stdio.h>
#include <stdlib.h>

static size_t got(void *to, size_t size, size_t count) { return fread(to, size, count, stdin); }

int main(void)
{
    int count[4];    /* vertices, indices, width, height */
    shade_mat4 view, projection;
    shade_light light = shade_directional_light(shade_v3(-1, 1, -2), shade_v3(1, 0.9f, 0.8f));
    shade_material gold = shade_linear_material(shade_preset_material(SHADE_PRESET_GOLD));
    if (got(count, sizeof count, 1) + got(&view, 64, 1) + got(&projection, 64, 1) != 3) return 2;
    const size_t vertices = (size_t)count[0], indices = (size_t)count[1];
    float *positions = (float *)malloc(12 * vertices), *normals = (float *)malloc(12 * vertices);
    uint32_t *index = (uint32_t *)malloc(4 * indices);
    shade_target target = { .width = count[2], .height = count[3], .srgb = 1 };
    const size_t pixels = (size_t)count[2] * (size_t)count[3];
    target.color = malloc(4 * pixels);
    target.depth = (float *)malloc(4 * pixels);
    if (!positions || !normals || !index || !target.color || !target.depth) return 2;
    if (got(positions, 12, vertices) != vertices || got(normals, 12, vertices) != vertices ||
        got(index, 4, indices) != indices)
        return 2;
    shade_mesh mesh = { .positions = positions, .normals = normals, .vertex_count = count[0],
                        .indices = index, .index_count = count[1] };
    shade_draw_state state = { .view = view, .projection = projection, .material = &gold };
    state.lighting.lights = &light;
    state.lighting.light_count = 1;
    state.lighting.ambient = shade_v3(0.25f, 0.25f, 0.25f);
    state.raster.cull = SHADE_CULL_BACK;
    shade_clear(&target, shade_v4(1, 1, 1, 1), 1);
    if (shade_draw_mesh(&target, &mesh, &state, NULL)) return 1;
    return fwrite(target.color, 4, pixels, stdout) != pixels;
}
