/* right.c - the pictures that the project is judged by, drawn by shade.h.  It reads scenes from
   standard input, each after the number of a mistake, and writes pictures.  A mistake is a change
   of the scene or of the state that shade.h draws with: what students get wrong, drawn on purpose,
   so that the judge can tell which one a picture shows.  0 is none. */
#define SHADE_STATIC
#define SHADE_NO_DISPATCH
#define SHADE_IMPLEMENTATION
#include "shade.h"
#ifdef __GNUC__
#define VECTORS static inline __attribute__((unused))
#else
#define VECTORS static inline
#endif
#include "scene.h"
#include <stdio.h>
#include <math.h>
#include <stdlib.h>
#include <string.h>

/* The numbers are those of MISTAKES in scenes.py. */
enum {
    NONE,
    WHOLE_ANGLE,
    NO_ASPECT,
    NO_MODEL,
    NO_TRANSLATION,
    REVERSED_ORDER,
    NOT_DIVIDED,
    WHOLE_WIDTH,
    VIEW_NOT_INVERTED,
    UP_AS_IS,
    AXES_AS_COLUMNS,
    ROWS_TIMES,
    ASPECT_TURNED,
    NOT_CUT,
    NEXT_COLOR,
    FLAT_COLOR,
    MEAN_COLOR,
    CORNERS,
    ONE_WINDING,
    OTHER_WINDING,
    WHOLE_PIXELS,
    NO_DEPTH,
    REVERSED_DEPTH,
    AFFINE,
    DEPTH_OF_FACE,
    NO_GATE,
    MIRRORED,
    HALF_SHORT,
    MODEL_NORMALS,
    LONG_NORMALS,
    AS_FLAT,
    AS_GOURAUD,
    AS_PHONG,
    NO_FALL_OFF,
    ONE_LAMP,
    NO_AMBIENT,
    NO_EXPONENT,
    FAR_VIEWER,
    NO_CONE,
    NO_LAMP_AMBIENT,
    NO_DIFFUSE,
    NO_SPECULAR,
    ITERATION_FEWER,
    NEAREST,
    HALF_TEXEL,
    V_UP,
    UV_SWAPPED,
    CLAMPED,
    NO_LEVEL,
    LEVEL_ABOVE,
    WHOLE_LEVEL,
    NO_BIAS,
    NO_SHADOW,
    DARK_SHADOW,
    OUTSIDE_DARK,
    NO_MAP,
    NOT_DECODED,
    GREEN_DOWN,
    T_AS_IS,
    TB_SWAPPED,
    MAP_ALONE,
    DROPPED,
    NO_TONES,
    TONES_SWAPPED,
    NO_LINES,
    OTHER_EDGES
};

typedef struct drawing {
    scene s;
    int mistake;
    shade_mat4 world_to_clip, view;
    shade_mat3 normals;
    shade_lighting lighting;
    shade_material material;
    shade_texture map, level[5];
    float lod;
    const float *shadow; /* depths of the shadow map */
} drawing;

static float *texels[6];
static float depths[SHADOW_MAP * SHADOW_MAP];

static int is(const drawing *d, int mistake) { return d->mistake == mistake; }
static const vertex *corner(const drawing *d, unsigned k)
{
    return &d->s.vertex[(int)d->s.triangle[k / 3][k % 3]];
}
static shade_vec3 in_world(const drawing *d, const vertex *v)
{
    return is(d, NO_MODEL) ? v->position : shade_mat4_transform_point(d->s.model, v->position);
}
static shade_vec3 normal_of(const drawing *d, const vertex *v)
{
    return shade_normalize(is(d, MODEL_NORMALS)
                               ? shade_mat4_transform_direction(d->s.model, v->normal)
                               : shade_mat3_transform(d->normals, v->normal));
}
static shade_vec3 face_normal(const drawing *d, unsigned triangle)
{
    return shade_face_normal(in_world(d, corner(d, 3 * triangle)),
                             in_world(d, corner(d, 3 * triangle + 1)),
                             in_world(d, corner(d, 3 * triangle + 2)));
}

