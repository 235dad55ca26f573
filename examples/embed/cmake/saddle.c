/* saddle.c - a surface over a grid, its normals by shade_mesh_normals. */
#include "saddle.h"

enum { N = 33 };                 /* vertices along each side */

shade_result saddle_draw(const shade_target *target, float turn)
{
    float positions[N * N][3];
    uint32_t indices[(N - 1) * (N - 1)][6];
    shade_vec3 normals[N * N];
    shade_mesh mesh = { .positions = positions[0], .vertex_count = N * N };
    shade_light lamp = shade_point_light(shade_v3(4, -2, 5), shade_v3(1, 1, 1));
    shade_material jade = shade_linear_material(shade_preset_material(SHADE_PRESET_JADE));
    shade_draw_state state = { .material = &jade };

    for (int k = 0; k < N * N; k++) {
        float x = (float)(k % N) / 16 - 1, y = (float)(k / N) / 16 - 1;
        positions[k][0] = x;
        positions[k][1] = y;
        positions[k][2] = (x * x - 3 * y * y) * x / 2;
    }
    for (uint32_t k = 0; k < (N - 1) * (N - 1); k++) {
        uint32_t a = k % (N - 1) + k / (N - 1) * N, b = a + N;
        uint32_t two[] = { a, a + 1, b + 1, a, b + 1, b };
        for (int i = 0; i < 6; i++) indices[k][i] = two[i];
    }
    mesh.indices = indices[0];
    mesh.index_count = sizeof indices / sizeof indices[0][0];
    shade_mesh_normals(&mesh, normals);
    mesh.normals = &normals[0].x;

    state.model = shade_mat4_rotation(turn, shade_v3(0, 0, 1));
    state.view = shade_mat4_look_at(shade_v3(3, -5, 4), shade_v3(0, 0, 0), shade_v3(0, 0, 1));
    state.projection = shade_mat4_perspective(
        0.5f, (float)target->width / (float)target->height, 0.1f, 100);
    state.lighting.lights = &lamp;
    state.lighting.light_count = 1;
    state.lighting.ambient = shade_v3(0.2f, 0.2f, 0.2f);
    state.lighting.flags = SHADE_FLAG_TWO_SIDED;
    shade_clear(target, shade_v4(0.02f, 0.03f, 0.05f, 1), 1);
    return shade_draw_mesh(target, &mesh, &state, NULL);
}
