/* lines.c - lines as rectangles of the screen: coverage, ends, clipping, depth, arguments. */
#include "unit.h"

typedef struct line_places { /* the rectangle of one line, window pixels, y down */
    double x[4], y[4];       /* in order around it */
} line_places;

static line_places ref_rectangle(double ax, double ay, double bx, double by, double width,
                                 shade_cap cap)
{
    line_places r;
    double dx = bx - ax, dy = by - ay, length = hypot(dx, dy), h = width / 2;
    dx = length > 0 ? dx / length : 1;
    dy = length > 0 ? dy / length : 0;
    if (cap == SHADE_CAP_SQUARE) {
        ax -= dx * h;
        ay -= dy * h;
        bx += dx * h;
        by += dy * h;
    }
    r.x[0] = ax + dy * h;
    r.y[0] = ay - dx * h;
    r.x[1] = bx + dy * h;
    r.y[1] = by - dx * h;
    r.x[2] = bx - dy * h;
    r.y[2] = by + dx * h;
    r.x[3] = ax - dy * h;
    r.y[3] = ay + dx * h;
    return r;
}

/* 1 inside by the margin, 0 outside, -1 between */
static int ref_in_rectangle(const line_places *r, double X, double Y, double margin)
{
    double least = 1e300, area = 0;
    for (int k = 0; k < 4; k++) {
        int n = (k + 1) % 4;
        area += r->x[k] * r->y[n] - r->x[n] * r->y[k];
    }
    for (int k = 0; k < 4; k++) {
        double ex = r->x[(k + 1) % 4] - r->x[k], ey = r->y[(k + 1) % 4] - r->y[k];
        double e = (ex * (Y - r->y[k]) - ey * (X - r->x[k])) * (area > 0 ? 1 : -1);
        double length = hypot(ex, ey);
        if (length > 0) least = fmin(least, e / length);
    }
    return area == 0 ? 0 : least > margin ? 1 : least < -margin ? 0 : -1;
}

/* the point of clip space over a window point */
static shade_vec3 line_point(double X, double Y, double z, int width, int height)
{
    return shade_v3((float)(2 * X / width - 1), (float)(1 - 2 * Y / height), (float)z);
}

static shade_line_state line_state(float width)
{
    shade_line_state s = { .width = width, .color = shade_v4(1, 1, 1, 1) };
    return s;
}

static shade_stats draw_lines(canvas *c, const shade_vec3 *points, int count,
                              const shade_line_state *state)
{
    shade_stats s;
    memset(&s, CANVAS_BYTE, sizeof s);
    CHECK_INT(shade_draw_lines(&c->target, points, count, state, &s), SHADE_OK);
    CHECK_INT(s.triangles, count);
    CHECK_INT(s.culled + s.clipped + s.rejected + s.drawn, s.triangles);
    return s;
}

static int line_pixel(const canvas *c, int x, int y) { return canvas_bytes(c, x, y)[0] != 0; }

/* ------------------------------------------------------------------------------------ coverage */

enum { COVER_W = 60, COVER_H = 44 };

/* A line in 1/256 pixel along a Pythagorean way; its half width is 5 half. */
typedef struct exact_line {
    int64_t ax, ay, bx, by;
    int way[2], half;
} exact_line;

/* Now and then its ends lie on the corners and centres of pixels, and its sides too.  Both are near
   enough to the picture for the line not to be cut, which would take its corners off the grid. */
static exact_line random_exact_line(void)
{
    static const int ways[12][2] = { { 5, 0 },  { 0, 5 },  { -5, 0 },  { 0, -5 },
                                     { 3, 4 },  { 4, 3 },  { -3, 4 },  { 4, -3 },
                                     { 3, -4 }, { -4, 3 }, { -3, -4 }, { -4, -3 } };
    exact_line l;
    memcpy(l.way, ways[rnd_int(0, 11)], sizeof l.way);
    l.half = rnd_one_in(3) ? 128 * rnd_int(1, 8) : rnd_int(1, 900);
    l.ax = rnd_int(0, COVER_W * 256);
    l.ay = rnd_int(0, COVER_H * 256);
    int64_t n = rnd_int(1, rnd_one_in(2) ? 100 : 1500);
    if (rnd_one_in(2)) {
        l.ax = l.ax / 128 * 128;
        l.ay = l.ay / 128 * 128;
        n = n / 128 * 128 + 128;
    }
    const int64_t reach = 3 * 5 * l.half + 2 * 256;
    do {
        l.bx = l.ax + n * l.way[0];
        l.by = l.ay + n * l.way[1];
        n = (n + 1) / 2;
    } while (l.bx < -reach || l.bx > COVER_W * 256 + reach || l.by < -reach ||
             l.by > COVER_H * 256 + reach);
    return l;
}

/* The corners of its rectangle in order, the first once more at the end. */
static void exact_rectangle(const exact_line *l, shade_cap cap, int64_t x[5], int64_t y[5])
{
    const int64_t reach = cap == SHADE_CAP_SQUARE ? l->half : 0;
    const int64_t along_x = l->way[0] * reach, along_y = l->way[1] * reach;
    const int64_t ox = (int64_t)l->way[1] * l->half, oy = -(int64_t)l->way[0] * l->half;
    for (int k = 0; k < 5; k++) {
        const int at_b = k == 1 || k == 2, side = k == 2 || k == 3 ? -1 : 1;
        x[k] = (at_b ? l->bx + along_x : l->ax - along_x) + side * ox;
        y[k] = (at_b ? l->by + along_y : l->ay - along_y) + side * oy;
    }
}

/* Along the axes and along 3-4-5 slopes the corners of a rectangle lie on the grid of 1/256 pixel
   that vertices snap to, and its pixels are known without any margin. */
