/* refusals.c - what is wrong with a call: of several faults the first category is told, in the
   order NULLs, target, mesh, state, lights, texture, indices, room; nothing is written. */
#include "unit.h"

typedef struct whole_call { /* all that any call is given, good until it is spoilt */
    canvas c;
    shade_target picture, half; /* c's; and one of half its size to resolve into */
    shade_mesh m;
    shade_draw_state s;
    shade_pipeline p;
    shade_line_state l;
    shade_texture map;
    shade_chunk chunk;
    shade_light lamp;
    scene vertices;
    shade_vec4 clip[6];
    float positions[18], crease;
    uint32_t indices[6];
    uint16_t indices16[6];
    int index_count, vertex_count, point_count, factor, capacity, triangles;
    size_t bytes;
    const shade_target *target;
    const shade_mesh *mesh;
    const shade_draw_state *state;
    const shade_pipeline *pipeline;
    const shade_line_state *lines;
    const shade_vec3 *points;
    shade_texture *texture, *levels;
    void *memory;
    shade_write_fn *sink;
    shade_vec3 *normals;
    shade_edge *edges;
    shade_chunk *chunks;
    shade_stats stats;
} whole_call;

static struct { /* what calls may write */
    shade_vec3 normals[6];
    shade_edge edges[6];
    shade_chunk chunks[6];
    shade_texture levels[4];
    uint32_t memory[64], written, half[25], order[6];
} whole_out;

static int whole_sink(void *user, const void *bytes, size_t size)
{
    (void)user;
    (void)bytes;
    (void)size;
    whole_out.written = 1;
    return 0;
}

static void whole_open(whole_call *w)
{
    static const uint32_t texels[16];
    memset(w, 0, sizeof *w);
    memset(&whole_out, CANVAS_BYTE, sizeof whole_out);
    memset(&w->stats, CANVAS_BYTE, sizeof w->stats);
    w->c = canvas_open(10, 10, 0, SHADE_FORMAT_RGBA8, 1);
    w->picture = w->half = w->c.target;
    w->half.width = w->half.height = 5;
    w->half.color = whole_out.half;
    w->half.depth = NULL;
    for (int k = 0; k < 6; k++) {
        w->clip[k] = clip_corners[k % 3];
        w->indices[k] = (uint32_t)k;
        put3(w->positions + 3 * k, shade_v3(w->clip[k].x, w->clip[k].y, w->clip[k].z));
    }
    w->map.pixels = texels;
    w->map.width = w->map.height = 4;
    w->m.positions = w->m.texcoords = w->positions;
    w->m.vertex_count = 6;
    w->m.indices = w->indices;
    w->m.index_count = 6;
    w->chunk.count = 2;
    w->s.shading = SHADE_SHADING_PER_VERTEX;
    w->s.diffuse_map = &w->map;
    w->vertices.clip = w->clip;
    w->p = scene_pipeline(&w->vertices);
    w->p.varyings = 2;
    w->p.lod_texture = &w->map;
    w->vertices.attribute = w->positions;
    w->vertices.varyings = 2;
    w->index_count = w->vertex_count = 6;
    w->point_count = 4;
    w->factor = 2;
    w->capacity = 6;
    w->triangles = 1;
    w->bytes = sizeof whole_out.memory;
    w->target = &w->picture;
    w->mesh = &w->m;
    w->state = &w->s;
    w->pipeline = &w->p;
    w->lines = &w->l;
    w->points = (const shade_vec3 *)(const void *)w->positions;
    w->texture = &w->map;
    w->levels = whole_out.levels;
    w->memory = whole_out.memory;
    w->sink = whole_sink;
    w->normals = whole_out.normals;
    w->edges = whole_out.edges;
    w->chunks = whole_out.chunks;
}

/* Calls by letter: Draw, Mesh, Lines, Normals, Corner normals, Edges, Boxes of chunks, mipmaps X,
   Resolve, Ppm, clear K. */
static const char whole_calls[] = "DMLNCEBXRPK";

