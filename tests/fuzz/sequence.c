/* sequence.c - calls one after the other over the same targets, mesh, textures and states: draws,
   clears, resolving, mipmaps, files, what a mesh knows of its shape, rays, light, explanations, and
   changes of arguments between them.

   After each step only what its call writes has changed, nothing at all where it was refused.  The
   steps are then done again in another vector width, with calls between that only read, and one of
   them alone, from the memory it began with: everything comes out the same, to the bit. */
#include "scene.h"
#include <math.h>

enum { STEPS = 12, STEP_BYTES = 16, VERTICES = 24, TRIANGLES = 16, POINTS = 8, SCOPES = 4 };

typedef struct world {                   /* all arguments; what they point at is between guards */
    picture pic[2];                      /* the second is factor times as large */
    int factor;
    mesh_scene s;
    shade_texture own;                   /* the map that the scene was made with */
    const float *normals_given;
    int vertices, listed, corners;       /* vertices, indices, the more of both in memory */
    shade_pipeline pipeline;
    shade_mat4 clip_from_object;
    shade_line_state line;
    int scope[2][SCOPES][4], scopes[2];  /* clip rectangles around that of a target */
    int chunk_count;
    int kept;                            /* is there something to go back to? */
    shade_chunk *chunks;
    shade_vec3 *normals, *corner_normals, *points;
    uint32_t *sorted;
    shade_edge *edges;
    uint8_t *scratch, *mipmaps, *file;
    size_t scratch_bytes, mipmap_bytes, file_bytes;
} world;

typedef struct outcome {                 /* of a step; what is not set is 0 */
    shade_result result;
    int number[4];
    shade_stats stats;
    float value[4 * SHADE_LANES];
    const char *said;
    const void *writes[3];               /* memory that may have changed */
    const picture *drawn;                /* in its clip rectangle alone */
    int changes;                         /* the arguments may have changed */
} outcome;

typedef void call(fuzz_input *in, outcome *o);

static world w;
static float most;                       /* bound of all numbers; 0: none */
static uint8_t *kept_by_user;
static uint64_t hash_by_user, hashes[GUARD_BLOCKS + 1];    /* of memory, the last of w */

/* ---- memory --------------------------------------------------------------------------------- */

static size_t keep_bytes(void)
{
    size_t bytes = sizeof w;
    for (int k = 0; k < guard_count; k++)
        if (!guard_blocks[k].seal) bytes += guard_blocks[k].size;
    return bytes;
}

/* A NaN among floats counts as any NaN. */
static uint64_t hash_of(const guard *g)
{
    uint64_t h = 1;
    int floats = 0;
    for (int k = 0; k < 2; k++)
        floats |= g->at == w.pic[k].color && w.pic[k].target.format == SHADE_FORMAT_RGBA32F;
    if (!floats) return guard_hash(g->at, g->size);
    for (size_t i = 0; i + 4 <= g->size; i += 4) {
        uint32_t bits;
        memcpy(&bits, g->at + i, 4);
        if ((bits & 0x7FFFFFFF) > 0x7F800000) bits = 0x7FC00000;
        h = (h ^ bits) * 1099511628211u;
    }
    return h;
}

static void hashes_of(void)
{
    hashes[GUARD_BLOCKS] = guard_hash((const uint8_t *)&w, sizeof w);
    for (int k = 0; k < guard_count; k++)
        hashes[k] = guard_blocks[k].seal ? 0 : hash_of(&guard_blocks[k]);
}

/* All that is not input, to (back: from) a copy. */
static void keep(uint8_t *copy, int back)
{
    if (back) memcpy(&w, copy, sizeof w);
    else memcpy(copy, &w, sizeof w);
    copy += sizeof w;
    for (int k = 0; k < guard_count; k++) {
        const guard *g = &guard_blocks[k];
        if (g->seal || !g->size) continue;
        if (back) memcpy(g->at, copy, g->size);
        else memcpy(copy, g->at, g->size);
        copy += g->size;
    }
    hashes_of();
}

