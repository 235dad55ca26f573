/* clear.c - filling rows and rectangles: any clip rectangle, colour and depth, every format. */
#define SHADE_LANES 128
#include "prove.h"

static uint32_t color[4 * 17], memory[301];
static float depth[17];

/* n bytes that end where a guard begins */
static void prove_fill(void)
{
    float pattern[64];
    any_floats(pattern, 64);
    memory[300] = 0xA5A5A5A5u;
    /*@ loop unroll 400; */
    for (size_t n = 0; n <= 1200; n += n < 540 ? 2 : 60)
        shade__fill((uint8_t *)(memory + 300) - n, pattern, n);
    /*@ assert memory[300] == 0xA5A5A5A5; */
}

/* 5 x 3 pixels, 6 from row to row, whose memory ends with the last one */
static void prove_clear(shade_format format)
{
    shade_target t = { .color = (uint8_t *)color + sizeof color - 17 * shade__pixel_bytes(format),
                       .depth = depth, .width = 5, .height = 3, .stride = 6, .format = format };
    t.srgb = ANY_OF(0, 1);
    t.dither = ANY_OF(0, 1);
    for (int x = -1; x <= 5; x += 2) {
        for (int w = 0; w <= 6; w += 3) {
            t.clip_x = x;
            t.clip_width = w;
            t.clip_y = ANY_OF(INT32_MIN, INT32_MAX);
            t.clip_height = ANY_OF(0, INT32_MAX);
            shade_clear(&t, shade_v4(any_float(), any_float(), any_float(), any_float()),
                        any_float());
        }
    }
}

int main(void)
{
    prove_fill();
    prove_clear(SHADE_FORMAT_RGBA8);
    prove_clear(SHADE_FORMAT_RGB565);
    prove_clear(SHADE_FORMAT_RGB565_SWAPPED);
    prove_clear(SHADE_FORMAT_RGBA32F);
    return 0;
}
