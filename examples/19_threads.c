/* 19_threads.c - one picture by eight threads, without a lock: the library has no state, and each
   thread draws the whole scene into a band of rows of its own (clip_y, clip_height).  Before the
   bands are tinted they are compared with the picture that one thread draws: the same bits.
   Try 1000 threads: still the same bits, at thirty times the work: each looks at every triangle.

   cc -O2 -pthread -I. examples/19_threads.c -lm -o threads && ./threads       writes threads.ppm */
#define SHADE_IMPLEMENTATION
#include "shade.h"
#include "shapes.h"
#include "label.h"
#include <pthread.h>

enum { THREADS = 8 };
typedef struct job { shade_target target; const shade_mesh *mesh; } job;

static void *draw(void *data)
{
    const job *j = (const job *)data;
    const shade_light lamps[2] = {
        shade_directional_light(shade_v3(1, -1, -1), shade_v3(1, 0.97f, 0.9f)),
        shade_directional_light(shade_v3(-1, 0.5f, 0), shade_v3(0.15f, 0.25f, 0.5f))
    };
    const shade_vec3 white = { 1, 1, 1 };
    const shade_material candy = { { 0, 0, 0 }, white, white, { 0.4f, 0.4f, 0.4f }, 80 };
    shade_draw_state state = { .material = &candy,
                               .lighting = { lamps, 2, .ambient = { 0.05f, 0.05f, 0.06f } } };
    state.view = shade_mat4_look_at(shade_v3(0, -3, 12), shade_v3(0, -0.4f, 0), shade_v3(0, 1, 0));
    state.projection = shade_mat4_perspective(0.62f, 960 / 480.0f, 4, 20);
    shade_draw_mesh(&j->target, j->mesh, &state, NULL);
    return NULL;
}

int main(int argc, char **argv)
{
    owned_mesh knot = shape_knot(240);
    canvas one = canvas_new(960, 480, 2), c = canvas_new(960, 480, 2);
    job jobs[THREADS], whole = { one.target, &knot.view };
    pthread_t thread[THREADS];
    int differ = 0;
    char text[80];

    canvas_dark(&one.target), canvas_dark(&c.target);
    draw(&whole);
    for (int i = 0; i < THREADS; i++) {
        shade_target band = c.target;
        band.clip_y = band.height * i / THREADS, band.clip_width = band.width;
        band.clip_height = band.height * (i + 1) / THREADS - band.clip_y;
        jobs[i].target = band, jobs[i].mesh = whole.mesh;
        if (pthread_create(&thread[i], NULL, draw, &jobs[i])) return 1;
    }
    for (int i = 0; i < THREADS; i++) pthread_join(thread[i], NULL);
    for (int i = 0; i < c.target.width * c.target.height; i++) {
        shade_vec4 *p = (shade_vec4 *)c.target.color + i;
        int band = i / c.target.width * THREADS / c.target.height;
        shade_vec2 hue = mesh_turn(3 * (float)band / THREADS);
        differ += memcmp(p, (shade_vec4 *)one.target.color + i, sizeof *p) != 0;
        p->x *= 1 + 0.3f * hue.x, p->y *= 1 + 0.3f * hue.y, p->z *= 1 - 0.3f * hue.x;
    }
    sprintf(text, "eight threads, a band each: %d pixels differ from one thread's", differ);
    label_center(&c, 480, 466, 22, shade_v3(0.7f, 0.7f, 0.7f), text);
    mesh_free(&knot), free(one.target.color), free(one.target.depth);
    return canvas_save(&c, argc, argv, "threads.ppm") | (differ != 0);
}
