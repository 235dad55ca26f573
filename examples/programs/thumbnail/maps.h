/* maps.h - the results of a drawing that programs read: depth and parts as pictures of 16 bits, and
   a description in JSON. */
#ifndef THUMBNAIL_MAPS_H
#define THUMBNAIL_MAPS_H

#include "../../kit/read/zip.h"
#include "annotate.h"
#include "options.h"

enum { MAP_NOTHING = 65535 }; /* a depth: nothing is there */

typedef struct drawing_map {
    const uint16_t *value;
    int width, height, png;
} drawing_map;

/* ---- pictures of 16 bits --------------------------------------------------------------------- */

static void map_uint(unsigned char *to, uint32_t v)
{
    for (int k = 0; k < 4; k++) to[k] = (unsigned char)(v >> (24 - 8 * k));
}

/* Writes a chunk of a PNG. */
static int map_chunk(FILE *file, const char *name, const unsigned char *bytes, size_t n)
{
    unsigned char head[8], tail[4];
    map_uint(head, (uint32_t)n);
    memcpy(head + 4, name, 4);
    map_uint(tail, zip_crc(zip_crc(0, head + 4, 4), bytes, n));
    return fwrite(head, 1, 8, file) != 8 || fwrite(bytes, 1, n, file) != n ||
           fwrite(tail, 1, 4, file) != 4;
}

/* The rows as bytes, the high one first, each behind so many bytes of 0 */
static unsigned char *map_bytes(const drawing_map *m, size_t before, size_t *n)
{
    const size_t row = before + 2 * (size_t)m->width;
    unsigned char *bytes = (unsigned char *)malloc(row * (size_t)m->height);
    const uint16_t *from = m->value;
    *n = row * (size_t)m->height;
    for (int j = 0; bytes && j < m->height; j++) {
        unsigned char *to = bytes + row * (size_t)j;
        memset(to, 0, before);
        to += before;
        for (int i = 0; i < m->width; i++, from++) {
            *to++ = (unsigned char)(*from >> 8);
            *to++ = (unsigned char)*from;
        }
    }
    return bytes;
}

/* stb_image_write writes PNG of 8 bits alone; its compressor serves here. */
static int map_write_png(FILE *file, const drawing_map *m)
{
#ifdef MODEL_STB
    static const unsigned char sign[] = { 137, 'P', 'N', 'G', 13, 10, 26, 10 };
    unsigned char head[13] = { 0 }, *packed = NULL;
    size_t n;
    unsigned char *bytes = map_bytes(m, 1, &n);
    int size = 0, failed;
    map_uint(head, (uint32_t)m->width);
    map_uint(head + 4, (uint32_t)m->height);
    head[8] = 16; /* bits a channel; the zeros behind say grey, deflate, filters, not interlaced */
    if (bytes) packed = stbi_zlib_compress(bytes, (int)n, &size, 5);
    failed = !packed || fwrite(sign, 1, sizeof sign, file) != sizeof sign ||
             map_chunk(file, "IHDR", head, sizeof head) ||
             map_chunk(file, "IDAT", packed, (size_t)size) || map_chunk(file, "IEND", head, 0);
    free(packed);
    free(bytes);
    return failed;
#else
    (void)file;
    (void)m;
    (void)map_chunk;
    return 1;
#endif
}

static int map_write(FILE *file, const void *data)
{
    const drawing_map *m = (const drawing_map *)data;
    unsigned char *bytes;
    size_t n;
    int failed;
    errno = 0;
    if (m->png) return map_write_png(file, m);
    bytes = map_bytes(m, 0, &n);
    fprintf(file, "P5\n%d %d\n65535\n", m->width, m->height);
    failed = !bytes || fwrite(bytes, 1, n, file) != n;
    free(bytes);
    return failed;
}

static int map_save(const char *path, const uint16_t *value, int width, int height)
{
    const drawing_map m = { value, width, height, save_is_png(path) };
    return save_bytes(path, map_write, &m);
}

/* ---- JSON ------------------------------------------------------------------------------------ */

/* What is told of a drawing */
typedef struct drawing_text {
    const char *input, *output;
    const drawing_options *options;
    const views *views;
    const pieces *pieces;
    const char *up;          /* the upright axis of the file */
    matrix4 model_from_file; /* upright, about the origin, half as large as 2 at most */
    double low[3], high[3];  /* the box, in the units of the file */
    const double *origin;    /* of the boxes of pieces */
    const int *pixels;       /* of each piece in each view: VIEW_KINDS a piece */
    const shade_vec3 *color; /* of each piece, linear */
    int triangles;
} drawing_text;

/* The length of the character of UTF-8 at a place; 0: it is none */
static size_t json_character(const unsigned char *c)
{
    size_t n = c[0] < 0x80                   ? 1
               : c[0] >= 0xC2 && c[0] < 0xE0 ? 2
               : c[0] >= 0xE0 && c[0] < 0xF0 ? 3
               : c[0] >= 0xF0 && c[0] < 0xF5 ? 4
                                             : 0;
    for (size_t k = 1; k < n; k++)
        if ((c[k] & 0xC0) != 0x80) return 0;
    if (n == 3 && ((c[0] == 0xE0 && c[1] < 0xA0) || (c[0] == 0xED && c[1] > 0x9F))) return 0;
    if (n == 4 && ((c[0] == 0xF0 && c[1] < 0x90) || (c[0] == 0xF4 && c[1] > 0x8F))) return 0;
    return n;
}

