/* explain.c - shade_explain: each mistake, made on a good scene, gets a sentence that names the
   field to look at; good scenes get none; what is said of random draws is so; hostile ones cost no
   memory and no crash. */
#include "unit.h"
static int explained_pick(int n) { return rnd_int(0, n - 1); }
#include "../fuzz/explained.h"

enum { STAGE_RINGS = 12, STAGE_SECTORS = 16, STAGE_WIDTH = 96, STAGE_HEIGHT = 64 };
enum { STAGE_VERTICES = (STAGE_RINGS + 1) * (STAGE_SECTORS + 1) };
enum { STAGE_INDICES = STAGE_RINGS * STAGE_SECTORS * 6 };

typedef struct stage {
    canvas c;
    shade_mesh mesh;
    shade_draw_state state;
    shade_material material;
    shade_light lamps[2];
    shade_texture map;
    shade_chunk chunk;
    shade_vec3 position[STAGE_VERTICES], normal[STAGE_VERTICES], color[STAGE_VERTICES];
    shade_vec2 texcoord[STAGE_VERTICES];
    uint32_t index[STAGE_INDICES];
    unsigned char texel[4 * 4];
    shade_target good;           /* the target that c was opened with */
    float clear;                 /* depth before the draw; NaN: shade_clear is not called */
    int draws;
    int no_target, no_mesh, no_state;
} stage;

/* A ball of radius 1 around the origin, wound counter-clockwise as seen from outside. */
static void stage_ball(stage *s)
{
    int n = 0;
    for (int j = 0; j <= STAGE_RINGS; j++)
        for (int i = 0; i <= STAGE_SECTORS; i++) {
            const double a = i % STAGE_SECTORS * 6.283185307179586 / STAGE_SECTORS;
            const double b = j * 3.141592653589793 / STAGE_RINGS;
            const double r = j % STAGE_RINGS ? sin(b) : 0;
            const int k = j * (STAGE_SECTORS + 1) + i;
            s->position[k] = shade_v3((float)(r * sin(a)), (float)cos(b), (float)(r * cos(a)));
            s->normal[k] = s->position[k];
            s->color[k] = shade_v3(0.5f, 0.5f, 0.5f);
            s->texcoord[k] = shade_v2((float)i / STAGE_SECTORS, (float)j / STAGE_RINGS);
        }
    for (uint32_t j = 0; j < STAGE_RINGS; j++)
        for (uint32_t i = 0; i < STAGE_SECTORS; i++) {
            const uint32_t a = j * (STAGE_SECTORS + 1) + i, b = a + STAGE_SECTORS + 1;
            const uint32_t corner[6] = { a, b, b + 1, a, b + 1, a + 1 };
            memcpy(s->index + n, corner, sizeof corner);
            n += 6;
        }
}
static stage *stage_open(void)
{
    stage *s = (stage *)calloc(1, sizeof *s);
    if (!s) exit(2);
    s->c = canvas_open(STAGE_WIDTH, STAGE_HEIGHT, STAGE_WIDTH + 3, SHADE_FORMAT_RGBA8, 1);
    s->good = s->c.target;
    stage_ball(s);
    s->mesh.positions = &s->position[0].x;
    s->mesh.normals = &s->normal[0].x;
    s->mesh.vertex_count = STAGE_VERTICES;
    s->mesh.indices = s->index;
    s->mesh.index_count = STAGE_INDICES;
    s->chunk.count = STAGE_INDICES / 3;
    s->material.diffuse = s->material.ambient = shade_v3(0.6f, 0.5f, 0.4f);
    s->material.specular = shade_v3(0.3f, 0.3f, 0.3f);
    s->material.shininess = 30;
    s->lamps[0] = shade_point_light(shade_v3(3, 4, 6), shade_v3(1, 1, 1));
    s->lamps[1] = shade_directional_light(shade_v3(1, -1, -1), shade_v3(0.3f, 0.3f, 0.3f));
    memset(s->texel, 255, sizeof s->texel);
    s->map.pixels = s->texel;
    s->map.width = s->map.height = 2;
    s->state.view = shade_mat4_look_at(shade_v3(0, 1, 4), shade_v3(0, 0, 0), shade_v3(0, 1, 0));
    s->state.projection = shade_mat4_perspective(0.8f, 1.5f, 0.1f, 100);
    s->state.material = &s->material;
    s->state.lighting.lights = s->lamps;
    s->state.lighting.light_count = 2;
    s->clear = 1;
    s->draws = 1;
    return s;
}
static void stage_close(stage *s)
{
    s->c.target = s->good;
    canvas_close(&s->c);
    free(s);
}
/* Draws as the stage says and explains it; stats NULL where they are not to be known.  The buffers
   are the same before and after the explanation. */
static const char *stage_explain(stage *s, int with_stats)
{
    const shade_target *t = s->no_target ? NULL : &s->c.target;
    const shade_mesh *m = s->no_mesh ? NULL : &s->mesh;
    const shade_draw_state *d = s->no_state ? NULL : &s->state;
    shade_stats stats;
    const char *said;
    if (s->clear == s->clear) shade_clear(&s->c.target, shade_v4(0, 0, 0, 1), s->clear);
    for (int k = 0; k < s->draws; k++) shade_draw_mesh(t, m, d, &stats);
    said = shade_explain(t, m, d, with_stats ? &stats : NULL);
    CHECK(said != NULL);
    return said ? said : "NULL";
}

/* ------------------------------------------------------------------------------------ mistakes */

#define MISTAKE(name) static void mistake_##name(stage *s)
#define SUN shade_directional_light(shade_v3(0, -1, -4), shade_v3(1, 1, 1))

MISTAKE(target_null) { s->no_target = 1; }
MISTAKE(mesh_null) { s->no_mesh = 1; }
MISTAKE(state_null) { s->no_state = 1; }
MISTAKE(no_memory)
{
    s->c.target.color = NULL;
    s->c.target.depth = NULL;
    s->clear = NAN;
}
MISTAKE(width_zero) { s->c.target.width = 0; }
MISTAKE(stride_in_half_pixels) { s->c.target.stride = STAGE_WIDTH / 2; }
MISTAKE(format_a8) { s->c.target.format = SHADE_FORMAT_A8; }
MISTAKE(clip_negative) { s->c.target.clip_width = -1; }
MISTAKE(strip_without_rows) { s->c.target.row_offset = 3; }
MISTAKE(positions_null) { s->mesh.positions = NULL; }
MISTAKE(vertex_count_negative) { s->mesh.vertex_count = -3; }
MISTAKE(index_count_negative) { s->mesh.index_count = -3; }
MISTAKE(stride_of_three_floats) { s->mesh.position_stride = 3; }
MISTAKE(stride_of_eight_floats) { s->mesh.position_stride = 8; }
MISTAKE(chunks_null) { s->mesh.chunk_count = 2; }
MISTAKE(chunk_outside)
{
    s->mesh.chunks = &s->chunk;
    s->mesh.chunk_count = 1;
    s->chunk.first = 1;
}
MISTAKE(chunks_of_another_mesh)
{
    s->mesh.chunks = &s->chunk;
    s->mesh.chunk_count = 1;
    s->chunk.low = shade_v3(9, 9, 9);
    s->chunk.high = shade_v3(10, 10, 10);
}
MISTAKE(shading_unknown) { s->state.shading = (shade_shading)7; }
MISTAKE(transparency_in_percent) { s->state.transparency = 50; }
MISTAKE(cutoff_of_128) { s->state.alpha_cutoff = 128; }
MISTAKE(cull_unknown) { s->state.raster.cull = (shade_cull)1028; }
MISTAKE(depth_test_unknown) { s->state.raster.depth_test = (shade_compare)513; }
MISTAKE(blend_unknown) { s->state.raster.blend = (shade_blend)770; }
MISTAKE(bias_nan) { s->state.raster.depth_bias = NAN; }
MISTAKE(lights_null) { s->state.lighting.lights = NULL; }
MISTAKE(model_unknown) { s->state.lighting.model = (shade_model)44; }
MISTAKE(map_without_pixels)
{
    s->map.pixels = NULL;
    s->mesh.texcoords = &s->texcoord[0].x;
    s->state.diffuse_map = &s->map;
}
MISTAKE(index_beyond) { s->index[77] = STAGE_VERTICES; }
MISTAKE(index_count_odd) { s->mesh.index_count = STAGE_INDICES - 1; }
MISTAKE(vertices_not_in_threes)
{
    s->mesh.indices = NULL;
    s->mesh.vertex_count = 100;
}
MISTAKE(index_count_forgotten) { s->mesh.index_count = 0; }
MISTAKE(vertex_count_forgotten)
{
    s->mesh.indices = NULL;
    s->mesh.vertex_count = 0;
}
MISTAKE(chunk_count_forgotten) { s->mesh.chunks = &s->chunk; }

MISTAKE(fovy_in_degrees) { s->state.projection = shade_mat4_perspective(45, 1.5f, 0.1f, 100); }
MISTAKE(near_zero) { s->state.projection = shade_mat4_perspective(0.8f, 1.5f, 0, 100); }
MISTAKE(near_is_far) { s->state.projection = shade_mat4_perspective(0.8f, 1.5f, 5, 5); }
MISTAKE(aspect_zero) { s->state.projection = shade_mat4_perspective(0.8f, 2 / 3, 0.1f, 100); }
MISTAKE(ortho_empty) { s->state.projection = shade_mat4_ortho(1, 1, -1, 1, 0.1f, 9); }
MISTAKE(swapped)
{
    const shade_mat4 m = s->state.view;
    s->state.view = s->state.projection;
    s->state.projection = m;
}
MISTAKE(swapped_ortho)
{
    s->state.projection = s->state.view;
    s->state.view = shade_mat4_ortho(-2, 2, -2, 2, 0.1f, 100);
}
MISTAKE(projection_in_view)
{
    s->state.view = shade_mat4_mul(s->state.projection, s->state.view);
    memset(&s->state.projection, 0, sizeof s->state.projection);
}
MISTAKE(view_by_rows) { s->state.view = shade_mat4_transpose(s->state.view); }
MISTAKE(projection_by_rows) { s->state.projection = shade_mat4_transpose(s->state.projection); }
MISTAKE(model_by_rows)
{
    s->state.model = shade_mat4_transpose(shade_mat4_translation(shade_v3(0.5f, 0, 0)));
}
MISTAKE(all_by_rows)
{
    mistake_view_by_rows(s);
    mistake_projection_by_rows(s);
}
MISTAKE(ortho_by_rows)
{
    s->state.projection = shade_mat4_transpose(shade_mat4_ortho(-3, 1, -1, 1, 0.01f, 0.1f));
}
MISTAKE(projection_forgotten)
{
    memset(&s->state.projection, 0, sizeof s->state.projection);
}
MISTAKE(view_inverted) { s->state.view = shade_mat4_inverse(s->state.view); }
MISTAKE(looks_away)
{
    s->state.view = shade_mat4_look_at(shade_v3(0, 0, 4), shade_v3(0, 0, 8), shade_v3(0, 1, 0));
}
MISTAKE(beyond_far) { s->state.projection = shade_mat4_perspective(0.8f, 1.5f, 0.1f, 2); }
MISTAKE(beyond_far_where_the_inverse_looks)
{
    s->state.view = shade_mat4_translation(shade_v3(0, 0, -4));
    s->state.projection = shade_mat4_perspective(0.8f, 1.5f, 0.1f, 20);
    s->state.model = shade_mat4_translation(shade_v3(0, 0, -20));
}
MISTAKE(before_near) { s->state.projection = shade_mat4_perspective(0.8f, 1.5f, 50, 100); }
MISTAKE(beside) { s->state.model = shade_mat4_translation(shade_v3(50, 0, 0)); }
MISTAKE(left_handed) { s->state.model = shade_mat4_translation(shade_v3(0, 0, 8)); }
MISTAKE(model_nan) { s->state.model = shade_mat4_scaling(shade_v3(1, NAN, 1)); }
MISTAKE(view_infinite) { s->state.view.col[3].x = INFINITY; }
MISTAKE(projection_nan) { s->state.projection.col[0].x = NAN; }
MISTAKE(reversed_flag_forgotten)
{
    s->state.projection = shade_mat4_perspective_reversed(0.8f, 1.5f, 0.1f);
    s->state.raster.depth_test = SHADE_COMPARE_GREATER;
    s->clear = 0;
}
MISTAKE(positions_nan)
{
    for (int i = 0; i < STAGE_VERTICES; i++) s->position[i].y = NAN;
}
MISTAKE(one_position_nan) { s->position[40].x = INFINITY; }
MISTAKE(scaled_to_nothing) { s->state.model = shade_mat4_scaling(shade_v3(0, 0, 0)); }
MISTAKE(far_too_small) { s->state.model = shade_mat4_scaling(shade_v3(1e-6f, 1e-6f, 1e-6f)); }
MISTAKE(one_index_everywhere) { memset(s->index, 0, sizeof s->index); }

