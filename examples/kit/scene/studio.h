/* studio.h - the light of a photographer's studio: a large lamp from the upper right that throws
   soft shadows, a weak lamp from behind, and a sky, bright above and dim at the horizon, whose
   light reaches into hollows as far as they are open.

   How bright the whole sky makes a surface depends on the slope of that alone, and stands in a
   table.  What the model hides of it is asked of many lamps at infinity.  For each of them, and for
   some points of the large lamp, a depth-only draw from the lamp makes a shadow map.  A point is
   lit by the lamps whose maps show it.

   The samples of a pixel share the lamps: each of four neighbours asks a quarter of them.  So a
   picture costs a quarter of the look-ups, and a pixel still shows them all.

   Surfaces also reflect the studio, by Fresnel's term [Schlick94]: without that, a black part
   would show no form.  The lamps of the sky around the reflected direction say how much of it the
   rest of the model hides. */
#ifndef MODEL_STUDIO_H
#define MODEL_STUDIO_H

#include "../../shared/bands.h"
#include "ground.h"
#include "../read/model.h"

enum { STUDIO_SKY = 64, STUDIO_KEY = 16, STUDIO_MAPS = STUDIO_SKY + STUDIO_KEY };
enum { STUDIO_SHARES = 4 };   /* the numbers of lamps are multiples of it */
enum { STUDIO_SLOPES = 32 };  /* steps of the table, from a floor's underside to level ground */
enum { STUDIO_GROUND = 256 }; /* texels along an edge of the shadow on the ground, at most */
#define STUDIO_REACH 1.02f    /* half the edge of the square that a map sees */
#ifndef STUDIO_WHOLE
#define STUDIO_WHOLE 0 /* 1: each sample asks all lamps, of fine maps of the whole model */
#endif

typedef struct studio_map {
    shade_vec3 toward, right, up; /* unit vectors; toward points to the lamp */
    float *depth;                 /* NULL: not drawn, everything is lit */
    float weight;                 /* its part of the sky, or of the large lamp */
    int size;
    float low[2], high[2]; /* the texels that something is drawn in, and two around them */
} studio_map;

typedef struct studio {
    studio_map map[STUDIO_MAPS]; /* the sky, then the large lamp */
    int sky, key;                /* the number of maps of each */
    int ground;                  /* texels along an edge of the shadow on the ground */
    float *memory;
    model coarse; /* the casters of a large model; none of a small one */
    int closed;   /* 1: casters show their front to every lamp, and backs need no drawing */
    float slope[STUDIO_SLOPES + 2]
               [2]; /* light of an open sky, the part of the zenith and the rest */
    shade_light lamp[2];
    float turn;       /* of the lamps about +y, in radians; the sky looks alike all around */
    shade_vec3 strip; /* toward the strip of light behind, which mirrors show */
} studio;

/* ---- where the lamps are -------------------------------------------------------------------- */

static void studio_aim(studio_map *m, shade_vec3 toward)
{
    shade_vec3 helper = fabsf(toward.y) < 0.9f ? shade_v3(0, 1, 0) : shade_v3(1, 0, 0);
    m->toward = shade_normalize(toward);
    m->right = shade_normalize(shade_cross(helper, m->toward));
    m->up = shade_cross(m->toward, m->right);
}

/* Point i of n on a spiral that fills a disk evenly: radius and angle [Vogel] */
static shade_vec2 studio_spiral(int i, int n)
{
    shade_mat4 m = shade_mat4_rotation(2.3999632f * (float)i, shade_v3(0, 0, 1));
    float r = sqrtf(((float)i + 0.5f) / (float)n);
    return shade_v2(r * m.col[0].x, r * m.col[0].y);
}

/* How bright the sky is at a height: half as bright at the horizon as above */
static float studio_height(float y) { return 1 / (0.6f + y); }

/* The mean over a ring of the sky, at height y, of the cosine to a normal of slope ny, where it is
   above 0: of a cos(angle) + b. */
static float studio_ring(float y, float ny)
{
    const float a = sqrtf((1 - y * y) * (1 - ny * ny)), b = y * ny;
    const float edge = a > 0 ? fmaxf(-1, fminf(1, -b / a)) : b > 0 ? -1 : 1;
    const float angle = acosf(edge);
    return (a * sinf(angle) + b * angle) / 3.1415927f;
}

