/* threemf.h - reads 3MF, a ZIP archive of XML: objects, their components and what is built of them,
   in files of their own too (production extension), base materials, groups of colours, of places in
   textures, of mixtures and of several at once (materials extension).

   An extension that a file requires and that is not in threemf_extensions as read is refused by its
   name; what else is left out is told. */
#ifndef MODEL_THREEMF_H
#define MODEL_THREEMF_H

#include "gather.h"
#include "known.h"
#include "xml.h"

enum { THREEMF_TRIANGLES = 20000000, THREEMF_INSTANCES = 100000, THREEMF_DEPTH = 100 };

enum { THREEMF_CORE, THREEMF_MATERIALS, THREEMF_PRODUCTION };
static const char *const threemf_spaces[] = {
    "http://schemas.microsoft.com/3dmanufacturing/core/2015/02",
    "http://schemas.microsoft.com/3dmanufacturing/material/2015/02",
    "http://schemas.microsoft.com/3dmanufacturing/production/2015/06", NULL
};
static const known_name threemf_extensions[] = {
    { "http://schemas.microsoft.com/3dmanufacturing/core/2015/02", KNOWN_DRAWN },
    { "http://schemas.microsoft.com/3dmanufacturing/material/2015/02", KNOWN_DRAWN },
    { "http://schemas.microsoft.com/3dmanufacturing/production/2015/06", KNOWN_DRAWN },
    { "http://schemas.microsoft.com/3dmanufacturing/slice/2015/07", KNOWN_SILENT },
    { "http://schemas.microsoft.com/3dmanufacturing/trianglesets/2021/07", KNOWN_SILENT },
    { "http://schemas.bambulab.com/package/2021", KNOWN_SILENT },
    { "http://schemas.slic3r.org/3mf/2017/06", KNOWN_SILENT },
    { "http://schemas.microsoft.com/3dmanufacturing/beamlattice/2017/02", KNOWN_TOLD },
    { "http://schemas.microsoft.com/3dmanufacturing/beamlattice/balls/2020/07", KNOWN_TOLD },
    { "http://schemas.microsoft.com/3dmanufacturing/securecontent/2019/04", KNOWN_TOLD },
    { "http://schemas.3mf.io/3dmanufacturing/volumetric/2022/01", KNOWN_TOLD },
    { "http://schemas.3mf.io/3dmanufacturing/booleanoperations/2023/07", KNOWN_TOLD },
    { "http://schemas.3mf.io/3dmanufacturing/displacement/2023/10", KNOWN_TOLD },
    { "http://schemas.3mf.io/3dmanufacturing/implicit/2023/12", KNOWN_TOLD },
    { NULL, KNOWN_TOLD }
};

/* Elements of the core and of the materials extension */
static const known_name threemf_elements[] = {
    { "model", KNOWN_DRAWN },
    { "resources", KNOWN_DRAWN },
    { "basematerials", KNOWN_DRAWN },
    { "base", KNOWN_DRAWN },
    { "object", KNOWN_DRAWN },
    { "mesh", KNOWN_DRAWN },
    { "vertices", KNOWN_DRAWN },
    { "vertex", KNOWN_DRAWN },
    { "triangles", KNOWN_DRAWN },
    { "triangle", KNOWN_DRAWN },
    { "components", KNOWN_DRAWN },
    { "component", KNOWN_DRAWN },
    { "build", KNOWN_DRAWN },
    { "item", KNOWN_DRAWN },
    { "texture2d", KNOWN_DRAWN },
    { "texture2dgroup", KNOWN_DRAWN },
    { "tex2coord", KNOWN_DRAWN },
    { "colorgroup", KNOWN_DRAWN },
    { "color", KNOWN_DRAWN },
    { "compositematerials", KNOWN_DRAWN },
    { "composite", KNOWN_DRAWN },
    { "multiproperties", KNOWN_DRAWN },
    { "multi", KNOWN_DRAWN },
    { "metadata", KNOWN_SILENT },
    { "metadatagroup", KNOWN_SILENT },
    { "pbspeculardisplayproperties", KNOWN_TOLD },
    { "pbmetallicdisplayproperties", KNOWN_TOLD },
    { "pbspeculartexturedisplayproperties", KNOWN_TOLD },
    { "pbmetallictexturedisplayproperties", KNOWN_TOLD },
    { "translucentdisplayproperties", KNOWN_TOLD },
    { NULL, KNOWN_TOLD },
};

/* Attributes of triangles and vertices, those of slicers too */
static const known_name threemf_attributes[] = {
    { "x", KNOWN_DRAWN },
    { "y", KNOWN_DRAWN },
    { "z", KNOWN_DRAWN },
    { "v1", KNOWN_DRAWN },
    { "v2", KNOWN_DRAWN },
    { "v3", KNOWN_DRAWN },
    { "p1", KNOWN_DRAWN },
    { "p2", KNOWN_DRAWN },
    { "p3", KNOWN_DRAWN },
    { "pid", KNOWN_DRAWN },
    { "paint_supports", KNOWN_SILENT },
    { "paint_seam", KNOWN_SILENT },
    { "paint_fuzzy_skin", KNOWN_SILENT },
    { "face_property", KNOWN_SILENT },
    { "custom_supports", KNOWN_SILENT },
    { "custom_seam", KNOWN_SILENT },
    { "fuzzy_skin", KNOWN_SILENT },
    { "paint_color", KNOWN_TOLD }, /* a tree of parts of the triangle, each with an extruder */
    { "mmu_segmentation", KNOWN_TOLD },
    { NULL, KNOWN_TOLD }
};

/* What objects are for: not all of them are what is made. */
static const known_name threemf_types[] = {
    { "model", KNOWN_DRAWN },       { "surface", KNOWN_DRAWN }, { "support", KNOWN_TOLD },
    { "solidsupport", KNOWN_TOLD }, { "other", KNOWN_TOLD },    { NULL, KNOWN_TOLD }
};

/* ---- what the files have --------------------------------------------------------------------- */

typedef struct threemf_array {
    void *v;
    size_t count, room;
} threemf_array;

typedef struct threemf_file {
    char *path;
    double unit; /* in metres */
    size_t objects;
} threemf_file;

typedef struct threemf_use { /* of an object, by a component or an item */
    char *path;              /* NULL: in the same file */
    uint32_t object;
    gather_matrix at;
} threemf_use;

