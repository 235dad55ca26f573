/* Write the function that README.md asks for. */
#include "shade.h"
#include <math.h>

float depth_at(const float w[3], const float z[3], const float abc[3])
{
    (void)w;
    (void)z;
    (void)abc;
    return 0;
}
