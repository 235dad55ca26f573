/* grade.c - the grader of 03_highlight; README.md says what to write.
   cc -O2 -I. examples/teaching/assignments/03_highlight/grade.c my.c -lm -o grade && ./grade */
#define SHADE_IMPLEMENTATION
#include "shade.h"
#include "../grade.h"

shade_vec3 halfway(shade_vec3 L, shade_vec3 V);
float phong(shade_vec3 N, shade_vec3 L, shade_vec3 V, float n);

/* N, L, V, n; H first, then the lobe */
static void yours(const float *in, float *out)
{
    const shade_vec3 N = grade_vec(in), L = grade_vec(in + 3), V = grade_vec(in + 6);
    grade_put(out, halfway(L, V));
    out[3] = phong(N, L, V, in[9]);
}
static void answer(const float *in, float *out, shade_vec3 H, float lobe)
{
    (void)in;
    grade_put(out, H);
    out[3] = lobe;
}
static void right(const float *in, float *out)
{
    const shade_vec3 N = grade_vec(in), L = grade_vec(in + 3), V = grade_vec(in + 6);
    answer(in, out, shade_halfway(L, V), shade_phong_specular(N, L, V, in[9]));
}
static void not_unit(const float *in, float *out)
{
    right(in, out);
    grade_put(out, shade_scale(shade_add(grade_vec(in + 3), grade_vec(in + 6)), 0.5f));
}
static void ungated(const float *in, float *out)
{
    const shade_vec3 N = grade_vec(in), L = grade_vec(in + 3), V = grade_vec(in + 6);
    const float c = shade_dot(shade_mirror(L, N), V);
    right(in, out);
    out[3] = powf(fmaxf(c, 0), in[9]);
}
static void blinn(const float *in, float *out)
{
    right(in, out);
    out[3] = shade_blinn_phong_specular(grade_vec(in), grade_vec(in + 3), grade_vec(in + 6), in[9]);
}

static void no_power(const float *in, float *out)
{
    const shade_vec3 N = grade_vec(in), L = grade_vec(in + 3), V = grade_vec(in + 6);
    right(in, out);
    out[3] = shade_phong_specular(N, L, V, 1);
}
static void arriving(const float *in, float *out)
{
    const shade_vec3 N = grade_vec(in), L = grade_vec(in + 3), V = grade_vec(in + 6);
    right(in, out);
    out[3] = shade_phong_specular(N, L, shade_neg(V), in[9]);
}
static void unchecked(const float *in, float *out)
{
    const shade_vec3 sum = shade_add(grade_vec(in + 3), grade_vec(in + 6));
    const float length = sqrtf(shade_dot(sum, sum));
    right(in, out);
    grade_put(out, shade_v3(sum.x / length, sum.y / length, sum.z / length));
}
static void unclamped(const float *in, float *out)
{
    const shade_vec3 N = grade_vec(in), L = grade_vec(in + 3), V = grade_vec(in + 6);
    const float c = shade_dot(shade_mirror(L, N), V);
    right(in, out);
    if (shade_dot(N, L) > 0) out[3] = powf(c, in[9]);
}

static void scene(float *in, float side)
{
    const shade_vec3 N = grade_direction(), L = grade_beside(N, side);
    const shade_vec3 R = shade_mirror(L, N);
    grade_put(in, N);
    grade_put(in + 3, L);
    grade_put(in + 6, shade_normalize(shade_madd(R, 0.4f, grade_direction())));
    in[9] = grade_between(1, 40);
}
static void in_front(float *in) { scene(in, 1); }
static void behind(float *in)
{
    scene(in, -1);
    in[9] = grade_between(1, 4);
}
static void far_from_R(float *in)
{
    scene(in, 1);
    const shade_vec3 R = shade_mirror(grade_vec(in + 3), grade_vec(in));
    grade_put(in + 6, grade_beside(R, -1));
}
static void opposite(float *in)
{
    scene(in, 1);
    for (int k = 0; k < 3; k++) in[6 + k] = -in[3 + k];
}

static int place(float x, float y, float *in)
{
    shade_vec3 N;
    if (!grade_ball(x, y, &N)) return 0;
    grade_put(in, N);
    grade_put(in + 3, shade_v3(-0.48f, 0.6f, 0.64f));
    grade_put(in + 6, shade_v3(0, 0, 1));
    in[9] = 12;
    return 1;
}
static const grade_task task = {
    .name = "03_highlight",
    .names = "N3 L3 V3 n1",
    .parts = "H3 lobe1",
    .outputs = 4,
    .tolerance = 2e-5f,
    .yours = yours,
    .right = right,
    .cases = { { "lamps in front", 3, in_front,
                 "H is L + V made unit. The lobe is (R.V)^n with R = 2 (N.L) N - L; look at "
                 "each by itself." },
               { "viewers far from R, where R.V is negative", 1, far_from_R,
                 "A viewer more than 90 degrees off R sees no highlight: the lobe is 0." },
               { "lamps behind", 2, behind,
                 "B is 0 where N.L is not above 0, and so is the lobe. H is as everywhere." },
               { "L = -V, where H has no direction and is zero", 2, opposite,
                 "Where L = -V the sum is zero: return the zero vector, before you divide by "
                 "its length. The lobe is as everywhere." } },
    .mistakes = { { "not_unit", not_unit,
                    "H is not of unit length: (L + V) / 2 is shorter than 1 unless L "
                    "and V are equal. Normalize the sum." },
                  { "ungated", ungated,
                    "A highlight shines where the lamp is behind the surface: B is missing, "
                    "which is 0 where N.L is not above 0." },
                  { "blinn", blinn,
                    "This is the lobe of Blinn, (N.H)^n. Phong's is (R.V)^n; it is narrower "
                    "for the same n." },
                  { "no_power", no_power,
                    "This is R.V itself: raise it to the power n, which makes the highlight "
                    "small." },
                  { "arriving", arriving,
                    "R points below the surface, so that the viewer sees the highlight where "
                    "there is none: R = 2 (N.L) N - L." },
                  { "unchecked", unchecked,
                    "L + V is zero where L = -V, and a zero vector cannot be divided by its "
                    "length: ask for that first." },
                  { "unclamped", unclamped,
                    "R.V is negative where the viewer is more than 90 degrees off R, and "
                    "powf of a negative number is a NaN or, for an even n, a second "
                    "highlight: take 0 there." } },
    .place = place,
    .shown = 3,
    .scale = 0.8f,
    .offset = 0.1f,
    .picture_points = 2,
};

int main(int argc, char **argv) { return grade_main(&task, argc, argv); }
