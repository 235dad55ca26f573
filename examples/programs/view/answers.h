/* answers.h - what to ask a terminal before the first picture, and what its answers mean. */
#ifndef VIEW_ANSWERS_H
#define VIEW_ANSWERS_H

#include <stdio.h>
#include <stdlib.h>
#include <string.h>

/* What the terminal has answered */
typedef struct terminal_answers {
    int kitty, iterm2, sixel;      /* pictures that it takes */
    int parts;                     /* 6 or 4: it draws glyphs of so many parts; 0: nobody knows */
    int cell_width, cell_height;   /* pixels; 0: not said */
    int sixel_width, sixel_height; /* pixels that sixels may have; 0: not said */
} terminal_answers;

/* A picture of one pixel in kitty's protocol, which is checked and not shown.  tmux and screen
   would take it for a title. */
#define TERMINAL_TRY_KITTY "\033_Gi=31,s=1,v=1,a=q,t=d,f=24;AAAA\033\\"
/* In order: the terminal's name (XTVERSION); iTerm2's list of features; the size of a cell; the
   largest sixels (XTSMGRAPHICS); the primary attributes, where 4 is sixel; and a report that every
   terminal gives, so that it ends the answers. */
#define TERMINAL_QUESTIONS "\033[>0q\033]1337;Capabilities\033\\\033[16t\033[?2;1;0S\033[c\033[5n"

/* The parts of a cell that a terminal of this name draws itself, without a gap between cells.
   VTE has drawn sextants since 0.62.  tmux and screen answer for themselves, not for the terminal
   around them. */
static inline int answers_parts(const char *name)
{
    static const char *const six[] = { "kitty", "WezTerm", "ghostty", "foot", "contour" };
    for (size_t k = 0; k < sizeof six / sizeof *six; k++)
        if (!strncmp(name, six[k], strlen(six[k]))) return 6;
    if (!strncmp(name, "VTE(", 4)) return atoi(name + 4) >= 6200 ? 6 : 4;
    return strncmp(name, "tmux", 4) && strncmp(name, "screen", 6) ? 4 : 0;
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
        a->parts = answers_parts(text + 4);
    else if (!strncmp(text, list, sizeof list - 1))
        a->iterm2 = answers_files(text + sizeof list - 1);
    else if (!strncmp(text, "\033[?", 3) && text[size - 1] == 'c')
        a->sixel = answers_sixel(text);
    else if (sscanf(text, "\033[6;%d;%dt", &height, &width) == 2 && height > 0 && width > 0) {
        a->cell_height = height;
        a->cell_width = width;
    } else if (sscanf(text, "\033[?2;0;%d;%dS", &width, &height) == 2) {
        a->sixel_width = width;
        a->sixel_height = height;
    }
}
#endif
