/* grade.c - the grader of 10_iteration_four; README.md says what to write.
   cc -O2 -I. examples/assignments/10_iteration_four/grade.c my.c -lm -o grade && ./grade */
#define SHADE_IMPLEMENTATION
#include "shade.h"
#include "../grade.h"

shade_vec3 iteration_four(const shade_lighting *lighting, const shade_material *m, shade_vec3 eye,
                          shade_vec3 P, shade_vec3 N);

enum { LIGHT = 12, LIGHTS = 2, AT_LIGHTS = 22 }; /* floats of a lamp, lamps, where they begin */

/* eye, P, N; k_e k_a k_d as one grey each; k_s, n; I_a; then the lamps */
typedef struct scene {
    shade_lighting lighting;
    shade_material material;
    shade_light lights[LIGHTS];
    shade_vec3 eye, P, N;
} scene;

static void read_scene(const float *in, scene *s)
{
    memset(s, 0, sizeof *s);
    s->eye = grade_vec(in);
    s->P = grade_vec(in + 3);
    s->N = grade_vec(in + 6);
    s->material.emission = shade_v3(in[9], in[9], in[9]);
    s->material.ambient = shade_v3(in[10], in[10] / 2, in[10] / 4);
    s->material.diffuse = grade_vec(in + 11);
    s->material.specular = grade_vec(in + 14);
    s->material.shininess = in[17];
    s->lighting.ambient = grade_vec(in + 18);
    for (int k = 0; k < LIGHTS; k++) {
        const float *from = in + AT_LIGHTS + LIGHT * k;
        shade_light *l = &s->lights[k];
        *l = shade_spot_light(grade_vec(from), grade_vec(from + 3), from[6], from[7],
                              grade_vec(from + 8));
        l->constant = 1;
        l->quadratic = from[11];
        l->ambient = shade_scale(grade_vec(from + 8), 0.1f);
    }
    s->lighting.lights = s->lights;
    s->lighting.light_count = (int)in[21];
}
static void yours(const float *in, float *out)
{
    scene s;
    read_scene(in, &s);
    grade_put(out, iteration_four(&s.lighting, &s.material, s.eye, s.P, s.N));
}
static void lit(scene *s, float *out)
{
    grade_put(out, shade_lit(&s->lighting, &s->material, s->eye, s->P, s->N));
}
static void right(const float *in, float *out)
{
    scene s;
    read_scene(in, &s);
    lit(&s, out);
}
static void ungated(const float *in, float *out)
{
    scene s;
    read_scene(in, &s);
    s.lighting.flags = SHADE_FLAG_UNGATED_SPECULAR;
    lit(&s, out);
}
static void dimmed_ambient(const float *in, float *out)
{
    scene s;
    read_scene(in, &s);
    s.lighting.flags = SHADE_FLAG_ATTENUATED_AMBIENT;
    lit(&s, out);
}
static void phong(const float *in, float *out)
{
    scene s;
    read_scene(in, &s);
    s.lighting.model = SHADE_MODEL_PHONG;
    lit(&s, out);
}
/* k_e counted once for each lamp */
static void emission_often(const float *in, float *out)
{
    scene s;
    read_scene(in, &s);
    lit(&s, out);
    for (int k = 0; k < 3; k++) out[k] += (float)(s.lighting.light_count - 1) * in[9];
}

static void fill(float *in, int lights, float side)
{
    const shade_vec3 N = grade_direction(), P = shade_scale(grade_direction(), 0.3f);
    grade_put(in, shade_madd(P, 4, grade_beside(N, 1)));
    grade_put(in + 3, P);
    grade_put(in + 6, N);
    for (int k = 9; k < 17; k++) in[k] = grade_between(0.05f, 0.9f);
    in[17] = grade_between(2, 30);
    for (int k = 18; k < 21; k++) in[k] = grade_between(0, 0.4f);
    in[21] = (float)lights;
    for (int k = 0; k < LIGHTS; k++) {
        float *l = in + AT_LIGHTS + LIGHT * k;
        const shade_vec3 to = grade_beside(N, side);
        grade_put(l, shade_madd(P, grade_between(1, 3), to));
        grade_put(l + 3, shade_normalize(shade_madd(shade_neg(to), 0.2f, grade_direction())));
        l[6] = 0.6f;
        l[7] = grade_between(0, 5);
        for (int c = 8; c < 11; c++) l[c] = grade_between(0.3f, 2);
        l[11] = grade_between(0, 0.5f);
    }
}
static void none(float *in) { fill(in, 0, 1); }
static void one(float *in) { fill(in, 1, 1); }
static void two(float *in) { fill(in, 2, 1); }
static void behind(float *in)
{
    fill(in, 2, -1);
    in[17] = 1;
}

static int place(float x, float y, float *in)
{
    const float at[GRADE_IN] = {
        0,    0,           4,           0,           0,    0,  0,    0,    1,    0.02f, 0.1f, 0.5f,
        0.3f, 0.1f,        0.5f,        0.5f,        0.5f, 20, 0.1f, 0.1f, 0.1f, 2,     -2,   2,
        2,    0.5773503f,  -0.5773503f, -0.5773503f, 0.5f, 2,  2,    2,    2,    0.05f, 2,    0,
        2,    -0.7071068f, 0,           -0.7071068f, 0.3f, 8,  0,    1,    3,    0.1f
    };
    shade_vec3 N;
    if (!grade_ball(x, y, &N)) return 0;
    memcpy(in, at, sizeof at);
    grade_put(in + 3, N);
    grade_put(in + 6, N);
    return 1;
}
static const grade_task task = {
    .name = "10_iteration_four",
    .names = "eye3 P3 N3 k_e1 k_a1 k_d3 k_s3 n1 I_a3 lamps1 lamp12 lamp12",
    .outputs = 3,
    .tolerance = 1e-4f,
    .yours = GRADE_ANSWER,
    .right = right,
    .cases = { { "no lamp", 3, none },
               { "one lamp", 5, one },
               { "two lamps", 5, two },
               { "lamps behind the surface", 4, behind } },
    .mistakes = { { "ungated", ungated,
                    "The highlight has no B: where N.L is not above 0 both terms are 0." },
                  { "dimmed_ambient", dimmed_ambient,
                    "The ambient light of a lamp, I_La, is dimmed by its cone "
                    "or its distance: in iteration four it stands outside of both." },
                  { "phong", phong,
                    "The highlight is Phong's (R.V)^n; iteration four has (N.H)^n." },
                  { "emission_often", emission_often,
                    "k_e is added for each lamp: it stands before the sum." } },
    .place = place,
    .scale = 1,
    .offset = 0,
    .picture_points = 3,
};

int main(int argc, char **argv) { return grade_main(&task, argc, argv); }
