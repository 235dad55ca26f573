/* explained.h - random draws, and what is wrong with what shade_explain says about them.

   Each sentence is held against pictures that are drawn again, whole and by shaders that write what
   it is about: where it says that there is no light, no pixel may be lit, and where it says that
   nothing is in view, no pixel may be covered.  Whoever includes this defines explained_pick(n),
   which gives a number from 0 to n - 1. */
#ifndef EXPLAINED_H
#define EXPLAINED_H

#include "examples/shared/teapot.h"

enum { EX_WIDTH = 40, EX_HEIGHT = 28, EX_PIXELS = EX_WIDTH * EX_HEIGHT, EX_VERTICES = 176,
       EX_INDICES = 720, EX_LAMPS = 3 };

typedef struct explained {
    shade_target target;
    shade_mesh mesh;
    shade_draw_state state;
    shade_material material;
    shade_light lamp[EX_LAMPS];
    shade_texture map;
    shade_chunk chunk[2];
    shade_vec3 position[EX_VERTICES], normal[EX_VERTICES], color[EX_VERTICES];
    shade_vec2 texcoord[EX_VERTICES];
    uint32_t index[EX_INDICES];
    uint8_t texel[16];
    float pixel[4 * EX_PIXELS], depth[EX_PIXELS];
    float before[EX_PIXELS];               /* depth before the draw */
    float value[4 * EX_PIXELS], order[EX_PIXELS];    /* of pictures that are drawn again */
    shade_result result;
    shade_stats stats;                     /* of the draw */
} explained;

static int ex_one_in(int n) { return explained_pick(n) == n - 1; }
static float ex_from(float low, float high)
{
    return low + (high - low) * (float)explained_pick(257) / 256;
}
static shade_vec3 ex_vec3(float low, float high)
{
    const float x = ex_from(low, high), y = ex_from(low, high);
    return shade_v3(x, y, ex_from(low, high));
}

/* ---- random draws ---------------------------------------------------------------------------- */

static void ex_ball(explained *e)
{
    enum { RINGS = 6, SECTORS = 8 };
    int n = 0;
    for (int j = 0; j <= RINGS; j++)
        for (int i = 0; i <= SECTORS; i++) {
            const float a = (float)(i % SECTORS) * 0.785398f, b = (float)j * 0.523599f;
            const float r = j % RINGS ? sinf(b) : 0;
            e->position[j * (SECTORS + 1) + i] = shade_v3(r * sinf(a), cosf(b), r * cosf(a));
        }
    for (uint32_t j = 0; j < RINGS; j++)
        for (uint32_t i = 0; i < SECTORS; i++) {
            const uint32_t a = j * (SECTORS + 1) + i, b = a + SECTORS + 1;
            const uint32_t corner[6] = { a, b, b + 1, a, b + 1, a + 1 };
            memcpy(e->index + n, corner, sizeof corner);
            n += 6;
        }
    e->mesh.vertex_count = (RINGS + 1) * (SECTORS + 1);
    e->mesh.index_count = n;
}
static void ex_floor(explained *e)
{
    static const shade_vec3 ground[4] = { { -3, 0, 3 }, { 3, 0, 3 }, { 3, 0, -3 }, { -3, 0, -3 } };
    static const uint32_t corner[6] = { 0, 1, 2, 0, 2, 3 };
    memcpy(e->position, ground, sizeof ground);
    memcpy(e->index, corner, sizeof corner);
    e->mesh.vertex_count = 4;
    e->mesh.index_count = 6;
}
static void ex_triangles(explained *e)
{
    e->mesh.vertex_count = e->mesh.index_count = 3 * (1 + explained_pick(6));
    for (int i = 0; i < e->mesh.vertex_count; i++) {
        e->position[i] = ex_vec3(-1.5f, 1.5f);
        e->index[i] = (uint32_t)i;
    }
}
static void ex_shape(explained *e)
{
    shade_mesh *m = &e->mesh;
    const int kind = explained_pick(4);
    if (kind == 0) ex_floor(e);
    else if (kind == 1) ex_triangles(e);
    else ex_ball(e);
    m->positions = &e->position[0].x;
    m->indices = e->index;
    for (int i = 0; i < m->vertex_count; i++)
        e->normal[i] = kind ? e->position[i] : shade_v3(0, 1, 0);
}
/* Gives the mesh other arrays, which may be wrong. */
static void ex_arrays(explained *e)
{
    shade_mesh *m = &e->mesh;
    for (int i = 0; i < m->vertex_count; i++)
        e->texcoord[i] = shade_v2(e->position[i].x, e->position[i].z);
    if (ex_one_in(16)) e->position[explained_pick(m->vertex_count)].y = NAN;
    if (ex_one_in(24)) m->index_count = 3;
    if (ex_one_in(6))
        for (int i = 0; i < m->index_count; i += 3) {
            const uint32_t k = e->index[i];
            e->index[i] = e->index[i + 1];
            e->index[i + 1] = k;
        }
    m->normals = explained_pick(3) ? &e->normal[0].x : NULL;
    if (ex_one_in(8)) {
        const float k = ex_one_in(3) ? NAN : -(float)explained_pick(2);
        for (int i = 0; i < m->vertex_count; i++) e->normal[i] = shade_scale(e->normal[i], k);
    }
    if (ex_one_in(4)) {
        const float most = ex_one_in(3) ? 255.0f : (float)explained_pick(2);
        for (int i = 0; i < m->vertex_count; i++) e->color[i] = ex_vec3(0, most);
        m->colors = &e->color[0].x;
    }
    if (ex_one_in(3)) m->texcoords = &e->texcoord[0].x;
    if (ex_one_in(6)) {
        const int triangles = m->index_count / 3, left = explained_pick(3);
        m->chunks = e->chunk;
        m->chunk_count = 2;
        shade_mesh_chunks(m, (triangles + 1) / 2, e->chunk, 2, NULL);
        if (triangles < 2) m->chunk_count = 1;
        if (left == 1) e->chunk[0].count = explained_pick(2);
        if (left == 2) e->chunk[0].high = e->chunk[0].low = ex_vec3(-4, 4);
    }
}

