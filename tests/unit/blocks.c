/* blocks.c - leaving out hidden blocks of a draw changes no bit of its picture. */
#include "unit.h"

enum { BLOCKS_MOST = 60 };

/* Corners of count triangles, most of them big, at depths that slope or are level. */
static void random_walls(shade_vec4 *clip, int count, int width, int height)
{
    static const int kinds[] = { 2, 2, 2, 6, 6, 3, 5, 1 };
    for (int i = 0; i < count; i++) {
        int64_t x[3], y[3];
        double level = 2 * rnd_unit() - 1, slope = rnd_one_in(3) ? 0 : rnd_unit();
        random_corners(kinds[rnd_int(0, 7)], width, height, x, y);
        if (i % 12 == 3) {    /* all of the picture, to its corners */
            x[0] = x[1] = -width * 200;
            x[2] = width * 500;
            y[0] = -height * 250;
            y[1] = height * 510;
            y[2] = height * 128;
        }
        for (int k = 0; k < 3; k++) {
            double z = level + slope * (2 * rnd_unit() - 1);
            z = z < -1 ? -1 : z > 1 ? 1 : z;
            clip[3 * i + k] = clip_of_fx8((double)x[k], (double)y[k], width, height, z,
                                          (double)rnd_log(0.5, 2));
        }
    }
}

static void copy_clip_rectangle(shade_target *to, const shade_target *from)
{
    to->clip_x = from->clip_x;
    to->clip_y = from->clip_y;
    to->clip_width = from->clip_width;
    to->clip_height = from->clip_height;
}

/* Every comparison; now and then depth that is read alone, and biases up to those that move every
   depth to 0. */
static void random_depth_state(shade_raster *r, int round)
{
    r->depth_test = (shade_compare)(round % 6);
    r->depth_read_only = rnd_one_in(8);
    r->depth_bias = rnd_one_in(4) ? rnd_float(-0.1, 0.1) : rnd_one_in(20) ? -FLT_MAX : 0;
}

/* Draws each triangle of a scene by a call of its own; returns how many fragments that makes. */
static long long draw_in_turns(canvas *c, shade_pipeline p, const scene *s, int count)
{
    long long fragments = 0;
    for (int i = 0; i < count; i++) {
        scene part = { s->clip + 3 * i, NULL, 0, s->color + i, NULL };
        shade_stats one;
        p.uniforms = &part;
        one = canvas_draw(c, &p, 3);
        fragments += one.fragments;
    }
    return fragments;
}

/* A draw that may discard tests depth at the end, pixel by pixel; one triangle hides none. */
TEST(blocks, a_draw_is_its_triangles_in_turn_and_its_late_depth_test)
{
    shade_vec4 clip[3 * BLOCKS_MOST], color[BLOCKS_MOST];
    for (int i = 0; i < BLOCKS_MOST; i++)
        color[i] = shade_v4(rnd_float(0, 1), rnd_float(0, 1), rnd_float(0, 1), rnd_float(0, 1));
    for (int round = 0; round < test_rounds(240); round++) {
        int big = round % 20 == 19, count = big ? 20 : BLOCKS_MOST, strip = rnd_one_in(3);
        int width = big ? rnd_int(1000, 1500) : rnd_int(20, 200);
        int height = big ? rnd_int(600, 1100) : rnd_int(8, 120);
        int first = strip ? rnd_int(0, height - 1) : 0;
        int rows = strip ? rnd_int(1, height - first) : 0;
        canvas whole = canvas_strip(width, height, 0, SHADE_FORMAT_RGBA8, 1, first, rows);
        canvas turns = canvas_strip(width, height, 0, SHADE_FORMAT_RGBA8, 1, first, rows);
        canvas late = canvas_strip(width, height, 0, SHADE_FORMAT_RGBA8, 1, first, rows);
        scene s = { clip, NULL, 0, color, NULL };
        shade_pipeline p = scene_pipeline(&s);
        shade_stats a, b;
        float clear = rnd_one_in(2) ? rnd_float(0, 1) : round % 6 / 2 == 1 ? 0.0f : 1.0f;
        p.fragment = scene_flat;
        random_depth_state(&p.raster, round);
        canvas_clear(&whole, clear);
        canvas_clear(&turns, clear);
        canvas_clear(&late, clear);
        if (rnd_one_in(2)) random_clip(&whole.target);
        copy_clip_rectangle(&turns.target, &whole.target);
        copy_clip_rectangle(&late.target, &whole.target);
        random_walls(clip, count, width, height);
        a = canvas_draw(&whole, &p, 3 * count);
        long long fragments = draw_in_turns(&turns, p, &s, count);
        p.may_discard = 1;
        b = canvas_draw(&late, &p, 3 * count);
        CHECK(canvas_same(&whole, &turns));
        CHECK(canvas_same(&whole, &late));
        CHECK_INT(a.fragments, fragments);
        CHECK_INT(a.fragments, b.fragments);
        CHECK_INT(a.drawn, b.drawn);
        canvas_close(&whole);
        canvas_close(&turns);
        canvas_close(&late);
    }
}

