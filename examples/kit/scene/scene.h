/* scene.h - the scene of view and batch: a model above its soft shadow, turning between lamps that
   stay with the viewer, and the keys that change how it is lit.

   It has two lights.  The studio of thumbnail, with its shadows and reflections, is lit for one
   frame at a time by scene_light; four lamps without shadows are quick enough for a model that
   turns before somebody's eyes. */
#ifndef MODEL_SCENE_H
#define MODEL_SCENE_H

#include "../../shared/bands.h"
#include "../../shared/shapes.h"
#include "look.h"
#include "../draw/outline.h"
#include "../read/read.h"

/* Keys beyond characters: the arrows, and with shift */
enum {
    KEY_UP = 256,
    KEY_DOWN,
    KEY_LEFT,
    KEY_RIGHT,
    KEY_MOVE_UP,
    KEY_MOVE_DOWN,
    KEY_MOVE_LEFT,
    KEY_MOVE_RIGHT
};

/* The choices that keys step through: a small letter forward, its capital back */
enum {
    CHOICE_MATERIAL,
    CHOICE_SHADING,
    CHOICE_LAMP,
    CHOICE_TERM,
    CHOICE_MODEL,
    CHOICE_FLAG,
    CHOICE_BACKDROP,
    CHOICE_WIRE,
    CHOICE_GROUND,
    CHOICES
};
enum { LAMP_STUDIO, LAMP_SUN, LAMP_NEAR, LAMP_SPOT, LAMP_COLORS, LAMP_EYE };
enum { BACKDROP_DUSK, BACKDROP_DAYLIGHT, BACKDROP_BLACK };
enum { WIRE_OFF, WIRE_OVER, WIRE_ALONE };

typedef struct scene_choice {
    const char *what, *name[6];
    int count;
    char key;
} scene_choice;
static const scene_choice scene_choices[CHOICES] = {
    { "material", { "as the file says" }, 1 + SHADE_PRESET_COUNT, 'm' },
    { "shading", { "per fragment", "per vertex", "per face" }, 3, 's' },
    { "lamp", { "studio", "sun", "near", "spot", "two colors", "at the eye" }, 6, 'l' },
    { "terms", { "all", "ambient", "diffuse", "specular" }, 4, 't' },
    { "model",
      { "Blinn-Phong", "Phong", "Lambert", "ambient", "emissive", "cool to warm" },
      6,
      'e' },
    { "flag",
      { "none", "ungated specular", "weighted specular", "two-sided abs", "infinite viewer" },
      5,
      'f' },
    { "background", { "dusk", "daylight", "black" }, 3, 'b' },
    { "wires", { "off", "over", "alone" }, 3, 'w' },
    { "ground", { "shadow", "none" }, 2, 'g' },
};

/* What keys do, from the sixteenth character on: for a list on the screen and the usage */
#define SCENE_KEYS(KEY)                                                                            \
    KEY("arrows mouse   turn")                                                                     \
    KEY("shift + these  move; the other buttons too")                                              \
    KEY("+ - wheel      zoom")                                                                     \
    KEY("space          turn by itself, or not")                                                   \
    KEY("m s l t        material, shading, lamp, terms")                                           \
    KEY("e f            model, flag")                                                              \
    KEY("b w g          background, wires, ground")                                                \
    KEY("capitals       step back")                                                                \
    KEY("r              as at first")                                                              \
    KEY("p              save the picture")                                                         \
    KEY("h ?            this help")                                                                \
    KEY("q              quit")
#define SCENE_HELP_LINE(keys) keys,
static const char *const scene_help[] = { SCENE_KEYS(SCENE_HELP_LINE) };
enum { SCENE_HELP = sizeof scene_help / sizeof *scene_help };

#define SCENE_LENS 0.42f /* the vertical angle that the camera sees, in radians */
#define SCENE_FAR 1.5f   /* the farthest place of the model, in half heights of the picture */
#define SCENE_USAGE                                                                                \
    "  --again STATE         as the key p of view has said: AZIMUTH,ELEVATION,ZOOM,RIGHT,UP and\n" \
    "                        keys; what --view frames and cuts stays\n"

typedef struct scene {
    model model; /* about the origin, the farthest point at distance 1 */
    model_options how;
    float yaw, pitch, zoom;
    shade_vec2 place; /* of the model, right and up in half heights of the picture, at zoom 1 */
    int turning, choice[CHOICES];
    int flat; /* the model has the normals of its faces */
    int turning_at_home, home[CHOICES];
    const char *title; /* the name of the model's file */
    char said[64];     /* the effect of the last key */
    ground shadow;
    wires wires;       /* without points until they are shown */
    outline outline;   /* found with the wires */
    float wire_length; /* their mean */
    shade_vec3 *few;   /* instead of wires too dense to be parted: those of the outline */
    int few_points;    /* 0: all wires are drawn */
    int lit;           /* the next picture is one in the light of the studio */
    studio studio;
    exhibit exhibit;
    model_options shown; /* how it is lit, by the choices */
} scene;

