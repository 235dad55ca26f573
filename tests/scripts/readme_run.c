/* readme_run.c - the programs and snippets of the README, run: what they draw, find and store is
   what the README says.  readme.sh cuts out the README's program (knot.c), the snippets behind it
   (snippets.h, and more.h from the pages that continue it), and those that need SDL2 and stb
   (sdl.h, stb.h), which are left out where README_SDL and README_STB are not defined.

   readme_run knot.ppm triangle.ppm    written by the programs of the README and of shade.h */
#define main knot_main
#include "knot.c"
#undef main
static shade_vec3 eye;    /* which the README says to have beside its program's variables */
#include "snippets.h"
#include "more.h"
#ifdef README_SDL
#define SDL_MAIN_HANDLED
#include "sdl.h"
#endif
#ifdef README_STB
#include "stb.h"
#define STB_IMAGE_IMPLEMENTATION
#define STBI_NO_SIMD
#include "stb_image.h"
#endif
#include "examples/shared/teapot.h"

#include "../unit/test.h"
#include "../unit/oracle.h"

struct test_run test_now;

enum { MOST = 640 * 480 };
static const char *knot_ppm, *triangle_ppm;
static float run_depth[MOST], run_color[MOST][4];
static uint32_t run_bytes[MOST], run_indices[3 * 4096];
static float run_positions[3 * 2560], run_normals[3 * 2560], run_texcoords[2 * 2560];

/* state, mesh and eye of a test, and a picture of floats */
static void start(int width, int height, shade_vec3 from, shade_vec3 to)
{
    static const shade_target no_target;
    static const shade_mesh no_mesh;
    static const shade_draw_state no_state;
    target = no_target;
    mesh = no_mesh;
    state = no_state;
    eye = from;
    target.width = width;
    target.height = height;
    target.format = SHADE_FORMAT_RGBA32F;
    target.color = run_color;
    target.depth = run_depth;
    state.view = shade_mat4_look_at(from, to, shade_v3(0, 1, 0));
    state.projection = shade_mat4_perspective(0.7f, (float)width / (float)height, 0.5f, 50);
    mesh.positions = run_positions;
    mesh.normals = run_normals;
    mesh.texcoords = run_texcoords;
    mesh.indices = run_indices;
    shade_clear(&target, shade_v4(0.02f, 0.02f, 0.05f, 1), 1);
}

static void put_square(int k, double size, double y);    /* square number k, seen from above */

/* --------------------------------------------------------------------------------- the programs */

/* The 640 x 480 pixels of a PPM, three bytes each */
static const unsigned char *read_picture(const char *path)
{
    static unsigned char rgb[3 * MOST];
    int width = 0, height = 0, most = 0;
    size_t got = 0;
    FILE *f = path ? fopen(path, "rb") : NULL;
    if (f) {
        if (fscanf(f, "P6 %d %d %d", &width, &height, &most) == 3 && getc(f) != EOF)
            got = fread(rgb, 1, sizeof rgb, f);
        fclose(f);
    }
    CHECK(width == 640 && height == 480 && most == 255 && got == sizeof rgb);
    return rgb;
}

/* A point of the knot: a torus knot of two turns by three, and a circle around it.  Both places go
   from 0 to 1. */
static d3 knot_point(double along, double around)
{
    const double tau = 2 * acos(-1.0);
    double tube = tau * (around + 2 * along), bow = tau * 2 * along, turn = tau * 3 * along;
    double r = 2.4 + cos(bow) + 0.5 * cos(tube);
    return d3_of(r * cos(turn), sin(bow) + 0.5 * sin(tube), -r * sin(turn));
}

/* The linear light of a surface of gold, by its table of display colours */
static d3 gold_light(const shade_light *light, d3 P, d3 N, d3 from)
{
    static const double k_d[3] = { 0.75164, 0.60648, 0.22648 };
    static const double k_s[3] = { 0.628281, 0.555802, 0.366065 };
    shade_material m = { 0 };
    shade_lighting lighting = { 0 };
    m.diffuse = shade_v3((float)ref_decode_srgb(k_d[0]), (float)ref_decode_srgb(k_d[1]),
                         (float)ref_decode_srgb(k_d[2]));
    m.specular = shade_v3((float)ref_decode_srgb(k_s[0]), (float)ref_decode_srgb(k_s[1]),
                          (float)ref_decode_srgb(k_s[2]));
    m.shininess = 51.2f;
    lighting.lights = light;
    lighting.light_count = 1;
    return ref_light(&lighting, &m, P, N, from, d3_of(1, 1, 1)).total;
}

