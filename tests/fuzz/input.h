/* input.h - what the fuzz targets share: an input read as a stream of choices, and memory that ends
   at pages without access.

   Past its end an input gives zeros, so every prefix of an input is an input.  A property that does
   not hold aborts, which every fuzzer takes for a crash. */
#ifndef FUZZ_INPUT_H
#define FUZZ_INPUT_H
#ifndef _DEFAULT_SOURCE
#define _DEFAULT_SOURCE                  /* MAP_ANONYMOUS under -std=c99 */
#endif

#include "shade.h"
#include <limits.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <sys/mman.h>
#include <unistd.h>

int LLVMFuzzerTestOneInput(const uint8_t *data, size_t size);

/* vector width of the hot loops, see SHADE__LEVEL; shade.c reads it */
int fuzz_level;
/* hash of what an input left in memory; shade.c prints it */
uint64_t fuzz_bits;

#define HOLDS(x) ((x) ? (void)0 : fuzz_fail(#x, __FILE__, __LINE__))
static inline void fuzz_fail(const char *what, const char *file, int line)
{
    fprintf(stderr, "%s:%d: does not hold: %s\n", file, line, what);
    abort();
}

/* ---- choices -------------------------------------------------------------------------------- */

typedef struct fuzz_input { const uint8_t *at, *end; } fuzz_input;

static inline uint32_t fuzz_byte(fuzz_input *in) { return in->at < in->end ? *in->at++ : 0; }

static inline uint32_t fuzz_word(fuzz_input *in)
{
    uint32_t w = fuzz_byte(in);
    w |= fuzz_byte(in) << 8;
    w |= fuzz_byte(in) << 16;
    return w | fuzz_byte(in) << 24;
}

/* One in n, n <= 256; a zero byte says no. */
static inline int fuzz_one_in(fuzz_input *in, uint32_t n) { return fuzz_byte(in) % n == n - 1; }

/* lo .. hi; a zero byte gives lo */
static inline int fuzz_int(fuzz_input *in, int lo, int hi)
{
    uint32_t range = (uint32_t)hi - (uint32_t)lo + 1, bits = fuzz_byte(in);
    if (range > 256) bits |= fuzz_byte(in) << 8;
    return lo + (int)(bits % range);
}

/* Values at which integer arithmetic ends, or any. */
static inline int fuzz_wild_int(fuzz_input *in)
{
    static const int edge[] = { 0, 1, -1, 2, 3, 7, -3, INT_MAX, INT_MIN, INT_MAX - 1, INT_MIN + 1,
                                16384, 16385, 65536, INT_MAX / 2, INT_MAX / 3, INT_MAX / 3 + 1,
                                INT_MAX / 4, INT_MAX / 16, -16384, 40, 20 };
    uint32_t k = fuzz_byte(in), count = sizeof edge / sizeof edge[0], bits;
    int value;
    if (k < 224) return edge[k % count];
    bits = fuzz_word(in);
    memcpy(&value, &bits, sizeof value);
    return value;
}

/* 0 .. count - 1, seldom anything else; enums carry it as int.  *bad says so. */
static inline int fuzz_enum(fuzz_input *in, int count, int *bad)
{
    uint32_t k = fuzz_byte(in);
    int value = (int)k % count;
    if (k >= 250) value = k == 255 ? fuzz_wild_int(in) : k == 254 ? count : (int)(k - 250) + count;
    *bad |= value < 0 || value >= count;
    return value;
}

/* Its enumerators */
static inline void fuzz_raster(fuzz_input *in, shade_raster *r, int *bad)
{
    r->cull = (shade_cull)fuzz_enum(in, 3, bad);
    r->depth_test = (shade_compare)fuzz_enum(in, 6, bad);
    r->blend = (shade_blend)fuzz_enum(in, SHADE_BLEND_ADD + 1, bad);
}

static inline float fuzz_float_of(uint32_t bits)
{
    float f;
    memcpy(&f, &bits, 4);
    return f;
}

