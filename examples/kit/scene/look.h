/* look.h - draws models in the light of the studio, or of lamps alone: the shaders of programs and
   packages, and the order of a model's parts.

       if (exhibit_open(&e, &model, &studio, &options, eye)) ...                  (out of memory)
       exhibit_draw(&e, &rows, view, projection, samples);         (for each band of the picture)
       exhibit_close(&e); */
#ifndef MODEL_LOOK_H
#define MODEL_LOOK_H

#include "relief.h"
#include "../draw/section.h"
#include "studio.h"
#include "surfaces.h"

typedef float look_rows[3][SHADE_LANES];
struct look;
/* Sees fragments before they are stored: what is discarded has out->discard set. */
typedef void look_note(const struct look *k, const shade_fragments *in, const shade_colors *out);

/* Uniforms of both shaders, for one surface.  A mesh that is not placed stands in the studio as it
   is; then to_world, normals and to_studio do not count, and light may be computed by vertex. */
typedef struct look {
    const studio *studio; /* NULL: shadows and mirrors are 0 */
    const shade_mesh *mesh;
    const shade_texture *map;      /* NULL: none */
    const shade_texture *glow_map; /* what shines by itself; NULL: none */
    shade_vec3 glow;
    relief relief;
    shade_material material;
    float metal, rough; /* the part of the reflection that has the surface's colour; its blur */
    shade_lighting lighting;
    shade_light tone_lamp; /* of cool-to-warm */
    shade_raster raster;
    shade_mat4 clip_from_mesh;
    int placed;                  /* the mesh has a place of its own */
    shade_mat4 to_world;         /* of positions */
    shade_mat3 normals;          /* to the world */
    const shade_mat4 *to_studio; /* from the world; NULL: the studio is there, or there is none */
    shade_vec3 eye;              /* in the studio, without one in the world */
    float alpha, alpha_cutoff;   /* where the map has less alpha than alpha_cutoff are holes */
    int per_vertex, map_is_opaque, shadows, mirrors;
    int samples;     /* along the edge of a pixel, to share the lamps; 0: each asks all */
    int clipped;     /* light above SHOULDER is not bent toward white */
    int aimed;       /* it is known where in the picture chunks lie */
    look_note *note; /* NULL: none */
    const void *noted;
    int unlit;      /* no lamp changes its colour: that of map, vertices and k_d */
    int plain;      /* colours of vertices do not count */
    int notes_only; /* only note is wanted */
} look;

/* Varyings: P, N, then the albedo of the vertex and the place in the pictures, where there are any.
   Where light is computed per vertex, it takes the place of P. */
enum { LOOK_P, LOOK_N = 3, LOOK_REST = 6 };

static int look_has_pictures(const look *k) { return k->map || k->relief.map || k->glow_map; }

static const float *look_colors(const look *k) { return k->plain ? NULL : k->mesh->colors; }

static int look_uv(const look *k) { return look_colors(k) ? LOOK_REST + 3 : LOOK_REST; }

/* Emission and cool-to-warm tones have no shadows. */
static int look_has_shadows(const model_options *o)
{
    return o->model != SHADE_MODEL_EMISSIVE && o->model != SHADE_MODEL_COOL_TO_WARM;
}

/* Bends light above SHOULDER toward white instead of clipping it; 3 becomes 1. */
#define SHOULDER 0.6f
static float shoulder(float light)
{
    const float over = (light - SHOULDER) / 0.5f;
    return light > SHOULDER ? SHOULDER + 0.5f * over / (1 + over) : light;
}

static float component(shade_vec3 v, int a) { return a == 0 ? v.x : a == 1 ? v.y : v.z; }

/* Models without a highlight reflect nothing. */
static int look_mirrors(const model_options *o)
{
    return o->model == SHADE_MODEL_BLINN_PHONG || o->model == SHADE_MODEL_PHONG;
}

/* The part of the studio's light that a surface of this albedo reflects toward the eye, by
   component: 4 % seen from the front, metal its colour, and more at grazing angles. */
