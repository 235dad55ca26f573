/* portrait.h - the picture of a model that thumbnail writes and compare compares: how large it is,
   from where the model is seen, what is behind it.

       portrait p = portrait_new();                     (then portrait_option by options_read)
       result = portrait_light(&light, &model, &p, &how, NULL, NULL);
       c = canvas_try(p.width, p.height, portrait_samples(&p));
       if (!result) result = portrait_draw(&c, &model, &light, &p, &how, NULL, NULL); */
#ifndef MODEL_PORTRAIT_H
#define MODEL_PORTRAIT_H

#include "../../shared/canvas.h"
#include "look.h"
#include "../read/read.h"
#include "../image/written.h"

#define PORTRAIT_USAGE                                                                             \
    "  --size WxH            pixels of the picture, 1x1 .. 8192x8192 (512x512)\n"                  \
    "  --background COLOR    RRGGBB, #RGB, black, white, grey, red, green, blue, yellow or\n"      \
    "                        orange; none: transparent, PNG only (a grey gradient)\n"              \
    "  --rotate DEG          turns the model about its upright axis, -36000 .. 36000 (30)\n"       \
    "  --samples 1|2|4       samples along each edge of a pixel (2; 4 up to 128x128 pixels)\n"

enum { PORTRAIT_GRADIENT, PORTRAIT_PLAIN, PORTRAIT_NONE }; /* backgrounds */

typedef struct portrait {
    int width, height, background, sized, rotated; /* sized, rotated: by an option */
    int samples;                                   /* 0: not said */
    float rotate;                                  /* radians */
    shade_vec3 background_color;
} portrait;

/* ---- options --------------------------------------------------------------------------------- */

static inline portrait portrait_new(void)
{
    portrait p = { .width = 512, .height = 512 };
    p.rotate = shade_radians(MODEL_FIRST_TURN);
    return p;
}

static inline int portrait_take_size(void *to, const char *value)
{
    portrait *p = (portrait *)to;
    p->sized = 1;
    return option_size(value, 8192, &p->width, &p->height);
}

/* Reads degrees and stores radians. */
static inline int portrait_take_rotate(void *to, const char *value)
{
    portrait *p = (portrait *)to;
    double degrees;
    const int taken = option_number(&value, -36000, 36000, &degrees) && !*value;
    p->rotated = 1;
    p->rotate = (float)(degrees * 0.017453292519943295);
    return taken;
}

static inline int portrait_take_background(void *to, const char *value)
{
    portrait *p = (portrait *)to;
    p->background = same_name(value, "none") ? PORTRAIT_NONE : PORTRAIT_PLAIN;
    return p->background == PORTRAIT_NONE || take_color(value, &p->background_color);
}

static const option_pair portrait_pair[] = { { "--rotate", "--view", 0 }, { NULL, NULL, 0 } };
static const option portrait_option[] = { { "--size", portrait_take_size, 0, 0, 0 },
                                          { "--rotate", portrait_take_rotate, 0, 0, 0 },
                                          { "--samples", option_samples,
                                            offsetof(portrait, samples), 0, 0 },
                                          { "--background", portrait_take_background, 0, 0, 0 },
                                          { NULL, NULL, 0, 0, 0 } };

/* Samples along each edge of a pixel.  Small pictures have four where they cost 10 to 40 ms more
   than two; at 256 x 256 pixels that would be 100 ms. */
static inline int portrait_samples(const portrait *p)
{
    return p->samples ? p->samples : p->width * p->height <= 128 * 128 ? 4 : 2;
}

/* Returns 1 where the options do not fit together; a line on stderr has said why. */
static inline int portrait_check(const portrait *p)
{
    const int samples = portrait_samples(p);
    if (p->width * samples <= 16384 && p->height * samples <= 16384) return 0;
    return complain("size times samples must stay within 16384");
}

/* ---- the camera, which sees all of a model, from as near as it can --------------------------- */

typedef struct camera {
    shade_mat4 view, projection;
    shade_vec3 eye;
} camera;

/* How far a model is turned about its upright axis */
static inline float portrait_turn(const portrait *p, const model_options *how)
{
    return how->viewed ? -how->azimuth : p->rotate;
}

