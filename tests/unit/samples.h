/* samples.h - random vectors and matrices, random lights and materials, and points that they
   light. */
#ifndef SAMPLES_H
#define SAMPLES_H

/* -------------------------------------------------------------------------------------- vectors */

static inline void put3(float *at, shade_vec3 v)
{
    at[0] = v.x;
    at[1] = v.y;
    at[2] = v.z;
}

static inline shade_vec3 grey(double v) { return shade_v3((float)v, (float)v, (float)v); }

static inline shade_vec3 random_vector(double size)
{
    return shade_v3(rnd_float(-size, size), rnd_float(-size, size), rnd_float(-size, size));
}

static inline int finite3(shade_vec3 v) { return isfinite(v.x) && isfinite(v.y) && isfinite(v.z); }

#define CHECK_VEC(got, want, within)                                                               \
    do {                                                                                           \
        shade_vec3 check_got = (got);                                                              \
        d3 check_want = (want);                                                                    \
        CHECK_NEAR(check_got.x, check_want.x, within);                                             \
        CHECK_NEAR(check_got.y, check_want.y, within);                                             \
        CHECK_NEAR(check_got.z, check_want.z, within);                                             \
    } while (0)

static inline shade_mat4 random_mat4(double size)
{
    shade_mat4 m;
    for (int c = 0; c < 4; c++) {
        m.col[c] = shade_v4(rnd_float(-size, size), rnd_float(-size, size), rnd_float(-size, size),
                            rnd_float(-size, size));
    }
    return m;
}

static inline int finite_mat4(shade_mat4 m)
{
    for (int c = 0; c < 4; c++) {
        if (!isfinite(m.col[c].x) || !isfinite(m.col[c].y)) return 0;
        if (!isfinite(m.col[c].z) || !isfinite(m.col[c].w)) return 0;
    }
    return 1;
}

static inline dmat matrix_or_identity(shade_mat4 m)
{
    dmat d = dmat_from(m);
    return dmat_max(d) == 0 ? dmat_identity() : d;
}

/* Projections that are none: perspective, reversed, frustum, ortho, and their arguments.  Each row
   breaks one rule: an angle in (0, pi), an aspect above 0, near and far above 0 and apart, left and
   right as well as bottom and top apart, all finite, also what the matrix holds. */
#define FLOAT_ABOVE_PI 3.14159274f

static const struct {
    char kind;
    float v[6];
} degenerate_cameras[] = {
    { 'p', { 1, 1, 2, 2 } },
    { 'p', { 1, 0, 1, 2 } },
    { 'p', { 1, -0.0f, 1, 2 } },
    { 'p', { 0, 1, 1, 2 } },
    { 'p', { -1, 1, 1, 2 } },
    { 'p', { -7, 1, 1, 2 } },
    { 'p', { FLOAT_ABOVE_PI, 1, 1, 2 } },
    { 'p', { 2 * FLOAT_ABOVE_PI, 1, 1, 2 } },
    { 'p', { 2 * FLOAT_ABOVE_PI + 1, 1, 1, 2 } },
    { 'p', { 100, 1, 1, 2 } },
    { 'p', { INFINITY, 1, 1, 2 } },
    { 'p', { 1, 1, 0, 2 } },
    { 'p', { 1, 1, -1, 2 } },
    { 'p', { 1, 1, -2, -1 } },
    { 'p', { 1, 1, 1, 0 } },
    { 'p', { 1, 1, 1, -2 } },
    { 'p', { NAN, 1, 1, 2 } },
    { 'p', { 1, NAN, 1, 2 } },
    { 'p', { 1, 1, NAN, 2 } },
    { 'p', { 1, 1, 1, NAN } },
    { 'p', { 1e-45f, 1, 1, 2 } },
    { 'p', { 1, 1e-45f, 1, 2 } },
    { 'p', { 1, 1, 3e38f, 2.9e38f } },
    { 'r', { 1, 0, 1 } },
    { 'r', { 0, 1, 1 } },
    { 'r', { -1, 1, 1 } },
    { 'r', { FLOAT_ABOVE_PI, 1, 1 } },
    { 'r', { 2 * FLOAT_ABOVE_PI + 1, 1, 1 } },
    { 'r', { INFINITY, 1, 1 } },
    { 'r', { 1, 1, 0 } },
    { 'r', { 1, 1, -1 } },
    { 'r', { NAN, 1, 1 } },
    { 'r', { 1, NAN, 1 } },
    { 'r', { 1, -INFINITY, 1 } },
    { 'p', { 1, INFINITY, 1, 9 } },
    { 'r', { 1, 1, NAN } },
    { 'r', { 1, 1e-45f, 1 } },
    { 'f', { 1, 1, -1, 1, 1, 9 } },
    { 'f', { -1, 1, 1, 1, 1, 9 } },
    { 'f', { -1, 1, -1, 1, 9, 9 } },
    { 'f', { -1, 1, -1, 1, 0, 9 } },
    { 'f', { -1, 1, -1, 1, -1, 9 } },
    { 'f', { -1, 1, -1, 1, 1, 0 } },
    { 'f', { -1, 1, -1, 1, 1, -9 } },
    { 'f', { -1, 1, -1, 1, -1, -9 } },
    { 'f', { NAN, 1, -1, 1, 1, 9 } },
    { 'f', { -1, NAN, -1, 1, 1, 9 } },
    { 'f', { -1, 1, NAN, 1, 1, 9 } },
    { 'f', { -1, 1, -1, NAN, 1, 9 } },
    { 'f', { -1, 1, -1, 1, NAN, 9 } },
    { 'f', { -1, 1, -1, 1, 1, NAN } },
    { 'f', { 0, 1e-45f, -1, 1, 1, 9 } },
    { 'f', { 0, 0.1f, -1, 1, 3e38f, 9 } },
    { 'o', { 1, 1, -1, 1, 1, 9 } },
    { 'o', { -1, 1, 1, 1, 1, 9 } },
    { 'o', { -1, 1, -1, 1, 9, 9 } },
    { 'o', { -1, 1, -1, 1, 0, 0 } },
    { 'o', { NAN, 1, -1, 1, 1, 9 } },
    { 'o', { -1, NAN, -1, 1, 1, 9 } },
    { 'o', { -1, 1, NAN, 1, 1, 9 } },
    { 'o', { -1, 1, -1, NAN, 1, 9 } },
    { 'o', { -1, 1, -1, 1, NAN, 9 } },
    { 'o', { -1, 1, -1, 1, 1, NAN } },
    { 'o', { 0, 1e-45f, -1, 1, 1, 9 } },
};

