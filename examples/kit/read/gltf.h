/* gltf.h - reads glTF 2.0: GLB, and JSON with buffers and pictures inside or beside it.  Nodes with
   their instances, skins and morph targets as they are at rest, triangles, strips and fans,
   accessors of every type, sparse ones too, views packed by meshopt, materials in the terms of
   shade.h.

   An extension is drawn, or it changes nothing that a picture of shade.h has, or a file that
   requires it is refused by its name (gltf_known).  A picture that only an extension could decode
   is a warning, and so are points beside faces, and lines where they are not wanted. */
#ifndef MODEL_GLTF_H
#define MODEL_GLTF_H

#include "gather.h"
#include "json.h"
#include "meshopt.h"

enum { GLTF_NODES = 100000, GLTF_DEPTH = 500, GLTF_TRIANGLES = 20000000, GLTF_BARE = 10000000 };
enum {
    GLTF_ACCESSORS,
    GLTF_VIEWS,
    GLTF_BUFFERS,
    GLTF_IMAGES,
    GLTF_MATERIALS,
    GLTF_MESHES,
    GLTF_NODE,
    GLTF_SAMPLERS,
    GLTF_SCENES,
    GLTF_SKINS,
    GLTF_TEXTURES,
    GLTF_LISTS
};
static const char *const gltf_lists[GLTF_LISTS] = { "accessors", "bufferViews", "buffers",
                                                    "images",    "materials",   "meshes",
                                                    "nodes",     "samplers",    "scenes",
                                                    "skins",     "textures" };

/* Those of pictures and of Draco are told and refused where they are used without another way. */
static const known_name gltf_known[] = { { "KHR_mesh_quantization", KNOWN_DRAWN },
                                         { "KHR_texture_transform", KNOWN_DRAWN },
                                         { "KHR_materials_unlit", KNOWN_DRAWN },
                                         { "KHR_materials_emissive_strength", KNOWN_DRAWN },
                                         { "KHR_materials_pbrSpecularGlossiness", KNOWN_DRAWN },
                                         { "EXT_mesh_gpu_instancing", KNOWN_DRAWN },
                                         { "KHR_node_visibility", KNOWN_DRAWN },
                                         { "KHR_materials_specular", KNOWN_DRAWN },
                                         { "KHR_materials_ior", KNOWN_DRAWN },
                                         { "KHR_materials_volume", KNOWN_SILENT },
                                         { "KHR_materials_anisotropy", KNOWN_TOLD },
                                         { "KHR_materials_dispersion", KNOWN_SILENT },
                                         { "KHR_materials_variants", KNOWN_SILENT },
                                         { "KHR_lights_punctual", KNOWN_SILENT },
                                         { "KHR_animation_pointer", KNOWN_SILENT },
                                         { "KHR_xmp_json_ld", KNOWN_SILENT },
                                         { "FB_ngon_encoding", KNOWN_SILENT },
                                         { "VRM", KNOWN_SILENT },
                                         { "KHR_materials_clearcoat", KNOWN_TOLD },
                                         { "KHR_materials_sheen", KNOWN_TOLD },
                                         { "KHR_materials_transmission", KNOWN_TOLD },
                                         { "KHR_materials_iridescence", KNOWN_TOLD },
                                         { "EXT_meshopt_compression", KNOWN_DRAWN },
                                         { "KHR_meshopt_compression", KNOWN_DRAWN },
                                         { "EXT_texture_webp", KNOWN_TOLD },
                                         { "KHR_texture_basisu", KNOWN_TOLD },
                                         { "EXT_texture_avif", KNOWN_TOLD },
                                         { "MSFT_texture_dds", KNOWN_TOLD },
                                         { "KHR_draco_mesh_compression", KNOWN_REFUSED },
                                         { NULL, KNOWN_TOLD } };

/* Attributes of vertices, without the number behind the last _.  Those that begin with _ belong to
   programs, and are silent. */
static const known_name gltf_attributes[] = {
    { "POSITION", KNOWN_DRAWN }, { "NORMAL", KNOWN_DRAWN }, { "TEXCOORD", KNOWN_DRAWN },
    { "COLOR", KNOWN_DRAWN },    { "JOINTS", KNOWN_DRAWN }, { "WEIGHTS", KNOWN_DRAWN },
    { "TANGENT", KNOWN_SILENT }, { NULL, KNOWN_TOLD }
};

typedef struct gltf_bytes {
    const unsigned char *at;
    size_t size;
    unsigned char *owned;
} gltf_bytes;

/* Where the texture coordinates of a surface come from, and two rows that change u v 1 */
typedef struct gltf_place {
    double used, set, change[6];
} gltf_place;

typedef struct gltf {
    mesh_reader *r;
    model *m;
    json_doc j;
    uint32_t *item[GLTF_LISTS];
    uint32_t count[GLTF_LISTS];
    const unsigned char *binary; /* of GLB */
    size_t binary_size;
    gltf_bytes *buffer, *unpacked; /* unpacked: by view */
    double left;                   /* bytes that may be unpacked */
    uint32_t *parent;              /* of each node, + 1 */
    gltf_place *place;
    int plain; /* the surface of faces without a material; -1: not yet */
    gather all;
    int counting, nodes, depth, lines; /* lines: there are some */
    int cut;                           /* faces are left out, for all of them are holes */
    int cloud;                         /* there are points, and no faces */
    double triangles, vertices, points, segments; /* segments: of lines */
} gltf;

/* ---- numbers and objects of the JSON --------------------------------------------------------- */

/* A whole number from 0 on */
static inline int gltf_whole(gltf *g, uint32_t object, const char *name, double none, double *out)
{
    const uint32_t at = json_member(&g->j, object, name);
    *out = at ? json_number_at(&g->j, at, -1) : none;
    if (*out >= 0 && *out < 1e12 && *out == floor(*out)) return 0;
    return mesh_fail(g->r, "%s is no whole number", name);
}

/* The object of a list that the number at a place means */
static inline int gltf_item(gltf *g, int list, uint32_t at, uint32_t *out)
{
    const double n = json_number_at(&g->j, at, -1);
    *out = 0;
    if (!(n >= 0 && n < 1e9) || n != floor(n))
        return mesh_fail(g->r, "a number of %s is wrong", gltf_lists[list]);
    if (n >= (double)g->count[list])
        return mesh_fail(g->r, "there is no %s[%lu]", gltf_lists[list], (unsigned long)n);
    *out = g->item[list][(size_t)n];
    if (g->j.value[*out].kind == JSON_OBJECT) return 0;
    return mesh_fail(g->r, "%s[%lu] is no object", gltf_lists[list], (unsigned long)n);
}

/* Fails where an object has a member of that name which is not n numbers. */
static inline int gltf_numbers(gltf *g, uint32_t object, const char *name, int n)
{
    double unused[16];
    if (!json_member(&g->j, object, name) || json_array(&g->j, object, name, unused, n)) return 0;
    return mesh_fail(g->r, "%s must be %d numbers", name, n);
}

static inline uint32_t gltf_extended(const gltf *g, uint32_t object, const char *name)
{
    const uint32_t extensions = json_of(&g->j, object, "extensions", JSON_OBJECT);
    return extensions ? json_of(&g->j, extensions, name, JSON_OBJECT) : 0;
}

/* The places of the parts of each list at the top */
static inline int gltf_index(gltf *g)
{
    for (int k = 0; k < GLTF_LISTS; k++) {
        const uint32_t list = json_of(&g->j, JSON_ROOT, gltf_lists[k], JSON_ARRAY);
        uint32_t at = list + 1;
        g->count[k] = list ? g->j.value[list].count : 0;
        g->item[k] = (uint32_t *)malloc(((size_t)g->count[k] + 1) * sizeof(uint32_t));
        if (!g->item[k]) return mesh_fail(g->r, "out of memory");
        for (uint32_t i = 0; i < g->count[k]; i++, at = g->j.value[at].end) g->item[k][i] = at;
    }
    return 0;
}

/* ---- bytes ----------------------------------------------------------------------------------- */

static inline int gltf_base64(gltf *g, const char *text, gltf_bytes *out)
{
    size_t n = strlen(text), size = 0;
    uint32_t bits = 0;
    int filled = 0;
    out->owned = (unsigned char *)malloc(n + 1);
    out->at = out->owned;
    if (!out->owned) return mesh_fail(g->r, "out of memory");
    while (n && text[n - 1] == '=') n--;
    for (size_t i = 0; i < n; i++) {
        const int c = (unsigned char)text[i];
        const int digit = c >= 'A' && c <= 'Z'   ? c - 'A'
                          : c >= 'a' && c <= 'z' ? c - 'a' + 26
                          : c >= '0' && c <= '9' ? c - '0' + 52
                          : c == '+'             ? 62
                          : c == '/'             ? 63
                                                 : -1;
        if (digit < 0) return mesh_fail(g->r, "a data URI is no base64");
        bits = bits << 6 | (uint32_t)digit;
        filled += 6;
        if (filled < 8) continue;
        filled -= 8;
        out->owned[size++] = (unsigned char)(bits >> filled);
    }
    out->size = size;
    return 0;
}

