/* 25_fall_off.c - balls 1, 2, 3, 4 and 5 away from a lamp whose light does not weaken, falls as 1/r
   and as 1/r^2.  Left: stored with sRGB, so that the display shows the computed light.  Right:
   stored as computed, as the courses' programs did.  A display shows about the power 2.2 of that,
   which turns 1/r^2 into 1/r^4.4: at distance 2 not 1/4 of the light but 1/20.  That is why 1/r^2
   "tends to look bad", and why 1/r, shown as 1/r^2.2, is Berkeley's compromise.  The numbers are
   what is shown of the light at the five distances.  Shadows are left out.
   Try lamp.constant = 1 in all rows: 1/(1 + r^2), and the first ball is no longer white.

   cc -O2 -I. examples/25_fall_off.c -lm -o fall_off && ./fall_off */
#define SHADE_IMPLEMENTATION
#include "shade.h"
#include "shared/balls.h"
#include "shared/label.h"
#include <math.h>

enum { BALLS = 5, WIDTH = 477, HEIGHT = 160 };

/* What a display shows of the light at distances 1 to 5 */
static void print_light(const canvas *c, int x, int y, const shade_light *lamp, int raw)
{
    static const int column[BALLS] = { 60, 166, 246, 320, 394 };    /* below the balls */
    for (int r = 1; r <= BALLS; r++) {
        float light = shade_attenuation(lamp->constant, lamp->linear, lamp->quadratic, (float)r);
        if (raw) light = shade_linear_from_srgb(shade_v3(light, 0, 0)).x;
        label_print(c, x + column[r - 1], y, 18, shade_v3(0.5f, 0.5f, 0.5f), "%.3f", (double)light);
    }
}

/* What a display makes of numbers stored without sRGB */
static void store_raw(const shade_target *t)
{
    for (int i = 0; i < t->width * t->height; i++) {
        float *p = (float *)t->color + 4 * (i / t->width * t->stride + i % t->width);
        shade_vec3 k = shade_linear_from_srgb(shade_v3(p[0], p[1], p[2]));
        p[0] = k.x;
        p[1] = k.y;
        p[2] = k.z;
    }
}

int main(int argc, char **argv)
{
    static const char *const name[2][3] = { { "no fall-off", "1/r", "1/r^2" },
                                            { "no fall-off", "1/r, shown as 1/r^{2.2}",
                                              "1/r^2, shown as 1/r^{4.4}" } };
    const shade_vec3 white = { 1, 0.95f, 0.85f }, grey = { 0.7f, 0.7f, 0.7f };
    const shade_vec3 clay = { 0.7f, 0.4f, 0.2f };
    shade_vec4 place[BALLS];
    shade_vec3 color[BALLS] = { clay, clay, clay, clay, clay };
    shade_light lamp = shade_point_light(shade_v3(-3, 0.9f, 0.8f), white);
    balls scene = { BALLS, place, color, .floor = { 0.8f, 0.77f, 0.72f },
                    .no_shadows = 1 };
    canvas c = canvas_new(960, 630, 2);

    for (int i = 0; i < BALLS; i++)    /* i + 1 away from the lamp, .8 behind and .5 below it */
        place[i] = shade_v4(sqrtf((float)((i + 1) * (i + 1)) - 0.89f) - 3, 0.4f, 0, 0.4f);
    scene.eye = shade_v3(-0.9f, 1.8f, 6);
    scene.center = shade_v3(-0.57f, 0.38f, 0);
    scene.fovy = 0.35f;
    scene.lighting.lights = &lamp;
    scene.lighting.light_count = 1;
    canvas_dark(&c.target);
    label_center(&c, 238, 26, 22, grey, "stored with sRGB");
    label_center(&c, 721, 26, 22, grey, "stored as computed");
    for (int i = 0; i < 6; i++) {
        int x = i % 2 * 483, y = 38 + i / 2 * 198;
        shade_target panel = canvas_panel(&c, x, y, WIDTH, HEIGHT);
        lamp.constant = i / 2 == 0;
        lamp.linear = i / 2 == 1;
        lamp.quadratic = i / 2 == 2;
        balls_draw(&panel, &scene);
        if (i % 2) store_raw(&panel);
        label_draw(&c, x + 12, y + 24, 20, grey, name[i % 2][i / 2]);
        print_light(&c, x, y + HEIGHT + 24, &lamp, i % 2);
    }
    return canvas_save(&c, argc, argv, "fall_off.ppm");
}
