/* clip.c - what is outside goes, what is inside stays, and the cut leaves no trace. */
#include "unit.h"

/* The allowed move of an edge: snapping moves a corner by at most 1/512 pixel in x and in y
   (0.71/256 along an edge's normal), clipping an edge by 1/256. */
#define CLIP_MARGIN (2.0 / 256)

static shade_stats draw_clip_space(canvas *c, const shade_vec4 *clip, int vertices, int zero_to_one,
                                   recorder *r)
{
    scene s = { clip, NULL, 0, NULL, r };
    shade_pipeline p = scene_pipeline(&s);
    shade_stats stats;
    p.raster.depth_zero_to_one = zero_to_one;
    memset(&stats, 0x55, sizeof stats);
    stats = canvas_draw(c, &p, vertices);
    CHECK_INT(stats.triangles, vertices / 3);
    CHECK_INT(stats.culled + stats.clipped + stats.rejected + stats.drawn, stats.triangles);
    return stats;
}

/* All three corners are beyond the same plane, by a hundredth of w up to a hundred w. */
TEST(clip, triangles_outside_one_plane_count_as_clipped)
{
    canvas c = canvas_ready(40, 30, 43, SHADE_FORMAT_RGBA8, 1);
    canvas before = canvas_ready(40, 30, 43, SHADE_FORMAT_RGBA8, 1);
    for (int i = 0; i < 3000; i++) {
        shade_vec4 v[3];
        int axis = rnd_int(0, 2), zero_to_one = rnd_one_in(2), side = rnd_one_in(2);
        for (int k = 0; k < 3; k++) {
            double w = (double)rnd_log(0.1, 10), p[3];
            for (int j = 0; j < 3; j++)
                p[j] = (double)rnd_float(zero_to_one && j == 2 ? 0.1 : -0.9, 0.9) * w;
            p[axis] = (side ? 1 : -1) * w * (double)rnd_log(1.01, 100);
            if (zero_to_one && axis == 2 && !side) p[2] = -w * (double)rnd_log(0.01, 1);
            v[k] = shade_v4((float)p[0], (float)p[1], (float)p[2], (float)w);
        }
        shade_stats stats = draw_clip_space(&c, v, 3, zero_to_one, NULL);
        CHECK_INT(stats.drawn, 0);
        CHECK_INT(stats.rejected, 0);
        CHECK_INT(stats.fragments, 0);
    }
    CHECK(canvas_same(&c, &before));
    canvas_close(&c);
    canvas_close(&before);
}

TEST(clip, triangles_in_front_of_a_plane_count_as_clipped_not_culled) /* front-facing, big */
{
    static const shade_vec4 offsets[] = { { 5, 0, 0, 0 },  { -5, 0, 0, 0 }, { 0, 5, 0, 0 },
                                          { 0, -5, 0, 0 }, { 0, 0, 5, 0 },  { 0, 0, -5, 0 } };
    canvas c = canvas_ready(40, 30, 0, SHADE_FORMAT_RGBA8, 1);
    for (int i = 0; i < 6; i++) {
        shade_vec4 v[3];
        for (int k = 0; k < 3; k++) v[k] = shade_add4(clip_corners[k], offsets[i]);
        CHECK_INT(draw_clip_space(&c, v, 3, 0, NULL).clipped, 1);
    }
    shade_vec4 behind[3] = { { 0, 0, 0, -1 }, { 1, 0, 0, -2 }, { 0, 1, 0, -1 } };
    CHECK_INT(draw_clip_space(&c, behind, 3, 0, NULL).clipped, 1);
    canvas_close(&c);
}

TEST(clip, positions_that_are_no_numbers_are_rejected)
{
    static const uint32_t bad[] = { 0x7FC00000u, 0xFFC00000u, 0x7F800000u,
                                    0xFF800000u, 0x7F7FFFFFu, 0xFF7FFFFFu };
    canvas c = canvas_ready(40, 30, 0, SHADE_FORMAT_RGBA8, 1);
    canvas before = canvas_ready(40, 30, 0, SHADE_FORMAT_RGBA8, 1);
    for (int corner = 0; corner < 3; corner++)
        for (int field = 0; field < 4; field++)
            for (int k = 0; k < 8; k++) {
                shade_vec4 v[3];
                float f[4];
                memcpy(v, clip_corners, sizeof v);
                memcpy(f, &v[corner], sizeof f);
                f[field] = k == 6 ? 1.1e30f : k == 7 ? -1.1e30f : bits_float(bad[k]);
                memcpy(&v[corner], f, sizeof f);
                CHECK_INT(draw_clip_space(&c, v, 3, 0, NULL).rejected, 1);
            }
    CHECK(canvas_same(&c, &before));
    shade_vec4 v[3];
    memcpy(v, clip_corners, sizeof v);
    v[1].x = 9e29f; /* in range: clipped like any other */
    CHECK_INT(draw_clip_space(&c, v, 3, 0, NULL).rejected, 0);
    canvas_close(&c);
    canvas_close(&before);
}

TEST(clip, zero_area_counts_as_culled)
{
    canvas c = canvas_ready(40, 30, 0, SHADE_FORMAT_RGBA8, 1);
    shade_vec4 point[3] = { { 0.1f, 0.2f, 0, 1 }, { 0.1f, 0.2f, 0, 1 }, { 0.1f, 0.2f, 0, 1 } };
    shade_vec4 line[3] = { { -0.5f, 0, 0, 1 }, { 0.5f, 0, 0, 1 }, { 0, 0, 0, 1 } };
    shade_vec4 tiny[3] = { { 0, 0, 0, 1 },
                           { 1e-6f, 0, 0, 1 },
                           { 0, 1e-6f, 0, 1 } }; /* one point after snapping */
    CHECK_INT(draw_clip_space(&c, point, 3, 0, NULL).culled, 1);
    CHECK_INT(draw_clip_space(&c, line, 3, 0, NULL).culled, 1);
    CHECK_INT(draw_clip_space(&c, tiny, 3, 0, NULL).culled, 1);
    canvas_close(&c);
}

