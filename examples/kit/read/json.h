/* json.h - reads JSON as RFC 8259 has it, and nothing else: no comments, no trailing commas, no
   bytes behind the value.  The result is one flat array of values in the order of the text:

       { "a": [1, 2], "b": true }    gives    null, object, text a, array, 1, 2, text b, true

   Each value knows the place behind its last part, so that a walk skips what it does not want.
   Place 1 is the whole text.  Place 0 is null, and the answer where there is no such value: it has
   no members, so that answers need no check before the next question. */
#ifndef MODEL_JSON_H
#define MODEL_JSON_H

#include "reader.h"

typedef enum json_kind {
    JSON_NULL,
    JSON_FALSE,
    JSON_TRUE,
    JSON_NUMBER,
    JSON_TEXT,
    JSON_ARRAY,
    JSON_OBJECT
} json_kind;

typedef struct json_value {
    json_kind kind;
    uint32_t end;        /* the place behind it and its parts */
    uint32_t count;      /* of the parts: a member of an object is two, its name and its value */
    uint32_t from, size; /* its bytes in the text; of a text those between the quotation marks */
} json_value;

typedef struct json_doc {
    const unsigned char *text;
    json_value *value;
    size_t count, room;
} json_doc;

enum { JSON_ROOT = 1, JSON_DEPTH = 100 };

static inline void json_skip(mesh_reader *r)
{
    for (; r->at < r->end; r->at++) {
        if (*r->at == '\n')
            r->line += r->line > 0;
        else if (*r->at != ' ' && *r->at != '\t' && *r->at != '\r')
            return;
    }
}

static inline int json_wrong(mesh_reader *r, const char *wanted)
{
    return mesh_fail(r, "its JSON is wrong: expected %s, found %s", wanted,
                     r->at < r->end ? mesh_here(r).text : "the end");
}

/* Appends a value that begins here.  Returns non-zero where memory is out. */
static inline int json_begin(mesh_reader *r, json_doc *j, json_kind kind)
{
    json_value *grown = (json_value *)mesh_grow(j->value, j->count, &j->room, sizeof *grown);
    const json_value fresh = { kind, 0, 0, (uint32_t)(r->at - j->text), 0 };
    if (!grown) return mesh_fail(r, "out of memory");
    j->value = grown;
    j->value[j->count++] = fresh;
    return 0;
}

static inline int json_digits(mesh_reader *r)
{
    const unsigned char *from = r->at;
    while (r->at < r->end && *r->at >= '0' && *r->at <= '9') r->at++;
    return r->at > from;
}

/* -1.5e+3: no zero before another digit, a digit on each side of a point */
static inline int json_take_number(mesh_reader *r)
{
    r->at += r->at < r->end && *r->at == '-';
    if (r->at < r->end && *r->at == '0')
        r->at++;
    else if (!json_digits(r))
        return json_wrong(r, "a number");
    if (r->at < r->end && *r->at == '.') {
        r->at++;
        if (!json_digits(r)) return json_wrong(r, "a digit");
    }
    if (r->at < r->end && (*r->at | 32) == 'e') {
        r->at++;
        r->at += r->at < r->end && (*r->at == '-' || *r->at == '+');
        if (!json_digits(r)) return json_wrong(r, "a digit");
    }
    return 0;
}

static inline int json_take_text(mesh_reader *r)
{
    for (r->at++; r->at < r->end && *r->at != '"'; r->at++) {
        if (*r->at < ' ') return json_wrong(r, "a text without control characters");
        if (*r->at != '\\') continue;
        r->at++;
        if (r->at == r->end || !*r->at || !strchr("\"\\/bfnrtu", *r->at))
            return json_wrong(r, "one of \"\\/bfnrtu");
        if (*r->at == 'u' && mesh_hex(r->at + 1, r->end, 4) < 0)
            return json_wrong(r, "four digits of base 16");
    }
    if (r->at == r->end) return json_wrong(r, "a quotation mark");
    r->at++;
    return 0;
}

static inline int json_word(mesh_reader *r, const char *word)
{
    const size_t n = strlen(word);
    if ((size_t)(r->end - r->at) < n || memcmp(r->at, word, n) != 0)
        return json_wrong(r, "a value");
    r->at += n;
    return 0;
}