/* Points all over the knot, in double, are projected to pixels.  A pixel shows the gold of the
   nearest one, where that lies close to its centre; where none is around, the background. */
TEST(readme, program_draws_a_knot_of_gold)
{
    enum { ALL_ALONG = 9000, ALL_AROUND = 500 };
    static double nearest[MOST], shown[MOST];
    static d3 point[MOST], normal[MOST];
    static unsigned char reached[MOST];
    const d3 from = d3_of(0, 8.5, 7), back = d3_unit(from), up = d3_cross(back, d3_of(1, 0, 0));
    const shade_light lamp = shade_point_light(shade_v3(-4, 7, 5), shade_v3(1, 1, 1));
    const double scale = 240 / tan(0.35), step = 1e-6;
    const unsigned char *rgb = read_picture(knot_ppm);
    int gold = 0, wrong = 0, dark = 0;
    for (int i = 0; i < MOST; i++) nearest[i] = shown[i] = 1e9;
    for (int k = 0; k < ALL_ALONG * ALL_AROUND; k++) {
        double along = (double)(k / ALL_AROUND) / ALL_ALONG;
        double around = (double)(k % ALL_AROUND) / ALL_AROUND;
        d3 P = knot_point(along, around), to = d3_sub(P, from);
        double away = -d3_dot(to, back);
        double X = 320 + to.x / away * scale, Y = 240 - d3_dot(to, up) / away * scale;
        int x = (int)X, y = (int)Y, at = y * 640 + x;
        for (int n = 0; n < 9; n++) reached[at + (n / 3 - 1) * 640 + n % 3 - 1] = 1;
        nearest[at] = fmin(nearest[at], away);
        if (fabs(X - x - 0.5) > 0.25 || fabs(Y - y - 0.5) > 0.25 || away > shown[at]) continue;
        d3 u = d3_sub(knot_point(along + step, around), P);
        d3 v = d3_sub(knot_point(along, around + step), P);
        shown[at] = away;
        point[at] = P;
        normal[at] = d3_unit(d3_cross(u, v));
    }
    for (int i = 0; i < MOST; i++) {
        const unsigned char *p = rgb + 3 * i;
        if (!reached[i]) {
            dark++;
            CHECK_NEAR(p[0], 255 * ref_encode_srgb(0.02), 0.51);
            CHECK_NEAR(p[1], 255 * ref_encode_srgb(0.02), 0.51);
            CHECK_NEAR(p[2], 255 * ref_encode_srgb(0.05), 0.51);
        }
        if (shown[i] > 1e8 || shown[i] > nearest[i] + 0.05) continue;
        if (d3_dot(normal[i], d3_unit(d3_sub(from, point[i]))) < 0.3) continue;    /* the outline */
        d3 light = gold_light(&lamp, point[i], normal[i], from);
        d3 got = d3_of(ref_decode_srgb(p[0] / 255.0), ref_decode_srgb(p[1] / 255.0),
                       ref_decode_srgb(p[2] / 255.0));
        gold++;
        wrong += d3_max(d3_sub(got, light)) > 0.03;
    }
    CHECK_SAY(gold > 50000 && wrong < gold / 2000, "%d pixels of gold, %d wrong", gold, wrong);
    CHECK_SAY(dark > 150000, "%d pixels of background", dark);
}

/* The sun shines straight on a white triangle, at z = 0 before an eye at z = 3: its own colour. */
TEST(readme, program_of_the_header_draws_a_triangle)
{
    const unsigned char *rgb = read_picture(triangle_ppm);
    const double scale = 240 / tan(0.5) / 3, slope = 2 / sqrt(5.0);
    int inside = 0, outside = 0;
    for (int i = 0; i < MOST; i++) {
        const unsigned char *p = rgb + 3 * i;
        double x = (i % 640 + 0.5 - 320) / scale, y = (240 - i / 640 - 0.5) / scale;
        double within = fmin(y + 1, slope * (0.5 - y / 2 - fabs(x))) * scale;    /* pixels */
        if (fabs(within) < 1) continue;
        inside += within > 0;
        outside += within < 0;
        CHECK_INT(p[0], within > 0 ? 255 : 26);
        CHECK_INT(p[1], within > 0 ? 204 : 26);
        CHECK_INT(p[2], within > 0 ? 128 : 51);
    }
    CHECK_SAY(inside > 30000 && outside > 200000, "%d inside, %d outside", inside, outside);
}