/* Draws one triangle on a cleared depth buffer and holds it to the exact half-planes of its visible
   part, and its depth to the plane through its corners.  Returns the number of pixels drawn. */
static int check_clipped(canvas *c, const shade_vec4 v[3], int zero_to_one)
{
    ref_triangle t;
    canvas_clear(c, 1);
    shade_stats stats = draw_clip_space(c, v, 3, zero_to_one, NULL);
    if (!ref_triangle_of(&t, &v[0], &v[1], &v[2], c->target.width, c->target.height)) return 0;
    int drawn = 0;
    for (int y = 0; y < c->target.height; y++)
        for (int x = 0; x < c->target.width; x++) {
            double X = x + 0.5, Y = y + 0.5;
            int want = ref_covers(&t, X, Y, CLIP_MARGIN, 1, zero_to_one),
                got = canvas_bytes(c, x, y)[3] != 0;
            drawn += got;
            if (want >= 0 && got != want) {
                CHECK_SAY(
                    0, "pixel %d %d: got %d, want %d; (%a %a %a %a) (%a %a %a %a) (%a %a %a %a)", x,
                    y, got, want, (double)v[0].x, (double)v[0].y, (double)v[0].z, (double)v[0].w,
                    (double)v[1].x, (double)v[1].y, (double)v[1].z, (double)v[1].w, (double)v[2].x,
                    (double)v[2].y, (double)v[2].z, (double)v[2].w);
            }
            if (!got) continue;
            double z = ref_depth(&t, X, Y, zero_to_one), zx = ref_depth(&t, X + 1, Y, zero_to_one);
            double slope = fabs(zx - z) + fabs(ref_depth(&t, X, Y + 1, zero_to_one) - z);
            CHECK_NEAR(canvas_depth(c, x, y), fmin(1, fmax(0, z)), 2e-6 + slope / 100);
        }
    CHECK_INT(stats.fragments, drawn);
    return drawn;
}

TEST(clip, near_and_far_cut_where_they_should)
{
    int drawn = 0, depths = 0;
    for (int i = 0; i < 1500; i++) {
        int zero_to_one = rnd_one_in(2);
        canvas c = canvas_open(rnd_int(1, 50), rnd_int(1, 50), 0, SHADE_FORMAT_RGBA8, 1);
        shade_vec4 v[3];
        random_eye_triangle(v, zero_to_one, 12);
        int pixels = check_clipped(&c, v, zero_to_one);
        drawn += pixels > 0;
        depths += pixels;
        canvas_close(&c);
    }
    CHECK_SAY(drawn > 300 && depths > 50000, "%d triangles, %d pixels", drawn, depths);
}

TEST(clip, corners_far_outside_the_guard_band_keep_their_edges)
{
    int drawn = 0;
    static const double reach[] = { 2.5, 3.5, 10, 100, 1e4, 1e6 };
    for (int i = 0; i < 1800; i++) {
        canvas c = canvas_open(rnd_int(20, 60), rnd_int(20, 60), 0, SHADE_FORMAT_RGBA8, 1);
        shade_vec4 v[3];
        double far_out = reach[i % 6];
        for (int k = 0; k < 3; k++) { /* one corner or two near the picture, the rest far out */
            double size = rnd_one_in(2) ? far_out : 1,
                   w = rnd_one_in(2) ? 1 : (double)rnd_log(0.5, 2);
            v[k] = shade_v4((float)((double)rnd_float(-size, size) * w),
                            (float)((double)rnd_float(-size, size) * w),
                            (float)((double)rnd_float(-0.9, 0.9) * w), (float)w);
        }
        drawn += check_clipped(&c, v, 0) > 0;
        canvas_close(&c);
    }
    CHECK_SAY(drawn > 400, "%d triangles", drawn);
}

TEST(clip, eye_space_far_to_the_sides_keeps_its_edges)
{
    int drawn = 0;
    for (int i = 0; i < 1000; i++) {
        canvas c = canvas_open(48, 36, 0, SHADE_FORMAT_RGBA8, 1);
        shade_vec4 v[3];
        random_eye_triangle(v, 0, i % 2 ? 60 : 1000);
        drawn += check_clipped(&c, v, 0) > 0;
        canvas_close(&c);
    }
    CHECK_SAY(drawn > 100, "%d triangles", drawn);
}

enum { CLIP_GRID = 12 };

/* Meshes from half as large again as the picture to 3000 times: within the guard band of 3 w, at
   its border, and far beyond, where triangles are cut. */
/* G8 */
TEST(clip, meshes_beyond_the_guard_band_cover_every_pixel_once)
{
    static shade_vec2 points[(CLIP_GRID + 1) * (CLIP_GRID + 1)];
    static shade_vec4 clip[(CLIP_GRID + 1) * (CLIP_GRID + 1)];
    static uint32_t indices[CLIP_GRID * CLIP_GRID * 6];
    int vertices = (CLIP_GRID + 1) * (CLIP_GRID + 1);
    static const double reach[] = { 1.5, 2.9, 5, 20, 100, 3000 };
    for (int round = 0; round < 120; round++) {
        int count = jittered_grid(CLIP_GRID, points, indices);
        double size = reach[round % 6], cx = (double)rnd_float(-0.4, 0.4),
               cy = (double)rnd_float(-0.4, 0.4);
        for (int i = 0; i < vertices; i++) {
            double w = round % 2 ? (double)rnd_log(0.2, 5) : 1;
            clip[i] =
                shade_v4((float)((2 * (double)points[i].x - 1 + cx * 0.1) * size * w),
                         (float)((2 * (double)points[i].y - 1 + cy * 0.1) * size * w), 0, (float)w);
        }
        canvas c = canvas_open(rnd_int(1, 90), rnd_int(1, 90), 0, SHADE_FORMAT_RGBA32F, 0);
        count_coverage(&c, clip, indices, count, vertices);
        for (int y = 0; y < c.target.height; y++)
            for (int x = 0; x < c.target.width; x++) CHECK_NEAR(canvas_float(&c, x, y, 0), 1, 0);
        canvas_close(&c);
    }
}

