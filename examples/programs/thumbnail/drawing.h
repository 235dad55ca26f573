/* drawing.h - a sheet with several views of a part, and what programs want to know of it. */
#ifndef THUMBNAIL_DRAWING_H
#define THUMBNAIL_DRAWING_H

#include "../../kit/scene/prepare.h"
#include "../../shared/bands.h"
#include "maps.h"

enum { DRAWING_BANDS = 24, DRAWING_SMOOTH = 200000 }; /* larger meshes are lit by their faces */
#define DRAWING_AMBIENT 0.38f                         /* light from everywhere, and from the lamp */
#define DRAWING_LAMP 0.70f

typedef struct drawing {
    const options *options;
    model *model;
    pieces pieces;
    views views;
    outline outline;
    shade_target sheet; /* samples times as wide and high as the sheet */
    seen seen;
    uint16_t *piece_of; /* by triangle */
    shade_vec3 *color;  /* of each piece */
    int *pixels;        /* as in drawing_text */
    uint32_t *claim;
    signed char *claim_way;
    strokes strokes[VIEW_KINDS];
    matrix4 model_from_file;
    double low[3], high[3], size[3]; /* the box of the file; width, height, depth upright */
    float unit;
    int up, lit_by_faces;
    shade_result result[DRAWING_BANDS + 1];
} drawing;

/* ---- the model ------------------------------------------------------------------------------ */

/* Moves the box of the model about the origin, half as large as 2 along its longest side, and turns
   its axis up. */
static void drawing_stand(drawing *d)
{
    owned_mesh *m = &d->model->mesh;
    size_t n = (size_t)m->view.vertex_count;
    double row[3][3], half = 0;
    mesh_box(m, d->low, d->high);
    for (int k = 0; k < 3; k++) half = fmax(half, (d->high[k] - d->low[k]) / 2);
    if (!(half > 0)) half = 1;
    upright_rows(d->up, 0, row);
    for (size_t i = 0; i < 3 * n; i++) {
        double middle = (d->low[i % 3] + d->high[i % 3]) / 2;
        m->positions[i] = (float)(((double)m->positions[i] - middle) / half);
    }
    rotate_rows(m->positions, n, row);
    rotate_rows(m->normals, n, row);
    for (int k = 0; k < 3; k++) {
        d->low[k] += d->model->origin[k];
        d->high[k] += d->model->origin[k];
    }
    for (int i = 0; i < 3; i++)
        for (int k = 0; k < 3; k++) {
            d->model_from_file.row[i][k] = row[i][k] / half;
            d->model_from_file.row[i][3] -= row[i][k] / half * (d->low[k] + d->high[k]) / 2;
            d->size[i] += fabs(row[i][k]) * (d->high[k] - d->low[k]);
        }
    d->model_from_file.row[3][3] = 1;
}

/* The colour of a part: its piece's, the command line's, or the file's, made lighter so that lines
   show on it */
static shade_vec3 drawing_color(const drawing *d, int part)
{
    const model *m = d->model;
    const model_options *how = &d->options->how;
    const model_surface *s = m->surface_count ? &m->surface[m->part[part].surface] : NULL;
    const surface_choice choice =
        surface_choose(m, m->part[part].surface, &how->material, how->plain);
    if (s && s->section && s->set) return shade_rgb(0x3A424A); /* lines of the hatch */
    if (d->options->drawing.ids) return piece_color(d->pieces.of_part[part]);
    if (how->plain) return choice.material.diffuse;
    if (s && s->section) return shade_rgb(0xE6EAEE);
    if (choice.own) return shade_lerp(choice.material.diffuse, shade_v3(1, 1, 1), 0.2f);
    return choice.colored ? choice.material.diffuse : shade_rgb(0xB9C4CF);
}

/* Boxes around runs of triangles.  Where neighbours in the file are neighbours in space, as most
   programs write them, sorting would take longer than it saves.  Non-zero: out of memory */
