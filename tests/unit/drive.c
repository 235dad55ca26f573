/* drive.c - the whole of a draw: arguments, results, stats, bands and strips, memory. */
#include "unit.h"

typedef struct drive_call { /* everything a draw is given, to be spoiled one field at a time */
    canvas c;
    shade_vec4 clip[6];
    uint32_t indices[6];
    scene s;
    shade_pipeline p;
    int index_count, vertex_count;
} drive_call;

static void drive_open(drive_call *d, shade_format format)
{
    memset(d, 0, sizeof *d);
    d->c = canvas_open(24, 18, 27, format, 1);
    for (int k = 0; k < 6; k++) {
        d->clip[k] = clip_corners[k % 3];
        d->indices[k] = (uint32_t)k;
    }
    d->s.clip = d->clip;
    d->p = scene_pipeline(&d->s);
    d->index_count = 6;
    d->vertex_count = 6;
    CHECK_INT(shade_clear(&d->c.target, shade_v4(0.5f, 0.25f, 0.75f, 1), 0.9f), SHADE_OK);
}

static shade_result drive_draw(drive_call *d)
{
    return shade_draw(&d->c.target, &d->p, d->indices, d->index_count, d->vertex_count, NULL);
}

/* The call fails as stated and changes no byte of either buffer; then the call is made whole again.
   */
static void refused(int line, drive_call *d, const shade_target *target, const shade_pipeline *p,
                    shade_result want)
{
    size_t colors = d->c.color_bytes + 2 * CANVAS_GUARD,
           depths = d->c.depth_bytes + 2 * CANVAS_GUARD;
    unsigned char *before = test_memory(colors + depths);
    memcpy(before, d->c.color, colors);
    memcpy(before + colors, d->c.depth, depths);
    shade_result got = shade_draw(target, p, d->indices, d->index_count, d->vertex_count, NULL);
    test_int(__FILE__, line, "shade_draw", (long long)got, (long long)want);
    test_int(__FILE__, line, "unchanged memory",
             memcmp(before, d->c.color, colors) || memcmp(before + colors, d->c.depth, depths), 0);
    free(before);
}
#define REFUSED(want) refused(__LINE__, &d, &d.c.target, &d.p, want)

/* G2 */
TEST(drive, missing_pointers_are_bad_arguments)
{
    drive_call d;
    drive_open(&d, SHADE_FORMAT_RGBA8);
    CHECK_INT(drive_draw(&d), SHADE_OK);
    refused(__LINE__, &d, NULL, &d.p, SHADE_ERROR_ARGUMENT);
    refused(__LINE__, &d, &d.c.target, NULL, SHADE_ERROR_ARGUMENT);
    refused(__LINE__, &d, NULL, NULL, SHADE_ERROR_ARGUMENT);
    d.p.vertex = NULL;
    REFUSED(SHADE_ERROR_ARGUMENT);
    CHECK_INT(shade_clear(NULL, shade_v4(0, 0, 0, 0), 1), SHADE_ERROR_ARGUMENT);
    CHECK_INT(shade_clear(&d.c.target, shade_v4(0, 0, 0, 0), (float)NAN), SHADE_ERROR_ARGUMENT);
    CHECK_INT(canvas_bytes(&d.c, 0, 0)[0], 128);
    canvas_close(&d.c);
}

/* Each row breaks one rule of shade_target: sizes are 1 .. 16384, a stride is at least the width,
   the format is known, there is a buffer, clip rectangles and strips are not negative, a strip is
   within the picture, and 32 bits count the pixels of the memory. */
