/* sharing.c - threads that share what they only read, for ThreadSanitizer: each row of the table of
   calls.h runs in two threads at once, in two worlds that share all that it only reads; and a pass
   that only reads depth runs beside one that draws elsewhere in the same buffers.

   clang -std=c99 -O1 -g -fsanitize=thread -I. tests/scripts/sharing.c -lm -pthread -o sharing */
#define _DEFAULT_SOURCE                /* barriers under -std=c99 */
#include <pthread.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#define SHADE_IMPLEMENTATION
#include "shade.h"
#include "../unit/calls.h"

typedef struct job {
    call_world world;
    int (*run)(const call_world *);
    pthread_barrier_t *start;
    int result;
} job;

static void *run_job(void *argument)
{
    job *j = (job *)argument;
    pthread_barrier_wait(j->start);
    j->result = j->run(&j->world);
    return NULL;
}

static call_world new_world(void)
{
    call_world w;
    for (int k = 0; k < WORLD_BUFFERS; k++) {
        void *p = calloc(1, world_buffers[k].bytes);
        if (!p) exit(2);
        world_put(&w, k, p);
    }
    return w;
}

/* Runs both at once; returns 1 if both did what they promise. */
static int at_once(job jobs[2])
{
    pthread_barrier_t start;
    pthread_t thread[2];
    pthread_barrier_init(&start, NULL, 2);
    for (int k = 0; k < 2; k++) {
        jobs[k].start = &start;
        if (pthread_create(&thread[k], NULL, run_job, &jobs[k])) exit(2);
    }
    for (int k = 0; k < 2; k++) pthread_join(thread[k], NULL);
    pthread_barrier_destroy(&start);
    return !jobs[0].result && !jobs[1].result;
}

/* Two threads in two worlds; those buffers are shared that the row only reads. */
static int shared_row(const world_call *c, const call_world own[2])
{
    job jobs[2];
    call_world second = own[1];
    for (int k = 0; k < WORLD_BUFFERS; k++)
        if (world_named(c->reads, world_buffers[k].name))
            world_put(&second, k, world_at(&own[0], k));
    for (int k = 0; k < 2; k++) jobs[k].run = c->run;
    jobs[0].world = own[0];
    jobs[1].world = second;
    world_fill(&second);
    world_fill(&own[0]);               /* last: what both share points into the first world */
    c->set(&own[0]);
    /* a target names what is written, so that the second thread has one of its own */
    jobs[1].world.target = own[1].target;
    *own[1].target = *own[0].target;
    if (own[0].target->color) own[1].target->color = own[1].color;
    if (strstr(c->writes, "depth")) own[1].target->depth = own[1].depth;
    return at_once(jobs);
}

static int draw_any(const call_world *w)
{
    return (int)shade_draw_mesh(w->target, w->mesh, w->state, NULL);
}

/* One depth buffer for two passes that only read it, into pictures of their own; or, in halves, for
   one that reads the upper half and one that draws the lower one, into the same picture. */
static int one_depth(const call_world own[2], shade_compare test, int in_halves)
{
    job jobs[2];
    for (int k = 1; k >= 0; k--) {
        shade_target *t = own[k].target;
        world_fill(&own[k]);
        t->depth = own[0].depth;
        own[k].state->raster.depth_read_only = k == 0 || !in_halves;
        own[k].state->raster.depth_test = test;
        jobs[k].world = own[k];
        jobs[k].run = draw_any;
        if (!in_halves) continue;
        t->color = own[0].color;
        t->clip_y = k * CALLS_SIZE / 2;
        t->clip_width = CALLS_SIZE;
        t->clip_height = CALLS_SIZE / 2;
    }
    return at_once(jobs);
}

int main(void)
{
    const call_world own[2] = { new_world(), new_world() };
    int passed = 0, failed = 0;
    for (int i = 0; i < WORLD_CALLS; i++) {
        const int good = shared_row(&world_calls[i], own);
        if (!good) printf("%s (%s) fails\n", world_calls[i].name, world_calls[i].when);
        passed += good;
        failed += !good;
    }
    for (int i = 0; i < 2 * (SHADE_COMPARE_ALWAYS + 1); i++) {
        const int good = one_depth(own, (shade_compare)(i / 2), i % 2);
        passed += good;
        failed += !good;
    }
    printf("%d passed, %d failed\n", passed, failed);
    return failed != 0;
}
