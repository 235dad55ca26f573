/* obj.h - reads triangle meshes from OBJ and STL files (STL as text or binary).

       owned_mesh m;  char error[300];
       if (mesh_read_file("bunny.obj", &m, error, sizeof error)) fprintf(stderr, "%s\n", error);

   OBJ: v (with optional w or red green blue), vt, vn and f, every form of index (v, v/vt, v//vn,
   v/vt/vn, negative ones count back from the last), polygons of any number of corners, continued
   lines, comments, any line ends.  All other statements are skipped.  One vertex is made for each
   different v/vt/vn.  Polygons are cut as fans from their first corner: right for convex ones.
   STL: equal positions become one vertex; its own normals are ignored.
   Missing normals are means of the faces around a position, also where a seam of texture parts
   them.

   Time is linear in the size of the file.  Whatever the bytes are, the result is a valid mesh or
   an error, "name:line: message" for text.  Limits: 2^31 - 1 vertices and indices, and the
   memory. */
#ifndef EXAMPLES_OBJ_H
#define EXAMPLES_OBJ_H

#include "mesh.h"
#include <errno.h>
#include <limits.h>
#include <stdarg.h>
#include <string.h>

/* Called now and then with the part of the file that has been read, 0 .. 1; may be NULL. */
typedef void mesh_progress(void *user, double part);

/* ---- what both readers need ----------------------------------------------------------------- */

typedef struct mesh_reader {
    const unsigned char *at, *begin, *end;
    const char *name;
    long long line;                      /* 0: the file is binary */
    char *error;
    size_t error_size;
    mesh_progress *progress;
    void *user;
} mesh_reader;

/* Writes the message; returns 1, the readers' word for failure. */
static inline int mesh_fail(mesh_reader *r, const char *format, ...)
{
    va_list list;
    int n = 0;
    if (!r->error_size) return 1;
    if (r->line) n = snprintf(r->error, r->error_size, "%s:%lld: ", r->name, r->line);
    else n = snprintf(r->error, r->error_size, "%s: ", r->name);
    if (n < 0 || (size_t)n >= r->error_size) return 1;
    va_start(list, format);
    vsnprintf(r->error + n, r->error_size - (size_t)n, format, list);
    va_end(list);
    return 1;
}

/* An array that doubles: room for count + 1 elements.  Returns NULL where memory or size_t ends. */
static inline void *mesh_grow(void *array, size_t count, size_t *capacity, size_t size)
{
    size_t wanted = *capacity ? *capacity * 2 : 64;
    void *grown;
    if (count < *capacity) return array;
    if (*capacity > SIZE_MAX / 2 / size) return NULL;
    grown = realloc(array, wanted * size);
    if (grown) *capacity = wanted;
    return grown;
}

/* Growable floats and indices */
typedef struct mesh_floats { float *v; size_t count, capacity; } mesh_floats;
typedef struct mesh_uints { uint32_t *v; size_t count, capacity; } mesh_uints;

static inline int mesh_push(mesh_floats *a, const float *v, size_t n)
{
    for (size_t k = 0; k < n; k++) {
        float *grown = (float *)mesh_grow(a->v, a->count, &a->capacity, sizeof *a->v);
        if (!grown) return 1;
        a->v = grown;
        a->v[a->count++] = v[k];
    }
    return 0;
}
static inline int mesh_push_triangle(mesh_uints *a, uint32_t i, uint32_t j, uint32_t k)
{
    const uint32_t v[3] = { i, j, k };
    for (size_t c = 0; c < 3; c++) {
        uint32_t *grown = (uint32_t *)mesh_grow(a->v, a->count, &a->capacity, sizeof *a->v);
        if (!grown) return 1;
        a->v = grown;
        a->v[a->count++] = v[c];
    }
    return 0;
}

/* A set of triples, numbered in order of arrival: hash table with linear probing, at most half
   full. */
typedef struct mesh_triple { uint32_t k[3]; } mesh_triple;
typedef struct mesh_set {
    mesh_triple *triple;
    uint32_t *slot;                      /* number + 1; 0: free */
    size_t count, capacity, slots;       /* slots: 0 or a power of two */
} mesh_set;

