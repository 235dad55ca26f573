/* window.h - shows a scene in a window of SDL2: shade.h draws it into a texture, with the triangle
   under the mouse marked. */
#ifndef VIEW_WINDOW_H
#define VIEW_WINDOW_H

#define SDL_MAIN_HANDLED
#include <SDL.h>
#include "words.h"
#include "keep.h"

typedef struct window {
    SDL_Window *window;
    SDL_Renderer *renderer;
    SDL_Texture *texture; /* BGRA8, as large as the window in pixels */
    scene *scene;
    const view_options *options;
    int width, height;         /* pixels */
    float scale;               /* pixels to a unit of the mouse */
    shade_target large;        /* room for most samples */
    int at_rest;               /* the picture is in the light of the studio */
    int most, quick, samples;  /* along an edge of a pixel: at rest, in motion, now */
    int help, changed, closed; /* changed: draw even if nothing turns */
    int mouse_inside, mouse_x, mouse_y, dragging;
    int picked; /* triangle under the mouse; -1: none */
    frame_rate rate;
    int frames;
    keep kept;
} window;

/* ---- the window ------------------------------------------------------------------------------ */

/* Without a display SDL falls back to drivers that show nothing.  Only SDL_VIDEODRIVER may ask for
   one of these. */
static inline int window_is_unseen(void)
{
    const char *driver = SDL_GetCurrentVideoDriver(), *asked = getenv("SDL_VIDEODRIVER");
    if (asked && *asked) return 0;
    return !driver || !strcmp(driver, "dummy") || !strcmp(driver, "offscreen") ||
           !strcmp(driver, "evdev");
}

/* Opens the window.  Returns 1 with a line on stderr. */
static inline int window_open(window *w)
{
    SDL_SetMainReady();
    if (SDL_Init(SDL_INIT_VIDEO)) return complain("no window: %s", SDL_GetError());
    if (window_is_unseen()) {
        SDL_Quit();
        return complain("no window: there is no display");
    }
    w->window = SDL_CreateWindow("view", SDL_WINDOWPOS_UNDEFINED, SDL_WINDOWPOS_UNDEFINED, 960, 720,
                                 SDL_WINDOW_RESIZABLE | SDL_WINDOW_ALLOW_HIGHDPI);
    if (w->window) w->renderer = SDL_CreateRenderer(w->window, -1, 0);
    if (!w->renderer) return complain("no window: %s", SDL_GetError());
    SDL_StartTextInput();
    return 0;
}

static inline void window_close(window *w)
{
    free(w->large.color);
    free(w->large.depth);
    if (w->texture) SDL_DestroyTexture(w->texture);
    if (w->renderer) SDL_DestroyRenderer(w->renderer);
    if (w->window) SDL_DestroyWindow(w->window);
    SDL_Quit();
}

/* Makes texture and samples fit the window.  Returns 0 where the window has no area, or with a
   line on stderr. */
static inline int window_fit(window *w)
{
    int width = 0, height = 0, mouse_width = 1, mouse_height = 1;
    size_t pixels;
    SDL_GetRendererOutputSize(w->renderer, &width, &height);
    SDL_GetWindowSize(w->window, &mouse_width, &mouse_height);
    w->scale = (float)width / (float)(mouse_width ? mouse_width : 1);
    if (width < 1 || height < 1 || width > 16384 || height > 16384) return 0;
    if (w->texture && width == w->width && height == w->height) return 1;
    if (w->texture) SDL_DestroyTexture(w->texture);
    w->texture = SDL_CreateTexture(w->renderer, SDL_PIXELFORMAT_BGRA32, SDL_TEXTUREACCESS_STREAMING,
                                   width, height);
    free(w->large.color);
    free(w->large.depth);
    pixels = (size_t)width * (size_t)height;
    for (w->most = 3; w->most > 1 && pixels * (size_t)(w->most * w->most) > 7000000;) w->most--;
    pixels *= (size_t)(w->most * w->most);
    w->large.color = malloc(16 * pixels);
    w->large.depth = (float *)malloc(4 * pixels);
    w->large.format = SHADE_FORMAT_RGBA32F;
    w->width = width;
    w->height = height;
    w->quick = w->samples = 1;
    w->changed = 1;
    if (w->texture && w->large.color && w->large.depth) return 1;
    w->closed = 2;
    return 0;
}

