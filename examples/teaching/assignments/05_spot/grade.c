/* grade.c - the grader of 05_spot; README.md says what to write.
   cc -O2 -I. examples/teaching/assignments/05_spot/grade.c my.c -lm -o grade && ./grade */
#define SHADE_IMPLEMENTATION
#include "shade.h"
#include "../grade.h"

float spot(shade_vec3 L, shade_vec3 aim, float cos_cutoff, float e);

static void yours(const float *in, float *out)
{
    out[0] = spot(grade_vec(in), grade_vec(in + 3), in[6], in[7]);
}
static void right(const float *in, float *out)
{
    out[0] = shade_spot(grade_vec(in), grade_vec(in + 3), in[6], in[7]);
}
static void wrong_way(const float *in, float *out)
{
    out[0] = shade_spot(grade_vec(in), shade_neg(grade_vec(in + 3)), in[6], in[7]);
}
static void no_cutoff(const float *in, float *out)
{
    out[0] = shade_spot(grade_vec(in), grade_vec(in + 3), 0, in[7]);
}
static void exclusive(const float *in, float *out)
{
    const float c = -shade_dot(grade_vec(in), grade_vec(in + 3));
    if (c > in[6]) right(in, out);
}
static void no_exponent(const float *in, float *out)
{
    out[0] = shade_spot(grade_vec(in), grade_vec(in + 3), in[6], 0);
}

static void times_e(const float *in, float *out)
{
    out[0] = in[7] * shade_spot(grade_vec(in), grade_vec(in + 3), in[6], 1);
}
static void inverted(const float *in, float *out)
{
    const float c = -shade_dot(grade_vec(in), grade_vec(in + 3));
    if (c < in[6]) out[0] = shade_spot(grade_vec(in), grade_vec(in + 3), 0, in[7]);
}
static void exchanged_power(const float *in, float *out)
{
    const float c = -shade_dot(grade_vec(in), grade_vec(in + 3));
    if (c >= in[6]) out[0] = powf(in[7], c);
}
static void faded_to_rim(const float *in, float *out)
{
    const float c = -shade_dot(grade_vec(in), grade_vec(in + 3));
    if (c >= in[6]) out[0] = powf((c - in[6]) / (1 - in[6]), in[7]);
}
static void cut_after_power(const float *in, float *out)
{
    const float power = shade_spot(grade_vec(in), grade_vec(in + 3), 0, in[7]);
    out[0] = power >= in[6] ? power : 0;
}

/* L is off the axis by an angle from low to high times the cutoff. */
static void beam(float *in, float low, float high)
{
    const shade_vec3 aim = grade_direction();
    const shade_vec3 side = shade_normalize(shade_cross(aim, grade_direction()));
    const float cutoff = grade_between(0.2f, 0.7f), off = cutoff * grade_between(low, high);
    grade_put(in, shade_neg(shade_add(shade_scale(aim, cosf(off)), shade_scale(side, sinf(off)))));
    grade_put(in + 3, aim);
    in[6] = cosf(cutoff);
    in[7] = grade_between(0, 30);
}
static void inside(float *in) { beam(in, 0, 0.95f); }
static void outside(float *in) { beam(in, 1.05f, 2); }
/* Along an axis of space -L.aim is the cosine to the bit. */
static void rim(float *in)
{
    in[0] = -0.6f;
    in[1] = 0.8f;
    in[3] = 1;
    in[6] = 0.6f;
    in[7] = grade_between(0, 8);
}

static int place(float x, float y, float *in)
{
    grade_put(in, shade_normalize(shade_v3(-x, -y, 1.6f)));
    grade_put(in + 3, shade_v3(0, 0, -1));
    in[6] = 0.9f;
    in[7] = 12;
    return fabsf(in[2] - 0.9f) > 1e-5f;
}
static const grade_task task = {
    .name = "05_spot",
    .names = "L3 aim3 cos_cutoff1 e1",
    .outputs = 1,
    .tolerance = 2e-5f,
    .yours = yours,
    .right = right,
    .cases = { { "inside the cone", 4, inside,
                 "Inside the cone the answer is (L.S)^e with S = -aim, whatever the cutoff "
                 "is." },
               { "outside", 2, outside,
                 "Where L.S is below cos_cutoff the answer is 0. Both are cosines: compare "
                 "them as they are." },
               { "on the rim, which is lit", 2, rim,
                 "On the rim L.S equals cos_cutoff, to the bit for these inputs, and the rim "
                 "is lit." } },
    .mistakes = { { "wrong_way", wrong_way,
                    "L points to the lamp and aim away from it: the cosine off the "
                    "axis is that between L and -aim." },
                  { "no_cutoff", no_cutoff,
                    "The cone is not cut: where the cosine is below cos_cutoff the "
                    "answer is 0." },
                  { "exclusive", exclusive, "The rim itself is lit: compare with >=, not with >." },
                  { "no_exponent", no_exponent,
                    "The light is as strong everywhere in the cone: raise the "
                    "cosine to the power e." },
                  { "times_e", times_e, "e is an exponent: (L.S)^e, not e times L.S." },
                  { "inverted", inverted,
                    "The light is outside of the cone: a small angle has a large cosine, so "
                    "inside is where L.S is at least cos_cutoff." },
                  { "exchanged_power", exchanged_power,
                    "This is e to the power L.S: exchange the two." },
                  { "faded_to_rim", faded_to_rim,
                    "This fades to 0 at the rim. In the notes' spotlight the cutoff only cuts, "
                    "and what falls off is (L.S)^e." },
                  { "cut_after_power", cut_after_power,
                    "The power is compared with cos_cutoff: compare L.S itself, before it is "
                    "raised to e." } },
    .place = place,
    .scale = 1,
    .offset = 0,
    .picture_points = 2,
};

int main(int argc, char **argv) { return grade_main(&task, argc, argv); }
