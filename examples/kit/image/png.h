/* png.h - reads PNG of every depth and kind of colour, interlaced too, and writes it.  Checksums
   are checked.  What is packed the caller unpacks, and packs, by zlib.

       png p;
       const char *wrong = png_open(&p, bytes, size);            the header; finds the chunks
       png_gather(&p, packed);                                   p.packed bytes, of zlib's format
       ... png_bytes(&p) bytes of raw ...
       if (png_rgba(&p, raw, rgba)) ...                          4 * width * height bytes

       n = png_lines(rgba, width, height, &kind, lines);         rows, which pack well
       n = png_file(width, height, kind, packed, size, file);    the file around what is packed */
#ifndef MODEL_PNG_H
#define MODEL_PNG_H

#include "../read/zip.h"

enum { PNG_GREY, PNG_RGB = 2, PNG_PALETTE, PNG_GREY_ALPHA, PNG_RGBA = 6 };

typedef struct png {
    int width, height, depth, kind, interlaced;
    size_t packed;                        /* bytes of all its parts */
    const unsigned char *at, *end;        /* the chunks */
    const unsigned char *palette, *clear; /* colours; alpha of these, or the colour that is clear */
    size_t palette_size, clear_size;      /* in bytes */
} png;

static inline uint32_t png_uint32(const unsigned char *p)
{
    return (uint32_t)p[0] << 24 | (uint32_t)p[1] << 16 | (uint32_t)p[2] << 8 | p[3];
}

static inline int png_channels(const png *p)
{
    static const int channels[7] = { 1, 0, 3, 1, 2, 0, 4 };
    return channels[p->kind];
}

/* 1: the header is one of the format's. */
static inline int png_is_known(const png *p)
{
    const int small = p->depth == 1 || p->depth == 2 || p->depth == 4, wide = p->depth == 16;
    if (p->kind < 0 || p->kind > 6 || !png_channels(p)) return 0;
    if (p->depth == 8) return 1;
    return (small && (p->kind == PNG_GREY || p->kind == PNG_PALETTE)) ||
           (wide && p->kind != PNG_PALETTE);
}

/* Notes a chunk.  Returns what is wrong, or NULL. */
static inline const char *png_chunk(png *p, const unsigned char *at, size_t size)
{
    const unsigned char *data = at + 8;
    if (!memcmp(at + 4, "IHDR", 4)) {
        if (size != 13) return "has no header";
        p->width = (int)(png_uint32(data) & INT_MAX);
        p->height = (int)(png_uint32(data + 4) & INT_MAX);
        p->depth = data[8];
        p->kind = data[9];
        p->interlaced = data[12];
        if (data[10] || data[11] || data[12] > 1 || !png_is_known(p))
            return "has a header of no PNG";
    } else if (!memcmp(at + 4, "PLTE", 4)) {
        p->palette = data;
        p->palette_size = size;
    } else if (!memcmp(at + 4, "tRNS", 4)) {
        p->clear = data;
        p->clear_size = size;
    } else if (!memcmp(at + 4, "IDAT", 4)) {
        p->packed += size;
    }
    return NULL;
}

static inline const char *png_open(png *p, const unsigned char *bytes, size_t size)
{
    static const png none;
    const unsigned char *const end = bytes + size, *at = bytes + 8;
    const char *wrong = NULL;
    int ended = 0;
    *p = none;
    if (size < 8 || memcmp(bytes, "\x89PNG\r\n\x1A\n", 8) != 0) return "is no PNG file";
    p->at = at;
    for (; !ended && !wrong; at += 12 + (size_t)png_uint32(at)) {
        const size_t left = (size_t)(end - at);
        if (left < 12 || png_uint32(at) > left - 12)
            return p->width ? "ends early" : "has no header";
        if (zip_crc(0, at + 4, 4 + (size_t)png_uint32(at)) != png_uint32(at + 8 + png_uint32(at)))
            return "has a chunk whose checksum is wrong";
        if (!p->width && memcmp(at + 4, "IHDR", 4) != 0) return "has no header";
        wrong = png_chunk(p, at, png_uint32(at));
        ended = !memcmp(at + 4, "IEND", 4);
    }
    p->end = at;
    if (!wrong && (p->width < 1 || p->height < 1)) wrong = "has a header of no PNG";
    if (!wrong && p->kind == PNG_PALETTE && !p->palette) wrong = "has no palette";
    return wrong;
}

