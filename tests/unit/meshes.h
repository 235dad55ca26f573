/* meshes.h - the least that a mesh, a state and a light are made of, as most tests of meshes start
   from them. */
#ifndef MESHES_H
#define MESHES_H

static const float big_triangle[] = { -0.9f, -0.9f, 0, 0.9f, -0.8f, 0, 0, 0.9f, 0 };

static inline void put3(float *at, shade_vec3 v)
{
    at[0] = v.x;
    at[1] = v.y;
    at[2] = v.z;
}

static inline shade_vec3 grey(double v) { return shade_v3((float)v, (float)v, (float)v); }

/* Positions one after the other, three to a triangle. */
static inline shade_mesh plain_mesh(const float *positions, int vertices)
{
    shade_mesh m = { .positions = positions, .vertex_count = vertices };
    return m;
}

/* All defaults, and one light or none. */
static inline shade_draw_state plain_state(const shade_light *light)
{
    shade_draw_state s = { .lighting.lights = light, .lighting.light_count = light ? 1 : 0 };
    return s;
}

/* Draws a mesh that is good. */
static inline shade_stats canvas_draw_mesh(canvas *c, const shade_mesh *m,
                                           const shade_draw_state *s)
{
    shade_stats stats;
    memset(&stats, CANVAS_BYTE, sizeof stats);
    CHECK_INT(shade_draw_mesh(&c->target, m, s, &stats), SHADE_OK);
    CHECK_INT(stats.culled + stats.clipped + stats.rejected + stats.drawn, stats.triangles);
    return stats;
}

#endif
