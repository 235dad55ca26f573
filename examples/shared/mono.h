/* mono.h - the printable characters of ASCII in cells of 10 x 20 pixels, for listings.

   The shapes are those of 10x20 of X11's fonts misc-fixed ("Public domain font.  Share and enjoy.";
   package xfonts-base of Debian). */
#ifndef SHARED_MONO_H
#define SHARED_MONO_H

#include "canvas.h"
#include <string.h>

enum { MONO_WIDTH = 10, MONO_HEIGHT = 20 };

/* From "!" on: 20 rows from the top, each of two digits to the base 32, whose bits are pixels from
   the left */
static const char mono_shapes[94][2 * MONO_HEIGHT + 1] = {
    "0000001g1g1g1g1g1g1g1g1g1g001g1g00000000", "0000006c6c6c2800000000000000000000000000",
    "000000001m1m1m7v3c3c3cfu6o6o6o0000000000", "0000001g7sdmdgdgdg7s1m1m1mdm7s1g00000000",
    "0000000076dmds7c0o0o1g1g3e3r6r6e00000000", "0000003g6o6o6o7g3070dgcrcecceu7j00000000",
    "0000001g1g1g1g10000000000000000000000000", "0000000c0o1g1g30303030301g1g0o0c00000000",
    "00000060301g1g0o0o0o0o0o1g1g306000000000", "0000000000006c6c3ofu3o6c6c00000000000000",
    "0000000000001g1g1gfu1g1g1g00000000000000", "00000000000000000000000000001o1o3g000000",
    "000000000000000000fu00000000000000000000", "000000000000000000000000001o1o1o00000000",
    "0000000006060c0c0o0o1g1g3030606000000000", "0000001g3o6c6cc6c6c6c6c66c6c3o1g00000000",
    "0000001g3g7gdg1g1g1g1g1g1g1g1gfu00000000", "0000003o6cc6c606060c1o3060c0c0fu00000000",
    "0000003o6cc6c6060c1o0c06c6c66c3o00000000", "000000040c0s1s3c6cccccfu0c0c0c0c00000000",
    "000000fuc0c0c0c0doec060606c66c3o00000000", "0000003o6cc4c0c0doecc6c6c6c66c3o00000000",
    "000000fu06060c0c0o0o1g1g3030606000000000", "0000003o6cc6c6c66c3o6cc6c6c66c3o00000000",
    "0000003o6cc6c6c6c66e3m0606466c3o00000000", "00000000000000001o1o000000001o1o00000000",
    "00000000000000001o1o000000001o1o3g000000", "000000040c0o1g3060c060301g0o0c0400000000",
    "00000000000000fu00000000fu00000000000000", "0000004060301g0o0c060c0o1g30604000000000",
    "0000003o6cc6c6c60c0o1g1g1g001g1g00000000", "0000003o6cc6cududmdmdmdscoc0663s00000000",
    "0000001g3o6c6cc6c6c6fuc6c6c6c6c600000000", "000000fgcocccccccofoccc6c6c6ccfo00000000",
    "0000003o6cc6c0c0c0c0c0c0c0c66c3o00000000", "000000foccc6c6c6c6c6c6c6c6c6ccfo00000000",
    "000000fuc0c0c0c0c0foc0c0c0c0c0fu00000000", "000000fuc0c0c0c0c0foc0c0c0c0c0c000000000",
    "0000003o6cc6c0c0c0cuc6c6c6c66e3q00000000", "000000c6c6c6c6c6c6fuc6c6c6c6c6c600000000",
    "000000fu1g1g1g1g1g1g1g1g1g1g1gfu00000000", "0000001v0c0c0c0c0c0c0c0ccccc6o3g00000000",
    "000000c6c6cccccocofgcococcccc6c600000000", "000000c0c0c0c0c0c0c0c0c0c0c0c0fu00000000",
    "000000c6c6eeeefudmdmdmdmc6c6c6c600000000", "000000c6e6e6f6f6dmdmcucucecec6c600000000",
    "0000003o6cc6c6c6c6c6c6c6c6c66c3o00000000", "000000foccc6c6c6c6ccfoc0c0c0c0c000000000",
    "0000003o6cc6c6c6c6c6c6c6dmcu6c3s06000000", "000000foccc6c6c6c6ccfococcccc6c600000000",
    "0000003o6cc6c0c0603o0c0606c66c3o00000000", "000000fu1g1g1g1g1g1g1g1g1g1g1g1g00000000",
    "000000c6c6c6c6c6c6c6c6c6c6c66c3o00000000", "000000c6c6c6c66c6c6c3o3o3o1g1g1g00000000",
    "000000c6c6c6c6c6dmdmdmdmeeeec6c600000000", "000000c6c66c6c3o3o1g3o3o6c6cc6c600000000",
    "000000c6c66c6c3o3o1g1g1g1g1g1g1g00000000", "000000fu06060c0o0o1g303060c0c0fu00000000",
    "0000007s60606060606060606060607s00000000", "00000000606030301g1g0o0o0c0c060600000000",
    "0000007s0c0c0c0c0c0c0c0c0c0c0c7s00000000", "0000001g3o6cc600000000000000000000000000",
    "00000000000000000000000000000000fv000000", "000000301g0o0000000000000000000000000000",
    "00000000000000003s66067uc6c6c67q00000000", "000000c0c0c0c0c0doecc6c6c6c6ecdo00000000",
    "00000000000000003s66c0c0c0c0663s00000000", "00000006060606063m6ec6c6c6c66e3m00000000",
    "00000000000000003o6cc6fuc0c0663s00000000", "0000001s36363030fo3030303030303000000000",
    "00000000000000007qcecccccc7oc07sc6c6c67s", "000000c0c0c0c0c0doecc6c6c6c6c6c600000000",
    "00000000001g1g007g1g1g1g1g1g1gfu00000000", "00000000000606000u060606060606066666663s",
    "000000c0c0c0c0c0cccodgf0fgcoccc600000000", "0000007g1g1g1g1g1g1g1g1g1g1g1gfu00000000",
    "0000000000000000bcfudmdmdmdmdmdm00000000", "0000000000000000doecc6c6c6c6c6c600000000",
    "00000000000000003o6cc6c6c6c66c3o00000000", "0000000000000000doecc6c6c6c6ecdoc0c0c0c0",
    "00000000000000003m6ec6c6c6c66e3m06060606", "0000000000000000ds7660606060606000000000",
    "00000000000000007sc6c07s0606c67s00000000", "0000000000303030fo3030303030361s00000000",
    "0000000000000000c6c6c6c6c6c66e3m00000000", "0000000000000000c6c66c6c3o3o1g1g00000000",
    "0000000000000000c6c6c6dmdmdmfu6c00000000", "0000000000000000c66c3o1g1g3o6cc600000000",
    "0000000000000000c6c6c6c6c6c66e3m06c66c3o", "00000000000000007u060c0o1g30607u00000000",
    "0000000u1g1g1g1g1gf01g1g1g1g1g0u00000000", "0000001g1g1g1g1g1g1g1g1g1g1g1g1g00000000",
    "000000f01g1g1g1g1g0u1g1g1g1g1gf000000000", "00000076dmcs0000000000000000000000000000"
};