static shade_vec3 look_fresnel(const look *k, shade_vec3 albedo, float cosine)
{
    const float g = 1 - fmaxf(0.1f, cosine), grazing = g * g * g * g * g * (1 - k->rough);
    const shade_vec3 plain = shade_v3(0.04f, 0.04f, 0.04f), white = shade_v3(1, 1, 1);
    shade_vec3 metal = shade_mul(albedo, k->material.ambient), front;
    metal = shade_v3(fmaxf(metal.x, 0.04f), fmaxf(metal.y, 0.04f), fmaxf(metal.z, 0.04f));
    front = shade_lerp(plain, metal, k->metal);
    return shade_add(front, shade_scale(shade_sub(white, front), grazing));
}

/* Some lanes of a packet, a block at most, and the lamps that they ask: one in so many */
typedef struct look_share {
    int lane[STUDIO_BLOCK], count, first, shares;
} look_share;

/* What the studio sends: the light of its sky, its mirror image, the part of the large lamp */
typedef struct look_sent {
    look_rows sky, mirror;
    float visibility[2 * SHADE_LANES]; /* of the large lamp, and of the other one: 1 */
} look_sent;

/* What the studio sends to the lanes of a share */
static void look_studio(const look *k, const float *P, const float *N, const float *albedo,
                        const look_share *s, look_sent *out)
{
    studio_points p = studio_nowhere;
    studio_rows E;
    shade_vec3 V[STUDIO_BLOCK], R[STUDIO_BLOCK];
    float open[STUDIO_BLOCK], lamp[STUDIO_BLOCK];
    STUDIO_EACH(i)
    {
        const int l = s->lane[i < s->count ? i : s->count - 1];
        const shade_vec3 point = lane(P, l), normal = shade_normalize(lane(N, l));
        V[i] = shade_normalize(shade_sub(k->eye, point));
        R[i] = shade_mirror(V[i], normal);
        studio_put(p.P, i, point);
        studio_put(p.N, i, normal);
        studio_put(p.R, i, R[i]);
    }
    studio_sky(k->studio, s->first, s->shares, &p, E, open);
    studio_lamp(k->studio, s->first, s->shares, &p, lamp);
    for (int i = 0; i < s->count; i++) {
        const int l = s->lane[i];
        const shade_vec3 own = albedo ? lane(albedo, l) : shade_v3(1, 1, 1);
        const shade_vec3 normal = shade_v3(p.N[0][i], p.N[1][i], p.N[2][i]);
        lane_put(out->sky[0], l, shade_v3(E[0][i], E[1][i], E[2][i]));
        out->visibility[l] = lamp[i];
        if (!k->mirrors) continue;
        lane_put(out->mirror[0], l,
                 shade_mul(look_fresnel(k, own, shade_dot(normal, V[i])),
                           studio_mirror(k->studio, R[i], k->rough, open[i], lamp[i])));
    }
}

/* What the studio sends to count lanes.  Neighbours among the samples of a pixel ask a share of the
   lamps each, by their place in the picture alone: bands and strips have the same bits. */
static void look_send(const look *k, const float *P, const float *N, const float *albedo, int count,
                      const shade_fragments *in, look_sent *out)
{
    const int shares = in && k->samples > 1 && !STUDIO_WHOLE ? STUDIO_SHARES : 1;
    for (int first = 0; first < shares; first++) {
        look_share s = { .first = first, .shares = shares };
        for (int i = 0; i < count; i++) {
            const int own = shares > 1 ? ((int)in->x[i] & 1) | ((int)in->y[i] & 1) << 1 : 0;
            if (own == first) s.lane[s.count++] = i;
            if (s.count < STUDIO_BLOCK && (i < count - 1 || !s.count)) continue;
            look_studio(k, P, N, albedo, &s, out);
            s.count = 0;
        }
    }
}

