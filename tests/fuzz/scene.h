/* scene.h - meshes with lights, materials, maps and a state made of an input, and what holds of the
   fragments that their shaders get. */
#ifndef FUZZ_SCENE_H
#define FUZZ_SCENE_H
#include "picture.h"

enum { MESH_LIGHTS = 5 };

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

static void mesh_arrays(fuzz_input *in, mesh_scene *s, float most, int vertices, int triangles,
                        int *bad_index)
{
    shade_mesh *m = &s->m;
    uint32_t kind = fuzz_byte(in), ends = fuzz_byte(in);
    int n = m->vertex_count = fuzz_int(in, 3, vertices), right = (int)ends;
    m->positions = mesh_array(in, n, 3, most, &m->position_stride, right & 1);
    if (kind & 1) m->normals = mesh_array(in, n, 3, most, &m->normal_stride, right >> 1 & 1);
    if (kind & 2) m->texcoords = mesh_array(in, n, 2, most, &m->texcoord_stride, right >> 2 & 1);
    if (kind & 4)
        m->colors = mesh_array(in, n, 3, most > 0 ? 100.0f : 0, &m->color_stride, right >> 3 & 1);
    if (kind & 8) {
        uint32_t *indices;
        m->index_count = 3 * fuzz_int(in, 0, triangles);
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

/* Everything but the target, of at most so many vertices and triangles: SHADE_OK, or what a draw
   has to say of it.  most: bound of all numbers; 0: none. */
static shade_result mesh_open(fuzz_input *in, mesh_scene *s, uint32_t kind, float most,
                              int vertices, int triangles)
{
    int bad = 0, bad_index = 0, good_light, good_map = 1;
    memset(s, 0, sizeof *s);
    s->mesh = &s->m;
    s->state = &s->s;
    s->tame = most > 0;
    s->s.model = fuzz_matrix(in, most);
    s->s.view = fuzz_matrix(in, most);
    s->s.projection = fuzz_matrix(in, most);
    s->s.shading = (shade_shading)fuzz_enum(in, 3, &bad);
    fuzz_raster(in, &s->s.raster, &bad);
    s->s.raster.depth_zero_to_one = kind >> 1 & 1;
    s->s.raster.depth_read_only = kind >> 2 & 1;
    if (kind & 8) {
        s->s.raster.depth_bias = fuzz_float(in);
        bad |= !fuzz_finite(s->s.raster.depth_bias);
    }
    good_light = mesh_lighting(in, s, most);
    mesh_arrays(in, s, most, vertices, triangles, &bad_index);
    if (kind & 16) good_map = mesh_map(in, s, most > 0);
    bad |= !mesh_alpha(in, s);
    if (!bad) bad = !mesh_shader(in, s);
    return bad ? SHADE_ERROR_STATE : !good_light ? SHADE_ERROR_LIGHTS
               : !good_map ? SHADE_ERROR_TEXTURE : bad_index ? SHADE_ERROR_INDEX : SHADE_OK;
}
#endif
