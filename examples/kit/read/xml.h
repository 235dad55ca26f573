/* xml.h - reads XML one element at a time: elements with their attributes and name spaces, and
   past texts, comments and instructions.  What is not well formed is refused, and so are document
   types, so that no entity can grow.

       xml x = xml_new(r, spaces);
       while (xml_inside(&x, 0))               the root
           if (xml_is(&x, 0, "model"))
               while (xml_inside(&x, 1)) ...   what stands in it; what you do not enter is passed
       if (x.failed) ...

   An attribute without a prefix is in no name space. */
#ifndef MODEL_XML_H
#define MODEL_XML_H

#include "reader.h"

enum { XML_DEPTH = 64, XML_ATTRIBUTES = 64, XML_BINDINGS = 64, XML_NO_SPACE = -1, XML_OTHER = -2 };

typedef struct xml_text { /* a piece of the file */
    const unsigned char *at;
    size_t size;
} xml_text;

typedef struct xml_attribute {
    xml_text prefix, name, value;
    int space;
} xml_attribute;

typedef struct xml_binding { /* of a prefix to a name space, in an element of that depth */
    xml_text prefix, uri;
    int depth, space;
} xml_binding;

typedef struct xml {
    mesh_reader *r;
    const char *const *spaces; /* those that have a number, the last one NULL */
    int depth, empty, roots, failed;
    xml_text open[XML_DEPTH]; /* with their prefixes */
    xml_text prefix, name;    /* of the last element, and its name space */
    int space;
    xml_attribute attribute[XML_ATTRIBUTES];
    xml_binding binding[XML_BINDINGS];
    int attributes, bindings;
} xml;

static inline int xml_same(xml_text a, xml_text b)
{
    return a.size == b.size && (!a.size || !memcmp(a.at, b.at, a.size));
}

static inline int xml_equals(xml_text a, const char *text)
{
    return a.size == strlen(text) && !memcmp(a.at, text, a.size);
}

static inline int xml_wrong(xml *x, const char *wanted)
{
    mesh_reader *r = x->r;
    x->failed = 1;
    return mesh_fail(r, "its XML is wrong: expected %s, found %s", wanted,
                     r->at < r->end ? mesh_here(r).text : "the end");
}

/* 1: that text comes next. */
static inline int xml_next(const xml *x, const char *text)
{
    const size_t n = strlen(text);
    return (size_t)(x->r->end - x->r->at) >= n && !memcmp(x->r->at, text, n);
}

static inline int xml_skip(mesh_reader *r)
{
    const unsigned char *from = r->at;
    for (; r->at < r->end; r->at++) {
        if (*r->at == '\n')
            r->line++;
        else if (*r->at != ' ' && *r->at != '\t' && *r->at != '\r')
            break;
    }
    return r->at > from;
}

/* Moves behind the next end of a comment, an instruction or the like. */
static inline int xml_pass(xml *x, const char *end)
{
    for (; x->r->at < x->r->end; x->r->at++) {
        if (*x->r->at == (unsigned char)*end && xml_next(x, end)) {
            x->r->at += strlen(end);
            return 0;
        }
        x->r->line += *x->r->at == '\n';
    }
    return xml_wrong(x, end);
}

/* One of the five entities, or the number of a character */
static inline int xml_entity(xml *x)
{
    static const char *const known[] = { "&amp;", "&lt;", "&gt;", "&quot;", "&apos;" };
    const unsigned char *at = x->r->at + 2;
    for (int k = 0; k < 5; k++) {
        if (!xml_next(x, known[k])) continue;
        x->r->at += strlen(known[k]);
        return 0;
    }
    if (!xml_next(x, "&#")) return xml_wrong(x, "an entity that is known");
    while (at < x->r->end && at - x->r->at < 10 && strchr("0123456789abcdefABCDEFx", *at) && *at)
        at++;
    if (at == x->r->end || *at != ';') return xml_wrong(x, "the number of a character");
    x->r->at = at + 1;
    return 0;
}