/* The light that leaves P toward the eye; only the first count lanes are computed.  albedo NULL: 1.
   glow, which may be NULL, is the light that P sends by itself.  in: where the lanes lie in the
   picture; NULL: they are vertices. */
static void look_light(const look *k, const float *P, const float *N, const float *albedo,
                       const float *glow, int count, const shade_fragments *in, look_rows out)
{
    look_sent sent = { .sky = { { 0 } } };
    shade_rows rows = { .position = P, .normal = N, .albedo = albedo };
    for (int a = 0; a < 3 && k->unlit; a++) SHADE_EACH_LANE(i)
        {
            out[a][i] = component(k->material.diffuse, a);
            out[a][i] *= albedo ? albedo[i + a * SHADE_LANES] : 1;
        }
    if (k->unlit) return;
    if (k->shadows) {
        look_send(k, P, N, albedo, count, in, &sent);
        for (int i = count; i < 2 * SHADE_LANES; i++) sent.visibility[i] = 1;
        rows.visibility = sent.visibility;
    }
    shade_lit_lanes(&k->lighting, &k->material, k->eye, &rows, out[0]);
    for (int a = 0; a < 3 && k->shadows; a++) {
        const float ambient = component(k->material.ambient, a);
        float *s = sent.sky[a];
        SHADE_EACH_LANE(i) { s[i] *= ambient; }
        if (albedo) SHADE_EACH_LANE(i)
            {
                s[i] *= albedo[i + a * SHADE_LANES];
            }
        SHADE_EACH_LANE(i) { out[a][i] = out[a][i] + sent.mirror[a][i] + s[i]; }
    }
    for (int a = 0; a < 3 && glow; a++) SHADE_EACH_LANE(i)
        {
            out[a][i] += glow[i + a * SHADE_LANES];
        }
    for (int a = 0; a < 3 && !k->clipped; a++) SHADE_EACH_LANE(i)
        {
            out[a][i] = shoulder(out[a][i]);
        }
}

static void look_fetch(const float *from, int width, const shade_vertex_ids *in, float *rows)
{
    for (int i = 0; i < SHADE_LANES; i++) {
        const float *p = from + (size_t)width * in->index[i];
        for (int a = 0; a < width; a++) rows[a * SHADE_LANES + i] = p[a];
    }
}

/* Positions and normals of a mesh with a place of its own, in the world.  Where a relief will bend
   the normals, they stay as they are: they are turned after that. */
static void look_place(const look *k, look_rows p, look_rows n,
                       float (*SHADE_RESTRICT P)[SHADE_LANES],
                       float (*SHADE_RESTRICT N)[SHADE_LANES])
{
    const shade_mat4 to_world = k->to_world;
    const shade_mat3 normals = k->normals;
    SHADE_EACH_LANE(i)
    {
        const shade_vec4 world =
            shade_mat4_transform(to_world, shade_v4(p[0][i], p[1][i], p[2][i], 1));
        lane_put(P[0], i, shade_v3(world.x, world.y, world.z));
    }
    if (k->relief.map)
        SHADE_MEMCPY(N, n, sizeof(look_rows));
    else
        SHADE_EACH_LANE(i)
        {
            lane_put(N[0], i, shade_normalize(shade_mat3_transform(normals, lane(n[0], i))));
        }
}