static inline int json_value_at(mesh_reader *r, json_doc *j, int depth);

/* The parts of an array, or the members of an object, up to the bracket that closes it */
static inline int json_parts(mesh_reader *r, json_doc *j, int is_object, int depth)
{
    const size_t own = j->count - 1;
    const unsigned char close = is_object ? '}' : ']';
    r->at++;
    json_skip(r);
    if (r->at < r->end && *r->at == close) {
        r->at++;
        return 0;
    }
    for (;;) {
        if (is_object) {
            if (r->at == r->end || *r->at != '"') return json_wrong(r, "a name");
            if (json_value_at(r, j, depth + 1)) return 1;
            if (r->at == r->end || *r->at != ':') return json_wrong(r, "a colon");
            r->at++;
        }
        if (json_value_at(r, j, depth + 1)) return 1;
        j->value[own].count += is_object ? 2 : 1;
        if (r->at < r->end && *r->at == close) break;
        if (r->at == r->end || *r->at != ',') return json_wrong(r, "a comma");
        r->at++;
        json_skip(r);
    }
    r->at++;
    return 0;
}

/* A value with the blanks around it */
static inline int json_value_at(mesh_reader *r, json_doc *j, int depth)
{
    const size_t own = j->count;
    int failed, c;
    json_skip(r);
    c = r->at < r->end ? *r->at : 0;
    if (depth > JSON_DEPTH) return mesh_fail(r, "its JSON is more than %d deep", JSON_DEPTH);
    if (json_begin(r, j,
                   c == '{'   ? JSON_OBJECT
                   : c == '[' ? JSON_ARRAY
                   : c == '"' ? JSON_TEXT
                   : c == 't' ? JSON_TRUE
                   : c == 'f' ? JSON_FALSE
                   : c == 'n' ? JSON_NULL
                              : JSON_NUMBER))
        return 1;
    if (c == '{' || c == '[')
        failed = json_parts(r, j, c == '{', depth);
    else if (c == '"')
        failed = json_take_text(r);
    else if (c == 't' || c == 'f' || c == 'n')
        failed = json_word(r, c == 't' ? "true" : c == 'f' ? "false" : "null");
    else
        failed = json_take_number(r);
    if (failed) return 1;
    j->value[own].size = (uint32_t)(r->at - j->text) - j->value[own].from;
    if (c == '"') {
        j->value[own].from++;
        j->value[own].size -= 2;
    }
    j->value[own].end = (uint32_t)j->count;
    json_skip(r);
    return 0;
}

/* All of the text of a reader.  Free value when it is not needed any more, also after a failure. */
static inline int json_read(mesh_reader *r, json_doc *j)
{
    static const json_doc empty;
    *j = empty;
    j->text = r->at;
    if (r->end - r->at > 0x7FFFFFFF) return mesh_fail(r, "its JSON is larger than 2 GB");
    if (json_begin(r, j, JSON_NULL)) return 1;
    j->value->end = JSON_ROOT;
    if (json_value_at(r, j, 0)) return 1;
    return r->at < r->end ? json_wrong(r, "the end") : 0;
}

/* ---- answers --------------------------------------------------------------------------------- */

static inline char *json_copy(const json_doc *j, uint32_t at);

/* 1: the value is that text, which has no escapes; the file's may have. */
static inline int json_is(const json_doc *j, uint32_t at, const char *text)
{
    const json_value *v = &j->value[at];
    const size_t n = strlen(text);
    char *plain;
    int same;
    if (v->kind != JSON_TEXT || v->size < n) return 0;
    if (v->size == n) return !memcmp(j->text + v->from, text, n);
    if (!memchr(j->text + v->from, '\\', v->size)) return 0;
    plain = json_copy(j, at);
    same = plain && !strcmp(plain, text);
    free(plain);
    return same;
}

