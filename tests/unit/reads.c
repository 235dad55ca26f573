/* reads.c - what is only read is never written: memory in pages that allow no more than the table
   of calls.h says. */

/* Memory in pages of its own, which can be made unreadable or read-only, and a function that tells
   whether a call touched such a page.  POSIX systems have it; PAGES says whether.  It stands before
   the headers of C, because -std=c99 hides mmap. */
#if defined(__unix__) || defined(__APPLE__)
#define PAGES 1
#ifndef _DEFAULT_SOURCE
#define _DEFAULT_SOURCE /* NOLINT: the system's own name, for mmap with -std=c99 */
#endif
#include <setjmp.h>
#include <signal.h>
#include <stdio.h>
#include <stdlib.h>
#include <sys/mman.h>
#include <unistd.h>

static sigjmp_buf page_fault;

static void page_handler(int number)
{
    (void)number;
    siglongjmp(page_fault, 1);
}

static size_t page_bytes(size_t bytes)
{
    const size_t page = (size_t)sysconf(_SC_PAGESIZE);
    return (bytes + page - 1) / page * page;
}

/* Pages that end with the last of so many bytes, a multiple of their alignment, behind a page
   without access. */
static inline void *page_take(size_t bytes)
{
    const size_t used = page_bytes(bytes), page = page_bytes(1);
    char *p = (char *)mmap(NULL, used + page, PROT_NONE, MAP_PRIVATE | MAP_ANONYMOUS, -1, 0);
    if (p == (char *)MAP_FAILED || mprotect(p, used, PROT_READ | PROT_WRITE)) {
        printf("out of memory\n");
        exit(2);
    }
    return p + used - bytes;
}

static inline void page_free(void *memory, size_t bytes)
{
    munmap((char *)memory + bytes - page_bytes(bytes), page_bytes(bytes) + page_bytes(1));
}

/* access: PROT_NONE, PROT_READ, or PROT_READ | PROT_WRITE */
static inline void page_allow(void *memory, size_t bytes, int access)
{
    if (mprotect((char *)memory + bytes - page_bytes(bytes), page_bytes(bytes), access)) {
        printf("mprotect failed\n");
        exit(2);
    }
}

/* Runs a function; returns 1 if it touched a page that did not allow it, and *result otherwise is
   what the function returned. */
static inline int page_faults(int (*run)(void *), void *argument, int *result)
{
    struct sigaction now, segv, bus;
    int faulted = 1;
    now.sa_handler = page_handler;
    now.sa_flags = SA_NODEFER;
    sigemptyset(&now.sa_mask);
    sigaction(SIGSEGV, &now, &segv);
    sigaction(SIGBUS, &now, &bus);
    if (!sigsetjmp(page_fault, 1)) {
        *result = run(argument);
        faulted = 0;
    }
    sigaction(SIGSEGV, &segv, NULL);
    sigaction(SIGBUS, &bus, NULL);
    return faulted;
}
#else
#define PAGES 0
#endif

#include "unit.h"
#include "calls.h"

#if PAGES
/* ------------------------------------------------------------------------ the table, row by row */

typedef struct protected_call { const call_world *w; const world_call *call; } protected_call;

static int reads_narrow;               /* does the mesh have indices16? then they are read */

static int reads_run(void *argument)
{
    const protected_call *p = (const protected_call *)argument;
    return p->call->run(p->w);
}

/* What a buffer allows while a row of the table runs. */
static int reads_access(const world_call *c, int buffer)
{
    const char *name = world_buffers[buffer].name;
    int reads = world_named(c->reads, name);
    if (world_named(c->writes, name)) return PROT_READ | PROT_WRITE;
    if (reads_narrow && !strncmp(name, "indices", 7))
        reads = !strcmp(name, "indices16") && world_named(c->reads, "indices");
    return reads ? PROT_READ : PROT_NONE;
}

/* Fills a world, runs a row with the access that it names, but for one buffer (-1: none); 1 if it
   faulted. */
