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

/* -------------------------------------------------------------------------------- hidden blocks */

/* Leaving out hidden blocks of a draw changes no bit of its picture. */

enum { BLOCKS_MOST = 60 };

/* Corners of count triangles, most of them big, at depths that slope or are level. */
static void random_walls(shade_vec4 *clip, int count, int width, int height)
{
    static const int kinds[] = { 2, 2, 2, 6, 6, 3, 5, 1 };
    for (int i = 0; i < count; i++) {
        int64_t x[3], y[3];
        double level = 2 * rnd_unit() - 1, slope = rnd_one_in(3) ? 0 : rnd_unit();
        random_corners(kinds[rnd_int(0, 7)], width, height, x, y);
        if (i % 12 == 3) {    /* all of the picture, to its corners */
            x[0] = x[1] = -width * 200;
            x[2] = width * 500;
            y[0] = -height * 250;
            y[1] = height * 510;
            y[2] = height * 128;
        }
        for (int k = 0; k < 3; k++) {
            double z = level + slope * (2 * rnd_unit() - 1);
            z = z < -1 ? -1 : z > 1 ? 1 : z;
            clip[3 * i + k] = clip_of_fx8((double)x[k], (double)y[k], width, height, z,
                                          (double)rnd_log(0.5, 2));
        }
    }
}

static void copy_clip_rectangle(shade_target *to, const shade_target *from)
{
    to->clip_x = from->clip_x;
    to->clip_y = from->clip_y;
    to->clip_width = from->clip_width;
    to->clip_height = from->clip_height;
}

/* Every comparison; now and then depth that is read alone, and biases up to those that move every
   depth to 0. */
static void random_depth_state(shade_raster *r, int round)
{
    r->depth_test = (shade_compare)(round % 6);
    r->depth_read_only = rnd_one_in(8);
    r->depth_bias = rnd_one_in(4) ? rnd_float(-0.1, 0.1) : rnd_one_in(20) ? -FLT_MAX : 0;
}

/* Draws each triangle of a scene by a call of its own; returns how many fragments that makes. */
static long long draw_in_turns(canvas *c, shade_pipeline p, const scene *s, int count)
{
    long long fragments = 0;
    for (int i = 0; i < count; i++) {
        scene part = { s->clip + 3 * i, NULL, 0, s->color + i, NULL };
        shade_stats one;
        p.uniforms = &part;
        one = canvas_draw(c, &p, 3);
        fragments += one.fragments;
    }
    return fragments;
}

/* A draw that may discard tests depth at the end, pixel by pixel; one triangle hides none. */
TEST(depth, a_draw_is_its_triangles_in_turn_and_its_late_depth_test)
{
    shade_vec4 clip[3 * BLOCKS_MOST], color[BLOCKS_MOST];
    for (int i = 0; i < BLOCKS_MOST; i++)
        color[i] = shade_v4(rnd_float(0, 1), rnd_float(0, 1), rnd_float(0, 1), rnd_float(0, 1));
    for (int round = 0; round < test_rounds(240); round++) {
        int big = round % 20 == 19, count = big ? 20 : BLOCKS_MOST, strip = rnd_one_in(3);
        int width = big ? rnd_int(1000, 1500) : rnd_int(20, 200);
        int height = big ? rnd_int(600, 1100) : rnd_int(8, 120);
        int first = strip ? rnd_int(0, height - 1) : 0;
        int rows = strip ? rnd_int(1, height - first) : 0;
        canvas whole = canvas_strip(width, height, 0, SHADE_FORMAT_RGBA8, 1, first, rows);
        canvas turns = canvas_strip(width, height, 0, SHADE_FORMAT_RGBA8, 1, first, rows);
        canvas late = canvas_strip(width, height, 0, SHADE_FORMAT_RGBA8, 1, first, rows);
        scene s = { clip, NULL, 0, color, NULL };
        shade_pipeline p = scene_pipeline(&s);
        shade_stats a, b;
        float clear = rnd_one_in(2) ? rnd_float(0, 1) : round % 6 / 2 == 1 ? 0.0f : 1.0f;
        p.fragment = scene_flat;
        random_depth_state(&p.raster, round);
        canvas_clear(&whole, clear);
        canvas_clear(&turns, clear);
        canvas_clear(&late, clear);
        if (rnd_one_in(2)) random_clip(&whole.target);
        copy_clip_rectangle(&turns.target, &whole.target);
        copy_clip_rectangle(&late.target, &whole.target);
        random_walls(clip, count, width, height);
        a = canvas_draw(&whole, &p, 3 * count);
        long long fragments = draw_in_turns(&turns, p, &s, count);
        p.may_discard = 1;
        b = canvas_draw(&late, &p, 3 * count);
        CHECK(canvas_same(&whole, &turns));
        CHECK(canvas_same(&whole, &late));
        CHECK_INT(a.fragments, fragments);
        CHECK_INT(a.fragments, b.fragments);
        CHECK_INT(a.drawn, b.drawn);
        canvas_close(&whole);
        canvas_close(&turns);
        canvas_close(&late);
    }
}

