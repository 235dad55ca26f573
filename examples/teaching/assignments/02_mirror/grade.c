/* grade.c - the grader of 02_mirror; README.md says what to write.
   cc -O2 -I. examples/teaching/assignments/02_mirror/grade.c my.c -lm -o grade && ./grade */
#define SHADE_IMPLEMENTATION
#include "shade.h"
#include "../grade.h"

shade_vec3 mirror(shade_vec3 L, shade_vec3 N);

static void yours(const float *in, float *out)
{
    grade_put(out, mirror(grade_vec(in), grade_vec(in + 3)));
}
static void right(const float *in, float *out)
{
    grade_put(out, shade_mirror(grade_vec(in), grade_vec(in + 3)));
}
static void as_printed(const float *in, float *out)
{
    grade_put(out, shade_neg(shade_mirror(grade_vec(in), grade_vec(in + 3))));
}
static void without_two(const float *in, float *out)
{
    const shade_vec3 L = grade_vec(in), N = grade_vec(in + 3);
    grade_put(out, shade_sub(shade_scale(N, shade_dot(L, N)), L));
}

static void plus(const float *in, float *out)
{
    const shade_vec3 L = grade_vec(in), N = grade_vec(in + 3);
    grade_put(out, shade_madd(L, 2 * shade_dot(L, N), N));
}
static void exchanged(const float *in, float *out)
{
    grade_put(out, shade_mirror(grade_vec(in + 3), grade_vec(in)));
}
static void no_cosine(const float *in, float *out)
{
    grade_put(out, shade_sub(shade_scale(grade_vec(in + 3), 2), grade_vec(in)));
}
static void half(const float *in, float *out)
{
    grade_put(out, shade_halfway(grade_vec(in), grade_vec(in + 3)));
}
static void negated(const float *in, float *out) { grade_put(out, shade_neg(grade_vec(in))); }

static void any(float *in)
{
    const shade_vec3 N = grade_direction();
    grade_put(in, grade_beside(N, 1));
    grade_put(in + 3, N);
}
static void grazing(float *in)
{
    const shade_vec3 N = grade_direction(), along = shade_cross(N, grade_direction());
    grade_put(in, shade_normalize(shade_madd(along, 0.05f * shade_length(along), N)));
    grade_put(in + 3, N);
}

static int place(float x, float y, float *in)
{
    shade_vec3 N;
    if (!grade_ball(x, y, &N)) return 0;
    grade_put(in, shade_v3(-0.6f, 0.64f, 0.48f));
    grade_put(in + 3, N);
    return 1;
}

static const grade_task task = {
    .name = "02_mirror",
    .names = "L3 N3",
    .outputs = 3,
    .tolerance = 1e-5f,
    .yours = yours,
    .right = right,
    .cases = { { "lamps in front", 5, any,
                 "The part of L along N is (N.L) N; the mirror keeps it and turns what is "
                 "left over, L - (N.L) N." }, { "grazing lamps", 3, grazing,
                 "With the lamp near the horizon L and R are almost opposite: R is 2 (N.L) N "
                 "- L, of unit length without a normalize." } },
    .mistakes = { { "as_printed", as_printed,
                    "This points below the surface: L - 2 (N.L) N mirrors a vector "
                    "that arrives, and L points away; R is its negative." },
                  { "without_two", without_two,
                    "The way from L to R is twice the way from L to N: the factor "
                    "of 2 before (N.L) N is missing." },
                  { "plus", plus,
                    "L and R lie on the two sides of N and add up to 2 (N.L) N: L is subtracted "
                    "from it, not added." },
                  { "exchanged", exchanged,
                    "This mirrors N at L: the function takes L first, then N, and N is what L "
                    "is mirrored at." },
                  { "no_cosine", no_cosine,
                    "2 N - L takes all of N: what mirrors L is its part along N, which is "
                    "N.L long." },
                  { "half", half,
                    "This is halfway between L and N. It is N that lies halfway, between L "
                    "and R." },
                  { "negated", negated,
                    "This sends the light on along its way, through the surface: a mirror turns "
                    "only the part along N, (N.L) N." } },
    .place = place,
    .scale = 0.5f,
    .offset = 0.5f,
    .picture_points = 2,
};

int main(int argc, char **argv) { return grade_main(&task, argc, argv); }
