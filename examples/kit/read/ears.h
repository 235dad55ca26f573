/* ears.h - cuts polygons of any shape into triangles, without new corners.

   An ear is a corner whose triangle with its two neighbours lies inside the polygon.  Every simple
   polygon has an ear, and is a simple polygon again without it.  Only corners that are not convex
   can lie in an ear, so only those are searched for, in the cells of a grid.  Ears are cut in turns
   all around, so that a round polygon gets well-shaped triangles.
   Corners on one line, or at one place, become parts of the ears of other corners.  Where polygons
   cross themselves no cut is right, but each corner is still used. */
#ifndef MODEL_EARS_H
#define MODEL_EARS_H

#include "reader.h"

typedef struct ears_corner {
    double x, y;
    uint32_t next, previous;
    int reflex; /* not convex: may lie inside an ear */
} ears_corner;

/* Scratch memory, kept from polygon to polygon.  Zeroed: empty. */
typedef struct ears {
    ears_corner *corner;
    uint32_t *cell, *inside; /* where each cell begins; the reflex corners by cell */
    size_t capacity;
    uint32_t size;           /* cells along an edge of the grid */
    double low[2], scale[2]; /* from coordinates to cells */
    long long spent;         /* corners looked at, in all polygons */
} ears;

#define EARS_MOST 2000000000ll

static inline void ears_free(ears *e)
{
    free(e->corner);
    free(e->cell);
    free(e->inside);
}

/* Twice the signed area of a, b, c: positive where they turn left */
static inline double ears_turn(const ears_corner *a, const ears_corner *b, const ears_corner *c)
{
    return (b->x - a->x) * (c->y - a->y) - (b->y - a->y) * (c->x - a->x);
}

static inline int ears_same(const ears_corner *a, const ears_corner *b)
{
    return a->x == b->x && a->y == b->y;
}

static inline int ears_room(ears *e, size_t n)
{
    size_t wanted = n < 64 ? 64 : n;
    if (n <= e->capacity) return 0;
    ears_free(e);
    e->capacity = 0;
    e->corner = (ears_corner *)malloc(wanted * sizeof *e->corner);
    e->cell = (uint32_t *)malloc((wanted + 2) * sizeof *e->cell);
    e->inside = (uint32_t *)malloc(wanted * sizeof *e->inside);
    if (!e->corner || !e->cell || !e->inside) return 1;
    e->capacity = wanted;
    return 0;
}

/* Drops the axis along which the polygon is seen largest, so that it is counter-clockwise.  The
   area vector is a sum over edges, with the first corner as origin [Newell]. */
static inline void ears_flatten(ears *e, const float *positions, const uint32_t *index, size_t n)
{
    const float *o = positions + 3 * (size_t)index[0];
    double area[3] = { 0, 0, 0 };
    int axis = 0, u, v;
    for (size_t i = 0; i < n; i++) {
        const float *p = positions + 3 * (size_t)index[i];
        const float *q = positions + 3 * (size_t)index[i + 1 < n ? i + 1 : 0];
        for (int k = 0; k < 3; k++) {
            int a = (k + 1) % 3, b = (k + 2) % 3;
            area[k] += ((double)p[a] - (double)o[a]) * ((double)q[b] - (double)o[b]) -
                       ((double)p[b] - (double)o[b]) * ((double)q[a] - (double)o[a]);
        }
    }
    for (int k = 1; k < 3; k++)
        if (area[k] * area[k] > area[axis] * area[axis]) axis = k;
    u = (axis + (area[axis] < 0 ? 2 : 1)) % 3;
    v = 3 - axis - u;
    for (size_t i = 0; i < n; i++) {
        const float *p = positions + 3 * (size_t)index[i];
        ears_corner *c = &e->corner[i];
        c->x = (double)p[u] - (double)o[u];
        c->y = (double)p[v] - (double)o[v];
        c->next = (uint32_t)(i + 1 < n ? i + 1 : 0);
        c->previous = (uint32_t)(i ? i - 1 : n - 1);
    }
}

static inline uint32_t ears_cell(const ears *e, double at, int axis)
{
    double k = (at - e->low[axis]) * e->scale[axis];
    return k > 0 ? k < e->size ? (uint32_t)k : e->size - 1 : 0;
}

/* Sorts the reflex corners into cells, about one to each. */
static inline void ears_sort(ears *e, size_t n, size_t reflex)
{
    double high[2] = { -1e300, -1e300 };
    size_t cells;
    e->low[0] = e->low[1] = 1e300;
    for (size_t i = 0; i < n; i++) {
        const double at[2] = { e->corner[i].x, e->corner[i].y };
        for (int k = 0; k < 2; k++) {
            if (at[k] < e->low[k]) e->low[k] = at[k];
            if (at[k] > high[k]) high[k] = at[k];
        }
    }
    for (e->size = 1; (size_t)(e->size + 1) * (e->size + 1) <= reflex;) e->size++;
    for (int k = 0; k < 2; k++)
        e->scale[k] = high[k] > e->low[k] ? (double)e->size / (high[k] - e->low[k]) : 0;
    cells = (size_t)e->size * e->size;
    memset(e->cell, 0, (cells + 2) * sizeof *e->cell);
    for (size_t i = 0; i < n; i++) /* counts, two cells further */
        if (e->corner[i].reflex)
            e->cell[ears_cell(e, e->corner[i].y, 1) * e->size + ears_cell(e, e->corner[i].x, 0) +
                    2]++;
    for (size_t i = 2; i < cells + 2; i++) e->cell[i] += e->cell[i - 1];
    for (size_t i = 0; i < n; i++) /* one further: where the next one of a cell goes */
        if (e->corner[i].reflex)
            e->inside[e->cell[ears_cell(e, e->corner[i].y, 1) * e->size +
                              ears_cell(e, e->corner[i].x, 0) + 1]++] = (uint32_t)i;
}

