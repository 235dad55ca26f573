/* ray.c - rays through pixels, rays against triangles, and pictures drawn both ways. */
#include "unit.h"
#include "picked.h"

static ray_camera random_camera(int kind)
{
    ray_camera c = { 0 };
    c.width = rnd_int(1, 400);
    c.height = rnd_int(1, 300);
    d3 eye = d3_scale(rnd_direction(), (double)rnd_log(0.5, 10));
    c.view = shade_mat4_look_at(d3_round(eye), shade_v3(rnd_float(-0.2, 0.2), 0, 0),
                                d3_round(rnd_direction()));
    float n = rnd_log(0.1, 1), f = n * rnd_log(2, 50), x = rnd_float(-1, 1), y = rnd_float(-1, 1);
    float a = rnd_log(0.3, 1) * n, b = rnd_log(0.3, 1) * n;
    switch (kind) {
    case 0: c.projection = shade_mat4_perspective(rnd_float(0.2, 2.5), 1.3f, n, f); break;
    case 1:
        c.projection = shade_mat4_frustum(x * n - a, x * n + a, y * n - b, y * n + b, n, f);
        break;
    case 2:
        c.projection = shade_mat4_perspective_reversed(rnd_float(0.2, 2.5), 1.3f, n);
        c.reversed = 1;
        break;
    default:
        c.projection = shade_mat4_ortho(x - 2 * a, x + 2 * a, y - 2 * b, y + 2 * b, n, f);
        c.ortho = 1;
        break;
    }
    if (rnd_one_in(5)) c.view = shade_mat4_identity();
    return c;
}

static d3 ray_unproject(const ray_camera *c, double X, double Y, double z)
{
    dmat inverse;
    dmat_invert(dmat_mul(dmat_from(c->projection), dmat_from(c->view)), 4, &inverse);
    double in[4] = { 2 * X / c->width - 1, 1 - 2 * Y / c->height, z, 1 }, out[4];
    dmat_apply(inverse, in, out);
    return d3_of(out[0] / out[3], out[1] / out[3], out[2] / out[3]);
}

static d3 ray_eye(const ray_camera *c)
{
    dmat inverse;
    dmat_invert(dmat_from(c->view), 4, &inverse);
    return d3_of(inverse.m[0][3], inverse.m[1][3], inverse.m[2][3]);
}

/* Every point of the ray projects to the window point it was asked for. */
static void check_rays(int kind)
{
    for (int i = 0; i < 4000; i++) {
        ray_camera c = random_camera(kind);
        float x = rnd_float(0, c.width), y = rnd_float(0, c.height);
        if (rnd_one_in(3)) {
            x = (float)(int)x + 0.5f;
            y = (float)(int)y + 0.5f;
        }
        if (rnd_one_in(10)) {
            x = x * 3 - (float)c.width;
            y = y * 3 - (float)c.height;
        }
        shade_ray ray = shade_pixel_ray(c.view, c.projection, c.width, c.height, x, y);
        d3 origin, at = ray_unproject(&c, (double)x, (double)y, 0.5), eye = ray_eye(&c), d;
        d = c.ortho ? d3_sub(at, ray_unproject(&c, (double)x, (double)y, -1)) : d3_sub(at, eye);
        origin = c.ortho ? ray_unproject(&c, (double)x, (double)y, -1) : eye;
        d = d3_unit(d);
        CHECK_NEAR(d3_length(d3_from(ray.direction)), 1, 1e-6);
        CHECK_SAY(shape_off(ray.direction, d) < 1e-5, "camera %d: direction off by %g", kind,
                  shape_off(ray.direction, d));
        CHECK_SAY(shape_off(ray.origin, origin) < 1e-5 * (1 + d3_length(origin)),
                  "camera %d: origin off by %g of %g", kind, shape_off(ray.origin, origin),
                  d3_length(origin));
    }
}

TEST(ray, perspective_rays_leave_the_eye_through_the_pixel) { check_rays(0); }
TEST(ray, off_centre_frustums_bend_their_rays) { check_rays(1); }
TEST(ray, rays_of_an_infinite_reversed_projection_point_forward) { check_rays(2); }
TEST(ray, orthographic_rays_are_parallel_and_leave_the_near_plane) { check_rays(3); }

TEST(ray, the_middle_of_a_picture_is_straight_ahead)
{
    shade_mat4 p = shade_mat4_perspective(1, 2, 1, 10), one = shade_mat4_identity();
    shade_ray r = shade_pixel_ray(one, p, 20, 10, 10, 5);
    CHECK(shape_off(r.origin, d3_of(0, 0, 0)) < 1e-6);
    CHECK(shape_off(r.direction, d3_of(0, 0, -1)) < 1e-6);
    r = shade_pixel_ray(one, p, 20, 10, 20, 5);
    CHECK(r.direction.x > 0 && fabsf(r.direction.y) < 1e-6f); /* x right */
    r = shade_pixel_ray(one, p, 20, 10, 10, 0);
    CHECK(r.direction.y > 0 && fabsf(r.direction.x) < 1e-6f); /* row 0 on top */
    CHECK_NEAR(r.direction.y / -r.direction.z, tan(0.5), 1e-6);
    r = shade_pixel_ray(one, shade_mat4_ortho(-2, 2, -1, 1, 1, 10), 20, 10, 0, 10);
    CHECK(shape_off(r.origin, d3_of(-2, -1, -1)) < 1e-5);
    CHECK(shape_off(r.direction, d3_of(0, 0, -1)) < 1e-6);
}

TEST(ray, any_matrices_give_a_ray_without_a_crash)
{
    for (int i = 0; i < 3000; i++) {
        ray_camera c = random_camera(rnd_int(0, 3));
        float m[16];
        for (int n = rnd_int(1, 4); n > 0; n--) {
            shade_mat4 *spoiled = rnd_one_in(2) ? &c.view : &c.projection;
            memcpy(m, spoiled, sizeof m);
            m[rnd_int(0, 15)] = rnd_nasty();
            memcpy(spoiled, m, sizeof m);
        }
        if (rnd_one_in(10)) memset(&c.projection, 0, sizeof c.projection);
        shade_ray r = shade_pixel_ray(c.view, c.projection, rnd_int(-1, 3), rnd_int(-1, 3),
                                      rnd_nasty(), rnd_nasty());
        double length = d3_length(d3_from(r.direction));
        CHECK(finite3(r.origin) && (length == 0 || fabs(length - 1) < 1e-6));
    }
}

