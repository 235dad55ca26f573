/* packets.c - triangles and fragments keep to themselves, whatever lane of a packet they are in:
   setup beside a scalar oracle in 64-bit integers and doubles, and the queue of fragments at every
   fill, for runs of every length. */
#include "unit.h"

enum {
    PACKETS_MOST = SHADE_LANES / 3, /* triangles whose vertices fill a batch */
    PACKETS_VALUES = 3,
    PACKETS_WIDTH = 40,
    PACKETS_HEIGHT = 24, /* of the window that is looked at */
    PACKETS_PIXELS = PACKETS_WIDTH * PACKETS_HEIGHT,
    PACKETS_HUGE = 16384 /* side of a picture of which a window is drawn */
};

/* what becomes of a triangle, from FLAT on nothing; CUT are clipped near or at the guard band */
typedef enum packets_kind {
    PACKETS_TINY,
    PACKETS_SMALL,
    PACKETS_LARGE,
    PACKETS_LATTICE,
    PACKETS_UPRIGHT,
    PACKETS_SLIVER,
    PACKETS_HAIR,
    PACKETS_ACROSS,
    PACKETS_CUT_GUARD,
    PACKETS_CUT_NEAR,
    PACKETS_FLAT,
    PACKETS_OUTSIDE,
    PACKETS_NO_NUMBER,
    PACKETS_KINDS
} packets_kind;

typedef struct packets_triangle {
    packets_kind kind;
    int64_t x[3], y[3]; /* snapped corners of those that are not cut */
    shade_vec4 clip[3];
    float value[3 * PACKETS_VALUES];
    int front;
    ref_triangle place, flat; /* of those that are cut: as they are, and on the screen */
} packets_triangle;

/* A picture and the window of it that is drawn. */
typedef struct packets_view {
    canvas c;
    int x0, y0, zero_to_one;
} packets_view;

static int packets_is_cut(const packets_triangle *t)
{
    return t->kind == PACKETS_CUT_GUARD || t->kind == PACKETS_CUT_NEAR;
}

static int64_t packets_area(const packets_triangle *t) /* twice; above 0 clockwise as seen */
{
    return (t->x[1] - t->x[0]) * (t->y[2] - t->y[0]) - (t->x[2] - t->x[0]) * (t->y[1] - t->y[0]);
}

static int64_t packets_within(int64_t v, int size) /* the guard band */
{
    const int64_t low = -(int64_t)size * 255, high = (int64_t)size * 511;
    return v < low ? low : v > high ? high : v;
}

/* Corners on the 1/256 grid, in or across the window. */
static void packets_corners(packets_triangle *t, const packets_view *v)
{
    static const int shapes[] = { 0, 1, 2, 3, 4, 5, 5 }; /* of random_corners */
    const int width = v->c.target.width, height = v->c.target.height;
    const int in_x = v->x0 * 256 + rnd_int(0, PACKETS_WIDTH * 256);
    const int in_y = v->y0 * 256 + rnd_int(0, PACKETS_HEIGHT * 256);
    if (t->kind == PACKETS_ACROSS) { /* an edge through the window, a corner anywhere */
        const double angle = 6.3 * rnd_unit(), there = (double)rnd_log(256, 512.0 * width);
        const double back = (double)rnd_log(256, 512.0 * width);
        t->x[0] = in_x + (int64_t)(cos(angle) * there);
        t->y[0] = in_y + (int64_t)(sin(angle) * there);
        t->x[1] = in_x - (int64_t)(cos(angle) * back) + rnd_int(-300, 300);
        t->y[1] = in_y - (int64_t)(sin(angle) * back) + rnd_int(-300, 300);
        t->x[2] = rnd_int(-width * 255, width * 511);
        t->y[2] = rnd_int(-height * 255, height * 511);
        if (rnd_one_in(4)) {
            t->x[2] = t->x[0] + rnd_int(-2, 2);
            t->y[2] = t->y[0] + rnd_int(-2, 2);
        }
        if (rnd_one_in(4)) t->y[1] = t->y[0];
        if (rnd_one_in(4)) t->x[2] = t->x[0];
    } else {
        random_corners(shapes[t->kind > PACKETS_HAIR ? 1 : t->kind], PACKETS_WIDTH, PACKETS_HEIGHT,
                       t->x, t->y);
        for (int k = 0; k < 3; k++) {
            t->x[k] += v->x0 * 256;
            t->y[k] += v->y0 * 256;
        }
    }
    if (t->kind == PACKETS_HAIR) {
        t->x[2] = t->x[0] + rnd_int(-2, 2);
        t->y[2] = t->y[0] + rnd_int(-2, 2);
    }
    for (int k = 0; k < 3; k++) {
        t->x[k] = packets_within(t->x[k], width);
        t->y[k] = packets_within(t->y[k], height);
    }
    if (t->kind == PACKETS_FLAT) {
        const int64_t half_x = (t->x[1] - t->x[0]) / 2, half_y = (t->y[1] - t->y[0]) / 2;
        const int same = rnd_int(0, 2);
        t->x[1] = t->x[0] + 2 * half_x;
        t->y[1] = t->y[0] + 2 * half_y;
        t->x[2] = t->x[0] + same * half_x;
        t->y[2] = t->y[0] + same * half_y;
        if (rnd_one_in(4)) {
            t->x[0] = t->x[1] = t->x[2];
            t->y[0] = t->y[1] = t->y[2];
        }
    }
}

