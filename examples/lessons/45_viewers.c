/* 45_viewers.c - a viewer nearby and one at infinity (Berkeley).  Left: in perspective V is the
   direction from each pixel to the eye, and every ball carries its highlight elsewhere.  Middle: an
   orthographic camera, but V still aims at a point: highlights wander where views are parallel.
   Right: SHADE_FLAG_INFINITE_VIEWER, V the same everywhere, and all nine balls are alike.  Below:
   the framed two, larger, and how many of their pixels differ by more than 2 of 255 codes.
   Try SHADE_MODEL_LAMBERT: the two orthographic pictures are the same, k_d does not know V.

   cc -O2 -I. examples/lessons/45_viewers.c -lm -o viewers && ./viewers        writes viewers.ppm */
#define SHADE_IMPLEMENTATION
#include "shade.h"
#include "../shared/shapes.h"
#include "../shared/label.h"

enum { SIZE = 312, CELL = 100, EDGE = 6, LARGE = 153 };    /* pixels; 3 cells and edges: SIZE */

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

/* Those of nine balls that lie in the square of size units from x, y on, in the plane z = 0 */
static void draw(shade_target panel, shade_draw_state state, int perspective, float x, float y,
                 float size)
{
    owned_mesh ball = mesh_sphere(96, 48);
    const float s = perspective ? 0.25f : 1;
    const float left = s * x, right = s * (x + size), low = s * y, high = s * (y + size);
    state.projection = perspective ? shade_mat4_frustum(left, right, low, high, 1, 6)
                                   : shade_mat4_ortho(left, right, low, high, 1, 6);
    for (int k = 0; k < 9; k++) {
        const float from_x = (float)(k % 3) - 1 - x, from_y = (float)(k / 3) - 1 - y;
        if (fminf(from_x, from_y) < 0 || fmaxf(from_x, from_y) > size) continue;
        state.model = shape_at(x + from_x, y + from_y, 0, 0.44f, 0);
        shade_draw_mesh(&panel, &ball.view, &state, NULL);
    }
    mesh_free(&ball);
}

int main(int argc, char **argv)
{
    static const char *const name[3] = { "perspective", "orthographic, V to a point",
                                         "orthographic, V constant" };
    const shade_vec3 grey = { 0.7f, 0.7f, 0.7f }, clay = { 0.35f, 0.12f, 0.06f };
    const shade_vec3 none = { 0, 0, 0 }, white = { 1, 1, 1 };
    const shade_material glaze = { none, clay, clay, { 0.6f, 0.6f, 0.6f }, 30 };
    const float size = 3.0f * SIZE / (SIZE - 2 * EDGE);
    shade_light lamp = shade_directional_light(shade_v3(0.5f, -0.7f, -1), white);
    shade_draw_state state = { .material = &glaze, .lighting = { &lamp, .light_count = 1 } };
    canvas c = canvas_new(960, 550, 3);

    state.lighting.ambient = shade_v3(0.15f, 0.15f, 0.17f);
    state.view = shade_mat4_look_at(shade_v3(0, 0, 4), none, shade_v3(0, 1, 0));
    shade_clear(&c.target, shade_v4(0.02f, 0.022f, 0.026f, 1), 1);
    for (int i = 0; i < 3; i++) {
        int x = 6 + 318 * i;
        char say[60];
        state.lighting.flags = i == 2 ? SHADE_FLAG_INFINITE_VIEWER : 0;
        draw(canvas_panel(&c, x, 8, SIZE, SIZE), state, !i, -size / 2, -size / 2, size);
        int n = differing(&c, x, 8);
        for (int k = 0; k < 2; k++) {    /* two of them, framed and larger */
            int at = x + EDGE + 2 * CELL * k, below = x + (SIZE - LARGE) * k;
            float left = 2 * (float)k - 1.5f, low = 0.5f - 2 * (float)k;
            draw(canvas_inset(&c, at, at - x + 8, CELL, CELL), state, !i, left, low, 1);
            draw(canvas_inset(&c, below, 328, LARGE, LARGE), state, !i, left, low, 1);
        }
        sprintf(say, i ? "the two: %d of 10000 pixels differ" : "V = (eye − P) / |eye − P|", n);
        label_caption(&c, x + SIZE / 2, 508, grey, name[i], say);
    }
    return canvas_save(&c, argc, argv, "viewers.ppm");
}
