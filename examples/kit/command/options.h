/* options.h - reads the command line of a program: its options, each of which takes one value or
   none, and its files.

       static const option own[] = {
           { "--size", take_size, 0, 0, 0 },
           { "--rate", NULL, offsetof(settings, rate), 1, 240 },
           { "--quiet", NULL, offsetof(settings, quiet), 1, 0 },
           { NULL, NULL, 0, 0, 0 }
       };
       static const option_group groups[] = { { own, 0, NULL }, { NULL, 0, NULL } };
       const command c = { "view", usage, groups, offsetof(settings, files), 2, 2, "", NULL };
       int end = options_read(&c, &settings, argc, argv);
       if (end) return end == OPTIONS_WRONG;

   Options and files may come in any order, --option=value is --option value, what stands behind --
   are files.  Whatever is wrong is one line on stderr. */
#ifndef MODEL_OPTIONS_H
#define MODEL_OPTIONS_H

#include <errno.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include "shade.h"

/* What options_read returns: go on; a line on stderr has said what is wrong; --help, or another
   option that is a question, has been answered. */
enum { OPTIONS_READ, OPTIONS_WRONG, OPTIONS_ANSWERED }; /* complain returns the second */

/* What a take function returns: the value is none that this option can have; it is stored;
   OPTIONS_ANSWERED; or it is bad, and complain has said why. */
enum { OPTION_BAD, OPTION_TAKEN, OPTION_TOLD = OPTIONS_ANSWERED + 1 };

/* Stores the value of an option. */
typedef int option_take(void *to, const char *value);

/* What stands at .at in the settings of its group gets the value by .take.  Without take it is an
   int: a number from .least to .most, or where .most is 0 a flag, which gets .least. */
typedef struct option {
    const char *name;
    option_take *take;
    size_t at;
    int least, most;
} option;

/* Two options of which the first says nothing beside the other, or, where needed is set, without
   it */
typedef struct option_pair {
    const char *one, *other;
    int needed;
} option_pair;

/* Options up to one without a name, where their settings lie in those of the program, and pairs
   of them up to one without names, or NULL */
typedef struct option_group {
    const option *options;
    size_t at;
    const option_pair *pairs;
} option_group;