static void look_vertex(const void *uniforms, const shade_vertex_ids *SHADE_RESTRICT in,
                        shade_vertices *SHADE_RESTRICT out)
{
    const look *k = (const look *)uniforms;
    const shade_mesh *m = k->mesh;
    const float *colors = look_colors(k);
    look_rows p, n;
    look_fetch(m->positions, 3, in, p[0]);
    look_fetch(m->normals, 3, in, n[0]);
    SHADE_EACH_LANE(i)
    {
        const shade_vec4 at = { p[0][i], p[1][i], p[2][i], 1 };
        lane_put4(out->clip[0], i, shade_mat4_transform(k->clip_from_mesh, at));
    }
    if (colors) look_fetch(colors, 3, in, out->varying[LOOK_REST]);
    if (look_has_pictures(k)) look_fetch(m->texcoords, 2, in, out->varying[look_uv(k)]);
    if (k->per_vertex) {
        look_rows light;
        look_light(k, p[0], n[0], colors ? out->varying[LOOK_REST] : NULL, NULL, in->count, NULL,
                   light);
        SHADE_MEMCPY(out->varying[LOOK_P], light, sizeof light);
    } else if (k->placed)
        look_place(k, p, n, out->varying + LOOK_P, out->varying + LOOK_N);
    else {
        SHADE_MEMCPY(out->varying[LOOK_P], p, sizeof p);
        SHADE_MEMCPY(out->varying[LOOK_N], n, sizeof n);
    }
}

/* Fragments as the light sees them.  Back faces are lit as front faces are; front faces keep their
   normals, which lean away from the viewer on the outline of a coarse mesh. */
static void look_surface(const look *k, const shade_fragments *in, look_rows P, look_rows N)
{
    SHADE_MEMCPY(P, in->varying[LOOK_P], sizeof(look_rows));
    SHADE_MEMCPY(N, in->varying[LOOK_N], sizeof(look_rows));
    if (k->relief.map) relief_bend(&k->relief, k->mesh, in, look_uv(k), N);
    for (int i = 0; i < in->count && k->placed && k->relief.map; i++)
        lane_put(N[0], i, shade_normalize(shade_mat3_transform(k->normals, lane(N[0], i))));
    for (int a = 0; a < 3; a++) SHADE_EACH_LANE(i)
        {
            N[a][i] = in->front[i] ? N[a][i] : -N[a][i];
        }
    if (k->to_studio) SHADE_EACH_LANE(i)
        {
            lane_put(P[0], i, shade_mat4_transform_point(*k->to_studio, lane(P[0], i)));
            lane_put(N[0], i, shade_mat4_transform_direction(*k->to_studio, lane(N[0], i)));
        }
}

/* The light of fragments; texel is NULL where there is no map. */
static void look_color(const look *k, const shade_fragments *in, look_rows texel, look_rows out)
{
    const float(*own)[SHADE_LANES] = look_colors(k) ? in->varying + LOOK_REST : NULL;
    look_rows P, N, albedo, glow;
    for (int a = 0; a < 3 && own && texel && !k->per_vertex; a++) SHADE_EACH_LANE(i)
        {
            albedo[a][i] = own[a][i] * texel[a][i];
        }
    if (k->glow_map)
        glow_light(k->glow_map, k->glow,
                   texture_finer(k->glow_map, k->map ? k->map : k->relief.map), in, look_uv(k),
                   glow);
    if (k->per_vertex) {
        for (int a = 0; a < 3; a++) SHADE_EACH_LANE(i)
            {
                out[a][i] = in->varying[LOOK_P + a][i] * (texel ? texel[a][i] : 1);
                out[a][i] += k->glow_map ? glow[a][i] : 0;
            }
        return;
    }
    look_surface(k, in, P, N);
    look_light(k, P[0], N[0],
               own && texel ? albedo[0]
               : own        ? own[0]
               : texel      ? texel[0]
                            : NULL,
               k->glow_map ? glow[0] : NULL, in->count, in, out);
}

static void look_fragment(const void *uniforms, const shade_fragments *SHADE_RESTRICT in,
                          shade_colors *SHADE_RESTRICT out)
{
    const look *k = (const look *)uniforms;
    const int mapped = k->map && (!k->notes_only || k->alpha_cutoff > 0);
    float texel[4][SHADE_LANES];
    if (mapped) {
        const float *uv = in->varying[look_uv(k)];
        shade_sample_lanes(k->map, uv, uv + SHADE_LANES, in->lod, texel[0]);
    }
    if (!k->notes_only) look_color(k, in, k->map ? texel : NULL, out->color);
    SHADE_EACH_LANE(i)
    {
        const float alpha = mapped && !k->map_is_opaque ? texel[3][i] : 1;
        out->color[3][i] = k->alpha * alpha;
        out->discard[i] = alpha < k->alpha_cutoff;
    }
    if (k->note) k->note(k, in, out);
}