/* Copies what is packed, which stands in several chunks. */
static inline void png_gather(const png *p, unsigned char *out)
{
    for (const unsigned char *at = p->at; at < p->end; at += 12 + (size_t)png_uint32(at)) {
        if (memcmp(at + 4, "IDAT", 4) != 0) continue;
        memcpy(out, at + 8, png_uint32(at));
        out += png_uint32(at);
    }
}

/* ---- rows ------------------------------------------------------------------------------------ */

/* The seven passes of an interlaced picture: the first column and row, and the steps */
typedef struct png_pass {
    int x, y, right, down;
} png_pass;
static const png_pass png_passes[7] = { { 0, 0, 8, 8 }, { 4, 0, 8, 8 }, { 0, 4, 4, 8 },
                                        { 2, 0, 4, 4 }, { 0, 2, 2, 4 }, { 1, 0, 2, 2 },
                                        { 0, 1, 1, 2 } };

static inline png_pass png_pass_of(const png *p, int i)
{
    static const png_pass whole = { 0, 0, 1, 1 };
    return p->interlaced ? png_passes[i] : whole;
}

/* How many columns and rows a pass has */
static inline int png_across(const png *p, png_pass s)
{
    return p->width > s.x ? (p->width - s.x - 1) / s.right + 1 : 0;
}

static inline int png_along(const png *p, png_pass s)
{
    return p->height > s.y ? (p->height - s.y - 1) / s.down + 1 : 0;
}

static inline size_t png_row_bytes(const png *p, int columns)
{
    return ((size_t)columns * (size_t)(png_channels(p) * p->depth) + 7) / 8;
}

/* The bytes of all rows, each behind the byte of its filter */
static inline size_t png_bytes(const png *p)
{
    size_t bytes = 0;
    for (int i = 0; i < (p->interlaced ? 7 : 1); i++) {
        const png_pass s = png_pass_of(p, i);
        const int columns = png_across(p, s);
        if (columns) bytes += (size_t)png_along(p, s) * (1 + png_row_bytes(p, columns));
    }
    return bytes;
}

static inline unsigned char png_nearest(int a, int b, int c)
{
    const int across = abs(b - c), along = abs(a - c), both = abs(a + b - 2 * c);
    if (across <= along && across <= both) return (unsigned char)a;
    return (unsigned char)(along <= both ? b : c);
}

/* Adds to a row what its filter has taken off.  above: the row above, or zeros; step: bytes of a
   pixel, at least 1.  Non-zero: there is no such filter. */
static inline int png_unfilter(int filter, unsigned char *row, const unsigned char *above, size_t n,
                               size_t step)
{
    const size_t first = step < n ? step : n;
    if (filter > 4) return 1;
    for (size_t i = 0; i < first && filter > 1; i++)
        row[i] = (unsigned char)(row[i] + (filter == 3 ? above[i] / 2 : above[i]));
    if (filter == 1)
        for (size_t i = step; i < n; i++) row[i] = (unsigned char)(row[i] + row[i - step]);
    if (filter == 2)
        for (size_t i = step; i < n; i++) row[i] = (unsigned char)(row[i] + above[i]);
    if (filter == 3)
        for (size_t i = step; i < n; i++)
            row[i] = (unsigned char)(row[i] + (row[i - step] + above[i]) / 2);
    if (filter == 4)
        for (size_t i = step; i < n; i++)
            row[i] =
                (unsigned char)(row[i] + png_nearest(row[i - step], above[i], above[i - step]));
    return 0;
}

/* The sample k of a row, as it is stored */
static inline int png_sample(const png *p, const unsigned char *row, size_t k)
{
    const size_t bit = k * (size_t)p->depth;
    if (p->depth == 16) return row[2 * k] << 8 | row[2 * k + 1];
    if (p->depth == 8) return row[k];
    return row[bit / 8] >> (8 - p->depth - (int)(bit % 8)) & ((1 << p->depth) - 1);
}

/* 1: the samples of a pixel are those of the colour that is clear. */
static inline int png_is_clear(const png *p, const int *sample, int channels)
{
    if (p->clear_size < 2 * (size_t)channels) return 0;
    for (int k = 0; k < channels; k++)
        if (sample[k] != (p->clear[2 * k] << 8 | p->clear[2 * k + 1])) return 0;
    return 1;
}

