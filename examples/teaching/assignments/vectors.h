/* vectors.h - vectors and matrices for the assignments and the project: what your file is compiled
   with, and all of it.  Names, types and meanings are those of shade.h, which has the answers too;
   a file that includes this one compiles with either.

   Vectors are columns.  A matrix m is an array of columns, m.col[column], and m v is
   col[0] v.x + col[1] v.y + ...  Angles are in radians. */
#ifndef SHADE_H /* with shade.h there is nothing left to declare */
#ifndef VECTORS_H
#define VECTORS_H
#include <math.h>

#if defined(__GNUC__)
#define VECTORS static inline __attribute__((unused))
#else
#define VECTORS static inline
#endif

typedef struct shade_vec2 {
    float x, y;
} shade_vec2;
typedef struct shade_vec3 {
    float x, y, z;
} shade_vec3;
typedef struct shade_vec4 {
    float x, y, z, w;
} shade_vec4;
typedef struct shade_mat3 {
    shade_vec3 col[3];
} shade_mat3;
typedef struct shade_mat4 {
    shade_vec4 col[4];
} shade_mat4;

typedef struct shade_material {
    shade_vec3 emission; /* k_e */
    shade_vec3 ambient;  /* k_a */
    shade_vec3 diffuse;  /* k_d */
    shade_vec3 specular; /* k_s */
    float shininess;     /* n */
} shade_material;

typedef struct shade_light {
    shade_vec4 position;               /* w = 1: a place; w = 0: the direction toward it */
    shade_vec3 ambient;                /* I_La */
    shade_vec3 diffuse;                /* I_d */
    shade_vec3 specular;               /* I_s */
    float constant, linear, quadratic; /* a, b, c */
    shade_vec3 spot_direction;         /* where the lamp points, any length */
    float spot_exponent;               /* e */
    float spot_cos_cutoff;             /* cos(beta) */
} shade_light;

typedef struct shade_lighting {
    const shade_light *lights;
    int light_count;
    shade_vec3 ambient; /* I_a */
} shade_lighting;

/* ---- vectors ------------------------------------------------------------------------------- */
VECTORS shade_vec2 shade_v2(float x, float y)
{
    const shade_vec2 v = { x, y };
    return v;
}
VECTORS shade_vec3 shade_v3(float x, float y, float z)
{
    const shade_vec3 v = { x, y, z };
    return v;
}
VECTORS shade_vec4 shade_v4(float x, float y, float z, float w)
{
    const shade_vec4 v = { x, y, z, w };
    return v;
}

VECTORS shade_vec3 shade_add(shade_vec3 a, shade_vec3 b)
{
    return shade_v3(a.x + b.x, a.y + b.y, a.z + b.z);
}
VECTORS shade_vec3 shade_sub(shade_vec3 a, shade_vec3 b)
{
    return shade_v3(a.x - b.x, a.y - b.y, a.z - b.z);
}
/* The product of each component, as of two colours. */
VECTORS shade_vec3 shade_mul(shade_vec3 a, shade_vec3 b)
{
    return shade_v3(a.x * b.x, a.y * b.y, a.z * b.z);
}
VECTORS shade_vec3 shade_scale(shade_vec3 v, float s)
{
    return shade_v3(v.x * s, v.y * s, v.z * s);
}
/* a + s b */
VECTORS shade_vec3 shade_madd(shade_vec3 a, float s, shade_vec3 b)
{
    return shade_add(a, shade_scale(b, s));
}
VECTORS shade_vec3 shade_neg(shade_vec3 v) { return shade_v3(-v.x, -v.y, -v.z); }
VECTORS float shade_dot(shade_vec3 a, shade_vec3 b) { return a.x * b.x + a.y * b.y + a.z * b.z; }
/* Right-handed: x cross y = z. */
VECTORS shade_vec3 shade_cross(shade_vec3 a, shade_vec3 b)
{
    return shade_v3(a.y * b.z - a.z * b.y, a.z * b.x - a.x * b.z, a.x * b.y - a.y * b.x);
}
VECTORS float shade_length(shade_vec3 v) { return sqrtf(shade_dot(v, v)); }
VECTORS float shade_distance(shade_vec3 a, shade_vec3 b) { return shade_length(shade_sub(a, b)); }
/* v / |v|; zero stays zero. */
VECTORS shade_vec3 shade_normalize(shade_vec3 v)
{
    const float square = shade_dot(v, v);
    return shade_scale(v, square >= 1e-36f ? 1 / sqrtf(square) : 0);
}
/* a + t (b - a) */
VECTORS shade_vec3 shade_lerp(shade_vec3 a, shade_vec3 b, float t)
{
    return shade_madd(a, t, shade_sub(b, a));
}
VECTORS shade_vec3 shade_min(shade_vec3 a, shade_vec3 b)
{
    return shade_v3(a.x < b.x ? a.x : b.x, a.y < b.y ? a.y : b.y, a.z < b.z ? a.z : b.z);
}
VECTORS shade_vec3 shade_max(shade_vec3 a, shade_vec3 b)
{
    return shade_v3(a.x > b.x ? a.x : b.x, a.y > b.y ? a.y : b.y, a.z > b.z ? a.z : b.z);
}
VECTORS shade_vec3 shade_clamp(shade_vec3 v, shade_vec3 low, shade_vec3 high)
{
    return shade_max(shade_min(v, high), low);
}