/* A ray through no camera has no direction, and meets nothing, whatever the view is. */
/* G3 */
TEST(ray, a_degenerate_camera_has_rays_without_direction)
{
    shade_vec3 p[3] = { { -9, -9, 0 }, { 9, -9, 0 }, { 0, 9, 0 } };
    shade_mesh m = plain_mesh(&p[0].x, 3);
    for (int i = 0; i < DEGENERATE_CAMERAS * 20; i++) {
        ray_camera c = random_camera(rnd_int(0, 3));
        float x = rnd_float(-9, c.width + 9), y = rnd_float(-9, c.height + 9), t = 7;
        shade_vec3 b = shade_v3(7, 7, 7);
        if (i % 4 == 1) c.view = shade_mat4_mul(c.projection, c.view);
        if (i % 4 == 2)
            for (int k = 0; k < 16; k++) (&c.view.col[0].x)[k] = rnd_float(-1, 1);
        shade_ray r = shade_pixel_ray(c.view, degenerate_camera(i / 20), c.width, c.height, x, y);
        CHECK_VEC(r.direction, d3_of(0, 0, 0), 0);
        CHECK(finite3(r.origin));
        CHECK_INT(shade_pick(&m, shade_mat4_identity(), r, &t, &b), -1);
        CHECK_INT(shade_intersect(r, p[0], p[1], p[2], &t, &b), 0);
        CHECK(t == 7 && b.x == 7 && b.y == 7 && b.z == 7);
    }
}

/* ------------------------------------------------------------------------------- intersections */

TEST(ray, a_triangle_is_met_where_the_plane_and_the_barycentrics_say)
{
    long hits = 0, misses = 0;
    for (int i = 0; i < 60000; i++) {
        double scale = (double)rnd_log(1e-3, 1e3), t = 0, b[3];
        shade_vec3 v[3], got_b;
        shade_ray ray;
        d3 p[3];
        float got_t;
        for (int k = 0; k < 3; k++) {
            v[k] = d3_round(d3_scale(rnd_direction(), scale));
            p[k] = d3_from(v[k]);
        }
        d3 o = d3_scale(rnd_direction(), scale * (double)rnd_log(0.1, 20));
        d3 aim = d3_add(p[0], d3_add(d3_scale(d3_sub(p[1], p[0]), rnd_unit()),
                                     d3_scale(d3_sub(p[2], p[0]), rnd_unit())));
        ray.origin = d3_round(o);
        ray.direction = d3_round(d3_scale(d3_unit(d3_sub(aim, o)), rnd_one_in(6) ? -1 : 1));
        int want = ref_intersect(&ray, p, &t, b);
        if (want < 0) continue;
        int got = shade_intersect(ray, v[0], v[1], v[2], &got_t, &got_b);
        CHECK_SAY(got == want, "got %d, t %g, barycentric %g %g %g", got, t, b[0], b[1], b[2]);
        CHECK_INT(shade_intersect(ray, v[0], v[1], v[2], NULL, NULL), got);
        CHECK_INT(shade_intersect(ray, v[2], v[1], v[0], NULL, NULL), got); /* either side */
        hits += want;
        misses += !want;
        if (!got || !want) continue;
        CHECK_NEAR(got_t, t, 2e-7 * t);
        CHECK_NEAR(got_b.x, b[0], 2e-7);
        CHECK_NEAR(got_b.y, b[1], 2e-7);
        CHECK_NEAR(got_b.z, b[2], 2e-7);
    }
    CHECK_SAY(hits > 10000 && misses > 10000, "%ld hits, %ld misses", hits, misses);
}

TEST(ray, corners_edges_and_the_origin_itself_belong_to_the_triangle)
{
    shade_vec3 a = shade_v3(0, 0, 0), b = shade_v3(4, 0, 0), c = shade_v3(0, 4, 0), bary;
    shade_ray r;
    float t;
    static const float at[7][2] = { { 0, 0 }, { 4, 0 }, { 0, 4 }, { 2, 0 }, { 0, 2 }, { 2, 2 },
                                    { 1, 1 } };
    r.direction = shade_v3(0, 0, -1);
    for (int k = 0; k < 7; k++)
        for (int z = 0; z < 3; z++) { /* from the plane itself too: t = 0 */
            r.origin = shade_v3(at[k][0], at[k][1], (float)z);
            CHECK_INT(shade_intersect(r, a, b, c, &t, &bary), 1);
            CHECK_NEAR(t, z, 0);
            CHECK_NEAR(bary.y, at[k][0] / 4, 0);
            CHECK_NEAR(bary.z, at[k][1] / 4, 0);
        }
    r.origin = shade_v3(1, 1, -1); /* behind */
    CHECK_INT(shade_intersect(r, a, b, c, NULL, NULL), 0);
    r.origin = shade_v3(1, 1, 5);
    r.direction = shade_v3(1, 0, 0); /* parallel */
    CHECK_INT(shade_intersect(r, a, b, c, NULL, NULL), 0);
    r.origin = shade_v3(-1, 1, 0); /* in the plane: no one point */
    CHECK_INT(shade_intersect(r, a, b, c, NULL, NULL), 0);
    r.direction = shade_v3(0, 0, -1);
    r.origin = shade_v3(1, 0, 1);
    CHECK_INT(shade_intersect(r, a, b, b, NULL, NULL), 0); /* no area */
    CHECK_INT(shade_intersect(r, a, a, a, NULL, NULL), 0);
}

/* Three points of one line have no area, wherever they lie: no ray meets them, not even one that
   aims at a point of theirs. */
