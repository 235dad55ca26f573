/* texture.c - texels to colours: addressing, filtering, mipmaps, level of detail, and the map of a
   mesh, against an oracle that reads the same memory in double precision. */
#include "unit.h"

/* -------------------------------------------------------------------------------------- oracle */

/* Texel (i, j) in linear light. */
static void ref_texel(const shade_texture *t, int i, int j, double c[4])
{
    size_t at = (size_t)j * texture_stride(t) + (size_t)i;
    ref_pixel(t->format, t->srgb,
              (const unsigned char *)t->pixels + canvas_pixel_bytes(t->format) * at, c);
}

/* The place on an axis of n texels that a coordinate names, 0 .. n. */
static double ref_place(double c, int n, shade_wrap wrap)
{
    if (!(fabs(c) <= 1e300)) c = 0;
    if (wrap == SHADE_WRAP_CLAMP) return fmax(0, fmin(1, c)) * n;
    if (wrap == SHADE_WRAP_REPEAT) return (c - floor(c)) * n;
    c = fmod(fabs(c), 2);
    return (c > 1 ? 2 - c : c) * n;
}

static int ref_wrapped(int i, int n, shade_wrap wrap) /* -1 <= i <= n */
{
    if (wrap == SHADE_WRAP_REPEAT) return (i + n) % n;
    return i < 0 ? 0 : i >= n ? n - 1 : i;
}

/* Bilinear, and into span the greatest difference between the texels it reads. */
static void ref_bilinear(const shade_texture *base, const shade_texture *t, double u, double v,
                         double c[4], double *span)
{
    double x = ref_place(u, t->width, base->wrap_u) - 0.5; /* NOLINT: k > 0 only with mipmaps */
    double y = ref_place(v, t->height, base->wrap_v) - 0.5;
    int i = (int)floor(x), j = (int)floor(y);
    double lo[4], hi[4];
    for (int k = 0; k < 4; k++) {
        c[k] = 0;
        lo[k] = 1e300;
        hi[k] = -1e300;
    }
    for (int corner = 0; corner < 4; corner++) {
        double texel[4], fx = x - i, fy = y - j;
        ref_texel(t, ref_wrapped(i + (corner & 1), t->width, base->wrap_u),
                  ref_wrapped(j + (corner >> 1), t->height, base->wrap_v), texel);
        double weight = (corner & 1 ? fx : 1 - fx) * (corner >> 1 ? fy : 1 - fy);
        for (int k = 0; k < 4; k++) {
            c[k] += weight * texel[k];
            lo[k] = fmin(lo[k], texel[k]);
            hi[k] = fmax(hi[k], texel[k]);
        }
    }
    for (int k = 0; k < 4; k++) *span = fmax(*span, hi[k] - lo[k]);
}

static void ref_sample(const shade_texture *t, double u, double v, double lod, double c[4],
                       double *span)
{
    int levels = t->filter == SHADE_FILTER_TRILINEAR && t->mipmaps ? t->mipmap_count : 0;
    double level = fabs(lod) <= 1e300 ? fmax(0, fmin(levels, lod)) : 0, low[4], high[4];
    int k = (int)floor(level);
    *span = 0;
    ref_bilinear(t, k ? &t->mipmaps[k - 1] : t, u, v, low, span);
    for (int i = 0; i < 4; i++) high[i] = low[i];
    if (level > k) ref_bilinear(t, &t->mipmaps[k], u, v, high, span);
    for (int i = 0; i < 4; i++) c[i] = low[i] + (level - k) * (high[i] - low[i]);
}

/* The error that is allowed: a coordinate in [0, 1] is off by up to 2 roundings and its place by
   one more, which moves the weights by n 2^-22 at most; each colour has some roundings of its own;
   the sRGB curve is a power of the library's, 2e-6 off. */
static double texture_bound(const shade_texture *t, double span, const double c[4])
{
    double n = t->width > t->height ? t->width : t->height, most = 1;
    for (int k = 0; k < 4; k++) most = fmax(most, fabs(c[k]));
    return 2 * span * n / 4194304 + 1e-6 * (most + span) + (t->srgb ? 3e-6 : 0);
}

static void sample_to(const shade_texture *t, float u, float v, float lod, float c[4])
{
    shade_vec4 s = shade_sample(t, u, v, lod);
    c[0] = s.x;
    c[1] = s.y;
    c[2] = s.z;
    c[3] = s.w;
}

/* ----------------------------------------------------------------------------------- filtering */

static void check_sample(const shade_texture *t, float u, float v, float lod)
{
    double want[4], span;
    float got[4];
    ref_sample(t, (double)u, (double)v, (double)lod, want, &span);
    sample_to(t, u, v, lod, got);
    for (int k = 0; k < 4; k++) {
        CHECK_SAY(fabs((double)got[k] - want[k]) <= texture_bound(t, span, want),
                  "%d x %d format %d srgb %d wrap %d %d at %a %a lod %a channel %d: got %.9g, want "
                  "%.9g within %.3g",
                  t->width, t->height, (int)t->format, t->srgb, (int)t->wrap_u, (int)t->wrap_v,
                  (double)u, (double)v, (double)lod, k, (double)got[k], want[k],
                  texture_bound(t, span, want));
    }
}

TEST(texture, bilinear_blends_the_four_nearest_texels)
{
    for (int i = 0; i < 500; i++) {
        shade_texture t = random_texture(i % 8 ? 20 : 300);
        for (int k = 0; k < 60; k++) check_sample(&t, random_coordinate(), random_coordinate(), 0);
        free_texture(&t);
    }
}

TEST(texture, trilinear_blends_the_two_nearest_levels)
{
    for (int i = 0; i < 250; i++) {
        shade_texture t = random_texture(40), levels[16];
        t.filter = SHADE_FILTER_TRILINEAR;
        void *memory = add_mipmaps(&t, levels);
        if (rnd_one_in(4)) t.mipmap_count = rnd_int(0, t.mipmap_count);
        for (int k = 0; k < 50; k++) {
            float lod = rnd_one_in(6)   ? rnd_nasty()
                        : rnd_one_in(4) ? (float)rnd_int(-1, 8)
                                        : rnd_float(-1, 7);
            check_sample(&t, random_coordinate(), random_coordinate(), lod);
        }
        free(memory);
        free_texture(&t);
    }
}

/* the texel, and no other: u, v within rounding of a border may fall to either side */
TEST(texture, nearest_is_the_texel_that_the_point_lies_in)
{
    for (int i = 0; i < 500; i++) {
        shade_texture t = random_texture(i % 8 ? 20 : 300);
        t.filter = SHADE_FILTER_NEAREST;
        for (int k = 0; k < 60; k++) {
            float u = random_coordinate(), v = random_coordinate(), got[4];
            double x = ref_place((double)u, t.width, t.wrap_u);
            double y = ref_place((double)v, t.height, t.wrap_v);
            double dx = t.width / 4194304.0, dy = t.height / 4194304.0;
            int found = 0;
            sample_to(&t, u, v, 0, got);
            for (int side = 0; side < 4; side++) {
                int a = (int)floor(side & 1 ? x + dx : x - dx), b;
                b = (int)floor(side & 2 ? y + dy : y - dy);
                double c[4];
                int same = 1;
                ref_texel(&t, ref_wrapped(a, t.width, t.wrap_u),
                          ref_wrapped(b, t.height, t.wrap_v), c);
                for (int n = 0; n < 4; n++)
                    same &= fabs((double)got[n] - c[n]) <= (t.format == SHADE_FORMAT_RGBA32F ? 0
                                                            : t.srgb                         ? 3e-6
                                                                     : 1.2e-7);
                found |= same;
            }
            CHECK_SAY(found, "%d x %d format %d srgb %d wrap %d %d at %a %a: %.9g %.9g %.9g %.9g",
                      t.width, t.height, (int)t.format, t.srgb, (int)t.wrap_u, (int)t.wrap_v,
                      (double)u, (double)v, (double)got[0], (double)got[1], (double)got[2],
                      (double)got[3]);
        }
        free_texture(&t);
    }
}

/* Sizes are powers of two, so that the centre of a texel is an exact float and bilinear weights
   are 0 and 1. */
TEST(texture, nearest_and_whole_texel_centres_are_exact)
{
    for (int i = 0; i < 200; i++) {
        shade_texture t = texture_of(1 << rnd_int(0, 6), 1 << rnd_int(0, 6), SHADE_FORMAT_RGBA32F);
        t.filter = (shade_filter)rnd_int(0, 2);
        t.wrap_u = (shade_wrap)rnd_int(0, 2);
        t.wrap_v = (shade_wrap)rnd_int(0, 2);
        for (int k = 0; k < 50; k++) {
            int x = rnd_int(0, t.width - 1), y = rnd_int(0, t.height - 1);
            int round = t.wrap_u == SHADE_WRAP_REPEAT ? rnd_int(-5, 5) : 0;
            float u = ((float)x + 0.5f) / (float)t.width + (float)round, got[4];
            float v = ((float)y + 0.5f) / (float)t.height;
            double want[4];
            ref_texel(&t, x, y, want);
            if (t.wrap_v == SHADE_WRAP_MIRROR) v += 2 * (float)rnd_int(-3, 3);
            if (t.wrap_v == SHADE_WRAP_MIRROR && rnd_one_in(2)) v = -v;
            sample_to(&t, u, v, 0, got);
            for (int n = 0; n < 4; n++) CHECK_NEAR(got[n], want[n], 0);
        }
        free_texture(&t);
    }
}

