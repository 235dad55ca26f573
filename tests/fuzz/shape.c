/* shape.c - what a mesh knows of its shape, rays and what they meet, supersampling and other
   formats, clearing and pictures as PPM. */
#include "picture.h"
#include <math.h>

enum { SHAPE_VERTICES = 48, SHAPE_TRIANGLES = 64 };

typedef struct shape_mesh {
    shade_mesh m;
    int corners;
    shade_result want;                   /* of the mesh alone */
    float most;                          /* bound of the positions; 0: none */
} shape_mesh;

static uint32_t shape_corner(const shade_mesh *m, int i)
{
    if (m->indices16) return m->indices16[i];
    return m->indices ? m->indices[i] : (uint32_t)i;
}

static shade_vec3 shape_position(const shade_mesh *m, uint32_t v)
{
    shade_vec3 p;
    size_t step = m->position_stride ? (size_t)m->position_stride : 12;
    memcpy(&p, (const char *)m->positions + step * v, 12);
    return p;
}

/* Nearly the same position: the sign of a zero, or a single bit. */
static void shape_nudge(shade_vec3 *v, uint32_t kind)
{
    float *c = kind & 1 ? &v->x : kind & 2 ? &v->y : &v->z;
    uint32_t bits;
    memcpy(&bits, c, 4);
    bits ^= bits << 1 ? (kind & 4 ? 1u : kind & 8 ? 0x100u : 0x10000u) : 0x80000000u;
    memcpy(c, &bits, 4);
}

static shape_mesh shape_open(fuzz_input *in)
{
    uint32_t kind = fuzz_byte(in), *indices = NULL;
    int n = fuzz_int(in, 0, SHAPE_VERTICES);
    size_t step = kind & 1 ? 12 + 4 * (size_t)fuzz_int(in, 0, 3) : 12;
    char *p = (char *)guard_take(n ? ((size_t)n - 1) * step + 12 : 0, kind >> 1 & 1);
    shape_mesh s = { .most = kind & 4 ? 1e6f : 0, .want = SHADE_OK };
    if (n) memset(p, 0xEE, ((size_t)n - 1) * step + 12);
    for (int i = 0; i < n; i++) {
        uint32_t again = fuzz_byte(in);
        shade_vec3 v;
        if (again > 127 && i) memcpy(&v, p + step * (again % (uint32_t)i), 12);    /* a seam */
        else v = fuzz_vec3(in, s.most);
        if (again > 191) shape_nudge(&v, again);
        memcpy(p + step * (size_t)i, &v, 12);
    }
    guard_seal(p);
    s.m.positions = (float *)(void *)p;
    s.m.vertex_count = n;
    s.m.position_stride = kind & 1 ? (int)step : 0;
    s.corners = n;
    if (kind & 8) {
        s.corners = 3 * fuzz_int(in, 0, SHAPE_TRIANGLES) + (fuzz_one_in(in, 32) ? 1 : 0);
        indices = (uint32_t *)guard_take((size_t)s.corners * 4, kind >> 4 & 1);
        for (int i = 0; i < s.corners; i++) {
            uint32_t k = fuzz_byte(in);
            indices[i] = k == 255 ? (uint32_t)fuzz_wild_int(in) : n ? k % (uint32_t)n : 0;
            if (indices[i] >= (uint32_t)n) s.want = SHADE_ERROR_INDEX;
        }
        guard_seal(indices);
    }
    if (kind & 32 && indices) s.m.indices16 = guard_narrow(indices, s.corners, kind >> 4 & 1);
    s.m.indices = s.m.indices16 ? NULL : indices;
    s.m.index_count = indices ? s.corners : fuzz_wild_int(in);
    if (s.corners % 3) s.want = SHADE_ERROR_INDEX;
    if ((kind & 0xE0) != 0xE0) return s;
    switch (fuzz_byte(in) % 8) {
        case 5:
            if (s.m.indices16) {
                s.m.indices = indices;
                s.want = SHADE_ERROR_MESH;
            }
            break;
        case 0:
            s.m.vertex_count = -1;
            s.want = SHADE_ERROR_MESH;
            break;
        case 1:
            s.m.position_stride = -4;
            s.want = SHADE_ERROR_MESH;
            break;
        case 2:
            s.m.color_stride = 6;
            s.want = SHADE_ERROR_MESH;
            break;
        case 3:
            if (n) {
                s.m.positions = NULL;
                s.want = SHADE_ERROR_MESH;
            }
            break;
        case 4:
            if (indices) {
                s.m.index_count = -3;
                s.want = SHADE_ERROR_MESH;
            }
            break;
        default: break;
    }
    return s;
}