static shade_result whole_result(whole_call *w, char call)
{
    int count;
    switch (call) {
    case 'D':
        return shade_draw(w->target, w->pipeline, w->indices, w->index_count, w->vertex_count,
                          &w->stats);
    case 'M': return shade_draw_mesh(w->target, w->mesh, w->state, &w->stats);
    case 'L': return shade_draw_lines(w->target, w->points, w->point_count, w->lines, &w->stats);
    case 'N': return shade_mesh_normals(w->mesh, w->normals);
    case 'C': return shade_mesh_corner_normals(w->mesh, w->crease, w->normals, w->memory, w->bytes);
    case 'E': return shade_mesh_edges(w->mesh, w->edges, w->capacity, &count);
    case 'B':
        return shade_mesh_chunks(w->mesh, w->triangles, w->chunks, w->capacity,
                                 whole_out.order);
    case 'X': return shade_build_mipmaps(w->texture, w->levels, w->memory, w->bytes);
    case 'R': return shade_resolve(&w->half, w->target, w->factor);
    case 'P': return shade_encode_ppm(w->sink, NULL, w->target);
    default: return shade_clear(w->target, shade_v4(1, 1, 1, 1), 1);
    }
}

/* Faults 0, 1, ... of a category: each is made and gives the calls that it is one of; NULL: there
   is none. */
static const char *fault_argument(whole_call *w, int k)
{
    switch (k) {
    case 0: w->target = NULL; return "DMLRPK";
    case 1: w->pipeline = NULL; return "D";
    case 2: w->p.vertex = NULL; return "D";
    case 3: w->mesh = NULL; return "MNCEB";
    case 4: w->state = NULL; return "M";
    case 5: w->lines = NULL; return "L";
    case 6:
        w->points = NULL;
        w->point_count = 4;
        return "L";
    case 7: w->normals = NULL; return "NC";
    case 8: w->memory = NULL; return "CX";
    case 9:
        w->edges = NULL;
        w->capacity = 6;
        return "E";
    case 10: w->texture = NULL; return "X";
    case 11: w->levels = NULL; return "X";
    case 12: w->sink = NULL; return "P";
    case 13: w->capacity = -1; return "EB";
    case 14: w->memory = (char *)whole_out.memory + 2; return "CX";
    case 15:
        w->chunks = NULL;
        w->capacity = 6;
        return "B";
    case 16: w->triangles = -1; return "B";
    default: return NULL;
    }
}

static const char *fault_target(whole_call *w, int k)
{
    switch (k) {
    case 0: w->picture.width = 0; return "DMLRPK";
    case 1: w->picture.stride = 9; return "DMLRPK";
    case 2: w->picture.format = SHADE_FORMAT_A8; return "DMLRPK";
    case 3: w->picture.clip_width = -1; return "DMLRPK";
    case 4: w->picture.row_offset = 1; return "DMLRPK";
    case 5: w->picture.color = NULL; return "RP";
    case 6: w->half.format = (shade_format)-1; return "R";
    default: return NULL;
    }
}

static const char *fault_mesh(whole_call *w, int k)
{
    switch (k) {
    case 0: w->index_count = -3; return "D";
    case 1: w->vertex_count = -1; return "D";
    case 2: w->point_count = 3; return "L";
    case 3: w->point_count = -2; return "L";
    case 4: w->m.positions = NULL; return "MNCEB";
    case 5: w->m.vertex_count = -1; return "MNCEB";
    case 6: w->m.index_count = -3; return "MNCEB";
    case 7: w->m.position_stride = -12; return "MNCEB";
    case 8: w->m.color_stride = 6; return "MNCEB";
    case 9: w->m.chunk_count = 1; return "MNCE";
    case 10: w->m.chunk_count = -1; return "MNCE";
    case 11:
        w->m.chunks = &w->chunk;
        w->m.chunk_count = 1;
        w->chunk.first = 1;
        return "MNCE";
    case 12: w->m.indices16 = w->indices16; return "MNCEB";
    default: return NULL;
    }
}

static const char *fault_state(whole_call *w, int k)
{
    switch (k) {
    case 0:
        w->p.raster.blend = w->s.raster.blend = w->l.raster.blend = (shade_blend)3;
        return "DML";
    case 1: w->p.raster.cull = w->s.raster.cull = (shade_cull)-1; return "DM";
    case 2: w->p.varyings = SHADE_MAX_VARYINGS + 1; return "D";
    case 3: w->p.interpolation = (shade_interpolation)3; return "D";
    case 4: w->s.shading = (shade_shading)3; return "M";
    case 5: w->s.transparency = 1.5f; return "M";
    case 6: w->s.alpha_cutoff = (float)NAN; return "M";
    case 7: w->s.fragment = scene_flat; return "M";
    case 8: w->l.width = -1; return "L";
    case 9: w->l.cap = (shade_cap)2; return "L";
    case 10: w->crease = (float)NAN; return "C";
    default: return NULL;
    }
}

