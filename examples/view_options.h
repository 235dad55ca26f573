/* view_options.h - the command line of view, and its one line on stderr. */
#ifndef EXAMPLES_VIEW_OPTIONS_H
#define EXAMPLES_VIEW_OPTIONS_H

#include <stdio.h>
#include <stdlib.h>
#include <string.h>

/* Colours are 0xRRGGBB, with VIEW_256 their number, with VIEW_PLAIN none */
typedef enum view_colors { VIEW_PLAIN, VIEW_256, VIEW_TRUE, VIEW_COLORS_ASKED } view_colors;

typedef struct view_options {
    const char *model;       /* NULL: the teapot */
    view_colors colors;      /* VIEW_COLORS_ASKED: of the terminal */
    int window, still, z_up; /* z_up -1: by the kind of file */
    int pieces;              /* of the teapot, along each edge of a patch; 0: 20 */
    int rate, frames;        /* frames 0: until the user ends it */
    int threads;             /* 0: all cores */
} view_options;

static const char view_usage[] =
    "usage: view [model.obj|.stl|.ply] [options]      without a model: the teapot\n"
    "  --window              in a window instead of the terminal\n"
    "  --colors true|256     of the terminal (as COLORTERM and TERM say)\n"
    "  --ascii               plain characters, no colors\n"
    "  --up y|z              the model's upright axis (y, for STL z)\n"
    "  --still               does not turn by itself\n"
    "  --rate N              frames a second at most, 1 .. 240 (30, in a window 60)\n"
    "  --threads N           1 .. 256, whatever the cores are (all cores); the same picture\n"
    "  --frames N            ends after so many frames, each 1/rate further, and tells their cost\n"
    "  --help                this text\n"
    "The key ? lists the others.\n";

/* Who complains */
static const char *view_program = "view";

/* One line, and the exit code for it */
static inline int view_complain(const char *format, const char *what)
{
    fprintf(stderr, "%s: ", view_program);
    fprintf(stderr, format, what);
    fputc('\n', stderr);
    return 1;
}

static inline int view_read_number(const char *text, int lowest, int highest, int *out)
{
    char *end;
    long value = strtol(text, &end, 10);
    *out = (int)value;
    return end != text && !*end && value >= lowest && value <= highest;
}

/* One option and its value.  Returns 0 where the value is none of its. */
static inline int view_set_option(view_options *o, const char *name, const char *value)
{
    if (!strcmp(name, "--rate")) return view_read_number(value, 1, 240, &o->rate);
    if (!strcmp(name, "--threads")) return view_read_number(value, 1, 256, &o->threads);
    if (!strcmp(name, "--frames")) return view_read_number(value, 1, 1000000, &o->frames);
    if (!strcmp(name, "--up")) {
        o->z_up = !strcmp(value, "z");
        return o->z_up || !strcmp(value, "y");
    }
    o->colors = !strcmp(value, "true") ? VIEW_TRUE : VIEW_256;
    return o->colors == VIEW_TRUE || !strcmp(value, "256");
}

/* An option without a value.  Returns 0 where there is no such. */
static inline int view_set_flag(view_options *o, const char *name)
{
    if (!strcmp(name, "--window"))
        o->window = 1;
    else if (!strcmp(name, "--still"))
        o->still = 1;
    else if (!strcmp(name, "--ascii"))
        o->colors = VIEW_PLAIN;
    else
        return 0;
    return 1;
}

/* 0: go on; 1: failed; -1: all said */
static inline int view_read_options(view_options *o, int argc, char **argv)
{
    static const char *const valued[5] = { "--rate", "--frames", "--up", "--colors",
                                           "--threads" };
    for (int i = 1; i < argc; i++) {
        const char *name = argv[i];
        int k = 0;
        while (k < 5 && strcmp(name, valued[k])) k++;
        if (!strcmp(name, "--help")) return fputs(view_usage, stdout), -1;
        if (strncmp(name, "--", 2) && o->model)
            return view_complain("one model, not also %s", name);
        if (strncmp(name, "--", 2)) {
            o->model = name;
        } else if (k < 5) {
            if (++i == argc) return view_complain("%s needs a value", name);
            if (view_set_option(o, name, argv[i])) continue;
            return view_complain("%s cannot be that (--help says what)", name);
        } else if (!view_set_flag(o, name)) {
            return view_complain("unknown option %s (--help lists them)", name);
        }
    }
    if (!o->rate) o->rate = o->window ? 60 : 30;
    return 0;
}
#endif
