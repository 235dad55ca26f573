/* 05_lights.c - balls under three kinds of lamp (UW, Berkeley).  From a lamp at infinity L is the
   same everywhere, and all shadows are parallel.  From a point Q L changes from pixel to pixel, and
   shadows point away from the lamp.  A spotlight is a point whose light ends where L leaves the
   cone about its axis S.
   Try 60 for the exponent 8: the pool of light fades before it reaches the rim of the cone.

   cc -O2 -I. examples/lessons/05_lights.c -lm -o lights && ./lights        writes lights.ppm */
#define SHADE_IMPLEMENTATION
#include "shade.h"
#include "../shared/balls.h"
#include "../shared/label.h"

enum { BALLS = 7 };

int main(int argc, char **argv)
{
    static const char *const name[3] = { "directional", "point", "spot" };
    char formula[3][80];
    static const uint32_t paint[BALLS] = { 0xD05040, 0xD89040, 0xC8C050, 0x58A060, 0x4088B0,
                                           0x6060B8, 0xA058A8 };
    const shade_vec3 white = { 1, 0.95f, 0.85f }, grey = { 0.7f, 0.7f, 0.7f };
    shade_vec4 place[BALLS];
    shade_vec3 color[BALLS];
    shade_light lamp[3];
    balls scene = { BALLS, place, color, .floor = shade_rgb(0xB0A898) };
    canvas c = canvas_new(960, 400, 2);

    for (int i = 0; i < BALLS; i++) {
        shade_vec2 a = mesh_turn((float)i / BALLS);
        place[i] = shade_v4(1.5f * a.x, 0.42f, 1.5f * a.y, 0.42f);
        color[i] = shade_rgb(paint[i]);
    }
    lamp[0] = shade_directional_light(shade_v3(0.6f, -1, -0.5f), white);
    lamp[1] = shade_point_light(shade_v3(0.2f, 1.7f, 0), white);
    lamp[2] = shade_spot_light(shade_v3(-1, 4, 1.5f), shade_v3(1.3f, -4, -1.3f), 0.36f, 8,
                               shade_scale(white, 1.3f));
    scene.eye = shade_v3(0, 5, 5.2f);
    scene.center = shade_v3(0.08f, 0.1f, 0.1f);
    scene.fovy = 0.66f;
    shade_vec4 Q = lamp[1].position;
    shade_vec3 L;
    shade_light_at(&lamp[0], scene.center, &L, NULL);
    snprintf(formula[0], sizeof *formula, "L = (%.2f, %.2f, %.2f) everywhere", (double)L.x,
             (double)L.y, (double)L.z);
    snprintf(formula[1], sizeof *formula, "L = (Q − P) / r, Q = (%.1f, %.1f, %.1f)", (double)Q.x,
             (double)Q.y, (double)Q.z);
    snprintf(formula[2], sizeof *formula, "(L·S)^%.0f where L·S ≥ cos %.1f°",
             (double)lamp[2].spot_exponent, acos((double)lamp[2].spot_cos_cutoff) * 57.29578);
    scene.lighting.light_count = 1;
    scene.lighting.ambient = shade_v3(0.04f, 0.045f, 0.06f);
    canvas_dark(&c.target);
    for (int i = 0; i < 3; i++) {
        shade_target panel = canvas_panel(&c, 321 * i, 0, 318, 330);
        scene.lighting.lights = &lamp[i];
        balls_draw(&panel, &scene);
        label_caption(&c, 320 * i + 160, 358, grey, name[i], formula[i]);
    }
    return canvas_save(&c, argc, argv, "lights.ppm");
}