/* Forgets all depths drawn so far, once, when a pixel of triangle 1 is shaded. */
typedef struct forgetful {
    scene s;    /* first, for scene_vertex */
    const shade_target *target;
    float cleared;
    int *done;
} forgetful;
static void forgetful_fragment(const void *uniforms, const shade_fragments *SHADE_RESTRICT in,
                               shade_colors *SHADE_RESTRICT out)
{
    const forgetful *f = (const forgetful *)uniforms;
    const shade_target *t = f->target;
    (void)out;
    if (*f->done || in->primitive[in->count - 1] != 1) return;
    for (int i = 0; i < t->width * t->height; i++) t->depth[i] = f->cleared;
    *f->done = 1;
}

enum { FILLED_SIDE = SHADE_LANES / 4, FILLED_TALL = FILLED_SIDE / 2, FILLED_EDGE = 48 };
enum { FILLED_WIDTH = 32 * FILLED_SIDE + 1 + FILLED_EDGE };
enum { FILLED_HEIGHT = 8 * FILLED_TALL + FILLED_EDGE };

/* Three triangles beyond the picture: the first at depth 0.5, up to a cut on one side; the second,
   nearer, up to the same cut; the third, farther than both, over everything. */
static void filled_walls(shade_vec4 clip[9], int by_columns, int reversed, double cut_x,
                         double cut_y)
{
    static const int corner[3][2] = { { 0, 0 }, { 2, 0 }, { 1, 1 } };
    const double far_x = FILLED_WIDTH * 256.0, far_y = FILLED_HEIGHT * 256.0;
    for (int k = 0; k < 9; k++) {
        double along = corner[k % 3][0], X, Y, z = k < 3 ? 0.5 : k < 6 ? 0.25 : 0.75;
        if (k >= 6) {
            cut_x = 1.99 * far_x;
            cut_y = 1.99 * far_y;
        }
        X = by_columns ? (corner[k % 3][1] ? -0.99 * far_x : cut_x) : (1.5 * along - 1) * far_x;
        Y = by_columns ? (1.5 * along - 1) * far_y : corner[k % 3][1] ? -0.99 * far_y : cut_y;
        z = reversed ? 1 - z : z;
        clip[k] = clip_of_fx8(floor(X), floor(Y), FILLED_WIDTH, FILLED_HEIGHT, 2 * z - 1, 1);
    }
}

/* Two triangles fill the clip rectangle, or up to a line between blocks, level; then all depths are
   cleared behind the draw's back.  A third, farther one draws the rest alone: filled blocks are not
   looked at again.  They are 32 x 8 pixels from the corner of the rectangle on, and 32 x 16 where
   that would be one column too many.  A wall that is not cut reaches past the last block, and all
   are more than a tile wide, as smaller triangles do not look at bounds. */
