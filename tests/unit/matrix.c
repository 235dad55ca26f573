/* matrix.c - transforms, inverses, cameras and the normal matrix, against double precision. */
#include "unit.h"

static void check_mat4(int line, shade_mat4 got, dmat want, double within)
{
    dmat g = dmat_from(got);
    for (int i = 0; i < 4; i++)
        for (int j = 0; j < 4; j++) {
            test_now.checks++;
            if (fabs(g.m[i][j] - want.m[i][j]) <= within) continue;
            test_fail(__FILE__, line, "matrix",
                      "row %d, column %d: got %.9g, want %.9g within %.3g", i, j, g.m[i][j],
                      want.m[i][j], within);
        }
}
#define CHECK_MAT4(got, want, within) check_mat4(__LINE__, got, want, within)
static shade_mat4 widen(shade_mat3 m)
{
    shade_mat4 r = { 0 };
    for (int c = 0; c < 3; c++) r.col[c] = shade_v4(m.col[c].x, m.col[c].y, m.col[c].z, 0);
    r.col[3].w = 1;
    return r;
}
#define CHECK_MAT3(got, want, within) check_mat4(__LINE__, widen(got), want, within)

static dmat transposed(dmat a)
{
    dmat r;
    for (int i = 0; i < 16; i++) r.m[i / 4][i % 4] = a.m[i % 4][i / 4];
    return r;
}

static dmat block3(dmat a) /* the upper left 3 x 3 in an identity */
{
    dmat r = dmat_identity();
    for (int i = 0; i < 9; i++) r.m[i / 3][i % 3] = a.m[i / 3][i % 3];
    return r;
}

TEST(matrix, columns_are_stored_one_after_the_other) /* as GLM and OpenGL have them */
{
    shade_mat4 t = shade_mat4_translation(shade_v3(7, 8, 9));
    float f[16];
    memcpy(f, &t, sizeof f);
    CHECK(sizeof t == 16 * sizeof(float));
    CHECK(f[0] == 1 && f[5] == 1 && f[10] == 1 && f[15] == 1 && f[12] == 7 && f[13] == 8 &&
          f[14] == 9);
    CHECK(f[1] == 0 && f[3] == 0 && f[4] == 0 && f[7] == 0 && f[11] == 0);
}

TEST(matrix, simple_constructors_are_exact)
{
    CHECK_MAT4(shade_mat4_identity(), dmat_identity(), 0);
    CHECK_MAT3(shade_mat3_identity(), dmat_identity(), 0);
    dmat s = dmat_identity();
    s.m[0][0] = 2;
    s.m[1][1] = -3;
    s.m[2][2] = 0.5;
    CHECK_MAT4(shade_mat4_scaling(shade_v3(2, -3, 0.5f)), s, 0);
    for (int i = 0; i < 200; i++) {
        shade_mat4 m = random_mat4(10);
        CHECK_MAT4(shade_mat4_transpose(m), transposed(dmat_from(m)), 0);
        CHECK_MAT3(shade_mat3_from_mat4(m), block3(dmat_from(m)), 0);
        CHECK_MAT3(shade_mat3_transpose(shade_mat3_from_mat4(m)), transposed(block3(dmat_from(m))),
                   0);
    }
}

/* A sum of four products of numbers up to size has errors of a few units in the last place of
   size squared. */
TEST(matrix, products_and_transforms_match_double)
{
    for (int i = 0; i < 1000; i++) {
        double size = (double)rnd_log(1e-3, 1e6);
        shade_mat4 a = random_mat4(size), b = random_mat4(size);
        dmat A = dmat_from(a), B = dmat_from(b);
        double within = 2e-6 * size * size;
        CHECK_MAT4(shade_mat4_mul(a, b), dmat_mul(A, B), within);
        shade_mat3 a3 = shade_mat3_from_mat4(a), b3 = shade_mat3_from_mat4(b);
        CHECK_MAT3(shade_mat3_mul(a3, b3), dmat_mul(block3(A), block3(B)), within);
        shade_vec3 p = random_vector(size);
        shade_vec4 h = shade_mat4_transform(a, shade_v4(p.x, p.y, p.z, 2));
        double in[4], out[4];
        in[0] = (double)p.x;
        in[1] = (double)p.y;
        in[2] = (double)p.z;
        in[3] = 2;
        dmat_apply(A, in, out);
        CHECK_NEAR(h.x, out[0], within + 1e-6 * size);
        CHECK_NEAR(h.y, out[1], within + 1e-6 * size);
        CHECK_NEAR(h.z, out[2], within + 1e-6 * size);
        CHECK_NEAR(h.w, out[3], within + 1e-6 * size);
        CHECK_VEC(shade_mat3_transform(a3, p), dmat_direction(A, d3_from(p)), within);
        CHECK_VEC(shade_mat4_transform_direction(a, p), dmat_direction(A, d3_from(p)), within);
    }
}