/* A NaN or an infinity in one texel of a picture is none of its neighbours' business. */
TEST(texture, nearest_takes_nothing_from_other_texels)
{
    static const float odd[] = { NAN, INFINITY, -INFINITY, 3e38f };
    for (int k = 0; k < 4; k++) {
        float pixels[3][3][4];
        shade_texture t = { .pixels = pixels, .width = 3, .height = 3,
                            .format = SHADE_FORMAT_RGBA32F, .filter = SHADE_FILTER_NEAREST };
        for (int i = 0; i < 36; i++) (&pixels[0][0][0])[i] = odd[k];
        for (int n = 0; n < 4; n++) pixels[1][1][n] = k == 3 ? -3e38f : 0.25f * (float)n;
        for (int n = 0; n < 100; n++) {
            float got[4];
            sample_to(&t, rnd_float(0.34, 0.66), rnd_float(0.34, 0.66), 0, got);
            for (int c = 0; c < 4; c++) CHECK_NEAR(got[c], pixels[1][1][c], 0);
        }
        shade_vec4 s = shade_sample(&t, 0.1f, 0.1f, 0);
        CHECK(float_bits(s.x) == float_bits(odd[k]) || k == 0);
    }
}

/* All bits set or none, in every format of integers: blending equal texels must not leave them,
   but for what the sRGB curve rounds. */
TEST(texture, full_texels_are_exactly_one_and_empty_ones_zero)
{
    for (int i = 0; i < 2 * 3 * SHADE_FORMAT_RGBA32F; i++) {
        unsigned char pixels[4 * 4 * 4];
        shade_texture t = { .pixels = pixels, .width = 4, .height = 4, .srgb = i & 1,
                            .filter = (shade_filter)(i / 2 % 3), .format = (shade_format)(i / 6) };
        for (int full = 0; full < 2; full++) {
            memset(pixels, full ? 255 : 0, sizeof pixels);
            for (int k = 0; k < 30; k++) {
                float got[4];
                sample_to(&t, rnd_float(-2, 2), rnd_float(-2, 2), 0, got);
                for (int n = 0; n < 4; n++) {
                    double want = canvas_most(t.format, n) ? full : 1;
                    CHECK_NEAR(got[n], want, t.srgb && full && n < 3 ? 2e-6 : 0);
                }
            }
        }
    }
}

/* Half of black and white is 0.5 in linear light; blended as bytes it would decode to 0.21. Then
   each of the 256 codes alone. */
TEST(texture, srgb_texels_are_decoded_before_they_are_blended)
{
    unsigned char pixels[2][4] = { { 0, 0, 0, 0 }, { 255, 255, 255, 255 } };
    shade_texture t = { .pixels = pixels, .width = 2, .height = 1, .srgb = 1 };
    shade_vec4 c = shade_sample(&t, 0.5f, 0.5f, 0);
    CHECK_NEAR(c.x, 0.5, 2e-6);
    CHECK_NEAR(c.w, 0.5, 1e-7);
    for (int i = 0; i < 256; i++) {
        memset(pixels, i, sizeof pixels);
        c = shade_sample(&t, 0.3f, 0.5f, 0);
        CHECK_NEAR(c.y, ref_decode_srgb(i / 255.0), 2e-6);
        CHECK_NEAR(c.w, i / 255.0, 1.2e-7);
    }
}

/* A texel's code times 1 / full, decoded by the curve, to the last bit: 1.1 computed maps so.
   Every code of 5, 6 and 8 bits, in each format that can be sRGB, by every filter. */
TEST(texture, light_of_an_srgb_code_has_the_bits_of_the_curve)
{
    static const shade_format formats[] = { SHADE_FORMAT_RGBA8, SHADE_FORMAT_BGRA8,
                                            SHADE_FORMAT_RGB565, SHADE_FORMAT_RGB565_SWAPPED };
    for (int n = 0; n < 4 * 3 * 256; n++) {
        const int code = n % 256, wide = n / 256 % 4 < 2;
        const float fifth = 1 / 31.0f, sixth = 1 / 63.0f, eighth = 1 / 255.0f;
        unsigned char pixels[2][4];
        uint16_t half = (uint16_t)((code & 31) << 11 | (code & 63) << 5 | (code & 31));
        const float c8 = (float)code * eighth;
        shade_vec3 want = shade_v3(c8, c8, c8);
        shade_texture t = { .pixels = pixels, .width = 1, .height = 1, .srgb = 1,
                            .format = formats[n / 256 % 4], .filter = (shade_filter)(n / 1024) };
        if (t.format == SHADE_FORMAT_RGB565_SWAPPED) half = (uint16_t)(half << 8 | half >> 8);
        memset(pixels, code, sizeof pixels);
        if (!wide) {
            memcpy(pixels, &half, 2);
            want = shade_v3((float)(code & 31) * fifth, (float)(code & 63) * sixth,
                            (float)(code & 31) * fifth);
        }
        want = shade_linear_from_srgb(want);
        shade_vec4 c = shade_sample(&t, 0.3f, 0.7f, 0);
        CHECK_SAY(!memcmp(&c, &want, sizeof want), "format %d, code %d: %a %a %a, not %a %a %a",
                  (int)t.format, code, (double)c.x, (double)c.y, (double)c.z, (double)want.x,
                  (double)want.y, (double)want.z);
    }
}

/* Four texels 0, 1, 2, 3: a sample says where it is.  Coordinates at texel centres, between
   them, at the seam, beyond the whole numbers that floats tell apart, and none at all.  The
   other axis, one texel long, may wrap in any way. */
TEST(texture, beyond_the_edges_each_axis_wraps_by_its_own_rule)
{
    float pixels[4][4];
    shade_texture t = { .pixels = pixels, .width = 4, .height = 1, .format = SHADE_FORMAT_RGBA32F,
                        .wrap_v = SHADE_WRAP_CLAMP };
    for (int i = 0; i < 16; i++) pixels[i / 4][i % 4] = (float)(i / 4);
    static const struct {
        float u, repeat, clamp, mirror;
    } row[] = {
        { 0, 1.5f, 0, 0 },          { 1, 1.5f, 3, 3 },      { 0.125f, 0, 0, 0 },
        { -0.125f, 3, 0, 0 },       { 1.125f, 0, 3, 3 },    { 0.25f, 0.5f, 0.5f, 0.5f },
        { -0.25f, 2.5f, 0, 0.5f },  { 1.25f, 0.5f, 3, 2.5f }, { 0.9375f, 2.25f, 3, 3 },
        { 2, 1.5f, 3, 0 },          { -1, 1.5f, 0, 3 },     { 3.375f, 1, 3, 2 },
        { 8388609, 1.5f, 3, 3 },    { -8388609, 1.5f, 0, 3 }, { 8388608, 1.5f, 3, 0 },
        { 16777216, 1.5f, 3, 0 },   { 1e30f, 1.5f, 3, 0 },  { -1e30f, 1.5f, 0, 0 },
        { 3e38f, 1.5f, 3, 0 },      { NAN, 1.5f, 0, 0 },    { INFINITY, 1.5f, 0, 0 },
        { -INFINITY, 1.5f, 0, 0 },  { -NAN, 1.5f, 0, 0 },   { -0.0f, 1.5f, 0, 0 },
    };
    for (size_t k = 0; k < sizeof row / sizeof row[0]; k++) {
        const float want[3] = { row[k].repeat, row[k].clamp, row[k].mirror };
        for (int wrap = 0; wrap < 3; wrap++) {
            for (int other = 0; other < 3; other++) {
                t.wrap_u = (shade_wrap)wrap;
                t.wrap_v = (shade_wrap)other;
                CHECK_SAY(fabsf(shade_sample(&t, row[k].u, 0.5f, 0).x - want[wrap]) <= 0,
                          "wrap %d at u = %g: got %g, want %g", wrap, (double)row[k].u,
                          (double)shade_sample(&t, row[k].u, 0.5f, 0).x, (double)want[wrap]);
                t.width = 1;
                t.height = 4;
                t.wrap_u = (shade_wrap)other;
                t.wrap_v = (shade_wrap)wrap;
                CHECK_NEAR(shade_sample(&t, 0.5f, row[k].u, 0).x, want[wrap], 0);
                t.width = 4;
                t.height = 1;
            }
        }
    }
}

/* The ways in which a texture is bad; the first makes its stride one less than its width. */
#define TEXTURE_FAULT(field, value) { FAULT(shade_texture, field, value) }
static const fault bad_textures[][FAULTS] = {
    { { 0 } },
    { FAULT_NULL(shade_texture, pixels) },
    TEXTURE_FAULT(width, 0),
    TEXTURE_FAULT(width, -4),
    { FAULT(shade_texture, width, 16385), FAULT(shade_texture, stride, 0) },
    TEXTURE_FAULT(width, INT_MAX),
    TEXTURE_FAULT(height, 0),
    TEXTURE_FAULT(height, -4),
    TEXTURE_FAULT(height, 16385),
    TEXTURE_FAULT(height, INT_MIN),
    TEXTURE_FAULT(stride, -4),
    TEXTURE_FAULT(stride, INT_MIN),
    TEXTURE_FAULT(format, TEXTURE_FORMATS),
    TEXTURE_FAULT(format, -1),
    TEXTURE_FAULT(wrap_u, 3),
    TEXTURE_FAULT(wrap_v, 99),
    TEXTURE_FAULT(wrap_v, -1),
    TEXTURE_FAULT(filter, 3),
};
enum { TEXTURE_FAULTS = sizeof bad_textures / sizeof bad_textures[0] };

/* Makes a good texture, more than a texel wide, a bad one. */
static void spoil_texture(shade_texture *t, int kind)
{
    if (kind == 0) t->stride = t->width - 1;
    spoil(t, bad_textures[kind]);
}

