/* teapot.h - Martin Newell's teapot of 1975, tessellated at any density into the caller's memory.

       int n = 12;                           (pieces along each edge of a patch, 1 .. 3000)
       float *positions = malloc(sizeof(float) * 3 * (size_t)teapot_vertex_count(n)), ...
       uint32_t *indices = malloc(sizeof(uint32_t) * (size_t)teapot_index_count(n));
       teapot_build(n, positions, normals, texcoords, indices);

   Axes: +y up, the spout toward +x, the handle toward -x.  It stands on y = 0, is 3.15 high,
   reaches from x = -3 to 3.434 and z = -2 to 2.  Triangles are counter-clockwise seen from outside;
   from n = 2 on none is without area (at 1 handle and spout are flat).

   The 32 bicubic Bezier patches (with the bottom, which Newell left out) are mirror images of
   ten: six quarter turns of a profile, two halves of a handle and two of a spout.  What follows
   is those ten.  Mirrored they give the 306 points of the usual list, less four that no patch of
   it uses and twelve that stand there twice. */
#ifndef SHARED_TEAPOT_H
#define SHARED_TEAPOT_H

#include <math.h>
#include <stdint.h>

/* One row of control points of a turned part: (r, 0) (r, a) (a, r) (0, r) at a height, and on in
   the other quarters. a / r is 0.56 nearly everywhere, where a circle would have 0.5523: the
   teapot is not quite round. */
typedef struct teapot_ring { double r, a, height; } teapot_ring;
static const teapot_ring teapot_lid[7] = {               /* knob, lid */
    { 0, 0, 3.15 }, { 0.8, 0.45, 3.15 }, { 0, 0, 2.85 }, { 0.2, 0.112, 2.7 },
    { 0.4, 0.224, 2.55 }, { 1.3, 0.728, 2.55 }, { 1.3, 0.728, 2.4 }
};
static const teapot_ring teapot_body[13] = {             /* rim, upper body, lower body, bottom */
    { 1.4, 0.784, 2.4 }, { 1.3375, 0.749, 2.53125 }, { 1.4375, 0.805, 2.53125 }, { 1.5, 0.84, 2.4 },
    { 1.75, 0.98, 1.875 }, { 2, 1.12, 1.35 }, { 2, 1.12, 0.9 },
    { 2, 1.12, 0.45 }, { 1.5, 0.84, 0.225 }, { 1.5, 0.84, 0.15 },
    { 1.5, 0.84, 0.075 }, { 1.425, 0.798, 0 }, { 0, 0, 0 }
};

/* One row of a bent tube: the points where it crosses the plane of symmetry, on the side toward
   the pot (of the handle; of the spout the upper side) and on the other; between them two points
   half_width out of that plane. */
typedef struct teapot_hoop { double x0, y0, x1, y1, half_width; } teapot_hoop;
static const teapot_hoop teapot_handle[7] = {
    { -1.6, 2.025, -1.5, 2.25, 0.3 }, { -2.3, 2.025, -2.5, 2.25, 0.3 },
    { -2.7, 2.025, -3, 2.25, 0.3 }, { -2.7, 1.8, -3, 1.8, 0.3 }, { -2.7, 1.575, -3, 1.35, 0.3 },
    { -2.5, 1.125, -2.65, 0.9375, 0.3 }, { -2, 0.9, -1.9, 0.6, 0.3 }
};
static const teapot_hoop teapot_spout[7] = {
    { 1.7, 1.425, 1.7, 0.6, 0.66 }, { 2.6, 1.425, 3.1, 0.825, 0.66 },
    { 2.3, 2.1, 2.4, 2.025, 0.25 }, { 2.7, 2.4, 3.3, 2.4, 0.25 },
    { 2.8, 2.475, 3.525, 2.49375, 0.25 }, { 2.9, 2.475, 3.45, 2.5125, 0.15 },
    { 2.8, 2.4, 3.2, 2.4, 0.15 }
};

/* 0 where n is out of range */
static inline int teapot_vertex_count(int n)
{
    return n < 1 || n > 3000 ? 0 : 32 * n * n + 22 * n + 4;
}

