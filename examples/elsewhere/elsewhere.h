/* elsewhere.h - materials and lamps of other renderers, said in shade.h's words.

   Each program has one function.  It takes the numbers under the program's own names and gives a
   look: the material, the model and flags of shade_lighting, what lamps must be multiplied by,
   where V points to and how light becomes bytes.  elsewhere_lit_lanes then lights a packet as the
   program does, and elsewhere_fragment is that as the fragment shader of a draw state:

       elsewhere_look look = elsewhere_vtk((elsewhere_vtk_numbers){
           .color = { 1, .8f, .6f }, .specular_color = { 1, 1, 1 },
           .diffuse = .6f, .specular = .8f, .power = 30 });
       elsewhere_lamp lamp = elsewhere_lamp_of(shade_directional_light(to, white));
       elsewhere_scene scene = { &look, &lamp, 1, .ambient = { 1, 1, 1 }, .view = view };
       state.fragment = elsewhere_fragment;
       state.uniforms = &scene;

   The colours that come out are display values: draw them to a target without .srgb, or set
   scene.linear.  Where look.law is ELSEWHERE_LAW_FOUR and lamps have neither rim nor range,
   elsewhere_lighting gives a shade_lighting that does the same without a shader.  Where
   look.refused is not NULL, the program does something that nothing here can say, and the sentence
   tells what.

   Above each function stand version and source of its law: the specification where there is one,
   else what its pictures showed.  tables/ has pixels that the real programs drew, measure/ the
   scripts that made them, README.md by how much they differ. */
#ifndef ELSEWHERE_H
#define ELSEWHERE_H

#include "../../shade.h"
#include <math.h>
#include <string.h>

/* Where V points to: against the ray of the pixel, which under parallel projection is the camera's
   backward axis; to the camera's position, under parallel projection too; along the camera's
   backward axis, in perspective too */
typedef enum elsewhere_viewer {
    ELSEWHERE_VIEWER_RAY = 0,
    ELSEWHERE_VIEWER_POINT,
    ELSEWHERE_VIEWER_AXIS
} elsewhere_viewer;

/* How light of 0 .. 1 becomes a display value: as it is, by sRGB's curve, light^(1/2.2),
   light^(1/2) */
typedef enum elsewhere_encoding {
    ELSEWHERE_ENCODING_NONE = 0,
    ELSEWHERE_ENCODING_SRGB,
    ELSEWHERE_ENCODING_GAMMA,
    ELSEWHERE_ENCODING_ROOT
} elsewhere_encoding;

/* What lights a point; number is elsewhere_look.number.
     FOUR       iteration four, as shade_lit_lanes
     SCHLICK    F times number is in the place of k_s; with c = V.H,
                F = k_s + (1 - k_s) 2^((-5.55473 c - 6.98316) c)
     POWER      N.L of the diffuse term becomes (N.L)^number
     STEPS      N.L becomes .7 where it is less than number, also behind, else 1; no highlight
     EXPONENT   k_a + k_s exp(-number (1 - R.V)); no N.L at all
     SIGNED     k_a + k_d N.L, which is negative behind
     SHIFTED    (number + R.V)^n in place of (R.V)^n; below 0 where n is an odd number
     BLEND      of one lamp: k_a + k_d N.L, mixed toward k_s by (N.L)^number
     RAMP       of one lamp and s = 63 min(diffuse N.L + specular (R.V)^n, 1), diffuse and specular
                those of the look: k_a at 0, k_d at 52, from there mixed toward k_s, by .4
                at 63 */
typedef enum elsewhere_law {
    ELSEWHERE_LAW_FOUR = 0,
    ELSEWHERE_LAW_SCHLICK,
    ELSEWHERE_LAW_POWER,
    ELSEWHERE_LAW_STEPS,
    ELSEWHERE_LAW_EXPONENT,
    ELSEWHERE_LAW_SIGNED,
    ELSEWHERE_LAW_SHIFTED,
    ELSEWHERE_LAW_BLEND,
    ELSEWHERE_LAW_RAMP
} elsewhere_law;

/* A material of another program */
typedef struct elsewhere_look {
    shade_material material;
    shade_model model;
    unsigned flags; /* without SHADE_FLAG_INFINITE_VIEWER, which viewer decides */
    elsewhere_viewer viewer;
    elsewhere_encoding encoding;
    int cut;                 /* non-zero: bytes are cut, not rounded */
    float diffuse, specular; /* multiply I_d and I_s of every lamp */
    float head_diffuse;      /* I_d and I_s of a white lamp that the program has at the */
    float head_specular;     /* camera, which shines along its axis; 0: none */
    shade_vec3 own;          /* toward a white lamp at infinity that the program has; 0: none */
    int own_turns;           /* non-zero: own is along the camera's axes, not the world's */
    int tilted;              /* non-zero: I_d of a lamp toward unit L is 2 / (1 + z) as */
                             /* bright, z along the camera's backward axis */
    elsewhere_law law;
    float number;
    shade_vec3 most;     /* of emission, ambient and diffuse light together; 0: no bound */
    const char *refused; /* what cannot be said, or NULL */
} elsewhere_look;

/* How a cone ends between the angles inner and outer off its axis: not at all, but for the cone of
   light.spot_cos_cutoff; linearly in the angle; by smoothstep of the cosine */
typedef enum elsewhere_rim {
    ELSEWHERE_RIM_HARD = 0,
    ELSEWHERE_RIM_ANGLE,
    ELSEWHERE_RIM_COSINE
} elsewhere_rim;

/* What distance r does to a lamp of reach d, besides light.constant, linear and quadratic.
     LINEAR   max(0, 1 - r/d)
     CUT      1 up to d, 0 beyond
     WINDOW   1 / max(r^power, .01), times max(0, 1 - (r/d)^4)^2 where d is not 0
     FADE     2 / (1 + (r/d)^power) */
typedef enum elsewhere_range {
    ELSEWHERE_RANGE_NONE = 0,
    ELSEWHERE_RANGE_LINEAR,
    ELSEWHERE_RANGE_CUT,
    ELSEWHERE_RANGE_WINDOW,
    ELSEWHERE_RANGE_FADE
} elsewhere_range;

/* What is odd about the highlight of a lamp.
     SQUARED   it has 1 / (a + b r + c r^2) twice
     WHOLE     it is not dimmed at all, where any light arrives
     AIM       it stands where light along the lamp's aim would put it
     LONG      H is along reach L + V in place of L + V, and the lamp's colour does not count */
typedef enum elsewhere_highlight {
    ELSEWHERE_HIGHLIGHT_PLAIN = 0,
    ELSEWHERE_HIGHLIGHT_SQUARED,
    ELSEWHERE_HIGHLIGHT_WHOLE,
    ELSEWHERE_HIGHLIGHT_AIM,
    ELSEWHERE_HIGHLIGHT_LONG
} elsewhere_highlight;

/* A lamp of another program.  Rim and range become a row of visibility. */
typedef struct elsewhere_lamp {
    shade_light light;
    elsewhere_rim rim;
    float inner, outer; /* radians */
    elsewhere_range range;
    float reach, power;
    int at_most_one; /* non-zero: 1 / (a + b r + c r^2) is at most 1 */
    elsewhere_highlight highlight;
} elsewhere_lamp;

enum {
    ELSEWHERE_LAMPS = 8,                      /* more lamps of yours than these are dark */
    ELSEWHERE_ALL_LAMPS = ELSEWHERE_LAMPS + 2 /* with the program's own */
};

/* What elsewhere_lit_lanes and elsewhere_fragment read.  A zero view is the identity. */
typedef struct elsewhere_scene {
    const elsewhere_look *look;
    const elsewhere_lamp *lamps;
    int lamp_count;
    shade_vec3 ambient; /* I_a: most programs have 1, 1, 1 */
    shade_mat4 view;    /* rotation and translation, from the world to the camera */
    int parallel;       /* non-zero: the projection is a parallel one */
    int linear;         /* non-zero: colours come out as the linear light that sRGB shows */
                        /* so, for targets with .srgb and for blending */
} elsewhere_scene;

/*------------------------------------------------------------------------------------------ laws */

static inline elsewhere_lamp elsewhere_lamp_of(shade_light light)
{
    elsewhere_lamp lamp;
    memset(&lamp, 0, sizeof lamp);
    lamp.light = light;
    return lamp;
}

/* The factor of a soft rim at unit L, 0 .. 1 */
static inline float elsewhere_rim_at(const elsewhere_lamp *lamp, shade_vec3 L)
{
    const shade_vec3 aim = shade_normalize(lamp->light.spot_direction);
    const float cosine = fminf(fmaxf(-shade_dot(L, aim), -1), 1);
    float t;
    if (lamp->rim == ELSEWHERE_RIM_HARD) return 1;
    if (lamp->rim == ELSEWHERE_RIM_ANGLE)
        t = (lamp->outer - acosf(cosine)) / fmaxf(lamp->outer - lamp->inner, 1e-6f);
    else
        t = (cosine - cosf(lamp->outer)) / fmaxf(cosf(lamp->inner) - cosf(lamp->outer), 1e-6f);
    t = fminf(fmaxf(t, 0), 1);
    return lamp->rim == ELSEWHERE_RIM_COSINE ? t * t * (3 - 2 * t) : t;
}

/* x^n for any x >= 0 */
static inline float elsewhere_raise(float x, float n)
{
    return x <= 1 ? shade_power(x, n) : 1 / fmaxf(shade_power(1 / x, n), 1e-30f);
}

