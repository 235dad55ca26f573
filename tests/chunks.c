/* chunks.c - boxes around runs of triangles: nothing that they skip could have been seen, or met by
   a ray. */

enum {
    CHUNK_VERTICES = 150,
    CHUNK_TRIANGLES = 200,
    CHUNK_MOST = 2 * CHUNK_TRIANGLES + 64 /* of a list with empty ones */
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
static float chunk_coordinate(shade_vec3 p, int axis)
{
    return axis == 0 ? p.x : axis == 1 ? p.y : p.z;
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
    for (int t = 0; t < CHUNK_TRIANGLES; t++) {
        const int near = rnd_int(0, CHUNK_VERTICES - 17);
        uint32_t *corner = s->index + 3 * t;
        for (int k = 0; k < 3; k++) corner[k] = (uint32_t)rnd_int(0, CHUNK_VERTICES - 1);
        if (kind == 0 && t % 2) continue;
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
    int count = 0, first = 0;
    CHECK_INT(shade_mesh_chunks(&s->mesh, 1, single, CHUNK_TRIANGLES, NULL), SHADE_OK);
    while (first < triangles) {
        shade_chunk *c = &s->chunk[count++];
        memset(c, 0, sizeof *c);
        c->first = first;
        if (rnd_one_in(3) && count < CHUNK_TRIANGLES) continue; /* empty */
        c->low = single[first].low;
        c->high = single[first].high;
        for (c->count = 1; c->count < rnd_int(1, sizes) && first + c->count < triangles; c->count++) {
            c->low = shade_min(c->low, single[first + c->count].low);
            c->high = shade_max(c->high, single[first + c->count].high);
        }
        first += c->count;
    }
    for (int n = rnd_one_in(2) ? 40 : 0; n > 0; n--) {
        memset(&s->chunk[count], 0, sizeof s->chunk[count]);
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
    if (!rnd_one_in(5)) state->view = shade_mat4_look_at(d3_round(eye), random_vector(0.3 * size),
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
    static const shade_material material = { { 0.1f, 0, 0 }, { 0.2f, 0.2f, 0.2f }, { 0.5f, 0.6f, 1 },
                                             { 0.4f, 0.4f, 0.4f }, 9 };
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
    state->raster.blend = (shade_blend)rnd_int(0, 2);
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
    shade_stats sum;
    memset(&sum, 0, sizeof sum);
    for (int i = 0; i < 250; i++) {
        random_chunk_scene(&s);
        if (sorted) sort_chunk_scene(&s);
        random_chunk_list(&s, rnd_one_in(3) ? 1 : rnd_int(1, 60));
        check_chunk_picture(&s, rnd_one_in(3) ? rnd_format() : SHADE_FORMAT_RGBA32F, &sum);
    }
    CHECK_SAY(sum.skipped > 5000 && sum.drawn > 5000 && sum.fragments > 50000,
              "%lld skipped, %lld drawn, %lld fragments", sum.skipped, sum.drawn, sum.fragments);
}
TEST(chunks, pictures_have_the_same_bits_with_chunks_and_without) { check_chunk_pictures(0); }
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
TEST(chunks, bands_with_chunks_together_make_the_picture_without) { check_chunk_parts(0); }
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
   one by more than a hundred thousandth of the numbers that enter, -1 in between. */
static int ref_box_visible(const shade_target *t, double m[4][4], int zero_to_one,
                           shade_vec3 low, shade_vec3 high)
{
    int answer = 1;
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
                sum += (fabs(m[row][c]) + fabs(m[3][c])) * fabs(in[c]);
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
    t->clip_y = rnd_int(t->row_offset, t->row_offset + (t->row_count ? t->row_count : t->height) - 1);
    t->clip_width = rnd_one_in(3) ? 1 : rnd_int(1, t->width);
    t->clip_height = rnd_one_in(3) ? 1 : rnd_int(1, t->height);
}
static shade_mat4 chunk_matrix(shade_mat4 m)
{
    return dmat_max(dmat_from(m)) == 0 ? shade_mat4_identity() : m;
}
/* Cameras, and matrices whose depth lets w come as near to 0 as it likes, for objects of that
   size. */
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
    return shade_mat4_mul(m, shade_mat4_scaling(shade_v3(scale, scale, scale)));
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
    shade_draw_state state;
    shade_stats stats;
    memset(&state, 0, sizeof state);
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
    for (int i = 0; i < 150000; i++) {
        const double size = (double)rnd_log(1e-6, 1e6);
        const int n = rnd_one_in(2) ? rnd_int(4, 5) : rnd_int(0, 3);
        double rows[4][4], plane[4], point[4];
        shade_vec3 p[3], low, high;
        shade_target t;
        int zero_to_one, want, got;
        const shade_mat4 m = random_chunk_matrix(&zero_to_one, size);
        memset(&t, 0, sizeof t);
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
    CHECK_SAY(touching > 3000 && by_rounding > 100 && hidden > 1000,
              "%ld touch a pixel, %ld by rounding, %ld hidden", touching, by_rounding, hidden);
}
/* Where products are below the least float, rounding is no part of their size: z/w >= 0 for all the
   least negative z. */
TEST(chunks, depths_that_underflow_are_not_hidden)
{
    static const shade_vec3 p[3] = { { -1, -1, -1e-20f }, { 1, -1, -2e-20f }, { 0, 1, -1e-20f } };
    static uint32_t pixels[64];
    shade_target t;
    memset(&t, 0, sizeof t);
    t.width = t.height = 8;
    t.color = pixels;
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

static shade_vec3 with_axis(shade_vec3 p, int axis, float value)
{
    if (axis == 0) p.x = value;
    if (axis == 1) p.y = value;
    if (axis == 2) p.z = value;
    return p;
}
TEST(chunks, a_box_of_no_numbers_or_the_wrong_way_round_is_visible)
{
    static uint32_t pixels[64];
    const shade_vec3 low = shade_v3(5, 5, 5), high = shade_v3(6, 6, 6);
    const shade_mat4 one = shade_mat4_identity();
    shade_target t, bad;
    memset(&t, 0, sizeof t);
    t.width = t.height = 8;
    t.color = pixels;
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
    shade_mat4 zero;
    shade_target t;
    memset(&t, 0, sizeof t);
    memset(&zero, 0, sizeof zero);
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
    shade_target t;
    memset(&t, 0, sizeof t);
    t.width = t.height = SIDE;
    t.color = pixels;
    for (int i = 0; i < 4000; i++) {
        const int x = rnd_int(0, SIDE - 1), y = rnd_int(0, SIDE - 1);
        const float left = (float)(2 * (x + 0.1) / SIDE - 1), right = (float)(2 * (x + 0.9) / SIDE - 1);
        const float top = (float)(1 - 2 * (y + 0.1) / SIDE), bottom = (float)(1 - 2 * (y + 0.9) / SIDE);
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
    shade_draw_state state;
    shade_target t;
    int count;
    memset(&state, 0, sizeof state);
    memset(&t, 0, sizeof t);
    t.width = t.height = 8;
    t.color = pixels;
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
        { 1, INT32_MAX, INT32_MAX, SHADE_ERROR_MESH }, { 1, INT32_MIN, INT32_MIN, SHADE_ERROR_MESH },
    };
    shade_vec3 p[6] = { { -1, -1, 0 }, { 1, -1, 0 }, { 0, 1, 0 }, { 1, 1, 0 } };
    const shade_ray ray = { { 0, 0, 4 }, { 0, 0, -1 } };
    for (int i = 0; i < 2 * (int)(sizeof list / sizeof list[0]); i++) {
        const int k = i / 2;
        shade_chunk chunk[2];
        shade_mesh m = plain_mesh(&p[0].x, 6);
        if (i & 1) m.indices = index, m.index_count = 6;
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
        static const int corner[6][2] = { { 0, 0 }, { 1, 0 }, { 1, 1 }, { 0, 0 }, { 1, 1 }, { 0, 1 } };
        s->p[k] = shade_v3((float)(k / 6 + corner[k % 6][0]) / 2 - 1, 2 * (float)corner[k % 6][1] - 1,
                           0);
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
    canvas c = canvas_open(4, 2, 0, SHADE_FORMAT_RGBA32F, 0);
    int digits = 0;
    canvas_clear(&c, 1);
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

static const test_case chunks_cases[] = {
    CASE(chunks, pictures_have_the_same_bits_with_chunks_and_without),
    CASE(chunks, sorted_meshes_have_the_same_bits_with_chunks_and_without),
    CASE(chunks, bands_with_chunks_together_make_the_picture_without),
    CASE(chunks, strips_with_chunks_together_make_the_picture_without),
    CASE(chunks, a_triangle_that_touches_a_pixel_is_visible_in_its_box),
    CASE(chunks, depths_that_underflow_are_not_hidden),
    CASE(chunks, a_box_of_no_numbers_or_the_wrong_way_round_is_visible),
    CASE(chunks, a_zero_matrix_is_the_identity),
    CASE(chunks, a_box_is_visible_in_the_rectangles_that_have_its_pixels),
    CASE(chunks, lists_that_do_not_fit_the_mesh_are_refused_by_every_call),
    CASE(chunks, exactly_the_triangles_of_the_list_are_drawn),
    CASE(chunks, thousands_out_of_sight_come_before_the_one_that_is_seen),
};