static int reads_faults(const call_world *w, const world_call *c, int other, int access,
                        int *result)
{
    protected_call p = { w, c };
    int faulted;
    for (int k = 0; k < WORLD_BUFFERS; k++)
        page_allow(world_at(w, k), world_buffers[k].bytes, PROT_READ | PROT_WRITE);
    world_fill(w);
    if (reads_narrow) world_narrow(w);
    c->set(w);
    for (int k = 0; k < WORLD_BUFFERS; k++)
        page_allow(world_at(w, k), world_buffers[k].bytes,
                   k == other ? access : reads_access(c, k));
    faulted = page_faults(reads_run, &p, result);
    for (int k = 0; k < WORLD_BUFFERS; k++)
        page_allow(world_at(w, k), world_buffers[k].bytes, PROT_READ | PROT_WRITE);
    return faulted;
}

static void reads_check(const call_world *w, const world_call *c)
{
    const char *touched = "what no buffer alone cures";
    int result = 0;
    if (reads_faults(w, c, -1, 0, &result)) {
        for (int k = 0; k < WORLD_BUFFERS; k++) {
            if (!reads_faults(w, c, k, PROT_READ | PROT_WRITE, &result))
                touched = world_buffers[k].name;
        }
        CHECK_SAY(0, "%s (%s) touches %s", c->name, c->when, touched);
        return;
    }
    CHECK_SAY(!result, "%s (%s) returns %d", c->name, c->when, result);
    for (int k = 0; k < WORLD_BUFFERS; k++) {
        const int access = reads_access(c, k);
        if (access == PROT_READ)
            CHECK_SAY(reads_faults(w, c, k, PROT_NONE, &result), "%s (%s) never reads %s",
                      c->name, c->when, world_buffers[k].name);
        if (access == (PROT_READ | PROT_WRITE))
            CHECK_SAY(reads_faults(w, c, k, PROT_READ, &result), "%s (%s) never writes %s",
                      c->name, c->when, world_buffers[k].name);
    }
}
#endif

/* G1, G19 */
TEST(reads, calls_touch_what_their_row_of_the_table_says_and_nothing_else)
{
#if PAGES
    call_world w;
    if (!world_fits()) return;
    for (int k = 0; k < WORLD_BUFFERS; k++) world_put(&w, k, page_take(world_buffers[k].bytes));
    for (int i = 0; i < WORLD_CALLS; i++) {
        const char *reads = world_calls[i].reads;
        reads_narrow = 0;
        reads_check(&w, &world_calls[i]);
        reads_narrow = 1;
        if (world_named(reads, "mesh") && world_named(reads, "indices"))
            reads_check(&w, &world_calls[i]);
    }
    for (int k = 0; k < WORLD_BUFFERS; k++) page_free(world_at(&w, k), world_buffers[k].bytes);
#else
    test_skip("no mprotect");
#endif
}

#if PAGES
/* Does depth z pass this test against s? */
static int reads_passes(shade_compare test, float z, float s)
{
    switch (test) {
    case SHADE_COMPARE_LESS: return z < s;
    case SHADE_COMPARE_LESS_EQUAL: return z <= s;
    case SHADE_COMPARE_GREATER: return z > s;
    case SHADE_COMPARE_GREATER_EQUAL: return z >= s;
    case SHADE_COMPARE_EQUAL: return z == s;
    default: return 1;
    }
}

enum { READS_WIDTH = 300, READS_HEIGHT = 60, READS_CELLS = READS_WIDTH * READS_HEIGHT };

typedef struct reads_draw {
    shade_target target;
    shade_pipeline pipe;
    uint32_t color[READS_CELLS];
} reads_draw;

static int reads_draw_corners(void *argument)
{
    const reads_draw *d = (const reads_draw *)argument;
    return (int)shade_draw(&d->target, &d->pipe, NULL, 3, 3, NULL);
}

/* A triangle of depth 1/2, so many pixels wide, is drawn over depths 1/4, 1/2 and 3/4 that are
   read-only.  The pixels that a draw without depth covers change where their depth passes. */
