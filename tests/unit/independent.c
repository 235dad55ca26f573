/* independent.c - a lane depends on itself alone: its light, texel and pixel are the same bits
   whatever the other lanes of its packet hold, infinities and NaN included, and those of the
   scalar call.  A NaN equals a NaN: its sign and its other bits are not promised.

   The scalar calls run the build for any processor, the packets that of this one, so that both meet
   here as well. */
#include "unit.h"

static int alone_same(float a, float b)
{
    return float_bits(a) == float_bits(b) || (isnan(a) && isnan(b));
}

/* Makes about one float of n nasty. */
static void alone_spoil(void *memory, size_t bytes, int n)
{
    for (size_t at = 0; at + 4 <= bytes; at += 4) {
        float v = rnd_nasty();
        if (rnd_one_in(n)) memcpy((char *)memory + at, &v, 4);
    }
}

static void alone_spoil_colors(light_sample *s)
{
    alone_spoil(&s->material, sizeof s->material, 8);
    alone_spoil(&s->lighting.ambient, sizeof s->lighting.ambient, 8);
    for (int k = 0; k < s->lighting.light_count; k++) {
        shade_light *l = &s->lights[k];
        alone_spoil(&l->ambient, sizeof l->ambient, 8);
        alone_spoil(&l->diffuse, sizeof l->diffuse, 8);
        alone_spoil(&l->specular, sizeof l->specular, 8);
    }
}

static void alone_spoil_lamps(light_sample *s)
{
    for (int k = 0; k < s->lighting.light_count; k++) {
        shade_light *l = &s->lights[k];
        float *const falls[] = { &l->constant, &l->linear, &l->quadratic, &l->spot_exponent,
                                 &l->spot_cos_cutoff };
        alone_spoil(&l->position, sizeof l->position, 12);
        alone_spoil(&l->spot_direction, sizeof l->spot_direction, 12);
        for (int i = 0; i < 5; i++) alone_spoil(falls[i], 4, 12);
    }
}

/* Every model and flag; ordinary, with wild colours, or with wild lamps too; some lanes look nearly
   at the lamp from behind, some are wild. */
static void alone_sample(light_sample *s, lane_packet *k)
{
    random_sample(s);
    random_packet(k, s, d3_length(d3_from(s->P)) * 1e-2 + 1);
    if (s->lighting.light_count && rnd_one_in(2)) {
        double r;
        d3 L = ref_to_light(&s->lights[0], d3_from(s->P), &r);
        d3 V = d3_add(d3_scale(L, -1), d3_scale(rnd_direction(), (double)rnd_log(1e-8, 0.2)));
        d3 from = s->lighting.flags & SHADE_FLAG_INFINITE_VIEWER ? d3_of(0, 0, 0) : d3_from(s->P);
        s->eye = d3_round(d3_add(from, d3_scale(V, 1 + d3_length(d3_from(s->P)))));
    }
    if (!rnd_one_in(3)) alone_spoil_colors(s);
    if (rnd_one_in(3)) alone_spoil_lamps(s);
    for (int i = 0; i < SHADE_LANES; i++) {
        if (rnd_one_in(3)) alone_spoil(&k->p[i], sizeof k->p[i], 12);
        if (rnd_one_in(3)) alone_spoil(&k->n[i], sizeof k->n[i], 12);
        lane_set(k->P, i, k->p[i]);
        lane_set(k->N, i, k->n[i]);
    }
}

/* G14 */
TEST(independent, a_lane_of_a_packet_is_the_scalar_call)
{
    static lane_packet k;
    light_sample s;
    for (int round = 0; round < 900; round++) {
        float rgb[3][SHADE_LANES];
        alone_sample(&s, &k);
        lit_rows(&s.lighting, &s.material, s.eye, k.P[0], k.N[0], NULL, NULL, rgb[0]);
        for (int i = 0; i < SHADE_LANES; i += 2) {
            shade_vec3 one = shade_lit(&s.lighting, &s.material, s.eye, k.p[i], k.n[i]);
            CHECK_SAY(alone_same(rgb[0][i], one.x) && alone_same(rgb[1][i], one.y) &&
                          alone_same(rgb[2][i], one.z),
                      "model %d flags %u lane %d: %a %a %a, alone %a %a %a", (int)s.lighting.model,
                      s.lighting.flags, i, (double)rgb[0][i], (double)rgb[1][i], (double)rgb[2][i],
                      (double)one.x, (double)one.y, (double)one.z);
        }
    }
}

