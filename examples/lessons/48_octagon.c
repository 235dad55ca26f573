/* 48_octagon.c - one outline, two sets of normals (Shirley): a circle of eight sides under a lamp.
   Left: the normals of the sides.  Right: at each corner the mean of its two sides, made unit, and
   interpolated along them.  The band outside shows the light of each point, by shade_lambert: eight
   flat pieces, or a curve without steps.  The number is the greatest angle to the normals of the
   circle.
   Try SIDES = 24: 7.5 degrees, and steps that are hard to see.

   cc -O2 -I. examples/lessons/48_octagon.c -lm -o octagon && ./octagon        writes octagon.ppm */
#define SHADE_IMPLEMENTATION
#include "shade.h"
#include "../shared/sketch.h"
#include <math.h>

enum { SIDES = 8, STEPS = 24, UNIT = 120 };    /* steps along a side */
static const shade_vec3 black = { 0.02f, 0.02f, 0.02f }, blue = { 0.02f, 0.15f, 0.6f };

static shade_vec3 corner(float k) { return sketch_direction(360 * (k + 0.5f) / SIDES); }

/* The normal at t, from 0 to 1, of a side between two corners */
static shade_vec3 normal(int side, float t, int smooth)
{
    shade_vec3 a = corner((float)side), b = corner((float)side + 1);
    return shade_normalize(smooth ? shade_lerp(a, b, t) : shade_add(a, b));
}

/* Draws the outline, its light and a normal at the middle or the ends of each side; returns the
   greatest angle between a normal and the direction from the centre, in degrees. */
static double figure(const canvas *c, int x, shade_vec3 L, int smooth)
{
    sketch s = sketch_new(c, x, 215, UNIT);
    float least = 1;
    for (int i = 0; i < SIDES * STEPS; i++) {
        const int side = i / STEPS, k = i % STEPS;
        const float t = (float)k / STEPS, next = ((float)k + 1) / STEPS;
        shade_vec3 a = corner((float)side), b = corner((float)side + 1);
        shade_vec3 P = shade_lerp(a, b, t), Q = shade_lerp(a, b, next);
        shade_vec3 N = normal(side, (t + next) / 2, smooth);
        float light = 0.03f + 0.9f * shade_lambert(N, L);
        s.pen.cap = SHADE_CAP_BUTT;
        sketch_ink(&s, shade_v3(light, 0.8f * light, 0.5f * light), 1.5f);
        for (float r = 1.04f; r < 1.17f; r += 0.005f)    /* a band whose ends meet at corners */
            sketch_line(&s, shade_scale(P, r), shade_scale(Q, r));
        s.pen.cap = SHADE_CAP_SQUARE;
        sketch_ink(&s, black, 2);
        sketch_line(&s, P, Q);
        least = fminf(least, shade_dot(normal(side, t, smooth), shade_normalize(P)));
        if (k != (smooth ? 0 : STEPS / 2)) continue;
        sketch_ink(&s, blue, 2.5f);
        sketch_arrow(&s, shade_scale(P, 1.19f), shade_madd(shade_scale(P, 1.19f), 0.33f, N));
    }
    return acos((double)least) * 57.29578;
}

int main(int argc, char **argv)
{
    const shade_vec3 L = sketch_direction(-40);
    canvas c = canvas_new(960, 450, 3);
    char text[60];
    sketch_paper(&c);
    for (int i = 0; i < 2; i++) {
        int x = 240 + 480 * i;
        double off = figure(&c, x, L, i);
        sketch s = sketch_new(&c, x, 215, UNIT);
        sketch_ink(&s, black, 3);
        sketch_arrow(&s, shade_v3(0, 0, 0), shade_scale(L, 0.7f));
        sketch_name(&s, shade_v3(-0.13f, 0.47f, 0), 34, "L");
        label_center(&c, x, 412, 22, black,
                     i ? "normals of corners, interpolated" : "normals of sides");
        sprintf(text, "at most %.1f° off the circle's", off);
        label_center(&c, x, 438, 19, black, text);
    }
    return canvas_save(&c, argc, argv, "octagon.ppm");
}
