/* main.c - the test runner.   cc -O2 -I../.. *.c -lm -o test_main

   test_main [section] [seed]     runs all sections, or one; prints N passed, N failed
   test_main --stop [section ...] runs these sections, then the others, up to the first failure
   test_main --scenes [folder]    prints the hashes of the built-in scenes as the lines of
                                  scenes.h, and writes their pictures into the folder */

/* Tiles are counted where the implementation is compiled here. */
#ifndef SHADE__IMPLEMENTED
#include "count.h"
#endif
#define SHADE_IMPLEMENTATION
#include "shade.h"

#include "test.h"
#include "canvas.h"
#include "scene.h"
#include <time.h>

#define SECTIONS(OF)                                                                               \
    OF(math) OF(matrix) OF(power) OF(light) OF(lanes) OF(vertex) OF(clip) OF(cover) OF(fragment)   \
    OF(store) OF(drive) OF(mesh) OF(texture) OF(lines) OF(shape) OF(ray) OF(resolve) OF(scene)     \
    OF(exact) OF(blocks) OF(depth) OF(recipes) OF(packets) OF(refusals) OF(shaders)                \
    OF(independent) OF(modes) OF(explain) OF(chunks) OF(reads) OF(indices) OF(camera)              \
    OF(explain_pipelines) OF(explain_more)
#define DECLARED(section) extern const test_section section##_section;
#define LISTED(section) &section##_section,

SECTIONS(DECLARED)
DECLARED(work)
static const test_section *const sections[] = {
    SECTIONS(LISTED)
#ifdef SHADE__TILE_TESTED
    LISTED(work)
#endif
};
#define SECTION_COUNT ((int)(sizeof sections / sizeof sections[0]))

struct test_run test_now;

static int is_among(const char *name, char **names, int count)
{
    for (int i = 0; i < count; i++) {
        if (!strcmp(names[i], name)) return 1;
    }
    return 0;
}

static void run_section(const test_section *section, int *passed, int *failed)
{
    for (int k = 0; k < section->count; k++) {
        test_run_case(section, &section->cases[k], passed, failed);
        if (test_now.stop && *failed) exit(1);
    }
}

static int run_until_failure(char **names, int count)
{
    int passed = 0, failed = 0;
    test_now.stop = 1;
    for (int i = 0; i < count; i++) {
        for (int s = 0; s < SECTION_COUNT; s++) {
            if (!strcmp(names[i], sections[s]->name)) run_section(sections[s], &passed, &failed);
        }
    }
    for (int s = 0; s < SECTION_COUNT; s++) {
        if (!is_among(sections[s]->name, names, count)) run_section(sections[s], &passed, &failed);
    }
    printf("%.1f seconds of processor time\n", (double)clock() / CLOCKS_PER_SEC);
    printf("%d passed, %d failed\n", passed, failed);
    return failed != 0;
}

int main(int argc, char **argv)
{
    const char *only = argc > 1 && argv[1][0] ? argv[1] : NULL;
    int passed = 0, failed = 0, found = 0;
    test_now.seed = argc > 2 ? strtoull(argv[2], NULL, 10) : 20261120u;
    if (only && !strcmp(only, "--scenes")) return scene_print(argc > 2 ? argv[2] : NULL);
    if (only && !strcmp(only, "--stop")) {
        test_now.seed = 20261120u;
        return run_until_failure(argv + 2, argc - 2);
    }
    printf("seed %llu\n", (unsigned long long)test_now.seed);
    for (int i = 0; i < SECTION_COUNT; i++) {
        if (only && strcmp(only, sections[i]->name)) continue;
        found = 1;
        run_section(sections[i], &passed, &failed);
    }
    if (!found) {
        printf("no section \"%s\"; there are:", only);
        for (int i = 0; i < SECTION_COUNT; i++) printf(" %s", sections[i]->name);
        printf("\n");
        failed = 1;
    }
    printf("%d passed, %d failed\n", passed, failed);
    return failed != 0;
}
