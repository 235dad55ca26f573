/* keep.h - the key p: the picture as a file, and the command that shows it again. */
#ifndef VIEW_KEEP_H
#define VIEW_KEEP_H

#include "../../kit/scene/scene.h"
#include "pixels.h"

enum { KEEP_HEIGHT = 720, KEEP_SAMPLES = 7000000 };

typedef struct keep {
    char **words;     /* of the command line, up to a NULL */
    pixel_bytes told; /* commands of pictures that have been saved, and are to be printed */
} keep;

/* Adds a word as a shell reads it: between quotes, where it has more than letters and signs that
   mean nothing to a shell. */
static inline void keep_word(keep *k, const char *word, char end)
{
    static const char plain[] =
        "abcdefghijklmnopqrstuvwxyzABCDEFGHIJKLMNOPQRSTUVWXYZ0123456789"
        "_-./,=+:%@";
    const int quoted = !*word || word[strspn(word, plain)];
    if (quoted) pixels_put(&k->told, "'", 1);
    for (; *word; word++) {
        const char *as = *word == '\'' ? "'\\''" : word; /* one quote: end, quote, begin */
        pixels_put(&k->told, as, as == word ? 1 : 4);
    }
    if (quoted) pixels_put(&k->told, "'", 1);
    pixels_put(&k->told, &end, 1);
}

/* Adds the command: that of this program with the state before its own words. */
static inline void keep_command(keep *k, const scene *s)
{
    char **word = k->words;
    keep_word(k, *word++, ' ');
    keep_word(k, "--still", ' ');
    keep_word(k, "--again", ' ');
    keep_word(k, scene_again(s).text, ' ');
    for (; *word; word++) {
        if (!strcmp(*word, "--again") && word[1])
            word++;
        else if (strcmp(*word, "--still") != 0 && strncmp(*word, "--again=", 8) != 0)
            keep_word(k, *word, ' ');
    }
    k->told.bytes[k->told.size - 1] = '\n';
}

/* A name that no file in this folder has: that of the model with a number */
static inline void keep_name(const scene *s, char *name, size_t room)
{
    const char *title = *s->title == '-' ? "picture" : s->title, *dot = strrchr(title, '.');
    const int length = dot && dot > title ? (int)(dot - title) : (int)strlen(title);
    FILE *there = NULL;
    for (int n = 1; n == 1 || there; n++) {
        if (there) fclose(there);
        snprintf(name, room, "%.*s-%d.%s", length < 200 ? length : 200, title, n,
                 PIXELS_PNG ? "png" : "ppm");
        there = path_open(name, "rb");
    }
}

/* Draws the scene as it is at rest.  NULL color: out of memory */
static inline shade_target keep_draw(scene *s, int width, int height)
{
    const scene_camera camera = scene_place_camera(s, (float)width / (float)height);
    const size_t pixels = (size_t)width * (size_t)height;
    shade_target large = { 0 }, small = { 0 };
    int n = 3;
    while (n > 1 && pixels * (size_t)(n * n) > KEEP_SAMPLES) n--;
    large.width = n * width;
    large.height = n * height;
    large.format = SHADE_FORMAT_RGBA32F;
    large.color = malloc(16 * pixels * (size_t)(n * n));
    large.depth = (float *)malloc(4 * pixels * (size_t)(n * n));
    small.width = width;
    small.height = height;
    small.srgb = 1;
    small.color = large.color && large.depth ? malloc(4 * pixels) : NULL;
    if (small.color) {
        scene_dim(s);
        scene_trace(s, &camera, height);
        scene_light(s, &camera, width > height ? width : height);
        scene_draw(s, &large, &camera, n);
        scene_resolve(s, &small, &large, n);
    }
    free(large.color);
    free(large.depth);
    return small;
}

/* Saves the picture without its words.  What became of it stands in the scene's line. */
static inline void keep_picture(keep *k, scene *s, int width, int height)
{
    char name[240];
    const shade_target picture = keep_draw(s, width, height);
    const picture_file file = { &picture, PIXELS_PNG, 3 };
    FILE *out;
    errno = 0;
    keep_name(s, name, sizeof name);
    out = picture.color ? path_open(name, "wbx") : NULL;
    if (!out || picture_write(out, &file) | fclose(out)) {
        snprintf(s->said, sizeof s->said, "not saved: %.40s",
                 errno ? strerror(errno) : "out of memory");
        if (out) path_remove(name);
    } else {
        snprintf(s->said, sizeof s->said, "saved %.50s", name);
        keep_command(k, s);
    }
    free(picture.color);
}

/* Prints the commands, once the terminal takes lines. */
static inline void keep_tell(keep *k)
{
    if (k->told.size) fwrite(k->told.bytes, 1, k->told.size, stdout);
    fflush(stdout);
    k->told.size = 0;
}
#endif