/* The way toward the eye, where the model has been turned */
static inline shade_vec3 camera_toward(const model_options *how)
{
    const shade_vec4 e = shade_mat4_rotation(how->elevation, shade_v3(1, 0, 0)).col[1];
    return how->viewed ? shade_v3(0, e.z, e.y) : shade_v3(0, MODEL_FIRST_RISE, 1);
}

/* The camera looks along a fixed direction, the model has been turned.  Every point must lie inside
   four planes through the eye, and each plane gives one linear bound: their extremes give the
   nearest eye, and the sideways shift that centres. */
static inline camera camera_frame(const owned_mesh *m, float aspect, const model_options *how)
{
    const float half = shade_radians(14), margin = 1.10f;
    const shade_vec4 e = shade_mat4_rotation(how->elevation, shade_v3(1, 0, 0)).col[1];
    const shade_vec3 toward = camera_toward(how);
    const shade_vec3 up = how->viewed ? shade_v3(0, e.y, -e.z) : shade_v3(0, 1, 0);
    shade_mat4 turn = shade_mat4_look_at(toward, shade_v3(0, 0, 0), up);
    shade_mat4 lens, world;
    float slope_y, slope_x, left = -9, right = -9, below = -9, above = -9, front = -9, back = 9, d;
    camera c;
    turn.col[3] = shade_v4(0, 0, 0, 1);
    lens = shade_mat4_perspective(2 * half, 1, 1, 2);
    slope_y = 1 / lens.col[1].y;
    slope_x = slope_y * aspect;
    for (size_t i = 0; i < 3 * (size_t)m->view.vertex_count; i += 3) {
        const float *p = m->positions + i;
        shade_vec3 q = shade_mat4_transform_direction(turn, shade_v3(p[0], p[1], p[2]));
        right = fmaxf(right, q.x + slope_x * q.z);
        left = fmaxf(left, -q.x + slope_x * q.z);
        above = fmaxf(above, q.y + slope_y * q.z);
        below = fmaxf(below, -q.y + slope_y * q.z);
        front = fmaxf(front, q.z);
        back = fminf(back, q.z);
    }
    d = fmaxf((right + left) / (2 * slope_x), (above + below) / (2 * slope_y)) * margin;
    d = fmaxf(d, front + 0.05f);
    c.view = shade_mat4_mul(
        shade_mat4_translation(shade_v3((left - right) / 2, (below - above) / 2, -d)), turn);
    c.projection =
        shade_mat4_perspective(2 * half, aspect, 0.04f * (d - front) + 0.001f, d - back + 4);
    c.projection.col[0].x *= how->zoom;
    c.projection.col[1].y *= how->zoom;
    world = shade_mat4_inverse(c.view);
    c.eye = shade_v3(world.col[3].x, world.col[3].y, world.col[3].z);
    return c;
}
/* Makes a model ready for its portrait: cut open where the options say so, upright and turned.
   Returns 1 with a line on stderr. */
static inline int portrait_prepare(model *m, const portrait *p, const model_options *how)
{
    const float turn = portrait_turn(p, how);
    return model_cut(m, how, 1, turn, camera_toward(how)) || model_prepare(m, how, turn);
}

/* ---- the picture ----------------------------------------------------------------------------- */

static inline void portrait_background(const shade_target *target, const portrait *p)
{
    const shade_vec3 c = p->background_color;
    if (p->background == PORTRAIT_GRADIENT)
        canvas_gradient(target, shade_rgb(0xEEF0F3), shade_rgb(0xC3C8CF));
    else if (p->background == PORTRAIT_PLAIN)
        shade_clear(target, shade_v4(c.x, c.y, c.z, 1), 1);
    else
        shade_clear(target, shade_v4(0, 0, 0, 0), 1);
}

/* Opens the studio that the options want, or leaves it dark. */
static inline shade_result portrait_light(studio *light, const model *m, const portrait *p,
                                          const model_options *how, mesh_progress *progress,
                                          void *user)
{
    const int pixels = p->width > p->height ? p->width : p->height;
    if (how->quick) studio_open_quick(light);
    if (how->quick || (!look_has_shadows(how) && how->no_shadow)) return SHADE_OK;
    return studio_open(light, m, pixels, 0, how->threads, progress, user);
}

