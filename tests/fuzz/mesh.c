/* mesh.c - shade_draw_mesh: any arrays and strides, lights, materials, maps and cameras. */
#include "scene.h"

static int mesh_calls;                   /* of an input */

/* A refused draw has a sentence; every other one a sentence or none. */
static void mesh_explained(const mesh_scene *s, const shade_target *target,
                           const shade_stats *stats, shade_result result)
{
    const char *with = shade_explain(target, s->mesh, s->state, stats);
    const char *without = shade_explain(target, s->mesh, s->state, NULL);
    HOLDS(with && without);
    HOLDS(result == SHADE_OK || (*with && *without));
}

static shade_result mesh_call(void *user, const shade_target *target, shade_stats *stats)
{
    mesh_scene *s = (mesh_scene *)user;
    shade_result result = shade_draw_mesh(target, s->mesh, s->state, stats);
    HOLDS(result != SHADE_OK || !fuzz_is_no_camera(s->s.projection) || !stats->drawn);
    if (!mesh_calls++) mesh_explained(s, target, stats, result);    /* as long as 50 draws */
    return result;
}

/* The same triangles in another shading, or into depth alone: the same alpha, the same depth. */
static shade_result mesh_otherwise(void *user, const shade_target *target, shade_stats *stats)
{
    mesh_scene *s = (mesh_scene *)user;
    shade_target t = *target;
    shade_draw_state state = s->s;
    shade_result result;
    if (t.depth && state.shading == SHADE_SHADING_PER_FACE) t.color = NULL;
    s->s.shading = (shade_shading)((state.shading + 1) % 3);
    s->s.lighting.model = SHADE_MODEL_EMISSIVE;
    s->s.raster.blend = SHADE_BLEND_REPLACE;
    result = shade_draw_mesh(&t, s->mesh, s->state, stats);
    s->s = state;
    return result;
}

/* One field that has to be refused: its result, or SHADE_OK where nothing was spoilt. */
static shade_result mesh_spoil(fuzz_input *in, mesh_scene *s)
{
    int wild = fuzz_wild_int(in), bad = wild < 0 || wild % 4;
    if (bad || fuzz_one_in(in, 2)) switch (fuzz_byte(in) % 7) {
        case 0: s->m.position_stride = bad ? wild : -4; return SHADE_ERROR_MESH;
        case 1: s->m.normal_stride = bad ? wild : -4; return SHADE_ERROR_MESH;
        case 2: s->m.texcoord_stride = bad ? wild : -4; return SHADE_ERROR_MESH;
        case 3: s->m.color_stride = bad ? wild : -4; return SHADE_ERROR_MESH;
        case 4: s->m.vertex_count = -1; return SHADE_ERROR_MESH;
        case 5:
            if (!s->m.indices16) return SHADE_OK;
            s->m.indices = s->wide;
            return SHADE_ERROR_MESH;
        default:
            if (!s->m.indices && !s->m.indices16) return SHADE_OK;
            s->m.index_count = INT_MIN;
            return SHADE_ERROR_MESH;
    }
    return SHADE_OK;
}

/* Tame scenes give finite colours, drawn over any that a blend of alpha up to 1e5 leaves finite. */
static void mesh_finite(const picture *p, const shade_target *t)
{
    if (t->format != SHADE_FORMAT_RGBA32F || !p->color) return;
    for (size_t i = 0; i < p->color_bytes; i += 4) {
        float now, before;
        memcpy(&now, p->color + i, 4);
        memcpy(&before, p->before + i, 4);
        HOLDS(fuzz_finite(now) || !(before > -1e30f && before < 1e30f));
    }
}

/* The chunks of the mesh in a draw each: the picture of all in one. */
static void mesh_one_by_one(picture *p, mesh_scene *s)
{
    shade_mesh one = s->m;
    picture_keep(p);
    picture_restore(p);
    one.chunk_count = 1;
    for (int i = 0; i < s->m.chunk_count; i++, one.chunks++)
        HOLDS(shade_draw_mesh(&p->target, &one, &s->s, NULL) == SHADE_OK);
    HOLDS(picture_same(p));
}

/* Lists of any chunks: refused where one lies outside of the triangles, else drawn, whatever the
   boxes are and however often a triangle is named. */
