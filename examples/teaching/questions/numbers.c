/* numbers.c - the numbers of questions: drawn by a seed, answered by shade.h.  It prints a row for
   each question: its kind, the given numbers, |, the answer.
       ./numbers SEED COUNT */
#define SHADE_STATIC
#define SHADE_NO_DISPATCH
#define SHADE_IMPLEMENTATION
#include "shade.h"
#include "drawn.h"
#include <stdio.h>

static void given(float x) { printf(" %.6g", (double)x); }
static void answer(float x) { printf(" | %.9g\n", (double)x); }
/* Unit vectors with few digits: from triples of Pythagoras, in a plane through z. */
static shade_vec3 direction(void)
{
    static const float of[5][2] = {
        { 0.6f, 0.8f }, { 0.8f, 0.6f }, { 0.28f, 0.96f }, { 0.96f, 0.28f }, { 0, 1 }
    };
    const float *p = of[(int)drawn(0, 4, 1)], sign = drawn(0, 1, 1) > 0 ? 1 : -1;
    return shade_v3(sign * p[0], 0, p[1]);
}
static void kind(const char *name) { printf("%s", name); }
static void given3(shade_vec3 v)
{
    given(v.x);
    given(v.y);
    given(v.z);
}

/* One channel of the light of a lamp in the direction L, the eye in the direction V. */
static float lit(shade_model model, shade_vec3 L, shade_vec3 V, float ka, float kd, float ks,
                 float n, float light)
{
    const shade_vec3 N = { 0, 0, 1 }, none = { 0, 0, 0 };
    const shade_light lamp = { .position = { L.x, L.y, L.z, 0 },
                               .ambient = { light, 0, 0 },
                               .diffuse = { light, 0, 0 },
                               .specular = { light, 0, 0 } };
    const shade_material m = { none, { ka, 0, 0 }, { kd, 0, 0 }, { ks, 0, 0 }, n };
    const shade_lighting l = { .lights = &lamp, .light_count = 1, .model = model };
    return shade_lit(&l, &m, shade_scale(V, 10), none, N).x;
}
static float brdf(shade_vec3 L, shade_vec3 V, float kd, float ks, float n)
{
    const shade_vec3 N = { 0, 0, 1 }, none = { 0, 0, 0 };
    const shade_material m = { none, none, { kd, 0, 0 }, { ks, 0, 0 }, n };
    return shade_brdf(&m, SHADE_MODEL_BLINN_PHONG, N, L, V).x;
}

int main(int count, char **words)
{
    const shade_vec3 N = { 0, 0, 1 }, down = { 0, 0, -1 };
    if (count != 3) return 2;
    drawn_seed(words[1]);
    for (int k = 0; k < atoi(words[2]); k++) {
        const shade_vec3 L = direction(), V = direction();
        const float n = drawn(5, 60, 5), a = drawn(0, 1, 0.25f), b = drawn(0.1f, 0.5f, 0.1f);
        const float c = drawn(0.05f, 0.25f, 0.05f), r = drawn(1, 5, 0.5f);
        const float kd = drawn(0.1f, 0.9f, 0.1f), ks = drawn(0.1f, 0.9f, 0.1f),
                    ka = drawn(0.1f, 0.3f, 0.1f);
        const float cutoff = drawn(0.5f, 0.9f, 0.1f), e = drawn(1, 8, 1),
                    light = drawn(0.5f, 2, 0.5f);
        const float stretch = drawn(2, 5, 1), degrees = drawn(30, 90, 15);
        const float near = drawn(0.5f, 1, 0.25f), far = drawn(6, 12, 2);
        kind("lambert");
        given3(L);
        answer(shade_lambert(N, L));
        kind("mirror");
        given3(L);
        answer(shade_mirror(L, N).x);
        kind("halfway");
        given3(L);
        given3(V);
        answer(shade_halfway(L, V).z);
        kind("phong");
        given3(L);
        given3(V);
        given(n);
        answer(shade_phong_specular(N, L, V, n));
        kind("blinn");
        given3(L);
        given3(V);
        given(n);
        answer(shade_blinn_phong_specular(N, L, V, n));
        kind("attenuation");
        given(a);
        given(b);
        given(c);
        given(r);
        answer(shade_attenuation(a, b, c, r));
        kind("spot");
        given3(L);
        given(cutoff);
        given(e);
        answer(shade_spot(L, down, cutoff, e));
        kind("diffuse");
        given3(L);
        given(ka);
        given(kd);
        given(light);
        answer(lit(SHADE_MODEL_LAMBERT, L, V, ka, kd, ks, n, light));
        kind("three");
        given3(L);
        given3(V);
        given(ka);
        given(kd);
        given(ks);
        given(n);
        given(light);
        answer(lit(SHADE_MODEL_BLINN_PHONG, L, V, ka, kd, ks, n, light));
        kind("normal");
        given(stretch);
        given3(L);

        answer(shade_normalize(
                   shade_mat3_transform(
                       shade_normal_matrix(shade_mat4_scaling(shade_v3(1, 1, stretch))), L))
                   .z);
        kind("focal");
        given(degrees);
        answer(shade_mat4_perspective(shade_radians(degrees), 1, 1, 10).col[1].y);
        kind("depth");
        given(near);
        given(far);
        given(r);
        answer(0.5f + 0.5f * shade_mat4_transform_point(shade_mat4_perspective(1, 1, near, far),
                                                        shade_v3(0, 0, -r))
                                 .z);
        kind("window");
        given(degrees);
        given(b);
        given(r);

        answer((1 -
                shade_mat4_transform_point(
                    shade_mat4_perspective(shade_radians(degrees), 1, 0.5f, 10), shade_v3(0, b, -r))
                    .y) *
               240);
        kind("tone");
        given3(L);
        answer(shade_cool_to_warm(N, L, shade_v3(0.4f, 0.4f, 0.7f), shade_v3(0.8f, 0.6f, 0.6f)).x);
        kind("srgb");
        given(kd);
        answer(255 * shade_srgb_from_linear(shade_v3(kd, 0, 0)).x);
        kind("brdf");
        given3(L);
        given3(V);
        given(kd);
        given(ks);
        given(n);
        answer(brdf(L, V, kd, ks, n));
    }
    return 0;
}
