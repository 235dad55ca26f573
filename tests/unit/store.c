/* store.c - colours into pixels: clamping, rounding, sRGB, NaN, dither, clearing. */
#include "unit.h"

/* Clears a one-row picture pixel by pixel through clip rectangles: each colour goes through the
   same store. */
static void store_colors(canvas *c, const shade_vec4 *colors, int count)
{
    for (int i = 0; i < count; i++) {
        c->target.clip_x = i;
        c->target.clip_y = 0;
        c->target.clip_width = 1;
        c->target.clip_height = 1;
        CHECK_INT(shade_clear(&c->target, colors[i], 1), SHADE_OK);
    }
    c->target.clip_x = c->target.clip_width = c->target.clip_height = 0;
}

/* The same colours as pixels of a triangle that covers the row. */
static void draw_colors(canvas *c, const shade_vec4 *colors, int count)
{
    shade_vec4 *corners = test_memory((size_t)count * 3 * sizeof(shade_vec4));
    scene s = { corners, NULL, 0, colors, NULL };
    shade_pipeline p = scene_pipeline(&s);
    for (int i = 0; i < count;
         i++) { /* primitive i covers pixel i alone: a box seen through w = 1 */
        for (int k = 0; k < 3; k++) {
            double X = i * 256 + (k == 2 ? 512 : 0), Y = k == 0 ? -256 : 256;
            corners[3 * i + k] = clip_of_fx8(X, Y, c->target.width, c->target.height, 0, 1);
        }
    }
    canvas_draw(c, &p, 3 * count);
    free(corners);
}

#define STORE_SLACK 1e-4 /* beyond half a step: the float rounding of c times 255 */

static int near_level(double got, double level) { return fabs(got - level) <= 0.5 + STORE_SLACK; }

static void random_store_colors(shade_vec4 *color, int count)
{
    for (int i = 0; i < count; i++) {
        float f[4];
        for (int k = 0; k < 4; k++) {
            f[k] = rnd_float(-0.1, 1.1);
            if (i % 4 == 1)
                f[k] = (float)((rnd_int(0, 255) + 0.5) / 255 + (double)rnd_float(-1e-6, 1e-6));
            if (i % 4 == 2) f[k] = rnd_log(1e-9, 1);
            if (i % 4 == 3) f[k] = (float)ref_decode_srgb((rnd_int(0, 254) + 0.5) / 255);
        }
        color[i] = shade_v4(f[0], f[1], f[2], f[3]);
    }
}

static void channels_of(shade_vec4 v, double out[4])
{
    out[0] = (double)v.x;
    out[1] = (double)v.y;
    out[2] = (double)v.z;
    out[3] = (double)v.w;
    for (int k = 0; k < 4; k++) out[k] = out[k] > 0 ? (out[k] < 1 ? out[k] : 1) : 0;
}

/* Every way into a pixel of 8 or of 5-6-5 bits gives the nearest level. */
static void check_levels(shade_format format)
{
    enum { N = 2000 };
    static shade_vec4 color[N];
    for (int srgb = 0; srgb < 2; srgb++)
        for (int way = 0; way < 2; way++) {
            random_store_colors(color, N);
            canvas c = canvas_open(N, 1, 0, format, 0);
            c.target.srgb = srgb;
            canvas_clear(&c, 1);
            if (way)
                draw_colors(&c, color, N);
            else
                store_colors(&c, color, N);
            for (int i = 0; i < N; i++) {
                double v[4];
                channels_of(color[i], v);
                for (int k = 0; k < 4 && canvas_most(format, k); k++) {
                    double code = srgb && k < 3 ? ref_encode_srgb(v[k]) : v[k];
                    double level = canvas_most(format, k) * code;
                    int got = canvas_code(&c, i, 0, k);
                    CHECK_SAY(near_level(got, level),
                              "%.9g, sRGB %d, channel %d: got %d, want %.6f", v[k], srgb, k, got,
                              level);
                }
            }
            canvas_close(&c);
        }
}

