/* reader.h - what the readers of model files share: bytes and where they are read, arrays that
   grow, sets, normals that a file lacks, and the words and numbers of text. */
#ifndef MODEL_READER_H
#define MODEL_READER_H

#include "../../shared/mesh.h"
#include <errno.h>
#include <limits.h>
#include <stdarg.h>
#include <string.h>

/* Called now and then with the part of the file that has been read, 0 .. 1; may be NULL. */
typedef void mesh_progress(void *user, double part);

/* ---- bytes, arrays, sets, normals ----------------------------------------------------------- */

typedef struct mesh_reader {
    const unsigned char *at, *begin, *end;
    const char *name;
    long long line; /* 0: the file is binary */
    char *error;
    size_t error_size;
    mesh_progress *progress;
    void *user;
    size_t most;              /* triangles; 0: what int can count */
    const volatile int *stop; /* non-zero there: the reading ends; may be NULL */
    double before, all;       /* where only a piece of a file is here: its bytes before begin, and
                                 all of them; 0: the whole is here */
} mesh_reader;

/* A reader of nothing, for what is said about a file */
static inline mesh_reader mesh_about(const char *name, char *error, size_t error_size)
{
    const mesh_reader r = { .name = name, .error = error, .error_size = error_size };
    return r;
}

/* A reader of size bytes */
static inline mesh_reader mesh_of(const void *bytes, size_t size, const char *name, char *error,
                                  size_t error_size)
{
    mesh_reader r = mesh_about(name, error, error_size);
    r.at = r.begin = (const unsigned char *)bytes;
    r.end = r.begin + size;
    return r;
}

/* A message is one line, whatever names are in it. */
static inline void mesh_plain(char *text)
{
    for (; *text; text++)
        if ((unsigned char)*text < ' ' || *text == 127) *text = '?';
}

/* Writes the message and returns 1, which means failure in all readers. */
static inline int mesh_fail(mesh_reader *r, const char *format, ...)
{
    va_list list;
    int n = 0;
    if (!r->error_size) return 1;
    if (r->line)
        n = snprintf(r->error, r->error_size, "%s:%lld: ", r->name, r->line);
    else
        n = snprintf(r->error, r->error_size, "%s: ", r->name);
    if (n >= 0 && (size_t)n < r->error_size) {
        va_start(list, format);
        vsnprintf(r->error + n, r->error_size - (size_t)n, format, list);
        va_end(list);
    }
    mesh_plain(r->error);
    return 1;
}

/* Non-zero: who called does not want the rest any more. */
static inline int mesh_stopped(mesh_reader *r)
{
    return r->stop && *r->stop ? mesh_fail(r, "interrupted") : 0;
}

/* Tells how far the reader is, for every MESH_TELL-th thing that it has read; mesh_stopped. */
enum { MESH_TELL = 16384 };
static inline int mesh_tell(mesh_reader *r, size_t things)
{
    if (things % MESH_TELL) return 0;
    if (r->progress) {
        const double all = r->all > 0 ? r->all : (double)(r->end - r->begin);
        r->progress(r->user, (r->before + (double)(r->at - r->begin)) / all);
    }
    return mesh_stopped(r);
}