/* Forgets all depths drawn so far, once, when a pixel of triangle 1 is shaded. */
typedef struct forgetful {
    scene s;    /* first, for scene_vertex */
    const shade_target *target;
    float cleared;
    int *done;
} forgetful;
static void forgetful_fragment(const void *uniforms, const shade_fragments *SHADE_RESTRICT in,
                               shade_colors *SHADE_RESTRICT out)
{
    const forgetful *f = (const forgetful *)uniforms;
    const shade_target *t = f->target;
    (void)out;
    if (*f->done || in->primitive[in->count - 1] != 1) return;
    for (int i = 0; i < t->width * t->height; i++) t->depth[i] = f->cleared;
    *f->done = 1;
}

enum { FILLED_SIDE = SHADE_LANES / 4, FILLED_TALL = FILLED_SIDE / 2, FILLED_EDGE = 48 };
enum { FILLED_WIDTH = 32 * FILLED_SIDE + 1 + FILLED_EDGE };
enum { FILLED_HEIGHT = 8 * FILLED_TALL + FILLED_EDGE };

/* Three triangles beyond the picture: the first at depth 0.5, up to a cut on one side; the second,
   nearer, up to the same cut; the third, farther than both, over everything. */
static void filled_walls(shade_vec4 clip[9], int by_columns, int reversed, double cut_x,
                         double cut_y)
{
    static const int corner[3][2] = { { 0, 0 }, { 2, 0 }, { 1, 1 } };
    const double far_x = FILLED_WIDTH * 256.0, far_y = FILLED_HEIGHT * 256.0;
    for (int k = 0; k < 9; k++) {
        double along = corner[k % 3][0], X, Y, z = k < 3 ? 0.5 : k < 6 ? 0.25 : 0.75;
        if (k >= 6) {
            cut_x = 1.99 * far_x;
            cut_y = 1.99 * far_y;
        }
        X = by_columns ? (corner[k % 3][1] ? -0.99 * far_x : cut_x) : (1.5 * along - 1) * far_x;
        Y = by_columns ? (1.5 * along - 1) * far_y : corner[k % 3][1] ? -0.99 * far_y : cut_y;
        z = reversed ? 1 - z : z;
        clip[k] = clip_of_fx8(floor(X), floor(Y), FILLED_WIDTH, FILLED_HEIGHT, 2 * z - 1, 1);
    }
}

/* Two triangles fill the clip rectangle, or up to a line between blocks, level; then all depths are
   cleared behind the draw's back.  A third, farther one draws the rest alone: filled blocks are not
   looked at again.  They are 32 x 8 pixels from the corner of the rectangle on, and 32 x 16 where
   that would be one column too many.  A wall that is not cut reaches past the last block, and all
   are more than a tile wide, as smaller triangles do not look at bounds. */
