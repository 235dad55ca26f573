/* numbers.h - depth and numbers of objects as the 16-bit grey of a PNG, as data sets have them:
   depth in whole units, of a millimetre most often, and 0 where nothing was seen; numbers of
   objects one higher than they are, so that 0 is what belongs to none.

       uint16_t *grey = ...;                                      n of them
       if (!numbers_from_depth(&why, "depth", depth, n, 0.001, grey)) ... png_lines16 ... */
#ifndef MODEL_NUMBERS_H
#define MODEL_NUMBERS_H

#include "../core/refuse.h"

enum { NUMBERS_MOST = 65535 };

/* The nearest whole unit, at least 1, so that what is there stays there; 0 for what is not:
   infinity, NaN, 0 and what lies behind the eye.  Refuses what lies beyond 65,535.49 units. */
static inline int numbers_from_depth(core_refusal *r, const char *argument, const float *depth,
                                     size_t n, double unit, uint16_t *out)
{
    core_number(r, "unit", unit, 1e-9, 1e9);
    for (size_t i = 0; i < n && !r->code; i++) {
        const double steps = floor((double)depth[i] / unit + 0.5);
        const int there = depth[i] > 0 && depth[i] <= 3e38f;
        if (there && steps > NUMBERS_MOST)
            return core_refuse(
                r, CORE_RANGE, argument,
                "must be at most %g, 65535 units of %g, not %g: a larger unit reaches "
                "farther",
                NUMBERS_MOST * unit, unit, (double)depth[i]);
        out[i] = (uint16_t)(!there ? 0 : steps < 1 ? 1 : steps);
    }
    return r->code;
}

/* Infinity where there is nothing */
static inline int numbers_to_depth(core_refusal *r, const uint16_t *grey, size_t n, double unit,
                                   float *out)
{
    if (core_number(r, "unit", unit, 1e-9, 1e9)) return r->code;
    for (size_t i = 0; i < n; i++) out[i] = grey[i] ? (float)(grey[i] * unit) : HUGE_VALF;
    return 0;
}

/* step: how many numbers a pixel has, of which the first counts.  Refuses what is not -1 to
   65,534. */
static inline int numbers_from_ids(core_refusal *r, const char *argument, const int32_t *ids,
                                   size_t n, size_t step, uint16_t *out)
{
    for (size_t i = 0; i < n; i++) {
        const int32_t id = ids[step * i];
        if (id < -1 || id >= NUMBERS_MOST)
            return core_refuse(r, CORE_RANGE, argument,
                               "must be from -1, for none, to 65534, not %d", (int)id);
        out[i] = (uint16_t)(id + 1);
    }
    return r->code;
}

static inline void numbers_to_ids(const uint16_t *grey, size_t n, int32_t *out)
{
    for (size_t i = 0; i < n; i++) out[i] = grey[i] - 1;
}
#endif