/* Fills the table: the light of the whole sky by slope, 1 on level ground. */
static void studio_fill_slopes(studio *s)
{
    enum { RINGS = 256 };
    for (int k = 0; k <= STUDIO_SLOPES; k++) {
        const float ny = 2 * (float)k / STUDIO_SLOPES - 1;
        float sum[2] = { 0 }, level = 0;
        for (int i = 0; i < RINGS; i++) {
            const float y = sqrtf(((float)i + 0.5f) / RINGS), weight = studio_height(y);
            const float part = weight * studio_ring(y, ny);
            sum[0] += part * y;
            sum[1] += part * (1 - y);
            level += weight * y;
        }
        s->slope[k][0] = sum[0] / level;
        s->slope[k][1] = sum[1] / level;
    }
    memcpy(s->slope[STUDIO_SLOPES + 1], s->slope[STUDIO_SLOPES], sizeof s->slope[0]);
}

/* Places the lamps of the sky as densely as Lambert's cosine weights them on level ground, where
   all have the same weight. */
static void studio_place(studio *s, int sky, int key)
{
    float sum = 0;
    s->sky = sky;
    s->key = key;
    studio_fill_slopes(s);
    for (int i = 0; i < sky; i++) {
        shade_vec2 p = studio_spiral(i, sky);
        float y = sqrtf(1 - p.x * p.x - p.y * p.y);
        studio_aim(&s->map[i], shade_v3(p.x, y, p.y));
        s->map[i].weight = studio_height(y);
        sum += s->map[i].weight * y;
    }
    for (int i = 0; i < sky; i++) s->map[i].weight /= sum;
}

/* A direction of the studio, turned about +y */
static shade_vec3 studio_turned(float turn, shade_vec3 v)
{
    return shade_mat4_transform_direction(shade_mat4_rotation(turn, shade_v3(0, 1, 0)), v);
}

/* Places the lamps that turn with the studio: the large one, the weak one, the strip. */
static void studio_place_key(studio *s, float turn)
{
    const shade_vec3 main_lamp = studio_turned(turn, shade_v3(0.90f, 0.95f, 0.60f));
    studio_map middle;
    s->turn = turn;
    studio_aim(&middle, main_lamp);
    for (int i = 0; i < s->key; i++) {
        shade_vec2 p = studio_spiral(i, s->key);
        shade_vec3 d = shade_madd(middle.toward, 0.13f * p.x, middle.right);
        studio_aim(&s->map[s->sky + i], shade_madd(d, 0.13f * p.y, middle.up));
        s->map[s->sky + i].weight = 1 / (float)s->key;
    }
    s->lamp[0] = shade_directional_light(shade_neg(main_lamp), shade_v3(1.06f, 1.00f, 0.91f));
    s->lamp[1] = shade_directional_light(studio_turned(turn, shade_v3(0.8f, -0.25f, 0.75f)),
                                         shade_v3(0.22f, 0.25f, 0.30f));
    s->strip = studio_turned(turn, shade_v3(-0.76f, 0.36f, -0.54f));
}

/* ---- who sees what -------------------------------------------------------------------------- */

/* The matrix from world space to x and y of the map and depth 0 (at the lamp) .. 1 */
static shade_mat4 studio_view(const studio_map *m)
{
    shade_mat4 view = { { { m->right.x, m->up.x, m->toward.x, 0 },
                          { m->right.y, m->up.y, m->toward.y, 0 },
                          { m->right.z, m->up.z, m->toward.z, 0 },
                          { 0, 0, 0, 1 } } };
    return view;
}

/* Finds the rectangle outside of which nothing is drawn. */
static void studio_find_drawn(studio_map *map)
{
    int low[2] = { map->size, map->size }, high[2] = { -1, -1 };
    for (int y = 0; y < map->size; y++) {
        const float *row = map->depth + (size_t)y * (size_t)map->size;
        int first = 0, last = map->size - 1;
        while (first <= last && row[first] >= 1) first++;
        if (first > last) continue;
        while (row[last] >= 1) last--;
        if (first < low[0]) low[0] = first;
        if (last > high[0]) high[0] = last;
        if (y < low[1]) low[1] = y;
        high[1] = y;
    }
    for (int k = 0; k < 2; k++) {
        map->low[k] = (float)low[k] - 2;
        map->high[k] = (float)high[k] + 2;
    }
}

/* Do maps cut holes?  Then casters are drawn with them, and may show their backs. */
static int studio_has_holes(const model *m)
{
    for (int i = 0; i < m->surface_count; i++)
        if (m->surface[i].alpha_cutoff > 0) return 1;
    return 0;
}

/* Parts that throw a shadow: those that nothing shows through */
static int studio_casts(const model *m, int part)
{
    const model_surface *s = m->surface_count ? &m->surface[m->part[part].surface] : NULL;
    return !s || !(s->transparency > 0 || s->blended);
}

