/* 12_edges.c - drawings by edges.  Left: every edge of the meshes.  Middle: a fill that writes
   depth alone hides those behind.  Right: what an illustrator draws: silhouettes (black, between a
   face seen from the front and one seen from behind), creases (blue, where faces meet at a sharp
   angle) and boundaries (red, edges of one face alone).

   cc -O2 -I. examples/12_edges.c -lm -o edges && ./edges        writes edges.ppm */
#define SHADE_IMPLEMENTATION
#include "shade.h"
#include "shapes.h"
#include "edges.h"
#include "label.h"

static owned_mesh tube(int columns)
{
    owned_mesh m = mesh_plane(1, columns);
    for (int i = 0; i < m.view.vertex_count; i++) {
        shade_vec2 around = mesh_turn((float)(i % (columns + 1) % columns) / (float)columns);
        m.positions[3 * i] = around.x, m.positions[3 * i + 2] = -around.y;
        m.positions[3 * i + 1] = 2 - 2 * m.texcoords[2 * i + 1];
    }
    return m;
}

int main(int argc, char **argv)
{
    static const char *const name[3] = { "all edges", "hidden ones removed", "the drawing" };
    static const shade_vec4 ink[EDGE_KINDS] = {
        { 0.01f, 0.01f, 0.02f, 1 }, { 0.01f, 0.08f, 0.5f, 1 }, { 0.7f, 0.03f, 0.01f, 1 },
        { 0.1f, 0.12f, 0.16f, 1 }
    };
    const shade_vec3 eye = { 2.5f, 7, 12 };
    owned_mesh scene = mesh_new(4000, 16000);
    shade_draw_state state = { 0 };
    shade_line_state pen = { 0 };
    edge_lines lines;
    canvas c = canvas_new(960, 340, 4);

    scene.view.vertex_count = scene.view.index_count = 0;
    edges_add(&scene, shape_teapot(6), shape_at(0, 0, -0.5f, 1, -0.35f));
    edges_add(&scene, mesh_cube(), shape_at(-1.5f, 0.65f, 2.9f, 0.65f, 0.5f));
    edges_add(&scene, tube(12), shape_at(1.3f, 0, 3, 0.7f, 0));
    lines = edges_sort(&scene, eye, 0.5f);
    state.view = shade_mat4_look_at(eye, shade_v3(0.15f, 0.6f, 0.8f), shade_v3(0, 1, 0));
    state.projection = shade_mat4_perspective(0.56f, 320 / 340.0f, 5, 25);
    pen.clip_from_points = shade_mat4_mul(state.projection, state.view);
    pen.cap = SHADE_CAP_SQUARE, pen.raster.depth_test = SHADE_COMPARE_LESS_EQUAL;
    canvas_gradient(&c.target, shade_v3(0.92f, 0.90f, 0.84f), shade_v3(0.80f, 0.76f, 0.68f));
    for (int i = 0; i < 3; i++) {
        shade_target panel = canvas_panel(&c, 320 * i, 0, 320, 340), fill = panel;
        fill.color = NULL;
        if (i > 0) shade_draw_mesh(&fill, &scene.view, &state, NULL);
        pen.raster.depth_bias = i > 0 ? -0.0015f : 0;
        for (int k = i < 2 ? EDGE_OTHER : EDGE_BOUNDARY; k >= 0; k--) {
            pen.color = ink[i < 2 ? EDGE_OTHER : k], pen.width = i < 2 ? 2.5f : 6;
            shade_draw_lines(&panel, lines.points[k], lines.count[k], &pen, NULL);
        }
        label_center(&c, 320 * i + 160, 326, 22, shade_v3(0.1f, 0.1f, 0.12f), name[i]);
    }
    edges_free(&lines), mesh_free(&scene);
    return canvas_save(&c, argc, argv, "edges.ppm");
}
