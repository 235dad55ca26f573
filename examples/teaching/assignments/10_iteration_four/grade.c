/* grade.c - the grader of 10_iteration_four; README.md says what to write.
   cc -O2 -I. examples/teaching/assignments/10_iteration_four/grade.c my.c -lm -o grade &&
   ./grade */
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

static void no_distance(const float *in, float *out)
{
    scene s;
    read_scene(in, &s);
    for (int k = 0; k < LIGHTS; k++) s.lights[k].quadratic = 0;
    lit(&s, out);
}
static void no_cone(const float *in, float *out)
{
    scene s;
    read_scene(in, &s);
    for (int k = 0; k < LIGHTS; k++) {
        s.lights[k].spot_cos_cutoff = -1;
        s.lights[k].spot_exponent = 0;
    }
    lit(&s, out);
}
static void reversed_cone(const float *in, float *out)
{
    scene s;
    read_scene(in, &s);
    for (int k = 0; k < LIGHTS; k++) {
        shade_light *l = &s.lights[k];
        l->spot_direction = shade_neg(l->spot_direction);
    }
    lit(&s, out);
}
/* V from the origin of the world in place of P */
static void eye_as_direction(const float *in, float *out)
{
    scene s;
    read_scene(in, &s);
    s.eye = shade_add(s.P, s.eye);
    lit(&s, out);
}
static void colors_of_diffuse(const float *in, float *out)
{
    scene s;
    read_scene(in, &s);
    s.material.specular = s.material.diffuse;
    lit(&s, out);
}
/* Lamps behind the surface count with their negative N.L. */
static void no_gate(const float *in, float *out)
{
    scene s;
    read_scene(in, &s);
    s.lighting.flags = SHADE_FLAG_UNGATED_SPECULAR;
    lit(&s, out);
    for (int j = 0; j < s.lighting.light_count; j++) {
        scene turned = s;
        shade_vec3 away;
        turned.lighting.lights = &s.lights[j];
        turned.lighting.light_count = 1;
        turned.lighting.flags = 0;
        turned.lighting.terms = SHADE_TERM_DIFFUSE;
        turned.N = shade_neg(s.N);
        away = shade_lit(&turned.lighting, &turned.material, turned.eye, turned.P, turned.N);
        grade_put(out, shade_sub(grade_vec(out), away));
    }
}
static void last_lamp(const float *in, float *out)
{
    scene s;
    read_scene(in, &s);
    if (s.lighting.light_count > 1) s.lighting.lights += s.lighting.light_count - 1;
    s.lighting.light_count = s.lighting.light_count > 0;
    lit(&s, out);
}
static void no_lamp_ambient(const float *in, float *out)
{
    scene s;
    read_scene(in, &s);
    for (int k = 0; k < LIGHTS; k++) s.lights[k].ambient = shade_v3(0, 0, 0);
    lit(&s, out);
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
    .yours = yours,
    .right = right,
    .cases = { { "no lamp", 3, none,
                 "Without a lamp the answer is k_e + k_a I_a." },
               { "one lamp", 5, one,
                 "Look at one term after the other: L and V are unit vectors from P, S is "
                 "-spot_direction, the highlight has the lamp's specular colour, and cone "
                 "and distance dim k_d and k_s alone." },
               { "two lamps", 5, two,
                 "If one lamp is right and two are not, the sum is: each lamp has its own L, "
                 "H, r, cone and B." },
               { "lamps behind the surface", 4, behind,
                 "Where N.L is not above 0 a lamp adds its ambient light alone, k_a I_La." } },
    .mistakes = { { "ungated", ungated,
                    "The highlight has no B: where N.L is not above 0 both terms are 0." },
                  { "dimmed_ambient", dimmed_ambient,
                    "The ambient light of a lamp, I_La, is dimmed by its cone "
                    "or its distance: in iteration four it stands outside of both." },
                  { "phong", phong,
                    "The highlight is Phong's (R.V)^n; iteration four has (N.H)^n." },
                  { "emission_often", emission_often,
                    "k_e is added for each lamp: it stands before the sum." },
                  { "no_distance", no_distance,
                    "Lamps are as bright far away as nearby: divide by a + b r + c r^2." },
                  { "no_cone", no_cone,
                    "Lamps shine outside of their cones: spot_j is 0 where L.S is below "
                    "spot_cos_cutoff, else (L.S) to the power spot_exponent." },
                  { "reversed_cone", reversed_cone,
                    "The cones point the wrong way: S is -spot_direction, and L.S is 1 on the "
                    "axis." },
                  { "eye_as_direction", eye_as_direction,
                    "V is taken from the eye alone: it is the unit vector from P to the eye, "
                    "eye - P." },
                  { "colors_of_diffuse", colors_of_diffuse,
                    "The highlight has the colour k_d: it has a colour of its own, k_s." },
                  { "no_gate", no_gate,
                    "B is missing: a lamp behind the surface takes light away, because its N.L "
                    "is negative. B is 0 there, for both terms." },
                  { "last_lamp", last_lamp,
                    "Only the last lamp is left: add up the lamps, each with +=." },
                  { "no_lamp_ambient", no_lamp_ambient,
                    "The ambient light that each lamp adds is missing: k_a I_La stands inside "
                    "the sum." } },
    .place = place,
    .scale = 1,
    .offset = 0,
    .picture_points = 3,
};

int main(int argc, char **argv) { return grade_main(&task, argc, argv); }
