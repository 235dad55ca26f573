/* camera.h - cameras in double: by an eye and a target, by OpenCV's and OpenGL's matrices, and
   the nearest one that sees all points from a side.

       core_camera c;
       core_look_at(&why, eye, target, up, 45, 4.0 / 3, 0.01, 1000, &c);

   A camera is a view, from the world to a space that looks down -z with +y up, and a projection
   on to clip space, -w <= x, y, z <= w, as OpenGL has it: 16 numbers by columns each.  All sizes
   are relative to the points: a model of atoms and one of a galaxy are seen alike. */
#ifndef CORE_CAMERA_H
#define CORE_CAMERA_H

#include "refuse.h"

#define CORE_PI 3.14159265358979323846

typedef struct core_camera {
    double view[16], projection[16];
} core_camera;

typedef struct core_range { /* what of a projection is along the axis of view */
    double near, far;
    int parallel;
} core_range;

/* ---- vectors --------------------------------------------------------------------------------- */

static inline double core_dot(const double *a, const double *b)
{
    return a[0] * b[0] + a[1] * b[1] + a[2] * b[2];
}

static inline double core_length(const double *a) { return sqrt(core_dot(a, a)); }

static inline void core_cross(const double *a, const double *b, double *out)
{
    for (int k = 0; k < 3; k++)
        out[k] = a[(k + 1) % 3] * b[(k + 2) % 3] - a[(k + 2) % 3] * b[(k + 1) % 3];
}

static inline void core_unit(double *a)
{
    const double most = fmax(fabs(a[0]), fmax(fabs(a[1]), fabs(a[2])));
    const int tame = most > 1e-100 && most < 1e100; /* squares of others are no doubles */
    for (int k = 0; k < 3 && !tame && most > 0; k++) a[k] /= most;
    const double length = core_length(a);
    for (int k = 0; k < 3; k++) a[k] /= length;
}

/* The rows of a rotation after which back is +z, and up is as near to +y as it can be: where both
   are one line, the axis that is furthest from it stands in for up. */
static inline void core_facing(const double *back, const double *up, double rows[9])
{
    double *x = rows, *y = rows + 3, *z = rows + 6, head[3] = { up[0], up[1], up[2] };
    int least = 0;
    memcpy(z, back, 3 * sizeof *z);
    core_unit(z);
    if (core_dot(up, up) > 0) core_unit(head);
    core_cross(head, z, x);
    for (int k = 1; k < 3; k++) least = fabs(z[k]) < fabs(z[least]) ? k : least;
    if (!(core_length(x) >= 1e-6)) {
        const double axis[3] = { least == 0, least == 1, least == 2 };
        core_cross(axis, z, x);
    }
    core_unit(x);
    core_cross(z, x, y);
}

/* A view of the rows of a rotation and a place behind it */
static inline void core_view(const double rows[9], double x, double y, double z, double view[16])
{
    for (int k = 0; k < 9; k++) view[k % 3 * 4 + k / 3] = rows[k];
    view[3] = view[7] = view[11] = 0;
    view[12] = x;
    view[13] = y;
    view[14] = z;
    view[15] = 1;
}

/* ---- projections ----------------------------------------------------------------------------- */

static inline int core_near_far(core_refusal *r, double near, double far)
{
    core_number(r, "near", near, 1e-30, 1e30);
    core_number(r, "far", far, 1e-30, 1e31);
    if (!r->code && far <= near)
        core_refuse(r, CORE_RANGE, "far", "must exceed near, %g, not %g", near, far);
    return r->code;
}

/* The third row, of depth, of a perspective */
static inline void core_depth(double near, double far, double *m)
{
    m[10] = (far + near) / (near - far);
    m[14] = 2 * far * near / (near - far);
    m[11] = -1;
}

/* fov: the vertical angle in degrees; aspect: width by height */
static inline int core_perspective(core_refusal *r, double fov, double aspect, double near,
                                   double far, double m[16])
{
    double slope;
    core_near_far(r, near, far);
    core_number(r, "fov", fov, 0.01, 179);
    if (core_number(r, "aspect", aspect, 1e-4, 1e4)) return r->code;
    slope = tan(fov * (CORE_PI / 180) / 2);
    memset(m, 0, 16 * sizeof *m);
    m[0] = 1 / (slope * aspect);
    m[5] = 1 / slope;
    core_depth(near, far, m);
    return 0;
}

