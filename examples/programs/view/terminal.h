/* terminal.h - a terminal that shows pictures: keys and mouse, output, its size, and its old state
   back whichever way the program ends.  POSIX. */
#ifndef VIEW_TERMINAL_H
#define VIEW_TERMINAL_H

#include "../../kit/command/clock.h"
#include <errno.h>
#include <poll.h>
#include <signal.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <sys/ioctl.h>
#include <sys/select.h>
#include <termios.h>
#include <unistd.h>

/* ---- what to ask a terminal before the first picture, and what its answers mean -------------- */

/* What the terminal has answered */
typedef struct terminal_answers {
    int kitty, iterm2, sixel;      /* pictures that it takes */
    int parts;                     /* 6 or 4: it draws glyphs of so many parts; 0: nobody knows */
    int inner;                     /* it is tmux or screen, which another terminal shows */
    int cell_width, cell_height;   /* pixels; 0: not said */
    int area_width, area_height;   /* pixels of all cells, as it counts them; 0: not said */
    struct winsize at;             /* the system's size when it said that */
    int sixel_width, sixel_height; /* pixels that sixels may have; 0: not said */
} terminal_answers;

/* A picture of one pixel in kitty's protocol, which is checked and not shown.  tmux and screen
   would take it for a title. */
#define TERMINAL_TRY_KITTY "\033_Gi=31,s=1,v=1,a=q,t=d,f=24;AAAA\033\\"
/* The primary attributes, where 4 is sixel.  Every terminal gives them (st gives no status report),
   so that they end the answers and tell that a frame has been shown. */
#define TERMINAL_REPORT "\033[c"
/* In order: the terminal's name (XTVERSION); iTerm2's list of features; the size of a cell, and of
   all cells; the largest sixels (XTSMGRAPHICS); the secondary attributes; the report. */
#define TERMINAL_QUESTIONS                                                                         \
    "\033[>0q\033]1337;Capabilities\033\\\033[16t\033[14t\033[?2;1;0S\033[>c" TERMINAL_REPORT

/* VTE has drawn sextants since 0.62. */
static inline int answers_vte_parts(int version) { return version >= 6200 ? 6 : 4; }

/* The parts of a cell that a terminal of this name draws itself, without a gap between cells */
static inline int answers_parts(const char *name)
{
    static const char *const six[] = { "kitty", "WezTerm", "ghostty", "foot", "contour" };
    for (size_t k = 0; k < sizeof six / sizeof *six; k++)
        if (!strncmp(name, six[k], strlen(six[k]))) return 6;
    return strncmp(name, "VTE(", 4) ? 4 : answers_vte_parts(atoi(name + 4));
}

/* tmux and screen answer for themselves, not for the terminal around them. */
static inline void answers_name(terminal_answers *a, const char *name)
{
    a->inner = !strncmp(name, "tmux", 4) || !strncmp(name, "screen", 6);
    a->parts = a->inner ? 0 : answers_parts(name);
}

/* The secondary attributes of VTE, which may have no other name: 65, its version, 1 */
static inline void answers_attributes(terminal_answers *a, const char *text)
{
    int version, last;
    if (a->parts || a->inner) return;
    if (sscanf(text, "\033[>65;%d;%dc", &version, &last) == 2 && last == 1)
        a->parts = answers_vte_parts(version);
}

/* 1: iTerm2's list holds FILE, inline pictures.  Its letter is F, as is that of focus reports, so
   that only two of them tell. */
static inline int answers_files(const char *features)
{
    const char *first = strchr(features, 'F');
    return first && strchr(first + 1, 'F');
}

/* The attributes of ?62;4;22, say */
static inline int answers_sixel(const char *p)
{
    for (p = strchr(p, ';'); p; p = strchr(p + 1, ';'))
        if (atoi(p + 1) == 4) return 1;
    return 0;
}

