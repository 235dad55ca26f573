/* by_hand.c - each assignment solved as students do, with vectors alone; wrong.txt changes it. */
#include "shade.h"
#include <math.h>

float lambert(shade_vec3 N, shade_vec3 L)
{
    return fmaxf(0, shade_dot(N, L));
}

shade_vec3 mirror(shade_vec3 L, shade_vec3 N)
{
    return shade_sub(shade_scale(N, 2 * shade_dot(N, L)), L);
}

shade_vec3 halfway(shade_vec3 L, shade_vec3 V)
{
    shade_vec3 H = shade_add(L, V);
    float length = shade_length(H);
    if (length < 1e-6f) return shade_v3(0, 0, 0);
    return shade_scale(H, 1 / length);
}

float phong(shade_vec3 N, shade_vec3 L, shade_vec3 V, float n)
{
    shade_vec3 R = mirror(L, N);
    float cosine = fmaxf(0, shade_dot(R, V));
    if (shade_dot(N, L) <= 0) return 0;
    return powf(cosine, n);
}

float attenuation(float a, float b, float c, float r)
{
    return 1 / (a + b * r + c * r * r);
}

float spot(shade_vec3 L, shade_vec3 aim, float cos_cutoff, float e)
{
    shade_vec3 S = shade_neg(shade_normalize(aim));
    float cosine = shade_dot(L, S);
    if (cosine < cos_cutoff) return 0;
    return powf(fmaxf(0, cosine), e);
}

shade_mat3 normal_matrix(shade_mat4 model)
{
    shade_vec3 x = shade_v3(model.col[0].x, model.col[0].y, model.col[0].z);
    shade_vec3 y = shade_v3(model.col[1].x, model.col[1].y, model.col[1].z);
    shade_vec3 z = shade_v3(model.col[2].x, model.col[2].y, model.col[2].z);
    float determinant = shade_dot(x, shade_cross(y, z));
    shade_mat3 m;
    m.col[0] = shade_scale(shade_cross(y, z), 1 / determinant);
    m.col[1] = shade_scale(shade_cross(z, x), 1 / determinant);
    m.col[2] = shade_scale(shade_cross(x, y), 1 / determinant);
    return m;
}

int covers(const int x[3], const int y[3], int i, int j)
{
    const int px = 256 * i + 128, py = 256 * j + 128;
    int area = (x[1] - x[0]) * (y[2] - y[0]) - (y[1] - y[0]) * (x[2] - x[0]);
    if (area == 0) return 0;
    for (int k = 0; k < 3; k++) {
        const int a = area > 0 ? k : (k + 1) % 3;
        const int b = area > 0 ? (k + 1) % 3 : k;
        const int dx = x[b] - x[a], dy = y[b] - y[a];
        const int e = dx * (py - y[a]) - dy * (px - x[a]);
        const int top = dy == 0 && dx > 0;
        const int left = dy < 0;
        if (e < 0) return 0;
        if (e == 0 && !top && !left) return 0;
    }
    return 1;
}

float depth_at(const float w[3], const float z[3], const float abc[3])
{
    float sum = 0;
    for (int k = 0; k < 3; k++) sum += abc[k] * z[k] / w[k];
    return 0.5f * sum + 0.5f;
}

shade_vec2 texture_at(const float w[3], const shade_vec2 uv[3], const float abc[3])
{
    float u = 0, v = 0, whole = 0;
    for (int k = 0; k < 3; k++) {
        u += abc[k] * uv[k].x / w[k];
        v += abc[k] * uv[k].y / w[k];
        whole += abc[k] / w[k];
    }
    return shade_v2(u / whole, v / whole);
}