#define TARGET_FAULT(field, value) FAULT(shade_target, field, value)
static const refusal bad_targets[] = {
    { SHADE_ERROR_TARGET, { TARGET_FAULT(width, 0) } },
    { SHADE_ERROR_TARGET, { TARGET_FAULT(height, 0) } },
    { SHADE_ERROR_TARGET, { TARGET_FAULT(width, -24) } },
    { SHADE_ERROR_TARGET, { TARGET_FAULT(height, -18) } },
    { SHADE_ERROR_TARGET, { TARGET_FAULT(width, 16385), TARGET_FAULT(stride, 0) } },
    { SHADE_ERROR_TARGET, { TARGET_FAULT(height, 16385) } },
    { SHADE_ERROR_TARGET, { TARGET_FAULT(width, INT_MAX), TARGET_FAULT(stride, 0) } },
    { SHADE_ERROR_TARGET, { TARGET_FAULT(stride, 23) } },
    { SHADE_ERROR_TARGET, { TARGET_FAULT(stride, -27) } },
    { SHADE_ERROR_TARGET, { TARGET_FAULT(stride, INT_MIN) } },
    { SHADE_ERROR_TARGET, { TARGET_FAULT(height, 16384), TARGET_FAULT(stride, 262144) } },
    { SHADE_ERROR_TARGET, { TARGET_FAULT(format, CANVAS_FORMATS) } },
    { SHADE_ERROR_TARGET, { TARGET_FAULT(format, 77) } },
    { SHADE_ERROR_TARGET, { FAULT_NULL(shade_target, color), FAULT_NULL(shade_target, depth) } },
    { SHADE_ERROR_TARGET, { TARGET_FAULT(clip_width, -1), TARGET_FAULT(clip_height, 5) } },
    { SHADE_ERROR_TARGET, { TARGET_FAULT(clip_width, 5), TARGET_FAULT(clip_height, -1) } },
    { SHADE_ERROR_TARGET,
      { TARGET_FAULT(clip_x, INT_MIN), TARGET_FAULT(clip_y, 7),
        TARGET_FAULT(clip_width, INT_MIN) } },
    { SHADE_ERROR_TARGET, { TARGET_FAULT(row_offset, 3) } },
    { SHADE_ERROR_TARGET, { TARGET_FAULT(row_count, -1) } },
    { SHADE_ERROR_TARGET, { TARGET_FAULT(row_offset, -1), TARGET_FAULT(row_count, 5) } },
    { SHADE_ERROR_TARGET, { TARGET_FAULT(row_offset, 10), TARGET_FAULT(row_count, 9) } },
    { SHADE_ERROR_TARGET, { TARGET_FAULT(row_offset, INT_MAX), TARGET_FAULT(row_count, INT_MAX) } },
    { SHADE_ERROR_TARGET,
      { TARGET_FAULT(height, 16384), TARGET_FAULT(stride, INT_MAX), TARGET_FAULT(row_offset, 1),
        TARGET_FAULT(row_count, 16383) } },
};

/* G2 */
TEST(drive, bad_targets_are_refused_by_every_call)
{
    static const float position[] = { -1, -1, 0, 1, -1, 0, 0, 1, 0 };
    shade_draw_state state = plain_state(NULL);
    shade_mesh mesh = plain_mesh(position, 3);
    for (int row = 0; row < TEST_COUNT(bad_targets); row++) {
        const shade_result want = bad_targets[row].want;
        drive_call d;
        drive_open(&d, SHADE_FORMAT_RGBA8);
        shade_target bad = d.c.target;
        spoil(&bad, bad_targets[row].faults);
        refused(__LINE__, &d, &bad, &d.p, want);
        check_refusal(row, shade_clear(&bad, shade_v4(1, 1, 1, 1), 0.5f), want);
        check_refusal(row, shade_clear(&bad, shade_v4(1, 1, 1, 1), (float)NAN), want);
        CHECK_INT(canvas_bytes(&d.c, 0, 0)[0], 128);
        check_refusal(row, shade_draw_mesh(&bad, &mesh, &state, NULL), want);
        CHECK_INT(canvas_bytes(&d.c, 12, 12)[0], 128);
        canvas_close(&d.c);
    }
}

/* Clip rectangles from outside the picture, with sums beyond an int, of no pixel; the strip of all
   rows; no depth.  Where some of the triangle is inside, all of its centre is. */
