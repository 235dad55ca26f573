/* user_files.c - every inline function of shade.h in a file that has no implementation, as users
   compile it.  Each result goes into one more sum, over lanes, where compilers fuse most.  Prints
   one line a function: its name and a hash of its bits.  The line "own" is a product and a sum of
   this file's own, which compilers may fuse.  With SHADE_NO_LIBM it tries square roots instead. */
#include "shade.h"
#include <math.h>
#include <stdio.h>
#include <string.h>

enum { ROWS = 48, ROUNDS = 50 };
static float in[ROWS][SHADE_LANES], out[16][SHADE_LANES];

#define V2(k) shade_v2(in[k][i], in[k + 1][i])
#define V3(k) shade_v3(in[k][i], in[k + 1][i], in[k + 2][i])
#define V4(k) shade_v4(in[k][i], in[k + 1][i], in[k + 2][i], in[k + 3][i])
#define S(k) in[k][i]

static inline shade_mat3 m3(int k, int i)
{
    const shade_mat3 m = { { V3(k), V3(k + 3), V3(k + 6) } };
    return m;
}

static inline shade_mat4 m4(int k, int i)
{
    const shade_mat4 m = { { V4(k), V4(k + 4), V4(k + 8), V4(k + 12) } };
    return m;
}

static inline void put1(int i, float f) { out[0][i] = f + in[40][i]; }
static inline void put2(int i, shade_vec2 v)
{
    out[0][i] = v.x + in[40][i];
    out[1][i] = v.y + in[41][i];
}

static inline void put3_at(int k, int i, shade_vec3 v)
{
    out[k][i] = v.x + in[40][i];
    out[k + 1][i] = v.y + in[41][i];
    out[k + 2][i] = v.z + in[42][i];
}

static inline void put4_at(int k, int i, shade_vec4 v)
{
    out[k][i] = v.x + in[40][i];
    out[k + 1][i] = v.y + in[41][i];
    out[k + 2][i] = v.z + in[42][i];
    out[k + 3][i] = v.w + in[43][i];
}

static inline void put3(int i, shade_vec3 v) { put3_at(0, i, v); }
static inline void put4(int i, shade_vec4 v) { put4_at(0, i, v); }
static inline void put_m3(int i, shade_mat3 m)
{
    for (int k = 0; k < 3; k++) put3_at(3 * k, i, m.col[k]);
}

static inline void put_m4(int i, shade_mat4 m)
{
    for (int k = 0; k < 4; k++) put4_at(4 * k, i, m.col[k]);
}

