/* recipes.c - the equations of four lecture notes in their own words, in double, beside the recipes
   for them in examples/README.md, "Reading your course": UW CSE 457, Massey 159.709, Shirley's
   chapter 10, Berkeley CS 184.  Then what that section says in numbers of their traps. */
#include "unit.h"
#include "examples/shared/recipes.h"

enum { COURSE_SAMPLES = 10000, COURSE_LAMPS = 3 };

/* A surface, its lamps and its viewer */
typedef struct course_sample {
    shade_material material;
    shade_light lamp[COURSE_LAMPS];
    shade_lighting lighting;
    shade_vec3 P, N, eye;
} course_sample;

/* Lamps at infinity and at points.  Vectors are rounded to floats before either side sees them. */
static void course_random(course_sample *s)
{
    memset(s, 0, sizeof *s);
    s->material.emission = random_color(0.3);
    s->material.ambient = random_color(1);
    s->material.diffuse = random_color(1);
    s->material.specular = random_color(1);
    s->material.shininess = rnd_float(1, 100);
    s->P = d3_round(d3_scale(rnd_direction(), 2));
    s->N = d3_round(rnd_direction());
    s->lighting.lights = s->lamp;
    s->lighting.light_count = rnd_int(1, COURSE_LAMPS);
    for (int j = 0; j < s->lighting.light_count; j++) {
        shade_vec3 at = d3_round(d3_scale(rnd_direction(), (double)rnd_float(3, 9)));
        s->lamp[j] = rnd_one_in(2) ? shade_directional_light(at, random_color(1))
                                   : shade_point_light(at, random_color(1));
    }
    /* half of the viewers near the mirror direction of the first lamp, where highlights are */
    double r;
    d3 L = ref_to_light(&s->lamp[0], d3_from(s->P), &r), N = d3_from(s->N), V = rnd_direction();
    d3 R = d3_sub(d3_scale(N, 2 * d3_dot(N, L)), L);
    if (rnd_one_in(2)) V = d3_unit(d3_add(R, d3_scale(V, 0.3)));
    s->eye = d3_round(d3_add(d3_from(s->P), d3_scale(V, 4)));
}

/* The vectors of the notes for lamp j, unit and away from the surface, and r */
typedef struct course_vectors {
    d3 n, l, e, r, h;
    double distance;
} course_vectors;

static course_vectors course_vectors_of(const course_sample *s, int j)
{
    course_vectors v;
    v.n = d3_unit(d3_from(s->N));
    v.e = d3_unit(d3_sub(d3_from(s->eye), d3_from(s->P)));
    v.l = ref_to_light(&s->lamp[j], d3_from(s->P), &v.distance);
    v.r = d3_sub(d3_scale(v.n, 2 * d3_dot(v.l, v.n)), v.l);
    v.h = d3_unit(d3_add(v.l, v.e));
    return v;
}

static double course_plus(double x) { return x > 0 ? x : 0; }

/* a + s b c, the circled product of colours */
static d3 course_add(d3 a, double s, shade_vec3 b, shade_vec3 c)
{
    return d3_add(a, d3_scale(d3_mul(d3_from(b), d3_from(c)), s));
}

/* To 1e-5; above n = 30 to n/30 times that, for a rounding of N.H counts n times in its power. */
static void course_check(int line, const char *what, const course_sample *s, d3 want)
{
    check_color(line, what, shade_lit(&s->lighting, &s->material, s->eye, s->P, s->N), want,
                1e-5 * fmax(1, (double)s->material.shininess / 30));
}

/* ------------------------------------------------------------------------------------------ UW */

/* 1 / (a + b r + c r^2), of random coefficients for a lamp at a point. */
static double uw_attenuation(shade_light *lamp, double r)
{
    if (lamp->position.w == 0) return 1;
    lamp->constant = rnd_float(1, 2);
    lamp->linear = rnd_float(0, 1);
    lamp->quadratic = rnd_float(0, 1);
    double a = (double)lamp->constant, b = (double)lamp->linear, c = (double)lamp->quadratic;
    return 1 / (a + b * r + c * r * r);
}

