/* fragment.c - what reaches the fragment shader, and what becomes of its colours: interpolation,
   depth, blending, discard, and the depth test before or after shading. */
#include "unit.h"

/* One triangle on the 1/256 grid, so that the exact planes through its corners are known. */
typedef struct grid_triangle {
    shade_vec4 clip[3];
    int64_t x[3], y[3];
    double z[3], w[3]; /* z/w in [-1, 1] */
    double reach;      /* longest side squared over twice the area: how steep values can be */
} grid_triangle;

static void random_grid_triangle(grid_triangle *t, int width, int height, double w_range)
{
    double area;
    do {
        for (int k = 0; k < 3; k++) {
            t->x[k] = rnd_int(-width * 64, width * 320);
            t->y[k] = rnd_int(-height * 64, height * 320);
        }
        area = fabs((double)((t->x[1] - t->x[0]) * (t->y[2] - t->y[0]) -
                             (t->y[1] - t->y[0]) * (t->x[2] - t->x[0])));
        double longest = 0;
        for (int k = 0; k < 3; k++) {
            double dx = (double)(t->x[k] - t->x[(k + 1) % 3]),
                   dy = (double)(t->y[k] - t->y[(k + 1) % 3]);
            longest = fmax(longest, dx * dx + dy * dy);
        }
        t->reach = longest / fmax(area, 1);
    } while (area < 65536 || t->reach > 50);
    for (int k = 0; k < 3; k++) {
        t->w[k] = (double)rnd_log(1 / w_range, w_range);
        t->z[k] = (double)rnd_float(-0.98, 0.98);
        t->clip[k] = clip_of_fx8((double)t->x[k], (double)t->y[k], width, height, t->z[k], t->w[k]);
    }
}

/* The allowed error of an interpolated value: a few float roundings of the greatest value, as much
   larger as the planes are steeper than the values; a corner's own position is off by up to 1/2000
   pixel of rounding in x/w. */
static double plane_error(const grid_triangle *t, double w_range)
{
    return 4e-6 * (1 + t->reach) * w_range;
}

TEST(fragment, packets_are_full_but_the_last_of_a_batch) /* pixels queue across triangles */
{
    enum { N = 500 };
    static shade_vec4 clip[3 * N];
    recorder r = recorder_open(400000);
    for (int round = 0; round < 20; round++) {
        canvas c = canvas_open(64, 64, 0, SHADE_FORMAT_RGBA8, 0);
        for (int i = 0; i < N; i++) {
            int64_t x[3], y[3];
            random_corners(round % 2, 64, 64, x, y);
            for (int k = 0; k < 3; k++)
                clip[3 * i + k] = clip_of_fx8((double)x[k], (double)y[k], 64, 64, 0, 1);
        }
        scene s = { clip, NULL, 0, NULL, &r };
        shade_pipeline p = scene_pipeline(&s);
        r.count = 0;
        r.fragment_packets = r.vertex_packets = 0;
        shade_stats stats = canvas_draw(&c, &p, 3 * N);
        CHECK_INT(r.count, stats.fragments);
        /* each packet of vertices leaves at most one packet of pixels short */
        CHECK_SAY(r.fragment_packets <= r.count / SHADE_LANES + r.vertex_packets,
                  "%ld packets for %d fragments", r.fragment_packets, r.count);
        CHECK(r.vertex_packets <= 3 * N / (SHADE_LANES - 2) + 1);
        for (int k = 1; k < r.count; k++)
            CHECK(r.fragments[k].primitive >= r.fragments[k - 1].primitive);
        CHECK_INT(r.bad_counts, 0);
        CHECK_INT(r.bad_tails, 0);
        canvas_close(&c);
    }
    free(r.fragments);
}

TEST(fragment, perspective_varyings_match_double_for_every_count) /* sum b v/w over sum b/w */
{
    recorder r = recorder_open(20000);
    for (int i = 0; i < 700; i++) {
        int width = rnd_int(10, 120), height = rnd_int(10, 90),
            varyings = i % (SHADE_MAX_VARYINGS + 1);
        double w_range = i % 3 == 0 ? 1 : i % 3 == 1 ? 2 : 10;
        canvas c = canvas_ready(width, height, 0, SHADE_FORMAT_RGBA8, 1);
        grid_triangle t;
        float attributes[6 * SHADE_MAX_VARYINGS], *attribute = attributes + 3 * varyings;
        shade_vec4 clip[6];
        random_grid_triangle(&t, width, height, w_range);
        for (int k = 0; k < 6; k++) clip[k] = t.clip[k < 3 ? 0 : k - 3];    /* a point before it */
        for (int k = 0; k < 6 * SHADE_MAX_VARYINGS; k++) attributes[k] = rnd_float(-1, 1);
        ref_triangle e;
        if (!ref_triangle_of(&e, &t.clip[0], &t.clip[1], &t.clip[2], width, height)) continue;
        scene s = { clip, attributes, varyings, NULL, &r };
        shade_pipeline p = scene_pipeline(&s);
        r.count = 0;
        canvas_draw(&c, &p, 6);
        for (int k = 0; k < r.count; k++) {
            fragment_record *f = &r.fragments[k];
            double X = (double)f->x, Y = (double)f->y;
            CHECK_INT(f->primitive, 1);
            CHECK_NEAR(f->z, ref_depth(&e, X, Y, 0), plane_error(&t, 1) / 4);
            for (int j = 0; j < varyings; j++) {
                double want =
                    ref_interpolate(&e, X, Y, (double)attribute[j], (double)attribute[varyings + j],
                                    (double)attribute[2 * varyings + j]);
                CHECK_NEAR(f->in[j], want, plane_error(&t, w_range));
            }
        }
        canvas_close(&c);
    }
    free(r.fragments);
}

