/* chunks.c - boxes around runs of triangles: nothing that they skip could have been seen, or met by
   a ray. */
#include "unit.h"

enum {
    CHUNK_VERTICES = 150,
    CHUNK_TRIANGLES = 400,
    CHUNK_MOST = 2 * CHUNK_TRIANGLES + 80 /* of a list with empty ones */
};

typedef struct chunk_scene {
    shade_vec3 position[CHUNK_VERTICES], normal[CHUNK_VERTICES], color[CHUNK_VERTICES];
    float texcoord[2 * CHUNK_VERTICES];
    uint32_t index[3 * CHUNK_TRIANGLES], sorted[3 * CHUNK_TRIANGLES];
    shade_chunk chunk[CHUNK_MOST];
    uint32_t texel[16];
    shade_texture map;
    shade_light light[2];
    shade_mesh mesh; /* with its chunks */
    shade_draw_state state;
    int width, height;
} chunk_scene;

static int chunk_corners(const shade_mesh *m)
{
    return m->indices ? m->index_count : m->vertex_count;
}

static shade_vec3 chunk_corner(const shade_mesh *m, int k)
{
    const size_t stride = m->position_stride ? (size_t)m->position_stride : 12;
    const size_t v = m->indices ? m->indices[k] : (size_t)k;
    shade_vec3 p;
    memcpy(&p, (const char *)m->positions + v * stride, 12);
    return p;
}

/* -------------------------------------------------------------------------------- random scenes */

/* Soups, patches whose neighbours share vertices, slivers, sizes apart by powers of ten; now and
   then a vertex that is no number or infinite. */
static void random_chunk_positions(chunk_scene *s, double size)
{
    const int kind = rnd_int(0, 3);
    for (int k = 0; k < CHUNK_VERTICES; k++) {
        const double x = k % 15 / 7.0 - 1, y = k / 15 / 5.0 - 1;
        d3 p = d3_scale(rnd_direction(), rnd_unit());
        if (kind == 1) p = d3_of(x, y, 0.3 * sin(3 * x + 2 * y));
        if (kind == 2) p.x *= 1e-3;
        if (kind == 3) p = d3_scale(p, (double)rnd_log(1e-4, 30));
        s->position[k] = d3_round(d3_scale(p, size));
        s->normal[k] = d3_round(rnd_direction());
        s->color[k] = shade_v3(rnd_float(0, 1), rnd_float(0, 1), rnd_float(0, 1));
        s->texcoord[2 * k] = rnd_float(-1, 2);
        s->texcoord[2 * k + 1] = rnd_float(-1, 2);
    }
    for (int n = rnd_one_in(4) ? rnd_int(1, 4) : 0; n > 0; n--)
        s->position[rnd_int(0, CHUNK_VERTICES - 1)].y = rnd_nasty();
    const int shared = rnd_one_in(3) ? 9 : CHUNK_VERTICES; /* few: hundreds of triangles a batch */
    for (int t = 0; t < CHUNK_TRIANGLES; t++) {
        const int near = rnd_int(0, CHUNK_VERTICES - 17);
        uint32_t *corner = s->index + 3 * t;
        for (int k = 0; k < 3; k++) corner[k] = (uint32_t)rnd_int(0, shared - 1);
        if (shared < CHUNK_VERTICES || (kind == 0 && t % 2)) continue;
        corner[0] = (uint32_t)near;
        corner[1] = (uint32_t)(near + (t % 2 ? 1 : 15));
        corner[2] = (uint32_t)(near + (t % 2 ? 16 : 1));
    }
}

/* Cuts the triangles of the mesh into chunks of random size, empty ones among them, and gives them
   the boxes of shade_mesh_chunks with one triangle a chunk. */
static void random_chunk_list(chunk_scene *s, int sizes)
{
    static shade_chunk single[CHUNK_TRIANGLES];
    const int triangles = chunk_corners(&s->mesh) / 3;
    int count = rnd_one_in(2) ? 20 : 0, first = 0;
    memset(s->chunk, 0, sizeof s->chunk); /* empty ones, at the origin */
    CHECK_INT(shade_mesh_chunks(&s->mesh, 1, single, CHUNK_TRIANGLES, NULL), SHADE_OK);
    while (first < triangles) {
        shade_chunk *c = &s->chunk[count++];
        const int size = rnd_one_in(8) ? triangles : rnd_int(1, sizes);
        c->first = first;
        if (rnd_one_in(3) && count < CHUNK_TRIANGLES) continue; /* empty */
        c->low = single[first].low;
        c->high = single[first].high;
        for (c->count = 1; c->count < size && first + c->count < triangles; c->count++) {
            c->low = shade_min(c->low, single[first + c->count].low);
            c->high = shade_max(c->high, single[first + c->count].high);
        }
        first += c->count;
    }
    for (int n = rnd_one_in(2) ? 40 : 0; n > 0; n--) {
        s->chunk[count++].first = rnd_int(0, triangles);
    }
    s->mesh.chunks = s->chunk;
    s->mesh.chunk_count = count;
}

static shade_mat4 wild_matrix(double size)
{
    shade_mat4 m;
    float f[16];
    for (int k = 0; k < 16; k++) f[k] = rnd_one_in(4) ? 0 : rnd_float(-size, size);
    if (rnd_one_in(6)) f[rnd_int(0, 15)] = rnd_nasty();
    memcpy(&m, f, sizeof m);
    return m;
}

/* Perspectives that cut the mesh at the near plane or have the eye inside it, parallel and reversed
   projections, matrices of no camera at all. */
static void random_chunk_camera(chunk_scene *s, double size)
{
    const float near = (float)(size * (double)rnd_log(0.01, 1));
    const float half = (float)(size * (double)rnd_log(0.05, 2));
    const d3 eye = d3_scale(rnd_direction(), size * (double)rnd_log(0.1, 6));
    shade_draw_state *state = &s->state;
    if (!rnd_one_in(5))
        state->view = shade_mat4_look_at(d3_round(eye), random_vector(0.3 * size),
                                         d3_round(rnd_direction()));
    if (rnd_one_in(3))
        state->model = shade_mat4_rotation(rnd_float(-3, 3), d3_round(rnd_direction()));
    if (rnd_one_in(5)) state->model = wild_matrix(1);
    switch (rnd_int(0, 5)) {
    case 0:
    case 1:
        state->projection = shade_mat4_perspective(rnd_float(0.3, 2.5), 1.2f, near, 20 * near);
        break;
    case 2:
        state->projection = shade_mat4_perspective_reversed(rnd_float(0.3, 2.5), 1.2f, near);
        state->raster.depth_zero_to_one = 1;
        state->raster.depth_test = SHADE_COMPARE_GREATER;
        break;
    case 3: state->projection = shade_mat4_ortho(-half, half, -half, half, -half, half); break;
    case 4: state->projection = wild_matrix(1 / size); break;
    default: break;
    }
    if (rnd_one_in(5)) state->raster.depth_zero_to_one ^= 1;
}

/* The colour of a pixel is the number of its triangle, so that numbers are compared as well. */
static void chunk_number_shader(const void *uniforms, const shade_fragments *SHADE_RESTRICT in,
                                shade_colors *SHADE_RESTRICT out)
{
    (void)uniforms;
    for (int i = 0; i < SHADE_LANES; i++) {
        out->color[0][i] = (float)in->primitive[i] + 1;
        out->color[1][i] = in->varying[0][i];
        out->color[2][i] = (float)in->front[i];
        out->discard[i] = in->primitive[i] % 7 == 6;
    }
}

static void random_chunk_state(chunk_scene *s, double size)
{
    static const shade_material material = { { 0.1f, 0, 0 }, { 0.2f, 0.2f, 0.2f },
                                             { 0.5f, 0.6f, 1 }, { 0.4f, 0.4f, 0.4f }, 9 };
    shade_draw_state *state = &s->state;
    for (int k = 0; k < 16; k++) s->texel[k] = (uint32_t)rnd_bits() | (k % 3 ? 0xFF000000u : 0);
    s->map.pixels = s->texel;
    s->map.width = s->map.height = 4;
    s->light[0] = shade_point_light(random_vector(3 * size), shade_v3(1, 0.9f, 0.8f));
    s->light[1] = shade_directional_light(random_vector(1), shade_v3(0.3f, 0.3f, 0.5f));
    state->lighting.lights = s->light;
    state->lighting.light_count = 2;
    state->lighting.ambient = shade_v3(0.1f, 0.1f, 0.1f);
    state->shading = random_shading();
    state->material = rnd_one_in(3) ? NULL : &material;
    state->raster.cull = (shade_cull)rnd_int(0, 2);
    state->raster.blend = (shade_blend)rnd_int(0, SHADE_BLEND_ADD);
    if (rnd_one_in(3)) state->transparency = 0.4f;
    if (rnd_one_in(3)) state->alpha_cutoff = 0.5f;
    if (SHADE_MAX_VARYINGS >= 11 && rnd_one_in(2)) state->diffuse_map = &s->map;
    if (SHADE_MAX_VARYINGS >= 11 && state->shading == SHADE_SHADING_PER_FRAGMENT && rnd_one_in(2))
        state->fragment = chunk_number_shader;
}