/* Where w is below 0.1 the quotient has too large an error to be held to a number.  Where w is
   exactly 0 the point is not divided. */
TEST(matrix, transform_point_divides_except_by_zero)
{
    for (int i = 0; i < 1000; i++) {
        shade_mat4 m = random_mat4(2);
        shade_vec3 p = random_vector(3);
        double in[4], out[4];
        in[0] = (double)p.x;
        in[1] = (double)p.y;
        in[2] = (double)p.z;
        in[3] = 1;
        dmat_apply(dmat_from(m), in, out);
        if (fabs(out[3]) < 0.1) continue;
        CHECK_VEC(shade_mat4_transform_point(m, p),
                  d3_scale(d3_of(out[0], out[1], out[2]), 1 / out[3]), 1e-3);
    }
    shade_mat4 flat = shade_mat4_translation(shade_v3(1, 2, 3));
    flat.col[3].w = 0;
    CHECK_VEC(shade_mat4_transform_point(flat, shade_v3(4, 5, 6)), d3_of(5, 7, 9), 0);
}

TEST(matrix, determinants_match_elimination)
{
    for (int i = 0; i < 1000; i++) {
        double size = (double)rnd_log(1e-3, 1e6);
        shade_mat4 m = random_mat4(size);
        dmat ignored;
        double want = dmat_invert(dmat_from(m), 4, &ignored);
        CHECK_NEAR(shade_mat4_determinant(m), want, 1e-7 * fabs(want) + 1e-14 * pow(size, 4));
        want = dmat_invert(dmat_from(m), 3, &ignored);
        CHECK_NEAR(shade_mat3_determinant(shade_mat3_from_mat4(m)), want, 2e-6 * pow(size, 3));
    }
}

/* Only matrices whose inverse is at most 1000 / size are held to numbers: the error grows with
   the condition. */
TEST(matrix, inverses_match_elimination)
{
    int tested = 0;
    for (int i = 0; i < 2000; i++) {
        double size = (double)rnd_log(1e-3, 1e6);
        shade_mat4 m = random_mat4(size);
        dmat inverse, inverse3;
        dmat_invert(dmat_from(m), 4, &inverse);
        dmat_invert(dmat_from(m), 3, &inverse3);
        if (dmat_max(inverse) * size < 1e3) {
            CHECK_MAT4(shade_mat4_inverse(m), inverse, 2e-7 * dmat_max(inverse));
            tested++;
        }
        double most = 0;
        for (int k = 0; k < 9; k++) most = fmax(most, fabs(inverse3.m[k / 3][k % 3]));
        if (most * size > 100) continue;
        shade_mat3 m3 = shade_mat3_from_mat4(m);
        CHECK_MAT3(shade_mat3_inverse(m3), inverse3, 4e-5 * most);
        CHECK_MAT3(shade_mat3_inverse_transpose(m3), transposed(inverse3), 4e-5 * most);
    }
    CHECK_SAY(tested > 1000, "%d well-conditioned matrices", tested);
}

/* Cameras of every distance and scale, and any affine matrix, beside elimination in double */
TEST(matrix, the_eye_is_the_point_that_a_view_takes_to_the_origin)
{
    for (int i = 0; i < 2000; i++) {
        const double far = (double)rnd_log(1e-3, 1e8);
        const shade_vec3 eye = shade_scale(d3_round(rnd_direction()), (float)far);
        const shade_vec3 center = d3_round(rnd_direction());
        shade_mat4 view = shade_mat4_look_at(eye, center, d3_round(rnd_direction()));
        if (i % 4 == 3) view = shade_mat4_mul(shade_mat4_scaling(shade_v3(2, -3, 0.5f)), view);
        dmat inverse;
        dmat_invert(dmat_from(view), 4, &inverse);
        const shade_vec3 got = shade_mat4_eye(view);
        const float *xyz = &got.x;
        for (int k = 0; k < 3; k++)
            CHECK_NEAR(xyz[k], inverse.m[k][3] / inverse.m[3][3], 2e-7 * far + 1e-7);
        if (i % 4 < 3) CHECK_NEAR(shade_distance(got, eye), 0, 1e-6 * far + 1e-6);
    }
    const shade_vec3 none = shade_mat4_eye(shade_mat4_identity());
    CHECK(none.x == 0 && none.y == 0 && none.z == 0);
}

