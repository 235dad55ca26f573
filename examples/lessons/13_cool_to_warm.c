/* 13_cool_to_warm.c - a teapot in Phong's light, by tone alone, and with outlines: the technical
   illustration of Shirley's notes, Gooch's in UW's.  The tone goes from cool to warm with the
   angle to the light and is never dark, so that the form can be read everywhere and black lines
   stand out.  The two colours are those of the notes and, as there, are stored without sRGB.
   Try (0.8f, 0.7f, 0.7f) for both colours: the lines alone show the form.

   cc -O2 -I. examples/lessons/13_cool_to_warm.c -lm -o cool_to_warm && ./cool_to_warm */
#define SHADE_IMPLEMENTATION
#include "shade.h"
#include "../shared/shapes.h"
#include "../shared/edges.h"
#include "../shared/label.h"

int main(int argc, char **argv)
{
    static const char *const name[3] = { "Phong", "tone alone", "tone with outlines" };
    static const char *const formula[3] = { "k_a I_a + k_d (N·L) + k_s (R·V)^n",
                                            "k_w = (1 + N·L) / 2",
                                            "k_w c_w + (1 − k_w) c_c" };
    const shade_vec3 eye = { -1.5f, 5.5f, 14 }, ink = { 0.02f, 0.02f, 0.03f };
    const shade_material clay = { { 0, 0, 0 }, { 0.6f, 0.55f, 0.5f }, { 0.6f, 0.55f, 0.5f },
                                  { 0.3f, 0.3f, 0.3f }, 20 };
    const shade_light lamp = shade_directional_light(shade_v3(-1, -0.8f, -0.3f), shade_v3(1, 1, 1));
    shade_draw_state state = { .material = &clay };
    shade_line_state pen = { .width = 9, .cap = SHADE_CAP_SQUARE,
                             .color = { 0.02f, 0.02f, 0.03f, 1 } };
    owned_mesh pot = shape_teapot(40);
    owned_mesh joined = mesh_new(pot.view.vertex_count, pot.view.index_count);
    edge_lines lines;
    canvas c = canvas_new(960, 296, 4);

    c.target.srgb = 0;
    state.lighting.lights = &lamp;
    state.lighting.light_count = 1;
    state.lighting.ambient = shade_v3(0.2f, 0.2f, 0.2f);
    state.lighting.cool = shade_v3(0.4f, 0.4f, 0.7f);
    state.lighting.warm = shade_v3(0.8f, 0.6f, 0.6f);
    state.view = shade_mat4_look_at(eye, shade_v3(0.16f, 1.5f, 0), shade_v3(0, 1, 0));
    state.projection = shade_mat4_perspective(0.36f, 320 / 230.0f, 8, 22);
    pen.clip_from_points = shade_mat4_mul(state.projection, state.view);
    pen.raster.depth_test = SHADE_COMPARE_LESS_EQUAL;
    pen.raster.depth_bias = -0.002f;
    joined.view.vertex_count = joined.view.index_count = 0;
    canvas_gradient(&c.target, shade_v3(0.93f, 0.93f, 0.94f), shade_v3(0.85f, 0.85f, 0.87f));
    for (int i = 0; i < 3; i++) {
        shade_target panel = canvas_panel(&c, 320 * i, 0, 320, 230);
        state.lighting.model = i ? SHADE_MODEL_COOL_TO_WARM : SHADE_MODEL_PHONG;
        shade_draw_mesh(&panel, &pot.view, &state, NULL);
        label_caption(&c, 320 * i + 160, 254, ink, name[i], formula[i]);
    }
    edges_add(&joined, pot, shade_mat4_identity());
    lines = edges_sort(&joined, eye, 0.3f);
    shade_target right = canvas_panel(&c, 640, 0, 320, 230);
    for (int k = EDGE_SILHOUETTE; k <= EDGE_BOUNDARY; k++)
        shade_draw_lines(&right, lines.points[k], lines.count[k], &pen, NULL);
    edges_free(&lines);
    mesh_free(&joined);
    return canvas_save(&c, argc, argv, "cool_to_warm.ppm");
}