/* What a URI means.  *path is where a file was found, to be freed. */
static inline int gltf_uri(gltf *g, uint32_t at, gltf_bytes *out, char **path)
{
    char *text = json_copy(&g->j, at), *comma;
    int failed;
    if (!text) return mesh_fail(g->r, "out of memory");
    comma = strchr(text, ',');
    if (!strncmp(text, "data:", 5) && comma) {
        if (comma - text < 12 || memcmp(comma - 7, ";base64", 7) != 0)
            failed = mesh_fail(g->r, "a data URI is no base64");
        else
            failed = gltf_base64(g, comma + 1, out);
        free(text);
        return failed;
    }
    mesh_unescape(text, text, strlen(text) + 1);
    if (!model_is_beside(text)) {
        failed = mesh_fail(g->r, "%s does not lie beside the model", text);
    } else if (!g->m->beside) {
        failed = mesh_fail(g->r, "%s is beside a model that was read from memory", text);
    } else {
        char error[200] = "out of memory";
        failed = g->m->beside(g->m->path, text, MODEL_BYTES, &out->owned, &out->size, path, error,
                              sizeof error);
        out->at = out->owned;
        if (failed) mesh_fail(g->r, "%s", error);
    }
    free(text);
    return failed;
}

static inline int gltf_buffer(gltf *g, uint32_t number, gltf_bytes *out)
{
    gltf_bytes *b = &g->buffer[number];
    const uint32_t object = g->item[GLTF_BUFFERS][number];
    if (!b->at) {
        const uint32_t uri = json_of(&g->j, object, "uri", JSON_TEXT);
        char *path = NULL;
        int failed = 0;
        if (uri) failed = gltf_uri(g, uri, b, &path);
        free(path);
        if (failed) return 1;
        if (!uri && (!g->binary || number)) /* the first may stand in GLB */
            return mesh_fail(g->r, "buffers[%u] has no bytes", (unsigned)number);
        if (!uri) b->at = g->binary;
        if (!uri) b->size = g->binary_size;
    }
    *out = *b;
    out->owned = NULL;
    return 0;
}

/* The bytes of a buffer that a view, or the packed form of one, names */
static inline int gltf_range(gltf *g, uint32_t view, gltf_bytes *out)
{
    uint32_t buffer;
    double start, size;
    if (gltf_item(g, GLTF_BUFFERS, json_member(&g->j, view, "buffer"), &buffer)) return 1;
    if (gltf_whole(g, view, "byteOffset", 0, &start) ||
        gltf_whole(g, view, "byteLength", -1, &size))
        return 1;
    buffer = (uint32_t)json_number_of(&g->j, view, "buffer", 0); /* gltf_item has checked it */
    if (gltf_buffer(g, buffer, out)) return 1;
    if (start + size > (double)out->size) return mesh_fail(g->r, "a view ends behind its buffer");
    out->at += (size_t)start;
    out->size = (size_t)size;
    return 0;
}

/* What a packed view is said to hold */
static inline int gltf_packed_view(gltf *g, uint32_t packed, meshopt_view *v)
{
    static const char *const modes[] = { "ATTRIBUTES", "TRIANGLES", "INDICES" };
    static const char *const filters[] = { "NONE", "OCTAHEDRAL", "QUATERNION", "EXPONENTIAL",
                                           "COLOR" };
    const uint32_t filter = json_member(&g->j, packed, "filter");
    int mode = -1, how = filter ? -1 : MESHOPT_NONE;
    double count, stride;
    if (gltf_whole(g, packed, "count", -1, &count) ||
        gltf_whole(g, packed, "byteStride", -1, &stride))
        return 1;
    for (int k = 0; k < 3; k++)
        if (json_is(&g->j, json_member(&g->j, packed, "mode"), modes[k])) mode = k;
    for (int k = 0; k < 5 && filter; k++)
        if (json_is(&g->j, filter, filters[k])) how = k;
    v->mode = (meshopt_mode)mode;
    v->filter = (meshopt_filter)how;
    v->count = count < INT_MAX ? (size_t)count : 0;
    v->stride = stride < 1000 ? (size_t)stride : 0;
    if (mode >= 0 && how >= 0 && count < INT_MAX && !meshopt_is_wrong(v)) return 0;
    return mesh_fail(g->r, "a view is packed in a way that is not read");
}

/* Unpacks a view, once. */
static inline int gltf_unpack(gltf *g, uint32_t packed, gltf_bytes *to)
{
    meshopt_view v;
    gltf_bytes from;
    double size;
    if (to->owned) return 0;
    if (gltf_packed_view(g, packed, &v) || gltf_range(g, packed, &from)) return 1;
    size = (double)v.count * (double)v.stride;
    if (meshopt_least(&v) > (double)from.size) return mesh_fail(g->r, "a packed view is cut off");
    if (size > g->left)
        return mesh_fail(g->r, "its views unpack to more than %.0f bytes", ZIP_BYTES);
    g->left -= size;
    to->owned = (unsigned char *)calloc((size_t)size + 1, 1);
    if (!to->owned) return mesh_fail(g->r, "out of memory");
    to->at = to->owned;
    to->size = (size_t)size;
    if (!meshopt_unpack(&v, from.at, from.size, to->owned)) return 0;
    free(to->owned);
    to->owned = NULL;
    return mesh_fail(g->r, "a packed view is damaged");
}

/* The bytes of a view, and its stride or 0 */
static inline int gltf_view(gltf *g, uint32_t at, gltf_bytes *out, double *stride)
{
    uint32_t view, packed;
    gltf_bytes *own;
    double size;
    if (gltf_item(g, GLTF_VIEWS, at, &view) || gltf_whole(g, view, "byteStride", 0, stride))
        return 1;
    packed = gltf_extended(g, view, "EXT_meshopt_compression");
    if (!packed) packed = gltf_extended(g, view, "KHR_meshopt_compression");
    if (!packed) return gltf_range(g, view, out);
    own = &g->unpacked[(size_t)json_number_at(&g->j, at, 0)];
    if (gltf_unpack(g, packed, own) || gltf_whole(g, view, "byteLength", -1, &size)) return 1;
    if (size > (double)own->size) return mesh_fail(g->r, "a view ends behind its unpacked bytes");
    *out = (gltf_bytes){ own->at, (size_t)size, NULL };
    return 0;
}

/* ---- accessors ------------------------------------------------------------------------------- */

/* The values of an accessor: in v, or where that is NULL as they stand in the file */
typedef struct gltf_values {
    double *v;
    const unsigned char *from;
    size_t count, stride;
    int width, type, normalized; /* width 0: there is no such accessor */
} gltf_values;

enum { GLTF_BYTE = 5120 };
static const int gltf_sizes[7] = { 1, 1, 2, 2, 0, 4, 4 };

/* A number of a component type, brought to 0 .. 1 or -1 .. 1 if it is normalized */
static inline double gltf_component(const unsigned char *p, int type, int normalized)
{
    static const double most[7] = { 127, 255, 32767, 65535, 1, 4294967295.0, 1 };
    const uint32_t bits = type < 2 ? *p : type < 4 ? mesh_uint16(p) : mesh_uint32(p);
    double value = bits;
    if (type == 6) return (double)mesh_float(bits);
    if (type == 0 && bits > 127) value -= 256;
    if (type == 2 && bits > 32767) value -= 65536;
    return normalized ? fmax(value / most[type], -1) : value;
}

static inline double gltf_value(const gltf_values *a, size_t i, int k)
{
    if (a->v) return a->v[(size_t)a->width * i + (size_t)k];
    return gltf_component(a->from + i * a->stride + k * gltf_sizes[a->type], a->type,
                          a->normalized);
}

/* Finds the bytes of values whose count, width and type are known. */
static inline int gltf_find(gltf *g, uint32_t object, gltf_values *a)
{
    const double size = gltf_sizes[a->type] * a->width;
    gltf_bytes bytes;
    double stride, start;
    if (gltf_view(g, json_member(&g->j, object, "bufferView"), &bytes, &stride) ||
        gltf_whole(g, object, "byteOffset", 0, &start))
        return 1;
    if (stride == 0) stride = size;
    if (stride < size) return mesh_fail(g->r, "the stride of an accessor is less than its values");
    if (a->count && start + ((double)a->count - 1) * stride + size > (double)bytes.size)
        return mesh_fail(g->r, "an accessor ends behind its view");
    a->from = a->count ? bytes.at + (size_t)start : NULL;
    a->stride = (size_t)stride;
    return 0;
}

