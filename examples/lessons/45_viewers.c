/* 45_viewers.c - a viewer nearby and one at infinity (Berkeley).  Left: in perspective V is the
   direction from each pixel to the eye, and every ball carries its highlight elsewhere.  Middle: an
   orthographic camera, but V still aims at a point: highlights wander where views are parallel.
   Right: SHADE_FLAG_INFINITE_VIEWER, V the same everywhere, and all nine balls are alike.  Below:
   the framed two, and how many of their pixels differ by more than 2 of 255 codes.
   Try SHADE_MODEL_LAMBERT: the two orthographic pictures are the same, k_d does not know V.

   cc -O2 -I. examples/lessons/45_viewers.c -lm -o viewers && ./viewers        writes viewers.ppm */
#define SHADE_IMPLEMENTATION
#include "shade.h"
#include "../shared/shapes.h"
#include "../shared/label.h"

enum { SIZE = 312, CELL = 100, SAMPLES = 3, EDGE = 6 };    /* pixels; 3 cells and the edge: SIZE */

/* Pixels of the balls in two opposite corners of a panel that differ by more than 2 codes */
static int differing(const canvas *c, int x, int y)
{
    int count = 0, apart = 2 * CELL;
    for (int k = 0; k < CELL * CELL; k++) {
        int i = x + EDGE + k % CELL, j = y + EDGE + k / CELL;
        shade_vec4 a = canvas_pixel(c, i, j), b = canvas_pixel(c, i + apart, j + apart);
        shade_vec3 p = shade_srgb_from_linear(shade_v3(a.x, a.y, a.z));
        shade_vec3 q = shade_srgb_from_linear(shade_v3(b.x, b.y, b.z));
        count += shade_distance(p, q) > 2 / 255.0f;
    }
    return count;
}

/* A square about a cell */
static void frame(const canvas *c, int x, int y)
{
    const shade_vec3 white = { 0.6f, 0.6f, 0.6f };
    for (int k = 0; k < 2; k++) {
        shade_target row = canvas_panel(c, x, y + k * (CELL - 1), CELL, 1);
        shade_target column = canvas_panel(c, x + k * (CELL - 1), y, 1, CELL);
        canvas_fill(&row, 0, 0, row.width, row.height, white);
        canvas_fill(&column, 0, 0, column.width, column.height, white);
    }
}

int main(int argc, char **argv)
{
    static const char *const name[3] = { "perspective", "orthographic, V to a point",
                                         "orthographic, V constant" };
    const shade_vec3 grey = { 0.7f, 0.7f, 0.7f }, clay = { 0.35f, 0.12f, 0.06f };
    const shade_vec3 none = { 0, 0, 0 }, white = { 1, 1, 1 };
    const shade_material glaze = { none, clay, clay, { 0.6f, 0.6f, 0.6f }, 30 };
    const float half = 1.5f * SIZE / (SIZE - 2 * EDGE);
    shade_light lamp = shade_directional_light(shade_v3(0.5f, -0.7f, -1), white);
    shade_draw_state state = { .material = &glaze, .lighting = { &lamp, .light_count = 1 } };
    owned_mesh ball = mesh_sphere(96, 48);
    canvas c = canvas_new(960, 550, SAMPLES);

    state.lighting.ambient = shade_v3(0.15f, 0.15f, 0.17f);
    state.view = shade_mat4_look_at(shade_v3(0, 0, 4), none, shade_v3(0, 1, 0));
    shade_clear(&c.target, shade_v4(0.02f, 0.022f, 0.026f, 1), 1);
    for (int i = 0; i < 3; i++) {
        int x = 6 + 318 * i;
        char text[60];
        shade_target panel = canvas_panel(&c, x, 8, SIZE, SIZE);
        state.lighting.flags = i == 2 ? SHADE_FLAG_INFINITE_VIEWER : 0;
        state.projection = i ? shade_mat4_ortho(-half, half, -half, half, 1, 6)
                             : shade_mat4_frustum(-half / 4, half / 4, -half / 4, half / 4, 1, 6);
        for (int k = 0; k < 9; k++) {
            state.model = shape_at((float)(k % 3) - 1, (float)(k / 3) - 1, 0, 0.44f, 0);
            shade_draw_mesh(&panel, &ball.view, &state, NULL);
        }
        frame(&c, x + EDGE, 8 + EDGE);
        frame(&c, x + EDGE + 2 * CELL, 8 + EDGE + 2 * CELL);
        canvas_zoom(&c, x + 18, 20, 76, 76, x + 2, 328, 2);    /* the framed two, larger */
        canvas_zoom(&c, x + 18 + 2 * CELL, 20 + 2 * CELL, 76, 76, x + 158, 328, 2);
        sprintf(text, i ? "the two: %d of %d pixels differ" : "V = (eye − P) / |eye − P|",
                differing(&c, x, 8), CELL * CELL);
        label_caption(&c, x + SIZE / 2, 508, grey, name[i], text);
    }
    mesh_free(&ball);
    return canvas_save(&c, argc, argv, "viewers.ppm");
}
