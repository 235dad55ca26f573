/* maths_shade.c - the loops of maths.c with shade.h.  Compiled by itself it calls what is not
   inline in another file; maths.c includes it behind the implementation. */
#include "shade.h"
#include "maths.h"

#define AS(type, pointer) ((type *)(void *)(pointer))
#define AS_CONST(type, pointer) ((const type *)(const void *)(pointer))

static void shade_mat4_mat4(const float *a, const float *b, float *out, int count)
{
    for (int i = 0; i < count; i++)
        AS(shade_mat4, out)[i] =
            shade_mat4_mul(AS_CONST(shade_mat4, a)[i], AS_CONST(shade_mat4, b)[i]);
}

static void shade_mat4_vec4(const float *a, const float *b, float *out, int count)
{
    for (int i = 0; i < count; i++)
        AS(shade_vec4, out)[i] =
            shade_mat4_transform(AS_CONST(shade_mat4, a)[i], AS_CONST(shade_vec4, b)[i]);
}

static void shade_normalize_all(const float *a, const float *b, float *out, int count)
{
    (void)b;
    for (int i = 0; i < count; i++)
        AS(shade_vec3, out)[i] = shade_normalize(AS_CONST(shade_vec3, a)[i]);
}

static void shade_inverse_transpose(const float *a, const float *b, float *out, int count)
{
    (void)b;
    for (int i = 0; i < count; i++)
        AS(shade_mat3, out)[i] = shade_mat3_inverse_transpose(AS_CONST(shade_mat3, a)[i]);
}

static const maths_library maths_shade = { "shade.h", shade_mat4_mat4, shade_mat4_vec4,
                                           shade_normalize_all, shade_inverse_transpose };

#ifndef SHADE_IMPLEMENTATION
const maths_library *maths_shade_apart(void) { return &maths_shade; }
#endif
