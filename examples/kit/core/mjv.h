/* mjv.h - scenes of MuJoCo, as renderer.h draws them.  A binding hands over what an mjModel and an
   mjvScene hold, as arrays of numbers: for each geom, lamp and camera a row of doubles whose parts
   are named below, in their order.

       mjv_mesh(scene, number, &part);               once for each mesh that a geom shows
       mjv_lights(&why, scene, lamps, count, shadows);
       mjv_aim(cameras, width / height, &seen);
       n = mjv_records(geoms, count, solid, records, pairs);

   Lines, arrows, skins and flexes are no surfaces here, and are left out. */
#ifndef CORE_MJV_H
#define CORE_MJV_H

#include "../scene/build.h"
#include "../scene/heights.h"
#include "../scene/renderer.h"
#include "refuse.h"

enum { /* an mjvGeom: where the parts of its row begin */
       MJV_TYPE,
       MJV_MESH,    /* the number that its mesh or ground has in the scene, in place of dataid */
       MJV_TEXTURE, /* that of its texture, in place of texid; below 0: none */
       MJV_UNIFORM, /* texuniform */
       MJV_SEGID,   /* below 0: in colour alone */
       MJV_OBJECT,  /* objid, objtype */
       MJV_SPECULAR = 7,
       MJV_SHININESS,
       MJV_EMISSION,
       MJV_SIZE,
       MJV_POS = 13,
       MJV_MAT = 16,
       MJV_RGBA = 25,
       MJV_REPEAT = 29, /* texrepeat */
       MJV_GEOM = 31
};

enum { /* an mjvLight */
       MJV_KIND,
       MJV_HEADLIGHT,
       MJV_CASTS, /* castshadow */
       MJV_CUTOFF,
       MJV_EXPONENT,
       MJV_AT,      /* pos */
       MJV_WAY = 8, /* dir */
       MJV_AMBIENT = 11,
       MJV_DIFFUSE = 14,
       MJV_GLOSS = 17, /* specular */
       MJV_FALL = 20,  /* attenuation */
       MJV_LAMP = 23
};

enum { /* an mjvGLCamera, of which there are two, for stereo */
       MJV_NEAR,
       MJV_FAR,
       MJV_TOP,
       MJV_BOTTOM,
       MJV_CENTER,
       MJV_WIDTH, /* half of it; 0: by the shape of the picture */
       MJV_ORTHO,
       MJV_EYE, /* pos */
       MJV_FORWARD = 10,
       MJV_UP = 13,
       MJV_CAMERA = 16
};

enum { MJV_LAST = 7, MJV_SPOT = 0, MJV_DIRECTIONAL = 1 }; /* of mjtGeom, of mjtLightType */

/* A texture: n bytes a texel of grey, RGB or RGBA; type is that of the model, of which 1 and 2 are
   cubes.  0: out of memory */
static inline int mjv_texture(renderer_scene *s, int number, const uint8_t *texels, int width,
                              int height, int n, int type)
{
    const size_t count = (size_t)width * (size_t)height, step = (size_t)n;
    const int faces = type == 1 || type == 2 ? 6 : 1;
    uint8_t *rgba = (uint8_t *)malloc(4 * count + 1);
    const renderer_image image = {
        .rgba = rgba, .width = width, .height = height / faces, .faces = faces
    };
    int done = rgba != NULL;
    for (size_t i = 0; done && i < count; i++)
        for (size_t k = 0; k < 4; k++)
            rgba[4 * i + k] = k < step ? texels[step * i + k] : k < 3 ? texels[step * i] : 255;
    done = done && renderer_set_texture(s, number, &image);
    free(rgba);
    return done;
}

/* A mesh of a model: rows of its own, and of each corner their numbers; uv NULL: it has none */
typedef struct mjv_part {
    const float *vertices, *normals, *uv;
    const int32_t *vertex, *normal, *texcoord;
    int32_t vertex_count, normal_count, uv_count, corners;
} mjv_part;

static inline int mjv_is_below(const int32_t *numbers, int count, int limit)
{
    for (int i = 0; i < count; i++)
        if (numbers[i] < 0 || numbers[i] >= limit) return 0;
    return 1;
}

