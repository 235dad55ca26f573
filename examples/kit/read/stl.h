/* stl.h - reads triangles from STL, text or binary.  Equal positions become one vertex; the normals
   of the file are ignored.  Binary files may have a colour for each triangle, in one of two
   dialects that differ in the order of red and blue and in the meaning of the highest bit. */
#ifndef MODEL_STL_H
#define MODEL_STL_H

#include "known.h"

/* Words of text; what is none of them is refused where it stands. */
static const known_name stl_known[] = { { "solid", KNOWN_DRAWN },    { "facet", KNOWN_DRAWN },
                                        { "normal", KNOWN_SILENT },  { "outer", KNOWN_DRAWN },
                                        { "loop", KNOWN_DRAWN },     { "vertex", KNOWN_DRAWN },
                                        { "endloop", KNOWN_DRAWN },  { "endfacet", KNOWN_DRAWN },
                                        { "endsolid", KNOWN_DRAWN }, { "color", KNOWN_TOLD },
                                        { NULL, KNOWN_REFUSED } };

typedef struct stl_data {
    mesh_set places;
    mesh_uints indices;
    mesh_origin origin;         /* of text; binary files hold floats */
    size_t dropped;             /* triangles with a corner that is not finite */
    size_t behind;              /* triangles beyond the count of a binary file */
    mesh_uints word;            /* the last two bytes of each triangle of a binary file, as far as
                                   the last that are not 0 */
    int colored;                /* some say more than nothing */
    FILE *file;                 /* holds what follows the head of a binary file; NULL: it is here */
    unsigned char *piece;       /* of that file */
    const unsigned char *usual; /* the header of Materialise Magics: red, green, blue, alpha behind
                                   COLOR=; NULL: the dialect of VisCAM and SolidView */
} stl_data;

enum { STL_NOWHERE = INT_MAX }; /* the number of a position that is not finite */

static inline int stl_place(mesh_reader *r, stl_data *s, const float *p, uint32_t *number)
{
    *number = STL_NOWHERE;
    if (mesh_finite(p) && mesh_set_add(&s->places, mesh_position_key(p), number))
        return mesh_fail(r, "out of memory");
    return 0;
}

static inline int stl_triangle(mesh_reader *r, stl_data *s, uint32_t a, uint32_t b, uint32_t c)
{
    if (a == STL_NOWHERE || b == STL_NOWHERE || c == STL_NOWHERE) {
        s->dropped++;
        return 0;
    }
    if (mesh_check_triangles(r, s->indices.count / 3 + 1)) return 1;
    return mesh_push_triangle(&s->indices, a, b, c) ? mesh_fail(r, "out of memory") : 0;
}

/* The word of the triangle that was added last; before is how many there were until then: no more
   where it was dropped. */
static inline int stl_word(mesh_reader *r, stl_data *s, size_t before, uint32_t word)
{
    int failed = 0;
    if (!word || before == s->indices.count / 3) return 0;
    s->colored |= s->usual ? word != 0 : word >> 15 != 0;
    while (s->word.count < before && !failed) failed = mesh_push_uint(&s->word, 0);
    return failed || mesh_push_uint(&s->word, word) ? mesh_fail(r, "out of memory") : 0;
}

/* Finds corners that one of the two triangles before has too: of[i] becomes the number of corner i
   among the positions that differ, which move to the front of p.  Returns their number.  Of files
   that are written along strips two thirds need not be looked for in memory far away. */
static inline size_t stl_merge(float *p, size_t corners, unsigned char *of)
{
    uint32_t recent[MESH_BLOCK][3];
    size_t count = 0;
    for (size_t i = 0; i < corners; i++) {
        const size_t begin = i - i % 3, first = begin > 6 ? begin - 6 : 0;
        uint32_t *own = recent[i];
        size_t k = begin;
        memcpy(own, p + 3 * i, sizeof *recent);
        while (k > first && (recent[k - 1][0] != own[0] || recent[k - 1][1] != own[1] ||
                             recent[k - 1][2] != own[2]))
            k--;
        of[i] = k > first ? of[k - 1] : (unsigned char)count;
        if (k > first) continue;
        memmove(p + 3 * count++, p + 3 * i, sizeof *recent);
    }
    return count;
}

