/* faces.h - collects the polygons of a file, each with its surface, and at the end cuts them into
   triangles, sorted by surface into the parts of a model. */
#ifndef MODEL_FACES_H
#define MODEL_FACES_H

#include "ears.h"
#include "known.h"

typedef struct faces {
    mesh_uints stream;      /* corners of triangles, or where mixed is set for each face the number
                               of its corners, then the corners */
    int mixed;              /* some face has more than three */
    mesh_uints change;      /* pairs: a place in the stream, the surface from there on */
    mesh_uints object;      /* pairs: a place in the stream, the object from there on */
    size_t open, triangles; /* open: the place of the last face */
    size_t dropped;         /* faces with a corner that is not finite */
    int finite;             /* all positions are */
} faces;

static inline void faces_free(faces *f)
{
    free(f->stream.v);
    free(f->change.v);
    free(f->object.v);
}

static inline int faces_surface(faces *f, int surface)
{
    return mesh_push_uint(&f->change, (uint32_t)f->stream.count) ||
           mesh_push_uint(&f->change, (uint32_t)surface);
}

static inline int faces_object(faces *f, int object)
{
    return mesh_push_uint(&f->object, (uint32_t)f->stream.count) ||
           mesh_push_uint(&f->object, (uint32_t)object);
}

/* Puts the number of its corners before each face, also before the one that is open. */
static inline int faces_mix(faces *f, size_t corners)
{
    const size_t whole = f->open / 3;
    for (size_t i = 0; i <= whole; i++)
        if (mesh_push_uint(&f->stream, 0)) return 1;
    memmove(f->stream.v + 4 * whole + 1, f->stream.v + 3 * whole, corners * sizeof *f->stream.v);
    for (size_t i = whole; i-- > 0;) {
        memmove(f->stream.v + 4 * i + 1, f->stream.v + 3 * i, 3 * sizeof *f->stream.v);
        f->stream.v[4 * i] = 3;
    }
    for (size_t i = 0; i < f->change.count; i += 2) f->change.v[i] += f->change.v[i] / 3;
    for (size_t i = 0; i < f->object.count; i += 2) f->object.v[i] += f->object.v[i] / 3;
    f->open = 4 * whole;
    f->mixed = 1;
    return 0;
}

/* A face is begun, gets its corners, and is ended.  These functions return non-zero where memory or
   numbers run out. */
static inline int faces_begin(faces *f)
{
    f->open = f->stream.count;
    return f->open > UINT32_MAX / 2 || (f->mixed && mesh_push_uint(&f->stream, 0));
}

static inline int faces_corner(faces *f, uint32_t corner)
{
    return f->stream.count > UINT32_MAX / 2 || mesh_push_uint(&f->stream, corner);
}

/* A face of fewer than three corners is dropped. */
static inline int faces_end(faces *f)
{
    const size_t corners = f->stream.count - f->open - (f->mixed ? 1 : 0);
    if (corners < 3) {
        f->stream.count = f->open;
        return 0;
    }
    f->triangles += corners - 2;
    if (corners > 3 && !f->mixed && faces_mix(f, corners)) return 1;
    if (f->mixed) f->stream.v[f->open] = (uint32_t)corners;
    return 0;
}

/* All of a triangle */
static inline int faces_triangle(faces *f, uint32_t a, uint32_t b, uint32_t c)
{
    return faces_begin(f) || faces_corner(f, a) || faces_corner(f, b) || faces_corner(f, c) ||
           faces_end(f);
}

/* The corners of the face at a place of the stream, which moves behind it */
static inline uint32_t *faces_next(const faces *f, size_t *at, size_t *corners)
{
    uint32_t *corner = f->stream.v + *at + (f->mixed ? 1 : 0);
    *corners = f->mixed ? f->stream.v[*at] : 3;
    *at = (size_t)(corner - f->stream.v) + *corners;
    return corner;
}

/* 1: each corner of a face has a finite position. */
static inline int faces_finite(const float *positions, const uint32_t *corner, size_t n)
{
    for (size_t i = 0; i < n; i++)
        if (!mesh_finite(positions + 3 * (size_t)corner[i])) return 0;
    return 1;
}

/* Counts the indices of each surface where out is NULL; otherwise writes the indices of each
   surface from its place in first on, and the object of each triangle where object is not NULL. */
