/* compare.c - compares two pictures number by number: are they the same within a tolerance?

   cc -O2 -pthread -I. examples/programs/compare/compare.c -lm -o compare
   ./compare --limit 2 golden.ppm picture.ppm
   ./compare --limit 2 golden.ppm part.stl

   It is made for tests that draw a picture and compare it with one that is kept.  In place of a
   picture may stand a model, which is drawn as thumbnail draws it.  PPM and PGM are read row by
   row, so that a poster takes no more memory than an icon.  With -DMODEL_STB and stb installed, it
   also reads PNG, with alpha and 16 bits, and the other formats of stb, with -DMODEL_ASSIMP and
   -lassimp the models of assimp. */
#define _DEFAULT_SOURCE /* NOLINT: the system's own name, for POSIX with -std=c99 */
#define SHADE_IMPLEMENTATION
#define STBI_FAILURE_USERMSG
#include "shade.h"
#include "../../kit/image/apart.h"
#include "../../kit/scene/portrait.h"

static const char usage[] =
    "usage: compare [options] golden picture      PPM, PGM or, with stb, PNG; -: standard input\n"
    "  --limit N             a channel may differ by N of 255 (0)\n"
    "  --count N|N%          N pixels, or N % of them, may differ by more than the limit (0)\n"
    "  --difference FILE     FILE ends in .ppm or, with stb, .png: golden in grey, differences in\n"
    "                        yellow, those beyond the limit and what only one has in red\n"
    "  --json                prints the numbers as an object of JSON; --quiet prints none\n"
    "  --help, --version     prints this text; the version\n"
    "In place of a picture may stand a model. It is drawn as thumbnail draws it, as large as the\n"
    "picture that it is compared with:\n" PORTRAIT_USAGE MODEL_USAGE
    "  --max-seconds N       gives up after N seconds of processor time, or 4 N by the clock,\n"
    "                        0 .. 1000000000 (0: no limit)\n"
    "Colours count as much as they cover: with alpha 0 any two are the same.\n"
    "exit status: 0 the same within limit and count, 1 different, 2 error\n" MODEL_FORMATS
    "examples:\n"
    "  shade-compare golden.png drawn.png --limit 2 --difference apart.png\n"
    "  shade-compare golden.png bolt.stl --quiet || echo bolt.stl has changed\n";

enum { SAME, DIFFERENT, ERROR };
typedef struct picture {
    const char *name;
    FILE *file;
    int width, height, channels, most, plain;
    uint16_t *whole;      /* RGBA, all of it, where it is no PPM */
    unsigned char *bytes; /* one row as it is stored */
    double *row;          /* one row, RGB times alpha and alpha, 0 .. 255 */
} picture;

/* Prints one line on stderr and returns the exit status for it. */
static int fail(const char *name, const char *what)
{
    complain("%s: %s", name, what);
    return ERROR;
}

/* ---- reading -------------------------------------------------------------------------------- */

/* The next number of a header or of a plain picture; blanks and comments before it and the one
   character after it are skipped.  -1: there is none */
static int number(FILE *f)
{
    int c = getc(f), n = 0;
    while (c == ' ' || (c >= '\t' && c <= '\r') || c == '#') {
        if (c == '#')
            while (c != '\n' && c != EOF) c = getc(f);
        else
            c = getc(f);
    }
    if (c < '0' || c > '9') return -1;
    for (; c >= '0' && c <= '9'; c = getc(f)) n = n < 100000000 ? 10 * n + c - '0' : n;
    return n;
}

static int read_header(picture *p)
{
    int kind = getc(p->file), magic = 0;
    if (kind == EOF) return fail(p->name, ferror(p->file) ? strerror(errno) : "an empty file");
#ifdef MODEL_STB
    if (kind != 'P') {
        ungetc(kind, p->file);
        p->whole = stbi_load_from_file_16(p->file, &p->width, &p->height, &p->channels, 4);
        p->most = 65535;
        return p->whole ? SAME : fail(p->name, stbi_failure_reason());
    }
#endif
    if (kind == 'P') magic = getc(p->file);
    if (magic < '2' || magic > '6' || magic == '4') return fail(p->name, "neither PPM nor PGM");
    p->plain = magic < '5';
    p->channels = magic == '2' || magic == '5' ? 1 : 3;
    p->width = number(p->file);
    p->height = number(p->file);
    p->most = number(p->file);
    if (p->width < 1 || p->height < 1 || p->most < 1 || p->most > 65535)
        return fail(p->name, "a header without width, height and a maximum up to 65535");
    return p->width > 1 << 24 ? fail(p->name, "more than 16777216 pixels in a row") : SAME;
}

