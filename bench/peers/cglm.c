/* cglm.c - cglm's inline functions. */
#include "../maths.h"
#include <stddef.h>

#ifdef HAVE_CGLM
#ifndef __clang__
#pragma GCC diagnostic push
#pragma GCC diagnostic ignored "-Wpedantic"
#pragma GCC diagnostic ignored "-Wconversion"
#pragma GCC diagnostic ignored "-Wundef"
#endif
#include <cglm/cglm.h>
#include <cglm/version.h>
#ifndef __clang__
#pragma GCC diagnostic pop
#endif

/* cglm takes its arguments without const. */
#define MAT4(p) (((mat4 *)(void *)(size_t)(const void *)(p)))
#define MAT3(p) (((mat3 *)(void *)(size_t)(const void *)(p)))
#define VEC4(p) (((vec4 *)(void *)(size_t)(const void *)(p)))
#define VEC3(p) (((vec3 *)(void *)(size_t)(const void *)(p)))

static void mat4_mat4(const float *a, const float *b, float *out, int count)
{
    for (int i = 0; i < count; i++) glm_mat4_mul(MAT4(a)[i], MAT4(b)[i], MAT4(out)[i]);
}
static void mat4_vec4(const float *a, const float *b, float *out, int count)
{
    for (int i = 0; i < count; i++) glm_mat4_mulv(MAT4(a)[i], VEC4(b)[i], VEC4(out)[i]);
}
static void normalize(const float *a, const float *b, float *out, int count)
{
    (void)b;
    for (int i = 0; i < count; i++) glm_vec3_normalize_to(VEC3(a)[i], VEC3(out)[i]);
}
static void inverse_transpose(const float *a, const float *b, float *out, int count)
{
    (void)b;
    for (int i = 0; i < count; i++) {
        mat3 inverse;
        glm_mat3_inv(MAT3(a)[i], inverse);
        glm_mat3_transpose_to(inverse, MAT3(out)[i]);
    }
}

#define TEXT_OF(x) #x
#define TEXT(x) TEXT_OF(x)
const maths_library *maths_cglm(void)
{
    static const maths_library library = {
        "cglm " TEXT(CGLM_VERSION_MAJOR) "." TEXT(CGLM_VERSION_MINOR) "." TEXT(CGLM_VERSION_PATCH),
        mat4_mat4, mat4_vec4, normalize, inverse_transpose
    };
    return &library;
}
#else
const maths_library *maths_cglm(void) { return NULL; }
#endif
