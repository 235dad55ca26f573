/* edges.c - corners of triangles sorted by position or by edge, edges and normals of corners: any
   positions, any lists of few triangles; memory that ends with the last byte asked for. */
/* eva: -eva-slevel-function shade__sort_corners:40 */
#include "prove.h"

enum { TRIANGLES = 2, CORNERS = 3 * TRIANGLES, VERTICES = 6 };

static float position[3 * VERTICES];
static uint32_t list[CORNERS];
static shade_mesh mesh;

/* Every list that the checks let pass. */
static void any_mesh(int corners)
{
    any_floats(position, 3 * VERTICES);
    for (int k = 0; k < CORNERS; k++) list[k] = Frama_C_unsigned_int_interval(0, VERTICES - 1);
    mesh.positions = position;
    mesh.vertex_count = VERTICES;
    mesh.indices = list + (CORNERS - corners);
    mesh.index_count = corners;
}

static void prove_sort(int edges, uint32_t count)
{
    static uint32_t order[CORNERS], other[CORNERS];
    uint32_t *ends = order + (CORNERS - count);
    shade__sort_corners(&mesh, edges, count, ends, other + (CORNERS - count));
    for (uint32_t i = 0; i < count; i++) {
        /*@ assert 0 <= ends[i] < count; */
    }
}

static void prove_edges(int corners)
{
    static shade_edge edges[CORNERS];
    int count;
    memset(edges, 0, sizeof edges);    /* where Eva does not see that sorting writes every place */
    if (!shade_mesh_edges(&mesh, edges + (CORNERS - corners), corners, &count)) {
        /*@ assert 0 <= count <= corners; */
    }
}

static void prove_normals(int corners)
{
    static uint32_t memory[4 * CORNERS];
    static shade_vec3 normal[CORNERS];
    uint32_t *from = memory + 4 * (CORNERS - corners);
    shade_mesh_corner_normals(&mesh, any_float(), normal + (CORNERS - corners), from,
                              16 * (size_t)corners);
}

int main(void)
{
    for (int corners = 0; corners <= CORNERS; corners += 3) {
        any_mesh(corners);
        prove_sort(0, (uint32_t)corners);
        prove_sort(1, (uint32_t)corners);
        prove_edges(corners);
        prove_normals(corners);
    }
    return 0;
}