static void ex_camera(explained *e)
{
    shade_draw_state *s = &e->state;
    const shade_vec3 eye = ex_vec3(-4, 4);
    const float fovy = ex_from(0.3f, 1.2f), aspect = ex_one_in(12) ? 1 : 40 / 28.0f;
    shade_mat4 *p = &s->projection;
    s->view = shade_mat4_look_at(eye, ex_vec3(-1, 1), shade_v3(0, 1, 0));
    *p = shade_mat4_perspective(fovy, aspect, ex_from(0.05f, 2), ex_from(3, 30));
    switch (explained_pick(12)) {
    case 0: *p = shade_mat4_ortho(-3, 3, -2.1f, 2.1f, 0.1f, 9); break;
    case 1:
        *p = shade_mat4_perspective_reversed(fovy, aspect, 0.1f);
        s->raster.depth_zero_to_one = !ex_one_in(6);
        s->raster.depth_test = SHADE_COMPARE_GREATER;
        break;
    case 2:                                /* w = 1 - z/k */
        *p = shade_mat4_identity();
        p->col[2] = shade_v4(0, 0, ex_from(-0.4f, 0), -1 / ex_from(1, 5));
        if (ex_one_in(2)) memset(&s->view, 0, sizeof s->view);
        break;
    case 3:
        for (int k = 0; k < 4; k++) p->col[k] = shade_scale4(p->col[k], -1 / p->col[3].z);
        break;
    case 4:
        if (ex_one_in(2)) *p = shade_mat4_transpose(*p);
        else s->view = shade_mat4_transpose(s->view);
        break;
    case 5:
        if (ex_one_in(2)) s->view = shade_mat4_inverse(s->view);
        else memset(ex_one_in(2) ? p : &s->view, 0, sizeof *p);
        break;
    case 6:
        s->view = shade_mat4_mul(shade_mat4_scaling(ex_vec3(-2, 2)), s->view);
        break;
    default: break;
    }
    if (ex_one_in(2)) return;
    s->model = shade_mat4_rotation(ex_from(-3, 3), ex_vec3(-1, 1));
    if (ex_one_in(3)) s->model = shade_mat4_mul(s->model, shade_mat4_scaling(ex_vec3(-1.5f, 1.5f)));
    if (ex_one_in(8)) s->model = shade_mat4_scaling(shade_v3(ex_from(0, 0.04f), 0.02f, 0.02f));
    if (ex_one_in(8)) s->model = shade_mat4_scaling(shade_v3(1, 0, 1));
    if (ex_one_in(3)) s->model.col[3] = shade_v4(ex_from(-6, 6), ex_from(-2, 2), ex_from(-9, 9), 1);
}

static void ex_lamp(shade_light *l)
{
    const shade_vec3 at = ex_vec3(-4, 4), aim = ex_vec3(-1, 1);
    const float power[] = { 1, 0.2f, 0.01f, 0, 3, 255 };
    const float bright = power[explained_pick(6)];
    const shade_vec3 color = shade_scale(ex_vec3(0.2f, 1), bright);
    const int kind = explained_pick(3);
    if (kind == 0) *l = shade_directional_light(aim, color);
    if (kind == 1) *l = shade_point_light(at, color);
    if (kind == 2)
        *l = shade_spot_light(at, ex_one_in(2) ? aim : shade_neg(at), ex_from(0.02f, 0.9f),
                              ex_one_in(2) ? 0 : ex_from(0, 60), color);
    if (ex_one_in(3)) l->quadratic = ex_from(0, ex_one_in(3) ? 300.0f : 2.0f);
    if (ex_one_in(6)) l->linear = ex_from(0, 40);
    if (ex_one_in(8)) l->ambient = ex_vec3(0, 0.2f);
    if (ex_one_in(8)) l->diffuse = shade_v3(0, 0, 0);
    if (ex_one_in(6)) l->specular = shade_v3(0, 0, 0);
}
static void ex_light(explained *e)
{
    shade_lighting *l = &e->state.lighting;
    l->light_count = explained_pick(EX_LAMPS + 1);
    for (int i = 0; i < EX_LAMPS; i++) ex_lamp(&e->lamp[i]);
    l->lights = l->light_count || ex_one_in(2) ? e->lamp : NULL;
    if (ex_one_in(40)) l->light_count = -1;
    if (ex_one_in(4)) l->ambient = ex_vec3(0, ex_one_in(4) ? 1.5f : 0.2f);
    if (ex_one_in(4)) l->model = (shade_model)explained_pick(6);
    if (ex_one_in(4)) l->flags = (unsigned)explained_pick(64);
    if (ex_one_in(8)) l->terms = (unsigned)explained_pick(16);
    e->state.shading = (shade_shading)(explained_pick(2) * explained_pick(3));
    if (ex_one_in(3)) return;
    e->state.material = &e->material;
    e->material.diffuse = shade_scale(ex_vec3(0, 1), ex_one_in(4) ? 0.01f : 1.0f);
    if (explained_pick(3)) e->material.ambient = e->material.diffuse;
    if (ex_one_in(6)) e->material.diffuse = shade_v3(0, 0, 0);
    if (ex_one_in(3)) e->material.specular = ex_vec3(0, 0.5f);
    if (ex_one_in(10)) e->material.emission = ex_vec3(0, 0.5f);
    e->material.shininess = ex_from(0, 80);
}

