/* resolve.c - supersampled pictures brought down, formats converted, and pictures drawn in strips.
   */
#include "unit.h"

static void resolve_fill(canvas *c)
{
    unsigned char *p = c->color + CANVAS_GUARD;
    if (c->target.format != SHADE_FORMAT_RGBA32F) {
        for (size_t i = 0; i < c->color_bytes; i++) p[i] = (unsigned char)rnd_bits();
        return;
    }
    for (size_t i = 0; i < c->color_bytes; i += 4) {
        float f = rnd_float(-0.5, 2);
        memcpy(p + i, &f, 4);
    }
}

/* The padding of what is read may hold anything. */
static void resolve_close(canvas *c)
{
    free(c->color);
    free(c->depth);
}

static void check_resolved(const canvas *out, const canvas *in, int factor, int x, int y)
{
    const shade_format format = out->target.format;
    double mean[4] = { 0, 0, 0, 0 };
    for (int n = 0; n < factor * factor; n++) {
        double c[4];
        ref_pixel(in->target.format, in->target.srgb,
                  canvas_pixel(in, x * factor + n % factor, y * factor + n / factor), c);
        for (int k = 0; k < 4; k++) mean[k] += c[k] / (factor * factor);
    }
    for (int k = 0; k < 4; k++) {
        double want = mean[k];
        if (format == SHADE_FORMAT_RGBA32F) {
            /* float sums of up to 64, of texels that may come through the library's sRGB curve */
            CHECK_NEAR(canvas_float(out, x, y, k), want, 5e-6);
            continue;
        }
        if (out->target.srgb && k < 3) want = ref_encode_srgb(want);
        want = fmax(0, fmin(1, want)) * canvas_most(format, k);
        /* to nearest, where the sRGB curve steepens its argument's error; dithered: to either */
        int either = out->target.dither && canvas_pixel_bytes(format) == 2;
        CHECK_NEAR(canvas_code(out, x, y, k), want, either ? 1 : 0.51);
    }
}

/* Random pictures, strips and clip rectangles. */
static void check_resolve(int factor, shade_format to, shade_format from)
{
    int w = rnd_int(1, 25), h = rnd_int(1, 12), rows = rnd_one_in(3) ? rnd_int(1, h) : 0;
    int top = rows ? rnd_int(0, h - rows) : 0, x0, y0, x1, y1;
    canvas in = canvas_strip(w * factor, h * factor, rnd_one_in(2) ? 0 : w * factor + 5, from,
                             rnd_one_in(2), top * factor, rows * factor);
    canvas out =
        canvas_strip(w, h, rnd_one_in(2) ? 0 : w + rnd_int(0, 9), to, rnd_one_in(2), top, rows);
    in.target.srgb = rnd_one_in(2);
    out.target.srgb = rnd_one_in(2);
    in.target.dither = rnd_one_in(2);
    out.target.dither = rnd_one_in(3);
    resolve_fill(&in);
    if (rnd_one_in(2)) random_clip(&out.target);
    clip_bounds(&out.target, &x0, &y0, &x1, &y1);
    CHECK_INT(shade_resolve(&out.target, &in.target, factor), SHADE_OK);
    for (int k = 0; k < w * canvas_rows(&out); k++) {
        int x = k % w, y = top + k / w;
        const unsigned char *p = canvas_pixel(&out, x, y);
        if (x >= x0 && x < x1 && y >= y0 && y < y1)
            check_resolved(&out, &in, factor, x, y);
        else
            for (size_t n = 0; n < canvas_pixel_bytes(to); n++) CHECK(p[n] == CANVAS_BYTE);
    }
    for (size_t k = 0; k < out.depth_bytes; k++)
        CHECK(out.depth[CANVAS_GUARD + k] == CANVAS_BYTE); /* depth is left alone */
    resolve_close(&in);
    canvas_close(&out);
}

TEST(resolve, pixels_are_means_in_linear_light)
{
    for (int i = 0; i < 700; i++) check_resolve(2 + i % 7, rnd_format(), rnd_format());
}