/* Takes one answer, whole, from its ESC on.  What it does not know it ignores. */
static inline void answers_take(terminal_answers *a, const unsigned char *answer, size_t size)
{
    static const char list[] = "\033]1337;Capabilities=";
    char text[400] = "";
    int width, height;
    if (size < 3 || size >= sizeof text) return;
    memcpy(text, answer, size);
    if (!strncmp(text, "\033_Gi=31;OK", 10))
        a->kitty = 1;
    else if (!strncmp(text, "\033P>|", 4))
        answers_name(a, text + 4);
    else if (!strncmp(text, list, sizeof list - 1))
        a->iterm2 = answers_files(text + sizeof list - 1);
    else if (!strncmp(text, "\033[?", 3) && text[size - 1] == 'c')
        a->sixel = answers_sixel(text);
    else if (!strncmp(text, "\033[>", 3))
        answers_attributes(a, text);
    else if (sscanf(text, "\033[4;%d;%dt", &height, &width) == 2 && height > 0 && width > 0) {
        a->area_height = height;
        a->area_width = width;
    } else if (sscanf(text, "\033[6;%d;%dt", &height, &width) == 2 && height > 0 && width > 0) {
        a->cell_height = height;
        a->cell_width = width;
    } else if (sscanf(text, "\033[?2;0;%d;%dS", &width, &height) == 2) {
        a->sixel_width = width;
        a->sixel_height = height;
    }
}

/* ---- state ----------------------------------------------------------------------------------- */

/* State that signal handlers change */
static struct termios terminal_before;
static volatile sig_atomic_t terminal_entered, terminal_resized, terminal_stopped,
    terminal_continued;
static volatile sig_atomic_t terminal_asked; /* reports that have been asked for and not received */
static volatile sig_atomic_t terminal_questioned; /* the last of so many ends the answers */
static volatile sig_atomic_t terminal_pictured;   /* it keeps pictures of kitty's protocol */

/* ---- keys and mouse -------------------------------------------------------------------------- */

typedef enum input_kind {
    INPUT_NONE,
    INPUT_KEY,
    INPUT_MOUSE,
    INPUT_ANSWERS, /* the terminal has answered all questions, or will not */
    INPUT_END
} input_kind;
/* bits of button, in xterm's count: of the middle and the right one, of shift, of motion */
enum { MOUSE_OTHER = 3, MOUSE_SHIFT = 4, MOUSE_MOVED = 32, MOUSE_WHEEL = 64 };
typedef struct input {
    input_kind kind;
    int key;                 /* a character, or KEY_... */
    int button, column, row; /* of the mouse, from 1 */
} input;

typedef struct terminal_keys {
    unsigned char text[512];
    size_t size;
    terminal_answers said;
} terminal_keys;

/* Reads the numbers of a sequence such as <0;12;5. */
static inline void terminal_numbers(const unsigned char *p, const unsigned char *end, int number[3])
{
    number[0] = number[1] = number[2] = 0;
    for (int k = 0; p < end && k < 3; p++) {
        if (*p == ';')
            k++;
        else if (*p >= '0' && *p <= '9' && number[k] < 100000)
            number[k] = number[k] * 10 + *p - '0';
    }
}

/* A control sequence whose last byte is *end */
static inline input terminal_sequence(const unsigned char *begin, const unsigned char *end)
{
    input in = { INPUT_NONE, 0, 0, 0, 0 };
    int number[3];
    terminal_numbers(begin, end, number);
    if (*end >= 'A' && *end <= 'D') {
        static const int arrow[4] = { KEY_UP, KEY_DOWN, KEY_RIGHT, KEY_LEFT };
        in.kind = INPUT_KEY;
        in.key = arrow[*end - 'A'];
        if (number[1] && (number[1] - 1) & 1) in.key += KEY_MOVE_UP - KEY_UP; /* with shift */
    } else if (*end == 'M' && begin < end && *begin == '<') {
        in.kind = INPUT_MOUSE;
        in.button = number[0];
        in.column = number[1];
        in.row = number[2];
    } else if (*end == 'c' && begin < end && *begin == '?') {
        if (terminal_asked > 0) terminal_asked--;
        if (terminal_questioned && !--terminal_questioned) in.kind = INPUT_ANSWERS;
    }
    return in;
}

