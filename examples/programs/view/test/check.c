/* check.c - what view sends to terminals and takes from them, held against a small terminal that
   decodes it; and whether a captured pane of tmux shows the picture that shade.h draws.

       check                                          all tests of encoding and decoding
       check pane COLORS COLUMNS ROWS KEYS [model]    a pane on standard input, as
                                                      tmux capture-pane -e -N -p prints it
       check picture WAY COLUMNS ROWS                 the picture in pixels that view sends, as PPM
       check window RRGGBB                            a window on standard input, as xwd writes it:
                                                      prints its width, height, how many colours
                                                      follow one another, and pixels near one */
#define _DEFAULT_SOURCE
#define SHADE_IMPLEMENTATION
#include "shade.h"
#include "examples/programs/view/display.h"

static int passed, failed;
static uint64_t seed = 88172645463325252u;

static uint32_t random_below(uint32_t n)
{
    seed ^= seed << 13;
    seed ^= seed >> 7;
    seed ^= seed << 17;
    return (uint32_t)(seed >> 32) % n;
}

static void check(int holds, const char *what, long long got, long long want)
{
    if (holds)
        passed++;
    else
        failed++;
    if (!holds && failed < 20) printf("%s: got %lld, want %lld\n", what, got, want);
}

/* ---- a terminal ------------------------------------------------------------------------------ */

enum { COLOR_UNSET = 1 << 25, COLOR_NUMBER = 1 << 24 }; /* beside 0xRRGGBB */
enum { NO_BLOCK = -1 };

typedef struct vt_cell {
    uint32_t glyph, ink, paper;
} vt_cell;
typedef struct vt {
    int columns, rows, row, column;
    uint32_t ink, paper;
    vt_cell *cells;
    int errors; /* sequences it does not know, and writing outside */
} vt;

static vt vt_new(int columns, int rows)
{
    vt t = { columns, rows, 0, 0, COLOR_UNSET, COLOR_UNSET, NULL, 0 };
    t.cells = (vt_cell *)example_memory((size_t)(columns * rows), sizeof(vt_cell));
    return t;
}

static void vt_put(vt *t, uint32_t glyph)
{
    if (t->row >= t->rows || t->column >= t->columns) {
        t->errors++;
        return;
    }
    t->cells[t->row * t->columns + t->column] = (vt_cell){ glyph, t->ink, t->paper };
    t->column++;
}

/* Behind 38 or 48: 5;n or 2;r;g;b.  Returns how many numbers it took. */
static int vt_color(const int *number, int count, uint32_t *color)
{
    if (count > 1 && number[0] == 5) {
        *color = COLOR_NUMBER | (uint32_t)number[1];
        return 2;
    }
    if (count < 4 || number[0] != 2) return 0;
    *color = (uint32_t)(number[1] << 16 | number[2] << 8 | number[3]);
    return 4;
}

static void vt_rendition(vt *t, const int *number, int count)
{
    for (int k = 0; k < count; k++) {
        if (number[k] == 0)
            t->ink = t->paper = COLOR_UNSET;
        else if (number[k] == 39)
            t->ink = COLOR_UNSET;
        else if (number[k] == 49)
            t->paper = COLOR_UNSET;
        else if (number[k] == 38)
            k += vt_color(number + k + 1, count - k - 1, &t->ink);
        else if (number[k] == 48)
            k += vt_color(number + k + 1, count - k - 1, &t->paper);
        else
            t->errors++;
    }
}

static void vt_sequence(vt *t, char final, const int *number, int count)
{
    if (final == 'm') {
        vt_rendition(t, number, count);
    } else if (final == 'H') {
        t->row = number[0] ? number[0] - 1 : 0;
        t->column = count > 1 && number[1] ? number[1] - 1 : 0;
    } else if (final == 'C') {
        t->column += number[0] ? number[0] : 1;
    } else if (final == 'J' && number[0] == 2) {
        for (int i = 0; i < t->columns * t->rows; i++)
            t->cells[i] = (vt_cell){ ' ', t->ink, t->paper };
    } else {
        t->errors++;
    }
}

/* Takes the sequence behind ESC [; returns its end. */
static const char *vt_escape(vt *t, const char *p, const char *end)
{
    int number[16] = { 0 }, count = 1;
    for (; p < end && ((*p >= '0' && *p <= '9') || *p == ';'); p++) {
        if (*p != ';')
            number[count - 1] = number[count - 1] * 10 + *p - '0';
        else if (count < 16)
            count++;
    }
    if (p == end) return end;
    vt_sequence(t, *p, number, count);
    return p + 1;
}

static void vt_feed(vt *t, const char *p, const char *end)
{
    while (p < end) {
        unsigned char c = (unsigned char)*p++;
        if (c == 27 && p < end && *p == '[') {
            p = vt_escape(t, p + 1, end);
        } else if (c == '\n') {
            t->row++;
            t->column = 0;
        } else if (c >= 0xf0 && end - p >= 3) {
            vt_put(t,
                   (uint32_t)((c & 7) << 18 | (p[0] & 63) << 12 | (p[1] & 63) << 6 | (p[2] & 63)));
            p += 3;
        } else if (c >= 0xe0 && end - p >= 2) {
            vt_put(t, (uint32_t)((c & 15) << 12 | (p[0] & 63) << 6 | (p[1] & 63)));
            p += 2;
        } else if (c >= ' ' && c < 127) {
            vt_put(t, c);
        } else {
            t->errors++;
        }
    }
}

