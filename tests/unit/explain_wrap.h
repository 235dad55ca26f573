/* explain_wrap.h - included before a program by explain.sh: each shade_draw_mesh is followed by
   shade_explain, with and without stats; what it says goes to stderr, and that it was called.
   Scenes of infinite light are left out: tests/unit/scene.c draws them for NaN in the picture. */
#ifndef EXPLAIN_WRAP_H
#define EXPLAIN_WRAP_H
#include "shade.h"
#include <float.h>
#include <stdio.h>

static inline shade_result explain_draw_mesh(const shade_target *target, const shade_mesh *mesh,
                                             const shade_draw_state *state, shade_stats *stats)
{
    static int called;
    shade_stats own, *known = stats ? stats : &own;
    const shade_result result = shade_draw_mesh(target, mesh, state, known);
    const shade_lighting *l = &state->lighting;
    if (l->light_count > 0 && l->lights[0].diffuse.z > FLT_MAX) return result;
    const char *with = shade_explain(target, mesh, state, known);
    const char *without = shade_explain(target, mesh, state, NULL);
    if (!called) fprintf(stderr, "a mesh is drawn\n");
    called = 1;
    if (*with) fprintf(stderr, "explain: %s\n", with);
    if (*without) fprintf(stderr, "explain, without stats: %s\n", without);
    return result;
}
#define shade_draw_mesh explain_draw_mesh
#endif