/* near, far and kind of a projection of OpenGL; far at most 3e30, which stands for none */
static inline int core_range_of(core_refusal *r, const char *argument, const double m[16],
                                core_range *out)
{
    const double a = m[10] / -m[11], b = m[14] / -m[11];
    out->parallel = m[15] != 0;
    if (out->parallel) {
        out->near = (m[14] + 1) / m[10];
        out->far = (m[14] - 1) / m[10];
        if (m[11] == 0 && out->near < out->far) return r->code;
        return core_refuse(
            r, CORE_SHAPE, argument,
            "must have near and far planes as OpenGL's matrices do, near before far");
    }
    out->near = b / (a - 1);
    out->far = a < -1 ? b / (a + 1) : 3e30;
    out->far = out->far < 3e30 ? out->far : 3e30;
    /* a is -1 where there is no far plane, or a bit more; with reversed depth it is above 0 */
    if (a <= -0.999 && out->near > 0 && out->near < out->far) return r->code;
    return core_refuse(r, CORE_SHAPE, argument,
                       "must have near and far planes as OpenGL's matrices do, 0 < near < far");
}

/* ---- cameras of one's own -------------------------------------------------------------------- */

static inline int core_look_at(core_refusal *r, const double eye[3], const double target[3],
                               const double up[3], double fov, double aspect, double near,
                               double far, core_camera *out)
{
    double rows[9], back[3];
    core_numbers(r, "eye", eye, 3);
    core_numbers(r, "target", target, 3);
    core_numbers(r, "up", up, 3);
    for (int k = 0; k < 3; k++) back[k] = eye[k] - target[k];
    if (back[0] == 0 && back[1] == 0 && back[2] == 0)
        core_refuse(r, CORE_SHAPE, "eye", "and target must differ");
    if (core_perspective(r, fov, aspect, near, far, out->projection)) return r->code;
    core_facing(back, up, rows);
    core_view(rows, -core_dot(rows, eye), -core_dot(rows + 3, eye), -core_dot(rows + 6, eye),
              out->view);
    return 0;
}

/* K: 3 x 3 row by row, in pixels whose centres are whole numbers.  extrinsics: 16 numbers row by
   row, a rotation and a translation, to a camera that looks down +z with +y down.  The camera is
   that of pictures of one size. */
static inline int core_opencv(core_refusal *r, const double K[9], const double extrinsics[16],
                              int width, int height, double near, double far, core_camera *out)
{
    static const double side[3] = { 1, -1, -1 };
    double *m = out->projection;
    core_numbers(r, "K", K, 9);
    if (!r->code &&
        (K[0] == 0 || K[4] == 0 || fabs(K[6]) > 1e-6 || fabs(K[7]) > 1e-6 || fabs(K[8] - 1) > 1e-6))
        core_refuse(r, CORE_SHAPE, "K",
                    "must have focal lengths that are not 0, and 0, 0, 1 in the last row");
    core_rigid(r, "extrinsics", extrinsics);
    if (core_near_far(r, near, far)) return r->code;
    for (int k = 0; k < 16; k++)
        out->view[k] = k % 4 < 3 ? side[k % 4] * extrinsics[k % 4 * 4 + k / 4] : k == 15;
    memset(m, 0, sizeof out->projection);
    m[0] = 2 * K[0] / width;
    m[4] = -2 * K[1] / width;
    m[8] = 1 - (2 * K[2] + 1) / width;
    m[5] = 2 * K[4] / height;
    m[9] = (2 * K[5] + 1) / height - 1;
    core_depth(near, far, m);
    return 0;
}

/* projection takes points of a camera to clip space; pose, row by row as in pyrender, is where
   the camera stands, unscaled and not mirrored. */
static inline int core_opengl(core_refusal *r, const double projection[16], const double pose[16],
                              core_camera *out)
{
    double rows[9];
    core_range range;
    core_numbers(r, "projection", projection, 16);
    core_rigid(r, "pose", pose);
    if (core_range_of(r, "projection", projection, &range)) return r->code;
    for (int k = 0; k < 9; k++) rows[k] = pose[k % 3 * 4 + k / 3];
    const double at[3] = { pose[3], pose[7], pose[11] };
    core_view(rows, -core_dot(rows, at), -core_dot(rows + 3, at), -core_dot(rows + 6, at),
              out->view);
    memcpy(out->projection, projection, sizeof out->projection);
    return 0;
}

