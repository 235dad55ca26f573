/* batch.c - long work in pieces: the frames of a turntable, or the strips of a poster, on as many
   machines as there are.

   cc -O2 -pthread -I. examples/batch.c -lm -o batch
   ./batch bunny.obj --pipe | ffmpeg -f image2pipe -framerate 30 -i - -pix_fmt yuv420p bunny.mp4

   A piece is a file that appears whole or not at all; one that is there is not drawn again.  Its
   bits depend on the options alone.  Strips put one behind the other are the poster. */
#define _DEFAULT_SOURCE /* NOLINT: the system's own name, for fileno with -std=c99 */
#define SHADE_IMPLEMENTATION
#include "shade.h"
#include "batch_file.h"
#include "sheet.h"

static const char usage[] =
    "usage: batch [model.obj|.stl|.ply] [options]     without a model: the teapot\n"
    "  --frames N            one turn in N pictures (360)\n"
    "  --strips N            or one picture in N strips\n"
    "  --size WxH            pixels of a picture, up to 262144x262144 (1280x720)\n"
    "  --samples 1..8        along each edge of a pixel (3)\n"
    "  --up y|z              the model's upright axis (y, for STL z)\n"
    "  --threads N           1 .. 256, whatever the cores are (all cores); the same bits\n"
    "  --out FOLDER          for 00000.ppm, 00001.ppm ... (frames, or strips)\n"
    "  --pipe                to standard output instead, one behind the other\n"
    "  --piece K             only this one, 0 .. N-1\n"
    "  --missing             only prints the numbers of those that are not there\n"
    "  --help                this text\n";

typedef struct batch {
    view_options view;
    const char *out;
    int strips, count, width, height, samples; /* strips: or frames */
    int piece, pipe, missing;                  /* piece -1: all */
    scene scene;
    sheet sheet;
} batch;

/* ---- options --------------------------------------------------------------------------------- */

static int read_size(const char *text, int *width, int *height)
{
    char first[8];
    size_t n = strcspn(text, "x");
    if (n >= sizeof first || !text[n]) return 0;
    memcpy(first, text, n), first[n] = 0;
    return view_read_number(first, 1, 262144, width) &&
           view_read_number(text + n + 1, 1, 262144, height);
}

/* Returns 0 where the value is none of its. */
static int set_option(batch *b, const char *name, const char *value)
{
    if (!strcmp(name, "--size")) return read_size(value, &b->width, &b->height);
    if (!strcmp(name, "--samples")) return view_read_number(value, 1, 8, &b->samples);
    if (!strcmp(name, "--piece")) return view_read_number(value, 0, 99999, &b->piece);
    if (!strcmp(name, "--up") || !strcmp(name, "--threads"))
        return view_set_option(&b->view, name, value);
    if (!strcmp(name, "--out")) {
        b->out = value;
        return *value && strlen(value) < 4096;
    }
    b->strips = !strcmp(name, "--strips");
    return view_read_number(value, 1, 99999, &b->count);
}

/* 0: go on; 1: failed; -1: all said */
static int read_options(batch *b, int argc, char **argv)
{
    static const char *const valued[8] = { "--size", "--samples", "--piece",  "--up",
                                           "--out",  "--frames",  "--strips", "--threads" };
    for (int i = 1; i < argc; i++) {
        const char *name = argv[i];
        int k = 0;
        while (k < 8 && strcmp(name, valued[k])) k++;
        if (!strcmp(name, "--help")) return fputs(usage, stdout), -1;
        if (k < 8 && i + 1 == argc) return view_complain("%s needs a value", name);
        if (k < 8 && !set_option(b, name, argv[++i]))
            return view_complain("%s cannot be that (--help says what)", name);
        if (k < 8) continue;
        if (!strcmp(name, "--pipe"))
            b->pipe = 1;
        else if (!strcmp(name, "--missing"))
            b->missing = 1;
        else if (!strncmp(name, "--", 2))
            return view_complain("unknown option %s (--help lists them)", name);
        else if (b->view.model)
            return view_complain("one model, not also %s", name);
        else
            b->view.model = name;
    }
    if (!b->out) b->out = b->strips ? "strips" : "frames";
    if (b->piece >= b->count) return view_complain("%s", "no such piece: they count from 0");
    if (b->strips && b->count > b->height) return view_complain("%s", "more strips than rows");
    if (b->pipe && isatty(STDOUT_FILENO))
        return view_complain("%s", "standard output is a terminal, which shows no PPM");
    return 0;
}