/* Places the points of [0, 1] x [0, 1] on a floor that reaches from behind the eye to beyond the
   far plane, rolled about the line of sight. */
static void random_floor(const shade_vec2 *points, int count, double width, shade_vec4 *clip)
{
    const double near_z = 0.25, far_z = 20;
    double roll = (double)rnd_float(-3.2, 3.2), drop = (double)rnd_log(0.3, 3);
    double tilt = (double)rnd_float(-0.1, 0.1);
    for (int i = 0; i < count; i++) {
        double x = (2 * (double)points[i].x - 1) * width, z = 10 - 40 * (double)points[i].y;
        double y = -drop + tilt * z;
        double ex = cos(roll) * x - sin(roll) * y, ey = sin(roll) * x + cos(roll) * y;
        double ez = -(far_z + near_z) / (far_z - near_z) * z -
                    2 * far_z * near_z / (far_z - near_z);
        clip[i] = shade_v4((float)ex, (float)ey, (float)ez, (float)-z);
    }
}

/* Whether a place of the picture is inside one of the two halves of a floor, for sure. */
static int in_floor(const ref_triangle half[2], double X, double Y, double margin)
{
    return ref_covers(&half[0], X, Y, margin, 1, 0) == 1 ||
           ref_covers(&half[1], X, Y, margin, 1, 0) == 1;
}

/* Whether a pixel's centre and the eight points a quarter of a pixel around it are inside. */
static int deep_in_floor(const ref_triangle half[2], int x, int y)
{
    if (!in_floor(half, x + 0.5, y + 0.5, -1e-9)) return 0;
    for (int k = 0; k < 9; k++) {
        double X = x + 0.5 + 0.25 * (k % 3 - 1), Y = y + 0.5 + 0.25 * (k / 3 - 1);
        if (!in_floor(half, X, Y, 0)) return 0;
    }
    return 1;
}

/* G8 */
TEST(clip, meshes_through_the_near_plane_cover_every_pixel_once)
{
    static shade_vec2 points[(CLIP_GRID + 1) * (CLIP_GRID + 1)];
    static shade_vec4 clip[(CLIP_GRID + 1) * (CLIP_GRID + 1)];
    static uint32_t indices[CLIP_GRID * CLIP_GRID * 6];
    int vertices = (CLIP_GRID + 1) * (CLIP_GRID + 1), inside = 0;
    for (int round = 0; round < 120; round++) {
        int count = jittered_grid(CLIP_GRID, points, indices);
        shade_vec4 corner[4];
        random_floor(points, vertices, round % 3 ? 15 : 200, clip);
        corner[0] = clip[0];
        corner[1] = clip[CLIP_GRID];
        corner[2] = clip[vertices - 1];
        corner[3] = clip[vertices - 1 - CLIP_GRID];
        ref_triangle half[2];
        int ok = ref_triangle_of(&half[0], &corner[0], &corner[1], &corner[2], 64, 48);
        ok &= ref_triangle_of(&half[1], &corner[0], &corner[2], &corner[3], 64, 48);
        CHECK(ok);
        canvas c = canvas_open(64, 48, 0, SHADE_FORMAT_RGBA32F, 0);
        count_coverage(&c, clip, indices, count, vertices);
        for (int k = 0; k < 64 * 48; k++) {
            int x = k % 64, y = k / 64;
            double got = (double)canvas_float(&c, x, y, 0);
            /* snapping may fold a sliver of the cut over its neighbour, at the border only */
            CHECK_SAY(got <= 2, "pixel %d %d is covered %g times", x, y, got);
            int a = ref_covers(&half[0], x + 0.5, y + 0.5, 0.25, 1, 0);
            int b = ref_covers(&half[1], x + 0.5, y + 0.5, 0.25, 1, 0);
            if (a == 0 && b == 0) CHECK_NEAR(got, 0, 0);
            if (!deep_in_floor(half, x, y)) continue;
            CHECK_NEAR(got, 1, 0);
            inside++;
        }
        canvas_close(&c);
    }
    CHECK_SAY(inside > 20000, "%d pixels inside", inside);
}

/* one facing and one index per triangle, whatever is cut off */
TEST(clip, facing_survives_the_cut)
{
    recorder r = recorder_open(20000);
    int tested = 0;
    for (int i = 0; i < 1500; i++) {
        shade_vec4 v[3];
        random_eye_triangle(v, 0, 15);
        ref_triangle t;
        if (!ref_triangle_of(&t, &v[0], &v[1], &v[2], 64, 48)) continue;
        canvas c = canvas_ready(64, 48, 0, SHADE_FORMAT_RGBA8, 0);
        r.count = 0;
        draw_clip_space(&c, v, 3, 0, &r);
        for (int k = 0; k < r.count; k++) {
            CHECK_INT(r.fragments[k].front, r.fragments[0].front);
            CHECK_INT(r.fragments[k].primitive, 0);
        }
        if (r.count > 20) { /* seen as the projective orientation says */
            CHECK_INT(r.fragments[0].front, t.front);
            tested++;
            scene s = { v, NULL, 0, NULL, NULL };
            shade_pipeline p = scene_pipeline(&s);
            shade_stats stats;
            p.raster.cull = t.front ? SHADE_CULL_BACK : SHADE_CULL_FRONT;
            stats = canvas_draw(&c, &p, 3);
            CHECK_INT(stats.fragments, r.count);
            p.raster.cull = t.front ? SHADE_CULL_FRONT : SHADE_CULL_BACK;
            stats = canvas_draw(&c, &p, 3);
            CHECK_INT(stats.fragments, 0);
            CHECK_INT(stats.culled, 1);
        }
        canvas_close(&c);
    }
    CHECK_SAY(tested > 200, "%d triangles", tested);
    free(r.fragments);
}

