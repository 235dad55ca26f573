/* gl.c - the scenes with OpenGL: Mesa's llvmpipe, without a window, through OSMesa.

   The vertex shader turns y over and rows are read as they come, so that window coordinates are
   those of shade.h: y down, top-left rule, the same grid of 1/256 pixel.  Facing turns with it.
   Colour is stored as floats: what differs is the equation's, not the rounding of two blends. */
#include "scenes.h"
#define GL_GLEXT_PROTOTYPES 1
#include <GL/osmesa.h>
#include <GL/glext.h>
#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

static struct {
    OSMesaContext context;
    unsigned char window[4 * 4 * 4];    /* OSMesa wants one; nothing is drawn there */
    GLuint program;
    PFNGLCLIPCONTROLPROC clip_control;    /* libOSMesa exports nothing as new as that */
} gl;

const char *gl_open(void)
{
    static const int want[] = {
        OSMESA_FORMAT, OSMESA_RGBA, OSMESA_DEPTH_BITS, 0, OSMESA_PROFILE, OSMESA_CORE_PROFILE,
        OSMESA_CONTEXT_MAJOR_VERSION, 4, OSMESA_CONTEXT_MINOR_VERSION, 5, 0
    };
    GLuint frame, buffer[2], array;
    gl.context = OSMesaCreateContextAttribs(want, NULL);
    if (!gl.context || !OSMesaMakeCurrent(gl.context, gl.window, GL_UNSIGNED_BYTE, 4, 4))
        return "no OpenGL 4.5 from OSMesa";
    gl.clip_control = (PFNGLCLIPCONTROLPROC)OSMesaGetProcAddress("glClipControl");
    if (!gl.clip_control) return "no glClipControl from OSMesa";
    glGenFramebuffers(1, &frame);
    glBindFramebuffer(GL_FRAMEBUFFER, frame);
    glGenRenderbuffers(2, buffer);
    for (int k = 0; k < 2; k++) {
        glBindRenderbuffer(GL_RENDERBUFFER, buffer[k]);
        glRenderbufferStorage(GL_RENDERBUFFER, k ? GL_DEPTH_COMPONENT32F : GL_RGBA32F, WIDTH,
                              HEIGHT);
        glFramebufferRenderbuffer(GL_FRAMEBUFFER, k ? GL_DEPTH_ATTACHMENT : GL_COLOR_ATTACHMENT0,
                                  GL_RENDERBUFFER, buffer[k]);
    }
    if (glCheckFramebufferStatus(GL_FRAMEBUFFER) != GL_FRAMEBUFFER_COMPLETE)
        return "no framebuffer of floats from OSMesa";
    glGenVertexArrays(1, &array);
    glBindVertexArray(array);
    glViewport(0, 0, WIDTH, HEIGHT);
    glDisable(GL_DITHER);
    glEnable(GL_DEPTH_TEST);
    return NULL;
}

const char *gl_name(void) { return (const char *)glGetString(GL_VERSION); }

/* -------------------------------------------------------------------------------- the shaders */

static const char uniforms[] =
    "uniform vec3 k_e, k_a, k_d, k_s, I_a, eye, cool, warm;\n"
    "uniform float n;\n"
    "struct lamp { vec4 position; vec3 I_La, I_d, I_s, abc, aim; float e, cos_beta; };\n"
    "uniform lamp light[LIGHTS];\n"
    "uniform bool lit_at_vertex;\n"
    "uniform float alpha, opacity, cutoff;\n"
    "uniform bool mapped;\n"
    "uniform vec4 ball;\n"
    /* shade_attenuation */
    "float attenuation(lamp j, float r) {\n"
    "  if (j.position.w == 0.0 || j.abc == vec3(0)) return 1.0;\n"
    "  return 1.0 / (j.abc.x + j.abc.y * r + j.abc.z * r * r);\n"
    "}\n"
    /* shade_spot */
    "float spot(lamp j, vec3 L) {\n"
    "  if (j.aim == vec3(0)) return 1.0;\n"
    "  float cosine = dot(L, -normalize(j.aim));\n"
    "  return cosine >= j.cos_beta ? pow(max(cosine, 0.0), j.e) : 0.0;\n"
    "}\n"
    "vec3 toward(lamp j, vec3 P) { return j.position.xyz - j.position.w * P; }\n";

