/* against.c - this shade.h against another revision of it, scene by scene, frames in turns.

   against NEW.so OLD.so [--rounds N] [--only TEXT] [--level 0|1|2|3]

   Fastest frames tell small gains from noise; the ratio of medians stands beside them. */
#include "clock.h"
#include <dlfcn.h>

typedef struct side {
    int (*count)(void);
    const char *(*name)(int);
    void (*open)(int, int);
    void (*draw)(void);
    unsigned long long (*hash)(void);
    void (*close)(void);
} side;

/* ISO C has no conversion from an object's pointer to a function's */
static void find(void *library, const char *name, void *function)
{
    void *symbol = dlsym(library, name);
    if (!symbol) {
        fprintf(stderr, "%s\n", dlerror());
        exit(1);
    }
    memcpy(function, &symbol, sizeof symbol);
}

static side side_of(const char *path)
{
    side s;
    void *library = dlopen(path, RTLD_NOW | RTLD_LOCAL);
    if (!library) {
        fprintf(stderr, "%s\n", dlerror());
        exit(1);
    }
    find(library, "frames_count", &s.count);
    find(library, "frames_name", &s.name);
    find(library, "frames_open", &s.open);
    find(library, "frames_draw", &s.draw);
    find(library, "frames_hash", &s.hash);
    find(library, "frames_close", &s.close);
    return s;
}

static double frame(const side *s, int frames)
{
    double start = clock_cpu();
    for (int i = 0; i < frames; i++) s->draw();
    return (clock_cpu() - start) / 1e6 / frames;
}

static void measure(const side *sides, const int *scene, int rounds, int level)
{
    enum { MOST = 1001 };
    static double ms[2][MOST];
    unsigned long long hash[2];
    int frames;
    for (int k = 0; k < 2; k++) {
        sides[k].open(scene[k], level);
        frame(&sides[k], 3);
        hash[k] = sides[k].hash();
    }
    frames = 1 + (int)(2 / frame(&sides[0], 1));    /* a turn takes 2 ms at least */
    for (int i = 0; i < rounds; i++)
        for (int k = 0; k < 2; k++) ms[k][i] = frame(&sides[k], frames);
    for (int k = 0; k < 2; k++) {
        clock_median(ms[k], rounds);
        sides[k].close();
    }
    printf("| %s | %.3f | %.3f | %.2f | %.2f | %s |\n", sides[0].name(scene[0]), ms[0][0], ms[1][0],
           ms[1][0] / ms[0][0], ms[1][rounds / 2] / ms[0][rounds / 2],
           hash[0] == hash[1] ? "the same" : "other");
    fflush(stdout);
}

int main(int argc, char **argv)
{
    side sides[2];
    int rounds = 41, level = -1, scene[2];
    const char *only = "";
    if (argc < 3) return 2;
    for (int k = 0; k < 2; k++) sides[k] = side_of(argv[1 + k]);
    for (int i = 3; i + 1 < argc; i += 2) {
        if (!strcmp(argv[i], "--rounds")) rounds = atoi(argv[i + 1]);
        if (!strcmp(argv[i], "--only")) only = argv[i + 1];
        if (!strcmp(argv[i], "--level")) level = atoi(argv[i + 1]);
    }
    rounds = rounds < 3 ? 3 : rounds > 1001 ? 1001 : rounds;
    clock_machine(stdout);
    printf("\n| scene | ms | before | times faster | by medians | bits |\n");
    printf("|---|---|---|---|---|---|\n");
    sides[1].count();
    for (scene[0] = 0; scene[0] < sides[0].count(); scene[0]++) {
        const char *name = sides[0].name(scene[0]);
        if (!strstr(name, only)) continue;
        for (scene[1] = 0; scene[1] < sides[1].count(); scene[1]++)
            if (!strcmp(name, sides[1].name(scene[1]))) measure(sides, scene, rounds, level);
    }
    return 0;
}
