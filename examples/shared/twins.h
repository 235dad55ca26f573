/* twins.h - shaders of the lecture notes in GLSL, each above its twin in C: UW's colour shader, and
   Massey's two, which light brass in the vertex shader and in the fragment shader.

   Equations and spaces are those of the notes; names are shorter, and a vec3 is never assigned to a
   vec4.  Everything is in eye space, and the light's direction is its direction of travel, with
   w = 0.  The conformance test compiles the GLSL and compares what GLSL and C draw, pixel by
   pixel. */
#ifndef SHARED_TWINS_H
#define SHARED_TWINS_H

#include "shade.h"
#include <stdio.h>
#include <string.h>

enum { TWIN_COLOR, TWIN_GOURAUD, TWIN_PHONG, TWINS };

static const char *const twin_vertex_glsl[TWINS] = {
    "out vec3 c;\n"
    "void main() {\n"
    "  c = color;\n"
    "  vec4 e = View * Model * vec4(p, 1);\n"
    "  gl_Position = Projection * e;\n"
    "}\n",

    "out vec3 c;\n"
    "void main() {\n"
    "  vec4 e = View * Model * vec4(p, 1);\n"
    "  c = brass(normalize(Normal * n), e.xyz);\n"
    "  gl_Position = Projection * e;\n"
    "}\n",

    "out vec3 N, E;\n"
    "void main() {\n"
    "  vec4 e = View * Model * vec4(p, 1);\n"
    "  N = Normal * n;\n"
    "  E = e.xyz;\n"
    "  gl_Position = Projection * e;\n"
    "}\n"
};
static const char *const twin_fragment_glsl[TWINS] = {
    "in vec3 c;\n"
    "void main() {\n"
    "  pixel = vec4(c, 1);\n"
    "}\n",

    "in vec3 c;\n"
    "void main() {\n"
    "  pixel = vec4(c, 1);\n"
    "}\n",

    "in vec3 N, E;\n"
    "void main() {\n"
    "  pixel = vec4(brass(normalize(N), E), 1);\n"
    "}\n"
};

/* The lines before each shader; its layout numbers are those of the conformance test. */
static const char twin_inputs_glsl[] = "layout(location = 0) in vec3 p;\n"
                                       "layout(location = 1) in vec3 n;\n"
                                       "layout(location = 3) in vec3 color;\n";
static const char twin_outputs_glsl[] = "out vec4 pixel;\n";
static const char twin_uniforms_glsl[] = "uniform mat4 Model, View, Projection;\n"
                                         "uniform mat3 Normal;\n"
                                         "uniform vec4 direction;\n";
typedef struct twin_uniforms {
    shade_mat4 Model, View, Projection;
    shade_mat3 Normal;                      /* (M^-1)^T of View Model */
    shade_vec4 direction;
    const float *p, *n, *color;             /* the arrays of the attributes */
} twin_uniforms;

/* Phong's equation: E is the point in eye space, where the eye is the origin. */
static const char twin_brass_glsl[] =
    "vec3 brass(vec3 N, vec3 E) {\n"
    "  vec3 Ka = vec3(0.329412, 0.223529, 0.027451);\n"
    "  vec3 Kd = vec3(0.780392, 0.568627, 0.113725);\n"
    "  vec3 Ks = vec3(0.992157, 0.941176, 0.807843);\n"
    "  float a = 27.89743616, Ia = 0.3, Id = 1.0, Is = 1.0;\n"
    "  vec4 d = View * direction;\n"
    "  vec3 l = normalize(-d.xyz);\n"
    "  vec3 v = normalize(-E);\n"
    "  vec3 r = reflect(-l, N);\n"
    "  vec3 ambient = Ka * Ia;\n"
    "  vec3 matte = ambient + max(dot(N, l), 0.0) * Id * Kd;\n"
    "  return matte + pow(max(dot(r, v), 0.0), a) * Is * Ks;\n"
    "}\n";

/* A function in C, and its text, whose lines the compiler joins */
#define TWIN(text, ...) \
    static const char text[] = #__VA_ARGS__; \
    static inline __VA_ARGS__

/* Breaks the lines of such a text again: behind ; and behind the braces of bodies. */
static inline void twin_unjoin(const char *text, char *out)
{
    for (int n, depth = 0; *text; text += n) {
        depth -= *text == '}';
        for (n = 0; text[n] != ';' && text[n] != '}' && strncmp(text + n, ") {", 3) != 0; n++)
            if (text[n] == '{') n += (int)strcspn(text + n, "}");
        n += text[n] == ')' ? 3 : 1;
        out += sprintf(out, "%*s%.*s\n", 2 * depth, "", n, text);
        depth += text[n - 1] == '{';
        while (text[n] == ' ') n++;
    }
}

