/* 16_ray_cast.c - one scene drawn two ways: by the rasterizer, and by a ray through the centre of
   each pixel that looks for the nearest triangle.  Right: their difference, magnified, and how
   many pixels differ by more than 1/255: those whose centre lies within rounding of an edge.

   cc -O2 -I. examples/16_ray_cast.c -lm -o ray_cast && ./ray_cast        writes ray_cast.ppm */
#define SHADE_IMPLEMENTATION
#include "shade.h"
#include "mesh.h"
#include "label.h"
#include "teapot.h"

static shade_vec3 fetch(const float *p) { return shade_v3(p[0], p[1], p[2]); }

/* Color is left as it is where the ray meets nothing. */
static void cast(const owned_mesh *m, const shade_draw_state *s, shade_vec3 eye, shade_ray ray,
                 float *color)
{
    float nearest = 1e30f, t;
    shade_vec3 b, P, N, rgb;
    for (const uint32_t *v = m->indices; v < m->indices + m->view.index_count; v += 3) {
        const float *p = m->positions, *n = m->normals;
        if (!shade_intersect(ray, fetch(p + 3 * v[0]), fetch(p + 3 * v[1]), fetch(p + 3 * v[2]),
                             &t, &b) || t >= nearest) continue;
        nearest = t, P = shade_madd(ray.origin, t, ray.direction);
        N = shade_madd(shade_scale(fetch(n + 3 * v[0]), b.x), b.y, fetch(n + 3 * v[1]));
        N = shade_madd(N, b.z, fetch(n + 3 * v[2]));
        rgb = shade_lit(&s->lighting, s->material, eye, P, N);
        color[0] = rgb.x, color[1] = rgb.y, color[2] = rgb.z;
    }
}

int main(int argc, char **argv)
{
    enum { WIDTH = 310, HEIGHT = 250 };
    const int n = 5;
    const shade_vec3 eye = { -2, 5, 12 };
    shade_material jade = { { 0, 0, 0 }, { 0.05f, 0.26f, 0.12f }, { 0.05f, 0.26f, 0.12f },
                            { 0.5f, 0.5f, 0.5f }, 30 };
    shade_light lamp = shade_point_light(shade_v3(-5, 9, 8), shade_v3(1.1f, 1.05f, 1));
    shade_draw_state state = { 0 };
    owned_mesh pot = mesh_new(teapot_vertex_count(n), teapot_index_count(n));
    canvas c = canvas_new(960, 300, 1);
    shade_target panel[3];
    char text[40];
    int different = 0;

    teapot_build(n, pot.positions, pot.normals, NULL, pot.indices);
    state.view = shade_mat4_look_at(eye, shade_v3(0.2f, 1.3f, 0), shade_v3(0, 1, 0));
    state.projection = shade_mat4_perspective(0.43f, (float)WIDTH / HEIGHT, 5, 20);
    state.material = &jade, state.lighting.lights = &lamp, state.lighting.light_count = 1;
    state.lighting.ambient = shade_v3(0.2f, 0.2f, 0.2f);
    shade_clear(&c.target, shade_v4(0.02f, 0.02f, 0.025f, 1), 1);
    for (int i = 0; i < 3; i++) {
        panel[i] = canvas_panel(&c, 5 + 320 * i, 5, WIDTH, HEIGHT);
        canvas_gradient(&panel[i], shade_v3(0.09f, 0.10f, 0.12f), shade_v3(0.03f, 0.03f, 0.04f));
    }
    shade_draw_mesh(&panel[0], &pot.view, &state, NULL);
    for (int i = 0; i < WIDTH * HEIGHT; i++) {
        size_t at = 4 * (size_t)(i / WIDTH * panel[0].stride + i % WIDTH);
        float *color[3], most = 0, x = (float)(i % WIDTH) + 0.5f, y = (float)(i / WIDTH) + 0.5f;
        for (int k = 0; k < 3; k++) color[k] = (float *)panel[k].color + at;
        cast(&pot, &state, eye, shade_pixel_ray(state.view, state.projection, WIDTH, HEIGHT, x, y),
             color[1]);
        for (int k = 0; k < 3; k++) {
            float d = color[0][k] - color[1][k];
            if (d < 0) d = -d;
            if (d > most) most = d;
            color[2][k] = 250 * d;
        }
        different += most > 1 / 255.0f;
    }
    label_center(&c.target, 160, 272, 2, shade_v3(0.7f, 0.7f, 0.7f), "rasterized");
    label_center(&c.target, 480, 272, 2, shade_v3(0.7f, 0.7f, 0.7f), "ray cast");
    sprintf(text, "%d of %d differ", different, WIDTH * HEIGHT);
    label_center(&c.target, 800, 272, 2, shade_v3(0.7f, 0.7f, 0.7f), text);
    mesh_free(&pot);
    return canvas_save(&c, argc, argv, "ray_cast.ppm");
}
