/* draw.c - shade_draw: any pipeline, indices and clip-space positions on any target. */
#include "picture.h"

enum { DRAW_VERTICES = 96, DRAW_TRIANGLES = 96 };

typedef struct draw_scene {
    shade_pipeline p;
    const shade_vec4 *clip;              /* vertex_count; between guards */
    const float *attribute;              /* p.varyings a vertex */
    const uint32_t *indices;
    int index_count, vertex_count, kind;
    int tame;                            /* attributes are multiples of 1/50, positions <= 1e12 */
    shade_texture texture;               /* of the level of detail */
    int x0, y0, x1, y1;                  /* clip rectangle of the call */
    long long shaded;                    /* fragments handed to the shader */
    const shade_pipeline *pipeline;      /* &p, or NULL */
} draw_scene;

enum {
    DRAW_FLAT, DRAW_VARYINGS, DRAW_SIEVE, DRAW_SPECIAL, DRAW_SILENT, DRAW_DEPTH_ONLY, DRAW_KINDS
};

static void draw_vertex(const void *uniforms, const shade_vertex_ids *SHADE_RESTRICT in,
                        shade_vertices *SHADE_RESTRICT out)
{
    const draw_scene *s = (const draw_scene *)uniforms;
    HOLDS(in->count >= 1 && in->count <= SHADE_LANES);
    for (int i = 0; i < SHADE_LANES; i++) {
        uint32_t v = in->index[i];
        HOLDS(v < (uint32_t)s->vertex_count);
        HOLDS(i < in->count || v == in->index[in->count - 1]);
        out->clip[0][i] = s->clip[v].x;
        out->clip[1][i] = s->clip[v].y;
        out->clip[2][i] = s->clip[v].z;
        out->clip[3][i] = s->clip[v].w;
        for (int k = 0; k < s->p.varyings; k++)
            out->varying[k][i] = s->attribute[v * (size_t)s->p.varyings + (size_t)k];
    }
}

static void draw_check_fragment(const draw_scene *s, const shade_fragments *in, int i)
{
    float x = in->x[i] - 0.5f, y = in->y[i] - 0.5f, z = in->z[i];
    uint32_t first;
    HOLDS(x >= (float)s->x0 && x < (float)s->x1 && x == (float)(int)x);
    HOLDS(y >= (float)s->y0 && y < (float)s->y1 && y == (float)(int)y);
    HOLDS(z >= 0 && z <= 1);
    HOLDS(in->primitive[i] < (uint32_t)s->index_count / 3 && in->front[i] <= 1);
    HOLDS(s->p.raster.cull == SHADE_CULL_NONE ||
          in->front[i] == (s->p.raster.cull == SHADE_CULL_BACK));
    for (int k = 0; s->tame && k < s->p.varyings; k++) HOLDS(fuzz_finite(in->varying[k][i]));
    HOLDS(!s->tame || !s->p.lod_texture || fuzz_finite(in->lod[i]));
    if (s->p.interpolation != SHADE_INTERPOLATION_CONSTANT) return;
    first = s->indices ? s->indices[3 * in->primitive[i]] : 3 * in->primitive[i];
    for (int k = 0; k < s->p.varyings; k++) {    /* -0 may come as 0 */
        float v = in->varying[k][i], a = s->attribute[first * (size_t)s->p.varyings + (size_t)k];
        HOLDS(v == a || fuzz_same(v, a));
    }
}

static void draw_check_tail(const draw_scene *s, const shade_fragments *in, int i)
{
    int last = in->count - 1;
    HOLDS(in->x[i] == in->x[last] && in->y[i] == in->y[last] && in->z[i] == in->z[last]);
    HOLDS(in->primitive[i] == in->primitive[last] && in->front[i] == in->front[last]);
    for (int k = 0; k < s->p.varyings; k++)
        HOLDS(fuzz_same(in->varying[k][i], in->varying[k][last]));
    HOLDS(!s->p.lod_texture || fuzz_same(in->lod[i], in->lod[last]));
}

static void draw_fragment(const void *uniforms, const shade_fragments *SHADE_RESTRICT in,
                          shade_colors *SHADE_RESTRICT out)
{
    static const uint32_t special[] = { 0x7FC00000u, 0x7F800000u, 0xFF800000u, 0x00000001u,
                                        0x80000000u, 0x7F7FFFFFu, 0xBF800000u, 0x3F800001u };
    draw_scene *s = (draw_scene *)(uintptr_t)uniforms;
    HOLDS(in->count >= 1 && in->count <= SHADE_LANES);
    s->shaded += in->count;
    for (int i = 0; i < SHADE_LANES; i++) {
        uint32_t n = in->primitive[i];
        if (i < in->count) draw_check_fragment(s, in, i);
        else draw_check_tail(s, in, i);
        for (int k = 0; k < 4; k++) {
            HOLDS(out->color[k][i] == (k == 3));
            HOLDS(!out->discard[i]);
            uint32_t of = n * 5 + (uint32_t)k * 3;
            if (s->kind == DRAW_SPECIAL)
                out->color[k][i] = fuzz_float_of(special[of % 8]);
            else if (s->kind == DRAW_VARYINGS && k < s->p.varyings)
                out->color[k][i] = in->varying[k][i];
            else if (s->kind != DRAW_SILENT)
                out->color[k][i] = (float)(of % 16) / 15;
        }
        if (s->kind == DRAW_SIEVE && ((uint32_t)in->x[i] + (uint32_t)in->y[i] + n) % 3 == 0)
            out->discard[i] = 1u << n % 32;
    }
}