/* Small multiples of 1/16; values at which arithmetic ends; any bits; or even in the logarithm. */
static inline float fuzz_float(fuzz_input *in)
{
    static const uint32_t edge[] = {
        0x7FC00000u, 0xFFC00001u, 0x7F800001u, 0x7F800000u, 0xFF800000u, 0x7F7FFFFFu, 0xFF7FFFFFu,
        0x00000001u, 0x80000001u, 0x80000000u, 0x00800000u, 0x007FFFFFu, 0x3F7FFFFFu, 0x3F800001u,
        0x7149F2CAu, 0x7149F2CBu, 0xF149F2CAu, 0x4B800000u, 0x4B7FFFFFu, 0xCB000000u, 0x4F000000u,
        0xCF000000u, 0x5F000000u, 0x0DA24260u, 0x2B8CBCCCu, 0x5368D4A5u, 0x49742400u, 0x33800000u,
        0x3F000000u, 0x40400000u, 0x1E3CE508u, 0x60AD78ECu };
    uint32_t k = fuzz_byte(in), bits;
    if (k < 128) return (float)((int)((k + 16) % 128) - 16) / 16;    /* -1 .. 7, 0 first */
    if (k < 192) return (float)((int)k - 160) / 16;                  /* -2 .. 2 */
    if (k < 216) return fuzz_float_of(edge[fuzz_byte(in) % 32]);
    if (k < 232) return fuzz_float_of(fuzz_word(in));
    bits = fuzz_byte(in) << 15;
    bits |= fuzz_byte(in) << 7;
    return fuzz_float_of((k & 1) << 31 | (96 + 4 * (k - 232)) << 23 | bits);
}

/* finite, at most most in magnitude */
static inline float fuzz_tame(fuzz_input *in, float most)
{
    float f = fuzz_float(in);
    if (!(f >= -most)) return f < 0 ? -most : 1;
    return f <= most ? f : most;
}

static inline float fuzz_value(fuzz_input *in, float most)    /* most 0: any float at all */
{
    return most > 0 ? fuzz_tame(in, most) : fuzz_float(in);
}

static inline shade_vec3 fuzz_vec3(fuzz_input *in, float most)
{
    float x = fuzz_value(in, most), y = fuzz_value(in, most);
    return shade_v3(x, y, fuzz_value(in, most));
}

static inline shade_vec4 fuzz_vec4(fuzz_input *in, float most)
{
    float x = fuzz_value(in, most), y = fuzz_value(in, most), z = fuzz_value(in, most);
    return shade_v4(x, y, z, fuzz_value(in, most));
}

/* The matrix that stands for a camera that there is none of: every point goes to (0, 0, 2, 1). */
static inline int fuzz_is_no_camera(shade_mat4 m)
{
    const float *f = &m.col[0].x;
    for (int k = 0; k < 16; k++)
        if (f[k] != (k == 14 ? 2 : k == 15 ? 1 : 0)) return 0;
    return 1;
}

/* A camera of four to six numbers, which is none where they do not fulfil what they must; its
   entries are bounded as they are. */
static inline shade_mat4 fuzz_camera(fuzz_input *in, float most)
{
    uint32_t kind = fuzz_byte(in);
    shade_mat4 m;
    float x = fuzz_value(in, most), y = fuzz_value(in, most), z = fuzz_value(in, most);
    float a = fuzz_value(in, most), b, c;
    int good = x > 0 && x < 3.1415927f && y != 0 && z > 0; /* the float above pi */
    if (kind % 4 == 0) {
        m = shade_mat4_perspective(x, y, z, a);
        good = good && a > 0 && z != a;
    } else if (kind % 4 == 1) {
        m = shade_mat4_perspective_reversed(x, y, z);
    } else {
        b = fuzz_value(in, most);
        c = fuzz_value(in, most);
        good = x != y && z != a && b != c;
        if (kind % 4 == 3) {
            m = shade_mat4_ortho(x, y, z, a, b, c);
        } else {
            m = shade_mat4_frustum(x, y, z, a, b, c);
            good = good && b > 0 && c > 0;
        }
    }
    HOLDS(good || fuzz_is_no_camera(m));
    for (int k = 0; k < 16; k++) good &= (&m.col[0].x)[k] >= -most && (&m.col[0].x)[k] <= most;
    return good || !(most > 0) ? m : shade_mat4_ortho(1, 1, 1, 1, 1, 1);
}

