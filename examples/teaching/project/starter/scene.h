/* scene.h - what your renderer is given, and the picture that it fills.  Do not change it: the
   judge has its own. */
#ifndef SCENE_H
#define SCENE_H
#include "vectors.h"

enum {
    WIDTH = 64,
    HEIGHT = 48,
    VERTICES = 96,
    TRIANGLES = 160,
    LAMPS = 2,
    MAP = 16,
    SHADOW_MAP = 64
};
enum { FLAT, GOURAUD, PHONG };            /* scene.shading */
enum { SHADOW, BUMP, CLIP, SILHOUETTES }; /* scene.option */

typedef struct vertex {
    shade_vec3 position; /* in the space of the model */
    shade_vec3 normal;   /* there, unit */
    shade_vec3 color;
    shade_vec2 uv;
    shade_vec3 tangent; /* there: where u grows */
} vertex;

/* All of it is floats, so that a scene can be sent as numbers; counts are whole. */
typedef struct scene {
    float checkpoint;                 /* 1 to 6: what the picture shows */
    float option;                     /* in checkpoint 6: which of the four */
    float shading;                    /* from checkpoint 4 on */
    float iteration;                  /* 0 to 4 */
    float mipmaps;                    /* checkpoint 5: 1 to choose a level, 0 for level 0 */
    float lamps, vertices, triangles; /* how many there are of each */
    float fovy, near_z, far_z;        /* camera: whole vertical angle in radians, distances */
    float bias;                       /* of the shadow map */
    shade_vec3 eye, at, up;           /* of the camera */
    shade_vec3 ambient;               /* I_a */
    shade_mat4 model;                 /* from the model's space to the world */
    shade_mat4 lamp_camera;           /* from the world to the clip space of lamp 0 */
    shade_material material;
    shade_light lamp[LAMPS];
    shade_vec3 map[MAP * MAP]; /* row after row, v = 0 at the top */
    vertex vertex[VERTICES];
    float triangle[TRIANGLES][3]; /* indices; from outside counter-clockwise */
} scene;

typedef struct picture {
    shade_vec3 color[HEIGHT][WIDTH]; /* row 0 at the top; filled with the background */
} picture;

/* What a picture is filled with before render is called. */
VECTORS shade_vec3 background(void) { return shade_v3(0.1f, 0.1f, 0.15f); }

/* renderer.c has it: draws the scene. */
void render(const scene *s, picture *p);
#endif
