/* options.h - the command line of thumbnail. */
#ifndef THUMBNAIL_OPTIONS_H
#define THUMBNAIL_OPTIONS_H

#include "../../kit/scene/portrait.h"

/* ---- drawings of parts: --views and what goes with it ---------------------------------------- */

#define DRAWING_USAGE                                                                              \
    "drawings of parts:\n"                                                                         \
    "  --views LIST          a sheet of views: front,right,top,iso or others of back, left,\n"     \
    "                        bottom (1600x1200 unless --size says otherwise)\n"                    \
    "  --angle third|first   where the views stand about the front (third)\n"                      \
    "  --ortho               iso in parallel projection and, where it fits, to the scale of\n"     \
    "                        the other views, which always are\n"                                  \
    "  --edges               draws outlines, edges of more than 25 degrees, and open edges\n"      \
    "  --hidden              the same, and dashed what lies behind, but in iso\n"                  \
    "  --ids                 a colour for each part, and a legend\n"                               \
    "  --dimensions          the size of the box around the model, in the file's units\n"          \
    "  --depth FILE          depth of each pixel, .png or .pgm of 16 bits; 65535: nothing\n"       \
    "  --id-map FILE         part of each pixel, likewise; 0: nothing\n"                           \
    "  --json FILE|-         views, matrices, scales, parts and colours; FILE ends in .json\n"

enum { VIEW_FRONT, VIEW_BACK, VIEW_RIGHT, VIEW_LEFT, VIEW_TOP, VIEW_BOTTOM, VIEW_ISO, VIEW_KINDS };
static const char *const view_names[] = { "front", "back",   "right", "left",
                                          "top",   "bottom", "iso",   NULL };

typedef struct drawing_options {
    int view[VIEW_KINDS], view_count; /* no view: no drawing */
    int first_angle, ortho, edges, hidden, ids, dimensions;
    const char *depth, *id_map, *json;
    const char *needs_views; /* an option that says nothing without --views */
    const char *needs_light; /* an option that says nothing with it */
} drawing_options;

/* Reads the names of views with commas between them; each may come once. */
static inline int drawing_take_views(void *to, const char *text)
{
    drawing_options *d = (drawing_options *)to;
    d->view_count = 0;
    for (;;) {
        size_t n = strcspn(text, ",");
        int kind = 0;
        while (kind < VIEW_KINDS &&
               (strlen(view_names[kind]) != n || strncmp(view_names[kind], text, n) != 0))
            kind++;
        for (int i = 0; i < d->view_count; i++)
            if (d->view[i] == kind) kind = VIEW_KINDS;
        if (kind == VIEW_KINDS) return OPTION_BAD;
        d->view[d->view_count++] = kind;
        if (!text[n]) return OPTION_TAKEN;
        text += n + 1;
    }
}

static inline int drawing_take_angle(void *to, const char *value)
{
    *(int *)to = !strcmp(value, "first");
    return !strcmp(value, "first") || !strcmp(value, "third");
}

/* The name of a file that ends in .png or .pgm */
static inline int drawing_take_map(void *to, const char *value)
{
    static const char *const maps[] = { "png", "pgm", NULL };
    *(const char **)to = value;
    return save_ends_in(value, maps);
}

/* The name of a file that ends in .json, or -, or a device */
static inline int drawing_take_json(void *to, const char *value)
{
    static const char *const json[] = { "json", NULL };
    *(const char **)to = value;
    return !strcmp(value, "-") || save_is_device(value) || save_ends_in(value, json);
}

static const option drawing_option[] = {
    { "--views", drawing_take_views, 0, 0, 0 },
    { "--angle", drawing_take_angle, offsetof(drawing_options, first_angle), 0, 0 },
    { "--depth", drawing_take_map, offsetof(drawing_options, depth), 0, 0 },
    { "--id-map", drawing_take_map, offsetof(drawing_options, id_map), 0, 0 },
    { "--json", drawing_take_json, offsetof(drawing_options, json), 0, 0 },
    { "--ortho", NULL, offsetof(drawing_options, ortho), 1, 0 },
    { "--edges", NULL, offsetof(drawing_options, edges), 1, 0 },
    { "--hidden", NULL, offsetof(drawing_options, hidden), 1, 0 },
    { "--ids", NULL, offsetof(drawing_options, ids), 1, 0 },
    { "--dimensions", NULL, offsetof(drawing_options, dimensions), 1, 0 },
    { NULL, NULL, 0, 0, 0 }
};

/* Keeps the names of options that drawings need, or that say nothing with them. */
static inline void drawing_notice(drawing_options *d, const char *name)
{
    static const char *const lit[] = { "--rotate",    "--model", "--shading", "--material",
                                       "--no-shadow", "--view",  "--quick",   NULL };
    const option *o = drawing_option + 1; /* all but --views */
    while (o->name && strcmp(o->name, name) != 0) o++;
    if (o->name) d->needs_views = name;
    if (option_among(lit, name)) d->needs_light = name;
    d->edges |= d->hidden;
}

/* 1: a file would be written twice. */
static inline int drawing_same_file(const drawing_options *d, const char *sheet)
{
    const char *file[] = { sheet, d->depth, d->id_map, d->json };
    for (int i = 0; i < 4; i++)
        for (int k = 0; k < i; k++)
            if (file[i] && file[k] && !strcmp(file[i], file[k])) return 1;
    return 0;
}

/* Returns 1 where the options do not fit together; a line on stderr has said why. */
static inline int drawing_check(const drawing_options *d, const char *sheet, int transparent)
{
    const char *png = d->depth && save_is_png(d->depth) ? d->depth : d->id_map;
    if (!d->view_count) return d->needs_views ? complain("%s needs --views", d->needs_views) : 0;
    if (d->needs_light) return complain("%s does not go with --views", d->needs_light);
    if (transparent) return complain("--background none does not go with --views");
    if (drawing_same_file(d, sheet)) return complain("two results cannot have the same name");
#ifndef MODEL_STB
    if (png && save_is_png(png))
        return complain("%s: PNG needs a thumbnail built with stb (libstb-dev), PGM does not", png);
#endif
    (void)png;
    return 0;
}

/* ---- pictures -------------------------------------------------------------------------------- */

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
    if (portrait_name(o->output, &o->png) || portrait_check(&o->picture)) return 1;
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
    static const option_group groups[] = { { drawing_option, offsetof(options, drawing), NULL },
                                           { model_option, offsetof(options, how), model_pair },
                                           { portrait_option, offsetof(options, picture),
                                             portrait_pair },
                                           { own, 0, NULL },
                                           { NULL, 0, NULL } };
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