TEST(lines, coverage_is_the_pixels_of_the_rectangle_exactly)
{
    for (int i = 0; i < 1500; i++) {
        canvas c = canvas_ready(COVER_W, COVER_H, 0, SHADE_FORMAT_RGBA8, 0);
        exact_line l = random_exact_line();
        shade_line_state s = line_state((float)(l.half * 10 / 256.0));
        s.cap = (shade_cap)rnd_int(0, 1);
        shade_vec3 p[2];
        p[0] = line_point((double)l.ax / 256, (double)l.ay / 256, 0, COVER_W, COVER_H);
        p[1] = line_point((double)l.bx / 256, (double)l.by / 256, 0, COVER_W, COVER_H);
        shade_stats stats = draw_lines(&c, p, 2, &s);

        int64_t x[5], y[5];
        long long fragments = 0;
        exact_rectangle(&l, s.cap, x, y);
        for (int k = 0; k < COVER_W * COVER_H; k++) {
            int in = ref_inside_fx8(x, y, k % COVER_W, k / COVER_W);
            in |= ref_inside_fx8(x + 2, y + 2, k % COVER_W, k / COVER_W);
            fragments += in;
            CHECK_SAY(line_pixel(&c, k % COVER_W, k / COVER_W) == in,
                      "pixel %d %d: want %d; way %d %d, half %d", k % COVER_W, k / COVER_W, in,
                      l.way[0], l.way[1], l.half);
        }
        CHECK_INT(stats.fragments, fragments);
        CHECK_INT(stats.drawn + stats.clipped, 2);
        canvas_close(&c);
    }
}

TEST(lines, coverage_is_the_rectangle_in_any_direction)
{
    for (int i = 0; i < 1500; i++) {
        int width = rnd_int(1, 70), height = rnd_int(1, 50);
        canvas c = canvas_ready(width, height, width + rnd_int(0, 3), SHADE_FORMAT_RGBA8, 0);
        double reach = rnd_one_in(4) ? 20 : 1, x[2], y[2];
        for (int k = 0; k < 2; k++) {
            x[k] = (rnd_unit() - 0.5) * reach * width + 0.5 * width;
            y[k] = (rnd_unit() - 0.5) * reach * height + 0.5 * height;
        }
        shade_line_state s = line_state(rnd_one_in(5) ? 0 : rnd_log(0.05, 200));
        s.cap = (shade_cap)rnd_int(0, 1);
        shade_vec3 p[2];
        for (int k = 0; k < 2; k++) p[k] = line_point(x[k], y[k], 0, width, height);
        draw_lines(&c, p, 2, &s);
        /* corners snap to 1/256 pixel; a cut outside the guard band moves an edge by as much */
        line_places r = ref_rectangle(x[0], y[0], x[1], y[1], s.width > 0 ? (double)s.width : 1,
                                      s.cap);
        for (int k = 0; k < width * height; k++) {
            int in = ref_in_rectangle(&r, k % width + 0.5, k / width + 0.5, 0.01);
            CHECK_SAY(in < 0 || line_pixel(&c, k % width, k / width) == in,
                      "pixel %d %d of %d x %d: want %d; %g %g to %g %g width %g cap %d", k % width,
                      k / width, width, height, in, x[0], y[0], x[1], y[1], (double)s.width,
                      (int)s.cap);
        }
        canvas_close(&c);
    }
}

/* A width of 0 is what a zeroed state has. */
TEST(lines, no_width_is_one_pixel)
{
    canvas c[2];
    canvas_twins(c, 40, 30, SHADE_FORMAT_RGBA8, 1);
    shade_vec3 p[40];
    for (int k = 0; k < 40; k++) p[k] = shade_v3(rnd_float(-1, 1), rnd_float(-1, 1), 0);
    shade_line_state zero = line_state(0), one = line_state(1);
    draw_lines(&c[0], p, 40, &zero);
    draw_lines(&c[1], p, 40, &one);
    canvas_twins_close(c);
}

/* A width far beyond the picture covers all of it, whatever w is, also where width times w is
   beyond the floats. */
TEST(lines, any_finite_width_covers_what_it_reaches)
{
    static const float widths[4] = { 1e6f, 1e20f, 3e37f, FLT_MAX };
    static const float scales[3] = { 1, 10, 1e20f };
    const shade_vec3 points[2] = { shade_v3(-0.5f, -0.25f, 0), shade_v3(0.5f, 0.25f, 0) };
    for (int k = 0; k < 12; k++) {
        uint32_t color = 0;
        shade_target t = { .width = 1, .height = 1, .color = &color };
        shade_line_state s = line_state(widths[k / 3]);
        shade_stats stats;
        s.clip_from_points = shade_mat4_identity();
        for (int i = 0; i < 4; i++)
            s.clip_from_points.col[i] = shade_scale4(s.clip_from_points.col[i], scales[k % 3]);
        s.cap = SHADE_CAP_SQUARE;
        CHECK_INT(shade_draw_lines(&t, points, 2, &s, &stats), SHADE_OK);
        CHECK_INT(stats.rejected, 0);
        CHECK(color != 0);
    }
}

TEST(lines, square_ends_close_the_joints_of_a_path)
{
    canvas c = canvas_open(20, 20, 0, SHADE_FORMAT_RGBA8, 0);
    shade_line_state s = line_state(4);
    shade_vec3 p[4];
    p[0] = p[3] = line_point(6, 6, 0, 20, 20);
    p[1] = line_point(16, 6, 0, 20, 20);
    p[2] = line_point(6, 16, 0, 20, 20);
    for (int square = 0; square < 2; square++) {
        s.cap = (shade_cap)square;
        canvas_clear(&c, 1);
        draw_lines(&c, p, 4, &s);
        CHECK_INT(line_pixel(&c, 4, 4), square); /* the outer corner */
        CHECK_INT(line_pixel(&c, 5, 5), square);
        CHECK_INT(line_pixel(&c, 6, 6), 1);
        CHECK_INT(line_pixel(&c, 17, 6), square);
        CHECK_INT(line_pixel(&c, 18, 6), 0);
    }
    canvas_close(&c);
}

TEST(lines, a_line_without_length_is_nothing_or_a_square)
{
    for (int i = 0; i < 200; i++) {
        canvas c = canvas_ready(32, 32, 0, SHADE_FORMAT_RGBA8, 0);
        int x = rnd_int(8, 24), y = rnd_int(8, 24), half = rnd_int(1, 6), count = 0;
        shade_line_state s = line_state((float)(2 * half));
        shade_vec3 p[2];
        p[0] = p[1] = line_point(x, y, 0, 32, 32);
        s.cap = (shade_cap)(i & 1);
        shade_stats stats = draw_lines(&c, p, 2, &s);
        for (int k = 0; k < 32 * 32; k++) {
            int in = i & 1 && k % 32 >= x - half && k % 32 < x + half && k / 32 >= y - half &&
                     k / 32 < y + half;
            CHECK_INT(line_pixel(&c, k % 32, k / 32), in);
            count += in;
        }
        CHECK_INT(stats.fragments, count);
        CHECK_INT(stats.culled, i & 1 ? 0 : 2);
        canvas_close(&c);
    }
}

