/* explain.c - shade_explain: each mistake, made on a good scene, gets a sentence that names the
   field to look at; good scenes get none; what is said of random draws is so; hostile ones cost no
   memory and no crash. */
#include "unit.h"
#include "mistakes.h"

static int explained_pick(int n) { return rnd_int(0, n - 1); }
#include "../fuzz/explained.h"

/* Does what is said hold one of the words between bars?  Or else nothing, where there are none; a
   bar at the end allows both. */
static int is_said(const char *said, const char *words)
{
    char word[64];
    if (!*words) return !*said;
    if (!*said && words[strlen(words) - 1] == '|') return 1;
    for (; *words; words += *words == '|') {
        const size_t n = strcspn(words, "|");
        snprintf(word, sizeof word, "%.*s", (int)n, words);
        if (strstr(said, word)) return 1;
        words += n;
    }
    return 0;
}
TEST(explain, every_mistake_gets_the_word_that_leads_to_it)
{
    stage *s = stage_open();
    for (const mistake *m = mistake_first; m; m = m->next)
        for (int where = 0; where < 4; where++) {
            const int on = where & 1 ? ON_TEAPOT : ON_BALL, with_stats = where >> 1;
            if (!(m->scenes & on) || (!with_stats && (m->scenes & WITH_STATS))) continue;
            if (on == ON_BALL) stage_of_ball(s);
            else stage_of_teapot(s);
            m->make(s);
            const char *said = stage_explain(s, with_stats);
            CHECK_SAY(is_said(said, m->words), "%s, on the %s, %s stats, wants \"%s\": \"%s\"",
                      m->name, on == ON_BALL ? "ball" : "teapot",
                      with_stats ? "with" : "without", m->words, said);
        }
    free(s);
}

/* What may be meant: of a newcomer's mistakes on README's first program nothing is said of these,
   and of no others. */
TEST(explain, no_more_than_these_mistakes_are_silent)
{
    static const char *const silent[] = {
        "color_forgotten", "srgb_forgotten", "red_and_blue_exchanged", "flag_of_vulkan_alone",
        "normals_forgotten", "index_count_of_triangles",
        "fronts_left_out", "texcoords_without_map", "texcoords_never_filled",
        "map_not_marked_srgb", "point_as_a_sun", "angle_for_its_cosine", "cone_of_a_hair",
        "exponent_of_thousands", "ambient_of_one", "lamp_without_specular",
        "terms_of_highlights", "a_pool_of_light_by_vertices", "material_forgotten",
        "material_of_highlights", "emission_of_the_diffuse_colour", "eye_and_center_exchanged",
        "up_along_the_view", "view_twice", "fovy_made_radians_twice",
        "model_turned_by_degrees", "moved_before_scaled", "normals_in_reverse_order",
        "positions_as_normals", "positions_interleaved_without_stride"
    };
    stage *s = stage_open();
    int all = 0, n = 0;
    for (const mistake *m = mistake_first; m; m = m->next) {
        int known = 0;
        if (!(m->scenes & ON_TEAPOT)) continue;
        stage_of_teapot(s);
        m->make(s);
        all++;
        for (int i = 0; i < TEST_COUNT(silent); i++) known |= !strcmp(silent[i], m->name);
        const int quiet = !*stage_explain(s, 1);
        CHECK_SAY(quiet == known, "%s", m->name);
        n += quiet;
    }
    printf("explain: of %d mistakes of a newcomer %d are silent\n", all, n);
    CHECK(all >= 130 && n * 130 <= 30 * all);
    free(s);
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
    s->target.depth = NULL;
    stage_is_good(s, "a convex mesh without depth");
    s->mesh.index_count = 3;
    s->state.raster.cull = SHADE_CULL_NONE;
    stage_is_good(s, "a triangle without depth");
    free(s);
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
    if (rnd_one_in(2)) stage_map(s);
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
    for (int k = 0; k < test_rounds(30); k++) {
        stage *s = stage_open();
        shade_target good;
        const int y = rnd_int(0, STAGE_HEIGHT - 1), high = rnd_int(1, STAGE_HEIGHT - y);
        const int x = rnd_int(0, STAGE_WIDTH - 1);
        s->target.srgb = rnd_one_in(2);
        good = s->target;
        stage_random_camera(s);
        stage_random_mesh(s);
        stage_is_good(s, "whole");
        s->target = good;
        s->target.clip_y = y;
        s->target.clip_height = high;
        s->target.clip_width = STAGE_WIDTH;
        stage_is_good(s, "a band of rows");
        s->target.clip_x = x;
        s->target.clip_y = 0;
        s->target.clip_height = STAGE_HEIGHT;
        s->target.clip_width = rnd_one_in(2) ? STAGE_WIDTH - x : rnd_int(1, STAGE_WIDTH - x);
        stage_is_good(s, "a band of columns");
        s->target = good;
        s->target.row_offset = y;
        s->target.row_count = high;
        stage_is_good(s, "a strip");
        free(s);
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
    free(s);
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
    free(s);
}
/* Faces that are lit by normals of their own show nothing of mesh.normals. */
TEST(explain, of_faces_no_normals_are_blamed)
{
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
        CHECK_SAY(ambient ? !*said : strstr(said, "Every lamp is behind") != NULL, "%s", said);
        free(s);
    }
}
/* A pool of light beside the middle of its face, and normals that would not show it per fragment:
   no one change would be a cure, and no field is blamed alone. */
