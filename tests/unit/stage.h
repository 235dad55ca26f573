/* stage.h - a scene of mistakes.h, on the heap. */
#ifndef STAGE_H
#define STAGE_H

#include "mistakes.h"

static inline stage *stage_open(void)
{
    stage *s = (stage *)test_memory(sizeof *s);
    stage_of_ball(s);
    return s;
}

#endif
