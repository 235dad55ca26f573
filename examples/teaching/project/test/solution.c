/* solution.c - the project, solved with vectors.h alone.  Students do not get it. */
#include "scene.h"
#include <string.h>

enum { VALUES = 14 }; /* interpolated: P 0, N 3, colour 6, uv 9, tangent 11 */
typedef struct point {
    shade_vec4 clip;
    float value[VALUES];
} point;
typedef struct frame {
    const scene *s;
    picture *p;
    float *depth; /* NULL: no test */
    int width, height;
    shade_mat4 camera;
    float level;
    const float *shadow;
    shade_vec3 maps[5][MAP * MAP];
} frame;

/* ---- checkpoint 1 */
static shade_mat4 look_at(shade_vec3 eye, shade_vec3 at, shade_vec3 up)
{
    const shade_vec3 z = shade_normalize(shade_sub(eye, at));
    const shade_vec3 x = shade_normalize(shade_cross(up, z)), y = shade_cross(z, x);
    const shade_mat4 m = { { { x.x, y.x, z.x, 0 },
                             { x.y, y.y, z.y, 0 },
                             { x.z, y.z, z.z, 0 },
                             { -shade_dot(x, eye), -shade_dot(y, eye), -shade_dot(z, eye), 1 } } };
    return m;
}
static shade_mat4 perspective(float fovy, float aspect, float n, float far_z)
{
    const float f = 1 / tanf(fovy / 2);
    const shade_mat4 m = { { { f / aspect, 0, 0, 0 },
                             { 0, f, 0, 0 },
                             { 0, 0, (far_z + n) / (n - far_z), -1 },
                             { 0, 0, 2 * far_z * n / (n - far_z), 0 } } };
    return m;
}
static shade_vec3 to_world(const scene *s, shade_vec3 p)
{
    return shade_mat4_transform_point(s->model, p);
}
static shade_vec4 to_clip(const frame *f, shade_vec3 p)
{
    return shade_mat4_transform(f->camera, shade_v4(p.x, p.y, p.z, 1));
}
static void plot(frame *f, shade_vec3 world, shade_vec3 color)
{
    const shade_vec4 c = to_clip(f, world);
    int i, j;
    if (c.w <= 0 || c.z < -c.w || c.z > c.w) return;
    i = (int)floorf((c.x / c.w + 1) * f->width / 2);
    j = (int)floorf((1 - c.y / c.w) * f->height / 2);
    if (i >= 0 && j >= 0 && i < WIDTH && j < HEIGHT) f->p->color[j][i] = color;
}

/* ---- checkpoint 4 */
static shade_vec3 light(const scene *s, shade_vec3 P, shade_vec3 N, float visible)
{
    const shade_material *m = &s->material;
    const int iteration = (int)s->iteration;
    const shade_vec3 V = shade_normalize(shade_sub(s->eye, P));
    shade_vec3 sum = m->emission;
    if (iteration >= 1) sum = shade_add(sum, shade_mul(m->ambient, s->ambient));
    for (int k = 0; iteration >= 2 && k < (iteration == 4 ? (int)s->lamps : 1); k++) {
        const shade_light *l = &s->lamp[k];
        const shade_vec3 to = shade_sub(shade_v3(l->position.x, l->position.y, l->position.z), P);
        const float r = shade_length(to);
        const shade_vec3 L = shade_normalize(to), H = shade_normalize(shade_add(L, V));
        const float NL = shade_dot(N, L);
        float amount = k == 0 ? visible : 1;
        if (iteration == 4) {
            const float LS = -shade_dot(L, shade_normalize(l->spot_direction));
            sum = shade_add(sum, shade_mul(m->ambient, l->ambient));
            amount *= LS >= l->spot_cos_cutoff ? powf(fmaxf(0, LS), l->spot_exponent) : 0;
            amount /= l->constant + l->linear * r + l->quadratic * r * r;
        }
        if (NL <= 0) continue;
        sum = shade_madd(sum, amount * NL, shade_mul(m->diffuse, l->diffuse));
        if (iteration >= 3)
            sum = shade_madd(sum, amount * powf(fmaxf(0, shade_dot(N, H)), m->shininess),
                             shade_mul(m->specular, l->specular));
    }
    return sum;
}