TEST(ray, triangles_without_area_are_never_hit)
{
    for (int i = 0; i < 100000; i++) {
        int a[3], d[3], n[3] = { 0, 1, rnd_int(-3, 4) }; /* a + n d, exact */
        double unit = ldexp(1, rnd_int(-20, 20)), b[3];
        shade_vec3 v[3];
        shade_ray r;
        float t = 7;
        for (int k = 0; k < 3; k++) {
            a[k] = rnd_int(-1000, 1000);
            d[k] = rnd_int(-1000, 1000);
        }
        for (int k = 0; k < 3; k++)
            v[k] =
                shade_v3((float)((a[0] + n[k] * d[0]) * unit), (float)((a[1] + n[k] * d[1]) * unit),
                         (float)((a[2] + n[k] * d[2]) * unit));
        d3 o = d3_scale(rnd_direction(), 3000 * unit), at = d3_from(v[rnd_int(0, 2)]);
        double f = rnd_unit();
        if (rnd_one_in(2)) at = d3_add(d3_scale(d3_from(v[0]), f), d3_scale(d3_from(v[1]), 1 - f));
        r.origin = d3_round(o);
        r.direction = d3_round(d3_sub(at, d3_from(r.origin)));
        if (i % 3 == 0) {
            /* with an origin that is exact as well */
            r.origin = shade_v3((float)(rnd_int(-99, 99) * unit), 0, (float)(5 * unit));
            r.direction = shade_sub(v[rnd_int(0, 2)], r.origin);
        }
        int order = rnd_int(0, 2);
        CHECK_INT(shade_intersect(r, v[order], v[(order + 1) % 3], v[(order + 2) % 3], &t, NULL),
                  0);
        CHECK(t == 7);
        d3 p[3] = { d3_from(v[0]), d3_from(v[1]), d3_from(v[2]) };
        double exact;
        CHECK(ref_intersect(&r, p, &exact, b) <= 0);
    }
}

TEST(ray, corners_in_a_line_to_the_bit_are_never_hit)
{
    int rounded = 0;
    for (int i = 0; i < 100000; i++) {
        shade_vec3 p[3];
        shade_ray r;
        corners_in_a_line(p);
        const int a = rnd_int(0, 2), b = (a + 1) % 3, c = (a + 2) % 3;
        const d3 e = d3_sub(d3_from(p[b]), d3_from(p[a])), f = d3_sub(d3_from(p[c]), d3_from(p[a]));
        rounded += d3_length(d3_cross(e, f)) > 0;
        r.origin = random_vector(4);
        r.direction = shade_sub(shade_scale(p[rnd_int(0, 2)], rnd_float(0, 1)), r.origin);
        CHECK_INT(shade_intersect(r, p[a], p[b], p[c], NULL, NULL), 0);
        const shade_mesh m = plain_mesh(&p[0].x, 3);
        CHECK_INT(shade_pick(&m, shade_mat4_identity(), r, NULL, NULL), -1);
    }
    CHECK_SAY(rounded > 1000, "%d", rounded);
}

TEST(ray, rays_through_a_closed_ball_hit_it_whatever_edge_they_aim_at)
{
    /* Aimed at points of edges, a ray meets at least one of the two triangles in most cases, and
       never both far inside; aimed at the middle it meets exactly two. */
    for (int i = 0; i < 2000; i++) {
        shade_vec3 p[6];
        static const int face[8][3] = { { 0, 2, 4 }, { 2, 1, 4 }, { 1, 3, 4 }, { 3, 0, 4 },
                                        { 2, 0, 5 }, { 1, 2, 5 }, { 3, 1, 5 }, { 0, 3, 5 } };
        int hits = 0;
        for (int k = 0; k < 6; k++) {
            float q[3] = { 0, 0, 0 };
            q[k / 2] = k & 1 ? -1.0f : 1.0f;
            p[k] = shade_v3(q[0], q[1], q[2]);
        }
        d3 o = d3_scale(rnd_direction(), 5), aim = d3_scale(rnd_direction(), 0.2);
        shade_ray r = { d3_round(o), d3_round(d3_unit(d3_sub(aim, o))) };
        for (int k = 0; k < 8; k++) {
            hits += shade_intersect(r, p[face[k][0]], p[face[k][1]], p[face[k][2]], NULL, NULL);
        }
        CHECK_INT(hits, 2);
    }
}

TEST(ray, no_numbers_meet_nothing_or_something_finite)
{
    for (int i = 0; i < 20000; i++) {
        float f[15], t = 0;
        shade_vec3 v[5], b = shade_v3(0, 0, 0);
        for (int k = 0; k < 15; k++) f[k] = rnd_one_in(3) ? rnd_nasty() : rnd_float(-2, 2);
        memcpy(v, f, sizeof v);
        shade_ray r = { v[0], v[1] };
        if (shade_intersect(r, v[2], v[3], v[4], &t, &b)) {
            CHECK(t >= 0 && isfinite(t));
            CHECK_SAY(b.x >= 0 && b.y >= 0 && b.z >= 0 && b.x <= 1 && b.y <= 1 && b.z <= 1,
                      "%g %g %g", (double)b.x, (double)b.y, (double)b.z);
        } else CHECK_NEAR(t, 0, 0);
    }
}

/* -------------------------------------------------------------------------------------- picking */

/* How far rounding moves t.  The model moves corners by 2^-22 of the sums that it rounds, which
   are below 7 sizes, and no point of a triangle farther; seen at an angle a ray slides along. */
static double pick_rounding(const pick_scene *s, int triangle, const shade_ray *ray, double size)
{
    const d3 a = pick_corner(s, triangle, 0), b = pick_corner(s, triangle, 1);
    const d3 n = d3_unit(d3_cross(d3_sub(b, a), d3_sub(pick_corner(s, triangle, 2), a)));
    return 7 * size / 4194304 / fabs(d3_dot(n, d3_from(ray->direction)));
}

