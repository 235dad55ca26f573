/* compare.c - every scene with shade.h and with a peer, the pictures compared, then timed in turns.

   compare [--rounds N] [--only TEXT] [--mesh FILE.obj] [--level 0|1|2] [--pictures DIRECTORY]
           [--tsv FILE] */
#include "clock.h"
#include "level.h"
#define SHADE_IMPLEMENTATION
#include "scenes.h"

const peer *osmesa_peer(void);

typedef struct options {
    int rounds;
    const char *only, *mesh, *pictures, *tsv;
} options;

typedef struct difference { double fraction, most; } difference;

/* Colours: pixels where a channel differs by more than 1 of 255, and the most of it.  Without
   colour: depths that differ by more than 2^-12, and the most in steps of 2^-12: on triangles a few
   pixels wide that go from near to far, snapping a vertex moves the depth that much. */
static difference compare_pictures(const shade_target *t, const uint32_t *rgba, const float *depth)
{
    difference d = { 0, 0 };
    size_t count = (size_t)t->width * (size_t)t->height, wrong = 0;
    const unsigned char *a = (const unsigned char *)t->color, *b = (const unsigned char *)rgba;
    for (size_t i = 0; i < count; i++) {
        double off = 0;
        if (!a) off = fabs((double)t->depth[i] - (double)depth[i]) * 4096;
        for (size_t k = 0; a && k < 4; k++) {
            int step = abs(a[4 * i + k] - b[4 * i + k]);
            if (step > off) off = step;
        }
        if (off > d.most) d.most = off;
        wrong += off > 1;
    }
    d.fraction = (double)wrong / (double)count;
    return d;
}

static void write_picture(const options *o, const scene *s, const shade_target *t, const char *who)
{
    char path[600];
    if (!o->pictures || !t->color) return;
    snprintf(path, sizeof path, "%s/%s %s.ppm", o->pictures, s->name, who);
    for (char *p = path + strlen(o->pictures) + 1; *p; p++)
        if (*p == ' ' || *p == ',') *p = '_';
    shade_write_ppm(path, t);
}

/* ms a frame for one turn of frames, 0: shade.h, 1: the peer, 2: memset over the same bytes */
static double turn(int who, int frames, const scene *s, const shade_target *t, const peer *p)
{
    double start = clock_cpu();
    for (int i = 0; i < frames; i++) {
        if (who == 0) scene_draw(s, t);
        if (who == 1) p->draw();
        if (who == 2) {
            size_t bytes = (size_t)t->width * (size_t)t->height * 4;
            memset(t->color, i, bytes);
            memset(t->depth, i, bytes);
            __asm__ volatile("" ::: "memory");
        }
    }
    return (clock_cpu() - start) / 1e6 / frames;
}

static void print_row(const scene *s, const double *ms, const double *ratio, const difference *d,
                      const char *skipped, long long fragments, FILE *tsv)
{
    printf("| %s | %.3g | ", s->name, ms[0]);
    if (skipped) printf("skipped: %s | | |", skipped);
    else
        printf("%.3g | %.2f | %.2g %%, at most %.3g |", ms[1], ratio[1], 100 * d->fraction,
               d->most);
    printf(" %.0f k |\n", (double)fragments / 1000);
    if (s->kind == SCENE_CLEAR)
        printf("| memset over the same bytes | %.3g (memset) | | %.2f | | |\n", ms[2], ratio[2]);
    fflush(stdout);
    if (tsv)
        fprintf(tsv, "%s\t%.4f\t%.4f\t%.3f\n", s->name, ms[0], ms[1], skipped ? 0 : ratio[1]);
}