TWIN(twin_brass_c,
shade_vec3 twin_brass(const twin_uniforms *u, shade_vec3 N, shade_vec3 E)
{
    const shade_vec3 Ka = { 0.329412f, 0.223529f, 0.027451f };
    const shade_vec3 Kd = { 0.780392f, 0.568627f, 0.113725f };
    const shade_vec3 Ks = { 0.992157f, 0.941176f, 0.807843f };
    const float a = 27.89743616f, Ia = 0.3f, Id = 1, Is = 1;
    shade_vec4 d = shade_mat4_transform(u->View, u->direction);
    shade_vec3 l = shade_normalize(shade_v3(-d.x, -d.y, -d.z));
    shade_vec3 v = shade_normalize(shade_neg(E));
    shade_vec3 r = shade_reflect(shade_neg(l), N);
    shade_vec3 ambient = shade_scale(Ka, Ia);
    shade_vec3 matte = shade_madd(ambient, shade_lambert(N, l) * Id, Kd);
    return shade_madd(matte, shade_power(shade_dot(r, v), a) * Is, Ks);    /* clamps its base */
})

static inline shade_vec3 twin_attribute(const float *array, uint32_t index)
{
    return shade_v3(array[3 * index], array[3 * index + 1], array[3 * index + 2]);
}

static inline void twin_out(float (*row)[SHADE_LANES], int i, shade_vec3 v)
{
    row[0][i] = v.x;
    row[1][i] = v.y;
    row[2][i] = v.z;
}

/* Writes gl_Position, and returns the point in eye space. */
static inline shade_vec3 twin_position(const twin_uniforms *u, uint32_t index, int i,
                                       shade_vertices *out)
{
    shade_vec3 p = twin_attribute(u->p, index);
    shade_vec4 e = shade_mat4_transform(shade_mat4_mul(u->View, u->Model),
                                        shade_v4(p.x, p.y, p.z, 1));
    shade_vec4 clip = shade_mat4_transform(u->Projection, e);
    out->clip[0][i] = clip.x;
    out->clip[1][i] = clip.y;
    out->clip[2][i] = clip.z;
    out->clip[3][i] = clip.w;
    return shade_v3(e.x, e.y, e.z);
}

static inline void twin_vertex_color(const void *uniforms,
                                     const shade_vertex_ids *SHADE_RESTRICT in,
                                     shade_vertices *SHADE_RESTRICT out)
{
    const twin_uniforms *u = (const twin_uniforms *)uniforms;
    SHADE_EACH_LANE(i) {
        twin_position(u, in->index[i], i, out);
        twin_out(out->varying, i, twin_attribute(u->color, in->index[i]));
    }
}

static inline void twin_vertex_gouraud(const void *uniforms,
                                       const shade_vertex_ids *SHADE_RESTRICT in,
                                       shade_vertices *SHADE_RESTRICT out)
{
    const twin_uniforms *u = (const twin_uniforms *)uniforms;
    SHADE_EACH_LANE(i) {
        shade_vec3 E = twin_position(u, in->index[i], i, out);
        shade_vec3 N = shade_mat3_transform(u->Normal, twin_attribute(u->n, in->index[i]));
        twin_out(out->varying, i, twin_brass(u, shade_normalize(N), E));
    }
}

static inline void twin_vertex_phong(const void *uniforms,
                                     const shade_vertex_ids *SHADE_RESTRICT in,
                                     shade_vertices *SHADE_RESTRICT out)
{
    const twin_uniforms *u = (const twin_uniforms *)uniforms;
    SHADE_EACH_LANE(i) {
        shade_vec3 N = shade_mat3_transform(u->Normal, twin_attribute(u->n, in->index[i]));
        twin_out(out->varying, i, N);
        twin_out(out->varying + 3, i, twin_position(u, in->index[i], i, out));
    }
}

static inline void twin_fragment_color(const void *uniforms,
                                       const shade_fragments *SHADE_RESTRICT in,
                                       shade_colors *SHADE_RESTRICT out)
{
    const float (*c)[SHADE_LANES] = in->varying;
    (void)uniforms;
    SHADE_EACH_LANE(i) { twin_out(out->color, i, shade_v3(c[0][i], c[1][i], c[2][i])); }
}

static inline void twin_fragment_phong(const void *uniforms,
                                       const shade_fragments *SHADE_RESTRICT in,
                                       shade_colors *SHADE_RESTRICT out)
{
    const twin_uniforms *u = (const twin_uniforms *)uniforms;
    const float (*v)[SHADE_LANES] = in->varying;
    SHADE_EACH_LANE(i) {
        shade_vec3 N = shade_normalize(shade_v3(v[0][i], v[1][i], v[2][i]));
        shade_vec3 E = shade_v3(v[3][i], v[4][i], v[5][i]);
        twin_out(out->color, i, twin_brass(u, N, E));
    }
}

/* Twin k as a pipeline without uniforms, which the caller sets */
static inline shade_pipeline twin_pipeline(int k)
{
    static shade_vertex_shader *const vertex[TWINS] = { twin_vertex_color, twin_vertex_gouraud,
                                                        twin_vertex_phong };
    static const shade_pipeline none;
    shade_pipeline p = none;
    p.vertex = vertex[k];
    p.varyings = k == TWIN_PHONG ? 6 : 3;
    p.fragment = k == TWIN_PHONG ? twin_fragment_phong : twin_fragment_color;
    return p;
}
#endif