/* Corners of which one lies beyond the guard band, or one or two before the near plane. */
static void packets_cut_corners(packets_triangle *t, const packets_view *v)
{
    double X[3], Y[3];
    do {
        for (int k = 0; k < 3; k++) {
            const double w = rnd_one_in(2) ? 1 : (double)rnd_log(0.5, 2);
            const double low = v->zero_to_one ? 0 : -1;
            double z = (double)rnd_float(low + 0.02, 0.98);
            X[k] = (double)rnd_float(-0.9, 0.9);
            Y[k] = (double)rnd_float(-0.9, 0.9);
            if (t->kind == PACKETS_CUT_GUARD && k == 0)
                *(rnd_one_in(2) ? X : Y) = (double)(rnd_sign() * rnd_float(3.1, 6));
            if (t->kind == PACKETS_CUT_NEAR && (k == 0 || (k == 1 && rnd_one_in(2))))
                z = low - (double)rnd_float(0.1, 1);
            t->clip[k] = shade_v4((float)(X[k] * w), (float)(Y[k] * w), (float)(z * w), (float)w);
        }
    } while (fabs((X[1] - X[0]) * (Y[2] - Y[0]) - (X[2] - X[0]) * (Y[1] - Y[0])) < 0.1);
}

static void packets_random(packets_triangle *t, packets_kind kind, const packets_view *v)
{
    const int width = v->c.target.width, height = v->c.target.height;
    const double least = v->zero_to_one ? 0.01 : -0.98;
    const double w_range = rnd_one_in(3) ? 1 : (double)rnd_log(1, 50);
    shade_vec4 flat[3];
    memset(t, 0, sizeof *t);
    t->kind = kind;
    for (int k = 0; k < 3 * PACKETS_VALUES; k++) t->value[k] = rnd_float(-1, 1);
    if (packets_is_cut(t)) {
        packets_cut_corners(t, v);
        for (int k = 0; k < 3; k++) {
            const shade_vec4 p = t->clip[k];
            flat[k] = shade_v4(p.x / p.w, p.y / p.w, p.z / p.w, 1);
        }
        CHECK(ref_triangle_of(&t->place, &t->clip[0], &t->clip[1], &t->clip[2], width, height));
        CHECK(ref_triangle_of(&t->flat, &flat[0], &flat[1], &flat[2], width, height));
        t->front = t->place.front;
        return;
    }
    do packets_corners(t, v);
    while (kind < PACKETS_FLAT && packets_area(t) == 0);
    for (int k = 0; k < 3; k++) {
        const double w = (double)rnd_log(1 / w_range, w_range), z = (double)rnd_float(least, 0.98);
        t->clip[k] = clip_of_fx8((double)t->x[k], (double)t->y[k], width, height, z, w);
        if (kind == PACKETS_OUTSIDE) t->clip[k].x = t->clip[k].w * rnd_float(1.1, 9);
    }
    if (kind == PACKETS_NO_NUMBER) {
        static const float none[] = { (float)NAN, (float)INFINITY, -(float)INFINITY, 1e31f };
        float *component = &t->clip[rnd_int(0, 2)].x + rnd_int(0, 3);
        *component = none[rnd_int(0, 3)];
    }
    t->front = packets_area(t) < 0;
}

/* ---------------------------------------------------------------------------- the scalar oracle */

/* 2^-24: half a step of a float at 1 */
static const double packets_half_step = 5.96046448e-8;