TEST(fragment, primitive_counts_triangles_of_the_draw_also_culled_ones)
{
    recorder r = recorder_open(100000);
    static shade_vec4 clip[3 * 300];
    for (int i = 0; i < 300; i++) {
        memcpy(clip + 3 * i, clip_corners, sizeof clip_corners);
        if (i % 3 == 1) { /* back-facing */
            clip[3 * i] = clip_corners[1];
            clip[3 * i + 1] = clip_corners[0];
        }
        if (i % 7 == 3) clip[3 * i].x = (float)NAN;
    }
    canvas c = canvas_open(10, 10, 0, SHADE_FORMAT_RGBA8, 0);
    scene s = { clip, NULL, 0, NULL, &r };
    shade_pipeline p = scene_pipeline(&s);
    static int seen[300];
    for (int cull = 0; cull < 3; cull++) {
        p.raster.cull = (shade_cull)cull;
        r.count = 0;
        memset(seen, 0, sizeof seen);
        canvas_draw(&c, &p, 900);
        for (int k = 0; k < r.count; k++) seen[r.fragments[k].primitive % 300]++;
        for (int i = 0; i < 300; i++) {
            int back = i % 3 == 1, hidden = i % 7 == 3 || (cull == SHADE_CULL_BACK && back) ||
                                            (cull == SHADE_CULL_FRONT && !back);
            CHECK_INT(seen[i], hidden ? 0 : 50);
        }
    }
    free(r.fragments);
    canvas_close(&c);
}

/* ---------------------------------------------------------------------------------------- depth */

static shade_stats draw_at_depth(canvas *c, float z, shade_compare compare, float bias,
                                 int read_only)
{
    shade_vec4 v[3];
    memcpy(v, clip_corners, sizeof v);
    for (int k = 0; k < 3; k++) v[k].z = z;
    scene s = { v, NULL, 0, NULL, NULL };
    shade_pipeline p = scene_pipeline(&s);
    p.raster.depth_test = compare;
    p.raster.depth_bias = bias;
    p.raster.depth_read_only = read_only;
    return canvas_draw(c, &p, 3);
}

TEST(fragment, comparisons_do_what_their_names_say)
{
    static const shade_compare compare[] = { SHADE_COMPARE_LESS,    SHADE_COMPARE_LESS_EQUAL,
                                             SHADE_COMPARE_GREATER, SHADE_COMPARE_GREATER_EQUAL,
                                             SHADE_COMPARE_EQUAL,   SHADE_COMPARE_ALWAYS };
    static const int nearer[] = { 1, 1, 0, 0, 0, 1 }, same[] = { 0, 1, 0, 1, 1, 1 },
                     farther[] = { 0, 0, 1, 1, 0, 1 };
    for (int k = 0; k < 6; k++)
        for (int mode = 0; mode < 2; mode++) { /* both sides of exact equality */
            canvas c = canvas_open(16, 16, 19, SHADE_FORMAT_RGBA8, 1);
            canvas_clear(&c, 0.5f);
            CHECK_INT(draw_at_depth(&c, -0.25f, compare[k], 0, 1).fragments, nearer[k] * 128);
            CHECK_INT(draw_at_depth(&c, 0, compare[k], 0, 1).fragments, same[k] * 128);
            CHECK_INT(draw_at_depth(&c, 0.25f, compare[k], 0, 1).fragments, farther[k] * 128);
            CHECK_NEAR(canvas_depth(&c, 8, 12), 0.5, 0);
            float z = mode ? 0.25f : -0.25f;
            int pass = mode ? farther[k] : nearer[k];
            CHECK_INT(draw_at_depth(&c, z, compare[k], 0, 0).fragments, pass * 128);
            CHECK_NEAR(canvas_depth(&c, 8, 12), pass ? 0.5 + (double)z / 2 : 0.5, 0);
            CHECK_NEAR(canvas_depth(&c, 0, 0), 0.5, 0);
            canvas_close(&c);
        }
}

/* The same triangle again has the depths of the first, bit for bit: a test for less draws none
   of its pixels, one for equal draws all. */
TEST(fragment, a_second_identical_draw_has_equal_depth)
{
    for (int i = 0; i < 100; i++) {
        canvas c = canvas_ready(100, 80, 0, SHADE_FORMAT_RGBA8, 1);
        grid_triangle t;
        random_grid_triangle(&t, 100, 80, 10);
        scene s = { t.clip, NULL, 0, NULL, NULL };
        shade_pipeline p = scene_pipeline(&s);
        long long first = canvas_draw(&c, &p, 3).fragments;
        CHECK_INT(canvas_draw(&c, &p, 3).fragments, 0);
        p.raster.depth_test = SHADE_COMPARE_EQUAL;
        CHECK_INT(canvas_draw(&c, &p, 3).fragments, first);
        p.raster.depth_test = SHADE_COMPARE_LESS_EQUAL;
        CHECK_INT(canvas_draw(&c, &p, 3).fragments, first);
        p.raster.depth_test = SHADE_COMPARE_GREATER;
        CHECK_INT(canvas_draw(&c, &p, 3).fragments, 0);
        canvas_close(&c);
    }
}

