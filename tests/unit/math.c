/* math.c - vectors, against double precision and by their laws; shade_power against pow. */
#include "unit.h"

#define EPS 6e-8 /* half a unit in the last place of a float near 1 */

/* Tolerances grow with the number of roundings of an operation and with the size of its vectors. */
TEST(math, componentwise_operations_round_once)
{
    for (int i = 0; i < 2000; i++) {
        double size = (double)rnd_log(1e-3, 1e6), eps = 2 * EPS * size;
        shade_vec3 a = random_vector(size), b = random_vector(size);
        d3 A = d3_from(a), B = d3_from(b);
        float t = rnd_float(-2, 2);
        CHECK_VEC(shade_add(a, b), d3_add(A, B), eps);
        CHECK_VEC(shade_sub(a, b), d3_sub(A, B), eps);
        CHECK_VEC(shade_mul(a, b), d3_mul(A, B), eps * size);
        CHECK_VEC(shade_scale(a, t), d3_scale(A, (double)t), 2 * eps);
        CHECK_VEC(shade_madd(a, t, b), d3_add(A, d3_scale(B, (double)t)), 6 * eps);
        CHECK_VEC(shade_neg(a), d3_scale(A, -1), 0);
        CHECK_VEC(shade_lerp(a, b, t), d3_add(A, d3_scale(d3_sub(B, A), (double)t)), 12 * eps);
        CHECK_VEC(shade_lerp(a, b, 0), A, 0);
        CHECK_VEC(shade_lerp(a, b, 1), B, 4 * eps);
        CHECK_VEC(shade_min(a, b), d3_of(fmin(A.x, B.x), fmin(A.y, B.y), fmin(A.z, B.z)), 0);
        CHECK_VEC(shade_max(a, b), d3_of(fmax(A.x, B.x), fmax(A.y, B.y), fmax(A.z, B.z)), 0);
    }
}

TEST(math, products_of_vectors_match_double)
{
    for (int i = 0; i < 2000; i++) {
        double size = (double)rnd_log(1e-3, 1e6);
        shade_vec3 a = random_vector(size), b = random_vector(size);
        d3 A = d3_from(a), B = d3_from(b);
        double within = 4 * EPS * d3_length(A) * d3_length(B);
        CHECK_NEAR(shade_dot(a, b), d3_dot(A, B), within);
        CHECK_VEC(shade_cross(a, b), d3_cross(A, B), within);
        CHECK_NEAR(shade_length(a), d3_length(A), 4 * EPS * d3_length(A));
        CHECK_NEAR(shade_distance(a, b), d3_length(d3_sub(A, B)), 8 * EPS * size);
    }
    CHECK_VEC(shade_cross(shade_v3(1, 0, 0), shade_v3(0, 1, 0)), d3_of(0, 0, 1), 0);
}

TEST(math, clamp_holds_both_bounds_and_sends_nan_to_the_upper)
{
    shade_vec3 lo = shade_v3(-1, 0, 2), hi = shade_v3(1, 0.5f, 3);
    CHECK_VEC(shade_clamp(shade_v3(-5, 0.25f, 9), lo, hi), d3_of(-1, 0.25, 3), 0);
    CHECK_VEC(shade_clamp(shade_v3(5, -0.25f, 2.5f), lo, hi), d3_of(1, 0, 2.5), 0);
    CHECK_VEC(shade_clamp(shade_v3((float)NAN, (float)NAN, (float)NAN), lo, hi), d3_of(1, 0.5, 3),
              0);
}

