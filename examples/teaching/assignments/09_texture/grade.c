/* grade.c - the grader of 09_texture; README.md says what to write.
   cc -O2 -I. examples/teaching/assignments/09_texture/grade.c my.c -lm -o grade && ./grade */
#define SHADE_IMPLEMENTATION
#include "shade.h"
#include "../grade.h"

shade_vec2 texture_at(const float w[3], const shade_vec2 uv[3], const float abc[3]);

static void yours(const float *in, float *out)
{
    shade_vec2 uv[3], got;
    memcpy(uv, in + 3, sizeof uv);
    got = texture_at(in, uv, in + 9);
    out[0] = got.x;
    out[1] = got.y;
}
/* Weights of the corners are abc / w, divided by their sum where divided is set. */
static void weighted(const float *in, float *out, int over_w, int divided)
{
    double u = 0, v = 0, sum = 0;
    for (int k = 0; k < 3; k++) {
        const double weight = (double)in[9 + k] / (over_w ? (double)in[k] : 1);
        u += weight * (double)in[3 + 2 * k];
        v += weight * (double)in[4 + 2 * k];
        sum += weight;
    }
    out[0] = (float)(divided ? u / sum : u);
    out[1] = (float)(divided ? v / sum : v);
}
static void right(const float *in, float *out) { weighted(in, out, 1, 1); }
static void affine(const float *in, float *out) { weighted(in, out, 0, 0); }
static void not_divided(const float *in, float *out) { weighted(in, out, 1, 0); }
static void times_w(const float *in, float *out)
{
    float other[GRADE_IN];
    memcpy(other, in, sizeof other);
    for (int k = 0; k < 3; k++) other[k] = 1 / in[k];
    right(other, out);
}

/* u/w and v/w times the mean of w, which is not linear on the screen */
static void times_mean_w(const float *in, float *out)
{
    float w = 0;
    for (int k = 0; k < 3; k++) w += in[9 + k] * in[k];
    not_divided(in, out);
    out[0] *= w;
    out[1] *= w;
}
/* The sums divided by the mean of w */
static void over_mean_w(const float *in, float *out)
{
    float w = 0;
    for (int k = 0; k < 3; k++) w += in[9 + k] * in[k];
    not_divided(in, out);
    out[0] /= w;
    out[1] /= w;
}
static void nearest_corner(const float *in, float *out)
{
    int best = 0;
    for (int k = 1; k < 3; k++)
        if (in[9 + k] > in[9 + best]) best = k;
    out[0] = in[3 + 2 * best];
    out[1] = in[4 + 2 * best];
}
static void v_up(const float *in, float *out)
{
    right(in, out);
    out[1] = 1 - out[1];
}

static void inputs(float *in, float far)
{
    for (int k = 0; k < 3; k++) in[k] = grade_between(1, far);
    for (int k = 0; k < 6; k++) in[3 + k] = grade_between(0, 1);
    in[9] = grade_between(0, 1);
    in[10] = grade_between(0, 1 - in[9]);
    in[11] = 1 - in[9] - in[10];
}
static void tilted(float *in) { inputs(in, 10); }
static void facing(float *in)
{
    inputs(in, 1);
    in[0] = in[1] = in[2] = grade_between(0.5f, 4);
}

static int place(float x, float y, float *in)
{
    const float at[9] = { 1, 1, 5, 0, 0, 1, 0, 0.5f, 1 };
    memcpy(in, at, sizeof at);
    in[11] = (y + 1) / 2;
    in[10] = (1 - in[11]) * (x + 1) / 2;
    in[9] = 1 - in[10] - in[11];
    return 1;
}
static const grade_task task = {
    .name = "09_texture",
    .names = "w3 uv6 abc3",
    .outputs = 2,
    .tolerance = 5e-6f,
    .yours = yours,
    .right = right,
    .cases = { { "triangles that tilt away", 6, tilted,
                 "Mix u/w, v/w and 1/w by abc, each by itself, then divide the first two by "
                 "the third." },
               { "triangles that face the eye", 2, facing,
                 "Where all w are the same they cancel: u and v are mixed by abc." } },
    .mistakes = { { "affine", affine,
                    "This is linear on the screen, so textures swim where a triangle tilts: "
                    "interpolate u/w, v/w and 1/w, then divide." },
                  { "not_divided", not_divided,
                    "u/w and v/w are interpolated, but not divided by the "
                    "interpolated 1/w." },
                  { "times_w", times_w,
                    "The corners are multiplied by w where they should be divided." },
                  { "times_mean_w", times_mean_w,
                    "w is not linear on the screen, 1/w is: interpolate 1/w and divide by it, "
                    "rather than multiply by an interpolated w." },
                  { "over_mean_w", over_mean_w,
                    "u/w and v/w are divided by an interpolated w; they must be divided by the "
                    "interpolated 1/w." },
                  { "nearest_corner", nearest_corner,
                    "This is the texture coordinate of one corner: mix all three." },
                  { "v_up", v_up,
                    "v is turned upside down: which way pictures lie is no matter of "
                    "interpolation." } },
    .place = place,
    .scale = 1,
    .offset = 0,
    .picture_points = 2,
};

int main(int argc, char **argv) { return grade_main(&task, argc, argv); }
