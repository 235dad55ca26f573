/* beginner.c - README's first program with one field forgotten or wrong: shade_explain names it, or
   the picture is the one that was asked for. */
#include "unit.h"
#include "examples/shared/teapot.h"

enum { POT_WIDTH = 160, POT_HEIGHT = 120, POT_FINE = 4, POT_VERTICES = 604, POT_INDICES = 2976 };

typedef struct pot {
    uint32_t pixels[POT_WIDTH * POT_HEIGHT], indices[POT_INDICES];
    float depth[POT_WIDTH * POT_HEIGHT];
    float positions[3 * POT_VERTICES], normals[3 * POT_VERTICES];
    shade_target target;
    shade_mesh mesh;
    shade_light lamp;
    shade_material gold;
    shade_draw_state state;
    float clear;                           /* depth; NaN: shade_clear is not called */
    int frames;
} pot;

static pot *pot_open(void)
{
    pot *p = (pot *)calloc(1, sizeof *p);
    if (!p) exit(2);
    p->target.width = POT_WIDTH;
    p->target.height = POT_HEIGHT;
    p->target.color = p->pixels;
    p->target.depth = p->depth;
    p->target.srgb = 1;
    p->mesh.positions = p->positions;
    p->mesh.normals = p->normals;
    p->mesh.vertex_count = teapot_vertex_count(POT_FINE);
    p->mesh.indices = p->indices;
    p->mesh.index_count = teapot_index_count(POT_FINE);
    p->lamp = shade_point_light(shade_v3(4, 6, 5), shade_v3(1, 1, 1));
    p->gold = shade_linear_material(shade_preset_material(SHADE_PRESET_GOLD));
    p->state.view = shade_mat4_look_at(shade_v3(0, 4, 8), shade_v3(0, 1.4f, 0),
                                       shade_v3(0, 1, 0));
    p->state.projection = shade_mat4_perspective(0.7f, 640 / 480.0f, 0.1f, 100);
    p->state.material = &p->gold;
    p->state.lighting.lights = &p->lamp;
    p->state.lighting.light_count = 1;
    teapot_build(POT_FINE, p->positions, p->normals, NULL, p->indices);
    p->clear = 1;
    p->frames = 1;
    return p;
}

/* How many pixels differ from the cleared picture. */
static int pot_pixels(const pot *p)
{
    int n = 0;
    for (int i = 0; i < POT_WIDTH * POT_HEIGHT; i++) n += p->pixels[i] != p->pixels[0];
    return n;
}

#define BEGINNER(name) static void beginner_##name(pot *p)
BEGINNER(width_and_height_exchanged)
{
    p->target.width = POT_HEIGHT;
    p->target.height = POT_WIDTH;
}
BEGINNER(width_forgotten) { p->target.width = 0; }
BEGINNER(height_forgotten) { p->target.height = 0; }
BEGINNER(no_buffers) { p->target.color = p->target.depth = NULL; }
BEGINNER(color_forgotten) { p->target.color = NULL; }
BEGINNER(depth_forgotten) { p->target.depth = NULL; }
BEGINNER(srgb_forgotten) { p->target.srgb = 0; }
BEGINNER(clip_of_a_corner_to_draw_in_all)
{
    p->target.clip_x = POT_WIDTH;
    p->target.clip_y = POT_HEIGHT;
}

