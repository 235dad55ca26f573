/* grade.h - judges a student's function: random inputs, the answers of shade.h beside the
   student's, and for an answer that is wrong in a common way the sentence that says which way.

     cc -O2 -I. examples/teaching/assignments/01_lambert/grade.c my.c -lm -o grade && ./grade

   ./grade [--seed N] [--json results.json] [--picture out.ppm] [--mistake NAME] [--vectors]
     --seed      other random inputs; graders of a class keep theirs to themselves
     --json      the results as Gradescope's autograder reads them
     --picture   what the answers draw, the student's on the left, shade.h's on the right
     --mistake   what a common mistake of grade.c would be told, in place of the student's answers
     --vectors   inputs, answers and mistakes as JSON, for grade.py
   The exit status is 0 for full points. */
#ifndef ASSIGNMENTS_GRADE_H
#define ASSIGNMENTS_GRADE_H
#include "shade.h"
#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

enum { GRADE_IN = 64, GRADE_OUT = 12, GRADE_CASES = 8, GRADE_MISTAKES = 12 };
enum { GRADE_TRIES = 200, GRADE_SIDE = 160 }; /* inputs of a case; pixels of each picture */

/* Reads its arguments from in, in the order of grade_task.names, and writes its result to out. */
typedef void grade_answer(const float *in, float *out);
typedef void grade_inputs(float *in);

typedef struct grade_case {
    const char *name;
    int points;
    grade_inputs *make;
    const char *hint; /* for wrong answers that are no known mistake */
} grade_case;

typedef struct grade_mistake {
    const char *name; /* of the wrong answer, for --mistake */
    grade_answer *answer;
    const char *says;
} grade_mistake;

typedef struct grade_task {
    const char *name;
    const char *names; /* of the arguments with their numbers of floats: "N3 L3 n1" */
    const char *parts; /* of the outputs, named likewise; NULL: they are one thing */
    int outputs;
    float tolerance; /* of a number x: tolerance * max(1, |x|); 0: to the bit */
    grade_answer *yours, *right;
    grade_case cases[GRADE_CASES];
    grade_mistake mistakes[GRADE_MISTAKES];
    int (*place)(float x, float y, float *in); /* inputs of a place of the picture, x and y from
                                                     -1 to 1; 0: nothing is there */
    int shown;           /* the first output in the picture; three are a colour, two red, green */
    float scale, offset; /* outputs to brightness */
    int picture_points;
} grade_task;