static shade_result draw_call(void *user, const shade_target *target, shade_stats *stats)
{
    draw_scene *s = (draw_scene *)user;
    shade_result result;
    picture_clip(target, &s->x0, &s->y0, &s->x1, &s->y1);
    s->shaded = 0;
    result = shade_draw(target, s->pipeline, s->indices, s->index_count, s->vertex_count, stats);
    HOLDS(result == SHADE_OK || !s->shaded);
    if (result != SHADE_OK) return result;
    if (!s->p.fragment || (!target->color && !s->p.may_discard)) HOLDS(!s->shaded);
    else if (s->p.may_discard) HOLDS(s->shaded >= stats->fragments);
    else HOLDS(s->shaded == stats->fragments);
    return result;
}

/* The same triangles for another interpolation, or for nobody. */
static shade_result draw_otherwise(void *user, const shade_target *target, shade_stats *stats)
{
    draw_scene *s = (draw_scene *)user;
    shade_pipeline p = s->p;
    shade_result result;
    s->p.interpolation = (shade_interpolation)((s->p.interpolation + 1) % 3);
    if (s->kind == DRAW_FLAT) s->p.fragment = NULL;
    if (s->kind == DRAW_SILENT) s->p.may_discard = !s->p.may_discard;
    if (s->kind != DRAW_VARYINGS) {
        s->p.varyings = 0;
        s->p.lod_texture = NULL;
    }
    result = draw_call(user, target, stats);
    s->p = p;
    return result;
}

/* the places on which coverage and clipping turn: pixel corners and centres, planes, far away */
static shade_vec4 draw_position(fuzz_input *in, const shade_target *t, const shade_vec4 *before)
{
    uint32_t kind = fuzz_byte(in);
    float w = kind & 128 ? 1 + (float)(kind >> 4 & 7) : 1, x, y, z;
    shade_vec4 p;
    switch (kind % 8) {
        case 0:
        case 1:
        case 2:              /* to a half or a sixteenth of a pixel, or half a pixel */
x = (float)fuzz_byte(in) / (kind % 8 == 0 ? 2 : 16) - 2;
            y = (float)fuzz_byte(in) / (kind % 8 == 0 ? 2 : 16) - 2;
            if (kind % 8 == 2) {
                x *= 8;
                y *= 8;
            }
            z = (float)fuzz_byte(in) / 128 - 1;
            x = 2 * x / (float)t->width - 1;
            y = 1 - 2 * y / (float)t->height;
            return shade_v4(x * w, y * w, z * w, w);
        case 3:
        case 4:
            x = (float)fuzz_byte(in) / 64 - 2;
            y = (float)fuzz_byte(in) / 64 - 2;
            z = (float)fuzz_byte(in) / 100 - 1.28f;
            return shade_v4(x, y, z, (float)fuzz_byte(in) / 128 - 0.25f);
        case 5:
            p = *before;
            x = fuzz_float(in);
            if (kind & 8) p.x = x;
            else if (kind & 16) p.y = x;
            else if (kind & 32) p.z = x;
            else p.w = x;
            return p;
        case 6: return fuzz_vec4(in, 1e6f);
        default: return fuzz_vec4(in, 0);
    }
}

static shade_vec4 *draw_positions(fuzz_input *in, draw_scene *s, const shade_target *t, int right)
{
    size_t bytes = (size_t)(s->vertex_count > 0 ? s->vertex_count : 0) * sizeof(shade_vec4);
    shade_vec4 *clip = (shade_vec4 *)guard_take(bytes, right), before = shade_v4(0, 0, 0, 1);
    for (int i = 0; i < s->vertex_count; i++) {
        const float *p = &clip[i].x;
        before = clip[i] = draw_position(in, t, &before);
        for (int k = 0; k < 4; k++) s->tame &= p[k] >= -1e12f && p[k] <= 1e12f;
    }
    guard_seal(clip);
    return clip;
}

static const float *draw_attributes(fuzz_input *in, draw_scene *s, int right)
{
    uint32_t kind = fuzz_byte(in);
    size_t n = s->vertex_count > 0 && s->p.varyings > 0 ? (size_t)s->vertex_count : 0;
    float *a;
    n = s->p.varyings > SHADE_MAX_VARYINGS ? 0 : n * (size_t)s->p.varyings;
    s->tame &= kind % 8 != 7;
    a = (float *)guard_take(n * 4, right);
    for (size_t i = 0; i < n; i++) {
        if (kind % 8 == 7 && i < 64) a[i] = fuzz_float(in);
        else a[i] = (float)((i * 37 + kind * 11) % 101) / 50;
    }
    guard_seal(a);
    return a;
}

