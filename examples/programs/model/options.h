/* options.h - reads the command line of a program: its options, each of which takes one value or
   none, and its files.

       static int take(void *to, const char *name, const char *value) { ... }
       static const char *const valued[] = { "--size", NULL }, *const flags[] = { "--quiet", NULL };
       const command c = { "thumbnail", usage, valued, flags, 2, take };
       int end = options_read(&c, &settings, argc, argv);
       if (end) return end == OPTIONS_WRONG;

   Options and files may come in any order.  Whatever is wrong is one line on stderr. */
#ifndef MODEL_OPTIONS_H
#define MODEL_OPTIONS_H

#include <stdarg.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include "shade.h"

/* What options_read returns: go on; a line on stderr has said what is wrong; --help, or another
   option that is a question, has been answered. */
enum { OPTIONS_READ, OPTIONS_WRONG, OPTIONS_ANSWERED };

/* What a take function returns: the value is none that this option can have; it is stored; or
   OPTIONS_ANSWERED. */
enum { OPTION_BAD, OPTION_TAKEN };

/* Stores the value of the option called name.  A flag has the value "", a file the name NULL. */
typedef int option_take(void *to, const char *name, const char *value);

typedef struct command {
    const char *name, *usage;
    const char *const *valued, *const *flags; /* options with a value and without, up to a NULL */
    int files;                                /* at most so many */
    option_take *take;
} command;

/* The program's name, which begins its lines on stderr */
static const char *program_name = "";

/* Prints one line on stderr, whatever bytes the names of files in it hold.  Returns 1, the exit
   status of most programs that fail. */
static inline int complain(const char *format, ...)
{
    char text[1000];
    va_list values;
    va_start(values, format);
    vsnprintf(text, sizeof text, format, values);
    va_end(values);

    for (char *c = text; *c; c++)
        if ((unsigned char)*c < 32) *c = '?';
    fprintf(stderr, "%s: %s\n", program_name, text);
    return 1;
}

/* ---- values ---------------------------------------------------------------------------------- */

/* Reads digits at *text, which moves behind them.  1: the number is within lowest .. highest. */
static inline int option_digits(const char **text, int lowest, int highest, int *out)
{
    long long value = 0;
    const char *begin = *text;
    for (; **text >= '0' && **text <= '9'; ++*text)
        if (value <= highest) value = value * 10 + (**text - '0');
    *out = (int)value;
    return *text > begin && value >= lowest && value <= highest;
}

static inline int option_integer(const char *text, int lowest, int highest, int *out)
{
    return option_digits(&text, lowest, highest, out) && !*text;
}

/* WIDTHxHEIGHT, each from 1 to most */
static inline int option_size(const char *text, int most, int *width, int *height)
{
    return option_digits(&text, 1, most, width) && *text == 'x' &&
           option_integer(text + 1, 1, most, height);
}

/* Samples along each edge of a pixel: 1, 2 or 4 */
static inline int option_samples(const char *text, int *out)
{
    return option_integer(text, 1, 4, out) && *out != 3;
}

/* An upright axis: 0 .. 5 */
static const char *const option_axes[] = { "x", "y", "z", "-x", "-y", "-z" };
static inline int option_axis(const char *text, int *out)
{
    for (int i = 0; i < 6; i++) {
        if (strcmp(text, option_axes[i]) != 0) continue;
        *out = i;
        return 1;
    }
    return 0;
}

/* ---- the command line ------------------------------------------------------------------------ */

static inline int option_among(const char *const *list, const char *name)
{
    while (*list && strcmp(*list, name)) list++;
    return *list != NULL;
}

/* The values that an option can have: what its usage says in one line, without the word that
   stands for the value; of a list of values "1, 2 or 4".  The text of an option ends where a line
   does not begin with more blanks than an option's. */
static inline void option_said(const char *usage, const char *name, char *out, size_t room)
{
    size_t n = strlen(name), used = 0;
    const char *at = strstr(usage, name), *bar, *end;
    while (at && (at[-1] != ' ' || at[n] != ' ')) at = strstr(at + n, name);
    *out = 0;
    if (!at) return;
    at += n + 1;
    for (end = at + strcspn(at, " "); *at < 'A' || *at > 'Z'; at = bar + 1) {
        bar = at + strcspn(at, "| ");
        used += (size_t)snprintf(out + used, room - used, "%s%.*s", !used ? ""
                                 : bar == end ? " or " : ", ", (int)(bar - at), at);
        if (bar == end) return;
    }
    for (at = end; *at && used + 1 < room; at++) {
        if (*at == '\n' && strncmp(at + 1, "    ", 4) != 0) break;
        if (*at != ' ' && *at != '\n')
            out[used++] = *at;
        else if (used && out[used - 1] != ' ')
            out[used++] = ' ';
    }
    out[used] = 0;
}

/* The option or file at argv[*i].  Moves *i onto the last word that belongs to it. */
static inline int options_take(const command *c, void *to, int argc, char **argv, int *i)
{
    const char *name = argv[*i];
    char said[400];
    int taken;
    if (option_among(c->flags, name)) {
        c->take(to, name, "");
        return OPTIONS_READ;
    }
    if (!option_among(c->valued, name)) {
        complain("unknown option %s (--help lists them)", name);
        return OPTIONS_WRONG;
    }
    if (++*i == argc) {
        complain("%s needs a value", name);
        return OPTIONS_WRONG;
    }

    taken = c->take(to, name, argv[*i]);
    if (taken == OPTIONS_ANSWERED) return OPTIONS_ANSWERED;
    if (taken == OPTION_TAKEN) return OPTIONS_READ;
    option_said(c->usage, name, said, sizeof said);
    complain("%s %s: %s", name, argv[*i], said);
    return OPTIONS_WRONG;
}

static inline int options_read(const command *c, void *to, int argc, char **argv)
{
    int files = 0, end = OPTIONS_READ;
    program_name = c->name;
    for (int i = 1; i < argc && end == OPTIONS_READ; i++) {
        if (!strcmp(argv[i], "--help")) {
            fputs(c->usage, stdout);
            return OPTIONS_ANSWERED;
        }
        if (!strcmp(argv[i], "--version")) {
            printf("%s %d.%d.%d\n", c->name, SHADE_VERSION / 10000, SHADE_VERSION / 100 % 100,
                   SHADE_VERSION % 100);
            return OPTIONS_ANSWERED;
        }
        if (!strncmp(argv[i], "--", 2)) {
            end = options_take(c, to, argc, argv, &i);
        } else if (files++ == c->files) {
            complain("one file too many: %s", argv[i]);
            return OPTIONS_WRONG;
        } else {
            c->take(to, NULL, argv[i]);
        }
    }
    return end;
}
#endif
