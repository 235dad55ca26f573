/* main.c - every scene with shade.h and with OpenGL, pixel by pixel.

   conformance [--only TEXT] [--pictures FOLDER]
   A pixel agrees within 1/255 in each of R, G, B, A.  Fewer than 1 in 10,000 may not, and each of
   them must have a tie: its centre within 1/256 pixel of an edge of a triangle, of a texel that is
   not filtered, or of what a cutoff of alpha leaves.  Snapping to the grid of 1/256 moves a vertex
   by at most sqrt(2)/512 = 0.71/256, so that only there can two rasterizers that snap 1/256 apart
   at most put a pixel on different sides. */
#define SHADE_IMPLEMENTATION
#include "scenes.h"
#include <math.h>
#include <stdlib.h>
#include <string.h>

/* past MOST_EXPLAINED differences a scene has failed, and reasons cost time */
enum { PIXELS = WIDTH * HEIGHT, UNEXPLAINED_SHOWN = 8, MOST_EXPLAINED = 500 };

static scene now;
static uint32_t bytes[PIXELS];
static float depth[PIXELS], floats[4 * PIXELS], want[4 * PIXELS];
static double got[4 * PIXELS];    /* times 255, whatever the format */

/* -------------------------------------------------------------------------------- with shade.h */

static void paint_vertex(const void *uniforms, const shade_vertex_ids *SHADE_RESTRICT in,
                         shade_vertices *SHADE_RESTRICT out)
{
    const draw *d = (const draw *)uniforms;
    shade_mat4 m = shade_mat4_mul(d->state.projection, d->state.view);
    for (int i = 0; i < SHADE_LANES; i++) {
        const float *p = d->mesh.positions + 3 * in->index[i];
        const float *c = d->mesh.colors + 3 * in->index[i];
        shade_vec4 q = shade_mat4_transform(m, shade_v4(p[0], p[1], p[2], 1));
        out->clip[0][i] = q.x;
        out->clip[1][i] = q.y;
        out->clip[2][i] = q.z;
        out->clip[3][i] = q.w;
        for (int k = 0; k < 3; k++) out->varying[k][i] = c[k];
    }
}

static void paint_fragment(const void *uniforms, const shade_fragments *SHADE_RESTRICT in,
                           shade_colors *SHADE_RESTRICT out)
{
    float alpha = ((const draw *)uniforms)->alpha;
    for (int k = 0; k < 3; k++) memcpy(out->color[k], in->varying[k], sizeof in->varying[k]);
    SHADE_EACH_LANE(i) { out->color[3][i] = alpha; }
}

static shade_result draw_painted(const shade_target *t, const draw *d, shade_stats *stats)
{
    shade_pipeline p = { .vertex = paint_vertex, .fragment = paint_fragment, .uniforms = d,
                         .varyings = 3, .raster.cull = d->state.raster.cull,
                         .raster.depth_test = d->state.raster.depth_test,
                         .raster.blend = d->state.raster.blend,
                         .raster.depth_zero_to_one = d->state.raster.depth_zero_to_one,
                         .raster.depth_read_only = d->state.raster.depth_read_only,
                         .raster.depth_bias = d->state.raster.depth_bias };
    return shade_draw(t, &p, d->mesh.indices, d->mesh.index_count, d->mesh.vertex_count, stats);
}

static shade_result draw_lit(const shade_target *t, const draw *d, shade_stats *stats)
{
    shade_mesh m = { .positions = d->mesh.positions, .normals = d->mesh.normals };
    if (d->mesh.has_texcoords) m.texcoords = d->mesh.texcoords;
    if (d->mesh.has_colors) m.colors = d->mesh.colors;
    m.vertex_count = d->mesh.vertex_count;
    m.indices = d->mesh.indices;
    m.index_count = d->mesh.index_count;
    return shade_draw_mesh(t, &m, &d->state, stats);
}

static double unit(double x) { return x > 0 ? x < 1 ? x : 1 : 0; }

