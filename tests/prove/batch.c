/* batch.c - triangles taken into a batch: any indices, ranges of triangles one after the other
   wherever they lie, vertices of every width; then these vertices gathered. */
/* eva: -eva-slevel-function shade__take_triangles:200,shade__take_batch:200,shade__gather:400 */
#include "prove.h"

enum { TOP = INT32_MAX / 3 };    /* no draw has more triangles */

static shade__draw d;
static shade__supply supply;
static shade_pipeline pipe;

/* what shade__run_draw leaves to the first batch, or one batch to the next */
static void any_incoming(shade__incoming *in, int vertices)
{
    any_ints((int32_t *)in->ids.index, SHADE_LANES, INT32_MIN, INT32_MAX);
    for (int i = 0; i < 2 * SHADE_LANES; i++) {
        in->known[i] = Frama_C_unsigned_int_interval(0, UINT32_MAX);
        in->slot_of[i] = Frama_C_unsigned_char_interval(0, (unsigned char)(vertices - 1));
    }
}

/* the last triangles of a list, into the last corners that are free: both arrays end with them */
static void prove_take(int most, int room)
{
    static uint32_t list[3 * SHADE__BATCH_TRIANGLES];
    static uint8_t corner[SHADE__BATCH_TRIANGLES][4];
    const shade__indices wide = { list, NULL };
    const int first = SHADE__BATCH_TRIANGLES - most;
    int taken;
    any_incoming(&d.u.incoming, room + 3);
    memset(corner, 0, sizeof corner);
    any_ints((int32_t *)list, 3 * SHADE__BATCH_TRIANGLES, INT32_MIN, INT32_MAX);
    d.u.incoming.ids.count = ANY_OF(0, room);
    taken = shade__take_triangles(&d.u.incoming, wide, (uint32_t)first, most, room, corner + first);
    /*@ assert 0 <= taken <= most; */
    /*@ assert 0 <= d.u.incoming.ids.count <= room + 3; */
    for (int i = 0; i < 4 * SHADE__BATCH_TRIANGLES; i++) {
        /*@ assert corner[i / 4][i % 4] < room + 3; */
    }
    for (int i = 0; i < 2 * SHADE_LANES; i++) {
        /*@ assert d.u.incoming.slot_of[i] < room + 3; */
    }
}

/* another range wherever it lies; or none */
static int anywhere(shade__draw *to)
{
    to->supply->first = ANY_OF(0, TOP);
    to->supply->end = ANY_OF(0, TOP);
    return ANY_OF(0, 1);
}

static void prove_batch(int stride, int vertices)
{
    any_incoming(&d.u.incoming, vertices);
    d.supply = &supply;
    d.plan.value_stride = stride;
    supply.more = anywhere;
    anywhere(&d);
    shade__take_batch(&d);
    /*@ assert 0 <= d.u.incoming.ids.count <= vertices; */
    /*@ assert 0 <= d.batch.count <= SHADE__BATCH_TRIANGLES; */
    /*@ assert 0 <= d.batch.parts <= SHADE__PARTS; */
    /*@ assert d.setup.count == 0; */
}

/* as many vertices as there is room for: fewer touch less */
static void prove_gather(int varyings, int again, int divided)
{
    static shade_vertices vertices;
    static shade__placed placed;
    shade__plan *plan = &d.plan;
    plan->pipe = &pipe;
    plan->varyings = varyings;
    plan->values = varyings + SHADE__FIRST + again;
    plan->value_stride = (plan->values + 7) / 8 * 8;
    plan->first_divided = shade__min(divided, plan->values);
    pipe.lod_varying = ANY_OF(0, shade__max(varyings - 2, 0));
    shade__gather(plan, shade__min(SHADE_LANES, SHADE__BATCH_FLOATS / plan->value_stride),
                  &vertices, &placed, &d.batch);
    /*@ assert d.batch.corner[0][0] == 0; */
}

int main(void)
{
    for (int varyings = 0; varyings <= SHADE_MAX_VARYINGS; varyings++) {
        prove_gather(varyings, 0, SHADE__FIRST);
        prove_gather(varyings, 0, SHADE__VALUES_MAX);
        if (varyings > 1) prove_gather(varyings, 2, SHADE__VALUES_MAX);
    }
    for (int stride = 8; stride <= SHADE__VALUES_MAX; stride += 8) {
        const int vertices = shade__min(SHADE_LANES, SHADE__BATCH_FLOATS / stride);
        prove_take(0, vertices - 3);
        prove_take(1, vertices - 3);
        prove_take(SHADE__BATCH_TRIANGLES, vertices - 3);
        prove_batch(stride, vertices);
    }
    return 0;
}
