/* scenes.h - the pictures that bench/ draws: with shade.h here, with other renderers in peers/.

   A scene holds its geometry and everything a renderer needs to know.  All of it is made by code; a
   mesh can be read from an OBJ file instead (--mesh). */
#ifndef BENCH_SCENES_H
#define BENCH_SCENES_H

#include "shade.h"
#include "../examples/shared/teapot.h"
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

typedef enum scene_kind {
    SCENE_LIT,      /* shade_draw_mesh; positions, normals, indices in object space */
    SCENE_MAP,      /* a bilinear texture; positions in the world, u and v in the normals */
    SCENE_FLAT,     /* one colour; positions are clip-space x, y, z with w = 1 */
    SCENE_DEPTH,    /* the same, depth only */
    SCENE_CLEAR,    /* no triangle at all */
    SCENE_MIPMAPS,  /* the mipmaps of a texture of twice the picture's size, which is level 1 */
    SCENE_RESOLVE   /* a picture of twice the size is scaled down */
} scene_kind;

typedef struct scene {
    const char *name;
    scene_kind kind;
    int width, height;
    int srgb;                      /* the picture and what is sampled are sRGB */
    shade_format format;           /* RGBA8, or the picture is one that no peer draws */
    float *positions, *normals;
    uint32_t *indices, *texels;    /* SCENE_TEXELS squared, or twice the picture's size */
    int vertex_count, index_count;
    shade_material material;
    shade_light lights[4];
    shade_draw_state state;     /* points into this scene: scene_link after a copy */
    shade_vec3 eye;
    shade_vec4 background, color;
} scene;

enum { SCENE_COUNT = 21, SCENE_TEXELS = 512 };

static inline void scene_link(scene *s)
{
    s->state.material = &s->material;
    s->state.lighting.lights = s->state.lighting.light_count ? s->lights : NULL;
}

static inline void *scene_memory(size_t count, size_t size)
{
    void *memory = calloc(count ? count : 1, size);
    if (memory) return memory;
    fprintf(stderr, "out of memory\n");
    exit(1);
}

static inline void scene_geometry(scene *s, int vertices, int indices)
{
    s->positions = (float *)scene_memory((size_t)vertices, 3 * sizeof(float));
    s->normals = (float *)scene_memory((size_t)vertices, 3 * sizeof(float));
    s->indices = (uint32_t *)scene_memory((size_t)indices, sizeof(uint32_t));
    s->vertex_count = vertices;
    s->index_count = indices;
}

static inline void scene_free(scene *s)
{
    free(s->positions);
    free(s->normals);
    free(s->indices);
    free(s->texels);
    s->positions = s->normals = NULL;
    s->indices = s->texels = NULL;
}

static inline void scene_put(scene *s, int at, shade_vec3 p, shade_vec3 n)
{
    s->positions[3 * at] = p.x;
    s->positions[3 * at + 1] = p.y;
    s->positions[3 * at + 2] = p.z;
    s->normals[3 * at] = n.x;
    s->normals[3 * at + 1] = n.y;
    s->normals[3 * at + 2] = n.z;
}

static inline void scene_camera(scene *s, shade_vec3 eye, shade_vec3 center, float fovy)
{
    s->eye = eye;
    s->state.view = shade_mat4_look_at(eye, center, shade_v3(0, 1, 0));
    s->state.projection =
        shade_mat4_perspective(fovy, (float)s->width / (float)s->height, 0.5f, 60);
}

static inline scene scene_new(const char *name, scene_kind kind, int width, int height)
{
    scene s = { .name = name, .kind = kind, .width = width, .height = height,
                .background = shade_v4(0.05f, 0.06f, 0.08f, 1),
                .color = shade_v4(0.7f, 0.45f, 0.2f, 1) };
    return s;
}

/* Two triangles for each cell of a grid of vertices, rows x columns cells. */
static inline void scene_cells(scene *s, int rows, int columns)
{
    uint32_t *out = s->indices;
    for (int i = 0; i < rows; i++) {
        for (int j = 0; j < columns; j++) {
            uint32_t a = (uint32_t)(i * (columns + 1) + j), c = a + (uint32_t)columns + 1;
            *out++ = a;
            *out++ = c;
            *out++ = c + 1;
            *out++ = a;
            *out++ = c + 1;
            *out++ = a + 1;
        }
    }
}

