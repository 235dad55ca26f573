/* chunks.c - boxes of any bits before any planes; planes of any matrix and any good target; lists
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
