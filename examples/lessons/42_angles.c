/* 42_angles.c - the vectors of the notes, their angles, and how R and H are built.  Left: L and its
   mirror image R add up to 2 (L.N) N, hence R = 2 (L.N) N - L; Phong's highlight is the cosine, to
   the n, of the angle between R and V, phi (UW, Massey) or sigma (Shirley).  Right: H halves the
   angle between L and V, because the sum of two unit vectors is the diagonal of a rhombus;
   Blinn's highlight is the cosine of omega, to the n.  Try to_eye = 50: both highlights are 1.

   cc -O2 -I. examples/lessons/42_angles.c -lm -o angles && ./angles            writes angles.ppm */
#define SHADE_IMPLEMENTATION
#include "shade.h"
#include "../shared/sketch.h"
#include <math.h>

static const float theta = 50, to_eye = 20;    /* degrees from N: L to the left, V to the right */
static const shade_vec3 P = { 0, 0, 0 }, N = { 0, 1, 0 };
static const shade_vec3 black = { 0.02f, 0.02f, 0.02f }, grey = { 0.2f, 0.2f, 0.2f };
static const shade_vec3 red = { 0.65f, 0.08f, 0.01f }, blue = { 0.02f, 0.12f, 0.6f };

static double arc(shade_vec3 a, shade_vec3 b) { return acos((double)shade_dot(a, b)) * 57.29578; }

static void vector(sketch *s, shade_vec3 v, const char *name, shade_vec3 color)
{
    sketch_ink(s, color, 3);
    sketch_arrow(s, P, v);
    sketch_name(s, shade_scale(v, 1.08f), 26, name);
}

/* An arc about P between two angles, with its letter outside of it */
static void angle(sketch *s, float radius, float from, float to, const char *letter)
{
    sketch_arc(s, P, radius, from, to);
    sketch_name(s, shade_scale(sketch_direction((from + to) / 2), radius + 0.075f), 22, letter);
}

/* N, L, V, and beside them d; then a and b added to what has a name */
static sketch figure(const canvas *c, int x, const shade_vec3 d[5], const char *letter,
                     const char *sum)
{
    sketch s = sketch_new(c, x, 425, 240);
    sketch_ink(&s, grey, 2);
    sketch_line(&s, shade_v3(-0.9f, 0, 0), shade_v3(0.9f, 0, 0));
    const shade_vec3 end = shade_add(d[3], d[4]);
    sketch_dashes(&s, d[3], end);
    sketch_dashes(&s, d[4], end);
    sketch_dashes(&s, shade_scale(shade_normalize(end), 1.14f), end);
    sketch_name(&s, shade_add(end, shade_v3(0, 0.08f, 0)), 22, sum);
    vector(&s, N, "N", black);
    vector(&s, d[0], "L", black);
    vector(&s, d[1], "", black);
    sketch_name(&s, shade_add(d[1], shade_v3(*letter == 'R' ? -0.08f : 0.07f, 0.03f, 0)), 26, "V");
    vector(&s, d[2], letter, *letter == 'R' ? red : blue);
    return s;
}

int main(int argc, char **argv)
{
    const shade_vec3 L = sketch_direction(-theta), V = sketch_direction(to_eye);
    const shade_vec3 R = shade_mirror(L, N), H = shade_halfway(L, V);
    const float to_half = (to_eye - theta) / 2;
    canvas c = canvas_new(960, 520, 3);
    sketch_paper(&c);
    sketch left = figure(&c, 240, (shade_vec3[]){ L, V, R, L, R }, "R", "2 (L·N) N");
    sketch right = figure(&c, 720, (shade_vec3[]){ L, V, H, L, V }, "H", "L + V");
    angle(&right, 0.62f, to_half, 0, "ω");
    sketch_arc(&right, P, 0.3f, -theta, to_half);
    sketch_arc(&right, P, 0.33f, to_half, to_eye);
    angle(&left, 0.62f, to_eye, theta, "σ, φ");
    sketch_ink(&left, black, 2);
    angle(&left, 0.3f, -theta, 0, "θ");
    angle(&left, 0.3f, 0, theta, "θ");
    label_center(&c, 240, 470, 24, red, "R = 2 (L·N) N − L");
    label_center(&c, 720, 470, 24, blue, "H = (L + V) / |L + V|");
    label_print(&c, 90, 503, 20, black, "θ = %.1f°, σ = %.1f°, cos σ = R·V = %.4f",
                arc(N, L), arc(R, V), (double)shade_dot(R, V));
    label_print(&c, 600, 503, 20, black, "ω = %.1f°, cos ω = N·H = %.4f", arc(N, H),
                (double)shade_dot(N, H));
    return canvas_save(&c, argc, argv, "angles.ppm");
}