/* The sizes of all that is added up for a plane's value at pixel (i, j), from corner r on: slopes
   d1 y2 - d2 y1 and d2 x1 - d1 x2 over the area, times the distance. */
static double packets_sizes(const packets_triangle *t, const double v[3], int r, int i, int j)
{
    const int a = (r + 1) % 3, b = (r + 2) % 3;
    const double per_pixel = 256 / fabs((double)packets_area(t));
    const double d1 = v[a] - v[r], d2 = v[b] - v[r];
    const double x1 = (double)(t->x[a] - t->x[r]) * per_pixel;
    const double y1 = (double)(t->y[a] - t->y[r]) * per_pixel;
    const double x2 = (double)(t->x[b] - t->x[r]) * per_pixel;
    const double y2 = (double)(t->y[b] - t->y[r]) * per_pixel;
    const double px = i + 0.5 - (double)t->x[r] / 256, py = j + 0.5 - (double)t->y[r] / 256;
    return (fabs(d1 * y2) + fabs(d2 * y1)) * fabs(px) + (fabs(d2 * x1) + fabs(d1 * x2)) * fabs(py) +
           fmax(fabs(v[0]), fmax(fabs(v[1]), fabs(v[2])));
}

/* The value of the plane through v at the corners, at pixel (i, j) inside.  *error: what eight
   roundings to float make of it, where the plane is taken from the corner with the least 1/w. */
static double packets_plane(const packets_triangle *t, const double v[3], int i, int j,
                            double *error)
{
    const int64_t px = (int64_t)i * 256 + 128, py = (int64_t)j * 256 + 128;
    double sum = 0, sizes = 0;
    float least = 1 / t->clip[0].w;
    for (int k = 1; k < 3; k++) least = 1 / t->clip[k].w < least ? 1 / t->clip[k].w : least;
    for (int k = 0; k < 3; k++) {
        const int a = (k + 1) % 3, b = (k + 2) % 3;
        const int64_t e =
            (t->x[b] - t->x[a]) * (py - t->y[a]) - (t->y[b] - t->y[a]) * (px - t->x[a]);
        sum += (double)e / (double)packets_area(t) * v[k];
        if (1 / t->clip[k].w == least) sizes = fmax(sizes, packets_sizes(t, v, k, i, j));
    }
    *error = 8 * packets_half_step * sizes;
    return sum;
}

static double packets_unit(double v) { return v > 0 ? (v < 1 ? v : 1) : 0; }

/* Depth, to *error, of a triangle that is not cut; it never leaves the range of its corners. */
static double packets_depth(const packets_triangle *t, const packets_view *v, float bias, int i,
                            int j, double *error)
{
    double z[3];
    for (int k = 0; k < 3; k++) {
        z[k] = (double)t->clip[k].z / (double)t->clip[k].w;
        if (!v->zero_to_one) z[k] = (z[k] + 1) / 2;
    }
    const double plane = packets_plane(t, z, i, j, error) + (double)bias;
    *error += 2 * packets_half_step;
    return packets_unit(plane);
}

static double packets_value(const packets_triangle *t, shade_interpolation how, int n, int i, int j,
                            double *error)
{
    double u[3], rw[3], up, down, up_error, down_error, least, value;
    for (int k = 0; k < 3; k++) {
        rw[k] = how == SHADE_INTERPOLATION_AFFINE ? 1 : 1 / (double)t->clip[k].w;
        u[k] = (double)t->value[PACKETS_VALUES * k + n] * rw[k];
    }
    up = packets_plane(t, u, i, j, &up_error);
    if (how == SHADE_INTERPOLATION_AFFINE) {
        *error = up_error;
        return up;
    }
    down = packets_plane(t, rw, i, j, &down_error);
    value = up / down;
    least = fmax(down - down_error, fmin(rw[0], fmin(rw[1], rw[2])));
    *error = (up_error + fabs(value) * down_error) / least + 4 * packets_half_step * fabs(value);
    return value;
}

/* The same of a triangle that is cut, whose new corners snapping moves: within what the value
   changes on 1/64 pixel. */
static double packets_cut_value(const packets_triangle *t, const packets_view *v, int depth,
                                shade_interpolation how, int n, double X, double Y)
{
    const float *value = t->value + n;
    if (depth) return ref_depth(&t->place, X, Y, v->zero_to_one);
    return ref_interpolate(how == SHADE_INTERPOLATION_AFFINE ? &t->flat : &t->place, X, Y,
                           (double)value[0], (double)value[PACKETS_VALUES],
                           (double)value[2 * PACKETS_VALUES]);
}

