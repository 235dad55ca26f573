/* 30_sharp_edges.c - one mesh, three sets of normals: a block with upright edges rounded by four
   facets each (Shirley, Berkeley).  Left: each face has its own normal, and facets show.  Middle:
   each vertex has the mean of all faces around it; rims look soft, flat sides bent.  Right: the
   mean of those faces alone that meet at less than 45 degrees, by shade_mesh_corner_normals: the
   edges are round, the rims hard, because a vertex of the rim has two normals, that of the lid
   and that of the side.  Below: the greatest angle between a normal and that of the true, round
   block.
   Try 20 degrees on the right: facets, which meet at 22.5, become hard edges.

   cc -O2 -I. examples/lessons/30_sharp_edges.c -lm -o sharp_edges && ./sharp_edges */
#define SHADE_IMPLEMENTATION
#include "shade.h"
#include "../shared/shapes.h"
#include "../shared/label.h"
#include <math.h>

/* A vertex for each corner of each triangle, so that each can have a normal of its own */
static owned_mesh split(const owned_mesh *m)
{
    owned_mesh corners = mesh_new(m->view.index_count, 0);
    for (int i = 0; i < m->view.index_count; i++)
        memcpy(corners.positions + 3 * i, m->positions + 3 * m->indices[i], 3 * sizeof(float));
    corners.view.indices = NULL;
    corners.view.index_count = 0;
    return corners;
}

/* The normal of the true block at corner i.  Its triangles come in fours: two of a side, whose
   vertices have the true normal, one of the upper lid, one of the lower. */
static shade_vec3 true_normal(const owned_mesh *block, int i)
{
    const float *n = block->normals + 3 * block->indices[i];
    if (i / 3 % 4 == 2) return shade_v3(0, 1, 0);
    if (i / 3 % 4 == 3) return shade_v3(0, -1, 0);
    return shade_v3(n[0], n[1], n[2]);
}

int main(int argc, char **argv)
{
    static const char *const name[3] = { "normals of faces", "mean of all faces",
                                         "mean below 45°" };
    static const float degrees[3] = { 1, 180, 45 };    /* more is a hard edge */
    const shade_vec3 gold = { 0.5f, 0.3f, 0.05f }, gleam = { 0.4f, 0.4f, 0.4f };
    const shade_material glaze = { { 0, 0, 0 }, gold, gold, gleam, 20 };
    const shade_light lamp = shade_directional_light(shade_v3(-0.45f, -0.45f, -1),
                                                     shade_v3(1, 1, 1));
    shade_draw_state state = { .material = &glaze,
                               .lighting = { &lamp, 1, .ambient = { 0.2f, 0.2f, 0.22f } } };
    owned_mesh block = shape_block(4), corners = split(&block);
    shade_vec3 *normals = (shade_vec3 *)corners.normals;
    size_t bytes = shade_mesh_corner_normals_bytes(&block.view);
    void *scratch = example_memory(bytes, 1);
    canvas c = canvas_new(960, 380, 3);
    char text[60];

    state.view = shade_mat4_look_at(shade_v3(3, 2.7f, 4.7f), shade_v3(0, -0.1f, 0),
                                    shade_v3(0, 1, 0));
    state.projection = shade_mat4_perspective(0.58f, 320 / 330.0f, 2, 12);
    canvas_dark(&c.target);
    for (int i = 0; i < 3; i++) {
        shade_target panel = canvas_panel(&c, 320 * i, 0, 320, 330);
        shade_vec2 turn = mesh_turn(degrees[i] / 360);    /* its cosine is turn.x */
        float least = 1;
        shade_mesh_corner_normals(&block.view, turn.x, normals, scratch, bytes);
        shade_draw_mesh(&panel, &corners.view, &state, NULL);
        for (int k = 0; k < block.view.index_count; k++)
            least = fminf(least, shade_dot(normals[k], true_normal(&block, k)));
        sprintf(text, "normals at most %.1f° off", acos((double)least) * 57.29578);
        label_caption(&c, 320 * i + 160, 340, shade_v3(0.7f, 0.7f, 0.7f), name[i], text);
    }
    free(scratch);
    mesh_free(&block);
    mesh_free(&corners);
    return canvas_save(&c, argc, argv, "sharp_edges.ppm");
}
