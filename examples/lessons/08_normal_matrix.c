/* 08_normal_matrix.c - a sphere whose points are transformed by M, which presses it to a third of
   its height.  Left: its normals are transformed by M as well and no longer stand on the surface,
   so that it shines like an egg.  Right: by the normal matrix, (M^-1)^T up to its scale, from
   shade_normal_matrix (Massey).  The numbers are mean angles to the ellipsoid's true normals.
   Try size { 0.7f, 0.7f, 0.7f }: both are right, because M scales evenly.

   cc -O2 -I. examples/lessons/08_normal_matrix.c -lm -o normal_matrix && ./normal_matrix */
#define SHADE_IMPLEMENTATION
#include "shade.h"
#include "../shared/mesh.h"
#include "../shared/label.h"
#include <math.h>

static const shade_vec3 size = { 1, 0.35f, 1 };
/* A sphere of 2 n slices, its points moved by M and its normals by of_normals */
static owned_mesh pressed(int n, shade_mat4 M, shade_mat3 of_normals)
{
    owned_mesh m = mesh_sphere(2 * n, n);
    for (int k = 0; k < m.view.vertex_count; k++) {
        const float *p = m.positions + 3 * k, *q = m.normals + 3 * k;
        shade_vec3 N = shade_mat3_transform(of_normals, shade_v3(q[0], q[1], q[2]));
        mesh_put(&m, k, shade_mat4_transform_point(M, shade_v3(p[0], p[1], p[2])),
                 shade_normalize(N), 0, 0);
    }
    return m;
}

/* Mean angle in degrees between the normals of a mesh and those of the ellipsoid it lies on */
static double mean_angle(const owned_mesh *m)
{
    const shade_vec3 *p = (const shade_vec3 *)(const void *)m->positions;
    const shade_vec3 *n = (const shade_vec3 *)(const void *)m->normals;
    const shade_vec3 k = { 1 / (size.x * size.x), 1 / (size.y * size.y), 1 / (size.z * size.z) };
    double sum = 0;
    for (int i = 0; i < m->view.vertex_count; i++)
        sum += acos(fmin(1, (double)shade_dot(n[i], shade_normalize(shade_mul(p[i], k)))));
    return sum / m->view.vertex_count * 57.29578;
}

int main(int argc, char **argv)
{
    static const char *const name[2] = { "normals by M", "normals by (M^{−1})^T" };
    const shade_vec3 grey = { 0.7f, 0.7f, 0.7f }, white = { 1, 0.97f, 0.92f };
    const shade_material gold = { { 0, 0, 0 }, { 0.30f, 0.17f, 0.04f }, { 0.45f, 0.26f, 0.06f },
                                  { 0.75f, 0.58f, 0.3f }, 40 };
    const shade_mat4 M = shade_mat4_scaling(size);
    const shade_mat3 by[2] = { shade_mat3_from_mat4(M), shade_normal_matrix(M) };
    const shade_light lamp = shade_directional_light(shade_v3(0.35f, -1, -0.55f), white);
    shade_draw_state state = { .material = &gold,
                               .lighting = { &lamp, 1, .ambient = { 0.20f, 0.21f, 0.25f } } };
    shade_line_state pen = { .width = 4, .color = { 0.3f, 0.75f, 0.9f, 1 },    /* some lie twice */
                             .raster = { .depth_test = SHADE_COMPARE_LESS_EQUAL } };
    canvas c = canvas_new(960, 380, 3);
    char text[80];

    state.view = shade_mat4_look_at(shade_v3(0, 3.2f, 7), shade_v3(0, 0.05f, 0), shade_v3(0, 1, 0));
    state.projection = shade_mat4_perspective(0.24f, 480 / 310.0f, 5, 25);
    pen.clip_from_points = shade_mat4_mul(state.projection, state.view);
    canvas_dark(&c.target);
    for (int i = 0; i < 2; i++) {
        shade_target panel = canvas_panel(&c, 480 * i, 0, 480, 310);
        owned_mesh body = pressed(48, M, by[i]), few = pressed(10, M, by[i]);
        const shade_vec3 *p = (const shade_vec3 *)(const void *)few.positions;
        const shade_vec3 *n = (const shade_vec3 *)(const void *)few.normals;
        shade_draw_mesh(&panel, &body.view, &state, NULL);
        for (int k = 0; k < few.view.vertex_count; k++) {
            shade_vec3 stick[2] = { p[k], shade_madd(p[k], 0.22f, n[k]) };
            shade_draw_lines(&panel, stick, 2, &pen, NULL);
        }
        sprintf(text, "%.1f° off the true ones on average", mean_angle(&body));
        label_caption(&c, 480 * i + 240, 345, grey, name[i], text);
        mesh_free(&body);
        mesh_free(&few);
    }
    sprintf(text, "points: by M = scale(%g, %g, %g)     sticks: normals", (double)size.x,
            (double)size.y, (double)size.z);
    label_center(&c, 480, 28, 19, grey, text);
    return canvas_save(&c, argc, argv, "normal_matrix.ppm");
}
