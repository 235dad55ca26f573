/* 29_grazing.c - where Phong and Blinn-Phong differ: a floor seen in the mirror direction of a far
   lamp, the white disk, theta = 20 and 80 degrees off the normal.  With 4 n for n Blinn's highlight
   is as high as Phong's and cos(theta) times as wide.  At 20 degrees that is hardly seen, at 80 it
   is drawn out like a lamp's reflection on water, while Phong's stays round.  Massey: 4 n looks
   alike unless viewed from a very steep angle.  The numbers: pixels brighter than one half.
   Try theta[1] = 60: half as wide as high.

   cc -O2 -I. examples/lessons/29_grazing.c -lm -o grazing && ./grazing        writes grazing.ppm */
#define SHADE_IMPLEMENTATION
#include "shade.h"
#include "../shared/mesh.h"
#include "../shared/paint.h"
#include "../shared/label.h"

enum { WIDTH = 472, HEIGHT = 300, TILES = 128 };
static const float theta[2] = { 20, 80 }, n = 100;

/* Pixels brighter than half on the way across (dx 1) or down (dy 1) through the panel's centre */
static int extent(const shade_target *t, int dx, int dy)
{
    const float *p = (const float *)t->color;
    int count = 0;
    for (int k = -t->height / 2; k < t->height / 2; k++) {
        int x = t->width / 2 + k * dx, y = t->height / 2 + k * dy;
        count += p[4 * (y * t->stride + x)] > 0.5f;
    }
    return count;
}

int main(int argc, char **argv)
{
    static const char *const name[2] = { "Phong, (R·V)^n, n = 100", "Blinn-Phong, (N·H)^{4n}" };
    const shade_vec3 origin = { 0, 0, 0 }, up = { 0, 1, 0 };
    static float texels[TILES * TILES][4], memory[TILES * TILES][4];
    shade_material water = { .ambient = { 0.15f, 0.15f, 0.15f }, .specular = { 1, 0.95f, 0.8f } };
    const shade_material sun = { .emission = { 1, 0.97f, 0.9f } };
    shade_texture levels[10], tiles = paint_texture(texels, TILES);
    shade_draw_state state = { .lighting = { .ambient = { 1, 1, 1 } } };
    owned_mesh floor = mesh_plane(40, 1), ball = mesh_sphere(48, 24);
    canvas c = canvas_new(960, 710, 2);
    char text[60];

    paint_tiles(texels, TILES);
    shade_build_mipmaps(&tiles, levels, memory, sizeof memory);
    tiles.filter = SHADE_FILTER_TRILINEAR;
    for (int i = 0; i < 8; i++) floor.texcoords[i] *= 160;

    state.projection = shade_mat4_perspective(0.85f, (float)WIDTH / HEIGHT, 0.1f, 1000);
    canvas_dark(&c.target);
    for (int i = 0; i < 4; i++) {
        int x = i % 2 * (960 - WIDTH), y = i / 2 * 355;
        shade_target panel = canvas_panel(&c, x, y, WIDTH, HEIGHT);
        shade_vec2 t = mesh_turn(theta[i / 2] / 360);
        shade_light lamp = shade_directional_light(shade_v3(0, -t.x, t.y), shade_v3(1, 1, 1));
        state.lighting.lights = &lamp;
        state.lighting.light_count = 1;
        state.lighting.model = i % 2 ? SHADE_MODEL_BLINN_PHONG : SHADE_MODEL_PHONG;
        water.shininess = i % 2 ? shade_blinn_exponent(n) : n;
        /* in the middle of the panel V = R */
        state.view = shade_mat4_look_at(shade_v3(0, t.x, t.y), origin, up);
        canvas_gradient(&panel, shade_v3(0.02f, 0.03f, 0.06f), shade_v3(0.2f, 0.25f, 0.3f));
        state.material = &water;
        state.diffuse_map = &tiles;
        state.model = shade_mat4_identity();
        shade_draw_mesh(&panel, &floor.view, &state, NULL);
        state.material = &sun;
        state.diffuse_map = NULL;
        state.model = shade_mat4_translation(shade_v3(0, 30 * t.x, -30 * t.y));
        if (i > 1) shade_draw_mesh(&panel, &ball.view, &state, NULL); /* above, it is out of view */
        sprintf(text, "θ = %.0f°: highlight of %d × %d pixels", (double)theta[i / 2],
                extent(&panel, 1, 0) / 2, extent(&panel, 0, 1) / 2);
        label_caption(&c, x + WIDTH / 2, y + HEIGHT + 22, shade_v3(0.7f, 0.7f, 0.7f), name[i % 2],
                      text);
    }
    mesh_free(&floor);
    mesh_free(&ball);
    return canvas_save(&c, argc, argv, "grazing.ppm");
}
