/* 14_two_sided.c - an open surface, a ribbon whose normals all point to one side.  Lit as they are,
   they leave the other side dark.  Two-sided light turns N toward the viewer.  |N.L|, Shirley's
   (10.4), lights a sheet from behind as well, like paper, which Berkeley's notes dispute.  Last,
   each side has its own material: the ribbon is drawn twice, each time with the other side culled.
   Try a second lamp opposite the first and no flags: the diffuse light of |N.L|, and the highlights
   of that lamp as well.

   cc -O2 -I. examples/lessons/14_two_sided.c -lm -o two_sided && ./two_sided */
#define SHADE_IMPLEMENTATION
#include "shade.h"
#include "../shared/mesh.h"
#include "../shared/label.h"

/* A strip about the x axis that turns once and a half along it */
static owned_mesh ribbon(int cells)
{
    const float turns = 1.5f, length = 6, width = 1;
    owned_mesh m = mesh_plane(1, cells);
    for (int i = 0; i < m.view.vertex_count; i++) {
        float u = m.texcoords[2 * i], r = width * (1 - 2 * m.texcoords[2 * i + 1]);
        shade_vec2 a = mesh_turn(turns * u + 0.1f);
        float spin = turns * 6.2831853f * r;
        shade_vec3 du = shade_v3(length, -a.y * spin, a.x * spin), dr = shade_v3(0, a.x, a.y);
        mesh_put(&m, i, shade_v3(length * (u - 0.5f), r * a.x, r * a.y),
                 shade_normalize(shade_cross(du, dr)), u, r);
    }
    return m;
}

int main(int argc, char **argv)
{
    static const char *const name[4] = { "one-sided", "two-sided", "absolute value",
                                         "two materials" };
    static const char *const formula[4] = { "N·L", "N → −N where N·V < 0", "| N·L |",
                                            "k_d of the side one sees" };
    static const unsigned flags[4] = { 0, SHADE_FLAG_TWO_SIDED, SHADE_FLAG_TWO_SIDED_ABS,
                                       SHADE_FLAG_TWO_SIDED };
    const shade_vec3 grey = { 0.7f, 0.7f, 0.7f };
    shade_material silk[2] = { 0 };
    shade_light lamp = shade_directional_light(shade_v3(0.5f, -0.9f, -0.7f), shade_v3(1, 1, 1));
    shade_draw_state state = { 0 };
    owned_mesh m = ribbon(96);
    canvas c = canvas_new(960, 550, 3);

    for (int k = 0; k < 2; k++) {
        silk[k].diffuse = k ? shade_v3(0.05f, 0.25f, 0.45f) : shade_v3(0.60f, 0.12f, 0.05f);
        silk[k].ambient = silk[k].diffuse;
        silk[k].specular = shade_v3(0.4f, 0.4f, 0.4f);
        silk[k].shininess = 32;
    }
    state.model = shade_mat4_rotation(0.3f, shade_v3(0, 1, 0.4f));
    state.view = shade_mat4_look_at(shade_v3(0, 2, 10), shade_v3(-0.1f, -0.05f, 0),
                                    shade_v3(0, 1, 0));
    state.projection = shade_mat4_perspective(0.31f, 480 / 215.0f, 4, 20);
    state.lighting.lights = &lamp;
    state.lighting.light_count = 1;
    state.lighting.ambient = shade_v3(0.04f, 0.04f, 0.05f);
    canvas_gradient(&c.target, shade_v3(0.10f, 0.11f, 0.13f), shade_v3(0.035f, 0.037f, 0.045f));
    for (int i = 0; i < 4; i++) {
        shade_target panel = canvas_panel(&c, 480 * (i % 2), 275 * (i / 2), 480, 215);
        state.lighting.flags = flags[i];
        for (int side = 0; side < (i < 3 ? 1 : 2); side++) {
            state.material = &silk[side];
            state.raster.cull = i < 3 ? SHADE_CULL_NONE : side ? SHADE_CULL_FRONT : SHADE_CULL_BACK;
            shade_draw_mesh(&panel, &m.view, &state, NULL);
        }
        label_caption(&c, 480 * (i % 2) + 240, 275 * (i / 2) + 236, grey, name[i], formula[i]);
    }
    mesh_free(&m);
    return canvas_save(&c, argc, argv, "two_sided.ppm");
}