static inline size_t mesh_hash(mesh_triple t, size_t slots)
{
    uint64_t h = (uint64_t)t.k[0] * 0x9E3779B97F4A7C15u;
    h = (h ^ h >> 32 ^ t.k[1]) * 0xD6E8FEB86659FD93u;
    h = (h ^ h >> 32 ^ t.k[2]) * 0xD6E8FEB86659FD93u;
    return (size_t)(h ^ h >> 32) & (slots - 1);
}

static inline int mesh_set_rehash(mesh_set *s)
{
    size_t slots = s->slots ? s->slots * 2 : 256;
    uint32_t *slot = slots > s->slots ? (uint32_t *)calloc(slots, sizeof *slot) : NULL;
    if (!slot) return 1;
    for (size_t i = 0; i < s->count; i++) {
        size_t at = mesh_hash(s->triple[i], slots);
        while (slot[at]) at = (at + 1) & (slots - 1);
        slot[at] = (uint32_t)i + 1;
    }
    free(s->slot);
    s->slot = slot, s->slots = slots;
    return 0;
}

/* The number of a triple, added if new.  Non-zero: out of memory, or 2^31 - 1 of them. */
static inline int mesh_set_add(mesh_set *s, mesh_triple t, uint32_t *number)
{
    mesh_triple *grown;
    size_t at;
    if (s->count >= INT_MAX || (s->count * 2 >= s->slots && mesh_set_rehash(s))) return 1;
    for (at = mesh_hash(t, s->slots); s->slot[at]; at = (at + 1) & (s->slots - 1)) {
        *number = s->slot[at] - 1;
        if (!memcmp(&s->triple[*number], &t, sizeof t)) return 0;
    }
    grown = (mesh_triple *)mesh_grow(s->triple, s->count, &s->capacity, sizeof t);
    if (!grown) return 1;
    s->triple = grown;
    *number = (uint32_t)s->count;
    s->triple[s->count++] = t;
    s->slot[at] = *number + 1;
    return 0;
}

/* The bits of a position; -0 and 0 are the same place. */
static inline mesh_triple mesh_position_key(const float *p)
{
    mesh_triple t;
    for (int k = 0; k < 3; k++) {
        float v = p[k] == 0 ? 0 : p[k];
        memcpy(&t.k[k], &v, sizeof v);
    }
    return t;
}

/* Fills the normals that are all zero, one normal for each position.  A vertex whose faces
   cancel out (two sides of a sheet) takes the normal of one of them. */
static inline int mesh_fill_normals(owned_mesh *m)
{
    int vertices = m->view.vertex_count, indices = m->view.index_count, failed = 1;
    mesh_set places = { NULL, NULL, 0, 0, 0 };
    owned_mesh welded = { { 0 }, 0, 0, 0, 0, 0 };
    uint32_t *place = (uint32_t *)malloc(sizeof(uint32_t) * (size_t)vertices);
    shade_vec3 *mean = NULL;
    float biggest = 0;
    if (!place) goto done;
    for (int i = 0; i < vertices; i++)
        if (mesh_set_add(&places, mesh_position_key(m->positions + 3 * (size_t)i), &place[i]))
            goto done;
    welded.positions = (float *)malloc(3 * sizeof(float) * places.count);
    welded.indices = (uint32_t *)malloc(sizeof(uint32_t) * (size_t)indices);
    mean = (shade_vec3 *)malloc(sizeof(shade_vec3) * places.count);
    if (!welded.positions || !welded.indices || !mean) goto done;
    for (size_t i = 0; i < 3 * (size_t)vertices; i++)
        biggest = fmaxf(biggest, fabsf(m->positions[i]));
    for (size_t i = 0; i < 3 * places.count; i++) {    /* to 1: squares of any size stay in range */
        float v;
        memcpy(&v, &places.triple[i / 3].k[i % 3], sizeof v);
        welded.positions[i] = biggest > 0 ? (float)((double)v / (double)biggest) : 0;
    }
    for (int i = 0; i < indices; i++) welded.indices[i] = place[m->indices[i]];
    mesh_link(&welded, (int)places.count, indices);
    if (shade_mesh_normals(&welded.view, mean)) goto done;
    for (int i = 0; i < indices; i++) {
        shade_vec3 *n = &mean[welded.indices[i]];
        shade_vec3 p[3];
        if (n->x != 0 || n->y != 0 || n->z != 0) continue;
        for (int k = 0; k < 3; k++)
            memcpy(&p[k], welded.positions + 3 * (size_t)welded.indices[i - i % 3 + k], sizeof *p);
        *n = shade_face_normal(p[0], p[1], p[2]);
    }
    for (int i = 0; i < vertices; i++) {
        float *n = m->normals + 3 * (size_t)i;
        if (n[0] == 0 && n[1] == 0 && n[2] == 0) memcpy(n, &mean[place[i]], sizeof *mean);
    }
    failed = 0;
done:
    free(place), free(mean), free(places.triple), free(places.slot);
    mesh_free(&welded);
    return failed;
}

