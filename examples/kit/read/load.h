/* load.h - loads whole files, regular ones alone, up to a size. */
#ifndef MODEL_LOAD_H
#define MODEL_LOAD_H

#include "../command/paths.h"
#include "reader.h"

#if defined(__unix__) || defined(__APPLE__)
#include <dirent.h>
#include <sys/stat.h>
/* 1: there is something that is no file: a pipe would let us wait, a device would not end. */
static inline int model_is_device(const char *path)
{
    struct stat there;
    return !stat(path, &there) && !S_ISREG(there.st_mode) && !S_ISDIR(there.st_mode);
}

/* 1: a file beside the model was not found, and the model's folder shows nothing else, as GNOME's
   sandbox of thumbnailers does. */
static inline int model_may_hide(const char *path)
{
    const char *slash = strrchr(path, '/');
    char folder[4096] = ".";
    int entries = 0;
    DIR *list;
    if (errno != ENOENT) return 0;
    if (slash) snprintf(folder, sizeof folder, "%.*s", (int)(slash - path) + 1, path);
    list = opendir(folder);
    while (list && entries < 4 && readdir(list)) entries++;
    if (list) closedir(list);
    return entries == 3; /* with . and .. */
}
#else
static inline int model_is_device(const char *path) { return (void)path, 0; }
static inline int model_may_hide(const char *path) { return (void)path, 0; }
#endif

/* Opens a file; NULL with the error in r */
static inline FILE *model_open_file(mesh_reader *r, const char *path)
{
    FILE *file = NULL;
    errno = 0;
    if (model_is_device(path))
        mesh_fail(r, "is no regular file");
    else if ((file = path_open(path, "rb")) == NULL)
        mesh_fail(r, "%s", errno ? strerror(errno) : "cannot be opened");
    return file;
}

/* Loads a whole file of at most so many bytes; the caller frees *bytes.  Returns non-zero with the
   error in r. */
static inline int model_load_from(mesh_reader *r, FILE *file, double most, unsigned char **bytes,
                                  size_t *size)
{
    size_t capacity = 0, got = 1;
    int failed = 0;
    *bytes = NULL;
    *size = 0;
    while (got && !failed) {
        unsigned char *grown = *bytes;
        if (*size == capacity) {
            capacity = capacity ? capacity <= SIZE_MAX / 2 ? capacity * 2 : 0 : 65536;
            grown = capacity ? (unsigned char *)realloc(*bytes, capacity) : NULL;
        }
        if (!grown) {
            failed = mesh_fail(r, "out of memory");
            break;
        }
        *bytes = grown;
        got = fread(*bytes + *size, 1, capacity - *size, file);
        *size += got;
        if ((double)*size > most) failed = mesh_fail(r, "larger than %.0f MB", most / 1e6);
    }
    if (!failed && ferror(file))
        failed = mesh_fail(r, "%s", errno ? strerror(errno) : "cannot be read");
    if (failed) {
        free(*bytes);
        *bytes = NULL;
    }
    return failed;
}

static inline int model_load(mesh_reader *r, const char *path, double most, unsigned char **bytes,
                             size_t *size)
{
    FILE *file = model_open_file(r, path);
    int failed = 1;
    *bytes = NULL;
    if (file) failed = model_load_from(r, file, most, bytes, size);
    if (file) fclose(file);
    return failed;
}
#endif