/* What is shown, and how it begins; zeroed but for how, of model_options_new: the teapot */
typedef struct scene_request {
    const char *model; /* its file; NULL: the teapot */
    int pieces;        /* of the teapot along each edge of a patch; 0: 20 */
    int still, dark;   /* does not turn by itself; has a black background */
    const char *again; /* the state that scene_again has told; NULL: as at first */
    model_options how;
} scene_request;

/* The place of the scene for a picture of a given shape, and the part of the backdrop, 0 .. 1
   from its top, that the picture shows */
typedef struct scene_camera {
    shade_mat4 model, view, projection;
    float top, bottom;
} scene_camera;

/* Frames a second, counted over half seconds; 0: not yet */
typedef struct frame_rate {
    double since;
    int counted, rate;
} frame_rate;

static inline void frame_rate_count(frame_rate *f, double now)
{
    f->counted++;
    if (now - f->since < 0.5) return;
    f->rate = f->since > 0 ? (int)(f->counted / (now - f->since) + 0.5) : 0;
    f->counted = 0;
    f->since = now;
}

/* ---- the model ------------------------------------------------------------------------------ */

/* How the model stands after loading */
static inline float scene_home_yaw(const scene *s)
{
    return s->how.viewed ? -s->how.azimuth : shade_radians(MODEL_FIRST_TURN);
}
static inline float scene_home_pitch(const scene *s)
{
    return s->how.viewed ? s->how.elevation : (float)atan((double)MODEL_FIRST_RISE);
}

/* From where the camera sees it then */
static inline shade_vec3 scene_home_eye(const scene *s)
{
    const shade_vec4 turned = shade_mat4_rotation(scene_home_pitch(s), shade_v3(1, 0, 0)).col[1];
    return shade_v3(0, turned.z, turned.y);
}

/* Restores the state after loading. */
static inline void scene_go_home(scene *s)
{
    s->yaw = scene_home_yaw(s);
    s->pitch = scene_home_pitch(s);
    s->zoom = s->how.zoom;
    s->place = shade_v2(0, 0);
    s->turning = s->turning_at_home;
    memcpy(s->choice, s->home, sizeof s->choice);
}

/* The name of a file without its folders */
static inline const char *scene_title(const char *path)
{
    const char *slash = strrchr(path, '/');
    return slash && slash[1] ? slash + 1 : path;
}

/* The teapot as a model of one part.  Returns 1 where memory is out. */
static inline int scene_teapot(model *m, int across)
{
    m->mesh = shape_teapot(across > 0 ? across : 20);
    m->normals_given = 1;
    m->part = (model_part *)calloc(1, sizeof *m->part);
    if (!m->part) return complain("out of memory");
    m->part->count = m->mesh.view.index_count;
    m->part_count = 1;
    return 0;
}

/* What the choices of keys are at first */
static inline void scene_choose(scene *s, const scene_request *o)
{
    s->turning_at_home = !o->still;
    if (!o->model && !o->how.plain) s->home[CHOICE_MATERIAL] = 1 + SHADE_PRESET_BRONZE;
    if (o->dark) s->home[CHOICE_BACKDROP] = BACKDROP_BLACK;
    s->home[CHOICE_GROUND] = o->how.no_shadow;
    s->home[CHOICE_MODEL] = (int)o->how.model;
    s->home[CHOICE_SHADING] = o->how.shading == SHADE_SHADING_PER_VERTEX ? 1
                              : o->how.shading == SHADE_SHADING_PER_FACE ? 2
                                                                         : 0;
    s->flat = o->how.shading == SHADE_SHADING_PER_FACE;
    scene_go_home(s);
}

static inline void scene_close(scene *s)
{
    model_free(&s->model);
    ground_free(&s->shadow);
    exhibit_close(&s->exhibit);
    studio_close(&s->studio);
    outline_free(&s->outline);
    wires_free(&s->wires);
    free(s->few);
}

