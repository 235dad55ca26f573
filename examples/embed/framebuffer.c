/* framebuffer.c - the saddle turning on Linux's framebuffer device, without X, Wayland or a driver
   of ours: the device says how its memory is laid out, and shade.h draws in that format.

   cc -O2 -I../.. framebuffer.c cmake/saddle.c cmake/shade.c -lm -o framebuffer
   ./framebuffer [/dev/fb0 [frames]]        on a text console, as root or in the group video */
#include "cmake/saddle.h"
#include <errno.h>
#include <fcntl.h>
#include <linux/fb.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <sys/ioctl.h>
#include <sys/mman.h>

/* The format of a pixel; -1: none of ours */
static int format_of(const struct fb_var_screeninfo *v)
{
    uint32_t red = v->red.offset, green = v->green.offset, blue = v->blue.offset;
    if (v->bits_per_pixel == 16 && v->green.length == 6 && red == 11) return SHADE_FORMAT_RGB565;
    if (v->bits_per_pixel != 32 || green != 8) return -1;
    if (red == 16 && blue == 0) return SHADE_FORMAT_BGRA8;
    return red == 0 && blue == 16 ? SHADE_FORMAT_RGBA8 : -1;
}

static int fail(const char *path, const char *what)
{
    fprintf(stderr, "%s: %s\n", path, what);
    return 1;
}

int main(int argc, char **argv)
{
    const char *path = argc > 1 ? argv[1] : "/dev/fb0";
    int device = open(path, O_RDWR), frames = argc > 2 ? atoi(argv[2]) : 600;
    struct fb_var_screeninfo v;
    struct fb_fix_screeninfo f;
    if (device < 0 || ioctl(device, FBIOGET_VSCREENINFO, &v) ||
        ioctl(device, FBIOGET_FSCREENINFO, &f))
        return fail(path, strerror(errno));
    if (format_of(&v) < 0) return fail(path, "pixels are neither 5-6-5 bits nor RGBA or BGRA");
    if ((v.yoffset + v.yres) * (size_t)f.line_length > f.smem_len) return fail(path, "too small");

    /* drawn in memory of our own, which is faster to read than the device's, and shown whole */
    size_t size = v.bits_per_pixel / 8, row = v.xres * size;
    shade_target target = { .width = (int)v.xres, .height = (int)v.yres, .srgb = 1, .dither = 1,
                            .format = (shade_format)format_of(&v) };
    char *screen = mmap(NULL, f.smem_len, PROT_WRITE, MAP_SHARED, device, 0);
    target.color = malloc(row * v.yres);
    target.depth = malloc(sizeof(float) * v.xres * v.yres);
    if (screen == MAP_FAILED || !target.color || !target.depth) return fail(path, strerror(errno));

    for (int k = 0; k < frames; k++) {
        shade_result result = saddle_draw(&target, (float)k * 0.02f);
        if (result) return fail(path, shade_result_string(result));
        for (size_t y = 0; y < v.yres; y++)
            memcpy(screen + (v.yoffset + y) * f.line_length + v.xoffset * size,
                   (char *)target.color + y * row, row);
    }
    return 0;
}
