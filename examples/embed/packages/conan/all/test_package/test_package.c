#define SHADE_IMPLEMENTATION
#include <shade.h>
#include <stdio.h>

int main(void)
{
    const shade_vec3 up = { 0, 0, 1 };
    printf("shade.h %d: %g\n", SHADE_VERSION, (double)shade_lambert(up, up));
    return 0;
}
