/* kernel.c - shade_lit_lanes alone: ns per pixel and light, on each instruction set, beside a plain
   loop over pixels with powf and sqrtf.

   kernel [--rounds N] [--tsv FILE] */
#include "clock.h"
#include "level.h"
#define SHADE_IMPLEMENTATION
#include "shade.h"

enum { PIXELS = 1024, MOST_LIGHTS = 16, MOST_ROUNDS = 101 };
enum { PACKETS = PIXELS / SHADE_LANES };

/* ---- the yardstick: the same equation as most people write it ---- */

typedef struct vec { float x, y, z; } vec;
typedef struct lamp {
    vec at, diffuse, specular, aim;
    float w, a, b, c, exponent, cos_cutoff;
    int spot;
} lamp;
typedef struct surface { vec base, diffuse, specular; float shininess; int model; } surface;

static inline vec add(vec a, vec b) { return (vec){ a.x + b.x, a.y + b.y, a.z + b.z }; }
static inline vec sub(vec a, vec b) { return (vec){ a.x - b.x, a.y - b.y, a.z - b.z }; }
static inline vec times(vec a, vec b) { return (vec){ a.x * b.x, a.y * b.y, a.z * b.z }; }
static inline vec scale(vec a, float s) { return (vec){ a.x * s, a.y * s, a.z * s }; }
static inline float dot(vec a, vec b) { return a.x * b.x + a.y * b.y + a.z * b.z; }
static inline vec unit(vec a) { return scale(a, 1 / sqrtf(dot(a, a))); }

static vec plain_lit(const lamp *lamps, int count, const surface *s, vec P, vec N, vec eye)
{
    vec V = unit(sub(eye, P)), sum = s->base;
    N = unit(N);
    for (int j = 0; j < count; j++) {
        const lamp *l = &lamps[j];
        vec L = l->at, H;
        float att = 1, nl, gloss = 0;
        if (l->w != 0) {
            float r;
            L = sub(l->at, P);
            r = sqrtf(dot(L, L));
            L = scale(L, 1 / r);
            att = 1 / (l->a + l->b * r + l->c * r * r);
        }
        if (l->spot) {
            float cosine = dot(L, l->aim);
            if (cosine < l->cos_cutoff) continue;
            att *= powf(cosine, l->exponent);
        }
        nl = dot(N, L);
        if (nl <= 0) continue;
        if (s->model == SHADE_MODEL_BLINN_PHONG) {
            H = unit(add(L, V));
            gloss = powf(fmaxf(dot(N, H), 0), s->shininess);
        } else if (s->model == SHADE_MODEL_PHONG)
            gloss = powf(fmaxf(dot(sub(scale(N, 2 * nl), L), V), 0), s->shininess);
        sum = add(sum, scale(times(s->diffuse, l->diffuse), att * nl));
        sum = add(sum, scale(times(s->specular, l->specular), att * gloss));
    }
    return sum;
}

/* ---- the pixels: a cap of a sphere whose every point sees every light ---- */

static float points[PACKETS][3][SHADE_LANES], normals[PACKETS][3][SHADE_LANES];
static float out_lanes[PACKETS][3][SHADE_LANES], out_plain[PACKETS][3][SHADE_LANES];
static const shade_vec3 eye = { 0.5f, 0.3f, 6 };

typedef enum light_kind { DIRECTIONAL, POINT, SPOT, LIGHT_KINDS } light_kind;
typedef struct job {
    shade_light lights[MOST_LIGHTS];
    lamp lamps[MOST_LIGHTS];
    shade_lighting lighting;
    shade_material material;
    surface plain;
} job;

static void make_pixels(void)
{
    for (int i = 0; i < PIXELS; i++) {
        float x = ((float)(i % 32) - 15.5f) / 24, y = ((float)(i / 32) - 15.5f) / 24;
        float z = sqrtf(2 - x * x - y * y);
        float n[3] = { x, y, z };
        for (int k = 0; k < 3; k++) {
            points[i / SHADE_LANES][k][i % SHADE_LANES] = n[k];
            normals[i / SHADE_LANES][k][i % SHADE_LANES] = n[k];
        }
    }
}

