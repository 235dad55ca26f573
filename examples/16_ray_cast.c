/* 16_ray_cast.c - one scene drawn two ways (UW).  Left: by the z-buffer.  Middle: by a ray through
   the centre of each pixel to the nearest triangle, and a ray from there to each lamp, which finds
   the shadows too.  Right: the difference, 250 times as bright.  Shadows are not compared; they are
   grey.  The number counts pixels that are more than 1/255 apart.
   Try 0.6f for the last 0.5f of the ray, a tenth of a pixel: 2,200 differ, mostly at outlines.

   cc -O2 -I. examples/16_ray_cast.c -lm -o ray_cast && ./ray_cast        writes ray_cast.ppm */
#define SHADE_IMPLEMENTATION
#include "shade.h"
#include "shared/shapes.h"
#include "shared/label.h"

enum { WIDTH = 318, HEIGHT = 270, LAMPS = 2 };

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
        if (shade_dot(N, ray.direction) <= 0) continue;
        if (shade_pick(&m->view, s.model, ray, &t, NULL) < 0 || t > r) continue;
        lamps[i].diffuse = lamps[i].specular = none;
        shadows++;
    }
    s.lighting.lights = lamps;
    *rgb = shade_lit(&s.lighting, s.material, eye, P, N);
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
    canvas c = canvas_new(960, 340, 1);
    shade_target panel = canvas_panel(&c, 0, 0, WIDTH, HEIGHT);
    int compared = 0, different = 0;
    char text[60];

    state.view = shade_mat4_look_at(shade_v3(-2, 5, 12), shade_v3(0, 1.2f, 0), shade_v3(0, 1, 0));
    state.projection = shade_mat4_perspective(0.43f, (float)WIDTH / HEIGHT, 5, 25);
    canvas_dark(&c.target);
    shade_draw_mesh(&panel, &m.view, &state, NULL);
    for (int i = 0; i < WIDTH * HEIGHT; i++) {
        float *p = (float *)panel.color + 4 * (i / WIDTH * panel.stride + i % WIDTH), worst = 0;
        float *q = p + 4 * 321, *d = p + 4 * 642;
        shade_ray ray = shade_pixel_ray(state.view, state.projection, WIDTH, HEIGHT,
                                        (float)(i % WIDTH) + 0.5f, (float)(i / WIDTH) + 0.5f);
        int shadows = cast(&m, state, ray, (shade_vec3 *)(void *)q);
        for (int k = 0; k < 3; k++) {
            worst = fmaxf(worst, fabsf(p[k] - q[k]));
            d[k] = shadows ? 0.03f : 250 * fabsf(p[k] - q[k]);
        }
        compared += !shadows;
        different += !shadows && worst > 1 / 255.0f;
    }
    sprintf(text, "%d of %d pixels differ", different, compared);
    label_caption(&c, 159, 298, grey, "z-buffer", "each triangle: its pixels");
    label_caption(&c, 480, 298, grey, "rays", "each pixel: its triangles");
    label_caption(&c, 801, 298, grey, "difference × 250", text);
    mesh_free(&m);
    return canvas_save(&c, argc, argv, "ray_cast.ppm");
}
