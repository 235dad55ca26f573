/* meshes.h - the least that a mesh, a state and a light are made of, as most tests of meshes start
   from them; meshes of random triangles, and which of them a ray hits;
   random textures with their mipmaps, and what their pixels hold. */
#ifndef MESHES_H
#define MESHES_H

/* ------------------------------------------------------------------------------------- textures */

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

/* --------------------------------------------------------------------------------------- meshes */

static const float big_triangle[] = { -0.9f, -0.9f, 0, 0.9f, -0.8f, 0, 0, 0.9f, 0 };

/* Positions one after the other, three to a triangle. */
static inline shade_mesh plain_mesh(const float *positions, int vertices)
{
    shade_mesh m = { .positions = positions, .vertex_count = vertices };
    return m;
}

/* All defaults, and one light or none. */
static inline shade_draw_state plain_state(const shade_light *light)
{
    shade_draw_state s = { .lighting.lights = light, .lighting.light_count = light ? 1 : 0 };
    return s;
}

/* Draws a mesh that is good. */
static inline shade_stats canvas_draw_mesh(canvas *c, const shade_mesh *m,
                                           const shade_draw_state *s)
{
    shade_stats stats;
    memset(&stats, CANVAS_BYTE, sizeof stats);
    CHECK_INT(shade_draw_mesh(&c->target, m, s, &stats), SHADE_OK);
    CHECK_INT(stats.culled + stats.clipped + stats.rejected + stats.drawn, stats.triangles);
    return stats;
}

/* --------------------------------------------------------------------------------------- random */

enum { MESH_VERTICES = 200, MESH_INDICES = 600 };

typedef struct test_mesh {
    float data[MESH_VERTICES * 16]; /* interleaved or one array after the other */
    uint32_t indices[MESH_INDICES];
    shade_vec3 position[MESH_VERTICES], normal[MESH_VERTICES], color[MESH_VERTICES];
    shade_mesh mesh;
    shade_draw_state state;
    shade_light lights[3];
    shade_material material;
} test_mesh;

/* Lays position, normal and colour out with a random stride, or tightly one after the other. */
static inline void lay_out_mesh(test_mesh *m, int vertices, int with_normals, int with_colors)
{
    int interleaved = rnd_one_in(2), step = interleaved ? 9 + rnd_int(0, 3) : 3;
    float *p = m->data, *n = interleaved ? p + 3 : p + 3 * MESH_VERTICES;
    float *c = interleaved ? p + 6 : p + 6 * MESH_VERTICES;
    for (int i = 0; i < vertices; i++) {
        put3(p + i * step, m->position[i]);
        put3(n + i * step, m->normal[i]);
        put3(c + i * step, m->color[i]);
    }
    int stride = interleaved ? step * 4 : rnd_one_in(2) ? 12 : 0;
    m->mesh.positions = p;
    m->mesh.position_stride = stride;
    m->mesh.normals = with_normals ? n : NULL;
    m->mesh.normal_stride = stride;
    m->mesh.colors = with_colors ? c : NULL;
    m->mesh.color_stride = stride;
    m->mesh.vertex_count = vertices;
    m->mesh.indices = m->indices;
}

/* A bumpy ball of latitudes and longitudes, facing outward. */
static inline void random_ball(test_mesh *m, int with_normals, int with_colors)
{
    int across = rnd_int(4, 12), up = rnd_int(3, 8), vertices = 0, count = 0;
    for (int j = 0; j <= up; j++)
        for (int i = 0; i <= across; i++) {
            double a = 6.283185307179586 * i / across,
                   b = 3.141592653589793 * ((j + 0.15) / (up + 0.3) - 0.5);
            d3 n = d3_of(cos(a) * cos(b), sin(b), sin(a) * cos(b));
            m->position[vertices] = d3_round(d3_scale(n, 1 + 0.1 * rnd_unit()));
            d3 bent = d3_unit(d3_add(n, d3_scale(rnd_direction(), 0.2)));
            m->normal[vertices] = d3_round(d3_scale(bent, (double)rnd_log(0.5, 2)));
            m->color[vertices++] = random_color(1);
        }
    for (int j = 0; j < up; j++) {
        for (int i = 0; i < across; i++) {
            uint32_t a = (uint32_t)(j * (across + 1) + i), b = a + 1, c = a + (uint32_t)across + 1,
                     d = c + 1;
            m->indices[count++] = a;
            m->indices[count++] = c;
            m->indices[count++] = d;
            m->indices[count++] = a;
            m->indices[count++] = d;
            m->indices[count++] = b;
        }
    }
    m->mesh.index_count = count;
    lay_out_mesh(m, vertices, with_normals, with_colors);
}

