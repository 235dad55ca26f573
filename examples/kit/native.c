/* native.c - what both packages call, Python's through ctypes: pictures of many meshes, cut
   bands that threads share, and the equations over arrays of any length.

   The package checks shapes, types and sizes before a call; shade.h checks the rest.  The structs
   here have twins in shade_h/_native.py, which compares their sizes when it is imported. */
#if defined(_WIN32) && !defined(SHADEDEF)
#define SHADEDEF extern __declspec(dllexport)
#endif
#define SHADE_IMPLEMENTATION
#include "shade.h"
#include "examples/kit/image/apart.h"
#include "examples/kit/image/pictures.h"
#include "examples/kit/image/numbers.h"
#include "examples/kit/image/png.h"
#include "examples/shared/bands.h"
#include "examples/kit/scene/look.h"
#include "examples/kit/scene/stand.h"
#include "examples/shared/canvas.h"
#include "examples/kit/scene/renderer.h"
#include "examples/elsewhere/words.h"
#include "examples/kit/scene/deform.h"
#include "examples/kit/core/camera.h"
#include "examples/kit/core/color.h"
#include "examples/kit/core/mjv.h"
#include "examples/kit/draw/cut.h"
#include "examples/shared/label.h"

#ifndef NATIVE
#define NATIVE(name) SHADEDEF /* WebAssembly calls these by name alone */
#endif

typedef struct python_item { /* a mesh in its place */
    shade_mesh mesh;
    shade_draw_state state;                 /* camera and lights are those of the view */
    const shade_vec3 *lines;                /* pairs of points in object space */
    int line_points, two_sided, lines_over; /* lines_over: nothing hides the lines */
    float line_width;                       /* in pixels of the finished picture */
    shade_vec4 line_color;
    int32_t id;                  /* of its part, which is also the number of its pose */
    int blended;                 /* drawn over what is there; notes and depth leave it out */
    float opacity, alpha_cutoff; /* less alpha is discarded; 0: none */
    float metal, rough;          /* in the studio, as of a look; rough 0: by the shininess */
    const shade_texture *relief, *glow_map; /* NULL: none */
    float relief_strength;                  /* as in a model_relief */
    int relief_heights;
    shade_vec3 glow; /* a factor of glow_map */
    int unlit;       /* as of a look */
} python_item;

typedef struct python_view {              /* a camera and where its picture goes */
    int width, height, samples, channels; /* channels of rgba: 4 or 3 */
    shade_mat4 view, projection;
    shade_vec4 background; /* linear; alpha 0: transparent */
    shade_lighting lighting;
    const shade_mat4 *poses; /* one for each item, or NULL: those of the states */
    uint8_t *rgba;
    float *depth, *normals; /* each may be NULL; along the axis of view */
    int32_t *ids;
    int in_studio;        /* else lit by lighting */
    shade_mat4 to_studio; /* the scene about the origin, within distance 1 */
    int quick; /* lamps that stay with the camera; QUICK_LAMPS: and ambient of lighting */
} python_view;

enum { QUICK = 1, QUICK_LAMPS };

typedef struct light_studio { /* the thumbnail's light, and all items as one model in it */
    studio light;
    ground ground;
    model scene;
    shade_mat4 from_world, to_world;
} light_studio;

typedef struct python_job {
    const light_studio *studio; /* NULL: none */
    const python_item *items;
    const python_view *views;
    shade_result *results; /* of each piece */
    int item_count, bands;
    const volatile int *stop; /* non-zero: the caller does not want the pictures any more */
} python_job;

/* ---- what a pixel shows ---------------------------------------------------------------------- */

typedef struct notes { /* of one item in one band */
    const python_view *view;
    int id, step, has_holes; /* step: samples along the edge of a pixel */
} notes;

static void note_normal(float *to, const look *k, const shade_fragments *in, int i)
{
    shade_vec3 N = lane(in->varying[LOOK_N], i);
    if (k->relief.map) N = shade_mat3_transform(k->normals, N);
    N = shade_scale(shade_normalize(N), in->front[i] ? 1.0f : -1.0f);
    SHADE_MEMCPY(to, &N, sizeof N);
}

/* Notes what lies at the centre of a pixel.  Fragments of a surface with holes have not been tested
   for depth yet: the nearest stays, where depth is noted. */
static void note_pixel(const look *k, const shade_fragments *in, int i, size_t at)
{
    const notes *n = (const notes *)k->noted;
    const python_view *v = n->view;
    const shade_mat4 *m = &v->view;
    const float depth = -(m->col[0].z * in->varying[0][i] + m->col[1].z * in->varying[1][i] +
                          m->col[2].z * in->varying[2][i] + m->col[3].z);
    if (n->has_holes && v->depth && depth > v->depth[at]) return;
    if (v->ids) v->ids[at] = n->id;
    if (v->depth) v->depth[at] = depth;
    if (v->normals) note_normal(v->normals + 3 * at, k, in, i);
}

/* Of a surface without holes only fragments that pass the depth test come here, the nearest of a
   pixel last.  Others are tested after the shader, so that here the nearest counts. */
static void note(const look *k, const shade_fragments *in, const shade_colors *colors)
{
    const notes *n = (const notes *)k->noted;
    const int step = n->step;
    for (int i = 0; i < in->count; i++) {
        const int x = (int)in->x[i], y = (int)in->y[i];
        if (colors->discard[i]) continue;
        if (step > 1 && (x % step != step / 2 || y % step != step / 2)) continue;
        note_pixel(k, in, i, (size_t)(y / step) * (size_t)n->view->width + (size_t)(x / step));
    }
}

/* ---- drawing --------------------------------------------------------------------------------- */

static shade_draw_state item_state(const python_item *items, const python_view *v, int i)
{
    shade_draw_state state = items[i].state;
    state.view = v->view;
    state.projection = v->projection;
    if (v->poses) state.model = v->poses[items[i].id];
    if (!items[i].two_sided) state.raster.cull = SHADE_CULL_BACK;
    if (items[i].blended) {
        state.raster.blend = SHADE_BLEND_OVER;
        state.raster.depth_read_only = 1;
    }
    return state;
}

/* Edges lie on faces, and so are drawn a little nearer: in perspective by 1/2000 of their distance,
   which depends on no near and far, else by 1/1000 of the range of depth. */
static shade_result draw_edges(const shade_target *target, const python_item *item,
                               const shade_draw_state *state, int samples)
{
    const int parallel = state->projection.col[3].w != 0;
    const float s = parallel ? 1 : 1 - 5e-4f;
    shade_line_state pen = { .width = item->line_width * (float)samples, .cap = SHADE_CAP_SQUARE };
    shade_mat4 to_eye = shade_mat4_mul(state->view, state->model);
    to_eye = shade_mat4_mul(shade_mat4_scaling(shade_v3(s, s, s)), to_eye);
    pen.color = item->line_color;
    pen.raster.depth_test = item->lines_over ? SHADE_COMPARE_ALWAYS : SHADE_COMPARE_LESS_EQUAL;
    pen.raster.depth_bias = parallel ? -1e-3f : 0;
    pen.clip_from_points = shade_mat4_mul(state->projection, to_eye);
    return shade_draw_lines(target, item->lines, item->line_points, &pen, NULL);
}