BEGINNER(positions_forgotten) { p->mesh.positions = NULL; }
BEGINNER(normals_forgotten) { p->mesh.normals = NULL; }
BEGINNER(vertex_count_forgotten) { p->mesh.vertex_count = 0; }
BEGINNER(vertex_count_of_another_teapot) { p->mesh.vertex_count = teapot_vertex_count(2); }
BEGINNER(indices_forgotten) { p->mesh.indices = NULL; }
BEGINNER(index_count_forgotten) { p->mesh.index_count = 0; }
BEGINNER(index_count_of_triangles) { p->mesh.index_count = POT_INDICES / 3; }
BEGINNER(index_count_less_one) { p->mesh.index_count = POT_INDICES - 1; }
BEGINNER(stride_in_floats) { p->mesh.position_stride = 3; }
BEGINNER(never_built)
{
    memset(p->positions, 0, sizeof p->positions);
    memset(p->normals, 0, sizeof p->normals);
    memset(p->indices, 0, sizeof p->indices);
}
BEGINNER(normals_never_filled) { memset(p->normals, 0, sizeof p->normals); }
BEGINNER(normals_turned)
{
    for (int i = 0; i < 3 * POT_VERTICES; i++) p->normals[i] = -p->normals[i];
}
BEGINNER(indices_of_16_bits)
{
    for (uint32_t i = 0; i < POT_INDICES / 2; i++)
        p->indices[i] = p->indices[2 * i] | p->indices[2 * i + 1] << 16;
}

BEGINNER(lamp_never_filled) { memset(&p->lamp, 0, sizeof p->lamp); }
BEGINNER(lamp_black) { p->lamp = shade_point_light(shade_v3(4, 6, 5), shade_v3(0, 0, 0)); }
BEGINNER(lamp_of_255) { p->lamp = shade_point_light(shade_v3(4, 6, 5), shade_v3(255, 255, 255)); }
BEGINNER(lamp_behind) { p->lamp.position = shade_v4(0, -2, -9, 1); }
BEGINNER(lamp_inside) { p->lamp.position = shade_v4(0, 1, 0, 1); }
BEGINNER(lamp_far_away_that_falls_off)
{
    p->lamp.position = shade_v4(40, 60, 50, 1);
    p->lamp.quadratic = 1;
}
BEGINNER(sun_toward_the_light)
{
    p->lamp = shade_directional_light(shade_v3(0, 4, 8), shade_v3(1, 1, 1));
}
BEGINNER(cutoff_in_degrees)
{
    p->lamp = shade_spot_light(shade_v3(4, 6, 5), shade_v3(-4, -5, -5), 0.5f, 1,
                               shade_v3(1, 1, 1));
    p->lamp.spot_cos_cutoff = 30;
}
BEGINNER(spot_at_a_point)    /* where the direction belongs */
{
    p->lamp = shade_spot_light(shade_v3(4, 6, 5), shade_v3(0, 1.4f, 0), 0.3f, 1,
                               shade_v3(1, 1, 1));
}
BEGINNER(lights_forgotten) { p->state.lighting.lights = NULL; }
BEGINNER(light_count_forgotten) { p->state.lighting.light_count = 0; }
BEGINNER(lighting_forgotten) { memset(&p->state.lighting, 0, sizeof p->state.lighting); }
BEGINNER(lighting_of_ambient_alone)
{
    beginner_lighting_forgotten(p);
    p->state.lighting.ambient = shade_v3(0.2f, 0.2f, 0.2f);
}
BEGINNER(terms_of_nothing) { p->state.lighting.terms = SHADE_TERM_EMISSION; }
BEGINNER(model_of_emission) { p->state.lighting.model = SHADE_MODEL_EMISSIVE; }

BEGINNER(material_forgotten) { p->state.material = NULL; }
BEGINNER(material_never_filled) { memset(&p->gold, 0, sizeof p->gold); }
BEGINNER(material_of_255)
{
    p->gold.diffuse = p->gold.ambient = shade_v3(255, 200, 100);
}
BEGINNER(color_of_ambient_alone) { p->gold.diffuse = p->gold.specular = shade_v3(0, 0, 0); }

