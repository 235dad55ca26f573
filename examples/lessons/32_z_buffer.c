/* 32_z_buffer.c - the z-buffer as a picture.  Above: the picture, and the depth of every pixel,
   bright where it is near, black where it was cleared (z = 1, UW's FAR).  Below: z along the marked
   row, near at the bottom.  It consists of straight pieces, one for each face, because z/w is
   linear on the screen.  So a row needs one addition a pixel, z + dz + dz ...; the number tells how
   far that strays over the longest piece (UW's incremental z).
   Try near_z = 0.4: the pieces flatten against FAR, as most depths go to the space before them.

   cc -O2 -I. examples/lessons/32_z_buffer.c -lm -o z_buffer && ./z_buffer    writes z_buffer.ppm */
#define SHADE_IMPLEMENTATION
#include "shade.h"
#include "../shared/shapes.h"
#include "../shared/label.h"
#include <math.h>

enum { W = 960, H = 540, ROW = 330 };    /* of a panel; two samples to a pixel */
static const float near_z = 4, far_z = 10;

/* The longest run of equal steps in a row of depths: where it begins; its steps */
static int longest_run(const float *z, int *begin)
{
    int most = 0;
    for (int i = 0, from = 0; i + 1 < W; i++) {
        if (i > from && fabsf(z[i + 1] - 2 * z[i] + z[i - 1]) > 1e-6f) from = i;
        if (z[i + 1] == 1) from = i + 1;
        if (i + 1 - from > most) {
            most = i + 1 - from;
            *begin = from;
        }
    }
    return most;
}

int main(int argc, char **argv)
{
    static const shade_vec3 paint[4] = { { 0.6f, 0.1f, 0.03f }, { 0.5f, 0.38f, 0.03f },
                                         { 0.05f, 0.2f, 0.55f }, { 0.1f, 0.35f, 0.08f } };
    const shade_vec3 white = { 1, 1, 1 }, grey = { 0.3f, 0.3f, 0.3f };
    shade_light lamp = shade_directional_light(shade_v3(0.5f, -1, -0.7f), white);
    shade_material paper = { .shininess = 0 };
    shade_draw_state state = { .material = &paper,
                               .lighting = { &lamp, 1, .ambient = { 0.25f, 0.25f, 0.27f } } };
    owned_mesh cube = mesh_cube();
    canvas c = canvas_new(W, H, 2);
    shade_target picture = canvas_panel(&c, 0, 0, W / 2, H / 2);
    const float *z = picture.depth + ROW * 2 * W;
    char text[80];

    state.view = shade_mat4_look_at(shade_v3(0, 2, 6.5f), shade_v3(0, 0, -1), shade_v3(0, 1, 0));
    state.projection = shade_mat4_perspective(0.6f, (float)W / H, near_z, far_z);
    shade_clear(&c.target, shade_v4(0.03f, 0.033f, 0.04f, 1), 1);
    for (int k = 0; k < 4; k++) {
        float i = (float)k, x = 1.45f * i - 2.2f;
        state.model = shape_at(x, 0, k % 2 ? 0.5f : -1.2f, 0.72f, 0.7f + 0.9f * i);
        paper.ambient = paper.diffuse = paint[k];
        shade_draw_mesh(&picture, &cube.view, &state, NULL);
    }
    for (int i = 0; i < W * H; i++) {
        float near = 1 - picture.depth[i / W * 2 * W + i % W];
        canvas_fill(&c.target, W + i % W, i / W, 1, 1, shade_v3(near, near, near));
    }
    for (int i = 0; i < W; i++) {
        int y = (int)(760 * (1 - z[i]));
        shade_vec4 k = ((const shade_vec4 *)picture.color)[ROW * 2 * W + i];
        canvas_fill(&c.target, 2 * i - 2, H + 6 + y, 6, 6, y ? shade_v3(k.x, k.y, k.z) : grey);
    }
    int begin = 0, steps = longest_run(z, &begin);
    float dz = (z[begin + steps] - z[begin]) / (float)steps, sum = z[begin], worst = 0;
    for (int i = 0; i <= steps; i++, sum += dz) worst = fmaxf(worst, fabsf(sum - z[begin + i]));
    sprintf(text, "z along the row; %d times z += dz: off by %.1e of its range", steps,
            (double)worst);
    label_draw(&c, 12, H / 2 + 28, 20, white, "FAR, z = 1");
    label_draw(&c, 12, H / 2 + 200, 20, white, "z = 0.5");
    canvas_fill(&c.target, 2 * 90, H + 6 + 380, 40, 2, grey);
    label_draw(&c, W / 2 + 12, 30, 22, white, "its z-buffer");
    label_draw(&c, 12, H - 14, 22, white, text);
    canvas_fill(&c.target, 0, ROW, 2 * W, 2, grey);
    mesh_free(&cube);
    return canvas_save(&c, argc, argv, "z_buffer.ppm");
}
