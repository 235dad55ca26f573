/* page.c - the playground's half in C: draws what the page's controls say, tells what stands under
   the pointer, reads models.  Compiled for wasm32 it is the page's module; compiled by any C
   compiler, with native.c around it, it draws the same bits. */
#ifdef __wasm__
#define SHADE_NO_LIBM
#define PAGE(type, name) __attribute__((export_name(#name))) type name
#else
#define PAGE(type, name) static type name
#endif
#define SHADE_IMPLEMENTATION
#include "shade.h"
#include "../../shared/mesh.h"
#include "../../kit/read/files.h"
#include "look.h"
#include "scene.h"
#include "raster.h"

enum { PAGE_MOST = 4 << 20 };                        /* pixels of a picture */
enum { PAGE_WIDEST = 16384 };
enum { PAGE_TEAPOT, PAGE_SPHERE, PAGE_FILE, PAGE_BALLS, PAGE_RIBBON, PAGE_SHAPES };
enum { PAGE_MODEL, PAGE_ROOM, PAGE_PARTS };           /* what stands in the picture */
enum { PAGE_LIT, PAGE_NORMALS, PAGE_DEPTH };
enum { PAGE_LAMPS = 3, PAGE_PANELS = 3 };

/* All floats, in the order of the page's list LAYOUT. */
typedef struct page_lamp {
    float on, at_infinity;
    shade_vec3 position, color, ambient;
    float a, b, c, beta, e;                          /* beta in degrees; 180: no cone */
} page_lamp;

typedef struct page_state {
    float width, height, shape, view, compare, wire, model, shading, flags, terms, probed_lamp;
    float detail, room, floor;                       /* floor: the height of the room's */
    float yaw, pitch, distance, near_z, far_z, scale;
    shade_vec3 center, background, ink;
    shade_material material;
    shade_vec3 ambient;
    page_lamp lamp[PAGE_LAMPS];
} page_state;

/* Likewise, in the order of ANSWER.  Vectors are of the probed lamp; what is named lamp_ is its
   share, without the others. */
typedef struct page_answer {
    float hit, part, hidden;                         /* hidden: something stands in front of P */
    shade_vec3 mark;                                 /* P where the part has not been turned */
    shade_terms terms;
    shade_vec3 scene_ambient, lamp_ambient, lamp_diffuse, lamp_specular;
    float r, attenuation, spot, gate, n_dot_l, base, power;
    shade_vec2 point, tip[4];                        /* on the picture: P and the ends of N L V H */
    shade_vec3 place, unit[4];                       /* in the world: P; N L V H */
    shade_vec3 weights, corner[3], normal[3];        /* of the triangle, in the world */
    shade_material material;
} page_answer;

static page_state state;
static page_answer answer;
static uint32_t pixels[PAGE_MOST];
static float depth[PAGE_MOST];

/* ---- models ---------------------------------------------------------------------------------- */

typedef struct page_mesh {
    owned_mesh mesh;
    int detail;                                      /* that it was built with */
    shade_vec3 *wires;
    int wire_count;                                  /* points; 0: not asked for yet */
    float bounds[5];                     /* middle of the box, radius around it, half its height */
} page_mesh;
static page_mesh meshes[PAGE_SHAPES];
static owned_mesh room;

/* Returns 0 where the numbers are too big or too small to be drawn. */
static int measure(page_mesh *m)
{
    double low[3] = { 1e300, 1e300, 1e300 }, high[3] = { -1e300, -1e300, -1e300 }, most = 0;
    const float *p = m->mesh.positions;
    size_t n = 3 * (size_t)m->mesh.view.vertex_count;
    for (size_t i = 0; i < n; i++) {
        double v = (double)p[i];
        if (v < low[i % 3]) low[i % 3] = v;
        if (v > high[i % 3]) high[i % 3] = v;
    }
    for (size_t i = 0; i < n; i += 3) {
        double square = 0;
        for (size_t k = 0; k < 3; k++) {
            double d = (double)p[i + k] - (low[k] + high[k]) / 2;
            square += d * d;
        }
        if (square > most) most = square;
    }
    for (int k = 0; k < 3; k++) {
        m->bounds[k] = (float)((low[k] + high[k]) / 2);
        if (low[k] < -1e6 || high[k] > 1e6) return 0;
    }
    m->bounds[3] = (float)sqrt(most);
    m->bounds[4] = (float)((high[1] - low[1]) / 2);
    return most > 1e-12;
}

