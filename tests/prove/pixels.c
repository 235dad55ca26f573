/* pixels.c - targets, their pixels in every format, x^n and sRGB.
   Each part is a driver of prove.sh. */

#ifdef PROVE_target
/* Any fields of a target: checked without overflow, and if it is good the clip rectangle
   lies in the picture and in the rows held, whose pixels 32 bits count. */
/* eva: -eva-slevel 100 -eva-split-return-function shade__check_target:0,shade__target_fault:0 */
#include "prove.h"

int main(void)
{
    static uint32_t pixels[1];
    static float depth[1];
    shade_target t;
    int r[4];
    t.color = pixels;
    t.depth = depth;
    t.width = ANY_OF(INT32_MIN, INT32_MAX);
    t.height = ANY_OF(INT32_MIN, INT32_MAX);
    t.stride = ANY_OF(INT32_MIN, INT32_MAX);
    t.format = (shade_format)Frama_C_unsigned_int_interval(0, 0xFFFFFFFFu);
    t.clip_x = ANY_OF(INT32_MIN, INT32_MAX);
    t.clip_y = ANY_OF(INT32_MIN, INT32_MAX);
    t.clip_width = ANY_OF(INT32_MIN, INT32_MAX);
    t.clip_height = ANY_OF(INT32_MIN, INT32_MAX);
    t.row_offset = ANY_OF(INT32_MIN, INT32_MAX);
    t.row_count = ANY_OF(INT32_MIN, INT32_MAX);
    t.srgb = t.dither = 1;
    if (shade__check_target(&t) != SHADE_OK) return 0;
    /*@ assert 1 <= t.width <= 16384 && 1 <= t.height <= 16384; */
    /*@ assert 0 <= t.row_offset <= 16384 && 0 <= t.row_count <= 16384; */
    shade__clip_rectangle(&t, r);
    if (r[0] >= r[2] || r[1] >= r[3]) return 0;    /* empty: what it returns */
    /*@ assert 0 <= r[0] < 16384 && 0 <= r[1] < 32768; */
    /*@ assert 1 <= r[2] <= 16384 && 1 <= r[3] <= 32768; */
    const int stride = shade__stride_of(&t), rows = shade__rows_held(&t);
    /*@ assert 1 <= stride && 1 <= rows <= 16384; */
    return 0;
}
#endif

#ifdef PROVE_clear
/* Filling rows and rectangles: any clip rectangle, colour and depth, every format. */
#define SHADE_LANES 128
#include "prove.h"

static uint32_t color[4 * 17], memory[301];
static float depth[17];

/* n bytes that end where a guard begins */
static void prove_fill(void)
{
    float pattern[64];
    any_floats(pattern, 64);
    memory[300] = 0xA5A5A5A5u;
    /*@ loop unroll 400; */
    for (size_t n = 0; n <= 1200; n += n < 540 ? 2 : 60)
        shade__fill((uint8_t *)(memory + 300) - n, pattern, n);
    /*@ assert memory[300] == 0xA5A5A5A5; */
}

/* 5 x 3 pixels, 6 from row to row, whose memory ends with the last one */
static void prove_clear(shade_format format)
{
    shade_target t = { .color = (uint8_t *)color + sizeof color - 17 * shade__pixel_bytes(format),
                       .depth = depth, .width = 5, .height = 3, .stride = 6, .format = format };
    t.srgb = ANY_OF(0, 1);
    t.dither = ANY_OF(0, 1);
    for (int x = -1; x <= 5; x += 2) {
        for (int w = 0; w <= 6; w += 3) {
            t.clip_x = x;
            t.clip_width = w;
            t.clip_y = ANY_OF(INT32_MIN, INT32_MAX);
            t.clip_height = ANY_OF(0, INT32_MAX);
            shade_clear(&t, shade_v4(any_float(), any_float(), any_float(), any_float()),
                        any_float());
        }
    }
}

int main(void)
{
    prove_fill();
    prove_clear(SHADE_FORMAT_RGBA8);
    prove_clear(SHADE_FORMAT_RGB565);
    prove_clear(SHADE_FORMAT_RGB565_SWAPPED);
    prove_clear(SHADE_FORMAT_RGBA32F);
    return 0;
}
#endif