/* The factor of distance r, beside 1 / (a + b r + c r^2) */
static inline float elsewhere_range_at(const elsewhere_lamp *lamp, float r)
{
    const float part = lamp->reach > 0 ? r / lamp->reach : 0;
    const float window = fmaxf(1 - part * part * part * part, 0);
    switch (lamp->range) {
    case ELSEWHERE_RANGE_LINEAR: return fmaxf(1 - part, 0);
    case ELSEWHERE_RANGE_CUT: return part <= 1 ? 1.0f : 0.0f;
    case ELSEWHERE_RANGE_WINDOW:
        return window * window / fmaxf(elsewhere_raise(r, lamp->power), 0.01f);
    case ELSEWHERE_RANGE_FADE: return 2 / (1 + elsewhere_raise(part, lamp->power));
    default: return 1;
    }
}

/* How much of a lamp is visible at P: the factor of rim and range */
static inline float elsewhere_visibility(const elsewhere_lamp *lamp, shade_vec3 P)
{
    shade_vec3 L;
    float r, sum, factor;
    shade_light_at(&lamp->light, P, &L, &r);
    factor = elsewhere_rim_at(lamp, L);
    if (lamp->light.position.w == 0) return factor;
    sum = lamp->light.constant + lamp->light.linear * r + lamp->light.quadratic * r * r;
    if (lamp->at_most_one && sum > 0 && sum < 1) factor *= sum;
    return factor * elsewhere_range_at(lamp, r);
}

/* The camera's backward axis in the world, and its position */
static inline shade_vec3 elsewhere_axis(const elsewhere_scene *s)
{
    const shade_vec4 *c = s->view.col;
    const shade_vec3 axis = { c[0].z, c[1].z, c[2].z };
    return shade_dot(axis, axis) > 0 ? shade_normalize(axis) : shade_v3(0, 0, 1);
}
static inline shade_vec3 elsewhere_eye(const elsewhere_scene *s)
{
    const shade_vec4 *c = s->view.col, t = c[3];
    return shade_neg(shade_v3(c[0].x * t.x + c[0].y * t.y + c[0].z * t.z,
                              c[1].x * t.x + c[1].y * t.y + c[1].z * t.z,
                              c[2].x * t.x + c[2].y * t.y + c[2].z * t.z));
}

/* A white lamp at infinity */
static inline shade_light elsewhere_white(shade_vec3 toward, float diffuse, float specular)
{
    shade_light light = shade_directional_light(shade_neg(toward), shade_v3(1, 1, 1));
    light.diffuse = shade_scale(light.diffuse, diffuse);
    light.specular = shade_scale(light.specular, specular);
    return light;
}

/* The lighting of a scene as shade_lit takes it, with room for ELSEWHERE_ALL_LAMPS; *eye
   becomes the eye that goes with it. */
static inline shade_lighting elsewhere_lighting(const elsewhere_scene *s, shade_light *lamps,
                                                shade_vec3 *eye)
{
    const elsewhere_look *k = s->look;
    const shade_vec3 axis = elsewhere_axis(s);
    const int far =
        k->viewer == ELSEWHERE_VIEWER_AXIS || (s->parallel && k->viewer == ELSEWHERE_VIEWER_RAY);
    shade_lighting out;
    memset(&out, 0, sizeof out);
    for (int i = 0; i < s->lamp_count && i < ELSEWHERE_LAMPS; i++) {
        const shade_vec4 at = s->lamps[i].light.position;
        float tilt = 1;
        if (k->tilted) tilt = shade_dot(shade_normalize(shade_v3(at.x, at.y, at.z)), axis);
        if (k->tilted) tilt = 2 / fmaxf(1 + tilt, 1e-6f);
        lamps[i] = s->lamps[i].light;
        lamps[i].diffuse = shade_scale(lamps[i].diffuse, k->diffuse * tilt);
        lamps[i].specular = shade_scale(lamps[i].specular, k->specular);
        out.light_count = i + 1;
    }
    if (k->head_diffuse > 0 || k->head_specular > 0)
        lamps[out.light_count++] = elsewhere_white(axis, k->head_diffuse, k->head_specular);
    if (shade_dot(k->own, k->own) > 0) {
        const shade_vec4 *c = s->view.col;
        const shade_vec3 turned = { shade_dot(shade_v3(c[0].x, c[0].y, c[0].z), k->own),
                                    shade_dot(shade_v3(c[1].x, c[1].y, c[1].z), k->own),
                                    shade_dot(shade_v3(c[2].x, c[2].y, c[2].z), k->own) };
        const int turns = k->own_turns && shade_dot(turned, turned) > 0;
        lamps[out.light_count++] = elsewhere_white(turns ? turned : k->own, 1, 1);
    }
    out.lights = lamps;
    out.ambient = s->ambient;
    out.model = k->model;
    out.flags = k->flags | (far ? (unsigned)SHADE_FLAG_INFINITE_VIEWER : 0u);
    *eye = far ? axis : elsewhere_eye(s);
    return out;
}

/* 0 .. 1 as a byte of a target without .srgb will show it */
static inline float elsewhere_encode(const elsewhere_look *k, float light)
{
    float v = fminf(fmaxf(light, 0), 1);
    if (k->encoding == ELSEWHERE_ENCODING_SRGB) v = shade_srgb_from_linear(shade_v3(v, v, v)).x;
    if (k->encoding == ELSEWHERE_ENCODING_GAMMA) v = shade_power(v, 1 / 2.2f);
    if (k->encoding == ELSEWHERE_ENCODING_ROOT) v = sqrtf(v);
    return k->cut ? floorf(255 * v + 1e-3f) / 255 : v;
}

/* One lane, with unit vectors */
typedef struct elsewhere_point {
    shade_vec3 P, N, V;
} elsewhere_point;

/* What the passes of a packet share */
typedef struct elsewhere_packet {
    const elsewhere_look *look;
    shade_lighting all;
    shade_vec3 eye;
    shade_rows rows;
} elsewhere_packet;

static inline elsewhere_point elsewhere_at(const elsewhere_packet *k, int lane)
{
    const float *P = k->rows.position + lane, *N = k->rows.normal + lane;
    const int far = (k->all.flags & SHADE_FLAG_INFINITE_VIEWER) != 0;
    elsewhere_point p;
    p.P = shade_v3(P[0], P[SHADE_LANES], P[2 * SHADE_LANES]);
    p.N = shade_normalize(shade_v3(N[0], N[SHADE_LANES], N[2 * SHADE_LANES]));
    p.V = shade_normalize(far ? k->eye : shade_sub(k->eye, p.P));
    return p;
}

/* Schlick's F at V.H, with a power of two in place of the fifth power */
static inline float elsewhere_schlick(float f0, float v_dot_h)
{
    const float f = shade_power(0.5f, (5.55473f * v_dot_h + 6.98316f) * v_dot_h);
    return f0 * (1 - f) + f;
}

/* Rows that multiply k_s for one lamp: the factor of distance and cone where N.L > 0, else 0 */
static inline void elsewhere_amounts(const elsewhere_packet *k, const shade_light *lamp,
                                     float *rows)
{
    for (int i = 0; i < SHADE_LANES; i++) {
        const elsewhere_point p = elsewhere_at(k, i);
        shade_vec3 L;
        float amount = shade_light_at(lamp, p.P, &L, NULL);
        if (!(shade_dot(p.N, L) > 0)) amount = 0;
        rows[i] = rows[i + SHADE_LANES] = rows[i + 2 * SHADE_LANES] = amount;
    }
}

/* Adds the highlight of a lamp as if neither distance nor cone dimmed it. */
static inline void elsewhere_add_whole(const elsewhere_packet *k, const shade_light *lamp,
                                       float *rgb)
{
    shade_light whole = *lamp;
    shade_lighting single = k->all;
    float any[SHADE_LANES], one[3 * SHADE_LANES];
    shade_rows rows = k->rows;
    whole.constant = whole.linear = whole.quadratic = 0;
    whole.spot_exponent = 0;
    single.lights = &whole;
    single.light_count = 1;
    single.terms = SHADE_TERM_SPECULAR;
    for (int i = 0; i < SHADE_LANES; i++) any[i] = rows.visibility[i] > 0 ? 1.0f : 0.0f;
    rows.visibility = any;
    shade_lit_lanes(&single, &k->look->material, k->eye, &rows, one);
    for (int i = 0; i < 3 * SHADE_LANES; i++) rgb[i] += one[i];
}

/* Adds the highlight of a lamp as if its light came along its aim everywhere. */
static inline void elsewhere_add_aimed(const elsewhere_packet *k, const shade_light *lamp,
                                       float *rgb)
{
    shade_light along = shade_directional_light(lamp->spot_direction, lamp->specular);
    shade_lighting single = k->all;
    float factor[3 * SHADE_LANES], one[3 * SHADE_LANES];
    shade_rows rows = k->rows;
    single.lights = &along;
    single.light_count = 1;
    single.terms = SHADE_TERM_SPECULAR;
    single.flags |= SHADE_FLAG_UNGATED_SPECULAR;
    elsewhere_amounts(k, lamp, factor);
    rows.specular = factor;
    shade_lit_lanes(&single, &k->look->material, k->eye, &rows, one);
    for (int i = 0; i < 3 * SHADE_LANES; i++) rgb[i] += one[i];
}

