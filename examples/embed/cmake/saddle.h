/* saddle.h - the monkey saddle 2 z = x^3 - 3 x y^2, of jade, turned about its axis. */
#include "shade.h"

shade_result saddle_draw(const shade_target *target, float turn);
