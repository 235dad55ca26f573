/* batch.c - renders films and posters in pieces, on as many machines as there are: the frames of
   a turntable, or the strips of one large picture.

   cc -O2 -pthread -I. examples/programs/batch/batch.c -lm -o batch
   ./batch bunny.obj --film bunny.mp4

   A piece is a file that appears whole or not at all.  A piece that exists is not drawn again,
   and its bits depend on the model and the options alone, which the file .shade-batch beside the
   pieces names: others are refused there.  The strips in their order, concatenated, are the
   poster. */
#define _DEFAULT_SOURCE /* NOLINT: the system's own name, for fileno with -std=c99 */
#define SHADE_IMPLEMENTATION
#include "shade.h"
#include "film.h"
#include "sheet.h"

static const char usage[] =
    "usage: batch [model] [options]                   without a model: the teapot\n"
    "  --frames N            one turn in N pictures (of a film 360)\n"
    "  --strips N            or one picture in N strips\n"
    "  --size WxH            pixels of a picture, up to 262144x262144 (1280x720)\n"
    "  --samples 1|2|4       samples along each edge of a pixel (2)\n" SCENE_USAGE MODEL_USAGE
    "  --out FOLDER          for 00000.ppm, 00001.ppm ... (frames, or strips); pieces that are\n"
    "                        there stay, and must be of this model and these options\n"
    "  --pipe                to standard output instead, one behind the other\n"
    "  --film FILE           FILE ends in .webp or .mp4: a film, where ffmpeg is installed\n"
    "  --rate N              frames a second of the film, 1 .. 240 (30)\n"
    "  --piece K             only this one, 0 .. N-1\n"
    "  --missing             only prints the numbers of those that are not there\n"
    "  --help, --version     prints this text; the version\n" MODEL_FORMATS
    "examples:\n"
    "  shade-batch bolt.stl --film bolt.mp4 --frames 90 --size 640x360\n"
    "  shade-batch bolt.stl --strips 8 --piece 3 --size 8000x6000     on one of eight machines\n";

typedef struct batch {
    scene_request request;
    const char *out, *film;
    int strips, count, width, height, samples; /* strips: 1 for strips, 0 for frames */
    int piece, pipe, missing, rate;            /* piece -1: all; count 0: not said */
    FILE *sink;                                /* of the pipe or film; NULL: files of their own */
    scene scene;
    float begin;    /* the yaw of the first piece */
    char mark[200]; /* the line in their folder that tells what the pieces are of */
    sheet sheet;
} batch;

/* ---- options --------------------------------------------------------------------------------- */

static int take_film(void *to, const char *value)
{
    *(const char **)to = value;
    return strlen(value) < 4096 && (film_is_webp(value) || film_is_mp4(value));
}

static int take_folder(void *to, const char *value)
{
    *(const char **)to = value;
    return *value && strlen(value) < 4096;
}

static int take_size(void *to, const char *value)
{
    batch *b = (batch *)to;
    return option_size(value, 262144, &b->width, &b->height);
}

static int take_frames(void *to, const char *value)
{
    batch *b = (batch *)to;
    return option_integer(value, 1, 99999, &b->count);
}

static int take_strips(void *to, const char *value)
{
    batch *b = (batch *)to;
    b->strips = 1;
    return option_integer(value, 1, 99999, &b->count);
}