TEST(store, bytes_are_clamped_and_rounded_to_nearest)
{
    check_levels(SHADE_FORMAT_RGBA8);
    check_levels(SHADE_FORMAT_BGRA8);
}

/* One float of each STRIDE from 2^-17 to beyond 1, the floats around each change of byte, and some
   that no colour should be.  The byte is the nearest to the exact curve, and 255 times
   shade_srgb_from_linear, rounded: the table and the curve of shade.h agree. */
TEST(store, the_bytes_of_srgb_are_those_of_the_curve)
{
    enum { N = 600, STRIDE = 97 * TEST_SHARE };
    static float in[N * 4];
    static const uint32_t odd[] = { 0, 1, 0x80000000u, 0x7F800000, 0xFF800000u, 0x7FC00000,
                                    0xFFC00000u, 0x7F800001, 0x7F7FFFFF, 0xBF800000u, 0x007FFFFF };
    uint8_t out[N * 4];
    shade_target from = { 0 }, to = { 0 };
    uint32_t u = 0x37000000u + (uint32_t)rnd_int(0, STRIDE - 1), byte = 1;
    from.width = to.width = N;
    from.height = to.height = 1;
    from.color = in;
    from.format = SHADE_FORMAT_RGBA32F;
    to.color = out;
    to.srgb = 1;
    while (u < 0x3F810000u || byte < 256) {
        for (int i = 0; i < 4 * N; i++) {
            uint32_t bits = u;
            if (i % 4 == 3) bits = 0x3F000000;
            else if (i < 44) bits = odd[i / 4];
            else if (i < 4 * 200 && byte < 256) {    /* around a step */
                const float step = (float)ref_decode_srgb((byte - 0.5) / 255);
                memcpy(&bits, &step, 4);
                bits += (uint32_t)(i / 4 * 3 + i % 4) - 3 * 100;
            } else u += STRIDE;
            memcpy(&in[i], &bits, 4);
        }
        byte += byte < 256;
        CHECK_INT(shade_resolve(&to, &from, 1), SHADE_OK);
        for (int i = 0; i < 4 * N; i++) {
            const float v = i % 4 == 3 ? in[i] : shade_srgb_from_linear(shade_v3(in[i], 0, 0)).x;
            const double c = in[i] > 0 ? in[i] < 1 ? (double)in[i] : 1 : 0;
            const double exact = 255 * (i % 4 == 3 ? c : ref_encode_srgb(c));
            CHECK_SAY(out[i] == (int)(v * 255 + 0.5f) && near_level(out[i], exact),
                      "%.9g: got %d, want %.6f", (double)in[i], out[i], exact);
        }
    }
}

TEST(store, rgb565_is_clamped_and_rounded_to_nearest)
{
    check_levels(SHADE_FORMAT_RGB565);
    check_levels(SHADE_FORMAT_RGB565_SWAPPED);
}

TEST(store, floats_are_stored_as_they_come)
{
    enum { N = 600 };
    static shade_vec4 color[N];
    for (int way = 0; way < 2; way++) {
        for (int i = 0; i < N; i++)
            color[i] = shade_v4(rnd_nasty(), rnd_nasty(), rnd_float(-9, 9), rnd_log(1e-9, 1e9));
        canvas c = canvas_open(N, 1, 0, SHADE_FORMAT_RGBA32F, 0);
        c.target.srgb = way; /* without effect on floats */
        canvas_clear(&c, 1);
        if (way)
            draw_colors(&c, color, N);
        else
            store_colors(&c, color, N);
        for (int i = 0; i < N; i++) {
            float f[4];
            memcpy(f, &color[i], sizeof f);
            for (int k = 0; k < 4; k++) {
                float got = canvas_float(&c, i, 0, k);
                CHECK_SAY(float_bits(got) == float_bits(f[k]) || (isnan(got) && isnan(f[k])),
                          "got %a, want %a", (double)got, (double)f[k]);
            }
        }
        canvas_close(&c);
    }
}