/* the same bits by the way of the commonest texture and by that of all others */
TEST(texture, any_address_and_any_stride_give_the_same_bits)
{
    enum { WIDE = 262144 };
    static uint32_t aligned[2 * WIDE];
    static unsigned char bytes[4 * 64 + 1];
    for (int i = 0; i < 8; i++) {
        aligned[i] = (uint32_t)rnd_bits();
        aligned[WIDE + i] = (uint32_t)rnd_bits();
    }
    for (int row = 0; row < 8; row++) memcpy(bytes + 1 + 32 * row, aligned + (row & 1) * WIDE, 32);
    for (int i = 0; i < 300; i++) {
        shade_texture far_rows, odd;
        shade_texture near_rows = { .pixels = aligned, .width = 8, .height = 2, .stride = WIDE };
        far_rows = odd = near_rows;
        far_rows.height = 16384; /* rows * stride beyond 2^31: only the first two are there */
        odd.pixels = bytes + 1;
        odd.stride = 8;
        float u = rnd_float(-3, 3), v = rnd_float(0.25, 0.75);
        shade_vec4 want = shade_sample(&near_rows, u, v, 0);
        shade_vec4 got = shade_sample(&odd, u, v, 0);
        CHECK(!memcmp(&got, &want, sizeof got));
        got = shade_sample(&far_rows, u, v / 8192, 0);
        CHECK_NEAR(got.x, want.x, 1e-5);
        CHECK_NEAR(got.w, want.w, 1e-5);
    }
}

TEST(texture, a_bad_texture_is_white)
{
    float pixels[64], u[SHADE_LANES], v[SHADE_LANES], rgba[4 * SHADE_LANES];
    for (int i = 0; i < 64; i++) pixels[i] = 0.25f;
    for (int i = 0; i < SHADE_LANES; i++) u[i] = v[i] = 0.3f;
    for (int k = -2; k < TEXTURE_FAULTS; k++) {
        const shade_texture *p;
        shade_texture t = { 0 };
        p = k == -1 ? NULL : &t;
        t.pixels = pixels;
        t.width = t.height = 4;
        t.format = SHADE_FORMAT_RGBA32F;
        if (k >= 0) spoil_texture(&t, k);
        float want = k == -2 ? 0.25f : 1.0f, got[4];
        sample_to(p, 0.3f, 0.3f, 0, got);
        shade_sample_lanes(p, u, v, NULL, rgba);
        for (int n = 0; n < 4; n++) CHECK_NEAR(got[n], want, 0);
        for (int n = 0; n < 4 * SHADE_LANES; n++) CHECK_NEAR(rgba[n], want, 0);
    }
}

/* What lies around the texels of floats is NaN, and any that is read, even with a weight of zero,
   makes the sample NaN. */
/* G1 */
TEST(texture, no_texel_outside_the_picture_is_read)
{
    enum { FRAME = 70 };
    for (int i = 0; i < 300; i++) {
        int w = rnd_int(1, 12), h = rnd_int(1, 12), stride = w + rnd_int(1, 6);
        size_t cells = (size_t)(stride * h + 2 * FRAME);
        float *all = test_memory(16 * cells);
        shade_texture t = { 0 };
        for (size_t k = 0; k < 4 * cells; k++) all[k] = (float)NAN;
        for (int y = 0; y < h; y++)
            for (int x = 0; x < w; x++)
                for (int c = 0; c < 4; c++) all[4 * (FRAME + y * stride + x) + c] = rnd_float(0, 1);
        t.pixels = all + 4 * FRAME;
        t.width = w;
        t.height = h;
        t.stride = stride;
        t.format = SHADE_FORMAT_RGBA32F;
        t.filter = (shade_filter)rnd_int(0, 2);
        t.wrap_u = (shade_wrap)rnd_int(0, 2);
        t.wrap_v = (shade_wrap)rnd_int(0, 2);
        for (int k = 0; k < 100; k++) {
            float u = random_coordinate(), v = random_coordinate(), got[4];
            sample_to(&t, u, v, 0, got);
            CHECK_SAY(got[0] >= 0 && got[1] >= 0 && got[2] <= 1 && got[3] <= 1,
                      "%d x %d wrap %d %d at %a %a", w, h, (int)t.wrap_u, (int)t.wrap_v, (double)u,
                      (double)v);
        }
        free(all);
    }
}

/* lanes of one packet that read different levels */
/* G14 */
TEST(texture, lanes_stay_apart_when_texels_are_not_finite)
{
    for (int i = 0; i < 100; i++) {
        static float u[SHADE_LANES], v[SHADE_LANES], lod[SHADE_LANES], rgba[4 * SHADE_LANES];
        shade_texture t = texture_of(8, 8, SHADE_FORMAT_RGBA32F), levels[16];
        float *memory = (float *)add_mipmaps(&t, levels);
        t.filter = SHADE_FILTER_TRILINEAR;
        for (int k = 0; k < 5; k++) memory[rnd_int(0, 4 * 21 - 1)] = k & 1 ? INFINITY : (float)NAN;
        for (int k = 0; k < SHADE_LANES; k++) {
            u[k] = rnd_float(-1, 1);
            v[k] = rnd_float(-1, 1);
            lod[k] = rnd_one_in(2) ? 0 : rnd_float(0, 3);
        }
        shade_sample_lanes(&t, u, v, lod, rgba);
        for (int k = 0; k < SHADE_LANES; k++) {
            float got[4];
            sample_to(&t, u[k], v[k], lod[k], got);
            for (int c = 0; c < 4; c++) {
                float lane = rgba[c * SHADE_LANES + k];
                CHECK_SAY(float_bits(got[c]) == float_bits(lane) || (isnan(got[c]) && isnan(lane)),
                          "lod %g: %g, scalar %g", (double)lod[k], (double)lane, (double)got[c]);
                CHECK(lod[k] > 0 || isfinite(lane));
            }
        }
        free(memory);
        free_texture(&t);
    }
}

TEST(texture, mipmaps_are_read_by_trilinear_alone_and_only_where_there_are_some)
{
    for (int i = 0; i < 100; i++) {
        shade_texture t = random_texture(20), levels[16], plain;
        void *memory = add_mipmaps(&t, levels);
        plain = t;
        plain.mipmaps = NULL;
        plain.mipmap_count = 0;
        for (int k = 0; k < 4; k++) {
            shade_texture a = t, b = plain;
            a.filter = b.filter = k == 1 ? SHADE_FILTER_NEAREST : SHADE_FILTER_BILINEAR;
            if (k == 2) {
                a = plain;
                a.filter = SHADE_FILTER_TRILINEAR;
                a.mipmap_count = 5;
            }
            if (k == 3) {
                a.filter = SHADE_FILTER_TRILINEAR;
                a.mipmap_count = -3;
            }
            for (int n = 0; n < 10; n++) {
                float u = random_coordinate(), v = random_coordinate(), x[4], y[4];
                sample_to(&a, u, v, rnd_float(-2, 9), x);
                sample_to(&b, u, v, 0, y);
                CHECK(!memcmp(x, y, sizeof x));
            }
        }
        free(memory);
        free_texture(&t);
    }
}

TEST(texture, a_bad_level_is_replaced_by_the_full_size)
{
    for (int i = 0; i < 100; i++) {
        shade_texture t = random_texture(20), levels[16], full;
        if (t.width < 2 || t.height < 2) {    /* has no level */
            free_texture(&t);
            continue;
        }
        void *memory = add_mipmaps(&t, levels);
        t.filter = SHADE_FILTER_TRILINEAR;
        full = t;
        full.filter = SHADE_FILTER_BILINEAR;
        if (i % 2) levels[0].width = 0;
        else levels[0].pixels = NULL;
        float u = random_coordinate(), v = random_coordinate(), got[4], want[4];
        sample_to(&full, u, v, 0, want);
        for (int n = 0; n < 5; n++) { /* a blend of the full size with itself */
            sample_to(&t, u, v, 0.25f * (float)n, got);
            for (int k = 0; k < 4; k++) {
                CHECK_NEAR(got[k], want[k], 1e-6 * fmax(1, fabs((double)want[k])));
            }
        }
        free(memory);
        free_texture(&t);
    }
}

TEST(texture, sampling_a_packet_needs_coordinates_and_a_place)
{
    float u[SHADE_LANES] = { 0 }, rgba[4 * SHADE_LANES];
    shade_texture t = random_texture(8);
    for (int i = 0; i < 4 * SHADE_LANES; i++) rgba[i] = 7;
    shade_sample_lanes(&t, NULL, u, NULL, rgba);
    shade_sample_lanes(&t, u, NULL, NULL, rgba);
    shade_sample_lanes(&t, u, u, NULL, NULL);
    for (int i = 0; i < 4 * SHADE_LANES; i++) CHECK_NEAR(rgba[i], 7, 0);
    free_texture(&t);
}

/* ------------------------------------------------------------------------------------- mipmaps */

/* A third of the sizes reach up to the greatest there is, where the bytes of the widest format
   are beyond an int. */