/* What the ball hides of each lamp, by shade_light_at_lanes; then what is left of the light */
static void ball_vertex(const void *uniforms, const shade_vertex_ids *SHADE_RESTRICT in,
                        shade_vertices *SHADE_RESTRICT out)
{
    const draw *d = ((const scene *)uniforms)->draws;
    paint_vertex(d, in, out);
    for (int i = 0; i < SHADE_LANES; i++)
        for (int k = 0; k < 3; k++) {
            out->varying[k][i] = d->mesh.positions[3 * in->index[i] + (uint32_t)k];
            out->varying[k + 3][i] = d->mesh.normals[3 * in->index[i] + (uint32_t)k];
        }
}

static void ball_fragment(const void *uniforms, const shade_fragments *SHADE_RESTRICT in,
                          shade_colors *SHADE_RESTRICT out)
{
    const scene *s = (const scene *)uniforms;
    const shade_draw_state *state = &s->draws[0].state;
    const shade_vec4 b = s->ball;
    float seen[MAX_LIGHTS][SHADE_LANES], L[3][SHADE_LANES];
    for (int j = 0; j < s->light_count; j++) {
        shade_light_at_lanes(&s->lights[j], in->varying[0], L[0], NULL);
        for (int i = 0; i < SHADE_LANES; i++) {
            shade_vec3 P = shade_v3(in->varying[0][i], in->varying[1][i], in->varying[2][i]);
            shade_vec3 c = shade_sub(shade_v3(b.x, b.y, b.z), P);
            shade_vec3 l = shade_v3(L[0][i], L[1][i], L[2][i]);
            float away = shade_length(shade_madd(c, -shade_dot(c, l), l));
            seen[j][i] = (float)unit((double)((away - b.w) / (0.5f * b.w)));
        }
    }
    const shade_rows rows = { .position = in->varying[0], .normal = in->varying[3],
                              .visibility = seen[0] };
    shade_lit_lanes(&state->lighting, state->material, s->eye, &rows, out->color[0]);
}

static shade_result draw_behind_ball(const shade_target *t, const scene *s, shade_stats *stats)
{
    const shape *m = &s->draws[0].mesh;
    shade_pipeline p = { .vertex = ball_vertex, .fragment = ball_fragment, .uniforms = s,
                         .varyings = 6 };
    return shade_draw(t, &p, m->indices, m->index_count, m->vertex_count, stats);
}

static shade_result draw_twin(const shade_target *t, const scene *s, shade_stats *stats)
{
    const shape *m = &s->draws[0].mesh;
    twin_uniforms u = scene_twin(s);
    shade_pipeline p = twin_pipeline(s->twin - 1);
    p.uniforms = &u;
    return shade_draw(t, &p, m->indices, m->index_count, m->vertex_count, stats);
}

static shade_result draw_any(const shade_target *t, const scene *s, const draw *d,
                             shade_stats *stats)
{
    shade_target depth_only = *t;
    depth_only.color = NULL;
    if (s->twin) return draw_twin(t, s, stats);
    if (s->ball.w > 0) return draw_behind_ball(t, s, stats);
    if (d->alpha > 0) return draw_painted(t, d, stats);
    return draw_lit(d->depth_only ? &depth_only : t, d, stats);
}

/* fragments drawn, or -1 */
static long long shade_picture(const scene *s)
{
    shade_target t;
    long long fragments = 0;
    memset(&t, 0, sizeof t);
    t.width = WIDTH;
    t.height = HEIGHT;
    t.depth = depth;
    t.srgb = s->srgb;
    t.format = s->format;
    t.color = s->format == SHADE_FORMAT_RGBA32F ? (void *)floats : (void *)bytes;
    if (shade_clear(&t, s->background, s->clear_depth) != SHADE_OK) return -1;
    for (int k = 0; k < s->draw_count; k++) {
        const draw *d = &s->draws[k];
        shade_stats stats;
        if (draw_any(&t, s, d, &stats) != SHADE_OK) return -1;
        fragments += stats.fragments;
    }
    for (int i = 0; i < 4 * PIXELS; i++) {
        int turned = s->format == SHADE_FORMAT_BGRA8 && i % 4 != 3 ? i / 4 * 4 + 2 - i % 4 : i;
        got[i] = s->format == SHADE_FORMAT_RGBA32F ? 255 * unit((double)floats[i])
                                                   : ((const unsigned char *)bytes)[turned];
    }
    return fragments;
}

