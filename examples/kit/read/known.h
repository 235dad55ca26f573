/* known.h - what a reader does with the names of its format: statements, properties, elements,
   extensions.  Each format has a list; tests/readers/contract.sh walks all of them. */
#ifndef MODEL_KNOWN_H
#define MODEL_KNOWN_H

#include "model.h"

typedef enum known_what {
    KNOWN_DRAWN,  /* it is read */
    KNOWN_SILENT, /* nothing of it shows in a picture of shade.h */
    KNOWN_TOLD,   /* left out, and a warning names it, as names that are in no list */
    KNOWN_REFUSED /* a file that has it is refused, and the error names it */
} known_what;

typedef struct known_name {
    const char *name;
    known_what what;
} known_name;

static inline known_what known_find(const known_name *list, const void *name, size_t n)
{
    for (; list->name; list++)
        if (strlen(list->name) == n && !memcmp(list->name, name, n)) return list->what;
    return KNOWN_TOLD;
}

/* For a name that is not drawn: tells of it or refuses it as the list says, or where required is
   set.  Returns non-zero with the error in r. */
static inline int known_take(mesh_reader *r, model *m, known_what what, int required,
                             const void *name, size_t n)
{
    char text[160];
    const int refused = what == KNOWN_REFUSED || (required && what == KNOWN_TOLD);
    int length = (int)(n < 100 ? n : 100);
    if (what < KNOWN_TOLD) return 0;
    length = snprintf(text, sizeof text, "it %s %.*s, which is not read", refused ? "needs" : "has",
                      length, (const char *)name);
    for (int i = 0; i < length; i++)
        if (text[i] >= 0 && (text[i] < ' ' || text[i] == 127)) text[i] = '?';
    if (refused) return mesh_fail(r, "%s", text);
    model_warn(m, r->name, text);
    return 0;
}
#endif
