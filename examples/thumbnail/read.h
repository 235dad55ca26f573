/* read.h - reads a model for thumbnail: OBJ, STL and PLY by its own readers, other formats by
   assimp, the pictures on surfaces by stb_image.  A message names a library that is missing. */
#ifndef THUMBNAIL_READ_H
#define THUMBNAIL_READ_H

#include "../model/pictures.h"
#ifdef THUMBNAIL_ASSIMP
#include "../model/assimp.h"
#endif

/* Whether the file can be opened and has anything in it; a folder opens, but cannot be read. */
static int check_file(const char *path, const model_request *q, unsigned char *head, size_t *size)
{
    mesh_reader r = { NULL, NULL, NULL, path, 0, q->error, q->error_size, NULL, NULL, 0 };
    FILE *file;
    int failed;
    errno = 0;
    file = fopen(path, "rb");
    if (!file) return mesh_fail(&r, "%s", errno ? strerror(errno) : "cannot be opened");
    *size = fread(head, 1, *size, file);
    failed = ferror(file) != 0;
    if (failed)
        mesh_fail(&r, "%s", errno ? strerror(errno) : "cannot be read");
    else if (!*size)
        failed = mesh_fail(&r, "the file is empty");
    fclose(file);
    return failed;
}

/* 1: the file is for our own readers, by its extension or, where it has none, by its contents. */
static int is_ours(model_kind kind, const unsigned char *head, size_t size)
{
    const char *const none = kind.text;
    if (!strcmp(none, "obj") || !strcmp(none, "stl") || !strcmp(none, "ply")) return 1;
    if (!strcmp(none, "")) return size < 4 || memcmp(head, "glTF", 4) != 0;
    return mesh_is_ply("", head, size);
}

static int read_other(const char *path, model_kind kind, model *m, const model_request *q)
{
    mesh_reader r = { NULL, NULL, NULL, path, 0, q->error, q->error_size, NULL, NULL, 0 };
#ifdef THUMBNAIL_ASSIMP
    char dotted[sizeof kind.text + 2];
    snprintf(dotted, sizeof dotted, ".%s", kind.text[0] ? kind.text : "glb");
    if (!kind.text[0] || aiIsExtensionSupported(dotted)) return assimp_read(path, m, q);
    return mesh_fail(&r, "neither thumbnail nor assimp reads %s files", dotted);
#else
    (void)m;
    return mesh_fail(&r,
                     "%s%s files need a thumbnail built with assimp (libassimp-dev); this one "
                     "reads OBJ, STL and PLY",
                     kind.text[0] ? "." : "glTF", kind.text);
#endif
}

/* A file that makes a surface wholly invisible mostly means the opposite. */
static void show_invisible(model *m)
{
    for (int i = 0; i < m->surface_count; i++)
        if (m->surface[i].transparency >= 1) m->surface[i].transparency = 0;
}

static int thumbnail_read(const char *path, model *m, const model_request *q)
{
    static const model empty;
    unsigned char head[1024] = { 0 };
    size_t size = sizeof head;
    model_kind kind = model_kind_of(path);
    int failed = check_file(path, q, head, &size);
    *m = empty;
    if (failed) return failed;
    if (is_ours(kind, head, size))
        failed = model_read_file(path, m, q);
    else
        failed = read_other(path, kind, m, q);
#ifdef THUMBNAIL_ASSIMP
    if (failed && !kind.text[0]) { /* no extension: assimp may know the contents */
        const model_request silent = { NULL, 0, NULL, NULL, q->most };
        failed = assimp_read(path, m, &silent);
    }
#endif
    if (!failed) {
        show_invisible(m);
        read_pictures(m, path);
    }
    return failed;
}
#endif