static void check_picks(int exact)
{
    static pick_scene s;
    long hits = 0, misses = 0;
    for (int i = 0; i < 400; i++) {
        double size = (double)rnd_log(1e-3, 1e3), margin = exact ? 1e-6 : 3e-4;
        random_pick_scene(&s, size);
        if (exact && rnd_one_in(2))
            s.model = shade_mat4_identity();
        else if (exact)
            memset(&s.model, 0, sizeof s.model);
        for (int n = 0; n < 25; n++) {
            d3 aim = d3_scale(rnd_direction(), size * rnd_unit());
            d3 o = d3_scale(rnd_direction(), size * (double)rnd_log(0.1, 5));
            shade_ray ray;
            ray.origin = d3_round(o);
            ray.direction = d3_round(d3_scale(d3_sub(aim, o), (double)rnd_log(0.01, 10) / size));
            double want_t, want_b[3] = { 0, 0, 0 };
            int want = ref_pick(&s, &ray, margin, &want_t, want_b);
            float t = -7;
            shade_vec3 b = shade_v3(-7, -7, -7);
            if (want == -2) continue;
            int got = shade_pick(&s.mesh, s.model, ray, &t, &b);
            CHECK_SAY(got == want, "got %d, want %d at %g", got, want, want_t);
            CHECK_INT(shade_pick(&s.mesh, s.model, ray, NULL, NULL), got);
            hits += want >= 0;
            misses += want < 0;
            if (want < 0) CHECK(t == -7 && b.x == -7 && b.y == -7 && b.z == -7);
            if (want < 0 || got != want) continue;
            double rounding = exact ? 0 : pick_rounding(&s, want, &ray, size);
            double near = exact ? 1e-6 : 30 * margin;
            CHECK_NEAR(t, want_t, 1e-6 * want_t + rounding);
            CHECK_VEC(b, d3_of(want_b[0], want_b[1], want_b[2]), near);
        }
    }
    CHECK_SAY(hits > 1000 && misses > 300, "%ld hits, %ld misses", hits, misses);
}

TEST(ray, pick_is_the_nearest_triangle_of_all) { check_picks(1); }
TEST(ray, pick_places_the_mesh_by_its_model) { check_picks(0); }

/* Equal triangles, whichever way round, and crossing ones met where they cross: the first. */
TEST(ray, of_triangles_met_at_one_place_the_first_is_picked)
{
    for (int i = 0; i < 2000; i++) {
        shade_vec3 p[24], near[3];
        int first = rnd_int(0, 7), count = 0;
        float z = (float)rnd_int(-4, 4), t;
        shade_mesh m = { 0 };
        for (int k = 0; k < 8; k++) { /* from first on, every other time at z, else behind */
            float at = k == first || (k > first && rnd_one_in(2)) ? z : z - (float)rnd_int(1, 3);
            near[0] = shade_v3(-8, -8, at);
            near[1] = shade_v3(8, -8, at);
            near[2] = shade_v3(0, 8, at);
            int turn = rnd_int(0, 2), back = rnd_int(0, 1);
            for (int n = 0; n < 3; n++) p[count++] = near[(turn + (back ? 3 - n : n)) % 3];
        }
        m.positions = &p[0].x;
        m.vertex_count = 24;
        shade_ray r = { { (float)rnd_int(-2, 2), (float)rnd_int(-2, 2), 16 }, { 0, 0, -0.5f } };
        CHECK_INT(shade_pick(&m, shade_mat4_identity(), r, &t, NULL), first);
        CHECK_NEAR(t, 2 * (16 - z), 0);
        /* from behind, the first of the lowest */
        r.origin.z = -16;
        r.direction.z = 2;
        int back = shade_pick(&m, shade_mat4_identity(), r, &t, NULL);
        CHECK(back >= 0);
        for (int k = 0; k < 8 && back >= 0; k++) {
            float lowest = p[3 * back].z;
            CHECK(k < back ? p[3 * k].z > lowest : p[3 * k].z >= lowest);
        }
    }
}

/* t counts directions as they are given. */
TEST(ray, the_length_of_a_direction_scales_t)
{
    static const float p[] = { -1, -1, 0, 1, -1, 0, 0, 1, 0 };
    shade_mesh m = plain_mesh(p, 3);
    for (int e = -60; e <= 60; e++) {
        float length = (float)ldexp(1, e), t;
        shade_ray r = { { 0, 0, 4 }, { 0, 0, -length } };
        CHECK_INT(shade_pick(&m, shade_mat4_identity(), r, &t, NULL), 0);
        CHECK_NEAR(t, 4 / (double)length, 0);
        r.direction.z = length;
        CHECK_INT(shade_pick(&m, shade_mat4_identity(), r, &t, NULL), -1);
    }
}

/* A ray down the z axis to a triangle at z = 0; bad_index: its indices are 0, 1, 3. */
typedef struct pick_call {
    const shade_mesh *mesh;
    shade_mesh m;
    shade_ray ray;
    int bad_index;
} pick_call;

static const float picked_triangle[] = { -1, -1, 0, 1, -1, 0, 0, 1, 0 };
static const uint32_t picked_indices[] = { 0, 1, 2 }, missed_indices[] = { 0, 1, 3 };

static pick_call open_pick_call(void)
{
    pick_call c = { NULL, plain_mesh(picked_triangle, 3), { { 0, 0, 4 }, { 0, 0, -1 } }, 0 };
    c.m.indices = picked_indices;
    c.m.index_count = 3;
    return c;
}

/* Picks; where nothing is found, neither distance nor weights are written. */
static void check_pick(int row, const shade_mesh *mesh, shade_mat4 model, shade_ray ray, int want)
{
    float t = 7;
    shade_vec3 b = shade_v3(7, 7, 7);
    int got = shade_pick(mesh, model, ray, &t, &b);
    CHECK_SAY(got == want, "row %d: got %d, want %d", row, got, want);
    if (want < 0) CHECK(t == 7 && b.x == 7 && b.y == 7 && b.z == 7);
}

