/* setup.c - triangle setup of >>triangles: positions within 2^24, clip rectangles within 16384,
   depths and 1/w any floats. */
#define SHADE_LANES 128
#include "prove.h"

enum { N = SHADE__TRIANGLES, FAR = 1 << 24 };

static shade__packet p;
static double inverse[N];

static void any_packet(void)
{
    for (int k = 0; k < 3; k++) {
        any_ints(p.x[k], N, -FAR, FAR);
        any_ints(p.y[k], N, -FAR, FAR);
        any_floats(p.z[k], N);
        any_floats(p.rw[k], N);
    }
}
static void prove_areas(void)
{
    float area[N];
    uint32_t one[N], two[N], mirrored[N];
    shade__areas(&p, area, inverse);
    shade__turns(&p, area, one, two, mirrored);
    shade__turn(shade__words(p.z), one, two, mirrored);
    for (int i = 0; i < N; i++) {
        /*@ assert -2251799813685248. <= area[i] <= 2251799813685248.; */
        /*@ assert !(inverse[i] < 0); */
    }
}
static void prove_boxes(void)
{
    float w[N], h[N];
    int32_t fits[N];
    const int x0 = ANY_OF(0, 16384), x1 = ANY_OF(0, 16384);
    shade__box(p.x[0], p.x[1], p.x[2], x0, x1 - 1, p.box[0], p.box[2], w);
    shade__box(p.y[0], p.y[1], p.y[2], x0, x1 - 1, p.box[1], p.box[3], h);
    for (int i = 0; i < N; i++) {
        /*@ assert 0 <= p.box[0][i] <= 65536 && -65537 <= p.box[2][i] <= 16383; */
        /*@ assert -33554432 <= w[i] <= 33554432; */
    }
    shade__sizes(&p, w, h, fits);
    for (int i = 0; i < N; i++) {
        /*@ assert fits[i] == 0 || fits[i] == -1; */
    }
}
/* an edge that 32 bits do not hold */
static void prove_wide_edge(void)
{
    int32_t x0[N], y0[N], fits[N] = { 0 };
    int64_t wide[3];
    shade__triangle t;
    any_ints(x0, N, 0, 65536);
    any_ints(y0, N, 0, 65536);
    shade__edge(p.x[0], p.y[0], p.x[1], p.y[1], x0, y0, fits, p.e[0], p.dx[0], p.dy[0]);
    for (int k = 0; k < 3; k++) {
        t.dx[k] = ANY_WITHIN(2 * FAR);
        t.dy[k] = ANY_WITHIN(2 * FAR);
    }
    t.x0 = ANY_OF(0, 65536);
    t.y0 = ANY_OF(0, 65536);
    t.lane = ANY_OF(0, N - 1);
    shade__wide_edges(&p, &t, wide);
    for (int k = 0; k < 3; k++) {
        /*@ assert -17592186044416 <= wide[k] <= 17592186044416; */
    }
    for (int i = 0; i < N; i++) {
        /*@ assert p.e[0][i] == 0; */
        /*@ assert -2 * FAR <= p.dx[0][i] <= 2 * FAR && -2 * FAR <= p.dy[0][i] <= 2 * FAR; */
    }
}
/* edges that 32 bits hold, by the extents w, h of their triangles in steps: p within a
   pixel of the origin (only differences count), q and the box's corner no farther than w, h */
static void prove_edge(void)
{
    int32_t px[N], py[N], qx[N], qy[N], x0[N], y0[N], fits[N], e[N], dx[N], dy[N];
    int32_t other[N];
    for (int i = 0; i < N; i++) {
        px[i] = py[i] = qx[i] = qy[i] = x0[i] = y0[i] = 0;
        fits[i] = -1;
    }
    px[0] = ANY_OF(0, 255);
    py[0] = ANY_OF(0, 255);
    /*@ loop unroll 100; */
    for (int w = 1, wider; w < 2 * FAR; w = wider) {
        const double most = (2.7e11 * 1.00001 - 11264.0 * w) / (2.0 * w + 11264);
        const int h = most < 0 ? 0 : most > 2 * FAR ? 2 * FAR : (int)most;
        const double room = 1.3743e11 / (h + 600.0) - 600;    /* 2 w h below 2^38 */
        wider = room < w + 1000 ? w + 1000 : room < 2 * FAR ? (int)room : 2 * FAR;
        if (h < 2 * FAR) {    /* what is higher does not fit */
            float across[N] = { 1, 1, 1, 1 }, down[N] = { 1, 1, 1, 1 };
            across[0] = Frama_C_float_interval((float)w, (float)wider);
            down[0] = Frama_C_float_interval((float)h + 4, 2 * FAR);
            shade__sizes(&p, across, down, other);
            /*@ assert other[0] == 0; */
        }
        if (h == 0) break;
        qx[0] = ANY_OF(-wider, wider + 255);
        qy[0] = ANY_OF(-h, h + 255);
        x0[0] = ANY_OF((-wider - 128) / 256, (wider + 127) / 256);
        y0[0] = ANY_OF((-h - 128) / 256, (h + 127) / 256);
        shade__edge(px, py, qx, qy, x0, y0, fits, e, dx, dy);
        /*@ assert -1073741824 <= e[0] <= 1073741824; */
    }
}
static void prove_depth(void)
{
    float low[N], high[N];
    for (int i = 0; i < N; i++) {
        float f = any_float();
        inverse[i] = f;
    }
    shade__sides(&p, inverse);
    shade__depth_plane(&p, any_float(), p.z[0], p.z[1], p.z[2], low, high);
    for (int i = 0; i < N; i++) {
        /*@ assert 0 <= low[i] <= 1 && 0 <= high[i] <= 1; */
    }
}
static void prove_floors(void)
{
    int64_t v = Frama_C_long_long_interval(-0x3FFFFFFFFFFFFFFF, 0x3FFFFFFFFFFFFFFF);
    int64_t f = shade__floor256(v);
    /*@ assert -0x40000000000000 <= f <= 0x3FFFFFFFFFFFFF; */
    int32_t g = shade__floor256_32(ANY_WITHIN(0x3FFFFFFF));
    /*@ assert -0x400000 <= g <= 0x3FFFFF; */
}
/* corners of 1 .. N triangles among the vertices of a batch, and which are culled */
static void prove_corners(int stride)
{
    static shade__vertex vertex[SHADE_LANES];
    static float value[SHADE__BATCH_FLOATS];
    float area[N];
    uint32_t mirrored[N];
    const int last = shade__min(SHADE_LANES, SHADE__BATCH_FLOATS / stride) - 1;
    for (int i = 0; i < N; i++) {
        area[i] = any_float();
        mirrored[i] = any_mask();
        for (int k = 0; k < 4; k++)
            p.corner[i][k] = Frama_C_unsigned_char_interval(0, (unsigned char)last);
    }
    p.vertex = vertex;
    p.value = value;
    p.count = ANY_OF(1, N);
    shade__fetch_corners(&p, stride);
    int culled = shade__cull(&p, (shade_cull)ANY_OF(0, SHADE_CULL_FRONT), area, mirrored);
    /*@ assert 0 <= culled <= N; */
}
int main(void)
{
    prove_corners(8);
    prove_corners(SHADE__VALUES_MAX);
    any_packet();
    prove_areas();
    prove_boxes();
    prove_wide_edge();
    prove_depth();
    prove_edge();
    prove_floors();
    return 0;
}