/* Draws the depth of the parts that throw a shadow, and of their backs unless closed. */
static shade_result studio_draw(studio_map *map, const model *m, int closed)
{
    shade_target target = { .width = map->size, .height = map->size, .depth = map->depth };
    shade_draw_state state = { .view = studio_view(map) };
    shade_result result;
    state.raster.cull = closed ? SHADE_CULL_BACK : SHADE_CULL_NONE;
    state.projection = shade_mat4_ortho(-STUDIO_REACH, STUDIO_REACH, -STUDIO_REACH, STUDIO_REACH,
                                        -STUDIO_REACH, STUDIO_REACH);
    result = shade_clear(&target, shade_v4(0, 0, 0, 0), 1);
    for (int i = 0; i < m->part_count && !result; i++) {
        const model_surface *s = m->surface_count ? &m->surface[m->part[i].surface] : NULL;
        const shade_mesh mesh = model_part_mesh(m, i);
        if (!studio_casts(m, i)) continue;
        state.alpha_cutoff = s ? s->alpha_cutoff : 0;
        state.diffuse_map =
            s && s->alpha_cutoff > 0 && s->picture >= 0 ? &m->picture[s->picture].map : NULL;
        result = shade_draw_mesh(&target, &mesh, &state, NULL);
    }
    studio_find_drawn(map);
    return result;
}

/* Points with their normals and the directions that these reflect, in rows of x, y and z: what is
   asked of a map is asked for all at once, which compilers turn into vectors.  A picture at 256
   pixels takes 0.5 of the time. */
enum { STUDIO_BLOCK = 16 };
typedef float studio_rows[3][STUDIO_BLOCK];
typedef struct studio_points {
    studio_rows P, N, R;
} studio_points;
static const studio_points studio_nowhere;
#define STUDIO_EACH(i) for (int i = 0; i < STUDIO_BLOCK; i++)
#if defined(__GNUC__) && !defined(__clang__) /* which makes vectors at -O2 */
#if defined(__x86_64__) && defined(__GLIBC__) && !defined(__SANITIZE_ADDRESS__) &&                 \
    !defined(__SANITIZE_THREAD__) /* whose loader chooses */
#define STUDIO_BUILDS , target_clones("avx2", "default")
#else
#define STUDIO_BUILDS
#endif
#define STUDIO_VECTORS                                                                             \
    __attribute__((optimize("O3", "no-trapping-math", "fp-contract=off") STUDIO_BUILDS))
#else
#define STUDIO_VECTORS
#endif

static void studio_put(studio_rows rows, int i, shade_vec3 v)
{
    rows[0][i] = v.x;
    rows[1][i] = v.y;
    rows[2][i] = v.z;
}

/* The parts of the points that the lamp sees: four neighbours in the map, weighted by distance.
   Points are moved so many texels off their surfaces, or these would shade themselves.  *cosine is
   that between normals and the lamp.  0: all surfaces face away.  Where all lie beside what is
   drawn, no texel is looked up. */
STUDIO_VECTORS static int studio_seen(const studio_map *m, float texels, const studio_points *p,
                                      float *cosine, float *seen)
{
    const shade_vec3 to = m->toward, right = m->right, up = m->up;
    const float scale = 0.5f * (float)m->size / STUDIO_REACH, last = (float)m->size - 1.001f;
    const float off = texels * (2 * STUDIO_REACH / (float)m->size);
    const float *nx = p->N[0], *ny = p->N[1], *nz = p->N[2];
    float u[STUDIO_BLOCK], v[STUDIO_BLOCK], z[STUDIO_BLOCK], texel[2][2 * STUDIO_BLOCK];
    float within[STUDIO_BLOCK];
    int at[STUDIO_BLOCK], facing = 0, near = 0;
    STUDIO_EACH(i) { cosine[i] = nx[i] * to.x + ny[i] * to.y + nz[i] * to.z; }
    STUDIO_EACH(i) { facing |= cosine[i] > 0; }
    STUDIO_EACH(i) { seen[i] = 1; }
    if (!facing || !m->depth) return facing;
    STUDIO_EACH(i)
    {
        const float px = p->P[0][i] + off * nx[i], py = p->P[1][i] + off * ny[i];
        const float pz = p->P[2][i] + off * nz[i];
        const float wx = (px * right.x + py * right.y + pz * right.z + STUDIO_REACH) * scale - 0.5f;
        const float wy = (STUDIO_REACH - (px * up.x + py * up.y + pz * up.z)) * scale - 0.5f;
        const float depth = 0.5f - 0.5f * (px * to.x + py * to.y + pz * to.z) / STUDIO_REACH;
        float x = wx > 0 ? wx : 0, y = wy > 0 ? wy : 0;
        x = x < last ? x : last;
        y = y < last ? y : last;
        near |= (wx > m->low[0]) & (wx < m->high[0]) & (wy > m->low[1]) & (wy < m->high[1]);
        within[i] = (float)(x == wx) * (float)(y == wy);
        z[i] = depth < 1 ? depth : 1; /* empty texels: 1 */
        u[i] = x - (float)(int)x;
        v[i] = y - (float)(int)y;
        at[i] = (int)((float)(int)y * (float)m->size + (float)(int)x);
    }
    if (!near) return 1;
    STUDIO_EACH(i)
    {
        memcpy(&texel[0][2 * i], m->depth + at[i], 2 * sizeof(float));
        memcpy(&texel[1][2 * i], m->depth + at[i] + m->size, 2 * sizeof(float));
    }
    STUDIO_EACH(i)
    {
        const float *above = texel[0] + 2 * i, *below = texel[1] + 2 * i;
        const float top = (1 - u[i]) * (float)(above[0] >= z[i]) + u[i] * (float)(above[1] >= z[i]);
        const float low = (1 - u[i]) * (float)(below[0] >= z[i]) + u[i] * (float)(below[1] >= z[i]);
        seen[i] = within[i] * ((1 - v[i]) * top + v[i] * low) + (1 - within[i]);
    }
    return 1;
}