MISTAKE(wound_clockwise_quad)
{
    static const uint32_t clockwise[6] = { 0, 2, 1, 0, 3, 2 };
    static const shade_vec3 quad[4] = { { -1, -1, 0 }, { 1, -1, 0 }, { 1, 1, 0 }, { -1, 1, 0 } };
    memcpy(s->position, quad, sizeof quad);
    memcpy(s->index, clockwise, sizeof clockwise);
    s->mesh.index_count = 6;
    s->state.raster.cull = SHADE_CULL_BACK;
}
MISTAKE(culled_by_mirror)
{
    mistake_wound_clockwise_quad(s);
    s->index[1] = 1;
    s->index[2] = 2;
    s->index[4] = 2;
    s->index[5] = 3;
    s->state.model = shade_mat4_scaling(shade_v3(-1, 1, 1));
}
MISTAKE(culled_front)
{
    mistake_wound_clockwise_quad(s);
    s->index[1] = 1;
    s->index[2] = 2;
    s->index[4] = 2;
    s->index[5] = 3;
    s->state.raster.cull = SHADE_CULL_FRONT;
}
MISTAKE(culled_inside)
{
    s->state.raster.cull = SHADE_CULL_BACK;
    s->state.view = shade_mat4_look_at(shade_v3(0, 0, 0), shade_v3(0, 0, -1), shade_v3(0, 1, 0));
}
MISTAKE(culled_inside_with_chunks)
{
    mistake_culled_inside(s);
    s->mesh.chunks = &s->chunk;
    s->mesh.chunk_count = 1;
    s->chunk.low = shade_v3(-1, -1, -1);
    s->chunk.high = shade_v3(1, 1, 1);
}
/* Winds the triangles the other way from an index on, and culls back faces. */
static void stage_turn(stage *s, int first)
{
    for (int i = first; i < STAGE_INDICES; i += 3) {
        const uint32_t k = s->index[i];
        s->index[i] = s->index[i + 1];
        s->index[i + 1] = k;
    }
    s->state.raster.cull = SHADE_CULL_BACK;
}
MISTAKE(inside_out) { stage_turn(s, 0); }
/* Rings from the far one to the near one, and the other way: fronts are drawn first, or last. */
MISTAKE(inside_out_from_below)
{
    s->state.view = shade_mat4_look_at(shade_v3(0, -4, 0.1f), shade_v3(0, 0, 0), shade_v3(0, 0, 1));
    mistake_inside_out(s);
}
MISTAKE(inside_out_from_above)
{
    s->state.view = shade_mat4_look_at(shade_v3(0, 4, 0.1f), shade_v3(0, 0, 0), shade_v3(0, 0, 1));
    mistake_inside_out(s);
}
MISTAKE(inside_out_with_a_bias)
{
    mistake_inside_out(s);
    s->state.raster.depth_bias = -1;
}
MISTAKE(inside_out_open)
{
    s->mesh.index_count = STAGE_INDICES * 2 / 3;
    mistake_inside_out(s);
}
MISTAKE(mirrored_open)
{
    s->mesh.index_count = STAGE_INDICES * 2 / 3;
    s->state.model = shade_mat4_scaling(shade_v3(1, 1, -1));
    s->state.raster.cull = SHADE_CULL_BACK;
}
MISTAKE(inside_out_without_normals)
{
    s->mesh.normals = NULL;
    mistake_inside_out(s);
}
MISTAKE(mirrored)
{
    s->state.model = shade_mat4_scaling(shade_v3(1, 1, -1));
    s->state.raster.cull = SHADE_CULL_BACK;
}
MISTAKE(upside_down)
{
    s->state.projection.col[1].y = -s->state.projection.col[1].y;
    s->state.raster.cull = SHADE_CULL_BACK;
}

/* Depth as it comes from the heap: every byte of the pixels is this one. */
static void stage_leave_depth(stage *s, int byte)
{
    for (int y = 0; y < STAGE_HEIGHT; y++)
        memset(s->c.target.depth + canvas_index(&s->c, 0, y), byte, 4 * STAGE_WIDTH);
    s->clear = NAN;
}
MISTAKE(clear_forgotten) { stage_leave_depth(s, 0); }
/* nobody draws outside the clip rectangle, so that depth there says nothing */
MISTAKE(clear_forgotten_where_it_draws)
{
    s->c.target.clip_width = STAGE_WIDTH / 2;
    s->c.target.clip_height = STAGE_HEIGHT / 2;
    s->clear = NAN;
    for (int y = 0; y < STAGE_HEIGHT; y++)
        for (int x = 0; x < STAGE_WIDTH; x++)
            s->c.target.depth[canvas_index(&s->c, x, y)] =
                x < STAGE_WIDTH / 2 && y < STAGE_HEIGHT / 2 ? 0 : 1;
}
MISTAKE(depth_full_of_nan) { stage_leave_depth(s, 255); }
MISTAKE(second_frame) { s->draws = 2; }
MISTAKE(cleared_to_zero) { s->clear = 0; }
/* The rectangle alone is cleared to 0, and depth beside it is fit for a picture. */
static void clear_to_zero_in(stage *s, int x, int y, int width, int height)
{
    shade_clear(&s->c.target, shade_v4(0, 0, 0, 1), 1);
    s->c.target.clip_x = x;
    s->c.target.clip_y = y;
    s->c.target.clip_width = width;
    s->c.target.clip_height = height;
    s->clear = 0;
}
MISTAKE(zero_on_the_left) { clear_to_zero_in(s, 0, 0, STAGE_WIDTH / 2, STAGE_HEIGHT); }
MISTAKE(zero_on_the_right)
{
    clear_to_zero_in(s, STAGE_WIDTH / 2, 0, STAGE_WIDTH / 2, STAGE_HEIGHT);
}
MISTAKE(zero_above) { clear_to_zero_in(s, 0, 0, STAGE_WIDTH, STAGE_HEIGHT / 2); }
MISTAKE(zero_below)
{
    clear_to_zero_in(s, 0, STAGE_HEIGHT / 2, STAGE_WIDTH, STAGE_HEIGHT / 2);
}
MISTAKE(hidden_by_the_frame_before) { s->clear = 0.5f; }
MISTAKE(greater) { s->state.raster.depth_test = SHADE_COMPARE_GREATER; }
MISTAKE(greater_cleared_to_zero)
{
    s->clear = 0;
    mistake_greater(s);
}
MISTAKE(reversed_cleared_to_one)
{
    s->state.projection = shade_mat4_perspective_reversed(0.8f, 1.5f, 0.1f);
    s->state.raster.depth_zero_to_one = 1;
    s->state.raster.depth_test = SHADE_COMPARE_GREATER;
}
MISTAKE(reversed_with_less)
{
    mistake_reversed_cleared_to_one(s);
    s->state.raster.depth_test = SHADE_COMPARE_LESS;
}
MISTAKE(equal) { s->state.raster.depth_test = SHADE_COMPARE_EQUAL; }
MISTAKE(bias_of_one) { s->state.raster.depth_bias = 1; }
MISTAKE(clip_empty)
{
    s->c.target.clip_x = 10;
    s->c.target.clip_height = 20;
}
MISTAKE(clip_beside)
{
    s->c.target.clip_x = STAGE_WIDTH;
    s->c.target.clip_width = s->c.target.clip_height = 20;
}
MISTAKE(smaller_than_a_pixel)
{
    s->state.model = shade_mat4_scaling(shade_v3(5e-3f, 5e-3f, 5e-3f));
}
MISTAKE(cut_by_alpha)
{
    s->state.transparency = 0.6f;
    s->state.alpha_cutoff = 0.5f;
}
MISTAKE(map_cut_by_alpha)
{
    for (int k = 3; k < 16; k += 4) s->texel[k] = 100;
    s->mesh.texcoords = &s->texcoord[0].x;
    s->state.diffuse_map = &s->map;
    s->state.alpha_cutoff = 0.5f;
}
static void shader_that_discards(const void *uniforms, const shade_fragments *SHADE_RESTRICT in,
                                 shade_colors *SHADE_RESTRICT out)
{
    (void)uniforms;
    (void)in;
    SHADE_EACH_LANE(i) { out->discard[i] = 1; }
}
MISTAKE(all_discarded) { s->state.fragment = shader_that_discards; }
MISTAKE(no_depth) { s->c.target.depth = NULL; }
MISTAKE(no_depth_with_culling)
{
    s->c.target.depth = NULL;
    s->state.raster.cull = SHADE_CULL_BACK;
    for (int i = 0; i < STAGE_VERTICES; i += 3) s->position[i] = shade_scale(s->position[i], 0.5f);
}