static void ex_white(const void *uniforms, const shade_fragments *SHADE_RESTRICT in,
                     shade_colors *SHADE_RESTRICT out)
{
    const explained *e = (const explained *)uniforms;
    (void)in;
    SHADE_EACH_LANE(i) { out->color[0][i] = 1; }
    SHADE_EACH_LANE(i) { out->discard[i] = e->map.width == 1; }
}
static void ex_surface(explained *e)
{
    shade_draw_state *s = &e->state;
    shade_texture *t = &e->map;
    const int black = ex_one_in(5), clear = ex_one_in(5);
    for (int k = 0; k < 16; k++) {
        e->texel[k] = (uint8_t)explained_pick(256);
        if (k % 4 < 3 ? black : clear) e->texel[k] = (uint8_t)explained_pick(2);
    }
    t->pixels = e->texel;
    t->width = t->height = 1 + explained_pick(2);
    t->stride = 2;
    if (ex_one_in(8)) t->filter = SHADE_FILTER_TRILINEAR;
    if (ex_one_in(16)) t->mipmap_count = 1;
    if (ex_one_in(3)) s->diffuse_map = t;
    if (ex_one_in(5)) s->transparency = ex_one_in(4) ? 1 : ex_from(0, 1);
    if (ex_one_in(8)) s->alpha_cutoff = ex_from(0, 1);
    s->raster.cull = (shade_cull)(explained_pick(2) * explained_pick(3));
    if (ex_one_in(6)) s->raster.depth_test = (shade_compare)explained_pick(6);
    if (ex_one_in(3)) s->raster.blend = (shade_blend)explained_pick(3);
    if (ex_one_in(6)) s->raster.depth_read_only = 1;
    if (ex_one_in(10)) s->raster.depth_bias = ex_from(-1, 1);
    if (ex_one_in(24)) {
        s->fragment = ex_white;
        s->uniforms = e;
        s->shading = SHADE_SHADING_PER_FRAGMENT;
    }
}

static void ex_target(explained *e)
{
    shade_target *t = &e->target;
    t->width = EX_WIDTH;
    t->height = EX_HEIGHT;
    t->color = e->pixel;
    t->depth = e->depth;
    t->format = ex_one_in(3) ? (shade_format)explained_pick(5) : SHADE_FORMAT_RGBA8;
    t->srgb = explained_pick(2);
    t->dither = ex_one_in(4);
    if (ex_one_in(6)) t->depth = NULL;
    else if (ex_one_in(6)) t->color = NULL;
    if (ex_one_in(6)) {                    /* a band */
        t->clip_y = explained_pick(EX_HEIGHT);
        t->clip_width = EX_WIDTH;
        t->clip_height = 1 + explained_pick(12);
    } else if (ex_one_in(8)) {
        t->clip_x = explained_pick(EX_WIDTH);
        t->clip_y = explained_pick(EX_HEIGHT);
        t->clip_width = 1 + explained_pick(20);
        t->clip_height = 1 + explained_pick(20);
    } else if (ex_one_in(8)) {             /* a strip */
        t->row_offset = explained_pick(EX_HEIGHT);
        t->row_count = 1 + explained_pick(EX_HEIGHT - t->row_offset);
    }
}

/* The first program of the README, with the teapot of few triangles. */
static void ex_first_program(explained *e)
{
    shade_draw_state *s = &e->state;
    shade_target *t = &e->target;
    teapot_build(2, &e->position[0].x, &e->normal[0].x, NULL, e->index);
    e->mesh.positions = &e->position[0].x;
    e->mesh.normals = &e->normal[0].x;
    e->mesh.indices = e->index;
    e->mesh.vertex_count = teapot_vertex_count(2);
    e->mesh.index_count = teapot_index_count(2);
    e->lamp[0] = shade_point_light(shade_v3(4, 6, 5), shade_v3(1, 1, 1));
    e->material = shade_linear_material(shade_preset_material(SHADE_PRESET_GOLD));
    s->view = shade_mat4_look_at(shade_v3(0, 4, 8), shade_v3(0, 1.4f, 0), shade_v3(0, 1, 0));
    s->projection = shade_mat4_perspective(0.7f, 40 / 28.0f, 0.1f, 100);
    s->material = &e->material;
    s->lighting.lights = e->lamp;
    s->lighting.light_count = 1;
    t->width = EX_WIDTH;
    t->height = EX_HEIGHT;
    t->color = e->pixel;
    t->depth = e->depth;
    t->srgb = 1;
}
static void ex_state(explained *e, int first)
{
    memset(e, 0, sizeof *e);
    if (first) ex_first_program(e);
    else ex_shape(e);
    if (!first || ex_one_in(5)) ex_arrays(e);
    if (!first || ex_one_in(5)) ex_camera(e);
    if (!first || ex_one_in(5)) ex_light(e);
    if (!first || ex_one_in(5)) ex_surface(e);
    if (!first || ex_one_in(5)) ex_target(e);
}

/* Draws anything, or the first program with some of its fields changed, after another mesh at
   times. */
static void ex_draw(explained *e, int first)
{
    float clear;
    ex_state(e, first);
    clear = e->state.raster.depth_test == SHADE_COMPARE_GREATER ? 0.0f : 1.0f;
    if (ex_one_in(16)) clear = (float)explained_pick(3) / 2;
    for (int i = 0; i < EX_PIXELS; i++) e->depth[i] = clear;
    if (ex_one_in(6)) {
        shade_draw_state other = e->state;
        other.model = shade_mat4_translation(ex_vec3(-2, 2));
        shade_draw_mesh(&e->target, &e->mesh, &other, NULL);
    }
    memset(e->pixel, 0, sizeof e->pixel);
    memcpy(e->before, e->depth, sizeof e->before);
    e->result = shade_draw_mesh(&e->target, &e->mesh, &e->state, &e->stats);
}

/* ---- pictures that are drawn again ----------------------------------------------------------- */

