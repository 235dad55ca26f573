/* file.h - writes files that appear whole or not at all, and tells how long the rest will take.
   POSIX. */
#ifndef BATCH_FILE_H
#define BATCH_FILE_H

#include "../model/clock.h"
#include "../model/options.h"
#include <errno.h>
#include <glob.h>
#include <signal.h>
#include <sys/stat.h>
#include <unistd.h>

/* ---- files ----------------------------------------------------------------------------------- */

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

/* The file being written, under a name that only this process uses; empty: none */
static char batch_part[4400];

static inline void batch_die(int number)
{
    if (*batch_part) unlink(batch_part);
    signal(number, SIG_DFL);
    raise(number);
}

/* The name of this machine, without what could end a part's name early */
static inline void batch_host(char *name, size_t room)
{
    if (gethostname(name, room)) *name = 0;
    name[room - 1] = 0;
    for (char *c = name; *c; c++)
        if (strchr(".*?[]/\\", *c)) *c = '-';
}

/* Removes the parts of path that killed jobs have left: those of this machine whose process is
   gone.  Other machines sweep theirs. */
static inline void batch_sweep(const char *path)
{
    char host[65], pattern[4400];
    glob_t found;
    if (strpbrk(path, "*?[\\")) return; /* the path itself would be a pattern */
    batch_host(host, sizeof host);
    snprintf(pattern, sizeof pattern, "%s.%s.*.part", path, host);
    if (glob(pattern, 0, NULL, &found)) return;
    for (size_t i = 0; i < found.gl_pathc; i++) {
        long process = strtol(found.gl_pathv[i] + strlen(path) + strlen(host) + 2, NULL, 10);
        if (process > 0 && kill((pid_t)process, 0) && errno == ESRCH) unlink(found.gl_pathv[i]);
    }
    globfree(&found);
}

/* Chooses the other name under which path is written; a signal that ends the program removes what
   has that name. */
static inline void batch_name(const char *path)
{
    static const int fatal[3] = { SIGHUP, SIGINT, SIGTERM };
    char host[65];
    batch_sweep(path);
    batch_host(host, sizeof host);
    for (int k = 0; k < 3; k++)
        if (signal(fatal[k], batch_die) == SIG_IGN) signal(fatal[k], SIG_IGN);
    snprintf(batch_part, sizeof batch_part, "%s.%s.%ld.part", path, host, (long)getpid());
}

/* Opens the file to write under another name.  Returns NULL with a line on stderr. */
static inline FILE *batch_begin(const char *path)
{
    FILE *file;
    batch_name(path);
    file = fopen(batch_part, "wb");
    if (!file) {
        complain("%s: %s", path, strerror(errno));
        *batch_part = 0;
    }
    return file;
}

/* Closes the file and gives it its name, or removes it.  Returns 1 with a line on stderr. */
static inline int batch_end(FILE *file, const char *path, int failed)
{
    int error = errno;
    if (fclose(file) && !failed) {
        error = errno;
        failed = 1;
    }
    if (!failed && rename(batch_part, path)) {
        error = errno;
        failed = 1;
    }
    if (failed) {
        complain("%s: %s", path, strerror(error));
        unlink(batch_part);
    }
    *batch_part = 0;
    return failed;
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
