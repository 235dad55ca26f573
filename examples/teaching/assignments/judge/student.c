/* student.c - the process of a student's C file.  It reads inputs from a pipe, calls the student's
   function, and writes numbers to another pipe, whose number is its argument: for each input a 1
   and the answer.  What the student prints goes elsewhere.  The judge keeps the right answers;
   nothing of them is here, and no function that gives them.  TASK is the number of the task. */
#include "vectors.h"
#include "prototypes.h"
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <sys/resource.h>
#include <unistd.h>

static shade_vec3 vec(const float *in) { return shade_v3(in[0], in[1], in[2]); }
static void put(double *out, shade_vec3 v)
{
    out[0] = (double)v.x;
    out[1] = (double)v.y;
    out[2] = (double)v.z;
}

#if TASK == 1
enum { INPUTS = 6, OUTPUTS = 1 };
static void answer(const float *in, double *out) { out[0] = (double)lambert(vec(in), vec(in + 3)); }

#elif TASK == 2
enum { INPUTS = 6, OUTPUTS = 3 };
static void answer(const float *in, double *out) { put(out, mirror(vec(in), vec(in + 3))); }

#elif TASK == 3
enum { INPUTS = 10, OUTPUTS = 4 };
static void answer(const float *in, double *out)
{
    put(out, halfway(vec(in + 3), vec(in + 6)));
    out[3] = (double)phong(vec(in), vec(in + 3), vec(in + 6), in[9]);
}

#elif TASK == 4
enum { INPUTS = 4, OUTPUTS = 1 };
static void answer(const float *in, double *out)
{
    out[0] = (double)attenuation(in[0], in[1], in[2], in[3]);
}

#elif TASK == 5
enum { INPUTS = 8, OUTPUTS = 1 };
static void answer(const float *in, double *out)
{
    out[0] = (double)spot(vec(in), vec(in + 3), in[6], in[7]);
}

#elif TASK == 6
enum { INPUTS = 16, OUTPUTS = 9 };
static void answer(const float *in, double *out)
{
    shade_mat4 model;
    shade_mat3 got;
    memcpy(&model, in, sizeof model);
    got = normal_matrix(model);
    for (int k = 0; k < 3; k++) put(out + 3 * k, got.col[k]);
}

#elif TASK == 7
enum { INPUTS = 6, OUTPUTS = 64 };
static void answer(const float *in, double *out)
{
    for (int k = 0; k < OUTPUTS; k++) {
        const int x[3] = { (int)in[0], (int)in[1], (int)in[2] };
        const int y[3] = { (int)in[3], (int)in[4], (int)in[5] };
        out[k] = covers(x, y, k % 8, k / 8) != 0;
    }
}

#elif TASK == 8
enum { INPUTS = 9, OUTPUTS = 1 };
static void answer(const float *in, double *out) { out[0] = (double)depth_at(in, in + 3, in + 6); }

#elif TASK == 9
enum { INPUTS = 12, OUTPUTS = 2 };
static void answer(const float *in, double *out)
{
    shade_vec2 uv[3], got;
    memcpy(uv, in + 3, sizeof uv);
    got = texture_at(in, uv, in + 9);
    out[0] = (double)got.x;
    out[1] = (double)got.y;
}

#elif TASK == 10
enum { LAMP = 20, LAMPS = 3, AT_LAMPS = 26, INPUTS = AT_LAMPS + LAMP * LAMPS, OUTPUTS = 3 };
static void answer(const float *in, double *out)
{
    shade_light lamps[LAMPS] = { 0 };
    const shade_material m = { .emission = vec(in + 9),
                               .ambient = vec(in + 12),
                               .diffuse = vec(in + 15),
                               .specular = vec(in + 18),
                               .shininess = in[21] };
    const shade_lighting lighting = { .lights = lamps,
                                      .light_count = (int)in[25],
                                      .ambient = vec(in + 22) };
    for (int k = 0; k < lighting.light_count; k++) {
        const float *from = in + AT_LAMPS + LAMP * k;
        lamps[k].position = shade_v4(from[0], from[1], from[2], 1);
        lamps[k].spot_direction = vec(from + 3);
        lamps[k].spot_cos_cutoff = from[6];
        lamps[k].spot_exponent = from[7];
        lamps[k].ambient = vec(from + 8);
        lamps[k].diffuse = vec(from + 11);
        lamps[k].specular = vec(from + 14);
        lamps[k].constant = from[17];
        lamps[k].linear = from[18];
        lamps[k].quadratic = from[19];
    }
    put(out, iteration_four(&lighting, &m, vec(in), vec(in + 3), vec(in + 6)));
}

