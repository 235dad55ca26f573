/* cells.h - a picture as the cells of a terminal, and the fewest bytes that change the cells it
   shows into those that it should show.

   A cell holds two pixels, one above the other, as a half block in two colours, or one
   character. */
#ifndef VIEW_CELLS_H
#define VIEW_CELLS_H

#include "../shared/mesh.h"
#include "options.h"
#include <string.h>

typedef struct cell {
    uint32_t upper, lower; /* of a character: its own colour and the one behind it */
    uint32_t glyph;        /* 0: two pixels; else a printable ASCII character */
} cell;

typedef struct cell_screen {
    int columns, rows;
    view_colors colors;
    int slack;               /* a difference of colour components that need not be sent */
    int whole;               /* no half blocks: both pixels get the mean of the two */
    cell *wanted, *shown;    /* columns * rows */
    int known;               /* shown holds what the terminal shows */
    int pen_row, pen_column; /* where the terminal writes next; row -1: unknown */
    uint32_t ink, paper;     /* its two colours; CELL_NONE: unknown */
    char *bytes;             /* room for any frame */
    size_t size;
} cell_screen;

enum { CELL_NONE = 0x7fffffff };
/* A cell costs at most a move, two colours (36 bytes) and a glyph (3); what stands round a frame
   fits into CELL_FRAME. */
enum { CELL_MOVE = 10, CELL_BYTES = CELL_MOVE + 39, CELL_FRAME = 64 };

static inline void cells_resize(cell_screen *s, int columns, int rows)
{
    size_t count = (size_t)columns * (size_t)rows;
    free(s->wanted);
    free(s->bytes);
    s->columns = columns;
    s->rows = rows;
    s->known = 0;
    s->wanted = (cell *)example_memory(2 * count, sizeof(cell));
    s->shown = s->wanted + count;
    s->bytes = (char *)example_memory(CELL_BYTES * count + CELL_FRAME, 1);
}

static inline void cells_free(cell_screen *s)
{
    free(s->wanted);
    free(s->bytes);
}

/* ---- colours -------------------------------------------------------------------------------- */

/* The squared distance of two colours, weighted about as the eye weights components */
static inline int cells_distance(const int *a, const int *b)
{
    static const int weight[3] = { 3, 6, 2 };
    int sum = 0;
    for (int k = 0; k < 3; k++) sum += weight[k] * (a[k] - b[k]) * (a[k] - b[k]);
    return sum;
}

/* The nearest of those xterm colours that are the same on every terminal: 16 .. 231, a cube of 6
   x 6 x 6, and 232 .. 255, greys between its black and its white */
static inline uint32_t cells_nearest(uint32_t rgb)
{
    static const int level[6] = { 0, 95, 135, 175, 215, 255 };
    int color[3], step[3], cube[3], grey[3], g;
    for (int k = 0; k < 3; k++) {
        int c = color[k] = (int)(rgb >> (16 - 8 * k) & 255);
        step[k] = c < 48 ? 0 : c < 115 ? 1 : (c - 35) / 40;
        cube[k] = level[step[k]];
    }
    g = ((3 * color[0] + 6 * color[1] + 2 * color[2]) / 11 - 3) / 10;
    g = g < 0 ? 0 : g > 23 ? 23 : g;
    grey[0] = grey[1] = grey[2] = 8 + 10 * g;
    if (cells_distance(grey, color) < cells_distance(cube, color)) return (uint32_t)(232 + g);
    return (uint32_t)(16 + 36 * step[0] + 6 * step[1] + step[2]);
}

/* Converts a display colour to the colours of the terminal. */
static inline uint32_t cells_color(const cell_screen *s, uint32_t rgb)
{
    if (s->colors == VIEW_PLAIN) return 0;
    return s->colors == VIEW_256 ? cells_nearest(rgb) : rgb;
}

static inline uint32_t cells_pack(const uint8_t *rgba)
{
    return (uint32_t)rgba[0] << 16 | (uint32_t)rgba[1] << 8 | rgba[2];
}

/* ---- characters alone ------------------------------------------------------------------------ */

/* Brightness of two pixels, 0 .. 8 each, as the character whose halves hold about as much ink: rows
   by the upper pixel, columns by the lower one */
