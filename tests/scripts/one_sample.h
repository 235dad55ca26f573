/* one_sample.h - included before a lesson: its pictures have one sample a pixel. */
#include "../../examples/shared/canvas.h"
#define canvas_new(w, h, samples) canvas_new(w, h, 1)