static void measure(const options *o, const scene *s, const peer *p, const char *skipped, FILE *tsv)
{
    enum { WAYS = 3, MOST = 101 };
    static double samples[WAYS][MOST];
    double ms[WAYS] = { 0, 0, 0 }, ratio[WAYS] = { 0, 0, 0 }, against[MOST];
    difference d = { 0, 0 };
    int frames[WAYS], on[WAYS] = { 1, !skipped, s->kind == SCENE_CLEAR };
    size_t pixels = (size_t)s->width * (size_t)s->height;
    shade_target t = scene_target(s);
    shade_stats stats = scene_draw(s, &t);
    write_picture(o, s, &t, "shade");
    if (!skipped) {
        shade_target other = t;
        other.color = scene_memory(pixels, 4);
        other.depth = (float *)scene_memory(pixels, 4);
        p->load(s);
        p->draw();
        p->read((uint32_t *)other.color, other.depth);
        d = compare_pictures(&t, (const uint32_t *)other.color, other.depth);
        if (t.color) write_picture(o, s, &other, p->name);
        free(other.color);
        free(other.depth);
    }
    for (int who = 0; who < WAYS; who++) {
        if (!on[who]) continue;
        turn(who, 3, s, &t, p);
        frames[who] = 1 + (int)(8 / turn(who, 1, s, &t, p));    /* a turn takes 8 ms at least */
    }
    for (int i = 0; i < o->rounds; i++)
        for (int who = 0; who < WAYS; who++)
            if (on[who]) samples[who][i] = turn(who, frames[who], s, &t, p);
    for (int who = 1; who < WAYS; who++) {
        for (int i = 0; i < o->rounds; i++)    /* by rounds: the speed of a machine drifts */
            against[i] = samples[who][i] / samples[0][i];
        if (on[who]) ratio[who] = clock_median(against, o->rounds);
    }
    for (int who = 0; who < WAYS; who++)
        if (on[who]) ms[who] = clock_median(samples[who], o->rounds);
    if (!skipped) p->unload();
    print_row(s, ms, ratio, &d, skipped, stats.fragments, tsv);
    free(t.color);
    free(t.depth);
}

static options read_options(int argc, char **argv)
{
    options o = { 21, NULL, NULL, NULL, NULL };
    for (int i = 1; i + 1 < argc; i += 2) {
        if (!strcmp(argv[i], "--rounds")) o.rounds = atoi(argv[i + 1]);
        if (!strcmp(argv[i], "--only")) o.only = argv[i + 1];
        if (!strcmp(argv[i], "--level")) bench_level = atoi(argv[i + 1]);
        if (!strcmp(argv[i], "--mesh")) o.mesh = argv[i + 1];
        if (!strcmp(argv[i], "--pictures")) o.pictures = argv[i + 1];
        if (!strcmp(argv[i], "--tsv")) o.tsv = argv[i + 1];
    }
    if (o.rounds < 3) o.rounds = 3;
    if (o.rounds > 101) o.rounds = 101;
    return o;
}

int main(int argc, char **argv)
{
    static scene scenes[SCENE_COUNT];
    options o = read_options(argc, argv);
    const peer *p = osmesa_peer();
    const char *skipped;
    FILE *tsv;
    /* glibc reads this at start: without it the heap of llvmpipe is given back and faulted in again
       with every frame, and dense meshes take half as long again. */
    if (!getenv("MALLOC_TRIM_THRESHOLD_")) {
        setenv("MALLOC_TRIM_THRESHOLD_", "1000000000", 1);
        execvp(argv[0], argv);
    }
    tsv = o.tsv ? fopen(o.tsv, "w") : NULL;
    skipped = p->open();
    clock_machine();
    printf("One core, %s, medians of %d rounds in turns, processor time, clears included.\n\n",
           bench_level_name(bench_level), o.rounds);
    printf("| scene | shade.h, ms | %s, ms | times faster | ", p->name);
    printf("pixels that differ by more than 1/255 | pixels passed |\n");
    printf("|---|---|---|---|---|---|\n");
    scenes_build(scenes, o.mesh);
    for (int i = 0; i < SCENE_COUNT; i++) {
        if (!o.only || strstr(scenes[i].name, o.only)) measure(&o, &scenes[i], p, skipped, tsv);
        scene_free(&scenes[i]);
    }
    printf("\n");
    clock_memory();
    if (tsv) fclose(tsv);
    return 0;
}
