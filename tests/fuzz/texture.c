/* texture.c - shade_sample, shade_sample_lanes and the building of mipmaps. */
#include "picture.h"

/* Room exact or short; a short one is refused and stays as it was. */
static void texture_mipmaps(fuzz_input *in, shade_texture *t, shade_texture *levels)
{
    uint32_t kind = fuzz_byte(in);
    int good = texture_is_good(t), count = shade_mipmap_count(t->width, t->height), w, h;
    size_t need = shade_mipmap_bytes(t->width, t->height, t->format), bytes;
    uint8_t *memory, *copy;
    shade_texture before = *t;
    shade_result result;
    if (!good) {
        HOLDS(shade_build_mipmaps(t, levels, levels, SIZE_MAX) == SHADE_ERROR_TEXTURE);
        HOLDS(!memcmp(&before, t, sizeof before));
        return;
    }
    bytes = kind & 1 && need ? need - 1 - fuzz_byte(in) % need : need;
    memory = (uint8_t *)guard_take((bytes + 3) & ~(size_t)3, kind >> 1 & 1);
    copy = (uint8_t *)malloc(bytes + 4);
    if (!copy) exit(2);
    fuzz_noise(memory, (bytes + 3) & ~(size_t)3, kind);
    memcpy(copy, memory, (bytes + 3) & ~(size_t)3);
    result = shade_build_mipmaps(t, levels, memory, bytes);
    HOLDS(result == (bytes < need ? SHADE_ERROR_CAPACITY : SHADE_OK));
    if (result != SHADE_OK) {
        HOLDS(!memcmp(memory, copy, (bytes + 3) & ~(size_t)3));
        HOLDS(!memcmp(&before, t, sizeof before));
        free(copy);
        return;
    }
    HOLDS(!memcmp(memory + bytes, copy + bytes, ((bytes + 3) & ~(size_t)3) - bytes));
    free(copy);
    HOLDS(t->mipmaps == levels && t->mipmap_count == count);
    w = t->width;
    h = t->height;
    for (int k = 0; k < count; k++) {
        w = w / 2 > 1 ? w / 2 : 1;
        h = h / 2 > 1 ? h / 2 : 1;
        HOLDS(levels[k].width == w && levels[k].height == h && texture_is_good(&levels[k]));
    }
    HOLDS(w == 1 && h == 1);
}

static int texture_nan_free(const shade_texture *t)
{
    if (t->format != SHADE_FORMAT_RGBA32F) return 1;
    for (int y = 0; y < t->height; y++)
        for (int i = 0; i < 4 * t->width; i++) {
            size_t stride = (size_t)(t->stride ? t->stride : t->width);
            float f;
            memcpy(&f, (const char *)t->pixels + 16 * stride * (size_t)y + 4 * (size_t)i, 4);
            if (!(f >= 0 && f <= 2)) return 0;
        }
    return 1;
}

/* A packed texture whose bytes stand the other way round gives the same colours. */
static void texture_turned(const shade_texture *t, const float *u, const float *v,
                           const float *rgba)
{
    static const shade_format other[] = { SHADE_FORMAT_BGRA8, SHADE_FORMAT_RGBA8,
                                          SHADE_FORMAT_RGB565_SWAPPED, SHADE_FORMAT_RGB565 };
    shade_texture turned = *t;
    size_t bytes = fuzz_pixel_bytes(t->format), cells;
    const uint8_t *from = (const uint8_t *)t->pixels;
    float again[4 * SHADE_LANES];
    uint8_t *to;
    if (t->format >= SHADE_FORMAT_RGBA32F) return;
    cells = fuzz_cells(t->height, t->stride ? t->stride : t->width, t->width);
    to = (uint8_t *)malloc(cells * bytes);
    if (!to) exit(2);
    for (size_t i = 0; i < cells * bytes; i += bytes) {
        memcpy(to + i, from + i, bytes);
        to[i] = from[i + bytes / 2];
        to[i + bytes / 2] = from[i];
    }
    turned.pixels = to;
    turned.format = other[t->format];
    shade_sample_lanes(&turned, u, v, NULL, again);
    for (int i = 0; i < 4 * SHADE_LANES; i++) HOLDS(again[i] == rgba[i]);
    free(to);
}

