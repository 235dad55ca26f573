/* points.h - points without faces as small balls: octahedra with the normals of a ball, as large as
   the points around them are apart; and Gaussian splats as ellipsoids. */
#ifndef MODEL_POINTS_H
#define MODEL_POINTS_H

#include "model.h"

enum { POINTS_MOST = 500000 }; /* of more points, every second, third, ... is drawn */
enum { POINTS_GROUP = 32, POINTS_NEAR = 3 };
#define POINTS_PART 0.9 /* of that distance: octahedra on a square grid leave 2 % of it open */

/* ---- how large each is ----------------------------------------------------------------------- */

/* The points that are drawn, and how far each is from its neighbours.  Groups of near points are
   found by halves of halves: no outlier makes them slow, as it would the cells of a grid. */
typedef struct points_spread {
    const float *place; /* of point i: place[i * step] and the two floats behind it */
    size_t step, count;
    uint32_t *order; /* the points, group by group */
    float *apart;
    uint32_t seed;
} points_spread;

/* Orders the points from .. end - 1 so that none before nth has a larger key than it, and none
   behind it a smaller one; point i has key[i * step]. */
static inline void points_select(points_spread *s, const float *key, size_t step, size_t from,
                                 size_t end, size_t nth)
{
    uint32_t *order = s->order;
    while (end - from > 1) {
        size_t low = from, high = end; /* one behind */
        float pivot;
        s->seed = s->seed * 1664525 + 1013904223; /* no file can make every pivot a bad one */
        pivot = key[order[from + (s->seed >> 8) % (end - from)] * step];
        while (low < high) {
            uint32_t moved;
            while (key[order[low] * step] < pivot) low++;
            while (key[order[high - 1] * step] > pivot) high--;
            if (low >= high) break;
            moved = order[low];
            order[low++] = order[high - 1];
            order[--high] = moved;
        }
        if (nth >= low)
            from = low;
        else if (nth < high)
            end = high;
        else
            return;
    }
}

/* The distance from point a to the third nearest of its group, or to the last where they are fewer;
   those in its very place do not count. */
static inline float points_apart(const points_spread *s, size_t a, size_t from, size_t end)
{
    double near[POINTS_NEAR];
    int found = 0;
    for (size_t b = from; b < end; b++) {
        const float *p = s->place + a * s->step, *q = s->place + s->order[b] * s->step;
        const double x = (double)p[0] - (double)q[0], y = (double)p[1] - (double)q[1];
        const double z = (double)p[2] - (double)q[2], square = x * x + y * y + z * z;
        int k;
        if (square <= 0 || (found == POINTS_NEAR && square >= near[POINTS_NEAR - 1])) continue;
        k = found < POINTS_NEAR ? found++ : POINTS_NEAR - 1;
        for (; k > 0 && near[k - 1] > square; k--) near[k] = near[k - 1];
        near[k] = square;
    }
    return found ? (float)fmin(sqrt(near[found - 1]), (double)FLT_MAX) : 0;
}

/* The box around some points.  Returns its longest axis, and its diagonal in *diagonal. */
static inline size_t points_box(const points_spread *s, size_t from, size_t end, double *diagonal)
{
    double low[3] = { 1e300, 1e300, 1e300 }, high[3] = { -1e300, -1e300, -1e300 }, square = 0;
    size_t longest = 0;
    for (size_t i = from; i < end; i++) {
        for (size_t k = 0; k < 3; k++) {
            const double at = (double)s->place[s->order[i] * s->step + k];
            low[k] = fmin(low[k], at);
            high[k] = fmax(high[k], at);
        }
    }
    for (size_t k = 0; k < 3; k++) {
        square += (high[k] - low[k]) * (high[k] - low[k]);
        if (high[k] - low[k] > high[longest] - low[longest]) longest = k;
    }
    *diagonal = sqrt(square);
    return longest;
}

/* Cuts the points across their longest axis, so many tenths on one side, until they are groups. */
static inline void points_part(points_spread *s, size_t from, size_t end, size_t tenths)
{
    const size_t cut = from + (end - from) * tenths / 10;
    double diagonal;
    if (end - from <= POINTS_GROUP) {
        for (size_t i = from; i < end; i++) {
            const uint32_t at = s->order[i];
            const float apart = points_apart(s, at, from, end);
            if (s->apart[at] <= 0 || (apart > 0 && apart < s->apart[at])) s->apart[at] = apart;
        }
        return;
    }
    points_select(s, s->place + points_box(s, from, end, &diagonal), s->step, from, end, cut);
    points_part(s, from, cut, tenths);
    points_part(s, cut, end, tenths);
}

/* Makes the distances radii: so large that the balls of a surface cover it, and between two bounds,
   of which one keeps those of a solid apart.  Returns the radius in the middle of all. */
