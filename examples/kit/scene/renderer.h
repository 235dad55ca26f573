/* renderer.h - cameras for simulators, learners and graders: a scene of objects that share
   meshes, and pictures of it that hold colour, depth in the scene's unit, numbers of objects and
   triangles, and normals, all from one draw.

       renderer_scene *scene = renderer_scene_open();
       renderer *r = renderer_open();
       renderer_object ball = { RENDERER_SPHERE, .size = { 1, 1, 1 }, ... };
       renderer_add(scene, &ball, 1);
       renderer_draw(&r, 1, scene, &picture, 1, NULL);

   The scene holds meshes, textures, objects, lamps and the sky.  Any number of threads may draw
   it and change it: each draws with a renderer of its own, which holds scratch memory and nothing
   that a picture depends on, and a picture shows the scene as it was when renderer_draw
   began.  After the first picture of a size nothing is allocated. All arithmetic is that of
   shade.h or single operations of IEEE floats, so that the bits are equal on every machine;
   compile with -ffp-contract=off. */
#ifndef SHARED_RENDERER_H
#define SHARED_RENDERER_H

#include <math.h>
#include <stdlib.h>
#include <string.h>
#include "shade.h"
#include "../../shared/bands.h"
#include "../core/refuse.h"
#include "relief.h"

typedef enum renderer_kind {
    RENDERER_MESH = 0,  /* size multiplies its coordinates */
    RENDERER_PLANE,     /* size: half the sides in x and y, faces +z; 0: endless */
    RENDERER_SPHERE,    /* size: its radius three times */
    RENDERER_ELLIPSOID, /* size: its radii */
    RENDERER_CAPSULE,   /* size: radius, radius, half the length of its cylinder along z */
    RENDERER_CYLINDER,  /* size: radius, radius, half its length along z */
    RENDERER_BOX,       /* size: half its sides */
    RENDERER_KINDS
} renderer_kind;

enum { /* renderer_object.flags */
       RENDERER_HIDDEN = 1,
       RENDERER_TWO_SIDED = 2,
       RENDERER_CASTS_NO_SHADOW = 4,
       RENDERER_BLENDED = 8,  /* by the alpha of its texture too */
       RENDERER_HEIGHTS = 16, /* its relief holds heights, and no normals */
       RENDERER_UNLIT = 32    /* no lamp changes its colour */
};

/* An object in its place.  The bindings for Python and JavaScript fill it in word by word. */
typedef struct renderer_object {
    double place[3], turn[9];           /* turn: a rotation, row by row */
    int32_t kind, mesh, texture, flags; /* of textures 1 + numbers; 0: none */
    int32_t id;                         /* what ids hold: surfaces of one object share it */
    int32_t first, count;               /* the triangles of its mesh that it shows; count 0: all */
    float size[3];
    float rgba[4]; /* linear where the picture is sRGB; alpha below 1: blended */
    float specular[3], shininess;
    float emission;    /* multiplies the colour */
    float glow[3];     /* light that it sends beside that, whatever its colour */
    float repeat[2];   /* u, v of a mesh are multiplied by it; else u, v a unit of x, y */
    float metal, tint; /* k_d is 1 - metal times the colour, k_s specular + tint times the colour */
    float cutoff;      /* where texture and colour have less alpha are holes; 0: nowhere */
    int32_t relief, glow_map; /* of a mesh with texcoords */
    float strength;           /* of the relief, as in a model_relief */
    float glow_factor[3];     /* of the light that glow_map has */
    int32_t unused;           /* 0: records are compared byte by byte */
} renderer_object;

enum { RENDERER_LAMPS = 8, RENDERER_LEVELS = 11 };
enum { RENDERER_SKY_PLAIN, RENDERER_SKY_GRADIENT, RENDERER_SKY_CUBE };

/* What objects are lit by, and what is behind them */
typedef struct renderer_around {
    shade_light lights[RENDERER_LAMPS];
    double places[RENDERER_LAMPS][4]; /* positions of the lights again, which may be far away */
    int32_t light_count;
    int32_t shadows;          /* bit k: lamp k, directional or a spot, casts shadows */
    int32_t sky, sky_texture; /* RENDERER_SKY_...; the number of a cube */
    shade_vec4 background;
    shade_vec3 sky_low, sky_high; /* of a gradient, by the sine of the angle over the horizon */
    shade_vec3 ambient;
} renderer_around;

/* What is drawn and where to.  Rows of the arrays follow each other without gaps. */
typedef struct renderer_picture {
    int32_t width, height;
    int32_t samples;  /* of colour along the edge of a pixel, 1 .. 8 */
    int32_t channels; /* of color: 3 or 4 */
    int32_t srgb;     /* non-zero: light is linear, color is stored as sRGB */
    int32_t solid;    /* non-zero: alpha is ignored; depth and ids have all objects */
    int32_t parallel; /* non-zero: the projection is orthographic */
    int32_t object_count, pose_count;
    float near_z, far_z; /* far_z from 1e30 on: there is none */
    float empty_depth;   /* the depth of pixels that show nothing */
    float tolerance;     /* pixels that round shapes may lie inside of the true ones */
    int32_t unused;
    double view[16];                /* by columns */
    shade_mat4 projection;          /* row 2 of the projection is not read */
    const renderer_object *objects; /* NULL: those of the scene */
    const double *poses; /* NULL, or for each object of the scene, by number, 16 row by row */
    uint8_t *color;      /* any of these may be NULL */
    float *depth;        /* along the axis of view */
    int32_t *ids;        /* object and triangle, (-1, -1) where there is nothing */
    float *normals;      /* unit vectors in the world, zero where there is nothing */
} renderer_picture;

/* A mesh as it is drawn; of round shapes there is one for each level of detail. */
typedef struct renderer_shape {
    float *positions, *normals, *texcoords, *colors;
    uint32_t *indices;
    float *planes; /* of faces: rows of a unit normal's x, y, z, and distances from 0 */
    int vertex_count, index_count;
    int upper;         /* of a capsule: vertices before this one are its upper end */
    float sag;         /* how far chords lie inside of the true surface of radius 1 */
    shade_vec3 centre; /* of a sphere around it */
    float radius;
    double origin[3]; /* from where its coordinates count */
    int *users;       /* the states of scenes that have it; NULL: it is not counted */
} renderer_shape;

typedef struct renderer_texture {
    shade_texture face[6]; /* a cube has six, x -x y -y z -z, else the first counts */
    shade_texture *levels;
    uint8_t *memory;
    int cube;
    int *users;
} renderer_texture;

typedef struct renderer_scene {
    renderer_shape round[3][RENDERER_LEVELS]; /* spheres, capsules, cylinders */
    renderer_shape box, plane;
    int borrowed; /* round, box and plane are those of another scene, which outlives it */
    int serial;   /* of scenes that share a renderer's scratch memory: tells them apart */
    /* its state, which a picture has a part in while it is drawn */
    renderer_shape *meshes;
    renderer_texture *textures;
    int mesh_count, texture_count;
    renderer_object *objects; /* by their numbers, which are given once */
    int object_count, object_room, next_number;
    renderer_around around;
    int *users;  /* of meshes, textures and objects: the scene, and pictures being drawn */
    int version; /* counts changes of meshes and textures */
    renderer_shape *spares; /* of meshes that move: see deform.h */
    int spare_count;
    struct renderer_scene *held; /* what pictures show until a change of several steps is done */
} renderer_scene;

/* An object that can be seen */
typedef struct renderer_entry {
    const renderer_shape *shape;
    shade_vec3 place; /* of the object, from the origin of the view */
    float turn[9];
    shade_mat4 world;  /* from the shape's space */
    shade_mat3 normal; /* world, for normals */
    float lift;        /* of a capsule: half the length of its cylinder */
    float distance;    /* of its nearest point from the eye, at least */
    float order;       /* opaque objects are drawn by it */
    float sag;         /* in the unit of the scene */
    int object, key;
    int first;  /* vertex of the draw that it has a part in */
    int uneven; /* normals must be made unit, because it is scaled unevenly */
} renderer_entry;

/* What ids hold for a triangle */
typedef struct renderer_mark {
    int32_t object, triangle;
} renderer_mark;

/* The shadow map of a lamp */
typedef struct renderer_map {
    float *depth;
    size_t room;
    int size, valid;
    shade_light lamp;         /* as it was when the map was drawn */
    shade_mat4 from_world;    /* to the map's clip space */
    float texel, texel_slope; /* size of its texels: texel + texel_slope times the distance */
    shade_vec4 axis;          /* distance from the lamp along its axis */
} renderer_map;

typedef struct renderer {
    renderer_entry *entries;
    uint32_t *indices;
    uint32_t *whose, *owners; /* the entries of vertices and of triangles */
    renderer_mark *marks;     /* of triangles */
    float *depth, *large_depth;
    uint32_t *color, *large_color;
    renderer_map map[RENDERER_LAMPS];
    renderer_object *moved; /* a copy of the scene's objects, where a picture has poses for them */
    renderer_object *known; /* what the shadow maps hold */
    int known_count, known_serial, known_version;
    double known_origin[3];
    float known_tolerance;
    size_t room[11];
} renderer;

/* ---- shapes ---------------------------------------------------------------------------------- */

/* Slices of round shapes by level */
static inline int renderer_slices(int level)
{
    static const int slices[RENDERER_LEVELS] = { 8, 12, 16, 20, 24, 28, 32, 40, 48, 64, 96 };
    return slices[level];
}

/* ---- one scene and several threads ----------------------------------------------------------- */

/* A state is copied on write: a change while pictures are drawn makes a copy of the records,
   which costs some microseconds, and draws nothing twice.  Nobody waits for a picture.  One lock
   for all scenes guards the counts and the change itself, some hundred nanoseconds each. */
#if defined(THREAD_NONE)
static inline void renderer_lock(void) {}
static inline void renderer_unlock(void) {}
static inline void renderer_survive_fork(void) {}
#elif defined(_WIN32)
static SRWLOCK renderer_gate = SRWLOCK_INIT;
static inline void renderer_lock(void) { AcquireSRWLockExclusive(&renderer_gate); }
static inline void renderer_unlock(void) { ReleaseSRWLockExclusive(&renderer_gate); }
static inline void renderer_survive_fork(void) {}
#else
static pthread_mutex_t renderer_gate = PTHREAD_MUTEX_INITIALIZER;
static void renderer_lock(void) { pthread_mutex_lock(&renderer_gate); }
static void renderer_unlock(void) { pthread_mutex_unlock(&renderer_gate); }
static void renderer_at_fork(void)
{
    pthread_atfork(renderer_lock, renderer_unlock, renderer_unlock);
}
/* A child would wait for ever for a lock that a thread of its parent held. */
static inline void renderer_survive_fork(void)
{
    static pthread_once_t once = PTHREAD_ONCE_INIT;
    pthread_once(&once, renderer_at_fork);
}
#endif

/* A count of one user.  NULL: out of memory */
static inline int *renderer_count_new(void)
{
    int *n = (int *)malloc(sizeof *n);
    if (n) *n = 1;
    return n;
}

static inline void renderer_shape_free(renderer_shape *s)
{
    if (s->users && --*s->users) return;
    free(s->users);
    free(s->positions);
    free(s->normals);
    free(s->texcoords);
    free(s->colors);
    free(s->indices);
    free(s->planes);
    memset(s, 0, sizeof *s);
}

/* Memory for a shape.  0: there is not enough, and nothing is kept. */
static inline int renderer_shape_open(renderer_shape *s, int vertices, int indices)
{
    memset(s, 0, sizeof *s);
    s->positions = (float *)calloc((size_t)vertices + 1, 3 * sizeof(float));
    s->normals = (float *)calloc((size_t)vertices + 1, 3 * sizeof(float));
    s->indices = (uint32_t *)calloc((size_t)indices + 1, sizeof(uint32_t));
    s->radius = 1;
    if (s->positions && s->normals && s->indices) return 1;
    renderer_shape_free(s);
    return 0;
}

static inline void renderer_put(renderer_shape *s, shade_vec3 p, shade_vec3 n)
{
    memcpy(s->positions + 3 * (size_t)s->vertex_count, &p, sizeof p);
    memcpy(s->normals + 3 * (size_t)s->vertex_count++, &n, sizeof n);
}

static inline void renderer_face(renderer_shape *s, int a, int b, int c)
{
    s->indices[s->index_count++] = (uint32_t)a;
    s->indices[s->index_count++] = (uint32_t)b;
    s->indices[s->index_count++] = (uint32_t)c;
}

static inline shade_vec3 renderer_get(const float *p) { return shade_v3(p[0], p[1], p[2]); }

/* Triangles in packets of SHADE_LANES, the last one filled up with planes that face nobody */
static inline size_t renderer_plane_row(const renderer_shape *s)
{
    return ((size_t)s->index_count / 3 + SHADE_LANES - 1) / SHADE_LANES * SHADE_LANES;
}

/* Planes of the faces.  The halves of a capsule are lifted apart first, so that its cylinder,
   which is flat until then, has some.  0: out of memory */
static inline int renderer_make_planes(renderer_shape *s)
{
    const size_t row = renderer_plane_row(s);
    s->planes = (float *)calloc(4 * row + 1, sizeof(float));
    if (!s->planes) return 0;
    for (int i = 0; i < s->index_count; i += 3) {
        float *to = s->planes + i / 3;
        shade_vec3 p[3], n;
        for (int k = 0; k < 3; k++) {
            const int at = (int)s->indices[i + k];
            p[k] = renderer_get(s->positions + 3 * (size_t)at);
            if (s->upper) p[k].z += at < s->upper ? 1.0f : -1.0f;
        }
        n = shade_face_normal(p[0], p[1], p[2]);
        to[0] = n.x;
        to[row] = n.y;
        to[2 * row] = n.z;
        to[3 * row] = shade_dot(n, p[0]) - (s->upper ? (n.z < 0 ? -n.z : n.z) : 0);
    }
    return 1;
}

/* Cosine and sine of a part of a full turn, by shade.h: no C library decides their bits. */
static inline shade_vec2 renderer_turn(float part)
{
    const shade_mat4 m = shade_mat4_rotation(6.2831853f * part, shade_v3(0, 0, 1));
    return shade_v2(m.col[0].x, m.col[0].y);
}

