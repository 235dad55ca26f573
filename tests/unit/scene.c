/* scene.c - built-in scenes whose pixels are the same bits everywhere: models, shadings, blending,
   clipping, interpolations, formats, maps, alpha, lines, infinite and NaN light.  Their input is
   made of small whole numbers and of functions inside the library, so that no flag of the compiler
   that builds this file can change them.

   Alone it prints their hashes:   cc -DSCENE_MAIN -I. tests/unit/scene.c -lm -o scenes && ./scenes
   [folder] */
#ifdef SCENE_MAIN
#define SHADE_IMPLEMENTATION
#endif
#include "shade.h"
#include "test.h"
#include "canvas.h"
#include "scene.h"

const golden_scene golden_scenes[SCENE_COUNT] = {
    { .name = "blinn_phong", .lights = 3 },
    { .name = "phong", .model = SHADE_MODEL_PHONG, .lights = 3 },
    { .name = "lambert", .model = SHADE_MODEL_LAMBERT, .lights = 3 },
    { .name = "ambient",
      .model = SHADE_MODEL_AMBIENT,
      .lights = 3,
      .flags = SHADE_FLAG_ATTENUATED_AMBIENT },
    { .name = "emissive", .model = SHADE_MODEL_EMISSIVE, .lights = 3 },
    { .name = "cool_to_warm", .model = SHADE_MODEL_COOL_TO_WARM, .lights = 1 },
    { .name = "gouraud", .shading = SHADE_SHADING_PER_VERTEX, .lights = 3 },
    { .name = "flat", .model = SHADE_MODEL_PHONG, .shading = SHADE_SHADING_PER_FACE, .lights = 3 },
    { .name = "srgb", .srgb = 1, .lights = 2 },
    { .name = "dither565", .format = SHADE_FORMAT_RGB565, .srgb = 1, .dither = 1, .lights = 2 },
    { .name = "float",
      .model = SHADE_MODEL_PHONG,
      .format = SHADE_FORMAT_RGBA32F,
      .lights = 3,
      .flags = SHADE_FLAG_WEIGHTED_SPECULAR },
    { .name = "add",
      .blend = SHADE_BLEND_ADD,
      .srgb = 1,
      .lights = 1,
      .flags = SHADE_FLAG_INFINITE_VIEWER },
    { .name = "over565",
      .model = SHADE_MODEL_LAMBERT,
      .shading = SHADE_SHADING_PER_VERTEX,
      .format = SHADE_FORMAT_RGB565,
      .blend = SHADE_BLEND_OVER,
      .lights = 2,
      .flags = SHADE_FLAG_TWO_SIDED },
    { .name = "inside", .srgb = 1, .lights = 3, .flags = SHADE_FLAG_TWO_SIDED, .inside = 1 },
    { .name = "inside_flat",
      .model = SHADE_MODEL_PHONG,
      .shading = SHADE_SHADING_PER_FACE,
      .format = SHADE_FORMAT_RGBA32F,
      .lights = 3,
      .flags = SHADE_FLAG_TWO_SIDED_ABS,
      .inside = 1 },
    { .name = "reversed",
      .model = SHADE_MODEL_PHONG,
      .lights = 2,
      .flags = SHADE_FLAG_UNGATED_SPECULAR,
      .reversed = 1 },
    { .name = "nearest", .shading = SHADE_SHADING_PER_VERTEX, .lights = 3, .map = 1 },
    { .name = "bilinear", .srgb = 1, .lights = 3, .inside = 1, .map = 2 },
    { .name = "trilinear",
      .model = SHADE_MODEL_LAMBERT,
      .format = SHADE_FORMAT_RGBA32F,
      .lights = 2,
      .reversed = 1,
      .map = 3 },
    { .name = "lines",
      .model = SHADE_MODEL_COOL_TO_WARM,
      .srgb = 1,
      .lights = 1,
      .inside = 1,
      .lines = 1 },
    { .name = "glass",
      .format = SHADE_FORMAT_BGRA8,
      .blend = SHADE_BLEND_OVER,
      .srgb = 1,
      .lights = 3,
      .transparency = 0.375f },
    { .name = "leaves",
      .model = SHADE_MODEL_LAMBERT,
      .shading = SHADE_SHADING_PER_VERTEX,
      .format = SHADE_FORMAT_RGB565_SWAPPED,
      .srgb = 1,
      .dither = 1,
      .lights = 2,
      .map = 4,
      .alpha_cutoff = 0.5f },
    { .name = "smoke",
      .format = SHADE_FORMAT_RGBA32F,
      .blend = SHADE_BLEND_OVER,
      .lights = 3,
      .flags = SHADE_FLAG_TWO_SIDED,
      .inside = 1,
      .map = 4,
      .transparency = 0.25f },
    { .name = "glow",
      .model = SHADE_MODEL_PHONG,
      .shading = SHADE_SHADING_PER_FACE,
      .format = SHADE_FORMAT_BGRA8,
      .blend = SHADE_BLEND_ADD,
      .lights = 1,
      .map = 5,
      .transparency = 0.5f },
    { .name = "affine", .model = SHADE_MODEL_EMISSIVE, .format = SHADE_FORMAT_BGRA8, .affine = 1 },
    { .name = "wild", .lights = 3, .map = 3, .wild = 1 },
    { .name = "wild_float",
      .shading = SHADE_SHADING_PER_VERTEX,
      .format = SHADE_FORMAT_RGBA32F,
      .lights = 3,
      .flags = SHADE_FLAG_ATTENUATED_AMBIENT | SHADE_FLAG_UNGATED_SPECULAR,
      .wild = 1 },
};

