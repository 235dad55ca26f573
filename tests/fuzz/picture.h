/* picture.h - targets and textures made of an input, what the contract says of them, and what holds
   of every call that draws. */
#ifndef FUZZ_PICTURE_H
#define FUZZ_PICTURE_H
#include "input.h"

typedef struct picture {
    shade_target target;
    shade_result want;                   /* SHADE_OK, or what a call has to say of the target */
    int rows, stride;                    /* in memory */
    int one_width;                       /* a NaN may arise, whose sign IEEE leaves open */
    uint8_t *color, *depth;              /* NULL: none */
    size_t color_bytes, depth_bytes;
    uint8_t *before, *after;             /* copies: color, then depth */
} picture;

enum { FUZZ_FORMATS = 5, FUZZ_TEXTURES = 6 };    /* of targets, of textures */
static inline size_t fuzz_pixel_bytes(shade_format format)
{
    static const uint8_t bytes[FUZZ_TEXTURES] = { 4, 4, 2, 2, 16, 1 };
    return (unsigned)format < FUZZ_TEXTURES ? bytes[format] : 16;
}

static inline size_t fuzz_cells(int rows, int stride, int width)
{
    return ((size_t)rows - 1) * (size_t)stride + (size_t)width;
}

static inline shade_result picture_verdict(const shade_target *t)
{
    int64_t rows = t->row_count ? t->row_count : t->height;
    if (!t->color && !t->depth) return SHADE_ERROR_TARGET;
    if (t->width < 1 || t->width > 16384 || t->height < 1 || t->height > 16384)
        return SHADE_ERROR_TARGET;
    if (t->stride && t->stride < t->width) return SHADE_ERROR_TARGET;
    if ((int)t->format < 0 || (int)t->format >= FUZZ_FORMATS) return SHADE_ERROR_TARGET;
    if (t->clip_width < 0 || t->clip_height < 0) return SHADE_ERROR_TARGET;
    if (t->row_count < 0 || t->row_offset < 0) return SHADE_ERROR_TARGET;
    if (t->row_offset && !t->row_count) return SHADE_ERROR_TARGET;
    if ((int64_t)t->row_offset + rows > t->height) return SHADE_ERROR_TARGET;
    if (rows * (t->stride ? t->stride : t->width) > 0xFFFFFFFF) return SHADE_ERROR_TARGET;
    return SHADE_OK;
}

/* The clip rectangle within the rows in memory; 0: empty. */
static inline int picture_clip(const shade_target *t, int *x0, int *y0, int *x1, int *y1)
{
    int64_t l = t->clip_x, u = t->clip_y, r = l + t->clip_width, d = u + t->clip_height;
    int64_t top = t->row_offset, bottom = top + (t->row_count ? t->row_count : t->height);
    if (!t->clip_x && !t->clip_y && !t->clip_width && !t->clip_height) {
        r = t->width;
        d = bottom;
    }
    l = l < 0 ? 0 : l;
    u = u < top ? top : u;
    r = r > t->width ? t->width : r;
    d = d > bottom ? bottom : d;
    if (l >= r || u >= d) l = r = u = d = 0;
    *x0 = (int)l;
    *y0 = (int)u;
    *x1 = (int)r;
    *y1 = (int)d;
    return r > l;
}

/* One field of a good target made any number. */
static inline void picture_spoil(fuzz_input *in, shade_target *t)
{
    int bad = 0;
    switch (fuzz_byte(in) % 15) {
        case 0: t->width = fuzz_wild_int(in);
            break;
        case 1: t->height = fuzz_wild_int(in);
            break;
        case 2: t->stride = fuzz_wild_int(in);
            break;
        case 3:
            t->format = (shade_format)fuzz_enum(in, FUZZ_FORMATS, &bad);
            break;
        case 4:
            t->clip_x = fuzz_wild_int(in);
            t->clip_width = fuzz_wild_int(in);
            break;
        case 5:
            t->clip_y = fuzz_wild_int(in);
            t->clip_height = fuzz_wild_int(in);
            break;
        case 6: t->clip_width = fuzz_wild_int(in);
            break;
        case 7: t->row_offset = fuzz_wild_int(in);
            break;
        case 8: t->row_count = fuzz_wild_int(in);
            break;
        case 9:
            t->row_offset = fuzz_wild_int(in);
            t->row_count = fuzz_wild_int(in);
            break;
        case 10:
            t->width = 16384;
            t->height = 1;
            t->row_count = t->row_offset = 0;
            break;
        case 11:
            t->width = 1;
            t->height = 16384;
            t->row_count = t->row_offset = 0;
            break;
        case 12:
            t->height = 16384;
            t->row_offset = fuzz_int(in, 0, 16376);
            t->row_count = fuzz_int(in, 1, 8);
            break;
        default: break;
    }
}

