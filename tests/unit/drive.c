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
    r->p.raster.blend = (shade_blend)rnd_int(0, SHADE_BLEND_ADD);
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

/* ---------------------------------------------------------------------- which fault is reported */

/* What is wrong with a call: of several faults the first category is told, in the order NULLs,
   target, mesh, state, lights, texture, indices, room; nothing is written. */

typedef struct whole_call { /* all that any call is given, good until it is spoilt */
    canvas c;
    shade_target picture, half; /* c's; and one of half its size to resolve into */
    shade_mesh m;
    shade_draw_state s;
    shade_pipeline p;
    shade_line_state l;
    shade_texture map;
    shade_chunk chunk;
    shade_light lamp;
    scene vertices;
    shade_vec4 clip[6];
    float positions[18], crease;
    uint32_t indices[6];
    uint16_t indices16[6];
    int index_count, vertex_count, point_count, factor, capacity, triangles;
    size_t bytes;
    const shade_target *target;
    const shade_mesh *mesh;
    const shade_draw_state *state;
    const shade_pipeline *pipeline;
    const shade_line_state *lines;
    const shade_vec3 *points;
    shade_texture *texture, *levels;
    void *memory;
    shade_write_fn *sink;
    shade_vec3 *normals;
    shade_edge *edges;
    shade_chunk *chunks;
    shade_stats stats;
} whole_call;

static struct { /* what calls may write */
    shade_vec3 normals[6];
    shade_edge edges[6];
    shade_chunk chunks[6];
    shade_texture levels[4];
    uint32_t memory[64], written, half[25], order[6];
} whole_out;

static int whole_sink(void *user, const void *bytes, size_t size)
{
    (void)user;
    (void)bytes;
    (void)size;
    whole_out.written = 1;
    return 0;
}

static void whole_open(whole_call *w)
{
    static const uint32_t texels[16];
    memset(w, 0, sizeof *w);
    memset(&whole_out, CANVAS_BYTE, sizeof whole_out);
    memset(&w->stats, CANVAS_BYTE, sizeof w->stats);
    w->c = canvas_open(10, 10, 0, SHADE_FORMAT_RGBA8, 1);
    w->picture = w->half = w->c.target;
    w->half.width = w->half.height = 5;
    w->half.color = whole_out.half;
    w->half.depth = NULL;
    for (int k = 0; k < 6; k++) {
        w->clip[k] = clip_corners[k % 3];
        w->indices[k] = (uint32_t)k;
        put3(w->positions + 3 * k, shade_v3(w->clip[k].x, w->clip[k].y, w->clip[k].z));
    }
    w->map.pixels = texels;
    w->map.width = w->map.height = 4;
    w->m.positions = w->m.texcoords = w->positions;
    w->m.vertex_count = 6;
    w->m.indices = w->indices;
    w->m.index_count = 6;
    w->chunk.count = 2;
    w->s.shading = SHADE_SHADING_PER_VERTEX;
    w->s.diffuse_map = &w->map;
    w->vertices.clip = w->clip;
    w->p = scene_pipeline(&w->vertices);
    w->p.varyings = 2;
    w->p.lod_texture = &w->map;
    w->vertices.attribute = w->positions;
    w->vertices.varyings = 2;
    w->index_count = w->vertex_count = 6;
    w->point_count = 4;
    w->factor = 2;
    w->capacity = 6;
    w->triangles = 1;
    w->bytes = sizeof whole_out.memory;
    w->target = &w->picture;
    w->mesh = &w->m;
    w->state = &w->s;
    w->pipeline = &w->p;
    w->lines = &w->l;
    w->points = (const shade_vec3 *)(const void *)w->positions;
    w->texture = &w->map;
    w->levels = whole_out.levels;
    w->memory = whole_out.memory;
    w->sink = whole_sink;
    w->normals = whole_out.normals;
    w->edges = whole_out.edges;
    w->chunks = whole_out.chunks;
}

/* Calls by letter: Draw, Mesh, Lines, Normals, Corner normals, Edges, Boxes of chunks, mipmaps X,
   Resolve, Ppm, pnG, clear K. */
static const char whole_calls[] = "DMLNCEBXRPGK";