/* zero, the usual cameras, turned and stretched axes, any camera, or sixteen floats */
static inline shade_mat4 fuzz_matrix(fuzz_input *in, float most)
{
    shade_vec3 a, b;
    shade_mat4 m = { 0 };
    switch (fuzz_byte(in) % 13) {
    case 1: case 2: return shade_mat4_perspective(1, 1.25f, 0.5f, 20);
    case 3: return shade_mat4_look_at(shade_v3(0, 1, 4), shade_v3(0, 0, 0), shade_v3(0, 1, 0));
    case 4: a = fuzz_vec3(in, most); return shade_mat4_translation(a);
    case 5: a = fuzz_vec3(in, most); return shade_mat4_scaling(a);
    case 6: a = fuzz_vec3(in, most); return shade_mat4_rotation(fuzz_value(in, most), a);
    case 7: return shade_mat4_perspective_reversed(1, 1.25f, 0.5f);
    case 8: return shade_mat4_ortho(-2, 2, -2, 2, -2, 8);
    case 9:
        a = fuzz_vec3(in, most);
        b = fuzz_vec3(in, most);
        return shade_mat4_look_at(a, b, fuzz_vec3(in, most));
    case 10:
        for (int k = 0; k < 4; k++) m.col[k] = fuzz_vec4(in, most);
        break;
    case 11: return shade_mat4_identity();
    case 12: return fuzz_camera(in, most);
    default: break;
    }
    return m;
}

static inline int fuzz_is_nan(float f) { return f != f; }
static inline int fuzz_finite(float f) { return f >= -FLT_MAX && f <= FLT_MAX; }

static inline int fuzz_finite3(shade_vec3 v)
{
    return fuzz_finite(v.x) && fuzz_finite(v.y) && fuzz_finite(v.z);
}

/* The same bits; a NaN may be any NaN. */
static inline int fuzz_same(float a, float b)
{
    return !memcmp(&a, &b, sizeof a) || (fuzz_is_nan(a) && fuzz_is_nan(b));
}

/* The vector widths this processor has: 0 .. this. */
static inline int fuzz_widest(void)
{
#if defined(__x86_64__) && (defined(__GNUC__) || defined(__clang__))
    return __builtin_cpu_supports("avx512vl") && __builtin_cpu_supports("avx512bw") &&
                   __builtin_cpu_supports("avx512dq") ? 3 : __builtin_cpu_supports("avx2") ? 2 :
                   __builtin_cpu_supports("sse4.1") ? 1 : 0;
#else
    return 0;
#endif
}

/* ---- memory between pages without access ---------------------------------------------------- */

#if defined(__has_feature)
#if __has_feature(address_sanitizer)
#define FUZZ_ASAN 1
#endif
#endif
#if defined(__SANITIZE_ADDRESS__) || defined(FUZZ_ASAN)
void __asan_poison_memory_region(void const volatile *, size_t);
void __asan_unpoison_memory_region(void const volatile *, size_t);
#define FUZZ_POISON(p, n) __asan_poison_memory_region(p, n)
#define FUZZ_UNPOISON(p, n) __asan_unpoison_memory_region(p, n)
#else
#define FUZZ_POISON(p, n) ((void)(p))
#define FUZZ_UNPOISON(p, n) ((void)(p))
#endif

enum { GUARD_BLOCKS = 32, GUARD_ROOM = 1 << 21, GUARD_EDGE = 256, GUARD_BYTE = 0xC9 };

typedef struct guard {
    uint8_t *room;                       /* GUARD_ROOM bytes between two pages without access */
    uint8_t *at;                         /* size bytes at one end of the room */
    size_t size, left, right;            /* bytes of slack on either side that must not change */
    uint64_t seal;                       /* hash of what must not change; 0: it may */
} guard;

static guard guard_blocks[GUARD_BLOCKS];
static int guard_count;