/* Newell's teapot in 6,320 triangles over about half of 1280 x 720, one white lamp, the classic
   gold: 490 thousand pixels pass the depth test. */
static inline scene scene_teapot(const char *name, shade_shading shading, shade_cull cull)
{
    scene s = scene_new(name, SCENE_LIT, 1280, 720);
    scene_geometry(&s, teapot_vertex_count(10), teapot_index_count(10));
    teapot_build(10, s.positions, s.normals, NULL, s.indices);
    scene_camera(&s, shade_v3(0.2f, 1.6f, 5.7f), shade_v3(0.2f, 1.55f, 0), 0.75f);
    s.material = shade_preset_material(SHADE_PRESET_GOLD);
    s.lights[0] = shade_point_light(shade_v3(4, 6, 5), shade_v3(1, 1, 1));
    s.state.lighting.light_count = 1;
    s.state.lighting.ambient = shade_v3(0.3f, 0.3f, 0.3f);
    s.state.shading = shading;
    s.state.raster.cull = cull;
    return s;
}

/* A floor of two triangles that fills 1920 x 1080, under four coloured spotlights with attenuation.
   Of narrow cones each lights a pool; every pixel is inside all of the wide ones. */
static inline scene scene_floor(const char *name, float cutoff)
{
    scene s = scene_new(name, SCENE_LIT, 1920, 1080);
    static const float tint[4][3] = { { 1, 0.5f, 0.4f }, { 0.5f, 1, 0.5f },
                                      { 0.45f, 0.6f, 1 }, { 1, 0.9f, 0.5f } };
    scene_geometry(&s, 4, 6);
    for (int k = 0; k < 4; k++)
        scene_put(&s, k, shade_v3(k & 1 ? 12.0f : -12.0f, 0, k & 2 ? 12.0f : -12.0f),
                  shade_v3(0, 1, 0));
    scene_cells(&s, 1, 1);
    scene_camera(&s, shade_v3(0, 7, 7), shade_v3(0, 0, 0.6f), 0.8f);
    s.material = shade_preset_material(SHADE_PRESET_WHITE_PLASTIC);
    s.material.ambient = s.material.diffuse;
    for (int k = 0; k < 4; k++) {
        float x = k & 1 ? 2.5f : -2.5f, z = k & 2 ? 2.0f : -1.5f;
        shade_vec3 aim = shade_v3(-0.2f * x, -5, -0.2f * z);
        s.lights[k] = shade_spot_light(shade_v3(x, 5, z), aim, cutoff, 8,
                                       shade_v3(tint[k][0], tint[k][1], tint[k][2]));
        s.lights[k].constant = 0.3f;
        s.lights[k].linear = 0.05f;
        s.lights[k].quadratic = 0.01f;
        s.lights[k].ambient = shade_v3(0.01f, 0.01f, 0.01f);
    }
    s.state.lighting.light_count = 4;
    s.state.lighting.ambient = shade_v3(0.02f, 0.02f, 0.02f);
    return s;
}

/* A point of the trefoil knot at angle t, and a tube around it. */
static inline shade_vec3 scene_knot(double t)
{
    double r = 2 + cos(3 * t);
    return shade_v3((float)(r * cos(2 * t)), (float)(r * sin(2 * t)), (float)(1.2 * sin(3 * t)));
}

/* A knotted tube with bumps: 2 * along * around triangles. */
static inline void scene_tube(scene *s, int along, int around)
{
    const double turn = 6.283185307179586;
    scene_geometry(s, (along + 1) * (around + 1), 6 * along * around);
    for (int i = 0; i <= along; i++) {
        double t = turn * (i % along) / along;
        shade_vec3 c = scene_knot(t);
        shade_vec3 d = shade_normalize(shade_sub(scene_knot(t + 1e-3), scene_knot(t - 1e-3)));
        shade_vec3 u = shade_normalize(shade_cross(d, shade_v3(c.x, c.y, 0)));
        shade_vec3 v = shade_cross(u, d);
        for (int j = 0; j <= around; j++) {
            double a = turn * (j % around) / around;
            double r = 0.62 + 0.05 * sin(60 * t) * sin(5 * a);
            shade_vec3 n = shade_add(shade_scale(u, (float)cos(a)), shade_scale(v, (float)sin(a)));
            scene_put(s, i * (around + 1) + j, shade_madd(c, (float)r, n), n);
        }
    }
    scene_cells(s, along, around);
}