/* The light of a sky that nothing hides, for normals of slope ny: between two steps of the table */
static void studio_open_sky(const studio *s, const float *ny, float *high, float *low)
{
    STUDIO_EACH(i)
    {
        const float at = (0.5f * STUDIO_SLOPES) * fmaxf(0, fminf(2, 1 + ny[i]));
        const float(*row)[2] = s->slope + (int)at;
        const float t = at - (float)(int)at;
        high[i] = row[0][0] + t * (row[1][0] - row[0][0]);
        low[i] = row[0][1] + t * (row[1][1] - row[0][1]);
    }
}

/* Takes from that light, of the zenith and of the rest, and from open, the part of the lamps near
   the direction R, what the model hides of them.  Only a share of the lamps is asked, one in so
   many from first on, and what they miss is counted so many times, of the light of all lamps: the
   mean over all shares is what all lamps say, and where nothing hides the sky each share says
   so. */
STUDIO_VECTORS static void studio_hide(const studio *s, int first, int shares,
                                       const studio_points *p, float *high, float *low, float *open)
{
    const float *rx = p->R[0], *ry = p->R[1], *rz = p->R[2];
    const float *nx = p->N[0], *ny = p->N[1], *nz = p->N[2];
    float cosine[STUDIO_BLOCK], seen[STUDIO_BLOCK] = { 0 }, all[3][STUDIO_BLOCK],
                                hidden[3][STUDIO_BLOCK];
    for (int k = 0; k < 3; k++) STUDIO_EACH(i)
        {
            all[k][i] = 1e-3f;
            hidden[k][i] = 0;
        }
    for (int k = 0; k < s->sky; k++) {
        const studio_map *m = &s->map[k];
        const shade_vec3 to = m->toward;
        const float weight = m->weight;
        const int asked = k % shares == first && studio_seen(m, 2, p, cosine, seen);
        STUDIO_EACH(i)
        {
            const float own = nx[i] * to.x + ny[i] * to.y + nz[i] * to.z;
            const float front = own > 0 ? own * weight : 0;
            float along = rx[i] * to.x + ry[i] * to.y + rz[i] * to.z, miss;
            along = along > 0 ? along : 0;
            along *= along * along * (float)(own > 0);
            miss = asked ? (float)shares * (1 - seen[i]) : 0;
            all[0][i] += front * to.y;
            all[1][i] += front * (1 - to.y);
            all[2][i] += along;
            hidden[0][i] += front * to.y * miss;
            hidden[1][i] += front * (1 - to.y) * miss;
            hidden[2][i] += along * miss;
        }
    }
    STUDIO_EACH(i)
    {
        high[i] *= 1 - hidden[0][i] / all[0][i];
        low[i] *= 1 - hidden[1][i] / all[1][i];
        open[i] *= 1 - hidden[2][i] / all[2][i];
    }
}

/* The light of the sky on surfaces, and the light that the ground throws back; 0.4 on open level
   ground.  The sky goes from a bluish zenith to a warm horizon.  open becomes the part of the
   lamps near the direction R that a point sees, 1 where none is near. */
