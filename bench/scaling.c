/* scaling.c - what a triangle and a pixel cost as meshes and pictures grow; what bands, threads,
   strips, views and rays gain by chunks; beside llvmpipe with two threads where it is there.

   scaling [--rounds N] [--tsv FILE] */
#define _DEFAULT_SOURCE    /* mmap and madvise under -std=c99 */
#include "clock.h"
#include <pthread.h>
#include <sys/mman.h>
#define SHADE_IMPLEMENTATION
#include "peers/peer.h"


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
    s.width = width;
    s.height = width * 9 / 16;
    scene_camera(&s, shade_v3(0, 0, 9.6f), shade_v3(0, 0, 0), 0.8f);
    scene_link(&s);
    t = scene_target(&s);
    *stats = scene_draw(&s, &t);
    ms = frame_ms(&s, &t);
    free(t.color);
    free(t.depth);
    scene_free(&s);
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
        ground.width = size[i][0];
        ground.height = size[i][1];
        scene_link(&flat);
        scene_link(&ground);
        t = scene_target(&flat);
        a = frame_ms(&flat, &t);
        b = frame_ms(&ground, &t);
        printf("| %d x %d | %.2f | %.2f | %.2f | %.2f |\n", size[i][0], size[i][1], a,
               1e6 * a / count, b, 1e6 * b / count);
        if (tsv)
            fprintf(tsv, "pixels\t%.0f\t%.3f\t%.3f\n", count, 1e6 * a / count, 1e6 * b / count);
        fflush(stdout);
        free(t.color);
        free(t.depth);
        scene_free(&flat);
        scene_free(&ground);
    }
}

/* The median time, in ms, of a triangle in depth that has just been cleared, as in a frame: pages
   of 2 MB where huge is set and the system has them, else of the usual size.  *passed becomes its
   pixels. */
static double diagonal(const scene *s, int huge, long long *passed)
{
    static double samples[MOST_ROUNDS];
    const size_t bytes = (size_t)s->width * (size_t)s->height * sizeof(float);
    shade_stats stats = { 0 };
    shade_target t = { 0 };
    shade_pipeline p = { 0 };
    t.width = s->width;
    t.height = s->height;
    t.depth = (float *)mmap(NULL, bytes, PROT_READ | PROT_WRITE, MAP_PRIVATE | MAP_ANONYMOUS, -1,
                            0);
    if (t.depth == (float *)MAP_FAILED) exit(1);
    (void)huge;
#ifdef MADV_HUGEPAGE
    (void)madvise(t.depth, bytes, huge ? MADV_HUGEPAGE : MADV_NOHUGEPAGE);
#endif
    p.vertex = scene_vertex;
    p.uniforms = s;
    for (int r = 0; r < rounds; r++) {
        double start;
        if (shade_clear(&t, shade_v4(0, 0, 0, 0), 1) != SHADE_OK) exit(1);
        start = clock_cpu();
        if (shade_draw(&t, &p, s->indices, 3, 3, &stats) != SHADE_OK) exit(1);
        samples[r] = (clock_cpu() - start) / 1e6;
    }
    *passed = stats.fragments;
    munmap(t.depth, bytes);
    return clock_median(samples, rounds);
}

/* Diagonals of pictures of 16384 rows, depth alone: a sliver that ends in two corners, and covers
   next to nothing.  Each row of it lies on a page of its own. */
static void diagonals(void)
{
    static const int widths[] = { 64, 512, 2048, 8192, 16384 };
    printf("\nA triangle half a pixel wide, along the diagonal of a picture of 16384 rows, in "
           "depth just cleared.\n\n| width | ms, pages of 2 MB | ms, of 4 kB | pixels passed |\n"
           "|---|---|---|---|\n");
    for (size_t i = 0; i < sizeof widths / sizeof *widths; i++) {
        scene s = scene_new("diagonal", SCENE_DEPTH, widths[i], 16384);
        const float aside = 1 - 1.0f / (float)widths[i];
        double large, small;
        long long passed;
        scene_geometry(&s, 3, 3);
        scene_put(&s, 0, shade_v3(-1, -1, 0), shade_v3(0, 0, 1));
        scene_put(&s, 1, shade_v3(1, 1, 0), shade_v3(0, 0, 1));
        scene_put(&s, 2, shade_v3(aside, 1, 0), shade_v3(0, 0, 1));
        for (uint32_t k = 0; k < 3; k++) s.indices[k] = k;
        large = diagonal(&s, 1, &passed);
        small = diagonal(&s, 0, &passed);
        printf("| %d | %.3f | %.3f | %lld |\n", widths[i], large, small, passed);
        if (tsv) fprintf(tsv, "diagonals\t%d\t%.4f\t%.4f\n", widths[i], large, small);
        fflush(stdout);
        scene_free(&s);
    }
}