MISTAKE(no_light)
{
    s->state.lighting.lights = NULL;
    s->state.lighting.light_count = 0;
}
/* a triangle at the right edge of the picture, with a corner behind the eye on the left */
MISTAKE(no_light_beside_the_eye)
{
    s->position[0] = shade_v3(2.28f, -0.8f, 0);
    s->position[1] = shade_v3(2.28f, 0.8f, 0);
    s->position[2] = shade_v3(-1, 0, 8);
    s->mesh.indices = NULL;
    s->mesh.vertex_count = 3;
    s->state.view = shade_mat4_look_at(shade_v3(0, 0, 4), shade_v3(0, 0, 0), shade_v3(0, 1, 0));
    s->state.lighting.light_count = 0;
}
MISTAKE(light_count_forgotten) { s->state.lighting.light_count = 0; }
MISTAKE(lamps_not_filled) { memset(s->lamps, 0, sizeof s->lamps); }
MISTAKE(material_zero) { memset(&s->material, 0, sizeof s->material); }
MISTAKE(material_of_ambient)
{
    s->material.diffuse = s->material.specular = shade_v3(0, 0, 0);
}
MISTAKE(ambient_without_k_a)
{
    mistake_no_light(s);
    s->state.lighting.ambient = shade_v3(1, 1, 1);
    s->material.ambient = shade_v3(0, 0, 0);
}
MISTAKE(colors_zero)
{
    memset(s->color, 0, sizeof s->color);
    s->mesh.colors = &s->color[0].x;
    s->material.specular = shade_v3(0, 0, 0);
}
MISTAKE(map_black)
{
    for (int k = 0; k < 16; k++) s->texel[k] = (unsigned char)(k % 4 == 3 ? 255 : 0);
    s->mesh.texcoords = &s->texcoord[0].x;
    s->state.diffuse_map = &s->map;
    s->material.specular = shade_v3(0, 0, 0);
}
MISTAKE(normals_inward_of_a_quad)
{
    static const shade_vec3 quad[4] = { { -1, -1, 0 }, { 1, -1, 0 }, { 1, 1, 0 }, { -1, 1, 0 } };
    static const uint32_t corners[6] = { 0, 1, 2, 0, 2, 3 };
    memcpy(s->position, quad, sizeof quad);
    memcpy(s->index, corners, sizeof corners);
    s->mesh.index_count = 6;
    for (int i = 0; i < 4; i++) s->normal[i] = shade_v3(0, 0, -1);
}
MISTAKE(normals_zero) { memset(s->normal, 0, sizeof s->normal); }
MISTAKE(lamp_behind)
{
    s->lamps[0] = shade_point_light(shade_v3(0, -1, -4), shade_v3(1, 1, 1));
    s->state.lighting.light_count = 1;
}
MISTAKE(lamp_inside)
{
    s->lamps[0].position = shade_v4(0, 0, 0, 1);
    s->state.lighting.light_count = 1;
}
MISTAKE(direction_toward_the_sun)
{
    s->lamps[0] = shade_directional_light(shade_v3(0, 1, 4), shade_v3(1, 1, 1));
    s->state.lighting.light_count = 1;
}
MISTAKE(attenuated_away)
{
    s->lamps[0].constant = 1;
    s->lamps[0].quadratic = 50;
    s->state.lighting.light_count = 1;
}
MISTAKE(spot_attenuated_away)
{
    s->lamps[0] = shade_spot_light(shade_v3(0, 1, 4), shade_v3(0, -1, -4), 0.5f, 1,
                                   shade_v3(1, 1, 1));
    s->lamps[0].quadratic = 5000;
    s->state.lighting.light_count = 1;
}
MISTAKE(cutoff_in_degrees)
{
    s->lamps[0] = shade_spot_light(shade_v3(0, 1, 4), shade_v3(0, -1, -4), 0.5f, 1,
                                   shade_v3(1, 1, 1));
    s->lamps[0].spot_cos_cutoff = 30;
}
MISTAKE(cone_elsewhere)
{
    s->lamps[0] = shade_spot_light(shade_v3(0, 1, 4), shade_v3(0, 1, 4), 0.5f, 1,
                                   shade_v3(1, 1, 1));
    s->state.lighting.light_count = 1;
}
/* The mesh lies in the cone, and far from its axis. */
MISTAKE(exponent_of_thousands)
{
    s->lamps[0] = shade_spot_light(shade_v3(0, 1, 4), shade_v3(0, 1, -1), 1.5f, 5000,
                                   shade_v3(1, 1, 1));
    s->state.lighting.light_count = 1;
}
MISTAKE(target_instead_of_direction)
{
    s->lamps[0] = shade_spot_light(shade_v3(0, 0, 4), shade_v3(0, 0, 0.5f), 0.3f, 1,
                                   shade_v3(1, 1, 1));
    s->state.lighting.light_count = 1;
}
/* Seen from afar and lit at a flat angle: R.V is 0.08 at most and shows nothing, N.H would. */
MISTAKE(mirror_turned_away)
{
    static const uint32_t two[6] = { 0, 1, 2, 0, 2, 3 };
    mistake_wound_clockwise_quad(s);
    memcpy(s->index, two, sizeof two);
    for (int k = 0; k < 4; k++) s->normal[k] = shade_v3(0, 0, 1);
    s->state.view = shade_mat4_look_at(shade_v3(0, 0, 40), shade_v3(0, 0, 0), shade_v3(0, 1, 0));
    s->state.projection = shade_mat4_perspective(0.08f, 1.5f, 0.1f, 100);
    s->lamps[0] = shade_directional_light(shade_v3(-1, 0, -0.05f), shade_v3(1, 1, 1));
    s->state.lighting.light_count = 1;
    s->state.lighting.model = SHADE_MODEL_PHONG;
    s->material.diffuse = s->material.ambient = shade_v3(0, 0, 0);
    s->material.specular = shade_v3(1, 1, 1);
    s->material.shininess = 4;
}
MISTAKE(terms_of_emission) { s->state.lighting.terms = SHADE_TERM_EMISSION; }
MISTAKE(model_emissive) { s->state.lighting.model = SHADE_MODEL_EMISSIVE; }
MISTAKE(invisible)
{
    s->state.transparency = 1;
    s->state.raster.blend = SHADE_BLEND_OVER;
}
MISTAKE(invisible_map)
{
    for (int k = 3; k < 16; k += 4) s->texel[k] = 0;
    s->mesh.texcoords = &s->texcoord[0].x;
    s->state.diffuse_map = &s->map;
    s->state.raster.blend = SHADE_BLEND_OVER;
}
MISTAKE(view_forgotten)
{
    memset(&s->state.view, 0, sizeof s->state.view);
    s->state.lighting.light_count = 1;
}

/* What the questions ask for beside the mistake itself: other projections, no depth, few lamps. */
MISTAKE(view_of_w_two) { s->state.view.col[3].w = 2; }
MISTAKE(left_handed_projection_by_rows)
{
    const shade_mat4 turn = shade_mat4_scaling(shade_v3(1, 1, -1));
    s->state.view = shade_mat4_mul(turn, s->state.view);
    s->state.projection = shade_mat4_mul(s->state.projection, turn);
    mistake_projection_by_rows(s);
}
MISTAKE(projection_onto_a_point)
{
    memset(&s->state.projection, 0, sizeof s->state.projection);
    s->state.projection.col[3] = shade_v4(0, 0, 2, 3);
}
MISTAKE(small_one_beside_without_depth)
{
    s->c.target.depth = NULL;
    s->state.model = shade_mat4_scaling(shade_v3(0.1f, 0.1f, 0.1f));
    s->state.model.col[3].x = 5;
}
MISTAKE(tall_one_beside)
{
    s->state.model = shade_mat4_scaling(shade_v3(0.1f, 1.5f, 0.1f));
    s->state.model.col[3].x = 5;
}
MISTAKE(doubled_looks_away)
{
    float *p = (float *)&s->state.projection;
    mistake_looks_away(s);
    for (int k = 0; k < 16; k++) p[k] *= 2;
}
MISTAKE(beside_in_parallel)
{
    s->state.projection = shade_mat4_ortho(-3, 3, -2, 2, 0.1f, 20);
    mistake_beside(s);
}
MISTAKE(beside_in_a_view_that_scales)
{
    s->state.view = shade_mat4_mul(shade_mat4_scaling(shade_v3(2, 2, 2)), s->state.view);
    mistake_beside(s);
}
/* Two triangles, a and b away from the origin, seen by a camera that stands there. */
static void stage_two_triangles(stage *s, shade_vec3 a, shade_vec3 b)
{
    static const shade_vec3 corner[3] = { { 0, 0, 0 }, { 1, 0, 0 }, { 0, 1, 0 } };
    for (uint32_t i = 0; i < 6; i++) {
        s->position[i] = shade_add(corner[i % 3], i < 3 ? a : b);
        s->index[i] = i;
    }
    s->mesh.index_count = 6;
    memset(&s->state.view, 0, sizeof s->state.view);
}
/* The left one faces the lamp, and its texels are holes; the right one turns away.  Stored depth
   would tell which pixels are drawn. */
MISTAKE(lamp_behind_what_the_map_leaves)
{
    stage_two_triangles(s, shade_v3(-1.2f, 0, 0), shade_v3(0.2f, 0, 0));
    s->state.view = shade_mat4_look_at(shade_v3(0, 0, 4), shade_v3(0, 0, 0), shade_v3(0, 1, 0));
    for (int i = 0; i < 6; i++) {
        s->normal[i] = shade_v3(0, 0, i < 3 ? 1.0f : -1.0f);
        s->texcoord[i] = shade_v2(i < 3 ? 0.25f : 0.75f, 0.25f);
    }
    s->texel[3] = s->texel[11] = 0;
    s->mesh.texcoords = &s->texcoord[0].x;
    s->state.diffuse_map = &s->map;
    s->state.alpha_cutoff = 0.5f;
    s->state.lighting.light_count = 1;
    s->c.target.depth = NULL;
}
MISTAKE(lamp_behind_what_the_map_leaves_in_ambient_light)
{
    mistake_lamp_behind_what_the_map_leaves(s);
    s->state.lighting.ambient = shade_v3(0.1f, 0.1f, 0.1f);
}
MISTAKE(on_both_sides) { stage_two_triangles(s, shade_v3(-99, 0, -4), shade_v3(99, 0, -4)); }
MISTAKE(before_and_beyond) { stage_two_triangles(s, shade_v3(0, 0, -0.01f), shade_v3(0, 0, -999)); }
MISTAKE(all_discarded_of_depth)
{
    s->c.target.color = NULL;
    s->state.alpha_cutoff = 0.5f;
    mistake_all_discarded(s);
}
MISTAKE(small_depth_of_a_shader)
{
    s->c.target.color = NULL;
    mistake_all_discarded(s);
    mistake_smaller_than_a_pixel(s);
}
MISTAKE(no_light_on_floats)
{
    canvas_close(&s->c);
    s->c = canvas_open(STAGE_WIDTH, STAGE_HEIGHT, STAGE_WIDTH + 3, SHADE_FORMAT_RGBA32F, 1);
    s->good = s->c.target;
    mistake_no_light(s);
}
MISTAKE(no_light_on_the_default)
{
    s->state.material = NULL;
    mistake_no_light(s);
}
MISTAKE(no_light_on_a_mirror)
{
    s->material.diffuse = s->material.ambient = shade_v3(0, 0, 0);
    mistake_no_light(s);
}
MISTAKE(lamp_of_highlights_behind)
{
    mistake_lamp_behind(s);
    s->lamps[0].diffuse = shade_v3(0, 0, 0);
}
MISTAKE(highlights_alone_on_a_matte_material)
{
    for (int i = 0; i < 2; i++) s->lamps[i].diffuse = shade_v3(0, 0, 0);
    s->material.specular = shade_v3(0, 0, 0);
}
/* The light is missed first, and the map once there is light. */
MISTAKE(map_black_and_lamp_behind)
{
    mistake_map_black(s);
    mistake_lamp_behind(s);
}
MISTAKE(many_cones_elsewhere)
{
    enum { COUNT = 17 };    /* one more than shade_explain tries without their cone */
    static shade_light many[COUNT];
    mistake_cone_elsewhere(s);
    for (int i = 0; i < COUNT; i++) many[i] = s->lamps[0];
    s->state.lighting.lights = many;
    s->state.lighting.light_count = COUNT;
}

/* What a mistake is under every blend. */
MISTAKE(no_light_over)
{
    s->state.raster.blend = SHADE_BLEND_OVER;
    mistake_no_light(s);
}
MISTAKE(no_light_added)
{
    s->state.raster.blend = SHADE_BLEND_ADD;
    mistake_no_light(s);
}
MISTAKE(overlay_without_light)
{
    s->state.material = NULL;
    s->state.transparency = 0.5f;
    s->c.target.depth = NULL;
    s->state.raster.cull = SHADE_CULL_BACK;
    mistake_no_light_over(s);
}
MISTAKE(material_zero_added)
{
    s->state.raster.blend = SHADE_BLEND_ADD;
    mistake_material_zero(s);
}
MISTAKE(lamp_behind_over)
{
    s->state.raster.blend = SHADE_BLEND_OVER;
    mistake_lamp_behind(s);
}
MISTAKE(almost_invisible)
{
    s->state.transparency = 0.9999f;
    s->state.raster.blend = SHADE_BLEND_OVER;
}