/* The rows of a packet that has albedo, specular rows and visibility, each perhaps. */
typedef struct alone_rows {
    float albedo[3][SHADE_LANES], specular[3][SHADE_LANES], visible[4][SHADE_LANES];
    float P[3][SHADE_LANES], N[3][SHADE_LANES];
} alone_rows;
static void alone_fill(float *row, int n)
{
    for (int i = 0; i < n * SHADE_LANES; i++) {
        row[i] = rnd_one_in(3) ? (float)rnd_int(0, 1) : rnd_float(0, 1);
        if (rnd_one_in(20)) row[i] = rnd_nasty();
    }
}

/* Every lane becomes lane i. */
static void alone_copies(const alone_rows *from, int i, alone_rows *to)
{
    const float *v = (const float *)from;
    float *all = (float *)to;
    for (size_t row = 0; row < sizeof *to / 4; row += SHADE_LANES)
        for (size_t j = 0; j < SHADE_LANES; j++) all[row + j] = v[row + (size_t)i];
}

static shade_rows alone_pointers(const alone_rows *r, int which)
{
    shade_rows rows = { r->P[0], r->N[0], NULL, NULL, NULL };
    if (which & 1) rows.albedo = r->albedo[0];
    if (which & 2) rows.specular = r->specular[0];
    if (which & 4) rows.visibility = r->visible[0];
    return rows;
}

/* G14 */
TEST(independent, a_lane_among_others_is_the_lane_among_copies_of_itself)
{
    static lane_packet k;
    static alone_rows rows, copies;
    light_sample s;
    for (int round = 0; round < 500; round++) {
        float rgb[3][SHADE_LANES], alone[3][SHADE_LANES];
        const int which = rnd_int(0, 7);
        alone_sample(&s, &k);
        alone_fill(rows.albedo[0], 10);
        memcpy(rows.P, k.P, sizeof k.P);
        memcpy(rows.N, k.N, sizeof k.N);
        shade_rows all = alone_pointers(&rows, which), one = alone_pointers(&copies, which);
        shade_lit_lanes(&s.lighting, &s.material, s.eye, &all, rgb[0]);
        for (int i = round % 8; i < SHADE_LANES; i += 8) {
            alone_copies(&rows, i, &copies);
            shade_lit_lanes(&s.lighting, &s.material, s.eye, &one, alone[0]);
            for (int c = 0; c < 3; c++)
                CHECK_SAY(alone_same(rgb[c][i], alone[c][0]),
                          "model %d flags %u rows %d lane %d: %a, alone %a", (int)s.lighting.model,
                          s.lighting.flags, which, i, (double)rgb[c][i], (double)alone[c][0]);
        }
    }
}

/* G14 */
TEST(independent, what_arrives_at_a_lane_is_what_arrives_at_the_point)
{
    static lane_packet k;
    light_sample s;
    for (int round = 0; round < 1500; round++) {
        float L[3][SHADE_LANES], amount[SHADE_LANES];
        alone_sample(&s, &k);
        shade_light_at_lanes(&s.lights[0], k.P[0], L[0], amount);
        for (int i = 0; i < SHADE_LANES; i += 3) {
            shade_vec3 to_light;
            float one = shade_light_at(&s.lights[0], k.p[i], &to_light, NULL);
            CHECK_SAY(float_bits(amount[i]) == float_bits(one), "lane %d: %a, alone %a", i,
                      (double)amount[i], (double)one);
            CHECK(alone_same(L[0][i], to_light.x) && alone_same(L[1][i], to_light.y) &&
                  alone_same(L[2][i], to_light.z));
        }
    }
}