static void mesh_hostile(fuzz_input *in, picture *p, mesh_scene *s, int triangles)
{
    const int count = fuzz_int(in, 0, 40);
    shade_chunk *c = (shade_chunk *)guard_take((size_t)count * sizeof *c, (int)fuzz_byte(in) & 1);
    shade_result want = SHADE_OK;
    long long sum = 0;
    shade_stats stats;
    for (int i = 0; i < count; i++) {
        const int wild = fuzz_one_in(in, 32);
        c[i].low = fuzz_vec3(in, 0);
        c[i].high = fuzz_vec3(in, 0);
        c[i].first = wild ? fuzz_wild_int(in) : fuzz_int(in, 0, triangles);
        c[i].count = wild ? fuzz_wild_int(in) : fuzz_int(in, 0, triangles - c[i].first);
        if (c[i].first < 0 || c[i].count < 0 || (int64_t)c[i].first + c[i].count > triangles)
            want = SHADE_ERROR_MESH;
        sum += c[i].count;
    }
    guard_seal(c);
    picture_restore(p);
    s->m.chunks = c;
    s->m.chunk_count = count;
    HOLDS(shade_draw_mesh(&p->target, &s->m, &s->s, &stats) == want);
    if (want == SHADE_OK) picture_check(p);
    else HOLDS(picture_unchanged(p));
    picture_stats(&stats, want == SHADE_OK ? sum : 0);
    if (want == SHADE_OK) mesh_one_by_one(p, s);
}

/* With the chunks of the mesh: the same picture, the same fragments. */
static void mesh_chunks(fuzz_input *in, picture *p, mesh_scene *s, int triangles)
{
    const uint32_t kind = fuzz_byte(in);
    const int size = fuzz_int(in, 0, 9), count = shade_chunk_count(3 * triangles, size);
    shade_chunk *c = (shade_chunk *)guard_take((size_t)count * sizeof *c, (int)kind & 1);
    shade_stats without, with;
    HOLDS(shade_mesh_chunks(&s->m, size, c, count, NULL) == SHADE_OK);
    guard_seal(c);
    picture_restore(p);
    HOLDS(shade_draw_mesh(&p->target, &s->m, &s->s, &without) == SHADE_OK);
    picture_keep(p);
    picture_restore(p);
    s->m.chunks = c;
    s->m.chunk_count = count;
    if (s->m.indices16) s->m.indices = s->wide;
    s->m.indices16 = NULL;
    HOLDS(shade_draw_mesh(&p->target, &s->m, &s->s, &with) == SHADE_OK);
    HOLDS(picture_same(p));
    picture_stats(&with, triangles);
    HOLDS(with.fragments == without.fragments);
    if (kind & 2) mesh_hostile(in, p, s, triangles);
    s->m.chunks = NULL;
    s->m.chunk_count = 0;
}

int LLVMFuzzerTestOneInput(const uint8_t *data, size_t size)
{
    static mesh_scene s;
    fuzz_input in = { data, data + size };
    picture pic;
    uint32_t kind = fuzz_byte(&in);
    float most = kind & 1 ? 1e5f : 0;
    int triangles;
    shade_result want, state;
    mesh_calls = 0;
    picture_open(&in, &pic, 32);
    pic.one_width = !(most > 0);
    want = pic.want;
    state = mesh_open(&in, &s, kind, most, 64, 64);
    if (want == SHADE_OK) want = state;
    triangles = mesh_corners(&s.m) / 3;
    if (fuzz_one_in(&in, 32)) {
        shade_result spoilt = mesh_spoil(&in, &s);
        if (spoilt != SHADE_OK && want != SHADE_ERROR_TARGET) want = spoilt;
    }
    if (kind == 0xE0) {
        s.mesh = NULL;
        want = SHADE_ERROR_ARGUMENT;
    }
    if (kind == 0xE2) {
        s.state = NULL;
        want = SHADE_ERROR_ARGUMENT;
    }
    if (kind == 0xE4 && s.m.vertex_count > 0) {
        s.m.positions = NULL;
        if (want != SHADE_ERROR_TARGET) want = SHADE_ERROR_MESH;
    }
    picture_try(&in, &pic, mesh_call, s.s.fragment ? NULL : mesh_otherwise, &s, want, triangles,
                s.s.raster.depth_read_only);
    if (most > 0 && want == SHADE_OK) mesh_finite(&pic, &pic.target);
    if (want == SHADE_OK) mesh_chunks(&in, &pic, &s, triangles);
    picture_close(&pic);
    guard_close();
    return 0;
}