static vec plain(shade_vec3 v) { return (vec){ v.x, v.y, v.z }; }

static void make_job(job *j, shade_model model, light_kind kind, int count)
{
    memset(j, 0, sizeof *j);
    j->material = shade_preset_material(SHADE_PRESET_GOLD);
    for (int i = 0; i < count; i++) {
        float x = (float)(i % 4) - 1.5f, y = (float)(i / 4 % 4) - 1.5f;
        shade_vec3 at = shade_v3(x, y, 7), color = shade_v3(0.3f + 0.1f * x, 0.4f, 0.3f - 0.1f * y);
        shade_light l = shade_spot_light(at, shade_v3(-0.1f * x, -0.1f * y, -1), 0.8f, 6, color);
        lamp *p = &j->lamps[i];
        if (kind == DIRECTIONAL) l = shade_directional_light(shade_neg(at), color);
        if (kind == POINT) l = shade_point_light(at, color);
        if (kind != DIRECTIONAL) {
            l.constant = 0.5f;
            l.linear = 0.1f;
            l.quadratic = 0.02f;
        }
        j->lights[i] = l;
        p->at = kind == DIRECTIONAL ? unit(plain(at)) : plain(at);
        p->w = l.position.w;
        p->diffuse = plain(l.diffuse);
        p->specular = plain(l.specular);
        p->a = l.constant;
        p->b = l.linear;
        p->c = l.quadratic;
        p->spot = kind == SPOT;
        if (kind == SPOT) {
            p->aim = scale(unit(plain(l.spot_direction)), -1);
            p->exponent = l.spot_exponent;
            p->cos_cutoff = l.spot_cos_cutoff;
        }
    }
    j->lighting.lights = j->lights;
    j->lighting.light_count = count;
    j->lighting.ambient = shade_v3(0.2f, 0.2f, 0.2f);
    j->lighting.model = model;
    j->plain.base = plain(shade_scale(j->material.ambient, 0.2f));
    j->plain.diffuse = plain(j->material.diffuse);
    j->plain.specular = plain(j->material.specular);
    j->plain.shininess = j->material.shininess;
    j->plain.model = (int)model;
}

static void run_lanes(const job *j)
{
    for (int p = 0; p < PACKETS; p++) {
        const shade_rows rows = { .position = points[p][0], .normal = normals[p][0] };
        shade_lit_lanes(&j->lighting, &j->material, eye, &rows, out_lanes[p][0]);
    }
}

static void run_plain(const job *j)
{
    for (int p = 0; p < PACKETS; p++) {
        for (int i = 0; i < SHADE_LANES; i++) {
            vec P = { points[p][0][i], points[p][1][i], points[p][2][i] };
            vec N = { normals[p][0][i], normals[p][1][i], normals[p][2][i] };
            vec c = plain_lit(j->lamps, j->lighting.light_count, &j->plain, P, N, plain(eye));
            out_plain[p][0][i] = c.x;
            out_plain[p][1][i] = c.y;
            out_plain[p][2][i] = c.z;
        }
    }
}

static double worst_difference(void)
{
    const float *a = &out_lanes[0][0][0], *b = &out_plain[0][0][0];
    double worst = 0;
    for (int i = 0; i < 3 * PIXELS; i++) {
        double d = fabs((double)a[i] - (double)b[i]);
        if (!(d <= worst)) worst = d;
    }
    return worst;
}

/* ---- timing: way 0 is the plain loop, 1 .. 3 are SSE2, AVX2 and AVX-512; light has no loops of
   its own for SSE4.1 ---- */

enum { WAYS = 4 };
static int rounds = 21;

static int way_level(int way) { return way > 1 ? way : 0; }

static double once(const job *j, int way, int repeats)
{
    double start;
    bench_level = way_level(way);
    start = clock_cpu();
    for (int i = 0; i < repeats; i++) {
        if (way) run_lanes(j);
        else run_plain(j);
    }
    return (clock_cpu() - start) / repeats / PIXELS;
}

