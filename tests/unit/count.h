/* count.h - counts the tiles that shade.h looks at; for the build of the implementation. */
#ifndef COUNT_H
#define COUNT_H

extern long tiles_tested;
#define SHADE__TILE_TESTED() (tiles_tested++)

#endif
