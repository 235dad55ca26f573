/* solutions.c - each assignment solved by the library's own calls, in its starter's signature. */
#include "shade.h"

float lambert(shade_vec3 N, shade_vec3 L) { return shade_lambert(N, L); }

shade_vec3 mirror(shade_vec3 L, shade_vec3 N) { return shade_mirror(L, N); }

shade_vec3 halfway(shade_vec3 L, shade_vec3 V) { return shade_halfway(L, V); }

float phong(shade_vec3 N, shade_vec3 L, shade_vec3 V, float n)
{
    return shade_phong_specular(N, L, V, n);
}

float attenuation(float a, float b, float c, float r) { return shade_attenuation(a, b, c, r); }

float spot(shade_vec3 L, shade_vec3 aim, float cos_cutoff, float e)
{
    return shade_spot(L, aim, cos_cutoff, e);
}

shade_mat3 normal_matrix(shade_mat4 model) { return shade_normal_matrix(model); }

/* By integer edge functions and the top-left rule, of which the library has no call. */
int covers(const int x[3], const int y[3], int i, int j)
{
    const int px = 256 * i + 128, py = 256 * j + 128;
    const int area = (x[1] - x[0]) * (y[2] - y[0]) - (y[1] - y[0]) * (x[2] - x[0]);
    if (!area) return 0;
    for (int k = 0; k < 3; k++) {
        const int a = area > 0 ? k : (k + 1) % 3, b = area > 0 ? (k + 1) % 3 : k;
        const int dx = x[b] - x[a], dy = y[b] - y[a];
        const int e = dx * (py - y[a]) - dy * (px - x[a]);
        const int top = dy == 0 && dx > 0, left = dy < 0;
        if (e < 0 || (e == 0 && !top && !left)) return 0;
    }
    return 1;
}

/* Perspective of the corners in window depth is linear: what shade_draw interpolates. */
float depth_at(const float w[3], const float z[3], const float abc[3])
{
    const shade_vec3 ndc = shade_v3(z[0] / w[0], z[1] / w[1], z[2] / w[2]);
    return 0.5f * shade_dot(ndc, shade_v3(abc[0], abc[1], abc[2])) + 0.5f;
}

shade_vec2 texture_at(const float w[3], const shade_vec2 uv[3], const float abc[3])
{
    shade_vec2 sum = shade_v2(0, 0);
    float over_w = 0;
    for (int k = 0; k < 3; k++) {
        sum = shade_add2(sum, shade_scale2(uv[k], abc[k] / w[k]));
        over_w += abc[k] / w[k];
    }
    return shade_scale2(sum, 1 / over_w);
}

shade_vec3 iteration_four(const shade_lighting *lighting, const shade_material *m, shade_vec3 eye,
                          shade_vec3 P, shade_vec3 N)
{
    return shade_lit(lighting, m, eye, P, N);
}