/* Fails if there are more triangles than the caller allows, or than 2^31 - 1 indices can hold. */
static inline int mesh_check_triangles(mesh_reader *r, size_t triangles)
{
    if (triangles > INT_MAX / 3) return mesh_fail(r, "more than 2^31 - 1 indices");
    if (!r->most || triangles <= r->most) return 0;
    return mesh_fail(r, "more than %lu triangles", (unsigned long)r->most);
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

static inline uint32_t mesh_uint16(const unsigned char *p)
{
    return (uint32_t)p[0] | (uint32_t)p[1] << 8;
}

static inline uint32_t mesh_uint32(const unsigned char *p)
{
    return mesh_uint16(p) | mesh_uint16(p + 2) << 16;
}

static inline float mesh_float(uint32_t bits)
{
    float v;
    memcpy(&v, &bits, sizeof v);
    return v;
}

/* Growable floats and indices */
typedef struct mesh_floats {
    float *v;
    size_t count, capacity;
} mesh_floats;
typedef struct mesh_uints {
    uint32_t *v;
    size_t count, capacity;
} mesh_uints;

static inline int mesh_push(mesh_floats *a, const float *v, size_t n)
{
    if (a->capacity - a->count < n) { /* n is less than 64 */
        float *grown = (float *)mesh_grow(a->v, a->capacity, &a->capacity, sizeof *a->v);
        if (!grown) return 1;
        a->v = grown;
    }
    memcpy(a->v + a->count, v, n * sizeof *v);
    a->count += n;
    return 0;
}

static inline int mesh_push_uint(mesh_uints *a, uint32_t v)
{
    if (a->count == a->capacity) {
        uint32_t *grown = (uint32_t *)mesh_grow(a->v, a->count, &a->capacity, sizeof *a->v);
        if (!grown) return 1;
        a->v = grown;
    }
    a->v[a->count++] = v;
    return 0;
}

static inline int mesh_push_triangle(mesh_uints *a, uint32_t i, uint32_t j, uint32_t k)
{
    if (a->capacity - a->count < 3)
        return mesh_push_uint(a, i) || mesh_push_uint(a, j) || mesh_push_uint(a, k);
    a->v[a->count++] = i;
    a->v[a->count++] = j;
    a->v[a->count++] = k;
    return 0;
}

/* A set of triples, numbered in order of arrival: hash table with linear probing, at most half
   full. */
typedef struct mesh_triple {
    uint32_t k[3];
} mesh_triple;
typedef struct mesh_set {
    mesh_triple *triple;
    uint32_t *slot;                /* number + 1 in the bits of slots - 1, else those of the hash
                                      above; 0: free */
    size_t count, capacity, slots; /* slots: 0 or a power of two */
} mesh_set;

static inline uint64_t mesh_hash(mesh_triple t)
{
    uint64_t h = (uint64_t)t.k[0] * 0x9E3779B97F4A7C15u;
    h = (h ^ h >> 32 ^ t.k[1]) * 0xD6E8FEB86659FD93u;
    h = (h ^ h >> 32 ^ t.k[2]) * 0xD6E8FEB86659FD93u;
    return h ^ h >> 32;
}

/* The bits of a hash that a slot has: most triples that differ are told apart without a look at
   them, far away in memory. */
static inline uint32_t mesh_tag(uint64_t hash, size_t slots)
{
    return (uint32_t)(hash >> 32) & ~(uint32_t)(slots - 1);
}

/* 1: the slot has the triple; else *number is of no use. */
static inline int mesh_slot_is(const mesh_set *s, uint32_t slot, mesh_triple t, uint64_t hash,
                               uint32_t *number)
{
    *number = (slot & (uint32_t)(s->slots - 1)) - 1;
    return slot - *number - 1 == mesh_tag(hash, s->slots) &&
           !memcmp(&s->triple[*number], &t, sizeof t);
}

/* Makes room for n triples.  Returns non-zero where memory is out. */
static inline int mesh_set_reserve(mesh_set *s, size_t n)
{
    size_t slots = s->slots ? s->slots : 256;
    uint32_t *slot;
    while (slots / 2 < n && slots <= SIZE_MAX / 8) slots *= 2;
    if (slots == s->slots) return slots / 2 < n;
    slot = (uint32_t *)calloc(slots, sizeof *slot);
    if (!slot) return 1;
    for (size_t i = 0; i < s->count; i++) {
        const uint64_t hash = mesh_hash(s->triple[i]);
        size_t at = (size_t)hash & (slots - 1);
        while (slot[at]) at = (at + 1) & (slots - 1);
        slot[at] = (uint32_t)i + 1 + mesh_tag(hash, slots);
    }
    free(s->slot);
    s->slot = slot;
    s->slots = slots;
    return 0;
}

/* Finds the number of a triple with its hash, and adds the triple if it is new.  Returns non-zero
   where memory is out, or at 2^31 - 1 triples. */
static inline int mesh_set_put(mesh_set *s, mesh_triple t, uint64_t hash, uint32_t *number)
{
    mesh_triple *grown;
    size_t at;
    if (s->count >= INT_MAX || (s->count * 2 >= s->slots && mesh_set_reserve(s, s->count + 1)))
        return 1;
    for (at = (size_t)hash & (s->slots - 1); s->slot[at]; at = (at + 1) & (s->slots - 1))
        if (mesh_slot_is(s, s->slot[at], t, hash, number)) return 0;
    grown = (mesh_triple *)mesh_grow(s->triple, s->count, &s->capacity, sizeof t);
    if (!grown) return 1;
    s->triple = grown;
    *number = (uint32_t)s->count;
    s->triple[s->count++] = t;
    s->slot[at] = *number + 1 + mesh_tag(hash, s->slots);
    return 0;
}

static inline int mesh_set_add(mesh_set *s, mesh_triple t, uint32_t *number)
{
    return mesh_set_put(s, t, mesh_hash(t), number);
}

/* The number of a triple that is there; returns 0 where it is not. */
static inline int mesh_set_find(const mesh_set *s, mesh_triple t, uint32_t *number)
{
    const uint64_t hash = mesh_hash(t);
    size_t at = s->slots ? (size_t)hash & (s->slots - 1) : 0;
    for (; s->slots && s->slot[at]; at = (at + 1) & (s->slots - 1))
        if (mesh_slot_is(s, s->slot[at], t, hash, number)) return 1;
    return 0;
}

/* The triples as floats whose bits they are, to be freed by the caller.  NULL: out of memory */
static inline float *mesh_set_take(mesh_set *s)
{
    float *out = (float *)realloc(s->triple, 3 * (s->count + 1) * sizeof *out);
    s->triple = out ? NULL : s->triple;
    for (size_t i = 0; out && i < 3 * s->count; i++) {
        float v;
        memcpy(&v, out + i, sizeof v);
        out[i] = v; /* what was integers is floats from here on */
    }
    return out;
}

static inline void mesh_set_free(mesh_set *s)
{
    free(s->triple);
    free(s->slot);
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

/* Adds n positions.  Memory far away is asked for all that a block of them needs at once, before
   the first is waited for. */
#if defined(__GNUC__)
#define MESH_FETCH(address) __builtin_prefetch(address)
#else
#define MESH_FETCH(address) ((void)(address))
#endif
enum { MESH_BLOCK = 96 };
static inline int mesh_set_positions(mesh_set *s, const float *p, size_t n, uint32_t *number)
{
    mesh_triple key[MESH_BLOCK];
    uint64_t hash[MESH_BLOCK];
    if (s->count + n >= s->slots / 2 && mesh_set_reserve(s, s->count + n)) return 1;
    for (size_t block = 0; block < n; block += MESH_BLOCK) {
        const size_t size = n - block < MESH_BLOCK ? n - block : MESH_BLOCK;
        for (size_t i = 0; i < size; i++) {
            key[i] = mesh_position_key(p + 3 * (block + i));
            hash[i] = mesh_hash(key[i]);
            MESH_FETCH(&s->slot[(size_t)hash[i] & (s->slots - 1)]);
        }
        for (size_t i = 0; i < size; i++)
            if (mesh_set_put(s, key[i], hash[i], &number[block + i])) return 1;
    }
    return 0;
}

enum { MESH_LARGE = 200000 }; /* triangles, of which small ones are many */

/* Normals of vertices, the mean of their faces' by area: in a large mesh, whose faces at a vertex
   are alike, as good as by angle, in a fifth of the time. */
static inline void mesh_mean_normals(const shade_mesh *m, shade_vec3 *out)
{
    for (int i = 0; i < m->vertex_count; i++) out[i] = shade_v3(0, 0, 0);
    for (int i = 0; i < m->index_count; i += 3) {
        shade_vec3 p[3], n;
        for (int k = 0; k < 3; k++)
            memcpy(&p[k], m->positions + 3 * (size_t)m->indices[i + k], sizeof *p);
        n = shade_cross(shade_sub(p[1], p[0]), shade_sub(p[2], p[0]));
        for (int k = 0; k < 3; k++) out[m->indices[i + k]] = shade_add(out[m->indices[i + k]], n);
    }
    for (int i = 0; i < m->vertex_count; i++) out[i] = shade_normalize(out[i]);
}

/* The greatest coordinate of a corner, whatever its sign */
static inline float mesh_biggest(const owned_mesh *m)
{
    float biggest = 0;
    for (int i = 0; i < m->view.index_count; i++) {
        const float *p = m->positions + 3 * (size_t)m->indices[i];
        for (int k = 0; k < 3; k++)
            if (fabsf(p[k]) > biggest) biggest = fabsf(p[k]);
    }
    return biggest;
}

/* Gives places whose faces cancel out, two sides of a sheet, the normal of one of them. */
static inline void mesh_fill_cancelled(const owned_mesh *m, shade_vec3 *mean)
{
    int some = 0;
    for (int i = 0; i < m->view.vertex_count; i++)
        some |= mean[i].x == 0 && mean[i].y == 0 && mean[i].z == 0;
    for (int i = 0; i < m->view.index_count && some; i++) {
        shade_vec3 *n = &mean[m->indices[i]], p[3];
        if (n->x != 0 || n->y != 0 || n->z != 0) continue;
        for (int k = 0; k < 3; k++)
            memcpy(&p[k], m->positions + 3 * (size_t)m->indices[i - i % 3 + k], sizeof *p);
        *n = shade_face_normal(p[0], p[1], p[2]);
    }
}

/* Fills the normals that are all zero, one normal for each position.  apart: no two vertices have
   the same position. */
static inline int mesh_fill_normals(owned_mesh *m, int apart)
{
    static const mesh_set empty;
    static const owned_mesh nothing;
    const int vertices = m->view.vertex_count, indices = m->view.index_count;
    const float biggest = mesh_biggest(m);
    mesh_set places = empty;
    owned_mesh welded = nothing;
    uint32_t *place = NULL;
    shade_vec3 *mean = NULL;
    size_t count = (size_t)vertices;
    int failed = 1;
    if (!apart) {
        place = (uint32_t *)malloc(sizeof(uint32_t) * count);
        if (!place || mesh_set_positions(&places, m->positions, count, place)) goto done;
        apart = places.count == count;
        count = places.count;
    }
    welded.positions = (float *)malloc(3 * sizeof(float) * count);
    welded.indices = apart ? m->indices : (uint32_t *)malloc(sizeof(uint32_t) * (size_t)indices);
    mean = (shade_vec3 *)malloc(sizeof(shade_vec3) * count);
    if (!welded.positions || !welded.indices || !mean) goto done;
    for (size_t i = 0; i < 3 * count; i++) { /* to 1: squares of any size stay in range */
        float v = m->positions[i];
        if (!apart) memcpy(&v, &places.triple[i / 3].k[i % 3], sizeof v);
        welded.positions[i] = v != 0 && biggest > 0 ? (float)((double)v / (double)biggest) : 0;
    }
    for (int i = 0; i < indices && !apart; i++) welded.indices[i] = place[m->indices[i]];
    mesh_link(&welded, (int)count, indices);
    if (indices / 3 > MESH_LARGE)
        mesh_mean_normals(&welded.view, mean);
    else if (shade_mesh_normals(&welded.view, mean))
        goto done;
    mesh_fill_cancelled(&welded, mean);
    for (int i = 0; i < vertices; i++) {
        float *n = m->normals + 3 * (size_t)i;
        if (n[0] == 0 && n[1] == 0 && n[2] == 0)
            memcpy(n, &mean[apart ? (uint32_t)i : place[i]], sizeof *mean);
    }
    m->apart = apart;
    failed = 0;
done:
    if (apart) welded.indices = NULL;
    free(place);
    free(mean);
    mesh_set_free(&places);
    mesh_free(&welded);
    return failed;
}

/* ---- text: characters, words, numbers ------------------------------------------------------- */

/* The length of the line end at a place: 1 for LF or CR, 2 for CR LF, 0 where there is none */
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
        if (n) {
            r->at += n;
            r->line++;
        } else if (*r->at != ' ' && *r->at != '\t' && *r->at != '\v' && *r->at != '\f') {
            return;
        }
    }
}