/* Rings of n + 1 vertices from the top to the bottom, joined; seam and poles have no flat
   triangles. */
static inline void renderer_join_rings(renderer_shape *s, int first, int rings, int n, int poles)
{
    for (int i = 0; i + 1 < rings; i++)
        for (int j = 0; j < n; j++) {
            const int a = first + i * (n + 1) + j, b = a + n + 1;
            if (!poles || i + 2 < rings) renderer_face(s, a, b, b + 1);
            if (!poles || i > 0) renderer_face(s, a, b + 1, a + 1);
        }
}

/* A unit sphere with poles on z.  A capsule has its equator twice, and draws the upper half apart
   from the lower one. */
static inline int renderer_make_sphere(renderer_shape *s, int n, int capsule)
{
    const int rings = n / 2 + 1 + capsule;
    if (!renderer_shape_open(s, rings * (n + 1), 6 * n * (rings - 1))) return 0;
    for (int i = 0; i < rings; i++) {
        const int ring = capsule && i > n / 4 ? i - 1 : i;
        shade_vec2 polar = renderer_turn((float)ring / (float)n);
        if (4 * ring == n) polar = shade_v2(0, 1);
        for (int j = 0; j <= n; j++) {
            const shade_vec2 around = renderer_turn((float)(j % n) / (float)n);
            const shade_vec3 p = shade_v3(polar.y * around.x, polar.y * around.y, polar.x);
            renderer_put(s, p, p);
        }
    }
    renderer_join_rings(s, 0, rings, n, 1);
    s->upper = capsule ? (n / 4 + 1) * (n + 1) : 0;
    s->sag = 1 - renderer_turn(0.5f / (float)n).x;
    return renderer_make_planes(s);
}

static inline int renderer_make_cylinder(renderer_shape *s, int n)
{
    if (!renderer_shape_open(s, 4 * (n + 1), 12 * n)) return 0;
    for (int i = 0; i < 4; i++)
        for (int j = 0; j <= n; j++) {
            const shade_vec2 a = renderer_turn((float)(j % n) / (float)n);
            const float z = i < 2 ? 1.0f : -1.0f;
            const int side = i == 1 || i == 2;
            renderer_put(s, shade_v3(a.x, a.y, z),
                         side ? shade_v3(a.x, a.y, 0) : shade_v3(0, 0, z));
        }
    for (int j = 1; j + 1 < n; j++) {
        renderer_face(s, 0, j, j + 1);
        renderer_face(s, 3 * (n + 1), 3 * (n + 1) + j + 1, 3 * (n + 1) + j);
    }
    renderer_join_rings(s, n + 1, 2, n, 0);
    s->sag = 1 - renderer_turn(0.5f / (float)n).x;
    return renderer_make_planes(s);
}

static inline int renderer_make_box(renderer_shape *s)
{
    if (!renderer_shape_open(s, 24, 36)) return 0;
    for (int face = 0; face < 6; face++) {
        const int axis = face / 2, first = 4 * face;
        const float side = face % 2 ? -1.0f : 1.0f;
        for (int k = 0; k < 4; k++) {
            const float u = k == 1 || k == 2 ? 1.0f : -1.0f, v = k >= 2 ? 1.0f : -1.0f;
            float p[3], n[3] = { 0, 0, 0 };
            p[axis] = n[axis] = side;
            p[(axis + 1) % 3] = side * u;
            p[(axis + 2) % 3] = v;
            renderer_put(s, shade_v3(p[0], p[1], p[2]), shade_v3(n[0], n[1], n[2]));
        }
        renderer_face(s, first, first + 1, first + 2);
        renderer_face(s, first, first + 2, first + 3);
    }
    return renderer_make_planes(s);
}

/* A square of 8 x 8 cells that grow from the middle: there the eye is, where it is endless. */
static inline int renderer_make_plane(renderer_shape *s)
{
    enum { N = 8 };
    if (!renderer_shape_open(s, (N + 1) * (N + 1), 6 * N * N)) return 0;
    for (int i = 0; i <= N; i++)
        for (int j = 0; j <= N; j++) {
            const float x = (float)(2 * j - N) / N, y = (float)(2 * i - N) / N;
            const float ax = x < 0 ? -x : x, ay = y < 0 ? -y : y;
            renderer_put(s, shade_v3(x * ax * ax, y * ay * ay, 0), shade_v3(0, 0, 1));
        }
    for (int i = 0; i < N; i++)
        for (int j = 0; j < N; j++) {
            const int a = i * (N + 1) + j, b = a + N + 1;
            renderer_face(s, a, a + 1, b + 1);
            renderer_face(s, a, b + 1, b);
        }
    return renderer_make_planes(s);
}

/* ---- scenes ---------------------------------------------------------------------------------- */

static inline void renderer_texture_free(renderer_texture *t)
{
    if (t->users && --*t->users) return;
    free(t->users);
    free(t->levels);
    free(t->memory);
}

/* Gives back a state, with the lock.  The last one frees it. */
static inline void renderer_let_go(renderer_scene *s)
{
    if (!s->users || --*s->users) return;
    free(s->users);
    for (int i = 0; i < s->mesh_count; i++) renderer_shape_free(&s->meshes[i]);
    for (int i = 0; i < s->texture_count; i++) renderer_texture_free(&s->textures[i]);
    free(s->meshes);
    free(s->textures);
    free(s->objects);
}

/* What a picture shows: nothing of it changes until it is let go. */
static inline renderer_scene renderer_snapshot(const renderer_scene *s)
{
    renderer_scene out;
    renderer_lock();
    out = s->held ? *s->held : *s;
    ++*out.users;
    renderer_unlock();
    return out;
}

static inline void *renderer_twin(const void *from, int count, size_t size)
{
    void *to = malloc((size_t)count * size + 1);
    if (to && count) memcpy(to, from, (size_t)count * size);
    return to;
}

/* Makes the state the scene's own, with the lock, where pictures have it too.  0: out of memory
   */
static inline int renderer_own(renderer_scene *s)
{
    renderer_scene n = *s;
    if (*s->users == 1) return 1;
    n.users = renderer_count_new();
    n.objects = (renderer_object *)renderer_twin(s->objects, s->object_count, sizeof *n.objects);
    n.meshes = (renderer_shape *)renderer_twin(s->meshes, s->mesh_count, sizeof *n.meshes);
    n.textures =
        (renderer_texture *)renderer_twin(s->textures, s->texture_count, sizeof *n.textures);
    n.object_room = s->object_count;
    if (!n.users || !n.objects || !n.meshes || !n.textures) {
        free(n.users);
        free(n.objects);
        free(n.meshes);
        free(n.textures);
        return 0;
    }
    for (int i = 0; i < n.mesh_count; i++)
        if (n.meshes[i].users) ++*n.meshes[i].users;
    for (int i = 0; i < n.texture_count; i++)
        if (n.textures[i].users) ++*n.textures[i].users;
    --*s->users;
    *s = n;
    return 1;
}

/* Pictures show what there is now until renderer_done.  0: out of memory */
static inline int renderer_hold(renderer_scene *s)
{
    renderer_scene *held = (renderer_scene *)malloc(sizeof *held);
    if (!held) return 0;
    renderer_lock();
    *held = *s;
    ++*held->users;
    s->held = held;
    renderer_unlock();
    return 1;
}

static inline void renderer_done(renderer_scene *s)
{
    renderer_scene *held = s->held;
    renderer_lock();
    s->held = NULL;
    if (held) renderer_let_go(held);
    renderer_unlock();
    free(held);
}

static inline void renderer_scene_close(renderer_scene *s)
{
    if (!s) return;
    for (int i = 0; i < 3 * RENDERER_LEVELS && !s->borrowed; i++)
        renderer_shape_free(&s->round[i / RENDERER_LEVELS][i % RENDERER_LEVELS]);
    if (!s->borrowed) renderer_shape_free(&s->box);
    if (!s->borrowed) renderer_shape_free(&s->plane);
    renderer_lock();
    for (int i = 0; i < s->spare_count; i++) renderer_shape_free(&s->spares[i]);
    free(s->spares);
    renderer_let_go(s);
    renderer_unlock();
    free(s);
}

/* NULL: out of memory */
static inline renderer_scene *renderer_scene_open(void)
{
    renderer_scene *s = (renderer_scene *)calloc(1, sizeof *s);
    int good = s && (s->users = renderer_count_new()) != NULL && renderer_make_box(&s->box) &&
               renderer_make_plane(&s->plane);
    renderer_survive_fork();
    for (int k = 0; good && k < RENDERER_LEVELS; k++)
        good = renderer_make_sphere(&s->round[0][k], renderer_slices(k), 0) &&
               renderer_make_sphere(&s->round[1][k], renderer_slices(k), 1) &&
               renderer_make_cylinder(&s->round[2][k], renderer_slices(k));
    if (good) return s;
    renderer_scene_close(s);
    return NULL;
}

/* An empty scene that borrows the shapes of another one, 3 MB.  NULL: out of memory */
static inline renderer_scene *renderer_scene_like(const renderer_scene *of, int serial)
{
    renderer_scene *s = (renderer_scene *)calloc(1, sizeof *s);
    if (!s) return NULL;
    memcpy(s->round, of->round, sizeof s->round);
    s->box = of->box;
    s->plane = of->plane;
    s->borrowed = 1;
    s->serial = serial;
    s->users = renderer_count_new();
    if (s->users) return s;
    free(s);
    return NULL;
}

/* A copy of rows of width floats; what is absent stays NULL.  0: out of memory */
static inline int renderer_copy(float **to, const float *from, int count, size_t width)
{
    const size_t bytes = (size_t)count * width * sizeof(float);
    if (!from) return 1;
    *to = (float *)malloc(bytes + 1);
    if (*to) memcpy(*to, from, bytes);
    return *to != NULL;
}

static inline void renderer_bound(renderer_shape *s, const shade_mesh *m)
{
    shade_vec3 low = { 0, 0, 0 }, high = { 0, 0, 0 };
    shade_mesh_bounds(m, &low, &high);
    s->centre = shade_scale(shade_add(low, high), 0.5f);
    s->radius = 0.5001f * shade_distance(low, high);
}

/* A vertex for each corner, with the normal of its face.  0: out of memory */
static inline int renderer_split(renderer_shape *s)
{
    renderer_shape out;
    if (!renderer_shape_open(&out, s->index_count, s->index_count)) return 0;
    if (s->texcoords) out.texcoords = (float *)calloc((size_t)s->index_count + 1, 8);
    if (s->colors) out.colors = (float *)calloc((size_t)s->index_count + 1, 12);
    if ((s->texcoords && !out.texcoords) || (s->colors && !out.colors)) {
        renderer_shape_free(&out);
        return 0;
    }
    for (int i = 0; i < s->index_count; i += 3) {
        const float *p[3];
        shade_vec3 n;
        for (int k = 0; k < 3; k++) p[k] = s->positions + 3 * (size_t)s->indices[i + k];
        n = shade_face_normal(renderer_get(p[0]), renderer_get(p[1]), renderer_get(p[2]));
        for (int k = 0; k < 3; k++) renderer_put(&out, renderer_get(p[k]), n);
        renderer_face(&out, i, i + 1, i + 2);
    }
    for (int i = 0; i < s->index_count; i++) {
        const size_t to = (size_t)i, at = s->indices[i];
        if (out.texcoords) memcpy(out.texcoords + 2 * to, s->texcoords + 2 * at, 8);
        if (out.colors) memcpy(out.colors + 3 * to, s->colors + 3 * at, 12);
    }
    renderer_shape_free(s);
    *s = out;
    return 1;
}

/* An array with room for element number, all new ones zero, and their count.  NULL: out of
   memory, and the array stays */
static inline void *renderer_reach_to(void *array, int *count, int number, size_t size)
{
    const size_t old = (size_t)*count, wanted = (size_t)number + 1;
    char *grown;
    if (wanted <= old) return array;
    grown = (char *)realloc(array, wanted * size);
    if (!grown) return NULL;
    memset(grown + old * size, 0, (wanted - old) * size);
    *count = number + 1;
    return grown;
}

/* A shape of a mesh with tight rows and indices below vertex_count.  Without normals faces have
   theirs, or with smooth vertices the mean of their faces.  0: out of memory */
static inline int renderer_shape_of(renderer_shape *s, const shade_mesh *m, int smooth)
{
    int good;
    if (!renderer_shape_open(s, m->vertex_count, m->index_count)) return 0;
    s->vertex_count = m->vertex_count;
    s->index_count = m->index_count;
    memcpy(s->positions, m->positions, (size_t)s->vertex_count * 3 * sizeof(float));
    memcpy(s->indices, m->indices, (size_t)s->index_count * sizeof(uint32_t));
    good = renderer_copy(&s->texcoords, m->texcoords, m->vertex_count, 2) &&
           renderer_copy(&s->colors, m->colors, m->vertex_count, 3);
    if (m->normals)
        memcpy(s->normals, m->normals, (size_t)s->vertex_count * 3 * sizeof(float));
    else if (good && smooth)
        good = !shade_mesh_normals(m, (shade_vec3 *)(void *)s->normals);
    else if (good)
        good = renderer_split(s);
    if (good && renderer_make_planes(s)) {
        renderer_bound(s, m);
        return 1;
    }
    renderer_shape_free(s);
    return 0;
}

/* Puts a copy of a mesh in the place of mesh number; with m NULL that is freed.  Numbers are the
   caller's.  0: out of memory, and nothing has changed */
static inline int renderer_set_mesh(renderer_scene *scene, int number, const shade_mesh *m,
                                    int smooth, const double *origin)
{
    static const renderer_shape none;
    renderer_shape s = none, *all = NULL;
    if (m && (!renderer_shape_of(&s, m, smooth) || !(s.users = renderer_count_new()))) return 0;
    renderer_lock();
    if (renderer_own(scene))
        all = (renderer_shape *)renderer_reach_to(scene->meshes, &scene->mesh_count, number,
                                                  sizeof s);
    if (all) {
        scene->meshes = all;
        renderer_shape_free(&all[number]);
        if (number < scene->spare_count) renderer_shape_free(&scene->spares[number]);
        if (m && origin) memcpy(s.origin, origin, sizeof s.origin);
        all[number] = s;
        scene->version++;
    } else
        renderer_shape_free(&s);
    renderer_unlock();
    return all != NULL;
}

