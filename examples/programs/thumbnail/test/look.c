/* look.c - questions about pictures, for thumbnail.sh.  Prints what it found, exit
   status 0 where the answer is yes.

     look same A B MOST           no two bytes differ by more than MOST
     look near A B MEAN           the mean difference is at most MEAN
     look middle A B MOST         the mean colours of their middle ninths differ by at most MOST
     look pixel A X Y R G B MOST  the pixel at the parts X, Y (0 .. 1) of width and height
     look alpha A X Y ALPHA       of a PNG
     look area A B PART           the pixels that are not as the top left one are as many in A as in
                                  B, to PART of them
     look display R G B           linear light, 0 .. 1, as bytes */
#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#ifdef MODEL_STB
#define STB_IMAGE_IMPLEMENTATION
#include <stb/stb_image.h>
#endif

typedef struct picture {
    int width, height, channels;
    unsigned char *bytes;
} picture;

static picture load(const char *path)
{
    picture p = { 0, 0, 3, NULL };
    FILE *f = fopen(path, "rb");
    size_t n;
    if (!f) {
        perror(path);
        exit(2);
    }
    if (fscanf(f, "P6 %d %d 255", &p.width, &p.height) == 2 && fgetc(f) == '\n') {
        n = 3 * (size_t)p.width * (size_t)p.height;
        p.bytes = malloc(n);
        if (!p.bytes || fread(p.bytes, 1, n, f) != n || fgetc(f) != EOF) p.bytes = NULL;
    }
#ifdef MODEL_STB
    else
        p.bytes = stbi_load(path, &p.width, &p.height, &p.channels, 0);
#endif
    if (!p.bytes) {
        fprintf(stderr, "%s: no picture\n", path);
        exit(2);
    }
    fclose(f);
    return p;
}

static size_t area(const picture *p)
{
    size_t n = (size_t)p->width * (size_t)p->height, c = (size_t)p->channels, count = 0;
    for (size_t i = 0; i < n; i++) count += memcmp(p->bytes, p->bytes + c * i, c) != 0;
    return count;
}

static int display(double linear)
{
    double s = linear <= 0.0031308 ? 12.92 * linear : 1.055 * pow(linear, 1 / 2.4) - 0.055;
    return (int)(255 * s + 0.5);
}

static const unsigned char *at(const picture *p, double x, double y)
{
    int i = (int)(x * p->width), j = (int)(y * p->height);
    return p->bytes + (size_t)p->channels * ((size_t)j * (size_t)p->width + (size_t)i);
}

/* The largest difference between the mean colours of the middle ninths of two pictures of a size */
static double middle(const picture *a, const picture *b)
{
    const int n = (a->width / 3) * (a->height / 3);
    double most = 0;
    for (int k = 0; k < 3; k++) {
        double sum = 0;
        for (int i = 0; i < n; i++) {
            size_t x = (size_t)(a->width / 3 + i % (a->width / 3));
            size_t y = (size_t)(a->height / 3 + i / (a->width / 3));
            size_t place = (size_t)a->channels * (y * (size_t)a->width + x) + (size_t)k;
            sum += (double)a->bytes[place] - b->bytes[place];
        }
        most = fmax(most, fabs(sum / n));
    }
    return most;
}

int main(int argc, char **argv)
{
    const char *question = argc > 4 ? argv[1] : "";
    picture a, b;
    double v[8] = { 0 };
    if (argc < 5) return 2;
    for (int i = 3; i < argc && i < 11; i++) v[i - 3] = atof(argv[i]);
    if (!strcmp(question, "display"))
        return printf("%d %d %d\n", display(atof(argv[2])), display(v[0]), display(v[1])) < 0;
    a = load(argv[2]);
    if (!strcmp(question, "pixel")) {
        const unsigned char *p = at(&a, v[0], v[1]);
        double most = fmax(fabs(p[0] - v[2]), fmax(fabs(p[1] - v[3]), fabs(p[2] - v[4])));
        printf("%d %d %d, want %g %g %g\n", p[0], p[1], p[2], v[2], v[3], v[4]);
        return most > v[5];
    }
    if (!strcmp(question, "alpha")) {
        printf("%d channels, alpha %d\n", a.channels, at(&a, v[0], v[1])[3]);
        return a.channels != 4 || at(&a, v[0], v[1])[3] != (int)v[2];
    }
    b = load(argv[3]);
    if (!strcmp(question, "area")) {
        double x = (double)area(&a), y = (double)area(&b);
        printf("%g and %g pixels\n", x, y);
        return !(x > 0 && fabs(x - y) <= v[1] * x);
    }
    if (!strcmp(question, "middle") && a.width == b.width && a.height == b.height) {
        printf("differ by %g in the middle\n", middle(&a, &b));
        return middle(&a, &b) > v[1];
    }
    if (a.width == b.width && a.height == b.height && a.channels == b.channels) {
        size_t n = (size_t)a.channels * (size_t)a.width * (size_t)a.height;
        double sum = 0, most = 0;
        for (size_t i = 0; i < n; i++) {
            double d = fabs((double)a.bytes[i] - b.bytes[i]);
            sum += d;
            most = fmax(most, d);
        }
        printf("differ by %g at most, %.4f in the mean\n", most, sum / (double)n);
        return !strcmp(question, "same") ? most > v[1] : sum / (double)n > v[1];
    }
    printf("%d x %d x %d and %d x %d x %d\n", a.width, a.height, a.channels, b.width, b.height,
           b.channels);
    return 2;
}