static int drawing_chunks(model *m)
{
    double size = 0;
    int count = 0;
    for (int i = 0; i < m->part_count; i++) {
        m->part[i].first_chunk = count;
        count += m->part[i].chunk_count = shade_chunk_count(m->part[i].count, 0);
    }
    m->mesh.chunks = (shade_chunk *)malloc(((size_t)count + 1) * sizeof *m->mesh.chunks);
    if (!m->mesh.chunks) return 1;
    for (int i = 0; i < m->part_count; i++) {
        shade_mesh mesh = model_part_mesh(m, i);
        shade_mesh_chunks(&mesh, 0, m->mesh.chunks + m->part[i].first_chunk, m->part[i].chunk_count,
                          NULL);
    }
    for (int i = 0; i < count; i++)
        size += (double)shade_distance(m->mesh.chunks[i].low, m->mesh.chunks[i].high);
    if (size < 0.3 * count) return 0;
    free(m->mesh.chunks);
    m->mesh.chunks = NULL;
    return mesh_chunk_parts(m);
}

/* Non-zero: out of memory */
static int drawing_prepare(drawing *d)
{
    model *m = d->model;
    int triangles = m->mesh.view.index_count / 3, failed;
    d->up = model_up(m, &d->options->how, 0);
    failed = pieces_find(&d->pieces, m);
    if (failed) return 1;
    drawing_stand(d);
    d->lit_by_faces = !m->normals_given && triangles > DRAWING_SMOOTH;
    if (!m->normals_given && !d->lit_by_faces && mesh_crease(&m->mesh, 0, OUTLINE_CREASE)) return 1;
    if (drawing_chunks(m)) return 1;
    d->piece_of = (uint16_t *)malloc((size_t)triangles * sizeof *d->piece_of);
    d->color = (shade_vec3 *)malloc(((size_t)d->pieces.count + 1) * sizeof *d->color);
    d->pixels = (int *)calloc((size_t)d->pieces.count + 1, VIEW_KINDS * sizeof *d->pixels);
    if (!d->piece_of || !d->color || !d->pixels) return 1;
    for (int i = m->part_count - 1; i >= 0; i--) {
        const model_part *part = &m->part[i];
        for (int t = part->first / 3; t < (part->first + part->count) / 3; t++)
            d->piece_of[t] = (uint16_t)d->pieces.of_part[i];
        d->color[d->pieces.of_part[i]] = drawing_color(d, i);
    }
    return 0;
}

/* ---- the sheet ------------------------------------------------------------------------------ */

/* Where the views may stand: within the frame, above the line about the model, left of the
   legend */
static views_room drawing_room(const drawing *d, const pen *p)
{
    const drawing_options *g = &d->options->drawing;
    double margin = 30 * (double)d->unit, text = (double)p->text;
    views_room r = { margin,
                     margin,
                     p->width - 2 * margin,
                     p->height - 2 * margin - 2.2 * text,
                     { 0.6 * text, 1.9 * text, 0.6 * text, 0.6 * text } };
    if (g->ids && d->pieces.count > 1) r.width -= 0.2 * p->width;
    if (g->dimensions) {
        r.pad[0] = 3.2 * text + 20 * (double)d->unit;
        r.pad[2] = 2 * text;
        r.pad[3] = 2.6 * text;
    }
    return r;
}

/* Returns 1 where no view can be seen. */
static int drawing_lay_out(drawing *d, const pen *p)
{
    const views_room room = drawing_room(d, p);
    d->views.width = p->width;
    d->views.height = p->height;
    views_lay_out(&d->views, &d->options->drawing, &d->model->mesh, &room);
    for (int i = 0; i < d->views.count; i++) {
        const view *v = &d->views.list[i];
        if (!(v->scale > 4) || v->x < 0 || v->y < 0 || v->x + v->width > p->width ||
            v->y + v->height > p->height)
            return complain("--size %dx%d is too small for these views", p->width, p->height);
    }
    return 0;
}