static const char *fault_lights(whole_call *w, int k)
{
    switch (k) {
    case 0: w->s.lighting.light_count = 1; return "M";
    case 1: w->s.lighting.model = (shade_model)6; return "M";
    case 2:
        w->lamp = shade_spot_light(w->lamp.diffuse, w->lamp.diffuse, 45, 0, w->lamp.diffuse);
        w->s.lighting.lights = &w->lamp;
        w->s.lighting.light_count = 1;
        return "M";
    default: return NULL;
    }
}

static const char *fault_texture(whole_call *w, int k)
{
    switch (k) {
    case 0: w->map.pixels = NULL; return "DMX";
    case 1: w->map.filter = (shade_filter)3; return "DMX";
    case 2: w->p.lod_varying = 1; return "D";
    default: return NULL;
    }
}

static const char *fault_index(whole_call *w, int k)
{
    switch (k) {
    case 0: w->indices[5] = 6; return "DMNCEB";
    case 1: w->index_count = w->m.index_count = 4; return "DMNCEB";
    default: return NULL;
    }
}

static const char *fault_capacity(whole_call *w, int k)
{
    switch (k) {
    case 0: w->bytes = 4; return "CX";
    case 1: w->capacity = 5; return "E";
    case 2: w->capacity = 1; return "B";
    default: return NULL;
    }
}

typedef struct call_fault { /* of a category and a number */
    const char *(*spoil)(whole_call *, int);
    shade_result result;
    int number;
} call_fault;
static const call_fault categories[] = {
    { fault_argument, SHADE_ERROR_ARGUMENT, 0 }, { fault_target, SHADE_ERROR_TARGET, 0 },
    { fault_mesh, SHADE_ERROR_MESH, 0 },         { fault_state, SHADE_ERROR_STATE, 0 },
    { fault_lights, SHADE_ERROR_LIGHTS, 0 },     { fault_texture, SHADE_ERROR_TEXTURE, 0 },
    { fault_index, SHADE_ERROR_INDEX, 0 },       { fault_capacity, SHADE_ERROR_CAPACITY, 0 },
};
enum { CATEGORIES = sizeof categories / sizeof categories[0], MOST_FAULTS = 64 };

/* The faults that a call can have, by rising category; returns how many. */
static int faults_of(char call, call_fault *list)
{
    int count = 0;
    for (int k = 0; k < CATEGORIES; k++) {
        whole_call w;
        call_fault f = categories[k];
        whole_open(&w);
        for (const char *calls; (calls = f.spoil(&w, f.number)) != NULL; f.number++)
            if (strchr(calls, call)) list[count++] = f;
        canvas_close(&w.c);
    }
    return count;
}

/* A call with two faults, which may be one, the later category made first, so that it cannot mend
   the other; or with none, NULL.  Where one is told nothing has changed. */
static void check_whole(char call, const call_fault *first, const call_fault *second)
{
    whole_call w;
    const shade_result want = first ? first->result : SHADE_OK;
    whole_open(&w);
    if (second) second->spoil(&w, second->number);
    if (first) first->spoil(&w, first->number);
    shade_result got = whole_result(&w, call);
    CHECK_SAY(got == want, "call %c, fault %d: got %d, want %d; and fault %d of %d", call,
              first ? first->number : -1, (int)got, (int)want, second ? second->number : -1,
              second ? (int)second->result : 0);
    if (strchr("DML", call))
        CHECK_INT(w.stats.triangles, want != SHADE_OK ? 0 : call == 'L' ? 4 : 2);
    for (size_t i = CANVAS_GUARD; want != SHADE_OK && i < CANVAS_GUARD + w.c.color_bytes; i++)
        CHECK(w.c.color[i] == CANVAS_BYTE && w.c.depth[i] == CANVAS_BYTE);
    for (size_t i = 0; want != SHADE_OK && i < sizeof whole_out; i++)
        CHECK(((const unsigned char *)&whole_out)[i] == CANVAS_BYTE);
    canvas_close(&w.c);
}

