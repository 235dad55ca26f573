/* refuse.h - arguments that are refused by name: what is wrong with which, in words that all
   languages show.  A function of the core takes a core_refusal, and returns its code: 0 where all
   is well.

       core_refusal why = { 0 };
       if (core_number(&why, "fov", fov, 0.01, 179)) printf("%s %s\n", why.argument, why.text);

   prints "fov must be from 0.01 to 179, not 200".  Once something is refused the rest is not
   looked at: a function that checks ten arguments tells of the first. */
#ifndef CORE_REFUSE_H
#define CORE_REFUSE_H

#include <math.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>
#include <stdio.h>
#include <string.h>

typedef enum core_code {
    CORE_OK,
    CORE_RANGE,  /* a number that is too small or too large, NaN or infinite */
    CORE_RIGID,  /* a matrix that is no rotation and translation */
    CORE_CHOICE, /* a word that is none of those that there are */
    CORE_SHAPE,  /* numbers that do not go together */
    CORE_FACES   /* indices that are no faces of so many vertices */
} core_code;

typedef struct core_refusal {
    int32_t code;
    char argument[64]; /* "fov", "poses[3]" */
    char text[384];    /* "must be ..." */
} core_refusal;

/* Notes what is wrong, unless something was before; returns the code that is noted. */
static inline int core_refuse(core_refusal *r, core_code code, const char *argument,
                              const char *format, ...)
{
    va_list list;
    if (r->code) return r->code;
    r->code = (int32_t)code;
    snprintf(r->argument, sizeof r->argument, "%s", argument);
    va_start(list, format);
    vsnprintf(r->text, sizeof r->text, format, list);
    va_end(list);
    return r->code;
}

/* x is finite, and from low to high, which may be infinite */
static inline int core_number(core_refusal *r, const char *argument, double x, double low,
                              double high)
{
    if (x - x == 0 && x >= low && x <= high) return r->code;
    if (low - low != 0 && high - high != 0)
        return core_refuse(r, CORE_RANGE, argument, "must be finite, not %g", x);
    return core_refuse(r, CORE_RANGE, argument, "must be from %g to %g, not %g", low, high, x);
}

/* Numbers that fit floats */
static inline int core_numbers(core_refusal *r, const char *argument, const double *x, int count)
{
    for (int i = 0; i < count; i++)
        if (!(x[i] <= 3e38 && x[i] >= -3e38))
            return core_refuse(r, CORE_RANGE, argument,
                               "must hold finite numbers that fit float32");
    return r->code;
}

/* m: 16 numbers, row by row: a rotation and a translation.  Returns 1 where it is, within 1/1000
   of unit length and of right angles, and with 0, 0, 0, 1 in the last row. */
static inline int core_is_rigid(const double *m)
{
    double turned = 0;
    for (int i = 0; i < 3; i++) {
        const double *a = m + 4 * i, *b = m + 4 * ((i + 1) % 3), *c = m + 4 * ((i + 2) % 3);
        for (int j = 0; j < 3; j++) {
            const double *other = m + 4 * j;
            const double off = a[0] * other[0] + a[1] * other[1] + a[2] * other[2] - (i == j);
            if (!(off < 1e-3 && off > -1e-3)) return 0;
        }
        if (!(a[3] < 3e38 && a[3] > -3e38)) return 0;
        if (!(m[12 + i] < 1e-3 && m[12 + i] > -1e-3)) return 0;
        turned += a[0] * (b[1] * c[2] - b[2] * c[1]) / 3;
    }
    return turned > 0 && m[15] < 1 + 1e-3 && m[15] > 1 - 1e-3;
}

static inline int core_rigid(core_refusal *r, const char *argument, const double *m)
{
    if (r->code || core_is_rigid(m)) return r->code;
    return core_refuse(
        r, CORE_RIGID, argument,
        "must be a rotation and a translation, without scale or mirror, with 0, 0, 0, 1 "
        "in the last row: a translation stands in the last column");
}

/* The place of a word among all, which NULL ends; -1: refused */
static inline int core_choice(core_refusal *r, const char *argument, const char *word,
                              const char *const *all)
{
    char list[256] = "";
    for (int i = 0; all[i]; i++) {
        const size_t used = strlen(list);
        if (!strcmp(word, all[i])) return r->code ? -1 : i;
        snprintf(list + used, sizeof list - used, "%s%s", i ? ", " : "", all[i]);
    }
    core_refuse(r, CORE_CHOICE, argument, "must be one of %s, not '%.40s'", list, word);
    return -1;
}

/* Faces of so many corners, 3 or 4, as whole numbers below vertices, become triangles in out,
   which has room for 3 or 6 indices a face.  Rows of four that all begin with 3 are faces as VTK
   has them, and no polygons of four corners.  Returns the indices that were made, -1: refused */
static inline int64_t core_faces(core_refusal *r, const char *argument, const double *faces,
                                 size_t rows, int columns, double vertices, uint32_t *out)
{
    static const int cut[6] = { 0, 1, 2, 0, 2, 3 };
    const size_t each = columns == 4 ? 6 : 3, corners = rows * (size_t)columns;
    size_t threes = 0;
    if (columns != 3 && columns != 4)
        core_refuse(r, CORE_SHAPE, argument, "must have the shape (n, 3) or (n, 4), not (n, %d)",
                    columns);
    for (size_t i = 0; i < rows && columns == 4; i++) threes += faces[4 * i] == 3;
    if (threes > 1 && threes == rows)
        core_refuse(r, CORE_FACES, argument,
                    "begin with 3 in each row, as VTK has them: leave the first column out");
    for (size_t i = 0; i < corners && !r->code; i++) {
        const double x = faces[i];
        if (x != floor(x) || x - x != 0)
            core_refuse(r, CORE_FACES, argument, "must hold whole numbers, not %g", x);
        else if (!(x >= 0 && x < vertices))
            core_refuse(r, CORE_FACES, argument, "bad indices (index %.0f of %.0f vertices)", x,
                        vertices);
    }
    for (size_t i = 0; i < rows && !r->code; i++)
        for (size_t k = 0; k < each; k++)
            out[each * i + k] = (uint32_t)faces[(size_t)columns * i + (size_t)cut[k]];
    return r->code ? -1 : (int64_t)(each * rows);
}
#endif