/* center: the point to light; the vertex itself, or per face the centroid */
static const char vertex_main[] =
    "layout(location = 0) in vec3 position;\n"
    "layout(location = 1) in vec3 normal;\n"
    "layout(location = 2) in vec2 texcoord;\n"
    "layout(location = 3) in vec3 color;\n"
    "layout(location = 4) in vec3 center;\n"
    "uniform mat4 clip_from_object, world_from_object;\n"
    "uniform float depth_bias;\n"
    "out vec3 P, N, albedo;\n"
    "out vec2 uv;\n"
    "void main() {\n"
    "  gl_Position = clip_from_object * vec4(position, 1);\n"
    "  gl_Position.y = -gl_Position.y;\n"
    "  gl_Position.z += 2.0 * depth_bias * gl_Position.w;\n"
    "  P = (world_from_object * vec4(center, 1)).xyz;\n"
    "  N = normalize(transpose(inverse(mat3(world_from_object))) * normal);\n"
    "  uv = texcoord;\n"
    "  albedo = lit_at_vertex ? lit(P, N, color) : color;\n"
    "}\n";
static const char fragment_main[] =
    "in vec3 P, N, albedo;\n"
    "in vec2 uv;\n"
    "out vec4 pixel;\n"
    "void main() {\n"
    "  vec4 t = mapped ? texel(uv) : vec4(1);\n"
    "  vec3 color = albedo * t.rgb;\n"
    "  if (!lit_at_vertex && alpha == 0.0) color = lit(P, normalize(N), color);\n"
    "  pixel = vec4(stored(color), alpha == 0.0 ? opacity * t.a : alpha);\n"
    "  if (pixel.a < cutoff) discard;\n"
    "}\n";

static void compile(GLenum stage, const scene *s, const char *body)
{
    char head[100];
    const char *text[6];
    GLuint shader = glCreateShader(stage);
    GLint good = 0;
    snprintf(head, sizeof head, "#version 450 core\n#define LIGHTS %d\n",
             s->light_count > 0 ? s->light_count : 1);
    text[0] = head;
    text[1] = uniforms;
    text[2] = s->equation;
    text[3] = s->texel ? s->texel : "vec4 texel(vec2 uv) { return vec4(1); }\n";
    text[4] = s->stored ? s->stored : "vec3 stored(vec3 rgb) { return rgb; }\n";
    if (stage == GL_VERTEX_SHADER) text[3] = text[4] = "";    /* there are no derivatives there */
    text[5] = body;
    if (s->twin) {
        const int vertex = stage == GL_VERTEX_SHADER;
        text[1] = twin_uniforms_glsl;
        text[2] = vertex ? twin_inputs_glsl : twin_outputs_glsl;
        text[3] = twin_brass_glsl;
        text[4] = "";
        text[5] = (vertex ? twin_vertex_glsl : twin_fragment_glsl)[s->twin - 1];
    }
    glShaderSource(shader, 6, text, NULL);
    glCompileShader(shader);
    glGetShaderiv(shader, GL_COMPILE_STATUS, &good);
    if (!good) {
        char log[2000] = "";
        glGetShaderInfoLog(shader, (GLsizei)sizeof log, NULL, log);
        fprintf(stderr, "%s: %s", s->name, log);
        exit(1);
    }
    glAttachShader(gl.program, shader);
    glDeleteShader(shader);
}

static GLint where(const char *name) { return glGetUniformLocation(gl.program, name); }
static void set3(const char *name, shade_vec3 v) { glUniform3f(where(name), v.x, v.y, v.z); }

