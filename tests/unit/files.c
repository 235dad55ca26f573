/* files.c - pictures as PPM and PNG: pixels, sizes, failures. */
#include "unit.h"

#if defined(__unix__) || defined(__APPLE__)
#include <signal.h>
#include <sys/resource.h>
#endif

#if defined(__SANITIZE_ADDRESS__) || defined(__SANITIZE_THREAD__)
#define FILES_SANITIZED 1
#elif defined(__has_feature)
#define FILES_SANITIZED \
    (__has_feature(address_sanitizer) || __has_feature(memory_sanitizer) || \
     __has_feature(thread_sanitizer) || __has_feature(undefined_behavior_sanitizer))
#else
#define FILES_SANITIZED 0
#endif

#define FILES_SLACK 1e-4 /* of a byte: the float rounding of c times 255 */

typedef struct file_sink {
    unsigned char bytes[400000];
    size_t size;
    int calls, fail_at; /* the call that fails; 0: none */
} file_sink;

static int file_write(void *user, const void *bytes, size_t size)
{
    file_sink *s = (file_sink *)user;
    if (++s->calls == s->fail_at) return 1;
    if (s->size + size > sizeof s->bytes) return 2;
    memcpy(s->bytes + s->size, bytes, size);
    s->size += size;
    return 0;
}

/* Checks the header and returns the first pixel byte, or NULL. */
static const unsigned char *ppm_pixels(const file_sink *s, int width, int height)
{
    int w = 0, h = 0, most = 0, at = 0;
    char header[64];
    memset(header, 0, sizeof header);
    memcpy(header, s->bytes, s->size < 63 ? s->size : 63);
    int fields = sscanf(header, "P6 %d %d %d%n", &w, &h, &most, &at);
    CHECK_INT(fields, 3);
    CHECK_INT(w, width);
    CHECK_INT(h, height);
    CHECK_INT(most, 255);
    CHECK_INT(s->size, at + 1 + 3 * width * height);
    return fields == 3 && s->size == (size_t)(at + 1 + 3 * width * height) ? s->bytes + at + 1
                                                                           : NULL;
}

/* Rectangles of any colour, NaN and infinities among them, in all formats, with padding, whole
   or as a strip. */
TEST(files, a_ppm_holds_the_stored_colours_of_every_row)
{
    static file_sink sink;
    for (int i = 0; i < 200; i++) {
        int width = rnd_int(1, 60), height = rnd_int(1, 40), srgb = i / CANVAS_FORMATS % 2;
        int strip = rnd_one_in(4), rows = strip ? rnd_int(1, height) : height;
        int offset = strip ? rnd_int(0, height - rows) : 0;
        shade_format format = (shade_format)(i % CANVAS_FORMATS);
        canvas c =
            canvas_strip(width, height, width + rnd_int(0, 5), format, 0, offset, strip ? rows : 0);
        c.target.srgb = srgb;
        CHECK_INT(shade_clear(&c.target, shade_v4(0, 0, 0, 1), 1), SHADE_OK);
        for (int n = 0; n < 30; n++) {
            c.target.clip_x = rnd_int(0, width - 1);
            c.target.clip_y = rnd_int(0, height - 1);
            c.target.clip_width = rnd_int(1, 20);
            c.target.clip_height = rnd_int(1, 20);
            shade_vec4 color = shade_v4(rnd_float(-0.2, 1.2), rnd_float(0, 1),
                                        rnd_one_in(9) ? rnd_nasty() : rnd_float(0, 1), 1);
            CHECK_INT(shade_clear(&c.target, color, 1), SHADE_OK);
        }
        c.target.clip_x = c.target.clip_y = c.target.clip_width = c.target.clip_height = 0;
        memset(&sink, 0, sizeof sink);
        CHECK_INT(shade_encode_ppm(file_write, &sink, &c.target), SHADE_OK);
        const unsigned char *p = ppm_pixels(&sink, width, rows);
        for (int k = 0; p && k < width * rows * 3; k++) {
            int x = k / 3 % width, y = offset + k / 3 / width, channel = k % 3;
            if (format != SHADE_FORMAT_RGBA32F) {
                double most = canvas_most(format, channel);
                CHECK_NEAR(p[k], 255 * canvas_code(&c, x, y, channel) / most, 0.5);
            } else {
                double v = (double)canvas_float(&c, x, y, channel);
                v = v > 0 ? (v < 1 ? v : 1) : 0;
                CHECK_SAY(fabs(p[k] - 255 * (srgb ? ref_encode_srgb(v) : v)) <= 0.5 + FILES_SLACK,
                          "%.9g sRGB %d: got %d", v, srgb, p[k]);
            }
        }
        canvas_close(&c);
    }
}

