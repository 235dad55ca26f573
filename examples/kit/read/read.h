/* read.h - reads a model for all programs and makes it ready to be drawn: OBJ, STL, PLY, OFF, glTF
   and 3MF by own readers, other formats by assimp, the pictures on surfaces by stb_image.  A
   message names a library that is missing. */
#ifndef MODEL_READ_H
#define MODEL_READ_H

#include "../image/pictures.h"
#include "../scene/prepare.h"
#include "../scene/relief.h"
#include "../command/save.h"

/* Formats of our own readers, of which ast is FreeCAD's name for STL of text, and those that assimp
   reads as another reader does, which examples/programs/thumbnail/test/compared.txt names.  assimp
   is asked for no other. */
static const char *const model_by_kit[] = { "obj",  "stl", "ast", "ply", "off",
                                            "gltf", "glb", "3mf", NULL };
static const char *const model_by_assimp[] = { "3ds", "ac",  "acc",  "amf",  "ase", "b3d",
                                               "cob", "dae", "dxf",  "fbx",  "lwo", "lxo",
                                               "md2", "mdc", "ms3d", "ogex", "q3o", "smd",
                                               "x",   "zae", "zgl",  NULL };
#ifdef MODEL_ASSIMP
#include "assimp.h"
#endif

/* 1: the name is that of a model, by its ending. */
static inline int model_has_name(const char *name)
{
    const model_kind kind = model_kind_of(name);
    return option_among(model_by_kit, kind.text) || option_among(model_by_assimp, kind.text);
}

/* 1: the model of that path has been read from the file name, or has its pictures there. */
static inline int model_has_read(const model *m, const char *path, const char *name)
{
    if (save_same(path, name)) return 1;
    for (int i = 0; i < m->picture_count; i++)
        if (m->picture[i].path && save_same(m->picture[i].path, name)) return 1;
    return 0;
}

/* The first bytes of a file that has any; a folder opens, but cannot be read. */
static int check_file(const char *path, const model_request *q, unsigned char *head, size_t *size)
{
    mesh_reader r = mesh_about(path, q->error, q->error_size);
    FILE *file = model_open_file(&r, path);
    int failed;
    if (!file) return 1;
    *size = fread(head, 1, *size, file);
    failed = ferror(file) != 0;
    if (failed)
        mesh_fail(&r, "%s", errno ? strerror(errno) : "cannot be read");
    else if (!*size)
        failed = mesh_fail(&r, "the file is empty");
    fclose(file);
    return failed;
}

/* 1: the file is for our own readers, by its extension or, where it has none, by its contents. */
static int is_ours(model_kind kind, const unsigned char *head, size_t size)
{
    return !kind.text[0] || option_among(model_by_kit, kind.text) || mesh_is_ply("", head, size) ||
           mesh_is_gltf("a.a", head, size);
}

#ifdef MODEL_ASSIMP
/* Reads an AMF that is a ZIP archive, as its standard has it and FreeCAD and PrusaSlicer write it:
   assimp does not unpack. */
static int read_packed(const char *path, model *m, const model_request *q)
{
    static const zip none;
    mesh_reader r = mesh_about(path, q->error, q->error_size);
    unsigned char *bytes = NULL, *own = NULL;
    const zip_entry *found = NULL;
    zip z = none;
    size_t size = 0;
    int failed = model_load(&r, path, MODEL_BYTES, &bytes, &size);
    r = mesh_of(bytes, size, path, q->error, q->error_size);
    failed = failed || zip_open(&r, &z);
    z.inflate = model_inflate;
    for (size_t i = 0; i < z.count && !failed && !found; i++) {
        zip_entry end = z.entry[i];
        end.name += end.length > 4 ? end.length - 4 : 0;
        end.length = 4;
        if (z.entry[i].length > 4 && zip_is(&end, ".amf")) found = &z.entry[i];
    }
    if (!failed && !found) failed = mesh_fail(&r, "there is no .amf in the archive");
    if (!failed) own = zip_unpack(&r, &z, found);
    failed = failed || !own || assimp_read(path, own, (size_t)found->size, m, q);
    free(own);
    free(z.entry);
    free(bytes);
    return failed;
}
#endif

