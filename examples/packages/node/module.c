/* module.c - what index.js calls: meshes are made, by kit/scene/build.h, and drawn in the memory of
   a WebAssembly module.

   index.js writes the structs that begin with "asked" word by word and is the only caller: it
   checks lengths, indices and sizes before.  A pointer that it hands over is freed here. */
#define SHADE_ASSERT(x) ((void)0)
#ifdef __wasm__
#define EXPORT(name) __attribute__((export_name(#name)))
#define IMPORT(name) __attribute__((import_module("shade"), import_name(#name)))
#else
#define EXPORT(name)
#define IMPORT(name)
#endif
#define NATIVE EXPORT
#include "examples/kit/native.c"
#include <math.h>

typedef struct asked_map {
    uint8_t *texels;                             /* RGBA; NULL: there is none */
    int width, height, wrap_u, wrap_v, squares;  /* shade_wrap; squares: texels are seen as such */
} asked_map;

typedef struct asked_mesh {
    build_asked mesh; /* whose colours are those of a display, and uv upward */
    asked_map map, relief, glow;
} asked_mesh;

typedef struct asked_item {
    double pose[16];                   /* by columns */
    struct module_mesh *mesh;
    int edges, two_sided;
    shade_material material;
    int blended;
    float opacity, alpha_cutoff, metal, rough;
    float strength;                    /* of the relief */
    shade_vec3 glow;                   /* a factor of the picture of what shines */
    int unlit;
} asked_item;

typedef struct asked_view {
    shade_light *lights;
    uint8_t *rgba;
    float *depth;                      /* NULL: nobody wants it; ids too */
    int32_t *ids;
    int light_count, width, height, samples;
    unsigned flags;
    shade_model model;
    shade_vec3 ambient;
    shade_vec4 background;
    shade_mat4 view, projection;
    int in_studio;
    shade_mat4 to_studio;
    int quick;                         /* as of a python_view */
} asked_view;

typedef struct module_map {
    shade_texture texture;             /* pixels NULL: there is none */
    shade_texture levels[15];          /* below 16384 x 16384 */
} module_map;

typedef struct module_mesh {
    build built;                       /* what is drawn, and all memory of the mesh */
    shade_mesh source;                 /* as it was handed over: its edges are drawn */
    module_map map, relief, glow;
    shade_edge *edges;
    double *face_normals;
    int edge_count, edges_known;
    int relief_heights;                /* the relief holds heights, and no normals */
    uint8_t *used;                     /* of source: vertices of triangles that can be seen */
} module_mesh;

/* ---- vertices, chunks and pictures ----------------------------------------------------------- */

static shade_result make_chunks(module_mesh *m)
{
    shade_mesh *mesh = &m->built.mesh;
    const int count = shade_chunk_count(mesh->index_count, 0);
    shade_chunk *chunks;
    shade_result result;
    if (count < 8) return SHADE_OK;
    chunks = (shade_chunk *)build_room(&m->built, (size_t)count, sizeof *chunks);
    if (!chunks) return SHADE_ERROR_CAPACITY;
    result = shade_mesh_chunks(mesh, 0, chunks, count, NULL);
    mesh->chunks = chunks;
    mesh->chunk_count = count;
    return result;
}

/* colors: the texels are those of a display, and no directions or heights. */
static shade_result make_map(module_mesh *m, const asked_map *asked, module_map *map, int colors)
{
    const int w = asked->width, h = asked->height;
    const size_t bytes = shade_mipmap_bytes(w, h, SHADE_FORMAT_RGBA8);
    void *memory;
    if (!asked->texels) return SHADE_OK;
    memory = build_room(&m->built, bytes, 1);
    if (!memory) return SHADE_ERROR_CAPACITY;
    map->texture.pixels = asked->texels;
    map->texture.width = w;
    map->texture.height = h;
    map->texture.srgb = colors;
    map->texture.wrap_u = (shade_wrap)asked->wrap_u;
    map->texture.wrap_v = (shade_wrap)asked->wrap_v;
    return texture_levels(&map->texture, map->levels, memory, bytes, asked->squares);
}