static void random_chunk_scene(chunk_scene *s)
{
    const double size = (double)rnd_log(1e-3, 1e3);
    memset(s, 0, sizeof *s);
    random_chunk_positions(s, size);
    random_chunk_camera(s, size);
    random_chunk_state(s, size);
    s->mesh.positions = &s->position[0].x;
    s->mesh.vertex_count = CHUNK_VERTICES;
    if (rnd_one_in(2)) s->mesh.normals = &s->normal[0].x;
    if (SHADE_MAX_VARYINGS >= 11 && rnd_one_in(2)) s->mesh.colors = &s->color[0].x;
    if (rnd_one_in(2)) s->mesh.texcoords = s->texcoord;
    if (!rnd_one_in(4)) {
        s->mesh.indices = s->index;
        s->mesh.index_count = 3 * CHUNK_TRIANGLES;
    }
    s->width = rnd_int(1, 70);
    s->height = rnd_int(1, 60);
}

/* The triangles of the mesh in the order that shade_mesh_chunks gives them. */
static void sort_chunk_scene(chunk_scene *s)
{
    const int corners = chunk_corners(&s->mesh);
    s->mesh.chunks = NULL;
    s->mesh.chunk_count = 0;
    CHECK_INT(shade_mesh_chunks(&s->mesh, rnd_int(1, 20), s->chunk, CHUNK_MOST, s->sorted),
              SHADE_OK);
    s->mesh.indices = s->sorted;
    s->mesh.index_count = corners;
}

/* --------------------------------------------------------------------- with chunks and without */

static float chunk_clear_depth(const chunk_scene *s)
{
    return s->state.raster.depth_test == SHADE_COMPARE_GREATER ? 0.0f : 1.0f;
}

static shade_stats draw_chunks(const chunk_scene *s, const shade_target *t, int with_chunks)
{
    shade_mesh mesh = s->mesh;
    shade_stats stats;
    if (!with_chunks) mesh.chunks = NULL;
    if (!with_chunks) mesh.chunk_count = 0;
    CHECK_INT(shade_draw_mesh(t, &mesh, &s->state, &stats), SHADE_OK);
    CHECK(stats.triangles == stats.skipped + stats.culled + stats.clipped + stats.rejected +
                                 stats.drawn);
    CHECK_INT(stats.triangles, chunk_corners(&mesh) / 3);
    if (!with_chunks) CHECK_INT(stats.skipped, 0);
    return stats;
}

/* Whatever is not skipped has the same fate. */
static void check_chunk_stats(const shade_stats *got, const shade_stats *want)
{
    CHECK_INT(got->fragments, want->fragments);
    CHECK(got->culled <= want->culled && got->clipped <= want->clipped);
    CHECK(got->rejected <= want->rejected && got->drawn <= want->drawn);
}

/* Whole pictures or a clip rectangle of them. */
static void check_chunk_picture(const chunk_scene *s, shade_format format, shade_stats *sum)
{
    const int stride = s->width + rnd_int(0, 3);
    canvas with = canvas_open(s->width, s->height, stride, format, !rnd_one_in(4));
    canvas without = canvas_open(s->width, s->height, stride, format, with.target.depth != NULL);
    shade_stats got, want;
    canvas_clear(&with, chunk_clear_depth(s));
    canvas_clear(&without, chunk_clear_depth(s));
    if (rnd_one_in(2)) {
        with.target.clip_x = rnd_int(-3, s->width);
        with.target.clip_y = rnd_int(-3, s->height);
        with.target.clip_width = rnd_int(0, 30);
        with.target.clip_height = rnd_int(0, 30);
    }
    without.target.clip_x = with.target.clip_x;
    without.target.clip_y = with.target.clip_y;
    without.target.clip_width = with.target.clip_width;
    without.target.clip_height = with.target.clip_height;
    got = draw_chunks(s, &with.target, 1);
    want = draw_chunks(s, &without.target, 0);
    CHECK(canvas_same(&with, &without));
    check_chunk_stats(&got, &want);
    sum->skipped += got.skipped;
    sum->drawn += got.drawn;
    sum->fragments += got.fragments;
    canvas_close(&with);
    canvas_close(&without);
}

static void check_chunk_pictures(int sorted)
{
    static chunk_scene s;
    shade_stats sum = { 0 };
    for (int i = 0; i < 250; i++) {
        random_chunk_scene(&s);
        if (sorted) sort_chunk_scene(&s);
        random_chunk_list(&s, rnd_one_in(3) ? 1 : rnd_int(1, 60));
        check_chunk_picture(&s, rnd_one_in(3) ? rnd_format() : SHADE_FORMAT_RGBA32F, &sum);
    }
    CHECK_SAY(sum.skipped > 5000 && sum.drawn > 4000 && sum.fragments > 20000,
              "%lld skipped, %lld drawn, %lld fragments", sum.skipped, sum.drawn, sum.fragments);
}

/* G13 */
TEST(chunks, pictures_have_the_same_bits_with_chunks_and_without) { check_chunk_pictures(0); }
/* G13 */
TEST(chunks, sorted_meshes_have_the_same_bits_with_chunks_and_without) { check_chunk_pictures(1); }

/* The whole picture without chunks, and bands and strips of it with them: the same bits, and
   together the same fragments. */
static long long check_chunk_bands(const chunk_scene *s, int strips)
{
    canvas whole = canvas_open(s->width, s->height, 0, SHADE_FORMAT_RGBA32F, 1);
    long long fragments = 0, skipped = 0;
    shade_stats want;
    canvas_clear(&whole, chunk_clear_depth(s));
    want = draw_chunks(s, &whole.target, 0);
    for (int y = 0, rows; y < s->height; y += rows) {
        rows = rnd_int(1, s->height - y < 9 ? s->height - y : 9);
        canvas part = canvas_strip(s->width, s->height, 0, SHADE_FORMAT_RGBA32F, 1, strips ? y : 0,
                                   strips ? rows : s->height);
        shade_stats stats;
        canvas_clear(&part, chunk_clear_depth(s));
        if (!strips) part.target.clip_y = y;
        if (!strips) part.target.clip_width = s->width;
        if (!strips) part.target.clip_height = rows;
        stats = draw_chunks(s, &part.target, 1);
        for (int j = y; j < y + rows; j++) {
            const size_t bytes = 16 * (size_t)s->width;
            CHECK(!memcmp(canvas_pixel(&part, 0, j), canvas_pixel(&whole, 0, j), bytes));
            CHECK(float_bits(canvas_depth(&part, s->width - 1, j)) ==
                  float_bits(canvas_depth(&whole, s->width - 1, j)));
        }
        fragments += stats.fragments;
        skipped += stats.skipped;
        canvas_close(&part);
    }
    CHECK_INT(fragments, want.fragments);
    canvas_close(&whole);
    return skipped;
}

static void check_chunk_parts(int strips)
{
    static chunk_scene s;
    long long skipped = 0;
    for (int i = 0; i < 40; i++) {
        random_chunk_scene(&s);
        if (rnd_one_in(2)) sort_chunk_scene(&s);
        random_chunk_list(&s, rnd_int(1, 30));
        skipped += check_chunk_bands(&s, strips);
    }
    CHECK_SAY(skipped > 5000, "%lld skipped", skipped);
}

/* G13 */
TEST(chunks, bands_with_chunks_together_make_the_picture_without) { check_chunk_parts(0); }
/* G13 */
TEST(chunks, strips_with_chunks_together_make_the_picture_without) { check_chunk_parts(1); }

/* -------------------------------------------------------------------------- what a box may hide */

/* Outside of plane k is where its value is below 0: left, right, top, bottom, near, far. */
static void chunk_plane(const shade_target *t, double m[4][4], int zero_to_one, int k,
                        double plane[4])
{
    const int strip = t->row_count ? t->row_count : t->height;
    const int all = !t->clip_x && !t->clip_y && !t->clip_width && !t->clip_height;
    const double left = fmax(t->clip_x, 0), top = fmax(t->clip_y, t->row_offset);
    const double right = all ? t->width : fmin(t->clip_x + t->clip_width, t->width);
    const double bottom =
        fmin(all ? t->height : t->clip_y + t->clip_height, t->row_offset + strip);
    for (int c = 0; c < 4; c++) {
        const double x = m[0][c], y = m[1][c], z = m[2][c], w = m[3][c];
        const double value[6] = { x - (2 * left / t->width - 1) * w,
                                  (2 * right / t->width - 1) * w - x,
                                  (1 - 2 * top / t->height) * w - y,
                                  y - (1 - 2 * bottom / t->height) * w,
                                  zero_to_one ? z : z + w,
                                  w - z };
        plane[c] = value[k];
    }
}

/* What the corners of the box say: 1 where it meets each plane's inside, 0 where it lies outside of
   one by more than a hundred thousandth of the numbers that enter, -1 in between, and where the
   matrix is not finite. */
static int ref_box_visible(const shade_target *t, double m[4][4], int zero_to_one,
                           shade_vec3 low, shade_vec3 high)
{
    int answer = 1;
    for (int k = 0; k < 16; k++)
        if (!isfinite(m[k / 4][k % 4])) return -1;
    for (int k = 0; k < 6; k++) {
        double plane[4], most = -HUGE_VAL, size = 0;
        chunk_plane(t, m, zero_to_one, k, plane);
        for (int corner = 0; corner < 8; corner++) {
            const shade_vec3 p = shade_v3(corner & 1 ? high.x : low.x, corner & 2 ? high.y : low.y,
                                          corner & 4 ? high.z : low.z);
            const double in[4] = { (double)p.x, (double)p.y, (double)p.z, 1 };
            double value = 0, sum = 0;
            for (int c = 0; c < 4; c++) {
                const int row = k < 2 ? 0 : k < 4 ? 1 : 2;
                value += plane[c] * in[c];
                sum += (fabs(m[row][c]) + fabs(m[3][c]) + (double)FLT_MIN) * fabs(in[c]);
            }
            if (!isfinite(sum)) return -1;
            most = fmax(most, value);
            size = fmax(size, sum);
        }
        if (most < -1e-5 * size) return 0;
        if (most < 0) answer = -1;
    }
    return answer;
}

