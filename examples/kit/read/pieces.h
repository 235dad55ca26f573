/* pieces.h - the pieces of which a model consists: the objects that its file names where it names
   two or more, otherwise what its triangles connect.

   Triangles are connected where they share a corner's position.  A closed shell inside of another
   is a piece of its own, also where it is the wall of a cavity. */
#ifndef MODEL_PIECES_H
#define MODEL_PIECES_H

#include "model.h"

enum { PIECES_MOST = 65535 }; /* what lies beyond joins the last */

typedef struct piece {
    char name[64];
    int triangles;
    float low[3], high[3]; /* the box, in the units of the file, from the origin of the model */
} piece;

typedef struct pieces {
    piece *list;
    int *of_part; /* the piece of each part of the model */
    int count, by_objects;
    int section; /* 1: one of them is the cut of a section */
} pieces;

static inline void pieces_free(pieces *p)
{
    free(p->list);
    free(p->of_part);
}

/* ---- vertices of equal position ------------------------------------------------------------- */

/* The place of each vertex, numbered in order of arrival, and how many places there are; where at
   is not NULL, it becomes a vertex at each place.  NULL: out of memory */
static inline uint32_t *mesh_places(const owned_mesh *m, uint32_t **at, size_t *count)
{
    static const mesh_set empty;
    mesh_set set = empty;
    size_t n = (size_t)m->view.vertex_count;
    uint32_t *place = (uint32_t *)malloc((n + 1) * sizeof *place);
    int failed = !place;
    if (at) *at = (uint32_t *)malloc((n + 1) * sizeof **at);
    if (at && !*at) failed = 1;
    for (size_t i = 0; i < n && !failed; i++) {
        size_t before = set.count;
        failed = mesh_set_add(&set, mesh_position_key(m->positions + 3 * i), &place[i]);
        if (!failed && at && set.count > before) (*at)[place[i]] = (uint32_t)i;
    }
    *count = set.count;
    mesh_set_free(&set);
    if (!failed) return place;
    free(place);
    if (at) free(*at);
    return NULL;
}

/* ---- which piece a triangle belongs to ------------------------------------------------------ */

static inline uint32_t pieces_root(uint32_t *above, uint32_t i)
{
    for (; above[i] != i; i = above[i]) above[i] = above[above[i]];
    return i;
}

/* A number for each triangle, the same where they are connected; below *numbers.  NULL: out of
   memory */
static inline uint32_t *pieces_connected(const owned_mesh *m, size_t *numbers)
{
    uint32_t *place = mesh_places(m, NULL, numbers), *above;
    uint32_t *number = (uint32_t *)calloc((size_t)m->view.index_count / 3 + 1, sizeof *number);
    above = (uint32_t *)malloc((*numbers + 1) * sizeof *above);
    if (!place || !number || !above) {
        free(number);
        number = NULL;
        goto done;
    }
    for (size_t i = 0; i < *numbers; i++) above[i] = (uint32_t)i;
    for (int i = 0; i < m->view.index_count; i += 3) {
        uint32_t a = pieces_root(above, place[m->indices[i]]);
        for (int k = 1; k < 3; k++) {
            uint32_t b = pieces_root(above, place[m->indices[i + k]]);
            uint32_t least = a < b ? a : b;
            above[a] = above[b] = least;
            a = least;
        }
    }
    for (int i = 0; i < m->view.index_count; i += 3)
        number[i / 3] = pieces_root(above, place[m->indices[i]]);
done:
    free(above);
    free(place);
    return number;
}

/* How many objects have triangles */
static inline int pieces_objects(const model *m)
{
    char *seen = (char *)calloc((size_t)m->object_count + 1, 1);
    int count = 0;
    for (int i = 0; seen && m->object && i < m->mesh.view.index_count / 3; i++) {
        count += !seen[m->object[i]];
        seen[m->object[i]] = 1;
    }
    free(seen);
    return count;
}

typedef struct piece_rank {
    uint32_t number, triangles;
    int by_size;
} piece_rank;

/* Large pieces come first; objects stay in the order of the file. */
static inline int piece_order(const void *a, const void *b)
{
    const piece_rank *x = (const piece_rank *)a, *y = (const piece_rank *)b;
    if (x->by_size && x->triangles != y->triangles) return x->triangles < y->triangles ? 1 : -1;
    return x->number > y->number ? 1 : -1;
}

/* Turns the numbers of triangles, below numbers, into those of pieces.  Non-zero: out of memory */
static inline int pieces_rank(pieces *p, const model *m, uint32_t *number, size_t numbers)
{
    size_t n = (size_t)m->mesh.view.index_count / 3, ranks = 0;
    uint32_t *count = (uint32_t *)calloc(numbers + 1, sizeof *count);
    piece_rank *rank = NULL;
    for (size_t i = 0; count && i < n; i++) ranks += count[number[i]]++ == 0;
    if (count) rank = (piece_rank *)malloc((ranks + 1) * sizeof *rank);
    p->count = ranks > PIECES_MOST ? PIECES_MOST : (int)ranks;
    p->list = (piece *)calloc((size_t)p->count + 1, sizeof *p->list);
    if (!rank || !p->list) {
        free(count);
        free(rank);
        return 1;
    }
    for (size_t i = 0, k = 0; i < numbers; i++)
        if (count[i]) rank[k++] = (piece_rank){ (uint32_t)i, count[i], !p->by_objects };
    qsort(rank, ranks, sizeof *rank, piece_order);
    for (size_t k = 0; k < ranks; k++) {
        int at = k < PIECES_MOST ? (int)k : PIECES_MOST - 1;
        piece *one = &p->list[at];
        count[rank[k].number] = (uint32_t)at;
        one->triangles += (int)rank[k].triangles;
        snprintf(one->name, sizeof one->name, "%s",
                 p->by_objects ? m->object_name[rank[k].number] : "");
        if (!one->name[0]) snprintf(one->name, sizeof one->name, "part %d", at + 1);
    }
    for (size_t i = 0; i < n; i++) number[i] = count[number[i]];
    free(count);
    free(rank);
    return 0;
}

