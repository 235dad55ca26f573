/* models.c DIR - writes the model files that thumbnail.sh draws. */
#include <math.h>
#include <stdarg.h>
#include <stdint.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

static const char *folder;
static FILE *create(const char *name)
{
    char path[1000];
    FILE *f;
    snprintf(path, sizeof path, "%s/%s", folder, name);
    f = fopen(path, "wb");
    if (!f) {
        perror(path);
        exit(1);
    }
    return f;
}

static void text(const char *name, const char *what)
{
    FILE *f = create(name);
    fputs(what, f);
    fclose(f);
}

/* ---- one mesh in all formats: a torus of triangles without normals -------------------------- */

enum { ROUND = 24, TUBE = 12, VERTICES = ROUND * TUBE, TRIANGLES = 2 * VERTICES };
static float position[VERTICES][3];
static uint32_t corner[TRIANGLES][3];

static void torus(void)
{
    for (int i = 0; i < VERTICES; i++) {
        double a = 6.283185307179586 * (i / TUBE) / ROUND,
               b = 6.283185307179586 * (i % TUBE) / TUBE;
        /* few bits, so that text holds them exactly */
        position[i][0] = (float)(floor((2 + 0.8 * cos(b)) * cos(a) * 256) / 256);
        position[i][1] = (float)(floor(0.8 * sin(b) * 256) / 256);
        position[i][2] = (float)(floor((2 + 0.8 * cos(b)) * sin(a) * 256) / 256);
    }
    for (int i = 0; i < VERTICES; i++) {
        int right = i / TUBE * TUBE + (i + 1) % TUBE, step = TUBE;
        uint32_t a = (uint32_t)i, b = (uint32_t)right;
        uint32_t c = (uint32_t)((right + step) % VERTICES), d = (uint32_t)((i + step) % VERTICES);
        corner[2 * i][0] = a;
        corner[2 * i][1] = b;
        corner[2 * i][2] = c;
        corner[2 * i + 1][0] = a;
        corner[2 * i + 1][1] = c;
        corner[2 * i + 1][2] = d;
    }
}

static void put(FILE *f, const void *value, size_t size, int big)
{
    unsigned char b[8], *at = b;
    const uint16_t probe = 1;
    int swap = big == (*(const unsigned char *)&probe == 1);
    memcpy(b, value, size);
    for (size_t k = 0; swap && k < size / 2; k++) {
        unsigned char t = b[k];
        b[k] = b[size - 1 - k];
        b[size - 1 - k] = t;
    }
    fwrite(at, 1, size, f);
}

static void torus_ply(const char *name, const char *format, int big)
{
    FILE *f = create(name);
    int ascii = !strcmp(format, "ascii");
    fprintf(f,
            "ply\nformat %s 1.0\ncomment made for a test\nelement vertex %d\nproperty float x\n"
            "property double y\nproperty float z\nproperty uchar quality\nelement face %d\n"
            "property list uchar int vertex_indices\nproperty short group\nend_header\n",
            format, VERTICES, TRIANGLES);
    for (int i = 0; i < VERTICES; i++) {
        double y = (double)position[i][1];
        unsigned char quality = 7;
        if (ascii) {
            fprintf(f, "%.9g %.9g %.9g 7\n", (double)position[i][0], y, (double)position[i][2]);
        } else {
            put(f, &position[i][0], 4, big);
            put(f, &y, 8, big);
            put(f, &position[i][2], 4, big);
            put(f, &quality, 1, big);
        }
    }
    for (int i = 0; i < TRIANGLES; i++) {
        const unsigned char three = 3;
        int16_t group = -1;
        if (ascii)
            fprintf(f, "3 %u %u %u -1\n", corner[i][0], corner[i][1], corner[i][2]);
        else {
            put(f, &three, 1, big);
            for (int k = 0; k < 3; k++) put(f, &corner[i][k], 4, big);
            put(f, &group, 2, big);
        }
    }
    fclose(f);
}

