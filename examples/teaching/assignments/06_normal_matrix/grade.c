/* grade.c - the grader of 06_normal_matrix; README.md says what to write.
   cc -O2 -I. examples/teaching/assignments/06_normal_matrix/grade.c my.c -lm -o grade && ./grade */
#define SHADE_IMPLEMENTATION
#include "shade.h"
#include "../grade.h"

shade_mat3 normal_matrix(shade_mat4 model);

static shade_mat4 matrix(const float *in)
{
    shade_mat4 m;
    memcpy(&m, in, sizeof m);
    return m;
}
/* The normal (1, 2, 2) / 3 through the matrix, made unit: only its direction counts. */
static void through(shade_mat3 m, float *out)
{
    grade_put(out,
              shade_normalize(shade_mat3_transform(m, shade_v3(1 / 3.0f, 2 / 3.0f, 2 / 3.0f))));
}
static void yours(const float *in, float *out) { through(normal_matrix(matrix(in)), out); }
static void right(const float *in, float *out) { through(shade_normal_matrix(matrix(in)), out); }
static void as_points(const float *in, float *out)
{
    through(shade_mat3_from_mat4(matrix(in)), out);
}
static void inverse_alone(const float *in, float *out)
{
    through(shade_mat3_inverse(shade_mat3_from_mat4(matrix(in))), out);
}
static void transpose_alone(const float *in, float *out)
{
    through(shade_mat3_transpose(shade_mat3_from_mat4(matrix(in))), out);
}

static void cofactors(const float *in, float *out)
{
    const shade_mat3 m = shade_mat3_from_mat4(matrix(in));
    const shade_mat3 c = { { shade_cross(m.col[1], m.col[2]), shade_cross(m.col[2], m.col[0]),
                             shade_cross(m.col[0], m.col[1]) } };
    through(c, out);
}
static void unit_columns(const float *in, float *out)
{
    shade_mat3 m = shade_mat3_from_mat4(matrix(in));
    for (int k = 0; k < 3; k++) m.col[k] = shade_normalize(m.col[k]);
    through(m, out);
}
static void not_moved(const float *in, float *out)
{
    (void)in;
    through(shade_mat3_from_mat4(shade_mat4_identity()), out);
}

static void put(float *in, shade_vec3 scale)
{
    shade_mat4 m = shade_mat4_mul(shade_mat4_rotation(grade_between(-3, 3), grade_direction()),
                                  shade_mat4_scaling(scale));
    m = shade_mat4_mul(m, shade_mat4_rotation(grade_between(-3, 3), grade_direction()));
    m = shade_mat4_mul(shade_mat4_translation(shade_scale(grade_direction(), 5)), m);
    memcpy(in, &m, sizeof m);
}
static float factor(void) { return grade_between(0.3f, 3); }
static void rotated(float *in) { put(in, shade_v3(1, 1, 1)); }
static void scaled(float *in) { put(in, shade_v3(factor(), factor(), factor())); }
static void mirrored(float *in) { put(in, shade_v3(-factor(), factor(), factor())); }

static int place(float x, float y, float *in)
{
    const shade_mat4 m = shade_mat4_mul(shade_mat4_rotation(3 * x, shade_v3(0, 1, 0)),
                                        shade_mat4_scaling(shade_v3(1, 1 + y * 0.9f, 0.5f)));
    memcpy(in, &m, sizeof m);
    return 1;
}
static const grade_task task = {
    .name = "06_normal_matrix",
    .names = "model16",
    .outputs = 3,
    .tolerance = 1e-4f,
    .yours = yours,
    .right = right,
    .cases = { { "rotations and translations", 2, rotated,
                 "For a rotation the inverse transpose is the rotation itself; a translation "
                 "does not turn normals." },
               { "scaled in one direction", 4, scaled,
                 "A normal N stays at right angles to each edge M e of the moved mesh only "
                 "if it becomes the inverse transpose times N: then its product with M e is "
                 "that of N and e." },
               { "mirrored", 2, mirrored,
                 "A mirror has a negative determinant; the normals still point out of the "
                 "mesh." } },
    .mistakes = { { "as_points", as_points,
                    "Normals are transformed as points are. Where a matrix scales one "
                    "direction more than another, that tilts them: take the inverse transpose." },
                  { "inverse_alone", inverse_alone,
                    "This is the inverse; it must be transposed too." },
                  { "transpose_alone", transpose_alone,
                    "This is the transpose; it is the inverse that must be "
                    "transposed." },
                  { "cofactors", cofactors,
                    "The cofactors are the inverse transpose times the determinant, which is "
                    "negative where the matrix mirrors: there the normals point inward." },
                  { "unit_columns", unit_columns,
                    "The columns are made unit: that takes the scale away, but normals need "
                    "its inverse." },
                  { "not_moved", not_moved,
                    "The normals stay as they are: they must turn with the mesh." } },
    .place = place,
    .scale = 0.5f,
    .offset = 0.5f,
    .picture_points = 2,
};

int main(int argc, char **argv) { return grade_main(&task, argc, argv); }
