/* vertex.c - which vertices are shaded, how often, and with what around them. */
#include "unit.h"

/* n x n squares over the whole picture, two triangles each, vertices in rows; returns the number of
   indices */
static int grid_of(int n, shade_vec4 *clip, uint32_t *indices)
{
    int count = 0;
    for (int y = 0; y <= n; y++)
        for (int x = 0; x <= n; x++) {
            clip[y * (n + 1) + x] =
                shade_v4((float)(2.0 * x / n - 1), (float)(2.0 * y / n - 1), 0, 1);
        }
    for (int y = 0; y < n; y++) {
        for (int x = 0; x < n; x++) {
            uint32_t a = (uint32_t)(y * (n + 1) + x), b = a + 1, c = a + (uint32_t)n + 1, d = c + 1;
            indices[count++] = a;
            indices[count++] = b;
            indices[count++] = d;
            indices[count++] = a;
            indices[count++] = d;
            indices[count++] = c;
        }
    }
    return count;
}

/* Rows longer than a batch meet their vertices twice: once from above, once from below.  Batches of
   small packets hold a few squares, and of 8 lanes one triangle or two. */
TEST(vertex, vertices_of_a_grid_are_shaded_once_per_batch)
{
    static shade_vec4 clip[101 * 101];
    static uint32_t indices[100 * 100 * 6];
    static unsigned char seen[101 * 101];
    static const int sizes[] = { 1, 3, 10, 30, 64, 100 };
    for (int k = 0; k < 6; k++) {
        int n = sizes[k], vertices = (n + 1) * (n + 1), count = grid_of(n, clip, indices);
        canvas c = canvas_ready(64, 64, 0, SHADE_FORMAT_RGBA8, 1);
        recorder r = { 0 };
        memset(seen, 0, sizeof seen);
        r.vertex_seen = seen;
        scene s = { clip, NULL, 0, NULL, &r };
        shade_pipeline p = scene_pipeline(&s);
        shade_stats stats;
        CHECK_INT(shade_draw(&c.target, &p, indices, count, vertices, &stats), SHADE_OK);
        int most = (n <= 10 ? vertices + vertices / 4 : vertices * 21 / 10) + 2;
        if (SHADE_LANES < 128) most = SHADE_LANES < 64 ? count : vertices * 22 / 10 + 2;
        CHECK_SAY(r.vertex_lanes >= vertices && r.vertex_lanes <= most, "%ld lanes for %d vertices",
                  r.vertex_lanes, vertices);
        for (int i = 0; i < vertices; i++) CHECK(seen[i]);
        CHECK_INT(r.bad_counts, 0);
        CHECK_INT(r.bad_tails, 0);
        CHECK_INT(stats.drawn, count / 3);
        CHECK_INT(stats.fragments, 64 * 64);
        canvas_close(&c);
    }
}

/* Counts from one triangle to many batches of 128 vertices, most of them no multiples of a
   batch. */
TEST(vertex, without_indices_each_vertex_is_shaded_once_in_order)
{
    static shade_vec4 clip[3000];
    static unsigned char seen[3000];
    for (int i = 0; i < 3000; i++) clip[i] = clip_corners[i % 3];
    for (int count = 3; count <= 3000; count += 333) {
        recorder r = { 0 };
        memset(seen, 0, sizeof seen);
        r.vertex_seen = seen;
        canvas c = canvas_open(16, 16, 0, SHADE_FORMAT_RGBA8, 0);
        scene s = { clip, NULL, 0, NULL, &r };
        shade_pipeline p = scene_pipeline(&s);
        canvas_draw(&c, &p, count);
        CHECK_INT(r.vertex_lanes, count);
        for (int i = 0; i < 3000; i++) CHECK_INT(seen[i], i < count);
        CHECK_INT(r.bad_tails + r.bad_counts, 0);
        canvas_close(&c);
    }
}