/* Vertex normals from faces; where a seam doubles vertices it shows, and costs nothing. */
static inline void scene_smooth(scene *s)
{
    shade_mesh m = { .positions = s->positions, .vertex_count = s->vertex_count,
                     .indices = s->indices, .index_count = s->index_count };
    shade_mesh_normals(&m, (shade_vec3 *)(void *)s->normals);
}

static inline void scene_dense_look(scene *s)
{
    s->material = shade_preset_material(SHADE_PRESET_TURQUOISE);
    s->lights[0] = shade_point_light(shade_v3(4, 6, 8), shade_v3(1, 1, 1));
    s->state.lighting.light_count = 1;
    s->state.lighting.ambient = shade_v3(0.3f, 0.3f, 0.3f);
    s->state.shading = SHADE_SHADING_PER_VERTEX;
}

static inline scene scene_dense(const char *name, int along, int around)
{
    scene s = scene_new(name, SCENE_LIT, 1280, 720);
    scene_tube(&s, along, around);
    scene_smooth(&s);
    scene_camera(&s, shade_v3(0, 0, 9.6f), shade_v3(0, 0, 0), 0.8f);
    scene_dense_look(&s);
    return s;
}

/* The same picture of the first mesh of an OBJ file: its v and f lines alone, polygons as fans. */
static inline int scene_read_obj(scene *s, const char *path)
{
    FILE *f = fopen(path, "rb");
    char line[4096];
    int vertices = 0, indices = 0;
    if (!f) return 0;
    for (int pass = 0; pass < 2; pass++) {
        rewind(f);
        if (pass) scene_geometry(s, vertices, indices);
        vertices = indices = 0;
        while (fgets(line, sizeof line, f)) {
            if (line[0] == 'v' && line[1] == ' ') {
                float *p = pass ? s->positions + 3 * vertices : NULL;
                if (p && sscanf(line + 2, "%f %f %f", p, p + 1, p + 2) != 3) break;
                vertices++;
            } else if (line[0] == 'f' && line[1] == ' ') {
                uint32_t polygon[64];
                int n = 0;
                char *at = strtok(line + 2, " \t\r\n");
                for (; at && n < 64; at = strtok(NULL, " \t\r\n")) {
                    long i = strtol(at, NULL, 10);
                    polygon[n++] = (uint32_t)(i < 0 ? i + vertices : i - 1);
                }
                for (int k = 2; k < n; k++, indices += 3) {
                    if (!pass) continue;
                    s->indices[indices] = polygon[0];
                    s->indices[indices + 1] = polygon[k - 1];
                    s->indices[indices + 2] = polygon[k];
                }
            }
        }
    }
    fclose(f);
    return vertices && indices;
}

static inline scene scene_obj(const char *name, const char *path)
{
    scene s = scene_new(name, SCENE_LIT, 1280, 720);
    shade_vec3 low = shade_v3(1e30f, 1e30f, 1e30f), high = shade_neg(low), size, center;
    float scale;
    if (!scene_read_obj(&s, path)) {
        fprintf(stderr, "%s: no mesh in it\n", path);
        exit(1);
    }
    scene_smooth(&s);
    for (int i = 0; i < s.vertex_count; i++) {
        const float *p = s.positions + 3 * i;
        low = shade_min(low, shade_v3(p[0], p[1], p[2]));
        high = shade_max(high, shade_v3(p[0], p[1], p[2]));
    }
    size = shade_sub(high, low);
    center = shade_scale(shade_add(low, high), 0.5f);
    scale = 6.5f / (size.x > size.y ? size.x : size.y);
    s.state.model = shade_mat4_mul(shade_mat4_scaling(shade_v3(scale, scale, scale)),
                                   shade_mat4_translation(shade_neg(center)));
    scene_camera(&s, shade_v3(0, 0, 9.5f), shade_v3(0, 0, 0), 0.8f);
    scene_dense_look(&s);
    return s;
}