static void json_string(FILE *file, const char *text)
{
    const unsigned char *c = (const unsigned char *)text;
    putc('"', file);
    while (*c) {
        size_t n = json_character(c);
        if (*c < 32 || *c == '"' || *c == '\\')
            fprintf(file, "\\u%04x", *c);
        else if (!n)
            fputs("\\ufffd", file);
        else
            fwrite(c, 1, n, file);
        c += n ? n : 1;
    }
    putc('"', file);
}

static void json_numbers(FILE *file, const char *name, const double *v, int n)
{
    fprintf(file, "\"%s\": [", name);
    for (int i = 0; i < n; i++) fprintf(file, "%s%.12g", i ? ", " : "", v[i] + 0.0);
    fputs("]", file);
}

static void json_box(FILE *file, const double *low, const double *high)
{
    double size[3];
    for (int k = 0; k < 3; k++) size[k] = high[k] - low[k];
    fputs("\"box\": { ", file);
    json_numbers(file, "low", low, 3);
    fputs(", ", file);
    json_numbers(file, "high", high, 3);
    fputs(", ", file);
    json_numbers(file, "size", size, 3);
    fputs(" }", file);
}

/* A direction of the model as one of the file */
static void json_way(FILE *file, const drawing_text *t, const char *name, shade_vec3 way)
{
    const double q[3] = { (double)way.x, (double)way.y, (double)way.z };
    double v[3], length = 0;
    for (int c = 0; c < 3; c++) {
        v[c] = 0;
        for (int k = 0; k < 3; k++) v[c] += t->model_from_file.row[k][c] * q[k];
        length += v[c] * v[c];
    }
    for (int c = 0; c < 3; c++) v[c] /= sqrt(length);
    json_numbers(file, name, v, 3);
}

static void json_view(FILE *file, const drawing_text *t, const view *v)
{
    const double *unit = t->model_from_file.row[0];
    const double scale = sqrt(unit[0] * unit[0] + unit[1] * unit[1] + unit[2] * unit[2]);
    matrix4 to = matrix4_mul(&v->from_model, &t->model_from_file), from;
    for (int c = 0; c < 4; c++) to.row[2][c] *= MAP_NOTHING - 1;
    from = matrix4_inverse(to);
    fprintf(file, "    { \"name\": \"%s\", \"projection\": \"%s\",\n", view_names[v->kind],
            v->lens ? "perspective" : "parallel");
    fprintf(file, "      \"x\": %d, \"y\": %d, \"width\": %d, \"height\": %d,\n      ", v->x, v->y,
            v->width, v->height);
    if (!v->lens) fprintf(file, "\"pixels_per_unit\": %.12g,\n      ", v->scale * scale);
    json_way(file, t, "right", v->right);
    fputs(", ", file);
    json_way(file, t, "up", v->up);
    fputs(", ", file);
    json_way(file, t, "toward_eye", v->toward);
    fputs(",\n      ", file);
    json_numbers(file, "pixel_from_file", to.row[0], 16);
    fputs(",\n      ", file);
    json_numbers(file, "file_from_pixel", from.row[0], 16);
    fputs(" }", file);
}

static void json_piece(FILE *file, const drawing_text *t, int i)
{
    const piece *p = &t->pieces->list[i];
    const shade_vec3 c = shade_srgb_from_linear(t->color[i]);
    double low[3], high[3];
    for (int k = 0; k < 3; k++) {
        low[k] = (double)p->low[k] + t->origin[k];
        high[k] = (double)p->high[k] + t->origin[k];
    }
    fprintf(file, "    { \"id\": %d, \"name\": ", i + 1);
    json_string(file, p->name);
    fprintf(file, ", \"color\": \"#%02X%02X%02X\", \"triangles\": %d,\n      ",
            (unsigned)(255 * c.x + 0.5f), (unsigned)(255 * c.y + 0.5f),
            (unsigned)(255 * c.z + 0.5f), p->triangles);
    json_box(file, low, high);
    fputs(",\n      \"pixels\": { ", file);
    for (int v = 0; v < t->views->count; v++)
        fprintf(file, "%s\"%s\": %d", v ? ", " : "", view_names[t->views->list[v].kind],
                t->pixels[i * VIEW_KINDS + v]);
    fputs(" } }", file);
}

static void json_name(FILE *file, const char *name, const char *value)
{
    fprintf(file, "  \"%s\": ", name);
    if (value)
        json_string(file, value);
    else
        fputs("null", file);
    fputs(",\n", file);
}

static int json_write(FILE *file, const void *data)
{
    const drawing_text *t = (const drawing_text *)data;
    errno = 0;
    fputs("{\n", file);
    json_name(file, "model", t->input);
    json_name(file, "sheet", t->output);
    json_name(file, "depth", t->options->depth);
    json_name(file, "id_map", t->options->id_map);
    json_name(file, "angle", t->options->first_angle ? "first" : "third");
    json_name(file, "up", t->up);
    fprintf(file, "  \"width\": %d, \"height\": %d, \"triangles\": %d, \"nothing\": %d,\n  ",
            t->views->width, t->views->height, t->triangles, MAP_NOTHING);
    json_box(file, t->low, t->high);
    fputs(",\n", file);
    fputs("  \"views\": [\n", file);
    for (int i = 0; i < t->views->count; i++) {
        json_view(file, t, &t->views->list[i]);
        fputs(i + 1 < t->views->count ? ",\n" : "\n", file);
    }
    fprintf(file, "  ],\n  \"parts_are\": \"%s\",\n  \"parts\": [\n",
            t->pieces->by_objects ? "objects of the file" : "connected triangles");
    for (int i = 0; i < t->pieces->count; i++) {
        json_piece(file, t, i);
        fputs(i + 1 < t->pieces->count ? ",\n" : "\n", file);
    }
    fputs("  ]\n}\n", file);
    return ferror(file) != 0;
}
#endif
