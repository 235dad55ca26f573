/* cells.h - a picture as the cells of a terminal, and the fewest bytes that change the cells it
   shows into those that it should show.

   A cell shows one character in two colours, ink and paper.  For pixels this is the block
   character whose filled parts are the pixels that are nearer to the ink. */
#ifndef VIEW_CELLS_H
#define VIEW_CELLS_H

#include "../../shared/mesh.h"
#include "options.h"
#include <string.h>

/* Into how many pixels a cell is divided: one; two, one above the other; 2 x 2; 2 x 3 */
typedef enum cell_form { CELL_WHOLE, CELL_HALVES, CELL_QUADRANTS, CELL_SEXTANTS } cell_form;
static const struct {
    int across, down;
} cell_forms[4] = { { 1, 1 }, { 1, 2 }, { 2, 2 }, { 2, 3 } };

typedef struct cell {
    uint32_t ink, paper;
    uint8_t glyph; /* 0: pixels; else a printable ASCII character */
    uint8_t mask;  /* of pixels, in reading order from bit 0 on: 1 ink, 0 paper */
} cell;

typedef struct cell_screen {
    int columns, rows;
    view_colors colors;
    cell_form form;
    int slack;               /* a difference of colour components that need not be sent */
    cell *wanted, *shown;    /* columns * rows */
    int known;               /* shown holds what the terminal shows */
    int pen_row, pen_column; /* where the terminal writes next; row -1: unknown */
    uint32_t ink, paper;     /* its two colours; CELL_NONE: unknown */
    char *bytes;             /* room for any frame */
    size_t size;
} cell_screen;

enum { CELL_NONE = 0x7fffffff };
/* A cell costs at most a move, two colours (36 bytes) and a glyph (4); what stands round a frame
   fits into CELL_FRAME. */
enum { CELL_MOVE = 11, CELL_BYTES = CELL_MOVE + 40, CELL_FRAME = 64 };

static inline int cells_pixels(const cell_screen *s)
{
    return cell_forms[s->form].across * cell_forms[s->form].down;
}

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

/* The levels of those xterm colours that are the same on every terminal: 16 .. 231 are a cube of
   6 x 6 x 6, and 232 .. 255 greys between its black and its white. */
static const int cells_level[6] = { 0, 95, 135, 175, 215, 255 };

/* About the luma of a colour of sRGB components: weights 3, 6 and 2 elevenths */
static inline int cells_luma(const int *c) { return (3 * c[0] + 6 * c[1] + 2 * c[2]) / 11; }

/* The squared distance of two colours.  A wrong hue counts four times as much as a wrong
   brightness, which the dither mends. */
static inline int cells_distance(const int *a, const int *b)
{
    int luma = cells_luma(a) - cells_luma(b), sum = luma * luma;
    for (int k = 0; k < 3; k++) {
        int chroma = a[k] - b[k] - luma;
        sum += 4 * chroma * chroma;
    }
    return sum;
}

static inline int cells_clamp(int n, int most) { return n < 0 ? 0 : n > most ? most : n; }

/* Two of the 240 whose mixture, part sixteenths of the second, stands for a colour */
typedef struct cell_mixture {
    uint8_t number[2];
    uint8_t part;
} cell_mixture;

/* The colours around one, and their numbers: the cube's eight, and two greys */
static inline void cells_around(const int *color, int around[10][3], uint8_t *number)
{
    const int g = cells_clamp((cells_luma(color) - 8) / 10, 22);
    for (int corner = 0; corner < 8; corner++) {
        number[corner] = 16;
        for (int k = 0; k < 3; k++) {
            static const uint8_t place[3] = { 36, 6, 1 };
            const int step = cells_clamp((color[k] - 55) / 40, 4) + (corner >> k & 1);
            around[corner][k] = cells_level[step];
            number[corner] = (uint8_t)(number[corner] + place[k] * step);
        }
    }
    for (int i = 0; i < 2; i++) {
        number[8 + i] = (uint8_t)(232 + g + i);
        for (int k = 0; k < 3; k++) around[8 + i][k] = 8 + 10 * (g + i);
    }
}

/* The error of the best mixture of two colours: how far it is off, and a share of how far the two
   are apart, so that specks of other hues appear only where nothing else comes near.  With a 24th,
   bronze stays bronze, and greys show no other hue. */
static inline int cells_error(const int *color, const int *a, const int *b, int *part)
{
    int mean[3], along = 0, whole = 0;
    for (int k = 0; k < 3; k++) {
        along += (b[k] - a[k]) * (color[k] - a[k]);
        whole += (b[k] - a[k]) * (b[k] - a[k]);
    }
    *part = whole ? cells_clamp((32 * along + whole) / (2 * whole), 16) : 0;
    for (int k = 0; k < 3; k++) mean[k] = a[k] + (*part * (b[k] - a[k]) + 8) / 16;
    return cells_distance(mean, color) + (*part & 15 ? cells_distance(a, b) / 24 : 0);
}