/* Adds the highlight of a lamp at infinity whose H is along reach L + V. */
static inline void elsewhere_add_long(const elsewhere_packet *k, const elsewhere_lamp *lamp,
                                      float *rgb)
{
    const shade_material *m = &k->look->material;
    for (int i = 0; i < SHADE_LANES; i++) {
        const elsewhere_point p = elsewhere_at(k, i);
        shade_vec3 L, H;
        float lobe = k->look->specular * k->rows.visibility[i];
        shade_light_at(&lamp->light, p.P, &L, NULL);
        H = shade_normalize(shade_madd(p.V, lamp->reach, L));
        lobe *= shade_dot(p.N, L) > 0 ? shade_power(fmaxf(shade_dot(p.N, H), 0), m->shininess) : 0;
        rgb[i] += m->specular.x * lobe;
        rgb[i + SHADE_LANES] += m->specular.y * lobe;
        rgb[i + 2 * SHADE_LANES] += m->specular.z * lobe;
    }
}

/* Rows in place of k_s for one lamp: F times the look's number */
static inline void elsewhere_fresnel(const elsewhere_packet *k, const shade_light *lamp,
                                     float *rows)
{
    const shade_vec3 f0 = k->look->material.specular;
    for (int i = 0; i < SHADE_LANES; i++) {
        const elsewhere_point p = elsewhere_at(k, i);
        shade_vec3 L;
        float cosine;
        shade_light_at(lamp, p.P, &L, NULL);
        cosine = shade_dot(p.V, shade_halfway(L, p.V));
        rows[i] = k->look->number * elsewhere_schlick(f0.x, cosine);
        rows[i + SHADE_LANES] = k->look->number * elsewhere_schlick(f0.y, cosine);
        rows[i + 2 * SHADE_LANES] = k->look->number * elsewhere_schlick(f0.z, cosine);
    }
}

/* What ELSEWHERE_LAW_BLEND and _RAMP add to k_a, of a lamp at N.L = cosine */
static inline shade_vec3 elsewhere_toward(const elsewhere_look *k, float cosine, float lobe)
{
    const shade_material *m = &k->material;
    const float w = fmaxf(cosine, 0);
    shade_vec3 bright = shade_madd(m->ambient, w, m->diffuse);
    float part = shade_power(w, k->number);
    if (k->law == ELSEWHERE_LAW_RAMP) {
        const float s = 63 * fminf(cosine > 0 ? k->diffuse * w + k->specular * lobe : 0, 1);
        bright = shade_lerp(m->ambient, m->diffuse, fminf(s / 52, 1));
        part = 0.4f / 11 * fmaxf(s - 52, 0);
    }
    return shade_sub(shade_lerp(bright, m->specular, part), m->ambient);
}

/* What one lamp adds at a point by a law that has another N.L, or none.  The highlight of
   ELSEWHERE_LAW_POWER is not in it. */
static inline shade_vec3 elsewhere_other(const elsewhere_look *k, const shade_light *lamp,
                                         elsewhere_point p)
{
    shade_vec3 L;
    const float amount = shade_light_at(lamp, p.P, &L, NULL);
    const float cosine = shade_dot(p.N, L);
    float weight = cosine;
    if (k->law == ELSEWHERE_LAW_EXPONENT) {
        const float turn = 1 - shade_dot(shade_mirror(L, p.N), p.V);
        return shade_scale(shade_mul(k->material.specular, lamp->specular),
                           amount * shade_power(0.36787944f, k->number * turn));
    }
    if (k->law == ELSEWHERE_LAW_SHIFTED) {
        const float base = k->number + shade_dot(shade_mirror(L, p.N), p.V);
        const float lobe = powf(base, k->material.shininess);
        const shade_vec3 k_s = shade_mul(k->material.specular, lamp->specular);
        const shade_vec3 k_d = shade_mul(k->material.diffuse, lamp->diffuse);
        return shade_scale(shade_madd(shade_scale(k_d, cosine), lobe, k_s),
                           cosine > 0 ? amount : 0);
    }
    if (k->law == ELSEWHERE_LAW_BLEND || k->law == ELSEWHERE_LAW_RAMP) {
        const float turn = fmaxf(shade_dot(shade_mirror(L, p.N), p.V), 0);
        return elsewhere_toward(k, cosine, shade_power(turn, k->material.shininess));
    }
    if (k->law == ELSEWHERE_LAW_STEPS) weight = cosine < k->number ? 0.7f : 1;
    if (k->law == ELSEWHERE_LAW_POWER) weight = cosine > 0 ? shade_power(cosine, k->number) : 0;
    return shade_scale(shade_mul(k->material.diffuse, lamp->diffuse), weight * amount);
}

/* Adds what one lamp gives; rows.visibility is the lamp's. */
static inline void elsewhere_add_lamp(const elsewhere_packet *k, const shade_light *lamp,
                                      const elsewhere_lamp *own, float *rgb)
{
    const elsewhere_highlight highlight = own ? own->highlight : ELSEWHERE_HIGHLIGHT_PLAIN;
    const elsewhere_law law = k->look->law;
    float one[3 * SHADE_LANES], factor[3 * SHADE_LANES];
    shade_lighting single = k->all;
    shade_material material = k->look->material;
    shade_rows rows = k->rows;
    memset(one, 0, sizeof one);
    single.lights = lamp;
    single.light_count = 1;
    single.terms = SHADE_TERM_SPECULAR;
    if (law == ELSEWHERE_LAW_FOUR || law == ELSEWHERE_LAW_SCHLICK)
        single.terms |= SHADE_TERM_DIFFUSE;
    if (law == ELSEWHERE_LAW_SCHLICK) {
        elsewhere_fresnel(k, lamp, factor);
        material.specular = shade_v3(1, 1, 1);
        rows.specular = factor;
    } else if (highlight == ELSEWHERE_HIGHLIGHT_SQUARED) {
        elsewhere_amounts(k, lamp, factor);
        rows.specular = factor;
    } else if (highlight == ELSEWHERE_HIGHLIGHT_WHOLE) {
        elsewhere_add_whole(k, lamp, rgb);
        single.terms = SHADE_TERM_DIFFUSE;
    } else if (highlight == ELSEWHERE_HIGHLIGHT_AIM) {
        elsewhere_add_aimed(k, lamp, rgb);
        single.terms = SHADE_TERM_DIFFUSE;
    } else if (highlight == ELSEWHERE_HIGHLIGHT_LONG) {
        elsewhere_add_long(k, own, rgb);
        single.terms = SHADE_TERM_DIFFUSE;
    }
    if (law <= ELSEWHERE_LAW_POWER) shade_lit_lanes(&single, &material, k->eye, &rows, one);
    for (int i = 0; i < SHADE_LANES; i++) {
        shade_vec3 other = { 0, 0, 0 };
        if (law >= ELSEWHERE_LAW_POWER) other = elsewhere_other(k->look, lamp, elsewhere_at(k, i));
        other = shade_scale(other, rows.visibility[i]);
        rgb[i] += one[i] + other.x;
        rgb[i + SHADE_LANES] += one[i + SHADE_LANES] + other.y;
        rgb[i + 2 * SHADE_LANES] += one[i + 2 * SHADE_LANES] + other.z;
    }
}

/* Adds all lamps, each for itself, where one of them or the law is not iteration four's. */
static inline void elsewhere_add_lamps(elsewhere_packet *k, const elsewhere_scene *s, float *rgb)
{
    const float *visibility = k->rows.visibility;
    for (int j = 0; j < k->all.light_count; j++) {
        k->rows.visibility = &visibility[j * SHADE_LANES];
        elsewhere_add_lamp(k, &k->all.lights[j], j < s->lamp_count ? &s->lamps[j] : NULL, rgb);
    }
    k->rows.visibility = visibility;
}

/* Light as shade_lit_lanes gives it, but that the sum without highlights has a bound */
static inline void elsewhere_bounded(const elsewhere_packet *k, float *rgb)
{
    const float most[3] = { k->look->most.x, k->look->most.y, k->look->most.z };
    shade_lighting terms = k->all;
    float specular[3 * SHADE_LANES];
    terms.terms = SHADE_TERM_SPECULAR;
    shade_lit_lanes(&terms, &k->look->material, k->eye, &k->rows, specular);
    terms.terms = SHADE_TERM_EMISSION | SHADE_TERM_AMBIENT | SHADE_TERM_DIFFUSE;
    shade_lit_lanes(&terms, &k->look->material, k->eye, &k->rows, rgb);
    for (int i = 0; i < 3 * SHADE_LANES; i++) {
        const float bound = most[i / SHADE_LANES];
        if (bound > 0) rgb[i] = fminf(rgb[i], bound);
        rgb[i] += specular[i];
    }
}

/* Turns normals toward the camera's side by its axis, for programs that turn faces so although V
   goes to a point, and leaves SHADE_FLAG_TWO_SIDED nothing to turn. */
static inline void elsewhere_turn(elsewhere_packet *k, shade_vec3 axis, float *turned)
{
    for (int i = 0; i < SHADE_LANES; i++) {
        const shade_vec3 N = elsewhere_at(k, i).N;
        const float side = shade_dot(N, axis) < 0 ? -1.0f : 1.0f;
        turned[i] = side * N.x;
        turned[i + SHADE_LANES] = side * N.y;
        turned[i + 2 * SHADE_LANES] = side * N.z;
    }
    k->rows.normal = turned;
    k->all.flags &= ~(unsigned)SHADE_FLAG_TWO_SIDED;
}

/* Lights the points of a packet as the program does.  P, N and rgb are three rows each, as of
   shade_lit_lanes; rgb becomes display values of 0 .. 1. */
