/* cut.h - the outline of a mesh that a plane cuts, as pieces in the plane: whether it is closed,
   and the rows that fill it.

   In a row no two pieces cross, and the solid lies where they wind around a point.  Rows of meshes
   with holes or turned both ways are filled between every second pair of crossings. */
#ifndef DRAW_CUT_H
#define DRAW_CUT_H

#include <math.h>
#include <stdlib.h>
#include <string.h>

/* A piece, from its lower end to its higher one; two numbers along rows and across them */
typedef struct cut_edge {
    double low[2], high[2];
    int way; /* 1: it came from low to high; -1: from high to low */
} cut_edge;

typedef struct cut_outline {
    cut_edge *edge;
    size_t edges, room; /* room: of the caller's memory */
} cut_outline;

/* Where an edge crosses a row, at its lower and upper border */
typedef struct cut_crossing {
    int row, way;
    double low, high;
} cut_crossing;

/* Takes the area between two crossings of a row, c[0] and c[1], from height[0] to height[1].
   Non-zero: the filling ends */
typedef int cut_emit(void *user, const cut_crossing *c, const double *height);

/* A piece from one point to another, with the solid always on the same side */
static inline void cut_piece(cut_edge *e, const double begin[2], const double end[2])
{
    e->way = begin[1] > end[1] ? -1 : 1;
    memcpy(e->low, e->way > 0 ? begin : end, sizeof e->low);
    memcpy(e->high, e->way > 0 ? end : begin, sizeof e->high);
}

/* ---- whether it is closed -------------------------------------------------------------------- */

static inline int cut_number(const void *a, const void *b)
{
    const double x = *(const double *)a, y = *(const double *)b;
    return (x > y) - (x < y);
}

/* How far the outline is open along a line through the plane: where it is closed an even number of
   its parts end in each point, and in the order of the line two and two ends are the same.  With
   directed it is also wrong where parts do not begin where others end.  Huge: out of memory */
static inline double cut_gap(const cut_outline *s, double x, double y, int directed)
{
    const size_t n = s->edges, step = directed ? 1 : 2, apart = directed ? n : 1;
    double *at = (double *)malloc((2 * n + 1) * sizeof *at), sum = 0;
    if (!at) return HUGE_VAL;
    for (size_t i = 0; i < n; i++) {
        const cut_edge *e = &s->edge[i];
        const size_t low = e->way > 0 ? i : n + i, high = e->way > 0 ? n + i : i;
        at[low] = x * e->low[0] + y * e->low[1];
        at[high] = x * e->high[0] + y * e->high[1];
    }
    qsort(at, directed ? n : 2 * n, sizeof *at, cut_number);
    if (directed) qsort(at + n, n, sizeof *at, cut_number);
    for (size_t i = 0; i < n; i++) sum += fabs(at[step * i] - at[step * i + apart]);
    free(at);
    return sum;
}

/* The larger gap along two lines that few parts have sides along */
static inline double cut_gaps(const cut_outline *s, int directed)
{
    return fmax(cut_gap(s, 1, 0.382, directed), cut_gap(s, -0.382, 1, directed));
}

/* 0: the outline is closed; CUT_TORN: it is open by more than a thousandth of the model, and
   than what rounding makes of edges that meet in the middle of others, or turned both ways;
   CUT_OPEN: by so much of its length that it is one of sheets, which have no inside */
enum { CUT_TORN = 1, CUT_OPEN };
static inline int cut_state(const cut_outline *s, double extent)
{
    const double least = (1e-3 + 3e-7 * (double)s->edges) * extent;
    const double gap = cut_gaps(s, 0);
    double length = 0;
    for (size_t i = 0; i < s->edges; i++)
        length +=
            hypot(s->edge[i].high[0] - s->edge[i].low[0], s->edge[i].high[1] - s->edge[i].low[1]);
    if (gap > least && gap > 0.05 * length) return CUT_OPEN;
    return gap > least || cut_gaps(s, 1) > least ? CUT_TORN : 0;
}

/* ---- rows ------------------------------------------------------------------------------------ */

static inline int cut_along(const void *a, const void *b)
{
    const cut_crossing *x = (const cut_crossing *)a, *y = (const cut_crossing *)b;
    const double p = x->low + x->high, q = y->low + y->high;
    if (x->row != y->row) return x->row > y->row ? 1 : -1;
    return (p > q) - (p < q);
}

/* The first of n sorted numbers that is not below x */
static inline size_t cut_find(const double *sorted, size_t n, double x)
{
    size_t low = 0;
    while (low < n) {
        const size_t middle = (low + n) / 2;
        if (sorted[middle] < x)
            low = middle + 1;
        else
            n = middle;
    }
    return low;
}

