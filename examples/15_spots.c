/* 15_spots.c - spotlights along a wall.  Above: cones of one width, whose light gathers more and
   more about the axis as the exponent grows.  Below: even light in cones of five widths.

   cc -O2 -I. examples/15_spots.c -lm -o spots && ./spots        writes spots.ppm */
#define SHADE_IMPLEMENTATION
#include "shade.h"
#include "mesh.h"
#include "label.h"

int main(int argc, char **argv)
{
    static const float exponent[5] = { 0, 20, 60, 180, 540 }, degrees[5] = { 4, 7, 10, 13, 16 };
    static const char *const name[2][5] = {
        { "e = 0", "e = 20", "e = 60", "e = 180", "e = 540" },
        { "4 deg", "7 deg", "10 deg", "13 deg", "16 deg" }
    };
    shade_material wall = { { 0, 0, 0 }, { 0.6f, 0.55f, 0.5f }, { 0.6f, 0.55f, 0.5f },
                            { 0.1f, 0.1f, 0.1f }, 20 };
    shade_material bulb = { .emission = { 3, 2.6f, 1.8f } };
    shade_light lamps[5];
    shade_draw_state state = { 0 };
    owned_mesh plane = mesh_plane(20, 1), ball = mesh_sphere(32, 16);
    canvas c = canvas_new(960, 520, 3);

    state.view = shade_mat4_look_at(shade_v3(0, 0, 36), shade_v3(0, 0, 0), shade_v3(0, 1, 0));
    state.projection = shade_mat4_perspective(0.0965f, 960 / 260.0f, 20, 50);
    state.lighting.lights = lamps, state.lighting.light_count = 5;
    state.lighting.ambient = shade_v3(0.012f, 0.014f, 0.02f);
    for (int row = 0; row < 2; row++) {
        shade_target panel = canvas_panel(&c, 0, 260 * row, 960, 260);
        shade_clear(&panel, shade_v4(0, 0, 0, 1), 1);
        for (int i = 0; i < 5; i++) {
            shade_vec3 at = shade_v3(2.4f * (float)(i - 2), 1.35f, 0.9f);
            lamps[i] = shade_spot_light(at, shade_v3(0, -1, -0.72f),
                                        (row ? degrees[i] : 16) * 0.017453293f,
                                        row ? 0 : exponent[i], shade_v3(2.6f, 2.2f, 1.7f));
            lamps[i].constant = 0.8f, lamps[i].quadratic = 0.35f;
        }
        state.model = shade_mat4_rotation(1.5707963f, shade_v3(1, 0, 0)), state.material = &wall;
        shade_draw_mesh(&panel, &plane.view, &state, NULL);
        state.material = &bulb;
        for (int i = 0; i < 5; i++) {
            shade_vec4 at = lamps[i].position;
            state.model = shade_mat4_mul(shade_mat4_translation(shade_v3(at.x, at.y, at.z)),
                                         shade_mat4_scaling(shade_v3(0.05f, 0.05f, 0.05f)));
            shade_draw_mesh(&panel, &ball.view, &state, NULL);
            label_center(&c, 480 + 184 * (i - 2), 260 * row + 250, 22, shade_v3(0.6f, 0.6f, 0.6f),
                         name[row][i]);
        }
    }
    mesh_free(&plane), mesh_free(&ball);
    return canvas_save(&c, argc, argv, "spots.ppm");
}