static const struct {
    int drawn; /* whether (12, 12) is */
    fault faults[FAULTS];
} odd_targets[] = {
    { 0,
      { TARGET_FAULT(clip_x, INT_MAX), TARGET_FAULT(clip_y, INT_MAX),
        TARGET_FAULT(clip_width, INT_MAX), TARGET_FAULT(clip_height, INT_MAX) } },
    { 0,
      { TARGET_FAULT(clip_x, INT_MIN), TARGET_FAULT(clip_y, INT_MIN),
        TARGET_FAULT(clip_width, INT_MAX), TARGET_FAULT(clip_height, INT_MAX) } },
    { 1,
      { TARGET_FAULT(clip_x, -5), TARGET_FAULT(clip_y, -5), TARGET_FAULT(clip_width, INT_MAX),
        TARGET_FAULT(clip_height, INT_MAX) } },
    { 0, { TARGET_FAULT(clip_width, 0), TARGET_FAULT(clip_height, 7) } },
    { 0, { TARGET_FAULT(clip_x, 1) } }, /* an empty rectangle at (1, 0) */
    { 0, { TARGET_FAULT(clip_x, 24), TARGET_FAULT(clip_width, 5), TARGET_FAULT(clip_height, 5) } },
    { 1, { TARGET_FAULT(row_count, 18) } },
    { 1, { FAULT_NULL(shade_target, depth) } },
};

TEST(drive, odd_but_legal_targets_are_taken)
{
    for (int row = 0; row < TEST_COUNT(odd_targets); row++) {
        const int drawn = odd_targets[row].drawn;
        drive_call d;
        drive_open(&d, SHADE_FORMAT_RGBA8);
        shade_target *t = &d.c.target;
        spoil(t, odd_targets[row].faults);

        shade_stats stats;
        memset(&stats, 0x55, sizeof stats);
        CHECK_INT(shade_draw(t, &d.p, d.indices, 6, 6, &stats), SHADE_OK);
        CHECK_INT(shade_clear(t, shade_v4(0, 0, 0, 0), 1), SHADE_OK);
        CHECK_INT(stats.triangles, 2);
        CHECK_SAY((stats.fragments > 0) == drawn, "row %d", row);
        CHECK_INT(canvas_bytes(&d.c, 12, 12)[0], drawn ? 0 : 128);
        canvas_close(&d.c);
    }
}

/* An empty clip rectangle, so that no call writes to memory which is not there. */
TEST(drive, memory_of_2_to_the_32_minus_1_pixels_is_the_largest)
{
    drive_call d;
    drive_open(&d, SHADE_FORMAT_RGBA8);
    shade_target most = d.c.target;
    most.height = 13107;
    most.stride = 327685;
    most.clip_height = 7;
    const int fits = SIZE_MAX / 16 >= 0xFFFFFFFFu;
    CHECK_INT(shade_draw(&most, &d.p, d.indices, 6, 6, NULL), fits ? SHADE_OK : SHADE_ERROR_TARGET);
    CHECK_INT(shade_clear(&most, shade_v4(0, 0, 0, 0), 1), fits ? SHADE_OK : SHADE_ERROR_TARGET);
    most.stride++;
    CHECK_INT(shade_clear(&most, shade_v4(0, 0, 0, 0), 1), SHADE_ERROR_TARGET);
    canvas_close(&d.c);
}

