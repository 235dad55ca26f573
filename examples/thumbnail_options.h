/* thumbnail_options.h - the command line of thumbnail, and its one line on stderr. */
#ifndef EXAMPLES_THUMBNAIL_OPTIONS_H
#define EXAMPLES_THUMBNAIL_OPTIONS_H

#include "shade.h"
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

static const char thumbnail_usage[] =
    "usage: thumbnail model picture.ppm|picture.png|- [options]        -: standard output\n"
    "  --size WxH            pixels of the picture, 1x1 .. 8192x8192 (512x512)\n"
    "  --png                 PNG whatever the picture's name is\n"
    "  --background COLOR    RRGGBB, or none: transparent, PNG alone (a grey gradient)\n"
    "  --color COLOR         of every surface, in place of the file's materials\n"
    "  --material NAME       clay, or one of those that --material list prints, likewise\n"
    "  --model NAME          phong, blinn-phong, lambert, ambient, emissive, cool-to-warm\n"
    "                        (blinn-phong)\n"
    "  --shading NAME        fragment, vertex, face (fragment)\n"
    "  --rotate DEG          turns the model about its upright axis (30)\n"
    "  --up x|y|z|-x|-y|-z   the model's upright axis (by the kind of file: y, z for STL, 3MF)\n"
    "  --no-shadow           nothing below the model\n"
    "  --samples 1|2|4       samples along each edge of a pixel (2)\n"
    "  --threads N           1 .. 256, whatever the cores are (all cores); the same picture\n"
    "  --max-triangles N     refuses larger models (20000000; 0: no limit)\n"
    "  --max-seconds N       gives up after so long (0: no limit)\n"
    "  --quiet               errors alone, no progress, no warnings\n"
    "  --help                this text\n";

enum { THUMBNAIL_GRADIENT, THUMBNAIL_PLAIN, THUMBNAIL_NONE }; /* backgrounds */

typedef struct options {
    const char *input, *output;
    int width, height, samples, up; /* up: 0 .. 5 for x y z -x -y -z; -1: by the file */
    int png, quiet, no_shadow, background, plain; /* plain: material in place of the file's */
    int max_triangles, max_seconds, threads; /* threads 0: all cores */
    float rotate; /* radians */
    shade_vec3 background_color;
    shade_material material;
    shade_model model;
    shade_shading shading;
} options;

/* One line on stderr, whatever a file's name holds, and the exit code for it */
static int complain(const char *format, const char *what)
{
    char text[1000];
    snprintf(text, sizeof text, format, what);
    for (char *c = text; *c; c++)
        if ((unsigned char)*c < 32) *c = '?';
    fprintf(stderr, "thumbnail: %s\n", text);
    return 1;
}

/* Equal but for letters' case, and dashes or underlines for spaces */
static int same_name(const char *a, const char *b)
{
    for (;; a++, b++) {
        int x = *a == '-' || *a == '_' ? ' ' : *a, y = *b == '-' || *b == '_' ? ' ' : *b;
        if (x >= 'A' && x <= 'Z') x += 'a' - 'A';
        if (x != y) return 0;
        if (!x) return 1;
    }
}

/* The place of name in a list of n, or -1 */
static int find_name(const char *name, const char *const *list, int n)
{
    for (int i = 0; i < n; i++)
        if (same_name(name, list[i])) return i;
    return -1;
}

/* An integer from lowest to highest at *text, which moves behind it */
static int take_integer(const char **text, int lowest, int highest, int *out)
{
    long long value = 0;
    const char *begin = *text;
    for (; **text >= '0' && **text <= '9'; ++*text)
        if (value <= highest) value = value * 10 + (**text - '0');
    *out = (int)value;
    return *text > begin && value >= lowest && value <= highest;
}
static int whole_integer(const char *text, int lowest, int highest, int *out)
{
    return take_integer(&text, lowest, highest, out) && !*text;
}