/* n triangles of a binary file.  Positions that are finite, nearly all, are added at once. */
enum { STL_BLOCK = MESH_BLOCK / 3 };
static inline int stl_block(mesh_reader *r, stl_data *s, size_t n)
{
    float p[3 * MESH_BLOCK] = { 0 }; /* gcc does not know that n is not 0 */
    uint32_t number[MESH_BLOCK];
    unsigned char of[MESH_BLOCK];
    int finite = 1, failed = 0;
    for (size_t i = 0; i < n; i++)
        for (size_t k = 0; k < 9; k++) {
            p[9 * i + k] = mesh_float(mesh_uint32(r->at + 50 * i + 12 + 4 * k));
            finite &= fabsf(p[9 * i + k]) <= FLT_MAX;
        }
    if (finite && mesh_set_positions(&s->places, p, stl_merge(p, 3 * n, of), number))
        return mesh_fail(r, "out of memory");
    for (size_t i = 0; i < 3 * n && !finite && !failed; i++) {
        of[i] = (unsigned char)i;
        failed = stl_place(r, s, p + 3 * i, &number[i]);
    }
    for (size_t i = 0; i < n && !failed; i++, r->at += 50) {
        const size_t before = s->indices.count / 3;
        const unsigned char *c = of + 3 * i;
        failed = stl_triangle(r, s, number[c[0]], number[c[1]], number[c[2]]) ||
                 stl_word(r, s, before, mesh_uint16(r->at + 48));
    }
    return failed;
}

/* Reads a piece of the file, of which so many triangles are left, where the last piece is used up.
   Pieces are small enough to stay in the processor's caches. */
enum { STL_PIECE = 20 * STL_BLOCK };
static inline int stl_refill(mesh_reader *r, stl_data *s, size_t left)
{
    const size_t n = left < STL_PIECE ? left : STL_PIECE;
    if (!s->file || r->at < r->end) return 0;
    if (!s->piece) s->piece = (unsigned char *)malloc(50 * (size_t)STL_PIECE);
    if (!s->piece) return mesh_fail(r, "out of memory");
    r->before += (double)(r->end - r->begin);
    r->at = r->begin = s->piece;
    r->end = s->piece + 50 * n;
    errno = 0;
    if (fread(s->piece, 50, n, s->file) == n) return 0;
    return mesh_fail(r, "%s", errno ? strerror(errno) : "became shorter while it was read");
}

/* Whether the last two bytes of each triangle say how many bytes of the writer's own follow it, as
   the format once meant them: then the file ends behind the last of these. */
static inline int stl_has_own(const unsigned char *bytes, size_t size)
{
    uint32_t left = size < 84 ? 0 : mesh_uint32(bytes + 80);
    size_t at = 84;
    if (!left || (size - 84) / 50 < left || size - 84 == (size_t)left * 50) return 0;
    for (; left && size - at >= 50; left--) {
        const uint32_t own = mesh_uint16(bytes + at + 48);
        if (size - at - 50 < own) return 0;
        at += 50 + own;
    }
    return !left && at == size;
}

/* 80 bytes of title, a count, then 50 bytes each: normal, three corners (little-endian floats),
   and two, see above */
static inline int stl_read_binary(mesh_reader *r, stl_data *s)
{
    uint64_t size = s->file ? (uint64_t)r->all : (uint64_t)(r->end - r->begin), count, there;
    int own;
    r->line = 0;
    if (size < 84) return mesh_fail(r, "neither text nor binary STL");
    count = mesh_uint32(r->begin + 80);
    there = (size - 84) / 50;
    if (count > there)
        return mesh_fail(r, "ends after %lld of %lld triangles", (long long)there,
                         (long long)count);
    if (!count && (size - 84) % 50 == 0) count = there; /* who writes as it goes, may leave 0 */
    own = !s->file && stl_has_own(r->begin, (size_t)size);
    s->behind = own ? 0 : (size_t)(there - count);
    r->at = r->begin + 84;
    for (const unsigned char *p = r->begin; p < r->begin + 70 && !s->usual; p++)
        if (!memcmp(p, "COLOR=", 6)) s->usual = p + 6;
    s->indices.capacity = 3 * (size_t)(r->most && r->most < count ? r->most : count);
    s->indices.v = (uint32_t *)malloc((s->indices.capacity + 1) * sizeof *s->indices.v);
    if (!s->indices.v || mesh_set_reserve(&s->places, (size_t)count / 2 + 2))
        return mesh_fail(r, "out of memory");
    for (uint64_t i = 0; i < count && own; i++) {
        if (mesh_tell(r, (size_t)i) || stl_block(r, s, 1)) return 1;
        r->at += mesh_uint16(r->at - 2);
    }
    if (own) s->colored = 0; /* those bytes are no colours */
    for (uint64_t i = 0; i < count && !own; i += STL_BLOCK)
        if (mesh_tell(r, (size_t)i) || stl_refill(r, s, (size_t)(count - i)) ||
            stl_block(r, s, count - i < STL_BLOCK ? (size_t)(count - i) : STL_BLOCK))
            return 1;
    return 0;
}

