/* shaders.c - fragment shaders of draw states: what they are handed, what becomes of colours, and
   that it may be what the library would have done. */
#include "unit.h"

enum { OWN_W = 40, OWN_H = 30, OWN_VERTICES = 24, OWN_INDICES = 45 };
enum { /* its varyings; in builds that have too few, one that is there */
    OWN_ALL = SHADE_MAX_VARYINGS < 11 ? 0 : 11,
    OWN_N = OWN_ALL ? 3 : 0,
    OWN_COLOR = OWN_ALL ? 6 : 0,
    OWN_U = OWN_ALL ? 9 : 0,
    OWN_V = OWN_ALL ? 10 : 0
};

/* Every build refuses one for which it has too few varyings. */
static int own_fits(void)
{
    if (OWN_ALL) return 1;
    test_skip("a fragment shader of a state takes 11 varyings");
    return 0;
}

typedef struct own_fragment { /* what the last fragment of a pixel was handed */
    float in[11], x, y, z, lod;
    uint32_t primitive, front;
    int drawn;
} own_fragment;
typedef own_fragment own_record[OWN_H][OWN_W];

static void own_recorder(const void *uniforms, const shade_fragments *SHADE_RESTRICT in,
                         shade_colors *SHADE_RESTRICT out)
{
    own_record *record = (own_record *)(uintptr_t)uniforms;
    (void)out;
    for (int i = 0; i < in->count; i++) {
        own_fragment *f = &(*record)[(int)in->y[i]][(int)in->x[i]];
        for (int k = 0; k < OWN_ALL; k++) f->in[k] = in->varying[k][i];
        f->x = in->x[i];
        f->y = in->y[i];
        f->z = in->z[i];
        f->lod = in->lod[i];
        f->primitive = in->primitive[i];
        f->front = in->front[i];
        f->drawn++;
    }
}

/* Coordinates, matrices and products of both are few binary digits: clip space and P have no
   rounding, so that a pipeline of the test's own covers the same pixels. */
typedef struct own_scene {
    float position[OWN_VERTICES][3], normal[OWN_VERTICES][3], color[OWN_VERTICES][3];
    float uv[OWN_VERTICES][2];
    uint32_t indices[OWN_INDICES];
    shade_mesh mesh;
    shade_draw_state state;
    shade_texture map;
    float texel[8 * 8];
} own_scene;

static float own_digits(int most) { return (float)rnd_int(-most, most) / 64; }

static void own_random_scene(own_scene *s)
{
    memset(s, 0, sizeof *s);
    for (int i = 0; i < OWN_VERTICES; i++)
        for (int k = 0; k < 3; k++) {
            s->position[i][k] = own_digits(128);
            s->normal[i][k] = rnd_one_in(20) ? 0 : rnd_float(-2, 2);
            s->color[i][k] = rnd_float(0, 1);
            s->uv[i][k % 2] = rnd_float(-1, 2);
        }
    for (int i = 0; i < OWN_INDICES; i++) s->indices[i] = (uint32_t)rnd_int(0, OWN_VERTICES - 1);
    s->map.pixels = s->texel;
    s->map.width = s->map.height = 8;
    s->map.filter = (shade_filter)rnd_int(0, 2);
    s->mesh.positions = s->position[0];
    s->mesh.normals = rnd_one_in(2) ? s->normal[0] : NULL;
    s->mesh.colors = rnd_one_in(2) ? s->color[0] : NULL;
    s->mesh.texcoords = rnd_one_in(3) ? NULL : s->uv[0];
    s->mesh.indices = rnd_one_in(4) ? NULL : s->indices;
    s->mesh.index_count = OWN_INDICES;
    s->mesh.vertex_count = OWN_VERTICES;
    s->state.model = shade_mat4_mul(shade_mat4_translation(shade_v3(0.25f, 0, -3)),
                                    shade_mat4_scaling(shade_v3(rnd_sign(), 0.5f, 2)));
    s->state.projection = shade_mat4_frustum(-1, 1, -1, 1, 1, 3); /* w = -z */
    s->state.diffuse_map = rnd_one_in(3) ? NULL : &s->map;
    s->state.raster.depth_test = SHADE_COMPARE_ALWAYS;
    s->state.fragment = own_recorder;
}

