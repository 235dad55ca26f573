/* instructions.c - draws one scene a number of times, so that bench/instructions.sh can count what
   a draw executes.

     instructions flat|lit|map draws        prints the pixels of one draw

   One triangle covers most of 128 x 128 pixels: of one colour, lit by two lamps for each pixel, or
   with a map of 64 x 64 texels read bilinearly beside one lamp. */
#define SHADE_IMPLEMENTATION
#include "shade.h"
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

enum { SIDE = 128, MAP = 64 };

int main(int argc, char **argv)
{
    static uint32_t pixels[SIDE * SIDE], texels[MAP * MAP];
    static float depth[SIDE * SIDE];
    static const float corners[] = { -0.9f, -0.9f, -2, 0.9f, -0.9f, -1.8f, 0, 0.9f, -2.2f };
    static const float normals[] = { -0.3f, 0, 1, 0.3f, 0, 1, 0, 0.4f, 1 };
    static const float places[] = { 0, 1, 1, 1, 0.5f, 0 };
    const shade_light lamps[] = {
        { { 1, 2, 3, 1 }, { 0, 0, 0 }, { 0.9f, 0.8f, 0.7f }, { 1, 1, 1 }, 0.5f, 0.1f, 0.05f,
          { 0, 0, 0 }, 0, 0 },
        { { -1, 1, 2, 0 }, { 0, 0, 0 }, { 0.2f, 0.3f, 0.4f }, { 1, 1, 1 }, 1, 0, 0,
          { 0, 0, 0 }, 0, 0 } };
    const shade_material gold = { { 0, 0, 0 }, { 0.1f, 0.1f, 0 }, { 0.8f, 0.6f, 0.2f },
                                  { 0.6f, 0.6f, 0.4f }, 30 };
    const shade_texture map = { .pixels = texels, .width = MAP, .height = MAP,
                                .filter = SHADE_FILTER_BILINEAR };
    shade_target target = { .color = pixels, .depth = depth, .width = SIDE, .height = SIDE };
    shade_mesh mesh = { .positions = corners, .normals = normals, .vertex_count = 3 };
    shade_draw_state state = { .material = &gold };
    shade_stats stats = { 0 };
    if (argc < 3) return 2;

    for (uint32_t i = 0; i < MAP * MAP; i++) texels[i] = 0xFF000000u | i * 2654435761u >> 8;
    state.projection = shade_mat4_perspective(0.9f, 1, 0.1f, 10);
    state.lighting.lights = lamps;
    state.lighting.light_count = strcmp(argv[1], "lit") ? 1 : 2;
    if (!strcmp(argv[1], "flat")) state.shading = SHADE_SHADING_PER_FACE;
    if (!strcmp(argv[1], "map")) {
        mesh.texcoords = places;
        state.diffuse_map = &map;
    }
    for (int k = atoi(argv[2]); k > 0; k--) {
        shade_clear(&target, shade_v4(0, 0, 0, 1), 1);
        if (shade_draw_mesh(&target, &mesh, &state, &stats)) return 1;
    }
    printf("%d\n", (int)stats.fragments);
    return 0;
}
