/* shade.c - the library as the fuzz targets link it: any vector width, chosen at run time; for
   FUZZ_BITS, which compares versions, the widest that there is. */
#ifndef FUZZ_BITS
extern int fuzz_level;
#define SHADE__LEVEL fuzz_level
#endif
#define SHADE_IMPLEMENTATION
#include "shade.h"

/* Runs a target on files, where there is no fuzzer to link with. */
#ifdef FUZZ_REPLAY
#include <stdio.h>
#include <stdlib.h>

int LLVMFuzzerTestOneInput(const uint8_t *data, size_t size);

int main(int argc, char **argv)
{
    for (int k = 1; k < argc; k++) {
        uint8_t *bytes = (uint8_t *)malloc(1 << 20);
        FILE *file = fopen(argv[k], "rb");
        size_t size;
        if (!file || !bytes) {
            fprintf(stderr, "%s: cannot be read\n", argv[k]);
            return 2;
        }
        size = fread(bytes, 1, 1 << 20, file);
        fclose(file);
        LLVMFuzzerTestOneInput(bytes, size);
        free(bytes);
    }
    printf("%d inputs\n", argc - 1);
    return 0;
}
#endif

/* Prints a hash of what a target leaves in memory for each random input: count, first seed. */
#ifdef FUZZ_BITS
#include <stdio.h>
#include <stdlib.h>

int LLVMFuzzerTestOneInput(const uint8_t *data, size_t size);
extern uint64_t fuzz_bits;

int main(int argc, char **argv)
{
    const uint64_t count = argc > 1 ? strtoull(argv[1], NULL, 10) : 1000;
    const uint64_t first = argc > 2 ? strtoull(argv[2], NULL, 10) : 1;
    for (uint64_t seed = first; seed < first + count; seed++) {
        uint8_t bytes[1024];
        uint64_t x = seed * 0x9E3779B97F4A7C15u + 1;
        for (size_t i = 0; i < sizeof bytes; i++) {
            x ^= x << 13;
            x ^= x >> 7;
            x ^= x << 17;
            bytes[i] = (uint8_t)(x >> 32);
        }
        fuzz_bits = 0;
        LLVMFuzzerTestOneInput(bytes, sizeof bytes);
        printf("%llu %016llx\n", (unsigned long long)seed, (unsigned long long)fuzz_bits);
    }
    return 0;
}
#endif
