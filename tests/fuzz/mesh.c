/* mesh.c - shade_draw_mesh: any arrays and strides, lights, materials, maps and cameras. */
#include "picture.h"

enum { MESH_VERTICES = 64, MESH_TRIANGLES = 64, MESH_LIGHTS = 5 };

typedef struct mesh_scene {
    const shade_mesh *mesh;              /* the fields below, or NULL */
    const shade_draw_state *state;
    shade_mesh m;
    shade_draw_state s;
    shade_material material;
    shade_light lights[MESH_LIGHTS];
    shade_texture map, levels[20];
    const uint32_t *wide;                /* the list of m.indices16 in 32 bits */
    int tame;
} mesh_scene;

static int mesh_corners(const shade_mesh *m)
{
    return m->indices || m->indices16 ? m->index_count : m->vertex_count;
}

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
    mesh_explained(s, target, stats, result);
    return result;
}

/* A fragment shader of the state: what it is handed, then colours and holes made of it. */
static void mesh_check_fragment(const mesh_scene *s, const shade_fragments *in, int i)
{
    const int last = in->count - 1, tame = s->tame;
    HOLDS(in->primitive[i] < (uint32_t)mesh_corners(&s->m) / 3);
    HOLDS(in->front[i] <= 1 && in->z[i] >= 0 && in->z[i] <= 1);
    HOLDS(in->x[i] > 0 && in->y[i] > 0);
    if (!s->m.texcoords || !s->s.diffuse_map) HOLDS(in->lod[i] == 0);
    for (int k = 0; k < 11; k++) {
        const float v = in->varying[k][i];
        HOLDS(!tame || fuzz_finite(v));
        if (tame && k > 5 && k < 9 && !s->m.colors) HOLDS(v > 0.999f && v < 1.001f);
        if (tame && k > 8 && !s->m.texcoords) HOLDS(v == 0);
        HOLDS(i <= last || fuzz_same(v, in->varying[k][last]));
    }
}