/* Six square faces of a box, each a lattice of whole numbers; the normal of a vertex is its
   position, so the box is shaded as a ball.  Bumps: the vertex is pushed out by a whole number. */
static float scene_position[6 * SCENE_SIDE * SCENE_SIDE * 3],
    scene_color[6 * SCENE_SIDE * SCENE_SIDE * 3];
static uint32_t scene_index[6 * (SCENE_SIDE - 1) * (SCENE_SIDE - 1) * 6];

void scene_build(void)
{
    int vertices = 0, count = 0, half = SCENE_SIDE / 2;
    for (int face = 0; face < 6; face++) {
        int axis = face / 2, sign = face % 2 ? 1 : -1;
        for (int j = 0; j < SCENE_SIDE; j++) {
            for (int i = 0; i < SCENE_SIDE; i++) {
                int p[3], edge = i == 0 || j == 0 || i == SCENE_SIDE - 1 || j == SCENE_SIDE - 1;
                int bump = edge ? 0 : (i * 5 + j * 3 + face) % 3;
                p[axis] = sign * (half + bump);
                p[(axis + 1) % 3] = i - half;
                p[(axis + 2) % 3] = j - half;
                for (int k = 0; k < 3; k++) {
                    scene_position[3 * vertices + k] = (float)p[k];
                    scene_color[3 * vertices + k] = (float)((i + j * 2 + face + k) % 4 + 1) * 0.25f;
                }
                vertices++;
            }
        }
        for (int j = 0; j + 1 < SCENE_SIDE; j++) {
            for (int i = 0; i + 1 < SCENE_SIDE; i++) {
                uint32_t a = (uint32_t)(face * SCENE_SIDE * SCENE_SIDE + j * SCENE_SIDE + i),
                         b = a + 1;
                uint32_t c = a + SCENE_SIDE, d = c + 1, t = b;
                if (sign < 0) {
                    b = c;
                    c = t;
                }
                scene_index[count++] = a;
                scene_index[count++] = b;
                scene_index[count++] = d;
                scene_index[count++] = a;
                scene_index[count++] = d;
                scene_index[count++] = c;
            }
        }
    }
}

