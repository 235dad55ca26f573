/* 43_pinhole.c - a pinhole camera from the side (UW).  Left: viewing rays run from posts of one
   height through the image plane to the centre of projection, COP, and beyond it they draw the
   inverted image of a real pinhole.  Right: the same points after projection and division by w.
   The rays are parallel: dropping z gives the picture; z tells which point of a ray is nearest.
   Try depth[0] = 2: the post on the image plane keeps its height, 0.900.

   cc -O2 -I. examples/lessons/43_pinhole.c -lm -o pinhole && ./pinhole        writes pinhole.ppm */
#define SHADE_IMPLEMENTATION
#include "shade.h"
#include "../shared/sketch.h"

enum { POSTS = 3 };
static const float near_z = 2, far_z = 6.6f, half_height = 1;    /* of the image plane */
static const float depth[POSTS] = { 2.6f, 4, 5.8f }, top = 0.9f;
static const shade_vec3 black = { 0, 0, 0 }, grey = { 0.2f, 0.2f, 0.2f };
static const shade_vec3 ink[POSTS] = { { 0.7f, 0.12f, 0.01f }, { 0, 0.22f, 0.06f },
                                       { 0.02f, 0.15f, 0.7f } };

/* A point of the plane x = 0, z in front of the eye */
static shade_vec3 drawn(float z, float y) { return shade_v3(z, y, 0); }
static shade_vec3 warped(shade_mat4 m, float z, float y)
{
    shade_vec3 p = shade_mat4_transform_point(m, shade_v3(0, y, -z));
    return drawn(p.z, p.y);
}

static void plane(sketch *s, float z, float half, const char *name)
{
    sketch_ink(s, grey, 3);
    sketch_line(s, drawn(z, -half), drawn(z, half));
    sketch_name(s, drawn(z, -half - 22.0f / (float)s->unit), 20, name);
}

static void world(const canvas *c)
{
    sketch s = sketch_new(c, 100, 215, 50);
    plane(&s, near_z, half_height, "image plane");
    plane(&s, far_z, half_height * far_z / near_z, "far");
    plane(&s, -1.2f, 0.8f, "film");
    for (int k = POSTS - 1; k >= 0; k--) {
        sketch_ink(&s, ink[k], 5);
        sketch_line(&s, drawn(depth[k], -top), drawn(depth[k], top));
        sketch_dot(&s, drawn(depth[k], top), 9);
        sketch_dot(&s, drawn(-1.2f, -1.2f * top / depth[k]), 9);
        sketch_ink(&s, ink[k], 2);
        for (int end = -1; end <= 1; end += 2)
            sketch_line(&s, drawn(depth[k], top * (float)end),
                        drawn(-1.2f, -1.2f * top * (float)end / depth[k]));
    }
    sketch_ink(&s, black, 2);
    sketch_dot(&s, drawn(0, 0), 9);
    sketch_name(&s, drawn(0, 0.42f), 22, "COP");
}

int main(int argc, char **argv)
{
    canvas c = canvas_new(960, 470, 3);
    shade_mat4 m = shade_mat4_frustum(-1, 1, -half_height, half_height, near_z, far_z);
    sketch s = sketch_new(&c, 745, 205, 120);
    sketch_paper(&c);
    world(&c);
    plane(&s, -1, 1, "near");
    plane(&s, 1, 1, "far");
    for (int k = POSTS - 1; k >= 0; k--) {
        shade_vec3 head = warped(m, depth[k], top), foot = warped(m, depth[k], -top);
        sketch_ink(&s, ink[k], 5);
        sketch_line(&s, head, foot);
        sketch_ink(&s, ink[k], 2);
        sketch_line(&s, head, drawn(-1.25f, head.y));
        sketch_line(&s, foot, drawn(-1.25f, foot.y));
        label_print(&c, 510 + 145 * k, 450, 18, ink[k], "z = −%.1f: %.3f", (double)depth[k],
                    (double)head.y);
    }
    label_draw(&c, 510, 424, 18, black, "y/w of the tops, their heights on the image plane:");
    label_center(&c, 230, 30, 22, black, "space: viewing rays meet in the COP");
    label_center(&c, 750, 30, 22, black, "warped space: rays are parallel");
    return canvas_save(&c, argc, argv, "pinhole.ppm");
}
