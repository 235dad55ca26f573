/* maths.h - what maths.c measures, and the loops over it that every library has one of.

   A library comes as functions that do the operation count times; arrays are of floats, matrices by
   columns, 16 or 9 of them; vectors are tight. */
#ifndef BENCH_MATHS_H
#define BENCH_MATHS_H

typedef void maths_loop(const float *a, const float *b, float *out, int count);

typedef struct maths_library {
    const char *name;           /* with its version */
    maths_loop *mat4_mat4;      /* out = a b, 16 floats each */
    maths_loop *mat4_vec4;      /* out = a b, 16, 4, 4 floats */
    maths_loop *normalize;      /* out = a / |a|, 3 floats each; b is not read */
    maths_loop *inverse_transpose;    /* out = a^-T, 9 floats each */
} maths_library;

/* NULL where the library is not installed */
#ifdef __cplusplus
extern "C" {
#endif
const maths_library *maths_shade_apart(void);
const maths_library *maths_cglm(void);
const maths_library *maths_glm(void);
#ifdef __cplusplus
}
#endif
#endif