#define PIPELINE_FAULT(field, value) FAULT(drive_call, p.field, value)
static const refusal bad_pipelines[] = {
    { SHADE_ERROR_STATE, { PIPELINE_FAULT(varyings, -1) } },
    { SHADE_ERROR_STATE, { PIPELINE_FAULT(varyings, SHADE_MAX_VARYINGS + 1) } },
    { SHADE_ERROR_STATE, { PIPELINE_FAULT(varyings, INT_MAX) } },
    { SHADE_ERROR_STATE, { PIPELINE_FAULT(varyings, INT_MIN) } },
    { SHADE_ERROR_STATE, { PIPELINE_FAULT(interpolation, 3) } },
    { SHADE_ERROR_STATE, { PIPELINE_FAULT(raster.cull, 3) } },
    { SHADE_ERROR_STATE, { PIPELINE_FAULT(raster.depth_test, 6) } },
    { SHADE_ERROR_STATE, { PIPELINE_FAULT(raster.depth_test, 1000000) } },
    { SHADE_ERROR_STATE, { PIPELINE_FAULT(raster.blend, 3) } },
    { SHADE_ERROR_STATE, { FAULT_REAL(drive_call, p.raster.depth_bias, NAN) } },
    { SHADE_ERROR_STATE, { FAULT_REAL(drive_call, p.raster.depth_bias, -INFINITY) } },
    { SHADE_ERROR_MESH, { FAULT(drive_call, index_count, -1) } },
    { SHADE_ERROR_MESH, { FAULT(drive_call, index_count, -3) } },
    { SHADE_ERROR_MESH, { FAULT(drive_call, index_count, INT_MIN) } },
    { SHADE_ERROR_MESH, { FAULT(drive_call, vertex_count, -1) } },
};

/* G2 */
TEST(drive, bad_pipelines_are_refused)
{
    for (int row = 0; row < TEST_COUNT(bad_pipelines); row++) {
        drive_call d;
        drive_open(&d, SHADE_FORMAT_RGBA8);
        spoil(&d, bad_pipelines[row].faults);
        REFUSED(bad_pipelines[row].want);
        canvas_close(&d.c);
    }
}

/* G2 */
TEST(drive, bad_indices_are_refused_before_a_pixel_changes)
{
    for (int k = 0; k < 8; k++) {
        drive_call d;
        drive_open(&d, SHADE_FORMAT_RGBA8);
        switch (k) {
        case 0:
            d.index_count = 5;
            break;
        case 1:
            d.index_count = 1;
            break;
        case 2:
            d.indices[5] = 6;
            break; /* the last one: the first triangle must not be drawn */
        case 3:
            d.indices[0] = 0xFFFFFFFFu;
            break;
        case 4:
            d.vertex_count = 5;
            break;
        case 5:
            d.vertex_count = 0;
            break;
        case 6:
            d.indices[3] = 0x80000000u;
            break;
        default:
            d.index_count = 4;
            break;
        }
        REFUSED(SHADE_ERROR_INDEX);
        canvas_close(&d.c);
    }
    drive_call d;
    drive_open(&d, SHADE_FORMAT_RGBA8);
    CHECK_INT(shade_draw(&d.c.target, &d.p, NULL, 6, 5, NULL), SHADE_ERROR_INDEX);
    CHECK_INT(shade_draw(&d.c.target, &d.p, NULL, 5, 6, NULL), SHADE_ERROR_INDEX);
    CHECK_INT(shade_draw(&d.c.target, &d.p, NULL, 3, 6, NULL), SHADE_OK);
    CHECK_INT(shade_draw(&d.c.target, &d.p, NULL, 3, -6, NULL), SHADE_ERROR_MESH);
    CHECK_INT(shade_draw(&d.c.target, &d.p, d.indices, 3, -6, NULL), SHADE_ERROR_MESH);
    canvas_close(&d.c);
}

/* Lists of whole vectors and of a rest. */
TEST(drive, every_index_is_0_where_there_is_one_vertex)
{
    static uint32_t zeros[99];
    drive_call d;
    drive_open(&d, SHADE_FORMAT_RGBA8);
    for (int n = 0; n <= 99; n += 3)
        CHECK_INT(shade_draw(&d.c.target, &d.p, zeros, n, 1, NULL), SHADE_OK);
    canvas_close(&d.c);
}

/* The list is longer than several batches of vertices; the bad index is the first that is too
   great, the second, or the greatest there is. */
