/* view.c - a model, or the teapot, turning in any terminal or in a window.

   cc -O2 -pthread -I. examples/view.c -lm -o view && ./view bunny.obj

   with --window as well where SDL2 is:
   cc -O2 -pthread -I. -DVIEW_SDL examples/view.c -lm $(sdl2-config --cflags --libs) -o view

   A character of the terminal shows two pixels, each the mean of 16 samples.  Only what changed is
   sent, and never more than two frames ahead of what the terminal has shown: over a slow line the
   picture turns in larger steps, but does not lag behind the keys. */
#define _DEFAULT_SOURCE /* NOLINT: the system's own name, for SIGWINCH with -std=c99 */
#define SHADE_IMPLEMENTATION
#include "shade.h"
#include "view_options.h"
#include "view_scene.h"
#include "view_display.h"
#ifdef VIEW_SDL
#include "view_window.h"
#else
static int show_in_window(scene *s, const view_options *o)
{
    (void)s, (void)o;
    return view_complain("%s", "built without SDL2 (libsdl2-dev), so without --window");
}
#endif

/* Silent for the first second of work; then a line that rewrites itself */
static void report(void *user, double part)
{
    const double *begin = (const double *)user;
    if (terminal_now() - *begin < 1) return;
    fprintf(stderr, "reading %3d %%\r", (int)(100 * part));
    fflush(stderr);
}

int main(int argc, char **argv)
{
    static scene s;
    static view_options o = { .colors = VIEW_COLORS_ASKED, .z_up = -1 };
    double begin = terminal_now();
    const char *lack;
    int said = view_read_options(&o, argc, argv);
    if (said) return said > 0;
    if (o.window) return show_in_window(&s, &o);
    lack = terminal_lacks();
    if (lack) return view_complain("%s", lack);
    if (o.colors == VIEW_COLORS_ASKED) {
        o.colors = terminal_colors();
        if (o.colors == VIEW_PLAIN) strcpy(s.said, "TERM tells of no colors: try --colors 256");
    }
    if (scene_load(&s, &o, isatty(STDERR_FILENO) ? report : NULL, &begin)) return 1;
    said = show_in_terminal(&s, &o);
    scene_close(&s);
    return said;
}