/* Finds every edge once, as pairs of points; none where memory is out. */
static inline void scene_find_wires(scene *s)
{
    outline *o = &s->outline;
    const size_t room = outline_find(o, &s->model) ? 0 : 2 * (size_t)o->count;
    double length = 0;
    wires *w = &s->wires;
    w->point = (shade_vec3 *)malloc((room + 1) * sizeof *w->point);
    s->few = (shade_vec3 *)malloc((room + 1) * sizeof *s->few);
    w->points = w->point && s->few && room <= INT_MAX ? (int)room : 0;
    for (int i = 0; i < w->points; i += 2) {
        w->point[i] = outline_place(o, o->edge[i / 2].a);
        w->point[i + 1] = outline_place(o, o->edge[i / 2].b);
        length += (double)shade_length(shade_sub(w->point[i + 1], w->point[i]));
    }
    s->wire_length = (float)(length / fmax(1, w->points / 2));
    if (wires_find_runs(w)) w->points = 0;
}

/* The model's name and size */
typedef struct scene_words {
    char text[64];
} scene_words;
static inline scene_words scene_caption(const scene *s)
{
    scene_words w;
    int n = s->model.mesh.view.index_count / 3;
    snprintf(w.text, sizeof w.text, "%.32s, %d triangle%s", s->title, n, n == 1 ? "" : "s");
    return w;
}

/* ---- keys ----------------------------------------------------------------------------------- */

static inline const char *scene_choice_name(int choice, int value)
{
    if (choice == CHOICE_MATERIAL && value) return shade_preset_name((shade_preset)(value - 1));
    return scene_choices[choice].name[value];
}

static inline void scene_step(scene *s, int choice, int step)
{
    const scene_choice *c = &scene_choices[choice];
    s->choice[choice] = (s->choice[choice] + step + c->count) % c->count;
    snprintf(s->said, sizeof s->said, "%s %s", c->what,
             scene_choice_name(choice, s->choice[choice]));
    if (choice == CHOICE_WIRE && s->choice[choice] && !s->wires.point) scene_find_wires(s);
}

static inline void scene_turn(scene *s, float right, float down)
{
    s->yaw = fmodf(s->yaw + right, 6.2831853f);
    s->pitch = fmaxf(-1.57f, fminf(1.57f, s->pitch + down));
}

static inline void scene_zoom(scene *s, float factor)
{
    s->zoom = fmaxf(0.2f, fminf(20, s->zoom * factor));
}

/* Moves the model in the picture by parts of its half height. */
static inline void scene_move(scene *s, float right, float up)
{
    s->place.x = fmaxf(-SCENE_FAR, fminf(SCENE_FAR, s->place.x + right / s->zoom));
    s->place.y = fmaxf(-SCENE_FAR, fminf(SCENE_FAR, s->place.y + up / s->zoom));
}

/* Gives a scene that began with a black background the usual one. */
static inline void scene_lighten(scene *s)
{
    if (s->home[CHOICE_BACKDROP] != BACKDROP_BLACK) return;
    s->home[CHOICE_BACKDROP] = s->choice[CHOICE_BACKDROP] = 0;
}

/* Returns 1 where the key belongs to the scene. */
static inline int scene_key(scene *s, int key)
{
    const float step = 0.12f;
    *s->said = 0;
    switch (key) {
    case KEY_UP: scene_turn(s, 0, -step); return 1;
    case KEY_DOWN: scene_turn(s, 0, step); return 1;
    case KEY_LEFT: scene_turn(s, -step, 0); return 1;
    case KEY_RIGHT: scene_turn(s, step, 0); return 1;
    case KEY_MOVE_UP: scene_move(s, 0, step); return 1;
    case KEY_MOVE_DOWN: scene_move(s, 0, -step); return 1;
    case KEY_MOVE_LEFT: scene_move(s, -step, 0); return 1;
    case KEY_MOVE_RIGHT: scene_move(s, step, 0); return 1;
    case '+':
    case '=': scene_zoom(s, 1.1f); return 1;
    case '-':
    case '_': scene_zoom(s, 1 / 1.1f); return 1;
    case ' ': s->turning = !s->turning; return 1;
    case 'r': scene_go_home(s); return 1;
    }
    for (int k = 0; k < CHOICES; k++) {
        if (key != scene_choices[k].key && key != scene_choices[k].key - 'a' + 'A') continue;
        scene_step(s, k, key == scene_choices[k].key ? 1 : -1);
        return 1;
    }
    return 0;
}

/* ---- the state as an option, and loading ----------------------------------------------------- */

typedef struct scene_state_words {
    char text[240];
} scene_state_words;

/* What --again takes: how the model stands in degrees, its zoom and place, and the keys that lead
   from the first choices to these. */