typedef struct threemf_object {
    char *name;
    uint32_t file, pid, pindex;
    size_t vertex, vertices, face, faces, use, uses;
    int ready, part, aside; /* ready: its corners are there; part: of another object; aside: it is
                               not drawn */
    size_t corner, corners, index;
} threemf_object;

typedef struct threemf_face {
    uint32_t v[3], pid, p[3];
} threemf_face;

/* Of colours: red, green, blue in linear light, and alpha; of places: u and v; of mixtures: the
   parts; of several at once: the number of one in each group */
enum { THREEMF_COLORS, THREEMF_PLACES, THREEMF_MIXTURES, THREEMF_LAYERS };
typedef struct threemf_group {
    int kind;
    size_t first, count;      /* of its properties */
    size_t list, list_count;  /* of its own numbers: of materials, or of groups */
    uint32_t other, multiply; /* its texture or its materials; layers that multiply, by bits */
} threemf_group;

typedef struct threemf_run { /* of the numbers */
    size_t first, count;
} threemf_run;

typedef struct threemf_texture {
    char *path;
    char kind[24];
    int wrap[2], picture, tried;
} threemf_texture;

typedef struct threemf_corner {
    uint32_t vertex;
    shade_vec3 color;
    shade_vec2 uv;
} threemf_corner;

typedef struct threemf {
    mesh_reader *r;
    model *m;
    zip z;
    threemf_array files, objects, vertices, faces, uses, items, groups, properties, numbers;
    threemf_array textures, corners, indices, surfaces;
    mesh_set object_of, group_of, texture_of, surface_of; /* by file and number */
    gather all;
    int counting, instances, depth;
    double triangles, placed;
} threemf;

static inline int threemf_out(threemf *t) { return mesh_fail(t->r, "out of memory"); }

/* A new element of an array, all zero; NULL: out of memory */
static inline void *threemf_add(threemf *t, threemf_array *a, size_t size)
{
    void *grown = mesh_grow(a->v, a->count, &a->room, size);
    if (!grown) {
        threemf_out(t);
        return NULL;
    }
    a->v = grown;
    return memset((char *)grown + size * a->count++, 0, size);
}

static inline threemf_file *threemf_file_at(const threemf *t, size_t i)
{
    return (threemf_file *)t->files.v + i;
}
static inline threemf_object *threemf_object_at(const threemf *t, size_t i)
{
    return (threemf_object *)t->objects.v + i;
}
static inline threemf_face *threemf_face_at(const threemf *t, size_t i)
{
    return (threemf_face *)t->faces.v + i;
}
static inline threemf_use *threemf_use_at(const threemf *t, size_t i)
{
    return (threemf_use *)t->uses.v + i;
}
static inline double threemf_number_at(const threemf *t, size_t i)
{
    return ((const double *)t->numbers.v)[i];
}

static inline mesh_triple threemf_key(size_t file, uint32_t number)
{
    const mesh_triple key = { { (uint32_t)file, number, 0 } };
    return key;
}

/* Notes that the last of an array of resources has the number in id. */
static inline int threemf_named(threemf *t, xml *x, mesh_set *set, size_t count)
{
    uint32_t id, number;
    if (xml_whole(x, "id", UINT32_MAX, &id)) return 1;
    if (id == UINT32_MAX) return xml_fail(x, "id", "is missing");
    if (mesh_set_add(set, threemf_key(t->files.count - 1, id), &number)) return threemf_out(t);
    return number == count - 1 ? 0 : xml_fail(x, "id", "is that of another one");
}

/* ---- properties ------------------------------------------------------------------------------ */

/* Appends the numbers of an attribute and returns how many they are; -1: failed */
static inline int threemf_numbers(threemf *t, xml *x, const char *name)
{
    xml_text value = xml_value(x, XML_NO_SPACE, name);
    double number;
    int count = 0, got;
    if (!value.at) return 0;
    while ((got = xml_number(&value, &number)) > 0) {
        double *out = (double *)threemf_add(t, &t->numbers, sizeof *out);
        if (!out || ++count > 1000) return -1;
        *out = number >= 0 && number < 1e9 ? number : 0;
    }
    if (got < 0) xml_fail(x, name, "is no list of numbers");
    return got < 0 ? -1 : count;
}

/* Reads #RRGGBB or #RRGGBBAA.  0: it is none of them. */
static inline int threemf_hex(xml_text value, double c[4])
{
    if ((value.size != 7 && value.size != 9) || *value.at != '#') return 0;
    for (size_t i = 1; i < value.size; i += 2) {
        const long long bits = mesh_hex(value.at + i, value.at + value.size, 2);
        if (bits < 0) return 0;
        c[i / 2] = (double)bits / 255;
    }
    return 1;
}

/* A colour; white where there is none, and where it cannot be read, with a word: the geometry of
   such a file is whole. */
static inline int threemf_color(threemf *t, xml *x, const char *name)
{
    const xml_text value = xml_value(x, XML_NO_SPACE, name);
    double c[4] = { 1, 1, 1, 1 };
    shade_vec3 linear;
    if (value.at && !threemf_hex(value, c)) {
        char text[80];
        c[0] = c[1] = c[2] = c[3] = 1;
        snprintf(text, sizeof text, "%s \"%.*s\" is no colour: it counts as white", name,
                 value.size < 20 ? (int)value.size : 20, (const char *)value.at);
        model_warn(t->m, t->r->name, text);
    }
    linear = shade_linear_from_srgb(shade_v3((float)c[0], (float)c[1], (float)c[2]));
    c[0] = (double)linear.x;
    c[1] = (double)linear.y;
    c[2] = (double)linear.z;
    for (int k = 0; k < 4; k++) {
        double *out = (double *)threemf_add(t, &t->numbers, sizeof *out);
        if (!out) return 1;
        *out = c[k];
    }
    return 0;
}