static inline int stl_vertex(mesh_reader *r, stl_data *s, uint32_t *number)
{
    double v[3];
    float p[3];
    for (int k = 0; k < 3; k++) {
        mesh_skip_lines(r);
        if (mesh_take_coordinate(r, &v[k])) return 1;
    }
    mesh_relative(&s->origin, v, p);
    return stl_place(r, s, p, number);
}

/* Takes a word, endsolid and its like also in two: end solid. */
static inline int stl_take(mesh_reader *r, const char *word)
{
    mesh_reader two = *r;
    if (mesh_take_word(r, word)) return 1;
    if (memcmp(word, "end", 3) != 0 || !mesh_take_word(&two, "end")) return 0;
    mesh_skip_blanks(&two, 0);
    if (!mesh_take_word(&two, word + 3)) return 0;
    *r = two;
    return 1;
}

static inline int stl_expect(mesh_reader *r, const char *word)
{
    mesh_skip_lines(r);
    if (stl_take(r, word)) return 0;
    return mesh_fail(r, "expected %s, found %s", word, mesh_here(r).text);
}

/* A colour by facet, a number whose meaning no description of the format has, behind its end */
static inline int stl_color_word(mesh_reader *r, model *m)
{
    mesh_skip_blanks(r, 0);
    if (!mesh_take_word(r, "color")) return 0;
    mesh_take_line(r);
    return known_take(r, m, KNOWN_TOLD, 0, "color", 5);
}

/* Reads what follows the word facet: a normal (any three words), a loop of corners, the ends. */
static inline int stl_facet(mesh_reader *r, stl_data *s, model *m)
{
    uint32_t first = 0, previous = 0, corner = 0;
    int corners = 0;
    if (stl_expect(r, "normal")) return 1;
    for (int k = 0; k < 3; k++)
        for (mesh_skip_lines(r); r->at < r->end && !mesh_is_blank(*r->at);) r->at++;
    if (stl_expect(r, "outer") || stl_expect(r, "loop")) return 1;
    for (mesh_skip_lines(r); mesh_take_word(r, "vertex"); mesh_skip_lines(r), previous = corner) {
        if (stl_vertex(r, s, &corner)) return 1;
        if (corners < 3) corners++;
        if (corners == 1) first = corner;
        if (corners == 3 && stl_triangle(r, s, first, previous, corner)) return 1;
    }
    if (corners < 3) return mesh_fail(r, "expected a vertex, found %s", mesh_here(r).text);
    return stl_expect(r, "endloop") || stl_expect(r, "endfacet") || stl_color_word(r, m);
}

/* Skips a name, which ends with its line or where a facet with a normal begins: some files are one
   line. */
static inline void stl_name(mesh_reader *r)
{
    for (; r->at < r->end && !mesh_line_end(r, r->at); r->at++) {
        mesh_reader ahead = *r;
        char unheard[4];
        float number;
        ahead.error = unheard;
        ahead.error_size = sizeof unheard;
        if (!mesh_is_blank(r->at[-1]) || !mesh_take_word(&ahead, "facet")) continue;
        mesh_skip_blanks(&ahead, 0);
        if (!mesh_take_word(&ahead, "normal")) continue;
        mesh_skip_blanks(&ahead, 0);
        if (!mesh_take_number(&ahead, &number)) return;
    }
}

static inline int stl_read_text(mesh_reader *r, stl_data *s, model *m)
{
    for (size_t facets = 0;;) {
        mesh_skip_lines(r);
        if (r->at == r->end) return 0;
        if (mesh_take_word(r, "facet")) {
            if (mesh_tell(r, facets++) || stl_facet(r, s, m)) return 1;
        } else if (mesh_take_word(r, "solid") || stl_take(r, "endsolid")) {
            stl_name(r);
        } else {
            return mesh_fail(r, "expected facet, found %s", mesh_here(r).text);
        }
    }
}

/* Whether the bytes are as many as the count of a binary file says */
static inline int stl_fits(const unsigned char *bytes, size_t size)
{
    return size >= 84 && (size - 84) % 50 == 0 && (size - 84) / 50 == mesh_uint32(bytes + 80);
}

/* Whether bytes of which nobody says what they are may be a binary file that is cut off, or has
   more behind its triangles: bytes that no text has, and a count that is near */
static inline int stl_seems(const unsigned char *bytes, size_t size)
{
    const size_t there = size < 84 ? 0 : (size - 84) / 50;
    const uint32_t count = there ? mesh_uint32(bytes + 80) : 0;
    return count && memchr(bytes, 0, size < 1024 ? size : 1024) && count / 2 <= there &&
           there / 2 <= count;
}

/* Binary where the size fits the count to the byte; then text where no zero byte is near.  Bytes
   that fill up the end of text, zeros and Ctrl-Z, are no longer the reader's then. */
