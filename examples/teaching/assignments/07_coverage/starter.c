/* Write the function that README.md asks for. */
#include "shade.h"
#include <math.h>

int covers(const int x[3], const int y[3], int i, int j)
{
    (void)x;
    (void)y;
    (void)i;
    (void)j;
    return 0;
}
