/* pictures.h - the pictures on surfaces, by stb_image: PNG, JPEG, TGA, BMP, PSD, GIF,
   HDR, PIC, PNM.  What cannot be read is a warning, and the surface has its plain colour. */
#ifndef MODEL_PICTURES_H
#define MODEL_PICTURES_H

#include "../read/files.h"
#include "pnm.h"

/* Gives a picture its pixels (RGBA8, from malloc) and its mipmaps. */
static inline void picture_fill(model_picture *p, void *pixels, int width, int height)
{
    p->pixels = pixels;
    p->map.pixels = pixels;
    p->map.width = width;
    p->map.height = height;
    p->map.srgb = p->what == PICTURE_COLORS;
}

/* Points each texture to its levels, once the array of pictures no longer moves. */
static void picture_mipmaps(model_picture *p)
{
    const int squares = p->map.filter == SHADE_FILTER_NEAREST;
    size_t bytes = shade_mipmap_bytes(p->map.width, p->map.height, SHADE_FORMAT_RGBA8);
    if (!p->pixels || !bytes) return;
    p->mipmaps = malloc(bytes);
    if (!p->mipmaps || texture_levels(&p->map, p->level, p->mipmaps, bytes, squares))
        p->map.filter = squares ? SHADE_FILTER_NEAREST : SHADE_FILTER_BILINEAR;
}

/* The mean square of the slopes of a bump map */
static double picture_slope_square(const model_picture *p)
{
    const size_t width = (size_t)p->map.width, height = (size_t)p->map.height;
    const double scale[2] = { (double)width / 765, (double)height / 765 };
    double sum = 0;
    for (size_t y = 0; y + 1 < height; y++) {
        for (size_t x = 0; x + 1 < width; x++) {
            const uint8_t *t = (const uint8_t *)p->pixels + 4 * (width * y + x);
            const uint8_t *beside[2] = { t + 4, t + 4 * width };
            for (int a = 0; a < 2; a++) {
                const uint8_t *b = beside[a];
                const double rise = scale[a] * (b[0] + b[1] + b[2] - t[0] - t[1] - t[2]);
                sum += rise * rise;
            }
        }
    }
    return width > 1 && height > 1 ? sum / (double)((width - 1) * (height - 1)) : 0;
}

/* Finds out whether a relief holds heights or normals: normals are blue.  Files name either under
   either name. */
static void picture_look_at_relief(model_picture *p)
{
    const size_t n = (size_t)p->map.width * (size_t)p->map.height;
    const uint8_t *texel = (const uint8_t *)p->pixels;
    double blue = 0;
    for (size_t i = 0; i < n; i++, texel += 4) blue += texel[2] - 0.5 * (texel[0] + texel[1]);
    p->heights = blue < 40 * (double)n;
    if (p->heights) p->slope_square = picture_slope_square(p);
}

/* The kind of a picture's alpha: 0 opaque, 1 some texels wholly clear and the others opaque, 2
   others */
static int picture_clearness(const model_picture *p)
{
    size_t n = (size_t)p->map.width * (size_t)p->map.height, between = 0, clear = 0;
    const uint8_t *alpha = (const uint8_t *)p->pixels + 3;
    for (size_t i = 0; i < n; i++) {
        clear += alpha[4 * i] < 16;
        between += alpha[4 * i] >= 16 && alpha[4 * i] < 240;
    }
    return between > n / 8 ? 2 : clear || between ? 1 : 0;
}

#ifdef MODEL_STB
#define STB_IMAGE_IMPLEMENTATION
#define STBI_MAX_DIMENSIONS 16384
#include <stb/stb_image.h>