static void chunk_rows_of(shade_mat4 m, double rows[4][4])
{
    const dmat d = dmat_from(m);
    for (int r = 0; r < 4; r++)
        for (int c = 0; c < 4; c++) rows[r][c] = d.m[r][c];
}

static void random_chunk_clip(shade_target *t)
{
    if (rnd_one_in(4)) return;
    t->clip_x = rnd_int(0, t->width - 1);
    t->clip_y = rnd_int(t->row_offset, t->row_offset + t->row_count - 1);
    t->clip_width = rnd_one_in(3) ? 1 : rnd_int(1, t->width);
    t->clip_height = rnd_one_in(3) ? 1 : rnd_int(1, t->height);
}

static shade_mat4 chunk_matrix(shade_mat4 m)
{
    return dmat_max(dmat_from(m)) == 0 ? shade_mat4_identity() : m;
}

/* Cameras, and matrices whose depth lets w come as near to 0 as it likes, for objects of that
   size, at times far from the origin of their own space. */
static shade_mat4 random_chunk_matrix(int *zero_to_one, double size)
{
    static chunk_scene s;
    const float tiny = rnd_one_in(2) ? 0 : 1e-9f, scale = (float)(1 / size);
    float f[16];
    shade_mat4 m;
    memset(&s, 0, sizeof s);
    random_chunk_camera(&s, 1);
    *zero_to_one = s.state.raster.depth_zero_to_one;
    m = shade_mat4_mul(chunk_matrix(s.state.projection), chunk_matrix(s.state.view));
    for (int k = 0; k < 16; k++) f[k] = rnd_one_in(5) ? 0 : rnd_float(-1, 1);
    for (int c = 0; c < 4; c++) f[4 * c + 2] *= rnd_one_in(9) ? 1 : tiny;
    if (rnd_one_in(2)) memcpy(&m, f, sizeof m);
    m = shade_mat4_mul(m, shade_mat4_scaling(shade_v3(scale, scale, scale)));
    if (!rnd_one_in(3)) return m;
    return shade_mat4_mul(m, shade_mat4_translation(random_vector(size * (double)rnd_log(1, 1e4))));
}

static float some_ulps(double x)
{
    float f = (float)x;
    for (int n = rnd_one_in(2) ? 0 : rnd_int(0, 3); n > 0; n--)
        f = nextafterf(f, rnd_one_in(2) ? -INFINITY : INFINITY);
    return f;
}

static double plane_value(const double plane[4], const double q[4])
{
    return plane[0] * q[0] + plane[1] * q[1] + plane[2] * q[2] + plane[3];
}

/* Moves a point into a plane, along the axis that moves it least; 0 where there is none. */
static int put_on_plane(const double plane[4], double q[4])
{
    int axis = 0;
    for (int c = 1; c < 3; c++)
        if (fabs(plane[c]) > fabs(plane[axis])) axis = c;
    if (plane[axis] == 0) return 0;
    q[axis] -= plane_value(plane, q) / plane[axis];
    return 1;
}

/* A point of the near or the far plane that the matrix puts into the middle of a pixel of the clip
   rectangle, in front of the eye; 0 where no such point was found. */
static int random_seen_point(const shade_target *t, shade_mat4 m, int zero_to_one, int far,
                             double q[4])
{
    const int clipped = t->clip_width != 0, strip = t->row_count;
    const int x0 = t->clip_x, x1 = clipped ? t->clip_x + t->clip_width : t->width;
    const int y0 = clipped ? t->clip_y : t->row_offset, y1 = clipped ? y0 + t->clip_height
                                                                     : y0 + strip;
    const double z = far ? 1 : zero_to_one ? 0 : -1;
    double in[4] = { 2 * (rnd_int(x0, x1 - 1) + 0.5) / t->width - 1,
                     1 - 2 * (rnd_int(y0, y1 - 1) + 0.5) / t->height, z, 1 };
    dmat inverse;
    if (dmat_invert(dmat_from(m), 4, &inverse) == 0) return 0;
    dmat_apply(inverse, in, q);
    for (int k = 0; k < 3; k++) q[k] /= q[3];
    if (!(q[3] > 0 && fabs(q[0]) + fabs(q[1]) + fabs(q[2]) < 1e30)) return 0;
    q[3] = 1;
    return 1;
}

/* A triangle in a plane, as near as floats come to it, around a point; 0 where the
   plane has no direction. */
static int triangle_on_plane(const double plane[4], double size, const double point[4],
                             shade_vec3 p[3])
{
    const double extent = size * (double)rnd_log(1e-4, 10);
    for (int k = 0; k < 3; k++) {
        const d3 at = d3_scale(rnd_direction(), extent);
        double q[4] = { point[0] + at.x, point[1] + at.y, point[2] + at.z, 1 };
        if (!put_on_plane(plane, q)) return 0;
        p[k] = shade_v3(some_ulps(q[0]), some_ulps(q[1]), some_ulps(q[2]));
    }
    return 1;
}

static long long chunk_fragments(const shade_target *t, shade_mat4 m, int zero_to_one,
                                 const shade_vec3 p[3])
{
    const shade_mesh mesh = plain_mesh(&p[0].x, 3);
    shade_stats stats;
    shade_draw_state state = plain_state(NULL);
    state.projection = m;
    state.raster.depth_zero_to_one = zero_to_one;
    state.shading = SHADE_SHADING_PER_VERTEX;
    CHECK_INT(shade_draw_mesh(t, &mesh, &state, &stats), SHADE_OK);
    return stats.fragments;
}

/* Triangles that lie in a plane of what can be seen, but for the last bits of their coordinates:
   what gives a pixel is visible in its very box.  Boxes elsewhere are seen and not seen as their
   corners say. */
TEST(chunks, a_triangle_that_touches_a_pixel_is_visible_in_its_box)
{
    static const int widths[6] = { 1, 2, 7, 64, 300, 16384 };
    static uint32_t pixels[16384 * 4];
    long touching = 0, by_rounding = 0, hidden = 0;
    for (int i = 0; i < test_rounds(150000); i++) {
        const double size = (double)rnd_log(1e-6, 1e6);
        const int n = rnd_one_in(2) ? rnd_int(4, 5) : rnd_int(0, 3);
        double rows[4][4], plane[4], point[4];
        shade_vec3 p[3], low, high;
        int zero_to_one, want, got;
        const shade_mat4 m = random_chunk_matrix(&zero_to_one, size);
        shade_target t = { 0 };
        t.width = widths[rnd_int(0, 5)];
        t.height = t.width == 16384 ? 4 : 16384 / 300;
        t.color = pixels;
        t.row_offset = rnd_int(0, t.height - 1);
        t.row_count = rnd_int(1, t.height - t.row_offset);
        random_chunk_clip(&t);
        chunk_rows_of(m, rows);
        chunk_plane(&t, rows, zero_to_one, n, plane);
        if (!random_seen_point(&t, m, zero_to_one, n == 5, point))
            for (int k = 0; k < 3; k++)
                point[k] = (double)rnd_sign() * size * (double)rnd_log(1e-3, 3);
        if (!triangle_on_plane(plane, size, point, p)) continue;
        low = shade_min(p[0], shade_min(p[1], p[2]));
        high = shade_max(p[0], shade_max(p[1], p[2]));
        want = ref_box_visible(&t, rows, zero_to_one, low, high);
        got = shade_box_visible(&t, m, zero_to_one, low, high);
        if (chunk_fragments(&t, m, zero_to_one, p) > 0) {
            touching++;
            by_rounding += want != 1;
            CHECK_SAY(got, "triangle %d in plane %d is hidden", i, n);
        }
        hidden += !got;
        if (want >= 0) CHECK_INT(got, want);
    }
    CHECK_SAY(touching > test_rounds(3000) && by_rounding > test_rounds(100) &&
                  hidden > test_rounds(1000),
              "%ld touch a pixel, %ld by rounding, %ld hidden", touching, by_rounding, hidden);
}

/* Where x and y, of millions each, leave a difference of about 0, they round by several pixels, and
   neither z nor the constant of the plane says so.  The clip rectangle begins at -1/32. */
TEST(chunks, rounding_of_numbers_that_cancel_hides_nothing)
{
    static uint32_t pixels[64 * 64];
    long by_rounding = 0;
    shade_target t = { .width = 64, .height = 64, .color = pixels };
    for (int i = 0; i < 20000; i++) {
        const float c = rnd_float(0.5, 1), s = rnd_float(0.5, 1), x = rnd_float(8e6, 16e6);
        const double most = -1 / 32.0 - (double)rnd_float(0, 0.5);
        const double y = ((double)c * (double)x - most) / (double)s;
        const int turned = rnd_one_in(2);
        shade_mat4 m = shade_mat4_identity();
        shade_vec3 p[3], low, high;
        for (int k = 0; k < 3; k++) p[k] = shade_v3(x, (float)y + (float)k, rnd_float(-1, 1));
        m.col[0] = turned ? shade_v4(0, c, 0, 0) : shade_v4(c, 0, 0, 0);
        m.col[1] = turned ? shade_v4(0, -s, 0, 0) : shade_v4(-s, 0, 0, 0);
        m.col[2] = turned ? shade_v4(1, 0, 0, 0) : shade_v4(0, 1, 0, 0);
        t.clip_x = turned ? 0 : 31;
        t.clip_width = turned ? 64 : 33;
        t.clip_height = turned ? 33 : 64;
        low = shade_min(p[0], shade_min(p[1], p[2]));
        high = shade_max(p[0], shade_max(p[1], p[2]));
        if (!chunk_fragments(&t, m, 0, p)) continue;
        by_rounding += (double)c * (double)high.x - (double)s * (double)low.y < -1 / 32.0;
        CHECK_SAY(shade_box_visible(&t, m, 0, low, high), "triangle %d is hidden", i);
    }
    CHECK_SAY(by_rounding > 100, "%ld by rounding", by_rounding);
}

