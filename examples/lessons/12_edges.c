/* 12_edges.c - drawings by edges (Shirley).  Left: every edge of the meshes.  Middle: a depth-only
   draw hides the edges behind faces.  Right: what an illustrator draws.  Silhouettes lie between a
   face seen from the front and one seen from behind, creases where faces meet at a sharp angle,
   boundaries where an edge has only one face.
   Try crease = 0.99f: handle and spout are drawn full of facets.

   cc -O2 -I. examples/lessons/12_edges.c -lm -o edges && ./edges        writes edges.ppm */
#define SHADE_IMPLEMENTATION
#include "shade.h"
#include "../shared/shapes.h"
#include "../shared/edges.h"
#include "../shared/label.h"

int main(int argc, char **argv)
{
    static const char *const name[3] = { "all edges", "hidden ones removed", "the drawing" };
    static const char *const kind[3] = { "silhouette: (e·n_0) (e·n_1) ≤ 0",
                                         "crease: n_0·n_1 ≤ %g", "boundary: one face" };
    static const int at[3][2] = { { 650, 32 }, { 646, 304 }, { 780, 332 } };    /* pixels */
    static const float crease = 0.5f;
    static const shade_vec4 ink[EDGE_KINDS] = {
        { 0.01f, 0.01f, 0.02f, 1 }, { 0.01f, 0.10f, 0.6f, 1 }, { 0.7f, 0.03f, 0.01f, 1 },
        { 0.1f, 0.12f, 0.16f, 1 }
    };
    static const shade_vec2 tube[2] = { { 1, 2 }, { 1, 0 } };
    const shade_vec3 eye = { 2.5f, 7, 12 }, black = { 0.02f, 0.02f, 0.03f };
    owned_mesh part[2] = { mesh_new(9000, 32000), mesh_new(100, 300) };    /* pot; box and tube */
    shade_draw_state state = { 0 };
    shade_line_state pen = { .cap = SHADE_CAP_SQUARE };
    edge_lines lines[2];
    canvas c = canvas_new(960, 388, 3);

    for (int i = 0; i < 2; i++) part[i].view.vertex_count = part[i].view.index_count = 0;
    edges_add(&part[0], shape_teapot(8), shape_at(-0.3f, 0, -0.6f, 1, -0.35f));
    edges_add(&part[1], mesh_cube(), shape_at(-1.6f, 0.65f, 2.6f, 0.65f, 0.9f));
    edges_add(&part[1], shape_turned(tube, 2, 16), shape_at(1.5f, 0, 3, 0.7f, 0));
    for (int i = 0; i < 2; i++) lines[i] = edges_sort(&part[i], eye, crease);
    lines[0].count[EDGE_BOUNDARY] = 0;    /* rims below the lid, within the pot */
    state.view = shade_mat4_look_at(eye, shade_v3(0.08f, 0.85f, 0.8f), shade_v3(0, 1, 0));
    state.projection = shade_mat4_perspective(0.5f, 320 / 300.0f, 5, 25);
    canvas_gradient(&c.target, shade_v3(0.92f, 0.90f, 0.84f), shade_v3(0.80f, 0.76f, 0.68f));
    for (int i = 0; i < 3; i++) {
        shade_target panel = canvas_panel(&c, 320 * i, 30, 320, 300), fill = panel;
        fill.color = NULL;
        for (int j = 0; i > 0 && j < 2; j++) shade_draw_mesh(&fill, &part[j].view, &state, NULL);
        pen.clip_from_points = shade_mat4_mul(state.projection, state.view);
        pen.raster.depth_test = SHADE_COMPARE_LESS_EQUAL;
        pen.raster.depth_bias = i > 0 ? -0.002f : 0;
        for (int k = 0; k < (i < 2 ? EDGE_KINDS : EDGE_OTHER); k++) {
            pen.color = ink[i < 2 ? EDGE_OTHER : k];
            pen.width = i < 2 ? 2 : 9;
            for (int j = 0; j < 2; j++)
                shade_draw_lines(&panel, lines[j].points[k], lines[j].count[k], &pen, NULL);
        }
        label_center(&c, 320 * i + 160, 374, 26, black, name[i]);
        label_print(&c, at[i][0], at[i][1], 21, shade_v3(ink[i].x, ink[i].y, ink[i].z), kind[i],
                    (double)crease);
    }
    for (int i = 0; i < 2; i++) {
        edges_free(&lines[i]);
        mesh_free(&part[i]);
    }
    return canvas_save(&c, argc, argv, "edges.ppm");
}
