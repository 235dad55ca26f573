/* 23_mach_bands.c - a drum of twelve sides and, below it, the values 0 to 255 that a display gets
   across its middle (Berkeley).  Where this profile has a step or a kink, the eye sees a
   line that is not there, a Mach band.  Flat shading has steps.  Gouraud's has kinks on the edges,
   seen as a bright line in the middle and dark ones beside it.  Phong's is smooth: each pixel has
   the normal of a round drum.
   Try 72 sides for 12: the kinks become too small to be seen.

   cc -O2 -I. examples/lessons/23_mach_bands.c -lm -o mach_bands && ./mach_bands */
#define SHADE_IMPLEMENTATION
#include "shade.h"
#include "../shared/shapes.h"
#include "../shared/label.h"
#include <math.h>

enum { WIDTH = 300, HEIGHT = 250, REACH = 4 };    /* slopes are means over REACH pixels */

/* Red at a pixel as a display shows it, 0 .. 255 */
static float code(const canvas *c, int x, int y)
{
    shade_vec4 k = canvas_pixel(c, x, y);
    return 255 * shade_srgb_from_linear(shade_v3(k.x, k.y, k.z)).x;
}

/* A line of the profiles, from code y0 at pixel x0 to y1 at x1 */
static void stroke(const canvas *c, int x0, float y0, int x1, float y1, float width)
{
    const shade_vec3 ends[2] = { { (float)x0 + 0.5f, 460 - 0.75f * y0, 0 },
                                 { (float)x1 + 0.5f, 460 - 0.75f * y1, 0 } };
    shade_line_state pen = { .width = width, .color = { 0.9f, 0.4f, 0.1f, 1 } };
    pen.clip_from_points = canvas_from_pixels(c);
    pen.raster.depth_test = SHADE_COMPARE_ALWAYS;
    shade_draw_lines(&c->target, ends, 2, &pen, NULL);
}

int main(int argc, char **argv)
{
    static const shade_shading shading[3] = { SHADE_SHADING_PER_FACE, SHADE_SHADING_PER_VERTEX,
                                              SHADE_SHADING_PER_FRAGMENT };
    static const char *const name[3] = { "flat", "Gouraud", "Phong" };
    static const shade_vec2 side[2] = { { 1, 0.8f }, { 1, -0.8f } };
    const shade_vec3 grey = { 0.7f, 0.7f, 0.7f }, blue = { 0.1f, 0.14f, 0.3f };
    const shade_material paint = { { 0, 0, 0 }, blue, blue, { 0.5f, 0.5f, 0.5f }, 20 };
    const shade_light lamp = shade_directional_light(shade_v3(0, 0, -1), shade_v3(1, 1, 1));
    shade_draw_state state = { .material = &paint,
                               .lighting = { &lamp, 1, .ambient = { 0.02f, 0.02f, 0.02f },
                                             .flags = SHADE_FLAG_INFINITE_VIEWER } };
    owned_mesh drum = shape_turned(side, 2, 12);
    canvas c = canvas_new(960, 540, 2);
    char text[60];

    state.view = shade_mat4_look_at(shade_v3(0, 0, 5), shade_v3(0, 0, 0), shade_v3(0, 1, 0));
    state.projection = shade_mat4_ortho(-1.05f, 1.05f, -0.875f, 0.875f, 1, 10);
    canvas_dark(&c.target);
    for (int i = 0; i < 3; i++) {
        int left = 320 * i + 10;
        float y[WIDTH], most = 0;
        shade_target panel = canvas_panel(&c, left, 5, WIDTH, HEIGHT);
        state.shading = shading[i];
        shade_draw_mesh(&panel, &drum.view, &state, NULL);
        for (int x = 0; x < WIDTH; x++) y[x] = code(&c, left + x, 5 + HEIGHT / 2);
        stroke(&c, left, 0, left + WIDTH, 0, 1);
        stroke(&c, left, 255, left + WIDTH, 255, 1);
        for (int x = 0; x < WIDTH - 1; x++) {
            stroke(&c, left + x, y[x], left + x + 1, y[x + 1], 3);
            if (x < 30 || x >= WIDTH - 30) continue;    /* the outline */
            most = fmaxf(most, fabsf(y[x + REACH + 1] - y[x + 1] - y[x - 1] + y[x - REACH - 1]));
        }
        sprintf(text, "slope jumps by up to %d.%d a pixel", (int)(most / REACH),
                (int)(10 * most / REACH) % 10);
        label_caption(&c, left + WIDTH / 2, 495, grey, name[i], text);
    }
    mesh_free(&drum);
    return canvas_save(&c, argc, argv, "mach_bands.ppm");
}
