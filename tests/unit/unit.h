/* unit.h - what the sections are written with. */
#ifndef UNIT_H
#define UNIT_H

#include "shade.h"
#include "test.h"
#include "oracle.h"
#include "canvas.h"
#include "rows.h"
#include "samples.h"
#include "meshes.h"
#include <stddef.h>

/* ---- good arguments that are spoilt one field at a time, as the rows of a table ----------------

   A test of refusals puts all arguments of a call into one struct and makes them good.  For each
   row of its table it spoils a copy and checks that the call returns what the row wants. */

/* A bad value of one field. */
typedef struct fault {
    size_t at, size; /* the bytes of the field; size 0 where a row has no more faults */
    int number;      /* the value of an int or an enumerator; 0 sets a pointer to NULL */
    float real;      /* the value of a float */
    int is_real;     /* which of the two it is */
} fault;

enum { FAULTS = 4 }; /* faults in a row, at most */

typedef struct refusal {
    shade_result want; /* what the call returns */
    fault faults[FAULTS];
} refusal;

/* Sets a field that is an int or an enumerator. */
#define FAULT(type, field, number)                                             \
    { offsetof(type, field), sizeof(int), (int)(number), 0, 0 }

/* Sets a field that is a float. */
#define FAULT_REAL(type, field, real)                                          \
    { offsetof(type, field), sizeof(float), 0, (float)(real), 1 }

/* Sets a field that is a pointer to NULL. */
#define FAULT_NULL(type, field)                                                \
    { offsetof(type, field), sizeof(void *), 0, 0, 0 }

/* Spoils an object of the type that the row was written for. */
static inline void spoil(void *object, const fault faults[FAULTS])
{
    for (int k = 0; k < FAULTS && faults[k].size; k++) {
        unsigned char *field = (unsigned char *)object + faults[k].at;
        memset(field, 0, faults[k].size);
        if (faults[k].is_real) {
            memcpy(field, &faults[k].real, sizeof faults[k].real);
        } else if (faults[k].number) {
            memcpy(field, &faults[k].number, sizeof faults[k].number);
        }
    }
}

/* Checks what a call returned for a row of its table. */
static inline void check_refusal(int row, shade_result got, shade_result want)
{
    CHECK_SAY(got == want, "row %d: got %d, want %d", row, (int)got, (int)want);
}

#endif