/* A cell is looked at in 2 x 6 places, from its upper left one on: bit 2 y + x.  These are the
   places that a block fills, by the charts of Unicode: U+2580 .. U+259F, and the sextants from
   U+1FB00 on, which count up in binary but leave out what U+258C and U+2590 are. */
static int block_places(uint32_t glyph)
{
    static const struct {
        uint32_t glyph;
        int quarters; /* 1 upper left, 2 upper right, 4 lower left, 8 lower right */
    } block[] = { { ' ', 0 },     { 0x2580, 3 },  { 0x2584, 12 }, { 0x2588, 15 },
                  { 0x258c, 5 },  { 0x2590, 10 }, { 0x2596, 4 },  { 0x2597, 8 },
                  { 0x2598, 1 },  { 0x2599, 13 }, { 0x259a, 9 },  { 0x259b, 7 },
                  { 0x259c, 11 }, { 0x259d, 2 },  { 0x259e, 6 },  { 0x259f, 14 } };
    int places = 0, sixths = 0;
    for (uint32_t at = 0x1fb00; at <= glyph && glyph <= 0x1fb3b; at++) {
        sixths++;
        while (sixths == 21 || sixths == 42) sixths++;
    }
    for (int k = 0; k < 6 && sixths; k++)
        if (sixths >> k & 1) places |= 5 << (4 * (k / 2) + k % 2);
    if (sixths) return places;
    for (size_t i = 0; i < sizeof block / sizeof *block; i++) {
        if (block[i].glyph != glyph) continue;
        for (int k = 0; k < 4; k++)
            if (block[i].quarters >> k & 1) places |= 21 << (6 * (k / 2) + k % 2);
        return places;
    }
    return NO_BLOCK;
}

/* ---- cells to bytes ------------------------------------------------------------------------- */

static int differ(uint32_t a, uint32_t b, int slack)
{
    if (a > 0xffffff || b > 0xffffff) return a != b;
    for (int shift = 0; shift < 24; shift += 8)
        if (abs((int)(a >> shift & 255) - (int)(b >> shift & 255)) > slack) return 1;
    return 0;
}

static uint32_t encoded(const cell_screen *s, uint32_t color)
{
    return s->colors == VIEW_PLAIN ? COLOR_UNSET
           : s->colors == VIEW_256 ? COLOR_NUMBER | color
                                   : color;
}

/* The colour that is wanted at a place of a cell */
static uint32_t wanted_color(const cell_screen *s, const cell *want, int place)
{
    const int across = cell_forms[s->form].across, down = cell_forms[s->form].down;
    const int pixel = place / 2 * down / 6 * across + place % 2 * across / 2;
    return encoded(s, want->mask >> pixel & 1 ? want->ink : want->paper);
}

/* Cells of the terminal that are not the wanted ones, to slack */
static int wrong_cells(const cell_screen *s, const vt *t, const cell *want, int slack)
{
    int wrong = 0;
    for (int i = 0; i < s->columns * s->rows; i++) {
        const vt_cell *got = &t->cells[i];
        const int places = block_places(got->glyph);
        int differs = places == NO_BLOCK || (s->form == CELL_WHOLE && got->glyph != ' ');
        for (int k = 0; k < 12 && !want[i].glyph; k++)
            differs |= differ(places >> k & 1 ? got->ink : got->paper, wanted_color(s, &want[i], k),
                              slack);
        if (want[i].glyph)
            differs = got->glyph != want[i].glyph ||
                      differ(got->paper, encoded(s, want[i].paper), slack) ||
                      (got->glyph != ' ' && differ(got->ink, encoded(s, want[i].ink), slack));
        wrong += differs;
    }
    return wrong;
}

/* A few colours, some one or two steps apart: all cases of equal and alike */
static uint32_t random_color(const cell_screen *s)
{
    uint32_t base = random_below(3) * 0x504030 + 0x101010;
    if (s->colors == VIEW_PLAIN) return 0;
    if (s->colors == VIEW_256) return 16 + random_below(4);
    return base + random_below(3) + 0x100 * random_below(3) + 0x10000 * random_below(3);
}

static void random_change(cell_screen *s)
{
    int count = s->columns * s->rows, changes = (int)random_below((uint32_t)count + 1);
    if (random_below(3)) changes /= 8;
    while (changes--) {
        cell *c = &s->wanted[random_below((uint32_t)count)];
        c->ink = random_color(s);
        c->paper = random_below(3) ? random_color(s) : c->ink;
        c->mask = (uint8_t)random_below(1u << cells_pixels(s));
        c->glyph = 0;
        if (s->colors == VIEW_PLAIN || !random_below(6))
            c->glyph = (uint8_t)(' ' + random_below(95));
        if (s->form == CELL_WHOLE && !c->glyph) c->mask = 0;
    }
}