/* unit or zero, where the positions are tame */
static void shape_check_normals(const shape_mesh *s, const shade_vec3 *n, int count)
{
    for (int i = 0; s->most > 0 && i < count; i++) {
        float l = shade_length(n[i]);
        HOLDS(l == 0 || fabsf(l - 1) < 1e-4f);
    }
}

static void shape_normals(fuzz_input *in, const shape_mesh *s)
{
    uint32_t kind = fuzz_byte(in);
    int n = s->m.vertex_count > 0 ? s->m.vertex_count : 0;
    shade_vec3 *out = (shade_vec3 *)guard_take((size_t)n * 12, kind & 1);
    fuzz_noise(out, (size_t)n * 12, 3);
    HOLDS(shade_mesh_normals(&s->m, NULL) == SHADE_ERROR_ARGUMENT);
    HOLDS(shade_mesh_normals(&s->m, out) == s->want);
    if (s->want == SHADE_OK) shape_check_normals(s, out, n);
}

static shade_vec3 shape_at(const shape_mesh *s, int corner)
{
    return shape_position(&s->m, shape_corner(&s->m, corner));
}

/* Adds sign x y to a number in limbs of 24 bits, the lowest 2^-348. */
static void shape_add(int64_t *limb, int sign, float x, float y)
{
    int ex, ey;
    const int64_t mx = (int64_t)ldexp(frexp((double)x, &ex), 24) * sign;
    const int64_t my = (int64_t)ldexp(frexp((double)y, &ey), 24);
    const int64_t product = mx * my, high = product / (1 << 24), low = product % (1 << 24);
    const int shift = ex + ey - 48 + 348;
    limb[shift / 24] += low * (1 << shift % 24);
    limb[shift / 24 + 1] += high * (1 << shift % 24);
}

/* Whether a triangle's three points are finite and lie on a line, in integers: all three sums of
   products in (b - a) x (c - a) are 0. */
static int shape_flat(shade_vec3 a, shade_vec3 b, shade_vec3 c)
{
    const float p[3][3] = { { a.x, a.y, a.z }, { b.x, b.y, b.z }, { c.x, c.y, c.z } };
    for (int k = 0; k < 9; k++)
        if (!isfinite(p[k / 3][k % 3])) return 0;
    for (int i = 0; i < 3; i++) {
        int64_t limb[32] = { 0 };
        const int j = (i + 1) % 3;
        for (int k = 0; k < 3; k++) {
            shape_add(limb, 1, p[k][i], p[(k + 1) % 3][j]);
            shape_add(limb, -1, p[k][j], p[(k + 1) % 3][i]);
        }
        for (int k = 0; k < 31; k++) {
            if (limb[k] % (1 << 24)) return 0;
            limb[k + 1] += limb[k] / (1 << 24);
        }
    }
    return 1;
}

/* Zero for corners in a line: shade_face_normal alone would make a normal of rounding noise. */
static shade_vec3 shape_face(const shape_mesh *s, int t)
{
    const shade_vec3 a = shape_at(s, 3 * t), b = shape_at(s, 3 * t + 1), c = shape_at(s, 3 * t + 2);
    const shade_vec3 n = shade_face_normal(a, b, c);
    return !shape_flat(a, b, c) && shade_dot(n, n) <= 2 ? n : shade_v3(0, 0, 0);
}

static double shape_angle(const shape_mesh *s, int corner)
{
    int t = corner / 3 * 3, k = corner % 3;
    shade_vec3 p = shape_at(s, corner);
    shade_vec3 a = shade_normalize(shade_sub(shape_at(s, t + (k + 1) % 3), p));
    shade_vec3 b = shade_normalize(shade_sub(shape_at(s, t + (k + 2) % 3), p));
    return atan2((double)shade_length(shade_cross(a, b)), (double)shade_dot(a, b));
}