/* G3 */
TEST(matrix, a_view_that_is_singular_or_not_finite_looks_from_the_origin)
{
    for (int i = 0; i < 200; i++) {
        const shade_vec3 up = d3_round(rnd_direction());
        shade_mat4 view = shade_mat4_look_at(shade_v3(1, 2, 3), shade_v3(0, 0, 0), up);
        float *entry = (float *)&view;
        if (i % 2) entry[rnd_int(0, 15)] = i % 4 == 1 ? (float)NAN : rnd_sign() * (float)INFINITY;
        else memset(&view.col[rnd_int(0, 3)], 0, sizeof(shade_vec4));
        const shade_vec3 eye = shade_mat4_eye(view);
        CHECK_SAY(eye.x == 0 && eye.y == 0 && eye.z == 0, "%g %g %g", (double)eye.x, (double)eye.y,
                  (double)eye.z);
    }
}

/* G3 */
TEST(matrix, the_inverse_of_a_singular_matrix_is_zero)
{
    shade_mat4 m = shade_mat4_scaling(shade_v3(1, 1, 0));
    CHECK_MAT4(shade_mat4_inverse(m), dmat_zero(), 0);
    CHECK_NEAR(shade_mat4_determinant(m), 0, 0);
    dmat zero3 = dmat_zero();
    zero3.m[3][3] = 1;
    CHECK_MAT3(shade_mat3_inverse(shade_mat3_from_mat4(m)), zero3, 0);
    CHECK_MAT3(shade_mat3_inverse_transpose(shade_mat3_from_mat4(m)), zero3, 0);
    CHECK_NEAR(shade_mat3_determinant(shade_mat3_from_mat4(m)), 0, 0);
    for (int side = -1; side <= 1; side += 2) { /* a determinant whose reciprocal is infinite */
        m = shade_mat4_scaling(shade_v3(1e-13f, 1e-13f, (float)side * 1e-13f));
        CHECK_MAT3(shade_mat3_inverse_transpose(shade_mat3_from_mat4(m)), zero3, 0);
    }
    memset(&m, 0, sizeof m);
    CHECK_MAT4(shade_mat4_inverse(m), dmat_zero(), 0);
    for (int i = 0; i < 100; i++) { /* small integers: a repeated column is found exactly */
        for (int c = 0; c < 4; c++) {
            m.col[c] = shade_v4((float)rnd_int(-9, 9), (float)rnd_int(-9, 9), (float)rnd_int(-9, 9),
                                (float)rnd_int(-9, 9));
        }
        m.col[3] = m.col[1];
        CHECK_MAT4(shade_mat4_inverse(m), dmat_zero(), 0);
    }
}

/* Few sizes, zeros among them: many of these matrices have no inverse, or nearly none. */
/* G3 */
TEST(matrix, everything_is_finite_up_to_a_million)
{
    static const float sizes[] = { 0, 0, 1, 1, 1e-3f, 1e-6f, 1e3f, 1e6f, 2, 0.5f };
    for (int i = 0; i < 20000; i++) {
        shade_mat4 m;
        float f[16];
        for (int k = 0; k < 16; k++) f[k] = rnd_sign() * sizes[rnd_int(0, 9)];
        memcpy(&m, f, sizeof m);
        shade_mat3 m3 = shade_mat3_from_mat4(m);
        CHECK(finite_mat4(shade_mat4_mul(m, m)) && isfinite(shade_mat4_determinant(m)));
        CHECK_SAY(finite_mat4(shade_mat4_inverse(m)), "determinant %g",
                  (double)shade_mat4_determinant(m));
        CHECK(finite_mat4(widen(shade_mat3_inverse(m3))) && isfinite(shade_mat3_determinant(m3)));
        CHECK(finite_mat4(widen(shade_mat3_inverse_transpose(m3))));
        CHECK(finite_mat4(widen(shade_normal_matrix(m))));
        CHECK(finite_mat4(shade_mat4_look_at(shade_v3(f[0], f[1], f[2]), shade_v3(f[3], f[4], f[5]),
                                             shade_v3(f[6], f[7], f[8]))));
        CHECK(finite_mat4(shade_mat4_rotation(f[0], shade_v3(f[1], f[2], f[3]))));
        CHECK(finite_mat4(shade_mat4_perspective(f[0], f[1], f[2], f[3])));
        CHECK(finite_mat4(shade_mat4_perspective_reversed(f[0], f[1], f[2])));
        CHECK(finite_mat4(shade_mat4_frustum(f[0], f[1], f[2], f[3], f[4], f[5])));
        CHECK(finite_mat4(shade_mat4_ortho(f[0], f[1], f[2], f[3], f[4], f[5])));
    }
}

