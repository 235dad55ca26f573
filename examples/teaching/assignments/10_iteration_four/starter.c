/* Write the function that README.md asks for. */
#include "shade.h"
#include <math.h>

shade_vec3 iteration_four(const shade_lighting *lighting, const shade_material *m, shade_vec3 eye,
                          shade_vec3 P, shade_vec3 N)
{
    (void)lighting;
    (void)eye;
    (void)P;
    (void)N;
    return m->emission;
}