/* 16 x 8 texels: 1 from 5-6-5 bits, nearest, mirrored; 2 from sRGB bytes, bilinear, repeated; 3
   from floats, trilinear, clamped; 4 as 2, but B, G, R, and alpha; 5 as 1, with bytes exchanged. */
static float scene_texels[16 * 8 * 4], scene_levels[16 * 8 * 4];
static shade_texture scene_map(int kind, shade_texture *levels)
{
    static const shade_format formats[6] = { SHADE_FORMAT_RGBA32F, SHADE_FORMAT_RGB565,
                                             SHADE_FORMAT_RGBA8,   SHADE_FORMAT_RGBA32F,
                                             SHADE_FORMAT_BGRA8,   SHADE_FORMAT_RGB565_SWAPPED };
    const int wide = kind == 2 || kind == 4, narrow = kind == 1 || kind == 5;
    shade_texture t = { 0 };
    for (uint32_t i = 0; i < 16 * 8; i++) {
        uint32_t x = i % 16, y = i / 16, n = (x * 7 + y * 13 + x * y) % 16;
        uint32_t rgb = n << 12 | (15 - n) << 6 | (x ^ y);
        uint16_t stored = (uint16_t)(kind == 5 ? (rgb & 255) << 8 | rgb >> 8 : rgb);
        unsigned char *bytes = (unsigned char *)scene_texels + 4 * i;
        if (narrow) memcpy((char *)scene_texels + 2 * i, &stored, 2);
        if (wide) {
            bytes[0] = (unsigned char)(n * 17);
            bytes[1] = (unsigned char)(x * 16);
            bytes[2] = (unsigned char)(y * 32);
            bytes[3] = (unsigned char)(kind == 4 ? 255 - n * 15 : 255);
        }
        for (uint32_t k = 0; kind == 3 && k < 4; k++)
            scene_texels[4 * i + k] = (float)((n + k * x) % 16) * 0.125f;
    }
    t.pixels = scene_texels;
    t.width = 16;
    t.height = 8;
    t.srgb = wide;
    t.format = formats[kind];
    t.wrap_u = t.wrap_v = narrow ? SHADE_WRAP_MIRROR : wide ? SHADE_WRAP_REPEAT : SHADE_WRAP_CLAMP;
    t.filter = narrow ? SHADE_FILTER_NEAREST
               : wide ? SHADE_FILTER_BILINEAR
                      : SHADE_FILTER_TRILINEAR;
    if (kind == 3) shade_build_mipmaps(&t, levels, scene_levels, sizeof scene_levels);
    return t;
}

static void scene_lines(canvas *c, const shade_draw_state *s)
{
    shade_line_state line = { 0 };
    line.clip_from_points = s->projection; /* products in this file would follow its flags */
    line.width = 1.5f;
    line.cap = SHADE_CAP_SQUARE;
    line.color = shade_v4(0.0625f, 0, 0.125f, 1);
    line.raster.depth_test = SHADE_COMPARE_LESS_EQUAL;
    line.raster.depth_bias = -0.015625f;
    for (int k = 0; k < (int)(sizeof scene_index / sizeof scene_index[0]); k += 3) {
        shade_vec3 ends[2];
        for (int j = 0; j < 2; j++) {
            const float *p = scene_position + 3 * scene_index[k + j];
            ends[j] = shade_v3(p[0], p[1], p[2] - 9);
        }
        shade_draw_lines(&c->target, ends, 2, &line, NULL);
    }
}

/* A wheel of 16 triangles, linear on the screen: rim corners before near, beyond far, outside the
   guard band, one of them behind the eye. */