/* ---- calls that draw, or write otherwise ---------------------------------------------------- */

static picture *drawn(fuzz_input *in, outcome *o)
{
    picture *p = &w.pic[fuzz_byte(in) % 2];
    if (p->color) memcpy(p->before, p->color, p->color_bytes);
    if (p->depth) memcpy(p->before + p->color_bytes, p->depth, p->depth_bytes);
    o->writes[0] = p->target.color;
    o->writes[1] = p->target.depth;
    o->drawn = p;
    return p;
}

static void counted(outcome *o, const picture *p, const shade_raster *r, long long triangles)
{
    if (r->depth_read_only) o->writes[1] = NULL;
    if (o->result != SHADE_OK) {
        HOLDS(!o->stats.triangles && !o->stats.drawn && !o->stats.fragments);
        return;
    }
    picture_stats(&o->stats, triangles);
    HOLDS(o->stats.fragments <= o->stats.drawn * p->target.width * p->target.height);
}

static void do_clear(fuzz_input *in, outcome *o)
{
    const picture *p = drawn(in, o);
    const shade_vec4 color = fuzz_vec4(in, most);
    const uint32_t kind = fuzz_byte(in);
    const float depth = (float)fuzz_byte(in) / 255;
    o->result = shade_clear(&p->target, color, kind & 1 ? depth : kind & 2 ? NAN : 1);
}

static long long triangles_listed(const shade_mesh *m)
{
    long long sum = 0;
    if (!m->chunks) return mesh_corners(m) / 3;
    for (int k = 0; k < m->chunk_count; k++) sum += m->chunks[k].count;
    return sum;
}

static void do_draw_mesh(fuzz_input *in, outcome *o)
{
    const picture *p = drawn(in, o);
    if (w.s.map.pixels == p->target.color) w.s.s.diffuse_map = NULL;    /* no map of itself */
    o->changes = w.s.map.pixels == p->target.color;
    o->result = shade_draw_mesh(&p->target, &w.s.m, &w.s.s, &o->stats);
    counted(o, p, &w.s.s.raster, triangles_listed(&w.s.m));
}

static void pipeline_vertex(const void *uniforms, const shade_vertex_ids *SHADE_RESTRICT in,
                            shade_vertices *SHADE_RESTRICT out)
{
    const shade_mesh *m = &w.s.m;
    const size_t step = m->position_stride ? (size_t)m->position_stride : 12;
    HOLDS(uniforms == &w && in->count >= 1 && in->count <= SHADE_LANES);
    for (int i = 0; i < SHADE_LANES; i++) {
        shade_vec4 p = { 0, 0, 0, 1 };
        HOLDS(in->index[i] < (uint32_t)m->vertex_count);
        memcpy(&p, (const char *)m->positions + step * in->index[i], 12);
        const shade_vec4 c = shade_mat4_transform(w.clip_from_object, p);
        for (int k = 0; k < 4; k++) {
            out->clip[k][i] = (&c.x)[k];
            out->varying[k][i] = (&p.x)[k];
        }
    }
}

static void pipeline_fragment(const void *uniforms, const shade_fragments *SHADE_RESTRICT in,
                              shade_colors *SHADE_RESTRICT out)
{
    HOLDS(uniforms == &w && in->count >= 1 && in->count <= SHADE_LANES);
    HOLDS(in->eye.x == 0 && in->eye.y == 0 && in->eye.z == 0);
    for (int i = 0; i < SHADE_LANES; i++) {
        for (int k = 0; k < 4 && k < w.pipeline.varyings; k++)
            out->color[k][i] = in->varying[k][i] + in->lod[i] / 8;
        out->discard[i] = in->primitive[i] % 4 == 3;
    }
}

static int pipeline_corners(void)
{
    return w.s.m.indices ? w.s.m.index_count : w.s.m.vertex_count;
}