/* Four chains, since one waits for its products. */
static inline uint64_t guard_hash(const uint8_t *p, size_t size)
{
    uint64_t h[4] = { 14695981039346656037u, 1, 2, 3 }, word[4];
    size_t i = 0;
    for (; i + 32 <= size; i += 32) {
        memcpy(word, p + i, 32);
        for (int k = 0; k < 4; k++) {
            h[k] = (h[k] ^ word[k]) * 1099511628211u;
            h[k] ^= h[k] >> 32;
        }
    }
    for (; i < size; i++) h[0] = (h[0] ^ p[i]) * 1099511628211u;
    for (int k = 1; k < 4; k++) h[0] = (h[0] ^ h[k]) * 1099511628211u;
    return h[0] | 1;
}

static inline uint8_t *guard_room(void)
{
    size_t page = (size_t)sysconf(_SC_PAGESIZE);
    uint8_t *p = (uint8_t *)mmap(NULL, GUARD_ROOM + 2 * page, PROT_NONE,
                                 MAP_PRIVATE | MAP_ANONYMOUS, -1, 0);
    if (p == (uint8_t *)MAP_FAILED || mprotect(p + page, GUARD_ROOM, PROT_READ | PROT_WRITE)) {
        fprintf(stderr, "no memory\n");
        exit(2);
    }
    return p + page;
}

/* size bytes, a multiple of their alignment, that end (right) or begin at a page without access. */
static inline void *guard_take(size_t size, int right)
{
    guard *g;
    if (guard_count == GUARD_BLOCKS || size > GUARD_ROOM) {
        fprintf(stderr, "a target takes too much memory\n");
        exit(2);
    }
    g = &guard_blocks[guard_count++];
    if (!g->room) g->room = guard_room();
    g->size = size;
    g->seal = 0;
    g->at = right ? g->room + GUARD_ROOM - size : g->room;
    g->left = (size_t)(g->at - g->room);
    g->right = GUARD_ROOM - size - g->left;
    g->left = g->left < GUARD_EDGE ? g->left : GUARD_EDGE;
    g->right = g->right < GUARD_EDGE ? g->right : GUARD_EDGE;
    memset(g->at - g->left, GUARD_BYTE, g->left);
    memset(g->at + size, GUARD_BYTE, g->right);
    FUZZ_POISON(g->at - g->left, g->left);
    FUZZ_POISON(g->at + size, g->right);
    return g->at;
}

/* What was taken is input from here on: its bytes are to stay. */
static inline void guard_seal(const void *memory)
{
    for (int k = 0; k < guard_count; k++)
        if (guard_blocks[k].at == (const uint8_t *)memory)
            guard_blocks[k].seal = guard_hash(guard_blocks[k].at, guard_blocks[k].size);
}

/* Checks all that was taken, and gives it back. */
static inline void guard_close(void)
{
    for (int k = 0; k < guard_count; k++) {
        guard *g = &guard_blocks[k];
        FUZZ_UNPOISON(g->at - g->left, g->left);
        FUZZ_UNPOISON(g->at + g->size, g->right);
        for (size_t i = 1; i <= g->left; i++) HOLDS(*(g->at - i) == GUARD_BYTE);
        for (size_t i = 0; i < g->right; i++) HOLDS(g->at[g->size + i] == GUARD_BYTE);
        HOLDS(!g->seal || g->seal == guard_hash(g->at, g->size));
        if (!g->seal) fuzz_bits = fuzz_bits * 1099511628211u + guard_hash(g->at, g->size);
    }
    guard_count = 0;
}

/* A list of indices in 16 bits; NULL where one has more. */
static inline const uint16_t *guard_narrow(const uint32_t *indices, int count, int right)
{
    uint16_t *narrow;
    for (int i = 0; i < count; i++)
        if (indices[i] > UINT16_MAX) return NULL;
    narrow = (uint16_t *)guard_take((size_t)count * sizeof *narrow, right);
    for (int i = 0; i < count; i++) narrow[i] = (uint16_t)indices[i];
    guard_seal(narrow);
    return narrow;
}

/* Bytes without a meaning. */
static inline void fuzz_noise(void *memory, size_t size, uint32_t seed)
{
    uint8_t *p = (uint8_t *)memory;
    uint32_t x = seed * 2654435769u + 1;
    for (size_t i = 0; i < size; i++) {
        x ^= x << 13;
        x ^= x >> 17;
        x ^= x << 5;
        p[i] = (uint8_t)(x >> 24);
    }
}
#endif