static inline scene_state_words scene_again(const scene *s)
{
    const double degree = 57.295779513082321;
    const double turned = -(double)s->yaw * degree, raised = (double)s->pitch * degree;
    scene_state_words w;
    size_t n = (size_t)snprintf(w.text, sizeof w.text, "%.9g,%.9g,%.9g,%.9g,%.9g", turned, raised,
                                (double)s->zoom, (double)s->place.x, (double)s->place.y);
    int keys = 0;
    for (int k = 0; k < CHOICES; k++) {
        const scene_choice *c = &scene_choices[k];
        const int ahead = (s->choice[k] - s->home[k] + c->count) % c->count;
        const int back = 2 * ahead > c->count ? c->count - ahead : 0;
        for (int i = 0; i < (back ? back : ahead) && n + 2 < sizeof w.text; i++) {
            if (!keys++) w.text[n++] = ',';
            w.text[n++] = (char)(back ? c->key - 'a' + 'A' : c->key);
        }
    }
    w.text[n] = 0;
    return w;
}

/* Reads the five numbers of a state.  Returns where its keys begin, or NULL. */
static inline const char *scene_again_read(const char *state, double number[5])
{
    static const double low[5] = { -36000, -90, 0.05, (double)-SCENE_FAR, (double)-SCENE_FAR };
    static const double high[5] = { 36000, 90, 20, (double)SCENE_FAR, (double)SCENE_FAR };
    for (int k = 0; k < 5; k++)
        if (!view_number(&state, low[k], high[k], &number[k]) || (!*state && k < 4)) return NULL;
    for (const char *c = state; *c; c++) {
        int known = 0;
        for (int k = 0; k < CHOICES; k++) known |= (*c | 32) == scene_choices[k].key;
        if (!known) return NULL;
    }
    return state;
}

/* Takes the option --again. */
static inline int scene_take_again(void *to, const char *value)
{
    double number[5];
    *(const char **)to = value;
    return scene_again_read(value, number) != NULL;
}

static inline void scene_again_take(scene *s, const char *state)
{
    double number[5];
    const char *key = scene_again_read(state, number);
    s->yaw = (float)(number[0] * -0.017453292519943295);
    s->pitch = (float)(number[1] * 0.017453292519943295);
    s->zoom = (float)number[2];
    s->place = shade_v2((float)number[3], (float)number[4]);
    for (; *key; key++) scene_key(s, *key);
    *s->said = 0;
}

/* Loads a model into a zeroed scene.  Returns 1 with a line on stderr. */
static inline int scene_load(scene *s, const scene_request *o, mesh_progress *progress, void *user)
{
    int failed;
    s->how = o->how;
    s->title = o->model ? scene_title(o->model) : "teapot";
    guard_begin(o->how.max_memory);
    failed = o->model ? model_open(o->model, &o->how, &s->model, progress, user)
                      : scene_teapot(&s->model, o->pieces);
    guard_doing = "preparing the model";
    failed = failed || model_cut(&s->model, &o->how, 1, scene_home_yaw(s), scene_home_eye(s)) ||
             model_prepare(&s->model, &o->how, 0);
    guard_done();
    if (failed) return 1;
    if (s->model.part_count == 1) s->model.mesh.view = model_part_mesh(&s->model, 0);
    scene_choose(s, o);
    if (o->again) scene_again_take(s, o->again);
    ground_cast(&s->shadow, &s->model.mesh.view);
    return 0;
}

/* ---- drawing -------------------------------------------------------------------------------- */

/* The nearest distance from which the model stays in the picture however it turns about its upright
   axis, and the height that centres it.  A point at radius r, height y travels a circle; against
   the four planes of the view its extremes have a closed form. */
static inline void scene_fit(const scene *s, float slope_x, float slope_y, float *distance,
                             float *rise)
{
    shade_vec2 tilt;
    float side = 0, above = -9, below = -9;
    shade_mat4 turn = shade_mat4_rotation(scene_home_pitch(s), shade_v3(1, 0, 0));
    tilt = shade_v2(turn.col[1].y, turn.col[1].z); /* cosine, sine */
    for (int i = 0; i < s->model.mesh.view.vertex_count; i++) {
        const float *p = s->model.mesh.positions + 3 * (size_t)i;
        float r = sqrtf(p[0] * p[0] + p[2] * p[2]), y = p[1];
        side =
            fmaxf(side, r * sqrtf(1 + slope_x * slope_x * tilt.x * tilt.x) + slope_x * y * tilt.y);
        above =
            fmaxf(above, y * (tilt.x + slope_y * tilt.y) + r * fabsf(slope_y * tilt.x - tilt.y));
        below =
            fmaxf(below, y * (slope_y * tilt.y - tilt.x) + r * fabsf(slope_y * tilt.x + tilt.y));
    }
    *distance = 1.12f * fmaxf(side / slope_x, (above + below) / (2 * slope_y));
    *distance = fmaxf(*distance, 1.1f);
    *rise = (below - above) / 2;
}

