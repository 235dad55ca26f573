/* tables.c - compares the pixels that other programs drew, in tables/, with what shade.h draws by
   elsewhere.h.  Arguments: tables, and pictures of a whole ball beside them.

   A table has lines of words:
     within 1.5       by how many of 255 a byte may differ; 1.5 where it is not said
     shift x y        where in a pixel the program's ray goes, from the pixel's centre
     ambient .5       I_a of its scenes, grey; 1 where it is not said
     flat             perspective scales the ball, but draws it as parallel projection does
     pixels x,y ...   of pictures of 200 x 200
     case ...         the camera, a look and its lamps, as words.h reads them; then a line of the
                      bytes that the program drew, one word of six digits a pixel
   The ball has radius 1 and stands at the origin; the camera is at 0, 0, 5 (measure/ball.py). */
#define SHADE_IMPLEMENTATION
#include "shade.h"
#include "../words.h"
#include <stdio.h>

enum { SIZE = 200, MOST = 128 };

static int passed, failed;

typedef struct table {
    const char *name;
    float within, x, y, ambient; /* x, y: of shift */
    int flat;
    int count, at[MOST][2];
    long pixels;
    double worst, squares, compared;
    char where[100];
} table;

typedef struct view {
    elsewhere_look look;
    elsewhere_lamp lamps[ELSEWHERE_LAMPS];
    elsewhere_scene scene;
} view;

static void fail(const char *file, const char *said)
{
    printf("%s: %s\n", file, said);
    failed++;
}

/* Reads camera, look and lamps. */
static int read_view(const char *text, float ambient, view *v, char *said, size_t room)
{
    memset(v, 0, sizeof *v);
    v->scene.look = &v->look;
    v->scene.lamps = v->lamps;
    v->scene.ambient = shade_v3(ambient, ambient, ambient);
    v->scene.view = shade_mat4_translation(shade_v3(0, 0, -5));
    v->scene.parallel = !strncmp(text, "parallel ", 9);
    text += strcspn(text, " ") + 1;
    if (elsewhere_read(&text, &v->look, NULL, said, room)) return 1;
    for (text += strspn(text, " "); *text > ' '; text += strspn(text, " "))
        if (elsewhere_read(&text, NULL, &v->lamps[v->scene.lamp_count++], said, room)) return 1;
    if (!v->look.refused) return 0;
    snprintf(said, room, "refused: %s", v->look.refused);
    return 1;
}

/* Where the ray of a pixel meets the ball, out to .97 of its radius: 1, and *P is also N */
static int meet(const table *k, int parallel, float x, float y, int size, shade_vec3 *P)
{
    const float u = 2 * x / (float)size - 1, w = 1 - 2 * y / (float)size;
    const float t = tanf(shade_radians(15));
    shade_vec3 from = { 1.25f * u, 1.25f * w, 5 }, to = { 0, 0, -1 };
    float b, d;
    if (!parallel && k->flat) {
        from = shade_v3(5 * t * u, 5 * t * w, 5);
    } else if (!parallel) {
        from = shade_v3(0, 0, 5);
        to = shade_normalize(shade_v3(t * u, t * w, -1));
    }
    b = shade_dot(from, to);
    d = b * b - shade_dot(from, from) + 1;
    if (d < 1 - (k->flat ? .98f * .98f : .97f * .97f)) return 0;
    *P = shade_madd(from, -b - sqrtf(d), to);
    return 1;
}

/* Lights count points, each its own normal; rgb is in turn. */
static void light(const view *v, const shade_vec3 *points, int count, float (*rgb)[3])
{
    static float P[3 * SHADE_LANES], out[3 * SHADE_LANES];
    for (int first = 0; first < count; first += SHADE_LANES) {
        for (int i = 0; i < SHADE_LANES; i++) {
            const shade_vec3 p = points[first + i < count ? first + i : count - 1];
            P[i] = p.x;
            P[i + SHADE_LANES] = p.y;
            P[i + 2 * SHADE_LANES] = p.z;
        }
        elsewhere_lit_lanes(&v->scene, P, P, out);
        for (int i = 0; i < SHADE_LANES && first + i < count; i++)
            for (int k = 0; k < 3; k++) rgb[first + i][k] = out[i + k * SHADE_LANES];
    }
}

static void compare(table *t, int byte, float value, const char *text, int pixel)
{
    const double off = fabs((double)byte - 255 * (double)value);
    t->squares += off * off;
    t->compared++;
    if (off <= t->worst) return;
    t->worst = off;
    snprintf(t->where, sizeof t->where, "pixel %d, %.60s", pixel, text);
}

