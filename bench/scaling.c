/* scaling.c - what a triangle and a pixel cost as meshes and pictures grow, and what threads give.

   scaling [--rounds N] [--tsv FILE] */
#include "clock.h"
#include <pthread.h>
#define SHADE_IMPLEMENTATION
#include "scenes.h"

enum { MOST_ROUNDS = 101, MOST_THREADS = 4 };

static int rounds = 15;
static FILE *tsv;

/* Median ms of processor time for a frame. */
static double frame_ms(const scene *s, const shade_target *t)
{
    static double samples[MOST_ROUNDS];
    double start = clock_cpu(), first;
    int frames;
    scene_draw(s, t);
    first = (clock_cpu() - start) / 1e6;
    frames = 1 + (int)(4 / first);
    for (int r = 0; r < rounds; r++) {
        start = clock_cpu();
        for (int i = 0; i < frames; i++) scene_draw(s, t);
        samples[r] = (clock_cpu() - start) / 1e6 / frames;
    }
    return clock_median(samples, rounds);
}

/* A knot of 50 k^2 triangles in a picture of this width, 16 : 9. */
static double knot_ms(int k, int width, shade_stats *stats)
{
    scene s = scene_dense("knot", 25 * k, k);
    shade_target t;
    double ms;
    s.width = width, s.height = width * 9 / 16;
    scene_camera(&s, shade_v3(0, 0, 9.6f), shade_v3(0, 0, 0), 0.8f);
    scene_link(&s);
    t = scene_target(&s);
    *stats = scene_draw(&s, &t);
    ms = frame_ms(&s, &t);
    free(t.color), free(t.depth), scene_free(&s);
    return ms;
}

static void triangles(void)
{
    static const int size[] = { 5, 8, 14, 20, 28, 45, 63, 100, 141 };
    printf("\nA knot, Gouraud, one point light, nothing culled, clear included: in a picture that "
           "grows with it, so that triangles stay as large as they are, and at 1280 x 720.\n\n"
           "| triangles | picture | ms | pixels passed per triangle | ns per triangle | 720p, ms | "
           "ns per triangle |\n|---|---|---|---|---|---|---|\n");
    for (size_t i = 0; i < sizeof size / sizeof *size; i++) {
        double count = 50.0 * size[i] * size[i];
        int width = (int)(3840 * sqrt(count / 1e6)) / 16 * 16;
        shade_stats own, fixed;
        double a = knot_ms(size[i], width, &own), b = knot_ms(size[i], 1280, &fixed);
        printf("| %lld | %d x %d | %.2f | %.1f | %.0f | %.2f | %.0f |\n", own.triangles, width,
               width * 9 / 16, a, (double)own.fragments / count, 1e6 * a / count, b,
               1e6 * b / count);
        if (tsv)
            fprintf(tsv, "triangles\t%.0f\t%.3f\t%.3f\n", count, 1e6 * a / count,
                    1e6 * b / count);
        fflush(stdout);
    }
}

static void pixels(void)
{
    static const int size[][2] = { { 256, 144 }, { 640, 360 }, { 1280, 720 }, { 1920, 1080 },
                                   { 2560, 1440 }, { 3840, 2160 } };
    printf("\nTwo triangles over the whole picture, clear included: flat colour, and the floor "
           "under four spotlights.\n\n"
           "| picture | flat, ms | ns per pixel | floor, ms | ns per pixel |\n"
           "|---|---|---|---|---|\n");
    for (size_t i = 0; i < sizeof size / sizeof *size; i++) {
        scene flat = scene_fill("flat", size[i][0], size[i][1]);
        scene ground = scene_floor("floor", 0.5f);
        double count = (double)size[i][0] * size[i][1], a, b;
        shade_target t;
        ground.width = size[i][0], ground.height = size[i][1];
        scene_link(&flat), scene_link(&ground);
        t = scene_target(&flat);
        a = frame_ms(&flat, &t), b = frame_ms(&ground, &t);
        printf("| %d x %d | %.2f | %.2f | %.2f | %.2f |\n", size[i][0], size[i][1], a,
               1e6 * a / count, b, 1e6 * b / count);
        if (tsv)
            fprintf(tsv, "pixels\t%.0f\t%.3f\t%.3f\n", count, 1e6 * a / count, 1e6 * b / count);
        fflush(stdout);
        free(t.color), free(t.depth), scene_free(&flat), scene_free(&ground);
    }
}