/* Copies the values, so that they can be changed; those that stand nowhere are 0. */
static inline int gltf_copy(gltf *g, gltf_values *a)
{
    double *v = (double *)calloc((a->count + 1) * (size_t)a->width, sizeof *v);
    if (!v) return mesh_fail(g->r, "out of memory");
    for (size_t i = 0; i < a->count && a->from; i++)
        for (int k = 0; k < a->width; k++)
            v[(size_t)a->width * i + (size_t)k] = gltf_value(a, i, k);
    a->v = v;
    return 0;
}

/* The values of a sparse accessor that differ from the base */
static inline int gltf_sparse(gltf *g, uint32_t sparse, const gltf_values *a)
{
    const uint32_t indices = json_of(&g->j, sparse, "indices", JSON_OBJECT);
    const uint32_t values = json_of(&g->j, sparse, "values", JSON_OBJECT);
    gltf_values where = { .width = 1 }, what = *a;
    double count, type;
    if (!indices || !values || gltf_whole(g, sparse, "count", -1, &count) ||
        gltf_whole(g, indices, "componentType", 0, &type))
        return mesh_fail(g->r, "a sparse accessor is wrong");
    if (count > (double)a->count || (type != 5121 && type != 5123 && type != 5125))
        return mesh_fail(g->r, "a sparse accessor is wrong");
    where.type = (int)type - GLTF_BYTE;
    where.count = what.count = (size_t)count;
    what.v = NULL;
    if (gltf_find(g, indices, &where) || gltf_find(g, values, &what)) return 1;
    for (size_t i = 0; i < where.count; i++) {
        const double to = gltf_value(&where, i, 0);
        if (to >= (double)a->count) return mesh_fail(g->r, "a sparse accessor is wrong");
        for (int k = 0; k < a->width; k++)
            a->v[(size_t)a->width * (size_t)to + (size_t)k] = gltf_value(&what, i, k);
    }
    return 0;
}

/* How many values an accessor has */
static inline int gltf_count_of(gltf *g, uint32_t at, double *count)
{
    uint32_t object;
    return gltf_item(g, GLTF_ACCESSORS, at, &object) || gltf_whole(g, object, "count", -1, count);
}

/* The values of an accessor of least to most components; free v afterwards, also where it fails.
   fractions: whole numbers count as normalized also where the file does not say so */
static inline int gltf_read_values(gltf *g, uint32_t at, int least, int most, int fractions,
                                   gltf_values *out)
{
    static const char *const types[] = { "SCALAR", "VEC2", "VEC3", "VEC4", "MAT4" };
    static const int widths[] = { 1, 2, 3, 4, 16 };
    static const gltf_values none;
    uint32_t object, kind, view, sparse;
    double count, type;
    *out = none;
    if (gltf_item(g, GLTF_ACCESSORS, at, &object) || gltf_whole(g, object, "count", -1, &count) ||
        gltf_whole(g, object, "componentType", 0, &type))
        return 1;
    kind = json_member(&g->j, object, "type");
    for (int k = 0; k < 5 && kind; k++)
        if (json_is(&g->j, kind, types[k])) out->width = widths[k];
    out->type = (int)type - GLTF_BYTE;
    if (out->width < least || out->width > most || out->type < 0 || out->type > 6 || out->type == 4)
        return mesh_fail(g->r, "an accessor has the wrong type");
    out->normalized = json_of(&g->j, object, "normalized", JSON_TRUE) ||
                      (fractions && (type == 5121 || type == 5123));
    view = json_member(&g->j, object, "bufferView");
    sparse = json_of(&g->j, object, "sparse", JSON_OBJECT);
    if (count > (view ? (double)INT_MAX : GLTF_BARE))
        return mesh_fail(g->r, "an accessor has too many values");
    out->count = (size_t)count;
    if (view && gltf_find(g, object, out))
        return 1; /* the bytes are there before memory is taken */
    if ((sparse || !view) && gltf_copy(g, out)) return 1;
    return sparse ? gltf_sparse(g, sparse, out) : 0;
}

/* The same of an attribute, for so many vertices; width is 0 where there is none. */
static inline int gltf_attribute(gltf *g, uint32_t attributes, const char *name, int least,
                                 int most, size_t count, gltf_values *out)
{
    static const gltf_values none;
    const uint32_t at = json_member(&g->j, attributes, name);
    *out = none;
    if (!at) return 0;
    if (gltf_read_values(g, at, least, most, !strcmp(name, "COLOR_0"), out)) return 1;
    return out->count == count ? 0 : mesh_fail(g->r, "%s has not a value for each vertex", name);
}

/* ---- where things are ------------------------------------------------------------------------ */

static inline gather_matrix gltf_moved(const double *t, const double *q, const double *s)
{
    const double length = sqrt(q[0] * q[0] + q[1] * q[1] + q[2] * q[2] + q[3] * q[3]);
    const double n = length > 0 ? 1 / length : 0;
    const double x = q[0] * n, y = q[1] * n, z = q[2] * n, w = length > 0 ? q[3] * n : 1;
    const gather_matrix m = { { s[0] * (1 - 2 * (y * y + z * z)), s[0] * 2 * (x * y + z * w),
                                s[0] * 2 * (x * z - y * w), 0, s[1] * 2 * (x * y - z * w),
                                s[1] * (1 - 2 * (x * x + z * z)), s[1] * 2 * (y * z + x * w), 0,
                                s[2] * 2 * (x * z + y * w), s[2] * 2 * (y * z - x * w),
                                s[2] * (1 - 2 * (x * x + y * y)), 0, t[0], t[1], t[2], 1 } };
    return m;
}

/* A node in its parent */
static inline gather_matrix gltf_local(const gltf *g, uint32_t node)
{
    double t[3] = { 0, 0, 0 }, q[4] = { 0, 0, 0, 1 }, s[3] = { 1, 1, 1 };
    gather_matrix m = { { 0 } };
    if (json_array(&g->j, node, "matrix", m.at, 16)) return m;
    json_array(&g->j, node, "translation", t, 3);
    json_array(&g->j, node, "rotation", q, 4);
    json_array(&g->j, node, "scale", s, 3);
    return gltf_moved(t, q, s);
}

static inline int gltf_parents(gltf *g)
{
    g->parent = (uint32_t *)calloc((size_t)g->count[GLTF_NODE] + 1, sizeof *g->parent);
    if (!g->parent) return mesh_fail(g->r, "out of memory");
    for (uint32_t i = 0; i < g->count[GLTF_NODE]; i++) {
        const uint32_t node = g->item[GLTF_NODE][i];
        const uint32_t children = json_of(&g->j, node, "children", JSON_ARRAY);
        uint32_t at = children + 1;
        if (gltf_numbers(g, node, "matrix", 16) || gltf_numbers(g, node, "translation", 3) ||
            gltf_numbers(g, node, "rotation", 4) || gltf_numbers(g, node, "scale", 3))
            return 1;
        for (uint32_t k = 0; children && k < g->j.value[children].count; k++) {
            const double lower = json_number_at(&g->j, at, -1);
            if (lower >= 0 && lower < (double)g->count[GLTF_NODE]) g->parent[(size_t)lower] = i + 1;
            at = g->j.value[at].end;
        }
    }
    return 0;
}

/* A node in the world */
static inline gather_matrix gltf_world(const gltf *g, uint32_t node)
{
    gather_matrix m = gltf_local(g, g->item[GLTF_NODE][node]);
    for (int depth = 0; depth < GLTF_DEPTH && g->parent[node]; depth++) {
        gather_matrix above;
        node = g->parent[node] - 1;
        above = gltf_local(g, g->item[GLTF_NODE][node]);
        m = gather_product(&above, &m);
    }
    return m;
}

/* The matrices of a skin's joints; free them afterwards. */
static inline int gltf_joints(gltf *g, uint32_t node, gather_matrix **out, uint32_t *count)
{
    const uint32_t number = json_member(&g->j, node, "skin");
    uint32_t skin, joints, at, inverse;
    gltf_values bind = { .v = NULL };
    *out = NULL;
    if (!number) return 0;
    if (gltf_item(g, GLTF_SKINS, number, &skin)) return 1;
    joints = json_of(&g->j, skin, "joints", JSON_ARRAY);
    if (!joints) return mesh_fail(g->r, "a skin has no joints");
    *count = g->j.value[joints].count;
    inverse = json_member(&g->j, skin, "inverseBindMatrices");
    if (inverse && (gltf_read_values(g, inverse, 16, 16, 0, &bind) || bind.count < *count)) {
        free(bind.v);
        return mesh_fail(g->r, "a skin has not a matrix for each joint");
    }
    *out = (gather_matrix *)calloc((size_t)*count + 1, sizeof **out);
    at = joints + 1;
    for (uint32_t i = 0; *out && i < *count; i++, at = g->j.value[at].end) {
        const double joint = json_number_at(&g->j, at, -1);
        gather_matrix from;
        if (!(joint >= 0 && joint < (double)g->count[GLTF_NODE])) {
            free(bind.v);
            return mesh_fail(g->r, "a joint is no node");
        }
        (*out)[i] = gltf_world(g, (uint32_t)joint);
        if (!bind.width) continue;
        for (int k = 0; k < 16; k++) from.at[k] = gltf_value(&bind, i, k);
        (*out)[i] = gather_product(&(*out)[i], &from);
    }
    free(bind.v);
    return *out ? 0 : mesh_fail(g->r, "out of memory");
}

