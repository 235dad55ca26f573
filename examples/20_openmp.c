/* 20_openmp.c - bands of rows again, now by a loop that OpenMP spreads over its threads.  Left:
   820 balls drawn in one go.  Right: in twelve bands, every second one brightened at the end.  The
   program fails where a bit differs.  Without -fopenmp the loop draws one band after the other.

   cc -O2 -fopenmp -I. examples/20_openmp.c -lm -o openmp && ./openmp          writes openmp.ppm */
#define SHADE_IMPLEMENTATION
#include "shade.h"
#include "mesh.h"
#include "label.h"

enum { WIDTH = 480, HEIGHT = 440, SAMPLES = 3, BANDS = 12, DEPTH = 4 };

static shade_mat4 turn(float radians, float x, float y, float z)
{
    return shade_mat4_rotation(radians, shade_v3(x, y, z));
}

/* A ball, and on it nine balls a third as large that each carry nine */
static void flake(const shade_target *target, const owned_mesh *ball, shade_draw_state state,
                  shade_mat4 at, int depth)
{
    static const shade_vec3 paint[DEPTH] = {
        { 0.7f, 0.5f, 0.3f }, { 0.5f, 0.15f, 0.05f }, { 0.04f, 0.2f, 0.3f }, { 0.05f, 0.06f, 0.1f }
    };
    shade_material glaze = { .diffuse = paint[depth], .ambient = paint[depth],
                             .specular = { 0.5f, 0.5f, 0.5f }, .shininess = 60 };
    shade_mat4 up = shade_mat4_mul(shade_mat4_translation(shade_v3(0, 4 / 3.0f, 0)),
                                   shade_mat4_scaling(shade_v3(1 / 3.0f, 1 / 3.0f, 1 / 3.0f)));
    state.model = at, state.material = &glaze;
    shade_draw_mesh(target, &ball[depth].view, &state, NULL);
    for (int i = 0; i < 9 && depth > 0; i++) {    /* six about the waist, three above */
        float around = i < 6 ? (float)i / 6 : (float)i / 3 + 1 / 12.0f;
        shade_mat4 m = shade_mat4_mul(turn(6.2831853f * around, 0, 1, 0),
                                      turn(i < 6 ? 1.5707963f : 0.65f, 1, 0, 0));
        flake(target, ball, state, shade_mat4_mul(at, shade_mat4_mul(m, up)), depth - 1);
    }
}

static void draw(shade_target target, const owned_mesh *ball)
{
    shade_light lamps[2];
    shade_draw_state state = { .lighting = { .lights = lamps, .light_count = 2 } };
    lamps[0] = shade_directional_light(shade_v3(0.7f, -0.9f, -0.6f), shade_v3(1.1f, 1.05f, 1));
    lamps[1] = shade_directional_light(shade_v3(-1, -0.1f, -0.1f), shade_v3(0.2f, 0.35f, 0.6f));
    state.lighting.ambient = shade_v3(0.10f, 0.11f, 0.13f);
    state.view = shade_mat4_look_at(shade_v3(0, 4, 9), shade_v3(0, 0.1f, 0), shade_v3(0, 1, 0));
    state.projection = shade_mat4_perspective(0.39f, (float)WIDTH / HEIGHT, 4, 20);
    flake(&target, ball, state, turn(0.3f, 0, 1, 0), DEPTH - 1);
}

int main(int argc, char **argv)
{
    canvas c = canvas_new(2 * WIDTH, HEIGHT, SAMPLES);
    shade_target right = canvas_panel(&c, WIDTH, 0, WIDTH, HEIGHT);
    owned_mesh ball[DEPTH];
    int different = 0, row = 4 * SAMPLES * WIDTH;    /* floats */

    for (int i = 0; i < DEPTH; i++) ball[i] = mesh_sphere(16 * (i + 1), 8 * (i + 1));
    canvas_gradient(&c.target, shade_v3(0.045f, 0.05f, 0.06f), shade_v3(0.012f, 0.013f, 0.016f));
    draw(canvas_panel(&c, 0, 0, WIDTH, HEIGHT), ball);
#ifdef _OPENMP
#pragma omp parallel for
#endif
    for (int i = 0; i < BANDS; i++) {
        shade_target band = right;
        band.clip_y = band.height * i / BANDS, band.clip_width = band.width;
        band.clip_height = band.height * (i + 1) / BANDS - band.clip_y;
        draw(band, ball);
    }
    for (int y = 0; y < SAMPLES * HEIGHT; y++) {
        float *one = (float *)c.target.color + 2 * y * row, *other = one + row;
        different |= memcmp(one, other, sizeof(float[4]) * SAMPLES * WIDTH) != 0;
        for (int i = 0; i < row && y * BANDS / (SAMPLES * HEIGHT) % 2; i++) other[i] *= 1.6f;
    }
    label_center(&c, 240, 427, 22, shade_v3(0.7f, 0.7f, 0.7f), "at once");
    label_center(&c, 720, 427, 22, shade_v3(0.7f, 0.7f, 0.7f), "in twelve bands");
    for (int i = 0; i < DEPTH; i++) mesh_free(&ball[i]);
    return canvas_save(&c, argc, argv, "openmp.ppm") | different;
}
