/* 36_tone_mapping.c - light has no upper limit, a picture holds 0 to 1.  A lamp beside a pot, drawn
   once in floats and developed three times: exposed for the dark and cut at 1, exposed for the pool
   of light and cut at 1, and by a curve that bends luminance below 1,
       L_d = L (1 + L / L_w^2) / (1 + L),   L_w: the least luminance shown as white
   (E. Reinhard, M. Stark, P. Shirley, J. Ferwerda, "Photographic Tone Reproduction for Digital
   Images", SIGGRAPH 2002, equation 4).  Below: how many pixels are cut.  The curve cuts only pixels
   whose red is above their luminance.  Massey: light can be arbitrarily large.  Shirley: keep
   c_a + c_l <= 1, or clamp.
   Try L_w = 1: the curve is L, the first picture again.

   cc -O2 -I. examples/lessons/36_tone_mapping.c -lm -o tone_mapping && ./tone_mapping */
#define SHADE_IMPLEMENTATION
#include "shade.h"
#include "../shared/shapes.h"
#include "../shared/label.h"

/* Of linear light in the primaries of sRGB */
static float luminance(shade_vec3 c) { return 0.2126f * c.x + 0.7152f * c.y + 0.0722f * c.z; }

int main(int argc, char **argv)
{
    static const float exposure[3] = { 8, 0.5f, 8 };
    static const char *const name[3] = { "8 L, cut at 1", "L / 2, cut at 1",
                                         "8 L (1 + 8 L/L_w^2) / (1 + 8 L)" };
    const shade_vec3 none = { 0, 0, 0 }, grey = { 0.5f, 0.5f, 0.5f }, blue = shade_rgb(0x3060A0);
    const shade_vec3 light = { 2, 1.4f, 0.7f }, at = { -1.9f, 1.1f, 2.3f };
    const float L_w = exposure[2] * 30 * luminance(light);    /* the bulb's */
    const shade_material paint[3] = { { none, grey, grey, none, 0 },
                                      { none, blue, blue, { 0.3f, 0.3f, 0.3f }, 60 },
                                      { shade_scale(light, 30), none, none, none, 0 } };
    shade_mat4 wall = shade_mat4_mul(shade_mat4_translation(shade_v3(0, 0, -4)),
                                     shade_mat4_rotation(1.5708f, shade_v3(1, 0, 0)));
    owned_mesh of[3] = { shape_join(mesh_plane(20, 1), shape_moved(mesh_plane(20, 1), wall)),
                         shape_teapot(16), mesh_sphere(64, 32) };
    shade_light lamp = shade_point_light(at, light);
    shade_draw_state state = { .lighting = { &lamp, 1, .ambient = { 0.004f, 0.006f, 0.01f } } };
    canvas c = canvas_new(960, 400, 3);
    shade_target panel = canvas_panel(&c, 0, 0, 320, 340);
    char text[60];

    lamp.quadratic = 1;    /* 1 / r^2, without bound */
    state.view = shade_mat4_look_at(shade_v3(1, 4, 10), shade_v3(0.1f, 1.2f, 0),
                                    shade_v3(0, 1, 0));
    state.projection = shade_mat4_perspective(0.74f, 320 / 340.0f, 1, 60);
    shade_clear(&c.target, shade_v4(0, 0, 0, 1), 1);
    for (int k = 0; k < 3; k++) {
        state.material = &paint[k];
        if (k == 2) state.model = shape_at(at.x, at.y, at.z, 0.2f, 0);
        shade_draw_mesh(&panel, &of[k].view, &state, NULL);
        mesh_free(&of[k]);
    }
    for (int k = 2; k >= 0; k--) {    /* the first in its own place, last */
        int cut = 0, count = panel.width * panel.height;
        for (int i = 0; i < count; i++) {
            int x = i % panel.width, y = i / panel.width;
            shade_vec4 *p = (shade_vec4 *)panel.color + y * panel.stride + x;
            shade_vec3 I = shade_scale(shade_v3(p->x, p->y, p->z), exposure[k]);
            float L = luminance(I);
            if (k == 2) I = shade_scale(I, (1 + L / (L_w * L_w)) / (1 + L));
            cut += I.x > 1 || I.y > 1 || I.z > 1;
            p[k * panel.width] = shade_v4(I.x, I.y, I.z, 1);
        }
        sprintf(text, k < 2 ? "%.1f %% of the pixels are cut" : "%.1f %% are cut, L_w = %.0f",
                100.0 * cut / count, (double)L_w);
        label_caption(&c, 160 + 320 * k, 365, grey, name[k], text);
    }
    return canvas_save(&c, argc, argv, "tone_mapping.ppm");
}
