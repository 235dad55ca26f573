/* 22_shadow.c - a shadow, which local light does not know (UW, Berkeley), in two draws.  The first,
   from the lamp, keeps depth alone: a map.  In the second a point farther from the lamp than
   the map says is in shadow; the share of 3 x 3 texels that let it pass is its visibility.  Shadow
   acne: beside the centre of a texel a slanted face is farther than the map says.  So points move
   along N, by the texels' reach times the sine of N to the lamp.  Try reach = facets = 0: stripes.

   cc -O2 -I. examples/lessons/22_shadow.c -lm -o shadow && ./shadow            writes shadow.ppm */
#define SHADE_IMPLEMENTATION
#include "shade.h"
#include "../shared/shapes.h"
#include "../shared/label.h"

enum { MAP = 1024, BALL = 2, POT = BALL + 2 * 96 * 47 };    /* the last two: first triangles */
static const shade_vec3 eye = { 4.1f, 7, 12.4f }, up = { 0, 1, 0 }, grey = { 0.6f, 0.6f, 0.6f };
static const shade_vec3 at = { -3, 10, 6.5f }, aim = { 3, -9.2f, -6.5f }, left = { -1, -1, 0 };
/* 3 x 3 centres lie within 2.12 texels, .019 wide at 20 from the lamp, and the mesh has facets */
static const float reach = 2.12f * 0.019f, facets = 0.008f;
typedef struct scene { mesh_scene place; shade_lighting lighting; shade_mat4 from_lamp; } scene;
static float map[MAP][MAP];
/* The share of light that passes at a point in the lamp's clip space; nearer texels weigh more. */
static float passes(shade_vec3 p)
{
    float x = (1 + p.x) * MAP / 2, y = (1 - p.y) * MAP / 2, sum = 0;
    if (!(x >= 1 && y >= 1 && x < MAP - 1 && y < MAP - 1)) return 0;    /* outside the cone */
    const float u = x - (float)(int)x, across[3] = { 1 - u, 1, u };
    const float v = y - (float)(int)y, down[3] = { 1 - v, 1, v };
    for (int k = 0; k < 9; k++)
        if ((1 + p.z) / 2 <= map[(int)y + k / 3 - 1][(int)x + k % 3 - 1])
            sum += across[k % 3] * down[k / 3] / 4;
    return sum;
}

static void light(const void *uniforms, const shade_fragments *SHADE_RESTRICT in,
                  shade_colors *SHADE_RESTRICT out)
{
    const shade_material glaze = { { 0 }, { 1, 1, 1 }, { 1, 1, 1 }, { 0.3f, 0.3f, 0.3f }, 60 };
    const shade_vec3 paint[3] = { shade_rgb(0xB0A898), shade_rgb(0x508058), shade_rgb(0xC06028) };
    const scene *s = (const scene *)uniforms;
    const shade_vec3 axis = shade_normalize(aim);
    float albedo[3][SHADE_LANES], visibility[2][SHADE_LANES];
    const shade_rows rows = { .position = in->varying[0], .normal = in->varying[3],
                              .albedo = albedo[0], .visibility = visibility[0] };
    SHADE_EACH_LANE(i) {
        shade_vec3 P = lane(in->varying[0], i), N = lane(in->varying[3], i);
        P = shade_madd(P, reach * shade_length(shade_cross(N, axis)) + facets, N);
        visibility[0][i] = passes(shade_mat4_transform_point(s->from_lamp, P));
        visibility[1][i] = 1;    /* the lamp at infinity casts no shadow */
        lane_put(albedo[0], i, paint[(in->primitive[i] >= BALL) + (in->primitive[i] >= POT)]);
    }
    shade_lit_lanes(&s->lighting, &glaze, eye, &rows, out->color[0]);
}

int main(int argc, char **argv)
{
    const shade_light lamps[2] = { shade_spot_light(at, aim, 0.42f, 12, shade_v3(2.2f, 2, 1.8f)),
                                   shade_directional_light(left, shade_rgb(0x506888)) };
    owned_mesh ball = shape_moved(mesh_sphere(96, 48), shape_at(4.1f, 1, 0.4f, 1, 0));
    owned_mesh m = shape_join(shape_join(mesh_plane(60, 1), ball), shape_teapot(16));
    scene s = { .place = { .mesh = &m, .model = shade_mat4_identity() },
                .lighting = { lamps, 2, .ambient = { 0.04f, 0.04f, 0.05f } } };
    shade_pipeline pipeline = { mesh_vertex, light, &s, .varyings = 8 };
    shade_target from_lamp = { .width = MAP, .height = MAP, .depth = map[0] };
    canvas c = canvas_new(960, 540, 2);
    s.from_lamp = shade_mat4_mul(shade_mat4_perspective(0.9f, 1, 4, 40),
                                 shade_mat4_look_at(at, shade_add(at, aim), up));
    s.place.clip_from_world = s.from_lamp;    /* a cone of .84 and some texels around */
    shade_clear(&from_lamp, shade_v4(0, 0, 0, 0), 1);
    mesh_draw(&from_lamp, &pipeline, &m);
    s.place.clip_from_world = shade_mat4_mul(shade_mat4_perspective(0.6f, 960 / 540.0f, 2, 80),
                                             shade_mat4_look_at(eye, shade_v3(0.9f, 0.9f, 0), up));
    shade_clear(&c.target, shade_v4(0, 0, 0, 1), 1);
    mesh_draw(&c.target, &pipeline, &m);
    label_draw(&c, 24, 40, 22, grey, "visibility: the share of 3 × 3 texels the lamp sees");
    shade_vec2 far = canvas_depth(canvas_panel(&c, 736, 24, 200, 200), map[0], MAP, 4, 40);
    label_print(&c, 24, 70, 18, grey, "right: the lamp's map, %.1f (white) to %.1f (black) away",
                (double)far.x, (double)far.y);
    mesh_free(&m);
    return canvas_save(&c, argc, argv, "shadow.ppm");
}