/* ------------------------------------------------------------------------------------ clipping */

/* The parameters between which the segment lies inside the near and far planes, linear in clip
   space. Returns 0 where nothing is left. */
static int ref_line_cut(double e[2][4], int zero_to_one, double t[2])
{
    t[0] = 0;
    t[1] = 1;
    for (int plane = 0; plane < 2; plane++) {
        double d[2];
        for (int k = 0; k < 2; k++) {
            d[k] = plane ? e[k][3] - e[k][2] : zero_to_one ? e[k][2] : e[k][2] + e[k][3];
        }
        if (d[0] < 0 && d[1] < 0) return 0;
        double at = d[0] / (d[0] - d[1]);
        if (d[0] < 0) t[0] = fmax(t[0], at);
        if (d[1] < 0) t[1] = fmin(t[1], at);
    }
    return t[0] <= t[1];
}

/* Ends on both sides of the near plane, some of them behind the eye; e: their places in clip space,
   in double. */
static void random_cut_segment(const shade_line_state *s, shade_vec3 p[2], double e[2][4])
{
    for (int k = 0; k < 2; k++) {
        double z = rnd_one_in(3) ? rnd_unit() * 3 - 2 : -0.5 - 9 * rnd_unit();
        p[k] = shade_v3(rnd_float(-1, 1) * (float)fabs(z), rnd_float(-1, 1) * (float)fabs(z),
                        (float)z);
        double in[4] = { (double)p[k].x, (double)p[k].y, (double)p[k].z, 1 };
        dmat_apply(dmat_from(s->clip_from_points), in, e[k]);
    }
}

/* What is on the screen t of the way from one end to the other; returns w. */
static double segment_place(double e[2][4], double t, int width, int height, double *x, double *y)
{
    double v[4];
    for (int n = 0; n < 4; n++) v[n] = e[0][n] + t * (e[1][n] - e[0][n]);
    *x = (v[0] / v[3] + 1) * width / 2;
    *y = (1 - v[1] / v[3]) * height / 2;
    return v[3];
}

TEST(lines, near_and_far_cut_the_segment_before_it_gets_its_width)
{
    enum { W = 64, H = 48 };
    long cut = 0;
    for (int i = 0; i < 1500; i++) {
        canvas c = canvas_ready(W, H, 0, SHADE_FORMAT_RGBA8, 0);
        shade_line_state s = line_state(rnd_log(0.5, 10));
        double e[2][4], t[2], x[2], y[2], w[2];
        shade_vec3 p[2];
        s.cap = (shade_cap)rnd_int(0, 1);
        s.raster.depth_zero_to_one = rnd_one_in(2);
        s.clip_from_points = s.raster.depth_zero_to_one
                                 ? shade_mat4_perspective_reversed(1, (float)W / H, 0.5f)
                                 : shade_mat4_perspective(1, (float)W / H, 0.5f, 8);
        random_cut_segment(&s, p, e);
        shade_stats stats = draw_lines(&c, p, 2, &s);
        int left = ref_line_cut(e, s.raster.depth_zero_to_one, t);
        if (!left) {
            CHECK_INT(stats.clipped, 2);
            CHECK_INT(stats.fragments, 0);
            canvas_close(&c);
            continue;
        }
        for (int k = 0; k < 2; k++) w[k] = segment_place(e, t[k], W, H, &x[k], &y[k]);
        cut += t[0] > 0 || t[1] < 1;
        /* positions of some thousand pixels carry float roundings of their own */
        double far = fmax(fmax(fabs(x[0]), fabs(x[1])), fmax(fabs(y[0]), fabs(y[1])));
        line_places r = ref_rectangle(x[0], y[0], x[1], y[1], (double)s.width, s.cap);
        for (int k = 0; k < W * H && w[0] > 0.3 && w[1] > 0.3; k++) {
            int in = ref_in_rectangle(&r, k % W + 0.5, k / W + 0.5, 0.015 + far * 2e-6);
            CHECK_SAY(in < 0 || line_pixel(&c, k % W, k / W) == in,
                      "pixel %d %d: want %d; %g %g to %g %g width %g cap %d, t %g %g", k % W, k / W,
                      in, x[0], y[0], x[1], y[1], (double)s.width, (int)s.cap, t[0], t[1]);
        }
        canvas_close(&c);
    }
    CHECK_SAY(cut > 200, "%ld", cut);
}

/* A bad line stands between two good ones.  It may be as wide and its matrix as wild as floats
   are: nothing is written outside the picture, and the good lines are whole after it. */
TEST(lines, points_that_are_no_numbers_are_rejected_and_the_rest_drawn)
{
    for (int i = 0; i < 500; i++) {
        canvas c = canvas_ready(32, 24, 0, SHADE_FORMAT_RGBA8, 1);
        shade_line_state s = line_state(rnd_one_in(3) ? rnd_log(1e-30, 3e38) : 2);
        shade_vec3 p[6];
        s.cap = (shade_cap)rnd_int(0, 1);
        p[0] = p[4] = line_point(4, 12, 0, 32, 24);
        p[1] = p[5] = line_point(28, 12, 0, 32, 24);
        for (int k = 2; k < 4; k++) p[k] = shade_v3(rnd_nasty(), rnd_nasty(), rnd_nasty());
        if (rnd_one_in(3)) s.clip_from_points = shade_mat4_perspective(1, 1, 0.1f, 10);
        if (rnd_one_in(3)) s.clip_from_points.col[rnd_int(0, 3)].w = rnd_nasty();
        draw_lines(&c, p, 6, &s);
        s = line_state(2);
        canvas_clear(&c, 1);
        shade_stats stats = draw_lines(&c, p, 6, &s);
        CHECK(stats.drawn >= 4);
        for (int x = 4; x < 28; x++) CHECK(line_pixel(&c, x, 11) && line_pixel(&c, x, 12));
        if (isnan(p[2].x) || isnan(p[2].y)) CHECK_INT(stats.drawn, 4);
        canvas_close(&c);
    }
}

