/* options.h - the command line of thumbnail. */
#ifndef THUMBNAIL_OPTIONS_H
#define THUMBNAIL_OPTIONS_H

#include "../../kit/scene/portrait.h"
#include "drawing_options.h"

static const char thumbnail_usage[] =
    "usage: thumbnail model picture.ppm|picture.png [options]   -: standard input and output\n"
    PORTRAIT_USAGE
    "  --png                 writes PNG also to standard output, and under a new name that does\n"
    "                        not say so\n"
    MODEL_USAGE
    "  --max-seconds N       gives up after N seconds, 0 .. 1000000000 (0: no limit)\n"
    "  --help, --version     prints this text; the version\n" DRAWING_USAGE;

typedef struct options {
    const char *input, *output;
    int png, max_seconds;
    portrait picture;
    model_options how;
    drawing_options drawing;
} options;

/* Stores one option: the option_take of thumbnail. */
static int take(void *to, const char *name, const char *value)
{
    options *o = (options *)to;
    int taken = name ? drawing_take(&o->drawing, name, value) : -1;
    if (taken < 0 && name) taken = model_take(&o->how, name, value);
    if (taken < 0 && name) taken = portrait_take(&o->picture, name, value);
    if (taken >= 0) return taken;
    if (!name)
        *(o->input ? &o->output : &o->input) = value;
    else if (!strcmp(name, "--png"))
        o->png = 1;
    else
        return option_integer(value, 0, 1000000000, &o->max_seconds);
    return OPTION_TAKEN;
}

/* Returns 1 where the options do not fit together; a line on stderr has said why. */
static int check_options(options *o)
{
    if (drawing_check(&o->drawing, o->output, o->picture.background == PORTRAIT_NONE)) return 1;
    if (portrait_name(o->output, &o->png) || portrait_check(&o->picture, &o->how)) return 1;
    if (o->picture.background == PORTRAIT_NONE && !o->png)
        return complain("--background none needs PNG: PPM has no transparency");
    return 0;
}

/* Reads the command line.  Returns what options_read does. */
static int read_options(options *o, int argc, char **argv)
{
    static const char *const valued[] = {
        MODEL_VALUED, PORTRAIT_VALUED, "--max-seconds", "--views", "--angle", "--depth", "--id-map",
        "--json",     NULL
    };
    static const char *const flags[] = { MODEL_FLAGS, "--png", "--ortho",      "--edges",
                                         "--hidden",  "--ids", "--dimensions", NULL };
    static const command c = { "thumbnail", thumbnail_usage, valued, flags, 2, 2,
                               "; a call draws one model, --views several views of "
                               "it; shade-sheets calls it for a folder of models",
                               take };
    int end = options_read(&c, o, argc, argv);
    if (end) return end;
    return check_options(o) ? OPTIONS_WRONG : OPTIONS_READ;
}

static int save_picture(const shade_target *picture, const options *o)
{
    const int clear = o->picture.background == PORTRAIT_NONE;
    const portrait_file f = { picture, o->png, clear ? 4 : 3 };
    guard_doing = "writing the picture";
    return save_bytes(o->output, portrait_write, &f);
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
