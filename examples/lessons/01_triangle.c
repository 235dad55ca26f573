/* 01_triangle.c - the smallest whole program: a triangle whose corners are red, green and blue.
   Between the corners colours are linear, which UW calls smearing: a pixel takes the share of each
   corner that its barycentric coordinates say.
   Try .srgb = 0: the picture gets darker, because the display takes linear light for encoded
   values.

   cc -O2 -I. examples/lessons/01_triangle.c -lm -o triangle && ./triangle    writes triangle.ppm */
#define SHADE_IMPLEMENTATION
#include "shade.h"
#include "../shared/label.h"

static uint32_t pixels[640 * 960];
static float depth[640 * 960];

int main(int argc, char **argv)
{
    static const float corners[] = { -0.9f, -0.75f, 0,   0.9f, -0.75f, 0,   0, 0.85f, 0 };
    static const float colors[] = { 1, 0.02f, 0.02f,   0.02f, 0.7f, 0.05f,   0.03f, 0.1f, 1 };
    const shade_vec3 grey = { 0.75f, 0.75f, 0.75f };
    const char *path = argc > 1 ? argv[1] : "triangle.ppm";
    shade_target target = { .width = 960, .height = 640, .srgb = 1 };
    shade_mesh mesh = { .positions = corners, .colors = colors, .vertex_count = 3 };
    shade_draw_state state = { 0 };

    target.color = pixels;
    target.depth = depth;
    state.lighting.ambient = shade_v3(1, 1, 1);    /* white light from everywhere: bare colours */
    shade_clear(&target, shade_v4(0.02f, 0.02f, 0.03f, 1), 1);
    shade_draw_mesh(&target, &mesh, &state, NULL);
    label_set(&target, 30, 608, 40, grey, "c_0");
    label_set(&target, 885, 608, 40, grey, "c_1");
    label_set(&target, 505, 66, 40, grey, "c_2");
    label_set(&target, 195, 610, 34, grey, "c = α c_0 + β c_1 + γ c_2,   α + β + γ = 1");
    if (shade_write_ppm(path, &target)) {
        fprintf(stderr, "%s: not written\n", path);
        return 1;
    }
    return 0;
}
