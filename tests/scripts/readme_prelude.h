/* readme_prelude.h - what the snippets of the README go on from: the variables of its program, at
   file scope. */
#ifndef README_PRELUDE_H
#define README_PRELUDE_H
#include "shade.h"

static shade_target target;
static shade_mesh mesh;
static shade_draw_state state;
static shade_vec3 eye;
#endif