/* How much a value changes within 0.02 pixels: snapping moves corners by less. */
static double change_nearby(const ref_triangle *t, double X, double Y, const double v[3])
{
    double here = ref_interpolate(t, X, Y, v[0], v[1], v[2]), most = 0;
    for (int n = 0; n < 4; n++) {
        double x = X + (n < 2 ? 0.02 * (n * 2 - 1) : 0), y = Y + (n > 1 ? 0.02 * (n * 2 - 5) : 0);
        double moved = ref_interpolate(t, x, y, v[0], v[1], v[2]);
        most = fmax(most, fabs(moved - here));
    }
    return most;
}

TEST(clip, varyings_survive_the_cut) /* perspective to the plane, constant to the first corner */
{
    recorder r = recorder_open(20000);
    int tested = 0;
    for (int i = 0; i < 1500; i++) {
        shade_vec4 v[3];
        float attribute[6];
        random_eye_triangle(v, 0, i % 3 ? 15 : 200);
        for (int k = 0; k < 6; k++) attribute[k] = rnd_float(-1, 1);
        ref_triangle t;
        if (!ref_triangle_of(&t, &v[0], &v[1], &v[2], 48, 48)) continue;
        canvas c = canvas_open(48, 48, 0, SHADE_FORMAT_RGBA8, 0);
        scene s = { v, attribute, 2, NULL, &r };
        shade_pipeline p = scene_pipeline(&s);
        r.count = 0;
        canvas_draw(&c, &p, 3);
        for (int k = 0; k < r.count; k++) {
            double X = (double)r.fragments[k].x, Y = (double)r.fragments[k].y;
            for (int j = 0; j < 2; j++) {
                double value[3];
                for (int n = 0; n < 3; n++) value[n] = (double)attribute[2 * n + j];
                double want = ref_interpolate(&t, X, Y, value[0], value[1], value[2]);
                double slope = change_nearby(&t, X, Y, value);
                if (slope > 0.2) continue;
                CHECK_NEAR(r.fragments[k].in[j], want, 1e-4 + slope);
                tested++;
            }
        }
        p.interpolation = SHADE_INTERPOLATION_CONSTANT;
        r.count = 0;
        canvas_draw(&c, &p, 3);
        for (int k = 0; k < r.count; k++) {
            CHECK_NEAR(r.fragments[k].in[0], attribute[0], 0);
            CHECK_NEAR(r.fragments[k].in[1], attribute[1], 0);
        }
        canvas_close(&c);
    }
    CHECK_SAY(tested > 100000, "%d values", tested);
    free(r.fragments);
}

/* ------------------------------------------------------------------------ affine interpolation */

/* The linear function on the screen through three values at the places of clip-space corners. */
typedef struct screen_plane {
    double x, y, v, dx, dy; /* v at (x, y), and its slopes */
    double reach;           /* longest side squared over twice the area, pixels */
} screen_plane;

static screen_plane screen_plane_of(double clip[3][4], const double v[3], int width, int height)
{
    screen_plane p;
    double x[3], y[3], longest = 0;
    for (int k = 0; k < 3; k++) {
        x[k] = (clip[k][0] / clip[k][3] + 1) * width / 2;
        y[k] = (1 - clip[k][1] / clip[k][3]) * height / 2;
    }
    for (int k = 0; k < 3; k++) {
        double a = x[(k + 1) % 3] - x[k], b = y[(k + 1) % 3] - y[k];
        longest = fmax(longest, a * a + b * b);
    }
    double x1 = x[1] - x[0], y1 = y[1] - y[0], x2 = x[2] - x[0], y2 = y[2] - y[0];
    double area = x1 * y2 - x2 * y1, v1 = v[1] - v[0], v2 = v[2] - v[0];
    p.x = x[0];
    p.y = y[0];
    p.v = v[0];
    p.dx = (v1 * y2 - v2 * y1) / area;
    p.dy = (v2 * x1 - v1 * x2) / area;
    p.reach = longest / fabs(area);
    return p;
}

static double screen_plane_at(const screen_plane *p, double X, double Y)
{
    return p->v + p->dx * (X - p->x) + p->dy * (Y - p->y);
}

static void clip_doubles(const shade_vec4 v[3], double out[3][4])
{
    for (int k = 0; k < 3; k++) {
        out[k][0] = (double)v[k].x;
        out[k][1] = (double)v[k].y;
        out[k][2] = (double)v[k].z;
        out[k][3] = (double)v[k].w;
    }
}

static void draw_affine(canvas *c, const shade_vec4 v[3], const float value[3], int zero_to_one,
                        recorder *r)
{
    scene s = { v, value, 1, NULL, r };
    shade_pipeline p = scene_pipeline(&s);
    p.interpolation = SHADE_INTERPOLATION_AFFINE;
    p.raster.depth_zero_to_one = zero_to_one;
    p.fragment = scene_colors;
    if (r) r->count = 0;
    canvas_draw(c, &p, 3);
}