TEST(texture, mipmap_counts_and_bytes_are_those_of_halving_downward)
{
    static const size_t cell[TEXTURE_FORMATS] = { 4, 4, 2, 2, 16, 1 };
    for (int i = 0; i < 3000; i++) {
        int w = rnd_one_in(3) ? rnd_int(1, 16384) : rnd_int(1, 40), n = 0;
        int h = rnd_one_in(3) ? rnd_int(1, 16384) : rnd_int(1, 40);
        size_t cells = 0;
        for (int a = w, b = h; a > 1 || b > 1; n++) {
            a = a > 1 ? a / 2 : 1;
            b = b > 1 ? b / 2 : 1;
            cells += (size_t)a * (size_t)b;
        }
        CHECK_INT(shade_mipmap_count(w, h), n);
        for (int f = 0; f < TEXTURE_FORMATS; f++)
            CHECK_INT(shade_mipmap_bytes(w, h, (shade_format)f), cells * cell[f]);
    }
    CHECK_INT(shade_mipmap_count(1, 1), 0);
    CHECK_INT(shade_mipmap_count(16384, 16384), 14);
    CHECK_INT(shade_mipmap_count(0, 5), 0);
    CHECK_INT(shade_mipmap_count(5, -1), 0);
    CHECK_INT(shade_mipmap_count(16385, 5), 0);
    CHECK_INT(shade_mipmap_bytes(5, 16385, SHADE_FORMAT_RGBA8), 0);
    CHECK_INT(shade_mipmap_bytes(0, 5, SHADE_FORMAT_RGBA8), 0);
    CHECK_INT(shade_mipmap_bytes(8, 8, (shade_format)TEXTURE_FORMATS), 0);
}

/* Texel (x, y) of a level of w x h texels: the mean of the rectangle of the level above that it
   covers, by area. */
static void ref_shrunk(const shade_texture *up, int w, int h, int x, int y, double mean[4])
{
    double x0 = (double)x * up->width / w, x1 = (x + 1.0) * up->width / w, area = 0;
    double y0 = (double)y * up->height / h, y1 = (y + 1.0) * up->height / h;
    for (int k = 0; k < 4; k++) mean[k] = 0;
    for (int j = 0; j < up->height; j++)
        for (int i = 0; i < up->width; i++) {
            double a = fmin(i + 1, x1) - fmax(i, x0), b = fmin(j + 1, y1) - fmax(j, y0), c[4];
            if (a <= 0 || b <= 0) continue;
            ref_texel(up, i, j, c);
            for (int k = 0; k < 4; k++) mean[k] += a * b * c[k];
            area += a * b;
        }
    for (int k = 0; k < 4; k++) mean[k] /= area;
}

static void check_level(const shade_texture *up, const shade_texture *t)
{
    for (int y = 0; y < t->height; y++)
        for (int x = 0; x < t->width; x++) {
            double want[4];
            ref_shrunk(up, t->width, t->height, x, y, want);
            for (int k = 0; k < 4; k++) {
                shade_texture raw = *t;
                double got[4], stored = t->srgb && k < 3 ? ref_encode_srgb(want[k]) : want[k];
                double steps = canvas_most(t->format, k);
                raw.srgb = 0;
                ref_texel(&raw, x, y, got);
                if (t->format == SHADE_FORMAT_RGBA32F)
                    CHECK_NEAR(got[k], want[k], 1e-6);
                else
                    CHECK_NEAR(got[k] * steps, stored * steps, 0.502); /* half, and roundings */
            }
        }
}

/* Sizes up to 33: odd ones have texels that lie in two of the smaller level. */
TEST(texture, mipmaps_are_means_by_area_in_linear_light)
{
    for (int i = 0; i < 150; i++) {
        shade_texture t = random_texture(33), levels[17];
        memset(levels, CANVAS_BYTE, sizeof levels);
        size_t bytes = shade_mipmap_bytes(t.width, t.height, t.format);
        int count = shade_mipmap_count(t.width, t.height), w = t.width, h = t.height;
        unsigned char *block = canvas_block(bytes), *at = block + CANVAS_GUARD;
        shade_texture before = t;
        CHECK_INT(shade_build_mipmaps(&t, levels, at, bytes), SHADE_OK);
        CHECK_INT(t.mipmap_count, count);
        CHECK(count == 0 || t.mipmaps == levels);
        CHECK(t.pixels == before.pixels && t.width == before.width && t.wrap_u == before.wrap_u);
        for (int k = 0; k < count; k++) {
            w = w > 1 ? w / 2 : 1;
            h = h > 1 ? h / 2 : 1;
            CHECK_INT(levels[k].width, w);
            CHECK_INT(levels[k].height, h);
            CHECK_INT(levels[k].format, t.format);
            CHECK_INT(!levels[k].srgb, !t.srgb);
            CHECK(levels[k].pixels == at && texture_stride(&levels[k]) == (size_t)w);
            at += (size_t)w * (size_t)h * canvas_pixel_bytes(t.format);
            check_level(k ? &levels[k - 1] : &t, &levels[k]);
        }
        for (size_t k = 0; k < CANVAS_GUARD; k++) {
            CHECK(block[k] == CANVAS_BYTE && block[CANVAS_GUARD + bytes + k] == CANVAS_BYTE);
        }
        free(block);
        free_texture(&t);
    }
}

TEST(texture, mipmaps_of_one_colour_are_that_colour)
{
    for (int i = 0; i < 120; i++) {
        shade_texture t = random_texture(40), levels[16];
        size_t size = canvas_pixel_bytes(t.format), cells = texture_cells(&t);
        unsigned char *p;
        memcpy(&p, &t.pixels, sizeof p);
        for (size_t k = 1; k < cells; k++) memcpy(p + k * size, p, size);
        void *memory = add_mipmaps(&t, levels);
        size_t bytes = shade_mipmap_bytes(t.width, t.height, t.format);
        for (size_t at = 0; at < bytes; at += size) {
            CHECK_SAY(!memcmp((unsigned char *)memory + at, p, size), "%d x %d format %d srgb %d",
                      t.width, t.height, (int)t.format, t.srgb);
        }
        free(memory);
        free_texture(&t);
    }
}

/* Of these widths the end of the last texel, computed in doubles, lies a hair beyond the picture,
   where there is NaN. */
TEST(texture, mipmaps_take_nothing_from_beyond_the_picture)
{
    static const int sizes[] = { 27, 29, 31, 47, 55, 89, 107 };
    for (int i = 0; i < 2 * TEST_COUNT(sizes); i++) {
        const int n = sizes[i / 2], upright = i % 2;
        float texel[4 * 2 * 108], memory[4 * 108];
        shade_texture t, levels[16];
        CHECK((double)n / (n / 2) * (n / 2) > n);
        for (int k = 0; k < 4 * 2 * 108; k++) texel[k] = NAN;
        for (int k = 0; k < 4 * n; k++) texel[upright ? k / 4 * 8 + k % 4 : k] = 0.5f;
        memset(&t, 0, sizeof t);
        t.pixels = texel;
        t.width = upright ? 1 : n;
        t.height = upright ? n : 1;
        t.stride = upright ? 2 : n + 1;
        t.format = SHADE_FORMAT_RGBA32F;
        CHECK_INT(shade_build_mipmaps(&t, levels, memory, sizeof memory), SHADE_OK);
        for (int k = 0; k < 4 * (n / 2); k++) CHECK(memory[k] == 0.5f);
    }
}

/* What shade_build_mipmaps is given, for a picture whose sizes are odd. */
typedef struct mipmap_call {
    shade_texture *texture, *levels;
    void *memory;
    int moved, short_of; /* bytes that memory is off its alignment, and less than it takes */
    shade_texture t;
} mipmap_call;

#define MIPMAP_FAULT(field, value) FAULT(mipmap_call, field, value)
static const refusal bad_mipmap_calls[] = {
    { SHADE_ERROR_ARGUMENT, { FAULT_NULL(mipmap_call, texture) } },
    { SHADE_ERROR_ARGUMENT, { FAULT_NULL(mipmap_call, levels) } },
    { SHADE_ERROR_ARGUMENT, { FAULT_NULL(mipmap_call, memory) } },
    { SHADE_ERROR_ARGUMENT, { MIPMAP_FAULT(moved, 1) } },
    { SHADE_ERROR_ARGUMENT, { MIPMAP_FAULT(moved, 2) } },
    { SHADE_ERROR_CAPACITY, { MIPMAP_FAULT(short_of, 1) } },
    { SHADE_ERROR_CAPACITY, { MIPMAP_FAULT(short_of, INT_MAX) } }, /* no bytes at all */
    { SHADE_ERROR_TEXTURE, { FAULT_NULL(mipmap_call, t.pixels) } },
    { SHADE_ERROR_TEXTURE, { MIPMAP_FAULT(t.width, 0) } },
    { SHADE_ERROR_TEXTURE, { MIPMAP_FAULT(t.stride, 5) } },
    { SHADE_ERROR_TEXTURE, { MIPMAP_FAULT(t.format, TEXTURE_FORMATS) } },
    { SHADE_ERROR_TEXTURE, { MIPMAP_FAULT(t.wrap_u, -1) } },
};

TEST(texture, bad_mipmap_calls_are_refused_and_change_nothing)
{
    enum { ROOM = 4096 }; /* more than the levels of 13 x 7 pixels take in any format */
    unsigned char *block = canvas_block(ROOM);
    for (int row = 0; row < TEST_COUNT(bad_mipmap_calls); row++) {
        shade_texture good = texture_of(13, 7, rnd_texture_format()), levels[16];
        size_t bytes = shade_mipmap_bytes(13, 7, good.format);
        mipmap_call bad = { NULL, levels, block + CANVAS_GUARD, 0, 0, good };
        bad.texture = &bad.t;
        spoil(&bad, bad_mipmap_calls[row].faults);
        if (bad.moved) bad.memory = (unsigned char *)bad.memory + bad.moved;
        bytes -= (size_t)bad.short_of < bytes ? (size_t)bad.short_of : bytes;

        shade_result got = shade_build_mipmaps(bad.texture, bad.levels, bad.memory, bytes);
        check_refusal(row, got, bad_mipmap_calls[row].want);
        CHECK(!bad.t.mipmaps && bad.t.mipmap_count == 0);
        CHECK_SAY(untouched(block, ROOM + 2 * CANVAS_GUARD), "row %d", row);
        free_texture(&good);
    }
    free(block);
}

