/* scene.h - the built-in scenes of scene.c. */
#ifndef SCENE_H
#define SCENE_H

enum { SCENE_WIDTH = 160, SCENE_HEIGHT = 120, SCENE_SIDE = 9, SCENE_COUNT = 27 };

typedef struct golden_scene { /* fields that are left out: 0, the default */
    const char *name;
    shade_model model;
    shade_shading shading;
    shade_format format;
    shade_blend blend;
    int srgb, dither, lights;
    unsigned flags;
    int inside; /* the camera stands among the shapes: near plane and guard band cut */
    int reversed;
    int map; /* kinds of scene_map */
    int lines, affine;
    int wild; /* lights, colours and texture coordinates that overflow, are infinite or NaN */
    float transparency, alpha_cutoff;
} golden_scene;

extern const golden_scene golden_scenes[SCENE_COUNT];

void scene_build(void); /* the mesh of all scenes; comes first */
canvas scene_open(const golden_scene *g);
void scene_draw(canvas *c, const golden_scene *g);
int scene_print(const char *folder);

#endif
