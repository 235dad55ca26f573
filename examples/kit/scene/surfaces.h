/* surfaces.h - what a part of a model is drawn with: the one rule of programs and packages. */
#ifndef MODEL_SURFACES_H
#define MODEL_SURFACES_H

#include "../read/model.h"

/* own: the surface in the file, or NULL: nothing of it counts.  colored: the colours of vertices
   and faces multiply k_d, where there are any. */
typedef struct surface_choice {
    const model_surface *own;
    shade_material material;
    int colored;
} surface_choice;

/* The surface of that number.  usual is the material of models that have none; where it was asked
   for, it takes the place of all that the file says: materials, pictures, colours of vertices and
   faces.  The cut of a section has no colours but its own material's.  A file that brings colours
   and no material has k_d and k_a 1: its colours are those of the surface, not factors of
   another. */
static inline surface_choice surface_choose(const model *m, int surface,
                                            const shade_material *usual, int asked)
{
    const model_surface *s = m->surface_count ? &m->surface[surface] : NULL;
    surface_choice c = { .own = s && s->set && (!asked || s->section) ? s : NULL };
    c.material = c.own ? s->material : *usual;
    c.colored = m->mesh.colors && (c.own || !asked) && !(s && s->section);
    if (c.colored && !c.own) c.material.diffuse = c.material.ambient = shade_v3(1, 1, 1);
    return c;
}
#endif