static inline uint32_t cells_character(const uint8_t *upper, const uint8_t *lower)
{
    static const char ink[9][10] = {
        " ..~__+++", "`-:~+++uw", "`::;++uuw", "\"!!+|Lyyw", "^^?lx{oep",
        "**?7C%$$&", "**fF55&#Q", "**FF5E##Q", "*FFFPE88@",
    };
    int level[2];
    for (int k = 0; k < 2; k++) {
        const uint8_t *p = k ? lower : upper;
        level[k] = (p[0] * 54 + p[1] * 183 + p[2] * 19) / 7200;
        level[k] = level[k] > 8 ? 8 : level[k];
    }
    return (uint32_t)(unsigned char)ink[level[0]][level[1]];
}

/* ---- from a picture -------------------------------------------------------------------------- */

/* pixels: RGBA8 as displayed, columns by 2 * rows */
static inline void cells_picture(cell_screen *s, const uint8_t *pixels)
{
    for (int y = 0; y < s->rows; y++) {
        for (int x = 0; x < s->columns; x++) {
            const uint8_t *upper = pixels + 4 * ((size_t)(2 * y) * (size_t)s->columns + (size_t)x);
            const uint8_t *lower = upper + 4 * s->columns;
            cell *c = &s->wanted[y * s->columns + x];
            uint32_t a = cells_pack(upper), b = cells_pack(lower);
            if (s->whole) a = b = (a & b) + ((a ^ b) >> 1 & 0x7f7f7f);
            c->upper = cells_color(s, a);
            c->lower = cells_color(s, b);
            c->glyph = s->colors == VIEW_PLAIN ? cells_character(upper, lower) : 0;
        }
    }
}

/* Writes text over the picture; text beyond an edge is cut off.  With CELL_NONE as paper the
   picture stays behind the text.  Bytes that are not printable ASCII become "?". */
static inline void cells_text(cell_screen *s, int column, int row, uint32_t ink, uint32_t paper,
                              const char *text)
{
    if (row < 0 || row >= s->rows) return;
    for (; *text && column < s->columns; text++, column++) {
        cell *c = &s->wanted[row * s->columns + column];
        if (column < 0) continue;
        c->glyph = (uint32_t)(*text >= ' ' && *text <= '~' ? *text : '?');
        if (paper != CELL_NONE) c->lower = cells_color(s, paper);
        c->upper = cells_color(s, ink);
    }
}

/* ---- to bytes -------------------------------------------------------------------------------- */

static inline void cells_put(cell_screen *s, const char *text, size_t size)
{
    memcpy(s->bytes + s->size, text, size);
    s->size += size;
}

static inline void cells_put_number(cell_screen *s, int n)
{
    char digit[12];
    int k = 12;
    do {
        digit[--k] = (char)('0' + n % 10);
        n /= 10;
    } while (n);
    cells_put(s, digit + k, (size_t)(12 - k));
}

/* The colour behind "38;" or "48;" */
static inline void cells_put_color(cell_screen *s, int which, uint32_t color)
{
    cells_put_number(s, which);
    if (s->colors == VIEW_256) {
        cells_put(s, ";5;", 3);
        cells_put_number(s, (int)color);
        return;
    }
    cells_put(s, ";2", 2);
    for (int shift = 16; shift >= 0; shift -= 8) {
        cells_put(s, ";", 1);
        cells_put_number(s, (int)(color >> shift & 255));
    }
}

/* 1: one colour may be shown instead of the other. */
static inline int cells_alike(const cell_screen *s, uint32_t a, uint32_t b)
{
    if (a == b || s->colors != VIEW_TRUE || (a | b) > 0xffffff) return a == b;
    for (int shift = 16; shift >= 0; shift -= 8)
        if (abs((int)(a >> shift & 255) - (int)(b >> shift & 255)) > s->slack) return 0;
    return 1;
}

static inline int cells_same(const cell_screen *s, const cell *a, const cell *b)
{
    return a->glyph == b->glyph && cells_alike(s, a->upper, b->upper) &&
           cells_alike(s, a->lower, b->lower);
}

/* Sets the terminal's two colours, if they differ from these. */
static inline void cells_dip(cell_screen *s, uint32_t ink, uint32_t paper)
{
    int new_ink = ink != s->ink, new_paper = paper != s->paper;
    if (s->colors == VIEW_PLAIN || !(new_ink || new_paper)) return;
    cells_put(s, "\033[", 2);
    if (new_ink) cells_put_color(s, 38, s->ink = ink);
    if (new_ink && new_paper) cells_put(s, ";", 1);
    if (new_paper) cells_put_color(s, 48, s->paper = paper);
    cells_put(s, "m", 1);
}