/* ---- meshes in chunks ---- */

/* A lit scene whose mesh can have chunks. */
typedef struct model {
    scene s;
    shade_mesh mesh;
    uint32_t *sorted;
    shade_chunk *chunks;
    int chunk_count;
    double build_ms;
} model;

enum { ORDER_OWN, ORDER_SCATTERED, ORDER_SORTED };    /* of the triangles in the list */

static void swap_triangles(uint32_t *indices, int a, int b)
{
    for (int k = 0; k < 3; k++) {
        uint32_t kept = indices[3 * a + k];
        indices[3 * a + k] = indices[3 * b + k];
        indices[3 * b + k] = kept;
    }
}

static void scatter(uint32_t *indices, int triangles)
{
    uint64_t x = 88172645463325252u;    /* xorshift64 */
    for (int i = triangles - 1; i > 0; i--) {
        x ^= x << 13;
        x ^= x >> 7;
        x ^= x << 17;
        swap_triangles(indices, i, (int)(x % (uint64_t)(i + 1)));
    }
}

static void model_open(model *m, scene s, int order)
{
    double start;
    m->s = s;
    scene_link(&m->s);
    if (order != ORDER_OWN) scatter(s.indices, s.index_count / 3);
    m->mesh = scene_mesh(&m->s);
    m->chunk_count = shade_chunk_count(s.index_count, 0);
    m->chunks = (shade_chunk *)scene_memory((size_t)m->chunk_count, sizeof *m->chunks);
    m->sorted = (uint32_t *)scene_memory((size_t)s.index_count, sizeof *m->sorted);
    start = clock_cpu();
    if (shade_mesh_chunks(&m->mesh, 0, m->chunks, m->chunk_count,
                          order == ORDER_SORTED ? m->sorted : NULL) != SHADE_OK) {
        fprintf(stderr, "%s: no chunks\n", s.name);
        exit(1);
    }
    m->build_ms = (clock_cpu() - start) / 1e6;
    if (order == ORDER_SORTED) m->mesh.indices = m->sorted;
}

static void model_chunks(model *m, int on)
{
    m->mesh.chunks = on ? m->chunks : NULL;
    m->mesh.chunk_count = on ? m->chunk_count : 0;
}

static void model_close(model *m)
{
    free(m->sorted);
    free(m->chunks);
    scene_free(&m->s);
}

static shade_stats model_draw(const model *m, const shade_target *t)
{
    shade_stats stats;
    shade_clear(t, m->s.background, 1);
    shade_draw_mesh(t, &m->mesh, &m->s.state, &stats);
    return stats;
}

static shade_target band_of(const shade_target *t, int k, int count)
{
    shade_target band = *t;
    band.clip_width = t->width;
    band.clip_y = t->height * k / count;
    band.clip_height = t->height * (k + 1) / count - band.clip_y;
    return band;
}

/* The least processor time of some draws: what else runs on the machine can only add to it. */
static double least_ms(const model *m, const shade_target *t, int times)
{
    double least = 1e30;
    for (int i = 0; i < times; i++) {
        double start = clock_cpu();
        model_draw(m, t);
        start = (clock_cpu() - start) / 1e6;
        if (start < least) least = start;
    }
    return least;
}

static double bands_ms(const model *m, const shade_target *t, int count)
{
    double sum = 0;
    for (int k = 0; k < count; k++) {
        shade_target band = band_of(t, k, count);
        sum += least_ms(m, &band, rounds / 3 + 1);
    }
    return sum;
}

/* How much work the bands of a picture are: one thread's time times the number of bands, over the
   sum of the bands timed one by one.  So much faster are that many cores whose bands are cut to
   take equally long. */
