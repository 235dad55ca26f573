/* shape.c - normals of corners and edges of meshes, against oracles that compare every face with
   every other. */
#include "unit.h"
#include "picked.h"

enum { SHAPE_VERTICES = 128, SHAPE_CORNERS = 480 };

typedef struct shape_mesh {
    shade_vec3 position[SHAPE_VERTICES];
    uint32_t index[SHAPE_CORNERS];
    shade_mesh mesh;
} shape_mesh;

static void shape_close(shape_mesh *s, int vertices, int corners)
{
    memset(&s->mesh, 0, sizeof s->mesh);
    s->mesh.positions = &s->position[0].x;
    s->mesh.vertex_count = vertices;
    s->mesh.indices = s->index;
    s->mesh.index_count = corners;
}

static d3 shape_at(const shade_mesh *m, int corner)
{
    float p[3];
    size_t stride = m->position_stride ? (size_t)m->position_stride : 12;
    size_t v = m->indices ? m->indices[corner] : (size_t)corner;
    memcpy(p, (const char *)m->positions + v * stride, 12);
    return d3_of((double)p[0], (double)p[1], (double)p[2]);
}

static int shape_corners(const shade_mesh *m)
{
    return m->indices ? m->index_count : m->vertex_count;
}

static d3 ref_face(const shade_mesh *m, int t)
{
    d3 a = shape_at(m, 3 * t), b = shape_at(m, 3 * t + 1), c = shape_at(m, 3 * t + 2);
    return d3_unit(d3_cross(d3_unit(d3_sub(b, a)), d3_unit(d3_sub(c, a))));
}

static double ref_angle(const shade_mesh *m, int corner)
{
    int t = corner / 3 * 3, k = corner % 3;
    d3 p = shape_at(m, corner);
    d3 a = d3_unit(d3_sub(shape_at(m, t + (k + 1) % 3), p));
    d3 b = d3_unit(d3_sub(shape_at(m, t + (k + 2) % 3), p));
    return atan2(d3_length(d3_cross(a, b)), d3_dot(a, b));
}

/* The normal of a corner; unsure where a cosine lies within rounding of the threshold or the sum
   nearly cancels. */
static d3 ref_corner_normal(const shade_mesh *m, int corner, double cos_crease, int *unsure)
{
    d3 own = ref_face(m, corner / 3), sum = d3_of(0, 0, 0), p = shape_at(m, corner);
    for (int k = 0; k < shape_corners(m); k++) {
        d3 q = shape_at(m, k), other;
        if (q.x != p.x || q.y != p.y || q.z != p.z) continue;
        other = ref_face(m, k / 3);
        double c = d3_dot(own, other);
        if (k != corner && fabs(c - cos_crease) < 1e-5) *unsure = 1;
        if (k == corner || c >= cos_crease)
            sum = d3_add(sum, d3_scale(other, ref_angle(m, k)));
    }
    if (d3_length(sum) < 0.05) *unsure = 1;
    return d3_unit(sum);
}

static void corner_normals(const shade_mesh *m, float cos_crease, shade_vec3 *out)
{
    size_t bytes = shade_mesh_corner_normals_bytes(m);
    unsigned char *block = canvas_block(bytes);
    CHECK_INT(shade_mesh_corner_normals(m, cos_crease, out, block + CANVAS_GUARD, bytes),
              SHADE_OK);
    for (int k = 0; k < CANVAS_GUARD; k++) {
        CHECK(block[k] == CANVAS_BYTE && block[CANVAS_GUARD + bytes + (size_t)k] == CANVAS_BYTE);
    }
    free(block);
}

/* A cube: vertices shared, or four to a face. */
static void shape_cube(shape_mesh *s, int split)
{
    int vertices = 0, corners = 0;
    for (int axis = 0; axis < 3; axis++) {
        for (int side = 0; side < 2; side++) {
            uint32_t at[4];
            for (int k = 0; k < 4; k++) {
                float p[3];
                int found = -1, a = k == 1 || k == 2, b = k >> 1;
                p[axis] = side ? 1.0f : -1.0f;
                p[(axis + 1) % 3] = (side ? a : b) ? 1.0f : -1.0f;
                p[(axis + 2) % 3] = (side ? b : a) ? 1.0f : -1.0f;
                for (int n = 0; n < vertices && !split; n++) {
                    if (!memcmp(&s->position[n], p, 12)) found = n;
                }
                if (found < 0) {
                    found = vertices++;
                    memcpy(&s->position[found], p, 12);
                }
                at[k] = (uint32_t)found;
            }
            for (int k = 0; k < 6; k++) s->index[corners++] = at[k < 3 ? k : k == 3 ? 0 : k - 2];
        }
    }
    shape_close(s, vertices, corners);
}

/* A bent sheet with some triangles flipped, doubled, without area, or of vertices that repeat
   the place of others, with zeros of either sign. */
static void random_shape(shape_mesh *s)
{
    int across = rnd_int(2, 6), vertices = 0, corners = 0;
    for (int j = 0; j < across; j++)
        for (int i = 0; i < across; i++) {
            s->position[vertices++] = shade_v3((float)(i - 2), (float)(j - 2),
                                               rnd_one_in(3) ? 0 : rnd_float(-1, 1));
        }
    for (int k = rnd_int(0, 12); k > 0; k--) { /* doubles */
        shade_vec3 p = s->position[rnd_int(0, vertices - 1)];
        if (p.x == 0 && rnd_one_in(2)) p.x = -p.x;
        if (p.y == 0 && rnd_one_in(2)) p.y = -p.y;
        if (p.z == 0 && rnd_one_in(2)) p.z = -p.z;
        s->position[vertices++] = p;
    }
    for (int j = 0; j + 1 < across; j++) {
        for (int i = 0; i + 1 < across; i++) {
            uint32_t a = (uint32_t)(j * across + i), q[6];
            q[0] = a;
            q[1] = a + 1;
            q[2] = a + (uint32_t)across + 1;
            q[3] = a;
            q[4] = q[2];
            q[5] = q[2] - 1;
            for (int k = 0; k < 6; k++) {
                for (int n = across * across; n < vertices; n++) { /* a double in its place */
                    shade_vec3 x = s->position[n], y = s->position[q[k]];
                    if (x.x == y.x && x.y == y.y && x.z == y.z && rnd_one_in(2))
                        q[k] = (uint32_t)n;
                }
                s->index[corners++] = q[k];
            }
        }
    }
    for (int k = rnd_int(0, 8); k > 0; k--) {
        for (int n = 0; n < 3; n++) s->index[corners + n] = (uint32_t)rnd_int(0, vertices - 1);
        if (rnd_one_in(3)) s->index[corners + 1] = s->index[corners];
        if (rnd_one_in(4)) memcpy(s->index + corners, s->index + rnd_int(0, 1) * 3, 12);
        corners += 3;
    }
    shape_close(s, vertices, corners);
}

/* ------------------------------------------------------------------------------------- normals */

