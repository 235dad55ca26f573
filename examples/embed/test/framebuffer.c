/* framebuffer.c - examples/embed/framebuffer.c on a device made of a file: what it shows is the
   saddle, pixel by pixel, in the device's layout, and no other byte has changed.

   cc -I. examples/embed/test/framebuffer.c examples/embed/cmake/saddle.c -lm && ./a.out scratch */
#define _DEFAULT_SOURCE
#define SHADE_IMPLEMENTATION
#include <stdarg.h>
#include "shade.h"
#define ioctl device_ioctl
#define main framebuffer_main
#include "../framebuffer.c"
#undef main

enum { WIDTH = 150, HEIGHT = 110, UNTOUCHED = 0xa5 };
static struct fb_var_screeninfo var;
static struct fb_fix_screeninfo fix;
static int passed, failed;

int device_ioctl(int device, unsigned long request, ...)
{
    va_list list;
    void *out;
    (void)device;
    va_start(list, request);
    out = va_arg(list, void *);
    va_end(list);
    if (request == FBIOGET_VSCREENINFO) memcpy(out, &var, sizeof var);
    else if (request == FBIOGET_FSCREENINFO) memcpy(out, &fix, sizeof fix);
    else return -1;
    return 0;
}

static void check(const char *what, int ok)
{
    if (ok) passed++;
    else failed++;
    if (!ok) printf("framebuffer: %s\n", what);
}

/* The screen is a window into a larger picture, whose rows are longer still. */
static void layout(unsigned bits, unsigned red, unsigned green, unsigned blue)
{
    memset(&var, 0, sizeof var);
    memset(&fix, 0, sizeof fix);
    var.xres = WIDTH;
    var.yres = HEIGHT;
    var.xoffset = 7;
    var.yoffset = 2 * HEIGHT;
    var.bits_per_pixel = bits;
    var.red.offset = red;
    var.green.offset = green;
    var.blue.offset = blue;
    var.green.length = bits == 16 ? 6 : 8;
    var.red.length = var.blue.length = bits == 16 ? 5 : 8;
    fix.line_length = bits / 8 * (WIDTH + 20);
    fix.smem_len = fix.line_length * 3 * HEIGHT + 100;
}

/* Channel c, 0 .. 255, of the pixel at p; largest is one step of it. */
static int channel(const unsigned char *p, int c, int *step)
{
    uint32_t word = 0, value, most;
    const struct fb_bitfield *field = c == 0 ? &var.red : c == 1 ? &var.green : &var.blue;
    if (var.bits_per_pixel == 16) {
        uint16_t half;
        memcpy(&half, p, 2);
        word = half;
    } else memcpy(&word, p, 4);
    most = (1u << field->length) - 1;
    value = word >> field->offset & most;
    *step = (int)((255 + most - 1) / most);
    return (int)((value * 255 + most / 2) / most);
}

static int run(const char *path, const char *frames)
{
    char program[] = "framebuffer";
    char *argv[] = { program, (char *)path, (char *)frames, NULL };
    return framebuffer_main(3, argv);
}

static void write_device(const char *path)
{
    FILE *f = fopen(path, "wb");
    for (unsigned i = 0; f && i < fix.smem_len; i++) putc(UNTOUCHED, f);
    if (f) fclose(f);
}

static unsigned char *read_device(const char *path)
{
    unsigned char *bytes = (unsigned char *)malloc(fix.smem_len + 1);
    FILE *f = fopen(path, "rb");
    size_t size = bytes && f ? fread(bytes, 1, fix.smem_len + 1, f) : 0;
    if (f) fclose(f);
    check("as long as before", size == fix.smem_len);
    return bytes;
}

static void shows(const char *path, const char *frames, float turn)
{
    static unsigned char want[HEIGHT][WIDTH][4];
    static float depth[HEIGHT][WIDTH];
    shade_target target = { .width = WIDTH, .height = HEIGHT, .color = want, .depth = depth[0] };
    unsigned char *bytes;
    long off = 0, lost = 0, at = 0;
    double drift = 0;
    target.srgb = 1;
    check("the saddle", saddle_draw(&target, turn) == SHADE_OK);
    write_device(path);
    check("runs", run(path, frames) == 0);
    bytes = read_device(path);
    for (unsigned y = 0; y < 3 * HEIGHT; y++)
        for (unsigned x = 0; x < WIDTH + 20; x++, at += var.bits_per_pixel / 8) {
            unsigned i = x - var.xoffset, j = y - var.yoffset;
            const unsigned char *p = bytes + at;
            if (i < WIDTH && j < HEIGHT)
                for (int c = 0; c < 3; c++) {
                    int step, d = channel(p, c, &step) - want[j][i][c];
                    off += d > step || -d > step || (var.bits_per_pixel == 32 && d);
                    drift += d;
                }
            else
                for (unsigned k = 0; k < var.bits_per_pixel / 8; k++) lost += p[k] != UNTOUCHED;
        }
    for (int i = 0; i < 100; i++) lost += bytes[at + i] != UNTOUCHED;
    check("every pixel", off == 0);
    check("neither lighter nor darker on the whole", fabs(drift) < WIDTH * HEIGHT);
    check("nothing else", lost == 0);
    free(bytes);
}

static void refused(const char *path)
{
    unsigned char *bytes;
    unsigned changed = 0;
    write_device(path);
    check("refused", run(path, "1") == 1);
    bytes = read_device(path);
    for (unsigned i = 0; i < fix.smem_len; i++) changed += bytes[i] != UNTOUCHED;
    check("and left alone", changed == 0);
    free(bytes);
}

int main(int argc, char **argv)
{
    const char *path = argc > 1 ? argv[1] : "framebuffer.device";
    layout(32, 16, 8, 0);
    shows(path, "1", 0);
    shows(path, "3", 0.04f);
    layout(32, 0, 8, 16);
    shows(path, "1", 0);
    layout(16, 11, 5, 0);
    shows(path, "2", 0.02f);
    layout(24, 16, 8, 0);
    refused(path);
    layout(16, 10, 5, 0);
    var.green.length = 5;
    refused(path);
    layout(32, 16, 8, 0);
    fix.smem_len -= fix.line_length;
    refused(path);
    remove(path);
    check("no device", run(path, "1") == 1);
    printf("%d passed, %d failed\n", passed, failed);
    return failed != 0;
}