/* Puts it in the place of mesh number.  1: done, 0: out of memory, -1: a corner has no row */
static inline int mjv_mesh(renderer_scene *s, int number, const mjv_part *part)
{
    const int n = part->corners;
    build b = { .mesh = { .positions = part->vertices, .vertex_count = part->vertex_count } };
    const float *normals, *uv = NULL;
    int done;
    if (!mjv_is_below(part->vertex, n, part->vertex_count) ||
        !mjv_is_below(part->normal, n, part->normal_count) ||
        (part->uv && !mjv_is_below(part->texcoord, n, part->uv_count)))
        return -1;
    b.mesh.indices = (const uint32_t *)part->vertex;
    b.mesh.index_count = n;
    normals = build_gathered(&b, part->normals, 3, (const uint32_t *)part->normal, n);
    if (part->uv) uv = build_gathered(&b, part->uv, 2, (const uint32_t *)part->texcoord, n);
    if (!b.no_room) build_corners(&b, normals, uv, 0, 1);
    done = !b.no_room && renderer_set_mesh(s, number, &b.mesh, 0, NULL);
    build_free(&b);
    return done;
}

static inline void mjv_floats(float *to, const double *from, int count)
{
    for (int k = 0; k < count; k++) to[k] = (float)from[k];
}

/* Makes records of count geoms, rows of MJV_GEOM, but of those that are no surfaces, and returns
   how many there are.  pairs, two for each and two before them, are object and type, of nothing
   first: those of id i follow at 2 (i + 1).  solid: for depth and segmentation */
static inline int mjv_records(const double *geoms, int count, int solid, renderer_object *out,
                              int32_t *pairs)
{
    static const int kind[] = { RENDERER_PLANE,   RENDERER_MESH,      RENDERER_SPHERE,
                                RENDERER_CAPSULE, RENDERER_ELLIPSOID, RENDERER_CYLINDER,
                                RENDERER_BOX,     RENDERER_MESH };
    static const renderer_object none;
    int n = 0;
    pairs[0] = pairs[1] = -1;
    for (const double *g = geoms; g < geoms + (ptrdiff_t)MJV_GEOM * count; g += MJV_GEOM) {
        renderer_object *o = &out[n];
        if (!(g[MJV_TYPE] >= 0 && g[MJV_TYPE] <= MJV_LAST)) continue;
        *o = none;
        o->kind = kind[(int)g[MJV_TYPE]];
        o->id = n++;
        pairs[2 * n] = (int32_t)g[MJV_OBJECT];
        pairs[2 * n + 1] = (int32_t)g[MJV_OBJECT + 1];
        if (o->kind == RENDERER_MESH) o->mesh = (int32_t)g[MJV_MESH];
        if (g[MJV_TEXTURE] >= 0) o->texture = 1 + (int32_t)g[MJV_TEXTURE];
        if (solid && g[MJV_SEGID] < 0) o->flags = RENDERER_HIDDEN;
        memcpy(o->place, g + MJV_POS, sizeof o->place);
        memcpy(o->turn, g + MJV_MAT, sizeof o->turn);
        mjv_floats(o->rgba, g + MJV_RGBA, 4);
        for (int k = 0; k < 3; k++) {
            o->specular[k] = (float)g[MJV_SPECULAR];
            o->size[k] = o->kind == RENDERER_MESH ? 1 : (float)g[MJV_SIZE + k];
        }
        if (o->kind == RENDERER_PLANE) o->size[2] = 0;
        o->shininess = (float)(128 * g[MJV_SHININESS]);
        o->emission = (float)g[MJV_EMISSION];
        for (int k = 0; k < 2; k++) { /* texels a unit, of a surface that has a size */
            const double size = g[MJV_SIZE + k];
            const int once = g[MJV_UNIFORM] != 0 || o->kind == RENDERER_MESH || !(size > 0);
            o->repeat[k] = (float)(g[MJV_REPEAT + k] / (once ? 1 : 2 * size));
        }
    }
    return n;
}

/* The lamps of a scene, rows of MJV_LAMP, of which the first 8 count.  shadows 0: none casts any.
   One that has no place or direction is refused. */
