/* library.c - the library that shade_h/_native.py loads */
#include "examples/kit/native.c"
