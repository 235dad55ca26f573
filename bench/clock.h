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

/* Two lines of Markdown: the processor, the compiler and its flags.  Makefiles and scripts hand the
   flags over as BENCH_FLAGS. */
#ifndef BENCH_FLAGS
#define BENCH_FLAGS "-O2"
#endif
static inline void clock_machine(void)
{
    char line[256] = "", *model = NULL;
    FILE *f = fopen("/proc/cpuinfo", "r");
    while (f && !model && fgets(line, sizeof line, f))
        if (!strncmp(line, "model name", 10)) model = strchr(line, ':');
    if (f) fclose(f);
    if (model) model[strcspn(model, "\n")] = 0;
    printf("Machine: %s, %ld processors online.\n", model ? model + 2 : "unknown",
           sysconf(_SC_NPROCESSORS_ONLN));
#if defined(__clang__)
    printf("Compiler: clang %d.%d, `%s`.\n", __clang_major__, __clang_minor__, BENCH_FLAGS);
#elif defined(__GNUC__)
    printf("Compiler: gcc %d.%d, `%s`.\n", __GNUC__, __GNUC_MINOR__, BENCH_FLAGS);
#endif
}
#endif
