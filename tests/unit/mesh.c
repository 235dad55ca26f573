/* mesh.c - whole meshes: shade_draw_mesh against an oracle that evaluates the equation of light
   pixel by pixel in double precision, and vertex normals. */
#include "unit.h"

typedef struct mesh_oracle {
    dmat model, normals, clip;
    d3 eye;       /* in world space, or the direction toward the viewer */
    double bound; /* the greatest bound met while a pixel was made */
    int unsure;
} mesh_oracle;

static mesh_oracle mesh_oracle_of(const test_mesh *m)
{
    dmat view = matrix_or_identity(m->state.view), inverse;
    mesh_oracle o = { .model = matrix_or_identity(m->state.model) };
    o.normals = dmat_normals(o.model);
    o.clip = dmat_mul(matrix_or_identity(m->state.projection), dmat_mul(view, o.model));
    dmat_invert(view, 4, &inverse);
    int infinite = (m->state.lighting.flags & SHADE_FLAG_INFINITE_VIEWER) != 0;
    o.eye =
        infinite ? dmat_direction(inverse, d3_of(0, 0, 1)) : dmat_point(inverse, d3_of(0, 0, 0));
    return o;
}

static d3 mesh_light(mesh_oracle *o, const test_mesh *m, d3 P, d3 N, d3 albedo)
{
    ref_lit lit = ref_light(&m->state.lighting, m->state.material, P, N, o->eye, albedo);
    o->unsure |= lit.unsure;
    o->bound = fmax(o->bound, lit.bound);
    return lit.total;
}

/* The colour of triangle t at barycentric b. */
static d3 mesh_color(mesh_oracle *o, const test_mesh *m, int t, const double b[3])
{
    d3 P[3], N[3], albedo[3], sum_p = d3_of(0, 0, 0), sum_n = sum_p, sum_a = sum_p, sum_lit = sum_p;
    for (int k = 0; k < 3; k++) {
        uint32_t v = m->indices[3 * t + k];
        P[k] = dmat_point(o->model, d3_from(m->position[v]));
        N[k] = d3_unit(dmat_direction(o->normals, d3_from(m->normal[v])));
        albedo[k] = m->mesh.colors ? d3_from(m->color[v]) : d3_of(1, 1, 1);
    }
    d3 flat = d3_unit(d3_cross(d3_sub(P[1], P[0]), d3_sub(P[2], P[0])));
    for (int k = 0; k < 3; k++) {
        if (!m->mesh.normals) N[k] = flat;
        sum_p = d3_add(sum_p, d3_scale(P[k], b[k]));
        sum_n = d3_add(sum_n, d3_scale(N[k], b[k]));
        sum_a = d3_add(sum_a, d3_scale(albedo[k], b[k]));
    }
    if (m->state.shading == SHADE_SHADING_PER_FRAGMENT)
        return mesh_light(o, m, sum_p, sum_n, sum_a);
    if (m->state.shading == SHADE_SHADING_PER_FACE) {
        d3 centroid = d3_scale(d3_add(P[0], d3_add(P[1], P[2])), 1.0 / 3);
        return mesh_light(o, m, centroid, flat, albedo[0]);
    }
    for (int k = 0; k < 3; k++)
        sum_lit = d3_add(sum_lit, d3_scale(mesh_light(o, m, P[k], N[k], albedo[k]), b[k]));
    return sum_lit;
}

static d3 mesh_pixel(mesh_oracle *o, const test_mesh *m, const ref_triangle *e, int t, double X,
                     double Y)
{
    double b[3];
    ref_barycentric(e, X, Y, b);
    o->bound = 0;
    return mesh_color(o, m, t, b);
}

/* The triangles of a mesh on the screen, for its oracle. */
typedef struct mesh_screen {
    ref_triangle e[MESH_INDICES / 3];
    int usable[MESH_INDICES / 3], triangles;
} mesh_screen;

static void mesh_screen_of(mesh_screen *screen, const mesh_oracle *o, const test_mesh *m,
                           const shade_target *target)
{
    screen->triangles = m->mesh.index_count / 3;
    for (int t = 0; t < screen->triangles; t++) {
        shade_vec4 corner[3];
        for (int k = 0; k < 3; k++) {
            shade_vec3 p = m->position[m->indices[3 * t + k]];
            double in[4] = { (double)p.x, (double)p.y, (double)p.z, 1 }, out[4];
            dmat_apply(o->clip, in, out);
            corner[k] = shade_v4((float)out[0], (float)out[1], (float)out[2], (float)out[3]);
        }
        screen->usable[t] = ref_triangle_of(&screen->e[t], &corner[0], &corner[1], &corner[2],
                                            target->width, target->height);
    }
}

/* The nearest triangle at a place: NOTHING where there is none, IN_DOUBT near an edge and where two
   depths are nearer to each other than they are exact. */
enum { NOTHING = -1, IN_DOUBT = -2 };
static int mesh_winner(const mesh_screen *screen, double X, double Y)
{
    double nearest = 1, second = 1;
    int winner = NOTHING;
    for (int t = 0; t < screen->triangles; t++) {
        int in = screen->usable[t] ? ref_covers(&screen->e[t], X, Y, 0.02, 0, 0) : 0;
        if (in < 0) return IN_DOUBT;
        if (in == 0) continue;
        double z = ref_depth(&screen->e[t], X, Y, 0);
        if (z < nearest) {
            second = nearest;
            nearest = z;
            winner = t;
        } else {
            second = fmin(second, z);
        }
    }
    return second - nearest < 1e-4 ? IN_DOUBT : winner;
}

/* Holds a pixel to the colour of its triangle; returns 0 where that is too steep to be held to. */
static int check_mesh_pixel(const canvas *c, mesh_oracle *o, const test_mesh *m,
                            const ref_triangle *e, int winner, int at)
{
    const int x = at % c->target.width, y = at / c->target.width;
    const double X = x + 0.5, Y = y + 0.5;
    o->unsure = 0;
    d3 want = mesh_pixel(o, m, e, winner, X, Y);
    if (o->unsure) return 0;
    /* beyond the bound of light: rounding of N and P in the planes, and what 1/256 pixel of
       snapping moves */
    double bound = o->bound, moved = 0;
    for (int k = 0; k < 4; k++) {
        double sx = (k == 0) - (k == 1), sy = (k == 2) - (k == 3);
        d3 beside = mesh_pixel(o, m, e, winner, X + sx / 256, Y + sy / 256);
        moved = fmax(moved, d3_max(d3_sub(beside, want)));
    }
    if (o->unsure || moved > 0.05 * fmax(1, d3_max(want))) return 0;
    shade_vec3 got = shade_v3(canvas_float(c, x, y, 0), canvas_float(c, x, y, 1),
                              canvas_float(c, x, y, 2));
    moved += bound + fmax(1, d3_max(want)) * 1e-4;
    if (!check_color(__LINE__, "pixel", got, want, moved) &&
        test_now.failures <= TEST_MAX_PRINTED) {
        printf("    pixel %d %d, triangle %d, shading %d, model %d, flags %u, normals %d\n", x, y,
               winner, (int)m->state.shading, (int)m->state.lighting.model,
               m->state.lighting.flags, m->mesh.normals != NULL);
    }
    CHECK_NEAR(canvas_float(c, x, y, 3), 1, 0);
    return 1;
}

