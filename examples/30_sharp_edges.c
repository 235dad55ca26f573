/* 30_sharp_edges.c - one mesh, three sets of normals: a block whose corners are rounded by four
   facets each (Berkeley).  Left: face normals, which show the facets.  Middle: at each vertex the
   mean of all faces around it; rims look soft, flat sides bent.  Right: the mean of only those
   faces that meet at less than 45 degrees: corners are round, rims are hard edges, and a vertex of
   the rim has two normals.  Below: the greatest angle to the normals of the true, round block.
   Try 0.94f, the cosine of 20 degrees, on the right: facets, which meet at 22.5, become hard edges.

   cc -O2 -I. examples/30_sharp_edges.c -lm -o sharp_edges && ./sharp_edges */
#define SHADE_IMPLEMENTATION
#include "shade.h"
#include "shared/mesh.h"
#include "shared/label.h"

enum { FACETS = 4, RING = 4 * (FACETS + 1), HEIGHT = 1 };

/* A square with round corners, radius .5, at y = 1 and y = -1, its sides and its two lids */
static owned_mesh block(void)
{
    owned_mesh m = mesh_new(2 * RING + 2, 12 * RING);
    uint32_t *out = m.indices, top = 2 * RING, below = 2 * RING + 1;
    for (uint32_t i = 0; i < RING; i++) {
        uint32_t a = i, b = (i + 1) % RING, c = a + RING, d = b + RING;
        uint32_t triangles[12] = { a, c, d, a, d, b, top, a, b, below, d, c };
        float quarter = (float)(i / (FACETS + 1)), part = (float)(i % (FACETS + 1)) / FACETS;
        shade_vec2 t = mesh_turn((quarter + part) / 4), corner = mesh_turn((quarter + 0.5f) / 4);
        float x = 0.5f * t.x + 0.707107f * corner.x, z = -0.5f * t.y - 0.707107f * corner.y;
        mesh_put(&m, (int)a, shade_v3(x, 1, z), shade_v3(0, 0, 0), 0, 0);
        mesh_put(&m, (int)c, shade_v3(x, -1, z), shade_v3(0, 0, 0), 0, 0);
        for (int k = 0; k < 12; k++) *out++ = triangles[k];
    }
    mesh_put(&m, (int)top, shade_v3(0, 1, 0), shade_v3(0, 0, 0), 0, 0);
    mesh_put(&m, (int)below, shade_v3(0, -1, 0), shade_v3(0, 0, 0), 0, 0);
    return m;
}

int main(int argc, char **argv)
{
    static const char *const name[3] = { "normals of faces", "mean of all faces",
                                         "mean below 45°" };
    static const char *const off[3] = { "at most 11° off", "at most 48° off", "at most 6° off" };
    static const float cos_crease[3] = { 0.9999f, -1, 0.7071f };
    shade_material glaze = { { 0, 0, 0 }, { 0.5f, 0.3f, 0.05f }, { 0.5f, 0.3f, 0.05f },
                             { 0.4f, 0.4f, 0.4f }, 20 };
    shade_light lamp = shade_directional_light(shade_v3(-0.45f, -0.45f, -1), shade_v3(1, 1, 1));
    shade_draw_state state = { .material = &glaze };
    owned_mesh m = block(), corners = mesh_new(m.view.index_count, 3);
    size_t bytes = shade_mesh_corner_normals_bytes(&m.view);
    void *scratch = example_memory(bytes, 1);
    canvas c = canvas_new(960, 380, 3);

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
        label_caption(&c, 320 * i + 160, 340, shade_v3(0.7f, 0.7f, 0.7f), name[i], off[i]);
    }
    free(scratch);
    mesh_free(&m);
    mesh_free(&corners);
    return canvas_save(&c, argc, argv, "sharp_edges.ppm");
}