static inline int threemf_property(threemf *t, xml *x, threemf_group *g)
{
    threemf_run *run = (threemf_run *)threemf_add(t, &t->properties, sizeof *run);
    double uv[2], *out;
    int failed = !run;
    if (failed) return 1;
    run->first = t->numbers.count;
    g->count++;
    if (g->kind == THREEMF_COLORS)
        failed = threemf_color(t, x, x->space == THREEMF_CORE ? "displaycolor" : "color");
    else if (g->kind == THREEMF_MIXTURES)
        failed = threemf_numbers(t, x, "values") < 0;
    else if (g->kind == THREEMF_LAYERS)
        failed = threemf_numbers(t, x, "pindices") < 0;
    else
        failed = xml_double(x, "u", &uv[0]) || xml_double(x, "v", &uv[1]);
    for (int k = 0; k < 2 && g->kind == THREEMF_PLACES && !failed; k++) {
        out = (double *)threemf_add(t, &t->numbers, sizeof *out);
        failed = !out;
        if (out) *out = uv[k];
    }
    run->count = t->numbers.count - run->first;
    return failed;
}

/* mix or multiply, for each layer but the first */
static inline uint32_t threemf_methods(const xml *x)
{
    const xml_text value = xml_value(x, XML_NO_SPACE, "blendmethods");
    uint32_t bits = 0, layer = 1;
    for (size_t i = 0; i < value.size && layer < 32; i++) {
        if (mesh_is_blank(value.at[i]) || (i && !mesh_is_blank(value.at[i - 1]))) continue;
        if (value.size - i >= 8 && !memcmp(value.at + i, "multiply", 8)) bits |= 1u << layer;
        layer++;
    }
    return bits;
}

/* Tells of an element that is not read here. */
static inline int threemf_tell(threemf *t, xml *x)
{
    const xml_text uri = xml_uri(x, x->prefix), name = x->space == XML_OTHER ? uri : x->name;
    const known_what what = known_find(
        x->space == XML_OTHER ? threemf_extensions : threemf_elements, name.at, name.size);
    if (x->space == THREEMF_PRODUCTION) return 0;
    return known_take(t->r, t->m, what, 0, name.at, name.size);
}

typedef struct threemf_kind {
    const char *group, *property, *other, *list;
    int space, kind;
} threemf_kind;
static const threemf_kind threemf_kinds[] = {
    { "basematerials", "base", "", "", THREEMF_CORE, THREEMF_COLORS },
    { "colorgroup", "color", "", "", THREEMF_MATERIALS, THREEMF_COLORS },
    { "texture2dgroup", "tex2coord", "texid", "", THREEMF_MATERIALS, THREEMF_PLACES },
    { "compositematerials", "composite", "matid", "matindices", THREEMF_MATERIALS,
      THREEMF_MIXTURES },
    { "multiproperties", "multi", "", "pids", THREEMF_MATERIALS, THREEMF_LAYERS }
};

static inline int threemf_read_group(threemf *t, xml *x, const threemf_kind *kind)
{
    threemf_group *g = (threemf_group *)threemf_add(t, &t->groups, sizeof *g);
    const int depth = x->depth;
    int count;
    if (!g) return 1;
    if (threemf_named(t, x, &t->group_of, t->groups.count)) return 1;
    g->kind = kind->kind;
    g->multiply = threemf_methods(x);
    if (xml_whole(x, kind->other, UINT32_MAX, &g->other)) return 1;
    g->list = t->numbers.count;
    count = threemf_numbers(t, x, kind->list);
    if (count < 0) return 1;
    g->list_count = (size_t)count;
    g->first = t->properties.count;
    while (xml_inside(x, depth)) {
        if (xml_is(x, kind->space, kind->property) ? threemf_property(t, x, g) : threemf_tell(t, x))
            return 1;
    }
    return x->failed;
}

static inline int threemf_wrap(const xml *x, const char *name)
{
    const xml_text value = xml_value(x, XML_NO_SPACE, name);
    return value.at && xml_equals(value, "mirror")  ? SHADE_WRAP_MIRROR
           : value.at && !xml_equals(value, "wrap") ? SHADE_WRAP_CLAMP
                                                    : SHADE_WRAP_REPEAT;
}

static inline int threemf_read_texture(threemf *t, xml *x)
{
    threemf_texture *texture = (threemf_texture *)threemf_add(t, &t->textures, sizeof *texture);
    const xml_text kind = xml_value(x, XML_NO_SPACE, "contenttype");
    if (!texture || threemf_named(t, x, &t->texture_of, t->textures.count)) return 1;
    texture->picture = -1;
    texture->wrap[0] = threemf_wrap(x, "tilestyleu");
    texture->wrap[1] = threemf_wrap(x, "tilestylev");
    if (kind.size < sizeof texture->kind)
        memcpy(texture->kind, kind.at ? kind.at : x->name.at, kind.size);
    texture->path = xml_copy(xml_value(x, XML_NO_SPACE, "path"));
    if (xml_equals(xml_value(x, XML_NO_SPACE, "filter"), "nearest") &&
        known_take(t->r, t->m, KNOWN_TOLD, 0, "filter nearest", 14))
        return 1;
    return texture->path ? 0 : threemf_out(t);
}

/* ---- objects --------------------------------------------------------------------------------- */

static inline int threemf_transform(xml *x, gather_matrix *out)
{
    static const gather_matrix one = { { 1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1 } };
    xml_text value = xml_value(x, XML_NO_SPACE, "transform");
    double number;
    int got = 1;
    *out = one;
    if (!value.at) return 0;
    for (int i = 0; i < 12; i++) {
        got = xml_number(&value, &number);
        if (got < 1 || !(fabs(number) < 1e30))
            return xml_fail(x, "transform", "must be 12 numbers");
        out->at[4 * (i / 3) + i % 3] = number;
    }
    return xml_number(&value, &number) ? xml_fail(x, "transform", "must be 12 numbers") : 0;
}

static inline int threemf_read_use(threemf *t, xml *x, threemf_array *uses)
{
    threemf_use *use = (threemf_use *)threemf_add(t, uses, sizeof *use);
    const xml_text path = xml_value(x, THREEMF_PRODUCTION, "path");
    if (!use || threemf_transform(x, &use->at)) return 1;
    if (xml_whole(x, "objectid", UINT32_MAX, &use->object)) return 1;
    if (use->object == UINT32_MAX) return xml_fail(x, "objectid", "is missing");
    if (xml_equals(xml_value(x, XML_NO_SPACE, "printable"), "0"))
        model_warn(t->m, t->r->name, "it has objects that are not printed, drawn like others");
    if (!path.size) return 0;
    use->path = xml_copy(path);
    return use->path ? 0 : threemf_out(t);
}