static owned_mesh shape_of(int shape, int detail)
{
    switch (shape) {
    case PAGE_SPHERE: return mesh_sphere(8 * detail, 4 * detail);
    case PAGE_BALLS: return scene_balls(detail);
    case PAGE_RIBBON: return scene_ribbon(detail);
    default: return shape_teapot(detail);
    }
}

static page_mesh *shape_mesh(int shape)
{
    page_mesh *m = &meshes[shape];
    int detail = (int)state.detail > 1 ? (int)state.detail : 1;
    if (shape == PAGE_FILE || m->detail == detail) return m;
    mesh_free(&m->mesh);
    free(m->wires);
    m->wires = NULL;
    m->wire_count = 0;
    m->mesh = shape_of(shape, detail);
    m->detail = detail;
    measure(m);
    return m;
}

PAGE(const float *, page_bounds)(int shape, int detail)
{
    state.detail = (float)detail;
    return shape_mesh(shape)->bounds;
}

/* Room for the bytes of a file and its name; NULL: none. */
PAGE(void *, page_room)(size_t bytes) { return malloc(bytes); }

/* Takes and frees what page_room gave.  Returns "" or what is wrong; the model that was there stays
   where the new one cannot be drawn. */
PAGE(const char *, page_load)(void *bytes, size_t size, const char *name)
{
    static char error[300];
    page_mesh m = { { { 0 }, 0, 0, 0, 0, 0, 0, 0 }, 0, NULL, 0, { 0, 0, 0, 0, 0 } };
    page_mesh *old = &meshes[PAGE_FILE];
    error[0] = 0;
    if (!mesh_read_memory(bytes, size, name, &m.mesh, error, sizeof error) && !measure(&m)) {
        snprintf(error, sizeof error, "%s: larger than 10^6 or smaller than 10^-6", name);
        mesh_free(&m.mesh);
    }
    free(bytes);
    if (error[0]) return error;
    mesh_free(&old->mesh);
    free(old->wires);
    *old = m;
    return error;
}

PAGE(int, page_triangles)(int shape) { return shape_mesh(shape)->mesh.view.index_count / 3; }

/* ---- the picture ----------------------------------------------------------------------------- */

static shade_light lamp_of(const page_lamp *l)
{
    shade_light out = shade_point_light(l->position, l->color);
    if (l->beta < 180)                               /* it points at the middle of the model */
        out = shade_spot_light(l->position, shade_neg(l->position), shade_radians(l->beta), l->e,
                               l->color);
    out.position.w = l->at_infinity != 0 ? 0 : 1;
    out.ambient = l->ambient;
    out.constant = l->a;
    out.linear = l->b;
    out.quadratic = l->c;
    return out;
}

typedef struct page_scene { shade_draw_state draw; shade_light lamps[PAGE_LAMPS]; } page_scene;

/* The whole scene; panel -1: the only one, else one of the three that are compared */
static void scene_of(page_scene *s, int panel)
{
    static const shade_draw_state none;
    float width = panel < 0 ? state.width : (float)((int)state.width / PAGE_PANELS);
    shade_draw_state *d = &s->draw;
    int count = 0;
    *d = none;
    for (int i = 0; i < PAGE_LAMPS; i++)
        if (state.lamp[i].on != 0) s->lamps[count++] = lamp_of(&state.lamp[i]);
    d->model = shade_mat4_mul(shade_mat4_rotation(state.pitch, shade_v3(1, 0, 0)),
                              shade_mat4_rotation(state.yaw, shade_v3(0, 1, 0)));
    d->model = shade_mat4_mul(d->model,
                              shade_mat4_scaling(shade_v3(state.scale, state.scale, state.scale)));
    d->model = shade_mat4_mul(d->model, shade_mat4_translation(shade_neg(state.center)));
    d->view = shade_mat4_look_at(shade_v3(0, 0, state.distance), shade_v3(0, 0, 0),
                                 shade_v3(0, 1, 0));
    d->projection =
        shade_mat4_perspective(0.5f, width / state.height, state.near_z, state.far_z);
    d->material = &state.material;
    d->shading = (shade_shading)state.shading;
    d->lighting.lights = s->lamps;
    d->lighting.light_count = count;
    d->lighting.ambient = state.ambient;
    d->lighting.model = panel < 0 ? (shade_model)state.model
                      : panel ? SHADE_MODEL_BLINN_PHONG : SHADE_MODEL_PHONG;
    d->lighting.flags = (unsigned)state.flags;
    d->lighting.terms = (unsigned)state.terms;
    d->lighting.cool = shade_linear_from_srgb(shade_v3(0.4f, 0.4f, 0.7f));
    d->lighting.warm = shade_linear_from_srgb(shade_v3(0.8f, 0.6f, 0.6f));
}