static void studio_sky(const studio *s, int first, int shares, const studio_points *p,
                       studio_rows light, float *open)
{
    const shade_vec3 zenith = shade_v3(0.40f, 0.42f, 0.46f);
    const shade_vec3 horizon = shade_v3(0.41f, 0.40f, 0.38f);
    float high[STUDIO_BLOCK], low[STUDIO_BLOCK];
    studio_open_sky(s, p->N[1], high, low);
    STUDIO_EACH(i) { open[i] = 1; }
    if (s->memory) studio_hide(s, first, shares, p, high, low, open);
    STUDIO_EACH(i)
    {
        const float back = 0.06f * (1 - p->N[1][i]);
        light[0][i] = back + high[i] * zenith.x + low[i] * horizon.x;
        light[1][i] = back + high[i] * zenith.y + low[i] * horizon.y;
        light[2][i] = back + high[i] * zenith.z + low[i] * horizon.z;
    }
}

/* How much of the large lamp points see, by a share of its maps */
STUDIO_VECTORS static void studio_lamp(const studio *s, int first, int shares,
                                       const studio_points *p, float *lit)
{
    float cosine[STUDIO_BLOCK], seen[STUDIO_BLOCK];
    STUDIO_EACH(i) { lit[i] = 0; }
    for (int k = s->sky + first; k < s->sky + s->key; k += shares) {
        const float weight = s->map[k].weight * (float)shares;
        if (!studio_seen(&s->map[k], 2.5f, p, cosine, seen)) continue;
        STUDIO_EACH(i) { lit[i] += weight * seen[i] * (float)(cosine[i] > 0); }
    }
}

/* 0 below from, 1 above to, smooth between */
static float studio_step(float from, float to, float x)
{
    float t = fminf(1, fmaxf(0, (x - from) / (to - from)));
    return t * t * (3 - 2 * t);
}

/* The studio as a mirror of some roughness shows it in the direction R: a dark floor, walls that
   brighten upward, the large lamp, and a strip of light behind. */
static shade_vec3 studio_mirror(const studio *s, shade_vec3 R, float rough, float open, float lamp)
{
    const shade_vec3 warm = shade_v3(1.03f, 1, 0.96f), blue = shade_v3(0.93f, 0.98f, 1.06f);
    const shade_vec3 key = s->map[s->sky].toward;
    float wide = 0.05f + 0.8f * rough, width = 1 - 0.6f * rough;
    float wall = studio_step(-wide, wide, R.y), floor_light = 0.14f + 0.12f * (1 + R.y);
    float light = floor_light + (0.42f + 0.50f * fmaxf(0, R.y) - floor_light) * wall * open;
    light += 1.3f * width * lamp * studio_step(0.90f - 0.5f * rough, 0.97f, shade_dot(R, key));
    light += 0.8f * width * open * studio_step(0.70f - 0.4f * rough, 0.95f, shade_dot(R, s->strip));
    return shade_scale(shade_lerp(warm, blue, wall), light);
}

/* The data that the threads share, and each map's result */
typedef struct studio_work {
    studio *studio;
    const model *model;
    int first; /* of the maps to draw */
    shade_result result[STUDIO_MAPS];
} studio_work;

static void studio_draw_map(void *data, int i)
{
    studio_work *w = (studio_work *)data;
    w->result[i] = studio_draw(&w->studio->map[w->first + i], w->model, w->studio->closed);
}

/* Draws the maps from the first one on. */
static shade_result studio_draw_maps(studio *s, const model *m, int first, int threads,
                                     mesh_progress *progress, void *user)
{
    studio_work work = { s, m, first, { SHADE_OK } };
    const int count = s->sky + s->key - first;
    bands_run_told(threads, count, studio_draw_map, &work, progress, user);
    for (int i = 0; i < count; i++)
        if (work.result[i]) return work.result[i];
    return SHADE_OK;
}

/* ---- a coarser mesh -------------------------------------------------------------------------- */

/* Many lamps, each for a share of the samples, blur what is smaller than some texels of a map.  All
   vertices of a cell become one, at their mean; triangles with two corners in a cell vanish.  Cells
   are 16/7 texels of the sky's maps wide, for pictures of more than 256 pixels 4/3, for those of at
   most 128 8/7.  Half of that is less than points are moved off their surfaces for the large lamp:
   the rounded foot of a wall would darken the wall. */
enum { STUDIO_THIN = 10000 }; /* triangles of models that are worth it */
static int studio_may_thin(const model *m)
{
    return !STUDIO_WHOLE && m->mesh.view.index_count / 3 > STUDIO_THIN && !studio_has_holes(m);
}

/* The cell of a coordinate, of so many */
static size_t studio_cell(float x, size_t along)
{
    const float at = (x + STUDIO_REACH) * (0.5f * (float)along / STUDIO_REACH);
    return at > 0 ? at < (float)along ? (size_t)at : along - 1 : 0;
}