/* ---- checkpoint 5 */
static shade_vec3 bilinear(const shade_vec3 *map, int size, float u, float v)
{
    const float x = u * size - 0.5f, y = v * size - 0.5f, s = x - floorf(x), t = y - floorf(y);
    const int i = (int)floorf(x) & (size - 1), i2 = (i + 1) & (size - 1);
    const int j = (int)floorf(y) & (size - 1), j2 = (j + 1) & (size - 1);
    return shade_lerp(shade_lerp(map[j * size + i], map[j * size + i2], s),
                      shade_lerp(map[j2 * size + i], map[j2 * size + i2], s), t);
}
static void make_levels(frame *f)
{
    memcpy(f->maps[0], f->s->map, sizeof f->s->map);
    for (int l = 1, size = MAP / 2; l < 5; l++, size /= 2)
        for (int k = 0; k < size * size; k++) {
            const shade_vec3 *from = f->maps[l - 1] + k / size * 2 * 2 * size + k % size * 2;
            f->maps[l][k] = shade_scale(shade_add(shade_add(from[0], from[1]),
                                                  shade_add(from[2 * size], from[2 * size + 1])),
                                        0.25f);
        }
}
static shade_vec3 texel(const frame *f, float u, float v)
{
    const float level = fminf(f->level, 4);
    const int l = (int)level, next = l < 4 ? l + 1 : 4;
    return shade_lerp(bilinear(f->maps[l], MAP >> l, u, v),
                      bilinear(f->maps[next], MAP >> next, u, v), level - l);
}

/* ---- checkpoint 6 */
static float visible(const frame *f, shade_vec3 P)
{
    const shade_vec4 c = shade_mat4_transform(f->s->lamp_camera, shade_v4(P.x, P.y, P.z, 1));
    const float u = (c.x / c.w + 1) / 2, v = (1 - c.y / c.w) / 2;
    if (c.w <= 0 || !(u >= 0 && u < 1 && v >= 0 && v < 1)) return 1;
    return (c.z / c.w + 1) / 2 <=
           f->shadow[(int)(v * SHADOW_MAP) * SHADOW_MAP + (int)(u * SHADOW_MAP)] + f->s->bias;
}
static shade_vec3 bumped(const frame *f, shade_vec3 N, shade_vec3 T, float u, float v)
{
    const shade_vec3 t = bilinear(f->s->map, MAP, u, v);
    const shade_vec3 n = shade_sub(shade_scale(t, 2), shade_v3(1, 1, 1));
    T = shade_normalize(shade_madd(T, -shade_dot(N, T), N));
    return shade_normalize(shade_add(
        shade_add(shade_scale(T, n.x), shade_scale(shade_cross(N, T), n.y)), shade_scale(N, n.z)));
}
static shade_vec3 tone(const scene *s, shade_vec3 P, shade_vec3 N)
{
    const shade_vec4 at = s->lamp[0].position;
    const shade_vec3 L = shade_normalize(shade_sub(shade_v3(at.x, at.y, at.z), P));
    const shade_vec3 cool = { 0.4f, 0.4f, 0.7f }, warm = { 0.8f, 0.6f, 0.6f };
    return shade_add(s->material.emission, shade_lerp(cool, warm, (1 + shade_dot(N, L)) / 2));
}

