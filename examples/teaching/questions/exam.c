/* exam.c - one pixel of a ball under one or two lamps: a seed draws the scene, shade.h answers.
   It writes the picture, with the pixel in a frame, and prints a row for each number of a sheet:
   its name, its values.  Vectors and lights are rounded to three digits before they are used, so
   that who computes with what is printed gets what is printed.
       ./exam SEED picture.png */
#define SHADE_STATIC
#define SHADE_NO_DISPATCH
#define SHADE_IMPLEMENTATION
#include "shade.h"
#include "drawn.h"
#include <math.h>
#include <stdio.h>

enum { WIDTH = 480, HEIGHT = 360 };
static const shade_vec3 EYE = { 0, 0, 4 };
static shade_light lamps[2];
static shade_lighting lighting = { .lights = lamps, .model = SHADE_MODEL_BLINN_PHONG };
static shade_material material;

/* ---- the scene ----------------------------------------------------------------------------- */

static shade_vec3 drawn_color(float low, float high)
{
    const float r = drawn(low, high, 0.1f), g = drawn(low, high, 0.1f);
    return shade_v3(r, g, drawn(low, high, 0.1f));
}
static void draw_scene(void)
{
    const shade_vec3 kd = drawn_color(0.2f, 0.7f);
    const float ks = drawn(0.2f, 0.6f, 0.1f);
    material.emission = shade_v3(0, 0, 0);
    material.ambient = material.diffuse = kd;
    material.specular = shade_v3(ks, ks, ks);
    material.shininess = drawn(5, 30, 5);
    lighting.ambient = shade_v3(0.1f, 0.1f, 0.1f);
    lighting.light_count = (int)drawn(1, 2, 1);
    for (int j = 0; j < lighting.light_count; j++) {
        shade_light *l = &lamps[j];
        const float x = j ? drawn(1, 3, 0.5f) : drawn(-3, -1, 0.5f), y = drawn(0.5f, 3, 0.5f);
        const shade_vec3 at = shade_v3(x, y, drawn(2, 4, 0.5f));
        *l = shade_point_light(at, drawn_color(0.6f, 1.4f));
        l->ambient = shade_v3(0, 0, 0);
        l->constant = 1;
        l->linear = drawn(0, 0.3f, 0.1f);
        l->quadratic = drawn(0.02f, 0.1f, 0.02f);
        if (j == 0) continue; /* the second is a spotlight toward the middle of the ball */
        l->spot_direction = shade_neg(at);
        l->spot_exponent = drawn(1, 8, 1);
        l->spot_cos_cutoff = drawn(0.95f, 0.99f, 0.01f);
    }
}

/* ---- the picture --------------------------------------------------------------------------- */

/* Where a pixel sees the ball: 0 beside it. */
static int seen(int i, int j, shade_vec3 *point)
{
    const shade_mat4 view = shade_mat4_look_at(EYE, shade_v3(0, 0, 0), shade_v3(0, 1, 0));
    const shade_mat4 projection =
        shade_mat4_perspective(shade_radians(36), (float)WIDTH / HEIGHT, 1, 10);
    const shade_ray ray =
        shade_pixel_ray(view, projection, WIDTH, HEIGHT, (float)i + 0.5f, (float)j + 0.5f);
    const shade_vec3 d = shade_normalize(ray.direction);
    const float b = shade_dot(EYE, d), c = shade_dot(EYE, EYE) - 1, square = b * b - c;
    if (square <= 0) return 0;
    *point = shade_madd(EYE, -b - sqrtf(square), d);
    return 1;
}
static uint32_t code(shade_vec3 light)
{
    const shade_vec3 s = shade_srgb_from_linear(light);
    return (uint32_t)(255 * s.x + 0.5f) | (uint32_t)(255 * s.y + 0.5f) << 8 |
           (uint32_t)(255 * s.z + 0.5f) << 16 | 0xFF000000u;
}
static int write_picture(const char *path, int at_i, int at_j)
{
    static uint32_t pixels[HEIGHT][WIDTH];
    const shade_target target = { .width = WIDTH, .height = HEIGHT, .color = pixels };
    for (int j = 0; j < HEIGHT; j++)
        for (int i = 0; i < WIDTH; i++) {
            shade_vec3 P;
            pixels[j][i] =
                seen(i, j, &P) ? code(shade_lit(&lighting, &material, EYE, P, P)) : 0xFFFFFFFFu;
        }
    for (int k = -6; k <= 6; k++) /* a white frame in a black one, the pixel in its middle */
        for (int side = 0; side < 4; side++)
            for (int ring = 5; ring <= 6; ring++) {
                const int x = side == 0 ? -ring : side == 1 ? ring : k;
                const int y = side == 2 ? -ring : side == 3 ? ring : k;
                if (k < -ring || k > ring) continue;
                pixels[at_j + y][at_i + x] = ring == 5 ? 0xFFFFFFFFu : 0xFF000000u;
            }
    return shade_write_png(path, &target) == SHADE_OK;
}