/* RRGGBB or RGB, with or without #, as a display shows it; and some names */
static int take_color(const char *text, shade_vec3 *out)
{
    static const char *const names[] = { "black", "white", "gray",   "grey",  "red",
                                         "green", "blue",  "yellow", "orange" };
    static const uint32_t values[] = { 0x000000, 0xFFFFFF, 0x808080, 0x808080, 0xFF0000,
                                       0x008000, 0x0000FF, 0xFFFF00, 0xFFA500 };
    int name = find_name(text, names, 9);
    uint32_t value = 0;
    size_t n = 0;
    if (name >= 0) return *out = shade_rgb(values[name]), 1;
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

/* A surface that is a little glossy, of a linear colour */
static shade_material gloss(shade_vec3 color)
{
    shade_material m = { { 0, 0, 0 }, color, color, { 0.10f, 0.10f, 0.10f }, 50 };
    return m;
}
static shade_material clay(void) { return gloss(shade_v3(0.52f, 0.45f, 0.38f)); }

/* Returns 0 where the name is none. */
static int find_material(const char *name, shade_material *out)
{
    int i = 0;
    if (same_name(name, "clay")) return *out = clay(), 1;
    while (i < SHADE_PRESET_COUNT && !same_name(name, shade_preset_name((shade_preset)i))) i++;
    *out = shade_linear_material(shade_preset_material((shade_preset)i));
    return i < SHADE_PRESET_COUNT;
}

enum {
    OPTION_SIZE,
    OPTION_BACKGROUND,
    OPTION_COLOR,
    OPTION_MATERIAL,
    OPTION_MODEL,
    OPTION_SHADING,
    OPTION_ROTATE,
    OPTION_UP,
    OPTION_SAMPLES,
    OPTION_THREADS,
    OPTION_MAX_TRIANGLES,
    OPTION_MAX_SECONDS,
    OPTION_PNG,
    OPTION_NO_SHADOW,
    OPTION_QUIET,
    OPTION_HELP,
    OPTIONS /* from PNG on: no value */
};

/* One option and its value.  Returns 0 where the value is none of its. */
static int set_option(options *o, int option, const char *value)
{
    static const char *const models[] = { "blinn phong", "phong",    "lambert",
                                          "ambient",     "emissive", "cool to warm" };
    static const char *const shadings[] = { "fragment", "vertex", "face" };
    static const char *const axes[] = { "x", "y", "z", " x", " y", " z" }; /* dashes as spaces */
    double degrees;
    char *end;
    int k;
    switch (option) {
    case OPTION_SIZE:
        return take_integer(&value, 1, 8192, &o->width) && *value == 'x' &&
               whole_integer(value + 1, 1, 8192, &o->height);
    case OPTION_BACKGROUND:
        o->background = same_name(value, "none") ? THUMBNAIL_NONE : THUMBNAIL_PLAIN;
        return o->background == THUMBNAIL_NONE || take_color(value, &o->background_color);
    case OPTION_COLOR:
        o->plain = 1, o->material = clay();
        if (!take_color(value, &o->material.diffuse)) return 0;
        o->material.ambient = o->material.diffuse;
        return 1;
    case OPTION_MATERIAL:
        return o->plain = 1, find_material(value, &o->material);
    case OPTION_MODEL:
        k = find_name(value, models, 6);
        if (k >= 0) o->model = (shade_model)k;
        return k >= 0;
    case OPTION_SHADING:
        k = find_name(value, shadings, 3);
        if (k >= 0) o->shading = (shade_shading)k;
        return k >= 0;
    case OPTION_ROTATE:
        degrees = strtod(value, &end);
        o->rotate = (float)(degrees * 0.017453292519943295);
        return end != value && !*end && degrees >= -36000 && degrees <= 36000;
    case OPTION_UP:
        return o->up = find_name(value, axes, 6), o->up >= 0;
    case OPTION_SAMPLES:
        return whole_integer(value, 1, 4, &o->samples) && o->samples != 3;
    case OPTION_THREADS:
        return whole_integer(value, 1, 256, &o->threads);
    case OPTION_MAX_TRIANGLES:
        return whole_integer(value, 0, 700000000, &o->max_triangles);
    default:
        return whole_integer(value, 0, 1000000000, &o->max_seconds);
    }
}

static void list_materials(void)
{
    puts("clay");
    for (int m = 0; m < SHADE_PRESET_COUNT; m++) puts(shade_preset_name((shade_preset)m));
}

static int ends_in_png(const char *name)
{
    size_t n = strlen(name);
    return n > 4 && name[n - 4] == '.' && same_name(name + n - 3, "png");
}

/* 0: go on; 1: failed; -1: all said */
static int read_options(options *o, int argc, char **argv)
{
    static const char *const names[OPTIONS] = { "--size",          "--background",  "--color",
                                                "--material",      "--model",       "--shading",
                                                "--rotate",        "--up",          "--samples",
                                                "--threads",       "--max-triangles",
                                                "--max-seconds",   "--png",         "--no-shadow",
                                                "--quiet",         "--help" };
    char text[80];
    for (int i = 1; i < argc; i++) {
        int k = 0;
        if (strncmp(argv[i], "--", 2)) {
            if (!o->input)
                o->input = argv[i];
            else if (!o->output)
                o->output = argv[i];
            else
                return complain("one argument too many: %s", argv[i]);
            continue;
        }
        while (k < OPTIONS && strcmp(argv[i], names[k])) k++;
        if (k == OPTIONS) return complain("unknown option %s (--help lists them)", argv[i]);
        if (k == OPTION_HELP) return fputs(thumbnail_usage, stdout), -1;
        if (k == OPTION_PNG) o->png = 1;
        if (k == OPTION_NO_SHADOW) o->no_shadow = 1;
        if (k == OPTION_QUIET) o->quiet = 1;
        if (k >= OPTION_PNG) continue;
        if (++i == argc) return complain("%s needs a value", names[k]);
        if (k == OPTION_MATERIAL && !strcmp(argv[i], "list")) return list_materials(), -1;
        if (set_option(o, k, argv[i])) continue;
        snprintf(text, sizeof text, "%s cannot be \"%%s\" (--help says what)", names[k]);
        return complain(text, argv[i]);
    }
    if (!o->output) return fputs(thumbnail_usage, stderr), 1;
    if (o->width * o->samples > 16384 || o->height * o->samples > 16384)
        return complain("%s", "size times samples must stay within 16384");
    o->png |= ends_in_png(o->output);
    if (o->background == THUMBNAIL_NONE && !o->png)
        return complain("%s", "--background none needs PNG: PPM knows no transparency");
#ifndef THUMBNAIL_STB
    if (o->png) return complain("%s", "built without stb (libstb-dev), so without PNG");
#endif
    return 0;
}
#endif