static int read_other(const char *path, model_kind kind, const unsigned char *head, model *m,
                      const model_request *q)
{
    mesh_reader r = mesh_about(path, q->error, q->error_size);
    if (!option_among(model_by_assimp, kind.text))
        return mesh_fail(&r, ".%s files are not read", kind.text);
#ifdef MODEL_ASSIMP
    if (!strcmp(kind.text, "amf") && !memcmp(head, "PK\3\4", 4)) return read_packed(path, m, q);
    return assimp_read(path, NULL, 0, m, q);
#else
    (void)m, (void)head;
    return mesh_fail(&r,
                     ".%s files need a %s built with assimp (libassimp-dev); this one reads OBJ, "
                     "STL, PLY, OFF, glTF and 3MF",
                     kind.text, program_name);
#endif
}

/* A file that makes a surface wholly invisible mostly means the opposite. */
static void show_invisible(model *m)
{
    for (int i = 0; i < m->surface_count; i++)
        if (m->surface[i].transparency >= 1) m->surface[i].transparency = 0;
}

#ifdef MODEL_ASSIMP
/* 1: the first bytes tell that a file is for our own readers: what they refuse, assimp does not
   draw. */
static int is_certain(const unsigned char *head, size_t size)
{
    return mesh_is_gltf("", head, size) || mesh_is_off("", head, size) ||
           mesh_is_threemf("", head, size) || mesh_is_ply("", head, size) ||
           mesh_is_stl("", head, size);
}
#endif

/* Reads a model from standard input, its format by the contents; files that it names, from the
   folder of work. */
static const char model_input[] = "standard input";
static int read_input(model *m, const model_request *q)
{
    mesh_reader r = mesh_about(model_input, q->error, q->error_size);
    unsigned char *bytes = NULL;
    size_t size = 0;
    int failed;
    errno = 0;
    if (model_load_from(&r, stdin, MODEL_BYTES, &bytes, &size)) return 1;
    failed = size ? model_read_memory(bytes, size, model_input, m, q)
                  : mesh_fail(&r, "the file is empty");
#ifdef MODEL_ASSIMP
    if (failed && size && !is_certain(bytes, size)) {
        const model_request silent = { .most = q->most };
        failed = assimp_read(model_input, bytes, size, m, &silent);
    }
#endif
    free(bytes);
    m->beside = model_load_file;
    if (!failed) model_read_libraries(model_input, m);
    return failed;
}

static int read_path(const char *path, model *m, const model_request *q)
{
    unsigned char head[1024] = { 0 };
    size_t size = sizeof head;
    model_kind kind = model_kind_of(path);
    int failed = check_file(path, q, head, &size);
    if (failed) return failed;
    if (is_ours(kind, head, size))
        failed = model_read_file(path, m, q);
    else
        failed = read_other(path, kind, head, m, q);
#ifdef MODEL_ASSIMP
    if (failed && !kind.text[0] && !is_certain(head, size)) { /* assimp may know the contents */
        const model_request silent = { .most = q->most };
        failed = assimp_read(path, NULL, 0, m, &silent);
    }
#endif
    return failed;
}

/* Whether two corners of a triangle lie at one place, so that it cannot be seen */
static int model_is_hidden(const model *m, const uint32_t *corner)
{
    for (int k = 0; k < 3; k++) {
        const float *p = m->mesh.positions + 3 * (size_t)corner[k];
        const float *q = m->mesh.positions + 3 * (size_t)corner[(k + 1) % 3];
        if (p[0] == q[0] && p[1] == q[1] && p[2] == q[2]) return 1;
    }
    return 0;
}

/* Drops vertices that no triangle has that can be seen: pictures and drawings show those alone.
   Other triangles stay, and get one that is left for what they lose.  1: out of memory. */
static int model_drop_unused(model *m)
{
    const shade_mesh *v = &m->mesh.view;
    uint32_t last = 0, *corner = m->mesh.indices;
    char *used = (char *)calloc((size_t)v->vertex_count + 1, 1);
    int count = 0, first = 0, failed = !used;
    for (int i = 0; i < v->index_count && !failed; i += 3)
        if (!model_is_hidden(m, corner + i))
            used[corner[i]] = used[corner[i + 1]] = used[corner[i + 2]] = 1;
    while (first < v->vertex_count && !failed && !used[first]) first++;
    for (int i = 0; i < v->index_count && !failed && first < v->vertex_count; i += 3)
        if (!used[corner[i]] || !used[corner[i + 1]] || !used[corner[i + 2]])
            corner[i] = corner[i + 1] = corner[i + 2] = (uint32_t)first;
    for (int i = 0; i < v->index_count && !failed; i++) used[corner[i]] = 1;
    for (int i = 0; i < v->vertex_count && !failed; i++) count += used[i];
    free(used);
    if (failed || count == v->vertex_count) return failed;
    failed = mesh_renumber(&m->mesh);
    for (int i = 0; i < v->index_count && !failed; i++)
        if (corner[i] > last) last = corner[i];
    mesh_link(&m->mesh, (int)last + 1, v->index_count);
    return failed;
}