/* Text up to one of two characters */
static inline int xml_take_text(xml *x, unsigned char end, xml_text *out)
{
    mesh_reader *r = x->r;
    out->at = r->at;
    while (r->at < r->end && *r->at != end && *r->at != '<') {
        if (*r->at == '&') {
            if (xml_entity(x)) return 1;
            continue;
        }
        if (*r->at < ' ' && !mesh_is_blank(*r->at)) return xml_wrong(x, "a character of text");
        r->line += *r->at == '\n';
        r->at++;
    }
    out->size = (size_t)(r->at - out->at);
    return 0;
}

static inline int xml_is_letter(unsigned char c)
{
    return ((c | 32) >= 'a' && (c | 32) <= 'z') || c == '_' || c > 127;
}

static inline int xml_is_inner(unsigned char c)
{
    return xml_is_letter(c) || (c >= '0' && c <= '9') || c == '-' || c == '.';
}

/* A name, with what stands before its colon in prefix */
static inline int xml_take_name(xml *x, xml_text *prefix, xml_text *name)
{
    mesh_reader *r = x->r;
    prefix->at = r->at;
    prefix->size = 0;
    for (;;) {
        name->at = r->at;
        if (r->at == r->end || !xml_is_letter(*r->at)) return xml_wrong(x, "a name");
        while (r->at < r->end && xml_is_inner(*r->at)) r->at++;
        name->size = (size_t)(r->at - name->at);
        if (r->at == r->end || *r->at != ':' || prefix->size) return 0;
        prefix->size = name->size;
        r->at++;
    }
}

static inline int xml_take_attribute(xml *x)
{
    mesh_reader *r = x->r;
    xml_attribute *a = &x->attribute[x->attributes];
    unsigned char quote;
    if (x->attributes == XML_ATTRIBUTES) return xml_wrong(x, "fewer attributes");
    if (xml_take_name(x, &a->prefix, &a->name)) return 1;
    for (int i = 0; i < x->attributes; i++)
        if (xml_same(x->attribute[i].name, a->name) && xml_same(x->attribute[i].prefix, a->prefix))
            return xml_wrong(x, "an attribute once");
    xml_skip(r);
    if (r->at == r->end || *r->at != '=') return xml_wrong(x, "=");
    r->at++;
    xml_skip(r);
    if (r->at == r->end || (*r->at != '"' && *r->at != '\''))
        return xml_wrong(x, "a quotation mark");
    quote = *r->at++;
    if (xml_take_text(x, quote, &a->value)) return 1;
    if (r->at == r->end || *r->at != quote) return xml_wrong(x, "a quotation mark");
    r->at++;
    x->attributes++;
    return 0;
}

/* What a prefix is bound to, the innermost one; XML_NO_SPACE where nothing is, which only no prefix
   at all may have */
static inline int xml_bound(const xml *x, xml_text prefix)
{
    for (int i = x->bindings - 1; i >= 0; i--)
        if (xml_same(x->binding[i].prefix, prefix)) return x->binding[i].space;
    return XML_NO_SPACE;
}

/* The URI that a prefix is bound to; empty: none */
static inline xml_text xml_uri(const xml *x, xml_text prefix)
{
    const xml_text none = { NULL, 0 };
    for (int i = x->bindings - 1; i >= 0; i--)
        if (xml_same(x->binding[i].prefix, prefix)) return x->binding[i].uri;
    return none;
}

/* Notes xmlns="..." and xmlns:p="...", which count for this element too. */
static inline int xml_bind(xml *x)
{
    for (int i = 0; i < x->attributes; i++) {
        const xml_attribute *a = &x->attribute[i];
        const xml_text none = { NULL, 0 };
        const int usual = !a->prefix.size && xml_equals(a->name, "xmlns");
        xml_binding *b = &x->binding[x->bindings];
        if (!usual && !xml_equals(a->prefix, "xmlns")) continue;
        if (x->bindings == XML_BINDINGS) return xml_wrong(x, "fewer name spaces");
        b->prefix = usual ? none : a->name;
        b->uri = a->value;
        b->depth = x->depth;
        b->space = a->value.size ? XML_OTHER : XML_NO_SPACE;
        for (int k = 0; x->spaces[k]; k++)
            if (xml_equals(a->value, x->spaces[k])) b->space = k;
        x->bindings++;
    }
    return 0;
}

