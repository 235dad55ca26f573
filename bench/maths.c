/* maths.c - vectors and matrices beside cglm and GLM: ns for each operation, many in a row.

   Arrays fit into the first-level cache; every library reads the same ones, and the results are
   compared before a time is believed.

   maths [--rounds N] [--tsv FILE] */
#include "clock.h"
#define SHADE_IMPLEMENTATION
#include "shade.h"
#include "maths_shade.c"

enum { COUNT = 128, LIBRARIES = 4, OPERATIONS = 4, MOST_ROUNDS = 101 };

typedef struct operation {
    const char *name;
    int a, b, out;          /* floats of each operand */
} operation;
static const operation operations[OPERATIONS] = {
    { "mat4 x mat4", 16, 16, 16 }, { "mat4 x vec4", 16, 4, 4 }, { "vec3 normalise", 3, 3, 3 },
    { "mat3 inverse transpose", 9, 9, 9 }
};

/* cglm asks for matrices at multiples of 32 bytes where AVX is on. */
static float *aligned(float *memory)
{
    return (float *)(void *)(((uintptr_t)(void *)memory + 63) & ~(uintptr_t)63);
}

static float memory_a[COUNT * 16 + 16], memory_b[COUNT * 16 + 16];
static float memory_out[LIBRARIES][COUNT * 16 + 16];

static maths_loop *loop_of(const maths_library *l, int op)
{
    maths_loop *loops[OPERATIONS];
    loops[0] = l->mat4_mat4;
    loops[1] = l->mat4_vec4;
    loops[2] = l->normalize;
    loops[3] = l->inverse_transpose;
    return loops[op];
}

static double worst_difference(const float *a, const float *b, int count)
{
    double worst = 0;
    for (int i = 0; i < count; i++) {
        double d = fabs((double)a[i] - (double)b[i]) / fmax(1, fabs((double)a[i]));
        if (!(d <= worst)) worst = d;
    }
    return worst;
}

static void measure(const maths_library *const *libraries, int op, int rounds, FILE *tsv)
{
    static double samples[LIBRARIES][MOST_ROUNDS];
    float *a = aligned(memory_a), *b = aligned(memory_b);
    int repeats = 400;
    double worst = 0;
    printf("| %s |", operations[op].name);
    for (int r = -1; r < rounds; r++) {
        for (int l = 0; l < LIBRARIES; l++) {
            float *out = aligned(memory_out[l]);
            double start = clock_cpu();
            if (!libraries[l]) continue;
            for (int i = 0; i < repeats; i++) {
                loop_of(libraries[l], op)(a, b, out, COUNT);
                __asm__ volatile("" ::: "memory");
            }
            if (r >= 0) samples[l][r] = (clock_cpu() - start) / repeats / COUNT;
        }
    }
    for (int l = 0; l < LIBRARIES; l++) {
        if (!libraries[l]) {
            printf(" skipped: not installed |");
            continue;
        }
        double d = worst_difference(aligned(memory_out[0]), aligned(memory_out[l]),
                                    operations[op].out * COUNT);
        double ns = clock_median(samples[l], rounds);
        if (d > worst) worst = d;
        printf(" %.2f |", ns);
        if (tsv) fprintf(tsv, "%s%.3f", l ? "\t" : "", ns);
    }
    printf(" %.1e |\n", worst);
    if (tsv) fprintf(tsv, "\t%s\n", operations[op].name);
}

int main(int argc, char **argv)
{
    const maths_library *libraries[LIBRARIES];
    int rounds = 31;
    uint32_t seed = 1;
    FILE *tsv = clock_options(argc, argv, &rounds, MOST_ROUNDS);
    libraries[0] = &maths_shade;
    libraries[1] = maths_shade_apart();
    libraries[2] = maths_cglm();
    libraries[3] = maths_glm();
    for (int i = 0; i < COUNT * 16; i++) {
        seed = seed * 1664525u + 1013904223u;
        /* a dominant diagonal in the eyes of 3 x 3 matrices keeps their inverses tame */
        aligned(memory_a)[i] = (float)(seed >> 8) / 16777216.0f + (i % 9 % 4 == 0 ? 2.0f : 0.0f);
        aligned(memory_b)[i] = (float)(seed & 0xFFFFFFu) / 16777216.0f;
    }
    clock_machine(stdout);
    printf("ns for each operation, throughput over arrays of %d, medians of %d rounds in turns.\n",
           COUNT, rounds);
    printf("\n| | shade.h, same file | shade.h, apart |");
    for (int l = 2; l < LIBRARIES; l++)
        printf(" %s |", libraries[l] ? libraries[l]->name : l == 2 ? "cglm" : "GLM");
    printf(" results differ by at most |\n|---|---|---|---|---|---|\n");
    for (int op = 0; op < OPERATIONS; op++) measure(libraries, op, rounds, tsv);
    if (tsv) fclose(tsv);
    return 0;
}