static inline int mjv_lights(core_refusal *r, renderer_scene *s, const double *lamps, int count,
                             int shadows)
{
    shade_light light[RENDERER_LAMPS];
    double places[RENDERER_LAMPS][4];
    const int n = count < RENDERER_LAMPS ? count : RENDERER_LAMPS;
    int casts = 0;
    memset(light, 0, sizeof light);
    for (int i = 0; i < n; i++) {
        const double *from = lamps + (ptrdiff_t)MJV_LAMP * i, *way = from + MJV_WAY;
        const int distant = from[MJV_KIND] == MJV_DIRECTIONAL;
        const int cone = from[MJV_KIND] == MJV_SPOT && from[MJV_CUTOFF] < 90;
        char name[32];
        snprintf(name, sizeof name, "lights[%d]", i);
        if (core_numbers(r, name, from, MJV_LAMP)) return r->code;
        if (distant && !(core_dot(way, way) > 1e-36))
            return core_refuse(r, CORE_RANGE, name, "must have a direction");
        for (int k = 0; k < 3; k++) places[i][k] = distant ? -way[k] : from[MJV_AT + k];
        places[i][3] = !distant;
        mjv_floats(&light[i].position.x, places[i], 4);
        mjv_floats(&light[i].ambient.x, from + MJV_AMBIENT, 3);
        mjv_floats(&light[i].diffuse.x, from + MJV_DIFFUSE, 3);
        mjv_floats(&light[i].specular.x, from + MJV_GLOSS, 3);
        light[i].constant = (float)from[MJV_FALL];
        light[i].linear = (float)from[MJV_FALL + 1];
        light[i].quadratic = (float)from[MJV_FALL + 2];
        if (shadows && from[MJV_CASTS] != 0 && from[MJV_HEADLIGHT] == 0 && (distant || cone))
            casts |= 1 << i;
        if (!cone) continue;
        mjv_floats(&light[i].spot_direction.x, way, 3);
        light[i].spot_exponent = (float)from[MJV_EXPONENT];
        light[i].spot_cos_cutoff = (float)cos(from[MJV_CUTOFF] * 3.14159265358979323846 / 180);
    }
    renderer_set_lights(s, light, places[0], n, shade_v3(0, 0, 0), casts);
    return 0;
}

/* What a picture is seen by: matrices by columns */
typedef struct mjv_seen {
    double view[16], projection[16], near_z, far_z, parallel;
} mjv_seen;

/* The mean of the two cameras of stereo, for a picture of that aspect, width by height */
static inline void mjv_aim(const double *cameras, double aspect, mjv_seen *out)
{
    const double *c = cameras, *d = cameras + MJV_CAMERA;
    const double top = c[MJV_TOP], bottom = c[MJV_BOTTOM], tall = top - bottom;
    const double half = c[MJV_WIDTH] != 0 ? c[MJV_WIDTH] : tall / 2 * aspect;
    const double center = (c[MJV_CENTER] + d[MJV_CENTER]) / 2;
    const int ortho = c[MJV_ORTHO] != 0;
    const double scale = ortho ? 1 : c[MJV_NEAR];
    double at[3], row[3][3], *p = out->projection; /* rows: right, up, forward */
    memset(out, 0, sizeof *out);
    for (int k = 0; k < 3; k++) {
        at[k] = (c[MJV_EYE + k] + d[MJV_EYE + k]) / 2;
        row[1][k] = (c[MJV_UP + k] + d[MJV_UP + k]) / 2;
        row[2][k] = (c[MJV_FORWARD + k] + d[MJV_FORWARD + k]) / 2;
    }
    core_unit(row[2]);
    core_cross(row[2], row[1], row[0]);
    core_unit(row[0]);
    core_cross(row[0], row[2], row[1]);
    for (int i = 0; i < 3; i++) {
        const double dot = core_dot(row[i], at);
        for (int k = 0; k < 3; k++) out->view[4 * k + i] = i < 2 ? row[i][k] : -row[i][k];
        out->view[12 + i] = i < 2 ? -dot : dot;
    }
    out->view[15] = 1;
    p[0] = scale / half;
    p[5] = 2 * scale / tall;
    p[ortho ? 12 : 8] = (ortho ? -center : center) / half;
    p[ortho ? 13 : 9] = (ortho ? -(top + bottom) : top + bottom) / tall;
    p[ortho ? 15 : 11] = ortho ? 1 : -1;
    out->near_z = c[MJV_NEAR];
    out->far_z = c[MJV_FAR];
    out->parallel = ortho;
}
#endif
