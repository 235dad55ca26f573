/* cover.c - which pixels a triangle covers: exactly those of the top-left rule on snapped corners.
   */
#include "unit.h"

/* Draws triangles given in 24.8 window coordinates, one draw, each adding one; all at depth 1/2. */
static void draw_fx8(canvas *c, const int64_t *x, const int64_t *y, int vertices, int random_w,
                     shade_stats *stats)
{
    shade_vec4 *clip = test_memory((size_t)vertices * sizeof(shade_vec4));
    for (int k = 0; k < vertices; k++) {
        double w = random_w ? (double)rnd_log(0.5, 2) : 1;
        clip[k] = clip_of_fx8((double)x[k], (double)y[k], c->target.width, c->target.height, 0, w);
    }
    scene s = { clip, NULL, 0, NULL, NULL };
    shade_pipeline p = scene_pipeline(&s);
    p.raster.blend = SHADE_BLEND_ADD;
    p.raster.depth_test =
        vertices == 3 && rnd_one_in(2) ? SHADE_COMPARE_LESS : SHADE_COMPARE_ALWAYS;
    CHECK_INT(shade_draw(&c->target, &p, NULL, vertices, vertices, stats), SHADE_OK);
    free(clip);
}

/* Holds the picture, alpha 255 and depth 1/2 where covered, to the integer oracle. */
static void check_coverage(const canvas *c, const int64_t *x, const int64_t *y)
{
    int x0, y0, x1, y1, wrong = 0, wi = 0, wj = 0;
    const shade_target *t = &c->target;
    clip_bounds(t, &x0, &y0, &x1, &y1);
    for (int j = 0; j < t->height; j++) {
        for (int i = 0; i < t->width; i++) {
            int in = i >= x0 && i < x1 && j >= y0 && j < y1 && ref_inside_fx8(x, y, i, j);
            int got = canvas_bytes(c, i, j)[3] != 0;
            if (t->depth) got += 2 * (canvas_depth(c, i, j) == 0.5f);
            if (got == (t->depth ? 3 * in : in)) continue;
            wrong++;
            wi = i;
            wj = j;
        }
    }
    CHECK_SAY(wrong == 0,
              "%d wrong pixels of %d x %d, one of them %d %d, got %d; corners %lld %lld  %lld %lld "
              " %lld %lld; clip %d %d %d %d",
              wrong, t->width, t->height, wi, wj, canvas_bytes(c, wi, wj)[3] != 0, (long long)x[0],
              (long long)y[0], (long long)x[1], (long long)y[1], (long long)x[2], (long long)y[2],
              t->clip_x, t->clip_y, t->clip_width, t->clip_height);
}

/* G7 */
TEST(cover, random_triangles_cover_exactly_the_top_left_pixels)
{
    for (int i = 0; i < 10500; i++) {
        int big = i % 10 == 9;
        canvas c = canvas_open(big ? rnd_int(100, 280) : rnd_int(1, 70),
                               big ? rnd_int(60, 220) : rnd_int(1, 60), 0, SHADE_FORMAT_RGBA8,
                               rnd_int(0, 1));
        int64_t x[3], y[3];
        random_corners(i % 7, c.target.width, c.target.height, x, y);
        canvas_clear(&c, 1);
        random_clip(&c.target);
        draw_fx8(&c, x, y, 3, rnd_one_in(2), NULL);
        check_coverage(&c, x, y);
        canvas_close(&c);
    }
}

TEST(cover, corners_snap_to_the_nearest_256th_halves_up)
{
    canvas c = canvas_open(256, 256, 0, SHADE_FORMAT_RGBA8,
                           0); /* a power of two: every 1/512 pixel is a float */
    for (int i = 0; i < 600; i++) {
        int64_t x2[3], y2[3], x[3], y[3]; /* in 1/512; snapped: floor(v / 2 + 1/2) */
        shade_vec4 clip[3];
        for (int k = 0; k < 3; k++) {
            x2[k] = rnd_int(100, 2500) * 2 + 1;
            y2[k] = rnd_int(100, 2500) * 2 + 1;
            if (k == 2) x2[2] = x2[0] + rnd_int(-600, 600) * 2;
            x[k] = (x2[k] + 1) / 2;
            y[k] = (y2[k] + 1) / 2;
            clip[k] = shade_v4((float)((double)x2[k] / (256 * 256) - 1),
                               (float)(1 - (double)y2[k] / (256 * 256)), 0, 1);
        }
        canvas_clear(&c, 1);
        scene s = { clip, NULL, 0, NULL, NULL };
        shade_pipeline p = scene_pipeline(&s);
        canvas_draw(&c, &p, 3);
        check_coverage(&c, x, y);
    }
    /* the corner itself: a left edge at 1/512 left of a centre snaps onto it and owns it, for
       halves go up */
    static const int offset[] = { -2, -1, 0, 1 };
    for (int k = 0; k < 4; k++) {
        double X = 100.5 + offset[k] / 512.0;
        shade_vec4 clip[3];
        clip[0] = shade_v4((float)(X / 128 - 1), (float)(1 - 50.0 / 128), 0, 1);
        clip[1] = shade_v4((float)(X / 128 - 1), (float)(1 - 60.0 / 128), 0, 1);
        clip[2] = shade_v4((float)(120.0 / 128 - 1), (float)(1 - 55.0 / 128), 0, 1);
        canvas_clear(&c, 1);
        scene s = { clip, NULL, 0, NULL, NULL };
        shade_pipeline p = scene_pipeline(&s);
        canvas_draw(&c, &p, 3);
        CHECK_INT(canvas_bytes(&c, 100, 54)[3] != 0, offset[k] < 1);
    }
    canvas_close(&c);
}

