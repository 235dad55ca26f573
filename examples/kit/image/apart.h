/* apart.h - how far two pixels are apart, for shade-compare and the packages: colours count as much
   as they cover, so that any two with alpha 0 are the same. */
#ifndef MODEL_APART_H
#define MODEL_APART_H

#include <math.h>
#include <stdint.h>

/* The greatest difference of two pixels, red, green and blue times alpha and alpha, 0 .. 255 each;
   adds those of all four, and their squares, to sums, which may be NULL. */
static inline double apart_pixel(const double *a, const double *b, double *sums)
{
    double most = 0;
    for (int k = 0; k < 4; k++) {
        const double d = fabs(a[k] - b[k]);
        if (sums) sums[0] += d;
        if (sums) sums[1] += d * d;
        most = fmax(most, d);
    }
    return most;
}

/* A pixel of bytes so */
static inline void apart_cover(const uint8_t *rgba, double *out)
{
    for (int k = 0; k < 3; k++) out[k] = rgba[k] * (rgba[3] / 255.0);
    out[3] = rgba[3];
}

/* The same of n pixels of bytes, as whole numbers: one is above a limit where the difference is. */
static inline void apart_bytes(const uint8_t *a, const uint8_t *b, size_t n, int32_t *out)
{
    for (size_t i = 0; i < n; i++, a += 4, b += 4) {
        double one[4], other[4];
        apart_cover(a, one);
        apart_cover(b, other);
        out[i] = (int32_t)ceil(apart_pixel(one, other, NULL) - 1e-9);
    }
}
#endif
