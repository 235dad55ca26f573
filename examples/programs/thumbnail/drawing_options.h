/* drawing_options.h - the options of drawings of parts: --views and what goes with it. */
#ifndef THUMBNAIL_DRAWING_OPTIONS_H
#define THUMBNAIL_DRAWING_OPTIONS_H

#include "../../kit/command/save.h"

#define DRAWING_USAGE                                                                            \
    "drawings of parts:\n"                                                                       \
    "  --views LIST          a sheet of views: front,right,top,iso or others of back, left,\n"   \
    "                        bottom (1600x1200 unless --size says otherwise)\n"                  \
    "  --angle third|first   where the views stand about the front (third)\n"                    \
    "  --ortho               iso in parallel projection and, where it fits, to the scale of\n"   \
    "                        the other views, which always are\n"                                \
    "  --edges               draws outlines, edges of more than 25 degrees, and open edges\n"    \
    "  --hidden              the same, and dashed what lies behind, but in iso\n"                \
    "  --ids                 a colour for each part, and a legend\n"                             \
    "  --dimensions          the size of the box around the model, in the file's units\n"        \
    "  --depth FILE          depth of each pixel, .png or .pgm of 16 bits; 65535: nothing\n"     \
    "  --id-map FILE         part of each pixel, likewise; 0: nothing\n"                         \
    "  --json FILE|-         views, matrices, scales, parts and colours; FILE ends in .json\n"

enum { VIEW_FRONT, VIEW_BACK, VIEW_RIGHT, VIEW_LEFT, VIEW_TOP, VIEW_BOTTOM, VIEW_ISO, VIEW_KINDS };
static const char *const view_names[] = { "front", "back",   "right", "left",
                                          "top",   "bottom", "iso",   NULL };

typedef struct drawing_options {
    int view[VIEW_KINDS], view_count; /* no view: no drawing */
    int first_angle, ortho, edges, hidden, ids, dimensions, sized;
    const char *depth, *id_map, *json;
    const char *needs_views; /* an option that says nothing without --views */
    const char *needs_light; /* an option that says nothing with it */
} drawing_options;

/* Reads the names of views with commas between them; each may come once. */
static inline int drawing_views(drawing_options *d, const char *text)
{
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

/* 1: the file's name ends in .png or .pgm; in .json, or it is - or a device. */
static inline int drawing_is_map(const char *name)
{
    static const char *const maps[] = { "png", "pgm", NULL };
    return save_ends_in(name, maps);
}

static inline int drawing_is_json(const char *name)
{
    static const char *const json[] = { "json", NULL };
    return !strcmp(name, "-") || save_is_device(name) || save_ends_in(name, json);
}

/* Stores an option of drawings.  Returns what an option_take does, or -1 where the option is
   another's. */
static inline int drawing_take(drawing_options *d, const char *name, const char *value)
{
    static const char *const lit[] = { "--rotate",  "--model",     "--shading",
                                       "--material", "--no-shadow", "--view",
                                       "--quick",    NULL };
    int taken = OPTION_TAKEN;
    if (option_among(lit, name)) d->needs_light = name;
    if (!strcmp(name, "--size")) d->sized = 1;
    if (!strcmp(name, "--views")) return drawing_views(d, value);
    if (!strcmp(name, "--angle")) {
        d->first_angle = !strcmp(value, "first");
        taken = d->first_angle || !strcmp(value, "third");
    } else if (!strcmp(name, "--ortho")) {
        d->ortho = 1;
    } else if (!strcmp(name, "--edges")) {
        d->edges = 1;
    } else if (!strcmp(name, "--hidden")) {
        d->edges = d->hidden = 1;
    } else if (!strcmp(name, "--ids")) {
        d->ids = 1;
    } else if (!strcmp(name, "--dimensions")) {
        d->dimensions = 1;
    } else if (!strcmp(name, "--depth")) {
        d->depth = value;
        taken = drawing_is_map(value);
    } else if (!strcmp(name, "--id-map")) {
        d->id_map = value;
        taken = drawing_is_map(value);
    } else if (!strcmp(name, "--json")) {
        d->json = value;
        taken = drawing_is_json(value);
    } else {
        return -1;
    }
    d->needs_views = name;
    return taken;
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
        return complain("%s: PNG needs a thumbnail built with stb (libstb-dev), PGM does not",
                        png);
#endif
    (void)png;
    return 0;
}
#endif
