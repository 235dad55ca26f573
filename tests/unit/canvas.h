/* canvas.h - pictures between guard bytes, and shaders that draw given clip-space triangles and
   record what they were handed. */
#ifndef CANVAS_H
#define CANVAS_H

#define CANVAS_GUARD 256 /* bytes before and after each buffer */
#define CANVAS_BYTE 0xA5

typedef struct canvas {
    shade_target target;
    unsigned char *color, *depth; /* the blocks, guards included */
    size_t color_bytes, depth_bytes;
} canvas;

enum { CANVAS_FORMATS = 5, TEXTURE_FORMATS = 6 }; /* A8 is of textures alone */

/* 16, the most there is, for a format that there is not. */
static inline size_t canvas_pixel_bytes(shade_format format)
{
    static const size_t bytes[TEXTURE_FORMATS] = { 4, 4, 2, 2, 16, 1 };
    return (unsigned)format < TEXTURE_FORMATS ? bytes[format] : 16;
}

/* The greatest code of channel k (R, G, B, A); 0: no such channel, or floats. */
static inline int canvas_most(shade_format format, int k)
{
    static const int most565[4] = { 31, 63, 31, 0 };
    if (format == SHADE_FORMAT_RGBA32F) return 0;
    if (format == SHADE_FORMAT_A8) return k == 3 ? 255 : 0;
    return format <= SHADE_FORMAT_BGRA8 ? 255 : most565[k];
}

/* The code of channel k in the bytes of a pixel; not RGBA32F. */
static inline int canvas_code_at(shade_format format, const unsigned char *p, int k)
{
    const int swapped = format == SHADE_FORMAT_RGB565_SWAPPED;
    unsigned char native[2];
    uint16_t v;
    if (format == SHADE_FORMAT_RGBA8) return p[k];
    if (format == SHADE_FORMAT_A8) return p[0];
    if (format == SHADE_FORMAT_BGRA8) return p[k < 3 ? 2 - k : k];
    native[0] = p[swapped];
    native[1] = p[!swapped];
    memcpy(&v, native, 2);
    return k == 0 ? v >> 11 : k == 1 ? v >> 5 & 63 : k == 2 ? v & 31 : 0;
}

static inline shade_format rnd_format(void) { return (shade_format)rnd_int(0, CANVAS_FORMATS - 1); }

static inline shade_format rnd_texture_format(void)
{
    return (shade_format)rnd_int(0, TEXTURE_FORMATS - 1);
}

static inline int canvas_stride(const canvas *c)
{
    return c->target.stride ? c->target.stride : c->target.width;
}

static inline int canvas_rows(const canvas *c)
{
    return c->target.row_count ? c->target.row_count : c->target.height;
}

static inline unsigned char *canvas_block(size_t bytes)
{
    unsigned char *block = test_memory(bytes + 2 * CANVAS_GUARD);
    memset(block, CANVAS_BYTE, bytes + 2 * CANVAS_GUARD);
    return block;
}

/* 1 while every byte is that of a block that nobody wrote to. */
static inline int untouched(const void *at, size_t bytes)
{
    const unsigned char *byte = (const unsigned char *)at;
    for (size_t i = 0; i < bytes; i++) {
        if (byte[i] != CANVAS_BYTE) return 0;
    }
    return 1;
}

/* A strip of rows of a picture (row_count 0: all of it).  stride 0: width.  with_depth 0: no depth
   buffer. */
static inline canvas canvas_strip(int width, int height, int stride, shade_format format,
                                  int with_depth, int row_offset, int row_count)
{
    canvas c = { .target.width = width, .target.height = height, .target.stride = stride,
                 .target.format = format, .target.row_offset = row_offset,
                 .target.row_count = row_count };
    size_t cells = (size_t)canvas_stride(&c) * (size_t)canvas_rows(&c);
    c.color_bytes = cells * canvas_pixel_bytes(format);
    c.color = canvas_block(c.color_bytes);
    c.target.color = c.color + CANVAS_GUARD;
    c.depth_bytes = cells * 4;
    c.depth = canvas_block(c.depth_bytes);
    if (with_depth) c.target.depth = (float *)(void *)(c.depth + CANVAS_GUARD);
    return c;
}

static inline canvas canvas_open(int width, int height, int stride, shade_format format,
                                 int with_depth)
{
    return canvas_strip(width, height, stride, format, with_depth, 0, 0);
}

/* 1 while no byte of the guards and of the padding between width and stride has changed. */
static inline int canvas_intact_block(const canvas *c, const unsigned char *block, size_t bytes,
                                      size_t cell)
{
    size_t row = (size_t)canvas_stride(c) * cell, used = (size_t)c->target.width * cell;
    for (size_t i = 0; i < CANVAS_GUARD; i++) {
        if (block[i] != CANVAS_BYTE || block[CANVAS_GUARD + bytes + i] != CANVAS_BYTE) return 0;
    }
    for (size_t at = 0; at < bytes && used < row; at += row) {
        for (size_t i = used; i < row; i++) {
            if (block[CANVAS_GUARD + at + i] != CANVAS_BYTE) return 0;
        }
    }
    return 1;
}

