/* triangles.c - triangles from their indices to their edges.
   Each part is a driver of prove.sh. */

#ifdef PROVE_batch
/* Triangles taken into a batch: any indices, ranges of triangles one after the other
   wherever they lie, vertices of every width; then these vertices gathered. */
/* eva: -eva-slevel-function shade__take_triangles:200,shade__take_batch:200,shade__gather:400 */
#include "prove.h"

enum { TOP = INT32_MAX / 3 };    /* no draw has more triangles */

static shade__draw d;
static shade__supply supply;
static shade_pipeline pipe;

/* what shade__run_draw leaves to the first batch, or one batch to the next */
static void any_incoming(shade__incoming *in, int vertices)
{
    any_ints((int32_t *)in->ids.index, SHADE_LANES, INT32_MIN, INT32_MAX);
    for (int i = 0; i < 2 * SHADE_LANES; i++) {
        in->known[i] = Frama_C_unsigned_int_interval(0, UINT32_MAX);
        in->slot_of[i] = Frama_C_unsigned_char_interval(0, (unsigned char)(vertices - 1));
    }
}

/* the last triangles of a list, into the last corners that are free: both arrays end with them */
static void prove_take(int most, int room)
{
    static uint32_t list[3 * SHADE__BATCH_TRIANGLES];
    static uint8_t corner[SHADE__BATCH_TRIANGLES][4];
    const shade__indices wide = { list, NULL };
    const int first = SHADE__BATCH_TRIANGLES - most;
    int taken;
    any_incoming(&d.u.incoming, room + 3);
    memset(corner, 0, sizeof corner);
    any_ints((int32_t *)list, 3 * SHADE__BATCH_TRIANGLES, INT32_MIN, INT32_MAX);
    d.u.incoming.ids.count = ANY_OF(0, room);
    taken = shade__take_triangles(&d.u.incoming, wide, (uint32_t)first, most, room, corner + first);
    /*@ assert 0 <= taken <= most; */
    /*@ assert 0 <= d.u.incoming.ids.count <= room + 3; */
    for (int i = 0; i < 4 * SHADE__BATCH_TRIANGLES; i++) {
        /*@ assert corner[i / 4][i % 4] < room + 3; */
    }
    for (int i = 0; i < 2 * SHADE_LANES; i++) {
        /*@ assert d.u.incoming.slot_of[i] < room + 3; */
    }
}

/* another range wherever it lies; or none */
static int anywhere(shade__draw *to)
{
    to->supply->first = ANY_OF(0, TOP);
    to->supply->end = ANY_OF(0, TOP);
    return ANY_OF(0, 1);
}

static void prove_batch(int stride, int vertices)
{
    any_incoming(&d.u.incoming, vertices);
    d.supply = &supply;
    d.plan.value_stride = stride;
    supply.more = anywhere;
    anywhere(&d);
    shade__take_batch(&d);
    /*@ assert 0 <= d.u.incoming.ids.count <= vertices; */
    /*@ assert 0 <= d.batch.count <= SHADE__BATCH_TRIANGLES; */
    /*@ assert 0 <= d.batch.parts <= SHADE__PARTS; */
    /*@ assert d.setup.count == 0; */
}

/* as many vertices as there is room for: fewer touch less */
static void prove_gather(int varyings, int again, int divided)
{
    static shade_vertices vertices;
    static shade__projected placed;
    shade__plan *plan = &d.plan;
    plan->pipe = &pipe;
    plan->varyings = varyings;
    plan->values = varyings + SHADE__FIRST + again;
    plan->value_stride = (plan->values + 7) / 8 * 8;
    plan->first_divided = shade__min(divided, plan->values);
    pipe.lod_varying = ANY_OF(0, shade__max(varyings - 2, 0));
    shade__gather(plan, shade__min(SHADE_LANES, SHADE__BATCH_FLOATS / plan->value_stride),
                  &vertices, &placed, &d.batch);
    /*@ assert d.batch.corner[0][0] == 0; */
}