static shade_result make_maps(module_mesh *m, const asked_mesh *asked)
{
    const asked_map *relief = &asked->relief;
    shade_result result = make_map(m, &asked->map, &m->map, 1);
    if (!result) result = make_map(m, relief, &m->relief, 0);
    if (!result) result = make_map(m, &asked->glow, &m->glow, 1);
    if (relief->texels)
        m->relief_heights = python_heights(relief->texels, relief->width, relief->height);
    return result;
}

EXPORT(mesh_free) void module_mesh_free(module_mesh *m);
void module_mesh_free(module_mesh *m)
{
    build_free(&m->built);
    free(m);
}

/* The bytes of the arrays that are handed over */
static double asked_bytes(const asked_mesh *asked)
{
    const asked_map *const map[] = { &asked->map, &asked->relief, &asked->glow };
    const build_asked *a = &asked->mesh;
    double words = (a->normals ? 6.0 : 3.0) * a->vertices + (a->uv ? 2.0 : 0.0) * a->vertices;
    words += 3.0 * a->color_count + a->corners;
    for (int i = 0; i < 3; i++)
        if (map[i]->texels) words += (double)map[i]->width * map[i]->height;
    return 4 * words;
}

/* Makes a mesh of the arrays, which belong to it from now on; *result says why it is NULL. */
EXPORT(mesh_make) module_mesh *module_mesh_make(const asked_mesh *asked, shade_result *result);
module_mesh *module_mesh_make(const asked_mesh *asked, shade_result *result)
{
    const build_asked *a = &asked->mesh;
    const void *const given[] = { a->positions, a->normals, a->colors, a->uv, a->indices,
                                  asked->map.texels, asked->relief.texels, asked->glow.texels };
    float *uv = (float *)(uintptr_t)a->uv;
    module_mesh *m = (module_mesh *)calloc(1, sizeof *m);
    *result = SHADE_ERROR_CAPACITY;
    if (a->colors) python_linear((float *)(uintptr_t)a->colors, (size_t)a->color_count);
    for (int i = 0; uv && i < a->vertices; i++) uv[2 * i + 1] = 1 - uv[2 * i + 1];
    if (m) *result = build_mesh(&m->built, a);
    for (size_t i = 0; i < sizeof given / sizeof *given; i++) {
        if (given[i] && m) build_keep(&m->built, (void *)(uintptr_t)given[i]);
        else free((void *)(uintptr_t)given[i]);
    }
    if (!m) return NULL;
    m->built.bytes += asked_bytes(asked);
    m->source.positions = a->positions;
    m->source.vertex_count = a->vertices;
    m->source.indices = a->indices;
    m->source.index_count = a->corners;
    if (!*result) *result = make_chunks(m);
    if (!*result) *result = make_maps(m, asked);
    if (!*result) return m;
    module_mesh_free(m);
    return NULL;
}

/* The memory that a mesh holds by now: its edges come when they are drawn. */
EXPORT(mesh_bytes) double module_mesh_bytes(const module_mesh *m);
double module_mesh_bytes(const module_mesh *m) { return m->built.bytes; }

/* ---- where they are ------------------------------------------------------------------------- */

/* How far the vertices that can be seen reach from the origin of a mesh, which notes them; below
   0: out of memory */
EXPORT(mesh_reach) double module_mesh_reach(module_mesh *m);
double module_mesh_reach(module_mesh *m)
{
    const size_t vertices = (size_t)m->source.vertex_count;
    double low[6], most = 0;
    m->used = (uint8_t *)build_room(&m->built, vertices, 1);
    if (!m->used) return -1;
    python_seen(m->source.positions, vertices, m->source.indices, (size_t)m->source.index_count,
                m->used, low);
    for (int k = 0; k < 6; k++) most = fmax(most, fabs(low[k]));
    return most * sqrt(3);
}

/* Meshes in their places.  fit: the nearest camera that sees all from a side; studio: to the
   studio */
EXPORT(fit)
int module_fit(core_refusal *r, const core_side *side, module_mesh *const *meshes,
               const core_place *places, int count, core_camera *out);
