/* level.h - before shade.h: the instruction set of its loops, chosen at run time by a program of
   bench/.  0 SSE2, 1 SSE4.1, 2 AVX2, 3 AVX-512; below 0: what shade.h chooses by itself. */
#ifndef BENCH_LEVEL_H
#define BENCH_LEVEL_H

static int bench_level = -1;

#if defined(__x86_64__) && (defined(__GNUC__) || defined(__clang__)) && !defined(SHADE_NO_DISPATCH)
#define BENCH_HAS_LEVELS 1
static inline int bench_best_level(void)
{
    if (__builtin_cpu_supports("avx512vl") && __builtin_cpu_supports("avx512bw") &&
        __builtin_cpu_supports("avx512dq")) return 3;
    return __builtin_cpu_supports("avx2") ? 2 : __builtin_cpu_supports("sse4.1") ? 1 : 0;
}
static inline int bench_level_now(void)
{
    return bench_level < 0 ? bench_best_level() : bench_level;
}
/* A shade.h of 1.3 or before has no build for SSE4.1 and runs that for SSE2 there. */
#ifdef BENCH_WITHOUT_SSE41
#define SHADE__LEVEL (bench_level_now() > 0 ? bench_level_now() - 1 : 0)
#else
#define SHADE__LEVEL bench_level_now()
#endif
#else
#define BENCH_HAS_LEVELS 0
static inline int bench_best_level(void) { return 0; }
#endif

static inline const char *bench_level_name(int level)
{
    static const char *const name[] = { "SSE2", "SSE4.1", "AVX2", "AVX-512" };
    return BENCH_HAS_LEVELS ? name[level < 0 ? bench_best_level() : level] : "as compiled";
}
#endif
