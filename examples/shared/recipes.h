/* recipes.h - the lighting of four courses.  examples/README.md shows and explains it under
   "Reading your course"; tests/unit/recipes.c compares each with the equations of its notes. */
#ifndef SHARED_RECIPES_H
#define SHARED_RECIPES_H

#include "shade.h"

/* UW, iteration four: the default.  I_La of a lamp is its .ambient, I_L its .diffuse, .specular. */
static inline shade_lighting uw(const shade_light *lamps, int count)
{
    shade_lighting l = { .lights = lamps, .light_count = count };
    return l;
}

/* Massey: k_a I_a + k_d (l.n) I_d + k_s (r.v)^alpha I_s, with one I_a and no B */
static inline shade_lighting massey(const shade_light *lamps, int count, shade_vec3 I_a)
{
    shade_lighting l = { .lights = lamps, .light_count = count, .ambient = I_a };
    l.model = SHADE_MODEL_PHONG;
    l.flags = SHADE_FLAG_UNGATED_SPECULAR;
    return l;
}

/* Shirley (10.9): c_r (c_a + c_l max(0, n.l)) + c_l c_p (h.n)^p, c_l the lamp's colour */
static inline shade_lighting shirley(const shade_light *lamp, shade_vec3 c_a)
{
    shade_lighting l = { .lights = lamp, .light_count = 1, .ambient = c_a };
    l.flags = SHADE_FLAG_UNGATED_SPECULAR;
    return l;
}

static inline shade_material shirley_surface(shade_vec3 c_r, shade_vec3 c_p, float p)
{
    shade_material m = { .ambient = c_r, .diffuse = c_r, .specular = c_p, .shininess = p };
    return m;
}

/* Berkeley: the sum over lights of k_a I + k_d I max(l.n, 0) + k_s I max(r.v, 0)^p */
static inline shade_lighting berkeley(shade_light *lamps, int count)
{
    shade_lighting l = { .lights = lamps, .light_count = count };
    l.model = SHADE_MODEL_PHONG;
    l.flags = SHADE_FLAG_UNGATED_SPECULAR;
    for (int j = 0; j < count; j++) lamps[j].ambient = lamps[j].specular = lamps[j].diffuse;
    return l;
}
#endif
