/* paint.h - pictures for textures by formula: size x size texels, linear colour and alpha. */
#ifndef EXAMPLES_PAINT_H
#define EXAMPLES_PAINT_H

#include "noise.h"
#include <math.h>

static inline float paint_part(float x) { return x - (float)(int)x; }    /* x >= 0 */
static inline float paint_clamp(float x) { return x < 0 ? 0 : x < 1 ? x : 1; }

/* A toothed leaf with its veins in white, the tip in the middle of the upper edge, the stem below;
   alpha 0 outside. */
static inline void paint_leaf(float (*texel)[4], int size)
{
    for (int i = 0; i < size * size; i++, texel++) {
        float x = fabsf(2 * (float)(i % size) / (float)size - 1);
        float v = (float)(i / size) / (float)size;
        float half = 2.1f * shade_power(v, 0.9f) * shade_power(0.9f - v, 0.6f);
        int vein = x < 0.03f || paint_part(7 * v + 4 * x) < 0.12f;
        half = v > 0.89f ? 0.05f : half - 0.08f * paint_part(12 * v);
        texel[0][0] = texel[0][1] = texel[0][2] = vein ? 1 : 0.6f;
        texel[0][3] = paint_clamp((half - x) * 20 + 0.5f);
    }
}

/* The light of a candle's flame, its foot a fifth below the middle, and a glow to the edges */
static inline void paint_flame(float (*texel)[4], int size)
{
    for (int i = 0; i < size * size; i++, texel++) {
        float x = fabsf(2 * (float)(i % size) / (float)size - 1);
        float y = 1 - 2 * (float)(i / size) / (float)size;
        float t = paint_clamp(1.9f * y + 0.4f), half = 0.26f * shade_power(t, 0.5f) * (1 - t);
        float core = paint_clamp((half - x) * 30);
        float glow = 0.35f * shade_power(1 - sqrtf(x * x + y * y), 4);
        texel[0][0] = 1.4f * core + glow, texel[0][1] = (1.1f - 0.6f * t) * core + 0.5f * glow;
        texel[0][2] = 0.4f * (1 - t) * core + 0.15f * glow, texel[0][3] = 1;
    }
}

/* Two by two tiles, red and cream, with dark joints */
static inline void paint_tiles(float (*texel)[4], int size)
{
    for (int i = 0; i < size * size; i++, texel++) {
        int x = i % size * 128 / size, y = i / size * 128 / size, red = (x / 64 + y / 64) % 2;
        int joint = x % 64 < 3 || y % 64 < 3;
        float grain = 0.8f + 0.4f * noise(shade_v3((float)x / 6, (float)y / 6, 0));
        shade_vec3 c = red ? shade_v3(0.30f, 0.045f, 0.02f) : shade_v3(0.62f, 0.5f, 0.34f);
        c = joint ? shade_v3(0.05f, 0.05f, 0.05f) : shade_scale(c, grain);
        texel[0][0] = c.x, texel[0][1] = c.y, texel[0][2] = c.z, texel[0][3] = 1;
    }
}
#endif
