/* 31_warped_space.c - UW's "warped space".  Left: eye, rays, frustum, three equal cubes.  Middle:
   the same after projection and division by w: the frustum is a cube, rays are parallel, near
   things are large, planes are planes.  Right: without z, the picture; each ray is a point of it.
   Try near_z = 0.2: everything crowds toward the far end, where few values of depth are left.

   cc -O2 -I. examples/lessons/31_warped_space.c -lm -o warped_space && ./warped_space */
#define SHADE_IMPLEMENTATION
#include "shade.h"
#include "../shared/shapes.h"
#include "../shared/label.h"

static const uint32_t paint[8] = { 0xE08040, 0xD0B030, 0x5090E0,    /* of cubes; then of rays */
                                   0xF0E070, 0xF070D8, 0x50E0C8, 0xF06050, 0xF0F0F0 };

/* Cube k: lit, because angles will change, then taken through m */
static void cube(const shade_target *t, const shade_draw_state *state, int k, shade_mat4 m)
{
    static const shade_vec3 at[3] = { { -0.35f, -0.25f, -2.75f }, { 0.65f, -0.1f, -3.9f },
                                      { -0.5f, 0.75f, -5.2f } };
    shade_light lamp = shade_directional_light(shade_v3(-0.3f, -1, -0.5f), shade_rgb(paint[k]));
    shade_lighting lighting = { &lamp, 1, .ambient = shade_scale(lamp.diffuse, 0.2f) };
    owned_mesh c = shape_moved(mesh_cube(), shape_at(at[k].x, at[k].y, at[k].z, 0.35f, 0.5f));
    shade_vec3 *P = (shade_vec3 *)(void *)c.positions, *N = (shade_vec3 *)(void *)c.normals;
    shade_vec3 color[24];
    for (int i = 0; i < 24; i++) {
        color[i] = shade_lit(&lighting, NULL, N[i], P[i], N[i]);
        P[i] = shade_mat4_transform_point(m, P[i]);
    }
    c.view.colors = &color[0].x;
    shade_draw_mesh(t, &c.view, state, NULL);
    mesh_free(&c);
}

/* Corner k of a square around the axis, taken through m */
static shade_vec3 corner(shade_mat4 m, int k, float h, float z)
{
    return shade_mat4_transform_point(m, shade_v3((k + 1) & 2 ? h : -h, k & 2 ? h : -h, z));
}

int main(int argc, char **argv)
{
    static const char *const name[3] = { "world", "warped", "picture" };
    static const char *const formula[3] = { "x, y, z: rays meet in the COP",
                                            "x/w, y/w, z/w: parallel rays", "x/w, y/w: points" };
    const int left[4] = { 0, 380, 700, 960 };
    const float near_z = 2, far_z = 6;
    const shade_vec3 origin = { 0, 0, 0 }, up = { 0, 1, 0 }, grey = { 0.7f, 0.7f, 0.7f };
    shade_mat4 project = shade_mat4_perspective(0.7f, 1, near_z, far_z), space[3], view[3];
    shade_draw_state state = { .lighting.ambient = { 1, 1, 1 } };
    shade_line_state pen = { .cap = SHADE_CAP_SQUARE };
    canvas c = canvas_new(960, 400, 3);
    view[0] = shade_mat4_look_at(shade_v3(10.5f, 5.5f, 2), shade_v3(0, -0.1f, -3.1f), up);
    view[1] = shade_mat4_look_at(shade_v3(4.3f, 2.4f, 3.4f), origin, up);
    view[2] = space[0] = shade_mat4_identity();
    space[1] = space[2] = shade_mat4_mul(shade_mat4_scaling(shade_v3(1, 1, -1)), project);
    canvas_dark(&c.target);
    for (int i = 0; i < 3; i++) {    /* in 1 and 2 z is turned round: the space is right-handed */
        shade_target panel = canvas_panel(&c, left[i], 0, left[i + 1] - left[i], 345);
        const float aspect = (float)panel.width / (float)panel.height, x = 1.55f * aspect;
        shade_mat4 out = shade_mat4_mul(space[i], shade_mat4_inverse(project));
        state.view = view[i];
        state.projection = shade_mat4_perspective(0.62f, aspect, 1, 30);
        if (i == 2) state.projection = shade_mat4_ortho(-x, x, -1.55f, 1.55f, -2, 2);
        pen.raster.depth_test = i < 2 ? SHADE_COMPARE_LESS : SHADE_COMPARE_ALWAYS;
        for (int k = 0; k < 3; k++) cube(&panel, &state, k, space[i]);
        pen.clip_from_points = shade_mat4_mul(state.projection, view[i]);
        for (int k = 0; k < 17; k++) {    /* near, far, rays */
            const float h = k < 12 ? 1 : k < 16 ? 0.6f : 0, z = k < 4 ? -1 : 1;
            shade_vec3 e[2] = { corner(out, k, h, k < 8 ? z : -1), corner(out, k + (k < 8), h, z) };
            shade_vec3 ink = shade_rgb(k < 12 ? 0xB8B8B8 : paint[k - 9]);
            if (i == 0 && k >= 8) e[0] = origin;    /* the eye */
            pen.color = shade_v4(ink.x, ink.y, ink.z, 1);
            pen.width = i == 2 && k >= 12 ? 18 : 4;
            shade_draw_lines(&panel, e, 2, &pen, NULL);
        }
        label_caption(&c, (left[i] + left[i + 1]) / 2, 362, grey, name[i], formula[i]);
    }
    return canvas_save(&c, argc, argv, "warped_space.ppm");
}
