/* film.h - makes a film of pictures as they are drawn, by ffmpeg, which must be installed.  The
   film appears whole or not at all.

       film f = { .path = "turn.webp" };
       if (film_open(&f, 30)) ...                              (a line on stderr has said why)
       fwrite(ppm, 1, size, f.encoder.input);                  (for each frame, one after the other)
       return film_close(&f, 0); */
#ifndef BATCH_FILM_H
#define BATCH_FILM_H

#include "child.h"
#include "file.h"

typedef struct film {
    const char *path;
    child encoder; /* takes the frames as PPM */
} film;

/* 1: the name ends in .webp or .mp4, the films that are made. */
static inline int film_is_webp(const char *path)
{
    size_t n = strlen(path);
    return n > 5 && !strcmp(path + n - 5, ".webp");
}
static inline int film_is_mp4(const char *path)
{
    size_t n = strlen(path);
    return n > 4 && !strcmp(path + n - 4, ".mp4");
}

/* Starts ffmpeg, which writes part. */
static inline int film_start(film *f, int rate, const char *part)
{
    char framerate[16];
    const char *begin[] = { "ffmpeg", "-v",  "error",      "-y",      "-f", "image2pipe",
                            "-c:v",   "ppm", "-framerate", framerate, "-i", "-" };
    const char *webp[] = { "-c:v", "libwebp_anim", "-quality", "85", "-loop", "0", "-f", "webp" };
    /* players take untagged YUV for BT.709, and ffmpeg makes BT.601 of RGB */
    const char *mp4[] = { "-vf",
                          "scale=out_color_matrix=bt709:out_range=tv",
                          "-c:v",
                          "libx264",
                          "-crf",
                          "18",
                          "-pix_fmt",
                          "yuv420p",
                          "-colorspace",
                          "bt709",
                          "-color_range",
                          "tv",
                          "-color_primaries",
                          "bt709",
                          "-color_trc",
                          "iec61966-2-1",
                          "-movflags",
                          "+faststart",
                          "-f",
                          "mp4" };
    const char *words[40] = { NULL };
    const int is_webp = film_is_webp(f->path);
    const size_t bytes = is_webp ? sizeof webp : sizeof mp4;
    memcpy(words, begin, sizeof begin);
    memcpy(words + 12, is_webp ? webp : mp4, bytes);
    words[12 + bytes / sizeof *words] = part;
    snprintf(framerate, sizeof framerate, "%d", rate);
    return child_start(&f->encoder, words);
}

/* Returns 1 with a line on stderr. */
static inline int film_open(film *f, int rate)
{
    FILE *part = save_begin(f->path);
    char *name;
    int failed;
    if (!part) return 1;
    fclose(part);
    name = save_part();
    failed = !name || film_start(f, rate, name);
    free(name);
    if (!failed) return 0;
    complain("ffmpeg: %s", strerror(errno));
    return save_end(NULL, f->path, SAVE_SAID);
}

/* 1: the boxes of the MP4, or the one chunk of the WebP, end where the file does.  ffmpeg ends
   well where the disk was full at the end. */
static inline int film_is_whole(const char *part, int is_webp)
{
    unsigned char b[16];
    FILE *file = path_open(part, "rb");
    const long long size = file ? batch_size(file) : -1;
    long long at = 0;
    int films = 0; /* boxes with an index */
    while (file && at < size && !fseek(file, (long)at, SEEK_SET) && fread(b, 1, 16, file) > 7) {
        const long long low = (long long)b[0] << 24 | b[1] << 16 | b[2] << 8 | b[3];
        const long long riff = (long long)b[7] << 24 | b[6] << 16 | b[5] << 8 | b[4];
        long long box = is_webp ? 8 + riff : low;
        if (box == 1) { /* the size has 64 bits and stands behind */
            unsigned long long wide = 0;
            for (int k = 8; k < 16; k++) wide = wide << 8 | b[k];
            box = (long long)wide;
        }
        films += !memcmp(b, "RIFF", 4) || !memcmp(b + 4, "moov", 4);
        if (box < 8 || box > size - at) break;
        at += box;
    }
    if (file) fclose(file);
    return films == 1 && at == size;
}

/* Ends the film and gives it its name, or removes it.  Returns 1 with a line on stderr. */
static inline int film_close(film *f, int failed)
{
    int status = child_end(&f->encoder);
    char *part = save_part();
    if (!status && (!part || !film_is_whole(part, film_is_webp(f->path)))) status = CHILD_CRASHED;
    free(part);
    if (status == CHILD_MISSING)
        failed = complain("films are made by ffmpeg, which is not installed");
    else if (status || failed)
        failed = complain("%s: ffmpeg could not make it", f->path);
    return save_end(NULL, f->path, failed ? SAVE_SAID : 0);
}
#endif