static void stage_ambient(stage *s)
{
    s->state.lighting.ambient = shade_v3(0.3f, 0.3f, 0.3f);
}
MISTAKE(ambient_and_lamp_behind)
{
    stage_ambient(s);
    mistake_lamp_behind(s);
}
MISTAKE(ambient_and_no_lamps)
{
    stage_ambient(s);
    mistake_no_light(s);
}
MISTAKE(ambient_and_light_count_forgotten)
{
    stage_ambient(s);
    mistake_light_count_forgotten(s);
}
MISTAKE(ambient_and_normals_zero)
{
    stage_ambient(s);
    mistake_normals_zero(s);
}
MISTAKE(ambient_and_normals_nan)
{
    stage_ambient(s);
    for (int i = 0; i < STAGE_VERTICES; i++) s->normal[i].x = NAN;
}
MISTAKE(normals_nan)
{
    for (int i = 0; i < STAGE_VERTICES; i++) s->normal[i].x = NAN;
}
MISTAKE(light_count_negative)
{
    stage_ambient(s);
    s->state.lighting.light_count = -2;
}

MISTAKE(map_without_texcoords) { s->state.diffuse_map = &s->map; }
MISTAKE(bad_map_without_texcoords)
{
    s->map.pixels = NULL;
    mistake_map_without_texcoords(s);
}
MISTAKE(trilinear_without_mipmaps)
{
    s->mesh.texcoords = &s->texcoord[0].x;
    s->state.diffuse_map = &s->map;
    s->map.filter = SHADE_FILTER_TRILINEAR;
}
MISTAKE(mipmap_count_without_mipmaps)
{
    s->mesh.texcoords = &s->texcoord[0].x;
    s->state.diffuse_map = &s->map;
    s->map.mipmap_count = 1;
}
MISTAKE(mipmaps_not_counted)
{
    mistake_trilinear_without_mipmaps(s);
    s->map.mipmaps = &s->map;
}
static void stage_reverse(stage *s, float z_near)
{
    s->state.projection = shade_mat4_perspective_reversed(0.8f, 1.5f, z_near);
    s->state.raster.depth_zero_to_one = 1;
    s->state.raster.depth_test = SHADE_COMPARE_GREATER;
    s->clear = 0;
}
/* Its last column, (0, 0, 1, 0), is also that of a transposed matrix. */
MISTAKE(reversed_beside)
{
    mistake_beside(s);
    stage_reverse(s, 1);
}
/* Everything has z = near > w: behind the eye, w < 0, or before the near plane. */
MISTAKE(reversed_looks_away)
{
    mistake_looks_away(s);
    stage_reverse(s, 1);
}
MISTAKE(reversed_before_near) { stage_reverse(s, 50); }
MISTAKE(reversed_beyond_far)
{
    s->state.projection = shade_mat4_perspective(0.8f, 1.5f, 2, 0.1f);
    s->state.raster.depth_test = SHADE_COMPARE_GREATER;
    s->clear = 0;
}
MISTAKE(chunks_of_half_the_triangles)
{
    s->mesh.chunks = &s->chunk;
    s->mesh.chunk_count = 1;
    s->chunk.low = shade_v3(-1, -1, -1);
    s->chunk.high = shade_v3(1, 1, 1);
    s->chunk.count /= 2;
}
/* as they are where shade_mesh_chunks had too little room */
MISTAKE(chunks_of_zeros)
{
    s->mesh.chunks = &s->chunk;
    s->mesh.chunk_count = 1;
    memset(&s->chunk, 0, sizeof s->chunk);
}
MISTAKE(aspect_of_a_square) { s->state.projection = shade_mat4_perspective(0.8f, 1, 0.1f, 100); }
MISTAKE(aspect_upside_down)
{
    s->state.projection = shade_mat4_perspective(0.8f, 1 / 1.5f, 0.1f, 100);
}
MISTAKE(aspect_a_little_wide)
{
    s->state.projection = shade_mat4_perspective(0.8f, 1.56f, 0.1f, 100);
}
MISTAKE(view_that_scales)
{
    s->state.view = shade_mat4_mul(shade_mat4_scaling(shade_v3(2, 2, 2)), s->state.view);
}
MISTAKE(view_that_shears) { s->state.view.col[1].x += 0.4f; }
MISTAKE(light_of_255)
{
    for (int i = 0; i < 2; i++) s->lamps[i].diffuse = shade_v3(255, 255, 255);
}
MISTAKE(ambient_of_255) { s->state.lighting.ambient = shade_v3(200, 200, 255); }
MISTAKE(colors_of_255)
{
    for (int i = 0; i < STAGE_VERTICES; i++) s->color[i] = shade_v3(200, 128, 30);
    s->mesh.colors = &s->color[0].x;
}
MISTAKE(normals_against_the_winding)
{
    for (int i = 0; i < STAGE_VERTICES; i++) s->normal[i] = shade_neg(s->normal[i]);
    s->lamps[1] = shade_directional_light(shade_v3(0, 1, 4), shade_v3(1, 1, 1));
}
MISTAKE(beside_the_clip_rectangle)
{
    s->c.target.clip_x = s->c.target.clip_y = 2;
    s->c.target.clip_width = s->c.target.clip_height = 9;
}

/* What sentences were false of: the words are those of the true cause. */
MISTAKE(attenuation_of_far_lamps)
{
    s->lamps[0] = shade_point_light(shade_v3(0, 7, 27), shade_v3(1, 1, 1));
    s->lamps[0].quadratic = 1;
    s->state.lighting.light_count = 1;
}
MISTAKE(attenuation_of_far_lamps_with_a_map)
{
    mistake_attenuation_of_far_lamps(s);
    s->mesh.texcoords = &s->texcoord[0].x;
    s->state.diffuse_map = &s->map;
    for (int k = 0; k < 16; k++) s->texel[k] = 140;
}
/* corners right of the picture, below it and far beyond: outside, but of no plane with all three */
MISTAKE(around_a_corner_of_the_picture)
{
    stage_two_triangles(s, shade_v3(0, 0, 0), shade_v3(0, 0, 0));
    s->position[0] = shade_v3(5.4f, 0, -4);
    s->position[1] = shade_v3(0, 4.2f, -4);
    s->position[2] = shade_v3(5.4f, 4.2f, -4);
    s->mesh.index_count = 3;
}

