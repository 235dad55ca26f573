/* lines.c - shade_draw_lines: any segments, widths and caps on any target. */
#include "picture.h"
#include <math.h>

enum { LINES_POINTS = 80 };

typedef struct lines_scene {
    const shade_vec3 *points;
    int point_count;
    shade_line_state state;
    const shade_line_state *given;       /* &state, or NULL */
} lines_scene;

static shade_result lines_call(void *user, const shade_target *target, shade_stats *stats)
{
    lines_scene *s = (lines_scene *)user;
    return shade_draw_lines(target, s->points, s->point_count, s->given, stats);
}

static shade_vec3 lines_point(fuzz_input *in, shade_vec3 before)
{
    static const float away[] = { 1e5f, 1e6f, 1e9f, 1e12f, 1e20f, 1e30f, 3e38f, INFINITY };
    uint32_t kind = fuzz_byte(in);
    float x, y;
    if (kind >= 192) { /* straight, or askew, far away */
        float far = away[kind & 7];
        x = (float)fuzz_byte(in) / 64 - 2;
        y = (float)fuzz_byte(in) / 64 - 2;
        if (kind & 8) before.x = far < 1e38f ? x * far : x < 0 ? -far : far;
        if (kind & 16) before.y = far < 1e38f ? y * far : y < 0 ? -far : far;
        if (kind & 32) before.z += x;
        return before;
    }
    switch (kind % 4) {
    case 0:
        x = (float)fuzz_byte(in) / 64 - 2;
        y = (float)fuzz_byte(in) / 64 - 2;
        return shade_v3(x, y, (float)fuzz_byte(in) / 100 - 1.28f);
    case 1:
        x = (float)((int)fuzz_byte(in) - 128) / 64;
        if (kind & 4) before.x += x;
        if (kind & 8) before.y += x;
        if (kind & 16) before.z += x;
        return before;
    case 2: return fuzz_vec3(in, 1e6f);
    default: return fuzz_vec3(in, 0);
    }
}

int LLVMFuzzerTestOneInput(const uint8_t *data, size_t size)
{
    fuzz_input in = { data, data + size };
    picture pic;
    uint32_t kind = fuzz_byte(&in);
    int bad = 0, n;
    shade_result want;
    shade_vec3 *points, before = shade_v3(0, 0, 0);
    picture_open(&in, &pic, 40);
    want = pic.want;
    lines_scene s = { 0 };
    s.given = &s.state;
    s.state.clip_from_points = fuzz_matrix(&in, kind & 64 ? 0 : 1e6f);
    if (kind & 2) s.state.width = kind & 4 ? fuzz_float(&in) : (float)fuzz_byte(&in) / 4;
    s.state.cap = (shade_cap)fuzz_enum(&in, 2, &bad);
    s.state.color = fuzz_vec4(&in, 0);
    s.state.raster.depth_test = (shade_compare)fuzz_enum(&in, 6, &bad);
    s.state.raster.blend = (shade_blend)fuzz_enum(&in, SHADE_BLEND_ADD + 1, &bad);
    if (kind & 8) s.state.raster.depth_bias = fuzz_float(&in);
    s.state.raster.depth_read_only = kind >> 4 & 1;
    s.state.raster.depth_zero_to_one = kind >> 5 & 1;
    bad |= !(s.state.width >= 0 && fuzz_finite(s.state.width) &&
             fuzz_finite(s.state.raster.depth_bias));
    n = 2 * fuzz_int(&in, 1, LINES_POINTS / 2);
    points = (shade_vec3 *)guard_take((size_t)n * sizeof *points, kind & 1);
    for (int i = 0; i < n; i++) before = points[i] = lines_point(&in, before);
    guard_seal(points);
    s.points = points;
    s.point_count = n;
    if (fuzz_one_in(&in, 64)) {
        s.point_count = fuzz_int(&in, -3, 2);
        if (s.point_count <= 0 && fuzz_one_in(&in, 2)) s.points = NULL;
    }
    if (want == SHADE_OK && (s.point_count < 0 || s.point_count % 2)) want = SHADE_ERROR_MESH;
    if (want == SHADE_OK && bad) want = SHADE_ERROR_STATE;
    if (fuzz_one_in(&in, 128)) {
        s.given = NULL;
        want = SHADE_ERROR_ARGUMENT;
    }
    picture_try(&in, &pic, lines_call, NULL, &s, want, s.point_count,
                s.state.raster.depth_read_only);
    picture_close(&pic);
    guard_close();
    return 0;
}