/* An element, from its name on */
static inline int xml_open(xml *x)
{
    mesh_reader *r = x->r;
    const xml_text whole = { r->at, 0 };
    if (x->depth == XML_DEPTH) return xml_wrong(x, "fewer elements in each other");
    x->open[x->depth] = whole;
    if (xml_take_name(x, &x->prefix, &x->name)) return 1;
    x->open[x->depth++].size = (size_t)(r->at - whole.at);
    x->roots += x->depth == 1;
    if (x->roots > 1) return xml_wrong(x, "one element around all others");
    x->attributes = 0;
    for (;;) {
        const int blank = xml_skip(r);
        if (r->at < r->end && *r->at == '>') break;
        if (xml_next(x, "/>")) {
            x->empty = 1;
            r->at++;
            break;
        }
        if (!blank) return xml_wrong(x, "a blank or >");
        if (xml_take_attribute(x)) return 1;
    }
    r->at++;
    if (xml_bind(x)) return 1;
    x->space = xml_bound(x, x->prefix);
    for (int i = 0; i < x->attributes; i++) {
        xml_attribute *a = &x->attribute[i];
        a->space = a->prefix.size ? xml_bound(x, a->prefix) : XML_NO_SPACE;
    }
    return 0;
}

/* Gives the element that was opened last, which has no prefix and no name space, that one, and with
   it what stands inside.  Non-zero: there is no room. */
static inline int xml_assume(xml *x, int space)
{
    static const xml_binding usual;
    if (x->bindings == XML_BINDINGS) return 1;
    x->binding[x->bindings] = usual;
    x->binding[x->bindings].depth = x->depth;
    x->binding[x->bindings++].space = x->space = space;
    return 0;
}

static inline void xml_leave(xml *x)
{
    while (x->bindings && x->binding[x->bindings - 1].depth == x->depth) x->bindings--;
    x->depth--;
}

static inline int xml_close(xml *x)
{
    mesh_reader *r = x->r;
    xml_text prefix, name, whole = { r->at, 0 };
    if (xml_take_name(x, &prefix, &name)) return 1;
    whole.size = (size_t)(r->at - whole.at);
    if (!x->depth || !xml_same(whole, x->open[x->depth - 1])) {
        r->at = whole.at;
        return xml_wrong(x, "the end of another element");
    }
    xml_skip(r);
    if (r->at == r->end || *r->at != '>') return xml_wrong(x, ">");
    r->at++;
    xml_leave(x);
    return 0;
}

/* What is neither the begin nor the end of an element */
static inline int xml_other(xml *x)
{
    xml_text text;
    if (xml_next(x, "<!--")) {
        x->r->at += 4;
        return xml_pass(x, "-->");
    }
    if (xml_next(x, "<?")) return xml_pass(x, "?>");
    if (x->depth && xml_next(x, "<![CDATA[")) return xml_pass(x, "]]>");
    if (*x->r->at == '<') {
        x->failed = 1;
        return mesh_fail(x->r, "document types and entities are refused");
    }
    if (xml_skip(x->r)) return 0;
    return x->depth ? xml_take_text(x, '<', &text) : xml_wrong(x, "an element");
}

static inline xml xml_new(mesh_reader *r, const char *const *spaces)
{
    static const xml empty;
    xml x = empty;
    x.r = r;
    x.spaces = spaces;
    return x;
}

/* Moves to the next element in the one of that depth, which is open.  0: that one has ended, or
   failed is set, with the error in r. */
static inline int xml_inside(xml *x, int depth)
{
    mesh_reader *r = x->r;
    while (!x->failed) {
        if (x->empty) {
            x->empty = 0;
            xml_leave(x);
            if (x->depth < depth) return 0;
        }
        if (r->at == r->end) {
            if (x->depth || !x->roots) xml_wrong(x, "the end of an element");
            return 0;
        }
        if (*r->at != '<' || (r->end - r->at > 1 && (r->at[1] == '!' || r->at[1] == '?'))) {
            xml_other(x);
        } else if (xml_next(x, "</")) {
            r->at += 2;
            if (!xml_close(x) && x->depth < depth) return 0;
        } else {
            r->at++;
            if (!xml_open(x) && x->depth == depth + 1) return 1;
        }
    }
    return 0;
}