typedef struct mistake {
    const char *name, *word;     /* word: what the sentence has to hold */
    void (*make)(stage *);
    int unseen;                  /* without stats nothing can be told */
} mistake;
#define OF(name, word) { #name, word, mistake_##name, 0 }
#define OF_STATS(name, word) { #name, word, mistake_##name, 1 }
static const mistake mistakes[] = {
    OF(target_null, "target is NULL"), OF(mesh_null, "mesh is NULL"),
    OF(state_null, "state is NULL"), OF(no_memory, "target.color"),
    OF(width_zero, "target.width"), OF(stride_in_half_pixels, "target.stride"),
    OF(format_a8, "target.format"), OF(clip_negative, "clip_width"),
    OF(strip_without_rows, "row_count"), OF(positions_null, "mesh.positions"),
    OF(vertex_count_negative, "mesh.vertex_count"), OF(index_count_negative, "mesh.index_count"),
    OF(stride_of_three_floats, "bytes"), OF(stride_of_eight_floats, "position_stride"),
    OF(chunks_null, "mesh.chunks"), OF(chunk_outside, "chunk"),
    OF(chunks_of_another_mesh, "mesh.chunks"), OF(shading_unknown, "state.shading"),
    OF(transparency_in_percent, "state.transparency"), OF(cutoff_of_128, "state.alpha_cutoff"),
    OF(cull_unknown, "raster.cull"), OF(depth_test_unknown, "raster.depth_test"),
    OF(blend_unknown, "raster.blend"), OF(bias_nan, "raster.depth_bias"),
    OF(lights_null, "lighting.lights"), OF(model_unknown, "lighting.model"),
    OF(map_without_pixels, "pixels"), OF(index_beyond, "mesh.vertex_count"),
    OF(index_count_odd, "mesh.index_count"), OF(vertices_not_in_threes, "mesh.vertex_count"),
    OF(index_count_forgotten, "mesh.index_count"),
    OF(vertex_count_forgotten, "mesh.vertex_count"), OF(chunk_count_forgotten, "chunk_count"),

    OF(fovy_in_degrees, "radians"), OF(near_zero, "near"), OF(near_is_far, "far"),
    OF(aspect_zero, "aspect"), OF(ortho_empty, "left"), OF(swapped, "swapped"),
    OF(swapped_ortho, "swapped"), OF(projection_in_view, "state.projection"),
    OF(view_by_rows, "state.view looks transposed"),
    OF(projection_by_rows, "state.projection looks transposed"),
    OF(model_by_rows, "state.model looks transposed"), OF(all_by_rows, "transposed"),
    OF(ortho_by_rows, "state.projection"), OF(projection_forgotten, "state.projection is unset"),
    OF(view_inverted, "inverse"), OF(looks_away, "behind the eye"),
    OF(beyond_far, "beyond the far plane"),
    OF(beyond_far_where_the_inverse_looks, "beyond the far plane"),
    OF(before_near, "nearer than the near plane"),
    OF(beside, "beside the picture"), OF(left_handed, "behind the eye"),
    OF(model_nan, "state.model"), OF(view_infinite, "state.view"),
    OF(projection_nan, "state.projection"), OF(reversed_flag_forgotten, "depth_zero_to_one"),
    OF(positions_nan, "mesh.positions"), OF(one_position_nan, "mesh.positions"),
    OF(scaled_to_nothing, "state.model"), OF(far_too_small, "smaller than a pixel"),
    OF(one_index_everywhere, "mesh.indices"),

    OF(wound_clockwise_quad, "counter-clockwise"),
    OF(culled_by_mirror, "state.model that mirrors"), OF(culled_front, "SHADE_CULL_FRONT"),
    OF(culled_inside, "the eye lies inside"),
    OF(culled_inside_with_chunks, "the eye lies inside"), OF(inside_out, "inside out"),
    OF(inside_out_with_a_bias, "inside out"),
    OF(inside_out_from_below, "inside out"), OF(inside_out_from_above, "inside out"),
    OF(inside_out_open, "inside out"), OF(mirrored_open, "inside out"),
    OF(inside_out_without_normals, "inside out"), OF(mirrored, "inside out"),
    OF(upside_down, "inside out"),

    OF(clear_forgotten, "shade_clear"), OF(clear_forgotten_where_it_draws, "holds 0"),
    OF(depth_full_of_nan, "shade_clear"),
    OF_STATS(second_frame, "shade_clear"), OF(cleared_to_zero, "depth_test"),
    OF(zero_on_the_left, "holds 0"), OF(zero_on_the_right, "holds 0"), OF(zero_above, "holds 0"),
    OF(zero_below, "holds 0"),
    OF_STATS(hidden_by_the_frame_before, "shade_clear"), OF(greater, "SHADE_COMPARE_LESS"),
    OF(greater_cleared_to_zero, "SHADE_COMPARE_LESS"), OF(reversed_cleared_to_one, "shade_clear"),
    OF(reversed_with_less, "SHADE_COMPARE_GREATER"), OF_STATS(equal, "target.depth"),
    OF_STATS(bias_of_one, "depth_bias"), OF(clip_empty, "clip_width"), OF(clip_beside, "clip_x"),
    OF_STATS(smaller_than_a_pixel, "centre of a pixel"), OF(cut_by_alpha, "alpha_cutoff"),
    OF_STATS(map_cut_by_alpha, "alpha_cutoff"), OF_STATS(all_discarded, "state.fragment"),
    OF(no_depth, "target.depth is NULL"), OF(no_depth_with_culling, "target.depth is NULL"),

    OF(no_light, "no light"), OF(no_light_beside_the_eye, "light_count"),
    OF(light_count_forgotten, "light_count"),
    OF(lamps_not_filled, "no colour"), OF(material_zero, "state.material"),
    OF(material_of_ambient, "state.material"), OF(ambient_without_k_a, "material.ambient"),
    OF(colors_zero, "mesh.colors"), OF(map_black, "diffuse_map"),
    OF(normals_inward_of_a_quad, "mesh.normals"), OF(normals_zero, "mesh.normals"),
    OF(lamp_behind, "behind"), OF(lamp_inside, "behind"), OF(direction_toward_the_sun, "behind"),
    OF(attenuated_away, "Attenuation"), OF(spot_attenuated_away, "Attenuation"),
    OF(cutoff_in_degrees, "spot_cos_cutoff"), OF(cone_elsewhere, "spot_direction"),
    OF(exponent_of_thousands, "spot_exponent, leaves too little"),
    OF(mirror_turned_away, "state.material"),
    OF(target_instead_of_direction, "spot_direction"), OF(terms_of_emission, "lighting.terms"),
    OF(model_emissive, "lighting.model"), OF(invisible, "transparency"),
    OF(invisible_map, "diffuse_map"), OF(view_forgotten, "the eye"),
    OF(view_of_w_two, "state.view"),
    OF(left_handed_projection_by_rows, "state.projection looks transposed"),
    OF(projection_onto_a_point, "fovy"), OF(small_one_beside_without_depth, "beside the picture"),
    OF(tall_one_beside, "beside the picture"), OF(doubled_looks_away, "behind the eye"),
    OF(beside_in_parallel, "beside the picture"),
    OF(beside_in_a_view_that_scales, "beside the picture"),
    OF(on_both_sides, "beside the picture"), OF(before_and_beyond, "beyond far"),
    OF_STATS(all_discarded_of_depth, "state.fragment"),
    OF_STATS(small_depth_of_a_shader, "centre of a pixel"), OF(no_light_on_floats, "no light"),
    OF(no_light_on_the_default, "no light"), OF(no_light_on_a_mirror, "no light"),
    OF(lamp_of_highlights_behind, "no colour"), OF(map_black_and_lamp_behind, "behind"),
    OF(highlights_alone_on_a_matte_material, "state.material"),
    OF(no_light_over, "no light"), OF(no_light_added, "no light"),
    OF(overlay_without_light, "no light"), OF(material_zero_added, "state.material"),
    OF(lamp_behind_over, "behind"), OF(almost_invisible, "transparency"),
    OF(ambient_and_lamp_behind, "Only ambient light arrives: every lamp is behind"),
    OF(ambient_and_no_lamps, "Only ambient light"),
    OF(ambient_and_light_count_forgotten, "light_count"),
    OF(ambient_and_normals_zero, "Only ambient light arrives, because mesh.normals"),
    OF(ambient_and_normals_nan, "Only ambient light arrives, because mesh.normals"),
    OF(normals_nan, "mesh.normals are zero or NaN"), OF(light_count_negative, "negative"),
    OF(map_without_texcoords, "mesh.texcoords is NULL"),
    OF(bad_map_without_texcoords, "pixels are NULL"),
    OF(trilinear_without_mipmaps, "no mipmaps"), OF(mipmap_count_without_mipmaps, "no mipmaps"),
    OF(mipmaps_not_counted, "no mipmaps"), OF(reversed_beside, "beside"),
    OF(reversed_looks_away, "behind the eye"), OF(reversed_before_near, "nearer than the near"),
    OF(reversed_beyond_far, "beyond the far plane"),
    OF(lamp_behind_what_the_map_leaves, "Every lamp is behind"),
    OF(lamp_behind_what_the_map_leaves_in_ambient_light, "every lamp is behind"),
    OF(chunks_of_half_the_triangles, "mesh.chunks sum to fewer"),
    OF(chunks_of_zeros, "mesh.chunks sum to fewer"), OF(aspect_of_a_square, "aspect"),
    OF(aspect_upside_down, "aspect"), OF(aspect_a_little_wide, "aspect"),
    OF(view_that_scales, "state.view scales"),
    OF(view_that_shears, "state.view scales or shears"), OF(light_of_255, "255"),
    OF(ambient_of_255, "255"), OF(colors_of_255, "255"),
    OF(normals_against_the_winding, "mesh.normals point away"),
    OF(beside_the_clip_rectangle, "beside the clip rectangle"),
    OF(attenuation_of_far_lamps, "Attenuation"),
    OF(attenuation_of_far_lamps_with_a_map, "Attenuation"),
    OF(around_a_corner_of_the_picture, "covers the centre of a pixel nowhere"),
    OF(many_cones_elsewhere, "spot_direction"),
};

TEST(explain, every_mistake_gets_the_word_that_leads_to_it)
{
    for (size_t k = 0; k < sizeof mistakes / sizeof mistakes[0]; k++)
        for (int with_stats = 0; with_stats < 2; with_stats++) {
            stage *s = stage_open();
            mistakes[k].make(s);
            const char *said = stage_explain(s, with_stats);
            const int held = strstr(said, mistakes[k].word) != NULL;
            CHECK_SAY(held || (!with_stats && mistakes[k].unseen), "%s, %s stats: \"%s\"",
                      mistakes[k].name, with_stats ? "with" : "without", said);
            stage_close(s);
        }
}

/* The sentence about a stage as it is: "" without a mistake. */
static void stage_is_good(stage *s, const char *what)
{
    for (int with_stats = 0; with_stats < 2; with_stats++) {
        const char *said = stage_explain(s, with_stats);
        CHECK_SAY(!*said, "%s, %s stats: \"%s\"", what, with_stats ? "with" : "without", said);
    }
}
TEST(explain, the_scene_without_a_mistake_gets_none)
{
    stage *s = stage_open();
    stage_is_good(s, "the stage");
    s->state.raster.cull = SHADE_CULL_BACK;
    stage_is_good(s, "back faces culled");
    s->c.target.depth = NULL;
    stage_is_good(s, "a convex mesh without depth");
    s->mesh.index_count = 3;
    s->state.raster.cull = SHADE_CULL_NONE;
    stage_is_good(s, "a triangle without depth");
    stage_close(s);
}

/* A camera somewhere around the ball, of any kind; a lamp beside it. */
static void stage_random_camera(stage *s)
{
    const int kind = rnd_int(0, 2);
    shade_vec3 eye = shade_v3(rnd_float(-1, 1), rnd_float(-1, 1), rnd_float(-1, 1));
    eye = shade_scale(shade_normalize(eye), rnd_float(2.5, 9));
    if (shade_length(eye) < 1) eye = shade_v3(0, 0, 5);
    s->state.view = shade_mat4_look_at(eye, shade_v3(rnd_float(-0.5, 0.5), 0, 0),
                                       shade_v3(0.1f, 1, 0.2f));
    s->state.projection = kind ? shade_mat4_perspective(0.8f, 1.5f, rnd_float(0.01, 0.5), 50)
                               : shade_mat4_ortho(-3, 3, -2, 2, 0.1f, 20);
    s->state.raster.depth_test = (shade_compare)rnd_int(0, 1);
    if (kind == 2) {
        s->state.projection = shade_mat4_perspective_reversed(0.8f, 1.5f, rnd_float(0.01, 0.5));
        s->state.raster.depth_test = SHADE_COMPARE_GREATER;
        s->state.raster.depth_zero_to_one = 1;
    }
    s->clear = kind == 2 ? 0.0f : 1.0f;
    s->lamps[0].position = shade_v4(eye.x + 0.3f, eye.y + 0.4f, eye.z, 1);
    s->lamps[1] = shade_spot_light(eye, shade_neg(eye), rnd_float(0.3, 1), rnd_float(0, 9),
                                   shade_v3(1, 1, 1));
}
static void stage_random_mesh(stage *s)
{
    s->state.shading = (shade_shading)rnd_int(0, 2);
    s->state.lighting.model = rnd_one_in(4) ? SHADE_MODEL_COOL_TO_WARM
                                            : (shade_model)rnd_int(0, 2);
    s->state.lighting.light_count = rnd_int(1, 2);
    if (rnd_one_in(2)) s->mesh.normals = NULL;
    if (rnd_one_in(2)) s->mesh.colors = &s->color[0].x;
    if (rnd_one_in(2)) {
        s->mesh.texcoords = &s->texcoord[0].x;
        s->state.diffuse_map = &s->map;
    }
    if (rnd_one_in(3)) {
        s->mesh.chunks = &s->chunk;
        s->mesh.chunk_count = 1;
    }
    s->chunk.low = shade_v3(-1, -1, -1);
    s->chunk.high = shade_v3(1, 1, 1);
    if (rnd_one_in(2)) s->state.raster.cull = SHADE_CULL_BACK;
    if (rnd_one_in(4)) s->state.raster.cull = SHADE_CULL_FRONT;
    if (rnd_one_in(3)) s->state.raster.blend = SHADE_BLEND_ADD;
    if (rnd_one_in(3)) {
        s->state.transparency = 0.5f;
        s->state.raster.blend = SHADE_BLEND_OVER;
    }
    if (s->state.raster.cull == SHADE_CULL_FRONT)
        s->state.lighting.flags |= SHADE_FLAG_TWO_SIDED;
    if (rnd_one_in(3))
        s->state.model = shade_mat4_mul(
            shade_mat4_rotation(rnd_float(-3, 3), shade_v3(rnd_float(-1, 1), 1, 0)),
            shade_mat4_scaling(shade_v3(rnd_float(0.5, 1.1), rnd_float(0.5, 1.1), 1)));
}
/* Whole, in bands of rows, of columns and in strips; some of them do not touch the mesh. */
TEST(explain, random_good_scenes_get_none)
{
    for (int k = 0; k < 150; k++) {
        stage *s = stage_open();
        const int y = rnd_int(0, STAGE_HEIGHT - 1), high = rnd_int(1, STAGE_HEIGHT - y);
        const int x = rnd_int(0, STAGE_WIDTH - 1);
        s->c.target.srgb = rnd_one_in(2);
        stage_random_camera(s);
        stage_random_mesh(s);
        stage_is_good(s, "whole");
        s->c.target = s->good;
        s->c.target.clip_y = y;
        s->c.target.clip_height = high;
        s->c.target.clip_width = STAGE_WIDTH;
        stage_is_good(s, "a band of rows");
        s->c.target.clip_x = x;
        s->c.target.clip_y = 0;
        s->c.target.clip_height = STAGE_HEIGHT;
        s->c.target.clip_width = rnd_one_in(2) ? STAGE_WIDTH - x : rnd_int(1, STAGE_WIDTH - x);
        stage_is_good(s, "a band of columns");
        s->c.target = s->good;
        s->c.target.row_offset = y;
        s->c.target.row_count = high;
        stage_is_good(s, "a strip");
        stage_close(s);
    }
}
/* Nothing of a small mesh that another hides, or that is beside the picture, is a fault where many
   are drawn; a black one that is blended over the ground is its shadow. */
