/* 35_brushed_metal.c - metal brushed in one direction shines in streaks across it (UW: anisotropic
   models).  Left: equally rough in all directions.  Middle: brushed round, as on a lathe: a bow tie
   on the lid, a streak down the side.  Right: brushed outward from the axis: the bow tie turns by
   90 degrees.  The fragment shader computes G. Ward's model ("Measuring and Modeling Anisotropic
   Reflection", SIGGRAPH 1992, 265-272), with k = .5:
       I = I_s (N.L) k / (4 pi a_x a_y sqrt((N.L) (N.V))) e^-(((H.X/a_x)^2 + (H.Y/a_y)^2) / (N.H)^2)
   X runs round the axis, Y outward.  a is small along the grooves and large across them, and
   a_x a_y = .04 in all three.
   Try 0.9f for 0.45f of the lamp: H is N all over the lids, which blaze, and the ties are gone.

   cc -O2 -I. examples/lessons/35_brushed_metal.c -lm -o brushed_metal && ./brushed_metal */
#define SHADE_IMPLEMENTATION
#include "shade.h"
#include "../shared/shapes.h"
#include "../shared/label.h"
#include <math.h>

static const shade_vec3 eye = { 0, 12, 14 };
typedef struct scene { mesh_scene place; shade_light lamp[2]; float a_x, a_y; } scene;

static void brushed(const void *uniforms, const shade_fragments *SHADE_RESTRICT in,
                    shade_colors *SHADE_RESTRICT out)
{
    const scene *s = (const scene *)uniforms;
    const float (*v)[SHADE_LANES] = in->varying;
    float l[3][SHADE_LANES], amount[SHADE_LANES];
    for (int j = 0; j < 2; j++) {
        shade_light_at_lanes(&s->lamp[j], v[0], l[0], amount);
        SHADE_EACH_LANE(i) {
            shade_vec3 P = lane(v[0], i), V = shade_sub(eye, P);
            shade_vec3 L = lane(l[0], i);
            shade_vec3 N = shade_normalize(lane(v[3], i)), H, X;
            V = shade_normalize(V);
            H = shade_halfway(L, V);
            X = shade_normalize(shade_cross(shade_v3(0, 1, 0), P));
            float NL = shade_lambert(N, L), NV = shade_lambert(N, V) + 1e-4f;
            float NH = shade_lambert(N, H) + 1e-4f, x = shade_dot(H, X) / s->a_x;
            float y = shade_dot(H, shade_cross(N, X)) / s->a_y;
            float lobe = shade_power(0.36787944f, (x * x + y * y) / (NH * NH));
            float I = 0.5f * amount[i] * sqrtf(NL / NV) * lobe / (12.566371f * s->a_x * s->a_y);
            out->color[0][i] += 0.95f * I + 0.01f;
            out->color[1][i] += 0.97f * I + 0.01f;
            out->color[2][i] += I + 0.012f;
        }
    }
}

int main(int argc, char **argv)
{
    static const char *const name[3] = { "equally rough", "brushed round", "brushed outward" };
    static const char *const formula[3] = { "α_x = α_y = 0.2", "α_x = 0.08, α_y = 0.5",
                                            "α_x = 0.5, α_y = 0.08" };
    static const float a_x[3] = { 0.2f, 0.08f, 0.5f };
    static const shade_vec2 profile[] = {
        { 0, 0.35f }, { 0.25f, 0.33f }, { 0.3f, 0.25f }, { 0.15f, 0.12f }, { 0.15f, 0 },
        { 0.15f, 0 }, { 1.8f, 0 }, { 1.8f, 0 }, { 1.8f, -1.1f }
    };
    owned_mesh lid = shape_turned(profile, 9, 128);
    scene s = { .place = { .mesh = &lid, .model = shade_mat4_identity() } };
    shade_pipeline pipeline = { mesh_vertex, brushed, &s, .varyings = 8 };
    canvas c = canvas_new(960, 375, 3);
    shade_mat4 view = shade_mat4_look_at(eye, shade_v3(0, -0.3f, 0), shade_v3(0, 1, 0));
    shade_mat4 lens = shade_mat4_perspective(0.2f, 320 / 290.0f, 1, 30);

    s.lamp[0] = shade_directional_light(shade_v3(0, -0.9f, 0.45f), shade_v3(1, 1, 1));
    s.lamp[1] = shade_directional_light(shade_v3(-0.4f, 0.3f, -1), shade_v3(1, 1, 1));
    s.place.clip_from_world = shade_mat4_mul(lens, view);
    canvas_dark(&c.target);
    for (int k = 0; k < 3; k++) {
        shade_target panel = canvas_panel(&c, 320 * k, 8, 320, 290);
        s.a_x = a_x[k];
        s.a_y = 0.04f / a_x[k];
        mesh_draw(&panel, &pipeline, &lid);
        label_caption(&c, 160 + 320 * k, 336, shade_v3(0.7f, 0.7f, 0.7f), name[k], formula[k]);
    }
    mesh_free(&lid);
    return canvas_save(&c, argc, argv, "brushed_metal.ppm");
}