static inline void picture_shape(fuzz_input *in, shade_target *t, int most)
{
    static uint8_t memory[1];            /* stands for memory in the verdict */
    static float depth[1];
    uint32_t kind = fuzz_byte(in);
    memset(t, 0, sizeof *t);
    t->width = fuzz_int(in, 1, most);
    t->height = fuzz_int(in, 1, most);
    t->format = (shade_format)(fuzz_byte(in) % FUZZ_FORMATS);
    t->srgb = kind & 1;
    t->dither = kind >> 1 & 1;
    if (kind & 4) t->stride = t->width + fuzz_int(in, 0, 6);
    if (kind & 8) {
        t->clip_x = fuzz_int(in, -6, t->width + 1);
        t->clip_width = fuzz_int(in, 0, t->width + 4);
        t->clip_y = fuzz_int(in, -6, t->height + 1);
        t->clip_height = fuzz_int(in, 0, t->height + 4);
    }
    if (kind & 16) {
        t->row_offset = fuzz_int(in, 0, t->height - 1);
        t->row_count = fuzz_int(in, 1, t->height - t->row_offset);
    }
    if ((kind >> 5) != 1) t->color = memory;
    if ((kind >> 5) != 2) t->depth = depth;
    if ((kind >> 5) == 7 && fuzz_one_in(in, 2)) picture_spoil(in, t);
    if ((kind >> 5) == 3 && fuzz_one_in(in, 16)) {
        t->color = NULL;
        t->depth = NULL;
    }
}

/* Memory for a target: to its last pixel, or to the end of its last row. */
static inline void picture_memory(fuzz_input *in, picture *p)
{
    shade_target *t = &p->target;
    uint32_t kind = fuzz_byte(in);
    size_t cells = 4;
    p->want = picture_verdict(t);
    p->rows = t->row_count ? t->row_count : t->height;
    p->stride = t->stride ? t->stride : t->width;
    if (p->want == SHADE_OK && fuzz_cells(p->rows, p->stride, t->width) > GUARD_ROOM / 16) {
        t->stride = 0;
        p->stride = t->width;
        if (fuzz_cells(p->rows, p->stride, t->width) > GUARD_ROOM / 16) {
            t->height = p->rows = 1;
            t->row_count = t->row_offset = 0;
        }
    }
    if (p->want == SHADE_OK) {
        cells = fuzz_cells(p->rows, p->stride, t->width);
        if ((kind & 4) && (size_t)p->rows * (size_t)p->stride <= GUARD_ROOM / 16)
            cells = (size_t)p->rows * (size_t)p->stride;
    } else {
        p->rows = 1;
        p->stride = 4;
    }
    p->color_bytes = t->color ? cells * fuzz_pixel_bytes(t->format) : 0;
    p->depth_bytes = t->depth ? cells * 4 : 0;
    p->color = p->depth = NULL;
    if (t->color) t->color = p->color = (uint8_t *)guard_take(p->color_bytes, kind & 1);
    if (t->depth) p->depth = (uint8_t *)guard_take(p->depth_bytes, kind >> 1 & 1);
    if (t->depth) t->depth = (float *)(void *)p->depth;
    if (p->color) fuzz_noise(p->color, p->color_bytes, kind);
    if (p->depth) fuzz_noise(p->depth, p->depth_bytes, kind + 1);
    if (p->want == SHADE_OK && (kind & 0x70)) {    /* else: drawn over noise, NaN among it */
        shade_target all = *t;
        float depth = (kind & 0x70) == 0x70 ? 0 : 1;
        all.clip_x = all.clip_y = all.clip_width = all.clip_height = 0;
        HOLDS(shade_clear(&all, shade_v4(0.2f, 0.4f, 0.6f, 0.5f), depth) == SHADE_OK);
    }
    p->before = (uint8_t *)malloc(2 * (p->color_bytes + p->depth_bytes) + 1);
    if (!p->before) exit(2);
    p->after = p->before + p->color_bytes + p->depth_bytes;
    if (p->color) memcpy(p->before, p->color, p->color_bytes);
    if (p->depth) memcpy(p->before + p->color_bytes, p->depth, p->depth_bytes);
}