TEST(shape, a_cube_is_sharp_below_the_threshold_and_smooth_above)
{
    static shape_mesh s;
    shade_vec3 out[SHAPE_CORNERS];
    for (int split = 0; split < 2; split++) {
        shape_cube(&s, split);
        CHECK_INT(s.mesh.vertex_count, split ? 24 : 8);
        for (int smooth = 0; smooth < 2; smooth++) {
            corner_normals(&s.mesh, smooth ? -0.5f : 0.5f, out);
            for (int k = 0; k < 36; k++) {
                d3 want = smooth ? d3_unit(shape_at(&s.mesh, k)) : ref_face(&s.mesh, k / 3);
                CHECK(shape_off(out[k], want) < 2e-6);
                CHECK(d3_dot(d3_from(out[k]), shape_at(&s.mesh, k)) > 0); /* outward */
            }
        }
    }
}

/* the faces of a cube have a cosine of exactly 0 */
TEST(shape, an_edge_of_exactly_the_threshold_is_smooth)
{
    static shape_mesh s;
    shade_vec3 out[SHAPE_CORNERS];
    shape_cube(&s, 0);
    corner_normals(&s.mesh, 0, out);
    for (int k = 0; k < 36; k++) CHECK(shape_off(out[k], d3_unit(shape_at(&s.mesh, k))) < 2e-6);
    corner_normals(&s.mesh, 1e-30f, out);
    for (int k = 0; k < 36; k++) CHECK(shape_off(out[k], ref_face(&s.mesh, k / 3)) < 2e-6);
}

/* Thresholds within 0.01 of 1 are moved: there rounding decides whether faces of one plane are
   near. */
TEST(shape, corner_normals_are_the_weighted_mean_of_the_near_faces)
{
    static shape_mesh s;
    static shade_vec3 out[SHAPE_CORNERS];
    long checked = 0;
    for (int i = 0; i < 150; i++) {
        random_shape(&s);
        float threshold = rnd_one_in(4) ? (float)rnd_int(-1, 1) : rnd_float(-1.1, 1.1);
        if (threshold > 0.99f && threshold < 1.01f) threshold = 0.9f;
        corner_normals(&s.mesh, threshold, out);
        for (int k = 0; k < s.mesh.index_count; k++) {
            int unsure = 0;
            d3 want = ref_corner_normal(&s.mesh, k, (double)threshold, &unsure);
            double length = d3_length(d3_from(out[k]));
            CHECK_SAY(length <= 1 + 1e-6 && (length > 1 - 1e-6 || length <= 0), "length %g",
                      length);
            if (unsure || d3_length(ref_face(&s.mesh, k / 3)) < 0.5) continue;
            checked++;
            CHECK_SAY(shape_off(out[k], want) < 3e-5, "corner %d threshold %g: off by %g", k,
                      (double)threshold, shape_off(out[k], want));
        }
    }
    CHECK_SAY(checked > 5000, "%ld", checked);
}

TEST(shape, vertices_of_equal_position_are_one_whatever_the_sign_of_zero)
{
    shade_vec3 p[6] = { { 0, 0, 0 },      { 1, 0, 0 },     { 0, 1, 0.5f },
                        { -0.0f, 0, -0.0f }, { 0, 1, 0.5f }, { -1, 0, 0 } };
    shade_vec3 out[6];
    shade_mesh m = plain_mesh(&p[0].x, 6); /* no indices */
    corner_normals(&m, -1, out);
    for (int k = 0; k < 6; k++) {
        int unsure = 0;
        CHECK(shape_off(out[k], ref_corner_normal(&m, k, -1, &unsure)) < 2e-6);
    }
    CHECK(!memcmp(&out[0], &out[3], 12) && !memcmp(&out[2], &out[4], 12));
}

TEST(shape, faces_without_area_change_no_neighbour)
{
    static shape_mesh s;
    static shade_vec3 before[SHAPE_CORNERS], after[SHAPE_CORNERS];
    static shade_vec3 vertex[SHAPE_VERTICES];
    for (int i = 0; i < 60; i++) {
        random_shape(&s);
        float threshold = rnd_float(-1, 0.9);
        int corners = s.mesh.index_count, vertices = s.mesh.vertex_count;
        corner_normals(&s.mesh, threshold, before);
        for (int k = 0; k < 5; k++) {
            uint32_t a = (uint32_t)rnd_int(0, vertices - 1), b = (uint32_t)rnd_int(0, vertices - 1);
            uint32_t *at = s.index + s.mesh.index_count;
            at[0] = a;
            at[1] = k & 1 ? a : b;
            at[2] = k & 2 ? a : b;
            if (k == 4) { /* corners that are no numbers */
                s.position[vertices] = shade_v3((float)NAN, rnd_nasty(), INFINITY);
                s.mesh.vertex_count = vertices + 1;
                at[1] = (uint32_t)vertices;
            }
            s.mesh.index_count += 3;
        }
        corner_normals(&s.mesh, threshold, after);
        for (int k = 0; k < corners; k++) {
            if (d3_length(ref_face(&s.mesh, k / 3)) < 0.5) continue;
            CHECK_SAY(shape_off(after[k], d3_from(before[k])) < 1e-6, "corner %d: off by %g", k,
                      shape_off(after[k], d3_from(before[k])));
        }
        for (int k = 0; k < s.mesh.index_count; k++) {
            CHECK(isfinite(after[k].x) && isfinite(after[k].y) && isfinite(after[k].z));
        }
        CHECK_INT(shade_mesh_normals(&s.mesh, vertex), SHADE_OK);
        for (int k = 0; k < s.mesh.vertex_count; k++) {
            CHECK(isfinite(vertex[k].x) && isfinite(vertex[k].y) && isfinite(vertex[k].z));
        }
    }
}

/* A third of the positions are NaN, infinite, or of any size: a normal is a unit vector or zero. */
TEST(shape, any_positions_give_finite_corner_normals)
{
    static shape_mesh s;
    static shade_vec3 out[SHAPE_CORNERS];
    for (int i = 0; i < 300; i++) {
        random_shape(&s);
        for (int k = 0; k < s.mesh.vertex_count; k++) {
            if (rnd_one_in(3)) s.position[k] = shade_v3(rnd_nasty(), rnd_nasty(), rnd_nasty());
        }
        corner_normals(&s.mesh, rnd_float(-1, 1), out);
        for (int k = 0; k < s.mesh.index_count; k++) {
            double length = d3_length(d3_from(out[k]));
            CHECK_SAY(length <= 1 + 1e-5, "length %g", length);
        }
    }
}

