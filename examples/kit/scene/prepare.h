/* prepare.h - makes a model ready to be drawn: hard edges where faces meet at an angle, chunks. */
#ifndef MODEL_PREPARE_H
#define MODEL_PREPARE_H

#include "../read/files.h"
#include "stand.h"

/* Finds the number of each vertex's position, which the caller frees; NULL where all are apart.
   Non-zero: out of memory */
static int crease_places(const owned_mesh *m, uint32_t **place)
{
    static const mesh_set empty;
    const size_t n = (size_t)m->view.vertex_count;
    mesh_set places = empty;
    int failed;
    if (m->apart) return 0;
    *place = (uint32_t *)malloc((n + 1) * sizeof **place);
    failed = !*place || mesh_set_positions(&places, m->positions, n, *place);
    mesh_set_free(&places);
    return failed;
}

/* The sum of the squares of how many corners meet at each position: what corner normals cost.
   0: out of memory */
static double crease_cost(const owned_mesh *m, const uint32_t *place)
{
    uint32_t *count = (uint32_t *)calloc((size_t)m->view.vertex_count + 1, sizeof *count);
    double cost = 0;
    for (int i = 0; count && i < m->view.index_count; i++) {
        const uint32_t v = m->indices[i];
        count[place ? place[v] : v]++;
    }
    for (int i = 0; count && i < m->view.vertex_count; i++)
        cost += (double)count[i] * (double)count[i];
    free(count);
    return cost;
}

/* An array with the elements of another for each new vertex; frees the other. */
static float *crease_spread(float *v, size_t size, const uint32_t *of, size_t n)
{
    float *spread = v ? (float *)malloc(n * size * sizeof *v) : NULL;
    for (size_t i = 0; spread && i < n; i++)
        memcpy(spread + size * i, v + size * of[i], size * sizeof *v);
    free(v);
    return spread;
}

/* One vertex for each corner, so that each may have a normal of its own */
static int mesh_unshare(owned_mesh *m)
{
    int n = m->view.index_count;
    int lacks;
    m->positions = crease_spread(m->positions, 3, m->indices, (size_t)n);
    m->normals = crease_spread(m->normals, 3, m->indices, (size_t)n);
    lacks = !m->positions || !m->normals;
    if (m->texcoords) {
        m->texcoords = crease_spread(m->texcoords, 2, m->indices, (size_t)n);
        lacks |= !m->texcoords;
    }
    if (m->colors) {
        m->colors = crease_spread(m->colors, 3, m->indices, (size_t)n);
        lacks |= !m->colors;
    }
    for (int i = 0; i < n; i++) m->indices[i] = (uint32_t)i;
    mesh_link(m, n, n);
    return lacks;
}

/* Gives each face its own normal.  Non-zero: out of memory */
static int mesh_flatten(owned_mesh *m)
{
    if (mesh_unshare(m)) return 1;
    for (int i = 0; i < m->view.vertex_count; i++) {
        shade_vec3 p[3], n;
        memcpy(p, m->positions + 9 * (size_t)(i / 3), sizeof p);
        n = shade_face_normal(p[0], p[1], p[2]);
        if (shade_dot(n, n) > 0) memcpy(m->normals + 3 * (size_t)i, &n, sizeof n);
    }
    return 0;
}

/* ---- creases --------------------------------------------------------------------------------- */

/* Most vertices have no crease: all faces there lean less from the vertex's normal than half the
   angle of a crease, so that the normal serves all.  The corners of the others are given vertices
   of their own.  2 million triangles of a torus take 0.3 s instead of 2.7, and keep 1 million
   vertices instead of 6, which all draws profit by. */
typedef struct crease_part {
    uint32_t *place;   /* by vertex; NULL: they are apart, or count so while a mesh is large */
    char *creased;     /* by vertex */
    owned_mesh around; /* the triangles with such a vertex; positions and indices alone */
    uint32_t *at;      /* where their indices stand in the whole mesh */
    size_t corners;    /* that get a vertex of their own */
} crease_part;

/* The cross product of two edges of a triangle, and the square of its length: in double, which
   holds it for floats of any size, so that nothing needs a root */
static double crease_face(const owned_mesh *m, const uint32_t *corner, double *face)
{
    const float *a = m->positions + 3 * (size_t)corner[0];
    const float *b = m->positions + 3 * (size_t)corner[1];
    const float *c = m->positions + 3 * (size_t)corner[2];
    double u[3], v[3];
    for (int k = 0; k < 3; k++) {
        u[k] = (double)b[k] - (double)a[k];
        v[k] = (double)c[k] - (double)a[k];
    }
    for (int k = 0; k < 3; k++)
        face[k] = u[(k + 1) % 3] * v[(k + 2) % 3] - u[(k + 2) % 3] * v[(k + 1) % 3];
    return face[0] * face[0] + face[1] * face[1] + face[2] * face[2];
}

