/* resolve.c - supersampled pictures brought down, and pictures drawn in strips. */

/* A stored pixel in linear light. */
static void ref_linear(const canvas *c, int x, int y, double rgba[4])
{
    const shade_target *t = &c->target;
    if (t->format == SHADE_FORMAT_RGBA32F) {
        for (int k = 0; k < 4; k++) rgba[k] = (double)canvas_float(c, x, y, k);
        return;
    }
    if (t->format == SHADE_FORMAT_RGBA8) {
        for (int k = 0; k < 4; k++) rgba[k] = canvas_bytes(c, x, y)[k] / 255.0;
    } else {
        unsigned u = canvas_565(c, x, y);
        rgba[0] = (u >> 11) / 31.0, rgba[1] = (u >> 5 & 63) / 63.0, rgba[2] = (u & 31) / 31.0;
        rgba[3] = 1;
    }
    for (int k = 0; k < 3 && t->srgb; k++) rgba[k] = ref_decode_srgb(rgba[k]);
}
static void resolve_fill(canvas *c)
{
    for (size_t i = 0; i < c->color_bytes; i++) {
        if (c->target.format == SHADE_FORMAT_RGBA32F) break;
        c->color[CANVAS_GUARD + i] = (unsigned char)rnd_bits();
    }
    for (size_t i = 0; i < c->color_bytes / 4 && c->target.format == SHADE_FORMAT_RGBA32F; i++) {
        float f = rnd_float(-0.5, 2);
        memcpy(c->color + CANVAS_GUARD + 4 * i, &f, 4);
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
    double mean[4] = { 0, 0, 0, 0 };
    for (int j = 0; j < factor; j++)
        for (int i = 0; i < factor; i++) {
            double c[4];
            ref_linear(in, x * factor + i, y * factor + j, c);
            for (int k = 0; k < 4; k++) mean[k] += c[k] / (factor * factor);
        }
    for (int k = 0; k < 4; k++) {
        double want = mean[k], got;
        if (out->target.format == SHADE_FORMAT_RGBA32F) {
            /* float sums of up to 64, of texels that may come through the library's sRGB curve */
            CHECK_NEAR(canvas_float(out, x, y, k), want, 5e-6);
            continue;
        }
        int wide = out->target.format == SHADE_FORMAT_RGBA8;
        if (!wide && k == 3) continue;
        unsigned u = wide ? canvas_bytes(out, x, y)[k] : canvas_565(out, x, y);
        got = wide ? u : k == 0 ? u >> 11 : k == 1 ? u >> 5 & 63 : u & 31;
        if (out->target.srgb && k < 3) want = ref_encode_srgb(want);
        want = fmax(0, fmin(1, want)) * (wide ? 255 : k == 1 ? 63 : 31);
        /* to nearest, where the sRGB curve steepens its argument's error; dithered: to either */
        CHECK_NEAR(got, want, !wide && out->target.dither ? 1 : 0.51);
    }
}
TEST(resolve, pixels_are_means_in_linear_light)
{
    for (int i = 0; i < 500; i++) {
        int factor = 2 + i % 7, w = rnd_int(1, 25), h = rnd_int(1, 12);
        canvas in = canvas_open(w * factor, h * factor, rnd_one_in(2) ? 0 : w * factor + 5,
                                (shade_format)rnd_int(0, 2), rnd_one_in(2));
        canvas out = canvas_open(w, h, rnd_one_in(2) ? 0 : w + rnd_int(0, 9),
                                 (shade_format)rnd_int(0, 2), rnd_one_in(2));
        in.target.srgb = rnd_one_in(2), out.target.srgb = rnd_one_in(2);
        out.target.dither = rnd_one_in(3);
        resolve_fill(&in);
        CHECK_INT(shade_resolve(&out.target, &in.target, factor), SHADE_OK);
        for (int k = 0; k < w * h; k++) check_resolved(&out, &in, factor, k % w, k / w);
        for (size_t k = 0; k < out.depth_bytes; k++)
            CHECK(out.depth[CANVAS_GUARD + k] == CANVAS_BYTE); /* depth is left alone */
        resolve_close(&in);
        canvas_close(&out);
    }
}
TEST(resolve, one_colour_stays_itself)
{
    for (int i = 0; i < 300; i++) {
        int factor = 2 + i % 7;
        shade_format format = (shade_format)rnd_int(0, 2);
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
TEST(resolve, only_the_clip_rectangle_of_out_is_written)
{
    for (int i = 0; i < 300; i++) {
        int factor = rnd_int(2, 4), w = rnd_int(1, 30), h = rnd_int(1, 12);
        shade_format format = (shade_format)rnd_int(0, 2);
        canvas in = canvas_open(w * factor, h * factor, 0, SHADE_FORMAT_RGBA8, 0);
        canvas out = canvas_open(w, h, w + 2, format, 0);
        canvas whole = canvas_open(w, h, w + 2, format, 0);
        resolve_fill(&in);
        int x = rnd_int(-5, w + 3), y = rnd_int(-5, h + 3), cw = rnd_int(0, w + 8);
        int ch = rnd_int(0, h + 8);
        out.target.clip_x = x, out.target.clip_y = y;
        out.target.clip_width = cw, out.target.clip_height = ch;
        if (!(x || y || cw || ch)) cw = w, ch = h; /* all zero: everywhere */
        in.target.clip_x = 1, in.target.clip_width = 1; /* nobody's business */
        CHECK_INT(shade_resolve(&out.target, &in.target, factor), SHADE_OK);
        CHECK_INT(shade_resolve(&whole.target, &in.target, factor), SHADE_OK);
        size_t size = canvas_pixel_bytes(format);
        for (int k = 0; k < w * h; k++) {
            int px = k % w, py = k / w;
            int written = px >= x && px < x + cw && py >= y && py < y + ch;
            const unsigned char *at = out.color + CANVAS_GUARD + size * canvas_index(&out, px, py);
            const unsigned char *full =
                whole.color + CANVAS_GUARD + size * canvas_index(&whole, px, py);
            for (size_t n = 0; n < size; n++) CHECK(at[n] == (written ? full[n] : CANVAS_BYTE));
        }
        resolve_close(&in);
        canvas_close(&out), canvas_close(&whole);
    }
}
TEST(resolve, strips_give_the_bits_of_the_whole)
{
    for (int i = 0; i < 100; i++) {
        int factor = rnd_int(2, 5), w = rnd_int(1, 30), h = rnd_int(2, 20), rows;
        shade_format format = (shade_format)rnd_int(0, 2);
        canvas in = canvas_open(w * factor, h * factor, 0, (shade_format)rnd_int(0, 2), 0);
        canvas whole = canvas_open(w, h, 0, format, 0);
        size_t in_row = (size_t)(w * factor) * canvas_pixel_bytes(in.target.format);
        size_t out_row = (size_t)w * canvas_pixel_bytes(format);
        resolve_fill(&in);
        in.target.srgb = rnd_one_in(2), whole.target.srgb = rnd_one_in(2);
        whole.target.dither = 1; /* its pattern follows the picture, not the strip */
        CHECK_INT(shade_resolve(&whole.target, &in.target, factor), SHADE_OK);
        for (int y = 0; y < h; y += rows) {
            rows = rnd_int(1, h - y);
            canvas strip = canvas_strip(w, h, 0, format, 0, y, rows);
            shade_target part = in.target;
            strip.target.srgb = whole.target.srgb, strip.target.dither = 1;
            part.row_offset = y * factor, part.row_count = rows * factor;
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
    canvas in = canvas_open(4, 2, 0, SHADE_FORMAT_RGBA32F, 0),
           out = canvas_open(2, 1, 0, SHADE_FORMAT_RGBA8, 0);
    float f[32];
    for (int i = 0; i < 32; i++) f[i] = 0.5f;
    f[0] = (float)NAN, f[8] = INFINITY, f[9] = -INFINITY;
    memcpy(in.color + CANVAS_GUARD, f, sizeof f);
    CHECK_INT(shade_resolve(&out.target, &in.target, 2), SHADE_OK);
    CHECK_INT(canvas_bytes(&out, 0, 0)[0], 0);
    CHECK_INT(canvas_bytes(&out, 0, 0)[1], 128);
    CHECK_INT(canvas_bytes(&out, 1, 0)[0], 255);
    CHECK_INT(canvas_bytes(&out, 1, 0)[1], 0);
    canvas_close(&in), canvas_close(&out);
}
TEST(resolve, what_does_not_fit_is_refused_before_a_pixel_changes)
{
    for (int k = 0; k < 20; k++) {
        canvas in = canvas_open(24, 18, 0, SHADE_FORMAT_RGBA8, 1);
        canvas out = canvas_open(8, 6, 0, SHADE_FORMAT_RGBA8, 1);
        shade_target a = out.target, b = in.target;
        const shade_target *to = &a, *from = &b;
        int factor = 3;
        shade_result want = SHADE_ERROR_ARGUMENT;
        switch (k) {
        case 0: to = NULL; break;
        case 1: from = NULL; break;
        case 2: factor = 2; break;
        case 3: factor = 1; break;
        case 4: factor = 0; break;
        case 5: factor = -3; break;
        case 6: factor = 9; break;
        case 7: b.width = 23, b.stride = 24; break;
        case 8: b.height = 17; break;
        case 9: a.row_offset = 1, a.row_count = 5; break;
        case 10: b.row_offset = 3, b.row_count = 15; break;
        case 11: a.row_offset = 2, a.row_count = 4, b.row_offset = 3, b.row_count = 12; break;
        case 12: a.color = NULL, want = SHADE_ERROR_TARGET; break;
        case 13: b.color = NULL, want = SHADE_ERROR_TARGET; break;
        case 14: a.width = 0, want = SHADE_ERROR_TARGET; break;
        case 15: b.stride = 5, want = SHADE_ERROR_TARGET; break;
        case 16: a.format = (shade_format)3, want = SHADE_ERROR_TARGET; break;
        case 17: b.format = (shade_format)-1, want = SHADE_ERROR_TARGET; break;
        case 18: a.clip_width = -1, want = SHADE_ERROR_TARGET; break;
        default: factor = INT32_MAX; break;
        }
        CHECK_INT(shade_resolve(to, from, factor), want);
        for (size_t i = 0; i < out.color_bytes; i++)
            CHECK(out.color[CANVAS_GUARD + i] == CANVAS_BYTE);
        canvas_close(&in), canvas_close(&out);
    }
}
/* Factor 1 is no supersampling, and 8 the most. */
TEST(resolve, factors_of_two_to_eight_are_taken)
{
    for (int factor = -1; factor <= 10; factor++) {
        int times = factor > 0 ? factor : 1;
        canvas in = canvas_open(5 * times, 3 * times, 0, SHADE_FORMAT_RGBA8, 0);
        canvas out = canvas_open(5, 3, 0, SHADE_FORMAT_RGBA8, 0);
        CHECK_INT(shade_resolve(&out.target, &in.target, factor),
                  factor >= 2 && factor <= 8 ? SHADE_OK : SHADE_ERROR_ARGUMENT);
        canvas_close(&in), canvas_close(&out);
    }
}
/* The edge of a half plane drawn at 4 x 4 comes out as the covered share of each pixel. */
TEST(resolve, supersampled_edges_are_shares_of_sixteenths)
{
    canvas in = canvas_open(64, 64, 0, SHADE_FORMAT_RGBA8, 0);
    canvas out = canvas_open(16, 16, 0, SHADE_FORMAT_RGBA8, 0);
    shade_vec4 clip[3] = { { -1, -1, 0, 1 }, { 1, -1, 0, 1 }, { -1, 1, 0, 1 } };
    scene s = { clip, NULL, 0, NULL, NULL };
    shade_pipeline p = scene_pipeline(&s);
    canvas_clear(&in, 1);
    CHECK_INT(shade_draw(&in.target, &p, NULL, 3, 3, NULL), SHADE_OK);
    CHECK_INT(shade_resolve(&out.target, &in.target, 4), SHADE_OK);
    for (int k = 0; k < 16 * 16; k++) {
        int covered = 0;
        for (int n = 0; n < 16; n++)
            covered += canvas_bytes(&in, 4 * (k % 16) + n % 4, 4 * (k / 16) + n / 4)[0] != 0;
        CHECK_INT(canvas_bytes(&out, k % 16, k / 16)[0], (covered * 255 + 8) / 16);
        if (k % 16 != k / 16) CHECK(covered == 0 || covered == 16);
        else CHECK(covered == 6 || covered == 10);
    }
    canvas_close(&in), canvas_close(&out);
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
        s->uv[k][0] = rnd_float(-1, 2), s->uv[k][1] = rnd_float(-1, 2);
    }
    for (int k = 0; k < 20; k++)
        s->line[k] = shade_v3(rnd_float(-2, 2), rnd_float(-2, 2), rnd_float(-2, 4));
    for (size_t k = 0; k < sizeof s->texels; k++) s->texels[k] = (unsigned char)rnd_bits();
    s->map.pixels = s->texels, s->map.width = s->map.height = 16;
    s->light = shade_directional_light(shade_v3(-1, -1, -1), shade_v3(1, 0.9f, 0.8f));
    s->mesh.positions = &s->position[0].x, s->mesh.normals = &s->normal[0].x;
    s->mesh.texcoords = &s->uv[0][0], s->mesh.vertex_count = 90;
    s->state.view =
        shade_mat4_look_at(shade_v3(0, 0.5f, 3), shade_v3(0, 0, 0), shade_v3(0, 1, 0));
    s->state.projection = shade_mat4_perspective(1, 4.0f / 3, 0.5f, 10);
    s->state.lighting.lights = &s->light, s->state.lighting.light_count = 1;
    s->state.lighting.flags = SHADE_FLAG_TWO_SIDED;
    s->state.lighting.ambient = shade_v3(0.2f, 0.2f, 0.2f);
    s->state.diffuse_map = &s->map, s->state.shading = (shade_shading)rnd_int(0, 2);
    s->lines.clip_from_points = shade_mat4_mul(s->state.projection, s->state.view);
    s->lines.width = 2.5f, s->lines.color = shade_v4(0.3f, 0.6f, 0.9f, 0.5f);
    s->lines.raster.blend = SHADE_BLEND_OVER;
}
static void strip_draw(const strip_scene *s, const shade_target *t)
{
    CHECK_INT(shade_clear(t, shade_v4(0.1f, 0.15f, 0.3f, 1), 1), SHADE_OK);
    CHECK_INT(shade_draw_mesh(t, &s->mesh, &s->state, NULL), SHADE_OK);
    CHECK_INT(shade_draw_lines(t, s->line, 20, &s->lines, NULL), SHADE_OK);
}
/* 320 x 240 in strips of at most 10 rows: 6.4 kB of colour and 12.8 kB of depth at a time */
TEST(resolve, a_small_machine_s_strips_are_the_whole_picture_bit_for_bit)
{
    static strip_scene s;
    for (int i = 0; i < 6; i++) {
        canvas whole = canvas_open(320, 240, 0, SHADE_FORMAT_RGB565, 1);
        int rows;
        random_strip_scene(&s);
        whole.target.dither = 1, whole.target.srgb = i & 1;
        strip_draw(&s, &whole.target);
        for (int y = 0; y < 240; y += rows) {
            rows = i < 3 ? 10 : rnd_int(1, 10);
            if (rows > 240 - y) rows = 240 - y;
            canvas strip = canvas_strip(320, 240, 0, SHADE_FORMAT_RGB565, 1, y, rows);
            strip.target.dither = 1, strip.target.srgb = i & 1;
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

static const test_case resolve_cases[] = {
    CASE(resolve, pixels_are_means_in_linear_light),
    CASE(resolve, one_colour_stays_itself),
    CASE(resolve, only_the_clip_rectangle_of_out_is_written),
    CASE(resolve, strips_give_the_bits_of_the_whole),
    CASE(resolve, nan_and_infinity_store_as_they_do_elsewhere),
    CASE(resolve, what_does_not_fit_is_refused_before_a_pixel_changes),
    CASE(resolve, factors_of_two_to_eight_are_taken),
    CASE(resolve, supersampled_edges_are_shares_of_sixteenths),
    CASE(resolve, a_small_machine_s_strips_are_the_whole_picture_bit_for_bit),
};
