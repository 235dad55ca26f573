/* 41_beam.c - why Lambert's law has a cosine (UW, Massey, Shirley, Berkeley).  A beam of width 1
   meets a surface whose normal N is theta away from it.  It spreads over a length of 1/cos theta,
   so each point gets the share cos theta = N.L of its light.  The length is measured between the
   rims of the beam, the light is what shade_lit finds on a white surface: their product is 1.
   Try 60 for 45: half the light at each point, on twice the width.

   cc -O2 -I. examples/lessons/41_beam.c -lm -o beam && ./beam                    writes beam.ppm */
#define SHADE_IMPLEMENTATION
#include "shade.h"
#include "../shared/sketch.h"

enum { PANELS = 3, UNIT = 78 };
static const shade_vec3 black = { 0.02f, 0.02f, 0.02f }, pale = { 0.8f, 0.8f, 0.78f },
                        amber = { 0.9f, 0.55f, 0.05f };

/* Where the ray through P that travels along -L meets the surface y = 0 */
static shade_vec3 landing(shade_vec3 P, shade_vec3 L)
{
    return shade_madd(P, -P.y / L.y, L);
}

/* The light of a point of a white surface, by the equation */
static float light_of(shade_vec3 N, shade_vec3 L)
{
    const shade_light lamp = shade_directional_light(shade_neg(L), shade_v3(1, 1, 1));
    const shade_lighting lighting = { .lights = &lamp, .light_count = 1 };
    return shade_lit(&lighting, NULL, N, shade_v3(0, 0, 0), N).x;
}

static void panel(const canvas *c, int i, float theta)
{
    const shade_vec3 N = { 0, 1, 0 }, L = sketch_direction(-theta), across = { L.y, -L.x, 0 };
    const shade_vec3 far_end = shade_scale(L, 3.6f), origin = { 0, 0, 0 };
    /* a beam of width 1: its rims are half of it to each side */
    const shade_vec3 begin = landing(shade_madd(far_end, -0.5f, across), L);
    const shade_vec3 end = landing(shade_madd(far_end, 0.5f, across), L);
    const float light = light_of(N, L), length = shade_distance(begin, end);

    /* all that follows draws this */
    const int middle = 180 + 310 * i;
    sketch s = sketch_new(c, middle, 330, UNIT);
    sketch_ink(&s, shade_v3(1, 0.86f, 0.42f), UNIT);
    s.pen.cap = SHADE_CAP_BUTT;
    sketch_line(&s, shade_scale(L, -1.5f), far_end);
    canvas_fill(&c->target, 3 * (middle - 145), 3 * 330, 3 * 290, 3 * 130,
                shade_v3(0.05f, 0.05f, 0.06f));
    s.pen.cap = SHADE_CAP_SQUARE;
    sketch_ink(&s, amber, 2);
    for (int k = -2; k <= 2; k++) {
        shade_vec3 from = shade_madd(far_end, 0.25f * (float)k, across);
        sketch_arrow(&s, from, landing(from, L));
    }
    sketch_ink(&s, black, 2);
    sketch_line(&s, shade_madd(far_end, -0.5f, across), shade_madd(far_end, 0.5f, across));
    sketch_name(&s, shade_scale(L, 3.9f), 32, "1");
    sketch_arrow(&s, origin, shade_scale(N, 2));
    sketch_name(&s, shade_v3(theta > 0 ? 0.26f : 0.7f, 2, 0), 34, "N");
    sketch_arc(&s, origin, 1.4f, -theta, 0);
    if (theta > 0) sketch_name(&s, shade_scale(sketch_direction(-theta / 2), 1.68f), 34, "θ");
    sketch_ink(&s, shade_scale(shade_v3(1, 0.95f, 0.85f), light), 12);
    s.pen.cap = SHADE_CAP_BUTT;
    sketch_line(&s, shade_madd(begin, -0.09f, N), shade_madd(end, -0.09f, N));
    label_print(c, middle - 120, 385, 22, pale, "θ = %g°, N·L = %.3f", (double)theta,
                (double)light);
    label_print(c, middle - 120, 413, 22, pale, "width 1/cos θ = %.3f", (double)length);
    label_print(c, middle - 120, 441, 22, pale, "light × width = %.3f", (double)(light * length));
}

int main(int argc, char **argv)
{
    static const float theta[PANELS] = { 0, 45, 70 };
    canvas c = canvas_new(960, 480, 3);
    sketch_paper(&c);
    for (int i = 0; i < PANELS; i++) panel(&c, i, theta[i]);
    return canvas_save(&c, argc, argv, "beam.ppm");
}
