/* depth.c - the depth of a pixel depends on the positions of its triangle alone, to the bit: not on
   what is interpolated or shaded, so that passes over one mesh agree. */
#include "unit.h"

enum { DEPTH_TRIANGLES = 24, DEPTH_WIDTH = 100, DEPTH_HEIGHT = 60 };

/* Triangles of one kind: 0 perspective, 1 orthographic, 2 slivers, 3 cut by near, far or the guard
   band with all of them in front of the eye, 4 cut and partly behind it, 5 tiny. */
static void random_depth_triangle(int kind, int zero_to_one, shade_vec4 v[3])
{
    static const int shapes[] = { 2, 1, 5, 0, 0, 0 };
    int64_t x[3], y[3];
    if (kind == 3) {
        random_cut_triangle(3, zero_to_one, v);
        return;
    }
    if (kind == 4) {
        random_eye_triangle(v, zero_to_one, rnd_one_in(3) ? 200 : 12);
        return;
    }
    random_corners(shapes[kind], DEPTH_WIDTH, DEPTH_HEIGHT, x, y);
    for (int k = 0; k < 3; k++) {
        double w = kind == 1 ? 1 : (double)rnd_log(0.1, 10);
        double z = (double)rnd_float(zero_to_one ? 0.01 : -0.99, 0.99);
        v[k] = clip_of_fx8((double)x[k], (double)y[k], DEPTH_WIDTH, DEPTH_HEIGHT, z, w);
    }
}

static void depth_keep(const void *uniforms, const shade_fragments *SHADE_RESTRICT in,
                       shade_colors *SHADE_RESTRICT out)
{
    (void)uniforms;
    (void)in;
    (void)out;
}

static shade_stats draw_depth_triangles(canvas *c, const shade_pipeline *p)
{
    return canvas_draw(c, p, 3 * DEPTH_TRIANGLES);
}

static int same_depths(const canvas *a, const canvas *b)
{
    return !memcmp(a->depth, b->depth, a->depth_bytes + 2 * CANVAS_GUARD);
}

/* What has no influence on depth: a discard that keeps all, and a lod. */
static void random_interpolation(shade_pipeline *p, const shade_texture *map)
{
    p->fragment = depth_keep;
    p->may_discard = rnd_one_in(3);
    if (p->varyings > 1 && rnd_one_in(2)) {
        p->lod_texture = map;
        p->lod_varying = rnd_int(0, p->varyings - 2);
    }
}

/* 0 .. SHADE_MAX_VARYINGS varyings, all interpolations, with and without a level of detail, depth
   tested before or after the shader. */
/* G9 */
TEST(depth, is_the_same_bits_whatever_is_interpolated)
{
    static float attribute[3 * DEPTH_TRIANGLES * SHADE_MAX_VARYINGS];
    static shade_vec4 clip[3 * DEPTH_TRIANGLES];
    const int pairs = 3 * (SHADE_MAX_VARYINGS + 1);
    shade_texture map = lod_map(300, 200);
    long touched = 0;
    for (int i = 0; i < 36 * pairs; i++) {
        int zero_to_one = rnd_one_in(2), kind = i / pairs % 6;
        canvas alone = canvas_ready(DEPTH_WIDTH, DEPTH_HEIGHT, 0, SHADE_FORMAT_RGBA8, 1);
        canvas other = canvas_ready(DEPTH_WIDTH, DEPTH_HEIGHT, 0, SHADE_FORMAT_RGBA8, 1);
        for (int k = 0; k < DEPTH_TRIANGLES; k++)
            random_depth_triangle(kind, zero_to_one, clip + 3 * k);
        for (int k = 0; k < 3 * DEPTH_TRIANGLES * SHADE_MAX_VARYINGS; k++)
            attribute[k] = rnd_float(-1, 1) * rnd_log(1e-3, 1e3);
        scene s = { clip, attribute, 0, NULL, NULL };
        shade_pipeline p = scene_pipeline(&s);
        p.fragment = NULL;
        p.raster.depth_zero_to_one = zero_to_one;
        p.raster.depth_test = rnd_one_in(2) ? SHADE_COMPARE_LESS : SHADE_COMPARE_ALWAYS;
        p.raster.depth_bias = rnd_one_in(4) ? rnd_float(-0.1, 0.1) : 0;
        shade_stats a = draw_depth_triangles(&alone, &p);
        s.varyings = p.varyings = i % pairs / 3;
        p.interpolation = (shade_interpolation)(i % 3);
        random_interpolation(&p, &map);
        if (p.may_discard && rnd_one_in(2)) other.target.color = NULL;
        shade_stats b = draw_depth_triangles(&other, &p);
        CHECK_INT(a.fragments, b.fragments);
        touched += (long)a.fragments;
        CHECK_SAY(same_depths(&alone, &other),
                  "kind %d, interpolation %d, %d varyings, lod %d, may discard %d", kind,
                  (int)p.interpolation, p.varyings, p.lod_texture != NULL, p.may_discard);
        p.raster.depth_test = SHADE_COMPARE_EQUAL;
        other.target.color = NULL;
        if (p.raster.depth_bias == 0) draw_depth_triangles(&other, &p); /* visible pixels again */
        CHECK(same_depths(&alone, &other));
        canvas_close(&alone);
        canvas_close(&other);
    }
    CHECK_SAY(touched > 1000000, "%ld pixels", touched);
}