/* Tells of attributes that are neither drawn nor silent. */
static inline int threemf_tell_attributes(threemf *t, const xml *x)
{
    for (int i = 0; i < x->attributes; i++) {
        const xml_attribute *a = &x->attribute[i];
        known_what what;
        if (a->name.size < 3 || xml_equals(a->prefix, "xmlns") || xml_equals(a->name, "xmlns"))
            continue;
        what = known_find(threemf_attributes, a->name.at, a->name.size);
        if (known_take(t->r, t->m, what, 0, a->name.at, a->name.size)) return 1;
    }
    return 0;
}

static inline int threemf_read_vertex(threemf *t, xml *x)
{
    double p[3], *out;
    if (t->vertices.count % MESH_TELL == 0 && mesh_stopped(t->r)) return 1;
    if (xml_double(x, "x", &p[0]) || xml_double(x, "y", &p[1]) || xml_double(x, "z", &p[2]))
        return 1;
    out = (double *)threemf_add(t, &t->vertices, 3 * sizeof *out);
    if (out) memcpy(out, p, sizeof p);
    return !out;
}

static inline int threemf_read_face(threemf *t, xml *x, const threemf_object *object)
{
    static const char *const names[3] = { "v1", "v2", "v3" };
    threemf_face face;
    threemf_face *out;
    if (t->faces.count % MESH_TELL == 0 && mesh_stopped(t->r)) return 1;
    for (int k = 0; k < 3; k++) {
        if (xml_whole(x, names[k], UINT32_MAX, &face.v[k])) return 1;
        if (face.v[k] == UINT32_MAX) return xml_fail(x, names[k], "is missing");
    }
    if (xml_whole(x, "pid", object->pid, &face.pid) ||
        xml_whole(x, "p1", object->pindex, &face.p[0]) ||
        xml_whole(x, "p2", face.p[0], &face.p[1]) || xml_whole(x, "p3", face.p[0], &face.p[2]))
        return 1;
    if (x->attributes > 3 && threemf_tell_attributes(t, x)) return 1;
    if (t->faces.count == THREEMF_TRIANGLES)
        return mesh_fail(t->r, "more than %d triangles", THREEMF_TRIANGLES);
    out = (threemf_face *)threemf_add(t, &t->faces, sizeof *out);
    if (out) *out = face;
    return !out;
}

/* The triangles of a mesh count its own vertices: some writers put several into one object. */
static inline int threemf_number(threemf *t, xml *x, const threemf_object *object, size_t vertex,
                                 size_t face)
{
    const size_t vertices = t->vertices.count - vertex;
    for (size_t i = 3 * face; i < 3 * t->faces.count; i++) {
        uint32_t *v = &threemf_face_at(t, i / 3)->v[i % 3];
        if (*v >= vertices)
            return mesh_fail(x->r, "a triangle has a vertex that is not there: there are %lu",
                             (unsigned long)vertices);
        *v += (uint32_t)(vertex - object->vertex);
    }
    return 0;
}

/* vertices and triangles; components */
static inline int threemf_read_part(threemf *t, xml *x, const threemf_object *object)
{
    const size_t vertex = t->vertices.count, face = t->faces.count;
    const int depth = x->depth;
    int list, failed = 0;
    while (!failed && xml_inside(x, depth)) {
        if (xml_is(x, THREEMF_CORE, "component")) {
            failed = threemf_read_use(t, x, &t->uses);
        } else if (xml_is(x, THREEMF_CORE, "vertices") || xml_is(x, THREEMF_CORE, "triangles")) {
            for (list = x->depth; !failed && xml_inside(x, list);) {
                if (xml_is(x, THREEMF_CORE, "vertex"))
                    failed = threemf_read_vertex(t, x);
                else if (xml_is(x, THREEMF_CORE, "triangle"))
                    failed = threemf_read_face(t, x, object);
                else
                    failed = threemf_tell(t, x);
            }
        } else {
            failed = threemf_tell(t, x);
        }
    }
    return failed || x->failed || threemf_number(t, x, object, vertex, face);
}

/* Objects of some types are told and left out. */
static inline int threemf_type(threemf *t, xml *x, threemf_object *object)
{
    const xml_text type = xml_value(x, XML_NO_SPACE, "type");
    const int size = type.size < 30 ? (int)type.size : 30;
    const known_what what = known_find(threemf_types, type.at, type.size);
    char text[40];
    if (!size || what < KNOWN_TOLD) return 0;
    object->aside = 1;
    snprintf(text, sizeof text, "type %.*s", size, (const char *)type.at);
    return known_take(t->r, t->m, what, 0, text, strlen(text));
}

static inline int threemf_read_object(threemf *t, xml *x)
{
    threemf_object object = { 0 },
                   *out = (threemf_object *)threemf_add(t, &t->objects, sizeof *out);
    const int depth = x->depth;
    int failed = 0;
    if (!out || threemf_named(t, x, &t->object_of, t->objects.count)) return 1;
    if (xml_whole(x, "pid", UINT32_MAX, &object.pid) || xml_whole(x, "pindex", 0, &object.pindex) ||
        threemf_type(t, x, &object))
        return 1;
    object.file = (uint32_t)t->files.count - 1;
    object.vertex = t->vertices.count;
    object.face = t->faces.count;
    object.use = t->uses.count;
    object.name = out->name = xml_copy(xml_value(x, XML_NO_SPACE, "name"));
    if (!object.name) return threemf_out(t);
    while (!failed && xml_inside(x, depth)) {
        if (xml_is(x, THREEMF_CORE, "mesh") || xml_is(x, THREEMF_CORE, "components"))
            failed = threemf_read_part(t, x, &object);
        else
            failed = threemf_tell(t, x);
    }
    if (failed || x->failed) return 1;
    object.vertices = t->vertices.count - object.vertex;
    object.faces = t->faces.count - object.face;
    object.uses = t->uses.count - object.use;
    *threemf_object_at(t, t->objects.count - 1) = object;
    return 0;
}

static inline int threemf_resources(threemf *t, xml *x)
{
    const int depth = x->depth;
    int failed = 0;
    while (!failed && xml_inside(x, depth)) {
        size_t kind = 0;
        while (kind < 5 && !xml_is(x, threemf_kinds[kind].space, threemf_kinds[kind].group)) kind++;
        if (kind < 5)
            failed = threemf_read_group(t, x, &threemf_kinds[kind]);
        else if (xml_is(x, THREEMF_MATERIALS, "texture2d"))
            failed = threemf_read_texture(t, x);
        else if (xml_is(x, THREEMF_CORE, "object"))
            failed = threemf_read_object(t, x);
        else
            failed = threemf_tell(t, x);
    }
    return failed || x->failed;
}