#ifdef PROVE_pack
/* Pixels of every format from any floats, and back from any bytes. */
#define SHADE_LANES 16
#include "prove.h"

enum { N = SHADE__BLOCK };

static void prove_target(shade_target *t)
{
    float rgba[4 * SHADE_LANES], x[N], y[N];
    uint32_t packed[N] = { 0 };
    uint8_t pixel[16];
    const shade__layout *l = &shade__layouts[t->format];
    const size_t bytes = l->bytes;
    any_floats(rgba, 4 * SHADE_LANES);
    for (int i = 0; i < N; i++) {    /* pixel centres of a picture, and what resolve may ask */
        x[i] = Frama_C_float_interval(0, 16400);
        y[i] = Frama_C_float_interval(0, 16400);
    }
    shade__pack_any(t, rgba, x, y, packed, 1);
    if (bytes == 2) {    /* alpha, which is not stored, in the bit above */
        /*@ assert packed[0] <= 131071 && packed[N - 1] <= 131071; */
    }
    /* a pixel that ends where the array does */
    shade__store_pixel(l, pixel + (sizeof pixel - bytes), packed[0], rgba);
    for (int i = 0; i < 16; i++) pixel[i] = Frama_C_unsigned_char_interval(0, 255);
    shade__load_pixel(l, pixel + (sizeof pixel - bytes), packed, rgba);
    shade__unpack_any(t, packed, rgba);
    for (int k = 0; k < 4; k++) {
        float c = rgba[k * SHADE_LANES];
        if (t->format != SHADE_FORMAT_RGBA32F && !t->srgb) {
            /*@ assert 0 <= c <= 1; */
        }
    }
}

static void prove_formats(int srgb, int dither)
{
    shade_target t = { .srgb = srgb, .dither = dither, .format = SHADE_FORMAT_RGBA8 };
    prove_target(&t);
    t.format = SHADE_FORMAT_BGRA8;
    prove_target(&t);
    t.format = SHADE_FORMAT_RGB565;
    prove_target(&t);
    t.format = SHADE_FORMAT_RGB565_SWAPPED;
    prove_target(&t);
    t.format = SHADE_FORMAT_RGBA32F;
    prove_target(&t);
}

/* the thresholds of the dither, and channels rounded by them */
static void prove_parts(void)
{
    float rgba[4 * SHADE_LANES], x[N], y[N], threshold[N];
    uint32_t packed[N];
    any_floats(rgba, 4 * SHADE_LANES);
    for (int i = 0; i < N; i++) {
        float unit = shade__saturate(rgba[i]);
        /*@ assert 0 <= unit <= 1; */
        x[i] = Frama_C_float_interval(0, 16400);
        y[i] = Frama_C_float_interval(0, 16400);
    }
    shade__dither(x, y, threshold, 1);
    for (int i = 0; i < N; i++) {
        /*@ assert 0 < threshold[i] < 1; */
    }
    shade__pack_channels(&shade__layouts[SHADE_FORMAT_RGBA8], rgba, threshold, packed, 1);
    shade__pack_channels(&shade__layouts[SHADE_FORMAT_RGB565], rgba, threshold, packed, 1);
    for (int i = 0; i < N; i++) {
        /*@ assert packed[i] <= 131071; */
        uint32_t swapped = shade__swap16(packed[i]);
        /*@ assert swapped <= 65535; */
    }
}

int main(void)
{
    prove_parts();
    for (int srgb = 0; srgb < 2; srgb++)
        for (int dither = 0; dither < 2; dither++) prove_formats(srgb, dither);
    return 0;
}
#endif

#ifdef PROVE_pictures
/* Pixels that resolve and mipmaps read and write: blocks at every edge of a picture
   whose memory ends with the last pixel; offsets in the greatest picture. */
#include "prove.h"

enum { WIDTH = 9, HEIGHT = 3 };

