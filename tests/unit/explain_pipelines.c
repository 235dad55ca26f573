/* explain_pipelines.c - mistakes with shade_draw and shade_draw_lines: shade_explain_draw and
   shade_explain_lines name the field, and leave the caller's memory alone. */
#include "unit.h"

enum { PIPED_W = 80, PIPED_H = 60, PIPED_CORNERS = 6, PIPED_POINTS = 24 };

typedef struct piped_uniforms {
    const float *position;
    shade_mat4 clip_from_world;
    float color[4];
    int keeps_w, discards; /* discards: 1 every pixel, 2 every other one */
} piped_uniforms;

/* A draw of two triangles, or of the edges of a box, that shows something. */
typedef struct piped {
    uint32_t pixels[PIPED_W * PIPED_H];
    float depth[PIPED_W * PIPED_H];
    float position[3 * PIPED_CORNERS];
    uint32_t index[PIPED_CORNERS];
    shade_vec3 point[PIPED_POINTS];
    shade_mat4 view, projection;
    shade_target target;
    piped_uniforms uniforms;
    shade_pipeline pipe;
    shade_line_state lines;
    const shade_target *given_target;
    const shade_pipeline *given_pipe;
    const shade_line_state *given_lines;
    const uint32_t *indices;
    const shade_vec3 *points;
    int index_count, vertex_count, point_count;
    float clear;
    int over_quad; /* the two triangles are drawn first */
} piped;

static void piped_vertex(const void *uniforms, const shade_vertex_ids *SHADE_RESTRICT in,
                         shade_vertices *SHADE_RESTRICT out)
{
    const piped_uniforms *u = (const piped_uniforms *)uniforms;
    for (int i = 0; i < SHADE_LANES; i++) {
        const float *p = u->position + 3 * in->index[i];
        const shade_vec4 c = shade_mat4_transform(u->clip_from_world,
                                                  shade_v4(p[0], p[1], p[2], 1));
        out->clip[0][i] = c.x;
        out->clip[1][i] = c.y;
        out->clip[2][i] = c.z;
        if (!u->keeps_w) out->clip[3][i] = c.w;
        out->varying[0][i] = p[0];
    }
}

static void piped_fragment(const void *uniforms, const shade_fragments *SHADE_RESTRICT in,
                           shade_colors *SHADE_RESTRICT out)
{
    const piped_uniforms *u = (const piped_uniforms *)uniforms;
    for (int i = 0; i < SHADE_LANES; i++) {
        for (int k = 0; k < 4; k++) out->color[k][i] = u->color[k];
        if (u->discards == 1 || (u->discards && in->x[i] < PIPED_W / 2)) out->discard[i] = 1;
    }
}

static piped *piped_open(void)
{
    static const float corner[3 * PIPED_CORNERS] = { -1, -1, 0, 1, -1, 0, 1,  1, 0,
                                                     -1, -1, 0, 1, 1,  0, -1, 1, 0 };
    piped *p = (piped *)test_memory(sizeof *p);
    int n = 0;
    memset(p, 0, sizeof *p);
    memcpy(p->position, corner, sizeof corner);
    for (uint32_t k = 0; k < PIPED_CORNERS; k++) p->index[k] = k;
    for (int a = 0; a < 8; a++)
        for (int bit = 1; bit < 8; bit *= 2)
            for (int b = a | bit; b != a && n < PIPED_POINTS; b = a) {
                p->point[n++] = shade_v3(a & 1 ? 1.0f : -1.0f, a & 2 ? 1.0f : -1.0f,
                                         a & 4 ? 1.0f : -1.0f);
                p->point[n++] = shade_v3(b & 1 ? 1.0f : -1.0f, b & 2 ? 1.0f : -1.0f,
                                         b & 4 ? 1.0f : -1.0f);
            }
    p->view = shade_mat4_look_at(shade_v3(1, 2, 5), shade_v3(0, 0, 0), shade_v3(0, 1, 0));
    p->projection = shade_mat4_perspective(0.8f, (float)PIPED_W / PIPED_H, 0.5f, 30);
    p->target.width = PIPED_W;
    p->target.height = PIPED_H;
    p->target.color = p->pixels;
    p->target.depth = p->depth;
    p->uniforms.position = p->position;
    p->uniforms.color[0] = p->uniforms.color[1] = p->uniforms.color[3] = 1;
    p->uniforms.color[2] = 0.5f;
    p->pipe.vertex = piped_vertex;
    p->pipe.fragment = piped_fragment;
    p->pipe.uniforms = &p->uniforms;
    p->pipe.varyings = 1;
    p->lines.color = shade_v4(1, 1, 0.5f, 1);
    p->given_target = &p->target;
    p->given_pipe = &p->pipe;
    p->given_lines = &p->lines;
    p->indices = p->index;
    p->points = p->point;
    p->index_count = p->vertex_count = PIPED_CORNERS;
    p->point_count = PIPED_POINTS;
    p->clear = 1;
    return p;
}