static void compare_case(table *t, const char *text, const char *bytes)
{
    shade_vec3 points[MOST];
    float rgb[MOST][3];
    char said[400];
    view v;
    if (read_view(text, t->ambient, &v, said, sizeof said)) {
        fail(t->name, said);
        return;
    }
    for (int i = 0; i < t->count; i++)
        if (!meet(t, v.scene.parallel, (float)t->at[i][0] + .5f + t->x,
                  (float)t->at[i][1] + .5f + t->y, SIZE, &points[i]))
            fail(t->name, "a pixel beside the ball");
    light(&v, points, t->count, rgb);
    for (int i = 0; i < t->count; i++, bytes += 7) {
        unsigned r, g, b;
        if (sscanf(bytes, "%2x%2x%2x", &r, &g, &b) != 3) {
            fail(t->name, "a line of bytes is too short");
            return;
        }
        compare(t, (int)r, rgb[i][0], text, i);
        compare(t, (int)g, rgb[i][1], text, i);
        compare(t, (int)b, rgb[i][2], text, i);
        t->pixels++;
    }
}

static void read_pixels(table *t, const char *text)
{
    int used;
    for (t->count = 0; t->count < MOST; t->count++, text += used) {
        int *at = t->at[t->count];
        if (sscanf(text, "%d,%d%n", &at[0], &at[1], &used) != 2) return;
    }
}

/* The ball of README: every pixel of a grey picture; its comment has the words. */
static void compare_ball(table *t, const char *path)
{
    static unsigned char grey[96 * 96];
    static shade_vec3 points[96 * 96];
    static float rgb[96 * 96][3];
    static int at[96 * 96];
    char head[600], said[400];
    int count = 0;
    view v;
    FILE *f = fopen(path, "rb");
    if (!f) return;
    if (!fgets(head, sizeof head, f) || !fgets(head, sizeof head, f) ||
        read_view(head + 2, t->ambient, &v, said, sizeof said) || !fgets(said, sizeof said, f) ||
        !fgets(said, sizeof said, f) || fread(grey, 1, sizeof grey, f) != sizeof grey)
        fail(path, said);
    else {
        for (int i = 0; i < 96 * 96; i++)
            if (meet(t, v.scene.parallel, (float)(i % 96) + .5f + t->x,
                     (float)(i / 96) + .5f + t->y, 96, &points[count]))
                at[count++] = i;
        light(&v, points, count, rgb);
        for (int i = 0; i < count; i++) compare(t, grey[at[i]], rgb[i][1], head + 2, at[i]);
        t->pixels += count;
    }
    fclose(f);
}

static void compare_table(const char *path)
{
    static char line[4000], bytes[4000];
    table t = { path, 1.5f, 0, 0, 1, 0, 0, { { 0 } }, 0, 0, 0, 0, "" };
    char ball[300];
    FILE *f = fopen(path, "r");
    if (!f) {
        fail(path, "cannot be opened");
        return;
    }
    while (fgets(line, sizeof line, f)) {
        line[strcspn(line, "\n")] = 0;
        sscanf(line, "within %f", &t.within);
        if (!strcmp(line, "flat")) t.flat = 1;
        sscanf(line, "ambient %f", &t.ambient);
        sscanf(line, "shift %f %f", &t.x, &t.y);
        if (!strncmp(line, "pixels ", 7)) read_pixels(&t, line + 7);
        if (!strncmp(line, "case ", 5) && fgets(bytes, sizeof bytes, f))
            compare_case(&t, line + 5, bytes);
    }
    fclose(f);
    snprintf(ball, sizeof ball, "%.*s.pgm", (int)(strlen(path) - 4), path);
    compare_ball(&t, ball);
    printf("%-40s %5ld pixels, d %.2f, r %.2f", path, t.pixels, t.worst,
           sqrt(t.squares / (t.compared > 0 ? t.compared : 1)));
    if (t.worst > (double)t.within) printf("  MORE THAN %g: %s", (double)t.within, t.where);
    puts("");
    if (t.pixels < 200) fail(path, "fewer than 200 pixels");
    if (t.worst > (double)t.within)
        failed++;
    else
        passed++;
}

int main(int argc, char **argv)
{
    for (int i = 1; i < argc; i++) compare_table(argv[i]);
    printf("%d passed, %d failed\n", passed, failed);
    return failed != 0;
}
