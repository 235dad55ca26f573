/* camera.c - cameras of every kind, split between view and projection in every way: rays, picks,
   boxes, fitted views. */
#include "unit.h"
#include "picked.h"

/* Cameras of every kind that a matrix can be.  with_depth is the projection, but where that has no
   depth: it then tells where points are that can be seen. */
typedef struct drawing_camera {
    shade_mat4 view, projection, with_depth;
    int zero_to_one, triangles;
} drawing_camera;

/* z = -w .. w becomes z = 0 .. w */
static shade_mat4 to_zero_to_one(shade_mat4 m)
{
    for (int k = 0; k < 4; k++) m.col[k].z = (m.col[k].z + m.col[k].w) / 2;
    return m;
}

static shade_mat4 scaled_entries(shade_mat4 m, float s)
{
    for (int k = 0; k < 4; k++) m.col[k] = shade_scale4(m.col[k], s);
    return m;
}

enum {
    DRAWS_ORTHO, DRAWS_ORTHO_ZERO_TO_ONE, DRAWS_NEAR_BEYOND_FAR, DRAWS_OBLIQUE, DRAWS_LEFT_HANDED,
    DRAWS_REVERSED, DRAWS_INFINITE, DRAWS_ONE_POINT, DRAWS_OFF_CENTRE, DRAWS_ZERO_TO_ONE,
    DRAWS_IDENTITY, DRAWS_KEYSTONE, DRAWS_ANY_MATRIX, DRAWS_SCALED, DRAWS_MIRRORED,
    DRAWS_WITHOUT_DEPTH, DRAWS_KINDS
};

static drawing_camera random_drawing_camera(int kind)
{
    drawing_camera c = { 0 };
    const float fovy = rnd_float(0.4, 1.5), k = rnd_sign() * rnd_log(1.2, 6);
    const float l = rnd_float(-1, 0.3), b = rnd_float(-1, 0.3);
    shade_mat4 p = shade_mat4_perspective(fovy, 4 / 3.0f, 1, 20), lens = shade_mat4_identity();
    const shade_mat4 box = shade_mat4_ortho(l * 5, l * 5 + 8, b * 5, b * 5 + 6, 1, 12);
    c.view = shade_mat4_look_at(d3_round(d3_scale(rnd_direction(), 6)), random_vector(1),
                                d3_round(rnd_direction()));
    c.triangles = PICK_VERTICES / 3;
    c.zero_to_one = kind == DRAWS_ORTHO_ZERO_TO_ONE || kind == DRAWS_INFINITE ||
                    kind == DRAWS_ZERO_TO_ONE;
    switch (kind) {
    case DRAWS_ORTHO: p = box; break;
    case DRAWS_ORTHO_ZERO_TO_ONE: p = to_zero_to_one(box); break;
    case DRAWS_NEAR_BEYOND_FAR: p = shade_mat4_ortho(-4, 4, -3, 3, 12, 1); break;
    case DRAWS_OBLIQUE: /* depth shears the picture */
        lens.col[2].x = rnd_float(-0.5, 0.5);
        lens.col[2].y = rnd_float(-0.5, 0.5);
        p = shade_mat4_mul(box, lens);
        break;
    case DRAWS_LEFT_HANDED: p = shade_mat4_mul(p, shade_mat4_scaling(shade_v3(1, 1, -1))); break;
    case DRAWS_REVERSED: p = shade_mat4_perspective(fovy, 4 / 3.0f, 20, 1); break;
    case DRAWS_INFINITE: p = shade_mat4_perspective_reversed(fovy, 4 / 3.0f, 1); break;
    case DRAWS_ONE_POINT: /* w = 1 - z/k: the eye is at z = k */
        p = shade_mat4_scaling(shade_v3(0.5f, 0.5f, rnd_sign()));
        p.col[2].w = -1 / k;
        if (rnd_one_in(2)) c.view = shade_mat4_identity();
        break;
    case DRAWS_OFF_CENTRE: p = shade_mat4_frustum(l, l + 1, b, b + 0.7f, 1, 20); break;
    case DRAWS_ZERO_TO_ONE: p = to_zero_to_one(p); break;
    case DRAWS_IDENTITY:
        p = c.view = lens;
        break;
    case DRAWS_KEYSTONE: /* w differs from ray to ray, not along them */
        lens.col[0].w = rnd_float(-0.4, 0.4);
        lens.col[1].w = rnd_float(-0.4, 0.4);
        p = shade_mat4_mul(lens, box);
        break;
    case DRAWS_ANY_MATRIX:
        p = random_mat4(1);
        break;
    case DRAWS_SCALED: p = scaled_entries(rnd_one_in(2) ? p : box, rnd_log(1e-9, 1e9)); break;
    case DRAWS_MIRRORED:
        c.view = shade_mat4_mul(shade_mat4_scaling(shade_v3(-1, rnd_float(0.5, 2), 1)), c.view);
        break;
    }
    c.projection = c.with_depth = p;
    if (kind == DRAWS_WITHOUT_DEPTH) {
        const float depth = rnd_float(-0.9, 0.9);
        for (int i = 0; i < 4; i++) c.projection.col[i].z = depth * p.col[i].w;
        c.triangles = 1; /* of two the first would be drawn */
    }
    return c;
}