/* ---- materials ------------------------------------------------------------------------------- */

static inline int gltf_wrap(const gltf *g, uint32_t sampler, const char *name)
{
    const double code = json_number_of(&g->j, sampler, name, 10497);
    return code == 33071 ? SHADE_WRAP_CLAMP : code == 33648 ? SHADE_WRAP_MIRROR : SHADE_WRAP_REPEAT;
}

/* The kind of a picture, where the file says it in few letters */
static inline void gltf_kind(const gltf *g, uint32_t image, model_picture *p)
{
    char *kind = json_copy(&g->j, json_of(&g->j, image, "mimeType", JSON_TEXT));
    if (kind && strlen(kind) < sizeof p->kind) memcpy(p->kind, kind, strlen(kind));
    free(kind);
}

/* The picture of an image, with how it goes on beyond its edges and between its texels.  *number is
   -1 where it cannot be read, which is a warning. */
static inline int gltf_image(gltf *g, uint32_t image, uint32_t sampler, int what, int *number)
{
    static const char *const ways[2][3] = { { "", ", u clamped", ", u mirrored" },
                                            { "", ", v clamped", ", v mirrored" } };
    const int wrap[2] = { gltf_wrap(g, sampler, "wrapS"), gltf_wrap(g, sampler, "wrapT") };
    const uint32_t view = json_member(&g->j, image, "bufferView");
    mesh_reader *const outer = g->r;
    mesh_reader quiet = *outer;
    gltf_bytes bytes = { NULL, 0, NULL };
    char name[64], error[300] = "out of memory", *path = NULL;
    double stride;
    const int nearest = json_number_of(&g->j, sampler, "magFilter", 9729) == 9728;
    size_t place = 0;
    int failed;
    while (g->item[GLTF_IMAGES][place] != image) place++;
    snprintf(name, sizeof name, "images[%lu]%s%s%s", (unsigned long)place, ways[0][wrap[0]],
             ways[1][wrap[1]], nearest ? ", squares" : "");
    *number = picture_find(g->m, name, what);
    if (*number >= 0) return 0;
    quiet.error = error;
    quiet.error_size = sizeof error;
    g->r = &quiet;
    failed = view ? gltf_view(g, view, &bytes, &stride)
                  : gltf_uri(g, json_member(&g->j, image, "uri"), &bytes, &path);
    g->r = outer;
    *number = picture_add(g->m, name, what);
    if (*number < 0) {
        free(bytes.owned);
        free(path);
        return mesh_fail(g->r, "out of memory");
    }
    if (failed) {
        model_leave_out(g->m, g->r->name, error);
        free(bytes.owned);
        free(path);
    } else {
        model_picture *p = &g->m->picture[*number];
        if (!bytes.owned) bytes.owned = (unsigned char *)model_text(bytes.at, bytes.size);
        if (!bytes.owned) return mesh_fail(g->r, "out of memory");
        p->bytes = bytes.owned;
        p->size = bytes.size;
        gltf_kind(g, image, p);
        p->path = path;
        p->map.wrap_u = (shade_wrap)wrap[0];
        p->map.wrap_v = (shade_wrap)wrap[1];
        p->map.filter = nearest ? SHADE_FILTER_NEAREST : SHADE_FILTER_BILINEAR;
    }
    return 0;
}

/* Where the texture coordinates for a texture come from */
static inline gltf_place gltf_placed(const gltf *g, uint32_t info)
{
    const uint32_t change = gltf_extended(g, info, "KHR_texture_transform");
    gltf_place p = { 1, 0, { 1, 0, 0, 0, 1, 0 } };
    double offset[2] = { 0, 0 }, scale[2] = { 1, 1 }, cosine, sine;
    shade_mat4 turn;
    p.set = fmin(99, fmax(0, json_number_of(&g->j, info, "texCoord", 0)));
    if (!change) return p;
    p.set = fmin(99, fmax(0, json_number_of(&g->j, change, "texCoord", p.set)));
    json_array(&g->j, change, "offset", offset, 2);
    json_array(&g->j, change, "scale", scale, 2);
    turn =
        shade_mat4_rotation((float)json_number_of(&g->j, change, "rotation", 0), shade_v3(0, 0, 1));
    cosine = (double)turn.col[0].x;
    sine = (double)turn.col[0].y;
    p.change[0] = cosine * scale[0];
    p.change[1] = sine * scale[1];
    p.change[2] = offset[0];
    p.change[3] = -sine * scale[0];
    p.change[4] = cosine * scale[1];
    p.change[5] = offset[1];
    return p;
}

/* A texture of a material, unless its coordinates differ from those of the pictures before it.
   *number becomes its picture, and *map its name. */
static inline int gltf_texture(gltf *g, gltf_place *place, uint32_t material, const char *name,
                               int what, char **map, int *number)
{
    const uint32_t info = json_of(&g->j, material, name, JSON_OBJECT);
    const gltf_place own = gltf_placed(g, info);
    uint32_t texture, source, image, sampler = 0, at;
    if (!info) return 0;
    if (place->used > 0 && memcmp(place, &own, sizeof own) != 0) {
        model_leave_out(g->m, name, "it has other texture coordinates than the pictures before it");
        return 0;
    }
    if (gltf_item(g, GLTF_TEXTURES, json_member(&g->j, info, "index"), &texture)) return 1;
    source = json_member(&g->j, texture, "source");
    if (!source) {
        const uint32_t extensions = json_of(&g->j, texture, "extensions", JSON_OBJECT);
        const json_value *needed = &g->j.value[extensions + 1];
        return extensions && g->j.value[extensions].count
                   ? known_take(g->r, g->m, KNOWN_TOLD, 0, g->j.text + needed->from, needed->size)
                   : 0;
    }
    at = json_member(&g->j, texture, "sampler");
    if (gltf_item(g, GLTF_IMAGES, source, &image) ||
        (at && gltf_item(g, GLTF_SAMPLERS, at, &sampler)) ||
        gltf_image(g, image, sampler, what, number))
        return 1;
    *place = own;
    if (!map) return 0;
    *map = model_text(g->m->picture[*number].name, strlen(g->m->picture[*number].name));
    return *map ? 0 : mesh_fail(g->r, "out of memory");
}

static inline int gltf_alpha(gltf *g, model_surface *s, uint32_t material, double alpha)
{
    const uint32_t mode = json_member(&g->j, material, "alphaMode");
    s->blended = mode && json_is(&g->j, mode, "BLEND");
    s->opaque = !s->blended && !(mode && json_is(&g->j, mode, "MASK"));
    if (s->blended) s->transparency = (float)(1 - fmin(1, fmax(0, alpha)));
    if (!s->blended && !s->opaque)
        s->alpha_cutoff = (float)fmax(1e-6, json_number_of(&g->j, material, "alphaCutoff", 0.5) /
                                                fmax(alpha, 1e-3));
    return 0;
}

static inline shade_vec3 gltf_color(const double *v)
{
    const shade_vec3 c = shade_v3((float)v[0], (float)v[1], (float)v[2]);
    return shade_clamp(c, shade_v3(0, 0, 0), shade_v3(1, 1, 1));
}

/* Tells of a member that is there. */
static inline int gltf_told(gltf *g, uint32_t object, const char *name)
{
    return json_member(&g->j, object, name)
               ? known_take(g->r, g->m, KNOWN_TOLD, 0, name, strlen(name))
               : 0;
}

/* Colours of specular and glossiness: what is black but for its highlight is a metal. */
static inline int gltf_gloss(gltf *g, uint32_t gloss, double base[3], double *metal)
{
    double shine[3] = { 0, 0, 0 };
    json_array(&g->j, gloss, "specularFactor", shine, 3);
    *metal = !json_member(&g->j, gloss, "diffuseTexture") && base[0] + base[1] + base[2] < 0.1 &&
             shine[0] + shine[1] + shine[2] > 0.5;
    if (*metal > 0) memcpy(base, shine, sizeof shine);
    return gltf_told(g, gloss, "specularGlossinessTexture");
}

/* Highlights of what is no metal: by how much more than 0.04 it reflects from the front, which k_s
   of 0.25 stands for.  The mirror image of the studio stays that of 0.04. */