/* A picture as the scene has it, and its faces */
typedef struct renderer_image {
    const uint8_t *rgba;
    int width, height;
    int faces; /* 1, or 6 one below the other, for a cube, which needs no wrap */
    int srgb, wrap_u, wrap_v;
    int squares; /* its texels are to be seen as such */
} renderer_image;

/* Copies a picture with its mipmaps.  0: out of memory */
static inline int renderer_texture_of(renderer_texture *t, const renderer_image *from)
{
    const int width = from->width, height = from->height, faces = from->faces;
    const size_t bytes = 4 * (size_t)width * (size_t)height;
    const size_t below = (shade_mipmap_bytes(width, height, SHADE_FORMAT_RGBA8) + 15) / 16 * 16;
    const int levels = shade_mipmap_count(width, height);
    t->cube = faces == 6;
    t->memory = (uint8_t *)malloc((size_t)faces * (bytes + below) + 1);
    t->levels = (shade_texture *)calloc((size_t)(faces * levels) + 1, sizeof *t->levels);
    for (int i = 0; t->memory && t->levels && i < faces; i++) {
        uint8_t *at = t->memory + (size_t)i * (bytes + below);
        memcpy(at, from->rgba + (size_t)i * bytes, bytes);
        t->face[i] = (shade_texture){ .pixels = at, .width = width, .height = height };
        t->face[i].srgb = from->srgb;
        t->face[i].wrap_u = faces > 1 ? SHADE_WRAP_CLAMP : (shade_wrap)from->wrap_u;
        t->face[i].wrap_v = faces > 1 ? SHADE_WRAP_CLAMP : (shade_wrap)from->wrap_v;
        texture_levels(&t->face[i], t->levels + i * levels, at + bytes, below, from->squares);
    }
    if (t->memory && t->levels) return 1;
    renderer_texture_free(t);
    return 0;
}

/* Puts a copy of a picture in the place of texture number; with from NULL that is freed.  0: out
   of memory, and nothing has changed */
static inline int renderer_set_texture(renderer_scene *scene, int number,
                                       const renderer_image *from)
{
    static const renderer_texture none;
    renderer_texture t = none, *all = NULL;
    if (from && (!renderer_texture_of(&t, from) || !(t.users = renderer_count_new()))) return 0;
    renderer_lock();
    if (renderer_own(scene))
        all = (renderer_texture *)renderer_reach_to(scene->textures, &scene->texture_count, number,
                                                    sizeof t);
    if (all) {
        scene->textures = all;
        renderer_texture_free(&all[number]);
        all[number] = t;
        scene->version++;
    } else
        renderer_texture_free(&t);
    renderer_unlock();
    return all != NULL;
}

static inline renderer *renderer_open(void) { return (renderer *)calloc(1, sizeof(renderer)); }

static inline void renderer_close(renderer *r)
{
    if (!r) return;
    free(r->entries);
    free(r->whose);
    free(r->indices);
    free(r->owners);
    free(r->marks);
    free(r->depth);
    free(r->large_depth);
    for (int k = 0; k < RENDERER_LAMPS; k++) free(r->map[k].depth);
    free(r->color);
    free(r->large_color);
    free(r->known);
    free(r->moved);
    free(r);
}

/* Memory of so many bytes in place of what is at hand, where that is too small; its content is
   lost then.  A half more is taken than is needed, so that moving objects soon ask for no more.
   NULL: out of memory */
static inline void *renderer_room(void *at, size_t *room, size_t bytes)
{
    if (at && bytes <= *room) return at;
    free(at);
    *room = bytes + bytes / 2;
    at = malloc(*room + 1);
    if (!at) *room = 0;
    return at;
}

/* ---- objects that come, move and go ---------------------------------------------------------- */

/* Room for so many records.  0: out of memory, and all stays */
static inline int renderer_object_room(renderer_scene *s, int count)
{
    renderer_object *grown;
    if (count <= s->object_room) return 1;
    grown = (renderer_object *)realloc(s->objects, 2 * (size_t)count * sizeof *grown);
    if (!grown) return 0;
    s->objects = grown;
    s->object_room = 2 * count;
    return 1;
}

/* The first record with at least this number */
static inline int renderer_first(const renderer_scene *s, int number)
{
    int low = 0, high = s->object_count;
    while (low < high) {
        const int middle = low + (high - low) / 2;
        if (s->objects[middle].id < number)
            low = middle + 1;
        else
            high = middle;
    }
    return low;
}

/* The records of an object, with the lock.  NULL: there is no such number */
static inline renderer_object *renderer_find(const renderer_scene *s, int number, int *count)
{
    const int at = renderer_first(s, number);
    *count = 0;
    while (at + *count < s->object_count && s->objects[at + *count].id == number) ++*count;
    return *count ? s->objects + at : NULL;
}

/* Puts records of one object in the place of those that it has, with the lock.  0: out of memory
   */
static inline int renderer_put_in(renderer_scene *s, int number, const renderer_object *from,
                                  int count)
{
    const int at = renderer_first(s, number);
    int had;
    renderer_find(s, number, &had);
    if (!renderer_object_room(s, s->object_count - had + count)) return 0;
    memmove(s->objects + at + count, s->objects + at + had,
            (size_t)(s->object_count - at - had) * sizeof *s->objects);
    for (int i = 0; i < count; i++) {
        s->objects[at + i] = from[i];
        s->objects[at + i].id = number;
    }
    s->object_count += count - had;
    return 1;
}

/* Adds the records of one object and returns its number, which no other one had or will have.
   -1: out of memory, or of numbers */
static inline int renderer_add(renderer_scene *s, const renderer_object *from, int count)
{
    int number = -1;
    renderer_lock();
    if (s->next_number < INT32_MAX && renderer_own(s) &&
        renderer_put_in(s, s->next_number, from, count))
        number = s->next_number++;
    renderer_unlock();
    return number;
}

/* Gives an object other records, or with count 0 takes it away.  1: done, 0: out of memory, -1:
   there is no such number */
static inline int renderer_put_object(renderer_scene *s, int number, const renderer_object *from,
                                      int count)
{
    int done, had;
    renderer_lock();
    done = renderer_find(s, number, &had) ? renderer_own(s) : -1;
    if (done > 0) done = renderer_put_in(s, number, from, count);
    renderer_unlock();
    return done;
}

/* Puts all records, by their numbers, in the place of all that there are.  0: out of memory */
static inline int renderer_put_all(renderer_scene *s, const renderer_object *from, int count)
{
    int done;
    renderer_lock();
    done = renderer_own(s) && renderer_object_room(s, count);
    if (done && count) memcpy(s->objects, from, (size_t)count * sizeof *from);
    if (done) s->object_count = count;
    if (done && count && s->next_number <= from[count - 1].id)
        s->next_number = from[count - 1].id + 1;
    renderer_unlock();
    return done;
}

/* The number of the next object, which is made at_least this */
static inline int renderer_next(renderer_scene *s, int at_least)
{
    int number;
    renderer_lock();
    if (s->next_number < at_least) s->next_number = at_least;
    number = s->next_number;
    renderer_unlock();
    return number;
}

/* Copies the records of an object, or with number -1 of all, into room for so many.  Returns how
   many there are: with more than there is room for nothing is copied. */
static inline int renderer_records(const renderer_scene *s, int number, renderer_object *to,
                                   int room)
{
    int count;
    const renderer_object *from;
    renderer_lock();
    from = renderer_find(s, number, &count);
    if (number < 0) {
        from = s->objects;
        count = s->object_count;
    }
    if (count && count <= room) memcpy(to, from, (size_t)count * sizeof *to);
    renderer_unlock();
    return count;
}

/* m: 16 numbers, row by row */
static inline void renderer_move(renderer_object *o, const double *m)
{
    for (int k = 0; k < 9; k++) o->turn[k] = m[4 * (k / 3) + k % 3];
    for (int k = 0; k < 3; k++) o->place[k] = m[4 * k + 3];
}

/* Moves records that follow each other, a matrix for each number; returns how many matrices there
   are numbers for. */
static inline int renderer_move_all(renderer_object *o, int count, const double *rows, int poses)
{
    int n = -1;
    for (int i = 0; i < count; i++) {
        if (!i || o[i].id != o[i - 1].id) n++;
        if (n < poses) renderer_move(&o[i], rows + 16 * (size_t)n);
    }
    return n + 1;
}

/* Which of so many matrices is no rotation and translation; -1: all are */
static inline int renderer_not_rigid(const double *rows, int count)
{
    for (int i = 0; i < count; i++)
        if (!core_is_rigid(rows + 16 * (size_t)i)) return i;
    return -1;
}

/* Moves objects: a matrix of 16, row by row, for each of count numbers, or with numbers NULL for
   each object in their order.  All move at once, or none.  -1: done; else the first matrix that
   is refused, or -2: an object is missing, or there are others than count, -3: out of memory */
static inline int renderer_pose(renderer_scene *s, const int32_t *numbers, const double *rows,
                                int count)
{
    int bad = renderer_not_rigid(rows, count), had;
    if (bad >= 0) return bad;
    renderer_lock();
    for (int i = 0; numbers && i < count; i++)
        if (!renderer_find(s, numbers[i], &had)) bad = -2;
    if (!numbers && renderer_move_all(s->objects, s->object_count, rows, 0) != count) bad = -2;
    if (bad == -1 && !renderer_own(s)) bad = -3;
    if (bad == -1 && !numbers) renderer_move_all(s->objects, s->object_count, rows, count);
    for (int i = 0; numbers && bad == -1 && i < count; i++) {
        renderer_object *o = renderer_find(s, numbers[i], &had);
        renderer_move_all(o, had, rows + 16 * (size_t)i, 1);
    }
    renderer_unlock();
    return bad;
}

/* ---- lamps and sky --------------------------------------------------------------------------- */

/* Up to RENDERER_LAMPS lamps, with 4 numbers each for their places in double.  Shadows: a bit for
   each lamp, which must be directional or a spot.  Pictures show all of it or nothing. */
static inline void renderer_set_lights(renderer_scene *s, const shade_light *lights,
                                       const double *places, int count, shade_vec3 ambient,
                                       int shadows)
{
    renderer_lock();
    if (count) memcpy(s->around.lights, lights, (size_t)count * sizeof *lights);
    if (count) memcpy(s->around.places, places, (size_t)count * 4 * sizeof *places);
    s->around.light_count = count;
    s->around.ambient = ambient;
    s->around.shadows = shadows;
    renderer_unlock();
}

/* Takes what stands behind all objects of from: background, sky, sky_texture, sky_low, sky_high.
   */
static inline void renderer_set_behind(renderer_scene *s, const renderer_around *from)
{
    renderer_lock();
    s->around.background = from->background;
    s->around.sky = from->sky;
    s->around.sky_texture = from->sky_texture;
    s->around.sky_low = from->sky_low;
    s->around.sky_high = from->sky_high;
    renderer_unlock();
}

/* ---- what can be seen ------------------------------------------------------------------------ */

enum {
    RENDERER_KEY_COLORS = 1,
    RENDERER_KEY_TWO_SIDED = 2,
    RENDERER_KEY_HOLES = 4,
    RENDERER_KEY_TEXTURE = 8
};
/* Objects of fewer vertices are drawn together, because a draw costs about as much as these. */
enum { RENDERER_ALONE = 200 };

/* A camera, or the lamp that casts shadows, as the stages below need it */
typedef struct renderer_view {
    const renderer_picture *p;
    const renderer_scene *scene;
    const shade_light *lights; /* of the scene, from the origin */
    double origin[3];          /* from where the world of this picture counts */
    shade_mat4 view, projection;
    shade_mat4 clip, place; /* world to clip space; camera to world */
    shade_vec3 eye;
    shade_vec4 side[4]; /* planes through the picture's sides, in camera space, unit */
    float near_z, far_z;
    float scale;           /* pixels of a unit at distance 1, or anywhere */
    int parallel, shadows; /* shadows: of a lamp */
} renderer_view;

static inline void renderer_aim(renderer_view *v)
{
    const shade_mat4 *m = &v->projection;
    v->clip = shade_mat4_mul(*m, v->view);
    v->place = shade_mat4_inverse(v->view);
    v->eye = shade_v3(v->place.col[3].x, v->place.col[3].y, v->place.col[3].z);
    for (int k = 0; k < 4; k++) {
        const shade_mat4 rows = shade_mat4_transpose(*m);
        const shade_vec4 across = rows.col[k / 2], w = rows.col[3];
        const shade_vec4 plane = k % 2 ? shade_sub4(w, across) : shade_add4(w, across);
        const float length = shade_length(shade_v3(plane.x, plane.y, plane.z));
        v->side[k] = shade_scale4(plane, length > 0 ? 1 / length : 0);
    }
}

/* From where a picture counts, so that floats tell what is near its eye apart: from zero, or
   where the eye is more than 65,536 times near from it, from a round number beside the
   eye.  65,536 times near floats still tell a hundredth of near, and within a step of 4,096 to
   8,192 times near the shadow maps are kept.  step: 0, or that step */
static inline double renderer_step(const renderer_picture *p, const double *eye)
{
    const double size = p->parallel ? 1 / (double)p->projection.col[1].y : (double)p->near_z;
    const double near = size < 0 ? -size : size;
    double most = 0, step = 1;
    for (int k = 0; k < 3; k++) most = fabs(eye[k]) > most ? fabs(eye[k]) : most;
    if (!(most > 65536 * near && near > 1e-300)) return 0;
    while (step < 4096 * near) step *= 2;
    while (step > 8192 * near) step /= 2;
    return step;
}

static inline void renderer_locate(renderer_view *v)
{
    const double *m = v->p->view;
    double eye[3], move[3], step;
    for (int k = 0; k < 3; k++)
        eye[k] = -(m[4 * k] * m[12] + m[4 * k + 1] * m[13] + m[4 * k + 2] * m[14]);
    step = renderer_step(v->p, eye);
    for (int k = 0; k < 3 && step > 0; k++) v->origin[k] = step * floor(eye[k] / step + 0.5);
    for (int k = 0; k < 3; k++)
        move[k] =
            m[12 + k] + m[k] * v->origin[0] + m[4 + k] * v->origin[1] + m[8 + k] * v->origin[2];
    for (int k = 0; k < 4; k++)
        v->view.col[k] = shade_v4((float)m[4 * k], (float)m[4 * k + 1], (float)m[4 * k + 2],
                                  (float)m[4 * k + 3]);
    v->view.col[3] = shade_v4((float)move[0], (float)move[1], (float)move[2], (float)m[15]);
}