/* G3 */
TEST(math, normalize_gives_unit_length_or_exactly_zero)
{
    for (int i = 0; i < 4000; i++) {
        double size = (double)rnd_log(1e-16, 1e12);
        d3 v = d3_scale(rnd_direction(), size);
        CHECK_VEC(shade_normalize(d3_round(v)), d3_unit(v), 4 * EPS);
    }
    CHECK_VEC(shade_normalize(shade_v3(0, 0, 0)), d3_of(0, 0, 0), 0);
    CHECK_VEC(shade_normalize(shade_v3(9e-19f, 0, 0)), d3_of(0, 0, 0), 0);
    CHECK_VEC(shade_normalize(shade_v3(0, -1e-30f, 1e-40f)), d3_of(0, 0, 0), 0);
    CHECK_VEC(shade_normalize(shade_v3(0, 2e-18f, 0)), d3_of(0, 1, 0), 4 * EPS);
}

TEST(math, reflect_takes_incoming_and_mirror_takes_outgoing_light)
{
    shade_vec3 l = shade_v3(0, 0.6f, 0.8f), n = shade_v3(0, 0, 1);
    CHECK_VEC(shade_mirror(l, n), d3_of(0, -0.6, 0.8), 2 * EPS);
    CHECK_VEC(shade_reflect(shade_neg(l), n), d3_of(0, -0.6, 0.8), 2 * EPS);
    CHECK_VEC(shade_reflect(l, n), d3_of(0, 0.6, -0.8), 2 * EPS);
    for (int i = 0; i < 2000; i++) {
        d3 N = rnd_direction(), L = rnd_direction();
        shade_vec3 nf = d3_round(N), lf = d3_round(L);
        d3 R = d3_sub(d3_scale(N, 2 * d3_dot(N, L)), L);
        CHECK_VEC(shade_mirror(lf, nf), R, 1e-6);
        CHECK_VEC(shade_reflect(lf, nf), d3_scale(R, -1), 1e-6);
        CHECK_VEC(shade_mirror(shade_mirror(lf, nf), nf), L, 2e-6);
    }
}

/* G3 */
TEST(math, halfway_is_unit_between_or_zero_for_opposites)
{
    for (int i = 0; i < 4000; i++) {
        d3 L = rnd_direction(), V = rnd_direction(), H = d3_add(L, V);
        if (d3_length(H) < 1e-2) continue;
        CHECK_VEC(shade_halfway(d3_round(L), d3_round(V)), d3_unit(H), 1e-7 + 2e-7 / d3_length(H));
    }
    CHECK_VEC(shade_halfway(shade_v3(0, 0, 1), shade_v3(0, 0, -1)), d3_of(0, 0, 0), 0);
    CHECK_VEC(shade_halfway(shade_v3(0, 0, 1), shade_v3(9e-7f, 0, -1)), d3_of(0, 0, 0), 0);
    CHECK_VEC(shade_halfway(shade_v3(0, 0, 1), shade_v3(2e-6f, 0, -1)), d3_of(1, 0, 0), 4 * EPS);
}

TEST(math, face_normal_is_right_handed_and_zero_without_area) /* (b - a) x (c - a) */
{
    CHECK_VEC(shade_face_normal(shade_v3(0, 0, 0), shade_v3(1, 0, 0), shade_v3(0, 1, 0)),
              d3_of(0, 0, 1), EPS);
    for (int i = 0; i < 2000; i++) {
        double size = (double)rnd_log(1e-6, 1e6);
        shade_vec3 a = random_vector(size), b = random_vector(size), c = random_vector(size);
        d3 e = d3_unit(d3_sub(d3_from(b), d3_from(a))), f = d3_unit(d3_sub(d3_from(c), d3_from(a)));
        d3 n = d3_cross(e, f);
        if (d3_length(n) < 0.05) continue;
        CHECK_VEC(shade_face_normal(a, b, c), d3_unit(n), 1e-5);
        CHECK_VEC(shade_face_normal(a, c, b), d3_scale(d3_unit(n), -1), 1e-5);
    }
    shade_vec3 p = shade_v3(3, -2, 5), q = shade_v3(4, 4, 4);
    CHECK_VEC(shade_face_normal(p, p, p), d3_of(0, 0, 0), 0);
    CHECK_VEC(shade_face_normal(p, p, q), d3_of(0, 0, 0), 0);
    CHECK_VEC(shade_face_normal(p, q, q), d3_of(0, 0, 0), 0);
    CHECK_VEC(shade_face_normal(p, q, p), d3_of(0, 0, 0), 0);
}