static shade_target in, out;
static shade__decoder decoder;
static shade__halving halving;
static uint8_t fine[16 * 64 * WIDTH * HEIGHT], coarse[16 * WIDTH * HEIGHT];

/* rows that end within a block */
static void prove_resolve(shade_format format, int factor)
{
    const size_t bytes = shade__pixel_bytes(format);
    in.format = out.format = format;
    in.width = WIDTH * factor;
    in.height = HEIGHT * factor;
    out.width = WIDTH;
    out.height = HEIGHT;
    in.color = fine + sizeof fine - (size_t)(WIDTH * HEIGHT * factor * factor) * bytes;
    out.color = coarse + sizeof coarse - (size_t)(WIDTH * HEIGHT) * bytes;
    shade__open_decoder(&in, factor, &decoder);
    shade__convert(&decoder, &out);
}

/* a level of mipmaps from the one before, in memory that ends with the last texel of each */
static void prove_shrink(shade_format format, int width, int height)
{
    const size_t bytes = shade__pixel_bytes(format);
    in.format = out.format = format;
    in.width = width;
    in.height = height;
    out.width = width / 2 > 0 ? width / 2 : 1;
    out.height = height / 2 > 0 ? height / 2 : 1;
    in.color = fine + sizeof fine - (size_t)(width * height) * bytes;
    out.color = coarse + sizeof coarse - (size_t)(out.width * out.height) * bytes;
    shade__open_decoder(&in, 2, &decoder);
    for (int v = 0; v < SHADE__DOUBLES; v++) halving.light[v] = (double)decoder.value[v];
    decoder.halving = &halving;
    shade__convert(&decoder, &out);
}

/* offsets of pixels in the greatest picture, its rows however far apart */
static void prove_offsets(void)
{
    size_t offset;
    in.width = 16384;
    in.height = 16384;
    in.row_offset = 0;
    in.stride = ANY_OF(16384, INT32_MAX);
    offset = shade__offset_of(&in, ANY_OF(0, 16383), ANY_OF(0, 16383));
    /*@ assert offset <= 35184372088832; */
}

int main(void)
{
    memset(fine, ANY_OF(0, 255), sizeof fine);
    for (int factor = 1; factor <= 8; factor++) {
        prove_resolve(SHADE_FORMAT_RGBA8, factor);
        prove_resolve(SHADE_FORMAT_RGB565, factor);
    }
    prove_resolve(SHADE_FORMAT_RGBA32F, 3);
    prove_shrink(SHADE_FORMAT_RGBA8, 17, 5);
    prove_shrink(SHADE_FORMAT_RGB565, 6, 9);
    prove_shrink(SHADE_FORMAT_A8, 7, 1);
    prove_shrink(SHADE_FORMAT_RGBA32F, 3, 8);
    prove_offsets();
    return 0;
}
#endif

#ifdef PROVE_files
/* Bytes of files: pixels at every edge of a picture whose memory ends with the last pixel, filters
   of any bytes, and packing from any state that a stream of bytes can reach. */
#include "prove.h"

enum { WIDTH = 67, HEIGHT = 2 };    /* a run of 64 pixels, and one of 3 */

static shade_target picture;
static uint8_t pixels[16 * WIDTH * HEIGHT];
static shade__png_rows rows;
static shade__png png;

static int swallow(void *user, const void *bytes, size_t size)
{
    (void)user;
    (void)bytes;
    /*@ assert 0 < size <= 2828; */
    return ANY_OF(0, 1);
}

static void prove_rows(shade_format format)
{
    picture.format = format;
    picture.width = WIDTH;
    picture.height = HEIGHT;
    picture.srgb = ANY_OF(0, 1);
    picture.color = pixels + sizeof pixels - WIDTH * HEIGHT * shade__pixel_bytes(format);
    shade__png_rows_at(&picture, 0, 0, 64, &rows);
    shade__png_rows_at(&picture, 64, 1, 3, &rows);
}

