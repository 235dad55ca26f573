/* label.h - captions and formulas, on a canvas or any target of 8 or 32 bits a channel.

   Text is UTF-8.  A character behind _ is set lower and smaller, one behind ^ higher, or several in
   braces: "k_a I_{La}", "(N·H)^n".  A character that font.h lacks leaves a blank. */
#ifndef SHARED_LABEL_H
#define SHARED_LABEL_H

#include "canvas.h"
#include "font.h"
#include <stdarg.h>
#include <string.h>

/* Reads the Unicode number of the character at *text, and moves *text behind it. */
static inline int label_code(const char **text)
{
    int first = (unsigned char)*(*text)++;
    int more = first < 0xC0 ? 0 : first < 0xE0 ? 1 : first < 0xF0 ? 2 : 3;
    int code = more ? first & (0x3F >> more) : first;
    for (; more > 0 && **text; more--) code = code << 6 | (*(*text)++ & 0x3F);
    return code;
}

/* The part of the interval i .. i + 1 that lies in a .. b */
static inline float label_share(int i, float a, float b)
{
    float from = (float)i > a ? (float)i : a, to = (float)i + 1 < b ? (float)i + 1 : b;
    return to > from ? to - from : 0;
}

/* The mean grey, 0 .. 1, over the square from u, v to u + size, v + size of a glyph's box; shape
   is the number of its first character. */
static inline float label_grey(const font_glyph *g, int shape, float u, float v, float size)
{
    float sum = 0;
    for (int y = v > 0 ? (int)v : 0; y < g->height && (float)y < v + size; y++) {
        for (int x = u > 0 ? (int)u : 0; x < g->width && (float)x < u + size; x++) {
            int k = y * g->width + x, at = shape + k / 2;
            char digit = font_shapes[at / FONT_COLUMNS][at % FONT_COLUMNS];
            int pair = (int)(strchr(font_digits, digit) - font_digits);
            float grey = (float)(k % 2 ? pair % 8 : pair / 8) / 7;
            sum += grey * label_share(x, u, u + size) * label_share(y, v, v + size);
        }
    }
    return sum / (size * size);
}

/* Mixes ink into a pixel: in linear light where it holds floats, in sRGB values where it holds
   bytes. */
static inline void label_mix(const shade_target *t, size_t at, shade_vec3 ink, float share)
{
    unsigned char *byte = (unsigned char *)t->color + 4 * at;
    const int bgra = t->format == SHADE_FORMAT_BGRA8;
    const float code[3] = { bgra ? ink.z : ink.x, ink.y, bgra ? ink.x : ink.z };
    if (t->format == SHADE_FORMAT_RGBA32F) {
        shade_vec4 *p = (shade_vec4 *)t->color + at;
        *p = shade_lerp4(*p, shade_v4(ink.x, ink.y, ink.z, 1), share);
        return;
    }
    for (int k = 0; k < 3; k++)
        byte[k] = (unsigned char)((float)byte[k] * (1 - share) + 255 * code[k] * share + 0.5f);
}

/* Draws one glyph with its pen at x, y of the target; a pixel of the font is scale pixels wide. */
static inline void label_glyph(const shade_target *t, const font_glyph *g, int shape, float x,
                               float y, float scale, shade_vec3 color)
{
    int light = t->format == SHADE_FORMAT_RGBA32F, dark = color.x + color.y + color.z < 0.6f;
    shade_vec3 ink = !light && t->srgb ? shade_srgb_from_linear(color) : color;
    float left = x + scale * (float)g->left, top = y - scale * (float)g->top;
    int right = (int)(left + scale * (float)g->width) + 1;
    int bottom = (int)(top + scale * (float)g->height) + 1;
    for (int j = top > 0 ? (int)top : 0; j < bottom && j < t->height; j++) {
        for (int i = left > 0 ? (int)left : 0; i < right && i < t->width; i++) {
            size_t at = (size_t)j * (size_t)(t->stride ? t->stride : t->width) + (size_t)i;
            float u = ((float)i - left) / scale, v = ((float)j - top) / scale;
            float share = label_grey(g, shape, u, v, 1 / scale);
            /* mixed in linear light, dark strokes look thinner than light ones: thicken them */
            label_mix(t, at, ink, light && dark ? share * (2 - share) : share);
        }
    }
}

/* Sets text from x on, y its baseline, on t or, where that is NULL, nowhere; size is the em, of
   which capitals are .7 high; all in pixels of t.  Returns the width. */
static inline float label_set(const shade_target *t, float x, float y, float size, shade_vec3 color,
                              const char *text)
{
    const int glyphs = (int)(sizeof font_glyphs / sizeof font_glyphs[0]);
    float start = x, small = 0.68f * size, rise = 0, em = size;
    int apart = 0; /* 1: one character set apart, 2: a group in braces */
#ifdef LABEL_SAY /* for tests: captions as text */
    if (t) puts(text);
#endif
    while (*text) {
        int code = label_code(&text), k = 0, shape = 0, end = apart == 1;
        if (!apart && *text && (code == '_' || code == '^')) {
            apart = *text == '{' ? 2 : 1;
            text += apart - 1;
            em = small;
            rise = code == '_' ? -0.17f * size : 0.33f * size;
            continue;
        }
        if (apart == 2 && code == '}') {
            end = 1;
        } else {
            while (k < glyphs && font_glyphs[k].code != code) k++;
            const font_glyph *g = &font_glyphs[k < glyphs ? k : 0]; /* the first is a blank */
            for (int i = 0; i < g - font_glyphs; i++)
                shape += (font_glyphs[i].width * font_glyphs[i].height + 1) / 2;
            if (t) label_glyph(t, g, shape, x, y - rise, em / 24, color);
            x += em * (float)g->advance / 240;
        }
        if (end) {
            apart = 0;
            em = size;
            rise = 0;
        }
    }
    return x - start;
}

static inline float label_width(float size, const char *text)
{
    return label_set(NULL, 0, 0, size, shade_v3(0, 0, 0), text);
}

/* Draws text on a canvas; x, y and size are in pixels of the finished picture. */
static inline void label_draw(const canvas *c, int x, int y, int size, shade_vec3 color,
                              const char *text)
{
    float s = (float)c->samples;
    label_set(&c->target, s * (float)x, s * (float)y, s * (float)size, color, text);
}

/* The same with a format and values as printf takes them; text beyond 99 bytes is cut off. */
static inline void label_print(const canvas *c, int x, int y, int size, shade_vec3 color,
                               const char *format, ...)
{
    char text[100];
    va_list values;
    va_start(values, format);
    vsnprintf(text, sizeof text, format, values);
    va_end(values);
    label_draw(c, x, y, size, color, text);
}

/* Draws text centred about x. */
static inline void label_center(const canvas *c, int x, int y, int size, shade_vec3 color,
                                const char *text)
{
    float s = (float)c->samples, left = s * (float)x - label_width(s * (float)size, text) / 2;
    label_set(&c->target, left, s * (float)y, s * (float)size, color, text);
}

/* Draws a name and, smaller and below it, a formula, centred about x; y is the first baseline. */
static inline void label_caption(const canvas *c, int x, int y, shade_vec3 color, const char *name,
                                 const char *formula)
{
    label_center(c, x, y, 22, color, name);
    label_center(c, x, y + 25, 19, color, formula);
}
#endif
