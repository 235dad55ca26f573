/* explained.h - what is false of what shade_explain says about a draw.

   claims[] has a row for each sentence: what must be so of the pixels that the picture shows, and
   the change that the sentence advises.  The change is made, the picture drawn again, and the
   pixels must change as promised.  Nothing here is known to shade_explain: corners are transformed
   in double precision, and pictures are drawn by the public interface.

   Whoever includes this defines explained_pick(n), which gives a number from 0 to n - 1. */
#ifndef EXPLAINED_H
#define EXPLAINED_H

#include "../unit/mistakes.h"

/* ---- states: random ones, and sensible scenes with none, one or two of the mistakes ---------- */

enum { EX_WIDTH = 24, EX_HEIGHT = 16, EX_PIXELS = 4 * EX_WIDTH * EX_HEIGHT };

typedef struct explained {
    stage s;                     /* as generated */
    shade_mat4 other;            /* model of the mesh that is drawn before; zero: none is */
    const char *made[2];         /* mistakes of an ordinary state */
    stage right;                 /* the same without the mistake, if there is one */
    int has_right;
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
static float ex_most(shade_vec3 c) { return fmaxf(c.x, fmaxf(c.y, c.z)); }

/* ---- meshes of both kinds of states ---------------------------------------------------------- */

static void ex_quads(stage *s, const shade_vec3 *corner, int quads)
{
    static const uint32_t two[6] = { 0, 1, 2, 0, 2, 3 };
    for (int i = 0; i < quads * 4; i++) {
        const shade_vec3 *q = corner + i / 4 * 4;
        s->position[i] = corner[i];
        s->normal[i] = shade_face_normal(q[0], q[1], q[2]);
        s->texcoord[i] = shade_v2((float)(i >> 1 & 1), (float)((i + 1) >> 1 & 1));
    }
    for (int i = 0; i < quads * 6; i++) s->index[i] = two[i % 6] + (uint32_t)(i / 6 * 4);
    s->mesh.vertex_count = quads * 4;
    s->mesh.index_count = quads * 6;
}
static void ex_floor(stage *s)
{
    static const shade_vec3 ground[4] = { { -3, 0, 3 }, { 3, 0, 3 }, { 3, 0, -3 }, { -3, 0, -3 } };
    ex_quads(s, ground, 1);
}
static void ex_box(stage *s)
{
    shade_vec3 corner[24];
    for (int f = 0; f < 6; f++)
        for (int k = 0; k < 4; k++) {
            const float side = f & 1 ? 1.0f : -1.0f, u = k == 1 || k == 2 ? side : -side;
            const float v = k > 1 ? 1.0f : -1.0f, at[3] = { side, u, v };
            const int a = f / 2;
            corner[f * 4 + k] = shade_v3(at[(3 - a) % 3], at[(4 - a) % 3], at[(5 - a) % 3]);
        }
    ex_quads(s, corner, 6);
}
/* A surface of 4 x 4 squares, open below. */
static void ex_hills(stage *s)
{
    shade_vec3 corner[64];
    float high[5][5];
    for (int k = 0; k < 25; k++) high[k / 5][k % 5] = ex_from(-0.4f, 0.4f);
    for (int k = 0; k < 64; k++) {
        const int x = k / 4 % 4 + (k % 4 == 1 || k % 4 == 2), z = k / 16 + (k % 4 > 1);
        corner[k] = shade_v3((float)x - 2, high[z][x], 2 - (float)z);
    }
    ex_quads(s, corner, 16);
}
static void ex_triangles(stage *s)
{
    s->mesh.vertex_count = s->mesh.index_count = 3 * (1 + explained_pick(6));
    for (int i = 0; i < s->mesh.vertex_count; i++) {
        s->position[i] = ex_vec3(-1.5f, 1.5f);
        s->normal[i] = s->position[i];
        s->texcoord[i] = shade_v2(s->position[i].x, s->position[i].z);
        s->index[i] = (uint32_t)i;
    }
}
static void ex_teapot(stage *s)
{
    teapot_build(2, &s->position[0].x, &s->normal[0].x, &s->texcoord[0].x, s->index);
    s->mesh.vertex_count = teapot_vertex_count(2);
    s->mesh.index_count = teapot_index_count(2);
    for (int i = 0; i < s->mesh.vertex_count; i++)
        s->position[i] = shade_scale(shade_sub(s->position[i], shade_v3(0, 1.4f, 0)), 0.4f);
}
static void ex_target(stage *s)
{
    stage_begin(s);
    s->target.width = EX_WIDTH;
    s->target.height = EX_HEIGHT;
    s->target.stride = 0;
    stage_ball(s, 6, 8);
}

/* ---- random states --------------------------------------------------------------------------- */

static void ex_random_mesh(stage *s)
{
    shade_mesh *m = &s->mesh;
    const int kind = explained_pick(4);
    if (kind == 0) ex_floor(s);
    if (kind == 1) ex_triangles(s);
    if (ex_one_in(16)) s->position[explained_pick(m->vertex_count)].y = NAN;
    if (ex_one_in(24)) m->index_count = 3;
    if (ex_one_in(6)) stage_turn(s, 0);
    if (ex_one_in(3)) m->normals = NULL;
    if (ex_one_in(8)) {
        const float k = ex_one_in(3) ? NAN : -(float)explained_pick(2);
        for (int i = 0; i < m->vertex_count; i++) s->normal[i] = shade_scale(s->normal[i], k);
    }
    if (ex_one_in(4)) {
        const float most = ex_one_in(3) ? 255.0f : (float)explained_pick(2);
        for (int i = 0; i < m->vertex_count; i++) s->color[i] = ex_vec3(0, most);
        m->colors = &s->color[0].x;
    }
    if (ex_one_in(3)) m->texcoords = &s->texcoord[0].x;
    if (ex_one_in(6)) {
        const int left = explained_pick(3);
        stage_chunks(s);
        if (left == 1) s->chunks[0].count = explained_pick(2);
        if (left == 2) s->chunks[0].high = s->chunks[0].low = ex_vec3(-4, 4);
    }
}
static void ex_random_camera(stage *s)
{
    shade_draw_state *d = &s->state;
    shade_mat4 *p = &d->projection;
    s->eye = ex_vec3(-4, 4);
    s->center = ex_vec3(-1, 1);
    s->fovy = ex_from(0.3f, 1.2f);
    s->aspect = ex_one_in(12) ? 1 : (float)EX_WIDTH / EX_HEIGHT;
    s->z_near = ex_from(0.05f, 2);
    s->z_far = ex_from(3, 30);
    stage_look(s);
    switch (explained_pick(12)) {
    case 0: *p = shade_mat4_ortho(-3, 3, -2, 2, 0.1f, 9); break;
    case 1:
        stage_reverse(s, 0.1f);
        d->raster.depth_zero_to_one = !ex_one_in(6);
        break;
    case 2:                                /* w = 1 - z/k */
        *p = shade_mat4_identity();
        p->col[2] = shade_v4(0, 0, ex_from(-0.4f, 0), -1 / ex_from(1, 5));
        if (ex_one_in(2)) memset(&d->view, 0, sizeof d->view);
        break;
    case 3:
        for (int k = 0; k < 4; k++) p->col[k] = shade_scale4(p->col[k], -1 / p->col[3].z);
        break;
    case 4:
        if (ex_one_in(2)) *p = shade_mat4_transpose(*p);
        else d->view = shade_mat4_transpose(d->view);
        break;
    case 5:
        if (ex_one_in(2)) d->view = shade_mat4_inverse(d->view);
        else memset(ex_one_in(2) ? p : &d->view, 0, sizeof *p);
        break;
    case 6: d->view = shade_mat4_mul(shade_mat4_scaling(ex_vec3(-2, 2)), d->view); break;
    default: break;
    }
    if (ex_one_in(2)) return;
    d->model = shade_mat4_rotation(ex_from(-3, 3), ex_vec3(-1, 1));
    if (ex_one_in(3)) d->model = shade_mat4_mul(d->model, shade_mat4_scaling(ex_vec3(-1.5f, 1.5f)));
    if (ex_one_in(8)) d->model = shade_mat4_scaling(shade_v3(ex_from(0, 0.04f), 0.02f, 0.02f));
    if (ex_one_in(8)) d->model = shade_mat4_scaling(shade_v3(1, 0, 1));
    if (ex_one_in(3)) d->model.col[3] = shade_v4(ex_from(-6, 6), ex_from(-2, 2), ex_from(-9, 9), 1);
}
static void ex_random_lamp(shade_light *l)
{
    static const float power[6] = { 1, 0.2f, 0.01f, 0, 3, 255 };
    const shade_vec3 at = ex_vec3(-4, 4), aim = ex_vec3(-1, 1);
    const shade_vec3 color = shade_scale(ex_vec3(0.2f, 1), power[explained_pick(6)]);
    const int kind = explained_pick(3);
    if (kind == 0) *l = shade_directional_light(aim, color);
    if (kind == 1) *l = shade_point_light(at, color);
    if (kind == 2)
        *l = shade_spot_light(at, ex_one_in(2) ? aim : shade_neg(at), ex_from(0.02f, 0.9f),
                              ex_one_in(2) ? 0 : ex_from(0, 60), color);
    if (ex_one_in(3)) l->quadratic = ex_from(0, ex_one_in(3) ? 300.0f : 2.0f);
    if (ex_one_in(6)) l->linear = ex_from(0, 40);
    if (ex_one_in(8)) l->ambient = ex_vec3(0, 0.2f);
    if (ex_one_in(8)) l->diffuse = BLACK;
    if (ex_one_in(6)) l->specular = BLACK;
}
static void ex_random_light(stage *s)
{
    shade_lighting *l = &s->state.lighting;
    shade_material *m = &s->material;
    l->light_count = explained_pick(STAGE_LAMPS + 1);
    for (int i = 0; i < STAGE_LAMPS; i++) ex_random_lamp(&s->lamps[i]);
    l->lights = l->light_count || ex_one_in(2) ? s->lamps : NULL;
    if (ex_one_in(40)) l->light_count = -1;
    if (ex_one_in(4)) l->ambient = ex_vec3(0, ex_one_in(4) ? 1.5f : 0.2f);
    if (ex_one_in(4)) l->model = (shade_model)explained_pick(6);
    if (ex_one_in(4)) l->flags = (unsigned)explained_pick(64);
    if (ex_one_in(8)) l->terms = (unsigned)explained_pick(16);
    s->state.shading = (shade_shading)(explained_pick(2) * explained_pick(3));
    if (ex_one_in(3)) s->state.material = NULL;
    m->diffuse = shade_scale(ex_vec3(0, 1), ex_one_in(4) ? 0.01f : 1.0f);
    if (explained_pick(3)) m->ambient = m->diffuse;
    if (ex_one_in(6)) m->diffuse = BLACK;
    if (ex_one_in(3)) m->specular = ex_vec3(0, 0.5f);
    if (ex_one_in(10)) m->emission = ex_vec3(0, 0.5f);
    m->shininess = ex_from(0, 80);
}
static void ex_random_surface(stage *s)
{
    shade_draw_state *d = &s->state;
    shade_texture *t = &s->map;
    const int black = ex_one_in(5), clear = ex_one_in(5);
    for (int k = 0; k < 16; k++)
        s->texel[k] = (uint8_t)explained_pick((k % 4 < 3 ? black : clear) ? 2 : 256);
    t->width = t->height = 1 + explained_pick(2);
    t->stride = 2;
    t->srgb = explained_pick(2);
    if (ex_one_in(8)) t->filter = SHADE_FILTER_TRILINEAR;
    if (ex_one_in(16)) t->mipmap_count = 1;
    if (ex_one_in(3)) d->diffuse_map = t;
    if (ex_one_in(5)) d->transparency = ex_one_in(4) ? 1 : ex_from(0, 1);
    if (ex_one_in(8)) d->alpha_cutoff = ex_from(0, 1);
    d->raster.cull = (shade_cull)(explained_pick(2) * explained_pick(3));
    if (ex_one_in(6)) d->raster.depth_test = (shade_compare)explained_pick(6);
    if (ex_one_in(3)) d->raster.blend = (shade_blend)explained_pick(3);
    if (ex_one_in(6)) d->raster.depth_read_only = 1;
    if (ex_one_in(10)) d->raster.depth_bias = ex_from(-1, 1);
    if (explained_pick(24)) return;
    d->fragment = ex_one_in(2) ? shader_white : ex_one_in(2) ? shader_black : shader_that_discards;
    d->shading = SHADE_SHADING_PER_FRAGMENT;
}
static void ex_random_target(stage *s)
{
    shade_target *t = &s->target;
    if (ex_one_in(3)) t->format = (shade_format)explained_pick(5);
    t->srgb = explained_pick(2);
    t->dither = ex_one_in(4);
    if (ex_one_in(6)) t->depth = NULL;
    else if (ex_one_in(6)) t->color = NULL;
    if (ex_one_in(6)) {                    /* a band */
        t->clip_y = explained_pick(EX_HEIGHT);
        t->clip_width = EX_WIDTH;
        t->clip_height = 1 + explained_pick(9);
    } else if (ex_one_in(8)) {
        t->clip_x = explained_pick(EX_WIDTH);
        t->clip_y = explained_pick(EX_HEIGHT);
        t->clip_width = 1 + explained_pick(14);
        t->clip_height = 1 + explained_pick(14);
    } else if (ex_one_in(8)) {             /* a strip */
        t->row_offset = explained_pick(EX_HEIGHT);
        t->row_count = 1 + explained_pick(EX_HEIGHT - t->row_offset);
    }
}
static void ex_random(explained *e)
{
    stage *s = &e->s;
    memset(&e->other, 0, sizeof e->other);
    e->has_right = 0;
    e->made[0] = e->made[1] = "";
    ex_target(s);
    ex_random_mesh(s);
    ex_random_camera(s);
    ex_random_light(s);
    ex_random_surface(s);
    ex_random_target(s);
    if (s->state.raster.depth_test == SHADE_COMPARE_GREATER) s->clear = 0;
    if (ex_one_in(16)) s->clear = (float)explained_pick(3) / 2;
    if (ex_one_in(6)) e->other = shade_mat4_translation(ex_vec3(-2, 2));
}

/* ---- ordinary states ------------------------------------------------------------------------- */

/* A scene that a newcomer may well write: a mesh in the middle of the picture, a camera outside of
   it, a lamp or two on the camera's side. */
static void ex_sensible(explained *e)
{
    stage *s = &e->s;
    shade_draw_state *d = &s->state;
    const int shape = explained_pick(5);
    const float around = ex_from(-3, 3), away = ex_from(5, 8), high = ex_from(0.3f, 0.9f);
    const float beside = around + ex_from(-0.7f, 0.7f), bright = ex_from(0.5f, 1);
    memset(&e->other, 0, sizeof e->other);
    e->has_right = 0;
    e->made[0] = e->made[1] = "";
    ex_target(s);
    if (shape == 1) ex_box(s);
    if (shape == 2) ex_floor(s);
    if (shape == 3) ex_hills(s);
    if (shape == 4) ex_teapot(s);
    s->target.srgb = !ex_one_in(4);
    if (ex_one_in(6)) s->target.format = (shade_format)explained_pick(4);
    if (ex_one_in(4)) s->mesh.normals = NULL;
    if (ex_one_in(6)) stage_chunks(s);
    if (ex_one_in(4)) s->mesh.colors = &s->color[0].x;
    if (ex_one_in(4)) stage_map(s);
    s->eye = shade_scale(shade_v3(sinf(around), high, cosf(around)), away);
    s->center = ex_vec3(-0.2f, 0.2f);
    s->fovy = ex_from(0.6f, 0.9f);
    s->aspect = (float)EX_WIDTH / EX_HEIGHT;
    s->z_near = ex_from(0.05f, 0.5f);
    s->z_far = ex_from(20, 200);
    stage_look(s);
    if (ex_one_in(8)) stage_reverse(s, s->z_near);
    else if (ex_one_in(8)) d->projection = shade_mat4_ortho(-3, 3, -2, 2, 0.1f, 20);
    if (ex_one_in(3)) d->model = shade_mat4_rotation(ex_from(-3, 3), shade_v3(0, 1, 0));
    s->lamps[0] = shade_point_light(shade_scale(shade_v3(sinf(beside), 1, cosf(beside)), away),
                                    shade_v3(bright, bright, bright));
    if (ex_one_in(3))
        s->lamps[0] = shade_directional_light(shade_v3(-sinf(beside), -1, -cosf(beside)),
                                              shade_v3(bright, bright, bright));
    d->lighting.light_count = 1 + ex_one_in(4);
    s->lamps[1] = shade_directional_light(shade_v3(0.3f, -1, 0.2f), shade_v3(0.3f, 0.3f, 0.4f));
    if (ex_one_in(2)) d->lighting.ambient = shade_scale(shade_v3(1, 1, 1), ex_from(0.05f, 0.2f));
    if (ex_one_in(6)) d->lighting.model = (shade_model)explained_pick(3);
    d->shading = (shade_shading)(explained_pick(2) * explained_pick(3));
    if (ex_one_in(4)) d->material = NULL;
    s->material.ambient = s->material.diffuse = ex_vec3(0.3f, 0.9f);
    if (ex_one_in(2)) s->material.specular = shade_v3(0.3f, 0.3f, 0.3f);
    s->material.shininess = ex_from(8, 60);
    if (shape != 2 && shape != 3 && ex_one_in(3)) d->raster.cull = SHADE_CULL_BACK;
}
/* ---- pictures -------------------------------------------------------------------------------- */

typedef struct picture {
    shade_result result;
    shade_stats stats;
    int width, height;
    int bright, white, sum;      /* pixels beyond 8 of 255, and with a channel at its end */
    unsigned char code[EX_PIXELS][3];    /* of 255 */
} picture;

/* A pointer into one stage, into the copy of that stage. */
#define EX_MOVE(p)                                                                              \
    do {                                                                                        \
        const char *at = (const char *)(p), *start = (const char *)in;                          \
        if (at >= start && at < start + sizeof *in) (p) = (void *)((char *)out + (at - start)); \
    } while (0)
static void ex_copy(const stage *in, stage *out)
{
    shade_mesh *m = &out->mesh;
    shade_draw_state *d = &out->state;
    memcpy(out, in, offsetof(stage, pixels));
    EX_MOVE(out->target.color);
    EX_MOVE(out->target.depth);
    EX_MOVE(m->positions);
    EX_MOVE(m->normals);
    EX_MOVE(m->texcoords);
    EX_MOVE(m->colors);
    EX_MOVE(m->indices);
    EX_MOVE(m->indices16);
    EX_MOVE(m->chunks);
    EX_MOVE(d->material);
    EX_MOVE(d->lighting.lights);
    EX_MOVE(d->diffuse_map);
    EX_MOVE(out->map.pixels);
    EX_MOVE(out->map.mipmaps);
    for (int k = 0; k < STAGE_LEVELS; k++) EX_MOVE(out->level[k].pixels);
}
static void ex_ordinary(explained *e)
{
    const int wrong = explained_pick(3);
    int of_anybody = 0;          /* they come first in the list */
    for (const mistake *m = mistake_first; m->scenes & ON_TEAPOT; m = m->next) of_anybody++;
    ex_sensible(e);
    e->has_right = wrong == 1;
    for (int k = 0; k < wrong; k++) {
        const mistake *m = mistake_first;
        for (int i = explained_pick(of_anybody); i > 0; i--) m = m->next;
        e->made[k] = m->name;
        if (e->has_right) {
            ex_copy(&e->s, &e->right);
            e->right.unspoiled = 1;
            m->make(&e->right);
            if (e->right.unspoiled == 1) ex_copy(&e->s, &e->right);
        }
        m->make(&e->s);
    }
}
/* The buffers as they are before the draw; draws 0: after a clear. */
static void ex_prepare(const explained *e, stage *s)
{
    const float clear = s->clear == s->clear ? s->clear : 0;
    for (int i = 0; i < EX_PIXELS; i++) s->depth[i] = clear;
    memset(s->pixels, 0, sizeof(float) * 4 * EX_PIXELS);
    if (e->other.col[3].w != 0 && s->draws) {
        const shade_mat4 model = s->state.model;
        s->state.model = e->other;
        shade_draw_mesh(&s->target, &s->mesh, &s->state, NULL);
        s->state.model = model;
        memset(s->pixels, 0, sizeof(float) * 4 * EX_PIXELS);
    }
    for (int k = 1; k < s->draws; k++) shade_draw_mesh(&s->target, &s->mesh, &s->state, NULL);
}
/* The codes of a pixel.  Floats are scaled by whoever shows them: any light is bright. */
static void ex_codes(const stage *s, int i, unsigned char *code)
{
    const uint8_t *b = (const uint8_t *)s->pixels + 4 * i;
    uint16_t two;
    memcpy(&two, (const uint8_t *)s->pixels + 2 * i, 2);
    switch (s->target.format) {
    case SHADE_FORMAT_RGBA32F:
        for (int k = 0; k < 3; k++) {
            const float v = s->pixels[4 * i + k];
            code[k] = v > 0 ? (unsigned char)(9 + 246 * fminf(v, 1)) : 0;
        }
        return;
    case SHADE_FORMAT_RGB565: case SHADE_FORMAT_RGB565_SWAPPED:
        if (s->target.format == SHADE_FORMAT_RGB565_SWAPPED) two = (uint16_t)(two >> 8 | two << 8);
        code[0] = (unsigned char)((two >> 11) * 255 / 31);
        code[1] = (unsigned char)((two >> 5 & 63) * 255 / 63);
        code[2] = (unsigned char)((two & 31) * 255 / 31);
        return;
    default: memcpy(code, b, 3);
    }
}
static int ex_is_bright(const unsigned char *code)
{
    return code[0] > 8 || code[1] > 8 || code[2] > 8;
}
static void ex_draw(const explained *e, stage *s, picture *p)
{
    const int pixels = s->target.width * s->target.height;
    ex_prepare(e, s);
    memset(&p->stats, 0, sizeof p->stats);
    p->result = s->no_target || s->no_mesh || s->no_state
                    ? SHADE_ERROR_ARGUMENT
                    : shade_draw_mesh(&s->target, &s->mesh, &s->state, &p->stats);
    p->width = s->target.width;
    p->height = s->target.height;
    p->bright = p->white = p->sum = 0;
    for (int i = 0; i < pixels && i < EX_PIXELS; i++) {
        unsigned char *c = p->code[i];
        ex_codes(s, i, c);
        if (!s->target.color) c[0] = c[1] = c[2] = 0;
        p->bright += ex_is_bright(c);
        p->white += c[0] == 255 || c[1] == 255 || c[2] == 255;
        p->sum += c[0] + c[1] + c[2];
    }
}

/* ---- what a picture shows -------------------------------------------------------------------- */

/* Of a pixel: the triangle, its side, the point on it and its normal in world space. */
typedef struct shown { int place, triangle, front; shade_vec3 point, normal; } shown;
typedef struct geometry {
    int count;
    shown at[EX_PIXELS];         /* the first count */
} geometry;

/* Writes the point and, from 1 on, the triangle; or the normal and the side. */
typedef struct ex_asked { const stage *s; int first, map; } ex_asked;
static void ex_write(const void *uniforms, const shade_fragments *SHADE_RESTRICT in,
                     shade_colors *SHADE_RESTRICT out)
{
    const ex_asked *a = (const ex_asked *)uniforms;
    const shade_draw_state *d = &a->s->state;
    float texel[4 * SHADE_LANES];
    if (a->map)
        shade_sample_lanes(d->diffuse_map, in->varying[SHADE_VARYING_TEXCOORD],
                           in->varying[SHADE_VARYING_TEXCOORD + 1], in->lod, texel);
    for (int i = 0; i < in->count; i++) {
        const float alpha = (a->map ? texel[3 * SHADE_LANES + i] : 1) * (1 - d->transparency);
        for (int k = 0; k < 3; k++) out->color[k][i] = in->varying[a->first + k][i];
        out->color[3][i] = (float)(a->first ? in->front[i] : in->primitive[i] + 1);
        if (!d->fragment && alpha < d->alpha_cutoff) out->discard[i] = 1;
    }
}
/* What a draw shows: with test -1 as the picture has it, else of the whole picture with this depth
   test. */
static void ex_look(const explained *e, const stage *given, int test, geometry *g)
{
    static stage s;
    static float point[4 * EX_PIXELS];
    shade_target *t = &s.target;
    for (int pass = 0; pass < 2; pass++) {
        const ex_asked asked = { given, pass ? SHADE_VARYING_NORMAL : SHADE_VARYING_POSITION,
                                 given->state.diffuse_map && given->mesh.texcoords };
        ex_copy(given, &s);
        t->color = s.pixels;
        if (test >= 0) {
            t->clip_x = t->clip_y = t->clip_width = t->clip_height = 0;
            t->row_offset = t->row_count = 0;
            t->depth = s.depth;
            s.state.raster.depth_test = (shade_compare)test;
            s.state.raster.depth_bias = 0;
            s.state.raster.depth_read_only = 0;
            s.clear = test >= SHADE_COMPARE_GREATER ? 0.0f : 1.0f;
            s.draws = 0;
        }
        ex_prepare(e, &s);
        t->format = SHADE_FORMAT_RGBA32F;
        s.state.raster.blend = SHADE_BLEND_REPLACE;
        if (s.state.shading == SHADE_SHADING_PER_FACE) s.mesh.normals = NULL;
        s.state.shading = SHADE_SHADING_PER_FRAGMENT;
        s.state.fragment = ex_write;
        s.state.uniforms = &asked;
        s.state.alpha_cutoff = s.state.transparency = 0;
        memset(s.pixels, 0, sizeof(float) * 4 * EX_PIXELS);
        shade_draw_mesh(t, &s.mesh, &s.state, NULL);
        if (!pass) memcpy(point, s.pixels, sizeof point);
    }
    g->count = 0;
    for (int i = 0; i < EX_PIXELS; i++) {
        const float *p = point + 4 * i, *n = s.pixels + 4 * i;
        shown *at = &g->at[g->count];
        if (p[3] == 0) continue;
        at->place = i;
        at->triangle = (int)p[3] - 1;
        at->front = n[3] != 0;
        at->point = shade_v3(p[0], p[1], p[2]);
        at->normal = shade_normalize(shade_v3(n[0], n[1], n[2]));
        g->count++;
    }
}

/* ---- corners in double precision ------------------------------------------------------------- */

static uint32_t ex_vertex(const shade_mesh *m, int corner)
{
    if (m->indices16) return m->indices16[corner];
    return m->indices ? m->indices[corner] : (uint32_t)corner;
}
static int ex_corners(const shade_mesh *m)
{
    return m->indices || m->indices16 ? m->index_count : m->vertex_count;
}
static const float *ex_element(const float *array, int stride, int floats, uint32_t vertex)
{
    const size_t bytes = (size_t)(stride ? stride : 4 * floats);
    return (const float *)(const void *)((const char *)array + vertex * bytes);
}
static const float *ex_position(const shade_mesh *m, int corner)
{
    return ex_element(m->positions, m->position_stride, 3, ex_vertex(m, corner));
}
static shade_mat4 ex_or_identity(shade_mat4 m)
{
    for (int k = 0; k < 16; k++)
        if ((&m.col[k / 4].x)[k % 4] != 0) return m;
    return shade_mat4_identity();
}
static void ex_transform(shade_mat4 m, const double in[4], double out[4])
{
    m = ex_or_identity(m);
    for (int r = 0; r < 4; r++) {
        out[r] = 0;
        for (int k = 0; k < 4; k++) out[r] += (double)(&m.col[k].x)[r] * in[k];
    }
}
static void ex_clip(const stage *s, int corner, double world[4], double clip[4])
{
    const float *p = ex_position(&s->mesh, corner);
    const double at[4] = { (double)p[0], (double)p[1], (double)p[2], 1 };
    double eye[4];
    ex_transform(s->state.model, at, world);
    ex_transform(s->state.view, world, eye);
    ex_transform(s->state.projection, eye, clip);
}

/* ---- what must be so of the pixels shown ----------------------------------------------------- */

/* All that rows are judged by. */
typedef struct judged {
    const explained *e;
    const picture *drawn;        /* as it was */
    geometry shown, all;         /* what the picture shows; without culling, the nearest of all */
    shade_vec3 eye;              /* centre of projection, or far away on its side */
    int nearer_is_greater;       /* in depth */
} judged;
typedef int so(const judged *);

static int ex_is_greater(const shade_draw_state *d)
{
    return d->raster.depth_test == SHADE_COMPARE_GREATER ||
           d->raster.depth_test == SHADE_COMPARE_GREATER_EQUAL;
}
static shade_mat4 ex_camera(const stage *s)
{
    return shade_mat4_mul(ex_or_identity(s->state.projection), ex_or_identity(s->state.view));
}
/* Is the nearer of two points, along some ray, the one of greater depth? */
static int ex_near_is_greater(const stage *s)
{
    for (double z = -64; z <= 64; z += 0.25) {
        const double near[4] = { 0, 0, z, 1 }, far[4] = { 0, 0, 2 * z, 1 };
        double a[4], b[4];
        ex_transform(s->state.projection, near, a);
        ex_transform(s->state.projection, far, b);
        if (a[3] > 0 && b[3] > a[3]) return b[2] / b[3] < a[2] / a[3];
    }
    return 0;
}
/* Where x, y and w are 0, or far away on the side of smaller depth, or of greater. */
static shade_vec3 ex_eye_from(shade_mat4 m, int greater)
{
    const float toward = greater ? 1.0f : -1.0f;
    shade_vec4 at;
    if (shade_mat4_determinant(m) == 0)    /* depth is the same everywhere: any other will do */
        for (int k = 0; k < 4; k++) m.col[k].z = k == 3;
    at = shade_mat4_transform(shade_mat4_inverse(m), shade_v4(0, 0, toward, 0));
    const float scale = at.w == 0 ? 1e6f : 1 / at.w;
    return shade_v3(at.x * scale, at.y * scale, at.z * scale);
}
static shade_vec3 ex_eye(const stage *s, int greater) { return ex_eye_from(ex_camera(s), greater); }
/* How many of the pixels hold the condition in tenths, rounded down; 10 where there are none. */
typedef int of_pixel(const judged *, const shown *);
static int ex_tenths(const judged *j, const geometry *g, of_pixel *holds)
{
    int n = 0;
    for (int i = 0; i < g->count; i++) n += holds(j, &g->at[i]);
    return g->count ? n * 10 / g->count : 10;
}

static shade_vec3 ex_xyz(shade_vec4 v) { return shade_v3(v.x, v.y, v.z); }
/* The cosine between a direction and that to a lamp. */
static float ex_toward(const shade_light *l, shade_vec3 point, shade_vec3 direction)
{
    const shade_vec3 at = shade_v3(l->position.x, l->position.y, l->position.z);
    const float w = l->position.w;
    const shade_vec3 to = w != 0 ? shade_sub(shade_scale(at, 1 / w), point) : at;
    return shade_dot(shade_normalize(to), shade_normalize(direction));
}
/* Has a lamp a colour that the surface reflects? */
static int ex_has_colour(const judged *j, const shade_light *l)
{
    const shade_material *m = j->e->s.state.material;
    return ex_most(l->diffuse) > 0 || (m && ex_most(shade_mul(l->specular, m->specular)) > 0);
}
static int ex_turned(const judged *j, const shown *at)
{
    return at->front && shade_dot(shade_sub(j->eye, at->point), at->normal) < 0;
}
static int ex_no_normal(const judged *j, const shown *at)
{
    (void)j;
    return !(shade_length(at->normal) > 0);
}
static int ex_is_back(const judged *j, const shown *at)
{
    (void)j;
    return !at->front;
}
static int ex_unlit_side(const judged *j, const shown *at)
{
    const shade_lighting *l = &j->e->s.state.lighting;
    const shade_mat4 view = shade_mat4_inverse(ex_or_identity(j->e->s.state.view));
    const shade_vec3 to_eye = l->flags & SHADE_FLAG_INFINITE_VIEWER    /* as light takes it */
                                  ? ex_xyz(view.col[2])
                                  : shade_sub(ex_xyz(view.col[3]), at->point);
    const int flip = l->flags & SHADE_FLAG_TWO_SIDED && shade_dot(to_eye, at->normal) < 0;
    if (l->flags & SHADE_FLAG_TWO_SIDED_ABS) return ex_no_normal(j, at);
    for (int k = 0; k < l->light_count; k++)
        if (ex_has_colour(j, &l->lights[k]) &&
            (flip ? -1 : 1) * ex_toward(&l->lights[k], at->point, at->normal) > 0.02f)
            return 0;
    return 1;
}

/* Is each lamp dark, or does it meet the surface at a flat angle? */
static int ex_dim(const judged *j, const shown *at)
{
    const shade_lighting *l = &j->e->s.state.lighting;
    for (int k = 0; k < l->light_count; k++)
        if (ex_most(l->lights[k].diffuse) *
            fabsf(ex_toward(&l->lights[k], at->point, at->normal)) > 0.05f) return 0;
    return 1;
}

/* Do all corners of the mesh hold it?  bad: those that are no numbers do too. */
typedef int of_corner(const double clip[4]);
static int ex_all(const stage *s, of_corner *holds)
{
    for (int i = 0; i < ex_corners(&s->mesh); i++) {
        double world[4], clip[4];
        ex_clip(s, i, world, clip);
        if (!holds(clip)) return 0;
    }
    return 1;
}
static int ex_is_bad(const double c[4])
{
    return !(fabs(c[0]) < 1e30 && fabs(c[1]) < 1e30 && fabs(c[2]) < 1e30 && fabs(c[3]) < 1e30);
}
static int ex_is_good(const double c[4]) { return !ex_is_bad(c); }
static int ex_beyond_w(const double c[4]) { return ex_is_bad(c) || c[2] > c[3] - 1e-4; }
static int ex_before_w(const double c[4])
{
    return ex_is_bad(c) || c[2] < 1e-4 || c[2] < -c[3] + 1e-4;
}
static int ex_behind_eye(const double c[4]) { return ex_is_bad(c) || c[3] < 1e-4; }

static int ex_is_affine(shade_mat4 m)
{
    return m.col[0].w == 0 && m.col[1].w == 0 && m.col[2].w == 0 && m.col[3].w == 1;
}
static int ex_is_rigid(shade_mat4 m)
{
    for (int k = 0; k < 9; k++) {
        const shade_vec4 a = m.col[k / 3], b = m.col[k % 3];
        const float cosine = a.x * b.x + a.y * b.y + a.z * b.z;
        if (fabsf(cosine - (float)(k / 3 == k % 3)) > 0.005f) return 0;
    }
    return ex_is_affine(m);
}
static int ex_is_by_rows(shade_mat4 m)
{
    m = ex_or_identity(m);
    return !ex_is_affine(m) && ex_is_affine(shade_mat4_transpose(m));
}
static int ex_is_perspective_by_rows(shade_mat4 m)
{
    return m.col[3].x == 0 && m.col[3].y == 0 && fabsf(m.col[3].z) == 1 && m.col[3].w == 0;
}
/* One-point perspective, w = 1 - z/k, of which the transposed one moves by -1/k. */
static int ex_is_from_point(shade_mat4 p)
{
    return p.col[0].x == 1 && p.col[1].y == 1 && p.col[3].w == 1 && p.col[3].z == 0;
}
static int ex_has_nan(const float *at, size_t count)
{
    for (size_t k = 0; k < count; k++)
        if (at[k] != at[k]) return 1;
    return 0;
}
/* Are all positions of the mesh in this range? */
static int ex_within(const shade_mesh *m, float low, float high)
{
    shade_mesh bare = *m;
    bare.indices = NULL;
    for (int i = 0; i < 3 * m->vertex_count; i++) {
        const float p = ex_position(&bare, i / 3)[i % 3];
        if (!(p >= low && p <= high)) return 0;
    }
    return 1;
}
static int ex_eye_in_box(const judged *j)
{
    const stage *s = &j->e->s;
    const shade_mat4 model = ex_or_identity(s->state.model);
    const shade_vec3 eye = ex_eye_from(shade_mat4_mul(ex_camera(s), model), j->nearer_is_greater);
    for (int k = 0; k < 3; k++) {
        float low = 1e30f, high = -1e30f;
        for (int i = 0; i < ex_corners(&s->mesh); i++) {
            const float p = ex_position(&s->mesh, i)[k];
            if (p > -1e12f && p < low) low = p;
            if (p < 1e12f && p > high) high = p;
        }
        if (!((&eye.x)[k] > low - 1e-3f && (&eye.x)[k] < high + 1e-3f)) return 0;
    }
    return 1;
}

/* The rows' own conditions. */
#define SO(name, truth) static int so_##name(const judged *j) { return truth; }
#define SO_LAMP(name, truth)                                                                       \
    static int so_##name(const judged *j)                                                          \
    {                                                                                              \
        for (int k = 0; k < LIGHTS->light_count; k++) {                                            \
            const shade_light *l = &LIGHTS->lights[k];                                             \
            if (truth) return 1;                                                                   \
        }                                                                                          \
        return 0;                                                                                  \
    }
#define STAGE (&j->e->s)
#define TARGET (&STAGE->target)
#define MESH (&STAGE->mesh)
#define STATE (&STAGE->state)
#define LIGHTS (&STATE->lighting)
#define RASTER (&STATE->raster)
#define MATERIAL (STATE->material)
#define MAP (STATE->diffuse_map)

SO(behind, ex_tenths(j, &j->shown, ex_unlit_side) >= 9)
SO(dim, ex_tenths(j, &j->shown, ex_dim) >= 9)
SO(turned, ex_tenths(j, &j->shown, ex_turned) >= 2)
SO(no_normal, MESH->normals && ex_tenths(j, &j->shown, ex_no_normal) >= 9)
SO(inside_out, ex_tenths(j, &j->all, ex_is_back) >= 5)
SO(white, j->drawn->white * 5 >= j->drawn->bright * 4)
SO(far_side, ex_all(STAGE, ex_beyond_w))
SO(near_side, ex_all(STAGE, ex_before_w))
SO(behind_eye, ex_all(STAGE, ex_behind_eye))
SO(beyond, j->nearer_is_greater ? so_near_side(j) : so_far_side(j))
SO(before, (j->nearer_is_greater ? so_far_side(j) : so_near_side(j)) || so_behind_eye(j))
SO(some_bad, !ex_all(STAGE, ex_is_good) || !ex_within(MESH, -1e12f, 1e12f))
SO(inside, ex_eye_in_box(j))
SO(front, RASTER->cull == SHADE_CULL_FRONT)
SO(back, RASTER->cull == SHADE_CULL_BACK)
SO(equal, RASTER->depth_test == SHADE_COMPARE_EQUAL)
SO(not_equal, !so_equal(j))
SO(far_wins, TARGET->depth && ex_is_greater(STATE) != j->nearer_is_greater)
SO(order, !TARGET->depth || RASTER->depth_test == SHADE_COMPARE_ALWAYS || RASTER->depth_read_only)
SO(bias, fabsf(RASTER->depth_bias) >= 1)
SO(no_view, STATE->view.col[3].w == 0 && ex_eye_in_box(j))
SO(view_by_rows, ex_is_by_rows(STATE->view) || ex_is_perspective_by_rows(STATE->view))
SO(model_by_rows, ex_is_by_rows(STATE->model) || ex_is_perspective_by_rows(STATE->model))
SO(by_rows, !ex_is_from_point(STATE->projection))
SO(last_row, STATE->model.col[3].w != 1 || STATE->view.col[3].w != 1)
SO(not_rigid, !ex_is_rigid(ex_or_identity(STATE->view)))
SO(degenerate, shade_length(ex_xyz(STATE->projection.col[0])) == 0)
SO(no_flag, STATE->projection.col[2].z == 0 && !RASTER->depth_zero_to_one)
SO(no_lamp, LIGHTS->light_count <= 0)
SO(negative_count, LIGHTS->light_count < 0)
SO_LAMP(spot, shade_length(l->spot_direction) > 0)
SO_LAMP(bad_cosine, shade_length(l->spot_direction) > 0 && !(fabsf(l->spot_cos_cutoff) <= 1))
SO_LAMP(negative_attenuation, l->constant < 0 || l->linear < 0 || l->quadratic < 0)
SO_LAMP(lamp_nan, ex_has_nan(&l->position.x, sizeof *l / sizeof(float)))
SO(map_or_colors, MESH->colors || (MAP && MESH->texcoords))
SO(no_texcoords, MAP && !MESH->texcoords)
SO(no_mipmaps, MAP && MAP->width > 1 && !MAP->mipmaps)
SO(stored, STATE->transparency > 0 && RASTER->blend == SHADE_BLEND_REPLACE)
SO(dull, MATERIAL->shininess < 1 && ex_most(MATERIAL->specular) > 0)
SO(glows, ex_most(MATERIAL->emission) >= 1)
SO(clip, TARGET->clip_width || TARGET->clip_x || TARGET->clip_height || TARGET->clip_y)
SO(too_wide, TARGET->clip_x + TARGET->clip_width > TARGET->width)
SO(beyond_picture, so_too_wide(j) || TARGET->clip_y + TARGET->clip_height > TARGET->height)
SO(shader, STATE->fragment != NULL)
SO(model_projects, !ex_is_affine(STATE->model))
SO(chunks, MESH->chunks != NULL)
SO(other_stats, STAGE->other_stats)
/* Is the eye of the view not the centre of projection, or does its axis look away? */
static int so_other_eye(const judged *j)
{
    const shade_mat4 frame = shade_mat4_inverse(ex_or_identity(STATE->view));
    const shade_vec3 apart = shade_sub(ex_xyz(frame.col[3]), j->eye);
    const shade_mat4 m = ex_camera(STAGE);
    const shade_vec3 sight = shade_v3(m.col[0].w, m.col[1].w, m.col[2].w);
    return shade_length(apart) > 1e-4f * shade_length(j->eye) ||
           shade_dot(ex_xyz(frame.col[2]), sight) > 0;
}
/* Has a chunk a box that does not hold its triangles? */
static int so_box(const judged *j)
{
    for (int c = 0; c < MESH->chunk_count; c++) {
        const shade_chunk *box = &MESH->chunks[c];
        for (int i = 3 * box->first; i < 3 * (box->first + box->count); i++)
            for (int k = 0; k < 3; k++) {
                const float p = ex_position(MESH, i)[k];
                if (p < (&box->low.x)[k] || p > (&box->high.x)[k]) return 1;
            }
    }
    return 0;
}
static shade_vec3 ex_normal(const shade_mesh *m, uint32_t vertex)
{
    const float *n = ex_element(m->normals, m->normal_stride, 3, vertex);
    return shade_v3(n[0], n[1], n[2]);
}
/* Are some normals behind their faces? */
static int so_mixed(const judged *j)
{
    int behind = 0;
    if (!MESH->normals) return 0;
    for (int i = 0; i + 2 < ex_corners(MESH); i += 3) {
        const float *a = ex_position(MESH, i), *b = ex_position(MESH, i + 1);
        const float *c = ex_position(MESH, i + 2);
        shade_vec3 face = shade_face_normal(shade_v3(a[0], a[1], a[2]), shade_v3(b[0], b[1], b[2]),
                                            shade_v3(c[0], c[1], c[2])), sum = BLACK;
        for (int k = 0; k < 3; k++)
            sum = shade_add(sum, ex_normal(MESH, ex_vertex(MESH, i + k)));
        behind += shade_dot(sum, face) < 0;
    }
    return behind;
}
static int so_texels(const judged *j)
{
    for (int i = 0; i < MESH->vertex_count; i++)
        if (*ex_element(MESH->texcoords, MESH->texcoord_stride, 2, (uint32_t)i) >
            (float)MAP->width - 1.001f)
            return 1;
    return 0;
}
/* Are squares that face the eye no squares in the picture, nor in cells of a terminal, which are
   twice as high as wide? */
static int so_aspect(const judged *j)
{
    const shade_mat4 m = ex_camera(STAGE);
    shade_vec3 row[4];
    float wide, high;
    for (int r = 0; r < 4; r++)
        row[r] = shade_v3((&m.col[0].x)[r], (&m.col[1].x)[r], (&m.col[2].x)[r]);
    if (shade_length(row[3]) == 0) row[3] = shade_cross(row[0], row[1]);
    row[3] = shade_normalize(row[3]);
    wide = shade_length(shade_cross(row[0], row[3])) * (float)TARGET->width;
    high = shade_length(shade_cross(row[1], row[3])) * (float)TARGET->height;
    return fabsf(wide - high) > 0.02f * wide && fabsf(wide - 2 * high) > 0.02f * wide;
}

static int ex_is_wild(const float *at, int stride, int floats, const shade_mesh *m)
{
    if (!at) return 0;
    for (int i = 0; i < ex_corners(m); i++) {
        const float *element = ex_element(at, stride, floats, ex_vertex(m, i));
        for (int k = 0; k < floats; k++)
            if (!(fabs((double)element[k]) <= 1.0001e18)) return 1;
    }
    return 0;
}
SO(wild_normals, ex_is_wild(MESH->normals, MESH->normal_stride, 3, MESH))
SO(wild_colors, ex_is_wild(MESH->colors, MESH->color_stride, 3, MESH))
SO(wild_texcoords, ex_is_wild(MESH->texcoords, MESH->texcoord_stride, 2, MESH))
SO(mirrors, shade_mat4_determinant(STATE->view) < 0)
static int so_negative_lamp(const judged *j)
{
    int negative = 0;
    for (int k = 0; k < LIGHTS->light_count; k++)
        for (int i = 0; i < 9; i++) negative |= (&LIGHTS->lights[k].ambient.x)[i] < 0;
    return negative;
}
/* Have two arrays of different strides a byte in common? */
static int so_crossed(const judged *j)
{
    const shade_mesh *m = MESH;
    const float *array[4] = { m->positions, m->normals, m->colors, m->texcoords };
    const int stride[4] = { m->position_stride, m->normal_stride, m->color_stride,
                            m->texcoord_stride };
    int common = 0;
    for (int pair = 0; pair < 16; pair++) {
        const int a = pair / 4, b = pair % 4, floats[4] = { 3, 3, 3, 2 };
        const int wide = stride[a] ? stride[a] : 4 * floats[a];
        if (!array[a] || !array[b] || wide == (stride[b] ? stride[b] : 4 * floats[b])) continue;
        for (int i = 0; i < m->vertex_count * m->vertex_count; i++) {
            const float *p = ex_element(array[a], stride[a], floats[a], (uint32_t)i %
                                        (uint32_t)m->vertex_count);
            const float *q = ex_element(array[b], stride[b], floats[b], (uint32_t)i /
                                        (uint32_t)m->vertex_count);
            common |= p < q + floats[b] && q < p + floats[a];
        }
    }
    return common;
}
/* Has every other 16-bit index, which are at least two, the number 0? */
static int so_halves(const judged *j)
{
    int even = 0, odd = 0;
    for (int i = 0; MESH->indices16 && i < MESH->index_count; i++)
        *(i % 2 ? &odd : &even) |= MESH->indices16[i];
    return MESH->indices16 && !even != !odd;
}
/* Does a step of a corner's largest coordinate show, or span a sixteenth of the mesh? */
static int so_coarse(const judged *j)
{
    double low = 1e30, high = -1e30, most = 0, steps = 0, wide = 0, pixels = 0;
    for (int k = 0; k < 3; k++, wide = fmax(wide, high - low), low = 1e30, high = -1e30)
        for (int i = 0; i < ex_corners(MESH); i++) {
            const float p = ex_position(MESH, i)[k];
            low = fmin(low, (double)p);
            high = fmax(high, (double)p);
            most = fmax(most, (double)fabsf(p));
            steps = fmax(steps, (double)(nextafterf(fabsf(p), 1e30f) - fabsf(p)));
        }
    for (int i = 0; i < ex_corners(MESH); i++) {
        double world[4], clip[4];
        ex_clip(STAGE, i, world, clip);
        if (clip[3] > 0)
            pixels = fmax(pixels, steps / clip[3] * TARGET->height *
                                      (double)shade_length(ex_xyz(STATE->projection.col[1])) / 2);
    }
    return steps * 16 >= wide || pixels > 0.5;
}
/* Has a level of the map another size than half of the one before? */
static int so_levels(const judged *j)
{
    int other = 0;
    for (int k = 0; k < MAP->mipmap_count; k++) {
        const shade_texture *from = k ? &MAP->mipmaps[k - 1] : MAP, *to = &MAP->mipmaps[k];
        other |= to->width != (from->width + (from->width == 1)) / 2 ||
                 to->height != (from->height + (from->height == 1)) / 2;
    }
    return other;
}
/* Do two triangles, and no third, go from one point to another? */
static int so_both_ways(const judged *j)
{
    int found = 0;
    for (int i = 0; i + 2 < ex_corners(MESH); i++) {
        const float *a = ex_position(MESH, i);
        const float *b = ex_position(MESH, i / 3 * 3 + (i + 1) % 3);
        int with = 0, against = 0;
        for (int k = 0; k + 2 < ex_corners(MESH); k++) {
            const float *c = ex_position(MESH, k);
            const float *d = ex_position(MESH, k / 3 * 3 + (k + 1) % 3);
            const int far = k / 3 != i / 3;
            with += far && !memcmp(a, c, 12) && !memcmp(b, d, 12);
            against += far && !memcmp(a, d, 12) && !memcmp(b, c, 12);
        }
        found |= with == 1 && !against;
    }
    return found;
}

/* ---- what sentences advise ------------------------------------------------------------------- */

typedef void cure(stage *);
#define CURE(name) static void cure_##name(stage *s)
#define CURE_LAMPS(name, change)                                                                   \
    CURE(name)                                                                                     \
    {                                                                                              \
        shade_lighting *lights = &s->state.lighting;                                               \
        for (int k = 0; k < STAGE_LAMPS && k < lights->light_count; k++) {                         \
            shade_light *l = &s->lamps[k];                                                         \
            *l = lights->lights[k];                                                                \
            change                                                                                 \
        }                                                                                          \
        if (lights->lights) lights->lights = s->lamps;                                             \
    }

/* of light */
CURE(shading) { s->state.shading = SHADE_SHADING_PER_FRAGMENT; }
CURE(sides) { s->state.lighting.flags |= SHADE_FLAG_TWO_SIDED_ABS; }
CURE(normals) { s->mesh.normals = NULL; }
CURE(shininess) { s->material.shininess = 50; }
CURE(emission) { s->material.emission = BLACK; }
CURE(over) { s->state.raster.blend = SHADE_BLEND_OVER; }
CURE(count)
{
    const int greater = s->target.depth ? ex_is_greater(&s->state) : ex_near_is_greater(s);
    stage_lamp(s, shade_point_light(ex_eye(s, greater), WHITE));
    if (s->state.raster.cull == SHADE_CULL_FRONT) cure_sides(s);    /* of inner walls */
}
CURE(at_eye) { cure_count(s); }
/* A lamp, or ambient light. */
CURE(any_light)
{
    cure_count(s);
    s->state.lighting.ambient = WHITE;
}
CURE(no_lamp)
{
    if (s->state.lighting.light_count <= 0) cure_count(s);
}
CURE_LAMPS(distance, l->constant = l->linear = l->quadratic = l->spot_exponent = 0;)
CURE_LAMPS(cone, l->spot_direction = BLACK;)
CURE_LAMPS(colors_of_lamps, l->diffuse = l->specular = WHITE;)
CURE_LAMPS(ambient, l->ambient = BLACK;)    /* no cure, but it hides that there is one */
/* A lamp that is nowhere is put at the eye. */
CURE(numbers)
{
    const shade_lighting *l = &s->state.lighting;
    const int given = l->light_count > 0 && l->lights;
    const shade_vec4 at = given ? l->lights[0].position : shade_v4(0, 0, 1, 0);
    const float size = fabsf(at.x) + fabsf(at.y) + fabsf(at.z) + fabsf(at.w);
    if (!(size > 0 && size < 1e30f)) cure_count(s);
}
CURE(lamps)
{
    cure_colors_of_lamps(s);
    cure_numbers(s);
}
CURE(terms)
{
    s->state.lighting.terms = 0;
    if (s->state.lighting.model > SHADE_MODEL_PHONG)
        s->state.lighting.model = SHADE_MODEL_BLINN_PHONG;
}
/* The map without levels, which do not follow its texels. */
static void ex_flatten(stage *s)
{
    if (!s->map.mipmaps) return;
    s->map.mipmaps = NULL;
    s->map.mipmap_count = 0;
    s->map.filter = SHADE_FILTER_BILINEAR;
}
CURE(opaque)
{
    ex_flatten(s);
    s->state.transparency = 0;
    for (int k = 3; k < 4 * STAGE_TEXELS; k += 4) s->texel[k] = 255;
}
CURE(colors)
{
    ex_flatten(s);
    s->mesh.colors = NULL;
    for (int k = 0; k < 4 * STAGE_TEXELS; k++)
        if (k % 4 < 3) s->texel[k] = 255;
}
CURE(material)
{
    s->material.ambient = s->material.diffuse = s->material.specular = WHITE;
    s->material.shininess = 1;
    if (!s->state.material) s->material.emission = BLACK;
    s->state.material = &s->material;
}
/* Without wide highlights. */
CURE(matte)
{
    s->material.ambient = s->material.diffuse = WHITE;
    if (!s->state.material) s->material.specular = s->material.emission = BLACK;
    s->state.material = &s->material;
}
/* The attributes that the mesh reads, each in an array of the stage, to be changed. */
static void ex_own(stage *s)
{
    shade_mesh *m = &s->mesh;
    static shade_vec3 normal[STAGE_VERTICES], color[STAGE_VERTICES];
    for (int i = 0; i < m->vertex_count; i++) {
        if (m->normals) normal[i] = ex_normal(m, (uint32_t)i);
        if (m->colors)
            memcpy(color + i, ex_element(m->colors, m->color_stride, 3, (uint32_t)i), 12);
    }
    if (m->normals) {
        memcpy(s->normal, normal, sizeof normal);
        m->normals = &s->normal[0].x;
        m->normal_stride = 0;
    }
    if (m->colors) {
        memcpy(s->color, color, sizeof color);
        m->colors = &s->color[0].x;
        m->color_stride = 0;
    }
}
CURE(turned)
{
    ex_own(s);
    for (int i = 0; i < STAGE_VERTICES; i++) s->normal[i] = shade_neg(s->normal[i]);
}
/* Colours of 1 at most, and no more light than that. */
static void ex_dim_to(shade_vec3 *c, float most)
{
    *c = shade_min(*c, shade_v3(most, most, most));
}
CURE_LAMPS(bright_lamps, ex_dim_to(&l->ambient, 0.1f); ex_dim_to(&l->diffuse, 0.2f);
           ex_dim_to(&l->specular, 0.2f);)
CURE(255)
{
    cure_bright_lamps(s);
    ex_dim_to(&s->state.lighting.ambient, 0.1f);
    ex_own(s);
    for (int i = 0; i < STAGE_VERTICES; i++) ex_dim_to(&s->color[i], 0.8f);
    ex_dim_to(&s->material.emission, 0.1f);
    ex_dim_to(&s->material.ambient, 0.8f);
    ex_dim_to(&s->material.diffuse, 0.8f);
    ex_dim_to(&s->material.specular, 0.2f);
}

/* of view */
CURE(nothing) { (void)s; }
CURE(cull) { s->state.raster.cull = SHADE_CULL_NONE; }
CURE(cutoff) { s->state.alpha_cutoff = 0; }
CURE(model) { s->state.model = shade_mat4_identity(); }
CURE(view_by_rows) { s->state.view = shade_mat4_transpose(s->state.view); }
CURE(model_by_rows) { s->state.model = shade_mat4_transpose(s->state.model); }
CURE(by_rows) { s->state.projection = shade_mat4_transpose(s->state.projection); }
CURE(inverse) { s->state.view = shade_mat4_inverse(s->state.view); }
CURE(chunks)
{
    s->mesh.chunks = NULL;
    s->mesh.chunk_count = 0;
}
/* Indices of 32 bits that may be changed; a mesh without any gets some, in order. */
CURE(indices)
{
    if (!s->mesh.indices) {
        const int corners = ex_corners(&s->mesh);
        for (int i = 0; i < corners; i++) s->index[i] = ex_vertex(&s->mesh, i);
        s->mesh.index_count = corners;
    }
    s->mesh.indices16 = NULL;
    s->mesh.indices = s->index;
}
CURE(winding)
{
    cure_indices(s);
    stage_turn(s, 0);
}
CURE(clip)
{
    shade_target *t = &s->target;
    t->clip_x = t->clip_y = t->clip_width = t->clip_height = t->row_offset = t->row_count = 0;
}
CURE(clear)
{
    s->clear = ex_is_greater(&s->state) ? 0.0f : 1.0f;
    s->draws = 0;
    s->state.raster.depth_bias = 0;
    s->state.raster.depth_read_only = 0;
}
CURE(depth)
{
    s->target.depth = s->depth;
    s->state.raster.depth_test =
        ex_near_is_greater(s) ? SHADE_COMPARE_GREATER_EQUAL : SHADE_COMPARE_LESS_EQUAL;
    cure_clear(s);
}
CURE(flag)
{
    s->state.raster.depth_zero_to_one = 1;
    s->state.raster.depth_test = SHADE_COMPARE_GREATER;
    s->clear = 0;
}
CURE(shader)
{
    if (!s->state.fragment) return;
    s->state.fragment = shader_white;
    s->state.alpha_cutoff = 0;
}
CURE(aspect)
{
    shade_mat4 *p = &s->state.projection;
    p->col[0].x = p->col[1].y * (float)s->target.height / (float)s->target.width;
}
CURE(projection)
{
    s->state.projection = shade_mat4_perspective(1, (float)EX_WIDTH / EX_HEIGHT, 0.01f, 1e4f);
    s->state.raster.depth_zero_to_one = 0;
    s->state.raster.depth_test = SHADE_COMPARE_LESS_EQUAL;
    s->clear = 1;
}
/* The same picture, with near at .1 and far at infinity. */
CURE(near)
{
    shade_mat4 *p = &s->state.projection;
    const int greater = ex_is_greater(&s->state);
    *p = ex_or_identity(*p);
    for (int k = 0; k < 4; k++) p->col[k].z = greater ? 0 : p->col[k].w;
    p->col[3].z += greater ? 0.1f : -0.2f;
}
/* A camera that sees all of the mesh. */
CURE(camera)
{
    shade_vec3 low = shade_v3(1e30f, 1e30f, 1e30f), high = shade_neg(low);
    float size;
    for (int i = 0; i < ex_corners(&s->mesh); i++) {
        double world[4], clip[4];
        shade_vec3 p;
        ex_clip(s, i, world, clip);
        p = shade_v3((float)world[0], (float)world[1], (float)world[2]);
        if (!(shade_length(p) < 1e12f)) continue;
        low = shade_min(low, p);
        high = shade_max(high, p);
    }
    s->center = shade_scale(shade_add(low, high), 0.5f);
    size = fmaxf(shade_length(shade_sub(high, low)), 1e-3f * shade_length(s->center) + 1e-7f);
    s->eye = shade_madd(s->center, size, shade_v3(0.5f, 0.7f, 1));
    s->fovy = s->aspect = 1;
    s->z_near = size * 0.01f;
    s->z_far = size * 10;
    cure_projection(s);
    stage_look(s);
}
/* The same picture of a view that stands at the centre of projection. */
CURE(eye)
{
    const shade_mat4 m = ex_camera(s);
    const int greater = s->target.depth ? ex_is_greater(&s->state) : ex_near_is_greater(s);
    const shade_vec3 eye = ex_eye(s, greater);
    shade_vec3 sight = shade_v3(m.col[0].w, m.col[1].w, m.col[2].w);
    if (shade_length(sight) == 0) sight = shade_neg(eye);
    s->state.view = shade_mat4_look_at(eye, shade_add(eye, sight), shade_v3(0, 1, 0));
    s->state.projection = shade_mat4_mul(m, shade_mat4_inverse(s->state.view));
}
/* A ball in its place. */
CURE(mesh)
{
    stage_ball(s, 6, 8);
    s->mesh.positions = &s->position[0].x;
    s->mesh.normals = &s->normal[0].x;
    s->mesh.indices = s->index;
    s->mesh.indices16 = NULL;
    s->mesh.position_stride = s->mesh.normal_stride = 0;
    cure_chunks(s);
}
/* of arrays */
CURE(strides)
{
    shade_mesh *m = &s->mesh;
    const int whole = (int)fmaxf((float)m->position_stride, (float)m->texcoord_stride);
    m->position_stride = m->normal_stride = m->texcoord_stride = whole;
}
CURE(halves)
{
    memcpy(s->index, s->half, sizeof s->half);
    s->mesh.indices = s->index;
    s->mesh.indices16 = NULL;
}
CURE(fill_normals)
{
    shade_mesh_normals(&s->mesh, s->normal);
    s->mesh.normals = &s->normal[0].x;
    s->mesh.normal_stride = 0;
}
/* Bytes that were passed as floats. */
CURE(colors_as_floats)
{
    unsigned char byte[3 * STAGE_VERTICES];
    memcpy(byte, s->color, sizeof byte);
    for (int i = 0; i < 3 * STAGE_VERTICES; i++)
        (&s->color[i / 3].x)[i % 3] = (float)byte[i] / 255;
    s->mesh.colors = &s->color[0].x;
    s->mesh.color_stride = 0;
}
CURE(texcoords_as_floats)
{
    uint16_t half[2 * STAGE_VERTICES];
    memcpy(half, s->texcoord, sizeof half);
    for (int i = 0; i < STAGE_VERTICES; i++)
        s->texcoord[i] = shade_v2((float)half[2 * i] / 65535, (float)half[2 * i + 1] / 65535);
    s->mesh.texcoords = &s->texcoord[0].x;
    s->mesh.texcoord_stride = 0;
}
CURE(levels) { shade_build_mipmaps(&s->map, s->level, s->level_texel, sizeof s->level_texel); }
/* Less the middle of the mesh, in double. */
CURE(middle)
{
    const shade_mat4 model = ex_or_identity(s->state.model);
    double middle[4] = { 0, 0, 0, 0 }, by[4];
    shade_vec3 place[STAGE_VERTICES + STAGE_LAMPS + 2] = { { 0, 0, 0 } };
    for (int k = 0; k < 3; k++) {
        double low = 1e30, high = -1e30;
        for (int i = 0; i < s->mesh.vertex_count; i++) {
            low = fmin(low, s->file[i][k]);
            high = fmax(high, s->file[i][k]);
        }
        middle[k] = (low + high) / 2;
    }
    ex_transform(model, middle, by);
    for (int i = 0; i < STAGE_VERTICES + STAGE_LAMPS + 2; i++)
        for (int k = 0; k < 3; k++)
            (&place[i].x)[k] = (float)(s->file[i][k] - (i < STAGE_VERTICES ? middle[k] : by[k]));
    stage_put(s, place);
}
CURE(both_sides)
{
    s->state.raster.cull = SHADE_CULL_NONE;
    s->state.lighting.flags |= SHADE_FLAG_TWO_SIDED;
}
/* Of the indices, if they were forgotten; or of the faces that were wound the other way. */
CURE(turn_back)
{
    if (s->mesh.indices) stage_turn(s, s->turned);
    else s->mesh.indices = s->index;
    for (int i = 0; i < s->mesh.index_count; i++)
        while (s->index[i] >= (uint32_t)s->mesh.vertex_count) s->mesh.vertex_count++;
}
CURE_LAMPS(positive_lamps, for (int i = 0; i < 9; i++) {
    float *c = &l->ambient.x + i;
    *c = fabsf(*c);
})

/* ---- the table ------------------------------------------------------------------------------- */

CURE(dim_shader)
{
    static const float grey[4] = { 0.2f, 0.2f, 0.2f, 1 };
    s->state.fragment = shader_of_color;
    s->state.uniforms = grey;
}
/* near and far of a perspective trade places. */
CURE(exchanged)
{
    shade_vec4 *col = s->state.projection.col;
    col[2].z = -col[2].z;
    col[3].z = -col[3].z;
    if (s->state.raster.depth_test == SHADE_COMPARE_LESS_EQUAL) return;
    s->state.raster.depth_test = SHADE_COMPARE_LESS;
}
/* What the advice does to the picture: light is that of all terms, of lamps (diffuse, specular), or
   of surfaces that have colours (ambient, diffuse). */
enum effect { STATED, SHOWS, INTO_VIEW, LIGHTS_UP, LAMPS_LIGHT, COLORS_LIGHT, CHANGES, DARKENS,
              MORE_TRIANGLES,
              NEARER };    /* to the picture without the mistake, if there is one mistake */
static void cure_all(stage *s);
typedef struct claim { const char *words; so *so; cure *advice; enum effect effect; } claim;
static const claim claims[] = {
    /* numbers */
    { "stats are not of this draw", so_other_stats, cure_nothing, STATED },
    { "holds a NaN or infinity", NULL, cure_nothing, STATED },
    { "state.model looks transposed", so_model_by_rows, cure_model_by_rows, CHANGES },
    { "state.view looks transposed", so_view_by_rows, cure_view_by_rows, CHANGES },
    { "The last row of state.model", so_last_row, cure_nothing, STATED },
    { "that cameras return", so_degenerate, cure_camera, STATED },
    { "state.model holds a projection", so_model_projects, cure_nothing, STATED },
    { "state.view holds a projection", so_not_rigid, cure_nothing, STATED },
    { "perspective_reversed, which", so_no_flag, cure_flag, STATED },
    { "light_count is negative", so_negative_count, cure_nothing, STATED },
    { "lighting.lights holds a NaN", so_lamp_nan, cure_nothing, STATED },
    { "spot_cos_cutoff is outside", so_bad_cosine, cure_nothing, STATED },
    { "direction without length", NULL, cure_nothing, STATED },
    { "quadratic is negative", so_negative_attenuation, cure_nothing, STATED },
    { "make them so", so_some_bad, cure_nothing, STATED },
    { "so that elements overlap", NULL, cure_nothing, STATED },
    { "There is no triangle to draw", NULL, cure_nothing, STATED },
    { "clip rectangle is empty", so_clip, cure_clip, STATED },
    { "run through each other", so_crossed, cure_strides, NEARER },
    { "Every other entry", so_halves, cure_halves, NEARER },
    { "negative colour", so_negative_lamp, cure_positive_lamps, NEARER },
    { "lie so far from 0", so_coarse, cure_middle, NEARER },
    { "state.projection is row-major", so_by_rows, cure_by_rows, CHANGES },
    { "mesh.normals hold NaN", so_wild_normals, cure_fill_normals, NEARER },
    { "mesh.colors hold NaN", so_wild_colors, cure_colors_as_floats, NEARER },
    { "mesh.texcoords hold NaN", so_wild_texcoords, cure_texcoords_as_floats, NEARER },
    /* nothing is in view */
    { "sum to fewer", so_chunks, cure_chunks, MORE_TRIANGLES },
    { "does not contain its triangles", so_box, cure_chunks, STATED },
    { "raster.cull leaves out", so_inside, cure_cull, SHOWS },
    { "raster.cull is SHADE_CULL_FRONT", so_front, cure_cull, SHOWS },
    { "raster.cull is SHADE_CULL_BACK", so_back, cure_cull, SHOWS },
    { "above every alpha", NULL, cure_cutoff, SHOWS },
    { "state.projection looks transposed", so_by_rows, cure_by_rows, INTO_VIEW },
    { "outside the cube", NULL, cure_camera, INTO_VIEW },
    { "beyond the far plane", so_beyond, cure_camera, INTO_VIEW },
    { "inverse of state.view would", NULL, cure_inverse, INTO_VIEW },
    { "lies behind the eye, where", so_behind_eye, cure_camera, INTO_VIEW },
    { "nearer than the near plane", so_before, cure_camera, INTO_VIEW },
    { "beside the picture, before", NULL, cure_camera, INTO_VIEW },
    { "No pixel centre is covered", NULL, cure_camera, INTO_VIEW },
    /* no pixel passes */
    { "near of state.projection is beyond far", so_far_wins, cure_exchanged, CHANGES },
    { "does not fit state.proj", so_far_wins, cure_depth, CHANGES },
    { "beside the clip rectangle", so_clip, cure_clip, SHOWS },
    { "state.fragment discards", so_shader, cure_shader, SHOWS },
    { "is SHADE_COMPARE_EQUAL", so_equal, cure_depth, SHOWS },
    { "target.depth holds 0", so_not_equal, cure_clear, SHOWS },
    { "Every pixel has the depth of the far plane", NULL, cure_near, SHOWS },
    { "is hidden by depth", so_not_equal, cure_clear, SHOWS },
    /* wrong pixels */
    { "wound both ways", so_both_ways, cure_turn_back, NEARER },
    { "state.view mirrors", so_mirrors, cure_winding, CHANGES },
    { "inside out", so_inside_out, cure_winding, CHANGES },
    { "Triangles drawn later hide", so_order, cure_depth, CHANGES },
    { "fragment) gives black", so_shader, cure_shader, LIGHTS_UP },
    { "adds nothing", so_shader, cure_shader, LIGHTS_UP },
    { "gives NaN", so_shader, cure_shader, CHANGES },
    { "writes lane 0", so_shader, cure_shader, CHANGES },
    { "clipped to white, or a full", so_shader, cure_dim_shader, DARKENS },
    { "Alpha is 0 everywhere", so_shader, cure_shader, LIGHTS_UP },
    { "lit is clipped", so_white, cure_255, DARKENS },
    { "mesh.normals point away from the eye", so_turned, cure_turned, CHANGES },
    /* darkness */
    { "Alpha is 0", NULL, cure_opaque, LIGHTS_UP },
    { "state.shading lights", NULL, cure_shading, LIGHTS_UP },
    { "leaves out every term", NULL, cure_terms, LIGHTS_UP },
    { "mesh.colors, or the texels", so_map_or_colors, cure_colors, COLORS_LIGHT },
    { "state.material reflects", NULL, cure_material, LIGHTS_UP },
    { "black or almost: state.material", NULL, cure_all, LIGHTS_UP },
    { "There is no light", so_no_lamp, cure_any_light, LIGHTS_UP },
    { "and lighting.ambient is dark", so_no_lamp, cure_any_light, LIGHTS_UP },
    { "arrives: lighting.light_count is 0", so_no_lamp, cure_count, LAMPS_LIGHT },
    { "which shows no form", so_no_lamp, cure_count, LAMPS_LIGHT },
    { "mesh.normals are zero or NaN", so_no_normal, cure_normals, LAMPS_LIGHT },
    { "Every lamp is behind", so_behind, cure_sides, LAMPS_LIGHT },
    { "Attenuation, or", NULL, cure_distance, LAMPS_LIGHT },
    { "No cone of a spotlight", so_spot, cure_cone, LAMPS_LIGHT },
    { "The lights have no colour", so_dim, cure_at_eye, LAMPS_LIGHT },
    /* what is seldom meant */
    { "lies beyond the picture", so_beyond_picture, cure_nothing, STATED },
    { "raster.depth_bias makes", so_bias, cure_nothing, STATED },
    { "state.view scales", so_not_rigid, cure_nothing, STATED },
    { "The aspect of", so_aspect, cure_aspect, CHANGES },
    { "state.view is unset", so_no_view, cure_camera, STATED },
    { "Highlights belong to another eye", so_other_eye, cure_eye, CHANGES },
    { "mesh.texcoords is NULL", so_no_texcoords, cure_nothing, STATED },
    { "but no mipmaps", so_no_mipmaps, cure_nothing, STATED },
    { "is not max(1, width >> k)", so_levels, cure_levels, NEARER },
    { "reach the width", so_texels, cure_nothing, STATED },
    { "stored as alpha", so_stored, cure_over, CHANGES },
    { "shininess is below 1", so_dull, cure_shininess, CHANGES },
    { "no negative component", so_mixed, cure_normals, CHANGES },
    { "state.material.emission alone", so_glows, cure_emission, DARKENS },
};
enum { EX_CLAIMS = sizeof claims / sizeof *claims };

/* What may keep a mesh from being seen, and from being lit. */
static cure *const ex_of_view[] = { cure_chunks, cure_cull, cure_cutoff, cure_clip, cure_depth,
                                    cure_clear, cure_shader, cure_near, cure_mesh, cure_model,
                                    cure_projection, cure_camera, NULL };
static cure *const ex_of_light[] = { cure_ambient, cure_no_lamp, cure_opaque, cure_shading,
                                     cure_terms, cure_colors, cure_material, cure_matte, cure_sides,
                                     cure_normals, cure_distance, cure_cone, cure_lamps,
                                     cure_numbers, cure_emission, cure_shader, NULL };
/* All factors of light at their best, and light from everywhere. */
CURE(all)
{
    for (cure *const *one = ex_of_light; *one; one++)
        if (*one != cure_normals && *one != cure_shader && *one != cure_matte) (*one)(s);
    cure_any_light(s);
}
/* What is not mended where the second one is the advice, since it would do the same, or take other
   normals. */
static cure *const ex_alike[][2] = {
    { cure_depth, cure_clear }, { cure_clear, cure_depth }, { cure_normals, cure_sides },
    { cure_sides, cure_turned }, { cure_shading, cure_sides }, { cure_normals, cure_turned },
    { cure_cull, cure_winding }, { cure_sides, cure_winding }, { cure_mesh, cure_winding },
    { cure_opaque, cure_over }, { cure_material, cure_shininess }, { cure_matte, cure_material },
    { cure_projection, cure_by_rows }, { cure_projection, cure_aspect },
    { cure_camera, cure_by_rows }, { cure_camera, cure_view_by_rows }, { cure_camera, cure_aspect },
    { cure_mesh, cure_chunks }, { cure_model, cure_model_by_rows }, { cure_no_lamp, cure_count },
    { cure_no_lamp, cure_any_light }, { cure_lamps, cure_at_eye }, { cure_numbers, cure_at_eye },
};
static int ex_is_apart(cure *mended, cure *advice)
{
    for (size_t k = 0; k < sizeof ex_alike / sizeof *ex_alike; k++)
        if (mended == ex_alike[k][0] && advice == ex_alike[k][1]) return 0;
    return mended != advice;
}
/* A picture after changes, and what it shows: the triangle of each pixel, from 1 on. */
typedef struct trial { picture p; int triangle[EX_PIXELS]; } trial;

/* Draws the stage, with the advice or without it. */
static void ex_try(const judged *j, const claim *c, const stage *given, cure *change, trial *out)
{
    static stage s;
    static geometry g;
    ex_copy(given, &s);
    if (change) change(&s);
    if (c->effect == LAMPS_LIGHT || c->effect == COLORS_LIGHT) {
        unsigned *terms = &s.state.lighting.terms, all = *terms ? *terms : 15u;
        all &= c->effect == LAMPS_LIGHT ? SHADE_TERM_DIFFUSE | SHADE_TERM_SPECULAR
                                        : SHADE_TERM_DIFFUSE | SHADE_TERM_AMBIENT;
        if (all) *terms = all;
    }
    ex_draw(j->e, &s, &out->p);
    if (c->effect != CHANGES) return;
    ex_look(j->e, &s, -1, &g);
    memset(out->triangle, 0, sizeof out->triangle);
    for (int i = 0; i < g.count; i++) out->triangle[g.at[i].place] = g.at[i].triangle + 1;
}
static int ex_is_lit(const claim *c)
{
    return c->effect == LIGHTS_UP || c->effect == LAMPS_LIGHT || c->effect == COLORS_LIGHT;
}
/* Is the picture still as the sentence found it: empty, or nine tenths of it dark? */
static int ex_is_bad_still(const judged *j, const claim *c, const trial *t)
{
    if (c->so == so_behind) return t->p.bright * 3 <= j->shown.count;    /* light of 255 grazes */
    if (ex_is_lit(c)) return t->p.bright * 10 <= j->shown.count;
    return !t->p.stats.fragments;
}
/* Mends what else is wrong in the stage, as long as the picture is as the sentence found it: from
   the first on, or from the last. */
static void ex_mend(const judged *j, const claim *c, cure *const *all, int from_last, stage *s)
{
    static stage mended;
    static trial t;
    int n = 0;
    while (all[n]) n++;
    for (int k = 0; k < n; k++) {
        cure *one = all[from_last ? n - 1 - k : k];
        const int moves = one == cure_mesh || one == cure_model || one == cure_camera ||
                          one == cure_projection ||
                          (one == cure_near && c->advice != cure_clear);
        const int always = c->effect == CHANGES || c->effect == DARKENS;
        if ((moves && c->effect != CHANGES) || (one == cure_cull && ex_is_lit(c)) ||
            !ex_is_apart(one, c->advice))
            continue;
        ex_copy(s, &mended);
        one(&mended);
        ex_try(j, c, &mended, NULL, &t);
        if (always || ex_is_bad_still(j, c, &t)) ex_copy(&mended, s);
    }
}
/* Is the second one what the effect promises of the first? */
static int ex_is_better(const trial *a, const trial *b, enum effect effect)
{
    switch (effect) {
    case STATED: return 1;
    case SHOWS: return !a->p.stats.fragments && b->p.stats.fragments;
    case INTO_VIEW: return !a->p.stats.fragments && b->p.stats.culled + b->p.stats.drawn;
    case MORE_TRIANGLES: return b->p.stats.triangles > a->p.stats.triangles;
    case DARKENS: return b->p.sum < a->p.sum;
    case CHANGES:
        return memcmp(a->p.code, b->p.code, sizeof *a->p.code * EX_WIDTH * EX_HEIGHT) ||
               memcmp(a->triangle, b->triangle, sizeof a->triangle);
    default:    /* more bright pixels, or twice the light and a code more in each pixel */
        return b->p.bright > a->p.bright ||
               b->p.sum >= 2 * a->p.sum + (int)a->p.stats.fragments;
    }
}
/* Does the advice alone change the picture as it promises, or where it does not, that of all rows
   and columns, or after other mistakes are mended, which alone would not do? */
static int ex_works(const judged *j, const claim *c)
{
    static trial before, after;
    static stage s;
    const int seen = c->effect == SHOWS || c->effect == INTO_VIEW;
    for (int k = 0; k < 4; k++) {
        ex_copy(&j->e->s, &s);
        if (k && !seen && (c->effect == CHANGES || !j->shown.count)) cure_clip(&s);
        if (k > 1) {
            if (!ex_is_lit(c) || !j->shown.count) ex_mend(j, c, ex_of_view, k == 3, &s);
            if (!seen && c->effect != DARKENS) ex_mend(j, c, ex_of_light, k == 3, &s);
        }
        ex_try(j, c, &s, NULL, &before);
        ex_try(j, c, &s, c->advice, &after);
        if ((seen || ex_is_lit(c)) && !ex_is_bad_still(j, c, &before)) return 0;
        if (ex_is_better(&before, &after, c->effect)) return 1;
    }
    return 0;
}
/* How many pixels differ from those of the picture without the mistake, beyond 8 of 255? */
static int ex_wrong(const picture *p, const picture *right)
{
    int wrong = 0;
    for (int i = 0; i < p->width * p->height && i < EX_PIXELS; i++) {
        int most = 0;
        for (int k = 0; k < 3; k++) {
            const int apart = abs(p->code[i][k] - right->code[i][k]);
            if (apart > most) most = apart;
        }
        wrong += most > 8;
    }
    return wrong;
}
static int ex_is_nearer(const judged *j, const claim *c)
{
    static picture right, after;
    static stage s;
    int wrong, before;
    ex_copy(&j->e->right, &s);
    ex_draw(j->e, &s, &right);
    before = ex_wrong(j->drawn, &right);
    if (c->advice == cure_turn_back && j->e->s.mesh.indices) {    /* what helps until then */
        ex_copy(&j->e->s, &s);
        cure_both_sides(&s);
        ex_draw(j->e, &s, &after);
        if (ex_wrong(&after, &right) > before) return 0;
    }
    ex_copy(&j->e->s, &s);
    c->advice(&s);
    ex_draw(j->e, &s, &after);
    wrong = ex_wrong(&after, &right);
    return !wrong || wrong < before;
}
/* Is the sentence so, and does its advice help?  That on lamps may light up the whole picture as
   well: distance and cones may dim ambient light. */
static int ex_holds(const judged *j, const claim *c)
{
    claim all = *c;
    all.effect = LIGHTS_UP;
    if (c->so && !c->so(j)) return 0;
    if (c->effect == NEARER) return !j->e->has_right || ex_is_nearer(j, c);
    return ex_works(j, c) || (c->effect == LAMPS_LIGHT && ex_works(j, &all));
}

static void ex_judge(const explained *e, const picture *drawn, judged *j)
{
    static stage s;
    ex_copy(&e->s, &s);
    cure_cull(&s);
    j->e = e;
    j->drawn = drawn;
    j->nearer_is_greater = ex_near_is_greater(&e->s);
    j->eye = ex_eye(&e->s, e->s.target.depth ? ex_is_greater(&e->s.state) : j->nearer_is_greater);
    ex_look(e, &e->s, -1, &j->shown);
    ex_look(e, &s, j->nearer_is_greater ? SHADE_COMPARE_GREATER : SHADE_COMPARE_LESS,
            &j->all);
}

/* The row of a sentence that a draw gets, or one of these.  EX_FALSE is added where it is not so;
   EX_CLAIMS + EX_FALSE where it has no row. */
enum { EX_NOTHING = -1, EX_REFUSED = -2, EX_FALSE = 1000 };
static int ex_explain(explained *e, int with_stats, const char **said)
{
    static picture drawn;
    static judged j;
    stage *s = &e->s;
    ex_draw(e, s, &drawn);
    if (s->other_stats) drawn.stats.triangles += 12;
    *said = shade_explain(s->no_target ? NULL : &s->target, s->no_mesh ? NULL : &s->mesh,
                          s->no_state ? NULL : &s->state, with_stats ? &drawn.stats : NULL);
    if (!with_stats && s->draws > 1) {    /* what the first one drew is shown */
        s->draws = 1;
        ex_draw(e, s, &drawn);
    }
    if (drawn.result) return **said ? EX_REFUSED : EX_CLAIMS + EX_FALSE;
    if (!**said) return EX_NOTHING;
    for (int k = 0; k < EX_CLAIMS; k++) {
        if (!strstr(*said, claims[k].words)) continue;
        ex_judge(e, &drawn, &j);
        return ex_holds(&j, &claims[k]) ? k : k + EX_FALSE;
    }
    return EX_CLAIMS + EX_FALSE;
}
#endif