TEST(lines, nothing_is_drawn_outside_the_clip_rectangle)
{
    for (int i = 0; i < 200; i++) {
        canvas whole = canvas_ready(40, 30, 0, SHADE_FORMAT_RGBA8, 1);
        canvas part = canvas_ready(40, 30, 43, SHADE_FORMAT_RGBA8, 1);
        shade_line_state s = line_state(rnd_float(0, 9));
        shade_vec3 p[10];
        for (int k = 0; k < 10; k++)
            p[k] = shade_v3(rnd_float(-2, 2), rnd_float(-2, 2), rnd_float(-1, 1));
        int x = rnd_int(0, 39), y = rnd_int(0, 29), w = rnd_int(1, 30), h = rnd_int(1, 30);
        part.target.clip_x = x;
        part.target.clip_y = y;
        part.target.clip_width = w;
        part.target.clip_height = h;
        draw_lines(&whole, p, 10, &s);
        draw_lines(&part, p, 10, &s);
        for (int k = 0; k < 40 * 30; k++) {
            int px = k % 40, py = k / 40, in = px >= x && px < x + w && py >= y && py < y + h;
            CHECK_INT(line_pixel(&part, px, py), in && line_pixel(&whole, px, py));
        }
        canvas_close(&whole);
        canvas_close(&part);
    }
}

/* ------------------------------------------------------------------------------------ far ends */

/* What near and far leave of a line, in window pixels and depth; left: 0 if nothing. */
typedef struct ref_line {
    double x[2], y[2], z[2];
    int left;
} ref_line;

static ref_line ref_line_of(const shade_line_state *s, const shade_vec3 p[2], int width, int height)
{
    double e[2][4], t[2];
    dmat m = matrix_or_identity(s->clip_from_points);
    int zero_to_one = s->raster.depth_zero_to_one != 0;
    ref_line r = { 0 };
    for (int k = 0; k < 2; k++) {
        const double in[4] = { (double)p[k].x, (double)p[k].y, (double)p[k].z, 1 };
        dmat_apply(m, in, e[k]);
    }
    r.left = ref_line_cut(e, zero_to_one, t);
    for (int k = 0; k < 2 && r.left; k++) {
        double v[4];
        for (int n = 0; n < 4; n++) v[n] = e[0][n] + t[k] * (e[1][n] - e[0][n]);
        r.x[k] = (v[0] / v[3] + 1) * width / 2;
        r.y[k] = (1 - v[1] / v[3]) * height / 2;
        r.z[k] = zero_to_one ? v[2] / v[3] : (v[2] / v[3] + 1) / 2;
    }
    return r;
}

/* Adds 1 to each pixel of the line, then: is each pixel of the rectangle 1, each outside 0, with
   1/256 pixel of doubt?  The depth too, which runs along the line.  Returns the pixels inside. */
static long check_line(canvas *c, const shade_line_state *state, const shade_vec3 p[2])
{
    int width = c->target.width, height = c->target.height, half_pixels = 0;
    double h = (state->width > 0 ? (double)state->width : 1) / 2;
    shade_line_state s = *state;
    long inside = 0;
    s.color = shade_v4(1, 1, 1, 1);
    s.raster.blend = SHADE_BLEND_ADD;
    s.raster.depth_test = SHADE_COMPARE_ALWAYS;
    canvas_clear(c, 1);
    shade_stats stats = draw_lines(c, p, 2, &s);
    ref_line r = ref_line_of(&s, p, width, height);
    line_places place = ref_rectangle(r.x[0], r.y[0], r.x[1], r.y[1], 2 * h, s.cap);
    double dx = r.x[1] - r.x[0], dy = r.y[1] - r.y[0], length = hypot(dx, dy), depth;
    for (int k = 0; k < width * height; k++) {
        double X = k % width + 0.5, Y = k / width + 0.5;
        int in = r.left ? ref_in_rectangle(&place, X, Y, 1 / 256.0) : 0;
        float got = canvas_float(c, k % width, k / width, 0);
        half_pixels += in == -1;
        inside += in == 1;
        CHECK_SAY(in < 0 ? got == 0 || got == 1 : got == (float)in,
                  "pixel %d %d of %d x %d: got %g, want %d; %.9g %.9g to %.9g %.9g width %g cap %d",
                  k % width, k / width, width, height, (double)got, in, r.x[0], r.y[0], r.x[1],
                  r.y[1], (double)s.width, (int)s.cap);
        if (in < 1 || got != 1 || length == 0) continue;
        double along = ((X - r.x[0]) * dx + (Y - r.y[0]) * dy) / length, slope;
        slope = (r.z[1] - r.z[0]) / length;
        depth = r.z[0] + along * slope;
        if (s.cap == SHADE_CAP_SQUARE) /* within half a width of its place */
            depth = fmin(fmax(r.z[0], r.z[1]), fmax(fmin(r.z[0], r.z[1]), depth));
        double near = 2e-6 + fabs(slope) * (s.cap == SHADE_CAP_SQUARE ? h + 0.01 : 0.01);
        CHECK_SAY(fabs((double)canvas_depth(c, k % width, k / width) - depth) <= near,
                  "pixel %d %d: depth %.9g, want %.9g within %.3g; %g %g to %g %g, depth %g to %g",
                  k % width, k / width, (double)canvas_depth(c, k % width, k / width), depth, near,
                  r.x[0], r.y[0], r.x[1], r.y[1], r.z[0], r.z[1]);
    }
    CHECK_INT(stats.rejected, 0);
    if (!r.left) CHECK_INT(stats.clipped, 2);
    CHECK(stats.fragments >= inside && stats.fragments <= inside + half_pixels);
    return inside;
}