/* Sizes whose squares underflow, are subnormal, or are ordinary, up to the stated limit, all
   mixed in one vector. */
/* G3 */
TEST(math, every_function_is_finite_up_to_a_million_million)
{
    static const float sizes[] = {
        0, 1e-45f, 1e-38f, 1e-30f, 1e-19f, 1e-18f, 1e-9f, 1, 1e6f, 1e12f
    };
    for (int i = 0; i < 20000; i++) {
        float s[9];
        for (int k = 0; k < 9; k++) s[k] = rnd_sign() * sizes[rnd_int(0, 9)];
        shade_vec3 a = shade_v3(s[0], s[1], s[2]), b = shade_v3(s[3], s[4], s[5]),
                   c = shade_v3(s[6], s[7], s[8]);
        CHECK(finite3(shade_normalize(a)) && finite3(shade_cross(a, b)) &&
              finite3(shade_halfway(a, b)));
        CHECK(isfinite(shade_dot(a, b)) && isfinite(shade_length(a)) &&
              isfinite(shade_distance(a, b)));
        CHECK_SAY(finite3(shade_face_normal(a, b, c)), "(%g %g %g) (%g %g %g) (%g %g %g)",
                  (double)a.x, (double)a.y, (double)a.z, (double)b.x, (double)b.y, (double)b.z,
                  (double)c.x, (double)c.y, (double)c.z);
        CHECK(finite3(shade_reflect(a, b)) && finite3(shade_mirror(a, b)));
        double length = d3_length(d3_from(shade_normalize(a)));
        CHECK_SAY(length == 0 || fabs(length - 1) < 1e-6, "|normalize(%g %g %g)| = %g", (double)a.x,
                  (double)a.y, (double)a.z, length);
    }
}

/* Numbers up to 9: a sum of four products, each at most 81, is off by at most 8e-5. */
TEST(math, two_and_four_component_vectors_match_double)
{
    for (int i = 0; i < 1000; i++) {
        float a[4], b[4], t = rnd_float(-2, 2);
        for (int k = 0; k < 4; k++) {
            a[k] = rnd_float(-9, 9);
            b[k] = rnd_float(-9, 9);
        }
        shade_vec2 a2 = shade_v2(a[0], a[1]), b2 = shade_v2(b[0], b[1]);
        shade_vec4 a4 = shade_v4(a[0], a[1], a[2], a[3]), b4 = shade_v4(b[0], b[1], b[2], b[3]);
        shade_vec2 r2[4];
        shade_vec4 r4[4];
        r2[0] = shade_add2(a2, b2);
        r2[1] = shade_sub2(a2, b2);
        r2[2] = shade_scale2(a2, t);
        r2[3] = shade_lerp2(a2, b2, t);
        r4[0] = shade_add4(a4, b4);
        r4[1] = shade_sub4(a4, b4);
        r4[2] = shade_scale4(a4, t);
        r4[3] = shade_lerp4(a4, b4, t);
        double dot = 0, dot2 = 0;
        for (int k = 0; k < 4; k++) {
            double p = (double)a[k], q = (double)b[k], s = (double)t, want[4];
            want[0] = p + q;
            want[1] = p - q;
            want[2] = p * s;
            want[3] = p + s * (q - p);
            dot += p * q;
            if (k == 1) dot2 = dot;
            for (int j = 0; j < 4; j++) {
                float got = k == 0 ? r4[j].x : k == 1 ? r4[j].y : k == 2 ? r4[j].z : r4[j].w;
                CHECK_NEAR(got, want[j], 1e-5);
                if (k < 2) CHECK_NEAR(k == 0 ? r2[j].x : r2[j].y, want[j], 1e-5);
            }
        }
        CHECK_NEAR(shade_dot2(a2, b2), dot2, 4e-5);
        CHECK_NEAR(shade_dot4(a4, b4), dot, 8e-5);
    }
}