static GLint where_of(int j, const char *field)
{
    char text[40];
    snprintf(text, sizeof text, "light[%d].%s", j, field);
    return where(text);
}

static void set3_of(int j, const char *field, shade_vec3 v)
{
    glUniform3f(where_of(j, field), v.x, v.y, v.z);
}

static void set_uniforms(const scene *s, const draw *d)
{
    const shade_draw_state *state = &d->state;
    const shade_lighting *l = &state->lighting;
    shade_mat4 world = state->model.col[3].w != 0 ? state->model : shade_mat4_identity();
    shade_mat4 clip = shade_mat4_mul(shade_mat4_mul(state->projection, state->view), world);
    glUniformMatrix4fv(where("clip_from_object"), 1, GL_FALSE, &clip.col[0].x);
    glUniformMatrix4fv(where("world_from_object"), 1, GL_FALSE, &world.col[0].x);
    glUniform1f(where("depth_bias"), state->raster.depth_bias);
    glUniform1i(where("lit_at_vertex"), state->shading != SHADE_SHADING_PER_FRAGMENT);
    glUniform1f(where("alpha"), d->alpha);
    glUniform1f(where("opacity"), 1 - state->transparency);
    glUniform1f(where("cutoff"), state->alpha_cutoff);
    glUniform1i(where("mapped"), s->has_map && d->mesh.has_texcoords);
    glUniform4f(where("ball"), s->ball.x, s->ball.y, s->ball.z, s->ball.w);
    set3("k_e", d->material.emission);
    set3("k_a", d->material.ambient);
    set3("k_d", d->material.diffuse);
    set3("k_s", d->material.specular);
    glUniform1f(where("n"), d->material.shininess);
    set3("I_a", l->ambient);
    set3("eye", s->eye);
    set3("cool", l->cool);
    set3("warm", l->warm);
    for (int j = 0; j < s->light_count; j++) {
        const shade_light *at = &s->lights[j];
        shade_vec4 p = at->position;
        glUniform4f(where_of(j, "position"), p.x, p.y, p.z, p.w);
        set3_of(j, "I_La", at->ambient);
        set3_of(j, "I_d", at->diffuse);
        set3_of(j, "I_s", at->specular);
        set3_of(j, "aim", at->spot_direction);
        set3_of(j, "abc", shade_v3(at->constant, at->linear, at->quadratic));
        glUniform1f(where_of(j, "e"), at->spot_exponent);
        glUniform1f(where_of(j, "cos_beta"), at->spot_cos_cutoff);
    }
}

/* The notes' own: y is turned over by the projection, not in the shader. */
static void set_twin_uniforms(const scene *s)
{
    twin_uniforms u = scene_twin(s);
    u.Projection = shade_mat4_mul(shade_mat4_scaling(shade_v3(1, -1, 1)), u.Projection);
    glUniformMatrix4fv(where("Model"), 1, GL_FALSE, &u.Model.col[0].x);
    glUniformMatrix4fv(where("View"), 1, GL_FALSE, &u.View.col[0].x);
    glUniformMatrix4fv(where("Projection"), 1, GL_FALSE, &u.Projection.col[0].x);
    glUniformMatrix3fv(where("Normal"), 1, GL_FALSE, &u.Normal.col[0].x);
    glUniform4f(where("direction"), u.direction.x, u.direction.y, u.direction.z, u.direction.w);
}

/* ----------------------------------------------------------------------- geometry and textures */

/* One row of attributes per corner; no index, so that a face can have values of its own. */
typedef struct corner { float position[3], normal[3], texcoord[2], color[3], center[3]; } corner;

static corner corners[MAX_INDICES];

