/* 23_mach_bands.c - a drum of twelve sides and, below it, its profile: the values 0 to 255 that a
   display gets across its middle (UW, Berkeley).  Where the profile has a step or a kink the eye
   sees a line that is not there, a Mach band.  Flat shading has steps.  Gouraud's has kinks at the
   edges, seen as a bright line in the middle and dark ones beside it.  Phong's is smooth, because
   each pixel has the normal of a round drum.
   Try 72 sides for 12: the kinks become too small to be seen.

   cc -O2 -I. examples/lessons/23_mach_bands.c -lm -o mach_bands && ./mach_bands */
#define SHADE_IMPLEMENTATION
#include "shade.h"
#include "../shared/shapes.h"
#include "../shared/sketch.h"
#include <math.h>

enum { WIDTH = 300, HEIGHT = 250, REACH = 4 };    /* slopes are means over REACH pixels */
static const shade_vec3 grey = { 0.7f, 0.7f, 0.7f }, orange = { 0.9f, 0.4f, 0.1f };

/* A point of a profile */
static shade_vec3 at(float x, float code) { return shade_v3(x + 0.5f, 0.75f * code, 0); }

/* Draws axes and profile; returns its greatest change of slope, in codes a pixel. */
static float draw_profile(sketch *s, const float *codes)
{
    float most = 0;
    sketch_ink(s, grey, 1);
    sketch_line(s, at(0, 255), at(WIDTH, 255));
    sketch_arrow(s, at(0, 0), at(WIDTH, 0));
    sketch_name(s, at(34, 230), 30, "255");
    sketch_name(s, at(27, 18), 30, "0");
    sketch_ink(s, orange, 2);
    for (int x = 0; x + 1 < WIDTH; x++) {
        sketch_line(s, at((float)x, codes[x]), at((float)x + 1, codes[x + 1]));
        if (x < 30 || x >= WIDTH - 30) continue;    /* the outline */
        float a = codes[x - 1] - codes[x - REACH - 1], b = codes[x + REACH + 1] - codes[x + 1];
        most = fmaxf(most, fabsf(b - a) / REACH);
    }
    return most;
}

int main(int argc, char **argv)
{
    static const char *const name[3] = { "flat", "Gouraud", "Phong" };
    static const char *const band[2][3] = { { "step", "", "step" }, { "dark", "bright", "dark" } };
    static const shade_vec2 side[2] = { { 1, 0.8f }, { 1, -0.8f } };
    const unsigned flags = SHADE_FLAG_INFINITE_VIEWER;
    const shade_vec3 blue = { 0.1f, 0.14f, 0.3f };
    const shade_material paint = { { 0 }, blue, blue, { 0.5f, 0.5f, 0.5f }, 20 };
    const shade_light lamp = shade_directional_light(shade_v3(0, 0, -1), shade_v3(1, 1, 1));
    shade_draw_state state = { .material = &paint, .lighting = { &lamp, 1, .flags = flags } };
    owned_mesh drum = shape_turned(side, 2, 12);
    canvas c = canvas_new(960, 540, 2);
    state.view = shade_mat4_look_at(shade_v3(0, 0, 5), shade_v3(0, 0, 0), shade_v3(0, 1, 0));
    state.projection = shade_mat4_ortho(-1.05f, 1.05f, -0.875f, 0.875f, 1, 10);
    canvas_dark(&c.target);
    for (int i = 0; i < 3; i++) {
        const int left = 320 * i + 10;
        const shade_target panel = canvas_panel(&c, left, 5, WIDTH, HEIGHT);
        sketch s = sketch_new(&c, left, 460, 1);    /* in pixels */
        float codes[WIDTH];
        char text[60];
        state.shading = i == 0 ? SHADE_SHADING_PER_FACE : i == 1 ? SHADE_SHADING_PER_VERTEX
                                                                 : SHADE_SHADING_PER_FRAGMENT;
        shade_draw_mesh(&panel, &drum.view, &state, NULL);
        for (int x = 0; x < WIDTH; x++) {
            shade_vec3 red = { canvas_pixel(&c, left + x, 5 + HEIGHT / 2).x, 0, 0 };
            codes[x] = 255 * shade_srgb_from_linear(red).x;
        }
        sprintf(text, "slope jumps by %.1f codes a pixel", (double)draw_profile(&s, codes));
        label_caption(&c, left + WIDTH / 2, 495, grey, name[i], text);
        sketch_ink(&s, grey, 1.5f);
        for (int k = 0; i < 2 && k < 3; k++) {    /* edges of the drum, at x = -.5, 0 and .5 */
            const float x = WIDTH / 2 * (1 + 0.5f * (float)(k - 1) / 1.05f), y = codes[(int)x];
            if (*band[i][k]) sketch_arrow(&s, at(x, y - 52), at(x, y - 8));
            sketch_name(&s, at(x, y - (k == 1 ? 80 : 74)), 30, band[i][k]);
        }
    }
    mesh_free(&drum);
    return canvas_save(&c, argc, argv, "mach_bands.ppm");
}
