/* film.h - makes a film of pictures as they are drawn, by ffmpeg, which must be installed.  The
   film appears whole or not at all.

       film f = { .path = "turn.webp" };
       if (film_open(&f, 30)) ...                              (a line on stderr has said why)
       fwrite(ppm, 1, size, f.encoder.input);                  (for each frame, one after the other)
       return film_close(&f, 0); */
#ifndef BATCH_FILM_H
#define BATCH_FILM_H

#include "../../kit/command/guard.h"
#include "file.h"
#include <errno.h>

/* ---- another program, which reads what we write.  POSIX or Windows.  Of several that run at
   a time, an interrupt ends the last one alone.

       child c;
       const char *const words[] = { "ffmpeg", "-i", "-", "film.mp4", NULL };
       if (child_start(&c, words)) ...                        (errno tells why not)
       fwrite(bytes, 1, size, c.input);
       return child_end(&c);                      (its exit status, CHILD_MISSING, CHILD_CRASHED) */

/* It did not end by itself, or did not read all; there is no program of that name. */
enum { CHILD_CRASHED = -1, CHILD_MISSING = 127 };

#ifdef GUARD_WINDOWS
typedef struct child {
    FILE *input;
    HANDLE process; /* NULL: there is no such program */
} child;

/* Appends a word as programs of Microsoft's C library take command lines apart: in quotation marks,
   of which each inside has a backslash before it, and so has each backslash before one. */
static inline void child_append(char *line, size_t room, const char *word)
{
    size_t n = strlen(line), slashes = 0;
    if (n + 2 * strlen(word) + 4 > room) return;
    line[n++] = '"';
    for (;; word++) {
        if (*word == '"' || !*word)
            for (; slashes; slashes--) line[n++] = '\\';
        if (!*word) break;
        if (*word == '"') line[n++] = '\\';
        slashes = *word == '\\' ? slashes + 1 : 0;
        line[n++] = *word;
    }
    line[n++] = '"';
    line[n++] = ' ';
    line[n] = 0;
}

/* Starts a program that stands on the path.  Non-zero: errno tells why it could not. */
static inline int child_start(child *c, const char *const *words)
{
    static char line[20000];
    SECURITY_ATTRIBUTES inherited = { sizeof inherited, NULL, TRUE };
    STARTUPINFOW how = { 0 };
    PROCESS_INFORMATION started = { 0 };
    HANDLE theirs, ours;
    wchar_t *wide;
    int file;
    *line = 0;
    for (; *words; words++) child_append(line, sizeof line, *words);
    wide = path_wide(line);
    if (!wide) return 1;
    if (!CreatePipe(&theirs, &ours, &inherited, 0)) {
        free(wide);
        errno = EMFILE;
        return 1;
    }
    SetHandleInformation(ours, HANDLE_FLAG_INHERIT, 0);
    how.cb = sizeof how;
    how.dwFlags = STARTF_USESTDHANDLES;
    how.hStdInput = theirs;
    how.hStdOutput = GetStdHandle(STD_OUTPUT_HANDLE);
    how.hStdError = GetStdHandle(STD_ERROR_HANDLE);
    if (CreateProcessW(NULL, wide, NULL, NULL, TRUE, 0, NULL, NULL, &how, &started))
        CloseHandle(started.hThread);
    guard_child = c->process = started.hProcess;
    CloseHandle(theirs);
    free(wide);
    file = _open_osfhandle((intptr_t)ours, 0);
    c->input = file < 0 ? NULL : _fdopen(file, "wb");
    return c->input == NULL;
}

static inline int child_end(child *c)
{
    DWORD status = CHILD_MISSING;
    const int lost = fclose(c->input);
    if (!c->process) return CHILD_MISSING;
    WaitForSingleObject(c->process, INFINITE);
    guard_child = NULL;
    GetExitCodeProcess(c->process, &status);
    CloseHandle(c->process);
    if (lost && !status) return CHILD_CRASHED;
    return status < 256 ? (int)status : CHILD_CRASHED;
}
#else
typedef struct child {
    FILE *input;
    pid_t process;
} child;

static inline int child_start(child *c, const char *const *words)
{
    int ends[2];
    signal(SIGPIPE, SIG_IGN); /* the program may end early: writing fails then */
    c->process = pipe(ends) ? -1 : fork();
    if (c->process < 0) return 1;
    if (c->process == 0) {
        close(ends[1]);
        dup2(ends[0], STDIN_FILENO);
        execvp(*words, (char **)(uintptr_t)words);
        _exit(CHILD_MISSING);
    }
    guard_child = c->process;
    close(ends[0]);
    c->input = fdopen(ends[1], "wb");
    return c->input == NULL;
}

static inline int child_end(child *c)
{
    int status = 0;
    const int lost = fclose(c->input);
    while (waitpid(c->process, &status, 0) < 0 && errno == EINTR) continue;
    guard_child = 0;
    if (lost && !status) return CHILD_CRASHED;
    return WIFEXITED(status) ? WEXITSTATUS(status) : CHILD_CRASHED;
}
#endif

/* ---- the film -------------------------------------------------------------------------------- */

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