/* ---------------------------------------------------------------------------------------- ties */

typedef struct point { double x, y, z, w; } point;

static point to_clip(const shade_draw_state *state, double x, double y, double z)
{
    shade_mat4 world = state->model.col[3].w != 0 ? state->model : shade_mat4_identity();
    shade_mat4 m = shade_mat4_mul(shade_mat4_mul(state->projection, state->view), world);
    const float *f = &m.col[0].x;
    double c[4];
    for (int k = 0; k < 4; k++)
        c[k] = (double)f[k] * x + (double)f[4 + k] * y + (double)f[8 + k] * z + (double)f[12 + k];
    point p = { c[0], c[1], c[2], c[3] };
    return p;
}

static point between(point a, point b, double t)
{
    point p = { a.x + t * (b.x - a.x), a.y + t * (b.y - a.y), a.z + t * (b.z - a.z),
                a.w + t * (b.w - a.w) };
    return p;
}

/* what of the line lies before the eye; the near plane cuts later than that */
static int in_front(point *a, point *b)
{
    const double least = 1e-3;
    if (a->w < least && b->w < least) return 0;
    if (a->w < least) *a = between(*a, *b, (least - a->w) / (b->w - a->w));
    else if (b->w < least) *b = between(*b, *a, (least - b->w) / (a->w - b->w));
    return 1;
}

/* the projected line passes within 1/256 of the centre of the pixel */
static int line_tie(point a, point b, double X, double Y)
{
    double ax, ay, bx, by, length2, t;
    if (!in_front(&a, &b)) return 0;
    ax = (a.x / a.w + 1) * WIDTH / 2 - X;
    ay = (1 - a.y / a.w) * HEIGHT / 2 - Y;
    bx = (b.x / b.w + 1) * WIDTH / 2 - X - ax;
    by = (1 - b.y / b.w) * HEIGHT / 2 - Y - ay;
    length2 = bx * bx + by * by;
    t = length2 > 0 ? -(ax * bx + ay * by) / length2 : 0;
    t = t < 0 ? 0 : t > 1 ? 1 : t;
    return hypot(ax + t * bx, ay + t * by) <= 1.0 / 256;
}

/* where the triangle a, b, c meets the plane of distance d: the edge that clipping makes */
static int cut_tie(const point *p, const double *d, double X, double Y)
{
    point cut[3];
    int count = 0;
    for (int k = 0; k < 3; k++) {
        int j = (k + 1) % 3;
        if ((d[k] < 0) != (d[j] < 0)) cut[count++] = between(p[k], p[j], d[k] / (d[k] - d[j]));
    }
    return count == 2 && line_tie(cut[0], cut[1], X, Y);
}

static int edge_tie(const draw *d, double X, double Y)
{
    for (int i = 0; i < d->mesh.index_count; i += 3) {
        point p[3];
        double near_d[3], far_d[3];
        for (int k = 0; k < 3; k++) {
            const float *v = d->mesh.positions + 3 * d->mesh.indices[i + k];
            p[k] = to_clip(&d->state, (double)v[0], (double)v[1], (double)v[2]);
            near_d[k] = d->state.raster.depth_zero_to_one ? p[k].z : p[k].z + p[k].w;
            if (d->state.raster.depth_test == SHADE_COMPARE_GREATER) near_d[k] = p[k].w - p[k].z;
            far_d[k] = p[k].w - p[k].z;
        }
        for (int k = 0; k < 3; k++)
            if (line_tie(p[k], p[(k + 1) % 3], X, Y)) return 1;
        if (cut_tie(p, near_d, X, Y) || cut_tie(p, far_d, X, Y)) return 1;
    }
    return 0;
}

