/* model.h - the contents of a model file: one mesh, whose triangles are sorted into parts of one
   surface each, and the surfaces. */
#ifndef MODEL_MODEL_H
#define MODEL_MODEL_H

#include "../draw/wires.h"
#include "zip.h"

/* Larger files are refused. */
#define MODEL_BYTES 4e9
#define MODEL_PICTURE_BYTES 5e8
#define MODEL_LIBRARY_BYTES 1e8

enum { PICTURE_COLORS, PICTURE_RELIEF, PICTURE_POLISH };
typedef struct model_picture { /* a texture that owns its pixels and mipmaps */
    shade_texture map;         /* pixels NULL: it could not be read */
    char *name, *path;         /* in the file; where it was found, or NULL */
    unsigned char *bytes;      /* PNG or another format, until it is decoded; NULL: none */
    char kind[24];             /* of the bytes, as image/png; "": the file does not say */
    size_t size;
    int what;            /* it shows: colours; a bump or normal map; roughness in green and
                            metal in blue */
    int heights;         /* a bump map, and the mean square of the slopes of its heights, */
    double slope_square; /* which go from 0 to 1, in pictures whose edges are 1 long */
    void *pixels, *mipmaps;
    shade_texture level[15];
} model_picture;

/* Builds the mipmaps of a texture.  Texels that are to be seen as squares stay so; in pictures of
   more than 512 they are smaller than pixels. */
static inline shade_result texture_levels(shade_texture *map, shade_texture *levels, void *memory,
                                          size_t bytes, int squares)
{
    map->filter = SHADE_FILTER_NEAREST;
    if (squares && map->width <= 512 && map->height <= 512) return SHADE_OK;
    map->filter = SHADE_FILTER_TRILINEAR;
    return shade_build_mipmaps(map, levels, memory, bytes);
}

/* A bump map, whose brightness is height, or a normal map: its picture tells which. */
typedef struct model_relief {
    char *map;      /* its name in the file; NULL: none */
    int picture;    /* -1: none */
    float strength; /* a factor of the slope, or the height of white above black in the units of
                       the positions; 0: the file does not say */
} model_relief;

typedef struct model_surface {
    char *name, *map;        /* names in the file; map: the picture for k_d, or NULL */
    shade_material material; /* linear light */
    float transparency, alpha_cutoff;
    shade_vec3 shine;    /* k_s of a smooth surface that is no metal, before model_rough */
    float metal, rough;  /* of physically based materials; rough 0: by the shininess */
    int unlit;           /* no lamp changes its colour, k_d */
    int set;             /* 0: the file says nothing about it */
    int section;         /* it is the cut of a section */
    int opaque, blended; /* the alpha of the map is ignored; is blended by */
    int picture;         /* the map, once it is read; -1: none */
    unsigned texcoords;  /* which of several sets in the file all pictures use */
    model_relief relief;
    float move[4];  /* of texture coordinates with v upward: added, and the factors before that */
    char *glow_map; /* the picture of what shines by itself, or NULL; its number, its factor */
    int glow_picture;
    shade_vec3 glow;
    int polish; /* the picture of metal and roughness, which are its factors; -1: none */
} model_surface;

typedef struct model_part {
    int first, count, surface;    /* of the indices */
    int first_chunk, chunk_count; /* of the chunks, whose triangles count from first on */
} model_part;

/* A line of a file, in the coordinates of its mesh */
typedef struct model_line {
    shade_vec3 end[2], color; /* color: a factor, linear */
    int surface;              /* -1: none */
} model_line;

/* Loads a file of at most so many bytes that the model of a path names: its bytes and where it was,
   both to be freed.  Returns non-zero with a line in error. */
typedef int model_load_beside(const char *path, const char *name, double most,
                              unsigned char **bytes, size_t *size, char **where, char *error,
                              size_t room);