/* Triangles at random places of the picture.  Returns 0 where the camera shows such a place behind
   the eye, or far away, or where the eye is so far away that floats place it too coarsely;
   *reversed tells whether the nearer of two points has the greater depth. */
static int triangles_in_sight(const drawing_camera *c, pick_scene *s, int *reversed)
{
    dmat world, m = dmat_mul(dmat_from(c->with_depth), dmat_from(c->view));
    double rw[2];    /* 1 / w, which is linear in depth, even where w passes through infinity */
    memset(s, 0, sizeof *s);
    if (fabs(dmat_invert(m, 4, &world)) < 1e-3 * pow(dmat_max(m), 4)) return 0;
    for (int k = 0; k < 2; k++) {
        const double in[4] = { 0, 0, k ? 0.9 : 0.1, 1 };
        double out[4];
        dmat_apply(world, in, out);
        rw[k] = out[3];
    }
    const double centre[4] = { 0, 0, 1, 0 };
    double eye[4];
    dmat_apply(world, centre, eye);
    const double away = d3_length(d3_of(eye[0], eye[1], eye[2])) / fabs(eye[3]);
    if (away > 1000 && away < 1e6) return 0;
    *reversed = rw[1] - rw[0] > 1e-6 * (fabs(rw[0]) + fabs(rw[1]));
    for (int k = 0; k < 3 * c->triangles; k++) {
        static double middle[2];
        double in[4] = { 0, 0, 0.9 * rnd_unit(), 1 }, out[4];
        if (k % 3 == 0)
            for (int i = 0; i < 2; i++) middle[i] = 2 * rnd_unit() - 1;
        for (int i = 0; i < 2; i++) in[i] = middle[i] + 1.2 * rnd_unit() - 0.6;
        in[2] = c->zero_to_one ? 0.05 + in[2] : 2 * in[2] - 0.9;
        dmat_apply(world, in, out);
        const d3 at = d3_scale(d3_of(out[0], out[1], out[2]), 1 / out[3]);
        if (!(out[3] > 0 && d3_length(at) < 100)) return 0;
        s->position[k] = d3_round(at);
    }
    s->mesh = plain_mesh(&s->position[0].x, 3 * c->triangles);
    return 1;
}

/* How a camera is split.  What is drawn with each split is the same but for rounding. */
enum {
    SPLIT_AS_MADE, SPLIT_ALL_IN_PROJECTION, SPLIT_ALL_IN_VIEW, SPLIT_RIGID, SPLIT_MIRRORED,
    SPLIT_ANYWHERE, SPLITS
};

static shade_mat4 dmat_round(dmat a)
{
    shade_mat4 m;
    for (int c = 0; c < 4; c++)
        m.col[c] = shade_v4((float)a.m[0][c], (float)a.m[1][c], (float)a.m[2][c], (float)a.m[3][c]);
    return m;
}

/* A turn and a move; or one that mirrors as well; or an invertible matrix of any kind. */
static dmat random_between(int split)
{
    dmat m, inverse;
    if (split == SPLIT_ANYWHERE) {
        do {
            for (int k = 0; k < 16; k++) m.m[k / 4][k % 4] = 2 * rnd_unit() - 1;
        } while (fabs(dmat_invert(m, 4, &inverse)) < 0.2);
        return m;
    }
    m = dmat_from(shade_mat4_look_at(random_vector(3), random_vector(3), random_vector(1)));
    for (int k = 0; split == SPLIT_MIRRORED && k < 4; k++) m.m[2][k] = -m.m[2][k];
    return m;
}

