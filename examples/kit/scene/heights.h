/* heights.h - ground of rows of heights, as a mesh of a scene: smooth, and where it has a base with
   sides down to that. */
#ifndef SCENE_HEIGHTS_H
#define SCENE_HEIGHTS_H

#include <limits.h>
#include "renderer.h"

typedef struct heights {
    const float *z;        /* rows along y */
    int32_t rows, columns; /* two at least */
    double half[2];        /* x goes from -half[0] to half[0], y from -half[1] to half[1] */
    double scale;          /* of z */
    double base;           /* how far the sides reach below 0 */
    int32_t sides, unused;
} heights;

/* The vertex of the rim that is k steps from the first one, counterclockwise */
static inline int heights_rim(const heights *h, int k)
{
    const int across = h->columns - 1, along = h->rows - 1;
    if (k < across) return k;
    if (k < across + along) return (k - across) * h->columns + across;
    if (k < 2 * across + along) return along * h->columns + 2 * across + along - k;
    return (2 * (across + along) - k) % (2 * (across + along)) * h->columns;
}

static inline void heights_top(const heights *h, float *p, uint32_t *f)
{
    const double a = h->half[0], b = h->half[1];
    for (int i = 0; i < h->rows; i++)
        for (int j = 0; j < h->columns; j++, p += 3) {
            const uint32_t k = (uint32_t)(i * h->columns + j), up = k + (uint32_t)h->columns;
            p[0] = (float)(2 * a * j / (h->columns - 1) - a);
            p[1] = (float)(2 * b * i / (h->rows - 1) - b);
            p[2] = (float)(h->scale * (double)h->z[k]);
            if (i == h->rows - 1 || j == h->columns - 1) continue;
            const uint32_t corner[6] = { k, k + 1, up + 1, k, up + 1, up };
            memcpy(f, corner, sizeof corner);
            f += 6;
        }
}

/* Walls have vertices of their own, so that their rim is sharp. */
static inline void heights_sides(const heights *h, float *p, uint32_t *f, int first, int rim)
{
    for (int k = 0; k < rim; k++, first += 4, f += 6) {
        const int from = heights_rim(h, k), to = heights_rim(h, (k + 1) % rim);
        const int top[4] = { from, to, to, from };
        const uint32_t v = (uint32_t)first, corner[6] = { v, v + 1, v + 2, v, v + 2, v + 3 };
        for (int c = 0; c < 4; c++) {
            float *at = p + 3 * ((size_t)first + (size_t)c);
            memcpy(at, p + 3 * (size_t)top[c], 3 * sizeof *at);
            if (c < 2) at[2] = (float)-h->base;
        }
        memcpy(f, corner, sizeof corner);
    }
}

/* Puts ground in the place of mesh number.  Returns how many triangles it has; 0: out of memory */
static inline int heights_set(renderer_scene *scene, int number, const heights *h)
{
    const int rim = h->sides ? 2 * (h->columns + h->rows - 2) : 0;
    const double all = (double)h->rows * h->columns + 4.0 * rim;
    const int vertices = all < INT_MAX / 8 ? (int)all : 0, top = vertices - 4 * rim;
    const int corners = 6 * ((h->rows - 1) * (vertices ? h->columns - 1 : 0) + rim);
    float *p = (float *)malloc(((size_t)vertices + 1) * 3 * sizeof *p);
    uint32_t *f = (uint32_t *)malloc(((size_t)corners + 1) * sizeof *f);
    const shade_mesh mesh = {
        .positions = p, .vertex_count = vertices, .indices = f, .index_count = corners
    };
    int made = vertices && p && f;
    if (made) heights_top(h, p, f);
    if (made) heights_sides(h, p, f + corners - 6 * rim, top, rim);
    made = made && renderer_set_mesh(scene, number, &mesh, 1, NULL);
    free(p);
    free(f);
    return made ? corners / 3 : 0;
}
#endif
