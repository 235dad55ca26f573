/* reader.c - the OBJ, STL, PLY, OFF, glTF and 3MF readers of examples/kit/read/files.h: any bytes
   give a valid model, which a section leaves valid, or an error.  XML is put into an archive, for
   few damaged archives have the checksums of what they hold. */
#include "input.h"
#include "examples/kit/draw/section.h"

static void reader_check_mesh(const owned_mesh *m)
{
    const shade_mesh *v = &m->view;
    HOLDS(v->vertex_count > 0 && v->index_count > 0 && v->index_count % 3 == 0);
    HOLDS(m->positions && m->normals && m->indices);
    HOLDS(v->positions == m->positions && v->normals == m->normals && v->indices == m->indices);
    for (int i = 0; i < v->index_count; i++) HOLDS(m->indices[i] < (uint32_t)v->vertex_count);
    for (size_t i = 0; i < 3 * (size_t)v->vertex_count; i++) {
        HOLDS(fuzz_finite(m->positions[i]) && fuzz_finite(m->normals[i]));
        HOLDS(!m->colors || fuzz_finite(m->colors[i]));
    }
    for (size_t i = 0; m->texcoords && i < 2 * (size_t)v->vertex_count; i++)
        HOLDS(fuzz_finite(m->texcoords[i]));
}

/* The parts hold every triangle once, each of a surface that is there. */
static void reader_check_parts(const model *m)
{
    int next = 0;
    for (int i = 0; i < m->part_count; i++) {
        const model_part *p = &m->part[i];
        HOLDS(p->first == next && p->count > 0 && p->count % 3 == 0);
        HOLDS(p->surface >= 0 && (p->surface < m->surface_count || !p->surface));
        next += p->count;
    }
    HOLDS(next == m->mesh.view.index_count);
}

static void reader_check_error(const char *error, size_t size, const char *name)
{
    size_t length = 0, prefix = strlen(name);
    if (!size) return;
    while (length < size && error[length]) length++;
    HOLDS(length > 0 || size == 1);
    HOLDS(length < size);
    for (size_t i = 0; i < length; i++) HOLDS(error[i] != '\n' && error[i] != '\r');
    if (size > prefix) HOLDS(!strncmp(error, name, prefix));
}

static int reader_same(const owned_mesh *a, const owned_mesh *b)
{
    size_t n = (size_t)a->view.vertex_count, i = (size_t)a->view.index_count;
    return a->view.vertex_count == b->view.vertex_count &&
           a->view.index_count == b->view.index_count && !a->colors == !b->colors &&
           !a->texcoords == !b->texcoords && !memcmp(a->positions, b->positions, 12 * n) &&
           !memcmp(a->normals, b->normals, 12 * n) && !memcmp(a->indices, b->indices, 4 * i) &&
           (!a->colors || !memcmp(a->colors, b->colors, 12 * n)) &&
           (!a->texcoords || !memcmp(a->texcoords, b->texcoords, 8 * n));
}

/* Text says the same with other line ends.  STL and PLY are left out: binary ones are no lines. */
static void reader_line_ends(const uint8_t *bytes, size_t size, const char *name, int result,
                             const owned_mesh *m)
{
    uint8_t *other = (uint8_t *)malloc(2 * size + 1);
    size_t n = 0;
    owned_mesh again;
    char error[64];
    int returns = memchr(bytes, '\r', size) != NULL, zeros = memchr(bytes, 0, size) != NULL;
    size_t own = size;
    const uint8_t *text = model_text_of(bytes, &own); /* behind a byte order mark */
    int binary = mesh_is_stl(name, text, own) || mesh_is_ply(name, text, own) ||
                 mesh_is_threemf(name, text, own) || (own >= 4 && !memcmp(text, "glTF", 4));
    if (!other) exit(2);
    for (size_t i = 0; i < size; i++) {
        if (bytes[i] == '\n') other[n++] = '\r';
        other[n++] = bytes[i];
    }
    if (!returns && !zeros && !binary) {
        HOLDS(mesh_read_memory(other, n, name, &again, error, sizeof error) == result);
        if (!result) HOLDS(reader_same(m, &again));
        if (!result) mesh_free(&again);
    }
    free(other);
}

static uint8_t *reader_put(uint8_t *to, uint32_t value, int bytes)
{
    for (int k = 0; k < bytes; k++) *to++ = (uint8_t)(k < 4 ? value >> 8 * k : 0);
    return to;
}

/* The head of a file in an archive, or its entry in the directory. */
static uint8_t *reader_head(uint8_t *to, const uint8_t *bytes, size_t n, const char *name,
                            int where)
{
    to = reader_put(to, where < 0 ? 0x04034B50 : 0x02014B50, 4);
    to = reader_put(to, 20, where < 0 ? 2 : 4);
    to = reader_put(to, 0, 4);
    to = reader_put(to, 0, 4);
    to = reader_put(to, zip_crc(0, bytes, n), 4);
    to = reader_put(to, (uint32_t)n, 4);
    to = reader_put(to, (uint32_t)n, 4);
    to = reader_put(to, (uint32_t)strlen(name), 2);
    to = reader_put(to, 0, where < 0 ? 2 : 12);
    if (where >= 0) to = reader_put(to, (uint32_t)where, 4);
    memcpy(to, name, strlen(name));
    return to + strlen(name);
}

