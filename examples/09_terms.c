/* 09_terms.c - what each term of the lighting equation contributes.  Above: emission, ambient,
   diffuse and specular light, each alone.  Below: their sum, and three views by a fragment shader
   of one's own: normals (x, y, z as red, green, blue), depth (near is bright), triangles.

   cc -O2 -I. examples/09_terms.c -lm -o terms && ./terms        writes terms.ppm */
#define SHADE_IMPLEMENTATION
#include "shade.h"
#include "shapes.h"
#include "label.h"

typedef struct scene { mesh_scene place; shade_mat3 eye_from_world; int view; } scene;

static void look(const void *uniforms, const shade_fragments *SHADE_RESTRICT in,
                 shade_colors *SHADE_RESTRICT out)
{
    const scene *s = (const scene *)uniforms;
    SHADE_EACH_LANE(i) {
        shade_vec3 N = shade_v3(in->varying[3][i], in->varying[4][i], in->varying[5][i]);
        uint32_t h = (in->primitive[i] + 1) * 2654435761u;
        N = shade_normalize(shade_mat3_transform(s->eye_from_world, N));
        float x = s->view == 5 ? N.x : 3.1f - 4.4f * in->z[i];
        float y = s->view == 5 ? N.y : x, z = s->view == 5 ? N.z : x;
        h = (h ^ h >> 15) * 2246822519u;
        if (s->view == 7) x = (float)(h >> 24) / 160 - 1, y = (float)(h >> 16 & 255) / 160 - 1;
        if (s->view == 7) z = (float)(h >> 8 & 255) / 160 - 1;
        /* -1 .. 1 as a display's 0 .. 1, which the target encodes again */
        N = shade_linear_from_srgb(shade_v3((1 + x) / 2, (1 + y) / 2, (1 + z) / 2));
        out->color[0][i] = N.x, out->color[1][i] = N.y, out->color[2][i] = N.z;
    }
}

int main(int argc, char **argv)
{
    static const char *const name[8] = { "emission", "+ ambient", "+ diffuse", "+ specular",
                                         "= sum", "normals", "depth", "triangles" };
    shade_material glaze = { { 0.06f, 0.008f, 0.003f }, { 0.03f, 0.20f, 0.24f },
                             { 0.03f, 0.20f, 0.24f }, { 0.6f, 0.6f, 0.6f }, 50 };
    shade_light lamps[2];
    shade_draw_state state = { 0 };
    shade_pipeline pipeline = { .vertex = mesh_vertex, .fragment = look,
                                .varyings = 8 };
    owned_mesh pot = shape_teapot(10);
    scene s = { .place = { .mesh = &pot } };
    canvas c = canvas_new(960, 460, 4);

    lamps[0] = shade_directional_light(shade_v3(0.5f, -0.8f, -0.9f), shade_v3(1, 0.96f, 0.9f));
    lamps[1] = shade_directional_light(shade_v3(-1, -0.3f, 0.1f), shade_v3(0.25f, 0.3f, 0.45f));
    state.model = shade_mat4_mul(shade_mat4_rotation(-0.45f, shade_v3(0, 1, 0)),
                                 shade_mat4_translation(shade_v3(-0.45f, -1.5f, 0)));
    state.view = shade_mat4_look_at(shade_v3(0, 5, 13), shade_v3(0, -0.3f, 0), shade_v3(0, 1, 0));
    state.projection = shade_mat4_perspective(0.44f, 240 / 230.0f, 9, 19);
    state.material = &glaze;
    state.lighting.lights = lamps, state.lighting.light_count = 2;
    state.lighting.ambient = shade_v3(0.22f, 0.23f, 0.26f);
    s.place.model = state.model, s.eye_from_world = shade_mat3_from_mat4(state.view);
    s.place.clip_from_world = shade_mat4_mul(state.projection, state.view);
    pipeline.uniforms = &s;
    canvas_gradient(&c.target, shade_v3(0.045f, 0.05f, 0.06f), shade_v3(0.012f, 0.013f, 0.016f));
    for (int i = 0; i < 8; i++) {
        shade_target panel = canvas_panel(&c, 240 * (i % 4), 230 * (i / 4), 240, 230);
        state.lighting.terms = i < 4 ? 1u << i : 0;
        s.view = i;
        if (i <= 4) shade_draw_mesh(&panel, &pot.view, &state, NULL);
        else shade_draw(&panel, &pipeline, pot.indices, pot.view.index_count,
                        pot.view.vertex_count, NULL);
        label_center(&c, 240 * (i % 4) + 120, 230 * (i / 4) + 220, 22, shade_v3(0.7f, 0.7f, 0.7f), name[i]);
    }
    mesh_free(&pot);
    return canvas_save(&c, argc, argv, "terms.ppm");
}