/* Holds every pixel whose triangle is beyond doubt to the oracle; returns how many there were. */
static int check_mesh(const canvas *c, const test_mesh *m)
{
    static mesh_screen screen;
    mesh_oracle o = mesh_oracle_of(m);
    int checked = 0, width = c->target.width;
    mesh_screen_of(&screen, &o, m, &c->target);
    ref_margin = 2e-3;
    for (int at = 0; at < width * c->target.height; at++) {
        int winner = mesh_winner(&screen, at % width + 0.5, at / width + 0.5);
        if (winner == IN_DOUBT) continue;
        if (winner == NOTHING) {
            CHECK_NEAR(canvas_float(c, at % width, at / width, 3), 0, 0);
        } else {
            checked += check_mesh_pixel(c, &o, m, &screen.e[winner], winner, at);
        }
    }
    ref_margin = 1e-5;
    return checked;
}

static void check_meshes(shade_shading shading, int mirrored)
{
    static test_mesh m;
    int checked = 0;
    for (int i = 0; i < 40; i++) {
        canvas c = canvas_ready(64, 48, 65, SHADE_FORMAT_RGBA32F, 1);
        random_mesh_scene(&m, shading, mirrored);
        shade_stats stats = canvas_draw_mesh(&c, &m.mesh, &m.state);
        CHECK_SAY(stats_add_up(&stats, m.mesh.index_count / 3), "%lld triangles", stats.triangles);
        checked += check_mesh(&c, &m);
        canvas_close(&c);
    }
    CHECK_SAY(checked > 8000, "%d pixels checked", checked);
}

TEST(mesh, per_fragment_is_the_equation_at_every_pixel)
{
    check_meshes(SHADE_SHADING_PER_FRAGMENT, 0);
}

TEST(mesh, per_vertex_interpolates_the_light_of_the_corners)
{
    check_meshes(SHADE_SHADING_PER_VERTEX, 0);
}

TEST(mesh, per_face_is_lit_once_at_the_centroid)
{
    check_meshes(SHADE_SHADING_PER_FACE, 0);
}

TEST(mesh, mirrored_models_keep_their_given_normals)
{
    check_meshes(SHADE_SHADING_PER_FRAGMENT, 1);
}

TEST(mesh, models_of_any_scale_have_the_same_light) /* to the bit, for powers of 2 */
{
    static const float p[] = { -0.9f, -0.9f, 0, 0.9f, -0.8f, 0.3f, 0, 0.9f, -0.2f };
    static const float n[] = { 0.2f, -0.1f, 1, 0.1f, 0.6f, 0.4f, -0.7f, 0.2f, 2 };
    const shade_light lamp = shade_directional_light(shade_v3(0.2f, -0.3f, -1), shade_v3(1, 1, 1));
    shade_mesh mesh = plain_mesh(p, 3);
    mesh.normals = n;
    for (int i = 0; i < 2 * 91; i++) {
        canvas picture[2];
        for (int k = 0; k < 2; k++) {
            const float size = k ? (float)ldexp(1, i / 2 - 50) : 1, x = i % 2 ? -size : size;
            shade_draw_state s = plain_state(&lamp);
            s.model = shade_mat4_scaling(shade_v3(x, size, size));
            s.projection = shade_mat4_scaling(shade_v3(1 / x, 1 / size, 1 / size));
            s.lighting.flags = SHADE_FLAG_INFINITE_VIEWER;
            picture[k] = canvas_ready(24, 24, 0, SHADE_FORMAT_RGBA8, 1);
            canvas_draw_mesh(&picture[k], &mesh, &s);
        }
        CHECK(canvas_code(&picture[0], 12, 12, 0) > 100);
        CHECK_SAY(canvas_same(&picture[0], &picture[1]), "2^%d, mirrored %d", i / 2 - 50, i % 2);
        canvas_close(&picture[0]);
        canvas_close(&picture[1]);
    }
}

TEST(mesh, faces_of_distant_light_and_viewer_have_one_colour) /* to the bit */
{
    shade_material material = teapot_brass();
    for (int i = 0; i < 300; i++) {
        float p[9];
        for (int k = 0; k < 9; k++) p[k] = rnd_float(-1, 1);
        shade_light light = shade_directional_light(d3_round(rnd_direction()), random_color(2));
        shade_draw_state s = plain_state(&light);
        shade_mesh mesh = plain_mesh(p, 3);
        s.material = &material;
        s.shading = i % 2 ? SHADE_SHADING_PER_FACE : SHADE_SHADING_PER_FRAGMENT;
        s.lighting.flags = SHADE_FLAG_INFINITE_VIEWER | (i % 3 ? SHADE_FLAG_TWO_SIDED : 0);
        s.view = shade_mat4_look_at(shade_v3(0.2f, 0.1f, 3), shade_v3(0, 0, 0), shade_v3(0, 1, 0));
        s.projection = shade_mat4_perspective(0.8f, 1, 0.1f, 10);
        canvas c = canvas_ready(64, 64, 0, SHADE_FORMAT_RGBA32F, 1);
        canvas_draw_mesh(&c, &mesh, &s);
        float first[4] = { 0, 0, 0, 0 };
        for (int k = 0; k < 64 * 64; k++) {
            if (canvas_float(&c, k % 64, k / 64, 3) == 0) continue;
            for (int j = 0; j < 3; j++) {
                float v = canvas_float(&c, k % 64, k / 64, j);
                if (first[3] == 0) first[j] = v;
                /* per face: lit once; per fragment: N is interpolated, so to rounding */
                CHECK_NEAR(v, first[j], i % 2 ? 0 : 1e-4);
            }
            first[3] = 1;
        }
        canvas_close(&c);
    }
}

TEST(mesh, per_face_takes_the_colour_of_the_first_vertex)
{
    static const float color[] = { 1, 0.5f, 0.25f, 0, 1, 0, 0, 0, 1 };
    shade_light light = shade_directional_light(shade_v3(0, 0, -1), grey(1));
    shade_draw_state s = plain_state(&light);
    shade_mesh mesh = plain_mesh(big_triangle, 3);
    static const uint32_t turned[] = { 1, 2, 0 };
    mesh.colors = color;
    s.shading = SHADE_SHADING_PER_FACE;
    for (int turn = 0; turn < 2; turn++) {
        canvas c = canvas_ready(20, 20, 0, SHADE_FORMAT_RGBA32F, 0);
        if (turn) {
            mesh.indices = turned;
            mesh.index_count = 3;
        }
        canvas_draw_mesh(&c, &mesh, &s);
        for (int j = 0; j < 3; j++)
            CHECK_NEAR(canvas_float(&c, 10, 12, j), color[3 * turn + j], 1e-6);
        canvas_close(&c);
    }
}

/* One triangle, a lamp close before its middle and a shininess of 80: the highlight is far from
   all corners. */