static inline double points_radii(points_spread *s)
{
    double diagonal, typical, least, most;
    for (size_t i = 0; i < s->count; i++) s->order[i] = (uint32_t)i;
    points_box(s, 0, s->count, &diagonal);
    points_part(s, 0, s->count, 5);
    points_part(s, 0, s->count, 4); /* who was at the edge of a group is within one now */
    points_select(s, s->apart, 1, 0, s->count, s->count / 2);
    typical = fmax(POINTS_PART * (double)s->apart[s->order[s->count / 2]], 0.001 * diagonal);
    typical = diagonal > 0 ? fmin(typical, 0.03 * diagonal) : 1;
    least = fmax(typical / 4, 0.001 * diagonal);
    most = fmax(typical, fmin(typical * 5, 0.03 * diagonal));
    for (size_t i = 0; i < s->count; i++)
        s->apart[i] = (float)fmax(least, fmin(POINTS_PART * (double)s->apart[i], most));
    return typical;
}

/* ---- the model ------------------------------------------------------------------------------- */

/* Drops the points that are not finite from the mesh of a model, and returns how many stay.  axes,
   which may be NULL, has nine numbers of each. */
static inline size_t points_keep(mesh_reader *r, model *m, size_t n, float *axes)
{
    float *p = m->mesh.positions, *c = m->mesh.colors;
    size_t kept = 0;
    for (size_t i = 0; i < n; i++) {
        if (!mesh_finite(p + 3 * i)) continue;
        memmove(p + 3 * kept, p + 3 * i, 3 * sizeof *p);
        if (c) memmove(c + 3 * kept, c + 3 * i, 3 * sizeof *c);
        if (axes) memmove(axes + 9 * kept, axes + 9 * i, 9 * sizeof *axes);
        kept++;
    }
    model_warn_dropped(m, r->name, n - kept, "points have coordinates");
    return kept;
}

/* A corner of an octahedron around a point at p, which moves there, and its normal: of a ball, or
   of an ellipsoid by its half axes, or NULL */
static inline void points_corner(size_t corner, double radius, const float *axes, float *p,
                                 float *N)
{
    const float sign = corner % 2 ? -1.0f : 1.0f;
    const float *a = axes ? axes + 3 * (corner / 2) : NULL;
    const double length = axes ? sqrt((double)a[0] * (double)a[0] + (double)a[1] * (double)a[1] +
                                      (double)a[2] * (double)a[2])
                               : radius;
    for (size_t k = 0; k < 3; k++) {
        double place;
        N[k] = axes ? sign * (float)((double)a[k] / length) : k == corner / 2 ? sign : 0;
        place = (double)p[k] + length * (double)N[k];
        p[k] = (float)fmax(-(double)FLT_MAX, fmin(place, (double)FLT_MAX));
    }
}

/* Makes n points, whose positions and colours, or NULL, the mesh of a model holds, a model of one
   part, and warns of it.  axes: three half axes of each, or NULL for balls.  Non-zero: a message
   of the reader says why not. */
static inline int points_show(mesh_reader *r, model *m, size_t n, const float *axes)
{
    static const uint32_t face[8][3] = { { 0, 2, 4 }, { 2, 1, 4 }, { 1, 3, 4 }, { 3, 0, 4 },
                                         { 2, 0, 5 }, { 1, 2, 5 }, { 3, 1, 5 }, { 0, 3, 5 } };
    const size_t room = r->most && r->most / 8 < POINTS_MOST ? r->most / 8 : POINTS_MOST;
    const size_t step = room ? (n + room - 1) / room : 1, kept = (n + step - 1) / step;
    const owned_mesh from = m->mesh;
    points_spread spread = { .place = from.positions,
                             .step = 3 * step,
                             .count = kept,
                             .order = (uint32_t *)malloc(kept * sizeof(uint32_t)),
                             .apart = (float *)calloc(kept, sizeof(float)) };
    owned_mesh to = { .positions = (float *)malloc(kept * 18 * sizeof(float)),
                      .normals = (float *)calloc(kept, 18 * sizeof(float)),
                      .colors = from.colors ? (float *)malloc(kept * 18 * sizeof(float)) : NULL,
                      .indices = (uint32_t *)malloc(kept * sizeof face) };
    const double radius = !spread.order || !spread.apart ? 0 : axes ? 1 : points_radii(&spread);
    char text[160], every[40] = "";
    const int enough = radius > 0 && to.positions && to.normals && to.indices;
    m->mesh = to;
    m->part = (model_part *)calloc(1, sizeof *m->part);
    for (size_t i = 0; i < kept && enough; i++) {
        const size_t at = 3 * i * step;
        for (size_t c = 0; c < 6; c++) {
            float *p = to.positions + 18 * i + 3 * c, *N = to.normals + 18 * i + 3 * c;
            memcpy(p, from.positions + at, 3 * sizeof *p);
            points_corner(c, (double)spread.apart[i], axes ? axes + 3 * at : NULL, p, N);
            if (to.colors) memcpy(to.colors + 18 * i + 3 * c, from.colors + at, 3 * sizeof *p);
        }
        for (size_t k = 0; k < 24; k++)
            to.indices[24 * i + k] = face[k / 3][k % 3] + 6 * (uint32_t)i;
    }
    free(from.positions);
    free(from.colors);
    free(spread.order);
    free(spread.apart);
    if (!m->part || !enough || (from.colors && !to.colors)) return mesh_fail(r, "out of memory");
    if (mesh_check_triangles(r, 8 * kept)) return 1;
    mesh_link(&m->mesh, 6 * (int)kept, 24 * (int)kept);
    m->part->count = 24 * (int)kept;
    m->part_count = m->normals_given = 1;
    if (step > 1) snprintf(every, sizeof every, ", one of %lu", (unsigned long)step);
    if (axes)
        snprintf(text, sizeof text, "%lu Gaussian splats are drawn as solid ellipsoids%s",
                 (unsigned long)n, every);
    else
        snprintf(text, sizeof text,
                 "%lu points have no faces: they are drawn as small balls of radius %.3g or so%s",
                 (unsigned long)n, radius, every);
    model_warn(m, r->name, text);
    return 0;
}