/* Skips blanks and line ends. */
static inline void mesh_skip_lines(mesh_reader *r)
{
    for (mesh_skip_blanks(r, 0); mesh_line_end(r, r->at); mesh_skip_blanks(r, 0)) {
        r->at += mesh_line_end(r, r->at);
        r->line++;
    }
}

/* Moves to the beginning of the next line, which is past continued lines where joined is set. */
static inline void mesh_next_line(mesh_reader *r, int joined)
{
    while (r->at < r->end) {
        int n = mesh_line_end(r, r->at), escaped = joined && *r->at == '\\';
        if (escaped) {
            r->at++;
            n = mesh_line_end(r, r->at);
        }
        if (n) {
            r->at += n;
            r->line++;
        } else if (!escaped) {
            r->at++;
        }
        if (n && !escaped) return;
    }
}

static inline int mesh_is_blank(unsigned char c) { return c == ' ' || (c >= '\t' && c <= '\r'); }

static inline int mesh_ends_word(const mesh_reader *r, const unsigned char *p)
{
    return p == r->end || mesh_is_blank(*p) || *p == '#' || (*p == '\\' && mesh_line_end(r, p + 1));
}

static inline int mesh_at_word_end(const mesh_reader *r) { return mesh_ends_word(r, r->at); }

/* Where positions are counted from: coordinates of surveyors are large beside their model, and
   floats have no digits for both.  0, or the whole number below the first position where that is
   farther than 4096. */
