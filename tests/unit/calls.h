/* calls.h - every call of shade.h that takes memory, once, in a world of buffers: what it reads and
   what it writes.  reads.c holds each row to page protection, and the table of tests/CALLS.md to
   these rows; sharing.c runs them under ThreadSanitizer. */
#ifndef CALLS_H
#define CALLS_H

enum {
    CALLS_SIZE = 64,                   /* pixels across and down */
    CALLS_VERTICES = 48,
    CALLS_CORNERS = 3 * 40,
    CALLS_CHUNKS = 4,
    CALLS_TEXELS = 32,
    CALLS_LEVELS = 5,                  /* mipmaps of 32 x 32 texels */
    CALLS_POINTS = 20,
    CALLS_LIGHTS = 2
};

/* The buffers of a world: name, type, number of elements.  The first are arguments that calls read,
   the last are what they fill. */
#define CALLS_BUFFERS(X)                                                      \
    X(target, shade_target, 1)                                                \
    X(color, uint32_t, CALLS_SIZE * CALLS_SIZE)                               \
    X(depth, float, CALLS_SIZE * CALLS_SIZE)                                  \
    X(in, shade_target, 1)                                                    \
    X(samples, uint32_t, 4 * CALLS_SIZE * CALLS_SIZE)                         \
    X(mesh, shade_mesh, 1)                                                    \
    X(positions, float, 3 * CALLS_VERTICES)                                   \
    X(normals, float, 3 * CALLS_VERTICES)                                     \
    X(texcoords, float, 2 * CALLS_VERTICES)                                   \
    X(colors, float, 3 * CALLS_VERTICES)                                      \
    X(indices, uint32_t, CALLS_CORNERS)                                       \
    X(indices16, uint16_t, CALLS_CORNERS)                                     \
    X(chunks, shade_chunk, CALLS_CHUNKS)                                      \
    X(state, shade_draw_state, 1)                                             \
    X(lighting, shade_lighting, 1)                                            \
    X(material, shade_material, 1)                                            \
    X(lights, shade_light, CALLS_LIGHTS)                                      \
    X(map, shade_texture, 1)                                                  \
    X(texels, uint32_t, CALLS_TEXELS * CALLS_TEXELS)                          \
    X(mipmaps, shade_texture, CALLS_LEVELS)                                   \
    X(mipmap_texels, uint32_t, CALLS_TEXELS * CALLS_TEXELS / 3)               \
    X(pipeline, shade_pipeline, 1)                                            \
    X(clip, float, 4 * CALLS_VERTICES)                                        \
    X(line_state, shade_line_state, 1)                                        \
    X(points, shade_vec3, CALLS_POINTS)                                       \
    X(rows, shade_rows, 1)                                                    \
    X(packets, float, 6 * SHADE_LANES)                                        \
    X(stats, shade_stats, 1)                                                  \
    X(out_texture, shade_texture, 1)                                          \
    X(out_levels, shade_texture, CALLS_LEVELS)                                \
    X(out_texels, uint32_t, CALLS_TEXELS * CALLS_TEXELS / 3)                  \
    X(out_rows, float, 4 * SHADE_LANES)                                       \
    X(out_normals, shade_vec3, CALLS_CORNERS)                                 \
    X(out_edges, shade_edge, CALLS_CORNERS)                                   \
    X(out_chunks, shade_chunk, CALLS_CHUNKS)                                  \
    X(out_indices, uint32_t, CALLS_CORNERS)                                   \
    X(scratch, float, 4 * CALLS_CORNERS)                                      \
    X(out_count, int, 1)                                                      \
    X(out_vectors, shade_vec3, 2)                                             \
    X(out_number, float, 1)

typedef struct call_world {
#define X(name, type, count) type *name;
    CALLS_BUFFERS(X)
#undef X
} call_world;

typedef struct world_buffer {
    const char *name;
    size_t at, bytes;                  /* of its pointer in a world; its size */
} world_buffer;

static const world_buffer world_buffers[] = {
#define X(name, type, count) { #name, offsetof(call_world, name), sizeof(type) * (size_t)(count) },
    CALLS_BUFFERS(X)
#undef X
};
enum { WORLD_BUFFERS = (int)(sizeof world_buffers / sizeof world_buffers[0]) };