static void face_of_its_own(corner *c)
{
    float a[3], b[3], normal[3], center[3];
    for (int k = 0; k < 3; k++) {
        a[k] = c[1].position[k] - c[0].position[k];
        b[k] = c[2].position[k] - c[0].position[k];
        center[k] = (c[0].position[k] + c[1].position[k] + c[2].position[k]) / 3;
    }
    for (int k = 0; k < 3; k++)
        normal[k] = a[(k + 1) % 3] * b[(k + 2) % 3] - a[(k + 2) % 3] * b[(k + 1) % 3];
    for (int i = 0; i < 3; i++) {
        memcpy(c[i].normal, normal, sizeof normal);
        memcpy(c[i].center, center, sizeof center);
        memcpy(c[i].color, c[0].color, sizeof c[0].color);
    }
}

static void load_corners(const draw *d)
{
    static const int size[5] = { 3, 3, 2, 3, 3 };
    const shape *m = &d->mesh;
    size_t at = 0;
    for (int i = 0; i < m->index_count; i++) {
        corner *c = &corners[i];
        uint32_t v = m->indices[i];
        memcpy(c->position, m->positions + 3 * v, 12);
        memcpy(c->center, c->position, 12);
        memcpy(c->normal, m->normals + 3 * v, 12);
        memcpy(c->texcoord, m->texcoords + 2 * v, 8);
        memcpy(c->color, m->colors + 3 * v, 12);
        for (int k = 0; k < 3 && !m->has_colors; k++) c->color[k] = 1;
    }
    for (int i = 0; i < m->index_count && d->state.shading == SHADE_SHADING_PER_FACE; i += 3)
        face_of_its_own(&corners[i]);
    glBufferData(GL_ARRAY_BUFFER, (GLsizeiptr)sizeof(corner) * m->index_count, corners,
                 GL_STATIC_DRAW);
    for (GLuint k = 0; k < 5; k++) {
        glVertexAttribPointer(k, size[k], GL_FLOAT, GL_FALSE, (GLsizei)sizeof(corner),
                              (const void *)(at * sizeof(float)));
        glEnableVertexAttribArray(k);
        at += (size_t)size[k];
    }
}

/* As floats: of 8-bit texels llvmpipe filters with weights of 8 bits, which the specification
   lets it do and which costs up to 2/255. */
static void load_level(const shade_texture *t, int level)
{
    static float texel[4 * MAP_SIDE * MAP_SIDE];
    static const int of[2][4] = { { 0, 1, 2, 3 }, { 2, 1, 0, 3 } }; /* RGBA8, BGRA8 */
    const unsigned char *from = (const unsigned char *)t->pixels;
    for (int i = 0; i < 4 * t->width * t->height; i++)
        texel[i] = (float)from[i / 4 * 4 + of[t->format == SHADE_FORMAT_BGRA8][i % 4]] / 255;
    glTexImage2D(GL_TEXTURE_2D, level, GL_RGBA32F, t->width, t->height, 0, GL_RGBA, GL_FLOAT,
                 texel);
}

static GLuint load_map(const scene *s)
{
    static const GLint wrap[] = { GL_REPEAT, GL_CLAMP_TO_EDGE, GL_MIRRORED_REPEAT };
    static const GLint least[] = { GL_LINEAR, GL_NEAREST, GL_LINEAR_MIPMAP_LINEAR };
    GLuint id;
    glGenTextures(1, &id);
    glBindTexture(GL_TEXTURE_2D, id);
    load_level(&s->map, 0);
    for (int k = 0; k < s->map.mipmap_count; k++) load_level(&s->levels[k], k + 1);
    glTexParameteri(GL_TEXTURE_2D, GL_TEXTURE_MAX_LEVEL, s->map.mipmap_count);
    glTexParameteri(GL_TEXTURE_2D, GL_TEXTURE_WRAP_S, wrap[s->map.wrap_u]);
    glTexParameteri(GL_TEXTURE_2D, GL_TEXTURE_WRAP_T, wrap[s->map.wrap_v]);
    glTexParameteri(GL_TEXTURE_2D, GL_TEXTURE_MIN_FILTER, least[s->map.filter]);
    glTexParameteri(GL_TEXTURE_2D, GL_TEXTURE_MAG_FILTER,
                    s->map.filter == SHADE_FILTER_NEAREST ? GL_NEAREST : GL_LINEAR);
    return id;
}