TEST(explain, what_other_meshes_explain_gets_none)
{
    stage *s = stage_open();
    const shade_mat4 full = s->state.model;
    shade_mat4 small = shade_mat4_scaling(shade_v3(0.1f, 0.1f, 0.1f));
    shade_vec3 beside;
    stage_is_good(s, "the first");
    s->clear = NAN;
    small.col[3] = shade_v4(0, -0.3f, -2, 1);
    s->state.model = small;
    stage_is_good(s, "a small one behind");
    s->state.model = shade_mat4_scaling(shade_v3(0.6f, 0.6f, 0.6f));
    stage_is_good(s, "one of two thirds of the height inside");
    small.col[3] = shade_v4(5, 0, 0, 1);
    s->state.model = small;
    stage_is_good(s, "a small one beside");
    s->state.model = shade_mat4_scaling(shade_v3(0.1f, 0, 0));
    stage_is_good(s, "a small one seen edge-on");
    memset(&s->material, 0, sizeof s->material);
    s->state.model = full;
    s->state.transparency = 0.5f;
    s->state.raster.blend = SHADE_BLEND_OVER;
    s->state.raster.depth_test = SHADE_COMPARE_LESS_EQUAL;
    stage_is_good(s, "a shadow");
    s->state.view = shade_mat4_look_at(shade_v3(4, 0, 2), shade_v3(0, 0, 0), shade_v3(0, 1, 0));
    beside = shade_mat4_transform_point(s->state.view, shade_v3(0, 0, -6));
    s->state.model = shade_mat4_translation(beside);
    stage_is_good(s, "one beside, where the inverse of the view looks");
    stage_close(s);
}
/* Experiments leave out lamps beyond the sixteenth: nothing is said of the colours of all. */
TEST(explain, of_more_than_sixteen_lamps_no_colour_is_blamed)
{
    shade_light dark[17];
    stage *s = stage_open();
    for (int i = 0; i < 17; i++) dark[i] = shade_point_light(shade_v3(3, 4, 6), shade_v3(0, 0, 0));
    s->state.lighting.lights = dark;
    s->state.lighting.light_count = 16;
    CHECK(strstr(stage_explain(s, 1), "lights have no colour"));
    s->state.lighting.light_count = 17;
    CHECK(!strstr(stage_explain(s, 1), "lights have no colour"));
    stage_close(s);
}
/* Faces that are lit by normals of their own show nothing of mesh.normals. */
TEST(explain, of_faces_no_normals_are_blamed)
{
    static const char *const unlit[2] = { "Every lamp is behind", "every lamp is behind" };
    for (int ambient = 0; ambient < 2; ambient++) {
        stage *s = stage_open();
        const char *said;
        memset(s->normal, 0, sizeof s->normal);
        if (ambient) s->state.lighting.ambient = shade_v3(0.1f, 0.1f, 0.1f);
        CHECK(strstr(stage_explain(s, 1), "mesh.normals are zero"));
        s->state.shading = SHADE_SHADING_PER_FACE;
        stage_is_good(s, "faces of zero normals");
        s->lamps[0] = s->lamps[1] = shade_directional_light(shade_v3(0, 0, 1), shade_v3(1, 1, 1));
        said = stage_explain(s, 1);
        CHECK_SAY(strstr(said, unlit[ambient]) != NULL, "%s", said);
        stage_close(s);
    }
}
/* A pool of light beside the middle of its face, and normals that would not show it per fragment:
   no one change would be a cure. */
TEST(explain, of_a_pool_beside_the_middle_of_a_face_nothing_is_said)
{
    stage *s = stage_open();
    for (int k = 0; k < 3; k++)
        s->position[k] = shade_v3(k == 1 ? 9.0f : -9.0f, 0, k == 2 ? -9.0f : 9.0f);
    for (uint32_t k = 0; k < 3; k++) s->index[k] = k;
    memset(s->normal, 0, sizeof s->normal);
    s->mesh.index_count = 3;
    s->state.shading = SHADE_SHADING_PER_FACE;
    s->state.view = shade_mat4_look_at(shade_v3(0, 6, 9), shade_v3(-2, 0, 3), shade_v3(0, 1, 0));
    s->lamps[0] = shade_spot_light(shade_v3(-2, 2, 3), shade_v3(0, -1, 0), 0.3f, 0,
                                   shade_v3(1, 1, 1));
    s->state.lighting.light_count = 1;
    stage_is_good(s, "a pool beside the middle");
    s->mesh.normals = NULL;
    CHECK(strstr(stage_explain(s, 1), "state.shading lights vertices or middles"));
    stage_close(s);
}
/* The stats are believed: the small picture of shade_explain may miss what the large one shows. */
TEST(explain, a_draw_that_had_pixels_is_not_said_to_have_none)
{
    stage *s = stage_open();
    shade_stats stats;
    memset(&stats, 0, sizeof stats);
    s->state.model = shade_mat4_translation(shade_v3(50, 0, 0));
    CHECK(*shade_explain(&s->c.target, &s->mesh, &s->state, &stats));
    stats.fragments = 1;
    CHECK(!*shade_explain(&s->c.target, &s->mesh, &s->state, &stats));
    stage_close(s);
}
/* A floor of two triangles, with a pool of light that is small beside it; at times smaller than any
   pixel, beside a lamp that shines up. */
TEST(explain, small_pools_of_light_are_light)
{
    static const shade_vec3 ground[4] = { { -9, 0, 9 }, { 9, 0, 9 }, { 9, 0, -9 }, { -9, 0, -9 } };
    static const uint32_t corners[6] = { 0, 1, 2, 0, 2, 3 };
    for (int k = 0; k < 40; k++) {
        stage *s = stage_open();
        const shade_vec3 above = shade_v3(rnd_float(-1, 1), 0.2f, rnd_float(-2, 1));
        memcpy(s->position, ground, sizeof ground);
        memcpy(s->index, corners, sizeof corners);
        s->mesh.normals = NULL;
        s->mesh.index_count = 6;
        s->state.lighting.light_count = 1;
        s->lamps[0] = shade_point_light(above, shade_v3(1, 1, 1));
        s->lamps[0].quadratic = 1000;
        if (k % 2)
            s->lamps[0] = shade_spot_light(above, shade_v3(0, -1, 0.1f), k % 4 == 1 ? 0.002f : 0.2f,
                                           1, shade_v3(1, 1, 1));
        if (k % 4 == 1) {
            s->state.lighting.light_count = 2;
            s->lamps[1] = shade_spot_light(above, shade_v3(0, 1, 0), 0.2f, 1, shade_v3(1, 1, 1));
        }
        s->state.view = shade_mat4_look_at(shade_v3(0, 3, 5), shade_v3(0, 0, 0), shade_v3(0, 1, 0));
        stage_is_good(s, "a pool");
        stage_close(s);
    }
}
/* Light of 0.0015: code 5 of 255 as sRGB, as floats are judged too, and 0 in a linear byte. */
TEST(explain, dim_light_is_light_where_the_format_shows_it)
{
    static const struct { shade_format format; int srgb, shown; } row[] = {
        { SHADE_FORMAT_RGBA32F, 0, 1 }, { SHADE_FORMAT_RGBA8, 1, 1 }, { SHADE_FORMAT_RGBA8, 0, 0 }
    };
    for (int k = 0; k < TEST_COUNT(row); k++) {
        stage *s = stage_open();
        canvas_close(&s->c);
        s->c = canvas_open(STAGE_WIDTH, STAGE_HEIGHT, 0, row[k].format, 1);
        s->c.target.srgb = row[k].srgb;
        s->good = s->c.target;
        s->state.material = &s->material;
        memset(&s->material, 0, sizeof s->material);
        s->material.emission = shade_v3(0.0015f, 0.0015f, 0.0015f);
        if (row[k].shown) stage_is_good(s, "dim light");
        else CHECK(*stage_explain(s, 1));
        stage_close(s);
    }
}
/* Neither buffers nor arguments change; the sentence is the same when asked again. */
TEST(explain, it_writes_nothing)
{
    for (size_t k = 0; k < sizeof mistakes / sizeof mistakes[0]; k += 7) {
        stage *s = stage_open(), *copy = (stage *)malloc(sizeof *copy);
        mistakes[k].make(s);
        unsigned char *color = (unsigned char *)malloc(s->c.color_bytes + s->c.depth_bytes);
        if (!copy || !color) exit(2);
        const char *said = stage_explain(s, 1);
        memcpy(copy, s, sizeof *s);
        memcpy(color, s->c.color + CANVAS_GUARD, s->c.color_bytes);
        memcpy(color + s->c.color_bytes, s->c.depth + CANVAS_GUARD, s->c.depth_bytes);
        if (!s->no_target && !s->no_mesh && !s->no_state) {
            shade_stats stats;
            memset(&stats, 0, sizeof stats);
            shade_explain(&s->c.target, &s->mesh, &s->state, &stats);
            shade_explain(&s->c.target, &s->mesh, &s->state, NULL);
        }
        CHECK(said && !memcmp(copy, s, sizeof *s));
        CHECK(!memcmp(color, s->c.color + CANVAS_GUARD, s->c.color_bytes));
        CHECK(!memcmp(color + s->c.color_bytes, s->c.depth + CANVAS_GUARD, s->c.depth_bytes));
        stage_close(s);
        free(copy);
        free(color);
    }
}

/* Scenes that look like a mistake in one respect and are none. */
typedef struct unusual {
    const char *name;
    void (*make)(stage *);
} unusual;
#define UNUSUAL(name) static void unusual_##name(stage *s)
UNUSUAL(texcoords_with_their_stride)
{
    s->mesh.texcoords = &s->texcoord[0].x;
    s->mesh.texcoord_stride = 8;
    s->mesh.position_stride = s->mesh.normal_stride = 12;
    s->state.diffuse_map = &s->map;
}
/* All depths are within 1e-6 of the cleared one: which of two surfaces stays is known to be chance,
   as lesson 17 shows on purpose. */