/* A square of jittered triangles fills the picture and adds 1 a triangle: every pixel holds 1.
   Odd rounds give each vertex a w of its own, which must not move it. */
/* G7 */
TEST(cover, meshes_cover_every_pixel_exactly_once)
{
    enum { N = 24 };
    static shade_vec2 points[(N + 1) * (N + 1)];
    static shade_vec4 clip[(N + 1) * (N + 1)];
    static uint32_t indices[N * N * 6];
    for (int round = 0; round < 100; round++) {
        int n = rnd_int(1, N), count = jittered_grid(n, points, indices),
            vertices = (n + 1) * (n + 1);
        canvas c = canvas_open(rnd_int(1, 200), rnd_int(1, 150), 0, SHADE_FORMAT_RGBA32F, 0);
        for (int i = 0; i < vertices; i++) {
            double w = round % 2 ? (double)rnd_log(0.2, 5) : 1;
            clip[i] = shade_v4((float)((2 * (double)points[i].x - 1) * w),
                               (float)((2 * (double)points[i].y - 1) * w), 0, (float)w);
        }
        count_coverage(&c, clip, indices, count, vertices);
        for (int y = 0; y < c.target.height; y++)
            for (int x = 0; x < c.target.width; x++) CHECK_NEAR(canvas_float(&c, x, y, 0), 1, 0);
        canvas_close(&c);
    }
}

/* G7 */
TEST(cover, slivers_a_256th_wide_are_exact)
{
    for (int i = 0; i < 2000; i++) {
        canvas c = canvas_ready(90, 70, 0, SHADE_FORMAT_RGBA8, rnd_int(0, 1));
        int64_t x[3], y[3];
        x[0] = rnd_int(0, 90 * 256);
        y[0] = rnd_int(0, 70 * 256);
        x[1] = rnd_int(0, 90 * 256);
        y[1] = rnd_int(0, 70 * 256);
        int along = rnd_int(0, 3);
        if (along == 0) x[0] = x[1] = x[1] / 256 * 256 + 128; /* upright through centres */
        if (along == 1) y[0] = y[1] = y[1] / 256 * 256 + 128;
        x[2] = x[rnd_int(0, 1)] + rnd_int(-2, 2);
        y[2] = y[rnd_int(0, 1)] + rnd_int(-2, 2);
        random_clip(&c.target);
        draw_fx8(&c, x, y, 3, 0, NULL);
        check_coverage(&c, x, y);
        canvas_close(&c);
    }
}

/* Along an edge of one depth rounding would leave the range of the corners, on either side. */
TEST(cover, depth_of_slivers_stays_between_their_corners)
{
    long low = 0, high = 0;
    for (int i = 0; i < 2000; i++) {
        canvas c = canvas_open(90, 70, 0, SHADE_FORMAT_RGBA8, 1);
        int64_t x[3], y[3];
        shade_vec4 clip[3];
        float nearest = 1, farthest = 0;
        scene s = { clip, NULL, 0, NULL, NULL };
        shade_pipeline p = scene_pipeline(&s);
        x[0] = rnd_int(0, 89) * 256 + 128;
        y[0] = rnd_int(0, 69) * 256 + 128;
        x[1] = x[0] + rnd_int(-9, 9) * (i % 2 ? 256 : 2048);    /* through centres */
        y[1] = y[0] + rnd_int(-9, 9) * 2048;
        x[2] = x[rnd_int(0, 1)] + rnd_int(-2, 2);
        y[2] = y[rnd_int(0, 1)] + rnd_int(-2, 2);
        for (int k = 0; k < 3; k++) {
            float depth = k == 1 ? nearest : rnd_float(0.25, 0.75);
            clip[k] = clip_of_fx8((double)x[k], (double)y[k], 90, 70, 2 * (double)depth - 1, 1);
            nearest = depth < nearest ? depth : nearest;
            farthest = depth > farthest ? depth : farthest;
        }
        p.fragment = NULL;
        p.raster.depth_test = SHADE_COMPARE_ALWAYS;
        canvas_clear(&c, 2);
        canvas_draw(&c, &p, 3);
        for (int k = 0; k < 90 * 70; k++) {
            float z = c.target.depth[k];
            if (z > 1) continue;
            low += z == nearest;
            high += z == farthest;
            CHECK_SAY(z >= nearest && z <= farthest, "depth %.9g beyond %g .. %g", (double)z,
                      (double)nearest, (double)farthest);
        }
        canvas_close(&c);
    }
    CHECK_SAY(low > 100 && high > 100, "%ld on the nearest, %ld on the farthest", low, high);
}

/* Between two corners a million times as far as the third, 1/w would be rounded to 0 and below. */
TEST(cover, varyings_of_slivers_are_finite)
{
    long infinite = 0;
    for (int i = 0; i < 1500; i++) {
        canvas c = canvas_ready(90, 70, 0, SHADE_FORMAT_RGBA32F, 0);
        float values[3] = { 1, 2, 3 };
        shade_vec4 clip[3];
        scene s = { clip, values, 1, NULL, NULL };
        shade_pipeline p = scene_pipeline(&s);
        double far = (double)rnd_log(1, 1e12);
        int x = rnd_int(0, 89) * 256 + 128, y = rnd_int(0, 69) * 256 + 128;
        int dx = rnd_int(-9, 9) * 2048, dy = rnd_int(-9, 9) * 2048;
        clip[0] = clip_of_fx8(x, y, 90, 70, 0, far);
        clip[1] = clip_of_fx8(x + dx, y + dy, 90, 70, 0, far);
        clip[2] = clip_of_fx8(x + rnd_int(-2, 2), y + rnd_int(-2, 2), 90, 70, 0, 1);
        p.fragment = scene_colors;
        canvas_draw(&c, &p, 3);
        for (int k = 0; k < 90 * 70; k++)
            infinite += !isfinite(canvas_float(&c, k % 90, k / 90, 0));
        canvas_close(&c);
    }
    CHECK_INT(infinite, 0);
}

