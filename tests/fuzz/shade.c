/* shade.c - the library as the fuzz targets link it: any vector width, chosen at run time. */
extern int fuzz_level;
#define SHADE__LEVEL fuzz_level
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