/* Where an edge is at a height; on itself, whatever the height */
static inline double cut_at(const cut_edge *e, double height)
{
    const double t = (height - e->low[1]) / (e->high[1] - e->low[1]);
    if (t >= 1) return e->high[0];
    return t > 0 ? e->low[0] + (e->high[0] - e->low[0]) * t : e->low[0];
}

/* How many rows the edges cross */
static inline size_t cut_spans(const cut_outline *s, const double *height, size_t n)
{
    size_t sum = 0;
    for (size_t i = 0; i < s->edges; i++)
        sum += cut_find(height, n, s->edge[i].high[1]) - cut_find(height, n, s->edge[i].low[1]);
    return sum;
}

/* The borders of rows, sorted: those of a hatch, whose lines are spacing apart and of which the
   part dark is drawn, spacing 0: none; and the ends of all edges or, where they would cross more
   than most rows, as many even ones as may be.  There is an edge.  NULL: out of memory */
static inline double *cut_rows(const cut_outline *s, double spacing, double dark, size_t most,
                               size_t *count)
{
    double low = s->edge[0].low[1], high = low, *height;
    size_t hatch = 0, n = 0, even;
    for (size_t i = 0; i < s->edges; i++) {
        low = fmin(low, s->edge[i].low[1]);
        high = fmax(high, s->edge[i].high[1]);
    }
    if (spacing > 0) hatch = 1 + (size_t)fmin(1000, ceil((high - low) / spacing));
    even = most / s->edges;
    height = (double *)malloc((2 * s->edges + 2 * hatch + even + 8) * sizeof *height);
    if (!height) return NULL;
    for (int attempt = 0; attempt < 2; attempt++) {
        n = 0;
        for (size_t i = 0; i < hatch; i++) {
            height[n] = (floor(low / spacing) + (double)i) * spacing;
            height[n + 1] = height[n] + dark * spacing;
            n += 2;
        }
        for (size_t i = 0; i < s->edges && !attempt; i++) {
            height[n++] = s->edge[i].low[1];
            height[n++] = s->edge[i].high[1];
        }
        for (size_t i = 0; i <= even + !hatch && attempt; i++)
            height[n++] = low + (high - low) * (double)i / (double)(even + 1);
        qsort(height, n, sizeof *height, cut_number);
        *count = 0;
        for (size_t i = 0; i < n; i++)
            if (!*count || height[i] > height[*count - 1]) height[(*count)++] = height[i];
        if (cut_spans(s, height, *count) <= most) break;
    }
    return height;
}

/* How much more pieces rise than fall in a row of count crossings; not 0: it is open */
static inline int cut_total(const cut_crossing *c, int count)
{
    int total = 0;
    for (int i = 0; i < count; i++) total += c[i].way;
    return total;
}

/* How many of n crossings, sorted, lie in the first one's row */
static inline int cut_count(const cut_crossing *c, size_t n)
{
    int count = 0;
    while ((size_t)count < n && c[count].row == c->row) count++;
    return count;
}

/* Finds all crossings of rows and hands over what lies between them.  A row that is open is filled
   between each second pair; with together all are where one is.  Non-zero: out of memory, or emit
   ended it */
static inline int cut_fill(const cut_outline *s, const double *height, size_t rows, int together,
                           cut_emit *emit, void *user)
{
    const size_t n = cut_spans(s, height, rows);
    cut_crossing *list = (cut_crossing *)malloc((n + 1) * sizeof *list);
    size_t all = 0;
    int failed = !list, open = 0;
    for (size_t i = 0; i < s->edges && list; i++) {
        const cut_edge *e = &s->edge[i];
        const size_t end = cut_find(height, rows, e->high[1]);
        for (size_t k = cut_find(height, rows, e->low[1]); k < end && k + 1 < rows; k++)
            list[all++] =
                (cut_crossing){ (int)k, e->way, cut_at(e, height[k]), cut_at(e, height[k + 1]) };
    }
    if (list) qsort(list, all, sizeof *list, cut_along);
    for (size_t i = 0, count; i < all && together; i += count) {
        count = (size_t)cut_count(list + i, all - i);
        open |= cut_total(list + i, (int)count);
    }
    for (size_t i = 0, count; i < all && !failed; i += count) {
        const cut_crossing *c = list + i;
        const int one = cut_count(c, all - i), total = cut_total(c, one) || open;
        int winding = 0;
        count = (size_t)one;
        for (int k = 0; k + 1 < one && !failed; k++) {
            winding = total ? k % 2 == 0 : winding + c[k].way;
            if (winding) failed = emit(user, c + k, height + c->row);
        }
    }
    free(list);
    return failed;
}
#endif
