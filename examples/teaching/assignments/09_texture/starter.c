/* Write the function that README.md asks for. */
#include "shade.h"
#include <math.h>

shade_vec2 texture_at(const float w[3], const shade_vec2 uv[3], const float abc[3])
{
    (void)w;
    (void)uv;
    (void)abc;
    return shade_v2(0, 0);
}
