/* pnm.h - reads PPM and PGM, as text or bytes, with any greatest value up to 65535.

       pnm p;
       const char *wrong = pnm_open(&p, bytes, size);
       if (!wrong) ... pnm_next(&p) ...            width * height * channels samples, 0 .. most */
#ifndef MODEL_PNM_H
#define MODEL_PNM_H

#include <stddef.h>

typedef struct pnm {
    const unsigned char *at, *end;
    int width, height, channels, most, plain; /* plain: text */
} pnm;

/* The next number of the header or of text; blanks and comments before it and the one character
   after it are skipped.  -1: there is none */
static inline int pnm_number(pnm *p)
{
    int c = p->at < p->end ? *p->at++ : -1, n = 0;
    while (c == ' ' || (c >= '\t' && c <= '\r') || c == '#') {
        if (c == '#')
            while (c != '\n' && c != -1) c = p->at < p->end ? *p->at++ : -1;
        else
            c = p->at < p->end ? *p->at++ : -1;
    }
    if (c < '0' || c > '9') return -1;
    for (; c >= '0' && c <= '9'; c = p->at < p->end ? *p->at++ : -1)
        n = n < 100000000 ? 10 * n + c - '0' : n;
    return n;
}

/* Reads the header.  Returns what is wrong, or NULL. */
static inline const char *pnm_open(pnm *p, const unsigned char *bytes, size_t size)
{
    const int magic = size > 1 && bytes[0] == 'P' ? bytes[1] : 0;
    static const pnm none;
    *p = none;
    if (magic < '2' || magic > '6' || magic == '4') return "neither PPM nor PGM";
    p->at = bytes + 2;
    p->end = bytes + size;
    p->plain = magic < '5';
    p->channels = magic == '2' || magic == '5' ? 1 : 3;
    p->width = pnm_number(p);
    p->height = pnm_number(p);
    p->most = pnm_number(p);
    if (p->width < 1 || p->height < 1 || p->most < 1 || p->most > 65535)
        return "a header without width, height and a maximum up to 65535";
    return p->width > 1 << 24 ? "more than 16777216 pixels in a row" : NULL;
}

/* The next sample; -1: the file ends before it, or it is no number */
static inline int pnm_next(pnm *p)
{
    const int bytes = p->most > 255 ? 2 : 1;
    const unsigned char *at = p->at;
    if (p->plain) return pnm_number(p);
    if (p->end - p->at < bytes) return -1;
    p->at += bytes;
    return bytes == 2 ? at[0] << 8 | at[1] : at[0];
}
#endif