/* The quick lamps of a view */
static void light_quickly(const python_view *v, shade_light lamp[3], shade_lighting *to)
{
    /* the way that their light travels in front of the camera, and its colour */
    static const double way[3][3] = { { 0.55, -0.85, -0.75 },
                                      { -1.0, 0.05, -0.55 },
                                      { -0.6, -0.5, 1.0 } };
    static const shade_vec3 color[3] = { { 1.02f, 0.99f, 0.95f },
                                         { 0.20f, 0.23f, 0.28f },
                                         { 0.35f, 0.38f, 0.42f } };
    for (int i = 0; i < 3; i++) {
        float at[3];
        for (int k = 0; k < 3; k++) {
            const shade_vec4 c = v->view.col[k];
            at[k] = (float)-(way[i][0] * (double)c.x + way[i][1] * (double)c.y +
                             way[i][2] * (double)c.z);
        }
        lamp[i] = (shade_light){ .position = { at[0], at[1], at[2], 0 } };
        lamp[i].diffuse = lamp[i].specular = color[i];
    }
    to->lights = lamp;
    to->light_count = 3;
    if (v->quick == QUICK) to->ambient = shade_v3(0.17f, 0.175f, 0.19f);
}

/* What the items of a view have in common; a viewer at infinity is far away in the studio.  Light
   of the quick lamps above SHOULDER is bent toward white, so that white has form. */
static look look_of(const python_view *v, const light_studio *s, shade_light lamp[3])
{
    const int endless = (v->lighting.flags & SHADE_FLAG_INFINITE_VIEWER) != 0;
    shade_mat4 eye = shade_mat4_inverse(v->view);
    look k = { .lighting = v->lighting, .placed = 1, .clipped = !v->quick };
    if (v->quick) light_quickly(v, lamp, &k.lighting);
    if (s) {
        eye = shade_mat4_mul(s->from_world, eye);
        k.studio = &s->light;
        k.to_studio = &s->from_world;
        k.lighting = (shade_lighting){ .lights = s->light.lamp, .light_count = 2 };
        k.shadows = k.mirrors = 1;
        k.clipped = 0;
    }
    k.eye = endless ? shade_mat4_transform_direction(eye, shade_v3(0, 0, 1))
                    : shade_mat4_transform_point(eye, shade_v3(0, 0, 0));
    if (endless && s) k.eye = shade_scale(shade_normalize(k.eye), 1e4f);
    return k;
}

/* The surface of an item in its place */
static void look_dress_item(look *k, const python_item *item, const shade_draw_state *state)
{
    const shade_material *material = item->state.material;
    k->material = *material;
    k->unlit = item->unlit;
    k->metal = item->metal;
    k->rough = item->rough > 0 ? item->rough : model_roughness(material->shininess);
    k->map = state->diffuse_map;
    k->relief = (relief){ .map = item->relief,
                          .strength = item->relief_strength,
                          .heights = item->relief_heights };
    if (k->relief.map) k->relief.finer = texture_finer(k->relief.map, k->map);
    k->glow_map = item->glow_map;
    k->glow = item->glow;
    k->alpha = item->blended ? item->opacity : 1;
    k->alpha_cutoff = item->alpha_cutoff;
    k->raster = state->raster;
    k->to_world = state->model;
    k->normals = shade_normal_matrix(state->model);
    k->clip_from_mesh =
        shade_mat4_mul(shade_mat4_mul(state->projection, state->view), state->model);
}

/* Draws runs of chunks that can be seen; a mesh without chunks whole. */
static shade_result draw_chunks(const shade_target *target, look *k, const shade_mesh *mesh)
{
    const shade_chunk *c = mesh->chunks, *end = c + (c ? mesh->chunk_count : 0);
    shade_result result = SHADE_OK;
    if (!c) return look_draw(target, k, mesh, 0, mesh->index_count / 3);
    while (c < end && !result) {
        const int first = c->first;
        int count = 0;
        for (; c < end && shade_box_visible(target, k->clip_from_mesh, 0, c->low, c->high); c++)
            count += c->count;
        if (count) result = look_draw(target, k, mesh, first, count);
        c += !count;
    }
    return result;
}

/* step: samples along the edge of a pixel, of which one is noted; 0: nothing is */
static shade_result draw_meshes(const shade_target *target, const python_job *job,
                                const python_view *v, int step, int notes_only)
{
    shade_result result = SHADE_OK;
    shade_light lamp[3];
    look k = look_of(v, job->studio, lamp);
    k.notes_only = notes_only;
    for (int i = 0; i < job->item_count && !result; i++) {
        const python_item *item = &job->items[i];
        const shade_draw_state state = item_state(job->items, v, i);
        const notes noted = { v, item->id, step, item->alpha_cutoff > 0 };
        if (notes_only && item->blended) continue;
        look_dress_item(&k, item, &state);
        k.note = step && !item->blended ? note : NULL;
        k.noted = &noted;
        result = draw_chunks(target, &k, &item->mesh);
    }
    return result;
}

static shade_result draw_colors(const shade_target *target, const python_job *job,
                                const python_view *v, int step)
{
    shade_result result = shade_clear(target, v->background, 1);
    if (!result) result = draw_meshes(target, job, v, step, 0);
    if (!result && job->studio)
        result = ground_draw(&job->studio->ground, target, job->studio->to_world, v->view,
                             v->projection);
    for (int i = 0; i < job->item_count && !result; i++) {
        const shade_draw_state state = item_state(job->items, v, i);
        if (job->items[i].line_points)
            result = draw_edges(target, &job->items[i], &state, v->samples);
    }
    return result;
}

/* Colours over nothing are multiplied by their alpha after the mean; this divides it out. */
static void divide_alpha(float *rgba, size_t pixels)
{
    for (size_t i = 0; i < pixels; i++, rgba += 4)
        for (int k = 0; k < 3 && rgba[3] > 0; k++) rgba[k] /= rgba[3];
}

/* The mean of several samples, through floats where the background is transparent */
static shade_result resolve(const shade_target *out, const shade_target *in, int samples,
                            float alpha)
{
    const size_t pixels = (size_t)out->width * (size_t)out->row_count;
    shade_target floats = *out;
    shade_result result;
    if (samples == 1) return SHADE_OK;
    if (alpha >= 1) return shade_resolve(out, in, samples);
    floats.format = SHADE_FORMAT_RGBA32F;
    floats.color = malloc(pixels * 16);
    if (!floats.color) return SHADE_ERROR_CAPACITY;
    result = shade_resolve(&floats, in, samples);
    divide_alpha((float *)floats.color, pixels);
    if (!result) result = shade_resolve(out, &floats, 1);
    free(floats.color);
    return result;
}

static void pack_rgb(uint8_t *rgb, const uint8_t *rgba, size_t pixels)
{
    for (size_t i = 0; i < pixels; i++)
        for (size_t k = 0; k < 3; k++) rgb[3 * i + k] = rgba[4 * i + k];
}