/* The largest picture there is, and narrow triangles down its left or right side: edges are as
   long, and as far from the clip rectangle, as they can be. */
TEST(cover, triangles_thousands_of_pixels_beside_the_clip_rectangle_draw_nothing)
{
    canvas c = canvas_strip(16384, 16384, 0, SHADE_FORMAT_RGBA8, 1, 8000, 16);
    canvas_clear(&c, 1);
    for (int i = 0; i < 400; i++) {
        int64_t x[3], y[3];
        shade_stats stats;
        int left = i % 2;
        for (int k = 0; k < 3; k++) {
            x[k] = (left ? 0 : 16384 * 256) + rnd_int(-1100, 1100);
            y[k] = rnd_int(0, 16384 * 256);
        }
        c.target.clip_x = left ? rnd_int(8, 16000) : 0;
        c.target.clip_y = 8000;
        c.target.clip_width = left ? 16384 - c.target.clip_x : rnd_int(384, 16370);
        c.target.clip_height = 16;
        draw_fx8(&c, x, y, 3, 0, &stats);
        CHECK_INT(stats.fragments, 0);
    }
    canvas_close(&c);
}

/* Boxes of few pixels, which the clip rectangle cuts out of triangles with a side of at most 510
   pixels and two of hundreds or thousands, in each order: most edges need more than 32 bits. */
TEST(cover, small_boxes_of_long_triangles_are_exact)
{
    canvas c = canvas_strip(16384, 16384, 0, SHADE_FORMAT_RGBA8, 1, 8000, 16);
    shade_target *t = &c.target;
    t->clip_height = 16;
    t->clip_y = 8000;
    for (int i = 0; i < 1800; i++) {
        const int along = i % 3, turn = i / 3 % 3;    /* along x, along y, along both */
        const int beside = rnd_int(-250, 250) * 256;
        int64_t x[3], y[3];
        int wrong = 0;
        t->clip_x = rnd_int(600, 15600);
        t->clip_width = rnd_int(32, 160);
        for (int k = 0; k < 3; k++) {
            const int v = (k + turn) % 3, far = k == 2;
            x[v] = t->clip_x * 256 + rnd_int(-255 * 256, 255 * 256) + beside;
            y[v] = 8000 * 256 + rnd_int(-255 * 256, 255 * 256) + beside;
            if (far && along != 1) x[v] = rnd_one_in(2) ? -16384 * 255 : 16384 * 511;
            if (far && along != 0) y[v] = rnd_int(-16384 * 255, 16384 * 511);
            if (far && i % 2 && along != 1)
                x[v] = x[(v + 1) % 3] + rnd_int(-1600 * 256, 1600 * 256);
            if (far && i % 2 && along != 0)
                y[v] = y[(v + 1) % 3] + rnd_int(-1600 * 256, 1600 * 256);
        }
        canvas_clear(&c, 1);
        draw_fx8(&c, x, y, 3, 0, NULL);
        for (int j = 0; j < 16; j++)
            for (int a = t->clip_x; a < t->clip_x + t->clip_width; a++)
                wrong += (canvas_bytes(&c, a, 8000 + j)[3] != 0) !=
                         ref_inside_fx8(x, y, a, 8000 + j);
        CHECK_SAY(wrong == 0, "%d wrong pixels; corners %lld %lld  %lld %lld  %lld %lld", wrong,
                  (long long)x[0], (long long)y[0], (long long)x[1], (long long)y[1],
                  (long long)x[2], (long long)y[2]);
    }
    canvas_close(&c);
}

/* G7 */
TEST(cover, the_biggest_pictures_are_exact) /* 16384 wide, or high by strips */
{
    for (int i = 0; i < 60; i++) {
        int wide = i % 2, rows = rnd_int(1, 5), offset = rnd_int(0, 16384 - rows);
        canvas c =
            wide ? canvas_open(16384, rows, 0, SHADE_FORMAT_RGBA8, 0)
                 : canvas_strip(rnd_int(1, 200), 16384, 0, SHADE_FORMAT_RGBA8, 0, offset, rows);
        int width = c.target.width, height = c.target.height;
        int64_t x[3], y[3];
        for (int k = 0; k < 3; k++) {
            x[k] = rnd_int(-width * 100, width * 356);
            y[k] = rnd_int(-height * 100, height * 356);
            if (i % 3 == 0 && wide) y[k] = rnd_int(0, height * 256);
            if (i % 3 == 0 && !wide) {
                x[k] = rnd_int(0, width * 256);
                y[k] = (offset + rnd_int(-2, rows + 2)) * 256;
            }
        }
        canvas_clear(&c, 1);
        draw_fx8(&c, x, y, 3, 0, NULL);
        for (int j = 0; j < rows; j++)
            for (int a = 0; a < width; a++) {
                int row = wide ? j : offset + j, want = ref_inside_fx8(x, y, a, row);
                if ((canvas_bytes(&c, a, row)[3] != 0) == want) continue;
                CHECK_SAY(
                    0, "pixel %d %d of %d x %d: want %d; corners %lld %lld  %lld %lld  %lld %lld",
                    a, row, width, height, want, (long long)x[0], (long long)y[0], (long long)x[1],
                    (long long)y[1], (long long)x[2], (long long)y[2]);
            }
        canvas_close(&c);
    }
}

/* An edge from a corner at one end of a wide picture that passes a pixel centre near the other end
   at less than 1/1000 pixel: the quotient that finds the span's end is nearly a whole number. */
