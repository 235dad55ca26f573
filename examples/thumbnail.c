/* thumbnail.c - one OBJ or STL file in, one lit picture of it out, on a machine without GPU or
   window.

   cc -O2 -I. examples/thumbnail.c -lm -o thumbnail && ./thumbnail bunny.obj bunny.ppm

   The model may have any scale and place: it is moved to the origin, made one unit large, and
   the camera stands as near as it can without cutting anything off.  The picture appears whole
   or not at all. */
#define SHADE_IMPLEMENTATION
#include "shade.h"
#include "mesh.h"
#include "canvas.h"
#include "model_read.h"
#include <time.h>

#define DEGREE 0.017453292f

static const char usage[] =
    "usage: thumbnail model.obj|model.stl out.ppm [options]\n"
    "  --size WxH            pixels of the picture, 1x1 .. 8192x8192 (512x512)\n"
    "  --material NAME       clay, or one of those that --material list prints (clay)\n"
    "  --model NAME          phong, blinn-phong, lambert, ambient, emissive, cool-to-warm\n"
    "                        (blinn-phong)\n"
    "  --shading NAME        fragment, vertex, face (fragment)\n"
    "  --rotate DEG          turns the model about its upright axis (30)\n"
    "  --up y|z              the model's upright axis (y for OBJ, z for STL)\n"
    "  --samples 1|2|4       samples along each edge of a pixel (2)\n"
    "  --help                this text\n";

typedef struct options {
    const char *input, *output;
    int width, height, samples, z_up;                /* z_up -1: by the kind of file */
    float rotate;
    shade_material material;
    shade_model model;
    shade_shading shading;
} options;

/* One line on stderr, and the exit code for it */
static int complain(const char *format, const char *what)
{
    fputs("thumbnail: ", stderr);
    fprintf(stderr, format, what);
    fputc('\n', stderr);
    return 1;
}

/* ---- command line --------------------------------------------------------------------------- */

/* Equal but for letters' case, and dashes or underlines for spaces */
static int same_name(const char *a, const char *b)
{
    for (;; a++, b++) {
        int x = *a == '-' || *a == '_' ? ' ' : *a, y = *b == '-' || *b == '_' ? ' ' : *b;
        if (x >= 'A' && x <= 'Z') x += 'a' - 'A';
        if (x != y) return 0;
        if (!x) return 1;
    }
}

/* The place of name in a list of n, or -1 */
static int find_name(const char *name, const char *const *list, int n)
{
    for (int i = 0; i < n; i++) if (same_name(name, list[i])) return i;
    return -1;
}

/* An integer from lowest to highest at *text, which moves behind it */
static int take_integer(const char **text, int lowest, int highest, int *out)
{
    long long value = 0;
    const char *begin = *text;
    for (; **text >= '0' && **text <= '9'; ++*text)
        if (value <= highest) value = value * 10 + (**text - '0');
    *out = (int)value;
    return *text > begin && value >= lowest && value <= highest;
}

static shade_material clay(void)
{
    shade_material m = { { 0, 0, 0 }, { 0.46f, 0.41f, 0.36f }, { 0.46f, 0.41f, 0.36f },
                         { 0.10f, 0.10f, 0.10f }, 30 };
    return m;
}

/* Returns 0 where the name is none. */
static int find_material(const char *name, shade_material *out)
{
    if (same_name(name, "clay")) *out = clay();
    else {
        int i = 0;
        while (i < SHADE_PRESET_COUNT && !same_name(name, shade_preset_name((shade_preset)i))) i++;
        if (i == SHADE_PRESET_COUNT) return 0;
        *out = shade_linear_material(shade_preset_material((shade_preset)i));
    }
    return 1;
}

/* One option and its value.  Returns 0 where the value is none of its. */
static int set_option(options *o, const char *name, const char *value)
{
    static const char *const models[] = { "blinn phong", "phong", "lambert", "ambient", "emissive",
                                          "cool to warm" };
    static const char *const shadings[] = { "fragment", "vertex", "face" };
    int k;
    if (!strcmp(name, "--size"))
        return take_integer(&value, 1, 8192, &o->width) && *value++ == 'x'
            && take_integer(&value, 1, 8192, &o->height) && !*value;
    if (!strcmp(name, "--samples")) {
        if (!take_integer(&value, 1, 4, &o->samples) || *value) return 0;
        return o->samples != 3;
    }
    if (!strcmp(name, "--rotate")) {
        char *end;
        double degrees = strtod(value, &end);
        o->rotate = (float)degrees * DEGREE;
        return end != value && !*end && degrees >= -36000 && degrees <= 36000;
    }
    if (!strcmp(name, "--up")) {
        o->z_up = !strcmp(value, "z");
        return o->z_up || !strcmp(value, "y");
    }
    if (!strcmp(name, "--material")) return find_material(value, &o->material);
    if (!strcmp(name, "--model")) {
        k = find_name(value, models, 6);
        if (k >= 0) o->model = (shade_model)k;
        return k >= 0;
    }
    k = find_name(value, shadings, 3);
    if (k >= 0) o->shading = (shade_shading)k;
    return k >= 0;
}

