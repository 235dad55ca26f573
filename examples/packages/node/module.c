/* module.c - what index.js calls: meshes are prepared and drawn in the memory of a WebAssembly
   module.  They are prepared as ../python/shade_h/mesh.py does, and drawn by the same C.

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

enum { CREASE_TRIANGLES = 200000, CREASE_FACES = 2000 };    /* as in mesh.py */
enum { NORMALS_GIVEN, NORMALS_AUTO, NORMALS_SMOOTH };

typedef struct asked_map {
    uint8_t *texels;                             /* RGBA; NULL: there is none */
    int width, height, wrap_u, wrap_v, squares;  /* shade_wrap; squares: texels are seen as such */
} asked_map;

typedef struct asked_mesh {
    float *positions, *normals, *colors, *uv;    /* colours are those of a display */
    uint32_t *indices;
    int vertices, corners, color_count, normals_kind;
    asked_map map, relief, glow;
} asked_mesh;

typedef struct asked_item {
    double eye[3];                     /* in the space of the mesh, or the way toward the viewer */
    struct module_mesh *mesh;
    int edges, two_sided, parallel;    /* parallel: eye is a direction */
    shade_material material;
    shade_mat4 pose;
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
    int bent;
} asked_view;

typedef struct module_map {
    shade_texture texture;             /* pixels NULL: there is none */
    shade_texture levels[15];          /* below 16384 x 16384 */
} module_map;

typedef struct module_mesh {
    shade_mesh mesh;                   /* what is drawn */
    shade_mesh source;                 /* as it was handed over: its edges are drawn */
    module_map map, relief, glow;
    shade_edge *edges;
    double *face_normals;
    int edge_count, edges_known, no_room;
    int relief_heights;                /* the relief holds heights, and no normals */
    uint8_t *used;                     /* of source: vertices of triangles that can be seen */
    int owned_count;
    void *owned[40];
    double bytes; /* of all that it owns */
} module_mesh;

/* Memory that is freed with the mesh.  NULL is remembered. */
static void *keep(module_mesh *m, void *memory)
{
    if (memory) m->owned[m->owned_count++] = memory;
    else m->no_room = 1;
    return memory;
}
static void *room(module_mesh *m, size_t count, size_t size)
{
    m->bytes += (double)(count + 1) * (double)size;
    return keep(m, calloc(count + 1, size));
}

/* ---- vertices, normals, colours, chunks and pictures ----------------------------------------- */

/* Floats of the rows at[0], at[1], ..., each of width floats */
static float *gathered(module_mesh *m, const float *from, int width, const uint32_t *at, int count)
{
    const size_t floats = (size_t)width;
    float *to = (float *)room(m, (size_t)count, floats * sizeof *to);
    for (int i = 0; to && i < count; i++)
        memcpy(to + floats * (size_t)i, from + floats * at[i], floats * sizeof *to);
    return to;
}

/* What tells the vertices at one corner apart: its normal, its face's colour, or both */
static float *corner_values(module_mesh *m, const float *normals, const float *colors, int *width)
{
    const int count = m->mesh.index_count;
    float *value;
    *width = (normals ? 3 : 0) + (colors ? 3 : 0);
    value = (float *)room(m, (size_t)count, (size_t)*width * sizeof *value);
    for (int i = 0; value && i < count; i++) {
        float *to = value + *width * i;
        if (normals) memcpy(to, normals + 3 * i, 12);
        if (colors) memcpy(to + *width - 3, colors + i / 3 * 3, 12);
    }
    return value;
}

/* Gives corners with a normal or a colour of their own a vertex for each of these, or without
   weld one for each corner. */
static void use_corners(module_mesh *m, const float *normals, int colors_by_face, int weld)
{
    shade_mesh *s = &m->mesh;
    const int count = s->index_count;
    const size_t corners = (size_t)count;
    int width = 0, made_count = count;
    uint32_t *index = (uint32_t *)room(m, corners, 4), *made = (uint32_t *)room(m, corners, 4);
    uint32_t *vertex = (uint32_t *)room(m, corners, 4);
    const float *value = NULL;
    int32_t *first = NULL, *next = NULL;
    if (weld) {
        value = corner_values(m, normals, colors_by_face ? s->colors : NULL, &width);
        first = (int32_t *)room(m, (size_t)s->vertex_count, 4);
        next = (int32_t *)room(m, corners, 4);
    }
    if (m->no_room) return;
    if (weld) {
        memset(first, 255, 4 * (size_t)s->vertex_count);
        made_count = python_weld(s->indices, count, value, width, index, made, first, next);
    }
    for (int i = 0; !weld && i < count; i++) index[i] = made[i] = (uint32_t)i;
    for (int i = 0; i < made_count; i++) vertex[i] = s->indices[made[i]];
    s->positions = gathered(m, s->positions, 3, vertex, made_count);
    if (normals) s->normals = gathered(m, normals, 3, made, made_count);
    else if (s->normals) s->normals = gathered(m, s->normals, 3, vertex, made_count);
    if (s->texcoords) s->texcoords = gathered(m, s->texcoords, 2, vertex, made_count);
    for (int i = 0; colors_by_face && i < made_count; i++) made[i] /= 3;
    if (s->colors)
        s->colors = gathered(m, s->colors, 3, colors_by_face ? made : vertex, made_count);
    s->indices = index;
    s->vertex_count = made_count;
}

