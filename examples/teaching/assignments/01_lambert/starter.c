/* Write the function that README.md asks for. */
#include "shade.h"
#include <math.h>

float lambert(shade_vec3 N, shade_vec3 L)
{
    (void)N;
    (void)L;
    return 0;
}