static void clear_notes(const python_view *v, size_t first, size_t pixels)
{
    for (size_t i = 0; i < pixels; i++) {
        if (v->ids) v->ids[first + i] = -1;
        if (v->depth) v->depth[first + i] = HUGE_VALF;
    }
    if (v->normals) memset(v->normals + 3 * first, 0, 12 * pixels);
}

/* Draws the rows of out with samples in large's.  An odd number of samples has one at the centre of
   the pixel; else what lies there is drawn apart. */
static shade_result draw_rows(const python_job *job, const python_view *v, shade_target *out,
                              shade_target *large)
{
    shade_result result;
    const size_t first = (size_t)out->row_offset * (size_t)v->width;
    const size_t pixels = (size_t)out->row_count * (size_t)v->width;
    const int noted = v->ids || v->depth || v->normals, apart = noted && v->samples % 2 == 0;
    if (noted) clear_notes(v, first, pixels);
    result = draw_colors(large, job, v, noted && !apart ? v->samples : 0);
    if (!result) result = resolve(out, large, v->samples, v->background.w);
    if (result) return result;
    if (v->channels == 3) pack_rgb(v->rgba + 3 * first, (const uint8_t *)out->color, pixels);
    if (!apart) return SHADE_OK;
    out->color = large->color; /* which nobody reads any more */
    out->depth = large->depth;
    result = shade_clear(out, shade_v4(0, 0, 0, 0), 1);
    return result ? result : draw_meshes(out, job, v, 1, 1);
}

/* Draws rows whose targets have no memory yet.  A picture of one sample a pixel is drawn where it
   stays. */
static shade_result draw_strip(const python_job *job, const python_view *v, shade_target *out,
                               shade_target *large)
{
    const size_t first = 4 * (size_t)out->row_offset * (size_t)v->width;
    const size_t bytes = 4 * (size_t)out->row_count * (size_t)v->width;
    const size_t most = bytes * (size_t)(v->samples * v->samples);
    const int in_place = v->channels == 4;
    shade_result result = SHADE_ERROR_CAPACITY;
    void *own = in_place ? NULL : malloc(bytes), *depth = malloc(most);
    void *color = v->samples > 1 ? malloc(most) : NULL;
    out->color = in_place ? (void *)(v->rgba + first) : own;
    large->color = v->samples > 1 ? color : out->color;
    large->depth = (float *)depth;
    if (out->color && large->color && depth) result = draw_rows(job, v, out, large);
    free(own);
    free(depth);
    free(color);
    return result;
}

static shade_result draw_share(const python_job *job, const python_view *v, int band)
{
    const long long rows = v->height;
    shade_target out = { .width = v->width, .height = v->height, .srgb = 1 }, large;
    out.row_offset = (int)(rows * band / job->bands);
    out.row_count = (int)(rows * (band + 1) / job->bands) - out.row_offset;
    large = out;
    large.width *= v->samples;
    large.height *= v->samples;
    large.row_offset *= v->samples;
    large.row_count *= v->samples;
    return out.row_count ? draw_strip(job, v, &out, &large) : SHADE_OK;
}

static void draw_piece(void *data, int piece)
{
    const python_job *job = (const python_job *)data;
    if (!job->stop || !*job->stop)
        job->results[piece] = draw_share(job, &job->views[piece / job->bands], piece % job->bands);
}

/* Bands enough for the threads, and so many that one has no more than 8 million samples.  Each band
   looks at the triangles anew: of a mesh of many, in no order in space, a thread draws one band. */
static int bands_of(const python_view *v, double triangles, int views, int threads)
{
    const double samples = (double)v->width * v->height * v->samples * v->samples;
    const int least = 1 + (int)(samples / 8e6);
    const int wanted = views >= 2 * threads      ? 1
                       : 8 * triangles > samples ? threads
                                                 : bands_count(threads, v->height);
    const int most = least > wanted ? least : wanted;
    return most < v->height ? most : v->height;
}

/* ---- the studio ------------------------------------------------------------------------------ */

/* Appends an item to the mesh of the studio, which has room. */
static void append(owned_mesh *m, const shade_mesh *from, shade_mat4 place)
{
    const size_t vertices = (size_t)m->view.vertex_count;
    float *to = m->positions + 3 * vertices;
    for (int k = 0; k < from->index_count; k++)
        m->indices[m->view.index_count++] = (uint32_t)vertices + from->indices[k];
    for (int k = 0; k < from->vertex_count; k++, to += 3) {
        const float *p = from->positions + 3 * (size_t)k;
        const shade_vec3 q = shade_mat4_transform_point(place, shade_v3(p[0], p[1], p[2]));
        memcpy(to, &q, sizeof q);
    }
    m->view.vertex_count += from->vertex_count;
}

/* All items as one mesh in the studio.  Non-zero: out of memory, or too large for one mesh */
static int one_mesh(light_studio *s, const python_item *items, int count)
{
    double vertices = 0, indices = 0;
    owned_mesh *m = &s->scene.mesh;
    for (int i = 0; i < count; i++) {
        vertices += items[i].mesh.vertex_count;
        indices += items[i].mesh.index_count;
    }
    if (vertices > INT_MAX || indices > INT_MAX) return 1;
    m->positions = (float *)calloc((size_t)vertices + 1, 3 * sizeof(float));
    m->indices = (uint32_t *)calloc((size_t)indices + 1, sizeof(uint32_t));
    s->scene.part = (model_part *)calloc(1, sizeof *s->scene.part);
    if (!m->positions || !m->indices || !s->scene.part) return 1;
    mesh_link(m, 0, 0);
    for (int i = 0; i < count; i++)
        append(m, &items[i].mesh, shade_mat4_mul(s->from_world, items[i].state.model));
    s->scene.part->count = m->view.index_count;
    s->scene.part_count = 1;
    return 0;
}

static void close_studio(light_studio *s)
{
    if (!s) return;
    model_free(&s->scene);
    ground_free(&s->ground);
    studio_close(&s->light);
    free(s);
}

/* The shadows that the items throw on each other and the ground.  NULL: out of memory */
static light_studio *open_studio(const python_item *items, int count, const python_view *v,
                                 int threads)
{
    light_studio *s = (light_studio *)calloc(1, sizeof *s);
    const int pixels = v->width > v->height ? v->width : v->height;
    if (!s) return NULL;
    s->from_world = v->to_studio;
    s->to_world = shade_mat4_inverse(v->to_studio);
    if (!one_mesh(s, items, count) && s->scene.part->count &&
        !studio_open(&s->light, &s->scene, pixels, 0, threads, NULL, NULL) &&
        !studio_cast(&s->ground, &s->light, &s->scene.mesh, threads))
        return s;
    close_studio(s);
    return NULL;
}

/* Draws views of one size, by so many threads (0: one a core).  Only a single view may be in the
   studio.  Once *stop is set, which may be NULL, the rest of the pictures is left out.  Returns the
   first result that is no success. */
SHADEDEF int python_draw(const python_item *items, int item_count, const python_view *views,
                         int view_count, int threads, const volatile int *stop);