/* Where an object stands, and its shape's own origin, from the origin of the view: subtracted in
   double, before they are floats */
static inline void renderer_stand(const renderer_view *v, const renderer_object *o,
                                  renderer_entry *e)
{
    const double *t = o->turn, *from = v->origin;
    const double *own = o->kind == RENDERER_MESH ? v->scene->meshes[o->mesh].origin : NULL;
    double at[3] = { o->place[0] - from[0], o->place[1] - from[1], o->place[2] - from[2] };
    for (int k = 0; k < 3 && own && (own[0] != 0 || own[1] != 0 || own[2] != 0); k++)
        for (int j = 0; j < 3; j++) at[k] += t[3 * k + j] * (double)o->size[j] * own[j];
    e->place = shade_v3((float)at[0], (float)at[1], (float)at[2]);
    for (int k = 0; k < 9; k++) e->turn[k] = (float)t[k];
}

/* The picture's camera with reversed depth, 1 at near and 0 at far, of which floats keep as many
   digits far away as nearby. */
static inline renderer_view renderer_view_of(const renderer_picture *p, const renderer_scene *s)
{
    renderer_view v = { .p = p, .scene = s, .projection = p->projection };
    renderer_locate(&v);
    const float n = p->near_z, f = p->far_z;
    const shade_vec4 *row = v.projection.col;
    float slope = f >= 1e30f ? 0 : p->parallel ? 1 / (f - n) : n / (f - n);
    v.projection.col[0].z = v.projection.col[1].z = 0;
    v.projection.col[2].z = slope;
    v.projection.col[3].z = f >= 1e30f ? n : f * slope;
    v.near_z = n;
    v.far_z = f;
    v.parallel = p->parallel;
    v.scale = 0.5f * (float)p->height * shade_length(shade_v3(row[0].y, row[1].y, 0));
    renderer_aim(&v);
    return v;
}

/* Whether a sphere may be seen, and how far its nearest point is along the axis of view */
static inline int renderer_in_view(const renderer_view *v, shade_vec3 at, float radius,
                                   float *distance)
{
    const shade_vec3 e = shade_mat4_transform_point(v->view, at);
    *distance = -e.z - radius;
    if (-e.z + radius < v->near_z || *distance > v->far_z) return 0;
    for (int k = 0; k < 4; k++) {
        const shade_vec4 *s = &v->side[k];
        if (s->x * e.x + s->y * e.y + s->z * e.z + s->w < -radius) return 0;
    }
    return 1;
}

/* The level whose chords lie at most the tolerance inside of a circle of so many pixels */
static inline int renderer_level(const renderer_shape *levels, float pixels, float tolerance)
{
    int k = 0;
    while (k < RENDERER_LEVELS - 1 && levels[k].sag * pixels > tolerance) k++;
    return k;
}

static inline float renderer_most(const float *size)
{
    const float m = size[0] > size[1] ? size[0] : size[1];
    return m > size[2] ? m : size[2];
}

/* Turn, place and size of an object as one matrix.  The two halves of a capsule are only scaled
   by its radius here: they are lifted apart vertex by vertex. */
static inline shade_mat4 renderer_world(const renderer_object *o, const renderer_entry *e)
{
    const float *t = e->turn, *s = o->size;
    const float up = o->kind == RENDERER_CAPSULE ? s[0] : s[2];
    shade_mat4 m;
    m.col[0] = shade_v4(t[0] * s[0], t[3] * s[0], t[6] * s[0], 0);
    m.col[1] = shade_v4(t[1] * s[1], t[4] * s[1], t[7] * s[1], 0);
    m.col[2] = shade_v4(t[2] * up, t[5] * up, t[8] * up, 0);
    m.col[3] = shade_v4(e->place.x, e->place.y, e->place.z, 1);
    return m;
}

/* The height of the eye over a plane, in double, because its place may be far away */
static inline float renderer_height(const renderer_view *v, const renderer_object *o)
{
    const float eye[3] = { v->eye.x, v->eye.y, v->eye.z };
    double sum = 0;
    for (int k = 0; k < 3; k++)
        sum += (v->origin[k] + (double)eye[k] - o->place[k]) * o->turn[3 * k + 2];
    return (float)sum;
}

/* An endless plane is a large one below the eye.  Its size stays below 1e5 distances of the eye,
   so that floats place its corners. */
static inline void renderer_stretch(const renderer_view *v, const renderer_object *o,
                                    renderer_entry *e)
{
    const float *t = e->turn;
    const shade_vec3 n = shade_v3(t[2], t[5], t[8]);
    const float height = v->origin[0] == 0 && v->origin[1] == 0 && v->origin[2] == 0
                             ? shade_dot(shade_sub(v->eye, e->place), n)
                             : renderer_height(v, o);
    const float away = height < 0 ? -height : height, most = 1e4f * (1 + away);
    const float far_z = v->far_z < most ? 2 * v->far_z : most;
    const shade_vec3 foot = shade_madd(v->eye, -height, n);
    float half[2] = { o->size[0], o->size[1] };
    if (half[0] <= 0 || half[1] <= 0) e->world.col[3] = shade_v4(foot.x, foot.y, foot.z, 1);
    for (int k = 0; k < 2; k++) {
        if (half[k] <= 0) half[k] = far_z;
        e->world.col[k] = shade_v4(t[k] * half[k], t[3 + k] * half[k], t[6 + k] * half[k], 0);
    }
    e->world.col[2] = shade_v4(n.x, n.y, n.z, 0);
}

/* The sphere around an object */
static inline float renderer_reach(const renderer_scene *s, const renderer_object *o,
                                   const renderer_entry *e, shade_vec3 *centre)
{
    const float *z = o->size;
    *centre = e->place;
    switch (o->kind) {
    case RENDERER_MESH: {
        const renderer_shape *m = &s->meshes[o->mesh];
        *centre = shade_mat4_transform_point(renderer_world(o, e), m->centre);
        return m->radius * renderer_most(z);
    }
    case RENDERER_SPHERE:
    case RENDERER_ELLIPSOID: return renderer_most(z);
    case RENDERER_CAPSULE: return z[0] + z[2];
    default: return shade_length(shade_v3(z[0], z[1], o->kind == RENDERER_PLANE ? 0 : z[2]));
    }
}

static inline void renderer_detail(const renderer_view *v, const renderer_object *o,
                                   renderer_entry *e, float distance)
{
    const float nearest = distance > v->near_z ? distance : v->near_z;
    const int which = o->kind == RENDERER_CAPSULE ? 1 : o->kind == RENDERER_CYLINDER ? 2 : 0;
    const float radius = which ? o->size[0] : renderer_most(o->size);
    const renderer_shape *levels = v->scene->round[which];
    const float pixels = radius * (v->parallel ? v->scale : v->scale / nearest);
    /* in a shadow map a chord too far inside moves an outline, and hides nothing that is lit */
    const float tolerance = v->p->tolerance * (v->shadows ? 4.0f : 1.0f);
    e->shape = levels + renderer_level(levels, pixels, tolerance);
    e->sag = e->shape->sag * radius;
    e->lift = which == 1 ? o->size[2] : 0;
}

static inline int renderer_is_endless(const renderer_object *o)
{
    return o->kind == RENDERER_PLANE && (o->size[0] <= 0 || o->size[1] <= 0);
}

static inline int renderer_is_blended(const renderer_picture *p, const renderer_object *o)
{
    return (o->rgba[3] < 1 || (o->flags & RENDERER_BLENDED)) && !p->solid;
}

static inline int renderer_has_holes(const renderer_object *o)
{
    return o->cutoff > 0 && o->texture;
}

/* Fills in an entry.  0: the object cannot be seen */
static inline int renderer_enter(const renderer_view *v, int number, renderer_entry *e)
{
    const renderer_object *o = &v->p->objects[number];
    const int endless = renderer_is_endless(o);
    const int holes = renderer_has_holes(o) ? RENDERER_KEY_HOLES : 0;
    shade_vec3 centre;
    float radius;
    if ((o->flags & RENDERER_HIDDEN) || o->rgba[3] <= 0) return 0;
    renderer_stand(v, o, e);
    radius = renderer_reach(v->scene, o, e, &centre);
    e->distance = v->far_z;
    if (!endless && !renderer_in_view(v, centre, radius, &e->distance)) return 0;
    /* spheres around ground and walls reach behind the eye, which mostly sees them behind others:
       drawn last, they are not lit where they are hidden, a fifth of the pixels of robots.py */
    e->order = e->distance > v->near_z ? e->distance : v->far_z;
    e->object = number;
    e->world = renderer_world(o, e);
    e->sag = e->lift = 0;
    e->uneven = (o->kind == RENDERER_MESH || o->kind == RENDERER_ELLIPSOID) &&
                (o->size[0] != o->size[1] || o->size[0] != o->size[2]);
    switch (o->kind) {
    case RENDERER_MESH: e->shape = &v->scene->meshes[o->mesh]; break;
    case RENDERER_BOX: e->shape = &v->scene->box; break;
    case RENDERER_PLANE:
        e->shape = &v->scene->plane;
        renderer_stretch(v, o, e);
        break;
    default: renderer_detail(v, o, e, e->distance);
    }
    /* all that casts shadows is drawn together; a distant lamp needs no backs of what is closed
       */
    if (v->shadows) {
        const int closed = o->kind != RENDERER_MESH && o->kind != RENDERER_PLANE;
        e->key = closed && v->parallel ? 0 : RENDERER_KEY_TWO_SIDED;
        if (holes) e->key = RENDERER_KEY_TWO_SIDED + holes + o->texture * RENDERER_KEY_TEXTURE;
        return 1;
    }
    e->key = (e->shape->colors ? RENDERER_KEY_COLORS : 0) + holes +
             (o->flags & RENDERER_TWO_SIDED ? RENDERER_KEY_TWO_SIDED : 0) +
             o->texture * RENDERER_KEY_TEXTURE;
    return 1;
}

/* Opaque objects from front to back, so that what is hidden is not lit; those of one texture
   follow each other.  Ties go to the lower number: the order is the same on every machine. */
static inline int renderer_order(const void *a, const void *b)
{
    const renderer_entry *x = (const renderer_entry *)a, *y = (const renderer_entry *)b;
    if (x->key != y->key) return x->key < y->key ? -1 : 1;
    if (x->order != y->order) return x->order < y->order ? -1 : 1;
    return x->object - y->object;
}

/* From back to front */
static inline int renderer_order_back(const void *a, const void *b)
{
    const renderer_entry *x = (const renderer_entry *)a, *y = (const renderer_entry *)b;
    if (x->distance != y->distance) return x->distance > y->distance ? -1 : 1;
    return x->object - y->object;
}

/* Entries of the opaque or of the blended objects, in their order; of a lamp those that cast
   shadows.  Returns how many there are. */
static inline int renderer_gather(renderer *r, const renderer_view *v, int blended)
{
    int count = 0;
    for (int i = 0; i < v->p->object_count; i++) {
        const renderer_object *o = &v->p->objects[i];
        if (renderer_is_blended(v->p, o) != blended) continue;
        if (v->shadows && ((o->flags & RENDERER_CASTS_NO_SHADOW) || renderer_is_endless(o)))
            continue;
        count += renderer_enter(v, i, &r->entries[count]);
    }
    qsort(r->entries, (size_t)count, sizeof *r->entries,
          blended ? renderer_order_back : renderer_order);
    return count;
}

/* ---- vertices -------------------------------------------------------------------------------- */

/* What a draw of several objects, or of a large one, is made with */
typedef struct renderer_batch {
    const renderer *r;
    const renderer_view *v;
    const renderer_entry *entry; /* the first */
    const renderer_texture *texture;
    const shade_lighting *lighting; /* NULL: colours are not wanted */
    int several;                    /* more than one object */
    int uv, colors;                 /* the varyings that they are; 0: there are none */
    int notes, blended, two_sided, holes;
    int meshes;                       /* whether any of its objects is one */
    int glossy, glows, metals, unlit; /* whether any of its objects is so */
    int maps;                         /* the varyings that u, v of relief and glow_map are */
    relief relief;                    /* of its one object */
    const shade_texture *glow_map;    /* NULL: none */
    int glow_finer;                   /* levels from the texture whose lod is known */
    shade_mesh mesh;                  /* that the relief lies on */
} renderer_batch;

/* How u and v follow from coordinates or texcoords */
static inline shade_vec2 renderer_uv(const renderer_shape *s, const renderer_object *o, size_t k,
                                     shade_vec3 local)
{
    const float u = o->repeat[0], v = o->repeat[1];
    if (!s->texcoords) return shade_v2(0.5f + u * local.x, 0.5f - v * local.y);
    return shade_v2(u * s->texcoords[2 * k], v * s->texcoords[2 * k + 1]);
}

/* Place in the object, in its unit: what textures stick to */
static inline shade_vec3 renderer_local(const renderer_entry *e, shade_vec3 world)
{
    const float *t = e->turn;
    const shade_vec3 d = shade_sub(world, e->place);
    return shade_v3(t[0] * d.x + t[3] * d.y + t[6] * d.z, t[1] * d.x + t[4] * d.y + t[7] * d.z,
                    t[2] * d.x + t[5] * d.y + t[8] * d.z);
}

/* The way out of the cube that a cube texture is pasted on: objects are scaled to fit it. */
static inline shade_vec3 renderer_in_cube(const renderer_object *o, shade_vec3 local)
{
    const float *z = o->size;
    if (o->kind == RENDERER_MESH || z[0] <= 0 || z[1] <= 0 || z[2] <= 0) return local;
    return shade_v3(local.x / z[0], local.y / z[1], local.z / z[2]);
}

