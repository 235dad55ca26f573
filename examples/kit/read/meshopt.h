/* meshopt.h - unpacks the buffer views of glTF that EXT_meshopt_compression or
   KHR_meshopt_compression has packed, as gltfpack writes them: attributes (versions 0 and 1),
   triangles and indices, and the filters behind them.

       if (meshopt_unpack(&view, bytes, size, out)) ...           the bytes are damaged

   Written by the description of the bitstream in Khronos' glTF repository, extensions/2.0/Khronos/
   KHR_meshopt_compression, appendices A and B.  Nothing is read outside of bytes, or written
   outside of count * stride bytes of out. */
#ifndef MODEL_MESHOPT_H
#define MODEL_MESHOPT_H

#include "reader.h"

typedef enum meshopt_mode { MESHOPT_ATTRIBUTES, MESHOPT_TRIANGLES, MESHOPT_INDICES } meshopt_mode;
typedef enum meshopt_filter {
    MESHOPT_NONE,
    MESHOPT_OCTAHEDRAL,  /* unit vectors, folded onto a square */
    MESHOPT_QUATERNION,  /* without the component that is the greatest */
    MESHOPT_EXPONENTIAL, /* 24 bits of a whole number and 8 of a power of two */
    MESHOPT_COLOR        /* luma and two differences */
} meshopt_filter;

typedef struct meshopt_view {
    meshopt_mode mode;
    meshopt_filter filter;
    size_t count, stride; /* elements, and the bytes of one */
} meshopt_view;

/* Non-zero: what the packed bytes are said to hold is none of the format. */
static inline int meshopt_is_wrong(const meshopt_view *v)
{
    const int four = v->stride == 4, eight = v->stride == 8;
    if (v->mode != MESHOPT_ATTRIBUTES)
        return v->filter != MESHOPT_NONE || (v->stride != 2 && !four) ||
               (v->mode == MESHOPT_TRIANGLES && v->count % 3);
    if (v->stride < 4 || v->stride > 256 || v->stride % 4) return 1;
    if (v->filter == MESHOPT_QUATERNION) return !eight;
    return v->filter != MESHOPT_NONE && v->filter != MESHOPT_EXPONENTIAL && !four && !eight;
}

/* The least bytes that so many elements are packed into: memory is taken for no more. */
static inline double meshopt_least(const meshopt_view *v)
{
    const double count = (double)v->count;
    if (v->mode == MESHOPT_ATTRIBUTES) return count / 256 * (double)v->stride / 4;
    return v->mode == MESHOPT_TRIANGLES ? count / 3 : count;
}

/* ---- attributes ------------------------------------------------------------------------------ */

enum { MESHOPT_GROUP = 16, MESHOPT_BLOCK = 256, MESHOPT_STRIDE = 256 };

/* What is left of the packed bytes */
typedef struct meshopt_bytes {
    const unsigned char *at, *end;
} meshopt_bytes;

/* The next n bytes, or NULL */
static inline const unsigned char *meshopt_take(meshopt_bytes *b, size_t n)
{
    const unsigned char *at = b->at;
    if ((size_t)(b->end - at) < n) return NULL;
    b->at += n;
    return at;
}

/* 16 values of so many bits.  One with all bits set stands for a byte behind the group.  Those of
   one bit are packed from the lowest bit on, others from the highest. */
static inline int meshopt_group(meshopt_bytes *b, int bits, unsigned char *out)
{
    const int most = (1 << bits) - 1, each = bits ? 8 / bits : 1;
    const unsigned char *packed = meshopt_take(b, 2 * (size_t)bits);
    if (!packed) return 1;
    for (int i = 0; i < MESHOPT_GROUP; i++) {
        const int byte = bits ? packed[i / each] : 0, at = i % each;
        const int value = byte >> bits * (bits == 1 ? at : each - 1 - at) & most;
        const unsigned char *whole = NULL;
        if (bits && bits < 8 && value == most && !(whole = meshopt_take(b, 1))) return 1;
        out[i] = whole ? *whole : (unsigned char)value;
    }
    return 0;
}

/* One byte of count elements.  control: 0 to 3 as in version 1, or 4 of version 0 */
static inline int meshopt_column(meshopt_bytes *b, int control, size_t count, unsigned char *out)
{
    static const int bits[5][4] = { { 0, 1, 2, 4 }, { 1, 2, 4, 8 }, { 0 }, { 0 }, { 0, 2, 4, 8 } };
    const size_t groups = (count + MESHOPT_GROUP - 1) / MESHOPT_GROUP;
    const unsigned char *head;
    if (control == 2) memset(out, 0, count);
    if (control == 2) return 0;
    head = meshopt_take(b, control == 3 ? count : (groups + 3) / 4);
    if (!head) return 1;
    if (control == 3) memcpy(out, head, count);
    for (size_t g = 0; g < groups && control != 3; g++)
        if (meshopt_group(b, bits[control][head[g / 4] >> 2 * (g % 4) & 3],
                          out + MESHOPT_GROUP * g))
            return 1;
    return 0;
}

