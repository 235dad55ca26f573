/* look.h - what light does not show: the normals of a mesh, its depth, its edges. */
#ifndef PLAYGROUND_LOOK_H
#define PLAYGROUND_LOOK_H

/* ---- normals as red, green, blue; depth as grey, near is bright */

typedef struct look {
    shade_mat4 view;
    float near_z, far_z;
    int depth;
} look;

static inline void look_fragment(const void *uniforms, const shade_fragments *SHADE_RESTRICT in,
                                 shade_colors *SHADE_RESTRICT out)
{
    const look *l = (const look *)uniforms;
    const float(*P)[SHADE_LANES] = in->varying + SHADE_VARYING_POSITION;
    const float(*N)[SHADE_LANES] = in->varying + SHADE_VARYING_NORMAL;
    SHADE_EACH_LANE(i) {
        shade_vec3 n = shade_normalize(shade_v3(N[0][i], N[1][i], N[2][i]));
        shade_vec3 c = shade_scale(shade_add(n, shade_v3(1, 1, 1)), 0.5f);
        float away = -shade_mat4_transform(l->view, shade_v4(P[0][i], P[1][i], P[2][i], 1)).z;
        float grey = (l->far_z - away) / (l->far_z - l->near_z);
        grey *= grey * (3 - 2 * grey);                   /* more contrast in the middle */
        if (l->depth) c = shade_v3(grey, grey, grey);
        /* squared, since the target encodes for the screen */
        out->color[0][i] = c.x * c.x;
        out->color[1][i] = c.y * c.y;
        out->color[2][i] = c.z * c.z;
    }
}

/* A mesh that is shaded per face shows the normals of its faces. */
static inline void look_draw(const shade_target *target, const shade_mesh *mesh,
                             const shade_draw_state *state, float near_z, float far_z, int depth)
{
    const look l = { state->view, near_z, far_z, depth };
    shade_draw_state s = *state;
    shade_mesh m = *mesh;
    if (s.shading == SHADE_SHADING_PER_FACE) m.normals = NULL;
    s.shading = SHADE_SHADING_PER_FRAGMENT;
    s.fragment = look_fragment;
    s.uniforms = &l;
    shade_draw_mesh(target, &m, &s, NULL);
}

/* ---- each edge once, as a pair of points in memory to be freed; NULL where there is too little */

static inline shade_vec3 *wire_points(const shade_mesh *mesh, int *count)
{
    size_t room = (size_t)mesh->index_count;
    shade_edge *edge = room > SIZE_MAX / 32 ? NULL : (shade_edge *)malloc(room * sizeof *edge);
    shade_vec3 *points = NULL;
    int edges = 0;
    if (edge && shade_mesh_edges(mesh, edge, mesh->index_count, &edges) == SHADE_OK)
        points = (shade_vec3 *)malloc(2 * (size_t)edges * sizeof *points);
    for (int i = 0; points && i < edges; i++) {
        const float *a = mesh->positions + 3 * edge[i].a, *b = mesh->positions + 3 * edge[i].b;
        points[2 * i] = shade_v3(a[0], a[1], a[2]);
        points[2 * i + 1] = shade_v3(b[0], b[1], b[2]);
    }
    free(edge);
    *count = 2 * edges;
    return points;
}

static inline void wire_draw(const shade_target *target, const shade_vec3 *points, int count,
                             const shade_draw_state *state, float width, shade_vec3 ink)
{
    shade_line_state pen = { .width = width, .color = { ink.x, ink.y, ink.z, 0.4f },
                             .raster = { .depth_test = SHADE_COMPARE_LESS_EQUAL,
                                         .blend = SHADE_BLEND_OVER, .depth_read_only = 1,
                                         .depth_bias = -0.002f } };
    pen.clip_from_points =
        shade_mat4_mul(shade_mat4_mul(state->projection, state->view), state->model);
    shade_draw_lines(target, points, count, &pen, NULL);
}
#endif
