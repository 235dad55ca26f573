/* modes.c - other modes of the processor.  Bits are promised for rounding to nearest with
   denormals; in any other mode nothing is read or written outside the caller's memory.  And what is
   finite and in range raises no invalid operation, no division by zero and no overflow, so that
   programs which trap them may draw. */
#include "unit.h"
#include "scene.h"
#include <fenv.h>
#include <signal.h>

#if defined(__SSE__) && (defined(__GNUC__) || defined(__clang__))
#define MODES_FLUSH 1    /* denormals count as 0 and become 0 */
static void modes_flush(int on)
{
    const unsigned both = 0x8040;
    __builtin_ia32_ldmxcsr(on ? __builtin_ia32_stmxcsr() | both : __builtin_ia32_stmxcsr() & ~both);
}
#else
#define MODES_FLUSH 0
static void modes_flush(int on) { (void)on; }
#endif

enum { MODES_NEAREST, MODES_UP, MODES_DOWN, MODES_ZERO, MODES_DENORMALS, MODES_COUNT };
/* 0 where there is no such mode. */
static int modes_set(int mode)
{
    modes_flush(mode == MODES_DENORMALS);
    switch (mode) {
#ifdef FE_UPWARD
    case MODES_UP: return fesetround(FE_UPWARD) == 0;
#endif
#ifdef FE_DOWNWARD
    case MODES_DOWN: return fesetround(FE_DOWNWARD) == 0;
#endif
#ifdef FE_TOWARDZERO
    case MODES_ZERO: return fesetround(FE_TOWARDZERO) == 0;
#endif
    case MODES_DENORMALS: return MODES_FLUSH;
    default: return mode == MODES_NEAREST && fesetround(FE_TONEAREST) == 0;
    }
}

/* Texels are their index; a texel beyond the row would be 1e30. */
static void modes_check_texels(int mode, int width, float u)
{
    static float texel[64 * 4 + 64];
    shade_texture t = { 0 };
    for (int i = 0; i < 64 * 4 + 64; i++)
        texel[i] = i / 4 < width ? (float)(i / 4) : 1e30f;
    t.pixels = texel;
    t.width = width;
    t.height = 1;
    t.format = SHADE_FORMAT_RGBA32F;
    for (int k = 0; k < 6; k++) {
        t.wrap_u = (shade_wrap)(k % 3);
        t.wrap_v = SHADE_WRAP_CLAMP;
        t.filter = k < 3 ? SHADE_FILTER_NEAREST : SHADE_FILTER_BILINEAR;
        modes_set(mode);
        float got = shade_sample(&t, u, u, 0).x;
        modes_set(MODES_NEAREST);
        CHECK_SAY(got >= -1e-3f && got <= (float)width, "mode %d, width %d, u %a, wrap %d: %g",
                  mode, width, (double)u, k % 3, (double)got);
    }
}

/* G16 */
TEST(modes, no_rounding_reads_a_texel_beyond_the_row)
{
    static const float u[] = { 1,       0,      -0.0f, 0.99999994f, 1.0000001f,
                               -1e-30f, -1e-8f, 2,     -1,          0.5f };
    for (int mode = 0; mode < MODES_COUNT; mode++) {
        if (!modes_set(mode)) continue;
        modes_set(MODES_NEAREST);
        for (int width = 1; width <= 64; width++) {
            for (int i = 0; i < (int)(sizeof u / sizeof u[0]); i++)
                modes_check_texels(mode, width, u[i]);
            modes_check_texels(mode, width, rnd_float(-3, 3));
        }
    }
}

/* G16 */
TEST(modes, no_mode_writes_outside_a_picture)    /* canvas_close looks at the bytes around it */
{
    scene_build();
    for (int mode = 1; mode < MODES_COUNT; mode++) {
        for (int k = 0; k < SCENE_COUNT; k++) {
            canvas c = scene_open(&golden_scenes[k]);
            if (modes_set(mode)) scene_draw(&c, &golden_scenes[k]);
            modes_set(MODES_NEAREST);
            canvas_close(&c);
        }
    }
}