/* How many pixels of the picture are lit, and how many of them have a channel at its end. */
static int ex_lit(const explained *e, int *clipped)
{
    const shade_target *t = &e->target;
    int lit = 0;
    *clipped = 0;
    for (int i = 0; i < EX_PIXELS && t->color; i++) {
        const uint8_t *b = (const uint8_t *)e->pixel + 4 * i;
        uint16_t two;
        memcpy(&two, (const uint8_t *)e->pixel + 2 * i, 2);
        if (t->format == SHADE_FORMAT_RGB565_SWAPPED) two = (uint16_t)(two >> 8 | two << 8);
        if (t->format == SHADE_FORMAT_RGBA32F)
            lit += e->pixel[4 * i] > 0 || e->pixel[4 * i + 1] > 0 || e->pixel[4 * i + 2] > 0;
        else if (t->format >= SHADE_FORMAT_RGB565) {
            lit += two != 0;
            *clipped += (two & 31) == 31 || (two >> 5 & 63) == 63 || two >> 11 == 31;
        } else {
            lit += b[0] || b[1] || b[2];
            *clipped += b[0] == 255 || b[1] == 255 || b[2] == 255;
        }
    }
    return lit;
}

/* Draws the mesh again onto black, with these states and the depth of before. */
static int ex_lit_again(const explained *e, const shade_mesh *mesh, const shade_draw_state *state,
                        int whole)
{
    static explained again;
    shade_target *t = &again.target;
    int clipped;
    again = *e;
    memset(again.pixel, 0, sizeof again.pixel);
    memcpy(again.depth, e->before, sizeof again.depth);
    t->color = again.pixel;
    if (e->target.depth) t->depth = again.depth;
    if (whole) {
        t->depth = NULL;
        t->row_offset = t->row_count = t->clip_x = t->clip_y = t->clip_width = t->clip_height = 0;
    }
    shade_draw_mesh(t, mesh, state, NULL);
    return ex_lit(&again, &clipped);
}

/* What is changed, one after the other, until a black mesh is lit. */
enum ex_cure { EX_EACH, EX_TERMS, EX_COLORS, EX_MATERIAL, EX_SIDES, EX_DISTANCE };

/* With all changes up to this one, does any fragment of the whole picture have light?  Those of one
   pixel are added, so that none hides another. */
static int ex_helps(const explained *e, enum ex_cure cure)
{
    static const shade_material white = { .ambient = { 1, 1, 1 }, .diffuse = { 1, 1, 1 },
                                          .specular = { 1, 1, 1 } };    /* the widest highlight */
    shade_mesh mesh = e->mesh;
    shade_draw_state s = e->state;
    shade_texture map = e->map;
    shade_light lamp[EX_LAMPS];
    uint8_t texel[16];
    memcpy(lamp, e->lamp, sizeof lamp);
    memcpy(texel, e->texel, sizeof texel);
    for (int k = 0; k < 16; k++) texel[k] = k % 4 == 3 || cure >= EX_COLORS ? 255 : texel[k];
    map.pixels = texel;
    if (s.diffuse_map) s.diffuse_map = &map;
    s.transparency = s.alpha_cutoff = 0;
    s.lighting.lights = lamp;
    s.raster.blend = SHADE_BLEND_ADD;
    s.shading = SHADE_SHADING_PER_FRAGMENT;
    if (cure > EX_EACH && e->state.shading == SHADE_SHADING_PER_FACE) mesh.normals = NULL;
    if (cure >= EX_TERMS) {
        if (s.lighting.model > SHADE_MODEL_PHONG) s.lighting.model = SHADE_MODEL_BLINN_PHONG;
        s.lighting.terms = 0;
    }
    if (cure >= EX_COLORS) mesh.colors = NULL;
    if (cure >= EX_MATERIAL) s.material = s.material ? &white : NULL;
    if (cure >= EX_SIDES) s.lighting.flags |= SHADE_FLAG_TWO_SIDED_ABS;
    for (int k = 0; k < EX_LAMPS; k++) {
        shade_light *l = &lamp[k];
        if (cure >= EX_DISTANCE) l->constant = l->linear = l->quadratic = l->spot_exponent = 0;
    }
    return ex_lit_again(e, &mesh, &s, 1);
}

/* The stats of a draw of depth alone, where each fragment passes: of the whole picture or of the
   clip rectangle. */
static shade_stats ex_cover(explained *e, const shade_mesh *mesh, const shade_draw_state *state,
                            int whole)
{
    shade_target t = e->target;
    shade_draw_state s = *state;
    shade_stats stats;
    t.color = NULL;
    t.depth = e->order;
    if (whole) t.row_offset = t.row_count = t.clip_x = t.clip_y = t.clip_width = t.clip_height = 0;
    s.raster.depth_test = SHADE_COMPARE_ALWAYS;
    if (s.fragment) s.alpha_cutoff = 0;
    s.fragment = NULL;
    shade_draw_mesh(&t, mesh, &s, &stats);
    return stats;
}

/* What shaders write about a fragment: depth, and 2 more where the normal is no direction; facing,
   and 2 more where the normal turns away from the eye; 1 and the alpha of the texel, negative where
   no cone holds the point; 1, and more where light is on the side of the normal. */
typedef struct ex_asked {
    const explained *e;
    shade_vec3 eye;
    int holes;              /* are texels below the cut-off left out? */
} ex_asked;
static shade_mat4 ex_or_identity(shade_mat4 m)
{
    for (int k = 0; k < 4; k++) {
        const shade_vec4 c = m.col[k];
        if (c.x != 0 || c.y != 0 || c.z != 0 || c.w != 0) return m;
    }
    return shade_mat4_identity();
}
static int ex_is_greater(const shade_draw_state *s)
{
    return s->raster.depth_test == SHADE_COMPARE_GREATER ||
           s->raster.depth_test == SHADE_COMPARE_GREATER_EQUAL;
}
/* The centre of projection.  Of parallel rays it is far away, on the side whose depths the test
   takes for near. */