/* The cell of each vertex, of so many along an edge, numbered as they are met; *mean becomes four
   floats a cell: the mean position, and a count.  NULL: out of memory */
static uint32_t *studio_cells(const owned_mesh *m, size_t along, float **mean, size_t *count)
{
    const size_t n = (size_t)m->view.vertex_count;
    uint32_t *cell = (uint32_t *)malloc((n + 1) * sizeof *cell);
    uint32_t *number = (uint32_t *)calloc(along * along * along, sizeof *number); /* 0: not met */
    *count = 0;
    *mean = NULL;
    for (size_t i = 0; i < n && cell && number; i++) {
        size_t at = 0;
        for (size_t k = 0; k < 3; k++)
            at = at * along + studio_cell(m->positions[3 * i + k], along);
        if (!number[at]) number[at] = (uint32_t)++ * count;
        cell[i] = number[at] - 1;
    }
    if (cell && number) *mean = (float *)calloc(*count + 1, 4 * sizeof **mean);
    for (size_t i = 0; i < n && *mean; i++) {
        float *to = *mean + 4 * (size_t)cell[i];
        for (size_t k = 0; k < 3; k++) to[k] += (m->positions[3 * i + k] - to[k]) / (to[3] + 1);
        to[3] += 1;
    }
    free(number);
    if (*mean) return cell;
    free(cell);
    return NULL;
}

static void studio_thin_free(model *thin)
{
    static const model none;
    free(thin->mesh.positions);
    free(thin->mesh.indices);
    free(thin->part);
    *thin = none;
}

/* Makes *thin such a copy, for studio_thin_free; it has the surfaces of the other.  Returns 1 where
   memory is out. */
static int studio_thin(model *thin, const model *m, int pixels)
{
    const size_t corners = (size_t)m->mesh.view.index_count;
    static const owned_mesh none;
    size_t cells = 0;
    float *mean = NULL;
    uint32_t *cell = studio_cells(&m->mesh, pixels <= 256 ? 112 : 192, &mean, &cells);
    int count = 0;
    *thin = *m;
    thin->mesh = none;
    thin->mesh.positions = mean;
    thin->mesh.indices = (uint32_t *)malloc((corners + 1) * sizeof(uint32_t));
    thin->part = (model_part *)malloc(((size_t)m->part_count + 1) * sizeof *thin->part);
    if (!cell || !thin->mesh.indices || !thin->part) {
        free(cell);
        return 1;
    }
    for (int i = 0; i < m->part_count; i++) {
        const model_part *part = &m->part[i];
        thin->part[i] = (model_part){ count, 0, part->surface, 0, 0 };
        for (int t = part->first; t < part->first + part->count; t += 3) {
            const uint32_t *corner = m->mesh.indices + t;
            const uint32_t a = cell[corner[0]], b = cell[corner[1]], c = cell[corner[2]];
            if (a == b || b == c || c == a) continue;
            thin->mesh.indices[count++] = a;
            thin->mesh.indices[count++] = b;
            thin->mesh.indices[count++] = c;
        }
        thin->part[i].count = count - thin->part[i].first;
    }
    for (size_t i = 0; i < cells; i++) memmove(mean + 3 * i, mean + 4 * i, 3 * sizeof *mean);
    mesh_link(&thin->mesh, (int)cells, count);
    free(cell);
    return 0;
}

/* ---- backs that no lamp sees ----------------------------------------------------------------- */

/* A number for the edge of two vertices, of opposite sign the other way round [splitmix64] */
static uint64_t studio_edge(uint32_t a, uint32_t b)
{
    const uint32_t low = a < b ? a : b, high = a < b ? b : a;
    uint64_t x = ((uint64_t)high << 32 | low) + 0x9e3779b97f4a7c15u;
    x = (x ^ x >> 30) * 0xbf58476d1ce4e5b9u;
    x = (x ^ x >> 27) * 0x94d049bb133111ebu;
    x ^= x >> 31;
    return a < b ? x : 0 - x;
}

/* The vertex that stands for the piece of another one */
static uint32_t studio_piece(uint32_t *root, uint32_t a)
{
    while (root[a] != a) a = root[a] = root[root[a]];
    return a;
}

/* Adds up the edges of a part, and joins the vertices of each triangle to one piece. */
static uint64_t studio_join(const owned_mesh *m, const model_part *part, uint32_t *root)
{
    uint64_t sum = 0;
    for (int t = part->first; t < part->first + part->count; t += 3) {
        const uint32_t *corner = m->indices + t;
        for (int k = 0; k < 3; k++) {
            const uint32_t a = corner[k], b = corner[(k + 1) % 3];
            if (a != b) sum += studio_edge(a, b);
            root[studio_piece(root, a)] = studio_piece(root, b);
        }
    }
    return sum;
}