int python_draw(const python_item *items, int item_count, const python_view *views, int view_count,
                int threads, const volatile int *stop)
{
    python_job job = { NULL, items, views, NULL, item_count, 1, stop };
    light_studio *light = NULL;
    shade_result result = SHADE_OK;
    double triangles = 0;
    int pieces;
    if (view_count < 1) return SHADE_OK;
    if (threads < 1) threads = bands_cores();
    for (int i = 0; i < item_count; i++) triangles += items[i].mesh.index_count / 3;
    job.bands = bands_of(views, triangles, view_count, threads);
    if (job.bands > INT_MAX / view_count) return SHADE_ERROR_CAPACITY;
    pieces = view_count * job.bands;
    job.results = (shade_result *)calloc((size_t)pieces, sizeof *job.results);
    if (job.results && views->in_studio && triangles > 0) {
        job.studio = light = open_studio(items, item_count, views, threads);
        if (!light) result = SHADE_ERROR_CAPACITY;
    }
    if (!job.results) return SHADE_ERROR_CAPACITY;
    if (!result) bands_run(threads, pieces, draw_piece, &job);
    for (int i = 0; i < pieces && !result; i++) result = job.results[i];
    free(job.results);
    close_studio(light);
    return (int)result;
}

/* ---- the equations over arrays --------------------------------------------------------------- */

enum { ROWS = 3 * SHADE_LANES };

/* Three rows from count points, and back; lanes from count on repeat the last point. */
static void rows_from(float *rows, const float *points, size_t count)
{
    SHADE_EACH_LANE(i)
    {
        size_t at = (size_t)i < count ? (size_t)i : count - 1;
        for (size_t k = 0; k < 3; k++) rows[k * SHADE_LANES + (size_t)i] = points[3 * at + k];
    }
}

static void rows_to(float *points, const float *rows, size_t count)
{
    for (size_t i = 0; i < count; i++)
        for (size_t k = 0; k < 3; k++) points[3 * i + k] = rows[k * SHADE_LANES + i];
}

/* shade_lit for count points: positions, normals and rgb have three floats a point.  albedo may be
   NULL. */
SHADEDEF void python_lit(const shade_lighting *lighting, const shade_material *material,
                         const float *eye, const float *const arrays[3], size_t count, float *rgb);
void python_lit(const shade_lighting *lighting, const shade_material *material, const float *eye,
                const float *const arrays[3], size_t count, float *rgb)
{
    float rows[3][ROWS], lit[ROWS];
    for (size_t i = 0; i < count; i += SHADE_LANES) {
        size_t n = count - i < SHADE_LANES ? count - i : SHADE_LANES;
        for (int a = 0; a < 3; a++)
            if (arrays[a]) rows_from(rows[a], arrays[a] + 3 * i, n);
        const shade_rows in = { .position = rows[0],
                                .normal = rows[1],
                                .albedo = arrays[2] ? rows[2] : NULL };
        shade_lit_lanes(lighting, material, shade_v3(eye[0], eye[1], eye[2]), &in, lit);
        rows_to(rgb + 3 * i, lit, n);
    }
}

/* shade_light_at for count points */
SHADEDEF void python_light_at(const shade_light *light, const float *points, size_t count,
                              float *amount, float *to_light, float *distance);
void python_light_at(const shade_light *light, const float *points, size_t count, float *amount,
                     float *to_light, float *distance)
{
    for (size_t i = 0; i < count; i++) {
        const float *p = points + 3 * i;
        shade_vec3 L;
        amount[i] = shade_light_at(light, shade_v3(p[0], p[1], p[2]), &L, &distance[i]);
        SHADE_MEMCPY(to_light + 3 * i, &L, sizeof L);
    }
}

/* shade_linear_from_srgb for count colours, in place */
SHADEDEF void python_linear(float *rgb, size_t count);
void python_linear(float *rgb, size_t count)
{
    for (size_t i = 0; i < count; i++, rgb += 3) {
        shade_vec3 c = shade_linear_from_srgb(shade_v3(rgb[0], rgb[1], rgb[2]));
        SHADE_MEMCPY(rgb, &c, sizeof c);
    }
}

/* ---- meshes, of scene/build.h ---------------------------------------------------------------- */

/* What a mesh becomes, which begins with what is drawn; *result says why it is NULL. */
SHADEDEF build *python_build(const build_asked *asked, int *result);
build *python_build(const build_asked *asked, int *result)
{
    build *b = (build *)calloc(1, sizeof *b);
    *result = (int)(b ? build_mesh(b, asked) : SHADE_ERROR_CAPACITY);
    if (!*result) return b;
    if (b) build_free(b);
    free(b);
    return NULL;
}

SHADEDEF void python_build_free(build *b);
void python_build_free(build *b)
{
    build_free(b);
    free(b);
}

NATIVE(local)
int python_local(const double *exact, size_t vertices, const uint32_t *corner, size_t corners,
                 float *local, double *origin);
int python_local(const double *exact, size_t vertices, const uint32_t *corner, size_t corners,
                 float *local, double *origin)
{
    return build_local(exact, vertices, corner, corners, local, origin);
}

/* Marks in seen, which is zero, what can be seen of a mesh; low and high, at low + 3: the box
   around that. */
SHADEDEF void python_seen(const float *at, size_t vertices, const uint32_t *corner, size_t corners,
                          uint8_t *seen, double *low);
void python_seen(const float *at, size_t vertices, const uint32_t *corner, size_t corners,
                 uint8_t *seen, double *low)
{
    build_seen(at, NULL, corner, corners, seen);
    build_box(at, NULL, seen, vertices, low, low + 3);
}

/* edges and normals have room for as many as the mesh has corners; count: how many edges there
   are. */
SHADEDEF int python_edges(const shade_mesh *mesh, shade_edge *edges, double *normals, int *count);
int python_edges(const shade_mesh *mesh, shade_edge *edges, double *normals, int *count)
{
    return (int)build_edges(mesh, edges, normals, count);
}

SHADEDEF int python_drawn_edges(const float *positions, const shade_edge *edges, int count,
                                const double *normals, const double *eye, int parallel,
                                double cosine, shade_vec3 *points);
int python_drawn_edges(const float *positions, const shade_edge *edges, int count,
                       const double *normals, const double *eye, int parallel, double cosine,
                       shade_vec3 *points)
{
    return build_drawn_edges(positions, edges, count, normals, eye, parallel, cosine, points);
}

/* ---- cuts, of draw/cut.h --------------------------------------------------------------------- */

typedef struct python_filling {
    double *quad; /* 8 numbers each */
    size_t count, room;
    double more, lowest;
} python_filling;

static int fill_between(void *user, const cut_crossing *c, const double *height)
{
    python_filling *f = (python_filling *)user;
    const double low = fmax(height[0] - f->more, f->lowest), high = height[1];
    const double quad[8] = { c[0].low, low, c[1].low, low, c[1].high, high, c[0].high, high };
    double *grown = (double *)mesh_grow(f->quad, f->count, &f->room, sizeof quad);
    if (!grown) return 1;
    f->quad = grown;
    memcpy(grown + 8 * f->count++, quad, sizeof quad);
    return 0;
}