BEGINNER(view_forgotten) { memset(&p->state.view, 0, sizeof p->state.view); }
BEGINNER(eye_and_center_exchanged)
{
    p->state.view = shade_mat4_look_at(shade_v3(0, 1.4f, 0), shade_v3(0, 4, 8),
                                       shade_v3(0, 1, 0));
}
BEGINNER(looks_the_other_way)
{
    p->state.view = shade_mat4_look_at(shade_v3(0, 4, 8), shade_v3(0, 6, 16), shade_v3(0, 1, 0));
}
BEGINNER(view_inverted) { p->state.view = shade_mat4_inverse(p->state.view); }
BEGINNER(view_by_rows) { p->state.view = shade_mat4_transpose(p->state.view); }
BEGINNER(view_nan) { p->state.view.col[3].x = NAN; }
BEGINNER(eye_a_thousand_away)
{
    p->state.view = shade_mat4_look_at(shade_v3(0, 400, 800), shade_v3(0, 1.4f, 0),
                                       shade_v3(0, 1, 0));
}
BEGINNER(projection_forgotten) { memset(&p->state.projection, 0, sizeof p->state.projection); }
BEGINNER(both_cameras_forgotten)
{
    beginner_view_forgotten(p);
    beginner_projection_forgotten(p);
}
BEGINNER(fovy_in_degrees) { p->state.projection = shade_mat4_perspective(40, 4 / 3.0f, 0.1f, 100); }
BEGINNER(aspect_of_integers)
{
    p->state.projection = shade_mat4_perspective(0.7f, 640 / 480, 0.1f, 100);
}
BEGINNER(aspect_upside_down)
{
    p->state.projection = shade_mat4_perspective(0.7f, 480 / 640.0f, 0.1f, 100);
}
BEGINNER(aspect_of_zero)
{
    p->state.projection = shade_mat4_perspective(0.7f, 480 / 640, 0.1f, 100);
}
BEGINNER(near_of_zero) { p->state.projection = shade_mat4_perspective(0.7f, 4 / 3.0f, 0, 100); }
BEGINNER(near_negative) { p->state.projection = shade_mat4_perspective(0.7f, 4 / 3.0f, -1, 100); }
BEGINNER(near_is_far) { p->state.projection = shade_mat4_perspective(0.7f, 4 / 3.0f, 100, 100); }
BEGINNER(near_and_far_exchanged)
{
    p->state.projection = shade_mat4_perspective(0.7f, 4 / 3.0f, 100, 0.1f);
}
BEGINNER(far_too_near) { p->state.projection = shade_mat4_perspective(0.7f, 4 / 3.0f, 0.1f, 2); }
BEGINNER(near_too_far) { p->state.projection = shade_mat4_perspective(0.7f, 4 / 3.0f, 50, 100); }
BEGINNER(projection_by_rows)
{
    p->state.projection = shade_mat4_transpose(p->state.projection);
}
BEGINNER(view_and_projection_exchanged)
{
    const shade_mat4 view = p->state.view;
    p->state.view = p->state.projection;
    p->state.projection = view;
}
BEGINNER(reversed_camera_in_half)    /* without the flag, the test and the clear that it needs */
{
    p->state.projection = shade_mat4_perspective_reversed(0.7f, 4 / 3.0f, 0.1f);
}
BEGINNER(reversed_camera_without_its_test)
{
    beginner_reversed_camera_in_half(p);
    p->state.raster.depth_zero_to_one = 1;
}
BEGINNER(model_scaled_to_nothing) { p->state.model = shade_mat4_scaling(shade_v3(0, 0, 0)); }
BEGINNER(model_in_millimetres) { p->state.model = shade_mat4_scaling(shade_v3(1e3f, 1e3f, 1e3f)); }
BEGINNER(model_far_too_small)
{
    p->state.model = shade_mat4_scaling(shade_v3(1e-4f, 1e-4f, 1e-4f));
}
BEGINNER(model_moved_away) { p->state.model = shade_mat4_translation(shade_v3(70, 0, 0)); }
BEGINNER(model_by_rows)
{
    p->state.model = shade_mat4_transpose(shade_mat4_translation(shade_v3(1, 0, 0)));
}