#if defined(FE_INVALID) && defined(FE_DIVBYZERO) && defined(FE_OVERFLOW)
enum { MODES_TRAPS = FE_INVALID | FE_DIVBYZERO | FE_OVERFLOW };
#else
enum { MODES_TRAPS = 0 };
#endif
/* What raised something; the flags are clear afterwards. */
static void modes_check_flags(const char *what)
{
    CHECK_SAY(!fetestexcept(MODES_TRAPS), "%s raises %x", what,
              (unsigned)fetestexcept(MODES_TRAPS));
    feclearexcept(FE_ALL_EXCEPT);
}

/* Leaves signalling NaNs on the stack: arithmetic with what was never written raises FE_INVALID. */
static void modes_soil_stack(void)
{
    static volatile uint32_t seen;
    volatile uint32_t words[1 << 16];
    for (int i = 0; i < 1 << 16; i++) words[i] = 0x7FA00000u;
    seen = words[rnd_int(0, 65535)];
    (void)seen;
}

static int modes_swallow(void *user, const void *bytes, size_t count)
{
    (void)user, (void)bytes, (void)count;
    return 0;
}

/* Pictures of each format, and the shape of a finite mesh, between open and close */
static void modes_tools(void (*open)(const char *what), void (*close)(const char *what))
{
    static unsigned char bytes[16 * 64], small[16 * 64];    /* zero; floats too */
    static uint32_t memory[4 * 64];
    static test_mesh m;
    int count;
    random_ball(&m, 0, 0);
    const int corners = m.mesh.index_count;
    const size_t room = shade_mesh_corner_normals_bytes(&m.mesh);
    shade_vec3 *n = (shade_vec3 *)malloc(sizeof *n * (size_t)corners), low, high;
    shade_edge *edges = (shade_edge *)malloc(sizeof *edges * (size_t)corners);
    shade_chunk *chunks = (shade_chunk *)malloc(sizeof *chunks * (size_t)corners);
    uint32_t *indices = (uint32_t *)malloc(sizeof *indices * (size_t)corners);
    void *scratch = malloc(room);
    for (int k = 0; k < 12; k++) {
        const shade_format format = (shade_format)(k / 2);
        shade_texture map = { .pixels = bytes, .width = 7, .height = 8, .format = format,
                              .srgb = k & 1 }, levels[4];
        shade_target from = { .width = 8, .height = 8, .color = bytes, .format = format,
                              .srgb = k & 1 }, to = from;
        to.width = to.height = 4;
        to.color = small;
        open("mipmaps");
        CHECK_INT(shade_build_mipmaps(&map, levels, memory, sizeof memory), SHADE_OK);
        close("mipmaps");
        if (format == SHADE_FORMAT_A8) continue;
        open("resolve, PPM and PNG");
        CHECK_INT(shade_resolve(&to, &from, 2), SHADE_OK);
        CHECK_INT(shade_encode_ppm(modes_swallow, NULL, &to), SHADE_OK);
        CHECK_INT(shade_encode_png(modes_swallow, NULL, &to), SHADE_OK);
        close("resolve, PPM and PNG");
    }
    open("shape");
    CHECK_INT(shade_mesh_normals(&m.mesh, n), SHADE_OK);
    CHECK_INT(shade_mesh_corner_normals(&m.mesh, 0.5f, n, scratch, room), SHADE_OK);
    CHECK_INT(shade_mesh_edges(&m.mesh, edges, corners, &count), SHADE_OK);
    CHECK_INT(shade_mesh_chunks(&m.mesh, 8, chunks, corners, indices), SHADE_OK);
    CHECK_INT(shade_mesh_bounds(&m.mesh, &low, &high), SHADE_OK);
    shade_mat4_fit(shade_mat4_perspective(1, 1, 0.1f, 100), low, high, shade_v3(1, 2, 3),
                   shade_v3(0, 1, 0));
    close("shape");
    free(n), free(edges), free(chunks), free(indices), free(scratch);
}