/* Level triangles at z, so that the depth is z / 2 + 1/2: biases within, at and beyond both ends
   of [0, 1]. 128 of the 256 pixels are inside. */
TEST(fragment, bias_is_added_and_what_is_stored_is_clamped)
{
    canvas c = canvas_open(16, 16, 0, SHADE_FORMAT_RGBA8, 1);
    static const struct {
        float z, bias;
        double want;
    } table[] = {
        { 0, 0, 0.5 },      { 0, 0.125f, 0.625 }, { 0, -0.125f, 0.375 },
        { 0.5f, 0.5f, 1 },  { -0.5f, -0.5f, 0 },  { 0.25f, 100, 1 },
        { 0.25f, -100, 0 }, { -1, 0, 0 },         { 1, 0, 1 },
    };
    for (int k = 0; k < 9; k++) {
        canvas_clear(&c, 1);
        CHECK_INT(draw_at_depth(&c, table[k].z, SHADE_COMPARE_ALWAYS, table[k].bias, 0).fragments,
                  128);
        CHECK_NEAR(canvas_depth(&c, 8, 12), table[k].want, 1e-7);
        CHECK(canvas_depth(&c, 8, 12) >= 0 && canvas_depth(&c, 8, 12) <= 1);
    }
    canvas_close(&c);
}

TEST(fragment, bias_moves_sloping_depth_as_a_whole)
{
    for (int i = 0; i < 200; i++) {
        grid_triangle t;
        ref_triangle e;
        random_grid_triangle(&t, 60, 50, 3);
        if (!ref_triangle_of(&e, &t.clip[0], &t.clip[1], &t.clip[2], 60, 50)) continue;
        canvas c = canvas_ready(60, 50, 0, SHADE_FORMAT_RGBA8, 1);
        scene s = { t.clip, NULL, 0, NULL, NULL };
        shade_pipeline p = scene_pipeline(&s);
        p.raster.depth_test = SHADE_COMPARE_ALWAYS;
        p.raster.depth_bias = rnd_float(-0.6, 0.6);
        p.may_discard = i % 2;
        canvas_draw(&c, &p, 3);
        for (int y = 0; y < 50; y++)
            for (int x = 0; x < 60; x++) {
                if (canvas_bytes(&c, x, y)[3] == 0) continue;
                double z = ref_depth(&e, x + 0.5, y + 0.5, 0) + (double)p.raster.depth_bias;
                CHECK_NEAR(canvas_depth(&c, x, y), fmax(0, fmin(1, z)), plane_error(&t, 1) / 4);
            }
        canvas_close(&c);
    }
}

/* Distances that come nearer, go back, and lie a thousand times apart: with reversed depth each
   is near / distance, however far it is. */
TEST(fragment, reversed_depth_sees_what_is_nearer)
{
    canvas c = canvas_open(32, 32, 0, SHADE_FORMAT_RGBA8, 1);
    shade_mat4 m = shade_mat4_perspective_reversed(1, 1, 0.25f);
    static const float distance[] = { 5, 2, 100, 0.5f, 3000, 1 };
    double nearest = 1e30;
    canvas_clear(&c, 0);
    for (int k = 0; k < 6; k++) {
        shade_vec4 v[3];
        for (int j = 0; j < 3; j++) {
            shade_vec4 corner = clip_corners[j];
            v[j] = shade_mat4_transform(
                m, shade_v4(corner.x * distance[k], corner.y * distance[k], -distance[k], 1));
        }
        scene s = { v, NULL, 0, NULL, NULL };
        shade_pipeline p = scene_pipeline(&s);
        p.raster.depth_zero_to_one = 1;
        p.raster.depth_test = SHADE_COMPARE_GREATER;
        long long fragments = canvas_draw(&c, &p, 3).fragments;
        CHECK_INT(fragments > 0, (double)distance[k] < nearest);
        nearest = fmin(nearest, (double)distance[k]);
        CHECK_NEAR(canvas_depth(&c, 16, 20), 0.25 / nearest, 1e-6);
    }
    canvas_close(&c);
}