/* ---- a file ---------------------------------------------------------------------------------- */

static inline int threemf_unit(xml *x, double *metres)
{
    static const struct {
        const char *name;
        double metres;
    } units[] = { { "micron", 1e-6 }, { "millimeter", 1e-3 }, { "centimeter", 1e-2 },
                  { "inch", 0.0254 }, { "foot", 0.3048 },     { "meter", 1 } };
    const xml_text unit = xml_value(x, XML_NO_SPACE, "unit");
    *metres = 1e-3;
    if (!unit.at) return 0;
    for (int k = 0; k < 6; k++) {
        if (!xml_equals(unit, units[k].name)) continue;
        *metres = units[k].metres;
        return 0;
    }
    return xml_fail(x, "unit", "is none of 3MF");
}

/* Refuses what a file requires, by prefixes, and what is not read. */
static inline int threemf_required(threemf *t, xml *x)
{
    xml_text left = xml_value(x, XML_NO_SPACE, "requiredextensions");
    while (left.size) {
        xml_text word = { left.at, 0 }, uri;
        while (word.size < left.size && !mesh_is_blank(word.at[word.size])) word.size++;
        uri = xml_uri(x, word);
        if (!uri.size) uri = word;
        if (word.size && known_take(t->r, t->m, known_find(threemf_extensions, uri.at, uri.size), 1,
                                    uri.at, uri.size))
            return 1;
        word.size += word.size < left.size;
        left.at += word.size;
        left.size -= word.size;
    }
    return 0;
}

static inline int threemf_read_model(threemf *t, xml *x)
{
    int failed = 0;
    if (!xml_inside(x, 0)) return 1;
    if (xml_is(x, XML_NO_SPACE, "model") && !xml_assume(x, THREEMF_CORE))
        model_warn(t->m, t->r->name, "its elements have no name space: they count as those of 3MF");
    if (!xml_is(x, THREEMF_CORE, "model"))
        return mesh_fail(x->r, "its element is no model of 3MF's core");
    if (threemf_required(t, x) || threemf_unit(x, &threemf_file_at(t, t->files.count - 1)->unit))
        return 1;
    while (!failed && xml_inside(x, 1)) {
        if (xml_is(x, THREEMF_CORE, "resources")) {
            failed = threemf_resources(t, x);
        } else if (xml_is(x, THREEMF_CORE, "build")) {
            const int first = t->files.count == 1;
            while (!failed && xml_inside(x, 2)) {
                if (!xml_is(x, THREEMF_CORE, "item"))
                    failed = threemf_tell(t, x);
                else if (first)
                    failed = threemf_read_use(t, x, &t->items);
            }
        } else {
            failed = threemf_tell(t, x);
        }
    }
    return failed || x->failed || xml_inside(x, 0) || x->failed;
}

/* Opens a file of the archive as XML; name is room for what messages call it.  *owned is to be
   freed, whatever comes back. */
static inline int threemf_open(threemf *t, const char *path, char name[200], unsigned char **owned,
                               mesh_reader *r)
{
    const zip_entry *e;
    size_t size;
    snprintf(name, 200, "%.120s: %.70s", t->r->name, *path == '/' ? path + 1 : path);
    *r = *t->r;
    r->name = name;
    r->line = 0;
    *owned = NULL;
    e = zip_find(&t->z, path);
    if (!e) return mesh_fail(t->r, "there is no %.80s in the archive", path);
    *owned = zip_unpack(r, &t->z, e);
    if (!*owned) return 1;
    size = (size_t)e->size;
    if (size > 1 && ((*owned)[0] ^ (*owned)[1]) == 1 && (*owned)[0] > 0xFD) {
        unsigned char *text = mesh_utf8(*owned, &size);
        free(*owned);
        *owned = text;
        if (!text) return mesh_fail(r, "out of memory");
    }
    r->begin = r->at = model_text_of(*owned, &size);
    r->end = r->begin + size;
    r->line = 1;
    return 0;
}

/* The number of a file, which is read when it is first wanted */
static inline int threemf_load(threemf *t, const char *path, uint32_t *number)
{
    unsigned char *owned;
    threemf_file *file;
    mesh_reader r;
    char name[200];
    xml x;
    int failed;
    for (size_t i = 0; i < t->files.count; i++) {
        const char *known = threemf_file_at(t, i)->path;
        const zip_entry same = { (const unsigned char *)known, strlen(known), 0, 0, 0, 0, 0, 0 };
        *number = (uint32_t)i;
        if (zip_is(&same, path)) return 0;
    }
    *number = (uint32_t)t->files.count;
    file = (threemf_file *)threemf_add(t, &t->files, sizeof *file);
    if (!file) return 1;
    file->path = model_text(path, strlen(path));
    if (!file->path) return threemf_out(t);
    failed = threemf_open(t, path, name, &owned, &r);
    x = xml_new(&r, threemf_spaces);
    if (!failed) failed = threemf_read_model(t, &x);
    free(owned);
    return failed;
}

/* The path of the model that has the items, to be freed */
static inline char *threemf_root(threemf *t)
{
    static const char *const spaces[] = {
        "http://schemas.openxmlformats.org/package/2006/relationships", NULL
    };
    const xml_text usual = { (const unsigned char *)"3D/3dmodel.model", 16 };
    unsigned char *owned = NULL;
    char name[200], *path = NULL;
    mesh_reader r;
    xml x;
    if (zip_find(&t->z, "_rels/.rels")) {
        if (threemf_open(t, "_rels/.rels", name, &owned, &r)) goto done;
        x = xml_new(&r, spaces);
        while (!path && xml_inside(&x, x.depth)) {
            const xml_text type = xml_value(&x, XML_NO_SPACE, "Type");
            if (!xml_is(&x, 0, "Relationship") || type.size < 8 ||
                memcmp(type.at + type.size - 8, "/3dmodel", 8) != 0)
                continue;
            path = xml_copy(xml_value(&x, XML_NO_SPACE, "Target"));
            if (!path) threemf_out(t);
            if (!path) goto done;
        }
        if (x.failed) goto done;
    }
    for (size_t i = 0; i < t->z.count && !path; i++) {
        const zip_entry *e = &t->z.entry[i];
        const zip_entry end = {
            e->name + (e->length > 6 ? e->length - 6 : 0), 6, 0, 0, 0, 0, 0, 0
        };
        if (e->length > 6 && zip_is(&end, ".model")) path = model_text(e->name, e->length);
    }
    if (!path) path = xml_copy(usual);
    if (!path) threemf_out(t);
done:
    free(owned);
    return path;
}

