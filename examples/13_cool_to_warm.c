/* 13_cool_to_warm.c - a teapot as the eye sees it and as a technical illustration.  Cool-to-warm
   shading blends two tones by the angle to the light and never gets dark: the form can be read
   everywhere, and black outlines stand out.

   cc -O2 -I. examples/13_cool_to_warm.c -lm -o cool_to_warm && ./cool_to_warm */
#define SHADE_IMPLEMENTATION
#include "shade.h"
#include "shapes.h"
#include "edges.h"
#include "label.h"

int main(int argc, char **argv)
{
    static const char *const name[2] = { "blinn-phong", "cool to warm" };
    const shade_vec3 eye = { -1.5f, 5.5f, 14 };
    shade_material clay = { { 0, 0, 0 }, { 0.45f, 0.42f, 0.38f }, { 0.45f, 0.42f, 0.38f },
                            { 0.3f, 0.3f, 0.3f }, 40 };
    shade_light lamp = shade_directional_light(shade_v3(-1, -0.8f, -0.3f), shade_v3(1, 1, 1));
    shade_draw_state state = { 0 };
    shade_line_state pen = { 0 };
    owned_mesh pot = shape_teapot(40);
    owned_mesh joined = mesh_new(pot.view.vertex_count, pot.view.index_count);
    edge_lines lines;
    canvas c = canvas_new(960, 400, 4);

    state.view = shade_mat4_look_at(eye, shade_v3(0.2f, 1.2f, 0), shade_v3(0, 1, 0));
    state.projection = shade_mat4_perspective(0.40f, 480 / 400.0f, 8, 22);
    state.material = &clay;
    state.lighting.lights = &lamp, state.lighting.light_count = 1;
    state.lighting.ambient = shade_v3(0.02f, 0.022f, 0.026f);
    state.lighting.cool = shade_v3(0.06f, 0.10f, 0.45f);
    state.lighting.warm = shade_v3(0.85f, 0.58f, 0.25f);
    canvas_gradient(&c.target, shade_v3(0.86f, 0.87f, 0.88f), shade_v3(0.66f, 0.67f, 0.70f));
    for (int i = 0; i < 2; i++) {
        shade_target panel = canvas_panel(&c, 480 * i, 0, 480, 400);
        state.lighting.model = i ? SHADE_MODEL_COOL_TO_WARM : SHADE_MODEL_BLINN_PHONG;
        shade_draw_mesh(&panel, &pot.view, &state, NULL);
        label_center(&c, 480 * i + 240, 388, 22, shade_v3(0.08f, 0.08f, 0.1f), name[i]);
        if (!i) continue;
        joined.view.vertex_count = joined.view.index_count = 0;
        edges_add(&joined, pot, shade_mat4_identity());
        lines = edges_sort(&joined, eye, 0.3f);
        pen.clip_from_points = shade_mat4_mul(state.projection, state.view);
        pen.width = 10, pen.cap = SHADE_CAP_SQUARE, pen.color = shade_v4(0.01f, 0.01f, 0.015f, 1);
        pen.raster.depth_test = SHADE_COMPARE_LESS_EQUAL, pen.raster.depth_bias = -0.002f;
        for (int k = EDGE_SILHOUETTE; k <= EDGE_BOUNDARY; k++)
            shade_draw_lines(&panel, lines.points[k], lines.count[k], &pen, NULL);
        edges_free(&lines);
    }
    mesh_free(&joined);
    return canvas_save(&c, argc, argv, "cool_to_warm.ppm");
}
