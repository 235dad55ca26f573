/* mark.h - a number that stands for all that a picture of a model shows: FNV-1a over words in place
   of bytes, the same in either order of bytes.

       uint64_t mark = mark_of_model(&m);                       (as it is drawn, after scene_load)
       mark = mark_words(mark, numbers, 4);                              (and of ints or floats) */
#ifndef BATCH_MARK_H
#define BATCH_MARK_H

#include "../../kit/read/model.h"

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