/* What sending every changed cell with a place and two colours would take */
static size_t plain_size(const cell_screen *s)
{
    size_t changed = 0;
    for (int i = 0; i < s->columns * s->rows; i++)
        changed += !s->known || !cells_same(s, &s->wanted[i], &s->shown[i]);
    return changed * CELL_BYTES;
}

static void test_screen(void)
{
    static const int slacks[4] = { 0, 0, 1, 2 };
    static cell_screen s;
    vt t;
    s.colors = (view_colors)random_below(3);
    s.form = (cell_form)random_below(4);
    cells_resize(&s, 1 + (int)random_below(40), 1 + (int)random_below(12));
    for (int i = 0; i < s.columns * s.rows; i++)
        s.wanted[i].glyph = s.colors == VIEW_PLAIN ? ' ' : 0;
    t = vt_new(s.columns, s.rows);
    t.row = 3;
    t.column = 5;
    t.ink = 1;
    t.paper = 2;
    for (int frame = 0; frame < 12; frame++) {
        size_t limit;
        s.slack = slacks[random_below(4)];
        if (frame) random_change(&s);
        limit = plain_size(&s) + 7;
        cells_encode(&s);
        check(s.size <= limit, "bytes of a frame", (long long)s.size, (long long)limit);
        vt_feed(&t, s.bytes, s.bytes + s.size);
        check(!t.errors, "errors of the terminal", t.errors, 0);
        check(!wrong_cells(&s, &t, s.wanted, s.slack), "cells not as wanted",
              wrong_cells(&s, &t, s.wanted, s.slack), 0);
        check(!wrong_cells(&s, &t, s.shown, 0), "cells not as remembered",
              wrong_cells(&s, &t, s.shown, 0), 0);
        cells_encode(&s);
        check(!s.size, "bytes without a change", (long long)s.size, 0);
    }
    free(t.cells);
}

/* The squared error that a mask leaves: of each part around its own mean */
static double fit_error(const uint32_t *pixel, int n, int mask)
{
    static const int weight[3] = { 3, 6, 2 };
    double error = 0;
    for (int part = 0; part < 2; part++) {
        for (int shift = 0; shift < 24; shift += 8) {
            double sum = 0, squares = 0, count = 0;
            for (int i = 0; i < n; i++) {
                const double c = (double)(pixel[i] >> shift & 255);
                if ((mask >> i & 1) != part) continue;
                sum += c;
                squares += c * c;
                count++;
            }
            if (count > 0) error += weight[2 - shift / 8] * (squares - sum * sum / count);
        }
    }
    return error;
}

/* The mask and the colours of 1, 2, 4 or 6 pixels, against all masks */
static void test_fit(int n)
{
    uint32_t pixel[6];
    double best = 1e30, got, mean[2][3] = { { 0 } }, count[2] = { 0 };
    cell c;
    for (int i = 0; i < n; i++)
        pixel[i] = random_below(1 << 24) & (random_below(2) ? 0xffffff : 0xf0);
    cells_fit(&c, pixel, n);
    for (int mask = 0; mask < 1 << n; mask++) best = fmin(best, fit_error(pixel, n, mask));
    got = fit_error(pixel, n, c.mask);
    check(got <= best * 1.0001 + 1, "error of two colours", (long long)got, (long long)best);
    for (int i = 0; i < n; i++) {
        count[c.mask >> i & 1]++;
        for (int k = 0; k < 3; k++) mean[c.mask >> i & 1][k] += (double)(pixel[i] >> (8 * k) & 255);
    }
    for (int k = 0; k < 6; k++) {
        const int part = k / 3;
        const uint32_t color = part ? c.ink : c.paper;
        const double off = (double)(color >> (8 * (k % 3)) & 255) - mean[part][k % 3] / count[part];
        if (count[part] > 0)
            check(fabs(off) <= 0.51, "a mean of pixels", (long long)(100 * off), 0);
    }
}

/* One of the 240 colours as xterm shows them */
static void xterm_color(uint32_t n, int color[3])
{
    static const int level[6] = { 0, 95, 135, 175, 215, 255 };
    const uint32_t k = n - 16;
    color[0] = level[k / 36 % 6];
    color[1] = level[k / 6 % 6];
    color[2] = level[k % 6];
    if (n >= 232) color[0] = color[1] = color[2] = 8 + 10 * (int)(n - 232);
}

/* How far a colour is off, hue counted four times */
static double color_error(const double *a, const int *b)
{
    const double luma = (3 * (a[0] - b[0]) + 6 * (a[1] - b[1]) + 2 * (a[2] - b[2])) / 11;
    double sum = luma * luma;
    for (int k = 0; k < 3; k++) sum += 4 * (a[k] - b[k] - luma) * (a[k] - b[k] - luma);
    return sum;
}

/* Over 4 x 4 places a dithered colour is as near, on average, as the nearest of all 240; greys are
   mixed of greys alone, to within the 2 by which six bits are off. */