typedef shade_result encoder(shade_write_fn *sink, void *user, const shade_target *target);
static encoder *const encoders[2] = { shade_encode_ppm, shade_encode_png };

/* Each of the writes fails in turn, and none comes after it. */
TEST(files, a_failed_write_stops_the_file)
{
    static file_sink sink;
    canvas c = canvas_ready(90, 70, 0, SHADE_FORMAT_RGBA8, 0);
    for (size_t i = 0; i < c.color_bytes; i++)
        c.color[CANVAS_GUARD + i] = (unsigned char)rnd_int(0, 255);
    for (int k = 0; k < 2; k++) {
        memset(&sink, 0, sizeof sink);
        CHECK_INT(encoders[k](file_write, &sink, &c.target), SHADE_OK);
        int calls = sink.calls;
        CHECK(calls > 5);
        for (int fail_at = 1; fail_at <= calls; fail_at++) {
            memset(&sink, 0, sizeof sink);
            sink.fail_at = fail_at;
            CHECK_INT(encoders[k](file_write, &sink, &c.target), SHADE_ERROR_IO);
            CHECK_INT(sink.calls, fail_at);
        }
    }
    canvas_close(&c);
}

#ifndef SHADE_NO_STDIO
typedef shade_result writer(const char *path, const shade_target *target);
static writer *const writers[2] = { shade_write_ppm, shade_write_png };

static void temporary_path(char path[300], const char *what)
{
    const char *folder = getenv("TMPDIR");
    snprintf(path, 300, "%.200s/shade_%s_%08x", folder ? folder : "/tmp", what,
             (unsigned)(uintptr_t)path);
}

TEST(files, a_file_holds_the_bytes_that_a_sink_gets)
{
    static file_sink sink;
    static unsigned char file_bytes[40000];
    canvas c = canvas_open(50, 40, 55, SHADE_FORMAT_RGBA8, 0);
    CHECK_INT(shade_clear(&c.target, shade_v4(0.3f, 0.6f, 0.9f, 1), 1), SHADE_OK);
    for (int k = 0; k < 2; k++) {
        char path[300];
        temporary_path(path, "file");
        memset(&sink, 0, sizeof sink);
        CHECK_INT(encoders[k](file_write, &sink, &c.target), SHADE_OK);
        CHECK_INT(writers[k](path, &c.target), SHADE_OK);
        FILE *f = fopen(path, "rb");
        CHECK(f != NULL);
        if (f) {
            size_t size = fread(file_bytes, 1, sizeof file_bytes, f);
            fclose(f);
            CHECK_INT(size, sink.size);
            CHECK(!memcmp(file_bytes, sink.bytes, sink.size));
        }
        remove(path);
        CHECK_INT(writers[k]("/no/such/directory/picture", &c.target), SHADE_ERROR_IO);
        CHECK_INT(writers[k](NULL, &c.target), SHADE_ERROR_ARGUMENT);
        CHECK_INT(writers[k](path, NULL), SHADE_ERROR_ARGUMENT);
        shade_target bad = c.target;
        bad.width = 0;
        CHECK_INT(writers[k](path, &bad), SHADE_ERROR_TARGET);
        bad = c.target;
        bad.color = NULL;
        bad.depth = (float *)(void *)(c.depth + CANVAS_GUARD);
        CHECK_INT(writers[k](path, &bad), SHADE_ERROR_TARGET);
        f = fopen(path, "rb");
        CHECK(f == NULL); /* refused before a file is made */
        if (f) fclose(f);
    }
    canvas_close(&c);
}

/* No file may grow: a picture larger than the buffer of a FILE fails at once, one that fits at
   closing. */
