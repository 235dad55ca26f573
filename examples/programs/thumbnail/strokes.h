/* strokes.h - the lines of a view: outlines, sharp and open edges of a mesh as strokes in pixels,
   whole where they are seen and dashed where they are hidden.

   Edges that continue each other become a chain, so that dashes run on around a hole.  A chain is
   looked at once a pixel.  A point of it is seen where one of the pixels around it shows one of its
   two triangles, or nothing, or something that is not nearer.  Of hidden chains on the same line
   only the first is drawn, and none below a seen one: dashes of several would fill each other's
   gaps. */
#ifndef THUMBNAIL_STROKES_H
#define THUMBNAIL_STROKES_H

#include "../../kit/draw/outline.h"
#include "views.h"

/* What is seen at each pixel of the sheet: the triangle's number + 1, and its depth */
typedef struct seen {
    uint32_t *item;
    float *depth;
    int width, height;
} seen;

typedef struct strokes {
    mesh_floats whole, dashed; /* pairs of points, in pixels, z = 0 */
    int failed;                /* memory ran out */
} strokes;

/* ---- chains --------------------------------------------------------------------------------- */

/* The work on one view */
typedef struct chains {
    const outline *outline;
    const view *view;
    const seen *seen;
    const drawing_options *options;
    float unit;           /* of the sheet: lengths of dashes count in it */
    uint32_t *edge;       /* those drawn in this view */
    char *used;           /* by place in edge */
    uint32_t *first, *at; /* the edges at place p begin in the list at at first[p + 1] */
    size_t count;
    uint32_t *place, *of; /* the chain: its places, and for each step its edge */
    size_t steps;
    float *x, *y, *z, *along; /* of its places; along: pixels from its begin */
    char *state;              /* of its samples */
    size_t samples, room, sample_room;
    uint32_t number;
    uint32_t *claim; /* by pixel of the sheet: the chain that lies there, and its way */
    signed char *claim_way;
    strokes *out;
} chains;

enum { CHAIN_SEEN, CHAIN_HIDDEN, CHAIN_DROPPED };

static inline shade_vec3 chains_place(const chains *c, uint32_t place)
{
    return outline_place(c->outline, place);
}

static inline int chains_is_outline(const chains *c, const shade_edge *e)
{
    shade_vec3 to_eye = c->view->toward;
    if (c->view->lens)
        to_eye = shade_sub(shade_scale(to_eye, (float)VIEWS_EYE), chains_place(c, e->a));
    return outline_is_seen(c->outline, e, to_eye);
}

/* Chooses the edges of the view, and lists them by their ends. */
static inline int chains_choose(chains *c)
{
    const outline *o = c->outline;
    c->edge = (uint32_t *)malloc(((size_t)o->bent + 1) * sizeof *c->edge);
    c->first = (uint32_t *)calloc(o->places + 2, sizeof *c->first);
    if (!c->edge || !c->first) return 1;
    for (int i = 0; i < o->bent; i++)
        if (i < o->sharp || chains_is_outline(c, &o->edge[i])) c->edge[c->count++] = (uint32_t)i;
    c->used = (char *)calloc(c->count + 1, 1);
    c->at = (uint32_t *)malloc((2 * c->count + 1) * sizeof *c->at);
    if (!c->used || !c->at) return 1;
    for (size_t i = 0; i < c->count; i++) {
        c->first[o->edge[c->edge[i]].a + 1]++;
        c->first[o->edge[c->edge[i]].b + 1]++;
    }
    for (size_t i = 0; i <= o->places; i++) c->first[i + 1] += c->first[i];
    for (size_t i = c->count; i-- > 0;) { /* first[p + 1] sinks from the end to the begin */
        c->at[--c->first[o->edge[c->edge[i]].a + 1]] = (uint32_t)i;
        c->at[--c->first[o->edge[c->edge[i]].b + 1]] = (uint32_t)i;
    }
    return 0;
}

static inline uint32_t chains_other(const chains *c, uint32_t edge, uint32_t place)
{
    const shade_edge *e = &c->outline->edge[c->edge[edge]];
    return e->a == place ? e->b : e->a;
}

/* The edge that continues another beyond a place: the only other one there, or the straightest.
   count: none */
