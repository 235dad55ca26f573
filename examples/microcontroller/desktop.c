/* desktop.c - the same picture on a big machine: in strips, and at once to compare.

     desktop picture.565 picture.ppm       what the board sends; the same to look at */
#include "picture.h"
#include <stdio.h>
#include <string.h>

static uint8_t sent[2 * PICTURE_WIDTH * PICTURE_HEIGHT];
static size_t sent_size;

static void keep(const uint8_t *bytes, size_t size)
{
    memcpy(sent + sent_size, bytes, size);
    sent_size += size;
}

static int not_written(const char *path)
{
    fprintf(stderr, "%s: not written\n", path);
    return 1;
}

int main(int argc, char **argv)
{
    static uint16_t color[PICTURE_WIDTH * PICTURE_HEIGHT];
    static float depth[PICTURE_WIDTH * PICTURE_HEIGHT];
    shade_target whole = { .width = PICTURE_WIDTH,
                           .height = PICTURE_HEIGHT,
                           .format = SHADE_FORMAT_RGB565_SWAPPED,
                           .srgb = 1,
                           .dither = 1 };
    int different = 0;
    FILE *f;
    if (argc != 3) {
        fprintf(stderr, "usage: desktop picture.565 picture.ppm\n");
        return 1;
    }
    whole.color = color;
    whole.depth = depth;
    picture_draw(&whole);
    picture_strips(keep);
    for (int i = 0; i < PICTURE_WIDTH * PICTURE_HEIGHT; i++)
        different += memcmp(&color[i], sent + 2 * i, 2) != 0;
    if (different) fprintf(stderr, "%d pixels of the strips differ from the whole\n", different);
    f = fopen(argv[1], "wb");
    if (!f || fwrite(sent, 1, sent_size, f) != sent_size || fclose(f)) return not_written(argv[1]);
    if (shade_write_ppm(argv[2], &whole)) return not_written(argv[2]);
    return different > 0;
}