TEST(files, a_full_disk_is_an_error)
{
#if defined(__unix__) || defined(__APPLE__)
    char path[300];
    temporary_path(path, "full");
    for (int i = 0; i < 4; i++) {
        const int big = i & 1;
        canvas c = canvas_ready(big ? 600 : 4, big ? 400 : 3, 0, SHADE_FORMAT_RGBA8, 0);
        for (size_t k = 0; k < c.color_bytes; k++)
            c.color[CANVAS_GUARD + k] = (unsigned char)rnd_int(0, 255);
        struct rlimit limit, none;
        fflush(stdout);
        CHECK_INT(getrlimit(RLIMIT_FSIZE, &limit), 0);
        void (*before)(int) = signal(SIGXFSZ, SIG_IGN);
        none = limit;
        none.rlim_cur = 0;
        int set = setrlimit(RLIMIT_FSIZE, &none);
        shade_result result = writers[i / 2](path, &c.target);
        setrlimit(RLIMIT_FSIZE, &limit);
        signal(SIGXFSZ, before);
        CHECK_INT(set, 0);
        CHECK_INT(result, SHADE_ERROR_IO);
        canvas_close(&c);
    }
    remove(path);
#else
    test_skip("no limit on the size of files");
#endif
}
#endif

TEST(files, a_picture_of_nothing_is_refused)
{
    static file_sink sink;
    canvas c = canvas_open(50, 40, 55, SHADE_FORMAT_RGBA8, 1);
    for (int k = 0; k < 2; k++) {
        CHECK_INT(encoders[k](NULL, &sink, &c.target), SHADE_ERROR_ARGUMENT);
        CHECK_INT(encoders[k](file_write, &sink, NULL), SHADE_ERROR_ARGUMENT);
        shade_target bad = c.target;
        bad.width = 0;
        CHECK_INT(encoders[k](file_write, &sink, &bad), SHADE_ERROR_TARGET);
        bad = c.target;
        bad.color = NULL;
        CHECK_INT(encoders[k](file_write, &sink, &bad), SHADE_ERROR_TARGET);
        bad = c.target;
        bad.format = SHADE_FORMAT_A8;
        CHECK_INT(encoders[k](file_write, &sink, &bad), SHADE_ERROR_TARGET);
    }
    CHECK_INT(sink.calls, 0);
    canvas_close(&c);
}

/* ------------------------------------------------------------------------------------------ PNG */

/* A decoder by the words of the standards, for what a PNG of RGB may hold: chunks whose CRC-32 is
   the remainder of a division of polynomials, deflate with tables made from lengths of codes, the
   five filters.  It stops at the first fault and says which. */
typedef struct decoder {
    const unsigned char *data;
    size_t size, at; /* at counts bits */
    unsigned char *out;
    size_t made, room;
    const char *fault;
} decoder;

typedef struct codes {
    int count[16], first[16], from[16]; /* of each length: how many, the first code, its place */
    int symbol[288];
} codes;

static int png_bit(decoder *d)
{
    if (d->at >= 8 * d->size) {
        d->fault = "bits end";
        return 0;
    }
    int bit = d->data[d->at / 8] >> d->at % 8 & 1;
    d->at++;
    return bit;
}

static int png_bits(decoder *d, int n)
{
    int v = 0;
    for (int k = 0; k < n; k++) v |= png_bit(d) << k;
    return v;
}

static void make_codes(codes *c, const int *length, int n)
{
    int code = 0, place = 0;
    memset(c, 0, sizeof *c);
    for (int i = 0; i < n; i++) c->count[length[i]]++;
    for (int bits = 1; bits < 16; bits++) {
        c->first[bits] = code;
        c->from[bits] = place;
        for (int i = 0; i < n; i++)
            if (length[i] == bits) c->symbol[place++] = i;
        code = (code + c->count[bits]) * 2;
    }
}

static int png_symbol(decoder *d, const codes *c)
{
    int code = 0;
    for (int bits = 1; bits < 16 && !d->fault; bits++) {
        code = code * 2 + png_bit(d);
        if (code - c->first[bits] < c->count[bits])
            return c->symbol[c->from[bits] + code - c->first[bits]];
    }
    d->fault = "no such code";
    return 0;
}

static void put_out(decoder *d, unsigned char byte)
{
    if (d->made >= d->room) d->fault = "too many bytes";
    else d->out[d->made++] = byte;
}

/* Lengths 3, 4, ... and distances 1, 2, ...: so many symbols have 0, 1, 2, ... further bits */
static int stepped(decoder *d, int symbol, int at_once)
{
    int base = 0, more = 0;
    for (int k = 0; k < symbol; k++) {
        more = k < at_once ? 0 : k / (at_once / 2) - 1;
        base += 1 << more;
    }
    more = symbol < at_once ? 0 : symbol / (at_once / 2) - 1;
    return base + png_bits(d, more);
}