/* Places the camera; aspect is width by height of the picture as it is seen. */
static inline scene_camera scene_place_camera(const scene *s, float aspect)
{
    scene_camera c;
    shade_mat4 lens = shade_mat4_perspective(SCENE_LENS, aspect, 1, 2);
    float distance, rise;
    scene_fit(s, 1 / lens.col[0].x, 1 / lens.col[1].y, &distance, &rise);
    c.model = shade_mat4_mul(shade_mat4_rotation(s->pitch, shade_v3(1, 0, 0)),
                             shade_mat4_rotation(s->yaw, shade_v3(0, 1, 0)));
    c.view = shade_mat4_translation(shade_v3(0, rise, -distance));
    c.projection =
        shade_mat4_perspective(SCENE_LENS, aspect, fmaxf(0.02f, distance - 2.2f), distance + 2.2f);
    c.projection.col[0].x *= s->zoom;
    c.projection.col[1].y *= s->zoom;
    c.projection.col[2].x -= s->zoom * s->place.x / aspect; /* of which w is -1 */
    c.projection.col[2].y -= s->zoom * s->place.y;
    c.top = 0;
    c.bottom = 1;
    return c;
}

/* The camera of width x height pixels from x, y on, where c is that of size (width, height) */
static inline scene_camera scene_crop(scene_camera c, shade_vec2 size, float x, float y,
                                      float width, float height)
{
    shade_vec4 *col = c.projection.col;
    for (int k = 0; k < 4; k++) {
        col[k].x = col[k].x * (size.x / width) + col[k].w * ((size.x - 2 * x) / width - 1);
        col[k].y = col[k].y * (size.y / height) + col[k].w * (1 - (size.y - 2 * y) / height);
    }
    c.top = y / size.y;
    c.bottom = (y + height) / size.y;
    return c;
}

/* Colours of text before the picture, and of the box behind longer ones */
static inline uint32_t scene_ink(const scene *s)
{
    return s->choice[CHOICE_BACKDROP] == BACKDROP_DAYLIGHT ? 0x2a323a : 0xc3ccd6;
}
enum { SCENE_BOX = 0x14191e, SCENE_BOX_INK = 0xe6ebf0 };

/* Clears the rows of a band to the backdrop; so many rows, counted from the top of the picture,
   have one colour. */
static inline void scene_backdrop(const scene *s, const shade_target *target, float from, float to,
                                  int rows)
{
    static const uint32_t top[3] = { 0x20262e, 0xdfe6ec, 0 }, bottom[3] = { 0x59626d, 0x9aa5b0, 0 };
    int b = s->choice[CHOICE_BACKDROP];
    const int first = target->clip_y, end = first + target->clip_height;
    shade_target band = *target;
    for (int y = first - first % rows; y < end; y += rows) {
        float part = ((float)y + 0.5f * (float)rows) / (float)band.height;
        band.clip_y = y < first ? first : y;
        band.clip_height = (y + rows < end ? y + rows : end) - band.clip_y;
        part = from + (to - from) * part;
        shade_vec3 k = shade_lerp(shade_rgb(top[b]), shade_rgb(bottom[b]), part);
        shade_clear(&band, shade_v4(k.x, k.y, k.z, 1), 1);
    }
}

/* Sets the lamps, which stay with the viewer on +z.  Returns their number, at most 4.  Those of
   the studio are a key light from above, a fill light from beside it, one from behind for the
   outline, and light from the ground. */
static inline int scene_lamps(const scene *s, shade_light *light, shade_vec3 *ambient)
{
    shade_vec3 white = shade_v3(1.5f, 1.5f, 1.5f);
    *ambient = shade_v3(0.08f, 0.08f, 0.09f);
    switch (s->choice[CHOICE_LAMP]) {
    case LAMP_SUN:
        light[0] = shade_directional_light(shade_v3(-0.7f, -0.9f, -0.6f), white);
        return 1;
    case LAMP_NEAR:
        light[0] = shade_point_light(shade_v3(0.9f, 1, 1), white);
        light[0].constant = 0.3f;
        light[0].quadratic = 0.6f;
        return 1;
    case LAMP_SPOT:
        light[0] = shade_spot_light(shade_v3(-1, 2.5f, 1.5f), shade_v3(1, -2.5f, -1.5f), 0.3f, 20,
                                    shade_scale(white, 1.5f));
        return 1;
    case LAMP_COLORS:
        light[0] = shade_directional_light(shade_v3(-1, -0.5f, -0.4f), shade_v3(1.6f, 0.6f, 0.2f));
        light[1] = shade_directional_light(shade_v3(1, -0.3f, -0.2f), shade_v3(0.1f, 0.6f, 1.3f));
        return 2;
    case LAMP_EYE: light[0] = shade_directional_light(shade_v3(0, 0, -1), white); return 1;
    }
    light[0] = shade_directional_light(shade_v3(0.7f, -0.9f, -0.6f), shade_v3(1.35f, 1.27f, 1.15f));
    light[1] = shade_directional_light(shade_v3(-1, -0.15f, -0.35f), shade_v3(0.12f, 0.16f, 0.24f));
    light[2] = shade_directional_light(shade_v3(-0.6f, -0.5f, 1), shade_v3(0.55f, 0.62f, 0.72f));
    light[3] = shade_directional_light(shade_v3(-0.2f, 1, -0.3f), shade_v3(0.13f, 0.13f, 0.14f));
    return 4;
}