/* ---- checkpoints 2 and 3 */
static shade_vec3 color(const frame *f, const float *v)
{
    const scene *s = f->s;
    const int step = (int)s->checkpoint, option = (int)s->option;
    const shade_vec3 P = { v[0], v[1], v[2] }, N = shade_normalize(shade_v3(v[3], v[4], v[5]));
    if (step == 4 && (int)s->shading == PHONG) return light(s, P, N, 1);
    if (step == 5) return texel(f, v[9], v[10]);
    if (step == 6 && option == SHADOW) return light(s, P, N, visible(f, P));
    if (step == 6 && option == BUMP)
        return light(s, P, bumped(f, N, shade_v3(v[11], v[12], v[13]), v[9], v[10]), 1);
    if (step == 6 && option == SILHOUETTES) return tone(s, P, N);
    return shade_v3(v[6], v[7], v[8]);
}
static void triangle(frame *f, const point *a, const point *b, const point *c)
{
    const point *at[3] = { a, b, c };
    float X[3], Y[3], Z[3], iw[3], whole;
    for (int k = 0; k < 3; k++) {
        iw[k] = 1 / at[k]->clip.w;
        X[k] = (at[k]->clip.x * iw[k] + 1) * f->width / 2;
        Y[k] = (1 - at[k]->clip.y * iw[k]) * f->height / 2;
        Z[k] = (at[k]->clip.z * iw[k] + 1) / 2;
    }
    whole = (X[1] - X[0]) * (Y[2] - Y[0]) - (X[2] - X[0]) * (Y[1] - Y[0]);
    if (whole == 0) return;
    for (int j = 0; j < f->height; j++)
        for (int i = 0; i < f->width; i++) {
            const float x = i + 0.5f, y = j + 0.5f;
            float w[3], sum = 0, z, value[VALUES];
            for (int k = 0; k < 3; k++) {
                const int n = (k + 1) % 3, m = (k + 2) % 3;
                w[k] = ((X[n] - x) * (Y[m] - y) - (X[m] - x) * (Y[n] - y)) / whole;
            }
            if (w[0] < 0 || w[1] < 0 || w[2] < 0) continue;
            z = w[0] * Z[0] + w[1] * Z[1] + w[2] * Z[2];
            if (f->depth && z >= f->depth[j * f->width + i]) continue;
            if (f->depth) f->depth[j * f->width + i] = z;
            if (!f->p) continue;
            for (int k = 0; k < 3; k++) sum += w[k] * iw[k];
            for (int n = 0; n < VALUES; n++)
                value[n] = (w[0] * iw[0] * a->value[n] + w[1] * iw[1] * b->value[n] +
                            w[2] * iw[2] * c->value[n]) /
                           sum;
            f->p->color[j][i] = color(f, value);
        }
}
static void clip_and_draw(frame *f, const point *corner)
{
    point kept[4];
    int count = 0;
    for (int k = 0; k < 3; k++) {
        const point *a = &corner[k], *b = &corner[(k + 1) % 3];
        const float da = a->clip.z + a->clip.w, db = b->clip.z + b->clip.w, t = da / (da - db);
        if (da >= 0) kept[count++] = *a;
        if ((da >= 0) != (db >= 0)) {
            kept[count].clip = shade_lerp4(a->clip, b->clip, t);
            for (int n = 0; n < VALUES; n++)
                kept[count].value[n] = a->value[n] + t * (b->value[n] - a->value[n]);
            count++;
        }
    }
    for (int k = 2; k < count; k++) triangle(f, &kept[0], &kept[k - 1], &kept[k]);
}
static void put(float *to, shade_vec3 v)
{
    to[0] = v.x;
    to[1] = v.y;
    to[2] = v.z;
}
static shade_vec3 face_normal(const scene *s, const vertex *const *v)
{
    const shade_vec3 a = to_world(s, v[0]->position);
    return shade_normalize(shade_cross(shade_sub(to_world(s, v[1]->position), a),
                                       shade_sub(to_world(s, v[2]->position), a)));
}
static void draw(frame *f)
{
    const scene *s = f->s;
    const shade_mat3 normals =
        shade_mat3_transpose(shade_mat3_inverse(shade_mat3_from_mat4(s->model)));
    const int lit = (int)s->checkpoint == 4;
    for (int k = 0; k < (int)s->triangles; k++) {
        const vertex *v[3];
        point corner[3];
        for (int j = 0; j < 3; j++) v[j] = &s->vertex[(int)s->triangle[k][j]];
        for (int j = 0; j < 3; j++) {
            const shade_vec3 P = to_world(s, v[j]->position);
            const shade_vec3 N = shade_normalize(shade_mat3_transform(normals, v[j]->normal));
            shade_vec3 c = v[j]->color;
            if (lit && (int)s->shading == GOURAUD) c = light(s, P, N, 1);
            if (lit && (int)s->shading == FLAT)
                c = light(s,
                          shade_scale(shade_add(shade_add(to_world(s, v[0]->position),
                                                          to_world(s, v[1]->position)),
                                                to_world(s, v[2]->position)),
                                      1 / 3.0f),
                          face_normal(s, v), 1);
            corner[j].clip = to_clip(f, P);
            put(corner[j].value, P);
            put(corner[j].value + 3, N);
            put(corner[j].value + 6, c);
            corner[j].value[9] = v[j]->uv.x;
            corner[j].value[10] = v[j]->uv.y;
            put(corner[j].value + 11,
                shade_normalize(shade_mat4_transform_direction(s->model, v[j]->tangent)));
        }
        if (k == 0 && s->mipmaps) {
            const shade_vec2 a = shade_sub2(v[1]->uv, v[0]->uv), b = shade_sub2(v[2]->uv, v[0]->uv);
            shade_vec2 q[3];
            for (int j = 0; j < 3; j++)
                q[j] = shade_v2(corner[j].clip.x / corner[j].clip.w * WIDTH / 2,
                                corner[j].clip.y / corner[j].clip.w * HEIGHT / 2);
            q[1] = shade_sub2(q[1], q[0]);
            q[2] = shade_sub2(q[2], q[0]);
            f->level = fmaxf(0, 0.5f * log2f(fabsf(a.x * b.y - a.y * b.x) * MAP * MAP /
                                             fabsf(q[1].x * q[2].y - q[1].y * q[2].x)));
        }
        clip_and_draw(f, corner);
    }
}
static int meet(shade_vec3 a, shade_vec3 b) { return shade_distance(a, b) < 1e-5f; }
static void silhouettes(frame *f)
{
    const scene *s = f->s;
    for (int a = 0; a < 3 * (int)s->triangles; a++)
        for (int b = 0; b < 3 * (int)s->triangles; b++) {
            const vertex *v[2][3];
            for (int j = 0; j < 3; j++) {
                v[0][j] = &s->vertex[(int)s->triangle[a / 3][(a % 3 + j) % 3]];
                v[1][j] = &s->vertex[(int)s->triangle[b / 3][(b % 3 + j) % 3]];
            }
            if (a / 3 == b / 3 || !meet(v[0][0]->position, v[1][1]->position) ||
                !meet(v[0][1]->position, v[1][0]->position))
                continue;
            const shade_vec3 P = to_world(s, v[0][0]->position), Q = to_world(s, v[0][1]->position);
            const shade_vec3 e = shade_sub(s->eye, P);
            if (shade_dot(e, face_normal(s, v[0])) * shade_dot(e, face_normal(s, v[1])) <= 0) {
                plot(f, P, shade_v3(0, 0, 0));
                plot(f, Q, shade_v3(0, 0, 0));
            }
        }
}

