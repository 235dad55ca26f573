/* pixels.h - a picture as the bytes of three protocols for pixels in a terminal:

   kitty's      https://sw.kovidgoyal.net/kitty/graphics-protocol/: a PNG in base64 by
                stb_image_write, which is a sixth of the bytes, or without it RGB
   iTerm2's     https://iterm2.com/documentation-images.html: the PNG again
   sixel        of DEC's VT300, by libsixel

   The terminal scales the first two to the cells, so that a picture may have fewer pixels. */
#ifndef VIEW_PIXELS_H
#define VIEW_PIXELS_H

#include "../../shared/mesh.h"
#include "../../kit/image/written.h"
#include "options.h"
#include <string.h>

#ifdef MODEL_STB
enum { PIXELS_PNG = 1 };
#else
enum { PIXELS_PNG = 0 };
#endif
#ifdef VIEW_SIXEL
#include <sixel/sixel.h>
enum { PIXELS_SIXEL = 1 };
#else
enum { PIXELS_SIXEL = 0 };
#endif

typedef struct pixel_bytes {
    char *bytes;
    size_t size, room;
    unsigned shown; /* kitty's number of the picture that is shown; 0: none */
} pixel_bytes;

/* 1: this build knows the protocol. */
static inline int pixels_known(view_show show)
{
    return show == SHOW_KITTY || (show == SHOW_ITERM2 && PIXELS_PNG) ||
           (show == SHOW_SIXEL && PIXELS_SIXEL);
}

/* Room for n more bytes */
static inline char *pixels_room(pixel_bytes *b, size_t n)
{
    if (b->room - b->size < n) {
        char *grown = (char *)example_memory(2 * b->size + n, 1);
        if (b->size) memcpy(grown, b->bytes, b->size);
        free(b->bytes);
        b->bytes = grown;
        b->room = 2 * b->size + n;
    }
    return b->bytes + b->size;
}

static inline void pixels_put(pixel_bytes *b, const char *bytes, size_t n)
{
    memcpy(pixels_room(b, n), bytes, n);
    b->size += n;
}

static inline void pixels_print(pixel_bytes *b, const char *format, ...)
{
    char text[160];
    int n;
    va_list values;
    va_start(values, format);
    n = vsnprintf(text, sizeof text, format, values);
    va_end(values);
    pixels_put(b, text, (size_t)n);
}

/* Base64 of RFC 4648 */
static inline void pixels_base64(pixel_bytes *b, const uint8_t *p, size_t n)
{
    static const char digit[] = "ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789+/";
    char *out = pixels_room(b, (n + 2) / 3 * 4);
    for (size_t i = 0; i < n; i += 3, out += 4) {
        uint32_t three = (uint32_t)p[i] << 16;
        if (i + 1 < n) three |= (uint32_t)p[i + 1] << 8;
        if (i + 2 < n) three |= p[i + 2];
        for (int k = 0; k < 4; k++) out[k] = digit[three >> (18 - 6 * k) & 63];
        if (i + 1 >= n) out[2] = '=';
        if (i + 2 >= n) out[3] = '=';
    }
    b->size += (n + 2) / 3 * 4;
}

/* ---- PNG ------------------------------------------------------------------------------------- */

#ifdef MODEL_STB
static inline void pixels_take(void *to, void *bytes, int n)
{
    pixels_put((pixel_bytes *)to, (const char *)bytes, (size_t)n);
}

/* One filter for all rows takes a fifth of the time of the best one for each. */
static inline void pixels_png(pixel_bytes *png, const uint8_t *rgb, int width, int height)
{
    stbi_write_force_png_filter = 1;
    stbi_write_png_to_func(pixels_take, png, width, height, 3, rgb, 3 * width);
}
#else
static inline void pixels_png(pixel_bytes *png, const uint8_t *rgb, int width, int height)
{
    pixels_put(png, (const char *)rgb, 3 * (size_t)width * (size_t)height);
}
#endif

/* ---- kitty ----------------------------------------------------------------------------------- */

/* Bytes of a picture in one sequence: 4096 of base64, as the protocol asks */
enum { KITTY_PART = 3072 };

/* Shows a picture, and then deletes the one before, so that none is missing in between.  q=2: no
   answers, C=1: the cursor stays. */