/* Alpha of the map at a point of the window, on the floor: a bilinear blend, in double */
static double floor_alpha(const scene *s, double X, double Y)
{
    const shade_draw_state *t = &s->draws[0].state;
    const unsigned char *texel = (const unsigned char *)s->texels;
    point o = to_clip(t, 0, 0, 0), x = to_clip(t, 1, 0, 0), z = to_clip(t, 0, 0, 1);
    double nx = 2 * X / WIDTH - 1, ny = 1 - 2 * Y / HEIGHT, side = (double)s->seam, f[2], sum = 0;
    double a = x.x - o.x - nx * (x.w - o.w), b = z.x - o.x - nx * (z.w - o.w), p = nx * o.w - o.x;
    double c = x.y - o.y - ny * (x.w - o.w), d = z.y - o.y - ny * (z.w - o.w), q = ny * o.w - o.y;
    double at[2] = { (p * d - q * b) / (a * d - b * c) / side - 0.5,
                     (a * q - c * p) / (a * d - b * c) / side - 0.5 };
    for (int k = 0; k < 2; k++) f[k] = at[k] - floor(at[k]);
    for (int k = 0; k < 4; k++) {
        int i = (int)floor(at[0]) + (k & 1), j = (int)floor(at[1]) + (k >> 1);
        i = (i % MAP_SIDE + MAP_SIDE) % MAP_SIDE;
        j = (j % MAP_SIDE + MAP_SIDE) % MAP_SIDE;
        sum += (k & 1 ? f[0] : 1 - f[0]) * (k >> 1 ? f[1] : 1 - f[1]) *
               texel[4 * (j * MAP_SIDE + i) + 3];
    }
    return sum / 255 * (1 - (double)t->transparency);
}

/* the line on which alpha is the cutoff passes within 1/256 of the centre of the pixel */
static int cutoff_tie(const scene *s, double X, double Y)
{
    const double step = 1.0 / 256, cutoff = (double)s->draws[0].state.alpha_cutoff;
    int above = 0;
    if (!(cutoff > 0 && s->seam > 0) || s->map.filter == SHADE_FILTER_NEAREST) return 0;
    for (int k = 0; k < 4; k++)
        above += floor_alpha(s, X + step * ((k == 0) - (k == 1)),
                             Y + step * ((k == 2) - (k == 3))) >= cutoff;
    return above > 0 && above < 4;
}

/* SHADE_FILTER_NEAREST: the border between two texels is an edge too; their grid on the floor */
static int texel_tie(const scene *s, double X, double Y)
{
    const draw *d = &s->draws[0];
    double half = fabs((double)d->mesh.positions[0]), step = (double)s->seam;
    if (!(s->seam > 0) || s->map.filter != SHADE_FILTER_NEAREST) return 0;
    for (double at = -step * floor(half / step); at <= half; at += step) {
        const shade_draw_state *t = &d->state;
        if (line_tie(to_clip(t, at, 0, -half), to_clip(t, at, 0, half), X, Y)) return 1;
        if (line_tie(to_clip(t, -half, 0, at), to_clip(t, half, 0, at), X, Y)) return 1;
    }
    return 0;
}

static int explained(const scene *s, int i)
{
    double X = i % WIDTH + 0.5, Y = i / WIDTH + 0.5;
    for (int k = 0; k < s->draw_count; k++)
        if (edge_tie(&s->draws[k], X, Y)) return 1;
    return texel_tie(s, X, Y) || cutoff_tie(s, X, Y);
}

/* ---------------------------------------------------------------------------------- comparison */

/* largest difference of a channel, in steps of 1/255; 0.5 is the rounding to 8 bits */
static double difference(int i)
{
    double most = 0;
    for (int k = 0; k < 4; k++) {
        double off = fabs(got[4 * i + k] - 255 * unit((double)want[4 * i + k]));
        if (!(off <= most)) most = off;
    }
    return most;
}