TEST(shape, strides_and_missing_indices_give_the_same_corner_normals)
{
    static shape_mesh s;
    static shade_vec3 tight[SHAPE_CORNERS], wide[SHAPE_CORNERS], soup[SHAPE_CORNERS];
    static float spread[SHAPE_VERTICES * 5], flat[SHAPE_CORNERS * 3];
    for (int i = 0; i < 20; i++) {
        random_shape(&s);
        shade_mesh m = s.mesh, n = s.mesh;
        for (int k = 0; k < s.mesh.vertex_count; k++) memcpy(spread + 5 * k, &s.position[k], 12);
        for (int k = 0; k < s.mesh.index_count; k++)
            memcpy(flat + 3 * k, &s.position[s.index[k]], 12);
        m.positions = spread;
        m.position_stride = 20;
        n.positions = flat;
        n.indices = NULL;
        n.vertex_count = s.mesh.index_count;
        n.index_count = 7; /* not looked at */
        corner_normals(&s.mesh, 0.3f, tight);
        corner_normals(&m, 0.3f, wide);
        corner_normals(&n, 0.3f, soup);
        CHECK(!memcmp(tight, wide, (size_t)s.mesh.index_count * 12));
        CHECK(!memcmp(tight, soup, (size_t)s.mesh.index_count * 12));
    }
}

/* A mesh of triangles without any vertex in common, each with its place: a bump of its own. */
typedef struct shape_soup {
    shade_mesh mesh;
    shade_vec3 *position, *out;
    int triangles;
} shape_soup;

static shape_soup shape_soup_open(int triangles)
{
    size_t bytes = (size_t)triangles * 3 * sizeof(shade_vec3);
    shape_soup s = { 0 };
    s.position = test_memory(bytes);
    s.out = test_memory(bytes);
    s.triangles = triangles;
    s.mesh.positions = &s.position[0].x;
    s.mesh.vertex_count = 3 * triangles;
    return s;
}

static void shape_soup_close(shape_soup *s)
{
    free(s->position);
    free(s->out);
}

/* Where the sum of the bits is the same for all, or only the lowest, or the highest bits differ;
   where multiplying and mixing the three words, as hashes of positions do, ends in one
   number for all; small whole numbers; and NaN, which is like no other. */
static void shape_place(int kind, uint32_t i, shade_vec3 *p)
{
    uint32_t h, z;
    switch (kind) {
    case 0:
        h = (i & 1023) << 13;
        z = (i >> 10) << 13;
        *p = shade_v3(bits_float(0x3F800000u + h), bits_float(0x3F800000u + z),
                      bits_float(0x41000000u - h - z));
        break;
    case 1:
        *p = shade_v3(1, 2, bits_float(0x40400000u + i));
        break;
    case 2:
        *p = shade_v3(bits_float(0x3A000000u + (i & 127) * 0x00100000u),
                      bits_float(0x3A000000u + (i >> 7 & 127) * 0x00100000u),
                      bits_float(0x3A000000u + (i >> 14) * 0x00080000u));
        break;
    case 3:
        do {
            p->x = rnd_float(-1, 1);
            p->y = rnd_float(-1, 1);
            h = float_bits(p->x) * 0x9E3779B1u;
            h = (h ^ h >> 15) * 0x85EBCA77u + float_bits(p->y);
            z = 0x12345678u - (h ^ h >> 15) * 0x2C1B3C6Du;
        } while ((z & 0x7FFFFFFFu) < 0x3A000000u || (z & 0x7FFFFFFFu) > 0x42000000u);
        p->z = bits_float(z);
        break;
    case 4:
        *p = shade_v3((float)(i % 71), (float)(i / 71 % 71), (float)(i / 71 / 71));
        break;
    default:
        *p = shade_v3(i & 1 ? 1 : (float)NAN, 2, i & 1 ? (float)NAN : 3);
        break;
    }
}

/* All positions differ, so each corner has the normal of its own face alone.  What compares each
   corner with all others, or with a part of them that grows with their number, takes minutes. */
TEST(shape, a_hundred_thousand_triangles_apart_are_told_apart_whatever_their_bits_are)
{
    enum { TRIANGLES = 120000 };
    shape_soup s = shape_soup_open(TRIANGLES);
    for (int kind = 0; kind < 6; kind++) {
        long checked = 0;
        for (int k = 0; k < 3 * TRIANGLES; k++) shape_place(kind, (uint32_t)k, &s.position[k]);
        for (int k = 3 * TRIANGLES - 1; k > 0; k--) { /* in any order */
            int other = rnd_int(0, k);
            shade_vec3 p = s.position[k];
            s.position[k] = s.position[other];
            s.position[other] = p;
        }
        corner_normals(&s.mesh, -1, s.out);
        for (int t = 0; t < TRIANGLES; t++) {
            d3 a = shape_at(&s.mesh, 3 * t), e = d3_sub(shape_at(&s.mesh, 3 * t + 1), a);
            d3 f = d3_sub(shape_at(&s.mesh, 3 * t + 2), a), n = d3_cross(d3_unit(e), d3_unit(f));
            if (!(d3_length(n) > 1e-2)) continue; /* a sliver, or no number */
            checked++;
            for (int k = 3 * t; k < 3 * t + 3; k++)
                CHECK_SAY(shape_off(s.out[k], d3_unit(n)) < 5e-5, "kind %d, corner %d: off by %g",
                          kind, k, shape_off(s.out[k], d3_unit(n)));
        }
        CHECK_SAY(kind == 1 || kind == 5 ? checked == 0 : checked > TRIANGLES / 4, "kind %d: %ld",
                  kind, checked);
    }
    shape_soup_close(&s);
}

/* Pairs of faces around one edge, far from all others; which corners meet is known beforehand. */
TEST(shape, corners_that_meet_find_each_other_among_a_hundred_thousand)
{
    enum { PAIRS = 50000 };
    static uint32_t place[2 * PAIRS];
    shape_soup s = shape_soup_open(2 * PAIRS);
    for (uint32_t k = 0; k < 2 * PAIRS; k++) place[k] = k;
    for (int k = 2 * PAIRS - 1; k > 0; k--) {
        int other = rnd_int(0, k);
        uint32_t p = place[k];
        place[k] = place[other];
        place[other] = p;
    }
    for (int k = 0; k < PAIRS; k++) {
        float x = (float)(k % 500) * 4, y = (float)(k / 500) * 4, bent = (float)(k % 7) / 4;
        shade_vec3 *p = s.position + 3 * place[2 * k], *q = s.position + 3 * place[2 * k + 1];
        p[0] = shade_v3(x, y, 0);
        p[1] = shade_v3(x + 1, y, 0);
        p[2] = shade_v3(x, y + 1, bent);
        q[0] = p[1];
        q[1] = p[0];
        q[2] = shade_v3(x, y - 1, bent);
        if (k % 3 == 0 && k % 500 == 0) q[1].x = -0.0f; /* is 0 */
    }
    corner_normals(&s.mesh, 0.25f, s.out);
    for (int k = 0; k < PAIRS; k++) {
        int a = (int)place[2 * k], b = (int)place[2 * k + 1];
        d3 na = ref_face(&s.mesh, a), nb = ref_face(&s.mesh, b);
        int smooth = d3_dot(na, nb) >= 0.25;
        for (int n = 0; n < 2; n++) { /* the two ends of the edge */
            double wa = smooth ? ref_angle(&s.mesh, 3 * a + n) : 0;
            double wb = smooth ? ref_angle(&s.mesh, 3 * b + 1 - n) : 0;
            d3 mean_a = d3_unit(d3_add(d3_scale(na, smooth ? wa : 1), d3_scale(nb, wb)));
            d3 mean_b = d3_unit(d3_add(d3_scale(na, wa), d3_scale(nb, smooth ? wb : 1)));
            CHECK(shape_off(s.out[3 * a + n], mean_a) < 2e-6);
            CHECK(shape_off(s.out[3 * b + 1 - n], mean_b) < 2e-6);
        }
        CHECK(shape_off(s.out[3 * a + 2], na) < 2e-6 && shape_off(s.out[3 * b + 2], nb) < 2e-6);
    }
    shape_soup_close(&s);
}