void render(const scene *s, picture *p)
{
    static float depth[WIDTH * HEIGHT], shadow[SHADOW_MAP * SHADOW_MAP];
    static frame f;
    const int step = (int)s->checkpoint, option = (int)s->option;
    memset(&f, 0, sizeof f);
    f.s = s;
    make_levels(&f);
    if (step == 6 && option == SHADOW) {
        for (int k = 0; k < SHADOW_MAP * SHADOW_MAP; k++) shadow[k] = 1;
        f.depth = shadow;
        f.width = f.height = SHADOW_MAP;
        f.camera = s->lamp_camera;
        draw(&f);
        f.shadow = shadow;
    }
    f.p = p;
    f.width = WIDTH;
    f.height = HEIGHT;
    f.camera = shade_mat4_mul(perspective(s->fovy, (float)WIDTH / HEIGHT, s->near_z, s->far_z),
                              look_at(s->eye, s->at, s->up));
    for (int k = 0; k < WIDTH * HEIGHT; k++) depth[k] = 1;
    f.depth = step >= 3 ? depth : 0;
    if (step == 1)
        for (int k = 0; k < (int)s->vertices; k++)
            plot(&f, to_world(s, s->vertex[k].position), s->vertex[k].color);
    else
        draw(&f);
    if (step == 6 && option == SILHOUETTES) silhouettes(&f);
}