/* Non-zero: out of memory */
static int drawing_open(drawing *d, pen *p)
{
    const options *o = d->options;
    size_t pixels = (size_t)p->width * (size_t)p->height;
    size_t samples = pixels * (size_t)(o->picture.samples * o->picture.samples);
    d->sheet.width = p->width * o->picture.samples;
    d->sheet.height = p->height * o->picture.samples;
    d->sheet.srgb = 1;
    d->sheet.color = malloc(4 * samples);
    d->sheet.depth = (float *)malloc(samples * sizeof(float));
    d->seen.width = p->width;
    d->seen.height = p->height;
    d->seen.item = (uint32_t *)malloc(pixels * sizeof(uint32_t));
    d->seen.depth = (float *)malloc(pixels * sizeof(float));
    p->target = d->sheet;
    p->target.depth = NULL;
    if (o->drawing.edges) {
        d->claim = (uint32_t *)calloc(pixels, sizeof *d->claim);
        d->claim_way = (signed char *)calloc(pixels, 2);
        if (!d->claim || !d->claim_way) return 1;
    }
    return !d->sheet.color || !d->sheet.depth || !d->seen.item || !d->seen.depth;
}

/* ---- surfaces ------------------------------------------------------------------------------- */

/* Uniforms of the shaders that know a triangle by its number: no value is interpolated, which for
   small triangles would cost more than the pixels */
typedef struct faces_look {
    const float *positions;
    const uint32_t *indices;
    shade_mat4 clip;
    const view *view;
    shade_vec3 to_lamp, color;
    uint32_t first; /* number of the first triangle of the draw */
} faces_look;

static void faces_vertex(const void *uniforms, const shade_vertex_ids *SHADE_RESTRICT in,
                         shade_vertices *SHADE_RESTRICT out)
{
    const faces_look *k = (const faces_look *)uniforms;
    SHADE_EACH_LANE(i)
    {
        const float *p = k->positions + 3 * (size_t)in->index[i];
        lane_put4(out->clip[0], i, shade_mat4_transform(k->clip, shade_v4(p[0], p[1], p[2], 1)));
    }
}

/* The number of a triangle + 1 as the bytes of a pixel */
static void item_fragment(const void *uniforms, const shade_fragments *SHADE_RESTRICT in,
                          shade_colors *SHADE_RESTRICT out)
{
    const uint32_t first = ((const faces_look *)uniforms)->first + 1;
    SHADE_EACH_LANE(i)
    {
        uint32_t item = first + in->primitive[i];
        out->color[0][i] = (float)(item & 255) / 255;
        out->color[1][i] = (float)(item >> 8 & 255) / 255;
        out->color[2][i] = (float)(item >> 16 & 255) / 255;
        out->color[3][i] = (float)(item >> 24) / 255;
    }
}

/* Lambert's light on the side of the face that is seen, as drawing_state has it */
static void faces_fragment(const void *uniforms, const shade_fragments *SHADE_RESTRICT in,
                           shade_colors *SHADE_RESTRICT out)
{
    const faces_look *k = (const faces_look *)uniforms;
    for (int i = 0; i < in->count; i++) {
        const uint32_t *corner = k->indices + 3 * ((size_t)k->first + in->primitive[i]);
        shade_vec3 p[3], n, eye = k->view->toward;
        float light;
        for (int c = 0; c < 3; c++) memcpy(&p[c], k->positions + 3 * (size_t)corner[c], sizeof *p);
        n = shade_face_normal(p[0], p[1], p[2]);
        if (k->view->lens) eye = shade_sub(shade_scale(eye, (float)VIEWS_EYE), p[0]);
        light = shade_dot(n, k->to_lamp);
        if (shade_dot(n, eye) < 0) light = -light;
        light = DRAWING_AMBIENT + DRAWING_LAMP * (light > 0 ? light : 0);
        out->color[0][i] = light * k->color.x;
        out->color[1][i] = light * k->color.y;
        out->color[2][i] = light * k->color.z;
    }
}