VECTORS shade_vec2 shade_add2(shade_vec2 a, shade_vec2 b) { return shade_v2(a.x + b.x, a.y + b.y); }
VECTORS shade_vec2 shade_sub2(shade_vec2 a, shade_vec2 b) { return shade_v2(a.x - b.x, a.y - b.y); }
VECTORS shade_vec2 shade_scale2(shade_vec2 v, float s) { return shade_v2(v.x * s, v.y * s); }
VECTORS float shade_dot2(shade_vec2 a, shade_vec2 b) { return a.x * b.x + a.y * b.y; }
VECTORS shade_vec2 shade_lerp2(shade_vec2 a, shade_vec2 b, float t)
{
    return shade_add2(a, shade_scale2(shade_sub2(b, a), t));
}

VECTORS shade_vec4 shade_add4(shade_vec4 a, shade_vec4 b)
{
    return shade_v4(a.x + b.x, a.y + b.y, a.z + b.z, a.w + b.w);
}
VECTORS shade_vec4 shade_sub4(shade_vec4 a, shade_vec4 b)
{
    return shade_v4(a.x - b.x, a.y - b.y, a.z - b.z, a.w - b.w);
}
VECTORS shade_vec4 shade_scale4(shade_vec4 v, float s)
{
    return shade_v4(v.x * s, v.y * s, v.z * s, v.w * s);
}
VECTORS float shade_dot4(shade_vec4 a, shade_vec4 b)
{
    return a.x * b.x + a.y * b.y + a.z * b.z + a.w * b.w;
}
VECTORS shade_vec4 shade_lerp4(shade_vec4 a, shade_vec4 b, float t)
{
    return shade_add4(a, shade_scale4(shade_sub4(b, a), t));
}

/* ---- matrices ------------------------------------------------------------------------------ */
VECTORS float shade_radians(float degrees) { return degrees * 0.017453292519943295f; }

VECTORS shade_mat3 shade_mat3_identity(void)
{
    const shade_mat3 m = { { { 1, 0, 0 }, { 0, 1, 0 }, { 0, 0, 1 } } };
    return m;
}
VECTORS shade_mat4 shade_mat4_identity(void)
{
    const shade_mat4 m = { { { 1, 0, 0, 0 }, { 0, 1, 0, 0 }, { 0, 0, 1, 0 }, { 0, 0, 0, 1 } } };
    return m;
}
/* m v */
VECTORS shade_vec3 shade_mat3_transform(shade_mat3 m, shade_vec3 v)
{
    const shade_vec3 xy = shade_add(shade_scale(m.col[0], v.x), shade_scale(m.col[1], v.y));
    return shade_add(xy, shade_scale(m.col[2], v.z));
}
VECTORS shade_vec4 shade_mat4_transform(shade_mat4 m, shade_vec4 v)
{
    const shade_vec4 xy = shade_add4(shade_scale4(m.col[0], v.x), shade_scale4(m.col[1], v.y));
    return shade_add4(shade_add4(xy, shade_scale4(m.col[2], v.z)), shade_scale4(m.col[3], v.w));
}
/* a b, which transforms by b first. */
VECTORS shade_mat3 shade_mat3_mul(shade_mat3 a, shade_mat3 b)
{
    for (int k = 0; k < 3; k++) b.col[k] = shade_mat3_transform(a, b.col[k]);
    return b;
}
VECTORS shade_mat4 shade_mat4_mul(shade_mat4 a, shade_mat4 b)
{
    for (int k = 0; k < 4; k++) b.col[k] = shade_mat4_transform(a, b.col[k]);
    return b;
}
/* m (p, 1), divided by its w where that is not 0. */
VECTORS shade_vec3 shade_mat4_transform_point(shade_mat4 m, shade_vec3 p)
{
    const shade_vec4 h = shade_mat4_transform(m, shade_v4(p.x, p.y, p.z, 1));
    return h.w == 0 ? shade_v3(h.x, h.y, h.z) : shade_v3(h.x / h.w, h.y / h.w, h.z / h.w);
}
/* m (d, 0): a translation does not move a direction. */
VECTORS shade_vec3 shade_mat4_transform_direction(shade_mat4 m, shade_vec3 d)
{
    const shade_vec4 h = shade_mat4_transform(m, shade_v4(d.x, d.y, d.z, 0));
    return shade_v3(h.x, h.y, h.z);
}
/* The upper left 3 x 3. */
VECTORS shade_mat3 shade_mat3_from_mat4(shade_mat4 m)
{
    shade_mat3 upper;
    for (int k = 0; k < 3; k++) upper.col[k] = shade_v3(m.col[k].x, m.col[k].y, m.col[k].z);
    return upper;
}
VECTORS shade_mat3 shade_mat3_transpose(shade_mat3 m)
{
    const shade_mat3 t = { { { m.col[0].x, m.col[1].x, m.col[2].x },
                             { m.col[0].y, m.col[1].y, m.col[2].y },
                             { m.col[0].z, m.col[1].z, m.col[2].z } } };
    return t;
}
VECTORS shade_mat4 shade_mat4_transpose(shade_mat4 m)
{
    const shade_mat4 t = { { { m.col[0].x, m.col[1].x, m.col[2].x, m.col[3].x },
                             { m.col[0].y, m.col[1].y, m.col[2].y, m.col[3].y },
                             { m.col[0].z, m.col[1].z, m.col[2].z, m.col[3].z },
                             { m.col[0].w, m.col[1].w, m.col[2].w, m.col[3].w } } };
    return t;
}
VECTORS float shade_mat3_determinant(shade_mat3 m)
{
    return shade_dot(m.col[0], shade_cross(m.col[1], m.col[2]));
}
/* The zero matrix where the determinant is 0. */
VECTORS shade_mat3 shade_mat3_inverse(shade_mat3 m)
{
    const float det = shade_mat3_determinant(m), s = det != 0 ? 1 / det : 0;
    const shade_mat3 rows = { { shade_scale(shade_cross(m.col[1], m.col[2]), s),
                                shade_scale(shade_cross(m.col[2], m.col[0]), s),
                                shade_scale(shade_cross(m.col[0], m.col[1]), s) } };
    return shade_mat3_transpose(rows);
}
/* m made the identity by steps that make the identity its inverse (Gauss and Jordan), in double;
   returns the determinant. */