/* The same by a pipeline: corner by corner, its vertices in double precision. */
typedef struct own_pipeline {
    const own_scene *scene;
    own_record *record;
} own_pipeline;

static d3 own_corner(const own_scene *s, uint32_t corner)
{
    uint32_t v = s->mesh.indices ? s->indices[corner] : corner;
    return d3_of((double)s->position[v][0], (double)s->position[v][1], (double)s->position[v][2]);
}

static d3 own_normal(const own_scene *s, uint32_t corner)
{
    uint32_t v = s->mesh.indices ? s->indices[corner] : corner, first = corner / 3 * 3;
    d3 a = own_corner(s, first), b = own_corner(s, first + 1), c = own_corner(s, first + 2);
    d3 n = d3_cross(d3_sub(b, a), d3_sub(c, a));
    if (s->mesh.normals)
        n = d3_of((double)s->normal[v][0], (double)s->normal[v][1], (double)s->normal[v][2]);
    return d3_unit(dmat_direction(dmat_normals(dmat_from(s->state.model)), n));
}

static void own_vertex(const void *uniforms, const shade_vertex_ids *SHADE_RESTRICT in,
                       shade_vertices *SHADE_RESTRICT out)
{
    const own_scene *s = ((const own_pipeline *)uniforms)->scene;
    for (int i = 0; i < SHADE_LANES; i++) {
        uint32_t corner = in->index[i], v = s->mesh.indices ? s->indices[corner] : corner;
        d3 P = dmat_point(dmat_from(s->state.model), own_corner(s, corner));
        d3 N = own_normal(s, corner);
        double value[11] = { P.x, P.y, P.z, N.x, N.y, N.z, 1, 1, 1, 0, 0 };
        for (int k = 0; k < 3 && s->mesh.colors; k++) value[6 + k] = (double)s->color[v][k];
        for (int k = 0; k < 2 && s->mesh.texcoords; k++) value[9 + k] = (double)s->uv[v][k];
        for (int k = 0; k < OWN_ALL; k++) out->varying[k][i] = (float)value[k];
        out->clip[0][i] = (float)P.x;
        out->clip[1][i] = (float)P.y;
        out->clip[2][i] = (float)(-2 * P.z - 3);
        out->clip[3][i] = (float)-P.z;
    }
}

static void own_fragment_of(const void *uniforms, const shade_fragments *SHADE_RESTRICT in,
                            shade_colors *SHADE_RESTRICT out)
{
    own_recorder(((const own_pipeline *)uniforms)->record, in, out);
}

static int own_same_bits(float a, float b) { return float_bits(a + 0) == float_bits(b + 0); }

static shade_pipeline own_pipeline_of(const own_pipeline *u)
{
    shade_pipeline p;
    memset(&p, 0, sizeof p);
    p.vertex = own_vertex;
    p.fragment = own_fragment_of;
    p.uniforms = u;
    p.varyings = 11;
    p.raster = u->scene->state.raster;
    p.lod_texture = u->scene->mesh.texcoords ? u->scene->state.diffuse_map : NULL;
    p.lod_varying = 9;
    return p;
}

