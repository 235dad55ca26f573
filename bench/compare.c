/* compare.c - every scene by shade.h and its peers: the pictures compared, then timed in turns.

   compare [--rounds N] [--only TEXT] [--mesh FILE.obj] [--level 0|1|2|3] [--pictures DIRECTORY]
           [--tsv FILE] */
#include "clock.h"
#include "level.h"
#define SHADE_IMPLEMENTATION
#include "peers/peer.h"

/* who draws: shade.h, the peers, and memset over the same bytes */
enum { SHADE, PEERS = 3, MEMSET = PEERS + 1, WAYS = PEERS + 2, MOST = 101 };
static peer *peers[WAYS];    /* NULL: not here */

typedef struct options {
    int rounds;
    const char *only, *mesh, *pictures, *tsv;
} options;

typedef struct difference { double fraction, most; } difference;
/* A peer that gets more pixels wrong has not drawn the scene, and is not timed.  SwiftShader rounds
   vertices to 1/16 of a pixel: 1.5 % of the smallest teapot, along its edges. */
static const double fraction_allowed = 0.02;

typedef struct row {
    double ms[WAYS], ratio[WAYS];    /* zero: not measured */
    difference d[WAYS];
    int best;                        /* a peer; 0: none */
} row;

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

/* ms a frame, for one turn of frames.  Before it the peers' threads sleep: some wait in loops. */
static double turn(int who, int frames, const scene *s, const shade_target *t)
{
    const struct timespec rest = { 0, 2000000 };
    double start;
    nanosleep(&rest, NULL);
    start = clock_cpu();
    for (int i = 0; i < frames; i++) {
        if (who == SHADE) scene_draw(s, t);
        else if (who == MEMSET) {
            size_t bytes = (size_t)t->width * (size_t)t->height * 4;
            memset(t->color, i, bytes);
            memset(t->depth, i, bytes);
            __asm__ volatile("" ::: "memory");
        } else peers[who]->draw(peers[who]);
    }
    return (clock_cpu() - start) / 1e6 / frames;
}

/* NULL: it is not there, or draws no such pictures */
static peer *peer_of(const scene *s, int who) { return s->format ? NULL : peers[who]; }

static void print_row(const scene *s, const row *r, long long fragments, FILE *tsv)
{
    printf("| %s | %.3g |", s->name, r->ms[SHADE]);
    for (int who = 1; who <= PEERS; who++) {
        if (r->ms[who] > 0) printf(" %.3g |", r->ms[who]);
        else printf(" %s |", peer_of(s, who) ? "another picture" : "-");
    }
    if (r->best) printf(" %s | %.2f |", peers[r->best]->name, r->ratio[r->best]);
    else printf(" - | - |");
    for (int who = 1; who <= PEERS; who++)
        if (peer_of(s, who))
            printf(" %.2g %% (%.3g)", 100 * r->d[who].fraction, r->d[who].most);
    printf(" | %.0f k |\n", (double)fragments / 1000);
    if (s->kind == SCENE_CLEAR)
        printf("| memset over the same bytes | %.3g | | | | | %.2f | | |\n", r->ms[MEMSET],
               r->ratio[MEMSET]);
    fflush(stdout);
    if (tsv && !s->format)
        fprintf(tsv, "%s\t%.4f\t%.4f\t%.3f\t%s\n", s->name, r->ms[SHADE], r->ms[r->best],
                r->ratio[r->best], r->best ? peers[r->best]->name : "");
}

/* The peer's picture of a scene that it has loaded, beside shade.h's. */
static difference draw_peer(const options *o, const scene *s, const shade_target *t, peer *p)
{
    size_t pixels = (size_t)s->width * (size_t)s->height;
    shade_target other = *t;
    difference d;
    other.color = scene_memory(pixels, 4);
    other.depth = (float *)scene_memory(pixels, 4);
    p->draw(p);
    p->read(p, (uint32_t *)other.color, other.depth);
    d = compare_pictures(t, (const uint32_t *)other.color, other.depth);
    if (t->color) write_picture(o, s, &other, p->name);
    free(other.color);
    free(other.depth);
    return d;
}