/* all mantissas, at an even and an odd exponent: at the others the same sums are scaled by powers
   of two */
TEST(math, the_own_square_root_equals_sqrtf_at_every_mantissa)
{
    long wrong = 0;
    uint32_t u;
    for (u = 0x3F800000u; u < 0x40800000u; u++) {
        wrong += float_bits(shade__own_sqrt(bits_float(u))) != float_bits(sqrtf(bits_float(u)));
    }
    CHECK_INT(wrong, 0);
}

TEST(math, the_own_square_root_equals_sqrtf) /* what SHADE_NO_LIBM uses gives the same bits */
{
    for (int i = 0; i < 400000; i++) {
        uint32_t u = (uint32_t)rnd_bits() & 0x7FFFFFFFu;
        float x = bits_float(u);
        if (!isfinite(x)) continue;
        CHECK_SAY(float_bits(shade__own_sqrt(x)) == float_bits(sqrtf(x)), "x %a: got %a, want %a",
                  (double)x, (double)shade__own_sqrt(x), (double)sqrtf(x));
    }
    static const float special[] = { 0,       1,       4,      9,           2,         0.25f,
                                     FLT_MIN, FLT_MAX, 1e-45f, 0.99999994f, 1.0000001f };
    for (int i = 0; i < 11; i++) {
        CHECK(float_bits(shade__own_sqrt(special[i])) == float_bits(sqrtf(special[i])));
    }
    CHECK(shade__own_sqrt(-1) == 0 && isinf(shade__own_sqrt((float)INFINITY)));
}

/* --------------------------------------------------------------------------------------- powers */

#define POWER_BOUND 2e-6

static void check_power(float x, float n)
{
    double want = ref_power((double)x, (double)n);
    float got = shade_power(x, n);
    CHECK_SAY(fabs((double)got - want) <= POWER_BOUND, "%.9g ^ %.9g: got %.9g, want %.9g",
              (double)x, (double)n, (double)got, want);
}

TEST(math, power_is_within_two_millionths_of_pow)
{
    for (int i = 0; i < 600000; i++) {
        float n = rnd_one_in(4) ? rnd_float(0, 200) : rnd_log(1e-9, 1e6);
        float x = rnd_float(0, 1);
        if (i % 4 == 1) x = rnd_log(1e-38, 1);
        if (i % 4 == 2) x = (float)pow(rnd_unit(), 1 / (double)n); /* results spread over [0, 1] */
        if (i % 4 == 3) x = (float)(1 - (double)rnd_log(1e-8, 1));
        check_power(x, n);
    }
}

TEST(math, power_holds_at_the_ends_of_its_range)
{
    static const float n[] = { 0,     1e-45f, 1e-38f, 1e-20f, 1e-9f,       1e-6f, 1e-3f,
                               0.01f, 0.1f,   0.3f,   0.5f,   0.99999994f, 1,     1.0000001f,
                               2,     3,      7,      64,     127,         128,   1000,
                               1e4f,  65535,  123456, 1e6f };
    static const float x[] = {
        0,      1e-45f,      3e-45f,      1e-42f,      1e-39f,      1.1754942e-38f, 1.17549435e-38f,
        1e-37f, 1e-30f,      1e-20f,      1e-10f,      1e-4f,       0.1f,           0.49999997f,
        0.5f,   0.50000006f, 0.70710677f, 0.70710683f, 0.75f,       0.9f,           0.99f,
        0.999f, 0.9999f,     0.99999f,    0.999999f,   0.99999988f, 0.99999994f,    1
    };
    for (size_t i = 0; i < sizeof x / sizeof x[0]; i++)
        for (size_t k = 0; k < sizeof n / sizeof n[0]; k++) check_power(x[i], n[k]);
}