TEST(shaders, it_is_handed_what_a_pipeline_of_the_same_mesh_hands_on)
{
    static own_scene s;
    static own_record got, want;
    long pixels = 0, detailed = 0;
    if (!own_fits()) return;
    for (int i = 0; i < 300; i++) {
        canvas c = canvas_ready(OWN_W, OWN_H, 0, rnd_format(), 1);
        own_random_scene(&s);
        own_pipeline u = { &s, &want };
        shade_pipeline p = own_pipeline_of(&u);
        memset(got, 0, sizeof got);
        memset(want, 0, sizeof want);
        s.state.uniforms = &got;
        int corners = s.mesh.indices ? OWN_INDICES : OWN_VERTICES;
        canvas_draw_mesh(&c, &s.mesh, &s.state);
        canvas_draw(&c, &p, corners);
        for (int at = 0; at < OWN_W * OWN_H; at++) {
            const own_fragment *a = &got[at / OWN_W][at % OWN_W];
            const own_fragment *b = &want[at / OWN_W][at % OWN_W];
            CHECK_INT(a->drawn, b->drawn);
            if (!b->drawn) continue;
            CHECK(a->x == b->x && a->y == b->y && a->z == b->z && own_same_bits(a->lod, b->lod));
            CHECK(a->primitive == b->primitive && a->front == b->front);
            for (int k = 0; k < 11; k++) {
                if (k < 3 || k > 5) CHECK(own_same_bits(a->in[k], b->in[k]));
                else CHECK_NEAR(a->in[k], b->in[k], 5e-5); /* of slivers */
            }
            pixels++;
            detailed += b->lod != 0;
        }
        canvas_close(&c);
    }
    CHECK_SAY(pixels > 20000 && detailed > 5000, "%ld pixels, %ld with lod", pixels, detailed);
}

/* ----------------------------------------------------------------------- colour, alpha, discard */

typedef struct own_colors { /* by pixel of a rectangle that fills the picture */
    float color[OWN_H][OWN_W][4];
    int gone[OWN_H][OWN_W];
    long calls;
} own_colors;

static void own_painter(const void *uniforms, const shade_fragments *SHADE_RESTRICT in,
                        shade_colors *SHADE_RESTRICT out)
{
    own_colors *u = (own_colors *)(uintptr_t)uniforms;
    u->calls++;
    for (int i = 0; i < SHADE_LANES; i++) {
        int x = (int)in->x[i], y = (int)in->y[i];
        for (int k = 0; k < 4; k++) out->color[k][i] = u->color[y][x][k];
        out->discard[i] = (uint32_t)u->gone[y][x];
    }
}

static const float own_square[] = { -1, -1, 0, 1, -1, 0, 1, 1, 0, -1, -1, 0, 1, 1, 0, -1, 1, 0 };
static void own_random_colors(own_colors *u, shade_draw_state *s)
{
    memset(u, 0, sizeof *u);
    for (int at = 0; at < OWN_W * OWN_H; at++) {
        for (int k = 0; k < 4; k++) u->color[at / OWN_W][at % OWN_W][k] = rnd_float(0, 1.5);
        u->gone[at / OWN_W][at % OWN_W] = rnd_one_in(5) ? rnd_int(1, INT32_MAX) : 0;
    }
    memset(s, 0, sizeof *s);
    s->fragment = own_painter;
    s->uniforms = u;
    s->transparency = rnd_one_in(3) ? 0 : rnd_float(0, 1);
    s->alpha_cutoff = rnd_one_in(2) ? 0 : rnd_float(0, 1);
    s->raster.blend = (shade_blend)rnd_int(0, SHADE_BLEND_ADD);
}