static int model_read(const char *path, model *m, const model_request *q)
{
    static const model empty;
    int failed;
    *m = empty;
    failed = path == model_input ? read_input(m, q) : read_path(path, m, q);
    if (!failed && model_drop_unused(m)) {
        mesh_reader r = mesh_about(path, q->error, q->error_size);
        model_free(m);
        failed = mesh_fail(&r, "out of memory");
    }
    if (!failed) {
        show_invisible(m);
        read_pictures(m, path, q->outside);
    }
    return failed;
}

/* ---- for the programs ------------------------------------------------------------------------ */

/* 1: the message says that memory was out. */
static int ran_out(const char *error)
{
    static const char words[] = ": out of memory";
    const size_t n = strlen(error), most = sizeof words - 1;
    return n >= most && !strcmp(error + n - most, words);
}

/* 1: a line has a length, or a triangle an area.  In double, where no product of floats
   overflows. */
static int model_shows(const model *m)
{
    for (size_t i = 0; i < m->line_count; i++)
        if (memcmp(&m->line[i].end[0], &m->line[i].end[1], sizeof m->line->end[0]) != 0) return 1;
    for (int i = 0; i < m->mesh.view.index_count; i += 3) {
        const uint32_t *corner = m->mesh.indices + i;
        double e[2][3];
        for (int k = 0; k < 6; k++) {
            const float *p = m->mesh.positions + k % 3;
            e[k / 3][k % 3] =
                (double)p[3 * (size_t)corner[1 + k / 3]] - (double)p[3 * (size_t)corner[0]];
        }
        for (int k = 0, l = 1; k < 3; k++, l = (k + 1) % 3)
            if (e[0][k] * e[1][l] - e[0][l] * e[1][k] != 0) return 1;
    }
    return 0;
}

/* Returns 1 with a line on stderr where nothing of a model can be seen. */
static int model_blank(const model *m)
{
    if (model_shows(m)) return 0;
    return complain("%s: no triangle of it has an area, so nothing of it can be seen",
                    m->path ? m->path : "the model");
}

/* Reads the model that the options ask for; - is standard input.  Returns 1 with a line on
   stderr. */
static int model_open(const char *path, const model_options *o, model *m, mesh_progress *progress,
                      void *user)
{
    char error[400] = "";
    const model_request q = { .error = error,
                              .error_size = sizeof error,
                              .progress = progress,
                              .user = user,
                              .most = (size_t)o->max_triangles,
                              .lines = !o->no_lines,
                              .outside = o->outside };
    int failed;
    if (!strcmp(path, "-")) path = model_input;
    guard_doing = "reading ";
    guard_reading(path);
    failed = model_read(path, m, &q);
    guard_reading(NULL);
    guard_doing = "ending";
    if (failed) return complain("%s%s", error, ran_out(error) ? "; see --max-memory" : "");
    if (m->warning[0] && !o->quiet) complain("%s", m->warning);
    m->path = path;
    return 0;
}

/* The upright axis, 0 .. 5: that of the options or of the format; of a picture where neither says,
   a guess.  Drawings keep to habit, so that their front is the same for all parts. */
static int model_up(const model *m, const model_options *o, int picture)
{
    const int usual = m->z_up ? 2 : 1;
    int up;
    if (m->up) return m->up - 1;
    if (o->up >= 0) return o->up;
    if (m->up_told || !picture) return usual;
    up = stand_guess(&m->mesh, usual);
    if (o->verbose && !o->quiet)
        complain("the format does not say which axis is up: %s, %s", option_axes[up],
                 up == usual ? "as usual" : "by the feet on which it stands");
    return up;
}

/* Appends the ends of the lines to the vertices, which no triangle has: they stand, fit and fall as
   these do.  1: out of memory */