typedef struct mesh_origin {
    double at[3];
    int known;
} mesh_origin;

static inline int mesh_finite(const float *p)
{
    return fabsf(p[0]) <= FLT_MAX && fabsf(p[1]) <= FLT_MAX && fabsf(p[2]) <= FLT_MAX;
}

/* Other numbers that are not finite count as 0. */
static inline float mesh_or_zero(double v) { return fabs(v) <= (double)FLT_MAX ? (float)v : 0; }

/* A normal as the file has it, brought to a length of 1 where floats could not square it.  One
   without a direction is 0: it is made anew. */
static inline void mesh_normal(const double *v, float *out)
{
    const double length = fabs(v[0]) + fabs(v[1]) + fabs(v[2]);
    const int wrong = !(length > 0 && length <= DBL_MAX), usual = length > 1e-6 && length < 1e6;
    for (int k = 0; k < 3; k++) out[k] = wrong ? 0 : (float)(usual ? v[k] : v[k] / length);
}

/* A position that is not finite stays so: the faces around it are dropped. */
static inline void mesh_relative(mesh_origin *o, const double *v, float *out)
{
    const int finite = fabs(v[0]) <= DBL_MAX && fabs(v[1]) <= DBL_MAX && fabs(v[2]) <= DBL_MAX;
    for (int k = 0; k < 3 && !o->known && finite; k++)
        if (fabs(v[k]) > 4096 && fabs(v[k]) < 1e12) o->at[k] = floor(v[k]);
    o->known |= finite;
    for (int k = 0; k < 3; k++) {
        const double from = v[k] - o->at[k];
        out[k] = fabs(from) <= (double)FLT_MAX ? (float)from : NAN;
    }
}