static inline void pixels_kitty(pixel_bytes *b, const uint8_t *rgb, int width, int height,
                                int columns, int rows)
{
    const unsigned before = b->shown;
    pixel_bytes data = { NULL, 0, 0, 0 };
    pixels_png(&data, rgb, width, height);
    b->shown = before == 1 ? 2 : 1;
    pixels_print(b, "\033[H\033_Ga=T,q=2,C=1,f=%d,i=%u,s=%d,v=%d,c=%d,r=%d,", PIXELS_PNG ? 100 : 24,
                 b->shown, width, height, columns, rows);
    for (size_t at = 0; at < data.size; at += KITTY_PART) {
        const size_t part = data.size - at < KITTY_PART ? data.size - at : KITTY_PART;
        pixels_print(b, "%sm=%d;", at ? "\033_G" : "", at + part < data.size);
        pixels_base64(b, (const uint8_t *)data.bytes + at, part);
        pixels_put(b, "\033\\", 2);
    }
    if (before) pixels_print(b, "\033_Ga=d,q=2,d=I,i=%u\033\\", before);
    free(data.bytes);
}

/* ---- iTerm2 ---------------------------------------------------------------------------------- */

static inline void pixels_iterm2(pixel_bytes *b, const uint8_t *rgb, int width, int height,
                                 int columns, int rows)
{
    pixel_bytes png = { NULL, 0, 0, 0 };
    pixels_png(&png, rgb, width, height);
    pixels_print(b,
                 "\033[H\033]1337;File=inline=1;size=%lu;width=%d;height=%d;"
                 "preserveAspectRatio=0;doNotMoveCursor=1:",
                 (unsigned long)png.size, columns, rows);
    pixels_base64(b, (const uint8_t *)png.bytes, png.size);
    pixels_put(b, "\007", 1);
    free(png.bytes);
}

/* ---- sixel ----------------------------------------------------------------------------------- */

#ifdef VIEW_SIXEL
static int pixels_sixel_take(char *bytes, int n, void *to)
{
    pixels_put((pixel_bytes *)to, bytes, (size_t)n);
    return n;
}

/* Replaces each colour by the nearest that sixels have, whose channels are whole percents.
   Terminals round p percent down, to 2.55 p (mlterm) or 2.56 p (xterm); both bytes are near, and
   libsixel finds p again, for it rounds to the nearest percent. */
static void pixels_percents(unsigned char *channel, int count)
{
    for (int k = 0; k < count; k++) {
        const int p = (channel[k] * 100 + 50) / 255;
        const int low = p * 255 / 100, high = p < 100 ? (p + 1) * 255 / 100 : 255;
        channel[k] = (unsigned char)(channel[k] - low <= high - channel[k] ? low : high);
    }
}

/* Colours chosen for this picture: fine, 256, with errors spread by Floyd and Steinberg; else 64
   without, which takes a quarter of the time */
static inline void pixels_sixel(pixel_bytes *b, uint8_t *rgb, int width, int height, int fine)
{
    sixel_output_t *output = NULL;
    sixel_dither_t *dither = NULL;
    pixels_print(b, "\033[H");
    if (SIXEL_SUCCEEDED(sixel_output_new(&output, pixels_sixel_take, b, NULL)) &&
        SIXEL_SUCCEEDED(sixel_dither_new(&dither, fine ? 256 : 64, NULL)) &&
        SIXEL_SUCCEEDED(sixel_dither_initialize(dither, rgb, width, height,
                                                SIXEL_PIXELFORMAT_RGB888, SIXEL_LARGE_AUTO,
                                                SIXEL_REP_AUTO, SIXEL_QUALITY_LOW))) {
        pixels_percents(sixel_dither_get_palette(dither),
                        3 * sixel_dither_get_num_of_palette_colors(dither));
        sixel_dither_set_diffusion_type(dither, fine ? SIXEL_DIFFUSE_FS : SIXEL_DIFFUSE_NONE);
        sixel_encode(rgb, width, height, 3, dither, output);
    }
    sixel_dither_unref(dither);
    sixel_output_unref(output);
}
#else
static inline void pixels_sixel(pixel_bytes *b, uint8_t *rgb, int width, int height, int fine)
{
    (void)b, (void)rgb, (void)width, (void)height, (void)fine;
}
#endif
#endif
