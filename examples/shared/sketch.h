/* sketch.h - drawings in a plane, as on a blackboard: lines, arrows, arcs and names, in units of
   their own with y upward. */
#ifndef SHARED_SKETCH_H
#define SHARED_SKETCH_H

#include "label.h"
#include "mesh.h"

typedef struct sketch {
    const canvas *c;
    int x, y, unit;                  /* pixels of the finished picture: the origin, a length of 1 */
    shade_line_state pen;
} sketch;

static inline sketch sketch_new(const canvas *c, int x, int y, int unit)
{
    float u = (float)unit;
    sketch s = { c, x, y, unit, { .cap = SHADE_CAP_SQUARE } };
    s.pen.clip_from_points =
        shade_mat4_ortho((float)-x / u, (float)(c->width - x) / u, (float)(y - c->height) / u,
                         (float)y / u, -1, 1);
    s.pen.raster.depth_test = SHADE_COMPARE_ALWAYS;
    return s;
}

/* Clears the picture to the paper that drawings have behind them. */
static inline void sketch_paper(const canvas *c)
{
    canvas_gradient(&c->target, shade_v3(0.92f, 0.92f, 0.9f), shade_v3(0.85f, 0.85f, 0.82f));
}

/* width: pixels of the finished picture */
static inline void sketch_ink(sketch *s, shade_vec3 color, float width)
{
    s->pen.color = shade_v4(color.x, color.y, color.z, 1);
    s->pen.width = width * (float)s->c->samples;
}

/* The unit vector so many degrees clockwise from up */
static inline shade_vec3 sketch_direction(float degrees)
{
    shade_vec2 t = mesh_turn(degrees / 360);
    return shade_v3(t.y, t.x, 0);
}

static inline void sketch_line(const sketch *s, shade_vec3 a, shade_vec3 b)
{
    const shade_vec3 ends[2] = { a, b };
    shade_draw_lines(&s->c->target, ends, 2, &s->pen, NULL);
}

/* A dot in the ink of the sketch, so many pixels wide */
static inline void sketch_dot(const sketch *s, shade_vec3 at, float width)
{
    sketch dot = *s;
    dot.pen.width = width * (float)s->c->samples;
    sketch_line(&dot, at, at);
}

static inline void sketch_dashes(const sketch *s, shade_vec3 a, shade_vec3 b)
{
    float dash = 7 / ((float)s->unit * shade_distance(a, b));
    sketch thin = *s;
    thin.pen.cap = SHADE_CAP_BUTT;
    for (float t = 0; t < 1; t += 2 * dash)
        sketch_line(&thin, shade_lerp(a, b, t), shade_lerp(a, b, t + dash < 1 ? t + dash : 1));
}

static inline void sketch_arrow(const sketch *s, shade_vec3 from, shade_vec3 to)
{
    shade_vec3 d = shade_scale(shade_normalize(shade_sub(to, from)), 11 / (float)s->unit);
    shade_vec3 side = shade_v3(-0.45f * d.y, 0.45f * d.x, 0), neck = shade_sub(to, d);
    sketch_line(s, from, to);
    sketch_line(s, to, shade_add(neck, side));
    sketch_line(s, to, shade_sub(neck, side));
}

/* Part of a circle, from an angle to another; degrees clockwise from up */
static inline void sketch_arc(const sketch *s, shade_vec3 center, float radius, float from,
                              float to)
{
    enum { STEPS = 48 };
    for (int i = 0; i < STEPS; i++) {
        float a = from + (to - from) * (float)i / STEPS, b = a + (to - from) / STEPS;
        sketch_line(s, shade_madd(center, radius, sketch_direction(a)),
                    shade_madd(center, radius, sketch_direction(b)));
    }
}

/* Text with its middle at a point */
static inline void sketch_name(const sketch *s, shade_vec3 at, int size, const char *text)
{
    shade_vec4 k = s->pen.color;
    label_center(s->c, s->x + (int)(at.x * (float)s->unit),
                 s->y - (int)(at.y * (float)s->unit) + size / 3, size, shade_v3(k.x, k.y, k.z),
                 text);
}
#endif