static shade_vec3 ex_eye(const explained *e)
{
    const shade_draw_state *s = &e->state;
    const shade_mat4 m = shade_mat4_mul(ex_or_identity(s->projection), ex_or_identity(s->view));
    const float toward = e->target.depth && ex_is_greater(s) ? 1.0f : -1.0f;
    const shade_vec4 at = shade_mat4_transform(shade_mat4_inverse(m), shade_v4(0, 0, toward, 0));
    const float scale = at.w == 0 ? 1e6f : 1 / at.w;
    return shade_v3(at.x * scale, at.y * scale, at.z * scale);
}
static void ex_write(const void *uniforms, const shade_fragments *SHADE_RESTRICT in,
                     shade_colors *SHADE_RESTRICT out)
{
    const ex_asked *a = (const ex_asked *)uniforms;
    const shade_draw_state *s = &a->e->state;
    const shade_lighting *l = &s->lighting;
    const int mapped = s->diffuse_map && a->e->mesh.texcoords;
    float texel[4 * SHADE_LANES];
    if (mapped)
        shade_sample_lanes(s->diffuse_map, in->varying[SHADE_VARYING_TEXCOORD],
                           in->varying[SHADE_VARYING_TEXCOORD + 1],
                           s->diffuse_map->mipmap_count ? in->lod : NULL, texel);
    for (int i = 0; i < in->count; i++) {
        const shade_vec3 p = shade_v3(in->varying[0][i], in->varying[1][i], in->varying[2][i]);
        const shade_vec3 n = shade_v3(in->varying[3][i], in->varying[4][i], in->varying[5][i]);
        const float alpha = mapped ? texel[3 * SHADE_LANES + i] : 1;
        float cone = 0, before = 0;
        for (int k = 0; k < l->light_count; k++) {
            shade_light lamp = l->lights[k];
            shade_vec3 to;
            const float most = shade_light_at(&lamp, p, &to, NULL) *
                               (lamp.diffuse.x + lamp.diffuse.y + lamp.diffuse.z);
            if (most * shade_dot(shade_normalize(n), to) > before)
                before = most * shade_dot(shade_normalize(n), to);
            lamp.constant = lamp.linear = lamp.quadratic = lamp.spot_exponent = 0;
            if (most > 0 && shade_light_at(&lamp, p, NULL, NULL) > 0) cone = 1;
        }
        out->color[0][i] = in->z[i] + (shade_length(n) > 0 ? 0.0f : 2.0f);
        out->color[1][i] = (float)in->front[i] +
                           (shade_dot(n, shade_sub(a->eye, p)) < 0 ? 2.0f : 0.0f);
        out->color[2][i] = cone > 0 ? 1 + alpha : -1 - alpha;
        out->color[3][i] = 1 + before;
        if (a->holes && !(alpha * (1 - s->transparency) >= s->alpha_cutoff))
            out->color[3][i] = 0;
    }
}
/* Draws that into value; alpha is 0 where nothing is drawn.  As the draw saw its depth, or with
   tested in the whole picture, where LESS (1), GREATER (2) or no test (0) decides. */
static void ex_values(explained *e, shade_cull cull, int tested)
{
    shade_target t = e->target;
    shade_draw_state s = e->state;
    ex_asked asked;
    asked.e = e;
    asked.eye = ex_eye(e);
    memset(e->value, 0, sizeof e->value);
    t.format = SHADE_FORMAT_RGBA32F;
    t.color = e->value;
    for (int i = 0; i < EX_PIXELS; i++) e->order[i] = tested == 2 ? 0.0f : 1.0f;
    if (tested < 0) memcpy(e->order, e->before, sizeof e->order);
    if (e->target.depth || tested > 0) t.depth = e->order;
    if (tested >= 0) {
        t.row_offset = t.row_count = t.clip_x = t.clip_y = t.clip_width = t.clip_height = 0;
        s.raster.depth_test = tested == 2 ? SHADE_COMPARE_GREATER_EQUAL : SHADE_COMPARE_LESS_EQUAL;
        s.raster.depth_read_only = 0;
        s.raster.depth_bias = 0;
        if (!tested) s.raster.depth_test = SHADE_COMPARE_ALWAYS;
    }
    s.raster.cull = cull;
    s.raster.blend = SHADE_BLEND_REPLACE;
    asked.holes = tested <= 0 && s.alpha_cutoff > 0 && !s.fragment;
    s.transparency = 0;
    s.alpha_cutoff = asked.holes ? 0.5f : 0.0f;
    s.shading = SHADE_SHADING_PER_FRAGMENT;
    s.fragment = ex_write;
    s.uniforms = &asked;
    shade_draw_mesh(&t, &e->mesh, &s, NULL);
}

/* ---- what each sentence must mean ------------------------------------------------------------ */

/* A corner of the mesh in clip space that is on the other side of a plane: 0 for far, 1 for w. */
static int ex_corner_inside(const explained *e, int plane)
{
    const shade_mat4 model = ex_or_identity(e->state.model);
    const shade_mat4 m = ex_or_identity(e->state.projection);
    const shade_mat4 view = ex_or_identity(e->state.view);
    for (int i = 0; i < e->mesh.index_count; i++) {
        const shade_vec3 p = e->position[e->index[i]];
        shade_vec4 c = shade_mat4_transform(model, shade_v4(p.x, p.y, p.z, 1));
        c = shade_mat4_transform(m, shade_mat4_transform(view, c));
        if (plane == 0 && c.z < c.w - 1e-4f) return 1;
        if (plane == 1 && c.w > 1e-4f) return 1;
    }
    return 0;
}

/* The part of the pixels of value of which a bit is right: at least so many eighths. */
static int ex_part(const explained *e, int (*right)(const float *), int eighths)
{
    int all = 0, n = 0;
    for (int i = 0; i < EX_PIXELS; i++) {
        if (e->value[4 * i + 3] == 0) continue;
        all++;
        n += right(e->value + 4 * i);
    }
    return n && n * 8 >= all * eighths;
}
static int ex_is_turned(const float *v) { return v[1] == 3; }
static int ex_has_normal(const float *v) { return v[0] < 2; }
static int ex_in_cone(const float *v) { return v[2] > 0; }
static int ex_before_lamp(const float *v) { return v[3] > 1.3f; }