static inline uint32_t chains_next(const chains *c, uint32_t edge, uint32_t place)
{
    uint32_t begin = c->first[place + 1], best = (uint32_t)c->count;
    uint32_t end = c->first[place + 2];
    shade_vec3 here = chains_place(c, place), way;
    float straight = 0;
    way = shade_normalize(shade_sub(here, chains_place(c, chains_other(c, edge, place))));
    for (uint32_t k = begin; k < end; k++) {
        shade_vec3 next = chains_place(c, chains_other(c, c->at[k], place));
        float cosine = shade_dot(way, shade_normalize(shade_sub(next, here)));
        if (c->at[k] == edge || c->used[c->at[k]] || cosine < (end - begin == 2 ? 0.7f : 0.999f) ||
            cosine <= straight)
            continue;
        straight = cosine;
        best = c->at[k];
    }
    return best;
}

/* Room for n places */
static inline int chains_grow(chains *c, size_t n)
{
    void *grown[6];
    size_t wanted = c->room ? 2 * c->room : 256;
    if (n <= c->room) return 0;
    while (wanted < n) wanted *= 2;
    grown[0] = realloc(c->place, wanted * sizeof *c->place);
    if (grown[0]) c->place = (uint32_t *)grown[0];
    grown[1] = realloc(c->of, wanted * sizeof *c->of);
    if (grown[1]) c->of = (uint32_t *)grown[1];
    grown[2] = realloc(c->x, wanted * sizeof *c->x);
    if (grown[2]) c->x = (float *)grown[2];
    grown[3] = realloc(c->y, wanted * sizeof *c->y);
    if (grown[3]) c->y = (float *)grown[3];
    grown[4] = realloc(c->z, wanted * sizeof *c->z);
    if (grown[4]) c->z = (float *)grown[4];
    grown[5] = realloc(c->along, wanted * sizeof *c->along);
    if (grown[5]) c->along = (float *)grown[5];
    for (int i = 0; i < 6; i++)
        if (!grown[i]) return 1;
    c->room = wanted;
    return 0;
}

static inline int chains_push(chains *c, uint32_t edge, uint32_t place)
{
    if (chains_grow(c, c->steps + 2)) return 1;
    c->of[c->steps++] = edge;
    c->place[c->steps] = place;
    c->used[edge] = 1;
    return 0;
}

/* Walks from an edge back to where the chain begins, then along it. */
static inline int chains_walk(chains *c, uint32_t start)
{
    uint32_t none = (uint32_t)c->count, edge = start, place = c->outline->edge[c->edge[start]].a;
    size_t back = 0;
    if (chains_grow(c, 2)) return 1;
    c->used[start] = 1;
    for (;; back++) { /* marks what it passes, so that a ring ends; the way along unmarks it */
        uint32_t next = chains_next(c, edge, place);
        if (next == none) break;
        if (chains_grow(c, back + 2)) return 1;
        c->of[back] = next;
        c->used[next] = 1;
        place = chains_other(c, next, place);
        edge = next;
    }
    for (size_t i = 0; i < back; i++) c->used[c->of[i]] = 0;
    c->used[start] = 0;
    c->steps = 0;
    c->place[0] = place;
    for (edge = back ? edge : start; edge != none;) {
        place = chains_other(c, edge, place);
        if (chains_push(c, edge, place)) return 1;
        edge = chains_next(c, edge, place);
    }
    return 0;
}

/* ---- what is seen of a chain ---------------------------------------------------------------- */

/* How much depth a pixel is, where depth is z */
static inline float chains_pixel_depth(const view *v, float z)
{
    double span = (double)v->high[2] - (double)v->low[2] + 0.004, w, far_plane, near_plane;
    if (!v->lens) return (float)(1 / (v->scale * span));
    near_plane = VIEWS_EYE - (double)v->high[2] - 0.002;
    far_plane = near_plane + span;
    w = far_plane * near_plane / (far_plane - (double)z * span);
    return (float)(far_plane * near_plane / (span * w * v->scale));
}

static inline int chains_sees(const chains *c, uint32_t edge, float x, float y, float z)
{
    const shade_edge *e = &c->outline->edge[c->edge[edge]];
    float nearest = z - 0.75f * chains_pixel_depth(c->view, z);
    int i = (int)x, j = (int)y;
    for (int row = j - 1; row <= j + 1; row++) {
        for (int column = i - 1; column <= i + 1; column++) {
            size_t at = (size_t)row * (size_t)c->seen->width + (size_t)column;
            uint32_t item;
            if (row < 0 || column < 0 || row >= c->seen->height || column >= c->seen->width)
                return 1;
            item = c->seen->item[at];
            if (!item || item - 1 == (uint32_t)e->triangle[0] ||
                (e->triangle[1] >= 0 && item - 1 == (uint32_t)e->triangle[1]) ||
                c->seen->depth[at] >= nearest)
                return 1;
        }
    }
    return 0;
}

