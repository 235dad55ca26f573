/* light.c - vectors, matrices, colours and the equations of light: total for all input, finite for
   input that is not beyond 1e6 in matrices and 1e12 in vectors. */
#include "input.h"
#include "../unit/rows.h"
#include <math.h>

enum { LIGHT_LAMPS = 4 };

static int light_finite4(shade_vec4 v)
{
    return fuzz_finite(v.x) && fuzz_finite(v.y) && fuzz_finite(v.z) && fuzz_finite(v.w);
}

static int light_finite_mat3(shade_mat3 m)
{
    return fuzz_finite3(m.col[0]) && fuzz_finite3(m.col[1]) && fuzz_finite3(m.col[2]);
}

static int light_finite_mat4(shade_mat4 m)
{
    return light_finite4(m.col[0]) && light_finite4(m.col[1]) && light_finite4(m.col[2]) &&
           light_finite4(m.col[3]);
}

static void light_unit(shade_vec3 v)
{
    float l = shade_length(v);
    HOLDS(l == 0 || fabsf(l - 1) < 1e-5f);
}

static void light_vectors(fuzz_input *in, int tame)
{
    shade_vec3 a = fuzz_vec3(in, tame ? 1e12f : 0), b = fuzz_vec3(in, tame ? 1e12f : 0);
    shade_vec3 c = fuzz_vec3(in, tame ? 1e12f : 0), n = shade_normalize(a);
    float t = fuzz_value(in, 1), l = shade_length(a), d = shade_distance(a, b);
    shade_vec3 face = shade_face_normal(a, b, c), h = shade_halfway(n, shade_normalize(b));
    shade_vec3 r = shade_reflect(b, n), m = shade_mirror(b, n), mix = shade_lerp(a, b, t);
    if (!tame) return;
    HOLDS(fuzz_finite(l) && fuzz_finite(d) && fuzz_finite3(shade_cross(a, b)));
    HOLDS(fuzz_finite3(r) && fuzz_finite3(m) && fuzz_finite3(mix));
    light_unit(n);
    light_unit(face);
    light_unit(h);
}

static void light_matrices(fuzz_input *in, int tame)
{
    float most = tame ? 1e6f : 0, x = fuzz_value(in, most), y = fuzz_value(in, most);
    shade_mat4 m = fuzz_matrix(in, most), a = shade_mat4_mul(m, fuzz_matrix(in, most));
    shade_mat4 made[6], inverse = shade_mat4_inverse(m);
    shade_mat3 u = shade_mat3_from_mat4(m), w = shade_mat3_inverse(u);
    shade_mat3 it = shade_mat3_inverse_transpose(u), normal = shade_normal_matrix(m);
    shade_vec3 p = fuzz_vec3(in, most), q = shade_mat4_transform_direction(m, p);
    shade_vec3 e = fuzz_vec3(in, most), up = fuzz_vec3(in, most);
    float det = shade_mat4_determinant(m), det3 = shade_mat3_determinant(u);
    made[0] = shade_mat4_perspective(x, y, p.x, p.y);
    made[1] = shade_mat4_perspective_reversed(x, y, p.x);
    made[2] = shade_mat4_frustum(x, y, p.x, p.y, p.z, e.x);
    made[3] = shade_mat4_ortho(x, y, p.x, p.y, p.z, e.x);
    made[4] = shade_mat4_rotation(x, p);
    made[5] = shade_mat4_look_at(p, e, up);
    if (!tame) return;
    for (int k = 0; k < 6; k++) HOLDS(light_finite_mat4(made[k]));
    HOLDS(light_finite_mat4(a) && light_finite_mat4(inverse));
    HOLDS(light_finite_mat3(w) && light_finite_mat3(it) && light_finite_mat3(normal));
    HOLDS(fuzz_finite3(q) && fuzz_finite(det) && fuzz_finite(det3));
}

