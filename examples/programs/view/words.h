/* words.h - the words over a picture of pixels: what is shown, what the last key did, the keys. */
#ifndef VIEW_WORDS_H
#define VIEW_WORDS_H

#include "../../shared/label.h"
#include "../../kit/scene/scene.h"

typedef struct words {
    const scene *scene;
    float em;           /* pixels */
    int rate;           /* frames a second; 0: not shown */
    int help;           /* the keys are shown */
    const char *corner; /* at the right of the last row */
    uint32_t corner_ink;
} words;

/* Draws text.  column counts ems from the left, or, below 0, from the right edge; a row below 0
   is the last one. */
static inline void words_set(const words *w, const shade_target *t, float column, int row,
                             uint32_t color, const char *text)
{
    float em = w->em, x = em * (column + 0.5f), y = em * (1.1f + 1.3f * (float)row);
    if (column < 0) x = (float)t->width - em / 2 - label_width(em, text);
    if (row < 0) y = (float)t->height - em / 2;
    label_set(t, x, y, em, shade_rgb(color), text);
}

/* The list of keys, and, from the fifteenth character on, their effects */
static inline void words_help(const words *w, const shade_target *t)
{
    shade_target box = *t;
    box.clip_x = (int)(0.5f * w->em);
    box.clip_y = (int)(2.6f * w->em);
    box.clip_width = (int)(26 * w->em);
    box.clip_height = (int)(1.3f * (SCENE_HELP + 2) * w->em);
    shade_clear(&box, shade_v4(0.007f, 0.01f, 0.013f, 1), 1);
    for (int k = 0; k < SCENE_HELP; k++) {
        char keys[16];
        snprintf(keys, sizeof keys, "%.15s", scene_help[k]);
        words_set(w, t, 1, k + 3, SCENE_BOX_INK, keys);
        words_set(w, t, 8.5f, k + 3, SCENE_BOX_INK, scene_help[k] + 15);
    }
}

static inline void words_draw(const words *w, const shade_target *t)
{
    const uint32_t ink = scene_ink(w->scene);
    char rate[40];
    snprintf(rate, sizeof rate, "%d fps", w->rate);
    words_set(w, t, 0, 0, ink, scene_caption(w->scene).text);
    if (w->rate) words_set(w, t, -1, 0, ink, rate);
    words_set(w, t, -1, -1, w->corner_ink, w->corner);
    words_set(w, t, 0, -1, ink, w->scene->said);
    if (w->help) words_help(w, t);
}
#endif
