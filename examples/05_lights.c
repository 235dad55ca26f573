/* 05_lights.c - one scene under six lamps.  Above: from infinity, from a point, in a cone.  Below:
   a low lamp on the left whose light does not weaken, weakens as 1/r, and as 1/r^2.

   cc -O2 -I. examples/05_lights.c -lm -o lights && ./lights        writes lights.ppm */
#define SHADE_IMPLEMENTATION
#include "shade.h"
#include "shapes.h"
#include "label.h"

int main(int argc, char **argv)
{
    static const char *const name[6] = { "directional", "point", "spot",
                                         "fall-off 1", "fall-off 1/r", "fall-off 1/r^2" };
    const shade_vec3 white = { 1, 0.95f, 0.85f };
    shade_material paint[4] = { 0 };
    shade_light lamp[6];
    shade_draw_state state = { 0 };
    owned_mesh shape[4];
    shade_mat4 at[4];
    canvas c = canvas_new(960, 540, 2);

    shape[0] = mesh_plane(3.2f, 1), shape[1] = mesh_sphere(64, 32), shape[2] = mesh_cube();
    shape[3] = shape_teapot(10);
    at[0] = shape_at(0, 0, 0, 1, 0), at[1] = shape_at(-2, 0.8f, 0.8f, 0.8f, 0);
    at[2] = shape_at(2, 0.7f, 0.2f, 0.7f, 0.6f), at[3] = shape_at(0, 0, 0, 0.5f, -0.5f);
    for (int i = 0; i < 4; i++) {
        static const shade_vec3 albedo[4] = {
            { 0.45f, 0.43f, 0.40f }, { 0.55f, 0.07f, 0.05f },
            { 0.08f, 0.22f, 0.5f }, { 0.5f, 0.42f, 0.3f }
        };
        paint[i].ambient = paint[i].diffuse = albedo[i];
        paint[i].specular = i ? shade_v3(0.4f, 0.4f, 0.4f) : shade_v3(0, 0, 0);
        paint[i].shininess = 48;
    }
    lamp[0] = shade_directional_light(shade_v3(0.6f, -1, -0.5f), white);
    lamp[1] = shade_point_light(shade_v3(-0.3f, 2.2f, 1.6f), white);
    lamp[2] = shade_spot_light(shade_v3(-1.5f, 5, 3.5f), shade_v3(1.5f, -4.6f, -3.3f), 0.34f, 12,
                               shade_scale(white, 1.6f));
    for (int i = 3; i < 6; i++) lamp[i] = shade_point_light(shade_v3(-3.4f, 1.2f, 1.5f), white);
    lamp[3].constant = 1, lamp[4].linear = 1, lamp[5].quadratic = 1;
    for (int i = 4; i < 6; i++)    /* as bright as the first at 1.7 from the lamp */
        lamp[i].diffuse = lamp[i].specular = shade_scale(white, i == 4 ? 1.7f : 1.7f * 1.7f);

    state.view = shade_mat4_look_at(shade_v3(0, 6, 10), shade_v3(0, -0.15f, 0.3f),
                                    shade_v3(0, 1, 0));
    state.projection = shade_mat4_perspective(0.62f, 320 / 270.0f, 1, 30);
    state.lighting.light_count = 1, state.lighting.ambient = shade_v3(0.02f, 0.023f, 0.03f);
    for (int i = 0; i < 6; i++) {
        shade_target panel = canvas_panel(&c, 320 * (i % 3), 270 * (i / 3), 320, 270);
        canvas_gradient(&panel, shade_v3(0.035f, 0.04f, 0.05f), shade_v3(0.01f, 0.011f, 0.014f));
        state.lighting.lights = &lamp[i];
        for (int k = 0; k < 4; k++) {
            state.model = at[k], state.material = &paint[k];
            shade_draw_mesh(&panel, &shape[k].view, &state, NULL);
        }
        label_center(&c, 320 * (i % 3) + 160, 270 * (i / 3) + 260, 22, shade_v3(0.8f, 0.8f, 0.8f), name[i]);
    }
    for (int k = 0; k < 4; k++) mesh_free(&shape[k]);
    return canvas_save(&c, argc, argv, "lights.ppm");
}