static void write_ppm(const char *folder, const char *scene_name, const char *what, int which)
{
    char path[600];
    static unsigned char row[3 * WIDTH];
    FILE *f;
    snprintf(path, sizeof path, "%s/%s_%s.ppm", folder, scene_name, what);
    for (char *p = path + strlen(folder) + 1; *p; p++)
        if (strchr(" ,|", *p)) *p = '_';
    f = fopen(path, "wb");
    if (!f) return;
    fprintf(f, "P6\n%d %d\n255\n", WIDTH, HEIGHT);
    for (int i = 0; i < PIXELS; i++) {
        const double *a = got + 4 * i;
        for (int k = 0; k < 3; k++) {
            double b = 255 * unit((double)want[4 * i + k]), off = 32 * fabs(a[k] - b);
            double v = which == 0 ? a[k] : which == 1 ? b : off < 33 ? 0 : off < 255 ? off : 255;
            row[3 * (i % WIDTH) + k] = (unsigned char)(v + 0.5);
        }
        if (i % WIDTH == WIDTH - 1) fwrite(row, 1, sizeof row, f);
    }
    fclose(f);
}

/* 1: agrees */
static int compare(const scene *s, const char *folder, int keep)
{
    int over = 0, ties = 0, good;
    double most = 0, most_plain = 0;    /* of all; of those within 1/255 */
    long long fragments = shade_picture(s);
    gl_draw(s, want);
    for (int i = 0; i < PIXELS; i++) {
        double off = difference(i);
        if (!(off <= most)) most = off;
        if (off <= 1 && off > most_plain) most_plain = off;
        if (off <= 1) continue;
        over++;
        if (over <= MOST_EXPLAINED && explained(s, i)) ties++;
        else if (over - ties <= UNEXPLAINED_SHOWN) {
            const double *a = got + 4 * i;
            const float *b = want + 4 * i;
            printf("    %s: pixel %d, %d: %.2f %.2f %.2f %.2f, OpenGL has %.2f %.2f %.2f %.2f\n",
                   s->name, i % WIDTH, i / WIDTH, a[0], a[1], a[2], a[3], 255 * (double)b[0],
                   255 * (double)b[1], 255 * (double)b[2], 255 * (double)b[3]);
        }
    }
    /* a picture with next to nothing in it would prove nothing */
    good = fragments > PIXELS / 20 && over == ties && over * 10000LL <= PIXELS;
    printf("%-4s  %-35s %7d  %8.2f  %8.2f %6d %6d\n", good ? "ok" : "FAIL", s->name, PIXELS,
           most_plain, most, over, ties);
    if (!good || keep) {
        write_ppm(folder, s->name, "got", 0);
        write_ppm(folder, s->name, "want", 1);
        write_ppm(folder, s->name, "diff", 2);
    }
    return good;
}

int main(int count, char **argument)
{
    const char *only = "", *folder = "build", *why = gl_open();
    int passed = 0, failed = 0, keep = 0;
    for (int i = 1; i + 1 < count; i += 2) {
        if (strcmp(argument[i], "--only") == 0) only = argument[i + 1];
        if (strcmp(argument[i], "--pictures") == 0) {
            folder = argument[i + 1];
            keep = 1;
        }
    }
    if (why) {
        printf("left out: %s\n0 passed, 0 failed\n", why);
        return 0;
    }
    printf("shade.h and OpenGL %s; differences in steps of 1/255\n", gl_name());
    printf("      %-35s %7s  %8s  %8s %6s %6s\n", "scene", "pixels", "max <= 1", "max", "over 1",
           "ties");
    for (int i = 0; i < scene_count(); i++) {
        scene_build(&now, i);
        if (!strstr(now.name, only)) continue;
        if (compare(&now, folder, keep)) passed++;
        else failed++;
        fflush(stdout);
    }
    printf("%d passed, %d failed\n", passed, failed);
    return failed > 0;
}
