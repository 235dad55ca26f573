/* libc.h - as much of C's library as the readers, mesh.h and shapes.h ask for, so that they compile
   for wasm32 where there is none.  The build puts this file in the place of <stdio.h>, <stdlib.h>,
   <string.h>, <math.h> and <errno.h>; one .c file includes it, so it holds the bodies as well.
   Files do not exist here: what opens them compiles, and is dropped because nobody calls it. */
#ifndef PLAYGROUND_LIBC_H
#define PLAYGROUND_LIBC_H

#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>

/* ---- bytes ----------------------------------------------------------------------------------- */

/* Compilers turn such loops into calls of the functions they stand in, unless they are told. */
#define LIBC_OWN __attribute__((no_builtin))

LIBC_OWN void *memcpy(void *to, const void *from, size_t n)
{
#ifdef __wasm_bulk_memory__
    return __builtin_memcpy(to, from, n);    /* one instruction */
#else
    unsigned char *d = (unsigned char *)to;
    const unsigned char *s = (const unsigned char *)from;
    for (; n >= 8; n -= 8, d += 8, s += 8)
        __builtin_memcpy_inline(d, s, 8);
    for (; n; n--) *d++ = *s++;
    return to;
#endif
}
LIBC_OWN void *memmove(void *to, const void *from, size_t n)
{
    unsigned char *d = (unsigned char *)to;
    const unsigned char *s = (const unsigned char *)from;
    if (d <= s) return memcpy(to, from, n);    /* which goes upward */
    while (n--) d[n] = s[n];
    return to;
}
LIBC_OWN void *memset(void *to, int value, size_t n)
{
    unsigned char *d = (unsigned char *)to;
    for (; n; n--) *d++ = (unsigned char)value;
    return to;
}
LIBC_OWN int memcmp(const void *a, const void *b, size_t n)
{
    const unsigned char *p = (const unsigned char *)a, *q = (const unsigned char *)b;
    for (; n; n--, p++, q++)
        if (*p != *q) return *p < *q ? -1 : 1;
    return 0;
}

static inline void *memchr(const void *in, int value, size_t n)
{
    const unsigned char *p = (const unsigned char *)in;
    for (; n; n--, p++)
        if (*p == (unsigned char)value) return (void *)(uintptr_t)p;
    return NULL;
}

static inline size_t strlen(const char *s)
{
    size_t n = 0;
    while (s[n]) n++;
    return n;
}

static inline int strcmp(const char *a, const char *b)
{
    for (; *a && *a == *b; a++, b++) {}
    return *a - *b;
}

static inline int strncmp(const char *a, const char *b, size_t n)
{
    for (; n && *a && *a == *b; a++, b++) n--;
    return n ? *a - *b : 0;
}

static inline char *strchr(const char *s, int c)
{
    while (*s && *s != (char)c) s++;
    return *s == (char)c ? (char *)(uintptr_t)s : NULL;
}

static inline char *strstr(const char *s, const char *part)
{
    const size_t n = strlen(part);
    while (*s && strncmp(s, part, n)) s++;
    return strncmp(s, part, n) ? NULL : (char *)(uintptr_t)s;
}

/* ---- memory: blocks in a row from the end of the program on, first fit ----------------------- */

typedef struct libc_block { uint32_t size, used, unused[2]; } libc_block;    /* 16 bytes */
extern unsigned char __heap_base;
static uint32_t libc_top;                            /* where the next block will begin */

static inline uint32_t libc_begin(void) { return ((uint32_t)&__heap_base + 15) & ~15u; }

/* Moves the top by so many bytes, if the machine has them. */
static inline int libc_extend(uint32_t from, uint64_t size)
{
    uint64_t end = from + size, have = (uint64_t)__builtin_wasm_memory_size(0) << 16;
    if (end > UINT32_MAX - 65535u) return 0;
    if (end > have &&
        __builtin_wasm_memory_grow(0, (size_t)((end - have + 65535) >> 16)) == (size_t)-1)
        return 0;
    libc_top = (uint32_t)end;
    return 1;
}

static inline void *malloc(size_t n)
{
    uint64_t size = ((uint64_t)n + 15 + sizeof(libc_block)) & ~(uint64_t)15;
    libc_block *b, *last = NULL;
    if (!libc_top) libc_top = libc_begin();
    for (uint32_t at = libc_begin(); at < libc_top; at += b->size, last = b) {
        b = (libc_block *)at;
        if (b->used) continue;
        while (at + b->size < libc_top && !((libc_block *)(at + b->size))->used)
            b->size += ((libc_block *)(at + b->size))->size;
        if (b->size < size) continue;
        if (b->size - size >= 4096) {                /* give the rest back */
            libc_block *rest = (libc_block *)(at + (uint32_t)size);
            rest->size = b->size - (uint32_t)size;
            rest->used = 0;
            b->size = (uint32_t)size;
        }
        b->used = 1;
        return b + 1;
    }
    b = last && !last->used ? last : (libc_block *)libc_top;
    if (!libc_extend((uint32_t)b, size)) return NULL;
    b->size = (uint32_t)size;
    b->used = 1;
    return b + 1;
}

