/* power.c - shade_power against pow. */
#include "unit.h"

#define POWER_BOUND 2e-6

static void check_power(float x, float n)
{
    double want = ref_power((double)x, (double)n);
    float got = shade_power(x, n);
    CHECK_SAY(fabs((double)got - want) <= POWER_BOUND, "%.9g ^ %.9g: got %.9g, want %.9g",
              (double)x, (double)n, (double)got, want);
}

TEST(power, is_within_two_millionths_of_pow)
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

TEST(power, holds_at_the_ends_of_its_range)
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

TEST(power, of_one_is_one_and_to_the_zero_is_one)
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

TEST(power, clamps_its_base_and_negative_exponents)
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
TEST(power, stays_in_the_unit_interval_and_is_never_nan)
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

TEST(power, whole_exponents_equal_repeated_squaring)
{
    for (int i = 0; i < 20000; i++) {
        float x = rnd_float(0, 1), n = 1;
        for (double squared = (double)x; n <= 1024; n *= 2, squared *= squared) {
            CHECK_NEAR(shade_power(x, n), squared, POWER_BOUND);
        }
    }
}

TEST(power, never_falls_far_as_its_base_grows) /* no seams between octaves */
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