TEST(matrix, inverses_beyond_floats_stay_finite)
{
    for (int side = -1; side <= 1; side += 2) {
        float tiny = (float)side * 1e-39f; /* 1/tiny is infinite; 1/determinant only in m */
        shade_mat4 m = shade_mat4_scaling(shade_v3(tiny, 1, 1));
        shade_mat4 n = shade_mat4_scaling(shade_v3(tiny, 1e6f, 1e6f));
        CHECK(finite_mat4(shade_mat4_inverse(m)) && finite_mat4(shade_mat4_inverse(n)));
        CHECK(finite_mat4(widen(shade_mat3_inverse(shade_mat3_from_mat4(m)))));
        CHECK(finite_mat4(widen(shade_mat3_inverse(shade_mat3_from_mat4(n)))));
        CHECK(finite_mat4(widen(shade_mat3_inverse_transpose(shade_mat3_from_mat4(n)))));
    }
}

/* Products of three numbers of 1e-38 underflow.  Not all may become zero, for that would be
   finite too. */
TEST(matrix, inverse_transposes_of_small_numbers_are_finite)
{
    int zero = 0, most = 20000;
    for (int i = 0; i < most; i++) {
        shade_vec3 c[3];
        double lo = i % 4 ? 1e-38 : 1e-6, hi = 1e6;
        for (int k = 0; k < 3; k++) {
            c[k] = shade_v3(rnd_one_in(3) ? 0 : rnd_sign() * rnd_log(lo, hi),
                            rnd_one_in(3) ? 0 : rnd_sign() * rnd_log(lo, hi),
                            rnd_one_in(3) ? 0 : rnd_sign() * rnd_log(lo, hi));
        }
        shade_mat3 m = { { c[0], c[1], c[2] } }, inverse = shade_mat3_inverse_transpose(m);
        CHECK(finite_mat4(widen(inverse)));
        CHECK(finite_mat4(widen(shade_mat3_inverse(m))));
        zero += shade_dot(inverse.col[0], inverse.col[0]) == 0;
    }
    CHECK_SAY(zero < most * 3 / 4, "%d of %d are zero", zero, most);
}

static dmat ref_rotation(double angle, d3 axis) /* Rodrigues: cos I + sin [k] + (1-cos) k k^T */
{
    d3 k = d3_unit(axis);
    double c = cos(angle), s = sin(angle), v[3], cross[3][3];
    v[0] = k.x;
    v[1] = k.y;
    v[2] = k.z;
    memset(cross, 0, sizeof cross);
    cross[0][1] = -k.z;
    cross[0][2] = k.y;
    cross[1][0] = k.z;
    cross[1][2] = -k.x;
    cross[2][0] = -k.y;
    cross[2][1] = k.x;
    dmat r = dmat_identity();
    for (int i = 0; i < 3; i++)
        for (int j = 0; j < 3; j++)
            r.m[i][j] = c * (i == j) + s * cross[i][j] + (1 - c) * v[i] * v[j];
    return r;
}

