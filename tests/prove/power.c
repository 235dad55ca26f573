/* power.c - log2 and exp2 of >>power, and what is made of them: any bits in. */
#define SHADE_LANES 128
#include "prove.h"

/* -log2 x, x in octaves around powers of two, from sqrt(1/2) to sqrt(2) times 2^(e - 127) */
static void prove_neg_log2(void)
{
    /*@ loop unroll 128; */
    for (int e = 1; e <= 127; e++) {
        float x = float_of_bits(((uint32_t)(e - 1) << 23) + 0x3504F3u,
                                e == 127 ? 0x3F800000u : ((uint32_t)e << 23) + 0x3504F2u);
        float u = shade__neg_log2(x);
        /*@ assert 127 - e - 0.8 <= u <= 127 - e + 0.8 && u >= 0; */
    }
    float all = shade__neg_log2(any_float());
    /*@ assert -386 <= all <= 128; */
}

/* 2^-u by the whole number nearest to u, with the two floats at the end, where u + 1/2 may round
   to the next, apart; and where there is none */
static void prove_exp2_neg(void)
{
    float least = shade__exp2_neg(float_of_bits(0, 0x3EFFFFFEu));    /* below 1/2 */
    /*@ assert 0.5 <= least <= 1; */
    float end = shade__exp2_neg(shade__bits_float(0x3EFFFFFFu));
    /*@ assert 0.7 <= end <= 0.75; */
    /*@ loop unroll 130; */
    for (int k = 1; k <= 125; k++) {
        const uint32_t first = shade__float_bits((float)k - 0.5f);
        const uint32_t next = shade__float_bits((float)k + 0.5f);
        float p = shade__exp2_neg(float_of_bits(first, next - 3));
        float q = shade__exp2_neg(float_of_bits(next - 2, next - 1));
        /*@ assert 0 < p <= 0.75 && 0 < q <= 0.75; */
    }
    float last = shade__exp2_neg(Frama_C_float_interval(125.5f, 126.5f));
    /*@ assert 0 <= last <= 2e-38; */
    float most = shade__exp2_neg(float_of_bits(0x42FC0000u, 0x7F800000u));    /* 126, infinite */
    /*@ assert most == 0; */
    float zero = shade__exp2_neg(float_of_bits(0x80000000u, 0x80000000u));
    /*@ assert zero == 1; */
}

int main(void)
{
    prove_neg_log2();
    prove_exp2_neg();
    shade_power(any_float(), any_float());
    shade_vec3 any = shade_v3(any_float(), any_float(), any_float());
    shade_srgb_from_linear(any);
    shade_linear_from_srgb(any);
    shade_rgb(Frama_C_unsigned_int_interval(0, 0xFFFFFFFFu));
    return 0;
}