UNUSUAL(drawn_twice_where_depth_is_too_coarse)
{
    s->state.projection = shade_mat4_perspective(0.8f, 1.5f, 1e-6f, 100);
    s->draws = 2;
}
UNUSUAL(texcoords_without_a_map) { s->mesh.texcoords = &s->texcoord[0].x; }
UNUSUAL(parallel_from_the_eye) { s->state.projection = shade_mat4_ortho(-3, 3, -2, 2, 0, 20); }
UNUSUAL(near_one_half) { s->state.projection.col[3].z = -1; }
UNUSUAL(left_handed_camera)
{
    const shade_mat4 turn = shade_mat4_scaling(shade_v3(1, 1, -1));
    s->state.view = shade_mat4_mul(turn, s->state.view);
    s->state.projection = shade_mat4_mul(s->state.projection, turn);
    s->state.projection.col[3].z = -1;
}
UNUSUAL(projection_that_turns)
{
    const shade_mat4 turn = shade_mat4_rotation(0.3f, shade_v3(0, 1, 0));
    s->state.view = shade_mat4_mul(shade_mat4_inverse(turn), s->state.view);
    s->state.projection = shade_mat4_mul(s->state.projection, turn);
}
UNUSUAL(projection_that_nods)
{
    const shade_mat4 turn = shade_mat4_rotation(0.3f, shade_v3(1, 0, 0));
    s->state.view = shade_mat4_mul(shade_mat4_inverse(turn), s->state.view);
    s->state.projection = shade_mat4_mul(s->state.projection, turn);
}
UNUSUAL(view_that_scales_alone)
{
    s->state.projection = shade_mat4_identity();
    s->state.view = shade_mat4_scaling(shade_v3(0.5f, 0.5f, 0.5f));
    s->state.lighting.light_count = 1;
}
UNUSUAL(box_always_looked_into)
{
    s->mesh.chunks = &s->chunk;
    s->mesh.chunk_count = 1;
    s->chunk.low = shade_v3(1, 1, 1);
    s->chunk.high = shade_v3(-1, -1, -1);
}
/* w = 1 - z/3: the eye stands at (0, 0, 3), and matrices of the projection are identity else */
UNUSUAL(one_point_projection)
{
    memset(&s->state.view, 0, sizeof s->state.view);
    s->state.projection = shade_mat4_identity();
    s->state.projection.col[2] = shade_v4(0, 0, -0.2f, -1 / 3.0f);
    s->state.model = shade_mat4_scaling(shade_v3(0.5f, 0.5f, 0.5f));
}
UNUSUAL(shadow_on_a_plane)
{
    shade_mat4 m = shade_mat4_identity();    /* of a lamp at (2, 1, 1), onto y = 0 */
    m.col[1] = shade_v4(-2, 0, -1, -1);
    s->state.model = shade_mat4_mul(m, shade_mat4_scaling(shade_v3(0.4f, 0.4f, 0.4f)));
}
UNUSUAL(reversed_camera_along_x)
{
    const shade_mat4 turn = shade_mat4_rotation(1.57079633f, shade_v3(0, 1, 0));
    s->state.view = shade_mat4_mul(shade_mat4_inverse(turn), s->state.view);
    s->state.projection = shade_mat4_perspective_reversed(0.8f, 1.5f, 0.1f);
    s->state.projection = shade_mat4_mul(s->state.projection, turn);
    s->state.projection.col[0].x = s->state.projection.col[0].y = s->state.projection.col[0].z = 0;
    s->state.raster.depth_zero_to_one = 1;
    s->state.raster.depth_test = SHADE_COMPARE_GREATER;
    s->clear = 0;
}
/* A floor at so flat an angle that it covers a row or two. */
UNUSUAL(floor_at_a_flat_angle)
{
    static const shade_vec3 ground[4] = { { -9, 0, 9 }, { 9, 0, 9 }, { 9, 0, -9 }, { -9, 0, -9 } };
    static const uint32_t corners[6] = { 0, 1, 2, 0, 2, 3 };
    memcpy(s->position, ground, sizeof ground);
    memcpy(s->index, corners, sizeof corners);
    s->mesh.normals = NULL;
    s->mesh.index_count = 6;
    s->state.view = shade_mat4_look_at(shade_v3(0, 0.06f, 12), shade_v3(0, 0, 0),
                                       shade_v3(0, 1, 0));
}
UNUSUAL(unlit)
{
    mistake_no_light(s);
    s->state.lighting.ambient = shade_v3(1, 1, 1);
}
UNUSUAL(overlay_of_dim_ambient)
{
    mistake_no_light(s);
    stage_ambient(s);
    s->mesh.normals = NULL;
    s->state.raster.blend = SHADE_BLEND_OVER;
    s->state.transparency = 0.5f;
}
UNUSUAL(stored_where_alpha_is_zero) { s->state.transparency = 1; }
UNUSUAL(part_of_an_atlas)
{
    s->mesh.texcoords = &s->texcoord[0].x;
    s->state.diffuse_map = &s->map;
    s->map.width = s->map.height = 1;
    s->map.stride = 2;
    s->map.filter = SHADE_FILTER_TRILINEAR;    /* one texel has no mipmaps */
}
UNUSUAL(turned_by_a_quarter)
{
    const shade_mat4 turn = shade_mat4_rotation(1.57079633f, shade_v3(0, 0, 1));
    s->state.projection = shade_mat4_mul(turn, s->state.projection);
}
UNUSUAL(light_of_255_in_floats)
{
    canvas_close(&s->c);
    s->c = canvas_open(STAGE_WIDTH, STAGE_HEIGHT, STAGE_WIDTH + 3, SHADE_FORMAT_RGBA32F, 1);
    s->good = s->c.target;
    mistake_light_of_255(s);
}
UNUSUAL(lamp_in_its_glowing_globe)
{
    s->material.emission = shade_v3(0.9f, 0.9f, 0.7f);
    s->lamps[0].position = shade_v4(0, 0, 0, 1);
    s->state.lighting.light_count = 1;
}
UNUSUAL(depth_read_only) { s->state.raster.depth_read_only = 1; }
UNUSUAL(depth_alone) { s->c.target.color = NULL; }
UNUSUAL(added_without_depth)
{
    s->c.target.depth = NULL;
    s->state.raster.blend = SHADE_BLEND_ADD;
}
UNUSUAL(quad_from_behind_without_depth)
{
    mistake_wound_clockwise_quad(s);
    s->state.raster.cull = SHADE_CULL_NONE;
    s->state.lighting.flags = SHADE_FLAG_TWO_SIDED;
    s->mesh.normals = NULL;
    s->c.target.depth = NULL;
}
UNUSUAL(room)
{
    mistake_inside_out(s);
    for (int i = 0; i < STAGE_VERTICES; i++) s->normal[i] = shade_neg(s->normal[i]);
    s->state.view = shade_mat4_look_at(shade_v3(0, 0, 0.2f), shade_v3(0, 0, -1), shade_v3(0, 1, 0));
    s->lamps[0].position = shade_v4(0, 0, 0.1f, 1);
}
UNUSUAL(highlight_of_less_than_a_pixel)
{
    s->material.diffuse = s->material.ambient = shade_v3(0, 0, 0);
    s->material.shininess = 100000;
}
UNUSUAL(wound_inward_without_culling)
{
    mistake_inside_out(s);
    s->state.raster.cull = SHADE_CULL_NONE;
}
UNUSUAL(mirrored_without_culling)
{
    mistake_mirrored(s);
    s->state.raster.cull = SHADE_CULL_NONE;
}
UNUSUAL(black_outline)
{
    memset(&s->material, 0, sizeof s->material);
    s->state.raster.cull = SHADE_CULL_FRONT;
}
static void shader_white(const void *uniforms, const shade_fragments *SHADE_RESTRICT in,
                         shade_colors *SHADE_RESTRICT out)
{
    (void)uniforms;
    (void)in;
    for (int k = 0; k < 4; k++)
        SHADE_EACH_LANE(i) { out->color[k][i] = 1; }
}
UNUSUAL(shader_with_alpha_of_its_own)
{
    mistake_map_cut_by_alpha(s);
    s->state.fragment = shader_white;
}
UNUSUAL(shader_that_maps_by_itself)
{
    s->state.fragment = shader_white;
    s->state.diffuse_map = &s->map;
}
/* Columns of the picture, as threads may take them: the mesh lies in others. */
UNUSUAL(columns_beside_the_mesh)
{
    s->c.target.clip_width = 4;
    s->c.target.clip_height = STAGE_HEIGHT;
}
static const unsigned char one_texel[4] = { 255, 255, 255, 255 };
static const shade_texture last_mipmap = { .pixels = one_texel, .width = 1, .height = 1 };
UNUSUAL(trilinear_with_mipmaps)
{
    mistake_trilinear_without_mipmaps(s);
    s->map.mipmaps = &last_mipmap;
    s->map.mipmap_count = 1;
}
/* Its last column, (0, 0, 1, 0), is also that of a transposed matrix. */
UNUSUAL(reversed_with_near_one)
{
    s->state.projection = shade_mat4_perspective_reversed(0.8f, 1.5f, 1);
    s->state.raster.depth_zero_to_one = 1;
    s->state.raster.depth_test = SHADE_COMPARE_GREATER;
    s->clear = 0;
}
/* Each triangle lies there twice, the back of it first. */
UNUSUAL(faces_of_both_sides)
{
    static uint32_t both[2 * STAGE_INDICES];
    for (int i = 0; i < STAGE_INDICES; i += 3) {
        const uint32_t *t = s->index + i;
        const uint32_t two[6] = { t[0], t[2], t[1], t[0], t[1], t[2] };
        memcpy(both + 2 * i, two, sizeof two);
    }
    s->mesh.indices = both;
    s->mesh.index_count = 2 * STAGE_INDICES;
    s->state.raster.cull = SHADE_CULL_BACK;
}
UNUSUAL(normals_that_faces_do_not_take)
{
    mistake_normals_against_the_winding(s);
    s->state.shading = SHADE_SHADING_PER_FACE;
}
UNUSUAL(normals_that_no_lamp_meets)
{
    mistake_normals_against_the_winding(s);
    s->state.lighting.lights = NULL;
    s->state.lighting.light_count = 0;
    s->state.lighting.ambient = shade_v3(1, 1, 1);
}
UNUSUAL(normals_of_both_sides)
{
    mistake_normals_against_the_winding(s);
    s->state.lighting.flags = SHADE_FLAG_TWO_SIDED;
}
/* Light of 1.2 to 1.8 is clipped, but not that of numbers up to 255. */
UNUSUAL(overexposed)
{
    s->state.lighting.ambient = shade_v3(3, 3, 3);
    for (int i = 0; i < 2; i++)
        s->lamps[i].diffuse = s->lamps[i].specular = shade_v3(0.05f, 0.05f, 0.05f);
}
UNUSUAL(ambient_term_alone)
{
    mistake_ambient_and_lamp_behind(s);
    s->state.lighting.terms = SHADE_TERM_AMBIENT;
}
/* The pixels of a display need not be square, and windows are rounded to whole ones. */
UNUSUAL(aspect_rounded) { s->state.projection = shade_mat4_perspective(0.8f, 1.47f, 0.1f, 100); }
/* Of these the aspect does not follow from two entries. */
UNUSUAL(projection_that_shears)
{
    s->state.projection.col[0].x *= 2;
    s->state.projection.col[1].x = 0.3f;
}
UNUSUAL(projection_of_a_keystone)
{
    s->state.projection.col[0].x *= 2;
    s->state.projection.col[1].w = 0.1f;
}

TEST(explain, depth_that_changed_since_the_draw_is_not_blamed)
{
    stage *s = stage_open();
    shade_stats stats;
    shade_clear(&s->c.target, shade_v4(0, 0, 0, 1), 0);
    CHECK_INT(shade_draw_mesh(&s->c.target, &s->mesh, &s->state, &stats), SHADE_OK);
    CHECK(stats.drawn > 0 && stats.fragments == 0);
    CHECK(strstr(shade_explain(&s->c.target, &s->mesh, &s->state, &stats), "depth") != NULL);
    shade_clear(&s->c.target, shade_v4(0, 0, 0, 1), 1);
    CHECK(!*shade_explain(&s->c.target, &s->mesh, &s->state, &stats));
    stage_close(s);
}

/* The lower half of the ball alone would be inside out. */
TEST(explain, a_band_is_not_blamed_for_its_half_of_a_mesh)
{
    stage *s = stage_open();
    stage_turn(s, STAGE_INDICES / 2);
    s->state.view = shade_mat4_look_at(shade_v3(0, 0, 4), shade_v3(0, 0, 0), shade_v3(0, 1, 0));
    stage_is_good(s, "whole");
    s->c.target.clip_y = STAGE_HEIGHT / 2;
    s->c.target.clip_width = STAGE_WIDTH;
    s->c.target.clip_height = STAGE_HEIGHT / 2;
    stage_is_good(s, "the lower band");
    stage_close(s);
}