static shade_result whole_result(whole_call *w, char call)
{
    int count;
    switch (call) {
    case 'D':
        return shade_draw(w->target, w->pipeline, w->indices, w->index_count, w->vertex_count,
                          &w->stats);
    case 'M': return shade_draw_mesh(w->target, w->mesh, w->state, &w->stats);
    case 'L': return shade_draw_lines(w->target, w->points, w->point_count, w->lines, &w->stats);
    case 'N': return shade_mesh_normals(w->mesh, w->normals);
    case 'C': return shade_mesh_corner_normals(w->mesh, w->crease, w->normals, w->memory, w->bytes);
    case 'E': return shade_mesh_edges(w->mesh, w->edges, w->capacity, &count);
    case 'B':
        return shade_mesh_chunks(w->mesh, w->triangles, w->chunks, w->capacity,
                                 whole_out.order);
    case 'X': return shade_build_mipmaps(w->texture, w->levels, w->memory, w->bytes);
    case 'R': return shade_resolve(&w->half, w->target, w->factor);
    case 'P': return shade_encode_ppm(w->sink, NULL, w->target);
    case 'G': return shade_encode_png(w->sink, NULL, w->target);
    default: return shade_clear(w->target, shade_v4(1, 1, 1, 1), 1);
    }
}

/* Faults 0, 1, ... of a category: each is made and gives the calls that it is one of; NULL: there
   is none. */
static const char *fault_argument(whole_call *w, int k)
{
    switch (k) {
    case 0: w->target = NULL; return "DMLRPGK";
    case 1: w->pipeline = NULL; return "D";
    case 2: w->p.vertex = NULL; return "D";
    case 3: w->mesh = NULL; return "MNCEB";
    case 4: w->state = NULL; return "M";
    case 5: w->lines = NULL; return "L";
    case 6:
        w->points = NULL;
        w->point_count = 4;
        return "L";
    case 7: w->normals = NULL; return "NC";
    case 8: w->memory = NULL; return "CX";
    case 9:
        w->edges = NULL;
        w->capacity = 6;
        return "E";
    case 10: w->texture = NULL; return "X";
    case 11: w->levels = NULL; return "X";
    case 12: w->sink = NULL; return "PG";
    case 13: w->capacity = -1; return "EB";
    case 14: w->memory = (char *)whole_out.memory + 2; return "CX";
    case 15:
        w->chunks = NULL;
        w->capacity = 6;
        return "B";
    case 16: w->triangles = -1; return "B";
    default: return NULL;
    }
}

static const char *fault_target(whole_call *w, int k)
{
    switch (k) {
    case 0: w->picture.width = 0; return "DMLRPGK";
    case 1: w->picture.stride = 9; return "DMLRPGK";
    case 2: w->picture.format = SHADE_FORMAT_A8; return "DMLRPGK";
    case 3: w->picture.clip_width = -1; return "DMLRPGK";
    case 4: w->picture.row_offset = 1; return "DMLRPGK";
    case 5: w->picture.color = NULL; return "RPG";
    case 6: w->half.format = (shade_format)-1; return "R";
    default: return NULL;
    }
}

static const char *fault_mesh(whole_call *w, int k)
{
    switch (k) {
    case 0: w->index_count = -3; return "D";
    case 1: w->vertex_count = -1; return "D";
    case 2: w->point_count = 3; return "L";
    case 3: w->point_count = -2; return "L";
    case 4: w->m.positions = NULL; return "MNCEB";
    case 5: w->m.vertex_count = -1; return "MNCEB";
    case 6: w->m.index_count = -3; return "MNCEB";
    case 7: w->m.position_stride = -12; return "MNCEB";
    case 8: w->m.color_stride = 6; return "MNCEB";
    case 9: w->m.chunk_count = 1; return "MNCE";
    case 10: w->m.chunk_count = -1; return "MNCE";
    case 11:
        w->m.chunks = &w->chunk;
        w->m.chunk_count = 1;
        w->chunk.first = 1;
        return "MNCE";
    case 12: w->m.indices16 = w->indices16; return "MNCEB";
    default: return NULL;
    }
}

static const char *fault_state(whole_call *w, int k)
{
    switch (k) {
    case 0:
        w->p.raster.blend = w->s.raster.blend = w->l.raster.blend = (shade_blend)3;
        return "DML";
    case 1: w->p.raster.cull = w->s.raster.cull = (shade_cull)-1; return "DM";
    case 2: w->p.varyings = SHADE_MAX_VARYINGS + 1; return "D";
    case 3: w->p.interpolation = (shade_interpolation)3; return "D";
    case 4: w->s.shading = (shade_shading)3; return "M";
    case 5: w->s.transparency = 1.5f; return "M";
    case 6: w->s.alpha_cutoff = (float)NAN; return "M";
    case 7: w->s.fragment = scene_flat; return "M";
    case 8: w->l.width = -1; return "L";
    case 9: w->l.cap = (shade_cap)2; return "L";
    case 10: w->crease = (float)NAN; return "C";
    default: return NULL;
    }
}