/* Where products are below the least float, rounding is no part of their size: z/w >= 0 for all the
   least negative z. */
TEST(chunks, depths_that_underflow_are_not_hidden)
{
    static const shade_vec3 p[3] = { { -1, -1, -1e-20f }, { 1, -1, -2e-20f }, { 0, 1, -1e-20f } };
    static uint32_t pixels[64];
    shade_target t = { .width = 8, .height = 8, .color = pixels };
    for (int e = -10; e >= -44; e--) {
        shade_mat4 m = shade_mat4_identity();
        m.col[2].z = (float)pow(10, e);
        if (chunk_fragments(&t, m, 1, p) > 0)
            CHECK(shade_box_visible(&t, m, 1, shade_v3(-1, -1, -2e-20f), shade_v3(1, 1, -1e-20f)));
    }
    shade_mat4 m = shade_mat4_identity();
    CHECK(!shade_box_visible(&t, m, 1, shade_v3(-1, -1, -2e-20f), shade_v3(1, 1, -1e-20f)));
}

/* -------------------------------------------------------------------------------- the contract */

/* A box that is out of sight until one of its numbers is spoilt: what cannot be told must be
   drawn. */
TEST(chunks, a_box_of_no_numbers_or_the_wrong_way_round_is_visible)
{
    static uint32_t pixels[64];
    const shade_vec3 low = shade_v3(5, 5, 5), high = shade_v3(6, 6, 6);
    const shade_mat4 one = shade_mat4_identity();
    shade_target bad;
    shade_target t = { .width = 8, .height = 8, .color = pixels };
    CHECK_INT(shade_box_visible(&t, one, 0, low, high), 0);
    for (int axis = 0; axis < 3; axis++) {
        CHECK_INT(shade_box_visible(&t, one, 0, with_axis(low, axis, (float)NAN), high), 1);
        CHECK_INT(shade_box_visible(&t, one, 0, low, with_axis(high, axis, -(float)NAN)), 1);
        CHECK_INT(shade_box_visible(&t, one, 0, low, with_axis(high, axis, 4.99f)), 1);
        CHECK_INT(shade_box_visible(&t, one, 0, low, with_axis(high, axis, 5)), 0);
        CHECK_INT(shade_box_visible(&t, one, 0, with_axis(low, axis, -INFINITY), high), 1);
        CHECK_INT(shade_box_visible(&t, one, 0, low, with_axis(high, axis, INFINITY)), 1);
    }
    for (int k = 0; k < 16; k++) {
        float f[16];
        shade_mat4 m;
        memcpy(f, &one, sizeof f);
        f[k] = rnd_one_in(2) ? (float)NAN : -INFINITY;
        memcpy(&m, f, sizeof m);
        if (f[k] != f[k]) CHECK_INT(shade_box_visible(&t, m, 0, shade_v3(0, 0, 0), high), 1);
        (void)shade_box_visible(&t, m, 0, low, high);
    }
    CHECK_INT(shade_box_visible(NULL, one, 0, low, high), 1);
    bad = t;
    bad.width = 0;
    CHECK_INT(shade_box_visible(&bad, one, 0, low, high), 1);
    bad = t;
    bad.color = NULL;
    CHECK_INT(shade_box_visible(&bad, one, 0, low, high), 1);
}

TEST(chunks, a_zero_matrix_is_the_identity)
{
    static uint32_t pixels[64];
    shade_target t = { 0 };
    shade_mat4 zero = { 0 };
    t.width = t.height = 8;
    t.color = pixels;
    for (int i = 0; i < 500; i++) {
        const shade_vec3 low = random_vector(2), high = shade_add(low, shade_v3(0.1f, 0.1f, 0.1f));
        const int same = shade_box_visible(&t, shade_mat4_identity(), i & 1, low, high);
        CHECK_INT(shade_box_visible(&t, zero, i & 1, low, high), same);
    }
}

/* Pixel by pixel: a box of one pixel is visible in the clip rectangles that have it or touch it,
   and in no other. */
TEST(chunks, a_box_is_visible_in_the_rectangles_that_have_its_pixels)
{
    enum { SIDE = 8 };
    static uint32_t pixels[SIDE * SIDE];
    int seen[2] = { 0, 0 };
    shade_target t = { .width = SIDE, .height = SIDE, .color = pixels };
    for (int i = 0; i < 4000; i++) {
        const int x = rnd_int(0, SIDE - 1), y = rnd_int(0, SIDE - 1);
        const float left = (float)(2 * (x + 0.1) / SIDE - 1);
        const float right = (float)(2 * (x + 0.9) / SIDE - 1);
        const float top = (float)(1 - 2 * (y + 0.1) / SIDE);
        const float bottom = (float)(1 - 2 * (y + 0.9) / SIDE);
        t.clip_x = rnd_int(-4, SIDE);
        t.clip_y = rnd_int(-4, SIDE);
        t.clip_width = rnd_int(1, 9);
        t.clip_height = rnd_int(1, 9);
        t.row_offset = rnd_int(0, SIDE - 1);
        t.row_count = rnd_int(1, SIDE - t.row_offset);
        const int inside = x >= t.clip_x && x < t.clip_x + t.clip_width && y >= t.clip_y &&
                           y < t.clip_y + t.clip_height && y >= t.row_offset &&
                           y < t.row_offset + t.row_count;
        CHECK_INT(shade_box_visible(&t, shade_mat4_identity(), 0, shade_v3(left, bottom, 0),
                                    shade_v3(right, top, 0)),
                  inside);
        seen[inside]++;
    }
    CHECK(seen[0] > 1000 && seen[1] > 100);
}

static shade_result chunk_calls(const shade_mesh *m, int call)
{
    static uint32_t pixels[64];
    static shade_vec3 normals[64];
    static unsigned char memory[65536];
    shade_edge edges[64];
    int count;
    shade_draw_state state = plain_state(NULL);
    shade_target t = { .width = 8, .height = 8, .color = pixels };
    state.shading = SHADE_SHADING_PER_VERTEX;
    switch (call) {
    case 0: return shade_draw_mesh(&t, m, &state, NULL);
    case 1: return shade_mesh_normals(m, normals);
    case 2: return shade_mesh_corner_normals(m, 0, normals, memory, sizeof memory);
    default: return shade_mesh_edges(m, edges, 64, &count);
    }
}

TEST(chunks, lists_that_do_not_fit_the_mesh_are_refused_by_every_call)
{
    static const uint32_t index[6] = { 0, 1, 2, 2, 1, 3 };
    static const struct {
        int count, first, triangles;
        shade_result want;
    } list[] = {
        { 1, 0, 2, SHADE_OK },           { 1, 2, 0, SHADE_OK },
        { 1, 1, 1, SHADE_OK },           { 0, 0, 0, SHADE_OK },
        { 0, -5, 99, SHADE_OK },         { -1, 0, 2, SHADE_ERROR_MESH },
        { 1, 0, 3, SHADE_ERROR_MESH },   { 1, 1, 2, SHADE_ERROR_MESH },
        { 1, 3, 0, SHADE_ERROR_MESH },   { 1, -1, 1, SHADE_ERROR_MESH },
        { 1, 0, -1, SHADE_ERROR_MESH },  { 1, 2, -1, SHADE_ERROR_MESH },
        { 1, INT32_MAX, 1, SHADE_ERROR_MESH }, { 1, 1, INT32_MAX, SHADE_ERROR_MESH },
        { 1, INT32_MIN, 1, SHADE_ERROR_MESH }, { 1, 1, INT32_MIN, SHADE_ERROR_MESH },
        { 1, INT32_MAX, INT32_MAX, SHADE_ERROR_MESH },
        { 1, INT32_MIN, INT32_MIN, SHADE_ERROR_MESH },
    };
    shade_vec3 p[6] = { { -1, -1, 0 }, { 1, -1, 0 }, { 0, 1, 0 }, { 1, 1, 0 } };
    const shade_ray ray = { { 0, 0, 4 }, { 0, 0, -1 } };
    for (int i = 0; i < 2 * (int)(sizeof list / sizeof list[0]); i++) {
        const int k = i / 2;
        shade_chunk chunk[2];
        shade_mesh m = plain_mesh(&p[0].x, 6);
        if (i & 1) m.indices = index;
        if (i & 1) m.index_count = 6;
        memset(chunk, 0, sizeof chunk);
        chunk[0].low.x = 1; /* above high: visible */
        chunk[0].first = list[k].first;
        chunk[0].count = list[k].triangles;
        m.chunks = chunk;
        m.chunk_count = list[k].count;
        for (int call = 0; call < 4; call++) CHECK_INT(chunk_calls(&m, call), list[k].want);
        CHECK_INT(shade_mesh_corner_normals_bytes(&m) == 0, list[k].want != SHADE_OK);
        if (list[k].want) CHECK_INT(shade_pick(&m, shade_mat4_identity(), ray, NULL, NULL), -1);
        CHECK_INT(shade_mesh_chunks(&m, 0, chunk + 1, 1, NULL), SHADE_OK); /* ignores the list */
        m.chunks = NULL;
        m.chunk_count = 1;
        for (int call = 0; call < 4; call++) CHECK_INT(chunk_calls(&m, call), SHADE_ERROR_MESH);
        CHECK_INT(shade_pick(&m, shade_mat4_identity(), ray, NULL, NULL), -1);
    }
}