static inline int gltf_shine(gltf *g, uint32_t material, model_surface *s)
{
    const uint32_t shine = gltf_extended(g, material, "KHR_materials_specular");
    const uint32_t glass = gltf_extended(g, material, "KHR_materials_ior");
    const double n = json_number_of(&g->j, glass, "ior", 1.5), r = (n - 1) / (n + 1);
    const double factor = fmin(1, fmax(0, json_number_of(&g->j, shine, "specularFactor", 1)));
    double color[3] = { 1, 1, 1 }, k_s[3];
    if (gltf_numbers(g, shine, "specularColorFactor", 3)) return 1;
    json_array(&g->j, shine, "specularColorFactor", color, 3);
    for (int k = 0; k < 3; k++) { /* n of 0 stands for a mirror, says the extension */
        const double front = n >= 1 ? r * r : n == 0 ? 1 : 0.04;
        k_s[k] = factor * fmin(1, fmax(0, 6.25 * front * color[k]));
    }
    if (glass || shine) s->shine = gltf_color(k_s);
    return gltf_told(g, shine, "specularTexture") || gltf_told(g, shine, "specularColorTexture");
}

/* The picture of metal and roughness */
static inline int gltf_polish(gltf *g, gltf_place *place, uint32_t rough, model_surface *s)
{
    const char *const name = "metallicRoughnessTexture";
    if (g->m->polish_wanted)
        return gltf_texture(g, place, rough, name, PICTURE_POLISH, NULL, &s->polish);
    return gltf_told(g, rough, name);
}

static inline int gltf_material(gltf *g, uint32_t material, model_surface *s, gltf_place *place)
{
    const uint32_t gloss = gltf_extended(g, material, "KHR_materials_pbrSpecularGlossiness");
    const uint32_t shine = gltf_extended(g, material, "KHR_materials_emissive_strength");
    const uint32_t rough = json_of(&g->j, material, "pbrMetallicRoughness", JSON_OBJECT);
    const uint32_t unlit = gltf_extended(g, material, "KHR_materials_unlit");
    const uint32_t from = gloss ? gloss : rough, named = json_member(&g->j, material, "name");
    const uint32_t bumps = json_of(&g->j, material, "normalTexture", JSON_OBJECT);
    double base[4] = { 1, 1, 1, 1 }, glow[3] = { 0, 0, 0 }, metal, roughness, strength;
    if (gltf_numbers(g, from, gloss ? "diffuseFactor" : "baseColorFactor", 4) ||
        gltf_numbers(g, material, "emissiveFactor", 3))
        return 1;
    json_array(&g->j, from, gloss ? "diffuseFactor" : "baseColorFactor", base, 4);
    json_array(&g->j, material, "emissiveFactor", glow, 3);
    metal = json_number_of(&g->j, rough, "metallicFactor", 1);
    if (gloss && gltf_gloss(g, gloss, base, &metal)) return 1;
    roughness = gloss ? 1 - json_number_of(&g->j, gloss, "glossinessFactor", 1)
                      : json_number_of(&g->j, rough, "roughnessFactor", 1);
    strength = fmin(100, fmax(0, json_number_of(&g->j, shine, "emissiveStrength", 1)));
    s->material.diffuse = gltf_color(base);
    s->material.emission = shade_scale(gltf_color(glow), (float)strength);
    /* an exporter's material that says nothing: white, rough metal, without a name */
    s->set = named || gloss || unlit || metal < 1 || roughness < 1 || base[0] < 1 || base[1] < 1 ||
             base[2] < 1 || glow[0] + glow[1] + glow[2] > 0;
    if (!gloss && !unlit && gltf_shine(g, material, s)) return 1;
    model_rough(s, (float)metal, (float)roughness);
    gltf_alpha(g, s, material, base[3]);
    if (gltf_texture(g, place, from, gloss ? "diffuseTexture" : "baseColorTexture", PICTURE_COLORS,
                     &s->map, &s->picture))
        return 1;
    if (unlit) { /* its other members count for who cannot draw it unlit */
        s->material = (shade_material){ .diffuse = gltf_color(base), .ambient = gltf_color(base) };
        s->metal = 0;
        s->unlit = 1;
        return 0;
    }
    if (gltf_texture(g, place, material, "normalTexture", PICTURE_RELIEF, &s->relief.map,
                     &s->relief.picture) ||
        gltf_texture(g, place, material, "emissiveTexture", PICTURE_COLORS, &s->glow_map,
                     &s->glow_picture) ||
        (!gloss && gltf_polish(g, place, rough, s)))
        return 1;
    if (s->relief.map) /* 0 would stand for a file that does not say */
        s->relief.strength = (float)fmax(1e-6, fabs(json_number_of(&g->j, bumps, "scale", 1)));
    if (s->map || s->relief.map || s->glow_map || s->polish >= 0) s->set = 1;
    if (json_of(&g->j, material, "emissiveTexture", JSON_OBJECT) && !s->glow_map)
        s->material.emission = shade_v3(0, 0, 0);
    model_glow(s, 1);
    return 0;
}

static inline int gltf_materials(gltf *g)
{
    const uint32_t n = g->count[GLTF_MATERIALS];
    g->place = (gltf_place *)calloc((size_t)n + 1, sizeof *g->place);
    if (!g->place) return mesh_fail(g->r, "out of memory");
    if (n >= MODEL_SURFACES) return mesh_fail(g->r, "more than 10000 materials");
    for (uint32_t i = 0; i < n; i++) {
        char name[16];
        const int length = snprintf(name, sizeof name, "%u", (unsigned)i);
        if (model_add_surface(g->m, name, (size_t)length) < 0)
            return mesh_fail(g->r, "out of memory");
        if (gltf_material(g, g->item[GLTF_MATERIALS][i], &g->m->surface[i], &g->place[i])) return 1;
    }
    return 0;
}

/* Where what has no material is on */
static inline int gltf_plain(gltf *g, int *surface)
{
    if (g->plain < 0) g->plain = model_add_surface(g->m, "plain", 5);
    *surface = g->plain;
    return g->plain < 0 ? mesh_fail(g->r, "out of memory") : 0;
}

/* The surface of a primitive, whose place is g->place of that number */
static inline int gltf_surface(gltf *g, uint32_t primitive, int *surface)
{
    const uint32_t at = json_member(&g->j, primitive, "material");
    uint32_t material;
    if (at) {
        if (gltf_item(g, GLTF_MATERIALS, at, &material)) return 1;
        *surface = (int)json_number_at(&g->j, at, 0);
        return 0;
    }
    return gltf_plain(g, surface);
}

/* ---- meshes ---------------------------------------------------------------------------------- */

/* What a primitive has at its vertices */
typedef struct gltf_vertices {
    gltf_values position, normal, uv, color, joint[2], weight[2], index;
    char uv_name[24];
    shade_vec3 tint; /* of all colours */
    gather_matrix *bone;
    uint32_t bones;
} gltf_vertices;

static inline void gltf_free_vertices(gltf_vertices *v)
{
    free(v->position.v);
    free(v->normal.v);
    free(v->uv.v);
    free(v->color.v);
    free(v->index.v);
    for (int k = 0; k < 2; k++) free(v->joint[k].v);
    for (int k = 0; k < 2; k++) free(v->weight[k].v);
}

/* Adds the morph targets with their weights at rest: those of the node, else of the mesh. */
static inline int gltf_morph(gltf *g, uint32_t primitive, uint32_t mesh, uint32_t node,
                             gltf_vertices *v)
{
    const uint32_t targets = json_of(&g->j, primitive, "targets", JSON_ARRAY);
    uint32_t weights = json_of(&g->j, node, "weights", JSON_ARRAY), target = targets + 1, at;
    if (!weights) weights = json_of(&g->j, mesh, "weights", JSON_ARRAY);
    if (!targets || !weights) return 0;
    at = weights + 1;
    for (uint32_t i = 0; i < g->j.value[targets].count && i < g->j.value[weights].count; i++) {
        const double weight = json_number_at(&g->j, at, 0);
        const char *const names[4] = { "POSITION", "NORMAL", v->uv_name, "COLOR_0" };
        gltf_values *const base[4] = { &v->position, &v->normal, &v->uv, &v->color };
        for (int k = 0; k < 4 && weight != 0; k++) {
            const int width = base[k]->width;
            gltf_values moved;
            int failed = gltf_attribute(g, target, names[k], 2, 4, v->position.count, &moved);
            if (!failed && width && !base[k]->v) failed = gltf_copy(g, base[k]);
            for (size_t n = 0; !failed && n < moved.count; n++)
                for (int c = 0; c < width && c < moved.width; c++)
                    base[k]->v[n * (size_t)width + (size_t)c] += weight * gltf_value(&moved, n, c);
            free(moved.v);
            if (failed) return 1;
        }
        at = g->j.value[at].end;
        target = g->j.value[target].end;
    }
    return 0;
}

