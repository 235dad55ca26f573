/* 17_reversed_z.c - orange boards, each half a percent of its distance before a pale one.  Above:
   the usual depth goes to 1 with the distance, where floats are 6e-8 apart.  From 10 km on that
   step is wider than the gap of the boards: where both get the same depth, the first one drawn
   stays.  Below: reversed depth is n/d and goes to 0, where floats are ever finer.  Right: the
   board at 30 km, enlarged.  UW's z-buffer has "bigger is closer" as well.
   Try near_z 1 for 0.1f: the boards fight for pixels from ten times as far away.

   cc -O2 -I. examples/lessons/17_reversed_z.c -lm -o reversed_z && ./reversed_z */
#define SHADE_IMPLEMENTATION
#include "shade.h"
#include "../shared/mesh.h"
#include "../shared/label.h"
#include <math.h>

enum { BOARDS = 7, SIZE = 112, LARGE = 234 };    /* pixels of a panel; the last one's */

int main(int argc, char **argv)
{
    static const float km[BOARDS] = { 1, 3, 10, 30, 100, 300, 30 };
    static const char *const name[2] = {
        "standard: z = (1 − n/d) / (1 − n/f)",
        "reversed: z = n/d" };
    const shade_vec3 grey = { 0.7f, 0.7f, 0.7f };
    const shade_material pale = { .emission = { 0.6f, 0.58f, 0.52f } };
    const shade_material orange = { .emission = { 0.75f, 0.18f, 0.02f } };
    const float near_z = 0.1f, far_z = 1e6f;
    owned_mesh square = mesh_plane(0.2f, 1);
    const shade_mat4 lean = shade_mat4_mul(shade_mat4_rotation(1, shade_v3(1, 0, 0)),
                                           shade_mat4_rotation(0.5f, shade_v3(0, 1, 0)));
    canvas c = canvas_new(960, 560, 3);
    char text[60];

    canvas_dark(&c.target);
    for (int row = 0; row < 2; row++) {
        int y = 264 * row + 4;
        shade_draw_state state = { .projection = shade_mat4_perspective(0.56f, 1, near_z, far_z) };
        if (row) {
            state.projection = shade_mat4_perspective_reversed(0.56f, 1, near_z);
            state.raster.depth_zero_to_one = 1;
            state.raster.depth_test = SHADE_COMPARE_GREATER;
        }
        for (int i = 0; i < BOARDS; i++) {
            const int last = i == BOARDS - 1, size = last ? LARGE : SIZE, x = SIZE * i + 12;
            shade_target panel = canvas_panel(&c, x, last ? y : y + 46, size, size), depth = panel;
            float d = 1000 * km[i], small = 0.7f * d;
            float z = row ? near_z / d : (1 - near_z / d) / (1 - near_z / far_z);
            float step = (z - nextafterf(z, 0)) * d * d / near_z;    /* in metres: dz/dd = n/d^2 */
            shade_mat4 back = shade_mat4_scaling(shade_v3(d, d, d));
            shade_mat4 front = shade_mat4_scaling(shade_v3(small, small, small));
            back = shade_mat4_mul(lean, back);
            front = shade_mat4_mul(lean, front);
            back.col[3].z = -1.005f * d;
            front.col[3].z = -d;
            depth.color = NULL;
            shade_clear(&depth, shade_v4(0, 0, 0, 0), row ? 0 : 1);
            state.material = &pale;
            state.model = back;
            shade_draw_mesh(&panel, &square.view, &state, NULL);
            state.material = &orange;
            state.model = front;
            shade_draw_mesh(&panel, &square.view, &state, NULL);
            sprintf(text, last ? "%g km, larger" : "%g km", (double)km[i]);
            label_center(&c, x + size / 2, y + LARGE - (last ? -14 : 50), 22, grey, text);
            step = row ? 2e7f * step / d : 200 * step / d;
            sprintf(text, row ? "%.1f·10^{−5}" : "%.1f", (double)step);
            if (!last) label_center(&c, x + size / 2, y + LARGE - 22, 22, grey, text);
        }
        label_draw(&c, 12, y + 32, 26, grey, name[row]);
    }
    label_print(&c, 12, 548, 22, grey,
               "d, and a step of z over the gap between the boards, d/200; n = %g m",
                (double)near_z);
    mesh_free(&square);
    return canvas_save(&c, argc, argv, "reversed_z.ppm");
}