/* Four squares of two triangles side by side, one column of pixels each, drawn with ADD. */
typedef struct chunk_squares {
    shade_vec3 p[24];
    shade_chunk chunk[4000];
    shade_mesh mesh;
    shade_draw_state state;
} chunk_squares;
static void open_squares(chunk_squares *s)
{
    memset(s, 0, sizeof *s);
    for (int k = 0; k < 24; k++) {
        static const int corner[6][2] = { { 0, 0 }, { 1, 0 }, { 1, 1 },
                                          { 0, 0 }, { 1, 1 }, { 0, 1 } };
        s->p[k] = shade_v3((float)(k / 6 + corner[k % 6][0]) / 2 - 1,
                           2 * (float)corner[k % 6][1] - 1, 0);
    }
    s->mesh = plain_mesh(&s->p[0].x, 24);
    CHECK_INT(shade_mesh_chunks(&s->mesh, 2, s->chunk, 4, NULL), SHADE_OK);
    s->mesh.chunks = s->chunk;
    s->mesh.chunk_count = 4;
    s->state.lighting.ambient = shade_v3(1, 1, 1);
    s->state.raster.blend = SHADE_BLEND_ADD;
    s->state.shading = SHADE_SHADING_PER_VERTEX;
}

/* What lies in the four columns, each digit of it. */
static int draw_squares(const chunk_squares *s, shade_stats *stats)
{
    canvas c = canvas_ready(4, 2, 0, SHADE_FORMAT_RGBA32F, 0);
    int digits = 0;
    CHECK_INT(shade_draw_mesh(&c.target, &s->mesh, &s->state, stats), SHADE_OK);
    CHECK(stats->triangles == stats->skipped + stats->drawn);
    for (int x = 0; x < 4; x++) {
        CHECK_NEAR(canvas_float(&c, x, 0, 0), canvas_float(&c, x, 1, 0), 0);
        digits = 10 * digits + (int)canvas_float(&c, x, 0, 0);
    }
    canvas_close(&c);
    return digits;
}

TEST(chunks, exactly_the_triangles_of_the_list_are_drawn)
{
    static chunk_squares s;
    shade_stats stats;
    open_squares(&s);
    CHECK_INT(draw_squares(&s, &stats), 1111);
    CHECK(stats.triangles == 8 && stats.skipped == 0 && stats.fragments == 8);
    s.mesh.chunk_count = 0; /* a list of none */
    CHECK_INT(draw_squares(&s, &stats), 0);
    CHECK(stats.triangles == 0 && stats.fragments == 0);
    s.mesh.chunk_count = 4;
    s.chunk[1] = s.chunk[2]; /* twice, and one left out */
    CHECK_INT(draw_squares(&s, &stats), 1021);
    CHECK(stats.triangles == 8 && stats.fragments == 8);
    open_squares(&s);
    s.chunk[3].first = 0; /* all of them, overlapping the three others */
    s.chunk[3].count = 8;
    s.chunk[3].low.x = -1;
    CHECK_INT(draw_squares(&s, &stats), 2221);
    CHECK(stats.triangles == 14 && stats.fragments == 14);
    s.chunk[3].low = shade_v3(9, 9, 9); /* low above high: the box of nothing hides nothing */
    CHECK_INT(draw_squares(&s, &stats), 2221);
    s.chunk[0].low.x = s.chunk[0].high.x = -4; /* a wrong box hides, and nothing else */
    CHECK_INT(draw_squares(&s, &stats), 1221);
    CHECK(stats.triangles == 14 && stats.skipped == 2 && stats.fragments == 12);
    s.mesh.chunks = NULL;
    s.mesh.chunk_count = 0;
    CHECK_INT(draw_squares(&s, &stats), 1111);
}

enum { FLAKES = 6, FLAKE_CHUNKS = 40 };

/* Triangles of a few pixels, and chunks of one of them each, the same ones often in a row. */
typedef struct chunk_flakes {
    shade_vec3 p[3 * FLAKES];
    shade_chunk single[FLAKES], chunk[FLAKE_CHUNKS];
    shade_mesh mesh;
    shade_material material;
    shade_draw_state state;
} chunk_flakes;
static void random_flakes(chunk_flakes *s)
{
    memset(s, 0, sizeof *s);
    for (int k = 0; k < 3 * FLAKES; k++) {
        const shade_vec3 middle = k % 3 ? s->p[k / 3 * 3] : random_vector(0.7);
        s->p[k] = shade_add(middle, k % 3 ? random_vector(0.4) : shade_v3(0, 0, 0));
    }
    s->mesh = plain_mesh(&s->p[0].x, 3 * FLAKES);
    CHECK_INT(shade_mesh_chunks(&s->mesh, 1, s->single, FLAKES, NULL), SHADE_OK);
    for (int k = 0; k < FLAKE_CHUNKS; k++) {
        const int again = k && !rnd_one_in(3);
        s->chunk[k] = again ? s->chunk[k - 1] : s->single[rnd_int(0, FLAKES - 1)];
    }
    s->material.emission = shade_v3(rnd_float(0, 1), rnd_float(0, 1), rnd_float(0, 1));
    s->state.material = &s->material;
    s->state.transparency = rnd_float(0.1, 0.9);
    s->state.raster.blend = rnd_one_in(2) ? SHADE_BLEND_ADD : SHADE_BLEND_OVER;
    s->state.raster.depth_test = rnd_one_in(2) ? SHADE_COMPARE_ALWAYS : SHADE_COMPARE_LESS_EQUAL;
}

/* Chunks from first to last - 1. */
static void draw_flakes(chunk_flakes *s, const canvas *c, int first, int last)
{
    s->mesh.chunks = s->chunk + first;
    s->mesh.chunk_count = last - first;
    CHECK_INT(shade_draw_mesh(&c->target, &s->mesh, &s->state, NULL), SHADE_OK);
}

TEST(chunks, a_triangle_in_several_chunks_is_blended_as_often)
{
    static chunk_flakes s;
    for (int round = 0; round < 200; round++) {
        const shade_format format = rnd_one_in(2) ? rnd_format() : SHADE_FORMAT_RGBA32F;
        const int with_depth = rnd_one_in(2);
        canvas together = canvas_ready(24, 18, 0, format, with_depth);
        canvas apart = canvas_ready(24, 18, 0, format, with_depth);
        random_flakes(&s);
        draw_flakes(&s, &together, 0, FLAKE_CHUNKS);
        for (int k = 0; k < FLAKE_CHUNKS; k++) draw_flakes(&s, &apart, k, k + 1);
        CHECK_SAY(canvas_same(&together, &apart), "round %d", round);
        canvas_close(&together);
        canvas_close(&apart);
    }
}

/* The one that is seen comes last or first; every fifth is empty and not counted as skipped. */
TEST(chunks, thousands_out_of_sight_come_before_the_one_that_is_seen)
{
    static chunk_squares s;
    shade_stats stats;
    for (int behind = 0; behind < 2; behind++) {
        open_squares(&s);
        for (int k = 0; k < 4000; k++) {
            if (k == (behind ? 0 : 3999)) continue;
            s.chunk[k] = s.chunk[k % 4];
            s.chunk[k].low.z = s.chunk[k].high.z = behind && k % 3 ? -3.0f : 3.0f;
            if (k % 5 == 4) s.chunk[k].count = 0;
        }
        if (!behind) s.chunk[3999] = s.chunk[0];
        s.chunk[behind ? 0 : 3999].low.z = s.chunk[behind ? 0 : 3999].high.z = 0;
        s.chunk[behind ? 0 : 3999].count = 2;
        s.mesh.chunk_count = 4000;
        CHECK_INT(draw_squares(&s, &stats), 1000);
        CHECK_INT(stats.skipped, 2 * (3999 - 800 + !behind));
        CHECK_INT(stats.triangles, stats.skipped + 2);
    }
}

/* ------------------------------------------------------------------------------- making chunks */

enum { CHUNK_GUARD = 4 };

/* A mesh of many triangles, and room for its chunks between guards. */
typedef struct chunk_maker {
    shade_vec3 *position;
    uint32_t *index, *sorted;
    shade_chunk *chunk;
    int triangles;
    shade_mesh mesh;
} chunk_maker;

static void *chunk_room(size_t bytes)
{
    void *room = test_memory(bytes + 1);
    memset(room, CANVAS_BYTE, bytes);
    return room;
}

static chunk_maker open_maker(int triangles)
{
    chunk_maker m;
    const size_t corners = 3 * (size_t)triangles;
    m.triangles = triangles;
    m.position = (shade_vec3 *)chunk_room(corners * sizeof *m.position);
    m.index = (uint32_t *)chunk_room(corners * 4);
    m.sorted = (uint32_t *)chunk_room((corners + 2 * CHUNK_GUARD) * 4);
    m.chunk = (shade_chunk *)chunk_room(((size_t)triangles + 2 * CHUNK_GUARD) * sizeof *m.chunk);
    for (size_t k = 0; k < corners; k++) m.index[k] = (uint32_t)k;
    m.mesh = plain_mesh(&m.position[0].x, 3 * triangles);
    return m;
}

static void close_maker(chunk_maker *m)
{
    free(m->position);
    free(m->index);
    free(m->sorted);
    free(m->chunk);
}

