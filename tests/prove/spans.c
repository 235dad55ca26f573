/* spans.c - pixels between edges: spans of 8 rows in 64 and in 32 bits, and columns of pixels.  In
   32 bits by the extents w, h of triangles that fit there, in steps. */
#include "prove.h"

enum { FAR = 1 << 24 };

static shade__triangle t;
static shade__rows8 s;

/* 64 bits: any slope, any edge that a box within 16384 pixels may reach */
static void prove_big(int n)
{
    const int64_t e = ANY_WITHIN(1 << 30) * (int64_t)32768;
    const int up = shade__crossing(e, ANY_OF(1, 2 * FAR), n);
    const int down = shade__crossing(e, ANY_OF(-2 * FAR, -1), n);
    /*@ assert 0 <= up <= n && -1 <= down < n; */
    int64_t edge[3];
    for (int k = 0; k < 3; k++) {
        edge[k] = ANY_WITHIN(1 << 30) * (int64_t)16384;
        t.dx[k] = ANY_WITHIN(2 * FAR);
        t.dy[k] = ANY_WITHIN(2 * FAR);
    }
    shade__spans_big(&t, edge, ANY_OF(0, 16383), n, &s);
    for (int r = 0; r < 8; r++) {
        /*@ assert 0 <= s.first[r] <= n && -1 <= s.last[r] < n; */
    }
}
/* height of the highest triangle w wide that >>triangles finds to fit, 0: none does */
static int most_height(int w)
{
    const double most = (2.7e11 * 1.00001 - 11264.0 * w) / (2.0 * w + 11264);
    return most < 0 ? 0 : most > 2 * FAR ? 2 * FAR : (int)most;
}
/* e: at the box's corner, of one sign; row and n within the box */
static void prove_small(int w, int h, int positive, int descending)
{
    const double most = 2.0 * w * h / 256 + 2;
    const int limit = most > 1073741824 ? 1073741824 : (int)most;
    const int n = ANY_OF(1, shade__min(w / 256 + 1, 16384));
    t.e[0] = positive ? ANY_OF(0, limit) : ANY_OF(-limit, -1);
    t.dx[0] = descending ? ANY_OF(-h, -1) : ANY_OF(0, h);
    t.dy[0] = ANY_WITHIN(w);
    for (int k = 1; k < 3; k++) t.e[k] = t.dx[k] = t.dy[k] = 0;
    shade__spans_small(&t, ANY_OF(0, shade__min(h / 256, 16383)), n, &s);
    for (int r = 0; r < 8; r++) {
        /*@ assert 0 <= s.first[r] <= w / 256 + 4 && -w / 256 - 4 <= s.last[r] <= w / 256; */
    }
}
static shade__plan plan;
static float depth[64 * 16];

/* windows in a rectangle of 64 x 16 pixels, whose memory ends with them */
static void prove_column(int w, int h, int width, int plain)
{
    const double most = 2.0 * w * h / 256 + 2;
    const int limit = most > 1073741824 ? 1073741824 : (int)most;
    float row_z[8];
    uint32_t set[8] = { 0 };
    for (int k = 0; k < 3; k++) {
        t.e[k] = ANY_WITHIN(limit);
        t.dx[k] = ANY_WITHIN(h);
        t.dy[k] = ANY_WITHIN(w);
    }
    t.x0 = 24;    /* windows from 24 pixels left to 39 right of it: only differences count */
    t.y0 = ANY_OF(8 - shade__min(h / 256, 16383), 8);
    any_floats(row_z, 8);
    shade__cover_column(&plan, &t, row_z, ANY_OF(0, 64 - width), 8, ANY_OF(1, 8),
                        ANY_OF(0, 32 - width), set, width, plain);
}
int main(void)
{
    prove_big(1);
    prove_big(2);
    prove_big(31);
    prove_big(1000);
    prove_big(16384);
    plan.depth = depth;
    plan.stride = 64;
    any_floats(depth, 64 * 16);
    t.z_dx = any_float();
    t.x_ref = any_float();
    t.z_low = any_float();
    t.z_high = any_float();
    plan.compare.less = any_mask();
    plan.compare.equal = any_mask();
    plan.compare.greater = any_mask();
    plan.compare.always = any_mask();
    plan.compare.write = any_mask();
    /*@ loop unroll 200; */
    for (int w = 1, wider, k = 0; w < 2 * FAR && most_height(w) > 0; w = wider, k++) {
        const int h = most_height(w);
        const double room = (2.14e9 - 4.0 * h) / (h / 64.0 + 8);    /* 4 w h / 256 below 2^31 */
        wider = room < w + 333 ? w + 333 : room < 2 * FAR ? (int)room : 2 * FAR;
        for (int positive = 0; positive < 2; positive++) {
            prove_small(wider, h, positive, 0);
            prove_small(wider, h, positive, 1);
        }
    }
    /*@ loop unroll 100; */
    for (int w = 1, wider, k = 0; w < 2 * FAR && most_height(w) > 0; w = wider, k++) {
        const int h = most_height(w);
        const double room = (2.14e9 - 42.0 * h) / (3.0 * h / 256 + 8);
        wider = room < w + 999 ? w + 999 : room < 2 * FAR ? (int)room : 2 * FAR;
        prove_column(wider, h, 8 + 8 * (k & 1), k >> 1 & 1);
    }
    return 0;
}