TEST(depth, filled_blocks_are_left_out)
{
    enum { EDGE = FILLED_EDGE };
    canvas c = canvas_open(FILLED_WIDTH, FILLED_HEIGHT, 0, SHADE_FORMAT_RGBA8, 1);
    for (int i = 0; i < 96; i++) {
        const int most = i % 4 / 2, more = FILLED_SIDE > 2 && i % 4 == 3;
        const int by_columns = i / 4 % 2, reversed = i / 8 % 2;
        /* every other rectangle is the largest that is left out, every eighth one block */
        const int widest = 32 * FILLED_SIDE, tallest = 8 * FILLED_TALL;
        const int w = most ? widest + more : i % 8 == 1 ? 32 : rnd_int(33, widest);
        const int h = most ? tallest : i % 8 == 1 ? 8 : rnd_int(8, tallest);
        const int x = rnd_int(0, EDGE - 1), y = rnd_int(0, EDGE - 1), size = more ? 16 : 8;
        int columns = w, rows = h, done = 0;
        shade_vec4 clip[9];
        shade_stats stats;
        forgetful f = { { clip, NULL, 0, NULL, NULL }, &c.target, reversed ? 0.0f : 1.0f, &done };
        shade_pipeline p = scene_pipeline(&f.s);
        if (by_columns && w >= 96) columns = 32 * rnd_int(2, w / 32);
        if (!by_columns && h >= 2 * size) rows = size * rnd_int(1, h / size);
        filled_walls(clip, by_columns, reversed, (x + columns + 64 * (columns == w)) * 256.0,
                     (y + rows) * 256.0);
        p.fragment = forgetful_fragment;
        p.raster.depth_test = (shade_compare)(i / 16 % 2 + 2 * reversed);
        c.target.clip_x = x;
        c.target.clip_y = y;
        c.target.clip_width = w;
        c.target.clip_height = h;
        canvas_clear(&c, f.cleared);
        stats = canvas_draw(&c, &p, 9);
        CHECK(done);
        CHECK_INT(stats.fragments, 2 * columns * rows + w * h - columns * rows);
    }
    canvas_close(&c);
}

/* Walls before and behind each other, filling whole blocks: each pixel holds the nearest. */
TEST(depth, level_walls_keep_the_nearest)
{
    enum { WALLS = 40, WIDTH = 300, HEIGHT = 90 };
    shade_vec4 clip[6 * WALLS], color[2 * WALLS];
    for (int round = 0; round < 24; round++) {
        int left[WALLS], right[WALLS], top[WALLS], bottom[WALLS], reversed = round % 2;
        float depth[WALLS];
        canvas c = canvas_open(WIDTH, HEIGHT, 0, SHADE_FORMAT_RGBA8, 1);
        scene s = { clip, NULL, 0, color, NULL };
        shade_pipeline p = scene_pipeline(&s);
        for (int i = 0; i < WALLS; i++) {
            static const int corner[6][2] = { { 0, 0 }, { 0, 1 }, { 1, 1 },
                                              { 0, 0 }, { 1, 1 }, { 1, 0 } };
            left[i] = rnd_int(0, WIDTH - 40);
            right[i] = rnd_int(left[i] + 1, WIDTH);
            top[i] = rnd_int(0, HEIGHT - 20);
            bottom[i] = rnd_int(top[i] + 1, HEIGHT);
            depth[i] = (float)rnd_int(1, 255) / 256;
            color[2 * i] = color[2 * i + 1] = shade_v4((float)(i + 1) / 255, 0, 0, 1);
            for (int k = 0; k < 6; k++)
                clip[6 * i + k] = clip_of_fx8((corner[k][0] ? right[i] : left[i]) * 256.0,
                                              (corner[k][1] ? bottom[i] : top[i]) * 256.0, WIDTH,
                                              HEIGHT, 2 * (double)depth[i] - 1, 1);
        }
        p.fragment = scene_flat;
        p.raster.depth_test = (shade_compare)(round % 4 / 2 + 2 * reversed);
        canvas_clear(&c, reversed ? 0.0f : 1.0f);
        canvas_draw(&c, &p, 6 * WALLS);
        for (int y = 0; y < HEIGHT; y++)
            for (int x = 0; x < WIDTH; x++) {
                int nearest = -1, or_equal = p.raster.depth_test % 2;
                for (int i = 0; i < WALLS; i++) {
                    if (x < left[i] || x >= right[i] || y < top[i] || y >= bottom[i]) continue;
                    float gain = nearest < 0 ? 1.0f : depth[nearest] - depth[i];
                    if (nearest >= 0 && reversed) gain = -gain;
                    if (gain > 0 || (gain == 0 && or_equal)) nearest = i;
                }
                CHECK_INT(canvas_bytes(&c, x, y)[0], nearest + 1);
            }
        canvas_close(&c);
    }
}
