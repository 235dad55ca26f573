/* sheet.h - draws any rows of a picture of a scene, however large the picture is.

       sheet p;
       if (sheet_open(&p, &scene, 49152, 65536, 2)) ...                        (out of memory)
       sheet_write(&p, 1024, 1024, file);                   (1024 rows from row 1024 on, as RGB)
       sheet_close(&p);

   shade.h draws pictures of up to 16384 x 16384 samples.  A larger picture is laid out in cells of
   that size, each of which is drawn through its part of the lens, in strips that have the bits of
   the whole cell.  The cells depend on the size of the picture alone, so rows have the same bits
   whatever program or machine draws them. */
#ifndef BATCH_SHEET_H
#define BATCH_SHEET_H

#include "../../kit/scene/scene.h"

#ifndef SHEET_CELL
#define SHEET_CELL 16384 /* samples along the edge of a cell */
#endif
#ifndef SHEET_BAND
#define SHEET_BAND (4 << 20) /* samples drawn at a time, 20 bytes each */
#endif

typedef struct sheet {
    const scene *scene;
    int width, height, samples; /* samples: along each edge of a pixel */
    int rows;                   /* of a band, at most */
    shade_target large, band;   /* samples of a cell's part of a band; pixels of a band */
} sheet;

static inline void sheet_close(sheet *p)
{
    static const sheet none;
    free(p->large.color);
    free(p->large.depth);
    free(p->band.color);
    *p = none;
}

static inline int sheet_smaller(int a, int b) { return a < b ? a : b; }
/* Pixels along the edge of a cell */
static inline int sheet_cell(const sheet *p) { return SHEET_CELL / p->samples; }

/* Returns 1 where memory is out. */
static inline int sheet_open(sheet *p, const scene *s, int width, int height, int samples)
{
    static const sheet none;
    size_t most, wide;
    *p = none;
    p->scene = s;
    p->width = width;
    p->height = height;
    p->samples = samples;
    wide = (size_t)(sheet_smaller(width, sheet_cell(p)) * samples * samples);
    p->rows = sheet_smaller(height, SHEET_BAND / (int)wide);
    if (p->rows < 1) p->rows = 1;
    most = wide * (size_t)p->rows;
    p->large.color = malloc(16 * most);
    p->large.depth = (float *)malloc(4 * most);
    p->large.format = SHADE_FORMAT_RGBA32F;
    p->band.color = malloc(4 * (size_t)width * (size_t)p->rows);
    p->band.stride = width;
    p->band.srgb = 1;
    if (p->large.color && p->large.depth && p->band.color) return 0;
    sheet_close(p);
    return 1;
}

/* Draws some rows of the cell that begins at column x into the band. */
static inline shade_result sheet_draw(const sheet *p, scene_camera camera, int x, int first,
                                      int rows)
{
    int top = first - first % sheet_cell(p);
    int width = sheet_smaller(sheet_cell(p), p->width - x);
    int height = sheet_smaller(sheet_cell(p), p->height - top);
    shade_target in = p->large, out = p->band;
    shade_result result;
    camera = scene_crop(camera, shade_v2((float)p->width, (float)p->height), (float)x, (float)top,
                        (float)width, (float)height);
    out.color = (uint32_t *)out.color + x;
    out.width = width;
    out.height = height;
    out.row_offset = first - top;
    out.row_count = rows;
    in.width = width * p->samples;
    in.height = height * p->samples;
    in.row_offset = out.row_offset * p->samples;
    in.row_count = rows * p->samples;
    result = scene_draw(p->scene, &in, &camera, p->samples);
    return result ? result : scene_resolve(p->scene, &out, &in, p->samples);
}

/* Removes alpha from the band's pixels, in place: 3 bytes remain of each. */
static inline size_t sheet_pack(const sheet *p, int rows)
{
    uint8_t *bytes = (uint8_t *)p->band.color;
    size_t pixels = (size_t)p->width * (size_t)rows;
    for (size_t i = 0; i < pixels; i++) memmove(bytes + 3 * i, bytes + 4 * i, 3);
    return 3 * pixels;
}

/* Chooses the wires and lights the studio for the picture, as the scene stands now. */
static inline void sheet_light(const sheet *p, scene *s)
{
    const scene_camera camera = scene_place_camera(s, (float)p->width / (float)p->height);
    scene_trace(s, &camera, p->height);
    scene_light(s, &camera, p->width > p->height ? p->width : p->height);
}

/* Writes count rows from first on.  Returns 1 where the file accepts no more. */
static inline int sheet_write(const sheet *p, int first, int count, FILE *file)
{
    scene_camera camera = scene_place_camera(p->scene, (float)p->width / (float)p->height);
    for (int y = first, rows; y < first + count; y += rows) {
        size_t size;
        rows = sheet_smaller(p->rows, first + count - y);
        rows = sheet_smaller(rows, sheet_cell(p) - y % sheet_cell(p));
        for (int x = 0; x < p->width; x += sheet_cell(p)) sheet_draw(p, camera, x, y, rows);
        size = sheet_pack(p, rows);
        if (fwrite(p->band.color, 1, size, file) != size) return 1;
    }
    return 0;
}
#endif
