/* files.h - reads model files: OBJ with MTL, STL and PLY as text or binary, OFF, glTF, GLB and
   3MF.

       owned_mesh m;  char error[300];
       if (mesh_read_file("bunny.obj", &m, error, sizeof error)) fprintf(stderr, "%s\n", error);

   reads the mesh alone; model_read_file reads a model (model.h) with its surfaces.  Where a file
   has no normals, they are means of the faces around a position, also across seams of texture.
   Polygons may be concave.

   Time is linear in the size of the file.  Whatever the bytes are, the result is a valid mesh or
   an error, for text "name:line: message".  Limits: MODEL_BYTES, 2^31 - 1 vertices and indices,
   and the memory. */
#ifndef MODEL_FILES_H
#define MODEL_FILES_H

#include "gltf.h"
#include "load.h"
#include "mtl.h"
#include "obj.h"
#include "off.h"
#include "ply.h"
#include "stl.h"
#include "threemf.h"

/* The extension of a file name in small letters; "" where it has none, or a long one */
typedef struct model_kind {
    char text[8];
} model_kind;
static inline model_kind model_kind_of(const char *name)
{
    model_kind kind = { "" };
    size_t n = strlen(name), dot = n;
    while (dot && name[dot - 1] != '.' && name[dot - 1] != '/') dot--;
    if (!dot || name[dot - 1] != '.' || n - dot >= sizeof kind.text) return kind;
    for (size_t i = dot; i < n; i++)
        kind.text[i - dot] = (char)(name[i] >= 'A' && name[i] <= 'Z' ? name[i] | 32 : name[i]);
    return kind;
}

/* 1: the file is STL, by its extension or, where that is none of ours, by its contents. */
static inline int mesh_is_stl(const char *name, const unsigned char *bytes, size_t size)
{
    model_kind kind = model_kind_of(name);
    if (!strcmp(kind.text, "obj") || !strcmp(kind.text, "ply")) return 0;
    if (!strcmp(kind.text, "stl") || !strcmp(kind.text, "ast")) return 1;
    return (size >= 5 && !memcmp(bytes, "solid", 5)) || stl_fits(bytes, size) ||
           stl_has_own(bytes, size);
}

static inline int mesh_is_ply(const char *name, const unsigned char *bytes, size_t size)
{
    model_kind kind = model_kind_of(name);
    if (!strcmp(kind.text, "obj") || !strcmp(kind.text, "stl")) return 0;
    if (!strcmp(kind.text, "ply")) return 1;
    return size >= 4 && (!memcmp(bytes, "ply\n", 4) || !memcmp(bytes, "ply\r", 4));
}

/* 1: the file begins with a byte order mark of UTF-16, and is no binary STL. */
static inline int mesh_is_utf16(const unsigned char *bytes, size_t size)
{
    return size > 1 && (bytes[0] ^ bytes[1]) == 1 && bytes[0] > 0xFD && !stl_fits(bytes, size);
}

/* 1: the file is OFF, by its extension or, where that is none of ours, by its contents. */
static inline int mesh_is_off(const char *name, const unsigned char *bytes, size_t size)
{
    const model_kind kind = model_kind_of(name);
    if (!strcmp(kind.text, "off")) return 1;
    return !kind.text[0] && off_begins(bytes, size < 4096 ? size : 4096);
}

/* 1: the file is glTF, by its first bytes, by its extension, or as JSON of a name that is none of
   ours. */
static inline int mesh_is_gltf(const char *name, const unsigned char *bytes, size_t size)
{
    const model_kind kind = model_kind_of(name);
    if (size >= 4 && !memcmp(bytes, "glTF", 4)) return 1;
    if (!strcmp(kind.text, "gltf") || !strcmp(kind.text, "glb")) return 1;
    return !kind.text[0] && gltf_is_text(bytes, bytes + size);
}

/* 1: the file is 3MF, by its extension or, where that is none of ours, by its contents. */
static inline int mesh_is_threemf(const char *name, const unsigned char *bytes, size_t size)
{
    const model_kind kind = model_kind_of(name);
    if (!strcmp(kind.text, "3mf")) return 1;
    return !kind.text[0] && size >= 4 && !memcmp(bytes, "PK\3\4", 4);
}

/* All names that are known; kind tells apart the lists of a format. */
static const struct {
    const char *format, *kind;
    const known_name *names;
} model_known[] = { { "obj", "statement", obj_known },
                    { "mtl", "statement", mtl_known },
                    { "stl", "word", stl_known },
                    { "off", "header", off_known },
                    { "ply", "element", ply_elements },
                    { "ply", "vertex", ply_of_vertex },
                    { "ply", "face", ply_of_face },
                    { "gltf", "extension", gltf_known },
                    { "gltf", "attribute", gltf_attributes },
                    { "3mf", "extension", threemf_extensions },
                    { "3mf", "element", threemf_elements },
                    { "3mf", "attribute", threemf_attributes },
                    { "3mf", "type", threemf_types } };

