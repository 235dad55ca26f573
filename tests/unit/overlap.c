/* overlap.c - outputs that lie in memory which is read.  All arrays of a call lie in one block, at
   random places.  A map of its bytes says whether an output shares one with an input or another
   output.  If so, the call returns SHADE_ERROR_ARGUMENT and the block stays as it was; else the
   outputs are those of the same call with each array in memory of its own. */
#include "unit.h"

enum { BLOCK = 2048 };
typedef struct block {
    union {
        double alignment;
        unsigned char byte[BLOCK];
    } is;
    unsigned char read[BLOCK]; /* 1: an input, or an output that was marked before */
    int shared;                /* an output has a byte that is read */
} block;

static void mark_input(block *b, size_t at, size_t count, size_t size, size_t stride)
{
    for (size_t i = 0; i < count; i++)
        for (size_t k = 0; k < size; k++) b->read[at + i * stride + k] = 1;
}

static void mark_output(block *b, size_t at, size_t count, size_t size, size_t stride)
{
    for (size_t i = 0; i < count; i++)
        for (size_t k = 0; k < size; k++) b->shared |= b->read[at + i * stride + k];
    mark_input(b, at, count, size, stride);
}

/* A place for so many bytes, aligned */
static size_t any_place(size_t bytes, size_t alignment)
{
    return (size_t)rnd_int(0, (int)((BLOCK - bytes) / alignment)) * alignment;
}

static int tried[2]; /* calls that were taken, and refused */
static void check_call(const block *b, const block *before, shade_result got, const char *call)
{
    tried[b->shared]++;
    CHECK_SAY(got == (b->shared ? SHADE_ERROR_ARGUMENT : SHADE_OK), "%s: %d, shared %d", call, got,
              b->shared);
    if (b->shared) CHECK_SAY(!memcmp(&b->is, &before->is, BLOCK), "%s writes", call);
}

enum { NORMALS, CORNERS, EDGES, LISTS, CALLS };
static const char *const call_name[CALLS] = { "shade_mesh_normals", "shade_mesh_corner_normals",
                                              "shade_mesh_edges", "shade_mesh_chunks" };

static shade_result call_of(int call, const shade_mesh *m, void *out, void *other, int *count)
{
    const int corners = m->indices || m->indices16 ? m->index_count : m->vertex_count;
    switch (call) {
    case NORMALS: return shade_mesh_normals(m, (shade_vec3 *)out);
    case CORNERS:
        return shade_mesh_corner_normals(m, 0.5f, (shade_vec3 *)out, other, 16 * (size_t)corners);
    case EDGES: return shade_mesh_edges(m, (shade_edge *)out, corners, count);
    default: return shade_mesh_chunks(m, 1, (shade_chunk *)out, corners / 3, (uint32_t *)other);
    }
}

/* Positions with a stride of 12 to 76 bytes, then indices of 16 or 32 bits or none, then chunks or
   none; outputs anywhere. */
/* G21 */
TEST(overlap, meshes_are_not_written_over)
{
    static block b, before;
    tried[0] = tried[1] = 0;
    for (int i = 0; i < 20000; i++) {
        const int call = i % CALLS, kind = rnd_int(0, 2), triangles = rnd_int(0, 2);
        const size_t stride = 12 + 4 * (size_t)rnd_int(0, 16), from = 4 * (size_t)rnd_int(0, 60);
        shade_mesh m = { .position_stride = (int)stride };
        memset(&b, 0, sizeof b);
        m.vertex_count = kind == 2 ? 3 * triangles : rnd_int(1, 6);
        m.index_count = 3 * triangles;
        const size_t corners = 3 * (size_t)triangles, n = (size_t)m.vertex_count;
        size_t at = from + n * stride;
        for (int k = 0; k < BLOCK / 4; k++) {
            float f = rnd_float(-1, 1);
            memcpy(b.is.byte + 4 * k, &f, 4);
        }
        m.positions = (const float *)(const void *)(b.is.byte + from);
        mark_input(&b, from, n, 12, stride);
        for (size_t k = 0; k < corners && kind < 2; k++) {
            const uint32_t wide = (uint32_t)rnd_int(0, m.vertex_count - 1);
            const uint16_t narrow = (uint16_t)wide;
            if (kind == 0) memcpy(b.is.byte + at + 4 * k, &wide, 4);
            else memcpy(b.is.byte + at + 2 * k, &narrow, 2);
        }
        if (kind == 0) m.indices = (const uint32_t *)(const void *)(b.is.byte + at);
        if (kind == 1) m.indices16 = (const uint16_t *)(const void *)(b.is.byte + at);
        if (kind < 2) mark_input(&b, at, corners, kind ? 2 : 4, kind ? 2 : 4);
        at += kind < 2 ? 4 * corners : 0;
        if (triangles && rnd_one_in(2)) {
            const shade_chunk all = { { 0, 0, 0 }, { 1, 1, 1 }, 0, triangles };
            memcpy(b.is.byte + at, &all, sizeof all);
            m.chunks = (const shade_chunk *)(const void *)(b.is.byte + at);
            m.chunk_count = 1;
            if (call != LISTS) mark_input(&b, at, 1, sizeof all, sizeof all);
        }
        m.normals = m.texcoords = m.colors = m.positions; /* not read, wherever they are */

        const size_t out_bytes[CALLS] = { 12 * n, 12 * corners, 16 * corners,
                                          sizeof(shade_chunk) * (size_t)triangles };
        const size_t other_bytes[CALLS] = { 0, 16 * corners, 0, 4 * corners };
        const size_t out = any_place(out_bytes[call], 4), other = any_place(other_bytes[call], 4);
        unsigned char *own_out = test_memory(out_bytes[call] + 4);
        unsigned char *own_other = test_memory(other_bytes[call] + 4);
        int count = 0, own_count = 0;
        mark_output(&b, out, out_bytes[call] != 0, out_bytes[call], 1);
        mark_output(&b, other, other_bytes[call] != 0, other_bytes[call], 1);
        before = b;
        CHECK_INT(call_of(call, &m, own_out, own_other, &own_count), SHADE_OK);
        shade_result got = call_of(call, &m, b.is.byte + out, b.is.byte + other, &count);
        check_call(&b, &before, got, call_name[call]);
        if (!b.shared) {
            const size_t filled = call == EDGES ? 16 * (size_t)count : out_bytes[call];
            CHECK_INT(count, own_count);
            CHECK_SAY(!memcmp(own_out, b.is.byte + out, filled), "%s: other", call_name[call]);
            if (call == LISTS)
                CHECK_SAY(!memcmp(own_other, b.is.byte + other, 4 * corners), "other indices");
        }
        free(own_out);
        free(own_other);
    }
    CHECK_SAY(tried[0] > 3000 && tried[1] > 1500, "%d taken, %d refused", tried[0], tried[1]);
}