#define PICK_FAULT(field, value) FAULT(pick_call, field, value)
#define PICK_NAN(field) FAULT_REAL(pick_call, field, NAN)
static const fault bad_picks[][FAULTS] = {
    { FAULT_NULL(pick_call, mesh) },
    { FAULT_NULL(pick_call, m.positions) },
    { FAULT_NULL(pick_call, m.positions), PICK_FAULT(m.vertex_count, 0),
      FAULT_NULL(pick_call, m.indices), PICK_FAULT(m.index_count, 0) }, /* a zeroed mesh */
    { PICK_FAULT(m.vertex_count, -1) },
    { PICK_FAULT(m.vertex_count, 2) },
    { FAULT_NULL(pick_call, m.indices), PICK_FAULT(m.vertex_count, 2) },
    { PICK_FAULT(m.index_count, -3) },
    { PICK_FAULT(m.index_count, 2) },
    { PICK_FAULT(m.index_count, 0) },
    { PICK_FAULT(bad_index, 1) },
    { PICK_FAULT(m.position_stride, -12) },
    { PICK_FAULT(m.position_stride, 13) },
    { PICK_FAULT(m.normal_stride, 5) },
    { FAULT_REAL(pick_call, ray.direction.z, 0) }, /* no direction */
    { PICK_NAN(ray.direction.x) },
    { PICK_NAN(ray.direction.z) },
    { PICK_NAN(ray.origin.y) },
    { FAULT_REAL(pick_call, ray.origin.z, -1) }, /* the triangle is behind */
};

TEST(ray, pick_finds_nothing_in_bad_meshes_and_on_bad_rays)
{
    pick_call good = open_pick_call();
    check_pick(-1, &good.m, shade_mat4_identity(), good.ray, 0);
    for (int row = 0; row < TEST_COUNT(bad_picks); row++) {
        pick_call bad = good;
        bad.mesh = &bad.m;
        spoil(&bad, bad_picks[row]);
        if (bad.bad_index) bad.m.indices = missed_indices;
        check_pick(row, bad.mesh, shade_mat4_identity(), bad.ray, -1);
    }
}

TEST(ray, pick_finds_nothing_where_points_or_the_matrix_are_not_finite_or_flat)
{
    pick_call c = open_pick_call();
    for (int k = 0; k < 9; k++) {
        float moved[9];
        c.m.positions = moved;
        memcpy(moved, picked_triangle, sizeof moved);
        moved[k] = (float)NAN;
        check_pick(k, &c.m, shade_mat4_identity(), c.ray, -1);
        moved[k] = INFINITY;
        check_pick(k, &c.m, shade_mat4_identity(), c.ray, -1);
    }
    c.m.positions = picked_triangle;
    for (int k = 0; k < 4; k++) {
        shade_mat4 model = shade_mat4_identity();
        model.col[k].y = (float)NAN;
        check_pick(k, &c.m, model, c.ray, -1);
    }
    /* seen edge-on; but a matrix of zeros is the identity */
    check_pick(0, &c.m, shade_mat4_scaling(shade_v3(1, 0, 1)), c.ray, -1);
    check_pick(0, &c.m, shade_mat4_scaling(shade_v3(0, 0, 0)), c.ray, -1);
    shade_mat4 zeros = { 0 };
    check_pick(0, &c.m, zeros, c.ray, 0);
}

/* One of two triangles has any bits for coordinates, the other is 4 before the ray's origin. */
TEST(ray, a_triangle_of_any_bits_hides_no_other_from_pick)
{
    pick_call c = open_pick_call();
    for (int i = 0; i < 5000; i++) {
        float v[18];
        for (int k = 0; k < 9; k++) {
            v[9 + k] = picked_triangle[k];
            v[k] = rnd_nasty();
        }
        shade_mesh m = plain_mesh(v, 6);
        float t = 0;
        int got = shade_pick(&m, shade_mat4_identity(), c.ray, &t, NULL);
        CHECK(got == 1 || (got == 0 && t <= 4));
        if (got == 1) CHECK_NEAR(t, 4, 0);
    }
}

/* Meshes with three points of a line, placed by any model: what is flat stays unhit. */
TEST(ray, pick_never_meets_a_triangle_without_area)
{
    for (int i = 0; i < 20000; i++) {
        static pick_scene s;
        shade_vec3 p[3];
        shade_ray r;
        int a[3], d[3], n = rnd_int(2, 5);
        for (int k = 0; k < 3; k++) {
            a[k] = rnd_int(-100, 100);
            d[k] = rnd_int(-100, 100);
        }
        for (int k = 0; k < 3; k++) {
            int at = k == 2 ? n : k;
            p[k] = shade_v3((float)(a[0] + at * d[0]), (float)(a[1] + at * d[1]),
                            (float)(a[2] + at * d[2]));
        }
        random_pick_scene(&s, 1);
        shade_mesh m = plain_mesh(&p[0].x, 3);
        d3 aim = dmat_point(matrix_or_identity(s.model), d3_from(p[rnd_int(0, 2)]));
        r.origin = random_vector(300);
        r.direction = d3_round(d3_sub(aim, d3_from(r.origin)));
        CHECK_INT(shade_pick(&m, s.model, r, NULL, NULL), -1);
    }
}

/* Whether two triangles have the same corners, perhaps in another order, so that rounding decides
   which is nearer. */
static int same_corners(const pick_scene *s, int a, int b)
{
    int shared = 0;
    if (a < 0 || b < 0 || !s->mesh.indices) return a == b;
    for (int k = 0; k < 9; k++) shared += s->index[3 * a + k / 3] == s->index[3 * b + k % 3];
    return shared == 3;
}

