/* 04_interpolation.c - where light is computed, on a sphere of few triangles (UW, Massey).  Above:
   once per face (flat); per vertex, with colours interpolated (Gouraud); per pixel, with normals
   interpolated (Phong), where only the outline shows the triangles.  The highlight lies inside a
   facet, where Gouraud misses it.  Below: the sphere turns until a vertex meets the highlight, and
   Gouraud's shading flashes.  The numbers are the brightest blue of each sphere, which is all
   highlight: the clay has no blue.
   Try mesh_sphere(56, 40): Gouraud's sphere can hardly be told from Phong's.

   cc -O2 -I. examples/lessons/04_interpolation.c -lm -o interpolation && ./interpolation */
#define SHADE_IMPLEMENTATION
#include "shade.h"
#include "../shared/mesh.h"
#include "../shared/label.h"

enum { SIZE = 300 };    /* pixels of a panel */

/* The greatest blue of a panel as a display shows it, 0 .. 255 */
static int brightest(const canvas *c, int x, int y)
{
    float most = 0;
    for (int i = 0; i < SIZE * SIZE; i++) {
        float blue = canvas_pixel(c, x + i % SIZE, y + i / SIZE).z;
        most = blue > most ? blue : most;
    }
    return (int)(255 * shade_srgb_from_linear(shade_v3(0, 0, most)).z + 0.5f);
}

/* A point of the sphere of 14 slices and 10 stacks */
static shade_vec3 at(float stack, float slice)
{
    shade_vec2 polar = mesh_turn(stack / 20), around = mesh_turn(slice / 14);
    return shade_v3(polar.y * around.x, polar.x, -polar.y * around.y);
}

int main(int argc, char **argv)
{
    static const shade_shading shading[3] = { SHADE_SHADING_PER_FACE, SHADE_SHADING_PER_VERTEX,
                                              SHADE_SHADING_PER_FRAGMENT };
    static const char *const name[3] = { "flat", "Gouraud", "Phong" };
    const shade_vec3 grey = { 0.7f, 0.7f, 0.7f };
    shade_material clay = { { 0, 0, 0 }, { 0.55f, 0.18f, 0 }, { 0.55f, 0.18f, 0 },
                            { 0.6f, 0.6f, 0.6f }, 90 };
    shade_light lamp = shade_directional_light(shade_v3(0, 0, -1), shade_v3(1, 1, 1));
    shade_draw_state state = { 0 };
    owned_mesh sphere = mesh_sphere(14, 10);
    shade_vec3 facet = at(3.5f, 11.5f), vertex = at(4, 12);    /* 14.88 degrees apart */
    shade_vec3 axis = shade_cross(vertex, facet), to_lamp = shade_mirror(shade_v3(0, 0, 1), facet);
    canvas c = canvas_new(960, 2 * SIZE + 120, 2);
    char text[40];

    /* The lamp stands so that the mirror direction at the middle of one facet meets the eye. */
    lamp.position = shade_v4(to_lamp.x, to_lamp.y, to_lamp.z, 0);
    state.view = shade_mat4_look_at(shade_v3(0, 0, 6), shade_v3(0, 0, 0), shade_v3(0, 1, 0));
    state.projection = shade_mat4_perspective(0.35f, 1, 1, 10);
    state.material = &clay;
    state.lighting.lights = &lamp;
    state.lighting.light_count = 1;
    state.lighting.ambient = shade_v3(0.10f, 0.11f, 0.13f);

    canvas_dark(&c.target);
    for (int i = 0; i < 6; i++) {
        int x = 320 * (i % 3) + 10, y = i / 3 * (SIZE + 58) + 4, tenths = 149 * (i % 3) / 2;
        shade_target panel = canvas_panel(&c, x, y, SIZE, SIZE);
        state.shading = i < 3 ? shading[i] : SHADE_SHADING_PER_VERTEX;
        state.model = shade_mat4_rotation(i < 3 ? 0 : (float)(i - 3) / 2 * 0.2597f, axis);
        shade_draw_mesh(&panel, &sphere.view, &state, NULL);
        sprintf(text, "Gouraud, turned by %d.%d°", tenths / 10, tenths % 10);
        label_center(&c, x + SIZE / 2, y + SIZE + 24, 22, grey, i < 3 ? name[i] : text);
        sprintf(text, "highlight: %d of 255", brightest(&c, x, y));
        label_center(&c, x + SIZE / 2, y + SIZE + 46, 19, grey, text);
    }
    mesh_free(&sphere);
    return canvas_save(&c, argc, argv, "interpolation.ppm");
}
