/* pictures.c - pixels that resolve and mipmaps read and write: blocks at every edge of a picture
   whose memory ends with the last pixel; offsets in the greatest picture. */
#include "prove.h"

enum { WIDTH = 9, HEIGHT = 3 };

static shade_target in, out;
static shade__decoder decoder;
static shade__halving halving;
static uint8_t fine[16 * 64 * WIDTH * HEIGHT], coarse[16 * WIDTH * HEIGHT];

/* rows that end within a block */
static void prove_resolve(shade_format format, int factor)
{
    const size_t bytes = shade__pixel_bytes(format);
    in.format = out.format = format;
    in.width = WIDTH * factor;
    in.height = HEIGHT * factor;
    out.width = WIDTH;
    out.height = HEIGHT;
    in.color = fine + sizeof fine - (size_t)(WIDTH * HEIGHT * factor * factor) * bytes;
    out.color = coarse + sizeof coarse - (size_t)(WIDTH * HEIGHT) * bytes;
    shade__open_decoder(&in, &decoder);
    shade__convert(&decoder, &out, factor, NULL, NULL);
}

/* a level of mipmaps from the one before, in memory that ends with the last texel of each */
static void prove_shrink(shade_format format, int width, int height)
{
    const size_t bytes = shade__pixel_bytes(format);
    in.format = out.format = format;
    in.width = width;
    in.height = height;
    out.width = width / 2 > 0 ? width / 2 : 1;
    out.height = height / 2 > 0 ? height / 2 : 1;
    in.color = fine + sizeof fine - (size_t)(width * height) * bytes;
    out.color = coarse + sizeof coarse - (size_t)(out.width * out.height) * bytes;
    shade__open_decoder(&in, &decoder);
    for (int v = 0; v < SHADE__DOUBLES; v++) halving.light[v] = (double)decoder.value[v];
    decoder.halving = &halving;
    shade__convert(&decoder, &out, 2, NULL, NULL);
}

/* offsets of pixels in the greatest picture, its rows however far apart */
static void prove_offsets(void)
{
    size_t offset;
    in.width = 16384;
    in.height = 16384;
    in.row_offset = 0;
    in.stride = ANY_OF(16384, INT32_MAX);
    offset = shade__offset_of(&in, ANY_OF(0, 16383), ANY_OF(0, 16383));
    /*@ assert offset <= 35184372088832; */
}

int main(void)
{
    memset(fine, ANY_OF(0, 255), sizeof fine);
    for (int factor = 1; factor <= 8; factor++) {
        prove_resolve(SHADE_FORMAT_RGBA8, factor);
        prove_resolve(SHADE_FORMAT_RGB565, factor);
    }
    prove_resolve(SHADE_FORMAT_RGBA32F, 3);
    prove_shrink(SHADE_FORMAT_RGBA8, 17, 5);
    prove_shrink(SHADE_FORMAT_RGB565, 6, 9);
    prove_shrink(SHADE_FORMAT_A8, 7, 1);
    prove_shrink(SHADE_FORMAT_RGBA32F, 3, 8);
    prove_offsets();
    return 0;
}