static inline void elsewhere_lit_lanes(const elsewhere_scene *s, const float *P, const float *N,
                                       float *rgb)
{
    float visibility[ELSEWHERE_ALL_LAMPS * SHADE_LANES], turned[3 * SHADE_LANES];
    shade_light lamps[ELSEWHERE_ALL_LAMPS];
    elsewhere_packet k = { .look = s->look, .rows = { P, N, NULL, NULL, visibility } };
    int apart = s->look->law != ELSEWHERE_LAW_FOUR;
    k.all = elsewhere_lighting(s, lamps, &k.eye);
    if (s->parallel && s->look->viewer == ELSEWHERE_VIEWER_POINT &&
        (k.all.flags & SHADE_FLAG_TWO_SIDED))
        elsewhere_turn(&k, elsewhere_axis(s), turned);
    for (int j = 0; j < k.all.light_count; j++) {
        const elsewhere_lamp *lamp = j < s->lamp_count ? &s->lamps[j] : NULL;
        apart |= lamp && lamp->highlight;
        for (int i = 0; i < SHADE_LANES; i++)
            visibility[j * SHADE_LANES + i] =
                lamp ? elsewhere_visibility(lamp, elsewhere_at(&k, i).P) : 1;
    }
    if (apart) {
        shade_lighting none = k.all;
        none.light_count = 0;
        shade_lit_lanes(&none, &s->look->material, k.eye, &k.rows, rgb);
        elsewhere_add_lamps(&k, s, rgb);
    } else
        elsewhere_bounded(&k, rgb);
    for (int i = 0; i < 3 * SHADE_LANES; i++) {
        const float v = elsewhere_encode(s->look, rgb[i]);
        rgb[i] = s->linear ? shade_linear_from_srgb(shade_v3(v, v, v)).x : v;
    }
}

/* The same as the fragment shader of a draw state, whose uniforms are an elsewhere_scene */
static inline void elsewhere_fragment(const void *uniforms,
                                      const shade_fragments *SHADE_RESTRICT in,
                                      shade_colors *SHADE_RESTRICT out)
{
    elsewhere_lit_lanes((const elsewhere_scene *)uniforms, in->varying[SHADE_VARYING_POSITION],
                        in->varying[SHADE_VARYING_NORMAL], out->color[0]);
}

/*---------------------------------------------------------------------------------------- programs
   Colours are linear unless told.  scene.ambient is 1, 1, 1 unless told.
   The struct of a program holds shade_vec3 and float alone, in the order of its row in
   elsewhere_rows, where its defaults stand. */

static inline elsewhere_look elsewhere_plain(shade_model kind)
{
    elsewhere_look k;
    memset(&k, 0, sizeof k);
    k.model = kind;
    k.diffuse = k.specular = 1;
    return k;
}
static inline shade_vec3 elsewhere_grey(float v) { return shade_v3(v, v, v); }

/* VTK 9.1.0 and ParaView 5.11: vtkProperty.  (R.V)^SpecularPower, V toward the camera's position
   even under parallel projection.  Surfaces are always lit on both sides; SetTwoSidedLighting(0)
   changes nothing.  Lamps do not multiply the ambient term.  Measured. */
typedef struct elsewhere_vtk_numbers {
    shade_vec3 color, specular_color;
    float ambient, diffuse, specular, power;
} elsewhere_vtk_numbers;
static inline elsewhere_look elsewhere_vtk(elsewhere_vtk_numbers v)
{
    elsewhere_look k = elsewhere_plain(SHADE_MODEL_PHONG);
    k.material.ambient = shade_scale(v.color, v.ambient);
    k.material.diffuse = shade_scale(v.color, v.diffuse);
    k.material.specular = shade_scale(v.specular_color, v.specular);
    k.material.shininess = v.power;
    k.flags = SHADE_FLAG_TWO_SIDED;
    k.viewer = ELSEWHERE_VIEWER_POINT;
    return k;
}

/* POV-Ray 3.7.0: finish, of a pigment in linear rgb.  phong is (R.V)^phong_size, specular
   (N.H)^(1/roughness), each where N.L > 0 alone.  brilliance b is (N.L)^b.  albedo, if not 0, says
   that diffuse, phong and specular carry the word albedo: diffuse is then (b + 1)/2 as large, phong
   (n + 1)/2, specular (n + 2) / (4 (2 - 2^(-n/2))).  Bytes are sRGB.  Measured; the words are those
   of POV-Ray's reference, "Finish". */
typedef struct elsewhere_povray_numbers {
    shade_vec3 color;
    float ambient, diffuse, phong, phong_size, specular, roughness, brilliance, albedo;
} elsewhere_povray_numbers;
static inline elsewhere_look elsewhere_povray(elsewhere_povray_numbers v)
{
    const int phong = v.phong > 0;
    const float n = phong ? v.phong_size : 1 / fmaxf(v.roughness, 1e-6f);
    const float blinn_scale = (n + 2) / (4 * (2 - shade_power(0.5f, n / 2)));
    const float k_s = phong ? v.phong : v.specular;
    elsewhere_look k = elsewhere_plain(phong ? SHADE_MODEL_PHONG : SHADE_MODEL_BLINN_PHONG);
    k.material.ambient = shade_scale(v.color, v.ambient);
    k.material.diffuse =
        shade_scale(v.color, v.diffuse * (v.albedo > 0 ? (v.brilliance + 1) / 2 : 1));
    k.material.specular = elsewhere_grey(k_s);
    if (v.albedo > 0)
        k.material.specular = elsewhere_grey(k_s * (phong ? (n + 1) / 2 : blinn_scale));
    k.material.shininess = n;
    k.encoding = ELSEWHERE_ENCODING_SRGB;
    if (v.brilliance != 1) k.law = ELSEWHERE_LAW_POWER;
    k.number = v.brilliance;
    if (phong && v.specular > 0) k.refused = "phong and specular at once are two highlights";
    return k;
}

/* three.js 0.187.0: MeshPhongMaterial, of colours in linear light. A lamp of intensity i gives
   colour i N.L / pi and F (n + 2) / (8 pi) (N.H)^n i N.L, F being Schlick's at V.H: so k_s alone
   does not say how bright a highlight is. The default specular, 0x111111, is .0056 in linear
   light. The sum of color times intensity of AmbientLights is scene.ambient. Bytes are sRGB.
   Measured; BlinnPhong of three's shaders, lights_phong_pars_fragment. */
typedef struct elsewhere_three_phong_numbers {
    shade_vec3 color, specular, emissive;
    float shininess;
} elsewhere_three_phong_numbers;
static inline elsewhere_look elsewhere_three_phong(elsewhere_three_phong_numbers v)
{
    elsewhere_look k = elsewhere_plain(SHADE_MODEL_BLINN_PHONG);
    k.material.emission = v.emissive;
    k.material.ambient = shade_scale(v.color, 1 / 3.14159265f);
    k.material.diffuse = v.color;
    k.material.specular = v.specular;
    k.material.shininess = v.shininess;
    k.flags = SHADE_FLAG_WEIGHTED_SPECULAR;
    k.encoding = ELSEWHERE_ENCODING_SRGB;
    k.diffuse = k.specular = 1 / 3.14159265f;
    k.law = ELSEWHERE_LAW_SCHLICK;
    k.number = (v.shininess + 2) / 8;
    return k;
}

/* three.js 0.187.0: what its MTLLoader makes of Wavefront's MTL: a MeshPhongMaterial of colours
   that are sRGB in the file.  illum counts for nothing, so that 0 and 1 have highlights too.
   Measured. */
typedef struct elsewhere_three_mtl_numbers {
    shade_vec3 Kd, Ks, Ke;
    float Ns, illum;
} elsewhere_three_mtl_numbers;
static inline elsewhere_look elsewhere_three_mtl(elsewhere_three_mtl_numbers v)
{
    elsewhere_three_phong_numbers phong;
    phong.color = shade_linear_from_srgb(v.Kd);
    phong.specular = shade_linear_from_srgb(v.Ks);
    phong.emissive = shade_linear_from_srgb(v.Ke);
    phong.shininess = v.Ns;
    return elsewhere_three_phong(phong);
}

/* three.js 0.187.0: MeshLambertMaterial, colour i N.L / pi.  Measured. */
typedef struct elsewhere_three_lambert_numbers {
    shade_vec3 color, emissive;
} elsewhere_three_lambert_numbers;
static inline elsewhere_look elsewhere_three_lambert(elsewhere_three_lambert_numbers v)
{
    elsewhere_look k = elsewhere_plain(SHADE_MODEL_LAMBERT);
    k.material.emission = v.emissive;
    k.material.ambient = shade_scale(v.color, 1 / 3.14159265f);
    k.material.diffuse = v.color;
    k.encoding = ELSEWHERE_ENCODING_SRGB;
    k.diffuse = k.specular = 1 / 3.14159265f;
    return k;
}

/* three.js 0.187.0: MeshToonMaterial without a gradientMap: .7 where N.L < .4, behind too, so that
   it is never dark; else 1.  Measured. */
typedef struct elsewhere_three_toon_numbers {
    shade_vec3 color, emissive;
} elsewhere_three_toon_numbers;
static inline elsewhere_look elsewhere_three_toon(elsewhere_three_toon_numbers v)
{
    elsewhere_three_lambert_numbers lambert;
    elsewhere_look k;
    lambert.color = v.color;
    lambert.emissive = v.emissive;
    k = elsewhere_three_lambert(lambert);
    k.law = ELSEWHERE_LAW_STEPS;
    k.number = 0.4f;
    return k;
}

/* Babylon.js 9.35.0: StandardMaterial. (N.H)^specularPower is not gated, so that highlights
   reach behind the terminator, and V goes to the camera's position even under parallel
   projection. The ambientColor of the scene is scene.ambient; it counts times that of the
   material alone. Bytes are light as it is. Measured. */