TEST(mesh, gouraud_misses_the_highlight_that_phong_finds)
{
    shade_light light = shade_point_light(shade_v3(0, -0.2f, 0.5f), grey(1));
    shade_material m = { .specular = grey(1), .shininess = 80 };
    shade_draw_state s = plain_state(&light);
    shade_mesh mesh = plain_mesh(big_triangle, 3);
    s.material = &m;
    s.view = shade_mat4_look_at(shade_v3(0, -0.2f, 3), shade_v3(0, -0.2f, 0), shade_v3(0, 1, 0));
    s.projection = shade_mat4_perspective(0.8f, 1, 0.1f, 10);
    double most[2] = { 0, 0 };
    for (int k = 0; k < 2; k++) {
        canvas c = canvas_ready(64, 64, 0, SHADE_FORMAT_RGBA32F, 1);
        s.shading = k ? SHADE_SHADING_PER_VERTEX : SHADE_SHADING_PER_FRAGMENT;
        canvas_draw_mesh(&c, &mesh, &s);
        for (int i = 0; i < 64 * 64; i++)
            most[k] = fmax(most[k], (double)canvas_float(&c, i % 64, i / 64, 0));
        canvas_close(&c);
    }
    CHECK_SAY(most[0] > 0.95 && most[1] < 0.2, "Phong %g, Gouraud %g", most[0], most[1]);
}

TEST(mesh, light_between_gouraud_vertices_is_not_clamped) /* a corner of 3 beside corners of 0 */
{
    static const float normal[] = { 0, 0, 1, 0, 0, -1, 0, 0, -1 };
    shade_light light = shade_directional_light(shade_v3(0, 0, -1), grey(3));
    shade_draw_state s = plain_state(&light);
    shade_mesh mesh = plain_mesh(big_triangle, 3);
    mesh.normals = normal;
    s.shading = SHADE_SHADING_PER_VERTEX;
    canvas c = canvas_ready(200, 200, 0, SHADE_FORMAT_RGBA32F, 0);
    canvas_draw_mesh(&c, &mesh, &s);
    shade_vec4 corner[3];
    ref_triangle t;
    for (int k = 0; k < 3; k++)
        corner[k] = shade_v4(big_triangle[3 * k], big_triangle[3 * k + 1], 0, 1);
    CHECK(ref_triangle_of(&t, &corner[0], &corner[1], &corner[2], 200, 200));
    int bright = 0;
    for (int i = 0; i < 200 * 200; i++) {
        if (canvas_float(&c, i % 200, i / 200, 3) == 0) continue;
        double want = ref_interpolate(&t, i % 200 + 0.5, i / 200 + 0.5, 3, 0, 0);
        CHECK_NEAR(canvas_float(&c, i % 200, i / 200, 1), want, 2e-4);
        bright += want > 1.5;
    }
    CHECK(bright > 100);
    canvas_close(&c);
}

TEST(mesh, every_layout_of_the_same_mesh_gives_the_same_bits)
{
    static test_mesh m;
    for (int i = 0; i < 30; i++) {
        canvas c[2];
        canvas_twins(c, 64, 48, SHADE_FORMAT_RGBA32F, 1);
        random_mesh_scene(&m, (shade_shading)(i % 3), 0);
        static float texcoord[MESH_VERTICES * 2];
        canvas_draw_mesh(&c[0], &m.mesh, &m.state);
        if (i % 2) {
            lay_out_mesh(&m, m.mesh.vertex_count, m.mesh.normals != NULL, m.mesh.colors != NULL);
            m.mesh.texcoords = texcoord;
            m.mesh.texcoord_stride = 8;
        } else { /* unrolled: vertices in threes without indices */
            static shade_vec3 p[MESH_INDICES], n[MESH_INDICES], color[MESH_INDICES];
            for (int k = 0; k < m.mesh.index_count; k++) {
                uint32_t v = m.indices[k];
                p[k] = m.position[v];
                n[k] = m.normal[v];
                color[k] = m.color[v];
            }
            m.mesh.positions = &p[0].x;
            m.mesh.position_stride = 0;
            m.mesh.normals = m.mesh.normals ? &n[0].x : NULL;
            m.mesh.normal_stride = 12;
            m.mesh.colors = m.mesh.colors ? &color[0].x : NULL;
            m.mesh.color_stride = 0;
            m.mesh.vertex_count = m.mesh.index_count;
            m.mesh.indices = NULL;
            m.mesh.index_count = 0;
        }
        canvas_draw_mesh(&c[1], &m.mesh, &m.state);
        canvas_twins_close(c);
    }
}

/* The light falls at a cosine of 0.8 upon a triangle whose normal is z: 0.8 of (0.5, 1, 2), and
   0.1 of ambient red. */
TEST(mesh, zero_matrices_and_no_material_mean_identity_and_white_lambert)
{
    shade_light light = shade_directional_light(shade_v3(0, -0.6f, -0.8f), shade_v3(0.5f, 1, 2));
    shade_draw_state s = plain_state(&light);
    shade_mesh mesh = plain_mesh(big_triangle, 3);
    s.lighting.ambient = shade_v3(0.1f, 0, 0);
    canvas c = canvas_ready(20, 20, 0, SHADE_FORMAT_RGBA32F, 1);
    shade_stats stats = canvas_draw_mesh(&c, &mesh, &s);
    CHECK_INT(stats.drawn, 1);
    CHECK_NEAR(canvas_float(&c, 10, 12, 0), 0.5, 1e-5);
    CHECK_NEAR(canvas_float(&c, 10, 12, 1), 0.8, 1e-5);
    CHECK_NEAR(canvas_float(&c, 10, 12, 2), 1.6, 1e-5);
    CHECK_NEAR(canvas_float(&c, 10, 12, 3), 1, 0);
    CHECK_NEAR(canvas_depth(&c, 10, 12), 0.5, 1e-6);
    canvas_close(&c);
}

/* A permutation of x, y, z, w whose first column has its one in a row of choice. */
static shade_mat4 permutation(int first)
{
    shade_mat4 m;
    for (int k = 0; k < 4; k++) {
        float column[4] = { 0, 0, 0, 0 };
        column[(first + k) % 4] = 1;
        m.col[k] = shade_v4(column[0], column[1], column[2], column[3]);
    }
    return m;
}

/* Three corners that such a matrix takes into view. */
static void permuted_corners(int first, float out[9])
{
    static const float seen[3][4] = { { 0.1f, 0.2f, 0.5f, 1 },
                                      { 0.9f, 0.3f, 0.5f, 1 },
                                      { 0.4f, 0.8f, 0.5f, 1 } };
    for (int k = 0; k < 9; k++) {
        const float *p = seen[k / 3];
        out[k] = p[(first + k % 3) % 4] / p[(first + 3) % 4];
    }
}

/* A matrix is the identity only where all of its sixteen numbers are 0: columns that begin with
   zeros are no sign of it. */
TEST(mesh, matrices_that_begin_with_zeros_are_used)
{
    shade_draw_state s = plain_state(NULL);
    s.lighting.ambient = grey(0.25);
    for (int first = 0; first < 4; first++) { /* the row of the one in the first column */
        canvas c[2];
        float moved[9];
        shade_mat4 m = permutation(first);
        canvas_twins(c, 20, 20, SHADE_FORMAT_RGBA32F, 1);
        permuted_corners(first, moved);
        shade_mesh turned = plain_mesh(moved, 3);
        s.projection = m;
        shade_stats stats = canvas_draw_mesh(&c[0], &turned, &s);
        CHECK(stats.fragments > 10);
        shade_vec4 clip[3];
        scene plain = { 0 };
        for (int k = 0; k < 3; k++) {
            clip[k] = shade_mat4_transform(
                m, shade_v4(moved[3 * k], moved[3 * k + 1], moved[3 * k + 2], 1));
        }
        shade_vec4 color = shade_v4(0.25f, 0.25f, 0.25f, 1);
        plain.clip = clip;
        plain.color = &color;
        shade_pipeline p = scene_pipeline(&plain);
        canvas_draw(&c[1], &p, 3);
        canvas_twins_close(c);
    }
}