/* Draws what is finite and in range, between open and close; then says what it was. */
static void modes_ordinary(void (*open)(const char *what), void (*close)(const char *what))
{
    const float flat[9] = { -1, -1, 0, 0, 0, 0, 1, 1, 0 };
    const shade_vec3 beside_the_eye[2] = { { 1, 0, 0 }, { 2, 1, 0 } };    /* w = 0 all along */
    const shade_line_state line = { .clip_from_points = shade_mat4_perspective(1, 1, 0.1f, 10) };
    const shade_vec3 a = shade_v3(0, 0, 0), b = shade_v3(1, 0, 0), c = shade_v3(0, 1, 0);
    const shade_ray along = { shade_v3(-1, 0, 0), shade_v3(1, 0, 0) };
    shade_draw_state s = plain_state(NULL);
    shade_mesh m = plain_mesh(flat, 3);
    scene_build();
    for (int k = 0; k < SCENE_COUNT; k++) {
        if (golden_scenes[k].wild) continue;
        canvas picture = scene_open(&golden_scenes[k]);
        open(golden_scenes[k].name);
        scene_draw(&picture, &golden_scenes[k]);
        close(golden_scenes[k].name);
        open("a triangle without area");
        shade_draw_mesh(&picture.target, &m, &s, NULL);
        close("a triangle without area");
        shade_clear(&picture.target, shade_v4(0, 0, 0, 1), 1);    /* alone, it is a mistake */
        open("what a triangle without area explains");
        CHECK(*shade_explain(&picture.target, &m, &s, NULL));
        close("what a triangle without area explains");
        open("a line in the plane of the eye");
        shade_draw_lines(&picture.target, beside_the_eye, 2, &line, NULL);
        close("a line in the plane of the eye");
        canvas_close(&picture);
    }
    modes_tools(open, close);
    open("a ray in the triangle's plane");
    CHECK_INT(shade_intersect(along, a, b, c, NULL, NULL), 0);
    close("a ray in the triangle's plane");
    open("a ray on a line");
    CHECK_INT(shade_pick(&m, shade_mat4_identity(), along, NULL, NULL), -1);
    close("a ray on a line");
}

static void modes_clear_flags(const char *what)
{
    (void)what;
    modes_soil_stack();
    feclearexcept(FE_ALL_EXCEPT);
}

/* G17 */
TEST(modes, what_is_finite_and_in_range_raises_no_flag)
{
    modes_ordinary(modes_clear_flags, modes_check_flags);
}

#if defined(__GLIBC__) && defined(FE_INVALID) && defined(FE_DIVBYZERO) && defined(FE_OVERFLOW)
#include <unistd.h>
/* <fenv.h> declares them where there is _GNU_SOURCE. */
int feenableexcept(int);
int fedisableexcept(int);

static const char *modes_drawing;
/* There is no way back into the arithmetic that trapped. */
static void modes_trapped(int signal_number)
{
    (void)signal_number;
    if (write(1, modes_drawing, strlen(modes_drawing)) < 0 || write(1, " traps\n", 7) < 0) _Exit(2);
    _Exit(1);
}

static void modes_arm(const char *what)
{
    modes_drawing = what;
    modes_soil_stack();
    feclearexcept(FE_ALL_EXCEPT);
    feenableexcept(MODES_TRAPS);
}

static void modes_disarm(const char *what)
{
    fedisableexcept(MODES_TRAPS);
    modes_check_flags(what);
}

/* G17 */
TEST(modes, programs_that_trap_may_draw)
{
    if (feenableexcept(MODES_TRAPS) < 0) {
        test_skip("this processor has no traps");
        return;
    }
    fedisableexcept(MODES_TRAPS);
    void (*before)(int) = signal(SIGFPE, modes_trapped);
    modes_ordinary(modes_arm, modes_disarm);
    signal(SIGFPE, before);
}
#endif