TEST(explain, of_a_pool_beside_the_middle_of_a_face_no_field_is_blamed_alone)
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
    CHECK(strstr(stage_explain(s, 1), "several of them may be at fault"));
    s->mesh.normals = NULL;
    CHECK(strstr(stage_explain(s, 1), "state.shading lights only vertices"));
    free(s);
}
/* The stats are believed: the small picture of shade_explain may miss what the large one shows. */
TEST(explain, a_draw_that_had_pixels_is_not_said_to_have_none)
{
    stage *s = stage_open();
    shade_stats stats = { .triangles = STAGE_INDICES / 3 };
    s->state.model = shade_mat4_translation(shade_v3(50, 0, 0));
    CHECK(*shade_explain(&s->target, &s->mesh, &s->state, &stats));
    stats.fragments = 1;
    CHECK(!*shade_explain(&s->target, &s->mesh, &s->state, &stats));
    free(s);
}
/* A floor of two triangles, with a pool of light that is small beside it; at times smaller than any
   pixel, beside a lamp that shines up: that floor is black. */
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
        s->lamps[0].quadratic = 50;
        if (k % 2)
            s->lamps[0] = shade_spot_light(above, shade_v3(0, -1, 0.1f), k % 4 == 1 ? 0.002f : 0.8f,
                                           1, shade_v3(1, 1, 1));
        if (k % 4 == 1) {
            s->state.lighting.light_count = 2;
            s->lamps[1] = shade_spot_light(above, shade_v3(0, 1, 0), 0.2f, 1, shade_v3(1, 1, 1));
        }
        s->state.view = shade_mat4_look_at(shade_v3(0, 3, 5), shade_v3(0, 0, 0), shade_v3(0, 1, 0));
        if (k % 4 != 1) stage_is_good(s, "a pool");
        else CHECK(strstr(stage_explain(s, 1), "No cone of a spotlight"));
        free(s);
    }
}
/* What is brighter than 8 of 255 is light: that is 0.0312 in a linear byte and 0.0024 as sRGB, at
   the middle between two codes 0.0333 and 0.0026.  Floats may be dimmer, since they may be exposed.
   */
TEST(explain, light_begins_above_8_of_255)
{
    static const struct { shade_format format; int srgb; float light; int shown; } row[] = {
        { SHADE_FORMAT_RGBA32F, 0, 1e-30f, 1 },  { SHADE_FORMAT_RGBA32F, 0, 0, 0 },
        { SHADE_FORMAT_RGBA8, 1, 0.00265f, 1 },  { SHADE_FORMAT_RGBA8, 1, 0.0025f, 0 },
        { SHADE_FORMAT_BGRA8, 0, 0.034f, 1 },    { SHADE_FORMAT_BGRA8, 0, 0.0325f, 0 },
        { SHADE_FORMAT_RGB565, 0, 0.034f, 1 },   { SHADE_FORMAT_RGB565, 0, 0.0325f, 0 }
    };
    for (int k = 0; k < TEST_COUNT(row); k++) {
        stage *s = stage_open();
        const float light = row[k].light;
        s->target.format = row[k].format;
        s->target.srgb = row[k].srgb;
        memset(&s->material, 0, sizeof s->material);
        s->material.emission = shade_v3(light, light, light);
        if (row[k].shown) stage_is_good(s, "dim light");
        else CHECK(strstr(stage_explain(s, 1), "state.material reflects nothing"));
        free(s);
    }
}

/* Neither buffers nor arguments change; the sentence is the same when asked again. */
TEST(explain, it_writes_nothing)
{
    stage *s = stage_open(), *copy = stage_open();
    int k = 0;
    for (const mistake *m = mistake_first; m; m = m->next) {
        if (k++ % 7) continue;
        if (m->scenes & ON_TEAPOT) stage_of_teapot(s);
        else stage_of_ball(s);
        m->make(s);
        const char *said = stage_explain(s, 1);
        memcpy(copy, s, sizeof *s);
        if (!s->no_target && !s->no_mesh && !s->no_state) {
            shade_stats stats = { 0 };
            shade_explain(&s->target, &s->mesh, &s->state, &stats);
            shade_explain(&s->target, &s->mesh, &s->state, NULL);
        }
        CHECK(said && !memcmp(copy, s, sizeof *s));
    }
    free(s);
    free(copy);
}