/* ---- light */
/* Term by term, with N as it is, and with H half of L + V where that is the mistake. */
static shade_vec3 by_terms(const drawing *d, shade_vec3 P, shade_vec3 N)
{
    const shade_material *m = &d->material;
    const shade_vec3 V = shade_normalize(shade_sub(d->s.eye, P));
    shade_lighting l = d->lighting;
    shade_vec3 sum;
    l.terms = SHADE_TERM_EMISSION | SHADE_TERM_AMBIENT;
    sum = shade_lit(&l, m, d->s.eye, P, N);
    for (int k = 0; k < l.light_count; k++) {
        shade_vec3 L, H;
        const float amount = shade_light_at(&l.lights[k], P, &L, NULL), NL = shade_dot(N, L);
        if (NL <= 0) continue;
        H = is(d, HALF_SHORT) ? shade_scale(shade_add(L, V), 0.5f) : shade_halfway(L, V);
        sum = shade_madd(sum, amount * NL, shade_mul(m->diffuse, l.lights[k].diffuse));
        if (l.model == SHADE_MODEL_LAMBERT) continue;
        sum = shade_madd(sum, amount * powf(fmaxf(0, shade_dot(N, H)), m->shininess),
                         shade_mul(m->specular, l.lights[k].specular));
    }
    return sum;
}
static shade_vec3 light(const drawing *d, shade_vec3 P, shade_vec3 N)
{
    shade_lighting l = d->lighting;
    shade_vec3 eye = d->s.eye;
    if (l.model < SHADE_MODEL_AMBIENT && (is(d, HALF_SHORT) || is(d, LONG_NORMALS)))
        return by_terms(d, P, N);
    if (is(d, FAR_VIEWER)) {
        l.flags |= SHADE_FLAG_INFINITE_VIEWER;
        eye = shade_normalize(shade_sub(d->s.eye, d->s.at));
    }
    if (is(d, NO_GATE)) l.flags |= SHADE_FLAG_UNGATED_SPECULAR;
    return shade_lit(&l, &d->material, eye, P, N);
}
static int in_light(const drawing *d, shade_vec3 P)
{
    const shade_vec4 h = shade_mat4_transform(d->s.lamp_camera, shade_v4(P.x, P.y, P.z, 1));
    const float u = (h.x / h.w + 1) / 2, v = (1 - h.y / h.w) / 2;
    if (is(d, NO_SHADOW)) return 1;
    if (h.w <= 0 || !(u >= 0 && u < 1 && v >= 0 && v < 1)) return !is(d, OUTSIDE_DARK);
    return (h.z / h.w + 1) / 2 <=
           d->shadow[(int)(v * SHADOW_MAP) * SHADOW_MAP + (int)(u * SHADOW_MAP)] +
               (is(d, NO_BIAS) ? 0 : d->s.bias);
}
static shade_vec3 shadowed(const drawing *d, shade_vec3 P, shade_vec3 N)
{
    shade_light lamps[LAMPS];
    shade_lighting l = d->lighting;
    const shade_vec3 none = { 0, 0, 0 };
    memcpy(lamps, d->s.lamp, sizeof lamps);
    if (!in_light(d, P)) {
        lamps[0].diffuse = lamps[0].specular = none;
        if (is(d, DARK_SHADOW)) return none;
    }
    l.lights = lamps;
    return shade_lit(&l, &d->material, d->s.eye, P, N);
}
static shade_vec3 bumpy(const drawing *d, shade_vec3 P, shade_vec3 N, shade_vec3 T, float u,
                        float v)
{
    const shade_vec4 t = shade_sample(&d->map, u, v, 0);
    shade_vec3 n = shade_v3(2 * t.x - 1, 2 * t.y - 1, 2 * t.z - 1), B;
    N = shade_normalize(N);
    T = shade_normalize(is(d, T_AS_IS) ? T : shade_madd(T, -shade_dot(N, T), N));
    B = shade_cross(N, T);
    if (is(d, NO_MAP)) n = shade_v3(0, 0, 1);
    if (is(d, NOT_DECODED)) n = shade_v3(t.x, t.y, t.z);
    if (is(d, GREEN_DOWN)) n.y = -n.y;
    if (is(d, TB_SWAPPED)) n = shade_v3(n.y, n.x, n.z);
    if (!is(d, MAP_ALONE))
        n = shade_add(shade_add(shade_scale(T, n.x), shade_scale(B, n.y)), shade_scale(N, n.z));
    return light(d, P, shade_normalize(n));
}