/* Fans around places that differ from one in a single byte of their twelve. */
TEST(shape, positions_that_differ_in_one_byte_differ)
{
    enum { FACES = 150 };
    shape_soup s = shape_soup_open(FACES);
    shade_vec3 tip[14];
    for (int k = 0; k < 14; k++) {
        float c[3] = { 1.25f, -0.75f, 1.5f };
        if (k < 12) {
            uint32_t flip = (k & 3) == 3 ? 0x01000000u : 1u << 8 * (k & 3);
            c[k / 4] = bits_float(float_bits(c[k / 4]) ^ flip);
        }
        tip[k] = shade_v3(c[0], c[1], c[2]);
    }
    for (int i = 0; i < 20; i++) {
        for (int k = 0; k < 3 * FACES; k++) {
            double a = (k / 3 + 0.1 * rnd_unit()) * 0.7 + k % 3 * 1.5;
            s.position[k] = shade_v3((float)(3 * cos(a)), (float)(3 * sin(a)), rnd_float(4, 6));
            if (k % 3 == 0) s.position[k] = tip[rnd_int(0, 13)];
        }
        float threshold = rnd_float(-1, 0.9);
        corner_normals(&s.mesh, threshold, s.out);
        for (int k = 0; k < 3 * FACES; k++) {
            int unsure = 0;
            d3 want = ref_corner_normal(&s.mesh, k, (double)threshold, &unsure);
            if (unsure) continue;
            CHECK_SAY(shape_off(s.out[k], want) < 3e-5, "corner %d: off by %g", k,
                      shape_off(s.out[k], want));
        }
    }
    shape_soup_close(&s);
}

/* A position that holds a NaN is like no other, not even like its own bits; its faces have no
   normal, so its corners get none, and those around it lose nothing. */
TEST(shape, positions_that_are_no_numbers_equal_nothing)
{
    enum { FACES = 200 };
    shape_soup s = shape_soup_open(FACES);
    for (int i = 0; i < 40; i++) {
        for (int k = 0; k < 3 * FACES; k++) {
            s.position[k] = shade_v3((float)rnd_int(0, 2), (float)rnd_int(0, 2), rnd_float(-1, 1));
            if (rnd_one_in(2)) s.position[k].z = rnd_one_in(2) ? 0.0f : -0.0f;
            if (rnd_one_in(6)) s.position[k].x = bits_float(0x7FC00000u);
            if (rnd_one_in(6)) s.position[k].y = rnd_one_in(2) ? INFINITY : -INFINITY;
        }
        corner_normals(&s.mesh, -2, s.out);
        for (int k = 0; k < 3 * FACES; k++) {
            d3 sum = d3_of(0, 0, 0), p = shape_at(&s.mesh, k);
            for (int n = 0; n < 3 * FACES; n++) {
                d3 q = shape_at(&s.mesh, n), face;
                if (n != k && (p.x != q.x || p.y != q.y || p.z != q.z)) continue;
                face = ref_face(&s.mesh, n / 3);
                if (!isfinite(d3_length(face)) || !isfinite(p.y)) continue;
                sum = d3_add(sum, d3_scale(face, ref_angle(&s.mesh, n)));
            }
            if (d3_length(sum) > 0 && d3_length(sum) < 0.05) continue;
            CHECK_SAY(shape_off(s.out[k], d3_unit(sum)) < 3e-5, "corner %d: off by %g", k,
                      shape_off(s.out[k], d3_unit(sum)));
        }
    }
    shape_soup_close(&s);
}

/* 16 bytes a corner: two arrays of indices, an angle, and a third of a face's normal. */
TEST(shape, corner_normals_say_how_much_memory_they_take)
{
    static uint32_t list[300];
    static shade_vec3 p[3], out[300];
    shade_mesh m = plain_mesh(&p[0].x, 3);
    m.indices = list;
    for (int n = 0; n <= 300; n += 3) {
        m.index_count = n;
        CHECK_INT(shade_mesh_corner_normals_bytes(&m), 16 * n);
        corner_normals(&m, 0, out); /* in a block of that size */
        if (!n) continue;
        unsigned char *block = canvas_block((size_t)(16 * n));
        CHECK_INT(shade_mesh_corner_normals(&m, 0, out, block + CANVAS_GUARD, (size_t)(16 * n - 1)),
                  SHADE_ERROR_CAPACITY);
        free(block);
    }
    out[0] = shade_v3(7, 7, 7);
    m.index_count = 0; /* nothing to do, and nothing needed for it */
    CHECK_INT(shade_mesh_corner_normals(&m, 0, out, NULL, 0), SHADE_OK);
    m.indices = NULL;
    m.vertex_count = 0;
    m.positions = NULL;
    CHECK_INT(shade_mesh_corner_normals_bytes(&m), 0);
    CHECK_INT(shade_mesh_corner_normals(&m, 0, out, NULL, 0), SHADE_OK);
    CHECK_NEAR(out[0].x, 7, 0);
}

/* What shade_mesh_corner_normals is given, for a cube of 8 vertices and 36 corners. */
typedef struct normals_call {
    const shade_mesh *mesh;
    shade_vec3 *normals;
    void *memory;
    int moved, short_of; /* bytes that memory is off its alignment, and less than it takes */
    float threshold;
    int bad_index; /* 1: the only triangle is 0, 1, 8 */
    shade_mesh m;
} normals_call;

