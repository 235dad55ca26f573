/* samples.h - random vectors and matrices, random lights and materials, and points that they
   light; triangles and clip rectangles to draw, and who covers their pixels. */
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

/* ---------------------------------------------------------------- triangles and clip rectangles */

static const shade_vec4 clip_corners[3] = { { -1, -1, 0, 1 }, { 1, -1, 0, 1 }, { 0, 1, 0, 1 } };

/* The part of the picture the clip rectangle leaves: x0 <= x < x1, y0 <= y < y1. */
static inline void clip_bounds(const shade_target *t, int *x0, int *y0, int *x1, int *y1)
{
    *x0 = 0;
    *y0 = 0;
    *x1 = t->width;
    *y1 = t->height;
    if (t->clip_x || t->clip_y || t->clip_width || t->clip_height) {
        int64_t right = (int64_t)t->clip_x + t->clip_width,
                below = (int64_t)t->clip_y + t->clip_height;
        if (t->clip_x > *x0) *x0 = t->clip_x;
        if (t->clip_y > *y0) *y0 = t->clip_y;
        if (right < *x1) *x1 = (int)right;
        if (below < *y1) *y1 = (int)below;
    }
}

static inline void random_clip(shade_target *t)
{
    switch (rnd_int(0, 5)) {
    case 0:
        break; /* everywhere */
    case 1:
        t->clip_x = rnd_int(0, t->width - 1);
        t->clip_y = rnd_int(0, t->height - 1);
        t->clip_width = rnd_int(1, 7);
        t->clip_height = rnd_int(1, t->height);
        break;
    case 2:
        t->clip_y = rnd_int(0, t->height - 1);
        t->clip_width = t->width;
        t->clip_height = rnd_int(1, 9);
        break;
    case 3:
        t->clip_x = -rnd_int(1, 9);
        t->clip_y = -rnd_int(1, 9);
        t->clip_width = rnd_int(0, t->width + 20);
        t->clip_height = rnd_int(0, t->height + 20);
        break;
    default:
        t->clip_x = rnd_int(-3, t->width + 3);
        t->clip_y = rnd_int(-3, t->height + 3);
        t->clip_width = rnd_int(0, t->width);
        t->clip_height = rnd_int(0, t->height);
    }
}

/* A corner set of a stated kind in a width x height picture, coordinates in 1/256 pixel within the
   guard band. */
static inline void random_corners(int kind, int width, int height, int64_t x[3], int64_t y[3])
{
    static const int widths[] = { 1, 7, 8, 9, 15, 16, 17, 18, 31, 32, 33, 64, 65 };
    int cx = rnd_int(-256, width * 256 + 256), cy = rnd_int(-256, height * 256 + 256), size;
    for (int k = 0; k < 3; k++) {
        switch (kind) {
        case 0:
            x[k] = cx + rnd_int(-256, 256);
            y[k] = cy + rnd_int(-256, 256);
            break;
        case 1:
            x[k] = cx + rnd_int(-3000, 3000);
            y[k] = cy + rnd_int(-3000, 3000);
            break;
        case 2:
            x[k] = rnd_int(-width * 128, width * 384);
            y[k] = rnd_int(-height * 128, height * 384);
            break;
        case 3:
            x[k] = rnd_int(0, 2 * width) * 128;
            y[k] = rnd_int(0, 2 * height) * 128;
            break;
        case 4: /* upright boxes of widths around 8, 16, 32, halved */
            size = widths[(cx & 255) % 13] * 256 + (k == 1 ? rnd_int(-130, 130) : 0);
            x[k] = cx + (k == 1 ? size : 0);
            y[k] = cy + (k == 2 ? rnd_int(0, 9000) : rnd_int(-64, 64));
            break;
        case 5: /* slivers: a long line and a point beside it */
            x[k] = k == 2 ? (x[0] + x[1]) / 2 + rnd_int(-40, 40) : rnd_int(0, width * 256);
            y[k] = k == 2 ? (y[0] + y[1]) / 2 + rnd_int(-40, 40) : rnd_int(0, height * 256);
            break;
        default:
            x[k] = rnd_int(-width * 255, width * 511);
            y[k] = rnd_int(-height * 255, height * 511);
        }
    }
    for (int k = 0; k < 3; k++) { /* within 3 w, where nothing is clipped */
        x[k] = x[k] < -width * 255 ? -width * 255 : x[k] > width * 511 ? width * 511 : x[k];
        y[k] = y[k] < -height * 255 ? -height * 255 : y[k] > height * 511 ? height * 511 : y[k];
    }
}

/* A grid of n x n squares with jittered inner points, in a plane given by its two axes; every
   square split along a random diagonal, the corners of each triangle in random rotation and
   winding. */