TEST(cover, edges_that_miss_a_far_centre_by_a_hair_are_exact)
{
    for (int i = 0; i < test_rounds(120); i++) {
        int width = rnd_int(6000, 8000), height = rnd_int(40, 60), attempts = 0;
        canvas c = canvas_ready(width, height, 0, SHADE_FORMAT_RGBA8, i % 2);
        int64_t x[3], y[3], u, v, dy;
        do { /* to the centre: (u, v); along the edge: (dy u / v rounded, dy) */
            x[0] = rnd_int(-300, 300);
            y[0] = rnd_int(0, 500);
            u = (int64_t)rnd_int(width * 2 / 3, width - 1) * 256 + 128 - x[0];
            v = (int64_t)rnd_int(height / 2, height - 1) * 256 + 128 - y[0];
            dy = rnd_int(height * 200, height * 256);
        } while ((dy * u % v > 300 || x[0] + dy * u / v > width * 512) && ++attempts < 1000);
        x[1] = x[0] + dy * u / v;
        y[1] = y[0] + dy;
        x[2] = i % 3 ? rnd_int(0, width * 256) : x[1];
        y[2] = i % 3 ? -height * 200 : y[0];
        if (i % 5 == 1) {
            x[2] = x[0];
            y[2] = y[1];
        }
        for (int k = 0; k < 3; k++) {
            if (i % 4 > 1) x[k] = width * 256 - x[k];
            if (i % 8 > 3) y[k] = height * 256 - y[k];
        }
        draw_fx8(&c, x, y, 3, 0, NULL);
        check_coverage(&c, x, y);
        canvas_close(&c);
    }
}

/* where 32-bit edges end and 64-bit ones begin */
TEST(cover, triangles_of_a_million_pixels_are_exact)
{
    static const int sizes[][2] = { { 1024, 1024 }, { 2000, 520 }, { 524, 2000 },  { 1448, 724 },
                                    { 2040, 2040 }, { 1100, 950 }, { 1023, 1020 }, { 64, 2040 } };
    for (int i = 0; i < test_rounds(16); i++) {
        canvas c = canvas_ready(2048, 2048, 0, SHADE_FORMAT_RGBA8, i % 2);
        int64_t x[3], y[3], w = sizes[i % 8][0] * 256, h = sizes[i % 8][1] * 256;
        int64_t left = rnd_int(0, 2048 * 256 - (int)w), top = rnd_int(0, 2048 * 256 - (int)h);
        int shape = rnd_int(0, 3);
        for (int k = 0; k < 3; k++) {
            x[k] = left + (k == 1 ? w : k == 2 ? rnd_int(0, (int)w) : 0);
            y[k] = top + (k == 2 ? h : shape == 0 ? 0 : rnd_int(0, (int)h));
            if (shape == 3 && k == 1) x[k] = x[0] + rnd_int(-700, 700);
        }
        draw_fx8(&c, x, y, 3, 0, NULL);
        check_coverage(&c, x, y);
        canvas_close(&c);
    }
}

/* Long thin triangles across nearly nine million pixels: their area would fit 32 bits, their edges
   in the far corners of the box do not. */
TEST(cover, thin_triangles_across_nine_million_pixels_are_exact)
{
    canvas c = canvas_open(2950, 2950, 0, SHADE_FORMAT_RGB565, 0);
    for (int i = 0; i < 4; i++) {
        int64_t side = 2950 * 256, x[3] = { 0, side, side }, y[3] = { 0, side, side - 9000 };
        for (int k = 0; k < 3; k++) {
            if (i & 1) x[k] = side - x[k];
            if (i & 2) y[k] = side - y[k];
        }
        canvas_clear(&c, 1);
        draw_fx8(&c, x, y, 3, 0, NULL);
        long wrong = 0;
        for (int j = 0; j < 2950; j++)
            for (int k = 0; k < 2950; k++) {
                wrong += (canvas_565(&c, k, j) != 0) != ref_inside_fx8(x, y, k, j);
            }
        CHECK_INT(wrong, 0);
    }
    canvas_close(&c);
}

/* Of which the clip rectangle leaves a few columns: as narrow as small ones, in 64 bits. */
TEST(cover, borders_of_huge_triangles_are_exact)
{
    for (int i = 0; i < 60; i++) {
        canvas c = canvas_ready(1600, 600, 0, SHADE_FORMAT_RGBA8, 1);
        int64_t x[3] = { rnd_int(-1600 * 255, 0), 1600 * 511, rnd_int(0, 1600 * 256) };
        int64_t y[3] = { rnd_int(-600 * 255, 0), rnd_int(0, 600 * 511), 600 * 511 };
        c.target.clip_width = rnd_int(1, 12);
        c.target.clip_height = 600;
        c.target.clip_x = i % 2 ? rnd_int(0, 1588) : i % 4 ? 0 : 1600 - c.target.clip_width;
        draw_fx8(&c, x, y, 3, 0, NULL);
        check_coverage(&c, x, y);
        canvas_close(&c);
    }
}

/* The pixels of columns 0 .. 35 and of so many rows of the canvas, which the picture must have. */
static void check_left_end(canvas *c, const int64_t x[3], const int64_t y[3], int top, int rows)
{
    int wrong = 0;
    c->target.clip_y = c->target.clip_width = c->target.clip_height = 0;
    canvas_clear(c, 1);
    c->target.clip_y = top;
    c->target.clip_width = 36;
    c->target.clip_height = rows;
    draw_fx8(c, x, y, 3, 0, NULL);
    for (int row = 0; row < c->target.height; row++)
        for (int column = 0; column < 60; column++) {
            int want = column < 36 && row >= top && row < top + rows;
            if (want) want = ref_inside_fx8(x, y, column, row);
            wrong += (canvas_bytes(c, column, row)[3] != 0) != want;
        }
    CHECK_INT(wrong, 0);
}

