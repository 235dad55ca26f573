/* wires.h - lines in runs with boxes around them, by which bands of a picture skip the lines that
   they do not see. */
#ifndef MODEL_WIRES_H
#define MODEL_WIRES_H

#include "shade.h"
#include <stdlib.h>
#include <string.h>

typedef struct wires { /* zeroed: none */
    shade_vec3 *point; /* pairs */
    int points;
    shade_vec4 *color; /* of each line; NULL: that of the pen */
    shade_chunk *run;
    int runs;
} wires;

static inline void wires_free(wires *w)
{
    static const wires none;
    free(w->point);
    free(w->color);
    free(w->run);
    *w = none;
}

enum { WIRES_RUN = 256 }; /* lines in a box */

/* Finds the runs, each of one colour.  Without memory there are none.  Returns 1 then. */
static inline int wires_find_runs(wires *w)
{
    shade_chunk *run = NULL;
    w->run = (shade_chunk *)malloc(((size_t)w->points / 2 + 1) * sizeof *w->run);
    w->runs = 0;
    for (int i = 0; i < w->points && w->run; i++) {
        const shade_vec4 *color = w->color ? &w->color[i / 2] : NULL;
        const int fresh = !run || run->count == 2 * WIRES_RUN ||
                          (color && memcmp(color, &w->color[run->first / 2], sizeof *color) != 0);
        if (fresh && i % 2 == 0) {
            run = &w->run[w->runs++];
            *run = (shade_chunk){ w->point[i], w->point[i], i, 0 };
        }
        run->low = shade_min(run->low, w->point[i]);
        run->high = shade_max(run->high, w->point[i]);
        run->count++;
    }
    return !w->run;
}

/* Draws the lines that reach the band; the test widens the band by the width of the pen. */
static inline shade_result wires_draw(const wires *w, const shade_target *band,
                                      shade_line_state pen)
{
    const int wider = (int)pen.width + 2;
    shade_result result = SHADE_OK;
    shade_target near_band = *band;
    near_band.clip_y -= wider;
    near_band.clip_height += 2 * wider;
    for (int k = 0; k < w->runs && !result; k++) {
        const shade_chunk *run = &w->run[k];
        if (!shade_box_visible(&near_band, pen.clip_from_points, 0, run->low, run->high)) continue;
        if (w->color) pen.color = w->color[run->first / 2];
        pen.raster.blend = pen.color.w < 1 ? SHADE_BLEND_OVER : SHADE_BLEND_REPLACE;
        result = shade_draw_lines(band, w->point + run->first, run->count, &pen, NULL);
    }
    return result;
}
#endif