static inline int model_read_stl(mesh_reader *r, model *m, FILE *file)
{
    if (stl_read(r, m, file)) return 1;
    m->part = (model_part *)calloc(1, sizeof *m->part);
    if (!m->part) return mesh_fail(r, "out of memory");
    m->part->count = m->mesh.view.index_count;
    m->part_count = 1;
    m->z_up = 1;
    return 0;
}

/* Who asks: where errors and progress go (either may be missing), and how many triangles are too
   many (0: no limit) */
typedef struct model_request {
    char *error;
    size_t error_size;
    mesh_progress *progress;
    void *user;
    size_t most;
    int lines;                /* lines are drawn, and not left out */
    int outside;              /* pictures outside of the folder of the model are read, too */
    const volatile int *stop; /* as in mesh_reader */
} model_request;

static inline mesh_reader model_reader(const void *bytes, size_t size, const char *name,
                                       const model_request *q)
{
    mesh_reader r = mesh_of(bytes, size, name, q->error, q->error_size);
    r.line = 1;
    r.progress = q->progress;
    r.user = q->user;
    r.most = q->most;
    r.stop = q->stop;
    return r;
}

static inline int model_read_once(const void *bytes, size_t size, const char *name, model *m,
                                  const model_request *q)
{
    static const unsigned char nothing[1];
    const unsigned char *all = size ? (const unsigned char *)bytes : nothing;
    const unsigned char *begin = model_text_of(all, &size);
    mesh_reader r = model_reader(begin, size, name, q);
    int failed;
    if (!size)
        failed = mesh_fail(&r, "the file is empty");
    else if (mesh_is_utf16(begin, size))
        failed =
            mesh_fail(&r, "its text is UTF-16, which is not read: save OBJ and others as UTF-8");
    else if (mesh_is_threemf(name, begin, size))
        failed = threemf_read(&r, m);
    else if (mesh_is_gltf(name, begin, size))
        failed = gltf_read(&r, m);
    else if (mesh_is_off(name, begin, size))
        failed = off_read(&r, m);
    else if (mesh_is_ply(name, begin, size))
        failed = ply_read(&r, m);
    else if (mesh_is_stl(name, begin, size) ||
             (!model_kind_of(name).text[0] && stl_seems(begin, size)))
        failed = model_read_stl(&r, m, NULL);
    else
        failed = obj_read(&r, m);
    if (failed) model_free(m);
    if (!failed) model_warn_dropped(m, name, m->lines_dropped, "lines have ends");
    if (!failed && m->line_count && !m->mesh.view.index_count) /* l may have been meant as f */
        model_warn(m, name, "it has no faces: its lines are drawn");
    if (!failed) known_tell(m, name);
    return failed;
}

/* The middle of the triangles or points, where that is so far from the origin of the positions that
   floats do not keep their digits.  0: it is near. */
static inline int model_middle(const model *m, double middle[3])
{
    double low[3], high[3], extent = 0, away = 0;
    mesh_box(&m->mesh, low, high);
    for (int k = 0; k < 3; k++) {
        middle[k] = floor(m->origin[k] + (low[k] + high[k]) / 2);
        extent = fmax(extent, high[k] - low[k]);
        away = fmax(away, fabs(low[k] + high[k]) / 2);
    }
    return away > 64 * extent && away > 64;
}

/* From memory; name stands in messages and tells the format by its end.  0: m is filled, free it
   with model_free; else m is empty and error, if error_size > 0, holds one line.

   said has what the reader is told, and nothing else: path, beside, points_wanted, polish_wanted,
   lines_wanted.

   Text and doubles have more digits than floats.  Where the first position is far from all that the
   faces have, the file is read again about their middle. */
static inline int model_read_with(const void *bytes, size_t size, const char *name, model *m,
                                  const model_request *q, const model *said)
{
    model again = *said;
    int failed;
    *m = *said;
    failed = model_read_once(bytes, size, name, m, q);
    if (failed || !m->movable || !model_middle(m, again.origin)) return failed;
    again.placed = 1;
    model_free(m);
    *m = again;
    return model_read_once(bytes, size, name, m, q);
}

/* zlib, where the program is built with it */
#ifdef MODEL_ZLIB
#include <zlib.h>
static inline int model_inflate(const unsigned char *packed, size_t packed_size, unsigned char *out,
                                size_t size)
{
    z_stream s;
    int result;
    memset(&s, 0, sizeof s);
    if (packed_size > UINT_MAX || size > UINT_MAX || inflateInit2(&s, -15) != Z_OK) return 1;
    s.next_in = (z_const Bytef *)packed;
    s.avail_in = (uInt)packed_size;
    s.next_out = out;
    s.avail_out = (uInt)size;
    result = inflate(&s, Z_FINISH);
    inflateEnd(&s);
    return result != Z_STREAM_END || s.avail_out;
}
#else
static zip_inflate *const model_inflate = NULL;
#endif