static void test_dither(uint32_t rgb)
{
    const int color[3] = { (int)(rgb >> 16), (int)(rgb >> 8 & 255), (int)(rgb & 255) };
    double mean[3] = { 0, 0, 0 }, nearest = 1e30, got;
    int grey = 1;
    for (int place = 0; place < 16; place++) {
        int shown[3];
        xterm_color(cells_dither(rgb, place % 4, place / 4), shown);
        for (int k = 0; k < 3; k++) mean[k] += shown[k] / 16.0;
        grey = grey && shown[0] == shown[1] && shown[1] == shown[2];
    }
    for (uint32_t n = 16; n < 256; n++) {
        int shown[3];
        double one[3];
        xterm_color(n, shown);
        for (int k = 0; k < 3; k++) one[k] = shown[k];
        nearest = fmin(nearest, color_error(one, color));
    }
    got = sqrt(color_error(mean, color));
    check(got <= sqrt(nearest) + 8, "a dithered colour", (long long)got, (long long)sqrt(nearest));
    if (color[0] == color[1] && color[1] == color[2]) {
        check(grey, "grey of greys", color[0], 0);
        check(fabs(mean[0] - color[0]) <= 7, "their mean", (long long)mean[0], color[0]);
    }
}

/* ---- answers --------------------------------------------------------------------------------- */

static terminal_answers answered(const char *text)
{
    terminal_answers a;
    memset(&a, 0, sizeof a);
    answers_take(&a, (const unsigned char *)text, strlen(text));
    return a;
}

static void test_answers(void)
{
    static const struct {
        const char *name;
        int parts;
    } named[] = { { "kitty(0.26.5)", 6 }, { "WezTerm 20240203", 6 }, { "ghostty 1.0.0", 6 },
                  { "foot(1.13.1)", 6 },  { "VTE(6003)", 4 },        { "VTE(7600)", 6 },
                  { "XTerm(379)", 4 },    { "tmux 3.3a", 0 } };
    terminal_answers a;
    for (size_t k = 0; k < sizeof named / sizeof *named; k++) {
        char text[80];
        snprintf(text, sizeof text, "\033P>|%s\033\\", named[k].name);
        a = answered(text);
        check(a.parts == named[k].parts, named[k].name, a.parts, named[k].parts);
    }
    check(answered("\033_Gi=31;OK\033\\").kitty, "kitty", 0, 1);
    check(!answered("\033_Gi=31;EINVAL:no\033\\").kitty, "kitty refused", 1, 0);
    check(answered("\033[?62;4;22c").sixel, "sixel", 0, 1);
    check(answered("\033[?64;1;2;4c").sixel, "sixel as the last", 0, 1);
    check(!answered("\033[?4;22c").sixel, "a terminal of class 4", 1, 0);
    check(!answered("\033[?62;14;40c").sixel, "14 and 40", 1, 0);
    check(answered("\033]1337;Capabilities=T3LrMSc7UUw9Ts3BFGsSyHNoSxF\007").iterm2, "FILE", 0, 1);
    check(!answered("\033]1337;Capabilities=T3BFGsSy\033\\").iterm2, "focus alone", 1, 0);
    a = answered("\033[6;20;10t");
    check(a.cell_width == 10 && a.cell_height == 20, "a cell", a.cell_width, 10);
    a = answered("\033[?2;0;1000;800S");
    check(a.sixel_width == 1000 && a.sixel_height == 800, "sixels", a.sixel_width, 1000);
    a = answered("\033[6;0;-3t");
    check(!a.cell_width && !a.cell_height, "a cell without area", a.cell_width, 0);
    a = answered("\033[4;456;800t");
    check(a.area_width == 800 && a.area_height == 456, "all cells", a.area_width, 800);
    check(answered("\033[>65;7006;1c").parts == 6, "VTE without a name", 0, 6);
    check(answered("\033[>65;6003;1c").parts == 4, "an old VTE without a name", 0, 4);
    check(!answered("\033[>1;10;0c").parts, "attributes of others", 1, 0);
    check(answered("\033P>|tmux 3.3a\033\\").inner, "tmux is inside of another", 0, 1);
}

/* Sizes of cells by what terminals of Debian 12 say, and what their fonts are: the answers that
   pixels.py has */
static void test_cells(void)
{
    static const struct {
        const char *name, *area, *largest;
        struct winsize at, now;
        int width, height;
    } row[] = {
        { "VTE", "\033[4;456;800t", "", { 24, 80, 0, 0 }, { 24, 80, 0, 0 }, 10, 19 },
        { "VTE, made wider", "\033[4;456;800t", "", { 24, 80, 0, 0 }, { 24, 100, 0, 0 }, 10, 19 },
        { "mlterm", "\033[4;456;800t", "", { 24, 80, 800, 456 }, { 24, 80, 800, 456 }, 10, 19 },
        { "xterm", "", "\033[?2;0;480;312S", { 24, 80, 520, 352 }, { 24, 80, 520, 352 }, 6, 13 },
        { "xterm, larger since",
          "",
          "\033[?2;0;480;312S",
          { 24, 80, 520, 352 },
          { 24, 80, 760, 640 },
          9,
          26 },
        { "xterm, bounded",
          "",
          "\033[?2;0;1000;1000S",
          { 60, 200, 1204, 1204 },
          { 60, 200, 1204, 1204 },
          6,
          20 },
        { "rxvt", "\033[4;360;560t", "", { 24, 80, 480, 312 }, { 24, 80, 480, 312 }, 6, 13 },
        { "Konsole",
          "\033[4;476;880t",
          "\033[?2;0;16384;16384S",
          { 28, 110, 1000, 600 },
          { 28, 110, 1000, 600 },
          8,
          17 },
        { "st", "", "", { 24, 80, 560, 312 }, { 24, 80, 560, 312 }, 7, 13 },
    };
    for (size_t k = 0; k < sizeof row / sizeof *row; k++) {
        terminal_answers said = answered(row[k].area), more = answered(row[k].largest);
        terminal_size s = { 80, 24, 1, 0, 0, 1 };
        said.sixel_width = more.sixel_width;
        said.sixel_height = more.sixel_height;
        said.at = row[k].at;
        terminal_measure_cell(&s, &said, &row[k].now);
        check(s.cell_width == row[k].width, row[k].name, s.cell_width, row[k].width);
        check(s.cell_height == row[k].height, row[k].name, s.cell_height, row[k].height);
    }
}