static void *world_at(const call_world *w, int buffer)
{
    void *p;
    memcpy(&p, (const char *)w + world_buffers[buffer].at, sizeof p);
    return p;
}

static void world_put(call_world *w, int buffer, void *p)
{
    memcpy((char *)w + world_buffers[buffer].at, &p, sizeof p);
}

/* Is a buffer named in a list of names with ", " between them? */
static int world_named(const char *list, const char *name)
{
    const size_t n = strlen(name);
    for (const char *p = list; (p = strstr(p, name)) != NULL; p += n) {
        const int begins = p == list || p[-1] == ' ';
        if (begins && (p[n] == ',' || !p[n])) return 1;
    }
    return 0;
}

/* ------------------------------------------------------------------------------------- contents */

/* Numbers of -1 .. 1 that are the same everywhere. */
static float world_number(uint32_t i)
{
    i = (i + 1) * 2654435769u;
    i = (i ^ i >> 15) * 2246822519u;
    return (float)(i >> 8) / 8388608.0f - 1;
}

static void world_numbers(float *to, int n, uint32_t seed)
{
    for (int i = 0; i < n; i++) to[i] = world_number((uint32_t)i + seed);
}

static void world_vertex(const void *uniforms, const shade_vertex_ids *SHADE_RESTRICT in,
                         shade_vertices *SHADE_RESTRICT out)
{
    const float *clip = (const float *)uniforms;
    SHADE_EACH_LANE(i) {
        for (int k = 0; k < 4; k++) out->clip[k][i] = clip[4 * in->index[i] + (uint32_t)k];
        out->varying[0][i] = clip[4 * in->index[i]];
        out->varying[1][i] = clip[4 * in->index[i] + 1];
    }
}

static void world_fragment(const void *uniforms, const shade_fragments *SHADE_RESTRICT in,
                           shade_colors *SHADE_RESTRICT out)
{
    (void)uniforms;
    SHADE_EACH_LANE(i) {
        out->color[0][i] = in->varying[0][i];
        out->color[1][i] = in->lod[i];
    }
}

static void world_fill_mesh(const call_world *w)
{
    const float tiny = 0.2f;
    memset(w->mesh, 0, sizeof *w->mesh);
    world_numbers(w->positions, 3 * CALLS_VERTICES, 0);
    world_numbers(w->normals, 3 * CALLS_VERTICES, 1000);
    world_numbers(w->texcoords, 2 * CALLS_VERTICES, 2000);
    world_numbers(w->colors, 3 * CALLS_VERTICES, 3000);
    for (uint32_t i = 0; i < CALLS_CORNERS; i++) {
        w->indices[i] = (i * 7 + i / 3) % CALLS_VERTICES;
        w->indices16[i] = (uint16_t)w->indices[i];
    }
    /* small triangles too */
    for (int i = 0; i < 9; i++) w->positions[i] = tiny * w->positions[i];
    w->mesh->positions = w->positions;
    w->mesh->normals = w->normals;
    w->mesh->texcoords = w->texcoords;
    w->mesh->colors = w->colors;
    w->mesh->vertex_count = CALLS_VERTICES;
    w->mesh->indices = w->indices;
    w->mesh->index_count = CALLS_CORNERS;
    w->mesh->chunks = w->chunks;
    w->mesh->chunk_count = CALLS_CHUNKS;
    for (int i = 0; i < CALLS_CHUNKS; i++) {
        w->chunks[i].low = shade_v3(-1, -1, -1);
        w->chunks[i].high = shade_v3(1, 1, 1);
        w->chunks[i].first = i * 10;
        w->chunks[i].count = 10;
    }
}

static void world_fill_textures(const call_world *w)
{
    memset(w->map, 0, sizeof *w->map);
    for (uint32_t i = 0; i < CALLS_TEXELS * CALLS_TEXELS; i++) w->texels[i] = i * 2654435769u;
    w->map->pixels = w->texels;
    w->map->width = w->map->height = CALLS_TEXELS;
    w->map->filter = SHADE_FILTER_TRILINEAR;
    *w->out_texture = *w->map;
    shade_build_mipmaps(w->map, w->mipmaps, w->mipmap_texels,
                        CALLS_TEXELS * CALLS_TEXELS / 3 * sizeof *w->mipmap_texels);
}