TEST(resolve, one_colour_stays_itself)
{
    for (int i = 0; i < 300; i++) {
        int factor = 2 + i % 7;
        shade_format format = rnd_format();
        canvas in = canvas_open(3 * factor, 2 * factor, 0, format, 0);
        canvas out = canvas_open(3, 2, 0, format, 0);
        in.target.srgb = out.target.srgb = rnd_one_in(2);
        size_t size = canvas_pixel_bytes(format);
        resolve_fill(&in);
        for (size_t k = size; k < in.color_bytes; k++)
            in.color[CANVAS_GUARD + k] = in.color[CANVAS_GUARD + k - size];
        CHECK_INT(shade_resolve(&out.target, &in.target, factor), SHADE_OK);
        for (size_t k = 0; k < out.color_bytes && format != SHADE_FORMAT_RGBA32F; k++)
            CHECK(out.color[CANVAS_GUARD + k] == in.color[CANVAS_GUARD + k % size]);
        for (int k = 0; k < 4 && format == SHADE_FORMAT_RGBA32F; k++)
            CHECK_NEAR(canvas_float(&out, 2, 1, k), canvas_float(&in, 0, 0, k), 5e-6);
        resolve_close(&in);
        canvas_close(&out);
    }
}

/* G1 */
TEST(resolve, only_the_clip_rectangle_of_out_is_written)
{
    for (int i = 0; i < 300; i++) {
        int factor = rnd_int(2, 4), w = rnd_int(1, 30), h = rnd_int(1, 12);
        shade_format format = rnd_format();
        canvas in = canvas_open(w * factor, h * factor, 0, SHADE_FORMAT_RGBA8, 0);
        canvas out = canvas_open(w, h, w + 2, format, 0);
        canvas whole = canvas_open(w, h, w + 2, format, 0);
        resolve_fill(&in);
        int x = rnd_int(-5, w + 3), y = rnd_int(-5, h + 3), cw = rnd_int(0, w + 8);
        int ch = rnd_int(0, h + 8);
        out.target.clip_x = x;
        out.target.clip_y = y;
        out.target.clip_width = cw;
        out.target.clip_height = ch;
        if (!(x || y || cw || ch)) { /* all zero: the whole picture */
            cw = w;
            ch = h;
        }
        /* the source's own clip rectangle has no effect */
        in.target.clip_x = 1;
        in.target.clip_width = 1;
        CHECK_INT(shade_resolve(&out.target, &in.target, factor), SHADE_OK);
        CHECK_INT(shade_resolve(&whole.target, &in.target, factor), SHADE_OK);
        size_t size = canvas_pixel_bytes(format);
        for (int k = 0; k < w * h; k++) {
            int px = k % w, py = k / w;
            int written = px >= x && px < x + cw && py >= y && py < y + ch;
            const unsigned char *at = canvas_pixel(&out, px, py);
            const unsigned char *full = canvas_pixel(&whole, px, py);
            for (size_t n = 0; n < size; n++) CHECK(at[n] == (written ? full[n] : CANVAS_BYTE));
        }
        resolve_close(&in);
        canvas_close(&out);
        canvas_close(&whole);
    }
}

/* G13 */
TEST(resolve, strips_give_the_bits_of_the_whole)
{
    for (int i = 0; i < 100; i++) {
        int factor = rnd_int(2, 5), w = rnd_int(1, 30), h = rnd_int(2, 20), rows;
        shade_format format = rnd_format();
        canvas in = canvas_open(w * factor, h * factor, 0, rnd_format(), 0);
        canvas whole = canvas_open(w, h, 0, format, 0);
        size_t in_row = (size_t)(w * factor) * canvas_pixel_bytes(in.target.format);
        size_t out_row = (size_t)w * canvas_pixel_bytes(format);
        resolve_fill(&in);
        in.target.srgb = rnd_one_in(2);
        whole.target.srgb = rnd_one_in(2);
        whole.target.dither = 1; /* its pattern follows the picture, not the strip */
        CHECK_INT(shade_resolve(&whole.target, &in.target, factor), SHADE_OK);
        for (int y = 0; y < h; y += rows) {
            rows = rnd_int(1, h - y);
            canvas strip = canvas_strip(w, h, 0, format, 0, y, rows);
            shade_target part = in.target;
            strip.target.srgb = whole.target.srgb;
            strip.target.dither = 1;
            part.row_offset = y * factor;
            part.row_count = rows * factor;
            part.color = in.color + CANVAS_GUARD + in_row * (size_t)(y * factor);
            CHECK_INT(shade_resolve(&strip.target, &part, factor), SHADE_OK);
            CHECK(!memcmp(strip.color + CANVAS_GUARD,
                          whole.color + CANVAS_GUARD + out_row * (size_t)y,
                          out_row * (size_t)rows));
            canvas_close(&strip);
        }
        resolve_close(&in);
        canvas_close(&whole);
    }
}