static void torus_obj(void)
{
    FILE *f = create("torus.obj");
    for (int i = 0; i < VERTICES; i++)
        fprintf(f, "v %.9g %.9g %.9g\n", (double)position[i][0], (double)position[i][1],
                (double)position[i][2]);
    for (int i = 0; i < TRIANGLES; i++)
        fprintf(f, "f %u %u %u\n", corner[i][0] + 1, corner[i][1] + 1, corner[i][2] + 1);
    fclose(f);
}

static void torus_stl(int binary)
{
    FILE *f = create(binary ? "torus.binary.stl" : "torus.stl");
    const uint32_t count = TRIANGLES;
    const char zeros[80] = { 0 };
    if (binary) {
        fwrite(zeros, 1, 80, f);
        put(f, &count, 4, 0);
    } else {
        fputs("solid torus\n", f);
    }
    for (int i = 0; i < TRIANGLES; i++) {
        if (binary)
            fwrite(zeros, 1, 12, f);
        else
            fputs("facet normal 0 0 0\nouter loop\n", f);
        for (int k = 0; k < 3; k++) {
            const float *p = position[corner[i][k]];
            for (int c = 0; c < 3 && binary; c++) put(f, &p[c], 4, 0);
            if (!binary)
                fprintf(f, "vertex %.9g %.9g %.9g\n", (double)p[0], (double)p[1], (double)p[2]);
        }
        if (binary)
            fwrite(zeros, 1, 2, f);
        else
            fputs("endloop\nendfacet\n", f);
    }
    if (!binary) fputs("endsolid torus\n", f);
    fclose(f);
}

/* ---- glTF: a buffer of positions, then indices, inside the text ----------------------------- */

static void base64(FILE *f, const unsigned char *b, size_t n)
{
    static const char digit[] = "ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789+/";
    for (size_t i = 0; i < n; i += 3) {
        uint32_t v = (uint32_t)b[i] << 16 | (uint32_t)(i + 1 < n ? b[i + 1] : 0) << 8 |
                     (uint32_t)(i + 2 < n ? b[i + 2] : 0);
        fputc(digit[v >> 18], f);
        fputc(digit[v >> 12 & 63], f);
        fputc(i + 1 < n ? digit[v >> 6 & 63] : '=', f);
        fputc(i + 2 < n ? digit[v & 63] : '=', f);
    }
}

/* nodes and materials: JSON of these names; every mesh is the same one.  uv: u, v of each vertex,
   a picture, or NULL. */
static void gltf(const char *name, const float *p, size_t vertices, const uint32_t *index,
                 size_t indices, const char *nodes, const char *materials, const float *uv,
                 const unsigned char *picture, size_t picture_size)
{
    FILE *f = create(name);
    size_t at_uv = 12 * vertices, at_index = at_uv + (uv ? 8 * vertices : 0);
    size_t bytes = at_index + 4 * indices;
    unsigned char *buffer = calloc(bytes, 1);
    float low[3] = { 1e9f, 1e9f, 1e9f }, high[3] = { -1e9f, -1e9f, -1e9f };
    memcpy(buffer, p, 12 * vertices); /* little-endian machines alone */
    if (uv) memcpy(buffer + at_uv, uv, 8 * vertices);
    memcpy(buffer + at_index, index, 4 * indices);
    for (size_t i = 0; i < 3 * vertices; i++) {
        if (p[i] < low[i % 3]) low[i % 3] = p[i];
        if (p[i] > high[i % 3]) high[i % 3] = p[i];
    }
    fprintf(f,
            "{\"asset\":{\"version\":\"2.0\"},\"scene\":0,%s,\"meshes\":[{\"primitives\":[{"
            "\"attributes\":{\"POSITION\":0%s},\"indices\":1%s}]}],"
            "\"bufferViews\":[{\"buffer\":0,\"byteOffset\":0,\"byteLength\":%lu},"
            "{\"buffer\":0,\"byteOffset\":%lu,\"byteLength\":%lu}%s",
            nodes, uv ? ",\"TEXCOORD_0\":2" : "", materials[0] ? ",\"material\":0" : "",
            (unsigned long)at_uv, (unsigned long)at_index, (unsigned long)(4 * indices),
            uv ? "," : "");
    if (uv)
        fprintf(f, "{\"buffer\":0,\"byteOffset\":%lu,\"byteLength\":%lu}", (unsigned long)at_uv,
                (unsigned long)(8 * vertices));
    fprintf(f,
            "],\"accessors\":[{\"bufferView\":0,\"componentType\":5126,\"count\":%lu,"
            "\"type\":\"VEC3\",\"min\":[%.9g,%.9g,%.9g],\"max\":[%.9g,%.9g,%.9g]},"
            "{\"bufferView\":1,\"componentType\":5125,\"count\":%lu,\"type\":\"SCALAR\"}%s",
            (unsigned long)vertices, (double)low[0], (double)low[1], (double)low[2],
            (double)high[0], (double)high[1], (double)high[2], (unsigned long)indices,
            uv ? "," : "");
    if (uv)
        fprintf(f, "{\"bufferView\":2,\"componentType\":5126,\"count\":%lu,\"type\":\"VEC2\"}",
                (unsigned long)vertices);
    fputs("]", f);
    if (materials[0]) fprintf(f, ",%s", materials);
    if (picture) {
        fputs(",\"textures\":[{\"source\":0}],\"images\":[{\"mimeType\":\"image/png\",\"uri\":"
              "\"data:image/png;base64,",
              f);
        base64(f, picture, picture_size);
        fputs("\"}]", f);
    }
    fprintf(f, ",\"buffers\":[{\"byteLength\":%lu,\"uri\":\"data:application/octet-stream;base64,",
            (unsigned long)bytes);
    base64(f, buffer, bytes);
    fputs("\"}]}", f);
    fclose(f);
    free(buffer);
}

