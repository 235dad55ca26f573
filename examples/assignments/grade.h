/* grade.h - judges a student's function: random inputs, the answers of shade.h beside the
   student's, and for an answer that is wrong in a common way the sentence that says which way.

     cc -O2 -I. examples/assignments/01_lambert/grade.c my.c -lm -o grade && ./grade

   ./grade [--seed N] [--json results.json] [--picture out.ppm] [--vectors]
     --seed      other random inputs; graders of a class keep theirs to themselves
     --json      the results as Gradescope's autograder reads them
     --picture   what the answers draw, the student's on the left, shade.h's on the right
     --vectors   inputs, answers and mistakes as JSON, for grade.py
   The exit status is 0 for full points. */
#ifndef ASSIGNMENTS_GRADE_H
#define ASSIGNMENTS_GRADE_H
#include "shade.h"
#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

/* whose answers are judged: tests put the right ones, and each mistake, in the student's place */
#ifndef GRADE_ANSWER
#define GRADE_ANSWER yours
#endif

enum { GRADE_IN = 64, GRADE_OUT = 12, GRADE_CASES = 8, GRADE_TRIES = 200, GRADE_SIDE = 160 };

/* Reads its arguments from in, in the order of grade_task.names, and writes its result to out. */
typedef void grade_answer(const float *in, float *out);
typedef void grade_inputs(float *in);

typedef struct grade_case {
    const char *name;
    int points;
    grade_inputs *make;
} grade_case;

typedef struct grade_mistake {
    const char *name; /* of the wrong answer, for tests */
    grade_answer *answer;
    const char *says;
} grade_mistake;

typedef struct grade_task {
    const char *name;
    const char *names; /* of the arguments with their numbers of floats: "N3 L3 n1" */
    int outputs;
    float tolerance; /* of a number x: tolerance * max(1, |x|); 0: to the bit */
    grade_answer *yours, *right;
    grade_case cases[GRADE_CASES];
    grade_mistake mistakes[GRADE_CASES];
    int (*place)(float x, float y, float *in); /* inputs of a place of the picture, x and y from
                                                     -1 to 1; 0: nothing is there */
    float scale, offset;                       /* outputs to brightness */
    int picture_points;
} grade_task;

typedef struct grade_result {
    double score;
    char says[1200];
} grade_result;

/* ---- random inputs ------------------------------------------------------------------------- */

static uint64_t grade_state;

/* splitmix64: the same numbers on every machine */
static inline uint32_t grade_bits(void)
{
    uint64_t z = grade_state += 0x9E3779B97F4A7C15u;
    z = (z ^ (z >> 30)) * 0xBF58476D1CE4E5B9u;
    z = (z ^ (z >> 27)) * 0x94D049BB133111EBu;
    return (uint32_t)(z >> 32);
}
static inline float grade_between(float low, float high)
{
    return low + (high - low) * ((float)(grade_bits() >> 8) / 16777216.0f);
}
static inline shade_vec3 grade_direction(void)
{
    shade_vec3 v;
    do v = shade_v3(grade_between(-1, 1), grade_between(-1, 1), grade_between(-1, 1));
    while (shade_length(v) > 1 || shade_length(v) < 0.1f);
    return shade_normalize(v);
}
/* A direction on the side of N where N.L > 0, or for side -1 on the other. */
static inline shade_vec3 grade_beside(shade_vec3 N, float side)
{
    shade_vec3 v = grade_direction();
    return shade_dot(N, v) * side < 0 ? shade_neg(v) : v;
}
static inline void grade_put(float *in, shade_vec3 v)
{
    in[0] = v.x;
    in[1] = v.y;
    in[2] = v.z;
}
static inline shade_vec3 grade_vec(const float *in) { return shade_v3(in[0], in[1], in[2]); }

/* The normal of a ball at a place of the picture; 0 beside it. */
static inline int grade_ball(float x, float y, shade_vec3 *N)
{
    const float z = 0.9f * 0.9f - x * x - y * y;
    if (z <= 0) return 0;
    *N = shade_scale(shade_v3(x, y, sqrtf(z)), 1 / 0.9f);
    return 1;
}