/* Fills the outline of a cut, n pieces, each from two numbers to two, of a mesh of that extent, by
   quadrangles, which python_give frees, in rows that reach a little over each other, so that no
   pixel falls between them.  *state: 0, CUT_TORN or, which is not filled, CUT_OPEN; NULL: out of
   memory */
SHADEDEF double *python_fill(const double *pieces, size_t n, double extent, int *state,
                             size_t *count);
double *python_fill(const double *pieces, size_t n, double extent, int *state, size_t *count)
{
    python_filling f = { .quad = (double *)malloc(8 * sizeof *f.quad), .room = 1 };
    cut_outline o = { .edges = n, .edge = (cut_edge *)malloc((n + 1) * sizeof *o.edge) };
    double *height = NULL;
    size_t rows = 0;
    int failed = !f.quad || !o.edge;
    for (size_t i = 0; o.edge && i < n; i++)
        cut_piece(&o.edge[i], pieces + 4 * i, pieces + 4 * i + 2);
    *state = failed ? 0 : cut_state(&o, extent);
    if (!failed && n && *state != CUT_OPEN) {
        height = cut_rows(&o, 0, 0, 4000000, &rows);
        if (height) f.lowest = height[0];
        if (height) f.more = 2e-5 * (height[rows - 1] - height[0]);
        failed = !height || cut_fill(&o, height, rows, 1, fill_between, &f);
    }
    free(height);
    free(o.edge);
    *count = f.count;
    if (!failed) return f.quad;
    free(f.quad);
    return NULL;
}

SHADEDEF void python_give(void *memory);
void python_give(void *memory) { free(memory); }

/* ---- text ------------------------------------------------------------------------------------ */

/* The number of a letter in the font, -1: it has none */
static int text_find(int code)
{
    const int glyphs = (int)(sizeof font_glyphs / sizeof font_glyphs[0]);
    if (code == 0xB5) code = 0x3BC; /* micro, which is the Greek letter */
    for (int k = 0; k < glyphs; k++)
        if (font_glyphs[k].code == code) return k;
    return -1;
}

static int text_is_diameter(int code) { return code == 0xD8 || code == 0x2300; }

SHADEDEF int python_has_letter(int code);
int python_has_letter(int code) { return text_find(code) >= 0 || text_is_diameter(code); }

static float text_glyph(const shade_target *t, int code, float x, float y, float size)
{
    int k = text_find(code), shape = 0;
    if (k < 0) k = '?' - ' '; /* the table begins with those of ASCII */
    for (int i = 0; i < k; i++) shape += (font_glyphs[i].width * font_glyphs[i].height + 1) / 2;
    if (t->color) label_glyph(t, &font_glyphs[k], shape, x, y, size / 24, shade_v3(1, 1, 1));
    return size * (float)font_glyphs[k].advance / 240;
}

/* Writes text in white from x on, y its baseline, over bytes of RGBA that were 0, so that red tells
   how much of a pixel is covered; rgba NULL: nowhere.  size is the em in pixels.  Unlike label_set
   it has no signs for raised letters.  The sign of a diameter is made of O and /, what the font
   lacks is a question mark.  Returns the width. */
SHADEDEF float python_text(const char *text, float size, float x, float y, unsigned char *rgba,
                           int width, int height);
float python_text(const char *text, float size, float x, float y, unsigned char *rgba, int width,
                  int height)
{
    const shade_target t = { .color = rgba, .width = width, .height = height };
    const float start = x;
    while (*text) {
        const int code = label_code(&text), diameter = text_is_diameter(code);
        if (diameter) text_glyph(&t, '/', x + size / 8, y, size);
        x += text_glyph(&t, diameter ? 'O' : code, x, y, size);
    }
    return x - start;
}

/* ---- files of models ------------------------------------------------------------------------- */

/* Python takes a model for its mesh, which must be what it begins with. */
typedef char python_mesh_first[offsetof(model, mesh) == 0 ? 1 : -1];

/* Reads a file of any format from memory; what stands beside path, which may be NULL, describes its
   surfaces, and inflate unpacks archives.  name stands in messages, and its end tells the format
   where there is one.  Points without faces are vertices without indices.  Once *stop is set, which
   may be NULL, the reading ends.  Returns NULL with a sentence in error. */
SHADEDEF model *python_read(const void *bytes, size_t size, const char *name, const char *path,
                            zip_inflate *inflate, char *error, size_t room,
                            const volatile int *stop);
model *python_read(const void *bytes, size_t size, const char *name, const char *path,
                   zip_inflate *inflate, char *error, size_t room, const volatile int *stop)
{
    static const model empty;
    const model_request q = { .error = error, .error_size = room, .stop = stop };
    model *m = (model *)calloc(1, sizeof *m), said = empty;
    said.points_wanted = said.polish_wanted = 1;
    said.path = path;
    said.beside = path ? model_load_file : NULL;
    said.inflate = inflate;
    if (m && !model_read_with(bytes, size, name, m, &q, &said)) {
        if (path) model_read_libraries(path, m);
        return m;
    }
    free(m);
    return NULL;
}

/* 1: the name is that of a file in the model's folder or below. */
SHADEDEF int python_beside(const char *name);
int python_beside(const char *name) { return model_is_beside(name); }

SHADEDEF void python_unload(model *m);
void python_unload(model *m)
{
    for (int i = 0; m && i < m->picture_count; i++) m->picture[i].pixels = NULL; /* the caller's */
    if (m) model_free(m);
    free(m);
}

/* Three numbers that belong to each position, so that they are where the file has them */
SHADEDEF const double *python_origin(const model *m);
const double *python_origin(const model *m) { return m->origin; }

/* 1: the mesh has a normal at each vertex, all of the file. */
SHADEDEF int python_normals(const model *m);
int python_normals(const model *m) { return m->normals_given && m->physical; }

/* What the picture lacks or shows otherwise than the file, with names before; "": nothing */
SHADEDEF const char *python_warning(const model *m);
const char *python_warning(const model *m) { return m->warning; }

/* The upright axis, 0 .. 5 for x y z -x -y -z: that of the format, or a guess as in the programs */
SHADEDEF int python_upright(const model *m);
int python_upright(const model *m)
{
    const int usual = m->z_up ? 2 : 1;
    return m->up_told ? usual : stand_guess(&m->mesh, usual);
}

/* ---- their pictures -------------------------------------------------------------------------- */

/* They are listed, decoded by the caller, set and heeded, before the caller asks for the parts. */
typedef struct python_picture {
    const char *name;  /* in the file */
    const char *kind;  /* what the file says that it is, image/png or image/jpeg; "": nothing */
    const void *bytes; /* a picture inside the file, not decoded; NULL: it is beside the file */
    size_t size;
    int wrap[2];
    int squares; /* texels are to be seen as such */
    int colors;  /* 0: a relief, or metal and roughness */
} python_picture;

