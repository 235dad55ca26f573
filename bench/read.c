/* read.c - megabytes a second that the readers of examples/kit/read take of each format, beside
   plain copies of the same bytes, into memory that is there and into new memory, as a reader fills
   it, and a search for their line ends.  The files are in memory.

   read [--triangles N] [--rounds N] [--only PART_OF_A_NAME] [--write FOLDER] */
#include "clock.h"
#define SHADE_IMPLEMENTATION
#include "shade.h"
#include "examples/kit/read/files.h"

enum { MOST_ROUNDS = 101 };

/* ---- files: a torus of triangles in each format ---------------------------------------------- */

typedef struct bytes {
    unsigned char *v;
    size_t count, room;
} bytes;

static void *need(void *memory)
{
    if (memory) return memory;
    fprintf(stderr, "read: out of memory\n");
    exit(1);
}

static void put(bytes *b, const void *from, size_t n)
{
    if (b->count + n > b->room) {
        b->room = 2 * b->room + n;
        b->v = (unsigned char *)need(realloc(b->v, b->room));
    }
    memcpy(b->v + b->count, from, n);
    b->count += n;
}

static void put_uint(bytes *b, uint32_t value, int size)
{
    for (int k = 0; k < size; k++) {
        const unsigned char byte = (unsigned char)(value >> 8 * k);
        put(b, &byte, 1);
    }
}

static void put_floats(bytes *b, const float *v, int n)
{
    for (int k = 0; k < n; k++) {
        uint32_t bits;
        memcpy(&bits, &v[k], sizeof bits);
        put_uint(b, bits, 4);
    }
}

static void put_text(bytes *b, const char *format, ...)
{
    char text[600];
    va_list list;
    va_start(list, format);
    put(b, text, (size_t)vsnprintf(text, sizeof text, format, list));
    va_end(list);
}

/* Three floats between two texts */
static void put_row(bytes *b, const char *before, const float *v, const char *after)
{
    put_text(b, "%s%.7g %.7g %.7g%s", before, (double)v[0], (double)v[1], (double)v[2], after);
}

/* Vertices of a mesh and its triangles; each format writes what it has of both. */
typedef struct shape {
    float (*p)[3], (*n)[3];
    uint32_t (*f)[3];
    int vertices, triangles;
} shape;

static shape torus(int triangles)
{
    const int around = (int)sqrt((double)triangles / 2), n = around * around;
    shape s = { NULL, NULL, NULL, n, 2 * n };
    s.p = (float(*)[3])need(malloc((size_t)n * sizeof *s.p));
    s.n = (float(*)[3])need(malloc((size_t)n * sizeof *s.n));
    s.f = (uint32_t(*)[3])need(malloc(2 * (size_t)n * sizeof *s.f));
    for (int i = 0; i < n; i++) {
        const int row = i / around, column = i % around;
        const double a = 6.283185307179586 * row / around, b = 6.283185307179586 * column / around;
        const int down = (row + 1) % around * around, right = (column + 1) % around;
        const uint32_t corner[4] = { (uint32_t)i, (uint32_t)(row * around + right),
                                     (uint32_t)(down + right), (uint32_t)(down + column) };
        const float p[3] = { (float)((2 + 0.8 * cos(b)) * cos(a)), (float)(0.8 * sin(b)),
                             (float)((2 + 0.8 * cos(b)) * sin(a)) };
        const float N[3] = { (float)(cos(b) * cos(a)), (float)sin(b), (float)(cos(b) * sin(a)) };
        memcpy(s.p[i], p, sizeof p);
        memcpy(s.n[i], N, sizeof N);
        for (int k = 0; k < 6; k++) s.f[2 * i + k / 3][k % 3] = corner[k < 3 ? k : (k - 1) % 4];
        s.f[2 * i + 1][0] = corner[0];
        s.f[2 * i + 1][1] = corner[2];
        s.f[2 * i + 1][2] = corner[3];
    }
    return s;
}

static void obj(bytes *b, const shape *s, int normals)
{
    for (int i = 0; i < s->vertices; i++) put_row(b, "v ", s->p[i], "\n");
    for (int i = 0; i < s->vertices && normals; i++) put_row(b, "vn ", s->n[i], "\n");
    for (int i = 0; i < s->triangles; i++) {
        const unsigned c[3] = { s->f[i][0] + 1, s->f[i][1] + 1, s->f[i][2] + 1 };
        if (normals) put_text(b, "f %u//%u %u//%u %u//%u\n", c[0], c[0], c[1], c[1], c[2], c[2]);
        else put_text(b, "f %u %u %u\n", c[0], c[1], c[2]);
    }
}