/* Six times the volume between a triangle and the origin: below 0 where that sees its front */
static double studio_volume(const float *a, const float *b, const float *c)
{
    const double x = (double)b[1] * (double)c[2] - (double)b[2] * (double)c[1];
    const double y = (double)b[2] * (double)c[0] - (double)b[0] * (double)c[2];
    const double z = (double)b[0] * (double)c[1] - (double)b[1] * (double)c[0];
    return (double)a[0] * x + (double)a[1] * y + (double)a[2] * z;
}

/* 1: the casters of a model are closed, without holes of alpha, and none is inside out.  Then from
   outside each point shows a front before a back: without backs the maps are the same but for
   roundings, in .83 of a thumbnail's time at 100,000 triangles.  Each edge must be gone through as
   often one way as the other: the numbers of all edges add up to 0 then, and otherwise once in
   2^64.  Pieces of next to no volume, as sheets with two faces, are neither.  0 where memory is
   out. */
static int studio_is_closed(const model *m)
{
    const size_t n = (size_t)m->mesh.view.vertex_count;
    uint32_t *root = (uint32_t *)malloc((n + 1) * sizeof *root);
    double *volume = (double *)calloc(n + 1, sizeof *volume);
    uint64_t sum = 0;
    int closed;
    if (!root || !volume || studio_has_holes(m)) {
        free(root);
        free(volume);
        return 0;
    }
    for (size_t i = 0; i < n; i++) root[i] = (uint32_t)i;
    for (int i = 0; i < m->part_count; i++)
        if (studio_casts(m, i)) sum += studio_join(&m->mesh, &m->part[i], root);
    closed = sum == 0;
    for (int i = 0; i < m->part_count && closed; i++) {
        const model_part *part = &m->part[i];
        if (!studio_casts(m, i)) continue;
        for (int t = part->first; t < part->first + part->count; t += 3) {
            const uint32_t *corner = m->mesh.indices + t;
            const float *at = m->mesh.positions;
            volume[studio_piece(root, corner[0])] += studio_volume(
                at + 3 * (size_t)corner[0], at + 3 * (size_t)corner[1], at + 3 * (size_t)corner[2]);
        }
    }
    for (size_t i = 0; i < n && closed; i++) closed = volume[i] > -1e-8;
    free(root);
    free(volume);
    return closed;
}

/* Draws all maps for a picture whose longer edge has so many pixels.  Small pictures show less, and
   have fewer. */
static shade_result studio_open_for(studio *s, const model *m, int pixels, float turn, int threads,
                                    mesh_progress *progress, void *user)
{
    const int sky = STUDIO_WHOLE    ? STUDIO_SKY
                    : pixels <= 128 ? 24
                    : pixels <= 256 ? 40
                                    : STUDIO_SKY;
    const int key = pixels <= 256 && !STUDIO_WHOLE ? 8 : STUDIO_KEY;
    const int sky_size = pixels <= 128 && !STUDIO_WHOLE ? 128 : 256, key_size = 2 * sky_size;
    size_t sky_texels = (size_t)sky_size * (size_t)sky_size, key_texels = 4 * sky_texels;
    s->ground = pixels <= 128 ? STUDIO_GROUND / 2 : STUDIO_GROUND;
    studio_place(s, sky, key);
    studio_place_key(s, turn);
    s->memory =
        (float *)malloc(sizeof(float) * ((size_t)sky * sky_texels + (size_t)key * key_texels));
    if (!s->memory) return SHADE_ERROR_CAPACITY;
    for (int i = 0; i < sky + key; i++) {
        s->map[i].size = i < sky ? sky_size : key_size;
        s->map[i].depth =
            i < sky ? s->memory + (size_t)i * sky_texels
                    : s->memory + (size_t)sky * sky_texels + (size_t)(i - sky) * key_texels;
    }
    return studio_draw_maps(s, m, 0, threads, progress, user);
}

/* Opens the studio of a model, by the coarser copy of a large one, which studio_turn draws too. */
static shade_result studio_open(studio *s, const model *m, int pixels, float turn, int threads,
                                mesh_progress *progress, void *user)
{
    static const studio none;
    *s = none;
    if (studio_may_thin(m)) {
        if (studio_thin(&s->coarse, m, pixels)) return SHADE_ERROR_CAPACITY;
        m = &s->coarse;
    }
    s->closed = studio_is_closed(m);
    return studio_open_for(s, m, pixels, turn, threads, progress, user);
}