/* Draws a part whose triangles are known by their numbers: runs of chunks that the target sees. */
static shade_result drawing_faces(const shade_target *target, const shade_mesh *mesh, faces_look *k,
                                  shade_fragment_shader *fragment)
{
    shade_pipeline p = { .vertex = faces_vertex, .fragment = fragment, .uniforms = k };
    const uint32_t part = k->first;
    shade_result result = SHADE_OK;
    for (int i = 0, end; i < mesh->chunk_count && !result; i = end + 1) {
        const shade_chunk *c = mesh->chunks;
        for (end = i; end < mesh->chunk_count; end++)
            if (!shade_box_visible(target, k->clip, 0, c[end].low, c[end].high)) break;
        if (end == i) continue;
        k->first = part + (uint32_t)c[i].first;
        result = shade_draw(target, &p, mesh->indices + 3 * (size_t)c[i].first,
                            3 * (c[end - 1].first + c[end - 1].count - c[i].first),
                            mesh->vertex_count, NULL);
    }
    k->first = part;
    return result;
}

/* From the model to the lamp, at the upper left of a view */
static shade_vec3 drawing_lamp(const view *v)
{
    shade_vec3 from = shade_madd(shade_scale(v->toward, 0.80f), -0.36f, v->right);
    return shade_normalize(shade_madd(from, 0.48f, v->up));
}

/* The camera and the lamp of a view */
static shade_draw_state drawing_state(const drawing *d, const view *v, shade_light *lamp)
{
    shade_draw_state state = { .shading = SHADE_SHADING_PER_FRAGMENT };
    shade_mat4 turn = shade_mat4_identity();
    turn.col[0] = shade_v4(v->right.x, v->up.x, v->toward.x, 0);
    turn.col[1] = shade_v4(v->right.y, v->up.y, v->toward.y, 0);
    turn.col[2] = shade_v4(v->right.z, v->up.z, v->toward.z, 0);
    if (v->lens) turn.col[3].z = -(float)VIEWS_EYE;
    state.view = turn;
    state.projection = shade_mat4_mul(view_clip(&d->views, v), shade_mat4_inverse(turn));
    *lamp = shade_directional_light(shade_neg(drawing_lamp(v)),
                                    shade_v3(DRAWING_LAMP, DRAWING_LAMP, DRAWING_LAMP));
    state.lighting.lights = lamp;
    state.lighting.light_count = 1;
    state.lighting.model = SHADE_MODEL_LAMBERT;
    state.lighting.ambient = shade_v3(DRAWING_AMBIENT, DRAWING_AMBIENT, DRAWING_AMBIENT);
    state.lighting.flags = SHADE_FLAG_TWO_SIDED | (v->lens ? 0 : SHADE_FLAG_INFINITE_VIEWER);
    return state;
}

/* Draws a part, lit or as the numbers of its triangles. */
static shade_result drawing_part(const drawing *d, const shade_target *target, int part,
                                 faces_look *k, const shade_draw_state *camera_and_lamp, int items)
{
    shade_draw_state state = *camera_and_lamp;
    shade_mesh mesh = model_part_mesh(d->model, part);
    shade_material own = { 0 };
    k->first = (uint32_t)d->model->part[part].first / 3;
    k->indices = d->model->mesh.indices;
    k->color = drawing_color(d, part);
    if (items) return drawing_faces(target, &mesh, k, item_fragment);
    if (d->lit_by_faces && (!mesh.colors || d->options->drawing.ids || d->options->how.plain))
        return drawing_faces(target, &mesh, k, faces_fragment);
    if (mesh.chunk_count == 1 &&
        !shade_box_visible(target, k->clip, 0, mesh.chunks->low, mesh.chunks->high))
        return SHADE_OK;
    own.ambient = own.diffuse = k->color;
    state.material = &own;
    mesh.texcoords = NULL;
    if (d->options->drawing.ids || d->options->how.plain) mesh.colors = NULL;
    if (d->lit_by_faces) mesh.normals = NULL;
    return shade_draw_mesh(target, &mesh, &state, NULL);
}

