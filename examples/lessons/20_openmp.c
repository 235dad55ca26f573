/* 20_openmp.c - twelve frames of a turning knot.  One line spreads the loop over them across all
   cores: each frame has its own memory, and the library has no state to share.  With
   schedule(dynamic) a core that is done takes the next frame.  Without -fopenmp the loop draws one
   frame after the other, with the same bits.
   Try the bands of 19_threads in such a loop: one picture by all cores, in one line.

   cc -O2 -fopenmp -I. examples/lessons/20_openmp.c -lm -o openmp && ./openmp   writes openmp.ppm */
#define SHADE_IMPLEMENTATION
#include "shade.h"
#include "../shared/shapes.h"
#include "../shared/label.h"

enum { FRAMES = 12, WIDTH = 240, HEIGHT = 200 };

int main(int argc, char **argv)
{
    const shade_vec3 gloss = { 0.5f, 0.5f, 0.5f }, white = { 1, 1, 1 }, axis = { 0, 1, 0 };
    const shade_vec3 grey = { 0.7f, 0.7f, 0.7f };
    const shade_light lamps[2] = {
        shade_directional_light(shade_v3(1, -1, -1), white),
        shade_directional_light(shade_v3(-1, 0.5f, 0), shade_v3(0.15f, 0.25f, 0.5f))
    };
    const shade_material candy = { { 0, 0, 0 }, white, white, gloss, 80 };
    owned_mesh knot = shape_knot(160);
    canvas c = canvas_new(4 * WIDTH, 3 * HEIGHT + 46, 3);

    mesh_chunks(&knot);
    canvas_dark(&c.target);
#ifdef _OPENMP
#pragma omp parallel for schedule(dynamic)
#endif
    for (int i = 0; i < FRAMES; i++) {
        shade_target frame = canvas_inset(&c, 4 + i % 4 * WIDTH, 4 + i / 4 * HEIGHT, WIDTH - 8,
                                           HEIGHT - 8);
        shade_draw_state state = { .material = &candy,
                                   .lighting = { lamps, 2, .ambient = { 0.08f, 0.08f, 0.09f } } };
        canvas_dark(&frame);
        state.model = shade_mat4_rotation((float)i * 0.2617994f, axis);    /* 15 degrees each */
        state.view = shade_mat4_look_at(shade_v3(0, -3, 12), shade_v3(0, 0, 0), axis);
        state.projection = shade_mat4_perspective(0.62f, (float)WIDTH / HEIGHT, 4, 20);
        shade_draw_mesh(&frame, &knot.view, &state, NULL);
    }
    for (int i = 0; i < FRAMES; i++)
        label_print(&c, 14 + i % 4 * WIDTH, 26 + i / 4 * HEIGHT, 22, grey, "%d°", 15 * i);
    label_center(&c, 480, 3 * HEIGHT + 28, 26, grey, "#pragma omp parallel for schedule(dynamic)");
    mesh_free(&knot);
    return canvas_save(&c, argc, argv, "openmp.ppm");
}