/* ---- the nearest camera that sees all points ------------------------------------------------- */

/* A side to see points from */
typedef struct core_side {
    double azimuth, elevation; /* degrees, from the front, -y, to the right; over the horizon */
    int up;                    /* the upright axis: x, y, z, -x, -y, -z */
    int width, height;
    int ortho;
    double fov, margin; /* margin: 1.08 leaves a bit of room around the points */
    double room;        /* how much deeper than the points the picture reaches, by their extent */
} core_side;

/* Extremes of points: in the axes of the camera, and of what bounds the eye from four sides */
typedef struct core_cloud {
    double turn[9], slope[2], low[3], high[3], above[2], below[2];
    int some;
} core_cloud;

/* From the frame with z upright and -y in front to that of another upright axis */
static inline void core_upright(int up, const double v[3], double out[3])
{
    const double side = up < 3 ? 1 : -1, p[3] = { v[0], side * v[1], side * v[2] };
    const int from = up % 3 == 0 ? 2 : 0; /* the place in p that x of out has */
    out[0] = p[from];
    out[1] = up % 3 == 0 ? p[0] : up % 3 == 1 ? p[2] : p[1];
    out[2] = up % 3 == 0 ? p[1] : up % 3 == 1 ? -p[1] : p[2];
}

/* The way toward the eye, and the way up */
static inline void core_direction(double azimuth, double elevation, int up, double back[3],
                                  double head[3])
{
    const double a = azimuth * (CORE_PI / 180), e = elevation * (CORE_PI / 180);
    const double b[3] = { sin(a) * cos(e), -cos(a) * cos(e), sin(e) };
    const double h[3] = { -sin(a) * sin(e), cos(a) * sin(e), cos(e) };
    core_upright(up, b, back);
    core_upright(up, h, head);
}

/* The views that have names; NULL: there are no more */
static inline const char *core_view_name(int i, double *azimuth, double *elevation)
{
    static const char *const names[] = { "front", "right", "back", "left", "top", "bottom", "iso" };
    static const double angles[][2] = { { 0, 0 },
                                        { 90, 0 },
                                        { 180, 0 },
                                        { 270, 0 },
                                        { 0, 90 },
                                        { 0, -90 },
                                        { 45, 35.264389682754654 } };
    if (i < 0 || i >= (int)(sizeof names / sizeof *names)) return NULL;
    *azimuth = angles[i][0];
    *elevation = angles[i][1];
    return names[i];
}

static inline int core_cloud_open(core_refusal *r, const core_side *s, core_cloud *out)
{
    static const core_cloud none;
    double back[3], head[3], slope;
    *out = none;
    core_number(r, "view[0]", s->azimuth, -1e6, 1e6);
    core_number(r, "view[1]", s->elevation, -1e6, 1e6);
    core_number(r, "fov", s->fov, 0.01, 179);
    if (core_number(r, "margin", s->margin, 0.01, 100)) return r->code;
    slope = tan(s->fov * (CORE_PI / 180) / 2);
    core_direction(s->azimuth, s->elevation, s->up, back, head);
    core_facing(back, head, out->turn);
    out->slope[0] = slope * s->width / s->height;
    out->slope[1] = slope;
    return 0;
}

static inline void core_cloud_point(core_cloud *c, const double p[3])
{
    const double at[3] = { core_dot(p, c->turn), core_dot(p, c->turn + 3),
                           core_dot(p, c->turn + 6) };
    for (int k = 0; k < 3; k++) {
        if (!c->some || at[k] < c->low[k]) c->low[k] = at[k];
        if (!c->some || at[k] > c->high[k]) c->high[k] = at[k];
    }
    for (int k = 0; k < 2; k++) {
        const double above = at[k] + c->slope[k] * at[2], below = c->slope[k] * at[2] - at[k];
        if (!c->some || above > c->above[k]) c->above[k] = above;
        if (!c->some || below > c->below[k]) c->below[k] = below;
    }
    c->some = 1;
}

/* Where a point is, as a float has it; pose: 16 numbers by columns, NULL: it stays.  0: it is not
   finite, or so far away that no float is left for its distance, and does not count */
static inline int core_point(const float *p, const double *pose, double out[3])
{
    const double at[3] = { (double)p[0], (double)p[1], (double)p[2] };
    for (int k = 0; k < 3; k++) {
        float x = p[k];
        if (pose)
            x = (float)(at[0] * pose[k] + at[1] * pose[4 + k] + at[2] * pose[8 + k] + pose[12 + k]);
        if (!(x <= 1e30f && x >= -1e30f)) return 0;
        out[k] = (double)x;
    }
    return 1;
}