TEST(fragment, bigger_is_closer_gives_the_picture_of_smaller_is_closer)
{
    for (int round = 0; round < 20; round++) {
        enum { N = 60 };
        shade_vec4 clip[3 * N], mirrored[3 * N], color[N];
        for (int i = 0; i < N; i++) {
            grid_triangle t;
            random_grid_triangle(&t, 64, 64, 3);
            for (int k = 0; k < 3; k++) {
                clip[3 * i + k] = mirrored[3 * i + k] = t.clip[k];
                mirrored[3 * i + k].z = -t.clip[k].z;
            }
            color[i] = shade_v4(rnd_float(0, 1), rnd_float(0, 1), rnd_float(0, 1), 1);
        }
        canvas a = canvas_ready(64, 64, 0, SHADE_FORMAT_RGBA8, 1),
                b = canvas_open(64, 64, 0, SHADE_FORMAT_RGBA8, 1);
        scene s = { clip, NULL, 0, color, NULL };
        shade_pipeline p = scene_pipeline(&s);
        canvas_clear(&b, 0);
        canvas_draw(&a, &p, 3 * N);
        s.clip = mirrored;
        p.raster.depth_test = SHADE_COMPARE_GREATER;
        canvas_draw(&b, &p, 3 * N);
        int differ = 0;
        for (int y = 0; y < 64; y++)
            for (int x = 0; x < 64; x++)
                differ += memcmp(canvas_bytes(&a, x, y), canvas_bytes(&b, x, y), 4) != 0;
        CHECK_SAY(differ < 8, "%d pixels differ", differ); /* intersections, by rounding */
        canvas_close(&a);
        canvas_close(&b);
    }
}

/* Random triangles upon each other, their corners on the grid of 1/256 pixel. */
enum { PILE_MOST = 40, PILE_SIZE = 48 };
typedef struct pile {
    shade_vec4 clip[3 * PILE_MOST], color[PILE_MOST];
    int64_t x[3 * PILE_MOST], y[3 * PILE_MOST];
    ref_triangle exact[PILE_MOST];
    double worst; /* error of depth */
    int count;
} pile;

static void random_pile(pile *p, int count)
{
    p->count = count;
    p->worst = 0;
    for (int i = 0; i < count; i++) {
        grid_triangle t;
        do random_grid_triangle(&t, PILE_SIZE, PILE_SIZE, 4);
        while (!ref_triangle_of(&p->exact[i], &t.clip[0], &t.clip[1], &t.clip[2], PILE_SIZE,
                                PILE_SIZE));
        memcpy(p->clip + 3 * i, t.clip, sizeof t.clip);
        memcpy(p->x + 3 * i, t.x, sizeof t.x);
        memcpy(p->y + 3 * i, t.y, sizeof t.y);
        p->worst = fmax(p->worst, plane_error(&t, 1));
    }
}

/* The depth of triangle k at a pixel, 2 where it does not cover the pixel. */
static double pile_depth(const pile *p, int k, int i, int j)
{
    if (!ref_inside_fx8(p->x + 3 * k, p->y + 3 * k, i, j)) return 2;
    return ref_depth(&p->exact[k], i + 0.5, j + 0.5, 0);
}

/* The colour of a pixel names its triangle.  Only where two depths are farther apart than
   rounding can move them is it known which one wins. */
TEST(fragment, a_z_buffer_keeps_the_nearest_of_each_pixel)
{
    static pile of;
    for (int round = 0; round < 40; round++) {
        random_pile(&of, PILE_MOST);
        for (int k = 0; k < of.count; k++) of.color[k] = shade_v4((float)k / 255, 0, 0, 1);
        canvas c = canvas_ready(PILE_SIZE, PILE_SIZE, 50, SHADE_FORMAT_RGBA8, 1);
        scene s = { of.clip, NULL, 0, of.color, NULL };
        shade_pipeline p = scene_pipeline(&s);
        canvas_draw(&c, &p, 3 * of.count);
        for (int at = 0; at < PILE_SIZE * PILE_SIZE; at++) {
            int i = at % PILE_SIZE, j = at / PILE_SIZE, winner = 0;
            double nearest = 1, second = 1;
            for (int k = 0; k < of.count; k++) {
                double z = pile_depth(&of, k, i, j);
                if (z < nearest) {
                    second = nearest;
                    nearest = z;
                    winner = k;
                } else {
                    second = fmin(second, z);
                }
            }
            CHECK_NEAR(canvas_depth(&c, i, j), nearest, of.worst / 4);
            if (nearest == 1) CHECK_INT(canvas_bytes(&c, i, j)[3], 0);
            if (nearest < 1 && second - nearest > of.worst) {
                CHECK_INT(canvas_bytes(&c, i, j)[0], winner);
            }
        }
        canvas_close(&c);
    }
}

TEST(fragment, without_a_depth_buffer_every_test_passes)
{
    for (int k = 0; k < 6; k++) {
        canvas c = canvas_ready(16, 16, 0, SHADE_FORMAT_RGBA8, 0);
        CHECK_INT(draw_at_depth(&c, 0.5f, (shade_compare)k, 0, 0).fragments, 128);
        CHECK_INT(draw_at_depth(&c, 0.5f, (shade_compare)k, 0, 0).fragments, 128);
        canvas_close(&c);
    }
}

/* ------------------------------------------------------------------------------------- blending */

typedef struct blend_case {
    shade_vec4 clip[3 * 80], color[80];
    int64_t x[3 * 80], y[3 * 80];
} blend_case;

static void random_blend_case(blend_case *b, int n, int size)
{
    for (int i = 0; i < n; i++) {
        random_corners(i % 4 == 0 ? 2 : rnd_int(0, 1), size, size, b->x + 3 * i, b->y + 3 * i);
        for (int k = 0; k < 3; k++) {
            b->clip[3 * i + k] =
                clip_of_fx8((double)b->x[3 * i + k], (double)b->y[3 * i + k], size, size, 0, 1);
        }
        b->color[i] = shade_v4(rnd_float(0, 1), rnd_float(0, 1), rnd_float(0, 1), rnd_float(0, 1));
    }
}