static inline int stl_is_text(mesh_reader *r)
{
    const size_t size = (size_t)(r->end - r->begin);
    const unsigned char *end = r->end;
    size_t head;
    while (end > r->begin && (!end[-1] || end[-1] == 26)) end--;
    head = end - r->begin < 1024 ? (size_t)(end - r->begin) : 1024;
    if (stl_fits(r->begin, size) || memchr(r->begin, 0, head)) return 0;
    r->end = end;
    return 1;
}

/* The colour of a word: with the highest bit triangles of Magics have the usual one, those of the
   other dialect one of their own. */
static inline shade_vec3 stl_color(const stl_data *s, uint32_t word)
{
    const float low = (float)(word & 31) / 31, high = (float)(word >> 10 & 31) / 31;
    const float green = (float)(word >> 5 & 31) / 31;
    shade_vec3 c = s->usual ? shade_v3(low, green, high) : shade_v3(high, green, low);
    const int own = (word >> 15 != 0) == !s->usual;
    if (!own && !s->usual) c = shade_v3(0.75f, 0.75f, 0.75f);
    if (!own && s->usual)
        c = shade_v3((float)s->usual[0] / 255, (float)s->usual[1] / 255, (float)s->usual[2] / 255);
    return shade_linear_from_srgb(c);
}

/* Gives each place a vertex for each colour that its triangles have. */
static inline int stl_paint(const stl_data *s, model *out)
{
    static const mesh_set empty;
    owned_mesh *m = &out->mesh;
    mesh_set vertices = empty;
    float *positions, *normals;
    int failed = model_add_surface(out, "", 0) < 0;
    if (failed) return 1;
    out->surface->material.diffuse = out->surface->material.ambient = shade_v3(1, 1, 1);
    out->surface->set = 1;
    for (int i = 0; i < m->view.index_count && !failed; i++) {
        const size_t t = (size_t)i / 3;
        const mesh_triple key = { { m->indices[i], t < s->word.count ? s->word.v[t] : 0, 0 } };
        failed = mesh_set_add(&vertices, key, &m->indices[i]);
    }
    positions = (float *)malloc((vertices.count + 1) * 12);
    normals = (float *)calloc(vertices.count + 1, 12);
    m->colors = (float *)malloc((vertices.count + 1) * 12);
    failed |= !positions || !normals || !m->colors;
    for (size_t i = 0; i < vertices.count && !failed; i++) {
        const shade_vec3 c = stl_color(s, vertices.triple[i].k[1]);
        memcpy(positions + 3 * i, m->positions + 3 * (size_t)vertices.triple[i].k[0], 12);
        memcpy(m->colors + 3 * i, &c, sizeof c);
    }
    free(m->positions);
    free(m->normals);
    m->positions = positions;
    m->normals = normals;
    mesh_link(m, (int)vertices.count, m->view.index_count);
    mesh_set_free(&vertices);
    return failed;
}

/* file: NULL, or r has the head alone of a binary file that fits its count, and what follows is
   read from there. */
static inline int stl_read(mesh_reader *r, model *out, FILE *file)
{
    owned_mesh *m = &out->mesh;
    static const stl_data empty;
    stl_data s = empty;
    const int is_text = !file && stl_is_text(r);
    int failed;
    s.file = file;
    if (is_text) model_place(out, &s.origin);
    failed = is_text ? stl_read_text(r, &s, out) : stl_read_binary(r, &s);
    if (!failed && !s.indices.count)
        failed = mesh_fail(r, s.dropped ? "no triangle of it has corners that are all finite"
                                        : "no triangles in it");
    free(s.piece);
    if (!failed) {
        size_t n = s.places.count;
        free(s.places.slot);
        s.places.slot = NULL;
        m->positions = mesh_set_take(&s.places);
        m->normals = (float *)calloc(n, 3 * sizeof(float));
        m->indices = s.indices.v;
        s.indices.v = NULL;
        mesh_link(m, (int)n, (int)s.indices.count);
        model_placed(out, &s.origin);
        model_warn_dropped(out, r->name, s.dropped, "triangles have corners");
        if (s.behind) {
            char text[80];
            snprintf(text, sizeof text, "%lu triangles beyond the %lu that it counts",
                     (unsigned long)s.behind, (unsigned long)(s.dropped + s.indices.count / 3));
            model_leave_out(out, r->name, text);
        }
        failed = !m->positions || !m->normals || (s.colored && stl_paint(&s, out)) ||
                 mesh_fill_normals(m, !s.colored);
        if (failed) mesh_fail(r, "out of memory");
    }
    mesh_set_free(&s.places);
    free(s.indices.v);
    free(s.word.v);
    return failed;
}
#endif
