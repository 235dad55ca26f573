/* display.h - shows a scene in a terminal, by pixels where it takes them, else by characters: sends
   frames as fast as the terminal shows them, and reads keys and mouse. */
#ifndef VIEW_DISPLAY_H
#define VIEW_DISPLAY_H

#include "../../kit/scene/scene.h"
#include "terminal.h"
#include "cells.h"
#include "pixels.h"
#include "words.h"
#include "keep.h"

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

/* 1: questions are worth asking, and do no harm: consoles would show them as text.  A terminal for
   which pixels are asked by name is none of these. */
static inline int terminal_can_answer(const view_options *o)
{
    const char *term = getenv("TERM");
    if (o->show != SHOW_ASKED) return o->show >= SHOW_KITTY;
    if (o->colors != VIEW_PLAIN) return 1;
    return o->colors_guessed && term && (!strncmp(term, "xterm", 5) || !strncmp(term, "mlterm", 6));
}

/* ---- frames --------------------------------------------------------------------------------- */

/* How a picture is drawn while it moves, from the finest way on: with so many samples along the
   edge of a pixel, and, where the terminal shows pixels, these so many times as large */
typedef struct display_level {
    int samples, zoom;
} display_level;
static const display_level display_cells[] = { { 4, 1 }, { 3, 1 }, { 2, 1 }, { 1, 1 } };
static const display_level display_pixels[] = { { 2, 1 }, { 1, 1 }, { 1, 2 },
                                                { 1, 3 }, { 1, 4 }, { 1, 6 } };

typedef struct display {
    scene *scene;
    const view_options *options;
    view_show show; /* SHOW_CELLS, or one of the protocols for pixels */
    terminal_size size;
    terminal_keys keys;
    cell_screen screen;
    pixel_bytes out;
    uint8_t *sent;             /* the picture that is shown; behind it room for the next one */
    size_t sent_size;          /* its bytes; 0: unknown */
    shade_target large, small; /* large: samples times the size of small, to which it is averaged */
    int width, height;         /* of small where it is not zoomed */
    int most, samples, zoom;   /* most: samples that there is room for */
    int level, steady;         /* while it moves, and frames that it could have been finer */
    int help, changed;         /* changed: draw even if nothing turns */
    int dragged;               /* the mouse has changed it */
    int at_rest;               /* the picture is as good as it gets */
    int paced;                 /* frames wait for reports of the terminal */
    int mouse_column, mouse_row;
    keep kept;
    double next, said_until, sent_at, asked_at;
    frame_rate rate;
    int frames;
    size_t bytes, first_bytes;
} display;

static inline void display_free(display *d)
{
    cells_free(&d->screen);
    free(d->out.bytes);
    free(d->sent);
    free(d->large.color);
    free(d->large.depth);
    free(d->small.color);
}

/* The rows that a picture of pixels fills.  Only kitty's leaves the cursor where it is; the others
   would scroll the screen at its end. */
static inline int display_rows(const display *d)
{
    return d->show == SHOW_KITTY || d->size.rows < 2 ? d->size.rows : d->size.rows - 1;
}

static inline display_level display_moving(const display *d)
{
    return d->show == SHOW_CELLS ? display_cells[d->level] : display_pixels[d->level];
}

static inline int display_coarsest(const display *d) { return d->show == SHOW_CELLS ? 3 : 5; }

