/* indices.c - indices of 16 bits: every call gives what it gives with those of 32. */
#include "pages.h"
#include "unit.h"
#include "calls.h"

/* Runs a row of the table of calls with cleared outputs; copies what it wrote into kept, one buffer
   after the other, and returns the number of bytes. */
static size_t indices_outcome(const call_world *w, const world_call *c, int narrow,
                              unsigned char *kept)
{
    size_t n = 0;
    for (int k = 0; k < WORLD_BUFFERS; k++) memset(world_at(w, k), 0, world_buffers[k].bytes);
    world_fill(w);
    if (narrow) world_narrow(w);
    c->set(w);
    CHECK_SAY(!c->run(w), "%s (%s) fails", c->name, c->when);
    for (int k = 0; k < WORLD_BUFFERS; k++) {
        if (!world_named(c->writes, world_buffers[k].name)) continue;
        memcpy(kept + n, world_at(w, k), world_buffers[k].bytes);
        n += world_buffers[k].bytes;
    }
    return n;
}

TEST(indices, of_16_bits_give_every_call_what_those_of_32_give)
{
    call_world w;
    size_t all = 0;
    int rows = 0;
    if (!world_fits()) return;
    for (int k = 0; k < WORLD_BUFFERS; k++) {
        world_put(&w, k, test_memory(world_buffers[k].bytes));
        all += world_buffers[k].bytes;
    }
    unsigned char *wide = test_memory(all), *narrow = test_memory(all);
    for (int i = 0; i < WORLD_CALLS; i++) {
        const world_call *c = &world_calls[i];
        if (!world_named(c->reads, "mesh") || !world_named(c->reads, "indices")) continue;
        const size_t n = indices_outcome(&w, c, 0, wide);
        CHECK(indices_outcome(&w, c, 1, narrow) == n);
        CHECK_SAY(!memcmp(wide, narrow, n), "%s (%s) differs", c->name, c->when);
        rows++;
    }
    CHECK(rows > 10);
    for (int k = 0; k < WORLD_BUFFERS; k++) free(world_at(&w, k));
    free(wide);
    free(narrow);
}

TEST(indices, sorted_chunks_of_16_bits_are_drawn_by_their_indices_of_32)
{
    enum { SIDE = 24, CORNERS = 6 * SIDE * SIDE, CHUNKS = 64 };
    static float positions[3 * (SIDE + 1) * (SIDE + 1)];
    static uint16_t narrow[CORNERS];
    static uint32_t sorted[CORNERS];
    static shade_chunk chunks[CHUNKS];
    const shade_draw_state s = plain_state(NULL);
    canvas one = canvas_ready(80, 80, 0, SHADE_FORMAT_RGBA8, 1);
    canvas two = canvas_ready(80, 80, 0, SHADE_FORMAT_RGBA8, 1);
    shade_mesh m = plain_mesh(positions, (SIDE + 1) * (SIDE + 1));
    for (int i = 0; i < m.vertex_count; i++) {
        const float x = (float)(i % (SIDE + 1)) / SIDE, y = (float)(i / (SIDE + 1)) / SIDE;
        put3(positions + 3 * i, shade_v3(1.8f * x - 0.9f, 1.8f * y - 0.9f, x * y));
    }
    for (int q = 0, n = 0; q < SIDE * SIDE; q++) {
        const int a = q / SIDE * (SIDE + 1) + q % SIDE, b = a + SIDE + 1;
        const int corner[6] = { a, a + 1, b, a + 1, b + 1, b };
        for (int k = 0; k < 6; k++) narrow[n++] = (uint16_t)corner[k];
    }
    m.indices16 = narrow;
    m.index_count = CORNERS;
    CHECK_INT(canvas_draw_mesh(&one, &m, &s).drawn, CORNERS / 3);
    CHECK_INT(shade_mesh_chunks(&m, 20, chunks, CHUNKS, sorted), SHADE_OK);
    m.indices = sorted;
    m.indices16 = NULL;
    m.chunks = chunks;
    m.chunk_count = shade_chunk_count(CORNERS, 20);
    CHECK_INT(canvas_draw_mesh(&two, &m, &s).drawn, CORNERS / 3);
    CHECK(canvas_same(&one, &two));
    canvas_close(&one);
    canvas_close(&two);
}