/* Blends in submission order, in double; formats: rounds and encodes after every step as a stored
   pixel must be. */
static double blend_channel(shade_blend blend, int channel, double s, double a, double d)
{
    if (blend == SHADE_BLEND_REPLACE) return s;
    if (blend == SHADE_BLEND_ADD) return s + d;
    return channel == 3 ? a + d * (1 - a) : s * a + d * (1 - a);
}

/* The code that v is stored as where rounding happens `late` codes too late. */
static double stored_code(double v, int srgb, int levels, double late)
{
    v = v > 0 ? (v < 1 ? v : 1) : 0;
    if (srgb) v = ref_encode_srgb(v);
    return fmin(fmax(floor(v * levels + 0.5 - late), 0), levels);
}

static double unit_of_code(double code, int srgb, int levels)
{
    return srgb ? ref_decode_srgb(code / levels) : code / levels;
}

/* Up to 80 layers of any colour and alpha: each blend rounds a few times, and each layer scales
   what lies below by at most 1, so that 3e-6 holds the sum of all errors. */
TEST(fragment, blending_follows_submission_order_in_float)
{
    static blend_case b;
    for (int round = 0; round < 60; round++) {
        shade_blend blend = (shade_blend)(round % 3);
        int n = rnd_int(2, 80), size = rnd_int(4, 60);
        random_blend_case(&b, n, size);
        canvas c = canvas_open(size, size, 0, SHADE_FORMAT_RGBA32F, rnd_int(0, 1));
        shade_vec4 clear =
            shade_v4(rnd_float(0, 1), rnd_float(0, 1), rnd_float(0, 1), rnd_float(0, 1));
        CHECK_INT(shade_clear(&c.target, clear, 1), SHADE_OK);
        scene s = { b.clip, NULL, 0, b.color, NULL };
        shade_pipeline p = scene_pipeline(&s);
        p.raster.blend = blend;
        p.raster.depth_test = SHADE_COMPARE_ALWAYS;
        canvas_draw(&c, &p, 3 * n);
        for (int j = 0; j < size; j++) {
            for (int i = 0; i < size; i++) {
                double d[4];
                d[0] = (double)clear.x;
                d[1] = (double)clear.y;
                d[2] = (double)clear.z;
                d[3] = (double)clear.w;
                for (int k = 0; k < n; k++) {
                    if (!ref_inside_fx8(b.x + 3 * k, b.y + 3 * k, i, j)) continue;
                    double v[4], a = (double)b.color[k].w;
                    v[0] = (double)b.color[k].x;
                    v[1] = (double)b.color[k].y;
                    v[2] = (double)b.color[k].z;
                    v[3] = a;
                    for (int m = 0; m < 4; m++) d[m] = blend_channel(blend, m, v[m], a, d[m]);
                }
                for (int m = 0; m < 4; m++)
                    CHECK_NEAR(canvas_float(&c, i, j, m), d[m], 3e-6 * fmax(1, d[m]));
            }
        }
        canvas_close(&c);
    }
}

/* The codes that the triangles of a case leave in a channel of a pixel that was 0, stored after
   each of them.  A value near the middle of two codes may become either: sums are in float, and the
   functions of sRGB are 4e-6 off, which encoding makes up to 12.92 times as much.  Blending grows
   with what lies below, so that the least and the most code bound all that can come of it. */
static void blended_codes(const blend_case *b, int n, shade_blend blend, const shade_target *t,
                          int i, int j, int m, double code[2])
{
    int srgb = t->srgb && m < 3, most = canvas_most(t->format, m);
    double late = srgb ? 0.015 : 0.001;
    code[0] = code[1] = 0;
    for (int k = 0; k < n; k++) {
        const shade_vec4 *color = &b->color[k];
        double v[4] = { (double)color->x, (double)color->y, (double)color->z, (double)color->w };
        if (!ref_inside_fx8(b->x + 3 * k, b->y + 3 * k, i, j)) continue;
        for (int bound = 0; bound < 2; bound++) {
            double below = unit_of_code(code[bound], srgb, most);
            double above = blend_channel(blend, m, v[m], v[3], below);
            code[bound] = stored_code(above, srgb, most, bound ? -late : late);
        }
    }
}