/* Tells of attributes that are not drawn. */
static inline int gltf_tell(gltf *g, uint32_t attributes)
{
    uint32_t at = attributes + 1;
    for (uint32_t i = 0; i < g->j.value[attributes].count; i += 2, at = g->j.value[at + 1].end) {
        const unsigned char *name = g->j.text + g->j.value[at].from;
        size_t n = g->j.value[at].size, stem = n;
        if (!n || *name == '_') continue;
        while (stem && name[stem - 1] >= '0' && name[stem - 1] <= '9') stem--;
        stem = stem > 1 && stem < n && name[stem - 1] == '_' ? stem - 1 : n;
        if (known_take(g->r, g->m, known_find(gltf_attributes, name, stem), 0, name, n)) return 1;
    }
    return 0;
}

/* Colours of vertices, whose alpha is told of where it would show */
static inline int gltf_colors(gltf *g, uint32_t attributes, int surface, size_t n, gltf_values *out)
{
    int clear = 0;
    if (gltf_attribute(g, attributes, "COLOR_0", 3, 4, n, out)) return 1;
    for (size_t i = 0; i < n && out->width == 4; i++) clear |= gltf_value(out, i, 3) < 1;
    if (clear && surface != g->plain && !g->m->surface[surface].opaque)
        model_warn(g->m, g->r->name, "the alpha of its COLOR_0 does not count");
    return 0;
}

static inline int gltf_load(gltf *g, uint32_t primitive, int surface, gltf_vertices *v)
{
    const uint32_t attributes = json_of(&g->j, primitive, "attributes", JSON_OBJECT);
    const uint32_t index = json_member(&g->j, primitive, "indices");
    char *const uv = v->uv_name;
    size_t n;
    if (gltf_tell(g, attributes)) return 1;
    if (gltf_read_values(g, json_member(&g->j, attributes, "POSITION"), 3, 3, 0, &v->position))
        return 1;
    n = v->position.count;
    snprintf(uv, sizeof v->uv_name, "TEXCOORD_%d",
             surface == g->plain ? 0 : (int)g->place[surface].set);
    if (gltf_attribute(g, attributes, "NORMAL", 3, 3, n, &v->normal) ||
        gltf_attribute(g, attributes, uv, 2, 2, n, &v->uv) ||
        gltf_colors(g, attributes, surface, n, &v->color) ||
        gltf_attribute(g, attributes, "JOINTS_0", 4, 4, n, &v->joint[0]) ||
        gltf_attribute(g, attributes, "WEIGHTS_0", 4, 4, n, &v->weight[0]) ||
        gltf_attribute(g, attributes, "JOINTS_1", 4, 4, n, &v->joint[1]) ||
        gltf_attribute(g, attributes, "WEIGHTS_1", 4, 4, n, &v->weight[1]))
        return 1;
    if (index && gltf_read_values(g, index, 1, 1, 0, &v->index)) return 1;
    for (size_t i = 0; i < v->index.count; i++)
        if (!(gltf_value(&v->index, i, 0) >= 0 && gltf_value(&v->index, i, 0) < (double)n))
            return mesh_fail(g->r, "an index points behind the vertices");
    return 0;
}

static inline int gltf_is_boned(const gltf_vertices *v)
{
    return v->bone && v->joint[0].width && v->weight[0].width;
}

/* Where a vertex is: its place in the world, or the mean of the places of its joints.  0: its
   weights are wrong */
static inline gather_matrix gltf_bone(const gltf_vertices *v, size_t i, const gather_matrix *at)
{
    gather_matrix m = { { 0 } };
    double sum = 0;
    if (!gltf_is_boned(v)) return *at;
    for (int k = 0; k < 8; k++) {
        const gltf_values *joint = &v->joint[k / 4], *weight = &v->weight[k / 4];
        double bone, w;
        if (!joint->width || !weight->width) continue;
        bone = gltf_value(joint, i, k % 4);
        w = gltf_value(weight, i, k % 4);
        if (!(w > 0) || !(bone >= 0 && bone < (double)v->bones)) continue;
        for (int c = 0; c < 16; c++) m.at[c] += w * v->bone[(size_t)bone].at[c];
        sum += w;
    }
    for (int c = 0; c < 16 && sum > 0; c++) m.at[c] /= sum;
    return sum > 0 ? m : *at;
}

/* A matrix, and what normals take: its cofactors with the sign of its determinant */
typedef struct gltf_turn {
    gather_matrix m;
    double normal[3][3];
} gltf_turn;

static inline gltf_turn gltf_turned(gather_matrix m)
{
    const double sign = gather_determinant(&m) < 0 ? -1 : 1;
    gltf_turn t = { m, { { 0 } } };
    for (int k = 0; k < 9; k++) t.normal[k / 3][k % 3] = sign * gather_cofactor(&m, k / 3, k % 3);
    return t;
}

static inline gather_corner gltf_corner(const gltf_vertices *v, size_t i, const gltf_turn *at,
                                        const gltf_place *place)
{
    gather_corner c = { .color = { 1, 1, 1 } };
    const double *m = at->m.at;
    double p[3], rgb[3];
    float normal[3] = { 0, 0, 0 };
    for (int k = 0; k < 3; k++) p[k] = gltf_value(&v->position, i, k);
    for (int k = 0; k < 3; k++)
        c.position[k] = m[k] * p[0] + m[4 + k] * p[1] + m[8 + k] * p[2] + m[12 + k];
    for (int k = 0; v->normal.width && k < 9; k++)
        normal[k / 3] += (float)(at->normal[k / 3][k % 3] * gltf_value(&v->normal, i, k % 3));
    memcpy(&c.normal, normal, sizeof normal);
    for (int k = 0; v->color.width && k < 3; k++) rgb[k] = gltf_value(&v->color, i, k);
    if (v->color.width) c.color = gltf_color(rgb);
    c.color = shade_mul(c.color, v->tint);
    if (v->uv.width && place) {
        const double uv[2] = { gltf_value(&v->uv, i, 0), gltf_value(&v->uv, i, 1) };
        const double *t = place->change;
        c.uv = shade_v2(mesh_or_zero(t[0] * uv[0] + t[1] * uv[1] + t[2]),
                        mesh_or_zero(t[3] * uv[0] + t[4] * uv[1] + t[5]));
    }
    return c;
}

/* The triangles of a list (4), a strip (5) or a fan (6) */
static inline int gltf_faces(gltf *g, const gltf_vertices *v, double mode, size_t first,
                             int mirrored)
{
    const size_t n = v->index.width ? v->index.count : v->position.count;
    const size_t step = mode == 4 ? 3 : 1;
    for (size_t i = 0; i + 2 < n; i += step) {
        const size_t corner[3] = { mode == 6 ? 0 : i, i + 1, i + 2 };
        const int turned = (mode == 5 && i % 2) != mirrored;
        uint32_t vertex[3];
        for (int k = 0; k < 3; k++) {
            const size_t at = corner[k];
            const double own = v->index.width ? gltf_value(&v->index, at, 0) : (double)at;
            vertex[k] = (uint32_t)(first + (size_t)own);
        }
        if (faces_triangle(&g->all.faces, vertex[0], vertex[turned ? 2 : 1],
                           vertex[turned ? 1 : 2]))
            return mesh_fail(g->r, "out of memory");
    }
    return mesh_check_triangles(g->r, g->all.faces.triangles);
}

/* The segments of a list (1), a loop (2) or a strip (3) of so many corners */
static inline double gltf_segments(double mode, double corners)
{
    return mode == 1 ? floor(corners / 2) : fmax(0, corners - (mode == 3)) * (corners > 1);
}

/* The lines of a primitive, in one place, each with the mean colour of its ends */
static inline int gltf_lines(gltf *g, const gltf_vertices *v, double mode, int surface,
                             const gather_matrix *at)
{
    const size_t n = v->index.width ? v->index.count : v->position.count;
    const size_t segments = (size_t)gltf_segments(mode, (double)n);
    for (size_t i = 0; i < segments; i++) {
        const size_t first = mode == 1 ? 2 * i : i;
        gather_corner c[2];
        float end[2][3];
        for (size_t k = 0; k < 2; k++) {
            const size_t which = (first + k) % n;
            const size_t own = v->index.width ? (size_t)gltf_value(&v->index, which, 0) : which;
            const gltf_turn turn = { gltf_bone(v, own, at), { { 0 } } };
            c[k] = gltf_corner(v, own, &turn, NULL);
            mesh_relative(&g->all.origin, c[k].position, end[k]);
        }
        if (model_add_line(g->m, end[0], end[1], shade_lerp(c[0].color, c[1].color, 0.5f), surface))
            return mesh_fail(g->r, "out of memory");
    }
    return 0;
}

