/* paint.h - paints textures by formula: size x size texels, linear colour and alpha.  Before them
   smooth random numbers in space, the same on every machine, and a planet painted with them. */
#ifndef SHARED_PAINT_H
#define SHARED_PAINT_H

#include "mesh.h"
#include <math.h>

/* Numbers of 0 .. 1 at the points of a grid, spread smoothly between them; coordinates above -64 */
static inline float noise(shade_vec3 p)
{
    float f[3], sum = 0;
    f[0] = p.x + 64;
    f[1] = p.y + 64;
    f[2] = p.z + 64;
    for (uint32_t corner = 0; corner < 8; corner++) {
        uint32_t h = 0;
        float weight = 1;
        for (int k = 0; k < 3; k++) {
            uint32_t cell = (uint32_t)f[k], side = corner >> k & 1;
            float t = f[k] - (float)cell, s = t * t * (3 - 2 * t);
            weight *= side ? s : 1 - s;
            h = (h ^ (cell + side)) * 2654435761u;
            h ^= h >> 15;
        }
        sum += weight * (float)(h >> 8) / 16777216;
    }
    return sum;
}

/* A map of land, water and ice for the texture coordinates of mesh_sphere: linear colour; alpha is
   1 on water, 0 on land. */
static inline void noise_planet(float (*texel)[4], int width, int height)
{
    for (int i = 0; i < width * height; i++, texel++) {
        shade_vec2 around = mesh_turn(((float)(i % width) + 0.5f) / (float)width);
        shade_vec2 polar = mesh_turn(((float)(i / width) + 0.5f) / (float)(2 * height));
        shade_vec3 p = shade_v3(polar.y * around.x, polar.x, -polar.y * around.y), c;
        float h = -0.5f, f = 1.8f;
        for (int k = 0; k < 6; k++, f *= 2) h += noise(shade_scale(p, f)) * 0.9f / f;
        c = shade_lerp(shade_v3(0.03f, 0.16f, 0.02f), shade_v3(0.45f, 0.30f, 0.14f), 5 * h);
        if (h < 0) c = shade_lerp(shade_v3(0.02f, 0.20f, 0.35f), shade_v3(0, 0.02f, 0.1f), -6 * h);
        if (p.y * p.y + 0.4f * h > 0.88f) c = shade_v3(0.8f, 0.85f, 0.9f);
        texel[0][0] = c.x;
        texel[0][1] = c.y;
        texel[0][2] = c.z;
        texel[0][3] = h < 0 ? 1.0f : 0.0f;
    }
}

static inline float paint_part(float x) { return x - (float)(int)x; }    /* of x >= 0 */
static inline float paint_clamp(float x) { return x < 0 ? 0 : x < 1 ? x : 1; }

/* A texture of size x size texels of four floats */
static inline shade_texture paint_texture(const void *texels, int size)
{
    shade_texture t = { .pixels = texels, .width = size, .height = size,
                        .format = SHADE_FORMAT_RGBA32F };
    return t;
}

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
        texel[0][0] = 1.4f * core + glow;
        texel[0][1] = (1.1f - 0.6f * t) * core + 0.5f * glow;
        texel[0][2] = 0.4f * (1 - t) * core + 0.15f * glow;
        texel[0][3] = 1;
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
        texel[0][0] = c.x;
        texel[0][1] = c.y;
        texel[0][2] = c.z;
        texel[0][3] = 1;
    }
}

/* A random number of 0 .. 1 for each pair of integers */
static inline float paint_chance(int a, int b)
{
    uint32_t h = (uint32_t)a * 2654435761u ^ (uint32_t)b * 2246822519u;
    h = (h ^ h >> 15) * 2654435761u;
    return (float)(h >> 8) / 16777216;
}

/* Four by eight bricks in running bond, each of its own clay; alpha is their height, above 0.7 on
   top, below 0.3 in the mortar. */
static inline void paint_bricks(float (*texel)[4], int size)
{
    for (int i = 0; i < size * size; i++, texel++) {
        float u = 4 * (float)(i % size) / (float)size, v = 8 * (float)(i / size) / (float)size;
        int row = (int)v, column = (int)(u + 0.5f * (float)(row % 2)) % 4;
        float x = 2 * paint_part(u + 0.5f * (float)(row % 2)) - 1, y = paint_part(v) - 0.5f;
        float seed = 3 * (float)(4 * row + column), edge, low;
        float wear = noise(shade_v3(9 * x, 9 * y, seed));
        float grain = noise(shade_v3(40 * x, 40 * y, seed));
        shade_vec3 mortar = shade_v3(0.30f, 0.28f, 0.25f), dark = shade_v3(0.17f, 0.075f, 0.06f);
        shade_vec3 clay = shade_v3(0.34f, 0.10f, 0.055f);
        /* the depth inside a rectangle with round corners and a wavy edge */
        x = fmaxf(0, fabsf(x) - 0.80f);
        y = fmaxf(0, fabsf(y) - 0.30f);
        edge = paint_clamp(16 * (0.155f + 0.035f * wear - sqrtf(x * x + y * y)));
        edge = edge * edge * (3 - 2 * edge);
        low = 0.12f + 0.10f * grain;
        clay = shade_lerp(clay, dark, paint_chance(column, row));
        clay = shade_lerp(shade_scale(mortar, 0.6f + 0.4f * grain),
                          shade_scale(clay, 0.65f + 0.5f * wear + 0.2f * grain), edge);
        texel[0][0] = clay.x;
        texel[0][1] = clay.y;
        texel[0][2] = clay.z;
        texel[0][3] = low + edge * (0.78f + 0.10f * wear + 0.02f * grain - low);
    }
}

/* The normal map of the heights in alpha, which repeat: (-dh/du, -dh/dv, 1), made unit, its -1 .. 1
   in bytes.  depth: how many texels a height of 1 is */
static inline void paint_relief(uint8_t (*normal)[4], float (*texel)[4], int size, float depth)
{
    for (int i = 0; i < size * size; i++, normal++) {
        int x = i % size, row = i - x, all = size * size;
        float left = texel[row + (x + size - 1) % size][3], right = texel[row + (x + 1) % size][3];
        float above = texel[(i + all - size) % all][3], below = texel[(i + size) % all][3];
        shade_vec3 n = shade_v3(depth / 2 * (left - right), depth / 2 * (above - below), 1);
        n = shade_normalize(n);
        normal[0][0] = (uint8_t)(127.5f * n.x + 128);
        normal[0][1] = (uint8_t)(127.5f * n.y + 128);
        normal[0][2] = (uint8_t)(127.5f * n.z + 128);
        normal[0][3] = 255;
    }
}

/* Turns the heights in alpha into bytes: 0 below .53, 255 from .87 on. */
static inline void paint_mask(uint8_t *mask, float (*texel)[4], int size)
{
    for (int i = 0; i < size * size; i++)
        mask[i] = (uint8_t)(255 * paint_clamp(3 * texel[i][3] - 1.6f));
}
#endif