/* ---- text: characters, words, numbers ------------------------------------------------------- */

/* The length of a line end here: 1 for LF or CR, 2 for CR LF, else 0 */
static inline int mesh_line_end(const mesh_reader *r, const unsigned char *p)
{
    if (p == r->end || (*p != '\n' && *p != '\r')) return 0;
    return *p == '\r' && p + 1 < r->end && p[1] == '\n' ? 2 : 1;
}

/* Skips blanks and, where joined is set, line ends behind a backslash. */
static inline void mesh_skip_blanks(mesh_reader *r, int joined)
{
    for (; r->at < r->end; r->at++) {
        int n = joined && *r->at == '\\' ? mesh_line_end(r, r->at + 1) : 0;
        if (n) r->at += n, r->line++;
        else if (*r->at != ' ' && *r->at != '\t' && *r->at != '\v' && *r->at != '\f') return;
    }
}

/* To the beginning of the next line, past continued ones where joined is set */
static inline void mesh_next_line(mesh_reader *r, int joined)
{
    while (r->at < r->end) {
        int n = mesh_line_end(r, r->at), escaped = joined && *r->at == '\\';
        if (escaped) r->at++, n = mesh_line_end(r, r->at);
        if (n) r->at += n, r->line++;
        else if (!escaped) r->at++;
        if (n && !escaped) return;
    }
}

static inline int mesh_is_blank(unsigned char c)
{
    return c == ' ' || (c >= '\t' && c <= '\r');
}
static inline int mesh_at_word_end(const mesh_reader *r)
{
    return r->at == r->end || mesh_is_blank(*r->at) || *r->at == '#'
        || (*r->at == '\\' && mesh_line_end(r, r->at + 1));
}

/* What stands here, printable and short, for messages */
typedef struct mesh_quote { char text[28]; } mesh_quote;
static inline mesh_quote mesh_here(const mesh_reader *r)
{
    mesh_quote q = { "the end of the line" };
    size_t n = 0;
    const unsigned char *p = r->at;
    if (mesh_at_word_end(r)) return q;
    q.text[n++] = '"';
    for (; p < r->end && !mesh_is_blank(*p) && n < 22; p++)
        q.text[n++] = (char)(*p > 32 && *p < 127 ? *p : '?');
    q.text[n++] = '"', q.text[n] = 0;
    return q;
}

/* Takes the word if it stands here, in any case of letters. */
static inline int mesh_take_word(mesh_reader *r, const char *word)
{
    mesh_reader behind = *r;
    for (; *word; word++, behind.at++)
        if (behind.at == r->end || (*behind.at | 32) != *word) return 0;
    if (!mesh_at_word_end(&behind)) return 0;
    r->at = behind.at;
    return 1;
}

/* A decimal number, independent of the locale.  15 digits and powers up to 22 are exact in
   double, so the float is the nearest in practice; the same on every machine in any case. */
