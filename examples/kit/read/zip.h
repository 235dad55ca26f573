/* zip.h - finds the files of a ZIP archive by its central directory, ZIP64 too, and unpacks them:
   stored ones, and deflated ones by a function of the caller. */
#ifndef MODEL_ZIP_H
#define MODEL_ZIP_H

#include "reader.h"

/* Unpacks raw deflate into all of out, which is as large as the archive says.  0: done */
typedef int zip_inflate(const unsigned char *packed, size_t packed_size, unsigned char *out,
                        size_t size);

enum { ZIP_FILES = 10000, ZIP_RATIO = 500 }; /* unpacked to packed: text of numbers has 5 to 40 */
#define ZIP_BYTES 1e9                        /* unpacked, of all files together */

typedef struct zip_entry {
    const unsigned char *name;
    size_t length;
    unsigned method, flags;
    uint32_t crc;
    uint64_t packed, size, offset;
} zip_entry;

typedef struct zip {
    const unsigned char *begin, *end;
    zip_entry *entry;
    size_t count;
    double left; /* bytes that may be unpacked */
    zip_inflate *inflate;
} zip;

static inline uint64_t zip_uint(const unsigned char *p, int bytes)
{
    uint64_t value = 0;
    for (int k = 0; k < bytes; k++) value |= (uint64_t)p[k] << 8 * k;
    return value;
}

/* Names of a package are the same in capital and small letters, with or without a slash before. */
static inline int zip_letter(unsigned char c)
{
    return c >= 'A' && c <= 'Z' ? c | 32 : c == '\\' ? '/' : c;
}

static inline int zip_is(const zip_entry *e, const char *name)
{
    size_t i = 0;
    while (i < e->length && (e->name[i] == '/' || e->name[i] == '\\')) i++;
    while (*name == '/' || *name == '\\') name++;
    for (; i < e->length && *name; i++, name++)
        if (zip_letter(e->name[i]) != zip_letter((unsigned char)*name)) return 0;
    return i == e->length && !*name;
}

/* The file of that name; NULL: there is none. */
static inline const zip_entry *zip_find(const zip *z, const char *name)
{
    char plain[300];
    for (size_t i = z->count; i-- > 0;)
        if (zip_is(&z->entry[i], name)) return &z->entry[i];
    mesh_unescape(name, plain, sizeof plain);
    for (size_t i = z->count; i-- > 0 && strchr(name, '%');)
        if (zip_is(&z->entry[i], plain)) return &z->entry[i];
    return NULL;
}

/* ZIP64's sizes stand in an extra field, in this order, those alone that do not fit. */
static inline int zip_extra(zip_entry *e, const unsigned char *p, size_t n)
{
    uint64_t *const value[3] = { &e->size, &e->packed, &e->offset };
    while (n >= 4) {
        const size_t kind = (size_t)zip_uint(p, 2), size = (size_t)zip_uint(p + 2, 2);
        size_t at = 4;
        if (size > n - 4) return 1;
        for (int k = 0; k < 3 && kind == 1; k++) {
            if (*value[k] != 0xFFFFFFFF) continue;
            if (at + 8 > 4 + size) return 1;
            *value[k] = zip_uint(p + at, 8);
            at += 8;
        }
        p += 4 + size;
        n -= 4 + size;
    }
    return 0;
}

/* The end of the directory: the directory's place and the number of files */
static inline int zip_tail(mesh_reader *r, uint64_t *place, uint64_t *count)
{
    const size_t size = (size_t)(r->end - r->begin);
    const unsigned char *tail = NULL;
    for (size_t back = 22; back <= size && back <= 22 + 65535 && !tail; back++)
        if (!memcmp(r->end - back, "PK\5\6", 4)) tail = r->end - back;
    if (!tail) return mesh_fail(r, "it is no ZIP archive, or is cut off");
    *count = zip_uint(tail + 10, 2);
    *place = zip_uint(tail + 16, 4);
    if (*count != 0xFFFF && *place != 0xFFFFFFFF) return 0;
    if (tail - r->begin < 20 || memcmp(tail - 20, "PK\6\7", 4) != 0) return 0;
    *place = zip_uint(tail - 12, 8);
    if (*place > size || size - *place < 56 || memcmp(r->begin + *place, "PK\6\6", 4) != 0)
        return mesh_fail(r, "its ZIP directory is damaged");
    tail = r->begin + *place;
    *count = zip_uint(tail + 32, 8);
    *place = zip_uint(tail + 48, 8);
    return 0;
}

