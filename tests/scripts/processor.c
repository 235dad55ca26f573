/* processor.c - the build of each loop that a program takes is the one that its processor runs:
   prints its level, 0 to 3.  Compile it with -finstrument-functions, of shade__push_* at least;
   with -DHAS_CPU_MODEL the compiler's library is asked as well. */
#define SHADE_IMPLEMENTATION
#include "shade.h"

static int entered[4];
#define OUTSIDE __attribute__((no_instrument_function))
OUTSIDE void __cyg_profile_func_enter(void *function, void *caller);
OUTSIDE void __cyg_profile_func_exit(void *function, void *caller);

/* Every function that begins is seen here. */
void __cyg_profile_func_enter(void *function, void *caller)
{
    (void)caller;
    entered[0] += (uintptr_t)function == (uintptr_t)&shade__push_any;
    entered[1] += (uintptr_t)function == (uintptr_t)&shade__push_sse41;
    entered[2] += (uintptr_t)function == (uintptr_t)&shade__push_avx2;
    entered[3] += (uintptr_t)function == (uintptr_t)&shade__push_avx512;
}

void __cyg_profile_func_exit(void *function, void *caller) { (void)function, (void)caller; }

static void draw(void)
{
    static const float positions[9] = { -1, -1, 0, 1, -1, 0, 0, 1, 0 };
    static unsigned char pixels[4 * 16 * 16];
    shade_target target;
    shade_mesh mesh;
    shade_draw_state state;
    SHADE__ZERO(target);
    SHADE__ZERO(state);
    SHADE__ZERO(mesh);
    target.width = target.height = 16;
    target.color = pixels;
    mesh.positions = positions;
    mesh.vertex_count = 3;
    if (shade_draw_mesh(&target, &mesh, &state, NULL) != SHADE_OK) printf("nothing is drawn\n");
}

static int faults;
static void hold(int condition, const char *what)
{
    if (!condition) {
        printf("%s\n", what);
        faults++;
    }
}

/* What systems and processors may say, by Intel's manual: bit 19 of leaf 1's ECX is SSE4.1; bits 5,
   16, 17, 30 and 31 of leaf 7's EBX are AVX2, F, DQ, BW and VL; bits 1, 2 of XCR0 are SSE and AVX,
   5, 6 and 7 the parts of AVX-512. */
#ifdef SHADE__ASK_PROCESSOR
static void levels(void)
{
    static const unsigned parts[5] = { 5, 16, 17, 30, 31 }, states[5] = { 1, 2, 5, 6, 7 };
    const uint32_t any = 0xFFF7FFFFu, sse41 = (uint32_t)1 << 19;
    uint32_t all = 0, saved = 0;
    for (int k = 0; k < 5; k++) all |= (uint32_t)1 << parts[k];
    for (int k = 0; k < 5; k++) saved |= (uint32_t)1 << states[k];
    hold(shade__build_for(sse41, all, saved) == 3, "AVX-512");
    hold(shade__build_for(0xFFFFFFFFu, 0xFFFFFFFFu, 0xFFFFFFFFu) == 3, "everything");
    hold(shade__build_for(sse41, 0x20, 7) == 2, "AVX2");
    for (int k = 0; k < 2; k++) {
        const uint32_t basic = k ? sse41 : any;
        hold(shade__build_for(basic, 0xFFFFFFFFu, 0) == k, "a system that saves nothing");
        hold(shade__build_for(basic, 0, 0xFFFFFFFFu) == k, "a processor without AVX2");
    }
    for (int k = 0; k < 5; k++) {
        hold(shade__build_for(sse41, all & ~((uint32_t)1 << parts[k]), saved) == 1 + (k > 0),
             "a part lacks");
        hold(shade__build_for(sse41, all, saved & ~((uint32_t)1 << states[k])) == 1 + (k > 1),
             "unsaved");
    }
}
#endif

int main(void)
{
    int level = SHADE__LEVEL;
#ifdef SHADE__ASK_PROCESSOR
    levels();
    hold(level == shade__ask_processor(), "two answers");
#endif
#ifdef HAS_CPU_MODEL
    hold(level == (__builtin_cpu_supports("avx512vl") && __builtin_cpu_supports("avx512bw") &&
                   __builtin_cpu_supports("avx512dq") ? 3 : __builtin_cpu_supports("avx2") ? 2 :
                   __builtin_cpu_supports("sse4.1") ? 1 : 0),
         "the compiler's library sees another processor");
#endif
    draw();
    for (int k = 0; k < 4; k++) hold(!entered[k] == (k != level), "another build runs");
    printf("level %d\n", level);
    return faults != 0;
}