/* G2 */
TEST(drive, one_bad_index_anywhere_in_a_long_list_is_found)
{
    enum { COUNT = 600 };
    static uint32_t indices[COUNT];
    drive_call d;
    drive_open(&d, SHADE_FORMAT_RGBA8);
    for (int i = 0; i < COUNT; i++) indices[i] = (uint32_t)(i % 6);
    for (int i = 0; i < COUNT; i++) {
        uint32_t good = indices[i];
        indices[i] = i % 3 == 0 ? 6 : i % 3 == 1 ? 7 : 0xFFFFFFFFu;
        CHECK_INT(shade_draw(&d.c.target, &d.p, indices, COUNT, 6, NULL), SHADE_ERROR_INDEX);
        indices[i] = good;
    }
    CHECK_INT(canvas_bytes(&d.c, 12, 12)[0], 128);
    CHECK_INT(shade_draw(&d.c.target, &d.p, indices, COUNT, 6, NULL), SHADE_OK);
    CHECK(canvas_bytes(&d.c, 12, 12)[0] != 128);
    canvas_close(&d.c);
}

TEST(drive, no_triangles_is_no_error)
{
    drive_call d;
    drive_open(&d, SHADE_FORMAT_RGBA8);
    shade_stats stats;
    memset(&stats, 0x55, sizeof stats);
    CHECK_INT(shade_draw(&d.c.target, &d.p, d.indices, 0, 6, &stats), SHADE_OK);
    CHECK(stats.triangles == 0 && stats.culled == 0 && stats.clipped == 0 && stats.rejected == 0);
    CHECK(stats.drawn == 0 && stats.fragments == 0);
    CHECK_INT(shade_draw(&d.c.target, &d.p, NULL, 0, 0, NULL), SHADE_OK);
    canvas_close(&d.c);
}

/* --------------------------------------------------------------------------- random whole draws */

enum { DRAW_VERTICES = 120, DRAW_INDICES = 450 };

typedef struct random_draw {
    shade_vec4 clip[DRAW_VERTICES], color[DRAW_INDICES / 3];
    float attribute[DRAW_VERTICES * 5];
    uint32_t indices[DRAW_INDICES];
    scene s;
    shade_pipeline p;
    int index_count;
} random_draw;

static void random_pipeline(random_draw *r, int nasty)
{
    memset(&r->s, 0, sizeof r->s);
    for (int i = 0; i < DRAW_VERTICES; i++) {
        double w = (double)rnd_log(0.2, 5) * (rnd_one_in(12) ? -1 : 1),
               far_out = rnd_one_in(10) ? 20 : 1.3;
        r->clip[i] = shade_v4((float)((double)rnd_float(-far_out, far_out) * w),
                              (float)((double)rnd_float(-far_out, far_out) * w),
                              (float)((double)rnd_float(-1.2, 1.2) * w), (float)w);
        if (nasty && rnd_one_in(15)) fill_nasty(&r->clip[i], sizeof r->clip[i]);
        if (nasty && rnd_one_in(15)) r->clip[i].x = rnd_sign() * rnd_log(1e20, 2e30);
    }
    for (int i = 0; i < DRAW_VERTICES * 5; i++)
        r->attribute[i] = nasty && rnd_one_in(40) ? rnd_nasty() : rnd_float(0, 1);
    for (int i = 0; i < DRAW_INDICES / 3; i++) {
        r->color[i] = shade_v4(rnd_float(0, 1), rnd_float(0, 1), rnd_float(0, 1), rnd_float(0, 1));
    }
    r->index_count = rnd_int(1, DRAW_INDICES / 3) * 3;
    for (int i = 0; i < r->index_count; i++) {
        r->indices[i] = (uint32_t)rnd_int(0, DRAW_VERTICES - 1);
        if (i > 6 && rnd_one_in(3))
            r->indices[i] = r->indices[i - rnd_int(1, 6)]; /* some without area */
    }
    r->s.clip = r->clip;
    r->s.attribute = r->attribute;
    r->s.color = r->color;
    r->s.varyings = SHADE_MAX_VARYINGS < 5 ? SHADE_MAX_VARYINGS : 5;
    r->p = scene_pipeline(&r->s);
    static shade_fragment_shader *const shaders[] = { scene_flat, scene_colors, fragment_sieve,
                                                      NULL };
    int kind = rnd_int(0, 9);
    r->p.fragment = shaders[kind < 4 ? 0 : kind < 8 ? 1 : kind - 6];
    r->p.may_discard = r->p.fragment == fragment_sieve || rnd_one_in(5);
    r->p.interpolation = (shade_interpolation)(rnd_one_in(2) ? 0 : rnd_int(0, 2));
    r->p.raster.cull = (shade_cull)rnd_int(0, 2);
    r->p.raster.depth_test = (shade_compare)rnd_int(0, 5);
    r->p.raster.depth_read_only = rnd_one_in(5);
    r->p.raster.depth_zero_to_one = rnd_int(0, 1);
    r->p.raster.depth_bias = rnd_one_in(3) ? rnd_float(-0.1, 0.1) : 0;
    r->p.raster.blend = (shade_blend)rnd_int(0, 2);
}

