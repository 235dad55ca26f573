/* raster.h - the rasterizer a pixel at a time, for the page's stepper.  Pixels, depths, weights and
   1/w are what shade_draw makes of a clip rectangle of one pixel; only the edge functions, which it
   keeps to itself, are computed here, by the rule that shade.h states under >>conventions. */
#ifndef PLAYGROUND_RASTER_H
#define PLAYGROUND_RASTER_H

enum { RASTER_WIDTH = 16, RASTER_HEIGHT = 12, RASTER_PIXELS = 192, RASTER_MOST = 3 };
static const float raster_near = 0.5f, raster_far = 12;

/* All floats.  order 0: the pixels of a triangle, then the next triangle; 1: the triangles of a
   pixel, then the next pixel.  A corner is x and y in pixels and w, its distance from the eye. */
typedef struct raster_state {
    float triangles, order, corner[RASTER_MOST][3][3];
} raster_state;

typedef struct raster_step { int triangle, x, y; } raster_step;

/* One triangle at one pixel.  edge[i] is twice the area that pixel and the edge opposite to corner
   i span, in square pixels, positive inside; owns[i]: pixels on that edge belong to the triangle.
   share: the weights on the screen; weight: those in the plane of the triangle. */
typedef struct raster_answer {
    double covered, edge[3], owns[3], area, share[3], weight[3], rw, z, before, passes, after;
} raster_answer;

static raster_state raster;
static uint32_t raster_pixels[RASTER_PIXELS];
static float raster_depth[RASTER_PIXELS];
static raster_step raster_list[RASTER_MOST * RASTER_PIXELS];

/* ---- what shade_draw is given, and what it gives --------------------------------------------- */

typedef struct raster_record { int count; float z, varying[4]; } raster_record;
static raster_record raster_seen;

static void raster_vertex(const void *uniforms, const shade_vertex_ids *SHADE_RESTRICT in,
                          shade_vertices *SHADE_RESTRICT out)
{
    (void)uniforms;
    SHADE_EACH_LANE(i) {
        const float *c = raster.corner[in->index[i] / 3][in->index[i] % 3];
        const float w = c[2], n = raster_near, f = raster_far;
        out->clip[0][i] = (2 * c[0] / RASTER_WIDTH - 1) * w;
        out->clip[1][i] = (1 - 2 * c[1] / RASTER_HEIGHT) * w;
        out->clip[2][i] = ((f + n) * w - 2 * f * n) / (f - n);
        out->clip[3][i] = w;
        for (uint32_t k = 0; k < 3; k++) out->varying[k][i] = in->index[i] % 3 == k;
        out->varying[3][i] = 1 / w;
    }
}

static void raster_record_fragment(const void *uniforms, const shade_fragments *SHADE_RESTRICT in,
                                   shade_colors *SHADE_RESTRICT out)
{
    (void)uniforms;
    (void)out;
    raster_seen.count += in->count;
    raster_seen.z = in->z[0];
    for (int k = 0; k < 4; k++) raster_seen.varying[k] = in->varying[k][0];
}

/* The colour of a triangle, brighter toward corner 0 and darker toward corner 2: interpolated */
static void raster_fragment(const void *uniforms, const shade_fragments *SHADE_RESTRICT in,
                            shade_colors *SHADE_RESTRICT out)
{
    const float *rgb = (const float *)uniforms;
    SHADE_EACH_LANE(i) {
        const float share = 1.5f * in->varying[0][i] + 0.7f * in->varying[1][i] +
                            0.2f * in->varying[2][i];
        for (int k = 0; k < 3; k++) out->color[k][i] = rgb[k] * share;
    }
}

static const float raster_colors[RASTER_MOST][3] = {
    { 0.85f, 0.36f, 0.06f }, { 0.06f, 0.30f, 0.75f }, { 0.10f, 0.48f, 0.16f }
};

/* Draws one triangle at one pixel.  Returns whether the pixel passed. */
static int raster_draw(raster_step s, shade_fragment_shader *fragment,
                       shade_interpolation interpolation, uint32_t *color, float *depths)
{
    const uint32_t first = 3 * (uint32_t)s.triangle, corner[3] = { first, first + 1, first + 2 };
    const shade_target target = { .width = RASTER_WIDTH, .height = RASTER_HEIGHT, .color = color,
                                  .depth = depths, .srgb = 1, .clip_x = s.x, .clip_y = s.y,
                                  .clip_width = 1, .clip_height = 1 };
    const shade_pipeline pipeline = { .vertex = raster_vertex, .fragment = fragment,
                                      .uniforms = raster_colors[s.triangle], .varyings = 4,
                                      .interpolation = interpolation };
    shade_stats stats;
    shade_draw(&target, &pipeline, corner, 3, 3 * RASTER_MOST, &stats);
    return stats.fragments > 0;
}

/* ---- edge functions, exact in 1/256 pixel ---------------------------------------------------- */

static int64_t raster_snap(float x) { return (int64_t)floor(256 * (double)x + 0.5); }