static void mesh_fragment(const void *uniforms, const shade_fragments *SHADE_RESTRICT in,
                          shade_colors *SHADE_RESTRICT out)
{
    const mesh_scene *s = (const mesh_scene *)uniforms;
    HOLDS(in->count >= 1 && in->count <= SHADE_LANES);
    for (int i = 0; i < SHADE_LANES; i++) {
        mesh_check_fragment(s, in, i);
        for (int k = 0; k < 4; k++) out->color[k][i] = in->varying[3 + k][i];
        out->discard[i] = in->varying[10][i] > 0.5f ? in->primitive[i] : 0;
    }
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

/* An array that ends with its last vector, with its stride; noise between the vectors. */
static const float *mesh_array(fuzz_input *in, int count, int floats, float most, int *stride,
                               int right)
{
    uint32_t kind = fuzz_byte(in), shared = fuzz_byte(in);
    size_t step, bytes;
    float *a, last[4] = { 0, 0, 0, 0 };
    *stride = kind & 1 ? (floats + (int)(kind >> 5)) * 4 : 0;
    if ((kind & 0x1F) == 0x1E) *stride = 4 * (int)(kind >> 6);    /* overlapping vectors */
    step = *stride ? (size_t)*stride : (size_t)floats * 4;
    bytes = count > 0 ? ((size_t)count - 1) * step + (size_t)floats * 4 : 0;
    a = (float *)guard_take(bytes, right);
    fuzz_noise(a, most > 0 ? 0 : bytes, kind);
    if (most > 0) memset(a, 0, bytes);
    for (int i = 0; i < count; i++)
        for (int k = 0; k < floats; k++) {
            float f = shared & 1 && i % 3 == 2 ? last[k] : fuzz_value(in, most);
            memcpy((char *)a + (size_t)i * step + 4 * (size_t)k, &f, 4);
            last[k] = f;
        }
    guard_seal(a);
    return a;
}

static shade_light mesh_light(fuzz_input *in, float most)
{
    shade_light l;
    uint32_t kind = fuzz_byte(in);
    shade_vec3 p = fuzz_vec3(in, most), c = fuzz_vec3(in, most > 0 ? 100.0f : 0);
    if (kind & 1) l = shade_directional_light(p, c);
    else if (kind & 2) l = shade_point_light(p, c);
    else {
        shade_vec3 aim = fuzz_vec3(in, most);
        float cutoff = fuzz_value(in, most);
        l = shade_spot_light(p, aim, cutoff, fuzz_value(in, most), c);
    }
    if (kind & 4) l.ambient = fuzz_vec3(in, most > 0 ? 100.0f : 0);
    if (kind & 8) {
        l.constant = fuzz_value(in, most);
        l.linear = fuzz_value(in, most);
    }
    if (kind & 16) l.quadratic = fuzz_value(in, most);
    if (most > 0) {                      /* attenuation without a pole */
        l.constant = l.constant < 0 ? 1 : l.constant;
        l.linear = l.linear < 0 ? 0 : l.linear;
        l.quadratic = l.quadratic < 0 ? 0 : l.quadratic;
        if (l.constant < 1 && (l.linear > 0 || l.quadratic > 0)) l.constant = 1;
    }
    if ((kind & 32) && !(most > 0)) l.position.w = fuzz_float(in);
    return l;
}

static int mesh_lighting(fuzz_input *in, mesh_scene *s, float most)    /* 0: refused */
{
    shade_lighting *l = &s->s.lighting;
    uint32_t kind = fuzz_byte(in);
    int bad = 0, no_cutoff = 0;
    l->model = (shade_model)fuzz_enum(in, 6, &bad);
    l->flags = fuzz_byte(in);
    l->terms = kind & 1 ? fuzz_byte(in) : 0;
    if (kind & 2) l->ambient = fuzz_vec3(in, most > 0 ? 100.0f : 0);
    if (kind & 4) l->cool = fuzz_vec3(in, most > 0 ? 100.0f : 0);
    if (kind & 8) l->warm = fuzz_vec3(in, most > 0 ? 100.0f : 0);
    l->light_count = fuzz_int(in, 0, MESH_LIGHTS);
    l->lights = s->lights;
    for (int i = 0; i < l->light_count; i++) {
        s->lights[i] = mesh_light(in, most);
        no_cutoff |= s->lights[i].spot_cos_cutoff != s->lights[i].spot_cos_cutoff;
    }
    if (kind == 0xF0) l->light_count = -l->light_count;
    bad |= no_cutoff && l->light_count > 0;
    if ((kind & 0xF0) == 0xE0) {
        l->lights = NULL;
        bad |= l->light_count > 0;
    }
    if (!(kind & 16)) return !bad;
    s->s.material = &s->material;
    if (fuzz_one_in(in, 2)) {
        s->material = shade_preset_material((shade_preset)fuzz_int(in, -1, SHADE_PRESET_COUNT));
        return !bad;
    }
    s->material.emission = fuzz_vec3(in, most > 0 ? 100.0f : 0);
    s->material.ambient = fuzz_vec3(in, most > 0 ? 100.0f : 0);
    s->material.diffuse = fuzz_vec3(in, most > 0 ? 100.0f : 0);
    s->material.specular = fuzz_vec3(in, most > 0 ? 100.0f : 0);
    s->material.shininess = fuzz_value(in, most);
    return !bad;
}

static int mesh_map(fuzz_input *in, mesh_scene *s, int tame)    /* 0: refused */
{
    uint32_t kind = fuzz_byte(in);
    s->s.diffuse_map = &s->map;
    s->map = texture_open(in, 20, tame);
    if (kind & 1) {
        size_t bytes = texture_is_good(&s->map)
                           ? shade_mipmap_bytes(s->map.width, s->map.height, s->map.format) : 0;
        void *memory = guard_take((bytes + 3) & ~(size_t)3, kind >> 1 & 1);
        HOLDS((shade_build_mipmaps(&s->map, s->levels, memory, bytes) == SHADE_OK) ==
              texture_is_good(&s->map));
        if (!tame && (kind & 4) && s->map.mipmap_count > 1)    /* a level of another kind */
            s->levels[fuzz_int(in, 0, s->map.mipmap_count - 1)] = texture_open(in, 10, 0);
    }
    if (!tame && (kind & 8)) {
        s->map.mipmaps = NULL;
        s->map.mipmap_count = fuzz_wild_int(in);
    }
    return !s->m.texcoords || texture_is_good(&s->map);
}

static void mesh_arrays(fuzz_input *in, mesh_scene *s, float most, int *bad_index)
{
    shade_mesh *m = &s->m;
    uint32_t kind = fuzz_byte(in), ends = fuzz_byte(in);
    int n = m->vertex_count = fuzz_int(in, 3, MESH_VERTICES), right = (int)ends;
    m->positions = mesh_array(in, n, 3, most, &m->position_stride, right & 1);
    if (kind & 1) m->normals = mesh_array(in, n, 3, most, &m->normal_stride, right >> 1 & 1);
    if (kind & 2) m->texcoords = mesh_array(in, n, 2, most, &m->texcoord_stride, right >> 2 & 1);
    if (kind & 4)
        m->colors = mesh_array(in, n, 3, most > 0 ? 100.0f : 0, &m->color_stride, right >> 3 & 1);
    if (kind & 8) {
        uint32_t *indices;
        m->index_count = 3 * fuzz_int(in, 0, MESH_TRIANGLES);
        if (fuzz_one_in(in, 64)) m->index_count++;
        indices = (uint32_t *)guard_take((size_t)m->index_count * 4, right >> 4 & 1);
        for (int i = 0; i < m->index_count; i++) {
            uint32_t k = fuzz_byte(in);
            indices[i] = k == 255 ? (uint32_t)fuzz_wild_int(in) : k % (uint32_t)n;
            *bad_index |= indices[i] >= (uint32_t)n;
        }
        guard_seal(indices);
        s->wide = indices;
        if (kind & 32) m->indices16 = guard_narrow(indices, m->index_count, right >> 5 & 1);
        if (!m->indices16) m->indices = indices;
        *bad_index |= m->index_count % 3;
    } else {
        if (!(kind & 16)) m->vertex_count = n / 3 * 3;
        m->index_count = fuzz_wild_int(in);    /* says nothing without indices */
        *bad_index = m->vertex_count % 3;
    }
}

static int mesh_alpha(fuzz_input *in, mesh_scene *s) /* 0: refused */
{
    uint32_t kind = fuzz_byte(in);
    float *t = &s->s.transparency, *cutoff = &s->s.alpha_cutoff;
    if (kind & 1) *t = kind & 8 ? fuzz_float(in) : (float)fuzz_byte(in) / 255;
    if (kind & 2) *cutoff = kind & 16 ? fuzz_float(in) : (float)fuzz_byte(in) / 255;
    if ((kind & 7) == 7) *cutoff = 1 - *t; /* equal alpha is drawn */
    return *t >= 0 && *t <= 1 && *cutoff >= 0 && *cutoff <= 1;
}

static int mesh_shader(fuzz_input *in, mesh_scene *s)    /* 0: refused */
{
    if (!fuzz_one_in(in, 4)) return 1;
    s->s.fragment = mesh_fragment;
    s->s.uniforms = s;
    if (!fuzz_one_in(in, 8)) s->s.shading = SHADE_SHADING_PER_FRAGMENT;
    return s->s.shading == SHADE_SHADING_PER_FRAGMENT;
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

static void mesh_stats(const shade_stats *t)
{
    HOLDS(t->skipped >= 0 && t->fragments >= 0);
    HOLDS(t->triangles == t->skipped + t->culled + t->clipped + t->rejected + t->drawn);
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
    mesh_stats(&stats);
    HOLDS(stats.triangles == (want == SHADE_OK ? sum : 0));
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
    mesh_stats(&with);
    HOLDS(with.triangles == triangles && with.fragments == without.fragments);
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
    int bad = 0, bad_index = 0, good_light, good_map = 1, triangles;
    shade_result want;
    picture_open(&in, &pic, 32);
    pic.one_width = !(most > 0);
    want = pic.want;
    memset(&s, 0, sizeof s);
    s.mesh = &s.m;
    s.state = &s.s;
    s.tame = most > 0;
    s.s.model = fuzz_matrix(&in, most);
    s.s.view = fuzz_matrix(&in, most);
    s.s.projection = fuzz_matrix(&in, most);
    s.s.shading = (shade_shading)fuzz_enum(&in, 3, &bad);
    s.s.raster.cull = (shade_cull)fuzz_enum(&in, 3, &bad);
    s.s.raster.depth_test = (shade_compare)fuzz_enum(&in, 6, &bad);
    s.s.raster.blend = (shade_blend)fuzz_enum(&in, 3, &bad);
    s.s.raster.depth_zero_to_one = kind >> 1 & 1;
    s.s.raster.depth_read_only = kind >> 2 & 1;
    if (kind & 8) {
        s.s.raster.depth_bias = fuzz_float(&in);
        bad |= !fuzz_finite(s.s.raster.depth_bias);
    }
    good_light = mesh_lighting(&in, &s, most);
    mesh_arrays(&in, &s, most, &bad_index);
    if (kind & 16) good_map = mesh_map(&in, &s, most > 0);
    bad |= !mesh_alpha(&in, &s);
    if (!bad) bad = !mesh_shader(&in, &s);
    triangles = mesh_corners(&s.m) / 3;
    if (want == SHADE_OK && bad) want = SHADE_ERROR_STATE;
    if (want == SHADE_OK && !good_light) want = SHADE_ERROR_LIGHTS;
    if (want == SHADE_OK && !good_map) want = SHADE_ERROR_TEXTURE;
    if (want == SHADE_OK && bad_index) want = SHADE_ERROR_INDEX;
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