static inline int model_read_memory(const void *bytes, size_t size, const char *name, model *m,
                                    const model_request *q)
{
    static const model empty;
    model said = empty;
    said.inflate = model_inflate;
    said.polish_wanted = 1;
    said.lines_wanted = q->lines;
    return model_read_with(bytes, size, name, m, q, &said);
}

static inline int model_load_file(const char *path, const char *name, double most,
                                  unsigned char **bytes, size_t *size, char **where, char *error,
                                  size_t room)
{
    mesh_reader r = mesh_about(name, error, room);
    *where = model_beside(path, name);
    if (!*where) return mesh_fail(&r, "out of memory");
    if (!model_load(&r, *where, most, bytes, size)) return 0;
    if (model_may_hide(path))
        mesh_fail(&r,
                  "No such file or directory: it may be hidden, for the folder shows the model "
                  "alone");
    return 1;
}

/* Appends copies of some vertices to an array of a mesh.  Returns non-zero where memory is out. */
static inline int model_copy(float **v, size_t width, size_t n, const uint32_t *from, size_t count)
{
    float *grown = *v ? (float *)realloc(*v, (n + count + 1) * width * sizeof **v) : NULL;
    if (!*v) return 0;
    if (!grown) return 1;
    for (size_t i = 0; i < count; i++)
        memcpy(grown + (n + i) * width, grown + from[i] * width, width * sizeof **v);
    *v = grown;
    return 0;
}

/* Gives a part vertices of its own, with the texture coordinates that its surface wants. */
static inline int model_move_part(model *m, const model_part *part, const float *move)
{
    owned_mesh *mesh = &m->mesh;
    const size_t n = (size_t)mesh->view.vertex_count;
    uint32_t *place = (uint32_t *)calloc(n + 1, sizeof *place);
    uint32_t *from = (uint32_t *)malloc(((size_t)part->count + 1) * sizeof *from);
    size_t count = 0;
    int failed = !place || !from || n + (size_t)part->count > INT_MAX;
    for (int i = part->first; i < part->first + part->count && !failed; i++) {
        uint32_t *index = &mesh->indices[i];
        if (!place[*index]) {
            from[count] = *index;
            place[*index] = (uint32_t)++count;
        }
        *index = (uint32_t)n + place[*index] - 1;
    }
    failed = failed || model_copy(&mesh->positions, 3, n, from, count) ||
             model_copy(&mesh->normals, 3, n, from, count) ||
             model_copy(&mesh->colors, 3, n, from, count) ||
             model_copy(&mesh->texcoords, 2, n, from, count);
    for (size_t i = n; i < n + count && !failed; i++) {
        float *uv = mesh->texcoords + 2 * i;
        uv[0] = mesh_or_zero((double)(move[2] * uv[0] + move[0]));
        uv[1] = mesh_or_zero((double)(1 - (move[3] * (1 - uv[1]) + move[1])));
    }
    if (!failed) mesh_link(mesh, (int)(n + count), mesh->view.index_count);
    free(place);
    free(from);
    return failed;
}

static inline int model_read_library(const char *path, const char *name, model *m, char *error,
                                     size_t room)
{
    unsigned char *bytes = NULL;
    char *where = NULL;
    size_t size = 0;
    const int failed =
        m->beside(path, name, MODEL_LIBRARY_BYTES, &bytes, &size, &where, error, room);
    if (!failed) {
        const unsigned char *begin = model_text_of(bytes, &size);
        mesh_reader r = mesh_of(begin, size, name, error, room);
        r.line = 1;
        if (mtl_read(&r, m)) model_leave_out(m, path, error);
    }
    free(bytes);
    free(where);
    return failed;
}

/* The part of a name behind its last slash: folders of other machines do not exist here. */
static inline const char *model_last(const char *name)
{
    const char *last = name;
    for (; *name; name++)
        if (*name == '/' || *name == '\\') last = name + 1;
    return last;
}

/* Warns of a surface that triangles have and no library describes. */
static inline void model_tell_missing(const char *path, model *m)
{
    for (int i = 0; i < m->part_count && m->library_count; i++) {
        const model_surface *s = m->surface_count ? &m->surface[m->part[i].surface] : NULL;
        char text[100];
        if (!s || s->set || !s->name[0]) continue;
        snprintf(text, sizeof text, "no library has its material %.50s", s->name);
        model_warn(m, path, text);
        return;
    }
}

/* Reads the files that describe the surfaces, by the model's beside.  What is missing there is a
   warning, not an error.  A line of names is the name of one file, or else of several. */