static double packets_cut_change(const packets_triangle *t, const packets_view *v, int depth,
                                 shade_interpolation how, int n, double X, double Y)
{
    const double here = packets_cut_value(t, v, depth, how, n, X, Y);
    double most = 0;
    for (int k = 0; k < 4; k++) {
        const double x = k & 1 ? 1 / 64.0 : -1 / 64.0, y = k & 2 ? 1 / 64.0 : -1 / 64.0;
        most = fmax(most, fabs(packets_cut_value(t, v, depth, how, n, X + x, Y + y) - here));
    }
    return most + 1e-5;
}

/* 1 inside, 0 outside, -1: as snapping has it */
static int packets_inside(const packets_triangle *t, const packets_view *v, int i, int j)
{
    if (t->kind >= PACKETS_FLAT) return 0;
    if (!packets_is_cut(t)) return ref_inside_fx8(t->x, t->y, i, j);
    return ref_covers(&t->place, i + 0.5, j + 0.5, 1 / 64.0, 1, v->zero_to_one);
}

/* ------------------------------------------------------------------------- packets of triangles */

typedef struct packets_draw {
    packets_triangle triangle[PACKETS_MOST];
    shade_vec4 clip[3 * PACKETS_MOST];
    float attribute[3 * PACKETS_VALUES * PACKETS_MOST];
    int count;
    int32_t at[PACKETS_MOST][PACKETS_PIXELS]; /* record of a triangle at a pixel, or -1 */
    recorder first, second;
} packets_draw;

static void packets_fill(packets_draw *d, int count, int probe, packets_kind kind,
                         const packets_view *v)
{
    d->count = count;
    for (int k = 0; k < count; k++) {
        packets_triangle *t = &d->triangle[k];
        packets_kind other = (packets_kind)rnd_int(0, PACKETS_KINDS - 1);
        /* what is cut ends a packet: few are, and none before the one that is looked at */
        if ((other == PACKETS_CUT_GUARD || other == PACKETS_CUT_NEAR) &&
            (k < probe || !rnd_one_in(4)))
            other = PACKETS_TINY;
        packets_random(t, k == probe ? kind : other, v);
        memcpy(d->clip + 3 * k, t->clip, sizeof t->clip);
        memcpy(d->attribute + 3 * PACKETS_VALUES * k, t->value, sizeof t->value);
    }
}

/* One fragment beside the oracle of its triangle. */
static void packets_check_fragment(const packets_triangle *t, const packets_view *v,
                                   const shade_pipeline *p, const fragment_record *f)
{
    const int i = (int)floorf(f->x), j = (int)floorf(f->y);
    const float bias = p->raster.depth_bias;
    double want, error;
    CHECK(f->x == (float)i + 0.5f && f->y == (float)j + 0.5f);
    CHECK_INT(f->front, t->front);
    if (packets_is_cut(t)) {
        const double X = (double)f->x, Y = (double)f->y;
        const double z = packets_cut_value(t, v, 1, p->interpolation, 0, X, Y) + (double)bias;
        CHECK_NEAR(f->z, packets_unit(z), packets_cut_change(t, v, 1, p->interpolation, 0, X, Y));
    } else {
        want = packets_depth(t, v, bias, i, j, &error);
        CHECK_NEAR(f->z, want, error);
    }
    for (int n = 0; n < PACKETS_VALUES; n++) {
        if (p->interpolation == SHADE_INTERPOLATION_CONSTANT) {
            want = (double)t->value[n];
            error = 0;
        } else if (packets_is_cut(t)) {
            const double X = (double)f->x, Y = (double)f->y;
            want = packets_cut_value(t, v, 0, p->interpolation, n, X, Y);
            error = packets_cut_change(t, v, 0, p->interpolation, n, X, Y);
        } else {
            want = packets_value(t, p->interpolation, n, i, j, &error);
        }
        CHECK_NEAR(f->in[n], want, error);
    }
}

