/* 15_spots.c - spotlights on a wall, seen from in front (UW: angular fall-off and cutoff).  Above:
   cones of the same width, whose light gathers about the axis S as the exponent e grows.  Below:
   even light, e = 0, in cones of five widths beta.
   Try e = 64 below: at 20 degrees the rim is all but gone, because the light fades before it.

   cc -O2 -I. examples/lessons/15_spots.c -lm -o spots && ./spots        writes spots.ppm */
#define SHADE_IMPLEMENTATION
#include "shade.h"
#include "../shared/mesh.h"
#include "../shared/label.h"

int main(int argc, char **argv)
{
    static const float exponent[5] = { 0, 4, 16, 64, 256 }, degrees[5] = { 5, 10, 15, 20, 25 };
    const shade_vec3 grey = { 0.7f, 0.7f, 0.7f }, paint = { 0.75f, 0.62f, 0.5f };
    const shade_material wall = { .ambient = paint, .diffuse = paint };
    shade_draw_state state = { .material = &wall, .lighting = { .light_count = 1 } };
    owned_mesh plane = mesh_plane(2, 1);
    canvas c = canvas_new(960, 490, 2);
    char text[40];

    state.model = shade_mat4_rotation(shade_radians(90), shade_v3(1, 0, 0));    /* upright */
    state.projection = shade_mat4_ortho(-1.06f, 1.06f, -1.06f, 1.06f, 1, 10);
    state.view = shade_mat4_translation(shade_v3(0, 0, -5));
    state.lighting.ambient = shade_v3(0.08f, 0.09f, 0.12f);
    canvas_dark(&c.target);
    for (int i = 0; i < 10; i++) {
        int x = 192 * (i % 5), y = 245 * (i / 5);
        float e = i < 5 ? exponent[i] : 0, beta = degrees[i < 5 ? 4 : i - 5];
        shade_target panel = canvas_panel(&c, x + 2, y, 188, 188);
        shade_light lamp = shade_spot_light(shade_v3(0, 0, 2), shade_v3(0, 0, -1),
                                            shade_radians(beta), e, shade_v3(1, 0.95f, 0.85f));
        state.lighting.lights = &lamp;
        shade_draw_mesh(&panel, &plane.view, &state, NULL);
        sprintf(text, i < 5 ? "e = %d" : "β = %d°", (int)(i < 5 ? e : beta));
        label_center(&c, x + 96, y + 212, 20, grey, text);
    }
    sprintf(text, "(L·S)^e where L·S ≥ cos %g°", (double)degrees[4]);
    label_center(&c, 480, 238, 20, grey, text);
    label_center(&c, 480, 483, 20, grey, "1 where L·S ≥ cos β");
    mesh_free(&plane);
    return canvas_save(&c, argc, argv, "spots.ppm");
}
