/* maths_shade.h - the loops of maths.h with shade.h, for a file that has included shade.h with or
   without its implementation. */
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