/* The best mixture for a colour, by trying all */
static inline cell_mixture cells_mix(const int *color)
{
    int around[10][3], best = INT_MAX;
    uint8_t number[10];
    cell_mixture m = { { 0, 0 }, 0 };
    cells_around(color, around, number);
    for (int i = 0; i < 10; i++) {
        for (int j = i; j < 10; j++) {
            int part, error = cells_error(color, around[i], around[j], &part);
            if (error >= best) continue;
            best = error;
            m.number[0] = number[i];
            m.number[1] = number[j];
            m.part = (uint8_t)part;
        }
    }
    return m;
}

/* Which of the 240 stands for a colour at a place: ordered dither by a Bayer matrix.  Mixtures are
   kept for colours of six bits a component. */
static inline uint32_t cells_dither(uint32_t rgb, int x, int y)
{
    static const int bayer[4][4] = {
        { 0, 8, 2, 10 }, { 12, 4, 14, 6 }, { 3, 11, 1, 9 }, { 15, 7, 13, 5 }
    };
    static cell_mixture kept[1 << 18]; /* number 0: not yet */
    int color[3];
    size_t at = 0;
    for (int k = 0; k < 3; k++) {
        const int six = (int)(rgb >> (18 - 8 * k) & 63);
        at = at << 6 | (size_t)six;
        color[k] = six << 2 | six >> 4;
    }
    if (!kept[at].number[0]) kept[at] = cells_mix(color);
    return kept[at].number[bayer[y & 3][x & 3] < kept[at].part];
}

/* Converts a display colour to the colours of the terminal, at a place of the picture. */
static inline uint32_t cells_color(const cell_screen *s, uint32_t rgb, int x, int y)
{
    if (s->colors == VIEW_PLAIN) return 0;
    return s->colors == VIEW_256 ? cells_dither(rgb, x, y) : rgb;
}

static inline uint32_t cells_pack(const uint8_t *rgba)
{
    return (uint32_t)rgba[0] << 16 | (uint32_t)rgba[1] << 8 | rgba[2];
}

/* ---- characters alone ------------------------------------------------------------------------ */

/* Brightness of two pixels, 0 .. 8 each, as the character whose halves hold about as much ink: rows
   by the upper pixel, columns by the lower one */
static inline uint8_t cells_character(const uint8_t *upper, const uint8_t *lower)
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
    return (uint8_t)ink[level[0]][level[1]];
}

/* ---- from a picture -------------------------------------------------------------------------- */

/* The two colours and the mask that are nearest to n pixels: of all ways to part them, the one that
   leaves the least squared error around the means of both parts, which is the one where the
   squared sums of the parts, each by its count, are largest. */
static inline void cells_fit(cell *c, const uint32_t *pixel, int n)
{
    static const int weight[3] = { 3, 6, 2 };
    int all[3] = { 0, 0, 0 }, part[3] = { 0, 0, 0 }, best[3] = { 0, 0, 0 };
    int best_count = 0, count = 0, mask = 0;
    float most = -1;
    for (int i = 0; i < n; i++)
        for (int k = 0; k < 3; k++) all[k] += (int)(pixel[i] >> (16 - 8 * k) & 255);
    c->mask = 0;
    /* by Gray code, so that each step moves one pixel; the last one stays paper */
    for (int step = 1; step < 1 << (n - 1); step++) {
        int bit = 0, sign;
        float sum = 0;
        while (!(step >> bit & 1)) bit++;
        mask ^= 1 << bit;
        sign = mask >> bit & 1 ? 1 : -1;
        count += sign;
        for (int k = 0; k < 3; k++) {
            float rest;
            part[k] += sign * (int)(pixel[bit] >> (16 - 8 * k) & 255);
            rest = (float)(all[k] - part[k]);
            sum += (float)weight[k] * ((float)part[k] * (float)part[k] / (float)count +
                                       rest * rest / (float)(n - count));
        }
        if (sum <= most) continue;
        most = sum;
        c->mask = (uint8_t)mask;
        best_count = count;
        memcpy(best, part, sizeof best);
    }
    c->ink = c->paper = 0;
    for (int k = 0; k < 3; k++) {
        int rest = n - best_count;
        if (best_count) c->ink = c->ink << 8 | (uint32_t)((best[k] + best_count / 2) / best_count);
        c->paper = c->paper << 8 | (uint32_t)((all[k] - best[k] + rest / 2) / rest);
    }
    if (!c->mask) c->ink = c->paper;
}

