/* 21_transparency.c - leaves, glass and a flame.  A leaf is a square with a picture, whose pixels
   are discarded where their alpha is below alpha_cutoff: leaves need no sorting.  Then transparent
   things are drawn from back to front, without writing depth: the far half of the glass (OVER), the
   flame, which only adds light (ADD), the near half of the glass.
   Try alpha_cutoff 0: each leaf shows the square that it is.

   cc -O2 -I. examples/lessons/21_transparency.c -lm -o transparency && ./transparency */
#define SHADE_IMPLEMENTATION
#include "shade.h"
#include "../shared/shapes.h"
#include "../shared/label.h"
#include "../shared/paint.h"

enum { SIZE = 256, LEAVES = 260 };

int main(int argc, char **argv)
{
    static const uint32_t hue[4] = { 0xC03818, 0xD08028, 0x907020, 0x708030 };
    static float leaf[SIZE * SIZE][4], light[SIZE * SIZE][4];
    const shade_vec3 soil = shade_rgb(0x706050), tallow = shade_rgb(0xE8D8B8);
    const shade_material wax = { { 0.35f, 0.16f, 0.05f }, tallow, tallow, { 0, 0, 0 }, 0 };
    const shade_material pane = { { 0, 0, 0 }, { 0, 0, 0 }, { .05f, .1f, .1f }, { 8, 8, 8 }, 150 };
    const shade_texture leaf_map = paint_texture(leaf, SIZE), fire = paint_texture(light, SIZE);
    shade_material matte = { .ambient = soil, .diffuse = soil };
    shade_light lamps[3] = {
        shade_point_light(shade_v3(0, 1.2f, 0), shade_v3(2.8f, 1.5f, 0.6f)),
        shade_directional_light(shade_v3(0.8f, -0.9f, -0.9f), shade_rgb(0x7080A0)),
        shade_directional_light(shade_v3(-1, -0.25f, 0.8f), shade_rgb(0x6070A0))
    };
    shade_draw_state solid = { .lighting = { lamps, 3, .ambient = { 0.03f, 0.035f, 0.05f } } };
    shade_draw_state flame = { .diffuse_map = &fire, .lighting.ambient = { 1, 1, 1 },
                               .raster = { .blend = SHADE_BLEND_ADD, .depth_read_only = 1 } };
    owned_mesh plane = mesh_plane(1, 1), candle = shape_candle(), jar = shape_jar();
    canvas c = canvas_new(960, 600, 3);

    paint_leaf(leaf, SIZE);
    paint_flame(light, SIZE);
    lamps[0].constant = 0.3f;
    lamps[0].quadratic = 0.35f;
    lamps[0].specular = shade_scale(lamps[0].diffuse, 0.1f);
    solid.view = shade_mat4_look_at(shade_v3(0, 2.6f, 8), shade_v3(0, 1.1f, 0), shade_v3(0, 1, 0));
    solid.projection = shade_mat4_perspective(0.5f, 960 / 600.0f, 1, 60);
    flame.view = solid.view;
    flame.projection = solid.projection;
    flame.model = shade_mat4_mul(shape_at(0, 1.25f, 0, 1.2f, 0),
                                 shade_mat4_rotation(1.5708f, shade_v3(1, 0, 0)));
    shade_draw_state glass = solid;
    canvas_gradient(&c.target, shade_rgb(0x101828), shade_rgb(0x506080));

    solid.material = &wax;
    shade_draw_mesh(&c.target, &candle.view, &solid, NULL);
    solid.material = &matte;
    solid.model = shape_at(0, 0, 0, 30, 0);
    shade_draw_mesh(&c.target, &plane.view, &solid, NULL);
    solid.diffuse_map = &leaf_map;
    solid.alpha_cutoff = 0.5f;
    solid.lighting.flags = SHADE_FLAG_TWO_SIDED_ABS;    /* light shines through them a little */
    for (int i = 0; i < LEAVES; i++) {
        matte.diffuse = matte.ambient = shade_rgb(hue[(i + i / 8) % 4]);
        solid.model = shape_fallen(i);
        shade_draw_mesh(&c.target, &plane.view, &solid, NULL);
    }

    glass.material = &pane;
    glass.transparency = 0.88f;
    glass.lighting.flags = SHADE_FLAG_TWO_SIDED;
    glass.raster = (shade_raster){ .cull = SHADE_CULL_FRONT, .blend = SHADE_BLEND_OVER,
                                   .depth_read_only = 1 };
    shade_draw_mesh(&c.target, &jar.view, &glass, NULL);
    shade_draw_mesh(&c.target, &plane.view, &flame, NULL);
    glass.raster.cull = SHADE_CULL_BACK;
    shade_draw_mesh(&c.target, &jar.view, &glass, NULL);
    label_draw(&c, 24, 36, 20, tallow, "s over d:     leaves: s where α ≥ 1/2, else d     "
               "glass: α s + (1 − α) d     flame: α s + d");
    mesh_free(&plane);
    mesh_free(&candle);
    mesh_free(&jar);
    return canvas_save(&c, argc, argv, "transparency.ppm");
}