enum { DEGENERATE_CAMERAS = sizeof degenerate_cameras / sizeof degenerate_cameras[0] };

static inline shade_mat4 degenerate_camera(int k)
{
    const float *v = degenerate_cameras[k].v;
    switch (degenerate_cameras[k].kind) {
    case 'p': return shade_mat4_perspective(v[0], v[1], v[2], v[3]);
    case 'r': return shade_mat4_perspective_reversed(v[0], v[1], v[2]);
    case 'f': return shade_mat4_frustum(v[0], v[1], v[2], v[3], v[4], v[5]);
    default: return shade_mat4_ortho(v[0], v[1], v[2], v[3], v[4], v[5]);
    }
}

/* --------------------------------------------------------------------------------------- lights */

static inline shade_vec3 random_color(double most)
{
    return shade_v3(rnd_float(0, most), rnd_float(0, most), rnd_float(0, most));
}

static inline float random_exponent(void)
{
    switch (rnd_int(0, 7)) {
    case 0: return 0;
    case 1: return rnd_float(0, 1);
    case 2: return rnd_float(1, 10);
    case 3: return (float)(1 << rnd_int(0, 8));
    case 4: return rnd_log(100, 1e4);
    case 5: return 1e4f;
    default: return rnd_float(1, 128);
    }
}

static inline shade_material random_material(void)
{
    shade_material m;
    m.emission = rnd_one_in(2) ? random_color(1) : shade_v3(0, 0, 0);
    m.ambient = random_color(1);
    m.diffuse = random_color(1);
    m.specular = random_color(1);
    m.shininess = rnd_one_in(20) ? -3 : random_exponent();
    return m;
}

/* A lamp seen from P.  Lamps with w other than 0 and 1 stay within 50 times their distance of the
   origin, for xyz/w is rounded once and a farther one would lose its direction to that rounding. */