/* Every pair of corners: where the mean is not next to nothing, it is what all of them say. */
static void shape_check_corner_normals(const shape_mesh *s, float crease, const shade_vec3 *got)
{
    for (int i = 0; i < s->corners; i++) {
        shade_vec3 p = shape_at(s, i), n = shape_face(s, i / 3);
        double mean[3] = { 0, 0, 0 }, length, weights = 0;
        for (int j = 0; j < s->corners; j++) {
            shade_vec3 q = shape_at(s, j), other = shape_face(s, j / 3);
            double angle = shape_angle(s, j);
            if (i != j && !(p.x == q.x && p.y == q.y && p.z == q.z)) continue;
            if (i != j && !(shade_dot(n, other) >= crease)) continue;
            if (!(angle >= 0)) angle = 0; /* beside a corner that is not finite */
            mean[0] += angle * (double)other.x;
            mean[1] += angle * (double)other.y;
            mean[2] += angle * (double)other.z;
            weights += angle;
        }
        length = sqrt(mean[0] * mean[0] + mean[1] * mean[1] + mean[2] * mean[2]);
        if (!(length > 1e-3 * weights && length > 1e-6)) continue;
        HOLDS(fabs((double)got[i].x - mean[0] / length) < 1e-3);
        HOLDS(fabs((double)got[i].y - mean[1] / length) < 1e-3);
        HOLDS(fabs((double)got[i].z - mean[2] / length) < 1e-3);
    }
}

static void shape_corner_normals(fuzz_input *in, const shape_mesh *s)
{
    uint32_t kind = fuzz_byte(in);
    float crease = kind & 4 ? fuzz_float(in) : (float)((int)fuzz_byte(in) - 128) / 127;
    size_t need = shade_mesh_corner_normals_bytes(&s->m), bytes = need;
    shade_vec3 *out = (shade_vec3 *)guard_take((size_t)s->corners * 12, kind & 1);
    void *memory;
    shade_result want = s->want;
    HOLDS((need == 0) == (s->want != SHADE_OK || !s->corners));
    if ((kind & 0xF0) == 0xF0 && need) bytes = fuzz_byte(in) % need;
    memory = guard_take((bytes + 3) & ~(size_t)3, kind >> 1 & 1);
    fuzz_noise(memory, (bytes + 3) & ~(size_t)3, 4);
    if (want != SHADE_ERROR_MESH && crease != crease) want = SHADE_ERROR_STATE;
    if (want == SHADE_OK && bytes < need) want = SHADE_ERROR_CAPACITY;
    HOLDS(shade_mesh_corner_normals(&s->m, crease, out, memory, bytes) == want);
    if (want != SHADE_OK) return;
    shape_check_normals(s, out, s->corners);
    if (s->corners <= 48) shape_check_corner_normals(s, crease, out);
}

/* How many entries of an edge name a triangle */
static int shape_named(const shade_edge *edges, int count, uint32_t a, uint32_t b, int triangle)
{
    int named = 0;
    for (int i = 0; i < count; i++)
        if (edges[i].a == (a < b ? a : b) && edges[i].b == (a < b ? b : a))
            named += (edges[i].triangle[0] == triangle) + (edges[i].triangle[1] == triangle);
    return named;
}

static void shape_edges(fuzz_input *in, const shape_mesh *s)
{
    uint32_t kind = fuzz_byte(in);
    int capacity = s->corners, count = 77, shape = s->corners / 3;
    shade_edge *edges;
    shade_result want = s->want;
    if (kind & 2) capacity = fuzz_int(in, -1, s->corners);
    edges = (shade_edge *)guard_take(sizeof *edges * (size_t)(capacity > 0 ? capacity : 0),
                                     kind & 1);
    if (capacity < 0) want = SHADE_ERROR_ARGUMENT;
    if (want == SHADE_OK && capacity < s->corners) want = SHADE_ERROR_CAPACITY;
    HOLDS(shade_mesh_edges(&s->m, edges, capacity, NULL) == SHADE_ERROR_ARGUMENT);
    HOLDS(shade_mesh_edges(&s->m, edges, capacity, &count) == want);
    if (want == SHADE_ERROR_CAPACITY) HOLDS(count > capacity && count <= s->corners);
    if (want != SHADE_OK) return;
    HOLDS(count >= 0 && count <= capacity);
    for (int i = 0; i < count; i++) {
        const shade_edge *e = &edges[i];
        HOLDS(e->a < e->b && e->b < (uint32_t)s->m.vertex_count);
        HOLDS(e->triangle[0] >= 0 && e->triangle[0] < shape);
        HOLDS(e->triangle[1] >= -1 && e->triangle[1] < shape && e->triangle[1] != e->triangle[0]);
        if (i) HOLDS(e[-1].a < e->a || (e[-1].a == e->a && e[-1].b <= e->b));
    }
    for (int i = 0; i < s->corners; i++) {
        uint32_t a = shape_corner(&s->m, i);
        uint32_t b = shape_corner(&s->m, i % 3 == 2 ? i - 2 : i + 1);
        HOLDS(shape_named(edges, count, a, b, i / 3) == (a != b));
    }
}

