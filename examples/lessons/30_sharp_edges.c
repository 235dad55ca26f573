/* 30_sharp_edges.c - one mesh, three sets of normals: a block whose corners are rounded by four
   facets each (Berkeley).  Left: face normals, which show the facets.  Middle: at each vertex the
   mean of all faces around it; rims look soft, flat sides bent.  Right: the mean of only those
   faces that meet at less than 45 degrees: corners are round, rims are hard edges, and a vertex of
   the rim has two normals.  Below: the greatest angle to the normals of the true, round block.
   Try 0.94f, the cosine of 20 degrees, on the right: facets, which meet at 22.5, become hard edges.

   cc -O2 -I. examples/lessons/30_sharp_edges.c -lm -o sharp_edges && ./sharp_edges */
#define SHADE_IMPLEMENTATION
#include "shade.h"
#include "../shared/shapes.h"
#include "../shared/label.h"
#include <math.h>

/* The greatest angle, in degrees, between the normals of corners and those of the round block */
static double most_off(const owned_mesh *m, const shade_vec3 *N)
{
    float least = 1;
    for (int i = 0; i < m->view.index_count; i++) {
        const float *n = m->normals + 3 * m->indices[i];
        int part = i / 3 % 4;    /* of the four triangles around an edge: two sides, two lids */
        shade_vec3 lid = { 0, part == 2 ? 1 : -1, 0 }, side = { n[0], n[1], n[2] };
        least = fminf(least, shade_dot(N[i], part < 2 ? side : lid));
    }
    return acos((double)least) * 57.29578;
}

int main(int argc, char **argv)
{
    static const char *const name[3] = { "normals of faces", "mean of all faces",
                                         "mean below 45°" };
    static const float cos_crease[3] = { 0.9999f, -1, 0.7071f };
    shade_material glaze = { { 0, 0, 0 }, { 0.5f, 0.3f, 0.05f }, { 0.5f, 0.3f, 0.05f },
                             { 0.4f, 0.4f, 0.4f }, 20 };
    shade_light lamp = shade_directional_light(shade_v3(-0.45f, -0.45f, -1), shade_v3(1, 1, 1));
    shade_draw_state state = { .material = &glaze };
    owned_mesh m = shape_block(4), corners = mesh_new(m.view.index_count, 3);
    size_t bytes = shade_mesh_corner_normals_bytes(&m.view);
    void *scratch = example_memory(bytes, 1);
    canvas c = canvas_new(960, 380, 3);
    char text[60];

    state.view = shade_mat4_look_at(shade_v3(3, 2.7f, 4.7f), shade_v3(0, -0.1f, 0),
                                    shade_v3(0, 1, 0));
    state.projection = shade_mat4_perspective(0.56f, 320 / 330.0f, 2, 12);
    state.lighting.lights = &lamp;
    state.lighting.light_count = 1;
    state.lighting.ambient = shade_v3(0.2f, 0.2f, 0.22f);
    for (int i = 0; i < m.view.index_count; i++)
        for (int k = 0; k < 3; k++)
            corners.positions[3 * i + k] = m.positions[3 * m.indices[i] + (uint32_t)k];
    corners.view.indices = NULL;
    corners.view.index_count = 0;
    canvas_dark(&c.target);
    for (int i = 0; i < 3; i++) {
        shade_target panel = canvas_panel(&c, 320 * i, 0, 320, 330);
        shade_mesh_corner_normals(&m.view, cos_crease[i], (shade_vec3 *)(void *)corners.normals,
                                  scratch, bytes);
        shade_draw_mesh(&panel, &corners.view, &state, NULL);
        sprintf(text, "at most %.1f° off",
                most_off(&m, (const shade_vec3 *)(const void *)corners.normals));
        label_caption(&c, 320 * i + 160, 340, shade_v3(0.7f, 0.7f, 0.7f), name[i], text);
    }
    free(scratch);
    mesh_free(&m);
    mesh_free(&corners);
    return canvas_save(&c, argc, argv, "sharp_edges.ppm");
}