static void off(bytes *b, const shape *s, int normals)
{
    (void)normals;
    put_text(b, "OFF\n%d %d 0\n", s->vertices, s->triangles);
    for (int i = 0; i < s->vertices; i++) put_row(b, "", s->p[i], "\n");
    for (int i = 0; i < s->triangles; i++)
        put_text(b, "3 %u %u %u\n", s->f[i][0], s->f[i][1], s->f[i][2]);
}

static void stl_text(bytes *b, const shape *s, int normals)
{
    (void)normals;
    put_text(b, "solid torus\n");
    for (int i = 0; i < s->triangles; i++) {
        put_row(b, "facet normal ", s->n[s->f[i][0]], "\nouter loop\n");
        for (int k = 0; k < 3; k++) put_row(b, "vertex ", s->p[s->f[i][k]], "\n");
        put_text(b, "endloop\nendfacet\n");
    }
    put_text(b, "endsolid torus\n");
}

static void stl_binary(bytes *b, const shape *s, int normals)
{
    (void)normals;
    put_text(b, "%-80s", "torus");
    put_uint(b, (uint32_t)s->triangles, 4);
    for (int i = 0; i < s->triangles; i++) {
        put_floats(b, s->n[s->f[i][0]], 3);
        for (int k = 0; k < 3; k++) put_floats(b, s->p[s->f[i][k]], 3);
        put_uint(b, 0, 2);
    }
}

static void ply_head(bytes *b, const shape *s, const char *format, int normals)
{
    put_text(b, "ply\nformat %s 1.0\nelement vertex %d\n", format, s->vertices);
    put_text(b, "property float x\nproperty float y\nproperty float z\n");
    if (normals) put_text(b, "property float nx\nproperty float ny\nproperty float nz\n");
    put_text(b, "element face %d\nproperty list uchar int vertex_indices\nend_header\n",
             s->triangles);
}

static void ply_text(bytes *b, const shape *s, int normals)
{
    ply_head(b, s, "ascii", normals);
    for (int i = 0; i < s->vertices; i++) {
        put_row(b, "", s->p[i], normals ? " " : "\n");
        if (normals) put_row(b, "", s->n[i], "\n");
    }
    for (int i = 0; i < s->triangles; i++)
        put_text(b, "3 %u %u %u\n", s->f[i][0], s->f[i][1], s->f[i][2]);
}

static void ply_binary(bytes *b, const shape *s, int normals)
{
    ply_head(b, s, "binary_little_endian", normals);
    for (int i = 0; i < s->vertices; i++) {
        put_floats(b, s->p[i], 3);
        if (normals) put_floats(b, s->n[i], 3);
    }
    for (int i = 0; i < s->triangles; i++) {
        put_uint(b, 3, 1);
        for (int k = 0; k < 3; k++) put_uint(b, s->f[i][k], 4);
    }
}

static void glb(bytes *b, const shape *s, int normals)
{
    const unsigned rows = 12 * (unsigned)s->vertices, corners = 12 * (unsigned)s->triangles;
    const unsigned all = (normals ? 2 : 1) * rows + corners;
    char json[1000];
    snprintf(json, sizeof json,
             "{\"asset\":{\"version\":\"2.0\"},\"scenes\":[{\"nodes\":[0]}],\"nodes\":[{\"mesh\":0}"
             "],\"meshes\":[{\"primitives\":[{\"attributes\":{\"POSITION\":0%s},\"indices\":1}]}],"
             "\"buffers\":[{\"byteLength\":%u}],\"bufferViews\":[{\"buffer\":0,\"byteLength\":%u},"
             "{\"buffer\":0,\"byteOffset\":%u,\"byteLength\":%u},{\"buffer\":0,\"byteOffset\":%u,"
             "\"byteLength\":%u}],\"accessors\":[{\"bufferView\":0,\"componentType\":5126,"
             "\"count\":%d,\"type\":\"VEC3\"},{\"bufferView\":1,\"componentType\":5125,"
             "\"count\":%d,\"type\":\"SCALAR\"},{\"bufferView\":2,\"componentType\":5126,"
             "\"count\":%d,\"type\":\"VEC3\"}]}",
             normals ? ",\"NORMAL\":2" : "", all, rows, rows, corners, normals ? rows + corners : 0,
             rows, s->vertices, 3 * s->triangles, s->vertices);
    while (strlen(json) % 4) strcat(json, " ");
    put(b, "glTF\2\0\0\0", 8);
    put_uint(b, 28 + (unsigned)strlen(json) + all, 4);
    put_uint(b, (unsigned)strlen(json), 4);
    put_text(b, "JSON%s", json);
    put_uint(b, all, 4);
    put(b, "BIN\0", 4);
    for (int i = 0; i < s->vertices; i++) put_floats(b, s->p[i], 3);
    for (int i = 0; i < s->triangles; i++)
        for (int k = 0; k < 3; k++) put_uint(b, s->f[i][k], 4);
    for (int i = 0; i < s->vertices && normals; i++) put_floats(b, s->n[i], 3);
}

