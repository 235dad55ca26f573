/* grade.c - the grader of 04_attenuation; README.md says what to write.
   cc -O2 -I. examples/teaching/assignments/04_attenuation/grade.c my.c -lm -o grade && ./grade */
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

static void not_inverted(const float *in, float *out)
{
    out[0] = in[0] + in[1] * in[3] + in[2] * in[3] * in[3];
}
static void each_inverted(const float *in, float *out)
{
    out[0] = 1 / in[0] + 1 / (in[1] * in[3]) + 1 / (in[2] * in[3] * in[3]);
}
static void coefficient_squared(const float *in, float *out)
{
    out[0] = 1 / (in[0] + in[1] * in[3] + in[2] * in[3] * in[2] * in[3]);
}
static void at_most_one(const float *in, float *out)
{
    right(in, out);
    out[0] = fminf(out[0], 1);
}

static void other_order(const float *in, float *out)
{
    out[0] = 1 / (in[0] * in[3] * in[3] + in[1] * in[3] + in[2]);
}
static void doubled(const float *in, float *out)
{
    out[0] = 1 / (in[0] + in[1] * in[3] + in[2] * 2 * in[3]);
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
    .yours = yours,
    .right = right,
    .cases = { { "any coefficients", 4, any,
                 "Compute the sum a + b r + c r^2 first, in brackets, then divide 1 by it." },
               { "a = b = 0: one over r squared", 2, square,
                 "With a = b = 0 and c = 1 the sum is r^2 alone, and the answer 1 / r^2." },
               { "r = 0, where the lamp is", 2, at_the_lamp,
                 "Where r is 0 the sum is a alone, and the answer 1 / a." } },
    .mistakes = { { "squared_alone", squared_alone,
                    "This is 1 / r^2 whatever a, b and c are. The whole factor "
                    "is 1 / (a + b r + c r^2)." },
                  { "without_constant", without_constant,
                    "The coefficient a is missing: it keeps the light "
                    "finite near the lamp." },
                  { "not_squared", not_squared, "c belongs to the square of r, b to r itself." },
                  { "not_inverted", not_inverted,
                    "This grows with the distance: divide 1 by the sum." },
                  { "each_inverted", each_inverted,
                    "Only the sum is inverted: 1 / (a + b r + c r^2) is not 1/a + 1/(b r) + "
                    "1/(c r^2)." },
                  { "coefficient_squared", coefficient_squared,
                    "(c r)^2 squares c as well: only r is squared." },
                  { "other_order", other_order,
                    "The coefficients are in the other order: a stands alone, c before r^2." },
                  { "doubled", doubled, "r^2 is r times r; this has 2 r." },
                  { "at_most_one", at_most_one,
                    "The factor is above 1 where a + b r + c r^2 is below 1: near such a lamp "
                    "there is more light than at distance 1, and nothing cuts it." } },
    .place = place,
    .scale = 0.55f,
    .offset = 0,
    .picture_points = 2,
};

int main(int argc, char **argv) { return grade_main(&task, argc, argv); }