/* PPM and PGM by their greatest value, which stb_image does not heed */
static const char *picture_decode_pnm(model_picture *p, pnm *from)
{
    const size_t pixels = (size_t)from->width * (size_t)from->height;
    uint8_t *rgba, *to;
    if ((double)from->width * from->height > 1e8)
        return "a picture of more than 100 million pixels";
    rgba = to = (uint8_t *)malloc(4 * pixels);
    if (!rgba) return "out of memory";
    for (size_t i = 0; i < pixels; i++, to += 4) {
        for (int k = 0; k < from->channels; k++) {
            const int v = pnm_next(from);
            if (v < 0 || v > from->most) {
                free(rgba);
                return v < 0 ? "ends too early" : "a value above its own maximum";
            }
            to[k] = (uint8_t)((510 * (long long)v + from->most) / (2 * from->most));
        }
        if (from->channels == 1) to[1] = to[2] = to[0];
        to[3] = 255;
    }
    picture_fill(p, rgba, from->width, from->height);
    return NULL;
}

/* 1: the bytes are a TGA whose rows are stored from the right to the left, which stb_image does not
   heed.  Other formats have other numbers where TGA has its kind and that of its colours. */
static int picture_is_from_right(const unsigned char *bytes, size_t size)
{
    const int kind = size > 18 ? bytes[2] : 0;
    const int tga = bytes[1] < 2 && (kind & ~8) >= 1 && (kind & ~8) <= 3;
    return size > 18 && tga && (bytes[17] & 16);
}

static void picture_turn(uint8_t *pixels, int width, int height)
{
    for (int y = 0; y < height; y++) {
        uint8_t *left = pixels + 4 * (size_t)width * (size_t)y, *right = left + 4 * (width - 1);
        for (; left < right; left += 4, right -= 4) {
            uint8_t own[4];
            memcpy(own, left, 4);
            memcpy(left, right, 4);
            memcpy(right, own, 4);
        }
    }
}

/* Reads one picture.  Returns the error, or NULL. */
static const char *picture_decode(model_picture *p, const unsigned char *bytes, size_t size)
{
    int width, height, channels;
    unsigned char *pixels;
    pnm plain;
    if (!pnm_open(&plain, bytes, size)) return picture_decode_pnm(p, &plain);
    if (size > INT_MAX || !stbi_info_from_memory(bytes, (int)size, &width, &height, &channels))
        return "no picture that stb_image reads";
    if ((double)width * height > 1e8) return "a picture of more than 100 million pixels";
    pixels = stbi_load_from_memory(bytes, (int)size, &width, &height, &channels, 4);
    if (!pixels) return stbi_failure_reason();
    if (picture_is_from_right(bytes, size)) picture_turn(pixels, width, height);
    picture_fill(p, pixels, width, height);
    return NULL;
}
#else
static const char *picture_decode(model_picture *p, const unsigned char *bytes, size_t size)
{
    (void)p, (void)bytes, (void)size;
    return "built without stb (libstb-dev), so without pictures on surfaces";
}
#endif

/* Reads a picture in the folder of the model, by its whole name, or by the part after its last
   slash: names from other machines contain folders that do not exist here.  A name that leaves the
   folder of the model counts only where the caller wants that: who draws models of strangers does
   not show them the pictures of others. */
static void picture_load(model *m, int number, const char *path, int outside)
{
    const char *name = m->picture[number].name, *last = model_last(name);
    const int beside_model = outside || model_is_beside(name);
    char error[300] = "out of memory";
    unsigned char *bytes = NULL;
    size_t size = 0;
    int failed = 1;
    if (!beside_model)
        snprintf(error, sizeof error,
                 "%s: it lies outside of the model's folder; --outside reads it", name);
    for (int attempt = !beside_model; attempt < 2 && failed; attempt++) {
        char *beside = NULL;
        failed = model_load_file(path, attempt ? last : name, MODEL_PICTURE_BYTES, &bytes, &size,
                                 &beside, error, attempt ? 0 : sizeof error);
        if (failed)
            free(beside);
        else
            m->picture[number].path = beside;
    }
    if (!failed) {
        const char *wrong = picture_decode(&m->picture[number], bytes, size);
        if (wrong) model_leave_out(m, name, wrong);
    } else {
        model_leave_out(m, path, error);
    }
    free(bytes);
}

