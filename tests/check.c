/* check.c - what is wrong with a call: of several faults the first category is told, in the order
   NULLs, target, mesh, state, lights, texture, indices, room; nothing is written. */

typedef struct whole_call { /* all that any call is given, good until it is spoilt */
    canvas c;
    shade_target picture, half; /* c's; and one of half its size to resolve into */
    shade_mesh m;
    shade_draw_state s;
    shade_pipeline p;
    shade_line_state l;
    shade_texture map;
    shade_chunk chunk;
    scene vertices;
    shade_vec4 clip[6];
    float positions[18], crease;
    uint32_t indices[6];
    int index_count, vertex_count, point_count, factor, capacity;
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
    shade_stats stats;
} whole_call;

static struct { /* what calls may write */
    shade_vec3 normals[6];
    shade_edge edges[6];
    shade_texture levels[4];
    uint32_t memory[64], written, half[25];
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
}

/* Calls by letter: Draw, Mesh, Lines, Normals, Corner normals, Edges, mipmaps X, Resolve, Ppm,
   clear K. */
static const char whole_calls[] = "DMLNCEXRPK";

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
    case 'C':
        return shade_mesh_corner_normals(w->mesh, w->crease, w->normals, w->memory, w->bytes);
    case 'E': return shade_mesh_edges(w->mesh, w->edges, w->capacity, &count);
    case 'X': return shade_build_mipmaps(w->texture, w->levels, w->memory, w->bytes);
    case 'R': return shade_resolve(&w->half, w->target, w->factor);
    case 'P': return shade_encode_ppm(w->sink, NULL, w->target);
    default: return shade_clear(w->target, shade_v4(1, 1, 1, 1), 1);
    }
}

/* Fault k: the calls that it is one of, and what they say; by rising category.  One that is made
   after another of a later category does not take that back. */
static const struct {
    const char *calls;
    shade_result result;
} whole_faults[] = {
    { "DMLRPK", SHADE_ERROR_ARGUMENT }, { "D", SHADE_ERROR_ARGUMENT },
    { "D", SHADE_ERROR_ARGUMENT },      { "MNCE", SHADE_ERROR_ARGUMENT },
    { "M", SHADE_ERROR_ARGUMENT },      { "L", SHADE_ERROR_ARGUMENT },
    { "L", SHADE_ERROR_ARGUMENT },      { "NC", SHADE_ERROR_ARGUMENT },
    { "CX", SHADE_ERROR_ARGUMENT },     { "E", SHADE_ERROR_ARGUMENT },
    { "X", SHADE_ERROR_ARGUMENT },      { "X", SHADE_ERROR_ARGUMENT },
    { "P", SHADE_ERROR_ARGUMENT },
    { "DMLRPK", SHADE_ERROR_TARGET },   { "DMLRPK", SHADE_ERROR_TARGET },
    { "DMLRPK", SHADE_ERROR_TARGET },   { "DMLRPK", SHADE_ERROR_TARGET },
    { "DMLRPK", SHADE_ERROR_TARGET },   { "RP", SHADE_ERROR_TARGET },
    { "R", SHADE_ERROR_TARGET },
    { "D", SHADE_ERROR_MESH },          { "D", SHADE_ERROR_MESH },
    { "L", SHADE_ERROR_MESH },          { "L", SHADE_ERROR_MESH },
    { "MNCE", SHADE_ERROR_MESH },       { "MNCE", SHADE_ERROR_MESH },
    { "MNCE", SHADE_ERROR_MESH },       { "MNCE", SHADE_ERROR_MESH },
    { "MNCE", SHADE_ERROR_MESH },       { "MNCE", SHADE_ERROR_MESH },
    { "MNCE", SHADE_ERROR_MESH },       { "MNCE", SHADE_ERROR_MESH },
    { "DML", SHADE_ERROR_STATE },       { "DM", SHADE_ERROR_STATE },
    { "D", SHADE_ERROR_STATE },         { "D", SHADE_ERROR_STATE },
    { "M", SHADE_ERROR_STATE },         { "M", SHADE_ERROR_STATE },
    { "M", SHADE_ERROR_STATE },         { "M", SHADE_ERROR_STATE },
    { "L", SHADE_ERROR_STATE },         { "L", SHADE_ERROR_STATE },
    { "C", SHADE_ERROR_STATE },
    { "M", SHADE_ERROR_LIGHTS },        { "M", SHADE_ERROR_LIGHTS },
    { "DMX", SHADE_ERROR_TEXTURE },     { "DMX", SHADE_ERROR_TEXTURE },
    { "D", SHADE_ERROR_TEXTURE },
    { "DMNCE", SHADE_ERROR_INDEX },     { "DMNCE", SHADE_ERROR_INDEX },
    { "CX", SHADE_ERROR_CAPACITY },     { "E", SHADE_ERROR_CAPACITY },
};
enum { WHOLE_FAULTS = sizeof whole_faults / sizeof whole_faults[0] };

