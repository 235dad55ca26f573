/* contact.c - a contact sheet of pictures, seven to a row.  Each is made small by the mean over
   areas in linear light, and has the name of its file below it.  What begins with = is a heading,
   its blanks written as _.

   cc -O2 -I. examples/pictures/contact.c -lm -o contact
   ./contact sheet.ppm =The_first_two one.ppm two.ppm =All_others three.ppm ... */
#define SHADE_IMPLEMENTATION
#include "shade.h"
#include "../shared/mesh.h"
#include "../shared/label.h"

enum { COLUMNS = 7, WIDTH = 150, HEIGHT = 92, CAPTION = 22, HEAD = 40, GAP = 10 };    /* pixels */
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

/* The place of the next picture or heading; the sheet is low pixels high with it. */
typedef struct place { int column, x, y, low; } place;

static void next(place *p, const char *argument)
{
    if (*argument == '=') {
        p->column = COLUMNS;
        p->x = GAP;
        p->y = p->low;
        p->low += HEAD;
        return;
    }
    if (p->column == COLUMNS) {
        p->column = 0;
        p->y = p->low;
        p->low += HEIGHT + CAPTION + GAP;
    }
    p->x = GAP + p->column++ * (WIDTH + GAP);
}

/* The name of a file without its folder and ending, or a heading, with blanks for _ */
static void read_name(const char *argument, char name[40])
{
    const char *slash = strrchr(argument, '/');
    name[0] = 0;
    sscanf(*argument == '=' ? argument + 1 : slash ? slash + 1 : argument, "%39[^.]", name);
    for (char *blank = name; (blank = strchr(blank, '_')) != NULL;) *blank = ' ';
}

int main(int argc, char **argv)
{
    float linear[256];
    place all = { COLUMNS, 0, 0, GAP }, at = all;
    if (argc < 3) {
        fprintf(stderr, "usage: contact sheet.ppm picture.ppm ...\n");
        return 1;
    }
    for (int i = 2; i < argc; i++) next(&all, argv[i]);
    canvas c = canvas_new(COLUMNS * (WIDTH + GAP) + GAP, all.low, 1);
    for (int i = 0; i < 256; i++) linear[i] = shade_rgb((uint32_t)i).z;
    shade_clear(&c.target, shade_v4(0.010f, 0.011f, 0.014f, 1), 1);
    for (int i = 2; i < argc; i++) {
        int w = WIDTH, h = HEIGHT;
        char name[40];
        next(&at, argv[i]);
        read_name(argv[i], name);
        if (*argv[i] == '=') {
            label_draw(&c, at.x, at.y + 28, 22, shade_v3(0.75f, 0.75f, 0.75f), name);
            continue;
        }
        picture p = read_ppm(argv[i]);
        if (!p.bytes) {
            fprintf(stderr, "%s: no binary PPM\n", argv[i]);
            exit(1);
        }
        if (p.width * h > p.height * w) h = (p.height * w + p.width / 2) / p.width;
        else w = (p.width * h + p.height / 2) / p.height;
        for (int k = 0; k < w * h; k++) {
            float size = (float)p.width / (float)w, u = size * (float)(k % w);
            int to = (at.y + (HEIGHT - h) / 2 + k / w) * c.width + at.x + (WIDTH - w) / 2 + k % w;
            ((shade_vec4 *)c.target.color)[to] = mean(&p, linear, u, size * (float)(k / w), size);
        }
        label_center(&c, at.x + WIDTH / 2, at.y + HEIGHT + 17, 16, shade_v3(0.4f, 0.4f, 0.4f),
                     name);
        free(p.bytes);
    }
    return canvas_save(&c, argc, argv, "contact.ppm");
}