/* linear light when the target is sRGB */
TEST(fragment, blending_of_stored_bytes_follows_submission_order)
{
    static blend_case b;
    long either = 0, values = 0;
    for (int round = 0; round < 80; round++) {
        shade_blend blend = round % 2 ? SHADE_BLEND_OVER : SHADE_BLEND_ADD;
        int n = rnd_int(2, 40), size = rnd_int(4, 40), srgb = round % 4 > 1;
        shade_format format = (shade_format)(round / 4 % SHADE_FORMAT_RGBA32F);
        random_blend_case(&b, n, size);
        if (blend == SHADE_BLEND_ADD)
            for (int i = 0; i < n; i++) b.color[i] = shade_scale4(b.color[i], 0.1f);
        canvas c = canvas_open(size, size, 0, format, 0);
        c.target.srgb = srgb;
        canvas_clear(&c, 1);
        scene s = { b.clip, NULL, 0, b.color, NULL };
        shade_pipeline p = scene_pipeline(&s);
        p.raster.blend = blend;
        canvas_draw(&c, &p, 3 * n);
        int channels = canvas_most(format, 3) ? 4 : 3;
        for (int j = 0; j < size; j++) {
            for (int i = 0; i < size; i++) {
                for (int m = 0; m < channels; m++) {
                    double want[2];
                    int got = canvas_code(&c, i, j, m);
                    blended_codes(&b, n, blend, &c.target, i, j, m, want);
                    CHECK_SAY(got >= want[0] && got <= want[1],
                              "pixel %d %d channel %d: got %d, want %.0f to %.0f", i, j, m, got,
                              want[0], want[1]);
                    either += want[0] != want[1];
                    values++;
                }
            }
        }
        canvas_close(&c);
    }
    CHECK_SAY(either < values / 20, "%ld of %ld values may be either code", either, values);
}

/* Multiples of 1/16, which floats hold exactly: the colour is c / 4 + 3/4 of 1/2, alpha is 1/4 +
   3/4 of 1/2. */
TEST(fragment, alpha_of_over_builds_up)
{
    canvas c = canvas_open(16, 16, 0, SHADE_FORMAT_RGBA32F, 0);
    CHECK_INT(shade_clear(&c.target, shade_v4(0.5f, 0.5f, 0.5f, 0.5f), 1), SHADE_OK);
    shade_vec4 color[1] = { { 1, 0, 0.25f, 0.25f } };
    scene s = { clip_corners, NULL, 0, color, NULL };
    shade_pipeline p = scene_pipeline(&s);
    p.raster.blend = SHADE_BLEND_OVER;
    canvas_draw(&c, &p, 3);
    CHECK_NEAR(canvas_float(&c, 8, 12, 0), 0.625, 1e-7);
    CHECK_NEAR(canvas_float(&c, 8, 12, 1), 0.375, 1e-7);
    CHECK_NEAR(canvas_float(&c, 8, 12, 2), 0.4375, 1e-7);
    CHECK_NEAR(canvas_float(&c, 8, 12, 3), 0.625, 1e-7);
    canvas_close(&c);
}

/* -------------------------------------------------------------------------------------- discard */

/* The last triangle, or the nearest, that fragment_sieve leaves at a pixel: 1 for the first, 0 for
   none.  *depth: its depth; -1 where rounding decides which triangle it is. */
static int sieved(const pile *of, int i, int j, int with_depth, double *depth)
{
    int want = 0, sure = 1;
    double nearest = 1;
    for (int k = 0; k < of->count; k++) {
        double z = (i * 7 + j * 5 + k) % 3 ? pile_depth(of, k, i, j) : 2;
        if (z > 1) continue;
        if (with_depth && fabs(z - nearest) < of->worst) sure = 0;
        if (!with_depth || z < nearest) {
            nearest = z;
            want = k + 1;
        }
    }
    *depth = sure ? nearest : -1;
    return want;
}

TEST(fragment, discarded_pixels_stay_as_they_were_in_colour_and_depth)
{
    enum { N = 31 }; /* as many reds as 5-6-5 has */
    static pile of;
    for (int round = 0; round < 75; round++) {
        shade_format format = (shade_format)(round / 3 % CANVAS_FORMATS);
        int with_depth = round % 3 != 0, most = canvas_most(format, 0);
        random_pile(&of, N);
        for (int k = 0; k < N; k++) of.color[k] = shade_v4((float)(k + 1) / N, 0, 0, 1);
        canvas c = canvas_ready(PILE_SIZE, PILE_SIZE, 50, format, with_depth);
        scene s = { of.clip, NULL, 0, of.color, NULL };
        shade_pipeline p = scene_pipeline(&s);
        p.fragment = fragment_sieve;
        p.may_discard = 1;
        canvas_draw(&c, &p, 3 * N);
        for (int at = 0; at < PILE_SIZE * PILE_SIZE; at++) {
            int i = at % PILE_SIZE, j = at / PILE_SIZE;
            double depth;
            int want = sieved(&of, i, j, with_depth, &depth);
            if (depth < 0) continue;
            if (format == SHADE_FORMAT_RGBA32F) {
                CHECK_NEAR(canvas_float(&c, i, j, 0), (float)want / N, 0);
                CHECK_NEAR(canvas_float(&c, i, j, 3), want != 0, 0);
            } else {
                CHECK_INT(canvas_code(&c, i, j, 0), (2 * want * most + N) / (2 * N));
                CHECK_INT(canvas_code(&c, i, j, 3), want ? canvas_most(format, 3) : 0);
            }
            if (with_depth) CHECK_NEAR(canvas_depth(&c, i, j), depth, of.worst);
        }
        canvas_close(&c);
    }
}

