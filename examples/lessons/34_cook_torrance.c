/* 34_cook_torrance.c - gold as paint and as metal.  Left: the preset, by Blinn-Phong.  Right: Cook
   and Torrance's model (ACM Transactions on Graphics 1 (1982), 7-24), by a fragment shader:
       I = SUM of I_s (N.L) D F G / (4 (N.L) (N.V)),   D = e^-((tan a / m)^2) / (pi m^2 cos^4 a),
       G = min(1, 2 (N.H) (N.V) / (V.H), 2 (N.H) (N.L) / (V.H)),   cos a = N.H
   They divide by pi.  F = F_0 + (1 - F_0) (1 - V.H)^5 is C. Schlick's Fresnel term (Computer
   Graphics Forum 13 (1994), 233-246).  With n = 2/m^2 - 4 both lobes bend alike at their peak (UW).
   Try F_0 = { 0.04f, 0.04f, 0.04f }: varnish, whose curve rises from .04 to 1.

   cc -O2 -I. examples/lessons/34_cook_torrance.c -lm -o cook_torrance && ./cook_torrance */
#define SHADE_IMPLEMENTATION
#include "shade.h"
#include "../shared/shapes.h"
#include "../shared/label.h"

static const shade_vec3 F_0 = { 1, 0.766f, 0.336f }, eye = { 0, 4, 11 };    /* gold, linear */
static const float m = 0.28f;
typedef struct scene { mesh_scene place; shade_light lamp[4]; } scene;
static shade_vec3 F(float VH) { return shade_lerp(F_0, shade_v3(1, 1, 1), shade_power(1 - VH, 5)); }

static void metal(const void *uniforms, const shade_fragments *SHADE_RESTRICT in,
                  shade_colors *SHADE_RESTRICT out)
{
    const scene *s = (const scene *)uniforms;
    const float (*v)[SHADE_LANES] = in->varying;
    float l[3][SHADE_LANES], amount[SHADE_LANES];
    for (int j = 0; j < 4; j++) {
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
            G = NL > 0 ? 0.7f * amount[i] * D * (G < 1 ? G : 1) / (4 * NV) : 0;
            shade_vec3 I = shade_madd(shade_scale(F_0, 0.005f), G, F(VH));    /* in grey light */
            lane_put(out->color[0], i, shade_add(lane(out->color[0], i), I));
        }
    }
}

int main(int argc, char **argv)
{
    const shade_vec3 grey = { 0.7f, 0.7f, 0.7f }, white = { 1, 1, 1 };
    const shade_vec3 from[4] = { { 1, -.6f, -1 }, { -1, -.6f, -1 }, { 1, -.6f, 1.3f },
                                 { -1, -.6f, 1.3f } };    /* both sides, before and behind */
    const shade_vec3 axis[4] = { { 1, 0, 0 }, { 0, 1, 0 }, { 0, 0, 1 }, { 0, 0, 0 } };
    shade_material paint = shade_linear_material(shade_preset_material(SHADE_PRESET_GOLD));
    owned_mesh pot = shape_teapot(16);
    scene s = { .place = { .mesh = &pot, .model = shade_mat4_identity() } };
    shade_pipeline pipeline = { mesh_vertex, metal, &s, .varyings = 8 };
    shade_draw_state state = { .material = &paint, .lighting = { s.lamp, 4, .ambient = white } };
    canvas c = canvas_new(960, 490, 2);
    paint.shininess = 2 / (m * m) - 4;
    shade_target panel = canvas_panel(&c, 0, 0, 480, 340);
    for (int j = 0; j < 4; j++) s.lamp[j] = shade_directional_light(from[j], grey);
    state.view = shade_mat4_look_at(eye, shade_v3(0.2f, 1.2f, 0), shade_v3(0, 1, 0));
    state.projection = shade_mat4_perspective(0.46f, 480 / 340.0f, 1, 20);
    s.place.clip_from_world = shade_mat4_mul(state.projection, state.view);
    canvas_dark(&c.target);
    shade_draw_mesh(&panel, &pot.view, &state, NULL);
    panel = canvas_panel(&c, 480, 0, 480, 340);
    mesh_draw(&panel, &pipeline, &pot);
    for (int i = 0; i < 4 * 840; i++) {    /* three curves, and the axis */
        const shade_vec3 f = F(mesh_turn((float)(i / 4) / 3360).x), k = axis[i % 4];
        panel = canvas_panel(&c, 60 + i / 4, 455 - (int)(75 * shade_dot(f, k)), 1, 3 - i % 4 / 3);
        shade_clear(&panel, shade_v4(.1f + .7f * k.x, .1f + .7f * k.y, .1f + .7f * k.z, 1), 1);
    }
    for (int i = 0; i < 2; i++) canvas_zoom(&c, 480 * i + 118, 80, 30, 18, 480 * i + 12, 10, 4);
    label_center(&c, 240, 352, 22, grey, "Blinn-Phong, preset gold; rim × 4");
    label_center(&c, 720, 352, 22, grey, "Cook-Torrance, D F G / (4 (N·L) (N·V)); rim × 4");
    label_center(&c, 480, 482, 19, grey, "F of gold, angle between V and H from 0° to 90°");
    label_draw(&c, 36, 387, 19, grey, "1");
    label_draw(&c, 36, 461, 19, grey, "0");
    mesh_free(&pot);
    return canvas_save(&c, argc, argv, "cook_torrance.ppm");
}
