/* 38_glsl_twins.c - shaders of the lecture notes, drawn by their twins in C.  Left: colours of
   vertices, interpolated between them (UW).  Middle and right: brass, lit in the vertex shader and
   in the fragment shader, with Massey's camera (67 degrees, 5 away; its picture moved up by an
   eighth), turn (.8 about x) and light.  Lit in the vertex shader, it loses one highlight and
   tears the other.  Below, the equation of both in both languages, line by line; twins.h has the
   rest.  Where OSMesa is installed, make conformance draws a ring by each GLSL as well: of 255 no
   pixel is off by more than .53, of which .5 is rounding.
   Try p.interpolation = SHADE_INTERPOLATION_CONSTANT: one colour a triangle.

   cc -O2 -I. examples/lessons/38_glsl_twins.c -lm -o glsl_twins && ./glsl_twins */
#define SHADE_IMPLEMENTATION
#include "shade.h"
#include "../shared/shapes.h"
#include "../shared/label.h"
#include "../shared/mono.h"
#include "../shared/twins.h"

static const shade_vec3 grey = { 0.7f, 0.7f, 0.7f };

int main(int argc, char **argv)
{
    static const char *const name[TWINS] = { "colours", "lit in the vertex shader",
                                             "lit in the fragment shader" };
    shade_vec2 profile[9];
    char text[2000];
    canvas c = canvas_new(1440, 734, 2);

    for (int i = 0; i < 9; i++) {
        shade_vec2 t = mesh_turn((float)(i % 8) / 8);
        profile[i] = shade_v2(1.6f + 0.85f * t.y, 0.85f * t.x);
    }
    owned_mesh ring = shape_turned(profile, 9, 20);
    size_t vertices = (size_t)ring.view.vertex_count;
    twin_uniforms u = { .direction = { 0, 0, -1, 0 }, .p = ring.positions, .n = ring.normals };
    u.View = shade_mat4_look_at(shade_v3(0, 0, 5), shade_v3(0, 0, 0), shade_v3(0, 1, 0));
    u.Projection = shade_mat4_perspective(shade_radians(67), 320 / 270.0f, 0.2f, 10);
    u.Projection = shade_mat4_mul(shade_mat4_translation(shade_v3(0, 0.25f, 0)), u.Projection);
    u.Model = shade_mat4_rotation(0.8f, shade_v3(1, 0, 0));
    u.Normal = shade_normal_matrix(shade_mat4_mul(u.View, u.Model));
    u.color = ring.colors = (float *)example_memory(vertices, 3 * sizeof(float));
    for (size_t i = 0; i < 3 * vertices; i++) ring.colors[i] = 0.5f + 0.5f * ring.normals[i];
    canvas_dark(&c.target);
    for (int k = 0; k < TWINS; k++) {
        shade_target panel = canvas_panel(&c, 3 + 480 * k, 0, 474, 400);
        shade_pipeline p = twin_pipeline(k);
        p.uniforms = &u;
        mesh_draw(&panel, &p, &ring);
        label_center(&c, 240 + 480 * k, 344, 24, grey, name[k]);
    }
    label_draw(&c, 20, 390, 22, grey, "GLSL, as in the notes:");
    label_draw(&c, 640, 390, 22, grey, "C, its twin:");
    mono_listing(&c, 20, 416, 60, grey, twin_brass_glsl);
    twin_unjoin(twin_brass_c, text);
    mono_listing(&c, 640, 416, 78, grey, text);
    mesh_free(&ring);
    return canvas_save(&c, argc, argv, "glsl_twins.ppm");
}