/* Adds points; used: a byte for each, 0: it does not count; NULL: all do */
static inline void core_cloud_add(core_cloud *c, const float *points, const uint8_t *used,
                                  size_t count, const double *pose)
{
    double at[3];
    for (size_t i = 0; i < count; i++)
        if ((!used || used[i]) && core_point(points + 3 * i, pose, at)) core_cloud_point(c, at);
}

/* How far the points reach from each other; what has no extent, by its distance from zero, or 1
   */
static inline double core_extent(const core_cloud *c)
{
    double diagonal[3], most = 0;
    for (int k = 0; k < 3; k++) {
        diagonal[k] = c->high[k] - c->low[k];
        most = fmax(most, fmax(fabs(c->low[k]), fabs(c->high[k])));
    }
    const double reach = fmax(core_length(diagonal), most * 1e-6);
    return reach > 0 ? reach : 1;
}

static inline void core_fit_flat(const core_cloud *c, const core_side *s, double reach,
                                 core_camera *out)
{
    const double x = (c->high[0] - c->low[0]) / 2, y = (c->high[1] - c->low[1]) / 2;
    const double half = s->margin * fmax(fmax(y, x * s->height / s->width), 1e-4 * reach);
    double *m = out->projection;
    core_view(c->turn, -(c->low[0] + c->high[0]) / 2, -(c->low[1] + c->high[1]) / 2,
              -(c->low[2] + c->high[2]) / 2 - 2 * reach, out->view);
    memset(m, 0, sizeof out->projection);
    m[0] = s->height / (half * s->width);
    m[5] = 1 / half;
    m[10] = -1 / (2 * reach);
    m[14] = -1;
    m[15] = 1;
}

/* The nearest camera that sees all points.  Each side of the picture gives one bound on the eye,
   linear in a point's coordinates; their extremes give the distance, and the shift that centres.
   */
static inline void core_fit(core_cloud *c, const core_side *s, core_camera *out)
{
    static const double zero[3];
    double shift[2], least, distance, reach, near, far;
    if (!c->some) core_cloud_point(c, zero);
    reach = core_extent(c);
    if (s->ortho) {
        core_fit_flat(c, s, reach, out);
        return;
    }
    least = c->high[2] + 1e-3 * reach;
    for (int k = 0; k < 2; k++) {
        shift[k] = (c->above[k] - c->below[k]) / 2;
        least = fmax(least, (c->above[k] + c->below[k]) / (2 * c->slope[k]));
    }
    distance = least + (s->margin - 1) * (least - (c->low[2] + c->high[2]) / 2);
    near = distance - c->high[2] - s->room * reach;
    far = distance - c->low[2] + s->room * reach;
    near = fmax(0.9 * near, (s->room > 0 ? 0.01 : 1e-4) * far);
    far = 1.1 * far + 1e-3 * reach;
    memset(out->projection, 0, sizeof out->projection);
    out->projection[0] = 1 / c->slope[0];
    out->projection[5] = 1 / c->slope[1];
    core_depth(near, far, out->projection);
    core_view(c->turn, -shift[0], -shift[1], -distance, out->view);
}

/* ---- the studio ------------------------------------------------------------------------------ */

/* A sphere around points: its middle is that of their box */
typedef struct core_ball {
    double low[3], high[3], radius;
    int some;
} core_ball;

static inline void core_ball_add(core_ball *b, const float *points, const uint8_t *used,
                                 size_t count, const double *pose)
{
    double at[3];
    for (size_t i = 0; i < count; i++) {
        if ((used && !used[i]) || !core_point(points + 3 * i, pose, at)) continue;
        for (int k = 0; k < 3; k++) {
            b->low[k] = b->some && b->low[k] < at[k] ? b->low[k] : at[k];
            b->high[k] = b->some && b->high[k] > at[k] ? b->high[k] : at[k];
        }
        b->some = 1;
    }
}

/* The second pass, over the same points */
static inline void core_ball_reach(core_ball *b, const float *points, const uint8_t *used,
                                   size_t count, const double *pose)
{
    double at[3];
    for (size_t i = 0; i < count; i++) {
        if ((used && !used[i]) || !core_point(points + 3 * i, pose, at)) continue;
        for (int k = 0; k < 3; k++) at[k] -= (b->low[k] + b->high[k]) / 2;
        b->radius = fmax(b->radius, core_length(at));
    }
}

