/* stack.c - bytes of stack that calls touch, measured: each runs in a thread whose stack was
   painted before.  The calls are those that take most: every kind of draw, and the tools. */
#include "clock.h"
#include <pthread.h>
#define SHADE_IMPLEMENTATION
#include "scenes.h"

enum { STACK_BYTES = 1 << 19, PAINT = 0xA7, CHUNKS = 64 };

typedef struct job job;
struct job {
    shade_result (*run)(const job *);    /* NULL: nothing is done */
    shade_mesh mesh;
    shade_draw_state state;
    shade_target target, half;           /* half: of half the width and height */
    uintptr_t entry;                     /* the frame of the thread's first function */
};

static shade_result run_mesh(const job *j)
{
    return shade_draw_mesh(&j->target, &j->mesh, &j->state, NULL);
}

static shade_result run_lines(const job *j)
{
    shade_line_state lines;
    memset(&lines, 0, sizeof lines);
    lines.clip_from_points = shade_mat4_mul(j->state.projection, j->state.view);
    lines.width = 3;
    lines.raster = j->state.raster;
    return shade_draw_lines(&j->target, (const shade_vec3 *)(const void *)j->mesh.positions,
                            j->mesh.vertex_count & ~1, &lines, NULL);
}

static shade_result run_explain(const job *j)
{
    shade_explain(&j->target, &j->mesh, &j->state, NULL);
    return SHADE_OK;
}

static shade_result run_pick(const job *j)
{
    shade_ray ray = shade_pixel_ray(j->state.view, j->state.projection, j->target.width,
                                    j->target.height, 640, 360);
    shade_pick(&j->mesh, j->state.model, ray, NULL, NULL);
    return SHADE_OK;
}

static shade_result run_clear(const job *j)
{
    return shade_clear(&j->target, shade_v4(0.1f, 0.1f, 0.1f, 1), 1);
}

static shade_result run_resolve(const job *j) { return shade_resolve(&j->half, &j->target, 2); }

static shade_result run_mipmaps(const job *j)
{
    static shade_texture level[16];
    shade_texture map = { .pixels = j->target.color, .width = j->half.width,
                          .height = j->half.height, .srgb = 1 };
    return shade_build_mipmaps(&map, level, j->half.color,
                               (size_t)map.width * (size_t)map.height * 4);
}

static int swallow(void *user, const void *bytes, size_t size)
{
    (void)user;
    (void)bytes;
    (void)size;
    return 0;
}

static shade_result run_png(const job *j) { return shade_encode_png(swallow, NULL, &j->target); }

static void *run_job(void *user)
{
    job *j = (job *)user;
    unsigned char here = 0;
    j->entry = (uintptr_t)(void *)&here;
    if (j->run && j->run(j) != SHADE_OK) exit(1);
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
    run_job(j);    /* binds the functions of shared libraries, which takes stack once */
    if (j->run) run_clear(j);    /* all pixels are shaded again */
    memset(stack, PAINT, STACK_BYTES);
    pthread_attr_init(&attributes);
    if (pthread_attr_setstack(&attributes, stack, STACK_BYTES) ||
        pthread_create(&thread, &attributes, run_job, j)) exit(1);
    pthread_join(thread, NULL);
    pthread_attr_destroy(&attributes);
    while (stack[low] == PAINT) low++;
    return (long)(j->entry - (uintptr_t)(void *)(stack + low));
}

/* Prints what a call takes, and keeps the most. */
static void row(const char *name, shade_result (*run)(const job *), job *j, long *most)
{
    long bytes;
    j->run = run;
    bytes = touched(j);
    printf("| %s | %ld |\n", name, bytes);
    if (bytes > *most) *most = bytes;
}

/* Every draw that has paths of its own, with what the job's state has already. */
static void draws(const char *where, job *j, long *most)
{
    static const char *const shading[] = { "lit per pixel", "per vertex", "per face" };
    const shade_texture *map = j->state.diffuse_map;
    char name[99];
    for (int with_map = 0; with_map < 2; with_map++)
        for (int k = 0; k < 3; k++)
            for (int blend = 0; blend < 2; blend++) {
                j->state.diffuse_map = with_map ? map : NULL;
                j->state.shading = (shade_shading)k;
                j->state.raster.blend = blend ? SHADE_BLEND_OVER : SHADE_BLEND_REPLACE;
                snprintf(name, sizeof name, "%s%s%s%s", where, shading[k],
                         with_map ? ", trilinear sRGB map" : "", blend ? ", blended" : "");
                row(name, run_mesh, j, most);
            }
    j->state.diffuse_map = map;
    j->state.shading = SHADE_SHADING_PER_FRAGMENT;
}

int main(void)
{
    static uint32_t texel[4 * 4], smaller[4 + 1], sorted[3 * 6320];
    static shade_chunk chunks[CHUNKS];
    shade_texture map, level[2];
    scene s = scene_teapot("", SHADE_SHADING_PER_FRAGMENT, SHADE_CULL_NONE);
    long most = 0, least, tools = 0;
    memset(&map, 0, sizeof map);
    map.pixels = texel;
    map.width = map.height = 4;
    map.filter = SHADE_FILTER_TRILINEAR;
    map.srgb = 1;
    if (shade_build_mipmaps(&map, level, smaller, sizeof smaller)) exit(1);

    printf("| SHADE_LANES %d, SHADE_MAX_VARYINGS %d | bytes of stack |\n|---|---|\n", SHADE_LANES,
           SHADE_MAX_VARYINGS);
    job j = { 0 };
    least = touched(&j);
    scene_link(&s);
    s.srgb = 1;
    j.target = scene_target(&s);
    j.half = j.target;
    j.half.width /= 2;
    j.half.height /= 2;
    j.half.depth = NULL;
    j.half.color = scene_memory((size_t)j.half.width * (size_t)j.half.height, 4);
    j.mesh = scene_mesh(&s);
    j.mesh.texcoords = j.mesh.normals;    /* normals serve as texture coordinates and colours */
    j.mesh.texcoord_stride = 12;
    if (SHADE_MAX_VARYINGS >= 11) j.mesh.colors = j.mesh.normals;
    j.state = s.state;
    j.state.diffuse_map = &map;
    draws("", &j, &most);

    /* near cuts the wall */
    scene_camera(&s, shade_v3(1.1f, 1, 0.2f), shade_v3(0, 1.2f, 2), 1.5f);
    j.state.view = s.state.view;
    j.state.projection = s.state.projection;
    if (shade_mesh_chunks(&j.mesh, 0, chunks, CHUNKS, sorted)) exit(1);
    j.mesh.indices = sorted;
    j.mesh.chunks = chunks;
    j.mesh.chunk_count = shade_chunk_count(j.mesh.index_count, 0);
    draws("clipped, chunks, ", &j, &most);
    row("lines, clipped", run_lines, &j, &most);
    if (most <= least) printf("| (a thread alone touches %ld) | |\n", least);
    printf("| most of a draw | %ld |\n", most);

    row("`shade_explain`, which draws", run_explain, &j, &tools);
    row("`shade_pick`", run_pick, &j, &tools);
    row("`shade_clear`", run_clear, &j, &tools);
    row("`shade_resolve`", run_resolve, &j, &tools);
    row("`shade_build_mipmaps`", run_mipmaps, &j, &tools);
    row("`shade_encode_png`", run_png, &j, &tools);
    free(j.target.color);
    free(j.target.depth);
    free(j.half.color);
    scene_free(&s);
    return 0;
}
