/* peer.h - what the programs of bench/ and the adapters of peers/ share: what a peer is, the
   settings under which it is fastest, the shaders and their constants.

   The shaders are the equations of the scene in hand and nothing else: no attenuation where the
   scene has none, loops of constant length.  Each text is GLSL of OpenGL 4.5 and of Vulkan. */
#ifndef BENCH_PEER_H
#define BENCH_PEER_H

#include "../clock.h"
#include "../scenes.h"
#ifdef __GLIBC__
#include <malloc.h>
#endif

typedef struct peer peer;
struct peer {
    const char *name;
    int device;         /* of an adapter that has several */
    char about[256];    /* the driver, once it is open */
    const char *(*open)(peer *);    /* NULL, or the reason why not; call peer_open */
    void (*load)(const peer *, const scene *);    /* geometry and shaders to where it wants them */
    void (*draw)(const peer *);    /* one whole frame, finished when it returns */
    void (*read)(const peer *, uint32_t *rgba, float *depth);    /* top row first */
    void (*unload)(const peer *);
};

peer *osmesa_peer(void);
peer *vulkan_peer(int device);
enum { VULKAN_LAVAPIPE, VULKAN_SWIFTSHADER };

/* NULL, or the reason why not.  Mesa's vectors are as wide as those of shade.h's level, and its
   shader cache is off: the cache would hand out the code of another width.  The heap keeps what is
   freed: else the pages are given back and faulted in again with every frame, and dense meshes take
   Mesa half as long again. */
static inline const char *peer_open(peer *p, int level, int threads)
{
    static const char *const bits[] = { "128", "128", "256" };
    char count[16];
    snprintf(count, sizeof count, "%d", threads > 1 ? threads : 0);    /* 0: the caller's own */
    setenv("GALLIUM_DRIVER", "llvmpipe", 1);
    setenv("LP_NUM_THREADS", count, 1);
    setenv("MESA_SHADER_CACHE_DISABLE", "true", 1);
    if (level >= 0 && level < 3) setenv("LP_NATIVE_VECTOR_WIDTH", bits[level], 1);
#ifdef __GLIBC__
    mallopt(M_TRIM_THRESHOLD, 1000000000);
    mallopt(M_TOP_PAD, 64 << 20);
    mallopt(M_MMAP_MAX, 0);
#endif
    return p->open ? p->open(p) : "not installed";
}

/* The block of constants of all shaders, std140. */
typedef struct peer_constants {
    shade_mat4 clip_from_object, world_from_object;
    shade_vec4 normal_matrix[3];
    shade_vec4 base, k_d, k_s, eye, paint;    /* base: k_e + k_a (I_a + sum of I_La); k_s.w: n */
    struct { shade_vec4 at, I_d, I_s, axis, fall; } lights[4];    /* axis.w: cutoff, fall.w: c */
} peer_constants;

static inline shade_vec4 peer_vec4(shade_vec3 v, float w) { return shade_v4(v.x, v.y, v.z, w); }

/* clip: from OpenGL's clip space to the peer's */
static inline peer_constants peer_constants_of(const scene *s, shade_mat4 clip)
{
    const shade_material *m = &s->material;
    shade_mat4 world = s->state.model;
    shade_vec3 ambient = s->state.lighting.ambient;
    shade_mat3 normals;
    peer_constants c = { 0 };
    if (world.col[3].w == 0) world = shade_mat4_identity();
    if (s->kind == SCENE_LIT || s->kind == SCENE_MAP) {
        shade_mat4 eye = shade_mat4_mul(s->state.view, world);
        clip = shade_mat4_mul(clip, shade_mat4_mul(s->state.projection, eye));
    }
    c.clip_from_object = clip;
    c.world_from_object = world;
    normals = shade_normal_matrix(world);
    for (int k = 0; k < 3; k++) c.normal_matrix[k] = peer_vec4(normals.col[k], 0);
    for (int j = 0; j < s->state.lighting.light_count; j++) {
        const shade_light *l = &s->lights[j];
        shade_vec3 axis = shade_neg(shade_normalize(l->spot_direction));
        ambient = shade_add(ambient, l->ambient);
        c.lights[j].at = l->position;
        c.lights[j].I_d = peer_vec4(l->diffuse, 0);
        c.lights[j].I_s = peer_vec4(l->specular, 0);
        c.lights[j].axis = peer_vec4(axis, l->spot_cos_cutoff);
        c.lights[j].fall = shade_v4(l->constant, l->linear, l->quadratic, l->spot_exponent);
    }
    c.base = peer_vec4(shade_add(m->emission, shade_mul(m->ambient, ambient)), 0);
    c.k_d = peer_vec4(m->diffuse, 0);
    c.k_s = peer_vec4(m->specular, m->shininess);
    c.eye = peer_vec4(s->eye, 0);
    c.paint = s->color;
    return c;
}

#define PEER_BLOCK \
    "struct light { vec4 at, I_d, I_s, axis, fall; };\n" \
    "layout(std140, binding = 0) uniform constants {\n" \
    "  mat4 clip_from_object, world_from_object;\n" \
    "  mat3 normal_matrix;\n" \
    "  vec4 base, k_d, k_s, eye, paint;\n" \
    "  light lights[LIGHTS];\n" \
    "};\n"