/* How the choices want the model to be lit */
static inline model_options scene_options(const scene *s)
{
    static const shade_shading shadings[3] = { SHADE_SHADING_PER_FRAGMENT, SHADE_SHADING_PER_VERTEX,
                                               SHADE_SHADING_PER_FACE };
    const int preset = s->choice[CHOICE_MATERIAL] - 1;
    model_options o = s->how;
    o.model = (shade_model)s->choice[CHOICE_MODEL];
    o.shading = shadings[s->choice[CHOICE_SHADING]];
    o.no_shadow = s->choice[CHOICE_GROUND];
    if (preset < 0) return o;
    o.plain = 1;
    o.material = shade_linear_material(shade_preset_material((shade_preset)preset));
    return o;
}

/* ---- the light of the studio ---------------------------------------------------------------- */

/* 1: the studio can light what the choices want. */
static inline int scene_has_studio(const scene *s)
{
    return !s->how.quick && s->choice[CHOICE_LAMP] == LAMP_STUDIO && !s->choice[CHOICE_TERM] &&
           !s->choice[CHOICE_FLAG] && !s->choice[CHOICE_WIRE] && s->model.mesh.view.index_count &&
           (s->flat || s->choice[CHOICE_SHADING] < 2);
}

/* Back to the quick lamps */
static inline void scene_dim(scene *s) { s->lit = 0; }

/* Lights the studio for one picture by this camera, whose longer edge has so many pixels.  Where
   the choices want another light, or memory is out, the quick lamps stay.  The scene must not
   move. */
static inline void scene_light(scene *s, const scene_camera *c, int pixels)
{
    const shade_mat4 world = shade_mat4_inverse(shade_mat4_mul(c->view, c->model));
    const shade_vec3 eye = shade_v3(world.col[3].x, world.col[3].y, world.col[3].z);
    shade_result result = SHADE_OK;
    s->lit = 0;
    if (!scene_has_studio(s)) return;
    if (!s->studio.memory)
        result = studio_open(&s->studio, &s->model, pixels, -s->yaw, s->how.threads, NULL, NULL);
    else if (s->studio.turn != -s->yaw)
        result = studio_turn(&s->studio, &s->model, -s->yaw, s->how.threads);
    exhibit_close(&s->exhibit);
    s->shown = scene_options(s);
    s->lit = !result && !exhibit_open(&s->exhibit, &s->model, &s->studio, &s->shown, eye);
}

/* ---- the quick light ------------------------------------------------------------------------- */

/* A part whose bump or normal map bends the quick light */
typedef struct scene_relief {
    const look *k;
    const shade_mesh *mesh;
    const shade_draw_state *state;
} scene_relief;

/* The equation with a bent N.  The relief lies on the model as it is in its file, and the model's
   matrix only turns it: the transpose turns N back. */
static void scene_relief_fragment(const void *uniforms, const shade_fragments *SHADE_RESTRICT in,
                                  shade_colors *SHADE_RESTRICT out)
{
    const scene_relief *r = (const scene_relief *)uniforms;
    const look *k = r->k;
    const shade_mat3 turn = shade_mat3_from_mat4(r->state->model);
    const shade_mat3 back = shade_mat3_transpose(turn);
    const float *u = in->varying[SHADE_VARYING_TEXCOORD];
    float texel[4][SHADE_LANES];
    look_rows N, albedo;
    const shade_rows rows = { .position = in->varying[SHADE_VARYING_POSITION],
                              .normal = N[0],
                              .albedo = albedo[0] };
    for (int i = 0; i < SHADE_LANES; i++)
        lane_put(N[0], i, shade_mat3_transform(back, lane(in->varying[SHADE_VARYING_NORMAL], i)));
    relief_bend(&k->relief, r->mesh, in, SHADE_VARYING_TEXCOORD, N);
    for (int i = 0; i < SHADE_LANES; i++)
        lane_put(N[0], i, shade_mat3_transform(turn, lane(N[0], i)));

    if (k->map) shade_sample_lanes(k->map, u, u + SHADE_LANES, in->lod, texel[0]);
    for (int a = 0; a < 3; a++) {
        const float *color = in->varying[SHADE_VARYING_COLOR + a];
        SHADE_EACH_LANE(i) { albedo[a][i] = color[i] * (k->map ? texel[a][i] : 1); }
    }
    shade_lit_lanes(&r->state->lighting, r->state->material, in->eye, &rows, out->color[0]);
    if (k->map) {
        SHADE_EACH_LANE(i) { out->color[3][i] = texel[3][i]; }
    }
}

