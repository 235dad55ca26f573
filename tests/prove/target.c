/* target.c - any fields of a target: checked without overflow, and if it is good the clip rectangle
   lies in the picture and in the rows held, whose pixels 32 bits count. */
/* eva: -eva-slevel 100 -eva-split-return-function shade__check_target:0,shade__target_fault:0 */
#include "prove.h"

int main(void)
{
    static uint32_t pixels[1];
    static float depth[1];
    shade_target t;
    int r[4];
    t.color = pixels;
    t.depth = depth;
    t.width = ANY_OF(INT32_MIN, INT32_MAX);
    t.height = ANY_OF(INT32_MIN, INT32_MAX);
    t.stride = ANY_OF(INT32_MIN, INT32_MAX);
    t.format = (shade_format)Frama_C_unsigned_int_interval(0, 0xFFFFFFFFu);
    t.clip_x = ANY_OF(INT32_MIN, INT32_MAX);
    t.clip_y = ANY_OF(INT32_MIN, INT32_MAX);
    t.clip_width = ANY_OF(INT32_MIN, INT32_MAX);
    t.clip_height = ANY_OF(INT32_MIN, INT32_MAX);
    t.row_offset = ANY_OF(INT32_MIN, INT32_MAX);
    t.row_count = ANY_OF(INT32_MIN, INT32_MAX);
    t.srgb = t.dither = 1;
    if (shade__check_target(&t) != SHADE_OK) return 0;
    /*@ assert 1 <= t.width <= 16384 && 1 <= t.height <= 16384; */
    /*@ assert 0 <= t.row_offset <= 16384 && 0 <= t.row_count <= 16384; */
    shade__clip_rectangle(&t, r);
    if (r[0] >= r[2] || r[1] >= r[3]) return 0;    /* empty: what it returns */
    /*@ assert 0 <= r[0] < 16384 && 0 <= r[1] < 32768; */
    /*@ assert 1 <= r[2] <= 16384 && 1 <= r[3] <= 32768; */
    const int stride = shade__stride_of(&t), rows = shade__rows_held(&t);
    /*@ assert 1 <= stride && 1 <= rows <= 16384; */
    return 0;
}
