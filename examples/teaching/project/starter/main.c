/* main.c - draws a scene of its own for each checkpoint into a PNG: ./renderer 4 writes 4.png.
   The judge does not use it; change it as you like. */
#include "scene.h"
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

enum { ENLARGED = 8 };

/* ---- PNG: rows stored as they are, without compression */
static unsigned long crc, adler_a, adler_b;
static void byte(FILE *f, int b)
{
    fputc(b, f);
    crc ^= (unsigned long)b;
    for (int k = 0; k < 8; k++) crc = crc & 1 ? crc >> 1 ^ 0xEDB88320ul : crc >> 1;
}
static void number(FILE *f, unsigned long n)
{
    for (int shift = 24; shift >= 0; shift -= 8) byte(f, (int)(n >> shift & 255));
}
static void begin(FILE *f, unsigned long size, const char *name)
{
    number(f, size);
    crc = 0xFFFFFFFFul;
    for (int k = 0; k < 4; k++) byte(f, name[k]);
}
static void end(FILE *f) { number(f, crc ^ 0xFFFFFFFFul); }
static void data(FILE *f, int b)
{
    byte(f, b);
    adler_a = (adler_a + (unsigned long)b) % 65521;
    adler_b = (adler_b + adler_a) % 65521;
}
static int code(float x) { return x > 0 ? x < 1 ? (int)(255 * x + 0.5f) : 255 : 0; }
static int write_png(const char *path, const picture *p)
{
    const int width = WIDTH * ENLARGED, height = HEIGHT * ENLARGED, row = 3 * width + 1;
    FILE *f = fopen(path, "wb");
    if (!f) return 0;
    fwrite("\x89PNG\r\n\x1a\n", 8, 1, f);
    begin(f, 13, "IHDR");
    number(f, (unsigned long)width);
    number(f, (unsigned long)height);
    byte(f, 8);
    byte(f, 2);
    for (int k = 0; k < 3; k++) byte(f, 0);
    end(f);
    begin(f, (unsigned long)(height * (row + 5) + 6), "IDAT");
    byte(f, 0x78);
    byte(f, 1);
    adler_a = 1;
    adler_b = 0;
    for (int j = 0; j < height; j++) {
        byte(f, j == height - 1); /* a block for each row, the last one marked */
        byte(f, row & 255);
        byte(f, row >> 8);
        byte(f, ~row & 255);
        byte(f, ~row >> 8 & 255);
        data(f, 0);
        for (int i = 0; i < width; i++) {
            const shade_vec3 c = p->color[j / ENLARGED][i / ENLARGED];
            data(f, code(c.x));
            data(f, code(c.y));
            data(f, code(c.z));
        }
    }
    number(f, adler_b << 16 | adler_a);
    end(f);
    begin(f, 0, "IEND");
    end(f);
    return !fclose(f);
}