/* Half of a number whose lowest bit is its sign */
static inline uint32_t meshopt_signed(uint32_t v) { return v & 1 ? ~(v >> 1) : v >> 1; }

/* Four bytes of count elements from their differences, each from the element before: as bytes, as
   two numbers of 16 bits, or as one of 32 whose bits differ and were turned.  last: of the element
   before, then the last one.  Non-zero: there is no such channel. */
static inline int meshopt_channel(unsigned char column[4][MESHOPT_BLOCK], int channel, size_t count,
                                  size_t stride, unsigned char *last, unsigned char *out)
{
    const int mode = channel & 15, turn = channel >> 4, width = 1 << mode;
    if (mode > 2 || (mode < 2 && turn)) return 1;
    for (size_t i = 0; i < count; i++, out += stride) {
        for (int first = 0; first < 4; first += width) {
            uint32_t before = 0, v = 0;
            for (int k = 0; k < width; k++) {
                before |= (uint32_t)last[first + k] << 8 * k;
                v |= (uint32_t)column[first + k][i] << 8 * k;
            }
            if (mode == 2)
                v = (v >> turn | v << (32 - turn) % 32) ^ before;
            else
                v = meshopt_signed(v) + before;
            for (int k = 0; k < width; k++) last[first + k] = (unsigned char)(v >> 8 * k);
        }
        memcpy(out, last, 4);
    }
    return 0;
}

/* Blocks of elements between a byte of version and a tail: the element before the first one, and in
   version 1 the kinds of channels */
static inline int meshopt_attributes(const meshopt_view *v, const unsigned char *bytes, size_t size,
                                     unsigned char *out)
{
    const int version = size ? bytes[0] - 0xA0 : -1;
    const size_t channels = version == 1 ? v->stride / 4 : 0, used = v->stride + channels;
    const size_t least = version == 1 ? 24 : 32, tail = used > least ? used : least;
    const size_t fit = (8192 / v->stride) & ~(size_t)15;
    const size_t most = fit < MESHOPT_BLOCK ? fit : MESHOPT_BLOCK;
    const unsigned char *kinds;
    unsigned char last[MESHOPT_STRIDE], column[4][MESHOPT_BLOCK];
    meshopt_bytes b;
    if (version < 0 || version > 1 || size < 1 + tail) return 1;
    b = (meshopt_bytes){ bytes + 1, bytes + size - tail };
    kinds = bytes + size - channels;
    memcpy(last, bytes + size - used, v->stride);
    for (size_t first = 0; first < v->count; first += most) {
        const size_t count = v->count - first < most ? v->count - first : most;
        const unsigned char *control = meshopt_take(&b, channels);
        if (!control) return 1;
        for (size_t k = 0; k < v->stride; k++) {
            const int how = version ? control[k / 4] >> 2 * (k % 4) & 3 : 4;
            unsigned char *to = out + first * v->stride + k - k % 4;
            if (meshopt_column(&b, how, count, column[k % 4])) return 1;
            if (k % 4 == 3 && meshopt_channel(column, version ? kinds[k / 4] : 0, count, v->stride,
                                              last + k - 3, to))
                return 1;
        }
    }
    return b.at != b.end;
}

/* ---- triangles and indices ------------------------------------------------------------------- */

/* A number of up to five bytes, seven bits each.  Non-zero: they end before it. */
static inline int meshopt_number(meshopt_bytes *b, uint32_t *out)
{
    *out = 0;
    for (int shift = 0; shift < 35; shift += 7) {
        const unsigned char *byte = meshopt_take(b, 1);
        if (!byte) return 1;
        *out |= (uint32_t)(*byte & 127) << shift;
        if (*byte < 128) return 0;
    }
    return 1;
}

static inline void meshopt_put(unsigned char *out, size_t stride, size_t i, uint32_t index)
{
    for (size_t k = 0; k < stride; k++) out[stride * i + k] = (unsigned char)(index >> 8 * k);
}

/* Indices as differences from one of two that came before */
static inline int meshopt_indices(const meshopt_view *v, const unsigned char *bytes, size_t size,
                                  unsigned char *out)
{
    meshopt_bytes b;
    uint32_t last[2] = { 0, 0 }, number;
    if (size < 5 || bytes[0] != 0xD1) return 1;
    b = (meshopt_bytes){ bytes + 1, bytes + size - 4 };
    for (size_t i = 0; i < v->count; i++) {
        if (meshopt_number(&b, &number)) return 1;
        last[number & 1] += meshopt_signed(number >> 1);
        meshopt_put(out, v->stride, i, last[number & 1]);
    }
    return b.at != b.end;
}

