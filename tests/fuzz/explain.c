/* explain.c - no sentence of shade_explain is false: see explained.h.

   With EXPLAIN_STATES it is a program: states KIND COUNT [FIRST [SHOWN]] judges COUNT states of a
   kind, random or ordinary, prints each sentence's count and what is false, SHOWN (5) of a kind,
   and fails where anything is.  States are numbered from FIRST on; a COUNT of 1 prints what the
   state is made of. */
#include "input.h"

#include <math.h>
#include <stddef.h>

#ifdef EXPLAIN_STATES
static uint64_t explain_random;
static int explained_pick(int n)
{
    explain_random = explain_random * 6364136223846793005u + 1442695040888963407u;
    return (int)((explain_random >> 33) % (uint64_t)n);
}
#else
static fuzz_input explain_input;
static int explained_pick(int n)
{
    const uint32_t low = fuzz_byte(&explain_input), high = n > 256 ? fuzz_byte(&explain_input) : 0;
    return (int)((low | high << 8) % (uint32_t)n);
}
#endif
#include "explained.h"

#ifdef EXPLAIN_STATES
/* Is every triangle dark in the whole picture, drawn alone? */
static int ex_is_each_dark(const explained *e, const stage *whole)
{
    static picture drawn;
    static stage one;
    ex_copy(whole, &one);
    cure_chunks(&one);
    cure_indices(&one);
    one.mesh.index_count = 3;
    for (int i = 0; i + 2 < ex_corners(&whole->mesh); i += 3) {
        for (int k = 0; k < 3; k++) one.index[k] = ex_vertex(&whole->mesh, i + k);
        ex_draw(e, &one, &drawn);
        if (drawn.bright) return 0;
    }
    return 1;
}
/* Is the picture black, in a way that cannot be meant?  A band or a strip may miss the mesh, or
   another one hide it; black surfaces are outlines where fronts are culled, and shadows where they
   are blended over a ground.  A band does not tell which triangles others show, nor what a shader
   would leave there, which is not called: all triangles must be dark. */
static int ex_is_black(explained *e, shade_stats *stats)
{
    static picture drawn;
    static stage whole;
    const shade_draw_state *d = &e->s.state;
    const shade_material *m = d->material;
    const int outline = d->raster.cull == SHADE_CULL_FRONT || d->raster.blend == SHADE_BLEND_OVER;
    ex_draw(e, &e->s, &drawn);
    *stats = drawn.stats;
    if (drawn.result || !e->s.target.color || drawn.bright) return 0;
    if (m && outline && ex_most(m->emission) <= 0 && ex_most(m->ambient) <= 0 &&
        ex_most(m->diffuse) <= 0 && ex_most(m->specular) <= 0)
        return 0;
    if (d->fragment && d->raster.cull == SHADE_CULL_FRONT) return 0;
    ex_copy(&e->s, &whole);
    cure_clip(&whole);
    if (!drawn.stats.fragments &&
        (e->s.target.clip_width || e->s.target.row_count || e->other.col[3].w != 0)) return 0;
    if (e->s.target.clip_width || e->s.target.row_count)
        return !d->fragment && ex_is_each_dark(e, &whole);
    ex_draw(e, &whole, &drawn);
    return !drawn.bright;
}