static inline int canvas_intact(const canvas *c)
{
    return canvas_intact_block(c, c->color, c->color_bytes, canvas_pixel_bytes(c->target.format)) &&
           canvas_intact_block(c, c->depth, c->depth_bytes, 4);
}

/* 1 while no byte of colours or depths has changed since the canvas was opened. */
static inline int canvas_untouched(const canvas *c)
{
    return untouched(c->color, c->color_bytes + 2 * CANVAS_GUARD) &&
           untouched(c->depth, c->depth_bytes + 2 * CANVAS_GUARD);
}

static inline void canvas_close(canvas *c)
{
    CHECK_SAY(canvas_intact(c), "bytes around a picture of %d x %d changed", c->target.width,
              c->target.height);
    free(c->color);
    free(c->depth);
}

/* x, y in the picture; a strip's rows start at row_offset */
static inline size_t canvas_index(const canvas *c, int x, int y)
{
    return (size_t)(y - c->target.row_offset) * (size_t)canvas_stride(c) + (size_t)x;
}

static inline unsigned char *canvas_pixel(const canvas *c, int x, int y)
{
    return c->color + CANVAS_GUARD + canvas_pixel_bytes(c->target.format) * canvas_index(c, x, y);
}

static inline const unsigned char *canvas_bytes(const canvas *c, int x,
                                                int y) /* formats of 4 bytes */
{
    return canvas_pixel(c, x, y);
}

static inline unsigned canvas_565(const canvas *c, int x, int y) /* the uint16 of a pixel */
{
    uint16_t v;
    memcpy(&v, canvas_pixel(c, x, y), 2);
    return v;
}

static inline int canvas_code(const canvas *c, int x, int y, int channel)
{
    return canvas_code_at(c->target.format, canvas_pixel(c, x, y), channel);
}

static inline float canvas_float(const canvas *c, int x, int y, int channel)
{
    float v;
    memcpy(&v, canvas_pixel(c, x, y) + 4 * channel, 4);
    return v;
}

static inline float canvas_depth(const canvas *c, int x, int y)
{
    float v;
    memcpy(&v, c->depth + CANVAS_GUARD + 4 * canvas_index(c, x, y), 4);
    return v;
}

static inline int canvas_same(const canvas *a, const canvas *b) /* two pictures of one shape,
                              bit for bit */
{
    return a->color_bytes == b->color_bytes && a->depth_bytes == b->depth_bytes &&
           !memcmp(a->color + CANVAS_GUARD, b->color + CANVAS_GUARD, a->color_bytes) &&
           !memcmp(a->depth + CANVAS_GUARD, b->depth + CANVAS_GUARD, a->depth_bytes);
}

static inline void canvas_clear(canvas *c, float depth)
{
    CHECK_INT(shade_clear(&c->target, shade_v4(0, 0, 0, 0), depth), SHADE_OK);
}

/* A canvas that is cleared, to depth 1. */
static inline canvas canvas_ready(int width, int height, int stride, shade_format format,
                                  int with_depth)
{
    canvas c = canvas_open(width, height, stride, format, with_depth);
    canvas_clear(&c, 1);
    return c;
}

/* Two canvases cleared alike, and their end, where the same was to be drawn on both. */
static inline void canvas_twins(canvas c[2], int width, int height, shade_format format,
                                float depth)
{
    for (int k = 0; k < 2; k++) {
        c[k] = canvas_open(width, height, 0, format, 1);
        canvas_clear(&c[k], depth);
    }
}

static inline void canvas_twins_close(canvas c[2])
{
    CHECK(canvas_same(&c[0], &c[1]));
    canvas_close(&c[0]);
    canvas_close(&c[1]);
}

/* -------------------------------------------------------------------------------------- shaders */

typedef struct fragment_record {
    float x, y, z, lod;
    uint32_t primitive, front;
    float in[SHADE_MAX_VARYINGS];
} fragment_record;

typedef struct recorder {
    fragment_record *fragments;
    int count, capacity;
    long fragment_packets, vertex_packets, vertex_lanes;
    long bad_counts, bad_tails; /* packets that break the rules of count and of replicated lanes */
    unsigned char *vertex_seen; /* one byte per vertex, set when shaded; NULL: not wanted */
} recorder;

typedef struct scene {
    const shade_vec4 *clip; /* per vertex */
    const float *attribute; /* varyings floats per vertex */
    int varyings;
    const shade_vec4 *color; /* per primitive, for scene_flat */
    recorder *record;        /* NULL: nothing is recorded */
} scene;

static inline recorder recorder_open(int capacity)
{
    recorder r = { .capacity = capacity };
    r.fragments = test_memory((size_t)capacity * sizeof(fragment_record));
    return r;
}