/* Whether a ray lies in the plane of a triangle but for a millionth, or t is denormal: rounding
   decides where it is hit, and pick lets go what it would hit beside its box. */
static int shape_grazes(shade_ray ray, const shade_vec3 *p, float t)
{
    double e[3], f[3], d[3] = { (double)ray.direction.x, (double)ray.direction.y,
                                (double)ray.direction.z };
    double det = 0, ee = 0, ff = 0, dd = 0;
    e[0] = (double)p[1].x - (double)p[0].x;
    f[0] = (double)p[2].x - (double)p[0].x;
    e[1] = (double)p[1].y - (double)p[0].y;
    f[1] = (double)p[2].y - (double)p[0].y;
    e[2] = (double)p[1].z - (double)p[0].z;
    f[2] = (double)p[2].z - (double)p[0].z;
    for (int k = 0; k < 3; k++) {
        const int a = (k + 1) % 3, b = (k + 2) % 3;
        det += d[k] * (e[a] * f[b] - e[b] * f[a]);
        ee += e[k] * e[k];
        ff += f[k] * f[k];
        dd += d[k] * d[k];
    }
    return !(fabs(det) > 1e-6 * sqrt(ee) * sqrt(ff) * sqrt(dd)) || (t > 0 && t < 1e-30f);
}

/* The nearest of the triangles with an area that shade_intersect hits, of equal ones the first. */
static void shape_pick(fuzz_input *in, const shape_mesh *s, shade_ray ray)
{
    uint32_t kind = fuzz_byte(in);
    shade_mat4 model = fuzz_matrix(in, kind & 1 ? s->most : 0), place = model;
    float t = -7, nearest = -7, at;
    shade_vec3 where = shade_v3(-7, -7, -7), want = where, inside, d = ray.direction,
               o = ray.origin;
    int got, found = -1, zeros = 0, unsure = 0;
    for (int k = 0; k < 16; k++) zeros += (&model.col[0].x)[k] == 0;
    if (zeros == 16) place = shade_mat4_identity();
    if (s->want == SHADE_OK) {
        for (int i = 0; i < s->corners / 3; i++) {
            shade_vec3 p[3];
            for (int k = 0; k < 3; k++)
                p[k] = shade_mat4_transform_point(place, shape_at(s, 3 * i + k));
            if (!shade_intersect(ray, p[0], p[1], p[2], &at, &inside)) continue;
            if (shape_flat(shape_at(s, 3 * i), shape_at(s, 3 * i + 1), shape_at(s, 3 * i + 2)))
                continue;    /* rounding may have parted the points as they were turned */
            unsure |= shape_grazes(ray, p, at);
            if (found < 0 || at < nearest) {
                found = i;
                nearest = at;
                want = inside;
            }
        }
    }
    got = shade_pick(&s->m, model, ray, kind & 4 ? NULL : &t, kind & 8 ? NULL : &where);
    HOLDS(got < s->corners / 3 && (got < 0 || found >= 0));
    if (unsure) return;
    HOLDS(got == found);
    HOLDS(shade_pick(NULL, model, ray, &at, &inside) == -1);
    if ((d.x == 0 && d.y == 0 && d.z == 0) || !fuzz_finite3(d) || !fuzz_finite3(o))
        HOLDS(got == -1);
    HOLDS(t == (kind & 4 ? -7 : nearest));
    HOLDS(kind & 8 ? where.x == -7 : !memcmp(&where, &want, sizeof want));
}