/* ---- shaders */
static int per_pixel(const drawing *d) { return (int)d->s.shading == PHONG; }
static shade_vec3 color_of(const drawing *d, unsigned k)
{
    static const shade_vec3 third = { 1 / 3.0f, 1 / 3.0f, 1 / 3.0f };
    const unsigned t = k / 3 * 3;
    const vertex *v = corner(d, k);
    if (d->s.checkpoint < 4 || ((int)d->s.checkpoint == 6 && (int)d->s.option == CLIP)) {
        if (is(d, NEXT_COLOR)) return corner(d, t + (k + 1) % 3)->color;
        if (is(d, FLAT_COLOR)) return corner(d, t)->color;
        if (is(d, MEAN_COLOR))
            return shade_mul(third,
                             shade_add(shade_add(corner(d, t)->color, corner(d, t + 1)->color),
                                       corner(d, t + 2)->color));
        return v->color;
    }
    if ((int)d->s.shading == FLAT) {
        shade_vec3 P =
            shade_add(shade_add(in_world(d, corner(d, t)), in_world(d, corner(d, t + 1))),
                      in_world(d, corner(d, t + 2)));
        return light(d, shade_mul(P, third), face_normal(d, k / 3));
    }
    return (int)d->s.shading == GOURAUD ? light(d, in_world(d, v), normal_of(d, v)) : v->color;
}
static void put3(shade_vertices *out, int row, int i, shade_vec3 v)
{
    out->varying[row][i] = v.x;
    out->varying[row + 1][i] = v.y;
    out->varying[row + 2][i] = v.z;
}
static shade_vec4 clip_of(const drawing *d, unsigned k)
{
    const shade_vec3 P = in_world(d, corner(d, k));
    shade_vec4 c = shade_mat4_transform(d->world_to_clip, shade_v4(P.x, P.y, P.z, 1));
    if (is(d, NOT_DIVIDED)) c.w = 1;
    if (is(d, AFFINE) && c.w > 0) c = shade_scale4(c, 1 / c.w);
    if (is(d, WHOLE_WIDTH)) c = shade_v4(2 * c.x + c.w, 2 * c.y - c.w, c.z, c.w);
    if (is(d, CORNERS)) c = shade_v4(c.x + c.w / WIDTH, c.y - c.w / HEIGHT, c.z, c.w);
    if (is(d, WHOLE_PIXELS)) {
        c.x = c.w * (2 * floorf((c.x / c.w + 1) / 2 * WIDTH) / WIDTH - 1);
        c.y = c.w * (1 - 2 * floorf((1 - c.y / c.w) / 2 * HEIGHT) / HEIGHT);
    }
    return c;
}
static void vertex_shader(const void *u, const shade_vertex_ids *SHADE_RESTRICT in,
                          shade_vertices *SHADE_RESTRICT out)
{
    const drawing *d = u;
    for (int i = 0; i < SHADE_LANES; i++) {
        const unsigned k = in->index[i];
        const vertex *v = corner(d, k);
        const shade_vec4 c = clip_of(d, k);
        const float z =
            is(d, DEPTH_OF_FACE) ? clip_of(d, k / 3 * 3).z / clip_of(d, k / 3 * 3).w * c.w : c.z;
        out->clip[0][i] = c.x;
        out->clip[1][i] = c.y;
        out->clip[2][i] = z;
        out->clip[3][i] = c.w;
        put3(out, 0, i, in_world(d, v));
        put3(out, 3, i, normal_of(d, v));
        put3(out, 6, i, color_of(d, k));
        out->varying[9][i] = v->uv.x;
        out->varying[10][i] = v->uv.y;
        put3(out, 11, i, shade_normalize(shade_mat4_transform_direction(d->s.model, v->tangent)));
    }
}
static shade_vec3 get3(const shade_fragments *in, int row, int i)
{
    return shade_v3(in->varying[row][i], in->varying[row + 1][i], in->varying[row + 2][i]);
}
static shade_vec3 texel(const drawing *d, float u, float v)
{
    const float half = is(d, HALF_TEXEL) ? 0.5f / MAP : 0;
    shade_vec4 t;
    u += half;
    v += half;
    t = is(d, UV_SWAPPED) ? shade_sample(&d->map, v, u, d->lod)
                          : shade_sample(&d->map, u, is(d, V_UP) ? 1 - v : v, d->lod);
    return shade_v3(t.x, t.y, t.z);
}
static void fragment_shader(const void *u, const shade_fragments *SHADE_RESTRICT in,
                            shade_colors *SHADE_RESTRICT out)
{
    const drawing *d = u;
    const int step = (int)d->s.checkpoint, option = (int)d->s.option;
    for (int i = 0; i < SHADE_LANES; i++) {
        const shade_vec3 P = get3(in, 0, i), N = get3(in, 3, i);
        shade_vec3 c = get3(in, 6, i);
        if (step == 4 && per_pixel(d))
            c = light(d, P, is(d, LONG_NORMALS) ? N : shade_normalize(N));
        if (step == 5) c = texel(d, in->varying[9][i], in->varying[10][i]);
        if (step == 6 && option == SHADOW) c = shadowed(d, P, shade_normalize(N));
        if (step == 6 && option == BUMP)
            c = bumpy(d, P, N, get3(in, 11, i), in->varying[9][i], in->varying[10][i]);
        if (step == 6 && option == SILHOUETTES) c = light(d, P, shade_normalize(N));
        out->color[0][i] = c.x;
        out->color[1][i] = c.y;
        out->color[2][i] = c.z;
    }
}