typedef struct grade_result {
    double score;
    char says[1600];
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

/* Are two numbers equal within the tolerance?  No right answer is a NaN; two NaN are the same
   mistake. */
static int grade_close(const grade_task *t, float got, float want)
{
    if (got == want || (isnan(got) && isnan(want))) return 1;
    return isfinite(want) && fabsf(got - want) <= t->tolerance * fmaxf(1, fabsf(want));
}
static int grade_near(const grade_task *t, const float *got, const float *want)
{
    for (int k = 0; k < t->outputs; k++)
        if (!grade_close(t, got[k], want[k])) return 0;
    return 1;
}

static size_t grade_append(char *to, size_t at, size_t size, const char *text)
{
    const size_t n = strlen(text);
    if (at + n + 1 > size) return at;
    memcpy(to + at, text, n + 1);
    return at + n;
}
/* Appends a sentence to what a result says. */
static void grade_say(grade_result *r, const char *sentence)
{
    const size_t at = grade_append(r->says, strlen(r->says), sizeof r->says, " ");
    grade_append(r->says, at, sizeof r->says, sentence);
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
/* "N = (0, 0, 1), n = 8" for the names "N3 n1" */
static size_t grade_arguments(char *to, size_t at, size_t size, const char *names,
                              const float *in)
{
    const char *p = names;
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

static size_t grade_output(char *to, size_t at, size_t size, const grade_task *t, const float *out)
{
    return t->parts ? grade_arguments(to, at, size, t->parts, out)
                    : grade_numbers(to, at, size, out, t->outputs);
}

/* Does a mistake give the student's answers?  If whole is not set, only outputs count in which it
   is a mistake: H and the lobe of one answer may be wrong in a way of their own. */
static int grade_gives(const grade_task *t, const grade_mistake *m, float (*in)[GRADE_IN],
                       int tries, int whole)
{
    int differs[GRADE_OUT] = { 0 }, other[GRADE_OUT] = { 0 }, any = 0;
    for (int i = 0; i < tries; i++) {
        float got[GRADE_OUT] = { 0 }, want[GRADE_OUT] = { 0 }, wrong[GRADE_OUT] = { 0 };
        t->yours(in[i], got);
        t->right(in[i], want);
        m->answer(in[i], wrong);
        for (int k = 0; k < t->outputs; k++) {
            differs[k] |= !grade_close(t, wrong[k], want[k]);
            other[k] |= !grade_close(t, got[k], wrong[k]);
        }
    }
    for (int k = 0; k < t->outputs; k++) {
        any |= differs[k];
        if ((whole || differs[k]) && other[k]) return 0;
    }
    return any;
}

/* The mistakes that give these answers, as bits in their order */
static unsigned grade_which(const grade_task *t, float (*in)[GRADE_IN], int tries, int whole)
{
    unsigned bits = 0;
    for (int m = 0; m < GRADE_MISTAKES && t->mistakes[m].answer; m++)
        if (grade_gives(t, &t->mistakes[m], in, tries, whole)) bits |= 1u << m;
    return bits;
}

/* Is the answer the same whatever the input? */
static int grade_constant(const grade_task *t, float (*in)[GRADE_IN], int tries)
{
    float first[GRADE_OUT] = { 0 };
    t->yours(in[0], first);
    for (int i = 1; i < tries; i++) {
        float got[GRADE_OUT] = { 0 };
        t->yours(in[i], got);
        if (!grade_near(t, got, first)) return 0;
    }
    return 1;
}

/* What is known of the answers to all inputs */
typedef struct grade_known {
    int constant;
    unsigned mistakes;
} grade_known;

/* What numbers tell by themselves; NULL: nothing */
static const char *grade_not_finite(const grade_task *t, const float *got)
{
    const char *says = NULL;
    for (int k = 0; k < t->outputs; k++) {
        if (isinf(got[k])) says = "An infinity comes from a division by 0.";
        if (isnan(got[k]))
            return "A NaN comes from 0 / 0, or from a root or a power of a negative number.";
    }
    return says;
}

/* Appends why the answers of a case are wrong: the mistakes that explain all cases, else one that
   explains this case alone, else what its numbers tell, else the hint. */
static void grade_why(const grade_task *t, const grade_case *c, const grade_known *all,
                      float (*in)[GRADE_IN], const float *got, grade_result *r)
{
    const unsigned sure = grade_which(t, in, GRADE_TRIES, 0) & all->mistakes;
    const int alike = grade_constant(t, in, GRADE_TRIES); /* then any mistake may fit */
    const unsigned here = alike ? 0 : grade_which(t, in, GRADE_TRIES, 1);
    const unsigned named = sure ? sure : here & (~here + 1);
    const char *numbers = grade_not_finite(t, got);
    if (all->constant) grade_say(r, "Your answer is the same for every input.");
    if (named && !sure) grade_say(r, "In this case, perhaps:");
    for (int m = 0; m < GRADE_MISTAKES; m++)
        if (named >> m & 1) grade_say(r, t->mistakes[m].says);
    if (!named && numbers) grade_say(r, numbers);
    if (!named && !all->constant) grade_say(r, c->hint);
}

/* The first wrong answer of a case, and why it is wrong */
static void grade_explain(const grade_task *t, const grade_case *c, const grade_known *all,
                          float (*in)[GRADE_IN], int first, int wrong, grade_result *r)
{
    const size_t size = sizeof r->says;
    float got[GRADE_OUT] = { 0 }, want[GRADE_OUT] = { 0 };
    size_t at;
    t->yours(in[first], got);
    t->right(in[first], want);
    snprintf(r->says, size, "Wrong for %d of %d inputs. For ", wrong, GRADE_TRIES);
    at = grade_arguments(r->says, strlen(r->says), size, t->names, in[first]);
    at = grade_append(r->says, at, size, " yours is ");
    at = grade_output(r->says, at, size, t, got);
    at = grade_append(r->says, at, size, ", right is ");
    at = grade_output(r->says, at, size, t, want);
    grade_append(r->says, at, size, ".");
    grade_why(t, c, all, in, got, r);
}

static void grade_run_case(const grade_task *t, const grade_case *c, const grade_known *all,
                           float (*in)[GRADE_IN], grade_result *r)
{
    int first = -1, wrong = 0;
    for (int i = 0; i < GRADE_TRIES; i++) {
        float got[GRADE_OUT] = { 0 }, want[GRADE_OUT] = { 0 };
        t->yours(in[i], got);
        t->right(in[i], want);
        if (grade_near(t, got, want)) continue;
        if (!wrong++) first = i;
    }
    r->score = wrong ? 0 : c->points;
    r->says[0] = 0;
    if (wrong) grade_explain(t, c, all, in, first, wrong, r);
}

/* ---- the picture --------------------------------------------------------------------------- */

static uint32_t grade_color(const grade_task *t, const float *out)
{
    uint32_t color = 0xFF000000u;
    const int n = t->outputs - t->shown;
    for (int k = 0; k < (n == 2 ? 2 : 3); k++) {
        const float v = t->scale * out[t->shown + (n < 2 ? 0 : k)] + t->offset;
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
    FILE *f = path ? fopen(path, "w") : NULL;
    if (!path) return;
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
    for (int m = 0; m < GRADE_MISTAKES && t->mistakes[m].answer; m++)
        printf("%s\"%s\"", m ? "," : "", t->mistakes[m].says);
    printf("],\"cases\":[");
    for (int c = 0; c < GRADE_CASES && t->cases[c].make; c++) {
        printf("%s{\"name\":\"%s\",\"points\":%d,\"hint\":\"%s\",\"tries\":[", c ? "," : "",
               t->cases[c].name, t->cases[c].points, t->cases[c].hint);
        for (int i = 0; i < GRADE_TRIES; i++) {
            float in[GRADE_IN] = { 0 }, out[GRADE_OUT] = { 0 };
            t->cases[c].make(in);
            t->right(in, out);
            printf("%s[", i ? "," : "");
            grade_json_numbers(in, n);
            printf(",");
            grade_json_numbers(out, t->outputs);
            for (int m = 0; m < GRADE_MISTAKES && t->mistakes[m].answer; m++) {
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

typedef struct grade_options {
    const char *json, *picture, *mistake;
    int vectors;
} grade_options;

/* Returns 0 where the arguments are not those of the usage. */
static int grade_read_options(int argc, char **argv, grade_options *o)
{
    grade_state = 1;
    for (int i = 1; i < argc; i++) {
        const char *value = i + 1 < argc ? argv[i + 1] : NULL;
        if (!strcmp(argv[i], "--vectors")) {
            o->vectors = 1;
            continue;
        }
        if (value && !strcmp(argv[i], "--seed"))
            grade_state = strtoull(value, NULL, 10);
        else if (value && !strcmp(argv[i], "--json"))
            o->json = value;
        else if (value && !strcmp(argv[i], "--picture"))
            o->picture = value;
        else if (value && !strcmp(argv[i], "--mistake"))
            o->mistake = value;
        else {
            fprintf(stderr,
                    "usage: %s [--seed N] [--json results.json] [--picture out.ppm] "
                    "[--mistake NAME] [--vectors]\n",
                    argv[0]);
            return 0;
        }
        i++;
    }
    return 1;
}

/* Puts a mistake in the place of the student's answers; 0: the task has none of that name. */
static int grade_put_mistake(grade_task *t, const char *name)
{
    for (int m = 0; m < GRADE_MISTAKES && t->mistakes[m].answer; m++) {
        if (strcmp(t->mistakes[m].name, name)) continue;
        t->yours = t->mistakes[m].answer;
        return 1;
    }
    fprintf(stderr, "%s has no mistake of the name %s.\n", t->name, name);
    return 0;
}

/* Makes the inputs of all cases, and adds the picture as the last.  Every result is 0 at first, and
   says what is true if the student's function never returns.  Returns how many there are. */
static int grade_prepare(const grade_task *t, float (*in)[GRADE_IN], grade_case *cases,
                         grade_result *results)
{
    int count = 0;
    for (; count < GRADE_CASES && t->cases[count].make; count++) {
        cases[count] = t->cases[count];
        for (int i = 0; i < GRADE_TRIES; i++) cases[count].make(in[count * GRADE_TRIES + i]);
    }
    cases[count].name = "the picture";
    cases[count++].points = t->picture_points;
    for (int i = 0; i < count; i++) {
        results[i].score = 0;
        snprintf(results[i].says, sizeof results[i].says,
                 "The program did not finish: it crashed, called exit, or ran into a loop.");
    }
    return count;
}

/* Prints the results; returns whether all points were reached. */
static int grade_print(const grade_task *t, const grade_case *cases, const grade_result *r,
                       int count)
{
    double score = 0;
    int points = 0;
    for (int i = 0; i < count; i++) {
        printf("%s  %s: %g of %d\n", r[i].says[0] ? "FAIL" : "ok  ", cases[i].name, r[i].score,
               cases[i].points);
        if (r[i].says[0]) printf("      %s\n", r[i].says);
        score += r[i].score;
        points += cases[i].points;
    }
    printf("%s: %g of %d points\n", t->name, score, points);
    return score >= points;
}

static int grade_main(const grade_task *of, int argc, char **argv)
{
    grade_task task = *of, *const t = &task;
    static uint32_t pixels[2 * GRADE_SIDE * GRADE_SIDE];
    static float in[GRADE_CASES * GRADE_TRIES][GRADE_IN];
    static grade_result results[GRADE_CASES + 1];
    grade_case cases[GRADE_CASES + 1];
    grade_options o = { 0 };
    const shade_target picture = { .width = 2 * GRADE_SIDE, .height = GRADE_SIDE, .color = pixels };

    if (!grade_read_options(argc, argv, &o)) return 2;
    if (o.mistake && !grade_put_mistake(t, o.mistake)) return 2;
    if (o.vectors) {
        grade_vectors(t);
        return 0;
    }
    const int count = grade_prepare(t, in, cases, results), tries = (count - 1) * GRADE_TRIES;
    grade_json(o.json, t, cases, results, count);
    const grade_known all = { grade_constant(t, in, tries), grade_which(t, in, tries, 0) };
    for (int i = 0; i < count - 1; i++)
        grade_run_case(t, &cases[i], &all, in + i * GRADE_TRIES, &results[i]);
    const int differ = grade_draw(t, pixels);
    results[count - 1].score = differ ? 0 : t->picture_points;
    snprintf(results[count - 1].says, sizeof results->says,
             differ ? "%d of its pixels are not those of shade.h; --picture out.ppm shows both."
                    : "",
             differ);
    const int full = grade_print(t, cases, results, count);
    grade_json(o.json, t, cases, results, count);
    if (o.picture && shade_write_ppm(o.picture, &picture)) {
        fprintf(stderr, "%s cannot be written.\n", o.picture);
        return 2;
    }
    return !full;
}
#endif