/* Decodes the pictures that the model's file holds. */
static void decode_pictures(model *m)
{
    for (int i = 0; i < m->picture_count; i++) {
        model_picture *p = &m->picture[i];
        const char *wrong = p->bytes ? picture_decode(p, p->bytes, p->size) : NULL;
        if (wrong) model_leave_out(m, p->name, wrong);
        free(p->bytes);
        p->bytes = NULL;
    }
}

/* Metal and roughness become the factors of the file times the means of their pictures at corners
   of faces, some ten thousand at most. */
static void picture_polish(model *m)
{
    for (int i = 0; i < m->part_count && m->surface_count && m->mesh.texcoords; i++) {
        const model_part *part = &m->part[i];
        model_surface *s = &m->surface[part->surface];
        shade_vec4 mean = shade_v4(0, 0, 0, 0);
        const int step = 1 + part->count / 10000, n = (part->count + step - 1) / step;
        if (s->polish < 0 || !m->picture[s->polish].pixels) continue;
        for (int k = 0; k < part->count; k += step) {
            const float *uv = m->mesh.texcoords + 2 * (size_t)m->mesh.indices[part->first + k];
            const shade_vec4 at = shade_sample(&m->picture[s->polish].map, uv[0], uv[1], 0);
            mean = shade_add4(mean, shade_scale4(at, 1 / (float)n));
        }
        s->polish = -1;
        model_polish(s, mean.z, mean.y);
    }
}

static void picture_list(model *m, const char *name, int what, int *number)
{
    if (!name || *number >= 0) return;
    *number = picture_find(m, name, what);
    if (*number < 0) *number = picture_add(m, name, what);
}

/* Lists the pictures that surfaces name and the file does not hold, each once; returns the first of
   them. */
static int list_pictures(model *m)
{
    const int held = m->picture_count;
    for (int i = 0; i < m->surface_count; i++) {
        model_surface *s = &m->surface[i];
        picture_list(m, s->map, PICTURE_COLORS, &s->picture);
        picture_list(m, s->glow_map, PICTURE_COLORS, &s->glow_picture);
        picture_list(m, s->relief.map, PICTURE_RELIEF, &s->relief.picture);
    }
    return held;
}

/* In glTF what a surface sends by itself has a picture of its own.  Elsewhere the map multiplies it
   too, as in OpenGL's fixed pipeline, for which those formats were made. */
static void picture_shines(const model *m, model_surface *s)
{
    const shade_vec3 e = s->material.emission;
    if (m->physical || s->glow_picture >= 0 || e.x + e.y + e.z <= 0) return;
    if (s->picture < 0 || !m->picture[s->picture].pixels) return;
    s->glow_picture = s->picture;
    s->glow = e;
    s->material.emission = shade_v3(0, 0, 0);
}

/* Once pictures have pixels: what they say of their surfaces. */
static void heed_pictures(model *m)
{
    for (int i = 0; i < m->picture_count; i++)
        if (m->picture[i].what == PICTURE_RELIEF && m->picture[i].pixels)
            picture_look_at_relief(&m->picture[i]);
    picture_polish(m);
    for (int i = 0; i < m->surface_count; i++) {
        model_surface *s = &m->surface[i];
        model_relief *r = &s->relief;
        int clear;
        if (s->glow_picture >= 0 && !m->picture[s->glow_picture].pixels) s->glow_picture = -1;
        if (r->picture >= 0 && !m->picture[r->picture].pixels) r->picture = -1;
        picture_shines(m, s);
        if (s->picture < 0 || !m->picture[s->picture].pixels || s->opaque) continue;
        if (s->alpha_cutoff > 0 || s->blended) continue;
        clear = picture_clearness(&m->picture[s->picture]);
        s->blended = clear == 2;
        s->alpha_cutoff = clear == 1 ? 0.5f : 0;
    }
}

static inline void read_pictures(model *m, const char *path, int outside)
{
    int first;
    decode_pictures(m);
    first = list_pictures(m);
    for (int i = first; i < m->picture_count; i++) picture_load(m, i, path, outside);
    heed_pictures(m);
    for (int i = 0; i < m->picture_count; i++)
        if (m->picture[i].what != PICTURE_POLISH) picture_mipmaps(&m->picture[i]);
}
#endif
