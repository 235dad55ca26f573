/* project.c - vertices to 24.8 fixed point, in two ways: the projection of every x, y within 3 w, w
   by octaves from 2^-60 to 2^100; and what is classified before it, any bits of x, y, z, w. */
/* eva: -eva-interprocedural-splits */
#include "prove.h"

static shade_vertices v;
static shade__placed p;

/* half the picture, from 1 to 16384 pixels; either convention of depth */
static double any_half(void) { return Frama_C_double_interval(128, 2097152); }

/* |c| <= 6 2^k, which is more than 3 w for 2^k <= w <= 2^(k + 1) */
static void prove_octave(int k)
{
    const uint32_t one = (uint32_t)(127 + k) << 23, six = ((uint32_t)(129 + k) << 23) + 0x400000u;
    const float w = float_of_bits(one, one + 0x800000u);
    const float c = Frama_C_float_interval(-shade__bits_float(six), shade__bits_float(six));
    const double half = any_half();
    const int32_t x = shade__snap(c, w, half, half), y = shade__snap(c, w, -half, half);
    /*@ assert -16777216 <= x <= 16777216 && -16777216 <= y <= 16777216; */
    const float rw = 1 / w;
    /*@ assert 0 < rw <= 1152921504606846976.; */
}

static void set(int lane, float x, float y, float w)
{
    v.clip[0][lane] = x;
    v.clip[1][lane] = y;
    v.clip[2][lane] = any_float();
    v.clip[3][lane] = w;
}

static void place(void)
{
    const int zero_to_one = ANY_OF(0, 1);
    const double half_width = any_half(), half_height = any_half();
    shade__classify(&v, zero_to_one, &p);
    shade__project(half_width, half_height, zero_to_one, &p);
    for (int i = 0; i < SHADE_LANES; i++) {
        /*@ assert -16777216 <= p.x_fx8[i] <= 16777216 && -16777216 <= p.y_fx8[i] <= 16777216; */
        /*@ assert 0 < p.rw[i] <= 1152921504606846976.; */
        /*@ assert 0 <= p.out[i] < 4096; */
    }
}

/* both together: x and y beyond 3 w in some lanes, in the last perhaps */
static void prove_both(int k)
{
    const uint32_t one = (uint32_t)(127 + k) << 23, six = ((uint32_t)(129 + k) << 23) + 0x400000u;
    const float w = float_of_bits(one, one + 0x800000u), far = float_of_bits(six + 1, 0x7F800000u);
    const float near = Frama_C_float_interval(1e-30f, shade__bits_float(six));
    set(0, far, any_float(), w);
    set(1, -far, any_float(), w);
    set(2, any_float(), far, w);
    set(3, any_float(), -far, w);
    set(4, any_float(), any_float(), float_of_bits(0, 0x217FFFFFu));              /* < 2^-60 */
    set(5, any_float(), any_float(), -shade__w_least);
    set(6, any_float(), any_float(), float_of_bits(0x71800000u, 0x7F800000u));    /* from 2^100 */
    set(7, near, -near, w);
    place();
    set(7, -near, near, w);
    place();
}

int main(void)
{
    for (int k = -60; k < 100; k++) prove_octave(k);
    prove_both(-60);
    prove_both(0);
    prove_both(99);
    for (int i = 0; i < SHADE_LANES; i++)
        set(i, any_float(), any_float(), any_float());
    shade__classify(&v, ANY_OF(0, 1), &p);
    return 0;
}
