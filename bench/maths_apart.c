/* maths_apart.c - shade.h with its implementation in another file: what is not inline is called. */
#include "shade.h"
#include "maths.h"
#include "maths_shade.h"

const maths_library *maths_shade_apart(void)
{
    static const maths_library library = { "shade.h", shade_mat4_mat4, shade_mat4_vec4,
                                           shade_normalize_all, shade_inverse_transpose };
    return &library;
}