/* Lists the pictures, and returns their number; from *beside on they are beside the file. */
NATIVE(pictures) int python_pictures(model *m, int *beside);
int python_pictures(model *m, int *beside)
{
    *beside = list_pictures(m);
    return m->picture_count;
}

/* 1: faces show the picture, or what it says of their surface. */
NATIVE(picture_shown)
int python_picture_shown(const model *m, int i);
int python_picture_shown(const model *m, int i)
{
    for (int k = 0; k < m->part_count && m->surface_count && m->mesh.texcoords; k++) {
        const model_surface *s = &m->surface[m->part[k].surface];
        if (s->picture == i || s->relief.picture == i || s->glow_picture == i || s->polish == i)
            return 1;
    }
    return 0;
}

NATIVE(picture_of) void python_picture_of(const model *m, int i, python_picture *out);
void python_picture_of(const model *m, int i, python_picture *out)
{
    const model_picture *p = &m->picture[i];
    *out = (python_picture){ p->name,
                             p->kind,
                             p->bytes,
                             p->size,
                             { (int)p->map.wrap_u, (int)p->map.wrap_v },
                             p->map.filter == SHADE_FILTER_NEAREST,
                             p->what == PICTURE_COLORS };
}

/* Sets the pixels, RGBA, of a picture that was decoded; they stay yours, until python_heed_pictures
   has read them. */
NATIVE(picture_set)
void python_picture_set(model *m, int i, const uint8_t *rgba, int width, int height);
void python_picture_set(model *m, int i, const uint8_t *rgba, int width, int height)
{
    picture_fill(&m->picture[i], (void *)(uintptr_t)rgba, width, height);
}

NATIVE(heed_pictures) void python_heed_pictures(model *m);
void python_heed_pictures(model *m)
{
    heed_pictures(m);
    relief_prepare(m, 1);
}

/* ---- PNG files and their comparison ---------------------------------------------------------- */

/* room for a png, which Python does not look into */
typedef char python_png_room[sizeof(png) <= 256 ? 1 : -1];

/* Finds what a PNG has; facts: width, height, the bytes that are packed and those that they unpack
   to.  Returns what is wrong, or NULL. */
NATIVE(png_open)
const char *python_png_open(png *p, const unsigned char *bytes, size_t size, double facts[4]);
const char *python_png_open(png *p, const unsigned char *bytes, size_t size, double facts[4])
{
    const char *wrong = png_open(p, bytes, size);
    facts[0] = p->width;
    facts[1] = p->height;
    facts[2] = (double)p->packed;
    facts[3] = wrong ? 0 : (double)png_bytes(p);
    return wrong;
}

NATIVE(png_gather) void python_png_gather(const png *p, unsigned char *out);
void python_png_gather(const png *p, unsigned char *out) { png_gather(p, out); }

SHADEDEF const char *python_png_rgba(const png *p, unsigned char *raw, uint8_t *rgba);
const char *python_png_rgba(const png *p, unsigned char *raw, uint8_t *rgba)
{
    return png_rgba(p, raw, rgba);
}

NATIVE(png_grey) const char *python_png_grey(const png *p, unsigned char *raw, uint16_t *out);
const char *python_png_grey(const png *p, unsigned char *raw, uint16_t *out)
{
    return png_grey(p, raw, out);
}

NATIVE(png_lines)
size_t python_png_lines(const uint8_t *rgba, int width, int height, int *kind, unsigned char *out);
size_t python_png_lines(const uint8_t *rgba, int width, int height, int *kind, unsigned char *out)
{
    return png_lines(rgba, width, height, kind, out);
}

NATIVE(png_lines16)
size_t python_png_lines16(const uint16_t *grey, int width, int height, unsigned char *out);
size_t python_png_lines16(const uint16_t *grey, int width, int height, unsigned char *out)
{
    return png_lines16(grey, width, height, out);
}

NATIVE(png_file)
size_t python_png_file(int width, int height, int kind, const unsigned char *packed, size_t size,
                       unsigned char *out);
size_t python_png_file(int width, int height, int kind, const unsigned char *packed, size_t size,
                       unsigned char *out)
{
    return png_file(width, height, kind, packed, size, out);
}

/* Depths as grey, or back where depth is to be written: to_depth 1 */
NATIVE(depth_numbers)
int python_depth_numbers(core_refusal *r, const char *argument, float *depth, size_t n, double unit,
                         uint16_t *grey, int to_depth);
int python_depth_numbers(core_refusal *r, const char *argument, float *depth, size_t n, double unit,
                         uint16_t *grey, int to_depth)
{
    return to_depth ? numbers_to_depth(r, grey, n, unit, depth)
                    : numbers_from_depth(r, argument, depth, n, unit, grey);
}

/* Numbers of objects as grey, the first of step for each pixel; step 0: back */
NATIVE(id_numbers)
int python_id_numbers(core_refusal *r, const char *argument, int32_t *ids, size_t n, size_t step,
                      uint16_t *grey);
int python_id_numbers(core_refusal *r, const char *argument, int32_t *ids, size_t n, size_t step,
                      uint16_t *grey)
{
    if (step) return numbers_from_ids(r, argument, ids, n, step, grey);
    numbers_to_ids(grey, n, ids);
    return 0;
}

SHADEDEF void python_apart(const uint8_t *a, const uint8_t *b, size_t n, int32_t *out);
void python_apart(const uint8_t *a, const uint8_t *b, size_t n, int32_t *out)
{
    apart_bytes(a, b, n, out);
}

SHADEDEF int python_texture_levels(shade_texture *map, shade_texture *levels, void *memory,
                                   size_t bytes, int squares);
int python_texture_levels(shade_texture *map, shade_texture *levels, void *memory, size_t bytes,
                          int squares)
{
    return (int)texture_levels(map, levels, memory, bytes, squares);
}

/* 1: the picture of a relief holds heights, and no normals. */
SHADEDEF int python_heights(const uint8_t *rgba, int width, int height);
int python_heights(const uint8_t *rgba, int width, int height)
{
    model_picture p = { .pixels = (void *)(uintptr_t)rgba };
    p.map.width = width;
    p.map.height = height;
    picture_look_at_relief(&p);
    return p.heights;
}

/* A run of triangles of one surface */
typedef struct python_part {
    int first, count; /* of the indices */
    int surface, set; /* set: the file says something of it */
    int opaque;       /* the alpha of the map is ignored */
    int blended;
    float transparency, alpha_cutoff;
    shade_material material;
    float metal, rough;    /* of the mirror image of the studio; rough 0: by the shininess */
    int map, relief, glow; /* numbers of pictures, -1: none */
    float relief_strength; /* as in a model_relief */
    shade_vec3 glow_factor;
    int unlit; /* as of a look */
} python_part;