TEST(store, nan_is_stored_as_zero_and_infinity_clamped)
{
    shade_vec4 color[5];
    float inf = (float)INFINITY, nan = (float)NAN;
    color[0] = shade_v4(nan, 1, nan, 1);
    color[1] = shade_v4(inf, -inf, 0.5f, nan);
    color[2] = shade_v4(1e30f, -1e30f, 1, inf);
    color[3] = shade_v4(bits_float(0xFFC00000u), bits_float(0x7F800001u), 1, -inf);
    color[4] = shade_v4(-0.0f, 1e-45f, 2, -1);
    static const unsigned char want[5][4] = { { 0, 255, 0, 255 },
                                              { 255, 0, 0, 0 },
                                              { 255, 0, 255, 255 },
                                              { 0, 0, 255, 0 },
                                              { 0, 0, 255, 0 } };
    for (int i = 0; i < 4 * SHADE_FORMAT_RGBA32F; i++) {
        shade_format format = (shade_format)(i / 4);
        canvas c = canvas_open(5, 1, 0, format, 0);
        c.target.srgb = i & 1;
        canvas_clear(&c, 1);
        if (i & 2)
            draw_colors(&c, color, 5);
        else
            store_colors(&c, color, 5);
        for (int n = 0; n < 20; n++) {
            if (n == 4 + 2) continue; /* the one ordinary value */
            CHECK_INT(canvas_code(&c, n / 4, 0, n % 4),
                      want[n / 4][n % 4] ? canvas_most(format, n % 4) : 0);
        }
        canvas_close(&c);
    }
}

TEST(store, bytes_lie_in_the_order_that_formats_name)
{
    static const unsigned char rgba[4] = { 255, 153, 51, 102 }, bgra[4] = { 51, 153, 255, 102 };
    const uint16_t native = 31 << 11 | 38 << 5 | 6, swapped = 0xC6FC;
    const void *want[SHADE_FORMAT_RGBA32F];
    want[SHADE_FORMAT_RGBA8] = rgba;
    want[SHADE_FORMAT_BGRA8] = bgra;
    want[SHADE_FORMAT_RGB565] = &native;
    want[SHADE_FORMAT_RGB565_SWAPPED] = &swapped;
    for (int i = 0; i < 2 * SHADE_FORMAT_RGBA32F; i++) {
        shade_format format = (shade_format)(i / 2);
        canvas c = canvas_open(3, 2, 0, format, 0);
        shade_vec4 color[6];
        for (int k = 0; k < 6; k++) color[k] = shade_v4(1, 0.6f, 0.2f, 0.4f);
        if (i & 1) {
            shade_vec4 corners[3] = { { -3, -1, 0, 1 }, { 1, -1, 0, 1 }, { 1, 3, 0, 1 } };
            scene s = { corners, NULL, 0, color, NULL };
            shade_pipeline p = scene_pipeline(&s);
            canvas_draw(&c, &p, 3);
        } else
            CHECK_INT(shade_clear(&c.target, color[0], 1), SHADE_OK);
        for (int k = 0; k < 6; k++) {
            CHECK_SAY(
                !memcmp(canvas_pixel(&c, k % 3, k / 3), want[format], canvas_pixel_bytes(format)),
                "format %d, pixel %d", (int)format, k);
        }
        canvas_close(&c);
    }
}