/* A file of a ZIP archive that packs nothing: its head, or its row of the directory */
static void zip_part(bytes *b, const char *name, const bytes *what, int row, size_t place)
{
    const uint32_t size = (uint32_t)what->count;
    put(b, row ? "PK\1\2\24\0\24\0\0\0\0\0\0\0\0\0" : "PK\3\4\24\0\0\0\0\0\0\0\0\0", row ? 16 : 14);
    put_uint(b, zip_crc(0, what->v, what->count), 4);
    put_uint(b, size, 4);
    put_uint(b, size, 4);
    put_uint(b, (uint32_t)strlen(name), 4);
    if (row) put(b, "\0\0\0\0\0\0\0\0\0\0", 10);
    if (row) put_uint(b, (uint32_t)place, 4);
    put(b, name, strlen(name));
    if (!row) put(b, what->v, what->count);
}

static void threemf_bytes(bytes *b, const shape *s, int normals)
{
    static const char schema[] = "http://schemas.microsoft.com/3dmanufacturing/2013/01/3dmodel";
    static const char core[] = "http://schemas.microsoft.com/3dmanufacturing/core/2015/02";
    static const char relations[] = "http://schemas.openxmlformats.org/package/2006/relationships";
    bytes part = { NULL, 0, 0 }, rels = { NULL, 0, 0 };
    size_t place[2], directory;
    (void)normals;
    put_text(&rels,
             "<Relationships xmlns=\"%s\"><Relationship Target=\"/3D/3dmodel.model\" Id=\"r\" "
             "Type=\"%s\"/></Relationships>",
             relations, schema);
    put_text(&part,
             "<model unit=\"millimeter\" xmlns=\"%s\"><resources><object id=\"1\" type=\"model\">"
             "<mesh><vertices>\n",
             core);
    for (int i = 0; i < s->vertices; i++)
        put_text(&part, "<vertex x=\"%.7g\" y=\"%.7g\" z=\"%.7g\"/>\n", (double)s->p[i][0],
                 (double)s->p[i][1], (double)s->p[i][2]);
    put_text(&part, "</vertices><triangles>\n");
    for (int i = 0; i < s->triangles; i++)
        put_text(&part, "<triangle v1=\"%u\" v2=\"%u\" v3=\"%u\"/>\n", s->f[i][0], s->f[i][1],
                 s->f[i][2]);
    put_text(&part, "</triangles></mesh></object></resources>"
                   "<build><item objectid=\"1\"/></build></model>\n");
    place[0] = b->count;
    zip_part(b, "_rels/.rels", &rels, 0, 0);
    place[1] = b->count;
    zip_part(b, "3D/3dmodel.model", &part, 0, 0);
    directory = b->count;
    zip_part(b, "_rels/.rels", &rels, 1, place[0]);
    zip_part(b, "3D/3dmodel.model", &part, 1, place[1]);
    put(b, "PK\5\6\0\0\0\0\2\0\2\0", 12);
    put_uint(b, (uint32_t)(b->count - 12 - directory), 4);
    put_uint(b, (uint32_t)directory, 4);
    put_uint(b, 0, 2);
    free(part.v);
    free(rels.v);
}

static const struct {
    const char *name, *file;
    void (*write)(bytes *b, const shape *s, int normals);
    int normals;
} formats[] = { { "STL, binary", "a.stl", stl_binary, 0 },
                { "PLY, binary", "a.ply", ply_binary, 0 },
                { "PLY, binary, with normals", "n.ply", ply_binary, 1 },
                { "GLB", "a.glb", glb, 0 },
                { "GLB with normals", "n.glb", glb, 1 },
                { "OBJ", "a.obj", obj, 0 },
                { "OBJ with normals", "n.obj", obj, 1 },
                { "OFF", "a.off", off, 0 },
                { "PLY, text", "text.ply", ply_text, 0 },
                { "STL, text", "text.stl", stl_text, 0 },
                { "3MF, not packed", "a.3mf", threemf_bytes, 0 } };
