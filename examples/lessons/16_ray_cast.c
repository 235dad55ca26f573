/* 16_ray_cast.c - one scene drawn two ways (UW).  Left: by the z-buffer, triangle after triangle.
   Middle: by a ray through the centre of each pixel, which looks for the nearest triangle and is
   lit there by the same equation.  Right: a mark on each pixel whose 8-bit codes differ, most of
   them at outlines, where drawn corners are rounded to 1/256 of a pixel.
   Try 0.6f for the last 0.5f of the ray, a tenth of a pixel: 9,365 differ, most at outlines.

   cc -O2 -I. examples/lessons/16_ray_cast.c -lm -o ray_cast && ./ray_cast    writes ray_cast.ppm */
#define SHADE_IMPLEMENTATION
#include "shade.h"
#include "../shared/shapes.h"
#include "../shared/label.h"

enum { WIDTH = 318, HEIGHT = 270, STEP = 321 };    /* pixels of a panel; to the next one */

/* The light that comes back along a ray from triangle number hit, at distance t; share says how
   near to each of its corners */
static shade_vec3 light_at(const owned_mesh *m, const shade_draw_state *s, shade_ray ray, int hit,
                           float t, shade_vec3 share)
{
    const shade_vec3 *normal = (const shade_vec3 *)(const void *)m->normals;
    const uint32_t *corner = m->indices + 3 * hit;
    shade_vec3 P = shade_madd(ray.origin, t, ray.direction);
    shade_vec3 N = shade_scale(normal[corner[0]], share.x);
    N = shade_madd(N, share.y, normal[corner[1]]);
    N = shade_madd(N, share.z, normal[corner[2]]);
    return shade_lit(&s->lighting, s->material, ray.origin, P, N);
}

static void draw_by_rays(const shade_target *panel, const owned_mesh *m, const shade_draw_state *s)
{
    for (int y = 0; y < HEIGHT; y++)
        for (int x = 0; x < WIDTH; x++) {
            shade_ray ray = shade_pixel_ray(s->view, s->projection, WIDTH, HEIGHT,
                                            (float)x + 0.5f, (float)y + 0.5f);
            shade_vec3 share;
            float t;
            int hit = shade_pick(&m->view, s->model, ray, &t, &share);
            if (hit < 0) continue;    /* the background stays */
            canvas_fill(panel, x, y, 1, 1, light_at(m, s, ray, hit, t, share));
        }
}

int main(int argc, char **argv)
{
    const shade_light lamps[2] = { shade_point_light(shade_v3(-4, 11, 7), shade_rgb(0xF0D0A0)),
                                   shade_point_light(shade_v3(8, 7, 3), shade_rgb(0x6088C0)) };
    const shade_vec3 grey = { 0.6f, 0.6f, 0.6f };
    const shade_material clay = { { 0, 0, 0 }, grey, grey, { 0.25f, 0.25f, 0.25f }, 40 };
    shade_draw_state state = { .material = &clay,
                               .lighting = { lamps, 2, .ambient = { 0.10f, 0.10f, 0.11f } } };
    owned_mesh m = shape_join(mesh_plane(5, 1), shape_teapot(4));
    canvas c = canvas_new(960, 340, 1);
    shade_target panel[3];
    char text[60];

    state.view = shade_mat4_look_at(shade_v3(-2, 5, 12), shade_v3(0, 1.2f, 0), shade_v3(0, 1, 0));
    state.projection = shade_mat4_perspective(0.47f, (float)WIDTH / HEIGHT, 5, 25);
    canvas_dark(&c.target);
    for (int i = 0; i < 3; i++) panel[i] = canvas_panel(&c, STEP * i, 0, WIDTH, HEIGHT);
    shade_draw_mesh(&panel[0], &m.view, &state, NULL);
    draw_by_rays(&panel[1], &m, &state);
    int differ = canvas_difference(&panel[0], &panel[1], &panel[2], 3);
    sprintf(text, "%d of %d", differ, WIDTH * HEIGHT);
    label_caption(&c, WIDTH / 2, 298, grey, "z-buffer", "each triangle: its pixels");
    label_caption(&c, WIDTH / 2 + STEP, 298, grey, "rays", "each pixel: its triangle");
    label_caption(&c, WIDTH / 2 + 2 * STEP, 298, grey, "pixels that differ", text);
    mesh_free(&m);
    return canvas_save(&c, argc, argv, "ray_cast.ppm");
}
