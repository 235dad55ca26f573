/* mistakes.h - scenes that are right, and mistakes in them.

   A stage is one draw: a target, a mesh, a state, and memory for all of them.  Each mistake is a
   function that changes a stage, with the scenes in which it is made and the words that
   shade_explain's sentence must hold.  tests/unit/explain.c holds it to the words; tests/fuzz makes
   the same mistakes in random scenes. */
#ifndef MISTAKES_H
#define MISTAKES_H

#include "examples/shared/teapot.h"
#include "test.h"

enum { STAGE_RINGS = 12, STAGE_SECTORS = 16, STAGE_WIDTH = 96, STAGE_HEIGHT = 64 };
enum { STAGE_VERTICES = (STAGE_RINGS + 1) * (STAGE_SECTORS + 1) };
enum { STAGE_INDICES = STAGE_RINGS * STAGE_SECTORS * 6 };
enum { STAGE_STRIDE = STAGE_WIDTH + 3, STAGE_PIXELS = STAGE_STRIDE * STAGE_HEIGHT };
enum { STAGE_LAMPS = 3, STAGE_CHUNKS = 8, STAGE_TEXELS = 256, STAGE_LEVELS = 4 };

typedef struct stage {
    shade_target target;
    shade_mesh mesh;
    shade_draw_state state;
    shade_material material;
    shade_light lamps[STAGE_LAMPS];        /* the last is never filled */
    shade_texture map;
    shade_chunk chunk, chunks[STAGE_CHUNKS];
    shade_vec3 position[STAGE_VERTICES], normal[STAGE_VERTICES], color[STAGE_VERTICES];
    shade_vec2 texcoord[STAGE_VERTICES];
    uint32_t index[STAGE_INDICES];
    unsigned char texel[4 * STAGE_TEXELS];
    shade_texture level[STAGE_LEVELS];
    uint32_t level_texel[STAGE_TEXELS / 2];
    float vertex[8 * STAGE_VERTICES];      /* position, normal, texcoord */
    uint16_t half[2 * STAGE_INDICES];      /* of the indices */
    double file[STAGE_VERTICES + STAGE_LAMPS + 2][3];    /* far positions, lamps, eye, center */
    shade_vec3 eye, center;                /* of the camera, for shade_mat4_look_at and ... */
    float fovy, aspect, z_near, z_far;     /* ... shade_mat4_perspective */
    float clear;                           /* depth before the draw; NaN: none is cleared */
    int draws;
    int no_target, no_mesh, no_state, other_stats;
    int turned;                            /* from this index on triangles are wound clockwise */
    int unspoiled;                         /* 1: a mistake only prepares the scene, and sets 2 */
    float pixels[4 * STAGE_PIXELS], depth[STAGE_PIXELS];    /* last: most of the bytes */
} stage;

/* ---- scenes ---------------------------------------------------------------------------------- */

/* A ball of radius 1 around the origin, wound counter-clockwise as seen from outside. */
static inline void stage_ball(stage *s, int rings, int sectors)
{
    int n = 0;
    for (int j = 0; j <= rings; j++)
        for (int i = 0; i <= sectors; i++) {
            const double a = i % sectors * 6.283185307179586 / sectors;
            const double b = j * 3.141592653589793 / rings;
            const double r = j % rings ? sin(b) : 0;
            const int k = j * (sectors + 1) + i;
            s->position[k] = shade_v3((float)(r * sin(a)), (float)cos(b), (float)(r * cos(a)));
            s->normal[k] = s->position[k];
            s->texcoord[k] = shade_v2((float)i / (float)sectors, (float)j / (float)rings);
        }
    for (uint32_t j = 0; j < (uint32_t)rings; j++)
        for (uint32_t i = 0; i < (uint32_t)sectors; i++) {
            const uint32_t a = j * ((uint32_t)sectors + 1) + i, b = a + (uint32_t)sectors + 1;
            const uint32_t corner[6] = { a, b, b + 1, a, b + 1, a + 1 };
            memcpy(s->index + n, corner, sizeof corner);
            n += 6;
        }
    s->mesh.vertex_count = (rings + 1) * (sectors + 1);
    s->mesh.index_count = n;
}
/* The camera, after one of its numbers has changed. */
static inline void stage_look(stage *s)
{
    s->state.view = shade_mat4_look_at(s->eye, s->center, shade_v3(0, 1, 0));
    s->state.projection = shade_mat4_perspective(s->fovy, s->aspect, s->z_near, s->z_far);
}
static inline void stage_place(stage *s, shade_vec3 eye, shade_vec3 center)
{
    s->eye = eye;
    s->center = center;
    stage_look(s);
}
static inline void stage_lens(stage *s, float fovy, float aspect, float z_near, float z_far)
{
    s->fovy = fovy;
    s->aspect = aspect;
    s->z_near = z_near;
    s->z_far = z_far;
    stage_look(s);
}
/* What every scene has: a ball, grey colours, a white map, and no lamp yet. */
static inline void stage_begin(stage *s)
{
    memset(s, 0, sizeof *s);
    s->target.width = STAGE_WIDTH;
    s->target.height = STAGE_HEIGHT;
    s->target.stride = STAGE_STRIDE;
    s->target.color = s->pixels;
    s->target.depth = s->depth;
    stage_ball(s, STAGE_RINGS, STAGE_SECTORS);
    for (int i = 0; i < STAGE_VERTICES; i++) s->color[i] = shade_v3(0.5f, 0.5f, 0.5f);
    s->mesh.positions = &s->position[0].x;
    s->mesh.normals = &s->normal[0].x;
    s->mesh.indices = s->index;
    memset(s->texel, 255, sizeof s->texel);
    s->map.pixels = s->texel;
    s->map.width = s->map.height = 2;
    s->map.srgb = 1;
    s->state.material = &s->material;
    s->state.lighting.lights = s->lamps;
    s->clear = 1;
    s->draws = 1;
}
/* A ball before two lamps. */
static inline void stage_of_ball(stage *s)
{
    stage_begin(s);
    s->chunk.count = STAGE_INDICES / 3;
    s->material.diffuse = s->material.ambient = shade_v3(0.6f, 0.5f, 0.4f);
    s->material.specular = shade_v3(0.3f, 0.3f, 0.3f);
    s->material.shininess = 30;
    s->lamps[0] = shade_point_light(shade_v3(3, 4, 6), shade_v3(1, 1, 1));
    s->lamps[1] = shade_directional_light(shade_v3(1, -1, -1), shade_v3(0.3f, 0.3f, 0.3f));
    s->state.lighting.light_count = 2;
    s->eye = shade_v3(0, 1, 4);
    s->fovy = 0.8f;
    s->aspect = 1.5f;
    s->z_near = 0.1f;
    s->z_far = 100;
    stage_look(s);
}
static inline stage *stage_open(void)
{
    stage *s = (stage *)test_memory(sizeof *s);
    stage_of_ball(s);
    return s;
}
/* README's first program, with the teapot of few triangles. */
static inline void stage_of_teapot(stage *s)
{
    stage_begin(s);
    s->target.srgb = 1;
    teapot_build(2, &s->position[0].x, &s->normal[0].x, &s->texcoord[0].x, s->index);
    s->mesh.vertex_count = teapot_vertex_count(2);
    s->mesh.index_count = teapot_index_count(2);
    s->lamps[0] = shade_point_light(shade_v3(4, 6, 5), shade_v3(1, 1, 1));
    s->material = shade_linear_material(shade_preset_material(SHADE_PRESET_GOLD));
    s->state.lighting.light_count = 1;
    s->eye = shade_v3(0, 4, 8);
    s->center = shade_v3(0, 1.4f, 0);
    s->fovy = 0.7f;
    s->aspect = (float)STAGE_WIDTH / STAGE_HEIGHT;
    s->z_near = 0.1f;
    s->z_far = 100;
    stage_look(s);
}

/* Draws as the stage says, and explains it; stats NULL where they are not to be known. */
static inline const char *stage_explain(stage *s, int with_stats)
{
    const shade_target *t = s->no_target ? NULL : &s->target;
    const shade_mesh *m = s->no_mesh ? NULL : &s->mesh;
    const shade_draw_state *d = s->no_state ? NULL : &s->state;
    shade_stats stats = { 0, 0, 0, 0, 0, 0, 0 };
    const char *said;
    if (s->clear == s->clear) shade_clear(&s->target, shade_v4(0, 0, 0, 1), s->clear);
    for (int k = 0; k < s->draws; k++) shade_draw_mesh(t, m, d, &stats);
    if (s->other_stats) stats.triangles += 12;
    said = shade_explain(t, m, d, with_stats ? &stats : NULL);
    return said ? said : "NULL";
}

/* ---- mistakes -------------------------------------------------------------------------------- */

typedef struct mistake {
    const char *name, *words;    /* "": nothing is said, since it may be meant; a|b: a or b */
    void (*make)(stage *);
    int scenes;
    struct mistake *next;
} mistake;
LISTED(mistake);
enum {
    ON_BALL = 1, ON_TEAPOT = 2, WITH_STATS = 4,
    BALL = ON_BALL, BALL_STATS = ON_BALL | WITH_STATS, POT = ON_TEAPOT,
    BOTH = ON_BALL | ON_TEAPOT, BOTH_STATS = BOTH | WITH_STATS
};
#define MISTAKE(name, scenes, words)                                                               \
    static void mistake_##name(stage *s);                                                          \
    MISTAKE_IN(name, name, scenes, words)                                                          \
    static void mistake_##name(stage *s)