static void inflate_block(decoder *d, const codes *lengths, const codes *distances)
{
    while (!d->fault) {
        int symbol = png_symbol(d, lengths);
        if (symbol == 256) return;
        if (symbol < 256) {
            put_out(d, (unsigned char)symbol);
            continue;
        }
        size_t length = (size_t)(symbol == 285 ? 258 : 3 + stepped(d, symbol - 257, 8));
        size_t distance = 1 + (size_t)stepped(d, png_symbol(d, distances), 4);
        if (distance > d->made) d->fault = "a distance before the first byte";
        for (size_t k = 0; k < length && !d->fault; k++) put_out(d, d->out[d->made - distance]);
    }
}

static void png_inflate(decoder *d)
{
    int length[288], five[30], last = 0;
    codes lengths, distances;
    for (int i = 0; i < 288; i++) length[i] = i < 144 ? 8 : i < 256 ? 9 : i < 280 ? 7 : 8;
    for (int i = 0; i < 30; i++) five[i] = 5;
    make_codes(&lengths, length, 288);
    make_codes(&distances, five, 30);
    int head = png_bits(d, 8) * 256;
    head += png_bits(d, 8);
    if ((head >> 8 & 15) != 8 || head % 31 || head & 32) d->fault = "no zlib";
    while (!last && !d->fault) {
        last = png_bit(d);
        if (png_bits(d, 2) != 1) d->fault = "a block without the fixed codes";
        else inflate_block(d, &lengths, &distances);
    }
    while (d->at % 8) png_bit(d);
    uint64_t a = 1, b = 0, sum = 0;
    for (size_t i = 0; i < d->made; i++) {
        a += d->out[i];
        b += a;
    }
    for (int k = 0; k < 4; k++) sum = sum * 256 + (uint64_t)png_bits(d, 8);
    if (sum != b % 65521 * 65536 + a % 65521) d->fault = "Adler-32";
    if (d->at != 8 * d->size) d->fault = "bytes behind the stream";
}

static uint32_t number_at(const unsigned char *p)
{
    return (uint32_t)p[0] << 24 | (uint32_t)p[1] << 16 | (uint32_t)p[2] << 8 | p[3];
}

/* The remainder of the message, its first 32 bits inverted, divided by the polynomial; bits of a
   byte are taken from the lowest on. */
static uint32_t crc_of(const unsigned char *p, size_t n)
{
    uint64_t rest = 0;
    uint32_t turned = 0;
    for (size_t bit = 0; bit < 8 * n + 32; bit++) {
        uint64_t next = bit < 8 * n ? p[bit / 8] >> bit % 8 & 1 : 0;
        rest = rest << 1 | (next ^ (bit < 32));
        if (rest >> 32) rest ^= 0x104C11DB7u;
    }
    for (int k = 0; k < 32; k++) turned |= (uint32_t)(rest >> k & 1) << (31 - k);
    return ~turned;
}

static void unfilter(decoder *d, int width, int height, unsigned char *rgb)
{
    size_t row = 3 * (size_t)width;
    for (size_t y = 0; y < (size_t)height; y++) {
        const unsigned char *in = d->out + y * (row + 1) + 1;
        unsigned char *out = rgb + y * row;
        const unsigned char *above = y ? out - row : out;
        const int filter = in[-1] > 4 ? 0 : in[-1];
        if (in[-1] > 4) d->fault = "no such filter";
        for (size_t i = 0; i < row; i++) {
            int a = i < 3 ? 0 : out[i - 3], b = y ? above[i] : 0;
            int c = i < 3 || !y ? 0 : above[i - 3], p = a + b - c;
            int paeth = abs(p - a) <= abs(p - b) && abs(p - a) <= abs(p - c) ? a
                        : abs(p - b) <= abs(p - c)                           ? b
                                                                             : c;
            const int guess[5] = { 0, a, b, (a + b) / 2, paeth };
            out[i] = (unsigned char)(in[i] + guess[filter]);
        }
    }
}

enum { FILES_SIDE = 300, FILES_BYTES = FILES_SIDE * (3 * FILES_SIDE + 1) };

