/* cases.c - runs cases.json against the core: cases.c, then the table's path.  Prints how many
   hold. */
#define _DEFAULT_SOURCE
#define SHADE_IMPLEMENTATION
#include "examples/kit/scene/renderer.h"
#include "examples/kit/core/camera.h"
#include "examples/kit/core/color.h"
#include "examples/kit/core/mjv.h"
#include "examples/kit/image/numbers.h"
#include "examples/kit/read/json.h"

enum { MOST = 64 };

typedef struct asked {
    const json_doc *j;
    uint32_t at;      /* the case */
    core_refusal why; /* what the core refuses of it */
} asked;

static uint32_t member(const asked *a, const char *name) { return json_member(a->j, a->at, name); }
static double number(const asked *a, const char *name)
{
    return json_number_at(a->j, member(a, name), NAN);
}

/* All numbers below a place, however deep: at most room of them.  Returns how many there are. */
static int numbers_at(const json_doc *j, uint32_t at, double *out, int room)
{
    int count = 0;
    for (uint32_t i = at; i < j->value[at].end; i++)
        if (j->value[i].kind == JSON_NUMBER && count < room)
            out[count++] = json_number_at(j, i, NAN);
    return count;
}

static int numbers(const asked *a, const char *name, double *out, int room)
{
    return numbers_at(a->j, member(a, name), out, room);
}

/* Within so much of the largest of them */
static int near(const double *got, const double *want, int count, double tolerance)
{
    double most = 0;
    for (int k = 0; k < count; k++) most = fmax(most, fabs(want[k]));
    for (int k = 0; k < count; k++)
        if (!(fabs(got[k] - want[k]) <= tolerance * most)) return 0;
    return 1;
}

static int near_camera(const asked *a, const core_camera *got)
{
    double view[MOST], projection[MOST];
    const uint32_t want = member(a, "want");
    numbers_at(a->j, json_member(a->j, want, "view"), view, MOST);
    numbers_at(a->j, json_member(a->j, want, "projection"), projection, MOST);
    return near(got->view, view, 12, 1e-9) && near(got->view + 12, view + 12, 4, 1e-9) &&
           near(got->projection, projection, 16, 1e-6);
}

static int run_color(asked *a)
{
    char *word = json_copy(a->j, member(a, "word"));
    double rgb[3], want[3] = { 0 };
    const int refused = !word || core_color(&a->why, "color", word, rgb);
    free(word);
    numbers(a, "want", want, 3);
    return !refused && near(rgb, want, 3, 1e-12);
}

static int run_colors(asked *a)
{
    double rows[MOST], want[MOST], got[MOST], alpha;
    float out[MOST];
    const int count = numbers(a, "rows", rows, MOST),
              whole = a->j->value[member(a, "whole")].kind == JSON_TRUE;
    if (core_colors(&a->why, "colors", rows, (size_t)count / 3, 3, whole, 0, out, &alpha)) return 0;
    for (int k = 0; k < count; k += 3) {
        const shade_vec3 c = shade_linear_from_srgb(shade_v3(out[k], out[k + 1], out[k + 2]));
        got[k] = (double)c.x;
        got[k + 1] = (double)c.y;
        got[k + 2] = (double)c.z;
    }
    return numbers(a, "want", want, MOST) == count && alpha == 1 && near(got, want, count, 2e-6);
}

static int run_look_at(asked *a)
{
    double eye[3], target[3], up[3];
    core_camera got;
    numbers(a, "eye", eye, 3);
    numbers(a, "target", target, 3);
    numbers(a, "up", up, 3);
    return !core_look_at(&a->why, eye, target, up, number(a, "fov"), number(a, "aspect"),
                         number(a, "near"), number(a, "far"), &got) &&
           near_camera(a, &got);
}