TEST(resolve, nan_and_infinity_store_as_they_do_elsewhere)
{
    for (int i = 0; i < 2 * SHADE_FORMAT_RGBA32F; i++) {
        const int factor = 1 + i % 2;
        shade_format format = (shade_format)(i / 2);
        canvas in = canvas_open(4, 2, 0, SHADE_FORMAT_RGBA32F, 0);
        canvas out = canvas_open(4 / factor, 2 / factor, 0, format, 0);
        float f[32];
        for (int k = 0; k < 32; k++) f[k] = 0.5f;
        f[0] = (float)NAN;
        f[8] = INFINITY;
        f[9] = -INFINITY;
        memcpy(in.color + CANVAS_GUARD, f, sizeof f);
        CHECK_INT(shade_resolve(&out.target, &in.target, factor), SHADE_OK);
        CHECK_INT(canvas_code(&out, 0, 0, 0), 0);
        CHECK_INT(canvas_code(&out, 0, 0, 1), (canvas_most(format, 1) + 1) / 2);
        CHECK_INT(canvas_code(&out, 2 / factor, 0, 0), canvas_most(format, 0));
        CHECK_INT(canvas_code(&out, 2 / factor, 0, 1), 0);
        CHECK_INT(canvas_code(&out, 2 / factor, 0, 2), (canvas_most(format, 2) + 1) / 2);
        canvas_close(&in);
        canvas_close(&out);
    }
}

/* ----------------------------------------------------------------------------------- conversion */

TEST(resolve, factor_one_converts_between_all_formats)
{
    for (int i = 0; i < 20 * CANVAS_FORMATS * CANVAS_FORMATS; i++)
        check_resolve(1, (shade_format)(i % CANVAS_FORMATS),
                      (shade_format)(i / CANVAS_FORMATS % CANVAS_FORMATS));
}

/* every code in every channel, beside any others */
TEST(resolve, codes_come_back_from_formats_that_hold_them)
{
    for (int i = 0; i < 4 * CANVAS_FORMATS * CANVAS_FORMATS; i++) {
        shade_format first = (shade_format)(i / 4 % CANVAS_FORMATS);
        shade_format second = (shade_format)(i / 4 / CANVAS_FORMATS);
        const int held = canvas_pixel_bytes(second) >= canvas_pixel_bytes(first);
        if (!held || first == SHADE_FORMAT_RGBA32F) continue;
        canvas a = canvas_open(256, 9, 0, first, 0), b = canvas_open(256, 9, 0, second, 0);
        canvas back = canvas_open(256, 9, 0, first, 0);
        a.target.srgb = b.target.srgb = back.target.srgb = i & 1;
        back.target.dither = i & 2 && canvas_pixel_bytes(second) != 4; /* which 8 bits may tip */
        resolve_fill(&a);
        for (int k = 0; k < 256; k++) memset(canvas_pixel(&a, k, 8), k, canvas_pixel_bytes(first));
        CHECK_INT(shade_resolve(&b.target, &a.target, 1), SHADE_OK);
        CHECK_INT(shade_resolve(&back.target, &b.target, 1), SHADE_OK);
        CHECK_SAY(canvas_same(&a, &back), "format %d by %d, sRGB %d, dither %d", (int)first,
                  (int)second, i & 1, back.target.dither);
        canvas_close(&a);
        canvas_close(&b);
        canvas_close(&back);
    }
}

