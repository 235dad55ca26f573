/* explain.c - no sentence of shade_explain is false: see explained.h.

   With EXPLAIN_STATES it is a program: states KIND COUNT [FIRST] judges COUNT states of a kind,
   random or ordinary, prints each sentence's count and what is false, and fails where anything
   is.  States are numbered; a COUNT of 1 shows one again. */
#include "input.h"

#include <math.h>
#include <stddef.h>

#ifdef EXPLAIN_STATES
static uint64_t explain_random;
static int explained_pick(int n)
{
    explain_random = explain_random * 6364136223846793005u + 1442695040888963407u;
    return (int)((explain_random >> 33) % (uint64_t)n);
}
#else
static fuzz_input explain_input;
static int explained_pick(int n)
{
    const uint32_t low = fuzz_byte(&explain_input), high = n > 256 ? fuzz_byte(&explain_input) : 0;
    return (int)((low | high << 8) % (uint32_t)n);
}
#endif
#include "explained.h"

#ifdef EXPLAIN_STATES
int main(int count, char **words)
{
    enum { SHOWN = 5 };          /* false sentences of a row that are printed */
    static explained e;
    static long times[EX_CLAIMS], wrong[EX_CLAIMS];
    const int ordinary = count > 1 && !strcmp(words[1], "ordinary");
    const long states = count > 2 ? atol(words[2]) : 1000, first = count > 3 ? atol(words[3]) : 0;
    long said = 0, falsehoods = 0, black = 0, silent = 0, never = 0;
    for (long k = first; k < first + states; k++) {
        const char *text;
        int row;
        explain_random = ((uint64_t)k * 2 + (uint64_t)ordinary) * 0x9E3779B97F4A7C15u;
        explained_pick(2);
        if (ordinary) ex_ordinary(&e);
        else ex_random(&e);
        row = ex_explain(&e, k % 2 == 0, &text);
        said += *text != 0;
        if (row == EX_NOTHING) {
            const int dark = ex_is_black(&e);
            silent++;
            black += dark;
            if (dark && black <= SHOWN)
                printf("black, and nothing is said: %ld (%s, %s)\n", k, e.made[0], e.made[1]);
        }
        if (row >= EX_FALSE) {
            const int claim = row - EX_FALSE;
            falsehoods++;
            if (claim == EX_CLAIMS || wrong[claim]++ < SHOWN)
                printf("false: %ld (%s, %s) %s\n", k, e.made[0], e.made[1], text);
        }
        if (row >= 0 && row % EX_FALSE < EX_CLAIMS) times[row % EX_FALSE]++;
    }
    for (int k = 0; k < EX_CLAIMS; k++) {
        printf("%9ld  %s", times[k], claims[k].words);
        if (wrong[k]) printf("   %ld FALSE", wrong[k]);
        printf("\n");
        never += !times[k];
    }
    printf("%ld %s states, %ld sentences, %ld false, %ld black pictures without a sentence; "
           "%ld rows were never said\n",
           states, ordinary ? "ordinary" : "random", said, falsehoods, black, never);
    return falsehoods != 0;
}
#else
int LLVMFuzzerTestOneInput(const uint8_t *data, size_t size)
{
    static explained e;
    const char *said;
    int row;
    explain_input.at = data;
    explain_input.end = data + size;
    if (size % 4 == 3) ex_ordinary(&e);
    else ex_random(&e);
    row = ex_explain(&e, size % 2, &said);
    if (row >= EX_FALSE) fprintf(stderr, "%s\n", said);
    HOLDS(row < EX_FALSE);
    return 0;
}
#endif
