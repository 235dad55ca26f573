/* options.h - the command line of thumbnail. */
#ifndef THUMBNAIL_OPTIONS_H
#define THUMBNAIL_OPTIONS_H

#include "../../kit/scene/portrait.h"
#include "drawing_options.h"

static const char thumbnail_usage[] =
    "usage: thumbnail model picture.ppm|picture.png [options]   -: standard input and "
    "output\n" PORTRAIT_USAGE
    "  --png                 writes PNG also to standard output, and under a new name that does\n"
    "                        not say so\n" MODEL_USAGE
    "  --max-seconds N       gives up after N seconds of processor time, or 4 N by the clock,\n"
    "                        0 .. 1000000000 (0: no limit)\n"
    "  --help, --version     prints this text; the version\n" DRAWING_USAGE MODEL_FORMATS
    "examples:\n"
    "  shade-thumbnail bolt.stl bolt.png --size 256x256\n"
    "  shade-thumbnail car.glb car.png --background none --view=30,20\n"
    "  shade-thumbnail part.stl sheet.png --views front,right,top,iso --edges --dimensions\n";

typedef struct options {
    const char *files[2], *input, *output;
    int png, max_seconds;
    portrait picture;
    model_options how;
    drawing_options drawing;
} options;

static void notice(void *to, const char *name) { drawing_notice(&((options *)to)->drawing, name); }

/* Returns 1 where the options do not fit together; a line on stderr has said why. */
static int check_options(options *o)
{
    if (drawing_check(&o->drawing, o->output, o->picture.background == PORTRAIT_NONE)) return 1;
    if (portrait_name(o->output, &o->png) || portrait_check(&o->picture, &o->how)) return 1;
    if (o->picture.background == PORTRAIT_NONE && !o->png)
        return complain("--background none needs PNG: PPM has no transparency");
    o->picture.samples = portrait_samples(&o->picture);
    return 0;
}

/* Reads the command line.  Returns what options_read does. */
static int read_options(options *o, int argc, char **argv)
{
    static const option own[] = { { "--png", NULL, offsetof(options, png), 1, 0 },
                                  { "--max-seconds", NULL, offsetof(options, max_seconds), 0,
                                    1000000000 },
                                  { NULL, NULL, 0, 0, 0 } };
    static const option_group groups[] = { { drawing_option, offsetof(options, drawing) },
                                           { model_option, offsetof(options, how) },
                                           { portrait_option, offsetof(options, picture) },
                                           { own, 0 },
                                           { NULL, 0 } };
    static const command c = { "thumbnail",
                               thumbnail_usage,
                               groups,
                               offsetof(options, files),
                               2,
                               2,
                               "; a call draws one model, --views several views of "
                               "it; shade-sheets calls it for a folder of models",
                               notice };
    int end = options_read(&c, o, argc, argv);
    if (end) return end;
    o->input = o->files[0];
    o->output = o->files[1];
    return check_options(o) ? OPTIONS_WRONG : OPTIONS_READ;
}

static int save_picture(const shade_target *picture, const options *o)
{
    const int clear = o->picture.background == PORTRAIT_NONE;
    const picture_file f = { picture, o->png, clear ? 4 : 3 };
    guard_doing = "writing the picture";
    return save_bytes(o->output, picture_write, &f);
}

/* Returns 1, with a line on stderr, where a result would replace a file that has been read. */
static int check_inputs(const options *o, const model *m)
{
    const char *const results[] = { o->output, o->drawing.depth, o->drawing.id_map };
    for (int i = 0; i < 3; i++)
        if (results[i] && model_has_read(m, o->input, results[i]))
            return complain("%s is read: it cannot be written as well", results[i]);
    return 0;
}
#endif