static void set_state(const draw *d)
{
    const shade_draw_state *state = &d->state;
    const GLboolean stored = !d->depth_only;
    static const GLenum test[] = { GL_LESS, GL_LEQUAL, GL_GREATER, GL_GEQUAL, GL_EQUAL, GL_ALWAYS };
    glDepthFunc(test[state->raster.depth_test]);
    glDepthMask(!state->raster.depth_read_only);
    glColorMask(stored, stored, stored, stored);
    gl.clip_control(GL_LOWER_LEFT,
                    state->raster.depth_zero_to_one ? GL_ZERO_TO_ONE : GL_NEGATIVE_ONE_TO_ONE);
    glFrontFace(GL_CW);    /* y is turned over */
    glCullFace(state->raster.cull == SHADE_CULL_FRONT ? GL_FRONT : GL_BACK);
    if (state->raster.cull)
        glEnable(GL_CULL_FACE);
    else glDisable(GL_CULL_FACE);
    if (state->raster.blend)
        glEnable(GL_BLEND);
    else glDisable(GL_BLEND);
    if (state->raster.blend == SHADE_BLEND_ADD) /* meshes add their colour times alpha */
        glBlendFuncSeparate(d->alpha > 0 ? GL_ONE : GL_SRC_ALPHA, GL_ONE, GL_ONE, GL_ONE);
    else glBlendFuncSeparate(GL_SRC_ALPHA, GL_ONE_MINUS_SRC_ALPHA, GL_ONE,
                             GL_ONE_MINUS_SRC_ALPHA);
}

static float encode(float c)    /* [IEC61966]; a clear meets no shader */
{
    return c > 0.0031308f ? 1.055f * powf(c, 1 / 2.4f) - 0.055f : 12.92f * c;
}

static shade_vec4 encoded(shade_vec4 c)
{
    return shade_v4(encode(c.x), encode(c.y), encode(c.z), c.w);
}

void gl_draw(const scene *s, float *rgba)
{
    GLuint buffer, map = 0;
    GLint good = 0;
    shade_vec4 background;
    gl.program = glCreateProgram();
    compile(GL_VERTEX_SHADER, s, vertex_main);
    compile(GL_FRAGMENT_SHADER, s, fragment_main);
    glLinkProgram(gl.program);
    glGetProgramiv(gl.program, GL_LINK_STATUS, &good);
    if (!good) {
        fprintf(stderr, "%s: the program does not link\n", s->name);
        exit(1);
    }
    glUseProgram(gl.program);
    glGenBuffers(1, &buffer);
    glBindBuffer(GL_ARRAY_BUFFER, buffer);
    if (s->has_map) map = load_map(s);
    glDepthMask(GL_TRUE);
    glColorMask(GL_TRUE, GL_TRUE, GL_TRUE, GL_TRUE);
    background = s->srgb ? encoded(s->background) : s->background;
    glClearColor(background.x, background.y, background.z, background.w);
    glClearDepth((double)s->clear_depth);
    glClear(GL_COLOR_BUFFER_BIT | GL_DEPTH_BUFFER_BIT);
    for (int k = 0; k < s->draw_count; k++) {
        set_state(&s->draws[k]);
        if (s->twin)
            set_twin_uniforms(s);
        else
            set_uniforms(s, &s->draws[k]);
        load_corners(&s->draws[k]);
        glDrawArrays(GL_TRIANGLES, 0, s->draws[k].mesh.index_count);
    }
    glReadPixels(0, 0, WIDTH, HEIGHT, GL_RGBA, GL_FLOAT, rgba);
    if (glGetError() != GL_NO_ERROR) {
        fprintf(stderr, "%s: OpenGL error\n", s->name);
        exit(1);
    }
    glDeleteBuffers(1, &buffer);
    glDeleteTextures(1, &map);
    glUseProgram(0);
    glDeleteProgram(gl.program);
}
