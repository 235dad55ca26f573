/* 28_lobes.c - the goniometric diagram of UW and Berkeley: how much of the light from L
   leaves toward each V, by shade_brdf, as the length of a ray.  It shows Phong's lobe, Blinn's for
   the same n, and Blinn's for 4 n (dashed), which all but covers Phong's.  They stand on the half
   circle of k_d, which is the same toward all V.  V is 20 degrees off R, so H is 10 off N: half as
   far, hence 4 n.
   Try theta = 55: the lobes still agree in this plane; 29_grazing shows what happens across it.

   cc -O2 -I. examples/lessons/28_lobes.c -lm -o lobes && ./lobes                writes lobes.ppm */
#define SHADE_IMPLEMENTATION
#include "shade.h"
#include "../shared/sketch.h"

enum { LOBES = 3, STEPS = 720 };
static const float theta = 40, to_eye = 60;    /* degrees from N: L to the left, V to the right */
static const shade_vec3 P = { 0, 0, 0 }, N = { 0, 1, 0 }, black = { 0.02f, 0.02f, 0.02f };

/* The end of the ray toward an angle */
static shade_vec3 ray(const shade_material *m, shade_model model, float degrees)
{
    shade_vec3 V = sketch_direction(degrees);
    return shade_scale(V, shade_brdf(m, model, N, sketch_direction(-theta), V).x);
}

/* The angle from R at which the highlight is half as bright, to a tenth of a degree */
static double half_angle(const shade_material *m, shade_model model)
{
    for (int k = 0;; k++) {
        float length = shade_length(ray(m, model, theta - ((float)k + 0.5f) / 10));
        if (length - m->diffuse.x < m->specular.x / 2) return k / 10.0;
    }
}

static void arrow(const sketch *s, shade_vec3 d, const char *name)
{
    sketch_arrow(s, P, shade_scale(d, 1.04f));
    sketch_name(s, shade_scale(d, 1.1f), 26, name);
}

int main(int argc, char **argv)
{
    static const char *const name[LOBES] = { "Phong, (R·V)^{%d}", "Blinn-Phong, (N·H)^{%d}",
                                             "Blinn-Phong, (N·H)^{%d}" };
    static const shade_vec3 ink[LOBES] = { { 0.7f, 0.12f, 0.01f }, { 0.02f, 0.15f, 0.7f },
                                           { 0, 0.1f, 0.02f } };
    shade_material m = { .diffuse = { 0.25f, 0, 0 }, .specular = { 0.75f, 0, 0 } };
    const shade_vec3 L = sketch_direction(-theta), V = sketch_direction(to_eye);
    canvas c = canvas_new(960, 560, 3);
    sketch s = sketch_new(&c, 560, 500, 400);
    sketch_paper(&c);
    sketch_ink(&s, black, 1.4f);
    sketch_line(&s, shade_v3(-2, 0, 0), shade_v3(2, 0, 0));
    sketch_arc(&s, P, m.diffuse.x, -90, 90);
    sketch_name(&s, shade_v3(-0.19f, 0.05f, 0), 24, "k_d");
    arrow(&s, N, "N");
    arrow(&s, L, "L");
    arrow(&s, V, "V");
    arrow(&s, shade_mirror(L, N), "R");
    arrow(&s, shade_halfway(L, V), "H");
    for (int k = 0; k < LOBES; k++) {
        shade_model model = k ? SHADE_MODEL_BLINN_PHONG : SHADE_MODEL_PHONG;
        m.shininess = k < 2 ? 16 : shade_blinn_exponent(16);
        sketch_ink(&s, ink[k], k ? 3 : 5.3f);
        for (int i = 0; i < STEPS; i++) {
            float degrees = -90 + 180 * (float)i / STEPS, next = degrees + 180.0f / STEPS;
            if (k == 2 && i / 12 % 2) continue;    /* a gap */
            sketch_line(&s, ray(&m, model, degrees), ray(&m, model, next));
        }
        label_print(&c, 20, 40 + 62 * k, 24, ink[k], name[k], (int)m.shininess);
        label_print(&c, 20, 65 + 62 * k, 20, ink[k], "half as bright %.1f° off R",
                    half_angle(&m, model));
    }
    const double off = (double)(to_eye - theta);
    label_print(&c, 20, 540, 20, black, "V is %g° off R, H is %g° off N", off, off / 2);
    return canvas_save(&c, argc, argv, "lobes.ppm");
}