/* Writes run i and returns how many there are; with part NULL it only counts. */
SHADEDEF int python_part_of(const model *m, int i, python_part *part);
int python_part_of(const model *m, int i, python_part *part)
{
    const int mapped = m->mesh.texcoords != NULL;
    const model_surface *s;
    if (!part || i < 0 || i >= m->part_count) return m->part_count;
    *part = (python_part){ .first = m->part[i].first, .count = m->part[i].count };
    part->map = part->relief = part->glow = -1;
    if (!m->surface_count) return m->part_count;
    s = &m->surface[m->part[i].surface];
    part->surface = m->part[i].surface;
    part->set = s->set;
    part->opaque = s->opaque;
    part->blended = s->blended;
    part->transparency = s->transparency >= 1 ? 0 : s->transparency;
    part->alpha_cutoff = s->alpha_cutoff;
    part->material = s->material;
    part->metal = s->metal;
    part->rough = s->rough;
    part->relief_strength = s->relief.strength;
    part->glow_factor = s->glow;
    part->unlit = s->unlit;
    if (!mapped) return m->part_count;
    part->map = s->picture;
    part->relief = s->relief.picture;
    part->glow = s->glow_picture;
    return m->part_count;
}

/* ---- materials of other programs, of elsewhere/words.h --------------------------------------- */

/* Row i: "name(numbers)" of a program that has a material, in name and numbers; NULL: no more */
NATIVE(look_name) const char *python_look_name(int i, const char **numbers);
const char *python_look_name(int i, const char **numbers)
{
    for (const elsewhere_row *row = elsewhere_rows; row->name; row++) {
        if (!row->look || i--) continue;
        if (numbers) *numbers = row->numbers;
        return row->name;
    }
    return NULL;
}

/* The material of text such as "vtk(specular=.5, power=30)", with the model and flags of its light
   in lit.  Returns 0, or 1 with a sentence in said, of room bytes. */
NATIVE(look)
int python_look(const char *text, shade_material *material, uint32_t *lit, char *said, int room);
int python_look(const char *text, shade_material *material, uint32_t *lit, char *said, int room)
{
    shade_model kind = SHADE_MODEL_BLINN_PHONG;
    unsigned flags = 0;
    const int failed = elsewhere_apply_text(text, material, &kind, &flags, said, (size_t)room);
    lit[0] = kind;
    lit[1] = flags;
    return failed;
}

/* ---- arguments and cameras, of core/ --------------------------------------------------------- */

NATIVE(color)
int python_color(core_refusal *r, const char *argument, const char *word, double *rgb);
int python_color(core_refusal *r, const char *argument, const char *word, double *rgb)
{
    return core_color(r, argument, word, rgb);
}

NATIVE(colors)
int python_colors(core_refusal *r, const char *argument, const double *rows, size_t count,
                  int columns, int whole, int bytes, float *out, double *alpha);
int python_colors(core_refusal *r, const char *argument, const double *rows, size_t count,
                  int columns, int whole, int bytes, float *out, double *alpha)
{
    return core_colors(r, argument, rows, count, columns, whole, bytes, out, alpha);
}

/* Returns the indices that were made, -1: refused */
NATIVE(faces)
int python_faces(core_refusal *r, const char *argument, const double *faces, size_t rows,
                 int columns, int vertices, uint32_t *out);
int python_faces(core_refusal *r, const char *argument, const double *faces, size_t rows,
                 int columns, int vertices, uint32_t *out)
{
    return (int)core_faces(r, argument, faces, rows, columns, vertices, out);
}

/* x: eye, target, up; fov, aspect, near, far */
NATIVE(look_at) int python_look_at(core_refusal *r, const double *x, core_camera *out);
int python_look_at(core_refusal *r, const double *x, core_camera *out)
{
    return core_look_at(r, x, x + 3, x + 6, x[9], x[10], x[11], x[12], out);
}

NATIVE(opencv)
int python_opencv(core_refusal *r, const double *K, const double *extrinsics, int width, int height,
                  double near, double far, core_camera *out);
int python_opencv(core_refusal *r, const double *K, const double *extrinsics, int width, int height,
                  double near, double far, core_camera *out)
{
    return core_opencv(r, K, extrinsics, width, height, near, far, out);
}

NATIVE(opengl)
int python_opengl(core_refusal *r, const double *projection, const double *pose, core_camera *out);
int python_opengl(core_refusal *r, const double *projection, const double *pose, core_camera *out)
{
    return core_opengl(r, projection, pose, out);
}

NATIVE(range_of)
int python_range_of(core_refusal *r, const char *argument, const double *projection,
                    core_range *out);
int python_range_of(core_refusal *r, const char *argument, const double *projection,
                    core_range *out)
{
    return core_range_of(r, argument, projection, out);
}

NATIVE(view_name) const char *python_view_name(int i, double *angles);
const char *python_view_name(int i, double *angles)
{
    return core_view_name(i, angles, angles + 1);
}

/* out: the way toward the eye, and the way up */
SHADEDEF void python_direction(double azimuth, double elevation, int up, double *out);
void python_direction(double azimuth, double elevation, int up, double *out)
{
    core_direction(azimuth, elevation, up, out, out + 3);
}

NATIVE(fit_points)
int python_fit(core_refusal *r, const core_side *side, const float *points, size_t count,
               core_camera *out);
int python_fit(core_refusal *r, const core_side *side, const float *points, size_t count,
               core_camera *out)
{
    core_cloud cloud;
    if (core_cloud_open(r, side, &cloud)) return r->code;
    core_cloud_add(&cloud, points, NULL, count, NULL);
    core_fit(&cloud, side, out);
    return 0;
}

SHADEDEF int python_eye(const double *view, int parallel, const double *pose, double *eye);
int python_eye(const double *view, int parallel, const double *pose, double *eye)
{
    return core_eye(view, parallel, pose, eye);
}

SHADEDEF void python_studio(const float *points, size_t count, const double *view, int up,
                            double *out);
void python_studio(const float *points, size_t count, const double *view, int up, double *out)
{
    core_ball ball = { .some = 0 };
    core_ball_add(&ball, points, NULL, count, NULL);
    core_ball_reach(&ball, points, NULL, count, NULL);
    core_studio(&ball, view, up, out);
}

/* Meshes in their places: poses become those of a world that counts from an origin. */
NATIVE(place_all) void python_place_all(core_place *places, int count, double *origin);
void python_place_all(core_place *places, int count, double *origin)
{
    core_place_all(places, count, origin);
}

/* ---- cameras of renderer.h ------------------------------------------------------------------- */

SHADEDEF renderer_scene *python_scene_open(void);
renderer_scene *python_scene_open(void) { return renderer_scene_open(); }

SHADEDEF void python_scene_close(renderer_scene *scene);
void python_scene_close(renderer_scene *scene) { renderer_scene_close(scene); }

NATIVE(scene_mesh)
int python_scene_mesh(renderer_scene *scene, int number, const shade_mesh *mesh, int smooth,
                      const double *origin);
int python_scene_mesh(renderer_scene *scene, int number, const shade_mesh *mesh, int smooth,
                      const double *origin)
{
    return renderer_set_mesh(scene, number, mesh, smooth, origin);
}

NATIVE(scene_heights)
int python_scene_heights(renderer_scene *scene, int number, const heights *h);
int python_scene_heights(renderer_scene *scene, int number, const heights *h)
{
    return heights_set(scene, number, h);
}

