/* 24_maps.c - a picture as material (UW: material parameters may come from a texture).  Left: as
   diffuse_map, which multiplies k_d and k_a.  Right: read by a fragment shader, which finds the
   water by the picture's alpha.  Only water has k_s.
   Try gleam without t[3][i]: land and ice shine as well.

   cc -O2 -I. examples/lessons/24_maps.c -lm -o maps && ./maps        writes maps.ppm */
#define SHADE_IMPLEMENTATION
#include "shade.h"
#include "../shared/mesh.h"
#include "../shared/paint.h"
#include "../shared/label.h"

enum { WIDTH = 1024, HEIGHT = 512 };
static const shade_vec3 eye = { 0, 0, 6 };
static const shade_material ground = { { 0, 0, 0 }, { 1, 1, 1 }, { 1, 1, 1 }, { 0, 0, 0 }, 0 };
static const shade_material water = { .specular = { 0.5f, 0.5f, 0.45f }, .shininess = 60 };
typedef struct scene { mesh_scene place; shade_lighting lighting; shade_texture map; } scene;

static void planet(const void *uniforms, const shade_fragments *SHADE_RESTRICT in,
                   shade_colors *SHADE_RESTRICT out)
{
    const scene *s = (const scene *)uniforms;
    shade_rows rows = { .position = in->varying[0], .normal = in->varying[3] };
    float t[4][SHADE_LANES], gleam[3][SHADE_LANES];
    shade_sample_lanes(&s->map, in->varying[6], in->varying[7], NULL, t[0]);
    shade_lit_lanes(&s->lighting, &water, eye, &rows, gleam[0]);
    rows.albedo = t[0];
    shade_lit_lanes(&s->lighting, &ground, eye, &rows, out->color[0]);
    for (int k = 0; k < 3; k++) {
        SHADE_EACH_LANE(i) out->color[k][i] += t[3][i] * gleam[k][i];
    }
}

int main(int argc, char **argv)
{
    static float texels[WIDTH * HEIGHT][4];
    const shade_vec3 grey = { 0.7f, 0.7f, 0.7f };
    const shade_light sun = shade_directional_light(shade_v3(0.8f, -0.6f, -1),
                                                    shade_v3(1, 0.97f, 0.93f));
    owned_mesh ball = mesh_sphere(128, 64);
    scene s = { .place = { .mesh = &ball },
                .lighting = { &sun, 1, .ambient = { 0.02f, 0.02f, 0.03f } },
                .map = { .pixels = texels, .width = WIDTH, .height = HEIGHT,
                         .format = SHADE_FORMAT_RGBA32F } };
    shade_draw_state state = { .material = &ground, .diffuse_map = &s.map };
    shade_pipeline pipeline = { mesh_vertex, planet, &s, .varyings = 8 };
    canvas c = canvas_new(960, 488, 2);
    shade_target left = canvas_panel(&c, 20, 5, 430, 430);
    shade_target right = canvas_panel(&c, 510, 5, 430, 430);

    noise_planet(texels, WIDTH, HEIGHT);
    state.model = shade_mat4_mul(shade_mat4_rotation(0.4f, shade_v3(1, 0, 0.25f)),
                                 shade_mat4_rotation(2.1f, shade_v3(0, 1, 0)));
    state.view = shade_mat4_look_at(eye, shade_v3(0, 0, 0), shade_v3(0, 1, 0));
    state.projection = shade_mat4_perspective(0.35f, 1, 0.1f, 10);
    state.lighting = s.lighting;
    s.place.model = state.model;
    s.place.clip_from_world = shade_mat4_mul(state.projection, state.view);
    canvas_dark(&c.target);
    shade_draw_mesh(&left, &ball.view, &state, NULL);
    mesh_draw(&right, &pipeline, &ball);
    label_center(&c, 235, 466, 26, grey, "diffuse map: k_d = k_a = rgb(u, v)");
    label_center(&c, 725, 466, 26, grey, "and a shader: k_s = alpha(u, v) of water");
    mesh_free(&ball);
    return canvas_save(&c, argc, argv, "maps.ppm");
}