TEST(resolve, bytes_change_places_between_rgba8_and_bgra8)
{
    for (int srgb = 0; srgb < 2; srgb++) {
        canvas a = canvas_open(256, 256, 0, SHADE_FORMAT_RGBA8, 0);
        canvas b = canvas_open(256, 256, 0, SHADE_FORMAT_BGRA8, 0);
        a.target.srgb = b.target.srgb = srgb;
        for (int k = 0; k < 256 * 256; k++) {
            unsigned char *p = canvas_pixel(&a, k % 256, k / 256);
            p[0] = (unsigned char)k;
            p[1] = (unsigned char)(k / 256);
            p[2] = (unsigned char)(k * 7);
            p[3] = (unsigned char)(k / 256 + k);
        }
        CHECK_INT(shade_resolve(&b.target, &a.target, 1), SHADE_OK);
        for (int k = 0; k < 256 * 256; k++) {
            const unsigned char *p = canvas_bytes(&a, k % 256, k / 256);
            const unsigned char *q = canvas_bytes(&b, k % 256, k / 256);
            CHECK(q[0] == p[2] && q[1] == p[1] && q[2] == p[0] && q[3] == p[3]);
        }
        canvas_close(&a);
        canvas_close(&b);
    }
}

TEST(resolve, floats_stay_what_they_are)
{
    canvas in = canvas_open(40, 30, 0, SHADE_FORMAT_RGBA32F, 0);
    canvas out = canvas_open(40, 30, 0, SHADE_FORMAT_RGBA32F, 0);
    for (int k = 0; k < 4 * 40 * 30; k++) {
        float f = rnd_one_in(3) ? rnd_nasty() : rnd_sign() * rnd_log(1e-30, 1e30);
        memcpy(in.color + CANVAS_GUARD + 4 * k, &f, 4);
    }
    in.target.srgb = 1; /* without effect on floats */
    CHECK_INT(shade_resolve(&out.target, &in.target, 1), SHADE_OK);
    for (int k = 0; k < 4 * 40 * 30; k++) {
        float want = canvas_float(&in, k / 4 % 40, k / 160, k % 4);
        float got = canvas_float(&out, k / 4 % 40, k / 160, k % 4);
        CHECK_SAY(isnan(want) ? isnan(got) : got >= want && got <= want, "got %a, want %a",
                  (double)got, (double)want);
    }
    canvas_close(&in);
    canvas_close(&out);
}

/* Two targets of one memory, rows of one stride: what two memories give. */
TEST(resolve, pixels_of_one_size_are_converted_in_place)
{
    for (int i = 0; i < 20 * CANVAS_FORMATS * CANVAS_FORMATS; i++) {
        shade_format from = (shade_format)(i % CANVAS_FORMATS);
        shade_format to = (shade_format)(i / CANVAS_FORMATS % CANVAS_FORMATS);
        if (canvas_pixel_bytes(from) != canvas_pixel_bytes(to)) continue;
        int w = rnd_int(1, 40), h = rnd_int(1, 10), stride = rnd_one_in(2) ? 0 : w + rnd_int(0, 5);
        canvas in = canvas_open(w, h, stride, from, 0), out = canvas_open(w, h, stride, to, 0);
        resolve_fill(&in);
        in.target.srgb = rnd_one_in(2);
        out.target.srgb = rnd_one_in(2);
        out.target.dither = rnd_one_in(2);
        if (rnd_one_in(2)) random_clip(&out.target);
        memcpy(out.color, in.color, in.color_bytes + 2 * CANVAS_GUARD);
        CHECK_INT(shade_resolve(&out.target, &in.target, 1), SHADE_OK);
        shade_target place = out.target;
        place.color = in.target.color;
        CHECK_INT(shade_resolve(&place, &in.target, 1), SHADE_OK);
        CHECK(!memcmp(in.color, out.color, in.color_bytes + 2 * CANVAS_GUARD));
        resolve_close(&in);
        resolve_close(&out);
    }
}

/* The target itself: nothing changes, with sRGB or without. */
TEST(resolve, a_picture_resolved_into_itself_stays)
{
    for (int i = 0; i < 4 * CANVAS_FORMATS; i++) {
        shade_format format = (shade_format)(i / 4);
        canvas c = canvas_open(37, 11, 0, format, 0), before = canvas_open(37, 11, 0, format, 0);
        c.target.srgb = i & 1;
        c.target.dither = i >> 1 & 1;
        resolve_fill(&c);
        memcpy(before.color, c.color, c.color_bytes + 2 * CANVAS_GUARD);
        CHECK_INT(shade_resolve(&c.target, &c.target, 1), SHADE_OK);
        CHECK_SAY(canvas_same(&c, &before), "format %d", (int)format);
        canvas_close(&c);
        canvas_close(&before);
    }
}

