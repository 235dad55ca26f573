/* grade.c - the grader of 07_coverage; README.md says what to write.
   cc -O2 -I. examples/teaching/assignments/07_coverage/grade.c my.c -lm -o grade && ./grade */
#define SHADE_IMPLEMENTATION
#include "shade.h"
#include "../grade.h"

int covers(const int x[3], const int y[3], int i, int j);

enum { SIDE = 16 };

/* The triangle by shade.h: corners in 1/256 pixel, drawn into 16 x 16 pixels. */
static const float *corners;
static void vertex(const void *uniforms, const shade_vertex_ids *SHADE_RESTRICT in,
                   shade_vertices *SHADE_RESTRICT out)
{
    (void)uniforms;
    SHADE_EACH_LANE(k)
    {
        const float *at = corners + in->index[k];
        out->clip[0][k] = at[0] / (128 * SIDE) - 1;
        out->clip[1][k] = 1 - at[3] / (128 * SIDE);
        out->clip[3][k] = 1;
    }
}
static void white(const void *uniforms, const shade_fragments *SHADE_RESTRICT in,
                  shade_colors *SHADE_RESTRICT out)
{
    (void)uniforms;
    (void)in;
    SHADE_EACH_LANE(k) { out->color[0][k] = 1; }
}
static int by_shade(const float *in)
{
    static uint32_t pixels[SIDE * SIDE];
    static float drawn[6];
    const shade_target target = { .width = SIDE, .height = SIDE, .color = pixels };
    const shade_pipeline pipeline = { .vertex = vertex, .fragment = white };
    if (memcmp(drawn, in, sizeof drawn)) {
        memcpy(drawn, in, sizeof drawn);
        corners = drawn;
        shade_clear(&target, shade_v4(0, 0, 0, 1), 1);
        shade_draw(&target, &pipeline, NULL, 3, 3, NULL);
    }
    return (pixels[(int)in[7] * SIDE + (int)in[6]] & 255) != 0;
}

static int ask(int (*how)(const int *, const int *, int, int), const float *in)
{
    int x[3], y[3];
    for (int k = 0; k < 3; k++) {
        x[k] = (int)in[k];
        y[k] = (int)in[3 + k];
    }
    return how(x, y, (int)in[6], (int)in[7]) != 0;
}
/* Twice the area on each side of an edge decides; on the edge itself decides edges. */
static int by_edges(const int *x, const int *y, int px, int py, int on_edge)
{
    int inside = 0, outside = 0;
    for (int k = 0; k < 3; k++) {
        const int n = (k + 1) % 3;
        const int e = (x[n] - x[k]) * (py - y[k]) - (y[n] - y[k]) * (px - x[k]);
        inside += e > 0 || (e == 0 && on_edge);
        outside += e < 0 || (e == 0 && on_edge);
    }
    return inside == 3 || outside == 3;
}
static int every_edge(const int *x, const int *y, int i, int j)
{
    return by_edges(x, y, 256 * i + 128, 256 * j + 128, 1);
}
static int no_edge(const int *x, const int *y, int i, int j)
{
    return by_edges(x, y, 256 * i + 128, 256 * j + 128, 0);
}
static int at_corner(const int *x, const int *y, int i, int j)
{
    return by_edges(x, y, 256 * i, 256 * j, 1);
}
/* What textbooks show: no edge function is negative */
static int three_signs(const int *x, const int *y, int i, int j)
{
    const int px = 256 * i + 128, py = 256 * j + 128;
    for (int k = 0; k < 3; k++) {
        const int n = (k + 1) % 3;
        if ((x[n] - x[k]) * (py - y[k]) < (y[n] - y[k]) * (px - x[k])) return 0;
    }
    return 1;
}
static int64_t area(const int *x, const int *y)
{
    return (int64_t)(x[1] - x[0]) * (y[2] - y[0]) - (int64_t)(y[1] - y[0]) * (x[2] - x[0]);
}
/* The triangle turned by half a turn about the pixel: what are top and left edges then, are bottom
   and right ones. */
static int turned(const int *x, const int *y, int i, int j)
{
    float in[8];
    for (int k = 0; k < 3; k++) {
        in[k] = (float)(2 * (256 * i + 128) - x[k]);
        in[3 + k] = (float)(2 * (256 * j + 128) - y[k]);
    }
    in[6] = (float)i;
    in[7] = (float)j;
    return by_shade(in);
}
static int of_winding(const int *x, const int *y, int i, int j, int sign)
{
    const float in[8] = { (float)x[0], (float)x[1], (float)x[2], (float)y[0],
                          (float)y[1], (float)y[2], (float)i,    (float)j };
    return area(x, y) * sign > 0 ? by_shade(in) : 0;
}
static int one_way(const int *x, const int *y, int i, int j) { return of_winding(x, y, i, j, 1); }
static int other_way(const int *x, const int *y, int i, int j)
{
    return of_winding(x, y, i, j, -1);
}