/* The data that all bands share, and the result of each band.  Bands of fewer rows would draw most
   triangles of a large model twice. */
enum { PORTRAIT_BANDS = 64, PORTRAIT_ROWS = 32 };
typedef struct portrait_work {
    const shade_target *target;
    const exhibit *exhibit;
    camera camera;
    int samples, bands;
    shade_result result[PORTRAIT_BANDS];
} portrait_work;

static inline void portrait_band(void *data, int band)
{
    portrait_work *w = (portrait_work *)data;
    const shade_target rows = bands_rows(w->target, band, w->bands);
    w->result[band] =
        exhibit_draw(w->exhibit, &rows, w->camera.view, w->camera.projection, w->samples);
}

/* What a program says where light or picture failed */
static inline const char *portrait_says(shade_result result)
{
    return result == SHADE_ERROR_CAPACITY ? "out of memory; see --max-memory"
                                          : shade_result_string(result);
}

static inline shade_result portrait_draw(const canvas *c, const model *m, const studio *light,
                                         const portrait *p, const model_options *how,
                                         mesh_progress *progress, void *user)
{
    exhibit e;
    portrait_work w = { .target = &c->target, .exhibit = &e };
    shade_result result = SHADE_ERROR_CAPACITY;
    w.samples = c->samples;
    w.bands = c->target.height / PORTRAIT_ROWS + 1;
    if (w.bands > PORTRAIT_BANDS) w.bands = PORTRAIT_BANDS;
    w.camera = camera_frame(&m->mesh, (float)p->width / (float)p->height, how);
    if (!exhibit_open(&e, m, light, how, w.camera.eye)) {
        portrait_background(&c->target, p);
        exhibit_aim(&e, shade_mat4_mul(w.camera.projection, w.camera.view));
        bands_run_told(how->threads, w.bands, portrait_band, &w, progress, user);
        result = SHADE_OK;
    }
    for (int i = 0; i < PORTRAIT_BANDS; i++)
        if (w.result[i]) result = w.result[i];
    exhibit_close(&e);
    return result;
}

/* ---- its file -------------------------------------------------------------------------------- */

/* 1: a file may become a PNG whose name does not say so, as file managers ask for with names of
   their own: it is new or empty, or is one. */
static inline int portrait_may_become_png(const char *name)
{
    static const char sign[4] = { (char)0x89, 'P', 'N', 'G' };
    char begin[4];
    size_t n;
    FILE *file = path_open(name, "rb");
    if (!file) return 1;
    n = fread(begin, 1, sizeof begin, file);
    fclose(file);
    return !n || (n == sizeof begin && !memcmp(begin, sign, n));
}

/* Finds out whether the picture of that name is a PNG; *png is what the options say.  Returns 1
   where the name is that of something else; a line on stderr has said so. */
static inline int portrait_name(const char *name, int *png)
{
    static const char *const ppm[] = { "ppm", NULL };
    static const char *const others[] = { "jpg",  "jpeg", "webp", "gif", "bmp", "tga", "tif",
                                          "tiff", "avif", "jxl",  "svg", "hdr", "pgm", NULL };
    const int free_name = !strcmp(name, "-") || save_is_device(name);
    if (model_has_name(name))
        return complain(
            "%s is a model: the names of pictures end in .ppm or .png (a call draws "
            "one model, --views several views of it; shade-sheets calls it for a "
            "folder of models)",
            name);
    if (save_is_png(name)) *png = 1;
    if (!*png && !free_name && !save_ends_in(name, ppm))
        return complain("%s: the names of pictures end in .ppm or .png", name);
    if (*png && !free_name && !save_is_png(name) &&
        (save_ends_in(name, ppm) || save_ends_in(name, others) || !portrait_may_become_png(name)))
        return complain("%s: the names of PNG pictures end in .png", name);
#ifndef MODEL_STB
    if (*png) return complain("PNG needs a %s built with stb (libstb-dev)", program_name);
#endif
    return 0;
}
#endif
