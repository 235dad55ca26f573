/* color.h - display colours by name, in hexadecimal digits or as numbers

       double rgb[3];
       core_color(&why, "color", "tomato", rgb);    (1, 0.388, 0.278), as a display has it

   Of names white to clay are those of this project, muted; the rest are those of CSS Color Module
   Level 4, section 6.1.  Ours win where both have a name. */
#ifndef CORE_COLOR_H
#define CORE_COLOR_H

#include "shade.h"
#include "refuse.h"

#define CORE_COLORS                                                                                \
    "white, black, gray, grey, red, green, blue, orange, yellow, purple, brown, pink, cyan, "      \
    "steel, "                                                                                      \
    "clay"

typedef struct core_named {
    const char *name;
    uint32_t rgb;
} core_named;

static inline int core_named_color(const char *word, uint32_t *rgb)
{
    static const core_named all[] = {
        /* in the order of their letters */
        { "aliceblue", 0xF0F8FF },
        { "antiquewhite", 0xFAEBD7 },
        { "aqua", 0x00FFFF },
        { "aquamarine", 0x7FFFD4 },
        { "azure", 0xF0FFFF },
        { "beige", 0xF5F5DC },
        { "bisque", 0xFFE4C4 },
        { "black", 0x000000 },
        { "blanchedalmond", 0xFFEBCD },
        { "blue", 0x1F77B4 },
        { "blueviolet", 0x8A2BE2 },
        { "brown", 0x8C564B },
        { "burlywood", 0xDEB887 },
        { "cadetblue", 0x5F9EA0 },
        { "chartreuse", 0x7FFF00 },
        { "chocolate", 0xD2691E },
        { "clay", 0xBFB2A4 },
        { "coral", 0xFF7F50 },
        { "cornflowerblue", 0x6495ED },
        { "cornsilk", 0xFFF8DC },
        { "crimson", 0xDC143C },
        { "cyan", 0x17BECF },
        { "darkblue", 0x00008B },
        { "darkcyan", 0x008B8B },
        { "darkgoldenrod", 0xB8860B },
        { "darkgray", 0xA9A9A9 },
        { "darkgreen", 0x006400 },
        { "darkgrey", 0xA9A9A9 },
        { "darkkhaki", 0xBDB76B },
        { "darkmagenta", 0x8B008B },
        { "darkolivegreen", 0x556B2F },
        { "darkorange", 0xFF8C00 },
        { "darkorchid", 0x9932CC },
        { "darkred", 0x8B0000 },
        { "darksalmon", 0xE9967A },
        { "darkseagreen", 0x8FBC8F },
        { "darkslateblue", 0x483D8B },
        { "darkslategray", 0x2F4F4F },
        { "darkslategrey", 0x2F4F4F },
        { "darkturquoise", 0x00CED1 },
        { "darkviolet", 0x9400D3 },
        { "deeppink", 0xFF1493 },
        { "deepskyblue", 0x00BFFF },
        { "dimgray", 0x696969 },
        { "dimgrey", 0x696969 },
        { "dodgerblue", 0x1E90FF },
        { "firebrick", 0xB22222 },
        { "floralwhite", 0xFFFAF0 },
        { "forestgreen", 0x228B22 },
        { "fuchsia", 0xFF00FF },
        { "gainsboro", 0xDCDCDC },
        { "ghostwhite", 0xF8F8FF },
        { "gold", 0xFFD700 },
        { "goldenrod", 0xDAA520 },
        { "gray", 0x808080 },
        { "green", 0x2CA02C },
        { "greenyellow", 0xADFF2F },
        { "grey", 0x808080 },
        { "honeydew", 0xF0FFF0 },
        { "hotpink", 0xFF69B4 },
        { "indianred", 0xCD5C5C },
        { "indigo", 0x4B0082 },
        { "ivory", 0xFFFFF0 },
        { "khaki", 0xF0E68C },
        { "lavender", 0xE6E6FA },
        { "lavenderblush", 0xFFF0F5 },
        { "lawngreen", 0x7CFC00 },
        { "lemonchiffon", 0xFFFACD },
        { "lightblue", 0xADD8E6 },
        { "lightcoral", 0xF08080 },
        { "lightcyan", 0xE0FFFF },
        { "lightgoldenrodyellow", 0xFAFAD2 },
        { "lightgray", 0xD3D3D3 },
        { "lightgreen", 0x90EE90 },
        { "lightgrey", 0xD3D3D3 },
        { "lightpink", 0xFFB6C1 },
        { "lightsalmon", 0xFFA07A },
        { "lightseagreen", 0x20B2AA },
        { "lightskyblue", 0x87CEFA },
        { "lightslategray", 0x778899 },
        { "lightslategrey", 0x778899 },
        { "lightsteelblue", 0xB0C4DE },
        { "lightyellow", 0xFFFFE0 },
        { "lime", 0x00FF00 },
        { "limegreen", 0x32CD32 },
        { "linen", 0xFAF0E6 },
        { "magenta", 0xFF00FF },
        { "maroon", 0x800000 },
        { "mediumaquamarine", 0x66CDAA },
        { "mediumblue", 0x0000CD },
        { "mediumorchid", 0xBA55D3 },
        { "mediumpurple", 0x9370DB },
        { "mediumseagreen", 0x3CB371 },
        { "mediumslateblue", 0x7B68EE },
        { "mediumspringgreen", 0x00FA9A },
        { "mediumturquoise", 0x48D1CC },
        { "mediumvioletred", 0xC71585 },
        { "midnightblue", 0x191970 },
        { "mintcream", 0xF5FFFA },
        { "mistyrose", 0xFFE4E1 },
        { "moccasin", 0xFFE4B5 },
        { "navajowhite", 0xFFDEAD },
        { "navy", 0x000080 },
        { "oldlace", 0xFDF5E6 },
        { "olive", 0x808000 },
        { "olivedrab", 0x6B8E23 },
        { "orange", 0xFF7F0E },
        { "orangered", 0xFF4500 },
        { "orchid", 0xDA70D6 },
        { "palegoldenrod", 0xEEE8AA },
        { "palegreen", 0x98FB98 },
        { "paleturquoise", 0xAFEEEE },
        { "palevioletred", 0xDB7093 },
        { "papayawhip", 0xFFEFD5 },
        { "peachpuff", 0xFFDAB9 },
        { "peru", 0xCD853F },
        { "pink", 0xE377C2 },
        { "plum", 0xDDA0DD },
        { "powderblue", 0xB0E0E6 },
        { "purple", 0x9467BD },
        { "rebeccapurple", 0x663399 },
        { "red", 0xD62728 },
        { "rosybrown", 0xBC8F8F },
        { "royalblue", 0x4169E1 },
        { "saddlebrown", 0x8B4513 },
        { "salmon", 0xFA8072 },
        { "sandybrown", 0xF4A460 },
        { "seagreen", 0x2E8B57 },
        { "seashell", 0xFFF5EE },
        { "sienna", 0xA0522D },
        { "silver", 0xC0C0C0 },
        { "skyblue", 0x87CEEB },
        { "slateblue", 0x6A5ACD },
        { "slategray", 0x708090 },
        { "slategrey", 0x708090 },
        { "snow", 0xFFFAFA },
        { "springgreen", 0x00FF7F },
        { "steel", 0x8FA3B5 },
        { "steelblue", 0x4682B4 },
        { "tan", 0xD2B48C },
        { "teal", 0x008080 },
        { "thistle", 0xD8BFD8 },
        { "tomato", 0xFF6347 },
        { "turquoise", 0x40E0D0 },
        { "violet", 0xEE82EE },
        { "wheat", 0xF5DEB3 },
        { "white", 0xFFFFFF },
        { "whitesmoke", 0xF5F5F5 },
        { "yellow", 0xF2C037 },
        { "yellowgreen", 0x9ACD32 },
    };
    int low = 0, high = (int)(sizeof all / sizeof *all);
    while (low < high) {
        const int middle = (low + high) / 2, order = strcmp(all[middle].name, word);
        if (!order) *rgb = all[middle].rgb;
        if (!order) return 1;
        if (order < 0)
            low = middle + 1;
        else
            high = middle;
    }
    return 0;
}