TEST(matrix, rotation_follows_the_right_hand)
{
    for (int i = 0; i < 2000; i++) {
        float angle = rnd_sign() * rnd_log(1e-4, 1e5);
        shade_vec3 axis = d3_round(d3_scale(rnd_direction(), (double)rnd_log(1e-6, 1e6)));
        CHECK_MAT4(shade_mat4_rotation(angle, axis), ref_rotation((double)angle, d3_from(axis)),
                   1e-6);
    }
    shade_mat4 quarter = shade_mat4_rotation((float)(3.14159265358979 / 2), shade_v3(0, 0, 5));
    CHECK_VEC(shade_mat4_transform_point(quarter, shade_v3(1, 0, 0)), d3_of(0, 1, 0), 2e-7);
    CHECK_MAT4(shade_mat4_rotation(1.5f, shade_v3(0, 0, 0)), dmat_identity(), 0);
    CHECK_MAT4(shade_mat4_rotation(0, shade_v3(1, 2, 3)), dmat_identity(), 0);
    CHECK_MAT4(shade_mat4_rotation((float)NAN, shade_v3(0, 0, 1)), dmat_identity(), 0);
    CHECK_MAT4(shade_mat4_rotation(2e9f, shade_v3(0, 0, 1)), dmat_identity(), 0);
    CHECK(finite_mat4(shade_mat4_rotation((float)INFINITY, shade_v3(0, 0, 1))));
}

TEST(matrix, sine_and_cosine_are_exact_to_float_rounding)
{
    for (int i = 0; i < 40000; i++) {
        float angle = rnd_sign() * (rnd_one_in(2) ? rnd_log(1e-9, 1e5) : rnd_float(0, 7));
        if (rnd_one_in(4)) angle = (float)(rnd_int(-60000, 60000) * 1.57079632679489662);
        shade_mat4 m = shade_mat4_rotation(angle, shade_v3(0, 0, 1));
        CHECK_NEAR(m.col[0].x, cos((double)angle), 6.1e-8);
        CHECK_NEAR(m.col[0].y, sin((double)angle), 6.1e-8);
    }
}

TEST(matrix, rotations_invert_by_transposing_and_keep_their_normals)
{
    for (int i = 0; i < 300; i++) {
        shade_mat4 r = shade_mat4_rotation(rnd_float(-9, 9), d3_round(rnd_direction()));
        CHECK_MAT4(shade_mat4_inverse(r), dmat_from(shade_mat4_transpose(r)), 2e-6);
        CHECK_MAT3(shade_normal_matrix(r), dmat_from(r), 2e-6);
        shade_mat4 moved = shade_mat4_mul(shade_mat4_translation(random_vector(50)), r);
        CHECK_MAT3(shade_normal_matrix(moved), dmat_from3(shade_normal_matrix(r)), 0);
        shade_vec3 d = random_vector(1); /* translation never moves a direction */
        CHECK_VEC(shade_mat4_transform_direction(moved, d),
                  d3_from(shade_mat4_transform_direction(r, d)), 0);
        float s = rnd_log(0.1, 10); /* uniform scale may use the matrix itself */
        shade_mat4 scaled = shade_mat4_mul(r, shade_mat4_scaling(shade_v3(s, s, s)));
        shade_vec3 n = d3_round(rnd_direction());
        CHECK_VEC(shade_normalize(shade_mat3_transform(shade_normal_matrix(scaled), n)),
                  d3_unit(dmat_direction(dmat_from(scaled), d3_from(n))), 2e-6);
    }
}

TEST(matrix, normal_matrix_is_signed_cofactors) /* sign(det) of them */
{
    double h = sqrt(0.5);
    shade_mat3 m = shade_normal_matrix(shade_mat4_scaling(shade_v3(2, 1, 1)));
    CHECK_VEC(shade_normalize(shade_mat3_transform(m, shade_v3((float)h, (float)h, 0))),
              d3_of(0.4472136, 0.8944272, 0), 2e-7);
    m = shade_normal_matrix(shade_mat4_scaling(shade_v3(1, 1, 0)));
    CHECK_VEC(shade_normalize(shade_mat3_transform(m, shade_v3(0, 0, 1))), d3_of(0, 0, 1), 0);
    m = shade_normal_matrix(shade_mat4_scaling(shade_v3(-1, 1, 1)));
    CHECK_VEC(shade_normalize(shade_mat3_transform(m, shade_v3(1, 0, 0))), d3_of(-1, 0, 0), 0);
    m = shade_mat3_inverse_transpose(shade_mat3_from_mat4(shade_mat4_scaling(shade_v3(-1, 1, 1))));
    CHECK_VEC(shade_mat3_transform(m, shade_v3(1, 0, 0)), d3_of(-1, 0, 0), 0);
    for (int i = 0; i < 1000; i++) {
        shade_mat4 a = random_mat4(3);
        dmat inverse;
        double det = dmat_invert(dmat_from(a), 3, &inverse);
        CHECK_MAT3(shade_normal_matrix(a), dmat_normals(dmat_from(a)), 1e-5);
        if (fabs(det) < 1) continue; /* proportional to the inverse transpose, by |det| */
        shade_vec3 n = d3_round(rnd_direction());
        d3 want = dmat_direction(transposed(inverse), d3_from(n));
        CHECK_VEC(shade_normalize(shade_mat3_transform(shade_normal_matrix(a), n)), d3_unit(want),
                  5e-5);
    }
}