int LLVMFuzzerTestOneInput(const uint8_t *data, size_t size)
{
    fuzz_input in = { data, data + size };
    shade_texture t, levels[20];
    uint32_t kind = fuzz_byte(&in);
    int good, bounded, rounds = fuzz_int(&in, 1, 12);
    size_t rows = SHADE_LANES * sizeof(float);
    float *u, *v, *lod, *rgba, *again;
    memset(levels, 0, sizeof levels);
    t = texture_open(&in, 24, (int)(kind & 1));
    fuzz_level = (int)(kind >> 1) % (fuzz_widest() + 1);
    if (kind & 16) texture_mipmaps(&in, &t, levels);
    if ((kind & 32) && t.mipmap_count > 0)
        levels[fuzz_int(&in, 0, t.mipmap_count - 1)] = texture_open(&in, 8, (int)(kind & 1));
    if ((kind & 0xC0) == 0xC0) {
        t.mipmaps = NULL;
        t.mipmap_count = fuzz_wild_int(&in);
    }
    good = texture_is_good(&t);
    bounded = good && texture_nan_free(&t);
    for (int k = 0; t.mipmaps && k < t.mipmap_count; k++)
        if (texture_is_good(&levels[k])) bounded = bounded && texture_nan_free(&levels[k]);
    u = (float *)guard_take(rows, kind >> 3 & 1);
    v = (float *)guard_take(rows, kind >> 3 & 1);
    lod = (float *)guard_take(rows, kind >> 4 & 1);
    rgba = (float *)guard_take(4 * rows, kind >> 3 & 1);
    again = (float *)guard_take(4 * rows, kind >> 4 & 1);
    for (int round = 0; round < rounds && in.at < in.end; round++) {
        int with_lod = !fuzz_one_in(&in, 4);
        for (int i = 0; i < SHADE_LANES; i++) {    /* few inputs, spread over the lanes */
            u[i] = i % 4 ? u[i - 1] * 1.5f + 0.1f : fuzz_float(&in);
            v[i] = i % 4 ? v[i - 1] + 0.37f : fuzz_float(&in);
            lod[i] = i % 4 ? lod[i - 1] + 0.6f : fuzz_float(&in);
        }
        fuzz_noise(rgba, 4 * rows, kind);
        fuzz_noise(again, 4 * rows, kind + 1);
        if (good && !round) {
            shade_sample_lanes(&t, u, v, NULL, rgba);
            texture_turned(&t, u, v, rgba);
        }
        shade_sample_lanes(&t, u, v, with_lod ? lod : NULL, rgba);
        fuzz_level = (fuzz_level + 1) % (fuzz_widest() + 1);
        shade_sample_lanes(&t, u, v, with_lod ? lod : NULL, again);
        for (int i = 0; i < 4 * SHADE_LANES; i++) {
            HOLDS(fuzz_same(rgba[i], again[i]));
            if (!good) HOLDS(rgba[i] == 1);
            if (t.format == SHADE_FORMAT_A8 && !t.mipmaps)
                HOLDS(rgba[i] == 1 || i >= 3 * SHADE_LANES);
            if (bounded)
                HOLDS(rgba[i] >= -1e-5f &&
                      rgba[i] <= (t.format == SHADE_FORMAT_RGBA32F || t.mipmap_count > 0
                                      ? 2.0001f
                                      : 1.00001f));
        }
        for (int i = 0; i < SHADE_LANES; i += 3) {
            shade_vec4 c = shade_sample(&t, u[i], v[i], with_lod ? lod[i] : 0);
            HOLDS(fuzz_same(c.x, rgba[i]) && fuzz_same(c.y, rgba[i + SHADE_LANES]));
            HOLDS(fuzz_same(c.z, rgba[i + 2 * SHADE_LANES]));
            HOLDS(fuzz_same(c.w, rgba[i + 3 * SHADE_LANES]));
        }
    }
    guard_close();
    return 0;
}
