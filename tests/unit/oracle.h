/* oracle.h - the same mathematics in double precision, written apart from shade.h and sharing no
   code with it. Only the structs of its interface are read. */
#ifndef ORACLE_H
#define ORACLE_H

/* -------------------------------------------------------------------------------------- vectors */

typedef struct d3 {
    double x, y, z;
} d3;

static inline d3 d3_of(double x, double y, double z)
{
    d3 v;
    v.x = x;
    v.y = y;
    v.z = z;
    return v;
}

/* Coordinate 0, 1 or 2 of a vector, and the vector with another one there. */
static inline float coordinate(shade_vec3 p, int axis)
{
    return axis == 0 ? p.x : axis == 1 ? p.y : p.z;
}
static inline shade_vec3 with_axis(shade_vec3 p, int axis, float value)
{
    if (axis == 0) p.x = value;
    if (axis == 1) p.y = value;
    if (axis == 2) p.z = value;
    return p;
}

static inline d3 d3_from(shade_vec3 v) { return d3_of((double)v.x, (double)v.y, (double)v.z); }
static inline d3 d3_add(d3 a, d3 b) { return d3_of(a.x + b.x, a.y + b.y, a.z + b.z); }
static inline d3 d3_sub(d3 a, d3 b) { return d3_of(a.x - b.x, a.y - b.y, a.z - b.z); }
static inline d3 d3_mul(d3 a, d3 b) { return d3_of(a.x * b.x, a.y * b.y, a.z * b.z); }
static inline d3 d3_scale(d3 a, double s) { return d3_of(a.x * s, a.y * s, a.z * s); }
static inline double d3_dot(d3 a, d3 b) { return a.x * b.x + a.y * b.y + a.z * b.z; }
static inline double d3_length(d3 a) { return sqrt(d3_dot(a, a)); }

static inline d3 d3_cross(d3 a, d3 b)
{
    return d3_of(a.y * b.z - a.z * b.y, a.z * b.x - a.x * b.z, a.x * b.y - a.y * b.x);
}

static inline d3 d3_unit(d3 a)
{
    double length = d3_length(a);
    return length < 1e-18 ? d3_of(0, 0, 0) : d3_scale(a, 1 / length);
}

static inline double d3_max(d3 a) /* the greatest magnitude */
{
    return fmax(fabs(a.x), fmax(fabs(a.y), fabs(a.z)));
}

/* Inlined, gcc 12 at -O2 drops the rounding of two neighbours that become doubles again. */
#ifdef __GNUC__
__attribute__((noinline, unused))
#endif
static shade_vec3 d3_round(d3 a) { return shade_v3((float)a.x, (float)a.y, (float)a.z); }

static inline d3 rnd_direction(void)
{
    d3 v;
    do v = d3_of(2 * rnd_unit() - 1, 2 * rnd_unit() - 1, 2 * rnd_unit() - 1);
    while (d3_dot(v, v) > 1 || d3_dot(v, v) < 0.01);
    return d3_unit(v);
}

/* ---------------------------------------------------------------------------------------- matrices
   m[row][column] */

typedef struct dmat {
    double m[4][4];
} dmat;

static inline dmat dmat_zero(void)
{
    dmat r = { 0 };
    return r;
}

static inline dmat dmat_identity(void)
{
    dmat r = dmat_zero();
    for (int k = 0; k < 4; k++) r.m[k][k] = 1;
    return r;
}

static inline dmat dmat_from(shade_mat4 s)
{
    dmat r;
    for (int c = 0; c < 4; c++) {
        r.m[0][c] = (double)s.col[c].x;
        r.m[1][c] = (double)s.col[c].y;
        r.m[2][c] = (double)s.col[c].z;
        r.m[3][c] = (double)s.col[c].w;
    }
    return r;
}

static inline dmat dmat_from3(shade_mat3 s)
{
    dmat r = dmat_identity();
    for (int c = 0; c < 3; c++) {
        r.m[0][c] = (double)s.col[c].x;
        r.m[1][c] = (double)s.col[c].y;
        r.m[2][c] = (double)s.col[c].z;
    }
    return r;
}

static inline dmat dmat_mul(dmat a, dmat b)
{
    dmat r = dmat_zero();
    for (int i = 0; i < 4; i++)
        for (int j = 0; j < 4; j++)
            for (int k = 0; k < 4; k++) r.m[i][j] += a.m[i][k] * b.m[k][j];
    return r;
}

