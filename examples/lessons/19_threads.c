/* 19_threads.c - one picture by as many threads as there are cores.  Threads share nothing but the
   number of the next band of rows (bands.h), because the library has no state.  mesh_chunks sorts
   the triangles and finds the boxes around runs of them, so that each band skips those it does not
   see.  Before lines and colours mark the bands, they are compared with the picture drawn at
   once: they have the same bits.
   Try it without mesh_chunks: each band looks at every triangle and takes three times as long.

   cc -O2 -pthread -I. examples/lessons/19_threads.c -lm -o threads && ./threads */
#define SHADE_IMPLEMENTATION
#include "shade.h"
#include "../shared/bands.h"
#include "../shared/shapes.h"
#include "../shared/label.h"

enum { BANDS = 32 };
typedef struct job { shade_target target; const shade_mesh *mesh; } job;

static void draw(const shade_target *target, const shade_mesh *mesh)
{
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
    shade_draw_mesh(target, mesh, &state, NULL);
}

static void draw_band(void *data, int k)
{
    const job *j = (const job *)data;
    shade_target band = j->target;
    band.clip_y = band.height * k / BANDS;
    band.clip_width = band.width;
    band.clip_height = band.height * (k + 1) / BANDS - band.clip_y;
    draw(&band, j->mesh);
}

int main(int argc, char **argv)
{
    owned_mesh knot = shape_knot(240);
    canvas one = canvas_new(960, 480, 2), c = canvas_new(960, 480, 2);
    job work = { c.target, &knot.view };
    int differ = 0;
    char text[80];

    canvas_dark(&one.target);
    canvas_dark(&c.target);
    draw(&one.target, &knot.view);
    mesh_chunks(&knot);
    bands_run(0, BANDS, draw_band, &work);
    for (int i = 0; i < c.target.width * c.target.height; i++) {
        shade_vec4 *p = (shade_vec4 *)c.target.color + i;
        int band = i / c.target.width * BANDS / c.target.height;
        int x = i % c.target.width, y = i / c.target.width * BANDS % c.target.height / BANDS;
        shade_vec2 hue = shade_scale2(mesh_turn((float)band / BANDS), 0.4f);
        differ += memcmp(p, (shade_vec4 *)one.target.color + i, sizeof *p) != 0;
        if (x < 60 || x >= c.target.width - 60)
            *p = shade_v4(0.5f + hue.x, 0.5f + hue.y, 0.5f - hue.x, 1);
        if (y < 2) *p = shade_scale4(*p, 0.25f);
    }
    sprintf(text, "32 bands by all cores: %d pixels differ from one draw's", differ);
    label_center(&c, 480, 466, 26, shade_v3(0.7f, 0.7f, 0.7f), text);
    mesh_free(&knot);
    free(one.target.color);
    free(one.target.depth);
    return canvas_save(&c, argc, argv, "threads.ppm") | (differ != 0);
}
