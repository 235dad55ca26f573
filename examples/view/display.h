/* display.h - shows a scene in a terminal: sends frames as fast as the terminal shows them, and
   reads keys and mouse. */
#ifndef VIEW_DISPLAY_H
#define VIEW_DISPLAY_H

#include "../model/scene.h"
#include "terminal.h"
#include "cells.h"

/* ---- what the terminal can --------------------------------------------------------------- */

/* NULL: it can show pictures */
static inline const char *terminal_lacks(void)
{
    const char *term = getenv("TERM");
    if (!isatty(STDIN_FILENO)) return "standard input is no terminal (--window needs none)";
    if (!isatty(STDOUT_FILENO)) return "standard output is no terminal (--window needs none)";
    if (!term || !*term || !strcmp(term, "dumb"))
        return "this terminal cannot place its cursor (TERM is unset or dumb)";
    return NULL;
}

/* The colours that the terminal's variables promise.  Some terminals never had fewer than all,
   and over ssh only TERM is set.  GNU screen (STY) passes on the COLORTERM of the terminal
   around it, whose colours it does not have. */
static inline view_colors terminal_colors(void)
{
    static const char *const name[] = {
        "direct", "kitty", "alacritty", "foot", "ghostty", "wezterm"
    };
    const char *color = getenv("COLORTERM"), *term = getenv("TERM");
    if (color && (!strcmp(color, "truecolor") || !strcmp(color, "24bit")))
        return getenv("STY") ? VIEW_256 : VIEW_TRUE;
    if (!term) return VIEW_PLAIN;
    for (size_t k = 0; k < sizeof name / sizeof *name; k++)
        if (strstr(term, name[k])) return VIEW_TRUE;
    return strstr(term, "256color") ? VIEW_256 : VIEW_PLAIN;
}

/* 0 where the locale names another character set than UTF-8; the C locale, which names none, is
   taken for a container without a setting. */
static inline int terminal_has_blocks(void)
{
    static const char *const name[3] = { "LC_ALL", "LC_CTYPE", "LANG" };
    const char *locale = NULL;
    for (int k = 0; k < 3 && !(locale && *locale); k++) locale = getenv(name[k]);
    if (!locale || !*locale || !strcmp(locale, "C") || !strcmp(locale, "POSIX")) return 1;
    return strstr(locale, "UTF-8") || strstr(locale, "utf8") || strstr(locale, "UTF8") ||
           strstr(locale, "utf-8");
}

/* ---- frames --------------------------------------------------------------------------------- */

typedef struct display {
    scene *scene;
    const view_options *options;
    terminal_size size;
    terminal_keys keys;
    cell_screen screen;
    shade_target large, small; /* large: samples times the size of small, to which it is averaged */
    int samples;
    int help, changed; /* changed: draw even if nothing turns */
    int at_rest;       /* the picture is in the light of the studio */
    int paced;         /* frames wait for reports of the terminal */
    int mouse_column, mouse_row;
    double next, said_until, sent_at;
    frame_rate rate;
    int frames;
    size_t bytes, first_bytes;
} display;

static inline void display_free(display *d)
{
    cells_free(&d->screen);
    free(d->large.color);
    free(d->large.depth);
    free(d->small.color);
}

/* Resizes the pictures; as many samples a pixel as fit into 2 million. */
static inline void display_resize(display *d, terminal_size size)
{
    static const shade_target none;
    size_t pixels, n = 4;
    d->size = size;
    pixels = 2 * (size_t)d->size.columns * (size_t)d->size.rows;
    while (n > 1 && pixels * n * n > 2000000) n--;
    free(d->large.color);
    free(d->large.depth);
    free(d->small.color);
    d->large = d->small = none;
    d->samples = (int)n;
    d->small.width = d->size.columns;
    d->small.height = 2 * d->size.rows;
    d->small.srgb = 1;
    d->small.color = example_memory(pixels, 4);
    d->large.width = d->small.width * (int)n;
    d->large.height = d->small.height * (int)n;
    d->large.color = example_memory(pixels * n * n, 16);
    d->large.format = SHADE_FORMAT_RGBA32F;
    d->large.depth = (float *)example_memory(pixels * n * n, sizeof(float));
    cells_resize(&d->screen, d->size.columns, d->size.rows);
    d->changed = 1;
}

