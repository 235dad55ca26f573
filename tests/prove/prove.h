/* prove.h - what the drivers of "make prove" share: shade.h for Frama-C's Eva, and values of which
   nothing but a range is known.  Each driver calls functions of one section over the whole range
   of their pre: and asserts their post:.  Most have the default of 128 lanes.  Where that takes
   Eva too long there are fewer: a loop over lanes touches lane i alone, so that more lanes add
   turns of the loop, and no values. */
#ifndef PROVE_H
#define PROVE_H
#include <string.h>
#include "__fc_builtin.h"

#ifndef SHADE_LANES
#define SHADE_LANES 8
#endif
#define SHADE_MEMCPY(d, s, n) memcpy(d, s, n)
#define SHADE_MEMSET(d, c, n) memset(d, c, n)
#define SHADE_NO_DISPATCH
#define SHADE_NO_STDIO
#define SHADE_STATIC
#define SHADE_IMPLEMENTATION
#include PROVE_HEADER    /* the copy of shade.h that prove.sh makes */

#define ANY_OF(lo, hi) Frama_C_interval(lo, hi)
#define ANY_WITHIN(limit) Frama_C_interval(-(limit), limit)

/* Every float whose bits lie between two patterns. */
static float float_of_bits(uint32_t lo, uint32_t hi)
{
    uint32_t u = Frama_C_unsigned_int_interval(lo, hi);
    float f;
    memcpy(&f, &u, 4);
    return f;
}

/* Any bits: NaN, infinite, subnormal, of either sign. */
static float any_float(void) { return float_of_bits(0, 0xFFFFFFFFu); }

static void any_floats(float *to, int n)
{
    for (int i = 0; i < n; i++) to[i] = any_float();
}

static uint32_t any_mask(void) { return ANY_OF(0, 1) ? 0xFFFFFFFFu : 0; }

static void any_ints(int32_t *to, int n, int32_t lo, int32_t hi)
{
    for (int i = 0; i < n; i++) to[i] = ANY_OF(lo, hi);
}
#endif