/* 0: go on; 1: failed; -1: all said */
static int read_options(options *o, int argc, char **argv)
{
    static const char *const names[] = { "--size", "--material", "--model", "--shading", "--rotate",
                                         "--up", "--samples" };
    for (int i = 1; i < argc; i++) {
        int k = 0;
        if (!strcmp(argv[i], "--help")) return fputs(usage, stdout), -1;
        if (strncmp(argv[i], "--", 2)) {
            if (!o->input) o->input = argv[i];
            else if (!o->output) o->output = argv[i];
            else return complain("one argument too many: %s", argv[i]);
            continue;
        }
        while (k < 7 && strcmp(argv[i], names[k])) k++;
        if (k == 7) return complain("unknown option %s (--help lists them)", argv[i]);
        if (i + 1 == argc) return complain("%s needs a value", argv[i]);
        if (k == 1 && !strcmp(argv[i + 1], "list")) {
            puts("clay");
            for (int m = 0; m < SHADE_PRESET_COUNT; m++) puts(shade_preset_name((shade_preset)m));
            return -1;
        }
        if (!set_option(o, argv[i], argv[i + 1])) {
            fprintf(stderr, "thumbnail: %s cannot be \"%s\" (--help says what)\n",
                    argv[i], argv[i + 1]);
            return 1;
        }
        i++;
    }
    if (!o->output) return fputs(usage, stderr), 1;
    if (o->width * o->samples > 16384 || o->height * o->samples > 16384)
        return complain("%s", "size times samples must stay within 16384");
    return 0;
}

/* ---- progress ------------------------------------------------------------------------------- */

/* Silent for the first second of work; then a line that rewrites itself */
typedef struct progress { clock_t begin; const char *what; int percent, shown; } progress;

static void report(void *user, double part)
{
    progress *p = (progress *)user;
    int percent = (int)(part * 100);
    if (percent == p->percent || clock() - p->begin < CLOCKS_PER_SEC) return;
    p->percent = percent, p->shown = 1;
    fprintf(stderr, "\r%s %3d %%", p->what, percent);
    fflush(stderr);
}
static void report_next(progress *p, const char *what)
{
    if (p->shown) fprintf(stderr, "\r%*s\r", (int)strlen(p->what) + 6, "");
    p->what = what, p->percent = -1, p->shown = 0;
}

/* ---- the scene ------------------------------------------------------------------------------ */

/* The camera looks along a fixed direction.  Every point must lie inside four planes through the
   eye, and each plane gives one linear bound: their extremes give the nearest eye, and the
   sideways shift that centres. */
static void frame_mesh(const owned_mesh *m, float aspect, shade_draw_state *state)
{
    const float half = 14 * DEGREE, margin = 1.08f;
    shade_mat4 turn = shade_mat4_look_at(shade_v3(0, 0.34f, 1), shade_v3(0, 0, 0),
                                         shade_v3(0, 1, 0));
    shade_mat4 to_eye, lens;
    float slope_y, slope_x, left = -9, right = -9, below = -9, above = -9, front = -9, back = 9, d;
    turn.col[3] = shade_v4(0, 0, 0, 1);
    to_eye = shade_mat4_mul(turn, state->model);
    lens = shade_mat4_perspective(2 * half, 1, 1, 2);
    slope_y = 1 / lens.col[1].y, slope_x = slope_y * aspect;
    for (size_t i = 0; i < 3 * (size_t)m->view.vertex_count; i += 3) {
        const float *p = m->positions + i;
        shade_vec3 q = shade_mat4_transform_direction(to_eye, shade_v3(p[0], p[1], p[2]));
        right = fmaxf(right, q.x + slope_x * q.z), left = fmaxf(left, -q.x + slope_x * q.z);
        above = fmaxf(above, q.y + slope_y * q.z), below = fmaxf(below, -q.y + slope_y * q.z);
        front = fmaxf(front, q.z), back = fminf(back, q.z);
    }
    d = fmaxf((right + left) / (2 * slope_x), (above + below) / (2 * slope_y)) * margin;
    d = fmaxf(d, front + 0.05f);
    state->view = shade_mat4_mul(
        shade_mat4_translation(shade_v3((left - right) / 2, (below - above) / 2, -d)), turn);
    state->projection = shade_mat4_perspective(2 * half, aspect, (d - front) * 0.9f + 0.001f,
                                               d - back + 0.1f);
}