/* Makes chunks into the guarded room; nothing beside it changes. */
static int make_chunks(chunk_maker *m, int triangles, int sort)
{
    const size_t corners = (size_t)chunk_corners(&m->mesh);
    const int count = shade_chunk_count((int)corners, triangles);
    memset(m->sorted, CANVAS_BYTE, (corners + 2 * CHUNK_GUARD) * 4);
    memset(m->chunk, CANVAS_BYTE, ((size_t)m->triangles + 2 * CHUNK_GUARD) * sizeof *m->chunk);
    CHECK_INT(shade_mesh_chunks(&m->mesh, triangles, m->chunk + CHUNK_GUARD, count,
                                sort ? m->sorted + CHUNK_GUARD : NULL),
              SHADE_OK);
    CHECK(untouched(m->chunk, CHUNK_GUARD * sizeof *m->chunk));
    CHECK(untouched(m->chunk + CHUNK_GUARD + count, CHUNK_GUARD * sizeof *m->chunk));
    CHECK(untouched(m->sorted, CHUNK_GUARD * 4));
    CHECK(untouched(m->sorted + CHUNK_GUARD + (sort ? corners : 0), CHUNK_GUARD * 4));
    return count;
}

/* Runs of the list, one after the other, all but the last of the size that was asked for, each in
   the box of its finite corners, to the bit. */
static void check_made(const chunk_maker *m, const shade_mesh *mesh, int count, int size)
{
    int first = 0;
    for (int i = 0; i < count; i++) {
        const shade_chunk *c = m->chunk + CHUNK_GUARD + i;
        float low[3] = { FLT_MAX, FLT_MAX, FLT_MAX }, high[3] = { -FLT_MAX, -FLT_MAX, -FLT_MAX };
        CHECK_INT(c->first, first);
        CHECK(i < count - 1 ? c->count == size : c->count >= 1 && c->count <= size);
        for (int k = 3 * c->first; k < 3 * (c->first + c->count); k++) {
            const shade_vec3 p = chunk_corner(mesh, k);
            if (!isfinite(p.x) || !isfinite(p.y) || !isfinite(p.z)) continue;
            for (int axis = 0; axis < 3; axis++) {
                low[axis] = fminf(low[axis], coordinate(p, axis));
                high[axis] = fmaxf(high[axis], coordinate(p, axis));
            }
        }
        for (int axis = 0; axis < 3; axis++) {
            CHECK(coordinate(c->low, axis) == low[axis]);
            CHECK(coordinate(c->high, axis) == high[axis]);
        }
        first += c->count;
    }
    CHECK_INT(3 * first, chunk_corners(mesh));
}

static int compare_triangles(const void *a, const void *b) { return memcmp(a, b, 12); }

/* The sorted list has the triangles of the mesh, each with its corners in their order. */
static void check_sorted(const chunk_maker *m)
{
    const int corners = chunk_corners(&m->mesh);
    uint32_t *own = (uint32_t *)chunk_room((size_t)corners * 4);
    uint32_t *sorted = (uint32_t *)chunk_room((size_t)corners * 4);
    for (int k = 0; k < corners; k++) own[k] = m->mesh.indices ? m->mesh.indices[k] : (uint32_t)k;
    memcpy(sorted, m->sorted + CHUNK_GUARD, (size_t)corners * 4);
    qsort(own, (size_t)corners / 3, 12, compare_triangles);
    qsort(sorted, (size_t)corners / 3, 12, compare_triangles);
    CHECK(!memcmp(own, sorted, (size_t)corners * 4));
    free(own);
    free(sorted);
}

static void check_maker(chunk_maker *m, int size)
{
    const int count = make_chunks(m, size, 0);
    shade_mesh sorted = m->mesh;
    check_made(m, &m->mesh, count, size ? size : 128);
    CHECK_INT(make_chunks(m, size, 1), count);
    sorted.indices = m->sorted + CHUNK_GUARD;
    sorted.index_count = chunk_corners(&m->mesh);
    check_made(m, &sorted, count, size ? size : 128);
    check_sorted(m);
}

/* Sizes from the default to more than there are triangles; positions may be NaN or infinite. */
TEST(chunks, runs_tile_the_list_in_boxes_of_their_corners)
{
    static const int sizes[8] = { 0, 1, 2, 3, 7, 64, 1000, INT32_MAX };
    for (int i = 0; i < 300; i++) {
        chunk_maker m = open_maker(rnd_int(1, 200));
        const int corners = 3 * m.triangles, nasty = rnd_one_in(3);
        for (int k = 0; k < corners; k++) {
            m.position[k] = random_vector(1);
            if (nasty && rnd_one_in(9)) m.position[k].x = rnd_nasty();
            if (nasty && rnd_one_in(9)) m.position[k].z = rnd_nasty();
            m.index[k] = (uint32_t)rnd_int(0, corners - 1);
        }
        if (rnd_one_in(2)) m.mesh.indices = m.index;
        m.mesh.index_count = 3 * rnd_int(1, m.triangles);
        check_maker(&m, sizes[rnd_int(0, 7)]);
        close_maker(&m);
    }
}

TEST(chunks, counts_are_those_of_whole_chunks_and_a_rest)
{
    for (int triangles = 0; triangles < 40; triangles++)
        for (int size = 1; size < 45; size++) {
            CHECK_INT(shade_chunk_count(3 * triangles, size), (triangles + size - 1) / size);
            CHECK_INT(shade_chunk_count(3 * triangles + 1, size), 0);
            CHECK_INT(shade_chunk_count(-3 * triangles, size), 0);
        }
    CHECK_INT(shade_chunk_count(3 * 129, 0), 2);
    CHECK_INT(shade_chunk_count(3 * 128, 0), 1);
    CHECK_INT(shade_chunk_count(12, -1), 0);
    CHECK_INT(shade_chunk_count(INT32_MAX - 1, 1), (INT32_MAX - 1) / 3);
    CHECK_INT(shade_chunk_count(INT32_MAX - 1, INT32_MAX), 1);
    CHECK_INT(shade_chunk_count(INT32_MIN, 1), 0);
}

/* Each mistake alone, and with those that are looked for later. */
/* G2 */
TEST(chunks, bad_arguments_change_nothing_and_are_told_in_their_order)
{
    chunk_maker m = open_maker(9);
    shade_chunk *room = m.chunk + CHUNK_GUARD;
    for (int k = 0; k < 27; k++) m.position[k] = random_vector(1);
    for (int mistakes = 1; mistakes < 16; mistakes++) {
        for (int kind = 0; kind < 4; kind++) {
            shade_mesh mesh = m.mesh;
            uint32_t *sorted = kind & 1 ? m.sorted + CHUNK_GUARD : NULL;
            int size = 2, capacity = mistakes & 8 ? 4 : 5;
            shade_result want = SHADE_ERROR_CAPACITY;
            mesh.indices = m.index;
            mesh.index_count = 27;
            if (mistakes & 4) {
                want = SHADE_ERROR_INDEX;
                if (kind < 2) mesh.index_count = 26;
                else m.index[rnd_int(0, 25)] = 27;
            }
            if (mistakes & 2) {
                want = SHADE_ERROR_MESH;
                if (kind < 2) mesh.position_stride = -12;
                else mesh.positions = NULL;
            }
            if (mistakes & 1) {
                want = SHADE_ERROR_ARGUMENT;
                if (kind < 2) size = -1;
                else capacity = -1;
            }
            CHECK_INT(shade_mesh_chunks(&mesh, size, room, capacity, sorted), want);
            CHECK(untouched(m.chunk, (9 + 2 * CHUNK_GUARD) * sizeof *m.chunk));
            CHECK(untouched(m.sorted, (27 + 2 * CHUNK_GUARD) * 4));
            for (int k = 0; k < 27; k++) m.index[k] = (uint32_t)k;
        }
    }
    close_maker(&m);
}

TEST(chunks, without_mesh_or_room_nothing_is_made_and_no_vertex_makes_no_chunk)
{
    chunk_maker m = open_maker(9);
    shade_chunk *room = m.chunk + CHUNK_GUARD;
    for (int k = 0; k < 27; k++) m.position[k] = random_vector(1);
    CHECK_INT(shade_mesh_chunks(NULL, 2, room, 5, NULL), SHADE_ERROR_ARGUMENT);
    CHECK_INT(shade_mesh_chunks(&m.mesh, 2, NULL, 5, NULL), SHADE_ERROR_ARGUMENT);
    CHECK_INT(shade_mesh_chunks(&m.mesh, 2, NULL, 0, NULL), SHADE_ERROR_CAPACITY);
    m.mesh.vertex_count = 26;
    CHECK_INT(shade_mesh_chunks(&m.mesh, 2, room, 5, NULL), SHADE_ERROR_INDEX);
    m.mesh.vertex_count = 0;
    CHECK_INT(shade_mesh_chunks(&m.mesh, 2, NULL, 0, m.sorted), SHADE_OK);
    CHECK(untouched(m.chunk, (9 + 2 * CHUNK_GUARD) * sizeof *m.chunk));
    CHECK(untouched(m.sorted, (27 + 2 * CHUNK_GUARD) * 4));
    close_maker(&m);
}

static float spread_value(int kind, int triangle)
{
    switch (kind) {
    case 0: return 1;
    case 1: return triangle % 2 ? 1 : -1;
    case 2: return bits_float((uint32_t)rnd_int(0, 0x7FFFFF));         /* denormal */
    case 3: return rnd_one_in(2) ? INFINITY : -INFINITY;
    case 4: return (float)NAN;
    case 5: return (float)(rnd_sign() * rnd_log(1e-37, 1e38));         /* any exponent */
    case 6: return rnd_nasty();
    case 7: return bits_float((uint32_t)triangle * 65521u);            /* any bits */
    case 8: return (float)triangle;                                    /* in order */
    case 9: return -(float)triangle;
    case 10: return rnd_one_in(1000) ? 1e38f : rnd_float(0, 1e-30);    /* few far away */
    default: return (float)(triangle % 3 - 1) * 0.0f;
    }
}