static void do_draw(fuzz_input *in, outcome *o)
{
    const picture *p = drawn(in, o);
    o->result = shade_draw(&p->target, &w.pipeline, w.s.m.indices, pipeline_corners(),
                           w.s.m.vertex_count, &o->stats);
    counted(o, p, &w.pipeline.raster, pipeline_corners() / 3);
}

static void do_lines(fuzz_input *in, outcome *o)
{
    const picture *p = drawn(in, o);
    const int count = fuzz_int(in, -1, POINTS);
    o->result = shade_draw_lines(&p->target, w.points, count, &w.line, &o->stats);
    counted(o, p, &w.line.raster, count);
}

static void do_resolve(fuzz_input *in, outcome *o)
{
    const picture *p = drawn(in, o), *from = &w.pic[1 - (p - w.pic)];
    o->writes[1] = NULL;
    if (fuzz_byte(in) & 1) o->result = shade_resolve(&p->target, &p->target, 1);
    else o->result = shade_resolve(&p->target, &from->target, w.factor);
}

static void do_mipmaps(fuzz_input *in, outcome *o)
{
    const size_t bytes = w.mipmap_bytes - (fuzz_one_in(in, 8) && w.mipmap_bytes);
    o->writes[0] = w.mipmaps;
    o->changes = 1;                      /* of the map, and its levels */
    o->result = shade_build_mipmaps(&w.s.map, w.s.levels, w.mipmaps, bytes);
}

static void do_chunks(fuzz_input *in, outcome *o)
{
    const int triangles = fuzz_int(in, -1, 6), sort = fuzz_byte(in) & 1;
    shade_mesh m = w.s.m;
    m.chunks = NULL;                     /* may be the ones that are filled */
    o->number[0] = shade_chunk_count(mesh_corners(&m), triangles);
    o->writes[0] = w.chunks;
    if (sort && m.indices != w.sorted) o->writes[1] = w.sorted;
    o->result = shade_mesh_chunks(&m, triangles, w.chunks, fuzz_int(in, -1, TRIANGLES),
                                  o->writes[1] ? w.sorted : NULL);
    o->changes = o->result == SHADE_OK;
    if (o->changes) w.chunk_count = o->number[0];
}

static void do_normals(fuzz_input *in, outcome *o)
{
    (void)in;
    o->writes[0] = w.normals;
    o->result = shade_mesh_normals(&w.s.m, w.normals);
}

static void do_corner_normals(fuzz_input *in, outcome *o)
{
    const float crease = fuzz_float(in);
    const size_t bytes = w.scratch_bytes - (fuzz_one_in(in, 8) ? fuzz_byte(in) % 64 : 0);
    o->number[0] = (int)shade_mesh_corner_normals_bytes(&w.s.m);
    o->writes[0] = w.corner_normals;
    o->writes[1] = w.scratch;
    o->result = shade_mesh_corner_normals(&w.s.m, crease, w.corner_normals, w.scratch, bytes);
}

static void do_edges(fuzz_input *in, outcome *o)
{
    const int capacity = fuzz_one_in(in, 4) ? fuzz_int(in, -1, w.corners) : w.corners;
    o->writes[0] = w.edges;
    o->result = shade_mesh_edges(&w.s.m, w.edges, capacity, &o->number[0]);
}

typedef struct sink { size_t at, fails_at; } sink;
static int write_file(void *user, const void *bytes, size_t size)
{
    sink *s = (sink *)user;
    if (s->at + size > s->fails_at) return 1;
    memcpy(w.file + s->at, bytes, size);
    s->at += size;
    return 0;
}