/* What a report of the terminal is taken for, which is read whole */
static input_kind report(const char *text)
{
    input in;
    const size_t used = terminal_parse((const unsigned char *)text, strlen(text), &in);
    check(used == strlen(text), text + 1, (long long)used, (long long)strlen(text));
    return in.kind;
}

/* Strings are answers while answers are awaited, and keys with Alt else. */
static void test_strings(void)
{
    static const char name[] = "\033P>|foot(1.13.1)\033\\q";
    const unsigned char *p = (const unsigned char *)name;
    input in;
    terminal_questioned = 1;
    for (size_t n = 2; n < sizeof name - 2; n++)
        check(terminal_parse(p, n, &in) == 0, "bytes taken of half a string", (long long)n, 0);
    check(terminal_parse(p, sizeof name - 1, &in) == sizeof name - 2, "bytes of a string", 0, 1);
    check(in.kind == INPUT_NONE, "a string is no key", in.kind, INPUT_NONE);
    terminal_asked = 1;
    check(report("\033[>0;1;2c") == INPUT_NONE, "secondary attributes end nothing", 1, 0);
    check(report("\033[?6c") == INPUT_ANSWERS, "the end of the answers", 0, 1);
    terminal_asked = terminal_questioned = 2; /* a frame's report is on its way before it */
    check(report("\033[?6c") == INPUT_NONE, "the report of a frame", 1, 0);
    check(report("\033[?6c") == INPUT_ANSWERS, "that of the questions", 0, 1);
    terminal_questioned = 0;
    check(terminal_parse(p, sizeof name - 1, &in) == 1, "Alt and P", 0, 1);
    terminal_questioned = 1;
    check(terminal_parse((const unsigned char *)"\033Pq", 3, &in) == 1, "Alt and P, then q", 0, 1);
    check(terminal_parse((const unsigned char *)"\033\0q", 3, &in) == 1, "ESC and NUL", 0, 1);
    terminal_questioned = 0;
}

/* ---- bytes to keys -------------------------------------------------------------------------- */

static void test_key(const char *text, input want)
{
    input in = { INPUT_NONE, 0, 0, 0, 0 };
    size_t n = strlen(text), used = terminal_parse((const unsigned char *)text, n, &in);
    check(used == n, text + 1, (long long)used, (long long)n);
    check(in.kind == want.kind, text + 1, in.kind, want.kind);
    if (want.kind == INPUT_KEY) check(in.key == want.key, text + 1, in.key, want.key);
    if (want.kind != INPUT_MOUSE) return;
    check(in.button == want.button, text + 1, in.button, want.button);
    check(in.column == want.column, text + 1, in.column, want.column);
    check(in.row == want.row, text + 1, in.row, want.row);
    for (size_t k = 1; k < n; k++) {
        used = terminal_parse((const unsigned char *)text, k, &in);
        check(used == 0, "bytes taken of half a sequence", (long long)used, 0);
    }
}

static void test_keys(void)
{
    test_key("m", (input){ INPUT_KEY, 'm', 0, 0, 0 });
    test_key("\033[A", (input){ INPUT_KEY, KEY_UP, 0, 0, 0 });
    test_key("\033[B", (input){ INPUT_KEY, KEY_DOWN, 0, 0, 0 });
    test_key("\033OC", (input){ INPUT_KEY, KEY_RIGHT, 0, 0, 0 });
    test_key("\033[1;5D", (input){ INPUT_KEY, KEY_LEFT, 0, 0, 0 });
    test_key("\033[1;2A", (input){ INPUT_KEY, KEY_MOVE_UP, 0, 0, 0 });
    test_key("\033[1;2B", (input){ INPUT_KEY, KEY_MOVE_DOWN, 0, 0, 0 });
    test_key("\033[1;6C", (input){ INPUT_KEY, KEY_MOVE_RIGHT, 0, 0, 0 });
    test_key("\033[1;2D", (input){ INPUT_KEY, KEY_MOVE_LEFT, 0, 0, 0 });
    test_key("\033[<64;10;3M", (input){ INPUT_MOUSE, 0, 64, 10, 3 });
    test_key("\033[<32;100;200M", (input){ INPUT_MOUSE, 0, 32, 100, 200 });
    test_key("\033[M`+#", (input){ INPUT_MOUSE, 0, 64, 11, 3 });
    test_key("\033[<0;1;1m", (input){ INPUT_NONE, 0, 0, 0, 0 });
    test_key("\033[200~", (input){ INPUT_NONE, 0, 0, 0, 0 });
    terminal_asked = 1;
    test_key("\033[?6c", (input){ INPUT_NONE, 0, 0, 0, 0 });
    check(terminal_asked == 0, "reports owed", terminal_asked, 0);
    test_key("\033[?6c", (input){ INPUT_NONE, 0, 0, 0, 0 });
    check(terminal_asked == 0, "reports owed after one too many", terminal_asked, 0);
}