static inline int zip_open(mesh_reader *r, zip *z)
{
    const uint64_t size = (uint64_t)(r->end - r->begin);
    uint64_t place = 0, count = 0;
    z->begin = r->begin;
    z->end = r->end;
    z->left = ZIP_BYTES;
    if (zip_tail(r, &place, &count)) return 1;
    if (count > ZIP_FILES) return mesh_fail(r, "more than %d files in the archive", ZIP_FILES);
    z->entry = (zip_entry *)calloc((size_t)count + 1, sizeof *z->entry);
    if (!z->entry) return mesh_fail(r, "out of memory");
    for (uint64_t i = 0; i < count; i++) {
        zip_entry *e = &z->entry[z->count];
        const unsigned char *p;
        size_t extra;
        if (place > size || size - place < 46) return mesh_fail(r, "its ZIP directory is damaged");
        p = r->begin + (size_t)place;
        if (memcmp(p, "PK\1\2", 4) != 0) return mesh_fail(r, "its ZIP directory is damaged");
        e->flags = (unsigned)zip_uint(p + 8, 2);
        e->method = (unsigned)zip_uint(p + 10, 2);
        e->crc = (uint32_t)zip_uint(p + 16, 4);
        e->packed = zip_uint(p + 20, 4);
        e->size = zip_uint(p + 24, 4);
        e->length = (size_t)zip_uint(p + 28, 2);
        e->offset = zip_uint(p + 42, 4);
        e->name = p + 46;
        extra = (size_t)zip_uint(p + 30, 2);
        place += 46 + e->length + extra;
        if (place > size || zip_extra(e, p + 46 + e->length, extra))
            return mesh_fail(r, "its ZIP directory is damaged");
        place += zip_uint(p + 32, 2);
        z->count++;
    }
    return 0;
}

/* The bytes of a file as they are packed, if it may be unpacked; NULL with the error in r */
static inline const unsigned char *zip_packed(mesh_reader *r, const zip *z, const zip_entry *e)
{
    const uint64_t size = (uint64_t)(z->end - z->begin);
    const double most = fmin(z->left, ZIP_RATIO * (double)e->packed + 1e5);
    const unsigned char *p = z->begin;
    uint64_t head = 0;
    if (e->offset <= size && size - e->offset >= 30) {
        p += (size_t)e->offset;
        if (!memcmp(p, "PK\3\4", 4)) head = 30 + zip_uint(p + 26, 2) + zip_uint(p + 28, 2);
    }
    if (!head || head > size - e->offset || e->packed > size - e->offset - head) {
        mesh_fail(r, "is cut off");
        return NULL;
    }
    if ((e->method != 0 && e->method != 8) || (e->flags & 1)) {
        mesh_fail(r, e->flags & 1 ? "is encrypted" : "is packed in a way that is not read");
        return NULL;
    }
    if ((double)e->size > most) {
        mesh_fail(r, "unpacks to more than %.0f bytes", most);
        return NULL;
    }
    return p + head;
}

/* The checksum of ZIP and PNG, of bytes that follow those of crc; 0: there are none */
static inline uint32_t zip_crc(uint32_t crc, const unsigned char *bytes, size_t n)
{
    uint32_t table[8][256]; /* of a byte, and of the same with k zero bytes behind it */
    for (uint32_t i = 0; i < 256; i++) {
        uint32_t *own = &table[0][i];
        *own = i;
        for (int k = 0; k < 8; k++) *own = *own >> 1 ^ (*own & 1 ? 0xEDB88320 : 0);
    }
    for (int k = 1; k < 8; k++)
        for (int i = 0; i < 256; i++)
            table[k][i] = table[k - 1][i] >> 8 ^ table[0][table[k - 1][i] & 255];
    crc = ~crc;
    for (; n >= 8; n -= 8, bytes += 8) {
        const uint32_t low = crc ^ mesh_uint32(bytes);
        crc = table[7][low & 255] ^ table[6][low >> 8 & 255] ^ table[5][low >> 16 & 255] ^
              table[4][low >> 24] ^ table[3][bytes[4]] ^ table[2][bytes[5]] ^ table[1][bytes[6]] ^
              table[0][bytes[7]];
    }
    for (size_t i = 0; i < n; i++) crc = crc >> 8 ^ table[0][(crc ^ bytes[i]) & 255];
    return ~crc;
}

/* The bytes of a file, to be freed by the caller; NULL with the error in r, which names the file */
static inline unsigned char *zip_unpack(mesh_reader *r, zip *z, const zip_entry *e)
{
    const unsigned char *packed = zip_packed(r, z, e);
    unsigned char *out;
    int failed = 0;
    if (!packed) return NULL;
    if (e->method && !z->inflate) {
        mesh_fail(r, "is packed, which this program was built without zlib for (zlib1g-dev)");
        return NULL;
    }
    out = (unsigned char *)malloc((size_t)e->size + 1);
    if (!out) {
        mesh_fail(r, "out of memory");
        return NULL;
    }
    if (e->method)
        failed = z->inflate(packed, (size_t)e->packed, out, (size_t)e->size);
    else if (e->size == e->packed)
        memcpy(out, packed, (size_t)e->size);
    else
        failed = 1;
    if (failed || zip_crc(0, out, (size_t)e->size) != e->crc) {
        mesh_fail(r, "cannot be unpacked: it is damaged");
        free(out);
        return NULL;
    }
    z->left -= (double)e->size;
    return out;
}
#endif