static void measure(const options *o, const scene *s, FILE *tsv)
{
    static double samples[WAYS][MOST];
    double against[MOST];
    int frames[WAYS], on[WAYS] = { 1 };
    shade_target t = scene_target(s);
    shade_stats stats = scene_draw(s, &t);
    row r = { 0 };
    write_picture(o, s, &t, "shade.h");
    for (int who = 1; who <= PEERS; who++) {
        if (!peer_of(s, who)) continue;
        peers[who]->load(peers[who], s);
        r.d[who] = draw_peer(o, s, &t, peers[who]);
        on[who] = r.d[who].fraction <= fraction_allowed;
    }
    on[MEMSET] = s->kind == SCENE_CLEAR;
    for (int who = 0; who < WAYS; who++) {
        if (!on[who]) continue;
        turn(who, 3, s, &t);
        frames[who] = 1 + (int)(8 / turn(who, 1, s, &t));    /* a turn takes 8 ms at least */
    }
    for (int i = 0; i < o->rounds; i++)
        for (int who = 0; who < WAYS; who++)
            if (on[who]) samples[who][i] = turn(who, frames[who], s, &t);
    for (int who = 1; who < WAYS; who++) {
        if (!on[who]) continue;
        for (int i = 0; i < o->rounds; i++)    /* by rounds: the speed of a machine drifts */
            against[i] = samples[who][i] / samples[SHADE][i];
        r.ratio[who] = clock_median(against, o->rounds);
        if (who <= PEERS && (!r.best || r.ratio[who] < r.ratio[r.best])) r.best = who;
    }
    for (int who = 0; who < WAYS; who++)
        if (on[who]) r.ms[who] = clock_median(samples[who], o->rounds);
    for (int who = 1; who <= PEERS; who++)
        if (peer_of(s, who)) peers[who]->unload(peers[who]);
    print_row(s, &r, stats.fragments, tsv);
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
    if (o.rounds > MOST) o.rounds = MOST;
    return o;
}

/* What is known of the machine and of today, as Markdown; in a table of tabs, lines without one. */
static void print_machine(FILE *f)
{
    char day[32];
    time_t now = time(NULL);
    clock_machine(f);
    for (int who = 1; who <= PEERS; who++)
        if (peers[who]) fprintf(f, "%s: %s.\n", peers[who]->name, peers[who]->about);
    strftime(day, sizeof day, "%d %B %Y", localtime(&now));
    fprintf(f, "Date: %s.\n", day);
}

int main(int argc, char **argv)
{
    static scene scenes[SCENE_COUNT];
    options o = read_options(argc, argv);
    int level = bench_level < 0 ? bench_best_level() : bench_level;
    FILE *tsv = o.tsv ? fopen(o.tsv, "w") : NULL;
    peers[1] = osmesa_peer();
    peers[2] = vulkan_peer(VULKAN_LAVAPIPE);
    peers[3] = vulkan_peer(VULKAN_SWIFTSHADER);
    for (int who = 1; who <= PEERS; who++) {
        const char *why = peer_open(peers[who], level, 1);
        if (why) fprintf(stderr, "left out: %s (%s)\n", peers[who]->name, why);
        if (why) peers[who] = NULL;
    }
    print_machine(stdout);
    if (tsv) print_machine(tsv);
    printf("One core, %s, medians of %d rounds in turns, processor time, clears included.\n\n",
           bench_level_name(bench_level), o.rounds);
    printf("| scene | shade.h, ms | llvmpipe, ms | lavapipe, ms | SwiftShader, ms | best peer | "
           "times faster | pixels of each that differ by more than 1/255 (most) | "
           "pixels passed |\n|---|---|---|---|---|---|---|---|---|\n");
    scenes_build(scenes, o.mesh);
    for (int i = 0; i < SCENE_COUNT; i++) {
        if (!o.only || strstr(scenes[i].name, o.only)) measure(&o, &scenes[i], tsv);
        scene_free(&scenes[i]);
    }
    printf("\n");
    clock_memory();
    if (tsv) fclose(tsv);
    return 0;
}
