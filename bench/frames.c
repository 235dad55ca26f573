/* frames.c - the scenes of scenes.h as a shared object, so that two revisions of shade.h can be
   timed in one process: compiled once with each, loaded by against.c. */
#include "level.h"
#define SHADE_STATIC
#define SHADE_IMPLEMENTATION
#include "scenes.h"

int frames_count(void);
const char *frames_name(int i);
void frames_open(int i, int level);
void frames_draw(void);
unsigned long long frames_hash(void);
void frames_close(void);

static scene frames_scenes[SCENE_COUNT], *frames_now;
static shade_target frames_target;

int frames_count(void)
{
    if (!frames_scenes[0].name) scenes_build(frames_scenes, NULL);
    return SCENE_COUNT;
}

const char *frames_name(int i) { return frames_scenes[i].name; }

void frames_open(int i, int level)
{
    bench_level = level;
    frames_now = &frames_scenes[i];
    frames_target = scene_target(frames_now);
}

void frames_draw(void) { scene_draw(frames_now, &frames_target); }

void frames_close(void)
{
    free(frames_target.color);
    free(frames_target.depth);
}

/* of colour and depth */
unsigned long long frames_hash(void)
{
    unsigned long long hash = 14695981039346656037u;
    const void *memory[2] = { frames_target.color, frames_target.depth };
    size_t words = (size_t)frames_now->width * (size_t)frames_now->height;
    for (int k = 0; k < 2; k++) {
        const uint32_t *word = (const uint32_t *)memory[k];
        for (size_t i = 0; word && i < words; i++) hash = (hash ^ word[i]) * 1099511628211u;
    }
    return hash;
}
