/* 19_threads.c - one picture by eight threads.  Left: a knot drawn by one thread.  Right: by eight,
   each in its own band of rows, without a lock: the library has no state.  Before the bands are
   tinted they are compared with the left picture; the program fails where a bit differs.

   cc -O2 -pthread -I. examples/19_threads.c -lm -o threads && ./threads       writes threads.ppm */
#define SHADE_IMPLEMENTATION
#include "shade.h"
#include "mesh.h"
#include "label.h"
#include <pthread.h>

enum { WIDTH = 480, HEIGHT = 440, SAMPLES = 3, THREADS = 8 };
typedef struct job { pthread_t thread; shade_target band; const shade_mesh *mesh; } job;

/* A tube that winds thrice around a torus while going twice along it */
static owned_mesh knot(int cells)
{
    owned_mesh m = mesh_plane(1, cells);
    m.view.colors = m.colors = (float *)example_memory((size_t)m.view.vertex_count, 12);
    for (int i = 0; i < m.view.vertex_count; i++) {
        int u = i % (cells + 1) % cells, v = i / (cells + 1) % cells, pale = v * 8 / cells % 2;
        float t = (float)u / (float)cells, s = (float)v / (float)cells;
        shade_vec2 a = mesh_turn(2 * t), b = mesh_turn(3 * t), c = mesh_turn(s + 6 * t);
        float r = 2.1f + b.x;
        shade_vec3 up = shade_v3(b.x * a.x, b.x * a.y, b.y);
        shade_vec3 T = shade_v3(-3 * b.y * a.x - 2 * r * a.y, 2 * r * a.x - 3 * b.y * a.y, 3 * b.x);
        shade_vec3 N = shade_madd(shade_scale(up, c.x), c.y, shade_cross(shade_normalize(T), up));
        mesh_put(&m, i, shade_madd(shade_v3(r * a.x, r * a.y, b.y), 0.55f, N), N, 0, 0);
        m.colors[3 * i] = pale ? 0.82f : 0.62f, m.colors[3 * i + 1] = pale ? 0.72f : 0.02f;
        m.colors[3 * i + 2] = pale ? 0.58f : 0.03f;
    }
    return m;
}

static void *work(void *data)
{
    const job *j = (const job *)data;
    shade_light lamps[2];
    shade_material candy = { { 0, 0, 0 }, { 1, 1, 1 }, { 1, 1, 1 }, { 0.4f, 0.4f, 0.4f }, 80 };
    shade_draw_state state = { .material = &candy, .lighting = { .lights = lamps, .light_count = 2,
                               .ambient = { 0.05f, 0.05f, 0.06f } } };
    lamps[0] = shade_directional_light(shade_v3(1, -1, -1), shade_v3(1, 0.97f, 0.9f));
    lamps[1] = shade_directional_light(shade_v3(-1, 0.5f, 0), shade_v3(0.15f, 0.25f, 0.5f));
    state.view = shade_mat4_look_at(shade_v3(0, -3, 12), shade_v3(0, -0.45f, 0), shade_v3(0, 1, 0));
    state.projection = shade_mat4_perspective(0.66f, (float)WIDTH / HEIGHT, 4, 20);
    shade_draw_mesh(&j->band, j->mesh, &state, NULL);
    return NULL;
}

int main(int argc, char **argv)
{
    owned_mesh m = knot(240);
    canvas c = canvas_new(2 * WIDTH, HEIGHT, SAMPLES);
    job jobs[THREADS], alone = { .mesh = &m.view, .band = canvas_panel(&c, 0, 0, WIDTH, HEIGHT) };
    int different = 0, row = 4 * SAMPLES * WIDTH;    /* floats */

    canvas_gradient(&c.target, shade_v3(0.045f, 0.05f, 0.06f), shade_v3(0.012f, 0.013f, 0.016f));
    work(&alone);
    for (int i = 0; i < THREADS; i++) {
        jobs[i] = alone, jobs[i].band = canvas_panel(&c, WIDTH, 0, WIDTH, HEIGHT);
        shade_target *band = &jobs[i].band;
        band->clip_y = band->height * i / THREADS, band->clip_width = band->width;
        band->clip_height = band->height * (i + 1) / THREADS - band->clip_y;
        if (pthread_create(&jobs[i].thread, NULL, work, &jobs[i])) return 1;
    }
    for (int i = 0; i < THREADS; i++) pthread_join(jobs[i].thread, NULL);
    for (int y = 0; y < SAMPLES * HEIGHT; y++) {
        float *left = (float *)alone.band.color + 2 * y * row, *right = left + row;
        shade_vec2 hue = mesh_turn(3 * (float)(y * THREADS / (SAMPLES * HEIGHT)) / THREADS);
        float tint[4] = { 1 + 0.3f * hue.x, 1 + 0.3f * hue.y, 1 - 0.3f * hue.x, 1 };
        different |= memcmp(left, right, sizeof(float[4]) * SAMPLES * WIDTH) != 0;
        for (int i = 0; i < row; i++) right[i] *= tint[i % 4];
    }
    label_center(&c, 240, 427, 22, shade_v3(0.7f, 0.7f, 0.7f), "one thread");
    label_center(&c, 720, 427, 22, shade_v3(0.7f, 0.7f, 0.7f), "eight threads");
    mesh_free(&m);
    return canvas_save(&c, argc, argv, "threads.ppm") | different;
}
