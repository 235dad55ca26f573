/* grade.c - the grader of 02_mirror; README.md says what to write.
   cc -O2 -I. examples/assignments/02_mirror/grade.c my.c -lm -o grade && ./grade */
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
    .yours = GRADE_ANSWER,
    .right = right,
    .cases = { { "lamps in front", 5, any }, { "grazing lamps", 3, grazing } },
    .mistakes = { { "as_printed", as_printed,
                    "This points below the surface: L - 2 (N.L) N mirrors a vector "
                    "that arrives, and L points away; R is its negative." },
                  { "without_two", without_two,
                    "The way from L to R is twice the way from L to N: the factor "
                    "of 2 before (N.L) N is missing." } },
    .place = place,
    .scale = 0.5f,
    .offset = 0.5f,
    .picture_points = 2,
};

int main(int argc, char **argv) { return grade_main(&task, argc, argv); }
