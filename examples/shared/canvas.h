/* canvas.h - a picture to draw on, its parts, and its file.  Programs exit if memory runs out.

   With -DCANVAS_STB and stb_image_write (libstb-dev) pictures are PNG, without it PPM. */
#ifndef SHARED_CANVAS_H
#define SHARED_CANVAS_H

#include "shade.h"
#include <stdio.h>
#include <stdlib.h>
#ifdef CANVAS_STB
#include <string.h>
#define STB_IMAGE_WRITE_STATIC
#define STB_IMAGE_WRITE_IMPLEMENTATION
#include <stb/stb_image_write.h>
#endif

/* A picture of linear light in 32-bit floats, drawn samples times larger both ways and averaged
   at the end. */
typedef struct canvas {
    shade_target target;             /* samples * width by samples * height */
    int width, height, samples;      /* of the finished picture */
} canvas;

/* A canvas whose target.color is NULL where memory is out */
static inline canvas canvas_try(int width, int height, int samples)
{
    canvas c = { { 0 }, width, height, samples };
    size_t pixels = (size_t)(width * samples) * (size_t)(height * samples);
    c.target.width = width * samples;
    c.target.height = height * samples;
    c.target.format = SHADE_FORMAT_RGBA32F;
    c.target.srgb = 1;
    c.target.color = calloc(pixels, 4 * sizeof(float));
    c.target.depth = (float *)calloc(pixels, sizeof(float));
    if (c.target.color && c.target.depth) return c;
    free(c.target.color);
    free(c.target.depth);
    c.target.color = NULL;
    c.target.depth = NULL;
    return c;
}

static inline canvas canvas_new(int width, int height, int samples)
{
    canvas c = canvas_try(width, height, samples);
    if (c.target.color) return c;
    fprintf(stderr, "out of memory\n");
    exit(1);
}

/* A part of the canvas as a target of its own, so that it has its own camera; pixels of the
   finished picture */
static inline shade_target canvas_panel(const canvas *c, int x, int y, int width, int height)
{
    shade_target t = c->target;
    size_t at = (size_t)(y * c->samples) * (size_t)c->target.width + (size_t)(x * c->samples);
    t.color = (float *)c->target.color + 4 * at;
    t.depth = c->target.depth + at;
    t.stride = c->target.width;
    t.width = width * c->samples;
    t.height = height * c->samples;
    return t;
}

/* The same in front of all that is drawn there, black and with a frame of one pixel around it */
static inline shade_target canvas_inset(const canvas *c, int x, int y, int width, int height)
{
    shade_target frame = canvas_panel(c, x - 1, y - 1, width + 2, height + 2);
    shade_target inside = canvas_panel(c, x, y, width, height);
    shade_clear(&frame, shade_v4(0.7f, 0.7f, 0.7f, 1), 1);
    shade_clear(&inside, shade_v4(0, 0, 0, 1), 1);
    return inside;
}

/* Clears depth to 1, and colour to a gradient from the top row to the bottom row. */
static inline void canvas_gradient(const shade_target *target, shade_vec3 top, shade_vec3 bottom)
{
    shade_target row = *target;
    row.clip_width = row.width;
    row.clip_height = 1;
    for (row.clip_y = 0; row.clip_y < row.height; row.clip_y++) {
        shade_vec3 k = shade_lerp(top, bottom, ((float)row.clip_y + 0.5f) / (float)row.height);
        shade_clear(&row, shade_v4(k.x, k.y, k.z, 1), 1);
    }
}

/* Fills width x height samples from x, y on with a colour; depth stays as it is. */
static inline void canvas_fill(const shade_target *target, int x, int y, int width, int height,
                               shade_vec3 color)
{
    shade_target part = *target;
    part.depth = NULL;
    part.clip_x = x;
    part.clip_y = y;
    part.clip_width = width;
    part.clip_height = height;
    shade_clear(&part, shade_v4(color.x, color.y, color.z, 1), 1);
}

/* Clears to the dark grey gradient that most pictures here have behind them. */
static inline void canvas_dark(const shade_target *target)
{
    canvas_gradient(target, shade_v3(0.045f, 0.05f, 0.06f), shade_v3(0.012f, 0.013f, 0.016f));
}

/* A pixel of the finished picture: the mean of its samples, in linear light.  They are cut to
   [0, 1] first: one sample of a highlight ten times too bright would otherwise whiten the pixel and
   undo the antialiasing. */
static inline shade_vec4 canvas_pixel(const canvas *c, int x, int y)
{
    int s = c->samples;
    float sum[4] = { 0, 0, 0, 0 };
    for (int k = 0; k < 4 * s * s; k++) {
        size_t row = (size_t)(y * s + k / 4 / s), column = (size_t)(x * s + k / 4 % s);
        size_t at = row * (size_t)c->target.width + column;
        float v = ((const float *)c->target.color)[4 * at + (size_t)(k % 4)];
        sum[k % 4] += v > 0 ? v < 1 ? v : 1 : 0;
    }
    for (int k = 0; k < 4; k++) sum[k] /= (float)(s * s);
    return shade_v4(sum[0], sum[1], sum[2], sum[3]);
}

/* Shows w x h finished pixels from x, y on once more from to_x, to_y on, each as a block of
   size x size. */
static inline void canvas_zoom(const canvas *c, int x, int y, int w, int h, int to_x, int to_y,
                               int size)
{
    for (int k = 0; k < w * h; k++) {
        int i = k % w, j = k / w;
        shade_target block = canvas_panel(c, to_x + i * size, to_y + j * size, size, size);
        shade_clear(&block, canvas_pixel(c, x + i, y + j), 1);
    }
}