/* Room for one row */
static int open_rows(picture *p)
{
    p->bytes = (unsigned char *)malloc((size_t)p->width * 6);
    p->row = (double *)calloc((size_t)p->width * 4, sizeof *p->row);
    return p->bytes && p->row ? SAME : fail(p->name, "out of memory");
}

static int open_picture(picture *p)
{
    p->file = strcmp(p->name, "-") ? path_open(p->name, "rb") : stdin;
    if (!p->file) return fail(p->name, strerror(errno));
    return read_header(p) || open_rows(p) ? ERROR : SAME;
}

static int read_row(picture *p, int y)
{
    int n = p->width * p->channels, wide = p->most > 255;
    const unsigned char *b = p->bytes;
    const uint16_t *rgba = p->whole ? p->whole + 4 * (size_t)p->width * (size_t)y : NULL;
    for (int k = 0; k < 4 * p->width && rgba; k++)
        p->row[k] = 255.0 * rgba[k] / 65535 * (k % 4 < 3 ? rgba[k | 3] / 65535.0 : 1);
    if (rgba) return SAME;
    if (!p->plain && fread(p->bytes, (size_t)(1 + wide), (size_t)n, p->file) < (size_t)n)
        return fail(p->name, ferror(p->file) ? strerror(errno) : "ends too early");
    for (int k = 0; k < n; k++) {
        int v = p->plain ? number(p->file) : wide ? b[2 * k] << 8 | b[2 * k + 1] : b[k];
        if (v < 0) return fail(p->name, "ends too early, or holds what is no number");
        if (v > p->most) return fail(p->name, "a value above its own maximum");
        p->row[k / p->channels * 4 + k % p->channels] = 255.0 * v / p->most;
    }
    for (double *at = p->row; at < p->row + 4 * (size_t)p->width; at += 4) {
        if (p->channels == 1) at[1] = at[2] = at[0];
        at[3] = 255;
    }
    return SAME;
}

/* ---- comparing ------------------------------------------------------------------------------ */

typedef struct result {
    double most, sums[2], beyond; /* sums: of differences, and of their squares */
    int x, y;
} result;

/* Colours one pixel of the difference picture: dim grey where there is no difference, yellow by
   the part of the limit that is used, red by the excess over the limit. */
static void mark(unsigned char *out, const double *golden, double difference, double limit)
{
    double grey = (golden[0] + 2 * golden[1] + golden[2]) / 8;
    double far = difference > limit ? 155 + difference * 100 / 255 : 0;
    double near = difference > limit || difference <= 0 ? 0 : 60 + 120 * difference / limit;
    out[0] = (unsigned char)(near + far + (near + far > 0 ? 0 : grey));
    out[1] = (unsigned char)(near + (near + far > 0 ? 0 : grey));
    out[2] = (unsigned char)(near + far > 0 ? 0 : grey);
}

typedef struct comparison {
    picture *a, *b;
    double limit;
    result *result;
    int width, height;    /* of the larger one */
    unsigned char *drawn; /* a row of the difference picture, or for PNG all of it */
    int png;
} comparison;

/* A save_writer: writes the rows of a difference picture, which may be NULL. */
static int compare_rows(FILE *difference, const void *data)
{
    const comparison *c = (const comparison *)data;
    picture *a = c->a, *b = c->b;
    result *r = c->result;
    static const double neither[4];
    const size_t row = 3 * (size_t)c->width;
    for (int y = 0; y < c->height; y++) {
        unsigned char *out = c->drawn + (c->png ? row * (size_t)y : 0);
        if ((y < a->height && read_row(a, y)) || (y < b->height && read_row(b, y)))
            return SAVE_SAID;
        for (int x = 0; x < c->width; x++) {
            const double *one = x < a->width && y < a->height ? a->row + 4 * x : NULL;
            const double *other = x < b->width && y < b->height ? b->row + 4 * x : NULL;
            const int both = one && other;
            const double most = both ? apart_pixel(one, other, r->sums) : 255;
            if (most > r->most) {
                r->most = most;
                r->x = x;
                r->y = y;
            }
            r->beyond += most > c->limit;
            mark(out + 3 * x, one ? one : neither, most, both ? c->limit : 0);
        }
        if (difference && !c->png && fwrite(out, 1, row, difference) < row) return 1;
    }
    return SAME;
}

static int compare_into(FILE *file, const void *data)
{
    const comparison *c = (const comparison *)data;
    int failed;
    if (!c->png) fprintf(file, "P6\n%d %d\n255\n", c->width, c->height);
    failed = compare_rows(file, data);
    return failed || !c->png ? failed : picture_write_png(file, c->drawn, c->width, c->height, 3);
}

