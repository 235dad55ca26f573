/* race.c - two threads draw a scene while a third changes all that can be changed of it: each
   picture shows a state that the scene had, and ThreadSanitizer finds nothing
   (tests/scripts/threads.sh).

   Three balls always stand side by side in one colour, and the lamp has the brightness of the
   colour: a picture with two of them, or with two colours, is torn.  Prints how many were drawn.
   */
#define _DEFAULT_SOURCE
#define SHADE_IMPLEMENTATION
#include "examples/kit/scene/renderer.h"
#include <stdio.h>

enum { SIZE = 24, CHANGES = 400 };

typedef struct race {
    renderer_scene *scene;
    renderer_picture picture;
    int bad, drawn, ended;
    thread_lock lock; /* of ended */
} race;

static const double still[16] = { 1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1 };

static renderer_object ball_of(int mesh, int texture, float x, float bright)
{
    renderer_object o = { .turn = { 1, 0, 0, 0, 1, 0, 0, 0, 1 }, .rgba = { bright, 0, 0, 1 } };
    o.kind = mesh < 0 ? RENDERER_SPHERE : RENDERER_MESH;
    o.mesh = mesh < 0 ? 0 : mesh;
    o.texture = texture;
    o.place[0] = (double)x;
    o.size[0] = o.size[1] = o.size[2] = 0.3f;
    o.repeat[0] = o.repeat[1] = 1;
    o.emission = 1;
    return o;
}

static int is_over(race *r)
{
    thread_lock_take(&r->lock);
    const int ended = r->ended;
    thread_lock_give(&r->lock);
    return ended;
}

/* Non-zero: what is red has one red, and all three objects are there. */
static int is_whole(const uint8_t *color, const int32_t *ids)
{
    int red = -1, seen = 0;
    for (int i = 0; i < SIZE * SIZE; i++) {
        if (ids[2 * i] < 0) continue;
        if (red >= 0 && color[3 * i] != red) return 0;
        red = color[3 * i];
        seen |= 1 << (i % SIZE * 3 / SIZE);
    }
    return seen == 7;
}

static void draw(void *data)
{
    race *r = (race *)data;
    renderer *own = renderer_open();
    uint8_t color[3 * SIZE * SIZE];
    int32_t ids[2 * SIZE * SIZE];
    float depth[SIZE * SIZE];
    renderer_picture p = r->picture;
    int drawn = 0, bad = !own;
    p.color = color;
    p.ids = ids;
    p.depth = depth;
    while (!bad && !is_over(r)) {
        bad = renderer_draw(&own, 1, r->scene, &p, 1, NULL) || !is_whole(color, ids);
        drawn++;
    }
    thread_lock_take(&r->lock);
    r->drawn += drawn;
    r->bad += bad;
    thread_lock_give(&r->lock);
    renderer_close(own);
}

static int set_mesh(renderer_scene *s, float tip)
{
    const float p[] = { -1, -1, 0, 1, -1, 0, 0, 1, 0, 0, 0, tip };
    static const uint32_t faces[] = { 0, 1, 3, 1, 2, 3, 2, 0, 3 };
    const shade_mesh m = { .positions = p, .vertex_count = 4, .indices = faces, .index_count = 9 };
    return renderer_set_mesh(s, 0, &m, 0, NULL);
}

static int set_texture(renderer_scene *s)
{
    static const uint8_t white[16] = { 255, 255, 255, 255, 255, 255, 255, 255,
                                       255, 255, 255, 255, 255, 255, 255, 255 };
    const renderer_image image = { .rgba = white, .width = 2, .height = 2, .faces = 1 };
    return renderer_set_texture(s, 0, &image);
}

static int set_lamp(renderer_scene *s, float x)
{
    const shade_light lamp = { .position = { x, 1, 1, 0 }, .specular = { 1, 1, 1 } };
    const double place[4] = { (double)x, 1, 1, 0 };
    renderer_set_lights(s, &lamp, place, 1, shade_v3(0, 0, 0), x > 0);
    return 1;
}

/* All three balls in another colour, as one change of several steps; and one that comes and goes
   */
static int change(renderer_scene *s, int step)
{
    const renderer_around behind = { .background = { 1, 1, 1, (float)(step % 2) } };
    const float bright = (float)(step % 7 + 1) / 8;
    renderer_object o = ball_of(step % 3 ? -1 : 0, step % 2, 9, bright);
    const int extra = renderer_add(s, &o, 1);
    int good = extra >= 3 && set_mesh(s, (float)(step % 5)) && set_texture(s) && renderer_hold(s);
    for (int k = 0; k < 3; k++) {
        o = ball_of(k == 1 ? 0 : -1, 1, (float)(k - 1), bright);
        good = good && renderer_put_object(s, k, &o, 1) == 1;
    }
    renderer_done(s);
    good = good && set_lamp(s, (float)(step % 2));
    renderer_set_behind(s, &behind);
    good = good && renderer_pose(s, &extra, still, 1) == -1;
    good = good && renderer_put_object(s, extra, NULL, 0) == 1;
    return good && renderer_pose(s, &extra, still, 1) == -2;
}

int main(void)
{
    race r = { .scene = renderer_scene_open() };
    renderer_picture *p = &r.picture;
    thread draws[2];
    int good = r.scene && set_mesh(r.scene, 1) && set_texture(r.scene), running = 0;
    *p = (renderer_picture){ .width = SIZE, .height = SIZE, .samples = 1, .channels = 3 };
    p->near_z = 0.1f;
    p->far_z = 100;
    p->tolerance = 0.25f;
    p->parallel = 1;
    p->projection = shade_mat4_ortho(-1.5f, 1.5f, -1.5f, 1.5f, 0.1f, 100);
    memcpy(p->view, still, sizeof p->view);
    p->view[14] = -5;
    for (int k = 0; k < 3 && good; k++) {
        const renderer_object o = ball_of(k == 1 ? 0 : -1, 0, (float)(k - 1), 1);
        good = renderer_add(r.scene, &o, 1) == k;
    }
    thread_lock_open(&r.lock);
    while (good && running < 2 && thread_start(&draws[running], draw, &r)) running++;
    for (int i = 0; i < CHANGES && good; i++) good = change(r.scene, i);
    thread_lock_take(&r.lock);
    r.ended = 1;
    thread_lock_give(&r.lock);
    while (running > 0) thread_join(&draws[--running]);
    printf("race: %d pictures, %d torn, %s\n", r.drawn, r.bad,
           good ? "all changes done" : "a change failed");
    thread_lock_close(&r.lock);
    renderer_scene_close(r.scene);
    return r.bad || !good || !r.drawn;
}