#define NORMALS_FAULT(field, value) FAULT(normals_call, field, value)
static const refusal bad_normals_arguments[] = {
    { SHADE_ERROR_ARGUMENT, { FAULT_NULL(normals_call, normals) } },
    { SHADE_ERROR_ARGUMENT, { FAULT_NULL(normals_call, memory) } },
    { SHADE_ERROR_ARGUMENT, { NORMALS_FAULT(moved, 1) } },
    { SHADE_ERROR_ARGUMENT, { NORMALS_FAULT(moved, 2) } },
    { SHADE_ERROR_CAPACITY, { NORMALS_FAULT(short_of, 1) } },
    { SHADE_ERROR_CAPACITY, { NORMALS_FAULT(short_of, INT_MAX) } }, /* no bytes at all */
    { SHADE_ERROR_STATE, { FAULT_REAL(normals_call, threshold, NAN) } },
};
static const refusal bad_normals_meshes[] = {
    { SHADE_ERROR_ARGUMENT, { FAULT_NULL(normals_call, mesh) } },
    { SHADE_ERROR_MESH, { FAULT_NULL(normals_call, m.positions) } },
    { SHADE_ERROR_MESH, { NORMALS_FAULT(m.vertex_count, -1) } },
    { SHADE_ERROR_MESH, { NORMALS_FAULT(m.index_count, -3) } },
    { SHADE_ERROR_MESH, { NORMALS_FAULT(m.position_stride, 13) } },
    { SHADE_ERROR_INDEX, { NORMALS_FAULT(m.index_count, 35) } },
    { SHADE_ERROR_INDEX, { NORMALS_FAULT(m.index_count, 3), NORMALS_FAULT(bad_index, 1) } },
};

/* Spoils the call for a cube as a row says and checks that no normal is written. */
static void check_bad_normals(int row, const refusal *r, int bad_mesh)
{
    static const uint32_t bad_indices[3] = { 0, 1, 8 };
    static uint32_t memory[200];
    static shape_mesh s;
    shade_vec3 out[36];
    shape_cube(&s, 0);
    size_t bytes = shade_mesh_corner_normals_bytes(&s.mesh);
    CHECK(bytes >= 36 * 4 && bytes <= sizeof memory - 4);
    memset(out, CANVAS_BYTE, sizeof out);

    normals_call bad = { NULL, out, memory, 0, 0, 0, 0, s.mesh };
    bad.mesh = &bad.m;
    spoil(&bad, r->faults);
    if (bad.bad_index) bad.m.indices = bad_indices;
    if (bad.moved) bad.memory = (char *)bad.memory + bad.moved;
    bytes -= (size_t)bad.short_of < bytes ? (size_t)bad.short_of : bytes;
    check_refusal(row, shade_mesh_corner_normals(bad.mesh, bad.threshold, bad.normals, bad.memory,
                                                 bytes), r->want);
    if (bad_mesh) CHECK_INT(shade_mesh_corner_normals_bytes(bad.mesh), 0);
    if (bad_mesh) {
        shade_vec3 low = shade_v3(7, 7, 7), high = low;
        CHECK_INT(shade_mesh_bounds(bad.mesh, &low, &high), r->want);
        CHECK(low.x == 7 && low.y == 7 && low.z == 7);
        CHECK(high.x == 7 && high.y == 7 && high.z == 7);
    }
    CHECK_SAY(untouched(out, sizeof out), "row %d", row);
}

TEST(shape, bad_corner_normal_calls_are_refused)
{
    for (int row = 0; row < TEST_COUNT(bad_normals_arguments); row++) {
        check_bad_normals(row, &bad_normals_arguments[row], 0);
    }
}

TEST(shape, corner_normals_of_bad_meshes_are_refused_and_take_no_bytes)
{
    for (int row = 0; row < TEST_COUNT(bad_normals_meshes); row++) {
        check_bad_normals(row, &bad_normals_meshes[row], 1);
    }
}

/* --------------------------------------------------------------------------------------- edges */

/* The triangles that have the edge, each once, by rising number. */
static int ref_edge(const shade_mesh *m, uint32_t a, uint32_t b, int *triangles)
{
    int n = 0;
    for (int t = 0; t < shape_corners(m) / 3; t++) {
        int has = 0;
        for (int k = 0; k < 3; k++) {
            uint32_t p = (uint32_t)(3 * t + k), q = (uint32_t)(3 * t + (k + 1) % 3);
            if (m->indices) {
                p = m->indices[p];
                q = m->indices[q];
            }
            has |= (p == a && q == b) || (p == b && q == a);
        }
        if (has) triangles[n++] = t;
    }
    return n;
}

static void check_edges(const shade_mesh *m)
{
    static shade_edge edges[SHAPE_CORNERS + 1];
    int corners = shape_corners(m), count = -1, at = 0, triangles[SHAPE_CORNERS];
    memset(edges, CANVAS_BYTE, sizeof edges);
    CHECK_INT(shade_mesh_edges(m, edges, corners, &count), SHADE_OK);
    CHECK(((unsigned char *)&edges[corners])[0] == CANVAS_BYTE);
    for (uint32_t a = 0; a < (uint32_t)m->vertex_count; a++)
        for (uint32_t b = a + 1; b < (uint32_t)m->vertex_count; b++) {
            int n = ref_edge(m, a, b, triangles), listed = 0;
            for (; at < count && edges[at].a == a && edges[at].b == b; at++) {
                for (int k = 0; k < 2; k++) {
                    int t = edges[at].triangle[k];
                    if (k == 1 && t == -1) continue;
                    CHECK_SAY(listed < n && t == triangles[listed],
                              "edge %u %u: triangle %d as number %d of %d", (unsigned)a,
                              (unsigned)b, t, listed, n);
                    listed++;
                    /* only the last entry of an edge may be half full */
                    if (k == 0) CHECK(edges[at].triangle[1] >= 0 || listed == n);
                }
            }
            CHECK_INT(listed, n);
        }
    CHECK_INT(at, count); /* sorted, and nothing else */
}

TEST(shape, edges_are_those_that_the_triangles_have_sorted_each_once)
{
    static shape_mesh s;
    for (int i = 0; i < 120; i++) {
        random_shape(&s);
        check_edges(&s.mesh);
    }
}

TEST(shape, a_closed_mesh_has_two_triangles_at_every_edge)
{
    static shape_mesh s;
    shade_edge edges[36];
    int count;
    shape_cube(&s, 0);
    CHECK_INT(shade_mesh_edges(&s.mesh, edges, 36, &count), SHADE_OK);
    CHECK_INT(count, 18); /* 12 and 6 diagonals */
    for (int k = 0; k < count; k++) CHECK(edges[k].triangle[0] >= 0 && edges[k].triangle[1] >= 0);
    check_edges(&s.mesh);
    shape_cube(&s, 1);
    CHECK_INT(shade_mesh_edges(&s.mesh, edges, 36, &count), SHADE_OK);
    CHECK_INT(count, 30); /* each face has a border of its own */
    check_edges(&s.mesh);
}

/* Leaves of a book: up to five triangles at the edge 0, 1, two to an entry, and two edges of
   their own each. */
TEST(shape, a_third_triangle_at_an_edge_makes_a_further_entry)
{
    static const uint32_t book[15] = { 0, 1, 2, 1, 0, 3, 0, 1, 4, 0, 1, 5, 1, 0, 6 };
    shade_vec3 p[7];
    shade_edge edges[15];
    int count;
    memset(p, 0, sizeof p);
    shade_mesh m = plain_mesh(&p[0].x, 7);
    m.indices = book;
    for (int n = 1; n <= 5; n++) {
        m.index_count = 3 * n;
        CHECK_INT(shade_mesh_edges(&m, edges, 3 * n, &count), SHADE_OK);
        CHECK_INT(count, (n + 1) / 2 + 2 * n);
        check_edges(&m);
    }
}