/* Through the picture or past it, both ends up to a million pictures away. */
TEST(lines, ends_a_million_pictures_away_keep_their_pixels)
{
    static const int sizes[][2] = { { 60, 44 }, { 1, 1 },   { 2, 3 },     { 64, 64 },
                                    { 390, 4 }, { 5, 300 }, { 16384, 2 }, { 3, 16384 } };
    long inside = 0, far = 0;
    for (int i = 0; i < test_rounds(4000); i++) {
        int kind = i % 40 ? rnd_int(0, 5) : rnd_int(6, 7);
        int width = sizes[kind][0], height = sizes[kind][1], most = width > height ? width : height;
        canvas c = canvas_open(width, height, 0, SHADE_FORMAT_RGBA32F, 1);
        shade_line_state s = line_state(rnd_one_in(6) ? 0 : rnd_log(0.3, rnd_one_in(2) ? 5 : 2e4));
        double X = rnd_unit() * width, Y = rnd_unit() * height;
        double a = rnd_unit() * 6.283185307179586, reach[2];
        shade_vec3 p[2];
        if (rnd_one_in(4)) a = rnd_int(0, 7) * 0.7853981633974483; /* as rows, columns, diagonals */
        if (rnd_one_in(4))                                         /* nearly as a row or a column */
            a = rnd_int(0, 3) * 1.5707963267948966 + (double)(rnd_sign() * rnd_log(1e-8, 1e-2));
        if (rnd_one_in(6)) {
            X += width * (rnd_unit() - 0.5) * 4;
            Y += height * (rnd_unit() - 0.5) * 4;
        }
        s.cap = (shade_cap)rnd_int(0, 1);
        s.raster.depth_zero_to_one = rnd_one_in(2);
        for (int k = 0; k < 2; k++) {
            reach[k] = most * (double)rnd_log(1e-3, 1e6) * (k ? 1 : rnd_one_in(4) ? 0.01 : -1);
            p[k] = line_point(X + cos(a) * reach[k], Y + sin(a) * reach[k],
                              s.raster.depth_zero_to_one ? rnd_unit() : 2 * rnd_unit() - 1, width,
                              height);
        }
        far += fabs(reach[0]) > 1e4 * most || fabs(reach[1]) > 1e4 * most;
        inside += check_line(&c, &s, p);
        canvas_close(&c);
    }
    CHECK_SAY(inside > test_rounds(100000) && far > test_rounds(1000), "%ld pixels, %ld far lines",
              inside, far);
}

/* The same behind a camera: ends beside, above, far before and behind the eye. */
TEST(lines, far_ends_seen_by_a_camera_keep_their_pixels)
{
    enum { W = 64, H = 48 };
    long inside = 0, far = 0;
    for (int i = 0; i < test_rounds(4000); i++) {
        canvas c = canvas_open(W, H, 0, SHADE_FORMAT_RGBA32F, 1);
        shade_line_state s = line_state(rnd_log(0.3, rnd_one_in(3) ? 300 : 5));
        double size = (double)rnd_log(1e-3, 1e3), way;
        float aspect = (float)W / H, near = (float)(0.1 * size);
        shade_vec3 p[2], eye = d3_round(d3_scale(rnd_direction(), 4 * size));
        shade_mat4 view = shade_mat4_look_at(eye, shade_v3(0, 0, 0), shade_v3(0, 1, 0));
        s.cap = (shade_cap)rnd_int(0, 1);
        s.raster.depth_zero_to_one = i % 3 == 0;
        s.clip_from_points = shade_mat4_mul(
            i % 3 == 0   ? shade_mat4_perspective_reversed(1, aspect, near)
            : i % 3 == 1 ? shade_mat4_perspective(1, aspect, near, (float)(1e3 * size))
                         : shade_mat4_ortho(-2 * (float)size, 2 * (float)size, -1.5f * (float)size,
                                            1.5f * (float)size, near, (float)(1e3 * size)),
            view);
        d3 through = d3_scale(rnd_direction(), 1.5 * size), along = rnd_direction();
        for (int k = 0; k < 2; k++) {
            way = size * (double)rnd_log(0.1, rnd_one_in(2) ? 10 : 1e6);
            p[k] = d3_round(d3_add(through, d3_scale(along, k ? way : -way)));
            far += way > 1e3 * size;
        }
        inside += check_line(&c, &s, p);
        canvas_close(&c);
    }
    CHECK_SAY(inside > test_rounds(100000) && far > test_rounds(1000), "%ld pixels, %ld far ends",
              inside, far);
}

/* What touches a plane from outside is a point there. */
TEST(lines, an_end_that_touches_near_or_far_is_a_point)
{
    for (int i = 0; i < 16; i++) {
        canvas c = canvas_ready(16, 12, 0, SHADE_FORMAT_RGBA8, 1);
        shade_line_state s = line_state(4);
        int far = i & 1, zero_to_one = i >> 1 & 1, square = i >> 2 & 1, swapped = i >> 3 & 1;
        double on = far ? 1 : zero_to_one ? 0 : -1;
        shade_vec3 p[2];
        p[swapped] = line_point(8, 6, on, 16, 12);
        p[!swapped] = line_point(12, 6, on + (far ? 1 : -1), 16, 12);
        s.cap = (shade_cap)square;
        s.raster.depth_zero_to_one = zero_to_one;
        s.raster.depth_test = SHADE_COMPARE_ALWAYS;
        shade_stats stats = draw_lines(&c, p, 2, &s);
        CHECK_INT(square ? stats.drawn : stats.culled, 2);
        CHECK_INT(stats.fragments, square ? 16 : 0);
        canvas_close(&c);
    }
}

/* From w = 0, where a line has a direction but no place, or from behind it, to the middle. */
TEST(lines, a_line_from_infinitely_far_enters_from_its_direction)
{
    enum { W = 40, H = 40 };
    for (int i = 0; i < 400; i++) {
        canvas c = canvas_ready(W, H, 0, SHADE_FORMAT_RGBA8, 1);
        shade_line_state s = line_state(rnd_float(0.5, 6));
        double a = rnd_unit() * 6.283185307179586, behind = rnd_one_in(2) ? 0 : rnd_unit();
        shade_vec3 p[2] = { { (float)cos(a), (float)sin(a), (float)-behind }, { 0, 0, 1 } };
        int swapped = rnd_int(0, 1);
        shade_vec3 first = p[swapped], second = p[!swapped];
        p[0] = first;
        p[1] = second;
        memset(&s.clip_from_points, 0, sizeof s.clip_from_points);
        s.clip_from_points.col[0].x = s.clip_from_points.col[1].y = 1; /* x, y, 0, z */
        s.clip_from_points.col[2].w = 1;
        s.raster.depth_zero_to_one = rnd_int(0, 1);
        shade_stats stats = draw_lines(&c, p, 2, &s);
        line_places r = ref_rectangle(W / 2, H / 2, W / 2 + cos(a) * 100, H / 2 - sin(a) * 100,
                                      (double)s.width, SHADE_CAP_BUTT);
        CHECK_INT(stats.drawn, 2);
        for (int k = 0; k < W * H; k++) {
            int in = ref_in_rectangle(&r, k % W + 0.5, k / W + 0.5, 1 / 256.0);
            CHECK_SAY(in < 0 || line_pixel(&c, k % W, k / W) == in,
                      "pixel %d %d: want %d, angle %g", k % W, k / W, in, a);
        }
        canvas_close(&c);
    }
}