static void raster_edges(raster_step s, raster_answer *a)
{
    const float(*corner)[3] = raster.corner[s.triangle];
    int64_t x[3], y[3], e[3], area = 0;
    const int64_t px = 256 * s.x + 128, py = 256 * s.y + 128;
    for (int k = 0; k < 3; k++) {
        x[k] = raster_snap(corner[k][0]);
        y[k] = raster_snap(corner[k][1]);
    }
    for (int k = 0; k < 3; k++) {
        const int from = (k + 1) % 3, to = (k + 2) % 3;
        e[k] = (x[to] - x[from]) * (py - y[from]) - (y[to] - y[from]) * (px - x[from]);
        area += e[k];
    }
    for (int k = 0; k < 3; k++) {
        const int from = (k + 1) % 3, to = (k + 2) % 3, sign = area < 0 ? -1 : 1;
        const int64_t right = sign * (x[to] - x[from]), down = sign * (y[to] - y[from]);
        a->edge[k] = (double)(sign * e[k]) / 65536;
        a->owns[k] = down < 0 || (down == 0 && right > 0);    /* left, or top */
    }
    a->area = (double)(area < 0 ? -area : area) / 65536;
}

/* ---- what the page calls --------------------------------------------------------------------- */

PAGE(raster_state *, page_raster)(void) { return &raster; }
PAGE(const uint32_t *, page_raster_pixels)(void) { return raster_pixels; }
PAGE(const float *, page_raster_depth)(void) { return raster_depth; }

/* The pixels whose centres may lie in a triangle, as low and high of x and y */
static void raster_box(int triangle, int box[4])
{
    for (int axis = 0; axis < 2; axis++) {
        float low = 1e9f, high = -1e9f;
        int last = axis ? RASTER_HEIGHT - 1 : RASTER_WIDTH - 1;
        for (int k = 0; k < 3; k++) {
            float v = raster.corner[triangle][k][axis];
            if (v < low) low = v;
            if (v > high) high = v;
        }
        box[2 * axis] = low > 0 ? (int)low : 0;
        box[2 * axis + 1] = high < (float)last ? (int)high : last;
    }
}

/* The steps in their order, the same ones in both */
static int raster_steps(void)
{
    const int triangles = (int)raster.triangles, pixel_first = raster.order != 0;
    int box[RASTER_MOST][4], count = 0;
    for (int t = 0; t < triangles; t++) raster_box(t, box[t]);
    for (int outer = 0; outer < (pixel_first ? RASTER_PIXELS : triangles); outer++) {
        for (int inner = 0; inner < (pixel_first ? triangles : RASTER_PIXELS); inner++) {
            const int t = pixel_first ? inner : outer, p = pixel_first ? outer : inner;
            const int x = p % RASTER_WIDTH, y = p / RASTER_WIDTH, *b = box[t];
            if (x < b[0] || x > b[1] || y < b[2] || y > b[3]) continue;
            raster_list[count++] = (raster_step){ t, x, y };
        }
    }
    return count;
}

/* Clears both buffers and makes the first steps.  Returns how many there are. */
PAGE(int, page_raster_run)(int steps)
{
    const shade_target target = { .width = RASTER_WIDTH, .height = RASTER_HEIGHT,
                                  .color = raster_pixels, .depth = raster_depth, .srgb = 1 };
    const int count = raster_steps();
    shade_clear(&target, shade_v4(0, 0, 0, 0), 1);
    for (int i = 0; i < steps && i < count; i++)
        raster_draw(raster_list[i], raster_fragment, SHADE_INTERPOLATION_PERSPECTIVE,
                    raster_pixels, raster_depth);
    return count;
}

PAGE(const raster_step *, page_raster_step)(int i) { return &raster_list[i]; }

/* What a triangle does at a pixel, with the depth that is stored there now */
PAGE(const raster_answer *, page_raster_ask)(int triangle, int x, int y)
{
    static raster_answer a;
    static uint32_t color[RASTER_PIXELS];
    static float depths[RASTER_PIXELS];
    static const raster_answer none;
    const raster_step s = { triangle, x, y };
    const int at = y * RASTER_WIDTH + x;
    a = none;
    if (triangle < 0 || triangle >= RASTER_MOST || x < 0 || x >= RASTER_WIDTH || y < 0 ||
        y >= RASTER_HEIGHT)
        return &a;
    raster_edges(s, &a);
    for (int way = 0; way < 2; way++) {              /* the weights in the plane, on the screen */
        raster_seen.count = 0;
        depths[at] = 1;
        raster_draw(s, raster_record_fragment,
                    way ? SHADE_INTERPOLATION_AFFINE : SHADE_INTERPOLATION_PERSPECTIVE, color,
                    depths);
        for (int k = 0; raster_seen.count && k < 3; k++)
            *(way ? &a.share[k] : &a.weight[k]) = (double)raster_seen.varying[k];
    }
    a.covered = raster_seen.count > 0;
    a.rw = a.covered != 0 ? (double)raster_seen.varying[3] : 0;
    a.z = a.covered != 0 ? (double)raster_seen.z : 0;
    depths[at] = raster_depth[at];
    a.before = (double)depths[at];
    a.passes = raster_draw(s, raster_record_fragment, SHADE_INTERPOLATION_PERSPECTIVE, color,
                           depths);
    a.after = (double)depths[at];
    return &a;
}
#endif