enum { FORMATS = sizeof formats / sizeof *formats };

/* ---- times ----------------------------------------------------------------------------------- */

static size_t lines_of(const bytes *b)
{
    const unsigned char *at = b->v, *end = b->v + b->count;
    size_t n = 0;
    while (at < end && (at = (const unsigned char *)memchr(at, '\n', (size_t)(end - at))) != NULL) {
        at++;
        n++;
    }
    return n;
}

/* Megabytes a second of processor time: read, copied, copied to new memory, searched */
static void time_format(const bytes *b, int format, int rounds, int triangles)
{
    double took[4][MOST_ROUNDS], speed[4];
    unsigned char *copy = (unsigned char *)need(malloc(b->count)), *fresh;
    volatile size_t lines = 0;
    memset(copy, 1, b->count);
    for (int i = 0; i < rounds; i++) {
        char error[300];
        owned_mesh m;
        double start = clock_cpu();
        if (mesh_read_memory(b->v, b->count, formats[format].file, &m, error, sizeof error)) {
            fprintf(stderr, "read: %s\n", error);
            exit(1);
        }
        took[0][i] = clock_cpu() - start;
        if (m.view.index_count != 3 * triangles) exit(1);
        mesh_free(&m);
        start = clock_cpu();
        memcpy(copy, b->v, b->count);
        lines += copy[lines % b->count];
        took[1][i] = clock_cpu() - start;
        start = clock_cpu();
        fresh = (unsigned char *)need(malloc(b->count));
        memcpy(fresh, b->v, b->count);
        lines += fresh[lines % b->count];
        free(fresh);
        took[2][i] = clock_cpu() - start;
        start = clock_cpu();
        lines += lines_of(b);
        took[3][i] = clock_cpu() - start;
    }
    for (int k = 0; k < 4; k++)
        speed[k] = 1e3 * (double)b->count / clock_median(took[k], rounds);
    printf("| %s | %.1f | %.0f | %.0f | %.0f | %.0f | %.0f |\n", formats[format].name,
           (double)b->count / 1e6, speed[0], 1e3 * (double)b->count / speed[0] / triangles,
           speed[2], speed[1], speed[3]);
    fflush(stdout);
    free(copy);
}

static void write_file(const char *folder, int format, const bytes *b)
{
    char path[1000];
    FILE *file;
    snprintf(path, sizeof path, "%s/%s", folder, formats[format].file);
    file = fopen(path, "wb");
    if (!file || fwrite(b->v, 1, b->count, file) < b->count || fclose(file)) {
        perror(path);
        exit(1);
    }
}

int main(int argc, char **argv)
{
    const char *only = "", *folder = NULL;
    int triangles = 2000000, rounds = 5;
    shape s;
    for (int i = 1; i + 1 < argc; i += 2) {
        if (!strcmp(argv[i], "--triangles")) triangles = atoi(argv[i + 1]);
        if (!strcmp(argv[i], "--rounds")) rounds = atoi(argv[i + 1]);
        if (!strcmp(argv[i], "--only")) only = argv[i + 1];
        if (!strcmp(argv[i], "--write")) folder = argv[i + 1];
    }
    if (rounds < 1 || rounds > MOST_ROUNDS || triangles < 2 || triangles > 4000000) return 2;
    s = torus(triangles);
    clock_machine(stdout);
    printf("Model files of %d triangles, %d vertices; medians of %d.\n\n", s.triangles, s.vertices,
           rounds);
    printf("| format | MB | read, MB/s | ns a triangle | copied to new memory, MB/s | copied, MB/s "
           "| searched by memchr, MB/s |\n|---|---|---|---|---|---|---|\n");
    for (int k = 0; k < FORMATS; k++) {
        bytes b = { NULL, 0, 0 };
        if (!strstr(formats[k].name, only)) continue;
        formats[k].write(&b, &s, formats[k].normals);
        if (folder) write_file(folder, k, &b);
        else time_format(&b, k, rounds, s.triangles);
        free(b.v);
    }
    free(s.p);
    free(s.n);
    free(s.f);
    return 0;
}