/* ---- points */
static void dot_at(const drawing *d, float (*pixels)[4], shade_vec3 world, shade_vec3 color)
{
    shade_vec4 c = shade_mat4_transform(d->world_to_clip, shade_v4(world.x, world.y, world.z, 1));
    int x, y;
    if (is(d, NOT_DIVIDED)) c.w = 1;
    if (c.w <= 0 || (!(c.z >= -c.w && c.z <= c.w) && !is(d, NOT_CUT))) return;
    if (is(d, WHOLE_WIDTH)) c = shade_v4(2 * c.x + c.w, 2 * c.y - c.w, c.z, c.w);
    x = (int)floorf((c.x / c.w + 1) / 2 * WIDTH);
    y = (int)floorf((1 - c.y / c.w) / 2 * HEIGHT);
    if (x < 0 || y < 0 || x >= WIDTH || y >= HEIGHT) return;
    pixels[y * WIDTH + x][0] = color.x;
    pixels[y * WIDTH + x][1] = color.y;
    pixels[y * WIDTH + x][2] = color.z;
}
static int same(shade_vec3 a, shade_vec3 b) { return shade_distance(a, b) < 1e-6f; }
/* Marks the ends of edges of which one face is seen from the front and the other from behind. */
static void silhouettes(const drawing *d, float (*pixels)[4])
{
    const unsigned n = (unsigned)d->s.triangles;
    const shade_vec3 black = { 0, 0, 0 };
    for (unsigned a = 0; a < 3 * n; a++) {
        for (unsigned b = 0; b < 3 * n; b++) {
            const unsigned a2 = a / 3 * 3 + (a + 1) % 3, b2 = b / 3 * 3 + (b + 1) % 3;
            const shade_vec3 P = in_world(d, corner(d, a)), Q = in_world(d, corner(d, a2));
            shade_vec3 e;
            if (a / 3 == b / 3 || !same(P, in_world(d, corner(d, b2))) ||
                !same(Q, in_world(d, corner(d, b))))
                continue;
            e = shade_sub(d->s.eye, P);
            if (shade_is_silhouette(e, face_normal(d, a / 3), face_normal(d, b / 3)) !=
                is(d, OTHER_EDGES)) {
                dot_at(d, pixels, P, black);
                dot_at(d, pixels, Q, black);
            }
        }
    }
}

