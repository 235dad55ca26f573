/* corners.h - triangles and clip rectangles to draw, and who covers their pixels. */
#ifndef CORNERS_H
#define CORNERS_H

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