static void scene_wheel(canvas *c)
{
    shade_vec4 clip[48];
    float color[48][3];
    scene s = { clip, color[0], 3, NULL, NULL };
    shade_pipeline p = scene_pipeline(&s);
    for (int i = 0; i < 48; i++) {
        const int k = (i / 3 + i % 3 + 15) % 16, side = k / 4, along = k % 4 - 2; /* on a square */
        const int x = side == 0 ? along : side == 1 ? 2 : side == 2 ? -along : -2;
        const int y = side == 0 ? -2 : side == 1 ? along : side == 2 ? 2 : -along;
        const int w = k == 5 ? -1 : 1 << k % 3, far_out = k % 5 == 2 ? 8 : 1, z = k % 3 - 1;
        clip[i] = shade_v4((float)(x * far_out * w), (float)(y * far_out * w), (float)(3 * z * w),
                           (float)w);
        color[i][0] = (float)(k & 1);
        color[i][1] = (float)(k >> 1 & 1);
        color[i][2] = (float)(k >> 2 & 1);
        if (i % 3 == 0) {
            clip[i] = shade_v4(0, 0, 0, 1);
            color[i][0] = color[i][1] = color[i][2] = 1;
        }
    }
    p.fragment = scene_colors;
    p.interpolation = SHADE_INTERPOLATION_AFFINE;
    shade_draw(&c->target, &p, NULL, 48, 48, NULL);
}

/* Products that overflow, infinity less infinity, NaN of either sign: what they become must not
   depend on the sign that a processor gives to a NaN, nor on which lanes share a packet. */
static float scene_wild_uv[6 * SCENE_SIDE * SCENE_SIDE * 2];
static void scene_spoil(shade_light *lights, shade_material *gold, shade_mesh *mesh)
{
    static const uint32_t pattern[5] = { 0x7F800000u, 0x7FC00000u, 0xFFC00001u, 0x7F7FFFFFu,
                                         0xFF800000u };
    const int vertices = 6 * SCENE_SIDE * SCENE_SIDE;
    for (int i = 0; i < 2 * vertices; i++) {
        scene_wild_uv[i] = scene_position[i / 2 * 3 + i % 2] * 0.125f;
        if (i % 41 == 0) scene_wild_uv[i] = bits_float(pattern[i / 41 % 5]);
    }
    mesh->texcoords = scene_wild_uv;
    mesh->texcoord_stride = 0;
    lights[0].diffuse = shade_v3(1e20f, 0.5f, bits_float(pattern[0]));
    lights[0].specular = shade_v3(1, bits_float(pattern[2]), 1);
    lights[1].linear = -bits_float(pattern[3]);
    lights[1].quadratic = bits_float(pattern[3]);
    lights[1].diffuse = lights[1].specular = shade_v3(1e-22f, 1e-20f, 1e-21f);
    lights[2].diffuse = shade_v3(0.5f, bits_float(pattern[4]), 1e30f);
    gold->diffuse = shade_v3(1e20f, 0.75f, 0.25f);
    gold->emission = shade_v3(-0.0f, 0.25f, 0);
}