/* All fragments of a draw that hides nothing: those of the oracle, each once. */
static void packets_check_all(packets_draw *d, const packets_view *v, const shade_pipeline *p)
{
    const shade_cull cull = p->raster.cull;
    memset(d->at, 0xFF, sizeof d->at);
    for (int k = 0; k < d->first.count; k++) {
        const fragment_record *f = &d->first.fragments[k];
        const int i = (int)floorf(f->x) - v->x0, j = (int)floorf(f->y) - v->y0;
        int32_t *at;
        if (f->primitive >= (uint32_t)d->count || i < 0 || i >= PACKETS_WIDTH || j < 0 ||
            j >= PACKETS_HEIGHT) {
            CHECK_SAY(0, "primitive %u at %g %g", f->primitive, (double)f->x, (double)f->y);
            continue;
        }
        at = &d->at[f->primitive][j * PACKETS_WIDTH + i];
        CHECK_INT(*at, -1);
        *at = k;
        packets_check_fragment(&d->triangle[f->primitive], v, p, f);
    }
    for (int k = 0; k < d->count; k++) {
        const packets_triangle *t = &d->triangle[k];
        const int culled = cull == (t->front ? SHADE_CULL_FRONT : SHADE_CULL_BACK);
        int wrong = 0, wx = 0, wy = 0;
        for (int n = 0; n < PACKETS_PIXELS; n++) {
            const int i = v->x0 + n % PACKETS_WIDTH, j = v->y0 + n / PACKETS_WIDTH;
            const int want = culled ? 0 : packets_inside(t, v, i, j);
            if (want >= 0 && want != (d->at[k][n] >= 0)) {
                wrong++;
                wx = i;
                wy = j;
            }
        }
        CHECK_SAY(wrong == 0, "triangle %d of %d, kind %d: %d pixels, one of them %d %d", k,
                  d->count, (int)t->kind, wrong, wx, wy);
    }
}

/* The same draw with a test that hides: what passes has the bits it has in the first. */
static void packets_check_hidden(packets_draw *d, const packets_view *v, const shade_pipeline *p,
                                 float clear)
{
    static float depth[PACKETS_PIXELS];
    static unsigned char passed[PACKETS_MOST][PACKETS_PIXELS];
    long expected = 0;
    memset(passed, 0, sizeof passed);
    for (int n = 0; n < PACKETS_PIXELS; n++) depth[n] = clear;
    for (int k = 0; k < d->count; k++) {
        for (int n = 0; n < PACKETS_PIXELS; n++) {
            const int32_t at = d->at[k][n];
            const float z = at < 0 ? 0 : d->first.fragments[at].z;
            const int nearer =
                p->raster.depth_test == SHADE_COMPARE_LESS ? z < depth[n] : z >= depth[n];
            if (at < 0 || !nearer) continue;
            depth[n] = z;
            passed[k][n] = 1;
            expected++;
        }
    }
    CHECK_INT(d->second.count, expected);
    for (int k = 0; k < d->second.count; k++) {
        const fragment_record *f = &d->second.fragments[k];
        const int i = (int)floorf(f->x) - v->x0, j = (int)floorf(f->y) - v->y0;
        const int n = j * PACKETS_WIDTH + i;
        const int known = f->primitive < (uint32_t)d->count && n >= 0 && n < PACKETS_PIXELS &&
                          passed[f->primitive][n];
        CHECK(known);
        if (!known) continue;
        const fragment_record *same = &d->first.fragments[d->at[f->primitive][n]];
        passed[f->primitive][n] = 0;
        CHECK(f->front == same->front && float_bits(f->z) == float_bits(same->z));
        for (int m = 0; m < PACKETS_VALUES; m++)
            CHECK(float_bits(f->in[m]) == float_bits(same->in[m]));
    }
    for (int n = 0; n < PACKETS_PIXELS; n++)
        CHECK(float_bits(canvas_depth(&v->c, v->x0 + n % PACKETS_WIDTH,
                                      v->y0 + n / PACKETS_WIDTH)) == float_bits(depth[n]));
}

/* All corners beyond one side of the picture. */
static int packets_is_outside(const packets_triangle *t)
{
    int left = 1, right = 1, below = 1, above = 1;
    for (int k = 0; k < 3; k++) {
        const shade_vec4 p = t->clip[k];
        left &= p.x < -p.w;
        right &= p.x > p.w;
        below &= p.y < -p.w;
        above &= p.y > p.w;
    }
    return left || right || below || above;
}

