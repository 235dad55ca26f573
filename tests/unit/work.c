/* work.c - the time of a triangle is bounded by the rows of its box and by the tiles that it
   crosses, counted one by one (see SHADE__TILE_TESTED); not by its box, and not by a clock. */
#include "unit.h"
#include "count.h"

long tiles_tested;

enum { WORK_ROWS = 8 };    /* tiles are 32 pixels wide and at least so high */

/* Modes that test depth on the way, late, against what stays, and not at all. */
enum { WORK_LESS, WORK_ALWAYS, WORK_READ_ONLY, WORK_DISCARD, WORK_NO_DEPTH, WORK_MODES };

/* Tiles that a draw of one triangle looks at; corners are in 24.8. */
static long work_tiles(canvas *c, int mode, const int64_t x[3], const int64_t y[3])
{
    const shade_target *t = &c->target;
    shade_vec4 clip[3];
    shade_target target = c->target;
    shade_stats stats;
    for (int k = 0; k < 3; k++)
        clip[k] = clip_of_fx8((double)x[k], (double)y[k], t->width, t->height, 0.25 * k, 1);
    scene s = { clip, NULL, 0, NULL, NULL };
    shade_pipeline p = scene_pipeline(&s);
    if (mode == WORK_ALWAYS) p.raster.depth_test = SHADE_COMPARE_ALWAYS;
    p.raster.depth_read_only = mode == WORK_READ_ONLY;
    p.may_discard = mode == WORK_DISCARD;
    if (mode == WORK_NO_DEPTH) target.depth = NULL;
    tiles_tested = 0;
    CHECK_INT(shade_draw(&target, &p, NULL, 3, 3, &stats), SHADE_OK);
    CHECK_INT(stats.triangles, 1);
    return tiles_tested;
}

/* How many columns of the picture a triangle has in rows top to bottom, by its sides in doubles. */
static double work_columns(const int64_t x[3], const int64_t y[3], double top, double bottom,
                           double width)
{
    double left = width, right = 0;
    for (int k = 0; k < 3; k++) {
        const double px = (double)x[k] / 256, py = (double)y[k] / 256;
        const double qx = (double)x[(k + 1) % 3] / 256, qy = (double)y[(k + 1) % 3] / 256;
        for (int end = 0; end < 2; end++) {
            const double row = fmin(fmax(end ? bottom : top, fmin(py, qy)), fmax(py, qy));
            const double at = py == qy ? px : px + (qx - px) * (row - py) / (qy - py);
            if (fmax(py, qy) < top || fmin(py, qy) > bottom) continue;
            left = fmin(left, fmin(at, py == qy ? qx : at));
            right = fmax(right, fmax(at, py == qy ? qx : at));
        }
    }
    return fmax(fmin(right, width) - fmax(left, 0), 0);
}

/* The tiles that a triangle may take: in each row of tiles those of its columns there, and some
   more.  A row of tiles begins where the box does, so that it may reach as far up or down. */
static double work_bound(const canvas *c, const int64_t x[3], const int64_t y[3], double more)
{
    double tiles = 0;
    const int height = c->target.height;
    const int64_t low = y[0] < y[1] ? y[0] : y[1], high = y[0] > y[1] ? y[0] : y[1];
    for (int top = 0; top < height; top += WORK_ROWS) {
        if ((top + WORK_ROWS) * 256 < (low < y[2] ? low : y[2])) continue;
        if (top * 256 > (high > y[2] ? high : y[2])) continue;
        tiles += more + work_columns(x, y, top - WORK_ROWS, top + 2 * WORK_ROWS,
                                     c->target.width) / 32;
    }
    return tiles;
}

