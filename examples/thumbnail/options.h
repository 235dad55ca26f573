/* options.h - the command line of thumbnail. */
#ifndef THUMBNAIL_OPTIONS_H
#define THUMBNAIL_OPTIONS_H

#include "../model/options.h"
#include "drawing_options.h"
#include "shade.h"

static const char thumbnail_usage[] =
    "usage: thumbnail model picture.ppm|picture.png|- [options]        -: standard output\n"
    "  --size WxH            pixels of the picture, 1x1 .. 8192x8192 (512x512)\n"
    "  --png                 writes PNG, whatever the picture's name is\n"
    "  --background COLOR    RRGGBB, #RGB, black, white, grey, red, green, blue, yellow or\n"
    "                        orange; none: transparent, PNG only (a grey gradient)\n"
    "  --color COLOR         one colour for all surfaces, instead of the file's materials:\n"
    "                        RRGGBB, #RGB or a name\n"
    "  --material NAME       one material for all surfaces: clay, or a name that\n"
    "                        --material list prints\n"
    "  --model NAME          phong, blinn-phong, lambert, ambient, emissive, cool-to-warm\n"
    "                        (blinn-phong)\n"
    "  --shading NAME        fragment, vertex, face (fragment)\n"
    "  --rotate DEG          turns the model about its upright axis, -36000 .. 36000 (30)\n"
    "  --up x|y|z|-x|-y|-z   the model's upright axis (by the kind of file: y; z for STL, 3MF)\n"
    "  --no-shadow           no shadow on the ground\n"
    "  --samples 1|2|4       samples along each edge of a pixel (2)\n"
    "  --threads N           1 .. 256 (one a core); the picture is the same\n"
    "  --max-triangles N     refuses larger models, 0 .. 700000000 (20000000; 0: no limit)\n"
    "  --max-seconds N       gives up after N seconds, 0 .. 1000000000 (0: no limit)\n"
    "  --max-memory N        megabytes, 32 .. 1000000, that the program may ask for (half of the\n"
    "                        machine's)\n"
    "  --quiet               prints errors only, no progress and no warnings\n"
    "  --help, --version     prints this text; the version\n" DRAWING_USAGE;

enum { THUMBNAIL_GRADIENT, THUMBNAIL_PLAIN, THUMBNAIL_NONE }; /* backgrounds */

typedef struct options {
    const char *input, *output;
    int width, height, samples, up; /* up: 0 .. 5 for x y z -x -y -z; -1: by the file */
    int png, quiet, no_shadow, background, plain; /* plain: one material instead of the file's */
    int max_triangles, max_seconds, max_memory, threads; /* threads 0: all cores */
    float rotate; /* radians */
    shade_vec3 background_color;
    shade_material material;
    shade_model model;
    shade_shading shading;
    drawing_options drawing;
} options;

/* 1: the names are equal.  Capitals equal small letters, dashes and underlines equal spaces. */
static int same_name(const char *a, const char *b)
{
    for (;; a++, b++) {
        int x = *a == '-' || *a == '_' ? ' ' : *a, y = *b == '-' || *b == '_' ? ' ' : *b;
        if (x >= 'A' && x <= 'Z') x += 'a' - 'A';
        if (x != y) return 0;
        if (!x) return 1;
    }
}

/* The index of a name in a list of n, or -1 */
static int find_name(const char *name, const char *const *list, int n)
{
    for (int i = 0; i < n; i++)
        if (same_name(name, list[i])) return i;
    return -1;
}

/* Reads an sRGB colour: RRGGBB or RGB, with or without #, or one of a few names. */
static int take_color(const char *text, shade_vec3 *out)
{
    static const char *const names[] = { "black", "white", "gray",   "grey",  "red",
                                         "green", "blue",  "yellow", "orange" };
    static const uint32_t values[] = { 0x000000, 0xFFFFFF, 0x808080, 0x808080, 0xFF0000,
                                       0x008000, 0x0000FF, 0xFFFF00, 0xFFA500 };
    int name = find_name(text, names, 9);
    uint32_t value = 0;
    size_t n = 0;
    if (name >= 0) {
        *out = shade_rgb(values[name]);
        return 1;
    }
    text += *text == '#';
    for (; n < 7 && text[n]; n++) {
        const char *digits = "0123456789abcdef", *at;
        at = strchr(digits, text[n] >= 'A' && text[n] <= 'F' ? text[n] | 32 : text[n]);
        if (!at) return 0;
        value = value << 4 | (uint32_t)(at - digits);
    }
    if (n == 3) value = (value & 0xF00) * 0x1100 | (value & 0xF0) * 0x110 | (value & 0xF) * 0x11;
    *out = shade_rgb(value);
    return n == 3 || n == 6;
}

/* A slightly glossy surface of a linear colour */
static shade_material gloss(shade_vec3 color)
{
    shade_material m = { { 0, 0, 0 }, color, color, { 0.10f, 0.10f, 0.10f }, 50 };
    return m;
}

static shade_material clay(void) { return gloss(shade_v3(0.52f, 0.45f, 0.38f)); }

