/* 10_textures.c - a textured floor of two triangles (UW looks a texture up per pixel).  Left: u and
   v are linear on the screen (affine), and the tiles bend at the diagonal.  Right: u/w, v/w and 1/w
   are linear on the screen, and their quotients lie on the floor.  The number counts pixels that
   show another tile than on the right.
   Try mesh_plane(1, 16): with 512 triangles the errors are too small to be seen.

   cc -O2 -I. examples/lessons/10_textures.c -lm -o textures && ./textures    writes textures.ppm */
#define SHADE_IMPLEMENTATION
#include "shade.h"
#include "../shared/mesh.h"
#include "../shared/label.h"

enum { WIDTH = 477, HEIGHT = 310 };
typedef struct scene { mesh_scene place; shade_texture tiles; } scene;

static void look_up(const void *uniforms, const shade_fragments *SHADE_RESTRICT in,
                    shade_colors *SHADE_RESTRICT out)
{
    const scene *s = (const scene *)uniforms;
    shade_sample_lanes(&s->tiles, in->varying[6], in->varying[7], NULL, out->color[0]);
}

int main(int argc, char **argv)
{
    static const char *const name[2] = { "affine", "perspective" };
    const shade_vec3 grey = { 0.7f, 0.7f, 0.7f };
    uint8_t texels[256];
    owned_mesh floor = mesh_plane(1, 1);
    scene s = { .place = { .mesh = &floor, .model = shade_mat4_identity() },
                .tiles = { .pixels = texels, .width = 8, .height = 8, .srgb = 1,
                           .filter = SHADE_FILTER_NEAREST } };
    shade_pipeline pipeline = { mesh_vertex, look_up, &s, .varyings = 8 };
    shade_target panel[2];
    canvas c = canvas_new(960, 380, 2);
    int covered = 0, wrong = 0;
    char text[2][60] = { "", "(u/w) / (1/w)" };

    for (int i = 0; i < 256; i++)
        texels[i] = (uint8_t)((i / 4 + i / 32) % 2 ? 230 - i % 4 * 15 : 35 + i % 4 * 30);
    s.place.clip_from_world = shade_mat4_mul(
        shade_mat4_perspective(0.74f, (float)WIDTH / HEIGHT, 0.1f, 10),
        shade_mat4_look_at(shade_v3(0, 1.5f, 2.2f), shade_v3(0, -0.03f, 0.1f), shade_v3(0, 1, 0)));
    canvas_dark(&c.target);
    for (int i = 0; i < 2; i++) {
        panel[i] = canvas_panel(&c, 483 * i, 0, WIDTH, HEIGHT);
        pipeline.interpolation = i ? SHADE_INTERPOLATION_PERSPECTIVE : SHADE_INTERPOLATION_AFFINE;
        mesh_draw(&panel[i], &pipeline, &floor);
    }
    for (int i = 0; i < panel[0].width * panel[0].height; i++) {
        int at = i / panel[0].width * panel[0].stride + i % panel[0].width;
        const float *p = (const float *)panel[0].color + 4 * at;
        const float *q = (const float *)panel[1].color + 4 * at;
        covered += panel[0].depth[at] < 1;
        wrong += panel[0].depth[at] < 1 && p[0] != q[0];
    }
    sprintf(text[0], "another tile at %d %% of the pixels", covered ? 100 * wrong / covered : 0);
    for (int i = 0; i < 2; i++) label_caption(&c, 483 * i + 238, 340, grey, name[i], text[i]);
    mesh_free(&floor);
    return canvas_save(&c, argc, argv, "textures.ppm");
}