/* ---- the state ------------------------------------------------------------------------------ */

/* Where the middle of the model is in the picture, -1 .. 1 */
static shade_vec2 middle_of(const scene *s, float aspect)
{
    const scene_camera c = scene_place_camera(s, aspect);
    const shade_vec4 at = shade_mat4_transform(
        shade_mat4_mul(c.projection, shade_mat4_mul(c.view, c.model)), shade_v4(0, 0, 0, 1));
    return shade_v2(at.x / at.w, at.y / at.w);
}

/* Moved by parts of the half height, however large the model is shown */
static void test_move(void)
{
    static scene s;
    const scene_request teapot = { .still = 1, .how = model_options_new() };
    if (scene_load(&s, &teapot, NULL, NULL)) exit(1);
    for (float zoom = 0.5f; zoom < 5; zoom *= 2) {
        shade_vec2 before, after;
        scene_go_home(&s);
        scene_zoom(&s, zoom);
        before = middle_of(&s, 1.6f);
        scene_move(&s, 0.4f, -0.3f);
        after = middle_of(&s, 1.6f);
        check(fabsf(after.x - before.x - 0.25f) < 1e-5f, "moved right", (int)(1e6f * after.x),
              (int)(1e6f * before.x) + 250000);
        check(fabsf(after.y - before.y + 0.3f) < 1e-5f, "moved down", (int)(1e6f * after.y),
              (int)(1e6f * before.y) - 300000);
        scene_move(&s, 1e9f, -1e9f);
        check(s.place.x == SCENE_FAR && s.place.y == -SCENE_FAR, "no farther", 0, 1);
    }
    scene_close(&s);
    memset(&s, 0, sizeof s);
}

/* Whatever keys and mouse have done, --again leads there from the same beginning, to the bit. */
static void test_again(void)
{
    static scene a, b;
    scene_request request = { .still = 1, .how = model_options_new() };
    scene_state_words told;
    if (scene_load(&a, &request, NULL, NULL)) exit(1);
    for (int k = 0; k < 300; k++) {
        for (int i = random_below(40); i > 0; i--) {
            const int key = random_below(CHOICES);
            scene_key(&a, scene_choices[key].key - (random_below(2) ? 'a' - 'A' : 0));
            scene_turn(&a, 0.01f * (float)random_below(99), 0.01f * (float)random_below(9) - 0.04f);
            scene_move(&a, 0.01f * (float)random_below(9) - 0.04f, 0.01f * (float)random_below(9));
            scene_zoom(&a, 0.8f + 0.05f * (float)random_below(9));
        }
        told = scene_again(&a);
        request.again = told.text;
        check(scene_take_again(&request.again, told.text), "the state is an option", 0, 1);
        if (k % 20 == 0) {
            if (scene_load(&b, &request, NULL, NULL)) exit(1);
            check(a.yaw == b.yaw && a.pitch == b.pitch && a.zoom == b.zoom, "turned alike", 0, 1);
            check(a.place.x == b.place.x && a.place.y == b.place.y, "in the same place", 0, 1);
            check(!memcmp(a.choice, b.choice, sizeof a.choice), "with the same choices", 0, 1);
            scene_close(&b);
            memset(&b, 0, sizeof b);
        }
    }
    scene_close(&a);
    memset(&a, 0, sizeof a);
}

/* A sequence without an end does not hold up what follows for ever. */
static void test_endless(void)
{
    unsigned char text[200];
    input in;
    size_t used;
    memset(text, '7', sizeof text);
    memcpy(text, "\033[", 2);
    used = terminal_parse(text, sizeof text, &in);
    check(used > 0 && in.kind == INPUT_NONE, "bytes taken of an endless sequence", (long long)used,
          200);
}

/* Any bytes, in memory of their size (which sanitizers watch): taken in order, never more than are
   there, and what stays is the beginning of a sequence that can still end. */
static void test_bytes(void)
{
    static const char likely[] = "\033[O<;0123456789MmnABCD~";
    size_t size = 1 + random_below(200), at = 0, used = 1;
    unsigned char *text = (unsigned char *)example_memory(size, 1);
    for (size_t i = 0; i < size; i++)
        text[i] = (unsigned char)(random_below(2) ? likely[random_below(sizeof likely - 1)]
                                                  : (int)random_below(256));
    terminal_questioned = random_below(2) != 0;
    while (at < size && used) {
        input in;
        used = terminal_parse(text + at, size - at, &in);
        check(used <= size - at, "bytes taken", (long long)used, (long long)(size - at));
        at += used;
    }
    check(at == size || (text[at] == 27 && size - at < (terminal_questioned ? 400 : 64)),
          "bytes left", (long long)(size - at), 0);
    terminal_questioned = 0;
    free(text);
}

