/* 25_fall_off.c - balls 1, 2, 3, 4 and 5 away from a lamp whose light does not weaken, falls as 1/r
   and as 1/r^2.  Left: stored with sRGB, so that the display shows the computed light.  Right:
   stored as computed, as the courses' programs did.  A display shows about the power 2.2 of that,
   which turns 1/r^2 into 1/r^4.4: at distance 2 not 1/4 of the light but 1/20.  That is why 1/r^2
   "tends to look bad", and why 1/r, shown as 1/r^2.2, is Berkeley's compromise.  Numbers and curves
   are what is shown of the light at distances 1 to 5.  Shadows are left out.
   Try lamp.constant = 1 in all rows: 1/(1 + r^2), and the first ball is no longer white.

   cc -O2 -I. examples/lessons/25_fall_off.c -lm -o fall_off && ./fall_off */
#define SHADE_IMPLEMENTATION
#include "shade.h"
#include "../shared/balls.h"
#include "../shared/label.h"
#include <math.h>

enum { BALLS = 5, WIDTH = 370, HEIGHT = 124, ROW = 166, PLOT = 180 };

/* What a display shows of the light: numbers at distances 1 to 5, and a curve from 1 to 5 */
static void print_light(const canvas *c, int x, int y, const shade_light *lamp, int raw)
{
    static const int column[BALLS] = { 43, 126, 188, 246, 304 };    /* below the balls */
    const shade_vec3 ink[2] = { { 0.7f, 0.65f, 0.55f }, { 0.8f, 0.25f, 0.03f } };
    canvas_fill(&c->target, 2 * 762, 2 * (y - 124), 2, 2 * 106, ink[0]);    /* the axes */
    canvas_fill(&c->target, 2 * 762, 2 * (y - 18), 2 * PLOT, 2, ink[0]);
    for (int k = 0; k <= PLOT; k++) {
        float r = 1 + 4 * (float)k / PLOT;
        float light = shade_attenuation(lamp->constant, lamp->linear, lamp->quadratic, r);
        if (raw) light = shade_linear_from_srgb(shade_v3(light, 0, 0)).x;
        canvas_fill(&c->target, 2 * (764 + k), 2 * (y - 22 - (int)(100 * light)), 2, 8, ink[raw]);
        if (k * 4 % PLOT == 0)
            label_print(c, x + column[k * 4 / PLOT], y, 17, ink[raw], "%.3f", (double)light);
    }
}

/* What a display makes of numbers stored without sRGB */
static void store_raw(const shade_target *t)
{
    for (int i = 0; i < t->width * t->height; i++) {
        float *p = (float *)t->color + 4 * (i / t->width * t->stride + i % t->width);
        for (int k = 0; k < 3; k++) p[k] = shade_linear_from_srgb(shade_v3(p[k], 0, 0)).x;
    }
}

int main(int argc, char **argv)
{
    static const char *const name[2][3] = { { "no fall-off", "1/r", "1/r^2" },
                                            { "no fall-off", "1/r, shown as 1/r^{2.2}",
                                              "1/r^2, shown as 1/r^{4.4}" } };
    const shade_vec3 white = { 1, 0.95f, 0.85f }, grey = { 0.7f, 0.7f, 0.7f };
    shade_vec4 place[BALLS];
    shade_vec3 color[BALLS];
    shade_light lamp = shade_point_light(shade_v3(-3, 0.9f, 0.8f), white);
    balls scene = { BALLS, place, color, .floor = { 0.8f, 0.77f, 0.72f }, .no_shadows = 1,
                    .eye = { -0.9f, 1.8f, 6 }, .lighting = { .lights = &lamp, .light_count = 1 } };
    canvas c = canvas_new(960, 38 + 3 * ROW, 2);

    for (int i = 0; i < BALLS; i++) {    /* i + 1 away from the lamp, .8 behind and .5 below it */
        place[i] = shade_v4(sqrtf((float)((i + 1) * (i + 1)) - 0.89f) - 3, 0.4f, 0, 0.4f);
        color[i] = shade_v3(0.7f, 0.4f, 0.2f);
    }
    scene.center = shade_v3(-0.57f, 0.38f, 0);
    scene.fovy = 0.35f;
    canvas_dark(&c.target);
    label_draw(&c, 100, 26, 22, grey, "stored with sRGB");
    label_draw(&c, 466, 26, 22, grey, "stored as computed");
    label_draw(&c, 764, 26, 20, grey, "light shown, r = 1 to 5");
    for (int i = 0; i < 6; i++) {
        int x = i % 2 * 376, y = 38 + i / 2 * ROW;
        shade_target panel = canvas_panel(&c, x, y, WIDTH, HEIGHT);
        lamp.constant = i / 2 == 0;
        lamp.linear = i / 2 == 1;
        lamp.quadratic = i / 2 == 2;
        balls_draw(&panel, &scene);
        if (i % 2) store_raw(&panel);
        label_draw(&c, x + 12, y + 22, 19, grey, name[i % 2][i / 2]);
        print_light(&c, x, y + HEIGHT + 24, &lamp, i % 2);
    }
    return canvas_save(&c, argc, argv, "fall_off.ppm");
}