/* The sample, one a pixel, that lies at a length of the chain: its step and place there */
typedef struct chain_point {
    size_t step;
    float x, y, z, way_x, way_y;
} chain_point;

/* The point so far along the chain; steps only go on from p->step. */
static inline void chains_point(const chains *c, float along, chain_point *p)
{
    float length, part;
    size_t k;
    while (p->step + 1 < c->steps && c->along[p->step + 1] <= along) p->step++;
    k = p->step;
    length = c->along[k + 1] - c->along[k];
    part = length > 0 ? (along - c->along[k]) / length : 0;
    part = part < 0 ? 0 : part > 1 ? 1 : part;
    p->x = c->x[k] + part * (c->x[k + 1] - c->x[k]);
    p->y = c->y[k] + part * (c->y[k + 1] - c->y[k]);
    p->z = c->z[k] + part * (c->z[k + 1] - c->z[k]);
    p->way_x = length > 0 ? (c->x[k + 1] - c->x[k]) / length : 0;
    p->way_y = length > 0 ? (c->y[k + 1] - c->y[k]) / length : 0;
}

/* Projects the chain, and finds which of its samples are seen. */
static inline int chains_look(chains *c)
{
    chain_point p = { 0 };
    for (size_t i = 0; i <= c->steps; i++) {
        shade_vec3 q = view_project(c->view, c->outline->position + 3 * (size_t)c->place[i]);
        float dx, dy;
        c->x[i] = q.x;
        c->y[i] = q.y;
        c->z[i] = q.z;
        c->along[i] = 0;
        if (!i) continue;
        dx = c->x[i] - c->x[i - 1];
        dy = c->y[i] - c->y[i - 1];
        c->along[i] = c->along[i - 1] + sqrtf(dx * dx + dy * dy);
    }
    if (!(c->along[c->steps] < 1e6f)) c->steps = 0;
    c->samples = c->steps ? (size_t)c->along[c->steps] + 1 : 0;
    if (c->samples > c->sample_room) {
        free(c->state);
        c->sample_room = 2 * c->samples;
        c->state = (char *)malloc(c->sample_room);
        if (!c->state) return 1;
    }
    for (size_t i = 0; i < c->samples; i++) {
        chains_point(c, c->along[c->steps] * ((float)i + 0.5f) / (float)c->samples, &p);
        c->state[i] = chains_sees(c, c->of[p.step], p.x, p.y, p.z) ? CHAIN_SEEN : CHAIN_HIDDEN;
    }
    return 0;
}

/* Runs of one or two samples take the state of the run before, at the begin that of the next. */
static inline void chains_smooth(chains *c)
{
    for (size_t begin = 0, end; begin < c->samples; begin = end) {
        for (end = begin + 1; end < c->samples && c->state[end] == c->state[begin];) end++;
        if (end - begin > 2 || (begin == 0 && end == c->samples)) continue;
        memset(c->state + begin, c->state[begin > 0 ? begin - 1 : end], end - begin);
    }
}

/* ---- who lies where ------------------------------------------------------------------------- */

static inline size_t chains_pixel(const chains *c, const chain_point *p)
{
    int i = (int)p->x, j = (int)p->y;
    i = i < 1 ? 1 : i > c->seen->width - 2 ? c->seen->width - 2 : i;
    j = j < 1 ? 1 : j > c->seen->height - 2 ? c->seen->height - 2 : j;
    return (size_t)j * (size_t)c->seen->width + (size_t)i;
}

/* Whether another chain lies at the point and goes the same way, within 15 degrees */
static inline int chains_claimed(const chains *c, const chain_point *p)
{
    size_t at = chains_pixel(c, p), width = (size_t)c->seen->width;
    for (int k = 0; k < 9; k++) {
        size_t i = at + (size_t)(k / 3) * width + (size_t)(k % 3) - width - 1;
        float cross =
            p->way_x * (float)c->claim_way[2 * i + 1] - p->way_y * (float)c->claim_way[2 * i];
        if (c->claim[i] && c->claim[i] != c->number && cross * cross < 33 * 33) return 1;
    }
    return 0;
}