VECTORS double vectors_solve(const shade_mat4 *m, double of[4][8])
{
    double det = 1;
    for (int i = 0; i < 4; i++) { /* row i: that of m, then that of the identity */
        const float row[4][4] = { { m->col[0].x, m->col[1].x, m->col[2].x, m->col[3].x },
                                  { m->col[0].y, m->col[1].y, m->col[2].y, m->col[3].y },
                                  { m->col[0].z, m->col[1].z, m->col[2].z, m->col[3].z },
                                  { m->col[0].w, m->col[1].w, m->col[2].w, m->col[3].w } };
        for (int k = 0; k < 8; k++) of[i][k] = k < 4 ? (double)row[i][k] : k == i + 4;
    }
    for (int k = 0; k < 4; k++) {
        int best = k;
        for (int i = k; i < 4; i++) best = fabs(of[i][k]) > fabs(of[best][k]) ? i : best;
        if (of[best][k] == 0) return 0;
        for (int j = 0; j < 8; j++) {
            const double swapped = of[k][j];
            of[k][j] = of[best][j];
            of[best][j] = swapped;
        }
        det *= best == k ? of[k][k] : -of[k][k];
        for (int j = 7; j >= k; j--) of[k][j] /= of[k][k];
        for (int i = 0; i < 4; i++) {
            const double times = of[i][k];
            for (int j = k; j < 8 && i != k; j++) of[i][j] -= times * of[k][j];
        }
    }
    return det;
}
VECTORS float shade_mat4_determinant(shade_mat4 m)
{
    double of[4][8];
    return (float)vectors_solve(&m, of);
}
/* The zero matrix where the determinant is 0. */
VECTORS shade_mat4 shade_mat4_inverse(shade_mat4 m)
{
    shade_mat4 inverse = { { { 0, 0, 0, 0 } } };
    double of[4][8];
    if (vectors_solve(&m, of) == 0) return inverse;
    for (int k = 0; k < 4; k++)
        inverse.col[k] = shade_v4((float)of[0][4 + k], (float)of[1][4 + k], (float)of[2][4 + k],
                                  (float)of[3][4 + k]);
    return inverse;
}
VECTORS shade_mat4 shade_mat4_translation(shade_vec3 v)
{
    shade_mat4 m = shade_mat4_identity();
    m.col[3] = shade_v4(v.x, v.y, v.z, 1);
    return m;
}
VECTORS shade_mat4 shade_mat4_scaling(shade_vec3 v)
{
    const shade_mat4 m = {
        { { v.x, 0, 0, 0 }, { 0, v.y, 0, 0 }, { 0, 0, v.z, 0 }, { 0, 0, 0, 1 } }
    };
    return m;
}
/* By the right-hand rule about an axis of any length; the identity for a zero axis. */
VECTORS shade_mat4 shade_mat4_rotation(float radians, shade_vec3 axis)
{
    const float c = cosf(radians), s = sinf(radians), k = 1 - c;
    const shade_vec3 a = shade_normalize(axis);
    const shade_mat4 m = {
        { { c + k * a.x * a.x, k * a.x * a.y + s * a.z, k * a.x * a.z - s * a.y, 0 },
          { k * a.x * a.y - s * a.z, c + k * a.y * a.y, k * a.y * a.z + s * a.x, 0 },
          { k * a.x * a.z + s * a.y, k * a.y * a.z - s * a.x, c + k * a.z * a.z, 0 },
          { 0, 0, 0, 1 } }
    };
    return shade_dot(a, a) > 0 ? m : shade_mat4_identity();
}
#endif /* VECTORS_H */
#endif /* SHADE_H */