/* A scene a million million times smaller or larger gives the same pixels. */
TEST(lines, the_scale_of_a_scene_does_not_matter)
{
    static const int power[] = { 0, -43, -40, -20, 20, 40, 43 };
    canvas first = canvas_open(64, 48, 0, SHADE_FORMAT_RGBA8, 1);
    for (int i = 0; i < 100; i++) {
        shade_vec3 p[20], moved[20];
        for (int k = 0; k < 20; k++) {
            p[k] = random_vector(3);
            p[k].z -= 3;
        }
        for (int n = 0; n < 7; n++) {
            canvas c = canvas_ready(64, 48, 0, SHADE_FORMAT_RGBA8, 1);
            float scale = (float)ldexp(1, power[n]);
            shade_line_state s = line_state(3);
            s.clip_from_points = shade_mat4_perspective(1, 4.0f / 3, 0.125f * scale, 16 * scale);
            for (int k = 0; k < 20; k++) moved[k] = shade_scale(p[k], scale);
            shade_stats stats = draw_lines(&c, moved, 20, &s);
            if (n)
                CHECK_SAY(canvas_same(&first, &c), "2^%d", power[n]);
            else {
                CHECK(stats.drawn > 2 && stats.fragments > 20);
                memcpy(first.color, c.color, c.color_bytes + 2 * CANVAS_GUARD);
                memcpy(first.depth, c.depth, c.depth_bytes + 2 * CANVAS_GUARD);
            }
            canvas_close(&c);
        }
    }
    canvas_close(&first);
}

/* A NaN, an infinity or a place beyond 1e30 is counted as rejected, before or behind the eye, in
   the points or in the matrix; the lines beside it are drawn. */
TEST(lines, places_that_are_none_are_rejected_wherever_they_lie)
{
    static const float none[] = { NAN, INFINITY, -INFINITY, 3e38f, -3e38f };
    for (int i = 0; i < 4000; i++) {
        canvas c = canvas_ready(32, 24, 0, SHADE_FORMAT_RGBA8, 1);
        shade_line_state s = line_state(rnd_log(0.3, 2000));
        shade_vec3 p[4];
        float bad = none[rnd_int(0, 4)], f[16];
        int in_matrix = rnd_one_in(3), k = rnd_int(0, 15);
        shade_mat4 m = random_mat4(2);
        s.cap = (shade_cap)rnd_int(0, 1);
        s.raster.depth_zero_to_one = rnd_one_in(2);
        for (int n = 0; n < 4; n++) p[n] = random_vector(rnd_one_in(2) ? 1 : 10);
        memcpy(f, &m, sizeof f);
        for (int n = 0; n < 16; n++) /* no zeros, which would make NaN of an infinity */
            if (fabsf(f[n]) < 0.1f) f[n] = 0.5f;
        if (in_matrix) {
            f[k] = bad;
            for (int n = 0; n < 4; n++) p[n] = shade_v3(1, 0.5f, -2);
        }
        memcpy(&s.clip_from_points, f, sizeof f);
        if (!in_matrix) {
            float *at[3] = { &p[k & 1].x, &p[k & 1].y, &p[k & 1].z };
            *at[rnd_int(0, 2)] = bad;
        }
        shade_stats stats = draw_lines(&c, p, 4, &s);
        CHECK_SAY(stats.rejected == (in_matrix ? 4 : 2), "%lld rejected, %lld clipped, %g",
                  stats.rejected, stats.clipped, (double)bad);
        if (in_matrix) CHECK_INT(stats.fragments, 0);
        shade_stats other = draw_lines(&c, p + 2, 2, &s);
        if (!in_matrix) CHECK(other.drawn + other.clipped + other.culled == stats.triangles - 2);
        canvas_close(&c);
    }
}

/* Any finite numbers whatever: each triangle is counted once, nothing is written outside. */
TEST(lines, any_finite_numbers_keep_to_the_picture_and_the_count)
{
    for (int i = 0; i < 20000; i++) {
        canvas c = canvas_ready(i % 3 ? 17 : 1, i % 5 ? 9 : 1, 0, SHADE_FORMAT_RGBA8, 1);
        shade_line_state s = line_state(rnd_one_in(3) ? 0 : rnd_log(1e-38, 3e38));
        float f[16];
        shade_vec3 p[6];
        s.cap = (shade_cap)rnd_int(0, 1);
        s.raster.depth_zero_to_one = rnd_one_in(2);
        for (int n = 0; n < 16; n++) {
            double most = rnd_one_in(3) ? 38 : rnd_one_in(2) ? 10 : 1;
            f[n] = rnd_one_in(4) ? 0 : rnd_sign() * (float)pow(10, most * (2 * rnd_unit() - 1));
        }
        if (rnd_one_in(2)) memcpy(&s.clip_from_points, f, sizeof f);
        for (int n = 0; n < 6; n++) {
            double most = rnd_one_in(3) ? 38 : rnd_one_in(2) ? 10 : 1;
            p[n] = shade_v3(rnd_sign() * (float)pow(10, most * (2 * rnd_unit() - 1)),
                            rnd_sign() * (float)pow(10, most * (2 * rnd_unit() - 1)),
                            rnd_one_in(2) ? 0 : rnd_sign() * (float)pow(10, most * -rnd_unit()));
            if (rnd_one_in(5) && n) p[n] = p[n - 1];
        }
        draw_lines(&c, p, 6, &s);
        canvas_close(&c);
    }
}