/* ---- threads: each draws the whole scene into its band of rows ---- */

typedef struct band { const scene *s; shade_target target; } band;

static void *draw_band(void *user)
{
    const band *b = (const band *)user;
    scene_draw(b->s, &b->target);
    return NULL;
}

static void draw_threads(const scene *s, const shade_target *t, int count)
{
    pthread_t thread[MOST_THREADS];
    band bands[MOST_THREADS];
    for (int k = 0; k < count; k++) {
        int top = t->height * k / count, bottom = t->height * (k + 1) / count;
        bands[k].s = s, bands[k].target = *t;
        bands[k].target.clip_y = top, bands[k].target.clip_height = bottom - top;
        bands[k].target.clip_width = t->width;
        if (k && pthread_create(&thread[k], NULL, draw_band, &bands[k])) {
            fprintf(stderr, "no thread\n");
            exit(1);
        }
    }
    draw_band(&bands[0]);
    for (int k = 1; k < count; k++) pthread_join(thread[k], NULL);
}

/* The least of the rounds: what else runs on the machine can only add to it. */
static void threads(void)
{
    scene s[3];
    s[0] = scene_floor("floor 1080p, 4 spotlights, every pixel in every cone", 1.5f);
    s[1] = scene_dense("knot of 124k triangles 720p, Gouraud", 1240, 50);
    s[2] = scene_teapot("teapot 720p, per pixel", SHADE_SHADING_PER_FRAGMENT, SHADE_CULL_NONE);
    printf("\nThreads, each with a band of rows, made and joined in every frame; wall clock, best "
           "of %d rounds in turns (the machine has %ld processors).\n\n| scene | 1 thread, ms |",
           rounds, sysconf(_SC_NPROCESSORS_ONLN));
    for (int k = 2; k <= MOST_THREADS; k++) printf(" %d threads |", k);
    printf(" same bits |\n|---|---|---|---|---|---|\n");
    for (int i = 0; i < 3; i++) {
        double best[MOST_THREADS] = { 0, 0, 0, 0 };
        shade_target one, many;
        size_t bytes = (size_t)s[i].width * (size_t)s[i].height * 4;
        int same = 1;
        scene_link(&s[i]);
        one = scene_target(&s[i]), many = scene_target(&s[i]);
        scene_draw(&s[i], &one);
        for (int r = 0; r < rounds; r++) {
            for (int k = 0; k < MOST_THREADS; k++) {
                double start = clock_wall(), ms;
                draw_threads(&s[i], &many, k + 1);
                ms = (clock_wall() - start) / 1e6;
                if (r == 0 || ms < best[k]) best[k] = ms;
                if (r) continue;
                same &= !memcmp(one.color, many.color, bytes);
                same &= !memcmp(one.depth, many.depth, bytes);
            }
        }
        printf("| %s | %.2f |", s[i].name, best[0]);
        for (int k = 1; k < MOST_THREADS; k++) printf(" %.2f x |", best[0] / best[k]);
        printf(" %s |\n", same ? "yes" : "NO");
        fflush(stdout);
        for (int k = 0; tsv && k < MOST_THREADS; k++)
            fprintf(tsv, "threads\t%d\t%.3f\t%s\n", k + 1, best[0] / best[k], s[i].name);
        free(one.color), free(one.depth), free(many.color), free(many.depth), scene_free(&s[i]);
    }
}

int main(int argc, char **argv)
{
    for (int i = 1; i + 1 < argc; i += 2) {
        if (!strcmp(argv[i], "--rounds")) rounds = atoi(argv[i + 1]);
        if (!strcmp(argv[i], "--tsv")) tsv = fopen(argv[i + 1], "w");
    }
    if (rounds < 3) rounds = 3;
    if (rounds > MOST_ROUNDS) rounds = MOST_ROUNDS;
    clock_machine();
    triangles();
    pixels();
    threads();
    if (tsv) fclose(tsv);
    return 0;
}