/* Finds the vertices with creases.  Non-zero: out of memory */
static int crease_find(crease_part *c, const owned_mesh *m, float least)
{
    const double square = (1 + fmax((double)least, 0)) / 2; /* of the cosine of half the angle */
    const int n = m->view.index_count;
    int count = 0;
    c->creased = (char *)calloc((size_t)m->view.vertex_count + 1, 1);
    c->around.indices = (uint32_t *)malloc(((size_t)n + 1) * sizeof(uint32_t));
    c->at = (uint32_t *)malloc(((size_t)n + 1) * sizeof(uint32_t));
    if (!c->creased || !c->around.indices || !c->at) return 1;
    for (int i = 0; i < n; i += 3) {
        const uint32_t *corner = m->indices + i;
        double face[3];
        const double area = crease_face(m, corner, face); /* its square, four times */
        if (!(area > 0)) continue;
        for (int k = 0; k < 3; k++) {
            const float *N = m->normals + 3 * (size_t)corner[k];
            const double x = (double)N[0], y = (double)N[1], z = (double)N[2];
            const double along = face[0] * x + face[1] * y + face[2] * z;
            if (along < 0 || along * along < square * area * (x * x + y * y + z * z))
                c->creased[c->place ? c->place[corner[k]] : corner[k]] = 1;
        }
    }
    for (int i = m->view.vertex_count; c->place && i-- > 0;) /* places are not above vertices */
        c->creased[i] = c->creased[c->place[i]];
    for (int i = 0; i < n; i++) {
        const uint32_t *corner = m->indices + i - i % 3;
        c->corners += c->creased[m->indices[i]] != 0;
        if (!c->creased[corner[0]] && !c->creased[corner[1]] && !c->creased[corner[2]]) continue;
        c->at[count] = (uint32_t)i;
        c->around.indices[count++] = m->indices[i];
    }
    c->around.positions = m->positions;
    mesh_link(&c->around, m->view.vertex_count, count);
    return 0;
}

/* Appends a copy of an element for each creased corner.  Non-zero: out of memory */
static int crease_append(float **v, size_t size, const owned_mesh *m, const crease_part *c)
{
    const size_t n = (size_t)m->view.vertex_count;
    float *grown = *v ? (float *)realloc(*v, (n + c->corners + 1) * size * sizeof *grown) : NULL;
    float *to = grown ? grown + n * size : NULL;
    if (!*v) return 0;
    if (!grown) return 1;
    *v = grown;
    for (int i = 0; i < c->around.view.index_count; i++) {
        const size_t from = c->around.indices[i];
        if (!c->creased[from]) continue;
        memcpy(to, grown + size * from, size * sizeof *to);
        to += size;
    }
    return 0;
}

/* Gives creased corners vertices with normals of their own.  Non-zero: out of memory */
static int crease_split(owned_mesh *m, crease_part *c, const shade_vec3 *normal)
{
    uint32_t next = (uint32_t)m->view.vertex_count;
    if (crease_append(&m->positions, 3, m, c) || crease_append(&m->normals, 3, m, c) ||
        crease_append(&m->texcoords, 2, m, c) || crease_append(&m->colors, 3, m, c))
        return 1;
    for (int i = 0; i < c->around.view.index_count; i++) {
        if (!c->creased[c->around.indices[i]]) continue;
        if (shade_dot(normal[i], normal[i]) > 0)
            memcpy(m->normals + 3 * (size_t)next, &normal[i], sizeof *normal);
        m->indices[c->at[i]] = next++;
    }
    mesh_link(m, (int)next, m->view.index_count);
    return 0;
}

/* Rounds what meets at less than an angle, of which least is the cosine.  A mesh where that would
   take long stays round all over.  Non-zero: out of memory */
static int crease_round(owned_mesh *m, float least)
{
    static const crease_part empty;
    crease_part c = empty;
    shade_vec3 *normal = NULL;
    void *memory = NULL;
    const int large = m->view.index_count / 3 > MESH_LARGE;
    int failed = (!large && crease_places(m, &c.place)) || crease_find(&c, m, least);
    const size_t n = (size_t)c.around.view.index_count;
    const size_t bytes = shade_mesh_corner_normals_bytes(&c.around.view);
    double cost = 0;
    if (!failed && n && !c.place) failed = crease_places(m, &c.place);
    if (!failed && n) cost = crease_cost(&c.around, c.place);
    if (!failed && n && cost <= 20.0 * (double)n + 1e6 &&
        c.corners + (size_t)m->view.vertex_count < INT_MAX) {
        normal = (shade_vec3 *)malloc(n * sizeof *normal);
        memory = malloc(bytes);
        failed = !(cost > 0) || !normal || !memory ||
                 shade_mesh_corner_normals(&c.around.view, least, normal, memory, bytes) ||
                 crease_split(m, &c, normal);
    }
    free(memory);
    free(normal);
    free(c.place);
    free(c.creased);
    free(c.around.indices);
    free(c.at);
    return failed;
}