/* 1000 triangles between random points of the picture, random depths: each covers 1/13 of it on the
   average, 78 lie over each pixel. */
static inline scene scene_overdraw(const char *name)
{
    scene s = scene_new(name, SCENE_DEPTH, 1920, 1080);
    uint32_t seed = 12345;
    scene_geometry(&s, 3000, 3000);
    for (int i = 0; i < 3000; i++) {
        float p[3];
        for (int k = 0; k < 3; k++) {
            seed = seed * 1664525u + 1013904223u;
            p[k] = (float)(seed >> 8) / 8388608.0f - 1;
        }
        scene_put(&s, i, shade_v3(p[0], p[1], p[2]), shade_v3(0, 0, 1));
        s.indices[i] = (uint32_t)i;
    }
    return s;
}

static inline scene scene_fill(const char *name, int width, int height)
{
    scene s = scene_new(name, SCENE_FLAT, width, height);
    scene_geometry(&s, 4, 6);
    for (int k = 0; k < 4; k++)
        scene_put(&s, k, shade_v3(k & 1 ? 1.0f : -1.0f, k & 2 ? -1.0f : 1.0f, k & 1 ? 0.5f : -0.5f),
                  shade_v3(0, 0, 1));
    scene_cells(&s, 1, 1);
    return s;
}

/* A picture without steps between texels, which 8-bit weights of a filter would show. */
static inline void scene_texels(scene *s, int width, int height)
{
    s->texels = (uint32_t *)scene_memory((size_t)width * (size_t)height, 4);
    for (int i = 0; i < width * height; i++) {
        int x = i % width, y = i / width, c[3] = { 8 * x + 4 * y, 4 * x, 8 * y };
        unsigned char *rgba = (unsigned char *)&s->texels[i];
        for (int k = 0; k < 3; k++)
            rgba[k] = (unsigned char)(c[k] & 256 ? 255 - (c[k] & 255) : c[k] & 255);
        rgba[3] = 255;
    }
}

/* A floor to the horizon's edge under one texture. */
static inline scene scene_map(const char *name)
{
    scene s = scene_new(name, SCENE_MAP, 1920, 1080);
    scene_geometry(&s, 4, 6);
    for (int k = 0; k < 4; k++) {
        float x = k & 1 ? 20.0f : -20.0f, z = k & 2 ? 20.0f : -20.0f;
        scene_put(&s, k, shade_v3(x, 0, z), shade_v3(x / 4, z / 4, 0));
    }
    scene_cells(&s, 1, 1);
    scene_texels(&s, SCENE_TEXELS, SCENE_TEXELS);
    scene_camera(&s, shade_v3(0, 3, 0.1f), shade_v3(0, 0, -1.5f), 1);
    return s;
}

/* A gold teapot, as a first program draws it. */
static inline scene scene_readme(const char *name)
{
    scene s = scene_new(name, SCENE_LIT, 640, 480);
    s.srgb = 1;
    s.background = shade_v4(0.02f, 0.02f, 0.05f, 1);
    scene_geometry(&s, teapot_vertex_count(8), teapot_index_count(8));
    teapot_build(8, s.positions, s.normals, NULL, s.indices);
    scene_camera(&s, shade_v3(0, 4, 8), shade_v3(0, 1.4f, 0), 0.7f);
    s.material = shade_linear_material(shade_preset_material(SHADE_PRESET_GOLD));
    s.lights[0] = shade_point_light(shade_v3(4, 6, 5), shade_v3(1, 1, 1));
    s.state.lighting.light_count = 1;
    return s;
}

/* The same scene, stored as sRGB. */
static inline scene scene_srgb(scene s)
{
    s.srgb = 1;
    return s;
}

static inline scene scene_packed(scene s, const char *name, shade_format format)
{
    s.name = name;
    s.format = format;
    return s;
}

