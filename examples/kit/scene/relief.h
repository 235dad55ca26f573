/* relief.h - bump and normal maps: turns the normals of fragments as the picture of a relief says;
   and pictures of what glows.

   A normal map holds normals in the frame of a triangle: right and up in the picture, and out of
   the surface.  A bump map holds heights, whose slope along the surface tilts the normal [Blinn78].
   Texture coordinates tell how the picture lies on a triangle; each triangle has a frame of its
   own, which leans with the normals between its corners.  Light that is computed per vertex knows
   no reliefs. */
#ifndef MODEL_RELIEF_H
#define MODEL_RELIEF_H

#include "../../shared/lane.h"
#include "../read/model.h"

typedef struct relief {
    const shade_texture *map; /* NULL: none */
    const uint32_t *indices;  /* of the triangles of a draw */
    float strength;           /* of slopes, or the height of white above black */
    int finer;                /* levels from the texture whose lod is known to this one */
    int heights;
    const float *repeat; /* factors by which u and v have been multiplied; NULL: 1 */
} relief;

/* How u and v, which points down in the picture, grow along a triangle: to the side by one unit of
   length they grow by the dot products with these vectors.  Zero where the picture is folded up. */
typedef struct relief_frame {
    shade_vec3 u, v;
} relief_frame;

static relief_frame relief_frame_of(const shade_mesh *m, const relief *r, const uint32_t *corner)
{
    relief_frame f = { { 0, 0, 0 }, { 0, 0, 0 } };
    const float *a = m->texcoords + 2 * (size_t)corner[0];
    const float *b = m->texcoords + 2 * (size_t)corner[1];
    const float *c = m->texcoords + 2 * (size_t)corner[2];
    shade_vec3 p[3], along, across, N, toward[2];
    float square;
    for (int k = 0; k < 3; k++) memcpy(&p[k], m->positions + 3 * (size_t)corner[k], sizeof p[k]);
    along = shade_sub(p[1], p[0]);
    across = shade_sub(p[2], p[0]);
    N = shade_cross(along, across);
    square = shade_dot(N, N);
    if (!(square > 0)) return f;
    toward[0] = shade_scale(shade_cross(across, N), 1 / square);
    toward[1] = shade_scale(shade_cross(N, along), 1 / square);
    f.u = shade_madd(shade_scale(toward[0], b[0] - a[0]), c[0] - a[0], toward[1]);
    f.v = shade_madd(shade_scale(toward[0], b[1] - a[1]), c[1] - a[1], toward[1]);
    if (r->repeat) f.u = shade_scale(f.u, r->repeat[0]);
    if (r->repeat) f.v = shade_scale(f.v, r->repeat[1]);
    return f;
}

/* The normal N, tilted by a texel of a normal map, components -1 .. 1 */
static shade_vec3 relief_tilt(relief_frame f, shade_vec3 N, shade_vec3 texel, float strength)
{
    /* the direction in which u grows while v does not, and across it the one in which v shrinks */
    shade_vec3 T = shade_cross(f.v, shade_cross(f.u, f.v)), B;
    float side;
    T = shade_normalize(shade_madd(T, -shade_dot(T, N), N));
    B = shade_cross(N, T);
    side = shade_dot(B, f.v) > 0 ? -1.0f : 1.0f;
    if (!(shade_dot(T, T) > 0)) return N;
    N = shade_scale(N, fmaxf(texel.z, 0.05f));
    N = shade_madd(N, strength * texel.x, T);
    return shade_normalize(shade_madd(N, strength * texel.y * side, B));
}

/* The normal N, tilted by slopes of heights along u and v */
static shade_vec3 relief_slope(relief_frame f, shade_vec3 N, float along_u, float along_v)
{
    shade_vec3 slope = shade_madd(shade_scale(f.u, along_u), along_v, f.v);
    slope = shade_madd(slope, -shade_dot(slope, N), N);
    return shade_normalize(shade_sub(N, slope));
}

/* The slopes of the heights along u and along v, over two texels of the level that lod asks for */
static void relief_slopes(const relief *r, const float *u, const float *v, const float *lod,
                          float along[2][SHADE_LANES])
{
    const float size[2] = { (float)r->map->width, (float)r->map->height };
    float at[2][SHADE_LANES], step[SHADE_LANES], low[4][SHADE_LANES], high[4][SHADE_LANES];
    for (int a = 0; a < 2; a++) {
        SHADE_EACH_LANE(i)
        {
            step[i] = (float)(1 << (int)fminf(14, fmaxf(0, lod[i]))) / size[a];
            at[0][i] = u[i] - (a == 0 ? step[i] : 0);
            at[1][i] = v[i] - (a == 1 ? step[i] : 0);
        }
        shade_sample_lanes(r->map, at[0], at[1], lod, low[0]);
        SHADE_EACH_LANE(i)
        {
            at[0][i] = u[i] + (a == 0 ? step[i] : 0);
            at[1][i] = v[i] + (a == 1 ? step[i] : 0);
        }
        shade_sample_lanes(r->map, at[0], at[1], lod, high[0]);
        SHADE_EACH_LANE(i)
        {
            float rise = high[0][i] - low[0][i];
            rise += high[1][i] - low[1][i];
            rise += high[2][i] - low[2][i];
            along[a][i] = rise / (6 * step[i]);
        }
    }
}