TEST(indices, the_last_of_65536_vertices_is_reached)
{
    enum { VERTICES = 65536 };
    static float positions[3 * VERTICES];
    static const uint16_t last[3] = { 0, 1, 65535 };
    const shade_ray ray = { { 0, 0, 3 }, { 0, 0, -1 } };
    shade_vec3 low, high;
    shade_mesh m = plain_mesh(positions, VERTICES);
    memset(positions, 0, sizeof positions);
    put3(positions, shade_v3(-1, -1, 0));
    put3(positions + 3, shade_v3(1, -1, 0));
    put3(positions + 3 * 65535, shade_v3(0, 1, 0));
    m.indices16 = last;
    m.index_count = 3;
    CHECK_INT(shade_pick(&m, shade_mat4_identity(), ray, NULL, NULL), 0);
    CHECK_INT(shade_mesh_bounds(&m, &low, &high), SHADE_OK);
    CHECK(high.y == 1 && low.x == -1 && high.x == 1);
    m.vertex_count--;
    CHECK_INT(shade_pick(&m, shade_mat4_identity(), ray, NULL, NULL), -1);
    CHECK_INT(shade_mesh_bounds(&m, &low, &high), SHADE_ERROR_INDEX);
}

/* One bad index anywhere in a list, of 16 bits or of 32. */
TEST(indices, one_past_the_vertices_is_found_wherever_it_stands)
{
    enum { MOST = 66 };
    uint16_t narrow[MOST];
    uint32_t wide[MOST];
    const float positions[9] = { 0 };
    shade_vec3 low, high;
    shade_mesh m = plain_mesh(positions, 3);
    for (int n = 3; n <= MOST; n += 3) {
        for (int bad = -1; bad < n; bad++) {
            const shade_result want = bad < 0 ? SHADE_OK : SHADE_ERROR_INDEX;
            for (int i = 0; i < n; i++) {
                wide[i] = i == bad ? 3u + (uint32_t)rnd_int(0, 1) * 65533u : (uint32_t)i % 3;
                narrow[i] = (uint16_t)(i == bad ? 3 + rnd_int(0, 1) * 65532 : i % 3);
            }
            m.index_count = n;
            m.indices = wide;
            m.indices16 = NULL;
            CHECK_INT(shade_mesh_bounds(&m, &low, &high), want);
            m.indices = NULL;
            m.indices16 = narrow;
            CHECK_INT(shade_mesh_bounds(&m, &low, &high), want);
        }
    }
}

TEST(indices, of_both_widths_are_refused)
{
    static const uint16_t narrow[3] = { 0, 1, 2 };
    static const uint32_t wide[3] = { 0, 1, 2 };
    const shade_ray ray = { { 0, 0, 3 }, { 0, 0, -1 } };
    const shade_draw_state s = plain_state(NULL);
    shade_mesh m = plain_mesh(big_triangle, 3);
    canvas c = canvas_open(8, 8, 0, SHADE_FORMAT_RGBA8, 1);
    shade_vec3 low, high;
    const char *why;
    m.indices = wide;
    m.indices16 = narrow;
    m.index_count = 3;
    CHECK_INT(shade_draw_mesh(&c.target, &m, &s, NULL), SHADE_ERROR_MESH);
    CHECK_INT(shade_mesh_bounds(&m, &low, &high), SHADE_ERROR_MESH);
    CHECK_INT(shade_mesh_corner_normals_bytes(&m), 0);
    CHECK_INT(shade_pick(&m, shade_mat4_identity(), ray, NULL, NULL), -1);
    why = shade_explain(&c.target, &m, &s, NULL);
    CHECK_SAY(strstr(why, "mesh.indices16") != NULL, "\"%s\"", why);
    m.indices = NULL;
    m.index_count = -3;
    CHECK_INT(shade_mesh_bounds(&m, &low, &high), SHADE_ERROR_MESH);
    CHECK(canvas_untouched(&c));
    canvas_close(&c);
}
