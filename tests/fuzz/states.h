/* states.h - states of draws, and pictures of them: random ones, where anything goes, and ordinary
   ones, sensible scenes with none, one or two of the mistakes in tests/unit/mistakes.h.

   Whoever includes this defines explained_pick(n), which gives a number from 0 to n - 1. */
#ifndef EXPLAINED_STATES_H
#define EXPLAINED_STATES_H

#include "../unit/mistakes.h"

enum { EX_WIDTH = 24, EX_HEIGHT = 16, EX_PIXELS = 4 * EX_WIDTH * EX_HEIGHT };

typedef struct explained {
    stage s;                     /* as generated */
    shade_mat4 other;            /* model of the mesh that is drawn before; zero: none is */
    const char *made[2];         /* mistakes of an ordinary state */
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
static void ex_ordinary(explained *e)
{
    const int wrong = explained_pick(3);
    int of_anybody = 0;          /* they come first in the list */
    for (const mistake *m = mistake_first; m->scenes & ON_TEAPOT; m = m->next) of_anybody++;
    ex_sensible(e);
    for (int k = 0; k < wrong; k++) {
        const mistake *m = mistake_first;
        for (int i = explained_pick(of_anybody); i > 0; i--) m = m->next;
        e->made[k] = m->name;
        m->make(&e->s);
    }
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
    EX_MOVE(m->chunks);
    EX_MOVE(d->material);
    EX_MOVE(d->lighting.lights);
    EX_MOVE(d->diffuse_map);
    EX_MOVE(out->map.pixels);
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
#endif