/* The exponent of a panel: the third has four times Phong's. */
static shade_material material_of(int panel)
{
    shade_material m = state.material;
    if (panel == 2) m.shininess = shade_blinn_exponent(m.shininess);
    return m;
}

static const owned_mesh *room_of(void)
{
    if (!room.positions) room = scene_room();
    return &room;
}

static void draw_panel(const shade_target *target, int panel)
{
    page_mesh *m = shape_mesh((int)state.shape);
    const shade_mesh *mesh = &m->mesh.view;
    shade_material material = material_of(panel);
    page_scene s;
    scene_of(&s, panel);
    s.draw.material = &material;
    if (state.room != 0 && (int)state.view == PAGE_LIT)
        scene_draw_room(target, &room_of()->view, s.draw, state.pitch, state.floor);
    if ((int)state.view == PAGE_LIT) shade_draw_mesh(target, mesh, &s.draw, NULL);
    else look_draw(target, mesh, &s.draw, state.near_z, state.far_z, (int)state.view == PAGE_DEPTH);
    if (!(state.wire > 0)) return;
    if (!m->wire_count) m->wires = wire_points(mesh, &m->wire_count);
    if (m->wires) wire_draw(target, m->wires, m->wire_count, &s.draw, state.wire, state.ink);
}

PAGE(page_state *, page_input)(void) { return &state; }

/* Draws the panels of the state into a target of the whole picture. */
static void draw_panels(shade_target target, int bytes)
{
    unsigned char *left = (unsigned char *)target.color;
    float *left_depth = target.depth;
    const int panel = target.width / PAGE_PANELS;
    shade_clear(&target,
                shade_v4(state.background.x, state.background.y, state.background.z, 1), 1);
    if (state.compare == 0) {
        draw_panel(&target, -1);
        return;
    }
    target.stride = target.width;
    target.width = panel;
    for (int i = 0; i < PAGE_PANELS; i++) {
        target.color = left + (ptrdiff_t)bytes * i * panel;
        target.depth = left_depth + i * panel;
        draw_panel(&target, i);
    }
}

/* Draws the state.  Returns the pixels, RGBA. */
PAGE(const void *, page_draw)(void)
{
    const shade_target target = { .width = (int)state.width, .height = (int)state.height,
                                  .color = pixels, .depth = depth, .srgb = 1 };
    draw_panels(target, 4);
    return pixels;
}

/* Draws one row of the picture with these terms alone.  Returns the luminance of its pixels, which
   is linear and may exceed 1; beside the model it is 0. */
PAGE(const float *, page_row)(int y, int terms)
{
    static float rgba[4 * PAGE_WIDEST], far[PAGE_WIDEST], bright[PAGE_WIDEST];
    const page_state kept = state;
    const shade_target row = { .width = (int)state.width, .height = (int)state.height,
                               .color = rgba, .depth = far, .format = SHADE_FORMAT_RGBA32F,
                               .row_offset = y, .row_count = 1 };
    if (row.width > PAGE_WIDEST || y < 0 || y >= row.height) return bright;
    state.terms = (float)terms;
    state.wire = 0;
    state.background = shade_v3(0, 0, 0);
    draw_panels(row, 16);
    state = kept;
    for (int i = 0; i < row.width; i++) {
        const float *c = rgba + 4 * i;
        bright[i] = 0.2126f * c[0] + 0.7152f * c[1] + 0.0722f * c[2];
    }
    return bright;
}

/* ---- the point under the pointer ------------------------------------------------------------- */

static shade_vec3 corner_of(const float *of, const uint32_t *index, int k)
{
    const float *v = of + 3 * index[k];
    return shade_v3(v[0], v[1], v[2]);
}

static shade_vec3 mix(const shade_vec3 v[3], shade_vec3 weights)
{
    shade_vec3 sum = shade_scale(v[0], weights.x);
    return shade_madd(shade_madd(sum, weights.y, v[1]), weights.z, v[2]);
}

/* What shade_evaluate says of the surface as it is shaded: at the point, at the corners and mixed,
   or at the middle of the face, which stands in P[0] and N[0] alone. */