/* Resizes the pictures; as many samples a pixel as fit into 2 million, for pixels 7 million. */
static inline void display_resize(display *d, terminal_size size)
{
    static const shade_target none;
    const size_t room = d->show == SHOW_CELLS ? 2000000 : 7000000;
    size_t pixels, n = d->show == SHOW_CELLS ? 4 : 3;
    d->size = size;
    d->width = size.columns * cell_forms[d->screen.form].across;
    d->height = size.rows * cell_forms[d->screen.form].down;
    if (d->show != SHOW_CELLS) {
        d->width = size.columns * size.cell_width;
        d->height = display_rows(d) * size.cell_height;
    }
    pixels = (size_t)d->width * (size_t)d->height;
    while (n > 1 && pixels * n * n > room) n--;
    free(d->large.color);
    free(d->large.depth);
    free(d->small.color);
    free(d->sent);
    d->large = d->small = none;
    d->most = (int)n;
    d->small.srgb = 1;
    d->small.color = example_memory(pixels, 4);
    d->large.color = example_memory(pixels * n * n, 16);
    d->large.format = SHADE_FORMAT_RGBA32F;
    d->large.depth = (float *)example_memory(pixels * n * n, sizeof(float));
    d->sent = d->show == SHOW_CELLS ? NULL : (uint8_t *)example_memory(pixels, 6);
    d->sent_size = 0;
    d->level = d->show == SHOW_CELLS ? 0 : display_coarsest(d);
    d->steady = 0;
    cells_resize(&d->screen, size.columns, size.rows);
    d->changed = 1;
}

/* A terminal with a name of its own, or one that shows pixels, knows all colours, whatever TERM
   says. */
static inline void display_color(display *d, const terminal_answers *said)
{
    d->screen.colors = d->options->colors;
    if (d->screen.colors != VIEW_PLAIN || !d->options->colors_guessed) return;
    if (!said->parts && d->show == SHOW_CELLS) return;
    d->screen.colors = VIEW_TRUE;
    d->scene->said[0] = 0;
    scene_lighten(d->scene);
}

/* 0: pictures of pixels of this size cannot be shown: kitty takes 10,000 along an edge, sixels have
   their own limit, and memory should not grow beyond what a screen of 4K takes. */
static inline int display_has_room(view_show show, terminal_size size, const terminal_answers *said)
{
    const int width = size.columns * size.cell_width, height = size.rows * size.cell_height;
    if (width > 10000 || height > 10000 || (double)width * height > 9e6) return 0;
    if (show == SHOW_KITTY) return 1;
    if (show == SHOW_SIXEL && said->sixel_width > 0 &&
        (width > said->sixel_width || height > said->sixel_height))
        return 0;
    return size.rows > 1;
}

/* What the terminal has answered that it shows best: pixels, where their size is known */
static inline view_show display_best(const terminal_answers *said, terminal_size size)
{
    if (said->kitty) return SHOW_KITTY;
    if (said->iterm2 && pixels_known(SHOW_ITERM2)) return SHOW_ITERM2;
    if (said->sixel && !said->inner && !terminal_is_inner() && size.cell_known &&
        pixels_known(SHOW_SIXEL))
        return SHOW_SIXEL;
    return SHOW_CELLS;
}

/* 1: pixels were asked for by name, and there is no room for them. */
static inline int display_refuses(const display *d)
{
    return d->options->show >= SHOW_KITTY && d->show == SHOW_CELLS;
}

/* Chooses how pictures are shown: as is asked, else as is best. */
static inline void display_choose(display *d, const terminal_answers *said)
{
    const view_show want = d->options->show;
    terminal_size size = terminal_measure(said);
    d->show = want >= SHOW_KITTY ? want : SHOW_CELLS;
    if (want == SHOW_ASKED) d->show = display_best(said, size);
    if (!display_has_room(d->show, size, said)) d->show = SHOW_CELLS;
    display_color(d, said);
    if (d->frames && display_refuses(d)) strcpy(d->scene->said, "no room for pixels");
    d->screen.form = CELL_HALVES;
    if (want == SHOW_SEXTANTS || (want == SHOW_ASKED && said->parts == 6))
        d->screen.form = CELL_SEXTANTS;
    if (want == SHOW_QUADRANTS || (want == SHOW_ASKED && said->parts == 4))
        d->screen.form = CELL_QUADRANTS;
    if (!terminal_has_blocks()) d->screen.form = CELL_WHOLE;
    if (d->screen.colors == VIEW_PLAIN) {
        d->screen.form = CELL_HALVES;
        d->show = SHOW_CELLS;
    }
    display_resize(d, size);
}

