/* ears.c - polygons cut into triangles by examples/kit/read/ears.h, against the polygon
   itself: n - 2 triangles, none turned over, areas that add up to the polygon's (so none overlaps
   another), each point inside in exactly one of them (by crossings of a ray), corners none but the
   polygon's. */
#define SHADE_IMPLEMENTATION
#include "shade.h"
#include "examples/kit/read/ears.h"
#include <time.h>

static int passed, failed;
static void check(int ok, const char *what, const char *shape)
{
    if (ok) {
        passed++;
    } else {
        failed++;
        printf("FAIL  %s: %s\n", shape, what);
    }
}

static uint32_t seed = 20240607;
static double random_unit(void)
{
    seed = seed * 1664525u + 1013904223u;
    return (seed >> 8) / 16777216.0;
}

/* A polygon in a plane of space: x, y of its own go to origin + x a + y b */
typedef struct polygon {
    size_t n;
    double *x, *y;
    float *p;
    uint32_t *index, *cut;
} polygon;

static polygon polygon_new(size_t n)
{
    polygon q = { n, calloc(n, 8), calloc(n, 8), calloc(3 * n, 4), calloc(n, 4), calloc(3 * n, 4) };
    if (!q.x || !q.y || !q.p || !q.index || !q.cut) exit(2);
    return q;
}

static void polygon_free(polygon *q)
{
    free(q->x);
    free(q->y);
    free(q->p);
    free(q->index);
    free(q->cut);
}

static double turn(const polygon *q, size_t a, size_t b, size_t c)
{
    return (q->x[b] - q->x[a]) * (q->y[c] - q->y[a]) - (q->y[b] - q->y[a]) * (q->x[c] - q->x[a]);
}

/* Crossings of the ray to the right are odd */
static int inside(const polygon *q, double x, double y)
{
    int odd = 0;
    for (size_t i = 0, k = q->n - 1; i < q->n; k = i++)
        if ((q->y[i] > y) != (q->y[k] > y) &&
            x < q->x[i] + (y - q->y[i]) * (q->x[k] - q->x[i]) / (q->y[k] - q->y[i]))
            odd = !odd;
    return odd;
}

static int holding(const polygon *q, double x, double y)
{
    int count = 0;
    for (size_t t = 0; t < q->n - 2; t++) {
        int in = turn(q, q->cut[3 * t], q->cut[3 * t + 1], q->cut[3 * t + 2]) != 0;
        for (size_t k = 0; k < 3; k++) {
            size_t a = q->cut[3 * t + k], b = q->cut[3 * t + (k + 1) % 3];
            double side = (q->x[b] - q->x[a]) * (y - q->y[a]) - (q->y[b] - q->y[a]) * (x - q->x[a]);
            if (side < 0) in = 0;
        }
        count += in;
    }
    return count;
}

/* Corners lie on a grid that floats hold exactly, sums of three included, and doubles their areas:
   multiples of 1/1024 below 64, or integers below 4.2 million. */
static void try_polygon(polygon *q, const char *shape)
{
    static const ears empty;
    ears e = empty;
    double area = 0, sum = 0, low[2] = { 1e9, 1e9 }, high[2] = { -1e9, -1e9 };
    int plane = (int)(random_unit() * 6), turned = 0, wrong = 0, used = 1;
    size_t first = (size_t)(random_unit() * (double)q->n);
    char *seen = calloc(q->n, 1);
    clock_t begin = clock();
    for (size_t i = 0; i < q->n; i++) {
        size_t at = (i + first) % q->n, k = i + 1 < q->n ? i + 1 : 0;
        float u = (float)q->x[i], v = (float)q->y[i], w = plane < 3 ? u : u + 2 * v;
        float *p = q->p + 3 * i;
        p[plane % 3] = plane < 3 ? 5 : w;
        p[(plane + 1) % 3] = u;
        p[(plane + 2) % 3] = v;
        q->index[at] = (uint32_t)i;
        area += q->x[i] * q->y[k] - q->x[k] * q->y[i];
        low[0] = fmin(low[0], q->x[i]);
        high[0] = fmax(high[0], q->x[i]);
        low[1] = fmin(low[1], q->y[i]);
        high[1] = fmax(high[1], q->y[i]);
    }
    check(!ears_cut(&e, q->p, q->index, q->n, q->cut), "memory", shape);
    for (size_t t = 0; t < q->n - 2; t++) {
        double a = turn(q, q->cut[3 * t], q->cut[3 * t + 1], q->cut[3 * t + 2]);
        sum += fabs(a);
        turned += area > 0 ? a < 0 : a > 0;
    }
    for (size_t i = 0; i < 3 * (q->n - 2); i++) seen[q->cut[i]] = 1;
    for (size_t i = 0; i < q->n; i++) used &= seen[i];
    check(!turned, "triangles are turned over", shape);
    check(sum == fabs(area), "the areas do not add up", shape);
    check(used, "a corner is in no triangle", shape);
    for (int k = 0; k < 200 && q->n < 2000 && area > 0; k++) {
        double x = low[0] + random_unit() * (high[0] - low[0]) + 1e-5;
        double y = low[1] + random_unit() * (high[1] - low[1]) + 1e-5;
        wrong += inside(q, x, y) != holding(q, x, y);
    }
    check(!wrong, "points inside are not in one triangle each", shape);
    check(clock() - begin < 20 * CLOCKS_PER_SEC, "takes too long", shape);
    if (q->n > 50000)
        printf("%s: %lu corners in %.2f s\n", shape, (unsigned long)q->n,
               (double)(clock() - begin) / CLOCKS_PER_SEC);
    ears_free(&e);
    free(seen);
}