static void split_camera(int split, shade_mat4 *view, shade_mat4 *projection)
{
    const dmat p = dmat_from(*projection), v = dmat_from(*view);
    dmat between, inverse;
    if (split == SPLIT_AS_MADE) return;
    if (split == SPLIT_ALL_IN_PROJECTION || split == SPLIT_ALL_IN_VIEW) {
        *(split == SPLIT_ALL_IN_VIEW ? view : projection) = dmat_round(dmat_mul(p, v));
        *(split == SPLIT_ALL_IN_VIEW ? projection : view) = shade_mat4_identity();
        return;
    }
    between = random_between(split);
    dmat_invert(between, 4, &inverse);
    *projection = dmat_round(dmat_mul(p, between));
    *view = dmat_round(dmat_mul(inverse, v));
}

/* The place in world space that a camera shows at clip coordinates x, y, z / w. */
static d3 shown_at(dmat world_from_clip, double x, double y, double z)
{
    const double in[4] = { x, y, z, 1 };
    double out[4];
    dmat_apply(world_from_clip, in, out);
    return d3_scale(d3_of(out[0], out[1], out[2]), 1 / out[3]);
}

static double off_line(d3 origin, d3 direction, d3 point)
{
    return d3_length(d3_cross(d3_sub(point, origin), direction));
}

/* The ray of each split passes the places that its pixel shows, from near to far, and it starts
   where the ray of the camera as it was made does: at the eye, or at z = -w. */
/* G10 */
TEST(camera, rays_do_not_change_where_a_camera_is_split)
{
    long eyes = 0, parallel = 0;
    for (int i = 0; i < 1500 * DRAWS_KINDS; i++) {
        const int kind = i % DRAWS_KINDS, split = rnd_int(0, SPLITS - 1);
        const drawing_camera made = random_drawing_camera(kind);
        const float x = rnd_float(0, 400), y = rnd_float(0, 300);
        const double nx = (double)x / 200 - 1, ny = 1 - (double)y / 150;
        const dmat m = dmat_mul(dmat_from(made.with_depth), dmat_from(made.view));
        shade_mat4 view = made.view, projection = made.projection;
        dmat world;
        if (fabs(dmat_invert(m, 4, &world)) < 1e-3 * pow(dmat_max(m), 4)) continue;
        split_camera(split, &view, &projection);
        const shade_ray want = shade_pixel_ray(made.view, made.projection, 400, 300, x, y);
        const shade_ray got = shade_pixel_ray(view, projection, 400, 300, x, y);
        const d3 origin = d3_from(got.origin), direction = d3_from(got.direction);
        const d3 near = shown_at(world, nx, ny, 0.1), far = shown_at(world, nx, ny, 0.9);
        const double size = 1 + d3_length(near) + d3_length(far) + d3_length(origin);
        if (size > 100) continue; /* floats do not tell places apart so far away */
        CHECK_NEAR(d3_length(direction), 1, 1e-6);
        CHECK_SAY(off_line(origin, direction, near) < 2e-5 * size &&
                      off_line(origin, direction, far) < 2e-5 * size,
                  "camera %d, split %d: beside %g and %g of %g", kind, split,
                  off_line(origin, direction, near), off_line(origin, direction, far), size);
        CHECK_SAY(d3_dot(direction, d3_from(want.direction)) > 0.9999, "camera %d, split %d", kind,
                  split);
        CHECK_SAY(d3_length(d3_sub(origin, d3_from(want.origin))) < 1e-3 * size,
                  "camera %d, split %d: origin off by %g of %g", kind, split,
                  d3_length(d3_sub(origin, d3_from(want.origin))), size);
        const double w[4] = { origin.x, origin.y, origin.z, 1 };
        double clip[4];
        dmat_apply(dmat_mul(dmat_from(projection), dmat_from(view)), w, clip);
        eyes += fabs(clip[3]) < 1e-3 * dmat_max(m);
        parallel += fabs(clip[3]) >= 1e-3 * dmat_max(m);
    }
    CHECK_SAY(eyes > 5000 && parallel > 5000, "%ld with an eye, %ld without", eyes, parallel);
}