int main(void)
{
    for (int varyings = 0; varyings <= SHADE_MAX_VARYINGS; varyings++) {
        prove_gather(varyings, 0, SHADE__FIRST);
        prove_gather(varyings, 0, SHADE__VALUES_MAX);
        if (varyings > 1) prove_gather(varyings, 2, SHADE__VALUES_MAX);
    }
    for (int stride = 8; stride <= SHADE__VALUES_MAX; stride += 8) {
        const int vertices = shade__min(SHADE_LANES, SHADE__BATCH_FLOATS / stride);
        prove_take(0, vertices - 3);
        prove_take(1, vertices - 3);
        prove_take(SHADE__BATCH_TRIANGLES, vertices - 3);
        prove_batch(stride, vertices);
    }
    return 0;
}
#endif

#ifdef PROVE_project
/* Vertices to 24.8 fixed point, in two ways: the projection of every x, y within 3 w, w
   by octaves from 2^-60 to 2^100; and what is classified before it, any bits of x, y, z, w. */
/* eva: -eva-interprocedural-splits */
#include "prove.h"

static shade_vertices v;
static shade__projected p;

/* half the picture, from 1 to 16384 pixels; either convention of depth */
static double any_half(void) { return Frama_C_double_interval(128, 2097152); }

/* |c| <= 6 2^k, which is more than 3 w for 2^k <= w <= 2^(k + 1) */
static void prove_octave(int k)
{
    const uint32_t one = (uint32_t)(127 + k) << 23, six = ((uint32_t)(129 + k) << 23) + 0x400000u;
    const float w = float_of_bits(one, one + 0x800000u);
    const float c = Frama_C_float_interval(-shade__bits_float(six), shade__bits_float(six));
    const double half = any_half();
    const int32_t x = shade__snap(c, w, half, half), y = shade__snap(c, w, -half, half);
    /*@ assert -16777216 <= x <= 16777216 && -16777216 <= y <= 16777216; */
    const float rw = 1 / w;
    /*@ assert 0 < rw <= 1152921504606846976.; */
}

static void set(int lane, float x, float y, float w)
{
    v.clip[0][lane] = x;
    v.clip[1][lane] = y;
    v.clip[2][lane] = any_float();
    v.clip[3][lane] = w;
}

static void place(void)
{
    const int zero_to_one = ANY_OF(0, 1);
    const double half_width = any_half(), half_height = any_half();
    shade__classify(&v, zero_to_one, &p);
    shade__project(half_width, half_height, zero_to_one, &p);
    for (int i = 0; i < SHADE_LANES; i++) {
        /*@ assert -16777216 <= p.x_fx8[i] <= 16777216 && -16777216 <= p.y_fx8[i] <= 16777216; */
        /*@ assert 0 < p.rw[i] <= 1152921504606846976.; */
        /*@ assert 0 <= p.out[i] < 4096; */
    }
}

/* both together: x and y beyond 3 w in some lanes, in the last perhaps */
static void prove_both(int k)
{
    const uint32_t one = (uint32_t)(127 + k) << 23, six = ((uint32_t)(129 + k) << 23) + 0x400000u;
    const float w = float_of_bits(one, one + 0x800000u), far = float_of_bits(six + 1, 0x7F800000u);
    const float near = Frama_C_float_interval(1e-30f, shade__bits_float(six));
    set(0, far, any_float(), w);
    set(1, -far, any_float(), w);
    set(2, any_float(), far, w);
    set(3, any_float(), -far, w);
    set(4, any_float(), any_float(), float_of_bits(0, 0x217FFFFFu));              /* < 2^-60 */
    set(5, any_float(), any_float(), -shade__w_least);
    set(6, any_float(), any_float(), float_of_bits(0x71800000u, 0x7F800000u));    /* from 2^100 */
    set(7, near, -near, w);
    place();
    set(7, -near, near, w);
    place();
}