TEST(mesh, a_mesh_of_nothing_needs_no_positions)
{
    canvas c = canvas_open(20, 20, 0, SHADE_FORMAT_RGBA8, 1);
    shade_draw_state s = plain_state(NULL);
    shade_mesh mesh = plain_mesh(NULL, 0);
    shade_stats stats;
    shade_vec3 normal;
    stats = canvas_draw_mesh(&c, &mesh, &s);
    CHECK_INT(stats.triangles, 0);
    CHECK_INT(shade_mesh_normals(&mesh, &normal), SHADE_OK);
    mesh.vertex_count = 3;
    CHECK_INT(shade_draw_mesh(&c.target, &mesh, &s, &stats), SHADE_ERROR_MESH);
    CHECK_INT(shade_mesh_normals(&mesh, &normal), SHADE_ERROR_MESH);
    canvas_close(&c);
}

TEST(mesh, the_state_of_the_pipeline_is_handed_on)
{
    shade_draw_state s = plain_state(NULL);
    shade_mesh mesh = plain_mesh(big_triangle, 3);
    s.lighting.ambient = grey(0.25);
    canvas c = canvas_open(20, 20, 0, SHADE_FORMAT_RGBA32F, 1);
    canvas_clear(&c, 0.5f);
    shade_stats stats = canvas_draw_mesh(&c, &mesh, &s);
    CHECK_INT(stats.fragments, 0); /* at the same depth: LESS fails */
    s.raster.depth_test = SHADE_COMPARE_LESS_EQUAL;
    s.raster.blend = SHADE_BLEND_ADD;
    for (int k = 0; k < 3; k++) (void)canvas_draw_mesh(&c, &mesh, &s);
    CHECK_NEAR(canvas_float(&c, 10, 12, 0), 0.75, 1e-6);
    s.raster.depth_bias = 0.25f;
    stats = canvas_draw_mesh(&c, &mesh, &s);
    CHECK_INT(stats.fragments, 0);
    s.raster.depth_bias = -0.25f;
    s.raster.depth_read_only = 1;
    (void)canvas_draw_mesh(&c, &mesh, &s);
    CHECK_NEAR(canvas_depth(&c, 10, 12), 0.5, 0);
    s.raster.depth_read_only = 0;
    (void)canvas_draw_mesh(&c, &mesh, &s);
    CHECK_NEAR(canvas_depth(&c, 10, 12), 0.25, 1e-6);
    s.raster.cull = SHADE_CULL_FRONT;
    s.raster.depth_test = SHADE_COMPARE_ALWAYS;
    stats = canvas_draw_mesh(&c, &mesh, &s);
    CHECK_INT(stats.culled, 1);
    s.raster.cull = SHADE_CULL_BACK;
    s.raster.depth_zero_to_one = 1;
    s.raster.depth_bias = 0;
    stats = canvas_draw_mesh(&c, &mesh, &s);
    CHECK_INT(stats.drawn, 1);
    CHECK_NEAR(canvas_depth(&c, 10, 12), 0, 1e-6);
    canvas_close(&c);
}

TEST(mesh, a_nan_in_a_matrix_rejects_every_triangle)
{
    shade_mesh mesh = plain_mesh(big_triangle, 3);
    for (int k = 0; k < 3; k++) {
        shade_draw_state s = plain_state(NULL);
        shade_mat4 *m = k == 0 ? &s.model : k == 1 ? &s.view : &s.projection;
        *m = shade_mat4_identity();
        m->col[1].x = (float)NAN;
        canvas c = canvas_ready(20, 20, 0, SHADE_FORMAT_RGBA8, 1);
        shade_stats stats = canvas_draw_mesh(&c, &mesh, &s);
        CHECK_INT(stats.rejected, 1);
        CHECK_INT(stats.fragments, 0);
        canvas_close(&c);
    }
}

TEST(mesh, nan_in_light_or_material_colours_pixels_and_stores_as_zero)
{
    shade_light light = shade_directional_light(shade_v3(0, 0, -1), shade_v3((float)NAN, 1, 1));
    shade_material m = teapot_brass();
    m.specular = grey(0);
    m.emission.z = (float)NAN;
    shade_draw_state s = plain_state(&light);
    shade_mesh mesh = plain_mesh(big_triangle, 3);
    s.material = &m;
    for (int shading = 0; shading < 3; shading++) {
        canvas c = canvas_open(20, 20, 0, SHADE_FORMAT_RGBA8, 1);
        s.shading = (shade_shading)shading;
        CHECK_INT(shade_clear(&c.target, shade_v4(1, 1, 1, 0), 1), SHADE_OK);
        canvas_draw_mesh(&c, &mesh, &s);
        CHECK_INT(canvas_bytes(&c, 10, 12)[0], 0);
        CHECK_INT(canvas_bytes(&c, 10, 12)[1], 145); /* k_d .568627 of 255 */
        CHECK_INT(canvas_bytes(&c, 10, 12)[2], 0);
        CHECK_INT(canvas_bytes(&c, 10, 12)[3], 255);
        canvas_close(&c);
    }
}

/* What shade_draw_mesh is given: three corners, with normals, colours and coordinates. */
typedef struct mesh_call {
    shade_mesh m;
    shade_draw_state s;
    int bad_index; /* 1: the indices are 0, 1, 3 */
} mesh_call;

#define MESH_FAULT(field, value) FAULT(mesh_call, m.field, value)
#define STATE_FAULT(field, value) FAULT(mesh_call, s.field, value)
#define BAD_INDEX FAULT(mesh_call, bad_index, 1)
static const refusal bad_mesh_calls[] = {
    { SHADE_ERROR_MESH, { FAULT_NULL(mesh_call, m.positions) } },
    { SHADE_ERROR_MESH, { MESH_FAULT(position_stride, -12) } },
    { SHADE_ERROR_MESH, { MESH_FAULT(position_stride, 13) } },
    { SHADE_ERROR_MESH, { MESH_FAULT(normal_stride, -4) } },
    { SHADE_ERROR_MESH, { MESH_FAULT(normal_stride, 2) } },
    { SHADE_ERROR_MESH, { MESH_FAULT(color_stride, 15) } },
    { SHADE_ERROR_MESH, { MESH_FAULT(color_stride, -12) } },
    { SHADE_ERROR_MESH, { MESH_FAULT(texcoord_stride, 7) } },
    { SHADE_ERROR_MESH, { MESH_FAULT(texcoord_stride, -8) } },
    { SHADE_ERROR_MESH, { MESH_FAULT(index_count, -3) } },
    { SHADE_ERROR_MESH, { FAULT_NULL(mesh_call, m.indices), MESH_FAULT(vertex_count, -3) } },
    { SHADE_ERROR_LIGHTS, { FAULT_NULL(mesh_call, s.lighting.lights) } },
    { SHADE_ERROR_LIGHTS, { STATE_FAULT(lighting.model, 6) } },
    { SHADE_ERROR_STATE, { STATE_FAULT(shading, 3) } },
    { SHADE_ERROR_STATE, { STATE_FAULT(raster.cull, 3) } },
    { SHADE_ERROR_STATE, { STATE_FAULT(raster.depth_test, 6) } },
    { SHADE_ERROR_STATE, { STATE_FAULT(raster.blend, 3) } },
    { SHADE_ERROR_STATE, { FAULT_REAL(mesh_call, s.raster.depth_bias, NAN) } },
    { SHADE_ERROR_INDEX, { BAD_INDEX } },
    { SHADE_ERROR_INDEX, { MESH_FAULT(vertex_count, 2) } },
    { SHADE_ERROR_INDEX, { MESH_FAULT(vertex_count, 0) } },
    { SHADE_ERROR_INDEX, { MESH_FAULT(index_count, 2) } },
    { SHADE_ERROR_INDEX, { FAULT_NULL(mesh_call, m.indices), MESH_FAULT(vertex_count, 2) } },
    { SHADE_ERROR_STATE, { BAD_INDEX, STATE_FAULT(shading, 3) } }, /* the state before indices */
};