/* What shade_resolve is given, to be spoilt. */
typedef struct resolve_call {
    const shade_target *target, *source;
    int factor;
    shade_target to, from;
} resolve_call;

/* Two pictures of 24 x 18 pixels: in pairs of strips that do not match, conversion is refused. */
#define TO(field, value) FAULT(resolve_call, to.field, value)
#define FROM(field, value) FAULT(resolve_call, from.field, value)
static const refusal conversions[] = {
    { SHADE_ERROR_ARGUMENT, { TO(width, 23), TO(stride, 24) } },
    { SHADE_ERROR_ARGUMENT, { FROM(width, 23), FROM(stride, 24) } },
    { SHADE_ERROR_ARGUMENT, { TO(height, 17) } },
    { SHADE_ERROR_ARGUMENT, { FROM(height, 17) } },
    { SHADE_ERROR_ARGUMENT, { TO(row_offset, 3), TO(row_count, 6) } },
    { SHADE_ERROR_ARGUMENT, { FROM(row_offset, 3), FROM(row_count, 6) } },
    { SHADE_ERROR_ARGUMENT, { TO(row_offset, 3), TO(row_count, 6), FROM(row_count, 6) } },
    { SHADE_ERROR_ARGUMENT,
      { TO(row_offset, 3), FROM(row_offset, 3), TO(row_count, 6), FROM(row_count, 7) } },
    { SHADE_ERROR_ARGUMENT, { TO(height, 6), FROM(height, 6), FROM(row_count, 5) } },
    { SHADE_ERROR_ARGUMENT, { TO(height, 17), TO(row_count, 6), FROM(row_count, 6) } },
    { SHADE_OK, { TO(row_offset, 3), FROM(row_offset, 3), TO(row_count, 6), FROM(row_count, 6) } },
    { SHADE_OK, { TO(row_count, 18) } }, /* all rows */
    { SHADE_OK, { TO(stride, 24), TO(height, 9), FROM(height, 9) } },
};

TEST(resolve, conversion_is_refused_where_sizes_or_strips_differ)
{
    for (int row = 0; row < TEST_COUNT(conversions); row++) {
        const shade_result want = conversions[row].want;
        canvas in = canvas_open(24, 18, 0, SHADE_FORMAT_RGBA8, 0);
        canvas out = canvas_open(24, 18, 0, SHADE_FORMAT_BGRA8, 0);
        resolve_call c = { NULL, NULL, 1, out.target, in.target };
        memset(in.color + CANVAS_GUARD, 1, in.color_bytes);
        spoil(&c, conversions[row].faults);
        check_refusal(row, shade_resolve(&c.to, &c.from, c.factor), want);
        CHECK_INT(out.color[CANVAS_GUARD], want == SHADE_OK ? 1 : CANVAS_BYTE);
        if (want) CHECK_SAY(canvas_untouched(&out), "row %d", row);
        canvas_close(&in);
        canvas_close(&out);
    }
}

/* ------------------------------------------------------------------------------------ arguments */

/* A picture of 24 x 18 pixels becomes one of 8 x 6, by a factor of 3. */
static const refusal bad_resolves[] = {
    { SHADE_ERROR_ARGUMENT, { FAULT_NULL(resolve_call, target) } },
    { SHADE_ERROR_ARGUMENT, { FAULT_NULL(resolve_call, source) } },
    { SHADE_ERROR_ARGUMENT, { FAULT(resolve_call, factor, 2) } },
    { SHADE_ERROR_ARGUMENT, { FAULT(resolve_call, factor, 1) } },
    { SHADE_ERROR_ARGUMENT, { FAULT(resolve_call, factor, 0) } },
    { SHADE_ERROR_ARGUMENT, { FAULT(resolve_call, factor, -3) } },
    { SHADE_ERROR_ARGUMENT, { FAULT(resolve_call, factor, 9) } },
    { SHADE_ERROR_ARGUMENT, { FAULT(resolve_call, factor, INT_MAX) } },
    { SHADE_ERROR_ARGUMENT, { FROM(width, 23), FROM(stride, 24) } },
    { SHADE_ERROR_ARGUMENT, { FROM(height, 17) } },
    { SHADE_ERROR_ARGUMENT, { FROM(height, 21), TO(row_count, 4), FROM(row_count, 12) } },
    { SHADE_ERROR_ARGUMENT, { TO(row_offset, 1), TO(row_count, 5) } },
    { SHADE_ERROR_ARGUMENT, { FROM(row_offset, 3), FROM(row_count, 15) } },
    { SHADE_ERROR_ARGUMENT,
      { TO(row_offset, 2), TO(row_count, 4), FROM(row_offset, 3), FROM(row_count, 12) } },
    { SHADE_ERROR_ARGUMENT,
      { TO(row_offset, 2), TO(row_count, 3), FROM(row_offset, 6), FROM(row_count, 12) } },
    { SHADE_ERROR_TARGET, { FAULT_NULL(resolve_call, to.color) } },
    { SHADE_ERROR_TARGET, { FAULT_NULL(resolve_call, from.color) } },
    { SHADE_ERROR_TARGET, { TO(width, 0) } },
    { SHADE_ERROR_TARGET, { TO(clip_width, -1) } },
    { SHADE_ERROR_TARGET, { TO(format, CANVAS_FORMATS) } },
    { SHADE_ERROR_TARGET, { FROM(format, -1) } },
    { SHADE_ERROR_TARGET, { FROM(stride, 5) } },
};