/* Six mistakes, in the order of the README's table, and the sentences that stand there. */
TEST(readme, explain_says_what_the_table_quotes)
{
    static const char *quoted[] = {
#include "sentences.h"
    };
    const shade_vec3 up = { 0, 1, 0 };
    CHECK_INT(TEST_COUNT(quoted), 6);
    for (int k = 0; k < TEST_COUNT(quoted); k++) {
        shade_stats stats;
        shade_light sun = shade_directional_light(shade_v3(0, -1, -1), shade_v3(1, 1, 1));
        start(64, 48, shade_v3(0, 4, 6), shade_v3(0, 0, 0));
        put_square(0, 2, 0);
        state.lighting.lights = &sun;
        state.lighting.light_count = 1;
        if (k == 0) mesh.index_count = 5;
        if (k == 1) state.projection = shade_mat4_perspective(45, 64 / 48.0f, 0.5f, 50);
        if (k == 2) state.view = shade_mat4_look_at(shade_v3(0, 4, 6), shade_v3(0, 8, 12), up);
        if (k == 3) state.raster.cull = SHADE_CULL_BACK;
        if (k == 3) state.view = shade_mat4_look_at(shade_v3(0, -4, 6), shade_v3(0, 0, 0), up);
        if (k == 4) shade_clear(&target, shade_v4(0, 0, 0, 1), 0);
        if (k == 5) memset(&state.lighting, 0, sizeof state.lighting);
        shade_draw_mesh(&target, &mesh, &state, &stats);
        const char *said = shade_explain(&target, &mesh, &state, &stats);
        CHECK_SAY(strstr(said, quoted[k]), "README: \"%s\"; said: \"%s\"", quoted[k], said);
    }
}

/* ---------------------------------------------------------------------------------------- light */

TEST(readme, three_lamps_shine_as_said)
{
    start(64, 48, shade_v3(1, 2, 5), shade_v3(0, 0, 0));
    three_lamps();
    CHECK_INT(state.lighting.light_count, 3);
    /* from above, right and the front; the second halved at 2; the third in a cone below it */
    shade_vec3 L;
    float r;
    CHECK_NEAR(shade_light_at(&lights[0], shade_v3(0, 0, 0), &L, NULL), 1, 0);
    CHECK(L.x > 0 && L.y > 0 && L.z > 0);
    CHECK_NEAR(shade_light_at(&lights[1], shade_v3(0, 1, 2), NULL, &r), 0.5, 1e-6);
    CHECK_NEAR(r, 2, 1e-6);
    CHECK_NEAR(shade_light_at(&lights[2], shade_v3(0, 0, 0), NULL, NULL), 1, 1e-6);
    CHECK_NEAR(shade_light_at(&lights[2], shade_v3(4 * 0.55f, 0, 0), NULL, NULL), 0, 0);
}

/* The teapot at any place and of any size, from any side: the picture holds all of it, and one of
   its sides is near. */
TEST(readme, first_picture_shows_all_of_any_mesh)
{
    for (int i = 0; i < 20; i++) {
        const float size = rnd_log(1e-3, 1e3);
        int low[2] = { 640, 480 }, high[2] = { -1, -1 };
        start(640, 480, shade_v3(0, 0, 5), shade_v3(0, 0, 0));
        mesh.vertex_count = teapot_vertex_count(8);
        mesh.index_count = teapot_index_count(8);
        teapot_build(8, run_positions, run_normals, NULL, run_indices);
        const float away = size * rnd_float(-5, 5);
        for (int k = 0; k < 3 * mesh.vertex_count; k++)
            run_positions[k] = run_positions[k] * size + away;
        first_picture(d3_round(rnd_direction()));
        for (int k = 0; k < MOST; k++) {
            const int at[2] = { k % 640, k / 640 };
            if (run_depth[k] >= 1) continue;
            for (int n = 0; n < 2; n++) {
                low[n] = at[n] < low[n] ? at[n] : low[n];
                high[n] = at[n] > high[n] ? at[n] : high[n];
            }
        }
        CHECK_SAY(high[0] - low[0] > 200 || high[1] - low[1] > 150, "%d .. %d, %d .. %d", low[0],
                  high[0], low[1], high[1]);
        CHECK(low[0] > 0 && low[1] > 0 && high[0] < 639 && high[1] < 479);
    }
}

/* ------------------------------------------------------------------------------------- pictures */

