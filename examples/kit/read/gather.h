/* gather.h - gathers vertices and faces of many meshes in one model. */
#ifndef MODEL_GATHER_H
#define MODEL_GATHER_H

#include "faces.h"
#include "points.h"

/* ---- where things are ------------------------------------------------------------------------ */

typedef struct gather_matrix {
    double at[16];
} gather_matrix; /* columns, as in the files */

static inline gather_matrix gather_product(const gather_matrix *a, const gather_matrix *b)
{
    gather_matrix m;
    for (int c = 0; c < 4; c++) {
        for (int k = 0; k < 4; k++) {
            double sum = 0;
            for (int i = 0; i < 4; i++) sum += a->at[4 * i + k] * b->at[4 * c + i];
            m.at[4 * c + k] = sum;
        }
    }
    return m;
}

static inline double gather_cofactor(const gather_matrix *m, int row, int column)
{
    const int r[2] = { (row + 1) % 3, (row + 2) % 3 },
              c[2] = { (column + 1) % 3, (column + 2) % 3 };
    return m->at[4 * c[0] + r[0]] * m->at[4 * c[1] + r[1]] -
           m->at[4 * c[1] + r[0]] * m->at[4 * c[0] + r[1]];
}

static inline double gather_determinant(const gather_matrix *m)
{
    return m->at[0] * gather_cofactor(m, 0, 0) + m->at[4] * gather_cofactor(m, 0, 1) +
           m->at[8] * gather_cofactor(m, 0, 2);
}

/* ---- what is gathered ------------------------------------------------------------------------ */

typedef struct gather {
    mesh_floats positions, normals, texcoords, colors;
    faces faces;
    mesh_origin origin;
    int textured, colored, lacks_normals; /* some vertex has a place in a picture, a colour; has no
                                             normal */
    int colors_kept, texcoords_kept;      /* from here on; those before are white, and at 0 */
} gather;

typedef struct gather_corner {
    double position[3];
    shade_vec3 normal, color; /* any length, zero: none; linear */
    shade_vec2 uv;
} gather_corner;

static inline int gather_finite(shade_vec3 v)
{
    return fabsf(v.x) <= 1e30f && fabsf(v.y) <= 1e30f && fabsf(v.z) <= 1e30f;
}

/* Fills a column with a value, up to count numbers. */
static inline int gather_fill(mesh_floats *column, size_t count, float value)
{
    while (column->count < count)
        if (mesh_push(column, &value, 1)) return 1;
    return 0;
}

/* Adds a vertex.  Faces around a position that is not finite are dropped at the end. */
static inline int gather_vertex(mesh_reader *r, gather *g, const gather_corner *v)
{
    const size_t before = g->positions.count / 3;
    const shade_vec3 n = v->normal;
    const int bare = n.x == 0 && n.y == 0 && n.z == 0;
    float place[3], uv[2] = { 0, 0 };
    shade_vec3 N = bare ? n : shade_normalize(n);
    if (before % MESH_TELL == 0 && mesh_stopped(r)) return 1;
    mesh_relative(&g->origin, v->position, place);
    for (int k = 0; k < 3; k++)
        if (!(fabsf(place[k]) <= 1e30f)) place[k] = NAN;
    if (!gather_finite(N)) N = shade_v3(0, 0, 0);
    if (N.x == 0 && N.y == 0 && N.z == 0) g->lacks_normals = 1;
    if (fabsf(v->uv.x) < 1e6f && fabsf(v->uv.y) < 1e6f) memcpy(uv, &v->uv, sizeof uv);
    if (mesh_push(&g->positions, place, 3) || mesh_push(&g->normals, (const float *)&N, 3))
        return mesh_fail(r, "out of memory");
    if (g->colors_kept && (gather_fill(&g->colors, 3 * before, 1) ||
                           mesh_push(&g->colors, (const float *)&v->color, 3)))
        return mesh_fail(r, "out of memory");
    if (g->texcoords_kept &&
        (gather_fill(&g->texcoords, 2 * before, 0) || mesh_push(&g->texcoords, uv, 2)))
        return mesh_fail(r, "out of memory");
    return 0;
}

static inline void gather_free(gather *g)
{
    free(g->positions.v);
    free(g->normals.v);
    free(g->texcoords.v);
    free(g->colors.v);
    faces_free(&g->faces);
}

static inline float *gather_take(mesh_floats *from)
{
    float *v = from->v;
    from->v = NULL;
    return v;
}

/* Moves vertices that no face joins into a model, as points. */
static inline int gather_points(mesh_reader *r, gather *g, model *m)
{
    const size_t n = g->positions.count / 3;
    if (g->colored && gather_fill(&g->colors, 3 * n, 1)) return mesh_fail(r, "out of memory");
    m->mesh.positions = gather_take(&g->positions);
    if (g->colored) m->mesh.colors = gather_take(&g->colors);
    model_placed(m, &g->origin);
    return points_finish(r, m, n);
}

/* Moves all that was gathered into a model.  Returns non-zero with the error in r. */
static inline int gather_finish(mesh_reader *r, gather *g, model *m)
{
    owned_mesh *mesh = &m->mesh;
    const int vertices = (int)(g->positions.count / 3);
    if (!g->faces.triangles) return mesh_fail(r, "no faces in it");
    if ((g->colored && gather_fill(&g->colors, g->positions.count, 1)) ||
        (g->textured && gather_fill(&g->texcoords, 2 * (size_t)vertices, 0)))
        return mesh_fail(r, "out of memory");
    mesh->positions = gather_take(&g->positions);
    mesh->normals = gather_take(&g->normals);
    if (g->textured) mesh->texcoords = gather_take(&g->texcoords);
    if (g->colored) mesh->colors = gather_take(&g->colors);
    if (faces_finish(r, &g->faces, m, (size_t)vertices)) return 1;
    mesh_link(mesh, vertices, 3 * (int)g->faces.triangles);
    model_placed(m, &g->origin);
    m->normals_given = !g->lacks_normals;
    if (g->lacks_normals && mesh_fill_normals(mesh, 0)) return mesh_fail(r, "out of memory");
    return 0;
}
#endif
