/* shade.c - the library as the fuzz targets link it: any vector width, chosen at run time. */
extern int fuzz_level;
#define SHADE__LEVEL fuzz_level
#define SHADE_IMPLEMENTATION
#include "shade.h"
