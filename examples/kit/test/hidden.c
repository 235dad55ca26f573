/* hidden.c - chunks that a picture hides are left out, and the picture has the same bytes as with
   all of them: balls behind each other, from many sides and from within, in bands. */
#define _DEFAULT_SOURCE
#define SHADE_IMPLEMENTATION
#include "shade.h"
#include "examples/kit/scene/portrait.h"

enum { SLICES = 96, STACKS = 48, BALLS = 3, WIDTH = 150, HEIGHT = 110, BANDS = 3, SIDES = 40 };
static uint8_t picture[2][WIDTH * HEIGHT * 4];
static float depth[2][WIDTH * HEIGHT];

/* Three balls in a row along x, the first one the largest, in one mesh */
static void build(model *m)
{
    static const double radius[BALLS] = { 0.35, 0.3, 0.12 }, place[BALLS] = { 0.55, -0.1, -0.7 };
    const owned_mesh ball = mesh_sphere(SLICES, STACKS);
    const int n = ball.view.vertex_count, k = ball.view.index_count;
    m->mesh = mesh_new(BALLS * n, BALLS * k);
    for (int b = 0; b < BALLS; b++) {
        for (int i = 0; i < n; i++) {
            const float *p = ball.positions + 3 * (size_t)i, r = (float)radius[b];
            shade_vec3 at = shade_scale(shade_v3(p[0], p[1], p[2]), r);
            at.x += (float)place[b];
            mesh_put(&m->mesh, b * n + i, at, shade_v3(p[0], p[1], p[2]), 0, 0);
        }
        for (int i = 0; i < k; i++)
            m->mesh.indices[b * k + i] = ball.indices[i] + (uint32_t)(b * n);
    }
    m->part = (model_part *)calloc(1, sizeof *m->part);
    if (!m->part) exit(1);
    m->part->count = BALLS * k;
    m->part_count = m->normals_given = 1;
    if (mesh_chunk_parts(m)) exit(1);
}

static void draw(exhibit *e, int which, shade_mat4 view, shade_mat4 projection)
{
    const shade_target t = {
        .width = WIDTH, .height = HEIGHT, .color = picture[which], .depth = depth[which]
    };
    shade_clear(&t, shade_v4(0.2f, 0.3f, 0.4f, 1), 1);
    for (int b = 0; b < BANDS; b++) {
        const shade_target rows = bands_rows(&t, b, BANDS);
        if (exhibit_draw(e, &rows, view, projection, 1)) exit(1);
    }
}

int main(void)
{
    static const studio no_light;
    static const shade_vec3 up = { 0, 1, 0 }, middle = { 0, 0, 0 };
    model_options how = model_options_new();
    model m = { .normals_given = 1 };
    studio light = no_light;
    int failed = 0, hidden = 0;
    build(&m);
    how.quick = 1;
    studio_open_quick(&light);
    for (int side = 0; side < SIDES; side++) {
        const float a = 0.16f * (float)side, away = side % 4 == 3 ? 0.02f * (float)side : 2.5f;
        const shade_vec3 eye = { away * cosf(a), 0.3f * sinf(5 * a), away * sinf(a) };
        const shade_mat4 view = shade_mat4_look_at(eye, middle, up);
        const shade_mat4 lens = side % 3 ? shade_mat4_perspective(0.8f, 1.4f, 0.02f, 9)
                                         : shade_mat4_ortho(-1.4f, 1.4f, -1, 1, 0.02f, 9);
        const shade_target all = { .width = WIDTH,
                                   .height = HEIGHT,
                                   .depth = depth[1],
                                   .clip_width = WIDTH,
                                   .clip_height = HEIGHT };
        exhibit e;
        if (exhibit_open(&e, &m, &light, &how, eye)) return 1;
        draw(&e, 0, view, lens);
        exhibit_aim(&e, shade_mat4_mul(lens, view));
        draw(&e, 1, view, lens);
        for (int i = 0; i < m.part->chunk_count; i++)
            hidden += near_chunk_is_hidden(&e.near_chunks[i], &all);
        exhibit_close(&e);
        if (memcmp(picture[0], picture[1], sizeof picture[0]) ||
            memcmp(depth[0], depth[1], sizeof depth[0])) {
            printf("FAIL hidden: another picture from side %d\n", side);
            failed++;
        }
    }
    if (hidden < SIDES * m.part->chunk_count / 8) {
        printf("FAIL hidden: %d chunks of %d\n", hidden, SIDES * m.part->chunk_count);
        failed++;
    }
    model_free(&m);
    printf("%d passed, %d failed\n", SIDES + 1 - failed, failed);
    return failed != 0;
}
