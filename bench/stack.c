/* stack.c - bytes of stack that draws touch, measured: each runs in a thread whose stack was
   painted before. */
#include "clock.h"
#include <pthread.h>
#define SHADE_IMPLEMENTATION
#include "scenes.h"

enum { STACK_BYTES = 1 << 19, PAINT = 0xA7 };

typedef struct job {
    const scene *s;             /* NULL: nothing is drawn */
    shade_mesh mesh;
    shade_target target;
    uintptr_t entry;            /* the frame of the thread's first function */
} job;

static void *draw_job(void *user)
{
    job *j = (job *)user;
    unsigned char here = 0;
    j->entry = (uintptr_t)(void *)&here;
    if (j->s && shade_draw_mesh(&j->target, &j->mesh, &j->s->state, NULL) != SHADE_OK) exit(1);
    return NULL;
}

/* Runs the job in a thread of its own; a thread's end takes stack too, as the empty job shows. */
static long touched(job *j)
{
    static unsigned char *stack;
    pthread_t thread;
    pthread_attr_t attributes;
    size_t low = 0;
    if (!stack && posix_memalign((void **)(void *)&stack, 4096, STACK_BYTES)) exit(1);
    draw_job(j);    /* binds the functions of shared libraries, which takes stack once */
    if (j->s) shade_clear(&j->target, j->s->background, 1);    /* all pixels are shaded again */
    memset(stack, PAINT, STACK_BYTES);
    pthread_attr_init(&attributes);
    if (pthread_attr_setstack(&attributes, stack, STACK_BYTES) ||
        pthread_create(&thread, &attributes, draw_job, j)) exit(1);
    pthread_join(thread, NULL);
    pthread_attr_destroy(&attributes);
    while (stack[low] == PAINT) low++;
    return (long)(j->entry - (uintptr_t)(void *)(stack + low));
}

int main(void)
{
    static uint32_t texel[4 * 4], half[4 + 1];
    shade_texture map, level[2];
    scene s[5];
    long most = 0, bytes, least;
    job j;
    s[0] = scene_teapot("teapot, per pixel", SHADE_SHADING_PER_FRAGMENT, SHADE_CULL_NONE);
    s[1] = scene_teapot("teapot, per vertex", SHADE_SHADING_PER_VERTEX, SHADE_CULL_NONE);
    s[2] = scene_teapot("teapot, per face", SHADE_SHADING_PER_FACE, SHADE_CULL_NONE);
    s[3] = scene_teapot("from inside, clipped", SHADE_SHADING_PER_FRAGMENT, SHADE_CULL_NONE);
    scene_camera(&s[3], shade_v3(0.3f, 1, 0.2f), shade_v3(1, 1.2f, 0), 1.5f);
    s[4] = scene_teapot("with a trilinear map", SHADE_SHADING_PER_FRAGMENT, SHADE_CULL_NONE);
    memset(&map, 0, sizeof map);
    map.pixels = texel;
    map.width = map.height = 4;
    map.filter = SHADE_FILTER_TRILINEAR;
    if (shade_build_mipmaps(&map, level, half, sizeof half)) exit(1);
    printf("| SHADE_LANES %d, SHADE_MAX_VARYINGS %d | bytes of stack |\n|---|---|\n", SHADE_LANES,
           SHADE_MAX_VARYINGS);
    memset(&j, 0, sizeof j);
    least = touched(&j);
    for (int i = 0; i < 5; i++) {
        scene_link(&s[i]);
        j.s = &s[i];
        j.target = scene_target(&s[i]);
        j.mesh = scene_mesh(&s[i]);
        if (i == 4) {    /* normals serve as texture coordinates */
            s[i].state.diffuse_map = &map;
            j.mesh.texcoords = j.mesh.normals;
            j.mesh.texcoord_stride = 12;
        }
        shade_clear(&j.target, s[i].background, 1);
        bytes = touched(&j);
        if (bytes > most) most = bytes;
        printf("| %s | %ld |\n", s[i].name, bytes);
        free(j.target.color);
        free(j.target.depth);
        scene_free(&s[i]);
    }
    if (most <= least) printf("| (a thread alone touches %ld) | |\n", least);
    printf("| most | %ld |\n", most);
    return 0;
}