static void bands(void)
{
    static const int count[] = { 2, 4, 8, 16, 32, 64 };
    static const char *const name[] = {
        "knot of 101k triangles, its own order", "the same, scattered",
        "the same, sorted by shade_mesh_chunks", "teapot 720p, per pixel",
        "floor 1080p, 4 spotlights"
    };
    printf("\nBands: one thread's time times the number of bands, over the sum of the bands timed "
           "one by one: the speed-up of that many cores with bands that take equally long.\n\n"
           "| scene | chunks | one band, ms | 2 | 4 | 8 | 16 | 32 | 64 |\n"
           "|---|---|---|---|---|---|---|---|---|\n");
    for (int i = 0; i < 5; i++) {
        model m;
        shade_target t;
        scene s = i == 3 ? scene_teapot(name[i], SHADE_SHADING_PER_FRAGMENT, SHADE_CULL_NONE)
                : i == 4 ? scene_floor(name[i], 1.5f) : scene_dense(name[i], 1125, 45);
        model_open(&m, s, i == 1 ? ORDER_SCATTERED : i == 2 ? ORDER_SORTED : ORDER_OWN);
        t = scene_target(&m.s);
        for (int on = 0; on < 2; on++) {
            double one;
            model_chunks(&m, on);
            one = least_ms(&m, &t, rounds);
            printf("| %s | %s | %.2f |", name[i], on ? "yes" : "no", one);
            if (tsv) fprintf(tsv, "bands\t%d %d\t1\t1\n", i, on);
            for (int k = 0; k < 6; k++) {
                double speed = one * count[k] / bands_ms(&m, &t, count[k]);
                printf(" %.1f |", speed);
                if (tsv) fprintf(tsv, "bands\t%d %d\t%d\t%.3f\n", i, on, count[k], speed);
            }
            printf("\n");
            fflush(stdout);
        }
        free(t.color);
        free(t.depth);
        model_close(&m);
    }
}

/* ---- threads: bands cut by cost ---- */

typedef struct part {
    const model *m;
    shade_target band;
} part;

static void *work(void *user)
{
    const part *p = (const part *)user;
    model_draw(p->m, &p->band);
    return NULL;
}

/* Cuts the picture into bands that take equally long, by the times of 32 thin ones, as a program
   knows them from its last frame. */
static void cut(const model *m, const shade_target *t, part *parts, int count)
{
    enum { THIN = 32 };
    double sum[THIN + 1] = { 0 };
    int top = 0, thin = 0;
    for (int k = 0; k < THIN; k++) {
        shade_target band = band_of(t, k, THIN);
        sum[k + 1] = sum[k] + least_ms(m, &band, 3);
    }
    for (int k = 0; k < count; k++) {
        const double want = sum[THIN] * (k + 1) / count;
        int bottom = t->height;
        while (thin < THIN - 1 && sum[thin + 1] < want) thin++;
        if (k + 1 < count)
            bottom = (int)((thin + (want - sum[thin]) / (sum[thin + 1] - sum[thin])) * t->height /
                           THIN);
        parts[k].m = m;
        parts[k].band = *t;
        parts[k].band.clip_width = t->width;
        parts[k].band.clip_y = top;
        parts[k].band.clip_height = bottom - top;
        top = bottom;
    }
}

static double threads_ms(part *parts, int count)
{
    pthread_t thread[MOST_THREADS];
    double start = clock_wall();
    for (int k = 1; k < count; k++) {
        if (pthread_create(&thread[k], NULL, work, &parts[k])) {
            fprintf(stderr, "no thread\n");
            exit(1);
        }
    }
    work(&parts[0]);
    for (int k = 1; k < count; k++) pthread_join(thread[k], NULL);
    return (clock_wall() - start) / 1e6;
}

/* llvmpipe's frame by threads of its own, best of the rounds. */
static double peer_ms(const scene *s)
{
    const peer *p = osmesa_peer();
    double best = 1e30;
    p->load(p, s);
    for (int i = 0; i < rounds + 2; i++) {
        double start = clock_wall();
        p->draw(p);
        start = (clock_wall() - start) / 1e6;
        if (i > 1 && start < best) best = start;
    }
    p->unload(p);
    return best;
}