TEST(texture, one_pixel_takes_no_mipmaps_and_no_memory_for_them)
{
    shade_texture one = texture_of(1, 1, SHADE_FORMAT_RGBA8);
    CHECK_INT(shade_build_mipmaps(&one, NULL, NULL, 0), SHADE_OK);
    CHECK_INT(one.mipmap_count, 0);
    free_texture(&one);
}

/* ------------------------------------------------------------------------------ level of detail */

static void lod_fragment(const void *uniforms, const shade_fragments *SHADE_RESTRICT in,
                         shade_colors *SHADE_RESTRICT out)
{
    const lod_scene *s = (const lod_scene *)uniforms;
    (void)out;
    for (int i = 0; i < in->count; i++) s->lod[(int)in->y[i]][(int)in->x[i]] = in->lod[i];
    for (int i = in->count; i < SHADE_LANES; i++) {
        CHECK(float_bits(in->lod[i]) == float_bits(in->lod[in->count - 1]));
    }
}

/* f = N / D of two planes; its steps to the right and below */
typedef struct lod_planes {
    double u[3], v[3], d[3];
} lod_planes;

static lod_planes lod_planes_of(const lod_scene *s, const ref_triangle *t)
{
    lod_planes p = { 0 };
    for (int k = 0; k < 3; k++)
        for (int j = 0; j < 3; j++) {
            double e = t->e[k][j]; /* barycentric over w */
            p.u[j] += e * (double)s->attribute[k][s->first];
            p.v[j] += e * (double)s->attribute[k][s->first + 1];
            p.d[j] += e;
        }
    return p;
}

/* and the roundings that enter, relative to the step */
static double lod_step(const double n[3], const double d[3], double X, double Y, int axis,
                       double *noise)
{
    double N = ref_at(n, X, Y), D = ref_at(d, X, Y), size = 0;
    for (int j = 0; j < 3; j++) size = fmax(size, fabs(n[j] * (j == 0 ? X : j == 1 ? Y : 1)));
    *noise = (fabs(n[axis] * D) + fabs(N * d[axis]) + size * fabs(d[axis])) / (D * D);
    return (n[axis] * D - N * d[axis]) / (D * D);
}

static double ref_lod(const lod_planes *p, double X, double Y, double w, double h, double *slack)
{
    double best = 0, noise = 0;
    for (int axis = 0; axis < 2; axis++) {
        double a, b, du = w * lod_step(p->u, p->d, X, Y, axis, &a);
        double dv = h * lod_step(p->v, p->d, X, Y, axis, &b), step = hypot(du, dv);
        noise = fmax(noise, hypot(w * a, h * b));
        best = fmax(best, step);
    }
    *slack = noise / best;
    return log2(best);
}

/* clip_of_fx8 leaves corners up to 1/2000 pixel off the ones that are drawn, and planes have some
   float roundings: 2e-4 of the terms that cancel.  scale: of the whole scene, which changes
   nothing. */
static void check_lod(shade_interpolation interpolation, int flat, double scale)
{
    static float lod[48][64];
    long checked = 0;
    for (int i = 0; i < 400; i++) {
        canvas c = canvas_open(64, 48, 0, SHADE_FORMAT_RGBA8, 0);
        lod_scene s;
        ref_triangle t;
        int64_t x[3], y[3];
        double area;
        do {
            for (int k = 0; k < 3; k++) {
                x[k] = rnd_int(-20 * 256, 84 * 256);
                y[k] = rnd_int(-20 * 256, 68 * 256);
            }
            area = fabs((double)((x[1] - x[0]) * (y[2] - y[0]) - (y[1] - y[0]) * (x[2] - x[0])));
        } while (area < 65536.0 * 600);
        for (int k = 0; k < 3; k++) {
            double w = scale * (flat ? 2 : (double)rnd_log(0.3, 3));
            s.clip[k] = clip_of_fx8((double)x[k], (double)y[k], 64, 48, 0, w);
            for (int n = 0; n < 5; n++) s.attribute[k][n] = rnd_float(-2, 2);
        }
        s.first = rnd_int(0, 3);
        s.lod = lod;
        for (int k = 0; k < 48 * 64; k++) lod[k / 64][k % 64] = (float)NAN;
        shade_pipeline p = { .vertex = lod_vertex, .fragment = lod_fragment, .uniforms = &s,
                             .varyings = 5 };
        shade_texture map = lod_map(rnd_int(1, 600), rnd_int(1, 600));
        p.interpolation = interpolation;
        p.lod_texture = &map;
        p.lod_varying = s.first;
        canvas_draw(&c, &p, 3);
        CHECK(ref_triangle_of(&t, &s.clip[0], &s.clip[1], &s.clip[2], 64, 48));
        lod_planes planes = lod_planes_of(&s, &t);
        for (int k = 0; k < 48 * 64; k++) {
            if (isnan(lod[k / 64][k % 64])) continue;
            double slack, want = ref_lod(&planes, k % 64 + 0.5, k / 64 + 0.5, (double)map.width,
                                         (double)map.height, &slack);
            if (slack > 100) continue; /* the step is lost in the roundings */
            checked++;
            CHECK_NEAR(lod[k / 64][k % 64], want, 1e-3 + 4e-4 * slack);
        }
        canvas_close(&c);
    }
    CHECK_SAY(checked > 100000, "%ld pixels", checked);
}

TEST(texture, lod_is_the_log_of_the_longer_step_under_perspective)
{
    check_lod(SHADE_INTERPOLATION_PERSPECTIVE, 0, 1);
}

TEST(texture, lod_is_that_of_the_perspective_interpolation_whatever_is_interpolated)
{
    check_lod(SHADE_INTERPOLATION_AFFINE, 0, 1);
    check_lod(SHADE_INTERPOLATION_CONSTANT, 0, 1);
}

TEST(texture, lod_without_perspective_is_one_number)
{
    check_lod(SHADE_INTERPOLATION_PERSPECTIVE, 1, 1);
}

TEST(texture, lod_is_the_same_in_scenes_of_any_size)
{
    for (int k = 0; k < 4; k++) {
        double scale = k % 2 ? 1e-12 : 1e12;
        check_lod(k < 2 ? SHADE_INTERPOLATION_PERSPECTIVE : SHADE_INTERPOLATION_AFFINE, 0, scale);
    }
}

/* Draws lod into rows that begin as NaN. */
static void draw_lod(const lod_scene *s, const shade_texture *map, shade_interpolation how)
{
    canvas c = canvas_open(64, 48, 0, SHADE_FORMAT_RGBA8, 0);
    shade_pipeline p = { .vertex = lod_vertex, .fragment = lod_fragment, .uniforms = s,
                         .varyings = 5, .interpolation = how, .lod_texture = map,
                         .lod_varying = s->first };
    for (int k = 0; k < 48 * 64; k++) s->lod[k / 64][k % 64] = (float)NAN;
    canvas_draw(&c, &p, 3);
    canvas_close(&c);
}

static shade_vec4 scaled_corner(shade_vec4 p, double by)
{
    return shade_v4((float)((double)p.x * by), (float)((double)p.y * by),
                    (float)((double)p.z * by), (float)((double)p.w * by));
}

/* Cut triangles: the same bits in every interpolation, and in scenes 2^40 times as large or small,
   where all products are; 1e12 times rounds otherwise.  Corners at the cut are snapped, so that
   slices of a cut polygon, few pixels wide, have steps of their own. */
TEST(texture, lod_of_cut_triangles_is_that_of_the_whole)
{
    static const double scale[5] = { 1, 1099511627776.0, 1 / 1099511627776.0, 1e12, 1e-12 };
    static float lod[15][48][64];
    long checked = 0, apart = 0, moved = 0;
    for (int i = 0; i < test_rounds(1500); i++) {
        shade_texture map = lod_map(rnd_int(1, 600), rnd_int(1, 600));
        shade_vec4 clip[3];
        lod_scene s;
        ref_triangle t;
        if (i % 4 == 3)
            random_eye_triangle(clip, 0, 15); /* behind the eye as well */
        else
            random_cut_triangle(i % 4, 0, clip);
        for (int k = 0; k < 15; k++) s.attribute[k / 5][k % 5] = rnd_float(-2, 2);
        s.first = rnd_int(0, 3);
        for (int k = 0; k < 15; k++) {
            for (int n = 0; n < 3; n++) s.clip[n] = scaled_corner(clip[n], scale[k / 3]);
            s.lod = lod[k];
            draw_lod(&s, &map, (shade_interpolation)(k % 3));
            if (k % 3) CHECK(!memcmp(lod[k], lod[k - 1], sizeof lod[k]));
            if (k / 3 == 1 || k / 3 == 2) CHECK(!memcmp(lod[k], lod[0], sizeof lod[k]));
        }
        if (!ref_triangle_of(&t, &clip[0], &clip[1], &clip[2], 64, 48)) continue;
        lod_planes planes = lod_planes_of(&s, &t);
        for (int k = 0; k < 48 * 64; k++) {
            int x = k % 64, y = k / 64;
            double slack, want = ref_lod(&planes, x + 0.5, y + 0.5, (double)map.width,
                                         (double)map.height, &slack);
            if (isnan(lod[0][y][x]) || slack > 20) continue;
            checked++;
            apart += fabs((double)lod[0][y][x] - want) > 0.02;
            for (int n = 9; n < 15; n += 3)
                moved += !(fabs((double)lod[n][y][x] - (double)lod[0][y][x]) <= 0.02);
        }
    }
    CHECK_SAY(checked > test_rounds(300000) && apart < checked / 2000 && moved < checked / 20000,
              "%ld of %ld pixels are off, %ld move", apart, checked, moved);
}