TEST(shape, doubled_and_degenerate_triangles_keep_edges_single)
{
    static const uint32_t list[][6] = {
        { 0, 1, 2, 0, 1, 2 }, { 0, 1, 2, 2, 1, 0 }, { 0, 0, 0, 0, 1, 2 },
        { 0, 1, 1, 0, 1, 2 }, { 0, 1, 0, 1, 0, 2 }, { 1, 1, 0, 1, 0, 1 },
    };
    shade_vec3 p[3];
    memset(p, 0, sizeof p);
    shade_mesh m = plain_mesh(&p[0].x, 3);
    m.index_count = 6;
    for (size_t k = 0; k < sizeof list / sizeof list[0]; k++) {
        m.indices = list[k];
        check_edges(&m);
    }
    m.indices = NULL; /* vertices in threes */
    check_edges(&m);
    m.vertex_count = 0;
    check_edges(&m);
}

TEST(shape, too_small_an_edge_list_is_refused_with_the_room_it_takes)
{
    static shape_mesh s;
    shade_edge edges[36];
    shape_cube(&s, 0);
    memset(edges, CANVAS_BYTE, sizeof edges);
    for (int room = 0; room < 18; room++) { /* less than there are edges */
        int count = -1;
        CHECK_INT(shade_mesh_edges(&s.mesh, room ? edges : NULL, room, &count),
                  SHADE_ERROR_CAPACITY);
        CHECK(count >= 18 && count <= 36);
        for (size_t i = (size_t)room * sizeof edges[0]; i < sizeof edges; i++)
            CHECK(((unsigned char *)edges)[i] == CANVAS_BYTE);
        if (room == 0) {
            int again = -1;
            CHECK_INT(shade_mesh_edges(&s.mesh, edges, count, &again), SHADE_OK);
            CHECK_INT(again, 18);
            memset(edges, CANVAS_BYTE, sizeof edges);
        }
    }
}

/* What shade_mesh_edges is given, for the same cube. */
typedef struct edges_call {
    const shade_mesh *mesh;
    shade_edge *edges;
    int room, *count;
    shade_mesh m;
} edges_call;

#define EDGES_FAULT(field, value) FAULT(edges_call, field, value)
static const refusal bad_edge_calls[] = {
    { SHADE_ERROR_ARGUMENT, { FAULT_NULL(edges_call, mesh) } },
    { SHADE_ERROR_ARGUMENT, { FAULT_NULL(edges_call, edges) } },
    { SHADE_ERROR_ARGUMENT, { FAULT_NULL(edges_call, count) } },
    { SHADE_ERROR_ARGUMENT, { EDGES_FAULT(room, -1) } },
    { SHADE_ERROR_MESH, { FAULT_NULL(edges_call, m.positions) } },
    { SHADE_ERROR_MESH, { EDGES_FAULT(m.index_count, -6) } },
    { SHADE_ERROR_MESH, { EDGES_FAULT(m.position_stride, -12) } },
    { SHADE_ERROR_INDEX, { EDGES_FAULT(m.vertex_count, 7) } },
    { SHADE_ERROR_INDEX, { EDGES_FAULT(m.index_count, 34) } },
};

TEST(shape, bad_edge_calls_are_refused)
{
    static shape_mesh s;
    shade_edge edges[36];
    shape_cube(&s, 0);
    memset(edges, CANVAS_BYTE, sizeof edges);
    for (int row = 0; row < TEST_COUNT(bad_edge_calls); row++) {
        int count = 77;
        edges_call bad = { NULL, edges, 36, &count, s.mesh };
        bad.mesh = &bad.m;
        spoil(&bad, bad_edge_calls[row].faults);
        shade_result got = shade_mesh_edges(bad.mesh, bad.edges, bad.room, bad.count);
        check_refusal(row, got, bad_edge_calls[row].want);
        if (bad.count) CHECK_INT(count, 0);
        CHECK_SAY(untouched(edges, sizeof edges), "row %d", row);
    }
}

TEST(shape, silhouettes_part_front_from_back_and_creases_bend_enough)
{
    for (int i = 0; i < 20000; i++) {
        d3 e = d3_scale(rnd_direction(), (double)rnd_log(0.1, 100)), a = rnd_direction();
        d3 b = rnd_direction();
        float threshold = rnd_float(-1, 1);
        double s = d3_dot(e, a) * d3_dot(e, b), c = d3_dot(a, b);
        if (fabs(s) > 1e-5 * d3_dot(e, e)) {
            CHECK_INT(shade_is_silhouette(d3_round(e), d3_round(a), d3_round(b)), s < 0);
        }
        if (fabs(c - (double)threshold) > 1e-6) {
            CHECK_INT(shade_is_crease(d3_round(a), d3_round(b), threshold), c < (double)threshold);
        }
    }
    shade_vec3 x = shade_v3(1, 0, 0), y = shade_v3(0, 1, 0), minus = shade_v3(-1, 0, 0);
    CHECK_INT(shade_is_silhouette(x, y, x), 1); /* a face seen edge-on counts */
    CHECK_INT(shade_is_silhouette(x, x, minus), 1);
    CHECK_INT(shade_is_silhouette(x, x, x), 0);
    CHECK_INT(shade_is_silhouette(x, minus, minus), 0);
    CHECK_INT(shade_is_crease(x, y, 0), 1); /* equality counts */
    CHECK_INT(shade_is_crease(x, x, 1), 1);
    CHECK_INT(shade_is_crease(x, x, 0.99f), 0);
    CHECK_INT(shade_is_crease(x, minus, -1), 1);
    const shade_vec3 e = shade_v3(0, 0, 1e-12f), a = shade_v3(0, 1e-12f, 1e-12f);
    CHECK(!shade_is_silhouette(e, a, a)); /* both fronts, however small: the product is not 0 */
    CHECK(shade_is_silhouette(e, a, shade_neg(a)));
}

TEST(shape, faces_whose_corners_lie_in_a_line_to_the_bit_have_no_normal)
{
    for (int i = 0; i < 20000; i++) {
        const uint32_t index[6] = { 0, 1, 2, 0, 1, 3 };
        static uint32_t memory[4 * 6];
        shade_vec3 p[4], normal[4], corner[6];
        shade_mesh m = plain_mesh(&p[0].x, 4);
        corners_in_a_line(p);
        p[3] = shade_madd(p[0], shade_length(p[0]) + shade_length(p[1]), d3_round(rnd_direction()));
        m.indices = index;
        m.index_count = 6;
        CHECK_INT(shade_mesh_normals(&m, normal), SHADE_OK);
        CHECK_VEC(normal[2], d3_of(0, 0, 0), 0);
        CHECK_INT(shade_mesh_corner_normals(&m, -1, corner, memory, sizeof memory), SHADE_OK);
        if (memcmp(&p[0], &p[2], 12) && memcmp(&p[1], &p[2], 12)) /* equal positions are one */
            CHECK_VEC(corner[2], d3_of(0, 0, 0), 0);
        const d3 face = d3_cross(d3_unit(d3_sub(d3_from(p[1]), d3_from(p[0]))),
                                 d3_unit(d3_sub(d3_from(p[3]), d3_from(p[0]))));
        if (d3_length(face) < 0.2) continue;
        CHECK_VEC(normal[3], d3_unit(face), 1e-4);
        CHECK_VEC(corner[5], d3_unit(face), 1e-4);
    }
}