static inline void dmat_apply(dmat a, const double in[4], double out[4])
{
    for (int i = 0; i < 4; i++) {
        out[i] = a.m[i][0] * in[0] + a.m[i][1] * in[1] + a.m[i][2] * in[2] + a.m[i][3] * in[3];
    }
}

static inline d3 dmat_point(dmat a, d3 p) /* w = 1, the first three rows */
{
    double in[4], out[4];
    in[0] = p.x;
    in[1] = p.y;
    in[2] = p.z;
    in[3] = 1;
    dmat_apply(a, in, out);
    return d3_of(out[0], out[1], out[2]);
}

static inline d3 dmat_direction(dmat a, d3 p)
{
    return d3_sub(dmat_point(a, p), dmat_point(a, d3_of(0, 0, 0)));
}

static inline double dmat_max(dmat a)
{
    double most = 0;
    for (int i = 0; i < 16; i++) most = fmax(most, fabs(a.m[i / 4][i % 4]));
    return most;
}

/* Gauss-Jordan with full row pivoting; returns the determinant of the leading n x n block and its
   inverse. */
static inline double dmat_invert(dmat a, int n, dmat *inverse)
{
    double determinant = 1;
    dmat r = dmat_identity();
    for (int c = 0; c < n; c++) {
        int pivot = c;
        for (int i = c + 1; i < n; i++) {
            if (fabs(a.m[i][c]) > fabs(a.m[pivot][c])) pivot = i;
        }
        if (a.m[pivot][c] == 0) {
            *inverse = dmat_zero();
            return 0;
        }
        if (pivot != c) {
            for (int j = 0; j < 4; j++) {
                double s = a.m[c][j];
                a.m[c][j] = a.m[pivot][j];
                a.m[pivot][j] = s;
                s = r.m[c][j];
                r.m[c][j] = r.m[pivot][j];
                r.m[pivot][j] = s;
            }
            determinant = -determinant;
        }
        double p = a.m[c][c];
        determinant *= p;
        for (int j = 0; j < n; j++) {
            a.m[c][j] /= p;
            r.m[c][j] /= p;
        }
        for (int i = 0; i < n; i++) {
            double f = a.m[i][c];
            if (i == c || f == 0) continue;
            for (int j = 0; j < n; j++) {
                a.m[i][j] -= f * a.m[c][j];
                r.m[i][j] -= f * r.m[c][j];
            }
        }
    }
    *inverse = r;
    return determinant;
}

/* sign(det) times the cofactors of the upper left 3 x 3 */
static inline dmat dmat_normals(dmat a)
{
    d3 c[3], k[3];
    for (int j = 0; j < 3; j++) c[j] = d3_of(a.m[0][j], a.m[1][j], a.m[2][j]);
    for (int j = 0; j < 3; j++) k[j] = d3_cross(c[(j + 1) % 3], c[(j + 2) % 3]);
    double sign = d3_dot(c[0], k[0]) < 0 ? -1 : 1;
    dmat r = dmat_identity();
    for (int j = 0; j < 3; j++) {
        r.m[0][j] = sign * k[j].x;
        r.m[1][j] = sign * k[j].y;
        r.m[2][j] = sign * k[j].z;
    }
    return r;
}

/* ------------------------------------------------------------------------------------------- light
   Iteration four with every flag.  unsure: the sample lies within rounding of a discontinuity. */

static double ref_margin =
    1e-5; /* in N.L, N.V and L.S: some hundred roundings of unit vectors' dot product */
#define REF_MARGIN ref_margin
#define REF_SHORT_H 1e-4 /* halfway vectors shorter than this are exempt from the bound */
#define REF_STEEP 1e-3   /* 0 < exponent < 1: x^n has no bounded slope below this base */

typedef struct ref_lit {
    d3 emission, ambient, diffuse, specular, total;
    double bound; /* the allowed error of a component */
    int unsure;
} ref_lit;

static inline double ref_power(double x, double n)
{
    x = x > 0 ? (x < 1 ? x : 1) : 0;
    n = n > 0 ? n : 0;
    return n == 0 ? 1 : pow(x, n);
}

static inline int ref_steep(double x, double n)
{
    return n > 0 && n < 1 && x > -REF_MARGIN && x < REF_STEEP;
}

