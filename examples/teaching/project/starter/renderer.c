/* renderer.c - your renderer.  It compiles, and draws the vertices where they are without a camera:
   make it right, checkpoint by checkpoint.  Hand in this file. */
#include "scene.h"

/* ---- checkpoint 1: vertices and matrices --------------------------------------------------- */

/* The camera's matrix V, from the world to the camera's space. */
static shade_mat4 look_at(shade_vec3 eye, shade_vec3 at, shade_vec3 up)
{
    (void)eye;
    (void)at;
    (void)up;
    return shade_mat4_identity();
}

/* The projection P, from the camera's space to clip space. */
static shade_mat4 perspective(float fovy, float aspect, float near_z, float far_z)
{
    (void)fovy;
    (void)aspect;
    (void)near_z;
    (void)far_z;
    return shade_mat4_identity();
}

/* A pixel, where it is in the picture. */
static void plot(picture *p, int i, int j, shade_vec3 color)
{
    if (i >= 0 && j >= 0 && i < WIDTH && j < HEIGHT) p->color[j][i] = color;
}

static void draw_vertices(const scene *s, picture *p)
{
    const shade_mat4 V = look_at(s->eye, s->at, s->up);
    const shade_mat4 P = perspective(s->fovy, (float)WIDTH / HEIGHT, s->near_z, s->far_z);
    const shade_mat4 PV = shade_mat4_mul(P, V);
    for (int k = 0; k < (int)s->vertices; k++) {
        const vertex *v = &s->vertex[k];
        const shade_vec4 clip =
            shade_mat4_transform(PV, shade_v4(v->position.x, v->position.y, v->position.z, 1));
        /* from clip space to the window: yours to write */
        const float X = 16 * clip.x + 32, Y = 16 * clip.y + 24;
        plot(p, (int)floorf(X), (int)floorf(Y), v->color);
    }
}

/* ---- checkpoints 2 to 6 start here --------------------------------------------------------- */

void render(const scene *s, picture *p) { draw_vertices(s, p); }