static inline void picture_open(fuzz_input *in, picture *p, int most)
{
    p->one_width = 0;
    picture_shape(in, &p->target, most);
    picture_memory(in, p);
}

/* A picture factor times as large as another one, in a format and rows of its own. */
static inline void picture_times(fuzz_input *in, const picture *out, picture *big, int factor)
{
    memset(big, 0, sizeof *big);
    big->target = out->target;
    big->target.clip_x = big->target.clip_y = 0;
    big->target.clip_width = big->target.clip_height = 0;
    if (out->want == SHADE_OK && out->target.width <= 40 && out->target.height <= 40) {
        big->target.width *= factor;
        big->target.height *= factor;
        big->target.stride = 0;
        big->target.row_count *= factor;
        big->target.row_offset *= factor;
        big->target.format = (shade_format)(fuzz_byte(in) % FUZZ_FORMATS);
        big->target.srgb = fuzz_byte(in) & 1;
        if (fuzz_one_in(in, 4)) big->target.stride = big->target.width + fuzz_int(in, 0, 5);
    }
    if (fuzz_one_in(in, 16)) picture_spoil(in, &big->target);
    picture_memory(in, big);
}

static inline void picture_close(picture *p) { free(p->before); }

static inline void picture_keep(picture *p)    /* to after */
{
    if (p->color) memcpy(p->after, p->color, p->color_bytes);
    if (p->depth) memcpy(p->after + p->color_bytes, p->depth, p->depth_bytes);
}

static inline void picture_restore(picture *p)
{
    if (p->color) memcpy(p->color, p->before, p->color_bytes);
    if (p->depth) memcpy(p->depth, p->before + p->color_bytes, p->depth_bytes);
}

static inline int picture_unchanged(const picture *p)
{
    return (!p->color || !memcmp(p->color, p->before, p->color_bytes)) &&
           (!p->depth || !memcmp(p->depth, p->before + p->color_bytes, p->depth_bytes));
}

/* Bit for bit what was kept; a NaN among floats may be any NaN. */
static inline int picture_same(const picture *p)
{
    if (p->depth && memcmp(p->depth, p->after + p->color_bytes, p->depth_bytes)) return 0;
    if (!p->color || !memcmp(p->color, p->after, p->color_bytes)) return 1;
    if (p->target.format != SHADE_FORMAT_RGBA32F) return 0;
    for (size_t i = 0; i < p->color_bytes; i += 4) {
        float a, b;
        memcpy(&a, p->color + i, 4);
        memcpy(&b, p->after + i, 4);
        if (!fuzz_same(a, b)) return 0;
    }
    return 1;
}

static inline void picture_row_outside(const uint8_t *now, const uint8_t *before, size_t bytes,
                                       size_t at, size_t end, int x0, int x1, size_t cell)
{
    size_t left = at + (size_t)x0 * cell, right = at + (size_t)x1 * cell;
    if (end > bytes) end = bytes;        /* the last row may end at its last pixel */
    HOLDS(!memcmp(now + at, before + at, left - at));
    HOLDS(!memcmp(now + right, before + right, end - right));
}

