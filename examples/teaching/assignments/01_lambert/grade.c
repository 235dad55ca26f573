/* grade.c - the grader of 01_lambert; README.md says what to write.
   cc -O2 -I. examples/teaching/assignments/01_lambert/grade.c my.c -lm -o grade && ./grade */
#define SHADE_IMPLEMENTATION
#include "shade.h"
#include "../grade.h"

float lambert(shade_vec3 N, shade_vec3 L);

static void yours(const float *in, float *out)
{
    out[0] = lambert(grade_vec(in), grade_vec(in + 3));
}
static void right(const float *in, float *out)
{
    out[0] = shade_lambert(grade_vec(in), grade_vec(in + 3));
}
static void unclamped(const float *in, float *out)
{
    out[0] = shade_dot(grade_vec(in), grade_vec(in + 3));
}
static void absolute(const float *in, float *out)
{
    out[0] = fabsf(shade_dot(grade_vec(in), grade_vec(in + 3)));
}

static void reversed(const float *in, float *out)
{
    out[0] = fmaxf(0, -shade_dot(grade_vec(in), grade_vec(in + 3)));
}
static void angle(const float *in, float *out)
{
    out[0] = acosf(shade_dot(grade_vec(in), grade_vec(in + 3)));
}
static void half(const float *in, float *out)
{
    out[0] = 0.5f + 0.5f * shade_dot(grade_vec(in), grade_vec(in + 3));
}

static void lamp(float *in, float side)
{
    const shade_vec3 N = grade_direction();
    grade_put(in, N);
    grade_put(in + 3, grade_beside(N, side));
}
static void in_front(float *in) { lamp(in, 1); }
static void behind(float *in) { lamp(in, -1); }

static int place(float x, float y, float *in)
{
    shade_vec3 N;
    if (!grade_ball(x, y, &N)) return 0;
    grade_put(in, N);
    grade_put(in + 3, shade_v3(-0.6f, 0.64f, 0.48f));
    return 1;
}

static const grade_task task = {
    .name = "01_lambert",
    .names = "N3 L3",
    .outputs = 1,
    .tolerance = 1e-5f,
    .yours = yours,
    .right = right,
    .cases = { { "a lamp in front of the surface", 4, in_front,
                 "Where the lamp is in front the answer is N.L, the sum of the products of "
                 "the coordinates, and nothing else: no root, no angle, no least light." },
               { "a lamp behind the surface", 4, behind,
                 "Where the lamp is behind, N.L is negative, and the answer is exactly 0." } },
    .mistakes = { { "unclamped", unclamped,
                    "A lamp behind the surface cannot take light away: where N.L is "
                    "negative the answer is 0." },
                  { "absolute", absolute,
                    "The absolute value lights the side away from the lamp too: where "
                    "N.L is negative the answer is 0." },
                  { "reversed", reversed,
                    "This lights the side away from the lamp: L points to the lamp already, so "
                    "its sign stays." },
                  { "angle", angle,
                    "This is the angle between N and L. The light falls with its cosine, which "
                    "is N.L as it is." },
                  { "half", half,
                    "(1 + N.L) / 2 is a tone that reaches all around the surface. Light that "
                    "arrives is N.L, and 0 where that is negative." } },
    .place = place,
    .scale = 0.9f,
    .offset = 0.05f,
    .picture_points = 2,
};

int main(int argc, char **argv) { return grade_main(&task, argc, argv); }