/* Scenes that look like a mistake in one respect and are none. */
typedef struct unusual {
    const char *name;
    void (*make)(stage *);
    struct unusual *next;
} unusual;
LISTED(unusual);
#define UNUSUAL(name)                                                                              \
    static void unusual_##name(stage *s);                                                          \
    LIST(unusual, name, #name, unusual_##name)                                                     \
    static void unusual_##name(stage *s)
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
UNUSUAL(interleaved_vertices) { stage_interleave(s); }
UNUSUAL(a_map_with_its_levels) { stage_levels(s); }
UNUSUAL(indices_of_16_bits)
{
    for (int i = 0; i < s->mesh.index_count; i++) s->half[i] = (uint16_t)s->index[i];
    s->mesh.indices16 = s->half;
    s->mesh.indices = NULL;
}
/* Steps of floats are a sixteenth of its width, and it has a few pixels. */
UNUSUAL(small_far_from_the_origin)
{
    for (int i = 0; i < STAGE_VERTICES; i++) s->position[i].x += 2097152;
    s->state.model = STAGE_SCALE(0.125f);
    s->state.model.col[3] = shade_v4(-262144, 0, 0, 1);
    s->lamps[0] = shade_point_light(s->eye, WHITE);
    s->lamps[1] = s->lamps[0];
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
    s->lamps[0].position = shade_v4(0, 0, -6, 1);    /* on the side that LESS shows */
    s->state.lighting.light_count = 1;
}
UNUSUAL(box_always_looked_into) { stage_chunk(s, shade_v3(1, 1, 1), shade_v3(-1, -1, -1)); }
/* w = 1 - z/3: the eye stands at (0, 0, 3), and matrices of the projection are identity else */
UNUSUAL(one_point_projection)
{
    memset(&s->state.view, 0, sizeof s->state.view);
    s->state.projection = shade_mat4_identity();
    s->state.projection.col[0].x = 1 / 1.5f;
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
    stage_reverse(s, 0.1f);
    s->state.projection = shade_mat4_mul(s->state.projection, turn);
    s->state.projection.col[0].x = s->state.projection.col[0].y = s->state.projection.col[0].z = 0;
}
/* A floor at so flat an angle that it covers a row or two. */
UNUSUAL(floor_at_a_flat_angle)
{
    static const shade_vec3 ground[4] = { { -9, 0, 9 }, { 9, 0, 9 }, { 9, 0, -9 }, { -9, 0, -9 } };
    stage_quad(s);
    memcpy(s->position, ground, sizeof ground);
    s->mesh.normals = NULL;
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
    stage_map(s);
    s->map.width = s->map.height = 1;
    s->map.stride = 2;
    s->map.filter = SHADE_FILTER_TRILINEAR;    /* one texel has no mipmaps */
}
UNUSUAL(turned_by_a_quarter)
{
    const shade_mat4 turn = shade_mat4_rotation(1.57079633f, shade_v3(0, 0, 1));
    s->state.projection = shade_mat4_perspective(0.8f, 1 / 1.5f, 0.1f, 100);
    s->state.projection = shade_mat4_mul(turn, s->state.projection);
}
UNUSUAL(light_of_255_in_floats)
{
    s->target.format = SHADE_FORMAT_RGBA32F;
    mistake_light_of_255(s);
}
UNUSUAL(lamp_in_its_glowing_globe)
{
    s->material.emission = shade_v3(0.9f, 0.9f, 0.7f);
    s->lamps[0].position = shade_v4(0, 0, 0, 1);
    s->state.lighting.light_count = 1;
}
UNUSUAL(depth_read_only)    /* a convex mesh, of which no pixel has two faces */
{
    s->state.raster.depth_read_only = 1;
    s->state.raster.cull = SHADE_CULL_BACK;
}
UNUSUAL(depth_alone) { s->target.color = NULL; }
UNUSUAL(added_without_depth)
{
    s->target.depth = NULL;
    s->state.raster.blend = SHADE_BLEND_ADD;
}
UNUSUAL(quad_from_behind_without_depth)
{
    stage_quad(s);
    stage_turn(s, 0);
    s->state.lighting.flags = SHADE_FLAG_TWO_SIDED;
    s->mesh.normals = NULL;
    s->target.depth = NULL;
}
UNUSUAL(room)
{
    mistake_inside_out(s);
    for (int i = 0; i < STAGE_VERTICES; i++) s->normal[i] = shade_neg(s->normal[i]);
    s->state.view = shade_mat4_look_at(shade_v3(0, 0, 0.2f), shade_v3(0, 0, -1), shade_v3(0, 1, 0));
    s->lamps[0].position = shade_v4(0, 0, 0.1f, 1);
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
    s->target.clip_width = 4;
    s->target.clip_height = STAGE_HEIGHT;
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
UNUSUAL(reversed_with_near_one) { stage_reverse(s, 1); }
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
    shade_clear(&s->target, shade_v4(0, 0, 0, 1), 0);
    CHECK_INT(shade_draw_mesh(&s->target, &s->mesh, &s->state, &stats), SHADE_OK);
    CHECK(stats.drawn > 0 && stats.fragments == 0);
    CHECK(strstr(shade_explain(&s->target, &s->mesh, &s->state, &stats), "depth") != NULL);
    shade_clear(&s->target, shade_v4(0, 0, 0, 1), 1);
    CHECK(!*shade_explain(&s->target, &s->mesh, &s->state, &stats));
    free(s);
}

/* The lower half of the ball alone would be inside out. */
TEST(explain, a_band_is_not_blamed_for_its_half_of_a_mesh)
{
    stage *s = stage_open();
    stage_turn(s, STAGE_INDICES / 2);
    s->mesh.normals = NULL;
    s->state.raster.cull = SHADE_CULL_BACK;
    s->state.view = shade_mat4_look_at(shade_v3(0, 0, 4), shade_v3(0, 0, 0), shade_v3(0, 1, 0));
    for (int band = 0; band < 2; band++) {
        s->target.clip_y = band * STAGE_HEIGHT / 2;
        s->target.clip_width = band * STAGE_WIDTH;
        s->target.clip_height = band * STAGE_HEIGHT / 2;
        CHECK(strstr(stage_explain(s, 1), "wound both ways") != NULL);    /* not inside out */
    }
    free(s);
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
    free(s);
}

/* A band may be hidden whole while the picture is not.  Without stats the mesh may be what is
   stored, as after a draw, or what is stored is not its depth, and hides it. */
TEST(explain, depth_is_blamed_after_whole_draws_alone)
{
    stage *s = stage_open();
    s->clear = 0.25f;
    CHECK(strstr(stage_explain(s, 1), "hidden by depth") != NULL);
    CHECK(strstr(stage_explain(s, 0), "hidden by depth") != NULL);
    s->draws = 2;
    s->clear = 1;
    CHECK(!*stage_explain(s, 0));
    s->draws = 1;
    s->clear = 0.25f;
    s->target.clip_width = STAGE_WIDTH;
    s->target.clip_height = STAGE_HEIGHT - 1;
    stage_is_good(s, "a band that is hidden");
    s->target.clip_x = 1;
    s->target.clip_width = STAGE_WIDTH - 1;
    s->target.clip_height = STAGE_HEIGHT;
    stage_is_good(s, "a band of columns that is hidden");
    s->target.clip_x = 0;
    s->target.clip_y = 4;
    s->target.clip_width = STAGE_WIDTH;
    s->target.clip_height = STAGE_HEIGHT - 8;
    stage_is_good(s, "a band in the middle that is hidden");
    free(s);
}

TEST(explain, what_is_unusual_is_no_mistake)
{
    for (const unusual *u = unusual_first; u; u = u->next) {
        stage *s = stage_open();
        u->make(s);
        stage_is_good(s, u->name);
        free(s);
    }
}

/* A pass for depth alone, then one for colours that writes no depth, over pixels of two faces. */
TEST(explain, a_pass_over_stored_depth_hides_nothing)
{
    static const shade_compare compares[2] = { SHADE_COMPARE_EQUAL, SHADE_COMPARE_LESS_EQUAL };
    for (int k = 0; k < 4; k++) {
        stage *s = stage_open();
        shade_target depth = s->target;
        depth.color = NULL;
        if (k & 2) stage_of_teapot(s);
        s->state.raster.cull = SHADE_CULL_NONE;
        shade_clear(&s->target, shade_v4(0, 0, 0, 1), 1);
        shade_draw_mesh(&depth, &s->mesh, &s->state, NULL);
        s->clear = NAN;
        s->state.raster.depth_test = compares[k & 1];
        s->state.raster.depth_read_only = 1;
        stage_is_good(s, "colours behind depth");
        free(s);
    }
}

/* The states of tests/fuzz/explain.c go on where these end. */
TEST(explain, no_sentence_about_a_random_draw_is_false)
{
    static explained e;
    for (int k = 0; k < test_rounds(1200); k++) {
        const char *said;
        if (k % 2) ex_ordinary(&e);
        else ex_random(&e);
        const int row = ex_explain(&e, rnd_one_in(2), &said);
        CHECK_SAY(row < EX_FALSE, "draw %d (%s, %s): \"%s\"", k, e.made[0], e.made[1], said);
    }
}

/* Scenes as a newcomer writes them, without a mistake. */
TEST(explain, nothing_is_said_of_sensible_scenes)
{
    static explained e;
    for (int k = 0; k < test_rounds(400); k++) {
        const char *said;
        ex_sensible(&e);
        ex_explain(&e, k % 2, &said);
        CHECK_SAY(!*said, "scene %d: \"%s\"", k, said);
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
        if (rnd_one_in(2)) stage_map(s);
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
        if (rnd_one_in(4)) s->target.depth = NULL;
        if (rnd_one_in(4)) {
            s->target.clip_x = rnd_int(-9, 99);
            s->target.clip_width = 20;
        }
        if (rnd_one_in(4)) {
            s->target.clip_y = rnd_int(-9, 99);
            s->target.clip_height = 20;
        }
        if (rnd_one_in(4)) {
            s->target.row_offset = 7;
            s->target.row_count = rnd_int(-1, 60);
        }
        const shade_result result = shade_draw_mesh(&s->target, &s->mesh, &s->state, &stats);
        const char *with = shade_explain(&s->target, &s->mesh, &s->state, &stats);
        const char *without = shade_explain(&s->target, &s->mesh, &s->state, NULL);
        CHECK_SAY(with && without && (!result || *without), "%s", shade_result_string(result));
        free(s);
    }
}

/* ------------------------------------------------------------------- where each sentence begins */

/* Where sentences of shade_explain begin: each is said on one side of its limit, and not on the
   other, a step away. The ball of mistakes.h is the scene. */

/* The words are said where miss is 0, and not where it is 1 .. misses: a sentence of several
   conditions has a miss for each. */
typedef struct limit {
    const char *name, *words;
    void (*make)(stage *s, int miss);
    int misses;
    struct limit *next;
} limit;
LISTED(limit);
#define NEAR(name, misses, words)                                                                  \
    static void near_##name(stage *s, int miss);                                                   \
    LIST(limit, name, #name, words, near_##name, misses)                                           \
    static void near_##name(stage *s, int miss)

NEAR(color_stride, 2, "elements overlap")
{
    s->mesh.colors = miss < 2 ? &s->color[0].x : NULL;
    s->mesh.color_stride = miss == 1 ? 12 : 8;
}
NEAR(texcoord_stride, 2, "elements overlap")
{
    s->mesh.texcoords = miss < 2 ? &s->texcoord[0].x : NULL;
    s->mesh.texcoord_stride = miss == 1 ? 8 : 4;
}
NEAR(positions, 1, "mesh.positions hold NaN") { s->position[40].x = miss ? 9e11f : 1.1e12f; }
NEAR(lamp_nan, 1, "holds a NaN") { s->lamps[1].diffuse.y = miss ? 0.5f : NAN; }
NEAR(attenuation, 1, "quadratic is negative") { s->lamps[0].linear = miss ? 1e-6f : -1e-6f; }
NEAR(last_row, 1, "The last row")
{
    s->state.model = shade_mat4_identity();
    s->state.model.col[3].w = miss ? 1.0f : 1.5f;
}
NEAR(cutoff, 1, "radians; use shade_radians")
{
    s->lamps[1] = shade_spot_light(s->eye, shade_neg(s->eye), miss ? 3.1415927f : 45, 0, WHITE);
}
NEAR(stats, 1, "stats are not") { s->other_stats = !miss; }
/* w = 1 - z/3: the matrix of a one-point perspective, and translation(1/3, 0, -1/3) by rows */
NEAR(by_rows, 1, "transposed")
{
    memset(&s->state.view, 0, sizeof s->state.view);
    s->state.projection = shade_mat4_identity();
    s->state.projection.col[2] = shade_v4(0, 0, -0.2f, -1 / 3.0f);
    s->state.model = shade_mat4_translation(shade_v3(0, 0, miss ? 4.0f : 1.7f));
    if (!miss) {
        s->state.projection =
            shade_mat4_transpose(shade_mat4_translation(shade_v3(0.3f, 0, -1.8f)));
        s->state.model = shade_mat4_translation(shade_v3(0, 0, 1.5f));
    }
}
NEAR(equal, 1, "is SHADE_COMPARE_EQUAL")
{
    s->state.raster.depth_test = SHADE_COMPARE_EQUAL;
    if (miss) {
        shade_draw_state first = s->state;
        first.raster.depth_test = SHADE_COMPARE_LESS;
        shade_clear(&s->target, shade_v4(0, 0, 0, 1), 1);
        shade_draw_mesh(&s->target, &s->mesh, &first, NULL);
        s->clear = NAN;
    }
}
NEAR(far_plane, 1, "Every pixel has the depth of the far plane")
{
    s->z_near = miss ? 1e-5f : 1e-8f;
    stage_look(s);
}
NEAR(view_by_rows, 1, "state.view looks transposed")
{
    if (miss) s->state.view = s->state.projection;
    s->state.view = shade_mat4_transpose(s->state.view);
    if (miss) s->state.projection = shade_mat4_identity();
}
NEAR(beyond_far, 1, "beyond the far plane")
{
    s->state.model = shade_mat4_translation(shade_v3(0, 0, -200));
    s->state.projection = shade_mat4_ortho(-60, 60, -60, 60, -100, 100);
    if (miss) {    /* a view that moves all corners to the eye */
        memset(&s->state.view, 0, sizeof s->state.view);
        s->state.view.col[3].w = 1;
        stage_reverse(s, s->z_near);
    }
}
/* A triangle twice in the same place, which covers most of the picture. */
static void near_triangles(stage *s)
{
    s->mesh.indices = NULL;
    s->mesh.vertex_count = 6;
    for (int i = 0; i < 6; i++) {
        const float x = i % 3 == 1 ? 3.0f : -1, y = i % 3 == 2 ? 3.0f : -1;
        s->position[i] = shade_v3(x, y, 0);
        s->normal[i] = shade_v3(0, 0, 1);
    }
    stage_place(s, shade_v3(0, 0, 3), s->center);
    stage_lamp(s, shade_directional_light(shade_v3(0, 0, -1), WHITE));
}
/* A lamp that grazes one vertex, and is behind the two others: light of vertices fills the triangle
   from there. */
NEAR(behind_of_pixels, 1, "Every lamp is behind")
{
    near_triangles(s);
    s->mesh.vertex_count = 3;
    s->normal[0] = shade_v3(0.995f, 0, -0.1f);
    stage_lamp(s, shade_directional_light(shade_v3(0, 0, 1), shade_v3(10, 10, 10)));
    s->material.specular = BLACK;
    if (miss) {
        s->material.diffuse = BLACK;
        s->state.shading = SHADE_SHADING_PER_VERTEX;
    }
}
/* The triangle that another one hides does not count. */
NEAR(material_of_twins, 1, "state.material reflects")
{
    near_triangles(s);
    for (int i = 0; i < 6; i++) s->color[i] = miss && i < 3 ? BLACK : WHITE;
    s->mesh.colors = &s->color[0].x;
    s->lamps[0].specular = s->material.diffuse = BLACK;
}
/* A lamp above the eye leaves the ball's lower part in the dark; how much, decides its height. */
NEAR(behind, 1, "Every lamp is behind")
{
    stage_lamp(s, shade_directional_light(shade_v3(0, miss ? -1.5f : -0.3f, 1), WHITE));
    stage_place(s, shade_v3(0, 0, 4), s->center);
}
/* A small triangle with a highlight, and a large one with none.  Diffuse light is not asked for,
   but decides whether the large one faces the lamp. */
NEAR(behind_of_highlights, 1, "Every lamp is behind")
{
    near_triangles(s);
    for (int i = 0; i < 6; i++) {
        s->position[i].x = s->position[i].x * (i < 3 ? 0.1f : 0.5f) + (i < 3 ? -1.5f : 0.5f);
        if (i < 3) s->position[i].y *= 0.1f;
        else s->normal[i] = shade_v3(0, 1, miss ? 0.1f : -0.1f);
    }
    s->state.lighting.terms = SHADE_TERM_SPECULAR;
    s->material.shininess = 60;
}
/* Both triangles face away, but the small one shines at a flat angle where highlights are open. */
NEAR(behind_of_open_highlights, 1, "Every lamp is behind")
{
    near_behind_of_highlights(s, 0);
    for (int i = 0; i < 6; i++)
        s->normal[i] = i < 3 ? shade_v3(1, 0, -0.02f) : shade_v3(0, 1, -1);
    s->material.shininess = 0.5f;
    s->state.lighting.flags = miss ? 0 : SHADE_FLAG_UNGATED_SPECULAR;
}
/* Wide ones show on more than a tenth. */
NEAR(behind_of_wide_highlights, 1, "Every lamp is behind")
{
    near_behind(s, 0);
    s->state.lighting.flags = miss ? SHADE_FLAG_UNGATED_SPECULAR : 0;
}
/* Emission of one channel is light, too. */
NEAR(behind_of_emission, 3, "Every lamp is behind")
{
    near_behind(s, 0);
    if (miss == 1) s->material.emission.x = 0.5f;
    if (miss == 2) s->material.emission.y = 0.5f;
    if (miss == 3) s->material.emission.z = 0.5f;
}
/* A narrow cone on the ball: its light is before faces in view, though it meets few of them. */
NEAR(behind_of_a_cone, 1, "Every lamp is behind")
{
    stage_place(s, shade_v3(0, 0, 4), s->center);
    stage_lamp(s, stage_spot(s, miss ? 0.02f : 0.2f, 0));
    if (!miss) {
        s->lamps[0].position.z = -6;
        s->lamps[0].spot_direction.z = 1;
    }
}
/* A spot of light that is white may be meant, and a part of the picture does not tell. */
NEAR(clipped, 2, "is clipped to white")
{
    shade_light lamp = stage_spot(s, miss == 1 ? 0.02f : 0.25f, 0);
    if (miss == 2) {
        s->target.clip_x = 10;
        s->target.clip_width = STAGE_WIDTH - 20;
        s->target.clip_height = STAGE_HEIGHT;
    }
    lamp.diffuse = lamp.specular = shade_v3(9, 9, 9);
    stage_lamp(s, lamp);
}
NEAR(attenuated, 1, "Attenuation")
{
    s->material.specular = BLACK;
    s->state.lighting.light_count = 1;
    s->lamps[0].quadratic = miss ? 0.2f : 0.4f;    /* 12 and 7 of 255 are left */
}
NEAR(cone, 1, "No cone")
{
    stage_lamp(s, shade_spot_light(s->eye, shade_v3(0, miss ? -1.0f : 1.0f, -4), 0.2f, 0, WHITE));
}
/* The second lamp, which is dark, meets the mesh. */
NEAR(cone_of_two, 1, "No cone")
{
    const shade_vec3 dark = shade_v3(1e-3f, 1e-3f, 1e-3f);
    near_cone(s, 0);
    s->lamps[1] =
        shade_spot_light(s->eye, shade_v3(0, miss ? 0.0f : 1.0f, -4), 0.2f, 0, dark);
    s->state.lighting.light_count = 2;
}
NEAR(no_colour, 1, "no colour")
{
    const float light = miss ? 0.08f : 0.02f;
    s->material.specular = BLACK;
    stage_lamp(s, shade_point_light(s->eye, shade_v3(light, light, light)));
}
NEAR(no_light, 1, "There is no light")
{
    const float light = miss ? 0.06f : 0.03f;
    s->state.lighting.lights = NULL;
    s->state.lighting.light_count = 0;
    s->mesh.normals = NULL;
    s->state.lighting.ambient = shade_v3(light, light, light);
}
NEAR(material, 1, "state.material reflects")
{
    const float albedo = miss ? 0.04f : 0.02f;
    s->material.diffuse = shade_v3(albedo, albedo, albedo);
    s->material.specular = BLACK;
}
NEAR(alpha, 1, "Alpha is 0")
{
    s->state.raster.blend = SHADE_BLEND_OVER;
    s->state.transparency = miss ? 0.9f : 0.99f;
}
/* Terms that show nothing, and would not show more if none were left out: there is no lamp. */
NEAR(terms, 1, "leaves out every term")
{
    s->state.lighting.terms = SHADE_TERM_EMISSION;
    if (miss) s->state.lighting.light_count = 0;
}
/* hidden by highlights, which white colours would not be */
NEAR(colors, 1, "mesh.colors, or the texels")
{
    for (int i = 0; i < STAGE_VERTICES; i++) s->color[i] = miss ? shade_v3(1e-3f, 0, 0) : BLACK;
    s->mesh.colors = &s->color[0].x;
}
NEAR(shader, 1, "gives black") { s->state.fragment = miss ? shader_white : shader_black; }
/* Of glass, a shader is said to leave black only where it may have been meant to show. */
NEAR(shader_of_no_alpha, 1, "gives black")    /* which is stored */
{
    near_shader(s, miss);
    s->state.transparency = 1;
}
NEAR(shader_of_nothing, 1, "Alpha is 0")
{
    near_shader(s, 0);
    s->state.raster.blend = SHADE_BLEND_OVER;
    s->state.transparency = miss ? 0.5f : 1.0f;
}
NEAR(discards, 1, "discards all")
{
    s->state.fragment = miss ? shader_white : shader_that_discards;
}
NEAR(inside_out, 2, "inside out")
{
    s->mesh.normals = NULL;
    if (!miss) stage_turn(s, 0);
    s->lamps[0].position = shade_v4(0, 1, 9, 1);
    s->lamps[1] = shade_directional_light(shade_v3(0, 1, 0.4f), WHITE);
    if (miss == 2) {    /* a model that holds the camera may mean anything */
        stage_turn(s, 0);
        s->state.model = shade_mat4_mul(s->state.projection, s->state.view);
        memset(&s->state.view, 0, sizeof s->state.view);
        memset(&s->state.projection, 0, sizeof s->state.projection);
    }
}
/* Parallel sight; where the farthest fragment is asked for, backs are what one sees. */
NEAR(inside_out_of_boxes, 1, "inside out")
{
    near_inside_out(s, 0);
    s->state.projection = shade_mat4_ortho(-2, 2, -2, 2, 0.1f, 30);
    if (miss) {
        s->state.raster.depth_test = SHADE_COMPARE_GREATER;
        s->clear = 0;
    }
}
/* A square, and before it the back of another, which leaves a twentieth or more of it in view */
NEAR(inside_out_of_nine_tenths, 1, "inside out")
{
    static const float x[6] = { 0, 1, 1, 0, 1, 0 }, y[6] = { 0, 0, 1, 0, 1, 1 };
    near_triangles(s);
    s->mesh.vertex_count = 12;
    for (int i = 0; i < 12; i++) {
        const int back = i > 5, k = back ? 11 - i : i;
        const float share = !back ? 1.8f : miss ? 1.8f * 0.85f : 1.8f * 0.95f;
        s->position[i] = shade_v3(x[k] * share - 0.9f, y[k] * 1.8f - 0.9f, back ? 0.5f : 0.0f);
        s->normal[i] = shade_v3(0, 0, 1);
    }
    s->state.projection = shade_mat4_ortho(-1, 1, -1, 1, 0.1f, 9);
    s->state.raster.cull = SHADE_CULL_BACK;
}
/* With a triangle behind the eye, which is within the box then, it may be a room. */
NEAR(inside_out_around_the_eye, 1, "inside out")
{
    near_inside_out_of_nine_tenths(s, 0);
    stage_look(s);
    for (int i = 12; i < 15; i++) s->position[i] = shade_v3((float)(i % 2), (float)(i - 13), 6);
    if (miss) s->mesh.vertex_count = 15;
}
NEAR(later, 1, "Triangles drawn later")
{
    s->state.raster.depth_read_only = 1;
    s->state.raster.cull = miss ? SHADE_CULL_BACK : SHADE_CULL_NONE;
}
/* A ball of some 60 pixels */
NEAR(later_of_few, 1, "Triangles drawn later")
{
    near_later(s, miss);
    stage_place(s, shade_v3(0, 0, 18), s->center);
}
NEAR(always, 1, "Triangles drawn later")
{
    s->state.raster.depth_test = SHADE_COMPARE_ALWAYS;
    s->state.raster.cull = miss ? SHADE_CULL_BACK : SHADE_CULL_NONE;
}
NEAR(test_is_turned, 2, "does not fit")
{
    s->state.raster.depth_test = SHADE_COMPARE_GREATER;
    s->clear = 0;
    s->state.raster.cull = miss ? SHADE_CULL_BACK : SHADE_CULL_NONE;    /* one face a pixel */
    if (miss == 2) s->state.projection = shade_mat4_ortho(-2, 2, -2, 2, 1, 9);
}
/* The nearer of two triangles comes last. */
NEAR(test_is_turned_of_layers, 1, "does not fit")
{
    near_triangles(s);
    for (int i = 3; i < 6; i++) s->position[i].z = miss ? 0.0f : 1.0f;
    s->state.raster.depth_test = SHADE_COMPARE_GREATER;
    s->clear = 0;
}
/* The matrix of perspective_reversed, and one whose planes of equal depth lean */
NEAR(reversed, 1, "perspective_reversed")
{
    s->state.projection = shade_mat4_perspective_reversed(s->fovy, s->aspect, s->z_near);
    if (miss) s->state.projection.col[0].z = 0.2f;
}
/* A model so large that its clip coordinates are no numbers */
NEAR(overflow, 1, "mesh.positions hold NaN")
{
    const shade_mat4 larger = shade_mat4_scaling(shade_v3(9, 9, 9));
    const float size = miss ? 1.0f : 1e38f;
    s->state.model = shade_mat4_scaling(shade_v3(size, size, size));
    s->state.projection = shade_mat4_mul(s->state.projection, larger);
}
NEAR(turned, 1, "point away from the eye")
{
    for (int i = 0; i < STAGE_VERTICES; i++)
        if (s->position[i].x < (miss ? -0.3f : 0.3f)) s->normal[i] = shade_neg(s->normal[i]);
    s->state.raster.cull = SHADE_CULL_BACK;
}
/* Nineteen of twenty faces whose normals lie on this side of them are turned. */
static void near_turned_by_normals(stage *s, float side)
{
    for (int t = 0; t < STAGE_INDICES; t += 3) {
        uint32_t *i = s->index + t;
        shade_vec3 outward = BLACK, n = BLACK;
        for (int k = 0; k < 3; k++) {
            outward = shade_add(outward, s->position[i[k]]);
            n = shade_add(n, s->normal[i[k]]);
        }
        if (side * shade_dot(n, outward) > 0 && t / 3 % 20) {
            const uint32_t first = i[0];
            i[0] = i[1];
            i[1] = first;
        }
    }
}
NEAR(normals_as_colours, 3, "no negative component")    /* all of them, or all but one */
{
    for (int i = 0; i < STAGE_VERTICES; i++) {
        s->normal[i] = shade_scale(shade_add(s->normal[i], WHITE), 0.5f);
    }
    if (miss == 1) s->normal[60].z = -0.1f;
    if (miss == 2) near_turned_by_normals(s, -1);
    if (miss == 3) near_turned_by_normals(s, 1);
}
NEAR(stored_alpha, 1, "stored as alpha")
{
    s->state.transparency = 0.5f;
    s->state.raster.blend = miss ? SHADE_BLEND_OVER : SHADE_BLEND_REPLACE;
}
/* What is white at half of its light as well */
NEAR(stored_alpha_of_white, 1, "stored as alpha")
{
    near_triangles(s);
    near_stored_alpha(s, 0);
    s->target.format = SHADE_FORMAT_RGBA32F;
    s->mesh.vertex_count = 3;
    s->material.specular = BLACK;
    if (miss) stage_lamp(s, shade_directional_light(shade_v3(0, 0, -1), shade_v3(9, 9, 9)));
}
NEAR(shininess, 1, "shininess is below 1") { s->material.shininess = miss ? 1.0f : 0.9f; }
NEAR(emission, 5, "emission alone")
{
    s->material.emission = shade_v3(1, 1, miss == 1 ? 0.99f : 1.0f);
    if (miss == 2) s->target.format = SHADE_FORMAT_RGBA32F;
    if (miss == 3) s->state.lighting.model = SHADE_MODEL_EMISSIVE;
    if (miss == 4) s->material.diffuse = BLACK;
    if (miss == 5) s->material.emission.y = 0.99f;
}
NEAR(bias, 1, "depth of all pixels") { s->state.raster.depth_bias = miss ? -0.9f : -1.0f; }
/* A mesh that a view without its last 1 puts at one depth, beyond far or not */
NEAR(beside_of_one_depth, 1, "beside the picture, before near")
{
    s->state.view.col[3].w = 0;
    s->state.projection = shade_mat4_mul(s->state.projection, s->state.view);
    memset(&s->state.view, 0, sizeof s->state.view);
    if (miss) s->state.projection = shade_mat4_perspective(s->fovy, s->aspect, 50, 90);
}
NEAR(clip, 1, "lies beyond the picture")
{
    s->target.clip_x = 40;
    s->target.clip_width = miss ? STAGE_WIDTH - 40 : STAGE_WIDTH - 39;
    s->target.clip_height = STAGE_HEIGHT - 1;
}
NEAR(box, 2, "does not contain its triangles")
{
    stage_chunk(s, shade_v3(-1, -1, -1), shade_v3(1, miss ? 1 : 0.999f, 1));
    if (miss == 2) {    /* a part without triangles has a box, and no need of one */
        s->mesh.chunks = s->chunks;
        s->mesh.chunk_count = 2;
        s->chunks[0] = s->chunks[1] = s->chunk;
        s->chunks[1].first = s->chunk.count;
        s->chunks[1].count = 0;
    }
}
NEAR(unset_view, 2, "state.view is unset")
{
    memset(&s->state.view, 0, sizeof s->state.view);
    s->state.model = shade_mat4_translation(shade_v3(0, 0, miss ? -3.0f : -0.5f));
    s->state.lighting.flags = SHADE_FLAG_TWO_SIDED;
    s->material.specular = BLACK;
    if (miss == 2) {    /* off centre, the projection may be meant to hold the camera */
        s->state.model.col[3].z = -0.5f;
        s->state.projection.col[3].y = 0.01f;
    }
}
/* A second eye is told where highlights need it. */
NEAR(second_eye, 2, "Highlights belong")
{
    const shade_mat4 there = shade_mat4_translation(shade_v3(0, 0, -4));
    s->state.view = shade_mat4_identity();
    s->state.projection = shade_mat4_mul(
        shade_mat4_perspective(s->fovy, s->aspect, s->z_near, s->z_far), there);
    s->state.lighting.terms = SHADE_TERM_AMBIENT | SHADE_TERM_DIFFUSE | SHADE_TERM_SPECULAR;
    if (miss == 1) {    /* the eye decides on sides, but there are no highlights */
        s->state.lighting.terms = SHADE_TERM_AMBIENT | SHADE_TERM_DIFFUSE;
        s->state.lighting.flags = SHADE_FLAG_TWO_SIDED;
    }
    if (miss == 2) {    /* highlights on hidden faces alone */
        for (int i = 0; i < STAGE_VERTICES; i++)
            if (s->position[i].z > -0.3f) s->normal[i] = BLACK;
        s->state.lighting.ambient = shade_v3(0.1f, 0.1f, 0.1f);
        s->material.specular = WHITE;
        s->material.shininess = 1;
        stage_lamp(s, shade_point_light(shade_v3(9, 0, -3), WHITE));
    }
}
/* Beside a map, which highlights do not multiply, they are lit apart. */
NEAR(second_eye_of_vertices, 1, "Highlights belong")
{
    near_second_eye(s, miss);
    stage_map(s);
    s->state.shading = SHADE_SHADING_PER_VERTEX;
}
NEAR(texels, 2, "reach the width")
{
    stage_map(s);
    s->map.width = 16;
    s->map.height = STAGE_TEXELS / 16;
    for (int i = 0; i < STAGE_VERTICES; i++)
        s->texcoord[i] =
            shade_scale2(s->texcoord[i], miss == 1 ? 14.0f : miss == 2 ? 16.5f : 15.5f);
}
NEAR(aspect, 4, "The aspect of")    /* 4 % and 2 % wide */
{
    s->aspect = miss == 1 ? 1.53f : 1.56f;
    stage_look(s);
    if (miss == 2) s->state.projection.col[1].x = 0.1f;    /* rows that lean have no aspect, ... */
    if (miss == 4) s->state.projection.col[1].x = -0.1f;
    if (miss == 3) {    /* depth alone, which has no more pixels */
        s->target.color = NULL;
        s->eye = shade_v3(0, 0, 1.1f);
        stage_look(s);
    }
}
/* 80 x 24 cells, twice as high as wide: the picture's aspect is 160 / 24 of the screen */
NEAR(aspect_of_cells, 1, "The aspect of")
{
    s->target.width = 80;
    s->target.height = 24;
    s->aspect = miss ? 80 / 48.0f : 80 / 30.0f;
    stage_look(s);
}

NEAR(aspect_of_pixels, 1, "The aspect of")    /* no terminal has so many rows */
{
    s->target.width = s->target.stride = 48;
    s->target.height = miss ? 127 : 128;
    s->aspect = 24.0f / (float)s->target.height;
    stage_look(s);
}

NEAR(crossed, 2, "run through each other")
{
    stage_interleave(s);
    if (!miss) s->mesh.normal_stride = 28;
    if (miss < 2) return;
    memcpy(s->vertex, s->position, sizeof s->position);    /* one array ends where another begins */
    for (int i = 0; i < STAGE_VERTICES; i++)
        memcpy(s->vertex + 3 * STAGE_VERTICES + 4 * i, s->normal + i, sizeof *s->normal);
    s->mesh.position_stride = 12;
    s->mesh.normals = s->vertex + 3 * STAGE_VERTICES;
    s->mesh.normal_stride = 16;
    s->mesh.texcoords = NULL;
}
NEAR(halves, 1, "Every other entry of mesh.indices16")
{
    mistake_indices_of_32_bits_as_16(s);
    if (miss) s->half[601] = s->half[600] = 1;
}
NEAR(levels, 2, "is not max(1, width >> k)")
{
    stage_levels(s);
    if (miss) s->map.filter = miss == 1 ? SHADE_FILTER_TRILINEAR : SHADE_FILTER_BILINEAR;
    if (miss != 1) s->level[3].width = 2;
}
/* The ball has some 4,600 fragments, 68 x 68, and is 2 wide: steps of 1 / 34 are a pixel. */
NEAR(coarse, 1, "mesh.positions lie so far from 0")
{
    const float far = miss ? 131072 : 1048576;
    for (int i = 0; i < STAGE_VERTICES; i++) s->position[i].x += far;
    s->state.model = shade_mat4_translation(shade_v3(-far, 0, 0));
}

/* Ambient, diffuse and specular, each channel. */
TEST(explain, a_negative_colour_of_a_lamp_is_told)
{
    stage *s = stage_open();
    for (int k = 0; k < 9; k++) {
        stage_of_ball(s);
        (&s->lamps[1].ambient.x)[k] = -1e-3f;
        CHECK(strstr(stage_explain(s, 1), "negative colour"));
    }
    free(s);
}
TEST(explain, each_sentence_has_its_limit)
{
    stage *s = stage_open();
    for (const limit *l = limit_first; l; l = l->next)
        for (int miss = 0; miss <= l->misses; miss++) {
            stage_of_ball(s);
            l->make(s, miss);
            const char *said = stage_explain(s, 1);
            CHECK_SAY((strstr(said, l->words) == NULL) == (miss > 0), "%s, miss %d: \"%s\"",
                      l->name, miss, said);
        }
    free(s);
}

/* Without stats, a mesh that a bias moved to depth 0 is not said to be at the far plane. */
TEST(explain, a_bias_that_shows_a_far_mesh_is_not_called_far)
{
    stage *s = stage_open();
    near_far_plane(s, 0);
    CHECK(strstr(stage_explain(s, 0), "far plane") != NULL);
    s->state.raster.depth_bias = -1;
    CHECK(strstr(stage_explain(s, 0), "depth of all pixels") != NULL);
    free(s);
}

/* A lamp beyond the sixteenth may be the one that lights. */
TEST(explain, of_more_than_sixteen_lamps_none_is_said_to_be_behind)
{
    shade_light behind[17];
    stage *s = stage_open();
    for (int i = 0; i < 17; i++)
        behind[i] = shade_directional_light(shade_v3(0, 0.25f, 1), WHITE);
    s->state.lighting.lights = behind;
    for (int count = 16; count < 18; count++) {
        s->state.lighting.light_count = count;
        CHECK((strstr(stage_explain(s, 1), "Every lamp is behind") == NULL) == (count == 17));
    }
    free(s);
}

/* The same picture by any split of the camera between view and projection. */
TEST(explain, aspect_and_depth_are_those_of_the_camera)
{
    stage *s = stage_open();
    const shade_mat4 turn = shade_mat4_rotation(0.4f, shade_v3(1, 2, 3));
    for (int k = 0; k < 2; k++) {
        stage_of_ball(s);
        s->aspect = 1.2f;
        stage_look(s);
        if (k) s->state.raster.depth_test = SHADE_COMPARE_GREATER;
        if (k) s->clear = 0;
        s->state.view = shade_mat4_mul(shade_mat4_inverse(turn), s->state.view);
        s->state.projection = shade_mat4_mul(s->state.projection, turn);
        CHECK(strstr(stage_explain(s, 1), k ? "does not fit" : "The aspect of"));
    }
    free(s);
}

/* A pixel is lit if one channel of it is: 2 is 0x40000000 as a float, a byte of 0x40 alone. */
static void shader_of_a_channel(const void *uniforms, const shade_fragments *SHADE_RESTRICT in,
                                shade_colors *SHADE_RESTRICT out)
{
    const float *color = (const float *)uniforms;
    (void)in;
    for (int k = 0; k < 4; k++) SHADE_EACH_LANE(i) { out->color[k][i] = color[k]; }
}
TEST(explain, a_shader_that_lights_one_channel_leaves_no_black)
{
    static const struct { shade_format format; float light; int lit; } row[] = {
        { SHADE_FORMAT_RGBA32F, 2, 1 },         { SHADE_FORMAT_RGBA32F, 0, 0 },
        { SHADE_FORMAT_RGBA8, 64 / 255.0f, 1 }, { SHADE_FORMAT_RGBA8, 9 / 255.0f, 1 },
        { SHADE_FORMAT_RGBA8, 8 / 255.0f, 0 },  { SHADE_FORMAT_RGB565, 4 / 63.0f, 1 },
        { SHADE_FORMAT_BGRA8, 64 / 255.0f, 1 }, { SHADE_FORMAT_RGB565_SWAPPED, 4 / 63.0f, 1 }
    };
    stage *s = stage_open();
    for (int k = 0; k < TEST_COUNT(row) * 3; k++) {
        float color[4] = { 0, 0, 0, 1 };
        const char *said;
        stage_of_ball(s);
        color[k % 3] = row[k / 3].light;
        s->target.format = row[k / 3].format;
        s->state.fragment = shader_of_a_channel;
        s->state.uniforms = color;
        said = stage_explain(s, 1);
        CHECK_SAY(row[k / 3].lit ? !*said : strstr(said, "gives black") != NULL,
                  "row %d: \"%s\"", k, said);
    }
    free(s);
}