/* The same of those that are finite; where the model wants them as they are, they stay points. */
static inline int points_finish(mesh_reader *r, model *m, size_t n)
{
    n = points_keep(r, m, n, NULL);
    if (!n) return mesh_fail(r, "no point of it is finite");
    if (!m->points_wanted) return points_show(r, m, n, NULL);
    if (n > INT_MAX) return mesh_fail(r, "more than 2^31 - 1 points");
    mesh_link(&m->mesh, (int)n, 0);
    return 0;
}

/* ---- Gaussian splats ------------------------------------------------------------------------- */

/* What a file stores of each splat: its opacity as a logit, the logarithms of its three standard
   deviations, and the quaternion w, x, y, z that turns them, of any length */
enum { SPLAT_OPACITY, SPLAT_SCALE, SPLAT_TURN = 4, SPLAT_VALUES = 8 };

/* How many standard deviations from its middle a splat of an opacity a covers half of what is
   behind it: a exp(-d^2 / 2) = 1/2.  0: nowhere */
static inline double points_half(double logit)
{
    const double a = 1 / (1 + exp(-logit));
    return a > 0.5 ? sqrt(2 * log(2 * a)) : 0;
}

/* The three half axes of a splat; halves: standard deviations.  0: it has none that is finite */
static inline int points_axes(const float *splat, double halves, float *out)
{
    const float *q = splat + SPLAT_TURN;
    const double w = (double)q[0], x = (double)q[1], y = (double)q[2], z = (double)q[3];
    const double s = 2 / (w * w + x * x + y * y + z * z);
    const double turn[9] = { 1 - s * (y * y + z * z), s * (x * y + w * z),
                             s * (x * z - w * y),     s * (x * y - w * z),
                             1 - s * (x * x + z * z), s * (y * z + w * x),
                             s * (x * z + w * y),     s * (y * z - w * x),
                             1 - s * (x * x + y * y) };
    double most = 0, least = 1e300;
    for (int k = 0; k < 9; k++)
        out[k] = (float)(turn[k] * halves * exp((double)splat[SPLAT_SCALE + k / 3]));
    for (int k = 0; k < 3; k++) {
        const double length = halves * exp((double)splat[SPLAT_SCALE + k]);
        most = fmax(most, length);
        least = fmin(least, length);
    }
    return s > 0 && s < 1e30 && least > 1e-30 && most < 1e30;
}

/* Makes n splats, of SPLAT_VALUES numbers each, a model as points are: each is drawn where it
   covers half of what is behind it.  Those that do so nowhere are left out, unless none does. */
static inline int points_splats(mesh_reader *r, model *m, size_t n, const float *splats)
{
    float *axes = (float *)malloc((n + 1) * 9 * sizeof *axes), *p = m->mesh.positions;
    float *c = m->mesh.colors;
    size_t solid = 0, kept = 0;
    int failed = 1;
    for (size_t i = 0; i < n; i++) solid += points_half((double)splats[SPLAT_VALUES * i]) > 0;
    for (size_t i = 0; i < n && axes; i++) {
        const float *one = splats + SPLAT_VALUES * i;
        const double halves = solid ? points_half((double)*one) : 1;
        if (halves <= 0 || !points_axes(one, halves, axes + 9 * kept)) continue;
        memmove(p + 3 * kept, p + 3 * i, 3 * sizeof *p);
        if (c) memmove(c + 3 * kept, c + 3 * i, 3 * sizeof *c);
        kept++;
    }
    if (axes && kept < n) {
        char text[120];
        snprintf(text, sizeof text,
                 "%lu Gaussian splats that cover less than half of what is behind",
                 (unsigned long)(n - kept));
        model_leave_out(m, r->name, text);
    }
    kept = axes ? points_keep(r, m, kept, axes) : 0;
    if (!kept)
        mesh_fail(r, axes ? "no splat of it has a finite place and size" : "out of memory");
    else
        failed = points_show(r, m, kept, axes);
    free(axes);
    return failed;
}
#endif