/* Shows two pixels by an upper or a lower half block, whichever needs fewer new colours; where
   both pixels are alike, by a blank, or by a full block if the ink is like them.  Stores the
   colours that are shown. */
static inline void cells_put_pixels(cell_screen *s, uint32_t *upper, uint32_t *lower)
{
    int upper_ink = cells_alike(s, *upper, s->ink), upper_paper = cells_alike(s, *upper, s->paper);
    int lower_ink = cells_alike(s, *lower, s->ink), lower_paper = cells_alike(s, *lower, s->paper);
    int alike = cells_alike(s, *upper, *lower);
    if (alike && upper_ink && lower_ink && !(upper_paper && lower_paper) && !s->whole) {
        cells_put(s, "\342\226\210", 3);
        *upper = *lower = s->ink;
    } else if (alike) {
        if (!(upper_paper && lower_paper)) cells_dip(s, s->ink, *upper);
        cells_put(s, " ", 1);
        *upper = *lower = s->paper;
    } else if (lower_ink + upper_paper > upper_ink + lower_paper) {
        cells_dip(s, lower_ink ? s->ink : *lower, upper_paper ? s->paper : *upper);
        cells_put(s, "\342\226\204", 3);
        *upper = s->paper;
        *lower = s->ink;
    } else {
        cells_dip(s, upper_ink ? s->ink : *upper, lower_paper ? s->paper : *lower);
        cells_put(s, "\342\226\200", 3);
        *upper = s->ink;
        *lower = s->paper;
    }
}

/* Writes the wanted cell at the pen, and stores what the terminal shows then. */
static inline void cells_put_cell(cell_screen *s)
{
    int at = s->pen_row * s->columns + s->pen_column;
    cell *c = &s->shown[at];
    *c = s->wanted[at];
    if (!c->glyph) {
        cells_put_pixels(s, &c->upper, &c->lower);
    } else {
        char glyph = (char)c->glyph;
        cells_dip(s, glyph == ' ' ? s->ink : c->upper, c->lower);
        cells_put(s, &glyph, 1);
    }
    s->pen_column++;
}

/* Moves the cursor: forward in its row, or to a row and column.  The latter at the edge of a row
   always, because terminals differ there. */
static inline void cells_move(cell_screen *s, int row, int column)
{
    int forward = s->pen_row == row ? column - s->pen_column : 0;
    cells_put(s, "\033[", 2);
    if (forward > 0) {
        if (forward > 1) cells_put_number(s, forward);
        cells_put(s, "C", 1);
    } else {
        if (row) cells_put_number(s, row + 1);
        if (column) {
            cells_put(s, ";", 1);
            cells_put_number(s, column + 1);
        }
        cells_put(s, "H", 1);
    }
    s->pen_row = row;
    s->pen_column = column;
}

/* Moves to the next cell that changes, over the cells between, or by writing those again where
   that is not longer. */
static inline void cells_reach(cell_screen *s, int row, int column)
{
    cell_screen before = *s;
    cell kept[CELL_MOVE], *from;
    size_t move, gap;
    if (s->pen_row == row && s->pen_column == column) return;
    cells_move(s, row, column);
    move = s->size - before.size;
    if (before.pen_row != row || column - before.pen_column > (int)move) return;
    gap = (size_t)(column - before.pen_column);
    from = s->shown + row * s->columns + before.pen_column;
    *s = before;
    memcpy(kept, from, gap * sizeof(cell));
    while (s->pen_column < column && s->size - before.size < move) cells_put_cell(s);
    if (s->pen_column == column && s->size - before.size <= move) return;
    *s = before;
    memcpy(from, kept, gap * sizeof(cell));
    cells_move(s, row, column);
}

/* Fills bytes with the sequence that turns shown into wanted. */
static inline void cells_encode(cell_screen *s)
{
    s->size = 0;
    s->pen_row = -1;
    if (!s->known) {
        s->ink = s->paper = CELL_NONE;
        cells_put(s, "\033[m\033[2J", 7);
    }
    for (int i = 0; i < s->columns * s->rows; i++) {
        if (s->known && cells_same(s, &s->wanted[i], &s->shown[i])) continue;
        cells_reach(s, i / s->columns, i % s->columns);
        cells_put_cell(s);
    }
    s->known = 1;
}
#endif