int main(void)
{
    for (int k = -60; k < 100; k++) prove_octave(k);
    prove_both(-60);
    prove_both(0);
    prove_both(99);
    for (int i = 0; i < SHADE_LANES; i++)
        set(i, any_float(), any_float(), any_float());
    shade__classify(&v, ANY_OF(0, 1), &p);
    return 0;
}
#endif

#ifdef PROVE_clip
/* Clipping: polygons of every size against each plane, with corners anywhere; corners of
   what is left on the screen; the fan. */
#define SHADE_LANES 128
#include "prove.h"

static shade__polygon p;
static shade__plan plan;

static void any_polygon(void)
{
    for (int i = 0; i < SHADE__CLIP_VERTICES; i++) {
        for (int k = 0; k < 4; k++)    /* what is farther is rejected before */
            p.vertex[i].clip[k] = Frama_C_float_interval(-1e31f, 1e31f);
        p.vertex[i].x = ANY_WITHIN(1 << 24);
        p.vertex[i].y = ANY_WITHIN(1 << 24);
        p.corner[i] = Frama_C_unsigned_char_interval(0, SHADE__CLIP_VERTICES - 1);
    }
    any_floats(p.value, SHADE__CLIP_VERTICES * SHADE__VALUES_MAX);
    p.in_front = ANY_OF(0, 1);
    p.taken = Frama_C_unsigned_int_interval(1, (1u << SHADE__CLIP_VERTICES) - 1);
    plan.values = plan.value_stride = SHADE__VALUES_MAX;
    plan.first_divided = ANY_OF(SHADE__FIRST, SHADE__VALUES_MAX);
    plan.zero_to_one = ANY_OF(0, 1);
    plan.half_width = Frama_C_float_interval(128, 2097152);
    plan.half_height = Frama_C_float_interval(128, 2097152);
}

static void prove_plane(uint32_t plane)
{
    p.count = ANY_OF(0, SHADE__CLIP_VERTICES);
    shade__clip_plane(&plan, &p, plane);
    /*@ assert 0 <= p.count <= SHADE__CLIP_VERTICES; */
    for (int i = 0; i < SHADE__CLIP_VERTICES; i++) {
        /*@ assert p.corner[i] < SHADE__CLIP_VERTICES; */
    }
}

/* the window position of a corner, w by octaves from 2^-60 to 2^100, and where it is too small */
static void prove_place(float w)
{
    for (int k = 0; k < 3; k++)
        p.vertex[12].clip[k] = Frama_C_float_interval(-1e32f, 1e32f);
    p.vertex[12].clip[3] = w;
    shade__polygon_to_window(&plan, &p);
    /*@ assert -16777216 <= p.vertex[12].x <= 16777216; */
    /*@ assert -16777216 <= p.vertex[12].y <= 16777216; */
}

static void prove_fan(int count)
{
    p.count = count;
    const int64_t area = shade__fan_area(&p, ANY_OF(0, count - 1), ANY_OF(1, count - 2));
    /*@ assert -2251799813685248 <= area <= 2251799813685248; */
    p.area = area;
    const int apex = shade__apex(&p);
    /*@ assert 0 <= apex < count; */
}

int main(void)
{
    any_polygon();
    for (int count = 3; count <= SHADE__CLIP_VERTICES; count++) prove_fan(count);
    for (uint32_t plane = SHADE__OUT_NEAR; plane <= SHADE__OUT_W; plane *= 2) prove_plane(plane);
    p.count = 1;
    p.corner[0] = 12;
    for (int k = -60; k < 100; k++) {
        const uint32_t one = (uint32_t)(127 + k) << 23;
        prove_place(float_of_bits(one, one + 0x800000u));
    }
    prove_place(float_of_bits(0, 0x217FFFFFu));
    prove_place(float_of_bits(0x80000000u, 0xFF7FFFFFu));
    return 0;
}
#endif

#ifdef PROVE_setup
/* Triangle setup of >>triangles: positions within 2^24, clip rectangles within 16384,
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
    for (int k = 0; k < 3; k++) shade__make_edge(&c, k, &s);
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
#endif