TEST(fragment, testing_depth_before_or_after_shading_gives_the_same_picture)
{
    for (int round = 0; round < 80; round++) {
        enum { N = 80 };
        shade_vec4 clip[3 * N], color[N];
        for (int i = 0; i < N; i++) {
            grid_triangle t;
            random_grid_triangle(&t, 64, 48, 4);
            if (i % 5 == 4 && i > 5)
                memcpy(clip + 3 * i, clip + 3 * (i - 5), sizeof t.clip); /* equal depths */
            else
                memcpy(clip + 3 * i, t.clip, sizeof t.clip);
            color[i] = shade_v4(rnd_float(0, 1), rnd_float(0, 1), rnd_float(0, 1), rnd_float(0, 1));
        }
        canvas early = canvas_open(64, 48, 0, SHADE_FORMAT_RGBA8, 1),
               late = canvas_open(64, 48, 0, SHADE_FORMAT_RGBA8, 1);
        scene s = { clip, NULL, 0, color, NULL };
        shade_pipeline p = scene_pipeline(&s);
        p.raster.depth_test = (shade_compare)(round % 6);
        p.raster.blend = (shade_blend)(round / 6 % 3);
        p.raster.depth_bias = round % 4 == 3 ? 0.01f : 0;
        p.raster.depth_read_only = round % 10 == 9;
        float clear = p.raster.depth_test == SHADE_COMPARE_GREATER ||
                              p.raster.depth_test == SHADE_COMPARE_GREATER_EQUAL
                          ? 0
                          : 1;
        canvas_clear(&early, clear);
        canvas_clear(&late, clear);
        shade_stats a = canvas_draw(&early, &p, 3 * N);
        p.may_discard = 1;
        shade_stats b = canvas_draw(&late, &p, 3 * N);
        CHECK(canvas_same(&early, &late));
        CHECK_INT(b.fragments, a.fragments);
        canvas_close(&early);
        canvas_close(&late);
    }
}

/* The sieve keeps two of three pixels of a triangle that covers half of 900. */
TEST(fragment, without_may_discard_the_flag_is_ignored_or_with_it_obeyed)
{
    canvas c = canvas_ready(30, 30, 0, SHADE_FORMAT_RGBA8, 1);
    shade_vec4 color[1] = { { 1, 1, 1, 1 } };
    scene s = { clip_corners, NULL, 0, color, NULL };
    shade_pipeline p = scene_pipeline(&s);
    p.fragment = fragment_sieve;
    p.may_discard = 1;
    canvas_draw(&c, &p, 3);
    int kept = 0, touched = 0;
    for (int k = 0; k < 900; k++) {
        kept += canvas_bytes(&c, k % 30, k / 30)[3] != 0;
        touched += canvas_depth(&c, k % 30, k / 30) < 1;
    }
    CHECK_INT(kept, touched);
    CHECK_SAY(kept > 200 && kept < 400, "%d pixels kept", kept);
    canvas_close(&c);
}

/* ------------------------------------------------------------------------------ missing buffers */

/* A triangle over half of 900 pixels is drawn into depth alone, first by a shader that may not
   discard, then by the same one that may. */
TEST(fragment, without_colour_the_shader_runs_only_where_it_may_discard)
{
    recorder r = recorder_open(1000);
    canvas c = canvas_open(30, 30, 0, SHADE_FORMAT_RGBA8, 1);
    c.target.color = NULL;
    shade_vec4 color[1] = { { 1, 1, 1, 1 } };
    scene s = { clip_corners, NULL, 0, color, &r };
    shade_pipeline p = scene_pipeline(&s);
    p.fragment = fragment_sieve;
    CHECK_INT(shade_clear(&c.target, shade_v4(0, 0, 0, 0), 1), SHADE_OK);
    shade_stats stats = canvas_draw(&c, &p, 3);
    CHECK_INT(r.fragment_packets, 0);
    int touched = 0;
    for (int k = 0; k < 900; k++) touched += canvas_depth(&c, k % 30, k / 30) < 1;
    CHECK_INT(touched, stats.fragments);
    CHECK(touched > 400);
    CHECK_INT(shade_clear(&c.target, shade_v4(0, 0, 0, 0), 1), SHADE_OK);
    p.may_discard = 1;
    canvas_draw(&c, &p, 3);
    CHECK(r.fragment_packets > 0);
    int kept = 0;
    for (int k = 0; k < 900; k++) kept += canvas_depth(&c, k % 30, k / 30) < 1;
    CHECK_SAY(kept > 200 && kept < touched, "%d of %d", kept, touched);
    for (size_t k = 0; k < c.color_bytes; k++) CHECK(c.color[CANVAS_GUARD + k] == CANVAS_BYTE);
    free(r.fragments);
    canvas_close(&c);
}

TEST(fragment, without_a_shader_only_depth_is_written)
{
    canvas c = canvas_open(30, 30, 0, SHADE_FORMAT_RGBA8, 1);
    scene s = { clip_corners, NULL, 0, NULL, NULL };
    shade_pipeline p = scene_pipeline(&s);
    p.fragment = NULL;
    CHECK_INT(shade_clear(&c.target, shade_v4(1, 0, 1, 0), 1), SHADE_OK);
    shade_stats stats = canvas_draw(&c, &p, 3);
    int touched = 0;
    for (int k = 0; k < 900; k++) {
        touched += canvas_depth(&c, k % 30, k / 30) == 0.5f;
        const unsigned char *q = canvas_bytes(&c, k % 30, k / 30);
        CHECK(q[0] == 255 && q[1] == 0 && q[2] == 255 && q[3] == 0);
    }
    CHECK_INT(touched, stats.fragments);
    CHECK(touched > 400);
    canvas_close(&c);
}

