/* maps.h - random textures with their mipmaps, and what their pixels hold. */
#ifndef MAPS_H
#define MAPS_H

/* The bytes of a pixel or texel as linear RGBA.  Floats are linear whatever srgb says. */
static inline void ref_pixel(shade_format format, int srgb, const unsigned char *p, double v[4])
{
    float f[4];
    if (format == SHADE_FORMAT_RGBA32F) memcpy(f, p, 16);
    for (int k = 0; k < 4; k++) {
        int most = canvas_most(format, k);
        if (format == SHADE_FORMAT_RGBA32F)
            v[k] = (double)f[k];
        else
            v[k] = most ? canvas_code_at(format, p, k) / (double)most : 1;
        if (format != SHADE_FORMAT_RGBA32F && srgb && k < 3) v[k] = ref_decode_srgb(v[k]);
    }
}

static const uint32_t map_of_no_texels;

typedef struct lod_scene {
    shade_vec4 clip[3];
    float attribute[3][5]; /* a stranger before and after u, v */
    int first;             /* u is varying first */
    float (*lod)[64];      /* per pixel, NAN: none */
} lod_scene;

static inline void lod_vertex(const void *uniforms, const shade_vertex_ids *SHADE_RESTRICT in,
                              shade_vertices *SHADE_RESTRICT out)
{
    const lod_scene *s = (const lod_scene *)uniforms;
    for (int i = 0; i < SHADE_LANES; i++) {
        scene_put_clip(out, i, s->clip[in->index[i]]);
        for (int k = 0; k < 5; k++) out->varying[k][i] = s->attribute[in->index[i]][k];
    }
}

static inline size_t texture_stride(const shade_texture *t)
{
    return (size_t)(t->stride ? t->stride : t->width);
}

static inline size_t texture_cells(const shade_texture *t) /* no padding after the last row */
{
    return texture_stride(t) * (size_t)(t->height - 1) + (size_t)t->width;
}

static inline void fill_texels(shade_texture *t, void *pixels) /* padding too */
{
    size_t cells = texture_cells(t);
    if (t->format == SHADE_FORMAT_RGBA32F) {
        float *f = (float *)pixels;
        for (size_t i = 0; i < 4 * cells; i++) f[i] = rnd_float(-1, 3);
    } else {
        unsigned char *p = (unsigned char *)pixels;
        size_t bytes = cells * canvas_pixel_bytes(t->format);
        for (size_t i = 0; i < bytes; i++) p[i] = (unsigned char)rnd_bits();
    }
    t->pixels = pixels;
}

/* A texture of its own memory, not a byte too large, so that address checkers see every stray
   read. free(pixels) */
static inline shade_texture texture_of(int width, int height, shade_format format)
{
    shade_texture t = { .width = width, .height = height, .format = format };
    t.stride = rnd_one_in(2) ? 0 : width + rnd_int(0, 5);
    fill_texels(&t, test_memory(texture_cells(&t) * canvas_pixel_bytes(format)));
    return t;
}

static inline shade_texture random_texture(int most)
{
    int w = rnd_one_in(5) ? 1 : rnd_int(1, most), h = rnd_one_in(5) ? 1 : rnd_int(1, most);
    if (rnd_one_in(4)) w = h = 1 << rnd_int(0, 4);
    shade_texture t = texture_of(w, h, rnd_texture_format());
    t.srgb = rnd_one_in(2);
    t.wrap_u = (shade_wrap)rnd_int(0, 2);
    t.wrap_v = (shade_wrap)rnd_int(0, 2);
    return t;
}

static inline void free_texture(shade_texture *t)
{
    void *p;
    memcpy(&p, &t->pixels, sizeof p);
    free(p);
}

/* with mipmaps in *memory and levels[15] */
static inline void *add_mipmaps(shade_texture *t, shade_texture *levels)
{
    size_t bytes = shade_mipmap_bytes(t->width, t->height, t->format);
    void *memory = test_memory(bytes ? bytes : 1);
    CHECK_INT(shade_build_mipmaps(t, levels, memory, bytes), SHADE_OK);
    return memory;
}

static inline float random_coordinate(void)
{
    switch (rnd_int(0, 9)) {
    case 0: return rnd_nasty();
    case 1: return (float)rnd_int(-3, 3);
    case 2: return rnd_sign() * rnd_log(1, 1e9);
    case 3: return rnd_sign() * rnd_log(1e-30, 1e-3);
    case 4: return 1 - rnd_log(1e-8, 1e-3);
    default: return rnd_float(-2.5, 3.5);
    }
}

/* a map of which nothing but the size is read */
static inline shade_texture lod_map(int width, int height)
{
    shade_texture map = { .pixels = &map_of_no_texels, .width = width, .height = height };
    return map;
}

#endif
