/* 04_interpolation.c - where light is computed, on a coarse sphere (UW, Massey, Berkeley).  Above:
   once for each face (flat); at each vertex, whose colours are interpolated (Gouraud); at each
   pixel, where normals are interpolated (Phong).  The lamp stands so that the middle of one facet
   mirrors it into the eye.  Gouraud computes no light there and misses the highlight.  Below: the
   sphere turns until a vertex has come to that place, and Gouraud's highlight flashes.
   Below each sphere: its brightest blue.  The clay has no blue, so that all of it is highlight.
   Try mesh_sphere(56, 40): Gouraud's sphere can hardly be told from Phong's.

   cc -O2 -I. examples/lessons/04_interpolation.c -lm -o interpolation && ./interpolation */
#define SHADE_IMPLEMENTATION
#include "shade.h"
#include "../shared/mesh.h"
#include "../shared/label.h"

enum { SIZE = 300, ROW = 360, SLICES = 14, STACKS = 10 };    /* pixels of a panel; of the sphere */
typedef struct sphere_shown { const char *name; shade_shading shading; float turned; } sphere_shown;

/* A point of the sphere, counted in stacks from the pole and slices around */
static shade_vec3 point(float stack, float slice)
{
    shade_vec2 polar = mesh_turn(stack / (2 * STACKS)), around = mesh_turn(slice / SLICES);
    return shade_v3(polar.y * around.x, polar.x, -polar.y * around.y);
}

/* The greatest blue of a panel as a display shows it, 0 .. 255 */
static int brightest_blue(const canvas *c, int x, int y)
{
    float most = 0;
    for (int i = 0; i < SIZE * SIZE; i++) {
        float blue = canvas_pixel(c, x + i % SIZE, y + i / SIZE).z;
        most = blue > most ? blue : most;
    }
    return (int)(255 * shade_srgb_from_linear(shade_v3(0, 0, most)).z + 0.5f);
}

int main(int argc, char **argv)
{
    static const sphere_shown shown[6] = {
        { "flat", SHADE_SHADING_PER_FACE, 0 },
        { "Gouraud", SHADE_SHADING_PER_VERTEX, 0 },
        { "Phong", SHADE_SHADING_PER_FRAGMENT, 0 },
        { "Gouraud, not turned yet", SHADE_SHADING_PER_VERTEX, 0 },
        { "Gouraud, turned by 7.44°", SHADE_SHADING_PER_VERTEX, 7.44f },
        { "Gouraud, turned by 14.88°", SHADE_SHADING_PER_VERTEX, 14.88f } };
    const shade_vec3 facet = point(3.5f, 11.5f), vertex = point(4, 12);    /* 14.88 degrees apart */
    const shade_vec3 L = shade_mirror(shade_v3(0, 0, 1), facet), axis = shade_cross(vertex, facet);
    const shade_light lamp = shade_directional_light(shade_neg(L), shade_v3(1, 1, 1));
    const shade_material clay = { { 0, 0, 0 }, { 0.55f, 0.18f, 0 }, { 0.55f, 0.18f, 0 },
                                  { 0.6f, 0.6f, 0.6f }, 90 };
    shade_draw_state state = { .material = &clay,
                               .lighting = { &lamp, 1, .ambient = { 0.10f, 0.11f, 0.13f } } };
    owned_mesh sphere = mesh_sphere(SLICES, STACKS);
    canvas c = canvas_new(960, 2 * ROW, 2);
    char text[40];

    state.view = shade_mat4_look_at(shade_v3(0, 0, 6), shade_v3(0, 0, 0), shade_v3(0, 1, 0));
    state.projection = shade_mat4_perspective(0.37f, 1, 1, 10);
    canvas_dark(&c.target);
    for (int i = 0; i < 6; i++) {
        const int x = 320 * (i % 3) + 10, y = ROW * (i / 3) + 4;
        shade_target panel = canvas_panel(&c, x, y, SIZE, SIZE);
        state.shading = shown[i].shading;
        state.model = shade_mat4_rotation(shade_radians(shown[i].turned), axis);
        shade_draw_mesh(&panel, &sphere.view, &state, NULL);
        sprintf(text, "brightest blue: %d of 255", brightest_blue(&c, x, y));
        label_caption(&c, x + SIZE / 2, y + SIZE + 24, shade_v3(0.7f, 0.7f, 0.7f), shown[i].name,
                      text);
    }
    mesh_free(&sphere);
    return canvas_save(&c, argc, argv, "interpolation.ppm");
}