/* The bytes behind a byte order mark of UTF-8, which editors of Windows put before text */
static inline const unsigned char *model_text_of(const unsigned char *bytes, size_t *size)
{
    const size_t mark = *size >= 3 && !memcmp(bytes, "\xEF\xBB\xBF", 3) ? 3 : 0;
    *size -= mark;
    return bytes + mark;
}

/* Writes a character as UTF-8, and returns where its bytes end. */
static inline unsigned char *mesh_put_character(unsigned char *to, uint32_t c)
{
    const int more = c < 0x80 ? 0 : c < 0x800 ? 1 : c < 0x10000 ? 2 : 3;
    static const unsigned char first[4] = { 0, 0xC0, 0xE0, 0xF0 };
    *to++ = (unsigned char)(first[more] | c >> 6 * more);
    for (int k = more - 1; k >= 0; k--) *to++ = (unsigned char)(0x80 | (c >> 6 * k & 63));
    return to;
}

/* Text of UTF-16, from its byte order mark on, as UTF-8, to be freed, and its size.  Half of a pair
   becomes U+FFFD.  NULL: out of memory */
static inline unsigned char *mesh_utf8(const unsigned char *bytes, size_t *size)
{
    const size_t low = bytes[0] == 0xFF ? 0 : 1; /* the place of the lower byte of a unit */
    unsigned char *out = (unsigned char *)malloc(*size / 2 * 3 + 1), *to = out;
    uint32_t before = 0; /* the first half of a pair */
    for (size_t i = 2; out && i + 1 < *size; i += 2) {
        const uint32_t unit = bytes[i + low] | (uint32_t)bytes[i + 1 - low] << 8;
        const int second = unit >> 10 == 0x37;
        if (before && !second) to = mesh_put_character(to, 0xFFFD);
        if (before && second)
            to = mesh_put_character(to, 0x10000 + ((before & 1023) << 10) + (unit & 1023));
        else if (unit >> 10 != 0x36)
            to = mesh_put_character(to, second ? 0xFFFD : unit);
        before = unit >> 10 == 0x36 ? unit : 0;
    }
    *size = out ? (size_t)(to - out) : 0;
    return out;
}

