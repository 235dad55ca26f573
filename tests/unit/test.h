/* test.h - a small test runner.

   A case is a function TEST(section, name) named by the property it holds; the section is the name
   of its file.  A check that fails prints its place, both values and the seed; a case that checked
   nothing counts as failed.  Random numbers start anew for each case, from the run's seed and the
   case's name, so a case gives the same numbers alone as in the whole run. */
#ifndef TEST_H
#define TEST_H

#include <ctype.h>
#include <limits.h>
#include <math.h>
#include <stdarg.h>
#include <stdint.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

/* ---- lists whose items stand where they are written: each adds itself before main runs ------- */

/* Defines a function that runs before main, with gcc, clang and Microsoft's compiler: the lowest
   order, from 101, first.  Without an order programs of mingw-w64 run a file's last one first. */
#ifdef _MSC_VER
#pragma section(".CRT$XCU", read)
#define BEFORE_MAIN(name, order)                                                                   \
    static void name(void);                                                                        \
    __declspec(allocate(".CRT$XCU")) void (*const name##_entry)(void) = name;                      \
    static void name(void)
#else
#define BEFORE_MAIN(name, order) __attribute__((constructor(order))) static void name(void)
#endif

/* LISTED(type); makes type_first, the list of a struct that ends in `struct type *next`.
   LIST(type, name, fields) adds one with these fields: items stand in the order of their lines. */
#define LISTED(type) static struct type *type##_first, **type##_next = &type##_first
#define LIST(type, name, ...)                                                                      \
    BEFORE_MAIN(type##_##name##_is_listed, 101 + __LINE__)                                         \
    {                                                                                              \
        static struct type item = { __VA_ARGS__, NULL };                                           \
        *type##_next = &item;                                                                      \
        type##_next = &item.next;                                                                  \
    }

typedef struct test_case {
    const char *section, *name;
    void (*run)(void);
    struct test_case *next;
} test_case;

/* Adds a case to the list of all. */
void test_list(test_case *item);

/* Opens a case, whose name is the property that it asserts, and lists it. */
#define TEST(section, name)                                                                        \
    static void section##__##name(void);                                                           \
    BEFORE_MAIN(section##__##name##_is_listed, 65535)                                              \
    {                                                                                              \
        static test_case item = { #section, #name, section##__##name, NULL };                      \
        test_list(&item);                                                                          \
    }                                                                                              \
    static void section##__##name(void)

/* The number of elements of an array. */
#define TEST_COUNT(array) ((int)(sizeof(array) / sizeof(array)[0]))

extern struct test_run {
    uint64_t seed, state;  /* of the run; of the generator */
    long checks, failures; /* in the case that runs */
    int skipped, stop;     /* stop: end the run at the first failure */
    const char *section, *name;
} test_now;

#define TEST_MAX_PRINTED 6 /* failures shown per case */

/* Loops that only try other numbers run TEST_TIMES as many rounds in scripts that have the time,
   and 1 / TEST_SHARE of them under sanitizers and for coverage, which take ten times as long. */
#ifndef TEST_TIMES
#define TEST_TIMES 1
#endif
#ifndef TEST_SHARE
#define TEST_SHARE 1
#endif
static inline int test_rounds(int n) { return (n * TEST_TIMES + TEST_SHARE - 1) / TEST_SHARE; }

#if defined(__GNUC__) || defined(__clang__)
__attribute__((format(printf, 4, 5)))
#endif
static inline void
test_fail(const char *file, int line, const char *what, const char *format, ...)
{
    if (test_now.failures++ >= TEST_MAX_PRINTED) return;
    va_list arguments;
    va_start(arguments, format);
    printf("%s:%d: %s.%s: %s: ", file, line, test_now.section, test_now.name, what);
    vprintf(format, arguments);
    printf("   (seed %llu)\n", (unsigned long long)test_now.seed);
    va_end(arguments);
    if (test_now.stop) exit(1);
}

static inline void test_near(const char *file, int line, const char *what, double got, double want,
                             double within)
{
    test_now.checks++;
    if (!(fabs(got - want) <= within)) {
        test_fail(file, line, what, "got %.9g, want %.9g within %.3g", got, want, within);
    }
}

static inline void test_int(const char *file, int line, const char *what, long long got,
                            long long want)
{
    test_now.checks++;
    if (got != want) test_fail(file, line, what, "got %lld, want %lld", got, want);
}

/* Asserts that the condition holds. */
#define CHECK(condition)                                                       \
    do {                                                                       \
        test_now.checks++;                                                     \
        if (!(condition)) {                                                    \
            test_fail(__FILE__, __LINE__, #condition, "is false");             \
        }                                                                      \
    } while (0)

/* Asserts that the condition holds; where it does not, says with a printf what it was made of. */
#define CHECK_SAY(condition, ...)                                              \
    do {                                                                       \
        test_now.checks++;                                                     \
        if (!(condition)) {                                                    \
            test_fail(__FILE__, __LINE__, #condition, __VA_ARGS__);            \
        }                                                                      \
    } while (0)

/* Asserts that two numbers differ by at most `within`; a NaN is near nothing. */
#define CHECK_NEAR(got, want, within)                                          \
    test_near(__FILE__, __LINE__, #got, (double)(got), (double)(want), (double)(within))

/* Asserts that two whole numbers are equal. */
#define CHECK_INT(got, want)                                                   \
    test_int(__FILE__, __LINE__, #got, (long long)(got), (long long)(want))

/* Leaves a case out where the build has no such feature. */
static inline void test_skip(const char *why)
{
    test_now.skipped = 1;
    printf("%s.%s: left out: %s\n", test_now.section, test_now.name, why);
}

/* malloc, or the end of the run. */
static inline void *test_memory(size_t bytes)
{
    void *memory = malloc(bytes);
    if (!memory) {
        printf("out of memory\n");
        exit(2);
    }
    return memory;
}

/* ------------------------------------------------------------------------------- random numbers */

/* 64 random bits, by splitmix64. */
static inline uint64_t rnd_bits(void)
{
    uint64_t z = test_now.state += 0x9E3779B97F4A7C15u;
    z = (z ^ (z >> 30)) * 0xBF58476D1CE4E5B9u;
    z = (z ^ (z >> 27)) * 0x94D049BB133111EBu;
    return z ^ (z >> 31);
}

/* A double of [0, 1): 53 random bits. */
static inline double rnd_unit(void) { return (double)(rnd_bits() >> 11) / 9007199254740992.0; }
static inline float rnd_float(double lo, double hi) { return (float)(lo + (hi - lo) * rnd_unit()); }

/* A whole number of lo .. hi, both included. */
static inline int rnd_int(int lo, int hi)
{
    return lo + (int)(rnd_bits() % ((uint64_t)((int64_t)hi - lo) + 1)); /* NOLINT: lo <= hi */
}

static inline int rnd_one_in(int n) { return rnd_int(1, n) == 1; }
static inline float rnd_sign(void) { return rnd_one_in(2) ? 1.0f : -1.0f; }

/* A number of lo .. hi whose logarithm is evenly spread; lo > 0. */
static inline float rnd_log(double lo, double hi)
{
    return (float)(lo * pow(hi / lo, rnd_unit()));
}

static inline float bits_float(uint32_t u)
{
    float f;
    memcpy(&f, &u, 4);
    return f;
}

static inline uint32_t float_bits(float f)
{
    uint32_t u;
    memcpy(&u, &f, 4);
    return u;
}

/* One of the floats that break programs, or any bits, or an ordinary number. */
static inline float rnd_nasty(void)
{
    static const uint32_t pattern[] = {
        0x7FC00000u, 0xFFC00001u, 0x7F800001u, /* NaN, the last one signalling */
        0x7F800000u, 0xFF800000u,              /* infinities */
        0x7F7FFFFFu, 0xFF7FFFFFu,              /* the greatest floats */
        0x00000001u, 0x80000001u,              /* the least subnormals */
        0x00000000u, 0x80000000u,              /* zeros */
        0x00800000u,                           /* the least normal float */
        0x3F800000u, 0xBF800000u,              /* 1, -1 */
        0x7149F2CAu,                           /* 1e30 */
    };
    int k = rnd_int(0, 19);
    if (k < 15) return bits_float(pattern[k]);
    if (k < 17) return bits_float((uint32_t)rnd_bits());
    return rnd_float(-2, 2);
}

/* ----------------------------------------------------------------------------------- the runner */

static inline void test_run_case(const test_case *item, int *passed, int *failed)
{
    uint64_t hash = 14695981039346656037u;
    for (const char *c = item->name; *c; c++)
        hash = (hash ^ (uint64_t)(unsigned char)*c) * 1099511628211u;
    test_now.state = test_now.seed ^ hash;
    test_now.checks = test_now.failures = 0;
    test_now.skipped = 0;
    test_now.section = item->section;
    test_now.name = item->name;
    item->run();
    if (test_now.skipped) return;
    if (test_now.checks == 0) {
        printf("%s.%s: checked nothing\n", item->section, item->name);
        test_now.failures = 1;
    }
    if (test_now.failures > TEST_MAX_PRINTED) {
        printf("%s.%s: %ld of %ld checks failed\n", item->section, item->name, test_now.failures,
               test_now.checks);
    }
    if (test_now.failures) {
        (*failed)++;
    } else {
        (*passed)++;
    }
    fflush(stdout);
}

#endif