/* ---- judging ------------------------------------------------------------------------------- */

static int grade_near(const grade_task *t, const float *got, const float *want)
{
    for (int k = 0; k < t->outputs; k++) {
        const float bound = t->tolerance * fmaxf(1, fabsf(want[k]));
        if (!(fabsf(got[k] - want[k]) <= bound)) return 0; /* a NaN is not near */
    }
    return 1;
}

static size_t grade_append(char *to, size_t at, size_t size, const char *text)
{
    const size_t n = strlen(text);
    if (at + n + 1 > size) return at;
    memcpy(to + at, text, n + 1);
    return at + n;
}
static size_t grade_numbers(char *to, size_t at, size_t size, const float *v, int n)
{
    char number[32];
    if (n > 1) at = grade_append(to, at, size, "(");
    for (int k = 0; k < n; k++) {
        snprintf(number, sizeof number, "%s%.9g", k ? ", " : "", (double)v[k]);
        at = grade_append(to, at, size, number);
    }
    return n > 1 ? grade_append(to, at, size, ")") : at;
}
/* "N = (0, 0, 1), n = 8" */
static size_t grade_arguments(char *to, size_t at, size_t size, const grade_task *t,
                              const float *in)
{
    const char *p = t->names;
    for (int from = 0; *p;) {
        char name[32];
        int used = 0, count = 0;
        if (sscanf(p, "%31[^0-9]%d%n", name, &count, &used) < 2) break;
        at = grade_append(to, at, size, name);
        at = grade_append(to, at, size, " = ");
        at = grade_numbers(to, at, size, in + from, count);
        from += count;
        p += used;
        if (*p == ' ') p++;
        if (*p) at = grade_append(to, at, size, ", ");
    }
    return at;
}

/* The mistake that gives all of these answers, the right ones among them; NULL: none. */
static const grade_mistake *grade_which(const grade_task *t, float (*in)[GRADE_IN], int tries)
{
    for (int m = 0; m < GRADE_CASES && t->mistakes[m].answer; m++) {
        int same = 1;
        for (int i = 0; i < tries && same; i++) {
            float got[GRADE_OUT] = { 0 }, wrong[GRADE_OUT] = { 0 };
            t->yours(in[i], got);
            t->mistakes[m].answer(in[i], wrong);
            same = grade_near(t, got, wrong);
        }
        if (same) return &t->mistakes[m];
    }
    return NULL;
}

/* A mistake that explains the answers of all cases is the one; else one that explains those of
   this case. */
static void grade_explain(const grade_task *t, const grade_mistake *of_all, float (*in)[GRADE_IN],
                          int first, grade_result *r)
{
    const grade_mistake *mistake = of_all ? of_all : grade_which(t, in, GRADE_TRIES);
    float got[GRADE_OUT] = { 0 }, want[GRADE_OUT] = { 0 };
    size_t at = 0;
    t->yours(in[first], got);
    t->right(in[first], want);
    at = grade_append(r->says, at, sizeof r->says, "For ");
    at = grade_arguments(r->says, at, sizeof r->says, t, in[first]);
    at = grade_append(r->says, at, sizeof r->says, " yours is ");
    at = grade_numbers(r->says, at, sizeof r->says, got, t->outputs);
    at = grade_append(r->says, at, sizeof r->says, ", right is ");
    at = grade_numbers(r->says, at, sizeof r->says, want, t->outputs);
    at = grade_append(r->says, at, sizeof r->says, ". ");
    if (mistake) grade_append(r->says, at, sizeof r->says, mistake->says);
}

static void grade_run_case(const grade_task *t, const grade_case *c, const grade_mistake *of_all,
                           float (*in)[GRADE_IN], grade_result *r)
{
    int first = -1;
    for (int i = 0; i < GRADE_TRIES; i++) {
        float got[GRADE_OUT] = { 0 }, want[GRADE_OUT] = { 0 };
        t->yours(in[i], got);
        t->right(in[i], want);
        if (first < 0 && !grade_near(t, got, want)) first = i;
    }
    r->score = first < 0 ? c->points : 0;
    r->says[0] = 0;
    if (first >= 0) grade_explain(t, of_all, in, first, r);
}