/* Makes every other lamp a spot, turned by up to 30 degrees from l; returns its factor.  S points
   from the target to the lamp.  *unsure: the point is at the border of the cone. */
static double uw_spot(shade_light *lamp, d3 l, int *unsure, int *in_cone)
{
    if (!rnd_one_in(2)) return 1;
    d3 S = d3_unit(d3_add(l, d3_scale(rnd_direction(), 0.5)));
    lamp->spot_direction = d3_round(d3_scale(S, -3));
    S = d3_unit(d3_scale(d3_from(lamp->spot_direction), -1));
    lamp->spot_exponent = rnd_float(1, 50);
    lamp->spot_cos_cutoff = rnd_float(0.7, 1);
    double cosine = d3_dot(l, S), beta = cosine >= (double)lamp->spot_cos_cutoff;
    *unsure |= fabs(cosine - (double)lamp->spot_cos_cutoff) < 1e-5;
    *in_cone += beta > 0;
    return beta * pow(course_plus(cosine), (double)lamp->spot_exponent);
}

TEST(recipes, uw_iteration_four_is_the_default)
{
    course_sample s;
    int in_cone = 0, sure = 0;
    for (int i = 0; i < COURSE_SAMPLES; i++) {
        course_random(&s);
        d3 I = d3_from(s.material.emission);
        int unsure = 0;
        for (int j = 0; j < s.lighting.light_count; j++) {
            shade_light *lamp = &s.lamp[j];
            course_vectors v = course_vectors_of(&s, j);
            shade_vec3 I_L = lamp->diffuse;
            lamp->ambient = random_color(0.3);
            double attenuation = uw_attenuation(lamp, v.distance);
            double spot = uw_spot(lamp, v.l, &unsure, &in_cone);
            double B = d3_dot(v.n, v.l) > 0, n_s = (double)s.material.shininess;
            double f = spot * attenuation * B;
            unsure |= fabs(d3_dot(v.n, v.l)) < 1e-5;
            I = course_add(I, 1, s.material.ambient, lamp->ambient);
            I = course_add(I, f * d3_dot(v.n, v.l), s.material.diffuse, I_L);
            I = course_add(I, f * pow(course_plus(d3_dot(v.n, v.h)), n_s), s.material.specular,
                           I_L);
        }
        if (unsure) continue;
        sure++;
        s.lighting = uw(s.lamp, s.lighting.light_count);
        course_check(__LINE__, "iteration four", &s, I);
    }
    CHECK_SAY(sure > 9900 && in_cone > 2000, "%d sure, %d in a cone", sure, in_cone);
}

/* -------------------------------------------------------------------------------------- Massey */

static d3 massey_in_double(const course_sample *s, shade_vec3 I_a, int blinn)
{
    d3 I = course_add(d3_of(0, 0, 0), 1, s->material.ambient, I_a);
    for (int j = 0; j < s->lighting.light_count; j++) {
        course_vectors v = course_vectors_of(s, j);
        double cosine = blinn ? d3_dot(v.n, v.h) : d3_dot(v.r, v.e);
        I = course_add(I, course_plus(d3_dot(v.l, v.n)), s->material.diffuse, s->lamp[j].diffuse);
        I = course_add(I, pow(course_plus(cosine), (double)s->material.shininess),
                       s->material.specular, s->lamp[j].specular);
    }
    return I;
}

TEST(recipes, massey_phong_and_blinn_phong)
{
    course_sample s;
    for (int i = 0; i < COURSE_SAMPLES; i++) {
        course_random(&s);
        s.material.emission = shade_v3(0, 0, 0);
        for (int j = 0; j < s.lighting.light_count; j++) s.lamp[j].specular = random_color(1);
        s.lighting = massey(s.lamp, s.lighting.light_count, random_color(1));
        course_check(__LINE__, "Phong", &s, massey_in_double(&s, s.lighting.ambient, 0));
        s.lighting.model = SHADE_MODEL_BLINN_PHONG;
        course_check(__LINE__, "Blinn-Phong", &s, massey_in_double(&s, s.lighting.ambient, 1));
    }
}

/* ------------------------------------------------------------------------------------- Shirley */