/* How finely the next picture is drawn */
static inline void display_refine(display *d)
{
    const display_level level = display_moving(d);
    d->samples = d->at_rest || level.samples > d->most ? d->most : level.samples;
    d->zoom = d->at_rest ? 1 : d->help && level.zoom > 2 ? 2 : level.zoom;
    d->small.width = (d->width + d->zoom - 1) / d->zoom;
    d->small.height = (d->height + d->zoom - 1) / d->zoom;
    d->large.width = d->small.width * d->samples;
    d->large.height = d->small.height * d->samples;
}

static inline void display_picture(display *d)
{
    const float across = (float)d->width, down = (float)d->height;
    float aspect = (float)d->size.columns * d->size.shape / (float)(2 * d->size.rows);
    scene_camera camera;
    if (d->show != SHOW_CELLS) aspect = across / down;
    camera = scene_place_camera(d->scene, aspect);
    display_refine(d);
    scene_dim(d->scene);
    scene_trace(d->scene, &camera, d->small.height);
    if (d->at_rest) scene_light(d->scene, &camera, d->width > d->height ? d->width : d->height);
    scene_draw(d->scene, &d->large, &camera, d->samples);
    scene_resolve(d->scene, &d->small, &d->large, d->samples);
    if (d->show == SHOW_CELLS) cells_picture(&d->screen, (const uint8_t *)d->small.color);
}

/* ---- words ----------------------------------------------------------------------------------- */

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

/* Words as pixels, at least 12 of them high */
static inline void display_write(display *d)
{
    const float em = 0.8f * (float)d->size.cell_height / (float)d->zoom;
    words said = { d->scene, em < 12 ? 12 : em, 0, d->help, "? help", scene_ink(d->scene) };
    if (d->size.columns < 20 || d->size.rows < 5) return;
    if (d->scene->turning) said.rate = d->rate.rate;
    words_draw(&said, &d->small);
}

/* ---- bytes ----------------------------------------------------------------------------------- */

/* Terminals that know mode 2026 show all changes in between at once. */
static const char display_begin[] = "\033[?2026h", display_end[] = "\033[?2026l";
static const char display_ask[] = TERMINAL_REPORT;

/* Sends the cells that change.  Returns 1 where the terminal accepts no more. */
static inline int display_send_cells(display *d)
{
    const size_t begin = sizeof display_begin - 1;
    cell_screen *s = &d->screen;
    cells_encode(s);
    if (!s->size) return 0;
    memmove(s->bytes + begin, s->bytes, s->size);
    memcpy(s->bytes, display_begin, begin);
    s->size += begin;
    cells_put(s, display_end, sizeof display_end - 1);
    if (d->paced) cells_put(s, display_ask, sizeof display_ask - 1);
    terminal_asked += d->paced;
    d->bytes += s->size;
    return terminal_write(s->bytes, s->size);
}

/* Takes the colours of the picture to rgb; sixels are never scaled by the terminal, so that their
   pixels are repeated here. */
static inline void display_pack(const display *d, uint8_t *rgb, int repeat)
{
    const uint8_t *pixels = (const uint8_t *)d->small.color;
    const int width = repeat > 1 ? d->width : d->small.width;
    const int height = repeat > 1 ? d->height : d->small.height;
    for (int y = 0; y < height; y++) {
        const uint8_t *row = pixels + 4 * (size_t)(y / repeat) * (size_t)d->small.width;
        for (int x = 0; x < width; x++, rgb += 3) memcpy(rgb, row + 4 * (x / repeat), 3);
    }
}

/* Sends the picture, and below it a row of its last colour where it leaves one free. */
static inline void display_encode(display *d, uint8_t *rgb, int width, int height)
{
    const int rows = display_rows(d);
    const uint8_t *last = rgb + 3 * (size_t)width * (size_t)(height - 1);
    pixel_bytes *out = &d->out;
    out->size = 0;
    /* kitty's pictures are swapped at once anyway, and are too long for its mode */
    if (d->show != SHOW_KITTY) pixels_put(out, display_begin, sizeof display_begin - 1);
    if (!d->sent_size) pixels_print(out, "\033[m\033[2J");
    if (rows < d->size.rows)
        pixels_print(out, "\033[%dH\033[48;2;%d;%d;%dm\033[K\033[m", d->size.rows, last[0], last[1],
                     last[2]);
    if (d->show == SHOW_KITTY)
        pixels_kitty(out, rgb, width, height, d->size.columns, rows);
    else if (d->show == SHOW_ITERM2)
        pixels_iterm2(out, rgb, width, height, d->size.columns, rows);
    else
        pixels_sixel(out, rgb, width, height, d->at_rest);
    if (d->show != SHOW_KITTY) pixels_put(out, display_end, sizeof display_end - 1);
    if (d->paced) pixels_put(out, display_ask, sizeof display_ask - 1);
}