/* ---- a scene: a torus */
static void torus(scene *s, int around, int across)
{
    for (int j = 0; j <= across; j++)
        for (int i = 0; i <= around; i++) {
            const float u = (float)i / around, v = (float)j / across;
            const float a = 6.2831853f * u, b = 6.2831853f * v, r = 1 + 0.45f * cosf(b);
            vertex *q = &s->vertex[(int)s->vertices];
            q->position = shade_v3(r * cosf(a), 0.45f * sinf(b), -r * sinf(a));
            q->normal = shade_v3(cosf(b) * cosf(a), sinf(b), -cosf(b) * sinf(a));
            q->tangent = shade_v3(-sinf(a), 0, -cosf(a));
            q->color =
                shade_v3(0.5f + 0.5f * cosf(a), 0.5f + 0.5f * sinf(b), 0.5f - 0.5f * cosf(a));
            q->uv = shade_v2(4 * u, 2 * v);
            if (i < around && j < across) {
                const int at = (int)s->vertices, next = at + around + 1;
                const int corner[6] = { at, at + 1, next + 1, at, next + 1, next };
                for (int k = 0; k < 6; k++)
                    s->triangle[(int)s->triangles + k / 3][k % 3] = (float)corner[k];
                s->triangles += 2;
            }
            s->vertices++;
        }
}
static void lamp(shade_light *l, float x, float y, float z)
{
    l->position = shade_v4(x, y, z, 1);
    l->ambient = shade_v3(0.05f, 0.05f, 0.05f);
    l->diffuse = l->specular = shade_v3(1, 0.95f, 0.9f);
    l->constant = 0.4f;
    l->linear = 0.1f;
    l->quadratic = 0.04f;
    l->spot_direction = shade_v3(-x, -y, -z);
    l->spot_exponent = 2;
    l->spot_cos_cutoff = 0.85f;
}
static void fill(scene *s, int checkpoint, int option)
{
    static const shade_mat4 from_lamp = { { { -0.7479f, -0.9616f, -1.102f, -0.8571f },
                                            { 0, 2.137f, -0.551f, -0.4286f },
                                            { -2.2438f, 0.3205f, 0.3673f, 0.2857f },
                                            { 0, 0, 2.2143f, 3.5f } } };
    memset(s, 0, sizeof *s);
    s->checkpoint = (float)checkpoint;
    s->option = (float)option;
    s->shading = PHONG;
    s->iteration = 4;
    s->lamps = LAMPS;
    s->fovy = 0.9f;
    s->near_z = checkpoint == 6 && option == CLIP ? 2.4f : 0.5f; /* cuts the torus open */
    s->far_z = 12;
    s->bias = 0.03f;
    s->eye = shade_v3(1, 1.8f, 2.6f);
    s->up = shade_v3(0, 1, 0);
    s->ambient = shade_v3(0.2f, 0.2f, 0.2f);
    s->model = shade_mat4_identity();
    s->lamp_camera = from_lamp; /* from (3, 1.5, -1) to the middle, fovy 0.8, near 1, far 8 */
    s->material.ambient = s->material.diffuse = shade_v3(0.6f, 0.35f, 0.2f);
    s->material.specular = shade_v3(0.4f, 0.4f, 0.4f);
    s->material.shininess = 20;
    if (checkpoint == 6 && option == SHADOW)
        lamp(&s->lamp[0], 3, 1.5f, -1); /* low, so that the torus is in its own shadow */
    else
        lamp(&s->lamp[0], 2, 3, 2);
    lamp(&s->lamp[1], -3, 1, 1);
    for (int k = 0; k < MAP * MAP; k++) {
        const float light = (k / MAP / 4 + k % MAP / 4) % 2 ? 0.9f : 0.3f;
        s->map[k] = checkpoint == 6 ? shade_v3(light, 0.5f, 0.9f) /* a normal */
                                    : shade_v3(light, light, 0.5f);
    }
    torus(s, 15, 5);
}

int main(int count, char **words)
{
    static scene s;
    static picture p;
    char path[16];
    const int checkpoint = count > 1 ? atoi(words[1]) : 1, option = count > 2 ? atoi(words[2]) : 0;
    if (checkpoint < 1 || checkpoint > 6 || option < 0 || option > SILHOUETTES) {
        fprintf(stderr,
                "usage: renderer CHECKPOINT [OPTION]    1 to 6; of 6: 0 shadow, 1 bump, 2 clip, "
                "3 silhouettes\n");
        return 2;
    }
    fill(&s, checkpoint, option);
    for (int k = 0; k < WIDTH * HEIGHT; k++) p.color[k / WIDTH][k % WIDTH] = background();
    render(&s, &p);
    snprintf(path, sizeof path, "%d.png", checkpoint);
    if (!write_png(path, &p)) {
        fprintf(stderr, "%s is not written\n", path);
        return 1;
    }
    printf("%s\n", path);
    return 0;
}