/* Is the nearer of two points, along some ray, the one of greater depth? */
static int ex_near_is_greater(const explained *e)
{
    for (float z = -64; z <= 64; z += 0.25f) {
        const shade_vec4 a = shade_mat4_transform(e->state.projection, shade_v4(0, 0, z, 1));
        const shade_vec4 b = shade_mat4_transform(e->state.projection, shade_v4(0, 0, 2 * z, 1));
        if (a.w > 0 && b.w > a.w) return b.z / b.w < a.z / a.w;
    }
    return 0;
}
static int ex_far_wins(const explained *e)
{
    return ex_is_greater(&e->state) != ex_near_is_greater(e);
}
/* Is a back before the front-facing ones in most of their pixels? */
static int ex_is_inside_out(explained *e)
{
    static float mask[EX_PIXELS];
    const int greater = e->target.depth ? ex_is_greater(&e->state) : ex_near_is_greater(e);
    const int tested = greater ? 2 : 1;
    int all = 0, n = 0;
    ex_values(e, SHADE_CULL_BACK, tested);
    for (int i = 0; i < EX_PIXELS; i++) mask[i] = e->value[4 * i + 3];
    ex_values(e, SHADE_CULL_NONE, tested);
    for (int i = 0; i < EX_PIXELS; i++) {
        all += mask[i] != 0;
        n += mask[i] != 0 && (int)e->value[4 * i + 1] % 2 == 0;
    }
    return n && n * 2 >= all;
}
/* Is there a pixel whose last fragment is not the nearest? */
static int ex_is_overdrawn(explained *e)
{
    static float last[EX_PIXELS];
    int n = 0;
    ex_values(e, e->state.raster.cull, 0);
    for (int i = 0; i < EX_PIXELS; i++) last[i] = e->value[4 * i];
    ex_values(e, e->state.raster.cull, ex_near_is_greater(e) ? 2 : 1);
    for (int i = 0; i < EX_PIXELS; i++) n += last[i] != e->value[4 * i];
    return n > 0;
}

enum ex_claim {
    EX_ALPHA, EX_NO_TERM, EX_BLACK_COLORS, EX_BLACK_MATERIAL, EX_NO_LAMP, EX_NO_COUNT, EX_INSIDE,
    EX_BEHIND, EX_BAD_NORMALS, EX_COARSE, EX_FAINT, EX_CONE, EX_NO_COLOR,
    EX_ALL_BEHIND, EX_AMBIENT_NORMALS, EX_AMBIENT_COUNT, EX_AMBIENT_ALONE, EX_CLIPPED, EX_TURNED,
    EX_NOTHING, EX_FAR, EX_EYE, EX_AREA, EX_CULLED, EX_CULLED_INSIDE, EX_BOXES, EX_FEWER, EX_CUT,
    EX_REJECTED, EX_SOME, EX_CLIP, EX_UNCLEARED, EX_HIDDEN, EX_DISCARDED, EX_FAR_WINS,
    EX_INSIDE_OUT, EX_OVERDRAWN, EX_ROWS, EX_VIEW_ROWS, EX_SWAPPED, EX_DEGENERATE, EX_NO_FLAG,
    EX_COUNT, EX_EMPTY, EX_SCALES, EX_ASPECT, EX_TEXCOORDS, EX_MIPMAPS, EX_UNKNOWN
};
static const struct { const char *words; enum ex_claim claim; } ex_claims[] = {
    { "Alpha is 0", EX_ALPHA }, { "leaves out every term", EX_NO_TERM },
    { "mesh.colors, or the texels", EX_BLACK_COLORS },
    { "state.material reflects", EX_BLACK_MATERIAL },
    { "There is no light", EX_NO_LAMP }, { "and lighting.ambient is dark", EX_NO_COUNT },
    { "sees faces whose normals point away", EX_INSIDE }, { "Every lamp is behind", EX_BEHIND },
    { "mesh.normals are zero or NaN, so that", EX_BAD_NORMALS },
    { "state.shading lights", EX_COARSE }, { "Attenuation, or", EX_FAINT },
    { "No cone of the lights", EX_CONE }, { "The lights have no colour", EX_NO_COLOR },
    { "every lamp is behind", EX_ALL_BEHIND },
    { "because mesh.normals are zero", EX_AMBIENT_NORMALS },
    { "arrives: lighting.light_count is 0", EX_AMBIENT_COUNT },
    { "which shows no form", EX_AMBIENT_ALONE }, { "lit is clipped", EX_CLIPPED },
    { "mesh.normals point away from the eye", EX_TURNED },
    { "outside of the cube", EX_NOTHING }, { "beside the picture, before near", EX_NOTHING },
    { "beyond the far plane", EX_FAR }, { "lies behind the eye", EX_EYE },
    { "nearer than the near plane", EX_NOTHING }, { "the inverse of state.view", EX_NOTHING },
    { "covers the centre of a pixel nowhere", EX_NOTHING }, { "has an area", EX_AREA },
    { "raster.cull leaves out", EX_CULLED_INSIDE }, { "raster.cull is SHADE_CULL", EX_CULLED },
    { "No box of mesh.chunks", EX_BOXES }, { "sum to fewer", EX_FEWER },
    { "above every alpha", EX_CUT }, { "make them so", EX_REJECTED },
    { "Some triangles are left out", EX_SOME }, { "beside the clip rectangle", EX_CLIP },
    { "target.depth holds 0", EX_UNCLEARED }, { "What target.depth holds", EX_HIDDEN },
    { "state.fragment discards", EX_DISCARDED }, { "does not fit state.proj", EX_FAR_WINS },
    { "inside out", EX_INSIDE_OUT }, { "target.depth is NULL", EX_OVERDRAWN },
    { "state.projection looks transposed", EX_ROWS },
    { "state.view looks transposed", EX_VIEW_ROWS },
    { "state.view holds a projection", EX_SWAPPED },
    { "what cameras give", EX_DEGENERATE }, { "perspective_reversed, which", EX_NO_FLAG },
    { "light_count is negative", EX_COUNT }, { "clip rectangle is empty", EX_EMPTY },
    { "state.view scales", EX_SCALES }, { "The aspect of", EX_ASPECT },
    { "diffuse_map is set while", EX_TEXCOORDS }, { "but no mipmaps", EX_MIPMAPS }
};