/* ---- answers --------------------------------------------------------------------------------- */

static inline int xml_is(const xml *x, int space, const char *name)
{
    return x->space == space && xml_equals(x->name, name);
}

/* The value of an attribute, without blanks around it; at is NULL where there is none. */
static inline xml_text xml_value(const xml *x, int space, const char *name)
{
    xml_text value = { NULL, 0 };
    for (int i = 0; i < x->attributes; i++) {
        const xml_attribute *a = &x->attribute[i];
        if (a->space != space || !xml_equals(a->name, name)) continue;
        value = a->value;
        while (value.size && mesh_is_blank(*value.at)) {
            value.at++;
            value.size--;
        }
        while (value.size && mesh_is_blank(value.at[value.size - 1])) value.size--;
    }
    return value;
}

/* Fails with a line about an attribute of this element. */
static inline int xml_fail(xml *x, const char *name, const char *what)
{
    x->failed = 1;
    return mesh_fail(x->r, "%s of %.*s %s", name, (int)(x->name.size < 40 ? x->name.size : 40),
                     (const char *)x->name.at, what);
}

/* The numbers of a value, one after the other, each of which moves its begin: 1: a number; 0: there
   is no more; -1: it is no number */
static inline int xml_number(xml_text *value, double *out)
{
    mesh_reader r = mesh_of(value->at, value->size, "", NULL, 0);
    int failed;
    while (r.at < r.end && mesh_is_blank(*r.at)) r.at++;
    if (r.at == r.end) return 0;
    failed = mesh_take_coordinate(&r, out) || (r.at < r.end && !mesh_is_blank(*r.at));
    value->at = r.at;
    value->size = (size_t)(r.end - r.at);
    return failed ? -1 : 1;
}

/* A number that must be there */
static inline int xml_double(xml *x, const char *name, double *out)
{
    xml_text value = xml_value(x, XML_NO_SPACE, name);
    if (!value.at) return xml_fail(x, name, "is missing");
    if (xml_number(&value, out) == 1 && !value.size) return 0;
    return xml_fail(x, name, "is no number");
}

/* A whole number from 0 on, below 2^31; none where there is no such attribute */
static inline int xml_whole(xml *x, const char *name, uint32_t none, uint32_t *out)
{
    const xml_text value = xml_value(x, XML_NO_SPACE, name);
    uint64_t number = 0;
    *out = none;
    if (!value.at) return 0;
    if (!value.size || value.size > 10) return xml_fail(x, name, "is no whole number");
    for (size_t i = 0; i < value.size; i++) {
        if (value.at[i] < '0' || value.at[i] > '9') return xml_fail(x, name, "is no whole number");
        number = number * 10 + value.at[i] - '0';
    }
    if (number > INT_MAX) return xml_fail(x, name, "is too large");
    *out = (uint32_t)number;
    return 0;
}

/* A copy of a value with its entities undone, those of characters beyond ASCII left as they are.
   NULL: out of memory */
static inline char *xml_copy(xml_text value)
{
    static const char *const known[] = { "&amp;", "&lt;", "&gt;", "&quot;", "&apos;" };
    char *text = (char *)malloc(value.size + 1), *to = text;
    for (size_t i = 0; text && i < value.size;) {
        const unsigned char *at = value.at + i;
        size_t n = 1;
        *to = (char)(*at < ' ' || *at == 127 ? '?' : *at);
        for (int k = 0; k < 5 && *at == '&'; k++) {
            const size_t length = strlen(known[k]);
            if (value.size - i < length || memcmp(at, known[k], length) != 0) continue;
            *to = "&<>\"'"[k];
            n = length;
        }
        to++;
        i += n;
    }
    if (text) *to = 0;
    return text;
}
#endif