/* G2 */
TEST(resolve, what_does_not_fit_is_refused_before_a_pixel_changes)
{
    canvas in = canvas_open(24, 18, 0, SHADE_FORMAT_RGBA8, 1);
    canvas out = canvas_open(8, 6, 0, SHADE_FORMAT_RGBA8, 1);
    for (int row = 0; row < TEST_COUNT(bad_resolves); row++) {
        resolve_call c = { NULL, NULL, 3, out.target, in.target };
        c.target = &c.to;
        c.source = &c.from;
        spoil(&c, bad_resolves[row].faults);
        check_refusal(row, shade_resolve(c.target, c.source, c.factor), bad_resolves[row].want);
        CHECK_SAY(canvas_untouched(&out), "row %d", row);
    }
    canvas_close(&in);
    canvas_close(&out);
}

TEST(resolve, factors_of_one_to_eight_are_taken)
{
    for (int factor = -1; factor <= 10; factor++) {
        int times = factor > 0 ? factor : 1;
        canvas in = canvas_open(5 * times, 3 * times, 0, SHADE_FORMAT_RGBA8, 0);
        canvas out = canvas_open(5, 3, 0, SHADE_FORMAT_RGBA8, 0);
        CHECK_INT(shade_resolve(&out.target, &in.target, factor),
                  factor >= 1 && factor <= 8 ? SHADE_OK : SHADE_ERROR_ARGUMENT);
        canvas_close(&in);
        canvas_close(&out);
    }
}

/* ------------------------------------------------------------------------------- supersampling */

/* The edge of a half plane drawn at 4 x 4 comes out as the covered share of each pixel. */
TEST(resolve, supersampled_edges_are_shares_of_sixteenths)
{
    canvas in = canvas_ready(64, 64, 0, SHADE_FORMAT_RGBA8, 0);
    canvas out = canvas_open(16, 16, 0, SHADE_FORMAT_RGBA8, 0);
    shade_vec4 clip[3] = { { -1, -1, 0, 1 }, { 1, -1, 0, 1 }, { -1, 1, 0, 1 } };
    scene s = { clip, NULL, 0, NULL, NULL };
    shade_pipeline p = scene_pipeline(&s);
    canvas_draw(&in, &p, 3);
    CHECK_INT(shade_resolve(&out.target, &in.target, 4), SHADE_OK);
    for (int k = 0; k < 16 * 16; k++) {
        int covered = 0;
        for (int n = 0; n < 16; n++)
            covered += canvas_bytes(&in, 4 * (k % 16) + n % 4, 4 * (k / 16) + n / 4)[0] != 0;
        CHECK_INT(canvas_bytes(&out, k % 16, k / 16)[0], (covered * 255 + 8) / 16);
        if (k % 16 != k / 16) CHECK(covered == 0 || covered == 16);
        else CHECK(covered == 6 || covered == 10);
    }
    canvas_close(&in);
    canvas_close(&out);
}

/* -------------------------------------------------------------------------------------- strips */

typedef struct strip_scene {
    shade_vec3 position[90], normal[90], line[20];
    float uv[90][2];
    unsigned char texels[16 * 16 * 4];
    shade_texture map;
    shade_light light;
    shade_mesh mesh;
    shade_draw_state state;
    shade_line_state lines;
} strip_scene;