/* Nothing outside the clip rectangle has changed, and what changed in depth lies in [0, 1]. */
static inline void picture_check(const picture *p)
{
    int x0, y0, x1, y1;
    size_t cell = fuzz_pixel_bytes(p->target.format), stride = (size_t)p->stride;
    picture_clip(&p->target, &x0, &y0, &x1, &y1);
    for (int row = 0; row < p->rows; row++) {
        int y = row + p->target.row_offset, in = y >= y0 && y < y1;
        int l = in ? x0 : 0, r = in ? x1 : 0;
        size_t at = (size_t)row * stride, end = at + stride;
        if (p->color) picture_row_outside(p->color, p->before, p->color_bytes, at * cell,
                                          end * cell, l, r, cell);
        if (p->depth) picture_row_outside(p->depth, p->before + p->color_bytes, p->depth_bytes,
                                          at * 4, end * 4, l, r, 4);
    }
    for (size_t i = 0; i < p->depth_bytes; i += 4) {
        float z;
        if (!memcmp(p->depth + i, p->before + p->color_bytes + i, 4)) continue;
        memcpy(&z, p->depth + i, 4);
        HOLDS(z >= 0 && z <= 1);
    }
}

/* ---- what holds of every call that draws ---------------------------------------------------- */

typedef shade_result picture_draw(void *user, const shade_target *target, shade_stats *stats);

static inline void picture_stats(const shade_stats *s, long long triangles)
{
    HOLDS(s->triangles == triangles);
    HOLDS(s->skipped >= 0 && s->culled >= 0 && s->clipped >= 0 && s->rejected >= 0);
    HOLDS(s->drawn >= 0 && s->fragments >= 0);
    HOLDS(s->skipped + s->culled + s->clipped + s->rejected + s->drawn == triangles);
}

/* The clip rectangle in two parts, the later first, gives what the whole gave. */
static inline void picture_in_parts(fuzz_input *in, picture *p, picture_draw *draw, void *user,
                                    const shade_stats *whole)
{
    int x0, y0, x1, y1, upright = fuzz_one_in(in, 2);
    shade_target part = p->target;
    shade_stats a, b;
    if (!picture_clip(&p->target, &x0, &y0, &x1, &y1)) return;
    if ((upright ? x1 - x0 : y1 - y0) < 2) return;
    int middle = upright ? fuzz_int(in, x0 + 1, x1 - 1) : fuzz_int(in, y0 + 1, y1 - 1);
    picture_restore(p);
    part.clip_x = upright ? middle : x0;
    part.clip_y = upright ? y0 : middle;
    part.clip_width = x1 - part.clip_x;
    part.clip_height = y1 - part.clip_y;
    HOLDS(draw(user, &part, &b) == SHADE_OK);
    part.clip_x = x0;
    part.clip_y = y0;
    part.clip_width = (upright ? middle : x1) - x0;
    part.clip_height = (upright ? y1 : middle) - y0;
    HOLDS(draw(user, &part, &a) == SHADE_OK);
    HOLDS(picture_same(p));
    HOLDS(a.fragments + b.fragments == whole->fragments);
    HOLDS(a.culled == whole->culled && a.clipped == whole->clipped && a.drawn == whole->drawn);
    HOLDS(a.rejected == whole->rejected && b.rejected == whole->rejected);
    HOLDS(b.culled == whole->culled && b.clipped == whole->clipped && b.drawn == whole->drawn);
}

/* want: what the contract says of the whole call; then, for some inputs, the same again in another
   vector width, otherwise shaded by twin (NULL: none), and in two parts. */