/* Draws front faces first, then back faces (of sheets, or seen through holes) with normals
   turned to the viewer.  Front faces keep their normals: turned to the viewer, they would leave
   dark specks along the outline of a coarse mesh, where they lean away. */
static inline shade_result scene_draw_mesh(const shade_mesh *mesh, const shade_target *target,
                                           shade_draw_state *state, unsigned flags)
{
    shade_result result;
    state->raster.cull = SHADE_CULL_BACK;
    state->lighting.flags = flags;
    result = shade_draw_mesh(target, mesh, state, NULL);
    state->raster.cull = SHADE_CULL_FRONT;
    state->lighting.flags = flags | SHADE_FLAG_TWO_SIDED;
    return result ? result : shade_draw_mesh(target, mesh, state, NULL);
}

/* Draws the opaque parts, or those that something shows through, which hide nothing. */
static inline shade_result scene_draw_parts(const scene *s, const shade_target *target,
                                            const shade_draw_state *lit, int clear)
{
    static const unsigned flag[5] = { 0, SHADE_FLAG_UNGATED_SPECULAR, SHADE_FLAG_WEIGHTED_SPECULAR,
                                      SHADE_FLAG_TWO_SIDED_ABS, SHADE_FLAG_INFINITE_VIEWER };
    const shade_lighting unlit = { .ambient = { 1, 1, 1 } }; /* k_a is k_d there */
    const model_options o = scene_options(s);
    shade_draw_state state = *lit;
    scene_relief bent;
    shade_result result = SHADE_OK;
    state.raster.blend = clear ? SHADE_BLEND_OVER : SHADE_BLEND_REPLACE;
    state.raster.depth_read_only = clear;
    for (int i = 0; i < s->model.part_count && !result; i++) {
        shade_mesh mesh = model_part_mesh(&s->model, i);
        look k;
        if (part_is_clear(&s->model, &o, i) != clear) continue;
        look_dress(&k, &o, &s->model, s->model.part[i].surface);
        if (k.plain) mesh.colors = NULL;
        if (k.map && k.glow_map == k.map) k.material.emission = k.glow;
        state.material = &k.material;
        state.lighting = k.unlit ? unlit : lit->lighting;
        state.diffuse_map = k.map;
        state.alpha_cutoff = k.alpha_cutoff;
        state.transparency = 1 - k.alpha;
        state.fragment = NULL;
        if (k.relief.map && state.shading == SHADE_SHADING_PER_FRAGMENT) {
            k.relief.indices = mesh.indices;
            bent.k = &k;
            bent.mesh = &mesh;
            bent.state = &state;
            state.fragment = scene_relief_fragment;
            state.uniforms = &bent;
            if (!k.map) state.diffuse_map = k.relief.map; /* whose lod the shader gets */
        }
        result = scene_draw_mesh(&mesh, target, &state, flag[s->choice[CHOICE_FLAG]]);
    }
    return result;
}

static inline shade_line_state scene_pen(const scene_camera *c, float width, shade_vec3 color)
{
    shade_line_state pen = { 0 };
    pen.clip_from_points = shade_mat4_mul(c->projection, shade_mat4_mul(c->view, c->model));
    pen.width = width;
    pen.color = shade_v4(color.x, color.y, color.z, 1);
    pen.raster.depth_test = SHADE_COMPARE_LESS_EQUAL;
    pen.raster.depth_bias = -0.0008f;
    return pen;
}

/* Chooses the wires for a picture so many pixels high.  Where they would lie less than 3 pixels
   apart, they would fill the model with their colour: only sharp edges and the outline are drawn
   then.  To be called before scene_draw. */
static inline void scene_trace(scene *s, const scene_camera *c, int height)
{
    const shade_mat4 world = shade_mat4_inverse(shade_mat4_mul(c->view, c->model));
    const shade_vec3 eye = shade_v3(world.col[3].x, world.col[3].y, world.col[3].z);
    const float unit = 0.5f * (float)height * c->projection.col[1].y / -c->view.col[3].z;
    const outline *o = &s->outline;
    s->few_points = 0;
    if (!s->choice[CHOICE_WIRE] || s->wire_length * unit >= 3) return;
    for (int i = 0; 2 * i < s->wires.points && i < o->bent; i++) {
        const shade_vec3 *wire = &s->wires.point[2 * i];
        if (i >= o->sharp && !outline_is_seen(o, &o->edge[i], shade_sub(eye, wire[0]))) continue;
        memcpy(s->few + s->few_points, wire, 2 * sizeof *wire);
        s->few_points += 2;
    }
}