/* ---- the picture --------------------------------------------------------------------------- */

static uint32_t grade_color(const grade_task *t, const float *out)
{
    uint32_t color = 0xFF000000u;
    for (int k = 0; k < 3; k++) {
        const float v = t->scale * out[t->outputs < 3 ? 0 : k] + t->offset;
        const float kept = v > 0 ? fminf(v, 1) : 0; /* NaN too is black */
        color |= (uint32_t)(kept * 255 + 0.5f) << (8 * k);
    }
    return color;
}

/* Draws both; returns how many pixels differ by more than a code. */
static int grade_draw(const grade_task *t, uint32_t *pixels)
{
    int differ = 0;
    for (int k = 0; k < GRADE_SIDE * GRADE_SIDE; k++) {
        const int i = k % GRADE_SIDE, j = k / GRADE_SIDE;
        const float x = 2 * ((float)i + 0.5f) / GRADE_SIDE - 1;
        const float y = 1 - 2 * ((float)j + 0.5f) / GRADE_SIDE;
        float in[GRADE_IN] = { 0 }, got[GRADE_OUT] = { 0 }, want[GRADE_OUT] = { 0 };
        uint32_t *left = &pixels[j * 2 * GRADE_SIDE + i], *right = left + GRADE_SIDE;
        int far = 0;
        *left = *right = 0xFF404040u;
        if (!t->place(x, y, in)) continue;
        t->yours(in, got);
        t->right(in, want);
        *left = grade_color(t, got);
        *right = grade_color(t, want);
        for (int b = 0; b < 24; b += 8)
            far |= abs((int)(*left >> b & 255) - (int)(*right >> b & 255)) > 1;
        differ += far;
    }
    return differ;
}

/* ---- what is written ----------------------------------------------------------------------- */

/* None of the texts holds a quote or a backslash. */
static void grade_json(const char *path, const grade_task *t, const grade_case *cases,
                       const grade_result *r, int count)
{
    FILE *f = fopen(path, "w");
    if (!f) {
        fprintf(stderr, "%s cannot be written.\n", path);
        exit(2);
    }
    fprintf(f, "{ \"output\": \"%s\", \"tests\": [", t->name);
    for (int i = 0; i < count; i++)
        fprintf(f,
                "%s\n  { \"name\": \"%s\", \"score\": %g, \"max_score\": %d, \"output\": \"%s\" }",
                i ? "," : "", cases[i].name, r[i].score, cases[i].points, r[i].says);
    fprintf(f, "\n] }\n");
    if (fclose(f)) exit(2);
}

static void grade_json_numbers(const float *v, int n)
{
    printf("[");
    for (int k = 0; k < n; k++)
        if (isnan(v[k]))
            printf("%sNaN", k ? "," : "");
        else if (isinf(v[k]))
            printf("%s%sInfinity", k ? "," : "", v[k] < 0 ? "-" : "");
        else
            printf("%s%.9g", k ? "," : "", (double)v[k]);
    printf("]");
}
static int grade_count_inputs(const grade_task *t)
{
    int sum = 0;
    for (const char *p = t->names; *p; p++)
        if (*p >= '0' && *p <= '9' && p > t->names && (p[1] == ' ' || !p[1])) {
            const char *from = p;
            while (from > t->names && from[-1] >= '0' && from[-1] <= '9') from--;
            sum += atoi(from);
        }
    return sum;
}
/* Inputs with the right answer, and the answer of each mistake. */
static void grade_vectors(const grade_task *t)
{
    const int n = grade_count_inputs(t);
    printf("{\"name\":\"%s\",\"names\":\"%s\",\"tolerance\":%g,\"mistakes\":[", t->name, t->names,
           (double)t->tolerance);
    for (int m = 0; m < GRADE_CASES && t->mistakes[m].answer; m++)
        printf("%s\"%s\"", m ? "," : "", t->mistakes[m].says);
    printf("],\"cases\":[");
    for (int c = 0; c < GRADE_CASES && t->cases[c].make; c++) {
        printf("%s{\"name\":\"%s\",\"points\":%d,\"tries\":[", c ? "," : "", t->cases[c].name,
               t->cases[c].points);
        for (int i = 0; i < GRADE_TRIES; i++) {
            float in[GRADE_IN] = { 0 }, out[GRADE_OUT] = { 0 };
            t->cases[c].make(in);
            t->right(in, out);
            printf("%s[", i ? "," : "");
            grade_json_numbers(in, n);
            printf(",");
            grade_json_numbers(out, t->outputs);
            for (int m = 0; m < GRADE_CASES && t->mistakes[m].answer; m++) {
                memset(out, 0, sizeof out);
                t->mistakes[m].answer(in, out);
                printf(",");
                grade_json_numbers(out, t->outputs);
            }
            printf("]");
        }
        printf("]}");
    }
    printf("]}\n");
}

