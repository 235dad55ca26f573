/* ground.h - a soft shadow on the ground below a mesh: a square picture of how dark each place is,
   and the draw that lays it over what is drawn.

       ground g;
       ground_cast(&g, &mesh);                                  (once, some milliseconds)
       shade_draw_mesh(&target, &mesh, &state, NULL);
       ground_draw(&g, &target, state.model, state.view, state.projection);
       ground_free(&g);

   ground_cast darkens sharply what a part of the mesh touches, and widely and less what it hangs
   above; studio.h fills the same picture from its lamps.  The mesh lies about the origin, within
   distance 1; +y is up. */
#ifndef MODEL_GROUND_H
#define MODEL_GROUND_H

#include "../../shared/mesh.h"
#include <string.h>

typedef struct ground {
    uint8_t *shadow; /* RGBA8, size x size: black, its alpha how dark; NULL: no shadow is drawn */
    int size;
    float half;  /* the picture covers x and z from -half to half, */
    float reach; /* and has no shadow beyond -reach to reach */
    float level; /* y of the ground */
} ground;

static inline void ground_free(ground *g)
{
    free(g->shadow);
    g->shadow = NULL;
}

/* The lowest y of a mesh, or most where that is lower */
static inline float ground_lowest(const shade_mesh *mesh, float most)
{
    for (int i = 0; i < mesh->vertex_count; i++)
        most = fminf(most, mesh->positions[3 * (size_t)i + 1]);
    return most;
}

/* Draws the shadow over the picture, where the mesh does not hide the ground and the ground is seen
   from above; at places the mesh. */
static inline shade_result ground_draw(const ground *g, const shade_target *target, shade_mat4 at,
                                       shade_mat4 view, shade_mat4 projection)
{
    static const uint32_t quad[6] = { 0, 1, 2, 0, 2, 3 };
    const float h = g->reach, y = g->level, low = 0.5f - 0.5f * h / g->half, high = 1 - low;
    const float positions[12] = { -h, y, -h, -h, y, h, h, y, h, h, y, -h };
    const float texcoords[8] = { low, low, low, high, high, high, high, low };
    const shade_material black = { .shininess = 0 };
    const shade_texture map = { .pixels = g->shadow,
                                .width = g->size,
                                .height = g->size,
                                .wrap_u = SHADE_WRAP_CLAMP,
                                .wrap_v = SHADE_WRAP_CLAMP };
    const shade_mesh mesh = { .positions = positions,
                              .texcoords = texcoords,
                              .vertex_count = 4,
                              .indices = quad,
                              .index_count = 6 };
    shade_draw_state state = { .model = at, .view = view, .projection = projection };
    state.material = &black;
    state.diffuse_map = &map;
    state.raster.cull = SHADE_CULL_BACK;
    state.raster.blend = SHADE_BLEND_OVER;
    state.raster.depth_read_only = 1;
    return shade_draw_mesh(target, &mesh, &state, NULL);
}

/* ---- a shadow without lamps ------------------------------------------------------------------ */

enum { GROUND_SIZE = 128 }; /* texels along an edge of the shadow */
#define GROUND_HALF 1.5f    /* half that edge */

/* The height of the mesh above each texel, from a depth-only draw as seen from below: x to the
   right, z downward, 0 at the ground and 1 at height 2 */
static inline void ground_heights(const shade_mesh *mesh, float level, float *height)
{
    shade_target target = { .width = GROUND_SIZE, .height = GROUND_SIZE, .depth = height };
    shade_draw_state state = { .material = NULL };
    state.view =
        shade_mat4_look_at(shade_v3(0, level, 0), shade_v3(0, level + 1, 0), shade_v3(0, 0, -1));
    state.projection =
        shade_mat4_ortho(-GROUND_HALF, GROUND_HALF, -GROUND_HALF, GROUND_HALF, -0.01f, 2.01f);
    shade_clear(&target, shade_v4(0, 0, 0, 0), 1);
    shade_draw_mesh(&target, mesh, &state, NULL);
}

/* Means over 2 radius + 1 texels along a line of steps; beyond its ends there are zeros */
static inline void ground_blur_line(float *line, int step, int radius)
{
    float sum = 0, mean[GROUND_SIZE];
    for (int i = 0; i < radius; i++) sum += line[i * step];
    for (int i = 0; i < GROUND_SIZE; i++) {
        if (i + radius < GROUND_SIZE) sum += line[(i + radius) * step];
        if (i > radius) sum -= line[(i - radius - 1) * step];
        mean[i] = sum / (float)(2 * radius + 1);
    }
    for (int i = 0; i < GROUND_SIZE; i++) line[i * step] = mean[i];
}

/* Three means in a row come near a bell curve. */
static inline void ground_blur(float *map, int radius)
{
    for (int k = 0; k < 3 * GROUND_SIZE; k++) {
        ground_blur_line(map + k % GROUND_SIZE * GROUND_SIZE, 1, radius);
        ground_blur_line(map + k % GROUND_SIZE, GROUND_SIZE, radius);
    }
}

/* Stores the darkness as alpha, and finds how far from the middle there is any, with the texels it
   is blended to. */
static inline void ground_keep(ground *g, const float *touch, const float *wide)
{
    int reach = 0;
    for (int i = 0; i < GROUND_SIZE * GROUND_SIZE; i++) {
        float light = (1 - 0.6f * touch[i]) * (1 - 0.75f * wide[i]);
        int x = abs(2 * (i % GROUND_SIZE) + 1 - GROUND_SIZE);
        int z = abs(2 * (i / GROUND_SIZE) + 1 - GROUND_SIZE), far_off = x > z ? x : z;
        g->shadow[4 * i + 3] = (uint8_t)(255 * (1 - light) + 0.5f);
        if (g->shadow[4 * i + 3] && far_off > reach) reach = far_off;
    }
    g->reach = GROUND_HALF * fminf(1, (float)(reach + 3) / GROUND_SIZE);
}

static inline void ground_cast(ground *g, const shade_mesh *mesh)
{
    enum { TEXELS = GROUND_SIZE * GROUND_SIZE };
    float *touch = (float *)example_memory(2 * TEXELS, sizeof(float)), *wide = touch + TEXELS;
    g->shadow = (uint8_t *)example_memory(TEXELS, 4);
    g->size = GROUND_SIZE;
    g->half = GROUND_HALF;
    g->level = ground_lowest(mesh, 0);
    ground_heights(mesh, g->level, touch);
    for (int i = 0; i < TEXELS; i++) {
        wide[i] = (1 - touch[i]) * (1 - touch[i]);
        touch[i] = fmaxf(0, 1 - 6 * touch[i]);
    }
    ground_blur(touch, 1);
    ground_blur(wide, 6);
    ground_keep(g, touch, wide);
    free(touch);
}

#endif