/* An archive of up to three files, which are bytes apart by zeros.  The caller frees it. */
static uint8_t *reader_archive(const uint8_t *bytes, size_t n, size_t *size)
{
    static const char *const names[3] = { "3D/3dmodel.model", "3D/1.model", "a.png" };
    uint8_t *made = (uint8_t *)malloc(n + 1024), *to = made;
    const uint8_t *part[4] = { bytes, NULL, NULL, NULL };
    int where[3], count = 0;
    uint32_t directory;
    if (!made) exit(2);
    while (count < 3 && part[count]) {
        const size_t left = (size_t)(bytes + n - part[count]);
        const uint8_t *zero = count < 2 ? (const uint8_t *)memchr(part[count], 0, left) : NULL;
        const size_t own = zero ? (size_t)(zero - part[count]) : left;
        where[count] = (int)(to - made);
        to = reader_head(to, part[count], own, names[count], -1);
        memcpy(to, part[count], own);
        to += own;
        part[++count] = zero ? zero + 1 : NULL;
    }
    directory = (uint32_t)(to - made);
    for (int i = 0; i < count; i++) {
        const size_t own = part[i + 1] ? (size_t)(part[i + 1] - part[i]) - 1
                                       : (size_t)(bytes + n - part[i]);
        to = reader_head(to, part[i], own, names[i], where[i]);
    }
    *size = (size_t)(to - made) - directory;
    to = reader_put(to, 0x06054B50, 4);
    to = reader_put(to, 0, 4);
    to = reader_put(to, (uint32_t)count, 2);
    to = reader_put(to, (uint32_t)count, 2);
    to = reader_put(to, (uint32_t)*size, 4);
    to = reader_put(to, directory, 4);
    to = reader_put(to, 0, 2);
    *size = (size_t)(to - made);
    return made;
}

static void reader_progress(void *user, double part)
{
    HOLDS(part >= 0 && part <= 1);
    ++*(int *)user;
}

/* Cut through its middle, a model is one still, and nothing of it lies beyond the plane. */
static void reader_cut(model *m, uint32_t kind)
{
    const model_options options = model_options_new();
    section s = { .from = m, .axis = (int)(kind % 3), .sign = kind & 4 ? 1 : -1 };
    const double sign = s.sign;
    double low[3], high[3], where;
    mesh_box(&m->mesh, s.low, s.high);
    where = s.where = (s.low[s.axis] + s.high[s.axis]) / 2;
    if (!(where > s.low[s.axis] && where < s.high[s.axis])) return;
    HOLDS(!section_cut(&s, m, &options));
    reader_check_parts(m);
    if (!m->mesh.view.index_count) return;
    reader_check_mesh(&m->mesh);
    mesh_box(&m->mesh, low, high);
    for (int k = 0; k < 3; k++) HOLDS(low[k] >= s.low[k] && high[k] <= s.high[k]);
    if (sign > 0) HOLDS(high[s.axis] <= (double)(float)where);
    else HOLDS(low[s.axis] >= (double)(float)where);
}

int LLVMFuzzerTestOneInput(const uint8_t *data, size_t size)
{
    static const char *const names[4] = { "a.obj", "a.stl", "a", "A.STL" };
    fuzz_input in = { data, data + size };
    uint32_t kind = fuzz_byte(&in);
    const char *name = names[kind % 4];
    size_t n = (size_t)(in.end - in.at), error_size = kind & 16 ? kind >> 5 : 200;
    int result, calls = 0;
    uint8_t *bytes, *archive = NULL;
    char *error;
    model m;
    model_request request = { .error_size = error_size, .progress = reader_progress };
    if (kind % 4 == 2 && n && *in.at == '<') archive = reader_archive(in.at, n, &n);
    if (n > GUARD_ROOM) return 0;
    bytes = (uint8_t *)guard_take(n, kind >> 2 & 1);
    error = (char *)guard_take(error_size, 1);
    if (n) memcpy(bytes, archive ? archive : in.at, n);
    free(archive);
    guard_seal(bytes);
    request.user = &calls;
    request.error = error_size ? error : NULL;
    request.most = kind & 32 ? 4 : 0;
    result = model_read_memory(n ? bytes : NULL, n, name, &m, &request);
    if (result) {
        reader_check_error(error, error_size, name);
        HOLDS(!m.mesh.positions && !m.mesh.indices && !m.mesh.view.vertex_count);
        HOLDS(!m.part && !m.surface && !m.library);
    } else {
        reader_check_mesh(&m.mesh);
        reader_check_parts(&m);
        HOLDS(!request.most || m.mesh.view.index_count <= 3 * 4);
    }
    if ((kind & 8) && n && !request.most) reader_line_ends(bytes, n, name, result, &m.mesh);
    if (!result) reader_cut(&m, kind >> 2);
    if (!result) model_free(&m);
    guard_close();
    return 0;
}
