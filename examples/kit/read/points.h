/* points.h - points without faces as small balls: octahedra with the normals of a ball. */
#ifndef MODEL_POINTS_H
#define MODEL_POINTS_H

#include "model.h"

enum { POINTS_MOST = 500000 }; /* of more points, every second, third, ... is drawn */

/* 0.4 of the distance between as many points on a square as large as the box around them, within
   bounds; 1 where all are one. */
static inline double points_radius(const float *p, size_t n, size_t step)
{
    double low[3] = { 1e300, 1e300, 1e300 }, high[3] = { -1e300, -1e300, -1e300 }, square = 0;
    const double part = 0.3 / sqrt((double)(n / step + 1));
    for (size_t i = 0; i < n; i += step) {
        for (size_t k = 0; k < 3; k++) {
            low[k] = fmin(low[k], (double)p[3 * i + k]);
            high[k] = fmax(high[k], (double)p[3 * i + k]);
        }
    }
    for (int k = 0; k < 3; k++) square += (high[k] - low[k]) * (high[k] - low[k]);
    return square > 0 ? sqrt(square) * fmin(0.02, fmax(0.001, part)) : 1;
}

/* Drops the points that are not finite from the mesh of a model, and returns how many stay. */
static inline size_t points_keep(mesh_reader *r, model *m, size_t n)
{
    float *p = m->mesh.positions, *c = m->mesh.colors;
    size_t kept = 0;
    for (size_t i = 0; i < n; i++) {
        if (!mesh_finite(p + 3 * i)) continue;
        memmove(p + 3 * kept, p + 3 * i, 3 * sizeof *p);
        if (c) memmove(c + 3 * kept, c + 3 * i, 3 * sizeof *c);
        kept++;
    }
    model_warn_dropped(m, r->name, n - kept, "points have coordinates");
    return kept;
}

/* Makes n points, whose positions and colours, or NULL, the mesh of a model holds, a model of one
   part, and says so in its note.  Non-zero: a message of the reader says why not. */
static inline int points_show(mesh_reader *r, model *m, size_t n)
{
    static const uint32_t face[8][3] = { { 0, 2, 4 }, { 2, 1, 4 }, { 1, 3, 4 }, { 3, 0, 4 },
                                         { 2, 0, 5 }, { 1, 2, 5 }, { 3, 1, 5 }, { 0, 3, 5 } };
    const size_t room = r->most && r->most / 8 < POINTS_MOST ? r->most / 8 : POINTS_MOST;
    const size_t step = room ? (n + room - 1) / room : 1, kept = (n + step - 1) / step;
    const double radius = points_radius(m->mesh.positions, n, step);
    const owned_mesh from = m->mesh;
    owned_mesh to = { .positions = (float *)malloc(kept * 18 * sizeof(float)),
                      .normals = (float *)calloc(kept, 18 * sizeof(float)),
                      .colors = from.colors ? (float *)malloc(kept * 18 * sizeof(float)) : NULL,
                      .indices = (uint32_t *)malloc(kept * sizeof face) };
    m->mesh = to;
    m->part = (model_part *)calloc(1, sizeof *m->part);
    for (size_t i = 0; i < kept && to.positions && to.normals && to.indices; i++) {
        const size_t at = 3 * i * step;
        for (size_t c = 0; c < 6; c++) {
            float *p = to.positions + 18 * i + 3 * c, *N = to.normals + 18 * i + 3 * c;
            double place;
            memcpy(p, from.positions + at, 3 * sizeof *p);
            N[c / 2] = c % 2 ? -1.0f : 1.0f;
            place = (double)p[c / 2] + radius * (double)N[c / 2];
            p[c / 2] = (float)fmax(-(double)FLT_MAX, fmin(place, (double)FLT_MAX));
            if (to.colors) memcpy(to.colors + 18 * i + 3 * c, from.colors + at, 3 * sizeof *p);
        }
        for (size_t k = 0; k < 24; k++)
            to.indices[24 * i + k] = face[k / 3][k % 3] + 6 * (uint32_t)i;
    }
    free(from.positions);
    free(from.colors);
    if (!m->part || !to.positions || !to.normals || !to.indices || (from.colors && !to.colors))
        return mesh_fail(r, "out of memory");
    if (mesh_check_triangles(r, 8 * kept)) return 1;
    mesh_link(&m->mesh, 6 * (int)kept, 24 * (int)kept);
    m->part->count = 24 * (int)kept;
    m->part_count = m->normals_given = 1;
    snprintf(m->note, sizeof m->note,
             "%lu points have no faces: they are drawn as small balls of "
             "radius %.3g",
             (unsigned long)n, radius);
    if (step > 1)
        snprintf(m->note + strlen(m->note), sizeof m->note - strlen(m->note), ", one of %lu",
                 (unsigned long)step);
    return 0;
}

/* The same of those that are finite; where the model wants them as they are, they stay points. */
static inline int points_finish(mesh_reader *r, model *m, size_t n)
{
    n = points_keep(r, m, n);
    if (!n) return mesh_fail(r, "no point of it is finite");
    if (!m->points_wanted) return points_show(r, m, n);
    if (n > INT_MAX) return mesh_fail(r, "more than 2^31 - 1 points");
    mesh_link(&m->mesh, (int)n, 0);
    return 0;
}
#endif
