/* normals.c - shade_mesh_normals on a torus of a million triangles, by each instruction set: the
   least of some rounds, and a hash of the bits.

   normals [--rounds N] */
#include "level.h"
#define SHADE_STATIC
#define SHADE_IMPLEMENTATION
#include "clock.h"
#include "shade.h"

enum { AROUND = 1000, ALONG = 500, VERTICES = AROUND * ALONG, CORNERS = 6 * VERTICES };
static float positions[3 * VERTICES];
static uint32_t indices[CORNERS];
static shade_vec3 normals[VERTICES];

static void build(void)
{
    uint32_t *to = indices;
    for (int j = 0; j < ALONG; j++) {
        for (int i = 0; i < AROUND; i++) {
            const uint32_t row = (uint32_t)(j * AROUND);
            const uint32_t next = (uint32_t)((j + 1) % ALONG * AROUND);
            const uint32_t a = (uint32_t)i, b = (uint32_t)((i + 1) % AROUND);
            const uint32_t corner[6] = { row + a, row + b, next + b, row + a, next + b, next + a };
            const float turn = 6.2831853f * (float)i / AROUND, tilt = 6.2831853f * (float)j / ALONG;
            const shade_mat4 u = shade_mat4_rotation(turn, shade_v3(0, 0, 1));
            const shade_mat4 v = shade_mat4_rotation(tilt, shade_v3(0, 1, 0));
            const shade_vec3 ring = shade_add(shade_v3(2, 0, 0),
                                              shade_mat4_transform_direction(v, shade_v3(1, 0, 0)));
            const shade_vec3 p = shade_mat4_transform_direction(u, ring);
            memcpy(positions + 3 * (row + a), &p, sizeof p);
            memcpy(to, corner, sizeof corner);
            to += 6;
        }
    }
}

static unsigned long long hash(void)
{
    unsigned long long h = 14695981039346656037u;
    const unsigned char *byte = (const unsigned char *)normals;
    for (size_t i = 0; i < sizeof normals; i++) h = (h ^ byte[i]) * 1099511628211u;
    return h;
}

int main(int argc, char **argv)
{
    const shade_mesh mesh = { .positions = positions, .vertex_count = VERTICES, .indices = indices,
                              .index_count = CORNERS };
    int rounds = argc > 2 ? atoi(argv[2]) : 9;
    build();
    for (int level = bench_best_level(); level >= 0; level--) {
        double least = 1e30;
        bench_level = level;
        for (int i = 0; i < rounds; i++) {
            const double start = clock_cpu();
            if (shade_mesh_normals(&mesh, normals)) return 1;
            if (clock_cpu() - start < least) least = clock_cpu() - start;
        }
        printf("| %s | %.1f | %016llx |\n", bench_level_name(level), least / 1e6, hash());
    }
    return 0;
}
