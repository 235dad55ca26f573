/* native.c - the playground's picture without a browser.

       native draw STATE [MODEL] >PIXELS       the page's picture, RGBA
       native bench STATE [MODEL]              the time of 1000 pictures, the model turning

   STATE is a file with the floats of page_state. */
#include "page.c"
#include <time.h>

static double now(void)
{
    struct timespec t;
    timespec_get(&t, TIME_UTC);
    return (double)t.tv_sec + 1e-9 * (double)t.tv_nsec;
}

static int by_size(const void *a, const void *b)
{
    double x = *(const double *)a, y = *(const double *)b;
    return (x > y) - (x < y);
}

static int bench(void)
{
    enum { FRAMES = 1000 };
    static double seconds[FRAMES];
    for (int i = -10; i < FRAMES; i++) {
        double begin = now();
        page_draw();
        if (i >= 0) seconds[i] = now() - begin;
        state.yaw += 0.02f;
    }
    qsort(seconds, FRAMES, sizeof *seconds, by_size);
    printf("%d x %d, native: median %.2f ms, 99th percentile %.2f ms a frame\n", (int)state.width,
           (int)state.height, 1e3 * seconds[FRAMES / 2], 1e3 * seconds[FRAMES * 99 / 100]);
    return 0;
}

static int complain(const char *what)
{
    fprintf(stderr, "native: %s\n", what);
    return 1;
}

int main(int argc, char **argv)
{
    static char error[300];
    FILE *file = argc > 2 ? fopen(argv[2], "rb") : NULL;
    size_t most = PAGE_MOST, size;
    if (!file || fread(&state, 1, sizeof state, file) != sizeof state || fgetc(file) != EOF)
        return complain("usage: native draw|bench STATE [MODEL]");
    fclose(file);
    size = (size_t)state.width * (size_t)state.height;
    if (!(state.width >= 1 && state.width <= 16384 && state.height >= 1 && state.height <= 16384) ||
        size > most)
        return complain("the size of the picture is out of range");
    if (argc > 3 && mesh_read_file(argv[3], &meshes[PAGE_FILE].mesh, error, sizeof error))
        return complain(error);
    if (argv[1][0] == 'b') return bench();
    return fwrite(page_draw(), 4, size, stdout) != size;
}