/* Zeroed: empty. */
typedef struct model {
    owned_mesh mesh; /* its chunks are those of the parts, one after the other, not of its view */
    model_surface *surface; /* NULL: the file has no surfaces */
    model_part *part;
    model_picture *picture;
    model_line *line;
    size_t line_count, line_room, lines_dropped;
    wires wires;    /* the lines, once the model is prepared */
    char **library; /* files that describe the surfaces */
    int surface_count, part_count, picture_count, library_count;
    size_t surface_room, picture_room, library_room;
    char **object_name; /* what the file calls objects, groups or nodes */
    uint32_t *object;   /* of each triangle as the file was read; NULL: the file names none */
    int object_count;
    size_t object_room;
    int normals_given;         /* each vertex had a normal in the file */
    int physical;              /* its surfaces are those of glTF: metal and roughness */
    int z_up, up_told;         /* up_told: by the format, not by habit */
    int up;                    /* 1 + the upright axis, 0 .. 5, once it is settled; 0: not yet */
    double origin[3];          /* of the positions, in the coordinates of the file */
    int placed, points_wanted; /* said to the reader: the origin; points stay points */
    int polish_wanted;         /* said to the reader: pictures of metal and roughness count */
    int lines_wanted;          /* said to the reader: it has lines, and they are not left out */
    const char *path;          /* of its file, and what loads a file beside it; NULL: nothing */
    model_load_beside *beside;
    zip_inflate *inflate; /* what unpacks files of archives; NULL: nothing */
    int movable;          /* the file has more digits than floats: read again, about another
                                  origin, the positions are more exact */
    char unread[200];     /* names of what is left out, with commas between (known.h) */
    char warning[900];    /* what the picture lacks or shows otherwise than the file; "": nothing */
    size_t warned;        /* where the last line of the warning begins, with whom it is about */
    int warned_more;      /* there was more than fits into the warning, which says so at its end */
} model;

static inline void model_free(model *m)
{
    static const model empty;
    mesh_free(&m->mesh);
    for (int i = 0; i < m->surface_count; i++) {
        free(m->surface[i].name);
        free(m->surface[i].map);
        free(m->surface[i].relief.map);
        free(m->surface[i].glow_map);
    }
    for (int i = 0; i < m->library_count; i++) free(m->library[i]);
    for (int i = 0; i < m->object_count; i++) free(m->object_name[i]);
    free(m->object_name);
    free(m->object);
    for (int i = 0; i < m->picture_count; i++) {
        free(m->picture[i].name);
        free(m->picture[i].path);
        free(m->picture[i].bytes);
        free(m->picture[i].pixels);
        free(m->picture[i].mipmaps);
    }
    free(m->surface);
    free(m->part);
    free(m->picture);
    free(m->line);
    wires_free(&m->wires);
    free(m->library);
    *m = empty;
}

/* Part i as a mesh of its own, with its chunks */
static inline shade_mesh model_part_mesh(const model *m, int i)
{
    const model_part *part = &m->part[i];
    shade_mesh mesh = m->mesh.view;
    mesh.indices = m->mesh.indices + part->first;
    mesh.index_count = part->count;
    if (m->mesh.chunks) mesh.chunks = m->mesh.chunks + part->first_chunk;
    mesh.chunk_count = m->mesh.chunks ? part->chunk_count : 0;
    return mesh;
}

/* 1: the part is the cut of a section. */
static inline int model_is_section(const model *m, int part)
{
    return m->surface_count && m->surface[m->part[part].surface].section;
}

/* Adds a statement to the warning, once, or that there are more where it does not fit. */
static inline void model_warn(model *m, const char *about, const char *what)
{
    static const char more[] = "; and more";
    const size_t there = strlen(m->warning), room = sizeof m->warning - sizeof more + 1;
    const size_t n = strlen(about);
    const char *last = m->warning + m->warned, *before = there ? "; " : "";
    const int same = there && !strncmp(last, about, n) && last[n] == ':';
    if (m->warned_more || (same && strstr(last, what))) return;
    m->warned_more = there && there + (same ? 0 : n) + strlen(what) + 5 >= room;
    if (m->warned_more) {
        memcpy(m->warning + there, more, sizeof more);
        return;
    }
    if (!same) m->warned = there + strlen(before);
    snprintf(m->warning + there, room - there, "%s%s%s%s", before, same ? "" : about,
             same ? "" : ": ", what);
    mesh_plain(m->warning + there);
}

/* The same of what is left out */
static inline void model_leave_out(model *m, const char *about, const char *what)
{
    char text[400];
    snprintf(text, sizeof text, "%.380s (left out)", what);
    model_warn(m, about, text);
}

/* Warns of what is left out because it has a position that is not finite. */
static inline void model_warn_dropped(model *m, const char *about, size_t n, const char *what)
{
    char text[80];
    if (!n) return;
    snprintf(text, sizeof text, "%lu %s that are no finite numbers", (unsigned long)n, what);
    model_leave_out(m, about, text);
}

/* The origin that a reader begins with */
static inline void model_place(const model *m, mesh_origin *o)
{
    memcpy(o->at, m->origin, sizeof o->at);
    o->known = m->placed;
}