/* ---- frames ---------------------------------------------------------------------------------- */

/* The size of letters in pixels */
static inline float window_em(const window *w) { return w->scale > 1 ? 16 * w->scale : 18; }

static inline words window_words(const window *w)
{
    words said = { w->scene, window_em(w), 0, w->help, "h  help", scene_ink(w->scene) };
    if (w->scene->turning) said.rate = w->rate.rate;
    return said;
}

/* Draws the words over the picture; a triangle under the mouse takes the place of the help. */
static inline void window_say(const window *w, const shade_target *t)
{
    words said = window_words(w);
    char text[40];
    snprintf(text, sizeof text, "triangle %d", w->picked);
    if (w->help) said.corner = "";
    if (w->picked >= 0) {
        said.corner = text;
        said.corner_ink = 0xffb454;
    }
    words_draw(&said, t);
}

/* Draws a bright edge around the triangle under the mouse; things before the triangle hide it. */
static inline void window_mark(window *w, const shade_target *target, const scene_camera *c)
{
    const shade_mesh *m = &w->scene->model.mesh.view;
    shade_line_state pen = scene_pen(c, 2 * w->scale * (float)w->samples, shade_rgb(0xff9a1f));
    shade_vec3 corner[3], edge[6];
    shade_ray ray;
    w->picked = -1;
    if (!w->mouse_inside || w->dragging) return;
    ray = shade_pixel_ray(c->view, c->projection, w->width, w->height,
                          w->scale * ((float)w->mouse_x + 0.5f),
                          w->scale * ((float)w->mouse_y + 0.5f));
    w->picked = shade_pick(m, c->model, ray, NULL, NULL);
    if (w->picked < 0) return;
    for (int k = 0; k < 3; k++) {
        size_t at = m->indices[3 * (size_t)w->picked + (size_t)k];
        memcpy(&corner[k], m->positions + 3 * at, sizeof corner[k]);
    }
    for (int k = 0; k < 3; k++) {
        edge[2 * k] = corner[k];
        edge[2 * k + 1] = corner[(k + 1) % 3];
    }
    pen.cap = SHADE_CAP_SQUARE;
    shade_draw_lines(target, edge, 6, &pen, NULL);
}

/* Locks the texture's pixels to draw into.  Returns 1 where there are none. */
static inline int window_lock(const window *w, shade_target *out)
{
    static const shade_target none;
    int pitch;
    *out = none;
    if (SDL_LockTexture(w->texture, NULL, &out->color, &pitch)) return 1;
    out->width = w->width;
    out->height = w->height;
    out->stride = pitch / 4;
    out->format = SHADE_FORMAT_BGRA8;
    out->srgb = 1;
    return 0;
}

static inline void window_show(const window *w)
{
    SDL_UnlockTexture(w->texture);
    SDL_RenderCopy(w->renderer, w->texture, NULL, NULL);
    SDL_RenderPresent(w->renderer);
}

/* Draws with w->samples samples.  Returns 1 where it cannot. */
static inline int window_frame(window *w)
{
    scene_camera camera = scene_place_camera(w->scene, (float)w->width / (float)w->height);
    shade_target out;
    scene_dim(w->scene);
    scene_trace(w->scene, &camera, w->height);
    if (w->at_rest) scene_light(w->scene, &camera, w->width > w->height ? w->width : w->height);
    w->large.width = w->width * w->samples;
    w->large.height = w->height * w->samples;
    scene_draw(w->scene, &w->large, &camera, w->samples);
    window_mark(w, &w->large, &camera);
    if (window_lock(w, &out)) return 1;
    scene_resolve(w->scene, &out, &w->large, w->samples);
    window_say(w, &out);
    window_show(w);
    return 0;
}

