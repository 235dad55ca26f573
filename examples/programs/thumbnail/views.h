/* views.h - the views of a drawing: where each stands on the sheet, and its matrix.

   A model stands upright (x to the right, y up, z toward who sees the front), its box about the
   origin.  A matrix takes it to pixels of the sheet and to depth, 0 near and 1 far; where a lens
   draws the view, x, y and depth are divided by w. */
#ifndef THUMBNAIL_VIEWS_H
#define THUMBNAIL_VIEWS_H

#include "options.h"
#include "../../shared/mesh.h"

typedef struct matrix4 {
    double row[4][4];
} matrix4;

typedef struct view {
    int kind, lens; /* lens: perspective, the eye stands EYE away from the origin */
    shade_vec3 right, up, toward;
    float low[3], high[3];    /* the model along right, up (as the lens sees it) and toward */
    int column, row;          /* of the layout */
    int x, y, width, height;  /* where it stands on the sheet, in pixels */
    double scale, at_x, at_y; /* pixels for a unit of the model; the pixel of the origin */
    matrix4 from_model;
} view;

typedef struct views {
    view list[VIEW_KINDS];
    int count, width, height; /* of the sheet */
    double scale;             /* that the flat views share; 0: there is none */
} views;

#define VIEWS_EYE 7.0 /* a model reaches 1.74 from the origin at most: seen within 29 degrees */

/* ---- directions ----------------------------------------------------------------------------- */

static inline view view_of(int kind, int ortho)
{
    static const float axis[6][2][3] = {
        /* right and up, by kind */
        { { 1, 0, 0 }, { 0, 1, 0 } }, { { -1, 0, 0 }, { 0, 1, 0 } }, { { 0, 0, -1 }, { 0, 1, 0 } },
        { { 0, 0, 1 }, { 0, 1, 0 } }, { { 1, 0, 0 }, { 0, 0, -1 } }, { { 1, 0, 0 }, { 0, 0, 1 } }
    };
    view v = { .kind = kind };
    if (kind == VIEW_ISO) {
        v.lens = !ortho;
        v.toward = shade_normalize(shade_v3(1, 1, 1));
        v.right = shade_normalize(shade_v3(1, 0, -1));
        v.up = shade_cross(v.toward, v.right);
        return v;
    }
    memcpy(&v.right, axis[kind][0], sizeof v.right);
    memcpy(&v.up, axis[kind][1], sizeof v.up);
    v.toward = shade_cross(v.right, v.up);
    return v;
}

/* Finds how far the model reaches in a view. */
static inline void view_measure(view *v, const owned_mesh *m)
{
    for (int k = 0; k < 3; k++) {
        v->low[k] = FLT_MAX;
        v->high[k] = -FLT_MAX;
    }
    for (size_t i = 0; i < 3 * (size_t)m->view.vertex_count; i += 3) {
        shade_vec3 p = shade_v3(m->positions[i], m->positions[i + 1], m->positions[i + 2]);
        float q[3] = { shade_dot(v->right, p), shade_dot(v->up, p), shade_dot(v->toward, p) };
        for (int k = 0; k < 3; k++) {
            float s = v->lens && k < 2 ? q[k] / ((float)VIEWS_EYE - q[2]) : q[k];
            v->low[k] = fminf(v->low[k], s);
            v->high[k] = fmaxf(v->high[k], s);
        }
    }
}

/* ---- matrices ------------------------------------------------------------------------------- */

/* The matrix of a view whose scale and origin stand */
static inline void view_matrix(view *v)
{
    const float axis[3][3] = { { v->right.x, v->right.y, v->right.z },
                               { v->up.x, v->up.y, v->up.z },
                               { v->toward.x, v->toward.y, v->toward.z } };
    const double place[2] = { v->at_x, v->at_y }, sign[2] = { 1, -1 };
    double low = (double)v->low[2] - 0.002, high = (double)v->high[2] + 0.002;
    double near_plane = VIEWS_EYE - high, far_plane = VIEWS_EYE - low;
    double bend = far_plane / (far_plane - near_plane);
    memset(&v->from_model, 0, sizeof v->from_model);
    for (int c = 0; c < 3; c++) {
        double t = (double)axis[2][c];
        v->from_model.row[3][c] = v->lens ? -t : 0;
        v->from_model.row[2][c] = v->lens ? -bend * t : -t / (high - low);
        for (int k = 0; k < 2; k++)
            v->from_model.row[k][c] =
                v->scale * sign[k] * (double)axis[k][c] + place[k] * v->from_model.row[3][c];
    }
    v->from_model.row[3][3] = v->lens ? VIEWS_EYE : 1;
    v->from_model.row[2][3] = v->lens ? bend * (VIEWS_EYE - near_plane) : high / (high - low);
    for (int k = 0; k < 2; k++) v->from_model.row[k][3] = place[k] * v->from_model.row[3][3];
}