static inline double ref_attenuation(double a, double b, double c, double r)
{
    if (a == 0 && b == 0 && c == 0) return 1;
    if (a == 0) r = fmax(r, 1e-4);
    double q = a + b * r + c * r * r;
    return q > 1e-20 ? 1 / q : 1e20;
}

static inline double ref_spot(d3 L, d3 aim, double cos_cutoff, double exponent, int *unsure)
{
    if (d3_length(aim) < 1e-18) return 1;
    double c = -d3_dot(L, d3_unit(aim));
    if (fabs(c - cos_cutoff) < REF_MARGIN || ref_steep(c, exponent)) *unsure = 1;
    return c >= cos_cutoff ? ref_power(c, exponent) : 0;
}

/* B and the weight apart: the power of the highlight */
static inline double ref_highlight(shade_model model, d3 N, d3 L, d3 V, double n, int *unsure)
{
    if (model == SHADE_MODEL_PHONG) {
        d3 R = d3_sub(d3_scale(N, 2 * d3_dot(N, L)), L);
        if (ref_steep(d3_dot(R, V), n)) *unsure = 1;
        return ref_power(d3_dot(R, V), n);
    }
    d3 H = d3_add(L, V);
    if (d3_dot(H, H) < 1e-12) return 0;
    if (d3_length(H) < REF_SHORT_H) *unsure = 1;
    if (ref_steep(d3_dot(N, d3_unit(H)), n)) *unsure = 1;
    return ref_power(d3_dot(N, d3_unit(H)), n);
}

static inline d3 ref_cool_to_warm(double NL, d3 cool, d3 warm)
{
    if (d3_max(cool) == 0) cool = d3_of(0.4, 0.4, 0.7);
    if (d3_max(warm) == 0) warm = d3_of(0.8, 0.6, 0.6);
    double k = (1 + NL) / 2;
    return d3_add(d3_scale(warm, k), d3_scale(cool, 1 - k));
}

/* From P toward the lamp, which stands at xyz / w in floats; its distance in *r, 0 for lights at
   infinity. */
static inline d3 ref_to_light(const shade_light *light, d3 P, double *r)
{
    d3 p = d3_of((double)light->position.x, (double)light->position.y, (double)light->position.z);
    double w = (double)light->position.w;
    *r = 0;
    if (w == 0) return d3_unit(p);
    d3 d = d3_sub(d3_from(d3_round(d3_of(p.x / w, p.y / w, p.z / w))), P);
    *r = d3_length(d);
    return d3_unit(d);
}