static inline void picture_try(fuzz_input *in, picture *p, picture_draw *draw, picture_draw *twin,
                               void *user, shade_result want, long long triangles, int read_only)
{
    shade_stats stats, again;
    uint32_t kind = fuzz_byte(in);
    int level = (int)kind % (fuzz_widest() + 1);
    memset(&stats, 0x55, sizeof stats);
    fuzz_level = level;
    HOLDS(draw(user, &p->target, &stats) == want);
    if (want != SHADE_OK) {
        HOLDS(picture_unchanged(p));
        HOLDS(!stats.triangles && !stats.drawn && !stats.fragments);
        return;
    }
    picture_stats(&stats, triangles);
    HOLDS(!stats.skipped);
    picture_check(p);
    if (read_only && p->depth)
        HOLDS(!memcmp(p->depth, p->before + p->color_bytes, p->depth_bytes));
    picture_keep(p);
    if (kind & 64) {
        picture_restore(p);
        fuzz_level = p->one_width ? level : (level + 1) % (fuzz_widest() + 1);
        HOLDS(draw(user, &p->target, &again) == SHADE_OK);
        HOLDS(picture_same(p));
        HOLDS(!memcmp(&stats, &again, sizeof stats));
    }
    if (twin && (kind & 32)) { /* depth depends on positions alone */
        picture_restore(p);
        HOLDS(twin(user, &p->target, &again) == SHADE_OK);
        HOLDS(!p->depth || !memcmp(p->depth, p->after + p->color_bytes, p->depth_bytes));
        HOLDS(!memcmp(&stats, &again, sizeof stats));
    }
    if (kind & 128) picture_in_parts(in, p, draw, user, &stats);
}

/* ---- textures ------------------------------------------------------------------------------- */

static inline int texture_is_good(const shade_texture *t)
{
    return t->pixels && t->width >= 1 && t->width <= 16384 && t->height >= 1 &&
           t->height <= 16384 && (!t->stride || t->stride >= t->width) && (int)t->format >= 0 &&
           (int)t->format < FUZZ_TEXTURES && (int)t->wrap_u >= 0 && (int)t->wrap_u <= 2 &&
           (int)t->wrap_v >= 0 && (int)t->wrap_v <= 2 && (int)t->filter >= 0 && (int)t->filter <= 2;
}

/* Pixels end with the last one.  tame: good, and its floats are in [0, 2). */
static inline shade_texture texture_open(fuzz_input *in, int most, int tame)
{
    shade_texture t;
    uint32_t kind = fuzz_byte(in);
    int bad = 0;
    size_t cells, bytes;
    uint8_t *pixels;
    memset(&t, 0, sizeof t);
    t.width = fuzz_int(in, 1, most);
    t.height = fuzz_int(in, 1, most);
    t.format = (shade_format)(fuzz_byte(in) % FUZZ_TEXTURES);
    t.srgb = kind & 1;
    t.wrap_u = (shade_wrap)(fuzz_byte(in) % 3);
    t.wrap_v = (shade_wrap)(fuzz_byte(in) % 3);
    t.filter = (shade_filter)(fuzz_byte(in) % 3);
    if (kind & 2) t.stride = t.width + fuzz_int(in, 0, 5);
    if ((kind & 0xF8) == 0xF8) {         /* long ones */
        t.width = kind & 4 ? 16384 : 1;
        t.height = kind & 4 ? 1 : fuzz_int(in, 1, 16384);
        t.stride = 0;
    }
    cells = fuzz_cells(t.height, t.stride ? t.stride : t.width, t.width);
    bytes = cells * fuzz_pixel_bytes(t.format);
    pixels = (uint8_t *)guard_take(bytes, kind >> 2 & 1);
    fuzz_noise(pixels, bytes, fuzz_byte(in));
    if (t.format == SHADE_FORMAT_RGBA32F && (tame || (kind & 16)))
        for (size_t i = 0; i < bytes; i += 4) {
            float f = (float)pixels[i] / 128;
            memcpy(pixels + i, &f, 4);
        }
    guard_seal(pixels);
    t.pixels = pixels;
    if (tame || !fuzz_one_in(in, 16)) return t;
    switch (fuzz_byte(in) % 8) {
    case 0: t.wrap_u = (shade_wrap)fuzz_enum(in, 3, &bad); break;
    case 1: t.wrap_v = (shade_wrap)fuzz_enum(in, 3, &bad); break;
    case 2: t.filter = (shade_filter)fuzz_enum(in, 3, &bad); break;
    case 3: t.pixels = NULL; break;
    case 4: t.width = -fuzz_int(in, 0, 4); break;
    case 5: t.height = 16385; break;
    case 6: t.stride = fuzz_one_in(in, 2) ? INT_MIN : t.width > 1 ? t.width - 1 : -1; break;
    default:
        t.format = (shade_format)(FUZZ_TEXTURES + fuzz_byte(in));
        break;
    }
    return t;
}
#endif