/* ---- what a corner looks like ---------------------------------------------------------------- */

typedef struct threemf_look {
    double rgba[4], uv[2]; /* linear light */
    uint32_t texture;      /* + 1; 0: none */
} threemf_look;

/* The numbers of a property */
static inline const double *threemf_values(const threemf *t, size_t property, size_t *count)
{
    const threemf_run *run = (const threemf_run *)t->properties.v + property;
    *count = run->count;
    return (const double *)t->numbers.v + run->first;
}

static inline const threemf_group *threemf_group_of(const threemf *t, uint32_t file, double id)
{
    uint32_t number;
    if (!mesh_set_find(&t->group_of, threemf_key(file, (uint32_t)id), &number)) return NULL;
    return (const threemf_group *)t->groups.v + number;
}

/* The look of property i of a group without layers.  0: there is none */
static inline int threemf_single(const threemf *t, uint32_t file, const threemf_group *g, double i,
                                 threemf_look *out)
{
    static const threemf_look white = { { 1, 1, 1, 1 }, { 0, 0 }, 0 };
    const threemf_group *materials;
    const double *v;
    size_t n;
    double sum = 0, mean[4] = { 0, 0, 0, 0 };
    *out = white;
    if (!(i >= 0 && i < (double)g->count)) return 0;
    v = threemf_values(t, g->first + (size_t)i, &n);
    if (g->kind == THREEMF_COLORS) memcpy(out->rgba, v, sizeof out->rgba);
    if (g->kind == THREEMF_PLACES) {
        if (!mesh_set_find(&t->texture_of, threemf_key(file, g->other), &out->texture)) return 0;
        out->texture++;
        memcpy(out->uv, v, sizeof out->uv);
    }
    if (g->kind != THREEMF_MIXTURES) return 1;
    materials = threemf_group_of(t, file, g->other);
    if (!materials || materials->kind != THREEMF_COLORS) return 0;
    for (size_t k = 0; k < n && k < g->list_count; k++) {
        threemf_look one;
        if (!threemf_single(t, file, materials, threemf_number_at(t, g->list + k), &one)) return 0;
        for (int c = 0; c < 4; c++) mean[c] += v[k] * one.rgba[c];
        sum += v[k];
    }
    for (int c = 0; c < 4; c++) out->rgba[c] = mean[c] / sum;
    return sum > 0;
}

/* The same of any group: each layer is mixed with those before it by its alpha, or multiplied. */
static inline int threemf_look_of(const threemf *t, uint32_t file, uint32_t pid, uint32_t index,
                                  threemf_look *out)
{
    const threemf_group *g = threemf_group_of(t, file, pid);
    const double *v;
    size_t n;
    if (!g) return 0;
    if (g->kind != THREEMF_LAYERS) return threemf_single(t, file, g, index, out);
    if (index >= g->count) return 0;
    v = threemf_values(t, g->first + index, &n);
    for (size_t k = 0; k < g->list_count; k++) {
        const threemf_group *layer = threemf_group_of(t, file, threemf_number_at(t, g->list + k));
        threemf_look one;
        double part;
        if (!layer || layer->kind == THREEMF_LAYERS) return 0;
        if (!threemf_single(t, file, layer, k < n ? v[k] : 0, &one)) return 0;
        part = one.rgba[3];
        if (k && k < 32 && g->multiply >> k & 1) {
            for (int c = 0; c < 4; c++) out->rgba[c] *= one.rgba[c];
        } else if (!k || one.texture || part >= 1) {
            *out = one;
        } else {
            for (int c = 0; c < 3; c++) out->rgba[c] += part * (one.rgba[c] - out->rgba[c]);
            out->rgba[3] += part * (1 - out->rgba[3]);
        }
        if (!one.texture) continue;
        out->texture = one.texture;
        memcpy(out->uv, one.uv, sizeof out->uv);
    }
    return g->list_count > 0;
}

/* ---- surfaces -------------------------------------------------------------------------------- */

/* The picture of a texture, unpacked when it is first wanted; -1, with a warning, where it cannot
   be */
static inline int threemf_picture(threemf *t, threemf_texture *texture)
{
    char error[300] = "out of memory", name[240];
    mesh_reader quiet = *t->r;
    const zip_entry *e = zip_find(&t->z, texture->path);
    model_picture *p;
    unsigned char *bytes;
    if (texture->tried++) return texture->picture;
    quiet.name = texture->path;
    quiet.error = error;
    quiet.error_size = sizeof error;
    if (!e) mesh_fail(&quiet, "it is not in the archive");
    bytes = e ? zip_unpack(&quiet, &t->z, e) : NULL;
    if (!bytes) {
        model_leave_out(t->m, t->r->name, error);
        return -1;
    }
    snprintf(name, sizeof name, "%.200s, %d, %d", texture->path, texture->wrap[0],
             texture->wrap[1]);
    texture->picture = picture_add(t->m, name, 0);
    if (texture->picture < 0) {
        free(bytes);
        return -1;
    }
    p = &t->m->picture[texture->picture];
    p->bytes = bytes;
    p->size = (size_t)e->size;
    p->map.wrap_u = (shade_wrap)texture->wrap[0];
    p->map.wrap_v = (shade_wrap)texture->wrap[1];
    memcpy(p->kind, texture->kind, sizeof p->kind);
    return texture->picture;
}

/* Adds the surface of a look to those of faces.  Colours are those of vertices: a surface is the
   alpha and the texture. */