static void random_strip_scene(strip_scene *s)
{
    memset(s, 0, sizeof *s);
    for (int k = 0; k < 90; k++) {
        s->position[k] = shade_v3(rnd_float(-2, 2), rnd_float(-1.5, 1.5), rnd_float(-1.5, 2));
        s->normal[k] = d3_round(rnd_direction());
        s->uv[k][0] = rnd_float(-1, 2);
        s->uv[k][1] = rnd_float(-1, 2);
    }
    for (int k = 0; k < 20; k++)
        s->line[k] = shade_v3(rnd_float(-2, 2), rnd_float(-2, 2), rnd_float(-2, 4));
    for (size_t k = 0; k < sizeof s->texels; k++) s->texels[k] = (unsigned char)rnd_bits();
    s->map.pixels = s->texels;
    s->map.width = s->map.height = 16;
    s->light = shade_directional_light(shade_v3(-1, -1, -1), shade_v3(1, 0.9f, 0.8f));
    s->mesh.positions = &s->position[0].x;
    s->mesh.normals = &s->normal[0].x;
    s->mesh.texcoords = &s->uv[0][0];
    s->mesh.vertex_count = 90;
    s->state.view =
        shade_mat4_look_at(shade_v3(0, 0.5f, 3), shade_v3(0, 0, 0), shade_v3(0, 1, 0));
    s->state.projection = shade_mat4_perspective(1, 4.0f / 3, 0.5f, 10);
    s->state.lighting.lights = &s->light;
    s->state.lighting.light_count = 1;
    s->state.lighting.flags = SHADE_FLAG_TWO_SIDED;
    s->state.lighting.ambient = shade_v3(0.2f, 0.2f, 0.2f);
    s->state.diffuse_map = &s->map;
    s->state.shading = (shade_shading)rnd_int(0, 2);
    s->lines.clip_from_points = shade_mat4_mul(s->state.projection, s->state.view);
    s->lines.width = 2.5f;
    s->lines.color = shade_v4(0.3f, 0.6f, 0.9f, 0.5f);
    s->lines.raster.blend = SHADE_BLEND_OVER;
}

static void strip_draw(const strip_scene *s, const shade_target *t)
{
    CHECK_INT(shade_clear(t, shade_v4(0.1f, 0.15f, 0.3f, 1), 1), SHADE_OK);
    CHECK_INT(shade_draw_mesh(t, &s->mesh, &s->state, NULL), SHADE_OK);
    CHECK_INT(shade_draw_lines(t, s->line, 20, &s->lines, NULL), SHADE_OK);
}

/* 320 x 240 in strips of at most 10 rows: 6.4 kB of colour and 12.8 kB of depth at a time */
/* G13 */
TEST(resolve, a_small_machine_s_strips_are_the_whole_picture_bit_for_bit)
{
    static strip_scene s;
    for (int i = 0; i < 6; i++) {
        shade_format format = i % 4 < 2 ? SHADE_FORMAT_RGB565 : SHADE_FORMAT_RGB565_SWAPPED;
        canvas whole = canvas_open(320, 240, 0, format, 1);
        int rows;
        random_strip_scene(&s);
        whole.target.dither = 1;
        whole.target.srgb = i & 1;
        strip_draw(&s, &whole.target);
        for (int y = 0; y < 240; y += rows) {
            rows = i < 3 ? 10 : rnd_int(1, 10);
            if (rows > 240 - y) rows = 240 - y;
            canvas strip = canvas_strip(320, 240, 0, format, 1, y, rows);
            strip.target.dither = 1;
            strip.target.srgb = i & 1;
            strip_draw(&s, &strip.target);
            CHECK_SAY(!memcmp(strip.color + CANVAS_GUARD, whole.color + CANVAS_GUARD + 640 * y,
                              640 * (size_t)rows),
                      "colours of rows %d to %d", y, y + rows - 1);
            CHECK_SAY(!memcmp(strip.depth + CANVAS_GUARD, whole.depth + CANVAS_GUARD + 1280 * y,
                              1280 * (size_t)rows),
                      "depths of rows %d to %d", y, y + rows - 1);
            canvas_close(&strip);
        }
        canvas_close(&whole);
    }
}