TEST(blocks, filled_blocks_are_left_out)
{
    enum { EDGE = FILLED_EDGE };
    canvas c = canvas_open(FILLED_WIDTH, FILLED_HEIGHT, 0, SHADE_FORMAT_RGBA8, 1);
    for (int i = 0; i < 96; i++) {
        const int most = i % 4 / 2, more = FILLED_SIDE > 2 && i % 4 == 3;
        const int by_columns = i / 4 % 2, reversed = i / 8 % 2;
        /* every other rectangle is the largest that is left out, every eighth one block */
        const int widest = 32 * FILLED_SIDE, tallest = 8 * FILLED_TALL;
        const int w = most ? widest + more : i % 8 == 1 ? 32 : rnd_int(33, widest);
        const int h = most ? tallest : i % 8 == 1 ? 8 : rnd_int(8, tallest);
        const int x = rnd_int(0, EDGE - 1), y = rnd_int(0, EDGE - 1), size = more ? 16 : 8;
        int columns = w, rows = h, done = 0;
        shade_vec4 clip[9];
        shade_stats stats;
        forgetful f = { { clip, NULL, 0, NULL, NULL }, &c.target, reversed ? 0.0f : 1.0f, &done };
        shade_pipeline p = scene_pipeline(&f.s);
        if (by_columns && w >= 96) columns = 32 * rnd_int(2, w / 32);
        if (!by_columns && h >= 2 * size) rows = size * rnd_int(1, h / size);
        filled_walls(clip, by_columns, reversed, (x + columns + 64 * (columns == w)) * 256.0,
                     (y + rows) * 256.0);
        p.fragment = forgetful_fragment;
        p.raster.depth_test = (shade_compare)(i / 16 % 2 + 2 * reversed);
        c.target.clip_x = x;
        c.target.clip_y = y;
        c.target.clip_width = w;
        c.target.clip_height = h;
        canvas_clear(&c, f.cleared);
        stats = canvas_draw(&c, &p, 9);
        CHECK(done);
        CHECK_INT(stats.fragments, 2 * columns * rows + w * h - columns * rows);
    }
    canvas_close(&c);
}

/* Walls before and behind each other, filling whole blocks: each pixel holds the nearest. */
TEST(blocks, level_walls_keep_the_nearest)
{
    enum { WALLS = 40, WIDTH = 300, HEIGHT = 90 };
    shade_vec4 clip[6 * WALLS], color[2 * WALLS];
    for (int round = 0; round < 24; round++) {
        int left[WALLS], right[WALLS], top[WALLS], bottom[WALLS], reversed = round % 2;
        float depth[WALLS];
        canvas c = canvas_open(WIDTH, HEIGHT, 0, SHADE_FORMAT_RGBA8, 1);
        scene s = { clip, NULL, 0, color, NULL };
        shade_pipeline p = scene_pipeline(&s);
        for (int i = 0; i < WALLS; i++) {
            static const int corner[6][2] = { { 0, 0 }, { 0, 1 }, { 1, 1 },
                                              { 0, 0 }, { 1, 1 }, { 1, 0 } };
            left[i] = rnd_int(0, WIDTH - 40);
            right[i] = rnd_int(left[i] + 1, WIDTH);
            top[i] = rnd_int(0, HEIGHT - 20);
            bottom[i] = rnd_int(top[i] + 1, HEIGHT);
            depth[i] = (float)rnd_int(1, 255) / 256;
            color[2 * i] = color[2 * i + 1] = shade_v4((float)(i + 1) / 255, 0, 0, 1);
            for (int k = 0; k < 6; k++)
                clip[6 * i + k] = clip_of_fx8((corner[k][0] ? right[i] : left[i]) * 256.0,
                                              (corner[k][1] ? bottom[i] : top[i]) * 256.0, WIDTH,
                                              HEIGHT, 2 * (double)depth[i] - 1, 1);
        }
        p.fragment = scene_flat;
        p.raster.depth_test = (shade_compare)(round % 4 / 2 + 2 * reversed);
        canvas_clear(&c, reversed ? 0.0f : 1.0f);
        canvas_draw(&c, &p, 6 * WALLS);
        for (int y = 0; y < HEIGHT; y++)
            for (int x = 0; x < WIDTH; x++) {
                int nearest = -1, or_equal = p.raster.depth_test % 2;
                for (int i = 0; i < WALLS; i++) {
                    if (x < left[i] || x >= right[i] || y < top[i] || y >= bottom[i]) continue;
                    float gain = nearest < 0 ? 1.0f : depth[nearest] - depth[i];
                    if (nearest >= 0 && reversed) gain = -gain;
                    if (gain > 0 || (gain == 0 && or_equal)) nearest = i;
                }
                CHECK_INT(canvas_bytes(&c, x, y)[0], nearest + 1);
            }
        canvas_close(&c);
    }
}
