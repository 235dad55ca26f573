/* explain.c - no sentence of shade_explain is false: see explained.h. */
#include "input.h"

#include <math.h>

static fuzz_input explain_input;
static int explained_pick(int n)
{
    const uint32_t low = fuzz_byte(&explain_input), high = n > 256 ? fuzz_byte(&explain_input) : 0;
    return (int)((low | high << 8) % (uint32_t)n);
}
#include "explained.h"

int LLVMFuzzerTestOneInput(const uint8_t *data, size_t size)
{
    static explained e;
    const char *wrong;
    explain_input.at = data;
    explain_input.end = data + size;
    wrong = ex_false_sentence(&e, size % 4 == 3);
    if (wrong) fprintf(stderr, "%s\n", wrong);
    HOLDS(!wrong);
    return 0;
}