/* Puts the camera where the two draws take it from, but for a mistake that has set it. */
static void piped_aim(piped *p)
{
    const shade_mat4 m = shade_mat4_mul(p->projection, p->view);
    p->uniforms.clip_from_world = m;
    p->lines.clip_from_points = m;
}

static shade_result piped_draw(const piped *p, int lines, shade_stats *stats)
{
    return lines ? shade_draw_lines(p->given_target, p->points, p->point_count, p->given_lines,
                                    stats)
                 : shade_draw(p->given_target, p->given_pipe, p->indices, p->index_count,
                              p->vertex_count, stats);
}

static const char *piped_explain(const piped *p, int lines, const shade_stats *stats)
{
    return lines ? shade_explain_lines(p->given_target, p->points, p->point_count, p->given_lines,
                                       stats)
                 : shade_explain_draw(p->given_target, p->given_pipe, p->indices, p->index_count,
                                      p->vertex_count, stats);
}

/* Clears, draws, and returns what is said, with stats and without. */
static shade_result piped_say(piped *p, int lines, const char *said[2])
{
    static uint32_t pixels[PIPED_W * PIPED_H];
    static float depth[PIPED_W * PIPED_H];
    shade_stats stats;
    for (int k = 0; k < PIPED_W * PIPED_H; k++) {
        p->pixels[k] = 0xFF302010u;
        p->depth[k] = p->clear;
    }
    if (p->over_quad) piped_draw(p, 0, NULL);
    const shade_result result = piped_draw(p, lines, &stats);
    memcpy(pixels, p->pixels, sizeof pixels);
    memcpy(depth, p->depth, sizeof depth);
    for (int k = 0; k < 2; k++) said[k] = piped_explain(p, lines, k ? NULL : &stats);
    CHECK(!memcmp(pixels, p->pixels, sizeof pixels) && !memcmp(depth, p->depth, sizeof depth));
    return result;
}

/* ---- mistakes.  Those of both draws come first. */

#define PIPED(name) static void piped_##name(piped *p)
PIPED(nothing) { (void)p; }
PIPED(no_target) { p->given_target = NULL; }
PIPED(no_size) { p->target.width = 0; }
PIPED(no_memory) { p->target.color = p->target.depth = NULL; }
PIPED(clip_outside) { p->target.clip_x = 90; p->target.clip_width = p->target.clip_height = 9; }
PIPED(clip_beside) { p->target.clip_width = p->target.clip_height = 3; }
PIPED(strip_beside_clip)
{
    p->target.clip_width = 80;
    p->target.clip_height = 10;
    p->target.row_offset = 30;
    p->target.row_count = 10;
}
PIPED(band_beside) { p->target.clip_width = PIPED_W; p->target.clip_height = 3; }
PIPED(fovy_in_degrees) { p->projection = shade_mat4_perspective(45, 1, 0.5f, 30); }
PIPED(near_is_far) { p->projection = shade_mat4_perspective(0.8f, 1, 30, 30); }
PIPED(near_too_far) { p->projection = shade_mat4_perspective(0.8f, 1, 20, 30); }
PIPED(far_too_near) { p->projection = shade_mat4_perspective(0.8f, 1, 0.5f, 2); }
PIPED(eye_turned)
{
    p->view = shade_mat4_look_at(shade_v3(1, 2, 5), shade_v3(2, 4, 10), shade_v3(0, 1, 0));
    p->projection = shade_mat4_perspective_reversed(0.8f, 1, 0.5f);
    p->pipe.raster.depth_test = p->lines.raster.depth_test = SHADE_COMPARE_GREATER;
    p->pipe.raster.depth_zero_to_one = p->lines.raster.depth_zero_to_one = 1;
    p->clear = 0;
}
PIPED(looks_aside)
{
    p->view = shade_mat4_look_at(shade_v3(0, 0, 5), shade_v3(9, 0, 3), shade_v3(0, 1, 0));
}
PIPED(view_nan) { p->view.col[1].y = (float)NAN; }
PIPED(depth_zero) { p->clear = 0; }
PIPED(depth_nan) { p->clear = (float)NAN; }
PIPED(test_greater) { p->pipe.raster.depth_test = p->lines.raster.depth_test = SHADE_COMPARE_GREATER; }
PIPED(test_equal) { p->pipe.raster.depth_test = p->lines.raster.depth_test = SHADE_COMPARE_EQUAL; }
PIPED(hidden) { p->clear = 0.01f; }
PIPED(bad_test) { p->pipe.raster.depth_test = p->lines.raster.depth_test = (shade_compare)9; }
PIPED(bad_blend) { p->pipe.raster.blend = p->lines.raster.blend = (shade_blend)9; }
PIPED(bias_nan) { p->pipe.raster.depth_bias = p->lines.raster.depth_bias = (float)NAN; }
PIPED(alpha_zero)
{
    p->pipe.raster.blend = p->lines.raster.blend = SHADE_BLEND_OVER;
    p->lines.color.w = p->uniforms.color[3] = 0;
}
PIPED(adds_black)
{
    p->pipe.raster.blend = p->lines.raster.blend = SHADE_BLEND_ADD;
    for (int k = 0; k < 3; k++) (&p->lines.color.x)[k] = p->uniforms.color[k] = 0;
}
PIPED(colors_of_255)
{
    for (int k = 0; k < 3; k++) {
        (&p->lines.color.x)[k] *= 255;
        p->uniforms.color[k] *= 255;
    }
}
PIPED(no_pipeline) { p->given_pipe = NULL; }
PIPED(no_vertex) { p->pipe.vertex = NULL; }
PIPED(bad_interpolation) { p->pipe.interpolation = (shade_interpolation)7; }
PIPED(too_many_varyings) { p->pipe.varyings = 65; }
PIPED(bad_cull) { p->pipe.raster.cull = (shade_cull)7; }
static const shade_texture piped_map = { NULL, 4, 4, 0, SHADE_FORMAT_RGBA8, 0, SHADE_WRAP_REPEAT,
                                         SHADE_WRAP_REPEAT, SHADE_FILTER_BILINEAR, NULL, 0 };
