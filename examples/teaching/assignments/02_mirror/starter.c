/* Write the function that README.md asks for. */
#include "shade.h"
#include <math.h>

shade_vec3 mirror(shade_vec3 L, shade_vec3 N)
{
    (void)N;
    return L;
}