TEST(math, power_of_one_is_one_and_to_the_zero_is_one)
{
    for (int i = 0; i < 2000; i++) {
        CHECK_NEAR(shade_power(1, rnd_log(1e-9, 1e6)), 1, 0);
        CHECK_NEAR(shade_power(rnd_log(1e-44, 1), 0), 1, 0);
    }
    CHECK_NEAR(shade_power(0, 0), 1, 0);
    CHECK_NEAR(shade_power(0, 1), 0, 0);
    CHECK_NEAR(shade_power(0, 0.001f), 0, 0);
    CHECK_NEAR(shade_power(0, 1e-30f), 0, 0);
}

TEST(math, power_clamps_its_base_and_negative_exponents)
{
    CHECK_NEAR(shade_power(1.5f, 3), 1, 0);
    CHECK_NEAR(shade_power((float)INFINITY, 3), 1, 0);
    CHECK_NEAR(shade_power(-0.5f, 3), 0, 0);
    CHECK_NEAR(shade_power(-0.5f, 2), 0, 0);
    CHECK_NEAR(shade_power(-0.0f, 2), 0, 0);
    CHECK_NEAR(shade_power((float)-INFINITY, 0.5f), 0, 0);
    CHECK_NEAR(shade_power(1, (float)INFINITY), 1, 0);
    CHECK_NEAR(shade_power(0.999999f, (float)INFINITY), 0, 0);
    CHECK_NEAR(shade_power(0, (float)INFINITY), 0, 0);
    CHECK_NEAR(shade_power(-3, 0), 1, 0);
    CHECK_NEAR(shade_power(0.5f, -1), 1, 0);
    CHECK_NEAR(shade_power(0.5f, -1e30f), 1, 0);
    CHECK_NEAR(shade_power(0, -1), 1, 0);
    CHECK_NEAR(shade_power(0.5f, -0.0f), 1, 0);
}

/* G3 */
TEST(math, power_stays_in_the_unit_interval_and_is_never_nan)
{
    for (int i = 0; i < 200000; i++) {
        float x = rnd_nasty(), n = rnd_nasty(), p = shade_power(x, n);
        CHECK_SAY(p >= 0 && p <= 1.000002f, "%a ^ %a = %g", (double)x, (double)n, (double)p);
        if (isnan(x) || isnan(n))
            CHECK_SAY(p == 0 || p == 1, "%a ^ %a = %g", (double)x, (double)n, (double)p);
    }
    for (int i = 0; i < 100000; i++) {
        float x = bits_float((uint32_t)rnd_bits() % 0x3F800001u), n = rnd_log(1e-6, 1e6),
              p = shade_power(x, n);
        CHECK_SAY(p >= 0 && p <= 1.000002f, "%.9g ^ %.9g = %.9g", (double)x, (double)n, (double)p);
    }
}

TEST(math, power_whole_exponents_equal_repeated_squaring)
{
    for (int i = 0; i < 20000; i++) {
        float x = rnd_float(0, 1), n = 1;
        for (double squared = (double)x; n <= 1024; n *= 2, squared *= squared) {
            CHECK_NEAR(shade_power(x, n), squared, POWER_BOUND);
        }
    }
}

TEST(math, power_never_falls_far_as_its_base_grows) /* no seams between octaves */
{
    static const float n[] = { 0.05f, 0.5f, 1, 5, 64, 1000, 1e5f };
    for (size_t k = 0; k < sizeof n / sizeof n[0]; k++) {
        float before = 0;
        for (int i = 0; i <= 20000; i++) {
            float p = shade_power((float)i / 20000, n[k]);
            CHECK_SAY(p >= before - 2 * 2e-6f, "n %g: %.9g after %.9g", (double)n[k], (double)p,
                      (double)before);
            before = p;
        }
    }
}