/* A prism without symmetry, twice: moved; turned by 90 degrees, stretched and mirrored below it */
static void nodes(void)
{
    static const float p[6][3] = { { 0, 0, 0 }, { 2, 0, 0 }, { 0, 1, 0 },
                                   { 0, 0, 1 }, { 2, 0, 1 }, { 0, 1, 1 } };
    static const uint32_t index[24] = { 0, 2, 1, 3, 4, 5, 0, 1, 4, 0, 4, 3,
                                        1, 2, 5, 1, 5, 4, 2, 0, 3, 2, 3, 5 };
    FILE *f = create("nodes.obj");
    gltf("nodes.gltf", p[0], 6, index, 24,
         "\"scenes\":[{\"nodes\":[0]}],\"nodes\":[{\"mesh\":0,\"translation\":[1,2,-1],"
         "\"children\":[1]},{\"mesh\":0,\"translation\":[0,0,2],\"scale\":[-1,2,1],"
         "\"rotation\":[0,0,0.70710678118654757,0.70710678118654757]}]",
         "", NULL, NULL, 0);
    for (int copy = 0; copy < 2; copy++) {
        for (int i = 0; i < 6; i++) {
            double x = (double)p[i][0], y = (double)p[i][1], z = (double)p[i][2];
            if (copy) {
                /* scaled, then x goes to y, y to -x, then moved */
                double sx = -x, sy = 2 * y;
                x = -sy;
                y = sx;
                z = z + 2;
            }
            fprintf(f, "v %g %g %g\n", x + 1, y + 2, z - 1);
        }
    }
    for (int copy = 0; copy < 2; copy++)
        for (int i = 0; i < 24; i += 3) /* a mirrored triangle runs the other way */
            fprintf(f, "f %u %u %u\n", index[i] + 1 + 6 * (unsigned)copy,
                    index[copy ? i + 2 : i + 1] + 1 + 6 * (unsigned)copy,
                    index[copy ? i + 1 : i + 2] + 1 + 6 * (unsigned)copy);
    fclose(f);
}

/* ---- polygons, and the same as triangles and rectangles ------------------------------------- */