TEST(readme, floats_become_bytes)
{
    shade_target bytes;
    start(64, 32, shade_v3(0, 0, 5), shade_v3(0, 0, 0));
    for (int i = 0; i < 64 * 32; i++) {
        for (int k = 0; k < 4; k++) run_color[i][k] = rnd_float(-0.1, 1.2);
    }
    bytes = target;
    bytes.format = SHADE_FORMAT_RGBA8;
    bytes.color = run_bytes;
    bytes.srgb = 1;
    CHECK_INT(shade_resolve(&bytes, &target, 1), SHADE_OK);
    for (int i = 0; i < 64 * 32; i++) {
        const unsigned char *p = (const unsigned char *)&run_bytes[i];
        for (int k = 0; k < 3; k++)
            CHECK_NEAR(p[k], 255 * ref_encode_srgb((double)run_color[i][k]), 0.502);
        CHECK_NEAR(p[3], 255 * fmin(1, fmax(0, (double)run_color[i][3])), 0.502);
    }
}

/* Bytes of many values, alpha 255 */
static void random_bytes(int width, int height, shade_format format)
{
    start(width, height, shade_v3(0, 0, 5), shade_v3(0, 0, 0));
    target.format = format;
    target.color = run_bytes;
    for (int i = 0; i < width * height; i++) {
        unsigned char p[4] = { 0, 0, 0, 255 };
        for (int k = 0; k < 3; k++) p[k] = (unsigned char)rnd_int(0, 255);
        memcpy(&run_bytes[i], p, 4);
    }
}

/* Pixels of both orders of bytes, that of the README's program and that of the screen */
TEST(readme, window_shows_the_target)
{
#ifdef README_SDL
    static const int red[2] = { 0, 2 };    /* the byte of red in RGBA8 and BGRA8 */
    for (int format = SHADE_FORMAT_RGBA8; format <= SHADE_FORMAT_BGRA8; format++) {
        random_bytes(64, 48, (shade_format)format);
        SDL_Event quit = { .type = SDL_QUIT };
        CHECK_INT(SDL_Init(SDL_INIT_VIDEO), 0);
        CHECK_INT(SDL_PushEvent(&quit), 1);
        show();
        SDL_Window *window = SDL_GetWindowFromID(1);
        SDL_Surface *surface = window ? SDL_GetWindowSurface(window) : NULL;
        CHECK(surface && surface->w == 64 && surface->h == 48);
        if (!surface || surface->w != 64 || surface->h != 48) return;
        for (int i = 0; i < 64 * 48; i++) {
            const unsigned char *want = (const unsigned char *)&run_bytes[i];
            const unsigned char *row = (const unsigned char *)surface->pixels;
            row += i / 64 * surface->pitch;
            int bytes = surface->format->BytesPerPixel;
            uint32_t pixel = 0;
            uint8_t r, g, b;
            memcpy(&pixel, row + i % 64 * bytes, (size_t)bytes);
            SDL_GetRGB(pixel, surface->format, &r, &g, &b);
            CHECK_INT(r, want[red[format]]);
            CHECK_INT(g, want[1]);
            CHECK_INT(b, want[2 - red[format]]);
        }
        SDL_Quit();
    }
#else
    test_skip("no SDL2");
#endif
}

TEST(readme, png_holds_the_target)
{
#ifdef README_STB
    int width, height, channels;
    const char *path = "readme_run.png";
    random_bytes(64, 48, SHADE_FORMAT_RGBA8);
    CHECK(save(path));
    unsigned char *back = stbi_load(path, &width, &height, &channels, 4);
    CHECK(back && width == 64 && height == 48 && channels == 4);
    CHECK(back && !memcmp(back, run_bytes, sizeof(uint32_t[64 * 48])));
    stbi_image_free(back);
    remove(path);
#else
    test_skip("no stb");
#endif
}

/* -------------------------------------------------------------------------------- shaders, rays */

enum { ROOF = 1, FLOOR = 2, SHADOW = 3 }; /* what a pixel shows; 0: nothing */
static const double roof_y = 1, roof_size = 0.8, floor_size = 4;
static const d3 lamp_at = { 0.7, 4, 0.4 };

/* A ray through point X, Y of the window meets the plane at height y; 1 where within size. */
static int meets(double X, double Y, double y, double size, d3 *P)
{
    d3 from = d3_from(eye), back = d3_unit(from), right = d3_unit(d3_of(back.z, 0, -back.x));
    d3 up = d3_cross(back, right);
    double t = tan(0.35), w = target.width, h = target.height;
    d3 d = d3_sub(d3_scale(right, (2 * X / w - 1) * t * w / h), back);
    d = d3_add(d, d3_scale(up, (1 - 2 * Y / h) * t));
    *P = d3_add(from, d3_scale(d, (y - from.y) / d.y));
    return (y - from.y) / d.y > 0 && fabs(P->x) < size && fabs(P->z) < size;
}

