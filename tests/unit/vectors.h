/* vectors.h - random vectors and matrices, and checks of them. */
#ifndef VECTORS_H
#define VECTORS_H

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

#endif