static void threads(void)
{
    model m[5];
    const int count = 5;
    const char *why;
    why = peer_open(osmesa_peer(), -1, 2);
    model_open(&m[0], scene_floor("floor 1080p, 4 spotlights", 1.5f), ORDER_OWN);
    model_open(&m[1], scene_dense("knot of 124k triangles", 1240, 50), ORDER_OWN);
    model_open(&m[2], scene_dense("the same, scattered", 1240, 50), ORDER_SORTED);
    model_open(&m[3], scene_teapot("teapot 720p, per pixel", SHADE_SHADING_PER_FRAGMENT,
                                   SHADE_CULL_NONE), ORDER_OWN);
    model_open(&m[4], scene_teapot("teapot 720p, Gouraud", SHADE_SHADING_PER_VERTEX,
                                   SHADE_CULL_NONE), ORDER_OWN);
    printf("\nThreads, made and joined in every frame, with chunks and bands cut by their cost; "
           "wall clock, best of %d rounds in turns (the machine has %ld processors).\n\n"
           "| scene | 1 thread, ms | 2 threads | 3 | 4 | same bits | llvmpipe, 2 threads, ms |\n"
           "|---|---|---|---|---|---|---|\n", rounds, sysconf(_SC_NPROCESSORS_ONLN));
    for (int i = 0; i < count; i++) {
        double best[MOST_THREADS] = { 1e30, 1e30, 1e30, 1e30 }, other;
        shade_target one = scene_target(&m[i].s), many = scene_target(&m[i].s);
        size_t bytes = (size_t)one.width * (size_t)one.height * 4;
        part parts[MOST_THREADS][MOST_THREADS];
        int same = 1;
        model_draw(&m[i], &one);
        model_chunks(&m[i], 1);
        for (int k = 0; k < MOST_THREADS; k++) cut(&m[i], &many, parts[k], k + 1);
        for (int r = 0; r < rounds; r++) {
            for (int k = 0; k < MOST_THREADS; k++) {
                double ms = threads_ms(parts[k], k + 1);
                if (ms < best[k]) best[k] = ms;
                same &= !memcmp(one.color, many.color, bytes);
                same &= !memcmp(one.depth, many.depth, bytes);
            }
        }
        other = why ? 0 : peer_ms(&m[i].s);
        printf("| %s | %.2f |", m[i].s.name, best[0]);
        for (int k = 1; k < MOST_THREADS; k++) printf(" %.2f x |", best[0] / best[k]);
        printf(" %s | %.2f |\n", same ? "yes" : "NO", other);
        fflush(stdout);
        free(one.color);
        free(one.depth);
        free(many.color);
        free(many.depth);
        model_close(&m[i]);
    }
    if (why) printf("\nllvmpipe left out: %s.\n", why);
}

/* ---- what is not seen ---- */

static void strips(void)
{
    model m;
    double ms[2];
    scene s = scene_dense("knot", 1125, 45);
    shade_target t;
    s.width = 320;
    s.height = 240;
    scene_camera(&s, shade_v3(0, 0, 9.6f), shade_v3(0, 0, 0), 0.8f);
    model_open(&m, s, ORDER_SORTED);
    t = scene_target(&m.s);
    for (int on = 0; on < 2; on++) {
        model_chunks(&m, on);
        ms[on] = 0;
        for (int k = 0; k < 15; k++) {
            shade_target strip = t;
            strip.row_offset = 16 * k;
            strip.row_count = 16;
            ms[on] += least_ms(&m, &strip, rounds);
        }
    }
    printf("\nThe knot of 101k triangles, 320 x 240 in 15 strips: %.1f ms, with chunks %.1f: "
           "%.1f x. Its chunks took %.0f ms to build, once.\n",
           ms[0], ms[1], ms[0] / ms[1], m.build_ms);
    free(t.color);
    free(t.depth);
    model_close(&m);
}

