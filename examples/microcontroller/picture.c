/* picture.c - a teapot on a tiled floor under a spotlight: 320 x 240 pixels of 5-6-5 bits with
   ordered dither and a depth buffer, by shaders of its own, without floating-point libraries. */
#include "picture.h"
#include "teapot_table.h"

static const shade_vec3 eye = { -1.6f, 5.6f, 11.5f };

typedef struct scene {
    shade_mat4 clip_from_world;
    shade_lighting lighting;
    shade_material material;
} scene;

static void put(shade_vertices *SHADE_RESTRICT out, int i, const scene *s, shade_vec3 P,
                shade_vec3 N)
{
    shade_vec4 c = shade_mat4_transform(s->clip_from_world, shade_v4(P.x, P.y, P.z, 1));
    out->clip[0][i] = c.x;
    out->clip[1][i] = c.y;
    out->clip[2][i] = c.z;
    out->clip[3][i] = c.w;
    out->varying[0][i] = P.x;
    out->varying[1][i] = P.y;
    out->varying[2][i] = P.z;
    out->varying[3][i] = N.x;
    out->varying[4][i] = N.y;
    out->varying[5][i] = N.z;
}

static void pot_vertex(const void *uniforms, const shade_vertex_ids *SHADE_RESTRICT in,
                       shade_vertices *SHADE_RESTRICT out)
{
    SHADE_EACH_LANE(i) {    /* the arrays stay in flash */
        const float *v = teapot_vertices[in->index[i]];
        put(out, i, (const scene *)uniforms, shade_v3(v[0], v[1], v[2]),
            shade_v3(v[3], v[4], v[5]));
    }
}

static void floor_vertex(const void *uniforms, const shade_vertex_ids *SHADE_RESTRICT in,
                         shade_vertices *SHADE_RESTRICT out)
{
    static const int8_t corner[6][2] = {
        { -1, 1 }, { 1, 1 }, { 1, -1 }, { -1, 1 }, { 1, -1 }, { -1, -1 }
    };
    SHADE_EACH_LANE(i) {
        const int8_t *c = corner[in->index[i]];
        put(out, i, (const scene *)uniforms, shade_v3(14 * (float)c[0], 0, 14 * (float)c[1]),
            shade_v3(0, 1, 0));
    }
}

static void pot_fragment(const void *uniforms, const shade_fragments *SHADE_RESTRICT in,
                         shade_colors *SHADE_RESTRICT out)
{
    const scene *s = (const scene *)uniforms;
    const shade_rows rows = { .position = in->varying[0], .normal = in->varying[3] };
    shade_lit_lanes(&s->lighting, &s->material, eye, &rows, out->color[0]);
}

static void floor_fragment(const void *uniforms, const shade_fragments *SHADE_RESTRICT in,
                           shade_colors *SHADE_RESTRICT out)
{
    const scene *s = (const scene *)uniforms;
    float tile[3][SHADE_LANES];
    const shade_rows rows = { .position = in->varying[0], .normal = in->varying[3],
                              .albedo = tile[0] };
    SHADE_EACH_LANE(i) {
        int odd = ((int)(0.6f * in->varying[0][i] + 64) + (int)(0.6f * in->varying[2][i] + 64)) & 1;
        tile[0][i] = odd ? 0.5f : 0.10f;
        tile[1][i] = odd ? 0.46f : 0.13f;
        tile[2][i] = odd ? 0.38f : 0.18f;
    }
    shade_lit_lanes(&s->lighting, &s->material, eye, &rows, out->color[0]);
}

void picture_draw(const shade_target *target)
{
    shade_light lamps[2];
    shade_pipeline pipeline = { .vertex = floor_vertex, .fragment = floor_fragment, .varyings = 6 };
    scene s = { .lighting = { .lights = lamps, .light_count = 2 } };
    shade_mat4 view = shade_mat4_look_at(eye, shade_v3(0.15f, 1.05f, 0), shade_v3(0, 1, 0));

    lamps[0] = shade_spot_light(shade_v3(-5, 9, 5), shade_v3(5, -8, -5), 0.5f, 60,
                                shade_v3(1.9f, 1.7f, 1.4f));
    lamps[1] = shade_directional_light(shade_v3(-1, -0.6f, -0.1f), shade_v3(0.12f, 0.2f, 0.4f));
    s.lighting.ambient = shade_v3(0.03f, 0.035f, 0.05f);
    s.clip_from_world = shade_mat4_mul(shade_mat4_perspective(0.56f, 4 / 3.0f, 1, 60), view);
    s.material.ambient = s.material.diffuse = shade_v3(1, 1, 1);
    pipeline.uniforms = &s;
    shade_clear(target, shade_v4(0.004f, 0.006f, 0.014f, 1), 1);
    shade_draw(target, &pipeline, NULL, 6, 6, NULL);
    pipeline.vertex = pot_vertex;
    pipeline.fragment = pot_fragment;
    s.material.ambient = s.material.diffuse = shade_v3(0.75f, 0.22f, 0.06f);
    s.material.specular = shade_v3(0.6f, 0.55f, 0.5f);
    s.material.shininess = 60;
    shade_draw(target, &pipeline, teapot_indices, TEAPOT_INDICES, TEAPOT_VERTICES, NULL);
}

void picture_strips(picture_send *send)
{
    static uint16_t color[PICTURE_WIDTH * PICTURE_ROWS];
    static float depth[PICTURE_WIDTH * PICTURE_ROWS];
    shade_target strip = { .width = PICTURE_WIDTH,
                           .height = PICTURE_HEIGHT,
                           .format = SHADE_FORMAT_RGB565_SWAPPED,
                           .srgb = 1,
                           .dither = 1 };
    strip.color = color;
    strip.depth = depth;
    strip.row_count = PICTURE_ROWS;
    for (; strip.row_offset < PICTURE_HEIGHT; strip.row_offset += PICTURE_ROWS) {
        picture_draw(&strip);
        send((const uint8_t *)color, sizeof color);
    }
}