/* G10 */
TEST(ray, pick_says_what_is_drawn_at_every_pixel)
{
    enum { W = PICK_W, H = PICK_H };
    static pick_scene s;
    static picked_screen screen;
    long compared = 0, hits = 0;
    for (int i = 0; i < 60; i++) {
        canvas c = canvas_ready(W, H, 0, SHADE_FORMAT_RGBA32F, 1);
        shade_mat4 view = shade_mat4_look_at(d3_round(d3_scale(rnd_direction(), 12)),
                                             random_vector(0.5), d3_round(rnd_direction()));
        shade_mat4 projection = i % 3 ? shade_mat4_perspective(0.6f, (float)W / H, 1, 40)
                                      : shade_mat4_ortho(-4, 4, -3, 3, 1, 40);
        random_pick_scene(&s, 1.5);
        int moved = dmat_max(dmat_from(s.model)) > 0;
        shade_mat4 model = moved ? s.model : shade_mat4_identity();
        picked_screen_of(&screen, &s, shade_mat4_mul(shade_mat4_mul(projection, view), model));
        scene flat = { screen.clip, NULL, 0, NULL, NULL };
        shade_pipeline p = scene_pipeline(&flat);
        p.fragment = pick_ids;
        CHECK_INT(shade_draw(&c.target, &p, s.mesh.indices, 3 * screen.triangles, PICK_VERTICES,
                             NULL), SHADE_OK);
        for (int k = 0; k < W * H; k++) {
            double X = k % W + 0.5, Y = k / W + 0.5;
            if (!picked_for_sure(&screen, X, Y, 0)) continue;
            shade_ray ray = shade_pixel_ray(view, projection, W, H, (float)X, (float)Y);
            int drawn = (int)canvas_float(&c, k % W, k / W, 0) - 1;
            int got = shade_pick(&s.mesh, s.model, ray, NULL, NULL);
            CHECK_SAY(got == drawn || same_corners(&s, got, drawn),
                      "pixel %d %d: %d drawn, %d picked", k % W, k / W, drawn, got);
            compared++;
            hits += got >= 0;
        }
        canvas_close(&c);
    }
    CHECK_SAY(hits > 5000 && compared - hits > 5000, "%ld compared, %ld hits", compared, hits);
}

/* ------------------------------------------------------------------------------ drawn both ways */

/* Balls apart from each other, some of them cut by the near plane or the borders, and a floor */
static void random_ray_scene(ray_scene *s, int kind)
{
    memset(s, 0, sizeof *s);
    s->camera.width = RAY_WIDTH;
    s->camera.height = RAY_HEIGHT;
    s->camera.view = shade_mat4_look_at(shade_v3(rnd_float(-2, 2), rnd_float(1, 3), 5),
                                        shade_v3(rnd_float(-0.5, 0.5), 0, 0), shade_v3(0, 1, 0));
    float aspect = (float)RAY_WIDTH / RAY_HEIGHT;
    s->camera.projection = kind == 0   ? shade_mat4_perspective(0.9f, aspect, 2, 20)
                           : kind == 1 ? shade_mat4_frustum(-0.3f, 0.7f, -0.2f, 0.5f, 1, 20)
                           : kind == 2 ? shade_mat4_perspective_reversed(0.8f, aspect, 0.5f)
                                       : shade_mat4_ortho(-3, 3, -2, 2.5f, 1, 20);
    s->camera.ortho = kind == 3;
    s->camera.reversed = kind == 2;
    for (int k = 0; k < 4; k++) {
        d3 centre = d3_of(1.7 * (k % 2) - 0.8, 0.3 + 0.2 * rnd_unit(), 1.7 * (k / 2) - 0.8);
        ray_ball(s, centre, 0.4 + 0.3 * rnd_unit(), rnd_int(5, 9), rnd_int(3, 5));
    }
    d3 up[3] = { d3_of(0, 1, 0), d3_of(0, 1, 0), d3_of(0, 1, 0) };
    for (int k = 0; k < 8; k++) { /* a quarter each, in two */
        double x = k & 1 ? 6 : 0, z = k & 2 ? 6 : 0, y = -0.9;
        d3 a = d3_of(x - 6, y, z - 6), b = d3_of(x - 6, y, z), c = d3_of(x, y, z);
        d3 d = d3_of(x, y, z - 6), p[3] = { a, k & 4 ? c : b, k & 4 ? d : c };
        ray_triangle(s, p, up);
    }
    s->lights[0] = shade_directional_light(shade_v3(-0.5f, -1, -0.4f), shade_v3(0.7f, 0.7f, 0.6f));
    s->lights[1] = shade_point_light(shade_v3(2, 4, 3), shade_v3(0.3f, 0.3f, 0.4f));
    s->material.diffuse = shade_v3(0.8f, 0.8f, 0.8f);
    s->material.ambient = shade_v3(1, 1, 1);
    s->material.specular = shade_v3(0.3f, 0.3f, 0.3f);
    s->material.shininess = 10;
    s->mesh.positions = &s->position[0].x;
    s->mesh.normals = &s->normal[0].x;
    s->mesh.colors = &s->color[0].x;
    s->mesh.vertex_count = 3 * s->count;
    s->state.view = s->camera.view;
    s->state.projection = s->camera.projection;
    s->state.material = &s->material;
    s->state.lighting.lights = s->lights;
    s->state.lighting.light_count = 2;
    s->state.lighting.ambient = shade_v3(0.1f, 0.1f, 0.15f);
    if (kind == 2) {
        s->state.raster.depth_zero_to_one = 1;
        s->state.raster.depth_test = SHADE_COMPARE_GREATER;
    }
    shade_mat4 m = shade_mat4_mul(s->camera.projection, s->camera.view);
    for (int k = 0; k < 3 * s->count; k++) {
        shade_vec3 p = s->position[k];
        s->clip[k] = shade_mat4_transform(m, shade_v4(p.x, p.y, p.z, 1));
        s->id[k / 3] = shade_v4((float)(k / 3 + 1), 0, 0, 1);
    }
    for (int t = 0; t < s->count; t++) {
        if (!ref_triangle_of(&s->seen[t], &s->clip[3 * t], &s->clip[3 * t + 1],
                             &s->clip[3 * t + 2], RAY_WIDTH, RAY_HEIGHT))
            CHECK_SAY(0, "triangle %d has no area", t);
    }
}

/* The first triangle on the ray, -1: none.  With a projection through the eye a hit counts from
   the near plane on. */