static inline shade_vec3 renderer_place(const renderer_entry *e, const float *p, int upper)
{
    const shade_vec4 *m = e->world.col;
    shade_vec3 at = shade_v3(m[0].x * p[0] + m[1].x * p[1] + m[2].x * p[2] + m[3].x,
                             m[0].y * p[0] + m[1].y * p[1] + m[2].y * p[2] + m[3].y,
                             m[0].z * p[0] + m[1].z * p[1] + m[2].z * p[2] + m[3].z);
    if (e->lift > 0) { /* the third axis has the length of the radius */
        const float along = shade_length(shade_v3(m[2].x, m[2].y, m[2].z));
        const float s = (upper ? e->lift : -e->lift) / along;
        at = shade_madd(at, s, shade_v3(m[2].x, m[2].y, m[2].z));
    }
    return at;
}

static inline void renderer_set(float *to, shade_vec3 v)
{
    to[0] = v.x;
    to[1] = v.y;
    to[2] = v.z;
}

/* Places and values of a vertex in the world: place, normal, what its texture follows, colour */
static inline void renderer_vertex_of(const renderer_batch *b, const renderer_entry *e, int k,
                                      float *out)
{
    const renderer_shape *s = e->shape;
    const renderer_object *o = &b->v->p->objects[e->object];
    const size_t at = 3 * (size_t)k;
    const shade_vec3 world = renderer_place(e, s->positions + at, k < s->upper);
    renderer_set(out, world);
    if (b->v->shadows && !b->holes) return;
    const shade_vec3 n = shade_mat3_transform(e->normal, renderer_get(s->normals + at));
    renderer_set(out + 3, e->uneven ? shade_normalize(n) : n);
    if (b->texture) {
        const shade_vec3 local = renderer_local(e, world);
        if (b->texture->cube)
            renderer_set(out + 6, renderer_in_cube(o, local));
        else {
            const shade_vec2 uv = renderer_uv(s, o, (size_t)k, local);
            renderer_set(out + 6, shade_v3(uv.x, uv.y, 0));
        }
    }
    if (b->colors) memcpy(out + 9, s->colors + at, 3 * sizeof(float));
    if (b->maps) {
        const shade_vec2 uv = renderer_uv(s, o, (size_t)k, world);
        memcpy(out + 12, &uv, sizeof uv);
    }
}

/* Vertices are made as they are asked for: those of faces that look away mostly are not. */
static inline void renderer_shade_vertices(const void *uniforms,
                                           const shade_vertex_ids *SHADE_RESTRICT in,
                                           shade_vertices *SHADE_RESTRICT out)
{
    const renderer_batch *b = (const renderer_batch *)uniforms;
    const shade_mat4 clip = b->v->clip;
    const int few = b->v->shadows && !b->holes;
    const int count = few ? 3 : b->maps ? 14 : b->colors ? 12 : b->uv ? 9 : 6;
    float rows[14][SHADE_LANES], one[14] = { 0 };
    for (int i = 0; i < SHADE_LANES; i++) {
        if (i < in->count) {
            const uint32_t at = in->index[i];
            const renderer_entry *e = b->entry + (b->several ? b->r->whose[at] : 0);
            renderer_vertex_of(b, e, (int)at - e->first, one);
        }
        for (int k = 0; k < count; k++) rows[k][i] = one[k];
    }
    SHADE_EACH_LANE(i)
    {
        const shade_vec4 at = shade_v4(rows[0][i], rows[1][i], rows[2][i], 1);
        lane_put4(out->clip[0], i, shade_mat4_transform(clip, at));
    }
    if (!b->lighting && !b->notes && !b->blended && !b->holes) return;
    memcpy(out->varying[0], rows[0], 6 * sizeof rows[0]);
    if (b->uv) memcpy(out->varying[b->uv], rows[6], 3 * sizeof rows[0]);
    if (b->colors) memcpy(out->varying[b->colors], rows[9], 3 * sizeof rows[0]);
    if (b->maps) memcpy(out->varying[b->maps], rows[12], 2 * sizeof rows[0]);
}

/* ---- what a pixel shows ---------------------------------------------------------------------- */

/* The values of the lanes' objects, a row each */
typedef struct renderer_surface {
    float albedo[3][SHADE_LANES], alpha[SHADE_LANES];
    float specular[3][SHADE_LANES], shininess[SHADE_LANES], emission[SHADE_LANES];
    float glow[3][SHADE_LANES];
    float sag[SHADE_LANES], metal[SHADE_LANES], tint[SHADE_LANES], unlit[SHADE_LANES];
    int glossy, glows, alike; /* alike: one shininess for all lanes */
} renderer_surface;

/* The entries that the lanes' triangles belong to.  Non-zero: all to owner[0] */
static inline int renderer_find_owners(const renderer_batch *b, const shade_fragments *in,
                                       uint32_t *owner)
{
    uint32_t others = 0;
    owner[0] = 0;
    if (!b->several) return 1;
    for (int i = 0; i < SHADE_LANES; i++) owner[i] = b->r->owners[in->primitive[i]];
    for (int i = 0; i < SHADE_LANES; i++) others |= owner[i] ^ owner[0];
    return !others;
}

static inline void renderer_fill(float *row, float value, int first, int last)
{
    if (last - first == SHADE_LANES) SHADE_EACH_LANE(i)
        {
            row[i] = value;
        }
    else
        for (int i = first; i < last; i++) row[i] = value;
}

static inline int renderer_is_glossy(const renderer_object *o)
{
    return o->specular[0] > 0 || o->specular[1] > 0 || o->specular[2] > 0 || o->tint > 0;
}

static inline int renderer_glows(const renderer_object *o)
{
    return o->emission > 0 || o->glow[0] > 0 || o->glow[1] > 0 || o->glow[2] > 0;
}

/* Rows that nothing in this draw reads stay as they are: filling all took a tenth of the time. */
static inline void renderer_surface_of(const renderer_batch *b, const renderer_entry *e,
                                       renderer_surface *s, int first, int last)
{
    const renderer_object *o = &b->v->p->objects[e->object];
    s->glossy |= renderer_is_glossy(o);
    s->glows |= renderer_glows(o);
    for (int k = 0; k < 3; k++) renderer_fill(s->albedo[k], o->rgba[k], first, last);
    if (b->blended) renderer_fill(s->alpha, o->rgba[3], first, last);
    if (b->glows) renderer_fill(s->emission, o->emission, first, last);
    for (int k = 0; k < 3 && b->glows; k++) renderer_fill(s->glow[k], o->glow[k], first, last);
    if (b->unlit) renderer_fill(s->unlit, o->flags & RENDERER_UNLIT ? 1 : 0, first, last);
    if (b->v->scene->around.shadows) renderer_fill(s->sag, e->sag, first, last);
    if (first)
        s->alike &= o->shininess == s->shininess[0];
    else
        s->shininess[0] = o->shininess;
    if (!b->glossy) return;
    renderer_fill(s->shininess, o->shininess, first, last);
    for (int k = 0; k < 3; k++) renderer_fill(s->specular[k], o->specular[k], first, last);
    if (!b->metals) return;
    renderer_fill(s->metal, o->metal, first, last);
    renderer_fill(s->tint, o->tint, first, last);
}

/* Neighbouring lanes mostly belong to one object. */
static inline void renderer_surfaces(const renderer_batch *b, const uint32_t *owner, int one,
                                     renderer_surface *s)
{
    s->glossy = s->glows = 0;
    s->alike = 1;
    for (int i = 0, end; i < SHADE_LANES; i = end) {
        end = one ? SHADE_LANES : i + 1;
        while (end < SHADE_LANES && owner[end] == owner[i]) end++;
        renderer_surface_of(b, b->entry + owner[i], s, i, end);
    }
}

/* Texels of a cube, face by face of those that the lanes look at, with the axis of greatest size
   first as in OpenGL */
static inline void renderer_sample_cube(const renderer_texture *t, float d[3][SHADE_LANES],
                                        float (*rgba)[SHADE_LANES])
{
    float u[SHADE_LANES], v[SHADE_LANES], texels[4][SHADE_LANES];
    int face[SHADE_LANES], seen = 0;
    SHADE_EACH_LANE(i)
    {
        const float x = d[0][i], y = d[1][i], z = d[2][i];
        const float ax = x < 0 ? -x : x, ay = y < 0 ? -y : y, az = z < 0 ? -z : z;
        const int axis = ax >= ay && ax >= az ? 0 : ay >= az ? 1 : 2;
        const float most = axis == 0 ? ax : axis == 1 ? ay : az;
        const float sc = axis == 0 ? (x > 0 ? -z : z) : axis == 1 ? x : z > 0 ? x : -x;
        const float tc = axis == 1 ? (y > 0 ? z : -z) : -y;
        const float half = most > 0 ? 0.5f / most : 0;
        face[i] = 2 * axis + (axis == 0 ? x < 0 : axis == 1 ? y < 0 : z < 0);
        u[i] = 0.5f + half * sc;
        v[i] = 0.5f + half * tc;
    }
    for (int i = 0; i < SHADE_LANES; i++) seen |= 1 << face[i];
    for (int f = 0; f < 6; f++) {
        if (!(seen >> f & 1)) continue;
        shade_sample_lanes(&t->face[f], u, v, NULL, texels[0]);
        for (int k = 0; k < 4; k++) SHADE_EACH_LANE(i)
            {
                rgba[k][i] = face[i] == f ? texels[k][i] : rgba[k][i];
            }
    }
}

static inline void renderer_texels(const renderer_batch *b, const shade_fragments *in,
                                   float (*texels)[SHADE_LANES])
{
    float d[3][SHADE_LANES];
    if (b->texture->cube) {
        memcpy(d, in->varying[b->uv], sizeof d);
        memset(texels, 0, 4 * sizeof *texels);
        renderer_sample_cube(b->texture, d, texels);
    } else
        shade_sample_lanes(b->texture->face, in->varying[b->uv], in->varying[b->uv + 1], in->lod,
                           texels[0]);
}

static inline void renderer_paint_map(const renderer_batch *b, const shade_fragments *in,
                                      renderer_surface *s)
{
    float texels[4][SHADE_LANES];
    renderer_texels(b, in, texels);
    for (int k = 0; k < 3; k++) SHADE_EACH_LANE(i)
        {
            s->albedo[k][i] *= texels[k][i];
        }
    if (b->blended) SHADE_EACH_LANE(i)
        {
            s->alpha[i] *= texels[3][i];
        }
}

/* Discards fragments in holes.  Depth is tested after this shader: hidden fragments come too. */
static inline void renderer_cut(const renderer_batch *b, const shade_fragments *in,
                                const uint32_t *owner, int one, uint32_t *discard)
{
    float texels[4][SHADE_LANES];
    renderer_texels(b, in, texels);
    for (int i = 0; i < in->count; i++) {
        const renderer_object *o = &b->v->p->objects[b->entry[owner[one ? 0 : i]].object];
        discard[i] = texels[3][i] * o->rgba[3] < o->cutoff;
    }
}

/* Where points of a lamp's clip space lie on its map: the first of 3 x 3 texels, how far beyond
   the middle one's corner they are, and their depth.  That is -1, before all that is drawn,
   beside the map, and 1, as deep as what is empty, beyond its far plane: ground that lies far
   below what casts shadows. */
static inline void renderer_on_map(int size, const float (*clip)[SHADE_LANES],
                                   int32_t *SHADE_RESTRICT at, float *SHADE_RESTRICT u,
                                   float *SHADE_RESTRICT v, float *SHADE_RESTRICT z)
{
    const float edge = (float)size;
    SHADE_EACH_LANE(i)
    {
        const float w = clip[3][i], half = 0.5f / (w > 1e-6f ? w : 1e-6f);
        const float x = edge * (0.5f + clip[0][i] * half), y = edge * (0.5f - clip[1][i] * half);
        const float right = x > 0 ? x : 0, down = y > 0 ? y : 0;
        const int32_t column = (int32_t)(right < edge ? right : edge);
        const int32_t line = (int32_t)(down < edge ? down : edge);
        const int32_t out = (column - 1) | (size - 2 - column) | (line - 1) | (size - 2 - line);
        const int32_t first = (line - 1) * size + column - 1;
        const float along = 0.5f + clip[2][i] * half, depth = along < 1 ? along : 1;
        u[i] = x - (float)column;
        v[i] = y - (float)line;
        z[i] = out < 0 ? -1 : depth;
        at[i] = out < 0 ? 0 : first;
    }
}

/* The share of 3 x 3 texels, weighted by their nearness, that lets the lamp's light pass.  Texels
   are fetched one by one.  Depths are compared as integers, because gcc makes no vectors of
   floats that conditions add to. */
static inline void renderer_passes(const renderer_map *m, const float (*clip)[SHADE_LANES],
                                   float *SHADE_RESTRICT passes)
{
    float z[SHADE_LANES], u[SHADE_LANES], v[SHADE_LANES], share[SHADE_LANES];
    int32_t at[SHADE_LANES], depth[SHADE_LANES], texel[SHADE_LANES];
    renderer_on_map(m->size, clip, at, u, v, z);
    memcpy(depth, z, sizeof z);
    SHADE_EACH_LANE(i) { passes[i] = 0; }
    for (int k = 0; k < 9; k++) {
        const float *map = m->depth + k / 3 * m->size + k % 3;
        const float a = k % 3 < 2, b = (float)(k % 3 - 1), c = k / 3 < 2, d = (float)(k / 3 - 1);
        for (int i = 0; i < SHADE_LANES; i++) memcpy(&texel[i], map + at[i], sizeof *texel);
        SHADE_EACH_LANE(i) { share[i] = 0.25f * (a + b * u[i]) * (c + d * v[i]); }
        SHADE_EACH_LANE(i) { share[i] = depth[i] <= texel[i] ? share[i] : 0; }
        SHADE_EACH_LANE(i) { passes[i] += share[i]; }
    }
    SHADE_EACH_LANE(i) { passes[i] = depth[i] < 0 ? 1 : passes[i]; }
}

