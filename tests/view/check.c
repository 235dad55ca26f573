/* check.c - what view sends to terminals and takes from them, held against a small terminal that
   decodes it; and whether a captured pane of tmux shows the picture that shade.h draws.

       check                                          all tests of encoding and decoding
       check pane COLORS COLUMNS ROWS KEYS [model]    a pane on standard input, as
                                                      tmux capture-pane -e -N -p prints it
       check window RRGGBB                            a window on standard input, as xwd writes it:
                                                      prints its width, height, how many colours
                                                      follow one another, and pixels near one */
#define _DEFAULT_SOURCE
#define SHADE_IMPLEMENTATION
#include "shade.h"
#include "examples/view/display.h"

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
enum { UPPER_HALF = 0x2580, LOWER_HALF = 0x2584, FULL_BLOCK = 0x2588 };

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

/* The two pixels of a cell; returns the character where it is none of theirs. */
static uint32_t vt_pixels(const vt_cell *c, uint32_t *upper, uint32_t *lower)
{
    *upper = c->glyph == UPPER_HALF || c->glyph == FULL_BLOCK ? c->ink : c->paper;
    *lower = c->glyph == LOWER_HALF || c->glyph == FULL_BLOCK ? c->ink : c->paper;
    if (c->glyph == UPPER_HALF || c->glyph == LOWER_HALF || c->glyph == FULL_BLOCK) return 0;
    return c->glyph;
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

/* Cells of the terminal that are not the wanted ones, to slack */
static int wrong_cells(const cell_screen *s, const vt *t, const cell *want, int slack)
{
    int wrong = 0;
    for (int i = 0; i < s->columns * s->rows; i++) {
        uint32_t upper, lower, glyph = vt_pixels(&t->cells[i], &upper, &lower);
        uint32_t want_upper = encoded(s, want[i].upper), want_lower = encoded(s, want[i].lower);
        if (want[i].glyph) {
            wrong += glyph != want[i].glyph || differ(t->cells[i].paper, want_lower, slack) ||
                     (glyph != ' ' && differ(t->cells[i].ink, want_upper, slack));
        } else {
            wrong += (glyph && glyph != ' ') || differ(upper, want_upper, slack) ||
                     differ(lower, want_lower, slack) || (s->whole && t->cells[i].glyph != ' ');
        }
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
        c->upper = random_color(s);
        c->lower = random_below(3) ? random_color(s) : c->upper;
        c->glyph = s->colors == VIEW_PLAIN || !random_below(6) ? ' ' + random_below(95) : 0;
        if (s->whole && !c->glyph) c->lower = c->upper;
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
    s.whole = !random_below(4);
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

/* The nearest of all 240, by exhaustion */
static void test_nearest(uint32_t rgb)
{
    static const int level[6] = { 0, 95, 135, 175, 215, 255 };
    int best = INT_MAX, got = 0;
    uint32_t number = cells_nearest(rgb);
    for (uint32_t n = 16; n < 256; n++) {
        uint32_t k = n - 16;
        int c[3] = { level[k / 36 % 6], level[k / 6 % 6], level[k % 6] }, sum = 0;
        static const int weight[3] = { 3, 6, 2 };
        if (n >= 232) c[0] = c[1] = c[2] = 8 + 10 * (int)(n - 232);
        for (int i = 0; i < 3; i++) {
            int d = c[i] - (int)(rgb >> (16 - 8 * i) & 255);
            sum += weight[i] * d * d;
        }
        if (sum < best) best = sum;
        if (n == number) got = sum;
    }
    check(got == best, "distance of the nearest colour", got, best);
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
    test_key("\033[<64;10;3M", (input){ INPUT_MOUSE, 0, 64, 10, 3 });
    test_key("\033[<32;100;200M", (input){ INPUT_MOUSE, 0, 32, 100, 200 });
    test_key("\033[M`+#", (input){ INPUT_MOUSE, 0, 64, 11, 3 });
    test_key("\033[<0;1;1m", (input){ INPUT_NONE, 0, 0, 0, 0 });
    test_key("\033[200~", (input){ INPUT_NONE, 0, 0, 0, 0 });
    terminal_asked = 1;
    test_key("\033[0n", (input){ INPUT_NONE, 0, 0, 0, 0 });
    check(terminal_asked == 0, "reports owed", terminal_asked, 0);
    test_key("\033[0n", (input){ INPUT_NONE, 0, 0, 0, 0 });
    check(terminal_asked == 0, "reports owed after one too many", terminal_asked, 0);
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
    while (at < size && used) {
        input in;
        used = terminal_parse(text + at, size - at, &in);
        check(used <= size - at, "bytes taken", (long long)used, (long long)(size - at));
        at += used;
    }
    check(at == size || (text[at] == 27 && size - at < 64), "bytes left", (long long)(size - at),
          0);
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
    terminal_size size = { columns, rows, 1 };
    static scene s;
    static display d;
    int all, middle = columns / 2, edge = 1, spout;
    d.scene = &s;
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

/* The cells of a scene at rest after some keys; < > ^ v are the arrows */
static void draw_wanted(display *d, const view_options *o, const char *keys)
{
    static const char arrows[] = "^v<>";
    static scene s;
    terminal_size size = { d->screen.columns, d->screen.rows, 1 };
    const scene_request request = view_request(o);
    if (scene_load(&s, &request, NULL, NULL)) exit(1);
    for (; *keys; keys++) {
        const char *arrow = strchr(arrows, *keys);
        scene_key(&s, arrow ? KEY_UP + (int)(arrow - arrows) : *keys);
    }
    d->scene = &s;
    d->at_rest = 1;
    display_resize(d, size);
    display_picture(d);
    scene_close(&s);
}

/* What view writes over the picture, above and below, is taken from the pane. */
static void forgive_words(cell_screen *s, const vt *t)
{
    for (int i = 0; i < s->columns * s->rows; i++) {
        uint32_t upper, lower, glyph = vt_pixels(&t->cells[i], &upper, &lower);
        int row = i / s->columns, words = !row || row == s->rows - 1;
        if (!words || !glyph || s->columns < 20 || s->rows < 5) continue;
        s->wanted[i].glyph = glyph;
        s->wanted[i].upper = t->cells[i].ink & 0xffffff;
        s->wanted[i].lower = t->cells[i].paper & 0xffffff;
    }
}

static int check_pane(char **argv, const char *model)
{
    static const char *const colors[3] = { "plain", "256", "true" };
    view_options o = { .scene = { .model = model, .still = 1, .how = model_options_new() } };
    static display d;
    size_t size;
    char *text = read_all(&size);
    int wrong;
    vt t;
    while (o.colors < VIEW_TRUE && strcmp(argv[0], colors[o.colors])) o.colors++;
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
    if (argc == 3) return check_window(argv[2]);
    for (int k = 0; k < 2000; k++) test_screen();
    for (int k = 0; k < 100000; k++) test_nearest(random_below(1 << 24));
    test_teapot(80, 24);
    test_teapot(200, 60);
    test_teapot(40, 60);
    test_teapot(120, 10);
    test_keys();
    test_endless();
    for (int k = 0; k < 20000; k++) test_bytes();
    printf("%d passed, %d failed\n", passed, failed);
    return failed != 0;
}