/* ---- parts ---------------------------------------------------------------------------------- */

/* Draws count triangles of a mesh from first on. */
static shade_result look_draw(const shade_target *target, look *k, const shade_mesh *mesh,
                              int first, int count)
{
    shade_pipeline p = { .vertex = look_vertex, .fragment = look_fragment, .uniforms = k };
    k->mesh = mesh;
    k->relief.indices = mesh->indices + 3 * (size_t)first;
    p.raster = k->raster;
    p.may_discard = k->alpha_cutoff > 0;
    p.lod_texture = k->map ? k->map : k->relief.map ? k->relief.map : k->glow_map;
    p.varyings = p.lod_varying = look_uv(k);
    if (look_has_pictures(k)) p.varyings += 2;
    return shade_draw(target, &p, mesh->indices + 3 * (size_t)first, 3 * count, mesh->vertex_count,
                      NULL);
}

/* A chunk of a part and the distance of its middle from the eye.  Once it is known, its place in
   the picture, -1 .. 1 from left to right and from the lower to the upper edge, and its least depth
   there */
typedef struct near_chunk {
    float distance, left, right, low, high, depth;
    shade_chunk chunk;
} near_chunk;

static int near_first(const void *a, const void *b)
{
    const near_chunk *x = (const near_chunk *)a, *y = (const near_chunk *)b;
    if (x->distance != y->distance) return x->distance > y->distance ? 1 : -1;
    return x->chunk.first > y->chunk.first ? 1 : -1;
}

/* The chunks of each part, sorted from near to far: hidden fragments are not lit, which would
   cost 64 lookups in the sky.  A bunny of 69 thousand triangles has half the fragments.  NULL:
   out of memory */
static near_chunk *near_chunks(const model *m, shade_vec3 eye)
{
    size_t room = 1;
    near_chunk *list;
    for (int i = 0; i < m->part_count; i++) room += (size_t)m->part[i].chunk_count;
    list = (near_chunk *)malloc(room * sizeof *list);
    for (int i = 0; i < m->part_count && list; i++) {
        near_chunk *of_part = list + m->part[i].first_chunk;
        const shade_chunk *c = m->mesh.chunks + m->part[i].first_chunk;
        size_t count = (size_t)m->part[i].chunk_count;
        for (size_t k = 0; k < count; k++) {
            of_part[k].chunk = c[k];
            of_part[k].distance = shade_distance(shade_lerp(c[k].low, c[k].high, 0.5f), eye);
        }
        qsort(of_part, count, sizeof *of_part, near_first);
    }
    return list;
}

/* Finds where a chunk lies; what lies beside the eye lies everywhere. */
static void near_chunk_reach(near_chunk *c, shade_mat4 clip)
{
    const shade_vec3 corner[2] = { c->chunk.low, c->chunk.high };
    float low[3] = { 9, 9, 9 }, high[2] = { -9, -9 };
    for (int i = 0; i < 8; i++) {
        const shade_vec4 p = { corner[i & 1].x, corner[i >> 1 & 1].y, corner[i >> 2].z, 1 };
        const shade_vec4 q = shade_mat4_transform(clip, p);
        const int behind = !(q.w > 1e-3f);
        const float at[3] = { q.x / q.w, q.y / q.w, q.z / q.w };
        for (int k = 0; k < 3; k++) low[k] = fminf(low[k], behind ? -9 : at[k]);
        for (int k = 0; k < 2; k++) high[k] = fmaxf(high[k], behind ? 9 : at[k]);
    }
    c->left = low[0];
    c->low = low[1];
    c->right = high[0];
    c->high = high[1];
    c->depth = 0.5f + 0.5f * low[2];
}