static void do_file(fuzz_input *in, outcome *o)
{
    const uint32_t kind = fuzz_byte(in);
    const picture *p = &w.pic[kind % 2];
    sink s = { 0, w.file_bytes };
    if (fuzz_one_in(in, 4)) s.fails_at = fuzz_byte(in) % (w.file_bytes + 1);
    o->writes[0] = w.file;
    o->result = kind & 2 ? shade_encode_png(write_file, &s, &p->target)
                         : shade_encode_ppm(write_file, &s, &p->target);
    HOLDS(o->result == SHADE_OK || o->result == SHADE_ERROR_IO || !s.at);
    if (o->result == SHADE_ERROR_IO) o->result = SHADE_OK;    /* what came before it is there */
    o->number[0] = (int)s.at;
}

/* ---- calls that only read ------------------------------------------------------------------- */

static void do_explain(fuzz_input *in, outcome *o)
{
    const shade_target *t = &w.pic[fuzz_byte(in) % 2].target;
    const uint32_t kind = fuzz_byte(in);
    shade_stats stats;
    for (size_t k = 0; k < sizeof stats / 8; k++) ((long long *)&stats)[k] = fuzz_byte(in);
    const shade_stats *given = kind & 1 ? NULL : &stats;
    if (kind % 8 < 4) o->said = shade_explain(t, &w.s.m, &w.s.s, given);
    else if (kind & 2) o->said = shade_explain_lines(t, w.points, POINTS, &w.line, given);
    else o->said = shade_explain_draw(t, &w.pipeline, w.s.m.indices, pipeline_corners(),
                                      w.s.m.vertex_count, given);
    HOLDS(o->said);
}

static void do_sample(fuzz_input *in, outcome *o)
{
    float at[3][SHADE_LANES];
    for (int i = 0; i < SHADE_LANES; i++)
        for (int k = 0; k < 3; k++)
            at[k][i] = i % 4 ? at[k][i - 1] * 1.5f + 0.1f : fuzz_value(in, most);
    shade_sample_lanes(&w.s.map, at[0], at[1], at[2], o->value);
    const shade_vec4 c = shade_sample(&w.s.map, at[0][5], at[1][5], at[2][5]);
    for (int k = 0; k < 4; k++) HOLDS(fuzz_same((&c.x)[k], o->value[k * SHADE_LANES + 5]));
}

static void put(outcome *o, int at, shade_vec3 v)
{
    o->value[at] = v.x;
    o->value[at + 1] = v.y;
    o->value[at + 2] = v.z;
}

static void do_pick(fuzz_input *in, outcome *o)
{
    const shade_target *t = &w.pic[0].target;
    const float x = fuzz_value(in, most);
    const shade_ray ray = shade_pixel_ray(w.s.s.view, w.s.s.projection, t->width, t->height, x,
                                          fuzz_value(in, most));
    shade_vec3 place = shade_v3(0, 0, 0);
    o->number[0] = shade_pick(&w.s.m, w.s.s.model, ray, &o->value[0], &place);
    HOLDS(o->number[0] >= -1);
    put(o, 1, place);
    put(o, 4, ray.origin);
    put(o, 7, ray.direction);
}

static void do_bounds(fuzz_input *in, outcome *o)
{
    shade_vec3 low = fuzz_vec3(in, most), high = fuzz_vec3(in, most);
    if (fuzz_byte(in) & 1) o->number[3] = (int)shade_mesh_bounds(&w.s.m, &low, &high);
    put(o, 0, low);
    put(o, 3, high);
    o->number[0] = shade_box_visible(&w.pic[0].target, w.clip_from_object,
                                     w.s.s.raster.depth_zero_to_one, low, high);
    const shade_mat4 view = shade_mat4_fit(w.s.s.projection, low, high, fuzz_vec3(in, most),
                                           shade_v3(0, 1, 0));
    memcpy(o->value + 6, &view, sizeof view);
}