/* #RGB and #RRGGBB, with or without the sign.  0: it is neither */
static inline int core_hexadecimal(const char *word, uint32_t *rgb)
{
    const char *digits = word[0] == '#' ? word + 1 : word;
    const size_t count = strlen(digits);
    uint32_t x = 0;
    for (size_t i = 0; i < count; i++) {
        const char c = digits[i];
        const int digit = c >= '0' && c <= '9'   ? c - '0'
                          : c >= 'a' && c <= 'f' ? c - 'a' + 10
                          : c >= 'A' && c <= 'F' ? c - 'A' + 10
                                                 : -1;
        if (digit < 0 || count > 6) return 0;
        x = count == 3 ? x << 8 | (uint32_t)digit * 17 : x << 4 | (uint32_t)digit;
    }
    *rgb = x;
    return count == 3 || count == 6;
}

/* The preset whose name this is, with spaces, _ or -; -1: none */
static inline int core_preset(const char *word)
{
    for (int i = 0; i < 24; i++) {
        const char *name = shade_preset_name((shade_preset)i), *at = word;
        for (; *name && (*at == *name || ((*at == '_' || *at == '-') && *name == ' ')); name++)
            at++;
        if (!*name && !*at) return i;
    }
    return -1;
}

/* The display colour of a word, whose letters may be large.  rgb: 0 .. 1 */
static inline int core_color(core_refusal *r, const char *argument, const char *word, double rgb[3])
{
    char small[32] = "";
    uint32_t x = 0;
    for (size_t i = 0; word[i] && i + 1 < sizeof small; i++)
        small[i] = (char)(word[i] >= 'A' && word[i] <= 'Z' ? word[i] + 32 : word[i]);
    if (!core_named_color(small, &x) && !core_hexadecimal(word, &x)) {
        if (core_preset(small) >= 0)
            return core_refuse(r, CORE_CHOICE, argument,
                               "must be a colour, and '%s' is a material: say material='%s'", word,
                               word);
        return core_refuse(
            r, CORE_CHOICE, argument,
            "must be #RRGGBB, #RGB, a name of CSS or one of " CORE_COLORS ", not '%.40s'", word);
    }
    for (int k = 0; k < 3; k++) rgb[k] = (double)(x >> (16 - 8 * k) & 255) / 255;
    return r->code;
}