static int shown(double X, double Y, d3 *P)
{
    if (meets(X, Y, roof_y, roof_size, P)) return ROOF;
    if (!meets(X, Y, 0, floor_size, P)) return 0;
    d3 at = d3_add(*P, d3_scale(d3_sub(lamp_at, *P), roof_y / lamp_at.y));
    return fabs(at.x) < roof_size && fabs(at.z) < roof_size ? SHADOW : FLOOR;
}

static void put(int at, float x, float y, float z)
{
    run_positions[3 * at] = x;
    run_positions[3 * at + 1] = y;
    run_positions[3 * at + 2] = z;
    run_normals[3 * at] = run_normals[3 * at + 2] = 0;
    run_normals[3 * at + 1] = 1;
    run_texcoords[2 * at] = x;
    run_texcoords[2 * at + 1] = z;
}

static void put_square(int k, double size, double y)
{
    static const float side[4] = { -1, 1, 1, -1 };
    static const uint32_t corner[6] = { 0, 1, 2, 0, 2, 3 };
    for (int i = 0; i < 4; i++) {
        put(4 * k + i, (float)size * side[i], (float)y, -(float)size * side[(i + 3) % 4]);
    }
    for (int i = 0; i < 6; i++) run_indices[6 * k + i] = 4 * (uint32_t)k + corner[i];
    mesh.vertex_count = 4 * k + 4;
    mesh.index_count = 6 * k + 6;
}

/* A grey map whose level k is 1 - 0.1 k, so that a pixel says which level it is from. */
enum { SIZE = 64, LEVELS = 6 };
static void grey_levels(shade_texture *map, shade_texture *levels)
{
    static float grey[LEVELS + 1][SIZE * SIZE][4];
    for (int k = 0; k <= LEVELS; k++) {
        for (int i = 0; i < SIZE * SIZE; i++) {
            for (int c = 0; c < 4; c++) grey[k][i][c] = 1 - 0.1f * (float)k;
        }
        shade_texture *level = k ? &levels[k - 1] : map;
        memset(level, 0, sizeof *level);
        level->pixels = grey[k];
        level->format = SHADE_FORMAT_RGBA32F;
        level->width = level->height = SIZE >> k;
        level->filter = SHADE_FILTER_TRILINEAR;
    }
    map->mipmaps = levels;
    map->mipmap_count = LEVELS;
}

/* What is at a place, and within 0.6 pixels around it; -1 where that is not one thing. */
static int shown_around(double X, double Y, d3 *P)
{
    d3 ignored;
    int what = shown(X, Y, P);
    for (int k = 0; k < 4; k++) {
        if (shown(X + (k % 2 ? 0.6 : -0.6), Y + (k / 2 ? 0.6 : -0.6), &ignored) != what) return -1;
    }
    return what;
}

/* The light of a point, its albedo that of the level of the map which its pixel's step takes. */
static d3 textured_light(double X, double Y, d3 P, int in_shadow)
{
    d3 right, below;
    meets(X + 1e-4, Y, P.y, 1e9, &right);
    meets(X, Y + 1e-4, P.y, 1e9, &below);
    double step = fmax(d3_length(d3_sub(right, P)), d3_length(d3_sub(below, P))) * 1e4 * SIZE;
    double albedo = 1 - 0.1 * fmin(LEVELS, fmax(0, log2(step)));
    shade_lighting lighting = state.lighting;
    if (in_shadow) lighting.light_count = 0;
    return ref_light(&lighting, state.material, P, d3_of(0, 1, 0), d3_from(eye),
                     d3_of(albedo, albedo, albedo)).total;
}

/* A floor below a roof below a lamp below a ceiling, which casts no shadow.  Level k of the map has
   the grey 1 - k/10, so that albedo tells the level of detail. */