/* 1: done, 0: out of memory, -1: the mesh has other counts, -2: a position is not finite.  Normals
   that are given are directed where they stand. */
NATIVE(scene_deform)
int python_scene_deform(renderer_scene *scene, int number, const renderer_moved *m);
int python_scene_deform(renderer_scene *scene, int number, const renderer_moved *m)
{
    const shade_mesh moved = { .positions = m->positions,
                               .vertex_count = m->vertex_count,
                               .indices = m->faces,
                               .index_count = m->index_count };
    if (m->given && build_direct(&moved, m->given)) return 0;
    return renderer_deform(scene, number, m);
}

NATIVE(scene_texture)
int python_scene_texture(renderer_scene *scene, int number, const renderer_image *image);
int python_scene_texture(renderer_scene *scene, int number, const renderer_image *image)
{
    return renderer_set_texture(scene, number, image);
}

NATIVE(scene_add)
int python_scene_add(renderer_scene *scene, const renderer_object *records, int count);
int python_scene_add(renderer_scene *scene, const renderer_object *records, int count)
{
    return renderer_add(scene, records, count);
}

/* 1: done, 0: out of memory, -1: there is no such number; count 0 takes the object away. */
NATIVE(scene_put)
int python_scene_put(renderer_scene *scene, int number, const renderer_object *records, int count);
int python_scene_put(renderer_scene *scene, int number, const renderer_object *records, int count)
{
    return renderer_put_object(scene, number, records, count);
}

NATIVE(scene_put_all)
int python_scene_put_all(renderer_scene *scene, const renderer_object *records, int count);
int python_scene_put_all(renderer_scene *scene, const renderer_object *records, int count)
{
    return renderer_put_all(scene, records, count);
}

NATIVE(scene_records)
int python_scene_records(const renderer_scene *s, int number, renderer_object *to, int room);
int python_scene_records(const renderer_scene *s, int number, renderer_object *to, int room)
{
    return renderer_records(s, number, to, room);
}

/* The next number, which is made at_least this */
NATIVE(scene_next) int python_scene_next(renderer_scene *scene, int at_least);
int python_scene_next(renderer_scene *scene, int at_least)
{
    return renderer_next(scene, at_least);
}

NATIVE(scene_hold) int python_scene_hold(renderer_scene *scene);
int python_scene_hold(renderer_scene *scene) { return renderer_hold(scene); }

NATIVE(scene_done) void python_scene_done(renderer_scene *scene);
void python_scene_done(renderer_scene *scene) { renderer_done(scene); }

NATIVE(not_rigid) int python_not_rigid(const double *rows, int count);
int python_not_rigid(const double *rows, int count) { return renderer_not_rigid(rows, count); }

NATIVE(scene_pose)
int python_scene_pose(renderer_scene *scene, const int32_t *numbers, const double *rows, int count);
int python_scene_pose(renderer_scene *scene, const int32_t *numbers, const double *rows, int count)
{
    return renderer_pose(scene, numbers, rows, count);
}

NATIVE(scene_light)
void python_scene_light(renderer_scene *scene, const shade_light *lights, const double *places,
                        int count, const float *ambient, int shadows);
void python_scene_light(renderer_scene *scene, const shade_light *lights, const double *places,
                        int count, const float *ambient, int shadows)
{
    renderer_set_lights(scene, lights, places, count, renderer_get(ambient), shadows);
}

/* colors: of the background 4 numbers, of the sky below and above 3 each */
NATIVE(scene_behind)
void python_scene_behind(renderer_scene *scene, int sky, int texture, const float *colors);
void python_scene_behind(renderer_scene *scene, int sky, int texture, const float *colors)
{
    renderer_around a = { .sky = sky, .sky_texture = texture };
    a.background = shade_v4(colors[0], colors[1], colors[2], colors[3]);
    a.sky_low = renderer_get(colors + 4);
    a.sky_high = renderer_get(colors + 7);
    renderer_set_behind(scene, &a);
}

NATIVE(renderer_open) renderer *python_renderer_open(void);
renderer *python_renderer_open(void) { return renderer_open(); }

NATIVE(renderer_close) void python_renderer_close(renderer *r);
void python_renderer_close(renderer *r) { renderer_close(r); }

SHADEDEF int python_renderer_draw(renderer *const *r, int renderers, const renderer_scene *scene,
                                  const renderer_picture *pictures, int count,
                                  const volatile int *stop);
int python_renderer_draw(renderer *const *r, int renderers, const renderer_scene *scene,
                         const renderer_picture *pictures, int count, const volatile int *stop)
{
    return (int)renderer_draw(r, renderers, scene, pictures, count, stop);
}

/* ---- scenes of MuJoCo, of core/mjv.h --------------------------------------------------------- */

NATIVE(mjv_texture)
int python_mjv_texture(renderer_scene *scene, int number, const uint8_t *texels, int width,
                       int height, int channels, int type);
int python_mjv_texture(renderer_scene *scene, int number, const uint8_t *texels, int width,
                       int height, int channels, int type)
{
    return mjv_texture(scene, number, texels, width, height, channels, type);
}

NATIVE(mjv_mesh)
int python_mjv_mesh(renderer_scene *scene, int number, const mjv_part *part);
int python_mjv_mesh(renderer_scene *scene, int number, const mjv_part *part)
{
    return mjv_mesh(scene, number, part);
}

NATIVE(mjv_records)
int python_mjv_records(const double *geoms, int count, int solid, renderer_object *out,
                       int32_t *pairs);
int python_mjv_records(const double *geoms, int count, int solid, renderer_object *out,
                       int32_t *pairs)
{
    return mjv_records(geoms, count, solid, out, pairs);
}

NATIVE(mjv_lights)
int python_mjv_lights(core_refusal *r, renderer_scene *scene, const double *lamps, int count,
                      int shadows);
int python_mjv_lights(core_refusal *r, renderer_scene *scene, const double *lamps, int count,
                      int shadows)
{
    return mjv_lights(r, scene, lamps, count, shadows);
}

NATIVE(mjv_aim) void python_mjv_aim(const double *cameras, double aspect, mjv_seen *out);
void python_mjv_aim(const double *cameras, double aspect, mjv_seen *out)
{
    mjv_aim(cameras, aspect, out);
}

/* The sizes that the twins of these structs must have */
SHADEDEF size_t python_size(int which);
size_t python_size(int which)
{
    static const size_t size[] = {
        sizeof(shade_mesh),     sizeof(shade_draw_state), sizeof(python_item),
        sizeof(python_view),    sizeof(shade_lighting),   sizeof(shade_texture),
        sizeof(shade_light),    sizeof(shade_chunk),      sizeof(python_part),
        sizeof(renderer_image), sizeof(renderer_object),  sizeof(renderer_picture),
        sizeof(python_picture), sizeof(core_refusal),     sizeof(core_side),
        sizeof(core_camera),    sizeof(build_asked),      sizeof(heights),
        sizeof(mjv_part)
    };
    return which >= 0 && which < (int)(sizeof size / sizeof *size) ? size[which] : 0;
}
