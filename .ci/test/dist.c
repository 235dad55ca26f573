/* dist.c - draws a lit triangle by shade.h, or with LOADED by the functions of a library that is
   named, and prints a hash of the pixels. */
#include "shade.h"
#include <stdio.h>
#if defined(LOADED) && defined(_WIN32)
#include <windows.h>
static void *find(const char *library, const char *name)
{
    HMODULE module = LoadLibraryA(library);
    return module ? (void *)(uintptr_t)GetProcAddress(module, name) : NULL;
}
#elif defined(LOADED)
#include <dlfcn.h>
static void *find(const char *library, const char *name)
{
    void *module = dlopen(library, RTLD_NOW);
    if (!module) fprintf(stderr, "%s\n", dlerror());
    return module ? dlsym(module, name) : NULL;
}
#endif

typedef shade_result clear_target(const shade_target *, shade_vec4, float);
typedef shade_result draw_mesh(const shade_target *, const shade_mesh *, const shade_draw_state *,
                               shade_stats *);
enum { SIDE = 128 };

int main(int argc, char **argv)
{
    static uint8_t pixels[4 * SIDE * SIDE];
    static float depth[SIDE * SIDE];
    static const float corners[] = { -0.9f, -0.8f, 0.1f, 0.9f, -0.7f, -0.3f, 0.1f, 0.9f, 0.4f };
    static const uint32_t indices[] = { 0, 1, 2 };
    const shade_light lamp = { { 1, 2, 3, 1 }, { 0, 0, 0 }, { 0.9f, 0.8f, 0.7f }, { 1, 1, 1 },
                               0.5f, 0.1f, 0.05f, { 0, 0, 0 }, 0, 0 };
    const shade_material gold = { { 0, 0, 0 }, { 0.1f, 0.1f, 0 }, { 0.8f, 0.6f, 0.2f },
                                  { 0.6f, 0.6f, 0.4f }, 30 };
    const shade_mat4 one = { { { 1, 0, 0, 0 }, { 0, 1, 0, 0 }, { 0, 0, 1, 0 }, { 0, 0, 0, 1 } } };
    shade_target target = { .color = pixels, .depth = depth, .width = SIDE, .height = SIDE };
    shade_draw_state state = { .model = one, .view = one, .projection = one, .material = &gold };
    const shade_mesh mesh = { .positions = corners, .vertex_count = 3, .indices = indices,
                              .index_count = 3 };
    uint32_t hash = 2166136261u;
#ifdef LOADED
    clear_target *clear = argc > 1 ? (clear_target *)(uintptr_t)find(argv[1], "shade_clear") : NULL;
    draw_mesh *draw = clear ? (draw_mesh *)(uintptr_t)find(argv[1], "shade_draw_mesh") : NULL;
    if (!draw) return 1;
#else
    clear_target *clear = shade_clear;
    draw_mesh *draw = shade_draw_mesh;
    (void)argc;
    (void)argv;
#endif
    state.lighting.lights = &lamp;
    state.lighting.light_count = 1;
    if (clear(&target, (shade_vec4){ 0.1f, 0.2f, 0.3f, 1 }, 1)) return 2;
    if (draw(&target, &mesh, &state, NULL)) return 3;
    for (int i = 0; i < 4 * SIDE * SIDE; i++) hash = (hash ^ pixels[i]) * 16777619u;
    printf("%08x\n", (unsigned)hash);
    return 0;
}