#elif TASK == 11
enum { INPUTS = 17, OUTPUTS = 3 };
static void answer(const float *in, double *out)
{
    const shade_vec3 color[3] = { vec(in + 6), vec(in + 9), vec(in + 12) };
    put(out, color_at(in, in + 3, color, in[15], in[16]));
}

#elif TASK == 12
enum { INPUTS = 23, OUTPUTS = 2 };
static void answer(const float *in, double *out)
{
    out[0] = (double)level(in[0], in[1], in[2], in[3], in[4]);
    out[1] = (double)bilinear(in + 5, in[21], in[22]);
}

#elif TASK == 13
enum { INPUTS = 12, OUTPUTS = 17 };
static void answer(const float *in, double *out)
{
    shade_vec4 corner[3], kept[4];
    const float *numbers = &kept[0].x;
    int count;
    memcpy(corner, in, sizeof corner);
    memset(kept, 0, sizeof kept);
    count = clip_near(corner, kept);
    out[0] = count;
    for (int k = 0; k < 16; k++) out[1 + k] = k < 4 * count ? (double)numbers[k] : 0;
}

#elif TASK == 14
enum { INPUTS = 9, OUTPUTS = 3 };
static void answer(const float *in, double *out)
{
    put(out, bumped(vec(in), vec(in + 3), vec(in + 6)));
}

#elif TASK == 15
enum { INPUTS = 36, OUTPUTS = 1 };
static void answer(const float *in, double *out)
{
    shade_mat4 lamp;
    memcpy(&lamp, in + 16, sizeof lamp);
    out[0] = lit(in, lamp, vec(in + 32), in[35]) != 0;
}

#elif TASK == 20 /* the project: scene.h stands in prototypes.h */
enum { INPUTS = sizeof(scene) / sizeof(float), OUTPUTS = 3 * WIDTH * HEIGHT };
static void answer(const float *in, double *out)
{
    static scene s;
    static picture p;
    memcpy(&s, in, sizeof s);
    for (int k = 0; k < WIDTH * HEIGHT; k++) p.color[k / WIDTH][k % WIDTH] = background();
    render(&s, &p);
    for (int k = 0; k < WIDTH * HEIGHT; k++) put(out + 3 * k, p.color[k / WIDTH][k % WIDTH]);
}
#endif

/* Reads or writes all of the bytes; 0 at the end of the pipe. */
static int all_in(void *to, size_t size)
{
    for (size_t at = 0; at < size;) {
        const ssize_t n = read(0, (char *)to + at, size - at);
        if (n <= 0) return 0;
        at += (size_t)n;
    }
    return 1;
}
static int all_out(int file, const void *from, size_t size)
{
    for (size_t at = 0; at < size;) {
        const ssize_t n = write(file, (const char *)from + at, size - at);
        if (n <= 0) return 0;
        at += (size_t)n;
    }
    return 1;
}

int main(int count, char **words)
{
    const struct rlimit none = { 0, 0 };
    const int answers = count == 2 ? atoi(words[1]) : -1;
    float in[INPUTS];
    double out[1 + OUTPUTS] = { 1 };
    if (answers < 0 || setvbuf(stdout, NULL, _IONBF, 0)) return 1;
    if (setrlimit(RLIMIT_NOFILE, &none)) return 1; /* for programs that are not linked statically */
    while (all_in(in, sizeof in)) {
        answer(in, out + 1);
        if (!all_out(answers, out, sizeof out)) return 1;
    }
    return 0;
}