typedef struct elsewhere_babylon_numbers {
    shade_vec3 diffuse, specular, ambient, emissive;
    float power;
} elsewhere_babylon_numbers;
static inline elsewhere_look elsewhere_babylon(elsewhere_babylon_numbers v)
{
    elsewhere_look k = elsewhere_plain(SHADE_MODEL_BLINN_PHONG);
    k.most = shade_v3(1, 1, 1);
    k.material.emission = v.emissive;
    k.material.ambient = v.ambient;
    k.material.diffuse = v.diffuse;
    k.material.specular = v.specular;
    k.material.shininess = v.power;
    k.flags = SHADE_FLAG_UNGATED_SPECULAR;
    k.viewer = ELSEWHERE_VIEWER_POINT;
    return k;
}

/* X3D as X_ITE 15.0.1 draws its Material: (N.H)^(128 shininess), not gated, V to the camera's
   position even under parallel projection, bytes as they are. Measured; the specification is X3D
   4.0, clause 17.2.2. */
typedef struct elsewhere_x_ite_numbers {
    shade_vec3 diffuseColor, specularColor, emissiveColor;
    float shininess;
} elsewhere_x_ite_numbers;
static inline elsewhere_look elsewhere_x_ite(elsewhere_x_ite_numbers v)
{
    elsewhere_look k = elsewhere_plain(SHADE_MODEL_BLINN_PHONG);
    k.material.emission = v.emissiveColor;
    k.material.diffuse = v.diffuseColor;
    k.material.specular = v.specularColor;
    k.material.shininess = 128 * v.shininess;
    k.flags = SHADE_FLAG_UNGATED_SPECULAR;
    k.viewer = ELSEWHERE_VIEWER_POINT;
    return k;
}

/* X3D as X3DOM 1.8.3 draws it: the same, but that V is against the ray and that bytes are
   light^(1/2.2).  Shininess 0 lights the whole ball.  Measured. */
typedef elsewhere_x_ite_numbers elsewhere_x3dom_numbers;
static inline elsewhere_look elsewhere_x3dom(elsewhere_x3dom_numbers v)
{
    elsewhere_look k = elsewhere_x_ite(v);
    k.viewer = ELSEWHERE_VIEWER_RAY;
    k.encoding = ELSEWHERE_ENCODING_GAMMA;
    return k;
}

/* X3D as view3dscene 4.2.0 of Castle Game Engine draws it: as X_ITE, but that highlights are gated.
   Measured. */
typedef elsewhere_x_ite_numbers elsewhere_view3dscene_numbers;
static inline elsewhere_look elsewhere_view3dscene(elsewhere_view3dscene_numbers v)
{
    elsewhere_look k = elsewhere_x_ite(v);
    k.flags = 0;
    return k;
}

/* p5.js 1.11: fill, specularMaterial, shininess, in the order of its words from 0 to 1. .73 N.L
   and 2 (R.V)^shininess, whatever the colours are; not gated; V to the camera's position even
   under parallel projection. Measured; totalLight of lighting.glsl. */
typedef struct elsewhere_p5_numbers {
    shade_vec3 fill, specular, emissive;
    float shininess;
} elsewhere_p5_numbers;
static inline elsewhere_look elsewhere_p5(elsewhere_p5_numbers v)
{
    elsewhere_look k = elsewhere_plain(SHADE_MODEL_PHONG);
    k.material.emission = v.emissive;
    k.material.ambient = k.material.diffuse = v.fill;
    k.material.specular = v.specular;
    k.material.shininess = v.shininess;
    k.flags = SHADE_FLAG_UNGATED_SPECULAR;
    k.viewer = ELSEWHERE_VIEWER_POINT;
    k.diffuse = 0.73f;
    k.specular = 2;
    return k;
}

/* xeokit 2.6: PhongMaterial. (R.V)^shininess, not gated. A scene's AmbientLights are
   scene.ambient and count times diffuse; the material's ambient counts only in a scene without
   other lights. Measured. */
typedef struct elsewhere_xeokit_numbers {
    shade_vec3 diffuse, specular, emissive;
    float shininess;
} elsewhere_xeokit_numbers;
static inline elsewhere_look elsewhere_xeokit(elsewhere_xeokit_numbers v)
{
    elsewhere_look k = elsewhere_plain(SHADE_MODEL_PHONG);
    k.material.emission = v.emissive;
    k.material.ambient = k.material.diffuse = v.diffuse;
    k.material.specular = v.specular;
    k.material.shininess = v.shininess;
    k.flags = SHADE_FLAG_UNGATED_SPECULAR;
    return k;
}

/* vtk.js 37.4: vtkProperty, as VTK's, with other lamps.  Measured. */
typedef elsewhere_vtk_numbers elsewhere_vtkjs_numbers;
static inline elsewhere_look elsewhere_vtkjs(elsewhere_vtkjs_numbers v) { return elsewhere_vtk(v); }

/* Tachyon 0.99: TEXTURE with PHONG PLASTIC phong PHONG_SIZE phong_size.  (N.H)^n, or (R.V)^n with
   -shade_phong (shade_phong here); the other -shade_ flags have laws of their own.  Lamps do not
   multiply the ambient term, bytes are cut.  Measured. */
typedef struct elsewhere_tachyon_numbers {
    shade_vec3 color;
    float ambient, diffuse, phong, phong_size, shade_phong;
} elsewhere_tachyon_numbers;
static inline elsewhere_look elsewhere_tachyon(elsewhere_tachyon_numbers v)
{
    elsewhere_look k =
        elsewhere_plain(v.shade_phong > 0 ? SHADE_MODEL_PHONG : SHADE_MODEL_BLINN_PHONG);
    k.material.ambient = shade_scale(v.color, v.ambient);
    k.material.diffuse = shade_scale(v.color, v.diffuse);
    k.material.specular = elsewhere_grey(v.phong);
    k.material.shininess = v.phong_size;
    k.cut = 1;
    return k;
}

/* Raster3D 3.0-7: header lines phong, straight, ambient, specular, and an object's colour.  k_d is
   colour (1 - ambient - specular), k_a ambient colour; the highlight is white, of strength specular
   (.2 + .8 sqrt(Y)) where Y = .3 R + .59 G + .11 B of the colour; (R.V)^phong.  The lamp weighs
   1 - straight, a lamp at the camera straight.  Bytes are 255 sqrt(light).  Measured. */
typedef struct elsewhere_raster3d_numbers {
    shade_vec3 color;
    float phong, straight, ambient, specular;
} elsewhere_raster3d_numbers;
static inline elsewhere_look elsewhere_raster3d(elsewhere_raster3d_numbers v)
{
    const float luminance = 0.3f * v.color.x + 0.59f * v.color.y + 0.11f * v.color.z;
    elsewhere_look k = elsewhere_plain(SHADE_MODEL_PHONG);
    k.material.ambient = shade_scale(v.color, v.ambient);
    k.material.diffuse = shade_scale(v.color, 1 - v.ambient - v.specular);
    k.material.specular = elsewhere_grey(v.specular * (0.2f + 0.8f * sqrtf(luminance)));
    k.material.shininess = v.phong;
    k.viewer = ELSEWHERE_VIEWER_AXIS;
    k.encoding = ELSEWHERE_ENCODING_ROOT;
    k.diffuse = k.specular = 1 - v.straight;
    k.head_diffuse = k.head_specular = v.straight;
    return k;
}

/* PyMOL 2.5.0, ray, with light_count 2 and spec_count 1: a lamp at the camera of strength direct
   without a highlight, and the lamp of strength reflect 2 / (1 + z), z of the unit direction toward
   it; a white highlight of that lamp alone, specular_intensity (N.H)^shininess.  Ambient light and
   both lamps together are at most 1 before they meet the colour.  Bytes are cut.
   Measured. */
typedef struct elsewhere_pymol_numbers {
    shade_vec3 color;
    float ambient, direct, reflect, specular_intensity, shininess;
} elsewhere_pymol_numbers;
static inline elsewhere_look elsewhere_pymol(elsewhere_pymol_numbers v)
{
    elsewhere_look k = elsewhere_plain(SHADE_MODEL_BLINN_PHONG);
    k.material.ambient = shade_scale(v.color, v.ambient);
    k.material.diffuse = v.color;
    k.material.specular = elsewhere_grey(v.specular_intensity);
    k.material.shininess = v.shininess;
    k.viewer = ELSEWHERE_VIEWER_AXIS;
    k.cut = 1;
    k.diffuse = v.reflect;
    k.tilted = 1;
    k.head_diffuse = v.direct;
    k.most = v.color;
    return k;
}

/* gnuplot 5.4.4: set pm3d lighting primary p specular s, of a fill colour. colour (1 - p + p
   N.L) and a white s (R.V)^5, from a lamp of its own at the upper left of the screen. primary 0
   switches the highlight off too. Measured. */
typedef struct elsewhere_gnuplot_numbers {
    shade_vec3 color;
    float primary, specular;
} elsewhere_gnuplot_numbers;
static inline elsewhere_look elsewhere_gnuplot(elsewhere_gnuplot_numbers v)
{
    elsewhere_look k = elsewhere_plain(SHADE_MODEL_PHONG);
    k.material.ambient = shade_scale(v.color, 1 - v.primary);
    k.material.diffuse = shade_scale(v.color, v.primary);
    k.material.specular = elsewhere_grey(v.primary > 0 ? v.specular : 0);
    k.material.shininess = 5;
    k.viewer = ELSEWHERE_VIEWER_AXIS;
    k.own = shade_v3(-0.226f, 0.709f, 0.668f);
    k.own_turns = 1;
    return k;
}