static int model_join_lines(model *m)
{
    owned_mesh *mesh = &m->mesh;
    const size_t from = (size_t)mesh->view.vertex_count, n = 2 * m->line_count;
    float **const all[4] = { &mesh->positions, &mesh->normals, &mesh->colors, &mesh->texcoords };
    if (!n) return 0;
    if (from + n > INT_MAX / 3) return 1;
    for (int k = 0; k < 4; k++) {
        const size_t width = k < 3 ? 3 : 2;
        float *grown = NULL;
        if (k < 2 || *all[k]) grown = (float *)realloc(*all[k], (from + n) * width * sizeof *grown);
        if (!grown && (k < 2 || *all[k])) return 1;
        if (grown) memset(grown + from * width, 0, n * width * sizeof *grown);
        *all[k] = grown;
    }
    for (size_t i = 0; i < n; i++)
        memcpy(mesh->positions + 3 * (from + i), &m->line[i / 2].end[i % 2], 3 * sizeof(float));
    mesh_link(mesh, (int)(from + n), mesh->view.index_count);
    return 0;
}

/* Takes them from there, to where they have come. */
static void model_part_lines(model *m)
{
    const size_t n = 2 * m->line_count, from = (size_t)m->mesh.view.vertex_count - n;
    if (!n) return;
    for (size_t i = 0; i < n; i++)
        memcpy(&m->line[i / 2].end[i % 2], m->mesh.positions + 3 * (from + i), 3 * sizeof(float));
    mesh_link(&m->mesh, (int)from, m->mesh.view.index_count);
}

/* The colour of lines of which the file says nothing: white, which the colours of vertices
   multiply, or that of the options.  Thin lines of clay would hardly stand out from paper: they
   are darker. */
static shade_vec3 model_ink(const model *m, const model_options *o)
{
    for (size_t i = 0; i < m->line_count && !o->plain; i++)
        if (m->line[i].color.x * m->line[i].color.y * m->line[i].color.z < 1)
            return shade_v3(1, 1, 1);
    return shade_scale(o->material.diffuse, o->plain ? 1 : 0.3f);
}

/* The colour of a line: that of its surface, or ink */
static shade_vec4 model_line_color(const model *m, const model_options *o, const model_line *line,
                                   shade_vec3 ink)
{
    const model_surface *s = line->surface >= 0 ? &m->surface[line->surface] : NULL;
    const int told = s && s->set && !o->plain;
    shade_vec3 color =
        told ? shade_scale(s->material.diffuse, 1 / (1 - MODEL_METAL_DARK * s->metal)) : ink;
    if (!o->plain) color = shade_mul(color, line->color);
    return shade_v4(color.x, color.y, color.z, told ? 1 - s->transparency : 1);
}

/* Makes the lines ready to be drawn.  1: out of memory */
static int model_wire(model *m, const model_options *o)
{
    const size_t n = m->line_count;
    const shade_vec3 ink = model_ink(m, o);
    wires *w = &m->wires;
    if (!n) return 0;
    w->point = (shade_vec3 *)malloc(2 * n * sizeof *w->point);
    w->color = (shade_vec4 *)malloc(n * sizeof *w->color);
    if (!w->point || !w->color) return 1;
    w->points = 2 * (int)n;
    for (size_t i = 0; i < n; i++) {
        memcpy(w->point + 2 * i, m->line[i].end, sizeof m->line->end);
        w->color[i] = model_line_color(m, o, &m->line[i], ink);
    }
    return wires_find_runs(w) || model_join_lines(m);
}

/* Makes a model ready for a picture: upright, turned, with normals and chunks.  Returns 1 with a
   line on stderr, also where a picture would show nothing. */
static int model_prepare(model *m, const model_options *o, float turn)
{
    const int flat = o->shading == SHADE_SHADING_PER_FACE;
    int failed = 0;
    if (model_blank(m)) return 1;
    if (model_join_lines(m)) return complain("out of memory");
    relief_prepare(m, mesh_stand(&m->mesh, model_up(m, o, 1), turn));
    model_part_lines(m);
    if (m->mesh.view.index_count && (flat || !m->normals_given))
        failed = mesh_crease(&m->mesh, flat, CREASE_40_DEGREES);
    failed = failed || mesh_chunk_parts(m) || model_wire(m, o);
    return failed ? complain("out of memory") : 0;
}
#endif