/* Returns 0 where no material has that name. */
static int find_material(const char *name, shade_material *out)
{
    int i = 0;
    if (same_name(name, "clay")) {
        *out = clay();
        return 1;
    }
    while (i < SHADE_PRESET_COUNT && !same_name(name, shade_preset_name((shade_preset)i))) i++;
    *out = shade_linear_material(shade_preset_material((shade_preset)i));
    return i < SHADE_PRESET_COUNT;
}

static void list_materials(void)
{
    puts("clay");
    for (int m = 0; m < SHADE_PRESET_COUNT; m++) puts(shade_preset_name((shade_preset)m));
}

/* Reads degrees and stores radians. */
static int take_angle(const char *text, float *out)
{
    char *end;
    double degrees = strtod(text, &end);
    *out = (float)(degrees * 0.017453292519943295);
    return end != text && !*end && degrees >= -36000 && degrees <= 36000;
}

/* Stores an option whose value is a name or a colour.  Returns what an option_take does. */
static int take_name(options *o, const char *name, const char *value)
{
    static const char *const models[] = { "blinn phong", "phong",    "lambert",
                                          "ambient",     "emissive", "cool to warm" };
    static const char *const shadings[] = { "fragment", "vertex", "face" };
    int k = 0;
    if (!strcmp(name, "--background")) {
        o->background = same_name(value, "none") ? THUMBNAIL_NONE : THUMBNAIL_PLAIN;
        return o->background == THUMBNAIL_NONE || take_color(value, &o->background_color);
    }
    if (!strcmp(name, "--color")) {
        o->plain = 1;
        o->material = clay();
        k = take_color(value, &o->material.diffuse);
        o->material.ambient = o->material.diffuse;
        return k;
    }
    if (!strcmp(name, "--model")) {
        k = find_name(value, models, 6);
        o->model = (shade_model)(k < 0 ? 0 : k);
    }
    if (!strcmp(name, "--shading")) {
        k = find_name(value, shadings, 3);
        o->shading = (shade_shading)(k < 0 ? 0 : k);
    }
    if (!strcmp(name, "--up")) return option_axis(value, &o->up);
    return k >= 0;
}

/* Stores one option: the option_take of thumbnail. */
static int take(void *to, const char *name, const char *value)
{
    options *o = (options *)to;
    int taken = name ? drawing_take(&o->drawing, name, value) : -1;
    if (taken >= 0) return taken;
    if (!name)
        *(o->input ? &o->output : &o->input) = value;
    else if (!strcmp(name, "--png"))
        o->png = 1;
    else if (!strcmp(name, "--no-shadow"))
        o->no_shadow = 1;
    else if (!strcmp(name, "--quiet"))
        o->quiet = 1;
    else if (!strcmp(name, "--material") && !strcmp(value, "list")) {
        list_materials();
        return OPTIONS_ANSWERED;
    } else if (!strcmp(name, "--material")) {
        o->plain = 1;
        return find_material(value, &o->material);
    } else if (!strcmp(name, "--size"))
        return option_size(value, 8192, &o->width, &o->height);
    else if (!strcmp(name, "--rotate"))
        return take_angle(value, &o->rotate);
    else if (!strcmp(name, "--samples"))
        return option_integer(value, 1, 4, &o->samples) && o->samples != 3;
    else if (!strcmp(name, "--threads"))
        return option_integer(value, 1, 256, &o->threads);
    else if (!strcmp(name, "--max-triangles"))
        return option_integer(value, 0, 700000000, &o->max_triangles);
    else if (!strcmp(name, "--max-seconds"))
        return option_integer(value, 0, 1000000000, &o->max_seconds);
    else if (!strcmp(name, "--max-memory"))
        return option_integer(value, 32, 1000000, &o->max_memory);
    else
        return take_name(o, name, value);
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
    if (drawing_check(&o->drawing, o->output, o->background == THUMBNAIL_NONE)) return 1;
    if (!o->png && ends_in(o->output, others))
        return complain("%s: writes pictures named .ppm or .png alone", o->output);
    if (o->width * o->samples > 16384 || o->height * o->samples > 16384)
        return complain("size times samples must stay within 16384");
    if (o->background == THUMBNAIL_NONE && !o->png)
        return complain("--background none needs PNG: PPM has no transparency");
#ifndef THUMBNAIL_STB
    if (o->png) return complain("PNG needs a thumbnail built with stb (libstb-dev)");
#endif
    return 0;
}

/* Reads the command line.  Returns what options_read does. */
static int read_options(options *o, int argc, char **argv)
{
    static const char *const valued[] = {
        "--size",   "--background", "--color",   "--material", "--model",         "--shading",
        "--rotate", "--up",         "--samples", "--threads",  "--max-triangles", "--max-seconds",
        "--views",  "--angle",      "--depth",   "--id-map",   "--json",          "--max-memory",
        NULL
    };
    static const char *const flags[] = { "--png",   "--no-shadow", "--quiet",
                                         "--ortho", "--edges",     "--hidden",
                                         "--ids",   "--dimensions", NULL };
    static const command c = { "thumbnail", thumbnail_usage, valued, flags, 2, take };
    int end = options_read(&c, o, argc, argv);
    if (end) return end;
    if (o->output && ends_in_png(o->output)) o->png = 1;
    return check_options(o) ? OPTIONS_WRONG : OPTIONS_READ;
}
#endif