/* G2 */
TEST(mesh, bad_meshes_and_states_are_refused_before_a_pixel_changes)
{
    static const uint32_t good_indices[] = { 0, 1, 2 }, bad_indices[] = { 0, 1, 3 };
    shade_light light = shade_directional_light(shade_v3(0, 0, -1), grey(1));
    canvas c = canvas_ready(20, 20, 0, SHADE_FORMAT_RGBA8, 1);
    mesh_call good = { plain_mesh(big_triangle, 3), plain_state(&light), 0 };
    good.m.normals = good.m.colors = good.m.texcoords = big_triangle;
    good.m.indices = good_indices;
    good.m.index_count = 3;
    CHECK_INT(shade_draw_mesh(NULL, &good.m, &good.s, NULL), SHADE_ERROR_ARGUMENT);
    CHECK_INT(shade_draw_mesh(&c.target, NULL, &good.s, NULL), SHADE_ERROR_ARGUMENT);
    CHECK_INT(shade_draw_mesh(&c.target, &good.m, NULL, NULL), SHADE_ERROR_ARGUMENT);

    for (int row = 0; row < TEST_COUNT(bad_mesh_calls); row++) {
        mesh_call bad = good;
        spoil(&bad, bad_mesh_calls[row].faults);
        if (bad.bad_index) bad.m.indices = bad_indices;
        shade_result got = shade_draw_mesh(&c.target, &bad.m, &bad.s, NULL);
        check_refusal(row, got, bad_mesh_calls[row].want);
        CHECK_INT(canvas_bytes(&c, 10, 12)[3], 0);
        CHECK_NEAR(canvas_depth(&c, 10, 12), 1, 0);
    }
    canvas_close(&c);
}

TEST(mesh, a_negative_number_of_lights_is_none_and_no_index_is_no_triangle)
{
    static const uint32_t indices[] = { 0, 1, 2 };
    shade_light light = shade_directional_light(shade_v3(0, 0, -1), grey(1));
    canvas c = canvas_ready(20, 20, 0, SHADE_FORMAT_RGBA8, 1);
    shade_mesh m = plain_mesh(big_triangle, 3);
    shade_draw_state s = plain_state(&light);
    m.indices = indices;
    s.lighting.light_count = -4;
    canvas_draw_mesh(&c, &m, &s);
    CHECK_INT(canvas_bytes(&c, 10, 12)[3], 0);
    m.index_count = 3;
    canvas_draw_mesh(&c, &m, &s);
    CHECK_INT(canvas_bytes(&c, 10, 12)[0], 0);
    CHECK_INT(canvas_bytes(&c, 10, 12)[3], 255);
    canvas_close(&c);
}

/* each of them, of every shading; the ends of the range are taken, also -0 */
TEST(mesh, transparency_and_cutoff_lie_between_zero_and_one)
{
    static const float bad[] = { -0.001f, 1.0000001f, -INFINITY, INFINITY, NAN, -NAN, -1, 2 };
    static const float good[] = { 0, -0.0f, 1, 0.5f };
    canvas c = canvas_open(20, 20, 0, SHADE_FORMAT_RGBA8, 1);
    shade_mesh m = plain_mesh(big_triangle, 3);
    for (int i = 0; i < 2 * 12; i++) {
        const int k = i / 2;
        shade_draw_state s = plain_state(NULL);
        float *field = i % 2 ? &s.transparency : &s.alpha_cutoff;
        shade_stats stats;
        s.shading = random_shading();
        *field = k < 8 ? bad[k] : good[k - 8];
        memset(&stats, CANVAS_BYTE, sizeof stats);
        CHECK_INT(shade_draw_mesh(&c.target, &m, &s, &stats), k < 8 ? SHADE_ERROR_STATE : SHADE_OK);
        CHECK_INT(stats.triangles, k >= 8);
        if (k < 8) CHECK(canvas_bytes(&c, 10, 12)[0] == CANVAS_BYTE);
    }
    canvas_close(&c);
}

/* One bad index, anywhere in lists that are checked in pieces; corners looked up by index or one
   by one. */
/* G2 */
TEST(mesh, a_bad_index_is_found_wherever_it_stands)
{
    static uint32_t list[600];
    for (int i = 0; i < 2000; i++) {
        int count = 3 * rnd_int(1, 200), at = rnd_int(0, count - 1);
        canvas c = canvas_open(8, 8, 0, SHADE_FORMAT_RGBA8, 0);
        shade_draw_state s = plain_state(NULL);
        shade_mesh m = plain_mesh(big_triangle, 3);
        shade_stats stats;
        for (int k = 0; k < count; k++) list[k] = (uint32_t)rnd_int(0, 2);
        s.shading = random_shading();
        m.normals = rnd_one_in(2) ? big_triangle : NULL;
        m.indices = list;
        m.index_count = count;
        if (i % 4 == 0) {
            stats = canvas_draw_mesh(&c, &m, &s);
            CHECK_INT(stats.triangles, count / 3);
        }
        memset(c.color, CANVAS_BYTE, c.color_bytes + 2 * CANVAS_GUARD);
        list[at] = i % 3 == 0 ? 0xFFFFFFFFu : i % 3 == 1 ? 0x80000000u : 3;
        CHECK_INT(shade_draw_mesh(&c.target, &m, &s, &stats), SHADE_ERROR_INDEX);
        CHECK_INT(stats.triangles, 0);
        for (size_t k = 0; k < c.color_bytes; k++) CHECK(c.color[CANVAS_GUARD + k] == CANVAS_BYTE);
        canvas_close(&c);
    }
}