/* ---- a scene */
static shade_mat4 camera(drawing *d)
{
    const scene *s = &d->s;
    const float aspect = is(d, NO_ASPECT)       ? 1
                         : is(d, ASPECT_TURNED) ? HEIGHT / (float)WIDTH
                                                : WIDTH / (float)HEIGHT;
    const shade_mat4 projection = shade_mat4_perspective(
        is(d, WHOLE_ANGLE) ? fminf(2 * s->fovy, 3.1f) : s->fovy, aspect, s->near_z, s->far_z);
    const shade_vec3 at = s->at;
    d->view = shade_mat4_look_at(s->eye, at, s->up);
    if (is(d, NO_TRANSLATION)) d->view.col[3] = shade_v4(0, 0, 0, 1);
    if (is(d, VIEW_NOT_INVERTED)) d->view = shade_mat4_inverse(d->view);
    if (is(d, AXES_AS_COLUMNS)) {
        const shade_vec4 eye = d->view.col[3];
        d->view.col[3] = shade_v4(0, 0, 0, 1);
        d->view = shade_mat4_transpose(d->view);
        d->view.col[3] = eye;
    }
    if (is(d, UP_AS_IS)) {
        const shade_vec3 z = shade_normalize(shade_sub(s->eye, at)), y = shade_normalize(s->up);
        const shade_vec3 x = shade_normalize(shade_cross(y, z));
        d->view = shade_mat4_identity();
        d->view.col[0] = shade_v4(x.x, y.x, z.x, 0);
        d->view.col[1] = shade_v4(x.y, y.y, z.y, 0);
        d->view.col[2] = shade_v4(x.z, y.z, z.z, 0);
        d->view.col[3] =
            shade_v4(-shade_dot(x, s->eye), -shade_dot(y, s->eye), -shade_dot(z, s->eye), 1);
    }
    if (is(d, REVERSED_ORDER)) return shade_mat4_mul(d->view, projection);
    return shade_mat4_mul(projection, d->view);
}
static void change_light(drawing *d)
{
    static const shade_model model[5] = { SHADE_MODEL_EMISSIVE, SHADE_MODEL_AMBIENT,
                                          SHADE_MODEL_LAMBERT, SHADE_MODEL_BLINN_PHONG,
                                          SHADE_MODEL_BLINN_PHONG };
    const shade_vec3 none = { 0, 0, 0 };
    scene *s = &d->s;
    int iteration = (int)s->iteration - is(d, ITERATION_FEWER);
    if (iteration < 0) iteration = 0;
    d->material = s->material;
    for (int k = 0; k < LAMPS; k++) {
        shade_light *l = &s->lamp[k];
        if (is(d, NO_FALL_OFF) || iteration < 4) {
            l->constant = 1;
            l->linear = l->quadratic = 0;
        }
        if (is(d, NO_CONE) || iteration < 4) l->spot_direction = none;
        if (is(d, NO_LAMP_AMBIENT) || iteration < 4) l->ambient = none;
    }
    if (is(d, NO_EXPONENT)) d->material.shininess = 1;
    if (is(d, NO_DIFFUSE)) d->material.diffuse = none;
    if (is(d, NO_SPECULAR)) d->material.specular = none;
    d->lighting.lights = s->lamp;
    d->lighting.light_count = is(d, ONE_LAMP) || iteration < 4 ? 1 : (int)s->lamps;
    d->lighting.ambient = is(d, NO_AMBIENT) ? none : s->ambient;
    d->lighting.model = is(d, MIRRORED) && iteration > 2 ? SHADE_MODEL_PHONG : model[iteration];
    if ((int)s->checkpoint == 6 && (int)s->option == SILHOUETTES && !is(d, NO_TONES)) {
        d->lighting.model = SHADE_MODEL_COOL_TO_WARM;
        d->lighting.cool = shade_v3(0.4f, 0.4f, 0.7f);
        d->lighting.warm = shade_v3(0.8f, 0.6f, 0.6f);
        if (is(d, TONES_SWAPPED)) {
            d->lighting.cool = shade_v3(0.8f, 0.6f, 0.6f);
            d->lighting.warm = shade_v3(0.4f, 0.4f, 0.7f);
        }
    }
    if (is(d, AS_FLAT)) s->shading = FLAT;
    if (is(d, AS_GOURAUD)) s->shading = GOURAUD;
    if (is(d, AS_PHONG)) s->shading = PHONG;
}
static void make_map(drawing *d)
{
    const scene *s = &d->s;
    const int clamp = is(d, CLAMPED);
    shade_vec2 a, b;
    shade_vec4 p[3];
    float covered, pixels;
    for (int k = 0; k < MAP * MAP; k++) {
        texels[0][4 * k] = s->map[k].x;
        texels[0][4 * k + 1] = s->map[k].y;
        texels[0][4 * k + 2] = s->map[k].z;
        texels[0][4 * k + 3] = 1;
    }
    d->map.pixels = texels[0];
    d->map.width = d->map.height = MAP;
    d->map.format = SHADE_FORMAT_RGBA32F;
    d->map.wrap_u = d->map.wrap_v = clamp ? SHADE_WRAP_CLAMP : SHADE_WRAP_REPEAT;
    d->map.filter = is(d, NEAREST) ? SHADE_FILTER_NEAREST : SHADE_FILTER_BILINEAR;
    if (!s->mipmaps || (int)s->checkpoint != 5) return;
    d->map.filter = SHADE_FILTER_TRILINEAR;
    shade_build_mipmaps(&d->map, d->level, texels[1], 4 * MAP * MAP * sizeof(float));
    a = shade_sub2(corner(d, 1)->uv, corner(d, 0)->uv);
    b = shade_sub2(corner(d, 2)->uv, corner(d, 0)->uv);
    covered = fabsf(a.x * b.y - a.y * b.x) * MAP * MAP;
    for (unsigned k = 0; k < 3; k++) {
        p[k] = clip_of(d, k);
        p[k] = shade_v4(p[k].x / p[k].w * WIDTH / 2, p[k].y / p[k].w * HEIGHT / 2, 0, 0);
    }
    pixels = fabsf((p[1].x - p[0].x) * (p[2].y - p[0].y) - (p[1].y - p[0].y) * (p[2].x - p[0].x));
    d->lod = fmaxf(0, 0.5f * log2f(covered / pixels));
    if (is(d, NO_LEVEL)) d->lod = 0;
    if (is(d, LEVEL_ABOVE)) d->lod += 1;
    if (is(d, WHOLE_LEVEL)) d->lod = floorf(d->lod);
}
static void draw(drawing *d, shade_target *target)
{
    shade_pipeline p = {
        .vertex = vertex_shader, .fragment = fragment_shader, .uniforms = d, .varyings = 14
    };
    uint32_t index[3 * TRIANGLES];
    int count = 0;
    p.raster.depth_test = d->s.checkpoint < 3 || is(d, NO_DEPTH) ? SHADE_COMPARE_ALWAYS
                          : is(d, REVERSED_DEPTH)                ? SHADE_COMPARE_GREATER
                                                                 : SHADE_COMPARE_LESS;
    p.raster.cull = is(d, ONE_WINDING)     ? SHADE_CULL_BACK
                    : is(d, OTHER_WINDING) ? SHADE_CULL_FRONT
                                           : SHADE_CULL_NONE;
    for (unsigned k = 0; k < (unsigned)d->s.triangles; k++) {
        int behind = 0;
        for (unsigned j = 0; j < 3; j++) {
            const shade_vec4 c = clip_of(d, 3 * k + j);
            behind += c.z < -c.w;
        }
        if (behind && is(d, DROPPED)) continue;
        for (unsigned j = 0; j < 3; j++) index[count++] = 3 * k + j;
    }
    shade_draw(target, &p, index, count, 3 * (int)d->s.triangles, NULL);
}
static void shadow_map(drawing *d)
{
    drawing from = *d;
    shade_target target = { .width = SHADOW_MAP, .height = SHADOW_MAP, .depth = depths };
    shade_pipeline p = { .vertex = vertex_shader, .uniforms = &from, .varyings = 14 };
    from.world_to_clip = d->s.lamp_camera;
    from.mistake = NONE;
    from.s.checkpoint = 1;
    shade_clear(&target, shade_v4(0, 0, 0, 1), 1);
    shade_draw(&target, &p, NULL, 3 * (int)d->s.triangles, 3 * (int)d->s.triangles, NULL);
    d->shadow = depths;
}

