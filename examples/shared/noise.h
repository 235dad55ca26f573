/* noise.h - smooth random numbers in space, the same on every machine, and a planet painted with
   them. */
#ifndef SHARED_NOISE_H
#define SHARED_NOISE_H

#include "mesh.h"

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
#endif
