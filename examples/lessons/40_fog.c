/* 40_fog.c - fog in five lines: the fragment shader of a draw state lights firs and ground as the
   draw state would, then mixes in the light of the air before them.  One unit of air lets .96 of
   the light behind it through, so d units let .96^d through.
   Try shade_power(at.y < 2 ? 0.9f : 0.98f, ...): fog that lies in the hollows.

   cc -O2 -I. examples/lessons/40_fog.c -lm -o fog && ./fog        writes fog.ppm */
#define SHADE_IMPLEMENTATION
#include "shade.h"
#include "../shared/shapes.h"
#include "../shared/paint.h"
#include "../shared/label.h"

static const shade_vec3 air = { 0.60f, 0.62f, 0.64f };

static void fog(const void *uniforms, const shade_fragments *SHADE_RESTRICT in,
                shade_colors *SHADE_RESTRICT out)
{
    const shade_draw_state *s = (const shade_draw_state *)uniforms;
    const shade_rows rows = { .position = in->varying[SHADE_VARYING_POSITION],
                              .normal = in->varying[SHADE_VARYING_NORMAL] };
    shade_lit_lanes(&s->lighting, s->material, in->eye, &rows, out->color[0]);
    SHADE_EACH_LANE(i) {
        shade_vec3 at = lane(in->varying[SHADE_VARYING_POSITION], i);
        float through = shade_power(0.96f, shade_distance(at, in->eye));
        out->color[0][i] = air.x + through * (out->color[0][i] - air.x);
        out->color[1][i] = air.y + through * (out->color[1][i] - air.y);
        out->color[2][i] = air.z + through * (out->color[2][i] - air.z);
    }
}

/* Rolling ground, its height at x, z */
static float height(float x, float z)
{
    float hills = noise(shade_v3(0.13f * x, 0.13f * z, 0)), humps = noise(shade_v3(x, z, 3));
    return 2.5f * hills + 0.2f * humps - 0.04f * z;
}

int main(int argc, char **argv)
{
    static const shade_vec2 tree[10] = { { 0, 3.4f },      { 0.32f, 2.5f },  { 0.16f, 2.55f },
                                         { 0.5f, 1.8f },   { 0.28f, 1.87f }, { 0.68f, 1.1f },
                                         { 0.4f, 1.18f },  { 0.86f, 0.45f }, { 0.1f, 0.6f },
                                         { 0.1f, -0.5f } };
    const shade_light sun = shade_directional_light(shade_v3(1, -0.45f, 0.1f),
                                                    shade_v3(4.2f, 3.1f, 1.9f));
    const shade_material needles = { .ambient = { 0.03f, 0.07f, 0.03f },
                                     .diffuse = { 0.03f, 0.07f, 0.03f } };
    const shade_material grass = { .ambient = { 0.08f, 0.08f, 0.03f },
                                   .diffuse = { 0.08f, 0.08f, 0.03f } };
    shade_draw_state state = { .material = &grass, .fragment = fog };
    owned_mesh fir = shape_turned(tree, 10, 24), ground = mesh_plane(40, 300);
    canvas c = canvas_new(960, 540, 3);
    const shade_target sky = canvas_panel(&c, 0, 0, 960, 215);

    for (int i = 0; i < ground.view.vertex_count; i++)
        ground.positions[3 * i + 1] = height(ground.positions[3 * i], ground.positions[3 * i + 2]);
    shade_mesh_normals(&ground.view, (shade_vec3 *)ground.normals);
    state.uniforms = &state;
    state.lighting.lights = &sun;
    state.lighting.light_count = 1;
    state.lighting.ambient = shade_v3(0.35f, 0.45f, 0.60f);
    state.view = shade_mat4_look_at(shade_v3(0, 3.6f, 14), shade_v3(0, 2.9f, 0),
                                    shade_v3(0, 1, 0));
    state.projection = shade_mat4_perspective(0.6f, 960 / 540.0f, 0.1f, 90);
    canvas_gradient(&c.target, air, air);
    canvas_gradient(&sky, shade_v3(0.24f, 0.38f, 0.60f), air);
    shade_draw_mesh(&c.target, &ground.view, &state, NULL);
    state.material = &needles;
    for (int i = 0; i < 700; i++) {
        float x = 60 * paint_chance(i, 1) - 30, z = 8 - 50 * paint_chance(i, 2);
        state.model = shape_at(x, height(x, z), z, 0.35f + 0.4f * paint_chance(i, 3), (float)i);
        if (x * x > 2 + 2 * paint_chance(i, 5)) shade_draw_mesh(&c.target, &fir.view, &state, NULL);
    }
    label_draw(&c, 24, 40, 22, shade_v3(0.02f, 0.03f, 0.05f),
               "I = T I_{lit} + (1 − T) I_{air},   T = 0.96^d through d units of air");
    mesh_free(&fir);
    mesh_free(&ground);
    return canvas_save(&c, argc, argv, "fog.ppm");
}
