/* lane.h - one lane of a packet as a vector, for shaders that compute vertex by vertex or pixel by
   pixel.

       SHADE_EACH_LANE(i) {
           shade_vec3 N = lane(in->varying[3], i);    reads rows 3, 4 and 5
           lane_put(out->color[0], i, N);             writes rows 0, 1 and 2
       } */
#ifndef SHARED_LANE_H
#define SHARED_LANE_H

#include "shade.h"

/* rows: the first of three */
static inline shade_vec3 lane(const float *rows, int i)
{
    return shade_v3(rows[i], rows[i + SHADE_LANES], rows[i + 2 * SHADE_LANES]);
}

static inline void lane_put(float *rows, int i, shade_vec3 v)
{
    rows[i] = v.x;
    rows[i + SHADE_LANES] = v.y;
    rows[i + 2 * SHADE_LANES] = v.z;
}

/* rows: the first of four */
static inline void lane_put4(float *rows, int i, shade_vec4 v)
{
    lane_put(rows, i, shade_v3(v.x, v.y, v.z));
    rows[i + 3 * SHADE_LANES] = v.w;
}
#endif
