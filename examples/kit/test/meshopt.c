/* meshopt.c - what npm's meshoptimizer has packed and unpacked (meshopt.txt, by meshopt.mjs) is
   unpacked to the same bytes, by filters to the same numbers but for one unit of rounding; what is
   cut off or changed is refused or stays within its memory.
       meshopt examples/kit/test/meshopt.txt */
#define SHADE_IMPLEMENTATION
#include "examples/kit/read/meshopt.h"

static int passed, failed;

static void check(int ok, const char *what, int line)
{
    passed += ok;
    failed += !ok;
    if (!ok) printf("FAIL  %s, line %d\n", what, line);
}

/* The bytes of two digits each, at *text, which moves behind them */
static size_t from_hex(char **text, unsigned char *out)
{
    size_t n = 0;
    long long byte;
    while (**text == ' ') ++*text;
    for (; (byte = mesh_hex((unsigned char *)*text, (unsigned char *)*text + 2, 2)) >= 0;
         *text += 2)
        out[n++] = (unsigned char)byte;
    return n;
}

/* How far two lists of numbers are apart, of so many bytes each */
static int apart(const unsigned char *a, const unsigned char *b, size_t size, size_t bytes)
{
    int most = 0;
    for (size_t i = 0; i < size; i += bytes) {
        const int d = abs(meshopt_get(a + i, bytes, 1) - meshopt_get(b + i, bytes, 1));
        most = d > most ? d : most;
    }
    return most;
}

/* The same of memory that ends where they end, so that sanitizers see what reads on */
static int unpack(const meshopt_view *v, const unsigned char *bytes, size_t size,
                  unsigned char *out)
{
    unsigned char *exact = (unsigned char *)malloc(size + !size);
    int result;
    memcpy(exact, bytes, size);
    result = meshopt_unpack(v, exact, size, out);
    free(exact);
    return result;
}

static void try_line(char *text, int line)
{
    static unsigned char packed[20000], want[20000];
    meshopt_view v = { MESHOPT_ATTRIBUTES, MESHOPT_NONE, 0, 0 };
    size_t size, all;
    unsigned char *got;
    v.mode = (meshopt_mode)strtol(text, &text, 10);
    v.filter = (meshopt_filter)strtol(text, &text, 10);
    v.count = (size_t)strtol(text, &text, 10);
    v.stride = (size_t)strtol(text, &text, 10);
    size = from_hex(&text, packed);
    all = from_hex(&text, want);
    check(all == v.count * v.stride && !meshopt_is_wrong(&v), "a case", line);
    check(meshopt_least(&v) <= (double)size, "no more memory than a bound of its bytes", line);
    got = (unsigned char *)calloc(all + 1, 1);
    check(!unpack(&v, packed, size, got), "it is unpacked", line);
    if (v.filter == MESHOPT_NONE || v.filter == MESHOPT_EXPONENTIAL)
        check(!memcmp(got, want, all), "to the same bytes", line);
    else
        check(apart(got, want, all, v.stride / 4) <= 1, "to the same numbers", line);
    for (size_t cut = 0; cut < size; cut += 1 + size / 50)
        check(unpack(&v, packed, cut, got) != 0, "cut off, it is refused", line);
    for (size_t i = 0; i < size; i++) { /* whatever comes out, the sanitizers watch */
        packed[i] ^= (unsigned char)(1 << i % 8);
        unpack(&v, packed, size, got);
        packed[i] ^= (unsigned char)(1 << i % 8);
    }
    free(got);
}

int main(int count, char **argument)
{
    static char text[60000];
    FILE *file = count == 2 ? fopen(argument[1], "r") : NULL;
    int line = 0;
    while (file && fgets(text, sizeof text, file)) try_line(text, ++line);
    if (file) fclose(file);
    check(line > 60, "there are cases", line);
    printf("%d passed, %d failed\n", passed, failed);
    return failed != 0;
}