/* The shader takes its colour, alpha and discard from an array, so that each pixel is known. */
TEST(shaders, its_colour_is_the_pixel_s_and_alpha_cutoff_blend_and_discard_apply)
{
    static own_colors u;
    shade_mesh m = plain_mesh(own_square, 6);
    const double d[4] = { 0.25, 0.5, 0.75, 0.125 };
    if (!own_fits()) return;
    for (int i = 0; i < 60; i++) {
        canvas c = canvas_open(OWN_W, OWN_H, 0, SHADE_FORMAT_RGBA32F, 1);
        shade_draw_state s;
        shade_stats stats;
        long kept = 0;
        own_random_colors(&u, &s);
        CHECK_INT(shade_clear(&c.target, shade_v4(0.25f, 0.5f, 0.75f, 0.125f), 1), SHADE_OK);
        stats = canvas_draw_mesh(&c, &m, &s);
        for (int at = 0; at < OWN_W * OWN_H; at++) {
            int x = at % OWN_W, y = at / OWN_W;
            double a = (1 - (double)s.transparency) * (double)u.color[y][x][3];
            int seen = !u.gone[y][x] && !(s.alpha_cutoff > 0 && a < (double)s.alpha_cutoff);
            kept += seen;
            CHECK_NEAR(canvas_depth(&c, x, y), seen ? 0.5 : 1, 0);
            for (int k = 0; k < 4; k++) {
                double v = k < 3 ? (double)u.color[y][x][k] : a, want = v;
                if (s.raster.blend == SHADE_BLEND_ADD) want = d[k] + (k < 3 ? v * a : a);
                if (s.raster.blend == SHADE_BLEND_OVER)
                    want = (k < 3 ? v * a : a) + d[k] * (1 - a);
                CHECK_NEAR(canvas_float(&c, x, y, k), seen ? want : d[k], 2e-6);
            }
        }
        CHECK_INT(stats.fragments, kept);
        canvas_close(&c);
    }
}

TEST(shaders, depth_alone_asks_it_for_holes_of_a_cutoff_and_for_nothing_else)
{
    static own_colors u;
    shade_mesh m = plain_mesh(own_square, 6);
    long holes = 0;
    if (!own_fits()) return;
    for (int i = 0; i < 40; i++) {
        canvas c = canvas_ready(OWN_W, OWN_H, 0, SHADE_FORMAT_RGBA8, 1);
        shade_draw_state s;
        own_random_colors(&u, &s);
        if (i % 2) s.alpha_cutoff = 0;
        c.target.color = NULL;
        canvas_draw_mesh(&c, &m, &s);
        CHECK_INT(u.calls > 0, s.alpha_cutoff > 0);
        for (int at = 0; at < OWN_W * OWN_H; at++) {
            int x = at % OWN_W, y = at / OWN_W;
            float a = (1 - s.transparency) * u.color[y][x][3];
            int gone = s.alpha_cutoff > 0 && (u.gone[y][x] || a < s.alpha_cutoff);
            CHECK_NEAR(canvas_depth(&c, x, y), gone ? 1 : 0.5, 0);
            holes += gone;
        }
        canvas_close(&c);
    }
    CHECK(holes > 1000);
}

/* out keeps what a packet begins with; there are no uniforms */
static void own_silent(const void *uniforms, const shade_fragments *SHADE_RESTRICT in,
                       shade_colors *SHADE_RESTRICT out)
{
    CHECK(uniforms == NULL);
    (void)in;
    (void)out;
}

TEST(shaders, one_that_sets_nothing_draws_opaque_black)
{
    canvas c = canvas_open(OWN_W, OWN_H, 0, SHADE_FORMAT_RGBA8, 0);
    shade_mesh m = plain_mesh(own_square, 6);
    static const unsigned char black[4] = { 0, 0, 0, 255 };
    shade_draw_state s = plain_state(NULL);
    s.fragment = own_silent;
    s.lighting.ambient = grey(1);
    int fits = OWN_ALL > 0;
    CHECK_INT(shade_draw_mesh(&c.target, &m, &s, NULL), fits ? SHADE_OK : SHADE_ERROR_STATE);
    for (int at = 0; at < OWN_W * OWN_H; at++)
        CHECK(!fits || !memcmp(canvas_bytes(&c, at % OWN_W, at / OWN_W), black, 4));
    for (int shading = 1; shading < 3; shading++) {
        s.shading = (shade_shading)shading;
        CHECK_INT(shade_draw_mesh(&c.target, &m, &s, NULL), SHADE_ERROR_STATE);
    }
    canvas_close(&c);
}

/* ------------------------------------------------------------------- the library's own, by hand */

