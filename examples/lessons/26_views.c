/* 26_views.c - what to look at when a picture is wrong, by a fragment shader: normals in eye space
   (right is red, up is green, toward the eye is blue), depth (near is bright), triangles.  A seam
   among the normals is a wrong normal, a hole among the triangles a lost one.
   Try shape_teapot(2): the outline gets corners while the colours of the normals stay smooth.

   cc -O2 -I. examples/lessons/26_views.c -lm -o views && ./views        writes views.ppm */
#define SHADE_IMPLEMENTATION
#include "shade.h"
#include "../shared/shapes.h"
#include "../shared/label.h"

enum { NORMALS, DEPTH, TRIANGLES };
typedef struct scene { mesh_scene place; shade_mat3 eye_from_world; int view; } scene;

static void look(const void *uniforms, const shade_fragments *SHADE_RESTRICT in,
                 shade_colors *SHADE_RESTRICT out)
{
    const scene *s = (const scene *)uniforms;
    SHADE_EACH_LANE(i) {
        shade_vec3 N = lane(in->varying[3], i), k;
        uint32_t h = (in->primitive[i] + 1) * 2654435761u;
        h = (h ^ h >> 15) * 2246822519u;
        N = shade_normalize(shade_mat3_transform(s->eye_from_world, N));
        k = shade_v3((1 + N.x) / 2, (1 + N.y) / 2, (1 + N.z) / 2);
        if (s->view == DEPTH) k = shade_v3(1 - in->z[i], 1 - in->z[i], 1 - in->z[i]);
        if (s->view == TRIANGLES)
            k = shade_v3((float)(h >> 24) / 320, (float)(h >> 16 & 255) / 320,
                         (float)(h >> 8 & 255) / 320);
        k = shade_linear_from_srgb(k);    /* which the target encodes again */
        lane_put(out->color[0], i, k);
    }
}

int main(int argc, char **argv)
{
    static const char *const name[3] = { "normals", "depth", "triangles" };
    static const char *const formula[3] = { "red, green, blue: (1 + N) / 2",
                                            "1 − z: near is bright",
                                            "a colour for each in->primitive" };
    const shade_vec3 grey = { 0.7f, 0.7f, 0.7f };
    owned_mesh pot = shape_teapot(8);
    scene s = { .place = { .mesh = &pot } };
    shade_pipeline pipeline = { mesh_vertex, look, &s, .varyings = 8 };
    shade_mat4 view = shade_mat4_look_at(shade_v3(0, 5, 13), shade_v3(0, -0.05f, 0),
                                         shade_v3(0, 1, 0));
    canvas c = canvas_new(960, 310, 3);

    s.place.model = shape_at(-0.4f, -1.5f, -0.17f, 1, -0.45f);
    /* near and far close around the pot, so that depth uses its whole range */
    s.place.clip_from_world = shade_mat4_mul(shade_mat4_perspective(0.36f, 4 / 3.0f, 12, 16), view);
    s.eye_from_world = shade_mat3_from_mat4(view);
    canvas_dark(&c.target);
    for (s.view = NORMALS; s.view <= TRIANGLES; s.view++) {
        shade_target panel = canvas_panel(&c, 320 * s.view, 5, 320, 240);
        mesh_draw(&panel, &pipeline, &pot);
        label_caption(&c, 320 * s.view + 160, 270, grey, name[s.view], formula[s.view]);
    }
    mesh_free(&pot);
    return canvas_save(&c, argc, argv, "views.ppm");
}