/* The origin that it has used; known: it has used one at all */
static inline void model_placed(model *m, const mesh_origin *o)
{
    memcpy(m->origin, o->at, sizeof o->at);
    m->movable = o->known;
}

/* Positions that are not finite, which no face has, become 0. */
static inline void mesh_tame(owned_mesh *m, size_t vertices)
{
    for (size_t i = 0; i < vertices; i++)
        if (!mesh_finite(m->positions + 3 * i)) memset(m->positions + 3 * i, 0, 12);
}

/* A copy of n bytes as text; NULL: out of memory */
static inline char *model_text(const void *bytes, size_t n)
{
    char *text = (char *)malloc(n + 1);
    if (!text) return NULL;
    if (n) memcpy(text, bytes, n);
    text[n] = 0;
    return text;
}

/* The same of a file's name, without the quotes that some programs put around it */
static inline char *model_file_name(const unsigned char *name, size_t n)
{
    const size_t quote = n > 2 && name[0] == '"' && name[n - 1] == '"';
    return model_text(name + quote, n - 2 * quote);
}

/* The roughness whose highlight is as wide as that of an exponent; 1 without a highlight */
static inline float model_roughness(float shininess)
{
    return sqrtf(sqrtf(2 / (2 + fmaxf(0, shininess))));
}

/* A material of metal and roughness, with its base colour in diffuse.  Metal has its colour in the
   highlight and the reflection; the studio is too plain to mirror alone, so that part of it stays
   diffuse.  Roughness r becomes the exponent of a lobe as wide, 2 / r^4 - 2, and rough highlights
   dim. */
#define MODEL_METAL_DARK 0.55f
static inline void model_rough(model_surface *s, float metal, float rough)
{
    shade_material *k = &s->material;
    const shade_vec3 base = k->diffuse;
    float square, gloss;
    metal = fminf(1, fmaxf(0, metal));
    rough = fminf(1, fmaxf(0.2f, rough));
    square = rough * rough;
    gloss = (1 - rough) * (1 - 0.5f * rough);
    k->specular = shade_scale(shade_lerp(s->shine, base, metal), gloss);
    k->diffuse = k->ambient = shade_scale(base, 1 - MODEL_METAL_DARK * metal);
    s->metal = metal;
    s->rough = rough;
    k->shininess = fmaxf(1, 2 / (square * square) - 2);
}

/* The same once more, with factors of what model_rough was given */
static inline void model_polish(model_surface *s, float metal, float rough)
{
    shade_vec3 *k = &s->material.diffuse;
    *k = shade_scale(*k, 1 / (1 - MODEL_METAL_DARK * s->metal));
    model_rough(s, s->metal * metal, s->rough * rough);
}

/* A picture replaces black, as some programs leave the colour beside one. */
static inline void model_show_map(model_surface *s)
{
    shade_material *k = &s->material;
    if (s->map && k->diffuse.x + k->diffuse.y + k->diffuse.z <= 0)
        k->diffuse = k->ambient = shade_v3(1, 1, 1);
}

/* Where there is a picture of what shines, the colour of emission is its factor.  Files that are
   not exact leave that colour black. */
static inline void model_glow(model_surface *s, int exact)
{
    shade_vec3 *e = &s->material.emission;
    if (!s->glow_map) return;
    s->glow = !exact && e->x + e->y + e->z <= 0 ? shade_v3(1, 1, 1) : *e;
    *e = shade_v3(0, 0, 0);
}

/* Adds a surface, 60 % grey without highlight, and returns its number.  -1: out of memory */
static inline int model_add_surface(model *m, const void *name, size_t n)
{
    static const model_surface fresh = { .material = { .ambient = { 0.32f, 0.32f, 0.32f },
                                                       .diffuse = { 0.32f, 0.32f, 0.32f } },
                                         .shine = { 0.25f, 0.25f, 0.25f },
                                         .picture = -1,
                                         .move = { 0, 0, 1, 1 },
                                         .relief = { .picture = -1 },
                                         .glow_picture = -1,
                                         .polish = -1 };
    model_surface *grown = (model_surface *)mesh_grow(m->surface, (size_t)m->surface_count,
                                                      &m->surface_room, sizeof *grown);
    if (!grown) return -1;
    m->surface = grown;
    grown[m->surface_count] = fresh;
    grown[m->surface_count].name = model_text(name, n);
    return grown[m->surface_count].name ? m->surface_count++ : -1;
}