static inline scene scene_small(const char *name, int size)
{
    scene s = scene_teapot(name, SHADE_SHADING_PER_FRAGMENT, SHADE_CULL_NONE);
    s.width = s.height = size;
    scene_camera(&s, shade_v3(0.2f, 1.6f, 8.5f), shade_v3(0.2f, 1.55f, 0), 0.75f);
    return s;
}

/* A picture made of one of twice its size. */
static inline scene scene_halved(const char *name, scene_kind kind, int width, int height, int srgb)
{
    scene s = scene_new(name, kind, width, height);
    scene_texels(&s, 2 * width, 2 * height);
    s.srgb = srgb;
    return s;
}

/* obj: NULL for the knot */
static inline void scenes_build(scene out[SCENE_COUNT], const char *obj)
{
    out[0] = scene_teapot("teapot 720p, per pixel", SHADE_SHADING_PER_FRAGMENT, SHADE_CULL_NONE);
    out[1] =
        scene_teapot("the same, back faces culled", SHADE_SHADING_PER_FRAGMENT, SHADE_CULL_BACK);
    out[2] = scene_floor("floor 1080p, 4 spotlights, pools", 0.5f);
    out[3] = scene_floor("the same, every pixel in every cone", 1.5f);
    out[4] = scene_teapot("teapot 720p, Gouraud", SHADE_SHADING_PER_VERTEX, SHADE_CULL_NONE);
    out[5] = obj ? scene_obj("mesh 720p, Gouraud", obj)
                 : scene_dense("knot of 124k triangles 720p, Gouraud", 1240, 50);
    out[6] = scene_dense("knot of 70k triangles 720p, Gouraud", 875, 40);
    out[7] = scene_overdraw("1000 big triangles 1080p, depth only");
    out[8] = scene_fill("flat fill with depth 1080p", 1920, 1080);
    out[9] = scene_fill("flat fill with depth 320 x 180, in cache", 320, 180);
    out[10] = scene_new("clear colour and depth 1080p", SCENE_CLEAR, 1920, 1080);
    out[11] = scene_map("bilinear texture 1080p");
    out[12] = scene_readme("gold teapot, sRGB 640 x 480");
    out[13] = scene_srgb(scene_teapot("sRGB teapot 720p, per pixel", SHADE_SHADING_PER_FRAGMENT,
                                      SHADE_CULL_NONE));
    out[14] = scene_srgb(scene_map("sRGB bilinear texture, sRGB picture 1080p"));
    out[15] = scene_small("teapot 256 x 256, per pixel", 256);
    out[16] = scene_small("teapot 64 x 64, per pixel", 64);
    out[17] = scene_halved("mipmaps of 1024 x 1024", SCENE_MIPMAPS, 512, 512, 0);
    out[18] = scene_halved("mipmaps of 1024 x 1024, sRGB", SCENE_MIPMAPS, 512, 512, 1);
    out[19] = scene_halved("resolve 2560 x 1440 by 2, sRGB", SCENE_RESOLVE, 1280, 720, 1);
    out[20] = scene_packed(scene_readme(NULL), "the gold teapot in RGB565, sRGB",
                           SHADE_FORMAT_RGB565);
    for (int i = 0; i < SCENE_COUNT; i++) scene_link(&out[i]);
}

/* ---- with shade.h ---- */

static inline shade_target scene_target(const scene *s)
{
    size_t pixels = (size_t)s->width * (size_t)s->height;
    shade_target t = { .width = s->width, .height = s->height, .srgb = s->srgb,
                       .format = s->format };
    if (s->kind == SCENE_MIPMAPS) pixels *= 2;    /* the smaller levels follow */
    if (s->kind != SCENE_DEPTH) t.color = scene_memory(pixels, 4);
    if (s->kind < SCENE_MIPMAPS) t.depth = (float *)scene_memory(pixels, sizeof(float));
    return t;
}

static inline shade_mesh scene_mesh(const scene *s)
{
    shade_mesh m = { .positions = s->positions, .normals = s->normals,
                     .vertex_count = s->vertex_count, .indices = s->indices,
                     .index_count = s->index_count };
    return m;
}