/* Normals of the faces of meshes: those of their vertices may lean any way. */
static inline void renderer_face_normals(const renderer_batch *b, const shade_fragments *in,
                                         const uint32_t *owner, int one, float (*N)[SHADE_LANES])
{
    for (int i = 0; i < in->count; i++) {
        const renderer_entry *e = b->entry + owner[one ? 0 : i];
        const size_t row = renderer_plane_row(e->shape);
        const float *n = e->shape->planes + b->r->marks[in->primitive[i]].triangle;
        if (b->v->p->objects[e->object].kind != RENDERER_MESH) continue;
        const shade_vec3 local = shade_v3(n[0], n[row], n[2 * row]);
        const shade_vec3 face = shade_normalize(shade_mat3_transform(e->normal, local));
        lane_put(N[0], i, in->front[i] ? face : shade_neg(face));
    }
}

/* A texel holds for its centre, up to 2.1 texels from P, and a face that leans by theta off the
   lamp's axis is nearer to the lamp there by their tangent.  P moves along N, which is nearly
   unit, by what makes up for it, and for the chords of round shapes, which differ from map to
   picture. */
static inline void renderer_shadow(const renderer_map *m, const renderer_surface *s,
                                   const float (*P)[SHADE_LANES], const float (*N)[SHADE_LANES],
                                   float *visible)
{
    const shade_vec4 axis = m->axis;
    const shade_mat4 from_world = m->from_world;
    float L[3][SHADE_LANES], at[3][SHADE_LANES], facing[SHADE_LANES], clip[4][SHADE_LANES];
    shade_light_at_lanes(&m->lamp, P[0], L[0], NULL);
    SHADE_EACH_LANE(i)
    {
        const shade_vec3 p = lane(P[0], i), n = lane(N[0], i), l = lane(L[0], i);
        const float lean = shade_dot(n, shade_v3(axis.x, axis.y, axis.z)), square = 1 - lean * lean;
        /* three tangents of the root of the square stand in for the sine, which is below them */
        const float low = 0.125f + 2 * square, high = 0.5f + 0.5f * square;
        const float middle = 0.25f + square, least = low < middle ? low : middle;
        const float sine = least < high ? least : high;
        const float away = axis.x * p.x + axis.y * p.y + axis.z * p.z + axis.w;
        const float texel = m->texel + m->texel_slope * (away > 0 ? away : 0);
        facing[i] = shade_dot(n, l);
        lane_put(at[0], i, shade_madd(p, 2.2f * texel * (sine + 0.1f) + 2 * s->sag[i], n));
    }
    SHADE_EACH_LANE(i)
    {
        const shade_vec3 p = lane(at[0], i);
        lane_put4(clip[0], i, shade_mat4_transform(from_world, shade_v4(p.x, p.y, p.z, 1)));
    }
    renderer_passes(m, (const float(*)[SHADE_LANES])clip, visible);
    SHADE_EACH_LANE(i) { visible[i] = facing[i] > 0 ? visible[i] : 0; }
}

/* Lanes of another shininess than the first, one shininess after the other: a material has one.
   */
static inline void renderer_light_others(const renderer_surface *s, const shade_lighting *lighting,
                                         shade_material m, shade_vec3 eye, const shade_rows *rows,
                                         int count, float (*rgb)[SHADE_LANES])
{
    float lit[3][SHADE_LANES];
    uint8_t done[SHADE_LANES];
    for (int i = 0; i < count; i++) done[i] = s->shininess[i] == m.shininess;
    for (int i = 0; i < count; i++) {
        if (done[i]) continue;
        m.shininess = s->shininess[i];
        shade_lit_lanes(lighting, &m, eye, rows, lit[0]);
        for (int j = i; j < count; j++) {
            if (s->shininess[j] != m.shininess) continue;
            lane_put(rgb[0], j, lane(lit[0], j));
            done[j] = 1;
        }
    }
}

static inline void renderer_light(const renderer_batch *b, const renderer_surface *s,
                                  const shade_rows *rows, int count, float (*rgb)[SHADE_LANES])
{
    const shade_vec3 one = { 1, 1, 1 }, none = { 0, 0, 0 }, place = b->v->eye;
    const shade_vec4 back = b->v->place.col[2];
    const shade_vec3 eye = b->v->parallel ? shade_v3(back.x, back.y, back.z) : place;
    shade_material m = { none, one, one, s->glossy ? one : none, s->shininess[0] };
    shade_lighting lighting = *b->lighting;
    if (!s->glossy) lighting.model = SHADE_MODEL_LAMBERT;
    shade_lit_lanes(&lighting, &m, eye, rows, rgb[0]);
    if (s->glossy && !s->alike) renderer_light_others(s, &lighting, m, eye, rows, count, rgb);
}

/* 1: fragment i of a surface with holes lies in one, or what is drawn or a fragment before it
   hides it.  Fragments of other surfaces have passed the depth test, the nearest of a pixel last.
   */
static inline int renderer_is_hidden(const renderer_batch *b, const shade_fragments *in,
                                     const uint32_t *discard, const int32_t *at, int i)
{
    int hidden = discard[i] || !(in->z[i] > b->r->depth[at[i]]);
    for (int k = 0; k < i && !hidden; k++)
        hidden = at[k] == at[i] && !discard[k] && in->z[k] >= in->z[i];
    return hidden;
}

/* Numbers and normals of pixels */
static inline void renderer_note(const renderer_batch *b, const shade_fragments *in,
                                 const float (*N)[SHADE_LANES], const uint32_t *discard)
{
    const renderer_mark *marks = b->r->marks;
    const int width = b->v->p->width, count = in->count;
    int32_t *ids = b->v->p->ids, at[SHADE_LANES];
    float *normals = b->v->p->normals;
    SHADE_EACH_LANE(i) { at[i] = (int32_t)in->y[i] * width + (int32_t)in->x[i]; }
    for (int i = 0; i < count; i++) {
        if (b->holes && renderer_is_hidden(b, in, discard, at, i)) continue;
        if (ids) memcpy(ids + 2 * at[i], marks + in->primitive[i], sizeof *marks);
        if (normals) renderer_set(normals + 3 * (size_t)at[i], shade_normalize(lane(N[0], i)));
    }
}

/* How much of each lamp points see */
static inline void renderer_see_lamps(const renderer_batch *b, const shade_fragments *in,
                                      const renderer_surface *s, const float (*N)[SHADE_LANES],
                                      const uint32_t *owner, int one, float (*visible)[SHADE_LANES])
{
    float faces[3][SHADE_LANES];
    memcpy(faces, N, sizeof faces);
    if (b->meshes) renderer_face_normals(b, in, owner, one, faces);
    for (int k = 0; k < b->lighting->light_count; k++) {
        SHADE_EACH_LANE(i) { visible[k][i] = 1; }
        if (b->v->scene->around.shadows >> k & 1)
            renderer_shadow(&b->r->map[k], s, (const float(*)[SHADE_LANES])in->varying[0],
                            (const float(*)[SHADE_LANES])faces, visible[k]);
    }
}

/* Bends normals of the world by the relief, which lies in the space of the mesh. */
static inline void renderer_bend(const renderer_batch *b, const shade_fragments *in,
                                 float (*N)[SHADE_LANES])
{
    const shade_mat3 back = shade_mat3_transpose(shade_mat3_from_mat4(b->entry->world));
    const shade_mat3 normal = b->entry->normal;
    SHADE_EACH_LANE(i) { lane_put(N[0], i, shade_mat3_transform(back, lane(N[0], i))); }
    relief_bend(&b->relief, &b->mesh, in, b->maps, N);
    SHADE_EACH_LANE(i)
    {
        lane_put(N[0], i, shade_normalize(shade_mat3_transform(normal, lane(N[0], i))));
    }
}

/* Normals that look to the side from which a fragment is seen */
static inline void renderer_toward(const shade_fragments *in, const float (*N)[SHADE_LANES],
                                   float (*out)[SHADE_LANES])
{
    for (int k = 0; k < 3; k++) SHADE_EACH_LANE(i)
        {
            out[k][i] = in->front[i] ? N[k][i] : -N[k][i];
        }
}

static inline void renderer_shade(const void *uniforms, const shade_fragments *SHADE_RESTRICT in,
                                  shade_colors *SHADE_RESTRICT out)
{
    const renderer_batch *b = (const renderer_batch *)uniforms;
    float turned[3][SHADE_LANES], bent[3][SHADE_LANES], visible[RENDERER_LAMPS][SHADE_LANES];
    const float(*P)[SHADE_LANES] = (const float(*)[SHADE_LANES])in->varying[0];
    const float(*N)[SHADE_LANES] = (const float(*)[SHADE_LANES])in->varying[3];
    renderer_surface s;
    uint32_t owner[SHADE_LANES];
    int one;
    shade_rows rows = { .position = P[0] };
    if (b->relief.map) {
        memcpy(bent, N, sizeof bent);
        renderer_bend(b, in, bent);
        if (b->two_sided) renderer_toward(in, (const float(*)[SHADE_LANES])bent, bent);
    }
    if (b->two_sided) {
        renderer_toward(in, N, turned);
        N = (const float(*)[SHADE_LANES])turned;
    }
    rows.normal = b->relief.map ? bent[0] : N[0];
    one = renderer_find_owners(b, in, owner);
    if (b->holes) renderer_cut(b, in, owner, one, out->discard);
    if (b->notes) renderer_note(b, in, N, out->discard);
    if (!b->lighting) return;
    renderer_surfaces(b, owner, one, &s);
    for (int k = 0; k < 3 && b->colors; k++) SHADE_EACH_LANE(i)
        {
            s.albedo[k][i] *= in->varying[b->colors + k][i];
        }
    if (b->texture) renderer_paint_map(b, in, &s);
    for (int k = 0; k < 3 && b->metals; k++) {
        if (s.glossy) SHADE_EACH_LANE(i)
            {
                s.specular[k][i] += s.tint[i] * s.albedo[k][i];
            }
        SHADE_EACH_LANE(i) { s.albedo[k][i] *= 1 - s.metal[i]; }
    }
    rows.albedo = s.albedo[0];
    if (s.glossy) rows.specular = s.specular[0];
    if (b->v->scene->around.shadows) {
        renderer_see_lamps(b, in, &s, N, owner, one, visible);
        rows.visibility = visible[0];
    }
    renderer_light(b, &s, &rows, in->count, out->color);
    for (int k = 0; k < 3 && b->unlit; k++) SHADE_EACH_LANE(i)
        {
            out->color[k][i] = s.unlit[i] > 0 ? s.albedo[k][i] : out->color[k][i];
        }
    for (int k = 0; k < 3 && s.glows; k++) SHADE_EACH_LANE(i)
        {
            out->color[k][i] += s.emission[i] * s.albedo[k][i] + s.glow[k][i];
        }
    if (b->glow_map) {
        const float *f = b->v->p->objects[b->entry->object].glow_factor;
        float glow[3][SHADE_LANES];
        glow_light(b->glow_map, renderer_get(f), b->glow_finer, in, b->maps, glow);
        for (int k = 0; k < 3; k++) SHADE_EACH_LANE(i)
            {
                out->color[k][i] += glow[k][i];
            }
    }
    if (b->blended) memcpy(out->color[3], s.alpha, sizeof s.alpha);
}

/* ---- drawing --------------------------------------------------------------------------------- */

/* The triangles of its mesh that an entry shows, and how many.  The mesh may have fewer by now.
   */
static inline int renderer_range(const renderer_view *v, const renderer_entry *e, int *first)
{
    const renderer_object *o = &v->p->objects[e->object];
    const int all = e->shape->index_count / 3, rest = all - o->first;
    *first = o->count && o->first < all ? o->first : 0;
    return !o->count ? all : o->count < rest ? o->count : rest > 0 ? rest : 0;
}

/* Room for the triangles of entries, with one more, and for the owners of their vertices.  0:
   there is not enough memory */
static inline int renderer_room_for(renderer *r, const renderer_view *v, const renderer_entry *e,
                                    int count)
{
    size_t vertices = 0, triangles = 1;
    for (int i = 0, first; i < count; i++) {
        vertices += (size_t)e[i].shape->vertex_count;
        triangles += (size_t)renderer_range(v, e + i, &first);
    }
    r->whose = (uint32_t *)renderer_room(r->whose, &r->room[1], vertices * sizeof(uint32_t));
    r->indices =
        (uint32_t *)renderer_room(r->indices, &r->room[2], 3 * triangles * sizeof(uint32_t));
    r->owners = (uint32_t *)renderer_room(r->owners, &r->room[3], triangles * sizeof(uint32_t));
    r->marks = (renderer_mark *)renderer_room(r->marks, &r->room[9], triangles * sizeof *r->marks);
    return r->whose && r->indices && r->owners && r->marks;
}

/* The eye in the space of an entry's shape, or with w = 0 the way to it; 0, 0, 0, 0 where faces
   that look away are drawn too. */
static inline shade_vec4 renderer_eye_of(const renderer_view *v, const renderer_entry *e)
{
    const shade_vec4 back = v->place.col[2], none = { 0, 0, 0, 0 };
    const shade_vec4 eye = v->parallel ? shade_v4(back.x, back.y, back.z, 0)
                                       : shade_v4(v->eye.x, v->eye.y, v->eye.z, 1);
    if (e->key & RENDERER_KEY_TWO_SIDED) return none;
    if (shade_mat3_determinant(shade_mat3_from_mat4(e->world)) == 0) return none;
    return shade_mat4_transform(shade_mat4_inverse(e->world), eye);
}

/* Which of a packet of faces the eye may see.  Sums may be off by 1e-6 of what is in them: a face
   that is seen edge-on counts as seen, and shade_draw culls it. */
static inline void renderer_facing(const renderer_entry *e, shade_vec4 eye, int first,
                                   int *SHADE_RESTRICT seen)
{
    const size_t row = renderer_plane_row(e->shape);
    const float *n = e->shape->planes + first;
    const shade_vec4 *m = e->world.col;
    const float most = shade_length(shade_v3(eye.x, eye.y, eye.z)) +
                       eye.w * (shade_length(e->shape->centre) + e->shape->radius);
    const float lift = e->lift > 0 ? e->lift / shade_length(shade_v3(m[2].x, m[2].y, m[2].z)) : 0;
    const float slack = -1e-5f * (most + lift);
    SHADE_EACH_LANE(i)
    {
        const float z = n[2 * row + (size_t)i], up = z < 0 ? -z : z;
        const float away = n[3 * row + (size_t)i] + up * lift;
        const float toward = n[i] * eye.x + n[row + (size_t)i] * eye.y + z * eye.z;
        seen[i] = !(toward - away * eye.w < slack);
    }
}