/* Slivers of up to 16,000 pixels.  Only their left end is in the clip rectangle, in less than 32
   columns.  Their edges pass less than 64 rows above it, where they fit 32 bits; a few hundred rows
   below they do not, and those that wrap would draw the lower part of the rectangle. */
TEST(cover, ends_of_slivers_of_thousands_of_pixels_are_exact)
{
    canvas c = canvas_open(16384, 600, 0, SHADE_FORMAT_RGBA8, 0);
    for (int i = 0; i < 60; i++) {
        int first = rnd_int(8, 31), top;
        int64_t x[3] = { first * 256 + rnd_int(-300, 300), rnd_int(12000, 16000) * 256, 0 };
        int64_t y[3] = { rnd_int(-2000, 9000), rnd_int(600, 1100) * 256, 0 };

        x[2] = (x[0] + x[1]) / 2 + rnd_int(-400000, 400000);
        y[2] = y[0] + (y[1] - y[0]) * (x[2] - x[0]) / (x[1] - x[0]) - rnd_int(0, 3000);
        top = (int)(y[0] / 256) + rnd_int(0, 60);
        check_left_end(&c, x, y, top < 0 ? 0 : top, rnd_int(400, 512));
    }
    canvas_close(&c);
}

/* The same with a short side at the left, found among 200,000; each corner comes first in turn. */
TEST(cover, slivers_with_a_short_side_are_exact)
{
    static const struct { int64_t x[3], y[3]; int top, rows; } sliver[] = {
        { { 7202, 4054272, 27047 }, { -942, 197888, -163 }, 42, 497 },
        { { 4065024, 3823, 19614 }, { 233984, -740, -64 }, 35, 496 },
        { { 6449, 4040448, 23930 }, { -382, 218880, 50 }, 54, 504 },
    };
    canvas c = canvas_open(16384, 600, 0, SHADE_FORMAT_RGBA8, 0);
    for (int i = 0; i < 3 * TEST_COUNT(sliver); i++) {
        int64_t x[3], y[3];
        for (int k = 0; k < 3; k++) {
            x[k] = sliver[i / 3].x[(i + k) % 3];
            y[k] = sliver[i / 3].y[(i + k) % 3];
        }
        check_left_end(&c, x, y, sliver[i / 3].top, sliver[i / 3].rows);
    }
    canvas_close(&c);
}

/* 64-bit edges, level ones among them, through centres: a top edge owns them, a bottom edge not */
TEST(cover, level_edges_of_big_triangles_follow_the_rule)
{
    for (int i = 0; i < 8; i++) {
        canvas c = canvas_ready(1500, 1500, 0, SHADE_FORMAT_RGBA8, i & 1);
        int64_t x[3] = { 300, 1499 * 256, 0 }, y[3], level = 128 + 256 * (int64_t)rnd_int(5, 40);
        x[2] = rnd_int(0, 1499 * 256);
        y[0] = y[1] = level;
        y[2] = 1480 * 256 + rnd_int(0, 999);
        for (int k = 0; k < 3; k++) y[k] = i & 2 ? 1500 * 256 - y[k] : y[k];
        if (i & 4) {
            x[0] = 1499 * 256;
            x[1] = 300;
        }
        draw_fx8(&c, x, y, 3, 0, NULL);
        check_coverage(&c, x, y);
        canvas_close(&c);
    }
}

TEST(cover, wide_flat_triangles_are_exact) /* long quotients, whose float rounding must be mended */
{
    for (int i = 0; i < 50; i++) {
        int width = rnd_int(2000, 9000), height = rnd_int(3, 24);
        canvas c = canvas_ready(width, height, 0, SHADE_FORMAT_RGBA8, i % 2);
        int64_t x[3], y[3];
        for (int k = 0; k < 3; k++) {
            x[k] = k == 0   ? rnd_int(0, 3000)
                   : k == 1 ? width * 256 - rnd_int(0, 3000)
                            : rnd_int(0, width * 256);
            y[k] = rnd_int(-height * 128, height * 384);
            if (i % 3 == 0) y[k] = rnd_int(0, 2 * height) * 128;
        }
        draw_fx8(&c, x, y, 3, 0, NULL);
        check_coverage(&c, x, y);
        canvas_close(&c);
    }
}

/* Edges that pass through a centre in every row: of one that does not belong to the triangle the
   quotient of a span is 1/step above a whole number.  Where the float of 1/step is too small, as
   for steps of these numbers of rows, it is two below the answer in rows thousands of pixels
   wide. */
TEST(cover, wide_triangles_between_pixel_centres_are_exact)
{
    static const int rows[] = { 41, 47, 55, 61 };
    for (int i = 0; i < 16; i++) {
        canvas c = canvas_ready(4000, 62, 0, SHADE_FORMAT_RGBA8, 1);
        const int high = rows[i % 4], wide = high * (3900 / high);
        int64_t x[3] = { 50, 50 + wide, 0 }, y[3] = { 0, high, 0 };
        x[2] = i & 4 ? x[1] : x[0];
        y[2] = i & 4 ? 0 : high;
        for (int k = 0; k < 3; k++) {
            x[k] = (i & 8 ? 3999 - x[k] : x[k]) * 256 + 128;
            y[k] = y[k] * 256 + 128;
        }
        draw_fx8(&c, x, y, 3, 0, NULL);
        check_coverage(&c, x, y);
        canvas_close(&c);
    }
}