/* 1: ESC and this byte may begin an answer in the form of a string.  They are also what Alt and a
   letter send, so they count only while answers are awaited, and the next byte must be theirs. */
static inline int terminal_begins_string(const unsigned char *p, size_t size)
{
    static const unsigned char begin[3] = { 'P', '_', ']' }, next[3] = { '>', 'G', '1' };
    for (int k = 0; k < 3 && terminal_questioned; k++)
        if (p[1] == begin[k]) return size < 3 || p[2] == next[k];
    return 0;
}

/* The size of such an answer, which ends in BEL or ESC \; 0: its end is not here. */
static inline size_t terminal_string(const unsigned char *p, size_t size)
{
    for (size_t n = 2; n < size; n++) {
        if (p[n] == 7) return n + 1;
        if (p[n] == '\\' && p[n - 1] == 27) return n + 1;
    }
    return size < 400 ? 0 : size;
}

/* The old form of the mouse, for terminals that know no other: ESC [ M and three bytes */
static inline size_t terminal_old_mouse(const unsigned char *p, size_t size, input *in)
{
    if (size < 6) return 0;
    in->kind = INPUT_MOUSE;
    in->button = p[3] - 32;
    in->column = p[4] - 32;
    in->row = p[5] - 32;
    if ((in->button & 3) == 3 && !(in->button & MOUSE_MOVED)) in->kind = INPUT_NONE;
    return 6;
}

/* Takes one key, click or report off the front.  Returns the bytes it had, 0: not all of it is
   here. */
static inline size_t terminal_parse(const unsigned char *p, size_t size, input *in)
{
    size_t n = 2;
    in->kind = INPUT_KEY;
    in->key = *p;
    if (*p != 27) return 1;
    in->kind = INPUT_NONE;
    if (size < 2) return 0;
    if (terminal_begins_string(p, size)) return terminal_string(p, size);
    if (p[1] != '[' && p[1] != 'O') return 1;
    while (n < size && p[n] >= ' ' && p[n] < '@') n++;
    if (n == size) return size < 64 ? 0 : size;
    if (n == 2 && p[1] == '[' && p[n] == 'M') return terminal_old_mouse(p, size, in);
    if (p[n] < 127 && p[n] >= '@') *in = terminal_sequence(p + 2, p + n);
    return n + 1;
}

/* ---- enter and leave ------------------------------------------------------------------------- */

/* Enters: the alternate screen, no cursor, reports of buttons and motion of the mouse in decimal */
#define TERMINAL_ENTER "\033[?1049h\033[?25l\033[?1002h\033[?1006h"
/* CAN ends a sequence that was cut off in the middle, ESC \ a picture; TERMINAL_FORGET deletes all
   pictures. */
#define TERMINAL_FORGET "\030\033\\\033_Ga=d,q=2,d=A\033\\"
/* Leaves; where there is no other screen (GNU screen), what follows stands below the picture. */
#define TERMINAL_LEAVE                                                                             \
    "\030\033[m\033[?1006l\033[?1002l\033[?2026l\033[?25h\033[999H\r\n\033[?1049l"

/* Returns 1 where the terminal accepts no more. */
static inline int terminal_write(const char *bytes, size_t size)
{
    while (size > 0) {
        ssize_t n = write(STDOUT_FILENO, bytes, size);
        struct pollfd out = { STDOUT_FILENO, POLLOUT, 0 };
        if (n < 0 && errno == EAGAIN) {
            n = 0;
            (void)poll(&out, 1, 1000);
        } else if (n < 0 && errno != EINTR)
            return 1;
        if (n > 0) {
            bytes += n;
            size -= (size_t)n;
        }
    }
    return 0;
}