static int ray_cast(const ray_scene *s, const shade_ray *ray, shade_vec3 *barycentric)
{
    int first = -1;
    float nearest = 0;
    dmat m = dmat_mul(dmat_from(s->camera.projection), dmat_from(s->camera.view));
    for (int t = 0; t < s->count; t++) {
        float at;
        shade_vec3 b;
        const shade_vec3 *p = &s->position[3 * t];
        if (!shade_intersect(*ray, p[0], p[1], p[2], &at, &b)) continue;
        if (first >= 0 && at >= nearest) continue;
        d3 hit = d3_add(d3_from(ray->origin), d3_scale(d3_from(ray->direction), (double)at));
        double in[4] = { hit.x, hit.y, hit.z, 1 }, clip[4];
        dmat_apply(m, in, clip);
        if (s->camera.reversed ? clip[2] > clip[3] : clip[2] < -clip[3]) continue;
        first = t;
        nearest = at;
        *barycentric = b;
    }
    return first;
}

static shade_vec3 ray_mix(const shade_vec3 *v, shade_vec3 b)
{
    return shade_madd(shade_madd(shade_scale(v[0], b.x), b.y, v[1]), b.z, v[2]);
}

static int near_an_edge(const ray_scene *s, double X, double Y)
{
    for (int t = 0; t < s->count; t++) {
        if (ref_covers(&s->seen[t], X, Y, 1 / 256.0, 1, s->camera.reversed) < 0) return 1;
    }
    return 0;
}

/* The stored levels of a channel of triangle t at a window point, least and greatest; with spread,
   at points 1/256 pixel to each side as well. */
static void ray_levels(const ray_scene *s, int t, double X, double Y, int channel, int spread,
                       double level[2])
{
    static const int side[5][2] = { { 0, 0 }, { -1, 0 }, { 1, 0 }, { 0, -1 }, { 0, 1 } };
    const shade_vec3 *p = &s->position[3 * t];
    level[0] = 255;
    level[1] = 0;
    for (int k = 0; k < (spread ? 5 : 1); k++) {
        shade_material m = s->material;
        shade_vec3 b;
        shade_ray ray = shade_pixel_ray(s->camera.view, s->camera.projection, RAY_WIDTH, RAY_HEIGHT,
                                        (float)(X + side[k][0] / 256.0),
                                        (float)(Y + side[k][1] / 256.0));
        if (!shade_intersect(ray, p[0], p[1], p[2], NULL, &b)) continue;
        shade_vec3 albedo = ray_mix(&s->color[3 * t], b);
        m.diffuse = shade_mul(m.diffuse, albedo);
        m.ambient = shade_mul(m.ambient, albedo);
        shade_vec3 c = shade_lit(&s->state.lighting, &m, d3_round(ray_eye(&s->camera)),
                                 ray_mix(p, b), ray_mix(&s->normal[3 * t], b));
        const float rgb[3] = { c.x, c.y, c.z };
        double v = floor(fmax(0, fmin(1, (double)rgb[channel])) * 255 + 0.5);
        level[0] = fmin(level[0], v);
        level[1] = fmax(level[1], v);
    }
}

static void check_both_ways(int kind)
{
    static ray_scene s;
    long compared = 0, hits = 0, close_by = 0;
    for (int i = 0; i < 3; i++) {
        canvas ids = canvas_open(RAY_WIDTH, RAY_HEIGHT, 0, SHADE_FORMAT_RGBA32F, 1);
        canvas lit = canvas_open(RAY_WIDTH, RAY_HEIGHT, 0, SHADE_FORMAT_RGBA8, 1);
        random_ray_scene(&s, kind);
        scene flat = { s.clip, NULL, 0, s.id, NULL };
        shade_pipeline p = scene_pipeline(&flat);
        float far = s.camera.reversed ? 0.0f : 1.0f;
        p.raster.depth_zero_to_one = s.state.raster.depth_zero_to_one;
        p.raster.depth_test = s.state.raster.depth_test;
        canvas_clear(&ids, far);
        canvas_clear(&lit, far);
        canvas_draw(&ids, &p, 3 * s.count);
        canvas_draw_mesh(&lit, &s.mesh, &s.state);
        for (int k = 0; k < RAY_WIDTH * RAY_HEIGHT; k++) {
            int x = k % RAY_WIDTH, y = k / RAY_WIDTH;
            if (near_an_edge(&s, x + 0.5, y + 0.5)) continue;
            shade_vec3 b = shade_v3(0, 0, 0);
            shade_ray ray = shade_pixel_ray(s.camera.view, s.camera.projection, RAY_WIDTH,
                                            RAY_HEIGHT, (float)x + 0.5f, (float)y + 0.5f);
            int cast = ray_cast(&s, &ray, &b), drawn = (int)canvas_float(&ids, x, y, 0) - 1;
            compared++;
            CHECK_SAY(cast == drawn, "pixel %d %d: triangle %d drawn, %d cast", x, y, drawn, cast);
            if (cast < 0 || cast != drawn) continue;
            hits++;
            for (int n = 0; n < 3; n++) {
                double got = canvas_bytes(&lit, x, y)[n], want[2];
                ray_levels(&s, cast, x + 0.5, y + 0.5, n, 0, want);
                close_by += fabs(got - want[0]) <= 1;
                /* corners snap by up to 1/512 pixel: on steep faces more than a level */
                if (fabs(got - want[0]) > 1)
                    ray_levels(&s, cast, x + 0.5, y + 0.5, n, 1, want);
                CHECK_SAY(got >= want[0] - 1 && got <= want[1] + 1,
                          "pixel %d %d: %g drawn, %g .. %g cast", x, y, got, want[0], want[1]);
            }
        }
        canvas_close(&ids);
        canvas_close(&lit);
    }
    CHECK_SAY(compared > 3 * RAY_WIDTH * RAY_HEIGHT * 8 / 10 && hits > 5000,
              "%ld compared, %ld hits", compared, hits);
    CHECK_SAY(close_by >= 3 * hits * 9995 / 10000, "%ld of %ld colours", close_by, 3 * hits);
}