/* A thousand knots of 10k triangles each on a lattice; the eye stands among them. */
static double crowd_ms(model *m, const shade_target *t, int boxes, shade_stats *sum)
{
    const shade_vec3 low = { -3.8f, -3.8f, -2 }, high = { 3.8f, 3.8f, 2 };
    double start = clock_cpu();
    memset(sum, 0, sizeof *sum);
    shade_clear(t, m->s.background, 1);
    for (int i = 0; i < 1000; i++) {
        const shade_vec3 at = { (float)(8 * (i % 10) - 36), (float)(8 * (i / 10 % 10) - 36),
                                (float)(8 * (i / 100) - 36) };
        shade_draw_state state = m->s.state;
        shade_stats stats;
        state.model = shade_mat4_translation(at);
        if (boxes && !shade_box_visible(t, shade_mat4_mul(state.projection, shade_mat4_mul(
                state.view, state.model)), 0, low, high)) {
            sum->triangles += m->mesh.index_count / 3;
            sum->skipped += m->mesh.index_count / 3;
            continue;
        }
        shade_draw_mesh(t, &m->mesh, &state, &stats);
        sum->triangles += stats.triangles;
        sum->skipped += stats.skipped;
        sum->drawn += stats.drawn;
    }
    return (clock_cpu() - start) / 1e6;
}

static void crowd(void)
{
    static const char *const how[] = { "whole meshes", "chunks", "and a box around each mesh" };
    model m;
    shade_target t;
    scene s = scene_dense("crowd", 250, 20);
    scene_camera(&s, shade_v3(40, 40, 40), shade_v3(0, 10, 0), 0.28f);
    model_open(&m, s, ORDER_SORTED);
    t = scene_target(&m.s);
    printf("\nA view into a thousand meshes of 10k triangles, 720p.\n\n"
           "| | ms | triangles looked at | drawn |\n|---|---|---|---|\n");
    for (int i = 0; i < 3; i++) {
        double least = 1e30;
        shade_stats stats;
        model_chunks(&m, i > 0);
        for (int r = 0; r < 3; r++) {
            double ms = crowd_ms(&m, &t, i == 2, &stats);
            if (ms < least) least = ms;
        }
        printf("| %s | %.1f | %.2f million | %.2f million |\n", how[i], least,
               (double)(stats.triangles - stats.skipped) / 1e6, (double)stats.drawn / 1e6);
    }
    free(t.color);
    free(t.depth);
    model_close(&m);
}

static double ray_us(const model *m, int count, int *hits)
{
    double start = clock_cpu();
    *hits = 0;
    for (int i = 0; i < count; i++) {
        const float x = (float)(i * 977 % m->s.width) + 0.5f;
        const float y = (float)(i * 613 % m->s.height) + 0.5f;
        shade_ray ray = shade_pixel_ray(m->s.state.view, m->s.state.projection, m->s.width,
                                        m->s.height, x, y);
        *hits += shade_pick(&m->mesh, m->s.state.model, ray, NULL, NULL) >= 0;
    }
    return (clock_cpu() - start) / 1e3 / count;
}

static void rays(void)
{
    model m;
    shade_target t;
    double all = 1e30, some = 1e30, away;
    int hits, seen;
    model_open(&m, scene_dense("knot", 1125, 45), ORDER_SORTED);
    for (int r = 0; r < 5; r++) {
        double us;
        model_chunks(&m, 0);
        us = ray_us(&m, 20, &hits);
        if (us < all) all = us;
        model_chunks(&m, 1);
        us = ray_us(&m, 2000, &seen);
        if (us < some) some = us;
    }
    printf("\nRays through pixels against the knot of 101k triangles: %.0f a second, with chunks "
           "%.0f: %.0f x (%d %% meet it).\n", 1e6 / all, 1e6 / some, all / some, seen / 20);
    m.s.state.view = shade_mat4_look_at(shade_v3(0, 0, 9.6f), shade_v3(0, 0, 20),
                                        shade_v3(0, 1, 0));
    t = scene_target(&m.s);
    t.clip_width = 1;    /* no time for clearing */
    t.clip_height = 1;
    away = least_ms(&m, &t, 3 * rounds);
    printf("Behind the eye it takes %.2f us a thousand triangles.\n",
           1e6 * away / (m.s.index_count / 3));
    free(t.color);
    free(t.depth);
    model_close(&m);
}

int main(int argc, char **argv)
{
    tsv = clock_options(argc, argv, &rounds, MOST_ROUNDS);
    clock_machine(stdout);
    triangles();
    pixels();
    diagonals();
    bands();
    threads();
    strips();
    crowd();
    rays();
    if (tsv) fclose(tsv);
    return 0;
}