/* The struct of the mesh is read to the end, too.  normals may be mesh.normals, as in README. */
TEST(overlap, a_mesh_is_not_written_over_itself)
{
    static shade_vec3 positions[3] = { { 0, 0, 0 }, { 1, 0, 0 }, { 0, 1, 0 } }, normals[3];
    union {
        shade_mesh mesh;
        shade_vec3 normals[30];
    } u;
    memset(&u, 0, sizeof u);
    u.mesh.positions = &positions[0].x;
    u.mesh.normals = &normals[0].x;
    u.mesh.vertex_count = 3;
    CHECK_INT(shade_mesh_normals(&u.mesh, u.normals), SHADE_ERROR_ARGUMENT);
    CHECK_INT(shade_mesh_normals(&u.mesh, normals), SHADE_OK);
    CHECK(normals[2].z == 1);
}

static size_t row_bytes_of(const shade_target *t)
{
    return canvas_pixel_bytes(t->format) * (size_t)(t->stride * t->height);
}

/* Pictures of any strides, formats and clip rectangles, side by side in the same rows too.  In
   place means the same color and stride, and pixels of one size. */
/* G21 */
TEST(overlap, pictures_are_not_resolved_into_themselves)
{
    static block b, before, own;
    int in_place = 0, gaps = 0;
    tried[0] = tried[1] = 0;
    for (int i = 0; i < 20000; i++) {
        const int factor = rnd_one_in(3) ? 1 : rnd_int(1, 3);
        shade_target out = { 0 }, in = { 0 };
        memset(&b, 0, sizeof b);
        out.width = rnd_int(1, 5);
        out.height = rnd_int(1, 5);
        in.width = out.width * factor;
        in.height = out.height * factor;
        out.format = rnd_format();
        in.format = rnd_one_in(2) ? out.format : rnd_format();
        if (out.format == SHADE_FORMAT_RGBA32F || in.format == SHADE_FORMAT_RGBA32F)
            out.format = in.format = SHADE_FORMAT_RGBA8;
        const size_t ob = canvas_pixel_bytes(out.format), ib = canvas_pixel_bytes(in.format);
        in.stride = in.width + rnd_int(0, 12);
        out.stride = out.width + rnd_int(0, 12);
        if (rnd_one_in(3)) out.stride = in.stride;
        for (int k = 0; k < BLOCK; k++) b.is.byte[k] = (unsigned char)rnd_int(0, 255);
        const size_t from = any_place(ib * (size_t)(in.stride * in.height), 4);
        size_t to = any_place(ob * (size_t)(out.stride * out.height), 4);
        if (rnd_one_in(4) && from + ob * (size_t)(out.stride * out.height) < BLOCK) to = from;
        in.color = b.is.byte + from;
        out.color = b.is.byte + to;
        if (rnd_one_in(2)) {
            out.clip_x = rnd_int(-1, 3);
            out.clip_y = rnd_int(-1, 3);
            out.clip_width = rnd_int(1, 4);
            out.clip_height = rnd_int(1, 4);
        }
        int clip[4] = { 0, 0, out.width, out.height };
        if (out.clip_width) {
            clip[0] = out.clip_x > 0 ? out.clip_x : 0;
            clip[1] = out.clip_y > 0 ? out.clip_y : 0;
            clip[2] = out.clip_x + out.clip_width;
            clip[3] = out.clip_y + out.clip_height;
            if (clip[2] > out.width) clip[2] = out.width;
            if (clip[3] > out.height) clip[3] = out.height;
        }
        const int wide = clip[2] - clip[0], high = clip[3] - clip[1];
        if (wide > 0 && high > 0) {
            const size_t f = (size_t)factor, x = (size_t)clip[0], y = (size_t)clip[1];
            const size_t row = ib * (size_t)in.stride, other = ob * (size_t)out.stride;
            mark_input(&b, from + y * f * row + x * f * ib, (size_t)high * f,
                       (size_t)wide * f * ib, row);
            mark_output(&b, to + y * other + x * ob, (size_t)high, (size_t)wide * ob, other);
        }
        if (factor == 1 && from == to && ob == ib && in.stride == out.stride) {
            in_place += b.shared;
            b.shared = 0;
        }
        gaps += !b.shared && to < from + row_bytes_of(&in) && from < to + row_bytes_of(&out);
        before = own = b;
        shade_target apart = out;
        apart.color = own.is.byte + to;
        CHECK_INT(shade_resolve(&apart, &in, factor), SHADE_OK);
        check_call(&b, &before, shade_resolve(&out, &in, factor), "shade_resolve");
        if (!b.shared) CHECK_SAY(!memcmp(&own.is, &b.is, BLOCK), "other pixels");
    }
    CHECK_SAY(tried[0] > 3000 && tried[1] > 3000 && in_place > 500 && gaps > 200,
              "%d taken, %d refused, %d in place, %d in gaps", tried[0], tried[1], in_place, gaps);
}