/* Cut by the guard band, by near, and by the guard band again, far out. */
TEST(clip, affine_is_linear_on_the_screen_in_three_examples)
{
    static const shade_vec4 apex[3] = { { 0, 16, 0, 4 }, { 0, 4, -8, 4 }, { 0, 4, 0, 0.1f } };
    static const double want[3] = { 23.5 / 160, 23.5 / 64, 23.5 / 1312 };
    static const float red[3] = { 0, 0, 1 };
    for (int k = 0; k < 3; k++) {
        canvas c = canvas_ready(64, 64, 0, SHADE_FORMAT_RGBA32F, 1);
        shade_vec4 v[3] = { { -1, -1, 0, 1 }, { 1, -1, 0, 1 } };
        v[2] = apex[k];
        draw_affine(&c, v, red, 0, NULL);
        CHECK_NEAR(canvas_float(&c, 32, 40, 0), want[k], 2e-6);
        canvas_close(&c);
    }
}

/* Snapping moves new corners as any others, their values with them; a slice of a cut polygon is
   steeper, in floats, than the triangle. */
TEST(clip, affine_is_linear_on_the_screen_whatever_is_cut)
{
    recorder r = recorder_open(20000);
    long tested[4] = { 0, 0, 0, 0 };
    for (int i = 0; i < 4000; i++) {
        int kind = i % 4, zero_to_one = rnd_one_in(2);
        canvas c = canvas_open(64, 48, 0, SHADE_FORMAT_RGBA8, 0);
        shade_vec4 v[3];
        float value[3];
        double clip[3][4], exact[3];
        random_cut_triangle(kind, zero_to_one, v);
        for (int k = 0; k < 3; k++) {
            value[k] = rnd_float(-1, 1);
            exact[k] = (double)value[k];
        }
        clip_doubles(v, clip);
        screen_plane p = screen_plane_of(clip, exact, 64, 48);
        draw_affine(&c, v, value, zero_to_one, &r);
        for (int k = 0; k < r.count && p.reach < 50; k++) {
            double want = screen_plane_at(&p, (double)r.fragments[k].x, (double)r.fragments[k].y);
            CHECK_NEAR(r.fragments[k].in[0], want, 1e-4 + hypot(p.dx, p.dy) / 256);
            tested[kind]++;
        }
        canvas_close(&c);
    }
    for (int kind = 0; kind < 4; kind++)
        CHECK_SAY(tested[kind] > 50000, "kind %d: %ld pixels", kind, tested[kind]);
    free(r.fragments);
}

/* Corner 0 before the eye, the other two at the eye or behind it, and beyond the near plane. */
static void random_corners_behind_the_eye(shade_vec4 v[3], float value[3])
{
    for (int k = 0; k < 3; k++) {
        double w = k ? -(double)rnd_log(1e-3, 5) : (double)rnd_log(0.2, 5);
        if (k && rnd_one_in(8)) w = 0;
        v[k] = shade_v4(rnd_float(-2, 2), rnd_float(-2, 2),
                        k ? (float)-w - rnd_log(0.1, 5) : rnd_float(-0.5, 0.5) * (float)w,
                        (float)w);
        value[k] = rnd_float(-1, 1);
    }
}

/* The part of such a triangle before the near plane: corner 0, and where its two edges leave, with
   their values.  Returns 1 where no plane but the near one cuts it. */
static int cut_at_corner_0(double clip[3][4], const float value[3], double cut[3][4],
                           double exact[3])
{
    int whole = 1;
    for (int k = 0; k < 3; k++) {
        double d0 = clip[0][2] + clip[0][3], dk = clip[k][2] + clip[k][3];
        double t = k ? d0 / (d0 - dk) : 0;
        for (int n = 0; n < 4; n++) cut[k][n] = clip[0][n] + t * (clip[k][n] - clip[0][n]);
        exact[k] = (double)value[0] + t * ((double)value[k] - (double)value[0]);
        whole &= fmax(fabs(cut[k][0]), fabs(cut[k][1])) < 2.9 * cut[k][3];
    }
    return whole;
}

/* A corner without a place on the screen: then new corners have the value of the perspective
   interpolation, a part t of the way in clip space.  Two such corners leave one triangle. */
TEST(clip, affine_behind_the_eye_is_linear_between_perspective_values)
{
    recorder r = recorder_open(20000);
    long tested = 0;
    for (int i = 0; i < 4000; i++) {
        canvas c = canvas_open(64, 48, 0, SHADE_FORMAT_RGBA8, 0);
        shade_vec4 v[3];
        float value[3];
        double clip[3][4], cut[3][4], exact[3];
        random_corners_behind_the_eye(v, value);
        clip_doubles(v, clip);
        int whole = cut_at_corner_0(clip, value, cut, exact);
        if (rnd_one_in(2)) { /* another first corner */
            shade_vec4 last = v[0];
            float last_value = value[0];
            v[0] = v[1];
            v[1] = v[2];
            v[2] = last;
            value[0] = value[1];
            value[1] = value[2];
            value[2] = last_value;
        }
        screen_plane p = screen_plane_of(cut, exact, 64, 48);
        draw_affine(&c, v, value, 0, &r);
        for (int k = 0; k < r.count && whole && p.reach < 50; k++) {
            double want = screen_plane_at(&p, (double)r.fragments[k].x, (double)r.fragments[k].y);
            CHECK_NEAR(r.fragments[k].in[0], want, 1e-4 + hypot(p.dx, p.dy) / 256);
            tested++;
        }
        canvas_close(&c);
    }
    CHECK_SAY(tested > 50000, "%ld pixels", tested);
    free(r.fragments);
}

/* What behind means on the screen has no exact answer without perspective, but no value can
   leave the range of the corners by more than rounding. */