/* f_r lies between k_d and k_d + k_s for reflecting models; the ramp between its ends */
static void light_reflectance(fuzz_input *in, shade_vec3 N, shade_vec3 L, shade_vec3 V)
{
    int bad = 0, which = fuzz_int(in, -2, SHADE_PRESET_COUNT + 1);
    shade_model model = (shade_model)fuzz_enum(in, 6, &bad);
    shade_material m = shade_preset_material((shade_preset)which);
    shade_vec3 f = shade_brdf(which & 32 ? NULL : &m, model, N, L, V);
    shade_vec3 ramp = shade_cool_to_warm(N, L, m.ambient, shade_add(m.ambient, m.diffuse));
    const float *got = &f.x, *kd = &m.diffuse.x, *ks = &m.specular.x;
    for (int k = 0; k < 3; k++) {
        if (bad || model > SHADE_MODEL_LAMBERT)
            HOLDS(got[k] == 0);
        else
            HOLDS(got[k] >= kd[k] && got[k] <= kd[k] + ks[k] * 1.0001f);
        HOLDS((&ramp.x)[k] >= (&m.ambient.x)[k] - 1e-6f && (&ramp.x)[k] <= 2.00001f);
    }
    HOLDS((shade_preset_name((shade_preset)which)[0] == 0) ==
          (which < 0 || which >= SHADE_PRESET_COUNT));
    HOLDS(shade_result_string((shade_result)which)[0] != 0);
}

static void light_scalars(fuzz_input *in)
{
    float x = fuzz_float(in), n = fuzz_float(in), p = shade_power(x, n), a, b, c, r, f;
    shade_vec3 N = shade_normalize(fuzz_vec3(in, 1e6f)), L = shade_normalize(fuzz_vec3(in, 1e6f));
    shade_vec3 V = shade_normalize(fuzz_vec3(in, 1e6f)), aim = fuzz_vec3(in, 0);
    float phong = shade_phong_specular(N, L, V, n), blinn = shade_blinn_phong_specular(N, L, V, n);
    float spot = shade_spot(L, aim, x, n);
    HOLDS(p >= 0 && p <= 1);
    if (x >= 0 && x <= 1 && n >= 0 && n <= 1e6f)
        HOLDS(fabs((double)p - pow((double)x, (double)n)) < 2e-6);
    HOLDS(phong >= 0 && phong <= 1 && blinn >= 0 && blinn <= 1);
    if (fuzz_finite3(aim) && !fuzz_is_nan(x)) HOLDS(spot >= 0 && spot <= 1);
    HOLDS(shade_lambert(N, L) >= 0 && shade_lambert(N, L) < 1.0001f);
    light_reflectance(in, N, L, V);
    a = fuzz_float(in);
    b = fuzz_float(in);
    c = fuzz_float(in);
    r = fuzz_float(in);
    f = shade_attenuation(a, b, c, r);
    HOLDS(fuzz_is_nan(f) || f <= 1.0001e20f);
    if (a >= 0 && b >= 0 && c >= 0 && r >= 0 && fuzz_finite(a) && fuzz_finite(b) &&
        fuzz_finite(c) && fuzz_finite(r)) HOLDS(f >= 0);
}

/* [IEC61966], in double; what the contract makes of any float before */
static double light_clamped(float c) { return c > 0 ? c < 1 ? (double)c : 1 : 0; }

static double light_encoded(double c)
{
    return c > 0.0031308 ? 1.055 * pow(c, 1 / 2.4) - 0.055 : 12.92 * c;
}

static double light_decoded(double c)
{
    return c > 0.04045 ? pow((c + 0.055) / 1.055, 2.4) : c / 12.92;
}

static void light_check_colour(shade_vec3 from, shade_vec3 got, double (*curve)(double))
{
    const float *a = &from.x, *b = &got.x;
    for (int k = 0; k < 3; k++) {
        HOLDS(b[k] >= 0 && b[k] <= 1);
        HOLDS(fabs((double)b[k] - curve(light_clamped(a[k]))) < 4e-6);
    }
}