/* A plane with a T-junction, which a triangle without area closes: its corners lie in a line, and
   the one in the middle has an angle of pi. */
TEST(shape, a_triangle_without_area_in_a_junction_turns_no_normal)
{
    for (int i = 0; i < 3000; i++) {
        const shade_vec3 u = shade_v3((float)rnd_int(-9, 9), (float)rnd_int(-9, 9), 7);
        const shade_vec3 v = shade_v3((float)rnd_int(-9, 9), 11, (float)rnd_int(-9, 9));
        const float middle = (float)rnd_int(1, 999), end = middle + (float)rnd_int(1, 999);
        const uint32_t index[12] = { 0, 1, 3, 1, 2, 3, 0, 2, 1, 0, 4, 2 };
        const d3 want = d3_unit(d3_cross(d3_from(u), d3_from(v)));
        static uint32_t memory[4 * 12];
        shade_vec3 p[5], normal[5], corner[12];
        shade_mesh m;
        if (d3_length(d3_cross(d3_unit(d3_from(u)), d3_unit(d3_from(v)))) < 0.1) continue;
        p[0] = shade_v3(0, 0, 0);
        p[1] = shade_scale(u, middle);
        p[2] = shade_scale(u, end);
        p[3] = shade_scale(v, middle);
        p[4] = shade_neg(p[3]);
        m = plain_mesh(&p[0].x, 5);
        m.indices = index;
        m.index_count = 12;
        CHECK_INT(shade_mesh_normals(&m, normal), SHADE_OK);
        for (int k = 0; k < 5; k++) CHECK(shape_off(normal[k], want) < 2e-6);
        CHECK_INT(shade_mesh_corner_normals(&m, -1, corner, memory, sizeof memory), SHADE_OK);
        for (int k = 0; k < 6; k++) CHECK(shape_off(corner[k], want) < 2e-6);
    }
}

/* Vertices anywhere between 1e-18 and 1e18; or on a grid and on lines, so that faces have no area,
   or hardly any; some in one place, some no numbers. */
static void shape_place_any(int kind, float *at)
{
    const double size = kind == 1 ? (double)rnd_log(1e-18, 1e18) : 1;
    for (int k = 0; k < 3; k++) {
        at[k] = (float)((rnd_unit() - 0.5) * size);
        if (kind == 2) at[k] = (float)rnd_int(-2, 2) * (rnd_one_in(9) ? 1 : 1e-6f);
        if (kind == 3 && rnd_one_in(20)) at[k] = rnd_one_in(2) ? NAN : INFINITY;
        if (kind == 3 && rnd_one_in(20)) at[k] *= 1e-39f;
    }
    for (int k = 1; kind == 4 && k < 3; k++)
        at[k] = (float)k * 0.3f * at[0] + rnd_float(-1e-6, 1e-6);
}

static int shape_equal(shade_vec3 a, shade_vec3 b)
{
    return a.x == b.x && a.y == b.y && a.z == b.z;
}

/* 1 if a face at the vertex of a corner looks the other way: rounding may leave its cosine below
   -1, so that the crease of corners parts them. */
static int shape_opposed(const shape_mesh *s, const shade_vec3 *face, int corner)
{
    for (int i = 0; i < s->mesh.index_count; i++)
        if (s->index[i] == s->index[corner] && shade_dot(face[i / 3], face[corner / 3]) < -0.99999f)
            return 1;
    return 0;
}

/* Normals of vertices are summed by blocks of faces, those of corners one by one.  G13 */
TEST(shape, normals_of_vertices_have_the_bits_of_those_of_corners)
{
    static shape_mesh s;
    static shade_vec3 vertex[SHAPE_VERTICES], corner[SHAPE_CORNERS], face[SHAPE_CORNERS / 3];
    static uint32_t memory[16 * SHAPE_CORNERS];
    int compared = 0;
    for (int turn = 0; turn < 500; turn++) {
        const int corners = 3 * rnd_int(1, SHAPE_CORNERS / 3), kind = turn % 5;
        for (int i = 0; i < SHAPE_VERTICES; i++) shape_place_any(kind, &s.position[i].x);
        for (int i = 0; i < SHAPE_VERTICES; i++) /* each has a place of its own */
            for (int k = 0; k < i; k++)
                if (shape_equal(s.position[i], s.position[k])) s.position[i].x += 8 + (float)i;
        for (int i = 0; i < corners; i++) s.index[i] = (uint32_t)rnd_int(0, SHAPE_VERTICES - 1);
        shape_close(&s, SHAPE_VERTICES, corners);
        CHECK_INT(shade_mesh_normals(&s.mesh, vertex), SHADE_OK);
        CHECK_INT(shade_mesh_corner_normals(&s.mesh, -1, corner, memory, sizeof memory), SHADE_OK);
        for (int t = 0; t < corners / 3; t++)
            face[t] = shade_face_normal(s.position[s.index[3 * t]], s.position[s.index[3 * t + 1]],
                                        s.position[s.index[3 * t + 2]]);
        for (int i = 0; i < corners; i++) {
            const shade_vec3 *n = &vertex[s.index[i]];
            if (shade_dot(corner[i], corner[i]) < 0.5f) continue; /* its face does not count */
            if (shape_opposed(&s, face, i)) continue;
            CHECK(!memcmp(n, &corner[i], sizeof *n));
            compared++;
        }
    }
    CHECK(compared > 50000);
}

/* ---------------------------------------------------------------------------- boxes and cameras */

