/* annotate.h - what stands about the views of a drawing: their names, dimension lines, the symbol
   of the angle of projection, the legend of parts, a line about the model.

   Lengths are in pixels of the finished sheet; a pen knows the samples along an edge of one. */
#ifndef THUMBNAIL_ANNOTATE_H
#define THUMBNAIL_ANNOTATE_H

#include "../../shared/label.h"
#include "strokes.h"

typedef struct pen {
    shade_target target; /* samples times the sheet, 8 bits a channel, without depth */
    int width, height, samples;
    float unit, text; /* 1 on a sheet of 1200 rows or columns; the em */
    shade_vec3 ink, grey;
    shade_result result; /* the first that was none */
} pen;

/* ---- lines and text ------------------------------------------------------------------------- */

/* Moves a line along an axis so that it fills whole pixels: neighbours look alike. */
static inline void pen_snap(float *from, float *to, float width)
{
    const float shift = (int)(width + 0.5f) % 2 ? 0.5f : 0;
    if (fabsf(*from - *to) > 0.01f) return;
    *from = *to = floorf(*from - shift + 0.5f) + shift;
}

/* Draws lines between pairs of points, in pixels; width as well, in whole ones from 1 on. */
static inline void pen_lines(pen *p, const float *points, size_t count, float width,
                             shade_vec3 color)
{
    shade_line_state state = { .cap = SHADE_CAP_SQUARE };
    float *snapped = (float *)malloc((3 * count + 1) * sizeof *snapped);
    shade_result result = SHADE_ERROR_CAPACITY;
    width = width < 1 ? 1 : floorf(width + 0.5f);
    state.width = width * (float)p->samples;
    state.clip_from_points = shade_mat4_ortho(0, (float)p->width, (float)p->height, 0, -1, 1);
    state.color = shade_v4(color.x, color.y, color.z, 1);
    if (snapped) {
        if (count) memcpy(snapped, points, 3 * count * sizeof *snapped);
        for (size_t i = 0; i + 1 < count; i += 2) {
            pen_snap(&snapped[3 * i], &snapped[3 * i + 3], width);
            pen_snap(&snapped[3 * i + 1], &snapped[3 * i + 4], width);
        }
        result = shade_draw_lines(&p->target, (const shade_vec3 *)(const void *)snapped, (int)count,
                                  &state, NULL);
    }
    free(snapped);
    if (!p->result) p->result = result;
}

static inline void pen_line(pen *p, float x0, float y0, float x1, float y1, float width,
                            shade_vec3 color)
{
    const float points[6] = { x0, y0, 0, x1, y1, 0 };
    pen_lines(p, points, 2, width, color);
}

/* Sets text as it stands.  label_set makes signs behind _ and ^ small, unless these end the text:
   it gets the pieces that they end. */
static inline float pen_set(pen *p, int draw, float x, float y, float size, shade_vec3 color,
                            const char *text)
{
    const float s = (float)p->samples;
    float width = 0;
    while (*text) {
        char cut[100];
        size_t n = strcspn(text, "_^");
        if (text[n]) n++;
        if (n >= sizeof cut) n = sizeof cut - 1;
        memcpy(cut, text, n);
        cut[n] = 0;
        width +=
            label_set(draw ? &p->target : NULL, s * (x + width), s * y, s * size, color, cut) / s;
        text += n;
    }
    return width;
}

static inline float pen_width(pen *p, float size, const char *text)
{
    return pen_set(p, 0, 0, 0, size, p->ink, text);
}

/* Sets text no wider than room; what does not fit ends in three points. */
static inline void pen_fit(pen *p, float x, float y, float size, float room, const char *text)
{
    char cut[200];
    size_t n = strlen(text);
    if (n > sizeof cut - 4) n = sizeof cut - 4;
    memcpy(cut, text, n);
    cut[n] = 0;
    while (n && pen_width(p, size, cut) > room) {
        do n--;
        while (n && ((unsigned char)cut[n] & 0xC0) == 0x80);
        memcpy(cut + n, "...", 4);
    }
    if (n) pen_set(p, 1, x, y, size, p->ink, cut);
}

/* Fills a triangle. */
static inline void pen_triangle(pen *p, const float *corners)
{
    shade_material ink = { 0 };
    shade_mesh mesh = { .positions = corners, .vertex_count = 3 };
    shade_draw_state state = { .material = &ink };
    shade_result result;
    ink.emission = p->ink;
    state.projection = shade_mat4_ortho(0, (float)p->width, (float)p->height, 0, -1, 1);
    result = shade_draw_mesh(&p->target, &mesh, &state, NULL);
    if (!p->result) p->result = result;
}

/* An arrow whose tip is x, y and that points along a unit vector */
static inline void pen_arrow(pen *p, float x, float y, float way_x, float way_y)
{
    const float l = 13 * p->unit, w = 2.6f * p->unit;
    const float corners[9] = { x,
                               y,
                               0,
                               x - l * way_x - w * way_y,
                               y - l * way_y + w * way_x,
                               0,
                               x - l * way_x + w * way_y,
                               y - l * way_y - w * way_x,
                               0 };
    pen_triangle(p, corners);
}