static const char *fault_lights(whole_call *w, int k)
{
    switch (k) {
    case 0: w->s.lighting.light_count = 1; return "M";
    case 1: w->s.lighting.model = (shade_model)6; return "M";
    case 2:
        w->lamp = shade_spot_light(w->lamp.diffuse, w->lamp.diffuse, 45, 0, w->lamp.diffuse);
        w->s.lighting.lights = &w->lamp;
        w->s.lighting.light_count = 1;
        return "M";
    default: return NULL;
    }
}

static const char *fault_texture(whole_call *w, int k)
{
    switch (k) {
    case 0: w->map.pixels = NULL; return "DMX";
    case 1: w->map.filter = (shade_filter)3; return "DMX";
    case 2: w->p.lod_varying = 1; return "D";
    default: return NULL;
    }
}

static const char *fault_index(whole_call *w, int k)
{
    switch (k) {
    case 0: w->indices[5] = 6; return "DMNCEB";
    case 1: w->index_count = w->m.index_count = 4; return "DMNCEB";
    default: return NULL;
    }
}

static const char *fault_capacity(whole_call *w, int k)
{
    switch (k) {
    case 0: w->bytes = 4; return "CX";
    case 1: w->capacity = 5; return "E";
    case 2: w->capacity = 1; return "B";
    default: return NULL;
    }
}

typedef struct call_fault { /* of a category and a number */
    const char *(*spoil)(whole_call *, int);
    shade_result result;
    int number;
} call_fault;
static const call_fault categories[] = {
    { fault_argument, SHADE_ERROR_ARGUMENT, 0 }, { fault_target, SHADE_ERROR_TARGET, 0 },
    { fault_mesh, SHADE_ERROR_MESH, 0 },         { fault_state, SHADE_ERROR_STATE, 0 },
    { fault_lights, SHADE_ERROR_LIGHTS, 0 },     { fault_texture, SHADE_ERROR_TEXTURE, 0 },
    { fault_index, SHADE_ERROR_INDEX, 0 },       { fault_capacity, SHADE_ERROR_CAPACITY, 0 },
};
enum { CATEGORIES = sizeof categories / sizeof categories[0], MOST_FAULTS = 64 };

/* The faults that a call can have, by rising category; returns how many. */
static int faults_of(char call, call_fault *list)
{
    int count = 0;
    for (int k = 0; k < CATEGORIES; k++) {
        whole_call w;
        call_fault f = categories[k];
        whole_open(&w);
        for (const char *calls; (calls = f.spoil(&w, f.number)) != NULL; f.number++)
            if (strchr(calls, call)) list[count++] = f;
        canvas_close(&w.c);
    }
    return count;
}

/* A call with two faults, which may be one, the later category made first, so that it cannot mend
   the other; or with none, NULL.  Where one is told nothing has changed. */
static void check_whole(char call, const call_fault *first, const call_fault *second)
{
    whole_call w;
    const shade_result want = first ? first->result : SHADE_OK;
    whole_open(&w);
    if (second) second->spoil(&w, second->number);
    if (first) first->spoil(&w, first->number);
    shade_result got = whole_result(&w, call);
    CHECK_SAY(got == want, "call %c, fault %d: got %d, want %d; and fault %d of %d", call,
              first ? first->number : -1, (int)got, (int)want, second ? second->number : -1,
              second ? (int)second->result : 0);
    if (strchr("DML", call))
        CHECK_INT(w.stats.triangles, want != SHADE_OK ? 0 : call == 'L' ? 4 : 2);
    for (size_t i = CANVAS_GUARD; want != SHADE_OK && i < CANVAS_GUARD + w.c.color_bytes; i++)
        CHECK(w.c.color[i] == CANVAS_BYTE && w.c.depth[i] == CANVAS_BYTE);
    for (size_t i = 0; want != SHADE_OK && i < sizeof whole_out; i++)
        CHECK(((const unsigned char *)&whole_out)[i] == CANVAS_BYTE);
    canvas_close(&w.c);
}

