/* known.h - what a reader does with the names of its format: statements, properties, elements,
   extensions.  Each format has lists of them (model_known in files.h), which
   examples/kit/test/contract.sh walks: it holds programs and packages to them. */
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

/* Text is the same in capital and small letters, as in the statements of most formats. */
static inline known_what known_find(const known_name *list, const void *name, size_t n)
{
    const unsigned char *p = (const unsigned char *)name;
    for (; list->name; list++) {
        size_t i = 0;
        while (i < n && list->name[i] && ((p[i] ^ list->name[i]) & ~32) == 0) i++;
        if (i == n && !list->name[n]) return list->what;
    }
    return KNOWN_TOLD;
}

/* For a name that is not drawn: notes or refuses it as the list says, or where required is set.
   Returns non-zero with the error in r. */
static inline int known_take(mesh_reader *r, model *m, known_what what, int required,
                             const void *name, size_t n)
{
    char text[104];
    const size_t there = strlen(m->unread);
    size_t size = n < 100 ? n : 100;
    if (what < KNOWN_TOLD) return 0;
    for (size_t i = 0; i < size; i++) {
        const unsigned char c = ((const unsigned char *)name)[i];
        text[i] = (char)(c < ' ' || c == 127 ? '?' : c);
    }
    text[size] = 0;
    if (what == KNOWN_REFUSED || required)
        return mesh_fail(r, "it needs %s, which is not read", text);
    for (const char *at = m->unread; (at = strstr(at, text)) != NULL; at++)
        if ((at == m->unread || at[-1] == ' ') && (!at[size] || at[size] == ',')) return 0;
    if (there + size + 3 >= sizeof m->unread) return 0;
    if (there) memcpy(m->unread + there, ", ", 2);
    memcpy(m->unread + there + (there ? 2 : 0), text, size + 1);
    return 0;
}

/* The same for the word that comes next in text */
static inline int known_word(mesh_reader *r, model *m, const known_name *list)
{
    mesh_reader end = *r;
    while (!mesh_at_word_end(&end)) end.at++;
    if (end.at == r->at) return 0;
    return known_take(r, m, known_find(list, r->at, (size_t)(end.at - r->at)), 0, r->at,
                      (size_t)(end.at - r->at));
}

static inline const char *known_are(const model *m)
{
    return strchr(m->unread, ',') ? "are" : "is";
}

/* Fails because there is nothing to draw, and names what was noted. */
static inline int known_nothing(mesh_reader *r, const model *m, const char *what)
{
    if (!m->unread[0]) return mesh_fail(r, "%s", what);
    return mesh_fail(r, "%s, but %s, which %s not read", what, m->unread, known_are(m));
}

/* Warns of what was noted. */
static inline void known_tell(model *m, const char *about)
{
    char text[sizeof m->unread + 40];
    if (!m->unread[0]) return;
    snprintf(text, sizeof text, "it has %s, which %s not read", m->unread, known_are(m));
    model_warn(m, about, text);
    m->unread[0] = 0;
}
#endif