static void random_canvas_flags(shade_target *t)
{
    t->srgb = rnd_one_in(3);
    t->dither = rnd_one_in(3);
}

/* G1 */
TEST(drive, any_draw_keeps_to_its_memory_and_its_stats_add_up)
{
    static random_draw r;
    for (int i = 0; i < 700; i++) {
        int width = rnd_int(1, 70), height = rnd_int(1, 50);
        canvas c = canvas_open(width, height, rnd_one_in(2) ? width + rnd_int(0, 9) : 0,
                               (shade_format)(i % CANVAS_FORMATS), rnd_int(0, 3) > 0);
        random_pipeline(&r, 1);
        canvas_clear(&c, 0.5f);
        random_clip(&c.target);
        random_canvas_flags(&c.target);
        canvas before = c;
        before.color = canvas_block(c.color_bytes);
        before.depth = canvas_block(c.depth_bytes);
        memcpy(before.color, c.color, c.color_bytes + 2 * CANVAS_GUARD);
        memcpy(before.depth, c.depth, c.depth_bytes + 2 * CANVAS_GUARD);
        shade_stats stats;
        memset(&stats, 0x55, sizeof stats);
        CHECK_INT(shade_draw(&c.target, &r.p, r.indices, r.index_count, DRAW_VERTICES, &stats),
                  SHADE_OK);
        CHECK_SAY(stats_add_up(&stats, r.index_count / 3),
                  "%lld = %lld culled + %lld clipped + %lld rejected + %lld drawn", stats.triangles,
                  stats.culled, stats.clipped, stats.rejected, stats.drawn);
        int x0, y0, x1, y1;
        size_t cell = canvas_pixel_bytes(c.target.format);
        clip_bounds(&c.target, &x0, &y0, &x1, &y1);
        for (int y = 0; y < height; y++)
            for (int x = 0; x < width; x++) {
                size_t at = CANVAS_GUARD + canvas_index(&c, x, y) * cell,
                       zat = CANVAS_GUARD + canvas_index(&c, x, y) * 4;
                int in = x >= x0 && x < x1 && y >= y0 && y < y1;
                if (!in) CHECK(!memcmp(c.color + at, before.color + at, cell));
                if (!in || !c.target.depth || r.p.raster.depth_read_only)
                    CHECK(!memcmp(c.depth + zat, before.depth + zat, 4));
                if (c.target.depth)
                    CHECK(canvas_depth(&c, x, y) >= 0 && canvas_depth(&c, x, y) <= 1);
            }
        canvas_close(&before);
        canvas_close(&c);
    }
}