/* ---- command line --------------------------------------------------------------------------- */

typedef struct options {
    const char *names[2], *difference;
    double limit, count;
    int percent; /* count is a percentage */
    int json;
    int max_seconds;
    portrait portrait;
    model_options how;
} options;

static int take_limit(void *to, const char *value)
{
    return option_number(&value, 0, 255, (double *)to) && !*value;
}

static int take_count(void *to, const char *value)
{
    options *all = (options *)to;
    if (!option_number(&value, 0, 1e18, &all->count)) return OPTION_BAD;
    all->percent = *value == '%';
    return (!all->percent || all->count <= 100) && !value[all->percent];
}

static int take_difference(void *to, const char *value)
{
    static const char *const endings[] = { "ppm", PICTURE_PNG NULL };
    *(const char **)to = value;
    return save_is_device(value) || save_ends_in(value, endings);
}

/* Reads the command line.  Returns what options_read does. */
static int read_options(options *o, int argc, char **argv)
{
    static const option own[] = {
        { "--limit", take_limit, offsetof(options, limit), 0, 0 },
        { "--count", take_count, 0, 0, 0 },
        { "--difference", take_difference, offsetof(options, difference), 0, 0 },
        { "--json", NULL, offsetof(options, json), 1, 0 },
        { "--max-seconds", NULL, offsetof(options, max_seconds), 0, 1000000000 },
        { NULL, NULL, 0, 0, 0 }
    };
    static const option_group groups[] = { { model_option, offsetof(options, how), model_pair },
                                           { portrait_option, offsetof(options, portrait),
                                             portrait_pair },
                                           { own, 0, NULL },
                                           { NULL, 0, NULL } };
    static const command c = { "compare", usage, groups, offsetof(options, names), 2, 2, "", NULL };
    const portrait *as = &o->portrait;
    int end = options_read(&c, o, argc, argv);
    if (end) return end;
    if (!strcmp(o->names[0], "-") && !strcmp(o->names[1], "-"))
        return complain("only one picture can be standard input");
    if ((as->sized || as->rotated || as->samples || as->background) &&
        !model_has_name(o->names[0]) && !model_has_name(o->names[1]))
        return complain("--size, --rotate, --samples and --background need a model");
    for (int i = 0; o->difference && i < 2; i++)
        if (save_same(o->names[i], o->difference))
            return complain("%s is read: it cannot be written as well", o->difference);
    return portrait_check(&o->portrait) ? OPTIONS_WRONG : OPTIONS_READ;
}

/* ---- drawing --------------------------------------------------------------------------------- */

/* Makes a drawn model a picture: the bytes that thumbnail writes. */
static int take_pixels(picture *p, const shade_target *drawn, int clear)
{
    const size_t n = 4 * (size_t)drawn->width * (size_t)drawn->height;
    uint8_t *bytes = picture_bytes(drawn, 4);
    p->whole = (uint16_t *)malloc(n * sizeof *p->whole);
    for (size_t i = 0; bytes && p->whole && i < n; i++)
        p->whole[i] = (uint16_t)(257 * (i % 4 == 3 && !clear ? 255 : bytes[i]));
    free(bytes);
    p->width = drawn->width;
    p->height = drawn->height;
    p->channels = clear ? 4 : 3;
    p->most = 65535;
    return bytes && p->whole ? SAME : fail(p->name, "out of memory");
}

static int draw_model(picture *p, const portrait *as, const model_options *how)
{
    static studio light;
    model m = { 0 };
    canvas c;
    shade_target drawn;
    shade_result wrong;
    int failed = ERROR;
    if (model_open(p->name, how, &m, NULL, NULL)) return ERROR;
    guard_doing = "drawing";
    if (!portrait_prepare(&m, as, how)) {
        wrong = portrait_light(&light, &m, as, how, NULL, NULL);
        c = canvas_try(as->width, as->height, portrait_samples(as));
        if (!c.target.color) wrong = SHADE_ERROR_CAPACITY;
        if (!wrong) wrong = portrait_draw(&c, &m, &light, as, how, NULL, NULL);
        if (wrong) {
            fail(p->name, portrait_says(wrong));
        } else {
            drawn = canvas_finish(&c);
            failed = take_pixels(p, &drawn, as->background == PORTRAIT_NONE);
        }
        free(c.target.color);
        free(c.target.depth);
    }
    studio_close(&light);
    model_free(&m);
    return failed;
}

