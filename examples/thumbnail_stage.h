/* thumbnail_stage.h - where the camera stands, and the shadow on the ground below the model. */
#ifndef EXAMPLES_THUMBNAIL_STAGE_H
#define EXAMPLES_THUMBNAIL_STAGE_H

#include "thumbnail_light.h"

/* ---- the camera ----------------------------------------------------------------------------- */

typedef struct camera {
    shade_mat4 view, projection;
    shade_vec3 eye;
} camera;

/* The camera looks along a fixed direction.  Every point must lie inside four planes through the
   eye, and each plane gives one linear bound: their extremes give the nearest eye, and the
   sideways shift that centres. */
static camera camera_frame(const owned_mesh *m, float aspect)
{
    const float half = shade_radians(14), margin = 1.10f;
    shade_mat4 turn =
        shade_mat4_look_at(shade_v3(0, 0.36f, 1), shade_v3(0, 0, 0), shade_v3(0, 1, 0));
    shade_mat4 lens, world;
    float slope_y, slope_x, left = -9, right = -9, below = -9, above = -9, front = -9, back = 9, d;
    camera c;
    turn.col[3] = shade_v4(0, 0, 0, 1);
    lens = shade_mat4_perspective(2 * half, 1, 1, 2);
    slope_y = 1 / lens.col[1].y, slope_x = slope_y * aspect;
    for (size_t i = 0; i < 3 * (size_t)m->view.vertex_count; i += 3) {
        const float *p = m->positions + i;
        shade_vec3 q = shade_mat4_transform_direction(turn, shade_v3(p[0], p[1], p[2]));
        right = fmaxf(right, q.x + slope_x * q.z), left = fmaxf(left, -q.x + slope_x * q.z);
        above = fmaxf(above, q.y + slope_y * q.z), below = fmaxf(below, -q.y + slope_y * q.z);
        front = fmaxf(front, q.z), back = fminf(back, q.z);
    }
    d = fmaxf((right + left) / (2 * slope_x), (above + below) / (2 * slope_y)) * margin;
    d = fmaxf(d, front + 0.05f);
    c.view = shade_mat4_mul(
        shade_mat4_translation(shade_v3((left - right) / 2, (below - above) / 2, -d)), turn);
    c.projection =
        shade_mat4_perspective(2 * half, aspect, 0.04f * (d - front) + 0.001f, d - back + 4);
    world = shade_mat4_inverse(c.view);
    c.eye = shade_v3(world.col[3].x, world.col[3].y, world.col[3].z);
    return c;
}

/* ---- the ground ----------------------------------------------------------------------------- */

enum { GROUND_SIZE = 256 }; /* texels along an edge of the shadow */
#define GROUND_REACH 2.2f   /* half that edge; the shadow fades out toward it */

typedef struct ground {
    const studio *light;
    float level; /* its y */
    float *dark; /* how much of the light of open ground is missing */
    uint8_t *shadow; /* the same as RGBA8, black; NULL: no ground is drawn */
} ground;

/* Means over three texels along a line of steps */
static void ground_blur(float *line, int step)
{
    float before = line[0];
    for (int i = 1; i < GROUND_SIZE - 1; i++) {
        float here = line[i * step];
        line[i * step] = 0.25f * before + 0.5f * here + 0.25f * line[(i + 1) * step];
        before = here;
    }
}

/* Row by row how much of the light of open ground is missing */
static void ground_row(void *data, int row)
{
    const ground *g = (const ground *)data;
    const shade_vec3 up = shade_v3(0, 1, 0), open = studio_sky(g->light, shade_v3(0, 9, 0), up);
    for (int i = 0; i < GROUND_SIZE; i++) {
        float step = 2 * GROUND_REACH / GROUND_SIZE, sky, lamp, fade;
        float *dark = g->dark + row * GROUND_SIZE + i;
        shade_vec3 P = shade_v3(((float)i + 0.5f) * step - GROUND_REACH, g->level,
                                ((float)row + 0.5f) * step - GROUND_REACH);
        fade = 1 - (P.x * P.x + P.z * P.z) / (GROUND_REACH * GROUND_REACH);
        *dark = 0;
        if (fade <= 0) continue;
        sky = studio_sky(g->light, P, up).y / open.y, lamp = studio_lamp(g->light, P, up);
        *dark = fade * (1 - (0.72f * sky + 0.28f) * (0.4f * lamp + 0.6f));
    }
}

static void ground_free(ground *g)
{
    free(g->dark);
    free(g->shadow);
}

/* Returns 1 where memory is out. */
static int ground_cast(ground *g, const studio *light, const owned_mesh *m, int threads)
{
    enum { TEXELS = GROUND_SIZE * GROUND_SIZE };
    g->light = light, g->level = 1;
    g->dark = (float *)malloc(TEXELS * sizeof *g->dark);
    g->shadow = (uint8_t *)calloc(TEXELS, 4);
    if (!g->dark || !g->shadow) return 1;
    for (int i = 0; i < m->view.vertex_count; i++)
        g->level = fminf(g->level, m->positions[3 * (size_t)i + 1]);
    g->level -= 0.002f;
    bands_run(threads, GROUND_SIZE, ground_row, g);
    for (int k = 0; k < 4 * GROUND_SIZE; k++) {
        ground_blur(g->dark + k % GROUND_SIZE * GROUND_SIZE, 1);
        ground_blur(g->dark + k % GROUND_SIZE, GROUND_SIZE);
    }
    for (int i = 0; i < TEXELS; i++) g->shadow[4 * i + 3] = (uint8_t)(255 * g->dark[i] + 0.5f);
    return 0;
}

static shade_result ground_draw(const ground *g, const shade_target *target, const camera *c)
{
    static const uint32_t quad[6] = { 0, 1, 2, 0, 2, 3 };
    static const float texcoords[8] = { 0, 0, 0, 1, 1, 1, 1, 0 };
    const shade_material black = { .shininess = 0 };
    const float h = GROUND_REACH, y = g->level;
    const float positions[12] = { -h, y, -h, -h, y, h, h, y, h, h, y, -h };
    shade_texture map = { .pixels = g->shadow, .width = GROUND_SIZE, .height = GROUND_SIZE };
    shade_mesh mesh = { .positions = positions, .texcoords = texcoords, .indices = quad };
    shade_draw_state state = { .view = c->view, .projection = c->projection };
    mesh.vertex_count = 4, mesh.index_count = 6;
    map.wrap_u = map.wrap_v = SHADE_WRAP_CLAMP;
    state.material = &black, state.diffuse_map = &map;
    state.raster.cull = SHADE_CULL_BACK, state.raster.blend = SHADE_BLEND_OVER;
    state.raster.depth_read_only = 1;
    return shade_draw_mesh(target, &mesh, &state, NULL);
}
#endif