static void shapes(void)
{
    FILE *whole = create("star.obj"), *parts = create("star.parts.obj");
    FILE *comb = create("comb.obj"), *teeth = create("comb.parts.obj");
    fputs("mtllib flat.mtl\nusemtl flat\n", whole);
    fputs("mtllib flat.mtl\nusemtl flat\n", parts);
    fputs("mtllib flat.mtl\nusemtl flat\n", comb);
    fputs("mtllib flat.mtl\nusemtl flat\n", teeth);
    for (int i = 0; i < 22; i++) {
        double a = 6.283185307179586 * i / 22, r = i % 2 ? 1 : 4;
        fprintf(whole, "v %.6f %.6f 0\n", r * cos(a), r * sin(a));
        fprintf(parts, "v %.6f %.6f 0\n", r * cos(a), r * sin(a));
    }
    fputs("f", whole);
    fputs("v 0 0 0\n", parts);
    for (int i = 0; i < 22; i++) {
        fprintf(whole, " %d", i + 1);
        fprintf(parts, "f 23 %d %d\n", i + 1, (i + 1) % 22 + 1);
    }
    /* teeth up from a back of height 1; each corner of it twice */
    for (int i = 0; i < 8; i++)
        fprintf(comb, "v %d 1 0\nv %d 1 0\nv %d %d 0\nv %d %d 0\nv %d 1 0\n", 2 * i, 2 * i, 2 * i,
                4 + i % 3, 2 * i + 1, 4 + i % 3, 2 * i + 1);
    fputs("v 15 0 0\nv 0 0 0\nf", comb);
    for (int i = 0; i < 42; i++) fprintf(comb, " %d", i + 1);
    for (int i = 0; i < 8; i++)
        fprintf(teeth, "v %d 1 0\nv %d %d 0\nv %d %d 0\nv %d 1 0\nf -4 -1 -2 -3\n", 2 * i, 2 * i,
                4 + i % 3, 2 * i + 1, 4 + i % 3, 2 * i + 1);
    fputs("v 15 0 0\nv 0 0 0\nv 0 1 0\nv 15 1 0\nf -4 -1 -2 -3\n", teeth);
    fclose(whole);
    fclose(parts);
    fclose(comb);
    fclose(teeth);
}

/* ---- surfaces ------------------------------------------------------------------------------- */

#define SQUARE "v -1 -1 0\nv 1 -1 0\nv 1 1 0\nv -1 1 0\nvt 0 0\nvt 1 0\nvt 1 1\nvt 0 1\n"

/* 16 x 16 texels, each quarter its own; A as deep as alpha says */
static void picture_tga(const char *name, int alpha)
{
    static const unsigned char quarter[4][4] = {
        { 40, 80, 200, 255 }, { 30, 160, 60, 255 }, { 220, 50, 20, 0 }, { 100, 100, 100, 255 }
    };
    static const unsigned char head[18] = { 0, 0, 2, 0,  0, 0,  0, 0,  0,
                                            0, 0, 0, 16, 0, 16, 0, 32, 0x28 };
    FILE *f = create(name);
    fwrite(head, 1, 18, f); /* top row first */
    for (int i = 0; i < 256; i++) {
        const unsigned char *c = quarter[i / 128 * 2 + i % 16 / 8];
        fputc(c[2], f);
        fputc(c[1], f);
        fputc(c[0], f);
        fputc(alpha ? c[3] : 255, f);
    }
    fclose(f);
}

