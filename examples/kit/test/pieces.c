/* pieces.c - binary STL, read in pieces from a file and whole from memory: each triangle has its
   corners and its colour, each place is one vertex a colour, triangles with a corner that is not
   finite are left out and counted.  A file that becomes shorter while it is read is an error. */
#define _DEFAULT_SOURCE
#include "shade.h"
#include "examples/kit/read/files.h"

enum { COUNT = 1999, FIRST_COLORED = 700, BYTES = 84 + 50 * COUNT }; /* four pieces */
static unsigned char bytes[BYTES];
static float corner[COUNT][9];
static uint32_t word[COUNT];
static int left_out, failed, passed;

static void check(const char *what, int holds)
{
    if (!holds) printf("FAIL pieces: %s\n", what);
    *(holds ? &passed : &failed) += 1;
}

static void put(unsigned char *to, uint32_t v)
{
    for (int k = 0; k < 4; k++) to[k] = (unsigned char)(v >> 8 * k);
}

/* A strip whose neighbours share corners, some as -0 and some as 0; every hundredth triangle has a
   corner of NaN or infinity.  From FIRST_COLORED on every third has a colour. */
static void build(void)
{
    put(bytes + 80, COUNT);
    for (int t = 0; t < COUNT; t++) {
        unsigned char *to = bytes + 84 + 50 * t;
        for (int k = 0; k < 3; k++) {
            const int i = (t + k) % 1500; /* the last 500 lie where the first did */
            corner[t][3 * k] = (float)(i / 2);
            corner[t][3 * k + 1] = (float)(i % 2);
            corner[t][3 * k + 2] = t % 2 ? -0.0f : 0.0f;
        }
        if (t % 100 == 57) corner[t][t / 100 % 9] = t % 200 == 57 ? NAN : INFINITY;
        left_out += t % 100 == 57;
        word[t] = t >= FIRST_COLORED && t % 3 == 0 ? 0x8000u + (uint32_t)t % 2 * 31 : 0;
        for (int k = 0; k < 9; k++) {
            uint32_t bits;
            memcpy(&bits, &corner[t][k], sizeof bits);
            put(to + 12 + 4 * k, bits);
        }
        to[48] = (unsigned char)word[t];
        to[49] = (unsigned char)(word[t] >> 8);
    }
}

/* The number of triangles, of the right order, whose corners and colours are right */
static int right(const owned_mesh *m)
{
    int count = 0, at = 0;
    for (int t = 0; t < COUNT && at < m->view.index_count; t++) {
        const float grey = shade_linear_from_srgb(shade_v3(0.75f, 0, 0)).x;
        const float red = word[t] ? 0 : grey, blue = word[t] ? (float)(word[t] & 31) / 31 : grey;
        int same = m->colors != NULL;
        if (t % 100 == 57) continue;
        for (int k = 0; k < 9 && same; k++)
            same = m->positions[3 * (size_t)m->indices[at + k / 3] + (size_t)k % 3] == corner[t][k];
        for (int k = 0; k < 3 && same; k++) {
            const float *c = m->colors + 3 * (size_t)m->indices[at + k];
            same = c[0] == red && c[2] == blue;
        }
        count += same;
        at += 3;
    }
    return count;
}

/* How many pairs of place and colour the triangles have */
static int pairs(void)
{
    static struct {
        float p[3];
        uint32_t word;
    } met[3 * COUNT];
    int count = 0;
    for (int i = 0; i < 3 * COUNT; i++) {
        const float *p = corner[i / 3] + 3 * (i % 3);
        int k = 0;
        if (i / 3 % 100 == 57) continue;
        while (k < count && (met[k].p[0] != p[0] || met[k].p[1] != p[1] || met[k].p[2] != p[2] ||
                             met[k].word != word[i / 3]))
            k++;
        memcpy(met[k].p, p, sizeof met[k].p);
        met[k].word = word[i / 3];
        count += k == count;
    }
    return count;
}

static void check_model(const char *how, model *m, int refused)
{
    printf("%s\n", how);
    check("it is read", !refused);
    if (refused) return;
    check("each triangle is there", m->mesh.view.index_count == 3 * (COUNT - left_out));
    check("each has its corners and colour", right(&m->mesh) == COUNT - left_out);
    check("each place is one vertex a colour", m->mesh.view.vertex_count == pairs());
    check("those left out are told", strstr(m->warning, "20 triangles have corners") != NULL);
    model_free(m);
}

static double reached;
static void remember(void *user, double part)
{
    (void)user;
    check("progress grows", part >= reached && part <= 1);
    reached = part;
}

int main(int argc, char **argv)
{
    char error[200] = "", name[4096];
    const model_request q = { .error = error, .error_size = sizeof error, .progress = remember };
    mesh_reader r;
    model m = { 0 }, cut = { 0 };
    FILE *file;
    if (argc < 2) return 2;
    snprintf(name, sizeof name, "%s/pieces.stl", argv[1]);
    build();
    check_model("from memory", &m, model_read_memory(bytes, BYTES, "pieces.stl", &m, &q));
    file = fopen(name, "wb");
    if (!file || fwrite(bytes, 1, BYTES, file) != BYTES || fclose(file)) return 2;
    reached = 0;
    check_model("in pieces", &m, model_read_file(name, &m, &q));

    file = fopen(name, "wb");
    if (!file || fwrite(bytes, 1, BYTES - 50, file) != BYTES - 50 || fclose(file)) return 2;
    file = fopen(name, "rb");
    if (!file || fseek(file, 84, SEEK_SET)) return 2;
    r = model_reader(bytes, 84, "pieces.stl", &q);
    r.all = BYTES;
    check("a file that became shorter is refused", model_read_stl(&r, &cut, file));
    check("and says so", !strcmp(error, "pieces.stl: became shorter while it was read"));
    model_free(&cut);
    fclose(file);
    check("a file that is too short", model_read_file(name, &m, &q));
    check("is read whole, and refused", strstr(error, "ends after 1998 of 1999") != NULL);
    remove(name);
    printf("%d passed, %d failed\n", passed, failed);
    return failed != 0;
}