/* A pixel as RGBA of 8 bits; 16 are rounded.  Non-zero: its colour is none of the palette. */
static inline int png_pixel(const png *p, const unsigned char *row, size_t x, uint8_t *out)
{
    const int channels = png_channels(p), most = (1 << p->depth) - 1;
    int sample[4] = { 0 };
    for (int k = 0; k < channels; k++)
        sample[k] = png_sample(p, row, x * (size_t)channels + (size_t)k);
    out[3] = 255;
    if (p->kind == PNG_PALETTE) {
        const size_t at = (size_t)sample[0];
        if (3 * at + 3 > p->palette_size) return 1;
        memcpy(out, p->palette + 3 * at, 3);
        if (at < p->clear_size) out[3] = p->clear[at];
        return 0;
    }
    for (int k = 0; k < channels; k++) {
        const int to = channels == 2 && k ? 3 : k;
        out[to] = (uint8_t)((510 * (long long)sample[k] + most) / (2 * most));
    }
    if (channels < 3) out[1] = out[2] = out[0];
    if (channels % 2 && p->clear && png_is_clear(p, sample, channels)) out[3] = 0;
    return 0;
}

/* A row whose pixels are bytes, which most are */
static inline void png_plain(const unsigned char *row, int channels, int columns, uint8_t *out)
{
    for (int x = 0; x < columns; x++, row += channels, out += 4) {
        for (int k = 0; k < 3; k++) out[k] = row[k];
        out[3] = channels == 4 ? row[3] : 255;
    }
}

/* The rows of a pass, at *raw, which moves behind them */
static inline int png_draw(const png *p, png_pass s, unsigned char **raw,
                           const unsigned char *zeros, uint8_t *rgba)
{
    const int columns = png_across(p, s), rows = columns ? png_along(p, s) : 0;
    const int plain = !p->interlaced && p->depth == 8 && p->kind % 4 == 2 && !p->clear;
    const size_t n = png_row_bytes(p, columns), bits = (size_t)(png_channels(p) * p->depth);
    const unsigned char *above = zeros;
    for (int y = 0; y < rows; y++, *raw += 1 + n) {
        unsigned char *row = *raw + 1;
        uint8_t *to = rgba + 4 * ((size_t)(s.y + y * s.down) * (size_t)p->width + (size_t)s.x);
        if (png_unfilter(**raw, row, above, n, (bits + 7) / 8)) return 1;
        if (plain) png_plain(row, png_channels(p), columns, to);
        for (int x = 0; x < columns && !plain; x++)
            if (png_pixel(p, row, (size_t)x, to + 4 * (size_t)(x * s.right))) return 1;
        above = row;
    }
    return 0;
}

/* The pixels of raw, which is changed.  Returns what is wrong, or NULL. */
static inline const char *png_rgba(const png *p, unsigned char *raw, uint8_t *rgba)
{
    unsigned char *zeros = (unsigned char *)calloc(png_row_bytes(p, p->width) + 1, 1);
    int failed = 0;
    if (!zeros) return "needs more memory than there is";
    for (int i = 0; i < (p->interlaced ? 7 : 1) && !failed; i++)
        failed = png_draw(p, png_pass_of(p, i), &raw, zeros, rgba);
    free(zeros);
    return failed ? "has an unknown filter, or a colour that its palette does not have" : NULL;
}

/* The samples of a grey picture without alpha as they are stored, 0 to 65,535.  raw is changed.
   Returns what is wrong, or NULL. */
static inline const char *png_grey(const png *p, unsigned char *raw, uint16_t *out)
{
    unsigned char *zeros = (unsigned char *)calloc(png_row_bytes(p, p->width) + 1, 1);
    int failed = 0;
    if (!zeros) return "needs more memory than there is";
    for (int i = 0; i < (p->interlaced ? 7 : 1) && p->kind == PNG_GREY && !failed; i++) {
        const png_pass s = png_pass_of(p, i);
        const int columns = png_across(p, s), rows = columns ? png_along(p, s) : 0;
        const unsigned char *above = zeros;
        const size_t n = png_row_bytes(p, columns);
        for (int y = 0; y < rows && !failed; y++, raw += 1 + n) {
            uint16_t *to = out + (size_t)(s.y + y * s.down) * (size_t)p->width + (size_t)s.x;
            failed = png_unfilter(*raw, raw + 1, above, n, ((size_t)p->depth + 7) / 8);
            above = raw + 1;
            for (int x = 0; x < columns; x++)
                to[x * s.right] = (uint16_t)png_sample(p, raw + 1, (size_t)x);
        }
    }
    free(zeros);
    if (p->kind != PNG_GREY) return "is no PNG of one grey number a pixel";
    return failed ? "has an unknown filter" : NULL;
}