/* Normals for a model that has none: rounded where faces meet at less than an angle, of which least
   is the cosine, sharp elsewhere; of each face with flat.  Non-zero: out of memory */
#define CREASE_40_DEGREES 0.766f
static int mesh_crease(owned_mesh *m, int flat, float least)
{
    return flat ? mesh_flatten(m) : crease_round(m, least);
}

/* 8 bits of a sum of three coordinates, -3 .. 3: two zeros stand between each two. */
static uint32_t chunk_spread(float x)
{
    const float place = (x + 3) * (256 / 6.0f);
    uint32_t v = place > 0 ? place < 255 ? (uint32_t)place : 255 : 0;
    v = (v | v << 8) & 0x0000F00Fu;
    v = (v | v << 4) & 0x030C30C3u;
    return (v | v << 2) & 0x09249249u;
}

/* Sorts the triangles of a mesh within the unit ball along Morton's curve, which visits each eighth
   of a cube before the next, 12 bits at a time, as shade_mesh_chunks would sort them in eight times
   the time: 2 million in 0.1 s.  Returns 1 where memory is out. */
static int chunk_sort(const shade_mesh *m, uint32_t *sorted)
{
    const size_t n = (size_t)m->index_count / 3;
    uint32_t *list = (uint32_t *)malloc((n + 1) * 2 * sizeof *list); /* places and triangles */
    uint32_t *from = list, *to = sorted;
    for (size_t i = 0; list && i < n; i++) {
        shade_vec3 sum = shade_v3(0, 0, 0), p;
        for (int k = 0; k < 3; k++) {
            const size_t corner = m->indices[3 * i + (size_t)k]; /* NOLINT: parts have indices */
            memcpy(&p, m->positions + 3 * corner, sizeof p);
            sum = shade_add(sum, p);
        }
        list[2 * i] = chunk_spread(sum.x) | chunk_spread(sum.y) << 1 | chunk_spread(sum.z) << 2;
        list[2 * i + 1] = (uint32_t)i;
    }
    for (int shift = 0; list && shift < 24; shift += 12) { /* twice: they are in list again */
        uint32_t *other = from;
        size_t first[4097] = { 0 };
        for (size_t i = 0; i < n; i++) first[1 + (from[2 * i] >> shift & 4095)]++;
        for (int k = 0; k < 4096; k++) first[k + 1] += first[k];
        for (size_t i = 0; i < n; i++)
            memcpy(to + 2 * first[from[2 * i] >> shift & 4095]++, from + 2 * i, 2 * sizeof *to);
        from = to;
        to = other;
    }
    for (size_t i = 0; list && i < n; i++)
        memcpy(sorted + 3 * i, m->indices + 3 * (size_t)list[2 * i + 1], 3 * sizeof *sorted);
    free(list);
    return !list;
}

/* Parts of more triangles are sorted along the curve: 100,000 take .91 of a thumbnail's time. */
enum { CHUNK_SORT = 20000 };

/* Sorts the triangles of each part in space and finds the boxes around runs of them, by which
   bands skip what they do not see.  Non-zero: out of memory. */
static int mesh_chunk_parts(model *m)
{
    uint32_t *sorted = (uint32_t *)malloc(((size_t)m->mesh.view.index_count + 1) * sizeof *sorted);
    int count = 0, failed = 0;
    for (int i = 0; i < m->part_count; i++) {
        m->part[i].first_chunk = count;
        count += m->part[i].chunk_count = shade_chunk_count(m->part[i].count, 0);
    }
    m->mesh.chunks = (shade_chunk *)malloc(((size_t)count + 1) * sizeof *m->mesh.chunks);
    if (!sorted || !m->mesh.chunks) {
        free(sorted);
        return 1;
    }
    for (int i = 0; i < m->part_count; i++) {
        const int large = m->part[i].count / 3 > CHUNK_SORT;
        uint32_t *own = sorted + m->part[i].first;
        shade_mesh mesh = model_part_mesh(m, i);
        if (large) failed |= chunk_sort(&mesh, own);
        if (large) mesh.indices = own;
        if (failed) break;
        shade_mesh_chunks(&mesh, 0, m->mesh.chunks + m->part[i].first_chunk, m->part[i].chunk_count,
                          large ? NULL : own);
    }
    free(m->mesh.indices);
    m->mesh.view.indices = m->mesh.indices = sorted;
    return failed || mesh_renumber(&m->mesh);
}
#endif
