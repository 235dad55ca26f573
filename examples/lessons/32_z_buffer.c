/* 32_z_buffer.c - the z-buffer as a picture (UW).  Above: the picture, and the depth of each pixel,
   bright where it is near, black where it was cleared to 1, UW's FAR.  Below: z along the marked
   row: a straight line for each face, because z is linear on the screen.  So z of the next pixel
   takes one addition, z + dz.  The number tells how far sums over the widest face stray from z.
   Try near_z = 0.4: the lines flatten against FAR, as most depths go to the space before them.

   cc -O2 -I. examples/lessons/32_z_buffer.c -lm -o z_buffer && ./z_buffer    writes z_buffer.ppm */
#define SHADE_IMPLEMENTATION
#include "shade.h"
#include "../shared/shapes.h"
#include "../shared/sketch.h"
#include <math.h>

enum { W = 960, H = 540, ROW = 330 };    /* samples of a panel, two to a pixel; the marked row */
static const float near_z = 4, far_z = 10;
static const shade_vec3 white = { 1, 1, 1 }, grey = { 0.3f, 0.3f, 0.3f };

/* The incremental z of the widest face: its first z, to which dz is added for each next sample */
static void add_up(const canvas *c, const float *z)
{
    int run = 0, first = 0, count = 0;
    for (int i = 1; i + 1 < W; i++) {    /* samples on the line between their neighbours */
        run = z[i] < 1 && fabsf(z[i + 1] - 2 * z[i] + z[i - 1]) < 1e-6f ? run + 1 : 0;
        if (run > count) first = i - run;
        if (run > count) count = run;
    }
    float sum = z[first], dz = z[first + 1] - sum, off = 0;
    for (int i = first; i <= first + count; i++, sum += dz) off = fmaxf(off, fabsf(sum - z[i]));
    label_print(c, 80, 529, 32, white, "z along x: %d sums z + dz stray by %.1e", count,
                (double)off);
}

/* Where the plot has sample x of the row, at depth z */
static shade_vec3 at(int x, float z) { return shade_v3((float)x * 860 / W, 345 * (z - 0.4f), 0); }

static void plot(const canvas *c, const float *z, const shade_vec4 *color)
{
    sketch s = sketch_new(c, 80, 498, 1);
    sketch_ink(&s, white, 1);
    sketch_arrow(&s, at(0, 0.4f), at(W, 0.4f));
    sketch_arrow(&s, at(0, 0.4f), at(0, 1.05f));
    sketch_name(&s, at(-45, 1), 34, "FAR");
    sketch_name(&s, at(-40, 0.5f), 34, "0.5");
    for (int i = 0; i + 1 < W; i++) {
        sketch_ink(&s, z[i] < 1 ? shade_v3(color[i].x, color[i].y, color[i].z) : grey, 4);
        if (fabsf(z[i + 1] - z[i]) < 0.01f) sketch_line(&s, at(i, z[i]), at(i + 1, z[i + 1]));
    }
}

int main(int argc, char **argv)
{
    static const uint32_t paint[4] = { 0xCC5A30, 0xBEA632, 0x4080C8, 0x58A050 };
    const shade_light lamp = shade_directional_light(shade_v3(0.5f, -1, -0.7f), white);
    shade_material paper = { .shininess = 0 };
    shade_draw_state state = { .material = &paper, .lighting = { &lamp, 1, .ambient = grey } };
    canvas c = canvas_new(W, H, 2);
    owned_mesh cube = mesh_cube();
    const shade_target picture = canvas_panel(&c, 0, 0, W / 2, H / 2);
    const float *z = picture.depth + ROW * 2 * W;
    state.view = shade_mat4_look_at(shade_v3(0, 2, 6.9f), shade_v3(0, 0, -1), shade_v3(0, 1, 0));
    state.projection = shade_mat4_perspective(0.6f, (float)W / H, near_z, far_z);
    shade_clear(&c.target, shade_v4(0.03f, 0.033f, 0.04f, 1), 1);
    for (int k = 0; k < 4; k++) {
        float x = 1.45f * (float)k - 2.25f, turn = 0.7f + 0.9f * (float)k;
        state.model = shape_at(x, 0, k % 2 ? 0.5f : -1.2f, 0.72f, turn);
        paper.ambient = paper.diffuse = shade_rgb(paint[k]);
        shade_draw_mesh(&picture, &cube.view, &state, NULL);
    }
    for (int i = 0; i < W * H; i++) {
        float near = 1 - picture.depth[i / W * 2 * W + i % W];
        canvas_fill(&c.target, W + i % W, i / W, 1, 1, shade_v3(near, near, near));
    }
    plot(&c, z, (const shade_vec4 *)picture.color + ROW * 2 * W);
    add_up(&c, z);
    canvas_fill(&c.target, 0, ROW, 2 * W, 2, grey);
    label_draw(&c, W / 2 + 12, 38, 36, white, "its z-buffer: near is bright");
    mesh_free(&cube);
    return canvas_save(&c, argc, argv, "z_buffer.ppm");
}