static inline ref_lit ref_light(const shade_lighting *li, const shade_material *mat, d3 P, d3 N,
                                d3 eye, d3 albedo)
{
    ref_lit out = { .bound = 5e-5 };
    if (!li) return out;
    unsigned terms = li->terms ? li->terms : 15u;
    d3 ke = d3_of(0, 0, 0), ka = d3_of(1, 1, 1), kd = ka, ks = ke;
    double n = 0, brightest = 0, e_max = 0;
    if (mat) {
        ke = d3_from(mat->emission);
        ka = d3_from(mat->ambient);
        kd = d3_from(mat->diffuse);
        ks = d3_from(mat->specular);
        n = fmax(0, (double)mat->shininess);
    }
    ka = d3_mul(ka, albedo);
    kd = d3_mul(kd, albedo);
    N = d3_unit(N);
    d3 V = d3_unit(li->flags & SHADE_FLAG_INFINITE_VIEWER ? eye : d3_sub(eye, P));
    if (li->flags & SHADE_FLAG_TWO_SIDED) {
        double NV = d3_dot(N, V);
        if (fabs(NV) < REF_MARGIN) out.unsure = 1;
        if (NV < 0) N = d3_scale(N, -1);
    }
    int count = li->lights && li->light_count > 0 ? li->light_count : 0;
    shade_model model = li->model > SHADE_MODEL_COOL_TO_WARM ? SHADE_MODEL_BLINN_PHONG : li->model;

    out.emission = ke;
    if (model == SHADE_MODEL_COOL_TO_WARM) {
        double NL = 0, r;
        if (count) NL = d3_dot(N, ref_to_light(&li->lights[0], P, &r));
        out.diffuse = d3_mul(albedo, ref_cool_to_warm(NL, d3_from(li->cool), d3_from(li->warm)));
    }
    int has_ambient = model <= SHADE_MODEL_AMBIENT, has_diffuse = model <= SHADE_MODEL_LAMBERT;
    int has_specular =
        model <= SHADE_MODEL_PHONG && (terms & SHADE_TERM_SPECULAR) && d3_length(N) > 0;
    if (has_ambient) out.ambient = d3_mul(ka, d3_from(li->ambient));
    for (int k = 0; k < count && has_ambient; k++) {
        const shade_light *light = &li->lights[k];
        double r, factor = 1, e = 0;
        d3 L = ref_to_light(light, P, &r);
        if (light->position.w != 0) {
            factor = ref_attenuation((double)light->constant, (double)light->linear,
                                     (double)light->quadratic, r);
        }
        if (d3_length(d3_from(light->spot_direction)) >= 1e-18) e = (double)light->spot_exponent;
        factor *= ref_spot(L, d3_from(light->spot_direction), (double)light->spot_cos_cutoff, e,
                           &out.unsure);
        double own = li->flags & SHADE_FLAG_ATTENUATED_AMBIENT ? factor : 1;
        out.ambient = d3_add(out.ambient, d3_scale(d3_mul(ka, d3_from(light->ambient)), own));
        brightest = fmax(brightest, own * d3_max(d3_from(light->ambient)));
        e_max = fmax(e_max, e);
        e_max = fmax(e_max, e);
        if (!has_diffuse) continue;

        double NL = d3_dot(N, L), weight = NL > 0 ? NL : 0;
        double kd_weight = li->flags & SHADE_FLAG_TWO_SIDED_ABS ? fabs(NL) : weight;
        out.diffuse =
            d3_add(out.diffuse, d3_scale(d3_mul(kd, d3_from(light->diffuse)), factor * kd_weight));
        brightest = fmax(brightest, factor * d3_max(d3_from(light->diffuse)));
        if (!has_specular) continue;

        double s = ref_highlight(model, N, L, V, n, &out.unsure);
        int gated = !(li->flags & SHADE_FLAG_UNGATED_SPECULAR);
        if (gated && fabs(NL) < REF_MARGIN && d3_length(L) > 0) out.unsure = 1;
        if (gated && !(NL > 0)) s = 0;
        if (li->flags & SHADE_FLAG_WEIGHTED_SPECULAR) s *= weight;
        out.specular =
            d3_add(out.specular, d3_scale(d3_mul(ks, d3_from(light->specular)), factor * s));
        brightest = fmax(brightest, factor * d3_max(d3_from(light->specular)));
    }
    if (!(terms & SHADE_TERM_EMISSION)) out.emission = d3_of(0, 0, 0);
    if (!(terms & SHADE_TERM_AMBIENT)) out.ambient = d3_of(0, 0, 0);
    if (!(terms & SHADE_TERM_DIFFUSE)) out.diffuse = d3_of(0, 0, 0);
    if (!(terms & SHADE_TERM_SPECULAR)) out.specular = d3_of(0, 0, 0);
    out.total = d3_add(d3_add(out.emission, out.ambient), d3_add(out.diffuse, out.specular));
    out.bound = 5e-5 * fmax(fmax(1, brightest), d3_max(out.total)) * fmax(1, (n + e_max) / 100);
    return out;
}

/* --------------------------------------------------------------------------------------- pixels */

/* Whether the centre of pixel (i, j) belongs to the triangle of 24.8 fixed-point corners.  The
   top-left rule says: where the centre lies on an edge, ask for the point an instant to the right
   of it, and where that lies on the edge too, for the point an instant below. */
static inline int ref_edge_sign(int64_t ax, int64_t ay, int64_t bx, int64_t by, int64_t px,
                                int64_t py)
{
    int64_t e = (bx - ax) * (py - ay) - (by - ay) * (px - ax);
    if (e == 0) e = -(by - ay); /* its slope toward +x */
    if (e == 0) e = bx - ax;    /* its slope toward +y */
    return (e > 0) - (e < 0);
}

static inline int ref_inside_fx8(const int64_t x[3], const int64_t y[3], int i, int j)
{
    int64_t px = (int64_t)i * 256 + 128, py = (int64_t)j * 256 + 128;
    int64_t area = (x[1] - x[0]) * (y[2] - y[0]) - (y[1] - y[0]) * (x[2] - x[0]);
    if (area == 0) return 0;
    int a = ref_edge_sign(x[0], y[0], x[1], y[1], px, py);
    int b = ref_edge_sign(x[1], y[1], x[2], y[2], px, py);
    int c = ref_edge_sign(x[2], y[2], x[0], y[0], px, py);
    return area > 0 ? a > 0 && b > 0 && c > 0 : a < 0 && b < 0 && c < 0;
}