static int ex_is_dark(const explained *e)
{
    int clipped;
    return e->target.color && !ex_lit(e, &clipped);
}

static int ex_is_whole(const explained *e)
{
    return !e->target.clip_width && !e->target.row_count && e->stats.fragments;
}

/* Has the mesh normals, and is none in view a direction? */
static int ex_has_bad_normals(explained *e)
{
    int good;
    ex_values(e, e->state.raster.cull, -1);
    good = ex_part(e, ex_has_normal, 0);
    if (e->state.shading) good = shade_length(e->normal[e->index[0]]) > 0;
    return e->mesh.normals && e->state.shading != SHADE_SHADING_PER_FACE && !good;
}
/* Does the box around the mesh hold the eye of state.view? */
static int ex_eye_inside(const explained *e)
{
    const shade_mat4 m = shade_mat4_mul(ex_or_identity(e->state.view),
                                        ex_or_identity(e->state.model));
    const shade_vec4 eye = shade_mat4_inverse(m).col[3];
    shade_vec3 low = shade_v3(1e9f, 1e9f, 1e9f), high = shade_neg(low);
    for (int i = 0; i < e->mesh.index_count; i++) {
        const shade_vec3 p = e->position[e->index[i]];
        if (!(p.y < 1e9f)) continue;
        low = shade_min(low, p);
        high = shade_max(high, p);
    }
    low = shade_sub(shade_v3(eye.x, eye.y, eye.z), low);
    high = shade_sub(high, shade_v3(eye.x, eye.y, eye.z));
    low = shade_min(low, high);
    if (shade_mat4_determinant(m) == 0) return 0;
    return low.x > -1e-3f && low.y > -1e-3f && low.z > -1e-3f;
}
/* Is the depth of before at the near end of the test, or NaN, wherever the mesh covers a pixel? */
static int ex_is_uncleared(explained *e)
{
    const float near = ex_is_greater(&e->state) ? 1.0f : 0.0f;
    shade_target *t = &e->target;
    int n = 0;
    t->depth = NULL;
    ex_values(e, e->state.raster.cull, -1);
    t->depth = e->depth;
    for (int i = 0; i < EX_PIXELS; i++)
        n += e->value[4 * i + 3] != 0 && e->before[i] != near && e->before[i] == e->before[i];
    return !n;
}
static float ex_most(shade_vec3 color) { return fmaxf(color.x, fmaxf(color.y, color.z)); }
/* Is no pixel lit, whatever of a colour, a map and ambient light it has? */
static int ex_only_ambient(const explained *e)
{
    shade_draw_state s = e->state;
    s.lighting.terms = (s.lighting.terms ? s.lighting.terms : 15u) &
                       (SHADE_TERM_DIFFUSE | SHADE_TERM_SPECULAR);
    return !ex_lit_again(e, &e->mesh, &s, 0);
}
/* Has every pixel alpha below a hundredth, in a picture that alpha dims? */
static int ex_is_clear(explained *e)
{
    if (e->state.raster.blend == SHADE_BLEND_REPLACE) return 0;
    ex_values(e, e->state.raster.cull, -1);
    for (int i = 0; i < EX_PIXELS; i++) {
        const float *v = e->value + 4 * i, alpha = (fabsf(v[2]) - 1) * (1 - e->state.transparency);
        if (v[3] != 0 && alpha > 0.2f) return 0;
    }
    return 1;
}

