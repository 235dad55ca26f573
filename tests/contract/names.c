/* names.c - prints the names of all formats that examples/kit/read knows, one a line: format, kind,
   name, what becomes of it. */
#include "examples/kit/read/files.h"

int main(void)
{
    static const char *const what[] = { "drawn", "silent", "told", "refused" };
    for (size_t i = 0; i < sizeof model_known / sizeof *model_known; i++)
        for (const known_name *n = model_known[i].names; n->name; n++)
            printf("%s\t%s\t%s\t%s\n", model_known[i].format, model_known[i].kind, n->name,
                   what[n->what]);
    return 0;
}