/* Tilts the normals N, which are unit vectors or nearly so, of fragments whose u and v are rows uv
   and uv + 1 of their varyings. */
static void relief_bend(const relief *r, const shade_mesh *m, const shade_fragments *in, int uv,
                        float N[3][SHADE_LANES])
{
    const float *u = in->varying[uv], *v = in->varying[uv + 1];
    float lod[SHADE_LANES], texel[4][SHADE_LANES];
    relief_frame f = { { 0, 0, 0 }, { 0, 0, 0 } };
    SHADE_EACH_LANE(i) { lod[i] = in->lod[i] + (float)r->finer; }
    if (r->heights)
        relief_slopes(r, u, v, lod, texel);
    else
        shade_sample_lanes(r->map, u, v, lod, texel[0]);
    for (int i = 0; i < in->count; i++) {
        const shade_vec3 flat = shade_normalize(lane(N[0], i));
        shade_vec3 bent;
        if (!i || in->primitive[i] != in->primitive[i - 1])
            f = relief_frame_of(m, r, r->indices + 3 * (size_t)in->primitive[i]);
        if (r->heights) {
            bent = relief_slope(f, flat, r->strength * texel[0][i], r->strength * texel[1][i]);
        } else {
            bent = shade_v3(2 * texel[0][i] - 1, 2 * texel[1][i] - 1, 2 * texel[2][i] - 1);
            bent = relief_tilt(f, flat, bent, r->strength);
        }
        lane_put(N[0], i, bent);
    }
}

/* Levels from the texture known to another one; 0 where none is known */
static int texture_finer(const shade_texture *map, const shade_texture *known)
{
    int finer = 0, width;
    for (width = map->width; known && width >= 2 * known->width; width /= 2) finer++;
    for (width = map->width; known && 2 * width <= known->width; width *= 2) finer--;
    return finer;
}

/* The light that fragments send by themselves: texels of a map times a factor.  It has so many
   levels more than the texture whose lod is known; u and v are rows uv and uv + 1. */
static void glow_light(const shade_texture *map, shade_vec3 factor, int finer,
                       const shade_fragments *in, int uv, float out[3][SHADE_LANES])
{
    const float factors[3] = { factor.x, factor.y, factor.z };
    float texel[4][SHADE_LANES], lod[SHADE_LANES];
    SHADE_EACH_LANE(i) { lod[i] = in->lod[i] + (float)finer; }
    shade_sample_lanes(map, in->varying[uv], in->varying[uv + 1], lod, texel[0]);
    for (int a = 0; a < 3; a++) SHADE_EACH_LANE(i)
        {
            out[a][i] = factors[a] * texel[a][i];
        }
}

/* The relief of a surface, where the level of detail is that of the texture known */
static relief relief_of(const model *m, const model_surface *s, const shade_texture *known)
{
    relief r = { NULL, NULL, s->relief.strength, 0, 0, NULL };
    if (s->relief.picture < 0 || !m->mesh.texcoords) return r;
    r.map = &m->picture[s->relief.picture].map;
    r.heights = m->picture[s->relief.picture].heights;
    r.finer = texture_finer(r.map, known);
    return r;
}

/* ---- how high -------------------------------------------------------------------------------- */

/* The area of a part, over what it takes of the picture; 0: nothing */
static double relief_stretch(const model *m, int part)
{
    const model_part *p = &m->part[part];
    double area = 0, covered = 0;
    for (int i = p->first; i < p->first + p->count; i += 3) {
        const uint32_t *corner = m->mesh.indices + i;
        const float *a = m->mesh.texcoords + 2 * (size_t)corner[0];
        const float *b = m->mesh.texcoords + 2 * (size_t)corner[1];
        const float *c = m->mesh.texcoords + 2 * (size_t)corner[2];
        shade_vec3 v[3], N;
        for (int k = 0; k < 3; k++)
            memcpy(&v[k], m->mesh.positions + 3 * (size_t)corner[k], sizeof v[k]);
        N = shade_cross(shade_sub(v[1], v[0]), shade_sub(v[2], v[0]));
        area += (double)shade_length(N);
        covered += fabs((double)(b[0] - a[0]) * (double)(c[1] - a[1]) -
                        (double)(b[1] - a[1]) * (double)(c[0] - a[0]));
    }
    return covered > 0 ? area / covered : 0;
}

/* Finds the strength of each relief, for positions that are scale times those of the file.  Files
   often do not say how high a bump map is, or in what unit: usual is a root mean square of the
   slope of 1 to 4, and none is steeper than 1 to 2. */
static inline void relief_prepare(model *m, float scale)
{
    for (int i = 0; i < m->part_count && m->surface_count && m->mesh.texcoords; i++) {
        model_relief *r = &m->surface[m->part[i].surface].relief;
        const model_picture *p = r->picture < 0 ? NULL : &m->picture[r->picture];
        double slope;
        if (p && !p->heights && !(r->strength > 0)) r->strength = 1;
        if (!p || !p->heights) continue;
        slope = relief_stretch(m, i);
        slope = slope > 0 ? sqrt(p->slope_square / slope) : 0;
        if (!(slope > 0))
            r->picture = -1;
        else if (!(r->strength > 0))
            r->strength = (float)(0.25 / slope);
        else
            r->strength = (float)fmin((double)(r->strength * scale), 0.5 / slope);
    }
}
#endif