/* A triangle given in clip space, seen through the window: homogeneous and without clipping.  e[k]
   . (X, Y, 1) is barycentric k over w, not below 0 for visible points whatever the facing or the
   signs of w. */
typedef struct ref_triangle {
    double e[3][3];
    double z[3], w[3];
    double scale[3]; /* 1 / |gradient| of e[k], 0 where there is none */
    int front;       /* meant where all w > 0 */
} ref_triangle;

static inline int ref_triangle_of(ref_triangle *t, const shade_vec4 *a, const shade_vec4 *b,
                                  const shade_vec4 *c, int width, int height)
{
    const shade_vec4 *v[3];
    v[0] = a;
    v[1] = b;
    v[2] = c;
    memset(t, 0, sizeof *t);
    dmat m = dmat_identity(), inverse;
    for (int k = 0; k < 3; k++) {
        double x = (double)v[k]->x, y = (double)v[k]->y, w = (double)v[k]->w;
        m.m[0][k] = (x + w) * width / 2;
        m.m[1][k] = (w - y) * height / 2;
        m.m[2][k] = w;
        t->z[k] = (double)v[k]->z;
        t->w[k] = w;
    }
    double det = dmat_invert(m, 3, &inverse);
    if (det == 0) return 0;
    t->front = det < 0;
    for (int k = 0; k < 3; k++) {
        for (int j = 0; j < 3; j++) t->e[k][j] = inverse.m[k][j];
        double g = hypot(t->e[k][0], t->e[k][1]);
        t->scale[k] = g > 0 ? 1 / g : 0;
    }
    return 1;
}

static inline double ref_at(const double e[3], double X,
                            double Y) { return e[0] * X + e[1] * Y + e[2]; }

static inline void ref_barycentric(const ref_triangle *t, double X, double Y, double b[3])
{
    double sum = 0;
    for (int k = 0; k < 3; k++) sum += b[k] = ref_at(t->e[k], X, Y);
    for (int k = 0; k < 3; k++) b[k] /= sum;
}

static inline double ref_interpolate(const ref_triangle *t, double X, double Y, double v0,
                                     double v1, double v2)
{
    double b[3];
    ref_barycentric(t, X, Y, b);
    return b[0] * v0 + b[1] * v1 + b[2] * v2;
}

static inline double ref_depth(const ref_triangle *t, double X, double Y, int zero_to_one)
{
    double ndc = 0;
    for (int k = 0; k < 3; k++) ndc += ref_at(t->e[k], X, Y) * t->z[k];
    return zero_to_one ? ndc : 0.5 * ndc + 0.5;
}

/* 1 inside, 0 outside, -1 within margin pixels of the border of the visible part; z_clip: near and
   far count. */
static inline int ref_covers(const ref_triangle *t, double X, double Y, double margin, int z_clip,
                             int zero_to_one)
{
    double least = 1e300;
    for (int k = 0; k < 3; k++) {
        double e = ref_at(t->e[k], X, Y);
        least = fmin(least, t->scale[k] > 0 ? e * t->scale[k] : e * 1e9);
    }
    for (int side = 0; side < 2 && z_clip; side++) {
        double f[3] = { 0, 0, 0 };
        for (int k = 0; k < 3; k++) {
            double d = side ? t->w[k] - t->z[k] : zero_to_one ? t->z[k] : t->z[k] + t->w[k];
            for (int j = 0; j < 3; j++) f[j] += d * t->e[k][j];
        }
        double g = hypot(f[0], f[1]), e = ref_at(f, X, Y);
        if (g > 1e-12)
            least = fmin(least, e / g);
        else if (e < -1e-6)
            return 0;
        else if (e < 1e-6)
            return -1;
    }
    return least > margin ? 1 : least < -margin ? 0 : -1;
}

/* --------------------------------------------------------------------------------- colour codes */

static inline double ref_encode_srgb(double c)
{
    c = c > 0 ? (c < 1 ? c : 1) : 0;
    return c <= 0.0031308 ? 12.92 * c : 1.055 * pow(c, 1 / 2.4) - 0.055;
}

static inline double ref_decode_srgb(double v)
{
    return v <= 0.04045 ? v / 12.92 : pow((v + 0.055) / 1.055, 2.4);
}

#endif
