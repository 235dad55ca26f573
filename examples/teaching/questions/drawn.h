/* drawn.h - numbers that a seed draws, for numbers.c and exam.c. */
#ifndef DRAWN_H
#define DRAWN_H
#include <stdint.h>
#include <stdlib.h>

static uint32_t drawn_state;
/* A number from low to high in steps, as one writes it on paper. */
static float drawn(float low, float high, float step)
{
    const int steps = (int)((high - low) / step + 1.5f);
    drawn_state ^= drawn_state << 13; /* Marsaglia's xorshift */
    drawn_state ^= drawn_state >> 17;
    drawn_state ^= drawn_state << 5;
    return low + step * (float)((int)(drawn_state >> 8) % steps);
}
static void drawn_seed(const char *text)
{
    drawn_state = (uint32_t)strtoul(text, NULL, 10) * 2654435761u + 362436069u;
}
#endif
