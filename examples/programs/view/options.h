/* options.h - the command line of view. */
#ifndef VIEW_OPTIONS_H
#define VIEW_OPTIONS_H

#include "../../kit/command/options.h"
#include "../../kit/scene/scene.h"

/* What a terminal knows of colours: none; the 256 of xterm; any, as 0xRRGGBB.  VIEW_COLORS_ASKED:
   the terminal's own variables say. */
typedef enum view_colors { VIEW_PLAIN, VIEW_256, VIEW_TRUE, VIEW_COLORS_ASKED } view_colors;

/* How pictures are shown: as the terminal answers; by characters, whose cells are divided into so
   many parts; or by pixels. */
typedef enum view_show {
    SHOW_ASKED,
    SHOW_CELLS,
    SHOW_HALVES,
    SHOW_QUADRANTS,
    SHOW_SEXTANTS,
    SHOW_KITTY,
    SHOW_ITERM2,
    SHOW_SIXEL
} view_show;

typedef struct view_options {
    scene_request scene;
    view_colors colors;
    int colors_guessed; /* the terminal's variables say them, not an option */
    view_show show;
    int window;
    int rate, frames; /* frames 0: until the user ends it */
} view_options;

static const char view_usage[] =
    "usage: view [model] [options]                    without a model: the teapot\n"
    "  --window              in a window instead of the terminal\n"
    "  --colors true|256     of the terminal (what COLORTERM and TERM say)\n"
    "  --show WAY            halves, quadrants, sextants, kitty, iterm2 or sixel (the last that\n"
    "                        the terminal says it can): parts of characters, or pixels\n"
    "  --ascii               plain characters, no colors\n"
    "  --still               the model does not turn by itself\n"
    "  --rate N              frames a second at most, 1 .. 240 (30, in a window 60)\n"
    MODEL_USAGE
    "  --frames N            ends after N frames, each 1/rate seconds on, and prints their cost\n"
    "  --help, --version     prints this text; the version\n"
    "The key ? lists the others.\n";

/* Returns OPTION_TAKEN, or 0. */
static inline int view_take_show(view_options *o, const char *value)
{
    static const char *const name[] = {
        "halves", "quadrants", "sextants", "kitty", "iterm2", "sixel"
    };
    const int found = find_name(value, name, 6);
    o->show = (view_show)(SHOW_HALVES + found);
    return found >= 0;
}

/* Stores one option: the option_take of view. */
static inline int view_take(void *to, const char *name, const char *value)
{
    view_options *o = (view_options *)to;
    int taken = name ? model_take(&o->scene.how, name, value) : -1;
    if (taken >= 0) return taken;
    if (!name)
        o->scene.model = value;
    else if (!strcmp(name, "--window"))
        o->window = 1;
    else if (!strcmp(name, "--still"))
        o->scene.still = 1;
    else if (!strcmp(name, "--ascii"))
        o->colors = VIEW_PLAIN;
    else if (!strcmp(name, "--show"))
        return view_take_show(o, value);
    else if (!strcmp(name, "--rate"))
        return option_integer(value, 1, 240, &o->rate);
    else if (!strcmp(name, "--frames"))
        return option_integer(value, 1, 1000000, &o->frames);
    else {
        o->colors = !strcmp(value, "true") ? VIEW_TRUE : VIEW_256;
        return o->colors == VIEW_TRUE || !strcmp(value, "256");
    }
    return OPTION_TAKEN;
}

/* The request to scene_load; without colours the background is black. */
static inline scene_request view_request(const view_options *o)
{
    scene_request request = o->scene;
    request.dark = o->colors == VIEW_PLAIN;
    return request;
}

/* Reads the command line.  Returns what options_read does. */
static inline int view_read_options(view_options *o, int argc, char **argv)
{
    static const char *const valued[] = {
        MODEL_VALUED, "--rate", "--frames", "--colors", "--show", NULL
    };
    static const char *const flags[] = { MODEL_FLAGS, "--window", "--still", "--ascii", NULL };
    static const command view = { "view", view_usage, valued, flags, 0, 1, "", view_take };
    int end = options_read(&view, o, argc, argv);
    if (!o->rate) o->rate = o->window ? 60 : 30;
    return end;
}
#endif