/* G2 */
TEST(drive, of_any_two_faults_the_first_category_is_told)
{
    call_fault list[MOST_FAULTS];
    int pairs = 0;
    if (SHADE_MAX_VARYINGS < 8) {
        test_skip("a map takes 8 varyings");
        return;
    }
    for (const char *call = whole_calls; *call; call++) {
        const int count = faults_of(*call, list);
        check_whole(*call, NULL, NULL);
        for (int i = 0; i < count; i++)
            for (int k = i; k < count; k++, pairs++) check_whole(*call, &list[i], &list[k]);
    }
    CHECK_SAY(pairs > 900, "%d pairs", pairs);
}

/* a NaN depth, a factor */
TEST(drive, sizes_that_do_not_fit_are_arguments_behind_good_targets)
{
    whole_call w;
    whole_open(&w);
    CHECK_INT(shade_clear(&w.picture, shade_v4(1, 1, 1, 1), (float)NAN), SHADE_ERROR_ARGUMENT);
    CHECK_INT(shade_resolve(&w.half, &w.picture, 3), SHADE_ERROR_ARGUMENT);
    w.picture.width = 0;
    CHECK_INT(shade_clear(&w.picture, shade_v4(1, 1, 1, 1), (float)NAN), SHADE_ERROR_TARGET);
    CHECK_INT(shade_resolve(&w.half, &w.picture, 3), SHADE_ERROR_TARGET);
    for (size_t i = 0; i < w.c.color_bytes; i++) CHECK(w.c.color[CANVAS_GUARD + i] == CANVAS_BYTE);
    canvas_close(&w.c);
}

/* Not as a format of colours, nor where there are none. */
TEST(drive, alpha_alone_is_no_format_of_a_target)
{
    for (const char *call = "DMLKRPGDMLK"; *call; call++) {
        whole_call w;
        whole_open(&w);
        w.picture.format = SHADE_FORMAT_A8;
        if (strlen(call) <= 4) w.picture.color = NULL; /* depth alone */
        if (SHADE_MAX_VARYINGS < 8) w.s.diffuse_map = NULL;
        CHECK_INT(whole_result(&w, *call), SHADE_ERROR_TARGET);
        for (size_t i = CANVAS_GUARD; i < CANVAS_GUARD + w.c.color_bytes; i++)
            CHECK(w.c.color[i] == CANVAS_BYTE && w.c.depth[i] == CANVAS_BYTE);
        canvas_close(&w.c);
    }
    whole_call w;
    whole_open(&w);
    w.half.format = SHADE_FORMAT_A8;
    CHECK_INT(shade_resolve(&w.half, &w.picture, 2), SHADE_ERROR_TARGET);
#ifndef SHADE_NO_STDIO
    CHECK_INT(shade_write_ppm("none.ppm", &w.half), SHADE_ERROR_TARGET);
    CHECK_INT(shade_write_png("none.png", &w.half), SHADE_ERROR_TARGET);
#endif
    canvas_close(&w.c);
}

TEST(drive, every_result_names_its_fields_in_a_text_of_its_own)
{
    static const char *const names[][11] = {
        { "no error" },
        { "NULL", "factor", "overlaps" },
        { "width", "height", "stride", "format", "color", "depth", "clip_width", "clip_height",
          "row_offset", "row_count" },
        { "positions", "count", "stride", "chunks" },
        { "enumerator", "transparency", "alpha_cutoff", "depth_bias", "width", "varyings",
          "cos_crease", "fragment" },
        { "lights", "light_count", "model" },
        { "pixels", "width", "height", "stride", "format", "wrap", "filter", "lod_varying" },
        { "vertex_count", "triangles" },
        { "room" },
        { "writing" },
    };
    enum { RESULTS = sizeof names / sizeof names[0] };
    CHECK_INT(RESULTS, SHADE_ERROR_IO + 1);
    for (int k = 0; k < RESULTS; k++) {
        const char *text = shade_result_string((shade_result)k);
        for (int n = 0; names[k][n]; n++)
            CHECK_SAY(strstr(text, names[k][n]), "\"%s\" does not name %s", text, names[k][n]);
        for (int j = 0; j < k; j++) CHECK(strcmp(text, shade_result_string((shade_result)j)) != 0);
    }
    static const int unknown[] = { -1, RESULTS, 1000, INT32_MAX, INT32_MIN };
    for (int k = 0; k < 5; k++) {
        const char *text = shade_result_string((shade_result)unknown[k]);
        CHECK(text && text[0] && strcmp(text, shade_result_string(SHADE_OK)) != 0);
    }
}