/* Whether b is where an edge turns back on itself, or where a is: a triangle without area, whose
   loss changes nothing.  Corners within a straight edge stay, other polygons may share them. */
static inline int ears_is_spike(const ears_corner *a, const ears_corner *b, const ears_corner *c)
{
    return ears_turn(a, b, c) == 0 &&
           (a->x - b->x) * (c->x - b->x) + (a->y - b->y) * (c->y - b->y) >= 0;
}

/* Whether a corner lies in the triangle a, b, c, or on its edges, and neither at a nor at c: where
   a bridge leads to a hole, two corners are at one place. */
static inline int ears_covers(const ears_corner *a, const ears_corner *b, const ears_corner *c,
                              const ears_corner *p)
{
    return ears_turn(a, b, p) >= 0 && ears_turn(b, c, p) >= 0 && ears_turn(c, a, p) >= 0 &&
           !ears_same(p, a) && !ears_same(p, c);
}

/* The cells over which three coordinates reach */
static inline void ears_span(const ears *e, double a, double b, double c, int axis, uint32_t *span)
{
    double low = a < b ? a : b, high = a < b ? b : a;
    span[0] = ears_cell(e, low < c ? low : c, axis);
    span[1] = ears_cell(e, high > c ? high : c, axis);
}

static inline int ears_is_ear(ears *e, const ears_corner *b)
{
    const ears_corner *a = &e->corner[b->previous], *c = &e->corner[b->next];
    uint32_t x[2], y[2];
    e->spent++;
    if (!(ears_turn(a, b, c) > 0)) return ears_is_spike(a, b, c);
    ears_span(e, a->x, b->x, c->x, 0, x);
    ears_span(e, a->y, b->y, c->y, 1, y);
    for (uint32_t row = y[0]; row <= y[1]; row++) {
        const uint32_t *cell = e->cell + (size_t)row * e->size;
        uint32_t end = cell[x[1] + 1];
        e->spent += 1 + (long long)(end - cell[x[0]]);
        for (uint32_t i = cell[x[0]]; i < end; i++) {
            const ears_corner *p = &e->corner[e->inside[i]];
            if (p->reflex && ears_covers(a, b, c, p)) return 0;
        }
    }
    return 1;
}

/* Whether a corner is reflex, kept up to date; returns how many fewer there are. */
static inline size_t ears_straighten(ears *e, ears_corner *b)
{
    int was = b->reflex;
    if (was) b->reflex = !(ears_turn(&e->corner[b->previous], b, &e->corner[b->next]) > 0);
    return (size_t)(was - b->reflex);
}

static inline size_t ears_begin(ears *e, size_t n)
{
    size_t reflex = 0;
    for (size_t i = 0; i < n; i++) {
        ears_corner *c = &e->corner[i];
        c->reflex = !(ears_turn(&e->corner[c->previous], c, &e->corner[c->next]) > 0);
        reflex += (size_t)c->reflex;
    }
    ears_sort(e, n, reflex);
    return reflex;
}

/* n >= 3 corners, as indices of positions, to 3 (n - 2) indices in out.  Non-zero: out of memory.
   Time grows like n log n to n sqrt n.  After EARS_MOST looks for corners in ears, some seconds,
   whatever is left is cut without looking. */
static inline int ears_cut(ears *e, const float *positions, const uint32_t *index, size_t n,
                           uint32_t *out)
{
    size_t reflex, sorted, left = n, stuck = 0;
    uint32_t at = 0;
    if (n == 3) {
        memcpy(out, index, 3 * sizeof *out);
        return 0;
    }
    if (ears_room(e, n)) return 1;
    ears_flatten(e, positions, index, n);
    reflex = sorted = ears_begin(e, n);
    while (left > 2) {
        ears_corner *b = &e->corner[at], *a = &e->corner[b->previous], *c = &e->corner[b->next];
        /* once around in vain: anything convex will do; twice: anything */
        int ear =
            left == 3 || e->spent > EARS_MOST || stuck >= 2 * left || (stuck >= left && !b->reflex);
        if (!ear) ear = ears_is_ear(e, b);
        stuck = ear ? 0 : stuck + 1;
        if (ear) {
            *out++ = index[b->previous];
            *out++ = index[at];
            *out++ = index[b->next];
            a->next = b->next;
            c->previous = b->previous;
            reflex -= (size_t)b->reflex + ears_straighten(e, a) + ears_straighten(e, c);
            b->reflex = 0; /* no longer in anybody's way */
            left--;
        }
        /* cells of which half is gone are made anew */
        if (sorted > 64 && reflex < sorted / 2) ears_sort(e, n, sorted = reflex);
        at = b->next;
    }
    return 0;
}
#endif