int module_fit(core_refusal *r, const core_side *side, module_mesh *const *meshes,
               const core_place *places, int count, core_camera *out)
{
    core_cloud cloud;
    if (core_cloud_open(r, side, &cloud)) return r->code;
    for (int i = 0; i < count; i++) {
        const shade_mesh *s = &meshes[i]->source;
        core_cloud_add(&cloud, s->positions, meshes[i]->used, (size_t)s->vertex_count,
                       places[i].pose);
    }
    core_fit(&cloud, side, out);
    return 0;
}

EXPORT(studio)
void module_studio(module_mesh *const *meshes, const core_place *places, int count,
                   const double *view, int up, double *out);
void module_studio(module_mesh *const *meshes, const core_place *places, int count,
                   const double *view, int up, double *out)
{
    core_ball ball = { .some = 0 };
    for (int i = 0; i < 2 * count; i++) { /* the box around all, then distances from its middle */
        const module_mesh *m = meshes[i % count];
        const size_t vertices = (size_t)m->source.vertex_count;
        const double *pose = places[i % count].pose;
        if (i < count) core_ball_add(&ball, m->source.positions, m->used, vertices, pose);
        else core_ball_reach(&ball, m->source.positions, m->used, vertices, pose);
    }
    core_studio(&ball, view, up, out);
}

/* ---- edges ---------------------------------------------------------------------------------- */

static shade_result find_edges(module_mesh *m)
{
    const size_t corners = (size_t)m->source.index_count;
    m->edges = (shade_edge *)build_room(&m->built, corners, sizeof *m->edges);
    m->face_normals = (double *)build_room(&m->built, corners, sizeof *m->face_normals);
    if (m->built.no_room) return SHADE_ERROR_CAPACITY;
    m->edges_known = 1;
    return build_edges(&m->source, m->edges, m->face_normals, &m->edge_count);
}

/* Pairs of points of the edges to draw, in memory that the caller frees */
static shade_result lines_of(const asked_item *asked, const asked_view *seen, python_item *item)
{
    module_mesh *m = asked->mesh;
    const int parallel = seen->projection.col[3].w != 0;
    shade_result result = m->edges_known ? SHADE_OK : find_edges(m);
    const shade_vec3 ink = shade_rgb(0x20242A);
    shade_vec3 *lines;
    double view[16], eye[3];
    for (int k = 0; k < 16; k++) view[k] = (double)(&seen->view.col[k / 4].x)[k % 4];
    if (result || !core_eye(view, parallel, asked->pose, eye)) return result;
    lines = (shade_vec3 *)malloc(2 * sizeof *lines * ((size_t)m->edge_count + 1));
    if (!lines) return SHADE_ERROR_CAPACITY;
    item->lines = lines;
    item->line_points =
        build_drawn_edges(m->source.positions, m->edges, m->edge_count, m->face_normals, eye,
                          parallel, BUILD_COS_EDGE, lines);
    item->line_width = 1.4f;
    item->line_color = shade_v4(ink.x, ink.y, ink.z, 1);
    return SHADE_OK;
}

/* ---- drawing -------------------------------------------------------------------------------- */

static const shade_texture *texture_of(const module_map *map)
{
    return map->texture.pixels ? &map->texture : NULL;
}

static shade_result item_of(const asked_item *asked, const asked_view *seen, python_item *item)
{
    memset(item, 0, sizeof *item);
    item->mesh = asked->mesh->built.mesh;
    item->state.material = &asked->material;
    for (int k = 0; k < 16; k++)
        (&item->state.model.col[k / 4].x)[k % 4] = (float)asked->pose[k];
    item->state.diffuse_map = texture_of(&asked->mesh->map);
    item->relief = texture_of(&asked->mesh->relief);
    item->relief_heights = asked->mesh->relief_heights;
    item->relief_strength = asked->strength;
    item->glow_map = texture_of(&asked->mesh->glow);
    item->glow = asked->glow;
    item->two_sided = asked->two_sided;
    item->blended = asked->blended;
    item->opacity = asked->opacity;
    item->alpha_cutoff = asked->alpha_cutoff;
    item->metal = asked->metal;
    item->rough = asked->rough;
    item->unlit = asked->unlit;
    return asked->edges ? lines_of(asked, seen, item) : SHADE_OK;
}