/* Near = far, no angle, no aspect: no line, whatever the convention of depth is. */
TEST(lines, a_degenerate_camera_draws_no_line)
{
    shade_vec3 p[4] = { { -1, -1, 0.25f }, { 1, 1, 0.5f }, { -9, 0, -1 }, { 9, 1, -5 } };
    for (int i = 0; i < DEGENERATE_CAMERAS * 8; i++) {
        canvas c = canvas_open(16, 12, 0, SHADE_FORMAT_RGBA8, 1);
        shade_line_state s = line_state(i % 5 ? 3 : 500);
        s.clip_from_points = degenerate_camera(i / 8);
        s.raster.depth_zero_to_one = i & 1;
        s.raster.depth_test = i & 2 ? SHADE_COMPARE_GREATER : SHADE_COMPARE_LESS;
        s.cap = (shade_cap)(i / 4 % 2);
        canvas_clear(&c, i & 2 ? 0.0f : 1.0f);
        shade_stats stats = draw_lines(&c, p, 4, &s);
        CHECK_INT(stats.clipped, 4);
        CHECK_INT(stats.fragments, 0);
        memset(&s.clip_from_points, 0, sizeof s.clip_from_points); /* is no camera: the identity */
        CHECK(draw_lines(&c, p, 2, &s).fragments > 10);
        canvas_close(&c);
    }
}

/* --------------------------------------------------------------------------------------- depth */

/* A line from edge to edge, so that the depth at a pixel is its place along the row.  Where it
   meets the wall within 1e-5 rounding decides, and the pixel is left out. */
TEST(lines, depth_runs_from_end_to_end_and_is_tested)
{
    enum { W = 200, H = 9 };
    for (int i = 0; i < 100; i++) {
        canvas c = canvas_open(W, H, 0, SHADE_FORMAT_RGBA8, 1);
        shade_line_state s = line_state(5);
        float z[2] = { rnd_float(-1, 1), rnd_float(-1, 1) }, wall = rnd_float(0, 1);
        shade_vec3 p[2];
        s.raster.depth_zero_to_one = i & 1;
        for (int k = 0; k < 2; k++) {
            if (i & 1) z[k] = fabsf(z[k]);
            p[k] = line_point(k * W, 4.5, (double)z[k], W, H);
        }
        s.raster.depth_test = (shade_compare)rnd_int(0, 5);
        s.raster.depth_read_only = rnd_one_in(3);
        s.raster.depth_bias = rnd_one_in(2) ? 0 : rnd_float(-0.2, 0.2);
        canvas_clear(&c, wall);
        draw_lines(&c, p, 2, &s);
        for (int x = 0; x < W; x++) {
            double at = (double)z[0] + (x + 0.5) / W * ((double)z[1] - (double)z[0]), d;
            d = (i & 1 ? at : at / 2 + 0.5) + (double)s.raster.depth_bias;
            d = fmax(0, fmin(1, d));
            if (fabs(d - (double)wall) < 1e-5) continue;
            int less = d < (double)wall, pass = 1;
            if (s.raster.depth_test <= SHADE_COMPARE_LESS_EQUAL)
                pass = less;
            else if (s.raster.depth_test <= SHADE_COMPARE_GREATER_EQUAL)
                pass = !less;
            else if (s.raster.depth_test == SHADE_COMPARE_EQUAL)
                pass = 0;
            CHECK_SAY(line_pixel(&c, x, 4) == pass, "test %d: depth %g against %g",
                      (int)s.raster.depth_test, d, (double)wall);
            CHECK_NEAR(canvas_depth(&c, x, 4), pass && !s.raster.depth_read_only ? d : (double)wall,
                       2e-6);
        }
        canvas_close(&c);
    }
}

/* The edges of a filled mesh, drawn over it: the near ones seen whole, the far ones hidden. */
TEST(lines, a_small_negative_bias_lifts_lines_off_their_own_faces)
{
    for (int i = 0; i < 60; i++) {
        canvas c = canvas_ready(80, 60, 0, SHADE_FORMAT_RGBA8, 1);
        shade_vec3 p[3], pairs[6], behind[2];
        shade_line_state s = line_state(1);
        shade_mesh mesh = plain_mesh(&p[0].x, 3);
        shade_draw_state fill = plain_state(NULL);
        for (int k = 0; k < 3; k++) {
            double a = 2.0943951 * k + rnd_unit();
            p[k] = shade_v3((float)cos(a) * 0.8f, (float)sin(a) * 0.8f, rnd_float(-0.5, 0.5));
        }
        for (int k = 0; k < 6; k++) pairs[k] = p[(k / 2 + k % 2) % 3];
        behind[0] = shade_v3(-0.9f, 0, 0.9f);
        behind[1] = shade_v3(0.9f, 0, 0.9f);
        canvas_draw_mesh(&c, &mesh, &fill);
        s.raster.depth_test = SHADE_COMPARE_LESS_EQUAL;
        s.raster.depth_bias = -0.02f;
        canvas plain = canvas_ready(80, 60, 0, SHADE_FORMAT_RGBA8, 0);
        draw_lines(&plain, pairs, 6, &s);
        draw_lines(&c, pairs, 6, &s);
        for (int k = 0; k < 80 * 60; k++) {
            if (line_pixel(&plain, k % 80, k / 80)) CHECK(line_pixel(&c, k % 80, k / 80));
        }
        s.color = shade_v4(1, 0, 0, 0.25f);
        draw_lines(&c, behind, 2, &s);
        CHECK(canvas_bytes(&c, 40, 30)[3] != 64 || canvas_bytes(&c, 40, 29)[3] != 64);
        CHECK(canvas_bytes(&c, 5, 30)[3] == 64 || canvas_bytes(&c, 5, 29)[3] == 64);
        canvas_close(&c);
        canvas_close(&plain);
    }
}