TEST(cover, facing_is_counter_clockwise_on_the_screen)
{
    recorder r = recorder_open(20000);
    for (int i = 0; i < 2000; i++) {
        canvas c = canvas_open(40, 40, 0, SHADE_FORMAT_RGBA8, 0);
        int64_t x[3], y[3];
        random_corners(1, 40, 40, x, y);
        int64_t turn = (x[1] - x[0]) * (y[2] - y[0]) -
                       (y[1] - y[0]) * (x[2] - x[0]); /* > 0: clockwise, y is down */
        shade_vec4 clip[3];
        for (int k = 0; k < 3; k++)
            clip[k] = clip_of_fx8((double)x[k], (double)y[k], 40, 40, 0, (double)rnd_log(0.5, 2));
        scene s = { clip, NULL, 0, NULL, &r };
        shade_pipeline p = scene_pipeline(&s);
        shade_stats stats;
        r.count = 0;
        stats = canvas_draw(&c, &p, 3);
        CHECK_INT(stats.fragments, r.count);
        for (int k = 0; k < r.count; k++) CHECK_INT(r.fragments[k].front, turn < 0);
        int fragments = r.count;
        p.raster.cull = SHADE_CULL_BACK;
        stats = canvas_draw(&c, &p, 3);
        CHECK_INT(stats.fragments, turn < 0 ? fragments : 0);
        if (fragments) CHECK_INT(stats.culled, turn < 0 ? 0 : 1);
        p.raster.cull = SHADE_CULL_FRONT;
        stats = canvas_draw(&c, &p, 3);
        CHECK_INT(stats.fragments, turn > 0 ? fragments : 0);
        canvas_close(&c);
    }
    free(r.fragments);
}

/* The two integer rules agree: the point moved an instant right and down, and edges that are top or
   left. */
TEST(cover, the_oracle_is_the_top_left_rule)
{
    int ties = 0;
    for (int i = 0; i < 200000; i++) {
        int64_t x[3], y[3], px = rnd_int(0, 9), py = rnd_int(0, 9);
        for (int k = 0; k < 3; k++) {
            x[k] = rnd_int(0, 19) * 128;
            y[k] = rnd_int(0, 19) * 128;
        }
        int64_t area = (x[1] - x[0]) * (y[2] - y[0]) - (y[1] - y[0]) * (x[2] - x[0]);
        if (area == 0) {
            CHECK(!ref_inside_fx8(x, y, (int)px, (int)py));
            continue;
        }
        int b = area > 0 ? 1 : 2, inside = 1; /* clockwise on the screen: 0, b, 3 - b */
        int order[4];
        order[0] = 0;
        order[1] = b;
        order[2] = 3 - b;
        order[3] = 0;
        for (int k = 0; k < 3; k++) {
            int64_t dx = x[order[k + 1]] - x[order[k]], dy = y[order[k + 1]] - y[order[k]];
            int64_t e = dx * (py * 256 + 128 - y[order[k]]) - dy * (px * 256 + 128 - x[order[k]]);
            int top = dy == 0 && dx > 0, left = dy < 0; /* clockwise, left edges go up */
            ties += e == 0;
            inside &= e > 0 || (e == 0 && (top || left));
        }
        CHECK_INT(ref_inside_fx8(x, y, (int)px, (int)py), inside);
    }
    CHECK_SAY(ties > 1000, "%d centres on edges", ties);
}

/* ----------------------------------------------------------- all of a lattice, and shared edges */

/* Coverage without samples: every triangle on a lattice, and shared edges whose corners are
   lattice points or lie thousands of pixels apart. */

enum {
    EXACT_POINTS = 13 * 13,                 /* of a lattice, at most */
    EXACT_PICTURE = 1024,                   /* a power of two: lattice points are floats */
    EXACT_CELL = 4,                         /* 3 pixels and one that stays empty */
    EXACT_ROW = EXACT_PICTURE / EXACT_CELL,
    EXACT_CELLS = EXACT_ROW * EXACT_ROW
};

/* side x side points over the 3 x 3 pixels of a cell; in 1/256 pixel */
typedef struct exact_lattice { int side, first, step; } exact_lattice;

/* One draw: a triangle in each cell.  The fragment shader marks pixel (i, j) of the cell of its
   primitive as bit 3 j + i. */
typedef struct exact_sheet {
    shade_vec4 clip[3 * EXACT_CELLS];
    uint16_t want[EXACT_CELLS], got[EXACT_CELLS];
    unsigned char front[EXACT_CELLS];
    int count;
    long outside, twice, facing; /* fragments beyond their cell, drawn again, of the wrong side */
} exact_sheet;

static void exact_vertex(const void *uniforms, const shade_vertex_ids *SHADE_RESTRICT in,
                         shade_vertices *SHADE_RESTRICT out)
{
    const exact_sheet *s = *(exact_sheet *const *)uniforms;
    for (int i = 0; i < SHADE_LANES; i++) {
        scene_put_clip(out, i, s->clip[in->index[i]]);
    }
}

static void exact_fragment(const void *uniforms, const shade_fragments *SHADE_RESTRICT in,
                           shade_colors *SHADE_RESTRICT out)
{
    exact_sheet *s = *(exact_sheet *const *)uniforms;
    (void)out;
    for (int k = 0; k < in->count; k++) {
        int cell = (int)in->primitive[k];
        int i = (int)in->x[k] - cell % EXACT_ROW * EXACT_CELL;
        int j = (int)in->y[k] - cell / EXACT_ROW * EXACT_CELL;
        if (i < 0 || i > 2 || j < 0 || j > 2) {
            s->outside++;
            continue;
        }
        s->twice += s->got[cell] >> (3 * j + i) & 1;
        s->got[cell] |= (uint16_t)(1u << (3 * j + i));
        s->facing += in->front[k] != s->front[cell];
    }
}

/* Lattice point p. */
static int64_t exact_x(exact_lattice l, int p) { return l.first + p % l.side * l.step; }
static int64_t exact_y(exact_lattice l, int p) { return l.first + p / l.side * l.step; }