/* The fault of a PNG, or NULL: then rgb has its pixels, and *srgb its intent, or -1. */
static const char *png_fault(const file_sink *s, int width, int height, int *srgb,
                             unsigned char *rgb)
{
    static unsigned char data[sizeof s->bytes], filtered[FILES_BYTES];
    const unsigned char *p = s->bytes, *end = p + s->size, head[5] = { 8, 2, 0, 0, 0 };
    decoder d = { data, 0, 0, filtered, 0, sizeof filtered, NULL };
    int chunks = 0, ended = 0;
    *srgb = -1;
    if (s->size < 8 || memcmp(p, "\x89PNG\r\n\x1a\n", 8)) return "signature";
    for (p += 8; !ended; chunks++) {
        if (end - p < 12 || (size_t)(end - p) < 12 + (size_t)number_at(p)) return "a chunk is cut";
        size_t n = number_at(p);
        if (number_at(p + 8 + n) != crc_of(p + 4, 4 + n)) return "CRC-32";
        if (!chunks != !memcmp(p + 4, "IHDR", 4)) return "IHDR is the first, and only there";
        if (!chunks && (n != 13 || number_at(p + 8) != (uint32_t)width ||
                        number_at(p + 12) != (uint32_t)height || memcmp(p + 16, head, 5)))
            return "IHDR";
        if (!memcmp(p + 4, "sRGB", 4)) {
            if (d.size || n != 1) return "sRGB";
            *srgb = p[8];
        } else if (!memcmp(p + 4, "IDAT", 4)) {
            memcpy(data + d.size, p + 8, n);
            d.size += n;
        } else if (!memcmp(p + 4, "IEND", 4)) {
            ended = n == 0;
        } else if (chunks) return "a chunk that nobody needs";
        p += 12 + n;
    }
    if (p != end) return "bytes behind IEND";
    png_inflate(&d);
    if (!d.fault && d.made != (size_t)height * (3 * (size_t)width + 1)) d.fault = "too few bytes";
    if (!d.fault) unfilter(&d, width, height, rgb);
    return d.fault;
}

/* Contents: 0 noise; 1 noise of bytes from 144 on, which take 9 bits; 2 runs of a few pixels; 3 one
   colour; 4 a slope with a little noise; 5 rows that repeat; 6 floats of any bits. */
enum { FILES_KINDS = 7 };
static void fill_pixels(canvas *c, int kind)
{
    size_t cell = canvas_pixel_bytes(c->target.format);
    unsigned char some[4][16] = { { 0 } };
    for (int i = 0; i < 64; i++) some[i / 16][i % 16] = (unsigned char)rnd_int(0, 255);
    size_t run = 0, which = 0;
    for (int y = 0; y < canvas_rows(c); y++)
        for (int x = 0; x < c->target.width; x++) {
            unsigned char *p = canvas_pixel(c, x, c->target.row_offset + y);
            if (!run--) {
                which = (size_t)rnd_int(0, 3);
                run = (size_t)rnd_int(0, 400) >> which * 3;
            }
            for (size_t k = 0; k < cell; k++) {
                if (kind == 0) p[k] = (unsigned char)rnd_int(0, 255);
                else if (kind == 1) p[k] = (unsigned char)rnd_int(144, 255);
                else if (kind == 2) p[k] = some[which][k];
                else if (kind == 3) p[k] = some[0][k];
                else if (kind == 4) p[k] = (unsigned char)(x + 2 * y + rnd_int(0, 1));
                else p[k] = some[(x >> y % 3) % 4][k];
            }
            if (c->target.format == SHADE_FORMAT_RGBA32F && kind != 3)
                for (int k = 0; k < 4; k++) {
                    float f = kind == 6       ? rnd_nasty()
                              : rnd_one_in(9) ? rnd_float(-0.2, 1.2)
                                              : (float)(x + y + kind) / 600;
                    memcpy(p + 4 * k, &f, 4);
                }
        }
}

/* Encodes a picture both ways: the PNG is valid, has the pixels of the PPM, and is not much longer.
 */
static void check_png(int width, int height, int offset, int rows, shade_format format, int kind)
{
    static file_sink png, ppm;
    static unsigned char rgb[3 * FILES_SIDE * FILES_SIDE];
    const int strip = rows != height;
    canvas c = canvas_strip(width, height, width + rnd_int(0, 5), format, 0, offset,
                            strip ? rows : 0);
    int srgb = -2;
    fill_pixels(&c, kind);
    c.target.srgb = rnd_one_in(2);
    c.target.clip_x = rnd_int(0, 5); /* files hold the whole picture */
    c.target.clip_width = rnd_int(0, 5);
    png.size = ppm.size = 0;
    CHECK_INT(shade_encode_ppm(file_write, &ppm, &c.target), SHADE_OK);
    CHECK_INT(shade_encode_png(file_write, &png, &c.target), SHADE_OK);
    const char *said = png_fault(&png, width, rows, &srgb, rgb);
    CHECK_SAY(!said, "%s: %d x %d, format %d, kind %d", said, width, rows, format, kind);
    CHECK_INT(srgb, c.target.srgb ? 0 : -1);
    size_t bytes = 3 * (size_t)width * (size_t)rows;
    CHECK_SAY(ppm.size > bytes && !memcmp(ppm.bytes + ppm.size - bytes, rgb, bytes),
              "other pixels: %d x %d, format %d, kind %d", width, rows, format, kind);
    CHECK_SAY((double)png.size <= 1.13 * (double)ppm.size + 90 + rows,
              "%d bytes, %d of PPM: %d x %d, kind %d", (int)png.size, (int)ppm.size, width, rows,
              kind);
    canvas_close(&c);
}