static inline int mesh_take_number(mesh_reader *r, float *out)
{
    static const double ten[] = { 1e1, 1e2, 1e4, 1e8, 1e16, 1e32, 1e64, 1e128, 1e256 };
    const unsigned char *p = r->at;
    int negative = 0, digits = 0, point = 0, e = 0, e_negative = 0, e_digits = 0;
    long long scale = 0;
    uint64_t mantissa = 0;
    double value;
    if (p < r->end && (*p == '-' || *p == '+')) negative = *p++ == '-';
    for (; p < r->end && ((*p >= '0' && *p <= '9') || (*p == '.' && !point)); p++) {
        if (*p == '.') { point = 1; continue; }
        digits = 1;
        if (mantissa < 100000000000000000u) mantissa = mantissa * 10 + *p - '0', scale -= point;
        else scale += !point;
    }
    if (digits && p < r->end && (*p | 32) == 'e') {
        p++;
        if (p < r->end && (*p == '-' || *p == '+')) e_negative = *p++ == '-';
        for (; p < r->end && *p >= '0' && *p <= '9'; p++, e_digits = 1)
            if (e < 100000) e = e * 10 + *p - '0';
        digits = e_digits;
    }
    value = (double)mantissa;
    scale += e_negative ? -e : e;
    if (scale > 400) scale = 400;
    if (scale < -400) scale = -400;
    for (int k = 0, n = (int)(scale < 0 ? -scale : scale); n; k++, n >>= 1)
        if (n & 1) value = scale < 0 ? value / ten[k] : value * ten[k];
    if (value > (double)FLT_MAX) digits = 0;
    if (digits) {
        const unsigned char *begin = r->at;
        r->at = p;
        if (mesh_at_word_end(r)) {
            *out = (float)(negative ? -value : value);
            return 0;
        }
        r->at = begin;
    }
    return mesh_fail(r, "expected a number, found %s", mesh_here(r).text);
}

/* ---- OBJ ------------------------------------------------------------------------------------ */

enum { OBJ_V, OBJ_VT, OBJ_VN };

typedef struct obj_data {
    mesh_floats list[3], color;          /* color: of the first so many v; empty: none has one */
    mesh_set corners;                    /* v, vt, vn, counted from 1; 0: absent */
    mesh_uints indices;
    uint32_t highest[3];                 /* index used so far, and where: it may be defined later */
    long long highest_line[3];
} obj_data;

/* v, vt or vn: numbers wanted, as many as allowed are taken */
static inline int obj_numbers(mesh_reader *r, float *out, int wanted, int allowed, int *count)
{
    for (*count = 0; *count < allowed; ++*count) {
        mesh_skip_blanks(r, 1);
        if (*count >= wanted && mesh_at_word_end(r)) break;
        if (mesh_take_number(r, &out[*count])) return 1;
    }
    return 0;
}

static inline int obj_vertex(mesh_reader *r, obj_data *o)
{
    static const float white[3] = { 1, 1, 1 };
    float v[7];
    int count;
    if (obj_numbers(r, v, 3, 7, &count)) return 1;
    if (count >= 6) {    /* colours as image editors show them */
        shade_vec3 rgb = shade_linear_from_srgb(shade_v3(v[3], v[4], v[5]));
        while (o->color.count < o->list[OBJ_V].count)
            if (mesh_push(&o->color, white, 3)) return mesh_fail(r, "out of memory");
        if (mesh_push(&o->color, (const float *)&rgb, 3)) return mesh_fail(r, "out of memory");
    }
    if (mesh_push(&o->list[OBJ_V], v, 3)) return mesh_fail(r, "out of memory");
    return 0;
}

static inline int obj_texcoord(mesh_reader *r, obj_data *o)
{
    float v[3] = { 0, 0, 0 };
    int count;
    if (obj_numbers(r, v, 1, 3, &count)) return 1;
    v[1] = 1 - v[1];                     /* OBJ counts v upward, shade.h downward */
    return mesh_push(&o->list[OBJ_VT], v, 2) ? mesh_fail(r, "out of memory") : 0;
}

static inline int obj_normal(mesh_reader *r, obj_data *o)
{
    float v[3];
    int count;
    if (obj_numbers(r, v, 3, 3, &count)) return 1;
    return mesh_push(&o->list[OBJ_VN], v, 3) ? mesh_fail(r, "out of memory") : 0;
}