TEST(recipes, shirley_10_3_to_10_9)
{
    const shade_vec3 none = { 0, 0, 0 }, one = { 1, 1, 1 };
    course_sample s;
    for (int i = 0; i < COURSE_SAMPLES; i++) {
        course_random(&s);
        course_vectors v = course_vectors_of(&s, 0);
        double cosine = d3_dot(v.n, v.l), p = (double)s.material.shininess;
        double e_r = pow(course_plus(d3_dot(v.e, v.r)), p);
        double h_n = pow(course_plus(d3_dot(v.h, v.n)), p);
        shade_vec3 c_r = random_color(1), c_l = s.lamp[0].diffuse, c_p = s.material.specular;
        shade_vec3 c_a = random_color(1);
        d3 zero = d3_of(0, 0, 0), lambert = course_add(zero, course_plus(cosine), c_r, c_l);
        d3 lit = d3_add(course_add(zero, 1, c_r, c_a), lambert);
        s.lighting = shirley(s.lamp, none);
        s.material = shirley_surface(c_r, c_p, (float)p);

        s.lighting.model = SHADE_MODEL_LAMBERT;
        course_check(__LINE__, "(10.3)", &s, lambert);
        s.lighting.flags |= SHADE_FLAG_TWO_SIDED_ABS;
        course_check(__LINE__, "(10.4)", &s, course_add(zero, fabs(cosine), c_r, c_l));
        s.lighting = shirley(s.lamp, c_a);
        s.lighting.model = SHADE_MODEL_LAMBERT;
        course_check(__LINE__, "c_r (c_a + c_l n.l)", &s, lit);
        s.lighting = shirley(s.lamp, c_a);
        course_check(__LINE__, "(10.9)", &s, course_add(lit, h_n, c_l, c_p));
        s.material.specular = one;
        course_check(__LINE__, "(10.8)", &s, course_add(lit, h_n, c_l, one));
        s.lighting.terms = SHADE_TERM_SPECULAR;
        course_check(__LINE__, "(10.7)", &s, course_add(zero, h_n, c_l, one));
        s.lighting.model = SHADE_MODEL_PHONG;
        course_check(__LINE__, "(10.5)", &s, course_add(zero, e_r, c_l, one));
        CHECK_VEC(shade_mirror(d3_round(v.l), s.N), v.r, 1e-6); /* (10.6) */
    }
}

/* ------------------------------------------------------------------------------------ Berkeley */

TEST(recipes, berkeley_sum_over_lights)
{
    course_sample s;
    for (int i = 0; i < COURSE_SAMPLES; i++) {
        course_random(&s);
        d3 R = d3_of(0, 0, 0);
        for (int j = 0; j < s.lighting.light_count; j++) {
            course_vectors v = course_vectors_of(&s, j);
            shade_vec3 I = s.lamp[j].diffuse;
            double cosine = course_plus(d3_dot(v.r, v.e)), p = (double)s.material.shininess;
            R = course_add(R, 1, s.material.ambient, I);
            R = course_add(R, course_plus(d3_dot(v.l, v.n)), s.material.diffuse, I);
            R = course_add(R, pow(cosine, p), s.material.specular, I);
        }
        s.material.emission = shade_v3(0, 0, 0);
        s.lighting = berkeley(s.lamp, s.lighting.light_count);
        course_check(__LINE__, "R", &s, R);
    }
}

/* ---------------------------------------------------------------------------------------- traps */

/* r = l - 2 (l.n) n, l toward the light, points below the surface: it is -R. */
TEST(recipes, massey_printed_r_is_minus_the_mirror_direction)
{
    for (int i = 0; i < 1000; i++) {
        d3 n = rnd_direction(), l = rnd_direction();
        d3 printed = d3_sub(l, d3_scale(n, 2 * d3_dot(l, n)));
        CHECK_VEC(shade_mirror(d3_round(l), d3_round(n)), d3_scale(printed, -1), 1e-6);
        CHECK_NEAR(d3_dot(printed, n), -d3_dot(l, n), 1e-12);
    }
}