static inline void pieces_boxes(pieces *p, const owned_mesh *m, const uint32_t *number)
{
    for (int i = 0; i < p->count; i++)
        for (int k = 0; k < 3; k++) {
            p->list[i].low[k] = FLT_MAX;
            p->list[i].high[k] = -FLT_MAX;
        }
    for (int i = 0; i < m->view.index_count; i++) {
        piece *one = &p->list[number[i / 3]];
        for (int k = 0; k < 3; k++) {
            float v = m->positions[3 * (size_t)m->indices[i] + (size_t)k];
            one->low[k] = fminf(one->low[k], v);
            one->high[k] = fmaxf(one->high[k], v);
        }
    }
}

/* ---- the parts of the model ----------------------------------------------------------------- */

/* Sorts the triangles by piece; each part becomes those of one piece and one surface, as parts
   came sorted by surface.  Non-zero: out of memory */
static inline int pieces_sort(pieces *p, model *m, const uint32_t *number)
{
    size_t n = (size_t)m->mesh.view.index_count / 3, parts = 0, room = 0;
    size_t *first = (size_t *)calloc((size_t)p->count + 2, sizeof *first);
    uint32_t *sorted = (uint32_t *)malloc((3 * n + 1) * sizeof *sorted);
    int *surface = (int *)malloc((n + 1) * sizeof *surface);
    int failed = !first || !sorted || !surface;
    for (size_t i = 0; !failed && i < n; i++) first[number[i] + 1]++;
    for (int i = 0; !failed && i < p->count; i++) first[i + 1] += first[i];
    for (int i = 0; !failed && i < m->part_count; i++) {
        int end = (m->part[i].first + m->part[i].count) / 3;
        for (int t = m->part[i].first / 3; t < end; t++) {
            size_t to = first[number[t]]++;
            memcpy(sorted + 3 * to, m->mesh.indices + 3 * (size_t)t, 3 * sizeof *sorted);
            surface[to] = m->part[i].surface;
        }
    }
    free(m->part);
    m->part = NULL;
    m->part_count = 0;
    for (size_t i = 0, at = 0; !failed && i < n; i++) { /* first[k] is now where piece k ends */
        int begins = i == 0 || surface[i] != surface[i - 1];
        for (; i >= first[at]; at++) begins = 1;
        if (begins && parts == room) {
            size_t wanted = room;
            model_part *grown = (model_part *)mesh_grow(m->part, parts, &room, sizeof *grown);
            int *of = (int *)mesh_grow(p->of_part, parts, &wanted, sizeof *of);
            if (grown) m->part = grown;
            if (of) p->of_part = of;
            failed = !grown || !of;
        }
        if (failed) break;
        if (begins) {
            p->of_part[parts] = (int)at;
            m->part[parts++] = (model_part){ 3 * (int)i, 0, surface[i], 0, 0 };
        }
        m->part[parts - 1].count += 3;
    }
    m->part_count = (int)parts;
    free(first);
    free(surface);
    free(m->mesh.indices);
    m->mesh.view.indices = m->mesh.indices = sorted;
    return failed;
}

/* Makes the cut of a section, whose triangles are connected with nothing, one piece. */
static inline void pieces_section(const model *m, uint32_t *number, size_t *numbers)
{
    for (int i = 0; i < m->part_count; i++) {
        const model_part *part = &m->part[i];
        if (!model_is_section(m, i)) continue;
        for (int t = part->first / 3; t < (part->first + part->count) / 3; t++)
            number[t] = (uint32_t)*numbers;
    }
    ++*numbers;
}

/* Finds the pieces of a model as it was read, and sorts its triangles by them.  Non-zero: out of
   memory */
static inline int pieces_find(pieces *p, model *m)
{
    size_t numbers = (size_t)m->object_count;
    uint32_t *number = NULL;
    int failed;
    p->by_objects = pieces_objects(m) > 1;
    if (p->by_objects) {
        number = m->object;
        m->object = NULL;
    } else {
        number = pieces_connected(&m->mesh, &numbers);
        if (number) pieces_section(m, number, &numbers);
    }
    failed = !number || pieces_rank(p, m, number, numbers);
    if (!failed) pieces_boxes(p, &m->mesh, number);
    if (!failed) failed = pieces_sort(p, m, number);
    for (int i = 0; i < m->part_count && !failed; i++) {
        if (!model_is_section(m, i)) continue;
        p->section = 1;
        strcpy(p->list[p->of_part[i]].name, "section");
    }
    free(number);
    return failed;
}
#endif