/* pixels: RGBA8 as displayed, as many as all cells have */
static inline void cells_picture(cell_screen *s, const uint8_t *pixels)
{
    const int across = cell_forms[s->form].across, down = cell_forms[s->form].down;
    const size_t row = 4 * (size_t)(s->columns * across); /* bytes */
    for (int y = 0; y < s->rows; y++) {
        for (int x = 0; x < s->columns; x++) {
            const uint8_t *corner = pixels + row * (size_t)(y * down) + 4 * (size_t)(x * across);
            cell *c = &s->wanted[y * s->columns + x];
            uint32_t pixel[6];
            for (int k = 0; k < across * down; k++)
                pixel[k] = cells_pack(corner + row * (size_t)(k / across) + 4 * (k % across));
            cells_fit(c, pixel, across * down);
            c->glyph = 0;
            if (s->colors == VIEW_PLAIN) c->glyph = cells_character(corner, corner + row);
            c->ink = cells_color(s, c->ink, x, 2 * y);
            c->paper = cells_color(s, c->paper, x, 2 * y + 1);
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
        int inked = 0;
        if (column < 0) continue;
        for (int k = 0; k < cells_pixels(s); k++) inked += c->mask >> k & 1;
        if (!c->glyph && 2 * inked > cells_pixels(s)) c->paper = c->ink;
        if (paper != CELL_NONE) c->paper = cells_color(s, paper, 0, 0);
        c->glyph = (uint8_t)(*text >= ' ' && *text <= '~' ? *text : '?');
        c->ink = cells_color(s, ink, 0, 0);
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

static inline uint32_t cells_pixel(const cell *c, int k)
{
    return c->mask >> k & 1 ? c->ink : c->paper;
}

static inline int cells_same(const cell_screen *s, const cell *a, const cell *b)
{
    if (a->glyph != b->glyph) return 0;
    if (a->glyph) return cells_alike(s, a->ink, b->ink) && cells_alike(s, a->paper, b->paper);
    for (int k = 0; k < cells_pixels(s); k++)
        if (!cells_alike(s, cells_pixel(a, k), cells_pixel(b, k))) return 0;
    return 1;
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

/* The block character (Unicode's Block Elements and, of the sextants, Symbols for Legacy Computing)
   whose filled parts are those of a mask */
static inline uint32_t cells_block(cell_form form, int mask)
{
    static const uint8_t half[4] = { 0, 0x80, 0x84, 0x88 };
    static const uint8_t quadrant[16] = { 0,    0x98, 0x9d, 0x80, 0x96, 0x8c, 0x9e, 0x9b,
                                          0x97, 0x9a, 0x90, 0x9c, 0x84, 0x99, 0x9f, 0x88 };
    if (!mask) return ' ';
    if (form == CELL_HALVES) return 0x2500 + (uint32_t)half[mask];
    if (form == CELL_QUADRANTS) return 0x2500 + (uint32_t)quadrant[mask];
    if (mask == 21) return 0x258c;
    if (mask == 42) return 0x2590;
    if (mask == 63) return 0x2588;
    return 0x1fb00 + (uint32_t)(mask - 1 - (mask > 21) - (mask > 42));
}

/* Of a code point from U+0800 on, or of ASCII */
static inline void cells_put_utf8(cell_screen *s, uint32_t code)
{
    char utf8[4];
    int n = code < 128 ? 1 : code < 0x10000 ? 3 : 4;
    for (int k = n - 1; k > 0; k--, code >>= 6) utf8[k] = (char)(0x80 | (code & 63));
    utf8[0] = (char)(n == 1 ? code : n == 3 ? 0xe0 | code : 0xf0 | code);
    cells_put(s, utf8, (size_t)n);
}

/* Shows the pixels of a cell by the block of its mask or by that of the others, whichever needs
   fewer new colours; where all are alike, by a blank, or by a full block if the ink is like them.
   Stores what is shown. */
static inline void cells_put_pixels(cell_screen *s, cell *c)
{
    const int full = (1 << cells_pixels(s)) - 1;
    int ink_inked, ink_paper, paper_inked, paper_paper;
    if (!c->mask) c->ink = c->paper;
    if (c->mask == full) c->paper = c->ink;
    ink_inked = cells_alike(s, c->ink, s->ink);
    ink_paper = cells_alike(s, c->ink, s->paper);
    paper_inked = cells_alike(s, c->paper, s->ink);
    paper_paper = cells_alike(s, c->paper, s->paper);
    if (cells_alike(s, c->ink, c->paper)) {
        int papered = ink_paper && paper_paper;
        c->mask = 0;
        if (ink_inked && paper_inked && !papered && s->form != CELL_WHOLE)
            c->mask = (uint8_t)full;
        else if (!papered)
            cells_dip(s, s->ink, c->paper);
    } else if (paper_inked + ink_paper > ink_inked + paper_paper) {
        cells_dip(s, paper_inked ? s->ink : c->paper, ink_paper ? s->paper : c->ink);
        c->mask = (uint8_t)(full & ~c->mask);
    } else {
        cells_dip(s, ink_inked ? s->ink : c->ink, paper_paper ? s->paper : c->paper);
    }
    cells_put_utf8(s, cells_block(s->form, c->mask));
    c->ink = s->ink;
    c->paper = s->paper;
}

/* Writes the wanted cell at the pen, and stores what the terminal shows then. */
static inline void cells_put_cell(cell_screen *s)
{
    int at = s->pen_row * s->columns + s->pen_column;
    cell *c = &s->shown[at];
    *c = s->wanted[at];
    if (!c->glyph) {
        cells_put_pixels(s, c);
    } else {
        char glyph = (char)c->glyph;
        cells_dip(s, glyph == ' ' ? s->ink : c->ink, c->paper);
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