/* Sends the picture if it is another one.  Returns 1 where the terminal accepts no more. */
static inline int display_send_pixels(display *d)
{
    const size_t room = 3 * (size_t)d->width * (size_t)d->height;
    const int repeat = d->show == SHOW_SIXEL ? d->zoom : 1;
    const int width = repeat > 1 ? d->width : d->small.width;
    const int height = repeat > 1 ? d->height : d->small.height;
    const size_t size = 3 * (size_t)width * (size_t)height;
    uint8_t *rgb = d->sent + room;
    display_pack(d, rgb, repeat);
    if (size == d->sent_size && !memcmp(rgb, d->sent, size)) return 0;
    display_encode(d, rgb, width, height);
    memcpy(d->sent, rgb, size);
    d->sent_size = size;
    terminal_pictured = d->show == SHOW_KITTY;
    terminal_asked += d->paced;
    d->bytes += d->out.size;
    return terminal_write(d->out.bytes, d->out.size);
}

/* In motion, chooses a level that keeps the rate: a coarser one after one slow frame, a finer one
   after 30 fast ones. */
static inline void display_keep_pace(display *d, double seconds)
{
    const double step = 1.0 / d->options->rate;
    if (d->at_rest || !(d->scene->turning || d->dragged)) return;
    d->steady = seconds < 0.4 * step ? d->steady + 1 : 0;
    if (seconds > 1.1 * step && d->level < display_coarsest(d)) d->level++;
    if (d->steady < 30 || !d->level) return;
    d->steady = 0;
    d->level--;
}

/* While the model turns, colours of cells may be off by one, which saves half of the bytes.  At
   rest they are exact. */
static inline int display_frame(display *d, double now)
{
    int failed;
    display_picture(d);
    if (d->show == SHOW_CELLS) {
        display_words(d);
        d->screen.slack = d->scene->turning ? 1 : 0;
        failed = display_send_cells(d);
    } else {
        display_write(d);
        failed = display_send_pixels(d);
    }
    display_keep_pace(d, clock_now() - now);
    if (!d->frames++) d->first_bytes = d->bytes;
    d->changed = d->dragged = 0;
    d->sent_at = clock_now();
    frame_rate_count(&d->rate, now);
    return failed;
}

/* ---- keys, mouse, signals -------------------------------------------------------------------- */

/* Dragging turns or, with shift or another button, moves; the wheel zooms. */
static inline void display_mouse(display *d, input in)
{
    const float across = (float)(in.column - d->mouse_column);
    const float down = (float)(in.row - d->mouse_row), row = 2 / (float)d->size.rows;
    const float step = 4.0f / (float)d->size.columns;
    if (in.button & MOUSE_WHEEL)
        scene_zoom(d->scene, in.button & 1 ? 1 / 1.1f : 1.1f);
    else if (in.button & MOUSE_MOVED && in.button & (MOUSE_OTHER | MOUSE_SHIFT))
        scene_move(d->scene, d->size.shape / 2 * row * across, -row * down);
    else if (in.button & MOUSE_MOVED)
        scene_turn(d->scene, step * across, 2 * step * down);
    d->mouse_column = in.column;
    d->mouse_row = in.row;
    d->changed = d->dragged = 1;
}

/* Saves the picture as it is at rest; where characters show it, as one of KEEP_HEIGHT rows. */
static inline void display_keep(display *d)
{
    float aspect = (float)d->size.columns * d->size.shape / (float)(2 * d->size.rows);
    int width = d->width, height = d->height;
    if (d->show == SHOW_CELLS) {
        height = KEEP_HEIGHT;
        width = (int)fmaxf(1, fminf(4 * KEEP_HEIGHT, aspect * (float)height + 0.5f));
    }
    keep_picture(&d->kept, d->scene, width, height);
    d->at_rest = 0;
}