/* ---- the scene ------------------------------------------------------------------------------ */

/* Pixels of bronze, more red than green than blue, in columns from .. to - 1 */
static int bronze(const display *d, int from, int to)
{
    const uint8_t *p = (const uint8_t *)d->small.color;
    int count = 0;
    for (int i = 0; i < d->small.width * d->small.height; i++, p += 4)
        count += i % d->small.width >= from && i % d->small.width < to && p[0] > p[1] + 15 &&
                 p[1] > p[2] + 15;
    return count;
}

/* The teapot fills the picture in every shape of it, its spout points to +x, and turns with it. */
static void test_teapot(int columns, int rows)
{
    view_options o = { .scene = { .how = model_options_new() } };
    const scene_request request = view_request(&o);
    terminal_size size = { columns, rows, 1, 10, 20, 1 };
    static scene s;
    static display d;
    int all, middle = columns / 2, edge = 1, spout;
    d.scene = &s;
    d.show = SHOW_CELLS;
    d.screen.form = CELL_HALVES;
    d.screen.colors = VIEW_TRUE;
    if (scene_load(&s, &request, NULL, NULL)) exit(1);
    s.yaw = 0;
    s.choice[CHOICE_GROUND] = 1;
    s.choice[CHOICE_LAMP] = LAMP_EYE;
    display_resize(&d, size);
    display_picture(&d);
    all = bronze(&d, 0, columns);
    check(all > columns * rows / 6, "pixels of the teapot", all, columns * rows / 6);
    check(!bronze(&d, 0, edge), "pixels at the left edge", bronze(&d, 0, edge), 0);
    check(!bronze(&d, columns - edge, columns), "at the right edge",
          bronze(&d, columns - edge, columns), 0);
    for (spout = columns; !bronze(&d, spout - 1, spout);) spout--;
    check(bronze(&d, middle, columns) < all, "pixels on the right", bronze(&d, middle, columns),
          all);
    scene_turn(&s, 3.14159265f, 0);
    display_picture(&d);
    check(abs(bronze(&d, columns - spout, middle) - bronze(&d, 0, middle)) == 0,
          "pixels left of where the spout has gone", bronze(&d, 0, columns - spout), 0);
    check(bronze(&d, columns - spout, columns - spout + 2) > 0, "the spout, turned", 0, 1);
    scene_close(&s);
    display_free(&d);
    memset(&d, 0, sizeof d);
    memset(&s, 0, sizeof s);
}

/* ---- a pane --------------------------------------------------------------------------------- */

static char *read_all(size_t *size)
{
    char *text = (char *)example_memory(1 << 23, 1);
    *size = fread(text, 1, 1 << 23, stdin);
    return text;
}

/* The size of a terminal whose cells have the pixels that CELL says, 10x20 where it is not set */
static terminal_size size_of(int columns, int rows)
{
    terminal_size s = { columns, rows, 1, 10, 20, 1 };
    const char *cell = getenv("CELL");
    if (cell) sscanf(cell, "%dx%d", &s.cell_width, &s.cell_height);
    s.shape = 2 * (float)s.cell_width / (float)s.cell_height;
    return s;
}

/* The cells of a scene at rest after some keys; < > ^ v are the arrows, 8 2 4 6 those with shift */
static void draw_wanted(display *d, const view_options *o, const char *keys)
{
    static const char arrows[] = "^v<>8246";
    static scene s;
    const terminal_size size = size_of(d->screen.columns, d->screen.rows);
    const scene_request request = view_request(o);
    if (scene_load(&s, &request, NULL, NULL)) exit(1);
    for (; *keys; keys++) {
        const char *arrow = strchr(arrows, *keys);
        scene_key(&s, arrow ? KEY_UP + (int)(arrow - arrows) : *keys);
    }
    d->scene = &s;
    d->show = SHOW_CELLS;
    d->at_rest = 1;
    display_resize(d, size);
    display_picture(d);
    scene_close(&s);
}

/* What view writes over the picture, above and below, is taken from the pane. */
static void forgive_words(cell_screen *s, const vt *t)
{
    for (int i = 0; i < s->columns * s->rows; i++) {
        const uint32_t glyph = t->cells[i].glyph;
        int row = i / s->columns, words = !row || row == s->rows - 1;
        if (!words || s->columns < 20 || s->rows < 5) continue;
        if (glyph != ' ' && block_places(glyph) != NO_BLOCK) continue;
        s->wanted[i].glyph = (uint8_t)glyph;
        s->wanted[i].ink = t->cells[i].ink & 0xffffff;
        s->wanted[i].paper = t->cells[i].paper & 0xffffff;
    }
}

