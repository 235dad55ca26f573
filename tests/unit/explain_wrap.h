/* explain_wrap.h - included before a program by explain.sh: each shade_draw_mesh, shade_draw_lines
   and shade_draw is followed by the function that explains it, with and without stats; what it says
   goes to stderr, and that a mesh was drawn.
   Scenes of infinite light are left out: tests/unit/scene.c draws them for NaN in the picture. */
#ifndef EXPLAIN_WRAP_H
#define EXPLAIN_WRAP_H
#include "shade.h"
#include <float.h>
#include <stdio.h>

static inline void explain_print(const char *with, const char *without)
{
    static int called;
    if (!called) fprintf(stderr, "a mesh is drawn\n");
    called = 1;
    if (*with) fprintf(stderr, "explain: %s\n", with);
    if (*without) fprintf(stderr, "explain, without stats: %s\n", without);
}

static inline shade_result explain_draw_mesh(const shade_target *target, const shade_mesh *mesh,
                                             const shade_draw_state *state, shade_stats *stats)
{
    shade_stats own, *known = stats ? stats : &own;
    const shade_result result = shade_draw_mesh(target, mesh, state, known);
    const shade_lighting *l = &state->lighting;
    if (l->light_count > 0 && l->lights[0].diffuse.z > FLT_MAX) return result;
    const char *with = shade_explain(target, mesh, state, known);
    const char *without = shade_explain(target, mesh, state, NULL);
    explain_print(with, without);
    return result;
}

static inline shade_result explain_draw_lines(const shade_target *target, const shade_vec3 *points,
                                              int point_count, const shade_line_state *state,
                                              shade_stats *stats)
{
    shade_stats own, *known = stats ? stats : &own;
    const shade_result result = shade_draw_lines(target, points, point_count, state, known);
    if (!point_count) return result; /* a list that is empty on purpose */
    explain_print(shade_explain_lines(target, points, point_count, state, known),
                  shade_explain_lines(target, points, point_count, state, NULL));
    return result;
}

static inline shade_result explain_draw(const shade_target *target, const shade_pipeline *pipeline,
                                        const uint32_t *indices, int index_count, int vertex_count,
                                        shade_stats *stats)
{
    shade_stats own, *known = stats ? stats : &own;
    const shade_result result = shade_draw(target, pipeline, indices, index_count, vertex_count,
                                           known);
    explain_print(shade_explain_draw(target, pipeline, indices, index_count, vertex_count, known),
                  shade_explain_draw(target, pipeline, indices, index_count, vertex_count, NULL));
    return result;
}
#define shade_draw_mesh explain_draw_mesh
#define shade_draw_lines explain_draw_lines
#define shade_draw explain_draw
#endif