/* The member of an object; 0: none, or no object.  Of two of one name the first counts. */
static inline uint32_t json_member(const json_doc *j, uint32_t object, const char *name)
{
    const json_value *v = &j->value[object];
    uint32_t at = object + 1;
    if (v->kind != JSON_OBJECT) return 0;
    for (uint32_t i = 0; i < v->count; i += 2, at = j->value[at + 1].end)
        if (json_is(j, at, name)) return at + 1;
    return 0;
}

/* The same where it has a kind */
static inline uint32_t json_of(const json_doc *j, uint32_t object, const char *name, json_kind kind)
{
    const uint32_t at = json_member(j, object, name);
    return at && j->value[at].kind == kind ? at : 0;
}

/* The number at a place; none where it is no number that a float holds */
static inline double json_number_at(const json_doc *j, uint32_t at, double none)
{
    const json_value *v = &j->value[at];
    mesh_reader r = mesh_of(j->text + v->from, v->size, "", NULL, 0);
    double value = none;
    if (!at || v->kind != JSON_NUMBER || mesh_take_double(&r, &value)) return none;
    return value;
}

static inline double json_number_of(const json_doc *j, uint32_t object, const char *name,
                                    double none)
{
    return json_number_at(j, json_member(j, object, name), none);
}

/* Up to n numbers of an array into out, which keeps what it has where there are others or fewer.
   Returns 1 where there are n. */
static inline int json_array(const json_doc *j, uint32_t object, const char *name, double *out,
                             int n)
{
    const uint32_t array = json_of(j, object, name, JSON_ARRAY);
    double value[16];
    if (!array || j->value[array].count != (uint32_t)n || n > 16) return 0;
    for (int i = 0; i < n; i++) {
        const uint32_t at = array + 1 + (uint32_t)i;
        if (j->value[at].kind != JSON_NUMBER) return 0;
        value[i] = json_number_at(j, at, HUGE_VAL);
        if (!(fabs(value[i]) < 1e30)) return 0;
    }
    memcpy(out, value, (size_t)n * sizeof *out);
    return 1;
}

static inline char *json_utf8(char *to, unsigned code)
{
    if (code < 0x80)
        *to++ = (char)code;
    else if (code < 0x800)
        *to++ = (char)(0xC0 | code >> 6);
    else if (code < 0x10000)
        *to++ = (char)(0xE0 | code >> 12);
    else
        *to++ = (char)(0xF0 | code >> 18);
    if (code >= 0x10000) *to++ = (char)(0x80 | (code >> 12 & 63));
    if (code >= 0x800) *to++ = (char)(0x80 | (code >> 6 & 63));
    if (code >= 0x80) *to++ = (char)(0x80 | (code & 63));
    return to;
}

/* A copy of a text with its escapes undone, "" where it is none.  NULL: out of memory */
static inline char *json_copy(const json_doc *j, uint32_t at)
{
    const json_value *v = &j->value[at];
    const int is_text = at && v->kind == JSON_TEXT;
    const unsigned char *from = j->text + v->from, *end = from + (is_text ? v->size : 0);
    char *text = (char *)malloc((size_t)(end - from) + 1), *to = text;
    while (text && from < end) {
        static const char *const escapes = "bfnrt", *const means = "\b\f\n\r\t";
        unsigned code;
        int low;
        if (*from != '\\') {
            *to++ = (char)*from++;
            continue;
        }
        from += 2;
        if (from[-1] != 'u') {
            const char *known = strchr(escapes, from[-1]);
            *to++ = known ? means[known - escapes] : (char)from[-1];
            continue;
        }
        code = (unsigned)mesh_hex(from, end, 4);
        from += 4;
        low = end - from > 5 && from[0] == '\\' && from[1] == 'u' ? (int)mesh_hex(from + 2, end, 4)
                                                                  : -1;
        if (code >= 0xD800 && code < 0xDC00 && low >= 0xDC00 && low < 0xE000) {
            code = 0x10000 + ((code - 0xD800) << 10) + ((unsigned)low - 0xDC00);
            from += 6;
        } else if (code >= 0xD800 && code < 0xE000) {
            code = 0xFFFD; /* half of a pair */
        }
        to = json_utf8(to, code ? code : 0xFFFD);
    }
    if (text) *to = 0;
    return text;
}
#endif