/* Draws what the sheet holds and compares; returns the number of wrong triangles. */
static long exact_draw(exact_sheet *s, canvas *c)
{
    shade_stats stats;
    long wrong = 0;
    long long covered = 0;
    shade_pipeline p = { .vertex = exact_vertex, .fragment = exact_fragment, .uniforms = &s,
                         .raster.depth_test = SHADE_COMPARE_ALWAYS };
    memset(s->got, 0, sizeof s->got);
    stats = canvas_draw(c, &p, 3 * s->count);
    for (int k = 0; k < s->count; k++) {
        wrong += s->got[k] != s->want[k];
        for (int n = 0; n < 9; n++) covered += s->want[k] >> n & 1;
    }
    CHECK_INT(stats.fragments, covered);
    s->count = 0;
    return wrong;
}

static void exact_add(exact_sheet *s, exact_lattice l, const int corner[3], unsigned want,
                      int front)
{
    int cell = s->count++;
    for (int k = 0; k < 3; k++) {
        int64_t x = exact_x(l, corner[k]) + cell % EXACT_ROW * EXACT_CELL * 256;
        int64_t y = exact_y(l, corner[k]) + cell / EXACT_ROW * EXACT_CELL * 256;
        s->clip[3 * cell + k] = clip_of_fx8((double)x, (double)y, EXACT_PICTURE, EXACT_PICTURE, 0,
                                            1);
    }
    s->want[cell] = (uint16_t)want;
    s->front[cell] = (unsigned char)front;
}

/* The nine pixels on either side of the edge from a to b, ties as the top-left rule has them. */
static unsigned exact_side(exact_lattice l, int a, int b, int side)
{
    unsigned set = 0;
    for (int n = 0; n < 9; n++) {
        int sign = ref_edge_sign(exact_x(l, a), exact_y(l, a), exact_x(l, b), exact_y(l, b),
                                 n % 3 * 256 + 128, n / 3 * 256 + 128);
        set |= (unsigned)(sign == side) << n;
    }
    return set;
}

/* All triangles between points of the lattice, flat ones among them, wound both ways, in every
   rotation in turn; with and without a depth buffer, which take different ways to the queue. */
static long exact_all(exact_lattice l)
{
    static exact_sheet sheet;
    static uint16_t left[EXACT_POINTS][EXACT_POINTS], right[EXACT_POINTS][EXACT_POINTS];
    const int points = l.side * l.side;
    long triangles = 0, wrong = 0;
    for (int a = 0; a < points; a++)
        for (int b = 0; b < points; b++) {
            left[a][b] = (uint16_t)exact_side(l, a, b, 1);
            right[a][b] = (uint16_t)exact_side(l, a, b, -1);
        }
    for (int with_depth = 0; with_depth < 2; with_depth++) {
        canvas c = canvas_ready(EXACT_PICTURE, EXACT_PICTURE, 0, SHADE_FORMAT_RGBA8, with_depth);
        memset(&sheet, 0, sizeof sheet);
        for (int a = 0; a < points; a++) {
            for (int b = a + 1; b < points; b++) {
                for (int d = b + 1; d < points; d++) {
                    int64_t ax = exact_x(l, a), bx = exact_x(l, b) - ax, dx = exact_x(l, d) - ax;
                    int64_t ay = exact_y(l, a), by = exact_y(l, b) - ay, dy = exact_y(l, d) - ay;
                    int64_t area = bx * dy - by * dx;
                    unsigned want = left[a][b] & left[b][d] & left[d][a];
                    want |= (unsigned)right[a][b] & right[b][d] & right[d][a];
                    if (area == 0) want = 0;
                    for (int turn = 0; turn < 2; turn++) {
                        static const int order[6][3] = { { 0, 1, 2 }, { 0, 2, 1 }, { 1, 2, 0 },
                                                         { 2, 1, 0 }, { 2, 0, 1 }, { 1, 0, 2 } };
                        const int *o = order[(2 * (triangles / 2) + turn) % 6];
                        int point[3], corner[3];
                        point[0] = a;
                        point[1] = b;
                        point[2] = d;
                        for (int k = 0; k < 3; k++) corner[k] = point[o[k]];
                        exact_add(&sheet, l, corner, want, turn ? area > 0 : area < 0);
                        triangles++;
                        if (sheet.count == EXACT_CELLS) wrong += exact_draw(&sheet, &c);
                    }
                }
            }
        }
        wrong += exact_draw(&sheet, &c);
        CHECK_INT(sheet.outside, 0);
        CHECK_INT(sheet.twice, 0);
        CHECK_INT(sheet.facing, 0);
        canvas_close(&c);
    }
    CHECK_INT(wrong, 0);
    return triangles;
}

/* G7 */
TEST(cover, every_triangle_on_a_quarter_pixel_lattice)
{
    exact_lattice l = { 13, 0, 64 };    /* 3 pixels, both ends */
    CHECK_INT(exact_all(l), 2L * 2 * (169L * 168 * 167 / 6));
}

/* G7 */
TEST(cover, every_triangle_of_256ths_around_a_centre)
{
    exact_lattice l = { 7, 256 + 128 - 3, 1 };
    CHECK_INT(exact_all(l), 2L * 2 * (49L * 48 * 47 / 6));
}

/* Every pixel of a picture has been covered want times. */
static void check_covered(const canvas *c, int want)
{
    int rows = canvas_rows(c), top = c->target.row_offset, wrong = 0, wx = 0, wy = 0;
    for (int y = top; y < top + rows; y++) {
        for (int x = 0; x < c->target.width; x++) {
            if (canvas_float(c, x, y, 0) == (float)want) continue;
            wrong++;
            wx = x;
            wy = y;
        }
    }
    CHECK_SAY(wrong == 0, "%d of %d x %d pixels, one of them %d %d, covered %g times", wrong,
              c->target.width, c->target.height, wx, wy, (double)canvas_float(c, wx, wy, 0));
}

