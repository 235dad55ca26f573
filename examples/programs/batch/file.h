/* file.h - tells which pieces are there, whose they are, and how long the rest will take.  POSIX
   or Windows. */
#ifndef BATCH_FILE_H
#define BATCH_FILE_H

#include "../../kit/command/clock.h"
#include "../../kit/command/save.h"
#include "../../kit/read/model.h"

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

/* ---- a number that stands for all that a picture of a model shows: FNV-1a over words in place
   of bytes, the same in either order of bytes.

       uint64_t mark = mark_of_model(&m);                       (as it is drawn, after scene_load)
       mark = mark_words(mark, numbers, 4);                              (and of ints or floats) */

/* Words may be NULL. */
static inline uint64_t mark_words(uint64_t mark, const void *words, size_t count)
{
    uint32_t word;
    for (size_t i = 0; words && i < count; i++) {
        memcpy(&word, (const char *)words + 4 * i, 4);
        mark = (mark ^ word) * 0x100000001B3u;
        mark ^= mark >> 32; /* the upper bits of a word reach the lower ones of the mark */
    }
    return (mark ^ count) * 0x100000001B3u;
}

static inline uint64_t mark_texture(uint64_t mark, const shade_texture *t)
{
    const unsigned char *bytes = (const unsigned char *)t->pixels;
    const size_t size = bytes ? 4 * (size_t)t->width * (size_t)t->height : 0;
    const int form[] = { t->width, t->height, (int)t->wrap_u, (int)t->wrap_v };
    for (size_t i = 0; i < size; i++) mark = (mark ^ bytes[i]) * 0x100000001B3u;
    return mark_words(mark, form, sizeof form / sizeof *form);
}

static inline uint64_t mark_of_model(const model *m)
{
    const shade_mesh *v = &m->mesh.view;
    const size_t vertices = (size_t)v->vertex_count;
    uint64_t mark = mark_words(0xCBF29CE484222325u, v->positions, 3 * vertices);
    mark = mark_words(mark, v->normals, 3 * vertices);
    mark = mark_words(mark, v->texcoords, 2 * vertices);
    mark = mark_words(mark, v->colors, 3 * vertices);
    mark = mark_words(mark, v->indices, (size_t)v->index_count);
    for (int i = 0; i < m->part_count; i++) mark = mark_words(mark, m->part + i, 3);
    for (int i = 0; i < m->surface_count; i++) {
        const model_surface *s = &m->surface[i];
        const float numbers[] = { s->transparency,    s->alpha_cutoff, s->metal,   s->rough,
                                  s->move[0],         s->move[1],      s->move[2], s->move[3],
                                  s->relief.strength, s->glow.x,       s->glow.y,  s->glow.z };
        const int words[] = { s->set,     s->section,      s->opaque,        s->blended,
                              s->picture, s->glow_picture, s->relief.picture };
        mark = mark_words(mark, &s->material, sizeof s->material / 4);
        mark = mark_words(mark, numbers, sizeof numbers / 4);
        mark = mark_words(mark, words, sizeof words / 4);
    }
    for (int i = 0; i < m->picture_count; i++) mark = mark_texture(mark, &m->picture[i].map);
    return mark;
}
#endif