TEST(readme, shaders_draw_map_and_shadow)
{
    enum { W = 160, H = 120 };
    shade_texture levels[LEVELS];
    shade_light lamp = shade_point_light(d3_round(lamp_at), shade_v3(1, 0.9f, 0.8f));
    shade_material glossy = shade_preset_material(SHADE_PRESET_JADE);
    int seen[4] = { 0, 0, 0, 0 };
    start(W, H, shade_v3(1, 4, 6), shade_v3(0, 0, 0));
    put_square(0, floor_size, 0);
    put_square(1, roof_size, roof_y);
    put_square(2, 50, 6);
    state.material = &glossy;
    state.lighting.ambient = shade_v3(0.2f, 0.2f, 0.2f);
    state.lighting.lights = &lamp;
    state.lighting.light_count = 1;
    uniforms u = { shade_mat4_mul(state.projection, state.view), { 0 } };
    grey_levels(&u.map, levels);
    CHECK_INT(draw(&u), SHADE_OK);
    for (int i = 0; i < W * H; i++) {
        double X = i % W + 0.5, Y = i / W + 0.5;
        d3 P;
        int what = shown_around(X, Y, &P);
        if (what < 0) continue;
        seen[what]++;
        if (!what) {
            CHECK_NEAR(run_color[i][0], 0.02f, 0);
            continue;
        }
        d3 want = textured_light(X, Y, P, what == SHADOW);
        d3 got = d3_of((double)run_color[i][0], (double)run_color[i][1], (double)run_color[i][2]);
        CHECK_SAY(d3_max(d3_sub(got, want)) < 1e-3, "%d,%d: kind %d, green %.5f, want %.5f",
                  i % W, i / W, what, got.y, want.y);
    }
    CHECK(seen[0] > 500 && seen[ROOF] > 500 && seen[FLOOR] > 5000 && seen[SHADOW] > 500);
}

/* A floor below a roof, and a map of depth from a lamp aslant.  Counts the places of the floor that
   the map calls dark though the roof, made larger by two texels, lets light pass (acne), and those
   it calls lit though the roof, made smaller, does not (leaks).  share: of the offset advised. */
typedef struct shadow_count { int lit, acne, blocked, leaks; } shadow_count;
static shadow_count count_shadows(int around, double height, float share)
{
    enum { SIDE = 128, PLACES = 300 };
    static float map[SIDE][SIDE];
    const float fovy = 1.3f;
    const shade_vec3 at = { 4, 2.5f, 1.5f };
    const shade_vec3 axis = shade_normalize(shade_neg(at)), N = { 0, 1, 0 };
    shadow_count n = { 0, 0, 0, 0 };
    shade_target lamp_target = { 0 };
    shade_pipeline pipeline = { 0 };
    lamp_target.width = lamp_target.height = SIDE;
    lamp_target.depth = map[0];
    start(8, 8, shade_v3(0, 4, 6), shade_v3(0, 0, 0));
    put_square(0, floor_size, 0);
    put_square(1, roof_size, height);
    uniforms u = { shade_mat4_mul(shade_mat4_perspective(fovy, 1, 0.5f, 40),
                                  shade_mat4_look_at(at, shade_v3(0, 0, 0), N)),
                   { 0 } };
    pipeline.vertex = vertex;
    pipeline.uniforms = &u;
    shade_clear(&lamp_target, shade_v4(0, 0, 0, 0), 1);
    CHECK_INT(shade_draw(&lamp_target, &pipeline, mesh.indices, mesh.index_count,
                         mesh.vertex_count, NULL), SHADE_OK);
    for (int k = 0; k < PLACES * PLACES; k++) {
        const float step = 4.0f / PLACES;
        shade_vec3 P = { step * (float)(k % PLACES) - 2, 0, step * (float)(k / PLACES) - 2 };
        float w = shade_dot(axis, shade_sub(P, at)), texel = 2 * w * tanf(fovy / 2) / SIDE;
        float reach = (around ? 2.12f : 0.71f) * texel;
        shade_vec3 p = shade_mat4_transform_point(u.clip_from_world,
                                                  off_surface(P, N, axis, share * reach));
        int x = (int)((1 + p.x) * SIDE / 2), y = (int)((1 - p.y) * SIDE / 2), dark = 0;
        CHECK(x >= 1 && y >= 1 && x < SIDE - 1 && y < SIDE - 1);
        for (int j = y - around; j <= y + around; j++) {
            for (int i = x - around; i <= x + around; i++) dark += (1 + p.z) / 2 > map[j][i];
        }
        /* where the way to the lamp passes the height of the roof */
        double way = height / (double)at.y, rim = (5 + around) * (double)texel;
        double X = P.x + way * ((double)at.x - P.x), Z = P.z + way * ((double)at.z - P.z);
        double out = fmax(fabs(X), fabs(Z)) - roof_size;
        n.lit += out > rim;
        n.acne += out > rim && dark > 0;
        n.blocked += out < -rim;
        n.leaks += out < -rim && !dark;
    }
    return n;
}