/* ---- the numbers --------------------------------------------------------------------------- */

static float digits(float x) { return floorf(1000 * x + 0.5f) / 1000; }
static shade_vec3 digits3(shade_vec3 v) { return shade_v3(digits(v.x), digits(v.y), digits(v.z)); }
static void row(const char *name, float x) { printf("%s %.9g\n", name, (double)x); }
static void row3(const char *name, shade_vec3 v)
{
    printf("%s %.9g %.9g %.9g\n", name, (double)v.x, (double)v.y, (double)v.z);
}
static void print_lamp(int j, shade_vec3 P, shade_vec3 N, shade_vec3 V)
{
    const shade_light *l = &lamps[j];
    const shade_vec3 at = shade_v3(l->position.x, l->position.y, l->position.z);
    const shade_vec3 to = shade_sub(at, P), L = shade_normalize(to);
    const shade_vec3 H = shade_halfway(L, V);
    const float r = shade_length(to), NL = shade_dot(N, L), NH = shade_dot(N, H);
    const float f = shade_attenuation(l->constant, l->linear, l->quadratic, r);
    const float cone =
        j ? shade_spot(L, l->spot_direction, l->spot_cos_cutoff, l->spot_exponent) : 1;
    shade_lighting one = lighting;
    shade_terms own;
    one.lights = l;
    one.light_count = 1;
    own = shade_evaluate(&one, &material, EYE, P, N);
    printf("lamp %d\n", j + 1);
    row3("place", at);
    row3("light", l->diffuse);
    row("a", l->constant);
    row("b", l->linear);
    row("c", l->quadratic);
    if (j) {
        row3("S", shade_neg(shade_normalize(l->spot_direction)));
        row("e", l->spot_exponent);
        row("cosbeta", l->spot_cos_cutoff);
        row("LS", -shade_dot(L, shade_normalize(l->spot_direction)));
    }
    row("r", r);
    row3("L", L);
    row("NL", NL);
    row("f", f);
    if (j) row("cone", cone);
    row3("H", H);
    row("NH", NH);
    row("power", shade_power(NH, material.shininess));
    row3("diffuse", own.diffuse);
    row3("specular", own.specular);
}

int main(int count, char **words)
{
    shade_vec3 P, N, V;
    int i, j;
    if (count != 3) {
        fprintf(stderr, "usage: exam SEED picture.png\n");
        return 2;
    }
    drawn_seed(words[1]);
    draw_scene();
    do { /* a pixel that the first lamp lights, within its highlight */
        i = (int)drawn(60, WIDTH - 60, 1);
        j = (int)drawn(40, HEIGHT - 40, 1);
    } while (!seen(i, j, &P) ||
             shade_blinn_phong_specular(
                 P,
                 shade_normalize(shade_sub(
                     shade_v3(lamps[0].position.x, lamps[0].position.y, lamps[0].position.z), P)),
                 shade_normalize(shade_sub(EYE, P)), material.shininess) < 0.02f);
    if (!write_picture(words[2], i, j)) return 1;
    P = digits3(P);
    N = shade_normalize(P);
    V = shade_normalize(shade_sub(EYE, P));
    printf("pixel %d %d\n", i, j);
    row3("E", EYE);
    row3("P", P);
    row3("kd", material.diffuse);
    row3("ks", material.specular);
    row("n", material.shininess);
    row3("Ia", lighting.ambient);
    row3("N", N);
    row3("V", V);
    row3("ambient", shade_mul(material.ambient, lighting.ambient));
    for (int k = 0; k < lighting.light_count; k++) print_lamp(k, P, N, V);
    printf("sum\n");
    row3("I", shade_lit(&lighting, &material, EYE, P, N));
    return 0;
}