static shade_terms shaded(const page_scene *s, const shade_lighting *lighting, shade_vec3 eye,
                          const shade_vec3 *P, const shade_vec3 *N, shade_vec3 weights)
{
    const float *w = &weights.x;
    shade_terms sum = { { 0, 0, 0 }, { 0, 0, 0 }, { 0, 0, 0 }, { 0, 0, 0 } };
    if (s->draw.shading != SHADE_SHADING_PER_VERTEX)
        return shade_evaluate(lighting, s->draw.material, eye, P[0], N[0]);
    for (int k = 0; k < 3; k++) {
        shade_terms t = shade_evaluate(lighting, s->draw.material, eye, P[k], N[k]);
        sum.emission = shade_madd(sum.emission, w[k], t.emission);
        sum.ambient = shade_madd(sum.ambient, w[k], t.ambient);
        sum.diffuse = shade_madd(sum.diffuse, w[k], t.diffuse);
        sum.specular = shade_madd(sum.specular, w[k], t.specular);
    }
    return sum;
}

/* The factors of the equation at P, of one lamp */
static void factors(const shade_lighting *lighting, const shade_light *lamp, shade_vec3 V,
                    shade_vec3 P, shade_vec3 N, float exponent, shade_vec3 out[4])
{
    int phong = lighting->model == SHADE_MODEL_PHONG;
    shade_vec3 L, H;
    float near_spot = shade_light_at(lamp, P, &L, &answer.r);
    answer.attenuation = lamp->position.w == 0 ? 1
        : shade_attenuation(lamp->constant, lamp->linear, lamp->quadratic, answer.r);
    answer.spot = shade_spot(L, lamp->spot_direction, lamp->spot_cos_cutoff, lamp->spot_exponent);
    if (near_spot == 0) answer.spot = 0;             /* at the lamp itself as well */
    answer.n_dot_l = shade_dot(N, L);
    answer.gate = answer.n_dot_l > 0;
    H = phong ? shade_mirror(L, N) : shade_halfway(L, V);
    answer.base = phong ? shade_dot(H, V) : shade_dot(N, H);
    answer.power = shade_power(answer.base, exponent);
    out[0] = N;
    out[1] = L;
    out[2] = V;
    out[3] = H;
}

/* A part of the scene, as it stands in a panel */
typedef struct page_part {
    const shade_mesh *mesh;
    shade_mat4 model, turned;                        /* turned: the rotation in model */
    shade_material material;
} page_part;

static page_part part_of(const page_scene *s, int part, int panel)
{
    const shade_mat4 tilt = shade_mat4_rotation(state.pitch, shade_v3(1, 0, 0));
    page_part p = { &shape_mesh((int)state.shape)->mesh.view, s->draw.model, tilt,
                    material_of(panel) };
    p.turned = shade_mat4_mul(tilt, shade_mat4_rotation(state.yaw, shade_v3(0, 1, 0)));
    if (part == PAGE_MODEL) return p;
    p.mesh = &room_of()->view;
    p.turned = tilt;
    p.model = shade_mat4_mul(tilt, shade_mat4_translation(shade_v3(0, state.floor, 0)));
    p.material = scene_grey;
    return p;
}

/* What a ray meets */
typedef struct page_hit { int part, triangle; float t; shade_vec3 weights; } page_hit;

static page_hit meet(const page_scene *s, int panel, shade_ray ray)
{
    page_hit nearest = { 0, -1, FLT_MAX, { 0, 0, 0 } }, hit;
    int parts = state.room != 0 && (int)state.view == PAGE_LIT ? PAGE_PARTS : 1;
    for (hit.part = 0; hit.part < parts; hit.part++) {
        const page_part p = part_of(s, hit.part, panel);
        hit.triangle = shade_pick(p.mesh, p.model, ray, &hit.t, &hit.weights);
        if (hit.triangle >= 0 && hit.t < nearest.t) nearest = hit;
    }
    return nearest;
}

/* The corners of the triangle that was hit, in the world, with unit normals */
static void corners_of(const page_part *p, int triangle, shade_vec3 *P, shade_vec3 *N)
{
    const shade_mat3 normals = shade_normal_matrix(p->model);
    for (int k = 0; k < 3; k++) {
        const uint32_t *index = p->mesh->indices + 3 * triangle;
        P[k] = shade_mat4_transform_point(p->model, corner_of(p->mesh->positions, index, k));
        N[k] = shade_normalize(
            shade_mat3_transform(normals, corner_of(p->mesh->normals, index, k)));
    }
}

