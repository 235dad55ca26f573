/* options.h - the command line of thumbnail. */
#ifndef THUMBNAIL_OPTIONS_H
#define THUMBNAIL_OPTIONS_H

#include "../model/portrait.h"
#include "drawing_options.h"

static const char thumbnail_usage[] =
    "usage: thumbnail model picture.ppm|picture.png|- [options]        -: standard output\n"
    PORTRAIT_USAGE
    "  --png                 writes PNG, whatever the picture's name is\n"
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

/* 1: the name has a dot and one of the endings, a list up to a NULL, after it. */
static int ends_in(const char *name, const char *const *endings)
{
    const char *dot = strrchr(name, '.');
    for (; dot && *endings; endings++)
        if (same_name(dot + 1, *endings)) return 1;
    return 0;
}

static int ends_in_png(const char *name)
{
    static const char *const png[] = { "png", NULL };
    return ends_in(name, png);
}

/* Returns 1 where the options do not fit together; a line on stderr has said why. */
static int check_options(const options *o)
{
    static const char *const others[] = { "jpg",  "jpeg", "webp", "gif", "bmp",  "tga", "tif",
                                          "tiff", "avif", "jxl",  "svg", "heic", NULL };
    if (!o->output) {
        fputs(thumbnail_usage, stderr);
        return 1;
    }
    if (drawing_check(&o->drawing, o->output, o->picture.background == PORTRAIT_NONE)) return 1;
    if (!o->png && ends_in(o->output, others))
        return complain("%s: writes pictures named .ppm or .png alone", o->output);
    if (portrait_check(&o->picture)) return 1;
    if (o->picture.background == PORTRAIT_NONE && !o->png)
        return complain("--background none needs PNG: PPM has no transparency");
#ifndef MODEL_STB
    if (o->png) return complain("PNG needs a thumbnail built with stb (libstb-dev)");
#endif
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
    static const command c = { "thumbnail", thumbnail_usage, valued, flags, 2, take };
    int end = options_read(&c, o, argc, argv);
    if (end) return end;
    if (o->output && ends_in_png(o->output)) o->png = 1;
    return check_options(o) ? OPTIONS_WRONG : OPTIONS_READ;
}
#endif