/* z in [-1, 1] or [0, 1], forward or reversed; whatever model and view are. */
TEST(mesh, a_degenerate_camera_draws_nothing_in_any_depth_convention)
{
    static const float p[] = { -0.9f, -0.9f, 0.5f, 0.9f, -0.8f, 0.4f, 0, 0.9f, 0.6f,
                               0.8f,  0.9f,  0.1f, 0.9f, 0.2f,  0.9f, 0, 0.1f, 0.3f };
    shade_mesh mesh = plain_mesh(p, 6);
    long drawn = 0;
    for (int i = 0; i < DEGENERATE_CAMERAS * 24; i++) {
        int reversed = i / 2 % 2, nowhere = i % 6 != 5; /* or no camera at all: the identity */
        canvas c = canvas_open(20, 20, 0, SHADE_FORMAT_RGBA8, 1);
        shade_draw_state s = plain_state(NULL);
        shade_stats stats;
        if (nowhere) s.projection = degenerate_camera(i / 24);
        s.raster.depth_zero_to_one = i % 2;
        s.raster.depth_test = reversed ? SHADE_COMPARE_GREATER : SHADE_COMPARE_LESS;
        if (i % 3 == 0) s.raster.depth_test = SHADE_COMPARE_ALWAYS;
        s.shading = random_shading();
        if (nowhere && rnd_one_in(2))
            s.view = shade_mat4_look_at(random_vector(3), random_vector(1), shade_v3(0, 1, 0));
        if (rnd_one_in(2))
            s.model = shade_mat4_mul(shade_mat4_translation(shade_v3(0.05f, 0, 0)),
                                     shade_mat4_scaling(shade_v3(1, 1, 0.5f)));
        canvas_clear(&c, reversed ? 0.0f : 1.0f);
        canvas before = canvas_open(20, 20, 0, SHADE_FORMAT_RGBA8, 1);
        canvas_clear(&before, reversed ? 0.0f : 1.0f);
        stats = canvas_draw_mesh(&c, &mesh, &s);
        CHECK_INT(stats.triangles, 2);
        CHECK_INT(stats.clipped, nowhere ? 2 : 0);
        CHECK_SAY((stats.fragments == 0) == nowhere, "camera %d: %lld pixels", i / 24,
                  stats.fragments);
        CHECK(canvas_same(&c, &before) == nowhere);
        drawn += stats.fragments > 0;
        canvas_close(&c);
        canvas_close(&before);
    }
    CHECK_SAY(drawn == DEGENERATE_CAMERAS * 4, "%ld", drawn);
}

/* ---------------------------------------------------------------------------------------- alpha */

enum { ALPHA_W = 16, ALPHA_H = 12 };

/* A sloping sheet over the whole picture, a texel for each pixel: what the mesh, its colours and
   its map are at pixel (x, y) is known without drawing. */
typedef struct alpha_scene {
    shade_mesh mesh;
    shade_draw_state state;
    shade_material material;
    shade_texture map;
    float position[4][3], color[4][3], normal[4][3], texcoord[4][2];
    float texel[ALPHA_H][ALPHA_W][4];
    int needs; /* varyings */
} alpha_scene;

static const uint32_t alpha_corners[6] = { 0, 1, 2, 0, 2, 3 };

static d3 alpha_color(double x, double y) /* of the vertices, linear in between */
{
    return d3_of(0.5 + 0.3 * x, 0.5 - 0.2 * y, 0.4 + 0.1 * x + 0.1 * y);
}

static float random_alpha(void)
{
    static const float plain[] = { 0, 0.25f, 0.5f, 0.75f, 1, 0.125f };
    return rnd_one_in(3) ? rnd_float(0, 1) : plain[rnd_int(0, 5)];
}

static void random_alpha_scene(alpha_scene *s)
{
    static const float corner[4][2] = { { -1, -1 }, { 1, -1 }, { 1, 1 }, { -1, 1 } };
    memset(s, 0, sizeof *s);
    for (int k = 0; k < 4; k++) {
        double x = (double)corner[k][0], y = (double)corner[k][1];
        put3(s->position[k], shade_v3((float)x, (float)y, (float)(0.25 * x)));
        put3(s->normal[k], shade_v3(0, 0, 1));
        put3(s->color[k], d3_round(alpha_color(x, y)));
        s->texcoord[k][0] = (float)((x + 1) / 2);
        s->texcoord[k][1] = (float)((1 - y) / 2);
    }
    for (int k = 0; k < ALPHA_W * ALPHA_H; k++) {
        float *t = s->texel[k / ALPHA_W][k % ALPHA_W];
        for (int n = 0; n < 3; n++) t[n] = rnd_float(0, 1);
        t[3] = rnd_one_in(40) ? (float)NAN : random_alpha();
    }
    s->map.pixels = s->texel;
    s->map.width = ALPHA_W;
    s->map.height = ALPHA_H;
    s->map.format = SHADE_FORMAT_RGBA32F;
    s->map.filter = SHADE_FILTER_NEAREST;
    s->mesh.positions = s->position[0];
    s->mesh.vertex_count = 4;
    s->mesh.indices = alpha_corners;
    s->mesh.index_count = 6;
    if (rnd_one_in(2)) s->mesh.normals = s->normal[0];
    if (rnd_one_in(2)) s->mesh.colors = s->color[0];
    if (rnd_int(0, 3)) s->mesh.texcoords = s->texcoord[0];
    if (rnd_int(0, 3)) s->state.diffuse_map = &s->map;
    s->material.emission = random_color(0.25);
    s->material.ambient = random_color(1);
    s->state.material = &s->material;
    s->state.lighting.ambient = random_color(1);
    s->state.shading = (shade_shading)rnd_int(0, 2);
    s->state.raster.blend = (shade_blend)rnd_int(0, SHADE_BLEND_ADD);
    s->state.transparency = rnd_one_in(3) ? 0 : random_alpha();
    s->state.alpha_cutoff = rnd_one_in(3) ? 0 : random_alpha();
    int maps = s->mesh.texcoords && s->state.diffuse_map;
    s->needs = maps ? 8 : 3;
    if (s->state.shading == SHADE_SHADING_PER_FRAGMENT)
        s->needs = 6 + (s->mesh.colors ? 3 : 0) + (maps ? 2 : 0);
}

/* The colour at a pixel in rgb, its alpha. */
static double alpha_pixel(const alpha_scene *s, int x, int y, double rgb[3])
{
    const float *t = s->texel[y][x];
    int maps = s->mesh.texcoords && s->state.diffuse_map;
    double X = 2 * (x + 0.5) / ALPHA_W - 1, Y = 1 - 2 * (y + 0.5) / ALPHA_H;
    d3 albedo = d3_of(1, 1, 1), ke = d3_from(s->material.emission), lit;
    if (s->mesh.colors) albedo = alpha_color(X, Y);
    if (s->mesh.colors && s->state.shading == SHADE_SHADING_PER_FACE) albedo = alpha_color(-1, -1);
    if (maps) albedo = d3_mul(albedo, d3_of((double)t[0], (double)t[1], (double)t[2]));
    lit = d3_mul(d3_from(s->material.ambient), d3_from(s->state.lighting.ambient));
    lit = d3_add(ke, d3_mul(lit, albedo));
    rgb[0] = lit.x;
    rgb[1] = lit.y;
    rgb[2] = lit.z;
    return (1 - (double)s->state.transparency) * (maps ? (double)t[3] : 1);
}

static int alpha_is_cut(const alpha_scene *s, double alpha)
{
    return s->state.alpha_cutoff > 0 && !(alpha >= (double)s->state.alpha_cutoff);
}