static void check_srgb_bytes(shade_format format)
{
    static shade_vec4 color[256];
    for (int i = 0; i < 256; i++) {
        float v = (float)ref_decode_srgb(i / 255.0);
        color[i] = shade_v4(v, v, v, (float)(i / 255.0));
    }
    canvas c = canvas_open(256, 1, 0, format, 0);
    c.target.srgb = 1;
    store_colors(&c, color, 256);
    for (int i = 0; i < 256; i++)
        for (int k = 0; k < 4; k++) CHECK_INT(canvas_code(&c, i, 0, k), i);
    /* read back for blending: nothing added changes nothing */
    for (int i = 0; i < 256; i++) color[i] = shade_v4(0, 0, 0, 0);
    for (int blend = SHADE_BLEND_OVER; blend <= SHADE_BLEND_ADD; blend++) {
        shade_vec4 corners[3] = { { -3, -1, 0, 1 }, { 1, -1, 0, 1 }, { 1, 3, 0, 1 } };
        scene s = { corners, NULL, 0, color, NULL };
        shade_pipeline p = scene_pipeline(&s);
        p.raster.blend = (shade_blend)blend;
        shade_stats stats = canvas_draw(&c, &p, 3);
        CHECK_INT(stats.fragments, 256);
        for (int i = 0; i < 256; i++)
            for (int k = 0; k < 4; k++) CHECK_INT(canvas_code(&c, i, 0, k), i);
    }
    canvas_close(&c);
}

TEST(store, every_srgb_byte_comes_back_from_linear_light)
{
    check_srgb_bytes(SHADE_FORMAT_RGBA8);
    check_srgb_bytes(SHADE_FORMAT_BGRA8);
}

TEST(store, the_srgb_code_is_within_half_a_step_everywhere) /* and never falls as light grows */
{
    enum { N = 16384 };
    static shade_vec4 color[N];
    canvas c = canvas_open(N, 1, 0, SHADE_FORMAT_RGBA8, 0);
    c.target.srgb = 1;
    for (int pass = 0; pass < 3; pass++) {
        for (int i = 0; i < N; i++) {
            float v = pass == 0   ? (float)i / (N - 1)
                      : pass == 1 ? (float)(i * 0.02 / N)
                                  : (float)pow(10, -6 + 6.0 * i / (N - 1));
            color[i] = shade_v4(v, v, v, v);
        }
        store_colors(&c, color, N);
        int before = 0;
        for (int i = 0; i < N; i++) {
            int got = canvas_bytes(&c, i, 0)[1];
            double want = 255 * ref_encode_srgb((double)color[i].x);
            CHECK_SAY(near_level(got, want), "%.9g: got %d, want %.6f", (double)color[i].x, got,
                      want);
            CHECK_SAY(got >= before, "%.9g: %d after %d", (double)color[i].x, got, before);
            before = got;
        }
    }
    canvas_close(&c);
}

/* -------------------------------------------------------------------------- colours as numbers */

static float curve_value(int i)
{
    static const float seam[2] = { 0.04045f, 0.0031308f };
    switch (i % 6) {
    case 0: return rnd_log(1e-9, 1);
    case 1: return bits_float(float_bits(seam[i / 6 % 2]) + (uint32_t)rnd_int(0, 40) - 20);
    case 2: return bits_float(0x3F800000u - (uint32_t)rnd_int(0, 100)); /* just below 1 */
    case 3: return rnd_one_in(2) ? -rnd_log(1e-30, 1e30) : rnd_log(1, 1e30);
    case 4: return rnd_nasty();
    default: return rnd_float(0, 1);
    }
}

/* by component */
static void check_curve(shade_vec3 (*curve)(shade_vec3), double (*ref)(double))
{
    for (int i = 0; i < 100000; i++) {
        float in[3], out[3];
        for (int k = 0; k < 3; k++) in[k] = curve_value(rnd_int(0, 11));
        shade_vec3 c = curve(shade_v3(in[0], in[1], in[2]));
        out[0] = c.x;
        out[1] = c.y;
        out[2] = c.z;
        for (int k = 0; k < 3; k++) {
            double v = (double)in[k], want = ref(v > 0 ? (v < 1 ? v : 1) : 0);
            CHECK_SAY(fabs((double)out[k] - want) <= (isnan(v) ? 0 : 4e-6),
                      "%a: got %.9g, want %.9g", v, (double)out[k], want);
            CHECK_SAY(out[k] >= 0 && out[k] <= 1 && !(float_bits(out[k]) >> 31), "%a: got %a", v,
                      (double)out[k]);
        }
    }
}

