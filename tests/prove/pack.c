/* pack.c - pixels of every format from any floats, and back from any bytes. */
#define SHADE_LANES 16
#include "prove.h"

enum { N = SHADE__BLOCK };

static void prove_target(shade_target *t)
{
    float rgba[4 * SHADE_LANES], x[N], y[N];
    uint32_t packed[N] = { 0 };
    uint8_t pixel[16];
    const shade__layout *l = &shade__layouts[t->format];
    const size_t bytes = l->bytes;
    any_floats(rgba, 4 * SHADE_LANES);
    for (int i = 0; i < N; i++) {    /* pixel centres of a picture, and what resolve may ask */
        x[i] = Frama_C_float_interval(0, 16400);
        y[i] = Frama_C_float_interval(0, 16400);
    }
    shade__pack_any(t, rgba, x, y, packed, 1);
    if (bytes == 2) {    /* alpha, which is not stored, in the bit above */
        /*@ assert packed[0] <= 131071 && packed[N - 1] <= 131071; */
    }
    /* a pixel that ends where the array does */
    shade__store_pixel(l, pixel + (sizeof pixel - bytes), packed[0], rgba);
    for (int i = 0; i < 16; i++) pixel[i] = Frama_C_unsigned_char_interval(0, 255);
    shade__load_pixel(l, pixel + (sizeof pixel - bytes), packed, rgba);
    shade__unpack_any(t, packed, rgba);
    for (int k = 0; k < 4; k++) {
        float c = rgba[k * SHADE_LANES];
        if (t->format != SHADE_FORMAT_RGBA32F && !t->srgb) {
            /*@ assert 0 <= c <= 1; */
        }
    }
}

static void prove_formats(int srgb, int dither)
{
    shade_target t = { .srgb = srgb, .dither = dither, .format = SHADE_FORMAT_RGBA8 };
    prove_target(&t);
    t.format = SHADE_FORMAT_BGRA8;
    prove_target(&t);
    t.format = SHADE_FORMAT_RGB565;
    prove_target(&t);
    t.format = SHADE_FORMAT_RGB565_SWAPPED;
    prove_target(&t);
    t.format = SHADE_FORMAT_RGBA32F;
    prove_target(&t);
}

/* the thresholds of the dither, and channels rounded by them */
static void prove_parts(void)
{
    float rgba[4 * SHADE_LANES], x[N], y[N], threshold[N];
    uint32_t packed[N];
    any_floats(rgba, 4 * SHADE_LANES);
    for (int i = 0; i < N; i++) {
        float unit = shade__saturate(rgba[i]);
        /*@ assert 0 <= unit <= 1; */
        x[i] = Frama_C_float_interval(0, 16400);
        y[i] = Frama_C_float_interval(0, 16400);
    }
    shade__dither(x, y, threshold, 1);
    for (int i = 0; i < N; i++) {
        /*@ assert 0 < threshold[i] < 1; */
    }
    shade__pack_channels(&shade__layouts[SHADE_FORMAT_RGBA8], rgba, threshold, packed, 1);
    shade__pack_channels(&shade__layouts[SHADE_FORMAT_RGB565], rgba, threshold, packed, 1);
    for (int i = 0; i < N; i++) {
        /*@ assert packed[i] <= 131071; */
        uint32_t swapped = shade__swap16(packed[i]);
        /*@ assert swapped <= 65535; */
    }
}

int main(void)
{
    prove_parts();
    for (int srgb = 0; srgb < 2; srgb++)
        for (int dither = 0; dither < 2; dither++) prove_formats(srgb, dither);
    return 0;
}