static inline shade_light random_light(shade_vec3 P, double size)
{
    shade_light light = { 0 };
    double bright = rnd_one_in(3) ? (double)rnd_log(1e-3, 1e6) : 2;
    light.diffuse = random_color(bright);
    light.specular = rnd_one_in(2) ? light.diffuse : random_color(bright);
    if (rnd_one_in(2)) light.ambient = random_color(bright / 4);
    shade_vec3 p =
        d3_round(d3_add(d3_from(P), d3_scale(rnd_direction(), (double)rnd_log(1e-2, 1) * size)));
    int kind = rnd_int(0, 3);
    light.position = shade_v4(p.x, p.y, p.z, 1);
    if (kind == 0) {
        d3 d = d3_scale(rnd_direction(), (double)rnd_log(1e-3, 1e6));
        light.position = shade_v4((float)d.x, (float)d.y, (float)d.z, 0);
    } else if (kind == 1) {
        double r = d3_length(d3_sub(d3_from(p), d3_from(P)));
        float w = r * 50 > d3_length(d3_from(p)) ? rnd_sign() * rnd_log(0.1, 10) : 1;
        light.position = shade_v4(p.x * w, p.y * w, p.z * w, w);
    }
    switch (rnd_int(0, 6)) {
    case 0: break;
    case 1:
        light.constant = 1;
        break;
    case 2:
        light.quadratic = 1;
        break;
    case 3:
        light.linear = rnd_log(1e-3, 10);
        break;
    case 4:
        light.constant = 1;
        light.linear = 0.5f;
        light.quadratic = 0.25f;
        break;
    case 5:
        light.linear = rnd_log(1e-3, 10);
        light.quadratic = rnd_log(1e-3, 10);
        break;
    default:
        light.constant = rnd_log(1e-3, 10);
        light.linear = rnd_log(1e-6, 10);
        light.quadratic = rnd_log(1e-6, 10);
    }
    if (rnd_one_in(2)) return light;
    double r;
    d3 L = ref_to_light(&light, d3_from(P), &r); /* often lit, so aimed roughly at P */
    d3 aim = d3_add(d3_scale(L, -1), d3_scale(rnd_direction(), (double)rnd_float(0, 1.2)));
    if (rnd_one_in(8)) aim = rnd_direction();
    light.spot_direction = d3_round(d3_scale(aim, (double)rnd_log(1e-3, 1e3)));
    light.spot_exponent = random_exponent();
    light.spot_cos_cutoff = rnd_one_in(4) ? rnd_float(-1, 1) : rnd_float(0.3, 1);
    return light;
}

typedef struct light_sample {
    shade_lighting lighting;
    shade_light lights[4];
    shade_material material;
    shade_vec3 P, N, eye;
} light_sample;

static inline void random_sample(light_sample *s)
{
    memset(s, 0, sizeof *s);
    double size = (double)rnd_log(1e-2, 1e6);
    s->P = rnd_one_in(4) ? shade_v3(0, 0, 0) : random_vector(size);
    s->N = d3_round(d3_scale(rnd_direction(), rnd_one_in(2) ? 1 : (double)rnd_log(1e-6, 1e6)));
    s->material = random_material();
    int count = rnd_one_in(10) ? 0 : rnd_int(1, 4);
    for (int k = 0; k < count; k++) s->lights[k] = random_light(s->P, size);
    s->lighting.lights = s->lights;
    s->lighting.light_count = count;
    s->lighting.ambient = rnd_one_in(2) ? random_color(1) : shade_v3(0, 0, 0);
    s->lighting.model = (shade_model)(rnd_one_in(2) ? rnd_int(0, 1) : rnd_int(0, 5));
    s->lighting.flags = rnd_one_in(3) ? 0 : (unsigned)rnd_int(0, 63);
    s->lighting.terms = rnd_one_in(2) ? 0 : (unsigned)rnd_int(0, 15);
    if (s->lighting.model == SHADE_MODEL_COOL_TO_WARM) {
        s->lighting.flags &= ~(unsigned)SHADE_FLAG_TWO_SIDED_ABS;
        if (rnd_one_in(2)) s->lighting.cool = random_color(1);
        if (rnd_one_in(2)) s->lighting.warm = random_color(1);
    }
    /* the viewer: anywhere, or near the mirror direction of the first lamp, where highlights are */
    d3 V = rnd_direction();
    if (count && rnd_one_in(2)) {
        double r;
        d3 n = d3_unit(d3_from(s->N)), L = ref_to_light(&s->lights[0], d3_from(s->P), &r);
        d3 R = d3_sub(d3_scale(n, 2 * d3_dot(n, L)), L);
        V = d3_unit(d3_add(R, d3_scale(rnd_direction(), (double)rnd_log(1e-3, 1))));
    }
    d3 from = s->lighting.flags & SHADE_FLAG_INFINITE_VIEWER ? d3_of(0, 0, 0) : d3_from(s->P);
    s->eye = d3_round(d3_add(from, d3_scale(V, size * (double)rnd_log(1e-2, 1))));
}

static inline ref_lit ref_of_sample(const light_sample *s)
{
    return ref_light(&s->lighting, &s->material, d3_from(s->P), d3_from(s->N), d3_from(s->eye),
                     d3_of(1, 1, 1));
}