static void light_colours(fuzz_input *in)
{
    shade_vec3 c = fuzz_vec3(in, 0), low = shade_v3(0, 0, 0), high = shade_v3(1, 1, 1), bytes;
    uint32_t rgb = fuzz_word(in);
    shade_material m, linear;
    shade_vec3 *display = &m.emission, *made = &linear.emission;
    light_check_colour(c, shade_linear_from_srgb(c), light_decoded);
    light_check_colour(c, shade_srgb_from_linear(c), light_encoded);
    bytes = shade_v3((float)(rgb >> 16 & 255), (float)(rgb >> 8 & 255), (float)(rgb & 255));
    light_check_colour(shade_scale(bytes, 1 / 255.0f), shade_rgb(rgb), light_decoded);
    c = shade_clamp(c, low, high);
    m.emission = c;
    m.ambient = shade_v3(c.y, c.z, c.x);
    m.diffuse = shade_v3(c.z, c.x, c.y);
    m.specular = fuzz_vec3(in, 0);
    m.shininess = fuzz_float(in);
    linear = shade_linear_material(m);
    for (int k = 0; k < 4; k++) light_check_colour(display[k], made[k], light_decoded);
    HOLDS(fuzz_same(linear.shininess, m.shininess));
}

/* Rows of one lamp and the scalar form say the same, but at the edge of its cone. */
static void light_arriving(const shade_light *lamp, const float *P, int tame)
{
    float L[3][SHADE_LANES], amount[SHADE_LANES], alone[SHADE_LANES], none[3][SHADE_LANES];
    int fades = lamp->constant >= 0 && lamp->linear >= 0 && lamp->quadratic >= 0;
    double power = lamp->spot_exponent > 100 ? (double)lamp->spot_exponent / 100 : 1;
    memset(amount, 0xAA, sizeof amount);
    memset(none, 0xAA, sizeof none);
    shade_light_at_lanes(lamp, P, L[0], amount);
    shade_light_at_lanes(lamp, P, NULL, alone);
    shade_light_at_lanes(lamp, P, NULL, NULL);
    HOLDS(!memcmp(amount, alone, sizeof amount));
    shade_light_at_lanes(NULL, P, none[0], alone);
    for (int i = 0; i < SHADE_LANES; i++) {
        shade_vec3 p = shade_v3(P[i], P[i + SHADE_LANES], P[i + 2 * SHADE_LANES]), l;
        float r = -1, one = shade_light_at(lamp, p, &l, &r), cosine;
        HOLDS(fuzz_same(shade_light_at(lamp, p, NULL, NULL), one));
        HOLDS(none[0][i] == 0 && none[1][i] == 0 && none[2][i] == 0 && alone[i] == 0);
        if (!tame) continue;
        HOLDS(fuzz_finite(one) && fuzz_finite(amount[i]) && fuzz_finite3(l));
        HOLDS(r >= 0 && (r == FLT_MAX) == (lamp->position.w == 0));
        light_unit(l);
        HOLDS(fabsf(l.x - L[0][i]) < 1e-5f && fabsf(l.y - L[1][i]) < 1e-5f);
        HOLDS(fabsf(l.z - L[2][i]) < 1e-5f);
        cosine = -shade_dot(l, shade_normalize(lamp->spot_direction)) - lamp->spot_cos_cutoff;
        if (!fades || fabsf(cosine) < 1e-5f) continue;
        HOLDS(one >= 0 && amount[i] >= 0);
        HOLDS(fabs((double)one - (double)amount[i]) <= 1e-4 * power * (one > 1 ? (double)one : 1));
    }
    HOLDS(shade_light_at(NULL, shade_v3(1, 2, 3), NULL, NULL) == 0);
}

/* Rows of visibility, or NULL */
static const float *light_visibility(fuzz_input *in, int lamps, float most)
{
    uint32_t kind = fuzz_byte(in);
    float *rows;
    if (kind & 1 || lamps < 0 || lamps > LIGHT_LAMPS) return NULL;
    rows = (float *)guard_take((size_t)lamps * SHADE_LANES * sizeof(float), kind >> 1 & 1);
    for (int i = 0; i < lamps * SHADE_LANES; i++)
        rows[i] = i % SHADE_LANES < 3 ? fuzz_value(in, most) : 1 - rows[i - 3];
    guard_seal(rows);
    return rows;
}

/* A row of 1 for k_s changes nothing; one of 0 leaves the specular term out; any gives the same
   bits in every width. */