static inline int teapot_index_count(int n)
{
    return n < 1 || n > 3000 ? 0 : 3 * (64 * n * n - 8 * n);
}

/* Bernstein weights of degree 3 at k / n, and their derivatives.  From the nearer end, so that a
   patch and its mirror image get the same numbers. */
typedef struct teapot_weights { double b[4], d[4]; } teapot_weights;
static inline teapot_weights teapot_bernstein(int k, int n)
{
    double t = (double)k / n, s = (double)(n - k) / n;
    teapot_weights w = { { s * s * s, 3 * t * s * s, 3 * t * t * s, t * t * t },
                         { -3 * s * s, 3 * s * (s - 2 * t), 3 * t * (2 * s - t), 3 * t * t } };
    return w;
}

/* Where a grid writes: (rows + 1) x (columns + 1) vertices; the last column repeats the first
   with u = 1. */
typedef struct teapot_grid {
    int rows, columns, n, base;
    float *positions, *normals, *texcoords;
} teapot_grid;

static inline void teapot_put(const teapot_grid *g, int row, int column,
                              const double p[3], const double n[3])
{
    int at = g->base + row * (g->columns + 1) + column;
    double length = sqrt(n[0] * n[0] + n[1] * n[1] + n[2] * n[2]);
    for (int k = 0; k < 3; k++) {
        g->positions[3 * at + k] = (float)p[k];
        g->normals[3 * at + k] = (float)(n[k] / length);
    }
    if (g->texcoords) {
        g->texcoords[2 * at] = (float)column / (float)g->columns;
        g->texcoords[2 * at + 1] = (float)row / (float)g->rows;
    }
}

/* A turned part: rings of a quarter turn each, so P(s,t) = (R (b0 + b1) + A b2, height, -(A b1 +
   R (b2 + b3))) with R, A, height cubic in t along the profile and b the weights of s around it. */
static inline void teapot_turn(const teapot_grid *g, const teapot_ring *profile)
{
    for (int row = 0; row <= g->rows; row++) {
        int patch = row < g->rows ? row / g->n : g->rows / g->n - 1;
        teapot_weights t = teapot_bernstein(row - patch * g->n, g->n);
        double r = 0, a = 0, h = 0, dr = 0, da = 0, dh = 0;
        for (int k = 0; k < 4; k++) {
            const teapot_ring *ring = &profile[3 * patch + k];
            r += t.b[k] * ring->r;
            a += t.b[k] * ring->a;
            h += t.b[k] * ring->height;
            dr += t.d[k] * ring->r;
            da += t.d[k] * ring->a;
            dh += t.d[k] * ring->height;
        }
        for (int column = 0; column <= g->columns; column++) {
            int turned = column % g->columns, quarter = turned / g->n;
            teapot_weights s = teapot_bernstein(turned - quarter * g->n, g->n);
            double bx = s.b[0] + s.b[1], bz = s.b[2] + s.b[3];
            double x = r * bx + a * s.b[2], z = a * s.b[1] + r * bz;
            double tx = dr * bx + da * s.b[2], tz = da * s.b[1] + dr * bz;
            double sx = r * (s.d[0] + s.d[1]) + a * s.d[2], sz = a * s.d[1] + r * (s.d[2] + s.d[3]);
            double p[3] = { x, h, -z }, n[3] = { -dh * sz, tx * sz - tz * sx, -dh * sx };
            if (r == 0) {
                n[0] = n[2] = 0;
                n[1] = row ? -1 : 1;    /* pole: dP/ds = 0; the limit */
            }
            for (int k = 0; k < quarter; k++) {                  /* a quarter turn from +x to -z */
                double px = p[0], nx = n[0];
                p[0] = p[2];
                p[2] = -px;
                n[0] = n[2];
                n[2] = -nx;
            }
            teapot_put(g, row, column, p, n);
        }
    }
}

/* A tube: P(s,t) = (c0 (b0 + b1) + c1 (b2 + b3), -w (b1 + b2)) with the point c0 toward the pot,
   c1 away from it and w cubic in t along the path.  The second half of the columns is the first
   one seen in the mirror z = 0. */