/* A texture of wild floats or of any bytes, each level as wild. */
/* G14 */
TEST(independent, a_texel_of_a_packet_is_the_scalar_sample)
{
    for (int round = 0; round < 600; round++) {
        float u[SHADE_LANES], v[SHADE_LANES], lod[SHADE_LANES], rgba[4][SHADE_LANES];
        shade_texture levels[16], t = random_texture(40);
        if (t.format == SHADE_FORMAT_RGBA32F)
            alone_spoil((void *)(uintptr_t)t.pixels, texture_cells(&t) * 16, 6);
        void *memory = rnd_one_in(2) ? add_mipmaps(&t, levels) : NULL;
        for (int i = 0; i < SHADE_LANES; i++) {
            u[i] = random_coordinate();
            v[i] = random_coordinate();
            lod[i] = rnd_float(-1, 7);
            if (rnd_one_in(10)) u[i] = rnd_nasty();
            if (rnd_one_in(10)) v[i] = rnd_nasty();
            if (rnd_one_in(10)) lod[i] = rnd_nasty();
        }
        const int with_lod = !rnd_one_in(5);
        shade_sample_lanes(&t, u, v, with_lod ? lod : NULL, rgba[0]);
        for (int i = 0; i < SHADE_LANES; i++) {
            shade_vec4 one = shade_sample(&t, u[i], v[i], with_lod ? lod[i] : 0);
            CHECK_SAY(alone_same(rgba[0][i], one.x) && alone_same(rgba[1][i], one.y) &&
                          alone_same(rgba[2][i], one.z) && alone_same(rgba[3][i], one.w),
                      "format %d filter %d at %a %a lod %a: %a, alone %a", (int)t.format,
                      (int)t.filter, (double)u[i], (double)v[i], (double)lod[i],
                      (double)rgba[0][i], (double)one.x);
        }
        free(memory);
        free_texture(&t);
    }
}

/* ------------------------------------------------------------------------------- whole pictures */

enum { ALONE_W = 48, ALONE_H = 32 };

/* A bent sheet, its lights and its colours wild, drawn as the clip rectangle allows. */
typedef struct alone_scene {
    light_sample light;
    float P[25][3], N[25][3], color[25][3], uv[25][2];
    uint32_t index[96];
    shade_mesh mesh;
    shade_draw_state state;
} alone_scene;
static void alone_sheet(alone_scene *a)
{
    memset(a, 0, sizeof *a);
    for (int i = 0; i < 25; i++) {
        a->P[i][0] = (float)(i % 5) - 2;
        a->P[i][1] = (float)(i / 5) - 2;
        a->P[i][2] = rnd_float(-0.5, 0.5);
        shade_vec3 n = d3_round(d3_add(d3_of(0, 0, 1), d3_scale(rnd_direction(), 1.2)));
        memcpy(a->N[i], &n, 12);
        for (int c = 0; c < 3; c++) a->color[i][c] = rnd_one_in(6) ? rnd_nasty() : rnd_float(0, 1);
        for (int c = 0; c < 2; c++) a->uv[i][c] = rnd_one_in(40) ? rnd_nasty() : rnd_float(-1, 2);
    }
    for (int k = 0; k < 32; k++) {
        const uint32_t at = (uint32_t)(k / 2 % 4 + k / 8 * 5);
        const uint32_t corner[2][3] = { { at, at + 1, at + 6 }, { at, at + 6, at + 5 } };
        memcpy(a->index + 3 * k, corner[k % 2], sizeof corner[0]);
    }
    a->mesh.positions = a->P[0];
    a->mesh.normals = a->N[0];
    a->mesh.vertex_count = 25;
    a->mesh.indices = a->index;
    a->mesh.index_count = 96;
}