static void do_light(fuzz_input *in, outcome *o)
{
    float rows[6][SHADE_LANES];
    shade_rows of = { rows[0], rows[3], NULL, NULL, NULL };
    for (int i = 0; i < SHADE_LANES; i++)
        for (int k = 0; k < 6; k++)
            rows[k][i] = i % 4 ? rows[k][i - 1] * 0.75f + 0.1f : fuzz_value(in, most);
    const shade_vec3 eye = fuzz_vec3(in, most), at = shade_v3(rows[0][2], rows[1][2], rows[2][2]);
    shade_vec3 toward;
    shade_lit_lanes(&w.s.s.lighting, w.s.s.material, eye, &of, o->value);
    const shade_vec3 lit = shade_lit(&w.s.s.lighting, w.s.s.material, eye, at,
                                     shade_v3(rows[3][2], rows[4][2], rows[5][2]));
    for (int k = 0; k < 3; k++)
        HOLDS(fuzz_same((&lit.x)[k], o->value[k * SHADE_LANES + 2]));
    o->value[3 * SHADE_LANES] = shade_light_at(w.s.lights, at, &toward, NULL);
    put(o, 3 * SHADE_LANES + 1, toward);
}

/* ---- changes of the arguments --------------------------------------------------------------- */

/* A clip rectangle within the one before, and back to that. */
static void do_scope(fuzz_input *in, outcome *o)
{
    const uint32_t kind = fuzz_byte(in), k = kind & 1;
    shade_target *t = &w.pic[k].target;
    int *n = &w.scopes[k], *held = w.scope[k][kind & 2 && *n ? *n - 1 : *n % SCOPES];
    o->changes = 1;
    if (w.pic[k].want != SHADE_OK) return;    /* a good rectangle would need more memory */
    if ((kind & 2) && *n) {
        --*n;
        t->clip_x = held[0];
        t->clip_y = held[1];
        t->clip_width = held[2];
        t->clip_height = held[3];
    } else if (*n < SCOPES) {
        ++*n;
        held[0] = t->clip_x;
        held[1] = t->clip_y;
        held[2] = t->clip_width;
        held[3] = t->clip_height;
        t->clip_x = fuzz_int(in, -3, 20);
        t->clip_y = fuzz_int(in, -3, 20);
        t->clip_width = fuzz_int(in, -1, 20);
        t->clip_height = fuzz_int(in, 0, 20);
    }
}

static void do_raster(fuzz_input *in, outcome *o)
{
    const uint32_t kind = fuzz_byte(in);
    int bad = 0;
    shade_raster r;
    memset(&r, 0, sizeof r);
    fuzz_raster(in, &r, &bad);
    r.depth_read_only = kind >> 2 & 1;
    r.depth_zero_to_one = kind >> 3 & 1;
    if (kind & 16) r.depth_bias = fuzz_value(in, most);
    o->changes = 1;
    if (kind % 4 == 0) w.s.s.raster = r;
    else if (kind % 4 == 1) w.pipeline.raster = r;
    else if (kind % 4 == 2) w.line.raster = r;
    else w.s.s.raster = w.pipeline.raster = w.line.raster = r;
}

static void do_state(fuzz_input *in, outcome *o)
{
    int bad = 0;
    o->changes = 1;
    switch (fuzz_byte(in) % 8) {
        case 0: w.s.s.model = fuzz_matrix(in, most); break;
        case 1: w.s.s.view = fuzz_matrix(in, most); break;
        case 2: w.s.s.projection = fuzz_matrix(in, most); break;
        case 3: w.clip_from_object = w.line.clip_from_points = fuzz_matrix(in, most); break;
        case 4: w.s.s.shading = (shade_shading)fuzz_enum(in, 3, &bad); break;
        case 5: mesh_lighting(in, &w.s, most); break;
        case 6: mesh_alpha(in, &w.s); break;
        default:
            w.s.s.fragment = fuzz_byte(in) & 1 ? mesh_fragment : NULL;
            w.s.s.uniforms = &w.s;
            break;
    }
}