/* A multiple of a projection is the same one, though its -1 is another number then, and though the
   transposed one shows the mesh. */
TEST(explain, a_multiple_of_a_projection_is_the_same_one)
{
    stage *s = stage_open();
    const char *said;
    s->state.projection = shade_mat4_perspective(0.8f, 1.5f, 6, 100);
    for (int i = 0; i < 4; i++) {
        shade_vec4 *column = &s->state.projection.col[i];
        *column = shade_v4(column->x / 2, column->y / 2, column->z / 2, column->w / 2);
    }
    said = stage_explain(s, 1);
    CHECK_SAY(strstr(said, "nearer than the near plane") != NULL, "\"%s\"", said);
    stage_close(s);
}

/* A band may be hidden whole while the picture is not, and a draw without stats may have drawn what
   is stored nearer. */
TEST(explain, depth_is_blamed_after_whole_draws_with_stats_alone)
{
    stage *s = stage_open();
    s->clear = 0.25f;
    CHECK(strstr(stage_explain(s, 1), "What target.depth holds hides") != NULL);
    CHECK(!*stage_explain(s, 0));
    s->c.target.clip_width = STAGE_WIDTH;
    s->c.target.clip_height = STAGE_HEIGHT - 1;
    stage_is_good(s, "a band that is hidden");
    s->c.target.clip_x = 1;
    s->c.target.clip_width = STAGE_WIDTH - 1;
    s->c.target.clip_height = STAGE_HEIGHT;
    stage_is_good(s, "a band of columns that is hidden");
    s->c.target.clip_x = 0;
    s->c.target.clip_y = 4;
    s->c.target.clip_width = STAGE_WIDTH;
    s->c.target.clip_height = STAGE_HEIGHT - 8;
    stage_is_good(s, "a band in the middle that is hidden");
    stage_close(s);
}

TEST(explain, what_is_unusual_is_no_mistake)
{
    static const unusual all[] = {
        { "texcoords with their stride", unusual_texcoords_with_their_stride },
        { "drawn twice, where depth is too coarse", unusual_drawn_twice_where_depth_is_too_coarse },
        { "texcoords without a map", unusual_texcoords_without_a_map },
        { "parallel from the eye", unusual_parallel_from_the_eye },
        { "near at one half", unusual_near_one_half },
        { "a left-handed camera", unusual_left_handed_camera },
        { "faces of both sides", unusual_faces_of_both_sides },
        { "normals that faces do not take", unusual_normals_that_faces_do_not_take },
        { "normals that no lamp meets", unusual_normals_that_no_lamp_meets },
        { "normals of both sides", unusual_normals_of_both_sides },
        { "overexposed", unusual_overexposed },
        { "the ambient term alone", unusual_ambient_term_alone },
        { "an aspect rounded by 2 %", unusual_aspect_rounded },
        { "a projection that turns", unusual_projection_that_turns },
        { "a projection that nods", unusual_projection_that_nods },
        { "a view that scales, without projection", unusual_view_that_scales_alone },
        { "a box always looked into", unusual_box_always_looked_into },
        { "a one-point projection", unusual_one_point_projection },
        { "a shadow on a plane", unusual_shadow_on_a_plane },
        { "a reversed camera along x", unusual_reversed_camera_along_x },
        { "a floor at a flat angle", unusual_floor_at_a_flat_angle },
        { "unlit", unusual_unlit },
        { "an overlay of dim ambient light", unusual_overlay_of_dim_ambient },
        { "stored where alpha is zero", unusual_stored_where_alpha_is_zero },
        { "part of an atlas", unusual_part_of_an_atlas },
        { "turned by a quarter", unusual_turned_by_a_quarter },
        { "light of 255 in floats", unusual_light_of_255_in_floats },
        { "a lamp in its glowing globe", unusual_lamp_in_its_glowing_globe },
        { "depth read only", unusual_depth_read_only },
        { "depth alone", unusual_depth_alone },
        { "added without depth", unusual_added_without_depth },
        { "a quad from behind without depth", unusual_quad_from_behind_without_depth },
        { "a room", unusual_room },
        { "a highlight of less than a pixel", unusual_highlight_of_less_than_a_pixel },
        { "wound inward, without culling", unusual_wound_inward_without_culling },
        { "mirrored, without culling", unusual_mirrored_without_culling },
        { "a black outline", unusual_black_outline },
        { "a shader with alpha of its own", unusual_shader_with_alpha_of_its_own },
        { "a shader that maps by itself", unusual_shader_that_maps_by_itself },
        { "columns beside the mesh", unusual_columns_beside_the_mesh },
        { "mipmaps that are there", unusual_trilinear_with_mipmaps },
        { "reversed, near at one", unusual_reversed_with_near_one },
        { "a projection that shears", unusual_projection_that_shears },
        { "a keystone", unusual_projection_of_a_keystone },
    };
    for (size_t k = 0; k < sizeof all / sizeof all[0]; k++) {
        stage *s = stage_open();
        all[k].make(s);
        stage_is_good(s, all[k].name);
        stage_close(s);
    }
}

/* The fuzz target of tests/fuzz/explain.c goes on where these end. */
TEST(explain, no_sentence_about_a_random_draw_is_false)
{
    static explained e;
    int said = 0;
    for (int k = 0; k < 4000; k++) {
        const char *wrong = ex_false_sentence(&e, k % 4 == 3);
        CHECK_SAY(!wrong, "draw %d: \"%s\"", k, wrong ? wrong : "");
        said += *shade_explain(&e.target, &e.mesh, &e.state, &e.stats) != 0;
    }
    CHECK(said > 2000 && said < 3800);
}

/* One draw in 140,000 is of these kinds: a bias that makes all depths 1, so that hidden fragments
   equal the stored depth; fragments over each other, where depth is read only; and a map whose
   holes show the back, while a white surface would have none. */
TEST(explain, no_sentence_about_a_rare_draw_is_false)
{
    static const uint32_t seeds[] = { 482357, 519162, 637204, 830954, 955739, 551290, 822060 };
    static explained e;
    for (int k = 0; k < TEST_COUNT(seeds); k++) {
        test_now.state = (uint64_t)seeds[k] * 1000003;
        const char *wrong = ex_false_sentence(&e, 0);
        CHECK_SAY(!wrong, "draw %d: \"%s\"", (int)seeds[k], wrong ? wrong : "");
    }
}

static void nasty_floats(void *at, size_t bytes)
{
    for (size_t i = 0; i < bytes / 4; i++) {
        const float f = rnd_nasty();
        memcpy((char *)at + 4 * i, &f, 4);
    }
}
static int nasty_count(int good) { return rnd_one_in(3) ? rnd_int(-2, 9) : good; }

/* Anything but pointers, counts and strides: a sentence or none, memory that is not left (the
   sanitizers of .ci/run look), and refusals exactly where the draw refuses. */
/* G3 */
TEST(explain, hostile_input_is_defined)
{
    for (int k = 0; k < 1500; k++) {
        stage *s = stage_open();
        shade_stats stats;
        if (rnd_one_in(4)) stage_leave_depth(s, rnd_int(0, 255));
        if (rnd_one_in(3)) nasty_floats(s->position, sizeof s->position);
        if (rnd_one_in(3)) nasty_floats(s->normal, sizeof s->normal);
        if (rnd_one_in(3)) nasty_floats(s->lamps, sizeof s->lamps);
        if (rnd_one_in(3)) nasty_floats(&s->material, sizeof s->material);
        if (rnd_one_in(4)) nasty_floats(&s->state.model, sizeof s->state.model);
        if (rnd_one_in(4)) nasty_floats(&s->state.view, sizeof s->state.view);
        if (rnd_one_in(4)) nasty_floats(&s->state.projection, sizeof s->state.projection);
        if (rnd_one_in(3)) nasty_floats(s->texcoord, sizeof s->texcoord);
        if (rnd_one_in(2)) {
            s->mesh.texcoords = &s->texcoord[0].x;
            s->state.diffuse_map = &s->map;
        }
        if (rnd_one_in(8)) s->index[rnd_int(0, STAGE_INDICES - 1)] = (uint32_t)rnd_bits();
        if (rnd_one_in(8)) s->mesh.index_count = nasty_count(STAGE_INDICES);
        if (rnd_one_in(8)) {
            s->mesh.chunks = &s->chunk;
            s->mesh.chunk_count = rnd_int(-1, 1);
        }
        if (rnd_one_in(8)) {
            s->chunk.first = rnd_int(-1, 99);
            s->chunk.count = nasty_count(300);
        }
        if (rnd_one_in(8)) s->state.transparency = rnd_nasty();
        if (rnd_one_in(8)) s->state.alpha_cutoff = rnd_nasty();
        if (rnd_one_in(8)) s->state.raster.depth_bias = rnd_nasty();
        if (rnd_one_in(2)) s->state.raster.cull = (shade_cull)rnd_int(0, 3);
        if (rnd_one_in(2)) s->state.raster.depth_test = (shade_compare)rnd_int(0, 6);
        if (rnd_one_in(2)) s->state.raster.depth_zero_to_one = 1;
        if (rnd_one_in(4)) s->state.lighting.flags = (unsigned)rnd_int(0, 63);
        if (rnd_one_in(4)) s->c.target.depth = NULL;
        if (rnd_one_in(4)) {
            s->c.target.clip_x = rnd_int(-9, 99);
            s->c.target.clip_width = 20;
        }
        if (rnd_one_in(4)) {
            s->c.target.clip_y = rnd_int(-9, 99);
            s->c.target.clip_height = 20;
        }
        if (rnd_one_in(4)) {
            s->c.target.row_offset = 7;
            s->c.target.row_count = rnd_int(-1, 60);
        }
        const shade_result result = shade_draw_mesh(&s->c.target, &s->mesh, &s->state, &stats);
        const char *with = shade_explain(&s->c.target, &s->mesh, &s->state, &stats);
        const char *without = shade_explain(&s->c.target, &s->mesh, &s->state, NULL);
        CHECK_SAY(with && without && (!result || *without), "%s", shade_result_string(result));
        stage_close(s);
    }
}

static const test_case explain_cases[] = {
    CASE(explain, every_mistake_gets_the_word_that_leads_to_it),
    CASE(explain, the_scene_without_a_mistake_gets_none),
    CASE(explain, random_good_scenes_get_none),
    CASE(explain, what_other_meshes_explain_gets_none),
    CASE(explain, of_more_than_sixteen_lamps_no_colour_is_blamed),
    CASE(explain, of_faces_no_normals_are_blamed),
    CASE(explain, of_a_pool_beside_the_middle_of_a_face_nothing_is_said),
    CASE(explain, a_draw_that_had_pixels_is_not_said_to_have_none),
    CASE(explain, small_pools_of_light_are_light),
    CASE(explain, dim_light_is_light_where_the_format_shows_it),
    CASE(explain, a_band_is_not_blamed_for_its_half_of_a_mesh),
    CASE(explain, a_multiple_of_a_projection_is_the_same_one),
    CASE(explain, depth_is_blamed_after_whole_draws_with_stats_alone),
    CASE(explain, what_is_unusual_is_no_mistake),
    CASE(explain, depth_that_changed_since_the_draw_is_not_blamed),
    CASE(explain, no_sentence_about_a_random_draw_is_false),
    CASE(explain, no_sentence_about_a_rare_draw_is_false),
    CASE(explain, it_writes_nothing),
    CASE(explain, hostile_input_is_defined),
};

SECTION(explain);
