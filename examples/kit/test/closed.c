/* closed.c - casters of shadows that are closed are drawn without their backs, and every map of the
   studio is the same but for roundings; what is not closed keeps its backs. */
#define _DEFAULT_SOURCE
#define SHADE_IMPLEMENTATION
#include "shade.h"
#include "examples/kit/scene/portrait.h"

enum { AROUND = 60, ACROSS = 40, RING = AROUND * ACROSS };
enum { CUBE = 8, VERTICES = RING + CUBE, CORNERS = 6 * RING + 36, PIXELS = 128 };
static int passed, failed;

static void check(const char *what, int good)
{
    if (good)
        passed++;
    else {
        printf("FAIL closed: %s\n", what);
        failed++;
    }
}

static void put(owned_mesh *m, int i, double x, double y, double z)
{
    m->positions[3 * i] = (float)x;
    m->positions[3 * i + 1] = (float)y;
    m->positions[3 * i + 2] = (float)z;
}

/* A ring with waves, and a cube above its hole: two pieces of one part, each vertex there once */
static model build(void)
{
    static const uint32_t face[6][4] = { { 0, 2, 3, 1 }, { 4, 5, 7, 6 }, { 0, 1, 5, 4 },
                                         { 2, 6, 7, 3 }, { 0, 4, 6, 2 }, { 1, 3, 7, 5 } };
    model m = { .mesh = mesh_new(VERTICES, CORNERS), .part_count = 1 };
    uint32_t *to = m.mesh.indices;
    for (int i = 0; i < RING; i++) {
        const double a = 6.283185307179586 * (i / ACROSS) / AROUND;
        const double b = 6.283185307179586 * (i % ACROSS) / ACROSS, r = 0.2 + 0.05 * sin(7 * a);
        put(&m.mesh, i, (0.6 + r * cos(b)) * cos(a), r * sin(b), (0.6 + r * cos(b)) * -sin(a));
    }
    for (int i = 0; i < CUBE; i++)
        put(&m.mesh, RING + i, 0.2 * (i & 1) - 0.1, 0.3 + 0.2 * (i >> 1 & 1), 0.2 * (i >> 2) - 0.1);
    for (int i = 0; i < RING; i++) {
        const uint32_t a = (uint32_t)i, b = (uint32_t)((i + ACROSS) % RING);
        const uint32_t up = (uint32_t)(i % ACROSS < ACROSS - 1 ? 1 : 1 - ACROSS);
        const uint32_t quad[6] = { a, b, b + up, a, b + up, a + up };
        for (int k = 0; k < 6; k++) *to++ = quad[k];
    }
    for (int i = 0; i < 6; i++)
        for (int k = 0; k < 6; k++) *to++ = RING + face[i][k < 3 ? k : k == 3 ? 0 : k - 2];
    m.part = (model_part *)calloc(2, sizeof *m.part);
    if (!m.part) exit(1);
    m.part->count = CORNERS;
    return m;
}

/* Texels of all maps that without backs differ by more than a hundredth of a texel's width */
static size_t differing(const model *m)
{
    static const studio none;
    studio with = none, without = none;
    size_t count = 0;
    if (studio_open_for(&with, m, PIXELS, 0.3f, 1, NULL, NULL)) exit(1);
    without.closed = 1;
    if (studio_open_for(&without, m, PIXELS, 0.3f, 1, NULL, NULL)) exit(1);
    for (int i = 0; i < with.sky + with.key; i++)
        for (int k = 0; k < with.map[i].size * with.map[i].size; k++)
            count += fabsf(with.map[i].depth[k] - without.map[i].depth[k]) > 1e-4f;
    studio_close(&with);
    studio_close(&without);
    return count;
}

static void turn_over(uint32_t *corner, int count)
{
    for (int k = 0; k < count; k += 3) {
        const uint32_t first = corner[k];
        corner[k] = corner[k + 1];
        corner[k + 1] = first;
    }
}

int main(void)
{
    static const shade_vec3 corner[4] = { { -1, 0, -1 }, { 1, 0, -1 }, { 1, 0, 1 }, { -1, 0, 1 } };
    static const uint32_t sheet[12] = { 0, 1, 2, 0, 2, 3, 2, 1, 0, 3, 2, 0 };
    model m = build(), thin;
    model_surface surface[2] = { { .alpha_cutoff = 0 }, { .transparency = 0.5f } };
    check("a ring and a cube are closed", studio_is_closed(&m));
    check("without backs each map is the same", differing(&m) == 0);
    check("coarser ones are made", !studio_thin(&thin, &m, PIXELS));
    check("a coarser ring is closed too", studio_is_closed(&thin));
    check("and its maps are the same", differing(&thin) == 0);
    studio_thin_free(&thin);

    m.part->count -= 3;
    check("a triangle is missing", !studio_is_closed(&m));
    check("which its maps show", differing(&m) > 0);
    m.part->count += 3;
    turn_over(m.mesh.indices + 300, 3);
    check("a triangle is turned over", !studio_is_closed(&m));
    turn_over(m.mesh.indices + 300, 3);
    turn_over(m.mesh.indices + 6 * RING, 36);
    check("the cube is inside out", !studio_is_closed(&m));
    check("which its maps show as well", differing(&m) > 0);
    turn_over(m.mesh.indices, CORNERS);
    check("the ring is", !studio_is_closed(&m));
    turn_over(m.mesh.indices, 6 * RING);

    m.surface = surface;
    m.surface_count = 2;
    m.part[m.part_count++] = (model_part){ 300, 30, 1, 0, 0 };
    check("a part that light goes through throws no shadow", studio_is_closed(&m));
    surface[1].transparency = 0;
    check("else it is part of the shape", !studio_is_closed(&m));
    m.part_count = 1;
    surface[0].alpha_cutoff = 0.5f;
    check("holes of alpha show backs", !studio_is_closed(&m));
    surface[0].alpha_cutoff = 0;

    for (int i = 0; i < 4; i++) put(&m.mesh, i, corner[i].x, 0.2 * corner[i].x, corner[i].z);
    memcpy(m.mesh.indices, sheet, sizeof sheet);
    m.part->count = 6;
    check("a sheet is open", !studio_is_closed(&m));
    m.part->count = 12;
    check("one with two faces is not", studio_is_closed(&m));
    check("and shows the same from both sides", differing(&m) == 0);
    m.surface_count = 0;
    m.surface = NULL;
    model_free(&m);
    printf("%d passed, %d failed\n", passed, failed);
    return failed != 0;
}
