/* shade.c - the one file of the program that holds the implementation. */
#define SHADE_IMPLEMENTATION
#include "shade.h"