TEST(vertex, only_referenced_vertices_are_shaded)
{
    static shade_vec4 clip[1000];
    static unsigned char seen[1000], wanted[1000];
    for (int round = 0; round < 50; round++) {
        uint32_t indices[300];
        memset(seen, 0, sizeof seen);
        memset(wanted, 0, sizeof wanted);
        for (int i = 0; i < 1000; i++) clip[i] = clip_corners[rnd_int(0, 2)];
        for (int i = 0; i < 300; i++) wanted[indices[i] = (uint32_t)rnd_int(0, 999)] = 1;
        recorder r = { .vertex_seen = seen };
        canvas c = canvas_open(8, 8, 0, SHADE_FORMAT_RGBA8, 0);
        scene s = { clip, NULL, 0, NULL, &r };
        shade_pipeline p = scene_pipeline(&s);
        CHECK_INT(shade_draw(&c.target, &p, indices, 300, 1000, NULL), SHADE_OK);
        CHECK(!memcmp(seen, wanted, sizeof seen));
        canvas_close(&c);
    }
}

TEST(vertex, every_triangle_gets_its_own_three_vertices) /* any index order, near or far */
{
    enum { VERTICES = 4000, TRIANGLES = 3000 };
    static shade_vec4 clip[VERTICES];
    static float attribute[VERTICES];
    static uint32_t indices[TRIANGLES * 3];
    for (int round = 0; round < test_rounds(6); round++) {
        for (int i = 0; i < VERTICES; i++) {
            clip[i] = shade_v4(rnd_float(-1, 1), rnd_float(-1, 1), rnd_float(-0.9, 0.9), 1);
            attribute[i] = (float)i;
        }
        for (int i = 0; i < TRIANGLES * 3; i++) {
            int near_by = i < 3 || rnd_one_in(10) ? rnd_int(0, VERTICES - 1)
                                                  : (int)indices[i - rnd_int(1, 3)];
            near_by += round % 2 ? rnd_int(-20, 20) : 0;
            if (round % 3 == 2) near_by = rnd_int(0, VERTICES - 1);
            indices[i] = (uint32_t)((near_by + VERTICES) % VERTICES);
        }
        recorder r = recorder_open(400000);
        canvas c = canvas_open(48, 48, 0, SHADE_FORMAT_RGBA8, 0);
        scene s = { clip, attribute, 1, NULL, &r };
        shade_pipeline p = scene_pipeline(&s);
        p.interpolation = SHADE_INTERPOLATION_CONSTANT;
        CHECK_INT(shade_draw(&c.target, &p, indices, TRIANGLES * 3, VERTICES, NULL), SHADE_OK);
        CHECK_SAY(r.count > 1000, "%d fragments", r.count);
        for (int i = 0; i < r.count; i++) {
            fragment_record *f = &r.fragments[i];
            CHECK_NEAR(f->in[0], indices[3 * f->primitive], 0);
            ref_triangle t;
            const uint32_t *v = &indices[3 * f->primitive];
            if (!ref_triangle_of(&t, &clip[v[0]], &clip[v[1]], &clip[v[2]], 48, 48)) continue;
            CHECK_SAY(ref_covers(&t, (double)f->x, (double)f->y, 2.0 / 256, 1, 0) != 0,
                      "triangle %u does not reach %g %g", f->primitive, (double)f->x, (double)f->y);
        }
        free(r.fragments);
        canvas_close(&c);
    }
}

static void vertex_positions_only(const void *uniforms, const shade_vertex_ids *SHADE_RESTRICT in,
                                  shade_vertices *SHADE_RESTRICT out)
{
    const scene *s = (const scene *)uniforms;
    for (int i = 0; i < SHADE_LANES; i++) {
        scene_put_clip(out, i, s->clip[in->index[i]]);
        if (in->index[i] < 1000) {
            out->varying[0][i] = 7;
            out->varying[2][i] = 7;
        }
    }
}

static void vertex_nothing(const void *uniforms, const shade_vertex_ids *SHADE_RESTRICT in,
                           shade_vertices *SHADE_RESTRICT out)
{
    (void)uniforms;
    (void)in;
    (void)out;
}

