/* scenes.h - what the conformance test draws twice: geometry, state, and the equation in GLSL. */
#ifndef CONFORMANCE_SCENES_H
#define CONFORMANCE_SCENES_H

#include "examples/shared/twins.h"

enum {
    WIDTH = 400, HEIGHT = 300,
    MAX_VERTICES = 4096, MAX_INDICES = 16384, MAX_LIGHTS = 4, MAX_DRAWS = 3,
    MAP_SIDE = 32, MAP_LEVELS = 5                /* levels 1 .. 5 of a map of 32 x 32 */
};

typedef struct shape {
    float positions[3 * MAX_VERTICES], normals[3 * MAX_VERTICES];
    float texcoords[2 * MAX_VERTICES], colors[3 * MAX_VERTICES];
    uint32_t indices[MAX_INDICES];
    int vertex_count, index_count;
    int has_texcoords, has_colors;
} shape;

typedef struct draw {
    shape mesh;
    shade_material material;
    shade_draw_state state;    /* material, lights and map are linked by scene_link */
    float alpha;               /* not 0: paint of this alpha in the vertices' colours, unlit */
    int depth_only;            /* nothing is stored but depth */
} draw;

typedef struct scene {
    const char *name;
    const char *equation;      /* GLSL: vec3 lit(vec3 P, vec3 N, vec3 albedo) */
    const char *texel;         /* GLSL: vec4 texel(vec2 uv), times albedo and alpha; NULL: 1 */
    const char *stored;        /* GLSL: vec3 stored(vec3 rgb); NULL: rgb */
    draw draws[MAX_DRAWS];
    int draw_count, light_count;
    shade_light lights[MAX_LIGHTS];
    shade_vec3 eye;
    shade_vec4 background;
    float clear_depth;
    int srgb;
    shade_format format;       /* of shade.h's picture: RGBA8, BGRA8 or RGBA32F */
    shade_vec4 ball;           /* centre and radius of what hides lamps; radius 0: none */
    int twin;                  /* 1 + a number of twins.h: those shaders, not the equation */
    float seam;                /* texels are squares of this side on the floor y = 0; 0: none */
    int has_map;
    shade_texture map, levels[MAP_LEVELS];
    uint32_t texels[MAP_SIDE * MAP_SIDE], level_texels[MAP_SIDE * MAP_SIDE];
} scene;

int scene_count(void);
void scene_build(scene *s, int which);    /* everything, from zero */
twin_uniforms scene_twin(const scene *s);

/* The other renderer: NULL, or why there is none; then WIDTH x HEIGHT float RGBA, top row first. */
const char *gl_open(void);
void gl_draw(const scene *s, float *rgba);
const char *gl_name(void);

#endif