static inline int jittered_grid(int n, shade_vec2 *points, uint32_t *indices)
{
    int count = 0;
    for (int y = 0; y <= n; y++)
        for (int x = 0; x <= n; x++) {
            int inner = x > 0 && y > 0 && x < n && y < n;
            points[y * (n + 1) + x] =
                shade_v2((float)x / (float)n + (inner ? rnd_float(-0.3, 0.3) / (float)n : 0),
                         (float)y / (float)n + (inner ? rnd_float(-0.3, 0.3) / (float)n : 0));
        }
    for (int y = 0; y < n; y++) {
        for (int x = 0; x < n; x++) {
            uint32_t q[4], a = (uint32_t)(y * (n + 1) + x);
            q[0] = a;
            q[1] = a + 1;
            q[2] = a + (uint32_t)n + 2;
            q[3] = a + (uint32_t)n + 1;
            /* the diagonal must lie inside the quadrilateral: take the one whose two halves turn
               the same way */
            shade_vec2 p[4];
            for (int k = 0; k < 4; k++) p[k] = points[q[k]];
            int first = rnd_int(0, 1);
            for (int attempt = 0; attempt < 2; attempt++, first ^= 1) {
                shade_vec2 d = shade_sub2(p[first + 2], p[first]);
                shade_vec2 e = shade_sub2(p[first + 1], p[first]),
                           f = shade_sub2(p[(first + 3) % 4], p[first]);
                double se = (double)d.x * (double)e.y - (double)d.y * (double)e.x;
                double sf = (double)d.x * (double)f.y - (double)d.y * (double)f.x;
                if (se * sf < 0) break;
            }
            first &= 1;
            for (int half = 0; half < 2; half++) {
                uint32_t t[3];
                t[0] = q[first];
                t[1] = q[(first + 1 + half) % 4];
                t[2] = q[(first + 2 + half) % 4];
                int turn = rnd_int(0, 2), swap = rnd_int(0, 1);
                for (int k = 0; k < 3; k++) indices[count++] = t[((swap ? 3 - k : k) + turn) % 3];
            }
        }
    }
    return count;
}

/* How often each pixel is covered, counted by SHADE_BLEND_ADD of one. */
static inline void count_coverage(canvas *c, const shade_vec4 *clip, const uint32_t *indices,
                                  int count, int vertices)
{
    scene s = { clip, NULL, 0, NULL, NULL };
    shade_pipeline p = scene_pipeline(&s);
    p.raster.blend = SHADE_BLEND_ADD;
    canvas_clear(c, 1);
    CHECK_INT(shade_draw(&c->target, &p, indices, count, vertices, NULL), SHADE_OK);
}

/* Whether the triangles of a mesh within a square fill it without a fold. */
static inline int covers_square(const int64_t *x, const int64_t *y, const uint32_t *indices,
                                int count, int64_t side)
{
    int64_t all = 0;
    for (int k = 0; k < count; k += 3) {
        uint32_t a = indices[k], b = indices[k + 1], d = indices[k + 2];
        int64_t area = (x[b] - x[a]) * (y[d] - y[a]) - (y[b] - y[a]) * (x[d] - x[a]);
        all += area < 0 ? -area : area;
    }
    return all == 2 * side * side;
}

/* A triangle of eye space through a perspective camera: some corners behind the eye, some far out.
   */
static inline void random_eye_triangle(shade_vec4 v[3], int zero_to_one, double spread)
{
    double near_z = 0.25, far_z = 20;
    for (int k = 0; k < 3; k++) {
        double ez = (double)rnd_float(-30, 8), x = (double)rnd_float(-spread, spread);
        double y = (double)rnd_float(-spread, spread);
        if (rnd_one_in(4)) ez = (double)rnd_float(-2, 0.5);
        double a = zero_to_one ? -far_z / (far_z - near_z) : -(far_z + near_z) / (far_z - near_z);
        double b = (zero_to_one ? -1 : -2) * far_z * near_z / (far_z - near_z);
        v[k] = shade_v4((float)(1.5 * x), (float)(1.5 * y), (float)(a * ez + b), (float)-ez);
    }
}

/* Corners in front of the eye, some of them outside of planes of one kind: 0 near, 1 far, 2 the
   guard band, 3 any. */
static inline void random_cut_triangle(int kind, int zero_to_one, shade_vec4 v[3])
{
    for (int k = 0; k < 3; k++) {
        double w = (double)rnd_log(0.2, 5), x = (double)rnd_float(-1.5, 1.5);
        double y = (double)rnd_float(-1.5, 1.5);
        double z = (double)rnd_float(zero_to_one ? 0.05 : -0.9, 0.9);
        int out = rnd_one_in(2) ? kind == 3 ? rnd_int(0, 2) : kind : -1;
        if (out == 0) z = zero_to_one ? -(double)rnd_log(0.01, 20) : -(double)rnd_log(1.01, 20);
        if (out == 1) z = (double)rnd_log(1.01, 20);
        if (out == 2 && rnd_one_in(2))
            x = (double)(rnd_sign() * rnd_log(3.1, 300));
        else if (out == 2)
            y = (double)(rnd_sign() * rnd_log(3.1, 300));
        v[k] = shade_v4((float)(x * w), (float)(y * w), (float)(z * w), (float)w);
    }
}

static inline void fragment_sieve(const void *uniforms, const shade_fragments *SHADE_RESTRICT in,
                                  shade_colors *SHADE_RESTRICT out)
{
    const scene *s = (const scene *)uniforms;
    if (s->record) scene_record_fragments(s, in);
    for (int i = 0; i < SHADE_LANES; i++) {
        int x = (int)in->x[i], y = (int)in->y[i];
        out->color[0][i] = s->color[in->primitive[i]].x;
        out->color[3][i] = 1;
        out->discard[i] = (x * 7 + y * 5 + (int)in->primitive[i]) % 3 == 0 ? 0x80000000u : 0;
    }
}

static inline int stats_add_up(const shade_stats *s, int triangles)
{
    return s->triangles == triangles && s->culled >= 0 && s->clipped >= 0 && s->rejected >= 0 &&
           s->drawn >= 0 && s->fragments >= 0 &&
           s->culled + s->clipped + s->rejected + s->drawn == s->triangles;
}

#endif