/* A byte after any others: up to 257 wait as a run, up to 7 bits, and a chunk is full or not. */
static void prove_packing(void)
{
    png.target = &picture;
    png.sink = swallow;
    for (int k = 0; k < 3; k++) png.before[k] = ANY_OF(0, 255);
    png.repeats = ANY_OF(0, SHADE__PNG_REPEAT);
    png.distances = ANY_OF(0, 3);
    png.sum[0] = (uint32_t)ANY_OF(0, 65520);
    png.sum[1] = (uint32_t)ANY_OF(0, 65520);
    png.bits = (uint32_t)ANY_OF(0, 127);
    png.bit_count = ANY_OF(0, 7);
    png.size = (uint32_t)ANY_OF(0, SHADE__PNG_DATA);
    shade__take_byte(&png, ANY_OF(0, 255));
}

int main(void)
{
    memset(pixels, ANY_OF(0, 255), sizeof pixels);
    prove_rows(SHADE_FORMAT_RGBA8);
    prove_rows(SHADE_FORMAT_BGRA8);
    prove_rows(SHADE_FORMAT_RGB565);
    prove_rows(SHADE_FORMAT_RGB565_SWAPPED);
    prove_rows(SHADE_FORMAT_RGBA32F);
    memset(&rows, ANY_OF(0, 255), sizeof rows);
    for (int filter = 0; filter < 5; filter += 2) {
        int byte = shade__filtered(&rows, filter, ANY_OF(0, 3 * SHADE__FILE_RUN - 1));
        /*@ assert 0 <= byte <= 255; */
    }
    prove_packing();
    return 0;
}
#endif

#ifdef PROVE_power
/* Log2 and exp2 of >>power, and what is made of them: any bits in. */
#define SHADE_LANES 128
#include "prove.h"

/* -log2 x, x in octaves around powers of two, from sqrt(1/2) to sqrt(2) times 2^(e - 127) */
static void prove_neg_log2(void)
{
    /*@ loop unroll 128; */
    for (int e = 1; e <= 127; e++) {
        float x = float_of_bits(((uint32_t)(e - 1) << 23) + 0x3504F3u,
                                e == 127 ? 0x3F800000u : ((uint32_t)e << 23) + 0x3504F2u);
        float u = shade__neg_log2(x);
        /*@ assert 127 - e - 0.8 <= u <= 127 - e + 0.8 && u >= 0; */
    }
    float all = shade__neg_log2(any_float());
    /*@ assert -386 <= all <= 128; */
}

/* 2^-u by the whole number nearest to u, with the two floats at the end, where u + 1/2 may round
   to the next, apart; and where there is none */
static void prove_exp2_neg(void)
{
    float least = shade__exp2_neg(float_of_bits(0, 0x3EFFFFFEu));    /* below 1/2 */
    /*@ assert 0.5 <= least <= 1; */
    float end = shade__exp2_neg(shade__bits_float(0x3EFFFFFFu));
    /*@ assert 0.7 <= end <= 0.75; */
    /*@ loop unroll 130; */
    for (int k = 1; k <= 125; k++) {
        const uint32_t first = shade__float_bits((float)k - 0.5f);
        const uint32_t next = shade__float_bits((float)k + 0.5f);
        float p = shade__exp2_neg(float_of_bits(first, next - 3));
        float q = shade__exp2_neg(float_of_bits(next - 2, next - 1));
        /*@ assert 0 < p <= 0.75 && 0 < q <= 0.75; */
    }
    float last = shade__exp2_neg(Frama_C_float_interval(125.5f, 126.5f));
    /*@ assert 0 <= last <= 2e-38; */
    float most = shade__exp2_neg(float_of_bits(0x42FC0000u, 0x7F800000u));    /* 126, infinite */
    /*@ assert most == 0; */
    float zero = shade__exp2_neg(float_of_bits(0x80000000u, 0x80000000u));
    /*@ assert zero == 1; */
}

int main(void)
{
    prove_neg_log2();
    prove_exp2_neg();
    shade_power(any_float(), any_float());
    shade_vec3 any = shade_v3(any_float(), any_float(), any_float());
    shade_srgb_from_linear(any);
    shade_linear_from_srgb(any);
    shade_rgb(Frama_C_unsigned_int_interval(0, 0xFFFFFFFFu));
    return 0;
}
#endif