static void world_fill_light(const call_world *w)
{
    memset(w->lighting, 0, sizeof *w->lighting);
    memset(w->material, 0, sizeof *w->material);
    w->material->diffuse = w->material->ambient = shade_v3(0.5f, 0.5f, 0.5f);
    w->material->specular = shade_v3(0.25f, 0.25f, 0.25f);
    w->material->shininess = 8;
    w->lights[0] = shade_point_light(shade_v3(1, 2, 3), shade_v3(1, 0.75f, 0.5f));
    w->lights[1] = shade_directional_light(shade_v3(1, -1, -1), shade_v3(0.25f, 0.25f, 0.5f));
    w->lighting->lights = w->lights;
    w->lighting->light_count = CALLS_LIGHTS;
    world_numbers(w->packets, 6 * SHADE_LANES, 4000);
    memset(w->rows, 0, sizeof *w->rows);
    w->rows->position = w->packets;
    w->rows->normal = w->packets + 3 * SHADE_LANES;
}

static void world_fill_states(const call_world *w)
{
    memset(w->state, 0, sizeof *w->state);
    w->state->view = shade_mat4_look_at(shade_v3(0, 0, 3), shade_v3(0, 0, 0), shade_v3(0, 1, 0));
    w->state->projection = shade_mat4_perspective(0.8f, 1, 1, 10);
    w->state->material = w->material;
    w->state->lighting = *w->lighting;
    w->state->diffuse_map = w->map;
    w->state->lighting.ambient = shade_v3(0.125f, 0.125f, 0.125f);

    memset(w->pipeline, 0, sizeof *w->pipeline);
    world_numbers(w->clip, 4 * CALLS_VERTICES, 5000);
    for (int i = 0; i < CALLS_VERTICES; i++) w->clip[4 * i + 3] = 1.5f;
    w->pipeline->vertex = world_vertex;
    w->pipeline->fragment = world_fragment;
    w->pipeline->uniforms = w->clip;
    w->pipeline->varyings = 2;
    w->pipeline->lod_texture = w->map;

    memset(w->line_state, 0, sizeof *w->line_state);
    w->line_state->width = 3;
    w->line_state->color = shade_v4(1, 1, 0, 1);
    world_numbers(&w->points[0].x, 3 * CALLS_POINTS, 6000);
}

/* The mesh takes its indices from indices16. */
static inline void world_narrow(const call_world *w)
{
    w->mesh->indices = NULL;
    w->mesh->indices16 = w->indices16;
}

/* Makes the contents anew, with structs that point at the buffers of this world. */
static void world_fill(const call_world *w)
{
    memset(w->target, 0, sizeof *w->target);
    w->target->width = w->target->height = CALLS_SIZE;
    *w->in = *w->target;
    w->in->width = w->in->height = 2 * CALLS_SIZE;
    w->in->color = w->samples;
    for (uint32_t i = 0; i < 4 * CALLS_SIZE * CALLS_SIZE; i++) w->samples[i] = i * 2654435769u;
    w->target->color = w->color;
    w->target->depth = w->depth;
    world_fill_mesh(w);
    world_fill_textures(w);
    world_fill_light(w);
    world_fill_states(w);
    for (int i = 0; i < CALLS_SIZE * CALLS_SIZE; i++) {
        w->color[i] = 0x80402010u;
        w->depth[i] = i % 5 ? 1 : 0.5f;
    }
    memset(w->stats, 0, sizeof *w->stats);
}

/* ---------------------------------------------------------------------------------------- calls */

static int sink(void *user, const void *bytes, size_t size)
{
    unsigned *sum = (unsigned *)user;
    for (size_t i = 0; i < size; i++) *sum += ((const unsigned char *)bytes)[i];
    return 0;
}