/* Were the time to grow with the square, this would take some minutes for each kind. */
TEST(chunks, no_numbers_take_long_to_sort)
{
    chunk_maker m = open_maker(30000);
    for (int kind = 0; kind < 12; kind++) {
        for (int k = 0; k < 3 * m.triangles; k++) {
            const float x = spread_value(kind, k / 3);
            m.position[k] = shade_v3(x, kind & 1 ? x : 0, 0);
        }
        check_maker(&m, 1 + kind % 3);
    }
    close_maker(&m);
}

/* What a view looks at: half the surface of the boxes. */
static double sum_of_boxes(const shade_chunk *c, int count)
{
    double sum = 0;
    for (int i = 0; i < count; i++) {
        const d3 s = d3_sub(d3_from(c[i].high), d3_from(c[i].low));
        sum += s.x * s.y + s.y * s.z + s.z * s.x;
    }
    return sum;
}

static void shuffle_triangles(chunk_maker *m)
{
    for (int t = m->triangles - 1; t > 0; t--) {
        const int other = rnd_int(0, t);
        for (int k = 0; k < 3; k++) {
            const uint32_t index = m->index[3 * t + k];
            m->index[3 * t + k] = m->index[3 * other + k];
            m->index[3 * other + k] = index;
        }
    }
    m->mesh.indices = m->index;
    m->mesh.index_count = 3 * m->triangles;
}

/* A sheet of 64 x 64 squares, shuffled: its 64 chunks of 128 triangles are at best squares of 8 x 8
   that see (1/8)^2 each.  Sorting makes them as small as that, but for what hangs over an edge. */
TEST(chunks, a_shuffled_sheet_is_sorted_into_squares)
{
    chunk_maker m = open_maker(64 * 64 * 2);
    double shuffled, sorted;
    for (int k = 0; k < 3 * m.triangles; k++) {
        static const int corner[6][2] = { { 0, 0 }, { 1, 0 }, { 1, 1 },
                                          { 0, 0 }, { 1, 1 }, { 0, 1 } };
        const int cell = k / 6;
        m.position[k] = shade_v3(0, (float)(cell % 64 + corner[k % 6][0]) / 64,
                                 (float)(cell / 64 + corner[k % 6][1]) / 64);
    }
    shuffle_triangles(&m);
    shuffled = sum_of_boxes(m.chunk + CHUNK_GUARD, make_chunks(&m, 128, 0));
    sorted = sum_of_boxes(m.chunk + CHUNK_GUARD, make_chunks(&m, 128, 1));
    CHECK_SAY(shuffled > 50 && sorted < 1.3, "%g shuffled, %g sorted", shuffled, sorted);
    sorted = sum_of_boxes(m.chunk + CHUNK_GUARD, make_chunks(&m, 100, 1));
    CHECK_SAY(sorted < 1.5, "%g sorted, by splits that are no halves", sorted);
    close_maker(&m);
}

/* Two places that only the last bit tells apart. */
TEST(chunks, neighbouring_floats_are_sorted_apart)
{
    chunk_maker m = open_maker(64);
    for (int axis = 0; axis < 3; axis++) {
        for (int k = 0; k < 3 * m.triangles; k++) {
            const float at = bits_float(0xBF800000u + (uint32_t)(k / 3 % 2));
            m.position[k] = with_axis(shade_v3(0, 0, 0), axis, at);
        }
        CHECK_INT(make_chunks(&m, 32, 1), 2);
        for (int i = 0; i < 2; i++)
            CHECK(coordinate(m.chunk[CHUNK_GUARD + i].low, axis) ==
                  coordinate(m.chunk[CHUNK_GUARD + i].high, axis));
    }
    close_maker(&m);
}

/* Crumbs in a cube: 64 chunks of it see at best 3/16 each, 12 together. */
TEST(chunks, shuffled_crumbs_are_sorted_into_cubes)
{
    chunk_maker m = open_maker(64 * 100);
    double shuffled, sorted;
    for (int t = 0; t < m.triangles; t++) {
        const shade_vec3 at = shade_v3(rnd_float(-1, 0), rnd_float(0, 1), rnd_float(2, 3));
        for (int k = 0; k < 3; k++)
            m.position[3 * t + k] = shade_add(at, random_vector(1e-3));
    }
    shuffled = sum_of_boxes(m.chunk + CHUNK_GUARD, make_chunks(&m, 100, 0));
    sorted = sum_of_boxes(m.chunk + CHUNK_GUARD, make_chunks(&m, 100, 1));
    CHECK_SAY(shuffled > 150 && sorted < 13, "%g shuffled, %g sorted", shuffled, sorted);
    close_maker(&m);
}

/* ------------------------------------------------------------------------------------- picking */

typedef struct chunk_pick {
    int triangle;
    float t;
    shade_vec3 b;
} chunk_pick;
static chunk_pick pick_with(const shade_mesh *mesh, const shade_chunk *chunks, int count,
                            shade_mat4 model, shade_ray ray)
{
    shade_mesh m = *mesh;
    m.chunks = chunks;
    m.chunk_count = count;
    chunk_pick p = { .t = -7 };
    p.triangle = shade_pick(&m, model, ray, &p.t, &p.b);
    return p;
}

/* Models that turn, mirror, flatten, shear, project; huge and tiny ones, and some of no numbers. */
static shade_mat4 random_pick_model(void)
{
    const float huge = (float)pow(10, rnd_int(-30, 30));
    shade_vec3 scale = shade_v3(rnd_sign() * rnd_log(0.1, 9), rnd_log(0.1, 9), rnd_log(0.1, 9));
    shade_mat4 m = shade_mat4_identity();
    switch (rnd_int(0, 7)) {
    case 0: return m;
    case 1: m = shade_mat4_scaling(scale); break;
    case 2: m = shade_mat4_scaling(with_axis(scale, rnd_int(0, 2), 0)); break;
    case 3: m = shade_mat4_scaling(shade_v3(huge, huge, huge)); break;
    case 4: return wild_matrix(2);
    case 5: m = wild_matrix(2); break;
    default: memset(&m, 0, sizeof m); return m;
    }
    m.col[0].w = m.col[1].w = m.col[2].w = 0;
    m.col[3].w = 1;
    if (rnd_one_in(2))
        m = shade_mat4_mul(shade_mat4_rotation(rnd_float(-3, 3), d3_round(rnd_direction())), m);
    if (rnd_one_in(2)) {
        const float far = rnd_sign() * rnd_log(0.1, 1e6);    /* where positions are rounded most */
        const shade_vec3 along = with_axis(shade_v3(0, 0, 0), rnd_int(0, 2), far);
        const shade_vec3 to = rnd_one_in(2) ? along : random_vector((double)far);
        m.col[3] = shade_v4(to.x, to.y, to.z, 1);
    }
    return m;
}

/* Rays at a point of a triangle, through corners of boxes, along axes and in the plane of a
   triangle but for rounding. */
static shade_ray random_pick_ray(const chunk_scene *s, shade_mat4 model)
{
    const int corners = chunk_corners(&s->mesh), t = rnd_int(0, corners / 3 - 1);
    const shade_chunk *box = &s->chunk[rnd_int(0, s->mesh.chunk_count - 1)];
    shade_vec3 p[3], at, from;
    shade_ray ray;
    float u = rnd_float(0, 1), v = rnd_float(0, 1 - (double)u);
    for (int k = 0; k < 3; k++)
        p[k] = shade_mat4_transform_point(chunk_matrix(model), chunk_corner(&s->mesh, 3 * t + k));
    at = shade_madd(shade_madd(p[0], u, shade_sub(p[1], p[0])), v, shade_sub(p[2], p[0]));
    from = shade_madd(at, rnd_log(0.01, 100), random_vector((double)shade_distance(p[0], p[1])));
    if (rnd_one_in(4)) from = shade_madd(at, rnd_float(-3, 3), shade_sub(p[1], p[2]));
    if (rnd_one_in(8))
        at = shade_mat4_transform_point(chunk_matrix(model), rnd_one_in(2) ? box->low : box->high);
    ray.origin = from;
    ray.direction = shade_scale(shade_sub(at, from), rnd_log(0.01, 10));
    if (rnd_one_in(2)) ray.direction = shade_normalize(ray.direction);
    if (rnd_one_in(6)) { /* along an axis, from beside the point: other components are 0 */
        const int axis = rnd_int(0, 2);
        ray.origin = with_axis(at, axis, coordinate(from, axis));
        ray.direction = with_axis(shade_v3(0, 0, 0), axis,
                                  coordinate(shade_sub(at, from), axis));
        if (rnd_one_in(3)) ray.direction = with_axis(ray.direction, (axis + 1) % 3, -0.0f);
    }
    if (rnd_one_in(20)) ray.direction = with_axis(ray.direction, rnd_int(0, 2), rnd_nasty());
    return ray;
}

static void check_same_pick(chunk_pick got, chunk_pick want, int triangle)
{
    CHECK_INT(got.triangle, triangle);
    CHECK(float_bits(got.t) == float_bits(want.t));
    CHECK(!memcmp(&got.b, &want.b, sizeof got.b));
}

/* In their own order, in any order of the chunks, and sorted.  Equal triangles lie in the mesh
   twice, so that ties are met; the sorted list has others for them, but the same hit. */