TEST(store, colours_follow_the_srgb_curve_within_zero_and_one)
{
    check_curve(shade_linear_from_srgb, ref_decode_srgb);
    check_curve(shade_srgb_from_linear, ref_encode_srgb);
}

TEST(store, nan_is_no_light_and_infinity_is_full)
{
    shade_vec3 c = shade_v3((float)NAN, INFINITY, -INFINITY);
    for (int i = 0; i < 2; i++) {
        shade_vec3 got = i ? shade_linear_from_srgb(c) : shade_srgb_from_linear(c);
        CHECK_NEAR(got.x, 0, 0);
        CHECK_NEAR(got.y, 1, 4e-6);
        CHECK_NEAR(got.z, 0, 0);
        got = i ? shade_linear_from_srgb(shade_v3(0, 1, 0))
                : shade_srgb_from_linear(shade_v3(0, 1, 0));
        CHECK_NEAR(got.x, 0, 0);
        CHECK_NEAR(got.y, 1, 4e-6);
    }
}

/* red on top, whatever is above it */
TEST(store, rgb_is_the_linear_colour_of_its_codes)
{
    for (uint32_t i = 0; i < 256; i++) {
        uint32_t code[3] = { i, (i * 77 + 5) % 256, 255 - i }, rgb;
        for (int turn = 0; turn < 3; turn++) {
            uint32_t r = code[turn], g = code[(turn + 1) % 3], b = code[(turn + 2) % 3];
            rgb = r << 16 | g << 8 | b;
            shade_vec3 c = shade_rgb(rgb), above = shade_rgb(rgb | (uint32_t)rnd_bits() << 24);
            shade_vec3 back = shade_srgb_from_linear(c);
            CHECK_NEAR(c.x, ref_decode_srgb(r / 255.0), 4e-6);
            CHECK_NEAR(c.y, ref_decode_srgb(g / 255.0), 4e-6);
            CHECK_NEAR(c.z, ref_decode_srgb(b / 255.0), 4e-6);
            CHECK(!memcmp(&c, &above, sizeof c));
            CHECK_INT(back.x * 255 + 0.5f, r);
            CHECK_INT(back.y * 255 + 0.5f, g);
            CHECK_INT(back.z * 255 + 0.5f, b);
        }
    }
}

/* ------------------------------------------------------------------------- dither and clearing */

/* Any colour, or one whose three codes are whole levels of 5-6-5. */
static shade_vec4 random_565_color(int exact, int srgb)
{
    shade_vec4 color = shade_v4(rnd_float(0, 1), rnd_float(0, 1), rnd_float(0, 1), 1);
    if (!exact) return color;
    double f[3] = { rnd_int(0, 31) / 31.0, 0, 0 };
    f[1] = rnd_int(0, 63) / 63.0;
    f[2] = rnd_int(0, 31) / 31.0;
    for (int k = 0; k < 3; k++) f[k] = srgb ? ref_decode_srgb(f[k]) : f[k];
    return shade_v4((float)f[0], (float)f[1], (float)f[2], 1);
}

/* Draws one triangle over all of the picture. */
static void fill_by_draw(canvas *c, shade_vec4 color)
{
    static const shade_vec4 whole[3] = { { -3, -1, 0, 1 }, { 1, -1, 0, 1 }, { 1, 3, 0, 1 } };
    scene s = { whole, NULL, 0, &color, NULL };
    shade_pipeline p = scene_pipeline(&s);
    canvas_draw(c, &p, 3);
}