static void light_tinted(fuzz_input *in, const shade_lighting *l, const shade_material *m,
                         shade_vec3 eye, float *const *rows, float most)
{
    float a[3 * SHADE_LANES], b[3 * SHADE_LANES];
    float *tint = (float *)guard_take(sizeof a, (int)fuzz_byte(in) & 1);
    const unsigned terms = l->terms ? l->terms & 15 : 15;
    shade_rows all = { rows[0], rows[1], rows[2], tint, NULL };
    shade_lighting matte = *l;
    matte.terms = terms & ~(unsigned)SHADE_TERM_SPECULAR;
    for (int i = 0; i < 3 * SHADE_LANES; i++) tint[i] = 1;
    shade_lit_lanes(l, m, eye, &all, a);
    lit_rows(l, m, eye, rows[0], rows[1], rows[2], NULL, b);
    HOLDS(!memcmp(a, b, sizeof a));
    memset(tint, 0, sizeof a);
    shade_lit_lanes(l, m, eye, &all, a);
    if (matte.terms) lit_rows(&matte, m, eye, rows[0], rows[1], rows[2], NULL, b);
    for (int i = 0; matte.terms && i < 3 * SHADE_LANES; i++) HOLDS(a[i] == b[i]);
    for (int i = 0; i < 3 * SHADE_LANES; i++)
        tint[i] = i % SHADE_LANES < 2 ? fuzz_value(in, most) : 1 - tint[i - 2];
    guard_seal(tint);
    shade_lit_lanes(l, m, eye, &all, a);
    fuzz_level = (fuzz_level + 1) % (fuzz_widest() + 1);
    shade_lit_lanes(l, m, eye, &all, b);
    for (int i = 0; i < 3 * SHADE_LANES; i++) HOLDS(fuzz_same(a[i], b[i]) && fuzz_finite(a[i]));
}

/* Hidden lamps give their ambient light alone; lamps fully seen what they give without rows. */
static void light_hidden(const shade_lighting *l, const shade_material *m, shade_vec3 eye,
                         float *const *rows, const float *albedo)
{
    float visibility[LIGHT_LAMPS * SHADE_LANES], a[3 * SHADE_LANES], b[3 * SHADE_LANES];
    shade_light dark[LIGHT_LAMPS];
    shade_lighting ambient = *l;
    int lamps = l->lights && l->light_count > 0 ? l->light_count : 0;
    if (lamps) memcpy(dark, l->lights, (size_t)lamps * sizeof dark[0]);
    for (int j = 0; j < lamps; j++) dark[j].diffuse = dark[j].specular = shade_v3(0, 0, 0);
    ambient.lights = dark;
    ambient.light_count = lamps;
    memset(visibility, 0, sizeof visibility);
    lit_rows(l, m, eye, rows[0], rows[1], albedo, visibility, a);
    lit_rows(&ambient, m, eye, rows[0], rows[1], albedo, NULL, b);
    for (int i = 0; i < 3 * SHADE_LANES; i++) HOLDS(a[i] == b[i]);
    for (int i = 0; i < LIGHT_LAMPS * SHADE_LANES; i++) visibility[i] = 1;
    lit_rows(l, m, eye, rows[0], rows[1], albedo, visibility, a);
    lit_rows(l, m, eye, rows[0], rows[1], albedo, NULL, b);
    for (int i = 0; i < 3 * SHADE_LANES; i++) HOLDS(a[i] == b[i]);
}