/* The surface of that name, added if new.  -1: out of memory, or MODEL_SURFACES of them */
enum { MODEL_SURFACES = 10000 };
static inline int model_find_surface(model *m, const void *name, size_t n, int add)
{
    for (int i = m->surface_count - 1; i >= 0; i--)
        if (strlen(m->surface[i].name) == n && !memcmp(m->surface[i].name, name, n)) return i;
    return add && m->surface_count < MODEL_SURFACES ? model_add_surface(m, name, n) : -1;
}

/* The number of the picture of that name and kind; -1: there is none */
static inline int picture_find(const model *m, const char *name, int what)
{
    for (int i = 0; i < m->picture_count; i++)
        if (m->picture[i].what == what && !strcmp(m->picture[i].name, name)) return i;
    return -1;
}

/* The number of a new picture without pixels, or -1: out of memory */
static inline int picture_add(model *m, const char *name, int what)
{
    static const model_picture empty;
    model_picture *grown = (model_picture *)mesh_grow(m->picture, (size_t)m->picture_count,
                                                      &m->picture_room, sizeof *grown);
    if (!grown) return -1;
    m->picture = grown;
    grown[m->picture_count] = empty;
    grown[m->picture_count].what = what;
    grown[m->picture_count].name = model_text(name, strlen(name));
    return grown[m->picture_count].name ? m->picture_count++ : -1;
}

/* Adds an object and returns its number; beyond MODEL_SURFACES of them all are the last.  -1: out
   of memory. */
static inline int model_add_object(model *m, const void *name, size_t n)
{
    char **grown;
    if (m->object_count >= MODEL_SURFACES) return m->object_count - 1;
    grown =
        (char **)mesh_grow(m->object_name, (size_t)m->object_count, &m->object_room, sizeof *grown);
    if (!grown) return -1;
    m->object_name = grown;
    grown[m->object_count] = model_text(name, n);
    return grown[m->object_count] ? m->object_count++ : -1;
}

/* The object of that name, added if new */
static inline int model_find_object(model *m, const void *name, size_t n)
{
    for (int i = m->object_count - 1; i >= 0; i--)
        if (strlen(m->object_name[i]) == n && !memcmp(m->object_name[i], name, n)) return i;
    return model_add_object(m, name, n);
}

/* Adds a line, or counts it where an end is not finite.  1: out of memory */
static inline int model_add_line(model *m, const float *a, const float *b, shade_vec3 color,
                                 int surface)
{
    const model_line line = { { shade_v3(a[0], a[1], a[2]), shade_v3(b[0], b[1], b[2]) },
                              color,
                              surface };
    model_line *grown =
        (model_line *)mesh_grow(m->line, m->line_count, &m->line_room, sizeof *grown);
    if (!grown || m->line_count >= INT_MAX / 8) return 1;
    m->line = grown;
    if (mesh_finite(a) && mesh_finite(b))
        grown[m->line_count++] = line;
    else
        m->lines_dropped++;
    return 0;
}

static inline int model_add_library(model *m, const unsigned char *name, size_t n)
{
    char **grown =
        (char **)mesh_grow(m->library, (size_t)m->library_count, &m->library_room, sizeof *grown);
    if (!grown) return 1;
    m->library = grown;
    grown[m->library_count] = model_file_name(name, n);
    return !grown[m->library_count++];
}

/* 1: the name is that of a file in the model's folder or below. */
static inline int model_is_beside(const char *name)
{
    if (!*name || *name == '/' || *name == '\\' || strchr(name, ':')) return 0;
    for (const char *at = name; *at; at++) {
        const int first = at == name || at[-1] == '/' || at[-1] == '\\';
        if (first && at[0] == '.' && at[1] == '.' && (!at[2] || at[2] == '/' || at[2] == '\\'))
            return 0;
    }
    return 1;
}

/* The path of the file called name in the folder of path; NULL: out of memory */
static inline char *model_beside(const char *path, const char *name)
{
    size_t folder = 0, n = strlen(name);
    char *beside;
    for (size_t i = 0; path[i]; i++)
        if (path[i] == '/') folder = i + 1;
    if (name[0] == '/') folder = 0;
    beside = (char *)malloc(folder + n + 1);
    if (!beside) return NULL;
    memcpy(beside, path, folder);
    for (size_t i = 0; i <= n; i++) beside[folder + i] = (char)(name[i] == '\\' ? '/' : name[i]);
    return beside;
}
#endif