/* but fragments, which add up over a partition */
TEST(drive, stats_do_not_depend_on_the_clip_rectangle)
{
    static random_draw r;
    for (int i = 0; i < 200; i++) {
        canvas c = canvas_open(64, 48, 0, SHADE_FORMAT_RGBA8, 0);
        random_pipeline(&r, 1);
        if (r.p.fragment == fragment_sieve) r.p.fragment = scene_flat;
        shade_stats whole, part;
        CHECK_INT(shade_draw(&c.target, &r.p, r.indices, r.index_count, DRAW_VERTICES, &whole),
                  SHADE_OK);
        long long fragments = 0;
        int x = rnd_int(0, 64), y = rnd_int(0, 48);
        for (int k = 0; k < 4; k++) {
            c.target.clip_x = k % 2 ? x : 0;
            c.target.clip_width = k % 2 ? 64 - x : x;
            c.target.clip_y = k / 2 ? y : 0;
            c.target.clip_height = k / 2 ? 48 - y : y;
            if (!c.target.clip_x && !c.target.clip_y && !c.target.clip_width &&
                !c.target.clip_height)
                continue;
            CHECK_INT(shade_draw(&c.target, &r.p, r.indices, r.index_count, DRAW_VERTICES, &part),
                      SHADE_OK);
            CHECK_INT(part.triangles, whole.triangles);
            CHECK_INT(part.culled, whole.culled);
            CHECK_INT(part.clipped, whole.clipped);
            CHECK_INT(part.rejected, whole.rejected);
            CHECK_INT(part.drawn, whole.drawn);
            fragments += part.fragments;
        }
        CHECK_INT(fragments, whole.fragments);
        canvas_close(&c);
    }
}

/* G13 */
TEST(drive, bands_and_rectangles_give_the_bits_of_the_whole)
{
    static random_draw r;
    for (int i = 0; i < 400; i++) {
        int width = rnd_int(1, 90), height = rnd_int(1, 70),
            stride = rnd_one_in(2) ? width + rnd_int(0, 9) : 0, with_depth = !rnd_one_in(5);
        shade_format format = (shade_format)(i % CANVAS_FORMATS);
        canvas whole = canvas_open(width, height, stride, format, with_depth);
        canvas parts = canvas_open(width, height, stride, format, with_depth);
        random_pipeline(&r, 0);
        random_canvas_flags(&whole.target);
        parts.target.srgb = whole.target.srgb;
        parts.target.dither = whole.target.dither;
        CHECK_INT(shade_clear(&whole.target, shade_v4(0.2f, 0.4f, 0.6f, 0.8f), 0.5f), SHADE_OK);
        CHECK_INT(shade_draw(&whole.target, &r.p, r.indices, r.index_count, DRAW_VERTICES, NULL),
                  SHADE_OK);
        /* cells of a random grid, in order from the last to the first */
        int xs = rnd_one_in(2) ? 1 : rnd_int(1, 6), ys = rnd_int(1, 6);
        for (int k = xs * ys - 1; k >= 0; k--) {
            int x0 = k % xs * width / xs, x1 = (k % xs + 1) * width / xs;
            int y0 = k / xs * height / ys, y1 = (k / xs + 1) * height / ys;
            if (x0 == x1 || y0 == y1) continue;
            parts.target.clip_x = x0;
            parts.target.clip_width = x1 - x0;
            parts.target.clip_y = y0;
            parts.target.clip_height = y1 - y0;
            CHECK_INT(shade_clear(&parts.target, shade_v4(0.2f, 0.4f, 0.6f, 0.8f), 0.5f), SHADE_OK);
            CHECK_INT(
                shade_draw(&parts.target, &r.p, r.indices, r.index_count, DRAW_VERTICES, NULL),
                SHADE_OK);
        }
        CHECK_SAY(canvas_same(&whole, &parts), "%d x %d, format %d, in %d x %d cells", width,
                  height, (int)format, xs, ys);
        canvas_close(&whole);
        canvas_close(&parts);
    }
}

