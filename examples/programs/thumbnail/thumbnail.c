/* thumbnail.c - draws a picture of a model file, on a machine that needs neither GPU nor window.

   cc -O2 -pthread -I. examples/programs/thumbnail/thumbnail.c -lm -o thumbnail
   ./thumbnail bunny.obj bunny.ppm

   With libstb-dev it also reads textures and writes PNG, with libassimp-dev it reads more formats
   than OBJ, STL, PLY and glTF:
   cc -O2 -pthread -I. -DMODEL_STB -DMODEL_ASSIMP examples/programs/thumbnail/thumbnail.c \
      -lassimp -lm -o thumbnail

   The model may have any size and place: it is moved to the origin and made one unit large, and the
   camera stands as near as it can without cutting anything off.  The picture's file appears whole
   or not at all. */
#define _DEFAULT_SOURCE /* NOLINT: the system's own name, for POSIX with -std=c99 */
#define SHADE_IMPLEMENTATION
#include "shade.h"
#include "options.h"
#include "drawing.h"
#include <time.h>
#ifdef __GLIBC__
#include <malloc.h>
#endif

/* ---- progress ------------------------------------------------------------------------------- */

/* Progress: nothing in the first second of work, then a line that rewrites itself, only on a
   terminal */
typedef struct progress {
    clock_t begin;
    const char *what;
    int percent, shown, silent;
} progress;

static void report(void *user, double part)
{
    progress *p = (progress *)user;
    int percent = (int)(part * 100);
    char line[80];
    if (p->silent || percent == p->percent || clock() - p->begin < CLOCKS_PER_SEC) return;
    p->percent = percent;
    p->shown = 1;
    snprintf(line, sizeof line, "\r%s %3d %%", p->what, percent);
    guard_say(line);
}

static void report_next(progress *p, const char *what)
{
    if (p->shown) fprintf(stderr, "\r%*s\r", (int)strlen(p->what) + 6, "");
    p->what = what;
    p->percent = -1;
    p->shown = 0;
    guard_doing = *what ? what : "ending";
}

/* ---- what is done --------------------------------------------------------------------------- */

static int read_model(const options *o, model *m, progress *p)
{
    model_options how = o->how;
    int failed;
    how.no_lines = o->drawing.view_count > 0;
    report_next(p, "reading the model");
    failed = model_open(o->input, &how, m, report, p);
    report_next(p, "");
    if (!failed) failed = check_inputs(o, m);
    if (failed) return failed;
    if (o->drawing.view_count) { /* lines that it has are drawn */
        if (!o->how.quiet) model_blank(m);
        return model_cut(m, &o->how, 0, 0, shade_v3(1, 1, 1));
    }
    return portrait_prepare(m, &o->picture, &o->how);
}

/* 1: nothing can be seen: each row of the picture is of one colour, as the background is. */
static int is_blank(const shade_target *picture)
{
    const shade_vec4 *row = (const shade_vec4 *)picture->color;
    for (int y = 0; y < picture->height; y++, row += picture->width)
        for (int x = 1; x < picture->width; x++)
            if (memcmp(row, row + x, sizeof *row) != 0) return 0;
    return picture->width > 1;
}

static int draw_and_save(const options *o, const model *m, progress *p)
{
    static studio light;
    canvas c;
    shade_target picture;
    shade_result result;
    int failed, blank;
    report_next(p, "finding shadows");
    result = portrait_light(&light, m, &o->picture, &o->how, report, p);
    report_next(p, "drawing");
    c = canvas_try(o->picture.width, o->picture.height, o->picture.samples);
    if (!c.target.color) result = SHADE_ERROR_CAPACITY;
    if (!result) result = portrait_draw(&c, m, &light, &o->picture, &o->how, report, p);
    report_next(p, "");
    if (result) {
        failed = complain("%s", portrait_says(result));
    } else {
        picture = canvas_finish(&c);
        blank = is_blank(&picture); /* to be saved it becomes bytes */
        failed = save_picture(&picture, o);
        if (!failed && blank && !o->how.quiet) complain("%s: nothing of it can be seen", m->path);
    }
    studio_close(&light);
    free(c.target.color);
    free(c.target.depth);
    return failed;
}

int main(int argc, char **argv)
{
    options o = { .picture = portrait_new(), .how = model_options_new() };
    progress p = { clock(), "", -1, 0, 0 };
    model m = { 0 };
    int end;
#ifdef __GLIBC__ /* keeps what was freed for the next array: 2 million triangles take 0.1 s less */
    mallopt(M_MMAP_MAX, 0);
    mallopt(M_TRIM_THRESHOLD, -1);
#endif
    path_arguments(&argc, &argv);
    end = read_options(&o, argc, argv);
    if (end) return end == OPTIONS_WRONG;
    p.silent = o.how.quiet || !guard_terminal();
    guard_program(o.max_seconds, o.how.max_memory);
    end = read_model(&o, &m, &p);
    if (!end && o.drawing.view_count)
        end = drawing_run(&o, &m, report, &p);
    else if (!end)
        end = draw_and_save(&o, &m, &p);
    model_free(&m);
    return end;
}