/* The terms at what was hit: all of them, then those of the scene and of one lamp alone */
static void answer_terms(const page_scene *s, const shade_light *lamp, int on, shade_vec3 eye,
                         const shade_vec3 *P, const shade_vec3 *N, shade_vec3 weights)
{
    shade_lighting alone = s->draw.lighting;
    shade_terms t;
    answer.terms = shaded(s, &s->draw.lighting, eye, P, N, weights);
    alone.light_count = 0;
    answer.scene_ambient = shaded(s, &alone, eye, P, N, weights).ambient;
    alone.lights = lamp;
    alone.light_count = on;
    alone.ambient = shade_v3(0, 0, 0);
    t = shaded(s, &alone, eye, P, N, weights);
    answer.lamp_ambient = t.ambient;
    answer.lamp_diffuse = t.diffuse;
    answer.lamp_specular = t.specular;
}

/* Where P and the ends of N L V H are in the picture */
static void answer_places(const page_scene *s, int width, float left)
{
    const shade_mat4 to_clip = shade_mat4_mul(s->draw.projection, s->draw.view);
    for (int k = 0; k < 5; k++) {
        shade_vec3 tip = k ? shade_madd(answer.place, 0.45f, answer.unit[k - 1]) : answer.place;
        shade_vec2 *out = k ? &answer.tip[k - 1] : &answer.point;
        tip = shade_mat4_transform_point(to_clip, tip);
        out->x = left + (tip.x + 1) / 2 * (float)width;
        out->y = (1 - tip.y) / 2 * state.height;
    }
}

/* What was marked last: where the equation is evaluated there, and with what */
static struct page_seen {
    page_scene scene;
    shade_material material;
    shade_vec3 P[3], N[3], eye;
} seen;

static int panel_width(int panel)
{
    return panel < 0 ? (int)state.width : (int)state.width / PAGE_PANELS;
}

/* Fills the answer for what a ray has met in a panel, and the lamp that state.probed_lamp names. */
static const page_answer *answer_hit(page_scene *s, int panel, page_hit hit)
{
    const int lamp = (int)state.probed_lamp, width = panel_width(panel);
    const shade_light light = lamp_of(&state.lamp[lamp]);
    const unsigned flags = s->draw.lighting.flags;
    const page_part p = part_of(s, hit.part, panel);
    shade_vec3 P[3], N[3], point, normal, eye = shade_v3(0, 0, state.distance);
    corners_of(&p, hit.triangle, P, N);
    for (int k = 0; k < 3; k++) {
        answer.corner[k] = P[k];
        answer.normal[k] = N[k];
    }
    answer.weights = hit.weights;
    answer.material = p.material;
    answer.part = (float)hit.part;
    s->draw.material = &p.material;
    point = mix(P, hit.weights);
    answer.mark = shade_mat4_transform_direction(shade_mat4_transpose(p.turned), point);
    normal = shade_normalize(mix(N, hit.weights));
    if (s->draw.shading == SHADE_SHADING_PER_FACE) {
        normal = shade_face_normal(P[0], P[1], P[2]);
        point = mix(P, shade_v3(1 / 3.0f, 1 / 3.0f, 1 / 3.0f));
    }
    if (s->draw.shading != SHADE_SHADING_PER_VERTEX) {
        P[0] = point;
        N[0] = normal;
    }
    if (flags & SHADE_FLAG_INFINITE_VIEWER) eye = shade_v3(0, 0, 1);
    seen.scene = *s;
    seen.material = p.material;
    seen.eye = eye;
    for (int k = 0; k < 3; k++) {
        seen.P[k] = P[k];
        seen.N[k] = N[k];
    }
    answer.hit = 1;
    answer_terms(s, &light, state.lamp[lamp].on != 0, eye, P, N, hit.weights);
    if (!(flags & SHADE_FLAG_INFINITE_VIEWER)) eye = shade_normalize(shade_sub(eye, point));
    if ((flags & SHADE_FLAG_TWO_SIDED) && shade_dot(normal, eye) < 0) normal = shade_neg(normal);
    factors(&s->draw.lighting, &light, eye, point, normal, p.material.shininess, answer.unit);
    answer.place = point;
    answer_places(s, width, (float)(panel < 0 ? 0 : panel * width));
    return &answer;
}