static inline void random_mesh_scene(test_mesh *m, shade_shading shading, int mirrored)
{
    memset(m, 0, sizeof *m);
    random_ball(m, mirrored || rnd_int(0, 3) > 0, rnd_int(0, 1));
    d3 eye = d3_scale(rnd_direction(), (double)rnd_float(2.6, 5));
    d3 center = d3_scale(rnd_direction(), 0.3);
    m->state.view = shade_mat4_look_at(d3_round(eye), d3_round(center), d3_round(rnd_direction()));
    m->state.projection = rnd_one_in(4)
                              ? shade_mat4_ortho(-1.8f, 1.8f, -1.4f, 1.4f, 0.1f, 20)
                              : shade_mat4_perspective(rnd_float(0.5, 1), 4.0f / 3, 0.1f, 20);
    if (!rnd_one_in(4)) {
        shade_vec3 s = shade_v3(rnd_log(0.6, 1.6), rnd_log(0.6, 1.6), rnd_log(0.6, 1.6));
        if (mirrored) s.x = -s.x;
        m->state.model = shade_mat4_mul(
            shade_mat4_translation(random_vector(0.2)),
            shade_mat4_mul(shade_mat4_rotation(rnd_float(-3, 3), d3_round(rnd_direction())),
                           shade_mat4_scaling(s)));
    }
    for (int k = 0; k < 3; k++) {
        m->lights[k] = random_light(shade_v3(0, 0, 0), 5);
        if (m->lights[k].position.w != 0) m->lights[k].position.w = 1;
        d3 at = d3_of((double)m->lights[k].position.x, (double)m->lights[k].position.y,
                      (double)m->lights[k].position.z);
        if (d3_length(at) < 2.5) { /* outside the ball */
            at = d3_scale(d3_unit(at), 2.5 + rnd_unit());
            m->lights[k].position.x = (float)at.x;
            m->lights[k].position.y = (float)at.y;
            m->lights[k].position.z = (float)at.z;
        }
        if (m->lights[k].spot_exponent > 20) m->lights[k].spot_exponent = 20;
        if (m->lights[k].spot_exponent < 1) m->lights[k].spot_exponent = 0;
    }
    m->material = random_material();
    if (m->material.shininess > 60) m->material.shininess = 60;
    if (m->material.shininess < 1) m->material.shininess = 0;
    m->state.material = rnd_one_in(6) ? NULL : &m->material;
    m->state.lighting.lights = m->lights;
    m->state.lighting.light_count = rnd_int(0, 3);
    m->state.lighting.ambient = random_color(0.3);
    m->state.lighting.model = (shade_model)(rnd_one_in(2) ? rnd_int(0, 1) : rnd_int(0, 5));
    m->state.lighting.flags = rnd_one_in(2) ? 0 : (unsigned)rnd_int(0, 63);
    if (m->state.lighting.model == SHADE_MODEL_COOL_TO_WARM)
        m->state.lighting.flags &= ~(unsigned)SHADE_FLAG_TWO_SIDED_ABS;
    m->state.lighting.terms = rnd_one_in(3) ? (unsigned)rnd_int(0, 15) : 0;
    m->state.shading = shading;
}

static inline shade_shading random_shading(void) /* that this build has varyings for */
{
    return (shade_shading)rnd_int(SHADE_MAX_VARYINGS < 6 ? SHADE_SHADING_PER_VERTEX : 0, 2);
}

static inline double shape_off(shade_vec3 got, d3 want) { return d3_length(d3_sub(d3_from(got),
                               want)); }

/* Three multiples of one vector by powers of two are floats on a line to the bit, while differences
   of them round, even in double. */
static inline void corners_in_a_line(shade_vec3 p[3])
{
    const shade_vec3 v = d3_round(rnd_direction());
    for (int k = 0; k < 3; k++)
        p[k] = shade_scale(v, rnd_sign() * (float)ldexp(1, rnd_int(-40, 3)));
}

enum { PICK_VERTICES = 60, PICK_TRIANGLES = 90 };

typedef struct pick_scene {
    float data[PICK_VERTICES * 3 * 7];
    shade_vec3 position[PICK_VERTICES];
    uint32_t index[3 * PICK_TRIANGLES];
    shade_mesh mesh;
    shade_mat4 model;
} pick_scene;

static inline void ld_of(d3 a, d3 minus, long double *out)
{
    out[0] = (long double)a.x - (long double)minus.x;
    out[1] = (long double)a.y - (long double)minus.y;
    out[2] = (long double)a.z - (long double)minus.z;
}

static inline long double ld_dot(const long double *a, const long double *b)
{
    return a[0] * b[0] + a[1] * b[1] + a[2] * b[2];
}

static inline void ld_cross(const long double *a, const long double *b, long double *out)
{
    for (int k = 0; k < 3; k++) {
        out[k] = a[(k + 1) % 3] * b[(k + 2) % 3] - a[(k + 2) % 3] * b[(k + 1) % 3];
    }
}

/* 1 hit, 0 miss, -1 too near an edge, the plane or the origin to tell; t and barycentrics.  The
   plane first, then areas, in long double: where rays graze, double loses half its digits this
   way. */
