/* 11_mipmaps.c - a floor to the horizon, one sample a pixel.  Far away bilinear filtering misses
   most texels: it shows patterns that are not there and that shimmer when the camera moves.
   Trilinear filtering reads smaller pictures of the texture, whose texels are about as large as the
   pixels, and fades to their mean.  Right, to compare: 64 bilinear samples a pixel.  Below each,
   the horizon four times as large, and its mean distance, of 255, from the horizon with 64 samples.
   Try SHADE_FILTER_NEAREST for BILINEAR: 27.3 for 26.0, and joints near the eye get steps.

   cc -O2 -I. examples/lessons/11_mipmaps.c -lm -o mipmaps && ./mipmaps        writes mipmaps.ppm */
#define SHADE_IMPLEMENTATION
#include "shade.h"
#include "../shared/mesh.h"
#include "../shared/label.h"
#include "../shared/paint.h"
#include <math.h>

enum { SIZE = 128 };

static void draw(const shade_target *target, const shade_mesh *floor, const shade_texture *texture)
{
    shade_draw_state state = { .diffuse_map = texture };
    state.lighting.ambient = shade_v3(1, 1, 1);
    state.model = shade_mat4_rotation(0.35f, shade_v3(0, 1, 0));
    state.view = shade_mat4_look_at(shade_v3(0, 1.6f, 0), shade_v3(0, 0.8f, -3), shade_v3(0, 1, 0));
    state.projection = shade_mat4_perspective(0.9f, 310 / 280.0f, 0.1f, 2000);
    canvas_gradient(target, shade_v3(0.10f, 0.22f, 0.45f), shade_v3(0.7f, 0.8f, 0.85f));
    shade_draw_mesh(target, floor, &state, NULL);
}

/* Mean distance between the horizons of two panels, in codes of a display */
static float apart(const canvas *c, int x0, int x1)
{
    float sum = 0;
    for (int i = 0; i < 77 * 36; i++) {
        shade_vec4 p = canvas_pixel(c, x0 + i % 77, 71 + i / 77);
        shade_vec4 q = canvas_pixel(c, x1 + i % 77, 71 + i / 77);
        sum += fabsf(shade_srgb_from_linear(shade_v3(p.x, 0, 0)).x -
                     shade_srgb_from_linear(shade_v3(q.x, 0, 0)).x);
    }
    return 255 * sum / (77 * 36);
}

int main(int argc, char **argv)
{
    static const char *const name[3] = { "bilinear", "trilinear", "bilinear, 64 samples" };
    static float texels[SIZE * SIZE][4], smaller[SIZE * SIZE][4];
    shade_texture tiles = {
        .pixels = texels, .width = SIZE, .height = SIZE, .format = SHADE_FORMAT_RGBA32F
    };
    shade_texture levels[16];
    owned_mesh floor = mesh_plane(1000, 1);
    canvas c = canvas_new(960, 500, 1), fine = canvas_new(310, 280, 8);
    char text[40];

    paint_tiles(texels, SIZE);
    shade_build_mipmaps(&tiles, levels, smaller, sizeof smaller);
    for (int k = 0; k < 8; k++) floor.texcoords[k] *= 1000;
    canvas_dark(&c.target);
    for (int i = 2; i >= 0; i--) {
        shade_target panel = canvas_panel(&c, 5 + 320 * i, 5, 310, 280);
        tiles.filter = i == 1 ? SHADE_FILTER_TRILINEAR : SHADE_FILTER_BILINEAR;
        draw(i < 2 ? &panel : &fine.target, &floor.view, &tiles);
        if (i == 2) shade_resolve(&panel, &fine.target, 8);
        canvas_zoom(&c, 121 + 320 * i, 71, 77, 36, 6 + 320 * i, 292, 4);
        sprintf(text, "%.1f of 255 off the right one", (double)apart(&c, 121 + 320 * i, 121 + 640));
        label_caption(&c, 320 * i + 160, 462, shade_v3(0.7f, 0.7f, 0.7f), name[i],
                      i < 2 ? text : "what a camera would see");
    }
    mesh_free(&floor);
    free(fine.target.color);
    free(fine.target.depth);
    return canvas_save(&c, argc, argv, "mipmaps.ppm");
}