static inline int threemf_surface(threemf *t, const threemf_look *look)
{
    int *out = (int *)threemf_add(t, &t->surfaces, sizeof *out);
    const mesh_triple key = { { (uint32_t)(look->rgba[3] * 255 + 0.5), look->texture, 0 } };
    const size_t known = t->surface_of.count;
    char name[40];
    uint32_t number;
    model_surface *s;
    int length, picture = -1;
    if (!out || mesh_set_add(&t->surface_of, key, &number)) return threemf_out(t);
    *out = (int)number;
    if (number < known) return 0;
    length = snprintf(name, sizeof name, "%u, %u", (unsigned)key.k[0], (unsigned)key.k[1]);
    if (*out >= MODEL_SURFACES || model_add_surface(t->m, name, (size_t)length) != *out)
        return threemf_out(t);
    if (look->texture)
        picture = threemf_picture(t, (threemf_texture *)t->textures.v + (look->texture - 1));
    s = &t->m->surface[*out];
    s->material.diffuse = s->material.ambient = shade_v3(1, 1, 1);
    s->transparency = (float)(1 - key.k[0] / 255.0);
    s->picture = picture;
    if (picture < 0) return 0;
    t->all.textured = 1;
    s->map = model_text(t->m->picture[picture].name, strlen(t->m->picture[picture].name));
    return s->map ? 0 : threemf_out(t);
}

/* The corners of an object in a file that has properties: a vertex for each look that it has.
   Without a property it is clay. */
static inline int threemf_dress(threemf *t, threemf_object *o)
{
    static const threemf_look clay = { { 0.5209956, 0.4452012, 0.3712377, 1 }, { 0, 0 }, 0 };
    mesh_set *made = (mesh_set *)calloc(1, sizeof *made);
    int failed = !made, missing = 0;
    o->corner = t->corners.count;
    o->index = t->indices.count;
    for (size_t i = 0; i < 3 * o->faces && !failed; i++) {
        const threemf_face *face = threemf_face_at(t, o->face + i / 3);
        const size_t known = made->count, k = i % 3;
        threemf_look look;
        const int there =
            face->pid != UINT32_MAX && threemf_look_of(t, o->file, face->pid, face->p[k], &look);
        const mesh_triple key = { { face->v[k], there ? face->pid : UINT32_MAX,
                                    there ? face->p[k] : UINT32_MAX } };
        uint32_t *index = (uint32_t *)threemf_add(t, &t->indices, sizeof *index);
        missing |= !there && face->pid != UINT32_MAX;
        t->all.colored |= there;
        if (!there) look = clay;
        failed = !index || mesh_set_add(made, key, index) || (!k && threemf_surface(t, &look));
        if (!failed && made->count > known) {
            threemf_corner *c = (threemf_corner *)threemf_add(t, &t->corners, sizeof *c);
            failed = !c;
            if (failed) break;
            c->vertex = face->v[k];
            c->color = shade_v3((float)look.rgba[0], (float)look.rgba[1], (float)look.rgba[2]);
            c->uv = shade_v2(mesh_or_zero(look.uv[0]), mesh_or_zero(1 - look.uv[1]));
        }
    }
    o->corners = made ? made->count : 0;
    if (made) mesh_set_free(made);
    free(made);
    if (missing)
        model_leave_out(t->m, t->r->name, "it has colours by numbers that it does not have");
    return failed ? threemf_out(t) : 0;
}

/* ---- what is built --------------------------------------------------------------------------- */

static inline int threemf_vertex(threemf *t, const threemf_object *o, const threemf_corner *c,
                                 const gather_matrix *at)
{
    const double *p = (const double *)t->vertices.v + 3 * (o->vertex + c->vertex);
    gather_corner v = { .color = c->color, .uv = c->uv };
    for (int k = 0; k < 3; k++)
        v.position[k] =
            at->at[k] * p[0] + at->at[4 + k] * p[1] + at->at[8 + k] * p[2] + at->at[12 + k];
    return gather_vertex(t->r, &t->all, &v);
}

static inline int threemf_place(threemf *t, threemf_object *o, const gather_matrix *at)
{
    const size_t first = t->all.positions.count / 3;
    const int mirrored = gather_determinant(at) < 0;
    const int colored = t->groups.count > 0;
    int number, surface = 0;
    if (!colored && o->faces && threemf_face_at(t, o->face)->pid != UINT32_MAX)
        model_leave_out(t->m, t->r->name, "it has colours by numbers that it does not have");
    if (t->groups.count && !o->ready && threemf_dress(t, o)) return 1;
    o->ready = 1;
    t->all.colors_kept = t->all.texcoords_kept = colored;
    number = model_add_object(t->m, o->name, strlen(o->name));
    if (number < 0 || faces_object(&t->all.faces, number)) return threemf_out(t);
    for (size_t i = 0; i < (colored ? o->corners : o->vertices); i++) {
        const threemf_corner plain = { (uint32_t)i, { 1, 1, 1 }, { 0, 0 } };
        const threemf_corner *c =
            colored ? (const threemf_corner *)t->corners.v + o->corner + i : &plain;
        if (threemf_vertex(t, o, c, at)) return 1;
    }
    if (faces_surface(&t->all.faces, 0)) return threemf_out(t);
    for (size_t i = 0; i < o->faces; i++) {
        const uint32_t *corner = colored ? (const uint32_t *)t->indices.v + o->index + 3 * i
                                         : threemf_face_at(t, o->face + i)->v;
        const int own = colored ? ((const int *)t->surfaces.v)[o->index / 3 + i] : 0;
        if (own != surface && faces_surface(&t->all.faces, own)) return threemf_out(t);
        surface = own;
        if (faces_triangle(&t->all.faces, (uint32_t)first + corner[mirrored ? 2 : 0],
                           (uint32_t)first + corner[1], (uint32_t)first + corner[mirrored ? 0 : 2]))
            return threemf_out(t);
    }
    return 0;
}

/* Counts what an object makes, before memory is taken. */
static inline int threemf_count(threemf *t, const threemf_object *o)
{
    const double most = t->r->most ? (double)t->r->most : THREEMF_TRIANGLES;
    t->triangles += (double)o->faces;
    t->placed += o->faces ? fmax((double)o->vertices, 3 * (double)o->faces) : 0;
    if (t->triangles > most) return mesh_fail(t->r, "more than %lu triangles", (unsigned long)most);
    if (t->placed > 4 * most + 1e7)
        return mesh_fail(t->r, "more than %lu vertices", (unsigned long)(4 * most + 1e7));
    return 0;
}

