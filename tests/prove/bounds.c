/* bounds.c - bounds of hidden depth: any clip rectangle within 16384, any triangle in it. */
/* eva: -eva-slevel-function shade__begin_bounds:40 */
#define SHADE_LANES 128
#include "prove.h"

enum { FAR = 1 << 24 };

static shade__bounds bounds;
static shade__plan plan;
static shade__triangle t;

static void prove_begin(void)
{
    plan.x0 = ANY_OF(0, 16383);
    plan.y0 = ANY_OF(0, 16383);
    plan.x1 = ANY_OF(1, 16384);
    plan.y1 = ANY_OF(1, 16384);
    if (plan.x0 >= plan.x1 || plan.y0 >= plan.y1) return;
    shade__begin_bounds(&plan, &bounds);
    /*@ assert 5 <= bounds.log_width <= 14 && 3 <= bounds.log_height <= 14; */
    /*@ assert -511 <= bounds.across <= 512; */
}

/* As many rows of bounds, each across wide at most, as there can be; for 2^w x 2^h pixels each.
   The rectangle begins at (3, 5): only differences count. */
static void prove_next(int across, int w, int h)
{
    const int rows = SHADE__BOUNDS / across;
    const int right = shade__min(16383, 2 + (across << w));
    const int low = shade__min(16383, 4 + (rows << h));
    shade__stretch s;
    bounds.log_width = w;
    bounds.log_height = h;
    bounds.across = ANY_OF(1, across);
    plan.x1 = ANY_OF(4, 16384);
    plan.y1 = ANY_OF(6, 16384);
    t.x0 = ANY_OF(3, right);
    t.y0 = ANY_OF(5, low);
    t.x1 = ANY_OF(3, right);
    t.y1 = ANY_OF(5, low);
    for (int k = 0; k < 3; k++) t.e[k] = ANY_WITHIN(1 << 30) * (int64_t)16384;
    s.x = ANY_OF(3, right);
    s.y = ANY_OF(5, low);
    s.bottom = ANY_OF(5, low);
    s.end = t.x1;
    s.last = s.end;
    s.inside = 0;
    plan.away = Frama_C_float_interval(-1, 1);
    shade__next_stretch(&plan, &bounds, &t, &s);
    /*@ assert 2 <= s.last <= 16383 && 3 <= s.x <= 16384; */
}

/* Bounds of one size, from all in one column to all in one row. */
static void prove_sizes(int w, int h)
{
    /*@ loop unroll 80; */
    for (int rows = SHADE__BOUNDS; rows > 0; rows = SHADE__BOUNDS / (SHADE__BOUNDS / rows + 1))
        prove_next(SHADE__BOUNDS / rows, w, h);
}

int main(void)
{
    prove_begin();
    plan.x0 = 3;
    plan.y0 = 5;
    for (int k = 0; k < 3; k++) {
        t.edges.ex[k] = ANY_WITHIN(2 * FAR);
        t.edges.ey[k] = ANY_WITHIN(2 * FAR);
    }
    t.x_ref = any_float();
    t.y_ref = any_float();
    t.z0 = any_float();
    t.zx = any_float();
    t.zy = any_float();
    t.z_low = any_float();
    t.z_high = any_float();
    any_floats(bounds.farthest, SHADE__BOUNDS);
    for (int h = 3; h <= 14; h++) {
        prove_sizes(shade__max(h, 5), h);
        if (h > 4 && h < 14) prove_sizes(h + 1, h);
    }
    return 0;
}