TEST(readme, the_offset_advised_leaves_no_shadow_acne)
{
    for (int around = 0; around <= 1; around++) {
        const shadow_count without = count_shadows(around, 0.5, 0);
        const shadow_count half = count_shadows(around, 0.5, 0.5f);
        const shadow_count with = count_shadows(around, 0.5, 1);
        const shadow_count more = count_shadows(around, 0.25, 10);
        CHECK_SAY(without.acne > without.lit * 4 / 10, "%d of %d", without.acne, without.lit);
        CHECK_SAY(half.acne > half.lit / 100, "%d of %d", half.acne, half.lit);
        CHECK_SAY(with.lit > 40000 && !with.acne, "%d of %d", with.acne, with.lit);
        CHECK_SAY(with.blocked > 5000 && !with.leaks, "%d of %d", with.leaks, with.blocked);
        CHECK_SAY(more.leaks > 0, "%d of %d", more.leaks, more.blocked);
    }
}

/* Vertex colours as they are, with lamps or without */
TEST(readme, unlit_shows_the_colours_alone)
{
    static float colors[3 * 4];
    start(64, 48, shade_v3(0, 6, 0.01f), shade_v3(0, 0, 0));
    put_square(0, 50, 0);
    for (int k = 0; k < 12; k++) colors[k] = 0.1f + 0.25f * (float)(k % 3);
    mesh.colors = colors;
    three_lamps();
    shade_material dark = shade_preset_material(SHADE_PRESET_JADE);
    state.material = &dark;
    unlit();
    CHECK_INT(shade_draw_mesh(&target, &mesh, &state, NULL), SHADE_OK);
    for (int i = 0; i < 64 * 48; i++) {
        for (int k = 0; k < 3; k++) CHECK_NEAR(run_color[i][k], colors[k], 1e-6);
    }
}

/* The roof over the floor of another colour; white from far away is grey. */
TEST(readme, mist_takes_a_tenth_of_the_light_each_unit)
{
    enum { W = 80, H = 60 };
    static float colors[8][3];
    shade_light lamp = shade_point_light(d3_round(lamp_at), shade_v3(1, 0.9f, 0.8f));
    int seen = 0;
    start(W, H, shade_v3(1, 4, 6), shade_v3(0, 0, 0));
    put_square(0, floor_size, 0);
    put_square(1, roof_size, roof_y);
    for (int i = 0; i < 24; i++) colors[i / 3][i % 3] = i < 12 ? 0.5f : 1;
    mesh.colors = colors[0];
    state.lighting.lights = &lamp;
    state.lighting.light_count = 1;
    state.fragment = mist;
    state.uniforms = &state;
    CHECK_INT(shade_draw_mesh(&target, &mesh, &state, NULL), SHADE_OK);
    for (int i = 0; i < W * H; i++) {
        d3 P, beside;
        int what = shown(i % W + 0.5, i / W + 0.5, &P), even = what != 0;
        for (int k = 0; k < 4; k++)
            even &= (shown(i % W + k % 2, i / W + k / 2, &beside) == ROOF) == (what == ROOF);
        for (int k = 0; k < 4; k++) even &= shown(i % W + k % 2, i / W + k / 2, &beside) != 0;
        if (!even) continue;
        double grey = what == ROOF ? 1 : 0.5, left = pow(0.9, d3_length(d3_sub(d3_from(eye), P)));
        ref_lit lit = ref_light(&state.lighting, NULL, P, d3_of(0, 1, 0), d3_from(eye),
                                d3_of(grey, grey, grey));
        CHECK_NEAR(run_color[i][0], 0.7 + left * (lit.total.x - 0.7), 1e-3);
        CHECK_NEAR(run_color[i][2], 0.7 + left * (lit.total.z - 0.7), 1e-3);
        seen++;
    }
    CHECK(seen > 2000);
}

static void clip_only(const void *data, const shade_vertex_ids *SHADE_RESTRICT in,
                      shade_vertices *SHADE_RESTRICT out)
{
    const shade_mat4 *m = (const shade_mat4 *)data;
    for (int i = 0; i < SHADE_LANES; i++) {
        const float *p = mesh.positions + 3 * in->index[i];
        shade_vec4 c = shade_mat4_transform(*m, shade_v4(p[0], p[1], p[2], 1));
        out->clip[0][i] = c.x;
        out->clip[1][i] = c.y;
        out->clip[2][i] = c.z;
        out->clip[3][i] = c.w;
    }
}

static void number(const void *data, const shade_fragments *SHADE_RESTRICT in,
                   shade_colors *SHADE_RESTRICT out)
{
    (void)data;
    for (int i = 0; i < SHADE_LANES; i++) out->color[0][i] = (float)in->primitive[i];
}