static inline void model_read_libraries(const char *path, model *m)
{
    const size_t before = strlen(m->warning);
    for (int i = 0; i < m->library_count; i++) {
        char error[300] = "out of memory", unheard[300] = "out of memory";
        char *name = m->library[i], *blank = strchr(name, ' ');
        const char *last = model_last(name);
        if (!model_read_library(path, name, m, error, sizeof error)) continue;
        if (last > name && !model_read_library(path, last, m, unheard, sizeof unheard)) continue;
        if (!blank) model_leave_out(m, path, error);
        while (blank) {
            *blank = 0;
            if (*name && model_read_library(path, name, m, error, sizeof error))
                model_leave_out(m, path, error);
            name = blank + 1;
            blank = strchr(name, ' ');
            if (!blank && *name && model_read_library(path, name, m, error, sizeof error))
                model_leave_out(m, path, error);
        }
    }
    if (strlen(m->warning) == before) model_tell_missing(path, m);
    for (int i = 0; i < m->part_count && m->surface_count && !m->mesh.texcoords && !m->physical;
         i++)
        if (m->surface[m->part[i].surface].map)
            model_leave_out(m, path, "a picture has no texture coordinates");
    known_tell(m, path);
    for (int i = 0; i < m->part_count && m->mesh.texcoords; i++) {
        const float *move = m->surface_count ? m->surface[m->part[i].surface].move : NULL;
        if (!move || (move[0] == 0 && move[1] == 0 && move[2] == 1 && move[3] == 1)) continue;
        if (model_move_part(m, &m->part[i], move)) model_leave_out(m, path, "out of memory");
    }
}

/* Opens binary STL that fits its count, whose head of 84 bytes is read; NULL: the file is something
   else, or cannot be opened.  Such a file is read in pieces: it can be twice as large as the mesh
   in it. */
static inline FILE *model_open_stl(const char *path, unsigned char *head, long *size)
{
    mesh_reader r = mesh_about(path, NULL, 0);
    size_t n = 84;
    FILE *file = strcmp(model_kind_of(path).text, "stl") ? NULL : model_open_file(&r, path);
    if (!file) return NULL;
    if (fread(head, 1, n, file) == n && !fseek(file, 0, SEEK_END) && (*size = ftell(file)) > 0 &&
        stl_fits(head, (size_t)*size) && (double)*size <= MODEL_BYTES &&
        !mesh_is_gltf(path, head, n) && model_text_of(head, &n) == head &&
        !fseek(file, 84, SEEK_SET))
        return file;
    fclose(file);
    return NULL;
}

static inline int model_read_file(const char *path, model *m, const model_request *q)
{
    static const model empty;
    mesh_reader r = mesh_about(path, q->error, q->error_size);
    unsigned char *bytes = NULL, head[84];
    size_t size = 0;
    long all = 0;
    model said = empty;
    FILE *file = model_open_stl(path, head, &all);
    int failed = !file && model_load(&r, path, MODEL_BYTES, &bytes, &size);
    *m = empty;
    said.path = path;
    said.beside = model_load_file;
    said.inflate = model_inflate;
    said.polish_wanted = 1;
    said.lines_wanted = q->lines;
    if (file) {
        *m = said;
        r = model_reader(head, sizeof head, path, q);
        r.all = (double)all;
        failed = model_read_stl(&r, m, file);
        if (failed) model_free(m);
        fclose(file);
    } else if (!failed)
        failed = model_read_with(bytes, size, path, m, q, &said);
    free(bytes);
    if (!failed) model_read_libraries(path, m);
    return failed;
}

/* ---- the mesh alone ------------------------------------------------------------------------- */

/* Takes the mesh out of a model and frees the rest. */
static inline int model_keep_mesh(int failed, model *from, owned_mesh *m)
{
    static const owned_mesh empty;
    *m = from->mesh;
    from->mesh = empty;
    model_free(from);
    return failed;
}

static inline int mesh_read_memory(const void *bytes, size_t size, const char *name, owned_mesh *m,
                                   char *error, size_t error_size)
{
    const model_request q = { .error = error, .error_size = error_size };
    model from;
    return model_keep_mesh(model_read_memory(bytes, size, name, &from, &q), &from, m);
}

static inline int mesh_read_file_progress(const char *path, owned_mesh *m, char *error,
                                          size_t error_size, mesh_progress *progress, void *user)
{
    const model_request q = {
        .error = error, .error_size = error_size, .progress = progress, .user = user
    };
    model from;
    return model_keep_mesh(model_read_file(path, &from, &q), &from, m);
}

static inline int mesh_read_file(const char *path, owned_mesh *m, char *error, size_t error_size)
{
    return mesh_read_file_progress(path, m, error, error_size, NULL, NULL);
}
#endif