static int run_opencv(asked *a)
{
    double K[9], extrinsics[16], size[2];
    core_camera got;
    numbers(a, "K", K, 9);
    numbers(a, "extrinsics", extrinsics, 16);
    numbers(a, "size", size, 2);
    return !core_opencv(&a->why, K, extrinsics, (int)size[0], (int)size[1], number(a, "near"),
                        number(a, "far"), &got) &&
           near_camera(a, &got);
}

static int run_opengl(asked *a)
{
    double projection[16], pose[16];
    core_camera got;
    numbers(a, "projection", projection, 16);
    numbers(a, "pose", pose, 16);
    return !core_opengl(&a->why, projection, pose, &got) && near_camera(a, &got);
}

static int run_fit(asked *a)
{
    double points[MOST], view[2], size[2];
    float at[MOST];
    const int count = numbers(a, "points", points, MOST);
    core_side side = { .up = 2, .fov = number(a, "fov"), .margin = number(a, "margin") };
    core_cloud cloud;
    core_camera got;
    numbers(a, "view", view, 2);
    numbers(a, "size", size, 2);
    side.azimuth = view[0];
    side.elevation = view[1];
    side.width = (int)size[0];
    side.height = (int)size[1];
    side.ortho = a->j->value[member(a, "ortho")].kind == JSON_TRUE;
    for (int k = 0; k < count; k++) at[k] = (float)points[k];
    if (core_cloud_open(&a->why, &side, &cloud)) return 0;
    core_cloud_add(&cloud, at, NULL, (size_t)count / 3, NULL);
    core_fit(&cloud, &side, &got);
    return near_camera(a, &got);
}

static int run_faces(asked *a)
{
    double rows[MOST], want[MOST];
    uint32_t out[MOST];
    const int count = numbers(a, "rows", rows, MOST),
              height = (int)a->j->value[member(a, "rows")].count;
    const int64_t made = core_faces(&a->why, "faces", rows, (size_t)height, count / height,
                                    number(a, "vertices"), out);
    int same = numbers(a, "want", want, MOST) == made;
    for (int64_t k = 0; k < made && same; k++) same = out[k] == want[k];
    return same;
}

static int run_pose(asked *a)
{
    double m[16], want[3] = { 0 };
    numbers(a, "matrix", m, 16);
    numbers(a, "want", want, 3);
    renderer_scene *s = renderer_scene_open();
    renderer_object o = { .kind = RENDERER_SPHERE, .size = { 1, 1, 1 } };
    int same = s && renderer_add(s, &o, 1) == 0;
    if (!core_rigid(&a->why, "pose", m))
        same = same && renderer_pose(s, NULL, m, 1) == -1;
    else
        same = same && renderer_pose(s, NULL, m, 1) == 0;
    same = same && renderer_records(s, 0, &o, 1) == 1 && !a->why.code && near(o.place, want, 3, 0);
    renderer_scene_close(s);
    return same;
}

/* One step: what is done, and a number that is wanted or meant */
static int step_of(const asked *a, renderer_scene *s, uint32_t at)
{
    static const double still[16] = { 1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1 };
    const renderer_object o = { .kind = RENDERER_SPHERE, .size = { 1, 1, 1 } };
    renderer_object all[MOST];
    double n[MOST], m[16];
    const int count = numbers_at(a->j, at, n, MOST), number = count ? (int)n[0] : 0;
    memcpy(m, still, sizeof m);
    for (int k = 0; k < 3 && count == 4; k++) m[4 * k + 3] = n[k + 1];
    if (json_is(a->j, at + 1, "add")) return renderer_add(s, &o, 1) == number;
    if (json_is(a->j, at + 1, "remove")) return renderer_put_object(s, number, NULL, 0) == 1;
    if (json_is(a->j, at + 1, "pose")) return renderer_pose(s, &number, still, 1) == -1;
    if (json_is(a->j, at + 1, "move")) return renderer_pose(s, &number, m, 1) == -1;
    if (json_is(a->j, at + 1, "at"))
        return renderer_records(s, number, all, MOST) == 1 && near(all->place, n + 1, 3, 0);
    if (json_is(a->j, at + 1, "clear")) return renderer_put_all(s, NULL, 0);
    if (json_is(a->j, at + 1, "stale"))
        return renderer_pose(s, &number, still, 1) == -2 &&
               renderer_put_object(s, number, &o, 1) == -1;
    if (!json_is(a->j, at + 1, "objects") || renderer_records(s, -1, all, MOST) != count) return 0;
    for (int k = 0; k < count; k++)
        if (all[k].id != (int)n[k]) return 0;
    return 1;
}