/* Whether X, Y lies within 1/64 pixel of the outline of a triangle. */
static int near_edge(shade_mat4 clip, int triangle, double X, double Y)
{
    shade_vec4 v[3];
    ref_triangle t;
    for (int k = 0; k < 3; k++) {
        const float *p = mesh.positions + 3 * mesh.indices[3 * triangle + k];
        v[k] = shade_mat4_transform(clip, shade_v4(p[0], p[1], p[2], 1));
    }
    return ref_triangle_of(&t, &v[0], &v[1], &v[2], target.width, target.height) &&
           ref_covers(&t, X, Y, 1 / 64.0, 0, 0) < 0;
}

/* A mesh with indices under a matrix of its own: at each pixel the triangle drawn there. */
/* G10 */
TEST(readme, picking_finds_what_was_drawn)
{
    enum { W = 160, H = 120 };
    shade_mat4 clip;
    shade_pipeline pipeline = { clip_only,
                                number,
                                NULL,
                                0,
                                SHADE_INTERPOLATION_PERSPECTIVE,
                                { SHADE_CULL_NONE, SHADE_COMPARE_LESS, SHADE_BLEND_REPLACE, 0, 0,
                                  0 },
                                0,
                                NULL,
                                0 };
    int drawn = 0, differ = 0;
    start(W, H, shade_v3(0, 4, 8), shade_v3(0, 1.4f, 0));
    mesh.vertex_count = teapot_vertex_count(8);
    mesh.index_count = teapot_index_count(8);
    teapot_build(8, run_positions, run_normals, NULL, run_indices);
    state.model = shade_mat4_mul(shade_mat4_translation(shade_v3(0.3f, 0.2f, -1)),
                                 shade_mat4_rotation(0.8f, shade_v3(0.2f, 1, 0)));
    clip = shade_mat4_mul(shade_mat4_mul(state.projection, state.view), state.model);
    pipeline.uniforms = &clip;
    shade_clear(&target, shade_v4(-1, 0, 0, 1), 1);
    CHECK_INT(
        shade_draw(&target, &pipeline, mesh.indices, mesh.index_count, mesh.vertex_count, NULL),
        SHADE_OK);
    for (int i = 0; i < W * H; i++) {
        float x = (float)(i % W) + 0.5f, y = (float)(i / W) + 0.5f;
        int want = (int)run_color[i][0], got = triangle_at(x, y);
        drawn += want >= 0;
        if (got == want) continue;
        differ++;
        CHECK_SAY((want >= 0 && near_edge(clip, want, (double)x, (double)y)) ||
                      (got >= 0 && near_edge(clip, got, (double)x, (double)y)),
                  "pixel %d,%d: triangle %d, drawn is %d", i % W, i / W, got, want);
    }
    CHECK_SAY(drawn > 3900 && differ < drawn / 100, "%d drawn, %d differ", drawn, differ);
}

TEST(readme, chunks_draw_the_same_and_skip_what_is_not_seen)
{
    static float whole[MOST][4];
    enum { W = 160, H = 120 };
    shade_stats stats;
    start(W, H, shade_v3(0, 4, 8), shade_v3(2, 1.4f, 0));
    mesh.vertex_count = teapot_vertex_count(8);
    mesh.index_count = teapot_index_count(8);
    teapot_build(8, run_positions, run_normals, NULL, run_indices);
    state.projection = shade_mat4_perspective(0.3f, W / (float)H, 0.5f, 50);
    CHECK_INT(shade_draw_mesh(&target, &mesh, &state, NULL), SHADE_OK);
    memcpy(whole, run_color, sizeof whole);
    CHECK_INT(make_chunks(), SHADE_OK);
    shade_clear(&target, shade_v4(0.02f, 0.02f, 0.05f, 1), 1);
    CHECK_INT(shade_draw_mesh(&target, &mesh, &state, &stats), SHADE_OK);
    CHECK(!memcmp(whole, run_color, sizeof whole[0] * W * H));
    CHECK_SAY(stats.skipped > 500, "%lld of %lld skipped", stats.skipped, stats.triangles);
}

LISTED(test_case);
void test_list(test_case *item)
{
    *test_case_next = item;
    test_case_next = &item->next;
}

int main(int argc, char **argv)
{
    int passed = 0, failed = 0;
    knot_ppm = argc > 1 ? argv[1] : NULL;
    triangle_ppm = argc > 2 ? argv[2] : NULL;
    test_now.seed = 20261121u;
    for (test_case *item = test_case_first; item; item = item->next)
        test_run_case(item, &passed, &failed);
    printf("%d passed, %d failed\n", passed, failed);
    return failed != 0;
}