static inline int faces_walk(faces *f, const float *positions, size_t *first, uint32_t *out,
                             uint32_t *object)
{
    static const ears empty;
    ears scratch = empty;
    size_t change = 0, surface = 0, objects = 0;
    uint32_t number = 0;
    int failed = 0;
    for (size_t at = 0; at < f->stream.count && !failed;) {
        const size_t place = at;
        size_t corners, indices;
        const uint32_t *corner = faces_next(f, &at, &corners);
        indices = 3 * (corners - 2);
        while (change < f->change.count && f->change.v[change] <= place) {
            surface = f->change.v[change + 1];
            change += 2;
        }
        while (objects < f->object.count && f->object.v[objects] <= place) {
            number = f->object.v[objects + 1];
            objects += 2;
        }
        if (!f->finite && !faces_finite(positions, corner, corners)) {
            f->dropped += !out;
            continue;
        }
        for (size_t i = 0; object && i < corners - 2; i++) object[first[surface] / 3 + i] = number;
        if (out) failed = ears_cut(&scratch, positions, corner, corners, out + first[surface]);
        first[surface] += indices;
    }
    ears_free(&scratch);
    return failed;
}

/* Triangles of one surface stand in the stream as they stay. */
static inline int faces_take(faces *f, model *m)
{
    const size_t n = f->stream.count;
    uint32_t *indices = (uint32_t *)realloc(f->stream.v, (n + 1) * sizeof *indices);
    if (!indices) return 1;
    f->stream.v = NULL;
    m->mesh.indices = indices;
    for (size_t i = 0; i < f->object.count; i += 2) {
        const size_t end = i + 2 < f->object.count ? f->object.v[i + 2] : n;
        for (size_t k = f->object.v[i] / 3; k < end / 3; k++) m->object[k] = f->object.v[i + 1];
    }
    for (size_t k = 0; f->object.count && k < f->object.v[0] / 3; k++) m->object[k] = 0;
    m->part->count = (int)n;
    m->part_count = 1;
    return 0;
}

/* Sorts the triangles by surface. */
static inline int faces_sort(mesh_reader *r, faces *f, model *m, size_t surfaces, size_t *first)
{
    size_t sum = 0;
    m->mesh.indices = (uint32_t *)malloc(3 * f->triangles * sizeof(uint32_t));
    if (!m->mesh.indices) return mesh_fail(r, "out of memory");
    faces_walk(f, m->mesh.positions, first, NULL, NULL);
    for (size_t s = 0; s < surfaces; s++) {
        size_t count = first[s];
        const model_part part = { (int)sum, (int)count, (int)s, 0, 0 };
        if (count) m->part[m->part_count++] = part;
        first[s] = sum;
        sum += count;
    }
    f->triangles = sum / 3;
    r->line = f->triangles ? r->line : 0;
    if (!f->triangles) return mesh_fail(r, "no face of it has corners that are all finite");
    if (faces_walk(f, m->mesh.positions, first, m->mesh.indices, m->object))
        return mesh_fail(r, "out of memory");
    return 0;
}

/* The triangles into mesh.indices and parts, one for each surface that has any.  The positions
   of so many vertices must stand, the corners below their number.  Faces that have a corner which
   is not finite are left out, with a warning; such positions become 0.  Non-zero: a message of the
   reader says why not. */
static inline int faces_finish(mesh_reader *r, faces *f, model *m, size_t vertices)
{
    const size_t surfaces = m->surface_count ? (size_t)m->surface_count : 1;
    size_t *first;
    int failed = 1;
    if (mesh_stopped(r)) return 1;
    first = (size_t *)calloc(surfaces, sizeof *first);
    m->part = (model_part *)calloc(surfaces, sizeof *m->part);
    if (f->object.count) m->object = (uint32_t *)malloc(f->triangles * sizeof(uint32_t));
    f->finite = 1;
    for (size_t i = 0; i < 3 * vertices; i++) f->finite &= fabsf(m->mesh.positions[i]) <= FLT_MAX;
    if (!first || !m->part || (f->object.count && !m->object))
        mesh_fail(r, "out of memory");
    else if (!f->mixed && f->finite && surfaces == 1)
        failed = faces_take(f, m) && mesh_fail(r, "out of memory");
    else
        failed = faces_sort(r, f, m, surfaces, first);
    model_warn_dropped(m, r->name, f->dropped, "faces have corners");
    if (!f->finite) mesh_tame(&m->mesh, vertices);
    free(first);
    return failed;
}
#endif