EXPORT(draw) shade_result module_draw(const asked_view *asked, const asked_item *items, int count);
shade_result module_draw(const asked_view *asked, const asked_item *items, int count)
{
    python_item *item = (python_item *)calloc((size_t)count + 1, sizeof *item);
    python_view view;
    shade_result result = item ? SHADE_OK : SHADE_ERROR_CAPACITY;
    int made = 0;
    memset(&view, 0, sizeof view);
    view.width = asked->width;
    view.height = asked->height;
    view.samples = asked->samples;
    view.channels = 4;
    view.view = asked->view;
    view.projection = asked->projection;
    view.background = asked->background;
    view.lighting.lights = asked->lights;
    view.lighting.light_count = asked->light_count;
    view.lighting.ambient = asked->ambient;
    view.lighting.model = asked->model;
    view.lighting.flags = asked->flags;
    view.in_studio = asked->in_studio;
    view.to_studio = asked->to_studio;
    view.quick = asked->quick;
    view.rgba = asked->rgba;
    view.depth = asked->depth;
    view.ids = asked->ids;
    for (int i = 0; i < 2 * count && !result; i++) {    /* first what hides, then what blends */
        if (!items[i % count].blended != (i < count)) continue;
        result = item_of(&items[i % count], asked, &item[made]);
        item[made++].id = i % count;
    }
    if (!result) result = (shade_result)python_draw(item, count, &view, 1, 1, NULL);
    for (int i = 0; item && i < count; i++) free((void *)(uintptr_t)item[i].lines);
    free(item);
    return result;
}

/* ---- cameras of renderer.h ------------------------------------------------------------------ */

EXPORT(scene_open) renderer_scene *module_scene_open(void);
renderer_scene *module_scene_open(void)
{
    static renderer_scene *first; /* with the shapes of all */
    static int count;
    if (!first) first = renderer_scene_open();
    return first ? renderer_scene_like(first, ++count) : NULL;
}

EXPORT(scene_close) void module_scene_close(renderer_scene *scene);
void module_scene_close(renderer_scene *scene) { renderer_scene_close(scene); }

/* A mesh that is ready, whose coordinates begin at (x, y, z) */
EXPORT(scene_made)
int module_scene_made(renderer_scene *scene, int number, const module_mesh *m, double x, double y,
                      double z);
int module_scene_made(renderer_scene *scene, int number, const module_mesh *m, double x, double y,
                      double z)
{
    const double origin[3] = { x, y, z };
    return renderer_set_mesh(scene, number, &m->built.mesh, 0, origin);
}

/* 1: the relief of a mesh holds heights, and no normals. */
EXPORT(mesh_heights) int module_mesh_heights(const module_mesh *m);
int module_mesh_heights(const module_mesh *m) { return m->relief_heights; }

EXPORT(renderer_draw)
int module_renderer_draw(renderer *r, const renderer_scene *s, const renderer_picture *p);
int module_renderer_draw(renderer *r, const renderer_scene *s, const renderer_picture *p)
{
    return (int)renderer_draw(&r, 1, s, p, 1, NULL);
}

/* ---- models ---------------------------------------------------------------------------------- */

typedef struct module_model {
    const float *positions, *normals, *texcoords, *colors;
    const uint32_t *indices;
    int vertices, corners, parts, normals_given;
    const char *warning;
    double origin[3];
} module_model;

/* Unpacks a file of an archive, as index.js does it.  out NULL: will be wanted */
IMPORT(inflate)
int module_inflate(const unsigned char *packed, size_t packed_size, unsigned char *out,
                   size_t size);

/* Names the packed files of an archive that a model may consist of to module_inflate. */
EXPORT(archive) void module_archive(const unsigned char *bytes, size_t size);
void module_archive(const unsigned char *bytes, size_t size)
{
    static const char *const kinds[] = { "model", "rels", "png", "jpg", "jpeg", NULL };
    mesh_reader r = mesh_of(bytes, size, "", NULL, 0);
    zip z = { NULL, NULL, NULL, 0, 0, NULL };
    const int failed = zip_open(&r, &z);
    for (size_t i = 0; i < z.count && !failed; i++) {
        const zip_entry *e = &z.entry[i];
        const unsigned char *packed = e->method ? zip_packed(&r, &z, e) : NULL;
        char *name = model_text(e->name, e->length);
        int wanted = 0;
        for (int k = 0; name && kinds[k]; k++)
            wanted |= !strcmp(model_kind_of(name).text, kinds[k]);
        if (packed && wanted) module_inflate(packed, (size_t)e->packed, NULL, (size_t)e->size);
        if (packed && wanted) z.left -= (double)e->size;
        free(name);
    }
    free(z.entry);
}

