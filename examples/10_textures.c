/* 10_textures.c - pictures on surfaces.  Above: a floor of two triangles; u and v spread linearly
   over the screen (affine) bend at the diagonal, in perspective they lie on the floor.  Below: a
   texture as the diffuse map of a sphere, and read by a shader of one's own, to which its alpha
   says what is water and shines.

   cc -O2 -I. examples/10_textures.c -lm -o textures && ./textures        writes textures.ppm */
#define SHADE_IMPLEMENTATION
#include "shade.h"
#include "mesh.h"
#include "label.h"
#include "noise.h"

enum { WIDTH = 640, HEIGHT = 320 };
static const shade_vec3 eye[2] = { { 0, 1.5f, 2.2f }, { 0, 0, 6 } };
typedef struct scene {
    mesh_scene place;
    shade_draw_state look;
    shade_lighting gleam;
} scene;

static void paint(const void *uniforms, const shade_fragments *SHADE_RESTRICT in,
                  shade_colors *SHADE_RESTRICT out)
{
    const scene *s = (const scene *)uniforms;
    const float *P = in->varying[0], *N = in->varying[3];
    float t[4][SHADE_LANES], g[3][SHADE_LANES];
    shade_sample_lanes(s->look.diffuse_map, in->varying[6], in->varying[7], NULL, t[0]);
    shade_lit_lanes(&s->look.lighting, s->look.material, eye[1], P, N, t[0], NULL, out->color[0]);
    shade_lit_lanes(&s->gleam, s->look.material, eye[1], P, N, NULL, NULL, g[0]);
    for (int k = 0; k < 3; k++) {
        SHADE_EACH_LANE(i) out->color[k][i] += t[3][i] * g[k][i];
    }
}

int main(int argc, char **argv)
{
    static const char *const name[4] = { "affine", "perspective", "diffuse map", "and a shader" };
    static float planet[WIDTH * HEIGHT][4];
    uint8_t tiles[256];
    shade_material white = { .diffuse = { 1, 1, 1 }, .ambient = { 1, 1, 1 },
                             .specular = { 0.8f, 0.8f, 0.7f }, .shininess = 60 };
    shade_texture map[2] = {
        { .pixels = tiles, .width = 8, .height = 8, .filter = SHADE_FILTER_NEAREST, .srgb = 1 },
        { .pixels = planet, .width = WIDTH, .height = HEIGHT, .format = SHADE_FORMAT_RGBA32F }
    };
    shade_light sun = shade_directional_light(shade_v3(1, -0.7f, -1), shade_v3(1.3f, 1.25f, 1.2f));
    shade_pipeline pipeline = { .vertex = mesh_vertex, .fragment = paint, .varyings = 8 };
    owned_mesh mesh[2] = { mesh_plane(1, 1), mesh_sphere(96, 48) };
    scene s = { .look = { .lighting = { .lights = &sun, .model = SHADE_MODEL_LAMBERT } } };
    canvas c = canvas_new(960, 560, 3);

    noise_planet(planet, WIDTH, HEIGHT);
    for (int i = 0; i < 256; i++)
        tiles[i] = (uint8_t)((i / 4 + i / 32) % 2 ? 230 - i % 4 * 15 : 35 + i % 4 * 30);
    canvas_gradient(&c.target, shade_v3(0.045f, 0.05f, 0.06f), shade_v3(0.012f, 0.013f, 0.016f));
    for (int i = 0; i < 4; i++) {
        shade_target panel = canvas_panel(&c, 480 * (i % 2), i / 2 * 280, 480, 280);
        shade_draw_state *look = &s.look;
        look->view = shade_mat4_look_at(eye[i / 2], shade_v3(0, -0.15f, 0), shade_v3(0, 1, 0));
        look->projection = shade_mat4_perspective(i < 2 ? 0.7f : 0.42f, 480 / 280.0f, 0.1f, 10);
        if (i == 2) look->model = shade_mat4_mul(shade_mat4_rotation(0.35f, shade_v3(1, 0, 0.5f)),
                                                 shade_mat4_rotation(2.1f, shade_v3(0, 1, 0)));
        else if (i < 2) look->model = shade_mat4_identity();
        look->lighting.light_count = i / 2, look->diffuse_map = &map[i / 2];
        look->lighting.ambient = i < 2 ? shade_v3(1, 1, 1) : shade_v3(0.02f, 0.02f, 0.03f);
        look->material = &white, s.gleam = look->lighting;
        s.gleam.model = SHADE_MODEL_BLINN_PHONG, s.gleam.terms = SHADE_TERM_SPECULAR;
        s.place.mesh = &mesh[i / 2], s.place.model = look->model;
        s.place.clip_from_world = shade_mat4_mul(look->projection, look->view);
        pipeline.uniforms = &s,
        pipeline.interpolation = i ? SHADE_INTERPOLATION_PERSPECTIVE : SHADE_INTERPOLATION_AFFINE;
        if (i == 2) shade_draw_mesh(&panel, &mesh[1].view, look, NULL);
        else shade_draw(&panel, &pipeline, mesh[i / 2].indices, mesh[i / 2].view.index_count,
                        mesh[i / 2].view.vertex_count, NULL);
        label_center(&c, 480 * (i % 2) + 240, i / 2 * 280 + 272, 22, shade_v3(0.7f, 0.7f, 0.7f), name[i]);
    }
    mesh_free(&mesh[0]), mesh_free(&mesh[1]);
    return canvas_save(&c, argc, argv, "textures.ppm");
}