static int run_handles(asked *a)
{
    renderer_scene *s = renderer_scene_open();
    const uint32_t steps = member(a, "steps");
    int same = s != NULL;
    for (uint32_t at = steps + 1; same && at < a->j->value[steps].end; at = a->j->value[at].end)
        same = step_of(a, s, at);
    renderer_scene_close(s);
    return same;
}

/* A square picture of ids or depth, by matrices by columns, of count objects or, where there are
   none, of the scene's */
static int draw(const renderer_scene *s, int size, const double *view, const double *projection,
                const renderer_object *objects, int count, int32_t *ids, float *depth)
{
    renderer_picture p = { .width = size, .height = size, .samples = 1, .channels = 3 };
    renderer *r = renderer_open();
    int failed;
    p.near_z = 0.01f;
    p.far_z = 1000;
    p.tolerance = 0.25f;
    p.objects = objects;
    p.object_count = count;
    p.ids = ids;
    p.depth = depth;
    memcpy(p.view, view, sizeof p.view);
    for (int k = 0; k < 16; k++) (&p.projection.col[k / 4].x)[k % 4] = (float)projection[k];
    failed = !r || renderer_draw(&r, 1, s, &p, 1, NULL);
    renderer_close(r);
    return failed;
}

/* Whether the case wants as many pixels of each object.  Round shapes lie within a quarter of a
   pixel of the true ones, along 3.545 roots of the area. */
static int counted(const asked *a, const int32_t *ids, int size)
{
    double want[MOST];
    const int count = numbers(a, "want", want, MOST);
    int seen[MOST] = { 0 };
    for (int i = 0; i < size * size; i++)
        if (ids[2 * i] >= 0) seen[ids[2 * i]]++;
    for (int i = 0; i < count; i++)
        if (!(fabs(seen[i] - want[i]) <= 3 + 0.886 * sqrt(want[i]))) return 0;
    return 1;
}

static int run_scene(asked *a)
{
    static int32_t ids[2 * 64 * 64];
    double balls[MOST], eye[3], target[3], far[3];
    const double up[3] = { 0, 0, 1 };
    const int count = numbers(a, "balls", balls, MOST) / 4, size = (int)number(a, "size");
    renderer_scene *s = renderer_scene_open();
    core_camera c;
    int same = s != NULL;
    numbers(a, "eye", eye, 3);
    numbers(a, "target", target, 3);
    numbers(a, "far", far, 3);
    for (int k = 0; k < 3; k++) {
        eye[k] += far[k];
        target[k] += far[k];
    }
    same = same && !core_look_at(&a->why, eye, target, up, number(a, "fov"), 1, 0.01, 1000, &c);
    for (int i = 0; i < count && same; i++) {
        renderer_object o = { .kind = RENDERER_SPHERE,
                              .turn = { 1, 0, 0, 0, 1, 0, 0, 0, 1 },
                              .rgba = { 1, 1, 1, 1 } };
        for (int k = 0; k < 3; k++) {
            o.place[k] = balls[4 * i + k] + far[k];
            o.size[k] = (float)balls[4 * i + 3];
        }
        same = renderer_add(s, &o, 1) == i;
    }
    same =
        same && !draw(s, size, c.view, c.projection, NULL, 0, ids, NULL) && counted(a, ids, size);
    renderer_scene_close(s);
    return same;
}