/* G10 */
TEST(camera, every_camera_that_draws_picks_what_it_draws)
{
    enum { W = PICK_W, H = PICK_H };
    static pick_scene s;
    static picked_screen screen;
    for (int kind = 0; kind < DRAWS_KINDS; kind++) {
        long hits = 0, misses = 0;
        for (int i = 0; i < test_rounds(kind == DRAWS_WITHOUT_DEPTH ? 24 : 4) * SPLITS;) {
            drawing_camera camera = random_drawing_camera(kind);
            const int split = i % SPLITS;
            int reversed = 0;
            if (!triangles_in_sight(&camera, &s, &reversed)) continue;
            i++;
            split_camera(split, &camera.view, &camera.projection);
            const shade_mat4 clip = shade_mat4_mul(camera.projection, camera.view);
            canvas c = canvas_open(W, H, 0, SHADE_FORMAT_RGBA32F, 1);
            shade_draw_state state = { 0 };
            state.fragment = pick_ids;
            state.raster.depth_zero_to_one = camera.zero_to_one;
            if (reversed) state.raster.depth_test = SHADE_COMPARE_GREATER;
            if (kind != DRAWS_IDENTITY || split > SPLIT_ALL_IN_VIEW) { /* else zeros stand for it */
                state.view = camera.view;
                state.projection = camera.projection;
            }
            canvas_clear(&c, reversed ? 0 : 1);
            canvas_draw_mesh(&c, &s.mesh, &state);
            picked_screen_of(&screen, &s, clip);
            screen.triangles = camera.triangles;
            for (int k = 0; k < W * H; k++) {
                const double X = k % W + 0.5, Y = k / W + 0.5;
                if (!picked_for_sure(&screen, X, Y, reversed)) continue;
                const shade_ray ray = shade_pixel_ray(camera.view, camera.projection, W, H,
                                                      (float)X, (float)Y);
                const int drawn = (int)canvas_float(&c, k % W, k / W, 0) - 1;
                const int got = shade_pick(&s.mesh, s.model, ray, NULL, NULL);
                CHECK_SAY(got == drawn, "camera %d, split %d, pixel %d %d: %d drawn, %d picked",
                          kind, split, k % W, k / W, drawn, got);
                hits += got >= 0;
                misses += got < 0;
            }
            canvas_close(&c);
        }
        CHECK_SAY(hits > 300 && misses > 300, "camera %d: %ld hits, %ld misses", kind, hits,
                  misses);
    }
}

/* Finite matrices of any size give finite rays, of length 1 or 0. */
/* G3 */
TEST(camera, finite_matrices_give_finite_rays)
{
    int units = 0;
    for (int i = 0; i < 300000; i++) {
        shade_mat4 m[2];
        const float most = rnd_log(1e-6, 1e6);
        for (int k = 0; k < 32; k++) {
            const float size = i % 3 == 0 ? rnd_log(1e-30, 1e6) : i % 3 == 1 ? most : 1e6f;
            float value = rnd_sign() * size * rnd_float(0, 1);
            if (rnd_one_in(3)) value = 0;
            ((float *)m)[k] = value;
        }
        const shade_ray r = shade_pixel_ray(m[0], m[1], 640, 480, rnd_float(0, 640),
                                            rnd_float(0, 480));
        const double length = d3_length(d3_from(r.direction));
        CHECK(finite3(r.origin) && finite3(r.direction));
        CHECK_SAY(length == 0 || fabs(length - 1) < 1e-6, "length %g", length);
        units += length > 0;
    }
    CHECK_SAY(units > 100000, "%d", units);
}

/* A box with a place that a camera shows is seen, in whichever matrix the camera stands; one beside
   the picture is not. */
