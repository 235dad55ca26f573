/* setup.c - triangle setup of >>triangles: positions within 2^24, clip rectangles within 16384,
   depths and 1/w any floats. */
#define SHADE_LANES 128
#include "prove.h"

enum { N = SHADE__TRIANGLES, FAR = 1 << 24 };

static shade__setup s;
static shade__corner_rows c, turned;
static shade__turns turns;
static double inverse[N];

static void any_corners(void)
{
    for (int k = 0; k < 3; k++) {
        any_ints(c.x[k], N, -FAR, FAR);
        any_ints(c.y[k], N, -FAR, FAR);
        any_floats(c.z[k], N);
        any_floats(c.rw[k], N);
    }
}

static void prove_areas(void)
{
    float area[N];
    uint32_t order[N];
    shade__areas(&c, area, inverse);
    shade__choose_turns(&c, area, &turns, order);
    shade__turn(shade__words(c.z), &turns, shade__words(turned.z));
    for (int i = 0; i < N; i++) {
        /*@ assert -2251799813685248. <= area[i] <= 2251799813685248.; */
        /*@ assert !(inverse[i] < 0); */
        /*@ assert order[i] <= 6; */
    }
}

static void prove_boxes(void)
{
    const int x0 = ANY_OF(0, 16384), x1 = ANY_OF(0, 16384);
    shade__box(c.x, x0, x1 - 1, s.x0, s.x1);
    shade__box(c.y, x0, x1 - 1, s.y0, s.y1);
    for (int i = 0; i < N; i++) {
        /*@ assert 0 <= s.x0[i] <= 65536 && -65537 <= s.x1[i] <= 16383; */
    }
}

/* edges at any corner of a box */
static void prove_edges(void)
{
    any_ints(s.x0, N, 0, 65536);
    any_ints(s.y0, N, 0, 65536);
    for (int k = 0; k < 3; k++) shade__edge(&c, k, &s);
    for (int k = 0; k < 3; k++) {
        for (int i = 0; i < N; i++) {
            /*@ assert -2 * FAR <= s.ex[k][i] <= 2 * FAR && -2 * FAR <= s.ey[k][i] <= 2 * FAR; */
        }
    }
}

static void prove_depth(void)
{
    for (int i = 0; i < N; i++) {
        float f = any_float();
        inverse[i] = f;
    }
    shade__sides(&c, inverse, &s);
    shade__depth_plane(&c, any_float(), &s);
    for (int i = 0; i < N; i++) {
        /*@ assert 0 <= s.z_low[i] <= 1 && 0 <= s.z_high[i] <= 1; */
    }
}

static void prove_floors(void)
{
    const int32_t f = shade__floor256(ANY_WITHIN(0x3FFFFFFF));
    /*@ assert -0x400000 <= f <= 0x3FFFFF; */
}

/* corners of 1 .. N triangles among the vertices of a batch, and which are culled */
static void prove_corners(int stride)
{
    static shade__vertex vertex[SHADE_LANES];
    static float value[SHADE__BATCH_FLOATS];
    float area[N];
    const int last = shade__min(SHADE_LANES, SHADE__BATCH_FLOATS / stride) - 1;
    for (int i = 0; i < N; i++) {
        area[i] = any_float();
        for (int k = 0; k < 4; k++)
            s.corner[i][k] = Frama_C_unsigned_char_interval(0, (unsigned char)last);
    }
    s.vertex = vertex;
    s.value = value;
    s.count = ANY_OF(1, N);
    shade__fetch_corners(&s, stride, &c);
    int culled = shade__cull(&s, (shade_cull)ANY_OF(0, SHADE_CULL_FRONT), area);
    /*@ assert 0 <= culled <= N; */
}

int main(void)
{
    prove_corners(8);
    prove_corners(SHADE__VALUES_MAX);
    any_corners();
    prove_areas();
    prove_boxes();
    prove_edges();
    prove_depth();
    prove_floors();
    return 0;
}