/* The same mistake, which has other words in some scenes. */
#define MISTAKE_IN(name, entry, scenes, words)                                                     \
    LIST(mistake, entry, #name, words, mistake_##name, scenes)
/* Stands in a mistake where the scene is ready for it, and still right. */
#define SPOILED_FROM_HERE(s)                                                                       \
    if ((s)->unspoiled) {                                                                          \
        (s)->unspoiled = 2;                                                                        \
        return;                                                                                    \
    }
#define BLACK shade_v3(0, 0, 0)
#define WHITE shade_v3(1, 1, 1)
#define STAGE_SCALE(k) shade_mat4_scaling(shade_v3(k, k, k))

/* ---- of a newcomer, in any scene */

static inline void stage_reverse(stage *s, float z_near)
{
    s->state.projection = shade_mat4_perspective_reversed(s->fovy, s->aspect, z_near);
    s->state.raster.depth_zero_to_one = 1;
    s->state.raster.depth_test = SHADE_COMPARE_GREATER;
    s->clear = 0;
}
/* The first lamp, alone. */
static inline shade_light *stage_one_lamp(stage *s)
{
    s->state.lighting.light_count = 1;
    return &s->lamps[0];
}
static inline shade_light *stage_lamp(stage *s, shade_light lamp)
{
    s->lamps[0] = lamp;
    s->state.lighting.lights = s->lamps;
    return stage_one_lamp(s);
}
/* A lamp where the first one is, that points at the middle of the mesh. */
static shade_light stage_spot(const stage *s, float cutoff, float exponent)
{
    const shade_vec3 from = shade_madd(s->center, 1.5f, shade_sub(s->eye, s->center));
    return shade_spot_light(from, shade_sub(s->center, from), cutoff, exponent,
                            shade_v3(1, 1, 1));
}
static inline shade_texture *stage_map(stage *s)
{
    s->mesh.texcoords = &s->texcoord[0].x;
    s->state.diffuse_map = &s->map;
    return &s->map;
}
static inline void stage_chunks(stage *s)
{
    shade_mesh_chunks(&s->mesh, s->mesh.index_count / 6 + 1, s->chunks, STAGE_CHUNKS, NULL);
    s->mesh.chunks = s->chunks;
    s->mesh.chunk_count =
        shade_chunk_count(s->mesh.index_count, s->mesh.index_count / 6 + 1);
}
/* A map of 16 x 16 texels, light and dark in turns, with all its levels. */
static inline void stage_levels(stage *s)
{
    stage_map(s);
    for (int k = 0; k < 4 * STAGE_TEXELS; k++)
        s->texel[k] = k % 4 == 3 || ((k / 4 ^ k / 64) & 1) ? 255 : 40;
    s->map.width = s->map.height = 16;
    s->map.filter = SHADE_FILTER_TRILINEAR;
    shade_build_mipmaps(&s->map, s->level, s->level_texel, sizeof s->level_texel);
}
/* Puts the mesh's arrays into one: position, normal and texture coordinates of each vertex. */
static inline void stage_interleave(stage *s)
{
    shade_mesh *m = &s->mesh;
    for (int i = 0; i < m->vertex_count; i++) {
        memcpy(s->vertex + 8 * i, s->position + i, sizeof *s->position);
        memcpy(s->vertex + 8 * i + 3, s->normal + i, sizeof *s->normal);
        memcpy(s->vertex + 8 * i + 6, s->texcoord + i, sizeof *s->texcoord);
    }
    m->positions = s->vertex;
    m->normals = s->vertex + 3;
    m->texcoords = s->vertex + 6;
    m->position_stride = m->normal_stride = m->texcoord_stride = 32;
}
/* Puts the vertices, the point lamps, the eye and what it looks at to places in this order. */
static inline void stage_put(stage *s, const shade_vec3 *place)
{
    memcpy(s->position, place, sizeof s->position);
    for (int k = 0; k < STAGE_LAMPS; k++)
        if (s->lamps[k].position.w != 0)
            memcpy(&s->lamps[k].position, place + STAGE_VERTICES + k, sizeof *place);
    s->state.view = shade_mat4_look_at(place[STAGE_VERTICES + STAGE_LAMPS],
                                       place[STAGE_VERTICES + STAGE_LAMPS + 1],
                                       shade_v3(0, 1, 0));
    if (s->mesh.chunks) stage_chunks(s);
}
/* Moves the mesh, its point lamps and the camera far away; the doubles keep where they are. */
static inline void stage_move_far(stage *s)
{
    const double far[3] = { 8e6, 0, 8e6 };
    const shade_mat4 one = shade_mat4_identity();
    const shade_vec4 *col = s->state.model.col[3].w == 0 ? one.col : s->state.model.col;
    shade_vec3 place[STAGE_VERTICES + STAGE_LAMPS + 2];
    memcpy(place, s->position, sizeof s->position);
    for (int k = 0; k < STAGE_LAMPS; k++)
        memcpy(place + STAGE_VERTICES + k, &s->lamps[k].position, sizeof *place);
    place[STAGE_VERTICES + STAGE_LAMPS] = s->eye;
    place[STAGE_VERTICES + STAGE_LAMPS + 1] = s->center;
    for (int i = 0; i < TEST_COUNT(place); i++)
        for (int k = 0; k < 3; k++) {
            const double by = (double)(&col[0].x)[k] * far[0] + (double)(&col[2].x)[k] * far[2];
            s->file[i][k] = (double)(&place[i].x)[k] + (i < STAGE_VERTICES ? far[k] : by);
            (&place[i].x)[k] = (float)s->file[i][k];
        }
    stage_put(s, place);
}
/* Winds the triangles the other way from an index on. */
static inline void stage_turn(stage *s, int first)
{
    s->turned = first;
    for (int i = first; i + 2 < s->mesh.index_count; i += 3) {
        const uint32_t k = s->index[i];
        s->index[i] = s->index[i + 1];
        s->index[i + 1] = k;
    }
}
static inline void shader_black(const void *uniforms, const shade_fragments *SHADE_RESTRICT in,
                         shade_colors *SHADE_RESTRICT out)
{
    (void)uniforms;
    (void)in;
    SHADE_EACH_LANE(i) { out->color[3][i] = 1; }
}
static inline void shader_that_discards(const void *uniforms,
                                        const shade_fragments *SHADE_RESTRICT in,
                                 shade_colors *SHADE_RESTRICT out)
{
    (void)uniforms;
    (void)in;
    SHADE_EACH_LANE(i) { out->discard[i] = 1; }
}
static inline void shader_white(const void *uniforms, const shade_fragments *SHADE_RESTRICT in,
                         shade_colors *SHADE_RESTRICT out)
{
    (void)uniforms;
    (void)in;
    for (int k = 0; k < 4; k++)
        SHADE_EACH_LANE(i) { out->color[k][i] = 1; }
}

/* the target */
MISTAKE(width_and_height_exchanged, BOTH, "aspect")
{
    const int width = s->target.width;
    s->target.width = s->target.height;
    s->target.height = width;
    s->target.stride = 0;
}
MISTAKE(width_forgotten, BOTH, "target.width") { s->target.width = 0; }
MISTAKE(height_forgotten, BOTH, "target.height") { s->target.height = 0; }
MISTAKE(no_buffers, BOTH, "target.color") { s->target.color = s->target.depth = NULL; }
MISTAKE(color_forgotten, BOTH, "") { s->target.color = NULL; }
MISTAKE(depth_forgotten, BOTH, "target.depth is NULL") { s->target.depth = NULL; }
MISTAKE(srgb_forgotten, BOTH, "") { s->target.srgb = 0; }
MISTAKE(red_and_blue_exchanged, BOTH, "") { s->target.format = SHADE_FORMAT_BGRA8; }
MISTAKE(format_of_masks, BOTH, "target.format") { s->target.format = SHADE_FORMAT_A8; }
MISTAKE(stride_of_a_row_too_few, BOTH, "target.stride") { s->target.stride = s->target.width - 1; }
MISTAKE(clip_of_a_corner_to_draw_in_all, BOTH, "clip rectangle")
{
    s->target.clip_x = s->target.width;
    s->target.clip_y = s->target.height;
}
MISTAKE(clip_by_two_corners, BOTH, "clip")
{
    s->target.clip_x = s->target.width / 4;
    s->target.clip_y = s->target.height / 4;
    s->target.clip_width = s->target.width;
    s->target.clip_height = s->target.height;
}
MISTAKE(clip_width_alone, BOTH, "clip_height") { s->target.clip_width = s->target.width; }
MISTAKE(clip_beside_the_mesh, BOTH, "beside the clip rectangle")
{
    s->target.clip_x = s->target.clip_y = 1;
    s->target.clip_width = s->target.width / 12;
    s->target.clip_height = s->target.height / 12;
}
MISTAKE(strip_without_rows, BOTH, "row_count") { s->target.row_offset = 3; }

/* depth */
MISTAKE(clear_forgotten, BOTH, "shade_clear") { s->clear = NAN; }
MISTAKE(cleared_to_zero, BOTH, "shade_clear") { s->clear = 0; }
MISTAKE(cleared_once_for_two_frames, BOTH_STATS, "shade_clear") { s->draws = 2; }
MISTAKE(test_greater, BOTH, "SHADE_COMPARE_LESS")
{
    s->state.raster.depth_test = SHADE_COMPARE_GREATER;
}
MISTAKE(test_equal, BOTH_STATS, "depth_test|target.depth")
{
    s->state.raster.depth_test = SHADE_COMPARE_EQUAL;
}
MISTAKE(test_always, BOTH, "depth_test") { s->state.raster.depth_test = SHADE_COMPARE_ALWAYS; }
MISTAKE(depth_never_written, BOTH, "depth_read_only") { s->state.raster.depth_read_only = 1; }
MISTAKE(bias_of_one, BOTH_STATS, "depth_bias") { s->state.raster.depth_bias = 1; }
MISTAKE(bias_of_minus_one, BOTH, "depth_bias") { s->state.raster.depth_bias = -1; }
MISTAKE(bias_nan, BOTH, "raster.depth_bias") { s->state.raster.depth_bias = NAN; }
MISTAKE(reversed_camera_in_half, BOTH, "depth_zero_to_one")
{
    s->state.projection = shade_mat4_perspective_reversed(s->fovy, s->aspect, s->z_near);
}
MISTAKE(reversed_without_its_test, BOTH, "depth_test")
{
    stage_reverse(s, s->z_near);
    s->state.raster.depth_test = SHADE_COMPARE_LESS;
    s->clear = 1;
}
MISTAKE(reversed_without_its_test_cleared_to_zero, BOTH, "depth_test|shade_clear")
{
    stage_reverse(s, s->z_near);
    s->state.raster.depth_test = SHADE_COMPARE_LESS;
}
MISTAKE(reversed_without_its_clear, BOTH, "shade_clear")
{
    stage_reverse(s, s->z_near);
    s->clear = 1;
}
MISTAKE(reversed_without_its_flag, BOTH, "depth_zero_to_one")
{
    stage_reverse(s, s->z_near);
    s->state.raster.depth_zero_to_one = 0;
}
MISTAKE(flag_of_vulkan_alone, BOTH, "") { s->state.raster.depth_zero_to_one = 1; }

/* the mesh */
MISTAKE(positions_forgotten, BOTH, "mesh.positions") { s->mesh.positions = NULL; }
MISTAKE(normals_forgotten, BOTH, "") { s->mesh.normals = NULL; }
MISTAKE(vertex_count_forgotten, BOTH, "mesh.vertex_count") { s->mesh.vertex_count = 0; }
MISTAKE(vertex_count_of_another_mesh, BOTH, "mesh.vertex_count") { s->mesh.vertex_count /= 3; }
MISTAKE(indices_forgotten, BOTH, "mesh.indices|mesh.normals|mesh.vertex_count|")
{
    s->mesh.indices = NULL;
    s->mesh.vertex_count -= s->mesh.vertex_count % 3;
}
MISTAKE(index_count_forgotten, BOTH, "mesh.index_count") { s->mesh.index_count = 0; }
MISTAKE(index_count_of_triangles, BOTH, "") { s->mesh.index_count = s->mesh.index_count / 9 * 3; }
MISTAKE(index_count_less_one, BOTH, "multiple of 3") { s->mesh.index_count--; }
MISTAKE(indices_of_16_bits, BOTH, "32 bits")
{
    for (int i = 0; i < s->mesh.index_count / 2; i++)
        s->index[i] = s->index[2 * i] | s->index[2 * i + 1] << 16;
}
MISTAKE(indices_from_one, BOTH, "mesh.vertex_count")
{
    for (int i = 0; i < s->mesh.index_count; i++) s->index[i]++;
}
MISTAKE(indices_never_filled, BOTH, "mesh.indices") { memset(s->index, 0, sizeof s->index); }
MISTAKE(stride_in_floats, BOTH, "bytes") { s->mesh.position_stride = 3; }
MISTAKE(stride_of_eight_floats, BOTH, "position_stride") { s->mesh.position_stride = 8; }
MISTAKE(normal_stride_in_floats, BOTH, "normal_stride") { s->mesh.normal_stride = 3; }
MISTAKE(normal_stride_of_one_float, BOTH, "normal_stride") { s->mesh.normal_stride = 4; }
MISTAKE(color_stride_of_one_float, BOTH, "color_stride")
{
    s->mesh.colors = &s->color[0].x;
    s->mesh.color_stride = 4;
}
MISTAKE(texcoord_stride_of_one_float, BOTH, "texcoord_stride")
{
    s->mesh.texcoords = &s->texcoord[0].x;
    s->mesh.texcoord_stride = 4;
}
MISTAKE(positions_of_doubles, BOTH, "mesh.positions")
{
    for (int i = s->mesh.vertex_count / 2 - 1; i >= 0; i--) {
        const shade_vec3 p = s->position[i];
        const double wide[3] = { (double)p.x, (double)p.y, (double)p.z };
        memcpy(s->position + 2 * i, wide, sizeof wide);
    }
}
/* In hundredths.  0 for what is no number: the mistake may be made of a mesh that has one. */
static inline int32_t stage_hundredths(float f)
{
    return f > -1e6f && f < 1e6f ? (int32_t)(f * 100) : 0;
}
MISTAKE(positions_of_integers, BOTH, "mesh.positions|state.model|small")
{
    for (int i = 0; i < s->mesh.vertex_count; i++) {
        const shade_vec3 q = s->position[i];
        const int32_t p[3] = { stage_hundredths(q.x), stage_hundredths(q.y),
                               stage_hundredths(q.z) };
        memcpy(s->position + i, p, sizeof p);
    }
}
MISTAKE(positions_interleaved_without_stride, BOTH, "mesh.positions|")
{
    for (int i = s->mesh.vertex_count / 2 - 1; i >= 0; i--) {
        s->position[2 * i] = s->position[i];
        s->position[2 * i + 1] = s->normal[i];
    }
}
MISTAKE(position_stride_forgotten, BOTH, "run through each other")
{
    stage_interleave(s);
    SPOILED_FROM_HERE(s)
    s->mesh.position_stride = 0;
}
MISTAKE(normal_stride_forgotten, BOTH, "run through each other")
{
    stage_interleave(s);
    SPOILED_FROM_HERE(s)
    s->mesh.normal_stride = 0;
}
MISTAKE(texcoord_stride_forgotten, BOTH, "run through each other")
{
    stage_levels(s);
    stage_interleave(s);
    SPOILED_FROM_HERE(s)
    s->mesh.texcoord_stride = 0;
}
MISTAKE(indices_of_32_bits_as_16, BOTH, "Every other entry of mesh.indices16")
{
    memcpy(s->half, s->index, sizeof s->half);
    SPOILED_FROM_HERE(s)
    s->mesh.indices16 = s->half;
    s->mesh.indices = NULL;
}
MISTAKE(far_from_the_origin, BOTH, "so far from 0")
{
    SPOILED_FROM_HERE(s)
    stage_move_far(s);
}
MISTAKE(positions_never_filled, BOTH, "mesh.indices|mesh.positions|area")
{
    memset(s->position, 0, sizeof s->position);
}
MISTAKE(positions_nan, BOTH, "mesh.positions")
{
    for (int i = 0; i < s->mesh.vertex_count; i++) s->position[i].y = NAN;
}
MISTAKE(one_position_infinite, BOTH, "mesh.positions")
{
    s->position[s->mesh.vertex_count / 2].x = INFINITY;
}
MISTAKE(normals_never_filled, BOTH, "mesh.normals") { memset(s->normal, 0, sizeof s->normal); }
MISTAKE(normals_against_the_winding, BOTH, "mesh.normals")
{
    for (int i = 0; i < s->mesh.vertex_count; i++) s->normal[i] = shade_neg(s->normal[i]);
}
MISTAKE(normals_nan, BOTH, "mesh.normals")
{
    for (int i = 0; i < s->mesh.vertex_count; i++) s->normal[i] = shade_v3(NAN, NAN, NAN);
}
MISTAKE(normals_as_colours, BOTH, "mesh.normals")    /* 0 .. 1, as pictures hold them */
{
    for (int i = 0; i < s->mesh.vertex_count; i++)
        s->normal[i] = shade_madd(shade_v3(0.5f, 0.5f, 0.5f), 0.5f, s->normal[i]);
}
MISTAKE(normals_in_reverse_order, BOTH, "")
{
    for (int i = 0, k = s->mesh.vertex_count - 1; i < k; i++, k--) {
        const shade_vec3 n = s->normal[i];
        s->normal[i] = s->normal[k];
        s->normal[k] = n;
    }
}
MISTAKE(normals_with_z_up, BOTH, "mesh.normals|")
{
    for (int i = 0; i < s->mesh.vertex_count; i++)
        s->normal[i] = shade_v3(s->normal[i].x, -s->normal[i].z, s->normal[i].y);
}
MISTAKE(positions_as_normals, POT, "mesh.normals|") { s->mesh.normals = s->mesh.positions; }
MISTAKE(inside_out, BOTH, "inside out|winding")
{
    stage_turn(s, 0);
    s->state.raster.cull = SHADE_CULL_BACK;
}
MISTAKE(wound_clockwise_without_normals, BOTH, "wound|winding")
{
    stage_turn(s, 0);
    s->mesh.normals = NULL;
}
MISTAKE(half_wound_clockwise, BOTH, "wound both ways")
{
    stage_turn(s, s->mesh.index_count / 6 * 3);
    s->state.raster.cull = SHADE_CULL_BACK;
}
MISTAKE(half_wound_clockwise_without_normals, BOTH, "wound both ways")
{
    s->mesh.normals = NULL;
    SPOILED_FROM_HERE(s)
    stage_turn(s, s->mesh.index_count / 6 * 3);
}
MISTAKE(fronts_left_out, BOTH, "") { s->state.raster.cull = SHADE_CULL_FRONT; }
MISTAKE(colors_zero, BOTH, "mesh.colors")
{
    memset(s->color, 0, sizeof s->color);
    s->mesh.colors = &s->color[0].x;
}
MISTAKE(colors_of_255, BOTH, "255")
{
    for (int i = 0; i < s->mesh.vertex_count; i++) s->color[i] = shade_v3(200, 128, 130);
    s->mesh.colors = &s->color[0].x;
}
MISTAKE(colors_of_bytes, BOTH, "mesh.colors")
{
    for (int i = 0; i < STAGE_VERTICES; i++) s->color[i] = shade_scale(WHITE, 96.0f / 255);
    s->mesh.colors = &s->color[0].x;
    SPOILED_FROM_HERE(s)
    memset(s->color, 96, sizeof s->color);    /* as floats they are 6e19 */
}
MISTAKE(map_without_texcoords, BOTH, "mesh.texcoords is NULL") { s->state.diffuse_map = &s->map; }
MISTAKE(texcoords_without_map, BOTH, "") { s->mesh.texcoords = &s->texcoord[0].x; }
MISTAKE(texcoords_in_texels, BOTH, "mesh.texcoords")
{
    stage_map(s);
    s->map.width = s->map.height = 16;
    for (int i = 0; i < s->mesh.vertex_count; i++)
        s->texcoord[i] = shade_scale2(s->texcoord[i], 16);
}
MISTAKE(texcoords_never_filled, BOTH, "")
{
    stage_map(s);
    memset(s->texcoord, 0, sizeof s->texcoord);
}
MISTAKE(map_without_pixels, BOTH, "pixels") { stage_map(s)->pixels = NULL; }
MISTAKE(map_black, BOTH, "diffuse_map")
{
    stage_map(s);
    for (int k = 0; k < STAGE_TEXELS * 4; k++) s->texel[k] = (unsigned char)(k % 4 == 3 ? 255 : 0);
}
MISTAKE(map_never_filled_and_cut, BOTH, "alpha_cutoff")
{
    stage_map(s);
    memset(s->texel, 0, sizeof s->texel);
    s->state.alpha_cutoff = 0.5f;
}
MISTAKE(map_invisible, BOTH, "Alpha|alpha")
{
    stage_map(s);
    for (int k = 3; k < STAGE_TEXELS * 4; k += 4) s->texel[k] = 0;
    s->state.raster.blend = SHADE_BLEND_OVER;
}
MISTAKE(map_not_marked_srgb, BOTH, "")
{
    stage_map(s);
    s->map.srgb = 0;
    s->target.srgb = 1;
}
MISTAKE(trilinear_without_mipmaps, BOTH, "mipmaps")
{
    stage_map(s)->filter = SHADE_FILTER_TRILINEAR;
}
MISTAKE(mipmaps_that_begin_with_the_map, BOTH, "max(1, width >> k)")
{
    stage_levels(s);
    SPOILED_FROM_HERE(s)
    for (int k = STAGE_LEVELS - 1; k > 0; k--) s->level[k] = s->level[k - 1];
    s->level[0] = s->map;
}
MISTAKE(mipmaps_of_one_size, BOTH, "max(1, width >> k)")
{
    stage_levels(s);
    SPOILED_FROM_HERE(s)
    for (int k = 0; k < STAGE_LEVELS; k++) s->level[k] = s->map;
}
MISTAKE(texcoords_of_16_bits, BOTH, "mesh.texcoords")
{
    stage_levels(s);
    SPOILED_FROM_HERE(s)
    for (int i = 0; i < s->mesh.vertex_count; i++) {
        const shade_vec2 t = s->texcoord[i];
        const uint16_t uv[2] = { (uint16_t)(65535 * (t.x > 0 && t.x <= 1 ? t.x : 0)),
                                 (uint16_t)(65535 * (t.y > 0 && t.y <= 1 ? t.y : 0)) };
        memcpy((char *)s->texcoord + 4 * i, uv, sizeof uv);
    }
}
MISTAKE(map_of_no_size, BOTH, "texture") { stage_map(s)->width = 0; }
MISTAKE(chunk_count_forgotten, BOTH, "chunk_count")
{
    stage_chunks(s);
    s->mesh.chunk_count = 0;
}
MISTAKE(chunks_null, BOTH, "mesh.chunks")
{
    stage_chunks(s);
    s->mesh.chunks = NULL;
}
MISTAKE(chunks_of_half_the_triangles, BOTH, "mesh.chunks")
{
    stage_chunks(s);
    s->mesh.chunk_count--;
}
MISTAKE(chunks_never_filled, BOTH, "mesh.chunks")
{
    stage_chunks(s);
    memset(s->chunks, 0, sizeof s->chunks);
}
MISTAKE(chunks_of_a_mesh_that_has_moved, BOTH, "mesh.chunks")
{
    stage_chunks(s);
    s->chunks[0].low.x += 40;
    s->chunks[0].high.x += 40;
}

/* lamps */
MISTAKE(lamp_never_filled, BOTH, "no colour|diffuse") { stage_lamp(s, s->lamps[STAGE_LAMPS - 1]); }
MISTAKE(lamp_black, BOTH, "no colour|diffuse")
{
    s->state.lighting.light_count = 1;
    s->lamps[0].diffuse = s->lamps[0].specular = BLACK;
}
MISTAKE(light_of_255, BOTH, "255") { stage_one_lamp(s)->diffuse = shade_v3(255, 255, 255); }
MISTAKE(lamp_of_a_hundredth, BOTH, "diffuse|light")
{
    s->state.lighting.light_count = 1;
    s->lamps[0].diffuse = s->lamps[0].specular = shade_v3(1e-3f, 1e-3f, 1e-3f);
}
MISTAKE(lamp_behind, BOTH, "behind|away")
{
    const shade_vec3 behind = shade_madd(s->center, -1, shade_sub(s->eye, s->center));
    stage_lamp(s, shade_point_light(behind, shade_v3(1, 1, 1)));
}
MISTAKE(lamp_inside, BOTH, "behind|inside|away")
{
    stage_lamp(s, shade_point_light(s->center, shade_v3(1, 1, 1)));
}
/* a lamp at the eye, as OpenGL 1 had it */
MISTAKE(lamp_in_eye_space, BOTH, "behind|away|inside")
{
    stage_lamp(s, shade_point_light(shade_v3(0, 0, 0), shade_v3(1, 1, 1)));
}
MISTAKE(lamp_under_the_ground, BOTH, "behind|away")
{
    s->state.lighting.light_count = 1;
    s->lamps[0].position.y = -s->lamps[0].position.y;
    s->lamps[0].position.z = -s->lamps[0].position.z;
}
MISTAKE(lamp_far_away_that_falls_off, BOTH, "Attenuation")
{
    s->state.lighting.light_count = 1;
    s->lamps[0].position = shade_v4(40, 60, 50, 1);
    s->lamps[0].quadratic = 1;
}
MISTAKE(lamp_that_falls_off_by_the_square, BOTH, "Attenuation")
{
    s->state.lighting.light_count = 1;
    s->lamps[0].position = shade_v4(14, 20, 16, 1);
    s->lamps[0].quadratic = 1;
}
MISTAKE(attenuation_negative, BOTH, "negative|attenuation|constant")
{
    s->state.lighting.light_count = 1;
    s->lamps[0].constant = 1;
    s->lamps[0].linear = -0.2f;
}
MISTAKE(sun_toward_the_light, BOTH, "behind|away")
{
    stage_lamp(s, shade_directional_light(shade_sub(s->eye, s->center), shade_v3(1, 1, 1)));
}
MISTAKE(sun_as_a_point, BOTH, "behind|inside|away")    /* a direction whose w was left at 1 */
{
    stage_lamp(s, shade_directional_light(shade_v3(0, -0.2f, -0.4f), shade_v3(1, 1, 1)));
    s->lamps[0].position.w = 1;
}
MISTAKE(point_as_a_sun, BOTH, "") { stage_one_lamp(s)->position.w = 0; }
MISTAKE(cutoff_in_degrees, BOTH, "cosine|radians") { stage_lamp(s, stage_spot(s, 30, 1)); }
MISTAKE(cosine_in_degrees, BOTH, "cosine|radians")
{
    stage_lamp(s, stage_spot(s, 0.5f, 1))->spot_cos_cutoff = 30;
}
MISTAKE(angle_for_its_cosine, BOTH, "")
{
    stage_lamp(s, stage_spot(s, 0.5f, 1))->spot_cos_cutoff = 0.5f;
}
MISTAKE(cone_toward_the_eye, BOTH, "spot_direction")
{
    stage_lamp(s, stage_spot(s, 0.5f, 1));
    s->lamps[0].spot_direction = shade_neg(s->lamps[0].spot_direction);
}
MISTAKE(cone_at_a_point, BOTH, "spot_direction")    /* a target where the direction belongs */
{
    stage_lamp(s, shade_spot_light(shade_v3(4, 6, 5), shade_v3(0, 1.4f, 0), 0.3f, 1,
                                   shade_v3(1, 1, 1)));
}
MISTAKE(cone_of_a_hair, BOTH, "") { stage_lamp(s, stage_spot(s, 0.01f, 1)); }
MISTAKE(exponent_of_thousands, BOTH, "") { stage_lamp(s, stage_spot(s, 1.5f, 1e5f)); }
MISTAKE(lights_forgotten, BOTH, "lighting.lights") { s->state.lighting.lights = NULL; }
MISTAKE(light_count_forgotten, BOTH, "light_count") { s->state.lighting.light_count = 0; }
MISTAKE(light_count_negative, BOTH, "light_count") { s->state.lighting.light_count = -1; }
MISTAKE(lighting_forgotten, BOTH, "There is no light")
{
    memset(&s->state.lighting, 0, sizeof s->state.lighting);
}
MISTAKE(lighting_of_ambient_alone, BOTH, "Only ambient light")
{
    memset(&s->state.lighting, 0, sizeof s->state.lighting);
    s->state.lighting.ambient = shade_v3(0.2f, 0.2f, 0.2f);
}
MISTAKE(ambient_of_one, BOTH, "") { s->state.lighting.ambient = shade_v3(1, 1, 1); }
MISTAKE(ambient_of_255, BOTH, "255") { s->state.lighting.ambient = shade_v3(128, 128, 128); }
MISTAKE(lamp_without_specular, BOTH, "") { stage_one_lamp(s)->specular = BLACK; }
MISTAKE(lamp_of_ambient_light, BOTH, "Only ambient|diffuse")    /* filled by hand */
{
    s->state.lighting.light_count = 1;
    s->lamps[0].diffuse = s->lamps[0].specular = BLACK;
    s->lamps[0].ambient = shade_v3(0.5f, 0.5f, 0.5f);
}
MISTAKE(lamp_nan, BOTH, "NaN") { stage_one_lamp(s)->position.x = NAN; }
MISTAKE(lamp_without_position, BOTH, "direction without length")    /* filled by hand */
{
    memset(&stage_one_lamp(s)->position, 0, sizeof s->lamps[0].position);
}
MISTAKE(lamp_negative, POT, "negative colour")
{
    stage_one_lamp(s)->diffuse = WHITE;
    SPOILED_FROM_HERE(s)
    s->lamps[0].diffuse = shade_v3(-1, -1, -1);
}
MISTAKE(terms_of_nothing, BOTH, "lighting.terms") { s->state.lighting.terms = SHADE_TERM_EMISSION; }
MISTAKE(terms_of_highlights, BOTH, "") { s->state.lighting.terms = SHADE_TERM_SPECULAR; }
MISTAKE(terms_unknown, BOTH, "lighting.terms") { s->state.lighting.terms = 64; }
MISTAKE(model_of_emission, BOTH, "lighting.model")
{
    s->state.lighting.model = SHADE_MODEL_EMISSIVE;
}
MISTAKE(model_of_ambient_light, BOTH, "lighting.model")
{
    s->state.lighting.model = SHADE_MODEL_AMBIENT;
}
MISTAKE(model_unknown, BOTH, "lighting.model") { s->state.lighting.model = (shade_model)44; }
MISTAKE(shading_unknown, BOTH, "state.shading") { s->state.shading = (shade_shading)7; }
MISTAKE(a_pool_of_light_by_vertices, BOTH, "")    /* it falls where there are some, or none */
{
    stage_lamp(s, stage_spot(s, 0.06f, 1));
    s->state.shading = SHADE_SHADING_PER_VERTEX;
}

/* the material */
MISTAKE(material_forgotten, BOTH, "") { s->state.material = NULL; }
MISTAKE(material_never_filled, BOTH, "state.material")
{
    memset(&s->material, 0, sizeof s->material);
}
MISTAKE(material_of_255, BOTH, "255")
{
    s->material.diffuse = s->material.ambient = shade_v3(255, 200, 100);
}
MISTAKE(material_of_ambient_light, BOTH, "state.material|material.diffuse")
{
    s->material.diffuse = s->material.specular = BLACK;
}
MISTAKE(ambient_without_k_a, BOTH, "material.ambient")
{
    memset(&s->state.lighting, 0, sizeof s->state.lighting);
    s->state.lighting.ambient = shade_v3(0.5f, 0.5f, 0.5f);
    s->material.ambient = BLACK;
}
MISTAKE(material_of_highlights, BOTH, "") { s->material.diffuse = s->material.ambient = BLACK; }
MISTAKE(material_dark, BOTH, "state.material|diffuse")
{
    s->material.diffuse = s->material.ambient = shade_v3(1e-3f, 1e-3f, 1e-3f);
    s->material.specular = BLACK;
}
MISTAKE(material_negative, BOTH, "state.material|negative")
{
    s->material.diffuse = shade_neg(s->material.diffuse);
    s->material.specular = BLACK;
}
MISTAKE(shininess_forgotten, BOTH, "shininess") { s->material.shininess = 0; }
MISTAKE(shininess_of_a_table, BOTH, "shininess") { s->material.shininess = 0.4f; }
MISTAKE(emission_of_the_diffuse_colour, BOTH, "") { s->material.emission = s->material.diffuse; }
MISTAKE(emission_white, BOTH, "emission") { s->material.emission = shade_v3(1, 1, 1); }
MISTAKE(invisible, BOTH, "transparency")
{
    s->state.transparency = 1;
    s->state.raster.blend = SHADE_BLEND_OVER;
}
MISTAKE(opacity_for_transparency, BOTH, "transparency|alpha_cutoff")
{
    s->state.transparency = 1;
    s->state.alpha_cutoff = 0.5f;
}
MISTAKE(transparency_in_percent, BOTH, "state.transparency") { s->state.transparency = 50; }
MISTAKE(transparency_without_blend, BOTH, "raster.blend") { s->state.transparency = 0.5f; }
MISTAKE(cutoff_of_128, BOTH, "state.alpha_cutoff") { s->state.alpha_cutoff = 128; }
MISTAKE(cutoff_above_the_alpha, BOTH, "alpha_cutoff")
{
    s->state.transparency = 0.6f;
    s->state.alpha_cutoff = 0.5f;
}
MISTAKE(cull_unknown, BOTH, "raster.cull") { s->state.raster.cull = (shade_cull)4; }
MISTAKE(blend_unknown, BOTH, "raster.blend") { s->state.raster.blend = (shade_blend)77; }
MISTAKE(depth_test_unknown, BOTH, "raster.depth_test")
{
    s->state.raster.depth_test = (shade_compare)513;
}
MISTAKE(shader_discards_all, BOTH_STATS, "state.fragment")
{
    s->state.fragment = shader_that_discards;
}
MISTAKE(shader_leaves_black, BOTH, "state.fragment") { s->state.fragment = shader_black; }
static inline void shader_of_color(const void *uniforms, const shade_fragments *SHADE_RESTRICT in,
                                   shade_colors *SHADE_RESTRICT out)
{
    const float *color = (const float *)uniforms;
    (void)in;
    for (int k = 0; k < 4; k++) SHADE_EACH_LANE(i) { out->color[k][i] = color[k]; }
}
static inline void stage_shade(stage *s, const float *color, shade_blend blend)
{
    s->state.fragment = shader_of_color;
    s->state.uniforms = color;
    s->state.raster.blend = blend;
}
MISTAKE(shader_of_no_alpha_over, BOTH, "Alpha is 0 everywhere")
{
    static const float clear[4] = { 1, 0.5f, 0.5f, 0 };
    stage_shade(s, clear, SHADE_BLEND_OVER);
}
MISTAKE(shader_adds_black, BOTH, "adds nothing")
{
    static const float black[4] = { 0, 0, 0, 1 };
    stage_shade(s, black, SHADE_BLEND_ADD);
}
MISTAKE(shader_adds_without_alpha, BOTH, "adds nothing")
{
    static const float clear[4] = { 1, 0.5f, 0.5f, 0 };
    stage_shade(s, clear, SHADE_BLEND_ADD);
}
MISTAKE(shader_of_nan_in_one_channel, BOTH, "gives NaN")
{
    static const float bad[4] = { 0.5f, NAN, 0.5f, 1 };
    stage_shade(s, bad, SHADE_BLEND_REPLACE);
}
MISTAKE(shader_of_alpha_nan_over, BOTH, "gives NaN")
{
    static const float bad[4] = { 0.5f, 0.5f, 0.5f, NAN };
    stage_shade(s, bad, SHADE_BLEND_OVER);
}
MISTAKE(shader_of_255, BOTH, "1 is full light, not 255")
{
    static const float bytes[4] = { 200, 100, 90, 1 };
    stage_shade(s, bytes, SHADE_BLEND_REPLACE);
}
static inline void shader_of_lane_0(const void *uniforms, const shade_fragments *SHADE_RESTRICT in,
                                    shade_colors *SHADE_RESTRICT out)
{
    (void)uniforms;
    for (int k = 0; k < 3; k++) out->color[k][0] = in->z[0];
}
MISTAKE(shader_writes_lane_0, BOTH, "writes lane 0") { s->state.fragment = shader_of_lane_0; }
MISTAKE(shader_by_vertices, BOTH, "state.shading")
{
    s->state.fragment = shader_white;
    s->state.shading = SHADE_SHADING_PER_VERTEX;
}

/* cameras */
MISTAKE(view_forgotten, BOTH, "state.view|the eye")
{
    memset(&s->state.view, 0, sizeof s->state.view);
}
MISTAKE(eye_and_center_exchanged, BOTH, "") { stage_place(s, s->center, s->eye); }
MISTAKE(looks_the_other_way, BOTH, "behind the eye")
{
    stage_place(s, s->eye, shade_madd(s->eye, 1, shade_sub(s->eye, s->center)));
}
MISTAKE(looks_to_the_side, BOTH, "beside|out of view")
{
    const shade_vec3 ahead = shade_sub(s->center, s->eye);
    const float far = shade_length(ahead);
    s->center = shade_madd(s->eye, 1, shade_scale(shade_normalize(shade_cross(
                                           ahead, shade_v3(0, 1, 0))), far));
    s->center = shade_madd(s->center, 0.2f, ahead);
    stage_look(s);
}
MISTAKE(eye_at_its_center, BOTH, "eye|state.view") { stage_place(s, s->center, s->center); }
MISTAKE(up_along_the_view, BOTH, "")
{
    s->state.view = shade_mat4_look_at(s->eye, s->center, shade_sub(s->eye, s->center));
}
MISTAKE(view_inverted, BOTH, "inverse") { s->state.view = shade_mat4_inverse(s->state.view); }
MISTAKE(view_by_rows, BOTH, "state.view looks transposed")
{
    s->state.view = shade_mat4_transpose(s->state.view);
}
MISTAKE(view_nan, BOTH, "NaN") { s->state.view.col[3].x = NAN; }
MISTAKE(view_moves_the_camera, BOTH, "behind the eye|inverse")    /* not the world */
{
    s->state.view = shade_mat4_translation(shade_sub(s->eye, s->center));
}
MISTAKE(view_without_translation, BOTH, "eye|state.view|area")
{
    s->state.view.col[3] = shade_v4(0, 0, 0, 1);
}
MISTAKE(view_without_its_last_one, BOTH, "state.view") { s->state.view.col[3].w = 0; }
MISTAKE(view_that_scales, BOTH, "state.view")
{
    s->state.view = shade_mat4_mul(shade_mat4_scaling(shade_v3(0.5f, 0.5f, 0.5f)), s->state.view);
}
MISTAKE(view_twice, BOTH, "") { s->state.model = s->state.view; }
MISTAKE(eye_a_thousand_away, BOTH, "beyond the far plane")
{
    stage_place(s, shade_madd(s->center, 1000, shade_sub(s->eye, s->center)), s->center);
}
MISTAKE(eye_inside, BOTH, "inside|the eye")
{
    stage_place(s, shade_madd(s->center, 0.02f, shade_sub(s->eye, s->center)), s->center);
}
MISTAKE(projection_forgotten, BOTH, "state.projection")
{
    memset(&s->state.projection, 0, sizeof s->state.projection);
}
MISTAKE(both_cameras_forgotten, POT, "state.view|state.projection")
{
    memset(&s->state.view, 0, sizeof s->state.view);
    memset(&s->state.projection, 0, sizeof s->state.projection);
}
MISTAKE(fovy_in_degrees, BOTH, "radians") { stage_lens(s, 40, s->aspect, s->z_near, s->z_far); }
MISTAKE(fovy_zero, BOTH, "fovy") { stage_lens(s, 0, s->aspect, s->z_near, s->z_far); }
MISTAKE(fovy_made_radians_twice, BOTH, "")
{
    stage_lens(s, shade_radians(s->fovy), s->aspect, s->z_near, s->z_far);
}
MISTAKE(fovy_of_half_a_turn, BOTH, "too small")
{
    stage_lens(s, 3, s->aspect, s->z_near, s->z_far);
}
MISTAKE(aspect_of_integers, BOTH, "aspect")
{
    if (s->target.height) s->aspect = (float)(s->target.width / s->target.height);
    stage_look(s);
}
MISTAKE(aspect_upside_down, BOTH, "aspect")
{
    stage_lens(s, s->fovy, 1 / s->aspect, s->z_near, s->z_far);
}
MISTAKE(aspect_zero, BOTH, "aspect") { stage_lens(s, s->fovy, 0, s->z_near, s->z_far); }
MISTAKE(near_zero, BOTH, "near") { stage_lens(s, s->fovy, s->aspect, 0, s->z_far); }
MISTAKE(near_negative, BOTH, "near and far above 0")
{
    stage_lens(s, s->fovy, s->aspect, -1, s->z_far);
}
MISTAKE(near_is_far, BOTH, "different") { stage_lens(s, s->fovy, s->aspect, s->z_far, s->z_far); }
MISTAKE(near_and_far_exchanged, BOTH, "near of state.projection is beyond far")
{
    stage_lens(s, s->fovy, s->aspect, s->z_far, s->z_near);
}
MISTAKE(near_tiny, BOTH_STATS, "near") { stage_lens(s, s->fovy, s->aspect, 1e-7f, s->z_far); }
MISTAKE(far_too_near, BOTH, "beyond the far plane")
{
    stage_lens(s, s->fovy, s->aspect, s->z_near, 2 * s->z_near);
}
MISTAKE(near_too_far, BOTH, "nearer than the near plane")
{
    stage_lens(s, s->fovy, s->aspect, s->z_far / 2, s->z_far);
}
MISTAKE(projection_by_rows, BOTH, "state.projection looks transposed|row-major")
{
    s->state.projection = shade_mat4_transpose(s->state.projection);
}
MISTAKE(all_by_rows, BOTH, "transposed")
{
    s->state.view = shade_mat4_transpose(s->state.view);
    s->state.projection = shade_mat4_transpose(s->state.projection);
}
MISTAKE(view_and_projection_exchanged, BOTH, "swapped")
{
    const shade_mat4 view = s->state.view;
    s->state.view = s->state.projection;
    s->state.projection = view;
}
MISTAKE(projection_times_view_as_view, BOTH, "state.view")
{
    s->state.view = shade_mat4_mul(s->state.projection, s->state.view);
    memset(&s->state.projection, 0, sizeof s->state.projection);
}
MISTAKE(projection_times_view_as_projection, BOTH, "state.view")
{
    s->state.projection = shade_mat4_mul(s->state.projection, s->state.view);
    memset(&s->state.view, 0, sizeof s->state.view);
}
MISTAKE(view_times_projection_as_projection, BOTH, "state.projection|state.view")
{
    s->state.projection = shade_mat4_mul(s->state.view, s->state.projection);
    memset(&s->state.view, 0, sizeof s->state.view);
}
MISTAKE(all_in_model, POT, "state.model holds a projection")
{
    s->state.model = shade_mat4_mul(s->state.projection, s->state.view);
    memset(&s->state.view, 0, sizeof s->state.view);
    memset(&s->state.projection, 0, sizeof s->state.projection);
}
MISTAKE(projection_left_handed, BOTH, "behind the eye|inverse")
{
    s->state.projection.col[2].w = 1;
    s->state.projection.col[2].z = -s->state.projection.col[2].z;
}
MISTAKE(projection_upside_down, BOTH, "inside out|state.projection")    /* as Vulkan has it */
{
    s->state.projection.col[1].y = -s->state.projection.col[1].y;
    s->state.raster.cull = SHADE_CULL_BACK;
}
MISTAKE(ortho_in_pixels, BOTH, "small|pixel|near plane|beyond|beside|state.projection")
{
    s->state.projection = shade_mat4_ortho(0, (float)s->target.width, (float)s->target.height, 0,
                                           -1, 1);
}
MISTAKE(ortho_too_short, BOTH, "near plane|far plane|before near")
{
    s->state.projection = shade_mat4_ortho(-3, 3, -2, 2, -1, 1);
}
MISTAKE(ortho_empty, BOTH, "left not equal to right|left")
{
    s->state.projection = shade_mat4_ortho(1, 1, -1, 1, 0.1f, 9);
}

/* the model */
MISTAKE(model_scaled_to_nothing, BOTH, "state.model") { s->state.model = STAGE_SCALE(0); }
MISTAKE(model_in_millimetres, BOTH, "eye|state.model") { s->state.model = STAGE_SCALE(1e3f); }
MISTAKE(model_far_too_small, BOTH, "small") { s->state.model = STAGE_SCALE(1e-5f); }
MISTAKE(model_moved_away, BOTH, "state.model")
{
    s->state.model = shade_mat4_translation(shade_v3(70, 0, 0));
}
MISTAKE(model_by_rows, BOTH, "state.model looks transposed")
{
    s->state.model = shade_mat4_transpose(shade_mat4_translation(shade_v3(1, 0, 0)));
}
MISTAKE(model_nan, BOTH, "state.model") { s->state.model = STAGE_SCALE(NAN); }
MISTAKE(model_without_its_last_one, BOTH, "state.model")
{
    s->state.model = shade_mat4_translation(shade_v3(0.2f, 0, 0));
    s->state.model.col[3].w = 0;
}
MISTAKE(mirrored, BOTH, "inside out|mirrors")
{
    s->state.model = shade_mat4_scaling(shade_v3(-1, 1, 1));
    s->state.raster.cull = SHADE_CULL_BACK;
}
MISTAKE(model_turned_by_degrees, BOTH, "")
{
    s->state.model = shade_mat4_rotation(90, shade_v3(0, 1, 0));
}
MISTAKE(moved_before_scaled, BOTH, "")    /* scale * translation, not translation * scale */
{
    s->state.model = shade_mat4_mul(STAGE_SCALE(0.5f), shade_mat4_translation(shade_v3(1, 0, 0)));
}

/* the call */
MISTAKE(target_null, BOTH, "target is NULL") { s->no_target = 1; }
MISTAKE(mesh_null, BOTH, "mesh is NULL") { s->no_mesh = 1; }
MISTAKE(state_null, BOTH, "state is NULL") { s->no_state = 1; }
MISTAKE(stats_of_another_mesh, BOTH_STATS, "stats") { s->other_stats = 1; }

/* ---- of the ball */

MISTAKE(clip_negative, BALL, "clip_width") { s->target.clip_width = -1; }
MISTAKE(vertex_count_negative, BALL, "mesh.vertex_count") { s->mesh.vertex_count = -3; }
MISTAKE(index_count_negative, BALL, "mesh.index_count") { s->mesh.index_count = -3; }
/* One chunk of all triangles, with this box. */
static inline shade_chunk *stage_chunk(stage *s, shade_vec3 low, shade_vec3 high)
{
    s->mesh.chunks = &s->chunk;
    s->mesh.chunk_count = 1;
    s->chunk.low = low;
    s->chunk.high = high;
    return &s->chunk;
}
MISTAKE(chunk_outside, BALL, "chunk") { stage_chunk(s, BLACK, BLACK)->first = 1; }
MISTAKE(chunks_of_another_mesh, BALL, "mesh.chunks")
{
    stage_chunk(s, shade_v3(9, 9, 9), shade_v3(10, 10, 10));
}
MISTAKE(index_beyond, BALL, "mesh.vertex_count") { s->index[77] = STAGE_VERTICES; }
MISTAKE(vertices_not_in_threes, BALL, "mesh.vertex_count")
{
    s->mesh.indices = NULL;
    s->mesh.vertex_count = 100;
}
MISTAKE(vertex_count_forgotten_without_indices, BALL, "mesh.vertex_count")
{
    s->mesh.indices = NULL;
    s->mesh.vertex_count = 0;
}
MISTAKE(swapped_ortho, BALL, "swapped")
{
    s->state.projection = s->state.view;
    s->state.view = shade_mat4_ortho(-2, 2, -2, 2, 0.1f, 100);
}
MISTAKE(ortho_by_rows, BALL, "state.projection")
{
    s->state.projection = shade_mat4_transpose(shade_mat4_ortho(-3, 1, -1, 1, 0.01f, 0.1f));
}
MISTAKE(beyond_far_where_the_inverse_looks, BALL, "beyond the far plane")
{
    s->state.view = shade_mat4_translation(shade_v3(0, 0, -4));
    s->state.projection = shade_mat4_perspective(0.8f, 1.5f, 0.1f, 20);
    s->state.model = shade_mat4_translation(shade_v3(0, 0, -20));
}
MISTAKE(left_handed, BALL, "behind the eye")
{
    s->state.model = shade_mat4_translation(shade_v3(0, 0, 8));
}
MISTAKE(view_infinite, BALL, "state.view") { s->state.view.col[3].x = INFINITY; }
MISTAKE(projection_nan, BALL, "state.projection") { s->state.projection.col[0].x = NAN; }
static inline void stage_quad(stage *s)
{
    static const uint32_t corners[6] = { 0, 1, 2, 0, 2, 3 };
    static const shade_vec3 quad[4] = { { -1, -1, 0 }, { 1, -1, 0 }, { 1, 1, 0 }, { -1, 1, 0 } };
    memcpy(s->position, quad, sizeof quad);
    memcpy(s->index, corners, sizeof corners);
    s->mesh.index_count = 6;
}
MISTAKE(wound_clockwise_quad, BALL, "counter-clockwise")
{
    stage_quad(s);
    stage_turn(s, 0);
    s->state.raster.cull = SHADE_CULL_BACK;
}
MISTAKE(culled_by_mirror, BALL, "state.model that mirrors")
{
    stage_quad(s);
    s->state.raster.cull = SHADE_CULL_BACK;
    s->state.model = shade_mat4_scaling(shade_v3(-1, 1, 1));
}
MISTAKE(culled_front, BALL, "SHADE_CULL_FRONT")
{
    stage_quad(s);
    s->state.raster.cull = SHADE_CULL_FRONT;
}
MISTAKE(culled_inside, BALL, "the eye lies inside")
{
    s->state.raster.cull = SHADE_CULL_BACK;
    s->state.view = shade_mat4_look_at(shade_v3(0, 0, 0), shade_v3(0, 0, -1), shade_v3(0, 1, 0));
}
MISTAKE(culled_inside_with_chunks, BALL, "the eye lies inside")
{
    mistake_culled_inside(s);
    stage_chunk(s, shade_v3(-1, -1, -1), shade_v3(1, 1, 1));
}
/* Rings from the far one to the near one, and the other way: fronts are drawn first, or last. */
MISTAKE(inside_out_from_below, BALL, "inside out")
{
    s->state.view = shade_mat4_look_at(shade_v3(0, -4, 0.1f), shade_v3(0, 0, 0), shade_v3(0, 0, 1));
    mistake_inside_out(s);
}
MISTAKE(inside_out_from_above, BALL, "inside out")
{
    s->state.view = shade_mat4_look_at(shade_v3(0, 4, 0.1f), shade_v3(0, 0, 0), shade_v3(0, 0, 1));
    mistake_inside_out(s);
}
MISTAKE(inside_out_with_a_bias, BALL, "inside out")
{
    mistake_inside_out(s);
    s->state.raster.depth_bias = -1;
}
MISTAKE(inside_out_open, BALL, "inside out")
{
    s->mesh.index_count = STAGE_INDICES * 2 / 3;
    mistake_inside_out(s);
}
MISTAKE(mirrored_open, BALL, "inside out")
{
    s->mesh.index_count = STAGE_INDICES * 2 / 3;
    s->state.model = shade_mat4_scaling(shade_v3(1, 1, -1));
    s->state.raster.cull = SHADE_CULL_BACK;
}
MISTAKE(inside_out_without_normals, BALL, "inside out")
{
    s->mesh.normals = NULL;
    mistake_inside_out(s);
}
/* Depth as it comes from the heap: every byte of the pixels is this one. */
static inline void stage_leave_depth(stage *s, int byte)
{
    for (int y = 0; y < STAGE_HEIGHT; y++)
        memset(s->target.depth + (size_t)y * STAGE_STRIDE, byte, 4 * STAGE_WIDTH);
    s->clear = NAN;
}
/* nobody draws outside the clip rectangle, so that depth there says nothing */
MISTAKE(clear_forgotten_where_it_draws, BALL, "holds 0")
{
    s->target.clip_width = STAGE_WIDTH / 2;
    s->target.clip_height = STAGE_HEIGHT / 2;
    s->clear = NAN;
    for (int y = 0; y < STAGE_HEIGHT; y++)
        for (int x = 0; x < STAGE_WIDTH; x++)
            s->target.depth[y * STAGE_STRIDE + x] =
                x < STAGE_WIDTH / 2 && y < STAGE_HEIGHT / 2 ? 0 : 1;
}
MISTAKE(depth_full_of_nan, BALL, "shade_clear") { stage_leave_depth(s, 255); }
/* The rectangle alone is cleared to 0, and depth beside it is fit for a picture. */
static inline void clear_to_zero_in(stage *s, int x, int y, int width, int height)
{
    shade_clear(&s->target, shade_v4(0, 0, 0, 1), 1);
    s->target.clip_x = x;
    s->target.clip_y = y;
    s->target.clip_width = width;
    s->target.clip_height = height;
    s->clear = 0;
}
MISTAKE(zero_on_the_left, BALL, "holds 0")
{
    clear_to_zero_in(s, 0, 0, STAGE_WIDTH / 2, STAGE_HEIGHT);
}
MISTAKE(zero_on_the_right, BALL, "holds 0")
{
    clear_to_zero_in(s, STAGE_WIDTH / 2, 0, STAGE_WIDTH / 2, STAGE_HEIGHT);
}
MISTAKE(zero_above, BALL, "holds 0") { clear_to_zero_in(s, 0, 0, STAGE_WIDTH, STAGE_HEIGHT / 2); }
MISTAKE(zero_below, BALL, "holds 0")
{
    clear_to_zero_in(s, 0, STAGE_HEIGHT / 2, STAGE_WIDTH, STAGE_HEIGHT / 2);
}
MISTAKE(hidden_by_the_frame_before, BALL_STATS, "shade_clear") { s->clear = 0.5f; }
MISTAKE(greater_cleared_to_zero, BALL, "SHADE_COMPARE_LESS")
{
    s->clear = 0;
    mistake_test_greater(s);
}
MISTAKE(clip_empty, BALL, "clip_width")
{
    s->target.clip_x = 10;
    s->target.clip_height = 20;
}
MISTAKE(clip_beside, BALL, "clip_x")
{
    s->target.clip_x = STAGE_WIDTH;
    s->target.clip_width = s->target.clip_height = 20;
}
MISTAKE(smaller_than_a_pixel, BALL_STATS, "No pixel centre")
{
    s->state.model = shade_mat4_scaling(shade_v3(5e-3f, 5e-3f, 5e-3f));
}
MISTAKE(map_cut_by_alpha, BALL_STATS, "alpha_cutoff")
{
    for (int k = 3; k < 16; k += 4) s->texel[k] = 100;
    stage_map(s);
    s->state.alpha_cutoff = 0.5f;
}
MISTAKE(no_depth_with_culling, BALL, "target.depth is NULL")
{
    s->target.depth = NULL;
    s->state.raster.cull = SHADE_CULL_BACK;
    for (int i = 0; i < STAGE_VERTICES; i += 3) s->position[i] = shade_scale(s->position[i], 0.5f);
}

MISTAKE(no_light, BALL, "no light")
{
    s->state.lighting.lights = NULL;
    s->state.lighting.light_count = 0;
}
/* a triangle at the right edge of the picture, with a corner behind the eye on the left */
MISTAKE(no_light_beside_the_eye, BALL, "light_count")
{
    s->position[0] = shade_v3(2.28f, -0.8f, 0);
    s->position[1] = shade_v3(2.28f, 0.8f, 0);
    s->position[2] = shade_v3(-1, 0, 8);
    s->mesh.indices = NULL;
    s->mesh.vertex_count = 3;
    s->state.view = shade_mat4_look_at(shade_v3(0, 0, 4), shade_v3(0, 0, 0), shade_v3(0, 1, 0));
    s->state.lighting.light_count = 0;
}
MISTAKE(normals_inward_of_a_quad, BALL, "mesh.normals")
{
    stage_quad(s);
    for (int i = 0; i < 4; i++) s->normal[i] = shade_v3(0, 0, -1);
}
MISTAKE(attenuated_away, BALL, "Attenuation")
{
    s->lamps[0].constant = 1;
    s->lamps[0].quadratic = 50;
    s->state.lighting.light_count = 1;
}
MISTAKE(spot_attenuated_away, BALL, "Attenuation")
{
    s->lamps[0] = shade_spot_light(shade_v3(0, 1, 4), shade_v3(0, -1, -4), 0.5f, 1,
                                   shade_v3(1, 1, 1));
    s->lamps[0].quadratic = 5000;
    s->state.lighting.light_count = 1;
}
/* The mesh lies in the cone, and far from its axis. */
/* Seen from afar and lit at a flat angle: R.V is 0.08 at most and shows nothing, N.H would. */
MISTAKE(mirror_turned_away, BALL, "graze")
{
    stage_quad(s);
    s->state.raster.cull = SHADE_CULL_BACK;
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
/* What the questions ask for beside the mistake itself: other projections, no depth, few lamps. */
MISTAKE(view_of_w_two, BALL, "state.view") { s->state.view.col[3].w = 2; }
MISTAKE(left_handed_projection_by_rows, BALL, "state.projection looks transposed|row-major")
{
    const shade_mat4 turn = shade_mat4_scaling(shade_v3(1, 1, -1));
    s->state.view = shade_mat4_mul(turn, s->state.view);
    s->state.projection = shade_mat4_mul(s->state.projection, turn);
    mistake_projection_by_rows(s);
}
MISTAKE(projection_onto_a_point, BALL, "fovy")
{
    memset(&s->state.projection, 0, sizeof s->state.projection);
    s->state.projection.col[3] = shade_v4(0, 0, 2, 3);
}
MISTAKE(small_one_beside_without_depth, BALL, "beside the picture")
{
    s->target.depth = NULL;
    s->state.model = shade_mat4_scaling(shade_v3(0.1f, 0.1f, 0.1f));
    s->state.model.col[3].x = 5;
}
MISTAKE(tall_one_beside, BALL, "beside the picture")
{
    s->state.model = shade_mat4_scaling(shade_v3(0.1f, 1.5f, 0.1f));
    s->state.model.col[3].x = 5;
}
MISTAKE(doubled_looks_away, BALL, "behind the eye")
{
    float *p = (float *)&s->state.projection;
    mistake_looks_the_other_way(s);
    for (int k = 0; k < 16; k++) p[k] *= 2;
}
MISTAKE(beside_in_parallel, BALL, "beside the picture")
{
    s->state.projection = shade_mat4_ortho(-3, 3, -2, 2, 0.1f, 20);
    mistake_model_moved_away(s);
}
MISTAKE(beside_in_a_view_that_scales, BALL, "beside the picture")
{
    s->state.view = shade_mat4_mul(shade_mat4_scaling(shade_v3(2, 2, 2)), s->state.view);
    mistake_model_moved_away(s);
}
/* Two triangles, a and b away from the origin, seen by a camera that stands there. */
static inline void stage_two_triangles(stage *s, shade_vec3 a, shade_vec3 b)
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
MISTAKE(lamp_behind_what_the_map_leaves, BALL, "Every lamp is behind")
{
    stage_two_triangles(s, shade_v3(-1.2f, 0, 0), shade_v3(0.2f, 0, 0));
    s->state.view = shade_mat4_look_at(shade_v3(0, 0, 4), shade_v3(0, 0, 0), shade_v3(0, 1, 0));
    for (int i = 0; i < 6; i++) {
        s->normal[i] = shade_v3(0, 0, i < 3 ? 1.0f : -1.0f);
        s->texcoord[i] = shade_v2(i < 3 ? 0.25f : 0.75f, 0.25f);
    }
    s->texel[3] = s->texel[11] = 0;
    stage_map(s);
    s->state.alpha_cutoff = 0.5f;
    s->state.lighting.light_count = 1;
    s->target.depth = NULL;
}
MISTAKE(lamp_behind_what_the_map_leaves_in_ambient_light, BALL, "")
{
    mistake_lamp_behind_what_the_map_leaves(s);
    s->state.lighting.ambient = shade_v3(0.1f, 0.1f, 0.1f);
}
MISTAKE(on_both_sides, BALL, "beside the picture")
{
    stage_two_triangles(s, shade_v3(-99, 0, -4), shade_v3(99, 0, -4));
}
MISTAKE(before_and_beyond, BALL, "beyond far")
{
    stage_two_triangles(s, shade_v3(0, 0, -0.01f), shade_v3(0, 0, -999));
}
MISTAKE(all_discarded_of_depth, BALL_STATS, "state.fragment")
{
    s->target.color = NULL;
    s->state.alpha_cutoff = 0.5f;
    mistake_shader_discards_all(s);
}
MISTAKE(small_depth_of_a_shader, BALL_STATS, "No pixel centre")
{
    s->target.color = NULL;
    mistake_shader_discards_all(s);
    mistake_smaller_than_a_pixel(s);
}
MISTAKE(no_light_on_floats, BALL, "no light")
{
    s->target.format = SHADE_FORMAT_RGBA32F;
    mistake_no_light(s);
}
MISTAKE(no_light_on_the_default, BALL, "no light")
{
    s->state.material = NULL;
    mistake_no_light(s);
}
MISTAKE(no_light_on_a_mirror, BALL, "no light")
{
    s->material.diffuse = s->material.ambient = shade_v3(0, 0, 0);
    mistake_no_light(s);
}
MISTAKE(lamp_of_highlights_behind, BALL, "no colour")
{
    mistake_lamp_behind(s);
    s->lamps[0].diffuse = shade_v3(0, 0, 0);
}
MISTAKE(highlights_alone_on_a_matte_material, BALL, "state.material")
{
    for (int i = 0; i < 2; i++) s->lamps[i].diffuse = shade_v3(0, 0, 0);
    s->material.specular = shade_v3(0, 0, 0);
}
/* The light is missed first, and the map once there is light. */
MISTAKE(map_black_and_lamp_behind, BALL, "behind")
{
    mistake_map_black(s);
    mistake_lamp_behind(s);
}
MISTAKE(many_cones_elsewhere, BALL, "spot_direction")
{
    enum { COUNT = 17 };    /* one more than shade_explain tries without their cone */
    static shade_light many[COUNT];
    mistake_cone_toward_the_eye(s);
    for (int i = 0; i < COUNT; i++) many[i] = s->lamps[0];
    s->state.lighting.lights = many;
    s->state.lighting.light_count = COUNT;
}

/* What a mistake is under every blend. */
MISTAKE(no_light_over, BALL, "no light")
{
    s->state.raster.blend = SHADE_BLEND_OVER;
    mistake_no_light(s);
}
MISTAKE(no_light_added, BALL, "no light")
{
    s->state.raster.blend = SHADE_BLEND_ADD;
    mistake_no_light(s);
}
MISTAKE(overlay_without_light, BALL, "no light")
{
    s->state.material = NULL;
    s->state.transparency = 0.5f;
    s->target.depth = NULL;
    s->state.raster.cull = SHADE_CULL_BACK;
    mistake_no_light_over(s);
}
MISTAKE(material_zero_added, BALL, "state.material")
{
    s->state.raster.blend = SHADE_BLEND_ADD;
    mistake_material_never_filled(s);
}
MISTAKE(lamp_behind_over, BALL, "behind")
{
    s->state.raster.blend = SHADE_BLEND_OVER;
    mistake_lamp_behind(s);
}
MISTAKE(almost_invisible, BALL, "transparency")
{
    s->state.transparency = 0.9999f;
    s->state.raster.blend = SHADE_BLEND_OVER;
}

static inline void stage_ambient(stage *s)
{
    s->state.lighting.ambient = shade_v3(0.3f, 0.3f, 0.3f);
}
MISTAKE(ambient_and_lamp_behind, BALL, "")
{
    stage_ambient(s);
    mistake_lamp_behind(s);
}
MISTAKE(ambient_and_no_lamps, BALL, "Only ambient light")
{
    stage_ambient(s);
    mistake_no_light(s);
}
MISTAKE(ambient_and_light_count_forgotten, BALL, "light_count")
{
    stage_ambient(s);
    mistake_light_count_forgotten(s);
}
MISTAKE(ambient_and_normals_zero, BALL, "mesh.normals are zero|mesh.normals hold")
{
    stage_ambient(s);
    mistake_normals_never_filled(s);
}
MISTAKE(ambient_and_normals_nan, BALL, "mesh.normals are zero|mesh.normals hold")
{
    stage_ambient(s);
    for (int i = 0; i < STAGE_VERTICES; i++) s->normal[i].x = NAN;
}
MISTAKE(bad_map_without_texcoords, BALL, "pixels are NULL")
{
    s->map.pixels = NULL;
    mistake_map_without_texcoords(s);
}
MISTAKE(mipmap_count_without_mipmaps, BALL, "no mipmaps") { stage_map(s)->mipmap_count = 1; }
MISTAKE(mipmaps_not_counted, BALL, "no mipmaps")
{
    mistake_trilinear_without_mipmaps(s);
    s->map.mipmaps = &s->map;
}
/* Its last column, (0, 0, 1, 0), is also that of a transposed matrix. */
MISTAKE(reversed_beside, BALL, "beside")
{
    mistake_model_moved_away(s);
    stage_reverse(s, 1);
}
/* Everything has z = near > w: behind the eye, w < 0, or before the near plane. */
MISTAKE(reversed_looks_away, BALL, "behind the eye")
{
    mistake_looks_the_other_way(s);
    stage_reverse(s, 1);
}
MISTAKE(reversed_before_near, BALL, "nearer than the near") { stage_reverse(s, 50); }
MISTAKE(reversed_beyond_far, BALL, "beyond the far plane")
{
    s->state.projection = shade_mat4_perspective(0.8f, 1.5f, 2, 0.1f);
    s->state.raster.depth_test = SHADE_COMPARE_GREATER;
    s->clear = 0;
}
/* as they are where shade_mesh_chunks had too little room */
MISTAKE(aspect_of_a_square, BALL, "aspect")
{
    s->state.projection = shade_mat4_perspective(0.8f, 1, 0.1f, 100);
}
MISTAKE(aspect_a_little_wide, BALL, "aspect")
{
    s->state.projection = shade_mat4_perspective(0.8f, 1.56f, 0.1f, 100);
}
MISTAKE(view_that_shears, BALL, "state.view scales or shears") { s->state.view.col[1].x += 0.4f; }
MISTAKE(beside_the_clip_rectangle, BALL, "beside the clip rectangle")
{
    s->target.clip_x = s->target.clip_y = 2;
    s->target.clip_width = s->target.clip_height = 9;
}

/* What sentences were false of: the words are those of the true cause. */
MISTAKE(attenuation_of_far_lamps, BALL, "Attenuation")
{
    s->lamps[0] = shade_point_light(shade_v3(0, 7, 27), shade_v3(1, 1, 1));
    s->lamps[0].quadratic = 1;
    s->state.lighting.light_count = 1;
}
MISTAKE(attenuation_of_far_lamps_with_a_map, BALL, "Attenuation")
{
    mistake_attenuation_of_far_lamps(s);
    stage_map(s);
    for (int k = 0; k < 16; k++) s->texel[k] = 140;
}
/* corners right of the picture, below it and far beyond: outside, but of no plane with all three */
MISTAKE(around_a_corner_of_the_picture, BALL, "No pixel centre")
{
    stage_two_triangles(s, shade_v3(0, 0, 0), shade_v3(0, 0, 0));
    s->position[0] = shade_v3(5.4f, 0, -4);
    s->position[1] = shade_v3(0, 4.2f, -4);
    s->position[2] = shade_v3(5.4f, 4.2f, -4);
    s->mesh.index_count = 3;
}
MISTAKE_IN(lamp_negative, lamp_negative_of_the_ball, BALL, "negative colour")
MISTAKE_IN(all_in_model, all_in_model_of_the_ball, BALL, "state.model holds a projection")

#endif