static void whole_spoil_pointers(whole_call *w, int fault)
{
    switch (fault) {
    case 0: w->target = NULL; break;
    case 1: w->pipeline = NULL; break;
    case 2: w->p.vertex = NULL; break;
    case 3: w->mesh = NULL; break;
    case 4: w->state = NULL; break;
    case 5: w->lines = NULL; break;
    case 6:
        w->points = NULL;
        w->point_count = 4;
        break;
    case 7: w->normals = NULL; break;
    case 8: w->memory = NULL; break;
    case 9:
        w->edges = NULL;
        w->capacity = 6;
        break;
    case 10: w->texture = NULL; break;
    case 11: w->levels = NULL; break;
    default: w->sink = NULL; break;
    }
}
static void whole_spoil(whole_call *w, int fault)
{
    switch (fault) {
    case 13: w->picture.width = 0; break;
    case 14: w->picture.stride = 9; break;
    case 15: w->picture.format = SHADE_FORMAT_A8; break;
    case 16: w->picture.clip_width = -1; break;
    case 17: w->picture.row_offset = 1; break;
    case 18: w->picture.color = NULL; break;
    case 19: w->half.format = (shade_format)-1; break;
    case 20: w->index_count = -3; break;
    case 21: w->vertex_count = -1; break;
    case 22: w->point_count = 3; break;
    case 23: w->point_count = -2; break;
    case 24: w->m.positions = NULL; break;
    case 25: w->m.vertex_count = -1; break;
    case 26: w->m.index_count = -3; break;
    case 27: w->m.position_stride = -12; break;
    case 28: w->m.color_stride = 6; break;
    case 29: w->m.chunk_count = 1; break;
    case 30: w->m.chunk_count = -1; break;
    case 31:
        w->m.chunks = &w->chunk;
        w->m.chunk_count = 1;
        w->chunk.first = 1;
        break;
    case 32: w->p.raster.blend = w->s.raster.blend = w->l.raster.blend = (shade_blend)3; break;
    case 33: w->p.raster.cull = w->s.raster.cull = (shade_cull)-1; break;
    case 34: w->p.varyings = SHADE_MAX_VARYINGS + 1; break;
    case 35: w->p.interpolation = (shade_interpolation)3; break;
    case 36: w->s.shading = (shade_shading)3; break;
    case 37: w->s.transparency = 1.5f; break;
    case 38: w->s.alpha_cutoff = (float)NAN; break;
    case 39: w->s.fragment = scene_flat; break; /* lit per vertex */
    case 40: w->l.width = -1; break;
    case 41: w->l.cap = (shade_cap)2; break;
    case 42: w->crease = (float)NAN; break;
    case 43: w->s.lighting.light_count = 1; break;
    case 44: w->s.lighting.model = (shade_model)6; break;
    case 45: w->map.pixels = NULL; break;
    case 46: w->map.filter = (shade_filter)3; break;
    case 47: w->p.lod_varying = 1; break;
    case 48: w->indices[5] = 6; break;
    case 49: w->index_count = w->m.index_count = 4; break;
    case 50: w->bytes = 4; break;
    case 51: w->capacity = 5; break;
    default: whole_spoil_pointers(w, fault); break;
    }
}
/* w has these faults, a <= b, or none; nothing has changed where one is told */
static void check_whole(char call, int a, int b)
{
    whole_call w;
    shade_result want = a < WHOLE_FAULTS ? whole_faults[a].result : SHADE_OK, got;
    whole_open(&w);
    if (b < WHOLE_FAULTS) whole_spoil(&w, b);
    if (a < WHOLE_FAULTS) whole_spoil(&w, a);
    got = whole_result(&w, call);
    CHECK_SAY(got == want, "call %c, faults %d and %d: got %d, want %d", call, a, b, (int)got,
              (int)want);
    if (strchr("DML", call))
        CHECK_INT(w.stats.triangles, want != SHADE_OK ? 0 : call == 'L' ? 4 : 2);
    for (size_t i = CANVAS_GUARD; want != SHADE_OK && i < CANVAS_GUARD + w.c.color_bytes; i++)
        CHECK(w.c.color[i] == CANVAS_BYTE && w.c.depth[i] == CANVAS_BYTE);
    for (size_t i = 0; want != SHADE_OK && i < sizeof whole_out; i++)
        CHECK(((const unsigned char *)&whole_out)[i] == CANVAS_BYTE);
    canvas_close(&w.c);
}
TEST(check, of_any_two_faults_the_first_category_is_told)
{
    if (SHADE_MAX_VARYINGS < 8) {
        test_skip("a map takes 8 varyings");
        return;
    }
    for (const char *call = whole_calls; *call; call++) {
        check_whole(*call, WHOLE_FAULTS, WHOLE_FAULTS);
        for (int a = 0; a < WHOLE_FAULTS; a++)
            for (int b = a; b < WHOLE_FAULTS; b++)
                if (strchr(whole_faults[a].calls, *call) && strchr(whole_faults[b].calls, *call))
                    check_whole(*call, a, b);
    }
}
/* What only fits or does not, beside what is given: a NaN depth, a factor, an odd address. */
TEST(check, sizes_that_do_not_fit_are_arguments_behind_good_targets)
{
    whole_call w;
    whole_open(&w);
    CHECK_INT(shade_clear(&w.picture, shade_v4(1, 1, 1, 1), (float)NAN), SHADE_ERROR_ARGUMENT);
    CHECK_INT(shade_resolve(&w.half, &w.picture, 3), SHADE_ERROR_ARGUMENT);
    CHECK_INT(shade_mesh_edges(&w.m, w.edges, -1, &w.factor), SHADE_ERROR_ARGUMENT);
    w.picture.width = 0;
    CHECK_INT(shade_clear(&w.picture, shade_v4(1, 1, 1, 1), (float)NAN), SHADE_ERROR_TARGET);
    CHECK_INT(shade_resolve(&w.half, &w.picture, 3), SHADE_ERROR_TARGET);
    for (size_t i = 0; i < w.c.color_bytes; i++) CHECK(w.c.color[CANVAS_GUARD + i] == CANVAS_BYTE);
    canvas_close(&w.c);
}

/* Not as a format of colours, nor where there are none. */
TEST(check, alpha_alone_is_no_format_of_a_target)
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
    CHECK_INT(shade_write_ppm("none.ppm", &w.half), SHADE_ERROR_TARGET);
    canvas_close(&w.c);
}

TEST(check, every_result_names_its_fields_in_a_text_of_its_own)
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

static const test_case check_cases[] = {
    CASE(check, of_any_two_faults_the_first_category_is_told),
    CASE(check, sizes_that_do_not_fit_are_arguments_behind_good_targets),
    CASE(check, alpha_alone_is_no_format_of_a_target),
    CASE(check, every_result_names_its_fields_in_a_text_of_its_own),
};