static inline void scene_record_vertices(recorder *r, const shade_vertex_ids *in)
{
    r->vertex_packets++;
    r->vertex_lanes += in->count;
    if (in->count < 1 || in->count > SHADE_LANES) {
        r->bad_counts++;
        return;
    }
    for (int i = 0; i < SHADE_LANES; i++) {
        if (i >= in->count && in->index[i] != in->index[in->count - 1]) r->bad_tails++;
        if (r->vertex_seen) r->vertex_seen[in->index[i]] = 1;
    }
}

static inline void scene_put_clip(shade_vertices *out, int i, shade_vec4 p)
{
    out->clip[0][i] = p.x;
    out->clip[1][i] = p.y;
    out->clip[2][i] = p.z;
    out->clip[3][i] = p.w;
}

static inline void scene_vertex(const void *uniforms, const shade_vertex_ids *SHADE_RESTRICT in,
                                shade_vertices *SHADE_RESTRICT out)
{
    const scene *s = (const scene *)uniforms;
    if (s->record) scene_record_vertices(s->record, in);
    for (int i = 0; i < SHADE_LANES; i++) {
        scene_put_clip(out, i, s->clip[in->index[i]]);
        for (int k = 0; k < s->varyings; k++) {
            out->varying[k][i] =
                s->attribute[(size_t)in->index[i] * (size_t)s->varyings + (size_t)k];
        }
    }
}

static inline void scene_record_fragments(const scene *s, const shade_fragments *in)
{
    recorder *r = s->record;
    r->fragment_packets++;
    if (in->count < 1 || in->count > SHADE_LANES) {
        r->bad_counts++;
        return;
    }
    int last = in->count - 1;
    for (int i = in->count; i < SHADE_LANES; i++) {
        int same = float_bits(in->x[i]) == float_bits(in->x[last]);
        same &= float_bits(in->y[i]) == float_bits(in->y[last]);
        same &= float_bits(in->z[i]) == float_bits(in->z[last]);
        same &= in->primitive[i] == in->primitive[last] && in->front[i] == in->front[last];
        for (int k = 0; k < s->varyings; k++) {
            same &= float_bits(in->varying[k][i]) == float_bits(in->varying[k][last]);
        }
        if (!same) r->bad_tails++;
    }
    for (int i = 0; i < in->count && r->fragments && r->count < r->capacity; i++) {
        fragment_record *f = &r->fragments[r->count++];
        f->x = in->x[i];
        f->y = in->y[i];
        f->z = in->z[i];
        f->lod = in->lod[i];
        f->primitive = in->primitive[i];
        f->front = in->front[i];
        for (int k = 0; k < s->varyings; k++) f->in[k] = in->varying[k][i];
    }
}

/* the colour of the primitive */
static inline void scene_flat(const void *uniforms, const shade_fragments *SHADE_RESTRICT in,
                              shade_colors *SHADE_RESTRICT out)
{
    const scene *s = (const scene *)uniforms;
    if (s->record) scene_record_fragments(s, in);
    for (int i = 0; i < SHADE_LANES; i++) {
        shade_vec4 c = s->color ? s->color[in->primitive[i]] : shade_v4(1, 1, 1, 1);
        out->color[0][i] = c.x;
        out->color[1][i] = c.y;
        out->color[2][i] = c.z;
        out->color[3][i] = c.w;
    }
}

/* the first four varyings as colour */
static inline void scene_colors(const void *uniforms, const shade_fragments *SHADE_RESTRICT in,
                                shade_colors *SHADE_RESTRICT out)
{
    const scene *s = (const scene *)uniforms;
    if (s->record) scene_record_fragments(s, in);
    for (int k = 0; k < 4 && k < s->varyings; k++) {
        for (int i = 0; i < SHADE_LANES; i++) out->color[k][i] = in->varying[k][i];
    }
}

static inline shade_pipeline scene_pipeline(const scene *s)
{
    shade_pipeline p = { .vertex = scene_vertex, .fragment = scene_flat, .uniforms = s,
                         .varyings = s->varyings };
    return p;
}

/* Draws corners one after the other, by a pipeline that is good. */
static inline shade_stats canvas_draw(canvas *c, const shade_pipeline *p, int corners)
{
    shade_stats stats;
    memset(&stats, CANVAS_BYTE, sizeof stats);
    CHECK_INT(shade_draw(&c->target, p, NULL, corners, corners, &stats), SHADE_OK);
    CHECK_INT(stats.culled + stats.clipped + stats.rejected + stats.drawn, stats.triangles);
    return stats;
}

/* The clip-space place of window point (X, Y) / 256 at clip w and depth z/w.  Reached to 1/2000
   pixel in pictures of up to 16384 pixels, so that snapping finds X and Y again. */
static inline shade_vec4 clip_of_fx8(double X, double Y, int width, int height, double z_ndc,
                                     double w)
{
    double x = 2 * X / (256.0 * width) - 1, y = 1 - 2 * Y / (256.0 * height);
    return shade_v4((float)(x * w), (float)(y * w), (float)(z_ndc * w), (float)w);
}

#endif
