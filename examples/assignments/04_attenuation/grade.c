/* grade.c - the grader of 04_attenuation; README.md says what to write.
   cc -O2 -I. examples/assignments/04_attenuation/grade.c my.c -lm -o grade && ./grade */
#define SHADE_IMPLEMENTATION
#include "shade.h"
#include "../grade.h"

float attenuation(float a, float b, float c, float r);

static void yours(const float *in, float *out) { out[0] = attenuation(in[0], in[1], in[2], in[3]); }
static void right(const float *in, float *out)
{
    out[0] = shade_attenuation(in[0], in[1], in[2], in[3]);
}
static void squared_alone(const float *in, float *out) { out[0] = 1 / (in[3] * in[3]); }
static void without_constant(const float *in, float *out)
{
    out[0] = 1 / (in[1] * in[3] + in[2] * in[3] * in[3]);
}
static void not_squared(const float *in, float *out)
{
    out[0] = 1 / (in[0] + (in[1] + in[2]) * in[3]);
}

static void any(float *in)
{
    in[0] = grade_between(0.2f, 2);
    in[1] = grade_between(0, 1);
    in[2] = grade_between(0, 1);
    in[3] = grade_between(0.1f, 20);
}
static void square(float *in)
{
    any(in);
    in[0] = in[1] = 0;
    in[2] = 1;
}
static void at_the_lamp(float *in)
{
    any(in);
    in[3] = 0;
}

static int place(float x, float y, float *in)
{
    in[0] = 0.6f;
    in[1] = 0.4f;
    in[2] = 3;
    in[3] = sqrtf(x * x + y * y);
    return 1;
}
static const grade_task task = {
    .name = "04_attenuation",
    .names = "a1 b1 c1 r1",
    .outputs = 1,
    .tolerance = 1e-5f,
    .yours = GRADE_ANSWER,
    .right = right,
    .cases = { { "any coefficients", 4, any },
               { "a = b = 0: one over r squared", 2, square },
               { "r = 0, where the lamp is", 2, at_the_lamp } },
    .mistakes = { { "squared_alone", squared_alone,
                    "This is 1 / r^2 whatever a, b and c are. The whole factor "
                    "is 1 / (a + b r + c r^2)." },
                  { "without_constant", without_constant,
                    "The coefficient a is missing: it keeps the light "
                    "finite near the lamp." },
                  { "not_squared", not_squared, "c belongs to the square of r, b to r itself." } },
    .place = place,
    .scale = 0.55f,
    .offset = 0,
    .picture_points = 2,
};

int main(int argc, char **argv) { return grade_main(&task, argc, argv); }