static inline int ref_intersect(const shade_ray *ray, const d3 p[3], double *t, double b[3])
{
    long double d[3], n[3], e[3], f[3], from[3], area, slope, at[3], tt;
    double least = 1e300;
    d3 o = d3_from(ray->origin);
    ld_of(d3_from(ray->direction), d3_of(0, 0, 0), d);
    ld_of(p[1], p[0], e);
    ld_of(p[2], p[0], f);
    ld_of(p[0], o, from);
    ld_cross(e, f, n);
    area = ld_dot(n, n);
    slope = ld_dot(n, d);
    if (area == 0) return 0;
    if (fabs((double)slope) < 1e-6 * sqrt((double)area)) return -1;
    tt = ld_dot(n, from) / slope;
    *t = (double)tt;
    for (int k = 0; k < 3; k++) {
        const d3 *q = &p[(k + 1) % 3];
        ld_of(o, *q, at);
        for (int i = 0; i < 3; i++) at[i] += tt * d[i];
        ld_of(p[(k + 2) % 3], *q, e);
        ld_cross(e, at, f);
        b[k] = (double)(ld_dot(f, n) / area);
        least = fmin(least, b[k]);
    }
    if (fabs(least) < 1e-9 || fabs(*t) < 1e-9) return -1;
    return least > 0 && *t > 0;
}

static inline d3 pick_corner(const pick_scene *s, int triangle, int k)
{
    uint32_t v = s->mesh.indices ? s->index[3 * triangle + k] : (uint32_t)(3 * triangle + k);
    return dmat_point(matrix_or_identity(s->model), d3_from(s->position[v]));
}

/* Triangles anywhere in a box of 2 size, some of them twice; indexed or in threes; spread out;
   placed by a model that turns, scales, mirrors, or is left out. */
static inline void random_pick_scene(pick_scene *s, double size)
{
    int stride = rnd_one_in(2) ? 0 : 3 + rnd_int(0, 4), indexed = rnd_int(0, 1);
    memset(s, 0, sizeof *s);
    for (int k = 0; k < PICK_VERTICES; k++) {
        s->position[k] = random_vector(size);
        put3(s->data + k * (stride ? stride : 3), s->position[k]);
    }
    for (int k = 0; k < 3 * PICK_TRIANGLES; k++) s->index[k] = (uint32_t)rnd_int(0, 59);
    for (int k = 3; k < 3 * PICK_TRIANGLES; k += 3)
        if (rnd_one_in(5)) memcpy(s->index + k, s->index + 3 * rnd_int(0, k / 3 - 1), 12);
    s->mesh.positions = s->data;
    s->mesh.position_stride = 4 * stride;
    s->mesh.vertex_count = PICK_VERTICES;
    if (indexed) {
        s->mesh.indices = s->index;
        s->mesh.index_count = 3 * PICK_TRIANGLES;
    } else {
        s->mesh.index_count = -5; /* nobody reads it without indices */
    }
    if (rnd_one_in(4)) return;
    shade_vec3 scale = shade_v3(rnd_sign() * rnd_log(0.3, 3), rnd_sign() * rnd_log(0.3, 3),
                                rnd_sign() * rnd_log(0.3, 3));
    if (rnd_one_in(3)) scale.y = scale.z = scale.x;
    s->model = shade_mat4_scaling(scale);
    if (rnd_one_in(3)) return;
    s->model =
        shade_mat4_mul(shade_mat4_rotation(rnd_float(-3, 3), d3_round(rnd_direction())), s->model);
    s->model = shade_mat4_mul(shade_mat4_translation(random_vector(size)), s->model);
}

static inline int pick_triangles(const pick_scene *s)
{
    return s->mesh.indices ? PICK_TRIANGLES : PICK_VERTICES / 3;
}

/* The nearest triangle in long double, -1: none; -2: within margin of an edge, the origin or the
   next nearest. */
static inline int ref_pick(const pick_scene *s, const shade_ray *ray, double margin, double *t,
                           double barycentric[3])
{
    int found = -1, unsure = 0;
    double nearest = 1e300, second = 1e300;
    for (int n = 0; n < pick_triangles(s); n++) {
        double at = 0, b[3] = { 0, 0, 0 };
        d3 p[3] = { pick_corner(s, n, 0), pick_corner(s, n, 1), pick_corner(s, n, 2) };
        d3 area = d3_cross(d3_unit(d3_sub(p[1], p[0])), d3_unit(d3_sub(p[2], p[0])));
        if (d3_length(area) == 0) continue;
        int hit = ref_intersect(ray, p, &at, b);
        double least = fmin(b[0], fmin(b[1], b[2]));
        if (hit < 0 || d3_length(area) < 100 * margin || fabs(least) < margin ||
            (least > 0 && fabs(at) < margin)) {
            unsure = 1; /* unless something lies surely before it */
            continue;
        }
        if (!hit) continue;
        int same = 0; /* as the nearest: the first counts */
        for (int k = 0; k < 3 && found >= 0; k++)
            same += d3_length(d3_sub(p[k], pick_corner(s, found, k))) == 0;
        if (same == 3) continue;
        if (at < nearest) {
            second = nearest;
            nearest = at;
            found = n;
            memcpy(barycentric, b, sizeof b);
        } else {
            second = fmin(second, at);
        }
    }
    *t = nearest;
    if (found >= 0 && second - nearest < margin * (1 + nearest)) return -2;
    return unsure ? -2 : found;
}

#endif
