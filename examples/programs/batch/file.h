/* file.h - tells which pieces are there, and how long the rest will take.  POSIX. */
#ifndef BATCH_FILE_H
#define BATCH_FILE_H

#include "../model/clock.h"
#include "../model/save.h"

/* 1: there is a file of this size that begins with this header. */
static inline int batch_is_whole(const char *path, const char *header, long long bytes)
{
    char begin[64];
    size_t n = strlen(header);
    struct stat about;
    FILE *file = fopen(path, "rb");
    int whole = file && !fstat(fileno(file), &about) && about.st_size == bytes &&
                fread(begin, 1, n, file) == n && !memcmp(begin, header, n);
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
    batch_clock c = { unit, clock_now(), 0, isatty(STDERR_FILENO) };
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