TEST(texture, the_lod_oracle_agrees_with_finite_differences)
{
    for (int i = 0; i < 300; i++) {
        lod_scene s;
        ref_triangle t;
        for (int k = 0; k < 3; k++) {
            double a = 2.0943951 * k + rnd_unit();
            s.clip[k] = clip_of_fx8(256 * (32 + 50 * cos(a)), 256 * (24 + 50 * sin(a)), 64, 48, 0,
                                    (double)rnd_log(0.5, 2));
            for (int n = 0; n < 5; n++) s.attribute[k][n] = rnd_float(-2, 2);
        }
        s.first = 1;
        s.lod = NULL;
        CHECK(ref_triangle_of(&t, &s.clip[0], &s.clip[1], &s.clip[2], 64, 48));
        {
            lod_planes p = lod_planes_of(&s, &t);
            double X = rnd_unit() * 20 + 20, Y = rnd_unit() * 20 + 14, slack, step[2];
            for (int axis = 0; axis < 2; axis++) {
                double h = 1e-4, dx = axis ? 0 : h, dy = axis ? h : 0, d[2];
                for (int n = 0; n < 2; n++) {
                    const double *plane = n ? p.v : p.u;
                    d[n] = (ref_at(plane, X + dx, Y + dy) / ref_at(p.d, X + dx, Y + dy) -
                            ref_at(plane, X - dx, Y - dy) / ref_at(p.d, X - dx, Y - dy)) /
                           (2 * h) * (n ? 80 : 100);
                }
                step[axis] = hypot(d[0], d[1]);
            }
            CHECK_NEAR(ref_lod(&p, X, Y, 100, 80, &slack), log2(fmax(step[0], step[1])), 1e-5);
            /* the planes are the interpolation that fragments get */
            double b[3], u = 0, sum = 0;
            ref_barycentric(&t, X, Y, b);
            for (int k = 0; k < 3; k++) {
                u += b[k] * (double)s.attribute[k][1];
                sum += b[k];
            }
            CHECK_NEAR(ref_at(p.u, X, Y) / ref_at(p.d, X, Y), u / sum, 1e-9);
        }
    }
}

/* before a pixel changes, in depth-only draws as well */
TEST(texture, a_bad_lod_texture_is_refused)
{
    canvas c = canvas_open(8, 8, 0, SHADE_FORMAT_RGBA8, 1);
    static float lod[48][64];
    lod_scene s = { 0 };
    for (int k = 0; k < 3; k++) s.clip[k] = clip_corners[k];
    s.lod = lod;
    for (int k = 0; k <= 2 * TEXTURE_FAULTS; k++) {
        shade_texture map = lod_map(4, 4);
        shade_stats stats;
        shade_pipeline p = { .vertex = lod_vertex, .fragment = k % 2 ? NULL : lod_fragment,
                             .uniforms = &s, .varyings = 5, .lod_texture = &map, .lod_varying = 1,
                             .interpolation = (shade_interpolation)(k % 3),
                             .raster.depth_test = SHADE_COMPARE_ALWAYS };
        if (k < 2 * TEXTURE_FAULTS) spoil_texture(&map, k / 2);
        CHECK_INT(shade_draw(&c.target, &p, NULL, 3, 3, &stats),
                  k < 2 * TEXTURE_FAULTS ? SHADE_ERROR_TEXTURE : SHADE_OK);
        CHECK_INT(c.color[CANVAS_GUARD + 4 * 36], k < 2 * TEXTURE_FAULTS ? CANVAS_BYTE : 0);
        CHECK_INT(stats.triangles, k == 2 * TEXTURE_FAULTS);
        if (k == 2 * TEXTURE_FAULTS) break;
        for (size_t i = 0; i < c.color_bytes; i++) CHECK(c.color[CANVAS_GUARD + i] == CANVAS_BYTE);
        for (size_t i = 0; i < c.depth_bytes; i++) CHECK(c.depth[CANVAS_GUARD + i] == CANVAS_BYTE);
    }
    canvas_close(&c);
}

TEST(texture, a_lod_varying_beyond_the_varyings_is_refused)
{
    canvas c = canvas_open(8, 8, 0, SHADE_FORMAT_RGBA8, 0);
    static float lod[48][64];
    lod_scene s = { .lod = lod };
    for (int k = -2; k < 8; k++) {
        shade_texture map = lod_map(4, 4);
        shade_pipeline p = { .vertex = lod_vertex, .fragment = lod_fragment, .uniforms = &s,
                             .varyings = 5, .lod_texture = &map, .lod_varying = k };
        CHECK_INT(shade_draw(&c.target, &p, NULL, 3, 3, NULL),
                  k < 0 || k > 3 ? SHADE_ERROR_TEXTURE : SHADE_OK);
        p.lod_varying = 2147483647 - (k + 2);
        CHECK_INT(shade_draw(&c.target, &p, NULL, 3, 3, NULL), SHADE_ERROR_TEXTURE);
        p.lod_texture = NULL;
        canvas_draw(&c, &p, 3);
    }
    canvas_close(&c);
}

TEST(texture, coordinates_that_stand_still_have_no_detail) /* and no NaN */
{
    static float lod[48][64];
    for (int i = 0; i < 20; i++) {
        canvas c = canvas_open(64, 48, 0, SHADE_FORMAT_RGBA8, 0);
        lod_scene s = { 0 };
        for (int k = 0; k < 3; k++) {
            s.clip[k] = clip_of_fx8((double)rnd_int(0, 64 * 256), (double)rnd_int(0, 48 * 256), 64,
                                    48, 0, 1);
        }
        for (int k = 0; k < 48 * 64; k++) lod[k / 64][k % 64] = -1;
        s.lod = lod;
        shade_pipeline p = { .vertex = lod_vertex, .fragment = lod_fragment, .uniforms = &s,
                             .varyings = 5 };
        shade_texture map = lod_map(256, 256);
        p.lod_texture = &map;
        p.lod_varying = 1;
        canvas_draw(&c, &p, 3);
        for (int k = 0; k < 48 * 64; k++) CHECK(lod[k / 64][k % 64] <= 0);
        canvas_close(&c);
    }
}

/* ------------------------------------------------------------------------------- maps of meshes */

typedef struct map_scene {
    shade_vec3 position[3], normal[3], color[3];
    float uv[3][2];
    shade_texture map, levels[16];
    void *memory;
    shade_light lights[2];
    shade_material material;
    shade_mesh mesh;
    shade_draw_state state;
    double snapped[3][4]; /* clip space, x/w and y/w moved to the 1/256 grid of the picture */
} map_scene;

enum { MAP_WIDTH = 48, MAP_HEIGHT = 36 };

static shade_vec3 map_color(double most)
{
    return shade_v3(rnd_float(0, most), rnd_float(0, most), rnd_float(0, most));
}

/* 0: a corner lies where rounding may snap it to either side */
static int map_snap(map_scene *s)
{
    dmat m = dmat_mul(dmat_from(s->state.projection), dmat_from(s->state.view));
    for (int k = 0; k < 3; k++) {
        double p[4] = { (double)s->position[k].x, (double)s->position[k].y,
                        (double)s->position[k].z, 1 };
        double *c = s->snapped[k];
        dmat_apply(m, p, c);
        for (int axis = 0; axis < 2; axis++) {
            double half = (axis ? MAP_HEIGHT : MAP_WIDTH) / 2.0, sign = axis ? -1 : 1;
            double at = (sign * c[axis] / c[3] + 1) * half * 256;
            if (fabs(at - floor(at) - 0.5) < 0.02 || c[3] < 0.2) return 0;
            c[axis] = sign * (floor(at + 0.5) / 256 / half - 1) * c[3];
        }
    }
    return 1;
}

static void random_map_scene(map_scene *s, shade_shading shading)
{
    memset(s, 0, sizeof *s);
    shade_draw_state *state = &s->state;
    state->projection = rnd_one_in(4) ? shade_mat4_ortho(-2, 2, -1.5f, 1.5f, 0.5f, 12)
                                      : shade_mat4_perspective(0.9f, 4.0f / 3, 0.5f, 12);
    do {
        d3 eye = d3_scale(rnd_direction(), 3.5), a, b, n;
        state->view =
            shade_mat4_look_at(d3_round(eye), shade_v3(0, 0, 0), d3_round(rnd_direction()));
        for (int k = 0; k < 3; k++) s->position[k] = d3_round(d3_scale(rnd_direction(), 1.8));
        a = d3_sub(d3_from(s->position[1]), d3_from(s->position[0]));
        b = d3_sub(d3_from(s->position[2]), d3_from(s->position[0]));
        n = d3_unit(d3_cross(a, b));
        if (fabs(d3_dot(n, d3_unit(eye))) < 0.4 || d3_length(d3_cross(a, b)) < 2) continue;
        for (int k = 0; k < 3; k++) {
            s->normal[k] = d3_round(d3_unit(d3_add(n, d3_scale(rnd_direction(), 0.3))));
        }
    } while (d3_length(d3_from(s->normal[0])) < 0.5 || !map_snap(s));
    for (int k = 0; k < 3; k++) {
        s->color[k] = map_color(1);
        s->uv[k][0] = rnd_float(-0.3, 1.5);
        s->uv[k][1] = rnd_float(-0.3, 1.5);
    }
    s->map = texture_of(rnd_int(1, 12), rnd_int(1, 12), rnd_texture_format());
    s->map.srgb = rnd_one_in(2);
    s->map.wrap_u = (shade_wrap)rnd_int(0, 2);
    s->map.wrap_v = (shade_wrap)rnd_int(0, 2);
    if (rnd_one_in(2)) {
        s->memory = add_mipmaps(&s->map, s->levels);
        s->map.filter = SHADE_FILTER_TRILINEAR;
    }
    for (int k = 0; k < 2; k++) {
        d3 at = d3_scale(rnd_direction(), 5);
        s->lights[k] = k ? shade_directional_light(d3_round(rnd_direction()), map_color(1))
                         : shade_point_light(d3_round(at), map_color(1));
        s->lights[k].ambient = map_color(0.2);
    }
    s->material.emission = map_color(0.2);
    s->material.ambient = map_color(1);
    s->material.diffuse = map_color(1);
    s->material.specular = map_color(1);
    s->material.shininess = rnd_float(1, 30);
    s->mesh.positions = &s->position[0].x;
    s->mesh.vertex_count = 3;
    if (rnd_int(0, 3)) s->mesh.normals = &s->normal[0].x;
    if (rnd_one_in(2)) s->mesh.colors = &s->color[0].x;
    s->mesh.texcoords = &s->uv[0][0];
    state->material = rnd_one_in(6) ? NULL : &s->material;
    state->lighting.lights = s->lights;
    state->lighting.light_count = 2;
    state->lighting.ambient = map_color(0.3);
    state->lighting.model = (shade_model)(rnd_one_in(2) ? 0 : rnd_int(0, 5));
    state->lighting.terms = rnd_one_in(3) ? (unsigned)rnd_int(1, 15) : 0;
    state->shading = shading;
    state->diffuse_map = &s->map;
    state->transparency = rnd_one_in(2) ? 0 : rnd_float(0, 1);
}