/* 1: the chunk lies beside the rows of the target, or what is drawn hides it: the pixels of its
   rectangle, one more on each side, are nearer by more than roundings err.  2 million triangles of
   a torus take 0.95 of the time, with --quick 0.92.  In 64 bands that spares most calls of
   shade_box_visible, which finds six planes: another 6 %. */
static int near_chunk_is_hidden(const near_chunk *c, const shade_target *target)
{
    const float across = 0.5f * (float)target->width, half = 0.5f * (float)target->height;
    const int x0 = (int)fmaxf(across + across * c->left - 2, 0);
    const int x1 = (int)fminf(across + across * c->right + 2, (float)target->width);
    const int y0 = (int)fmaxf(half - half * c->high - 2, (float)target->clip_y);
    const int y1 =
        (int)fminf(half - half * c->low + 2, (float)(target->clip_y + target->clip_height));
    const size_t stride = (size_t)(target->stride ? target->stride : target->width);
    for (int y = y0; y < y1; y++) {
        const float *row = target->depth + stride * (size_t)(y - target->row_offset);
        for (int x = x0; x < x1; x++)
            if (!(row[x] < c->depth - 1e-5f)) return 0;
    }
    return 1;
}

/* Draws those of count chunks that the target may see. */
static shade_result look_draw_chunks(const shade_target *target, look *k, const shade_mesh *mesh,
                                     const near_chunk *list, int count)
{
    shade_result result = SHADE_OK;
    for (int i = 0; i < count && !result; i++) {
        const shade_chunk *c = &list[i].chunk;
        if (k->aimed && near_chunk_is_hidden(&list[i], target)) continue;
        if (shade_box_visible(target, k->clip_from_mesh, 0, c->low, c->high))
            result = look_draw(target, k, mesh, c->first, c->count);
    }
    return result;
}

/* Sets the surface of a part: that of the command line, or of the file, or the default. */
static void look_dress(look *k, const model_options *o, const model *m, int surface)
{
    const surface_choice choice = surface_choose(m, surface, &o->material, o->plain);
    const model_surface *s = choice.own;
    static const relief level;
    k->map = NULL;
    k->relief = level;
    k->glow_map = NULL;
    k->alpha = 1;
    k->alpha_cutoff = 0;
    k->map_is_opaque = 0;
    k->unlit = 0;
    k->metal = 0;
    k->material = choice.material;
    k->plain = !choice.colored;
    k->rough = model_roughness(k->material.shininess);
    if (!s) return;
    k->unlit = s->unlit;
    k->metal = s->metal;
    k->rough = s->rough > 0 ? s->rough : model_roughness(k->material.shininess);
    k->alpha = 1 - s->transparency;
    k->alpha_cutoff = s->alpha_cutoff;
    k->map_is_opaque = s->opaque;
    if (s->picture >= 0 && m->mesh.texcoords && m->picture[s->picture].map.pixels)
        k->map = &m->picture[s->picture].map;
    k->relief = relief_of(m, s, k->map);
    k->glow = s->glow;
    if (s->glow_picture >= 0 && m->mesh.texcoords) k->glow_map = &m->picture[s->glow_picture].map;
}

typedef struct far_triangle {
    float distance;
    uint32_t first;
    int surface;
} far_triangle;

static int far_first(const void *a, const void *b)
{
    const far_triangle *x = (const far_triangle *)a, *y = (const far_triangle *)b;
    if (x->distance != y->distance) return x->distance < y->distance ? 1 : -1;
    return x->first > y->first ? 1 : -1;
}

/* The transparent triangles, sorted from far to near, and their indices in that order */
typedef struct far_list {
    far_triangle *triangle;
    uint32_t *indices;
    size_t count;
} far_list;

static void far_list_free(far_list *l)
{
    free(l->triangle);
    free(l->indices);
}

