/* Write the function that README.md asks for. */
#include "shade.h"
#include <math.h>

shade_vec3 halfway(shade_vec3 L, shade_vec3 V)
{
    (void)V;
    return L;
}

float phong(shade_vec3 N, shade_vec3 L, shade_vec3 V, float n)
{
    (void)N;
    (void)L;
    (void)V;
    (void)n;
    return 0;
}