PIPED(lod_without_varyings) { p->pipe.lod_texture = &piped_map; }
PIPED(lod_without_pixels) { p->pipe.lod_texture = &piped_map; p->pipe.varyings = 2; }
PIPED(negative_count) { p->index_count = -3; }
PIPED(count_of_triangles) { p->index_count = 2; }
PIPED(index_past) { p->index[4] = 6; }
PIPED(too_few_vertices) { p->indices = NULL; p->vertex_count = 3; }
PIPED(no_triangle) { p->index_count = 0; }
PIPED(w_forgotten) { p->uniforms.keeps_w = 1; }
PIPED(wound_clockwise)
{
    p->pipe.raster.cull = SHADE_CULL_BACK;
    for (int k = 0; k < PIPED_CORNERS; k++) p->index[k] = (uint32_t)(PIPED_CORNERS - 1 - k);
}
PIPED(fronts_culled) { p->pipe.raster.cull = SHADE_CULL_FRONT; }
PIPED(corners_coincide) { for (int k = 0; k < PIPED_CORNERS; k++) p->index[k] = 1; }
PIPED(discards_all) { p->pipe.may_discard = p->uniforms.discards = 1; }
PIPED(discards_some) { p->pipe.may_discard = 1; p->uniforms.discards = 2; }
PIPED(discard_not_allowed) { p->uniforms.discards = 2; }
PIPED(no_fragment) { p->pipe.fragment = NULL; p->target.depth = NULL; }
PIPED(depth_alone) { p->pipe.fragment = NULL; }
PIPED(depth_not_written) { p->pipe.fragment = NULL; p->pipe.raster.depth_read_only = 1; }
PIPED(black) { p->uniforms.color[0] = p->uniforms.color[1] = p->uniforms.color[2] = 0; }
PIPED(black_nan) { for (int k = 0; k < 3; k++) p->uniforms.color[k] = (float)NAN; }
PIPED(shadow)
{
    p->pipe.raster.blend = SHADE_BLEND_OVER;
    piped_black(p);
    p->uniforms.color[3] = 0.5f;
}
PIPED(no_state) { p->given_lines = NULL; }
PIPED(no_points) { p->points = NULL; }
PIPED(odd_points) { p->point_count = 23; }
PIPED(no_line) { p->point_count = 0; }
PIPED(negative_width) { p->lines.width = -1; }
PIPED(width_nan) { p->lines.width = (float)NAN; }
PIPED(bad_cap) { p->lines.cap = (shade_cap)5; }
PIPED(point_nan) { p->point[3].y = (float)NAN; }
PIPED(hairs) { p->lines.width = 1e-6f; }
PIPED(in_a_surface)
{
    p->over_quad = 1;
    p->point_count = 2;
    p->point[0] = shade_v3(-0.5f, 0, 0);
    p->point[1] = shade_v3(0.5f, 0, 0);
    p->view = shade_mat4_look_at(shade_v3(0, 0, 5), shade_v3(0, 0, 0), shade_v3(0, 1, 0));
}
PIPED(color_forgotten) { p->lines.color = shade_v4(0, 0, 0, 0); }
PIPED(black_lines) { p->lines.color = shade_v4(0, 0, 0, 1); }