/* One index of a corner; counts from 1 in out */
static inline int obj_index(mesh_reader *r, obj_data *o, int kind, uint32_t *out)
{
    long long count = (long long)(o->list[kind].count / (kind == OBJ_VT ? 2 : 3)), value = 0;
    mesh_reader begin = *r;
    int negative = r->at < r->end && *r->at == '-';
    r->at += negative;
    for (; r->at < r->end && *r->at >= '0' && *r->at <= '9'; r->at++)
        if (value <= INT_MAX) value = value * 10 + (*r->at - '0');
    if (negative) value = count + 1 - value;
    if (r->at == begin.at + negative)
        return mesh_fail(&begin, "expected an index, found %s", mesh_here(&begin).text);
    if (value < 1 || value > INT_MAX || (negative && value > count))
        return mesh_fail(&begin, "index %s is out of range", mesh_here(&begin).text);
    *out = (uint32_t)value;
    if (*out > o->highest[kind]) o->highest[kind] = *out, o->highest_line[kind] = r->line;
    return 0;
}

static inline int obj_corner(mesh_reader *r, obj_data *o, uint32_t *number)
{
    mesh_triple corner = { { 0, 0, 0 } };
    for (int kind = OBJ_V; kind <= OBJ_VN; kind++) {
        int absent = kind && (mesh_at_word_end(r) || *r->at == '/');
        if (!absent && obj_index(r, o, kind, &corner.k[kind])) return 1;
        if (r->at == r->end || *r->at != '/' || kind == OBJ_VN) break;
        r->at++;
    }
    if (!mesh_at_word_end(r)) return mesh_fail(r, "expected v/vt/vn, found %s", mesh_here(r).text);
    if (mesh_set_add(&o->corners, corner, number)) return mesh_fail(r, "out of memory");
    return 0;
}

static inline int obj_face(mesh_reader *r, obj_data *o)
{
    uint32_t first = 0, previous = 0, corner = 0;
    int corners = 0;
    for (;; previous = corner) {
        mesh_skip_blanks(r, 1);
        if (mesh_at_word_end(r)) break;
        if (obj_corner(r, o, &corner)) return 1;
        if (corners < 3) corners++;
        if (corners == 1) first = corner;
        if (corners < 3) continue;
        if (o->indices.count > INT_MAX - 3) return mesh_fail(r, "more than 2^31 - 1 indices");
        if (mesh_push_triangle(&o->indices, first, previous, corner))
            return mesh_fail(r, "out of memory");
    }
    return corners == 3 ? 0 : mesh_fail(r, "a face needs three corners");
}

static inline int obj_statement(mesh_reader *r, obj_data *o)
{
    if (mesh_take_word(r, "v")) return obj_vertex(r, o);
    if (mesh_take_word(r, "vt")) return obj_texcoord(r, o);
    if (mesh_take_word(r, "vn")) return obj_normal(r, o);
    if (mesh_take_word(r, "f")) return obj_face(r, o);
    return 0;
}