/* A circle as chords of a 48th turn */
static inline void pen_circle(pen *p, float x, float y, float radius, float width)
{
    float points[48 * 6];
    for (int i = 0; i < 96; i++) {
        shade_vec2 q = mesh_turn((float)((i + 1) / 2 % 48) / 48);
        points[3 * i] = x + radius * q.x;
        points[3 * i + 1] = y + radius * q.y;
        points[3 * i + 2] = 0;
    }
    pen_lines(p, points, 96, width, p->ink);
}

/* ---- dimensions ----------------------------------------------------------------------------- */

/* A length as a drawing says it: six digits, no zeros behind the point */
typedef struct length_text {
    char text[24];
} length_text;
static inline length_text length_of(double value)
{
    length_text t;
    snprintf(t.text, sizeof t.text, "%.6g", value);
    return t;
}

/* A dimension below a view, from x0 to x1, whose lower edge is y */
static inline void dimension_across(pen *p, float x0, float x1, float y, const char *text)
{
    const float u = p->unit, at = y + 1.9f * p->text, wide = pen_width(p, p->text, text);
    const float middle = (x0 + x1) / 2, half = wide / 2 + 5 * u;
    int inside = x1 - x0 > wide + 50 * u;
    pen_line(p, x0, y + 7 * u, x0, at + 6 * u, u, p->ink);
    pen_line(p, x1, y + 7 * u, x1, at + 6 * u, u, p->ink);
    pen_arrow(p, x0, at, inside ? -1.0f : 1.0f, 0);
    pen_arrow(p, x1, at, inside ? 1.0f : -1.0f, 0);
    if (inside) {
        pen_line(p, x0 + 8 * u, at, middle - half, at, u, p->ink);
        pen_line(p, middle + half, at, x1 - 8 * u, at, u, p->ink);
        pen_set(p, 1, middle - wide / 2, at + 0.36f * p->text, p->text, p->ink, text);
        return;
    }
    pen_line(p, x0 - 26 * u, at, x0 - 8 * u, at, u, p->ink);
    pen_line(p, x1 + 8 * u, at, x1 + 26 * u, at, u, p->ink);
    pen_set(p, 1, x1 + 32 * u, at + 0.36f * p->text, p->text, p->ink, text);
}

/* A dimension left of a view, from y0 down to y1, whose left edge is x */
static inline void dimension_down(pen *p, float y0, float y1, float x, const char *text)
{
    const float u = p->unit, wide = pen_width(p, p->text, text);
    const float at = x - 14 * u - fmaxf(1.2f * p->text, wide / 2), middle = (y0 + y1) / 2;
    const float half = 0.75f * p->text;
    int inside = y1 - y0 > 2 * half + 44 * u;
    pen_line(p, x - 7 * u, y0, at - 6 * u, y0, u, p->ink);
    pen_line(p, x - 7 * u, y1, at - 6 * u, y1, u, p->ink);
    pen_arrow(p, at, y0, 0, inside ? -1.0f : 1.0f);
    pen_arrow(p, at, y1, 0, inside ? 1.0f : -1.0f);
    if (inside) {
        pen_line(p, at, y0 + 8 * u, at, middle - half, u, p->ink);
        pen_line(p, at, middle + half, at, y1 - 8 * u, u, p->ink);
        pen_set(p, 1, at - wide / 2, middle + 0.36f * p->text, p->text, p->ink, text);
        return;
    }
    pen_line(p, at, y0 - 26 * u, at, y0 - 8 * u, u, p->ink);
    pen_line(p, at, y1 + 8 * u, at, y1 + 26 * u, u, p->ink);
    pen_set(p, 1, at - wide / 2, y0 - 32 * u, p->text, p->ink, text);
}

/* The first view of a sheet that a list names; NULL: none */
static inline const view *annotate_find(const views *s, const int *kinds, int count)
{
    for (int k = 0; k < count; k++)
        for (int i = 0; i < s->count; i++)
            if (s->list[i].kind == kinds[k]) return &s->list[i];
    return NULL;
}

/* Which views carry the width, the height, and the depth below or beside; NULL: none */
typedef struct dimensioned {
    const view *across[2], *down[2]; /* below: width, depth; left: height, depth */
} dimensioned;

static inline dimensioned annotate_dimensioned(const views *s)
{
    static const int wide[] = { VIEW_FRONT, VIEW_BACK, VIEW_TOP, VIEW_BOTTOM };
    static const int high[] = { VIEW_FRONT, VIEW_BACK, VIEW_RIGHT, VIEW_LEFT };
    static const int deep[] = { VIEW_RIGHT, VIEW_LEFT }, flat[] = { VIEW_TOP, VIEW_BOTTOM };
    dimensioned d;
    d.across[0] = annotate_find(s, wide, 4);
    d.across[1] = annotate_find(s, deep, 2);
    d.down[0] = annotate_find(s, high, 4);
    d.down[1] = d.across[1] ? NULL : annotate_find(s, flat, 2);
    return d;
}