PIPED(in_a_box) { p->projection = shade_mat4_ortho(-3, 3, -3, 3, 0, 20); }
PIPED(box_beside) { p->projection = shade_mat4_ortho(30, 33, -3, 3, 0, 20); }

/* Mistakes that are made after the product of projection and view. */
PIPED(matrix_forgotten)
{
    for (int k = 0; k < PIPED_POINTS; k++) p->point[k] = shade_scale(p->point[k], 3);
    memset(&p->lines.clip_from_points, 0, sizeof p->lines.clip_from_points);
}
PIPED(matrix_by_rows) { p->lines.clip_from_points = shade_mat4_transpose(p->lines.clip_from_points); }
PIPED(matrix_by_rows_ahead)
{
    p->view = shade_mat4_look_at(shade_v3(0, 0, 5), shade_v3(0, 0, 0), shade_v3(0, 1, 0));
    piped_aim(p);
    piped_matrix_by_rows(p);
}
PIPED(matrix_of_a_box_by_rows)
{
    p->projection = shade_mat4_ortho(-5, 3, -4, 3, 3, 20);
    piped_aim(p);
    piped_matrix_by_rows(p);
}
PIPED(matrices_exchanged)
{
    p->lines.clip_from_points = p->uniforms.clip_from_world = shade_mat4_mul(p->view, p->projection);
}
PIPED(matrices_exchanged_ahead)
{
    p->view = shade_mat4_look_at(shade_v3(0, 0, 5), shade_v3(0, 0, 0), shade_v3(0, 1, 0));
    piped_matrices_exchanged(p);
}