static void do_mesh(fuzz_input *in, outcome *o)
{
    shade_mesh *m = &w.s.m;
    const uint32_t kind = fuzz_byte(in), which = fuzz_byte(in);
    o->changes = 1;
    switch (which % 4) {
        case 0:
            m->normals = kind & 1 ? &w.normals->x : kind & 2 ? w.normals_given : NULL;
            m->normal_stride = 0;
            break;
        case 1:                          /* chunks of another list of indices, too */
            m->chunks = kind & 1 ? w.chunks : NULL;
            m->chunk_count = w.chunk_count;
            if (kind & 2 && w.chunk_count) {
                o->writes[0] = w.chunks;
                w.chunks[0].count += (int)(kind >> 2) % 3 - 1;
                if (kind & 128) w.chunks[0].low = fuzz_vec3(in, most);
            }
            break;
        case 2:
            m->indices = kind & 1 ? w.sorted : kind & 2 ? w.s.wide : NULL;
            if (kind & 4) m->indices16 = NULL;
            m->index_count = m->indices == w.sorted ? w.corners / 3 * 3 : w.listed;
            break;
        default:
            if (kind & 1) m->vertex_count = fuzz_int(in, -1, w.vertices);
            else if (m->index_count > 0) m->index_count -= fuzz_int(in, 0, 3);
            break;
    }
}

static void do_map(fuzz_input *in, outcome *o)
{
    const uint32_t kind = fuzz_byte(in);
    const picture *p = &w.pic[1];
    shade_texture *t = &w.s.map;
    int bad = 0;
    o->changes = 1;
    w.s.s.diffuse_map = kind & 1 ? &w.s.map : NULL;
    if (kind & 2) *t = w.own;
    else if (p->want == SHADE_OK && p->color) {    /* what is drawn there */
        t->pixels = p->color;
        t->width = p->target.width;
        t->height = p->rows;
        t->stride = p->stride;
        t->format = p->target.format;
        t->srgb = p->target.srgb;
        t->mipmaps = NULL;
        t->mipmap_count = 0;
    }
    t->wrap_u = (shade_wrap)fuzz_enum(in, 3, &bad);
    t->filter = (shade_filter)fuzz_enum(in, 3, &bad);
}

static void do_pipeline(fuzz_input *in, outcome *o)
{
    const uint32_t kind = fuzz_byte(in);
    int bad = 0;
    o->changes = 1;
    w.pipeline.varyings = fuzz_int(in, 0, 4);
    w.pipeline.interpolation = (shade_interpolation)fuzz_enum(in, 3, &bad);
    w.pipeline.may_discard = kind & 1;
    w.pipeline.fragment = kind & 2 ? NULL : pipeline_fragment;
    w.pipeline.lod_texture = kind & 4 ? &w.s.map : NULL;
    w.pipeline.lod_varying = kind >> 3 & 3;
    if (kind & 32) w.line.width = fuzz_value(in, most);
    w.line.cap = (shade_cap)fuzz_enum(in, 2, &bad);
    w.line.color = fuzz_vec4(in, most);
}

/* Formats whose pixels have one size, as do_resolve converts them where they lie; no depth, no
   color. */
static void do_target(fuzz_input *in, outcome *o)
{
    const uint32_t kind = fuzz_byte(in);
    picture *p = &w.pic[kind & 1];
    shade_target *t = &p->target;
    o->changes = 1;
    t->srgb = kind >> 1 & 1;
    t->dither = kind >> 2 & 1;
    t->color = kind % 16 == 8 ? NULL : p->color;
    t->depth = kind % 16 == 9 ? NULL : (float *)(void *)p->depth;
    if ((kind & 32) && t->format < SHADE_FORMAT_RGBA32F)
        t->format = (shade_format)((int)t->format ^ 1);
}

static uint64_t hash_of_memory(void)
{
    return guard_hash((const uint8_t *)hashes, (size_t)guard_count * sizeof *hashes);
}

static void do_keep(fuzz_input *in, outcome *o)
{
    (void)in;
    o->changes = w.kept = 1;
    keep(kept_by_user, 0);
    hash_by_user = hash_of_memory();
}