/* Returns 1 where memory is out. */
static int far_list_make(far_list *l, const model *m, const char *see_through, shade_vec3 eye)
{
    size_t room = 0;
    for (int i = 0; i < m->part_count; i++)
        if (see_through[i]) room += (size_t)m->part[i].count / 3;
    if (!room) return 0;
    l->triangle = (far_triangle *)malloc(room * sizeof *l->triangle);
    l->indices = (uint32_t *)malloc(3 * room * sizeof *l->indices);
    if (!l->triangle || !l->indices) return 1;
    for (int i = 0; i < m->part_count; i++) {
        int end = see_through[i] ? m->part[i].first + m->part[i].count : 0;
        for (int t = m->part[i].first; t < end; t += 3) {
            far_triangle *f = &l->triangle[l->count++];
            shade_vec3 sum = shade_v3(0, 0, 0), p;
            for (int c = 0; c < 3; c++) {
                memcpy(&p, m->mesh.positions + 3 * (size_t)m->mesh.indices[t + c], sizeof p);
                sum = shade_add(sum, p);
            }
            f->distance = shade_distance(shade_scale(sum, 1 / 3.0f), eye);
            f->first = (uint32_t)t;
            f->surface = m->part[i].surface;
        }
    }
    qsort(l->triangle, l->count, sizeof *l->triangle, far_first);
    for (size_t i = 0; i < l->count; i++)
        memcpy(l->indices + 3 * i, m->mesh.indices + l->triangle[i].first, 12);
    return 0;
}

/* Draws the transparent triangles; neighbours in the list with the same surface are one draw. */
static shade_result draw_far_first(const shade_target *target, look *k, const model_options *o,
                                   const model *m, const far_list *l)
{
    shade_mesh mesh = m->mesh.view;
    shade_result result = SHADE_OK;
    mesh.indices = l->indices;
    k->raster.blend = SHADE_BLEND_OVER;
    k->raster.depth_read_only = 1;
    for (size_t i = 0, end; i < l->count && !result; i = end) {
        for (end = i; end < l->count && l->triangle[end].surface == l->triangle[i].surface;) end++;
        look_dress(k, o, m, l->triangle[i].surface);
        result = look_draw(target, k, &mesh, (int)i, (int)(end - i));
    }
    return result;
}

static shade_result draw_opaque(const shade_target *target, look *k, const model_options *o,
                                const model *m, const char *see_through, const near_chunk *list)
{
    shade_result result = SHADE_OK;
    for (int i = 0; i < m->part_count && !result; i++) {
        const shade_mesh mesh = model_part_mesh(m, i);
        if (see_through[i]) continue;
        look_dress(k, o, m, m->part[i].surface);
        result = look_draw_chunks(target, k, &mesh, list + m->part[i].first_chunk,
                                  m->part[i].chunk_count);
    }
    return result;
}

/* ---- the picture ---------------------------------------------------------------------------- */

/* 1: something shows through the part, by its transparency or by alpha between 0 and 1 in its
   map. */
static int part_is_clear(const model *m, const model_options *o, int part)
{
    const model_surface *s = surface_choose(m, m->part[part].surface, &o->material, o->plain).own;
    if (!s) return 0;
    return s->transparency > 0 || (s->blended && s->picture >= 0);
}

/* A model in the light of its studio, seen from one place */
typedef struct exhibit {
    const model *model;
    const model_options *options;
    look look;
    ground ground;
    char *see_through; /* by part */
    near_chunk *near_chunks;
    far_list far_list;
} exhibit;

/* The tones of cool-to-warm, whose key lamp shines across the line of sight, from the right and
   above: so the whole range of tones is in view [Gooch98]. */
static void look_tone(look *k, float turn)
{
    if (k->lighting.model != SHADE_MODEL_COOL_TO_WARM) return;
    k->tone_lamp = shade_directional_light(studio_turned(turn, shade_v3(-0.75f, -0.65f, 0.2f)),
                                           shade_v3(1, 1, 1));
    k->lighting.lights = &k->tone_lamp;
    k->lighting.light_count = 1;
    k->lighting.cool = shade_v3(0.04f, 0.06f, 0.30f);
    k->lighting.warm = shade_v3(1.00f, 0.72f, 0.30f);
}