/* colors: plain, 256, true; or true in another form: quadrants, sextants */
static int check_pane(char **argv, const char *model)
{
    static const char *const colors[5] = { "plain", "256", "true", "quadrants", "sextants" };
    view_options o = { .scene = { .model = model, .still = 1, .how = model_options_new() } };
    static display d;
    size_t size;
    char *text = read_all(&size);
    int wrong, kind = find_name(argv[0], colors, 5);
    vt t;
    o.colors = (view_colors)(kind > VIEW_TRUE ? VIEW_TRUE : kind);
    d.screen.form = (cell_form)(kind > VIEW_TRUE ? kind - VIEW_TRUE + CELL_HALVES : CELL_HALVES);
    d.screen.colors = o.colors;
    d.screen.columns = atoi(argv[1]);
    d.screen.rows = atoi(argv[2]);
    t = vt_new(d.screen.columns, d.screen.rows);
    vt_feed(&t, text, text + size);
    draw_wanted(&d, &o, argv[3]);
    forgive_words(&d.screen, &t);
    wrong = wrong_cells(&d.screen, &t, d.screen.wanted, 0);
    if (wrong || t.errors)
        printf("%d cells of %d are not as drawn, %d errors\n", wrong, t.columns * t.rows, t.errors);
    free(t.cells);
    free(text);
    display_free(&d);
    return wrong || t.errors;
}

/* ---- pixels ---------------------------------------------------------------------------------- */

/* Writes the picture of pixels that view should send to a terminal, as a PPM: WAY is that of
   --show. */
static int write_picture(char **argv)
{
    static const char *const way[3] = { "kitty", "iterm2", "sixel" };
    view_options o = { .colors = VIEW_TRUE, .scene = { .still = 1, .how = model_options_new() } };
    const terminal_size size = size_of(atoi(argv[1]), atoi(argv[2]));
    static display d;
    static scene s;
    const scene_request request = view_request(&o);
    const uint8_t *p;
    if (scene_load(&s, &request, NULL, NULL)) return 1;
    d.scene = &s;
    d.show = (view_show)(SHOW_KITTY + find_name(argv[0], way, 3));
    d.at_rest = 1;
    display_resize(&d, size);
    display_picture(&d);
    display_write(&d);
    printf("P6\n%d %d\n255\n", d.small.width, d.small.height);
    p = (const uint8_t *)d.small.color;
    for (int i = 0; i < d.small.width * d.small.height; i++, p += 4) fwrite(p, 1, 3, stdout);
    scene_close(&s);
    display_free(&d);
    return 0;
}

/* ---- a window ------------------------------------------------------------------------------- */

static uint32_t xwd_word(const char *p)
{
    const unsigned char *b = (const unsigned char *)p;
    return (uint32_t)b[0] << 24 | (uint32_t)b[1] << 16 | (uint32_t)b[2] << 8 | b[3];
}

/* Letters mix with what is behind them. */
static int same_ink(uint32_t a, uint32_t b)
{
    int most = 0;
    for (int k = 0; k < 24; k += 8) {
        int d = abs((int)(a >> k & 255) - (int)(b >> k & 255));
        most = d > most ? d : most;
    }
    return most <= 24;
}

/* An X window dump: a header of 25 words, its colour map of 12 bytes an entry, rows of BGRX */
static int check_window(const char *color)
{
    uint32_t word[25] = { 0 }, wanted = (uint32_t)strtoul(color, NULL, 16), last = 1u << 31;
    int changes = 0, count = 0;
    size_t size, at;
    char *text = read_all(&size);
    for (size_t k = 0; k < 25 && 4 * k + 4 <= size; k++) word[k] = xwd_word(text + 4 * k);
    at = word[0] + 12 * (size_t)word[19];
    if (size < 100 || word[7] || word[11] != 32 || size < at + (size_t)word[5] * word[12]) return 1;
    for (uint32_t y = 0; y < word[5]; y++) {
        for (uint32_t x = 0; x < word[4]; x++) {
            const unsigned char *p = (unsigned char *)text + at + y * word[12] + 4 * x;
            uint32_t rgb = (uint32_t)p[2] << 16 | (uint32_t)p[1] << 8 | p[0];
            changes += rgb != last;
            count += same_ink(rgb, wanted);
            last = rgb;
        }
    }
    printf("%d %d %d %d\n", (int)word[4], (int)word[5], changes, count);
    free(text);
    return 0;
}

int main(int argc, char **argv)
{
    if (argc > 5) return check_pane(argv + 2, argc > 6 ? argv[6] : NULL);
    if (argc == 5) return write_picture(argv + 2);
    if (argc == 3) return check_window(argv[2]);
    for (int k = 0; k < 2000; k++) test_screen();
    for (int k = 0; k < 20000; k++) test_fit(k % 4 ? 2 * (k % 4) : 1);
    for (int k = 0; k < 20000; k++) test_dither(random_below(1 << 24));
    for (uint32_t grey = 8; grey < 248; grey++) test_dither(0x10101 * grey);
    test_answers();
    test_cells();
    test_strings();
    test_teapot(80, 24);
    test_teapot(200, 60);
    test_teapot(40, 60);
    test_teapot(120, 10);
    test_keys();
    test_move();
    test_again();
    test_endless();
    for (int k = 0; k < 20000; k++) test_bytes();
    printf("%d passed, %d failed\n", passed, failed);
    return failed != 0;
}
