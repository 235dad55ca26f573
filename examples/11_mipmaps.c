/* 11_mipmaps.c - a floor to the horizon, one sample a pixel.  Bilinear filtering misses most texels
   far away: the tiles shimmer and form patterns that are not there.  Trilinear filtering reads
   smaller pictures of the texture, as fine as the pixels are, and fades to the mean.  To compare:
   64 bilinear samples a pixel.  Below each, the horizon four times as large.

   cc -O2 -I. examples/11_mipmaps.c -lm -o mipmaps && ./mipmaps        writes mipmaps.ppm */
#define SHADE_IMPLEMENTATION
#include "shade.h"
#include "mesh.h"
#include "label.h"
#include "noise.h"

enum { SIZE = 128 };

/* Tiles with light joints, red and cream */
static void make_tiles(float (*texel)[4])
{
    for (int i = 0; i < SIZE * SIZE; i++, texel++) {
        int x = i % SIZE, y = i / SIZE, red = (x / 64 + y / 64) % 2;
        int joint = x % 64 < 3 || y % 64 < 3;
        float grain = 0.8f + 0.4f * noise(shade_v3((float)x / 6, (float)y / 6, 0));
        shade_vec3 c = red ? shade_v3(0.30f, 0.045f, 0.02f) : shade_v3(0.62f, 0.5f, 0.34f);
        c = joint ? shade_v3(0.05f, 0.05f, 0.05f) : shade_scale(c, grain);
        texel[0][0] = c.x, texel[0][1] = c.y, texel[0][2] = c.z, texel[0][3] = 1;
    }
}

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

int main(int argc, char **argv)
{
    static const char *const name[3] = { "bilinear", "trilinear", "bilinear, 64 samples" };
    static float texels[SIZE * SIZE][4], smaller[SIZE * SIZE][4];
    shade_texture tiles = {
        .pixels = texels, .width = SIZE, .height = SIZE, .format = SHADE_FORMAT_RGBA32F
    };
    shade_texture levels[16];
    owned_mesh floor = mesh_plane(1000, 1);
    canvas c = canvas_new(960, 480, 1), fine = canvas_new(310, 280, 8);

    make_tiles(texels);
    shade_build_mipmaps(&tiles, levels, smaller, sizeof smaller);
    for (int k = 0; k < 8; k++) floor.texcoords[k] *= 1000;
    shade_clear(&c.target, shade_v4(0.02f, 0.02f, 0.025f, 1), 1);
    for (int i = 0; i < 3; i++) {
        shade_target panel = canvas_panel(&c, 5 + 320 * i, 5, 310, 280);
        const float *from = (const float *)panel.color + 4 * (116 + 66 * 960);
        tiles.filter = i == 1 ? SHADE_FILTER_TRILINEAR : SHADE_FILTER_BILINEAR;
        if (i < 2) draw(&panel, &floor.view, &tiles);
        else draw(&fine.target, &floor.view, &tiles), shade_resolve(&panel, &fine.target, 8);
        for (int k = 0; k < 77 * 36; k++) {    /* each pixel as a block of 4 x 4 */
            shade_target block = canvas_panel(&c, 6 + 320 * i + k % 77 * 4, 292 + k / 77 * 4, 4, 4);
            const float *p = from + 4 * (k % 77 + k / 77 * 960);
            shade_clear(&block, shade_v4(p[0], p[1], p[2], 1), 1);
        }
        label_center(&c, 320 * i + 160, 466, 22, shade_v3(0.7f, 0.7f, 0.7f), name[i]);
    }
    mesh_free(&floor), free(fine.target.color), free(fine.target.depth);
    return canvas_save(&c, argc, argv, "mipmaps.ppm");
}