/* ---- events ---------------------------------------------------------------------------------- */

static inline void window_press(window *w, int key)
{
    if (key == 'q' || key == 'Q')
        w->closed = 1;
    else if (key == '?' || key == 'h') {
        w->help = !w->help;
        w->changed = 1;
    } else if (key == 'p' && w->scene->model.mesh.view.index_count && window_fit(w)) {
        keep_picture(&w->kept, w->scene, w->width, w->height);
        keep_tell(&w->kept);
        w->changed = 1;
    } else if (w->scene->model.mesh.view.index_count && scene_key(w->scene, key))
        w->changed = 1;
}

/* Keys of characters come as text events. */
static inline void window_arrow(window *w, SDL_Keycode key, int shift)
{
    static const SDL_Keycode arrow[4] = { SDLK_UP, SDLK_DOWN, SDLK_LEFT, SDLK_RIGHT };
    for (int k = 0; k < 4; k++)
        if (key == arrow[k]) window_press(w, (shift ? KEY_MOVE_UP : KEY_UP) + k);
}

/* Dragging turns or, with shift or another button, moves. */
static inline void window_mouse(window *w, const SDL_MouseMotionEvent *e)
{
    const Uint32 other = SDL_BUTTON_MMASK | SDL_BUTTON_RMASK;
    const float half = 2 * w->scale / (float)w->height;
    w->mouse_inside = 1;
    w->mouse_x = e->x;
    w->mouse_y = e->y;
    w->dragging = (e->state & (SDL_BUTTON_LMASK | other)) != 0;
    if (w->dragging && (e->state & other || SDL_GetModState() & KMOD_SHIFT))
        scene_move(w->scene, half * (float)e->xrel, -half * (float)e->yrel);
    else if (w->dragging)
        scene_turn(w->scene, 0.008f * (float)e->xrel, 0.008f * (float)e->yrel);
    w->changed = 1;
}

static inline void window_event(window *w, const SDL_Event *e)
{
    switch (e->type) {
    case SDL_QUIT: w->closed = 1; break;
    case SDL_KEYDOWN:
        window_arrow(w, e->key.keysym.sym, (e->key.keysym.mod & KMOD_SHIFT) != 0);
        break;
    case SDL_TEXTINPUT: window_press(w, (unsigned char)e->text.text[0]); break;
    case SDL_MOUSEMOTION: window_mouse(w, &e->motion); break;
    case SDL_MOUSEBUTTONUP:
        w->dragging = 0;
        w->changed = 1;
        break;
    case SDL_MOUSEWHEEL:
        scene_zoom(w->scene, e->wheel.y > 0 ? 1.1f : 1 / 1.1f);
        w->changed = 1;
        break;
    case SDL_WINDOWEVENT:
        if (e->window.event == SDL_WINDOWEVENT_LEAVE) w->mouse_inside = 0;
        w->changed = 1;
        break;
    default: break;
    }
}

/* Handles the events that have come, and waits for the first one up to a limit. */
static inline void window_events(window *w, double seconds)
{
    SDL_Event e;
    int some =
        seconds > 0 ? SDL_WaitEventTimeout(&e, (int)(1000 * seconds) + 1) : SDL_PollEvent(&e);
    for (; some; some = SDL_PollEvent(&e)) window_event(w, &e);
}

/* ---- loading --------------------------------------------------------------------------------- */

/* A thread reads the file, so that the window answers meanwhile, however slow the file is. */
typedef struct window_loading {
    scene *scene;
    const view_options *options;
    SDL_atomic_t percent, done;
    int failed;
} window_loading;

static inline void window_progress(void *user, double part)
{
    SDL_AtomicSet(&((window_loading *)user)->percent, (int)(100 * part));
}

