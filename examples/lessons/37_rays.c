/* 37_rays.c - what local shading leaves out.  Left: the equation alone, shade_lit.  Right: with a
   ray to each lamp, which finds the shadows, and one bounce off shiny surfaces: k_s times what the
   bounced ray sees.  UW's next project traces rays; Berkeley says what is "not local".
   Try DEPTH = 3: each mirror shows what the other one mirrors.

   cc -O2 -I. examples/lessons/37_rays.c -lm -o rays && ./rays                    writes rays.ppm */
#define SHADE_IMPLEMENTATION
#include "shade.h"
#include "../shared/balls.h"
#include "../shared/label.h"

enum { DEPTH = 1, BALLS = 3, WIDTH = 960, HEIGHT = 800 };    /* of a panel; samples */
static const shade_vec4 ball[BALLS] = { { -1.5f, 1, -0.6f, 1 }, { 1.3f, 1.2f, -1.4f, 1.2f },
                                        { 0.3f, 0.5f, 0.9f, 0.5f } };    /* w: the radius */
static const uint32_t paint[BALLS + 1] = { 0x282828, 0x503818, 0xCC3028, 0xBCBCB2 };
static const uint32_t mirror[BALLS + 1] = { 0xE6E6E6, 0xDAB062, 0x404040, 0 };
static owned_mesh blocks;

/* What a ray meets first, at t: a ball's number, BALLS for the blocks, -1 for nothing */
static int hit(shade_ray ray, float *t, shade_vec3 *N)
{
    int first = shade_pick(&blocks.view, shade_mat4_identity(), ray, t, NULL);
    if (first >= 0) *N = ((shade_vec3 *)(void *)blocks.normals)[blocks.indices[3 * first]];
    if (first >= 0) first = BALLS;
    for (int k = 0; k < BALLS; k++) {
        shade_vec3 from = shade_sub(ray.origin, shade_v3(ball[k].x, ball[k].y, ball[k].z));
        float near = balls_meet(ray, ball[k]);
        if (near <= 0 || (first >= 0 && near >= *t)) continue;
        *N = shade_scale(shade_madd(from, near, ray.direction), 1 / ball[k].w);
        *t = near;
        first = k;
    }
    return first;
}

/* depth -1: the equation alone */
static shade_vec3 trace(shade_ray ray, int depth)
{
    shade_light lamp[2] = { shade_point_light(shade_v3(4, 6, 4), shade_v3(0.75f, 0.72f, 0.65f)),
                            shade_point_light(shade_v3(-5, 4, 3), shade_v3(0.25f, 0.28f, 0.35f)) };
    shade_lighting lighting = { lamp, 2, .ambient = { 0.12f, 0.13f, 0.15f } };
    const shade_vec3 none = { 0, 0, 0 }, sky = { 0.35f, 0.43f, 0.58f };
    shade_vec3 N = none, P, I;
    float t, r;
    int what = hit(ray, &t, &N);
    if (what < 0) return shade_scale(sky, 1 - 0.8f * fabsf(ray.direction.y));
    shade_vec3 k = shade_rgb(paint[what]);
    shade_material skin = { none, k, k, shade_rgb(mirror[what]), 200 };
    P = shade_madd(shade_madd(ray.origin, t, ray.direction), 1e-3f, N);    /* off the surface */
    for (int j = 0; j < 2 && depth >= 0; j++) {
        shade_ray to = { P, none };
        shade_light_at(&lamp[j], P, &to.direction, &r);
        if (hit(to, &t, &I) >= 0 && t < r) lamp[j].diffuse = lamp[j].specular = none;
    }
    I = shade_lit(&lighting, &skin, ray.origin, P, N);
    if (depth < 0 || depth == DEPTH || !mirror[what]) return I;
    shade_ray bounce = { P, shade_reflect(ray.direction, N) };
    return shade_add(I, shade_mul(skin.specular, trace(bounce, depth + 1)));
}

int main(int argc, char **argv)
{
    const shade_vec3 grey = { 0.7f, 0.7f, 0.7f }, eye = { 0.5f, 3, 7.5f };
    shade_mat4 view = shade_mat4_look_at(eye, shade_v3(0, 0.8f, 0), shade_v3(0, 1, 0));
    shade_mat4 lens = shade_mat4_perspective(0.7f, (float)WIDTH / HEIGHT, 1, 50);
    canvas c = canvas_new(960, 440, 2);
    blocks = shape_moved(mesh_cube(), shape_at(-0.5f, 0.4f, 1.8f, 0.4f, 0.5f));
    blocks = shape_join(mesh_plane(1000, 1), blocks);
    for (int i = 0; i < 2 * WIDTH * HEIGHT; i++) {
        float x = (float)(i % WIDTH) + 0.5f, y = (float)(i / WIDTH / 2) + 0.5f;
        shade_ray ray = shade_pixel_ray(view, lens, WIDTH, HEIGHT, x, y);
        shade_vec3 I = trace(ray, i / WIDTH % 2 ? 0 : -1);    /* right, left */
        ((shade_vec4 *)c.target.color)[i] = shade_v4(I.x, I.y, I.z, 1);
    }
    label_center(&c, 240, 427, 22, grey, "the equation alone");
    label_center(&c, 720, 427, 22, grey, "a ray to each lamp, and one bounce");
    mesh_free(&blocks);
    return canvas_save(&c, argc, argv, "rays.ppm");
}