static void reads_check_size(reads_draw *d, float *depth, float pixels)
{
    static uint32_t covered[READS_CELLS];
    const shade_vec4 clip[3] = { { -0.95f, -0.9f, 0, 1 },
                                 { -0.95f + 2 * pixels / READS_WIDTH, -0.8f, 0, 1 },
                                 { -0.94f, 0.9f, 0, 1 } };
    const scene s = { clip, NULL, 0, NULL, NULL };
    const shade_compare test = d->pipe.raster.depth_test;
    int faulted, result = -1, wrong = 0, shown = 0;
    d->pipe.uniforms = &s;
    d->target.depth = NULL;
    memset(d->color, 0, sizeof d->color);
    CHECK_INT(reads_draw_corners(d), SHADE_OK);
    memcpy(covered, d->color, sizeof covered);
    memset(d->color, 0, sizeof d->color);
    d->target.depth = depth;
    faulted = page_faults(reads_draw_corners, d, &result);
    CHECK_SAY(!faulted && result == SHADE_OK, "%g pixels, test %d, may_discard %d, %d columns: %s",
              (double)pixels, (int)test, d->pipe.may_discard, d->target.clip_width,
              faulted ? "depth was written" : "refused");
    for (int i = 0; i < READS_CELLS; i++) {
        wrong += d->color[i] != (reads_passes(test, 0.5f, depth[i]) ? covered[i] : 0);
        shown += d->color[i] != 0;
    }
    CHECK_INT(wrong, 0);
    CHECK(shown > 0);
}
#endif

/* G19 */
TEST(reads, depth_that_is_only_read_may_lie_in_read_only_memory)
{
#if PAGES
    static const float levels[3] = { 0.25f, 0.5f, 0.75f };
    static const float widths[3] = { 20, 100, 280 };    /* each is covered by other code */
    static reads_draw d;
    float *depth = (float *)page_take(READS_CELLS * sizeof *depth);
    for (int i = 0; i < READS_CELLS; i++) depth[i] = levels[rnd_int(0, 2)];
    page_allow(depth, READS_CELLS * sizeof *depth, PROT_READ);
    memset(&d, 0, sizeof d);
    d.target.width = READS_WIDTH;
    d.target.height = READS_HEIGHT;
    d.target.color = d.color;
    d.pipe.vertex = scene_vertex;
    d.pipe.fragment = scene_flat;
    d.pipe.raster.depth_read_only = 1;
    for (int i = 0; i < 6 * 3 * 2 * 2; i++) {
        d.pipe.raster.depth_test = (shade_compare)(i % 6);
        d.pipe.may_discard = i / 18 % 2;
        d.target.clip_width = i / 36 ? 25 : 0;    /* narrower than a tile */
        d.target.clip_height = i / 36 ? READS_HEIGHT : 0;
        reads_check_size(&d, depth, widths[i / 6 % 3]);
    }
    page_free(depth, READS_CELLS * sizeof *depth);
#else
    test_skip("no mprotect");
#endif
}

/* A whole file, or NULL. */
static char *reads_file(const char *path)
{
    FILE *file = fopen(path, "rb");
    char *text = NULL;
    long size;
    if (!file) return NULL;
    if (!fseek(file, 0, SEEK_END) && (size = ftell(file)) >= 0 && !fseek(file, 0, SEEK_SET)) {
        text = test_memory((size_t)size + 1);
        text[fread(text, 1, (size_t)size, file)] = 0;
    }
    fclose(file);
    return text;
}

static int reads_has_row(const char *name, size_t length)
{
    for (int i = 0; i < WORLD_CALLS; i++) {
        if (strlen(world_calls[i].name) == length && !memcmp(world_calls[i].name, name, length))
            return 1;
    }
    return 0;
}

/* Every function of shade.h that takes a pointer has a row, and every row stands in the README. */
TEST(reads, the_table_of_the_readme_has_every_call)
{
    char *readme = reads_file("tests/CALLS.md"), *header = reads_file("shade.h");
    char row[512];
    if (!readme || !header) {
        test_skip("not started where shade.h is");
        free(readme);
        free(header);
        return;
    }
    for (int i = 0; i < WORLD_CALLS; i++) {
        const world_call *c = &world_calls[i];
        snprintf(row, sizeof row, "\n| `%s` | %s | %s | %s |\n", c->name, c->when, c->reads,
                 c->writes);
        CHECK_SAY(strstr(readme, row), "tests/CALLS.md has no line%s", row);
    }
    for (char *p = header; (p = strstr(p, "\nSHADEDEF ")) != NULL;) {
        char *open = strchr(p, '('), *close = open ? strchr(open, ')') : NULL, *name = open;
        if (!close || close[1] != ';') break;    /* the bodies begin */
        while (name[-1] == '_' || isalnum((unsigned char)name[-1])) name--;
        if (memchr(open, '*', (size_t)(close - open)))
            CHECK_SAY(reads_has_row(name, (size_t)(open - name)), "calls.h has no row of %.*s",
                      (int)(open - name), name);
        p = close;
    }
    free(readme);
    free(header);
}