TEST(clip, affine_behind_the_eye_stays_between_the_corners)
{
    recorder r = recorder_open(20000);
    long tested = 0;
    for (int i = 0; i < 3000; i++) {
        canvas c = canvas_open(48, 48, 0, SHADE_FORMAT_RGBA8, 0);
        int zero_to_one = rnd_one_in(2);
        float value[3], least = 1, most = -1;
        shade_vec4 v[3];
        random_eye_triangle(v, zero_to_one, i % 3 ? 15 : 200);
        if (rnd_one_in(6)) v[rnd_int(0, 2)].w = 0;
        for (int k = 0; k < 3; k++) {
            value[k] = rnd_float(-1, 1);
            least = value[k] < least ? value[k] : least;
            most = value[k] > most ? value[k] : most;
        }
        draw_affine(&c, v, value, zero_to_one, &r);
        for (int k = 0; k < r.count; k++) {
            float got = r.fragments[k].in[0];
            CHECK_SAY(got >= least - 1e-2f && got <= most + 1e-2f, "%g, of %g .. %g", (double)got,
                      (double)least, (double)most);
            tested++;
        }
        canvas_close(&c);
    }
    CHECK_SAY(tested > 100000, "%ld pixels", tested);
    free(r.fragments);
}

/* ----------------------------------------------------------------------------- any coordinates */

/* Corners of w = 1e30 beside ordinary ones: rounding dents the cut polygon, so that a further plane
   may leave and enter it more than once. */
TEST(clip, polygons_dented_by_rounding_are_survived)
{
    static const shade_vec4 bad[][3] = {
        { { -0x1.a354c2p+0f, 0x1.3217p-1f, -0x1.e92f0ap+0f, 0x1.5d00dp+0f },
          { 0x1p-149f, 0x1p+0f, 0x1.57858cp+0f, 0x1.93e594p+99f },
          { -0x1.291f3ap-1f, 0x1.f9d364p+0f, 0x1.4e9f3ap+0f, 0x1.76d1dep-112f } },
        { { 0x1.086ed8p-1f, -0x1.efbd4ap+0f, 0x1.a1e908p+0f, -0x1.60b97p+0f },
          { -0x1.027a9p-1f, 0x1p-126f, 0x1.7b76bp+0f, 0x1.93e594p+99f },
          { -0x1.1c7b72p+0f, 0x1.d575d8p-1f, -0x1p-149f, 0x1.75ebp+0f } },
        { { 0x1.70fd84p+3f, -0x1.25050ep-3f, 0x1.295a7ep-28f, -0x1.123968p-21f },
          { 0x1.887dacp-1f, 0x1.ebc29p-56f, -0x1.5ab74p-71f, 0x1.78e008p+93f },
          { -0x1.c527f4p-48f, 0x1.d983b6p-15f, -0x1.7b4f2ep-54f, 0x1.f5abd2p-51f } },
        { { 0x1.546426p-1f, 0x1.fd85e6p-5f, -0x1.2e7eb6p+0f, -0x1.0de7a2p-2f },
          { 0x1.74b1f4p+0f, -0x1.f2e9a8p-1f, -0x1.3cfddep+0f, 0x1.93e594p+99f },
          { 0x1.5cb7e6p-1f, -0x1.b98b2cp+0f, 0x1.0a2b5p+0f, 0x1.805886p-1f } },
        { { -2, 2, 2, -2 }, { 0, -2, 2, -2 }, { 2, -2, -2, 2 } }, /* through w = 0 at the origin */
    };
    canvas c = canvas_ready(33, 29, 35, SHADE_FORMAT_RGBA8, 1);
    for (size_t i = 0; i < sizeof bad / sizeof bad[0]; i++) draw_clip_space(&c, bad[i], 3, 0, NULL);
    for (int i = 0; i < 30000; i++) {
        shade_vec4 v[3];
        for (int k = 0; k < 3; k++) {
            v[k] = shade_v4(rnd_float(-2, 2), rnd_float(-2, 2), rnd_float(-2, 2), rnd_float(-2, 2));
        }
        v[rnd_int(0, 2)].w = rnd_one_in(2) ? 1e30f : rnd_log(1, 1e30);
        if (rnd_one_in(4)) v[rnd_int(0, 2)].x = rnd_nasty();
        draw_clip_space(&c, v, 3, i % 2, NULL);
    }
    canvas_close(&c);
}

/* stats add up, nothing outside the picture changes */
/* G1 */
TEST(clip, any_position_at_all_is_accounted_for)
{
    for (int i = 0; i < 3000; i++) {
        shade_vec4 v[30];
        canvas c = canvas_ready(rnd_int(1, 40), rnd_int(1, 40), 41, rnd_format(), rnd_int(0, 1));
        int kind = rnd_int(0, 3);
        for (int k = 0; k < 30; k++) {
            float f[4];
            for (int j = 0; j < 4; j++) {
                double size = kind == 1   ? (double)rnd_log(1e-30, 1e30)
                              : kind == 2 ? (double)rnd_log(1e-3, 1e3)
                                          : 2;
                f[j] = rnd_float(-size, size);
                if (kind == 0 && rnd_one_in(6)) f[j] = rnd_nasty();
                if (kind == 3) f[j] = (float)rnd_int(-2, 2);
            }
            v[k] = shade_v4(f[0], f[1], f[2], f[3]);
        }
        draw_clip_space(&c, v, 30, rnd_int(0, 1), NULL);
        canvas_close(&c);
    }
}