/* Claims the pixels of the samples of a state; hidden ones that are claimed are dropped first. */
static inline void chains_claim(chains *c, int state)
{
    chain_point p = { 0 };
    for (int claims = state == CHAIN_SEEN; claims < 2; claims++) {
        p.step = 0;
        for (size_t i = 0; i < c->samples; i++) {
            size_t at;
            if (c->state[i] != state) continue;
            chains_point(c, c->along[c->steps] * ((float)i + 0.5f) / (float)c->samples, &p);
            if (!claims && chains_claimed(c, &p)) c->state[i] = CHAIN_DROPPED;
            if (!claims) continue;
            at = chains_pixel(c, &p);
            c->claim[at] = c->number;
            c->claim_way[2 * at] = (signed char)(127 * p.way_x);
            c->claim_way[2 * at + 1] = (signed char)(127 * p.way_y);
        }
    }
}

/* ---- strokes -------------------------------------------------------------------------------- */

/* Adds the part of the chain between two lengths. */
static inline void chains_stroke(chains *c, mesh_floats *out, float from, float to, size_t *step)
{
    chain_point p = { 0 };
    float last[3] = { 0, 0, 0 };
    p.step = *step;
    chains_point(c, from, &p);
    last[0] = p.x;
    last[1] = p.y;
    for (size_t k = p.step + 1; k <= c->steps; k++) {
        int ends = k == c->steps || c->along[k] >= to;
        float next[3] = { c->x[k], c->y[k], 0 };
        if (ends) {
            chains_point(c, to, &p);
            next[0] = p.x;
            next[1] = p.y;
        }
        c->out->failed |= mesh_push(out, last, 3) || mesh_push(out, next, 3);
        memcpy(last, next, sizeof last);
        if (ends) break;
    }
    *step = p.step;
}

/* Dashes begin and end with a dash; their pattern stretches to that. */
static inline void chains_dash(chains *c, float from, float to, size_t *step)
{
    const float dash = 11 * c->unit, gap = 5 * c->unit, length = to - from;
    int n = (int)((length + gap) / (dash + gap) + 0.5f);
    float stretch;
    if (n < 1) n = 1;
    stretch = length / ((float)n * dash + (float)(n - 1) * gap);
    for (int i = 0; i < n; i++) {
        float begin = from + stretch * (dash + gap) * (float)i;
        chains_stroke(c, &c->out->dashed, begin, begin + stretch * dash, step);
    }
}

/* Adds the runs of samples of one state. */
static inline void chains_draw(chains *c, int state)
{
    float length = c->samples ? c->along[c->steps] / (float)c->samples : 0;
    size_t step = 0;
    for (size_t begin = 0, end; begin < c->samples; begin = end) {
        for (end = begin + 1; end < c->samples && c->state[end] == c->state[begin];) end++;
        if (c->state[begin] != state) continue;
        if (state == CHAIN_SEEN)
            chains_stroke(c, &c->out->whole, length * (float)begin, length * (float)end, &step);
        else if (length * (float)(end - begin) >= 3 * c->unit)
            chains_dash(c, length * (float)begin, length * (float)end, &step);
    }
}

/* Once for what is seen, then for what is hidden. */
static inline int chains_pass(chains *c, int state)
{
    memset(c->used, 0, c->count);
    c->number = 0;
    for (uint32_t i = 0; i < c->count; i++) {
        while (!c->used[i]) { /* a walk uses an edge, but where ways part perhaps not this one */
            c->number++;
            if (chains_walk(c, i) || chains_look(c)) return 1;
            chains_smooth(c);
            chains_claim(c, state);
            chains_draw(c, state);
        }
    }
    return 0;
}

/* Finds the strokes of a view.  claim and claim_way have as many pixels as the sheet and begin as
   zeros; views that do not overlap may share them. */
static inline void strokes_find(chains *c)
{
    int failed = chains_choose(c) || chains_pass(c, CHAIN_SEEN);
    if (!failed && c->options->hidden && c->view->kind != VIEW_ISO)
        failed = chains_pass(c, CHAIN_HIDDEN);
    if (failed) c->out->failed = 1;
    free(c->edge);
    free(c->used);
    free(c->first);
    free(c->at);
    free(c->place);
    free(c->of);
    free(c->x);
    free(c->y);
    free(c->z);
    free(c->along);
    free(c->state);
}
#endif