static inline void free(void *p)
{
    if (p) ((libc_block *)p - 1)->used = 0;
}

static inline void *calloc(size_t count, size_t size)
{
    void *p = size && count > SIZE_MAX / size ? NULL : malloc(count * size);
    return p ? memset(p, 0, count * size) : NULL;
}

static inline void *realloc(void *p, size_t n)
{
    libc_block *b = (libc_block *)p - 1;
    void *moved;
    if (!p) return malloc(n);
    if (n <= b->size - sizeof *b) return p;
    if ((uint32_t)b + b->size == libc_top) {         /* the last one grows where it is */
        uint64_t size = ((uint64_t)n + 15 + sizeof *b) & ~(uint64_t)15;
        if (!libc_extend((uint32_t)b, size)) return NULL;
        b->size = (uint32_t)size;
        return p;
    }
    moved = malloc(n);
    if (moved) {
        memcpy(moved, p, b->size - sizeof *b);
        free(p);
    }
    return moved;
}

/* ---- text: the conversions of error messages ------------------------------------------------- */

typedef struct FILE FILE;
static FILE *const stderr = NULL;
FILE *fopen(const char *path, const char *mode);
int fclose(FILE *file);
int remove(const char *path);
int ferror(FILE *file);
/* there are no files here, but readers in pieces can be handed one */
static inline size_t fread(void *to, size_t size, size_t count, FILE *file)
{
    (void)to, (void)size, (void)count, (void)file;
    return 0;
}
enum { SEEK_SET, SEEK_END };
int fseek(FILE *file, long to, int from);
long ftell(FILE *file);
char *strerror(int number);
static int errno;

/* %s %d %i %u with l and ll, %% */
static inline int vsnprintf(char *out, size_t room, const char *format, va_list list)
{
    size_t n = 0;
    for (; *format; format++) {
        char digits[24];
        const char *piece = format;
        size_t length = 1, longs = 0;
        if (*format == '%') {
            while (*++format == 'l') longs++;
            if (*format == 's') {
                piece = va_arg(list, const char *);
                length = strlen(piece);
            } else if (*format != '%') {
                int is_signed = *format != 'u';
                uint64_t v = longs == 2 ? va_arg(list, unsigned long long)
                           : is_signed ? (uint64_t)va_arg(list, int) : va_arg(list, unsigned);
                int negative = is_signed && (int64_t)v < 0;
                char *p = digits + sizeof digits;
                if (negative) v = 0 - v;
                do *--p = (char)('0' + v % 10);
                while (v /= 10);
                if (negative) *--p = '-';
                piece = p;
                length = (size_t)(digits + sizeof digits - p);
            } else {
                piece = format;
            }
        }
        for (size_t i = 0; i < length; i++, n++)
            if (n + 1 < room) out[n] = piece[i];
    }
    if (room) out[n < room ? n : room - 1] = 0;
    return (int)n;
}

static inline int snprintf(char *out, size_t room, const char *format, ...)
{
    va_list list;
    int n;
    va_start(list, format);
    n = vsnprintf(out, room, format, list);
    va_end(list);
    return n;
}

static inline int fprintf(FILE *file, const char *format, ...)
{
    (void)file, (void)format;
    return 0;
}
__attribute__((noreturn)) static inline void exit(int status) { (void)status, __builtin_trap(); }

/* ---- numbers: each one instruction ----------------------------------------------------------- */

#define NAN __builtin_nanf("")
#define HUGE_VAL __builtin_huge_val()
static inline double sqrt(double x) { return __builtin_sqrt(x); }
static inline float sqrtf(float x) { return __builtin_sqrtf(x); }
static inline double fabs(double x) { return __builtin_fabs(x); }
static inline double floor(double x) { return __builtin_floor(x); }
static inline float fabsf(float x) { return __builtin_fabsf(x); }
static inline float fmaxf(float a, float b) { return a > b ? a : b; }
static inline float fminf(float a, float b) { return a < b ? a : b; }
static inline double fmax(double a, double b) { return a > b ? a : b; }
static inline double fmin(double a, double b) { return a < b ? a : b; }
/* the page's, of JavaScript */
__attribute__((import_module("env"), import_name("exp"))) double exp(double x);
__attribute__((import_module("env"), import_name("log"))) double log(double x);
#endif