/* Draws in portions, so that progress can be told.  Only back faces get their normals turned to the
   viewer: on front faces of a coarse mesh the spread normal leans away at the outline, and turned
   it would leave dark specks there. */
static shade_result draw_portions(const shade_target *target, shade_draw_state *state,
                                  shade_mesh mesh, progress *p)
{
    int count = mesh.index_count;
    shade_result result = SHADE_OK;
    for (int done = 0; done < count && !result; done += mesh.index_count) {
        mesh.index_count = count - done < 3 << 18 ? count - done : 3 << 18;
        state->raster.cull = SHADE_CULL_BACK, state->lighting.flags = 0;
        result = shade_draw_mesh(target, &mesh, state, NULL);
        state->raster.cull = SHADE_CULL_FRONT, state->lighting.flags = SHADE_FLAG_TWO_SIDED;
        if (!result) result = shade_draw_mesh(target, &mesh, state, NULL);
        mesh.indices += mesh.index_count;
        report(p, (double)done / count);
    }
    return result;
}

static shade_result draw_scene(const canvas *c, const owned_mesh *m, const options *o, progress *p)
{
    shade_light lights[3];
    shade_draw_state state = { 0 };
    lights[0] = shade_directional_light(shade_v3(0.7f, -0.9f, -0.6f),
                                        shade_v3(1.35f, 1.27f, 1.15f));
    lights[1] = shade_directional_light(shade_v3(-1, -0.15f, -0.35f),
                                        shade_v3(0.10f, 0.13f, 0.19f));
    lights[2] = shade_directional_light(shade_v3(-0.6f, -0.5f, 1),
                                        shade_v3(0.45f, 0.52f, 0.62f));
    state.model = shade_mat4_rotation(o->rotate, shade_v3(0, 1, 0));
    state.material = &o->material;
    state.lighting.lights = lights, state.lighting.light_count = 3;
    state.lighting.ambient = shade_v3(0.07f, 0.075f, 0.09f);
    state.lighting.model = o->model;
    state.lighting.cool = shade_v3(0.05f, 0.07f, 0.22f);
    state.lighting.warm = shade_v3(0.75f, 0.52f, 0.28f);
    state.shading = o->shading;
    frame_mesh(m, (float)o->width / (float)o->height, &state);
    canvas_gradient(&c->target, shade_v3(0.30f, 0.34f, 0.39f), shade_v3(0.08f, 0.09f, 0.105f));
    return draw_portions(&c->target, &state, m->view, p);
}

/* ---- output --------------------------------------------------------------------------------- */

/* Through a file beside it: whoever looks at path sees the old picture or the whole new one.
   Devices are written to directly, a rename would replace them. */
static int save(const char *path, const shade_target *picture)
{
    char *part = (char *)malloc(strlen(path) + 6);
    shade_result result;
    int failed = 0;
    if (!part) return complain("%s", "out of memory");
    strcpy(part, path);
    if (strncmp(path, "/dev/", 5)) strcat(part, ".part");
    errno = 0;
    result = shade_write_ppm(part, picture);
    if (result || (strcmp(part, path) && rename(part, path))) {
        fprintf(stderr, "thumbnail: %s: %s\n", path,
                errno ? strerror(errno) : shade_result_string(SHADE_ERROR_IO));
        if (strcmp(part, path)) remove(part);
        failed = 1;
    }
    free(part);
    return failed;
}

int main(int argc, char **argv)
{
    options o = { .width = 512, .height = 512, .samples = 2, .z_up = -1, .rotate = 30 * DEGREE };
    progress p = { clock(), "reading", -1, 0 };
    owned_mesh m;
    canvas c;
    shade_target picture;
    shade_result result;
    char error[400];
    int said;
    o.material = clay();
    said = read_options(&o, argc, argv);
    if (said) return said > 0;
    if (mesh_read_file_progress(o.input, &m, error, sizeof error, report, &p)) {
        report_next(&p, "");
        return complain("%s", error);
    }
    mesh_normalize(&m, o.z_up < 0 ? mesh_is_stl(o.input, NULL, 0) : o.z_up);
    report_next(&p, "drawing");
    c = canvas_new(o.width, o.height, o.samples);
    result = draw_scene(&c, &m, &o, &p);
    report_next(&p, "");
    picture = canvas_finish(&c);
    said = result ? complain("%s", shade_result_string(result)) : save(o.output, &picture);
    mesh_free(&m), free(c.target.color), free(c.target.depth);
    return said;
}