TEST(camera, boxes_are_seen_in_every_split)
{
    shade_target t = { 400, 300, 0, SHADE_FORMAT_RGBA8, NULL, NULL, 0, 0, 0, 0, 0, 0, 0, 0 };
    float depth = 0;
    long inside = 0, outside = 0;
    t.depth = &depth; /* it is not read */
    for (int i = 0; i < 20000; i++) {
        const int kind = rnd_int(0, DRAWS_KINDS - 1), beside = rnd_one_in(2);
        const drawing_camera made = random_drawing_camera(kind);
        const dmat m = dmat_mul(dmat_from(made.with_depth), dmat_from(made.view));
        const float half = 1e-3f;
        shade_mat4 view = made.view, projection = made.projection;
        dmat world;
        if (fabs(dmat_invert(m, 4, &world)) < 1e-3 * pow(dmat_max(m), 4)) continue;
        const double x = beside ? 1.5 : 1.8 * rnd_unit() - 0.9;
        const d3 at = shown_at(world, x, 1.8 * rnd_unit() - 0.9, 0.1 + 0.8 * rnd_unit());
        const double in[4] = { at.x, at.y, at.z, 1 };
        double clip[4];
        dmat_apply(m, in, clip);
        if (clip[3] < 0.1 * dmat_max(m) || d3_length(at) > 30) continue;
        split_camera(rnd_int(0, SPLITS - 1), &view, &projection);
        const shade_vec3 p = d3_round(at), edge = shade_v3(half, half, half);
        const int seen = shade_box_visible(&t, shade_mat4_mul(projection, view), made.zero_to_one,
                                           shade_sub(p, edge), shade_add(p, edge));
        CHECK_SAY(seen == !beside, "camera %d", kind);
        inside += seen;
        outside += !seen;
    }
    CHECK_SAY(inside > 2000 && outside > 2000, "%ld, %ld", inside, outside);
}

/* projection times a motion: the fitted view undoes the motion, and what it shows stays. */
TEST(camera, fits_do_not_change_with_a_motion_in_the_projection)
{
    for (int i = 0; i < 5000; i++) {
        const shade_mat4 p = random_lens();
        const dmat motion = random_between(SPLIT_RIGID);
        const shade_mat4 moved = dmat_round(dmat_mul(dmat_from(p), motion));
        const shade_vec3 side = random_vector(1), up = random_vector(1);
        const shade_vec3 low = random_vector(5), high = shade_add(low, shade_v3(1, 2, 0.5f));
        if (d3_length(d3_cross(d3_unit(d3_from(side)), d3_unit(d3_from(up)))) < 0.1) continue;
        const dmat want = dmat_mul(dmat_from(p), dmat_from(shade_mat4_fit(p, low, high, side, up)));
        const dmat got = dmat_mul(dmat_from(moved),
                                  dmat_from(shade_mat4_fit(moved, low, high, side, up)));
        for (int k = 0; k < 8; k++) {
            const double in[4] = { (double)(k & 1 ? low : high).x, (double)(k & 2 ? low : high).y,
                                   (double)(k & 4 ? low : high).z, 1 };
            double a[4], b[4];
            dmat_apply(want, in, a);
            dmat_apply(got, in, b);
            CHECK_NEAR(b[0] / b[3], a[0] / a[3], 1e-3);
            CHECK_NEAR(b[1] / b[3], a[1] / a[3], 1e-3);
        }
    }
}

/* A ball in sight, and one mistake of ten: what is said does not depend on the split, unless
   state.view itself is blamed for what it holds. */