static int grade_main(const grade_task *t, int argc, char **argv)
{
    static uint32_t pixels[2 * GRADE_SIDE * GRADE_SIDE];
    static float in[GRADE_CASES * GRADE_TRIES][GRADE_IN];
    const char *json = NULL, *picture = NULL;
    grade_case cases[GRADE_CASES + 1];
    grade_result results[GRADE_CASES + 1];
    double score = 0;
    int count = 0, points = 0, vectors = 0;

    grade_state = 1;
    for (int i = 1; i < argc; i++) {
        if (!strcmp(argv[i], "--vectors"))
            vectors = 1;
        else if (!strcmp(argv[i], "--seed") && i + 1 < argc)
            grade_state = strtoull(argv[++i], NULL, 10);
        else if (!strcmp(argv[i], "--json") && i + 1 < argc)
            json = argv[++i];
        else if (!strcmp(argv[i], "--picture") && i + 1 < argc)
            picture = argv[++i];
        else {
            fprintf(stderr,
                    "usage: %s [--seed N] [--json results.json] [--picture out.ppm] "
                    "[--vectors]\n",
                    argv[0]);
            return 2;
        }
    }
    if (vectors) {
        grade_vectors(t);
        return 0;
    }
    for (; count < GRADE_CASES && t->cases[count].make; count++) {
        cases[count] = t->cases[count];
        for (int i = 0; i < GRADE_TRIES; i++) cases[count].make(in[count * GRADE_TRIES + i]);
    }
    const grade_mistake *of_all = grade_which(t, in, count * GRADE_TRIES);
    for (int i = 0; i < count; i++)
        grade_run_case(t, &cases[i], of_all, in + i * GRADE_TRIES, &results[i]);
    cases[count].name = "the picture";
    cases[count].points = t->picture_points;
    const int differ = grade_draw(t, pixels);
    results[count].score = differ ? 0 : t->picture_points;
    results[count].says[0] = 0;
    if (differ)
        snprintf(results[count].says, sizeof results[count].says,
                 "%d of its pixels are not those of shade.h; --picture out.ppm shows both.",
                 differ);
    count++;
    for (int i = 0; i < count; i++) {
        printf("%s  %s: %g of %d\n", results[i].says[0] ? "FAIL" : "ok  ", cases[i].name,
               results[i].score, cases[i].points);
        if (results[i].says[0]) printf("      %s\n", results[i].says);
        score += results[i].score;
        points += cases[i].points;
    }
    printf("%s: %g of %d points\n", t->name, score, points);
    if (json) grade_json(json, t, cases, results, count);
    if (picture) {
        shade_target target = { .width = 2 * GRADE_SIDE, .height = GRADE_SIDE, .color = pixels };
        if (shade_write_ppm(picture, &target)) {
            fprintf(stderr, "%s cannot be written.\n", picture);
            return 2;
        }
    }
    return score < points;
}
#endif