/* ----------------------------------------------------------------------------- passes of meshes */

typedef struct depth_mesh {
    shade_vec3 position[3 * DEPTH_TRIANGLES], normal[3 * DEPTH_TRIANGLES],
        color[3 * DEPTH_TRIANGLES];
    float uv[3 * DEPTH_TRIANGLES][2];
    uint32_t indices[3 * DEPTH_TRIANGLES];
    shade_texture map, levels[16];
    void *memory;
    shade_light light;
    shade_mesh mesh;
    shade_draw_state state;
} depth_mesh;

/* The camera among the triangles: some of them are cut by near, far and the guard band. */
static void random_depth_mesh(depth_mesh *m)
{
    const int corners = 3 * DEPTH_TRIANGLES;
    shade_draw_state *s = &m->state;
    memset(m, 0, sizeof *m);
    for (int k = 0; k < corners; k++) {
        m->position[k] = shade_v3(rnd_float(-3, 3), rnd_float(-2, 2), rnd_float(-3, 3));
        m->normal[k] = d3_round(rnd_direction());
        m->color[k] = shade_v3(rnd_float(0, 1), rnd_float(0, 1), rnd_float(0, 1));
        m->uv[k][0] = rnd_float(-1, 2);
        m->uv[k][1] = rnd_float(-1, 2);
        m->indices[k] = (uint32_t)rnd_int(0, corners - 1);
    }
    m->map = texture_of(rnd_int(1, 40), rnd_int(1, 40), rnd_texture_format());
    m->map.filter = (shade_filter)rnd_int(0, 2);
    if (rnd_one_in(2)) m->memory = add_mipmaps(&m->map, m->levels);
    m->light = shade_point_light(shade_v3(1, 2, 3), shade_v3(1, 1, 1));
    m->mesh.positions = &m->position[0].x;
    m->mesh.vertex_count = corners;
    if (rnd_one_in(2)) {
        m->mesh.indices = m->indices;
        m->mesh.index_count = corners;
    }
    if (rnd_one_in(2)) m->mesh.normals = &m->normal[0].x;
    if (rnd_one_in(2)) m->mesh.colors = &m->color[0].x;
    s->view = shade_mat4_look_at(shade_v3(rnd_float(-3, 3), rnd_float(-1, 1), rnd_float(1, 5)),
                                 shade_v3(0, 0, 0), shade_v3(0, 1, 0));
    s->model = shade_mat4_rotation(rnd_float(-3, 3), d3_round(rnd_direction()));
    s->projection = rnd_one_in(4) ? shade_mat4_ortho(-1, 1, -1, 1, 1, 6)
                                  : shade_mat4_perspective(rnd_float(0.3, 2), 1.6f, 0.5f, 6);
    s->lighting.lights = &m->light;
    s->lighting.light_count = 1;
    s->lighting.flags = SHADE_FLAG_TWO_SIDED;
    s->lighting.ambient = shade_v3(0.5f, 0.5f, 0.5f);
    s->raster.cull = (shade_cull)rnd_int(0, 2);
    if (rnd_one_in(2)) {
        m->mesh.texcoords = &m->uv[0][0];
        s->diffuse_map = &m->map;
        s->alpha_cutoff = rnd_one_in(2) ? 0.4f : 0;
    }
}