static void packets_check_stats(const packets_draw *d, const shade_stats *got, shade_cull cull)
{
    int culled = 0, clipped = 0, rejected = 0;
    for (int k = 0; k < d->count; k++) {
        const packets_triangle *t = &d->triangle[k];
        const int faces_away = cull == (t->front ? SHADE_CULL_FRONT : SHADE_CULL_BACK);
        if (t->kind == PACKETS_NO_NUMBER)
            rejected++;
        else if (packets_is_outside(t))
            clipped++;
        else
            culled += t->kind == PACKETS_FLAT || faces_away;
    }
    CHECK_INT(got->culled, culled);
    CHECK_INT(got->clipped, clipped);
    CHECK_INT(got->rejected, rejected);
    CHECK_INT(got->drawn, d->count - culled - clipped - rejected);
}

/* A batch of count triangles, the one at probe of a kind, drawn with nothing hidden, by spans or by
   columns of pixels; and once more with what is nearer in front. */
static void packets_check_batch(packets_draw *d, packets_view *v, int count, int probe,
                                packets_kind kind)
{
    scene s = { d->clip, d->attribute, PACKETS_VALUES, NULL, &d->first };
    shade_pipeline p = scene_pipeline(&s);
    shade_stats stats;
    float *depth = v->c.target.depth;
    v->zero_to_one = rnd_int(0, 1);
    packets_fill(d, count, probe, kind, v);
    p.interpolation = (shade_interpolation)rnd_int(0, 2);
    p.raster.cull = (shade_cull)rnd_int(0, 2);
    p.raster.depth_zero_to_one = v->zero_to_one;
    p.raster.depth_test = SHADE_COMPARE_ALWAYS;
    if (rnd_one_in(4)) p.raster.depth_bias = rnd_float(-0.3, 0.3);
    d->first.count = d->second.count = 0;
    if (rnd_one_in(2)) v->c.target.depth = NULL;
    stats = canvas_draw(&v->c, &p, 3 * count);
    CHECK_INT(stats.fragments, d->first.count);
    packets_check_stats(d, &stats, p.raster.cull);
    packets_check_all(d, v, &p);
    v->c.target.depth = depth;
    s.record = &d->second;
    p.raster.depth_test = rnd_one_in(3) ? SHADE_COMPARE_GREATER_EQUAL : SHADE_COMPARE_LESS;
    canvas_clear(&v->c, 0.75f);
    stats = canvas_draw(&v->c, &p, 3 * count);
    CHECK_INT(stats.fragments, d->second.count);
    packets_check_hidden(d, v, &p, 0.75f);
    CHECK_INT(d->first.bad_counts + d->second.bad_counts, 0);
    CHECK_INT(d->first.bad_tails + d->second.bad_tails, 0);
}

static void packets_check_lanes(packets_view *v, int each)
{
    static packets_draw d;
    d.first = recorder_open(PACKETS_MOST * PACKETS_PIXELS);
    d.second = recorder_open(PACKETS_MOST * PACKETS_PIXELS);
    for (int kind = 0; kind < (int)PACKETS_KINDS; kind++)
        for (int probe = rnd_int(0, each - 1); probe < PACKETS_MOST; probe += each)
            packets_check_batch(&d, v, rnd_int(probe + 1, PACKETS_MOST), probe, (packets_kind)kind);
    free(d.first.fragments);
    free(d.second.fragments);
}

/* All kinds, each at all places of a batch, between others. */
TEST(packets, every_lane_sets_up_every_kind_of_triangle)
{
    packets_view v = { 0 };
    v.c = canvas_open(PACKETS_WIDTH, PACKETS_HEIGHT, 0, SHADE_FORMAT_RGBA8, 1);
    packets_check_lanes(&v, 1);
    canvas_close(&v.c);
}

/* Edges of up to 49000 pixels through a window, beside triangles that 32 bits hold. */
TEST(packets, every_lane_sets_up_triangles_as_big_as_there_are)
{
    for (int round = 0; round < 4; round++) {
        const int y = rnd_int(0, PACKETS_HUGE - PACKETS_HEIGHT);
        packets_view v;
        v.c = canvas_strip(PACKETS_HUGE, PACKETS_HUGE, 0, SHADE_FORMAT_RGBA8, 1, y, PACKETS_HEIGHT);
        v.x0 = rnd_int(0, PACKETS_HUGE - PACKETS_WIDTH);
        v.y0 = y;
        v.zero_to_one = 0;
        v.c.target.clip_x = v.x0;
        v.c.target.clip_width = PACKETS_WIDTH;
        v.c.target.clip_y = v.y0;
        v.c.target.clip_height = PACKETS_HEIGHT;
        packets_check_lanes(&v, 3);
        canvas_close(&v.c);
    }
}

