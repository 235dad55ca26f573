/* stand.h - turns a mesh upright, whichever axis is up in its file, and guesses which one is. */
#ifndef MODEL_STAND_H
#define MODEL_STAND_H

#include "../../shared/mesh.h"
#include <string.h>

/* The rows of a rotation that takes an upright axis (x y z -x -y -z) to +y, then turns about +y */
static inline void upright_rows(int up, float turn, double row[3][3])
{
    /* axis k of the picture is sign * axis of the model */
    static const int axis[6][3] = { { 1, 0, 2 }, { 0, 1, 2 }, { 0, 2, 1 },
                                    { 1, 0, 2 }, { 0, 1, 2 }, { 0, 2, 1 } };
    static const double sign[6][3] = { { -1, 1, 1 }, { 1, 1, 1 },   { 1, 1, -1 },
                                       { 1, -1, 1 }, { -1, -1, 1 }, { 1, -1, 1 } };
    shade_mat4 m = shade_mat4_rotation(turn, shade_v3(0, 1, 0));
    float c[16];
    memcpy(c, &m, sizeof c);
    for (int i = 0; i < 3; i++)
        for (int k = 0; k < 3; k++) row[i][k] = 0;
    for (int i = 0; i < 3; i++)
        for (int k = 0; k < 3; k++) row[i][axis[up][k]] += (double)c[4 * k + i] * sign[up][k];
}

static inline void rotate_rows(float *v, size_t n, double row[3][3])
{
    for (size_t i = 0; i < n; i++, v += 3) {
        double x = (double)v[0], y = (double)v[1], z = (double)v[2];
        for (int k = 0; k < 3; k++) v[k] = (float)(row[k][0] * x + row[k][1] * y + row[k][2] * z);
    }
}

/* The mesh upright, turned, and one unit large about the origin.  Returns the scale. */
static inline float mesh_stand(owned_mesh *m, int up, float turn)
{
    const float scale = mesh_normalize(m, 0);
    double row[3][3];
    size_t n = (size_t)m->view.vertex_count;
    upright_rows(up, turn, row);
    rotate_rows(m->positions, n, row);
    rotate_rows(m->normals, n, row);
    return scale;
}

/* ---- a guess --------------------------------------------------------------------------------- */

/* What lies at one end of an axis, as parts of the box around the mesh: the area of the triangles
   that face outward there, and the rectangle around all vertices there */
typedef struct stand_end {
    double flat, wide;
} stand_end;

/* The end of axis k at place, toward which the sign points; near is how close counts. */
static inline stand_end stand_look(const owned_mesh *m, int k, double sign, double place,
                                   double near, double box)
{
    const int a = (k + 1) % 3, b = (k + 2) % 3;
    double low[2] = { 1e38, 1e38 }, high[2] = { -1e38, -1e38 }, area = 0;
    stand_end end;
    for (int i = 0; i < m->view.index_count; i += 3) {
        shade_vec3 v[3], n;
        float p[3][3], normal[3];
        int inside = 0;
        for (int c = 0; c < 3; c++) {
            memcpy(p[c], m->positions + 3 * (size_t)m->indices[i + c], sizeof p[c]);
            memcpy(&v[c], p[c], sizeof p[c]);
            if (sign * (place - (double)p[c][k]) > near) continue;
            inside++;
            low[0] = fmin(low[0], (double)p[c][a]);
            high[0] = fmax(high[0], (double)p[c][a]);
            low[1] = fmin(low[1], (double)p[c][b]);
            high[1] = fmax(high[1], (double)p[c][b]);
        }
        if (inside < 3) continue;
        n = shade_cross(shade_sub(v[1], v[0]), shade_sub(v[2], v[0]));
        memcpy(normal, &n, sizeof normal);
        if (sign * (double)normal[k] > 0.99 * (double)shade_length(n))
            area += 0.5 * sign * (double)normal[k];
    }
    end.flat = box > 0 ? fmin(1, area / box) : 0;
    end.wide = box > 0 && high[0] > low[0] ? (high[0] - low[0]) * (high[1] - low[1]) / box : 0;
    return end;
}

/* What lies below where axis up is upright */
static inline stand_end stand_bottom(const owned_mesh *m, int up, const float *low,
                                     const float *high)
{
    const int k = up % 3, a = (k + 1) % 3, b = (k + 2) % 3;
    const double near = 0.02 * ((double)high[k] - (double)low[k]);
    const double box = ((double)high[a] - (double)low[a]) * ((double)high[b] - (double)low[b]);
    return stand_look(m, k, up < 3 ? -1 : 1, (double)(up < 3 ? low : high)[k], near, box);
}