/* name, what takes its result, arguments */
#define FUNCTIONS(TRY) \
    TRY(shade_v2, put2, (S(0), S(1))) \
    TRY(shade_v3, put3, (S(0), S(1), S(2))) \
    TRY(shade_v4, put4, (S(0), S(1), S(2), S(3))) \
    TRY(shade_add, put3, (V3(0), V3(3))) \
    TRY(shade_sub, put3, (V3(0), V3(3))) \
    TRY(shade_mul, put3, (V3(0), V3(3))) \
    TRY(shade_scale, put3, (V3(0), S(3))) \
    TRY(shade_madd, put3, (V3(0), S(3), V3(4))) \
    TRY(shade_neg, put3, (V3(0))) \
    TRY(shade_dot, put1, (V3(0), V3(3))) \
    TRY(shade_cross, put3, (V3(0), V3(3))) \
    TRY(shade_length, put1, (V3(0))) \
    TRY(shade_distance, put1, (V3(0), V3(3))) \
    TRY(shade_normalize, put3, (V3(0))) \
    TRY(shade_lerp, put3, (V3(0), V3(3), S(6))) \
    TRY(shade_min, put3, (V3(0), V3(3))) \
    TRY(shade_max, put3, (V3(0), V3(3))) \
    TRY(shade_clamp, put3, (V3(0), V3(3), V3(6))) \
    TRY(shade_reflect, put3, (V3(0), V3(3))) \
    TRY(shade_mirror, put3, (V3(0), V3(3))) \
    TRY(shade_halfway, put3, (V3(0), V3(3))) \
    TRY(shade_face_normal, put3, (V3(0), V3(3), V3(6))) \
    TRY(shade_add2, put2, (V2(0), V2(2))) \
    TRY(shade_sub2, put2, (V2(0), V2(2))) \
    TRY(shade_scale2, put2, (V2(0), S(2))) \
    TRY(shade_dot2, put1, (V2(0), V2(2))) \
    TRY(shade_lerp2, put2, (V2(0), V2(2), S(4))) \
    TRY(shade_add4, put4, (V4(0), V4(4))) \
    TRY(shade_sub4, put4, (V4(0), V4(4))) \
    TRY(shade_scale4, put4, (V4(0), S(4))) \
    TRY(shade_dot4, put1, (V4(0), V4(4))) \
    TRY(shade_lerp4, put4, (V4(0), V4(4), S(8))) \
    TRY(shade_mat3_transform, put3, (m3(0, i), V3(9))) \
    TRY(shade_mat4_transform, put4, (m4(0, i), V4(16))) \
    TRY(shade_mat3_mul, put_m3, (m3(0, i), m3(9, i))) \
    TRY(shade_mat4_mul, put_m4, (m4(0, i), m4(16, i))) \
    TRY(shade_mat4_transform_point, put3, (m4(0, i), V3(16))) \
    TRY(shade_mat4_transform_direction, put3, (m4(0, i), V3(16))) \
    TRY(shade_mat3_inverse_transpose, put_m3, (m3(0, i))) \
    TRY(own, put1, (S(0), S(1)))

static inline float own(float a, float b) { return a * b; }

#define DEFINE(name, put, arguments) \
    static void try_##name(void) \
    { \
        SHADE_EACH_LANE(i) { put(i, name arguments); } \
    }
FUNCTIONS(DEFINE)

/* The next of a sequence of floats: of either sign, 1/4 to 4 times a power of 2 */
static float next(uint64_t *state, uint32_t power)
{
    uint32_t bits;
    float f;
    *state = *state * 6364136223846793005u + 1442695040888963407u;
    bits = (uint32_t)(*state >> 32);
    bits = (bits & 0x807FFFFFu) | (125u + power + (bits >> 23 & 3)) << 23;
    memcpy(&f, &bits, 4);
    return f;
}

static uint64_t hash_of(void (*function)(void))
{
    uint64_t state = 1, hash = 14695981039346656037u;
    const uint32_t tiny = 66; /* 2^-66, whose products are denormal */
    for (int round = 0; round < ROUNDS; round++) {
        for (int k = 0; k < ROWS * SHADE_LANES; k++)
            in[k / SHADE_LANES][k % SHADE_LANES] = next(&state, round % 2 ? 0 : 0u - tiny);
        if (round % 2 == 0) memset(in[40], 0, 8 * sizeof in[0]); /* nothing hides what is tiny */
        memset(out, 0, sizeof out);
        function();
        for (int k = 0; k < 16 * SHADE_LANES; k++) {
            uint32_t bits;
            memcpy(&bits, &out[k / SHADE_LANES][k % SHADE_LANES], 4);
            hash = (hash ^ bits) * 1099511628211u;
        }
    }
    return hash;
}

#ifdef SHADE_NO_LIBM
/* All floats from 1 to 4: every mantissa with an even and an odd exponent */
static int wrong_roots(void)
{
    int wrong = 0;
    for (uint32_t bits = 0x3F800000u; bits < 0x40800000u; bits++) {
        float x;
        memcpy(&x, &bits, 4);
        wrong += shade__sqrt(x) != sqrtf(x);
    }
    return wrong;
}
#endif

#define PRINT(name, put, arguments) \
    printf("%s %08x%08x\n", #name, (unsigned)(hash_of(try_##name) >> 32), \
           (unsigned)hash_of(try_##name));

int main(void)
{
#ifdef SHADE_NO_LIBM
    printf("%d wrong roots\n", wrong_roots());
    return wrong_roots() != 0;
#else
    FUNCTIONS(PRINT)
    return 0;
#endif
}