/* The last 16 edges and vertices, the next new index, and the last one that was written out */
typedef struct meshopt_corners {
    meshopt_bytes data;
    uint32_t edge[16][2], vertex[16], next, last;
    unsigned edges, vertices; /* how many there were */
    int failed;
} meshopt_corners;

static inline void meshopt_add_edge(meshopt_corners *c, uint32_t a, uint32_t b)
{
    uint32_t *edge = c->edge[c->edges++ % 16];
    edge[0] = a;
    edge[1] = b;
}

static inline void meshopt_add_vertex(meshopt_corners *c, uint32_t v)
{
    c->vertex[c->vertices++ % 16] = v;
}

/* An index that is written out */
static inline uint32_t meshopt_written(meshopt_corners *c)
{
    uint32_t number;
    c->failed |= meshopt_number(&c->data, &number);
    return c->last += meshopt_signed(number);
}

/* The third corner of a triangle that shares an edge.  0: a new one; to 12: one of the last; 13,
   14: beside the one that was written out last; 15: written out */
static inline uint32_t meshopt_third(meshopt_corners *c, unsigned code)
{
    uint32_t v;
    if (code && code < 13) return c->vertex[(c->vertices - 1 - code) % 16];
    if (!code)
        v = c->next++;
    else if (code < 15)
        v = c->last += code == 13 ? UINT32_MAX : 1;
    else
        v = meshopt_written(c);
    meshopt_add_vertex(c, v);
    return v;
}

/* A corner of a triangle without such an edge, by a code of four bits.  *fresh: it counts as one of
   the last from now on */
static inline uint32_t meshopt_loose(meshopt_corners *c, unsigned code, int *fresh)
{
    *fresh = !code || code == 15;
    if (!code) return c->next++;
    return code == 15 ? meshopt_written(c) : c->vertex[(c->vertices - code) % 16];
}

/* The three corners of such a triangle */
static inline void meshopt_apart(meshopt_corners *c, unsigned first, unsigned codes, uint32_t *t)
{
    int fresh[3];
    t[0] = meshopt_loose(c, first, &fresh[0]);
    t[1] = meshopt_loose(c, codes >> 4, &fresh[1]);
    t[2] = meshopt_loose(c, codes & 15, &fresh[2]);
    for (int k = 0; k < 3; k++)
        if (fresh[k]) meshopt_add_vertex(c, t[k]);
    meshopt_add_edge(c, t[1], t[0]);
    meshopt_add_edge(c, t[2], t[1]);
    meshopt_add_edge(c, t[0], t[2]);
}

/* A byte for each triangle, then what does not fit there, then a table of 16 codes */
static inline int meshopt_triangles(const meshopt_view *v, const unsigned char *bytes, size_t size,
                                    unsigned char *out)
{
    const size_t triangles = v->count / 3;
    const unsigned char *code = bytes + 1, *table;
    meshopt_corners c;
    memset(&c, 0, sizeof c);
    memset(c.edge, 255, sizeof c.edge);
    memset(c.vertex, 255, sizeof c.vertex);
    if (size < 17 || triangles > size - 17 || bytes[0] != 0xE1) return 1;
    table = bytes + size - 16;
    c.data = (meshopt_bytes){ code + triangles, table };
    for (size_t i = 0; i < triangles && !c.failed; i++) {
        const unsigned high = code[i] >> 4, low = code[i] & 15;
        uint32_t t[3];
        if (high < 15) {
            const uint32_t *edge = c.edge[(c.edges - 1 - high) % 16];
            t[0] = edge[0];
            t[1] = edge[1];
            t[2] = meshopt_third(&c, low);
            meshopt_add_edge(&c, t[2], t[1]);
            meshopt_add_edge(&c, t[0], t[2]);
        } else {
            const unsigned char *codes = low < 14 ? table + low : meshopt_take(&c.data, 1);
            if (!codes) return 1;
            if (low >= 14 && !*codes) c.next = 0;
            meshopt_apart(&c, low == 15 ? 15 : 0, *codes, t);
        }
        for (size_t k = 0; k < 3; k++) meshopt_put(out, v->stride, 3 * i + k, t[k]);
    }
    return c.failed || c.data.at != c.data.end;
}

/* ---- filters --------------------------------------------------------------------------------- */

/* A number of one or two bytes, and back, rounded to the nearest within its range */
static inline int meshopt_get(const unsigned char *p, size_t bytes, int is_signed)
{
    const int v = bytes == 1 ? *p : p[0] | p[1] << 8, half = 128 << 8 * (bytes - 1);
    return is_signed && v >= half ? v - 2 * half : v;
}

