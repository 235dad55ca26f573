/* contact.c - a contact sheet of pictures, three to a row.  Each is made small by the mean over
   areas in linear light, and has the name of its file below it.

   cc -O2 -I. examples/pictures/contact.c -lm -o contact
   ./contact sheet.ppm one.ppm two.ppm ... */
#define SHADE_IMPLEMENTATION
#include "shade.h"
#include "../shared/mesh.h"
#include "../shared/label.h"

enum { COLUMNS = 3, WIDTH = 310, HEIGHT = 206, CAPTION = 32, GAP = 10 };    /* pixels */
typedef struct picture { int width, height; unsigned char *bytes; } picture;

/* A binary PPM of 8 bits; bytes is NULL where the file is something else. */
static picture read_ppm(const char *path)
{
    picture p = { 0, 0, NULL };
    FILE *f = fopen(path, "rb");
    int most = 0;
    if (f && fscanf(f, "P6 %d %d %d", &p.width, &p.height, &most) == 3 && most == 255 &&
        p.width > 0 && p.width <= 16384 && p.height > 0 && p.height <= 16384 && getc(f) != EOF) {
        size_t row = 3 * (size_t)p.width, rows = (size_t)p.height;
        p.bytes = (unsigned char *)example_memory(row, rows);
        if (fread(p.bytes, row, rows, f) < rows) {
            free(p.bytes);
            p.bytes = NULL;
        }
    }
    if (f) fclose(f);
    return p;
}

/* The mean of the square from x, y to x + size, y + size, pixels at its rim by their share */
static shade_vec4 mean(const picture *p, const float *light, float x, float y, float size)
{
    shade_vec4 sum = { 0, 0, 0, 0 };
    for (int j = (int)y; j < p->height && (float)j < y + size; j++)
        for (int i = (int)x; i < p->width && (float)i < x + size; i++) {
            const unsigned char *c = p->bytes + 3 * (j * p->width + i);
            float a = label_share(i, x, x + size) * label_share(j, y, y + size);
            sum = shade_add4(sum, shade_v4(a * light[c[0]], a * light[c[1]], a * light[c[2]], a));
        }
    return shade_scale4(sum, 1 / sum.w);
}

/* Shows a picture, as large as the cell from x, y on allows, in the middle of it. */
static void show(const canvas *c, int x, int y, const picture *p)
{
    float light[256];
    int w = WIDTH, h = HEIGHT;
    if (p->width * h > p->height * w) h = (p->height * w + p->width / 2) / p->width;
    else w = (p->width * h + p->height / 2) / p->height;
    for (int i = 0; i < 256; i++) light[i] = shade_rgb((uint32_t)i).z;
    for (int k = 0; k < w * h; k++) {
        float size = (float)p->width / (float)w, u = size * (float)(k % w);
        int to = (y + (HEIGHT - h) / 2 + k / w) * c->width + x + (WIDTH - w) / 2 + k % w;
        ((shade_vec4 *)c->target.color)[to] = mean(p, light, u, size * (float)(k / w), size);
    }
}

/* The name of a file without its folder and ending, with blanks for _ */
static void read_name(const char *path, char name[40])
{
    const char *slash = strrchr(path, '/');
    name[0] = 0;
    sscanf(slash ? slash + 1 : path, "%39[^.]", name);
    for (char *blank = name; (blank = strchr(blank, '_')) != NULL;) *blank = ' ';
}

int main(int argc, char **argv)
{
    const int rows = (argc - 2 + COLUMNS - 1) / COLUMNS, row = HEIGHT + CAPTION + GAP;
    if (argc < 3) {
        fprintf(stderr, "usage: contact sheet.ppm picture.ppm ...\n");
        return 1;
    }
    canvas c = canvas_new(COLUMNS * (WIDTH + GAP) + GAP, rows * row + GAP, 1);
    shade_clear(&c.target, shade_v4(0.010f, 0.011f, 0.014f, 1), 1);
    for (int i = 0; i < argc - 2; i++) {
        const int x = GAP + i % COLUMNS * (WIDTH + GAP), y = GAP + i / COLUMNS * row;
        picture p = read_ppm(argv[i + 2]);
        char name[40];
        if (!p.bytes) {
            fprintf(stderr, "%s: no binary PPM\n", argv[i + 2]);
            exit(1);
        }
        show(&c, x, y, &p);
        read_name(argv[i + 2], name);
        label_center(&c, x + WIDTH / 2, y + HEIGHT + 23, 20, shade_v3(0.5f, 0.5f, 0.5f), name);
        free(p.bytes);
    }
    return canvas_save(&c, argc, argv, "contact.ppm");
}
