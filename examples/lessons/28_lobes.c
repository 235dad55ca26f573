/* 28_lobes.c - the goniometric diagram of UW and Berkeley: how much of the light from L
   leaves toward each V, by shade_brdf, as the length of a ray.  It shows Phong's lobe, Blinn's for
   the same n, and Blinn's for 4 n (dashed), which all but covers Phong's.  They stand on the half
   circle of k_d.  V is 20 degrees off R, so H is 10 off N: half as far, hence 4 n.
   Try theta = 55: the lobes still agree in this plane; 29_grazing shows what happens across it.

   cc -O2 -I. examples/lessons/28_lobes.c -lm -o lobes && ./lobes                writes lobes.ppm */
#define SHADE_IMPLEMENTATION
#include "shade.h"
#include "../shared/mesh.h"
#include "../shared/label.h"

enum { LOBES = 3, STEPS = 720, SIZE = 400, X = 560, Y = 500 };    /* of a ray of length 1; P */
static const float theta = 40, to_eye = 60;    /* degrees from N: L to the left, V to the right */
static const shade_vec3 N = { 0, 1, 0 }, black = { 0.02f, 0.02f, 0.02f };

static shade_vec3 at(float degrees)
{
    shade_vec2 t = mesh_turn(degrees / 360);
    return shade_v3(t.y, t.x, 0);
}

/* The angle from R at which the highlight is half as bright, to a tenth of a degree */
static double half_angle(const shade_material *m, shade_model model)
{
    for (int k = 0;; k++) {
        shade_vec3 V = at(theta - ((float)k + 0.5f) / 10);
        float highlight = shade_brdf(m, model, N, at(-theta), V).x - m->diffuse.x;
        if (highlight < m->specular.x / 2) return k / 10.0;
    }
}

static void arrow(const canvas *c, const shade_line_state *pen, shade_vec3 d, const char *name)
{
    shade_vec3 tip = shade_scale(d, 1.04f), a = shade_v3(0.015f * d.y, -0.015f * d.x, 0);
    shade_vec3 points[6] = { { 0, 0, 0 }, tip, tip, shade_add(d, a), tip, shade_sub(d, a) };
    shade_draw_lines(&c->target, points, 6, pen, NULL);
    tip = shade_scale(d, 1.1f * SIZE);
    label_center(c, X + (int)tip.x, Y + 7 - (int)tip.y, 26, black, name);
}

int main(int argc, char **argv)
{
    static const char *const name[LOBES] = { "Phong, (R·V)^{%d}", "Blinn-Phong, (N·H)^{%d}",
                                             "Blinn-Phong, (N·H)^{%d}" };
    static const char *const letter[5] = { "N", "L", "R", "V", "H" };
    static const shade_vec3 ink[LOBES] = { { 0.7f, 0.12f, 0.01f }, { 0.02f, 0.15f, 0.7f },
                                           { 0, 0.1f, 0.02f } };
    shade_material m = { .diffuse = { 0.25f, 0, 0 }, .specular = { 0.75f, 0, 0 } };
    shade_line_state pen = { .width = 4, .color = { 0.05f, 0.05f, 0.05f, 1 },
                             .cap = SHADE_CAP_SQUARE, .raster.depth_test = SHADE_COMPARE_ALWAYS };
    canvas c = canvas_new(960, 560, 3);
    const shade_vec3 L = at(-theta), V = at(to_eye);
    const shade_vec3 direction[5] = { N, L, shade_mirror(L, N), V, shade_halfway(L, V) };
    shade_vec3 curve[2 * STEPS] = { { -2, 0, 0 }, { 2, 0, 0 } };
    pen.clip_from_points = shade_mat4_ortho(-1.0f * X / SIZE, (960.0f - X) / SIZE,
                                            (Y - 560.0f) / SIZE, 1.0f * Y / SIZE, -1, 1);
    canvas_gradient(&c.target, shade_v3(0.92f, 0.92f, 0.9f), shade_v3(0.85f, 0.85f, 0.82f));
    shade_draw_lines(&c.target, curve, 2, &pen, NULL);
    for (int k = 0; k < 5; k++) arrow(&c, &pen, direction[k], letter[k]);
    for (int k = 0; k < LOBES; k++) {
        shade_model model = k ? SHADE_MODEL_BLINN_PHONG : SHADE_MODEL_PHONG;
        m.shininess = k < 2 ? 16 : shade_blinn_exponent(16);
        for (int i = 0; i < 2 * STEPS; i++) {
            shade_vec3 d = at(-90 + (float)((i + 1) / 2) * 180.0f / STEPS);
            if (k == 2 && i / 24 % 2) d = shade_v3(0, 0, 0);    /* a gap */
            curve[i] = shade_scale(d, shade_brdf(&m, model, N, L, d).x);
        }
        pen.color = shade_v4(ink[k].x, ink[k].y, ink[k].z, 1);
        pen.width = k ? 9 : 16;
        shade_draw_lines(&c.target, curve, 2 * STEPS, &pen, NULL);
        label_print(&c, 20, 40 + 62 * k, 24, ink[k], name[k], (int)m.shininess);
        label_print(&c, 20, 65 + 62 * k, 20, ink[k], "half as bright %.1f° off R",
                    half_angle(&m, model));
    }
    const double off = (double)(to_eye - theta);
    label_print(&c, 20, 540, 20, black, "V is %g° off R, H is %g° off N", off, off / 2);
    return canvas_save(&c, argc, argv, "lobes.ppm");
}