static double alpha_blend(const alpha_scene *s, double c, double a, double d, int channel)
{
    if (s->state.raster.blend == SHADE_BLEND_REPLACE) return channel < 3 ? c : a;
    if (s->state.raster.blend == SHADE_BLEND_OVER)
        return channel < 3 ? c * a + d * (1 - a) : a + d * (1 - a);
    return channel < 3 ? c * a + d : a + d;
}

static double stored_channel(const canvas *c, int x, int y, int channel)
{
    if (c->target.format == SHADE_FORMAT_RGBA32F) return (double)canvas_float(c, x, y, channel);
    return canvas_bytes(c, x, y)[channel] / 255.0;
}

/* Holds the four channels of a pixel to the equation: rgb and alpha upon d, the stored background,
   or d alone where nothing is drawn. */
static void check_alpha_pixel(const canvas *c, const alpha_scene *s, int x, int y,
                              const double d[4], int seen)
{
    const int floats = c->target.format == SHADE_FORMAT_RGBA32F;
    double rgb[3], alpha = alpha_pixel(s, x, y, rgb), near = floats ? 2e-6 : 0.502 / 255;
    for (int n = 0; n < 4; n++) {
        double got = stored_channel(c, x, y, n);
        double want = alpha_blend(s, n < 3 ? rgb[n] : 0, alpha, d[n], n);
        if (!floats) want = fmax(0, fmin(1, want));
        if (!seen || !c->target.color) want = d[n];
        CHECK_SAY(fabs(got - want) <= near,
                  "channel %d: got %g, want %g; shading %d, blend %d, map %d, "
                  "transparency %g, cutoff %g, alpha %g",
                  n, got, want, (int)s->state.shading, (int)s->state.raster.blend,
                  s->state.diffuse_map != NULL, (double)s->state.transparency,
                  (double)s->state.alpha_cutoff, alpha);
    }
}

static double alpha_depth(int x) { return (0.25 * (2 * (x + 0.5) / ALPHA_W - 1) + 1) / 2; }

TEST(mesh, alpha_is_opacity_times_the_map_blended_stored_and_cut)
{
    static alpha_scene s;
    long refused = 0, cut = 0, blended[3] = { 0, 0, 0 }, equal = 0;
    for (int i = 0; i < 3000; i++) {
        shade_format format = rnd_one_in(2) ? SHADE_FORMAT_RGBA32F : SHADE_FORMAT_RGBA8;
        canvas c = canvas_open(ALPHA_W, ALPHA_H, 0, format, 1);
        float wall = rnd_one_in(3) ? 0.5f : 1; /* the left half is before 0.5 */
        shade_vec4 back = shade_v4(rnd_float(0, 1), rnd_float(0, 1), rnd_float(0, 1), 0.25f);
        shade_stats stats;
        long fragments = 0;
        random_alpha_scene(&s);
        CHECK_INT(shade_clear(&c.target, back, wall), SHADE_OK);
        double d[4];
        for (int n = 0; n < 4; n++) d[n] = stored_channel(&c, 0, 0, n);
        const int fits = s.needs <= SHADE_MAX_VARYINGS;
        const shade_result want = fits ? SHADE_OK : SHADE_ERROR_STATE;
        if (rnd_one_in(4)) c.target.color = NULL; /* depth alone */
        CHECK_INT(shade_draw_mesh(&c.target, &s.mesh, &s.state, &stats), want);
        refused += !fits;
        for (int k = 0; k < ALPHA_W * ALPHA_H; k++) {
            int x = k % ALPHA_W, y = k / ALPHA_W;
            double rgb[3], alpha = alpha_pixel(&s, x, y, rgb), depth = alpha_depth(x);
            if (fabs(alpha - (double)s.state.alpha_cutoff) < 1e-7) {
                if (alpha != (double)s.state.alpha_cutoff) continue;
                equal += s.state.alpha_cutoff > 0;
            }
            int gone = alpha_is_cut(&s, alpha), seen = fits && !gone && depth < (double)wall;
            fragments += seen;
            cut += gone;
            CHECK_NEAR(canvas_depth(&c, x, y), seen ? depth : (double)wall, seen ? 1e-6 : 0);
            if (isnan(alpha) && seen) continue;
            check_alpha_pixel(&c, &s, x, y, d, seen);
            blended[s.state.raster.blend] += seen && alpha > 0 && alpha < 1;
        }
        CHECK_INT(stats.fragments, fragments);
        CHECK_INT(stats.triangles, fits ? 2 : 0);
        canvas_close(&c);
    }
    CHECK_SAY(cut > 50000 && equal > 5000, "%ld cut, %ld equal", cut, equal);
    for (int k = 0; k < 3; k++) CHECK(blended[k] > 20000 || SHADE_MAX_VARYINGS < 11);
    CHECK_SAY((refused > 0) == (SHADE_MAX_VARYINGS < 11), "%ld", refused);
}

/* A level of the map is one of its alpha too: 16 texels a pixel, in pictures and depth alone. */
TEST(mesh, alpha_of_a_mipmapped_map_is_that_of_the_level_drawn)
{
    enum { W = 4 * ALPHA_W, H = 4 * ALPHA_H };
    static alpha_scene s;
    static float texel[H][W][4], memory[H * W * 4];
    shade_texture levels[8];
    shade_result want = SHADE_MAX_VARYINGS < 8 ? SHADE_ERROR_STATE : SHADE_OK;
    long holes = 0, drawn = 0;
    for (int i = 0; i < 60; i++) {
        canvas c = canvas_ready(ALPHA_W, ALPHA_H, 0, SHADE_FORMAT_RGBA32F, 1);
        random_alpha_scene(&s);
        s.mesh.colors = NULL;
        s.mesh.texcoords = s.texcoord[0];
        s.state.diffuse_map = &s.map;
        s.state.transparency = 0;
        s.state.alpha_cutoff = 0.53125f; /* between two sixteenths */
        s.state.raster.blend = SHADE_BLEND_REPLACE;
        for (int k = 0; k < W * H; k++)
            for (int n = 0; n < 4; n++) texel[k / W][k % W][n] = (float)rnd_int(0, 1);
        s.map.pixels = texel;
        s.map.width = W;
        s.map.height = H;
        s.map.filter = SHADE_FILTER_TRILINEAR;
        CHECK_INT(shade_build_mipmaps(&s.map, levels, memory, sizeof memory), SHADE_OK);
        if (i % 2) c.target.color = NULL;
        CHECK_INT(shade_draw_mesh(&c.target, &s.mesh, &s.state, NULL), want);
        for (int k = 0; k < ALPHA_W * ALPHA_H && want == SHADE_OK; k++) {
            int x = k % ALPHA_W, y = k / ALPHA_W;
            double alpha = 0;
            for (int n = 0; n < 16; n++)
                alpha += (double)texel[4 * y + n / 4][4 * x + n % 4][3] / 16;
            CHECK_SAY((canvas_depth(&c, x, y) < 1) == (alpha > 0.53), "mean alpha %g", alpha);
            holes += alpha<0.53;
            drawn += alpha> 0.53;
            if (i % 2 == 0) CHECK_NEAR(canvas_float(&c, x, y, 3), alpha > 0.53 ? alpha : 0, 1e-4);
        }
        canvas_close(&c);
    }
    CHECK(SHADE_MAX_VARYINGS < 8 || (holes > 2000 && drawn > 2000));
}