/* Opens pictures and draws models; a model beside a picture becomes as large. */
static int open_both(picture *p, const options *o)
{
    portrait as = o->portrait;
    for (int i = 0; i < 2; i++) {
        p[i].name = o->names[i];
        if (model_has_name(p[i].name)) continue;
        if (open_picture(&p[i])) return ERROR;
        if (!as.sized) as.width = p[i].width;
        if (!as.sized) as.height = p[i].height;
    }
    for (int i = 0; i < 2; i++) {
        if (p[i].file) continue;
        if (as.width > 8192 || as.height > 8192)
            return fail(p[i].name, "models are drawn up to 8192x8192 pixels");
        if (portrait_check(&as) || draw_model(&p[i], &as, &o->how) || open_rows(&p[i]))
            return ERROR;
    }
    return SAME;
}

/* ---- the answer ------------------------------------------------------------------------------ */

static int print(const comparison *c, const options *o)
{
    const picture *a = c->a, *b = c->b;
    const result *r = c->result;
    const int sized = a->width == b->width && a->height == b->height;
    const int channels = a->channels % 2 && b->channels % 2 ? 3 : 4; /* 2 or 4: with alpha */
    const double pixels = (double)c->width * c->height, square = r->sums[1] / (channels * pixels);
    const double mean = r->sums[0] / (channels * pixels);
    const double allowed = o->percent ? floor(o->count * pixels / 100) : floor(o->count);
    const int status = sized && r->beyond <= allowed ? SAME : DIFFERENT;
    const char *word = status == SAME ? "same" : "different";
    char psnr[40] = "null";
    if (square > 0) snprintf(psnr, sizeof psnr, "%.2f", 10 * log10(255.0 * 255.0 / square));
    if (o->how.quiet) return status;
    if (o->json && sized)
        printf(
            "{\"result\": \"%s\", \"width\": %d, \"height\": %d, \"max\": %.6g, \"x\": %d, "
            "\"y\": %d, \"mean\": %.6g, \"psnr\": %s, \"count\": %.0f, \"pixels\": %.0f, "
            "\"limit\": %g, \"allowed\": %.0f}\n",
            word, a->width, a->height, r->most, r->x, r->y, mean, psnr, r->beyond, pixels, o->limit,
            allowed);
    else if (o->json)
        printf("{\"result\": \"%s\", \"sizes\": [[%d, %d], [%d, %d]]}\n", word, a->width, a->height,
               b->width, b->height);
    if (o->json) return status;
    if (sized) {
        printf("max    %.4g", r->most);
        if (r->most > 0) printf(" at %d,%d", r->x, r->y);
        printf("\nmean   %.4g\nPSNR   %s%s\n", mean, square > 0 ? psnr : "infinite",
               square > 0 ? " dB" : "");
        printf("count  %.0f of %.0f pixels beyond %g, %.0f allowed\n", r->beyond, pixels, o->limit,
               allowed);
    } else {
        printf("size   %d x %d and %d x %d\n", a->width, a->height, b->width, b->height);
    }
    puts(word);
    return status;
}

static int run(picture *p, const options *o)
{
    picture *a = &p[0], *b = &p[1];
    result r = { 0 };
    comparison c = { a, b, o->limit, &r, 0, 0, NULL, 0 };
    int failed = 0;
    if (open_both(p, o)) return ERROR;
    guard_doing = "comparing";
    c.width = a->width > b->width ? a->width : b->width;
    c.height = a->height > b->height ? a->height : b->height;
    c.png = o->difference && save_is_png(o->difference);
    if (o->difference || (a->width == b->width && a->height == b->height)) {
        c.drawn = (unsigned char *)malloc(3 * (size_t)c.width * (c.png ? (size_t)c.height : 1));
        failed = !c.drawn        ? fail(a->name, "out of memory")
                 : o->difference ? save_bytes(o->difference, compare_into, &c)
                                 : compare_rows(NULL, &c);
    }
    free(c.drawn);
    return failed ? ERROR : print(&c, o);
}

int main(int argc, char **argv)
{
    picture p[2] = { 0 };
    options o = { .portrait = portrait_new(), .how = model_options_new() };
    int status;
    path_arguments(&argc, &argv);
    status = read_options(&o, argc, argv);
    guard_status = ERROR;
    if (status) return status == OPTIONS_WRONG ? ERROR : SAME;
    guard_program(o.max_seconds, o.how.max_memory);
    status = run(p, &o);
    if (fflush(stdout) || ferror(stdout)) status = fail("standard output", strerror(errno));
    for (int i = 0; i < 2; i++) {
        if (p[i].file) fclose(p[i].file);
        free(p[i].whole);
        free(p[i].bytes);
        free(p[i].row);
    }
    return status;
}
