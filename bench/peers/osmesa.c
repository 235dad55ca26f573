/* osmesa.c - Mesa's llvmpipe, without a window, through OSMesa: OpenGL 3.3 core.

   The shaders are the equations of the scene in hand and nothing else: no attenuation where the
   scene has none, loops of constant length, light constants as uniforms.  The picture stays in a
   framebuffer object, so glFinish does not copy it. */
#include "../clock.h"
#include "../scenes.h"

#ifdef HAVE_OSMESA
#define GL_GLEXT_PROTOTYPES 1
#include <GL/osmesa.h>
#include <GL/glext.h>

static struct {
    OSMesaContext context;
    uint32_t window[16];        /* OSMesa wants a default framebuffer; nothing is drawn there */
    GLuint frame, large, color, depth, array, buffers[3], texture, program;
    scene s;
} gl;

static const char *osmesa_open(void)
{
    static const int want[] = {
        OSMESA_FORMAT, OSMESA_RGBA, OSMESA_DEPTH_BITS, 0, OSMESA_PROFILE, OSMESA_CORE_PROFILE,
        OSMESA_CONTEXT_MAJOR_VERSION, 3, OSMESA_CONTEXT_MINOR_VERSION, 3, 0
    };
    setenv("GALLIUM_DRIVER", "llvmpipe", 1);
    setenv("LP_NUM_THREADS", "0", 0);
    gl.context = OSMesaCreateContextAttribs(want, NULL);
    if (!gl.context || !OSMesaMakeCurrent(gl.context, gl.window, GL_UNSIGNED_BYTE, 4, 4))
        return "no OpenGL 3.3 context";
    return NULL;
}

#define MESH_VERTEX \
    "#version 330 core\n" \
    "layout(location = 0) in vec3 position;\n" \
    "layout(location = 1) in vec3 normal;\n" \
    "uniform mat4 clip_from_object, world_from_object;\n" \
    "uniform mat3 normal_matrix;\n"
#define LIGHT_UNIFORMS \
    "uniform vec3 base, k_d, k_s, eye;\n"        /* base: k_e + k_a (I_a + sum of I_La) */ \
    "uniform float shininess;\n" \
    "uniform vec3 at[LIGHTS], I_d[LIGHTS], I_s[LIGHTS];\n"
/* iteration three, one point light without attenuation */
#define POINT_LIGHT \
    "vec3 lit(vec3 P, vec3 N) {\n" \
    "  vec3 V = normalize(eye - P), sum = base;\n" \
    "  for (int j = 0; j < LIGHTS; j++) {\n" \
    "    vec3 L = normalize(at[j] - P), H = normalize(L + V);\n" \
    "    float nl = max(dot(N, L), 0.0);\n" \
    "    float gloss = nl > 0.0 ? pow(max(dot(N, H), 0.0), shininess) : 0.0;\n" \
    "    sum += nl * (k_d * I_d[j]) + gloss * (k_s * I_s[j]);\n" \
    "  }\n" \
    "  return sum;\n" \
    "}\n"
/* iteration four: cone and attenuation */
#define SPOT_LIGHT \
    "uniform vec3 axis[LIGHTS], fall[LIGHTS];\n" \
    "uniform float cutoff[LIGHTS], tight[LIGHTS];\n" \
    "vec3 lit(vec3 P, vec3 N) {\n" \
    "  vec3 V = normalize(eye - P), sum = base;\n" \
    "  for (int j = 0; j < LIGHTS; j++) {\n" \
    "    vec3 l = at[j] - P;\n" \
    "    float rr = dot(l, l), ir = inversesqrt(rr), r = rr * ir;\n" \
    "    vec3 L = l * ir, H = normalize(L + V);\n" \
    "    float cone = dot(L, axis[j]), nl = max(dot(N, L), 0.0);\n" \
    "    float att = 1.0 / (fall[j].x + fall[j].y * r + fall[j].z * rr);\n" \
    "    att = cone >= cutoff[j] ? att * pow(cone, tight[j]) : 0.0;\n" \
    "    float gloss = nl > 0.0 ? pow(max(dot(N, H), 0.0), shininess) : 0.0;\n" \
    "    sum += (att * nl) * (k_d * I_d[j]) + (att * gloss) * (k_s * I_s[j]);\n" \
    "  }\n" \
    "  return sum;\n" \
    "}\n"