/* Draws over the depths of another pass: each pixel that it has seen, and no other, passes the test
   again.  Returns how many there are. */
static int check_pass_over(canvas *c, const canvas *before, depth_mesh *m, shade_compare test)
{
    shade_stats stats;
    int seen = 0, missed = 0;
    m->state.raster.depth_test = test;
    CHECK_INT(shade_clear(&c->target, shade_v4(-1e6f, 0, 0, 0), 1), SHADE_OK);
    memcpy(c->depth, before->depth, c->depth_bytes + 2 * CANVAS_GUARD);
    stats = canvas_draw_mesh(c, &m->mesh, &m->state);
    CHECK(same_depths(c, before));
    for (int k = 0; k < DEPTH_WIDTH * DEPTH_HEIGHT; k++) {
        int x = k % DEPTH_WIDTH, y = k / DEPTH_WIDTH;
        int drawn = canvas_float(c, x, y, 0) > -1e6f, there = canvas_depth(before, x, y) < 2;
        seen += there;
        missed += drawn != there;
    }
    CHECK_SAY(missed == 0, "%d of %d pixels", missed, seen);
    CHECK(stats.fragments >= seen);
    return seen;
}

/* A first pass without colour, in any shading; then colour, where depth is equal, in any other: the
   same pixels, all of them. */
/* G9 */
TEST(depth, passes_of_every_pair_of_shadings_agree)
{
    static depth_mesh m;
    long touched = 0;
    for (int i = 0; i < 9 * 30; i++) {
        canvas first = canvas_open(DEPTH_WIDTH, DEPTH_HEIGHT, 0, SHADE_FORMAT_RGBA32F, 1);
        canvas second = canvas_open(DEPTH_WIDTH, DEPTH_HEIGHT, 0, SHADE_FORMAT_RGBA32F, 1);
        random_depth_mesh(&m);
        canvas_clear(&first, 2); /* also the depth of 1 is nearer */
        canvas_clear(&second, 2);
        m.state.shading = (shade_shading)(i % 3);
        void *color = first.target.color;
        first.target.color = NULL;
        canvas_draw_mesh(&first, &m.mesh, &m.state);
        first.target.color = color;
        m.state.shading = (shade_shading)(i / 3 % 3);
        canvas_draw_mesh(&second, &m.mesh, &m.state);
        CHECK_SAY(same_depths(&first, &second),
                  "shadings %d and %d, map %d, cutoff %g", i % 3, i / 3 % 3,
                  m.mesh.texcoords != NULL, (double)m.state.alpha_cutoff);
        touched += check_pass_over(&first, &second, &m, SHADE_COMPARE_LESS_EQUAL);
        touched += check_pass_over(&first, &second, &m, SHADE_COMPARE_EQUAL);
        free_texture(&m.map);
        free(m.memory);
        canvas_close(&first);
        canvas_close(&second);
    }
    CHECK_SAY(touched > 100000, "%ld pixels", touched);
}

/* One triangle from near to far: as many pixels in the second pass as in the first. */
/* G9 */
TEST(depth, a_steep_triangle_is_drawn_whole_by_the_second_pass)
{
    static const float corner[] = { 3, -1, -2, 0, 2, -4, -3, -1, -9 };
    shade_mesh mesh = plain_mesh(corner, 3);
    shade_light light = shade_point_light(shade_v3(1, 2, 3), shade_v3(1, 1, 1));
    for (int i = 0; i < 18; i++) {
        canvas c = canvas_ready(200, 200, 0, SHADE_FORMAT_RGBA8, 1);
        shade_draw_state s = plain_state(&light);
        shade_stats first, second;
        s.projection = shade_mat4_perspective(1, 1, 0.1f, 20);
        s.shading = (shade_shading)(i % 3);
        shade_target target = c.target;
        target.color = NULL;
        CHECK_INT(shade_draw_mesh(&target, &mesh, &s, &first), SHADE_OK);
        s.shading = (shade_shading)(i / 3 % 3);
        s.raster.depth_test = i < 9 ? SHADE_COMPARE_LESS_EQUAL : SHADE_COMPARE_EQUAL;
        second = canvas_draw_mesh(&c, &mesh, &s);
        CHECK_INT(first.fragments, 14029);
        CHECK_INT(second.fragments, 14029);
        canvas_close(&c);
    }
}