static inline int mono_bits(char digit) { return digit <= '9' ? digit - '0' : digit - 'a' + 10; }

/* Draws one character; x, y is the upper left corner of its cell, in pixels of the finished
   picture.  What is not printable leaves a blank. */
static inline void mono_letter(const canvas *c, int x, int y, shade_vec3 color, char letter)
{
    const char *row = mono_shapes[letter > ' ' && letter < 127 ? letter - '!' : 0];
    shade_target pixel = c->target;
    for (int k = 0; letter > ' ' && letter < 127 && k < MONO_HEIGHT; k++, row += 2) {
        const int bits = mono_bits(row[0]) << 5 | mono_bits(row[1]);
        for (int i = 0; i < MONO_WIDTH; i++) {
            if (!(bits >> (MONO_WIDTH - 1 - i) & 1)) continue;
            pixel.clip_x = c->samples * (x + i);
            pixel.clip_y = c->samples * (y + k);
            pixel.clip_width = pixel.clip_height = c->samples;
            shade_clear(&pixel, shade_v4(color.x, color.y, color.z, 1), 1);
        }
    }
}

/* Draws n characters of a text side by side. */
static inline void mono_draw(const canvas *c, int x, int y, shade_vec3 color, const char *text,
                             int n)
{
    for (int k = 0; k < n; k++) mono_letter(c, x + MONO_WIDTH * k, y, color, text[k]);
}

/* Draws the lines of a text, each of which ends in a newline; what is longer than so many columns
   goes on in the next line, 8 columns further right.  Returns where the next text may begin. */
static inline int mono_listing(const canvas *c, int x, int y, int columns, shade_vec3 color,
                               const char *text)
{
    int indent = 0;
    while (*text) {
        const int whole = (int)strcspn(text, "\n");
        int n = whole;
        while (n > columns - indent || (n < whole && text[n] != ' ')) n--;
        mono_draw(c, x + MONO_WIDTH * indent, y, color, text, n);
        indent = n < whole ? 8 : 0;
        text += n + 1;
        y += MONO_HEIGHT + 3;
    }
    return y + MONO_HEIGHT / 2;
}
#endif