/* size: width, height and depth of the model, in the units of its file */
static inline void annotate_dimensions(pen *p, const views *s, const double *size)
{
    dimensioned d = annotate_dimensioned(s);
    for (int k = 0; k < 2; k++) {
        const view *v = d.across[k];
        if (v)
            dimension_across(p, (float)(v->at_x + v->scale * (double)v->low[0]),
                             (float)(v->at_x + v->scale * (double)v->high[0]),
                             (float)(v->at_y - v->scale * (double)v->low[1]),
                             length_of(size[k ? 2 : 0]).text);
        v = d.down[k];
        if (v)
            dimension_down(p, (float)(v->at_y - v->scale * (double)v->high[1]),
                           (float)(v->at_y - v->scale * (double)v->low[1]),
                           (float)(v->at_x + v->scale * (double)v->low[0]),
                           length_of(size[k ? 2 : 1]).text);
    }
}

/* ---- names, symbol, legend ------------------------------------------------------------------ */

static inline void annotate_names(pen *p, const views *s)
{
    for (int i = 0; i < s->count; i++) {
        const view *v = &s->list[i];
        const float size = 0.85f * p->text;
        float wide = pen_width(p, size, view_names[v->kind]);
        pen_set(p, 1, (float)v->x + ((float)v->width - wide) / 2, (float)v->y - 0.5f * p->text,
                size, p->grey, view_names[v->kind]);
    }
}

/* A cone from its side, its small end on the left, and from that end: this view stands on the side
   that it shows in third-angle projection, on the other one in first-angle.  x: right, y: middle */
static inline void annotate_symbol(pen *p, float x, float y, int first_angle)
{
    const float u = p->unit, r = 11 * u, small = 5.5f * u, l = 30 * u;
    const float circle = first_angle ? x - r : x - l - 14 * u - r;
    const float cone = first_angle ? x - 2 * r - 14 * u - l : x - l; /* its left end */
    const float left = first_angle ? cone : circle - r, right = first_angle ? circle + r : cone + l;
    pen_line(p, cone, y - small, cone, y + small, 1.4f * u, p->ink);
    pen_line(p, cone + l, y - r, cone + l, y + r, 1.4f * u, p->ink);
    pen_line(p, cone, y - small, cone + l, y - r, 1.4f * u, p->ink);
    pen_line(p, cone, y + small, cone + l, y + r, 1.4f * u, p->ink);
    pen_circle(p, circle, y, r, 1.4f * u);
    pen_circle(p, circle, y, small, 1.4f * u);
    pen_line(p, left - 4 * u, y, right + 4 * u, y, 0.7f * u, p->grey);
    pen_line(p, circle, y - r - 4 * u, circle, y + r + 4 * u, 0.7f * u, p->grey);
}

/* A colour for each piece: twelve that differ, then these lighter and darker */
static inline shade_vec3 piece_color(int i)
{
    static const uint32_t color[12] = {
        0x5B9BD5, 0xF0A04B, 0x7DBE6A, 0xE0736F, 0xA48AD4, 0xC9A26D,
        0xE79AC0, 0x56BDB7, 0xD9CF5A, 0x9AA5B1, 0x9ED0F5, 0xB5D99C
    };
    shade_vec3 c = shade_rgb(color[i % 12]);
    if (i / 12 % 3 == 1) return shade_scale(c, 0.6f);
    if (i / 12 % 3 == 2) return shade_lerp(c, shade_v3(1, 1, 1), 0.5f);
    return c;
}

/* The column of the legend, from x, y on; what does not fit is counted in its last line. */
static inline void annotate_legend(pen *p, const pieces *parts, float x, float y, float width,
                                   float bottom)
{
    const float line = 1.5f * p->text, size = 0.85f * p->text, box = 0.8f * p->text;
    int lines = (int)((bottom - y) / line), shown = parts->count;
    char text[100];
    if (shown > lines) shown = lines - 1;
    for (int i = 0; i < shown; i++, y += line) {
        shade_vec3 c = piece_color(i);
        float s = (float)p->samples;
        canvas_fill(&p->target, (int)(s * x), (int)(s * (y - box)), (int)(s * box), (int)(s * box),
                    c);
        pen_line(p, x, y - box, x + box, y - box, p->unit, p->ink);
        pen_line(p, x, y, x + box, y, p->unit, p->ink);
        pen_line(p, x, y - box, x, y, p->unit, p->ink);
        pen_line(p, x + box, y - box, x + box, y, p->unit, p->ink);
        snprintf(text, sizeof text, "%d  %s", i + 1, parts->list[i].name);
        pen_fit(p, x + 1.4f * box, y - 0.1f * p->text, size, width - 1.4f * box, text);
    }
    if (shown >= parts->count || lines < 1) return;
    snprintf(text, sizeof text, "and %d more", parts->count - (shown < 0 ? 0 : shown));
    pen_fit(p, x, y - 0.1f * p->text, size, width, text);
}
#endif