/* ---- writing --------------------------------------------------------------------------------- */

/* Rows as their differences from the rows above, each behind the byte of that filter: so they pack
   well, and at once. */
static inline size_t png_differences(const unsigned char *bytes, int rows, size_t row,
                                     unsigned char *out)
{
    for (int y = 0; y < rows; y++, bytes += row) {
        *out++ = 2;
        for (size_t i = 0; i < row; i++)
            *out++ = (unsigned char)(y ? bytes[i] - *(bytes + i - row) : bytes[i]);
    }
    return (size_t)rows * (1 + row);
}

/* RGB where all of RGBA is opaque, else RGBA, as *kind says.  out has room for a byte a row and
   four a pixel.  Returns how many bytes there are; 0: out of memory */
static inline size_t png_lines(const uint8_t *rgba, int width, int height, int *kind,
                               unsigned char *out)
{
    const size_t pixels = (size_t)width * (size_t)height;
    unsigned char *rgb;
    size_t bytes, i = 0;
    while (i < pixels && rgba[4 * i + 3] == 255) i++;
    *kind = i < pixels ? PNG_RGBA : PNG_RGB;
    if (i < pixels) return png_differences(rgba, height, 4 * (size_t)width, out);
    rgb = (unsigned char *)malloc(3 * pixels + 1);
    if (!rgb) return 0;
    for (i = 0; i < pixels; i++) memcpy(rgb + 3 * i, rgba + 4 * i, 3);
    bytes = png_differences(rgb, height, 3 * (size_t)width, out);
    free(rgb);
    return bytes;
}

/* Numbers as grey of 16 bits.  out has room for a byte a row and two a pixel. */
static inline size_t png_lines16(const uint16_t *grey, int width, int height, unsigned char *out)
{
    uint16_t above = 0;
    unsigned char *const start = out;
    for (int y = 0; y < height; y++) {
        *out++ = 2;
        for (int x = 0; x < width; x++, grey++) {
            above = y ? *(grey - width) : 0;
            *out++ = (unsigned char)((*grey >> 8) - (above >> 8));
            *out++ = (unsigned char)((*grey & 255) - (above & 255));
        }
    }
    return (size_t)(out - start);
}

static inline unsigned char *png_put(unsigned char *to, uint32_t x)
{
    for (int k = 24; k >= 0; k -= 8) *to++ = (unsigned char)(x >> k);
    return to;
}

static inline unsigned char *png_put_chunk(unsigned char *to, const char *kind,
                                           const unsigned char *data, size_t size)
{
    unsigned char *const start = png_put(to, (uint32_t)size);
    memcpy(start, kind, 4);
    if (size) memcpy(start + 4, data, size);
    return png_put(start + 4 + size, zip_crc(0, start, 4 + size));
}

/* The file of rows that are packed, below 2 GB: grey of 16 bits, or RGB or RGBA of 8, as a display
   has them.  out has room for 70 bytes more than are packed.  Returns how many bytes there are. */
enum { PNG_AROUND = 70 };
static inline size_t png_file(int width, int height, int kind, const unsigned char *packed,
                              size_t size, unsigned char *out)
{
    const unsigned char relative = 0; /* of sRGB: how colours that are not shown are replaced */
    unsigned char head[13] = { 0 }, *to = out + 8;
    memcpy(out, "\x89PNG\r\n\x1A\n", 8);
    png_put(png_put(head, (uint32_t)width), (uint32_t)height);
    head[8] = kind == PNG_GREY ? 16 : 8;
    head[9] = (unsigned char)kind;
    to = png_put_chunk(to, "IHDR", head, sizeof head);
    if (kind != PNG_GREY) to = png_put_chunk(to, "sRGB", &relative, 1);
    to = png_put_chunk(to, "IDAT", packed, size);
    return (size_t)(png_put_chunk(to, "IEND", NULL, 0) - out);
}
#endif