/* -------------------------------------------- every call gives the same with indices of 16 bits */

/* Runs a row of the table of calls with cleared outputs; copies what it wrote into kept, one buffer
   after the other, and returns the number of bytes. */
static size_t indices_outcome(const call_world *w, const world_call *c, int narrow,
                              unsigned char *kept)
{
    size_t n = 0;
    for (int k = 0; k < WORLD_BUFFERS; k++) memset(world_at(w, k), 0, world_buffers[k].bytes);
    world_fill(w);
    if (narrow) world_narrow(w);
    c->set(w);
    CHECK_SAY(!c->run(w), "%s (%s) fails", c->name, c->when);
    for (int k = 0; k < WORLD_BUFFERS; k++) {
        if (!world_named(c->writes, world_buffers[k].name)) continue;
        memcpy(kept + n, world_at(w, k), world_buffers[k].bytes);
        n += world_buffers[k].bytes;
    }
    return n;
}

TEST(reads, of_16_bits_give_every_call_what_those_of_32_give)
{
    call_world w;
    size_t all = 0;
    int rows = 0;
    if (!world_fits()) return;
    for (int k = 0; k < WORLD_BUFFERS; k++) {
        world_put(&w, k, test_memory(world_buffers[k].bytes));
        all += world_buffers[k].bytes;
    }
    unsigned char *wide = test_memory(all), *narrow = test_memory(all);
    for (int i = 0; i < WORLD_CALLS; i++) {
        const world_call *c = &world_calls[i];
        if (!world_named(c->reads, "mesh") || !world_named(c->reads, "indices")) continue;
        const size_t n = indices_outcome(&w, c, 0, wide);
        CHECK(indices_outcome(&w, c, 1, narrow) == n);
        CHECK_SAY(!memcmp(wide, narrow, n), "%s (%s) differs", c->name, c->when);
        rows++;
    }
    CHECK(rows > 10);
    for (int k = 0; k < WORLD_BUFFERS; k++) free(world_at(&w, k));
    free(wide);
    free(narrow);
}

TEST(reads, sorted_chunks_of_16_bits_are_drawn_by_their_indices_of_32)
{
    enum { SIDE = 24, CORNERS = 6 * SIDE * SIDE, CHUNKS = 64 };
    static float positions[3 * (SIDE + 1) * (SIDE + 1)];
    static uint16_t narrow[CORNERS];
    static uint32_t sorted[CORNERS];
    static shade_chunk chunks[CHUNKS];
    const shade_draw_state s = plain_state(NULL);
    canvas one = canvas_ready(80, 80, 0, SHADE_FORMAT_RGBA8, 1);
    canvas two = canvas_ready(80, 80, 0, SHADE_FORMAT_RGBA8, 1);
    shade_mesh m = plain_mesh(positions, (SIDE + 1) * (SIDE + 1));
    for (int i = 0; i < m.vertex_count; i++) {
        const float x = (float)(i % (SIDE + 1)) / SIDE, y = (float)(i / (SIDE + 1)) / SIDE;
        put3(positions + 3 * i, shade_v3(1.8f * x - 0.9f, 1.8f * y - 0.9f, x * y));
    }
    for (int q = 0, n = 0; q < SIDE * SIDE; q++) {
        const int a = q / SIDE * (SIDE + 1) + q % SIDE, b = a + SIDE + 1;
        const int corner[6] = { a, a + 1, b, a + 1, b + 1, b };
        for (int k = 0; k < 6; k++) narrow[n++] = (uint16_t)corner[k];
    }
    m.indices16 = narrow;
    m.index_count = CORNERS;
    CHECK_INT(canvas_draw_mesh(&one, &m, &s).drawn, CORNERS / 3);
    CHECK_INT(shade_mesh_chunks(&m, 20, chunks, CHUNKS, sorted), SHADE_OK);
    m.indices = sorted;
    m.indices16 = NULL;
    m.chunks = chunks;
    m.chunk_count = shade_chunk_count(CORNERS, 20);
    CHECK_INT(canvas_draw_mesh(&two, &m, &s).drawn, CORNERS / 3);
    CHECK(canvas_same(&one, &two));
    canvas_close(&one);
    canvas_close(&two);
}