static inline void print_lights(const light_sample *s)
{
    if (test_now.failures > TEST_MAX_PRINTED) return;
    printf("    model %d, flags %u, terms %u, n %g\n", (int)s->lighting.model, s->lighting.flags,
           s->lighting.terms, (double)s->material.shininess);
    printf("    P %a %a %a  N %a %a %a  eye %a %a %a\n", (double)s->P.x, (double)s->P.y,
           (double)s->P.z, (double)s->N.x, (double)s->N.y, (double)s->N.z, (double)s->eye.x,
           (double)s->eye.y, (double)s->eye.z);
    for (int k = 0; k < s->lighting.light_count; k++) {
        const shade_light *l = &s->lights[k];
        printf("    light %d at %a %a %a %a  a b c %g %g %g  I_d %g %g %g\n", k,
               (double)l->position.x, (double)l->position.y, (double)l->position.z,
               (double)l->position.w, (double)l->constant, (double)l->linear, (double)l->quadratic,
               (double)l->diffuse.x, (double)l->diffuse.y, (double)l->diffuse.z);
        printf("      spot %a %a %a  e %g  cos %.9g\n", (double)l->spot_direction.x,
               (double)l->spot_direction.y, (double)l->spot_direction.z, (double)l->spot_exponent,
               (double)l->spot_cos_cutoff);
    }
}

static inline int check_color(int line, const char *what, shade_vec3 got, d3 want, double within)
{
    d3 error = d3_sub(d3_from(got), want);
    test_now.checks++;
    if (d3_max(error) <= within) return 1; /* false for NaN */
    test_fail(__FILE__, line, what, "got (%.9g %.9g %.9g), want (%.9g %.9g %.9g) within %.3g",
              (double)got.x, (double)got.y, (double)got.z, want.x, want.y, want.z, within);
    return 0;
}

static inline shade_material teapot_brass(void) /* [Kilgard94] */
{
    shade_material m;
    m.emission = grey(0);
    m.ambient = shade_v3(0.329412f, 0.223529f, 0.027451f);
    m.diffuse = shade_v3(0.780392f, 0.568627f, 0.113725f);
    m.specular = shade_v3(0.992157f, 0.941176f, 0.807843f);
    m.shininess = 27.89743616f;
    return m;
}

static inline void fill_nasty(void *memory, size_t bytes) /* floats, one in three nasty */
{
    unsigned char *at = (unsigned char *)memory;
    for (size_t i = 0; i + 4 <= bytes; i += 4) {
        float f = rnd_one_in(3) ? rnd_nasty() : rnd_float(-2, 2);
        memcpy(at + i, &f, 4);
    }
}

/* In double; the amount and its allowed error. */
typedef struct ref_arrival {
    double amount, distance, bound;
    d3 L;
    int unsure;
} ref_arrival;

static inline ref_arrival ref_arriving(const shade_light *light, d3 P)
{
    double e = (double)light->spot_exponent;
    ref_arrival a = { 0 };
    a.L = ref_to_light(light, P, &a.distance);
    a.amount = 1;
    if (light->position.w != 0)
        a.amount = ref_attenuation((double)light->constant, (double)light->linear,
                                   (double)light->quadratic, a.distance);
    a.amount *=
        ref_spot(a.L, d3_from(light->spot_direction), (double)light->spot_cos_cutoff, e, &a.unsure);
    a.bound = 5e-5 * fmax(1, a.amount) * fmax(1, e / 100);
    return a;
}

typedef struct lane_packet {
    float P[3][SHADE_LANES], N[3][SHADE_LANES], albedo[3][SHADE_LANES];
    shade_vec3 p[SHADE_LANES], n[SHADE_LANES], a[SHADE_LANES];
} lane_packet;

static inline void lane_set(float rows[3][SHADE_LANES], int i, shade_vec3 v)
{
    rows[0][i] = v.x;
    rows[1][i] = v.y;
    rows[2][i] = v.z;
}

/* Points around the sample's, some of them its very own. */
static inline void random_packet(lane_packet *k, const light_sample *s, double size)
{
    for (int i = 0; i < SHADE_LANES; i++) {
        d3 away = d3_scale(rnd_direction(), size * (double)rnd_log(1e-4, 1));
        k->p[i] = rnd_one_in(8) ? s->P : d3_round(d3_add(d3_from(s->P), away));
        d3 turned = d3_add(d3_unit(d3_from(s->N)), d3_scale(rnd_direction(), rnd_unit()));
        k->n[i] = rnd_one_in(8) ? s->N : d3_round(turned);
        if (rnd_one_in(100)) k->n[i] = shade_v3(0, 0, 0);
        k->a[i] = random_color(1);
        lane_set(k->P, i, k->p[i]);
        lane_set(k->N, i, k->n[i]);
        lane_set(k->albedo, i, k->a[i]);
    }
}

#endif