static int run_mjv(asked *a)
{
    static const double plain[MJV_GEOM] = { 2,
                                            -1,
                                            -1,
                                            0,
                                            0,
                                            0,
                                            5,
                                            [MJV_MAT] = 1,
                                            [MJV_MAT + 4] = 1,
                                            [MJV_MAT + 8] = 1,
                                            [MJV_RGBA + 3] = 1 };
    static int32_t ids[2 * 64 * 64];
    double balls[MOST], cameras[MOST], lamps[MOST], geoms[MOST / 4 * MJV_GEOM];
    const int count = numbers(a, "balls", balls, MOST) / 4, size = (int)number(a, "size");
    const int lights = numbers(a, "lights", lamps, MOST) / MJV_LAMP;
    renderer_object records[MOST / 4];
    int32_t pairs[MOST];
    renderer_scene *s = renderer_scene_open();
    mjv_seen seen;
    int same = s && numbers(a, "cameras", cameras, MOST) == 2 * MJV_CAMERA;
    same = same && !mjv_lights(&a->why, s, lamps, lights, 1);
    for (int i = 0; i < count; i++) {
        double *g = geoms + MJV_GEOM * i;
        memcpy(g, plain, sizeof plain);
        memcpy(g + MJV_POS, balls + 4 * i, 3 * sizeof *g);
        g[MJV_SIZE] = g[MJV_SIZE + 1] = g[MJV_SIZE + 2] = balls[4 * i + 3];
        g[MJV_OBJECT] = 7 + i;
    }
    if (same) mjv_aim(cameras, 1, &seen);
    same = same && mjv_records(geoms, count, 1, records, pairs) == count &&
           !draw(s, size, seen.view, seen.projection, records, count, ids, NULL) &&
           counted(a, ids, size);
    for (int i = 0; i < count && same; i++)
        same = pairs[2 * i + 2] == 7 + i && pairs[2 * i + 3] == 5;
    renderer_scene_close(s);
    return same;
}

static int run_ground(asked *a)
{
    const double up[3] = { 0, 1, 0 };
    double z[MOST], half[2], eye[3] = { 0, 0, 10 }, target[3] = { 0, 0, 0 }, got;
    float rows[MOST], depth[81];
    const int count = numbers(a, "heights", z, MOST);
    const int height = (int)a->j->value[member(a, "heights")].count;
    renderer_object o = { .turn = { 1, 0, 0, 0, 1, 0, 0, 0, 1 },
                          .size = { 1, 1, 1 },
                          .rgba = { 1, 1, 1, 1 } };
    heights h = { .z = rows, .rows = height, .columns = count / height, .scale = 1 };
    renderer_scene *s = renderer_scene_open();
    core_camera c;
    int same = s != NULL;
    for (int k = 0; k < count; k++) rows[k] = (float)z[k];
    numbers(a, "half", half, 2);
    numbers(a, "at", eye, 2);
    memcpy(h.half, half, sizeof half);
    memcpy(target, eye, 2 * sizeof *eye);
    same = same && heights_set(s, 0, &h) == 2 * (h.rows - 1) * (h.columns - 1) &&
           renderer_add(s, &o, 1) == 0 &&
           !core_look_at(&a->why, eye, target, up, 45, 1, 0.01, 1000, &c) &&
           !draw(s, 9, c.view, c.projection, NULL, 0, NULL, depth);
    renderer_scene_close(s);
    got = (double)depth[40];
    z[0] = number(a, "want");
    return same && near(&got, z, 1, 1e-5);
}

static int run_local(asked *a)
{
    double points[MOST], faces[MOST], want[MOST], wanted[3], origin[3], got[MOST];
    float local[MOST];
    uint32_t corner[MOST];
    const int count = numbers(a, "points", points, MOST),
              corners = numbers(a, "faces", faces, MOST);
    for (int k = 0; k < corners; k++) corner[k] = (uint32_t)faces[k];
    numbers(a, "origin", wanted, 3);
    if (build_local(points, (size_t)count / 3, corner, (size_t)corners, local, origin)) return 0;
    for (int k = 0; k < count; k++) got[k] = (double)local[k];
    return numbers(a, "want", want, MOST) == count && near(got, want, count, 1e-7) &&
           near(origin, wanted, 3, 0);
}