/* Where up is nearly along the view the sideways axis has no exact direction: such cameras are
   left out. */
TEST(matrix, look_at_puts_eye_center_and_up_where_it_says)
{
    for (int i = 0; i < 1000; i++) {
        d3 eye = d3_from(random_vector(20)), center = d3_from(random_vector(20)),
           up = rnd_direction();
        d3 back = d3_unit(d3_sub(eye, center)), right = d3_cross(up, back);
        if (d3_length(right) < 0.1 || d3_length(d3_sub(eye, center)) < 1) continue;
        right = d3_unit(right);
        d3 axis[3];
        axis[0] = right;
        axis[1] = d3_cross(back, right);
        axis[2] = back;
        dmat want = dmat_identity();
        for (int r = 0; r < 3; r++) {
            want.m[r][0] = axis[r].x;
            want.m[r][1] = axis[r].y;
            want.m[r][2] = axis[r].z;
            want.m[r][3] = -d3_dot(axis[r], eye);
        }
        shade_mat4 got = shade_mat4_look_at(d3_round(eye), d3_round(center), d3_round(up));
        CHECK_MAT4(got, want, 1e-4);
        CHECK_VEC(shade_mat4_transform_point(got, d3_round(eye)), d3_of(0, 0, 0), 1e-4);
    }
    shade_mat4 ahead =
        shade_mat4_look_at(shade_v3(0, 0, 5), shade_v3(0, 0, 4), shade_v3(0, 1, 0));
    dmat want = dmat_identity();
    want.m[2][3] = -5;
    CHECK_MAT4(ahead, want, 0);
}

/* Every sixth looks exactly along an axis, to either side.   G3 */
TEST(matrix, degenerate_cameras_are_finite_rotations)
{
    for (int i = 0; i < 200; i++) {
        shade_vec3 eye = random_vector(5), center = random_vector(5);
        if (i % 6 == 2) {
            const float step = i % 12 == 2 ? 2.0f : -3.0f;
            center = eye;
            if (i % 18 == 2) center.x += step;
            else if (i % 18 == 8) center.y += step;
            else center.z += step;
        }
        d3 sight = d3_sub(d3_from(center), d3_from(eye));
        shade_mat4 m =
            shade_mat4_look_at(eye, center, d3_round(d3_scale(sight, (double)rnd_float(-3, 3))));
        if (i % 4 == 0) m = shade_mat4_look_at(eye, center, shade_v3(0, 0, 0));
        if (i % 4 == 1) m = shade_mat4_look_at(eye, eye, shade_v3(0, 1, 0));
        CHECK(finite_mat4(m));
        CHECK_NEAR(fabs((double)shade_mat4_determinant(m)), 1, 1e-3);
        if (i % 4 == 1) { /* eye = center looks down -z */
            CHECK_NEAR(m.col[2].z, 1, 1e-6);
        } else {
            shade_vec3 at = shade_mat4_transform_point(m, center);
            CHECK_VEC(at, d3_of(0, 0, -d3_length(sight)), 1e-3);
        }
    }
}

static dmat ref_frustum(double l, double r, double b, double t, double n, double f)
{
    dmat m = dmat_zero();
    m.m[0][0] = 2 * n / (r - l);
    m.m[0][2] = (r + l) / (r - l);
    m.m[1][1] = 2 * n / (t - b);
    m.m[1][2] = (t + b) / (t - b);
    m.m[2][2] = -(f + n) / (f - n);
    m.m[2][3] = -2 * f * n / (f - n);
    m.m[3][2] = -1;
    return m;
}

static dmat ref_ortho(double l, double r, double b, double t, double n, double f)
{
    dmat m = dmat_identity();
    m.m[0][0] = 2 / (r - l);
    m.m[0][3] = -(r + l) / (r - l);
    m.m[1][1] = 2 / (t - b);
    m.m[1][3] = -(t + b) / (t - b);
    m.m[2][2] = -2 / (f - n);
    m.m[2][3] = -(f + n) / (f - n);
    return m;
}