/* How the quick lamps light the scene; lamps has room for 4. */
static inline shade_draw_state scene_state(const scene *s, const scene_camera *c,
                                           shade_light *lamps)
{
    static const unsigned terms[4] = { 0, SHADE_TERM_AMBIENT, SHADE_TERM_DIFFUSE,
                                       SHADE_TERM_SPECULAR };
    shade_draw_state state = { .model = c->model, .view = c->view, .projection = c->projection };
    state.shading = scene_options(s).shading;
    state.lighting.light_count = scene_lamps(s, lamps, &state.lighting.ambient);
    state.lighting.lights = lamps;
    state.lighting.model = (shade_model)s->choice[CHOICE_MODEL];
    state.lighting.terms = terms[s->choice[CHOICE_TERM]];
    state.lighting.cool = shade_v3(0.05f, 0.07f, 0.22f);
    state.lighting.warm = shade_v3(0.75f, 0.52f, 0.28f);
    return state;
}

/* Draws a band of the picture. */
static inline shade_result scene_draw_band(const scene *s, const shade_target *target,
                                           const scene_camera *c, int samples)
{
    shade_light lamps[4];
    shade_draw_state state = scene_state(s, c, lamps);
    const float width = s->few_points ? 1 : 0.5f;
    shade_line_state pen = scene_pen(c, (float)samples * width, shade_rgb(0x0d1216));
    shade_target body = *target; /* without colours where it only hides wires */
    shade_result result;
    scene_backdrop(s, target, c->top, c->bottom, samples);
    if (s->lit)
        return exhibit_draw(&s->exhibit, target, shade_mat4_mul(c->view, c->model), c->projection,
                            samples);
    if (s->choice[CHOICE_WIRE] == WIRE_ALONE) {
        body.color = NULL;
        pen.color = shade_v4(0.8f, 0.85f, 0.9f, 1);
    }
    result = scene_draw_parts(s, &body, &state, 0);
    if (!result)
        result = model_draw_lines(&s->model, target, shade_mat4_mul(c->view, c->model),
                                  c->projection, samples);
    if (!result && s->choice[CHOICE_GROUND] == 0)
        result = ground_draw(&s->shadow, target, c->model, c->view, c->projection);
    if (!result) result = scene_draw_parts(s, &body, &state, 1);
    if (!result && s->few_points)
        result = shade_draw_lines(target, s->few, s->few_points, &pen, NULL);
    else if (!result && s->choice[CHOICE_WIRE])
        result = wires_draw(&s->wires, target, pen);
    return result;
}

/* The data that the bands of a picture share, and the result of each */
typedef struct scene_work {
    const scene *scene;
    const shade_target *out, *in;
    const scene_camera *camera;
    int samples, bands;
    shade_result result[8 * BANDS_MOST];
} scene_work;

static inline void scene_work_draw(void *data, int band)
{
    scene_work *w = (scene_work *)data;
    const shade_target rows = bands_rows(w->in, band, w->bands);
    w->result[band] = scene_draw_band(w->scene, &rows, w->camera, w->samples);
}

static inline void scene_work_resolve(void *data, int band)
{
    scene_work *w = (scene_work *)data;
    const shade_target rows = bands_rows(w->out, band, w->bands);
    w->result[band] = shade_resolve(&rows, w->in, w->samples);
}

static inline shade_result scene_work_run(scene_work *w, const shade_target *by, bands_work *work)
{
    w->bands = bands_count(w->scene->how.threads, by->row_count ? by->row_count : by->height);
    bands_run(w->scene->how.threads, w->bands, work, w);
    for (int i = 0; i < w->bands; i++)
        if (w->result[i]) return w->result[i];
    return SHADE_OK;
}

/* Draws the scene into a target, or a strip of it, that is samples times as wide and high as the
   picture. */
static inline shade_result scene_draw(const scene *s, const shade_target *target,
                                      const scene_camera *c, int samples)
{
    scene_work work = { s, NULL, target, c, samples, 0, { SHADE_OK } };
    return scene_work_run(&work, target, scene_work_draw);
}

/* Calls shade_resolve, spread over all threads. */
static inline shade_result scene_resolve(const scene *s, const shade_target *out,
                                         const shade_target *in, int samples)
{
    scene_work work = { s, out, in, NULL, samples, 0, { SHADE_OK } };
    return scene_work_run(&work, out, scene_work_resolve);
}
#endif
