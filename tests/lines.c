/* lines.c - lines as rectangles of the screen: coverage, ends, clipping, depth, arguments. */

typedef struct line_places { /* the rectangle of one line, window pixels, y down */
    double x[4], y[4];       /* in order around it */
} line_places;

static line_places ref_rectangle(double ax, double ay, double bx, double by, double width,
                                 shade_cap cap)
{
    line_places r;
    double dx = bx - ax, dy = by - ay, length = hypot(dx, dy), h = width / 2;
    dx = length > 0 ? dx / length : 1, dy = length > 0 ? dy / length : 0;
    if (cap == SHADE_CAP_SQUARE) ax -= dx * h, ay -= dy * h, bx += dx * h, by += dy * h;
    r.x[0] = ax + dy * h, r.y[0] = ay - dx * h, r.x[1] = bx + dy * h, r.y[1] = by - dx * h;
    r.x[2] = bx - dy * h, r.y[2] = by + dx * h, r.x[3] = ax - dy * h, r.y[3] = ay + dx * h;
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
    shade_line_state s;
    memset(&s, 0, sizeof s);
    s.width = width, s.color = shade_v4(1, 1, 1, 1);
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

/* Along the axes and along 3-4-5 slopes the corners of a rectangle lie on the grid of 1/256 pixel
   that vertices snap to, and its pixels are known without any margin. */
TEST(lines, coverage_is_the_pixels_of_the_rectangle_exactly)
{
    static const int way[12][2] = { { 5, 0 },  { 0, 5 },  { -5, 0 }, { 0, -5 }, { 3, 4 }, { 4, 3 },
                                    { -3, 4 }, { 4, -3 }, { 3, -4 }, { -4, 3 }, { -3, -4 },
                                    { -4, -3 } };
    for (int i = 0; i < 1500; i++) {
        canvas c = canvas_open(60, 44, 0, SHADE_FORMAT_RGBA8, 0);
        const int *w = way[rnd_int(0, 11)];
        int half = rnd_one_in(3) ? 128 * rnd_int(1, 8) : rnd_int(1, 900); /* 5/256 of half width */
        int64_t ax = rnd_int(0, 60 * 256), ay = rnd_int(0, 44 * 256), x[5], y[5];
        int64_t n = rnd_int(1, rnd_one_in(2) ? 100 : 1500);
        if (rnd_one_in(2)) ax = ax / 128 * 128, ay = ay / 128 * 128, n = n / 128 * 128 + 128;
        int64_t bx = ax + n * w[0], by = ay + n * w[1];
        shade_line_state s = line_state((float)(half * 10 / 256.0));
        s.cap = (shade_cap)rnd_int(0, 1);
        shade_vec3 p[2];
        p[0] = line_point((double)ax / 256, (double)ay / 256, 0, 60, 44);
        p[1] = line_point((double)bx / 256, (double)by / 256, 0, 60, 44);
        canvas_clear(&c, 1);
        shade_stats stats = draw_lines(&c, p, 2, &s);
        int64_t reach = s.cap == SHADE_CAP_SQUARE ? half : 0;
        ax -= w[0] * reach, ay -= w[1] * reach, bx += w[0] * reach, by += w[1] * reach;
        int64_t ox = (int64_t)w[1] * half, oy = -(int64_t)w[0] * half;
        x[0] = ax + ox, y[0] = ay + oy, x[1] = bx + ox, y[1] = by + oy;
        x[2] = bx - ox, y[2] = by - oy, x[3] = ax - ox, y[3] = ay - oy, x[4] = x[0], y[4] = y[0];
        long long fragments = 0;
        for (int k = 0; k < 60 * 44; k++) {
            int64_t u[3] = { x[0], x[1], x[2] }, v[3] = { y[0], y[1], y[2] };
            int in = ref_inside_fx8(u, v, k % 60, k / 60);
            in |= ref_inside_fx8(x + 2, y + 2, k % 60, k / 60);
            fragments += in;
            CHECK_SAY(line_pixel(&c, k % 60, k / 60) == in,
                      "pixel %d %d: want %d; way %d %d, half %d", k % 60, k / 60, in, w[0], w[1],
                      half);
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
        canvas c = canvas_open(width, height, width + rnd_int(0, 3), SHADE_FORMAT_RGBA8, 0);
        double reach = rnd_one_in(4) ? 20 : 1, x[2], y[2];
        for (int k = 0; k < 2; k++) {
            x[k] = (rnd_unit() - 0.5) * reach * width + 0.5 * width;
            y[k] = (rnd_unit() - 0.5) * reach * height + 0.5 * height;
        }
        shade_line_state s = line_state(rnd_one_in(5) ? 0 : rnd_log(0.05, 200));
        s.cap = (shade_cap)rnd_int(0, 1);
        shade_vec3 p[2];
        for (int k = 0; k < 2; k++) p[k] = line_point(x[k], y[k], 0, width, height);
        canvas_clear(&c, 1);
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
TEST(lines, no_width_is_one_pixel)
{
    canvas a = canvas_open(40, 30, 0, SHADE_FORMAT_RGBA8, 0),
           b = canvas_open(40, 30, 0, SHADE_FORMAT_RGBA8, 0);
    shade_vec3 p[40];
    for (int k = 0; k < 40; k++) p[k] = shade_v3(rnd_float(-1, 1), rnd_float(-1, 1), 0);
    shade_line_state zero = line_state(0), one = line_state(1);
    canvas_clear(&a, 1), canvas_clear(&b, 1);
    draw_lines(&a, p, 40, &zero), draw_lines(&b, p, 40, &one);
    CHECK(canvas_same(&a, &b));
    canvas_close(&a), canvas_close(&b);
}
TEST(lines, square_ends_close_the_joints_of_a_path)
{
    canvas c = canvas_open(20, 20, 0, SHADE_FORMAT_RGBA8, 0);
    shade_line_state s = line_state(4);
    shade_vec3 p[4];
    p[0] = p[3] = line_point(6, 6, 0, 20, 20);
    p[1] = line_point(16, 6, 0, 20, 20), p[2] = line_point(6, 16, 0, 20, 20);
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
        canvas c = canvas_open(32, 32, 0, SHADE_FORMAT_RGBA8, 0);
        int x = rnd_int(8, 24), y = rnd_int(8, 24), half = rnd_int(1, 6), count = 0;
        shade_line_state s = line_state((float)(2 * half));
        shade_vec3 p[2];
        p[0] = p[1] = line_point(x, y, 0, 32, 32);
        s.cap = (shade_cap)(i & 1);
        canvas_clear(&c, 1);
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
    t[0] = 0, t[1] = 1;
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
TEST(lines, near_and_far_cut_the_segment_before_it_gets_its_width)
{
    enum { W = 64, H = 48 };
    long cut = 0;
    for (int i = 0; i < 1500; i++) {
        canvas c = canvas_open(W, H, 0, SHADE_FORMAT_RGBA8, 0);
        shade_line_state s = line_state(rnd_log(0.5, 10));
        double e[2][4], t[2], x[2], y[2], w[2];
        shade_vec3 p[2];
        s.cap = (shade_cap)rnd_int(0, 1), s.raster.depth_zero_to_one = rnd_one_in(2);
        s.clip_from_points = s.raster.depth_zero_to_one
                                 ? shade_mat4_perspective_reversed(1, (float)W / H, 0.5f)
                                 : shade_mat4_perspective(1, (float)W / H, 0.5f, 8);
        for (int k = 0; k < 2; k++) {
            double z = rnd_one_in(3) ? rnd_unit() * 3 - 2 : -0.5 - 9 * rnd_unit();
            p[k] = shade_v3(rnd_float(-1, 1) * (float)fabs(z), rnd_float(-1, 1) * (float)fabs(z),
                            (float)z);
            double in[4] = { (double)p[k].x, (double)p[k].y, (double)p[k].z, 1 };
            dmat_apply(dmat_from(s.clip_from_points), in, e[k]);
        }
        canvas_clear(&c, 1);
        shade_stats stats = draw_lines(&c, p, 2, &s);
        int left = ref_line_cut(e, s.raster.depth_zero_to_one, t);
        if (!left) {
            CHECK_INT(stats.clipped, 2);
            CHECK_INT(stats.fragments, 0);
            canvas_close(&c);
            continue;
        }
        for (int k = 0; k < 2; k++) {
            double v[4];
            for (int n = 0; n < 4; n++) v[n] = e[0][n] + t[k] * (e[1][n] - e[0][n]);
            x[k] = (v[0] / v[3] + 1) * W / 2, y[k] = (1 - v[1] / v[3]) * H / 2, w[k] = v[3];
        }
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
TEST(lines, points_that_are_no_numbers_are_rejected_and_the_rest_drawn)
{
    for (int i = 0; i < 500; i++) {
        canvas c = canvas_open(32, 24, 0, SHADE_FORMAT_RGBA8, 1);
        shade_line_state s = line_state(rnd_one_in(3) ? rnd_log(1e-30, 3e38) : 2);
        shade_vec3 p[6];
        s.cap = (shade_cap)rnd_int(0, 1);
        p[0] = p[4] = line_point(4, 12, 0, 32, 24), p[1] = p[5] = line_point(28, 12, 0, 32, 24);
        for (int k = 2; k < 4; k++) p[k] = shade_v3(rnd_nasty(), rnd_nasty(), rnd_nasty());
        if (rnd_one_in(3)) s.clip_from_points = shade_mat4_perspective(1, 1, 0.1f, 10);
        if (rnd_one_in(3)) s.clip_from_points.col[rnd_int(0, 3)].w = rnd_nasty();
        canvas_clear(&c, 1);
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
        canvas whole = canvas_open(40, 30, 0, SHADE_FORMAT_RGBA8, 1);
        canvas part = canvas_open(40, 30, 43, SHADE_FORMAT_RGBA8, 1);
        shade_line_state s = line_state(rnd_float(0, 9));
        shade_vec3 p[10];
        for (int k = 0; k < 10; k++)
            p[k] = shade_v3(rnd_float(-2, 2), rnd_float(-2, 2), rnd_float(-1, 1));
        canvas_clear(&whole, 1), canvas_clear(&part, 1);
        int x = rnd_int(0, 39), y = rnd_int(0, 29), w = rnd_int(1, 30), h = rnd_int(1, 30);
        part.target.clip_x = x, part.target.clip_y = y;
        part.target.clip_width = w, part.target.clip_height = h;
        draw_lines(&whole, p, 10, &s), draw_lines(&part, p, 10, &s);
        for (int k = 0; k < 40 * 30; k++) {
            int px = k % 40, py = k / 40, in = px >= x && px < x + w && py >= y && py < y + h;
            CHECK_INT(line_pixel(&part, px, py), in && line_pixel(&whole, px, py));
        }
        canvas_close(&whole), canvas_close(&part);
    }
}

/* --------------------------------------------------------------------------------------- depth */

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
        s.raster.depth_test = (shade_compare)rnd_int(0, 5),
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
        canvas c = canvas_open(80, 60, 0, SHADE_FORMAT_RGBA8, 1);
        shade_vec3 p[3], pairs[6], behind[2];
        shade_mesh mesh;
        shade_draw_state fill;
        shade_line_state s = line_state(1);
        memset(&mesh, 0, sizeof mesh), memset(&fill, 0, sizeof fill);
        for (int k = 0; k < 3; k++) {
            double a = 2.0943951 * k + rnd_unit();
            p[k] = shade_v3((float)cos(a) * 0.8f, (float)sin(a) * 0.8f, rnd_float(-0.5, 0.5));
        }
        for (int k = 0; k < 6; k++) pairs[k] = p[(k / 2 + k % 2) % 3];
        behind[0] = shade_v3(-0.9f, 0, 0.9f), behind[1] = shade_v3(0.9f, 0, 0.9f);
        mesh.positions = &p[0].x, mesh.vertex_count = 3;
        canvas_clear(&c, 1);
        CHECK_INT(shade_draw_mesh(&c.target, &mesh, &fill, NULL), SHADE_OK);
        s.raster.depth_test = SHADE_COMPARE_LESS_EQUAL, s.raster.depth_bias = -0.02f;
        canvas plain = canvas_open(80, 60, 0, SHADE_FORMAT_RGBA8, 0);
        canvas_clear(&plain, 1);
        draw_lines(&plain, pairs, 6, &s), draw_lines(&c, pairs, 6, &s);
        for (int k = 0; k < 80 * 60; k++) {
            if (line_pixel(&plain, k % 80, k / 80)) CHECK(line_pixel(&c, k % 80, k / 80));
        }
        s.color = shade_v4(1, 0, 0, 0.25f);
        draw_lines(&c, behind, 2, &s);
        CHECK(canvas_bytes(&c, 40, 30)[3] != 64 || canvas_bytes(&c, 40, 29)[3] != 64);
        CHECK(canvas_bytes(&c, 5, 30)[3] == 64 || canvas_bytes(&c, 5, 29)[3] == 64);
        canvas_close(&c), canvas_close(&plain);
    }
}
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

TEST(lines, bad_arguments_are_refused_before_a_pixel_changes)
{
    for (int k = 0; k < 20; k++) {
        canvas c = canvas_open(16, 12, 0, SHADE_FORMAT_RGBA8, 1);
        shade_vec3 p[4] = { { -1, -1, 0 }, { 1, 1, 0 }, { -1, 1, 0 }, { 1, -1, 0 } };
        const shade_vec3 *points = p;
        shade_line_state s = line_state(3);
        const shade_line_state *state = &s;
        const shade_target *target = &c.target;
        shade_stats stats;
        shade_result want = SHADE_ERROR_ARGUMENT;
        int count = 4;
        memset(&stats, CANVAS_BYTE, sizeof stats);
        switch (k) {
        case 0: target = NULL; break;
        case 1: points = NULL; break;
        case 2: state = NULL; break;
        case 3: count = 3; break;
        case 4: count = -2; break;
        case 5: count = -1; break;
        case 6: s.width = -1; break;
        case 7: s.width = (float)NAN; break;
        case 8: s.width = INFINITY; break;
        case 9: s.cap = (shade_cap)2; break;
        case 10: s.cap = (shade_cap)-1; break;
        case 11:
            s.raster.depth_test = (shade_compare)6;
            break;
        case 12:
            s.raster.blend = (shade_blend)3;
            break;
        case 13:
            s.raster.depth_bias = (float)NAN;
            break;
        case 14: c.target.width = 0, want = SHADE_ERROR_TARGET; break;
        case 15: c.target.stride = 3, want = SHADE_ERROR_TARGET; break;
        case 16: c.target.format = (shade_format)9, want = SHADE_ERROR_TARGET; break;
        case 18: count = 2147483646; break; /* more corners than an int counts */
        case 17: count = 0, points = NULL, want = SHADE_OK; break;
        default: c.target.height = -1, count = 3, want = SHADE_ERROR_TARGET; break;
        }
        CHECK_INT(shade_draw_lines(target, points, count, state, &stats), want);
        CHECK_INT(stats.triangles, 0);
        CHECK_INT(stats.fragments, 0);
        for (size_t i = 0; i < c.color_bytes; i++) CHECK(c.color[CANVAS_GUARD + i] == CANVAS_BYTE);
        for (size_t i = 0; i < c.depth_bytes; i++) CHECK(c.depth[CANVAS_GUARD + i] == CANVAS_BYTE);
        c.target.width = 16, c.target.height = 12;
        canvas_close(&c);
    }
}
TEST(lines, depth_only_targets_take_lines_too)
{
    canvas c = canvas_open(16, 12, 0, SHADE_FORMAT_RGBA8, 1);
    shade_line_state s = line_state(2);
    shade_vec3 p[2] = { { -1, 0, 0 }, { 1, 0, 0 } };
    canvas_clear(&c, 1);
    c.target.color = NULL;
    shade_stats stats = draw_lines(&c, p, 2, &s);
    CHECK_INT(stats.fragments, 32);
    CHECK_NEAR(canvas_depth(&c, 7, 5), 0.5, 0);
    canvas_close(&c);
}

static const test_case lines_cases[] = {
    CASE(lines, coverage_is_the_pixels_of_the_rectangle_exactly),
    CASE(lines, coverage_is_the_rectangle_in_any_direction),
    CASE(lines, no_width_is_one_pixel),
    CASE(lines, square_ends_close_the_joints_of_a_path),
    CASE(lines, a_line_without_length_is_nothing_or_a_square),
    CASE(lines, near_and_far_cut_the_segment_before_it_gets_its_width),
    CASE(lines, points_that_are_no_numbers_are_rejected_and_the_rest_drawn),
    CASE(lines, nothing_is_drawn_outside_the_clip_rectangle),
    CASE(lines, depth_runs_from_end_to_end_and_is_tested),
    CASE(lines, a_small_negative_bias_lifts_lines_off_their_own_faces),
    CASE(lines, colour_and_blending_are_the_state_s),
    CASE(lines, bad_arguments_are_refused_before_a_pixel_changes),
    CASE(lines, depth_only_targets_take_lines_too),
};
