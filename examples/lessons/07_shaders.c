/* 07_shaders.c - a vertex and a fragment shader of your own, as UW and Massey write them in GLSL.
   The vertex shader moves points and tilts normals.  The fragment shader paints stripes, cuts light
   into steps and darkens rims.
   Try it without the line that tilts N: the outline keeps its ripples, the light ignores them.

   cc -O2 -I. examples/lessons/07_shaders.c -lm -o shaders && ./shaders        writes shaders.ppm */
#define SHADE_IMPLEMENTATION
#include "shade.h"
#include "../shared/shapes.h"
#include "../shared/label.h"

typedef struct scene {
    shade_mat4 clip_from_world;
    shade_vec3 eye;
    shade_lighting lighting;
    shade_material material;
    const float *positions, *normals;
} scene;

static void ripple(const void *uniforms, const shade_vertex_ids *SHADE_RESTRICT in,
                   shade_vertices *SHADE_RESTRICT out)
{
    const scene *s = (const scene *)uniforms;
    SHADE_EACH_LANE(i) {
        const float *p = s->positions + 3 * in->index[i], *n = s->normals + 3 * in->index[i];
        const float height = 0.03f, per_unit = 3.2f;    /* a wave of two parabolas, and its slope */
        float t = per_unit * p[1], x = 4 * (t - (float)(int)t) - 2, m = x < 0 ? -x : x;
        float h = height * x * (m - 2), dh = 8 * height * per_unit * (m - 1);
        shade_vec3 N = shade_v3(n[0], n[1], n[2]);
        shade_vec3 P = shade_madd(shade_v3(p[0], p[1], p[2]), h, N);
        shade_vec4 clip = shade_mat4_transform(s->clip_from_world, shade_v4(P.x, P.y, P.z, 1));
        /* P = p + h(y) N tilts the normal by the part of grad h that lies in the surface. */
        N = shade_madd(N, -dh, shade_v3(-N.y * N.x, 1 - N.y * N.y, -N.y * N.z));
        lane_put4(out->clip[0], i, clip);
        lane_put(out->varying[0], i, P);
        lane_put(out->varying[3], i, N);
    }
}

static void toon(const void *uniforms, const shade_fragments *SHADE_RESTRICT in,
                 shade_colors *SHADE_RESTRICT out)
{
    const scene *s = (const scene *)uniforms;
    float rgb[3][SHADE_LANES];
    const shade_rows rows = { .position = in->varying[0], .normal = in->varying[3] };
    shade_lit_lanes(&s->lighting, &s->material, s->eye, &rows, rgb[0]);
    SHADE_EACH_LANE(i) {
        shade_vec3 P = lane(in->varying[0], i), N = lane(in->varying[3], i);
        float facing = shade_dot(shade_normalize(N), shade_normalize(shade_sub(s->eye, P)));
        float stripe = 1.6f * P.y - (float)(int)(1.6f * P.y);
        float ink = facing < 0.25f && in->front[i] ? 0.1f : 1.0f;
        float level = ink * (float)(int)(4 * rgb[1][i] + 0.6f) / 4;
        out->color[0][i] = level * (stripe < 0.5f ? 0.95f : 0.10f) + 0.02f * ink;
        out->color[1][i] = level * (stripe < 0.5f ? 0.55f : 0.32f) + 0.01f * ink;
        out->color[2][i] = level * (stripe < 0.5f ? 0.16f : 0.40f) + 0.03f * ink;
    }
}

int main(int argc, char **argv)
{
    shade_light lamp = shade_directional_light(shade_v3(0.6f, -0.8f, -0.7f), shade_v3(1, 1, 1));
    owned_mesh pot = shape_teapot(40);
    canvas c = canvas_new(960, 640, 3);
    scene s = { .eye = { -1.2f, 4.6f, 9 }, .positions = pot.positions, .normals = pot.normals,
                .lighting = { &lamp, 1 },
                .material = { .diffuse = { 0.85f, 0.85f, 0.85f },
                              .specular = { 0.5f, 0.5f, 0.5f }, .shininess = 60 } };
    shade_pipeline pipeline = { ripple, toon, &s, .varyings = 6 };
    shade_mat4 view = shade_mat4_look_at(s.eye, shade_v3(0.3f, 1.3f, 0), shade_v3(0, 1, 0));
    const shade_vec3 ink = { 0, 0, 0 };

    s.clip_from_world = shade_mat4_mul(shade_mat4_perspective(0.52f, 960 / 640.0f, 4, 20), view);
    canvas_gradient(&c.target, shade_v3(0.75f, 0.80f, 0.80f), shade_v3(0.95f, 0.88f, 0.75f));
    mesh_draw(&c.target, &pipeline, &pot);
    label_draw(&c, 24, 594, 22, ink, "vertex shader: P + h(y) N, N tilted to match");
    label_draw(&c, 24, 622, 22, ink, "fragment shader: light in 4 steps, ink where N·V < 1/4");
    mesh_free(&pot);
    return canvas_save(&c, argc, argv, "shaders.ppm");
}