/* Lines have no back: cull, even one there is not, changes nothing. */
TEST(lines, cull_is_ignored)
{
    long drawn = 0;
    for (int i = 0; i < 60; i++) {
        canvas plain = canvas_ready(40, 30, 0, SHADE_FORMAT_RGBA8, 1);
        shade_line_state s = line_state(rnd_float(0, 9));
        shade_vec3 p[10];
        for (int k = 0; k < 10; k++) p[k] = random_vector(1.5);
        shade_stats stats = draw_lines(&plain, p, 10, &s);
        drawn += stats.drawn;
        for (int cull = 1; cull < 4; cull++) {
            canvas c = canvas_ready(40, 30, 0, SHADE_FORMAT_RGBA8, 1);
            s.raster.cull = (shade_cull)cull;
            shade_stats other = draw_lines(&c, p, 10, &s);
            CHECK(canvas_same(&c, &plain) && !memcmp(&stats, &other, sizeof stats));
            canvas_close(&c);
        }
        canvas_close(&plain);
    }
    CHECK_SAY(drawn > 300, "%ld", drawn);
}

/* A line as wide as the picture; its colour is beyond [0, 1], which a picture of floats keeps. */
TEST(lines, colour_and_blending_are_the_state_s)
{
    canvas c = canvas_open(8, 8, 0, SHADE_FORMAT_RGBA32F, 0);
    shade_line_state s = line_state(100);
    shade_vec3 p[2] = { { -1, 0, 0 }, { 1, 0, 0 } };
    s.color = shade_v4(2, -1, 0.5f, 0.25f);
    CHECK_INT(shade_clear(&c.target, shade_v4(1, 1, 1, 1), 1), SHADE_OK);
    draw_lines(&c, p, 2, &s);
    CHECK_NEAR(canvas_float(&c, 3, 3, 0), 2, 0);
    CHECK_NEAR(canvas_float(&c, 3, 3, 1), -1, 0);
    CHECK_NEAR(canvas_float(&c, 3, 3, 3), 0.25, 0);
    s.raster.blend = SHADE_BLEND_ADD;
    draw_lines(&c, p, 2, &s);
    CHECK_NEAR(canvas_float(&c, 3, 3, 0), 4, 0);
    s.raster.blend = SHADE_BLEND_OVER;
    draw_lines(&c, p, 2, &s);
    CHECK_NEAR(canvas_float(&c, 3, 3, 0), 2 * 0.25 + 4 * 0.75, 1e-6);
    canvas_close(&c);
}

/* ----------------------------------------------------------------------------------- arguments */

/* What shade_draw_lines is given: two lines across a small picture. */
typedef struct line_call {
    const shade_target *target;
    const shade_vec3 *points;
    const shade_line_state *state;
    int count;
    shade_target t;
    shade_line_state s;
} line_call;

#define LINE_FAULT(field, value) FAULT(line_call, field, value)
#define LINE_REAL(field, value) FAULT_REAL(line_call, field, value)
static const refusal bad_line_calls[] = {
    { SHADE_ERROR_ARGUMENT, { FAULT_NULL(line_call, target) } },
    { SHADE_ERROR_ARGUMENT, { FAULT_NULL(line_call, points) } },
    { SHADE_ERROR_ARGUMENT, { FAULT_NULL(line_call, state) } },
    { SHADE_ERROR_MESH, { LINE_FAULT(count, 3) } },
    { SHADE_ERROR_MESH, { LINE_FAULT(count, -2) } },
    { SHADE_ERROR_MESH, { LINE_FAULT(count, -1) } },
    { SHADE_ERROR_MESH, { LINE_FAULT(count, 2147483646) } }, /* more corners than an int counts */
    { SHADE_ERROR_STATE, { LINE_REAL(s.width, -1) } },
    { SHADE_ERROR_STATE, { LINE_REAL(s.width, NAN) } },
    { SHADE_ERROR_STATE, { LINE_REAL(s.width, INFINITY) } },
    { SHADE_ERROR_STATE, { LINE_FAULT(s.cap, 2) } },
    { SHADE_ERROR_STATE, { LINE_FAULT(s.cap, -1) } },
    { SHADE_ERROR_STATE, { LINE_FAULT(s.raster.depth_test, 6) } },
    { SHADE_ERROR_STATE, { LINE_FAULT(s.raster.blend, 3) } },
    { SHADE_ERROR_STATE, { LINE_REAL(s.raster.depth_bias, NAN) } },
    { SHADE_ERROR_TARGET, { LINE_FAULT(t.width, 0) } },
    { SHADE_ERROR_TARGET, { LINE_FAULT(t.stride, 3) } },
    { SHADE_ERROR_TARGET, { LINE_FAULT(t.format, 9) } },
    { SHADE_ERROR_TARGET, { LINE_FAULT(t.height, -1), LINE_FAULT(count, 3) } },
    { SHADE_OK, { LINE_FAULT(count, 0), FAULT_NULL(line_call, points) } }, /* draws no line */
};

/* G2 */
TEST(lines, bad_arguments_are_refused_before_a_pixel_changes)
{
    static const shade_vec3 points[4] = { { -1, -1, 0 }, { 1, 1, 0 }, { -1, 1, 0 }, { 1, -1, 0 } };
    canvas c = canvas_open(16, 12, 0, SHADE_FORMAT_RGBA8, 1);
    for (int row = 0; row < TEST_COUNT(bad_line_calls); row++) {
        line_call bad = { NULL, points, NULL, 4, c.target, line_state(3) };
        bad.target = &bad.t;
        bad.state = &bad.s;
        spoil(&bad, bad_line_calls[row].faults);

        shade_stats stats;
        memset(&stats, CANVAS_BYTE, sizeof stats);
        shade_result got = shade_draw_lines(bad.target, bad.points, bad.count, bad.state, &stats);
        check_refusal(row, got, bad_line_calls[row].want);
        CHECK_INT(stats.triangles, 0);
        CHECK_INT(stats.fragments, 0);
        CHECK_SAY(canvas_untouched(&c), "row %d", row);
    }
    canvas_close(&c);
}

TEST(lines, depth_only_targets_take_lines_too)
{
    canvas c = canvas_ready(16, 12, 0, SHADE_FORMAT_RGBA8, 1);
    shade_line_state s = line_state(2);
    shade_vec3 p[2] = { { -1, 0, 0 }, { 1, 0, 0 } };
    c.target.color = NULL;
    shade_stats stats = draw_lines(&c, p, 2, &s);
    CHECK_INT(stats.fragments, 32);
    CHECK_NEAR(canvas_depth(&c, 7, 5), 0.5, 0);
    canvas_close(&c);
}