static const char *const pixel_vertex = MESH_VERTEX
    "out vec3 P, N;\n"
    "void main() {\n"
    "  gl_Position = clip_from_object * vec4(position, 1);\n"
    "  P = (world_from_object * vec4(position, 1)).xyz;\n"
    "  N = normalize(normal_matrix * normal);\n"
    "}\n";
static const char *const pixel_fragment =
    "in vec3 P, N;\n"
    "out vec4 color;\n"
    "void main() { color = vec4(lit(P, normalize(N)), 1); }\n";
static const char *const gouraud_main =
    "out vec3 shade;\n"
    "void main() {\n"
    "  gl_Position = clip_from_object * vec4(position, 1);\n"
    "  vec3 P = (world_from_object * vec4(position, 1)).xyz;\n"
    "  shade = lit(P, normalize(normal_matrix * normal));\n"
    "}\n";
static const char *const gouraud_fragment =
    "#version 330 core\n"
    "in vec3 shade;\n"
    "out vec4 color;\n"
    "void main() { color = vec4(shade, 1); }\n";
static const char *const map_vertex = MESH_VERTEX
    "out vec2 uv;\n"
    "void main() {\n"
    "  gl_Position = clip_from_object * vec4(position, 1);\n"
    "  uv = normal.xy;\n"
    "}\n";
static const char *const map_fragment =
    "#version 330 core\n"
    "uniform sampler2D map;\n"
    "in vec2 uv;\n"
    "out vec4 color;\n"
    "void main() { color = texture(map, uv); }\n";
static const char *const flat_vertex =
    "#version 330 core\n"
    "layout(location = 0) in vec3 position;\n"
    "void main() { gl_Position = vec4(position, 1); }\n";
static const char *const flat_fragment =
    "#version 330 core\n"
    "uniform vec4 paint;\n"
    "out vec4 color;\n"
    "void main() { color = paint; }\n";
static const char *const depth_fragment = "#version 330 core\nvoid main() { }\n";

static void add_shader(GLenum stage, int count, const char *const *text)
{
    GLuint shader = glCreateShader(stage);
    GLint good = 0;
    glShaderSource(shader, count, (const GLchar *const *)text, NULL);
    glCompileShader(shader);
    glGetShaderiv(shader, GL_COMPILE_STATUS, &good);
    if (!good) {
        char log[2000] = "";
        glGetShaderInfoLog(shader, (GLsizei)sizeof log, NULL, log);
        fprintf(stderr, "%s", log);
        exit(1);
    }
    glAttachShader(gl.program, shader);
    glDeleteShader(shader);
}

static GLint where(const char *name) { return glGetUniformLocation(gl.program, name); }
static GLint where_of(const char *name, int j)
{
    char text[32];
    snprintf(text, sizeof text, "%s[%d]", name, j);
    return where(text);
}
static void set3(GLint at, shade_vec3 v) { glUniform3f(at, v.x, v.y, v.z); }