/* Counts what a primitive makes, before memory is taken. */
static inline int gltf_count(gltf *g, uint32_t primitive, double mode, size_t instances)
{
    const uint32_t attributes = json_of(&g->j, primitive, "attributes", JSON_OBJECT);
    const uint32_t index = json_member(&g->j, primitive, "indices");
    const double most = g->r->most ? (double)g->r->most : GLTF_TRIANGLES;
    double vertices, corners;
    if (gltf_count_of(g, json_member(&g->j, attributes, "POSITION"), &vertices)) return 1;
    corners = vertices;
    if (index && gltf_count_of(g, index, &corners)) return 1;
    if (mode > 0 && mode < 4) {
        g->segments += gltf_segments(mode, corners) * (double)instances;
    } else if (mode > 0) {
        g->vertices += vertices * (double)instances;
        g->triangles += (mode == 4 ? floor(corners / 3) : fmax(0, corners - 2)) * (double)instances;
    } else
        g->points += corners * (double)instances;
    if (g->segments > most) return mesh_fail(g->r, "more than %lu lines", (unsigned long)most);
    if (g->triangles > most) return mesh_fail(g->r, "more than %lu triangles", (unsigned long)most);
    if (fmax(g->vertices, g->points) > 4 * most + 1e6)
        return mesh_fail(g->r, "more than %lu vertices", (unsigned long)(4 * most + 1e6));
    return 0;
}

typedef struct gltf_instances {
    const gather_matrix *at;
    size_t count;
} gltf_instances;

/* 1: an accessor has no bytes: Draco has them. */
static inline int gltf_bare(gltf *g, uint32_t at)
{
    uint32_t object;
    return gltf_item(g, GLTF_ACCESSORS, at, &object) || !json_member(&g->j, object, "bufferView");
}

/* Points have no surface: its base colour becomes theirs. */
static inline shade_vec3 gltf_tint(const gltf *g, int surface)
{
    const model_surface *s = &g->m->surface[surface];
    if (!g->cloud || surface == g->plain) return shade_v3(1, 1, 1);
    return shade_scale(s->material.diffuse, 1 / (1 - MODEL_METAL_DARK * s->metal));
}

static inline int gltf_primitive(gltf *g, uint32_t primitive, uint32_t mesh, uint32_t node,
                                 const gltf_instances *in)
{
    static const gltf_vertices none;
    const uint32_t attributes = json_of(&g->j, primitive, "attributes", JSON_OBJECT);
    const uint32_t at = json_member(&g->j, attributes, "POSITION");
    gltf_vertices v = none;
    double mode;
    int surface = 0, failed, wire;
    gltf_place *place;
    if (gltf_whole(g, primitive, "mode", 4, &mode)) return 1;
    if (!at) return 0; /* nothing to draw, says glTF */
    if (gltf_extended(g, primitive, "KHR_draco_mesh_compression") && gltf_bare(g, at))
        return mesh_fail(g->r, "it needs KHR_draco_mesh_compression, which is not read");
    wire = mode > 0 && mode < 4;
    if (mode > 6 || (wire && !g->m->lines_wanted)) {
        g->lines = 1;
        return 0;
    }
    if (g->counting) return gltf_count(g, primitive, mode, in->count);
    if (!wire && g->cloud != !(mode > 0)) return 0;
    if (gltf_surface(g, primitive, &surface)) return 1;
    if (g->m->surface[surface].alpha_cutoff > 1) { /* no alpha of a picture is enough */
        g->cut = 1;
        return 0;
    }
    place = surface == g->plain ? NULL : &g->place[surface];
    if (place && place->used > 0 && (wire || g->cloud))
        model_leave_out(g->m, g->r->name,
                        wire ? "the pictures of its lines" : "the pictures of its points");
    v.tint = wire ? shade_v3(1, 1, 1) : gltf_tint(g, surface);
    failed = gltf_load(g, primitive, surface, &v);
    if (!failed && place && place->used > 0 && !v.uv.width && !g->cloud && !wire)
        model_leave_out(g->m, g->r->name, "a picture has no texture coordinates");
    if (!failed)
        failed = gltf_morph(g, primitive, mesh, node, &v) ||
                 gltf_joints(g, node, &v.bone, &v.bones) || faces_surface(&g->all.faces, surface);
    for (size_t k = 0; k < in->count && wire && !failed; k++)
        failed = gltf_lines(g, &v, mode, surface, &in->at[k]);
    if (wire) {
        free(v.bone);
        gltf_free_vertices(&v);
        return failed;
    }
    g->all.textured |= v.uv.width && place && place->used > 0;
    g->all.colored |= v.color.width > 0 || v.tint.x * v.tint.y * v.tint.z < 1;
    g->all.texcoords_kept = g->all.textured;
    g->all.colors_kept = g->all.colored;
    for (size_t k = 0; k < in->count && !failed; k++) {
        const size_t first = g->all.positions.count / 3;
        const int named = g->cloud && v.index.width; /* these points alone */
        const size_t n = named ? v.index.count : v.position.count;
        gltf_turn turn = gltf_turned(n ? gltf_bone(&v, 0, &in->at[k]) : in->at[k]);
        const int mirrored = gather_determinant(&turn.m) < 0;
        for (size_t i = 0; i < n && !failed; i++) {
            const size_t own = named ? (size_t)gltf_value(&v.index, i, 0) : i;
            gather_corner corner;
            if (gltf_is_boned(&v)) turn = gltf_turned(gltf_bone(&v, own, &in->at[k]));
            corner = gltf_corner(&v, own, &turn, place && place->used > 0 ? place : NULL);
            failed = gather_vertex(g->r, &g->all, &corner);
        }
        if (!failed && !g->cloud) failed = gltf_faces(g, &v, mode, first, mirrored);
    }
    free(v.bone);
    gltf_free_vertices(&v);
    return failed;
}

/* The places of the instances of a node; free them afterwards. */
static inline int gltf_instanced(gltf *g, uint32_t node, const gather_matrix *at,
                                 gather_matrix **out, size_t *count)
{
    const uint32_t extension = gltf_extended(g, node, "EXT_mesh_gpu_instancing");
    const uint32_t list = json_of(&g->j, extension, "attributes", JSON_OBJECT);
    static const char *const names[3] = { "TRANSLATION", "ROTATION", "SCALE" };
    gltf_values v[3] = { { .v = NULL }, { .v = NULL }, { .v = NULL } };
    double n = -1, own;
    int failed = 0;
    *out = NULL;
    for (int k = 0; k < 3 && extension; k++) {
        const uint32_t from = json_member(&g->j, list, names[k]);
        if (!from) continue;
        if (gltf_count_of(g, from, &own)) return 1;
        if (n >= 0 && n != own) return mesh_fail(g->r, "instances have counts that differ");
        n = own;
    }
    if (n > GLTF_TRIANGLES) return mesh_fail(g->r, "more than %d instances", GLTF_TRIANGLES);
    *count = n < 0 ? 1 : (size_t)n;
    if (g->counting) return 0;
    *out = (gather_matrix *)malloc((*count + 1) * sizeof **out);
    if (!*out) return mesh_fail(g->r, "out of memory");
    for (int k = 0; k < 3 && n >= 0 && !failed; k++)
        failed = gltf_attribute(g, list, names[k], k == 1 ? 4 : 3, k == 1 ? 4 : 3, *count, &v[k]);
    for (size_t i = 0; i < *count && !failed; i++) {
        double at_rest[3][4] = { { 0, 0, 0, 0 }, { 0, 0, 0, 1 }, { 1, 1, 1, 0 } };
        gather_matrix m;
        for (int k = 0; k < 12; k++)
            if (k % 4 < v[k / 4].width) at_rest[k / 4][k % 4] = gltf_value(&v[k / 4], i, k % 4);
        m = gltf_moved(at_rest[0], at_rest[1], at_rest[2]);
        (*out)[i] = n < 0 ? *at : gather_product(at, &m);
    }
    for (int k = 0; k < 3; k++) free(v[k].v);
    return failed;
}

static inline int gltf_mesh(gltf *g, uint32_t node, const gather_matrix *at)
{
    uint32_t mesh, list, part;
    gather_matrix *places;
    gltf_instances in = { NULL, 0 };
    int failed;
    if (gltf_item(g, GLTF_MESHES, json_member(&g->j, node, "mesh"), &mesh)) return 1;
    list = json_of(&g->j, mesh, "primitives", JSON_ARRAY);
    failed = gltf_instanced(g, node, at, &places, &in.count);
    in.at = places;
    if (!failed && !g->counting) {
        char *name = json_copy(&g->j, json_member(&g->j, node, "name"));
        const int object = name ? model_add_object(g->m, name, strlen(name)) : -1;
        free(name);
        if (object < 0 || faces_object(&g->all.faces, object))
            failed = mesh_fail(g->r, "out of memory");
    }
    part = list + 1;
    for (uint32_t i = 0; list && i < g->j.value[list].count && !failed; i++) {
        if (g->j.value[part].kind == JSON_OBJECT) failed = gltf_primitive(g, part, mesh, node, &in);
        part = g->j.value[part].end;
    }
    free(places);
    return failed;
}