/* Copies the triangles that have a corner near an end of the box, of which alone stand_bottom asks;
   the caller frees the indices, which are NULL where memory is out. */
static inline owned_mesh stand_ends(const owned_mesh *m, const float *low, const float *high)
{
    owned_mesh ends = *m;
    const size_t n = (size_t)m->view.vertex_count;
    uint32_t *to = (uint32_t *)malloc(((size_t)m->view.index_count + 1) * sizeof *to);
    char *outer = (char *)calloc(n + 1, 1);
    float below[3], above[3];
    int count = 0;
    for (int k = 0; k < 3; k++) {
        below[k] = low[k] + 0.021f * (high[k] - low[k]);
        above[k] = high[k] - 0.021f * (high[k] - low[k]);
    }
    for (size_t i = 0; outer && i < n; i++) {
        const float *p = m->positions + 3 * i;
        for (int k = 0; k < 3; k++) outer[i] |= (char)((p[k] <= below[k]) | (p[k] >= above[k]));
    }
    for (int i = 0; i < m->view.index_count && to && outer; i += 3) {
        const uint32_t *corner = m->indices + i;
        if (!(outer[corner[0]] | outer[corner[1]] | outer[corner[2]])) continue;
        memcpy(to + count, corner, 3 * sizeof *to);
        count += 3;
    }
    if (!outer) free(to);
    ends.indices = outer ? to : NULL;
    free(outer);
    mesh_link(&ends, m->view.vertex_count, count);
    return ends;
}

/* 1: what lies below where axis up is upright is at least an eighth of the box wide. */
static inline int stand_is_wide(const owned_mesh *m, int up, const float *low, const float *high)
{
    const int k = up % 3, a = (k + 1) % 3, b = (k + 2) % 3;
    const float near = 0.02f * (high[k] - low[k]),
                eighth = (high[a] - low[a]) * (high[b] - low[b]) / 8;
    float least[2] = { FLT_MAX, FLT_MAX }, most[2] = { -FLT_MAX, -FLT_MAX };
    for (int i = 0; i < m->view.index_count; i++) {
        const float *p = m->positions + 3 * (size_t)m->indices[i];
        if ((up < 3 ? p[k] - low[k] : high[k] - p[k]) > near) continue;
        least[0] = p[a] < least[0] ? p[a] : least[0];
        least[1] = p[b] < least[1] ? p[b] : least[1];
        most[0] = p[a] > most[0] ? p[a] : most[0];
        most[1] = p[b] > most[1] ? p[b] : most[1];
        if ((most[0] - least[0]) * (most[1] - least[1]) > eighth) return 1;
    }
    return 0;
}

/* The upright axis, 0 .. 5: the usual one, unless the model cannot stand on it, but stands on
   another on small feet around a wide rectangle, and is narrow above.  A large flat face says
   nothing, because much leans on a wall or hangs on it.  Files are not upside down.  Of 1484 real
   models this turns 8, all of which lay or stood on their nose. */
static inline int stand_guess(const owned_mesh *m, int usual)
{
    float low[3], high[3];
    double box[2][3];
    stand_end end[6];
    owned_mesh ends;
    double best = 0.3;
    int guess = usual;
    mesh_box(m, box[0], box[1]);
    for (int k = 0; k < 3; k++) {
        low[k] = (float)box[0][k];
        high[k] = (float)box[1][k];
    }
    if (stand_is_wide(m, usual, low, high)) return usual; /* no other is 8 times as wide */
    ends = stand_ends(m, low, high);
    if (!ends.indices) return usual;
    for (int up = 0; up < 6; up++) end[up] = stand_bottom(&ends, up, low, high);
    free(ends.indices);
    for (int up = 0; up < 6; up++) {
        const stand_end base = end[up], top = end[(up + 3) % 6];
        const int feet = base.flat >= 0.01 && base.flat <= base.wide / 10;
        if (up % 3 == usual % 3 || base.wide < best || !feet) continue;
        if (fmax(top.wide, end[usual].wide) > base.wide / 8) continue;
        best = base.wide;
        guess = up;
    }
    return guess;
}
#endif