/* The oracle takes the arguments as rounded to float, so that only the roundings of the library
   are left. */
TEST(matrix, projections_match_double)
{
    for (int i = 0; i < 1000; i++) {
        double n = (double)rnd_log(0.01, 10), f = n * (double)rnd_log(1.5, 1000);
        double fovy = (double)rnd_float(0.2, 2.8), aspect = (double)rnd_log(0.3, 3);
        double fov_f = (double)(float)fovy, asp_f = (double)(float)aspect, n_f = (double)(float)n;
        double f_f = (double)(float)f, half = n_f * tan(fov_f / 2);
        dmat want = ref_frustum(-half * asp_f, half * asp_f, -half, half, n_f, f_f);
        CHECK_MAT4(shade_mat4_perspective((float)fovy, (float)aspect, (float)n, (float)f), want,
                   1e-6 * dmat_max(want));
        want.m[2][2] = 0;
        want.m[2][3] = n_f;
        CHECK_MAT4(shade_mat4_perspective_reversed((float)fovy, (float)aspect, (float)n), want,
                   1e-6 * dmat_max(want));
        double l = (double)rnd_float(-3, 0), r = l + (double)rnd_float(1, 5);
        double b = (double)rnd_float(-3, 0), t = b + (double)rnd_float(1, 5);
        l = (double)(float)l;
        r = (double)(float)r;
        b = (double)(float)b;
        t = (double)(float)t;
        want = ref_frustum(l, r, b, t, n_f, f_f);
        CHECK_MAT4(shade_mat4_frustum((float)l, (float)r, (float)b, (float)t, (float)n, (float)f),
                   want, 4e-6 * dmat_max(want));
        want = ref_ortho(l, r, b, t, n_f, f_f);
        CHECK_MAT4(shade_mat4_ortho((float)l, (float)r, (float)b, (float)t, (float)n, (float)f),
                   want, 4e-6 * dmat_max(want));
    }
    dmat square = ref_frustum(
        -0.2 * tan(67 * 3.14159265358979 / 360), 0.2 * tan(67 * 3.14159265358979 / 360),
        -0.2 * tan(67 * 3.14159265358979 / 360), 0.2 * tan(67 * 3.14159265358979 / 360), 0.2, 10);
    CHECK_MAT4(shade_mat4_perspective((float)(67 * 3.14159265358979 / 180), 1, 0.2f, 10),
               square, 1e-6);
}

TEST(matrix, reversed_projection_falls_from_one_at_near_to_zero)
{
    shade_mat4 m = shade_mat4_perspective_reversed(1, 1.5f, 0.25f);
    static const float distance[] = { 0.25f, 0.5f, 1, 10, 1000 };
    for (int i = 0; i < 5; i++) {
        shade_vec4 h = shade_mat4_transform(m, shade_v4(0, 0, -distance[i], 1));
        CHECK_NEAR(h.z / h.w, 0.25 / (double)distance[i], 1e-7);
        CHECK_NEAR(h.w, distance[i], 0);
    }
}