static shade_result drawing_view(const drawing *d, const shade_target *target, const view *v,
                                 int items)
{
    faces_look k = { .positions = d->model->mesh.positions, .view = v };
    shade_light lamp;
    shade_draw_state state = drawing_state(d, v, &lamp);
    shade_result result = SHADE_OK;
    k.clip = view_clip(&d->views, v);
    k.to_lamp = drawing_lamp(v);
    for (int i = 0; i < d->model->part_count && !result; i++)
        result = drawing_part(d, target, i, &k, &state, items);
    return result;
}

/* Draws what lies in the rows of a band; views stand apart, so each has a clip rectangle. */
static shade_result drawing_rows(const drawing *d, const shade_target *rows, int samples, int items)
{
    const shade_vec3 c = d->options->picture.background_color;
    shade_vec4 paper = shade_v4(1, 1, 1, 1);
    shade_result result;
    if (d->options->picture.background == PORTRAIT_PLAIN) paper = shade_v4(c.x, c.y, c.z, 1);
    result = shade_clear(rows, items ? shade_v4(0, 0, 0, 0) : paper, 1);
    for (int i = 0; i < d->views.count && !result; i++) {
        const view *v = &d->views.list[i];
        shade_target part = *rows;
        int top = v->y * samples, bottom = (v->y + v->height) * samples;
        int end = rows->clip_y + rows->clip_height;
        if (top < rows->clip_y) top = rows->clip_y;
        if (bottom > end) bottom = end;
        if (bottom <= top) continue;
        part.clip_x = v->x * samples;
        part.clip_width = v->width * samples;
        part.clip_y = top;
        part.clip_height = bottom - top;
        result = drawing_view(d, &part, v, items);
    }
    return result;
}

/* Piece 0 finds the edges, which takes longest; the others draw bands. */
static void drawing_band(void *data, int band)
{
    drawing *d = (drawing *)data;
    const shade_target item = { .width = d->seen.width,
                                .height = d->seen.height,
                                .color = d->seen.item,
                                .depth = d->seen.depth };
    shade_target rows;
    shade_result *result = &d->result[band];
    if (!band) {
        if (d->options->drawing.edges && outline_find(&d->outline, d->model))
            *result = SHADE_ERROR_CAPACITY;
        return;
    }
    rows = bands_rows(&d->sheet, band - 1, DRAWING_BANDS);
    *result = drawing_rows(d, &rows, d->options->picture.samples, 0);
    rows = bands_rows(&item, band - 1, DRAWING_BANDS);
    if (!*result) *result = drawing_rows(d, &rows, 1, 1);
}

/* Numbers of triangles as the library stores them: four bytes, of whatever order in a word */
static void drawing_items(seen *s)
{
    for (size_t i = 0; i < (size_t)s->width * (size_t)s->height; i++) {
        const unsigned char *b = (const unsigned char *)&s->item[i];
        s->item[i] =
            (uint32_t)b[0] | (uint32_t)b[1] << 8 | (uint32_t)b[2] << 16 | (uint32_t)b[3] << 24;
    }
}

/* ---- lines and text ------------------------------------------------------------------------- */

static void drawing_strokes(void *data, int i)
{
    drawing *d = (drawing *)data;
    chains c = { .outline = &d->outline, .view = &d->views.list[i], .seen = &d->seen };
    c.options = &d->options->drawing;
    c.unit = d->unit;
    c.claim = d->claim;
    c.claim_way = d->claim_way;
    c.out = &d->strokes[i];
    strokes_find(&c);
}