/* matplotlib 3.6.3: mplot3d's shade, from a LightSource of azdeg and altdeg in degrees.  colour
   (.65 + .35 N.L), also where N.L < 0; no highlight.  Measured. */
typedef struct elsewhere_mplot3d_numbers {
    shade_vec3 color;
    float azdeg, altdeg;
} elsewhere_mplot3d_numbers;
static inline elsewhere_look elsewhere_mplot3d(elsewhere_mplot3d_numbers v)
{
    const float azimuth = shade_radians(90 - v.azdeg), altitude = shade_radians(v.altdeg);
    elsewhere_look k = elsewhere_plain(SHADE_MODEL_LAMBERT);
    k.material.ambient = shade_scale(v.color, 0.65f);
    k.material.diffuse = shade_scale(v.color, 0.35f);
    k.law = ELSEWHERE_LAW_SIGNED;
    k.own =
        shade_v3(cosf(azimuth) * cosf(altitude), sinf(azimuth) * cosf(altitude), sinf(altitude));
    return k;
}

/* GDAL 3.6.2: gdaldem hillshade, azimuth clockwise from north and altitude in degrees, of a height
   field whose east is x, north y and up z.  Bytes are 1 + 254 N.L, 1 where N.L < 0.  Measured. */
typedef struct elsewhere_gdal_numbers {
    float azimuth, altitude;
} elsewhere_gdal_numbers;
static inline elsewhere_look elsewhere_gdal(elsewhere_gdal_numbers v)
{
    const float azimuth = shade_radians(v.azimuth), altitude = shade_radians(v.altitude);
    elsewhere_look k = elsewhere_plain(SHADE_MODEL_LAMBERT);
    k.material.emission = elsewhere_grey(1 / 255.0f);
    k.material.diffuse = elsewhere_grey(254 / 255.0f);
    k.own =
        shade_v3(sinf(azimuth) * cosf(altitude), cosf(azimuth) * cosf(altitude), sinf(altitude));
    return k;
}

/* Octave 7.3: surfl with [ambient diffuse specular shine]. The sum over all is divided by
   ambient + diffuse + specular, so that a highlight dims the rest. Measured. */
typedef struct elsewhere_surfl_numbers {
    float ambient, diffuse, specular, shine;
} elsewhere_surfl_numbers;
static inline elsewhere_look elsewhere_surfl(elsewhere_surfl_numbers v)
{
    const float sum = fmaxf(v.ambient + v.diffuse + v.specular, 1e-6f);
    elsewhere_look k = elsewhere_plain(SHADE_MODEL_PHONG);
    k.material.ambient = elsewhere_grey(v.ambient / sum);
    k.material.diffuse = elsewhere_grey(v.diffuse / sum);
    k.material.specular = elsewhere_grey(v.specular / sum);
    k.material.shininess = v.shine;
    k.viewer = ELSEWHERE_VIEWER_AXIS;
    return k;
}

/* OpenGL 1.0 to 2.1, fixed function: glMaterial and glLightModel. (N.H)^n, lit at vertices;
   without GL_LIGHT_MODEL_LOCAL_VIEWER V is the camera's axis everywhere. Each lamp's own ambient
   light is dimmed with it. scene.ambient is GL_LIGHT_MODEL_AMBIENT, .2 by default. Specified in
   OpenGL 2.1, section 2.14.1, and measured. */
typedef struct elsewhere_opengl_numbers {
    shade_vec3 ambient, diffuse, specular, emission;
    float shininess, local_viewer;
} elsewhere_opengl_numbers;
static inline elsewhere_look elsewhere_opengl(elsewhere_opengl_numbers v)
{
    elsewhere_look k = elsewhere_plain(SHADE_MODEL_BLINN_PHONG);
    k.material.emission = v.emission;
    k.material.ambient = v.ambient;
    k.material.diffuse = v.diffuse;
    k.material.specular = v.specular;
    k.material.shininess = v.shininess;
    k.flags = SHADE_FLAG_ATTENUATED_AMBIENT;
    k.viewer = v.local_viewer > 0 ? ELSEWHERE_VIEWER_POINT : ELSEWHERE_VIEWER_AXIS;
    return k;
}

/* Open Inventor as Coin 4.0.0 draws it: SoMaterial, (N.H)^(128 shininess) by OpenGL's fixed
   function, at vertices.  scene.ambient is SoEnvironment's, .2 by default.  Measured; SoMaterial of
   its reference. */
typedef struct elsewhere_inventor_numbers {
    shade_vec3 ambientColor, diffuseColor, specularColor, emissiveColor;
    float shininess;
} elsewhere_inventor_numbers;
static inline elsewhere_look elsewhere_inventor(elsewhere_inventor_numbers v)
{
    elsewhere_look k = elsewhere_plain(SHADE_MODEL_BLINN_PHONG);
    k.material.emission = v.emissiveColor;
    k.material.ambient = v.ambientColor;
    k.material.diffuse = v.diffuseColor;
    k.material.specular = v.specularColor;
    k.material.shininess = 128 * v.shininess;
    k.viewer = ELSEWHERE_VIEWER_AXIS;
    return k;
}

/* Wavefront's MTL: Ka, Kd, Ks, Ke, Ns, illum; (N.H)^Ns.  illum 0 is Kd alone, without light, 1 has
   no highlight.  By its specification ("Object Files", Alias Wavefront, version 4.2): no program is
   the reference.  elsewhere_three_mtl is one reader.  Blender 3.4 reads it as roughness
   1 - sqrt(Ns/1000), whose surface is no Phong; Assimp 5.2 hands Ns over as it is. */
typedef struct elsewhere_mtl_numbers {
    shade_vec3 Ka, Kd, Ks, Ke;
    float Ns, illum;
} elsewhere_mtl_numbers;
static inline elsewhere_look elsewhere_mtl(elsewhere_mtl_numbers v)
{
    const shade_vec3 none = { 0, 0, 0 };
    elsewhere_look k = elsewhere_plain(SHADE_MODEL_BLINN_PHONG);
    k.material.emission = v.illum < 1 ? v.Kd : v.Ke;
    k.material.ambient = v.illum < 1 ? none : v.Ka;
    k.material.diffuse = v.illum < 1 ? none : v.Kd;
    k.material.specular = v.illum < 2 ? none : v.Ks;
    k.material.shininess = v.Ns;
    return k;
}

/* Irrlicht 1.8.5, Burning's Video: directional lamps alone, N.L exact, no highlight whatever
   SpecularColor and Shininess; its point lamps follow a law that was not found.  Measured. */
typedef struct elsewhere_irrlicht_numbers {
    shade_vec3 DiffuseColor, EmissiveColor;
} elsewhere_irrlicht_numbers;
static inline elsewhere_look elsewhere_irrlicht(elsewhere_irrlicht_numbers v)
{
    elsewhere_look k = elsewhere_plain(SHADE_MODEL_LAMBERT);
    k.material.emission = v.EmissiveColor;
    k.material.diffuse = v.DiffuseColor;
    return k;
}

/* MathGL 8.0.1: color times ambient light (.5) and exp(-3 (1 - R.V)) of white; no N.L at all. A
   lamp of brightness b, .5 by default, is one of colour 2 b here.  Measured. */
typedef struct elsewhere_mathgl_numbers {
    shade_vec3 color;
    float ambient;
} elsewhere_mathgl_numbers;
static inline elsewhere_look elsewhere_mathgl(elsewhere_mathgl_numbers v)
{
    elsewhere_look k = elsewhere_plain(SHADE_MODEL_PHONG);
    k.material.ambient = shade_scale(v.color, v.ambient);
    k.material.specular = elsewhere_grey(1);
    k.cut = 1;
    k.law = ELSEWHERE_LAW_EXPONENT;
    k.number = 3;
    return k;
}

/* OpenSceneGraph 3.6.5: osg::Material, by OpenGL's fixed function without a local viewer.
   scene.ambient is that of the light model, .1 by default.  Measured. */
typedef struct elsewhere_osg_numbers {
    shade_vec3 ambient, diffuse, specular, emission;
    float shininess;
} elsewhere_osg_numbers;
static inline elsewhere_look elsewhere_osg(elsewhere_osg_numbers v)
{
    elsewhere_inventor_numbers same;
    same.ambientColor = v.ambient;
    same.diffuseColor = v.diffuse;
    same.specularColor = v.specular;
    same.emissiveColor = v.emission;
    same.shininess = v.shininess / 128;
    return elsewhere_inventor(same);
}

/* deck.gl 9.4.0: the material of a SimpleMeshLayer, colours of 0 to 1 in place of 0 to 255.
   (N.H)^shininess where N.L > 0, V to the camera's point even under parallel projection.
   scene.ambient is that of the AmbientLight.  Measured; phongMaterial of luma.gl's shaders. */
typedef struct elsewhere_deck_numbers {
    shade_vec3 color, specularColor;
    float ambient, diffuse, shininess;
} elsewhere_deck_numbers;
static inline elsewhere_look elsewhere_deck(elsewhere_deck_numbers v)
{
    elsewhere_look k = elsewhere_plain(SHADE_MODEL_BLINN_PHONG);
    k.material.ambient = shade_scale(v.color, v.ambient);
    k.material.diffuse = shade_scale(v.color, v.diffuse);
    k.material.specular = v.specularColor;
    k.material.shininess = v.shininess;
    k.viewer = ELSEWHERE_VIEWER_POINT;
    return k;
}

