/* vectors.c - prints what each function of vectors.h gives, by vectors.h or by shade.h: HEADER. */
#ifdef __GNUC__
#pragma GCC diagnostic ignored "-Wunused-function"
#endif
#define SHADE_STATIC
#define SHADE_IMPLEMENTATION
#include HEADER
#include <stdio.h>

static void one(const char *name, float x) { printf("%s %.9g\n", name, (double)x); }
static void two(const char *name, shade_vec2 v)
{
    printf("%s %.9g %.9g\n", name, (double)v.x, (double)v.y);
}
static void three(const char *name, shade_vec3 v)
{
    printf("%s %.9g %.9g %.9g\n", name, (double)v.x, (double)v.y, (double)v.z);
}
static void four(const char *name, shade_vec4 v)
{
    printf("%s %.9g %.9g %.9g %.9g\n", name, (double)v.x, (double)v.y, (double)v.z, (double)v.w);
}
static void nine(const char *name, shade_mat3 m)
{
    for (int k = 0; k < 3; k++) three(name, m.col[k]);
}
static void sixteen(const char *name, shade_mat4 m)
{
    for (int k = 0; k < 4; k++) four(name, m.col[k]);
}

int main(void)
{
    const shade_vec2 p = shade_v2(0.3f, -1.7f), q = shade_v2(2.5f, 0.4f);
    const shade_vec3 a = shade_v3(0.3f, -1.7f, 2.2f), b = shade_v3(-0.8f, 0.6f, 1.1f);
    const shade_vec4 c = shade_v4(1, -2, 0.5f, 3), d = shade_v4(0.1f, 0.7f, -4, 1);
    const shade_mat3 m = { { { 2, 0.3f, -1 }, { 0.5f, -1.5f, 0.2f }, { 1, 0.8f, 3 } } };
    const shade_mat3 flat = { { { 1, 2, 3 }, { 2, 4, 6 }, { 0, 1, 1 } } };
    const shade_mat4 n = { { { 2, 0.3f, -1, 0.1f }, { 0.5f, -1.5f, 0.2f, 0 }, { 1, 0.8f, 3, 0.2f },
                             { 4, 5, 6, 1 } } };
    const shade_mat4 down = { { { 0, 0, 0, 0 }, { 0, 1, 0, 0 }, { 0, 0, 1, 0 }, { 0, 0, 0, 1 } } };
    three("add", shade_add(a, b));
    three("sub", shade_sub(a, b));
    three("mul", shade_mul(a, b));
    three("scale", shade_scale(a, 1.3f));
    three("madd", shade_madd(a, 1.3f, b));
    three("neg", shade_neg(a));
    one("dot", shade_dot(a, b));
    three("cross", shade_cross(a, b));
    one("length", shade_length(a));
    one("distance", shade_distance(a, b));
    three("normalize", shade_normalize(a));
    three("of_zero", shade_normalize(shade_v3(0, 0, 0)));
    three("lerp", shade_lerp(a, b, 0.3f));
    three("min", shade_min(a, b));
    three("max", shade_max(a, b));
    three("clamp", shade_clamp(a, shade_v3(0, 0, 0), shade_v3(1, 1, 1)));
    two("add2", shade_add2(p, q));
    two("sub2", shade_sub2(p, q));
    two("scale2", shade_scale2(p, 1.3f));
    one("dot2", shade_dot2(p, q));
    two("lerp2", shade_lerp2(p, q, 0.3f));
    four("add4", shade_add4(c, d));
    four("sub4", shade_sub4(c, d));
    four("scale4", shade_scale4(c, 1.3f));
    one("dot4", shade_dot4(c, d));
    four("lerp4", shade_lerp4(c, d, 0.3f));
    one("radians", shade_radians(67));
    nine("identity3", shade_mat3_identity());
    sixteen("identity4", shade_mat4_identity());
    three("transform3", shade_mat3_transform(m, a));
    four("transform4", shade_mat4_transform(n, c));
    nine("mul3", shade_mat3_mul(m, flat));
    sixteen("mul4", shade_mat4_mul(n, down));
    three("point", shade_mat4_transform_point(n, a));
    three("no_w", shade_mat4_transform_point(shade_mat4_scaling(shade_v3(1, 2, 3)), a));
    three("direction", shade_mat4_transform_direction(n, a));
    nine("from4", shade_mat3_from_mat4(n));
    nine("transpose3", shade_mat3_transpose(m));
    sixteen("transpose4", shade_mat4_transpose(n));
    one("determinant3", shade_mat3_determinant(m));
    one("determinant4", shade_mat4_determinant(n));
    one("determinant_of_none", shade_mat4_determinant(down));
    nine("inverse3", shade_mat3_inverse(m));
    nine("none3", shade_mat3_inverse(flat));
    sixteen("inverse4", shade_mat4_inverse(n));
    sixteen("none4", shade_mat4_inverse(down));
    sixteen("translation", shade_mat4_translation(a));
    sixteen("rotation", shade_mat4_rotation(0.7f, a));
    sixteen("no_axis", shade_mat4_rotation(0.7f, shade_v3(0, 0, 0)));
    return 0;
}