void scene_draw(canvas *c, const golden_scene *g)
{
    shade_texture levels[5], map = scene_map(g->map, levels);
    shade_light lights[3];
    shade_material gold = shade_preset_material(SHADE_PRESET_GOLD),
                   plastic = shade_preset_material(SHADE_PRESET_CYAN_PLASTIC);
    shade_mesh mesh = { 0 };
    shade_draw_state s = { 0 };
    mesh.positions = mesh.normals = scene_position;
    mesh.colors = scene_color;
    mesh.vertex_count = 6 * SCENE_SIDE * SCENE_SIDE;
    mesh.indices = scene_index;
    mesh.index_count = (int)(sizeof scene_index / sizeof scene_index[0]);
    lights[0] = shade_directional_light(shade_v3(-1, -2, -2), shade_v3(1, 0.875f, 0.75f));
    lights[1] = shade_point_light(shade_v3(8, 3, 6), shade_v3(4, 8, 16));
    lights[1].constant = 1;
    lights[1].quadratic = 0.125f;
    lights[1].ambient = shade_v3(0.25f, 0, 0.125f);
    lights[2] =
        shade_spot_light(shade_v3(-7, 9, 8), shade_v3(7, -9, -7), 0.25f, 16, shade_v3(2, 1, 1));
    lights[2].ambient = shade_v3(0, 0.125f, 0);
    gold.emission = shade_v3(0.0625f, 0, 0.03125f);
    plastic.emission = shade_v3(0, 0, 0.125f);
    s.lighting.lights = lights;
    s.lighting.light_count = g->lights;
    s.lighting.ambient = shade_v3(0.125f, 0.125f, 0.25f);
    s.lighting.model = g->model;
    s.lighting.flags = g->flags;
    s.shading = g->shading;
    s.raster.blend = g->blend;
    s.transparency = g->transparency;
    s.alpha_cutoff = g->alpha_cutoff;
    s.view = g->inside
                 ? shade_mat4_look_at(shade_v3(5, 1, 3), shade_v3(-4, 0, -2), shade_v3(0, 1, 0))
                 : shade_mat4_look_at(shade_v3(9, 7, 14), shade_v3(0, 0, 0), shade_v3(0, 1, 0));
    s.projection = g->reversed ? shade_mat4_perspective_reversed(0.75f, 4.0f / 3, 1)
                               : shade_mat4_perspective(g->inside ? 1.5f : 0.75f, 4.0f / 3, 1, 40);
    s.raster.depth_zero_to_one = g->reversed;
    s.raster.depth_test = g->reversed ? SHADE_COMPARE_GREATER : SHADE_COMPARE_LESS;
    if (g->map) { /* positions serve as texture coordinates */
        mesh.texcoords = scene_position;
        mesh.texcoord_stride = 12;
        s.diffuse_map = &map;
    }
    if (g->wild) scene_spoil(lights, &gold, &mesh);
    s.model = shade_mat4_rotation(0.5f, shade_v3(1, 2, 3));
    s.material = &gold;
    shade_draw_mesh(&c->target, &mesh, &s, NULL);
    if (g->lines) scene_lines(c, &s);
    if (g->affine) scene_wheel(c);
    s.model = shade_mat4_translation(shade_v3(5, -2, -3));
    s.material = &plastic;
    s.raster.cull = SHADE_CULL_BACK;
    s.lighting.terms = 0;
    shade_draw_mesh(&c->target, &mesh, &s, NULL);
}

/* FNV-1a over every number of colour and depth, low byte first whatever the machine.  A NaN counts
   as one: its sign and its other bits differ between processors. */
static uint64_t hash_number(uint64_t h, uint32_t v, int bytes)
{
    for (int k = 0; k < bytes; k++, v >>= 8) h = (h ^ (v & 255)) * 1099511628211u;
    return h;
}

static uint32_t scene_bits(float v)
{
    return (float_bits(v) & 0x7FFFFFFFu) > 0x7F800000u ? 0x7FC00000u : float_bits(v);
}

static uint64_t scene_hash(const canvas *c)
{
    uint64_t h = 14695981039346656037u;
    for (int i = 0; i < SCENE_WIDTH * SCENE_HEIGHT; i++) {
        int x = i % SCENE_WIDTH, y = i / SCENE_WIDTH;
        size_t bytes = canvas_pixel_bytes(c->target.format);
        for (int k = 0; k < 4; k++) {
            if (bytes == 4) h = hash_number(h, canvas_bytes(c, x, y)[k], 1);
            if (bytes == 16) h = hash_number(h, scene_bits(canvas_float(c, x, y, k)), 4);
        }
        if (bytes == 2) h = hash_number(h, canvas_565(c, x, y), 2);
        h = hash_number(h, float_bits(canvas_depth(c, x, y)), 4);
    }
    return h;
}

canvas scene_open(const golden_scene *g)
{
    canvas c = canvas_open(SCENE_WIDTH, SCENE_HEIGHT, 0, g->format, 1);
    c.target.srgb = g->srgb;
    c.target.dither = g->dither;
    shade_clear(&c.target, shade_v4(0.125f, 0.125f, 0.1875f, 1), g->reversed ? 0 : 1);
    return c;
}

static int scene_write(void *file, const void *bytes, size_t size)
{
    return fwrite(bytes, 1, size, (FILE *)file) != size;
}