/* Processing.js 1.6.6: fill, ambient, specular, emissive, shininess, colours of 0 to 1. (N.H)^n at
   vertices, V to the camera's point even under parallel projection; ambient light counts times
   fill and times ambient.  Measured; vertexShaderSrc3D of its source. */
typedef struct elsewhere_processing_numbers {
    shade_vec3 fill, ambient, specular, emissive;
    float shininess;
} elsewhere_processing_numbers;
static inline elsewhere_look elsewhere_processing(elsewhere_processing_numbers v)
{
    elsewhere_look k = elsewhere_plain(SHADE_MODEL_BLINN_PHONG);
    k.material.emission = v.emissive;
    k.material.ambient = shade_mul(v.fill, v.ambient);
    k.material.diffuse = v.fill;
    k.material.specular = v.specular;
    k.material.shininess = v.shininess;
    k.viewer = ELSEWHERE_VIEWER_POINT;
    return k;
}

/* PlayCanvas 2.23.3: StandardMaterial without metalness, colours as a file has them.  By default it
   is no GGX but (n + 2)/8 (N.H)^n N.L of n = 2^(11 gloss), V to the camera's point even under
   parallel projection; enableGGXSpecular is not said here. N.L is not divided by pi; ambient light
   counts times diffuse (1 - specular).  Bytes are light^(1/2.2).  Measured; lightSpecularBlinn of
   its shaders. */
typedef struct elsewhere_playcanvas_numbers {
    shade_vec3 diffuse, specular, emissive;
    float gloss;
} elsewhere_playcanvas_numbers;
static inline elsewhere_look elsewhere_playcanvas(elsewhere_playcanvas_numbers v)
{
    const shade_vec3 *file[] = { &v.diffuse, &v.specular, &v.emissive };
    shade_vec3 light[3];
    elsewhere_look k = elsewhere_plain(SHADE_MODEL_BLINN_PHONG);
    for (int i = 0; i < 3; i++)
        light[i] = shade_v3(powf(file[i]->x, 2.2f), powf(file[i]->y, 2.2f), powf(file[i]->z, 2.2f));
    k.material.diffuse = light[0];
    k.material.specular = light[1];
    k.material.ambient = shade_mul(light[0], shade_sub(shade_v3(1, 1, 1), light[1]));
    k.material.emission = light[2];
    k.material.shininess = powf(2, 11 * v.gloss);
    k.flags = SHADE_FLAG_WEIGHTED_SPECULAR;
    k.specular = (k.material.shininess + 2) / 8;
    k.viewer = ELSEWHERE_VIEWER_POINT;
    k.encoding = ELSEWHERE_ENCODING_GAMMA;
    return k;
}

/* RasMol 2.7.6: set ambient a, set specular, set specpower n, of 0 to 100, of a colour. color (a +
   (1 - a) N.L), mixed toward white by (N.L)^(n + 1): a highlight that does not depend on where it
   is seen from.  In 32 steps of N.L, from a lamp of its own along 1, 1, 2 of the screen. Parallel
   projection alone.  Measured. */
typedef struct elsewhere_rasmol_numbers {
    shade_vec3 color;
    float ambient, specular, specpower;
} elsewhere_rasmol_numbers;
static inline elsewhere_look elsewhere_rasmol(elsewhere_rasmol_numbers v)
{
    elsewhere_look k = elsewhere_plain(SHADE_MODEL_LAMBERT);
    k.material.ambient = shade_scale(v.color, v.ambient / 100);
    k.material.diffuse = shade_scale(v.color, 1 - v.ambient / 100);
    k.material.specular = elsewhere_grey(1);
    k.own = shade_v3(1, 1, 2);
    k.own_turns = 1;
    k.law = v.specular > 0 ? ELSEWHERE_LAW_BLEND : ELSEWHERE_LAW_FOUR;
    k.number = v.specpower + 1;
    return k;
}

/* Jmol 14.32.83: set ambientPercent, diffusePercent, specularPercent, phongExponent.  A ramp of 64
   shades by diffusePercent N.L + specularPercent (R.V)^n: from color times ambientPercent to color
   at 52, above that toward white, so that a red ball turns pink without any highlight. The lamp is
   its own.  Balls are dithered.  Measured. */
typedef struct elsewhere_jmol_numbers {
    shade_vec3 color;
    float ambientPercent, diffusePercent, specularPercent, phongExponent;
} elsewhere_jmol_numbers;
static inline elsewhere_look elsewhere_jmol(elsewhere_jmol_numbers v)
{
    elsewhere_look k = elsewhere_plain(SHADE_MODEL_PHONG);
    k.material.ambient = shade_scale(v.color, v.ambientPercent / 100);
    k.material.diffuse = v.color;
    k.material.specular = elsewhere_grey(1);
    k.material.shininess = v.phongExponent;
    k.viewer = ELSEWHERE_VIEWER_AXIS;
    k.own = shade_v3(-1, 1, 2.5f);
    k.own_turns = 1;
    k.diffuse = v.diffusePercent / 100;
    k.specular = v.specularPercent / 100;
    k.law = ELSEWHERE_LAW_RAMP;
    return k;
}

/* seen.js 0.2.7: seen.Material with the Phong shader, colours of 0 to 1 in place of 0 to 255; a
   lamp of intensity i, .01 by default, is a lamp of colour i here.  Where N.L > 0 it gives
   color (255 i N.L + specularColor i (.5 + R.V)^specularExponent).  The base is up to 1.5, which
   makes 438 of the default exponent 15; the highlight has the surface's colour.  V is the axis.
   Measured; shaders of its source. */
typedef struct elsewhere_seen_numbers {
    shade_vec3 color, specularColor;
    float specularExponent;
} elsewhere_seen_numbers;
static inline elsewhere_look elsewhere_seen(elsewhere_seen_numbers v)
{
    elsewhere_look k = elsewhere_plain(SHADE_MODEL_PHONG);
    k.material.ambient = shade_scale(v.color, 255);
    k.material.diffuse = v.color;
    k.material.specular = shade_mul(v.color, v.specularColor);
    k.material.shininess = v.specularExponent;
    k.viewer = ELSEWHERE_VIEWER_AXIS;
    k.diffuse = 255;
    k.law = ELSEWHERE_LAW_SHIFTED;
    k.number = 0.5f;
    return k;
}

/*------------------------------------------------------------------------------------------- lamps
   at is a position with w = 1, or with w = 0 the direction toward a lamp at infinity.  aim is where
   a lamp points; zero: no spot.  Angles are degrees, as all of these programs have them, unless
   told. */

/* Where a lamp is, what it sends, where it points to */
static inline elsewhere_lamp elsewhere_sends(shade_vec4 at, shade_vec3 color, shade_vec3 aim)
{
    shade_light light;
    memset(&light, 0, sizeof light);
    light.position = at;
    light.diffuse = light.specular = color;
    light.spot_direction = aim;
    light.spot_cos_cutoff = -1;
    return elsewhere_lamp_of(light);
}
static inline void elsewhere_attenuate(elsewhere_lamp *lamp, shade_vec3 abc)
{
    lamp->light.constant = abc.x;
    lamp->light.linear = abc.y;
    lamp->light.quadratic = abc.z;
}

/* A lamp in shade.h's own words, as OpenGL's fixed function has it: cutoff is half the cone. */
typedef struct elsewhere_opengl_lamp_numbers {
    shade_vec4 at;
    shade_vec3 color, ambient, attenuation, aim;
    float cutoff, exponent;
} elsewhere_opengl_lamp_numbers;
static inline elsewhere_lamp elsewhere_opengl_lamp(elsewhere_opengl_lamp_numbers v)
{
    elsewhere_lamp lamp = elsewhere_sends(v.at, v.color, v.aim);
    elsewhere_attenuate(&lamp, v.attenuation);
    lamp.light.ambient = v.ambient;
    lamp.light.spot_cos_cutoff = cosf(shade_radians(v.cutoff));
    lamp.light.spot_exponent = v.exponent;
    return lamp;
}

/* VTK 9.1.0: vtkLight.  A positional lamp is by default a spot of 30 degrees off its axis with
   cos^exponent; from a cone of 90 on it shines everywhere, whatever the exponent.  Measured. */
typedef struct elsewhere_vtk_lamp_numbers {
    shade_vec4 at;
    shade_vec3 color, aim;
    float cone, exponent;
    shade_vec3 attenuation;
} elsewhere_vtk_lamp_numbers;
static inline elsewhere_lamp elsewhere_vtk_lamp(elsewhere_vtk_lamp_numbers v)
{
    const int even = v.at.w == 0 || v.cone >= 90;
    elsewhere_lamp lamp = elsewhere_sends(v.at, v.color, even ? shade_v3(0, 0, 0) : v.aim);
    elsewhere_attenuate(&lamp, v.attenuation);
    lamp.light.spot_cos_cutoff = cosf(shade_radians(v.cone));
    lamp.light.spot_exponent = v.exponent;
    return lamp;
}

/* POV-Ray 3.7.0: light_source.  The amount is 2 / (1 + (r/d)^p) where both fade_distance d and
   fade_power p are given, else 1.  A spotlight falls by smoothstep of the cosine from radius to
   falloff and has cos^tightness.  shadowless lamps make no highlight.  Measured. */