/* -------------------------------------------------------------------------- the queue of pixels */

enum {
    PACKETS_ROWS = PACKETS_MOST < 24 ? PACKETS_MOST : 24, /* triangles, a row of pixels each */
    PACKETS_LONGEST = 2 * SHADE_LANES + 9,
    PACKETS_ROW = PACKETS_LONGEST + 40
};
typedef struct packets_queue {
    packets_view view;
    packets_triangle triangle[PACKETS_ROWS];
    int x[PACKETS_ROWS], length[PACKETS_ROWS];
    unsigned char hole[PACKETS_ROWS][PACKETS_ROW]; /* where the depth test fails */
    int count, pixels;                             /* that pass */
    int flat;                                      /* w is 1, and row % 8 the level of detail */
    recorder record;
} packets_queue;

/* A triangle that covers the pixels of one row from x on: its base, half a pixel above and below
   the centres, at one end, the apex at the other. */
static void packets_add_run(packets_queue *q, int pass, int holes)
{
    const int row = q->count++, length = pass + holes, order = rnd_int(0, 5);
    const int x = rnd_one_in(4) ? PACKETS_ROW - length : rnd_int(0, PACKETS_ROW - length);
    const int base = rnd_one_in(2) ? x : x + length, apex = 2 * x + length - base;
    packets_triangle *t = &q->triangle[row];
    memset(t, 0, sizeof *t);
    for (int k = 0; k < 3; k++) {
        const int corner = (order < 3 ? k + order : order + 3 - k) % 3; /* 2: the apex */
        const double w = q->flat ? 1 : (double)rnd_log(0.5, 2);
        t->x[k] = (corner == 2 ? apex : base) * 256;
        t->y[k] = row * 256 + corner % 3 * 256;
        if (corner == 2) t->y[k] = row * 256 + 128;
        t->clip[k] = clip_of_fx8((double)t->x[k], (double)t->y[k], PACKETS_ROW,
                                 q->view.c.target.height, (double)rnd_float(-0.9, 0.9), w);
        t->value[PACKETS_VALUES * k] = (float)t->x[k] / 256 * (float)(1 << row % 8) / 256;
        t->value[PACKETS_VALUES * k + 2] = rnd_float(-1, 1);
    }
    t->front = packets_area(t) < 0;
    q->x[row] = x;
    q->length[row] = length;
    q->pixels += pass;
    memset(q->hole[row], 0, PACKETS_ROW);
    while (holes) {
        unsigned char *at = &q->hole[row][x + rnd_int(0, length - 1)];
        holes -= !*at;
        *at = 1;
    }
}

static void packets_empty(packets_queue *q)
{
    q->count = q->pixels = 0;
    q->flat = rnd_one_in(3);
    q->record.count = 0;
    q->record.fragment_packets = 0;
}

/* The picture that the runs are drawn into: depth 1, but 0 in the holes. */
static void packets_dig(const packets_queue *q)
{
    for (int y = 0; y < q->count; y++)
        for (int x = 0; x < PACKETS_ROW; x++)
            if (q->hole[y][x]) q->view.c.target.depth[y * PACKETS_ROW + x] = 0;
}

static void packets_check_order(const packets_queue *q, const shade_pipeline *p)
{
    int n = 0;
    for (int row = 0; row < q->count; row++)
        for (int x = q->x[row]; x < q->x[row] + q->length[row]; x++) {
            const fragment_record *f = &q->record.fragments[n];
            if (q->hole[row][x]) continue;
            if (n++ >= q->record.count) return;
            CHECK_SAY(f->x == (float)x + 0.5f && f->y == (float)row + 0.5f &&
                          f->primitive == (uint32_t)row,
                      "fragment %d is primitive %u at %g %g, want %d at %d", n - 1, f->primitive,
                      (double)f->x, (double)f->y, row, x);
            if (f->primitive == (uint32_t)row)
                packets_check_fragment(&q->triangle[row], &q->view, p, f);
            if (p->lod_texture) CHECK_NEAR(f->lod, row % 8, 0.01);
        }
}

/* Draws the runs and checks each fragment, their order, that only the last packet is not full, and
   that each pixel is stored once. */