static inline void display_picture(display *d)
{
    float aspect = (float)d->size.columns * d->size.shape / (float)(2 * d->size.rows);
    scene_camera camera = scene_place_camera(d->scene, aspect);
    scene_dim(d->scene);
    if (d->at_rest) scene_light(d->scene, &camera, d->small.width);
    scene_draw(d->scene, &d->large, &camera, d->samples);
    scene_resolve(d->scene, &d->small, &d->large, d->samples);
    cells_picture(&d->screen, (const uint8_t *)d->small.color);
}

static inline void display_help(display *d)
{
    int width = 0, row = (d->size.rows - SCENE_HELP) / 2, column;
    char line[80];
    for (int k = 0; k < SCENE_HELP; k++) {
        int n = (int)strlen(scene_help[k]);
        width = n > width ? n : width;
    }
    column = (d->size.columns - width - 4) / 2;
    for (int k = -1; k <= SCENE_HELP; k++) {
        const char *text = k < 0 || k == SCENE_HELP ? "" : scene_help[k];
        snprintf(line, sizeof line, "  %-*s  ", width, text);
        cells_text(&d->screen, column < 0 ? 0 : column, (row < 0 ? 0 : row) + k, SCENE_BOX_INK,
                   SCENE_BOX, line);
    }
}

/* Name and frame rate go above the picture, the effect of the last key and the way to help below
   it, as far as there is room. */
static inline void display_words(display *d)
{
    cell_screen *s = &d->screen;
    uint32_t ink = scene_ink(d->scene);
    char text[80];
    int end;
    if (s->columns < 20 || s->rows < 5) return;
    end = snprintf(text, sizeof text, "%d fps", d->rate.rate);
    if (d->scene->turning && d->rate.rate)
        cells_text(s, s->columns - 1 - end, 0, ink, CELL_NONE, text);
    if (s->columns >= 60) cells_text(s, 1, 0, ink, CELL_NONE, scene_caption(d->scene).text);
    if (s->columns >= 40) cells_text(s, s->columns - 7, s->rows - 1, ink, CELL_NONE, "? help");
    cells_text(s, 1, s->rows - 1, ink, CELL_NONE, d->scene->said);
    if (d->help) display_help(d);
}

/* Sends all changes at once (terminals that know mode 2026 show them at once), and asks for a
   report when they have been shown.  Returns 1 where the terminal accepts no more. */
static inline int display_send(display *d)
{
    static const char begin[] = "\033[?2026h", end[] = "\033[?2026l", ask[] = "\033[5n";
    cell_screen *s = &d->screen;
    cells_encode(s);
    if (!s->size) return 0;
    memmove(s->bytes + sizeof begin - 1, s->bytes, s->size);
    memcpy(s->bytes, begin, sizeof begin - 1);
    s->size += sizeof begin - 1;
    cells_put(s, end, sizeof end - 1);
    if (d->paced) {
        cells_put(s, ask, sizeof ask - 1);
        terminal_asked++;
    }
    d->bytes += s->size;
    return terminal_write(s->bytes, s->size);
}

/* While the model turns, colours may be off by one, which saves half of the bytes.  At rest they
   are exact. */
static inline int display_frame(display *d, double now)
{
    int failed;
    display_picture(d);
    display_words(d);
    d->screen.slack = d->scene->turning ? 1 : 0;
    failed = display_send(d);
    if (!d->frames++) d->first_bytes = d->bytes;
    d->changed = 0;
    d->sent_at = now;
    frame_rate_count(&d->rate, now);
    return failed;
}

/* ---- keys, mouse, signals -------------------------------------------------------------------- */

/* Dragging turns, the wheel zooms. */
static inline void display_mouse(display *d, input in)
{
    float step = 4.0f / (float)d->size.columns;
    if (in.button & MOUSE_WHEEL)
        scene_zoom(d->scene, in.button & 1 ? 1 / 1.1f : 1.1f);
    else if (in.button & MOUSE_MOVED)
        scene_turn(d->scene, step * (float)(in.column - d->mouse_column),
                   2 * step * (float)(in.row - d->mouse_row));
    d->mouse_column = in.column;
    d->mouse_row = in.row;
    d->changed = 1;
}

