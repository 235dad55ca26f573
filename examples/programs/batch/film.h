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
    const char *mp4[] = { "-c:v",    "libx264",   "-crf",       "18", "-pix_fmt",
                          "yuv420p", "-movflags", "+faststart", "-f", "mp4" };
    const char *words[32] = { NULL };
    const int is_webp = film_is_webp(f->path);
    memcpy(words, begin, sizeof begin);
    memcpy(words + 12, is_webp ? webp : mp4, is_webp ? sizeof webp : sizeof mp4);
    words[is_webp ? 20 : 22] = part;
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

/* Ends the film and gives it its name, or removes it.  Returns 1 with a line on stderr. */
static inline int film_close(film *f, int failed)
{
    int status = child_end(&f->encoder);
    if (status == CHILD_MISSING)
        failed = complain("films are made by ffmpeg, which is not installed");
    else if (status || failed)
        failed = complain("%s: ffmpeg could not make it", f->path);
    return save_end(NULL, f->path, failed ? SAVE_SAID : 0);
}
#endif
