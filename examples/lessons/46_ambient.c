/* 46_ambient.c - ambient light on and off (UW, Massey, Berkeley).  Left: one lamp alone, as in
   space: what it does not reach is black.  Then k_a I_a, the same at every point, which stands for
   the light that comes by way of other surfaces: nothing is black, but shadows are flat.  Then, in
   its place, a dim lamp at the eye, a headlight: shadows keep their form.  The number is the part
   of the pot that a display shows black, code 0 to 12 of 255.
   Try 0.5f for the three 0.12f: the form of the lit side is lost as well.

   cc -O2 -I. examples/lessons/46_ambient.c -lm -o ambient && ./ambient        writes ambient.ppm */
#define SHADE_IMPLEMENTATION
#include "shade.h"
#include "../shared/shapes.h"
#include "../shared/label.h"

enum { SIZE = 316, HEIGHT = 250 };

/* The part of the pixels drawn, those with a depth, that are black, in percent */
static double black_part(const shade_target *panel)
{
    int drawn = 0, black = 0;
    for (int i = 0; i < panel->width * panel->height; i++) {
        size_t at = (size_t)(i / panel->width) * (size_t)panel->stride;
        const float *p = (const float *)panel->color + 4 * (at + (size_t)(i % panel->width));
        shade_vec3 code = shade_srgb_from_linear(shade_v3(p[0], p[1], p[2]));
        if (!(panel->depth[at + (size_t)(i % panel->width)] < 1)) continue;
        drawn++;
        black += code.x < 12.5f / 255 && code.y < 12.5f / 255 && code.z < 12.5f / 255;
    }
    return drawn ? 100.0 * black / drawn : 0;
}

int main(int argc, char **argv)
{
    static const char *const name[3] = { "ambient off, as in space", "ambient on",
                                         "a dim headlight instead" };
    static const char *const format[3] = { "I_a = 0: %.1f %% black", "I_a = 0.12: %.1f %% black",
                                           "0.2 at the eye: %.1f %% black" };
    const shade_vec3 grey = { 0.7f, 0.7f, 0.7f }, eye = { 0, 5, 13 };
    const shade_vec3 paint = { 0.55f, 0.42f, 0.25f };
    const shade_material clay = { .ambient = paint, .diffuse = paint,
                                  .specular = { 0.1f, 0.1f, 0.1f }, .shininess = 30 };
    shade_light lamps[2] = { shade_directional_light(shade_v3(1, -0.7f, -0.15f),
                                                     shade_v3(1.1f, 1.05f, 0.95f)),
                             shade_point_light(eye, shade_v3(0.2f, 0.2f, 0.2f)) };
    shade_draw_state state = { .material = &clay, .lighting = { .lights = lamps } };
    owned_mesh pot = shape_teapot(16);
    canvas c = canvas_new(960, 330, 3);

    state.model = shape_at(-0.5f, -1.5f, -0.17f, 1, -0.45f);
    state.view = shade_mat4_look_at(eye, shade_v3(0, -0.05f, 0), shade_v3(0, 1, 0));
    state.projection = shade_mat4_perspective(0.37f, (float)SIZE / HEIGHT, 9, 19);
    canvas_dark(&c.target);
    for (int i = 0; i < 3; i++) {
        shade_target panel = canvas_panel(&c, 322 * i, 0, SIZE, HEIGHT);
        char text[60];
        state.lighting.ambient = shade_scale(shade_v3(0.12f, 0.12f, 0.12f), (float)(i == 1));
        state.lighting.light_count = 1 + (i == 2);
        shade_draw_mesh(&panel, &pot.view, &state, NULL);
        sprintf(text, format[i], black_part(&panel));
        label_caption(&c, 322 * i + SIZE / 2, 280, grey, name[i], text);
    }
    mesh_free(&pot);
    return canvas_save(&c, argc, argv, "ambient.ppm");
}