/* The next few bytes as printable text, for messages */
typedef struct mesh_quote {
    char text[28];
} mesh_quote;
static inline mesh_quote mesh_here(const mesh_reader *r)
{
    mesh_quote q = { "the end of the line" };
    size_t n = 0;
    const unsigned char *p = r->at;
    if (mesh_at_word_end(r)) return q;
    q.text[n++] = '"';
    for (; p < r->end && !mesh_is_blank(*p) && n < 22; p++)
        q.text[n++] = (char)(*p > 32 && *p < 127 ? *p : '?');
    q.text[n++] = '"';
    q.text[n] = 0;
    return q;
}

/* So many digits of base 16; -1: they are not there */
static inline long long mesh_hex(const unsigned char *at, const unsigned char *end, int digits)
{
    long long code = 0;
    for (int k = 0; k < digits; k++) {
        const int c = at + k < end ? at[k] | 32 : 0;
        const int digit = c >= '0' && c <= '9' ? c - '0' : c >= 'a' && c <= 'f' ? c - 'a' + 10 : -1;
        if (digit < 0) return -1;
        code = code * 16 + digit;
    }
    return code;
}

/* A name where %20 is a blank, without such signs; out may be the name itself. */
static inline void mesh_unescape(const char *name, char *out, size_t room)
{
    for (; *name && room > 1; name++, room--) {
        const unsigned char *digits = (const unsigned char *)name + 1;
        const long long code = *name == '%' ? mesh_hex(digits, digits + 2, 2) : -1;
        *out++ = (char)(code > 0 ? code : *name);
        if (code > 0) name += 2;
    }
    *out = 0;
}

/* Takes the word if it comes next, in capital or small letters. */
static inline int mesh_take_word(mesh_reader *r, const char *word)
{
    const unsigned char *p = r->at;
    for (; *word; word++, p++) {
        int c = p < r->end ? *p : 0;
        if ((c >= 'A' && c <= 'Z' ? c | 32 : c) != *word) return 0;
    }
    if (!mesh_ends_word(r, p)) return 0;
    r->at = p;
    return 1;
}

/* Takes the rest of the line without the blanks around it, and returns where it begins; it ends at
   r->at. */