TEST(camera, what_is_explained_does_not_change_where_a_camera_is_split)
{
    static const char *const of_view[] = { "state.view holds a projection", "last row",
                                           "transposed", "state.view scales",
                                           "inverse of state.view" };
    const shade_light lamp = shade_directional_light(shade_v3(-1, -1, -2), shade_v3(1, 1, 1));
    const shade_light behind = shade_directional_light(shade_v3(0, 0, 1), shade_v3(1, 1, 1));
    static ray_scene s;
    int said_something = 0;
    memset(&s, 0, sizeof s);
    ray_ball(&s, d3_of(0, 0, 0), 1, 12, 8);
    for (int i = 0; i < test_rounds(120); i++) {
        const int mistake = i % 10, split = 1 + i / 10 % (SPLITS - 1);
        const float n = mistake == 1 ? 9 : 0.5f, f = mistake == 2 ? 1.5f : 40;
        shade_mat4 view = shade_mat4_look_at(shade_v3(rnd_float(-1, 1), rnd_float(-1, 1), 5),
                                             shade_v3(0, 0, mistake == 3 ? 9.0f : 0),
                                             shade_v3(0, 1, 0));
        shade_mat4 projection = i / 50 % 2 ? shade_mat4_perspective(0.8f, 4 / 3.0f, n, f)
                                           : shade_mat4_frustum(-0.5f * n, 0.3f * n, -0.3f * n,
                                                                0.3f * n, n, f);
        shade_mesh mesh = plain_mesh(&s.position[0].x, 3 * s.count);
        const char *said[2];
        for (int k = 0; k < 2; k++) {
            canvas c = canvas_ready(40, 30, 0, SHADE_FORMAT_RGBA8, mistake != 5);
            shade_draw_state state = { 0 };
            shade_stats stats;
            state.lighting.lights = mistake == 6 ? &behind : &lamp;
            state.lighting.light_count = mistake != 7;
            state.raster.cull = mistake == 4 ? SHADE_CULL_FRONT : SHADE_CULL_BACK;
            state.raster.depth_test = mistake == 8 ? SHADE_COMPARE_GREATER : SHADE_COMPARE_LESS;
            if (k) split_camera(split, &view, &projection);
            state.view = view;
            state.projection = projection;
            mesh.normals = mistake == 9 ? &s.position[0].x : NULL;
            CHECK_INT(shade_draw_mesh(&c.target, &mesh, &state, &stats), SHADE_OK);
            said[k] = shade_explain(&c.target, &mesh, &state, &stats);
            canvas_close(&c);
        }
        int blamed = 0;
        for (int k = 0; k < TEST_COUNT(of_view); k++) blamed |= strstr(said[1], of_view[k]) != NULL;
        said_something += !blamed && *said[1];
        CHECK_SAY(!strcmp(said[0], said[1]) || blamed, "mistake %d, split %d: \"%s\" and \"%s\"",
                  mistake, split, said[0], said[1]);
        CHECK(!blamed || split != SPLIT_ALL_IN_PROJECTION);
    }
    CHECK_SAY(said_something > test_rounds(40), "%d", said_something);
}

/* A shiny ball before a camera that is split: explained where the eye of view is another one, and
   silent with the camera in view, or without highlights. */
TEST(camera, highlights_of_another_eye_are_explained)
{
    const shade_light lamp = shade_directional_light(shade_v3(-0.2f, -0.3f, -2), shade_v3(1, 1, 1));
    static ray_scene s;
    memset(&s, 0, sizeof s);
    ray_ball(&s, d3_of(0, 0, 0), 1, 24, 16);
    for (int i = 0; i < test_rounds(48); i++) {
        const int infinite = i & 1, astray = i >> 1 & 1, shiny = i % 3 != 0;
        const shade_material gold = { { 0, 0, 0 }, { 0, 0, 0 }, { 0.5f, 0.4f, 0.1f },
                                      { 0.5f * (float)shiny, 0, 0 }, 8 };
        const dmat turn = dmat_from(shade_mat4_look_at(random_vector(3), random_vector(1),
                                                       random_vector(1)));
        canvas c = canvas_ready(40, 30, 0, SHADE_FORMAT_RGBA8, 1);
        shade_mesh mesh = plain_mesh(&s.position[0].x, 3 * s.count);
        shade_draw_state state = { 0 };
        shade_stats stats;
        dmat between = turn, inverse;
        if (infinite) /* a left-handed camera */
            between = dmat_from(shade_mat4_scaling(shade_v3(1, 1, -1)));
        dmat_invert(between, 4, &inverse);
        state.view = shade_mat4_look_at(shade_v3(0, 0, 5), shade_v3(0, 0, 0), shade_v3(0, 1, 0));
        state.projection = shade_mat4_perspective(0.6f, 4 / 3.0f, 1, 20);
        if (astray) {
            state.projection = dmat_round(dmat_mul(dmat_from(state.projection), between));
            state.view = dmat_round(dmat_mul(inverse, dmat_from(state.view)));
        }
        mesh.normals = &s.normal[0].x;
        state.material = &gold;
        state.lighting.lights = &lamp;
        state.lighting.light_count = 1;
        if (infinite) state.lighting.flags = SHADE_FLAG_INFINITE_VIEWER;
        CHECK_INT(shade_draw_mesh(&c.target, &mesh, &state, &stats), SHADE_OK);
        const char *said = shade_explain(&c.target, &mesh, &state, &stats);
        CHECK_SAY(astray && shiny ? strstr(said, "another eye") != NULL : !*said, "%d: \"%s\"", i,
                  said);
        canvas_close(&c);
    }
}
