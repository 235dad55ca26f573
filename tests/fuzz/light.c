/* light.c - vectors, matrices and the equations of light: total for all input, finite for input
   that is not beyond 1e6 in matrices and 1e12 in vectors. */
#include "input.h"
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
    light_unit(n), light_unit(face), light_unit(h);
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
    made[4] = shade_mat4_rotation(x, p), made[5] = shade_mat4_look_at(p, e, up);
    if (!tame) return;
    for (int k = 0; k < 6; k++) HOLDS(light_finite_mat4(made[k]));
    HOLDS(light_finite_mat4(a) && light_finite_mat4(inverse));
    HOLDS(light_finite_mat3(w) && light_finite_mat3(it) && light_finite_mat3(normal));
    HOLDS(fuzz_finite3(q) && fuzz_finite(det) && fuzz_finite(det3));
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
    a = fuzz_float(in), b = fuzz_float(in), c = fuzz_float(in), r = fuzz_float(in);
    f = shade_attenuation(a, b, c, r);
    HOLDS(fuzz_is_nan(f) || f <= 1.0001e20f);
    if (a >= 0 && b >= 0 && c >= 0 && r >= 0 && fuzz_finite(a) && fuzz_finite(b) &&
        fuzz_finite(c) && fuzz_finite(r)) HOLDS(f >= 0);
}

/* scalar: finite where tame; packets as well, and the same bits in every width */
static void light_scene(fuzz_input *in, int tame)
{
    float most = tame ? 1e6f : 0, bright = tame ? 1e3f : 0, *rows[5], *again;
    uint32_t kind = fuzz_byte(in);
    int bad = 0;
    shade_light lamps[LIGHT_LAMPS];
    shade_material m;
    shade_lighting l;
    shade_vec3 eye = fuzz_vec3(in, most), sum;
    shade_terms terms;
    memset(&l, 0, sizeof l), memset(lamps, 0, sizeof lamps);
    l.model = (shade_model)fuzz_enum(in, 6, &bad), l.flags = fuzz_byte(in), l.terms = kind & 15;
    l.lights = kind & 16 ? lamps : kind & 32 ? lamps + 1 : NULL;
    l.light_count = l.lights ? fuzz_int(in, 0, LIGHT_LAMPS - 1) : fuzz_wild_int(in);
    l.ambient = fuzz_vec3(in, bright), l.cool = fuzz_vec3(in, bright);
    l.warm = fuzz_vec3(in, bright);
    for (int k = 0; k < LIGHT_LAMPS; k++) {
        shade_light *lamp = &lamps[k];
        uint32_t parts = fuzz_byte(in);
        lamp->position = fuzz_vec4(in, most);
        if (tame) lamp->position.w = (float)(parts & 1);
        lamp->diffuse = fuzz_vec3(in, bright), lamp->specular = fuzz_vec3(in, bright);
        if (parts & 2) lamp->ambient = fuzz_vec3(in, bright);
        if (parts & 4) lamp->linear = fuzz_value(in, most), lamp->quadratic = fuzz_value(in, most);
        if (parts & 8) lamp->constant = fuzz_value(in, most);
        if (parts & 16) lamp->spot_direction = fuzz_vec3(in, most);
        if (parts & 32) lamp->spot_exponent = fuzz_value(in, most);
        lamp->spot_cos_cutoff = fuzz_value(in, 1);
    }
    m = shade_preset_material((shade_preset)fuzz_int(in, -1, SHADE_PRESET_COUNT));
    if (kind & 64) {
        m.emission = fuzz_vec3(in, bright), m.diffuse = fuzz_vec3(in, bright);
        m.specular = fuzz_vec3(in, bright), m.shininess = fuzz_value(in, most);
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
    shade_lit_lanes(&l, kind & 8 ? &m : NULL, eye, rows[0], rows[1], kind & 4 ? rows[2] : NULL,
                    NULL, rows[3]);
    fuzz_level = (fuzz_level + 1) % (fuzz_widest() + 1);
    shade_lit_lanes(&l, kind & 8 ? &m : NULL, eye, rows[0], rows[1], kind & 4 ? rows[2] : NULL,
                    NULL, again);
    for (int i = 0; i < 3 * SHADE_LANES; i++) {
        HOLDS(!tame || (fuzz_same(rows[3][i], again[i]) && fuzz_finite(rows[3][i])));
    }
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
    light_scene(&in, kind & 1);
    guard_close();
    return 0;
}