/* All squares up to 100, some up to 300; all formats and contents up to 40, of any shape, and as
   strips */
/* G20 */
TEST(files, a_png_holds_the_pixels_of_the_ppm)
{
    for (int n = 1; n <= FILES_SIDE; n += n < 100 ? 1 : 6)
        check_png(n, n, 0, n, (shade_format)(n % CANVAS_FORMATS), n / CANVAS_FORMATS % FILES_KINDS);
    for (int i = 0; i < 40 * CANVAS_FORMATS * FILES_KINDS; i++) {
        int width = rnd_int(1, 40), height = rnd_int(1, 40);
        int rows = rnd_one_in(2) ? height : rnd_int(1, height);
        check_png(width, height, rnd_int(0, height - rows), rows,
                  (shade_format)(i % CANVAS_FORMATS), i / CANVAS_FORMATS % FILES_KINDS);
    }
}

/* Bytes of 9 bits in rows of every width, which no filter shortens by much */
/* G20 */
TEST(files, a_png_of_noise_is_at_most_an_eighth_longer)
{
    for (int i = 0; i < 20; i++)
        check_png(rnd_int(1, FILES_SIDE), 300, 0, 300, SHADE_FORMAT_RGBA8, 1);
    check_png(1, FILES_SIDE, 0, FILES_SIDE, SHADE_FORMAT_RGBA8, 1);
    check_png(FILES_SIDE, 1, 0, 1, SHADE_FORMAT_RGBA8, 1);
}

static uintptr_t deepest;
static int note_depth(void *user, const void *bytes, size_t size)
{
    unsigned char here = 0;
    (void)user;
    (void)bytes;
    (void)size;
    if ((uintptr_t)(void *)&here < deepest) deepest = (uintptr_t)(void *)&here;
    return 0;
}

/* G20 */
TEST(files, a_png_takes_less_than_four_kilobytes_of_stack)
{
#if defined(__OPTIMIZE__) && !FILES_SANITIZED
    unsigned char entry = 0;
    canvas c = canvas_open(300, 200, 0, SHADE_FORMAT_RGBA32F, 0);
    fill_pixels(&c, 0);
    c.target.srgb = 1;
    deepest = (uintptr_t)(void *)&entry;
    CHECK_INT(shade_encode_png(note_depth, NULL, &c.target), SHADE_OK);
    long taken = (long)((uintptr_t)(void *)&entry - deepest);
    CHECK_SAY(taken > 2816 && taken < 4096, "%ld bytes", taken);
    canvas_close(&c);
#else
    test_skip("frames of this build are larger");
#endif
}

/* One bit that changes anywhere is found: the decoder of these tests is no rubber stamp. */
TEST(files, the_decoder_finds_a_bit_that_is_wrong)
{
    static file_sink png;
    static unsigned char rgb[3 * FILES_SIDE * FILES_SIDE];
    canvas c = canvas_open(9, 7, 0, SHADE_FORMAT_RGBA8, 0);
    int srgb;
    fill_pixels(&c, 4);
    png.size = 0;
    CHECK_INT(shade_encode_png(file_write, &png, &c.target), SHADE_OK);
    CHECK(!png_fault(&png, 9, 7, &srgb, rgb));
    for (size_t bit = 0; bit < 8 * png.size; bit++) {
        png.bytes[bit / 8] ^= (unsigned char)(1 << bit % 8);
        CHECK_SAY(png_fault(&png, 9, 7, &srgb, rgb) != NULL, "bit %d", (int)bit);
        png.bytes[bit / 8] ^= (unsigned char)(1 << bit % 8);
    }
    canvas_close(&c);
}
