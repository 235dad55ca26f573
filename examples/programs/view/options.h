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
    char **words;     /* of the command line */
} view_options;

#define VIEW_USAGE_LINE(keys) "  " keys "\n"
static const char view_usage[] =
    "usage: view [model] [options]                    without a model: the teapot\n"
    "  --window              in a window instead of the terminal\n"
    "  --colors true|256     of the terminal (what COLORTERM and TERM say)\n"
    "  --show WAY            halves, quadrants, sextants, kitty, iterm2 or sixel (the last that\n"
    "                        the terminal says it can): parts of characters, or pixels\n"
    "  --ascii               plain characters, no colors\n"
    "  --still               the model does not turn by itself\n"
    "  --rate N              frames a second at most, 1 .. 240 (30, in a window 60)\n" SCENE_USAGE
        MODEL_USAGE
    "  --frames N            ends after N frames, each 1/rate seconds on, and prints their cost\n"
    "  --help, --version     prints this text; the version\n"
    MODEL_FORMATS "keys:\n" SCENE_KEYS(VIEW_USAGE_LINE) "examples:\n"
    "  shade-view bolt.stl\n"
    "  shade-view --window car.glb --view=30,20\n";

static inline int view_take_show(void *to, const char *value)
{
    static const char *const name[] = { "halves", "quadrants", "sextants",
                                        "kitty",  "iterm2",    "sixel" };
    const int found = find_name(value, name, 6);
    *(view_show *)to = (view_show)(SHOW_HALVES + found);
    return found >= 0;
}

static inline int view_take_colors(void *to, const char *value)
{
    *(view_colors *)to = !strcmp(value, "true") ? VIEW_TRUE : VIEW_256;
    return !strcmp(value, "true") || !strcmp(value, "256");
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
    static const option own[] = {
        { "--window", NULL, offsetof(view_options, window), 1, 0 },
        { "--again", scene_take_again, offsetof(view_options, scene.again), 0, 0 },
        { "--still", NULL, offsetof(view_options, scene.still), 1, 0 },
        { "--ascii", NULL, offsetof(view_options, colors), VIEW_PLAIN, 0 },
        { "--colors", view_take_colors, offsetof(view_options, colors), 0, 0 },
        { "--show", view_take_show, offsetof(view_options, show), 0, 0 },
        { "--rate", NULL, offsetof(view_options, rate), 1, 240 },
        { "--frames", NULL, offsetof(view_options, frames), 1, 1000000 },
        { NULL, NULL, 0, 0, 0 }
    };
    static const option_pair pairs[] = {
        { "--ascii", "--colors", 0 },  { "--ascii", "--show", 0 },  { "--ascii", "--window", 0 },
        { "--colors", "--window", 0 }, { "--show", "--window", 0 }, { NULL, NULL, 0 }
    };
    static const option_group groups[] = { { model_option, offsetof(view_options, scene.how),
                                             model_pair },
                                           { own, 0, pairs },
                                           { NULL, 0, NULL } };
    static const command view = { "view", view_usage, groups, offsetof(view_options, scene.model),
                                  0,      1,          "",     NULL };
    int end = options_read(&view, o, argc, argv);
    o->words = argv;
    if (!o->rate) o->rate = o->window ? 60 : 30;
    return end;
}
#endif