static inline void meshopt_set(unsigned char *p, size_t bytes, double value)
{
    const double most = bytes == 1 ? 255 : 65535, v = fmin(fmax(value, -most), most);
    const int whole = (int)(v + (v < 0 ? -0.5 : 0.5));
    p[0] = (unsigned char)(whole & 255);
    if (bytes == 2) p[1] = (unsigned char)(whole >> 8 & 255);
}

static inline void meshopt_octahedral(unsigned char *p, size_t bytes)
{
    const double one = meshopt_get(p + 2 * bytes, bytes, 1), most = bytes == 1 ? 127 : 32767;
    double v[3], fold, length;
    for (size_t k = 0; k < 2; k++)
        v[k] = meshopt_get(p + k * bytes, bytes, 1) / (one > 0 ? one : 1);
    v[2] = 1 - fabs(v[0]) - fabs(v[1]);
    fold = fmin(v[2], 0);
    for (size_t k = 0; k < 2; k++) v[k] += v[k] < 0 ? -fold : fold;
    length = sqrt(v[0] * v[0] + v[1] * v[1] + v[2] * v[2]);
    for (size_t k = 0; k < 3; k++)
        meshopt_set(p + k * bytes, bytes, length > 0 ? v[k] / length * most : 0);
}

static inline void meshopt_quaternion(unsigned char *p)
{
    const int last = meshopt_get(p + 6, 2, 1), greatest = last & 3;
    const double scale = sqrt(0.5) / (last | 3);
    double v[4] = { 1, 0, 0, 0 };
    for (size_t k = 1; k < 4; k++) {
        v[k] = scale * meshopt_get(p + 2 * (k - 1), 2, 1);
        v[0] -= v[k] * v[k];
    }
    v[0] = sqrt(fmax(v[0], 0));
    for (int k = 0; k < 4; k++) meshopt_set(p + 2 * ((greatest + k) % 4), 2, 32767 * v[k]);
}

static inline void meshopt_exponential(unsigned char *p)
{
    const uint32_t bits = mesh_uint32(p), mantissa = bits & 0xFFFFFF;
    const int told = (int)(bits >> 24) - (bits >> 31 ? 256 : 0); /* -100 .. 100 */
    const int power = told < -100 ? -100 : told > 100 ? 100 : told;
    const int whole = (int)mantissa - (mantissa >> 23 ? 1 << 24 : 0);
    const uint64_t scale_bits = (uint64_t)(power + 1023) << 52; /* of 2^power */
    double scale;
    float value;
    uint32_t made;
    memcpy(&scale, &scale_bits, sizeof scale);
    value = (float)(scale * whole);
    memcpy(&made, &value, sizeof made);
    meshopt_put(p, 4, 0, made);
}

static inline void meshopt_color(unsigned char *p, size_t bytes)
{
    const int luma = meshopt_get(p, bytes, 0), orange = meshopt_get(p + bytes, bytes, 1);
    const int green = meshopt_get(p + 2 * bytes, bytes, 1),
              alpha = meshopt_get(p + 3 * bytes, bytes, 0);
    const int rgb[3] = { luma + orange - green, luma + green, luma - orange - green };
    const double most = bytes == 1 ? 255 : 65535;
    int all = 1; /* as many bits as the components had */
    while (all < alpha) all = 2 * all + 1;
    for (size_t k = 0; k < 3; k++) meshopt_set(p + k * bytes, bytes, fmax(rgb[k] * most / all, 0));
    meshopt_set(p + 3 * bytes, bytes, ((alpha & all >> 1) << 1 | (alpha & 1)) * most / all);
}

static inline void meshopt_unfilter(const meshopt_view *v, unsigned char *out)
{
    const size_t step = v->filter == MESHOPT_EXPONENTIAL ? 4 : v->stride;
    for (unsigned char *p = out, *end = out + v->count * v->stride; p < end; p += step) {
        if (v->filter == MESHOPT_OCTAHEDRAL) meshopt_octahedral(p, v->stride / 4);
        if (v->filter == MESHOPT_QUATERNION) meshopt_quaternion(p);
        if (v->filter == MESHOPT_EXPONENTIAL) meshopt_exponential(p);
        if (v->filter == MESHOPT_COLOR) meshopt_color(p, v->stride / 4);
    }
}

/* Unpacks a view that is none of the wrong.  Non-zero: the bytes are damaged. */
static inline int meshopt_unpack(const meshopt_view *v, const unsigned char *bytes, size_t size,
                                 unsigned char *out)
{
    int failed;
    if (v->mode == MESHOPT_ATTRIBUTES)
        failed = meshopt_attributes(v, bytes, size, out);
    else if (v->mode == MESHOPT_TRIANGLES)
        failed = meshopt_triangles(v, bytes, size, out);
    else
        failed = meshopt_indices(v, bytes, size, out);
    if (!failed && v->filter != MESHOPT_NONE) meshopt_unfilter(v, out);
    return failed;
}
#endif
