/* save.h - writes the finished picture to standard output, or to a file that appears whole or not
   at all. */
#ifndef THUMBNAIL_SAVE_H
#define THUMBNAIL_SAVE_H

#include "../../shared/canvas.h"
#include "../model/guard.h"
#include "options.h"
#include <errno.h>

#ifdef MODEL_STB
#define STB_IMAGE_WRITE_IMPLEMENTATION
#include <stb/stb_image_write.h>

typedef struct png_sink {
    FILE *file;
    int failed;
} png_sink;

static void png_write(void *user, void *bytes, int size)
{
    png_sink *s = (png_sink *)user;
    if (fwrite(bytes, 1, (size_t)size, s->file) != (size_t)size) s->failed = 1;
}
#endif

static int ppm_write(void *user, const void *bytes, size_t size)
{
    return fwrite(bytes, 1, size, (FILE *)user) != size;
}

/* Writes what data says: 0, or 1 with the reason in errno, which is 0 where memory ran out. */
typedef int save_writer(FILE *file, const void *data);

/* The data of write_picture */
typedef struct picture_file {
    const shade_target *picture;
    const options *options;
} picture_file;

static int write_picture(FILE *file, const void *data)
{
    const shade_target *picture = ((const picture_file *)data)->picture;
    const options *o = ((const picture_file *)data)->options;
    errno = 0;
    if (!o->png) return shade_encode_ppm(ppm_write, file, picture) != SHADE_OK;
#ifdef MODEL_STB
    {
        int channels = o->picture.background == PORTRAIT_NONE ? 4 : 3, failed;
        png_sink sink = { file, 0 };
        uint8_t *bytes = portrait_bytes(picture, channels);
        if (!bytes) return 1;
        failed = !stbi_write_png_to_func(png_write, &sink, picture->width, picture->height,
                                         channels, bytes, picture->width * channels);
        free(bytes);
        return failed || sink.failed;
    }
#else
    return 1;
#endif
}

static int save_failed(const char *name)
{
    return complain("%s: %s", name, errno ? strerror(errno) : "out of memory");
}

/* Writes to standard output, or to something that is no plain file and that a rename would
   replace. */
static int save_directly(FILE *file, const char *name, save_writer *writes, const void *data)
{
    int failed = !file || writes(file, data);
    if (file && (file == stdout ? fflush(file) : fclose(file))) failed = 1;
    return failed ? save_failed(name) : 0;
}

#ifdef GUARD_POSIX
/* Creates a new file beside path, with the usual permissions. */
static FILE *open_part(const char *path)
{
    FILE *file = NULL;
    for (int k = 0; !file && k < 100; k++) {
        int n = snprintf(guard_part, sizeof guard_part, "%s.%ld-%d.part", path, (long)getpid(), k);
        int at = -1;
        errno = ENAMETOOLONG;
        if (n < (int)sizeof guard_part) at = open(guard_part, O_WRONLY | O_CREAT | O_EXCL, 0666);
        if (at >= 0)
            file = fdopen(at, "wb");
        else if (errno != EEXIST)
            break;
    }
    if (!file) guard_part[0] = 0;
    return file;
}

static int save_file(const char *path, save_writer *writes, const void *data)
{
    struct stat there;
    FILE *file;
    int failed;
    if (!stat(path, &there) && S_ISDIR(there.st_mode)) {
        errno = EISDIR;
        return save_failed(path);
    }
    if (!stat(path, &there) && !S_ISREG(there.st_mode))
        return save_directly(fopen(path, "wb"), path, writes, data);
    file = open_part(path);
    if (!file) return save_failed(path);
    failed = writes(file, data);
    if (fclose(file)) failed = 1;
    if (failed || rename(guard_part, path)) {
        failed = save_failed(path);
        remove(guard_part);
    }
    guard_part[0] = 0;
    return failed;
}
#else
static int save_file(const char *path, save_writer *writes, const void *data)
{
    int failed = save_directly(fopen(path, "wb"), path, writes, data);
    if (failed) remove(path);
    return failed;
}
#endif

static int save_bytes(const char *path, save_writer *writes, const void *data)
{
    if (!strcmp(path, "-")) return save_directly(stdout, "standard output", writes, data);
    return save_file(path, writes, data);
}

static int save(const shade_target *picture, const options *o)
{
    const picture_file f = { picture, o };
    guard_doing = "writing the picture";
    return save_bytes(o->output, write_picture, &f);
}
#endif
