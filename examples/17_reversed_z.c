/* 17_reversed_z.c - islands in a sea, the far plane a million away.  Left: the usual depth spends
   nearly all of its values next to the eye; far away sea and land fall on the same ones and show
   through each other.  Right: with reversed depth floats are as fine as the distances ask for.

   cc -O2 -I. examples/17_reversed_z.c -lm -o reversed_z && ./reversed_z */
#define SHADE_IMPLEMENTATION
#include "shade.h"
#include "mesh.h"
#include "label.h"
#include "noise.h"

/* Height 1 in the middle, below the sea at the rim; sand, grass, rock by height */
static owned_mesh island(int cells)
{
    owned_mesh m = mesh_plane(1, cells);
    m.view.colors = m.colors = (float *)example_memory((size_t)m.view.vertex_count, 12);
    for (int i = 0; i < m.view.vertex_count; i++) {
        float *p = m.positions + 3 * i, *c = m.colors + 3 * i, h, r = p[0] * p[0] + p[2] * p[2];
        shade_vec3 k = shade_v3(0.6f, 0.48f, 0.26f);
        h = 0.9f * (1 - r) - 0.25f;
        for (float f = 2; f < 40; f *= 2)
            h += 0.7f / f * (noise(shade_v3(f * p[0] + 9, f, f * p[2])) - 0.5f) * (f < 3 ? 2 : 1);
        p[1] = 0.45f * h;
        if (h > 0.08f) k = shade_v3(0.07f, 0.20f, 0.03f);
        if (h > 0.5f) k = shade_v3(0.30f, 0.25f, 0.20f);
        c[0] = k.x, c[1] = k.y, c[2] = k.z;
    }
    shade_mesh_normals(&m.view, (shade_vec3 *)(void *)m.normals);
    return m;
}

int main(int argc, char **argv)
{
    static const char *const name[2] = { "standard depth", "reversed depth" };
    static const float place[8][3] = {    /* x per distance, distance, size */
        { -0.18f, 0.6f, 0.08f }, { 0.22f, 0.9f, 0.10f }, { -0.05f, 1.6f, 0.16f },
        { 0.3f, 2.6f, 0.3f }, { -0.28f, 4, 0.5f }, { 0.1f, 8, 1 }, { -0.12f, 20, 3 },
        { 0.3f, 40, 7 }
    };
    const float near_z = 0.005f, far_z = 1e6f;
    shade_material ground = { .diffuse = { 1, 1, 1 }, .ambient = { 1, 1, 1 } };
    const shade_vec3 blue = { 0.02f, 0.12f, 0.20f }, sheen = { 0.7f, 0.7f, 0.7f };
    shade_material water = { .diffuse = blue, .ambient = blue, .specular = sheen, .shininess = 10 };
    shade_light sun = shade_directional_light(shade_v3(-0.8f, -0.6f, -0.5f),
                                              shade_v3(1.2f, 1.1f, 0.95f));
    shade_draw_state state = { 0 };
    owned_mesh land = island(64), sea = mesh_plane(3e5f, 300);
    canvas c = canvas_new(960, 400, 2);

    state.view = shade_mat4_look_at(shade_v3(0, 700, 0), shade_v3(0, 0, -4000),
                                    shade_v3(0, 1, 0));
    state.lighting.lights = &sun, state.lighting.light_count = 1;
    state.lighting.ambient = shade_v3(0.3f, 0.35f, 0.45f);
    for (int i = 0; i < 2; i++) {
        shade_target panel = canvas_panel(&c, 480 * i, 0, 480, 400), clear = panel;
        canvas_gradient(&panel, shade_v3(0.12f, 0.25f, 0.5f), shade_v3(0.8f, 0.85f, 0.85f));
        state.projection = shade_mat4_perspective(0.7f, 480 / 400.0f, near_z, far_z);
        if (i) {
            state.projection = shade_mat4_perspective_reversed(0.7f, 480 / 400.0f, near_z);
            state.raster.depth_zero_to_one = 1, state.raster.depth_test = SHADE_COMPARE_GREATER;
            clear.color = NULL;
            shade_clear(&clear, shade_v4(0, 0, 0, 0), 0);
        }
        state.material = &water, state.model = shade_mat4_identity();
        shade_draw_mesh(&panel, &sea.view, &state, NULL);
        state.material = &ground;
        for (int k = 0; k < 8; k++) {
            float z = 4000 * place[k][1], size = 4000 * place[k][2];
            state.model = shade_mat4_mul(shade_mat4_translation(shade_v3(place[k][0] * z, 0, -z)),
                                         shade_mat4_scaling(shade_v3(size, size, size)));
            shade_draw_mesh(&panel, &land.view, &state, NULL);
        }
        label_center(&c, 480 * i + 240, 390, 22, shade_v3(0.9f, 0.9f, 0.9f), name[i]);
    }
    mesh_free(&land), mesh_free(&sea);
    return canvas_save(&c, argc, argv, "reversed_z.ppm");
}