BEGINNER(clear_forgotten) { p->clear = NAN; }
BEGINNER(cleared_to_zero) { p->clear = 0; }
BEGINNER(cleared_once_for_two_frames) { p->frames = 2; }
BEGINNER(test_greater) { p->state.raster.depth_test = SHADE_COMPARE_GREATER; }
BEGINNER(test_equal) { p->state.raster.depth_test = SHADE_COMPARE_EQUAL; }
BEGINNER(bias_of_one) { p->state.raster.depth_bias = 1; }
BEGINNER(fronts_left_out) { p->state.raster.cull = SHADE_CULL_FRONT; }
BEGINNER(backs_left_out) { p->state.raster.cull = SHADE_CULL_BACK; }
BEGINNER(wound_clockwise)
{
    for (int i = 0; i < POT_INDICES; i += 3) {
        const uint32_t k = p->indices[i];
        p->indices[i] = p->indices[i + 1];
        p->indices[i + 1] = k;
    }
    p->state.raster.cull = SHADE_CULL_BACK;
}
BEGINNER(invisible)
{
    p->state.transparency = 1;
    p->state.raster.blend = SHADE_BLEND_OVER;
}
BEGINNER(opacity_for_transparency)
{
    p->state.transparency = 1;
    p->state.alpha_cutoff = 0.5f;
}
BEGINNER(transparency_in_percent) { p->state.transparency = 50; }
BEGINNER(map_without_texcoords)
{
    static const uint32_t texel = 0xffffffff;
    static const shade_texture map = { .pixels = &texel, .width = 1, .height = 1 };
    p->state.diffuse_map = &map;
}

/* Without a word: nothing is wrong, or nothing that the draw could tell.  A lamp behind the pot or
   inside of it still lights a rim, or the far side of a wall, and an eye inside may be meant. */