/* Reads the reports that are on their way, so that the shell does not get them; waits a second at
   most. */
static inline void terminal_drain(void)
{
    static unsigned char text[512];
    const double end = clock_now() + 1;
    struct pollfd in = { STDIN_FILENO, POLLIN, 0 };
    size_t size = 0;
    while (terminal_asked > 0 && clock_now() < end) {
        input report;
        size_t used;
        ssize_t n = poll(&in, 1, 100) > 0 ? read(STDIN_FILENO, text + size, sizeof text - size) : 0;
        if (n > 0) size += (size_t)n;
        while (size && (used = terminal_parse(text, size, &report)) > 0) {
            size -= used;
            memmove(text, text + used, size);
        }
    }
    terminal_asked = 0;
}

/* Restores the terminal.  It is safe to call this in a signal handler, and twice. */
static inline void terminal_leave(void)
{
    int error = errno;
    if (!terminal_entered) return;
    terminal_entered = 0;
    if (terminal_pictured) terminal_write(TERMINAL_FORGET, sizeof TERMINAL_FORGET - 1);
    terminal_write(TERMINAL_LEAVE, sizeof TERMINAL_LEAVE - 1);
    terminal_drain();
    tcsetattr(STDIN_FILENO, TCSANOW, &terminal_before);
    errno = error;
}

static inline void terminal_enter(void)
{
    struct termios mode;
    if (!terminal_entered && tcgetattr(STDIN_FILENO, &terminal_before)) return;
    mode = terminal_before;
    mode.c_lflag &= ~(tcflag_t)(ICANON | ECHO | IEXTEN);
    mode.c_iflag &= ~(tcflag_t)(IXON | ICRNL);
    mode.c_cc[VMIN] = 1;
    mode.c_cc[VTIME] = 0;
    terminal_entered = 1;
    tcsetattr(STDIN_FILENO, TCSANOW, &mode);
    terminal_write(TERMINAL_ENTER, sizeof TERMINAL_ENTER - 1);
    terminal_resized = 1;
}

/* 1: between this program and the terminal stands another, which draws its screen. */
static inline int terminal_is_inner(void)
{
    const char *term = getenv("TERM");
    return getenv("TMUX") || getenv("STY") ||
           (term && (!strncmp(term, "tmux", 4) || !strncmp(term, "screen", 6)));
}

/* Asks what the terminal can show.  What arrives until INPUT_ANSWERS are the answers. */
static inline void terminal_ask(void)
{
    terminal_asked++;
    terminal_questioned = terminal_asked;
    if (!terminal_is_inner()) terminal_write(TERMINAL_TRY_KITTY, sizeof TERMINAL_TRY_KITTY - 1);
    terminal_write(TERMINAL_QUESTIONS, sizeof TERMINAL_QUESTIONS - 1);
}

/* ---- signals -------------------------------------------------------------------------------- */

/* SA_RESETHAND has put the default action back, which does the rest when this returns.  Until then
   all signals wait: a second ^C must not leave the terminal half restored. */
static inline void terminal_die(int number)
{
    terminal_leave();
    raise(number);
}

static inline void terminal_note(int number)
{
    if (number == SIGWINCH) terminal_resized = 1;
    if (number == SIGTSTP) terminal_stopped = 1;
    if (number == SIGCONT) terminal_continued = 1;
}

static inline void terminal_catch(int number, void (*handler)(int), int flags)
{
    struct sigaction action, before;
    memset(&action, 0, sizeof action);
    action.sa_handler = handler;
    action.sa_flags = flags;
    sigfillset(&action.sa_mask);
    if (!sigaction(number, NULL, &before) && before.sa_handler == SIG_IGN) return;
    sigaction(number, &action, NULL);
}

