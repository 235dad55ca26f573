/* textures.c - where texels are, and what is read there.
   Each part is a driver of prove.sh. */

#ifdef PROVE_texture
/* Texture addresses: any bits of u, v, lod in, texels inside the texture out. */
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
#endif

#ifdef PROVE_sample
/* Texels of textures of every format, whose memory ends with their last texel: any bits
   of u, v, lod and of the texels. */
/* eva: -eva-partition-history 3 -eva-ilevel 32 */
#include "prove.h"

static uint32_t memory[4 * 5 * 3];    /* 4 x 3 texels, 5 from row to row */

static void prove_texture(shade_format format, shade_wrap wrap, shade_filter filter)
{
    float u[SHADE_LANES], v[SHADE_LANES], lod[SHADE_LANES], rgba[4 * SHADE_LANES];
    shade_texture t, level;
    const size_t bytes = shade__pixel_bytes(format);
    memset(&t, 0, sizeof t);
    t.pixels = (const uint8_t *)memory + sizeof memory - 14 * bytes;    /* the last row: 4 */
    t.width = 4;
    t.height = 3;
    t.stride = 5;
    t.format = format;
    t.wrap_u = t.wrap_v = wrap;
    t.filter = filter;
    t.srgb = ANY_OF(0, 1);
    level = t;
    level.width = 2;
    level.height = level.stride = 1;
    level.stride = 2;
    level.pixels = (const uint8_t *)memory + sizeof memory - 2 * bytes;
    t.mipmaps = &level;
    t.mipmap_count = 1;
    any_floats(u, SHADE_LANES);
    any_floats(v, SHADE_LANES);
    any_floats(lod, SHADE_LANES);
    shade_sample_lanes(&t, u, v, lod, rgba);
}

static void prove_format(shade_format format)
{
    prove_texture(format, SHADE_WRAP_REPEAT, SHADE_FILTER_NEAREST);
    prove_texture(format, SHADE_WRAP_REPEAT, SHADE_FILTER_BILINEAR);
    prove_texture(format, SHADE_WRAP_CLAMP, SHADE_FILTER_TRILINEAR);
    prove_texture(format, SHADE_WRAP_MIRROR, SHADE_FILTER_TRILINEAR);
}

int main(void)
{
    any_ints((int32_t *)memory, 60, INT32_MIN, INT32_MAX);
    prove_format(SHADE_FORMAT_RGBA8);
    prove_format(SHADE_FORMAT_RGB565);
    prove_format(SHADE_FORMAT_RGB565_SWAPPED);
    prove_format(SHADE_FORMAT_RGBA32F);
    prove_format(SHADE_FORMAT_A8);
    return 0;
}
#endif