static inline void scene_vertex(const void *uniforms, const shade_vertex_ids *SHADE_RESTRICT in,
                                shade_vertices *SHADE_RESTRICT out)
{
    const scene *s = (const scene *)uniforms;
    for (int i = 0; i < SHADE_LANES; i++) {
        const float *p = s->positions + 3 * (size_t)in->index[i];
        out->clip[0][i] = p[0];
        out->clip[1][i] = p[1];
        out->clip[2][i] = p[2];
        out->clip[3][i] = 1;
    }
}

static inline void scene_fragment(const void *uniforms, const shade_fragments *SHADE_RESTRICT in,
                                  shade_colors *SHADE_RESTRICT out)
{
    shade_vec4 c = ((const scene *)uniforms)->color;
    (void)in;
    SHADE_EACH_LANE(i) {
        out->color[0][i] = c.x;
        out->color[1][i] = c.y;
        out->color[2][i] = c.z;
    }
}

static inline void scene_map_vertex(const void *uniforms, const shade_vertex_ids *SHADE_RESTRICT in,
                                    shade_vertices *SHADE_RESTRICT out)
{
    const scene *s = (const scene *)uniforms;
    const shade_mat4 m = shade_mat4_mul(s->state.projection, s->state.view);
    for (int i = 0; i < SHADE_LANES; i++) {
        const float *p = s->positions + 3 * (size_t)in->index[i];
        const float *uv = s->normals + 3 * (size_t)in->index[i];
        shade_vec4 c = shade_mat4_transform(m, shade_v4(p[0], p[1], p[2], 1));
        out->clip[0][i] = c.x;
        out->clip[1][i] = c.y;
        out->clip[2][i] = c.z;
        out->clip[3][i] = c.w;
        out->varying[0][i] = uv[0];
        out->varying[1][i] = uv[1];
    }
}

static inline void scene_map_fragment(const void *uniforms,
                                      const shade_fragments *SHADE_RESTRICT in,
                                      shade_colors *SHADE_RESTRICT out)
{
    const scene *s = (const scene *)uniforms;
    shade_texture t = { .pixels = s->texels, .width = SCENE_TEXELS, .height = SCENE_TEXELS,
                        .srgb = s->srgb };
    shade_sample_lanes(&t, in->varying[0], in->varying[1], NULL, (float *)out->color);
}

static inline shade_result scene_halve(const scene *s, const shade_target *t)
{
    if (s->kind == SCENE_MIPMAPS) {
        shade_texture map, levels[16];
        memset(&map, 0, sizeof map);
        map.pixels = s->texels;
        map.width = 2 * s->width;
        map.height = 2 * s->height;
        map.srgb = s->srgb;
        return shade_build_mipmaps(&map, levels, t->color,
                                   2 * (size_t)s->width * (size_t)s->height * 4);
    }
    shade_target from = *t;
    from.width = 2 * s->width;
    from.height = 2 * s->height;
    from.color = s->texels;
    return shade_resolve(t, &from, 2);
}

/* One whole frame, from the clear on. */
static inline shade_stats scene_draw(const scene *s, const shade_target *t)
{
    shade_result result;
    shade_stats stats = { 0 };
    if (s->kind >= SCENE_MIPMAPS) result = scene_halve(s, t);
    else result = shade_clear(t, s->background, 1);
    if (result == SHADE_OK && s->kind == SCENE_LIT) {
        shade_mesh m = scene_mesh(s);
        result = shade_draw_mesh(t, &m, &s->state, &stats);
    } else if (result == SHADE_OK && s->kind < SCENE_CLEAR) {
        shade_pipeline p = { .vertex = scene_vertex, .uniforms = s,
                             .fragment = s->kind == SCENE_FLAT ? scene_fragment : NULL };
        if (s->kind == SCENE_MAP) {
            p.vertex = scene_map_vertex;
            p.fragment = scene_map_fragment;
            p.varyings = 2;
        }
        result = shade_draw(t, &p, s->indices, s->index_count, s->vertex_count, &stats);
    }
    if (result != SHADE_OK) {
        fprintf(stderr, "%s: %s\n", s->name, shade_result_string(result));
        exit(1);
    }
    return stats;
}

#endif
