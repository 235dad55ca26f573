/* film.h - makes a film of pictures as they are drawn, by ffmpeg, which must be installed.  The
   film appears whole or not at all.  POSIX.

       film f = { "turn.webp", NULL, 0 };
       if (film_open(&f, 30)) ...                              (a line on stderr has said why)
       fwrite(ppm, 1, size, f.frames);                         (for each frame, one after the other)
       return film_close(&f, 0); */
#ifndef BATCH_FILM_H
#define BATCH_FILM_H

#include "file.h"
#include <sys/wait.h>

typedef struct film {
    const char *path;
    FILE *frames; /* takes the frames as PPM */
    pid_t process;
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

/* The child process: frames come from its standard input. */
static inline void film_run(const char *path, int rate, int frames)
{
    char framerate[16];
    const char *begin[] = { "ffmpeg", "-v", "error", "-y", "-f", "image2pipe", "-c:v", "ppm",
                            "-framerate", framerate, "-i", "-" };
    const char *webp[] = { "-c:v", "libwebp_anim", "-quality", "85", "-loop", "0", "-f", "webp" };
    const char *mp4[] = { "-c:v", "libx264", "-crf", "18", "-pix_fmt", "yuv420p", "-movflags",
                          "+faststart", "-f", "mp4" };
    const char *words[32] = { NULL };
    const int is_webp = film_is_webp(path);
    memcpy(words, begin, sizeof begin);
    memcpy(words + 12, is_webp ? webp : mp4, is_webp ? sizeof webp : sizeof mp4);
    words[is_webp ? 20 : 22] = guard_part;
    snprintf(framerate, sizeof framerate, "%d", rate);
    dup2(frames, STDIN_FILENO);
    execvp("ffmpeg", (char **)(uintptr_t)words);
    _exit(127);
}

/* Starts ffmpeg.  Returns 1 with a line on stderr. */
static inline int film_open(film *f, int rate)
{
    int ends[2];
    FILE *part = save_begin(f->path);
    if (!part) return 1;
    fclose(part);
    signal(SIGPIPE, SIG_IGN); /* ffmpeg may end early: writing fails then */
    f->process = pipe(ends) ? -1 : fork();
    if (f->process == 0) {
        close(ends[1]);
        film_run(f->path, rate, ends[0]);
    }
    if (f->process < 0) {
        unlink(guard_part);
        return complain("ffmpeg: %s", strerror(errno));
    }
    close(ends[0]);
    f->frames = fdopen(ends[1], "wb");
    return f->frames ? 0 : complain("out of memory");
}

/* Ends the film and gives it its name, or removes it.  Returns 1 with a line on stderr. */
static inline int film_close(film *f, int failed)
{
    int status = 0;
    if (fclose(f->frames)) failed = 1;
    while (waitpid(f->process, &status, 0) < 0 && errno == EINTR) continue;
    if (WIFEXITED(status) && WEXITSTATUS(status) == 127)
        failed = complain("films are made by ffmpeg, which is not installed");
    else if (status || failed)
        failed = complain("%s: ffmpeg could not make it", f->path);
    else if (rename(guard_part, f->path))
        failed = complain("%s: %s", f->path, strerror(errno));
    if (failed) unlink(guard_part);
    *guard_part = 0;
    return failed;
}
#endif