/* Fills the answer for a point of the picture. */
PAGE(const page_answer *, page_probe)(float x, float y)
{
    static const page_answer none;
    const int panel = state.compare == 0 ? -1 : (int)x / panel_width(0) < 2
                    ? (int)x / panel_width(0) : 2;
    page_scene s;
    page_hit hit;
    answer = none;
    scene_of(&s, panel);
    if (panel > 0) x -= (float)(panel * panel_width(0));
    hit = meet(&s, panel, shade_pixel_ray(s.draw.view, s.draw.projection, panel_width(panel),
                                          (int)state.height, x, y));
    return hit.triangle < 0 ? &answer : answer_hit(&s, panel, hit);
}

/* Fills the answer for a mark, which turns with its part.  Where the mesh has changed and the mark
   is no longer on it, what the eye sees in that direction is marked, or in the middle. */
PAGE(const page_answer *, page_probe_mark)(int panel, int part, float x, float y, float z)
{
    static const page_answer none;
    const shade_vec3 eye = shade_v3(0, 0, state.distance);
    page_scene s;
    page_part p;
    page_hit hit = { part, -1, 0, { 0, 0, 0 } }, first;
    shade_vec3 P;
    shade_ray ray = { { 0, 0, state.distance }, { 0, 0, -1 } };
    answer = none;
    if (state.compare == 0) panel = -1;
    scene_of(&s, panel);
    p = part_of(&s, part, panel);
    P = shade_mat4_transform_direction(p.turned, shade_v3(x, y, z));
    ray.direction = shade_normalize(shade_sub(P, eye));
    first = meet(&s, panel, ray);
    ray.origin = shade_madd(P, -0.05f, ray.direction);
    hit.triangle = shade_pick(p.mesh, p.model, ray, &hit.t, &hit.weights);
    if (hit.triangle < 0 || hit.t > 0.15f) {
        if (first.triangle < 0) {
            ray.origin = eye;
            ray.direction = shade_v3(0, 0, -1);
            first = meet(&s, panel, ray);
        }
        hit = first;
    }
    if (hit.triangle < 0) return &answer;
    answer_hit(&s, panel, hit);
    answer.hidden = first.triangle != hit.triangle || first.part != hit.part;
    return &answer;
}

/* Fills the answer for one of the points where the equation was evaluated for what was marked last
   (by vertex: corner 0, 1 or 2; else 0 alone), and for one lamp. */
PAGE(const page_answer *, page_factors)(int corner, int lamp)
{
    page_scene *s = &seen.scene;
    const shade_light light = lamp_of(&state.lamp[lamp]);
    const unsigned flags = s->draw.lighting.flags;
    const shade_vec3 P = seen.P[corner], w = shade_v3(corner == 0, corner == 1, corner == 2);
    shade_vec3 V = seen.eye, N = shade_normalize(seen.N[corner]);
    s->draw.lighting.lights = s->lamps;
    s->draw.material = &seen.material;
    answer_terms(s, &light, state.lamp[lamp].on != 0, seen.eye, seen.P, seen.N, w);
    if (!(flags & SHADE_FLAG_INFINITE_VIEWER)) V = shade_normalize(shade_sub(V, P));
    if ((flags & SHADE_FLAG_TWO_SIDED) && shade_dot(N, V) < 0) N = shade_neg(N);
    factors(&s->draw.lighting, &light, V, P, N, seen.material.shininess, answer.unit);
    answer.place = P;
    return &answer;
}

/* Fills the answer for L and V so many degrees from an upright N, by a model: 1 for R, 0 for H. */
PAGE(const page_answer *, page_plane)(float to_light, float to_viewer, int model)
{
    static const page_answer none;
    const shade_vec2 l = mesh_turn(to_light / 360), v = mesh_turn(to_viewer / 360);
    const shade_light lamp = shade_directional_light(shade_v3(-l.y, -l.x, 0), shade_v3(1, 1, 1));
    shade_lighting lighting = { 0 };
    lighting.model = (shade_model)model;
    answer = none;
    factors(&lighting, &lamp, shade_v3(v.y, v.x, 0), shade_v3(0, 0, 0), shade_v3(0, 1, 0),
            state.material.shininess, answer.unit);
    return &answer;
}

/* ---- presets --------------------------------------------------------------------------------- */

PAGE(const shade_material *, page_preset)(int i)
{
    static shade_material m;
    m = shade_linear_material(shade_preset_material((shade_preset)i));
    return &m;
}

PAGE(const char *, page_preset_name)(int i) { return shade_preset_name((shade_preset)i); }
