/* pictures.h - the pictures on surfaces, by stb_image: PNG, JPEG, TGA, BMP, PSD, GIF,
   HDR, PIC, PNM.  What cannot be read is a warning, and the surface has its plain colour. */
#ifndef MODEL_PICTURES_H
#define MODEL_PICTURES_H

#include "files.h"

/* The number of a new picture without pixels, or -1: out of memory */
static int picture_add(model *m, const char *name)
{
    static const model_picture empty;
    model_picture *grown = (model_picture *)mesh_grow(m->picture, (size_t)m->picture_count,
                                                      &m->picture_room, sizeof *grown);
    if (!grown) return -1;
    m->picture = grown;
    grown[m->picture_count] = empty;
    grown[m->picture_count].name = model_text(name, strlen(name));
    return grown[m->picture_count].name ? m->picture_count++ : -1;
}

/* Gives a picture its pixels (RGBA8, from malloc) and its mipmaps. */
static inline void picture_fill(model_picture *p, void *pixels, int width, int height)
{
    p->pixels = pixels;
    p->map.pixels = pixels;
    p->map.width = width;
    p->map.height = height;
    p->map.srgb = 1;
}

/* Points each texture to its levels, once the array of pictures no longer moves. */
static void picture_mipmaps(model_picture *p)
{
    size_t bytes = shade_mipmap_bytes(p->map.width, p->map.height, SHADE_FORMAT_RGBA8);
    if (!p->pixels || !bytes) return;
    p->mipmaps = malloc(bytes);
    if (!p->mipmaps || shade_build_mipmaps(&p->map, p->level, p->mipmaps, bytes)) return;
    p->map.filter = SHADE_FILTER_TRILINEAR;
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

/* Reads one picture.  Returns the error, or NULL. */
static const char *picture_decode(model_picture *p, const unsigned char *bytes, size_t size)
{
    int width, height, channels;
    unsigned char *pixels;
    if (size > INT_MAX || !stbi_info_from_memory(bytes, (int)size, &width, &height, &channels))
        return "no picture that stb_image reads";
    if ((double)width * height > 1e8) return "a picture of more than 100 million pixels";
    pixels = stbi_load_from_memory(bytes, (int)size, &width, &height, &channels, 4);
    if (!pixels) return stbi_failure_reason();
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
   slash: names from other machines contain folders that do not exist here. */
static int picture_load(model *m, const char *path, const char *name)
{
    char error[300] = "out of memory";
    unsigned char *bytes = NULL;
    size_t size = 0, last = 0;
    int number = picture_add(m, name), failed = 1;
    for (size_t i = 0; name[i]; i++)
        if (name[i] == '/' || name[i] == '\\') last = i + 1;
    for (int attempt = 0; attempt < 2 && failed && number >= 0; attempt++) {
        mesh_reader r = {
            NULL, NULL, NULL, name, 0, attempt ? NULL : error, attempt ? 0 : sizeof error,
            NULL, NULL, 0
        };
        char *beside = model_beside(path, attempt ? name + last : name);
        failed = !beside || model_load(&r, beside, &bytes, &size);
        free(beside);
    }
    if (!failed) {
        const char *wrong = picture_decode(&m->picture[number], bytes, size);
        if (wrong) model_warn(m, name, wrong);
    } else {
        model_warn(m, path, error);
    }
    free(bytes);
    return number;
}

/* Reads each picture that surfaces name once, and finds the kind of its alpha. */
static void read_pictures(model *m, const char *path)
{
    for (int i = 0; i < m->surface_count; i++) {
        model_surface *s = &m->surface[i];
        if (!s->map || s->picture >= 0) continue;
        for (int k = 0; k < m->picture_count && s->picture < 0; k++)
            if (!strcmp(m->picture[k].name, s->map)) s->picture = k;
        if (s->picture < 0) s->picture = picture_load(m, path, s->map);
    }
    for (int i = 0; i < m->picture_count; i++) picture_mipmaps(&m->picture[i]);
    for (int i = 0; i < m->surface_count; i++) {
        model_surface *s = &m->surface[i];
        int clear;
        if (s->picture < 0 || !m->picture[s->picture].pixels || s->opaque) continue;
        if (s->alpha_cutoff > 0 || s->blended) continue;
        clear = picture_clearness(&m->picture[s->picture]);
        s->blended = clear == 2;
        s->alpha_cutoff = clear == 1 ? 0.5f : 0;
    }
}
#endif