/* A file beside a model, as index.js has it: its bytes, which are freed here, or NULL */
IMPORT(beside) unsigned char *module_beside(const char *name, size_t *size);

static int module_load(const char *path, const char *name, double most, unsigned char **bytes,
                       size_t *size, char **where, char *error, size_t room)
{
    (void)path;
    *bytes = module_beside(name, size);
    *where = NULL;
    if (!*bytes) snprintf(error, room, "%s: the option beside has no such file", name);
    else if ((double)*size <= most) return 0;
    else snprintf(error, room, "%s: larger than %.0f MB", name, most / 1e6);
    free(*bytes);
    *bytes = NULL;
    return 1;
}

/* Reads a file of any format.  The end of its name tells which, or its bytes where it has none.
   NULL with a line in error */
EXPORT(model_open)
model *module_model_open(const void *bytes, size_t size, const char *name, char *error,
                         size_t room);
model *module_model_open(const void *bytes, size_t size, const char *name, char *error, size_t room)
{
    static const model empty;
    const model_request q = { .error = error, .error_size = room };
    model *m = (model *)calloc(1, sizeof *m), said = empty;
    said.path = name;
    said.beside = module_load;
    said.inflate = module_inflate;
    said.polish_wanted = 1;
    if (!m || model_read_with(bytes, size, name, m, &q, &said)) {
        free(m);
        return NULL;
    }
    model_read_libraries(name, m);
    return m;
}

EXPORT(model_close) void module_model_close(model *m);
void module_model_close(model *m) { python_unload(m); }

EXPORT(model_of) void module_model_of(const model *m, module_model *out);
void module_model_of(const model *m, module_model *out)
{
    const shade_mesh *v = &m->mesh.view;
    const module_model is = { v->positions,    v->normals,         v->texcoords,
                              v->colors,       v->indices,         v->vertex_count,
                              v->index_count,  m->part_count,      python_normals(m),
                              python_warning(m), { m->origin[0], m->origin[1], m->origin[2] } };
    *out = is;
}

EXPORT(model_part) void module_model_part(const model *m, int i, python_part *part);
void module_model_part(const model *m, int i, python_part *part) { python_part_of(m, i, part); }

/* ---- words, colours and sizes --------------------------------------------------------------- */

EXPORT(words) const char *module_words(shade_result result);
const char *module_words(shade_result result) { return shade_result_string(result); }

EXPORT(preset_name) const char *module_preset_name(int preset);
const char *module_preset_name(int preset) { return shade_preset_name((shade_preset)preset); }

EXPORT(preset) void module_preset(int preset, shade_material *material);
void module_preset(int preset, shade_material *material)
{
    *material = shade_linear_material(shade_preset_material((shade_preset)preset));
}

EXPORT(linear) void module_linear(float *rgb, int count);
void module_linear(float *rgb, int count) { python_linear(rgb, (size_t)count); }

/* The sizes of the structs above, which index.js compares with its own */
EXPORT(size) int module_size(int which);
int module_size(int which)
{
    static const size_t size[] = { sizeof(asked_mesh), sizeof(asked_item), sizeof(asked_view),
                                   sizeof(shade_light), sizeof(renderer_object),
                                   sizeof(renderer_picture), sizeof(module_model),
                                   sizeof(python_part), sizeof(shade_mesh),
                                   sizeof(renderer_image), sizeof(python_picture),
                                   sizeof(renderer_moved), sizeof(heights),
                                   sizeof(mjv_part) };
    return which >= 0 && which < 14 ? (int)size[which] : 0;
}

EXPORT(take) void *module_take(size_t bytes);
void *module_take(size_t bytes) { return malloc(bytes ? bytes : 1); }

EXPORT(give) void module_give(void *memory);
void module_give(void *memory) { free(memory); }