int main(void)
{
    static drawing d;
    static float pixels[WIDTH * HEIGHT][4], depth[WIDTH * HEIGHT];
    static scene given;
    shade_target target = { .width = WIDTH,
                            .height = HEIGHT,
                            .format = SHADE_FORMAT_RGBA32F,
                            .color = pixels,
                            .depth = depth };
    float mistake;
    for (int k = 0; k < 6; k++) texels[k] = malloc(4 * MAP * MAP * sizeof(float));
    while (fread(&mistake, sizeof mistake, 1, stdin) && fread(&given, sizeof given, 1, stdin)) {
        memset(&d, 0, sizeof d);
        d.s = given;
        d.mistake = (int)mistake;
        d.world_to_clip = camera(&d);
        if (is(&d, ROWS_TIMES))
            d.world_to_clip = shade_mat4_transpose(shade_mat4_mul(d.world_to_clip, d.s.model));
        if (is(&d, NO_MODEL) || is(&d, ROWS_TIMES)) d.s.model = shade_mat4_identity();
        d.normals = shade_normal_matrix(d.s.model);
        change_light(&d);
        make_map(&d);
        shade_clear(&target, shade_v4(0.1f, 0.1f, 0.15f, 1), is(&d, REVERSED_DEPTH) ? 0.0f : 1.0f);
        if ((int)d.s.checkpoint == 1) {
            for (int k = 0; k < (int)d.s.vertices; k++)
                dot_at(&d, pixels, in_world(&d, &d.s.vertex[k]), d.s.vertex[k].color);
        } else {
            if ((int)d.s.checkpoint == 6 && (int)d.s.option == SHADOW) shadow_map(&d);
            draw(&d, &target);
        }
        if ((int)d.s.checkpoint == 6 && (int)d.s.option == SILHOUETTES && !is(&d, NO_LINES))
            silhouettes(&d, pixels);
        for (int k = 0; k < WIDTH * HEIGHT; k++) fwrite(pixels[k], sizeof(float), 3, stdout);
    }
    return 0;
}