static void packets_check_runs(packets_queue *q, int with_depth)
{
    static const unsigned char texel[4];
    shade_vec4 clip[3 * PACKETS_ROWS], color[PACKETS_ROWS];
    float attribute[3 * PACKETS_VALUES * PACKETS_ROWS];
    scene s = { clip, attribute, PACKETS_VALUES, color, &q->record };
    shade_pipeline p = scene_pipeline(&s);
    float *depth = q->view.c.target.depth;
    shade_texture map = { .pixels = texel, .width = 256, .height = 256 };
    for (int k = 0; k < q->count; k++) {
        memcpy(clip + 3 * k, q->triangle[k].clip, sizeof q->triangle[k].clip);
        memcpy(attribute + 3 * PACKETS_VALUES * k, q->triangle[k].value,
               sizeof q->triangle[k].value);
        color[k] = shade_v4((float)(k + 1) / 255, 1 / 255.0f, 0, 0);
    }
    p.raster.blend = SHADE_BLEND_ADD;
    p.interpolation = (shade_interpolation)rnd_int(0, 2);
    if (q->flat) p.lod_texture = &map;
    canvas_clear(&q->view.c, 1);
    packets_dig(q);
    if (!with_depth) q->view.c.target.depth = NULL;
    canvas_draw(&q->view.c, &p, 3 * q->count);
    q->view.c.target.depth = depth;
    CHECK_INT(q->record.count, q->pixels);
    CHECK_INT(q->record.fragment_packets, (q->pixels + SHADE_LANES - 1) / SHADE_LANES);
    CHECK_INT(q->record.bad_counts + q->record.bad_tails, 0);
    packets_check_order(q, &p);
    for (int y = 0; y < q->view.c.target.height; y++)
        for (int x = 0; x < PACKETS_ROW; x++) {
            const unsigned char *got = canvas_bytes(&q->view.c, x, y);
            const int in =
                y < q->count && x >= q->x[y] && x < q->x[y] + q->length[y] && !q->hole[y][x];
            if (got[0] != (in ? y + 1 : 0) || got[1] != in)
                CHECK_SAY(0, "pixel %d %d stored %d times", x, y, got[1]);
        }
}

static packets_queue *packets_queue_open(int rows)
{
    static packets_queue q;
    memset(&q, 0, sizeof q);
    q.view.c = canvas_open(PACKETS_ROW, rows, 0, SHADE_FORMAT_RGBA8, 1);
    q.record = recorder_open(PACKETS_ROWS * PACKETS_ROW);
    return &q;
}

static void packets_queue_close(packets_queue *q)
{
    canvas_close(&q->view.c);
    free(q->record.fragments);
}

/* fill fragments of one triangle wait, n of the next come, a few more follow. */
TEST(packets, runs_of_every_length_meet_the_queue_at_every_fill)
{
    packets_queue *q = packets_queue_open(3);
    for (int fill = 0; fill < SHADE_LANES; fill++)
        for (int n = 1; n <= PACKETS_LONGEST; n++) {
            const int near_end = (n + 4) % SHADE_LANES < 8;
            if (n > 76 && n % 4 && !near_end) continue;
            packets_empty(q);
            if (fill) packets_add_run(q, fill, 0);
            packets_add_run(q, n, 0);
            if (q->count < (int)PACKETS_MOST) packets_add_run(q, rnd_int(1, 9), 0);
            packets_check_runs(q, rnd_int(0, 1));
        }
    packets_queue_close(q);
}

/* Fragments of several triangles, of runs torn by what is in front, wait; a packet ends after each
   pixel of the run that follows. */
TEST(packets, packets_of_many_triangles_end_at_every_pixel_of_a_run)
{
    packets_queue *q = packets_queue_open(PACKETS_ROWS);
    for (int n = 1; n <= 40; n++)
        for (int end = 1; end <= n && end <= SHADE_LANES; end++) {
            int left = SHADE_LANES - end;
            int parts = rnd_int(1, PACKETS_ROWS > 3 ? PACKETS_ROWS - 2 : 1);
            packets_empty(q);
            for (; left && parts; parts--) {
                const int pass = parts == 1 ? left : rnd_int(1, 1 + (left - 1) * 2 / parts);
                packets_add_run(q, pass, rnd_int(0, 2) ? rnd_int(0, 20) : 0);
                left -= pass;
            }
            packets_add_run(q, n, 0);
            if (q->count < (int)PACKETS_ROWS) packets_add_run(q, rnd_int(1, 40), rnd_int(0, 20));
            packets_check_runs(q, 1);
        }
    packets_queue_close(q);
}