/* Marks where two panels of one size differ: shows a in dim grey on a third panel, with a square
   of size x size over each sample that is not the same colour of 8 bits, and counts those. */
static inline int canvas_difference(const shade_target *a, const shade_target *b,
                                    const shade_target *out, int size)
{
    const shade_vec3 mark = { 1, 0.35f, 0.02f };
    int count = 0;
    for (int pass = 0; pass < 2; pass++) {
        for (int i = 0; i < a->width * a->height; i++) {
            const int x = i % a->width, y = i / a->width;
            const size_t at = (size_t)y * (size_t)a->stride + (size_t)x;
            shade_vec4 p = ((const shade_vec4 *)a->color)[at];
            shade_vec4 q = ((const shade_vec4 *)b->color)[at];
            shade_vec3 s = shade_srgb_from_linear(shade_v3(p.x, p.y, p.z));
            shade_vec3 t = shade_srgb_from_linear(shade_v3(q.x, q.y, q.z));
            const float grey = 0.2f * (p.x + p.y + p.z);
            const int differ = (int)(255 * s.x + 0.5f) != (int)(255 * t.x + 0.5f) ||
                               (int)(255 * s.y + 0.5f) != (int)(255 * t.y + 0.5f) ||
                               (int)(255 * s.z + 0.5f) != (int)(255 * t.z + 0.5f);
            if (!pass) canvas_fill(out, x, y, 1, 1, shade_v3(grey, grey, grey));
            if (!pass || !differ) continue;
            canvas_fill(out, x - size / 2, y - size / 2, size, size, mark);
            count++;
        }
    }
    return count;
}

/* Shows a square map of window depths, of a perspective from front to back, on a panel: grey is in
   proportion to distance, white at the least from the camera, black at the most.  Returns both;
   where the map was cleared to 1 nothing counts, and the panel is black. */
static inline shade_vec2 canvas_depth(shade_target panel, const float *map, int size, float front,
                                      float back)
{
    shade_vec2 range = { back, front };
    const int pixels = panel.width * panel.height;
    for (int k = 0; k < 2 * pixels; k++) {    /* once for the range, once for the picture */
        const int x = k % pixels % panel.width, y = k % pixels / panel.width;
        const float z = map[y * size / panel.height * size + x * size / panel.width];
        const float distance = front * back / (back - z * (back - front));
        const float near_by = z < 1 ? (range.y - distance) / (range.y - range.x) : 0;
        const shade_vec3 grey = shade_linear_from_srgb(shade_v3(near_by, near_by, near_by));
        if (k < pixels && z < 1) {
            range.x = distance < range.x ? distance : range.x;
            range.y = distance > range.y ? distance : range.y;
        } else if (k >= pixels)
            ((shade_vec4 *)panel.color)[y * panel.stride + x] =
                shade_v4(grey.x, grey.y, grey.z, 1);
    }
    return range;
}

/* The matrix from pixels of the finished picture to clip space, for shade_draw_lines */
static inline shade_mat4 canvas_from_pixels(const canvas *c)
{
    return shade_mat4_ortho(0, (float)c->width, (float)c->height, 0, -1, 1);
}

/* Averages the samples of each pixel in place; the result shares the memory of the canvas. */
static inline shade_target canvas_finish(const canvas *c)
{
    shade_target t = c->target;
    shade_vec4 *out = (shade_vec4 *)t.color;
    for (int y = 0; y < c->height; y++)
        for (int x = 0; x < c->width; x++) *out++ = canvas_pixel(c, x, y);
    t.width = c->width;
    t.height = c->height;
    t.stride = 0;
    t.depth = NULL;
    return t;
}

#ifdef CANVAS_STB
/* Writes the colours that shade_write_ppm writes, as PNG. */
static inline shade_result canvas_write_png(const char *path, const shade_target *t)
{
    const shade_vec4 *from = (const shade_vec4 *)t->color;
    /* the bytes of a pixel lie before its floats */
    unsigned char *bytes = (unsigned char *)t->color;
    int written;
    for (int i = 0; i < t->width * t->height; i++) {
        shade_vec3 k = shade_srgb_from_linear(shade_v3(from[i].x, from[i].y, from[i].z));
        bytes[3 * i] = (unsigned char)(255 * k.x + 0.5f);
        bytes[3 * i + 1] = (unsigned char)(255 * k.y + 0.5f);
        bytes[3 * i + 2] = (unsigned char)(255 * k.z + 0.5f);
    }
    written = stbi_write_png(path, t->width, t->height, 3, bytes, 3 * t->width);
    return written ? SHADE_OK : SHADE_ERROR_IO;
}
#endif

/* Writes the picture to argv[1], or to a name where there is no argument, and frees the canvas: a
   PPM, with CANVAS_STB a PNG unless argv[1] ends in .ppm.  Returns the exit status of the
   program. */
static inline int canvas_save(canvas *c, int argc, char **argv, const char *name)
{
    shade_target picture = canvas_finish(c);
    const char *path = argc > 1 ? argv[1] : name;
    shade_result result;
#ifdef CANVAS_STB
    char png[80];
    const size_t stem = strlen(path) - (strlen(path) > 4 ? 4 : 0);
    snprintf(png, sizeof png, "%.*s.png", (int)stem, name);
    if (argc < 2) path = png;
    result = strcmp(path + stem, ".ppm") == 0 ? shade_write_ppm(path, &picture)
                                              : canvas_write_png(path, &picture);
#else
    result = shade_write_ppm(path, &picture);
#endif
    if (result) fprintf(stderr, "%s: %s\n", path, shade_result_string(result));
    free(c->target.color);
    free(c->target.depth);
    return result != SHADE_OK;
}
#endif