typedef struct own_light {
    const shade_draw_state *state;
    const shade_mesh *mesh;
    shade_vec3 eye;
} own_light;
static void own_lit(const void *uniforms, const shade_fragments *SHADE_RESTRICT in,
                    shade_colors *SHADE_RESTRICT out)
{
    const own_light *u = (const own_light *)uniforms;
    const float (*v)[SHADE_LANES] = in->varying;
    const int map = u->mesh->texcoords && u->state->diffuse_map;
    float texel[4][SHADE_LANES];
    shade_rows rows = { v[0], v[OWN_N], NULL, NULL, NULL };
    if (u->mesh->colors || map) rows.albedo = texel[0];
    for (int k = 0; k < 3; k++)
        for (int i = 0; i < SHADE_LANES; i++) texel[k][i] = 1;
    if (map) {
        shade_sample_lanes(u->state->diffuse_map, v[OWN_U], v[OWN_V], in->lod, texel[0]);
        memcpy(out->color[3], texel[3], sizeof texel[3]);
    }
    for (int k = 0; k < 3 && u->mesh->colors; k++)
        for (int i = 0; i < SHADE_LANES; i++) texel[k][i] *= v[OWN_COLOR + k][i];
    shade_lit_lanes(&u->state->lighting, u->state->material, u->eye, &rows, out->color[0]);
}

/* Every other setting is random: with the shader of the library and with its twin the pictures
   must be the same. */
TEST(shaders, one_that_lights_as_the_library_does_draws_its_bits)
{
    static test_mesh m;
    static float uv[MESH_VERTICES][2];
    if (!own_fits()) return;
    for (int i = 0; i < 80; i++) {
        shade_format format = rnd_format();
        canvas a = canvas_open(64, 48, 0, format, 1), b = canvas_open(64, 48, 0, format, 1);
        shade_texture levels[8], map = random_texture(30);
        random_mesh_scene(&m, SHADE_SHADING_PER_FRAGMENT, 0);
        for (int k = 0; k < 2 * MESH_VERTICES; k++) uv[k / 2][k % 2] = rnd_float(-2, 2);
        map.filter = (shade_filter)rnd_int(0, 2);
        void *memory = add_mipmaps(&map, levels);
        m.mesh.texcoords = rnd_one_in(3) ? NULL : uv[0];
        m.state.diffuse_map = rnd_one_in(3) ? NULL : &map;
        m.state.raster.blend = (shade_blend)rnd_int(0, SHADE_BLEND_ADD);
        m.state.transparency = rnd_float(0, 1);
        m.state.alpha_cutoff = rnd_one_in(2) ? 0 : rnd_float(0, 0.5);
        own_light u = { &m.state, &m.mesh, { 0, 0, 0 } };
        shade_mat4 camera = shade_mat4_inverse(m.state.view);
        u.eye = m.state.lighting.flags & SHADE_FLAG_INFINITE_VIEWER
                    ? shade_mat4_transform_direction(camera, shade_v3(0, 0, 1))
                    : shade_mat4_transform_point(camera, u.eye);
        shade_stats first, second;
        CHECK_INT(shade_clear(&a.target, shade_v4(0.1f, 0.2f, 0.3f, 0.4f), 1), SHADE_OK);
        CHECK_INT(shade_clear(&b.target, shade_v4(0.1f, 0.2f, 0.3f, 0.4f), 1), SHADE_OK);
        first = canvas_draw_mesh(&a, &m.mesh, &m.state);
        m.state.fragment = own_lit;
        m.state.uniforms = &u;
        second = canvas_draw_mesh(&b, &m.mesh, &m.state);
        CHECK_SAY(canvas_same(&a, &b), "scene %d, format %d", i, (int)format);
        CHECK(!memcmp(&first, &second, sizeof first) && first.drawn > 0);
        free(memory);
        free_texture(&map);
        canvas_close(&a);
        canvas_close(&b);
    }
}

