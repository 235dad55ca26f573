/* clock.h - time and machine for the programs of bench/.  Includes come after it: it asks the C
   library for POSIX. */
#ifndef BENCH_CLOCK_H
#define BENCH_CLOCK_H

#ifndef _POSIX_C_SOURCE
#define _POSIX_C_SOURCE 200809L
#endif
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <time.h>
#include <unistd.h>

/* Nanoseconds of processor time of this process: what other programs take from a shared machine is
   not in it. */
static inline double clock_cpu(void)
{
    struct timespec t;
    clock_gettime(CLOCK_PROCESS_CPUTIME_ID, &t);
    return 1e9 * (double)t.tv_sec + (double)t.tv_nsec;
}

static inline double clock_wall(void)
{
    struct timespec t;
    clock_gettime(CLOCK_MONOTONIC, &t);
    return 1e9 * (double)t.tv_sec + (double)t.tv_nsec;
}

static inline int clock_order(const void *a, const void *b)
{
    double x = *(const double *)a, y = *(const double *)b;
    return (x > y) - (x < y);
}

/* Sorts. */
static inline double clock_median(double *v, int n)
{
    qsort(v, (size_t)n, sizeof *v, clock_order);
    return n % 2 ? v[n / 2] : (v[n / 2 - 1] + v[n / 2]) / 2;
}

/* The options of several programs: --rounds N, from 3 to most, and --tsv FILE, which is returned
   open, or NULL. */
static inline FILE *clock_options(int argc, char **argv, int *rounds, int most)
{
    FILE *tsv = NULL;
    for (int i = 1; i + 1 < argc; i += 2) {
        if (!strcmp(argv[i], "--rounds")) *rounds = atoi(argv[i + 1]);
        if (!strcmp(argv[i], "--tsv")) tsv = fopen(argv[i + 1], "w");
    }
    if (*rounds < 3) *rounds = 3;
    if (*rounds > most) *rounds = most;
    return tsv;
}

/* A line of Markdown: how fast this core fills and copies memory that no cache holds.  Large
   pictures of little arithmetic come to no more. */
static inline void clock_memory(void)
{
    enum { MEGABYTES = 256, ROUNDS = 9 };
    size_t size = (size_t)MEGABYTES << 20;
    unsigned char *block = (unsigned char *)malloc(size);
    volatile unsigned char seen = 0;
    double fills[ROUNDS], copies[ROUNDS];
    if (!block) return;
    memset(block, 1, size);
    for (int i = 0; i < ROUNDS; i++) {
        double start = clock_cpu();
        memset(block, i, size);
        seen = block[seen];
        fills[i] = clock_cpu() - start;
        start = clock_cpu();
        memcpy(block + size / 2, block, size / 2);
        seen = block[size / 2 + seen];
        copies[i] = clock_cpu() - start;
    }
    printf("Memory, one core: %d MB filled at %.1f GB/s, %d MB copied at %.1f GB/s.\n", MEGABYTES,
           (double)size / clock_median(fills, ROUNDS), MEGABYTES / 2,
           (double)size / 2 / clock_median(copies, ROUNDS));
    free(block);
}

/* Two lines of Markdown: the processor, the compiler and its flags.  Makefiles and scripts hand the
   flags over as BENCH_FLAGS. */
#ifndef BENCH_FLAGS
#define BENCH_FLAGS "-O2"
#endif
static inline void clock_machine(FILE *to)
{
    char line[256] = "", *model = NULL;
    FILE *f = fopen("/proc/cpuinfo", "r");
    while (f && !model && fgets(line, sizeof line, f))
        if (!strncmp(line, "model name", 10)) model = strchr(line, ':');
    if (f) fclose(f);
    if (model) model[strcspn(model, "\n")] = 0;
    fprintf(to, "Machine: %s, %ld processors online.\n", model ? model + 2 : "unknown",
           sysconf(_SC_NPROCESSORS_ONLN));
#if defined(__clang__)
    fprintf(to, "Compiler: clang %d.%d, `%s`.\n", __clang_major__, __clang_minor__, BENCH_FLAGS);
#elif defined(__GNUC__)
    fprintf(to, "Compiler: gcc %d.%d, `%s`.\n", __GNUC__, __GNUC_MINOR__, BENCH_FLAGS);
#endif
}
#endif