/* Do so many faces meet at a vertex that normals of corners would take too long? */
static int is_hub(module_mesh *m)
{
    const shade_mesh *s = &m->mesh;
    int *faces = (int *)room(m, (size_t)s->vertex_count, sizeof *faces), most = 0;
    for (int i = 0; faces && i < s->index_count; i++) {
        const int n = ++faces[s->indices[i]];
        if (n > most) most = n;
    }
    return most > CREASE_FACES;
}

/* One normal for each corner: rounded where faces meet at less than 40 degrees.  NULL: none. */
static const float *creased(module_mesh *m, shade_result *result)
{
    const size_t bytes = shade_mesh_corner_normals_bytes(&m->mesh);
    shade_vec3 *normals;
    void *memory;
    if (!m->mesh.index_count || m->mesh.index_count > 3 * CREASE_TRIANGLES) return NULL;
    if (is_hub(m)) return NULL;
    normals = (shade_vec3 *)room(m, (size_t)m->mesh.index_count, sizeof *normals);
    memory = malloc(bytes);
    if (!normals || !memory) *result = SHADE_ERROR_CAPACITY;
    else *result = shade_mesh_corner_normals(&m->mesh, 0.766f, normals, memory, bytes);
    free(memory);
    return *result ? NULL : &normals->x;
}

/* The normal of each corner's face */
static const float *flat_normals(module_mesh *m)
{
    float *normals = (float *)room(m, (size_t)m->mesh.index_count, 3 * sizeof *normals);
    if (normals) python_face_normals(&m->mesh, normals);
    return normals;
}

static shade_result make_normals(module_mesh *m, const asked_mesh *asked)
{
    const int by_face = asked->colors && asked->color_count != asked->vertices;
    shade_result result = SHADE_OK;
    const float *corner = NULL;
    int flat;
    if (asked->normals_kind == NORMALS_AUTO) corner = creased(m, &result);
    if (asked->normals_kind == NORMALS_SMOOTH && asked->corners) {
        shade_vec3 *normals = (shade_vec3 *)room(m, (size_t)asked->vertices, sizeof *normals);
        if (normals) result = shade_mesh_normals(&m->mesh, normals);
        if (normals && !result) m->mesh.normals = &normals->x;
    }
    if (asked->normals)
        result = (shade_result)python_direct_normals(&m->source, asked->normals);
    flat = !result && !corner && !m->mesh.normals;
    if (flat) corner = flat_normals(m);
    if (!result && !m->no_room && (corner || by_face)) use_corners(m, corner, by_face, !flat);
    return m->no_room ? SHADE_ERROR_CAPACITY : result;
}

static shade_result make_chunks(module_mesh *m)
{
    const int count = shade_chunk_count(m->mesh.index_count, 0);
    shade_chunk *chunks;
    shade_result result;
    if (count < 8) return SHADE_OK;
    chunks = (shade_chunk *)room(m, (size_t)count, sizeof *chunks);
    if (!chunks) return SHADE_ERROR_CAPACITY;
    result = shade_mesh_chunks(&m->mesh, 0, chunks, count, NULL);
    m->mesh.chunks = chunks;
    m->mesh.chunk_count = count;
    return result;
}

/* colors: the texels are those of a display, and no directions or heights. */
static shade_result make_map(module_mesh *m, const asked_map *asked, module_map *map, int colors)
{
    const int w = asked->width, h = asked->height;
    const size_t bytes = shade_mipmap_bytes(w, h, SHADE_FORMAT_RGBA8);
    void *memory;
    if (!asked->texels) return SHADE_OK;
    memory = room(m, bytes, 1);
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
    for (int i = 0; i < m->owned_count; i++) free(m->owned[i]);
    free(m);
}

