/* label.h - short captions in a 5 x 7 font of capitals, figures and + - = . / ^ ( ) ,

   Small letters are written as capitals; what the font lacks, as a blank. */
#ifndef EXAMPLES_LABEL_H
#define EXAMPLES_LABEL_H

#include "shade.h"
#include <string.h>

/* The shapes in the order of label_order, fifteen to a band of seven rows, one column apart */
static const char label_order[] = "ABCDEFGHIJKLMNOPQRSTUVWXYZ0123456789+-=./^(),";
static const char *const label_shape[21] = {
    " ###  ####   #### ####  ##### #####  #### #   #  ###      # #   # #     #   # #   #  ###  ",
    "#   # #   # #     #   # #     #     #     #   #   #       # #  #  #     ## ## ##  # #   # ",
    "#   # #   # #     #   # #     #     #     #   #   #       # # #   #     # # # # # # #   # ",
    "##### ####  #     #   # ####  ####  #  ## #####   #       # ##    #     # # # # # # #   # ",
    "#   # #   # #     #   # #     #     #   # #   #   #       # # #   #     #   # #  ## #   # ",
    "#   # #   # #     #   # #     #     #   # #   #   #   #   # #  #  #     #   # #   # #   # ",
    "#   # ####   #### ####  ##### #      #### #   #  ###   ###  #   # ##### #   # #   #  ###  ",

    "####   ###  ####   #### ##### #   # #   # #   # #   # #   # #####  ###    #    ###  ####  ",
    "#   # #   # #   # #       #   #   # #   # #   # #   # #   #     # #   #  ##   #   #     # ",
    "#   # #   # #   # #       #   #   # #   # #   #  # #   # #     #  #  ##   #       #     # ",
    "####  #   # ####   ###    #   #   # #   # # # #   #     #     #   # # #   #     ##   ###  ",
    "#     # # # # #       #   #   #   #  # #  # # #  # #    #    #    ##  #   #    #        # ",
    "#     #  #  #  #      #   #   #   #  # #  ## ## #   #   #   #     #   #   #   #         # ",
    "#      ## # #   # ####    #    ###    #   #   # #   #   #   #####  ###   ###  ##### ####  ",

    "   #  #####  ###  #####  ###   ###                              #   #      #   #          ",
    "  ##  #     #         # #   # #   #   #                        #   # #    #     #         ",
    " # #  ####  #        #  #   # #   #   #         #####          #  #   #  #       #        ",
    "#  #      # ####     #   ###   #### #####  ###                #          #       #        ",
    "#####     # #   #   #   #   #     #   #         #####        #           #       #   ##   ",
    "   #  #   # #   #   #   #   #     #   #                ##    #            #     #    ##   ",
    "   #   ###   ###    #    ###   ###                     ##   #              #   #     #    ",
};

/* Width in units of dot: 6 for each letter, but none after the last */
static inline int label_width(const char *text) { return 6 * (int)strlen(text) - 1; }

/* Top left corner at pixel x, y; each dot of the font is dot x dot pixels.  Depth is left alone. */
static inline void label_draw(const shade_target *target, int x, int y, int dot, shade_vec3 color,
                              const char *text)
{
    shade_target t = *target;
    t.depth = NULL, t.clip_width = t.clip_height = dot;
    for (; *text; text++, x += 6 * dot) {
        char letter = (char)(*text >= 'a' && *text <= 'z' ? *text - 'a' + 'A' : *text);
        const char *found = strchr(label_order, letter);
        int number = found ? (int)(found - label_order) : 0;
        for (int k = 0; found && k < 35; k++) {
            if (label_shape[number / 15 * 7 + k / 5][number % 15 * 6 + k % 5] != '#') continue;
            t.clip_x = x + k % 5 * dot, t.clip_y = y + k / 5 * dot;
            shade_clear(&t, shade_v4(color.x, color.y, color.z, 1), 1);
        }
    }
}

/* The same, centred about column x */
static inline void label_center(const shade_target *target, int x, int y, int dot, shade_vec3 color,
                                const char *text)
{
    label_draw(target, x - label_width(text) * dot / 2, y, dot, color, text);
}
#endif