/* With chunks, in the order of the mesh or sorted: the same triangle, the same place. */
static void shape_chunks(fuzz_input *in, const shape_mesh *s, shade_ray ray)
{
    const uint32_t kind = fuzz_byte(in);
    const int size = fuzz_int(in, -1, 9), count = shade_chunk_count(s->corners, size);
    const int capacity = kind & 1 ? count : fuzz_int(in, -1, count);
    const size_t room = (size_t)(capacity > 0 ? capacity : 0);
    shade_chunk *c = (shade_chunk *)guard_take(room * sizeof *c, kind >> 1 & 1);
    const size_t corners = s->corners > 0 ? (size_t)s->corners : 0;
    uint32_t *sorted = kind & 4 ? (uint32_t *)guard_take(corners * 4, kind >> 3 & 1) : NULL;
    shade_mat4 model = fuzz_matrix(in, kind & 16 ? s->most : 0);
    shade_mesh m = s->m;
    shade_vec3 a = shade_v3(-7, -7, -7), b = a;
    float t = -7, u = -7;
    shade_result want = s->want;
    if (size < 0 || capacity < 0) want = SHADE_ERROR_ARGUMENT;
    if (want == SHADE_OK && capacity < count) want = SHADE_ERROR_CAPACITY;
    HOLDS(shade_mesh_chunks(&m, size, c, capacity, sorted) == want);
    if (want != SHADE_OK) return;
    for (int i = 0; i < count; i++) HOLDS(c[i].first == (i ? c[i - 1].first + c[i - 1].count : 0));
    if (sorted && corners) {
        m.indices = sorted;
        m.indices16 = NULL;
        m.index_count = s->corners;
    }
    const int found = shade_pick(&m, model, ray, &t, &a);
    m.chunks = c;
    m.chunk_count = count;
    HOLDS(shade_pick(&m, model, ray, &u, &b) == found);
    HOLDS(t == u && !memcmp(&a, &b, sizeof a));
}

static void shape_rays(fuzz_input *in, const shape_mesh *s)
{
    uint32_t kind = fuzz_byte(in);
    float most = kind & 1 ? 1e3f : 0;
    shade_mat4 view = fuzz_matrix(in, most), projection = fuzz_matrix(in, most);
    int w = kind & 2 ? fuzz_wild_int(in) : 40, h = kind & 4 ? fuzz_wild_int(in) : 30;
    float x = fuzz_value(in, most), y = fuzz_value(in, most), t = -7, l;
    shade_ray ray = shade_pixel_ray(view, projection, w, h, x, y);
    shade_vec3 at = shade_v3(-7, -7, -7);
    l = shade_length(ray.direction);
    if (most > 0 && fuzz_is_no_camera(projection)) HOLDS(l == 0);
    if (most > 0 && fuzz_finite3(ray.direction)) HOLDS(l == 0 || fabsf(l - 1) < 1e-4f);
    if (kind & 8) {
        ray.origin = fuzz_vec3(in, most);
        ray.direction = fuzz_vec3(in, most);
    }
    shape_pick(in, s, ray);
    shape_chunks(in, s, ray);
    for (int i = 0; s->want == SHADE_OK && i + 2 < s->corners; i += 3) {
        int hit = shade_intersect(ray, shape_at(s, i), shape_at(s, i + 1), shape_at(s, i + 2),
                                  kind & 16 ? NULL : &t, kind & 32 ? NULL : &at);
        HOLDS(hit == 0 || hit == 1);
        if (!hit) continue;
        HOLDS(!shape_flat(shape_at(s, i), shape_at(s, i + 1), shape_at(s, i + 2)));
        if (!(kind & 16)) HOLDS(t >= 0 && t <= FLT_MAX);
        if (kind & 32) continue;
        HOLDS(at.x >= 0 && at.y >= 0 && at.z >= 0 && at.x <= 1 && at.y <= 1 && at.z <= 1);
        HOLDS(fabsf(at.x + at.y + at.z - 1) < 1e-5f);
    }
}