/* Non-zero: out of memory */
static int drawing_lines(drawing *d, pen *p)
{
    int failed = 0;
    bands_run(d->options->how.threads, d->views.count, drawing_strokes, d);
    for (int i = 0; i < d->views.count; i++) failed |= d->strokes[i].failed;
    for (int i = 0; i < d->views.count && !failed; i++) {
        const strokes *s = &d->strokes[i];
        pen_lines(p, s->dashed.v, s->dashed.count / 3, 1.3f * d->unit, shade_rgb(0x303030));
        pen_lines(p, s->whole.v, s->whole.count / 3, 2.2f * d->unit, p->ink);
    }
    return failed;
}

/* The name of a file without its folders */
static const char *drawing_base(const char *path)
{
    const char *slash = strrchr(path, '/');
    return slash && slash[1] ? slash + 1 : path;
}

static void drawing_text_about(const drawing *d, pen *p)
{
    const drawing_options *g = &d->options->drawing;
    const float margin = 18 * d->unit, low = (float)p->height - margin, u = d->unit;
    const float right = (float)p->width - margin, line = low - 1.9f * p->text;
    const float base = low - 0.6f * p->text, room = right - margin - 150 * u;
    const int parts = d->pieces.count - d->pieces.section;
    char text[200];
    int flat = 0;
    pen_line(p, margin, margin, right, margin, 1.2f * u, p->ink);
    pen_line(p, margin, low, right, low, 1.2f * u, p->ink);
    pen_line(p, margin, margin, margin, low, 1.2f * u, p->ink);
    pen_line(p, right, margin, right, low, 1.2f * u, p->ink);
    pen_line(p, margin, line, right, line, 1.2f * u, p->ink);
    pen_fit(p, margin + 12 * u, base, p->text, 0.45f * room, drawing_base(d->options->input));
    snprintf(text, sizeof text, "%.6g × %.6g × %.6g    %d triangles, %d part%s",
             d->high[0] - d->low[0], d->high[1] - d->low[1], d->high[2] - d->low[2],
             d->model->mesh.view.index_count / 3, parts, parts > 1 ? "s" : "");
    pen_fit(p, margin + 30 * u + 0.45f * room, base, 0.85f * p->text, 0.55f * room, text);
    for (int i = 0; i < d->views.count; i++) flat += d->views.list[i].kind != VIEW_ISO;
    if (flat > 1) annotate_symbol(p, right - 16 * u, low - 0.95f * p->text, g->first_angle);
    annotate_names(p, &d->views);
    if (g->dimensions) annotate_dimensions(p, &d->views, d->size);
    if (g->ids && d->pieces.count > 1)
        annotate_legend(p, &d->pieces, right - 0.2f * (float)p->width + 14 * u,
                        margin + 2.2f * p->text, 0.2f * (float)p->width - 26 * u,
                        line - 0.6f * p->text);
}

/* ---- files ---------------------------------------------------------------------------------- */

/* Writes depth, or the numbers of pieces; counts pixels on the way. */
static int drawing_save_map(drawing *d, const char *path, int depth)
{
    size_t pixels = (size_t)d->seen.width * (size_t)d->seen.height;
    uint16_t *value = (uint16_t *)malloc(pixels * sizeof *value);
    int failed;
    if (!value) return complain("out of memory");
    for (size_t i = 0; i < pixels; i++) {
        uint32_t item = d->seen.item[i];
        if (depth)
            value[i] =
                item ? (uint16_t)floorf(d->seen.depth[i] * (MAP_NOTHING - 1) + 0.5f) : MAP_NOTHING;
        else
            value[i] = item ? (uint16_t)(d->piece_of[item - 1] + 1) : 0;
    }
    failed = map_save(path, value, d->seen.width, d->seen.height);
    free(value);
    return failed;
}

static void drawing_count(drawing *d)
{
    for (int k = 0; k < d->views.count; k++) {
        const view *v = &d->views.list[k];
        for (int j = v->y; j < v->y + v->height; j++)
            for (int i = v->x; i < v->x + v->width; i++) {
                uint32_t item = d->seen.item[(size_t)j * (size_t)d->seen.width + (size_t)i];
                if (item) d->pixels[d->piece_of[item - 1] * VIEW_KINDS + k]++;
            }
    }
}