static void close_map_scene(map_scene *s)
{
    free_texture(&s->map);
    free(s->memory);
}

static ref_lit map_light(const map_scene *s, d3 P, d3 N, d3 albedo, int *unsure)
{
    dmat inverse;
    dmat_invert(dmat_from(s->state.view), 4, &inverse);
    d3 eye = d3_of(inverse.m[0][3], inverse.m[1][3], inverse.m[2][3]);
    ref_lit lit = ref_light(&s->state.lighting, s->state.material, P, N, eye, albedo);
    *unsure |= lit.unsure;
    return lit;
}

static d3 mix3(const d3 v[3], const double b[3])
{
    return d3_add(d3_scale(v[0], b[0]), d3_add(d3_scale(v[1], b[1]), d3_scale(v[2], b[2])));
}

static d3 map_pixel(const map_scene *s, const double b[3], d3 texel, int *unsure)
{
    d3 P[3], N[3], C[3], matte[3], gloss[3];
    for (int k = 0; k < 3; k++) {
        P[k] = d3_from(s->position[k]);
        N[k] = d3_from(s->normal[k]);
        C[k] = s->mesh.colors ? d3_from(s->color[k]) : d3_of(1, 1, 1);
    }
    d3 face = d3_unit(d3_cross(d3_sub(P[1], P[0]), d3_sub(P[2], P[0])));
    if (!s->mesh.normals) N[0] = N[1] = N[2] = face;
    if (s->state.shading == SHADE_SHADING_PER_FRAGMENT) {
        return map_light(s, mix3(P, b), mix3(N, b), d3_mul(mix3(C, b), texel), unsure).total;
    }
    for (int k = 0; k < 3; k++) {
        static const double third[3] = { 1 / 3.0, 1 / 3.0, 1 / 3.0 };
        int flat = s->state.shading == SHADE_SHADING_PER_FACE;
        ref_lit l = map_light(s, flat ? mix3(P, third) : P[k], flat ? face : N[k],
                              flat ? C[0] : C[k], unsure);
        matte[k] = d3_add(l.ambient, l.diffuse);
        gloss[k] = d3_add(l.emission, l.specular);
    }
    return d3_add(d3_mul(mix3(matte, b), texel), mix3(gloss, b));
}

/* How far u, v and lod, 1e-5 off, move the texel; noise of the steps as in check_lod. */
static double map_texel(const map_scene *s, const ref_triangle *t, const double b[3], double X,
                        double Y, double c[4])
{
    lod_scene planes;
    double u = 0, v = 0, near_by[4], span, moved = 0, slack;
    for (int k = 0; k < 3; k++) {
        u += b[k] * (double)s->uv[k][0];
        v += b[k] * (double)s->uv[k][1];
        planes.attribute[k][0] = s->uv[k][0];
        planes.attribute[k][1] = s->uv[k][1];
    }
    planes.first = 0;
    lod_planes p = lod_planes_of(&planes, t);
    double lod = ref_lod(&p, X, Y, s->map.width, s->map.height, &slack);
    if (!s->map.mipmap_count) lod = 0;
    ref_sample(&s->map, u, v, lod, c, &span);
    for (int k = 0; k < 3; k++) {
        ref_sample(&s->map, u + (k == 0) * 1e-5, v + (k == 1) * 1e-5,
                   lod + (k == 2) * (1e-4 + 1e-5 * slack), near_by, &span);
        for (int n = 0; n < 4; n++) moved = fmax(moved, fabs(near_by[n] - c[n]));
    }
    return 3 * moved;
}

static void check_maps(shade_shading shading)
{
    static map_scene s;
    long checked = 0;
    for (int i = 0; i < 120; i++) {
        canvas c = canvas_ready(MAP_WIDTH, MAP_HEIGHT, 0, SHADE_FORMAT_RGBA32F, 0);
        ref_triangle t;
        shade_vec4 clip[3];
        random_map_scene(&s, shading);
        canvas_draw_mesh(&c, &s.mesh, &s.state);
        for (int k = 0; k < 3; k++) {
            clip[k] = shade_v4((float)s.snapped[k][0], (float)s.snapped[k][1],
                               (float)s.snapped[k][2], (float)s.snapped[k][3]);
        }
        CHECK(ref_triangle_of(&t, &clip[0], &clip[1], &clip[2], MAP_WIDTH, MAP_HEIGHT));
        for (int k = 0; k < MAP_WIDTH * MAP_HEIGHT; k++) {
            int x = k % MAP_WIDTH, y = k / MAP_WIDTH, unsure = 0;
            double X = x + 0.5, Y = y + 0.5, b[3];
            if (ref_covers(&t, X, Y, 0.01, 1, 0) != 1) continue;
            double texel[4];
            ref_barycentric(&t, X, Y, b);
            double moved = map_texel(&s, &t, b, X, Y, texel);
            d3 want = map_pixel(&s, b, d3_of(texel[0], texel[1], texel[2]), &unsure);
            if (unsure) continue;
            checked++;
            double within = 2e-4 + 4 * moved; /* light of up to 3, highlights of exponent 30 */
            CHECK_NEAR(canvas_float(&c, x, y, 0), want.x, within);
            CHECK_NEAR(canvas_float(&c, x, y, 1), want.y, within);
            CHECK_NEAR(canvas_float(&c, x, y, 2), want.z, within);
            CHECK_NEAR(canvas_float(&c, x, y, 3), (1 - (double)s.state.transparency) * texel[3],
                       within);
        }
        close_map_scene(&s);
        canvas_close(&c);
    }
    CHECK_SAY(checked > 5000, "%ld pixels", checked);
}

TEST(texture, a_map_multiplies_the_diffuse_and_ambient_terms_per_fragment)
{
    check_maps(SHADE_SHADING_PER_FRAGMENT);
}

TEST(texture, a_map_varies_per_pixel_under_gouraud_light) { check_maps(SHADE_SHADING_PER_VERTEX); }
TEST(texture, a_map_varies_per_pixel_on_flat_faces) { check_maps(SHADE_SHADING_PER_FACE); }

/* G2 */
TEST(texture, a_bad_map_is_refused_before_a_pixel_changes)
{
    static map_scene s;
    for (int k = 0; k < 3 * TEXTURE_FAULTS; k++) {
        canvas c = canvas_open(MAP_WIDTH, MAP_HEIGHT, 0, SHADE_FORMAT_RGBA8, 1);
        shade_stats stats;
        random_map_scene(&s, (shade_shading)(k % 3));
        shade_texture bad = s.map;
        spoil_texture(&bad, k / 3);
        if (bad.stride == 0 && bad.width == 1) bad.stride = -1; /* width - 1, but tight */
        s.state.diffuse_map = &bad;
        CHECK_INT(shade_draw_mesh(&c.target, &s.mesh, &s.state, &stats), SHADE_ERROR_TEXTURE);
        for (size_t i = 0; i < c.color_bytes; i++) CHECK(c.color[CANVAS_GUARD + i] == CANVAS_BYTE);
        for (size_t i = 0; i < c.depth_bytes; i++) CHECK(c.depth[CANVAS_GUARD + i] == CANVAS_BYTE);
        s.mesh.texcoords = NULL; /* then nobody looks at it */
        stats = canvas_draw_mesh(&c, &s.mesh, &s.state);
        close_map_scene(&s);
        canvas_close(&c);
    }
}

TEST(texture, a_map_without_texcoords_is_ignored)
{
    static map_scene s;
    for (int i = 0; i < 30; i++) {
        canvas c[2];
        canvas_twins(c, MAP_WIDTH, MAP_HEIGHT, SHADE_FORMAT_RGBA32F, 1);
        random_map_scene(&s, (shade_shading)(i % 3));
        s.mesh.texcoords = NULL;
        canvas_draw_mesh(&c[0], &s.mesh, &s.state);
        s.mesh.texcoords = &s.uv[0][0];
        s.state.diffuse_map = NULL;
        canvas_draw_mesh(&c[1], &s.mesh, &s.state);
        close_map_scene(&s);
        canvas_twins_close(c);
    }
}

