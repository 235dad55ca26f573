/* main.c - the test runner.   cc -O2 -I. tests/unit/main.c -lm -o test_main

   test_main [section] [seed]     runs all sections, or one; prints N passed, N failed
   test_main --stop [section ...] runs these sections, then the others, up to the first failure
   test_main --scenes [folder]    prints the hashes of the built-in scenes as the lines of
                                  scenes.h, and writes their pictures into the folder */
#include <time.h>

/* Tiles are counted where the implementation is compiled here, or was with -include count.h. */
#ifndef SHADE__IMPLEMENTED
#include "count.h"
#endif
#define SHADE_IMPLEMENTATION
#include "shade.h"

#include "test.h"
#include "oracle.h"
#include "canvas.h"
#include "faults.h"
#include "meshes.h"
#include "rows.h"

#include "math.c"
#include "matrix.c"
#include "power.c"
#include "light.c"
#include "recipes.c"
#include "lanes.c"
#include "vertex.c"
#include "clip.c"
#include "cover.c"
#include "exact.c"
#include "fragment.c"
#include "packets.c"
#include "store.c"
#include "blocks.c"
#include "drive.c"
#include "mesh.c"
#include "refusals.c"
#include "texture.c"
#include "shaders.c"
#include "depth.c"
#include "lines.c"
#include "shape.c"
#include "ray.c"
#include "camera.c"
#include "chunks.c"
#include "resolve.c"
#include "independent.c"
#include "scene.c"
#include "modes.c"
#include "explain.c"
#include "explain_more.c"
#include "explain_pipelines.c"
#ifdef SHADE__TILE_TESTED
long tiles_tested;
#include "work.c"
#endif

static const test_section sections[] = {
    SECTION(math),   SECTION(matrix),  SECTION(power),   SECTION(light),    SECTION(lanes),
    SECTION(vertex), SECTION(clip),    SECTION(cover),   SECTION(fragment), SECTION(store),
    SECTION(drive),  SECTION(mesh),    SECTION(texture), SECTION(lines),    SECTION(shape),
    SECTION(ray),    SECTION(resolve), SECTION(scene),   SECTION(exact),    SECTION(blocks),
    SECTION(depth),  SECTION(recipes),  SECTION(packets), SECTION(refusals),    SECTION(shaders),
    SECTION(independent),  SECTION(modes),   SECTION(explain), SECTION(chunks),
    SECTION(camera),  SECTION(explain_pipelines), SECTION(explain_more),
#ifdef SHADE__TILE_TESTED
    SECTION(work),
#endif
};
#define SECTION_COUNT ((int)(sizeof sections / sizeof sections[0]))

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
            if (!strcmp(names[i], sections[s].name)) run_section(&sections[s], &passed, &failed);
        }
    }
    for (int s = 0; s < SECTION_COUNT; s++) {
        if (!is_among(sections[s].name, names, count)) run_section(&sections[s], &passed, &failed);
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
        if (only && strcmp(only, sections[i].name)) continue;
        found = 1;
        run_section(&sections[i], &passed, &failed);
    }
    if (!found) {
        printf("no section \"%s\"; there are:", only);
        for (int i = 0; i < SECTION_COUNT; i++) printf(" %s", sections[i].name);
        printf("\n");
        failed = 1;
    }
    printf("%d passed, %d failed\n", passed, failed);
    return failed != 0;
}