/* in is a picture of its own; the smaller one is made for it, and its neighbours stay. */
static void shape_resolve(fuzz_input *in)
{
    picture out, big;
    int factor = fuzz_int(in, 1, 9);
    shade_result want;
    picture_open(in, &out, 9);
    picture_times(in, &out, &big, factor);
    want = out.want != SHADE_OK ? out.want : big.want;
    if (want == SHADE_OK && (!out.color || !big.color)) want = SHADE_ERROR_TARGET;
    if (want == SHADE_OK &&
        (factor > 8 || big.target.width != out.target.width * factor ||
         big.target.height != out.target.height * factor ||
         big.target.row_offset != out.target.row_offset * factor || big.rows != out.rows * factor))
        want = SHADE_ERROR_ARGUMENT;
    HOLDS(shade_resolve(&out.target, &big.target, factor) == want);
    HOLDS(picture_unchanged(&big));
    if (want != SHADE_OK) HOLDS(picture_unchanged(&out));
    else picture_check(&out);
    if (out.depth) HOLDS(!memcmp(out.depth, out.before + out.color_bytes, out.depth_bytes));
    picture_close(&out);
    picture_close(&big);
}

/* A picture in another format of equal pixels, where it lies: as into a picture of its own. */
static void shape_convert(fuzz_input *in)
{
    static const uint8_t twin[FUZZ_FORMATS] = { 1, 0, 3, 2, 4 };
    picture p;
    shade_target from, apart;
    uint32_t kind;
    uint8_t *copy;
    picture_open(in, &p, 24);
    kind = fuzz_byte(in);
    from = apart = p.target;
    if (p.want == SHADE_OK && p.color) {
        if (kind & 1) from.format = (shade_format)twin[from.format];
        if (kind & 2) from.srgb = !from.srgb;
        copy = (uint8_t *)guard_take(p.color_bytes, kind >> 2 & 1);
        memcpy(copy, p.color, p.color_bytes);
        apart.color = copy;
        HOLDS(shade_resolve(&apart, &from, 1) == SHADE_OK);
        HOLDS(picture_unchanged(&p));
        HOLDS(shade_resolve(&p.target, &from, 1) == SHADE_OK);
        HOLDS(!memcmp(copy, p.color, p.color_bytes));
        picture_check(&p);
        if (!p.target.dither && !(kind & 2) && p.target.format != SHADE_FORMAT_RGBA32F) {
            from.format = p.target.format; /* and nothing is lost on the way back */
            apart.format = kind & 1 ? (shade_format)twin[from.format] : from.format;
            from.color = apart.color = p.color;
            from.dither = apart.dither = 0;
            HOLDS(shade_resolve(&apart, &from, 1) == SHADE_OK);
            HOLDS(picture_unchanged(&p));
        }
    }
    picture_close(&p);
}

typedef struct shape_sink { size_t bytes, fails_at; int calls; } shape_sink;
static int shape_write(void *user, const void *bytes, size_t size)
{
    shape_sink *s = (shape_sink *)user;
    const uint8_t *p = (const uint8_t *)bytes;
    uint32_t sum = 0;
    for (size_t i = 0; i < size; i++) sum += p[i];    /* touches all of them */
    s->calls++;
    s->bytes += size;
    return s->bytes > s->fails_at ? 1 + (int)(sum & 1) : 0;
}