/* Turns what was read into vertices. */
static inline int obj_finish(mesh_reader *r, obj_data *o, owned_mesh *m)
{
    static const char *const kind_name[3] = { "v", "vt", "vn" };
    size_t n = o->corners.count;
    int missing = 0;
    if (!o->indices.count) return mesh_fail(r, "no faces in it");
    for (int k = 0; k < 3; k++) {
        if (o->highest[k] <= o->list[k].count / (k == OBJ_VT ? 2 : 3)) continue;
        r->line = o->highest_line[k];
        return mesh_fail(r, "there is no %s number %lu", kind_name[k],
                         (unsigned long)o->highest[k]);
    }
    m->positions = (float *)malloc(3 * sizeof(float) * n);
    m->normals = (float *)calloc(n, 3 * sizeof(float));
    if (o->highest[OBJ_VT]) m->texcoords = (float *)calloc(n, 2 * sizeof(float));
    if (o->color.count) m->colors = (float *)malloc(3 * sizeof(float) * n);
    if (!m->positions || !m->normals || (o->highest[OBJ_VT] && !m->texcoords)
        || (o->color.count && !m->colors)) return mesh_fail(r, "out of memory");
    for (size_t i = 0; i < n; i++) {
        const uint32_t *k = o->corners.triple[i].k;
        size_t v = 3 * ((size_t)k[OBJ_V] - 1);
        memcpy(m->positions + 3 * i, o->list[OBJ_V].v + v, 3 * sizeof(float));
        for (size_t c = 0; m->colors && c < 3; c++)
            m->colors[3 * i + c] = v + c < o->color.count ? o->color.v[v + c] : 1;
        if (k[OBJ_VT])
            memcpy(m->texcoords + 2 * i, o->list[OBJ_VT].v + 2 * ((size_t)k[OBJ_VT] - 1), 8);
        if (k[OBJ_VN])
            memcpy(m->normals + 3 * i, o->list[OBJ_VN].v + 3 * ((size_t)k[OBJ_VN] - 1), 12);
        else missing = 1;
    }
    m->indices = o->indices.v, o->indices.v = NULL;
    mesh_link(m, (int)n, (int)o->indices.count);
    return missing && mesh_fill_normals(m) ? mesh_fail(r, "out of memory") : 0;
}

static inline int obj_read(mesh_reader *r, owned_mesh *m)
{
    static const obj_data empty;
    obj_data o = empty;
    int failed = 0;
    while (r->at < r->end && !failed) {
        int comment;
        if (r->progress && r->line % 65536 == 0)
            r->progress(r->user, (double)(r->at - r->begin) / (double)(r->end - r->begin));
        mesh_skip_blanks(r, 1);
        comment = r->at < r->end && *r->at == '#';
        if (!comment) failed = obj_statement(r, &o);
        if (!failed) mesh_next_line(r, !comment && !(r->at < r->end && *r->at == '#'));
    }
    if (!failed) failed = obj_finish(r, &o, m);
    for (int k = 0; k < 3; k++) free(o.list[k].v);
    free(o.color.v), free(o.corners.triple), free(o.corners.slot), free(o.indices.v);
    return failed;
}

/* ---- STL ------------------------------------------------------------------------------------ */

typedef struct stl_data { mesh_set places; mesh_uints indices; } stl_data;

static inline int stl_place(mesh_reader *r, stl_data *s, const float *p, uint32_t *number)
{
    for (int k = 0; k < 3; k++)
        if (!(p[k] >= -FLT_MAX && p[k] <= FLT_MAX)) return mesh_fail(r, "a position is not finite");
    if (mesh_set_add(&s->places, mesh_position_key(p), number))
        return mesh_fail(r, "out of memory");
    return 0;
}
static inline int stl_triangle(mesh_reader *r, stl_data *s, uint32_t a, uint32_t b, uint32_t c)
{
    if (s->indices.count > INT_MAX - 3) return mesh_fail(r, "more than 2^31 - 1 indices");
    return mesh_push_triangle(&s->indices, a, b, c) ? mesh_fail(r, "out of memory") : 0;
}

static inline uint32_t stl_uint(const unsigned char *p)
{
    return (uint32_t)p[0] | (uint32_t)p[1] << 8 | (uint32_t)p[2] << 16 | (uint32_t)p[3] << 24;
}

/* 80 bytes of title, a count, then 50 bytes each: normal, three corners (little-endian floats),
   two unused */
static inline int stl_read_binary(mesh_reader *r, stl_data *s)
{
    uint64_t size = (uint64_t)(r->end - r->begin), count;
    r->line = 0;
    if (size < 84) return mesh_fail(r, "neither text nor binary STL");
    count = stl_uint(r->begin + 80);
    if (count > (size - 84) / 50)
        return mesh_fail(r, "ends after %lld of %lld triangles",
                         (long long)((size - 84) / 50), (long long)count);
    r->at = r->begin + 84;
    for (uint64_t i = 0; i < count; i++, r->at += 50) {
        uint32_t corner[3];
        if (r->progress && i % 65536 == 0) r->progress(r->user, (double)i / (double)count);
        for (int k = 0; k < 9; k += 3) {
            float p[3];
            for (int c = 0; c < 3; c++) {
                uint32_t bits = stl_uint(r->at + 12 + 4 * (k + c));
                memcpy(&p[c], &bits, sizeof bits);
            }
            if (stl_place(r, s, p, &corner[k / 3])) return 1;
        }
        if (stl_triangle(r, s, corner[0], corner[1], corner[2])) return 1;
    }
    return 0;
}

