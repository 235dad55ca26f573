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

/* NaN farther than the middle. */
static void piped_nan_behind(const void *uniforms, const shade_fragments *SHADE_RESTRICT in,
                             shade_colors *SHADE_RESTRICT out)
{
    (void)uniforms;
    for (int k = 0; k < 3; k++)
        for (int i = 0; i < SHADE_LANES; i++)
            out->color[k][i] = in->primitive[i] ? 0.5f : (float)NAN;
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

/* SILENT: a mistake that may be meant, and gets no sentence; other draws without one are right. */
enum { OF_DRAW = 1, OF_LINES = 2, OF_BOTH = 3, AFTERWARDS = 4, STATS_ALONE = 8, SILENT = 16 };
typedef struct piped_mistake {
    const char *name, *words;    /* "": nothing is said */
    void (*make)(piped *p);
    int of;
    struct piped_mistake *next;
} piped_mistake;
LISTED(piped_mistake);
#define PIPED(name, of, words)                                                                     \
    static void piped_##name(piped *p);                                                            \
    PIPED_IN(name, name, of, words)                                                                \
    static void piped_##name(piped *p)
/* The same mistake, which has other words in one of the draws. */
#define PIPED_IN(name, entry, of, words)                                                           \
    LIST(piped_mistake, entry, #name, words, piped_##name, of)
PIPED(nothing, OF_BOTH, "") { (void)p; }
PIPED(no_target, OF_BOTH, "target") { p->given_target = NULL; }
PIPED(no_size, OF_BOTH, "target.width") { p->target.width = 0; }
PIPED(no_memory, OF_BOTH, "target.color and target.depth")
{
    p->target.color = p->target.depth = NULL;
}
PIPED(clip_outside, OF_BOTH, "clip rectangle is empty")
{
    p->target.clip_x = 90; p->target.clip_width = p->target.clip_height = 9;
}
PIPED(clip_beside, OF_BOTH, "beside the clip rectangle")
{
    p->target.clip_width = p->target.clip_height = 3;
}
PIPED(strip_beside_clip, OF_BOTH, "")
{
    p->target.clip_width = 80;
    p->target.clip_height = 10;
    p->target.row_offset = 30;
    p->target.row_count = 10;
}
PIPED(band_beside, OF_BOTH, "") { p->target.clip_width = PIPED_W; p->target.clip_height = 3; }
PIPED(fovy_in_degrees, OF_BOTH, "degrees")
{
    p->projection = shade_mat4_perspective(45, 1, 0.5f, 30);
}
PIPED(near_is_far, OF_BOTH, "near = far")
{
    p->projection = shade_mat4_perspective(0.8f, 1, 30, 30);
}
PIPED(near_too_far, OF_BOTH, "near plane")
{
    p->projection = shade_mat4_perspective(0.8f, 1, 20, 30);
}
PIPED(far_too_near, OF_BOTH, "far plane")
{
    p->projection = shade_mat4_perspective(0.8f, 1, 0.5f, 2);
}
PIPED(eye_turned, OF_BOTH, "behind the eye")
{
    p->view = shade_mat4_look_at(shade_v3(1, 2, 5), shade_v3(2, 4, 10), shade_v3(0, 1, 0));
    p->projection = shade_mat4_perspective_reversed(0.8f, 1, 0.5f);
    p->pipe.raster.depth_test = p->lines.raster.depth_test = SHADE_COMPARE_GREATER;
    p->pipe.raster.depth_zero_to_one = p->lines.raster.depth_zero_to_one = 1;
    p->clear = 0;
}
PIPED(looks_aside, OF_BOTH, "beside the picture")
{
    p->view = shade_mat4_look_at(shade_v3(0, 0, 5), shade_v3(9, 0, 3), shade_v3(0, 1, 0));
}
PIPED(view_nan, OF_BOTH, "NaN") { p->view.col[1].y = (float)NAN; }
PIPED(depth_zero, OF_BOTH, "shade_clear") { p->clear = 0; }
PIPED(depth_nan, OF_BOTH, "shade_clear") { p->clear = (float)NAN; }
PIPED(test_greater, OF_BOTH, "shade_clear")
{
    p->pipe.raster.depth_test = p->lines.raster.depth_test = SHADE_COMPARE_GREATER;
}
PIPED(test_equal, OF_BOTH, "SHADE_COMPARE_EQUAL")
{
    p->pipe.raster.depth_test = p->lines.raster.depth_test = SHADE_COMPARE_EQUAL;
}
PIPED(hidden, OF_BOTH, "is hidden by depth") { p->clear = 0.01f; }
PIPED(bad_test, OF_BOTH, "raster.depth_test")
{
    p->pipe.raster.depth_test = p->lines.raster.depth_test = (shade_compare)9;
}
PIPED(bad_blend, OF_BOTH, "raster.blend")
{
    p->pipe.raster.blend = p->lines.raster.blend = (shade_blend)9;
}
PIPED(bias_nan, OF_BOTH, "raster.depth_bias")
{
    p->pipe.raster.depth_bias = p->lines.raster.depth_bias = (float)NAN;
}
PIPED(alpha_zero, OF_BOTH, "Alpha is 0")
{
    p->pipe.raster.blend = p->lines.raster.blend = SHADE_BLEND_OVER;
    p->lines.color.w = p->uniforms.color[3] = 0;
}
PIPED(adds_black, OF_BOTH, "adds nothing")
{
    p->pipe.raster.blend = p->lines.raster.blend = SHADE_BLEND_ADD;
    for (int k = 0; k < 3; k++) (&p->lines.color.x)[k] = p->uniforms.color[k] = 0;
}
PIPED(colors_of_255, OF_BOTH, "255")
{
    for (int k = 0; k < 3; k++) {
        (&p->lines.color.x)[k] *= 255;
        p->uniforms.color[k] *= 255;
    }
}
PIPED(colors_of_255_in_floats, OF_BOTH, "")
{
    piped_colors_of_255(p);
    p->target.format = SHADE_FORMAT_RGBA32F;    /* the memory of four pixels for each */
    p->target.width /= 2;
    p->target.height /= 2;
}
PIPED(without_colors, OF_BOTH, "") { p->target.color = NULL; }
PIPED(without_colors_discards_some, OF_DRAW, "")
{
    p->target.color = NULL;
    p->pipe.may_discard = 1;
    p->uniforms.discards = 2;
}
/* Cameras that lines must not take for a matrix that is wrong */
PIPED(looks_down, OF_BOTH, "")
{
    p->view = shade_mat4_look_at(shade_v3(0, 2, 5), shade_v3(0, 0, 0), shade_v3(0, 1, 0));
}
PIPED(eye_at_the_origin, OF_BOTH, "")
{
    p->view = shade_mat4_identity();
    for (int k = 0; k < PIPED_CORNERS; k++) p->position[3 * k + 2] -= 5;
    for (int k = 0; k < PIPED_POINTS; k++) p->point[k].z -= 5;
}
PIPED(eye_at_the_origin_reversed, OF_BOTH, "")
{
    piped_eye_turned(p);
    piped_eye_at_the_origin(p);
}
PIPED(no_pipeline, OF_DRAW, "pipeline") { p->given_pipe = NULL; }
PIPED(no_vertex, OF_DRAW, "pipeline.vertex") { p->pipe.vertex = NULL; }
PIPED(bad_interpolation, OF_DRAW, "pipeline.interpolation")
{
    p->pipe.interpolation = (shade_interpolation)7;
}
PIPED(too_many_varyings, OF_DRAW, "pipeline.varyings") { p->pipe.varyings = 65; }
PIPED(bad_cull, OF_DRAW, "raster.cull") { p->pipe.raster.cull = (shade_cull)7; }
static const shade_texture piped_map = { NULL, 4, 4, 0, SHADE_FORMAT_RGBA8, 0, SHADE_WRAP_REPEAT,
                                         SHADE_WRAP_REPEAT, SHADE_FILTER_BILINEAR, NULL, 0 };
PIPED(lod_without_varyings, OF_DRAW, "pipeline.lod_varying") { p->pipe.lod_texture = &piped_map; }
PIPED(lod_without_pixels, OF_DRAW, "texture's pixels")
{
    p->pipe.lod_texture = &piped_map; p->pipe.varyings = 2;
}
PIPED(negative_count, OF_DRAW, "index_count") { p->index_count = -3; }
PIPED(count_of_triangles, OF_DRAW, "multiple of 3") { p->index_count = 2; }
PIPED(index_past, OF_DRAW, "vertex_count") { p->index[4] = 6; }
PIPED(too_few_vertices, OF_DRAW, "vertex_count") { p->indices = NULL; p->vertex_count = 3; }
PIPED(no_triangle, OF_DRAW, "no triangle") { p->index_count = 0; }
PIPED(w_forgotten, OF_DRAW, "out->clip[3]") { p->uniforms.keeps_w = 1; }
PIPED(wound_clockwise, OF_DRAW, "SHADE_CULL_BACK")
{
    p->pipe.raster.cull = SHADE_CULL_BACK;
    for (int k = 0; k < PIPED_CORNERS; k++) p->index[k] = (uint32_t)(PIPED_CORNERS - 1 - k);
}
PIPED(fronts_culled, OF_DRAW, "SHADE_CULL_FRONT") { p->pipe.raster.cull = SHADE_CULL_FRONT; }
PIPED(corners_coincide, OF_DRAW, "coincide")
{
    for (int k = 0; k < PIPED_CORNERS; k++) p->index[k] = 1;
}
PIPED(discards_all, OF_DRAW, "discards all") { p->pipe.may_discard = p->uniforms.discards = 1; }
PIPED(discards_some, OF_DRAW, "") { p->pipe.may_discard = 1; p->uniforms.discards = 2; }
PIPED(discard_not_allowed, OF_DRAW, "may_discard") { p->uniforms.discards = 2; }
PIPED(no_fragment, OF_DRAW, "pipeline.fragment is NULL")
{
    p->pipe.fragment = NULL; p->target.depth = NULL;
}
PIPED(depth_alone, OF_DRAW, "") { p->pipe.fragment = NULL; p->target.color = NULL; }
/* a first pass for depth may look like that, and a count of what is visible */
PIPED(fragment_forgotten, OF_DRAW | SILENT, "") { p->pipe.fragment = NULL; }
PIPED(depth_not_written, OF_DRAW | SILENT, "")
{
    p->pipe.fragment = NULL; p->pipe.raster.depth_read_only = 1;
}
PIPED(black, OF_DRAW, "black")
{
    p->uniforms.color[0] = p->uniforms.color[1] = p->uniforms.color[2] = 0;
}
PIPED(outlines, OF_DRAW, "")
{
    piped_wound_clockwise(p);
    p->pipe.raster.cull = SHADE_CULL_FRONT;
    piped_black(p);
}
PIPED(black_nan, OF_DRAW, "NaN") { for (int k = 0; k < 3; k++) p->uniforms.color[k] = (float)NAN; }
PIPED(shadow, OF_DRAW, "")
{
    p->pipe.raster.blend = SHADE_BLEND_OVER;
    piped_black(p);
    p->uniforms.color[3] = 0.5f;
}
/* A ball of which each triangle is a square around it: a root of a negative number beside it. */
static void piped_ball(const void *uniforms, const shade_fragments *SHADE_RESTRICT in,
                       shade_colors *SHADE_RESTRICT out)
{
    (void)uniforms;
    for (int i = 0; i < SHADE_LANES; i++) {
        const float x = in->varying[0][i];
        const float z = sqrtf(0.5f - x * x);
        for (int k = 0; k < 3; k++) out->color[k][i] = z;
        if (!(z >= 0)) out->discard[i] = 1;
    }
}
PIPED(impostor, OF_DRAW, "") { p->pipe.fragment = piped_ball; p->pipe.may_discard = 1; }
PIPED(impostor_undiscarded, OF_DRAW, "may_discard") { p->pipe.fragment = piped_ball; }
static void piped_root(const void *uniforms, const shade_fragments *SHADE_RESTRICT in,
                       shade_colors *SHADE_RESTRICT out)
{
    (void)uniforms;
    for (int i = 0; i < SHADE_LANES; i++) {
        const float x = in->varying[0][i];
        for (int k = 0; k < 3; k++) out->color[k][i] = k == 1 ? sqrtf(0.5f - x * x) : 0.5f;
    }
}
PIPED(root_of_negative_numbers, OF_DRAW, "gives NaN") { p->pipe.fragment = piped_root; }
/* NaN that nearer triangles hide, drawn afterwards */
PIPED(hidden_nan, OF_DRAW, "")
{
    for (int k = 0; k < 9; k++) p->position[k] *= 0.2f;
    for (int k = 0; k < 3; k++) p->position[3 * k + 2] = -1;
    for (int k = 0; k < 3; k++) {
        p->position[9 + 3 * k] = k == 1 ? 60.0f : -20.0f;
        p->position[10 + 3 * k] = k == 2 ? 60.0f : -20.0f;
        p->position[11 + 3 * k] = 1;
    }
    p->pipe.fragment = piped_nan_behind;
}
static void piped_two_rows(const void *uniforms, const shade_vertex_ids *SHADE_RESTRICT in,
                           shade_vertices *SHADE_RESTRICT out)
{
    piped_vertex(uniforms, in, out);
    for (int i = 0; i < SHADE_LANES; i++) out->varying[1][i] = 1;
}
static void piped_second_row(const void *uniforms, const shade_fragments *SHADE_RESTRICT in,
                             shade_colors *SHADE_RESTRICT out)
{
    (void)uniforms;
    for (int k = 0; k < 3; k++)
        for (int i = 0; i < SHADE_LANES; i++) out->color[k][i] = 0.5f + 0.25f * in->varying[1][i];
}
PIPED(varyings_too_few, OF_DRAW, "pipeline.varyings")
{
    p->pipe.vertex = piped_two_rows;
    p->pipe.fragment = piped_second_row;
}
PIPED(varyings_enough, OF_DRAW, "")
{
    piped_varyings_too_few(p);
    p->pipe.varyings = 2;
}
PIPED(varyings_for_others, OF_DRAW, "") { p->pipe.vertex = piped_two_rows; }
static void piped_first_vertex(const void *uniforms, const shade_vertex_ids *SHADE_RESTRICT in,
                               shade_vertices *SHADE_RESTRICT out)
{
    const piped_uniforms *u = (const piped_uniforms *)uniforms;
    const float *p = u->position + 3 * in->index[0];
    const shade_vec4 c = shade_mat4_transform(u->clip_from_world,
                                              shade_v4(p[0], p[1], p[2], 1));
    for (int k = 0; k < 4; k++) out->clip[k][0] = (&c.x)[k];
}
PIPED(vertex_of_lane_0, OF_DRAW, "writes lane 0") { p->pipe.vertex = piped_first_vertex; }
static void piped_first_fragment(const void *uniforms, const shade_fragments *SHADE_RESTRICT in,
                                 shade_colors *SHADE_RESTRICT out)
{
    const piped_uniforms *u = (const piped_uniforms *)uniforms;
    (void)in;
    for (int k = 0; k < 3; k++) out->color[k][0] = u->color[k];
}
PIPED(fragment_of_lane_0, OF_DRAW, "writes lane 0") { p->pipe.fragment = piped_first_fragment; }
PIPED(projection_forgotten, OF_DRAW | AFTERWARDS, "w is 1 everywhere")
{
    p->uniforms.clip_from_world = p->view;
}
static void piped_at_far(const void *uniforms, const shade_vertex_ids *SHADE_RESTRICT in,
                         shade_vertices *SHADE_RESTRICT out)
{
    piped_vertex(uniforms, in, out);
    for (int i = 0; i < SHADE_LANES; i++) out->clip[2][i] = out->clip[3][i];
}
PIPED(sky, OF_DRAW, "SHADE_COMPARE_LESS_EQUAL") { p->pipe.vertex = piped_at_far; }
PIPED(sky_that_passes, OF_DRAW, "")
{
    p->pipe.vertex = piped_at_far;
    p->pipe.raster.depth_test = SHADE_COMPARE_LESS_EQUAL;
}
PIPED(smaller_than_a_pixel, OF_DRAW, "too small on the screen")
{
    for (int k = 0; k < 3 * PIPED_CORNERS; k++) p->position[k] *= 1e-4f;
}
/* Right matrices of lines in view */
PIPED(oblique_near_plane, OF_LINES | AFTERWARDS, "")
{
    shade_mat4 *m = &p->lines.clip_from_points;
    for (int k = 0; k < 4; k++) (&m->col[k].x)[2] += 0.1f * (&m->col[k].x)[0];
}
PIPED(endless_tweaked, OF_LINES, "")
{
    piped_eye_at_the_origin(p);
    p->projection.col[2].z = 2.4e-7f - 1;
    p->projection.col[3].z = (2.4e-7f - 2) * 0.5f;
}
PIPED(homography, OF_LINES | AFTERWARDS, "")
{
    shade_mat4 m = shade_mat4_scaling(shade_v3(0.4f, 0.4f, 0.4f));
    m.col[0].w = 0.2f;
    m.col[1].w = 0.1f;
    p->lines.clip_from_points = m;
}
PIPED(no_state, OF_LINES, "state") { p->given_lines = NULL; }
PIPED(no_points, OF_LINES, "points") { p->points = NULL; }
PIPED(odd_points, OF_LINES, "point_count") { p->point_count = 23; }
PIPED(no_line, OF_LINES, "point_count is 0") { p->point_count = 0; }
PIPED(negative_width, OF_LINES, "state.width") { p->lines.width = -1; }
PIPED(width_nan, OF_LINES, "state.width") { p->lines.width = (float)NAN; }
PIPED(bad_cap, OF_LINES, "state.cap") { p->lines.cap = (shade_cap)5; }
PIPED(point_nan, OF_LINES, "NaN") { p->point[3].y = (float)NAN; }
PIPED(hairs, OF_LINES, "state.width") { p->lines.width = 1e-6f; }
PIPED(in_a_surface, OF_LINES | STATS_ALONE, "depth_bias")
{
    p->over_quad = 1;
    p->point_count = 2;
    p->point[0] = shade_v3(-0.5f, 0, 0);
    p->point[1] = shade_v3(0.5f, 0, 0);
    p->view = shade_mat4_look_at(shade_v3(0, 0, 5), shade_v3(0, 0, 0), shade_v3(0, 1, 0));
}
PIPED(behind_a_surface, OF_LINES, "")
{
    piped_in_a_surface(p);
    p->point[0].z = p->point[1].z = -1;
}
PIPED(color_forgotten, OF_LINES, "state.color") { p->lines.color = shade_v4(0, 0, 0, 0); }
PIPED(black_lines, OF_LINES, "") { p->lines.color = shade_v4(0, 0, 0, 1); }

PIPED(in_a_box, OF_BOTH, "") { p->projection = shade_mat4_ortho(-3, 3, -3, 3, 0, 20); }
PIPED(box_beside, OF_BOTH, "beside the picture")
{
    p->projection = shade_mat4_ortho(30, 33, -3, 3, 0, 20);
}

/* Mistakes that are made after the product of projection and view. */
PIPED(matrix_forgotten, OF_LINES | AFTERWARDS, "unset")
{
    for (int k = 0; k < PIPED_POINTS; k++) p->point[k] = shade_scale(p->point[k], 3);
    memset(&p->lines.clip_from_points, 0, sizeof p->lines.clip_from_points);
}
PIPED(no_matrix_needed, OF_LINES | AFTERWARDS, "")
{
    for (int k = 0; k < PIPED_POINTS; k++) p->point[k] = shade_scale(p->point[k], 0.5f);
    memset(&p->lines.clip_from_points, 0, sizeof p->lines.clip_from_points);
}
PIPED(matrix_of_no_camera, OF_LINES | AFTERWARDS, "")
{
    p->lines.clip_from_points.col[0].z += 0.3f;
}
PIPED(matrix_by_rows, OF_LINES | AFTERWARDS, "transposed")
{
    p->lines.clip_from_points = shade_mat4_transpose(p->lines.clip_from_points);
}
PIPED(matrix_by_rows_ahead, OF_LINES | AFTERWARDS, "transposed")
{
    p->view = shade_mat4_look_at(shade_v3(0, 0, 5), shade_v3(0, 0, 0), shade_v3(0, 1, 0));
    piped_aim(p);
    piped_matrix_by_rows(p);
}
/* Some lines are in view, and a homography may look like that. */
PIPED(matrix_of_a_box_by_rows, OF_LINES | AFTERWARDS, "")
{
    p->projection = shade_mat4_ortho(-5, 3, -4, 3, 3, 20);
    piped_aim(p);
    piped_matrix_by_rows(p);
}
PIPED(matrices_exchanged, OF_DRAW | AFTERWARDS, "projection times view")
{
    const shade_mat4 m = shade_mat4_mul(p->view, p->projection);
    p->lines.clip_from_points = p->uniforms.clip_from_world = m;
}
PIPED(matrices_exchanged_ahead, OF_LINES | AFTERWARDS, "view times projection")
{
    p->view = shade_mat4_look_at(shade_v3(0, 0, 5), shade_v3(0, 0, 0), shade_v3(0, 1, 0));
    piped_matrices_exchanged(p);
}
PIPED_IN(matrices_exchanged, exchanged_of_lines, OF_LINES | AFTERWARDS, "view times projection")

/* More of newcomers */
PIPED(height_forgotten, OF_BOTH, "target.width") { p->target.height = 0; }
PIPED(stride_too_small, OF_BOTH, "target.stride") { p->target.stride = PIPED_W - 1; }
PIPED(bad_format, OF_BOTH, "target.format") { p->target.format = (shade_format)99; }
PIPED(clip_width_alone, OF_BOTH, "clip_height") { p->target.clip_width = PIPED_W; }
PIPED(clip_negative, OF_BOTH, "clip") { p->target.clip_width = -5; }
PIPED(strip_without_rows, OF_BOTH, "row_count") { p->target.row_offset = 3; }
PIPED(aspect_zero, OF_BOTH, "an aspect of 0")
{
    p->projection = shade_mat4_perspective(0.8f, 0, 0.5f, 30);
}
PIPED(fovy_zero, OF_BOTH, "beyond the far plane")
{
    p->projection = shade_mat4_perspective(0, 1, 0.5f, 30);
}
PIPED(ortho_empty, OF_BOTH, "beyond the far plane")
{
    p->projection = shade_mat4_ortho(1, 1, -1, 1, 0.1f, 20);
}
PIPED(eye_at_its_center, OF_DRAW, "w is 0 everywhere")
{
    p->view = shade_mat4_look_at(shade_v3(0, 0, 0), shade_v3(0, 0, 0), shade_v3(0, 1, 0));
}
PIPED_IN(eye_at_its_center, lines_of_an_eye_at_its_center, OF_LINES, "where the camera looks")
PIPED(view_inverted, OF_BOTH, "behind the eye") { p->view = shade_mat4_inverse(p->view); }
PIPED(projection_infinite, OF_BOTH, "infinite") { p->projection.col[0].x = INFINITY; }
PIPED(bias_of_one, OF_BOTH, "raster.depth_bias")
{
    p->pipe.raster.depth_bias = p->lines.raster.depth_bias = 1;
}
PIPED(near_and_far_exchanged, OF_BOTH | SILENT, "")
{
    p->projection = shade_mat4_perspective(0.8f, (float)PIPED_W / PIPED_H, 30, 0.5f);
}
PIPED(aspect_of_a_square, OF_BOTH | SILENT, "")
{
    p->projection = shade_mat4_perspective(0.8f, 1, 0.5f, 30);
}
PIPED(varyings_negative, OF_DRAW, "pipeline.varyings") { p->pipe.varyings = -1; }
PIPED(varyings_forgotten, OF_DRAW, "pipeline.varyings")
{
    piped_varyings_too_few(p);
    p->pipe.varyings = 0;
}
PIPED(positions_never_filled, OF_DRAW, "coincide") { memset(p->position, 0, sizeof p->position); }
PIPED(upside_down, OF_DRAW, "SHADE_CULL_BACK")    /* as Vulkan has it */
{
    p->projection.col[1].y *= -1;
    p->pipe.raster.cull = SHADE_CULL_BACK;
}
static void piped_in_pixels(const void *uniforms, const shade_vertex_ids *SHADE_RESTRICT in,
                            shade_vertices *SHADE_RESTRICT out)
{
    piped_vertex(uniforms, in, out);
    for (int i = 0; i < SHADE_LANES; i++) {
        out->clip[0][i] = (out->clip[0][i] / out->clip[3][i] + 2) * PIPED_W;
        out->clip[1][i] = (out->clip[1][i] / out->clip[3][i] + 2) * PIPED_H;
        out->clip[2][i] = 0;
        out->clip[3][i] = 1;
    }
}
PIPED(writes_pixels, OF_DRAW, "w is 1 everywhere") { p->pipe.vertex = piped_in_pixels; }
static void piped_divided(const void *uniforms, const shade_vertex_ids *SHADE_RESTRICT in,
                          shade_vertices *SHADE_RESTRICT out)
{
    piped_vertex(uniforms, in, out);
    for (int i = 0; i < SHADE_LANES; i++)
        for (int k = 0; k < 4; k++) out->clip[k][i] /= out->clip[3][i];
}
PIPED(divides_by_w, OF_DRAW | SILENT, "") { p->pipe.vertex = piped_divided; }
PIPED(divides_by_zero, OF_DRAW, "NaN")
{
    p->pipe.vertex = piped_divided;
    memset(&p->projection, 0, sizeof p->projection);
}
PIPED(width_of_a_hundredth, OF_LINES, "state.width") { p->lines.width = 1e-3f; }
PIPED(count_of_lines, OF_LINES | SILENT, "") { p->point_count /= 2; }
PIPED(points_of_a_strip, OF_LINES | SILENT, "")
{
    for (int k = 2; k < p->point_count; k += 2) p->point[k] = p->point[k - 1];
}
PIPED(points_never_filled, OF_LINES, "coincide") { memset(p->point, 0, sizeof p->point); }
PIPED(lines_without_projection, OF_LINES | AFTERWARDS, "outside the cube")
{
    p->lines.clip_from_points = p->view;
}

TEST(explain_pipelines, each_mistake_gets_its_sentence)
{
    for (const piped_mistake *m = piped_mistake_first; m; m = m->next)
        for (int lines = 0; lines < 2; lines++) {
            const char *said[2];
            if (!(m->of & (lines ? OF_LINES : OF_DRAW))) continue;
            piped *p = piped_open();
            if (!(m->of & AFTERWARDS)) m->make(p);
            piped_aim(p);
            if (m->of & AFTERWARDS) m->make(p);
            piped_say(p, lines, said);
            for (int k = 0; k < 2; k++) {
                const char *want = k && (m->of & STATS_ALONE) ? "" : m->words;
                CHECK_SAY(*want ? strstr(said[k], want) != NULL : !*said[k],
                          "%s, %s, %s stats: \"%s\"", m->name, lines ? "lines" : "draw",
                          k ? "without" : "with", said[k]);
            }
            free(p);
        }
}

/* A mistake of both draws counts once. */
TEST(explain_pipelines, few_mistakes_are_silent)
{
    int all = 0, silent = 0;
    for (const piped_mistake *m = piped_mistake_first; m; m = m->next) {
        CHECK(!(m->of & SILENT) || !*m->words);
        silent += (m->of & SILENT) != 0;
        all += *m->words || m->of & SILENT;
    }
    printf("explain: of %d mistakes with pipelines and lines %d are silent\n", all, silent);
    CHECK_SAY(all >= 76 && silent <= 9, "%d, %d", all, silent);
}

/* Depth first, and then the pixels that have it: both passes are right, and so is a count of what
   shows.  A pass without depth can do nothing. */
TEST(explain_pipelines, passes_for_depth_alone_are_right)
{
    piped *p = piped_open();
    shade_stats stats;
    piped_aim(p);
    for (int k = 0; k < PIPED_W * PIPED_H; k++) p->depth[k] = 1;
    for (int pass = 0; pass < 3; pass++) {
        p->pipe.fragment = pass == 1 ? piped_fragment : NULL;
        p->pipe.raster.depth_test = pass ? SHADE_COMPARE_EQUAL : SHADE_COMPARE_LESS;
        p->pipe.raster.depth_read_only = pass == 2;
        piped_draw(p, 0, &stats);
        CHECK(stats.fragments > 0 && !*piped_explain(p, 0, &stats) && !*piped_explain(p, 0, NULL));
    }
    p->target.depth = NULL;
    CHECK(strstr(piped_explain(p, 0, &stats), "pipeline.fragment is NULL"));
    free(p);
}

/* ---- any draws: each sentence is true, and its advice changes the picture

   The oracle draws with the public functions, with what the sentence blames put right, and places
   vertices in double.  It shares no code with what explains. */

static void piped_refill(piped *p, uint32_t pixel)
{
    for (int k = 0; k < PIPED_W * PIPED_H; k++) {
        p->pixels[k] = pixel;
        p->depth[k] = p->clear;
    }
}

/* Draws with what is in p, over pixels of this kind. */
static shade_stats piped_stats(piped *p, int lines, uint32_t pixel)
{
    shade_stats stats;
    piped_refill(p, pixel);
    piped_draw(p, lines, &stats);
    return stats;
}

static long long piped_fragments(const piped *given, int lines, void (*change)(piped *p))
{
    static piped p;
    p = *given;
    p.target.color = p.pixels;
    if (given->target.depth) p.target.depth = p.depth;
    p.uniforms.position = p.position;
    p.pipe.uniforms = &p.uniforms;
    p.given_target = &p.target;
    p.given_pipe = &p.pipe;
    p.given_lines = &p.lines;
    p.points = p.point;
    if (p.indices) p.indices = p.index;
    change(&p);
    return piped_stats(&p, lines, 0).fragments;
}

static void piped_without_depth(piped *p) { p->target.depth = NULL; }
static void piped_without_clip(piped *p)
{
    p->pipe.may_discard = 0;
    p->target.clip_x = p->target.clip_y = p->target.clip_width = p->target.clip_height = 0;
    p->target.depth = NULL;
}
static void piped_without_cull(piped *p)
{
    piped_without_clip(p);
    p->pipe.raster.cull = SHADE_CULL_NONE;
}
static void piped_undiscarded(piped *p) { p->target.depth = NULL; p->uniforms.discards = 0; }
static void piped_discarding(piped *p) { p->target.depth = NULL; p->pipe.may_discard = 1; }
static void piped_cleared(piped *p)
{
    const shade_compare test = p->pipe.raster.depth_test;
    p->clear = test == SHADE_COMPARE_GREATER || test == SHADE_COMPARE_GREATER_EQUAL ? 0.0f : 1.0f;
}
static void piped_biased(piped *p)
{
    const int greater = p->clear < 0.5f;
    p->lines.raster.depth_test = greater ? SHADE_COMPARE_GREATER_EQUAL : SHADE_COMPARE_LESS_EQUAL;
    p->lines.raster.depth_bias = greater ? 1e-4f : -1e-4f;
}
static void piped_by_columns(piped *p) { piped_matrix_by_rows(p); piped_without_clip(p); }

/* Of the pixels that differ from `pixel` after the draw, are so many tenths black, or with `full`,
   full in a channel?  No pixel differs: yes. */
static int piped_are_alike(piped *p, int lines, uint32_t pixel, int full, int tenths)
{
    int n = 0, alike = 0;
    piped_stats(p, lines, pixel);
    for (int k = 0; k < PIPED_W * PIPED_H; k++) {
        const uint32_t c = p->pixels[k];
        if (c == pixel) continue;
        n++;
        alike += full ? (c & 255) == 255 || (c >> 8 & 255) == 255 || (c >> 16 & 255) == 255
                      : !(c & 0xFFFFFF);
    }
    return alike * 10 >= n * tenths;
}

/* Does the draw change a picture of such pixels? */
static int piped_changes(piped *p, int lines, uint32_t pixel)
{
    int changed = 0;
    piped_stats(p, lines, pixel);
    for (int k = 0; k < PIPED_W * PIPED_H; k++) changed |= p->pixels[k] != pixel;
    return changed;
}

/* Do all positions lie on the outer side of a plane, within rounding?  0: w = 0; 1: z = -w or, with
   z from 0 to w, z = 0; 2: z = w */
static int piped_beyond(const piped *p, int lines, int plane)
{
    const dmat m = dmat_from(lines ? p->lines.clip_from_points : p->uniforms.clip_from_world);
    const int half = (lines ? p->lines.raster : p->pipe.raster).depth_zero_to_one;
    for (int k = 0; k < (lines ? p->point_count : p->index_count); k++) {
        const float *v = &p->point[k].x;
        double in[4] = { 0, 0, 0, 1 }, c[4];
        if (!lines) v = p->position + 3 * (p->indices ? p->index[k] : (uint32_t)k);
        for (int i = 0; i < 3; i++) in[i] = (double)v[i];
        dmat_apply(m, in, c);
        if (!lines && p->uniforms.keeps_w) c[3] = 0;
        const double near = (half ? 0 : -c[3]) - c[2], far = c[2] - c[3];
        const double beyond = plane == 0 ? -c[3] : plane == 1 ? near : far;
        if (beyond < -1e-5 * (fabs(c[2]) + fabs(c[3]) + 1)) return 0;
    }
    return 1;
}

/* Is w 1 at all vertices that are drawn? */
static int piped_w_is_one(const piped *p)
{
    const shade_mat4 *m = &p->uniforms.clip_from_world;
    return !p->uniforms.keeps_w && m->col[0].w == 0 && m->col[1].w == 0 && m->col[2].w == 0 &&
           m->col[3].w == 1;
}

static int piped_is_greater(const piped *p)
{
    return p->pipe.raster.depth_test == SHADE_COMPARE_GREATER ||
           p->pipe.raster.depth_test == SHADE_COMPARE_GREATER_EQUAL;
}

/* Is a sentence true of the draw?  exchanged, by_rows: how the matrix of lines was made. */
static int piped_is_true(piped *p, int lines, const char *said, int exchanged, int by_rows)
{
    const shade_stats stats = piped_stats(p, lines, 0xFF302010u);
    const long long got = stats.fragments;
    if (strstr(said, "beside the clip rectangle"))
        return !piped_fragments(p, lines, piped_without_depth) &&
               piped_fragments(p, lines, piped_without_clip);
    if (strstr(said, "raster.cull is"))
        return !got && !piped_fragments(p, lines, piped_without_clip) &&
               piped_fragments(p, lines, piped_without_cull);
    if (strstr(said, "NaN, infinite")) return stats.rejected > 0;
    if (strstr(said, "beyond the far plane"))
        return !got && piped_beyond(p, lines, piped_is_greater(p) ? 1 : 2);
    if (strstr(said, "behind the eye, where")) return !got && piped_beyond(p, lines, 0);
    if (strstr(said, "nearer than the near plane"))
        return !got && (piped_beyond(p, lines, 1) || piped_beyond(p, lines, 2));
    if (strstr(said, "and w is 1"))
        return !got && stats.clipped == stats.triangles && piped_w_is_one(p);
    if (strstr(said, "beside the picture, before")) return stats.clipped == stats.triangles;
    if (strstr(said, "pixel centre"))
        return !piped_fragments(p, lines, piped_without_cull) && stats.clipped < stats.triangles;
    if (strstr(said, "w is 0")) return !got && piped_beyond(p, lines, 0);
    if (strstr(said, "discards all")) return !got && piped_fragments(p, lines, piped_undiscarded);
    if (strstr(said, "is SHADE_COMPARE_EQUAL"))
        return !got && piped_fragments(p, lines, piped_without_depth);
    if (strstr(said, "shade_clear before drawing"))
        return !got && piped_fragments(p, lines, piped_cleared);
    if (strstr(said, "is hidden by depth"))
        return !got && piped_fragments(p, lines, piped_without_depth);
    if (strstr(said, "lie in surfaces")) return !got && piped_fragments(p, lines, piped_biased);
    if (strstr(said, "fragment is NULL")) {
        float depth[PIPED_W * PIPED_H];
        memcpy(depth, p->depth, sizeof depth);
        piped_refill(p, 0);
        return !p->pipe.fragment && !memcmp(depth, p->depth, sizeof depth);
    }
    if (strstr(said, "sets discard"))
        return piped_fragments(p, 0, piped_discarding) < piped_fragments(p, 0, piped_without_depth);
    if (strstr(said, "Alpha is 0") || strstr(said, "adds nothing"))
        return got && !piped_changes(p, lines, 0xFF302010u);
    if (strstr(said, "gives black") || strstr(said, "color is not set"))
        return got && piped_changes(p, lines, 0xFFFFFFFFu) &&
               piped_are_alike(p, lines, 0xFFFFFFFFu, 0, 10);
    if (strstr(said, "which is stored as black"))
        return isnan(p->uniforms.color[0] + p->uniforms.color[1] + p->uniforms.color[2]);
    if (strstr(said, "255"))
        return piped_are_alike(p, lines, 0xFF000000u, 1, 9);
    if (strstr(said, "transposed")) return by_rows && piped_fragments(p, 1, piped_by_columns);
    if (strstr(said, "view times projection")) return exchanged;
    return strstr(said, "unset") && stats.clipped == stats.triangles;
}

static shade_compare random_compare(void)
{
    return rnd_one_in(2) ? SHADE_COMPARE_LESS : (shade_compare)rnd_int(0, SHADE_COMPARE_ALWAYS);
}

/* Changes one thing, as a mistake does or not. */
static void piped_spoil(piped *p)
{
    shade_raster *r[2] = { &p->pipe.raster, &p->lines.raster };
    const float colors[] = { 0, 0, 1, 0.25f, 255, (float)NAN };
    const float n = rnd_log(0.1, 20);
    switch (rnd_int(0, 15)) {
    case 0: r[0]->depth_test = r[1]->depth_test = random_compare(); break;
    case 1: r[0]->blend = r[1]->blend = (shade_blend)rnd_int(0, SHADE_BLEND_ADD); break;
    case 2: r[0]->cull = r[1]->cull = (shade_cull)rnd_int(0, SHADE_CULL_FRONT); break;
    case 3: p->clear = rnd_one_in(3) ? (float)NAN : rnd_one_in(2) ? 0.0f : rnd_float(0, 1); break;
    case 4:
        for (int k = 0; k < 3; k++) p->uniforms.color[k] = colors[rnd_int(0, 5)];
        p->lines.color = shade_v4(p->uniforms.color[0], p->uniforms.color[1], p->uniforms.color[2],
                                  p->lines.color.w);
        break;
    case 5: p->uniforms.color[3] = p->lines.color.w = rnd_one_in(2) ? 0.0f : rnd_float(0, 1); break;
    case 6: p->uniforms.discards = rnd_int(0, 2); break;
    case 7: p->pipe.may_discard = 1; break;
    case 8: if (rnd_one_in(3)) p->pipe.fragment = NULL; break;
    case 9: p->target.depth = NULL; break;
    case 10:
        p->target.clip_x = rnd_int(0, PIPED_W - 1);
        p->target.clip_y = rnd_int(0, PIPED_H - 1);
        p->target.clip_width = rnd_int(1, PIPED_W);
        p->target.clip_height = rnd_int(1, PIPED_H);
        break;
    case 11:
        p->view = shade_mat4_look_at(random_vector(rnd_one_in(2) ? 6 : 60), random_vector(3),
                                     random_vector(1));
        break;
    case 12:
        p->projection = shade_mat4_perspective(rnd_float(0.2, 2), 1.3f, n, n * rnd_log(1.5, 99));
        break;
    case 13:
        p->projection = shade_mat4_ortho(-n, n, -n, n, rnd_float(0, 9), rnd_float(9, 20));
        break;
    case 14:
        r[0]->depth_zero_to_one = r[1]->depth_zero_to_one = 1;
        if (rnd_one_in(2)) r[0]->depth_test = r[1]->depth_test = SHADE_COMPARE_GREATER;
        if (rnd_one_in(2)) p->clear = 0;
        p->projection = shade_mat4_perspective_reversed(0.8f, 1.3f, n);
        break;
    default:
        for (int k = 0; k < 3 * PIPED_CORNERS; k++) p->position[k] = rnd_float(-2, 2);
        for (int k = 0; k < PIPED_POINTS; k++) p->point[k] = random_vector(2);
        if (rnd_one_in(4)) p->position[rnd_int(0, 17)] = p->point[5].y = (float)NAN;
        if (rnd_one_in(2)) p->lines.width = rnd_log(0.001, 20);
        for (int k = 0; k < PIPED_CORNERS; k++)
            p->index[k] = (uint32_t)rnd_int(0, PIPED_CORNERS - 1);
        break;
    }
}

TEST(explain_pipelines, what_is_said_of_any_draw_is_true)
{
    long said_something = 0, nothing_seen = 0;
    const int draws = 2 * test_rounds(2000); /* half of them of lines */
    for (int i = 0; i < draws; i++) {
        const int lines = i % 2;
        int exchanged = 0, by_rows = 0;
        const char *said[2];
        piped *p = piped_open();
        for (int n = rnd_int(0, 4); n > 0; n--) piped_spoil(p);
        piped_aim(p);
        p->uniforms.keeps_w = rnd_one_in(30);
        if (lines && rnd_one_in(12)) {
            exchanged = 1;
            p->lines.clip_from_points = shade_mat4_mul(p->view, p->projection);
        } else if (lines && rnd_one_in(12)) {
            by_rows = 1;
            piped_matrix_by_rows(p);
        }
        if (piped_say(p, lines, said) != SHADE_OK) {
            CHECK(*said[0] && *said[1]);
            free(p);
            continue;
        }
        for (int k = 0; k < 2; k++) {
            if (!*said[k]) continue;
            said_something++;
            CHECK_SAY(piped_is_true(p, lines, said[k], exchanged, by_rows),
                      "draw %d, %s: \"%s\"", i, lines ? "lines" : "triangles", said[k]);
        }
        /* a picture without a pixel is not left without a sentence, but in a band */
        if (!piped_stats(p, lines, 0).fragments) {
            const int band = p->target.clip_width &&
                             (p->target.clip_x + p->target.clip_width >= PIPED_W ||
                              p->target.clip_y + p->target.clip_height >= PIPED_H);
            nothing_seen++;
            CHECK_SAY(*said[0] || band, "draw %d, %s: silent", i, lines ? "lines" : "triangles");
        }
        free(p);
    }
    printf("explain: %ld sentences of %d lines and %d pipelines\n", said_something, draws / 2,
           draws / 2);
    CHECK_SAY(said_something > draws / 2 && nothing_seen > draws * 3 / 20, "%ld, %ld",
              said_something, nothing_seen);
}