static void yours(const float *in, float *out) { out[0] = (float)ask(covers, in); }
static void right(const float *in, float *out) { out[0] = (float)by_shade(in); }
static void with_edges(const float *in, float *out) { out[0] = (float)ask(every_edge, in); }
static void without_edges(const float *in, float *out) { out[0] = (float)ask(no_edge, in); }
static void textbook(const float *in, float *out) { out[0] = (float)ask(three_signs, in); }
static void corner_of_pixel(const float *in, float *out) { out[0] = (float)ask(at_corner, in); }
static void bottom_right(const float *in, float *out) { out[0] = (float)ask(turned, in); }
static void other_winding_alone(const float *in, float *out) { out[0] = (float)ask(other_way, in); }
static void clockwise_alone(const float *in, float *out) { out[0] = (float)ask(one_way, in); }

static int whole(int low, int high)
{
    return low + (int)(grade_bits() % (uint32_t)(high - low + 1));
}
static void pixel(float *in)
{
    in[6] = (float)whole(0, SIDE - 1);
    in[7] = (float)whole(0, SIDE - 1);
}
/* Every other pixel is that of a point of the triangle. */
static void anywhere(float *in)
{
    for (int k = 0; k < 6; k++) in[k] = (float)whole(0, 256 * SIDE);
    pixel(in);
    if (whole(0, 1)) return;
    const float a = grade_between(0, 1), b = grade_between(0, 1 - a);
    in[6] = floorf(fminf((in[0] * a + in[1] * b + in[2] * (1 - a - b)) / 256, SIDE - 1));
    in[7] = floorf(fminf((in[3] * a + in[4] * b + in[5] * (1 - a - b)) / 256, SIDE - 1));
}
/* Corners on pixel centres, and a pixel among them: many lie on an edge. */
static void on_edges(float *in)
{
    for (int k = 0; k < 6; k++) in[k] = (float)(256 * whole(0, 3) + 128);
    in[6] = (float)whole(0, 3);
    in[7] = (float)whole(0, 3);
}

static int place(float x, float y, float *in)
{
    const float fan[6] = { 128 + 256 * 2, 128 + 256 * 13, 128 + 256 * 13,
                           128 + 256 * 2, 128 + 256 * 2,  128 + 256 * 13 };
    memcpy(in, fan, sizeof fan);
    in[6] = floorf((x + 1) / 2 * SIDE);
    in[7] = floorf((1 - y) / 2 * SIDE);
    return 1;
}
static const grade_task task = {
    .name = "07_coverage",
    .names = "x3 y3 i1 j1",
    .outputs = 1,
    .tolerance = 0,
    .yours = yours,
    .right = right,
    .cases = { { "triangles anywhere, of both windings", 4, anywhere,
                 "Compute the three edge functions at the centre of the pixel: inside, they "
                 "all have the sign of the area." },
               { "pixel centres on edges", 4, on_edges,
                 "On an edge, where an edge function is 0, the pixel belongs to the triangle "
                 "only if the edge is a top or a left one; at a corner both edges must be." } },
    .mistakes = { { "with_edges", with_edges,
                    "Pixels on an edge that two triangles share are drawn twice: an "
                    "edge owns its pixels only where it is a top or a left edge." },
                  { "without_edges", without_edges,
                    "Pixels on an edge that two triangles share are drawn by "
                    "neither: a top or a left edge owns the pixels on it." },
                  { "clockwise_alone", clockwise_alone,
                    "Triangles of the other winding are missing: with all "
                    "three edge functions negative a pixel is inside too." },
                  { "other_winding_alone", other_winding_alone,
                    "Triangles are missing whose corners go clockwise on the screen: with "
                    "all three edge functions positive a pixel is inside too." },
                  { "bottom_right", bottom_right,
                    "These are bottom and right edges: y runs down, so a top edge has the "
                    "triangle at larger y, a left edge at larger x." },
                  { "textbook", textbook,
                    "No edge function is negative: that draws triangles of one winding alone, "
                    "and pixels on a shared edge twice. Ask for the sign of the area first, "
                    "and on an edge whether it is a top or a left one." },
                  { "corner_of_pixel", corner_of_pixel,
                    "The pixel is tested at its corner: its centre is half a pixel on, at "
                    "(256 i + 128, 256 j + 128)." } },
    .place = place,
    .scale = 0.8f,
    .offset = 0.1f,
    .picture_points = 2,
};

int main(int argc, char **argv) { return grade_main(&task, argc, argv); }