/* v = normalize(-(View * Model * position)) of a vec4 keeps its w = -1: r.v is short by as much. */
TEST(recipes, a_vec4_made_unit_is_too_short_a_view_vector)
{
    double x = 4 / sqrt(4 * 4 + 1), alpha = 27.89743616;
    CHECK_NEAR(pow(x, alpha), 0.43, 0.005);
    CHECK_NEAR(shade_power((float)x, (float)alpha), pow(x, alpha), 1e-5);
}

/* The angle N H is half of R V while V stays in the plane of N and L.  Across it, it is 1 / cos of
   the angle of incidence as much: V one degree beside R at 80 degrees has its H 2.9 off N. */
TEST(recipes, half_the_angle_in_one_plane_only)
{
    const double degree = acos(-1.0) / 180;
    for (int theta = 10; theta <= 80; theta += 10) {
        double s = sin(theta * degree), c = cos(theta * degree), t = (theta - 20) * degree;
        shade_vec3 L = d3_round(d3_of(-s, 0, c)), V = d3_round(d3_of(sin(t), 0, cos(t)));
        d3 H = d3_from(shade_halfway(L, V));
        CHECK_NEAR(atan2(hypot(H.x, H.y), H.z) / degree, 10, 1e-4);
        V = d3_round(d3_of(s * cos(degree), 0, c));
        V.y = (float)sin(degree);
        H = d3_from(shade_halfway(L, d3_round(d3_unit(d3_from(V)))));
        CHECK_NEAR(atan2(hypot(H.x, H.y), H.z) / degree, 0.5 / c, 0.01 / c);
    }
}

/* White light, white mirror, n = 60, a square of side 2 seen straight on through a camera 4 away
   that sees it all: V differs by pixel unless INFINITE_VIEWER says that it does not. */
TEST(recipes, an_orthographic_camera_has_a_viewer_at_infinity)
{
    enum { SIDE = 80 };
    static const float corners[18] = { -1, -1, 0, 1, -1, 0, 1, 1, 0, -1, -1, 0, 1, 1, 0, -1, 1, 0 };
    static unsigned char rgba[SIDE * SIDE][4];
    shade_light light = shade_directional_light(shade_v3(0, 0, -1), shade_v3(1, 1, 1));
    shade_material mirror = { 0 };
    shade_draw_state state = { 0 };
    shade_target target = { 0 };
    shade_mesh mesh = { 0 };
    mirror.specular = shade_v3(1, 1, 1);
    mirror.shininess = 60;
    target.width = target.height = SIDE;
    target.color = rgba;
    mesh.positions = corners;
    mesh.vertex_count = 6;
    state.view = shade_mat4_look_at(shade_v3(0, 0, 4), shade_v3(0, 0, 0), shade_v3(0, 1, 0));
    state.projection = shade_mat4_ortho(-1, 1, -1, 1, 1, 10);
    state.material = &mirror;
    state.lighting.lights = &light;
    state.lighting.light_count = 1;
    for (int infinite = 0; infinite < 2; infinite++) {
        state.lighting.flags = infinite ? SHADE_FLAG_INFINITE_VIEWER : 0;
        CHECK_INT(shade_draw_mesh(&target, &mesh, &state, NULL), SHADE_OK);
        CHECK_INT(rgba[SIDE / 2 * SIDE + SIDE / 2][0], 255);
        CHECK_INT(rgba[0][0], infinite ? 255 : 109);
    }
}

/* w = 1 is a point, w = 0 a direction; a headlight is a point light where the eye is. */
TEST(recipes, headlight_and_w)
{
    shade_vec3 eye = { 1, 2, 3 }, P = { 0, 0, 0 }, L;
    shade_light lamp = shade_point_light(eye, shade_v3(1, 1, 1));
    d3 V = d3_unit(d3_from(eye));
    CHECK_NEAR(lamp.position.w, 1, 0);
    shade_light_at(&lamp, P, &L, NULL);
    CHECK_VEC(L, V, 1e-6);
    lamp = shade_directional_light(shade_neg(eye), shade_v3(1, 1, 1));
    CHECK_NEAR(lamp.position.w, 0, 0);
    shade_light_at(&lamp, shade_v3(5, 5, 5), &L, NULL);
    CHECK_VEC(L, V, 1e-6);
}