static void set_uniforms(const scene *s)
{
    const shade_material *m = &s->material;
    shade_mat4 identity = shade_mat4_identity(), world = s->state.model, clip;
    shade_vec3 ambient = s->state.lighting.ambient;
    shade_mat3 normals;
    if (world.col[3].w == 0) world = identity;
    clip = shade_mat4_mul(shade_mat4_mul(s->state.projection, s->state.view), world);
    normals = shade_normal_matrix(world);
    glUniformMatrix4fv(where("clip_from_object"), 1, GL_FALSE, &clip.col[0].x);
    glUniformMatrix4fv(where("world_from_object"), 1, GL_FALSE, &world.col[0].x);
    glUniformMatrix3fv(where("normal_matrix"), 1, GL_FALSE, &normals.col[0].x);
    for (int j = 0; j < s->state.lighting.light_count; j++) {
        const shade_light *l = &s->lights[j];
        ambient = shade_add(ambient, l->ambient);
        set3(where_of("at", j), shade_v3(l->position.x, l->position.y, l->position.z));
        set3(where_of("I_d", j), l->diffuse);
        set3(where_of("I_s", j), l->specular);
        set3(where_of("fall", j), shade_v3(l->constant, l->linear, l->quadratic));
        set3(where_of("axis", j), shade_neg(shade_normalize(l->spot_direction)));
        glUniform1f(where_of("cutoff", j), l->spot_cos_cutoff);
        glUniform1f(where_of("tight", j), l->spot_exponent);
    }
    set3(where("base"), shade_add(m->emission, shade_mul(m->ambient, ambient)));
    set3(where("k_d"), m->diffuse);
    set3(where("k_s"), m->specular);
    set3(where("eye"), s->eye);
    glUniform1f(where("shininess"), m->shininess);
    glUniform4f(where("paint"), s->color.x, s->color.y, s->color.z, s->color.w);
}

static void build_program(const scene *s)
{
    char lights[64];
    const char *light = s->lights[0].spot_cos_cutoff != 0 ? SPOT_LIGHT : POINT_LIGHT;
    GLint good = 0;
    snprintf(lights, sizeof lights, "#define LIGHTS %d\n", s->state.lighting.light_count);
    gl.program = glCreateProgram();
    if (s->kind == SCENE_MAP) {
        add_shader(GL_VERTEX_SHADER, 1, &map_vertex);
        add_shader(GL_FRAGMENT_SHADER, 1, &map_fragment);
    } else if (s->kind != SCENE_LIT) {
        add_shader(GL_VERTEX_SHADER, 1, &flat_vertex);
        add_shader(GL_FRAGMENT_SHADER, 1, s->kind == SCENE_FLAT ? &flat_fragment : &depth_fragment);
    } else if (s->state.shading == SHADE_SHADING_PER_FRAGMENT) {
        add_shader(GL_VERTEX_SHADER, 1, &pixel_vertex);
        const char *all[5] = { "#version 330 core\n", lights, LIGHT_UNIFORMS, light,
                               pixel_fragment };
        add_shader(GL_FRAGMENT_SHADER, 5, all);
    } else {
        const char *all[5] = { MESH_VERTEX, lights, LIGHT_UNIFORMS, light, gouraud_main };
        add_shader(GL_VERTEX_SHADER, 5, all);
        add_shader(GL_FRAGMENT_SHADER, 1, &gouraud_fragment);
    }
    glLinkProgram(gl.program);
    glGetProgramiv(gl.program, GL_LINK_STATUS, &good);
    if (!good) fprintf(stderr, "program of %s does not link\n", s->name), exit(1);
    glUseProgram(gl.program);
    set_uniforms(s);
}

static void attribute(GLuint at, GLuint buffer, const float *data, int count)
{
    glBindBuffer(GL_ARRAY_BUFFER, buffer);
    glBufferData(GL_ARRAY_BUFFER, (GLsizeiptr)((size_t)count * 12), data, GL_STATIC_DRAW);
    glVertexAttribPointer(at, 3, GL_FLOAT, GL_FALSE, 0, NULL);
    glEnableVertexAttribArray(at);
}

static GLuint renderbuffer(GLenum format, GLenum attachment)
{
    GLuint id;
    glGenRenderbuffers(1, &id);
    glBindRenderbuffer(GL_RENDERBUFFER, id);
    glRenderbufferStorage(GL_RENDERBUFFER, format, gl.s.width, gl.s.height);
    glFramebufferRenderbuffer(GL_FRAMEBUFFER, attachment, GL_RENDERBUFFER, id);
    return id;
}

