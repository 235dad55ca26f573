/* clock.h - a clock that never goes backward.  POSIX or Windows. */
#ifndef MODEL_CLOCK_H
#define MODEL_CLOCK_H

#ifdef _WIN32
#include "paths.h"
#else
#include <time.h>
#endif

/* Seconds since some moment in the past */
static inline double clock_now(void)
{
#ifdef _WIN32
    LARGE_INTEGER ticks, second;
    QueryPerformanceCounter(&ticks);
    QueryPerformanceFrequency(&second);
    return (double)ticks.QuadPart / (double)second.QuadPart;
#else
    struct timespec t;
    clock_gettime(CLOCK_MONOTONIC, &t);
    return (double)t.tv_sec + 1e-9 * (double)t.tv_nsec;
#endif
}
#endif
