/* exact.c - coverage without samples: every triangle on a lattice, and shared edges whose corners
   are lattice points or lie thousands of pixels apart. */
#include "unit.h"

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
TEST(exact, every_triangle_on_a_quarter_pixel_lattice)
{
    exact_lattice l = { 13, 0, 64 };    /* 3 pixels, both ends */
    CHECK_INT(exact_all(l), 2L * 2 * (169L * 168 * 167 / 6));
}

/* G7 */
TEST(exact, every_triangle_of_256ths_around_a_centre)
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
TEST(exact, lattice_meshes_cover_every_pixel_once)
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
TEST(exact, strips_across_the_biggest_pictures_cover_every_pixel_once)
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
TEST(exact, fans_of_slivers_cover_every_pixel_once)
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