/* iteration three, one point light without attenuation */
#define PEER_POINT_LIGHT \
    "vec3 lit(vec3 P, vec3 N) {\n" \
    "  vec3 V = normalize(eye.xyz - P), sum = base.xyz;\n" \
    "  for (int j = 0; j < LIGHTS; j++) {\n" \
    "    vec3 L = normalize(lights[j].at.xyz - P), H = normalize(L + V);\n" \
    "    float nl = max(dot(N, L), 0.0);\n" \
    "    float gloss = nl > 0.0 ? pow(max(dot(N, H), 0.0), k_s.w) : 0.0;\n" \
    "    sum += nl * (k_d.xyz * lights[j].I_d.xyz) + gloss * (k_s.xyz * lights[j].I_s.xyz);\n" \
    "  }\n" \
    "  return sum;\n" \
    "}\n"
/* iteration four: cone and attenuation */
#define PEER_SPOT_LIGHT \
    "vec3 lit(vec3 P, vec3 N) {\n" \
    "  vec3 V = normalize(eye.xyz - P), sum = base.xyz;\n" \
    "  for (int j = 0; j < LIGHTS; j++) {\n" \
    "    vec3 l = lights[j].at.xyz - P;\n" \
    "    vec4 axis = lights[j].axis, fall = lights[j].fall;\n" \
    "    float rr = dot(l, l), ir = inversesqrt(rr), r = rr * ir;\n" \
    "    vec3 L = l * ir, H = normalize(L + V);\n" \
    "    float cone = dot(L, axis.xyz), nl = max(dot(N, L), 0.0);\n" \
    "    float att = 1.0 / (fall.x + fall.y * r + fall.z * rr);\n" \
    "    att = cone >= axis.w ? att * pow(cone, fall.w) : 0.0;\n" \
    "    float gloss = nl > 0.0 ? pow(max(dot(N, H), 0.0), k_s.w) : 0.0;\n" \
    "    sum += (att * nl) * (k_d.xyz * lights[j].I_d.xyz) +\n" \
    "           (att * gloss) * (k_s.xyz * lights[j].I_s.xyz);\n" \
    "  }\n" \
    "  return sum;\n" \
    "}\n"
#define PEER_PLACE \
    "layout(location = 0) in vec3 position;\n" \
    "layout(location = 1) in vec3 normal;\n" \
    "void main() {\n" \
    "  gl_Position = clip_from_object * vec4(position, 1);\n"
#define PEER_COLOR "layout(location = 0) out vec4 color;\n"

enum { PEER_TEXT = 4096 };
typedef struct peer_shaders { char vertex[PEER_TEXT], fragment[PEER_TEXT]; } peer_shaders;

static inline peer_shaders peer_shaders_of(const scene *s)
{
    static const char *const flat[2] = {
        "layout(location = 0) in vec3 position;\n"
        "void main() { gl_Position = clip_from_object * vec4(position, 1); }\n",
        PEER_COLOR "void main() { color = paint; }\n" };
    static const char *const map[2] = {
        "layout(location = 0) out vec2 uv;\n" PEER_PLACE "  uv = normal.xy;\n}\n",
        "layout(binding = 1) uniform sampler2D map;\n"
        "layout(location = 0) in vec2 uv;\n"
        PEER_COLOR "void main() { color = texture(map, uv); }\n" };
    static const char *const pixel[2] = {
        "layout(location = 0) out vec3 P;\n"
        "layout(location = 1) out vec3 N;\n" PEER_PLACE
        "  P = (world_from_object * vec4(position, 1)).xyz;\n"
        "  N = normalize(normal_matrix * normal);\n}\n",
        "layout(location = 0) in vec3 P;\n"
        "layout(location = 1) in vec3 N;\n"
        PEER_COLOR "void main() { color = vec4(lit(P, normalize(N)), 1); }\n" };
    static const char *const gouraud[2] = {
        "layout(location = 0) out vec3 shade;\n" PEER_PLACE
        "  vec3 P = (world_from_object * vec4(position, 1)).xyz;\n"
        "  shade = lit(P, normalize(normal_matrix * normal));\n}\n",
        "layout(location = 0) in vec3 shade;\n"
        PEER_COLOR "void main() { color = vec4(shade, 1); }\n" };
    const char *const *of = s->kind == SCENE_MAP ? map : s->kind != SCENE_LIT ? flat
                            : s->state.shading == SHADE_SHADING_PER_FRAGMENT ? pixel : gouraud;
    const char *light = s->lights[0].spot_cos_cutoff != 0 ? PEER_SPOT_LIGHT : PEER_POINT_LIGHT;
    const char *fragment = s->kind == SCENE_DEPTH ? "void main() { }\n" : of[1];
    const char *form = "#version 450\n#define LIGHTS %d\n" PEER_BLOCK "%s%s";
    int count = s->state.lighting.light_count ? s->state.lighting.light_count : 1;
    peer_shaders text;
    snprintf(text.vertex, PEER_TEXT, form, count, light, of[0]);
    snprintf(text.fragment, PEER_TEXT, form, count, light, fragment);
    return text;
}
#endif
