/* meshes.c - chunks, edges and corner normals of meshes; lines.
   Each part is a driver of prove.sh. */

#ifdef PROVE_chunks
/* Boxes of any bits before any planes; planes of any matrix and any good target; lists
   of chunks drawn and triangles parted by any key. */
/* eva: -eva-slevel-function shade__next_chunk:60 */
#define SHADE_LANES 16
#include "prove.h"

enum { TRIANGLES = 8 };

static shade__frustum frustum;
static shade_target target;
static shade__supply supply;
static shade__draw d;
static shade_chunk chunk[4];
static shade_mesh mesh;
static float position[9 * TRIANGLES];
static uint32_t list[3 * TRIANGLES];

static shade_vec3 any_vector(void) { return shade_v3(any_float(), any_float(), any_float()); }

static void prove_view(void)
{
    shade_mat4 m;
    any_floats((float *)&m, 16);
    target.width = ANY_OF(1, 16384);
    target.height = ANY_OF(1, 16384);
    target.clip_x = ANY_OF(INT32_MIN, INT32_MAX);
    target.clip_y = ANY_OF(INT32_MIN, INT32_MAX);
    target.clip_width = ANY_OF(0, INT32_MAX);
    target.clip_height = ANY_OF(0, INT32_MAX);
    target.row_offset = ANY_OF(0, 16383);
    target.row_count = ANY_OF(0, 16384);
    shade__frustum_of(&target, &m, ANY_OF(0, 1), &frustum);
    shade__in_view(&frustum, any_vector(), any_vector());
}

static void prove_next(void)
{
    supply.chunks = 4;
    supply.chunk = chunk;
    supply.frustum = &frustum;
    d.supply = &supply;
    d.stats.triangles = ANY_OF(0, INT32_MAX);
    d.stats.skipped = ANY_OF(0, INT32_MAX);
    for (int i = 0; i < 4; i++) {
        chunk[i].low = any_vector();
        chunk[i].high = any_vector();
        chunk[i].first = ANY_OF(0, INT32_MAX / 6);
        chunk[i].count = ANY_OF(0, INT32_MAX / 6);
    }
    shade__next_chunk(&d);
    /*@ assert 0 <= supply.chunks <= 3; */
}

static void prove_make(void)
{
    shade_chunk made;
    uint32_t low, high;
    const int count = ANY_OF(1, TRIANGLES);
    any_floats(position, 9 * TRIANGLES);
    for (int k = 0; k < 3 * TRIANGLES; k++)
        list[k] = Frama_C_unsigned_int_interval(0, 3 * TRIANGLES - 1);
    mesh.positions = position;
    mesh.indices = list;
    mesh.vertex_count = mesh.index_count = 3 * TRIANGLES;
    made.first = ANY_OF(0, TRIANGLES / 2);
    made.count = ANY_OF(0, TRIANGLES / 2);
    shade__box_chunk(&mesh, &made);
    shade__longest_axis(&mesh, list, count, &low, &high);
    shade__partition(&mesh, list, count, ANY_OF(0, 2),
                     Frama_C_unsigned_int_interval(0, UINT32_MAX));
}

int main(void)
{
    prove_view();
    prove_next();
    prove_make();
    return 0;
}
#endif

#ifdef PROVE_edges
/* Corners of triangles sorted by position or by edge, edges and normals of corners: any
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
#endif

#ifdef PROVE_lines
/* Ends of lines: any points, matrix and width; points read inside their array. */
/* eva: -eva-slevel 20 -eva-split-return-function shade__stroke_part:0 */
#define SHADE_LANES 128
#include "prove.h"

int main(void)
{
    static float coordinates[4 * 3];
    static shade_vertex_ids ids;
    static shade_vertices out;
    shade__stroke s;
    shade_line_state state = { 0 };
    state.raster.depth_zero_to_one = ANY_OF(0, 1);
    state.cap = (shade_cap)ANY_OF(SHADE_CAP_BUTT, SHADE_CAP_SQUARE);
    any_floats(coordinates, 12);
    for (int i = 0; i < 16; i++) s.clip_from_points[i] = (double)any_float();
    s.points = (const shade_vec3 *)coordinates;
    s.state = &state;
    s.half[0] = Frama_C_double_interval(0.5, 8192);
    s.half[1] = Frama_C_double_interval(0.5, 8192);
    s.half_line = Frama_C_double_interval(0, 1.8e38);
    /* 4 points are 12 corners */
    for (int i = 0; i < SHADE_LANES; i++)
        ids.index[i] = Frama_C_unsigned_int_interval(0, 11);
    shade__stroke_vertex(&s, &ids, &out);
    /* what shade_draw_lines makes of a count that it has found good */
    const int count = ANY_OF(0, INT32_MAX / 3) * 3;
    const uint32_t last = Frama_C_unsigned_int_interval(0, (uint32_t)count);
    const size_t point = 2 * (size_t)(last / 6) + 1;
    /*@ assert point <= 715827883; */
    return 0;
}
#endif