/* z in [-w, 0) is visible by default only */
TEST(clip, only_the_volume_decides_between_the_planes_of_zero_to_one)
{
    canvas c = canvas_ready(16, 16, 0, SHADE_FORMAT_RGBA8, 1);
    shade_vec4 v[3];
    memcpy(v, clip_corners, sizeof v);
    for (int k = 0; k < 3; k++) v[k].z = -0.5f;
    CHECK_INT(draw_clip_space(&c, v, 3, 0, NULL).fragments, 128);
    CHECK_NEAR(canvas_depth(&c, 8, 12), 0.25, 1e-7);
    CHECK_INT(draw_clip_space(&c, v, 3, 1, NULL).clipped, 1);
    for (int k = 0; k < 3; k++) v[k].z = 0.5f;
    canvas_clear(&c, 1);
    CHECK_INT(draw_clip_space(&c, v, 3, 1, NULL).fragments, 128);
    CHECK_NEAR(canvas_depth(&c, 8, 12), 0.5, 1e-7);
    for (int k = 0; k < 3; k++) v[k].z = -1; /* on the near plane itself: inside */
    canvas_clear(&c, 1);
    CHECK_INT(draw_clip_space(&c, v, 3, 0, NULL).fragments, 128);
    CHECK_NEAR(canvas_depth(&c, 8, 12), 0, 1e-7);
    canvas_close(&c);
}

/* Corners just before and just behind the near plane: the cut puts new corners within 1/256 pixel
   of old ones, where snapping dents the polygon.  Its pieces do not overlap; where snapping turns a
   corner over, at the cut alone, a pixel in 100,000 may be covered twice. */
/* G8 */
TEST(clip, dents_by_snapping_are_filled_without_overlap)
{
    enum { N = 4 };
    static shade_vec2 points[(N + 1) * (N + 1)];
    static shade_vec4 clip[(N + 1) * (N + 1)];
    static uint32_t indices[N * N * 6];
    int vertices = (N + 1) * (N + 1), twice = 0;
    long covered = 0;
    for (int round = 0; round < 20000; round++) {
        int count = jittered_grid(N, points, indices), size = rnd_int(6, 16);
        int64_t X[(N + 1) * (N + 1)], Y[(N + 1) * (N + 1)];
        for (int i = 0; i < vertices; i++) {
            double x = (double)points[i].x * size, y = (double)points[i].y * size, z;
            int inner = i / (N + 1) % N && i % (N + 1) % N;
            if (inner && rnd_one_in(3)) { /* on a centre */
                x = floor(x) + 0.5;
                y = floor(y) + 0.5;
            }
            X[i] = (int64_t)floor(x * 256 + 0.5);
            Y[i] = (int64_t)floor(y * 256 + 0.5);
            z = rnd_one_in(3) ? -1 + (double)(rnd_sign() * rnd_log(1e-5, 1e-1))
                              : (double)rnd_float(-2, 0.5);
            clip[i] = clip_of_fx8((double)X[i], (double)Y[i], size, size, z, 1);
        }
        if (!covers_square(X, Y, indices, count, (int64_t)size * 256)) continue;
        canvas c = canvas_open(size, size, 0, SHADE_FORMAT_RGBA32F, 0);
        count_coverage(&c, clip, indices, count, vertices);
        for (int k = 0; k < size * size; k++) {
            double got = (double)canvas_float(&c, k % size, k / size, 0);
            twice += got > 1;
            covered += got > 0;
        }
        canvas_close(&c);
    }
    CHECK_SAY(twice * 100000L < covered, "%d of %ld pixels", twice, covered);
    CHECK(covered > 1000000);
}

/* Slivers through the near plane, found among millions: snapping turns pieces of what is left of
   them, and those pieces hold a pixel centre of 64 x 64. */
TEST(clip, pieces_that_snapping_turns_are_left_out)
{
    static const shade_vec4 sliver[][3] = {
        { { 0x1.6988bep-5f, 0x1.9c0f4ap-4f, 0x1.1f08e4p-3f, 0x1.640a08p-3f },
          { -0x1.0b2268p-16f, 0x1.50b8c6p-12f, -0x1.3f75f8p-1f, 0x1.b36f76p-11f },
          { -0x1.7fb6dep-5f, -0x1.b4f9fep-4f, 0x1.bcadc2p-1f, -0x1.791eecp-3f } },
        { { 0x1.7087dp-9f, -0x1.1185fcp-9f, 0x1.481828p-2f, 0x1.0b89cap-11f },
          { 0x1.111dp-2f, -0x1.185c84p-3f, -0x1.b0155ap-1f, -0x1.d8c3fap-2f },
          { -0x1.87ad08p-2f, 0x1.97ee2p-3f, -0x1.4516f6p-1f, 0x1.596dc2p-1f } },
        { { 0x1.59aee4p-4f, 0x1.bc0d42p-2f, 0x1.067312p-1f, 0x1.4c12bp-1f },
          { 0x1.8a3a34p-12f, -0x1.b19f8p-13f, -0x1.db25p-4f, 0x1.5d7484p-15f },
          { 0x1.e1a698p-13f, 0x1.99a0dcp-13f, 0x1.b8f15cp-2f, 0x1.168ec6p-11f } },
    };
    recorder r = recorder_open(4096);
    for (int k = 0; k < TEST_COUNT(sliver); k++) {
        canvas c = canvas_ready(64, 64, 0, SHADE_FORMAT_RGBA8, 0);
        r.count = 0;
        draw_clip_space(&c, sliver[k], 3, 0, &r);
        CHECK(r.count > 0);
        for (int i = 1; i < r.count; i++) CHECK_INT(r.fragments[i].front, r.fragments[0].front);
        canvas_close(&c);
    }
    free(r.fragments);
}

/* What SHADE_INTERPOLATION_AFFINE gives at a point of the screen: with c from [x y w] c = (X, Y, 1)
   the screen's barycentric coordinates are c_i w_i, however far apart the w are. */