typedef struct command {
    const char *name, *usage;
    const option_group *groups; /* up to one without options */
    size_t files;               /* where an array of names is in the settings */
    int least_files, most_files;
    const char *many;                           /* what a user may have wanted who names more */
    void (*notice)(void *to, const char *name); /* told of each option, or NULL */
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

/* Reads a decimal number at *text, which moves behind it.  1: it is within lowest .. highest. */
static inline int option_number(const char **text, double lowest, double highest, double *out)
{
    const size_t decimal = strspn(*text, "+-.0123456789eE"); /* no blank, 0x1F, inf */
    char *end;
    *out = strtod(*text, &end);
    if (end == *text || (size_t)(end - *text) > decimal) return 0;
    *text = end;
    return *out >= lowest && *out <= highest;
}

/* WIDTHxHEIGHT, each from 1 to most */
static inline int option_size(const char *text, int most, int *width, int *height)
{
    return option_digits(&text, 1, most, width) && *text == 'x' &&
           option_integer(text + 1, 1, most, height);
}

/* Samples along each edge of a pixel: 1, 2 or 4 */
static inline int option_samples(void *to, const char *value)
{
    return option_integer(value, 1, 4, (int *)to) && *(int *)to != 3;
}

/* An upright axis: 0 .. 5 */
static const char *const option_axes[] = { "x", "y", "z", "-x", "-y", "-z" };
static inline int option_axis(void *to, const char *value)
{
    for (int i = 0; i < 6; i++) {
        if (strcmp(value, option_axes[i]) != 0) continue;
        *(int *)to = i;
        return 1;
    }
    return 0;
}

/* ---- the command line ------------------------------------------------------------------------ */

/* The name as the list has it, or NULL */
static inline const char *option_among(const char *const *list, const char *name)
{
    while (*list && strcmp(*list, name)) list++;
    return *list;
}

static inline int option_is_flag(const option *o) { return !o->take && !o->most; }

/* The option of that name, or NULL; *to moves to where its value belongs. */
static inline const option *options_find(const command *c, const char *name, void **to)
{
    for (const option_group *g = c->groups; g->options; g++) {
        for (const option *o = g->options; o->name; o++) {
            if (strcmp(o->name, name) != 0) continue;
            *to = (char *)*to + g->at + o->at;
            return o;
        }
    }
    return NULL;
}

/* The values that an option can have: what its usage says in one line, without the word that
   stands for the value; of a list of values "1, 2 or 4".  The text of an option ends where a line
   does not begin with more blanks than an option's. */
static inline void option_said(const char *usage, const char *name, char *out, size_t room)
{
    char line[48];
    size_t used = 0;
    const int n = snprintf(line, sizeof line, "\n  %s ", name);
    const char *at = strstr(usage, line), *bar, *end;
    *out = 0;
    if (!at) return;
    at += n;
    for (end = at + strcspn(at, " "); *at < 'A' || *at > 'Z'; at = bar + 1) {
        bar = at + strcspn(at, "| ");
        used += (size_t)snprintf(out + used, room - used, "%s%.*s",
                                 !used        ? ""
                                 : bar == end ? " or "
                                              : ", ",
                                 (int)(bar - at), at);
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

/* The name under which a program is installed, where it has been called by that; else its own */
static inline const char *options_name(const command *c, const char *path)
{
    const char *slash = path ? strrchr(path, '/') : NULL, *name = slash ? slash + 1 : path;
    return name && !strncmp(name, "shade-", 6) && !strcmp(name + 6, c->name) ? name : c->name;
}

/* The usage behind "usage: " and the program's own name, with which it begins */
static inline const char *options_words(const command *c)
{
    return c->usage + strlen("usage: ") + strlen(c->name);
}

/* The end of an answer on standard output, if all of it was written */
static inline int options_answered(void)
{
    if (!fflush(stdout) && !ferror(stdout)) return OPTIONS_ANSWERED;
    complain("standard output: %s", strerror(errno));
    return OPTIONS_WRONG;
}

/* The names of the options that were there, each once */
typedef struct options_seen {
    const char *name[65];
} options_seen;

/* Returns OPTIONS_WRONG where options do not go together; a line on stderr has said which. */
static inline int options_check(const command *c, const options_seen *seen)
{
    for (const option_group *g = c->groups; g->options; g++)
        for (const option_pair *p = g->pairs; p && p->one; p++)
            if (option_among(seen->name, p->one) &&
                (option_among(seen->name, p->other) != NULL) == !p->needed)
                return complain(p->needed ? "%s needs %s" : "%s does not go with %s", p->one,
                                p->other);
    return OPTIONS_READ;
}

/* Takes the option at argv[*i].  Moves *i onto the last word that belongs to it. */
static inline int options_take(const command *c, void *to, int argc, char **argv, int *i,
                               options_seen *seen)
{
    const char *equals = strchr(argv[*i], '='), *value = equals ? equals + 1 : NULL;
    const size_t n = equals ? (size_t)(equals - argv[*i]) : strlen(argv[*i]);
    char word[40], said[400];
    void *at = to;
    const option *o;
    int taken = OPTION_TAKEN;
    snprintf(word, sizeof word, "%.*s", n < sizeof word ? (int)n : 0, argv[*i]);
    o = options_find(c, word, &at);
    if (!o) return complain("unknown option %s (--help lists them)", argv[*i]);
    if (option_is_flag(o) && value) return complain("%s: %s takes no value", argv[*i], word);
    if (!option_is_flag(o) && !value && ++*i < argc) value = argv[*i];
    if (!option_is_flag(o) && !value) return complain("%s needs a value", o->name);

    if (option_is_flag(o))
        *(int *)at = o->least;
    else
        taken = o->take ? o->take(at, value) : option_integer(value, o->least, o->most, (int *)at);
    for (int k = 0; k < 64 && (!k || seen->name[k - 1] != o->name); k++)
        if (!seen->name[k]) seen->name[k] = o->name;
    if (c->notice) c->notice(to, o->name);
    if (taken == OPTIONS_ANSWERED) return options_answered();
    if (taken == OPTION_TAKEN) return OPTIONS_READ;
    if (taken == OPTION_TOLD) return OPTIONS_WRONG;
    option_said(c->usage, o->name, said, sizeof said);
    return complain("%s %s: %s%s", o->name, value, o->take ? "" : "a whole number: ", said);
}

/* Answers --help and --version.  Returns 0 where the word is neither. */
static inline int options_answer(const command *c, const char *word)
{
    if (!strcmp(word, "--help")) {
        printf("usage: %s%s", program_name, options_words(c));
        return 1;
    }
    if (strcmp(word, "--version") != 0) return 0;
    printf("%s %d.%d.%d\n", program_name, SHADE_VERSION / 10000, SHADE_VERSION / 100 % 100,
           SHADE_VERSION % 100);
    return 1;
}

static inline int options_read(const command *c, void *to, int argc, char **argv)
{
    int files = 0, end = OPTIONS_READ, rest = 0;
    options_seen seen = { { NULL } };
    program_name = options_name(c, argv[0]);
    for (int i = 1; i < argc && end == OPTIONS_READ; i++) {
        if (!rest && options_answer(c, argv[i])) return options_answered();
        if (!rest && !strcmp(argv[i], "--")) {
            rest = 1;
        } else if (!rest && argv[i][0] == '-' && argv[i][1]) {
            end = options_take(c, to, argc, argv, &i, &seen);
        } else if (files == c->most_files) {
            return complain("one file too many: %s%s", argv[i], c->many);
        } else {
            ((const char **)(void *)((char *)to + c->files))[files++] = argv[i];
        }
    }
    if (end == OPTIONS_READ) end = options_check(c, &seen);
    if (end != OPTIONS_READ || files >= c->least_files) return end;
    fprintf(stderr, "usage: %s%.*s\n%s: --help lists the options\n", program_name,
            (int)strcspn(options_words(c), "\n"), options_words(c), program_name);
    return OPTIONS_WRONG;
}
#endif