/* G10 */
TEST(ray, cast_and_drawn_pictures_agree_in_perspective) { check_both_ways(0); }
/* G10 */
TEST(ray, cast_and_drawn_pictures_agree_off_centre) { check_both_ways(1); }
/* G10 */
TEST(ray, cast_and_drawn_pictures_agree_in_reversed_depth) { check_both_ways(2); }
/* G10 */
TEST(ray, cast_and_drawn_pictures_agree_without_perspective) { check_both_ways(3); }

/* w = 2 in the last column: everything at half its size */
TEST(ray, a_model_whose_w_is_two_is_picked_at_half_its_size)
{
    const float corner[9] = { -2, -2, 0, 2, -2, 0, 0, 2, 0 };
    shade_mat4 model = shade_mat4_identity();
    shade_mesh m = plain_mesh(corner, 3);
    model.col[3].w = 2;
    for (int k = -30; k <= 30; k++) {
        const shade_ray ray = { { 0, (float)k / 10 + 0.05f, 3 }, { 0, 0, -1 } };
        float t = 0;
        const int hit = shade_pick(&m, model, ray, &t, NULL);
        CHECK_INT(hit, k >= -10 && k < 10 ? 0 : -1);
        if (hit == 0) CHECK_NEAR(t, 3, 1e-6);
    }
}

/* Integers, so that the ray lies in the plane of the triangle exactly.  Products of them do not fit
   doubles, so that rounding alone decides whether shade_intersect meets it, and where. */
static shade_ray ray_in_plane_of(shade_vec3 corner[3])
{
    shade_vec3 u, v, p[5];
    shade_ray ray;
    u = shade_v3((float)rnd_int(-1000000, 1000000), (float)rnd_int(-1000000, 1000000), 700001);
    v = shade_v3((float)rnd_int(-1000000, 1000000), 500009, (float)rnd_int(-1000000, 1000000));
    for (int k = 0; k < 5; k++)
        p[k] = shade_madd(shade_scale(u, (float)rnd_int(-3, 3)), (float)rnd_int(-3, 3), v);
    for (int k = 0; k < 3; k++) corner[k] = p[k];
    ray.origin = p[3];
    ray.direction = shade_sub(p[4], p[3]);
    return ray;
}

/* How far a point is outside of the box of a triangle along one axis. */
static double beyond(double at, float a, float b, float c)
{
    return fmax((double)fminf(a, fminf(b, c)) - at, at - (double)fmaxf(a, fmaxf(b, c)));
}

TEST(ray, in_the_plane_of_a_triangle_a_ray_meets_it_in_its_box_or_not_at_all)
{
    int picked = 0, before = 0, behind = 0;
    for (int i = 0; i < 20000; i++) {
        shade_vec3 corner[3];
        const shade_ray ray = ray_in_plane_of(corner);
        const shade_mesh m = plain_mesh(&corner[0].x, 3);
        const d3 middle = d3_scale(d3_add(d3_from(corner[0]), d3_add(d3_from(corner[1]),
                                                                     d3_from(corner[2]))), 1 / 3.0);
        const d3 direction = d3_from(ray.direction), origin = d3_from(ray.origin);
        float t;
        if (!shade_intersect(ray, corner[0], corner[1], corner[2], &t, NULL)) continue;
        const d3 at = d3_add(origin, d3_scale(direction, (double)t));
        const double outside = fmax(beyond(at.x, corner[0].x, corner[1].x, corner[2].x),
                                    fmax(beyond(at.y, corner[0].y, corner[1].y, corner[2].y),
                                         beyond(at.z, corner[0].z, corner[1].z, corner[2].z)));
        if (fabs(outside) < 100) continue; /* within 1e-5 of its size */
        const int hit = shade_pick(&m, shade_mat4_identity(), ray, NULL, NULL);
        CHECK_INT(hit, outside < 0 ? 0 : -1);
        const int short_of_it = d3_dot(d3_sub(at, middle), direction) < 0;
        picked += hit == 0;
        before += hit < 0 && short_of_it;
        behind += hit < 0 && !short_of_it;
    }
    CHECK_SAY(picked > 300 && before > 300 && behind > 300,
              "%d picked, %d before, %d behind", picked, before, behind);
}

/* The box of a flat triangle has no depth, while a rotation rounds its corners by 2^-24 of how far
   they are: by 1/16 at 1e6. */
TEST(ray, a_flat_triangle_is_met_however_far_it_is)
{
    int met = 0;
    for (int i = 0; i < 5000; i++) {
        const int axis = rnd_int(0, 2);
        const shade_vec3 at = shade_scale(d3_round(rnd_direction()), rnd_log(1, 1e6));
        const shade_mat4 model = shade_mat4_rotation(rnd_float(-3, 3), d3_round(rnd_direction()));
        shade_vec3 corner[3], world[3];
        for (int k = 0; k < 3; k++) {
            corner[k] = shade_add(at, shade_scale(d3_round(rnd_direction()), rnd_float(1, 9)));
            corner[k] = with_axis(corner[k], axis, coordinate(at, axis));
            world[k] = shade_mat4_transform_point(model, corner[k]);
        }
        const shade_mesh m = plain_mesh(&corner[0].x, 3);
        const d3 side = d3_sub(d3_from(corner[1]), d3_from(corner[0]));
        const d3 other = d3_sub(d3_from(corner[2]), d3_from(corner[0]));
        if (d3_length(d3_cross(side, other)) == 0) continue; /* a line, which model may bend */
        const shade_vec3 sum = shade_add(world[0], shade_add(world[1], world[2]));
        const shade_ray ray = { { 0, 0, 0 }, shade_normalize(sum) };
        if (!shade_intersect(ray, world[0], world[1], world[2], NULL, NULL)) continue;
        CHECK_INT(shade_pick(&m, model, ray, NULL, NULL), 0);
        met++;
    }
    CHECK_SAY(met > 4000, "%d met", met);
}