/* Texels, levels, the memory for texels of mipmaps, and the texture itself */
/* G21 */
TEST(overlap, mipmaps_are_not_made_in_their_own_texels)
{
    static block b, before, own;
    tried[0] = tried[1] = 0;
    for (int i = 0; i < 20000; i++) {
        shade_texture map = { 0 }, *texture;
        memset(&b, 0, sizeof b);
        map.width = rnd_int(1, 6);
        map.height = rnd_int(1, 6);
        map.stride = map.width + rnd_int(0, 30);
        map.format = SHADE_FORMAT_RGBA8;
        const size_t row = 4 * (size_t)map.stride, align = sizeof(void *);
        const size_t levels = (size_t)shade_mipmap_count(map.width, map.height);
        const size_t bytes = shade_mipmap_bytes(map.width, map.height, map.format);
        const size_t from = any_place(row * (size_t)map.height, 4), list = any_place(200, align);
        const size_t made = any_place(bytes, 4), self = any_place(sizeof map, align);
        for (int k = 0; k < BLOCK; k++) b.is.byte[k] = (unsigned char)rnd_int(0, 255);
        map.pixels = b.is.byte + from;
        mark_input(&b, from, (size_t)map.height, 4 * (size_t)map.width, row);
        mark_output(&b, self, 1, sizeof map, 1);
        mark_output(&b, list, levels != 0, levels * sizeof map, 1);
        mark_output(&b, made, bytes != 0, bytes, 1);
        texture = (shade_texture *)(void *)(b.is.byte + self);
        memcpy(b.is.byte + self, &map, sizeof map);
        before = own = b;
        check_call(&b, &before,
                   shade_build_mipmaps(texture, (shade_texture *)(void *)(b.is.byte + list),
                                       b.is.byte + made, bytes),
                   "shade_build_mipmaps");
        if (b.shared) continue;
        static shade_texture own_levels[8];
        CHECK_INT(shade_build_mipmaps(&map, own_levels, own.is.byte + made, bytes), SHADE_OK);
        CHECK_SAY(!memcmp(own.is.byte + made, b.is.byte + made, bytes), "other texels");
    }
    CHECK_SAY(tried[0] > 3000 && tried[1] > 3000, "%d taken, %d refused", tried[0], tried[1]);
}

/* Only the packets of shade_light_at_lanes may be written over. */
TEST(overlap, directions_to_a_lamp_may_replace_the_points)
{
    float point[3][SHADE_LANES], want[3][SHADE_LANES], got[1][SHADE_LANES], amount[1][SHADE_LANES];
    const shade_light lamp = shade_point_light(shade_v3(1, 2, 3), shade_v3(1, 1, 1));
    for (int k = 0; k < 3; k++)
        for (int i = 0; i < SHADE_LANES; i++) point[k][i] = rnd_float(-5, 5);
    shade_light_at_lanes(&lamp, point[0], want[0], amount[0]);
    shade_light_at_lanes(&lamp, point[0], point[0], got[0]);
    CHECK(!memcmp(point, want, sizeof want));
    CHECK(!memcmp(got, amount, sizeof got));
}
