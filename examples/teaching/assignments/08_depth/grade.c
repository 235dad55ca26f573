/* grade.c - the grader of 08_depth; README.md says what to write.
   cc -O2 -I. examples/teaching/assignments/08_depth/grade.c my.c -lm -o grade && ./grade */
#define SHADE_IMPLEMENTATION
#include "shade.h"
#include "../grade.h"

float depth_at(const float w[3], const float z[3], const float abc[3]);

/* The depth of a pixel by a whole draw of shade.h would be rounded to its corners; so right is the
   definition, in double: z/w is linear on the screen. */
static void by_screen(const float *in, float *out)
{
    double sum = 0;
    for (int k = 0; k < 3; k++) sum += (double)in[6 + k] * (double)in[3 + k] / (double)in[k];
    out[0] = (float)(0.5 * sum + 0.5);
}
static void perspective(const float *in, float *out)
{
    double z = 0, w = 0;
    for (int k = 0; k < 3; k++) {
        z += (double)in[6 + k] * (double)in[3 + k] / (double)in[k];
        w += (double)in[6 + k] / (double)in[k];
    }
    out[0] = (float)(0.5 * z / w + 0.5);
}
static void not_divided(const float *in, float *out)
{
    double z = 0;
    for (int k = 0; k < 3; k++) z += (double)in[6 + k] * (double)in[3 + k];
    out[0] = (float)(0.5 * z + 0.5);
}
static void minus_to_plus(const float *in, float *out)
{
    by_screen(in, out);
    out[0] = 2 * out[0] - 1;
}
static void divided_after(const float *in, float *out)
{
    double z = 0, w = 0;
    for (int k = 0; k < 3; k++) {
        z += (double)in[6 + k] * (double)in[3 + k];
        w += (double)in[6 + k] * (double)in[k];
    }
    out[0] = (float)(0.5 * z / w + 0.5);
}
static void reversed(const float *in, float *out)
{
    by_screen(in, out);
    out[0] = 1 - out[0];
}
static void undivided_unmapped(const float *in, float *out)
{
    out[0] = in[6] * in[3] + in[7] * in[4] + in[8] * in[5];
}
static void centre(const float *in, float *out)
{
    double sum = 0;
    for (int k = 0; k < 3; k++) sum += (double)in[3 + k] / (double)in[k] / 3;
    out[0] = (float)(0.5 * sum + 0.5);
}
static void half_alone(const float *in, float *out)
{
    by_screen(in, out);
    out[0] -= 0.5f;
}
static void yours(const float *in, float *out) { out[0] = depth_at(in, in + 3, in + 6); }

static void weights(float *in)
{
    in[6] = grade_between(0, 1);
    in[7] = grade_between(0, 1 - in[6]);
    in[8] = 1 - in[6] - in[7];
}
static void tilted(float *in)
{
    for (int k = 0; k < 3; k++) {
        in[k] = grade_between(0.5f, 8);
        in[3 + k] = in[k] * grade_between(-1, 1);
    }
    weights(in);
}
static void facing(float *in)
{
    in[0] = in[1] = in[2] = 1;
    for (int k = 0; k < 3; k++) in[3 + k] = grade_between(-1, 1);
    weights(in);
}

static int place(float x, float y, float *in)
{
    const float at[6] = { 1, 1, 6, -1, -0.6f, 5.7f };
    memcpy(in, at, sizeof at);
    in[6] = (1 - x) / 2;
    in[7] = (1 - y) / 2 * (1 - in[6]);
    in[8] = 1 - in[6] - in[7];
    return 1;
}
static const grade_task task = {
    .name = "08_depth",
    .names = "w3 z3 abc3",
    .outputs = 1,
    .tolerance = 2e-6f,
    .yours = yours,
    .right = by_screen,
    .cases = { { "triangles that tilt away", 5, tilted,
                 "Divide z by w at each corner, mix the three quotients by abc, then bring "
                 "-1 .. 1 to 0 .. 1." },
               { "triangles that face the eye", 3, facing,
                 "With w = 1 everywhere z / w is z: mix the three by abc, then bring -1 .. 1 "
                 "to 0 .. 1." } },
    .mistakes = { { "perspective", perspective,
                    "Window depth z/w is linear on the screen already: dividing by "
                    "the interpolated 1/w is for texture coordinates and colours." },
                  { "not_divided", not_divided,
                    "z is interpolated before its division: divide z by w at each "
                    "corner first." },
                  { "minus_to_plus", minus_to_plus,
                    "This runs from -1 to 1, as clip space does: the window "
                    "has 0 near and 1 far, (z/w + 1) / 2." },
                  { "divided_after", divided_after,
                    "z and w are interpolated and then divided: neither is linear on the "
                    "screen, only their quotient at the corners is." },
                  { "reversed", reversed,
                    "This is 1 near and 0 far; the window has it the other way." },
                  { "undivided_unmapped", undivided_unmapped,
                    "This mixes z of clip space: divide by w at each corner, and bring "
                    "-1 .. 1 to 0 .. 1." },
                  { "centre", centre,
                    "This is the same all over the triangle: the weights of the corners are "
                    "abc." },
                  { "half_alone", half_alone,
                    "z/w / 2 runs from -1/2 to 1/2: add 1/2." } },
    .place = place,
    .scale = 1,
    .offset = 0,
    .picture_points = 2,
};

int main(int argc, char **argv) { return grade_main(&task, argc, argv); }