/* ---- pieces ---------------------------------------------------------------------------------- */

typedef struct piece {
    int first, rows;
    char header[40], path[4200];
    long long bytes;
} piece;

static piece find_piece(const batch *b, int k)
{
    piece p = { 0, b->height, "", "", 0 };
    if (b->strips) {
        p.first = (int)((long long)b->height * k / b->count);
        p.rows = (int)((long long)b->height * (k + 1) / b->count) - p.first;
    }
    if (p.first == 0) snprintf(p.header, sizeof p.header, "P6\n%d %d\n255\n", b->width, b->height);
    p.bytes = (long long)strlen(p.header) + 3LL * b->width * p.rows;
    snprintf(p.path, sizeof p.path, "%s/%05d.ppm", b->out, k);
    return p;
}

/* Returns 1 where it has complained. */
static int write_piece(batch *b, int k, const piece *p)
{
    FILE *file = b->pipe ? stdout : batch_begin(p->path);
    int failed;
    if (!file) return 1;
    if (!b->strips) b->scene.yaw = -0.5f + 6.2831853f * (float)k / (float)b->count;
    failed = fputs(p->header, file) < 0 || sheet_write(&b->sheet, p->first, p->rows, file);
    if (!b->pipe) return batch_end(file, p->path, failed);
    failed = failed || fflush(file);
    return failed ? view_complain("standard output: %s", strerror(errno)) : 0;
}

/* Model and memory, once there is something to draw.  Returns 1 where it has complained. */
static int get_ready(batch *b)
{
    if (b->sheet.scene) return 0;
    b->view.colors = VIEW_TRUE;
    b->view.pieces = 20;
    while (b->view.pieces < 0.7f * sqrtf((float)b->height)) b->view.pieces++;
    if (!b->pipe && mkdir(b->out, 0777) && errno != EEXIST) {
        fprintf(stderr, "batch: %s: %s\n", b->out, strerror(errno));
        return 1;
    }
    if (scene_load(&b->scene, &b->view, NULL, NULL)) return 1;
    if (!sheet_open(&b->sheet, &b->scene, b->width, b->height, b->samples)) return 0;
    return view_complain("%s", "out of memory");
}

/* All, or the one asked for: those that are not there */
static int write_pieces(batch *b)
{
    int first = b->piece < 0 ? 0 : b->piece, last = b->piece < 0 ? b->count : b->piece + 1;
    batch_clock clock = batch_start(b->strips ? "strips" : "frames");
    int drawn = 0;
    for (int k = first; k < last; k++) {
        piece p = find_piece(b, k);
        int there = !b->pipe && batch_is_whole(p.path, p.header, p.bytes);
        if (b->missing && !there) printf("%05d\n", k);
        if (b->missing) continue;
        if (!there && (get_ready(b) || write_piece(b, k, &p))) return 1;
        drawn += !there;
        if (last - first > 1) batch_tell(&clock, k + 1 - first, last - first, drawn);
    }
    return 0;
}

int main(int argc, char **argv)
{
    static batch b = { .view = { .z_up = -1 },
                       .count = 360,
                       .width = 1280,
                       .height = 720,
                       .samples = 3,
                       .piece = -1 };
    int said;
    view_program = "batch";
    said = read_options(&b, argc, argv);
    if (said) return said > 0;
    said = write_pieces(&b);
    if (b.sheet.scene) sheet_close(&b.sheet);
    scene_close(&b.scene);
    return said;
}
