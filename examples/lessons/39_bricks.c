/* 39_bricks.c - a flat floor, lit by the fragment shader of a draw state.  Left: with a map for
   k_d.  Right: with two more maps, a normal map, which bends N in the frame of T, B and N, and a
   mask of one byte a texel for k_s (rows.specular), which keeps highlights on the bricks.
   Try lamps at y = 4: only grazing light shows relief.

   cc -O2 -I. examples/lessons/39_bricks.c -lm -o bricks && ./bricks        writes bricks.ppm */
#define SHADE_IMPLEMENTATION
#include "shade.h"
#include "../shared/paint.h"
#include "../shared/label.h"

enum { COLOR, RELIEF, GLOSS, MAPS };
enum { SIZE = 1024, SAMPLES = 3 };    /* texels along an edge of a map, samples of a pixel */
typedef struct scene { shade_texture map[MAPS], level[MAPS][15]; shade_lighting lighting; } scene;
static const shade_material brick = { .diffuse = { 1, 1, 1 }, .ambient = { 1, 1, 1 },
                                      .specular = { 0.5f, 0.5f, 0.5f }, .shininess = 50 };

static void bricks(const void *uniforms, const shade_fragments *SHADE_RESTRICT in,
                   shade_colors *SHADE_RESTRICT out)
{
    const scene *s = (const scene *)uniforms;
    float texel[MAPS][4][SHADE_LANES];
    const shade_rows rows = { .position = in->varying[0], .normal = texel[RELIEF][0],
                              .albedo = texel[COLOR][0], .specular = texel[GLOSS][0] };
    for (int k = 0; k < MAPS; k++)
        shade_sample_lanes(&s->map[k], in->varying[9], in->varying[10], in->lod, texel[k][0]);
    SHADE_EACH_LANE(i) {    /* T comes as the vertex colour; v goes down, so B = T x N */
        shade_vec3 N = lane(in->varying[3], i);
        shade_vec3 T = lane(in->varying[6], i);
        shade_vec3 n = shade_scale(N, 2 * texel[RELIEF][2][i] - 1);
        int right = in->x[i] > 480 * SAMPLES;
        n = shade_madd(n, 2 * texel[RELIEF][0][i] - 1, T);
        n = shade_madd(n, 2 * texel[RELIEF][1][i] - 1, shade_cross(T, N));
        texel[RELIEF][0][i] = right ? n.x : N.x;
        texel[RELIEF][1][i] = right ? n.y : N.y;
        texel[RELIEF][2][i] = right ? n.z : N.z;
        for (int k = 0; k < 3; k++) texel[GLOSS][k][i] = right ? texel[GLOSS][3][i] : 0.4f;
    }
    shade_lit_lanes(&s->lighting, &brick, in->eye, &rows, out->color[0]);
}

int main(int argc, char **argv)
{
    static float color[SIZE * SIZE][4], smaller[MAPS][2 * SIZE * SIZE];
    static uint8_t relief[SIZE * SIZE][4], gloss[SIZE * SIZE];
    const shade_format format[MAPS] = { SHADE_FORMAT_RGBA32F, SHADE_FORMAT_RGBA8, SHADE_FORMAT_A8 };
    const void *const texels[MAPS] = { color, relief, gloss };
    const shade_vec3 grey = { 0.7f, 0.7f, 0.7f }, warm = { 2.3f, 1.85f, 1.3f };
    const shade_vec3 moon = { 0.12f, 0.18f, 0.30f };
    shade_light lamps[3] = { shade_point_light(shade_v3(-1.25f, 0.42f, 0.5f), warm),
                             shade_point_light(shade_v3(1.25f, 0.42f, 0.5f), warm),
                             shade_directional_light(shade_v3(1, -0.5f, 0.6f), moon) };
    owned_mesh plane = mesh_plane(8, 24);
    canvas c = canvas_new(960, 584, SAMPLES);
    shade_target picture = canvas_panel(&c, 0, 0, 960, 540);
    scene s = { .lighting = { lamps, 3, .ambient = { 0.02f, 0.025f, 0.04f } } };
    shade_draw_state state = { .fragment = bricks, .uniforms = &s, .diffuse_map = &s.map[COLOR] };

    paint_bricks(color, SIZE);
    paint_relief(relief, color, SIZE, 10);
    paint_mask(gloss, color, SIZE);
    for (int k = 0; k < MAPS; k++) {
        s.map[k] = (shade_texture){ texels[k], SIZE, SIZE, .format = format[k],
                                    .filter = SHADE_FILTER_TRILINEAR };
        shade_build_mipmaps(&s.map[k], s.level[k], smaller[k], sizeof smaller[k]);
    }
    lamps[0].linear = lamps[1].linear = 0.95f;
    for (int i = 0; i < 2 * plane.view.vertex_count; i++) plane.texcoords[i] *= 8;
    plane.view.colors = plane.colors = mesh_tangents(&plane);
    state.view = shade_mat4_look_at(shade_v3(0, 1.5f, 4.2f), shade_v3(0, 0, 0.8f),
                                    shade_v3(0, 1, 0));
    state.projection = shade_mat4_perspective(0.56f, 960 / 540.0f, 0.1f, 30);
    canvas_dark(&c.target);
    shade_draw_mesh(&picture, &plane.view, &state, NULL);
    label_center(&c, 240, 570, 22, grey, "k_d from a map");
    label_center(&c, 720, 570, 22, grey, "N and k_s from maps as well");
    mesh_free(&plane);
    return canvas_save(&c, argc, argv, "bricks.ppm");
}