static void explain_matrix(const char *name, shade_mat4 m)
{
    printf("%s", name);
    for (int k = 0; k < 16; k++) printf(" %g", (double)(&m.col[k / 4].x)[k % 4]);
    printf("\n");
}
static void explain_vector(const char *name, shade_vec3 v)
{
    printf("  %s %g %g %g", name, (double)v.x, (double)v.y, (double)v.z);
}
/* The fields of a state that decide most. */
static void explain_print(const explained *e, int with_stats, const char *said)
{
    const stage *s = &e->s;
    const shade_draw_state *d = &s->state;
    const shade_raster *r = &d->raster;
    const shade_target *t = &s->target;
    printf("%s stats, mistakes (%s, %s): \"%s\"\n", with_stats ? "with" : "without", e->made[0],
           e->made[1], said);
    printf("format %d srgb %d color %d depth %d clip %d %d %d %d rows %d %d clear %g draws %d "
           "another before %d\n",
           t->format, t->srgb, t->color != NULL, t->depth != NULL, t->clip_x, t->clip_y,
           t->clip_width, t->clip_height, t->row_offset, t->row_count, (double)s->clear, s->draws,
           e->other.col[3].w != 0);
    printf("vertices %d indices %d normals %d colors %d texcoords %d chunks %d map %d\n",
           s->mesh.vertex_count, s->mesh.index_count, s->mesh.normals != NULL,
           s->mesh.colors != NULL, s->mesh.texcoords != NULL, s->mesh.chunk_count,
           d->diffuse_map != NULL);
    printf("cull %d test %d blend %d read only %d zero to one %d bias %g transparency %g cutoff %g "
           "shader %d shading %d\n",
           r->cull, r->depth_test, r->blend, r->depth_read_only, r->depth_zero_to_one,
           (double)r->depth_bias, (double)d->transparency, (double)d->alpha_cutoff,
           d->fragment != NULL, d->shading);
    explain_matrix("model", d->model);
    explain_matrix("view", d->view);
    explain_matrix("projection", d->projection);
    printf("model %d flags %u terms %u", d->lighting.model, d->lighting.flags, d->lighting.terms);
    explain_vector("ambient", d->lighting.ambient);
    printf("\n");
    for (int k = 0; k < d->lighting.light_count && d->lighting.lights; k++) {
        const shade_light *l = &d->lighting.lights[k];
        printf("lamp %g %g %g %g", (double)l->position.x, (double)l->position.y,
               (double)l->position.z, (double)l->position.w);
        explain_vector("diffuse", l->diffuse);
        explain_vector("specular", l->specular);
        explain_vector("spot", l->spot_direction);
        printf(" %g %g  attenuation %g %g %g\n", (double)l->spot_cos_cutoff,
               (double)l->spot_exponent, (double)l->constant, (double)l->linear,
               (double)l->quadratic);
    }
    printf(d->material ? "material" : "no material");
    for (int k = 0; k < 4 && d->material; k++) {
        static const char *const name[] = { "emission", "ambient", "diffuse", "specular" };
        explain_vector(name[k], (&d->material->emission)[k]);
    }
    printf("  shininess %g\n", (double)s->material.shininess);
}
int main(int count, char **words)
{
    static explained e;
    static long times[EX_CLAIMS], wrong[EX_CLAIMS];
    const int ordinary = count > 1 && !strcmp(words[1], "ordinary");
    const long states = count > 2 ? atol(words[2]) : 1000, first = count > 3 ? atol(words[3]) : 0;
    const long shown = count > 4 ? atol(words[4]) : 5;
    long said = 0, falsehoods = 0, black = 0, silent = 0, never = 0;
    for (long k = first; k < first + states; k++) {
        const char *text;
        int row;
        explain_random = ((uint64_t)k * 2 + (uint64_t)ordinary) * 0x9E3779B97F4A7C15u;
        explained_pick(2);
        if (ordinary) ex_ordinary(&e);
        else ex_random(&e);
        row = ex_explain(&e, k % 2 == 0, &text);
        if (states == 1) explain_print(&e, k % 2 == 0, text);
        said += *text != 0;
        if (row == EX_NOTHING) {
            shade_stats stats;
            const int dark = ex_is_black(&e, &stats);
            silent++;
            black += dark;
            if (dark && black <= shown)
                printf("black, and nothing is said: %ld (%s, %s), %s stats, %lld triangles drawn, "
                       "%lld fragments\n", k, e.made[0], e.made[1], k % 2 ? "without" : "with",
                       (long long)stats.drawn, (long long)stats.fragments);
        }
        if (row >= EX_FALSE) {
            const int claim = row - EX_FALSE;
            falsehoods++;
            if (claim == EX_CLAIMS || wrong[claim]++ < shown)
                printf("false: %ld (%s, %s) %s\n", k, e.made[0], e.made[1], text);
        }
        if (row >= 0 && row % EX_FALSE < EX_CLAIMS) times[row % EX_FALSE]++;
    }
    for (int k = 0; k < EX_CLAIMS; k++) {
        printf("%9ld  %s", times[k], claims[k].words);
        if (wrong[k]) printf("   %ld FALSE", wrong[k]);
        printf("\n");
        never += !times[k];
    }
    printf("%ld %s states, %ld sentences, %ld false, %ld black pictures without a sentence; "
           "%ld rows were never said\n",
           states, ordinary ? "ordinary" : "random", said, falsehoods, black, never);
    return falsehoods != 0;
}
#else
int LLVMFuzzerTestOneInput(const uint8_t *data, size_t size)
{
    static explained e;
    const char *said;
    int row;
    explain_input.at = data;
    explain_input.end = data + size;
    if (size % 4 == 3) ex_ordinary(&e);
    else ex_random(&e);
    row = ex_explain(&e, size % 2, &said);
    /* every sentence has a row; how many of them are true explain.sh counts */
    if (row == EX_CLAIMS + EX_FALSE) fprintf(stderr, "%s\n", said);
    HOLDS(row != EX_CLAIMS + EX_FALSE);
    return 0;
}
#endif