enum { OF_DRAW = 1, OF_LINES = 2, OF_BOTH = 3, AFTERWARDS = 4, STATS_ALONE = 8 };
static const struct piped_mistake {
    int of;
    void (*make)(piped *p);
    const char *words; /* "" : nothing is said */
} piped_mistakes[] = {
    { OF_BOTH, piped_nothing, "" },
    { OF_BOTH, piped_no_target, "target" },
    { OF_BOTH, piped_no_size, "target.width" },
    { OF_BOTH, piped_no_memory, "target.color and target.depth" },
    { OF_BOTH, piped_clip_outside, "clip rectangle is empty" },
    { OF_BOTH, piped_clip_beside, "beside the clip rectangle" },
    { OF_BOTH, piped_strip_beside_clip, "" },
    { OF_BOTH, piped_band_beside, "" },
    { OF_BOTH, piped_fovy_in_degrees, "degrees" },
    { OF_BOTH, piped_near_is_far, "near = far" },
    { OF_BOTH, piped_near_too_far, "near plane" },
    { OF_BOTH, piped_far_too_near, "far plane" },
    { OF_BOTH, piped_eye_turned, "behind the eye" },
    { OF_BOTH, piped_looks_aside, "beside the picture" },
    { OF_BOTH, piped_view_nan, "NaN" },
    { OF_BOTH, piped_depth_zero, "shade_clear" },
    { OF_BOTH, piped_depth_nan, "shade_clear" },
    { OF_BOTH, piped_test_greater, "shade_clear" },
    { OF_BOTH, piped_test_equal, "SHADE_COMPARE_EQUAL" },
    { OF_BOTH | STATS_ALONE, piped_hidden, "hides everything" },
    { OF_BOTH, piped_bad_test, "raster.depth_test" },
    { OF_BOTH, piped_bad_blend, "raster.blend" },
    { OF_BOTH, piped_bias_nan, "raster.depth_bias" },
    { OF_BOTH, piped_alpha_zero, "Alpha is 0" },
    { OF_BOTH, piped_adds_black, "adds nothing" },
    { OF_BOTH, piped_colors_of_255, "255" },
    { OF_BOTH, piped_in_a_box, "" },
    { OF_BOTH, piped_box_beside, "beside the picture" },
    { OF_DRAW, piped_no_pipeline, "pipeline" },
    { OF_DRAW, piped_no_vertex, "pipeline.vertex" },
    { OF_DRAW, piped_bad_interpolation, "pipeline.interpolation" },
    { OF_DRAW, piped_too_many_varyings, "pipeline.varyings" },
    { OF_DRAW, piped_bad_cull, "raster.cull" },
    { OF_DRAW, piped_lod_without_varyings, "pipeline.lod_varying" },
    { OF_DRAW, piped_lod_without_pixels, "texture's pixels" },
    { OF_DRAW, piped_negative_count, "index_count" },
    { OF_DRAW, piped_count_of_triangles, "multiple of 3" },
    { OF_DRAW, piped_index_past, "vertex_count" },
    { OF_DRAW, piped_too_few_vertices, "vertex_count" },
    { OF_DRAW, piped_no_triangle, "no triangle" },
    { OF_DRAW, piped_w_forgotten, "out->clip[3]" },
    { OF_DRAW, piped_wound_clockwise, "SHADE_CULL_BACK" },
    { OF_DRAW, piped_fronts_culled, "SHADE_CULL_FRONT" },
    { OF_DRAW, piped_corners_coincide, "coincide" },
    { OF_DRAW, piped_discards_all, "discards all" },
    { OF_DRAW, piped_discards_some, "" },
    { OF_DRAW, piped_discard_not_allowed, "may_discard" },
    { OF_DRAW, piped_no_fragment, "pipeline.fragment is NULL" },
    { OF_DRAW, piped_depth_alone, "" },
    { OF_DRAW, piped_depth_not_written, "depth_read_only" },
    { OF_DRAW, piped_black, "black" },
    { OF_DRAW, piped_black_nan, "NaN" },
    { OF_DRAW, piped_shadow, "" },
    { OF_DRAW | AFTERWARDS, piped_matrices_exchanged, "projection times view" },
    { OF_LINES, piped_no_state, "state" },
    { OF_LINES, piped_no_points, "points" },
    { OF_LINES, piped_odd_points, "point_count" },
    { OF_LINES, piped_no_line, "point_count is 0" },
    { OF_LINES, piped_negative_width, "state.width" },
    { OF_LINES, piped_width_nan, "state.width" },
    { OF_LINES, piped_bad_cap, "state.cap" },
    { OF_LINES, piped_point_nan, "NaN" },
    { OF_LINES, piped_hairs, "state.width" },
    { OF_LINES | STATS_ALONE, piped_in_a_surface, "depth_bias" },
    { OF_LINES, piped_color_forgotten, "state.color" },
    { OF_LINES, piped_black_lines, "" },
    { OF_LINES | AFTERWARDS, piped_matrix_forgotten, "unset" },
    { OF_LINES | AFTERWARDS, piped_matrix_by_rows, "transposed" },
    { OF_LINES | AFTERWARDS, piped_matrix_by_rows_ahead, "transposed" },
    { OF_LINES | AFTERWARDS, piped_matrix_of_a_box_by_rows, "transposed" },
    { OF_LINES | AFTERWARDS, piped_matrices_exchanged, "view times projection" },
    { OF_LINES | AFTERWARDS, piped_matrices_exchanged_ahead, "view times projection" },
};

TEST(explain_pipelines, each_mistake_gets_its_sentence)
{
    for (int i = 0; i < TEST_COUNT(piped_mistakes); i++)
        for (int lines = 0; lines < 2; lines++) {
            const struct piped_mistake *m = &piped_mistakes[i];
            const char *said[2];
            piped *p = piped_open();
            if (!(m->of & (lines ? OF_LINES : OF_DRAW))) continue;
            if (!(m->of & AFTERWARDS)) m->make(p);
            piped_aim(p);
            if (m->of & AFTERWARDS) m->make(p);
            piped_say(p, lines, said);
            for (int k = 0; k < 2; k++) {
                const char *want = k && (m->of & STATS_ALONE) ? "" : m->words;
                CHECK_SAY(*want ? strstr(said[k], want) != NULL : !*said[k],
                          "mistake %d, %s, %s stats: \"%s\"", i, lines ? "lines" : "draw",
                          k ? "without" : "with", said[k]);
            }
            free(p);
        }
}

static const test_case explain_pipelines_cases[] = {
    CASE(explain_pipelines, each_mistake_gets_its_sentence),
};

SECTION(explain_pipelines);