static inline matrix4 matrix4_mul(const matrix4 *a, const matrix4 *b)
{
    matrix4 m;
    for (int i = 0; i < 4; i++)
        for (int k = 0; k < 4; k++) {
            m.row[i][k] = 0;
            for (int j = 0; j < 4; j++) m.row[i][k] += a->row[i][j] * b->row[j][k];
        }
    return m;
}

/* By elimination; the matrices of views have an inverse. */
static inline matrix4 matrix4_inverse(matrix4 a)
{
    matrix4 m = { { { 1, 0, 0, 0 }, { 0, 1, 0, 0 }, { 0, 0, 1, 0 }, { 0, 0, 0, 1 } } };
    for (int c = 0; c < 4; c++) {
        int pivot = c;
        double scale;
        for (int i = c + 1; i < 4; i++)
            if (fabs(a.row[i][c]) > fabs(a.row[pivot][c])) pivot = i;
        for (int k = 0; k < 4; k++) {
            double swap = a.row[c][k], other = m.row[c][k];
            a.row[c][k] = a.row[pivot][k];
            a.row[pivot][k] = swap;
            m.row[c][k] = m.row[pivot][k];
            m.row[pivot][k] = other;
        }
        scale = 1 / a.row[c][c];
        for (int k = 0; k < 4; k++) {
            a.row[c][k] *= scale;
            m.row[c][k] *= scale;
        }
        for (int i = 0; i < 4; i++) {
            double by = i == c ? 0 : a.row[i][c];
            for (int k = 0; k < 4; k++) {
                a.row[i][k] -= by * a.row[c][k];
                m.row[i][k] -= by * m.row[c][k];
            }
        }
    }
    return m;
}

/* The clip-space matrix of a view for a target that shows the sheet whole */
static inline shade_mat4 view_clip(const views *s, const view *v)
{
    const double half[2] = { s->width / 2.0, s->height / 2.0 };
    shade_mat4 m;
    float column[4];
    for (int c = 0; c < 4; c++) {
        double w = v->from_model.row[3][c];
        column[0] = (float)(v->from_model.row[0][c] / half[0] - w);
        column[1] = (float)(w - v->from_model.row[1][c] / half[1]);
        column[2] = (float)(2 * v->from_model.row[2][c] - w);
        column[3] = (float)w;
        memcpy(&m.col[c], column, sizeof column);
    }
    return m;
}

/* Pixel x, y and depth of a point of the model */
static inline shade_vec3 view_project(const view *v, const float *p)
{
    double q[4];
    for (int i = 0; i < 4; i++) {
        const double *r = v->from_model.row[i];
        q[i] = r[0] * (double)p[0] + r[1] * (double)p[1] + r[2] * (double)p[2] + r[3];
    }
    return shade_v3((float)(q[0] / q[3]), (float)(q[1] / q[3]), (float)(q[2] / q[3]));
}

/* ---- layout --------------------------------------------------------------------------------- */

/* The room that a layout may fill, and what it leaves free about views, in pixels */
typedef struct views_room {
    double x, y, width, height, pad[4]; /* pad: left, top, right, bottom of each view */
} views_room;

enum { VIEWS_COLUMNS = 5, VIEWS_ROWS = 3 };
static inline void view_cell(view *v, int first_angle)
{
    static const int column[] = { 1, 3, 2, 0, 1, 1 }, row[] = { 1, 1, 1, 1, 0, 2 };
    v->column = column[v->kind];
    v->row = row[v->kind];
    if (!first_angle) return;
    v->row = 2 - v->row;
    if (v->column != 3) v->column = 2 - v->column;
}

/* The iso view takes a free corner between other views or, without one, a column of its own. */
static inline void views_place_iso(views *s, view *iso)
{
    static const int corner[4][2] = { { 2, 0 }, { 0, 0 }, { 0, 2 }, { 2, 2 } };
    iso->column = VIEWS_COLUMNS - 1;
    iso->row = 1;
    for (int k = 3; k >= 0; k--) {
        int beside = 0, above = 0;
        for (int i = 0; i < s->count; i++) {
            if (s->list[i].kind == VIEW_ISO) continue;
            beside |= s->list[i].row == corner[k][1];
            above |= s->list[i].column == corner[k][0];
        }
        if (!beside || !above) continue;
        iso->column = corner[k][0];
        iso->row = corner[k][1];
    }
}

/* One direction of the layout: its columns, or its rows */
typedef struct views_line {
    double extent[VIEWS_COLUMNS];                     /* of flat views, in the model's units */
    double begin[VIEWS_COLUMNS], size[VIEWS_COLUMNS]; /* pixels, without what is left free */
    int used[VIEWS_COLUMNS], iso, cells;
    double room, least; /* pixels for views; the least for the iso view */
} views_line;

