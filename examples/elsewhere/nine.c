/* nine.c - nine programs draw one ball with the same numbers (k_d .6, k_s .8, n 30, a lamp toward
   1, 1, 1), and shade.h after the conversions of elsewhere.h.  Above: the tables' pictures, which
   the real programs drew (measure/); below: shade.h, from the words in them.

   cc -O2 -I. examples/elsewhere/nine.c -lm -o nine && ./nine          writes elsewhere.ppm */
#define SHADE_IMPLEMENTATION
#include "shade.h"
#include "../shared/label.h"
#include "words.h"

enum { SIZE = 96, NINE = 9 };

static const struct {
    const char *table, *name, *says;
    float ambient; /* of the table's scenes */
} program[NINE] = { { "povray", "POV-Ray", "R·V, sRGB", 1 },
                    { "vtk", "VTK", "R·V, two-sided", 1 },
                    { "three_phong", "three.js", "F (n+2)/8", 0.25f },
                    { "babylon", "Babylon.js", "N·H, no gate", 0.25f },
                    { "x_ite", "X-ITE", "128 shininess", 0 },
                    { "x3dom", "X3DOM", "gamma 2.2", 0 },
                    { "raster3d", "Raster3D", "bytes √", 1 },
                    { "pymol", "PyMOL", "2/(1+z)", 1 },
                    { "gnuplot", "gnuplot", "n is 5", 1 } };

/* Reads a table's picture, and the words in its comment. */
static int read_ball(const char *name, unsigned char *grey, char *words, size_t room)
{
    char path[100], line[100];
    FILE *f;
    int read;
    snprintf(path, sizeof path, "examples/elsewhere/tables/%s.pgm", name);
    f = fopen(path, "rb");
    if (!f) return 0;
    read = fgets(line, sizeof line, f) && fgets(words, (int)room, f) &&
           fgets(line, sizeof line, f) && fgets(line, sizeof line, f) &&
           fread(grey, 1, SIZE * SIZE, f) == SIZE * SIZE;
    fclose(f);
    return read;
}

/* One triangle over the whole picture */
static void everywhere(const void *uniforms, const shade_vertex_ids *SHADE_RESTRICT in,
                       shade_vertices *SHADE_RESTRICT out)
{
    (void)uniforms;
    SHADE_EACH_LANE(i)
    {
        out->clip[0][i] = in->index[i] == 1 ? 3.0f : -1.0f;
        out->clip[1][i] = in->index[i] == 2 ? 3.0f : -1.0f;
        out->clip[3][i] = 1;
    }
}

/* The ball of radius 1 where it is seen along -z; pixels beside it are discarded. */
static void ball(const void *uniforms, const shade_fragments *SHADE_RESTRICT in,
                 shade_colors *SHADE_RESTRICT out)
{
    float P[3][SHADE_LANES];
    SHADE_EACH_LANE(i)
    {
        const float x = 1.25f * (2 * in->x[i] / SIZE - 1), y = 1.25f * (1 - 2 * in->y[i] / SIZE);
        const float zz = 1 - x * x - y * y;
        P[0][i] = x;
        P[1][i] = y;
        P[2][i] = sqrtf(zz > 0 ? zz : 0);
        out->discard[i] = zz <= 0;
    }
    elsewhere_lit_lanes((const elsewhere_scene *)uniforms, P[0], P[0], out->color[0]);
}

/* Draws a ball as words say.  The first of them is the camera, which here is a parallel one. */
static int draw_ball(const shade_target *target, float ambient, const char *words)
{
    const char *text = words + strlen("# parallel ");
    elsewhere_scene scene = { .ambient = { ambient, ambient, ambient }, .parallel = 1 };
    shade_pipeline pipeline = { everywhere, ball, &scene, .may_discard = 1 };
    elsewhere_look look;
    elsewhere_lamp lamp;
    char said[400];
    scene.look = &look;
    scene.lamps = &lamp;
    scene.view = shade_mat4_translation(shade_v3(0, 0, -5));
    if (elsewhere_read(&text, &look, NULL, said, sizeof said)) return 0;
    text += strspn(text, " ");
    if (*text > ' ' && elsewhere_read(&text, NULL, &lamp, said, sizeof said)) return 0;
    scene.lamp_count = shade_dot(look.own, look.own) > 0 ? 0 : 1;
    return shade_draw(target, &pipeline, NULL, 3, 3, NULL) == SHADE_OK;
}

/* Copies bytes onto a part of a canvas of linear light, whose file is sRGB. */
static void put_bytes(const canvas *c, int x, int y, const unsigned char *bytes, int step)
{
    float *to = (float *)c->target.color;
    for (int i = 0; i < SIZE * SIZE; i++) {
        const float v = (float)bytes[step * i] / 255;
        const shade_vec3 linear = shade_linear_from_srgb(shade_v3(v, v, v));
        float *at = to + 4 * ((y + i / SIZE) * c->width + x + i % SIZE);
        at[0] = linear.x;
        at[1] = linear.y;
        at[2] = linear.z;
    }
}

int main(int argc, char **argv)
{
    static unsigned char grey[SIZE * SIZE], rgba[SIZE * SIZE][4];
    static float depth[SIZE * SIZE];
    const shade_vec3 ink = { 0.65f, 0.72f, 0.8f };
    canvas c = canvas_new(960, 290, 1);
    shade_target target = { SIZE, SIZE, .color = rgba, .depth = depth };
    char words[600];
    shade_clear(&c.target, shade_v4(0, 0, 0, 1), 1);
    for (int i = 0; i < NINE; i++) {
        const int x = 12 + 105 * i;
        shade_clear(&target, shade_v4(0, 0, 0, 1), 1);
        if (!read_ball(program[i].table, grey, words, sizeof words) ||
            !draw_ball(&target, program[i].ambient, words)) {
            fprintf(stderr, "nine: the table of %s cannot be drawn\n", program[i].table);
            return 1;
        }
        for (int k = 0; k < SIZE * SIZE && i == NINE - 1; k++)
            if (!rgba[k][1]) grey[k] = 0; /* gnuplot's ball stands on another colour */
        put_bytes(&c, x, 24, grey, 1);
        put_bytes(&c, x, 144, rgba[0] + 1, 4);
        label_center(&c, x + SIZE / 2, 258, 19, ink, program[i].name);
        label_center(&c, x + SIZE / 2, 278, 15, ink, program[i].says);
    }
    label_center(&c, 480, 18, 14, ink, "drawn by the programs");
    label_center(&c, 480, 136, 14, ink, "drawn by shade.h");
    return canvas_save(&c, argc, argv, "elsewhere.ppm");
}