static int drawing_save_json(drawing *d)
{
    const drawing_options *g = &d->options->drawing;
    drawing_text t = { .input = d->options->input, .output = d->options->output, .options = g };
    t.views = &d->views;
    t.pieces = &d->pieces;
    t.up = option_axes[d->up];
    t.model_from_file = d->model_from_file;
    t.pixels = d->pixels;
    t.origin = d->model->origin;
    t.color = d->color;
    t.triangles = d->model->mesh.view.index_count / 3;
    memcpy(t.low, d->low, sizeof t.low);
    memcpy(t.high, d->high, sizeof t.high);
    drawing_count(d);
    return save_bytes(g->json, json_write, &t);
}

/* The maps first: whoever sees the sheet finds what belongs to it. */
static int drawing_save(drawing *d)
{
    const drawing_options *g = &d->options->drawing;
    shade_target picture = { .width = d->seen.width, .height = d->seen.height, .srgb = 1 };
    int failed = 0;
    guard_doing = "writing the drawing";
    if (g->depth) failed = drawing_save_map(d, g->depth, 1);
    if (g->id_map && !failed) failed = drawing_save_map(d, g->id_map, 0);
    if (g->json && !failed) failed = drawing_save_json(d);
    if (failed) return failed;
    picture.color = malloc((size_t)picture.width * (size_t)picture.height * 4);
    if (!picture.color) return complain("out of memory");
    shade_resolve(&picture, &d->sheet, d->options->picture.samples);
    failed = save_picture(&picture, d->options);
    free(picture.color);
    return failed;
}

/* ---- all of it ------------------------------------------------------------------------------ */

static void drawing_free(drawing *d)
{
    pieces_free(&d->pieces);
    outline_free(&d->outline);
    free(d->sheet.color);
    free(d->sheet.depth);
    free(d->seen.item);
    free(d->seen.depth);
    free(d->piece_of);
    free(d->color);
    free(d->pixels);
    free(d->claim);
    free(d->claim_way);
    for (int i = 0; i < VIEW_KINDS; i++) {
        free(d->strokes[i].whole.v);
        free(d->strokes[i].dashed.v);
    }
}

static pen drawing_pen(const options *o)
{
    pen p = { .ink = shade_rgb(0x101418), .grey = shade_rgb(0x5A626B) };
    int least;
    p.samples = o->picture.samples;
    p.width = o->picture.sized ? o->picture.width : 1600;
    p.height = o->picture.sized ? o->picture.height : 1200;
    least = p.width < p.height ? p.width : p.height;
    p.unit = fmaxf(0.6f, (float)least / 1200);
    p.text = 22 * p.unit;
    return p;
}

static int drawing_run(const options *o, model *m, mesh_progress *report, void *user)
{
    static drawing d;
    pen p = drawing_pen(o);
    int failed;
    d.options = o;
    d.model = m;
    d.unit = p.unit;
    guard_doing = "drawing";
    failed = drawing_prepare(&d) ? complain("out of memory") : drawing_lay_out(&d, &p);
    if (!failed && drawing_open(&d, &p)) failed = complain("out of memory");
    if (!failed) {
        bands_run_told(o->how.threads, DRAWING_BANDS + 1, drawing_band, &d, report, user);
        drawing_items(&d.seen);
        for (int i = 0; i <= DRAWING_BANDS && !p.result; i++) p.result = d.result[i];
        if (!p.result && o->drawing.edges && drawing_lines(&d, &p)) p.result = SHADE_ERROR_CAPACITY;
        if (!p.result) drawing_text_about(&d, &p);
        if (p.result)
            failed =
                complain("%s", p.result == SHADE_ERROR_CAPACITY ? "out of memory"
                                                                : shade_result_string(p.result));
    }
    if (!failed) failed = drawing_save(&d);
    drawing_free(&d);
    return failed;
}
#endif