int scene_print(const char *folder)
{
    scene_build();
    for (int k = 0; k < SCENE_COUNT; k++) {
        canvas c = scene_open(&golden_scenes[k]);
        scene_draw(&c, &golden_scenes[k]);
        printf("{ \"%s\", 0x%016llx },\n", golden_scenes[k].name,
               (unsigned long long)scene_hash(&c));
        char path[300];
        if (folder) {
            snprintf(path, sizeof path, "%.200s/%s.ppm", folder, golden_scenes[k].name);
            FILE *f = fopen(path, "wb");
            if (!f || shade_encode_ppm(scene_write, f, &c.target))
                printf("%s: cannot be written\n", path);
            if (f) fclose(f);
        }
        canvas_close(&c);
    }
    return 0;
}

/* G12, G15 */
TEST(scene, hashes_are_the_recorded_ones)
{
    static const struct {
        const char *name;
        uint64_t hash;
    } recorded[] = {
#include "scenes.h"
    };
    int found = 0;
    scene_build();
    for (int k = 0; k < SCENE_COUNT; k++) {
        canvas c = scene_open(&golden_scenes[k]);
        scene_draw(&c, &golden_scenes[k]);
        uint64_t got = scene_hash(&c);
        for (size_t j = 0; j < sizeof recorded / sizeof recorded[0]; j++) {
            if (strcmp(recorded[j].name, golden_scenes[k].name) || !recorded[j].hash) continue;
            found++;
            CHECK_SAY(got == recorded[j].hash, "%s: got %016llx, want %016llx", recorded[j].name,
                      (unsigned long long)got, (unsigned long long)recorded[j].hash);
        }
        canvas_close(&c);
    }
    if (!found)
        test_skip("no hashes are recorded in scenes.h");
    else
        CHECK_INT(found, SCENE_COUNT);
}

TEST(scene, scenes_are_not_empty_and_differ)
{
    uint64_t seen[SCENE_COUNT];
    scene_build();
    for (int k = 0; k < SCENE_COUNT; k++) {
        canvas c = scene_open(&golden_scenes[k]), clear = scene_open(&golden_scenes[k]);
        scene_draw(&c, &golden_scenes[k]);
        int touched = 0;
        for (int i = 0; i < SCENE_WIDTH * SCENE_HEIGHT; i++) {
            int x = i % SCENE_WIDTH, y = i / SCENE_WIDTH;
            touched += float_bits(canvas_depth(&c, x, y)) != float_bits(canvas_depth(&clear, x, y));
        }
        CHECK_SAY(touched > 3000, "%s: %d pixels", golden_scenes[k].name, touched);
        seen[k] = scene_hash(&c);
        for (int j = 0; j < k; j++)
            CHECK_SAY(seen[j] != seen[k], "%s and %s", golden_scenes[j].name,
                      golden_scenes[k].name);
        canvas_close(&c);
        canvas_close(&clear);
    }
}

/* G13 */
TEST(scene, bands_give_the_hash_of_the_whole)
{
    scene_build();
    for (int k = 0; k < SCENE_COUNT; k++) {
        canvas whole = scene_open(&golden_scenes[k]), bands = scene_open(&golden_scenes[k]);
        scene_draw(&whole, &golden_scenes[k]);
        for (int y = 0; y < SCENE_HEIGHT; y += 17) {
            bands.target.clip_y = y;
            bands.target.clip_width = SCENE_WIDTH;
            bands.target.clip_height = 17;
            scene_draw(&bands, &golden_scenes[k]);
        }
        CHECK_SAY(scene_hash(&whole) == scene_hash(&bands), "%s", golden_scenes[k].name);
        canvas_close(&whole);
        canvas_close(&bands);
    }
}

#ifdef SCENE_MAIN
struct test_run test_now;

void test_list(test_case *item) { (void)item; }

int main(int argc, char **argv)
{
    return scene_print(argc > 1 ? argv[1] : NULL);
}
#endif