/* Every signal that ends a program leaves the terminal first, on a stack of its own: the program's
   may be what has run out.  Those that do not are held back until terminal_let_in or terminal_wait,
   whose mask this fills in. */
static inline void terminal_catch_all(sigset_t *mask)
{
    static const int fatal[] = { SIGHUP, SIGINT,  SIGQUIT, SIGILL,    SIGABRT, SIGFPE,  SIGSEGV,
                                 SIGBUS, SIGTERM, SIGPIPE, SIGALRM,   SIGUSR1, SIGUSR2, SIGTRAP,
                                 SIGSYS, SIGXCPU, SIGXFSZ, SIGVTALRM, SIGPROF };
    static const int noted[] = { SIGWINCH, SIGTSTP, SIGCONT };
    static char memory[65536];
    sigset_t held;
    stack_t stack;
    memset(&stack, 0, sizeof stack);
    stack.ss_sp = memory;
    stack.ss_size = sizeof memory;
    sigaltstack(&stack, NULL);
    for (size_t k = 0; k < sizeof fatal / sizeof *fatal; k++)
        terminal_catch(fatal[k], terminal_die, (int)(SA_RESETHAND | SA_ONSTACK));
    sigemptyset(&held);
    for (size_t k = 0; k < sizeof noted / sizeof *noted; k++) {
        terminal_catch(noted[k], terminal_note, 0);
        sigaddset(&held, noted[k]);
    }
    sigprocmask(SIG_BLOCK, &held, mask);
    for (size_t k = 0; k < sizeof noted / sizeof *noted; k++) sigdelset(mask, noted[k]);
}

/* Stops the program, as ^Z asks, and continues. */
static inline void terminal_stop(void)
{
    sigset_t stop, before;
    struct sigaction action, ours;
    terminal_stopped = 0;
    terminal_leave();
    memset(&action, 0, sizeof action);
    action.sa_handler = SIG_DFL;
    sigemptyset(&action.sa_mask);
    sigemptyset(&stop);
    sigaddset(&stop, SIGTSTP);
    sigaction(SIGTSTP, &action, &ours);
    raise(SIGTSTP);
    sigprocmask(SIG_UNBLOCK, &stop, &before);
    sigprocmask(SIG_SETMASK, &before, NULL);
    sigaction(SIGTSTP, &ours, NULL);
    terminal_enter();
    if (terminal_questioned) terminal_ask();
}

/* ---- size ----------------------------------------------------------------------------------- */

/* shape: the width of half a cell by its height */
typedef struct terminal_size {
    int columns, rows;
    float shape;
    int cell_width, cell_height, cell_known; /* pixels; 10 x 20 where nobody knows */
} terminal_size;

/* Takes the size of all cells for what they fill: the smaller one counts, for borders only add. */
static inline void terminal_take_area(int area[2], int width, int height)
{
    if (width > 0 && (!area[0] || width < area[0])) area[0] = width;
    if (height > 0 && (!area[1] || height < area[1])) area[1] = height;
}

/* 1: the largest sixels are as large as all cells: they are whole cells, and the system's size has
   the same border more in both directions.  xterm answers so. */
static inline int terminal_is_filled(const terminal_answers *said, const struct winsize *now)
{
    const int across = now->ws_xpixel - said->sixel_width,
              down = now->ws_ypixel - said->sixel_height;
    return said->sixel_width > 0 && across >= 0 && across == down &&
           said->sixel_width % now->ws_col == 0 && said->sixel_height % now->ws_row == 0;
}

/* The size of a cell in pixels.  The system's size of all cells has a border in xterm and Konsole,
   what the terminal says one in rxvt; VTE gives the system none.  What it has said is old where the
   system's has changed since. */
