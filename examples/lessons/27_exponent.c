/* 27_exponent.c - what n does, and what the other numbers do (UW, Shirley: a larger n, other
   parameters).  Above: n = 1, 4, 16, 64, 256, and the angle between N and H at which (N.H)^n
   has fallen to one half: four times n, half as wide.  For n = 1 the highlight is still bright
   where N.L = 0, and B cuts it off there, a hard rim.  Below: metal (k_d small, k_s large, both of
   its colour), plastic (k_s white) and a planet (k_d from a map, no k_s).
   Try n = 0 for the metal: (N.H)^0 = 1, so that k_s covers all that is lit, like paint.

   cc -O2 -I. examples/lessons/27_exponent.c -lm -o exponent && ./exponent    writes exponent.ppm */
#define SHADE_IMPLEMENTATION
#include "shade.h"
#include "../shared/mesh.h"
#include "../shared/paint.h"
#include "../shared/label.h"

/* The angle between N and H at which the highlight is half as bright, to a tenth of a degree */
static double half_angle(float n)
{
    const shade_vec3 H = { 0, 0, 1 };    /* of L = V = H */
    for (int tenths = 0;; tenths++) {
        shade_vec2 t = mesh_turn(((float)tenths + 0.5f) / 3600);
        if (shade_blinn_phong_specular(shade_v3(t.y, 0, t.x), H, H, n) < 0.5f) return tenths / 10.0;
    }
}

/* One ball with two lines of text below it */
static void ball(const canvas *c, const owned_mesh *mesh, const shade_draw_state *state,
                 int middle, int top, int size, const char *name, const char *formula)
{
    shade_target panel = canvas_panel(c, middle - size / 2, top, size, size);
    shade_draw_mesh(&panel, &mesh->view, state, NULL);
    label_caption(c, middle, top + size + 20, shade_v3(0.7f, 0.7f, 0.7f), name, formula);
}

int main(int argc, char **argv)
{
    static float map[256 * 512][4];
    const shade_vec3 white = { 1, 1, 1 }, half_white = { 0.45f, 0.45f, 0.45f }, none = { 0, 0, 0 };
    const shade_vec3 copper = { 0.95f, 0.45f, 0.22f }, blue = { 0.02f, 0.10f, 0.45f };
    const shade_vec3 teal = { 0.03f, 0.2f, 0.22f }, gloss = { 0.55f, 0.55f, 0.55f };
    const shade_material metal = { none, shade_scale(copper, 0.2f), shade_scale(copper, 0.1f),
                                   shade_scale(copper, 0.8f), 32 };
    const shade_material plastic = { none, shade_scale(blue, 0.1f), blue, half_white, 30 };
    const shade_material planet = { none, { .05f, .05f, .05f }, { .94f, .94f, .94f }, none, 0 };
    shade_material glossy = { none, teal, teal, gloss, 0 };
    const shade_light lamp[] = { shade_directional_light(shade_v3(0.5f, -0.6f, -1), white),
                                 shade_directional_light(shade_v3(-1, -0.2f, 0.4f), white),
                                 shade_directional_light(shade_v3(0.9f, 0.2f, 0.6f), white),
                                 shade_directional_light(shade_v3(0.1f, -1, 0.8f), white),
                                 shade_directional_light(shade_v3(-0.1f, 1, 1), half_white) };
    const shade_texture earth = { map, 512, 256, .format = SHADE_FORMAT_RGBA32F };
    shade_draw_state state = { .lighting = { lamp, 1, .ambient = { 0.15f, 0.15f, 0.17f } } };
    owned_mesh mesh = mesh_sphere(128, 64);
    canvas c = canvas_new(960, 580, 2);
    char name[40], text[60];
    state.view = shade_mat4_look_at(shade_v3(0, 0, 8), none, shade_v3(0, 1, 0));
    state.projection = shade_mat4_perspective(0.27f, 1, 1, 10);
    state.model = shade_mat4_rotation(3.6f, shade_v3(0, 1, 0));
    canvas_dark(&c.target);
    state.material = &glossy;
    for (int i = 0, n = 1; i < 5; i++, n *= 4) {
        glossy.shininess = (float)n;
        sprintf(name, "(N·H)^{%d}", n);
        sprintf(text, n > 1 ? "half at %.1f°" : "half at %.1f°, cut by B", half_angle((float)n));
        ball(&c, &mesh, &state, 96 + 192 * i, 8, 184, name, text);
    }
    state.material = &metal;
    state.lighting.light_count = 5;    /* metal shows what is around it */
    sprintf(text, "n = 32, k_s = %g k_d", (double)(metal.specular.x / metal.diffuse.x));
    ball(&c, &mesh, &state, 160, 256, 264, "metal", text);
    state.material = &plastic;
    state.lighting.light_count = 1;
    ball(&c, &mesh, &state, 480, 256, 264, "plastic", "n = 30, k_s white");
    noise_planet(map, 512, 256);
    state.material = &planet;
    state.diffuse_map = &earth;
    ball(&c, &mesh, &state, 800, 256, 264, "planet", "n = 0, k_d a map, k_s = 0");
    mesh_free(&mesh);
    return canvas_save(&c, argc, argv, "exponent.ppm");
}