/* (0, 0, 2, 1) for every point: outside near or far whether z/w is in [-1, 1] or [0, 1]. */
/* G3 */
TEST(matrix, degenerate_projections_put_every_point_outside)
{
    dmat want = dmat_zero();
    want.m[2][3] = 2;
    want.m[3][3] = 1;
    for (int k = 0; k < DEGENERATE_CAMERAS; k++) CHECK_MAT4(degenerate_camera(k), want, 0);
    for (int i = 0; i < 2000; i++) { /* whatever the other arguments are */
        float v[6], x = rnd_log(1e-3, 1e3), wide = 3.14159274f + x;
        for (int k = 0; k < 6; k++) v[k] = rnd_one_in(3) ? rnd_nasty() : rnd_float(-3, 3);
        CHECK_MAT4(shade_mat4_perspective(v[0], v[1], x, x), want, 0);
        CHECK_MAT4(shade_mat4_perspective(v[0], v[1], -x, v[2]), want, 0);
        CHECK_MAT4(shade_mat4_perspective(v[0], v[1], v[2], -x), want, 0);
        CHECK_MAT4(shade_mat4_perspective(v[0], 0, v[1], v[2]), want, 0);
        CHECK_MAT4(shade_mat4_perspective(-x, v[0], v[1], v[2]), want, 0);
        CHECK_MAT4(shade_mat4_perspective(wide, v[0], v[1], v[2]), want, 0);
        CHECK_MAT4(shade_mat4_perspective_reversed(v[0], v[1], -x), want, 0);
        CHECK_MAT4(shade_mat4_perspective_reversed(v[0], 0, v[1]), want, 0);
        CHECK_MAT4(shade_mat4_perspective_reversed(wide, v[0], v[1]), want, 0);
        CHECK_MAT4(shade_mat4_frustum(x, x, v[0], v[1], v[2], v[3]), want, 0);
        CHECK_MAT4(shade_mat4_frustum(v[0], v[1], x, x, v[2], v[3]), want, 0);
        CHECK_MAT4(shade_mat4_frustum(v[0], v[1], v[2], v[3], v[4], -x), want, 0);
        CHECK_MAT4(shade_mat4_frustum(v[0], v[1], v[2], v[3], -x, v[4]), want, 0);
        CHECK_MAT4(shade_mat4_ortho(v[0], v[1], v[2], v[3], x, x), want, 0);
        CHECK_MAT4(shade_mat4_ortho(x, x, v[0], v[1], v[2], v[3]), want, 0);
    }
}

/* near beyond far turns depth round, and a mirrored or flipped picture is one as well; an
   orthographic view may begin behind the eye. */
TEST(matrix, near_beyond_far_and_left_beyond_right_are_cameras)
{
    for (int i = 0; i < 1000; i++) {
        double f = (double)rnd_log(0.01, 10), n = f * (double)rnd_log(1.5, 1000);
        double nf = (double)(float)n, ff = (double)(float)f;
        double fovy = (double)rnd_float(0.2, 2.8), aspect = (double)(rnd_sign() * rnd_log(0.3, 3));
        double half = nf * tan(fovy / 2);
        dmat want = ref_frustum(-half * aspect, half * aspect, -half, half, nf, ff);
        shade_mat4 m = shade_mat4_perspective((float)fovy, (float)aspect, (float)n, (float)f);
        CHECK_MAT4(m, want, 1e-6 * dmat_max(want));
        for (int end = 0; end < 2; end++) {
            shade_vec4 h = shade_mat4_transform(m, shade_v4(0, 0, end ? (float)-f : (float)-n, 1));
            CHECK_NEAR(h.z / h.w, end ? 1 : -1, 2e-5 * n / f);
            CHECK(h.w > 0);
        }
        double r = (double)rnd_float(-3, 0), l = r + (double)rnd_float(1, 5);
        double t = (double)rnd_float(-3, 0), b = t + (double)rnd_float(1, 5);
        l = (double)(float)l;
        b = (double)(float)b;
        want = ref_frustum(l, r, b, t, nf, ff);
        CHECK_MAT4(shade_mat4_frustum((float)l, (float)r, (float)b, (float)t, (float)n, (float)f),
                   want, 4e-6 * dmat_max(want));
        double from = (double)rnd_float(-9, 9), to = from + (double)(rnd_sign() * rnd_log(0.1, 9));
        to = (double)(float)to;
        want = ref_ortho(l, r, b, t, from, to);
        CHECK_MAT4(shade_mat4_ortho((float)l, (float)r, (float)b, (float)t, (float)from, (float)to),
                   want, 4e-6 * dmat_max(want));
    }
}

TEST(matrix, radians_are_degrees_times_pi_over_180_to_the_last_bit)
{
    CHECK_NEAR(shade_radians(180), 3.14159265358979323846, 1.0 / (1 << 23));
    CHECK(shade_radians(0) == 0);
    for (int i = 0; i < 20000; i++) {
        float degrees = i % 8 ? rnd_float(-720, 720) : rnd_sign() * rnd_log(1e-30, 1e30);
        double want = (double)degrees * 3.14159265358979323846 / 180;
        CHECK_NEAR(shade_radians(degrees), want, fabs(want) * (0.5000001 / (1 << 23)));
    }
    static const float odd[] = { NAN, INFINITY, -INFINITY };
    CHECK(isnan(shade_radians(odd[0])));
    for (int k = 1; k < 3; k++) CHECK(float_bits(shade_radians(odd[k])) == float_bits(odd[k]));
}