TEST(reads, the_last_of_65536_vertices_is_reached)
{
    enum { VERTICES = 65536 };
    static float positions[3 * VERTICES];
    static const uint16_t last[3] = { 0, 1, 65535 };
    const shade_ray ray = { { 0, 0, 3 }, { 0, 0, -1 } };
    shade_vec3 low, high;
    shade_mesh m = plain_mesh(positions, VERTICES);
    memset(positions, 0, sizeof positions);
    put3(positions, shade_v3(-1, -1, 0));
    put3(positions + 3, shade_v3(1, -1, 0));
    put3(positions + 3 * 65535, shade_v3(0, 1, 0));
    m.indices16 = last;
    m.index_count = 3;
    CHECK_INT(shade_pick(&m, shade_mat4_identity(), ray, NULL, NULL), 0);
    CHECK_INT(shade_mesh_bounds(&m, &low, &high), SHADE_OK);
    CHECK(high.y == 1 && low.x == -1 && high.x == 1);
    m.vertex_count--;
    CHECK_INT(shade_pick(&m, shade_mat4_identity(), ray, NULL, NULL), -1);
    CHECK_INT(shade_mesh_bounds(&m, &low, &high), SHADE_ERROR_INDEX);
}

/* One bad index anywhere in a list, of 16 bits or of 32. */
TEST(reads, one_past_the_vertices_is_found_wherever_it_stands)
{
    enum { MOST = 66 };
    uint16_t narrow[MOST];
    uint32_t wide[MOST];
    const float positions[9] = { 0 };
    shade_vec3 low, high;
    shade_mesh m = plain_mesh(positions, 3);
    for (int n = 3; n <= MOST; n += 3) {
        for (int bad = -1; bad < n; bad++) {
            const shade_result want = bad < 0 ? SHADE_OK : SHADE_ERROR_INDEX;
            for (int i = 0; i < n; i++) {
                wide[i] = i == bad ? 3u + (uint32_t)rnd_int(0, 1) * 65533u : (uint32_t)i % 3;
                narrow[i] = (uint16_t)(i == bad ? 3 + rnd_int(0, 1) * 65532 : i % 3);
            }
            m.index_count = n;
            m.indices = wide;
            m.indices16 = NULL;
            CHECK_INT(shade_mesh_bounds(&m, &low, &high), want);
            m.indices = NULL;
            m.indices16 = narrow;
            CHECK_INT(shade_mesh_bounds(&m, &low, &high), want);
        }
    }
}

TEST(reads, of_both_widths_are_refused)
{
    static const uint16_t narrow[3] = { 0, 1, 2 };
    static const uint32_t wide[3] = { 0, 1, 2 };
    const shade_ray ray = { { 0, 0, 3 }, { 0, 0, -1 } };
    const shade_draw_state s = plain_state(NULL);
    shade_mesh m = plain_mesh(big_triangle, 3);
    canvas c = canvas_open(8, 8, 0, SHADE_FORMAT_RGBA8, 1);
    shade_vec3 low, high;
    const char *why;
    m.indices = wide;
    m.indices16 = narrow;
    m.index_count = 3;
    CHECK_INT(shade_draw_mesh(&c.target, &m, &s, NULL), SHADE_ERROR_MESH);
    CHECK_INT(shade_mesh_bounds(&m, &low, &high), SHADE_ERROR_MESH);
    CHECK_INT(shade_mesh_corner_normals_bytes(&m), 0);
    CHECK_INT(shade_pick(&m, shade_mat4_identity(), ray, NULL, NULL), -1);
    why = shade_explain(&c.target, &m, &s, NULL);
    CHECK_SAY(strstr(why, "mesh.indices16") != NULL, "\"%s\"", why);
    m.indices = NULL;
    m.index_count = -3;
    CHECK_INT(shade_mesh_bounds(&m, &low, &high), SHADE_ERROR_MESH);
    CHECK(canvas_untouched(&c));
    canvas_close(&c);
}