static inline int window_load_thread(void *user)
{
    window_loading *l = (window_loading *)user;
    const scene_request request = view_request(l->options);
    l->failed = scene_load(l->scene, &request, window_progress, l);
    SDL_AtomicSet(&l->done, 1);
    return 0;
}

static inline void window_show_progress(window *w, int percent)
{
    const words said = window_words(w);
    shade_target out;
    char text[40];
    snprintf(text, sizeof text, "reading %d", percent);
    if (!window_fit(w) || window_lock(w, &out)) return;
    scene_backdrop(w->scene, &out, 0, 1, 1);
    words_set(&said, &out, 0, 0, said.corner_ink, text);
    window_show(w);
}

/* Returns 1 where it has complained.  A window closed meanwhile ends the program here: the thread
   may be stuck in a read, and exit() would wait for the file that it holds. */
static inline int window_load(window *w)
{
    static scene loaded;
    static window_loading l;
    SDL_Thread *reader;
    l.scene = &loaded;
    l.options = w->options;
    reader = SDL_CreateThread(window_load_thread, "reader", &l);
    if (!reader) return complain("no thread: %s", SDL_GetError());
    while (!SDL_AtomicGet(&l.done)) {
        window_events(w, 0.05);
        if (w->closed) {
            window_close(w);
            _Exit(0);
        }
        window_show_progress(w, SDL_AtomicGet(&l.percent));
    }
    SDL_WaitThread(reader, NULL);
    *w->scene = loaded;
    if (!l.failed) SDL_SetWindowTitle(w->window, w->scene->title);
    return l.failed;
}

/* ---- all of it ------------------------------------------------------------------------------- */

static inline double window_now(void)
{
    return (double)SDL_GetPerformanceCounter() / (double)SDL_GetPerformanceFrequency();
}

/* In motion, chooses as many samples as keep the frame rate. */
static inline void window_keep_pace(window *w, double seconds)
{
    if (w->samples == 1)
        w->quick = seconds < 0.008 && w->most > 1 ? 2 : 1;
    else if (w->samples == 2 && seconds > 0.035)
        w->quick = 1;
}

static inline int window_step(window *w, double passed)
{
    double begin = window_now();
    if (w->scene->turning) scene_turn(w->scene, 0.6f * (float)passed, 0);
    w->changed = 0;
    if (window_frame(w)) return complain("no frame: %s", SDL_GetError());
    window_keep_pace(w, window_now() - begin);
    frame_rate_count(&w->rate, begin);
    w->frames++;
    return 0;
}

/* At rest, draws the last frame once more with all samples and in the light of the studio, as soon
   as nothing has happened for a while. */
static inline int window_run(window *w)
{
    double step = 1.0 / w->options->rate, before = window_now(), next = before, now = before;
    while (!w->closed && !(w->options->frames && w->frames >= w->options->frames)) {
        int active = w->scene->turning || w->changed;
        window_events(w, active ? next - now : w->at_rest ? 0.5 : 0.15);
        now = window_now();
        if (!window_fit(w)) continue;
        active = w->scene->turning || w->changed;
        if (active ? now < next : w->at_rest) continue;
        w->at_rest = !active;
        w->samples = active ? w->quick : w->most;
        if (window_step(w, now - before)) return 1;
        before = now;
        next = fmax(next + step, now);
    }
    return w->closed > 1 ? complain("no memory for the window's pixels") : 0;
}

/* Returns the exit status of the program. */
static inline int show_in_window(scene *s, const view_options *o)
{
    static window w;
    int failed;
    w.scene = s;
    w.options = o;
    w.kept.words = o->words;
    w.picked = -1;
    failed = window_open(&w) || window_load(&w) || window_run(&w);
    if (!failed && o->frames) fprintf(stderr, "%d frames\n", w.frames);
    free(w.kept.told.bytes);
    window_close(&w);
    scene_close(s);
    return failed;
}
#endif