/* The bytes of the arrays that are handed over */
static double asked_bytes(const asked_mesh *a)
{
    const asked_map *const map[] = { &a->map, &a->relief, &a->glow };
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
    void *const given[] = { asked->positions, asked->normals, asked->colors,
                            asked->uv, asked->indices, asked->map.texels, asked->relief.texels,
                            asked->glow.texels };
    module_mesh *m = (module_mesh *)calloc(1, sizeof *m);
    *result = SHADE_ERROR_CAPACITY;
    for (size_t i = 0; i < sizeof given / sizeof *given; i++) {
        if (given[i] && m) keep(m, given[i]);
        else free(given[i]);
    }
    if (!m) return NULL;
    m->bytes = asked_bytes(asked);
    if (asked->colors) python_linear(asked->colors, (size_t)asked->color_count);
    for (int i = 0; asked->uv && i < asked->vertices; i++)
        asked->uv[2 * i + 1] = 1 - asked->uv[2 * i + 1];
    m->source.positions = asked->positions;
    m->source.vertex_count = asked->vertices;
    m->source.indices = asked->indices;
    m->source.index_count = asked->corners;
    m->mesh = m->source;
    m->mesh.normals = asked->normals;
    m->mesh.colors = asked->colors;
    m->mesh.texcoords = asked->uv;
    *result = make_normals(m, asked);
    if (!*result) *result = make_chunks(m);
    if (!*result) *result = make_maps(m, asked);
    if (!*result) return m;
    module_mesh_free(m);
    return NULL;
}

/* The memory that a mesh holds by now: its edges come when they are drawn. */
EXPORT(mesh_bytes) double module_mesh_bytes(const module_mesh *m);
double module_mesh_bytes(const module_mesh *m) { return m->bytes; }

/* ---- where they are ------------------------------------------------------------------------- */

/* How far the vertices that can be seen reach from the origin of a mesh, which notes them; below
   0: out of memory */
EXPORT(mesh_reach) double module_mesh_reach(module_mesh *m);
double module_mesh_reach(module_mesh *m)
{
    const size_t vertices = (size_t)m->source.vertex_count, floats = 3 * vertices;
    double *at = (double *)malloc((floats + 1) * sizeof *at), most = 0;
    m->used = (uint8_t *)room(m, vertices, 1);
    if (!at || !m->used) {
        free(at);
        return -1;
    }
    for (size_t i = 0; i < floats; i++) at[i] = (double)m->source.positions[i];
    python_seen(at, m->source.indices, (size_t)m->source.index_count, m->used);
    for (size_t i = 0; i < floats; i++)
        if (m->used[i / 3] && fabs(at[i]) <= 1e30) most = fmax(most, fabs(at[i]));
    free(at);
    return most * sqrt(3);
}

/* Meshes in their places.  fit: the nearest camera that sees all from a side; studio: to the
   studio */
EXPORT(place_all) void module_place_all(core_place *places, int count, double *origin);
void module_place_all(core_place *places, int count, double *origin)
{
    core_place_all(places, count, origin);
}

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

/* The lowest vertex with the same position, for each vertex; -0 is 0. */
static uint32_t *lowest_alike(module_mesh *m)
{
    const int count = m->source.vertex_count;
    uint32_t size = 2, *table, *lowest = (uint32_t *)room(m, (size_t)count, 4);
    while (size < 2 * (uint32_t)count) size *= 2;
    table = (uint32_t *)calloc(size, 4);    /* vertices from 1 on; 0: free */
    if (!table) m->no_room = 1;
    for (int i = 0; lowest && table && i < count; i++) {
        const float *p = m->source.positions + 3 * i;
        const float q[3] = { p[0] + 0.0f, p[1] + 0.0f, p[2] + 0.0f };
        uint32_t bits[3], at;
        memcpy(bits, q, 12);
        at = (bits[0] * 0x9E3779B1u ^ bits[1] * 0x85EBCA77u ^ bits[2] * 0xC2B2AE3Du) * 0x27D4EB2Fu;
        for (at = (at ^ at >> 15) & (size - 1); table[at]; at = (at + 1) & (size - 1)) {
            const float *t = m->source.positions + 3 * (table[at] - 1);
            const float r[3] = { t[0] + 0.0f, t[1] + 0.0f, t[2] + 0.0f };
            if (!memcmp(q, r, 12)) break;
        }
        if (!table[at]) table[at] = (uint32_t)i + 1;
        lowest[i] = table[at] - 1;
    }
    free(table);
    return lowest;
}

/* In double; NaN for a face without area. */
static void normal_of(const float *positions, const uint32_t *corner, double *n)
{
    double a[3], b[3], length;
    for (int k = 0; k < 3; k++) {
        const double p = (double)positions[3 * corner[0] + (uint32_t)k];
        a[k] = (double)positions[3 * corner[1] + (uint32_t)k] - p;
        b[k] = (double)positions[3 * corner[2] + (uint32_t)k] - p;
    }
    for (int k = 0; k < 3; k++)
        n[k] = a[(k + 1) % 3] * b[(k + 2) % 3] - a[(k + 2) % 3] * b[(k + 1) % 3];
    length = sqrt(n[0] * n[0] + n[1] * n[1] + n[2] * n[2]);
    for (int k = 0; k < 3; k++) n[k] /= length;
}