TEST(vertex, what_a_shader_leaves_alone_is_zero)
{
    static shade_vec4 clip[6000];
    for (int i = 0; i < 6000; i++) clip[i] = clip_corners[i % 3];
    recorder r = recorder_open(400000);
    canvas c = canvas_open(8, 8, 0, SHADE_FORMAT_RGBA8, 0);
    scene s = { clip, NULL, SHADE_MAX_VARYINGS < 3 ? SHADE_MAX_VARYINGS : 3, NULL, &r };
    shade_pipeline p = scene_pipeline(&s);
    p.vertex = vertex_positions_only;
    canvas_draw(&c, &p, 6000);
    CHECK(r.count > 6000);
    for (int i = 0; i < r.count; i++) {
        double want = r.fragments[i].primitive < 333 ? 7 : 0;
        if (r.fragments[i].primitive == 333) continue; /* of vertices on both sides of 1000 */
        CHECK_NEAR(r.fragments[i].in[0], want, 1e-5);
        CHECK_NEAR(r.fragments[i].in[1], 0, 0);
        CHECK_NEAR(r.fragments[i].in[2], want, 1e-5);
    }
    r.count = 0;
    p.vertex = vertex_nothing; /* every position 0 0 0 0 */
    shade_stats stats = canvas_draw(&c, &p, 6000);
    CHECK_INT(stats.drawn, 0);
    CHECK_INT(stats.triangles, 2000);
    CHECK_INT(stats.culled + stats.clipped + stats.rejected, 2000);
    CHECK_INT(r.count, 0);
    free(r.fragments);
    canvas_close(&c);
}

/* positions made of the index alone */
static void vertex_from_index(const void *uniforms, const shade_vertex_ids *SHADE_RESTRICT in,
                              shade_vertices *SHADE_RESTRICT out)
{
    (void)uniforms;
    for (int i = 0; i < SHADE_LANES; i++) {
        shade_vec4 p = clip_corners[in->index[i] % 3];
        out->clip[0][i] = p.x;
        out->clip[1][i] = p.y;
        out->clip[3][i] = 1;
    }
}

/* No array holds so many vertices: the shader makes its corners from the index alone. */
TEST(vertex, indices_reach_up_to_the_greatest_count)
{
    static const uint32_t indices[] = { 2147483646u, 2147483644u, 2147483645u, 0,          1,
                                        2,           2147483643u, 0,           2147483645u };
    canvas c = canvas_open(16, 16, 0, SHADE_FORMAT_RGBA8, 0);
    scene s = { NULL, NULL, 0, NULL, NULL };
    shade_pipeline p = scene_pipeline(&s);
    shade_stats stats;
    p.vertex = vertex_from_index;
    CHECK_INT(shade_draw(&c.target, &p, indices, 6, 2147483647, &stats), SHADE_OK);
    CHECK_INT(stats.drawn, 2);
    CHECK_INT(stats.fragments, 2 * 128);
    CHECK_INT(shade_draw(&c.target, &p, indices, 3, 2147483646, &stats), SHADE_ERROR_INDEX);
    canvas_close(&c);
}

TEST(vertex, a_position_behind_the_eye_is_survived) /* w = -1 */
{
    canvas c = canvas_ready(32, 32, 0, SHADE_FORMAT_RGBA8, 1);
    shade_vec4 clip[3];
    for (int k = 0; k < 3; k++) clip[k] = shade_v4(1, -1, 0, -1);
    scene s = { clip, NULL, 0, NULL, NULL };
    shade_pipeline p = scene_pipeline(&s);
    shade_stats stats;
    stats = canvas_draw(&c, &p, 3);
    CHECK_INT(stats.drawn, 0);
    clip[0] = clip_corners[0];
    clip[1] = clip_corners[1];
    stats = canvas_draw(&c, &p, 3);
    CHECK_INT(stats.drawn, 1);
    canvas_close(&c);
}