static inline void exhibit_close(exhibit *e)
{
    static const exhibit none;
    free(e->see_through);
    free(e->near_chunks);
    ground_free(&e->ground);
    far_list_free(&e->far_list);
    *e = none;
}

/* Returns 1 where memory is out.  Model, light and options must outlive the exhibit, which stays
   where it is: its look points into it. */
static inline int exhibit_open(exhibit *e, const model *m, const studio *light,
                               const model_options *o, shade_vec3 eye)
{
    static const exhibit none;
    look *k = &e->look;
    *e = none;
    e->model = m;
    e->options = o;
    k->studio = light;
    k->eye = eye;
    k->lighting.lights = light->lamp;
    k->lighting.light_count = 2;
    k->lighting.model = o->model;
    k->shadows = look_has_shadows(o);
    k->mirrors = look_mirrors(o);
    look_tone(k, light->turn);
    k->per_vertex = o->shading == SHADE_SHADING_PER_VERTEX;
    e->see_through = (char *)calloc((size_t)m->part_count + 1, 1);
    e->near_chunks = near_chunks(m, k->eye);
    if (!e->see_through || !e->near_chunks) return 1;
    for (int i = 0; i < m->part_count; i++) e->see_through[i] = (char)part_is_clear(m, o, i);
    if (o->quick && !o->no_shadow)
        ground_cast(&e->ground, &m->mesh.view);
    else if (!o->no_shadow && studio_cast(&e->ground, light, &m->mesh, o->threads))
        return 1;
    return far_list_make(&e->far_list, m, e->see_through, k->eye); /* NOLINT: the caller frees */
}

/* Tells through which matrix all bands of the picture will be drawn, which makes that faster where
   there are many. */
static inline void exhibit_aim(exhibit *e, shade_mat4 clip_from_world)
{
    size_t chunks = 0;
    for (int i = 0; i < e->model->part_count; i++) chunks += (size_t)e->model->part[i].chunk_count;
    for (size_t i = 0; i < chunks; i++) near_chunk_reach(&e->near_chunks[i], clip_from_world);
    e->look.aimed = 1;
}

/* Draws the lines of a model, 1.5 pixels wide, which have so many samples along their edges.  Lines
   often lie on faces, and so are drawn a little nearer, by 1/2000 of their distance. */
static inline shade_result model_draw_lines(const model *m, const shade_target *target,
                                            shade_mat4 view, shade_mat4 projection, int samples)
{
    const float s = 1 - 5e-4f;
    const shade_mat4 nearer = shade_mat4_scaling(shade_v3(s, s, s));
    shade_line_state pen = { .width = 1.5f * (float)samples, .cap = SHADE_CAP_SQUARE };
    pen.raster.depth_test = SHADE_COMPARE_LESS_EQUAL;
    pen.clip_from_points = shade_mat4_mul(projection, shade_mat4_mul(nearer, view));
    return wires_draw(&m->wires, target, pen);
}

/* Draws a band of the picture, of so many samples along the edge of a pixel, over its
   background. */
static inline shade_result exhibit_draw(const exhibit *e, const shade_target *rows, shade_mat4 view,
                                        shade_mat4 projection, int samples)
{
    static const shade_mat4 no_turn; /* zero: the identity */
    look k = e->look;
    shade_result result;
    k.clip_from_mesh = shade_mat4_mul(projection, view);
    k.samples = samples;
    result = draw_opaque(rows, &k, e->options, e->model, e->see_through, e->near_chunks);
    if (!result) result = model_draw_lines(e->model, rows, view, projection, samples);
    if (!result && e->ground.shadow)
        result = ground_draw(&e->ground, rows, no_turn, view, projection);
    if (!result) result = draw_far_first(rows, &k, e->options, e->model, &e->far_list);
    return result;
}
#endif