/* An object of a file in a place, with what it is made of */
static inline int threemf_build(threemf *t, uint32_t from, threemf_use use,
                                const gather_matrix *above)
{
    gather_matrix at = gather_product(above, &use.at);
    uint32_t file = from, place;
    threemf_object *o;
    double scale;
    int failed = 0;
    if (++t->instances > THREEMF_INSTANCES || t->depth > THREEMF_DEPTH)
        return mesh_fail(t->r, "more than %d instances, %d deep, or they go in circles",
                         THREEMF_INSTANCES, THREEMF_DEPTH);
    if (use.path && threemf_load(t, use.path, &file)) return 1;
    if (!mesh_set_find(&t->object_of, threemf_key(file, use.object), &place))
        return mesh_fail(t->r, "there is no object %lu in %.80s", (unsigned long)use.object,
                         threemf_file_at(t, file)->path);
    scale = threemf_file_at(t, file)->unit / threemf_file_at(t, from)->unit;
    for (int k = 0; k < 12 && file != from; k++) at.at[k] *= scale;
    o = threemf_object_at(t, place);
    if (o->aside) return 0;
    if (o->faces) failed = t->counting ? threemf_count(t, o) : threemf_place(t, o, &at);
    t->depth++;
    for (size_t i = 0; !failed && i < threemf_object_at(t, place)->uses; i++)
        failed =
            threemf_build(t, file, *threemf_use_at(t, threemf_object_at(t, place)->use + i), &at);
    t->depth--;
    return failed;
}

/* Where nothing is built, all objects of the root that are no part of another */
static inline int threemf_all(threemf *t)
{
    const size_t objects = t->objects.count, uses = t->uses.count;
    static const gather_matrix one = { { 1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1 } };
    uint32_t number;
    for (size_t i = 0; i < uses; i++) {
        const threemf_use *use = threemf_use_at(t, i);
        if (!use->path && mesh_set_find(&t->object_of, threemf_key(0, use->object), &number))
            threemf_object_at(t, number)->part = 1;
    }
    for (size_t i = 0; i < objects; i++) {
        threemf_use *use;
        if (threemf_object_at(t, i)->part) continue;
        use = (threemf_use *)threemf_add(t, &t->items, sizeof *use);
        if (!use) return 1;
        use->object = t->object_of.triple[i].k[1];
        use->at = one;
    }
    return 0;
}

static inline int threemf_pass(threemf *t, int counting)
{
    static const gather_matrix one = { { 1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1 } };
    t->counting = counting;
    t->instances = 0;
    for (size_t i = 0; i < t->items.count; i++)
        if (threemf_build(t, 0, ((threemf_use *)t->items.v)[i], &one)) return 1;
    return 0;
}

/* Slicers keep in files of their own which parts cut others, or only change how these are printed,
   and which extruder prints a part.  Such parts are drawn as others are, which is told. */
static inline void threemf_tell_parts(threemf *t)
{
    static const char *const files[] = { "Metadata/Slic3r_PE_model.config",
                                         "Metadata/model_settings.config", NULL };
    static const char *const words[] = { "NegativeVolume",  "negative_part",    "ParameterModifier",
                                         "modifier_part",   "SupportBlocker",   "support_blocker",
                                         "SupportEnforcer", "support_enforcer", NULL };
    static const char extruder[] = "key=\"extruder\" value=\"";
    mesh_reader quiet = *t->r;
    quiet.error_size = 0;
    for (int k = 0; files[k]; k++) {
        const zip_entry *e = zip_find(&t->z, files[k]);
        unsigned char *text = e ? zip_unpack(&quiet, &t->z, e) : NULL;
        int found = 0, second = 0;
        if (!text) continue;
        text[e->size] = 0;
        for (const char *at = (const char *)text; (at = strstr(at, extruder)) != NULL;) {
            at += sizeof extruder - 1; /* its number, without zeros before it */
            second |= *at > '1' || (*at == '1' && at[1] != '"');
        }
        for (int w = 0; words[w]; w++) found |= strstr((const char *)text, words[w]) != NULL;
        if (found)
            model_warn(t->m, t->r->name,
                       "it has negative parts or modifiers, which are drawn like others");
        if (second) model_warn(t->m, t->r->name, "the colours of its extruders do not count");
        free(text);
    }
}

static inline int threemf_make(threemf *t)
{
    char *path = NULL;
    uint32_t root;
    int failed = zip_open(t->r, &t->z);
    if (!failed) path = threemf_root(t);
    failed = !path || threemf_load(t, path, &root);
    free(path);
    if (failed || (!t->items.count && threemf_all(t))) return 1;
    threemf_tell_parts(t);
    if (threemf_pass(t, 1)) return 1;
    if (t->triangles <= 0) return known_nothing(t->r, t->m, "no faces in it");
    if (threemf_pass(t, 0)) return 1;
    for (int i = 0; i < t->m->surface_count; i++) t->m->surface[i].set = t->all.colored;
    return gather_finish(t->r, &t->all, t->m);
}

static inline int threemf_read(mesh_reader *r, model *m)
{
    threemf *t = (threemf *)calloc(1, sizeof *t);
    int failed;
    if (!t) return mesh_fail(r, "out of memory");
    r->line = 0;
    t->r = r;
    t->m = m;
    t->z.inflate = m->inflate;
    model_place(m, &t->all.origin);
    m->z_up = m->up_told = 1;
    failed = threemf_make(t);
    for (size_t i = 0; i < t->files.count; i++) free(threemf_file_at(t, i)->path);
    for (size_t i = 0; i < t->objects.count; i++) free(threemf_object_at(t, i)->name);
    for (size_t i = 0; i < t->uses.count; i++) free(threemf_use_at(t, i)->path);
    for (size_t i = 0; i < t->items.count; i++) free(((threemf_use *)t->items.v)[i].path);
    for (size_t i = 0; i < t->textures.count; i++) free(((threemf_texture *)t->textures.v)[i].path);
    {
        threemf_array *const arrays[] = { &t->files,    &t->objects,  &t->vertices, &t->faces,
                                          &t->uses,     &t->items,    &t->groups,   &t->properties,
                                          &t->numbers,  &t->textures, &t->corners,  &t->indices,
                                          &t->surfaces, NULL };
        for (size_t i = 0; arrays[i]; i++) free(arrays[i]->v);
    }
    mesh_set_free(&t->object_of);
    mesh_set_free(&t->group_of);
    mesh_set_free(&t->texture_of);
    mesh_set_free(&t->surface_of);
    free(t->z.entry);
    gather_free(&t->all);
    free(t);
    return failed;
}
#endif
