/* draw.h - draws the picture of a thumbnail: background, camera, bands. */
#ifndef THUMBNAIL_DRAW_H
#define THUMBNAIL_DRAW_H

#include "../shared/canvas.h"
#include "../model/look.h"
#include "camera.h"
#include "options.h"

static void draw_background(const shade_target *target, const options *o)
{
    const shade_vec3 c = o->background_color;
    if (o->background == THUMBNAIL_GRADIENT)
        canvas_gradient(target, shade_rgb(0xEEF0F3), shade_rgb(0xC3C8CF));
    else if (o->background == THUMBNAIL_PLAIN)
        shade_clear(target, shade_v4(c.x, c.y, c.z, 1), 1);
    else
        shade_clear(target, shade_v4(0, 0, 0, 0), 1);
}

/* The data that all bands share, and the result of each band */
enum { PICTURE_BANDS = 64 };
typedef struct picture_work {
    const shade_target *target;
    const exhibit *exhibit;
    camera camera;
    shade_result result[PICTURE_BANDS];
} picture_work;

static void draw_band(void *data, int band)
{
    picture_work *p = (picture_work *)data;
    const shade_target rows = bands_rows(p->target, band, PICTURE_BANDS);
    p->result[band] = exhibit_draw(p->exhibit, &rows, p->camera.view, p->camera.projection);
}

static shade_result draw_picture(const canvas *c, const model *m, const studio *light,
                                 const options *o, mesh_progress *progress, void *user)
{
    exhibit e;
    picture_work p = { .target = &c->target, .exhibit = &e };
    shade_result result = SHADE_ERROR_CAPACITY;
    p.camera = camera_frame(&m->mesh, (float)o->width / (float)o->height);
    if (!exhibit_open(&e, m, light, &o->how, p.camera.eye)) {
        draw_background(&c->target, o);
        bands_run_told(o->how.threads, PICTURE_BANDS, draw_band, &p, progress, user);
        result = SHADE_OK;
    }
    for (int i = 0; i < PICTURE_BANDS; i++)
        if (p.result[i]) result = p.result[i];
    exhibit_close(&e);
    return result;
}
#endif