static const uint32_t *draw_indices(fuzz_input *in, draw_scene *s, int right, int *bad)
{
    uint32_t *indices;
    if (s->index_count <= 0) return fuzz_one_in(in, 2) ? NULL : (uint32_t *)guard_take(0, right);
    indices = (uint32_t *)guard_take((size_t)s->index_count * 4, right);
    for (int i = 0; i < s->index_count; i++) {
        uint32_t k = fuzz_byte(in);
        indices[i] = s->vertex_count > 0 ? k % (uint32_t)s->vertex_count : 0;
        if (k == 255) indices[i] = (uint32_t)fuzz_wild_int(in);
        *bad |= indices[i] >= (uint32_t)s->vertex_count;
    }
    guard_seal(indices);
    return indices;
}

/* texture: where that of the level of detail is kept */
/* SHADE_OK, or what the pipeline is refused with */
static shade_result draw_pipeline(fuzz_input *in, shade_pipeline *p, shade_texture *texture)
{
    int bad = 0;
    uint32_t kind = fuzz_byte(in);
    p->varyings = fuzz_int(in, 0, 5);
    if (kind == 255) p->varyings = fuzz_int(in, -2, SHADE_MAX_VARYINGS + 2);
    else if (kind > 240) p->varyings = SHADE_MAX_VARYINGS;
    p->interpolation = (shade_interpolation)fuzz_enum(in, 3, &bad);
    fuzz_raster(in, &p->raster, &bad);
    p->raster.depth_read_only = kind & 1;
    p->raster.depth_zero_to_one = kind >> 1 & 1;
    p->may_discard = kind >> 2 & 1;
    if (kind & 8) p->raster.depth_bias = fuzz_float(in);
    if (kind & 16) {
        p->lod_varying = fuzz_one_in(in, 8) ? fuzz_wild_int(in) : fuzz_int(in, 0, 4);
        *texture = texture_open(in, 40, 0);
        p->lod_texture = kind & 32 ? texture : NULL;
    }
    if (bad || p->varyings < 0 || p->varyings > SHADE_MAX_VARYINGS ||
        !fuzz_finite(p->raster.depth_bias)) return SHADE_ERROR_STATE;
    if (p->lod_texture && (!texture_is_good(texture) || p->lod_varying < 0 ||
                           p->lod_varying >= p->varyings - 1)) return SHADE_ERROR_TEXTURE;
    return SHADE_OK;
}

int LLVMFuzzerTestOneInput(const uint8_t *data, size_t size)
{
    fuzz_input in = { data, data + size };
    picture pic;
    uint32_t kind = fuzz_byte(&in);
    int bad_index = 0;
    shade_result want, pipeline;
    picture_open(&in, &pic, 40);
    draw_scene s = { .p.vertex = draw_vertex };
    s.p.uniforms = &s;
    s.pipeline = &s.p;
    s.tame = 1;
    s.kind = (int)(fuzz_byte(&in) % DRAW_KINDS);
    s.p.fragment = s.kind == DRAW_DEPTH_ONLY ? NULL : draw_fragment;
    pipeline = draw_pipeline(&in, &s.p, &s.texture);
    s.vertex_count = fuzz_int(&in, 3, DRAW_VERTICES);
    s.index_count = 3 * fuzz_int(&in, 1, DRAW_TRIANGLES);
    if (fuzz_one_in(&in, 32)) s.vertex_count = fuzz_int(&in, -2, 2);
    if (fuzz_one_in(&in, 32)) s.index_count = fuzz_int(&in, -4, 8);
    if (!(kind & 8)) s.indices = draw_indices(&in, &s, kind & 1, &bad_index);
    else if (s.index_count > s.vertex_count) s.index_count = s.vertex_count / 3 * 3;
    s.clip = draw_positions(&in, &s, &pic.target, kind >> 1 & 1);
    s.attribute = draw_attributes(&in, &s, kind >> 2 & 1);
    if (!s.indices) bad_index = s.index_count > s.vertex_count;
    want = pic.want;
    if (want == SHADE_OK && (s.index_count < 0 || s.vertex_count < 0)) want = SHADE_ERROR_MESH;
    if (want == SHADE_OK) want = pipeline;
    if (want == SHADE_OK && (s.index_count % 3 || bad_index)) want = SHADE_ERROR_INDEX;
    if (kind == 0xF0) {
        s.p.vertex = NULL;
        want = SHADE_ERROR_ARGUMENT;
    }
    if (kind == 0xF1) {
        s.pipeline = NULL;
        want = SHADE_ERROR_ARGUMENT;
    }
    picture_try(&in, &pic, draw_call,
                s.kind == DRAW_SIEVE && s.p.may_discard ? NULL : draw_otherwise, &s, want,
                s.index_count / 3, s.p.raster.depth_read_only);
    picture_close(&pic);
    guard_close();
    return 0;
}