static double affine_at(const shade_vec4 v[3], const float *value, double X, double Y)
{
    double m[3][3], want[3] = { X, Y, 1 }, det, sum = 0;
    for (int k = 0; k < 3; k++) {
        m[0][k] = (double)v[k].x;
        m[1][k] = (double)v[k].y;
        m[2][k] = (double)v[k].w;
    }
    det = m[0][0] * (m[1][1] * m[2][2] - m[1][2] * m[2][1]) -
          m[0][1] * (m[1][0] * m[2][2] - m[1][2] * m[2][0]) +
          m[0][2] * (m[1][0] * m[2][1] - m[1][1] * m[2][0]);
    for (int k = 0; k < 3; k++) {
        int a = (k + 1) % 3, b = (k + 2) % 3;
        double c = want[0] * (m[1][a] * m[2][b] - m[1][b] * m[2][a]) -
                   want[1] * (m[0][a] * m[2][b] - m[0][b] * m[2][a]) +
                   want[2] * (m[0][a] * m[1][b] - m[0][b] * m[1][a]);
        sum += c / det * m[2][k] * (double)value[k];
    }
    return sum;
}

/* Two corners before the near plane, far and near, one behind it next to w = 0: the cut is reckoned
   from products of one sign, so that no digit is lost and nothing is divided by zero. */
TEST(clip, affine_values_survive_a_cut_between_any_two_w)
{
    enum { SIDE = 32 };
    int compared = 0;
    canvas c = canvas_open(SIDE, SIDE, 0, SHADE_FORMAT_RGBA32F, 0);
    for (int round = 0; round < 4000; round++) {
        shade_vec4 v[3];
        float value[3];
        double w = (double)rnd_log(1e-3, 1e12);
        shade_stats stats;
        int beyond = round % 2 ? 2 : 1; /* corners behind the plane */
        for (int k = 0; k < 3; k++) {
            double at = k < beyond ? (double)rnd_log(1e-28, 1e-2) * (w < 1 ? w : 1) : w;
            v[k].w = (float)at;
            v[k].x = (float)((double)rnd_float(-2, 2) * (at > w * 1e-6 ? at : w * 1e-6));
            v[k].y = (float)((double)rnd_float(-2, 2) * (at > w * 1e-6 ? at : w * 1e-6));
            v[k].z = (float)(k < beyond ? -(double)rnd_log(1.1, 1e4) * at : 0);
            value[k] = rnd_float(-1, 1);
        }
        scene s = { v, value, 1, NULL, NULL };
        shade_pipeline p = scene_pipeline(&s);
        p.fragment = scene_colors;
        p.interpolation = SHADE_INTERPOLATION_AFFINE;
        canvas_clear(&c, 1);
        stats = canvas_draw(&c, &p, 3);
        for (int i = 0; i < SIDE * SIDE; i++) {
            int x = i % SIDE, y = i / SIDE;
            float got = canvas_float(&c, x, y, 0);
            if (canvas_float(&c, x, y, 3) == 0) continue;
            CHECK_SAY(got - got == 0, "%g at %d, %d", (double)got, x, y);
            if (stats.fragments < 60) continue;
            double X = (x + 0.5) / (SIDE / 2) - 1, Y = 1 - (y + 0.5) / (SIDE / 2);
            double want = affine_at(v, value, X, Y), pixel = 2.0 / SIDE;
            double slope = fabs(affine_at(v, value, X + pixel, Y) - want) +
                           fabs(affine_at(v, value, X, Y + pixel) - want);
            CHECK_NEAR(got, want, 1e-4 + slope / 512); /* corners are snapped */
            compared++;
        }
    }
    CHECK_SAY(compared > 10000, "%d pixels", compared);
    canvas_close(&c);
}

/* Triangles of which snapping dents what the near plane leaves, behind a corner that lies on the
   centre of a pixel and is cut off: another corner begins the fan, and the centre stays outside. */
TEST(clip, a_dent_keeps_out_the_centre_that_is_cut_off)
{
    enum { SIDE = 8 };
    static const shade_vec4 dented[][3] = {
        { { 0.176757812f, 0.612304688f, -0.375946552f, 1 },
          { 0.125f, 0.125f, -1.00054812f, 1 },
          { -0.555664062f, -0.655273438f, -0.216137663f, 1 } },
        { { 0.758789062f, 0.120117188f, -0.719977498f, 1 },
          { -0.375f, 0.125f, -1.00022936f, 1 },
          { 0.122070312f, 0.509765625f, -0.259102821f, 1 } },
        { { 0.9296875f, 0.807617188f, -0.653490901f, 1 },
          { 0.875f, 0.375f, -1.0018363f, 1 },
          { 0.708007812f, -0.0888671875f, -0.195387617f, 1 } },
        { { -0.227539062f, -0.990234375f, -0.752052069f, 1 },
          { -0.875f, -0.875f, -1.00044608f, 1 },
          { -0.37109375f, -0.8671875f, -0.284014106f, 1 } },
    };
    for (int n = 0; n < (int)(sizeof dented / sizeof dented[0]); n++) {
        const shade_vec4 *v = dented[n];
        canvas c = canvas_ready(SIDE, SIDE, 0, SHADE_FORMAT_RGBA8, 0);
        draw_clip_space(&c, v, 3, 0, NULL);
        for (int i = 0; i < SIDE * SIDE; i++) {
            double X = (i % SIDE + 0.5) / (SIDE / 2) - 1, Y = 1 - (i / SIDE + 0.5) / (SIDE / 2);
            double area = 0, z = 0;
            int left = 0, right = 0;
            for (int k = 0; k < 3; k++) {
                const shade_vec4 a = v[(k + 1) % 3], b = v[(k + 2) % 3];
                double e = ((double)b.x - (double)a.x) * (Y - (double)a.y) -
                           ((double)b.y - (double)a.y) * (X - (double)a.x);
                area += e;
                z += e * (double)v[k].z;
                left += e > 0;
                right += e < 0;
            }
            int inside = !(left && right) && z / area > -1;
            CHECK_SAY(canvas_bytes(&c, i % SIDE, i / SIDE)[0] == 255 * inside,
                      "triangle %d, pixel %d, %d", n, i % SIDE, i / SIDE);
        }
        canvas_close(&c);
    }
}