/* Rows of display colours, from 0 to 1 or as bytes, of 3 or 4 columns.  whole: they are whole
   numbers; bytes: and of a type that says that they are bytes.  Whole numbers that are all 0 or 1
   and do not say so are 0 .. 1, for one row and for many: np.array([1, 0, 0]) is red.  out: 3
   floats a row, 0 .. 1.  *alpha: the least of the fourth column, 0 .. 1 */
static inline int core_colors(core_refusal *r, const char *argument, const double *rows,
                              size_t count, int columns, int whole, int bytes, float *out,
                              double *alpha)
{
    const size_t width = (size_t)columns;
    double low = 0, high = 0, most, scale;
    if (columns != 3 && columns != 4)
        return core_refuse(r, CORE_SHAPE, argument, "must have 3 or 4 columns, not %d", columns);
    for (size_t i = 0; i < count * width; i++) {
        if (!i || rows[i] < low || rows[i] != rows[i]) low = rows[i];
        if (!i || rows[i] > high || rows[i] != rows[i]) high = rows[i];
    }
    most = whole ? 255 : 1;
    if (!(low >= 0 && high <= most))
        return core_refuse(r, CORE_RANGE, argument, "must be from 0 to %s, not %g .. %g",
                           whole ? "255" : "1 (or whole, to 255)", low, high);
    scale = whole && (bytes || high > 1) ? 255 : 1;
    const double unit = scale > 1 ? (double)(1.0f / 255.0f) : 1;
    *alpha = 1;
    for (size_t i = 0; i < count; i++) {
        for (size_t k = 0; k < 3; k++) out[3 * i + k] = (float)(rows[width * i + k] * unit);
        if (columns == 4 && rows[4 * i + 3] / scale < *alpha) *alpha = rows[4 * i + 3] / scale;
    }
    return r->code;
}
#endif