static inline void terminal_measure_cell(terminal_size *s, const terminal_answers *said,
                                         const struct winsize *now)
{
    const int pixels = now->ws_xpixel >= now->ws_col && now->ws_ypixel >= now->ws_row &&
                       now->ws_col && now->ws_row;
    const int fresh = !memcmp(now, &said->at, sizeof *now);
    const struct winsize *cells = pixels || fresh ? now : &said->at;
    int area[2] = { 0, 0 };
    if (!cells->ws_col || !cells->ws_row) return;
    if (pixels) terminal_take_area(area, now->ws_xpixel, now->ws_ypixel);
    if (fresh || !pixels) terminal_take_area(area, said->area_width, said->area_height);
    if (fresh && pixels && terminal_is_filled(said, now))
        terminal_take_area(area, said->sixel_width, said->sixel_height);
    if (!area[0] || !area[1]) return;
    s->cell_width = area[0] / cells->ws_col;
    s->cell_height = area[1] / cells->ws_row;
}

static inline terminal_size terminal_measure(const terminal_answers *said)
{
    terminal_size s = { 80, 24, 1, said->cell_width, said->cell_height, 1 };
    struct winsize w;
    memset(&w, 0, sizeof w);
    if (!ioctl(STDOUT_FILENO, TIOCGWINSZ, &w) && w.ws_col && w.ws_row) {
        s.columns = w.ws_col < 1000 ? w.ws_col : 1000;
        s.rows = w.ws_row < 500 ? w.ws_row : 500;
    }
    terminal_measure_cell(&s, said, &w);
    if (s.cell_width < 1 || s.cell_width > 100 || s.cell_height < 1 || s.cell_height > 200) {
        s.cell_width = 10;
        s.cell_height = 20;
        s.cell_known = 0;
    }
    s.shape = 2 * (float)s.cell_width / (float)s.cell_height;
    if (s.shape < 0.5f || s.shape > 2) s.shape = 1;
    return s;
}

/* ---- what arrives ---------------------------------------------------------------------------- */

/* Returns the next input; INPUT_NONE: there is none. */
static inline input terminal_next(terminal_keys *k)
{
    input in = { INPUT_NONE, 0, 0, 0, 0 };
    struct pollfd arrived = { STDIN_FILENO, POLLIN, 0 };
    for (;;) {
        size_t used;
        ssize_t n;
        while (k->size && (used = terminal_parse(k->text, k->size, &in)) > 0) {
            if (in.kind == INPUT_ANSWERS || (terminal_questioned && in.kind == INPUT_NONE))
                answers_take(&k->said, k->text, used);
            if (in.kind == INPUT_ANSWERS) ioctl(STDOUT_FILENO, TIOCGWINSZ, &k->said.at);
            k->size -= used;
            memmove(k->text, k->text + used, k->size);
            if (in.kind != INPUT_NONE) return in;
        }
        if (poll(&arrived, 1, 0) <= 0) return in;
        n = read(STDIN_FILENO, k->text + k->size, sizeof k->text - k->size);
        if (n < 0 && (errno == EINTR || errno == EAGAIN)) return in;
        if (n <= 0) in.kind = INPUT_END;
        if (n <= 0) return in;
        k->size += (size_t)n;
    }
}

/* Lets in the signals that were held back. */
static inline void terminal_let_in(const sigset_t *mask)
{
    sigset_t held;
    sigprocmask(SIG_SETMASK, mask, &held);
    sigprocmask(SIG_SETMASK, &held, NULL);
}

/* Waits for a key, a signal, or so many seconds. */
static inline void terminal_wait(double seconds, const sigset_t *mask)
{
    fd_set in;
    struct timespec t;
    if (seconds < 0) seconds = 0;
    t.tv_sec = (time_t)seconds;
    t.tv_nsec = (long)((seconds - (double)t.tv_sec) * 1e9);
    FD_ZERO(&in);
    FD_SET(STDIN_FILENO, &in);
    pselect(STDIN_FILENO + 1, &in, NULL, NULL, &t, mask);
}
#endif
