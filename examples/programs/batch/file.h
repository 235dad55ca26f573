/* file.h - tells which pieces are there, and how long the rest will take.  POSIX or Windows. */
#ifndef BATCH_FILE_H
#define BATCH_FILE_H

#include "../../kit/command/clock.h"
#include "../../kit/command/save.h"

#ifdef GUARD_WINDOWS
#include <direct.h>

/* Makes a folder.  Non-zero: errno tells why it could not. */
static inline int batch_folder(const char *path)
{
    wchar_t *name = path_wide(path);
    int failed = !name || _wmkdir(name);
    free(name);
    return failed;
}

/* Bytes of an open file, -1 where it has no size */
static inline long long batch_size(FILE *file) { return _filelengthi64(_fileno(file)); }
static inline int batch_is_terminal(FILE *file) { return _isatty(_fileno(file)); }
#else
static inline int batch_folder(const char *path)
{
    return mkdir(path, 0777); /* NOLINT: never NULL */
}
static inline long long batch_size(FILE *file)
{
    struct stat about;
    return file && !fstat(fileno(file), &about) ? (long long)about.st_size : -1;
}
static inline int batch_is_terminal(FILE *file) { return isatty(fileno(file)); }
#endif

/* 1: there is a file of this size that begins with this header. */
static inline int batch_is_whole(const char *path, const char *header, long long bytes)
{
    char begin[64];
    size_t n = strlen(header);
    FILE *file = path_open(path, "rb");
    int whole = file && batch_size(file) == bytes && fread(begin, 1, n, file) == n &&
                !memcmp(begin, header, n);
    if (file) fclose(file);
    return whole;
}

/* ---- progress: a line that rewrites itself, where somebody sees it --------------------------- */

typedef struct batch_clock {
    const char *unit;
    double begin, told;
    int seen; /* stderr is a terminal */
} batch_clock;

static inline batch_clock batch_start(const char *unit)
{
    batch_clock c = { unit, clock_now(), 0, batch_is_terminal(stderr) };
    return c;
}

/* Prints the time left.  worked counts only pieces that this run has drawn; the estimate is made
   from them. */
static inline void batch_tell(batch_clock *c, int done, int of, int worked)
{
    double now = clock_now();
    long left = worked ? (long)((now - c->begin) / worked * (of - done) + 0.5) : 0;
    if (!c->seen || (now - c->told < 0.2 && done < of)) return;
    c->told = now;
    fprintf(stderr, "\r%d of %d %s, %d %%, ", done, of, c->unit, (int)(100LL * done / of));
    if (done == of)
        fprintf(stderr, "%.1f s       \n", now - c->begin);
    else
        fprintf(stderr, "%ld:%02ld:%02ld left ", left / 3600, left / 60 % 60, left % 60);
}
#endif