static inline views_line views_measure(const views *s, int k, double room, double free_space)
{
    views_line l = { .iso = -1, .room = room };
    for (int i = 0; i < s->count; i++) {
        const view *v = &s->list[i];
        int at = k ? v->row : v->column;
        l.cells += !l.used[at];
        l.used[at] = 1;
        if (v->kind == VIEW_ISO)
            l.iso = at;
        else
            l.extent[at] = fmax(l.extent[at], (double)(v->high[k] - v->low[k]));
    }
    l.room -= l.cells * free_space;
    l.least = l.iso < 0 ? 0 : l.cells == 1 ? l.room : 0.3 * l.room;
    return l;
}

/* The largest scale at which the flat views fit, with room left for the iso view */
static inline double views_fit(const views_line *l)
{
    double sum = 0, of_iso = l->iso < 0 ? 0 : l->extent[l->iso], scale;
    for (int i = 0; i < VIEWS_COLUMNS; i++) sum += l->extent[i];
    scale = l->room / fmax(sum, 1e-3);
    if (scale * of_iso >= l->least) return scale;
    return (l->room - l->least) / fmax(sum - of_iso, 1e-3);
}

/* Places the cells one after the other, in the middle of the room. */
static inline void views_cells(views_line *l, double scale, double wish, double from, double before,
                               double after)
{
    double rest = l->room, at = from;
    for (int i = 0; i < VIEWS_COLUMNS; i++) {
        l->size[i] = scale * l->extent[i];
        rest -= l->size[i];
    }
    if (l->iso >= 0) {
        double size = fmin(wish, l->size[l->iso] + rest);
        if (size > l->size[l->iso]) {
            rest -= size - l->size[l->iso];
            l->size[l->iso] = size;
        }
    }
    at += rest / 2;
    for (int i = 0; i < VIEWS_COLUMNS; i++) {
        if (!l->used[i]) continue;
        l->begin[i] = at + before;
        at += before + l->size[i] + after;
    }
}

/* Where a view of a size begins in its cell: toward the front view, or in the middle */
static inline double views_inside(const views_line *l, int at, double size, int front, int middle)
{
    double rest = l->size[at] - size;
    if (middle || at == front) return l->begin[at] + rest / 2;
    return at < front ? l->begin[at] + rest : l->begin[at];
}

static inline void view_settle(view *v, const views_line *columns, const views_line *rows,
                               double scale)
{
    double width = (double)(v->high[0] - v->low[0]), height = (double)(v->high[1] - v->low[1]);
    int iso = v->kind == VIEW_ISO;
    double x, y;
    v->scale = scale;
    if (iso) {
        double fit = fmin(columns->size[v->column] / fmax(width, 1e-9),
                          rows->size[v->row] / fmax(height, 1e-9));
        v->scale = v->lens || scale <= 0 ? fit : fmin(fit, scale);
        if (width + height <= 0) v->scale = 100; /* a point */
    }
    x = views_inside(columns, v->column, v->scale * width, 1, iso);
    y = views_inside(rows, v->row, v->scale * height, 1, iso);
    v->at_x = x - v->scale * (double)v->low[0];
    v->at_y = y + v->scale * (double)v->high[1];
    v->x = (int)floor(x) - 3;
    v->y = (int)floor(y) - 3;
    v->width = (int)ceil(x + v->scale * width) + 3 - v->x;
    v->height = (int)ceil(y + v->scale * height) + 3 - v->y;
    view_matrix(v);
}

/* Lays the views out.  The flat ones share one scale, the largest at which all fit. */
static inline void views_lay_out(views *s, const drawing_options *d, const owned_mesh *m,
                                 const views_room *room)
{
    views_line columns, rows;
    double wish[2] = { 0, 0 };
    view *iso = NULL;
    for (int i = 0; i < d->view_count; i++) {
        view *v = &s->list[s->count++];
        *v = view_of(d->view[i], d->ortho);
        view_measure(v, m);
        if (v->kind == VIEW_ISO)
            iso = v;
        else
            view_cell(v, d->first_angle);
    }
    if (iso) views_place_iso(s, iso);
    columns = views_measure(s, 0, room->width, room->pad[0] + room->pad[2]);
    rows = views_measure(s, 1, room->height, room->pad[1] + room->pad[3]);
    if (!iso || s->count > 1) s->scale = fmin(views_fit(&columns), views_fit(&rows));
    if (iso) { /* by a lens, the middle of the model has this scale */
        double k = s->scale > 0 ? iso->lens ? VIEWS_EYE * s->scale : s->scale : 1e9;
        wish[0] = k * (double)(iso->high[0] - iso->low[0]);
        wish[1] = k * (double)(iso->high[1] - iso->low[1]);
    }
    views_cells(&columns, s->scale, wish[0], room->x, room->pad[0], room->pad[2]);
    views_cells(&rows, s->scale, wish[1], room->y, room->pad[1], room->pad[3]);
    for (int i = 0; i < s->count; i++) view_settle(&s->list[i], &columns, &rows, s->scale);
}
#endif