/* Numbers of 16 bits: of depth in a unit, or of objects */
static int run_depth(asked *a)
{
    double depth[MOST], want[MOST];
    float rows[MOST];
    uint16_t grey[MOST];
    const int count = numbers(a, "depth", depth, MOST);
    int same = numbers(a, "want", want, MOST) == count;
    for (int k = 0; k < count; k++) rows[k] = (float)depth[k];
    if (numbers_from_depth(&a->why, "depth", rows, (size_t)count, number(a, "unit"), grey))
        return 0;
    for (int k = 0; k < count; k++) same &= grey[k] == want[k];
    return same;
}

static int run_ids(asked *a)
{
    double ids[MOST], want[MOST];
    int32_t rows[MOST];
    uint16_t grey[MOST];
    const int count = numbers(a, "ids", ids, MOST);
    int same = numbers(a, "want", want, MOST) == count;
    for (int k = 0; k < count; k++) rows[k] = (int32_t)ids[k];
    if (numbers_from_ids(&a->why, "ids", rows, (size_t)count, 1, grey)) return 0;
    for (int k = 0; k < count; k++) same &= grey[k] == want[k];
    return same;
}

typedef struct runner {
    const char *call;
    int (*run)(asked *a);
} runner;

static const runner runners[] = {
    { "color", run_color },   { "colors", run_colors }, { "look_at", run_look_at },
    { "opencv", run_opencv }, { "opengl", run_opengl }, { "fit", run_fit },
    { "faces", run_faces },   { "pose", run_pose },     { "handles", run_handles },
    { "scene", run_scene },   { "depth", run_depth },   { "ids", run_ids },
    { "mjv", run_mjv },       { "ground", run_ground }, { "local", run_local },
};

/* Whether the core refuses just what the case says, if it says so */
static int holds(asked *a, int same)
{
    const uint32_t refused = member(a, "refused");
    char *argument = json_copy(a->j, refused + 1), *text = json_copy(a->j, refused + 2);
    int right = refused ? argument && text && a->why.code && !strcmp(argument, a->why.argument) &&
                              !strncmp(text, a->why.text, strlen(text))
                        : same && !a->why.code;
    free(argument);
    free(text);
    return right;
}

static int run(const json_doc *j, uint32_t at)
{
    asked a = { .j = j, .at = at };
    for (size_t k = 0; k < sizeof runners / sizeof *runners; k++) {
        if (!json_is(j, member(&a, "call"), runners[k].call)) continue;
        return holds(&a, runners[k].run(&a));
    }
    return 0;
}

int main(int argc, char **argv)
{
    static char bytes[1 << 20], error[200];
    FILE *file = argc > 1 ? fopen(argv[1], "rb") : NULL;
    const size_t size = file ? fread(bytes, 1, sizeof bytes, file) : 0;
    mesh_reader r = mesh_of((const unsigned char *)bytes, size, "cases.json", error, sizeof error);
    json_doc j = { 0 };
    int good = 0, all = 0;
    if (!size || json_read(&r, &j)) {
        printf("cases: no table %s\n", error);
        return 1;
    }
    const uint32_t list = json_member(&j, JSON_ROOT, "cases");
    for (uint32_t at = list + 1; at < j.value[list].end; at = j.value[at].end, all++) {
        const int right = run(&j, at);
        good += right;
        if (!right) printf("case %d: %.*s\n", all, 160, bytes + j.value[at].from);
    }
    printf("cases: %d of %d hold in C\n", good, all);
    fclose(file);
    free(j.value);
    return good != all || all < 400;
}