static void texture(const scene *s, int width, int height)
{
    glGenTextures(1, &gl.texture);
    glBindTexture(GL_TEXTURE_2D, gl.texture);
    glTexImage2D(GL_TEXTURE_2D, 0, s->srgb ? GL_SRGB8_ALPHA8 : GL_RGBA8, width, height, 0, GL_RGBA,
                 GL_UNSIGNED_BYTE, s->texels);
}

/* The picture of twice the size; for resolve it is in a framebuffer object of its own. */
static void load_halved(const scene *s)
{
    texture(s, 2 * s->width, 2 * s->height);
    if (s->kind == SCENE_MIPMAPS) return;
    glGenFramebuffers(1, &gl.large);
    glBindFramebuffer(GL_READ_FRAMEBUFFER, gl.large);
    glFramebufferTexture2D(GL_READ_FRAMEBUFFER, GL_COLOR_ATTACHMENT0, GL_TEXTURE_2D, gl.texture, 0);
}

static void osmesa_load(const scene *s)
{
    gl.s = *s;
    glGenFramebuffers(1, &gl.frame);
    glBindFramebuffer(GL_FRAMEBUFFER, gl.frame);
    gl.color = renderbuffer(s->srgb ? GL_SRGB8_ALPHA8 : GL_RGBA8, GL_COLOR_ATTACHMENT0);
    gl.depth = renderbuffer(GL_DEPTH_COMPONENT24, GL_DEPTH_ATTACHMENT);    /* 32F is as fast */
    if (glCheckFramebufferStatus(GL_FRAMEBUFFER) != GL_FRAMEBUFFER_COMPLETE)
        fprintf(stderr, "framebuffer incomplete\n"), exit(1);
    glViewport(0, 0, s->width, s->height);
    glDisable(GL_DITHER);
    if (s->srgb) glEnable(GL_FRAMEBUFFER_SRGB);
    else glDisable(GL_FRAMEBUFFER_SRGB);
    glEnable(GL_DEPTH_TEST);
    glDepthFunc(GL_LESS);
    if (s->state.raster.cull == SHADE_CULL_BACK)
        glEnable(GL_CULL_FACE);
    else glDisable(GL_CULL_FACE);
    if (s->kind == SCENE_DEPTH) {
        glColorMask(GL_FALSE, GL_FALSE, GL_FALSE, GL_FALSE);
        glDrawBuffer(GL_NONE);
    } else glColorMask(GL_TRUE, GL_TRUE, GL_TRUE, GL_TRUE);
    glClearColor(s->background.x, s->background.y, s->background.z, s->background.w);
    if (s->kind >= SCENE_MIPMAPS) load_halved(s);
    if (s->kind >= SCENE_CLEAR) return;
    glGenVertexArrays(1, &gl.array);
    glBindVertexArray(gl.array);
    glGenBuffers(3, gl.buffers);
    attribute(0, gl.buffers[0], s->positions, s->vertex_count);
    if (s->kind == SCENE_LIT || s->kind == SCENE_MAP)
        attribute(1, gl.buffers[1], s->normals, s->vertex_count);
    if (s->kind == SCENE_MAP) {
        texture(s, SCENE_TEXELS, SCENE_TEXELS);
        glTexParameteri(GL_TEXTURE_2D, GL_TEXTURE_MIN_FILTER, GL_LINEAR);
    }
    glBindBuffer(GL_ELEMENT_ARRAY_BUFFER, gl.buffers[2]);
    glBufferData(GL_ELEMENT_ARRAY_BUFFER, (GLsizeiptr)((size_t)s->index_count * 4), s->indices,
                 GL_STATIC_DRAW);
    build_program(s);
}

