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

struct test_run test_now;

static int is_among(const char *name, char **names, int count)
{
    for (int i = 0; i < count; i++) {
        if (!strcmp(names[i], name)) return 1;
    }
    return 0;
}

LISTED(test_case);

void test_list(test_case *item)
{
#ifndef SHADE__TILE_TESTED    /* the cases of work.c need the implementation here, which counts */
    if (!strcmp(item->section, "work")) return;
#endif
    *test_case_next = item;
    test_case_next = &item->next;
}

/* Runs the cases of a section, or all; returns how many there are. */
static int run_section(const char *section, int *passed, int *failed)
{
    int count = 0;
    for (const test_case *item = test_case_first; item; item = item->next) {
        if (section && strcmp(section, item->section)) continue;
        test_run_case(item, passed, failed);
        if (test_now.stop && *failed) exit(1);
        count++;
    }
    return count;
}

static int run_until_failure(char **names, int count)
{
    int passed = 0, failed = 0;
    test_now.stop = 1;
    for (int i = 0; i < count; i++) run_section(names[i], &passed, &failed);
    for (const test_case *item = test_case_first; item; item = item->next) {
        if (is_among(item->section, names, count)) continue;
        test_run_case(item, &passed, &failed);
        if (failed) return 1;
    }
    printf("%.1f seconds of processor time\n", (double)clock() / CLOCKS_PER_SEC);
    printf("%d passed, %d failed\n", passed, failed);
    return failed != 0;
}

int main(int argc, char **argv)
{
    const char *only = argc > 1 && argv[1][0] ? argv[1] : NULL;
    int passed = 0, failed = 0;
    test_now.seed = argc > 2 ? strtoull(argv[2], NULL, 10) : 20261120u;
    if (only && !strcmp(only, "--scenes")) return scene_print(argc > 2 ? argv[2] : NULL);
    if (only && !strcmp(only, "--stop")) {
        test_now.seed = 20261120u;
        return run_until_failure(argv + 2, argc - 2);
    }
    printf("seed %llu\n", (unsigned long long)test_now.seed);
    if (!run_section(only, &passed, &failed)) {
        const char *before = "";
        printf("no section \"%s\"; there are:", only ? only : "");
        for (const test_case *item = test_case_first; item; item = item->next) {
            if (strcmp(before, item->section)) printf(" %s", item->section);
            before = item->section;
        }
        printf("\n");
        failed = 1;
    }
    printf("%d passed, %d failed\n", passed, failed);
    return failed != 0;
}