static void surfaces(void)
{
    text("flat.mtl", "newmtl flat\nKe 0.7 0.4 0.2\nKd 0 0 0\n");
    text("flat.obj", "mtllib flat.mtl\nusemtl flat\n" SQUARE "f 1 2 3 4\n");
    text("map.mtl", "newmtl map\nKe 0.7 0.7 0.7\nmap_Kd -clamp off the map.tga\n");
    text("map.obj", "mtllib map.mtl\nusemtl map\n" SQUARE "f 1/1 2/2 3/3 4/4\n");
    text("holes.mtl", "newmtl map\nKe 0.7 0.7 0.7\nmap_Kd holes.tga\nmap_d holes.tga\n");
    text("whole.mtl", "newmtl map\nKe 0.7 0.7 0.7\nmap_Kd holes.tga\n");
    text("whole.obj", "mtllib whole.mtl\nusemtl map\n" SQUARE "f 1/1 2/2 3/3 4/4\n");
    text("other.mtl", "newmtl map\nKe 0.7 0.7 0.7\nmap_Kd holes.tga\nmap_d mask.tga\n");
    text("other.obj", "mtllib other.mtl\nusemtl map\n" SQUARE "f 1/1 2/2 3/3 4/4\n");
    text("holes.obj", "mtllib holes.mtl\nusemtl map\n" SQUARE "f 1/1 2/2 3/3 4/4\n");
    text("lost.mtl", "newmtl map\nKe 0.7 0.4 0.2\nmap_Kd no such file.png\n");
    text("lost.obj", "mtllib lost.mtl\nusemtl map\n" SQUARE "f 1/1 2/2 3/3 4/4\n");
    text("glass.mtl", "newmtl back\nKe 0.6 0 0\nKd 0 0 0\nnewmtl front\nKe 0 0 0.6\nKd 0 0 0\n"
                      "d 0.25\nTr 0.9\n");
    text("glass.obj", "mtllib glass.mtl\n" SQUARE "v -1 -1 -1\nv 1 -1 -1\nv 1 1 -1\nv -1 1 -1\n"
                      "usemtl front\nf 1 2 3 4\nusemtl back\nf 5 6 7 8\n");
    text("glass2.obj", "mtllib glass.mtl\n" SQUARE "v -1 -1 -1\nv 1 -1 -1\nv 1 1 -1\nv -1 1 -1\n"
                       "usemtl back\nf 5 6 7 8\nusemtl front\nf 1 2 3 4\n");
    text("matte.mtl", "newmtl m\nKd 0.8 0.3 0.1\nnewmtl n\nKd 0.1 0.3 0.8\n");
    text("matte.obj", "mtllib matte.mtl\nv 0 0 0\nv 2 0 0\nv 2 2 0\nv 0 2 0\nv 0 0 -2\nv 2 0 -2\n"
                      "v 2 2 -2\nv 0 2 -2\nusemtl m\nf 1 2 3 4\nf 6 5 8 7\nusemtl n\nf 4 3 7 8\n"
                      "f 2 6 7 3\nusemtl m\nf 5 1 4 8\nf 5 6 2 1\n");
    text("colors.ply", "ply\nformat ascii 1.0\nelement vertex 3\nproperty float x\n"
                       "property float y\nproperty float z\nproperty uchar red\n"
                       "property uchar green\nproperty uchar blue\nelement face 1\n"
                       "property list uchar int vertex_index\nend_header\n"
                       "0 0 0 200 100 50\n1 0 0 200 100 50\n0 1 0 200 100 50\n3 0 1 2\n");
    picture_tga("the map.tga", 0);
    picture_tga("holes.tga", 1);
}

int main(int argc, char **argv)
{
    static const uint32_t square[6] = { 0, 1, 2, 0, 2, 3 };
    static const float square_p[12] = { -1, -1, 0, 1, -1, 0, 1, 1, 0, -1, 1, 0 };
    static const float square_uv[8] = { 0, 1, 1, 1, 1, 0, 0, 0 }; /* v runs down */
    unsigned char picture[4096];
    size_t size = 0;
    FILE *f;
    if (argc < 2) return 1;
    folder = argv[1];
    torus();
    torus_obj();
    torus_stl(0);
    torus_stl(1);
    torus_ply("torus.ply", "ascii", 0);
    torus_ply("torus.little.ply", "binary_little_endian", 0);
    torus_ply("torus.big.ply", "binary_big_endian", 1);
    gltf("torus.gltf", position[0], VERTICES, corner[0], 3 * TRIANGLES,
         "\"scenes\":[{\"nodes\":[0]}],\"nodes\":[{\"mesh\":0}]", "", NULL, NULL, 0);
    nodes();
    shapes();
    surfaces();
    f = argc > 2 ? fopen(argv[2], "rb") : NULL; /* any picture, to be embedded */
    if (f) {
        size = fread(picture, 1, sizeof picture, f);
        fclose(f);
    }
    if (size)
        gltf("embedded.gltf", square_p, 4, square, 6,
             "\"scenes\":[{\"nodes\":[0]}],\"nodes\":[{\"mesh\":0}]",
             "\"materials\":[{\"emissiveFactor\":[0.45,0.45,0.45],\"pbrMetallicRoughness\":{"
             "\"baseColorTexture\":{\"index\":0},\"metallicFactor\":0}}]",
             square_uv, picture, size);
    return 0;
}