static void alone_lights(alone_scene *a)
{
    light_sample *s = &a->light;
    random_sample(s);
    s->lighting.light_count = rnd_int(1, 4);
    for (int k = 0; k < s->lighting.light_count; k++)
        s->lights[k] = random_light(shade_v3(0, 0, 0), 3);
    alone_spoil_colors(s);
    if (rnd_one_in(3)) alone_spoil_lamps(s);
    a->state.lighting = s->lighting;
    a->state.material = &s->material;
    a->state.lighting.lights = s->lights;
}

static void alone_check_pixels(const canvas *whole, const canvas *parts, const char *how)
{
    const size_t bytes = canvas_pixel_bytes(whole->target.format);
    for (int i = 0; i < ALONE_W * ALONE_H; i++) {
        const int x = i % ALONE_W, y = i / ALONE_W;
        int same = !memcmp(canvas_pixel(whole, x, y), canvas_pixel(parts, x, y), bytes);
        if (bytes == 16) {
            same = 1;
            for (int c = 0; c < 4; c++)
                same &= alone_same(canvas_float(whole, x, y, c), canvas_float(parts, x, y, c));
        }
        CHECK_SAY(same, "pixel %d %d by %s", x, y, how);
        CHECK(float_bits(canvas_depth(whole, x, y)) == float_bits(canvas_depth(parts, x, y)));
    }
}

static canvas alone_draw(const alone_scene *a, shade_format format, int w, int h)
{
    canvas c = canvas_ready(ALONE_W, ALONE_H, 0, format, 1);
    for (int y = 0; y < ALONE_H; y += h) {
        for (int x = 0; x < ALONE_W; x += w) {
            c.target.clip_x = x;
            c.target.clip_y = y;
            c.target.clip_width = w;
            c.target.clip_height = h;
            canvas_draw_mesh(&c, &a->mesh, &a->state);
        }
    }
    return c;
}

/* A clip rectangle of one pixel leaves its lane no neighbours; light, colours and texture
   coordinates may be NaN or infinite. */
/* G13, G14 */
TEST(independent, a_picture_is_the_same_in_bands_and_pixel_by_pixel)
{
    for (int round = 0; round < 36; round++) {
        static alone_scene a;
        shade_texture levels[16], map = random_texture(16);
        const shade_format format = round % 2 ? SHADE_FORMAT_RGBA32F : SHADE_FORMAT_RGBA8;
        alone_sheet(&a);
        alone_lights(&a);
        void *memory = add_mipmaps(&map, levels);
        a.state.shading = (shade_shading)(round % 3);
        if (rnd_one_in(2)) a.mesh.colors = a.color[0];
        if (rnd_one_in(2)) {
            a.mesh.texcoords = a.uv[0];
            a.state.diffuse_map = &map;
        }
        a.state.view = shade_mat4_look_at(shade_v3(1, 1, 5), shade_v3(0, 0, 0), shade_v3(0, 1, 0));
        a.state.projection = shade_mat4_perspective(0.9f, 1.5f, 1, 20);
        a.state.raster.cull = SHADE_CULL_NONE;
        canvas whole = alone_draw(&a, format, ALONE_W, ALONE_H);
        canvas bands = alone_draw(&a, format, ALONE_W, 3);
        canvas pixels = alone_draw(&a, format, 1, 1);
        alone_check_pixels(&whole, &bands, "bands");
        alone_check_pixels(&whole, &pixels, "pixels");
        canvas_close(&whole);
        canvas_close(&bands);
        canvas_close(&pixels);
        free(memory);
        free_texture(&map);
    }
}