/* To the studio, 16 numbers by columns: the ball about the origin with radius 1, +y up, +z toward
   the eye of a view.  up: as in a core_side, of which the axis counts, and its sign */
static inline void core_studio(const core_ball *b, const double view[16], int up, double out[16])
{
    const double upward[3] = { 0, 0, 1 }, size = b->radius > 0 ? b->radius : 1;
    double y[3], rows[9], middle[3];
    core_upright(up, upward, y);
    for (int row = 0; row < 2; row++) {
        double *x = rows;
        const double way[3] = { view[row], view[4 + row], view[8 + row] }, along = core_dot(way, y);
        if (row && core_length(x) >= 1e-3) break;
        for (int k = 0; k < 3; k++) x[k] = way[k] - along * y[k];
    }
    core_unit(rows);
    memcpy(rows + 3, y, sizeof y);
    core_cross(rows, y, rows + 6);
    for (int k = 0; k < 3; k++) middle[k] = (b->low[k] + b->high[k]) / 2;
    for (int k = 0; k < 9; k++) rows[k] /= size;
    core_view(rows, -core_dot(rows, middle), -core_dot(rows + 3, middle),
              -core_dot(rows + 6, middle), out);
}

/* ---- far away -------------------------------------------------------------------------------- */

/* From where coordinates in a box are counted, so that floats keep their digits: zero, or for a
   box more than 16 times its size away a round number near it, of which doubles subtract without
   rounding */
static inline void core_origin(const double low[3], const double high[3], double origin[3])
{
    double extent = 0, far = 0, step;
    for (int k = 0; k < 3; k++) {
        extent = fmax(extent, high[k] - low[k]);
        far = fmax(far, fabs((low[k] + high[k]) / 2));
        origin[k] = 0;
    }
    if (far - far != 0 || extent - extent != 0 || far <= 16 * extent) return;
    step = extent > 0 ? pow(10, ceil(log10(extent))) : 1;
    for (int k = 0; k < 3; k++) origin[k] = nearbyint((low[k] + high[k]) / 2 / step) * step;
}

/* The eye of a camera in the space of a mesh, or where all see the same way the way toward it.
   view and pose: by columns.  0: the pose flattens the mesh, and there is none */
static inline int core_eye(const double *view, int parallel, const double *pose, double eye[3])
{
    const double *a = pose, *b = pose + 4, *c = pose + 8;
    double row[3][3], p[3], det;
    core_cross(b, c, row[0]);
    core_cross(c, a, row[1]);
    core_cross(a, b, row[2]);
    det = core_dot(a, row[0]);
    for (int k = 0; k < 3; k++)
        p[k] = parallel ? view[4 * k + 2] : -core_dot(view + 4 * k, view + 12) - pose[12 + k];
    for (int i = 0; i < 3; i++) {
        for (int k = 0; k < 3; k++) row[i][k] /= det;
        eye[i] = core_dot(row[i], p);
    }
    return det != 0;
}

/* A mesh in its place: its coordinates count from an origin, and reach so far from it. */
typedef struct core_place {
    double pose[16], origin[3], reach; /* pose: by columns */
} core_place;

/* Poses become those of a world that counts from an origin, so that floats can hold them. */
static inline void core_place_all(core_place *all, int count, double origin[3])
{
    double low[3] = { 0, 0, 0 }, high[3] = { 0, 0, 0 };
    for (int i = 0; i < count; i++) {
        double *m = all[i].pose, *o = all[i].origin, scale = 0;
        for (int k = 0; k < 3; k++) m[12 + k] += m[k] * o[0] + m[4 + k] * o[1] + m[8 + k] * o[2];
        for (int k = 0; k < 11; k++) scale = k % 4 < 3 ? fmax(scale, fabs(m[k])) : scale;
        for (int k = 0; k < 3; k++) {
            const double a = m[12 + k] - scale * all[i].reach, b = m[12 + k] + scale * all[i].reach;
            low[k] = i && low[k] < a ? low[k] : a;
            high[k] = i && high[k] > b ? high[k] : b;
        }
    }
    core_origin(low, high, origin);
    for (int i = 0; i < count; i++)
        for (int k = 0; k < 3; k++) all[i].pose[12 + k] -= origin[k];
}
#endif