/* Lists each edge once, where vertices of one position count as one. */
static shade_result find_edges(module_mesh *m)
{
    const uint32_t *lowest = lowest_alike(m), *from = m->source.indices;
    const size_t corners = (size_t)m->source.index_count;
    uint32_t *welded = (uint32_t *)room(m, corners, 4);
    shade_mesh mesh = m->source;
    mesh.index_count = 0;
    m->edges = (shade_edge *)room(m, corners, sizeof *m->edges);
    m->face_normals = (double *)room(m, corners, sizeof *m->face_normals);
    if (m->no_room) return SHADE_ERROR_CAPACITY;
    for (size_t i = 0; i < corners; i += 3) {
        uint32_t *to = welded + mesh.index_count;
        for (int k = 0; k < 3; k++) to[k] = lowest[from[i + (size_t)k]];
        if (to[0] != to[1] && to[1] != to[2] && to[0] != to[2]) mesh.index_count += 3;
    }
    for (int i = 0; i < mesh.index_count; i += 3)
        normal_of(mesh.positions, welded + i, m->face_normals + i);
    mesh.indices = welded;
    m->edges_known = 1;
    if (!mesh.index_count) return SHADE_OK;
    return shade_mesh_edges(&mesh, m->edges, (int)corners, &m->edge_count);
}

static double dot(const double *a, const double *b)
{
    return a[0] * b[0] + a[1] * b[1] + a[2] * b[2];
}

/* Boundaries, silhouettes, and creases of 30 degrees and more */
static int is_drawn(const module_mesh *m, const shade_edge *e, const asked_item *asked)
{
    const double *n0 = m->face_normals + 3 * e->triangle[0];
    const double *n1 = m->face_normals + 3 * e->triangle[1];
    double to_eye[3];
    if (e->triangle[1] < 0) return 1;
    for (int k = 0; k < 3; k++) {
        const double p = (double)m->source.positions[3 * e->a + (uint32_t)k];
        to_eye[k] = asked->parallel ? asked->eye[k] : asked->eye[k] - p;
    }
    return dot(n0, to_eye) * dot(n1, to_eye) <= 0 || dot(n0, n1) <= 0.86602540378443871;
}

/* Pairs of points of the edges to draw, in memory that the caller frees */
static shade_result lines_of(const asked_item *asked, python_item *item)
{
    module_mesh *m = asked->mesh;
    const shade_vec3 *points = (const shade_vec3 *)(const void *)m->source.positions;
    shade_result result = m->edges_known ? SHADE_OK : find_edges(m);
    const shade_vec3 ink = shade_rgb(0x20242A);
    shade_vec3 *lines;
    if (result) return result;
    lines = (shade_vec3 *)malloc(2 * sizeof *lines * ((size_t)m->edge_count + 1));
    if (!lines) return SHADE_ERROR_CAPACITY;
    item->lines = lines;
    for (int i = 0; i < m->edge_count; i++) {
        if (!is_drawn(m, &m->edges[i], asked)) continue;
        lines[item->line_points++] = points[m->edges[i].a];
        lines[item->line_points++] = points[m->edges[i].b];
    }
    item->line_width = 1.4f;
    item->line_color = shade_v4(ink.x, ink.y, ink.z, 1);
    return SHADE_OK;
}

/* ---- drawing -------------------------------------------------------------------------------- */

static const shade_texture *texture_of(const module_map *map)
{
    return map->texture.pixels ? &map->texture : NULL;
}

static shade_result item_of(const asked_item *asked, python_item *item)
{
    memset(item, 0, sizeof *item);
    item->mesh = asked->mesh->mesh;
    item->state.material = &asked->material;
    item->state.model = asked->pose;
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
    return asked->edges ? lines_of(asked, item) : SHADE_OK;
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
    view.bent = asked->bent;
    view.rgba = asked->rgba;
    view.depth = asked->depth;
    view.ids = asked->ids;
    for (int i = 0; i < 2 * count && !result; i++) {    /* first what hides, then what blends */
        if (!items[i % count].blended != (i < count)) continue;
        result = item_of(&items[i % count], &item[made]);
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
    return renderer_set_mesh(scene, number, &m->mesh, 0, origin);
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
                                   sizeof(renderer_moved) };
    return which >= 0 && which < 12 ? (int)size[which] : 0;
}

EXPORT(take) void *module_take(size_t bytes);
void *module_take(size_t bytes) { return malloc(bytes ? bytes : 1); }

EXPORT(give) void module_give(void *memory);
void module_give(void *memory) { free(memory); }