/* G13 */
TEST(chunks, rays_meet_the_same_triangle_with_chunks_and_without)
{
    static chunk_scene s;
    static shade_chunk list[CHUNK_MOST];
    long hits = 0;
    for (int i = 0; i < 300; i++) {
        const shade_mat4 model = random_pick_model();
        random_chunk_scene(&s);
        for (int n = 0; n < 20; n++)
            memcpy(s.index + 3 * rnd_int(0, CHUNK_TRIANGLES - 1),
                   s.index + 3 * rnd_int(0, CHUNK_TRIANGLES - 1), 3 * sizeof *s.index);
        random_chunk_list(&s, rnd_int(1, 30));
        const int count = s.mesh.chunk_count;
        memcpy(list, s.chunk, sizeof list);
        for (int k = count - 1; k > 0; k--) {
            const int other = rnd_int(0, k);
            const shade_chunk c = list[k];
            list[k] = list[other];
            list[other] = c;
        }
        for (int n = 0; n < 12; n++) {
            const shade_ray ray = random_pick_ray(&s, model);
            const chunk_pick want = pick_with(&s.mesh, NULL, 0, model, ray);
            check_same_pick(pick_with(&s.mesh, s.chunk, count, model, ray), want, want.triangle);
            check_same_pick(pick_with(&s.mesh, list, count, model, ray), want, want.triangle);
            hits += want.triangle >= 0;
        }
        sort_chunk_scene(&s);
        random_chunk_list(&s, rnd_int(1, 30));
        for (int n = 0; n < 12; n++) {
            const shade_ray ray = random_pick_ray(&s, model);
            const chunk_pick want = pick_with(&s.mesh, NULL, 0, model, ray);
            check_same_pick(pick_with(&s.mesh, s.chunk, s.mesh.chunk_count, model, ray), want,
                            want.triangle);
        }
    }
    CHECK_SAY(hits > 1000, "%ld hits", hits);
}

/* Beside long double: chunks lose nothing that is surely met, at any scale. */
TEST(chunks, picks_through_chunks_are_the_nearest_triangles_of_all)
{
    static pick_scene s;
    static shade_chunk chunk[PICK_TRIANGLES];
    long hits = 0, misses = 0;
    for (int i = 0; i < 200; i++) {
        const double size = (double)rnd_log(1e-3, 1e3);
        random_pick_scene(&s, size);
        const int per = rnd_int(1, 9), count = shade_chunk_count(3 * pick_triangles(&s), per);
        CHECK_INT(shade_mesh_chunks(&s.mesh, per, chunk, PICK_TRIANGLES, NULL), SHADE_OK);
        for (int n = 0; n < 15; n++) {
            const d3 aim = d3_scale(rnd_direction(), size * rnd_unit());
            const d3 o = d3_scale(rnd_direction(), size * (double)rnd_log(0.1, 5));
            shade_ray ray;
            double t, b[3] = { 0, 0, 0 };
            ray.origin = d3_round(o);
            ray.direction = d3_round(d3_scale(d3_sub(aim, o), (double)rnd_log(0.01, 10) / size));
            const int want = ref_pick(&s, &ray, 3e-4, &t, b);
            if (want == -2) continue;
            CHECK_INT(pick_with(&s.mesh, chunk, count, s.model, ray).triangle, want);
            hits += want >= 0;
            misses += want < 0;
        }
    }
    CHECK_SAY(hits > 300 && misses > 100, "%ld hits, %ld misses", hits, misses);
}

/* The nearest of all triangles, each met by shade_intersect where the model puts it, projective
   models among them; -2: a ray so nearly in the plane of one that rounding decides, or a distance
   below FLT_MIN, of which floats keep few digits, in directions as long as 1e38. */
static int intersect_all(const shade_mesh *mesh, shade_mat4 model, shade_ray ray)
{
    int found = -1;
    float nearest = INFINITY, t;
    for (int n = 0; n < chunk_corners(mesh) / 3; n++) {
        shade_vec3 p[3];
        for (int k = 0; k < 3; k++)
            p[k] = shade_mat4_transform_point(chunk_matrix(model), chunk_corner(mesh, 3 * n + k));
        const d3 e = d3_sub(d3_from(p[1]), d3_from(p[0]));
        const d3 f = d3_sub(d3_from(p[2]), d3_from(p[0]));
        const d3 normal = d3_cross(e, f), direction = d3_from(ray.direction);
        const double size = d3_length(e) * d3_length(f) * d3_length(direction);
        const d3 q = d3_from(chunk_corner(mesh, 3 * n));
        const d3 own = d3_cross(d3_sub(d3_from(chunk_corner(mesh, 3 * n + 1)), q),
                                d3_sub(d3_from(chunk_corner(mesh, 3 * n + 2)), q));
        if (own.x == 0 && own.y == 0 && own.z == 0) continue; /* a line is never hit */
        if (!shade_intersect(ray, p[0], p[1], p[2], &t, NULL)) continue;
        if (!(fabs(d3_dot(normal, direction)) > 1e-5 * size) || t < FLT_MIN) return -2;
        if (t < nearest) found = n;
        nearest = fminf(t, nearest);
    }
    return found;
}

/* The oracle meets every triangle without regard to boxes; where two distances are too near to
   each other it has no answer. */
TEST(chunks, picks_are_the_nearest_intersection_under_any_model)
{
    static chunk_scene s;
    long hits = 0;
    for (int i = 0; i < 300; i++) {
        const shade_mat4 model = random_pick_model();
        random_chunk_scene(&s);
        random_chunk_list(&s, rnd_int(1, 30));
        for (int n = 0; n < 6; n++) {
            const shade_ray ray = random_pick_ray(&s, model);
            const int want = intersect_all(&s.mesh, model, ray);
            if (want == -2) continue;
            CHECK_INT(shade_pick(&s.mesh, model, ray, NULL, NULL), want);
            hits += want >= 0;
        }
    }
    CHECK_SAY(hits > 300, "%ld hits", hits);
}

/* t is 0 for all of them, so that no chunk is behind another. */
TEST(chunks, a_ray_that_starts_on_triangles_picks_the_lowest)
{
    static const float corner[] = { -1, -1, 0, 1, -1, 0, 0, 1, 0 };
    float p[45] = { 0 };
    shade_mesh m = plain_mesh(p, 15);
    shade_chunk chunk[5], back[5];
    const shade_ray ray = { { 0, 0, 0 }, { 0.5f, 0, -1 } };
    for (int k = 0; k < 5; k++) memcpy(p + 9 * k, corner, sizeof corner);
    CHECK_INT(shade_mesh_chunks(&m, 1, chunk, 5, NULL), SHADE_OK);
    for (int k = 0; k < 5; k++) back[k] = chunk[4 - k];
    for (int count = 1; count <= 5; count++) {
        const chunk_pick got = pick_with(&m, back, count, shade_mat4_identity(), ray);
        CHECK_INT(got.triangle, 5 - count);
        CHECK_NEAR(got.t, 0, 0);
        CHECK_INT(pick_with(&m, chunk, count, shade_mat4_identity(), ray).triangle, 0);
    }
}

/* Down to where positions in world space are denormal and round by a thousandth of themselves. */
TEST(chunks, boxes_of_any_scale_are_met)
{
    static const float p[] = { -1, -1, 0.7f, 1, -1, 0.7f, 0, 1, 0.7f };
    const shade_mesh m = plain_mesh(p, 3);
    shade_chunk chunk;
    CHECK_INT(shade_mesh_chunks(&m, 0, &chunk, 1, NULL), SHADE_OK);
    for (int e = -42; e <= 37; e++) {
        const float scale = (float)pow(10, e);
        const shade_ray ray = { { 0, 0, 2 * scale }, { 0, 0, -1 } };
        const chunk_pick got =
            pick_with(&m, &chunk, 1, shade_mat4_scaling(shade_v3(scale, scale, scale)), ray);
        CHECK_INT(got.triangle, 0);
        CHECK_NEAR(got.t, 1.3 * (double)scale, 1e-6 * (double)scale + 3e-45);
    }
}

TEST(chunks, bad_indices_are_found_where_their_box_is_met)
{
    static const float p[] = { -1, -1, 0, 1, -1, 0, 0, 1, 0 };
    uint32_t index[9] = { 0, 1, 2, 0, 1, 2, 0, 1, 2 };
    shade_mesh m = plain_mesh(p, 3);
    shade_chunk chunk[3];
    shade_ray ray = { { 0, 0, 4 }, { 0, 0, -1 } };
    m.indices = index;
    m.index_count = 9;
    CHECK_INT(shade_mesh_chunks(&m, 1, chunk, 3, NULL), SHADE_OK);
    index[rnd_int(3, 5)] = 3;
    CHECK_INT(pick_with(&m, chunk, 3, shade_mat4_identity(), ray).triangle, -1);
    CHECK_INT(pick_with(&m, NULL, 0, shade_mat4_identity(), ray).triangle, -1);
    chunk[1].low.x = chunk[1].high.x = 5; /* not met: not looked at */
    CHECK_INT(pick_with(&m, chunk, 3, shade_mat4_identity(), ray).triangle, 0);
    CHECK_INT(pick_with(&m, chunk + 2, 1, shade_mat4_identity(), ray).triangle, 2);
    CHECK_INT(pick_with(&m, chunk, 0, shade_mat4_identity(), ray).triangle, -1);
    chunk[0] = chunk[2]; /* in the list twice, and triangle 0 left out */
    CHECK_INT(pick_with(&m, chunk, 3, shade_mat4_identity(), ray).triangle, 2);
    ray.direction = shade_v3(0, 0, 0);
    CHECK_INT(pick_with(&m, chunk, 1, shade_mat4_identity(), ray).triangle, -1);
    m.index_count = 8;
    CHECK_INT(pick_with(&m, chunk, 1, shade_mat4_identity(), ray).triangle, -1);
}
