/* main.c - draws the saddle into a file:   saddle [saddle.ppm [width height]] */
#include "saddle.h"
#include <stdio.h>
#include <stdlib.h>

int main(int argc, char **argv)
{
    const char *path = argc > 1 ? argv[1] : "saddle.ppm";
    shade_target target = { .width = argc > 3 ? atoi(argv[2]) : 640,
                            .height = argc > 3 ? atoi(argv[3]) : 480, .srgb = 1 };
    shade_result result = SHADE_ERROR_TARGET;

    if (target.width > 0 && target.height > 0) {
        size_t pixels = (size_t)target.width * (size_t)target.height;
        target.color = malloc(pixels * sizeof(uint32_t));
        target.depth = malloc(pixels * sizeof(float));
        if (target.color && target.depth) result = saddle_draw(&target, 0);
    }
    if (!result) result = shade_write_ppm(path, &target);
    if (result) fprintf(stderr, "saddle: %s: %s\n", path, shade_result_string(result));
    free(target.color);
    free(target.depth);
    return result != SHADE_OK;
}
