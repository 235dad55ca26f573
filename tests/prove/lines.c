/* lines.c - ends of lines: any points, matrix and width; points read inside their array. */
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
