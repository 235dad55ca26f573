/* picture.h - a picture for a small machine, drawn in strips of a few rows. */
#ifndef PICTURE_H
#define PICTURE_H

#include "shade.h"

/* A strip takes WIDTH x ROWS x (2 bytes of colour + 4 of depth) = 9,600 bytes. */
enum { PICTURE_WIDTH = 320, PICTURE_HEIGHT = 240, PICTURE_ROWS = 5 };

/* Pixels in order, two bytes each, the high one first (from a little-endian machine): what display
   controllers take, so that a strip goes to the bus as it is. */
typedef void picture_send(const uint8_t *bytes, size_t size);

/* The whole scene into a target of the picture's size, or into a strip of it */
void picture_draw(const shade_target *target);

/* The whole picture, strip after strip */
void picture_strips(picture_send *send);
#endif