/* Returns 1 where the user ends the program. */
static inline int display_key(display *d, int key)
{
    if (key == 'q' || key == 'Q') return 1;
    if (key == '?' || key == 'h')
        d->help = !d->help;
    else if (key == 'p')
        display_keep(d);
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
        if (in.kind == INPUT_ANSWERS) {
            d->paced = 1;
            display_choose(d, &d->keys.said);
        } else if (in.kind == INPUT_MOUSE)
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
        display_choose(d, &d->keys.said);
        if ((d->show == SHOW_SIXEL || d->keys.said.area_width) && d->frames)
            terminal_ask(); /* the size of a cell */
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

/* Seconds that the first picture waits for the terminal's answers; those that come later change
   what is shown. */
#define DISPLAY_PATIENCE 0.3

/* 1: draw nothing yet. */
static inline int display_waits(const display *d, double now)
{
    return terminal_questioned && !d->frames && now < d->asked_at + DISPLAY_PATIENCE;
}

/* 1: at rest the picture gets better than it is. */
static inline int display_can_rest(const display *d)
{
    return !d->at_rest && (d->samples < d->most || d->zoom > 1 || scene_has_studio(d->scene));
}

/* Seconds without a change after which the picture is drawn with all samples, in the light of the
   studio */
#define DISPLAY_REST 0.25

/* How a program in a terminal ends */
typedef enum display_exit { DISPLAY_DONE, DISPLAY_GONE, DISPLAY_REFUSED } display_exit;

/* Runs until the user ends it, the terminal is gone, or what was asked for cannot be shown. */
static inline display_exit display_run(display *d, const sigset_t *mask)
{
    double step = 1.0 / d->options->rate, before = clock_now();
    for (;;) {
        double now = clock_now();
        display_signals(d, mask);
        if (display_input(d)) return DISPLAY_DONE;
        if (d->scene->said[0] && now > d->said_until) {
            d->scene->said[0] = 0;
            d->changed = 1;
        }
        if (display_waits(d, now)) {
            before = now;
            terminal_wait(d->asked_at + DISPLAY_PATIENCE - now, mask);
        } else if (!d->frames && display_refuses(d)) {
            return DISPLAY_REFUSED;
        } else if (!(d->scene->turning || d->changed || d->options->frames)) {
            before = now;
            if (!display_can_rest(d)) {
                terminal_wait(0.5, mask);
            } else if (now < d->sent_at + DISPLAY_REST || display_behind(d, now)) {
                terminal_wait(DISPLAY_REST, mask);
            } else {
                d->at_rest = 1;
                if (display_frame(d, now)) return DISPLAY_GONE;
            }
        } else if (now < d->next || display_behind(d, now)) {
            terminal_wait(now < d->next ? d->next - now : 0.5, mask);
        } else {
            double passed = d->options->frames ? step : now - before;
            if (d->scene->turning) scene_turn(d->scene, 0.6f * (float)passed, 0);
            d->at_rest = 0;
            if (display_frame(d, now)) return DISPLAY_GONE;
            if (d->frames == d->options->frames) return DISPLAY_DONE;
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
    display_exit end;
    d.scene = s;
    d.options = o;
    d.kept.words = o->words;
    d.paced = 1;
    d.said_until = begin + 6;
    atexit(terminal_leave);
    terminal_catch_all(&mask);
    terminal_enter();
    d.asked_at = clock_now();
    if (terminal_can_answer(o)) terminal_ask();
    end = display_run(&d, &mask);
    terminal_leave();
    keep_tell(&d.kept);
    free(d.kept.told.bytes);
    if (o->frames) display_tell_cost(&d, clock_now() - begin);
    display_free(&d);
    if (end == DISPLAY_REFUSED)
        return complain("--show: the window is too large or too low for pixels");
    return end == DISPLAY_GONE ? complain("the terminal takes no more") : 0;
}
#endif