/* Each returns 0 where it did what the row promises. */
#define CALL(name) static int name(const call_world *w)
CALL(call_light_at)
{
    return !(shade_light_at(w->lights, shade_v3(0, 0, 0), w->out_vectors, w->out_number) > 0);
}
CALL(call_light_at_lanes)
{
    shade_light_at_lanes(w->lights, w->packets, w->out_rows, w->out_rows + 3 * SHADE_LANES);
    return 0;
}
CALL(call_evaluate)
{
    const shade_terms t = shade_evaluate(w->lighting, w->material, shade_v3(0, 0, 3),
                                         shade_v3(0, 0, 0), shade_v3(0, 1, 0));
    return !(t.diffuse.x > 0);
}
CALL(call_lit)
{
    return !(shade_lit(w->lighting, w->material, shade_v3(0, 0, 3), shade_v3(0, 0, 0),
                       shade_v3(0, 1, 0)).x > 0);
}
CALL(call_lit_lanes)
{
    shade_lit_lanes(w->lighting, w->material, shade_v3(0, 0, 3), w->rows, w->out_rows);
    return 0;
}
CALL(call_brdf)
{
    return !(shade_brdf(w->material, SHADE_MODEL_LAMBERT, shade_v3(0, 0, 1), shade_v3(0, 0, 1),
                        shade_v3(0, 0, 1)).x > 0);
}
CALL(call_clear) { return (int)shade_clear(w->target, shade_v4(0, 0, 0, 1), 1); }
CALL(call_encode_ppm)
{
    unsigned sum = 0;
    return (int)shade_encode_ppm(sink, &sum, w->target) || !sum;
}
CALL(call_encode_png)
{
    unsigned sum = 0;
    return (int)shade_encode_png(sink, &sum, w->target) || !sum;
}
#ifndef SHADE_NO_STDIO
/* Where there are pages there is /dev/null. */
CALL(call_write_ppm) { return (int)shade_write_ppm("/dev/null", w->target); }
CALL(call_write_png) { return (int)shade_write_png("/dev/null", w->target); }
#endif
CALL(call_resolve) { return (int)shade_resolve(w->target, w->in, 2); }
CALL(call_sample) { return !(shade_sample(w->map, 0.3f, 0.6f, 0.5f).w > 0); }
CALL(call_sample_lanes)
{
    shade_sample_lanes(w->map, w->packets, w->packets + SHADE_LANES, w->packets + 2 * SHADE_LANES,
                       w->out_rows);
    return 0;
}
CALL(call_build_mipmaps)
{
    return (int)shade_build_mipmaps(w->out_texture, w->out_levels, w->out_texels,
                                    CALLS_TEXELS * CALLS_TEXELS / 3 * sizeof *w->out_texels);
}
CALL(call_draw)
{
    return (int)shade_draw(w->target, w->pipeline, w->indices, CALLS_CORNERS, CALLS_VERTICES,
                           w->stats) || !w->stats->fragments;
}
CALL(call_draw_mesh)
{
    return (int)shade_draw_mesh(w->target, w->mesh, w->state, w->stats) || !w->stats->fragments;
}
CALL(call_draw_lines)
{
    return (int)shade_draw_lines(w->target, w->points, CALLS_POINTS, w->line_state, w->stats) ||
           !w->stats->fragments;
}
CALL(call_explain) { return !shade_explain(w->target, w->mesh, w->state, w->stats); }
CALL(call_explain_draw)
{
    return !shade_explain_draw(w->target, w->pipeline, w->indices, CALLS_CORNERS, CALLS_VERTICES,
                               w->stats);
}
CALL(call_explain_lines)
{
    return !shade_explain_lines(w->target, w->points, CALLS_POINTS, w->line_state, w->stats);
}
CALL(call_box_visible)
{
    return !shade_box_visible(w->target, shade_mat4_identity(), 0, shade_v3(0, 0, 0),
                              shade_v3(1, 1, 1));
}
CALL(call_mesh_chunks)
{
    return (int)shade_mesh_chunks(w->mesh, 10, w->out_chunks, CALLS_CHUNKS, w->out_indices);
}
CALL(call_mesh_bounds)
{
    return (int)shade_mesh_bounds(w->mesh, w->out_vectors, w->out_vectors + 1);
}
CALL(call_mesh_normals) { return (int)shade_mesh_normals(w->mesh, w->out_normals); }
CALL(call_corner_bytes)
{
    return shade_mesh_corner_normals_bytes(w->mesh) != 16 * CALLS_CORNERS;
}
CALL(call_corner_normals)
{
    return (int)shade_mesh_corner_normals(w->mesh, 0.5f, w->out_normals, w->scratch,
                                          16 * CALLS_CORNERS);
}
CALL(call_mesh_edges)
{
    return (int)shade_mesh_edges(w->mesh, w->out_edges, CALLS_CORNERS, w->out_count);
}
CALL(call_intersect)
{
    const shade_ray ray = { { 0.25f, 0.25f, 1 }, { 0, 0, -1 } };
    return !shade_intersect(ray, shade_v3(0, 0, 0), shade_v3(1, 0, 0), shade_v3(0, 1, 0),
                            w->out_number, w->out_vectors);
}
CALL(call_pick)
{
    const shade_ray ray = { { 0, 0, 3 }, { 0, 0, -1 } };
    return shade_pick(w->mesh, shade_mat4_identity(), ray, w->out_number, w->out_vectors) < 0;
}