/* Over blanks and line ends */
static inline void stl_skip(mesh_reader *r)
{
    for (mesh_skip_blanks(r, 0); mesh_line_end(r, r->at); mesh_skip_blanks(r, 0))
        r->at += mesh_line_end(r, r->at), r->line++;
}

static inline int stl_vertex(mesh_reader *r, stl_data *s, uint32_t *number)
{
    float p[3];
    for (int k = 0; k < 3; k++) {
        stl_skip(r);
        if (mesh_take_number(r, &p[k])) return 1;
    }
    return stl_place(r, s, p, number);
}

static inline int stl_expect(mesh_reader *r, const char *word)
{
    stl_skip(r);
    if (mesh_take_word(r, word)) return 0;
    return mesh_fail(r, "expected %s, found %s", word, mesh_here(r).text);
}

/* A facet behind its word: normal (any three words), loop, corners, ends */
static inline int stl_facet(mesh_reader *r, stl_data *s)
{
    uint32_t first = 0, previous = 0, corner = 0;
    int corners = 0;
    if (stl_expect(r, "normal")) return 1;
    for (int k = 0; k < 3; k++)
        for (stl_skip(r); r->at < r->end && !mesh_is_blank(*r->at);) r->at++;
    if (stl_expect(r, "outer") || stl_expect(r, "loop")) return 1;
    for (stl_skip(r); mesh_take_word(r, "vertex"); stl_skip(r), previous = corner) {
        if (stl_vertex(r, s, &corner)) return 1;
        if (corners < 3) corners++;
        if (corners == 1) first = corner;
        if (corners == 3 && stl_triangle(r, s, first, previous, corner)) return 1;
    }
    if (corners < 3) return mesh_fail(r, "expected a vertex, found %s", mesh_here(r).text);
    return stl_expect(r, "endloop") || stl_expect(r, "endfacet");
}

static inline int stl_read_text(mesh_reader *r, stl_data *s)
{
    for (long long facets = 0;;) {
        stl_skip(r);
        if (r->at == r->end) return 0;
        if (mesh_take_word(r, "facet")) {
            if (r->progress && facets++ % 16384 == 0)
                r->progress(r->user, (double)(r->at - r->begin) / (double)(r->end - r->begin));
            if (stl_facet(r, s)) return 1;
        } else if (mesh_take_word(r, "solid") || mesh_take_word(r, "endsolid")) {
            mesh_next_line(r, 0);
        } else {
            return mesh_fail(r, "expected facet, found %s", mesh_here(r).text);
        }
    }
}

/* Whether the bytes are as many as the count of a binary file says */
static inline int stl_fits(const unsigned char *bytes, size_t size)
{
    return size >= 84 && (size - 84) % 50 == 0 && (size - 84) / 50 == stl_uint(bytes + 80);
}

/* Binary where the size fits the count to the byte; then text where it says solid and has no
   zero bytes near. */
static inline int stl_is_text(const mesh_reader *r)
{
    mesh_reader copy = *r;
    size_t size = (size_t)(r->end - r->begin), head = size < 1024 ? size : 1024;
    if (stl_fits(r->begin, size)) return 0;
    stl_skip(&copy);
    return mesh_take_word(&copy, "solid") && !memchr(r->begin, 0, head);
}