shade_vec3 iteration_four(const shade_lighting *lighting, const shade_material *m, shade_vec3 eye,
                          shade_vec3 P, shade_vec3 N)
{
    shade_vec3 V = shade_normalize(shade_sub(eye, P));
    shade_vec3 sum = shade_add(m->emission, shade_mul(m->ambient, lighting->ambient));
    for (int j = 0; j < lighting->light_count; j++) {
        const shade_light *l = &lighting->lights[j];
        shade_vec3 to = shade_sub(shade_v3(l->position.x, l->position.y, l->position.z), P);
        float r = shade_length(to);
        shade_vec3 L = shade_normalize(to);
        shade_vec3 H = shade_normalize(shade_add(L, V));
        float arrives = spot(L, l->spot_direction, l->spot_cos_cutoff, l->spot_exponent)
                        * attenuation(l->constant, l->linear, l->quadratic, r);
        sum = shade_add(sum, shade_mul(m->ambient, l->ambient));
        if (shade_dot(N, L) > 0) {
            float diffuse = shade_dot(N, L);
            float lobe = powf(fmaxf(0, shade_dot(N, H)), m->shininess);
            sum = shade_madd(sum, arrives * diffuse, shade_mul(m->diffuse, l->diffuse));
            sum = shade_madd(sum, arrives * lobe, shade_mul(m->specular, l->specular));
        }
    }
    return sum;
}

shade_vec3 color_at(const float x[3], const float y[3], const shade_vec3 color[3], float px,
                    float py)
{
    float area[3], whole = 0;
    shade_vec3 sum = shade_v3(0, 0, 0);
    for (int k = 0; k < 3; k++) {
        const int a = (k + 1) % 3, b = (k + 2) % 3;
        area[k] = (x[a] - px) * (y[b] - py) - (x[b] - px) * (y[a] - py);
        whole += area[k];
    }
    for (int k = 0; k < 3; k++) sum = shade_madd(sum, area[k] / whole, color[k]);
    return sum;
}

float level(float du_dx, float dv_dx, float du_dy, float dv_dy, float size)
{
    const float along_x = size * hypotf(du_dx, dv_dx), along_y = size * hypotf(du_dy, dv_dy);
    return fminf(fmaxf(0, log2f(fmaxf(along_x, along_y))), log2f(size));
}

static int wrapped(float x)
{
    return (int)(x - 4 * floorf(x / 4));
}
float bilinear(const float texel[16], float u, float v)
{
    const float x = 4 * u - 0.5f, y = 4 * v - 0.5f, s = x - floorf(x), t = y - floorf(y);
    const float *row = texel + 4 * wrapped(floorf(y)), *below = texel + 4 * wrapped(floorf(y) + 1);
    const int i = wrapped(floorf(x)), j = wrapped(floorf(x) + 1);
    return (1 - t) * ((1 - s) * row[i] + s * row[j]) + t * ((1 - s) * below[i] + s * below[j]);
}

int clip_near(const shade_vec4 corner[3], shade_vec4 kept[4])
{
    int count = 0;
    for (int k = 0; k < 3; k++) {
        const shade_vec4 a = corner[(k + 2) % 3], b = corner[k];
        const float da = a.z + a.w, db = b.z + b.w;
        if ((da >= 0) != (db >= 0)) kept[count++] = shade_lerp4(a, b, da / (da - db));
        if (db >= 0) kept[count++] = b;
    }
    return count;
}

shade_vec3 bumped(shade_vec3 N, shade_vec3 T, shade_vec3 texel)
{
    const shade_vec3 n = shade_sub(shade_scale(texel, 2), shade_v3(1, 1, 1));
    const shade_vec3 t = shade_normalize(shade_madd(T, -shade_dot(N, T), N));
    const shade_vec3 b = shade_cross(N, t);
    return shade_normalize(shade_madd(shade_madd(shade_scale(t, n.x), n.y, b), n.z, N));
}

int lit(const float depth[16], shade_mat4 lamp, shade_vec3 P, float bias)
{
    const shade_vec4 at = shade_mat4_transform(lamp, shade_v4(P.x, P.y, P.z, 1));
    const float u = (at.x / at.w + 1) / 2, v = (1 - at.y / at.w) / 2;
    if (at.w <= 0 || !(u >= 0 && u < 1 && v >= 0 && v < 1)) return 1;
    return (at.z / at.w + 1) / 2 <= depth[4 * (int)(4 * v) + (int)(4 * u)] + bias;
}