/* What a row changes in the structs before its call. */
static void none(const call_world *w) { (void)w; }

static void depth_read_only(const call_world *w)
{
    w->pipeline->raster.depth_read_only = 1;
    w->state->raster.depth_read_only = 1;
    w->line_state->raster.depth_read_only = 1;
}

/* Depth is tested after the shader. */
static void read_late(const call_world *w)
{
    depth_read_only(w);
    w->pipeline->may_discard = 1;
    w->state->alpha_cutoff = 0.125f;
}

static void depth_alone(const call_world *w)
{
    w->target->color = NULL;
    w->state->diffuse_map = NULL;
}

static void per_face(const call_world *w) { w->state->shading = SHADE_SHADING_PER_FACE; }

static void per_vertex(const call_world *w)
{
    w->state->shading = SHADE_SHADING_PER_VERTEX;
    w->state->diffuse_map = NULL;
}

static void drawn(const call_world *w)
{
    (void)shade_clear(w->target, shade_v4(0, 0, 0, 1), 1);
    (void)call_draw_mesh(w);
}

typedef struct world_call {
    const char *name, *when;           /* when: in words; "" always */
    int (*run)(const call_world *w);
    void (*set)(const call_world *w);
    const char *reads, *writes;        /* buffers that the call cannot do without, and no others */
} world_call;