static inline int stl_read(mesh_reader *r, owned_mesh *m)
{
    static const stl_data empty;
    stl_data s = empty;
    int failed = stl_is_text(r) ? stl_read_text(r, &s) : stl_read_binary(r, &s);
    if (!failed && !s.indices.count) failed = mesh_fail(r, "no triangles in it");
    if (!failed) {
        size_t n = s.places.count;
        m->positions = (float *)malloc(3 * sizeof(float) * n);
        m->normals = (float *)calloc(n, 3 * sizeof(float));
        m->indices = s.indices.v, s.indices.v = NULL;
        for (size_t i = 0; m->positions && i < n; i++)
            memcpy(m->positions + 3 * i, &s.places.triple[i], 3 * sizeof(float));
        mesh_link(m, (int)n, (int)s.indices.count);
        failed = !m->positions || !m->normals || mesh_fill_normals(m);
        if (failed) mesh_fail(r, "out of memory");
    }
    free(s.places.triple), free(s.places.slot), free(s.indices.v);
    return failed;
}

/* ---- either --------------------------------------------------------------------------------- */

/* 1 where the name ends in .stl; of a name that ends in neither, the contents decide. */
static inline int mesh_is_stl(const char *name, const unsigned char *bytes, size_t size)
{
    size_t n = strlen(name);
    const char *end = n >= 4 ? name + n - 4 : "";
    char kind[4] = { 0, 0, 0, 0 };
    for (int k = 1; *end == '.' && k < 4; k++) kind[k - 1] = (char)(end[k] | 32);
    if (!strcmp(kind, "obj")) return 0;
    if (!strcmp(kind, "stl")) return 1;
    return (size >= 5 && !memcmp(bytes, "solid", 5)) || stl_fits(bytes, size);
}

/* From memory; name stands in messages and tells the format by its end.  0: m is filled, free it
   with mesh_free; else m is empty and error, if error_size > 0, holds one line. */
static inline int mesh_read_progress(const void *bytes, size_t size, const char *name,
                                     owned_mesh *m, char *error, size_t error_size,
                                     mesh_progress *progress, void *user)
{
    static const owned_mesh empty;
    static const unsigned char nothing[1];
    const unsigned char *begin = size ? (const unsigned char *)bytes : nothing;
    mesh_reader r = { begin, begin, begin + size, name, 1, error, error_size, progress, user };
    int failed;
    *m = empty;
    if (!size) failed = mesh_fail(&r, "the file is empty");
    else failed = mesh_is_stl(name, begin, size) ? stl_read(&r, m) : obj_read(&r, m);
    if (failed) mesh_free(m);
    return failed;
}
static inline int mesh_read_memory(const void *bytes, size_t size, const char *name, owned_mesh *m,
                                   char *error, size_t error_size)
{
    return mesh_read_progress(bytes, size, name, m, error, error_size, NULL, NULL);
}

static inline int mesh_read_file_progress(const char *path, owned_mesh *m,
                                          char *error, size_t error_size,
                                          mesh_progress *progress, void *user)
{
    static const owned_mesh empty;
    mesh_reader r = { NULL, NULL, NULL, path, 0, error, error_size, NULL, NULL };
    unsigned char *bytes = NULL;
    size_t size = 0, capacity = 0, got = 1;
    int failed = 0;
    FILE *file;
    *m = empty;
    errno = 0;
    file = fopen(path, "rb");
    if (!file) return mesh_fail(&r, "%s", errno ? strerror(errno) : "cannot be opened");
    while (got && !failed) {
        unsigned char *grown = bytes;
        if (size == capacity) {
            capacity = capacity ? capacity : 65536 / 2;
            grown = capacity <= SIZE_MAX / 2 ? (unsigned char *)realloc(bytes, capacity * 2) : NULL;
            capacity *= 2;
        }
        if (!grown) { failed = mesh_fail(&r, "out of memory"); break; }
        bytes = grown;
        got = fread(bytes + size, 1, capacity - size, file);
        size += got;
    }
    if (!failed && ferror(file))
        failed = mesh_fail(&r, "%s", errno ? strerror(errno) : "cannot be read");
    fclose(file);
    if (!failed)
        failed = mesh_read_progress(bytes, size, path, m, error, error_size, progress, user);
    free(bytes);
    return failed;
}
static inline int mesh_read_file(const char *path, owned_mesh *m, char *error, size_t error_size)
{
    return mesh_read_file_progress(path, m, error, error_size, NULL, NULL);
}
#endif