static inline void teapot_bend(const teapot_grid *g, const teapot_hoop *path)
{
    for (int row = 0; row <= g->rows; row++) {
        int patch = row < g->rows ? row / g->n : g->rows / g->n - 1;
        teapot_weights t = teapot_bernstein(row - patch * g->n, g->n);
        double c[5] = { 0, 0, 0, 0, 0 }, d[5] = { 0, 0, 0, 0, 0 };
        for (int k = 0; k < 4; k++) {
            const teapot_hoop *q = &path[3 * patch + k];
            const double value[5] = { q->x0, q->y0, q->x1, q->y1, q->half_width };
            for (int m = 0; m < 5; m++) {
                c[m] += t.b[k] * value[m];
                d[m] += t.d[k] * value[m];
            }
        }
        for (int column = 0; column <= g->columns; column++) {
            int turned = column % g->columns, mirrored = turned > g->n;
            teapot_weights s = teapot_bernstein(mirrored ? g->columns - turned : turned, g->n);
            double b0 = s.b[0] + s.b[1], b1 = s.b[2] + s.b[3], bw = s.b[1] + s.b[2];
            double slope = s.d[2] + s.d[3];                      /* of b1; of b0, -slope */
            double p[3] = { c[0] * b0 + c[2] * b1, c[1] * b0 + c[3] * b1, 0 - c[4] * bw };
            double pt[3] = { d[0] * b0 + d[2] * b1, d[1] * b0 + d[3] * b1, -d[4] * bw };
            double ps[3] = { (c[2] - c[0]) * slope, (c[3] - c[1]) * slope,
                             -c[4] * (s.d[1] + s.d[2]) };
            double n[3] = { pt[1] * ps[2] - pt[2] * ps[1], pt[2] * ps[0] - pt[0] * ps[2],
                            pt[0] * ps[1] - pt[1] * ps[0] };
            if (mirrored) {
                p[2] = -p[2];
                n[2] = -n[2];
            }
            teapot_put(g, row, column, p, n);
        }
    }
}

/* Two triangles for each cell; one beside a pole, where the other would have no area.  Returns
   the end of the list. */
static inline uint32_t *teapot_cells(const teapot_grid *g, int pole_above, int pole_below,
                                     uint32_t *out)
{
    for (int row = 0; row < g->rows; row++) {
        for (int column = 0; column < g->columns; column++) {
            uint32_t a = (uint32_t)(g->base + row * (g->columns + 1) + column), b = a + 1;
            uint32_t c = a + (uint32_t)g->columns + 1, d = c + 1;
            if (!(pole_below && row == g->rows - 1)) {
                *out++ = a;
                *out++ = c;
                *out++ = d;
            }
            if (!(pole_above && row == 0)) {
                *out++ = a;
                *out++ = d;
                *out++ = b;
            }
        }
    }
    return out;
}

/* Fills positions and normals (3 floats a vertex, normals unit, from the exact derivatives),
   texcoords (2 floats: u around, v from the top or the root of each part; may be NULL) and
   indices.  Each of the four parts - lid, body with the bottom, handle, spout - is one closed
   grid: patches share the vertices of their common edge. */
static inline void teapot_build(int n, float *positions, float *normals, float *texcoords,
                                uint32_t *indices)
{
    teapot_grid g = { 2 * n, 4 * n, n, 0, positions, normals, texcoords };
    if (!teapot_vertex_count(n)) return;
    teapot_turn(&g, teapot_lid);
    indices = teapot_cells(&g, 1, 0, indices);
    g.base += (g.rows + 1) * (g.columns + 1);
    g.rows = 4 * n;
    teapot_turn(&g, teapot_body);
    indices = teapot_cells(&g, 0, 1, indices);
    g.base += (g.rows + 1) * (g.columns + 1);
    g.rows = g.columns = 2 * n;
    teapot_bend(&g, teapot_handle);
    indices = teapot_cells(&g, 0, 0, indices);
    g.base += (g.rows + 1) * (g.columns + 1);
    teapot_bend(&g, teapot_spout);
    teapot_cells(&g, 0, 0, indices);
}
#endif