/* Adds the faces of entry number j that may be seen, and its vertices, to those of a draw;
   returns how many triangles there are then.  Without a branch: whether a face is seen cannot be
   predicted. */
static inline int renderer_add_faces(renderer *r, const renderer_view *v, renderer_entry *e, int j,
                                     int triangles)
{
    const renderer_shape *s = e->shape;
    const int flip = shade_mat3_determinant(shade_mat3_from_mat4(e->world)) < 0;
    const int32_t id = v->p->objects[e->object].id;
    const uint32_t first = (uint32_t)e->first;
    const shade_vec4 eye = renderer_eye_of(v, e);
    int seen[SHADE_LANES], begin, count = renderer_range(v, e, &begin);
    for (int k = begin; k < begin + count; k++) {
        const uint32_t *from = s->indices + 3 * (size_t)k;
        uint32_t *to = r->indices + 3 * (size_t)triangles;
        if (k == begin || k % SHADE_LANES == 0) renderer_facing(e, eye, k - k % SHADE_LANES, seen);
        to[0] = first + from[0];
        to[1] = first + from[1 + flip];
        to[2] = first + from[2 - flip];
        r->owners[triangles] = (uint32_t)j;
        r->marks[triangles] = (renderer_mark){ id, k };
        triangles += seen[k % SHADE_LANES];
    }
    return triangles;
}

/* Takes normals of shapes to the world.  Those of stretched meshes and of ellipsoids must be made
   unit then; the others are turned alone, and keep their length. */
static inline shade_mat3 renderer_normals(const renderer_view *v, const renderer_entry *e)
{
    const renderer_object *o = &v->p->objects[e->object];
    const float *t = e->turn;
    shade_mat3 turn;
    for (int k = 0; k < 3; k++) turn.col[k] = shade_v3(t[k], t[3 + k], t[6 + k]);
    return e->uneven || o->size[0] < 0 ? shade_normal_matrix(e->world) : turn;
}

/* Puts the objects of a batch behind each other.  Returns the number of indices. */
static inline int renderer_join(renderer *r, const renderer_batch *b, renderer_entry *e, int count,
                                int *vertex_count)
{
    int vertices = 0, triangles = 0;
    for (int j = 0; j < count; j++) {
        e[j].first = vertices;
        vertices += e[j].shape->vertex_count;
        if (!b->v->shadows || b->holes) e[j].normal = renderer_normals(b->v, e + j);
        for (int k = e[j].first; k < vertices && b->several; k++) r->whose[k] = (uint32_t)j;
        triangles = renderer_add_faces(r, b->v, e + j, j, triangles);
    }
    *vertex_count = vertices;
    return 3 * triangles;
}

static inline int renderer_has_maps(const renderer_view *v, const renderer_entry *e)
{
    const renderer_object *o = &v->p->objects[e->object];
    return o->kind == RENDERER_MESH && e->shape->texcoords && (o->relief || o->glow_map);
}

/* A texture by 1 + its number; NULL: there is none, or it was taken away */
static inline const shade_texture *renderer_map_of(const renderer_scene *s, int number)
{
    return number && s->textures[number - 1].memory ? s->textures[number - 1].face : NULL;
}

/* Finds relief and glow of a draw, and the texture whose lod counts. */
static inline const shade_texture *renderer_find_maps(renderer_batch *b, const renderer_entry *e)
{
    const renderer_object *o = &b->v->p->objects[e->object];
    const shade_texture *known = b->texture && !b->texture->cube ? b->texture->face : NULL;
    b->relief = (relief){ .strength = o->strength, .repeat = o->repeat };
    b->glow_map = NULL;
    b->maps = 0;
    if (!b->lighting || !renderer_has_maps(b->v, e)) return known;
    b->relief.map = renderer_map_of(b->v->scene, o->relief);
    b->relief.indices = b->r->indices;
    b->relief.heights = o->flags & RENDERER_HEIGHTS;
    if (b->relief.map) b->relief.finer = texture_finer(b->relief.map, known);
    known = known ? known : b->relief.map;
    b->glow_map = renderer_map_of(b->v->scene, o->glow_map);
    if (b->glow_map) b->glow_finer = texture_finer(b->glow_map, known);
    b->mesh = (shade_mesh){ .positions = e->shape->positions, .texcoords = e->shape->texcoords };
    b->maps = 6 + (b->texture ? 3 : 0) + (b->colors ? 3 : 0);
    return known ? known : b->glow_map;
}

/* Draws entries of one key: several small ones, or a large one. */
static inline shade_result renderer_draw_batch(renderer *r, const shade_target *target,
                                               renderer_batch *b, renderer_entry *e, int count)
{
    const int key = e->key, texture = key / RENDERER_KEY_TEXTURE;
    shade_pipeline pipeline = { renderer_shade_vertices, renderer_shade, b, .varyings = 6 };
    int vertex_count, index_count;
    b->entry = e;
    b->holes = (key & RENDERER_KEY_HOLES) != 0;
    b->texture = (b->lighting || b->holes) && texture ? b->v->scene->textures + texture - 1 : NULL;
    if (b->texture && !b->texture->memory) b->texture = NULL; /* it was taken away */
    b->holes &= b->texture != NULL;
    b->uv = b->texture ? 6 : 0;
    b->colors = b->lighting && (key & RENDERER_KEY_COLORS) ? (b->texture ? 9 : 6) : 0;
    b->several = count > 1;
    b->two_sided = (key & RENDERER_KEY_TWO_SIDED) != 0;
    b->glossy = b->glows = b->metals = b->unlit = b->meshes = 0;
    for (int k = 0; k < count; k++) {
        const renderer_object *o = &b->v->p->objects[e[k].object];
        b->metals |= o->metal > 0 || o->tint > 0;
        b->glossy |= renderer_is_glossy(o) || o->metal > 0;
        b->glows |= renderer_glows(o);
        b->unlit |= (o->flags & RENDERER_UNLIT) != 0;
        b->meshes |= o->kind == RENDERER_MESH;
    }
    index_count = renderer_join(r, b, e, count, &vertex_count);
    pipeline.varyings += (b->texture ? 3 : 0) + (b->colors ? 3 : 0);
    pipeline.lod_texture = renderer_find_maps(b, e);
    if (b->maps) pipeline.varyings += 2;
    if (pipeline.lod_texture) pipeline.lod_varying = b->maps ? b->maps : b->uv;
    if (!b->holes && !b->lighting && !b->notes) pipeline.fragment = NULL;
    if (!pipeline.fragment) pipeline.varyings = 0;
    pipeline.may_discard = b->holes;
    if (!b->two_sided) pipeline.raster.cull = SHADE_CULL_BACK;
    if (!b->v->shadows) {
        pipeline.raster.depth_test = SHADE_COMPARE_GREATER;
        pipeline.raster.depth_zero_to_one = 1;
    }
    if (b->blended) {
        pipeline.raster.blend = SHADE_BLEND_OVER;
        pipeline.raster.depth_read_only = 1;
    }
    return shade_draw(target, &pipeline, r->indices, index_count, vertex_count, NULL);
}

/* Draws all entries in their order, as few draws as their keys and sizes allow. */
static inline shade_result renderer_draw_entries(renderer *r, const shade_target *target,
                                                 renderer_batch *b, int count)
{
    shade_result result = SHADE_OK;
    if (!renderer_room_for(r, b->v, r->entries, count)) return SHADE_ERROR_CAPACITY;
    for (int i = 0, n; i < count && !result; i += n) {
        renderer_entry *e = r->entries + i;
        for (n = 0; i + n < count; n++) {
            if (e[n].key != e->key) break;
            if (e[n].shape->vertex_count >= RENDERER_ALONE || renderer_has_maps(b->v, e + n)) break;
        }
        if (!n) n = 1;
        result = renderer_draw_batch(r, target, b, e, n);
    }
    return result;
}

/* ---- sky ------------------------------------------------------------------------------------- */

/* One triangle over the whole picture, at depth 0: only pixels without an object pass.  Varyings
   are the direction from the eye. */
static inline void renderer_sky_vertices(const void *uniforms,
                                         const shade_vertex_ids *SHADE_RESTRICT in,
                                         shade_vertices *SHADE_RESTRICT out)
{
    const renderer_view *v = (const renderer_view *)uniforms;
    const shade_vec4 *m = v->projection.col;
    SHADE_EACH_LANE(i)
    {
        const float x = in->index[i] == 1 ? 3.0f : -1.0f, y = in->index[i] == 2 ? 3.0f : -1.0f;
        shade_vec3 eye = shade_v3(0, 0, -1);
        if (!v->parallel) {
            eye.y = (y + m[2].y) / m[1].y;
            eye.x = (x + m[2].x - m[1].x * eye.y) / m[0].x;
        }
        lane_put4(out->clip[0], i, shade_v4(x, y, 0, 1));
        lane_put(out->varying[0], i, shade_mat4_transform_direction(v->place, eye));
    }
}

static inline void renderer_sky(const void *uniforms, const shade_fragments *SHADE_RESTRICT in,
                                shade_colors *SHADE_RESTRICT out)
{
    const renderer_view *v = (const renderer_view *)uniforms;
    const renderer_around *a = &v->scene->around;
    float d[3][SHADE_LANES];
    if (a->sky == RENDERER_SKY_CUBE) { /* +y of the cube is up, which is +z of the world */
        for (int i = 0; i < SHADE_LANES; i++) {
            const shade_vec3 at = lane(in->varying[0], i);
            lane_put(d[0], i, shade_v3(at.x, at.z, -at.y));
        }
        renderer_sample_cube(&v->scene->textures[a->sky_texture], d, out->color);
        return;
    }
    for (int i = 0; i < SHADE_LANES; i++) {
        const shade_vec3 at = shade_normalize(lane(in->varying[0], i));
        lane_put(out->color[0], i, shade_lerp(a->sky_low, a->sky_high, 0.5f + 0.5f * at.z));
    }
}

static inline shade_result renderer_draw_sky(const shade_target *target, const renderer_view *v)
{
    shade_pipeline pipeline = { renderer_sky_vertices, renderer_sky, v, .varyings = 3 };
    pipeline.raster.depth_test = SHADE_COMPARE_GREATER_EQUAL;
    pipeline.raster.depth_zero_to_one = 1;
    if (v->scene->around.sky == RENDERER_SKY_PLAIN) return SHADE_OK;
    return shade_draw(target, &pipeline, NULL, 3, 3, NULL);
}

/* ---- the shadow map -------------------------------------------------------------------------- */

/* The sphere around what casts shadows.  Its radius is 0 where nothing does. */
static inline float renderer_casters(const renderer_view *v, const renderer_picture *p,
                                     const renderer_scene *s, shade_vec3 *centre)
{
    renderer_entry e;
    shade_vec3 low = shade_v3(1e30f, 1e30f, 1e30f), high = shade_neg(low), at;
    for (int i = 0; i < p->object_count; i++) {
        const renderer_object *o = &p->objects[i];
        if ((o->flags & (RENDERER_HIDDEN | RENDERER_CASTS_NO_SHADOW)) || renderer_is_endless(o))
            continue;
        if (o->kind == RENDERER_PLANE) continue; /* a floor hides nothing that is seen */
        renderer_stand(v, o, &e);
        const float r = renderer_reach(s, o, &e, &at);
        low = shade_min(low, shade_sub(at, shade_v3(r, r, r)));
        high = shade_max(high, shade_add(at, shade_v3(r, r, r)));
    }
    *centre = shade_scale(shade_add(low, high), 0.5f);
    return low.x <= high.x ? 0.5f * shade_distance(low, high) : 0;
}

/* The sine of an angle of the first quadrant by its cosine, or the cosine by the sine */
static inline float renderer_sine(float c)
{
    double low = 0, high = 1; /* halved: no C library decides the bits */
    for (int k = 0; k < 60; k++) {
        const double middle = (low + high) / 2;
        if (middle * middle > 1 - (double)c * (double)c)
            high = middle;
        else
            low = middle;
    }
    return (float)low;
}

/* What a spot's map shows: its cone, or the sphere around what casts shadows where that is less.
   Returns the tangent of half the angle. */
static inline float renderer_aim_spot(const shade_light *lamp, shade_vec3 at, shade_vec3 centre,
                                      float reach, renderer_view *v, shade_vec3 *aim)
{
    const float cone = lamp->spot_cos_cutoff > 0.2f ? lamp->spot_cos_cutoff : 0.2f;
    const shade_vec3 way = shade_sub(centre, at);
    const float distance = shade_length(way), sine = reach / (distance > 0 ? distance : 1);
    v->far_z = distance + 4 * reach;
    v->near_z = 0.002f * v->far_z;
    *aim = shade_normalize(lamp->spot_direction);
    if (reach <= 0 || sine >= 1 || renderer_sine(sine) <= cone)
        return 1.02f * renderer_sine(cone) / cone;
    if (distance - reach > v->near_z) v->near_z = distance - reach;
    *aim = shade_normalize(way);
    return 1.02f * sine / renderer_sine(sine);
}

/* How far along the way of a lamp the finite planes reach, which its map shows and the sphere
   around what casts shadows does not: cut off at the far plane, they would be dark along that
   line. */
static inline float renderer_floors(const renderer_view *v, const renderer_picture *p,
                                    const renderer_scene *s, shade_vec3 at, shade_vec3 aim,
                                    float most)
{
    renderer_entry e;
    for (int i = 0; i < p->object_count; i++) {
        const renderer_object *o = &p->objects[i];
        shade_vec3 centre;
        if ((o->flags & (RENDERER_HIDDEN | RENDERER_CASTS_NO_SHADOW)) || renderer_is_endless(o))
            continue;
        if (o->kind != RENDERER_PLANE) continue;
        renderer_stand(v, o, &e);
        const float r = renderer_reach(s, o, &e, &centre);
        const float away = shade_dot(aim, shade_sub(centre, at)) + r;
        most = away > most ? away : most;
    }
    return most;
}