static inline const unsigned char *mesh_take_line(mesh_reader *r)
{
    const unsigned char *begin, *end;
    mesh_skip_blanks(r, 0);
    begin = end = r->at;
    for (; r->at < r->end && !mesh_line_end(r, r->at); r->at++)
        if (!mesh_is_blank(*r->at)) end = r->at + 1;
    r->at = end;
    return begin;
}

/* A decimal number, independent of the locale.  15 digits and powers up to 22 are exact in
   double, so the float is the nearest in practice; the same on every machine in any case. */
static inline int mesh_take_double(mesh_reader *r, double *out)
{
    static const double ten[] = { 1e1, 1e2, 1e4, 1e8, 1e16, 1e32, 1e64, 1e128, 1e256 };
    const unsigned char *p = r->at, *const end = r->end;
    int negative = 0, digits = 0, point = 0, e = 0, e_negative = 0, e_digits = 0;
    long long scale = 0;
    uint64_t mantissa = 0;
    double value;
    if (p < end && (*p == '-' || *p == '+')) negative = *p++ == '-';
    for (; p < end; p++) {
        const unsigned digit = (unsigned)*p - '0';
        if (digit < 10 && mantissa < 100000000000000000u) {
            mantissa = mantissa * 10 + digit;
            scale -= point;
        } else if (digit < 10) {
            scale += !point;
        } else if (*p == '.' && !point) {
            point = 1;
            continue;
        } else {
            break;
        }
        digits = 1;
    }
    if (digits && p < end && (*p | 32) == 'e') {
        p++;
        if (p < end && (*p == '-' || *p == '+')) e_negative = *p++ == '-';
        for (; p < end && *p >= '0' && *p <= '9'; p++, e_digits = 1)
            if (e < 100000) e = e * 10 + *p - '0';
        digits = e_digits;
    }
    value = (double)mantissa;
    scale += e_negative ? -e : e;
    if (scale > 400) scale = 400;
    if (scale < -400) scale = -400;
    for (int k = 0, n = (int)(scale < 0 ? -scale : scale); n; k++, n >>= 1)
        if (n & 1) value = scale < 0 ? value / ten[k] : value * ten[k];
    if (!digits || value > (double)FLT_MAX || !mesh_ends_word(r, p))
        return mesh_fail(r, "expected a number, found %s", mesh_here(r).text);
    r->at = p;
    *out = negative ? -value : value;
    return 0;
}

/* Takes what C libraries of Windows print for a number that is none: 1.#IND00, 1.#QNAN0, 1.#INF00,
   nan(ind).  The # does not begin a comment there. */
static inline int mesh_take_undefined(mesh_reader *r)
{
    const unsigned char *p = r->at;
    if (r->end - p < 6 || (memcmp(p, "1.#", 3) != 0 && memcmp(p, "nan(", 4) != 0)) return 0;
    if (*p == '1' && memcmp(p + 3, "IN", 2) != 0 && memcmp(p + 4, "NA", 2) != 0) return 0;
    while (r->at < r->end && !mesh_is_blank(*r->at)) r->at++;
    return 1;
}

/* The same for a position, which scanners write as nan, -nan or inf where they saw nothing */
static inline int mesh_take_coordinate(mesh_reader *r, double *out)
{
    const unsigned char *const at = r->at;
    int next; /* words begin with a letter or 1.#: other numbers do not wait for comparisons */
    r->at += at < r->end && (*at == '-' || *at == '+');
    next = r->at < r->end ? *r->at : 0;
    if ((next > '9' || next == '1') &&
        (mesh_take_undefined(r) || mesh_take_word(r, "nan") || mesh_take_word(r, "inf") ||
         mesh_take_word(r, "infinity"))) {
        *out = (double)NAN;
        return 0;
    }
    r->at = at;
    return mesh_take_double(r, out);
}

static inline int mesh_take_number(mesh_reader *r, float *out)
{
    double value = 0;
    if (mesh_take_double(r, &value)) return 1;
    *out = (float)value;
    return 0;
}
#endif