static void shape_clear_and_encode(fuzz_input *in)
{
    picture p;
    shape_sink sink = { 0, SIZE_MAX, 0 };
    char head[32];
    shade_vec4 color = fuzz_vec4(in, 0);
    float depth = fuzz_float(in);
    size_t size;
    shade_result want;
    int x0, y0, x1, y1, n;
    picture_open(in, &p, 40);
    if (fuzz_one_in(in, 4)) sink.fails_at = fuzz_byte(in);
    want = p.want == SHADE_OK && depth != depth ? SHADE_ERROR_ARGUMENT : p.want;
    HOLDS(shade_clear(&p.target, color, depth) == want);
    if (want != SHADE_OK) HOLDS(picture_unchanged(&p));
    else {
        size_t cell = fuzz_pixel_bytes(p.target.format);
        picture_clip(&p.target, &x0, &y0, &x1, &y1);
        for (int y = p.target.row_offset; y < p.target.row_offset + p.rows; y++) {
            size_t at = (size_t)(y - p.target.row_offset) * (size_t)p.stride;
            int row = y >= y0 && y < y1, l = row ? x0 : 0, r = row ? x1 : 0;
            if (p.color) picture_row_outside(p.color, p.before, p.color_bytes, at * cell,
                                             (at + (size_t)p.stride) * cell, l, r, cell);
            if (p.depth) picture_row_outside(p.depth, p.before + p.color_bytes, p.depth_bytes,
                                             at * 4, (at + (size_t)p.stride) * 4, l, r, 4);
            for (int x = l; x < r && p.depth; x++)
                HOLDS(!memcmp(p.depth + (at + (size_t)x) * 4, &depth, 4));
        }
    }
    picture_keep(&p);
    want = p.want == SHADE_OK && !p.color ? SHADE_ERROR_TARGET : p.want;
    n = snprintf(head, sizeof head, "P6\n%d %d\n255\n", p.target.width, p.rows);
    size = (size_t)n + (want == SHADE_OK ? 3 * (size_t)p.target.width * (size_t)p.rows : 0);
    if (want == SHADE_OK && sink.fails_at < size) want = SHADE_ERROR_IO;
    HOLDS(shade_encode_ppm(shape_write, &sink, &p.target) == want);
    if (want == SHADE_OK) HOLDS(sink.bytes == size);
    else if (want != SHADE_ERROR_IO) HOLDS(!sink.calls);

    sink.bytes = 0;
    sink.calls = 0;
    if (want == SHADE_ERROR_IO) want = SHADE_OK;
    HOLDS(shade_encode_png(shape_write, &sink, &p.target) ==
          (want == SHADE_OK && sink.bytes > sink.fails_at ? SHADE_ERROR_IO : want));
    if (want != SHADE_OK) HOLDS(!sink.calls);
    else if (sink.bytes <= sink.fails_at)
        HOLDS(100 * sink.bytes <= 113 * size + 9000 + 100 * (size_t)p.rows);
    HOLDS(picture_same(&p));
    picture_close(&p);
}

/* Boxes hold every finite corner, and the view of anything is finite. */
static void shape_fit(fuzz_input *in, const shape_mesh *s)
{
    const uint32_t kind = fuzz_byte(in);
    const float most = kind & 1 ? 1e3f : 0;
    const shade_mat4 projection = fuzz_matrix(in, most);
    shade_vec3 low = shade_v3(-7, -7, -7), high = low;
    HOLDS(shade_mesh_bounds(&s->m, NULL, &high) == SHADE_ERROR_ARGUMENT);
    HOLDS(shade_mesh_bounds(&s->m, &low, &high) == s->want);
    for (int k = 0; s->want == SHADE_OK && k < s->corners; k++) {
        const shade_vec3 p = shape_at(s, k);
        if (!fuzz_finite3(p)) continue;
        HOLDS(p.x >= low.x && p.y >= low.y && p.z >= low.z);
        HOLDS(p.x <= high.x && p.y <= high.y && p.z <= high.z);
    }
    if (kind & 2) low = fuzz_vec3(in, most);
    if (kind & 4) high = fuzz_vec3(in, most);
    const shade_vec3 side = fuzz_vec3(in, most);
    const shade_mat4 view = shade_mat4_fit(projection, low, high, side, fuzz_vec3(in, most));
    for (int k = 0; k < 16; k++) HOLDS(isfinite((&view.col[0].x)[k]));
    if (!(low.x <= high.x && low.y <= high.y && low.z <= high.z))
        HOLDS(view.col[3].z == 0 && view.col[0].x == 1);
}

int LLVMFuzzerTestOneInput(const uint8_t *data, size_t size)
{
    fuzz_input in = { data, data + size };
    uint32_t kind = fuzz_byte(&in);
    fuzz_level = (int)(kind >> 4) % (fuzz_widest() + 1);
    if (kind % 8 == 5)
        shape_convert(&in);
    else if (kind % 8 == 6)
        shape_resolve(&in);
    else if (kind % 8 == 7) shape_clear_and_encode(&in);
    else {
        shape_mesh s = shape_open(&in);
        shape_normals(&in, &s);
        shape_corner_normals(&in, &s);
        shape_edges(&in, &s);
        shape_rays(&in, &s);
        shape_fit(&in, &s);
    }
    guard_close();
    return 0;
}