#define SAYS(name, word) { #name, word, beginner_##name }
#define IS_FINE(name) { #name, "", beginner_##name }
static const struct { const char *name, *word; void (*make)(pot *); } beginners[] = {
    SAYS(width_and_height_exchanged, "aspect"), SAYS(width_forgotten, "target.width"),
    SAYS(height_forgotten, "target.height"), SAYS(no_buffers, "target.color"),
    IS_FINE(color_forgotten), SAYS(depth_forgotten, "target.depth is NULL"),
    IS_FINE(srgb_forgotten), SAYS(clip_of_a_corner_to_draw_in_all, "clip rectangle"),
    SAYS(positions_forgotten, "mesh.positions"), IS_FINE(normals_forgotten),
    SAYS(vertex_count_forgotten, "mesh.vertex_count"),
    SAYS(vertex_count_of_another_teapot, "mesh.vertex_count"),
    SAYS(indices_forgotten, "mesh.indices"), SAYS(index_count_forgotten, "mesh.index_count"),
    SAYS(index_count_of_triangles, "index_count"), SAYS(index_count_less_one, "multiple of 3"),
    SAYS(stride_in_floats, "bytes"), SAYS(never_built, "mesh.indices"),
    SAYS(normals_never_filled, "mesh.normals are zero"),
    SAYS(normals_turned, "mesh.normals point away"), SAYS(indices_of_16_bits, "32 bits"),
    SAYS(lamp_never_filled, "no colour"), SAYS(lamp_black, "no colour"),
    SAYS(lamp_of_255, "not 255"), IS_FINE(lamp_behind), IS_FINE(lamp_inside),
    SAYS(lamp_far_away_that_falls_off, "Attenuation"), IS_FINE(sun_toward_the_light),
    SAYS(cutoff_in_degrees, "cosine"), SAYS(spot_at_a_point, "spot_direction"),
    SAYS(lights_forgotten, "lighting.lights"), SAYS(light_count_forgotten, "light_count"),
    SAYS(lighting_forgotten, "There is no light"),
    SAYS(lighting_of_ambient_alone, "Only ambient light"),
    SAYS(terms_of_nothing, "lighting.terms"), SAYS(model_of_emission, "lighting.model"),
    IS_FINE(material_forgotten), SAYS(material_never_filled, "state.material reflects nothing"),
    SAYS(material_of_255, "not 255"), SAYS(color_of_ambient_alone, "lamps need diffuse"),
    SAYS(view_forgotten, "state.view"), IS_FINE(eye_and_center_exchanged),
    SAYS(looks_the_other_way, "behind the eye"), SAYS(view_inverted, "inverse"),
    SAYS(view_by_rows, "state.view looks transposed"), SAYS(view_nan, "NaN"),
    SAYS(eye_a_thousand_away, "beyond the far plane"),
    SAYS(projection_forgotten, "state.projection is unset"),
    SAYS(both_cameras_forgotten, "state.view"), SAYS(fovy_in_degrees, "radians"),
    SAYS(aspect_of_integers, "aspect"), SAYS(aspect_upside_down, "aspect"),
    SAYS(aspect_of_zero, "aspect"), SAYS(near_of_zero, "near and far above 0"),
    SAYS(near_negative, "near and far above 0"), SAYS(near_is_far, "different"),
    SAYS(near_and_far_exchanged, "depth_test"), SAYS(far_too_near, "beyond the far plane"),
    SAYS(near_too_far, "nearer than the near plane"),
    SAYS(projection_by_rows, "state.projection looks transposed"),
    SAYS(view_and_projection_exchanged, "swapped"),
    SAYS(reversed_camera_in_half, "depth_zero_to_one"),
    SAYS(reversed_camera_without_its_test, "depth_test"),
    SAYS(model_scaled_to_nothing, "state.model scales by 0"),
    SAYS(model_in_millimetres, "move the eye out"), SAYS(model_far_too_small, "too small"),
    SAYS(model_moved_away, "state.model"), SAYS(model_by_rows, "state.model looks transposed"),
    SAYS(clear_forgotten, "shade_clear"), SAYS(cleared_to_zero, "shade_clear"),
    SAYS(cleared_once_for_two_frames, "shade_clear"), SAYS(test_greater, "SHADE_COMPARE_LESS"),
    SAYS(test_equal, "target.depth"), SAYS(bias_of_one, "depth_bias"),
    IS_FINE(fronts_left_out), IS_FINE(backs_left_out), SAYS(wound_clockwise, "inside out"),
    SAYS(invisible, "transparency"), SAYS(opacity_for_transparency, "alpha_cutoff"),
    SAYS(transparency_in_percent, "state.transparency"),
    SAYS(map_without_texcoords, "mesh.texcoords"),
};

static const char *pot_explain(pot *p)
{
    shade_stats stats;
    if (p->clear == p->clear)
        shade_clear(&p->target, shade_v4(0.02f, 0.02f, 0.05f, 1), p->clear);
    for (int k = 0; k < p->frames; k++) shade_draw_mesh(&p->target, &p->mesh, &p->state, &stats);
    return shade_explain(&p->target, &p->mesh, &p->state, &stats);
}

TEST(beginner, the_first_program_has_a_picture_and_no_sentence)
{
    pot *p = pot_open();
    CHECK_SAY(!*pot_explain(p), "%s", pot_explain(p));
    CHECK(pot_pixels(p) > POT_WIDTH * POT_HEIGHT / 8);
    free(p);
}

TEST(beginner, each_mistake_in_the_first_program_is_named)
{
    for (int k = 0; k < TEST_COUNT(beginners); k++) {
        pot *p = pot_open();
        beginners[k].make(p);
        const char *said = pot_explain(p), *word = beginners[k].word;
        CHECK_SAY(*word ? strstr(said, word) != NULL : !*said, "%s: \"%s\"", beginners[k].name,
                  said);
        free(p);
    }
}

static const test_case beginner_cases[] = {
    CASE(beginner, the_first_program_has_a_picture_and_no_sentence),
    CASE(beginner, each_mistake_in_the_first_program_is_named),
};

SECTION(beginner);