static void do_go_back(fuzz_input *in, outcome *o)
{
    (void)in;
    o->changes = 2;                      /* everything */
    if (!w.kept) return;
    keep(kept_by_user, 1);
    HOLDS(hash_by_user == hash_of_memory());
}

/* Those that only read stand last. */
static call *const calls[] = {
    do_clear, do_draw_mesh, do_draw_mesh, do_draw_mesh, do_draw, do_draw, do_lines, do_resolve,
    do_mipmaps, do_chunks, do_normals, do_corner_normals, do_edges, do_file,
    do_scope, do_raster, do_state, do_state, do_mesh, do_mesh, do_map, do_pipeline, do_target,
    do_keep, do_go_back,
    do_explain, do_sample, do_pick, do_bounds, do_light };
enum { CALLS = sizeof calls / sizeof calls[0], READS = 5 };

/* ---- steps ---------------------------------------------------------------------------------- */

static int may_write(const outcome *o, const guard *g)
{
    for (int k = 0; k < 3; k++)
        if (o->writes[k] && g->at == (const uint8_t *)o->writes[k]) return 1;
    return o->changes == 2;
}

/* Does a call and checks what it left alone.  The hash of what it gave, and of all memory. */
static uint64_t step(call *does, fuzz_input in)
{
    uint64_t before[GUARD_BLOCKS + 1], after[GUARD_BLOCKS + 1];
    outcome o;
    memset(&o, 0, sizeof o);
    memcpy(before, hashes, sizeof before);
    does(&in, &o);
    hashes_of();
    memcpy(after, hashes, sizeof after);
    for (int k = 0; k < guard_count; k++)
        HOLDS(before[k] == after[k] ||
              (o.result == SHADE_OK && may_write(&o, &guard_blocks[k])));
    HOLDS(before[GUARD_BLOCKS] == after[GUARD_BLOCKS] || o.changes);
    if (o.drawn && o.result == SHADE_OK) picture_check(o.drawn);
    after[GUARD_BLOCKS] = guard_hash((const uint8_t *)o.number, sizeof o.number) ^
                          guard_hash((const uint8_t *)&o.stats, sizeof o.stats) * 3 ^
                          (uint64_t)o.result * 5;
    for (int k = 0; k < 4 * SHADE_LANES; k++) {
        uint32_t bits = 0x7FC00000;
        if (!fuzz_is_nan(o.value[k])) memcpy(&bits, &o.value[k], 4);
        after[GUARD_BLOCKS] = (after[GUARD_BLOCKS] ^ bits) * 1099511628211u;
    }
    if (o.said) after[GUARD_BLOCKS] ^= guard_hash((const uint8_t *)o.said, strlen(o.said));
    after[guard_count] = after[GUARD_BLOCKS];
    return guard_hash((const uint8_t *)after, ((size_t)guard_count + 1) * sizeof *after);
}

static void *take(size_t bytes, uint32_t kind)
{
    void *p = guard_take((bytes + 3) & ~(size_t)3, kind & 1);
    fuzz_noise(p, (bytes + 3) & ~(size_t)3, kind);
    return p;
}