/* Any rows of any picture: blending and dither depend on where a pixel is in the whole. */
/* G13 */
TEST(drive, strips_hold_the_rows_of_the_whole)
{
    static random_draw r;
    for (int i = 0; i < 300; i++) {
        int width = rnd_int(1, 60), height = rnd_int(2, 60), stride = width + rnd_int(0, 5);
        shade_format format = (shade_format)(i % CANVAS_FORMATS);
        canvas whole = canvas_open(width, height, stride, format, 1);
        random_pipeline(&r, 0);
        random_canvas_flags(&whole.target);
        CHECK_INT(shade_clear(&whole.target, shade_v4(0.2f, 0.4f, 0.6f, 0.8f), 0.5f), SHADE_OK);
        CHECK_INT(shade_draw(&whole.target, &r.p, r.indices, r.index_count, DRAW_VERTICES, NULL),
                  SHADE_OK);
        int rows = rnd_int(1, height), offset = rnd_int(0, height - rows);
        canvas strip = canvas_strip(width, height, stride, format, 1, offset, rows);
        strip.target.srgb = whole.target.srgb;
        strip.target.dither = whole.target.dither;
        CHECK_INT(shade_clear(&strip.target, shade_v4(0.2f, 0.4f, 0.6f, 0.8f), 0.5f), SHADE_OK);
        CHECK_INT(shade_draw(&strip.target, &r.p, r.indices, r.index_count, DRAW_VERTICES, NULL),
                  SHADE_OK);
        size_t cell = canvas_pixel_bytes(format);
        for (int y = offset; y < offset + rows; y++) {
            size_t a = canvas_index(&whole, 0, y), b = canvas_index(&strip, 0, y),
                   used = (size_t)width;
            CHECK(!memcmp(whole.color + CANVAS_GUARD + a * cell,
                          strip.color + CANVAS_GUARD + b * cell, used * cell));
            CHECK(!memcmp(whole.depth + CANVAS_GUARD + a * 4, strip.depth + CANVAS_GUARD + b * 4,
                          used * 4));
        }
        canvas_close(&whole);
        canvas_close(&strip);
    }
}

/* What a draw leaves in memory that it does not clear must not show in the next. */
TEST(drive, drawing_twice_gives_the_same_bits)
{
    static random_draw r;
    for (int i = 0; i < 100; i++) {
        canvas c[2];
        canvas_twins(c, 50, 40, (shade_format)(i % CANVAS_FORMATS), 0.5f);
        random_pipeline(&r, 0);
        shade_stats sa, sb;
        CHECK_INT(shade_draw(&c[0].target, &r.p, r.indices, r.index_count, DRAW_VERTICES, &sa),
                  SHADE_OK);
        CHECK_INT(shade_draw(&c[1].target, &r.p, r.indices, r.index_count, DRAW_VERTICES, &sb),
                  SHADE_OK);
        CHECK(!memcmp(&sa, &sb, sizeof sa));
        canvas_twins_close(c);
    }
}

/* the queue never reorders what lies in one pixel */
TEST(drive, one_draw_equals_its_triangles_drawn_one_by_one)
{
    static random_draw r;
    for (int i = 0; i < 150; i++) {
        canvas c[2];
        canvas_twins(c, 40, 30, (shade_format)(i % CANVAS_FORMATS), 0.5f);
        random_pipeline(&r, 0);
        r.p.fragment =
            r.p.fragment == fragment_sieve ? scene_colors : r.p.fragment; /* no use of primitive */
        if (r.p.fragment == scene_flat) r.p.fragment = scene_colors;
        shade_stats whole, one;
        long long fragments = 0;
        CHECK_INT(shade_draw(&c[0].target, &r.p, r.indices, r.index_count, DRAW_VERTICES, &whole),
                  SHADE_OK);
        for (int k = 0; k < r.index_count; k += 3) {
            CHECK_INT(shade_draw(&c[1].target, &r.p, r.indices + k, 3, DRAW_VERTICES, &one),
                      SHADE_OK);
            fragments += one.fragments;
        }
        CHECK_INT(fragments, whole.fragments);
        canvas_twins_close(c);
    }
}