/* In each square of 4 x 4 pixels no code is a whole level off, and their mean is within 1/16. */
static void check_dithered(const canvas *c, int channel, double level)
{
    for (int by = 0; by < c->target.height; by += 4)
        for (int bx = 0; bx < c->target.width; bx += 4) {
            double sum = 0;
            for (int n = 0; n < 16; n++) {
                int got = canvas_code(c, bx + n % 4, by + n / 4, channel);
                CHECK_SAY(fabs(got - level) < 1 - 1e-3, "level %.4f: got %d", level, got);
                sum += got;
            }
            CHECK_NEAR(sum / 16, level, 1.0 / 16 + 1e-3);
        }
}

TEST(store, dither_keeps_the_mean_of_four_by_four_and_exact_levels)
{
    for (int i = 0; i < 600; i++) {
        shade_format format = i < 300 ? SHADE_FORMAT_RGB565 : SHADE_FORMAT_RGB565_SWAPPED;
        canvas c = canvas_open(16, 12, 17, format, 0);
        c.target.dither = 1;
        c.target.srgb = i % 2;
        shade_vec4 color = random_565_color(i % 3 == 0, c.target.srgb);
        if (i % 5) {
            CHECK_INT(shade_clear(&c.target, color, 1), SHADE_OK);
        } else {
            fill_by_draw(&c, color);
        }
        double v[3] = { (double)color.x, (double)color.y, (double)color.z };
        for (int k = 0; k < 3; k++) {
            double code = c.target.srgb ? ref_encode_srgb(v[k]) : v[k];
            check_dithered(&c, k, canvas_most(format, k) * code);
        }
        canvas_close(&c);
    }
}

/* G1 */
TEST(store, clear_fills_the_clip_rectangle_of_both_buffers_and_no_more)
{
    for (int i = 0; i < 1500; i++) {
        int width = rnd_int(1, 40), height = rnd_int(1, 30),
            stride = rnd_one_in(2) ? width + rnd_int(0, 9) : 0;
        shade_format format = (shade_format)(i % CANVAS_FORMATS);
        canvas c = canvas_open(width, height, stride, format, rnd_int(0, 1));
        CHECK_INT(shade_clear(&c.target, shade_v4(0, 0, 0, 0), 0.25f), SHADE_OK);
        random_clip(&c.target);
        CHECK_INT(shade_clear(&c.target, shade_v4(1, 1, 1, 1), 0.75f), SHADE_OK);
        int x0, y0, x1, y1;
        clip_bounds(&c.target, &x0, &y0, &x1, &y1);
        for (int y = 0; y < height; y++)
            for (int x = 0; x < width; x++) {
                int in = x >= x0 && x < x1 && y >= y0 && y < y1;
                for (int k = 0; k < 4; k++) {
                    if (format == SHADE_FORMAT_RGBA32F)
                        CHECK_NEAR(canvas_float(&c, x, y, k), in, 0);
                    else
                        CHECK_INT(canvas_code(&c, x, y, k), in ? canvas_most(format, k) : 0);
                }
                if (c.target.depth) CHECK_NEAR(canvas_depth(&c, x, y), in ? 0.75 : 0.25, 0);
            }
        canvas_close(&c);
    }
}

TEST(store, clear_needs_only_one_of_the_buffers)
{
    canvas c = canvas_open(9, 7, 11, SHADE_FORMAT_RGBA8, 1);
    c.target.color = NULL;
    CHECK_INT(shade_clear(&c.target, shade_v4(1, 1, 1, 1), 0.5f), SHADE_OK);
    CHECK_NEAR(canvas_depth(&c, 8, 6), 0.5, 0);
    CHECK_INT(c.color[CANVAS_GUARD], CANVAS_BYTE);
    canvas_close(&c);
    c = canvas_open(9, 7, 11, SHADE_FORMAT_RGBA8, 0);
    CHECK_INT(shade_clear(&c.target, shade_v4(1, 1, 1, 1), 0.5f), SHADE_OK);
    CHECK_INT(canvas_bytes(&c, 8, 6)[0], 255);
    canvas_close(&c);
}