/* Between the coordinates there is NaN, so that a wrong stride shows. */
TEST(texture, texcoords_of_any_stride_give_the_same_bits)
{
    static map_scene s;
    for (int i = 0; i < 30; i++) {
        canvas c[2];
        canvas_twins(c, MAP_WIDTH, MAP_HEIGHT, SHADE_FORMAT_RGBA32F, 1);
        float apart[3 * 5];
        random_map_scene(&s, (shade_shading)(i % 3));
        canvas_draw_mesh(&c[0], &s.mesh, &s.state);
        for (int k = 0; k < 15; k++) apart[k] = (float)NAN;
        for (int k = 0; k < 3; k++) memcpy(apart + 5 * k, s.uv[k], 8);
        s.mesh.texcoords = apart;
        s.mesh.texcoord_stride = 20;
        canvas_draw_mesh(&c[1], &s.mesh, &s.state);
        close_map_scene(&s);
        canvas_twins_close(c);
    }
}

TEST(texture, bad_texture_coordinates_draw_a_defined_texel)
{
    static map_scene s;
    for (int i = 0; i < 60; i++) {
        canvas c = canvas_ready(MAP_WIDTH, MAP_HEIGHT, 0, SHADE_FORMAT_RGBA8, 1);
        random_map_scene(&s, (shade_shading)(i % 3));
        for (int k = 0; k < 6; k++)
            if (rnd_one_in(2)) s.uv[k / 2][k % 2] = rnd_nasty();
        canvas_draw_mesh(&c, &s.mesh, &s.state);
        close_map_scene(&s);
        canvas_close(&c);
    }
}

/* --------------------------------------------------------------------------------- alpha alone */

static shade_texture random_alpha_texture(int most)
{
    shade_texture t = texture_of(rnd_int(1, most), rnd_int(1, most), SHADE_FORMAT_A8);
    t.wrap_u = (shade_wrap)rnd_int(0, 2);
    t.wrap_v = (shade_wrap)rnd_int(0, 2);
    t.filter = (shade_filter)rnd_int(0, 2);
    return t;
}

/* R, G and B are 1 to the bit, between texels and levels too, and nothing is decoded */
TEST(texture, a_texel_of_alpha_is_white_and_never_srgb)
{
    for (int i = 0; i < 300; i++) {
        shade_texture t = random_alpha_texture(30), levels[16];
        void *memory = add_mipmaps(&t, levels);
        for (int k = 0; k < 60; k++) {
            float u = random_coordinate(), v = random_coordinate(), lod = rnd_float(-1, 6);
            t.srgb = 0;
            shade_vec4 plain = shade_sample(&t, u, v, lod);
            t.srgb = 1;
            for (int n = 0; n < t.mipmap_count; n++) levels[n].srgb = 1;
            shade_vec4 c = shade_sample(&t, u, v, lod);
            CHECK(c.x == 1 && c.y == 1 && c.z == 1);
            CHECK(float_bits(c.w) == float_bits(plain.w));
        }
        free(memory);
        free_texture(&t);
    }
}

/* One byte a texel, level behind level, each the mean of the areas it covers. */
TEST(texture, mipmaps_of_alpha_are_means_in_one_byte_a_texel)
{
    for (int i = 0; i < 60; i++) {
        int log_w = rnd_int(0, 5), log_h = rnd_int(0, 5);
        shade_texture t = texture_of(1 << log_w, 1 << log_h, SHADE_FORMAT_A8), levels[16];
        t.srgb = i % 2; /* changes nothing */
        unsigned char *at = (unsigned char *)add_mipmaps(&t, levels), *memory = at;
        for (int n = 0; n < log_w || n < log_h; n++)
            CHECK_INT(levels[n].format, SHADE_FORMAT_A8);
        for (int n = 0; n < log_w && n < log_h; n++) {
            const shade_texture *level = &levels[n], *above = n ? &levels[n - 1] : &t;
            const unsigned char *from = (const unsigned char *)above->pixels;
            CHECK(level->pixels == at);
            for (int k = 0; k < level->width * level->height; k++) {
                const unsigned char *p = from + 2 * (k % level->width);
                p += 2 * (size_t)(k / level->width) * texture_stride(above);
                double mean = (p[0] + p[1] + p[texture_stride(above)]) / 4.0;
                mean += p[texture_stride(above) + 1] / 4.0;
                CHECK_SAY(fabs((double)at[k] - mean) <= 0.5 + 1e-4, "%d of mean %g", at[k], mean);
            }
            at += level->width * level->height;
        }
        free(memory);
        free_texture(&t);
    }
}

/* A mask: light is untouched, alpha is the byte's, cut and blended as any map's. */
TEST(texture, a_map_of_alpha_masks_what_is_lit)
{
    static const float square[] = { -1, -1, 0, 1, -1, 0, 1, 1, 0, -1, -1, 0, 1, 1, 0, -1, 1, 0 };
    static const float uv[] = { 0, 1, 1, 1, 1, 0, 0, 1, 1, 0, 0, 0 };
    shade_texture map = texture_of(16, 12, SHADE_FORMAT_A8);
    const unsigned char *texel = (const unsigned char *)map.pixels;
    map.filter = SHADE_FILTER_NEAREST;
    for (int i = 0; i < 36 && SHADE_MAX_VARYINGS >= 8; i++) {
        canvas c = canvas_open(16, 12, 0, SHADE_FORMAT_RGBA32F, 1);
        shade_mesh m = plain_mesh(square, 6);
        shade_draw_state s = plain_state(NULL);
        m.texcoords = uv;
        s.shading = (shade_shading)(i % 3);
        s.diffuse_map = &map;
        s.lighting.ambient = grey(0.75);
        s.raster.blend = i / 3 % 2 ? SHADE_BLEND_OVER : SHADE_BLEND_REPLACE;
        s.alpha_cutoff = i / 6 % 2 ? 0.5f : 0;
        s.transparency = (float)(i / 12) * 0.25f;
        CHECK_INT(shade_clear(&c.target, shade_v4(0.25f, 0.25f, 0.25f, 0.5f), 1), SHADE_OK);
        canvas_draw_mesh(&c, &m, &s);
        for (int k = 0; k < 16 * 12; k++) {
            int x = k % 16, y = k / 16;
            double a = texel[(size_t)y * texture_stride(&map) + (size_t)x] / 255.0;
            a *= 1 - (double)s.transparency;
            int seen = a >= (double)s.alpha_cutoff, over = s.raster.blend == SHADE_BLEND_OVER;
            double want = over ? 0.75 * a + 0.25 * (1 - a) : 0.75;
            double alpha = over ? a + 0.5 * (1 - a) : a;
            CHECK_NEAR(canvas_float(&c, x, y, 1), seen ? want : 0.25, 1e-6);
            CHECK_NEAR(canvas_float(&c, x, y, 3), seen ? alpha : 0.5, 1e-6);
        }
        canvas_close(&c);
    }
    CHECK(texel != NULL);
    free_texture(&map);
}

/* P and N of a mesh are left out where no lamp reads them, in draws of a picture and of depth
   alone; a black lamp keeps them.  Alpha is cut, so that maps decide about depth as well. */
TEST(texture, without_lamps_a_mesh_has_the_bits_of_one_under_a_black_lamp)
{
    static test_mesh m;
    static float uv[MESH_VERTICES][2];
    const shade_light black = shade_point_light(shade_v3(1, 2, 3), shade_v3(0, 0, 0));
    long fragments = 0, mapped = 0;
    for (int i = 0; i < 120; i++) {
        shade_format format = rnd_format();
        canvas a = canvas_open(64, 48, 0, format, 1), b = canvas_open(64, 48, 0, format, 1);
        shade_texture levels[8], map = random_texture(30);
        shade_stats first, second;
        shade_shading shading = i % 3 ? SHADE_SHADING_PER_FRAGMENT : (shade_shading)rnd_int(1, 2);
        random_mesh_scene(&m, shading, 0);
        for (int k = 0; k < 2 * MESH_VERTICES; k++) uv[k / 2][k % 2] = rnd_float(-2, 2);
        map.filter = (shade_filter)rnd_int(0, 2);
        void *memory = add_mipmaps(&map, levels);
        m.mesh.texcoords = rnd_one_in(4) ? NULL : uv[0];
        m.state.diffuse_map = rnd_one_in(4) ? NULL : &map;
        m.state.alpha_cutoff = rnd_one_in(2) ? 0 : rnd_float(0, 0.5);
        m.state.raster.blend = (shade_blend)rnd_int(0, SHADE_BLEND_ADD);
        /* cool to warm reads L of a black lamp too */
        if (m.state.lighting.model == SHADE_MODEL_COOL_TO_WARM)
            m.state.lighting.model = SHADE_MODEL_PHONG;
        if (rnd_one_in(4)) a.target.color = b.target.color = NULL;
        canvas_clear(&a, 1);
        canvas_clear(&b, 1);

        m.state.lighting.light_count = 0;
        shade_result result = shade_draw_mesh(&a.target, &m.mesh, &m.state, &first);
        m.state.lighting.lights = &black;
        m.state.lighting.light_count = 1;
        CHECK_INT(shade_draw_mesh(&b.target, &m.mesh, &m.state, &second), result);
        CHECK_SAY(canvas_same(&a, &b), "scene %d, format %d", i, (int)format);
        CHECK(!memcmp(&first, &second, sizeof first));
        fragments += (long)first.fragments;
        mapped += m.mesh.texcoords && m.state.diffuse_map && first.fragments > 0;
        free(memory);
        free_texture(&map);
        canvas_close(&a);
        canvas_close(&b);
    }
    if (SHADE_MAX_VARYINGS >= 11)
        CHECK_SAY(fragments > 20000 && mapped > 20, "%ld, %ld maps", fragments, mapped);
}