/* The view of the lamp: of a distant one the sphere around what casts shadows */
static inline renderer_view renderer_lamp_view(renderer_map *m, const renderer_picture *p,
                                               const renderer_scene *s, const double *origin)
{
    const shade_light *lamp = &m->lamp;
    renderer_view v = { .p = p, .scene = s, .shadows = 1 };
    memcpy(v.origin, origin, sizeof v.origin);
    shade_vec3 centre, aim, at = shade_v3(lamp->position.x, lamp->position.y, lamp->position.z);
    const float reach = 1.01f * renderer_casters(&v, p, s, &centre), size = (float)m->size;
    if (lamp->position.w == 0) {
        aim = shade_neg(shade_normalize(at));
        at = shade_madd(centre, -2 * reach, aim);
        v.near_z = 0.5f * reach;
        v.far_z = renderer_floors(&v, p, s, at, aim, 3.5f * reach);
        v.parallel = 1;
        v.projection = shade_mat4_ortho(-reach, reach, -reach, reach, v.near_z, v.far_z);
        v.scale = 0.5f * size / reach;
    } else {
        const float tangent = renderer_aim_spot(lamp, at, centre, reach, &v, &aim);
        const float half = tangent * v.near_z;
        v.far_z = renderer_floors(&v, p, s, at, aim, v.far_z);
        v.projection = shade_mat4_frustum(-half, half, -half, half, v.near_z, v.far_z);
        v.scale = 0.5f * size / tangent;
    }
    v.view = shade_mat4_look_at(at, shade_add(at, aim), shade_v3(0, 0, 1));
    renderer_aim(&v);
    m->from_world = v.clip;
    m->texel = v.parallel ? 2 * reach / size : 0;
    m->texel_slope = v.parallel ? 0 : 1 / v.scale;
    m->axis = shade_v4(aim.x, aim.y, aim.z, -shade_dot(aim, at));
    return v;
}

/* Two texels for a row of the picture, or more, as a power of two */
static inline int renderer_map_size(const renderer_picture *p)
{
    int size = 128;
    while (size < 2 * p->height && size < 2048) size *= 2;
    return size;
}

/* Whether the maps are of these objects; else they are noted.  -1: out of memory */
static inline int renderer_is_known(renderer *r, const renderer_picture *p, const renderer_scene *s,
                                    const double *origin)
{
    const size_t bytes = (size_t)p->object_count * sizeof *p->objects;
    if (r->known && r->known_count == p->object_count && r->known_tolerance == p->tolerance &&
        r->known_serial == s->serial && r->known_version == s->version &&
        !memcmp(r->known_origin, origin, sizeof r->known_origin) &&
        (!bytes || !memcmp(r->known, p->objects, bytes)))
        return 1;
    r->known = (renderer_object *)renderer_room(r->known, &r->room[4], bytes + 1);
    if (!r->known) return -1;
    if (bytes) memcpy(r->known, p->objects, bytes);
    r->known_count = p->object_count;
    r->known_tolerance = p->tolerance;
    r->known_serial = s->serial;
    r->known_version = s->version;
    memcpy(r->known_origin, origin, sizeof r->known_origin);
    return 0;
}

static inline shade_result renderer_draw_map(renderer *r, renderer_map *m,
                                             const renderer_picture *p, const renderer_scene *s,
                                             const double *origin)
{
    const renderer_view v = renderer_lamp_view(m, p, s, origin);
    const shade_target target = { .width = m->size, .height = m->size, .depth = m->depth };
    renderer_batch b = { .r = r, .v = &v };
    shade_result result = shade_clear(&target, shade_v4(0, 0, 0, 0), 1);
    const int count = renderer_gather(r, &v, 0);
    if (!result && v.far_z > 0) result = renderer_draw_entries(r, &target, &b, count);
    return result;
}

/* Draws the maps anew of which an object or the lamp has changed since they were drawn. */
static inline shade_result renderer_cast(renderer *r, const renderer_view *v)
{
    const renderer_picture *p = v->p;
    const renderer_around *around = &v->scene->around;
    const int size = renderer_map_size(p), known = renderer_is_known(r, p, v->scene, v->origin);
    shade_result result = known < 0 ? SHADE_ERROR_CAPACITY : SHADE_OK;
    for (int k = 0; k < RENDERER_LAMPS && known < 1; k++) r->map[k].valid = 0;
    for (int k = 0; k < around->light_count && !result; k++) {
        renderer_map *m = &r->map[k];
        if (!(around->shadows >> k & 1)) continue;
        if (m->valid && m->size == size && !memcmp(&m->lamp, &v->lights[k], sizeof m->lamp))
            continue;
        m->valid = 0;
        m->size = size;
        m->lamp = v->lights[k];
        m->depth = (float *)renderer_room(m->depth, &m->room, 4 * (size_t)size * (size_t)size);
        result = m->depth ? renderer_draw_map(r, m, p, v->scene, v->origin) : SHADE_ERROR_CAPACITY;
        m->valid = !result;
    }
    return result;
}

/* ---- pictures -------------------------------------------------------------------------------- */

/* Depth of the buffer, 1 at near to 0 at far, to distances along the axis of view */
static inline void renderer_distances(const renderer_picture *p, const float *z, float *depth)
{
    const size_t pixels = (size_t)p->width * (size_t)p->height;
    const int endless = p->far_z >= 1e30f, parallel = p->parallel;
    const float n = p->near_z, far_z = p->far_z, span = far_z - n, nf = endless ? n : n * far_z;
    const float base = endless ? 0 : n, slope = endless ? 1 : span, empty = p->empty_depth;
    for (size_t i = 0; i < pixels; i += SHADE_LANES) {
        const size_t left = pixels - i, count = left < SHADE_LANES ? left : SHADE_LANES;
        float from[SHADE_LANES] = { 0 }, to[SHADE_LANES];
        int32_t seen[SHADE_LANES] = { 0 }; /* the bits: integers are compared by lanes */
        memcpy(from, z + i, count * sizeof *z);
        memcpy(seen, z + i, count * sizeof *z);
        SHADE_EACH_LANE(k) { to[k] = nf / (base + from[k] * slope); }
        if (parallel) SHADE_EACH_LANE(k)
            {
                to[k] = far_z - from[k] * span;
            }
        SHADE_EACH_LANE(k) { to[k] = seen[k] > 0 ? to[k] : empty; }
        memcpy(depth + i, to, count * sizeof *to);
    }
}

/* Leaves alpha out.  Of all pixels but the last four bytes are written, the last of which the
   next pixel covers: that is twice as fast as byte by byte. */
static inline void renderer_pack(uint8_t *to, const uint8_t *from, size_t pixels)
{
    for (size_t i = 0; i + 1 < pixels; i++) memcpy(to + 3 * i, from + 4 * i, 4);
    if (pixels) memcpy(to + 3 * (pixels - 1), from + 4 * (pixels - 1), 3);
}

static inline void renderer_clear_notes(const renderer_picture *p)
{
    const size_t pixels = (size_t)p->width * (size_t)p->height;
    if (p->ids) memset(p->ids, 255, 2 * pixels * sizeof *p->ids);
    if (p->normals) memset(p->normals, 0, 3 * pixels * sizeof *p->normals);
}

static inline shade_result renderer_draw_objects(renderer *r, const shade_target *target,
                                                 const renderer_view *v,
                                                 const shade_lighting *lighting, int notes)
{
    renderer_batch b = { .r = r, .v = v, .lighting = lighting, .notes = notes };
    shade_result result = shade_clear(target, v->scene->around.background, 0);
    if (!result) result = renderer_draw_entries(r, target, &b, renderer_gather(r, v, 0));
    if (!result && lighting) result = renderer_draw_sky(target, v);
    if (result || !lighting) return result;
    b.blended = 1;
    b.notes = 0;
    return renderer_draw_entries(r, target, &b, renderer_gather(r, v, 1));
}

/* Colours, of which a pixel has several samples */
static inline shade_result renderer_draw_large(renderer *r, const shade_target *small,
                                               const renderer_view *v,
                                               const shade_lighting *lighting)
{
    const int n = v->p->samples;
    const size_t bytes = 4 * (size_t)(n * n) * (size_t)v->p->width * (size_t)v->p->height;
    shade_target large = *small;
    shade_result result;
    r->large_color = (uint32_t *)renderer_room(r->large_color, &r->room[5], bytes);
    r->large_depth = (float *)renderer_room(r->large_depth, &r->room[6], bytes);
    if (!r->large_color || !r->large_depth) return SHADE_ERROR_CAPACITY;
    large.width *= n;
    large.height *= n;
    large.color = r->large_color;
    large.depth = r->large_depth;
    result = renderer_draw_objects(r, &large, v, lighting, 0);
    return result ? result : shade_resolve(small, &large, n);
}

/* Lamps with places count from the origin of the view. */
static inline void renderer_near_lights(renderer_view *v, shade_light *to)
{
    const renderer_around *a = &v->scene->around;
    for (int k = 0; k < a->light_count; k++) {
        shade_vec4 *at = &to[k].position;
        to[k] = a->lights[k];
        if (at->w == 0) continue;
        at->x = (float)(a->places[k][0] - (double)at->w * v->origin[0]);
        at->y = (float)(a->places[k][1] - (double)at->w * v->origin[1]);
        at->z = (float)(a->places[k][2] - (double)at->w * v->origin[2]);
    }
    v->lights = to;
}

/* Draws a picture.  Its arrays are complete when the result is SHADE_OK; else those that were
   begun may hold anything.  Numbers of meshes, textures and lamps must be good: the bindings
   check. */
static inline shade_result renderer_draw_one(renderer *r, const renderer_scene *s,
                                             const renderer_picture *p)
{
    const renderer_around *around = &s->around;
    const size_t pixels = (size_t)p->width * (size_t)p->height;
    const int notes = p->ids || p->normals, large = p->color && p->samples > 1;
    const size_t objects = (size_t)p->object_count;
    shade_light lights[RENDERER_LAMPS];
    shade_lighting lighting = { .lights = lights, .light_count = around->light_count };
    const shade_lighting *lit = p->color && !large ? &lighting : NULL;
    shade_target target = { .width = p->width, .height = p->height, .srgb = p->srgb };
    renderer_view v = renderer_view_of(p, s);
    shade_result result = SHADE_OK;
    renderer_near_lights(&v, lights);
    lighting.ambient = around->ambient;
    lighting.flags = p->parallel ? SHADE_FLAG_INFINITE_VIEWER : 0;
    r->entries = (renderer_entry *)renderer_room(r->entries, &r->room[0],
                                                 (objects + 1) * sizeof *r->entries);
    r->depth = (float *)renderer_room(r->depth, &r->room[7], pixels * sizeof(float));
    r->color = (uint32_t *)renderer_room(r->color, &r->room[8], pixels * sizeof(uint32_t));
    if (!r->entries || !r->depth || !r->color) return SHADE_ERROR_CAPACITY;
    target.depth = r->depth;
    target.color = p->color && p->channels == 4 ? (void *)p->color : (void *)r->color;
    if (p->color && around->shadows) result = renderer_cast(r, &v);
    if (!result) renderer_clear_notes(p);
    if (!result && large) result = renderer_draw_large(r, &target, &v, &lighting);
    if (p->color && p->channels == 3 && large)
        renderer_pack(p->color, (const uint8_t *)r->color, pixels);
    if (large) target.color = notes ? (void *)r->color : NULL;
    if (!p->color && !notes) target.color = NULL;
    if (!result && (!large || notes || p->depth))
        result = renderer_draw_objects(r, &target, &v, lit, notes);
    if (p->color && p->channels == 3 && !large)
        renderer_pack(p->color, (const uint8_t *)r->color, pixels);
    if (!result && p->depth) renderer_distances(p, r->depth, p->depth);
    return result;
}

/* Pictures of one scene, which renderers draw in shares, each by a thread of its own */
typedef struct renderer_work {
    renderer *const *r;
    const renderer_scene *scene;
    const renderer_picture *pictures;
    int shares, count;
    shade_result results[BANDS_MOST];
    const volatile int *stop;
} renderer_work;

/* The objects that a picture shows: those that it brings, or the scene's, moved where it has
   poses */
static inline shade_result renderer_shown(renderer *r, const renderer_scene *s, renderer_picture *p)
{
    const size_t bytes = (size_t)s->object_count * sizeof *s->objects;
    if (p->objects) return SHADE_OK;
    p->objects = s->objects;
    p->object_count = s->object_count;
    if (!p->poses) return SHADE_OK;
    r->moved = (renderer_object *)renderer_room(r->moved, &r->room[10], bytes + 1);
    if (!r->moved) return SHADE_ERROR_CAPACITY;
    if (bytes) memcpy(r->moved, s->objects, bytes);
    p->objects = r->moved;
    if (renderer_move_all(r->moved, s->object_count, p->poses, p->pose_count) != p->pose_count)
        return SHADE_ERROR_ARGUMENT;
    return SHADE_OK;
}

static inline void renderer_draw_share(void *data, int share)
{
    renderer_work *w = (renderer_work *)data;
    const long long count = w->count;
    const int end = (int)(count * (share + 1) / w->shares);
    shade_result result = SHADE_OK;
    for (int i = (int)(count * share / w->shares); i < end && !result; i++) {
        renderer_picture p = w->pictures[i];
        if (w->stop && *w->stop) return;
        result = renderer_shown(w->r[share], w->scene, &p);
        if (!result) result = renderer_draw_one(w->r[share], w->scene, &p);
    }
    w->results[share] = result;
}

/* Draws pictures by at most BANDS_MOST renderers, in equal shares, all of the scene as it is now.
   Pictures without objects show those of the scene: SHADE_ERROR_ARGUMENT where they have poses
   for another number of objects than there are now.  Once *stop is set, which may be NULL, the
   rest is left out. */
static inline shade_result renderer_draw(renderer *const *r, int renderers, const renderer_scene *s,
                                         const renderer_picture *pictures, int count,
                                         const volatile int *stop)
{
    renderer_scene now = renderer_snapshot(s);
    renderer_work w = { r, &now, pictures, renderers, count, { SHADE_OK }, stop };
    if (renderers == 1)
        renderer_draw_share(&w, 0);
    else
        bands_run(renderers, renderers, renderer_draw_share, &w);
    renderer_lock();
    renderer_let_go(&now);
    renderer_unlock();
    for (int i = 0; i < renderers; i++)
        if (w.results[i]) return w.results[i];
    return SHADE_OK;
}
#endif
