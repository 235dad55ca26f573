/* view.c - shows a model turning, in any terminal or in a window; the teapot where none is named.

   cc -O2 -pthread -I. examples/programs/view/view.c -lm -o view && ./view bunny.obj

   With SDL2 it also knows --window:
   cc -O2 -pthread -I. -DVIEW_SDL examples/programs/view/view.c -lm \
      $(sdl2-config --cflags --libs) -o view

   The terminal is asked what it can show: pixels, by kitty's protocol, by iTerm2's, or as sixels
   (with -DVIEW_SIXEL -lsixel); or characters of six, four or two parts, each the mean of 16
   samples, of which only those that change are sent.  Never more than two frames are ahead of the
   terminal's reports: over a slow line the model turns in larger steps, but the picture does not
   lag behind the keys. */
#define _DEFAULT_SOURCE /* NOLINT: the system's own name, for SIGWINCH with -std=c99 */
#define SHADE_IMPLEMENTATION
#include "shade.h"
#include "options.h"
#include "../../kit/scene/scene.h"
#include "display.h"
#ifdef VIEW_SDL
#include "window.h"
#else
static int show_in_window(scene *s, const view_options *o)
{
    (void)s;
    (void)o;
    return complain("--window needs a view built with SDL2 (libsdl2-dev)");
}
#endif

/* Progress: nothing in the first second of work, then a line that rewrites itself */
static void report(void *user, double part)
{
    const double *begin = (const double *)user;
    if (clock_now() - *begin < 1) return;
    fprintf(stderr, "reading %3d %%\r", (int)(100 * part));
    fflush(stderr);
}

int main(int argc, char **argv)
{
    static scene s;
    static view_options o = { .colors = VIEW_COLORS_ASKED };
    double begin = clock_now();
    scene_request request;
    const char *lack;
    int end;
    o.scene.how = model_options_new();
    end = view_read_options(&o, argc, argv);
    if (end) return end == OPTIONS_WRONG;
    if (o.window) return show_in_window(&s, &o);
    if (o.show >= SHOW_KITTY && !pixels_known(o.show))
        return complain("--show %s needs a view built with %s",
                        o.show == SHOW_SIXEL ? "sixel" : "iterm2",
                        o.show == SHOW_SIXEL ? "libsixel (libsixel-dev)" : "stb (libstb-dev)");
    lack = terminal_lacks();
    if (lack) return complain("%s", lack);
    if (o.colors == VIEW_COLORS_ASKED) {
        o.colors = terminal_colors();
        o.colors_guessed = 1;
        if (o.colors == VIEW_PLAIN) strcpy(s.said, "TERM names no colors: try --colors 256");
    }
    request = view_request(&o);
    if (scene_load(&s, &request, isatty(STDERR_FILENO) ? report : NULL, &begin)) return 1;
    end = show_in_terminal(&s, &o);
    scene_close(&s);
    return end;
}
