/* written.h - a picture as a file: PPM or, with stb_image_write, PNG.

       const picture_file f = { &target, save_is_png(name), 3 };
       return save_bytes(name, picture_write, &f); */
#ifndef MODEL_WRITTEN_H
#define MODEL_WRITTEN_H

#include "../command/save.h"
#ifdef MODEL_STB
#define STB_IMAGE_WRITE_IMPLEMENTATION
#define STB_IMAGE_WRITE_STATIC
#ifdef MODEL_ZLIB
#include <zlib.h>
/* At the fastest level of zlib files are a tenth smaller than those that stb packs.
   NULL: out of memory */
static inline unsigned char *picture_pack(unsigned char *bytes, int size, int *packed, int quality)
{
    uLongf room = compressBound((uLong)size);
    unsigned char *out = (unsigned char *)malloc(room);
    (void)quality;
    if (out && compress2(out, &room, bytes, (uLong)size, Z_BEST_SPEED)) {
        free(out);
        out = NULL;
    }
    *packed = (int)room;
    return out;
}
#define STBIW_ZLIB_COMPRESS picture_pack
#endif
#include <stb/stb_image_write.h>
#endif

/* Converts to bytes; divides by alpha, by which the canvas has multiplied colours. */
static inline uint8_t *picture_bytes(const shade_target *picture, int channels)
{
    size_t n = (size_t)picture->width * (size_t)picture->height;
    const float *from = (const float *)picture->color;
    uint8_t *bytes = (uint8_t *)malloc(n * (size_t)channels), *to = bytes;
    if (bytes && picture->format == SHADE_FORMAT_RGBA8) { /* holds what is wanted */
        for (size_t i = 0; i < n; i++)
            memcpy(to + (size_t)channels * i, (const uint8_t *)picture->color + 4 * i,
                   (size_t)channels);
        return bytes;
    }
    for (size_t i = 0; bytes && i < n; i++, from += 4) {
        float a = from[3], k = channels == 4 && a > 0 ? 1 / a : 1;
        shade_vec3 c = shade_srgb_from_linear(shade_v3(k * from[0], k * from[1], k * from[2]));
        *to++ = (uint8_t)(255 * c.x + 0.5f);
        *to++ = (uint8_t)(255 * c.y + 0.5f);
        *to++ = (uint8_t)(255 * c.z + 0.5f);
        if (channels == 4) *to++ = (uint8_t)(255 * a + 0.5f);
    }
    return bytes;
}

typedef struct picture_file {
    const shade_target *picture;
    int png, channels; /* channels: 4 with alpha, which only PNG has */
} picture_file;

static inline int picture_sink(void *user, const void *bytes, size_t size)
{
    return fwrite(bytes, 1, size, (FILE *)user) != size;
}

#ifdef MODEL_STB
typedef struct picture_png {
    FILE *file;
    int failed;
} picture_png;

static inline void picture_png_sink(void *user, void *bytes, int size)
{
    picture_png *s = (picture_png *)user;
    s->failed |= picture_sink(s->file, bytes, (size_t)size);
}

#define PICTURE_PNG "png", /* among the endings of pictures */

static inline int picture_write_png(FILE *file, const uint8_t *bytes, int width, int height,
                                    int channels)
{
    picture_png sink = { file, 0 };
    sink.failed |= !stbi_write_png_to_func(picture_png_sink, &sink, width, height, channels, bytes,
                                           width * channels);
    return sink.failed;
}
#else
#define PICTURE_PNG
static inline int picture_write_png(FILE *file, const uint8_t *bytes, int width, int height,
                                    int channels)
{
    return (void)file, (void)bytes, (void)width, (void)height, (void)channels, 1;
}
#endif

/* A save_writer of a picture_file */
static inline int picture_write(FILE *file, const void *data)
{
    const picture_file *f = (const picture_file *)data;
    uint8_t *bytes;
    int failed;
    errno = 0;
    if (f->png) {
        bytes = picture_bytes(f->picture, f->channels);
        failed = !bytes ||
                 picture_write_png(file, bytes, f->picture->width, f->picture->height, f->channels);
        free(bytes);
        return failed;
    }
    return shade_encode_ppm(picture_sink, file, f->picture) != SHADE_OK;
}
#endif