/* Passes over a mesh with holes agree: depth alone, then colour where depth is EQUAL. */
TEST(mesh, depth_alone_has_the_holes_of_the_picture)
{
    static alpha_scene s;
    for (int i = 0; i < 300; i++) {
        canvas c[2];
        canvas_twins(c, ALPHA_W, ALPHA_H, SHADE_FORMAT_RGBA8, 1);
        shade_stats once, before, after;
        random_alpha_scene(&s);
        shade_result result = shade_draw_mesh(&c[0].target, &s.mesh, &s.state, &once);
        void *color = c[1].target.color;
        c[1].target.color = NULL;
        CHECK_INT(shade_draw_mesh(&c[1].target, &s.mesh, &s.state, &before), result);
        CHECK(!memcmp(c[0].depth, c[1].depth, c[0].depth_bytes));
        c[1].target.color = color;
        s.state.raster.depth_test = SHADE_COMPARE_EQUAL;
        CHECK_INT(shade_draw_mesh(&c[1].target, &s.mesh, &s.state, &after), result);
        CHECK(once.fragments == before.fragments && once.fragments == after.fragments);
        canvas_twins_close(c);
    }
}

/* ------------------------------------------------------------------------------- vertex normals */

static void ref_vertex_normals(const test_mesh *m, d3 *sum)
{
    for (int i = 0; i < m->mesh.vertex_count; i++) sum[i] = d3_of(0, 0, 0);
    for (int t = 0; t < m->mesh.index_count; t += 3) {
        d3 p[3];
        for (int k = 0; k < 3; k++) p[k] = d3_from(m->position[m->indices[t + k]]);
        d3 n = d3_unit(d3_cross(d3_sub(p[1], p[0]), d3_sub(p[2], p[0])));
        for (int k = 0; k < 3; k++) {
            d3 e = d3_unit(d3_sub(p[(k + 1) % 3], p[k])), f = d3_unit(d3_sub(p[(k + 2) % 3], p[k]));
            double angle = acos(fmax(-1, fmin(1, d3_dot(e, f))));
            uint32_t v = m->indices[t + k];
            sum[v] = d3_add(sum[v], d3_scale(n, angle));
        }
    }
}

TEST(mesh, vertex_normals_are_weighted_by_angle_and_unit)
{
    static test_mesh m;
    static shade_vec3 got[MESH_VERTICES];
    static d3 want[MESH_VERTICES];
    for (int i = 0; i < 200; i++) {
        memset(&m, 0, sizeof m);
        random_ball(&m, 1, 0);
        double size = (double)rnd_log(1e-3, 1e3);
        for (int k = 0; k < MESH_VERTICES; k++)
            m.position[k] = shade_scale(m.position[k], (float)size);
        lay_out_mesh(&m, m.mesh.vertex_count, i % 2, 0);
        if (i % 3 == 0)
            m.mesh.index_count = m.mesh.index_count / 6 * 3; /* some vertices without faces */
        for (int k = 0; k < 5 && i % 2; k++) {               /* faces without area */
            int t = rnd_int(0, m.mesh.index_count / 3 - 1) * 3;
            m.indices[t] = m.indices[t + rnd_int(1, 2)];
        }
        ref_vertex_normals(&m, want);
        memset(got, CANVAS_BYTE, sizeof got);
        CHECK_INT(shade_mesh_normals(&m.mesh, got), SHADE_OK);
        for (int v = 0; v < m.mesh.vertex_count; v++) {
            if (d3_length(want[v]) == 0)
                check_color(__LINE__, "no faces", got[v], d3_of(0, 0, 0), 0);
            else if (d3_length(want[v]) > 0.2)
                check_color(__LINE__, "normal", got[v], d3_unit(want[v]), 2e-5);
        }
        for (int v = m.mesh.vertex_count; v < MESH_VERTICES; v++)
            CHECK(float_bits(got[v].x) == 0xA5A5A5A5u);
    }
}

/* however its faces are split: angles, not areas or counts */
TEST(mesh, corners_of_a_cube_point_along_its_diagonals)
{
    static const float p[] = { -1, -1, -1, 1, -1, -1, -1, 1, -1, 1, 1, -1,
                               -1, -1, 1,  1, -1, 1,  -1, 1, 1,  1, 1, 1 };
    static const uint32_t faces[6][4] = { { 0, 2, 3, 1 }, { 4, 5, 7, 6 }, { 0, 1, 5, 4 },
                                          { 2, 6, 7, 3 }, { 0, 4, 6, 2 }, { 1, 3, 7, 5 } };
    for (int round = 0; round < 64; round++) {
        uint32_t indices[36];
        shade_vec3 n[8];
        int count = 0;
        for (int f = 0; f < 6; f++) {
            int s = round >> f & 1;
            static const int split[2][6] = { { 0, 1, 2, 0, 2, 3 }, { 1, 2, 3, 1, 3, 0 } };
            for (int k = 0; k < 6; k++) indices[count++] = faces[f][split[s][k]];
        }
        shade_mesh mesh = plain_mesh(p, 8);
        mesh.indices = indices;
        mesh.index_count = 36;
        CHECK_INT(shade_mesh_normals(&mesh, n), SHADE_OK);
        for (int v = 0; v < 8; v++) {
            d3 want = d3_unit(d3_of((double)p[3 * v], (double)p[3 * v + 1], (double)p[3 * v + 2]));
            check_color(__LINE__, "corner", n[v], want, 1e-5);
        }
    }
}

TEST(mesh, vertex_normals_of_bad_meshes_are_refused)
{
    static const uint32_t good[] = { 0, 1, 2 }, bad[] = { 0, 1, 3 };
    shade_vec3 n[3];
    shade_mesh m = plain_mesh(big_triangle, 3);
    CHECK_INT(shade_mesh_normals(&m, n), SHADE_OK); /* vertices in threes */
    check_color(__LINE__, "normal", n[1], d3_of(0, 0, 1), 1e-6);
    CHECK_INT(shade_mesh_normals(NULL, n), SHADE_ERROR_ARGUMENT);
    CHECK_INT(shade_mesh_normals(&m, NULL), SHADE_ERROR_ARGUMENT);
    m.indices = bad;
    m.index_count = 3;
    CHECK_INT(shade_mesh_normals(&m, n), SHADE_ERROR_INDEX);
    m.indices = good;
    m.index_count = 2;
    CHECK_INT(shade_mesh_normals(&m, n), SHADE_ERROR_INDEX);
    m.index_count = -3;
    CHECK_INT(shade_mesh_normals(&m, n), SHADE_ERROR_MESH);
    m.index_count = 3;
    m.position_stride = 5;
    CHECK_INT(shade_mesh_normals(&m, n), SHADE_ERROR_MESH);
    m.position_stride = -12;
    CHECK_INT(shade_mesh_normals(&m, n), SHADE_ERROR_MESH);
    m.position_stride = 0;
    m.positions = NULL;
    CHECK_INT(shade_mesh_normals(&m, n), SHADE_ERROR_MESH);
    float strange[9];
    for (int i = 0; i < 500; i++) { /* NaN and infinity do no harm */
        fill_nasty(strange, sizeof strange);
        shade_mesh s = plain_mesh(strange, 3);
        CHECK_INT(shade_mesh_normals(&s, n), SHADE_OK);
    }
}
