/* prepare.h - makes a model ready to be drawn: hard edges where faces meet at an angle, chunks. */
#ifndef MODEL_PREPARE_H
#define MODEL_PREPARE_H

#include "../read/files.h"
#include "stand.h"

/* The sum of the squares of how many corners meet at each position: what corner normals cost.
   0: out of memory */
static double crease_cost(const owned_mesh *m)
{
    static const mesh_set empty;
    mesh_set places = empty;
    size_t vertices = (size_t)m->view.vertex_count;
    uint32_t *place = (uint32_t *)calloc(2 * vertices + 1, sizeof *place);
    double cost = 0;
    int failed = !place;
    if (!failed) failed = mesh_set_positions(&places, m->positions, vertices, place);
    if (!failed) {
        uint32_t *count = place + vertices;
        for (int i = 0; i < m->view.index_count; i++) count[place[m->indices[i]]]++;
        for (size_t i = 0; i < places.count; i++) cost += (double)count[i] * (double)count[i];
    }
    free(place);
    mesh_set_free(&places);
    return failed ? 0 : cost;
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

/* Normals for a model that has none: rounded where the cosine between faces is larger than least,
   sharp elsewhere; of each face with flat.  A mesh where that would take long stays round all over.
   Non-zero: out of memory. */
static int mesh_crease_at(owned_mesh *m, int flat, float least)
{
    size_t n = (size_t)m->view.index_count, bytes = shade_mesh_corner_normals_bytes(&m->view);
    double cost = flat ? 0 : crease_cost(m);
    void *memory = NULL;
    shade_vec3 *normal;
    int failed = 1;
    if (!flat && !(cost > 0)) return 1;
    if (cost > 20.0 * (double)n + 1e6) return 0;
    normal = (shade_vec3 *)malloc((n + 1) * sizeof *normal);
    if (!flat) memory = malloc(bytes);
    if (normal && (memory || flat)) failed = 0;
    if (!failed && !flat)
        failed = shade_mesh_corner_normals(&m->view, least, normal, memory, bytes) != SHADE_OK;
    free(memory);
    if (!failed) failed = mesh_unshare(m);
    for (size_t i = 0; i < n && !failed && flat; i++) {
        shade_vec3 p[3];
        memcpy(p, m->positions + 9 * (i / 3), sizeof p);
        normal[i] = shade_face_normal(p[0], p[1], p[2]);
    }
    for (size_t i = 0; i < n && !failed; i++) /* corners of faces without area keep their normals */
        if (shade_dot(normal[i], normal[i]) > 0) memcpy(m->normals + 3 * i, &normal[i], 12);
    free(normal);
    return failed;
}

/* ---- creases of large meshes ----------------------------------------------------------------- */

/* Most vertices of a large mesh have no crease: all faces there lean less from the vertex's normal
   than half the angle of a crease, so that the normal serves all.  The corners of the others are
   given vertices of their own.  2 million triangles of a torus take 0.3 s instead of 2.7, and keep
   1 million vertices instead of 6. */
typedef struct crease_part {
    char *creased;     /* by vertex */
    owned_mesh around; /* the triangles with such a vertex; positions and indices alone */
    uint32_t *at;      /* where their indices stand in the whole mesh */
    size_t corners;    /* that get a vertex of their own */
} crease_part;

/* Finds the vertices with creases.  Non-zero: out of memory */
static int crease_find(crease_part *c, const owned_mesh *m, float least)
{
    const float lean = sqrtf((1 + fmaxf(least, 0)) / 2);
    const int n = m->view.index_count;
    int count = 0;
    c->creased = (char *)calloc((size_t)m->view.vertex_count + 1, 1);
    c->around.indices = (uint32_t *)malloc(((size_t)n + 1) * sizeof(uint32_t));
    c->at = (uint32_t *)malloc(((size_t)n + 1) * sizeof(uint32_t));
    if (!c->creased || !c->around.indices || !c->at) return 1;
    for (int i = 0; i < n; i++) {
        const uint32_t *corner = m->indices + i - i % 3;
        shade_vec3 p[3], face, normal;
        if (i % 3) continue;
        for (int k = 0; k < 3; k++) memcpy(&p[k], m->positions + 3 * (size_t)corner[k], 12);
        face = shade_face_normal(p[0], p[1], p[2]);
        if (!(shade_dot(face, face) > 0)) continue;
        for (int k = 0; k < 3; k++) {
            memcpy(&normal, m->normals + 3 * (size_t)corner[k], 12);
            if (shade_dot(face, shade_normalize(normal)) < lean) c->creased[corner[k]] = 1;
        }
    }
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

static int crease_large(owned_mesh *m, float least)
{
    static const crease_part empty;
    crease_part c = empty;
    shade_vec3 *normal = NULL;
    void *memory = NULL;
    int failed = crease_find(&c, m, least);
    const size_t n = (size_t)c.around.view.index_count;
    const size_t bytes = shade_mesh_corner_normals_bytes(&c.around.view);
    double cost = failed || !n ? 0 : crease_cost(&c.around);
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
    free(c.creased);
    free(c.around.indices);
    free(c.at);
    return failed;
}

/* The same, rounded where faces meet at less than 40 degrees */
static int mesh_crease(owned_mesh *m, int flat)
{
    const int large = m->view.index_count / 3 > MESH_LARGE;
    return large && !flat ? crease_large(m, 0.766f) : mesh_crease_at(m, flat, 0.766f);
}

/* Spreads 10 bits: two zeros stand between each two. */
static uint32_t chunk_spread(float x)
{
    uint32_t v = (uint32_t)fminf(1023, fmaxf(0, (x + 3) * (1024 / 6.0f)));
    v = (v | v << 16) & 0x030000FFu;
    v = (v | v << 8) & 0x0300F00Fu;
    v = (v | v << 4) & 0x030C30C3u;
    return (v | v << 2) & 0x09249249u;
}

/* A triangle and its place on Morton's curve, which visits each eighth of a cube before the next */
typedef struct chunk_place {
    uint32_t place, corner[3];
} chunk_place;

/* Sorts the triangles of a mesh within the unit ball along that curve, 10 bits at a time, as
   shade_mesh_chunks would sort them in eight times the time: 2 million in 0.1 s.  Returns 1 where
   memory is out. */
static int chunk_sort(const shade_mesh *m, uint32_t *sorted)
{
    const size_t n = (size_t)m->index_count / 3;
    chunk_place *list = (chunk_place *)calloc(2 * (n + 1), sizeof *list), *from = list, *to;
    to = list ? list + n : NULL;
    for (size_t i = 0; list && i < n; i++) {
        shade_vec3 sum = shade_v3(0, 0, 0), p;
        for (int k = 0; k < 3; k++) {
            from[i].corner[k] = m->indices[3 * i + (size_t)k]; /* NOLINT: parts have indices */
            memcpy(&p, m->positions + 3 * (size_t)from[i].corner[k], sizeof p);
            sum = shade_add(sum, p);
        }
        from[i].place = chunk_spread(sum.x) | chunk_spread(sum.y) << 1 | chunk_spread(sum.z) << 2;
    }
    for (int shift = 0; list && shift < 30; shift += 10) {
        chunk_place *other = from;
        size_t first[1025] = { 0 };
        for (size_t i = 0; i < n; i++) first[1 + (from[i].place >> shift & 1023)]++;
        for (int k = 0; k < 1024; k++) first[k + 1] += first[k];
        for (size_t i = 0; i < n; i++) to[first[from[i].place >> shift & 1023]++] = from[i];
        from = to;
        to = other;
    }
    for (size_t i = 0; list && i < n; i++)
        memcpy(sorted + 3 * i, from[i].corner, sizeof from->corner);
    free(list);
    return !list;
}

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
        const int large = m->part[i].count / 3 > MESH_LARGE;
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
