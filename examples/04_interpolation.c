/* 04_interpolation.c - where the light is computed, on a sphere of few triangles: once per face,
   per vertex and spread (Gouraud), or per pixel with the normal spread (Phong).  Gouraud's misses
   the highlight in the middle of a facet and shows the edges as Mach bands; only the outline tells
   that the right one is no sphere.

   cc -O2 -I. examples/04_interpolation.c -lm -o interpolation && ./interpolation */
#define SHADE_IMPLEMENTATION
#include "shade.h"
#include "mesh.h"
#include "label.h"

int main(int argc, char **argv)
{
    static const shade_shading shading[3] = { SHADE_SHADING_PER_FACE, SHADE_SHADING_PER_VERTEX,
                                              SHADE_SHADING_PER_FRAGMENT };
    static const char *const name[3] = { "flat", "gouraud", "phong" };
    shade_material orange = { { 0, 0, 0 }, { 0.62f, 0.20f, 0.03f }, { 0.62f, 0.20f, 0.03f },
                              { 0.7f, 0.7f, 0.7f }, 90 };
    shade_light lamp = shade_directional_light(shade_v3(0, 0, -1), shade_v3(1, 1, 1));
    shade_draw_state state = { 0 };
    owned_mesh sphere = mesh_sphere(14, 10);
    shade_vec2 around = mesh_turn(11.5f / 14), polar = mesh_turn(3.5f / 20);
    shade_vec3 facet = shade_v3(polar.y * around.x, polar.x, -polar.y * around.y);
    canvas c = canvas_new(960, 380, 2);

    /* The lamp stands so that the mirror direction at the middle of one facet meets the eye. */
    facet = shade_mirror(shade_v3(0, 0, 1), facet);
    lamp.position = shade_v4(facet.x, facet.y, facet.z, 0);
    state.view = shade_mat4_look_at(shade_v3(0, 0, 6), shade_v3(0, 0, 0), shade_v3(0, 1, 0));
    state.projection = shade_mat4_perspective(0.39f, 1, 1, 10);
    state.material = &orange;
    state.lighting.lights = &lamp, state.lighting.light_count = 1;
    state.lighting.ambient = shade_v3(0.10f, 0.11f, 0.13f);

    canvas_gradient(&c.target, shade_v3(0.045f, 0.05f, 0.06f), shade_v3(0.012f, 0.013f, 0.016f));
    for (int i = 0; i < 3; i++) {
        shade_target panel = canvas_panel(&c, 320 * i, 12, 320, 320);
        state.shading = shading[i];
        shade_draw_mesh(&panel, &sphere.view, &state, NULL);
        label_center(&c, 320 * i + 160, 359, 22, shade_v3(0.7f, 0.7f, 0.7f), name[i]);
    }
    mesh_free(&sphere);
    return canvas_save(&c, argc, argv, "interpolation.ppm");
}
