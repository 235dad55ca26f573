/* look.h - what light does not show: the normals of a mesh, its depth, its edges. */
#ifndef PLAYGROUND_LOOK_H
#define PLAYGROUND_LOOK_H

/* ---- normals as red, green, blue; depth as grey, near is bright */

typedef struct look {
    const shade_mesh *mesh;
    shade_mat4 model, clip_from_world;
    shade_mat3 normals;
    float near_z, far_z;
    int depth;
} look;

static inline void look_vertex(const void *uniforms, const shade_vertex_ids *SHADE_RESTRICT in,
                               shade_vertices *SHADE_RESTRICT out)
{
    const look *l = (const look *)uniforms;
    SHADE_EACH_LANE(i) {
        const float *p = l->mesh->positions + 3 * in->index[i];
        const float *n = l->mesh->normals + 3 * in->index[i];
        shade_vec4 P = shade_mat4_transform(l->model, shade_v4(p[0], p[1], p[2], 1));
        shade_vec4 clip = shade_mat4_transform(l->clip_from_world, P);
        shade_vec3 N = shade_mat3_transform(l->normals, shade_v3(n[0], n[1], n[2]));
        N = shade_normalize(N);
        out->clip[0][i] = clip.x;
        out->clip[1][i] = clip.y;
        out->clip[2][i] = clip.z;
        out->clip[3][i] = clip.w;
        out->varying[0][i] = N.x;
        out->varying[1][i] = N.y;
        out->varying[2][i] = N.z;
        out->varying[3][i] = clip.w;                     /* the distance from the eye, along -z */
    }
}

static inline void look_fragment(const void *uniforms, const shade_fragments *SHADE_RESTRICT in,
                                 shade_colors *SHADE_RESTRICT out)
{
    const look *l = (const look *)uniforms;
    SHADE_EACH_LANE(i) {
        shade_vec3 N = shade_v3(in->varying[0][i], in->varying[1][i], in->varying[2][i]);
        float grey = (l->far_z - in->varying[3][i]) / (l->far_z - l->near_z);
        shade_vec3 c = shade_scale(shade_add(shade_normalize(N), shade_v3(1, 1, 1)), 0.5f);
        grey *= grey * (3 - 2 * grey);                   /* more contrast in the middle */
        if (l->depth) c = shade_v3(grey, grey, grey);
        /* squared, since the target encodes for the screen */
        out->color[0][i] = c.x * c.x;
        out->color[1][i] = c.y * c.y;
        out->color[2][i] = c.z * c.z;
    }
}

static inline void look_draw(const shade_target *target, const shade_mesh *mesh,
                             const shade_draw_state *state, float near_z, float far_z, int depth)
{
    look l = { mesh, state->model, shade_mat4_mul(state->projection, state->view),
               shade_normal_matrix(state->model), near_z, far_z, depth };
    shade_pipeline p = { .vertex = look_vertex, .fragment = look_fragment, .uniforms = &l,
                         .varyings = 4 };
    shade_draw(target, &p, mesh->indices, mesh->index_count, mesh->vertex_count, NULL);
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