typedef struct elsewhere_povray_lamp_numbers {
    shade_vec4 at;
    shade_vec3 color, aim;
    float fade_distance, fade_power, radius, falloff, tightness, shadowless;
} elsewhere_povray_lamp_numbers;
static inline elsewhere_lamp elsewhere_povray_lamp(elsewhere_povray_lamp_numbers v)
{
    elsewhere_lamp lamp = elsewhere_sends(v.at, v.color, v.aim);
    if (v.fade_distance > 0 && v.fade_power > 0) {
        lamp.range = ELSEWHERE_RANGE_FADE;
        lamp.reach = v.fade_distance;
        lamp.power = v.fade_power;
    }
    lamp.rim = ELSEWHERE_RIM_COSINE;
    lamp.inner = shade_radians(v.radius);
    lamp.outer = shade_radians(v.falloff);
    if (shade_dot(v.aim, v.aim) == 0) lamp.rim = ELSEWHERE_RIM_HARD;
    lamp.light.spot_cos_cutoff = cosf(lamp.outer);
    lamp.light.spot_exponent = v.tightness;
    if (v.shadowless > 0) lamp.light.specular = shade_v3(0, 0, 0);
    return lamp;
}

/* three.js 0.187.0: DirectionalLight, PointLight, SpotLight.  1 / max(r^decay, .01), times
   (1 - (r / distance)^4)^2 where distance is not 0.  A spot falls by smoothstep of the cosine from
   angle (1 - penumbra) to angle, which is half the cone, in radians.  Measured; 1/pi is in the
   look. */
typedef struct elsewhere_three_lamp_numbers {
    shade_vec4 at;
    shade_vec3 color, aim;
    float intensity, distance, decay, angle, penumbra;
} elsewhere_three_lamp_numbers;
static inline elsewhere_lamp elsewhere_three_lamp(elsewhere_three_lamp_numbers v)
{
    elsewhere_lamp lamp = elsewhere_sends(v.at, shade_scale(v.color, v.intensity), v.aim);
    lamp.range = ELSEWHERE_RANGE_WINDOW;
    lamp.reach = v.distance;
    lamp.power = v.decay;
    if (shade_dot(v.aim, v.aim) > 0) lamp.rim = ELSEWHERE_RIM_COSINE;
    lamp.inner = v.angle * (1 - v.penumbra);
    lamp.outer = v.angle;
    lamp.light.spot_cos_cutoff = cosf(v.angle);
    return lamp;
}

/* Babylon.js 9.35.0: DirectionalLight, PointLight, SpotLight. A lamp with a range falls linearly
   to 0 there. angle is that of the full cone, in radians; the cone is hard, with cos^exponent.
   Measured. */
typedef struct elsewhere_babylon_lamp_numbers {
    shade_vec4 at;
    shade_vec3 color, aim;
    float range, angle, exponent;
} elsewhere_babylon_lamp_numbers;
static inline elsewhere_lamp elsewhere_babylon_lamp(elsewhere_babylon_lamp_numbers v)
{
    elsewhere_lamp lamp = elsewhere_sends(v.at, v.color, v.aim);
    if (v.range > 0) lamp.range = ELSEWHERE_RANGE_LINEAR;
    lamp.reach = v.range;
    lamp.light.spot_cos_cutoff = cosf(v.angle / 2);
    lamp.light.spot_exponent = v.exponent;
    return lamp;
}

/* X3D as X_ITE draws it: 1 / max(a + b r + c r^2, 1), nothing beyond radius.  A spot falls linearly
   in the angle from beamWidth to cutOffAngle, in radians; a beamWidth beyond cutOffAngle is full
   light in the cone.  Measured; X3D 4.0, clause 17.4.3. */
typedef struct elsewhere_x3d_lamp_numbers {
    shade_vec4 at;
    shade_vec3 color, attenuation, aim;
    float intensity, radius, beamWidth, cutOffAngle;
} elsewhere_x3d_lamp_numbers;
static inline elsewhere_lamp elsewhere_x3d_lamp(elsewhere_x3d_lamp_numbers v)
{
    elsewhere_lamp lamp = elsewhere_sends(v.at, shade_scale(v.color, v.intensity), v.aim);
    elsewhere_attenuate(&lamp, v.attenuation);
    lamp.at_most_one = 1;
    lamp.range = ELSEWHERE_RANGE_CUT;
    lamp.reach = v.radius;
    if (shade_dot(v.aim, v.aim) > 0 && v.beamWidth < v.cutOffAngle) lamp.rim = ELSEWHERE_RIM_ANGLE;
    lamp.inner = v.beamWidth;
    lamp.outer = v.cutOffAngle;
    lamp.light.spot_cos_cutoff = cosf(v.cutOffAngle);
    return lamp;
}

/* Open Inventor, Coin 4.0.0: SoDirectionalLight, SoPointLight, SoSpotLight; attenuation is
   SoEnvironment's, from its last number to its first.  A spot has cos^(128 dropOffRate) within
   cutOffAngle, in radians.  Measured. */
typedef struct elsewhere_inventor_lamp_numbers {
    shade_vec4 at;
    shade_vec3 color, attenuation, aim;
    float cutOffAngle, dropOffRate;
} elsewhere_inventor_lamp_numbers;
static inline elsewhere_lamp elsewhere_inventor_lamp(elsewhere_inventor_lamp_numbers v)
{
    elsewhere_lamp lamp = elsewhere_sends(v.at, v.color, v.aim);
    elsewhere_attenuate(&lamp, v.attenuation);
    lamp.light.spot_cos_cutoff = cosf(v.cutOffAngle);
    lamp.light.spot_exponent = 128 * v.dropOffRate;
    return lamp;
}

/* p5.js 1.11: directionalLight, pointLight, spotLight, lightFalloff.  The highlight of a point lamp
   has the square of 1 / (a + b r + c r^2), that of a spot does not.  angle is from the axis to the
   edge, in radians, with cos^concentration.  Measured; totalLight of lighting.glsl. */
typedef struct elsewhere_p5_lamp_numbers {
    shade_vec4 at;
    shade_vec3 color, attenuation, aim;
    float angle, concentration;
} elsewhere_p5_lamp_numbers;
static inline elsewhere_lamp elsewhere_p5_lamp(elsewhere_p5_lamp_numbers v)
{
    elsewhere_lamp lamp = elsewhere_sends(v.at, v.color, v.aim);
    elsewhere_attenuate(&lamp, v.attenuation);
    lamp.light.spot_cos_cutoff = cosf(v.angle);
    lamp.light.spot_exponent = v.concentration;
    if (v.at.w != 0 && shade_dot(v.aim, v.aim) == 0) lamp.highlight = ELSEWHERE_HIGHLIGHT_SQUARED;
    return lamp;
}

/* Processing.js 1.6.6: directionalLight, pointLight, spotLight, lightFalloff.  The H of a
   directionalLight is that of the vector as it was given: a longer one moves the highlight toward
   where N.L is 1.  color is the light's; that of highlights is lightSpecular, white here.
   angle is from the axis to the edge, in radians, with cos^concentration.  Measured. */
typedef elsewhere_p5_lamp_numbers elsewhere_processing_lamp_numbers;
static inline elsewhere_lamp elsewhere_processing_lamp(elsewhere_processing_lamp_numbers v)
{
    elsewhere_lamp lamp = elsewhere_p5_lamp(v);
    lamp.highlight = ELSEWHERE_HIGHLIGHT_PLAIN;
    lamp.light.specular = shade_v3(1, 1, 1);
    if (v.at.w != 0) return lamp;
    lamp.highlight = ELSEWHERE_HIGHLIGHT_LONG;
    lamp.reach = shade_length(shade_v3(v.at.x, v.at.y, v.at.z));
    return lamp;
}

/* vtk.js 37.4: vtkLight.  As VTK's, but that a cone of 90 is still one, and that the highlight of a
   positional lamp stands where light along its aim would put it.  Measured; lights of
   OpenGL/PolyDataMapper. */
typedef elsewhere_vtk_lamp_numbers elsewhere_vtkjs_lamp_numbers;
static inline elsewhere_lamp elsewhere_vtkjs_lamp(elsewhere_vtkjs_lamp_numbers v)
{
    elsewhere_lamp lamp = elsewhere_vtk_lamp(v);
    if (v.at.w == 0) return lamp;
    lamp.highlight = ELSEWHERE_HIGHLIGHT_AIM;
    lamp.light.spot_direction = v.aim;
    if (v.cone > 90) {
        lamp.light.spot_cos_cutoff = -1;
        lamp.light.spot_exponent = 0;
    }
    return lamp;
}

/* Tachyon 0.99: DIRECTIONAL_LIGHT, LIGHT, SPOTLIGHT. A spot falls linearly in the angle from
   Falloff_Start to Falloff_End, which are measured from the axis. Neither distance nor the rim
   dims highlights: they are whole wherever any light arrives. Measured. */
typedef struct elsewhere_tachyon_lamp_numbers {
    shade_vec4 at;
    shade_vec3 color, attenuation, aim;
    float start, end;
} elsewhere_tachyon_lamp_numbers;
static inline elsewhere_lamp elsewhere_tachyon_lamp(elsewhere_tachyon_lamp_numbers v)
{
    elsewhere_lamp lamp = elsewhere_sends(v.at, v.color, v.aim);
    elsewhere_attenuate(&lamp, v.attenuation);
    if (shade_dot(v.aim, v.aim) > 0) lamp.rim = ELSEWHERE_RIM_ANGLE;
    lamp.highlight = ELSEWHERE_HIGHLIGHT_WHOLE;
    lamp.inner = shade_radians(v.start);
    lamp.outer = shade_radians(v.end);
    lamp.light.spot_cos_cutoff = cosf(lamp.outer);
    return lamp;
}
#endif
