/* png.c - png.ppm in, PNG out: ./png picture.ppm picture.png writes the pixels of a PPM by
   shade_write_png. */
#include "shade.h"
#include <stdio.h>
#include <stdlib.h>

int main(int argc, char **argv)
{
    shade_target t = { 0 };
    FILE *f = argc == 3 ? fopen(argv[1], "rb") : NULL;
    if (!f || fscanf(f, "P6 %d %d 255", &t.width, &t.height) != 2) return 1;
    fgetc(f);
    size_t pixels = (size_t)t.width * (size_t)t.height;
    unsigned char *p = (unsigned char *)calloc(pixels, 4);
    for (size_t i = 0; p && i < pixels; i++)
        if (fread(p + 4 * i, 1, 3, f) != 3) return 1;
    fclose(f);
    t.color = p;
    t.srgb = 1;
    if (!p || shade_write_png(argv[2], &t) != SHADE_OK) return 1;
    free(p);
    return 0;
}