static int ex_is_rigid(shade_mat4 m)
{
    for (int j = 0; j < 3; j++)
        for (int k = 0; k < 3; k++) {
            const shade_vec4 a = m.col[j], b = m.col[k];
            if (fabsf(a.x * b.x + a.y * b.y + a.z * b.z - (float)(j == k)) > 0.005f) return 0;
        }
    return m.col[0].w == 0 && m.col[1].w == 0 && m.col[2].w == 0 && m.col[3].w == 1;
}
/* What repeats the numbers of fields. */
static int ex_field(const explained *e, enum ex_claim claim)
{
    const shade_draw_state *s = &e->state;
    const shade_mat4 view = ex_or_identity(s->view), p = ex_or_identity(s->projection);
    const shade_target *t = &e->target;
    const float wide = p.col[0].x * (float)t->width, high = p.col[1].y * (float)t->height;
    switch (claim) {
    case EX_VIEW_ROWS: return view.col[3].x == 0 && view.col[3].y == 0 && view.col[3].z == 0;
    case EX_SWAPPED: return !ex_is_rigid(view);
    case EX_DEGENERATE: return p.col[0].x == 0 && p.col[0].y == 0 && p.col[0].w == 0;
    case EX_NO_FLAG: return p.col[2].z == 0 && !s->raster.depth_zero_to_one;
    case EX_COUNT: return s->lighting.light_count < 0;
    case EX_EMPTY: return t->clip_x >= t->width || t->clip_y >= t->height;
    case EX_SCALES: return !ex_is_rigid(view);
    case EX_ASPECT:
        return p.col[3].w == 0 && fabsf(fabsf(wide) - fabsf(high)) > 0.02f * fabsf(wide);
    case EX_TEXCOORDS: return s->diffuse_map && !e->mesh.texcoords && t->color;
    case EX_MIPMAPS: return s->diffuse_map && s->diffuse_map->width > 1 && !s->diffuse_map->mipmaps;
    default: return 0;
    }
}
/* What is said of a picture without light: each needs the change that it names. */
static int ex_black(explained *e, enum ex_claim claim)
{
    const shade_draw_state *s = &e->state;
    const shade_lighting *l = &s->lighting;
    const int sided = s->shading || (l->flags & SHADE_FLAG_TWO_SIDED);
    float most = 0;
    switch (claim) {
    case EX_ALPHA: return ex_is_clear(e);
    case EX_NO_TERM: return ex_helps(e, EX_TERMS) && (l->terms || l->model);
    case EX_BLACK_COLORS:
        return ex_helps(e, EX_COLORS) && (e->mesh.colors || (e->mesh.texcoords && s->diffuse_map));
    case EX_BLACK_MATERIAL: return ex_helps(e, EX_MATERIAL) && s->material;
    case EX_NO_LAMP: return !l->lights && ex_most(l->ambient) < 0.1f;
    case EX_NO_COUNT: return l->light_count <= 0 && ex_most(l->ambient) < 0.1f;
    case EX_INSIDE: return ex_helps(e, EX_SIDES) && ex_eye_inside(e);
    case EX_BEHIND:
        ex_values(e, s->raster.cull, -1);
        return ex_helps(e, EX_SIDES) && (sided || !ex_part(e, ex_before_lamp, 0));
    case EX_BAD_NORMALS: return ex_has_bad_normals(e);
    case EX_COARSE: return ex_helps(e, EX_EACH) && s->shading;
    case EX_FAINT: return ex_helps(e, EX_DISTANCE);
    case EX_CONE:
        ex_values(e, s->raster.cull, -1);
        return !ex_part(e, ex_in_cone, 0);
    default:
        for (int k = 0; k < l->light_count; k++) most = fmaxf(most, ex_most(e->lamp[k].diffuse));
        return most < 0.3f;
    }
}
/* Whether a sentence is true of the draw. */
static int ex_true(explained *e, const char *said)
{
    const shade_draw_state *s = &e->state;
    const shade_lighting *l = &s->lighting;
    shade_mesh bare = e->mesh;
    shade_draw_state open = *s;
    enum ex_claim claim = EX_UNKNOWN;
    int clipped, lit;
    bare.chunks = NULL;
    bare.chunk_count = 0;
    open.raster.cull = SHADE_CULL_NONE;
    for (size_t k = 0; k < sizeof ex_claims / sizeof *ex_claims && claim == EX_UNKNOWN; k++)
        if (strstr(said, ex_claims[k].words)) claim = ex_claims[k].claim;
    if (claim <= EX_NO_COLOR) return ex_is_dark(e) && ex_black(e, claim);
    switch (claim) {
    case EX_ALL_BEHIND: return ex_only_ambient(e) && ex_helps(e, EX_SIDES);
    case EX_AMBIENT_NORMALS:
        return ex_only_ambient(e) && ex_has_bad_normals(e);
    case EX_AMBIENT_COUNT: return ex_only_ambient(e) && l->light_count <= 0 && l->lights;
    case EX_AMBIENT_ALONE: return ex_only_ambient(e) && !l->lights;
    case EX_CLIPPED: lit = ex_lit(e, &clipped); return clipped * 5 >= lit * 4;
    case EX_TURNED:
        ex_values(e, s->raster.cull, e->target.depth && ex_is_whole(e) ? -1 : 0);
        return ex_part(e, ex_is_turned, 6);
    case EX_FAR: return !ex_cover(e, &e->mesh, s, 1).fragments && !ex_corner_inside(e, 0);
    case EX_EYE: return !ex_cover(e, &e->mesh, s, 1).fragments && !ex_corner_inside(e, 1);
    case EX_NOTHING: return !ex_cover(e, &bare, &open, 1).fragments;
    case EX_AREA:
        return !ex_cover(e, &bare, &open, 1).drawn && ex_cover(e, &bare, &open, 1).culled > 0;
    case EX_CULLED_INSIDE:
        if (!ex_eye_inside(e)) return 0;
        return !ex_cover(e, &bare, s, 1).fragments && ex_cover(e, &bare, &open, 1).fragments;
    case EX_CULLED:
        return !ex_cover(e, &bare, s, 1).fragments && ex_cover(e, &bare, &open, 1).fragments;
    case EX_BOXES: return !ex_cover(e, &e->mesh, s, 1).fragments &&
                          ex_cover(e, &bare, s, 1).fragments;
    case EX_FEWER:
        return ex_cover(e, &e->mesh, s, 1).triangles < ex_cover(e, &bare, s, 1).triangles;
    case EX_CUT:
        lit = ex_cover(e, &bare, &open, 1).fragments > 0;
        open.alpha_cutoff = 0;
        return !lit && ex_cover(e, &bare, &open, 1).fragments;
    case EX_REJECTED:
        return ex_cover(e, &bare, s, 1).rejected == ex_cover(e, &bare, s, 1).triangles;
    case EX_SOME: return ex_cover(e, &e->mesh, s, 1).rejected > 0;
    case EX_CLIP:
        return !ex_cover(e, &e->mesh, s, 0).fragments && ex_cover(e, &e->mesh, s, 1).fragments;
    case EX_UNCLEARED: return !e->stats.fragments && ex_is_uncleared(e);
    case EX_HIDDEN: return !e->stats.fragments && ex_cover(e, &e->mesh, s, 0).fragments;
    case EX_DISCARDED: return !e->stats.fragments && s->fragment;
    case EX_FAR_WINS: return ex_far_wins(e);
    case EX_INSIDE_OUT: return ex_is_inside_out(e);
    case EX_OVERDRAWN: return !e->target.depth && ex_is_overdrawn(e);
    case EX_ROWS:
        open.alpha_cutoff = 0;
        open.projection = shade_mat4_transpose(open.projection);
        return !ex_cover(e, &e->mesh, s, 1).fragments && ex_cover(e, &bare, &open, 1).fragments;
    default: return ex_field(e, claim);
    }
}

/* Draws something and has it explained, with stats and without.  Returns the sentence that is not
   so, or NULL.  first: as ex_draw has it. */
static const char *ex_false_sentence(explained *e, int first)
{
    ex_draw(e, first);
    for (int with = 0; with < 2; with++) {
        const char *said = shade_explain(&e->target, &e->mesh, &e->state, with ? &e->stats : NULL);
        if (!said || (e->result && !*said)) return "(nothing)";
        if (*said && !e->result && !ex_true(e, said)) return said;
    }
    return NULL;
}
#endif