/* Reads the command line.  Returns what options_read does. */
static int read_options(batch *b, int argc, char **argv)
{
    static const option own[] = { { "--again", scene_take_again, offsetof(batch, request.again), 0,
                                    0 },
                                  { "--frames", take_frames, 0, 0, 0 },
                                  { "--strips", take_strips, 0, 0, 0 },
                                  { "--film", take_film, offsetof(batch, film), 0, 0 },
                                  { "--out", take_folder, offsetof(batch, out), 0, 0 },
                                  { "--size", take_size, 0, 0, 0 },
                                  { "--samples", option_samples, offsetof(batch, samples), 0, 0 },
                                  { "--piece", NULL, offsetof(batch, piece), 0, 99999 },
                                  { "--rate", NULL, offsetof(batch, rate), 1, 240 },
                                  { "--pipe", NULL, offsetof(batch, pipe), 1, 0 },
                                  { "--missing", NULL, offsetof(batch, missing), 1, 0 },
                                  { NULL, NULL, 0, 0, 0 } };
    static const option_pair pairs[] = {
        { "--frames", "--strips", 0 }, { "--film", "--strips", 0 },
        { "--film", "--pipe", 0 },     { "--film", "--missing", 0 },
        { "--film", "--piece", 0 },    { "--film", "--out", 0 },
        { "--pipe", "--out", 0 },      { "--pipe", "--missing", 0 },
        { "--rate", "--film", 1 },     { NULL, NULL, 0 }
    };
    static const option_group groups[] = { { model_option, offsetof(batch, request.how),
                                             model_pair },
                                           { own, 0, pairs },
                                           { NULL, 0, NULL } };
    static const command c = { "batch", usage, groups, offsetof(batch, request.model),
                               0,       1,     "",     NULL };
    int end = options_read(&c, b, argc, argv);
    if (end) return end;

    if (!b->count && !b->film)
        return complain("what shall it make? --frames 360, --strips N or --film FILE");
    if (!b->count) b->count = 360;
    if (!b->out) b->out = b->strips ? "strips" : "frames";
    if (b->piece >= b->count)
        return complain("there is no piece %d: they count from 0 to %d", b->piece, b->count - 1);
    if (b->strips && b->count > b->height) return complain("more strips than rows");
    if (b->film && film_is_mp4(b->film) && (b->width % 2 || b->height % 2))
        return complain("--size %dx%d: MP4 needs even numbers", b->width, b->height);
    if (b->pipe && batch_is_terminal(stdout))
        return complain("standard output is a terminal, which shows no PPM");
    if (b->pipe) b->sink = stdout;
    return OPTIONS_READ;
}

/* ---- pieces ---------------------------------------------------------------------------------- */

typedef struct batch_piece {
    int first, rows;
    char header[40], path[4200];
    long long bytes;
} batch_piece;

static batch_piece find_piece(const batch *b, int k)
{
    batch_piece p = { 0, b->height, "", "", 0 };
    if (b->strips) {
        p.first = (int)((long long)b->height * k / b->count);
        p.rows = (int)((long long)b->height * (k + 1) / b->count) - p.first;
    }
    if (p.first == 0) snprintf(p.header, sizeof p.header, "P6\n%d %d\n255\n", b->width, b->height);
    p.bytes = (long long)strlen(p.header) + 3LL * b->width * p.rows;
    snprintf(p.path, sizeof p.path, "%s/%05d.ppm", b->out, k);
    return p;
}

/* 1: the folder is marked as that of these pieces. */
static int is_marked(const batch *b)
{
    char path[4200];
    snprintf(path, sizeof path, "%s/.shade-batch", b->out);
    return batch_is_whole(path, b->mark, (long long)strlen(b->mark));
}

static int refuse_folder(const batch *b)
{
    return complain(
        "%s: holds pieces of another model or of other options: remove them, or "
        "choose another --out",
        b->out);
}

/* Returns 1 where it has complained. */
static int write_piece(batch *b, int k, const batch_piece *p)
{
    FILE *file = b->sink ? b->sink : save_begin(p->path);
    int failed;
    if (!file) return 1;
    if (!b->strips) b->scene.yaw = b->begin + 6.2831853f * (float)k / (float)b->count;
    sheet_light(&b->sheet, &b->scene);
    failed = fputs(p->header, file) < 0 || sheet_write(&b->sheet, p->first, p->rows, file);
    /* as long as there is no piece, another job may take the folder */
    if (!b->sink && !failed && !is_marked(b) && refuse_folder(b)) failed = SAVE_SAID;
    if (!b->sink) return save_end(file, p->path, failed);
    failed = failed || fflush(file);
    if (b->film) return failed; /* film_close tells why */
    return failed ? complain("standard output: %s", strerror(errno)) : 0;
}

/* Returns 1 with a line on stderr. */
static int load(batch *b)
{
    b->request.pieces = 20;
    while ((float)b->request.pieces < 0.7f * sqrtf((float)b->height)) b->request.pieces++;
    if (scene_load(&b->scene, &b->request, NULL, NULL)) return 1;
    b->begin = b->scene.yaw;
    return 0;
}

