/* 16_ray_cast.c - one scene drawn two ways: by the rasterizer, and by a ray through each pixel to
   the nearest triangle, then from there to each lamp, which finds the shadows.  Right: the light
   they take; elsewhere the difference, 250 times.  Counted: lit pixels more than 1/255 apart.

   cc -O2 -I. examples/16_ray_cast.c -lm -o ray_cast && ./ray_cast        writes ray_cast.ppm */
#define SHADE_IMPLEMENTATION
#include "shade.h"
#include "shapes.h"
#include "label.h"

enum { WIDTH = 310, HEIGHT = 250, LAMPS = 2 };

/* Whether a triangle lies between the origin of a ray and the lamp r away */
static int hidden(const owned_mesh *m, shade_ray ray, float r)
{
    const shade_vec3 *p = (const shade_vec3 *)(const void *)m->positions;
    float t;
    for (const uint32_t *v = m->indices; v < m->indices + m->view.index_count; v += 3)
        if (shade_intersect(ray, p[v[0]], p[v[1]], p[v[2]], &t, NULL) && t < r) return 1;
    return 0;
}

/* Returns how many lamps what the ray sees does not; rgb stays as it is where it sees nothing. */
static int cast(const owned_mesh *m, shade_draw_state s, shade_ray ray, shade_vec3 *rgb)
{
    const shade_vec3 *n = (const shade_vec3 *)(const void *)m->normals, none = { 0, 0, 0 };
    shade_light lamps[LAMPS];
    shade_vec3 b, P, N, eye = ray.origin;
    float t, r;
    int shadows = 0, hit = shade_pick(&m->view, s.model, ray, &t, &b);
    const uint32_t *v = m->indices + 3 * hit;
    if (hit < 0) return 0;
    N = shade_madd(shade_madd(shade_scale(n[v[0]], b.x), b.y, n[v[1]]), b.z, n[v[2]]);
    P = shade_madd(eye, t, ray.direction);
    ray.origin = shade_madd(P, 0.05f, N);    /* facets lie up to .038 inside the form of N */
    for (int i = 0; i < LAMPS; i++) {
        lamps[i] = s.lighting.lights[i];
        shade_light_at(&lamps[i], P, &ray.direction, &r);
        if (shade_dot(N, ray.direction) <= 0 || !hidden(m, ray, r)) continue;
        lamps[i].diffuse = lamps[i].specular = none, shadows++;
    }
    s.lighting.lights = lamps, *rgb = shade_lit(&s.lighting, s.material, eye, P, N);
    return shadows;
}

int main(int argc, char **argv)
{
    const shade_light lamps[LAMPS] = { shade_point_light(shade_v3(-4, 11, 7), shade_rgb(0xF0D0A0)),
                                       shade_point_light(shade_v3(8, 7, 3), shade_rgb(0x6088C0)) };
    const shade_vec3 grey = { 0.6f, 0.6f, 0.6f }, sky = { 0.10f, 0.10f, 0.11f };
    const shade_material clay = { { 0, 0, 0 }, grey, grey, { 0.25f, 0.25f, 0.25f }, 40 };
    shade_draw_state state = { .material = &clay, .lighting = { lamps, LAMPS, .ambient = sky } };
    owned_mesh m = shape_join(mesh_plane(5, 1), shape_teapot(4));
    canvas c = canvas_new(960, 300, 1);
    shade_target panel = canvas_panel(&c, 5, 5, WIDTH, HEIGHT);
    int lit = 0, different = 0;
    char text[40];
    const char *const name[3] = { "rasterized", "cast, with shadows", text };

    state.view = shade_mat4_look_at(shade_v3(-2, 5, 12), shade_v3(0.2f, 1, 0), shade_v3(0, 1, 0));
    state.projection = shade_mat4_perspective(0.46f, (float)WIDTH / HEIGHT, 5, 25);
    canvas_gradient(&c.target, shade_v3(0.09f, 0.10f, 0.12f), shade_v3(0.02f, 0.02f, 0.025f));
    shade_draw_mesh(&panel, &m.view, &state, NULL);
    for (int i = 0; i < WIDTH * HEIGHT; i++) {
        float *p = (float *)panel.color + 4 * (i / WIDTH * panel.stride + i % WIDTH), worst = 0;
        shade_ray ray = shade_pixel_ray(state.view, state.projection, WIDTH, HEIGHT,
                                        (float)(i % WIDTH) + 0.5f, (float)(i / WIDTH) + 0.5f);
        int shadows = cast(&m, state, ray, (shade_vec3 *)(void *)(p + 4 * 320));
        for (int k = 0; k < 3; k++) {
            float d = fabsf(p[k] - p[4 * 320 + k]);
            p[4 * 640 + k] = shadows ? d : 250 * d, worst = fmaxf(worst, d);
        }
        lit += !shadows, different += !shadows && worst > 1 / 255.0f;
    }
    sprintf(text, "%d of %d lit differ", different, lit);
    for (int i = 0; i < 3; i++) label_center(&c, 160 + 320 * i, 286, 22, grey, name[i]);
    mesh_free(&m);
    return canvas_save(&c, argc, argv, "ray_cast.ppm");
}