/* Lamps whose maps are not drawn: nothing throws a shadow. */
static inline void studio_open_quick(studio *s)
{
    static const studio none;
    *s = none;
    studio_place(s, 0, 1);
    studio_place_key(s, 0);
}

/* Turns the lamps about the model; those of the sky stay, so that its light does not flicker. */
static inline shade_result studio_turn(studio *s, const model *m, float turn, int threads)
{
    studio_place_key(s, turn);
    return studio_draw_maps(s, s->coarse.part ? &s->coarse : m, s->sky, threads, NULL, NULL);
}

static inline void studio_close(studio *s)
{
    studio_thin_free(&s->coarse);
    free(s->memory);
    s->memory = NULL;
}

/* ---- the ground ------------------------------------------------------------------------------ */

#define STUDIO_GROUND_HALF 2.2f /* half that edge; the shadow fades out toward it */

/* The data that the threads share */
typedef struct studio_shadow {
    const studio *light;
    float level;
    float *dark; /* how much of the light of open ground is missing, 0 .. 1, by texel */
} studio_shadow;

/* One row of texels: how much of the light of open ground is missing there.  Neighbours ask a share
   of the lamps each, whose mean the blur makes: its weights are the same for all four. */
static void studio_shadow_row(void *data, int row)
{
    const studio_shadow *w = (const studio_shadow *)data;
    const int size = w->light->ground; /* blocks, without a rest */
    const float half = STUDIO_GROUND_HALF, step = 2 * half / (float)size;
    const shade_vec3 up = shade_v3(0, 1, 0);
    studio_points p = studio_nowhere;
    studio_rows sky;
    float unused[STUDIO_BLOCK], lamp[STUDIO_BLOCK], open;
    STUDIO_EACH(i)
    {
        studio_put(p.P, i, shade_v3(0, 9, 0));
        studio_put(p.N, i, up);
        studio_put(p.R, i, up);
    }
    studio_sky(w->light, 0, 1, &p, sky, unused);
    open = sky[1][0];
    for (int first = 0; first < size; first += 2 * STUDIO_BLOCK)
        for (int odd = 0; odd < 2; odd++) {
            float *dark = w->dark + row * size + first + odd;
            const int share = odd + 2 * (row & 1);
            float fade[STUDIO_BLOCK], brightest = 0;
            STUDIO_EACH(i)
            {
                const float x = ((float)(first + odd + 2 * i) + 0.5f) * step - half;
                const float z = ((float)row + 0.5f) * step - half;
                studio_put(p.P, i, shade_v3(x, w->level, z));
                fade[i] = 1 - (x * x + z * z) / (half * half);
                fade[i] = fade[i] > 0 ? fade[i] : 0;
                brightest = fade[i] > brightest ? fade[i] : brightest;
            }
            STUDIO_EACH(i) { dark[2 * i] = 0; }
            if (!(brightest > 0)) continue;
            studio_sky(w->light, share, STUDIO_SHARES, &p, sky, unused);
            studio_lamp(w->light, share, STUDIO_SHARES, &p, lamp);
            STUDIO_EACH(i)
            {
                const float bright = (0.72f * (sky[1][i] / open) + 0.28f) * (0.4f * lamp[i] + 0.6f);
                dark[2 * i] = fade[i] * (1 - bright);
            }
        }
}

/* Weighted means over three texels along a line of steps */
static void studio_blur(float *line, int step, int count)
{
    float before = line[0];
    for (int i = 1; i < count - 1; i++) {
        float here = line[i * step];
        line[i * step] = 0.25f * before + 0.5f * here + 0.25f * line[(i + 1) * step];
        before = here;
    }
}

/* Finds the shadow of a mesh in the light of its studio.  Returns 1 where memory is out. */
static int studio_cast(ground *g, const studio *light, const owned_mesh *m, int threads)
{
    const int size = light->ground, texels = size * size;
    studio_shadow work = { light, ground_lowest(&m->view, 1) - 0.002f, NULL };
    work.dark = (float *)malloc((size_t)texels * sizeof *work.dark);
    g->shadow = (uint8_t *)calloc((size_t)texels, 4);
    g->size = size;
    g->half = g->reach = STUDIO_GROUND_HALF;
    g->level = work.level;
    if (!work.dark || !g->shadow) {
        free(work.dark);
        return 1;
    }

    bands_run(threads, size, studio_shadow_row, &work);
    for (int k = 0; k < 4 * size; k++) {
        studio_blur(work.dark + k % size * size, 1, size);
        studio_blur(work.dark + k % size, size, size);
    }
    for (int i = 0; i < texels; i++) g->shadow[4 * i + 3] = (uint8_t)(255 * work.dark[i] + 0.5f);
    free(work.dark);
    return 0;
}
#endif
