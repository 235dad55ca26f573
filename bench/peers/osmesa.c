/* osmesa.c - Mesa's llvmpipe, without a window, through OSMesa: OpenGL 4.5 core.  The picture stays
   in a framebuffer object, so glFinish does not copy it. */
#include "peer.h"

#ifdef HAVE_OSMESA
#define GL_GLEXT_PROTOTYPES 1
#include <GL/osmesa.h>
#include <GL/glext.h>

static struct {
    OSMesaContext context;
    uint32_t window[16];        /* OSMesa wants a default framebuffer; nothing is drawn there */
    GLuint frame, large, color, depth, array, buffers[4], texture, program;
    scene s;
} gl;

static const char *osmesa_open(peer *p)
{
    static const int want[] = {
        OSMESA_FORMAT, OSMESA_RGBA, OSMESA_DEPTH_BITS, 0, OSMESA_PROFILE, OSMESA_CORE_PROFILE,
        OSMESA_CONTEXT_MAJOR_VERSION, 4, OSMESA_CONTEXT_MINOR_VERSION, 5, 0
    };
    gl.context = OSMesaCreateContextAttribs(want, NULL);
    if (!gl.context || !OSMesaMakeCurrent(gl.context, gl.window, GL_UNSIGNED_BYTE, 4, 4))
        return "no OpenGL 4.5 context";
    glActiveTexture(GL_TEXTURE1);    /* the shaders' binding */
    snprintf(p->about, sizeof p->about, "%s, OpenGL %s", (const char *)glGetString(GL_RENDERER),
             (const char *)glGetString(GL_VERSION));
    return NULL;
}

static void add_shader(GLuint program, GLenum stage, const char *text)
{
    GLuint shader = glCreateShader(stage);
    GLint good = 0;
    glShaderSource(shader, 1, &text, NULL);
    glCompileShader(shader);
    glGetShaderiv(shader, GL_COMPILE_STATUS, &good);
    if (!good) {
        char log[2000] = "";
        glGetShaderInfoLog(shader, (GLsizei)sizeof log, NULL, log);
        fprintf(stderr, "%s", log);
        exit(1);
    }
    glAttachShader(program, shader);
    glDeleteShader(shader);
}

static void build_program(const scene *s)
{
    const peer_shaders text = peer_shaders_of(s);
    const peer_constants constants = peer_constants_of(s, shade_mat4_identity());
    GLint good = 0;
    gl.program = glCreateProgram();
    add_shader(gl.program, GL_VERTEX_SHADER, text.vertex);
    add_shader(gl.program, GL_FRAGMENT_SHADER, text.fragment);
    glLinkProgram(gl.program);
    glGetProgramiv(gl.program, GL_LINK_STATUS, &good);
    if (!good) fprintf(stderr, "program of %s does not link\n", s->name), exit(1);
    glUseProgram(gl.program);
    glBindBufferBase(GL_UNIFORM_BUFFER, 0, gl.buffers[3]);
    glBufferData(GL_UNIFORM_BUFFER, sizeof constants, &constants, GL_STATIC_DRAW);
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

static void osmesa_load(const peer *p, const scene *s)
{
    (void)p;
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
    glGenBuffers(4, gl.buffers);
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

static void osmesa_draw(const peer *p)
{
    (void)p;
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

static void osmesa_read(const peer *p, uint32_t *rgba, float *depth)
{
    int w = gl.s.width, h = gl.s.height;
    (void)p;
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

static void osmesa_unload(const peer *p)
{
    (void)p;
    glDeleteRenderbuffers(1, &gl.color), glDeleteRenderbuffers(1, &gl.depth);
    glDeleteFramebuffers(1, &gl.frame);
    if (gl.s.kind == SCENE_RESOLVE) glDeleteFramebuffers(1, &gl.large);
    if (gl.s.kind >= SCENE_MIPMAPS) glDeleteTextures(1, &gl.texture);
    gl.large = 0;
    if (gl.s.kind >= SCENE_CLEAR) return;
    glDeleteVertexArrays(1, &gl.array), glDeleteBuffers(4, gl.buffers);
    glUseProgram(0), glDeleteProgram(gl.program);
    if (gl.s.kind == SCENE_MAP) glDeleteTextures(1, &gl.texture);
}

#define OSMESA(f) osmesa_##f
#else
#define OSMESA(f) NULL
#endif

peer *osmesa_peer(void)
{
    static peer p = { "llvmpipe",   0,            "",           OSMESA(open),
                      OSMESA(load), OSMESA(draw), OSMESA(read), OSMESA(unload) };
    return &p;
}
