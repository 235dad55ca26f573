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

/* How much of the light of open ground is missing: RGBA8, black, in shadow; dark is scratch. */
static void ground_cast(const studio *light, float level, float *dark, uint8_t *shadow)
{
    const shade_vec3 up = shade_v3(0, 1, 0), open = studio_sky(light, shade_v3(0, 9, 0), up);
    for (int i = 0; i < GROUND_SIZE * GROUND_SIZE; i++) {
        float step = 2 * GROUND_REACH / GROUND_SIZE, sky, lamp, fade;
        shade_vec3 P = shade_v3(((float)(i % GROUND_SIZE) + 0.5f) * step - GROUND_REACH, level,
                                ((float)(i / GROUND_SIZE) + 0.5f) * step - GROUND_REACH);
        fade = 1 - (P.x * P.x + P.z * P.z) / (GROUND_REACH * GROUND_REACH);
        dark[i] = 0;
        if (fade <= 0) continue;
        sky = studio_sky(light, P, up).y / open.y, lamp = studio_lamp(light, P, up);
        dark[i] = fade * (1 - (0.72f * sky + 0.28f) * (0.4f * lamp + 0.6f));
    }
    for (int k = 0; k < 4 * GROUND_SIZE; k++) {
        ground_blur(dark + k % GROUND_SIZE * GROUND_SIZE, 1);
        ground_blur(dark + k % GROUND_SIZE, GROUND_SIZE);
    }
    memset(shadow, 0, 4 * GROUND_SIZE * GROUND_SIZE);
    for (int i = 0; i < GROUND_SIZE * GROUND_SIZE; i++)
        shadow[4 * i + 3] = (uint8_t)(255 * dark[i] + 0.5f);
}

static shade_result draw_ground(const shade_target *target, const studio *light, const camera *c,
                                const owned_mesh *m)
{
    enum { TEXELS = GROUND_SIZE * GROUND_SIZE };
    static const uint32_t quad[6] = { 0, 1, 2, 0, 2, 3 };
    static const float texcoords[8] = { 0, 0, 0, 1, 1, 1, 1, 0 };
    const shade_material black = { .shininess = 0 };
    const float h = GROUND_REACH;
    float *dark = (float *)malloc(TEXELS * sizeof *dark), y = 1;
    uint8_t *shadow = (uint8_t *)malloc(4 * TEXELS);
    shade_result result = SHADE_ERROR_CAPACITY;
    for (int i = 0; i < m->view.vertex_count; i++) y = fminf(y, m->positions[3 * (size_t)i + 1]);
    y -= 0.002f;
    if (dark && shadow) {
        const float positions[12] = { -h, y, -h, -h, y, h, h, y, h, h, y, -h };
        shade_texture map = { .pixels = shadow, .width = GROUND_SIZE, .height = GROUND_SIZE };
        shade_mesh mesh = { .positions = positions, .texcoords = texcoords, .indices = quad };
        shade_draw_state state = { .view = c->view, .projection = c->projection };
        ground_cast(light, y, dark, shadow);
        mesh.vertex_count = 4, mesh.index_count = 6;
        map.wrap_u = map.wrap_v = SHADE_WRAP_CLAMP;
        state.material = &black, state.diffuse_map = &map;
        state.raster.cull = SHADE_CULL_BACK, state.raster.blend = SHADE_BLEND_OVER;
        state.raster.depth_read_only = 1;
        result = shade_draw_mesh(target, &mesh, &state, NULL);
    }
    free(dark), free(shadow);
    return result;
}
#endif
