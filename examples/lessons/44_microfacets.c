/* 44_microfacets.c - what k_s and k_d stand for (Massey).  A smooth interface is a mirror: rays
   leave side by side.  A rough one is made of microfacets, each a mirror.  Tilted a little, they
   spread the rays about R: glossy, with a smaller n.  Tilted every way they send light in all
   directions, UW's first picture of k_d.  So do grains of pigment, its second, which absorb light
   and re-emit the rest in their colour.  RMS of 20,000 rays.  Try 0.02f for 0.22f: a mirror.

   cc -O2 -I. examples/lessons/44_microfacets.c -lm -o microfacets && ./microfacets */
#define SHADE_IMPLEMENTATION
#include "shade.h"
#include "../shared/sketch.h"
#include <math.h>

enum { RAYS = 20000, DRAWN = 5, UNIT = 120 };
static const shade_vec3 black = { 0.02f, 0.02f, 0.02f }, amber = { 0.85f, 0.4f, 0.01f };
static const shade_vec3 teal = { 0, 0.3f, 0.3f }, brown = { 0.35f, 0.08f, 0 };

/* A number of -1 .. 1; those of successive k fill it evenly */
static float evenly(int k, float step) { return 2 * fmodf((float)(k + 1) * step, 1) - 1; }

/* Where ray k leaves: mirrored at the facet F or, without one, as Lambert's law has it */
static shade_vec3 leaving(int k, shade_vec3 L, float roughness, shade_vec3 *F)
{
    float a = evenly(k, 0.618034f), b = evenly(k, 0.754878f);
    *F = shade_normalize(shade_v3(roughness < 0 ? 0 : roughness * (a + b), 1, 0));
    return roughness < 0 ? shade_v3(a, sqrtf(1 - a * a), 0) : shade_mirror(L, *F);
}

static double spread(shade_vec3 L, float roughness, shade_vec3 about)
{
    double sum = 0;
    shade_vec3 F;
    for (int k = 0; k < RAYS; k++) {
        float cosine = shade_dot(leaving(k, L, roughness, &F), about);
        double angle = cosine < 1 ? acos((double)cosine) : 0;
        sum += angle * angle / RAYS;
    }
    return 57.29578 * sqrt(sum);
}

static void draw_ray(sketch *s, int k, shade_vec3 L, float roughness)
{
    shade_vec3 F, P = shade_v3(0.36f * (float)(k - DRAWN / 2), 0, 0), out = P, grain;
    shade_vec3 d = leaving(k, L, roughness, &F), side = shade_v3(0.18f * F.y, -0.18f * F.x, 0);
    sketch_ink(s, amber, 2.5f);
    sketch_arrow(s, shade_madd(P, 1.1f, L), P);
    sketch_ink(s, roughness < 0 ? teal : brown, 2.5f);
    if (roughness < 0) {
        for (int i = 0; i < 3; i++) {    /* from grain to grain, until it leaves */
            float depth = i == 2 ? 0 : 0.4f + 0.3f * evenly(3 * k + i, 0.33f);
            grain = shade_v3(P.x + 0.2f * evenly(3 * k + i, 0.57f), -depth, 0);
            sketch_line(s, out, grain);
            if (i < 2) sketch_dot(s, grain, 8);
            out = grain;
        }
    }
    sketch_arrow(s, out, shade_madd(out, 0.9f, d));
    sketch_ink(s, black, 4);
    sketch_line(s, shade_sub(P, side), shade_add(P, side));
}

int main(int argc, char **argv)
{
    static const char *const name[3] = { "smooth: mirror", "rough: glossy", "pigment: diffuse" };
    static const char *const format[2] = { "k_s, ±%.1f° about R", "k_d, ±%.1f° about N" };
    static const float roughness[3] = { 0, 0.22f, -1 };
    const shade_vec3 L = sketch_direction(-30), N = { 0, 1, 0 };
    canvas c = canvas_new(960, 372, 3);
    sketch_paper(&c);
    for (int i = 0; i < 3; i++) {
        sketch s = sketch_new(&c, 172 + 308 * i, 160, UNIT);
        char caption[64];
        canvas_fill(&c.target, 3 * s.x - 420, 3 * s.y, 840, 330, shade_v3(0.5f, 0.68f, 0.68f));
        for (int k = 0; k < DRAWN; k++) draw_ray(&s, k, L, roughness[i]);
        label_center(&c, s.x, 312, 26, black, name[i]);
        sprintf(caption, format[i / 2], spread(L, roughness[i], i < 2 ? shade_mirror(L, N) : N));
        label_center(&c, s.x, 350, 24, i < 2 ? brown : teal, caption);
    }
    return canvas_save(&c, argc, argv, "microfacets.ppm");
}
