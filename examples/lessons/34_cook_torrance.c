/* 34_cook_torrance.c - gold by two models (UW).  Right: Cook and Torrance's (ACM Transactions on
   Graphics 1 (1982), 7-24), by a fragment shader:
       I = SUM of I_s (N.L) D F G / (4 (N.L) (N.V)),   D = e^-((tan a / m)^2) / (pi m^2 cos^4 a),
       G = min(1, 2 (N.H) (N.V) / (V.H), 2 (N.H) (N.L) / (V.H)),   cos a = N.H
   and F = F_0 + (1 - F_0) (1 - V.H)^5 by C. Schlick (Computer Graphics Forum 13 (1994), 233-246).
   Left: Blinn-Phong, n = 2/m^2 - 4 and k_s = F_0 / (4 pi m^2), the same where N = L = V.  It stays
   gold; theirs whitens where light grazes.  Try F_0 = { .04f, .04f, .04f }: varnish, F from .04 on.

   cc -O2 -I. examples/lessons/34_cook_torrance.c -lm -o cook_torrance && ./cook_torrance */
#define SHADE_IMPLEMENTATION
#include "shade.h"
#include "../shared/shapes.h"
#include "../shared/label.h"

static const shade_vec3 F_0 = { 1, .766f, .336f }, eye = { 0, 4, 11 };
static const shade_vec3 white = { 1, 1, 1 }, dim = { .3f, .3f, .3f };
static const float m = 0.28f;
typedef struct scene { mesh_scene place; shade_light lamp[5]; } scene;
static shade_vec3 F(float VH) { return shade_lerp(F_0, white, shade_power(1 - VH, 5)); }

static void metal(const void *uniforms, const shade_fragments *SHADE_RESTRICT in,
                  shade_colors *SHADE_RESTRICT out)
{
    const scene *s = (const scene *)uniforms;
    const float (*v)[SHADE_LANES] = in->varying;
    float l[3][SHADE_LANES], amount[SHADE_LANES];
    for (int j = 0; j < 5; j++) {
        shade_light_at_lanes(&s->lamp[j], v[0], l[0], amount);
        SHADE_EACH_LANE(i) {
            shade_vec3 N = shade_normalize(lane(v[3], i));
            shade_vec3 V = shade_normalize(shade_sub(eye, lane(v[0], i)));
            shade_vec3 L = lane(l[0], i), H = shade_halfway(L, V);
            float NL = shade_lambert(N, L), NV = shade_lambert(N, V) + 1e-4f;
            float NH = shade_lambert(N, H) + 1e-4f, VH = shade_lambert(V, H) + 1e-4f;
            float cos2 = NH * NH, t = (1 / cos2 - 1) / (m * m);
            float D = shade_power(0.36787944f, t) / (3.1415927f * m * m * cos2 * cos2);
            float G = 2 * NH * (NV < NL ? NV : NL) / VH;
            G = NL > 0 ? s->lamp[j].diffuse.x * D * (G < 1 ? G : 1) / (4 * NV) : 0;
            lane_put(out->color[0], i, shade_madd(lane(out->color[0], i), G, F(VH)));
        }
    }
}

int main(int argc, char **argv)
{
    const shade_material gold = { .specular = shade_scale(F_0, 1 / (4 * 3.1415927f * m * m)),
                                  .shininess = 2 / (m * m) - 4 };
    owned_mesh pot = shape_teapot(32);
    scene s = { .place = { .mesh = &pot, .model = shade_mat4_identity() } };
    shade_pipeline pipeline = { mesh_vertex, metal, &s, .varyings = 8 };
    shade_draw_state state = { .material = &gold, .lighting = { s.lamp, .light_count = 5 } };
    canvas c = canvas_new(960, 540, 3);
    for (int j = 0; j < 5; j++)    /* two before, three weaker ones behind */
        s.lamp[j] = j < 2 ? shade_directional_light(shade_v3(j ? 1 : -1, -.6f, -1), white)
                          : shade_directional_light(shade_v3((float)(j - 3), -.35f, 1), dim);
    state.view = shade_mat4_look_at(eye, shade_v3(0.2f, 1.35f, 0), shade_v3(0, 1, 0));
    state.projection = shade_mat4_perspective(0.42f, 480 / 310.0f, 1, 20);
    s.place.clip_from_world = shade_mat4_mul(state.projection, state.view);
    canvas_dark(&c.target);
    for (int i = 0; i < 2; i++) {
        shade_target panel = canvas_panel(&c, 480 * i, 0, 480, 310);
        if (i) mesh_draw(&panel, &pipeline, &pot);
        else shade_draw_mesh(&panel, &pot.view, &state, NULL);
    }
    const shade_target plot = canvas_inset(&c, 70, 386, 820, 110);
    for (int x = 0; x < plot.width; x++) {
        const shade_vec3 f = F(mesh_turn(0.25f * (float)x / (float)plot.width).x);
        const float high = (float)(plot.height - 8);
        canvas_fill(&plot, x, (int)(high * (1 - f.x)), 1, 8, shade_v3(.8f, .1f, .1f));
        canvas_fill(&plot, x, (int)(high * (1 - f.y)), 1, 8, shade_v3(.1f, .8f, .1f));
        canvas_fill(&plot, x, (int)(high * (1 - f.z)), 1, 8, shade_v3(.1f, .1f, .8f));
    }
    label_caption(&c, 240, 335, white, "Blinn-Phong", "k_s (N·H)^n");
    label_caption(&c, 720, 335, white, "Cook-Torrance", "D F G / (4 (N·L) (N·V))");
    label_center(&c, 480, 526, 22, white, "F of gold, 0 to 1; angle of V and H: 0° to 90°");
    mesh_free(&pot);
    return canvas_save(&c, argc, argv, "cook_torrance.ppm");
}