static void world_open(fuzz_input *in)
{
    const uint32_t kind = fuzz_byte(in), ends = fuzz_byte(in);
    size_t pixels;
    memset(&w, 0, sizeof w);
    w.factor = fuzz_int(in, 1, kind & 1 ? 2 : 3);
    picture_open(in, &w.pic[0], 24 / w.factor);
    picture_times(in, &w.pic[0], &w.pic[1], w.factor);
    mesh_open(in, &w.s, fuzz_byte(in), most, VERTICES, TRIANGLES);
    w.own = w.s.map;
    w.vertices = w.s.m.vertex_count;
    w.listed = w.s.m.index_count;
    w.normals_given = w.s.m.normal_stride ? NULL : w.s.m.normals;
    w.corners = mesh_corners(&w.s.m) > w.vertices ? mesh_corners(&w.s.m) : w.vertices;
    w.clip_from_object = w.line.clip_from_points = fuzz_matrix(in, most);
    w.pipeline.vertex = pipeline_vertex;
    w.pipeline.fragment = pipeline_fragment;
    w.pipeline.uniforms = &w;
    w.pipeline.varyings = 4;
    w.line.color = shade_v4(1, 0.5f, 0.25f, 0.75f);
    w.points = (shade_vec3 *)take(POINTS * sizeof *w.points, ends);
    for (int k = 0; k < POINTS; k++) w.points[k] = fuzz_vec3(in, most);
    guard_seal(w.points);
    w.chunks = (shade_chunk *)take(TRIANGLES * sizeof *w.chunks, ends >> 1);
    w.normals = (shade_vec3 *)take((size_t)w.vertices * 12, ends >> 2);
    memset(w.normals, 0, (size_t)w.vertices * 12);
    w.corner_normals = (shade_vec3 *)take((size_t)w.corners * 12, ends >> 3);
    w.sorted = (uint32_t *)take((size_t)w.corners * 4, ends >> 4);
    w.edges = (shade_edge *)take((size_t)w.corners * sizeof *w.edges, ends >> 5);
    w.scratch_bytes = (size_t)w.corners * 16 + 64;
    w.scratch = (uint8_t *)take(w.scratch_bytes, ends >> 6);
    w.mipmap_bytes = texture_is_good(&w.own)
                         ? shade_mipmap_bytes(w.own.width, w.own.height, w.own.format) : 1024;
    w.mipmaps = (uint8_t *)take(w.mipmap_bytes, ends >> 7);
    pixels = w.pic[0].want == SHADE_OK ? (size_t)w.pic[0].target.width * (size_t)w.pic[0].rows : 1;
    w.file_bytes = 15 + 3 * pixels;
    w.file = (uint8_t *)take(w.file_bytes, kind >> 1);
}

int LLVMFuzzerTestOneInput(const uint8_t *data, size_t size)
{
    fuzz_input in = { data, data + size }, at[STEPS];
    const uint32_t kind = fuzz_byte(&in);
    const int count = fuzz_int(&in, 1, STEPS), widths = fuzz_widest() + 1;
    const int level = (int)(kind >> 1) % widths, alone = (int)(kind >> 4) % count;
    uint64_t first[STEPS];
    call *does[STEPS];
    most = kind & 1 ? 0 : 1e5f;
    for (int k = 0; k < count; k++) {
        const ptrdiff_t left = in.end - in.at;
        at[k].at = in.at;
        at[k].end = in.at += left < STEP_BYTES ? left : STEP_BYTES;
        does[k] = calls[fuzz_byte(&at[k]) % CALLS];
    }
    fuzz_level = 0;
    world_open(&in);
    const size_t bytes = keep_bytes();
    uint8_t *begin = (uint8_t *)malloc(3 * bytes), *before = begin + bytes;
    if (!begin) exit(2);
    kept_by_user = before + bytes;
    keep(begin, 0);
    fuzz_level = level;
    for (int k = 0; k < count; k++) {
        if (k == alone) keep(before, 0);
        first[k] = step(does[k], at[k]);
    }
    keep(begin, 1);
    fuzz_level = most > 0 ? (level + 1) % widths : level;    /* the sign of a NaN is left open */
    for (int k = 0; k < count; k++) {
        step(calls[CALLS - 1 - (k + (int)kind) % READS], at[k]);
        HOLDS(step(does[k], at[k]) == first[k]);
    }
    fuzz_level = level;
    if (does[alone] != do_go_back) {
        keep(before, 1);
        HOLDS(step(does[alone], at[alone]) == first[alone]);
    }
    free(begin);
    for (int k = 0; k < 2; k++) picture_close(&w.pic[k]);
    guard_close();
    return 0;
}
