/* faces.h - collects the polygons of a file, each with its surface, and at the end cuts them into
   triangles, sorted by surface into the parts of a model. */
#ifndef MODEL_FACES_H
#define MODEL_FACES_H

#include "ears.h"
#include "known.h"

typedef struct faces {
    mesh_uints stream;      /* for each face the number of its corners, then the corners */
    mesh_uints change;      /* pairs: a place in the stream, the surface from there on */
    mesh_uints object;      /* pairs: a place in the stream, the object from there on */
    size_t open, triangles; /* open: the place of the last face's count */
    size_t dropped;         /* faces with a corner that is not finite */
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

/* A face is begun, gets its corners, and is ended.  These functions return non-zero where memory or
   numbers run out. */
static inline int faces_begin(faces *f)
{
    f->open = f->stream.count;
    return f->open > UINT32_MAX / 2 || mesh_push_uint(&f->stream, 0);
}

static inline int faces_corner(faces *f, uint32_t corner)
{
    return f->stream.count > UINT32_MAX / 2 || mesh_push_uint(&f->stream, corner);
}

/* Stores the number of corners of the face; a face of fewer than three is dropped. */
static inline size_t faces_end(faces *f)
{
    size_t corners = f->stream.count - f->open - 1;
    f->stream.v[f->open] = (uint32_t)corners;
    if (corners < 3)
        f->stream.count = f->open;
    else
        f->triangles += corners - 2;
    return corners;
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
    for (size_t at = 0; at < f->stream.count && !failed; at += f->stream.v[at] + (size_t)1) {
        size_t corners = f->stream.v[at], indices = 3 * (corners - 2);
        while (change < f->change.count && f->change.v[change] <= at) {
            surface = f->change.v[change + 1];
            change += 2;
        }
        while (objects < f->object.count && f->object.v[objects] <= at) {
            number = f->object.v[objects + 1];
            objects += 2;
        }
        if (!faces_finite(positions, f->stream.v + at + 1, corners)) {
            f->dropped += !out;
            continue;
        }
        for (size_t i = 0; object && i < corners - 2; i++) object[first[surface] / 3 + i] = number;
        if (out)
            failed =
                ears_cut(&scratch, positions, f->stream.v + at + 1, corners, out + first[surface]);
        first[surface] += indices;
    }
    ears_free(&scratch);
    return failed;
}

/* The triangles into mesh.indices and parts, one for each surface that has any.  The positions
   of so many vertices must stand, the corners below their number.  Faces that have a corner which
   is not finite are left out, with a warning; such positions become 0.  Non-zero: a message of the
   reader says why not. */
static inline int faces_finish(mesh_reader *r, faces *f, model *m, size_t vertices)
{
    size_t surfaces = m->surface_count ? (size_t)m->surface_count : 1, sum = 0;
    size_t *first = (size_t *)calloc(surfaces, sizeof *first);
    int failed = 1;
    if (mesh_stopped(r)) goto done;
    m->part = (model_part *)calloc(surfaces, sizeof *m->part);
    m->mesh.indices = (uint32_t *)malloc(3 * f->triangles * sizeof(uint32_t));
    if (f->object.count) m->object = (uint32_t *)malloc(f->triangles * sizeof(uint32_t));
    if (!first || !m->part || !m->mesh.indices || (f->object.count && !m->object)) {
        mesh_fail(r, "out of memory");
        goto done;
    }
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
    if (!f->triangles)
        mesh_fail(r, "no face of it has corners that are all finite");
    else if (faces_walk(f, m->mesh.positions, first, m->mesh.indices, m->object))
        mesh_fail(r, "out of memory");
    else
        failed = 0;
    model_warn_dropped(m, r->name, f->dropped, "faces have corners");
    mesh_tame(&m->mesh, vertices);
done:
    free(first);
    return failed;
}
#endif
