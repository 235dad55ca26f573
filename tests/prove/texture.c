/* texture.c - texture addresses: any bits of u, v, lod in, texels inside the texture out. */
/* eva: -eva-partition-history 3 -eva-ilevel 32 */
#define SHADE_LANES 128
#include "prove.h"

enum { N = SHADE__BLOCK };

static shade__axis axis;

/* any coordinate; sizes from least to most */
static void prove_axis(int least, int most, shade_wrap wrap, int nearest)
{
    float c[N] = { 0 };
    const int size = ANY_OF(least, most);
    c[0] = any_float();
    axis.size = size;
    axis.wrap = wrap;
    axis.unit = 1;
    shade__address(c, 1, nearest, &axis);
    /*@ assert 0 <= axis.i[0][0] < most && 0 <= axis.i[1][0] < most; */
}

static void prove_axes(int least, int most)
{
    for (int nearest = 0; nearest < 2; nearest++) {
        prove_axis(least, most, SHADE_WRAP_REPEAT, nearest);
        prove_axis(least, most, SHADE_WRAP_CLAMP, nearest);
        prove_axis(least, most, SHADE_WRAP_MIRROR, nearest);
    }
}

int main(void)
{
    prove_axes(1, 1);
    prove_axes(2, 2);
    prove_axes(3, 3);
    prove_axes(1, 64);
    prove_axes(255, 255);
    prove_axes(16384, 16384);
    prove_axes(1, 16384);
    return 0;
}