static void fragment_first_packet_only(const void *uniforms,
                                       const shade_fragments *SHADE_RESTRICT in,
                                       shade_colors *SHADE_RESTRICT out)
{
    (void)uniforms;
    if (in->y[0] > 20) return;
    for (int i = 0; i < SHADE_LANES; i++) {
        out->color[0][i] = 1;
        out->color[1][i] = 1;
        out->color[2][i] = 1;
        out->color[3][i] = 0;
        out->discard[i] = 1;
    }
}

/* The picture is large enough for many packets, and the shader sets colours in the first alone. */
TEST(fragment, colours_a_shader_leaves_alone_are_opaque_black)
{
    for (int may_discard = 0; may_discard < 2; may_discard++) {
        canvas c = canvas_open(64, 64, 0, SHADE_FORMAT_RGBA8, 1);
        static const shade_vec4 whole[6] = { { -1, -1, 0, 1 }, { 1, -1, 0, 1 }, { 1, 1, 0, 1 },
                                             { -1, -1, 0, 1 }, { 1, 1, 0, 1 },  { -1, 1, 0, 1 } };
        scene s = { whole, NULL, 0, NULL, NULL };
        shade_pipeline p = scene_pipeline(&s);
        p.fragment = fragment_first_packet_only;
        p.may_discard = may_discard;
        CHECK_INT(shade_clear(&c.target, shade_v4(0, 1, 0, 1), 1), SHADE_OK);
        canvas_draw(&c, &p, 6);
        for (int y = 40; y < 64; y++)
            for (int x = 0; x < 64; x++) {
                const unsigned char *q = canvas_bytes(&c, x, y);
                CHECK_SAY(q[0] == 0 && q[1] == 0 && q[2] == 0 && q[3] == 255,
                          "pixel %d %d: %d %d %d %d", x, y, q[0], q[1], q[2], q[3]);
            }
        CHECK_INT(canvas_bytes(&c, 50, 10)[1], 255);
        CHECK_INT(canvas_bytes(&c, 50, 10)[0], may_discard ? 0 : 255);
        canvas_close(&c);
    }
}

/* Red, green and blue are the three barycentric coordinates of a triangle without perspective. */
TEST(fragment, vertex_colours_smear_between_the_corners)
{
    canvas c = canvas_ready(200, 200, 0, SHADE_FORMAT_RGBA32F, 0);
    static const float color[] = { 1, 0, 0, 1, 0, 1, 0, 1, 0, 0, 1, 1 };
    scene s = { clip_corners, color, 4, NULL, NULL };
    shade_pipeline p = scene_pipeline(&s);
    p.fragment = scene_colors;
    canvas_draw(&c, &p, 3);
    for (int y = 0; y < 200; y++)
        for (int x = 0; x < 200; x++) {
            if (canvas_float(&c, x, y, 3) == 0) continue;
            double up = 1 - (y + 0.5) / 200, right = (x + 0.5) / 200 - up / 2;
            CHECK_NEAR(canvas_float(&c, x, y, 0), 1 - up - right, 1e-5);
            CHECK_NEAR(canvas_float(&c, x, y, 1), right, 1e-5);
            CHECK_NEAR(canvas_float(&c, x, y, 2), up, 1e-5);
        }
    canvas_close(&c);
}

/* The stack holds noise where the packets will lie. */
#ifdef __GNUC__
__attribute__((noinline))
#endif
static int fragment_poison(void)
{
    volatile unsigned char noise[200000];
    for (int i = 0; i < 200000; i++) noise[i] = 0x3F;
    return noise[0];
}

static long fragment_lod_packets;
static void fragment_lod_is_zero(const void *uniforms, const shade_fragments *SHADE_RESTRICT in,
                                 shade_colors *SHADE_RESTRICT out)
{
    (void)uniforms;
    (void)out;
    for (int i = 0; i < SHADE_LANES; i++) CHECK(float_bits(in->lod[i]) == 0);
    fragment_lod_packets++;
}

/* Sizes that are no multiples of a packet: the last packet of a batch is not full, and memory
   that another draw has filled shows in a lane that is not set. */
TEST(fragment, without_a_lod_texture_lod_is_zero_in_every_packet)
{
    shade_vec4 clip[3];
    scene s = { 0 };
    for (int k = 0; k < 3; k++) clip[k] = clip_corners[k];
    s.clip = clip;
    for (int i = 0; i < 6; i++) {
        canvas c = canvas_ready(61, 47, 0, SHADE_FORMAT_RGBA8, 1);
        shade_pipeline p = scene_pipeline(&s);
        p.fragment = fragment_lod_is_zero;
        p.interpolation = (shade_interpolation)(i % 3);
        p.may_discard = i / 3;
        fragment_lod_packets = 0;
        CHECK(fragment_poison());
        canvas_draw(&c, &p, 3);
        CHECK(fragment_lod_packets > 2);
        canvas_close(&c);
    }
}