/* scalar: finite where tame; packets as well, and the same bits in every width */
static void light_scene(fuzz_input *in, int tame)
{
    float most = tame ? 1e6f : 0, bright = tame ? 1e3f : 0, *rows[5], *again;
    const float *albedo, *seen;
    const shade_material *given;
    uint32_t kind = fuzz_byte(in);
    int bad = 0;
    shade_light lamps[LIGHT_LAMPS];
    shade_material m;
    shade_vec3 eye = fuzz_vec3(in, most), sum;
    shade_terms terms;
    shade_lighting l = { 0 };
    memset(lamps, 0, sizeof lamps);
    l.model = (shade_model)fuzz_enum(in, 6, &bad);
    l.flags = fuzz_byte(in);
    l.terms = kind & 15;
    l.lights = kind & 16 ? lamps : kind & 32 ? lamps + 1 : NULL;
    l.light_count = l.lights ? fuzz_int(in, 0, LIGHT_LAMPS - 1) : fuzz_wild_int(in);
    l.ambient = fuzz_vec3(in, bright);
    l.cool = fuzz_vec3(in, bright);
    l.warm = fuzz_vec3(in, bright);
    for (int k = 0; k < LIGHT_LAMPS; k++) {
        shade_light *lamp = &lamps[k];
        uint32_t parts = fuzz_byte(in);
        lamp->position = fuzz_vec4(in, most);
        if (tame) lamp->position.w = (float)(parts & 1);
        lamp->diffuse = fuzz_vec3(in, bright);
        lamp->specular = fuzz_vec3(in, bright);
        if (parts & 2) lamp->ambient = fuzz_vec3(in, bright);
        if (parts & 4) {
            lamp->linear = fuzz_value(in, most);
            lamp->quadratic = fuzz_value(in, most);
        }
        if (parts & 8) lamp->constant = fuzz_value(in, most);
        if (parts & 16) lamp->spot_direction = fuzz_vec3(in, most);
        if (parts & 32) lamp->spot_exponent = fuzz_value(in, most);
        lamp->spot_cos_cutoff = fuzz_value(in, 1);
    }
    m = shade_preset_material((shade_preset)fuzz_int(in, -1, SHADE_PRESET_COUNT));
    if (kind & 64) {
        m.emission = fuzz_vec3(in, bright);
        m.diffuse = fuzz_vec3(in, bright);
        m.specular = fuzz_vec3(in, bright);
        m.shininess = fuzz_value(in, most);
    }
    for (int k = 0; k < 5; k++)          /* P, N, albedo, rgb and rgb again */
        rows[k] = (float *)guard_take(3 * SHADE_LANES * sizeof(float), kind >> 7 & 1);
    again = rows[4];
    for (int i = 0; i < 3 * SHADE_LANES; i++) {
        int fresh = i % SHADE_LANES < 4;
        for (int k = 0; k < 3; k++)
            rows[k][i] = fresh ? fuzz_value(in, k == 2 ? bright : most) : rows[k][i - 3] * 0.75f;
        rows[3][i] = rows[4][i] = -1;
    }
    for (int k = 0; k < 3; k++) guard_seal(rows[k]);
    albedo = kind & 4 ? rows[2] : NULL;
    given = kind & 8 ? &m : NULL;
    seen = light_visibility(in, l.light_count, bright);
    lit_rows(&l, given, eye, rows[0], rows[1], albedo, seen, rows[3]);
    fuzz_level = (fuzz_level + 1) % (fuzz_widest() + 1);
    lit_rows(&l, given, eye, rows[0], rows[1], albedo, seen, again);
    for (int i = 0; i < 3 * SHADE_LANES; i++) {
        HOLDS(!tame || (fuzz_same(rows[3][i], again[i]) && fuzz_finite(rows[3][i])));
    }
    if (tame) light_hidden(&l, given, eye, rows, albedo);
    if (tame) light_tinted(in, &l, given, eye, rows, bright);
    if (l.lights && l.light_count > 0) light_arriving(&l.lights[0], rows[0], tame);
    for (int i = 0; i < 8; i++) {
        shade_vec3 P = shade_v3(rows[0][i], rows[0][i + SHADE_LANES], rows[0][i + 2 * SHADE_LANES]);
        shade_vec3 N = shade_v3(rows[1][i], rows[1][i + SHADE_LANES], rows[1][i + 2 * SHADE_LANES]);
        terms = shade_evaluate(kind & 128 ? NULL : &l, &m, eye, P, N);
        sum = shade_lit(&l, &m, eye, P, N);
        if (!tame) continue;
        HOLDS(fuzz_finite3(terms.emission) && fuzz_finite3(terms.ambient) && fuzz_finite3(sum));
        HOLDS(fuzz_finite3(terms.diffuse) && fuzz_finite3(terms.specular));
    }
}

int LLVMFuzzerTestOneInput(const uint8_t *data, size_t size)
{
    fuzz_input in = { data, data + size };
    uint32_t kind = fuzz_byte(&in);
    fuzz_level = (int)(kind >> 1) % (fuzz_widest() + 1);
    light_vectors(&in, kind & 1);
    light_matrices(&in, kind & 1);
    light_scalars(&in);
    light_colours(&in);
    light_scene(&in, kind & 1);
    guard_close();
    return 0;
}