static double grid(double v) { return floor(v * 1024 + 0.5) / 1024; }

/* Radii at random at angles in a row: a star around the middle, and a simple polygon */
static void star(size_t n, double radius, double least, const char *shape)
{
    polygon q = polygon_new(n);
    for (size_t i = 0; i < n; i++) {
        double a = 6.283185307179586 * (double)i / (double)n;
        double r = radius * (least + (1 - least) * random_unit());
        q.x[i] = radius < 64 ? grid(r * cos(a)) : floor(r * cos(a));
        q.y[i] = radius < 64 ? grid(r * sin(a)) : floor(r * sin(a));
    }
    try_polygon(&q, shape);
    polygon_free(&q);
}

/* Teeth on a back, each with points on its edges and some twice */
static void comb(size_t teeth, const char *shape)
{
    polygon q = polygon_new(6 * teeth + 2);
    size_t n = 0;
    for (size_t i = 0; i < teeth; i++) {
        double x = (double)i / 16, tall = 10 + (double)(i % 3);
        const double at[6][2] = {
            { x, 2 },           { x, 7 }, { x, tall }, { x + 1.0 / 32, tall }, { x + 1.0 / 32, 2 },
            { x + 1.0 / 32, 2 }
        };
        for (int k = 0; k < 6; k++) {
            q.x[n] = at[k][0];
            q.y[n++] = at[k][1];
        }
    }
    q.x[n] = q.x[n - 1];
    q.y[n++] = 0;
    q.x[n] = 0;
    q.y[n++] = 0;
    try_polygon(&q, shape);
    polygon_free(&q);
}

/* A band that winds inward and back */
static void spiral(size_t n, const char *shape)
{
    polygon q = polygon_new(2 * n);
    for (size_t i = 0; i < n; i++) {
        double t = (double)i / (double)n, a = 40 * t, r = 30 - 25 * t;
        q.x[i] = grid(r * cos(a));
        q.y[i] = grid(r * sin(a));
        q.x[2 * n - 1 - i] = grid((r - 1) * cos(a));
        q.y[2 * n - 1 - i] = grid((r - 1) * sin(a));
    }
    try_polygon(&q, shape);
    polygon_free(&q);
}

static void listed(const double *xy, size_t n, const char *shape)
{
    polygon q = polygon_new(n);
    for (size_t i = 0; i < n; i++) {
        q.x[i] = xy[2 * i];
        q.y[i] = xy[2 * i + 1];
    }
    try_polygon(&q, shape);
    for (size_t i = 0; i < n; i++) {
        q.x[i] = xy[2 * (n - 1 - i)];
        q.y[i] = xy[2 * (n - 1 - i) + 1];
    }
    try_polygon(&q, shape);
    polygon_free(&q);
}

int main(void)
{
    static const double dart[] = { 0, 0, 4, 0, 1, 1, 0, 4 };
    static const double square[] = { 0, 0, 1, 0, 2, 0, 4, 0, 4, 2, 4, 4, 2, 4, 0, 4, 0, 3, 0, 1 };
    static const double twice[] = { 0, 0, 0, 0, 4, 0, 4, 0, 4, 4, 4, 4, 4, 4, 0, 4 };
    static const double frame[] = { 0, 0, 6, 0, 6, 6, 0, 6, 0, 0, 2, 2, 2, 4, 4, 4, 4, 2, 2, 2 };
    static const double spike[] = { 0, 0, 4, 0, 4, 4, 2, 4, 2, 9, 2, 4, 0, 4 };
    static const double line[] = { 0, 0, 1, 1, 2, 2, 3, 3, 1, 1 };
    for (int k = 0; k < 20; k++) { /* each begins at some corner */
        listed(dart, 4, "dart");
        listed(square, 10, "corners on edges");
        listed(twice, 8, "corners twice");
        listed(frame, 10, "a hole behind a bridge");
        listed(spike, 7, "spike");
        listed(line, 5, "all on a line");
    }
    for (size_t n = 4; n < 60; n++) {
        star(n, 30, 0.2, "star");
        star(n, 30, 0.95, "nearly round");
    }
    star(1000, 4e6, 0.01, "sharp star");
    star(60000, 4e6, 0.3, "large star");
    star(300000, 4e6, 1, "disk");
    for (size_t n = 1; n < 12; n++) comb(n, "comb");
    comb(500, "large comb");
    spiral(12, "short spiral");
    spiral(400, "spiral");
    spiral(20000, "large spiral");
    printf("%d passed, %d failed\n", passed, failed);
    return failed != 0;
}