static inline int gltf_node(gltf *g, uint32_t node, const gather_matrix *above)
{
    const uint32_t seen = gltf_extended(g, node, "KHR_node_visibility");
    uint32_t children, lower, below;
    gather_matrix local, here;
    int failed = 0;
    if (seen && json_of(&g->j, seen, "visible", JSON_FALSE)) return 0;
    if (++g->nodes > GLTF_NODES || g->depth >= GLTF_DEPTH)
        return mesh_fail(g->r, "more than %d nodes, %d deep, or they go in circles", GLTF_NODES,
                         GLTF_DEPTH);
    local = gltf_local(g, node);
    here = gather_product(above, &local);
    if (json_member(&g->j, node, "mesh")) failed = gltf_mesh(g, node, &here);
    children = json_of(&g->j, node, "children", JSON_ARRAY);
    lower = children + 1;
    g->depth++;
    for (uint32_t i = 0; children && i < g->j.value[children].count && !failed; i++) {
        failed = gltf_item(g, GLTF_NODE, lower, &below) || gltf_node(g, below, &here);
        lower = g->j.value[lower].end;
    }
    g->depth--;
    return failed;
}

/* The scene of the file, or where there is none all nodes that have no parent */
static inline int gltf_scene(gltf *g, int counting)
{
    static const gather_matrix one = { { 1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1 } };
    uint32_t scene = 0, roots, node, at = json_member(&g->j, JSON_ROOT, "scene");
    int failed = 0;
    g->counting = counting;
    g->nodes = 0;
    if (at && gltf_item(g, GLTF_SCENES, at, &scene)) return 1;
    if (!at && g->count[GLTF_SCENES]) scene = g->item[GLTF_SCENES][0];
    roots = json_of(&g->j, scene, "nodes", JSON_ARRAY);
    at = roots + 1;
    for (uint32_t i = 0; scene && roots && i < g->j.value[roots].count && !failed; i++) {
        failed = gltf_item(g, GLTF_NODE, at, &node) || gltf_node(g, node, &one);
        at = g->j.value[at].end;
    }
    for (uint32_t i = 0; !scene && i < g->count[GLTF_NODE] && !failed; i++) {
        node = g->item[GLTF_NODE][i];
        if (!g->parent[i] && g->j.value[node].kind == JSON_OBJECT)
            failed = gltf_node(g, node, &one);
    }
    return failed;
}

/* ---- the file -------------------------------------------------------------------------------- */

/* Sets the reader to the JSON of a GLB file and finds its buffer. */
static inline int gltf_chunks(gltf *g)
{
    mesh_reader *r = g->r;
    const size_t size = (size_t)(r->end - r->begin);
    const unsigned char *text = NULL;
    size_t length, text_size = 0;
    r->line = 0;
    if (size < 12) return mesh_fail(r, "the header of GLB is cut off");
    if (mesh_uint32(r->begin + 4) != 2)
        return mesh_fail(r, "glTF %lu is not read, 2 is", (unsigned long)mesh_uint32(r->begin + 4));
    length = mesh_uint32(r->begin + 8);
    if (length > size) return mesh_fail(r, "GLB is cut off");
    for (size_t at = 12; at + 8 <= length;) {
        const size_t chunk = mesh_uint32(r->begin + at), kind = mesh_uint32(r->begin + at + 4);
        if (chunk > length - at - 8) return mesh_fail(r, "a chunk of GLB is cut off");
        if (kind == 0x4E4F534A && !text) {
            text = r->begin + at + 8;
            text_size = chunk;
        } else if (kind == 0x004E4942 && !g->binary) {
            g->binary = r->begin + at + 8;
            g->binary_size = chunk;
        }
        at += 8 + chunk;
    }
    if (!text) return mesh_fail(r, "GLB has no JSON");
    r->at = text;
    r->end = text + text_size;
    while (r->end > text && !r->end[-1]) r->end--; /* some writers fill up with zeros */
    return 0;
}

/* Refuses a required extension that is not read, and tells of one that is used. */
static inline int gltf_extensions(gltf *g, const char *list, int required)
{
    const uint32_t names = json_of(&g->j, JSON_ROOT, list, JSON_ARRAY);
    uint32_t at = names + 1;
    for (uint32_t i = 0; names && i < g->j.value[names].count; i++, at = g->j.value[at].end) {
        char *name = json_copy(&g->j, at);
        known_what what = name ? known_find(gltf_known, name, strlen(name)) : KNOWN_SILENT;
        int failed = 0;
        if (!required && name && (strstr(name, "_texture_") || what == KNOWN_REFUSED))
            what = KNOWN_SILENT;
        if (name) failed = known_take(g->r, g->m, what, required, name, strlen(name));
        free(name);
        if (failed) return 1;
    }
    return 0;
}

static inline int gltf_version(gltf *g)
{
    const uint32_t asset = json_of(&g->j, JSON_ROOT, "asset", JSON_OBJECT);
    char *version = json_copy(&g->j, json_member(&g->j, asset, "version"));
    char *least = json_copy(&g->j, json_member(&g->j, asset, "minVersion"));
    const int two = version && version[0] == '2' && (version[1] == '.' || !version[1]);
    const int later = two && least && *least && strcmp(least, "2.0") != 0;
    if (g->j.value[JSON_ROOT].kind != JSON_OBJECT)
        mesh_fail(g->r, "its JSON is no object");
    else if (!two)
        mesh_fail(g->r, "glTF %s is not read, 2 is", version && *version ? version : "1");
    else if (later)
        mesh_fail(g->r, "it needs glTF %s; 2.0 is read", least);
    free(version);
    free(least);
    return !two || later;
}

static inline int gltf_build(gltf *g)
{
    int plain, points;
    if (gltf_version(g) || gltf_extensions(g, "extensionsRequired", 1) || gltf_index(g)) return 1;
    g->buffer = (gltf_bytes *)calloc((size_t)g->count[GLTF_BUFFERS] + 1, sizeof *g->buffer);
    g->unpacked = (gltf_bytes *)calloc((size_t)g->count[GLTF_VIEWS] + 1, sizeof *g->unpacked);
    if (!g->buffer || !g->unpacked) return mesh_fail(g->r, "out of memory");
    if (gltf_parents(g) || gltf_scene(g, 1)) return 1;
    g->cloud = g->triangles <= 0 && g->points > 0;
    if (g->triangles <= 0 && !g->cloud && g->segments <= 0)
        return mesh_fail(g->r, g->lines ? "lines alone are not drawn" : "no faces in it");
    if (gltf_materials(g) || gltf_scene(g, 0)) return 1;
    points = g->points > 0 && !g->cloud;
    if (g->lines || points)
        model_leave_out(g->m, g->r->name,
                        !points    ? "its lines"
                        : g->lines ? "its points and lines"
                                   : "its points");
    if (g->cut && !g->m->line_count &&
        !(g->cloud ? g->all.positions.count : g->all.faces.triangles))
        return mesh_fail(g->r, "nothing of it can be seen: its alpha is below its alphaCutoff");
    if (g->cut) model_leave_out(g->m, g->r->name, "faces whose alpha is below their alphaCutoff");
    if (gltf_extensions(g, "extensionsUsed", 0)) return 1;
    if (g->triangles <= 0 && !g->cloud) {
        model_placed(g->m, &g->all.origin);
        return 0;
    }
    if (!g->cloud) return gather_finish(g->r, &g->all, g->m);
    if (gltf_plain(g, &plain) || gather_points(g->r, &g->all, g->m)) return 1;
    if (g->m->part) g->m->part->surface = plain;
    return 0;
}

/* 1: it begins as JSON does. */
static inline int gltf_is_text(const unsigned char *at, const unsigned char *end)
{
    while (at < end && mesh_is_blank(*at)) at++;
    return at < end && (*at == '{' || *at == '[');
}

static inline int gltf_read(mesh_reader *r, model *m)
{
    static const gltf empty;
    gltf g = empty;
    int failed;
    g.r = r;
    g.m = m;
    g.plain = -1;
    g.left = ZIP_BYTES;
    model_place(m, &g.all.origin);
    if (r->end - r->begin >= 4 && !memcmp(r->begin, "glTF", 4))
        failed = gltf_chunks(&g);
    else if ((failed = !gltf_is_text(r->at, r->end)) != 0)
        mesh_fail(r, "expected glTF or its JSON, found %s", mesh_here(r).text);
    if (!failed) failed = json_read(r, &g.j);
    r->line = 0;
    if (!failed) failed = gltf_build(&g);
    m->up_told = m->physical = 1;
    for (int k = 0; k < GLTF_LISTS; k++) free(g.item[k]);
    for (uint32_t i = 0; g.buffer && i < g.count[GLTF_BUFFERS]; i++) free(g.buffer[i].owned);
    for (uint32_t i = 0; g.unpacked && i < g.count[GLTF_VIEWS]; i++) free(g.unpacked[i].owned);
    free(g.buffer);
    free(g.unpacked);
    free(g.parent);
    free(g.place);
    free(g.j.value);
    gather_free(&g.all);
    return failed;
}
#endif