/* -0 stays, or becomes +0, whether another lane is lit or none. */
/* G14 */
TEST(independent, a_colour_of_minus_zero_is_the_same_beside_a_lit_lane)
{
    static float P[3][SHADE_LANES], N[3][SHADE_LANES], albedo[3][SHADE_LANES];
    shade_light lamp = shade_directional_light(shade_v3(0, 0, -1), shade_v3(1, 1, 1));
    shade_material m = shade_preset_material(SHADE_PRESET_COUNT);
    float rgb[2][3][SHADE_LANES];
    shade_lighting lighting = { .lights = &lamp, .light_count = 1, .ambient = shade_v3(1, 1, 1) };
    m.emission = shade_v3(-0.0f, -0.0f, -0.0f);
    for (int lit = 0; lit < 2; lit++) {
        for (int i = 0; i < SHADE_LANES; i++) {
            lane_set(N, i, shade_v3(0, 0, lit && i > 0 ? 1.0f : -1.0f));
            lane_set(albedo, i, shade_v3(-0.0f, -0.0f, -0.0f));
        }
        lit_rows(&lighting, &m, shade_v3(0, 0, 9), P[0], N[0], albedo[0], NULL, rgb[lit][0]);
    }
    for (int c = 0; c < 3; c++) CHECK(float_bits(rgb[0][c][0]) == float_bits(rgb[1][c][0]));
}

/* ------------------------------------------------------------------------------------------ NaN */

/* The NaN that an operation makes is positive on some processors and negative on others. */
/* G14 */
TEST(independent, the_sign_of_a_nan_decides_nothing)
{
    const float nan[2] = { bits_float(0x7FC00000u), bits_float(0xFFC00001u) };
    shade_light lamp = shade_point_light(shade_v3(0, 3, 0), shade_v3(1, 1, 1));
    static const float texel[4][4] = { { 1 }, { 2 }, { 3 }, { 4 } };
    shade_texture t = { .pixels = texel, .width = 4, .height = 1, .format = SHADE_FORMAT_RGBA32F };
    for (int falls = 0; falls < 2; falls++) {
        lamp.quadratic = (float)falls;
        CHECK_NEAR(shade_light_at(&lamp, shade_v3(nan[0], 0, 0), NULL, NULL), 0, 1e-30);
        CHECK_NEAR(shade_light_at(&lamp, shade_v3(nan[1], 0, 0), NULL, NULL), 0, 1e-30);
    }
    for (int k = 0; k < 2; k++) {
        CHECK_NEAR(shade_power(nan[k], 2), 0, 0);
        CHECK_NEAR(shade_power(0.5f, nan[k]), 1, 0);
        CHECK_NEAR(shade_attenuation(1, nan[k], 0, 1), 1e20, 1e14);
        lamp.quadratic = nan[k];
        CHECK_NEAR(shade_light_at(&lamp, shade_v3(0, 0, 0), NULL, NULL), 1e20, 1e14);
        lamp.quadratic = 0;
        lamp.constant = nan[k];
        CHECK_NEAR(shade_light_at(&lamp, shade_v3(0, 0, 0), NULL, NULL), 1e20, 1e14);
        lamp.constant = 0;
        for (int wrap = 0; wrap < 3; wrap++) {
            t.wrap_u = (shade_wrap)wrap;
            CHECK_NEAR(shade_sample(&t, nan[k], 0.5f, 0).x, shade_sample(&t, 0, 0.5f, 0).x, 0);
        }
    }
}

/* What the sum of the coefficients makes of finite ones: -inf + inf, whose sign differs between
   processors; and a square of the distance that overflows beside a coefficient of 0. */
/* G3 */
TEST(independent, a_distance_or_a_sum_that_overflows_has_one_outcome)
{
    shade_light lamp = shade_point_light(shade_v3(0, 0, 0), shade_v3(1, 1, 1));
    lamp.linear = -1e30f;
    lamp.quadratic = 1e30f;
    CHECK_NEAR(shade_light_at(&lamp, shade_v3(1e12f, 0, 0), NULL, NULL), 1e20, 1e14);
    lamp.linear = 1;
    lamp.quadratic = 0;
    CHECK_NEAR(shade_light_at(&lamp, shade_v3(1e18f, 0, 0), NULL, NULL), 1e-18, 1e-23);
    CHECK_NEAR(shade_light_at(&lamp, shade_v3(1e30f, 0, 0), NULL, NULL), 0, 2e-18);
    lamp.quadratic = 1e30f;
    CHECK_NEAR(shade_light_at(&lamp, shade_v3(1e18f, 0, 0), NULL, NULL), 0, 0);
}