/* Some vertices belong to no triangle; some corners are NaN or infinite, or all of them. */
TEST(shape, bounds_are_those_of_the_finite_corners_of_triangles)
{
    int none = 0;
    for (int i = 0; i < 2000; i++) {
        static shape_mesh s;
        d3 low = d3_of(INFINITY, INFINITY, INFINITY), high = d3_scale(low, -1);
        shade_vec3 got_low, got_high;
        random_shape(&s);
        s.mesh.index_count = 3 * rnd_int(0, s.mesh.index_count / 3);
        for (int k = 0; k < s.mesh.vertex_count; k++) {
            s.position[k] = random_vector((double)rnd_log(1e-3, 1e30));
            if (rnd_one_in(i % 5 ? 9 : 1))
                s.position[k] = with_axis(s.position[k], rnd_int(0, 2),
                                          rnd_one_in(2) ? (float)NAN : rnd_sign() * INFINITY);
        }
        for (int k = 0; k < s.mesh.index_count; k++) {
            const d3 p = d3_from(s.position[s.index[k]]);
            if (!isfinite(p.x) || !isfinite(p.y) || !isfinite(p.z)) continue;
            low = d3_of(fmin(low.x, p.x), fmin(low.y, p.y), fmin(low.z, p.z));
            high = d3_of(fmax(high.x, p.x), fmax(high.y, p.y), fmax(high.z, p.z));
        }
        if (low.x > high.x) {
            low = d3_of(1, 1, 1);
            high = d3_of(0, 0, 0);
            none++;
        }
        CHECK_INT(shade_mesh_bounds(&s.mesh, &got_low, &got_high), SHADE_OK);
        CHECK_VEC(got_low, low, 0);
        CHECK_VEC(got_high, high, 0);
        CHECK_INT(shade_mesh_bounds(&s.mesh, NULL, &got_high), SHADE_ERROR_ARGUMENT);
        CHECK_INT(shade_mesh_bounds(&s.mesh, &got_low, NULL), SHADE_ERROR_ARGUMENT);
    }
    CHECK(none > 200 && none < 1000);
}

/* Boxes that may be flat in any of their axes, at most ten times their size from the origin. */
static void random_box(shade_vec3 *low, shade_vec3 *high)
{
    const double size = (double)rnd_log(1e-3, 1e3);
    *low = random_vector(10 * size);
    *high = shade_add(*low, d3_round(d3_of(size * rnd_unit(), size * rnd_unit(), size)));
    for (int axis = 0; axis < 2; axis++)
        if (rnd_one_in(4)) *high = with_axis(*high, axis, coordinate(*low, axis));
}

/* How far inside of the nearest side of the picture the eight corners are, as a part of w, in
   double from the floats of the matrices. */
static double inside_picture(shade_mat4 projection, shade_mat4 view, shade_vec3 low,
                             shade_vec3 high)
{
    const dmat m = dmat_mul(dmat_from(projection), dmat_from(view));
    double least = 1e300;
    for (int k = 0; k < 8; k++) {
        const double in[4] = { (double)(k & 1 ? high : low).x, (double)(k & 2 ? high : low).y,
                               (double)(k & 4 ? high : low).z, 1 };
        double c[4];
        dmat_apply(m, in, c);
        least = fmin(least, (c[3] - fmax(fabs(c[0]), fabs(c[1]))) / fabs(c[3]));
    }
    return least;
}

TEST(shape, a_fitted_view_is_as_near_as_all_corners_of_the_box_stay_in_the_picture)
{
    int touching = 0;
    for (int i = 0; i < 20000; i++) {
        const shade_mat4 p = random_lens();
        const shade_vec3 side = random_vector((double)rnd_log(1e-6, 1e6));
        const shade_vec3 up = rnd_one_in(5) ? side : d3_round(rnd_direction());
        shade_vec3 low, high;
        random_box(&low, &high);
        const shade_mat4 view = shade_mat4_fit(p, low, high, side, up);
        const double inside = inside_picture(p, view, low, high);
        CHECK_SAY(inside >= -1e-12, "outside by %g of w", -inside);
        touching += inside < 1e-4;
        shade_mat4 nearer = view;
        nearer.col[3].z += 4e-7f * fabsf(view.col[3].z);
        CHECK(inside_picture(p, nearer, low, high) < 0);
        /* the middle straight ahead, the eye on that side, up upward */
        const d3 middle = d3_scale(d3_add(d3_from(low), d3_from(high)), 0.5);
        const d3 at = dmat_point(dmat_from(view), middle);
        const double reach = d3_max(middle) + fabs(at.z);
        CHECK(fabs(at.x) < 1e-6 * reach && fabs(at.y) < 1e-6 * reach);
        CHECK(dmat_direction(dmat_from(view), d3_unit(d3_from(side))).z > 0.999999);
        CHECK(dmat_direction(dmat_from(view), d3_unit(d3_from(up))).y > -1e-5);
    }
    CHECK_SAY(touching > 19700, "%d", touching); /* but where w is small beside the view's floats */
}

TEST(shape, a_view_fitted_without_perspective_is_one_diagonal_away)
{
    for (int i = 0; i < 2000; i++) {
        shade_mat4 p = shade_mat4_ortho(-2, 3, -1, 2, rnd_float(1, 5), rnd_float(6, 9));
        shade_vec3 low, high;
        random_box(&low, &high);
        if (i % 3 == 0) memset(&p, 0, sizeof p);    /* the identity in a draw state */
        if (i % 3 == 1) p.col[2].x = rnd_float(-1, 1);    /* oblique */
        const shade_mat4 view = shade_mat4_fit(p, low, high, d3_round(rnd_direction()),
                                               d3_round(rnd_direction()));
        const d3 middle = d3_scale(d3_add(d3_from(low), d3_from(high)), 0.5);
        const double diagonal = d3_length(d3_sub(d3_from(high), d3_from(low)));
        CHECK_VEC(d3_round(dmat_point(dmat_from(view), middle)), d3_of(0, 0, -diagonal),
                  1e-5 * (diagonal + d3_max(middle)));
    }
}

TEST(shape, nothing_to_fit_gives_the_identity)
{
    const shade_mat4 p = shade_mat4_perspective(1, 1, 1, 9), one = shade_mat4_identity();
    const float bad[3] = { (float)NAN, INFINITY, -INFINITY };
    for (int k = 0; k < 12 * 3; k++) {
        shade_vec3 v[4] = { { -1, -1, -1 }, { 1, 1, 1 }, { 0, 1, 2 }, { 0, 1, 0 } };
        v[k / 9] = with_axis(v[k / 9], k / 3 % 3, bad[k % 3]);
        const shade_mat4 view = shade_mat4_fit(p, v[0], v[1], v[2], v[3]);
        CHECK(!memcmp(&view, &one, sizeof one));
    }
    for (int axis = 0; axis < 3; axis++) {
        const shade_vec3 low = with_axis(shade_v3(-1, -1, -1), axis, 1.0001f);
        const shade_mat4 view = shade_mat4_fit(p, low, shade_v3(1, 1, 1), shade_v3(0, 0, 1),
                                               shade_v3(0, 1, 0));
        CHECK(!memcmp(&view, &one, sizeof one));
    }
    for (int i = 0; i < 3000; i++) { /* any bits: a view or the identity, but finite */
        shade_vec3 v[4];
        float f[16];
        for (int k = 0; k < 12; k++) (&v[0].x)[k] = rnd_one_in(2) ? rnd_nasty() : rnd_float(-2, 2);
        for (int k = 0; k < 16; k++) f[k] = rnd_nasty();
        shade_mat4 any;
        memcpy(&any, f, sizeof any);
        CHECK(finite_mat4(shade_mat4_fit(any, v[0], v[1], v[2], v[3])));
    }
}
