/* 49_elsewhere.c - the same numbers in four programs (UW, Massey, Shirley: choosing parameters).
   k_d = .6 orange, k_s = .8, n = 30: R·V to a power in POV-Ray and VTK, N·H in X3D, and in
   three.js N·H times (n + 2)/8 and Fresnel's F; POV-Ray and three.js encode bytes as sRGB, the
   others store light as it is.  Above as each program draws its numbers, below what one gets by
   copying them into iteration four: the same ball four times.  Where three.js is given k_s = .8 it
   shows a mirror-like spot, so here it has .2.
   Try another program of examples/elsewhere/words.h: "tachyon(...)", "raster3d(...)", "p5(...)".

   cc -O2 -I. examples/lessons/49_elsewhere.c -lm -o elsewhere && ./elsewhere
   writes elsewhere.ppm */
#define SHADE_IMPLEMENTATION
#include "shade.h"
#include "../elsewhere/words.h"
#include "../shared/mesh.h"
#include "../shared/label.h"

static const struct { const char *name, *law, *look, *lamp; } program[4] = {
    { "POV-Ray", "k_s (R·V)^n, sRGB", "povray(color=1,.5,.2 ambient=0 phong=.8 phong_size=30)",
      "povray_lamp(at=1,1,1,0)" },
    { "VTK", "k_s (R·V)^n", "vtk(color=1,.5,.2 diffuse=.6 specular=.8 power=30)",
      "vtk_lamp(at=1,1,1,0)" },
    { "X3D (X-ITE)", "k_s (N·H)^{128 s}",
      "x_ite(diffuseColor=.6,.3,.12 specularColor=.8 shininess=.234375)", "x3d_lamp(at=1,1,1,0)" },
    { "three.js", "F (n+2)/8 (N·H)^n N·L, sRGB",
      "three_phong(color=.6,.3,.12 specular=.2 shininess=30)",
      "three_lamp(at=1,1,1,0 intensity=3.14159265)" }
};

/* Fills look and lamp from the words of one program. */
static void read_words(int i, elsewhere_look *look, elsewhere_lamp *lamp)
{
    const char *text[2] = { program[i].look, program[i].lamp };
    char said[200];
    if (elsewhere_read(&text[0], look, NULL, said, sizeof said) ||
        elsewhere_read(&text[1], NULL, lamp, said, sizeof said))
        puts(said);
}

int main(int argc, char **argv)
{
    const shade_vec3 ink = { 0.75f, 0.75f, 0.75f };
    const shade_light sun = shade_directional_light(shade_v3(-1, -1, -1), shade_v3(1, 1, 1));
    const shade_material copied = { .diffuse = { 0.6f, 0.3f, 0.12f },
                                    .specular = { 0.8f, 0.8f, 0.8f }, .shininess = 30 };
    shade_draw_state state = { .material = &copied, .lighting = { .lights = &sun,
                               .light_count = 1, .flags = SHADE_FLAG_INFINITE_VIEWER } };
    canvas c = canvas_new(960, 600, 2);
    owned_mesh ball = mesh_sphere(128, 64);
    elsewhere_look look;
    elsewhere_lamp lamp;
    elsewhere_scene scene = { &look, &lamp, 1, .parallel = 1, .linear = 1 };
    state.view = scene.view = shade_mat4_translation(shade_v3(0, 0, -5));
    state.projection = shade_mat4_ortho(-1.1f, 1.1f, -1.1f, 1.1f, 1, 10);
    state.uniforms = &scene;
    canvas_dark(&c.target);
    for (int i = 0; i < 4; i++) {
        const int x = 20 + 235 * i;
        shade_target above = canvas_panel(&c, x, 10, 215, 215);
        shade_target below = canvas_panel(&c, x, 320, 215, 215);
        read_words(i, &look, &lamp);
        state.fragment = elsewhere_fragment;
        shade_draw_mesh(&above, &ball.view, &state, NULL);
        state.fragment = NULL;
        shade_draw_mesh(&below, &ball.view, &state, NULL);
        label_center(&c, x + 107, 252, 22, ink, program[i].name);
        label_center(&c, x + 107, 278, 17, ink, program[i].law);
    }
    label_center(&c, 480, 570, 22, ink, "the numbers copied: k_d .6, k_s .8, n 30");
    mesh_free(&ball);
    return canvas_save(&c, argc, argv, "elsewhere.ppm");
}