/* ns a pixel for each way, 0 where there is none; stops the program if the results differ */
static void measure(const job *j, double ns[WAYS])
{
    static double samples[WAYS][MOST_ROUNDS];
    int repeats[WAYS], ways = bench_best_level() > 1 ? 1 + bench_best_level() : 2;
    int has_plain = j->lighting.model <= SHADE_MODEL_LAMBERT;
    for (int w = 0; w < ways; w++) {
        double one = once(j, w, 3) * PIXELS;
        repeats[w] = 1 + (int)(1e6 / one);
        if (has_plain && w && worst_difference() > 2e-4) {
            fprintf(stderr, "results differ by %g\n", worst_difference());
            exit(1);
        }
    }
    for (int r = 0; r < rounds; r++)
        for (int w = 0; w < ways; w++) samples[w][r] = once(j, w, repeats[w]);
    for (int w = 0; w < WAYS; w++)
        ns[w] = w < ways && (w || has_plain) ? clock_median(samples[w], rounds) : 0;
}

static int has_way(int way)
{
    return way < 2 || way <= bench_best_level();
}

static const char *way_name(int way)
{
    return way ? bench_level_name(way_level(way)) : "plain loop, libm";
}

static void cell(double ns, double yardstick)
{
    if (ns <= 0) printf(" - |");
    else if (yardstick > 0) printf(" %.2f (%.1f x) |", ns, yardstick / ns);
    else printf(" %.2f |", ns);
}

static void table_lights(FILE *tsv)
{
    static const int counts[] = { 1, 2, 4, 8, 16 };
    enum { COUNTS = sizeof counts / sizeof *counts };
    static const char *const name[LIGHT_KINDS] = { "lamps at infinity", "point lights, attenuated",
                                                   "spotlights, attenuated" };
    for (int kind = 0; kind < LIGHT_KINDS; kind++) {
        double ns[COUNTS][WAYS];
        printf("\nBlinn-Phong, %s: ns per pixel and light\n\n| |", name[kind]);
        for (int i = 0; i < COUNTS; i++) {
            job j;
            make_job(&j, SHADE_MODEL_BLINN_PHONG, (light_kind)kind, counts[i]);
            measure(&j, ns[i]);
            printf(counts[i] == 1 ? " %d light |" : " %d lights |", counts[i]);
        }
        printf("\n|---|---|---|---|---|---|\n");
        for (int w = 0; w < WAYS; w++) {
            if (ns[0][w] <= 0) continue;
            printf("| %s |", way_name(w));
            for (int i = 0; i < COUNTS; i++)
                cell(ns[i][w] / counts[i], w ? ns[i][0] / counts[i] : 0);
            printf("\n");
            if (tsv && kind == POINT)
                for (int i = 0; i < COUNTS; i++)
                    fprintf(tsv, "%s\t%d\t%.4f\n", way_name(w), counts[i], ns[i][w] / counts[i]);
        }
        fflush(stdout);
    }
}

static void table_models(void)
{
    static const char *const name[] = { "Blinn-Phong", "Phong", "Lambert", "ambient alone",
                                        "emission alone", "cool to warm" };
    printf("\nEvery model, 4 attenuated point lights: ns per pixel\n\n|");
    for (int w = 0; w < WAYS; w++)
        if (has_way(w)) printf(" | %s", way_name(w));
    printf(" |\n|---|");
    for (int w = 0; w < WAYS; w++)
        if (has_way(w)) printf("---|");
    printf("\n");
    for (int m = SHADE_MODEL_BLINN_PHONG; m <= SHADE_MODEL_COOL_TO_WARM; m++) {
        job j;
        double ns[WAYS];
        make_job(&j, (shade_model)m, POINT, 4);
        measure(&j, ns);
        printf("| %s |", name[m]);
        for (int w = 0; w < WAYS; w++)
            if (has_way(w)) cell(ns[w], w ? ns[0] : 0);
        printf("\n");
        fflush(stdout);
    }
}

int main(int argc, char **argv)
{
    FILE *tsv = clock_options(argc, argv, &rounds, MOST_ROUNDS);
    make_pixels();
    clock_machine(stdout);
    printf("shade_lit_lanes in packets of %d, every light lit, medians of %d rounds in turns; in "
           "parentheses: times faster than the plain loop.\n",
           SHADE_LANES, rounds);
    table_lights(tsv);
    table_models();
    if (tsv) fclose(tsv);
    return 0;
}
