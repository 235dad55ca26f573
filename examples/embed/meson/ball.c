/* ball.c - the equation of light alone: a ball of characters, each as bright as shade_lit says.
   No target, no mesh, nothing drawn. */
#include "shade.h"
#include <stdio.h>

int main(void)
{
    static const char ramp[] = ".:-=+*%@#";
    shade_light lamp = shade_point_light(shade_v3(-2, 3, 4), shade_v3(1, 1, 1));
    shade_lighting lighting = { .lights = &lamp, .light_count = 1,
                                .ambient = { 0.1f, 0.1f, 0.1f } };
    shade_material stone = { .ambient = { 1, 1, 1 }, .diffuse = { 0.6f, 0.6f, 0.6f },
                             .specular = { 0.4f, 0.4f, 0.4f }, .shininess = 30 };
    shade_vec3 eye = { 0, 0, 5 };

    for (int row = 0; row < 24; row++) {
        for (int column = 0; column < 48; column++) {
            /* characters are twice as high as wide; seen from far away */
            float x = ((float)column - 23.5f) / 24, y = (11.5f - (float)row) / 12;
            float zz = 1 - x * x - y * y;
            if (zz > 0) {
                shade_vec3 N = { x, y, sqrtf(zz) };
                float I = shade_lit(&lighting, &stone, eye, N, N).x;
                putchar(ramp[I < 1 ? (int)(I * 9) : 8]);
            } else {
                putchar(' ');
            }
        }
        putchar('\n');
    }
    return 0;
}