/* G2 */
TEST(refusals, of_any_two_faults_the_first_category_is_told)
{
    call_fault list[MOST_FAULTS];
    int pairs = 0;
    if (SHADE_MAX_VARYINGS < 8) {
        test_skip("a map takes 8 varyings");
        return;
    }
    for (const char *call = whole_calls; *call; call++) {
        const int count = faults_of(*call, list);
        check_whole(*call, NULL, NULL);
        for (int i = 0; i < count; i++)
            for (int k = i; k < count; k++, pairs++) check_whole(*call, &list[i], &list[k]);
    }
    CHECK_SAY(pairs > 900, "%d pairs", pairs);
}

/* a NaN depth, a factor */
TEST(refusals, sizes_that_do_not_fit_are_arguments_behind_good_targets)
{
    whole_call w;
    whole_open(&w);
    CHECK_INT(shade_clear(&w.picture, shade_v4(1, 1, 1, 1), (float)NAN), SHADE_ERROR_ARGUMENT);
    CHECK_INT(shade_resolve(&w.half, &w.picture, 3), SHADE_ERROR_ARGUMENT);
    w.picture.width = 0;
    CHECK_INT(shade_clear(&w.picture, shade_v4(1, 1, 1, 1), (float)NAN), SHADE_ERROR_TARGET);
    CHECK_INT(shade_resolve(&w.half, &w.picture, 3), SHADE_ERROR_TARGET);
    for (size_t i = 0; i < w.c.color_bytes; i++) CHECK(w.c.color[CANVAS_GUARD + i] == CANVAS_BYTE);
    canvas_close(&w.c);
}

/* Not as a format of colours, nor where there are none. */
TEST(refusals, alpha_alone_is_no_format_of_a_target)
{
    for (const char *call = "DMLKRPDMLK"; *call; call++) {
        whole_call w;
        whole_open(&w);
        w.picture.format = SHADE_FORMAT_A8;
        if (strlen(call) <= 4) w.picture.color = NULL; /* depth alone */
        if (SHADE_MAX_VARYINGS < 8) w.s.diffuse_map = NULL;
        CHECK_INT(whole_result(&w, *call), SHADE_ERROR_TARGET);
        for (size_t i = CANVAS_GUARD; i < CANVAS_GUARD + w.c.color_bytes; i++)
            CHECK(w.c.color[i] == CANVAS_BYTE && w.c.depth[i] == CANVAS_BYTE);
        canvas_close(&w.c);
    }
    whole_call w;
    whole_open(&w);
    w.half.format = SHADE_FORMAT_A8;
    CHECK_INT(shade_resolve(&w.half, &w.picture, 2), SHADE_ERROR_TARGET);
#ifndef SHADE_NO_STDIO
    CHECK_INT(shade_write_ppm("none.ppm", &w.half), SHADE_ERROR_TARGET);
#endif
    canvas_close(&w.c);
}

TEST(refusals, every_result_names_its_fields_in_a_text_of_its_own)
{
    static const char *const names[][11] = {
        { "no error" },
        { "NULL", "factor" },
        { "width", "height", "stride", "format", "color", "depth", "clip_width", "clip_height",
          "row_offset", "row_count" },
        { "positions", "count", "stride", "chunks" },
        { "enumerator", "transparency", "alpha_cutoff", "depth_bias", "width", "varyings",
          "cos_crease", "fragment" },
        { "lights", "light_count", "model" },
        { "pixels", "width", "height", "stride", "format", "wrap", "filter", "lod_varying" },
        { "vertex_count", "triangles" },
        { "room" },
        { "writing" },
    };
    enum { RESULTS = sizeof names / sizeof names[0] };
    CHECK_INT(RESULTS, SHADE_ERROR_IO + 1);
    for (int k = 0; k < RESULTS; k++) {
        const char *text = shade_result_string((shade_result)k);
        for (int n = 0; names[k][n]; n++)
            CHECK_SAY(strstr(text, names[k][n]), "\"%s\" does not name %s", text, names[k][n]);
        for (int j = 0; j < k; j++) CHECK(strcmp(text, shade_result_string((shade_result)j)) != 0);
    }
    static const int unknown[] = { -1, RESULTS, 1000, INT32_MAX, INT32_MIN };
    for (int k = 0; k < 5; k++) {
        const char *text = shade_result_string((shade_result)unknown[k]);
        CHECK(text && text[0] && strcmp(text, shade_result_string(SHADE_OK)) != 0);
    }
}