/* Returns 1 where the user ends the program. */
static inline int display_key(display *d, int key)
{
    if (key == 'q' || key == 'Q') return 1;
    if (key == '?' || key == 'h')
        d->help = !d->help;
    else if (!scene_key(d->scene, key))
        return 0;
    d->said_until = clock_now() + 3;
    d->changed = 1;
    return 0;
}

static inline int display_input(display *d)
{
    for (;;) {
        input in = terminal_next(&d->keys);
        if (in.kind == INPUT_NONE) return 0;
        if (in.kind == INPUT_END) return 1;
        if (in.kind == INPUT_MOUSE)
            display_mouse(d, in);
        else if (display_key(d, in.key))
            return 1;
    }
}

/* Does what signals have asked for. */
static inline void display_signals(display *d, const sigset_t *mask)
{
    terminal_let_in(mask);
    if (terminal_stopped) terminal_stop();
    if (terminal_continued) {
        terminal_continued = 0;
        terminal_enter();
    }
    if (terminal_resized) {
        terminal_resized = 0;
        display_resize(d, terminal_measure());
    }
}

/* Returns 1 where two frames have not been reported as shown: wait.  A terminal that does not
   report within two seconds is not asked again. */
static inline int display_behind(display *d, double now)
{
    if (terminal_asked < 2) return 0;
    if (now - d->sent_at < 2) return 1;
    terminal_asked = 0;
    d->paced = 0;
    return 0;
}

/* Seconds without a change after which the picture is drawn in the light of the studio */
#define DISPLAY_REST 0.25

/* Runs until the user ends it (returns 0) or the terminal is gone (returns 1). */
static inline int display_run(display *d, const sigset_t *mask)
{
    double step = 1.0 / d->options->rate, before = clock_now();
    for (;;) {
        double now = clock_now();
        if (display_input(d)) return 0;
        display_signals(d, mask);
        if (d->scene->said[0] && now > d->said_until) {
            d->scene->said[0] = 0;
            d->changed = 1;
        }
        if (!(d->scene->turning || d->changed || d->options->frames)) {
            before = now;
            if (d->at_rest || !scene_has_studio(d->scene)) {
                terminal_wait(0.5, mask);
            } else if (now < d->sent_at + DISPLAY_REST || display_behind(d, now)) {
                terminal_wait(DISPLAY_REST, mask);
            } else {
                d->at_rest = 1;
                if (display_frame(d, now)) return 1;
            }
        } else if (now < d->next || display_behind(d, now)) {
            terminal_wait(now < d->next ? d->next - now : 0.5, mask);
        } else {
            double passed = d->options->frames ? step : now - before;
            if (d->scene->turning) scene_turn(d->scene, 0.6f * (float)passed, 0);
            d->at_rest = 0;
            if (display_frame(d, now)) return 1;
            if (d->frames == d->options->frames) return 0;
            before = now;
            d->next = fmax(d->next + step, now);
        }
    }
}

static inline void display_tell_cost(const display *d, double seconds)
{
    size_t more = d->frames > 1 ? (size_t)d->frames - 1 : 1;
    fprintf(stderr, "%d frames in %.2f s, the first of %lu bytes, the others of %lu on average\n",
            d->frames, seconds, (unsigned long)d->first_bytes,
            (unsigned long)((d->bytes - d->first_bytes) / more));
}

/* Returns the exit status of the program. */
static inline int show_in_terminal(scene *s, const view_options *o)
{
    static display d;
    sigset_t mask;
    double begin = clock_now();
    int gone;
    d.scene = s;
    d.options = o;
    d.paced = 1;
    d.said_until = begin + 6;
    d.screen.colors = o->colors;
    d.screen.whole = !terminal_has_blocks();
    atexit(terminal_leave);
    terminal_catch_all(&mask);
    terminal_enter();
    gone = display_run(&d, &mask);
    terminal_leave();
    if (o->frames) display_tell_cost(&d, clock_now() - begin);
    display_free(&d);
    return gone ? complain("the terminal takes no more") : 0;
}
#endif