/* Meshes whose corners lie on the lattice, so that many edges and corners meet centres. */
/* G7 */
TEST(cover, lattice_meshes_cover_every_pixel_once)
{
    enum { N = 12 };
    static shade_vec2 points[(N + 1) * (N + 1)];
    static shade_vec4 clip[(N + 1) * (N + 1)];
    static uint32_t indices[N * N * 6];
    static int64_t x[(N + 1) * (N + 1)], y[(N + 1) * (N + 1)];
    int used = 0;
    for (int round = 0; round < 300; round++) {
        int n = rnd_int(1, N), size = n * rnd_int(2, 6), vertices = (n + 1) * (n + 1);
        int count = jittered_grid(n, points, indices);
        for (int i = 0; i < vertices; i++) {
            x[i] = (int64_t)floor((double)points[i].x * size * 4 + 0.5) * 64;
            y[i] = (int64_t)floor((double)points[i].y * size * 4 + 0.5) * 64;
            clip[i] = clip_of_fx8((double)x[i], (double)y[i], size, size, 0,
                                  round % 2 ? (double)rnd_log(0.5, 2) : 1);
        }
        if (!covers_square(x, y, indices, count, (int64_t)size * 256)) continue; /* folded */
        used++;
        canvas c = canvas_open(size, size, 0, SHADE_FORMAT_RGBA32F, 0);
        count_coverage(&c, clip, indices, count, vertices);
        check_covered(&c, 1);
        canvas_close(&c);
    }
    CHECK_SAY(used > 100, "%d meshes", used);
}

/* A few rows of pictures of 16384 pixels a side, under strips of triangles with edges of up to all
   of that length: some thin, some beyond the borders, where reach > 3 is clipped. */
/* G7 */
TEST(cover, strips_across_the_biggest_pictures_cover_every_pixel_once)
{
    enum { N = 60 };
    static const double reaches[] = { 1, 1.7, 2.9, 4, 40 };
    for (int round = 0; round < 30; round++) {
        shade_vec4 clip[2 * N + 2];
        uint32_t indices[6 * N];
        int upright = round % 2, n = rnd_int(1, N), rows = rnd_int(1, 3);
        double reach = reaches[round % 5], at[2] = { -reach, -reach };
        canvas c = canvas_strip(upright ? 64 : 16384, 16384, 0, SHADE_FORMAT_RGBA32F, 0,
                                rnd_int(0, 16384 - rows), rows);
        for (int i = 0; i <= n; i++) { /* zigzag between two lines at -reach and reach */
            for (int k = 0; k < 2; k++) {
                double w = round % 3 ? (double)rnd_log(0.3, 3) : 1, p, q = k ? reach : -reach;
                if (i) at[k] += (reach - at[k]) * rnd_unit() * 3 / (n + 3 - i);
                if (i == n) at[k] = reach;
                p = at[k];
                clip[2 * i + k] = shade_v4((float)((upright ? q : p) * w),
                                           (float)((upright ? p : q) * w), 0, (float)w);
            }
        }
        for (int i = 0; i < n; i++) {
            static const uint32_t quad[2][6] = { { 0, 1, 2, 3, 2, 1 }, { 0, 3, 2, 3, 0, 1 } };
            const uint32_t *q = quad[rnd_int(0, 1)];
            for (int k = 0; k < 6; k++) indices[6 * i + k] = (uint32_t)(2 * i) + q[k];
        }
        count_coverage(&c, clip, indices, 6 * n, 2 * n + 2);
        check_covered(&c, 1);
        canvas_close(&c);
    }
}

/* Fans of slivers around a centre outside the picture or in it: hundreds of edges that meet. */
/* G7 */
TEST(cover, fans_of_slivers_cover_every_pixel_once)
{
    enum { SPOKES = 400 };
    static shade_vec4 clip[SPOKES + 1];
    static uint32_t indices[3 * SPOKES];
    for (int round = 0; round < 60; round++) {
        int width = rnd_int(1, 120), height = rnd_int(1, 90), m = rnd_int(1, SPOKES / 4), n = 4 * m;
        double reach = round % 3 == 2 ? 50 : 2.9, cx = (double)rnd_float(-1, 1);
        double cy = (double)rnd_float(-1, 1);
        if (round % 4 == 1) cx = 2 * (rnd_int(0, width - 1) + 0.5) / width - 1; /* a centre */
        if (round % 4 == 1) cy = 1 - 2 * (rnd_int(0, height - 1) + 0.5) / height;
        clip[n] = shade_v4((float)cx, (float)cy, 0, 1);
        for (int k = 0; k < n; k++) { /* around a square that holds the picture */
            double side = -1 + 2 * (k % m + (k % m ? 0.7 * rnd_unit() : 0)) / m, x, y;
            double w = round % 2 ? (double)rnd_log(0.3, 3) : 1;
            int edge = k / m;
            x = edge == 0 ? side : edge == 1 ? 1 : edge == 2 ? -side : -1;
            y = edge == 0 ? -1 : edge == 1 ? side : edge == 2 ? 1 : -side;
            clip[k] = shade_v4((float)(x * reach * w), (float)(y * reach * w), 0, (float)w);
            indices[3 * k] = (uint32_t)k;
            indices[3 * k + 1] = (uint32_t)((k + 1) % n);
            indices[3 * k + 2] = (uint32_t)n;
        }
        canvas c = canvas_open(width, height, 0, SHADE_FORMAT_RGBA32F, 0);
        count_coverage(&c, clip, indices, 3 * n, n + 1);
        check_covered(&c, 1); /* the polygon through the spokes' ends holds the whole picture */
        canvas_close(&c);
    }
}