/* A line a pixel wide from corner to corner: through each row of tiles, and each column, once. */
/* G4 */
TEST(work, diagonals_take_the_tiles_that_they_cross)
{
    static const int widths[] = { 64, 100, 512, 2048 };
    enum { HEIGHT = 2048 };
    for (int i = 0; i < 4; i++) {
        const int width = widths[i];
        canvas c = canvas_ready(width, HEIGHT, 0, SHADE_FORMAT_RGB565, 1);
        for (int mode = 0; mode < WORK_MODES; mode++) {
            for (int turned = 0; turned < 4; turned++) {
                int64_t x[3] = { 0, width * 256, width * 256 - 200 };
                int64_t y[3] = { 0, HEIGHT * 256, HEIGHT * 256 };
                long tiles;
                for (int k = 0; k < 3; k++) {
                    if (turned & 1) x[k] = width * 256 - x[k];
                    if (turned & 2) y[k] = HEIGHT * 256 - y[k];
                }
                tiles = work_tiles(&c, mode, x, y);
                CHECK_SAY(tiles <= HEIGHT / WORK_ROWS + 2 * width / 32,
                          "%ld tiles of %d x %d, mode %d, turned %d", tiles, width, HEIGHT, mode,
                          turned);
                CHECK_SAY(tiles >= HEIGHT / 32, "only %ld tiles", tiles);
            }
        }
        canvas_close(&c);
    }
}

/* Of every form, from slivers to the whole picture. */
/* G4 */
TEST(work, triangles_take_their_rows_and_the_tiles_that_they_cross)
{
    canvas c = canvas_ready(1200, 700, 0, SHADE_FORMAT_RGB565, 1);
    double most = 0;
    for (int i = 0; i < 700; i++) {
        int64_t x[3], y[3];
        double bound, tiles;
        random_corners(i % 7, 1200, 700, x, y);
        bound = work_bound(&c, x, y, 3);
        tiles = (double)work_tiles(&c, i % WORK_MODES, x, y);
        most = tiles / (bound + 1) > most ? tiles / (bound + 1) : most;
        CHECK_SAY(tiles <= bound,
                  "%g tiles, not %g: kind %d, mode %d, corners %lld %lld  %lld %lld  %lld %lld",
                  tiles, bound, i % 7, i % WORK_MODES, (long long)x[0], (long long)y[0],
                  (long long)x[1], (long long)y[1], (long long)x[2], (long long)y[2]);
    }
    CHECK_SAY(most > 0.3, "never more than %g of the bound", most);
    canvas_close(&c);
}

/* Triangles behind one that fills the picture cost no tile, with depth either way round. */
TEST(work, what_lies_behind_a_big_triangle_takes_no_tiles)
{
    enum { BEHIND = 40 };
    canvas c = canvas_open(1024, 640, 0, SHADE_FORMAT_RGB565, 1);
    for (int reversed = 0; reversed < 2; reversed++) {
        shade_vec4 clip[3 * (BEHIND + 1)] = { { -1, -1, 0, 1 }, { 3, -1, 0, 1 }, { -1, 3, 0, 1 } };
        scene s = { clip, NULL, 0, NULL, NULL };
        shade_pipeline p = scene_pipeline(&s);
        const int corners[2] = { 3, 3 * (BEHIND + 1) };
        long tiles[2];
        for (int k = 3; k < 3 * (BEHIND + 1); k++) {
            const float z = rnd_float(0.01, 0.9);
            const float x = rnd_float(-1, -0.3) + 0.65f * (float)(k % 3);
            clip[k] = shade_v4(x, k % 3 == 1 ? rnd_float(-1, -0.3) : rnd_float(0.3, 1),
                               reversed ? -z : z, 1);
        }
        if (reversed) p.raster.depth_test = SHADE_COMPARE_GREATER;
        for (int k = 0; k < 2; k++) {
            canvas_clear(&c, !reversed);
            tiles_tested = 0;
            CHECK_INT(shade_draw(&c.target, &p, NULL, corners[k], corners[k], NULL), SHADE_OK);
            tiles[k] = tiles_tested;
        }
        CHECK(tiles[0] >= 1024 / 32 * (640 / 8));
        CHECK_SAY(tiles[1] == tiles[0], "%ld tiles of %d triangles behind", tiles[1] - tiles[0],
                  BEHIND);
    }
    canvas_close(&c);
}