static void osmesa_draw(void)
{
    GLbitfield color = gl.s.kind == SCENE_DEPTH ? 0 : GL_COLOR_BUFFER_BIT;
    const int w = gl.s.width, h = gl.s.height;
    if (gl.s.kind < SCENE_MIPMAPS) glClear(color | GL_DEPTH_BUFFER_BIT);
    if (gl.s.kind == SCENE_MIPMAPS) glGenerateMipmap(GL_TEXTURE_2D);
    if (gl.s.kind == SCENE_RESOLVE)
        glBlitFramebuffer(0, 0, 2 * w, 2 * h, 0, 0, w, h, GL_COLOR_BUFFER_BIT, GL_LINEAR);
    if (gl.s.kind < SCENE_CLEAR)
        glDrawElements(GL_TRIANGLES, gl.s.index_count, GL_UNSIGNED_INT, NULL);
    glFinish();
}

static void flip(void *rows, size_t bytes, int height)
{
    char *top = (char *)rows, *bottom = top + bytes * (size_t)(height - 1), *line = malloc(bytes);
    if (!line) exit(1);
    for (; top < bottom; top += bytes, bottom -= bytes)
        memcpy(line, top, bytes), memcpy(top, bottom, bytes), memcpy(bottom, line, bytes);
    free(line);
}

static void osmesa_read(uint32_t *rgba, float *depth)
{
    int w = gl.s.width, h = gl.s.height;
    if (gl.s.kind >= SCENE_MIPMAPS) {    /* its rows went in from the top, and come out so */
        glBindFramebuffer(GL_FRAMEBUFFER, gl.frame);
        if (gl.s.kind == SCENE_RESOLVE) glReadPixels(0, 0, w, h, GL_RGBA, GL_UNSIGNED_BYTE, rgba);
        else glGetTexImage(GL_TEXTURE_2D, 1, GL_RGBA, GL_UNSIGNED_BYTE, rgba);
        glBindFramebuffer(GL_READ_FRAMEBUFFER, gl.large);
        return;
    }
    if (gl.s.kind != SCENE_DEPTH) glReadPixels(0, 0, w, h, GL_RGBA, GL_UNSIGNED_BYTE, rgba);
    glReadPixels(0, 0, w, h, GL_DEPTH_COMPONENT, GL_FLOAT, depth);
    flip(rgba, (size_t)w * 4, h);
    flip(depth, (size_t)w * 4, h);
    if (glGetError() != GL_NO_ERROR) fprintf(stderr, "OpenGL error in %s\n", gl.s.name), exit(1);
}

static void osmesa_unload(void)
{
    glDeleteRenderbuffers(1, &gl.color), glDeleteRenderbuffers(1, &gl.depth);
    glDeleteFramebuffers(1, &gl.frame);
    if (gl.s.kind == SCENE_RESOLVE) glDeleteFramebuffers(1, &gl.large);
    if (gl.s.kind >= SCENE_MIPMAPS) glDeleteTextures(1, &gl.texture);
    gl.large = 0;
    if (gl.s.kind >= SCENE_CLEAR) return;
    glDeleteVertexArrays(1, &gl.array), glDeleteBuffers(3, gl.buffers);
    glUseProgram(0), glDeleteProgram(gl.program);
    if (gl.s.kind == SCENE_MAP) glDeleteTextures(1, &gl.texture);
}

#else
static const char *osmesa_open(void) { return "OSMesa not installed"; }
static void osmesa_load(const scene *s) { (void)s; }
static void osmesa_draw(void) { }
static void osmesa_read(uint32_t *rgba, float *depth) { (void)rgba, (void)depth; }
static void osmesa_unload(void) { }
#endif

const peer *osmesa_peer(void);
const peer *osmesa_peer(void)
{
    static const peer p = { "llvmpipe",  osmesa_open, osmesa_load,
                            osmesa_draw, osmesa_read, osmesa_unload };
    return &p;
}
