/* 08_normal_matrix.c - a teapot squashed to a third of its height.  Left: its normals went through
   the matrix of its points and lean the wrong way, the pot still shines like a tall one.  Middle:
   through shade_normal_matrix.  Right, to compare: the normals of the squashed triangles.

   cc -O2 -I. examples/08_normal_matrix.c -lm -o normal_matrix && ./normal_matrix */
#define SHADE_IMPLEMENTATION
#include "shade.h"
#include "shapes.h"
#include "label.h"

int main(int argc, char **argv)
{
    static const char *const name[3] = { "matrix of points", "normal matrix", "true normals" };
    shade_material gold = { { 0, 0, 0 }, { 0.30f, 0.17f, 0.04f }, { 0.45f, 0.26f, 0.06f },
                            { 0.75f, 0.58f, 0.3f }, 40 };
    shade_mat4 squash = shade_mat4_scaling(shade_v3(1, 0.35f, 1));
    shade_mat3 of_normals[2] = { shade_mat3_from_mat4(squash), shade_normal_matrix(squash) };
    shade_light lamp = shade_directional_light(shade_v3(0.35f, -1, -0.55f),
                                               shade_v3(1, 0.97f, 0.92f));
    shade_draw_state state = { 0 };
    canvas c = canvas_new(960, 260, 2);

    state.view = shade_mat4_look_at(shade_v3(0, 6, 11), shade_v3(0.22f, 0.2f, 0),
                                    shade_v3(0, 1, 0));
    state.projection = shade_mat4_perspective(0.46f, 320 / 260.0f, 5, 25);
    state.material = &gold;
    state.lighting.lights = &lamp, state.lighting.light_count = 1;
    state.lighting.ambient = shade_v3(0.20f, 0.21f, 0.25f);
    canvas_gradient(&c.target, shade_v3(0.045f, 0.05f, 0.06f), shade_v3(0.012f, 0.013f, 0.016f));
    for (int i = 0; i < 3; i++) {
        shade_target panel = canvas_panel(&c, 320 * i, 0, 320, 260);
        owned_mesh pot = shape_teapot(40);
        for (int k = 0; k < pot.view.vertex_count; k++) {
            float *p = pot.positions + 3 * k, *q = pot.normals + 3 * k;
            shade_vec3 P = shade_mat4_transform_point(squash, shade_v3(p[0], p[1], p[2]));
            shade_vec3 N = shade_mat3_transform(of_normals[i > 0], shade_v3(q[0], q[1], q[2]));
            mesh_put(&pot, k, P, shade_normalize(N), 0, 0);
        }
        if (i == 2) pot.view.normals = NULL;    /* of each face, then */
        shade_draw_mesh(&panel, &pot.view, &state, NULL);
        label_center(&c, 320 * i + 160, 244, 22, shade_v3(0.7f, 0.7f, 0.7f), name[i]);
        mesh_free(&pot);
    }
    return canvas_save(&c, argc, argv, "normal_matrix.ppm");
}