/* The red of the vertices, as alpha. */
static void own_red_is_alpha(const void *uniforms, const shade_fragments *SHADE_RESTRICT in,
                             shade_colors *SHADE_RESTRICT out)
{
    (void)uniforms;
    SHADE_EACH_LANE(i) { out->color[3][i] = in->varying[6][i]; }
}

/* Without a picture a shader that cuts by the vertex colour still gets it.  Red grows from 0 on the
   left to 1 on the right, so that it is the pixel's place. */
TEST(shaders, colours_of_vertices_cut_holes_into_depth_alone)
{
    static const float square[] = { -1, -1, 0, 1, -1, 0, 1, 1, 0, -1, -1, 0, 1, 1, 0, -1, 1, 0 };
    static const float colors[] = { 0, 1, 1, 1, 1, 1, 1, 1, 1, 0, 1, 1, 1, 1, 1, 0, 1, 1 };
    for (int picture = 0; picture < 2 && SHADE_MAX_VARYINGS >= 11; picture++) {
        canvas c = canvas_open(16, 12, 0, SHADE_FORMAT_RGBA8, 1);
        shade_mesh m = plain_mesh(square, 6);
        shade_draw_state s = plain_state(NULL);
        m.colors = colors;
        s.fragment = own_red_is_alpha;
        s.alpha_cutoff = 0.4f;
        if (!picture) c.target.color = NULL;
        canvas_clear(&c, 1);
        canvas_draw_mesh(&c, &m, &s);
        for (int k = 0; k < 16 * 12; k++) {
            const double red = (k % 16 + 0.5) / 16;
            CHECK_NEAR(canvas_depth(&c, k % 16, k / 16), red >= 0.4 ? 0.5 : 1, 0);
        }
        canvas_close(&c);
    }
}

typedef struct own_eyes { /* the eye of the first packet of a draw; packets with another */
    shade_vec3 eye;
    long packets, others;
} own_eyes;

static void own_eye_recorder(const void *uniforms, const shade_fragments *SHADE_RESTRICT in,
                             shade_colors *SHADE_RESTRICT out)
{
    own_eyes *e = (own_eyes *)(uintptr_t)uniforms;
    (void)out;
    if (!e->packets++) e->eye = in->eye;
    e->others += memcmp(&e->eye, &in->eye, sizeof e->eye) != 0;
}

/* Three squares across each other, so that one is seen from any side, over and over again. */
static shade_mesh own_squares(float *positions, uint32_t *indices, int index_count)
{
    for (int i = 0; i < 18; i++) {
        const float *corner = own_square + 3 * (i % 6);
        for (int k = 0; k < 3; k++) positions[3 * i + k] = corner[(k + i / 6) % 3];
    }
    for (int i = 0; i < index_count; i++) indices[i] = (uint32_t)i % 18;
    shade_mesh m = plain_mesh(positions, 18);
    m.indices = indices;
    m.index_count = index_count;
    return m;
}