/* What is written may be read too. */
static const world_call world_calls[] = {
    { "shade_light_at", "", call_light_at, none,
      "lights", "out_vectors, out_number" },
    { "shade_light_at_lanes", "", call_light_at_lanes, none,
      "lights, packets", "out_rows" },
    { "shade_evaluate", "", call_evaluate, none,
      "lighting, lights, material", "" },
    { "shade_lit", "", call_lit, none,
      "lighting, lights, material", "" },
    { "shade_lit_lanes", "", call_lit_lanes, none,
      "lighting, lights, material, rows, packets", "out_rows" },
    { "shade_brdf", "", call_brdf, none,
      "material", "" },
    { "shade_clear", "", call_clear, none,
      "target", "color, depth" },
    { "shade_encode_ppm", "", call_encode_ppm, none,
      "target, color", "" },
    { "shade_encode_png", "", call_encode_png, none,
      "target, color", "" },
#ifndef SHADE_NO_STDIO
    { "shade_write_ppm", "", call_write_ppm, none,
      "target, color", "" },
    { "shade_write_png", "", call_write_png, none,
      "target, color", "" },
#endif
    { "shade_resolve", "", call_resolve, none,
      "target, in, samples", "color" },
    { "shade_sample", "", call_sample, none,
      "map, texels, mipmaps, mipmap_texels", "" },
    { "shade_sample_lanes", "", call_sample_lanes, none,
      "map, texels, mipmaps, mipmap_texels, packets", "out_rows" },
    { "shade_build_mipmaps", "", call_build_mipmaps, none,
      "texels", "out_texture, out_levels, out_texels" },
    { "shade_draw", "", call_draw, none,
      "target, pipeline, clip, indices, map", "color, depth, stats" },
    { "shade_draw", "depth_read_only", call_draw, depth_read_only,
      "target, pipeline, clip, indices, map, depth", "color, stats" },
    { "shade_draw", "depth_read_only, may_discard", call_draw, read_late,
      "target, pipeline, clip, indices, map, depth", "color, stats" },
    { "shade_draw_mesh", "", call_draw_mesh, none,
      "target, mesh, positions, normals, texcoords, colors, indices, chunks, state, material, "
      "lights, map, texels, mipmaps, mipmap_texels", "color, depth, stats" },
    { "shade_draw_mesh", "depth_read_only", call_draw_mesh, depth_read_only,
      "target, mesh, positions, normals, texcoords, colors, indices, chunks, state, material, "
      "lights, map, texels, mipmaps, mipmap_texels, depth", "color, stats" },
    { "shade_draw_mesh", "depth_read_only, alpha_cutoff", call_draw_mesh, read_late,
      "target, mesh, positions, normals, texcoords, colors, indices, chunks, state, material, "
      "lights, map, texels, mipmaps, mipmap_texels, depth", "color, stats" },
    { "shade_draw_mesh", "PER_VERTEX, no map", call_draw_mesh, per_vertex,
      "target, mesh, positions, normals, colors, indices, chunks, state, material, lights",
      "color, depth, stats" },
    { "shade_draw_mesh", "PER_FACE", call_draw_mesh, per_face,
      "target, mesh, positions, texcoords, colors, indices, chunks, state, material, lights, map, "
      "texels, mipmaps, mipmap_texels", "color, depth, stats" },
    { "shade_draw_mesh", "depth alone", call_draw_mesh, depth_alone,
      "target, mesh, positions, indices, chunks, state, material, lights",
      "depth, stats" },
    { "shade_draw_lines", "", call_draw_lines, none,
      "target, points, line_state", "color, depth, stats" },
    { "shade_draw_lines", "depth_read_only", call_draw_lines, depth_read_only,
      "target, points, line_state, depth", "color, stats" },
    { "shade_explain", "", call_explain, drawn,
      "target, color, mesh, positions, normals, texcoords, colors, indices, chunks, state, "
      "material, lights, map, texels, mipmaps, mipmap_texels, depth, stats", "" },
    { "shade_explain_draw", "", call_explain_draw, none,
      "target, pipeline, clip, indices, map, depth, stats", "" },
    { "shade_explain_lines", "", call_explain_lines, none,
      "target, points, line_state, depth, stats", "" },
    { "shade_box_visible", "", call_box_visible, none,
      "target", "" },
    { "shade_mesh_chunks", "", call_mesh_chunks, none,
      "mesh, positions, indices", "out_chunks, out_indices" },
    { "shade_mesh_bounds", "", call_mesh_bounds, none,
      "mesh, positions, indices, chunks", "out_vectors" },
    { "shade_mesh_normals", "", call_mesh_normals, none,
      "mesh, positions, indices, chunks", "out_normals" },
    { "shade_mesh_corner_normals_bytes", "", call_corner_bytes, none,
      "mesh, indices, chunks", "" },
    { "shade_mesh_corner_normals", "", call_corner_normals, none,
      "mesh, positions, indices, chunks", "out_normals, scratch" },
    { "shade_mesh_edges", "", call_mesh_edges, none,
      "mesh, indices, chunks", "out_edges, out_count" },
    { "shade_intersect", "", call_intersect, none,
      "", "out_vectors, out_number" },
    { "shade_pick", "", call_pick, none,
      "mesh, positions, indices, chunks", "out_vectors, out_number" }
};
enum { WORLD_CALLS = (int)(sizeof world_calls / sizeof world_calls[0]) };
/* Every build refuses a mesh for which it has too few varyings. */
static inline int world_fits(void)
{
    if (SHADE_MAX_VARYINGS >= 11) return 1;
    test_skip("a mesh with colours and a map takes 11 varyings");
    return 0;
}

#endif