/* Gets memory, before the first piece is drawn.  Returns 1 with a line on stderr. */
static int get_ready(batch *b)
{
    if (b->sheet.scene) return 0;
    if (!sheet_open(&b->sheet, &b->scene, b->width, b->height, b->samples)) return 0;
    complain("out of memory");
    return 1;
}

/* Writes the mark: what the pieces are drawn of and with.  Threads and limits leave no trace in a
   picture. */
static void describe(batch *b)
{
    const model_options *o = &b->scene.how;
    const int words[] = {
        o->up,         o->plain,   o->no_shadow,      o->quick,        o->viewed,
        (int)o->model, o->section, o->section_placed, (int)o->shading, o->outside
    };
    const scene *s = &b->scene;
    const float numbers[] = { o->azimuth, o->elevation, o->zoom, (float)o->section_at,
                              b->begin,   s->pitch,     s->zoom, s->place.x,
                              s->place.y };
    uint64_t mark = mark_of_model(&b->scene.model);
    mark = mark_words(mark, words, sizeof words / sizeof *words);
    mark = mark_words(mark, s->choice, CHOICES);
    mark = mark_words(mark, numbers, sizeof numbers / sizeof *numbers);
    mark = mark_words(mark, &o->material, sizeof o->material / 4);
    snprintf(b->mark, sizeof b->mark,
             "shade-batch %d: %d %s of %dx%d, samples %d, model and options %08lx%08lx\n",
             SHADE_VERSION, b->count, b->strips ? "strips" : "frames", b->width, b->height,
             b->samples, (unsigned long)(mark >> 32), (unsigned long)(mark & 0xFFFFFFFF));
}

/* Refuses a folder with pieces of another model or of other options.  A line in it tells, which the
   first of all jobs writes before its first piece.  Returns 1 with a line on stderr. */
static int claim(batch *b)
{
    char path[4200];
    int known = 0;
    FILE *file;
    describe(b);
    snprintf(path, sizeof path, "%s/.shade-batch", b->out);
    for (int k = 0; k <= b->count && !known; k++) { /* one more: of a longer film */
        file = path_open(find_piece(b, k).path, "rb");
        known = file != NULL;
        if (file) fclose(file);
    }
    if (is_marked(b)) return 0;
    if (known) return refuse_folder(b);
    if (b->missing) return 0;
    if (batch_folder(b->out) && errno != EEXIST) return complain("%s: %s", b->out, strerror(errno));
    file = save_begin(path);
    return !file || save_end(file, path, fputs(b->mark, file) < 0);
}

/* Draws those of all pieces, or of the one piece of the command line, that are missing. */
static int write_pieces(batch *b)
{
    int first = b->piece < 0 ? 0 : b->piece, last = b->piece < 0 ? b->count : b->piece + 1;
    batch_clock clock = batch_start(b->strips ? "strips" : "frames");
    int drawn = 0;
    if (!b->sink && claim(b)) return 1;
    for (int k = first; k < last; k++) {
        batch_piece p = find_piece(b, k);
        int there = !b->sink && batch_is_whole(p.path, p.header, p.bytes);
        if (b->missing && !there) printf("%05d\n", k);
        if (b->missing) continue;
        if (!there && (get_ready(b) || write_piece(b, k, &p))) return 1;
        drawn += !there;
        if (last - first > 1) batch_tell(&clock, k + 1 - first, last - first, drawn);
    }
    return b->missing && options_answered() == OPTIONS_WRONG;
}

static int write_film(batch *b, const char *path)
{
    film f = { .path = path };
    int failed = get_ready(b) || film_open(&f, b->rate);
    if (failed) return failed;
    b->sink = f.encoder.input;
    return film_close(&f, write_pieces(b));
}

int main(int argc, char **argv)
{
    static batch b = { .width = 1280, .height = 720, .samples = 2, .piece = -1, .rate = 30 };
    int end;
    path_arguments(&argc, &argv);
    b.request.how = model_options_new();
    end = read_options(&b, argc, argv);
    if (end) return end == OPTIONS_WRONG;
    guard_interrupts();
    end = load(&b);
    guard_doing = "drawing";
    end = end || (b.film ? write_film(&b, b.film) : write_pieces(&b));
    if (b.sheet.scene) sheet_close(&b.sheet);
    scene_close(&b.scene);
    return end;
}