TEST(shaders, it_is_handed_the_eye_of_the_view)
{
    enum { INDICES = 54 * 40 }; /* several batches */
    static float positions[54];
    static uint32_t indices[INDICES];
    static const shade_chunk chunk = { { -1, -1, -1 }, { 1, 1, 1 }, 0, INDICES / 3 };
    shade_mesh m = own_squares(positions, indices, INDICES);
    canvas c = canvas_open(OWN_W, OWN_H, 0, SHADE_FORMAT_RGBA8, 1);
    if (!own_fits()) {
        canvas_close(&c);
        return;
    }
    for (int round = 0; round < 200; round++) {
        const float far = rnd_log(4, 1000);
        const shade_vec3 middle = shade_v3(rnd_float(-9, 9), rnd_float(-9, 9), rnd_float(-9, 9));
        const d3 way = rnd_direction();
        const shade_vec3 eye = shade_madd(middle, far, d3_round(way));
        const int endless = rnd_one_in(2), depth_alone = rnd_one_in(4);
        own_eyes e = { { 0, 0, 0 }, 0, 0 };
        shade_draw_state s = plain_state(NULL);
        shade_target t = c.target;
        dmat back = dmat_identity();
        s.model = shade_mat4_translation(middle);
        s.view = shade_mat4_look_at(eye, middle, shade_v3(0.1f, 1, 0.2f));
        if (rnd_one_in(4)) s.view = shade_mat4_mul(shade_mat4_scaling(shade_v3(-1, 1, 1)), s.view);
        s.projection = shade_mat4_perspective(2 / far, 1, far / 2, 2 * far);
        if (rnd_one_in(4)) s.projection = shade_mat4_ortho(-2, 2, -2, 2, far / 2, 2 * far);
        s.lighting.flags = endless ? SHADE_FLAG_INFINITE_VIEWER : 0;
        s.raster.depth_test = SHADE_COMPARE_LESS_EQUAL;
        s.fragment = own_eye_recorder;
        s.uniforms = &e;
        if (depth_alone) {
            t.color = NULL;
            s.alpha_cutoff = 0.5f;
        }
        m.chunks = rnd_one_in(2) ? &chunk : NULL;
        m.chunk_count = m.chunks != NULL;
        canvas_clear(&c, 1);
        CHECK_INT(shade_draw_mesh(&t, &m, &s, NULL), SHADE_OK);
        CHECK(e.packets > 2);
        CHECK_INT(e.others, 0);
        dmat_invert(dmat_from(s.view), 4, &back);
        const d3 want = endless ? d3_of(back.m[0][2], back.m[1][2], back.m[2][2])
                                : d3_of(back.m[0][3], back.m[1][3], back.m[2][3]);
        const double size = endless ? 1 : 20 + (double)far;
        CHECK_NEAR(d3_length(d3_sub(d3_from(e.eye), want)), 0, 2e-6 * size);
        /* the camera that was given to look_at */
        CHECK_NEAR(d3_length(d3_sub(want, endless ? way : d3_from(eye))), 0, 2e-5 * size);
    }
    canvas_close(&c);
}

typedef struct own_pair { /* uniforms of both shaders of a pipeline */
    const scene *corners;
    own_eyes eyes;
} own_pair;

static void own_pair_vertex(const void *uniforms, const shade_vertex_ids *SHADE_RESTRICT in,
                            shade_vertices *SHADE_RESTRICT out)
{
    scene_vertex(((const own_pair *)uniforms)->corners, in, out);
}

static void own_pair_fragment(const void *uniforms, const shade_fragments *SHADE_RESTRICT in,
                              shade_colors *SHADE_RESTRICT out)
{
    own_eye_recorder(&((const own_pair *)uniforms)->eyes, in, out);
}

TEST(shaders, those_of_pipelines_have_no_eye)
{
    const shade_vec4 clip[3] = { { -1, -1, 0, 1 }, { 1, -1, 0, 1 }, { 0, 1, 0, 1 } };
    canvas c = canvas_open(OWN_W, OWN_H, 0, SHADE_FORMAT_RGBA8, 1);
    const scene corners = { clip, NULL, 0, NULL, NULL };
    own_pair u;
    u.corners = &corners;
    for (int late = 0; late < 2; late++) {
        shade_pipeline p = scene_pipeline(&corners);
        memset(&u.eyes, 0, sizeof u.eyes);
        p.vertex = own_pair_vertex;
        p.fragment = own_pair_fragment;
        p.uniforms = &u;
        p.may_discard = late;
        canvas_clear(&c, 1);
        canvas_draw(&c, &p, 3);
        CHECK(u.eyes.packets > 0);
        CHECK_INT(u.eyes.others, 0);
        CHECK(u.eyes.eye.x == 0 && u.eyes.eye.y == 0 && u.eyes.eye.z == 0);
    }
    canvas_close(&c);
}
