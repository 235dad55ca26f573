/* shade.h - classic local shading and an exact z-buffer rasterizer in one C99 file
   Public domain or MIT, whichever you prefer: both texts stand at the end of the file.

   shade.h computes emission, ambient, Lambert, Phong and Blinn-Phong light ("iteration four" of the
   graphics courses) over any number of directional, point and spot lights.  It has the vector and
   matrix maths that this needs, and a small, fast triangle rasterizer with vertex and fragment
   shaders that displays the result.  It allocates nothing, keeps no state, starts no threads and
   draws into memory that you own.  Every compiler and processor produces the same pixels, to the
   bit, because all arithmetic is IEEE single and double precision and is never contracted.
   Compile your own shaders with -ffp-contract=off (>>plumbing, "Fast math").

   To use it, write in exactly one C or C++ file

       #define SHADE_IMPLEMENTATION
       #include "shade.h"

   and include it everywhere else without the define.  Link with -lm on systems that need it (only
   sqrtf is used; see SHADE_NO_LIBM).  A whole program:

       #include <stdio.h>
       static uint32_t pixels[480 * 640];  static float depth[480 * 640];
       static shade_target target;  static shade_mesh mesh;  static shade_draw_state state;

       int main(void) {
           static const float corner[] = { -1, -1, 0,   1, -1, 0,   0, 1, 0 };
           shade_light sun = shade_directional_light(shade_v3(0, 0, -1), shade_v3(1, 0.8f, 0.5f));
           shade_stats stats;
           target.width = 640;
           target.height = 480;
           target.color = pixels;
           target.depth = depth;
           mesh.positions = corner;
           mesh.vertex_count = 3;
           state.projection = shade_mat4_perspective(1, 640 / 480.0f, 0.1f, 10);
           state.view = shade_mat4_look_at(shade_v3(0, 0, 3), shade_v3(0, 0, 0), shade_v3(0, 1, 0));
           state.lighting.lights = &sun;
           state.lighting.light_count = 1;
           shade_clear(&target, shade_v4(0.1f, 0.1f, 0.2f, 1), 1);
           shade_draw_mesh(&target, &mesh, &state, &stats);
           puts(shade_explain(&target, &mesh, &state, &stats));
           return shade_write_ppm("triangle.ppm", &target) != SHADE_OK;
       }

   It does not open windows, parse model files or emulate OpenGL, and it has no shadows,
   reflections or physically based materials.                                            >>about

   >>contents
     The number is the line of a section's banner.  In a banner, in and out are the input and the
     output, holds is an invariant, and the tag at the end names the next section.  way is the order
     of calls, in names without shade__; steps between are left out.  For example, "a: b, c; d"
     means that a leads to b, then to c, and that d follows a.  Callees stand above their callers:
     read a section from its end upward, along its way.
     About
       >>about  >>contents  >>conventions  >>model
     Public
       >>config     136  options               >>types      270  materials, targets, states
       >>light      462  the equation, colour  >>draw       571  shaders, meshes, pixels
       >>tools      732  explain, lines, rays  >>plumbing   962  compilers, flags and bits
       >>math      1130  vectors and matrices
     Inside: the vocabulary of the rest
       >>machine   1500  processors            >>base      1747  bits, masks, rows of vectors
       >>matrix    1945  cameras, inverses     >>power     2233  x^n
       >>pixels    2299  formats, sRGB
     Inside: light
       >>lamps     2613  attenuation, cones    >>terms     2865  one term at one point
       >>surface   2940  material and lights   >>lit       3057  the whole sum, at many points
     Inside: the way of a triangle
       >>state     3447  fields by owner       >>vertices  3661  shading, projection
       >>triangles 3863  culling, edge setup   >>clip      4217  near, far, guard band
       >>tiles     4404  edges and depth test  >>cover     4767  triangles, tile by tile
       >>fragments 5035  interpolation, lod    >>texels    5311  where they lie, loads
       >>texture   5500  filters, mipmaps      >>store     5795  blending, packing
     Inside: calls of the renderer
       >>check     6078  refusals              >>seen      6338  view volume, chunks
       >>drive     6458  shade_draw            >>mesh      6650  shade_draw_mesh
     Inside: the tools, which call the renderer; it never calls them
       >>lines     7055  shade_draw_lines      >>camera    7249  eye and line of sight
       >>normals   7343  of vertices, corners  >>shape     7732  edges, boxes, views
       >>chunks    7898  sorting and boxes     >>rays      8061  shade_pick
       >>image     8252  smaller, mipmaps      >>files     8580  PPM and PNG
       >>presets   8900  classic materials
     Inside: the explanations; SHADE_NO_EXPLAIN leaves them out
       >>replay    8983  shaders, run again    >>survey    9257  experiments on a draw
       >>questions 9520  what the picture has  >>numbers   9720  what makes no sense
       >>doubts   10054  what is seldom right  >>unseen   10203  why nothing is in view
       >>hidden   10482  why nothing is stored >>black    10649  why all is black
       >>wrong    11033  what else is wrong    >>verdict  11425  the calls
     Sources
       >>refs     11715                        >>history  11748
       >>license  11754

   >>conventions
     World        right-handed; the camera looks down -z, +y is up.  Angles in radians.
     Matrices     column vectors, column-major: (float *)&m is a matrix of OpenGL, GLM and cglm.
     Clip space   -w <= x, y, z <= w; with depth_zero_to_one 0 <= z <= w.  Triangles are clipped at
                  near and far; in x and y only where they reach beyond 3 w.
     Window       x right, y DOWN, row 0 on top.  Pixel (i,j) has its centre at (i + 1/2, j + 1/2).
                  X = (x/w + 1) width/2,   Y = (1 - y/w) height/2.
     Depth        0 at near, 1 at far; the test is LESS, and the buffer is cleared to 1.  Reversed
                  depth is 1 at near and falls: set SHADE_COMPARE_GREATER and clear the buffer to 0.
                  shade_mat4_perspective_reversed gives it, with depth_zero_to_one set, and so does
                  shade_mat4_perspective with near and far exchanged.
     Front face   counter-clockwise as seen on the screen.
     Coverage     vertices are snapped to floor(256 X + 1/2) / 256; edge functions are exact;
                  pixel centres on an edge follow the top-left rule.
     Directions   N, L, V, H and R are unit vectors and all point AWAY from the surface.
     Colour       linear light, unclamped.  Formats of 8 and 5-6-5 bits store clamp(c, 0, 1),
                  rounded to nearest, and 0 for NaN.
     Rows         of a packet: SHADE_LANES numbers, one a lane; a vector takes three rows.  Of a
                  picture: the pixels of one y.
     Names        shade__x is private.  _fx8 24.8 fixed point, rw 1/w.

   >>model   The equation of light ("iteration four") and its symbols:

     I = k_e + k_a I_a + SUM over lights j of { k_a I_La,j
             + spot_j / (a_j + b_j r_j + c_j r_j^2) B_j (k_d I_d,j (N.L_j) + k_s I_s,j (N.H_j)^n) }

     k_e k_a k_d k_s n   emission, ambient, diffuse, specular, shininess of the shade_material
     I_a                 ambient light of the scene
     I_La I_d I_s        ambient, diffuse and specular light of one lamp
     a b c, r            attenuation coefficients, distance to the lamp (at infinity: factor 1)
     spot                max(0, L.S)^e where L.S >= cos(beta), else 0; the lamp points along -S
     B                   1 where N.L > 0, else 0
     H                   (L + V) / |L + V|; SHADE_MODEL_PHONG has (R.V)^n instead, R = 2 (N.L) N - L
*/
#if !defined(__cplusplus) && (defined(__GNUC__) || defined(__STDC_VERSION__)) && \
    !(defined(__STDC_VERSION__) && __STDC_VERSION__ >= 199901L)
#error "shade.h needs C99 or later: compile with -std=c99, or without -std and -ansi"
#define SHADE_H    /* so that this is the only error */
#undef SHADE_IMPLEMENTATION
#endif
#ifndef SHADE_H
#define SHADE_H
#define SHADE_VERSION 10400    /* major * 10000 + minor * 100 + patch */

/*----------------------------------------------------------------------------------------- >>config
   Options.  Define them before the #include, with the same value in every file of a program.

     SHADE_IMPLEMENTATION     compiles the function bodies too; define it in one file only
     SHADE_STATIC             makes all functions static, so that the compiler drops the ones you do
                              not call
     SHADEDEF                 linkage of public functions; default extern (static with SHADE_STATIC)
     SHADE_ASSERT(x)          checks the library's own invariants; default assert(x)
     SHADE_LANES              vertices or fragments in a packet, the unit that shaders work on: a
                              power of two from 8 to 256; default 128, but 16 for Arm's M
                              profile (Cortex-M), because small packets suit small stacks
     SHADE_MAX_VARYINGS       floats that a vertex can pass to fragments, 1 .. 64; default 16.
                              Meshes lit per fragment need 6, with colours 9, with a map 8, with
                              both 11; with a fragment shader of your own 11
     SHADE_NO_STDIO           leaves out shade_write_ppm, shade_write_png and <stdio.h>
     SHADE_NO_EXPLAIN         leaves out the explanations, a fifth of the code: shade_explain,
                              shade_explain_lines and shade_explain_draw return ""
     SHADE_NO_LIBM            freestanding: gcc and clang need only <stddef.h>, <stdint.h> and
                              <float.h>, others <string.h> too; implies NO_STDIO and NO_DISPATCH,
                              and turns the default SHADE_ASSERT off
     SHADE_MEMCPY(d, s, n)    default memcpy; SHADE_MEMSET(d, c, n) default memset
     SHADE_NO_DISPATCH        compiles each hot loop once, for the target of -march
     SHADE_ALLOW_FAST_MATH    lets clang compile the implementation with -ffast-math; the bits
                              change, and checks for NaN may fail

   SHADE_LANES and SHADE_MAX_VARYINGS must be plain decimal numbers: they become part of the link
   names of functions that take packets, so that files that disagree do not link.

   No identifier here is a single capital letter, so macros such as I of <complex.h> do no harm.
   Without the implementation e, g, i, j, o and q are free as well.
                                                                                          >>types */
#if defined(__cplusplus) && !(defined(FLT_MAX) && defined(offsetof) && defined(UINT32_MAX))
/* If you include this file inside a namespace, the three headers below would declare their types
   there, with hundreds of errors.  This makes one error instead, and its name says what to do. */
struct shade__before_the_namespace_include_float_h_stddef_h_stdint_h;
typedef ::shade__before_the_namespace_include_float_h_stddef_h_stdint_h shade__global;
#endif
#include <float.h>
#include <stddef.h>
#include <stdint.h>

#ifndef SHADE_LANES
#if defined(__ARM_ARCH_PROFILE) && __ARM_ARCH_PROFILE == 'M'
#define SHADE_LANES 16
#else
#define SHADE_LANES 128
#endif
#endif
#ifndef SHADE_MAX_VARYINGS
#define SHADE_MAX_VARYINGS 16
#endif
#if SHADE_LANES < 8 || SHADE_LANES > 256 || (SHADE_LANES & (SHADE_LANES - 1))
#error "shade.h: SHADE_LANES must be 8, 16, 32, 64, 128 or 256"
#endif
#if SHADE_MAX_VARYINGS < 1 || SHADE_MAX_VARYINGS > 64
#error "shade.h: SHADE_MAX_VARYINGS must be 1 .. 64"
#endif

/* With 16 lanes and 8 varyings the linker sees shade_draw as shade_draw_16_8.  Files that disagree
   would otherwise draw nothing, or write past their packets. */
#define SHADE__JOIN(name, lanes, varyings) name##_##lanes##_##varyings
#define SHADE__JOINED(name, lanes, varyings) SHADE__JOIN(name, lanes, varyings)
#define SHADE__LINKED(name) SHADE__JOINED(name, SHADE_LANES, SHADE_MAX_VARYINGS)
#if SHADE_LANES != 128 || SHADE_MAX_VARYINGS != 16
#define shade_draw SHADE__LINKED(shade_draw)
#define shade_draw_mesh SHADE__LINKED(shade_draw_mesh)
#define shade_explain_draw SHADE__LINKED(shade_explain_draw)
#define shade_lit_lanes SHADE__LINKED(shade_lit_lanes)
#define shade_light_at_lanes SHADE__LINKED(shade_light_at_lanes)
#define shade_sample_lanes SHADE__LINKED(shade_sample_lanes)
#endif

#ifdef SHADE_NO_LIBM
#undef SHADE_NO_STDIO
#define SHADE_NO_STDIO
#undef SHADE_NO_DISPATCH
#define SHADE_NO_DISPATCH
#endif

#if defined(__GNUC__) || defined(__clang__)
#define SHADE__GNU
#define SHADE__ALWAYS_INLINE inline __attribute__((always_inline))
#define SHADE__UNUSED __attribute__((unused))
#define SHADE__64_BYTES __attribute__((aligned(64)))
#elif defined(_MSC_VER)
#define SHADE__ALWAYS_INLINE __forceinline
#define SHADE__UNUSED
#define SHADE__64_BYTES __declspec(align(64))
#else
#define SHADE__ALWAYS_INLINE inline
#define SHADE__UNUSED
#define SHADE__64_BYTES
#endif

#ifndef SHADEDEF
#ifdef SHADE_STATIC
#define SHADEDEF SHADE__UNUSED static
#else
#define SHADEDEF extern
#endif
#endif

#if defined(__cplusplus) || defined(_MSC_VER)
#define SHADE_RESTRICT __restrict
#else
#define SHADE_RESTRICT restrict
#endif

/* Rows of packets are aligned to the widest vector.  Unaligned vectors straddle two cache lines,
   which costs 4 % of a lit floor and 12 % of a flat fill in cache.  Small packets are made for
   small stacks and stay unaligned.  Packets are passed by pointer: MSVC for 32-bit x86 refuses
   aligned parameters (C2719), and inlines no function that has one. */
#if SHADE_LANES < 64
#define SHADE_ALIGNED
#else
#define SHADE_ALIGNED SHADE__64_BYTES
#endif

/* MSVC's /W4 warns of constant conditions (4127) and of the padding of SHADE_ALIGNED (4324). */
#ifdef _MSC_VER
#define SHADE__QUIET __pragma(warning(push, 3))
#define SHADE__LOUD __pragma(warning(pop))
#else
#define SHADE__QUIET
#define SHADE__LOUD
#endif
#ifdef __cplusplus
#define SHADE__OPEN SHADE__QUIET extern "C" {
#define SHADE__CLOSE } SHADE__LOUD
#else
#define SHADE__OPEN SHADE__QUIET
#define SHADE__CLOSE SHADE__LOUD
#endif

/*------------------------------------------------------------------------------------------ >>types
   Plain structs, passed by value.  Where a field has a default, zero is the default.    >>light */

typedef struct shade_vec2 { float x, y; } shade_vec2;
typedef struct shade_vec3 { float x, y, z; } shade_vec3;
typedef struct shade_vec4 { float x, y, z, w; } shade_vec4;
typedef struct shade_mat3 { shade_vec3 col[3]; } shade_mat3;    /* columns */
typedef struct shade_mat4 { shade_vec4 col[4]; } shade_mat4;
typedef char shade__no_padding[sizeof(shade_mat4) == 64 && sizeof(shade_vec3) == 12 ? 1 : -1];

typedef enum shade_result {
    SHADE_OK = 0,
    SHADE_ERROR_ARGUMENT,    /* a NULL, a factor, sizes that differ, NaN, memory not aligned to 4,
                                an output that overlaps an input */
    SHADE_ERROR_TARGET,      /* size, stride, format, clip rectangle, strip; neither color nor
                                depth, or no color where a picture is read or written */
    SHADE_ERROR_MESH,        /* positions NULL, a negative count, a stride, a chunk, indices of both
                                kinds; an odd point_count */
    SHADE_ERROR_STATE,       /* in a state or pipeline an unknown enumerator, a number out of range,
                                or a fragment shader without PER_FRAGMENT; cos_crease is NaN */
    SHADE_ERROR_LIGHTS,      /* lights NULL with a count, an unknown model, a cutoff of NaN */
    SHADE_ERROR_TEXTURE,     /* a texture, or the varyings of its level of detail */
    SHADE_ERROR_INDEX,       /* an index at or past vertex_count; a count that 3 does not divide */
    SHADE_ERROR_CAPACITY,    /* the caller's array or memory is too small */
    SHADE_ERROR_IO           /* a file or the caller's write function failed */
} shade_result;

/* What a surface emits and reflects, in linear RGB.  With SHADE_FLAG_WEIGHTED_SPECULAR and k_d +
   k_s <= 1 in each channel no direction gets more than arrives, I (N.L); without the flag, grazing
   highlights do.  Neither is required. */
typedef struct shade_material {
    shade_vec3 emission;     /* k_e */
    shade_vec3 ambient;      /* k_a */
    shade_vec3 diffuse;      /* k_d */
    shade_vec3 specular;     /* k_s */
    float      shininess;    /* n >= 0; negative counts as 0 */
} shade_material;

/* One lamp.  shade_directional_light, shade_point_light and shade_spot_light fill it in. */
typedef struct shade_light {
    shade_vec4 position;           /* w = 0: direction TOWARD a distant light; else at xyz/w */
    shade_vec3 ambient;            /* I_La, attenuated only with SHADE_FLAG_ATTENUATED_AMBIENT */
    shade_vec3 diffuse;            /* I_d */
    shade_vec3 specular;           /* I_s */
    float      constant, linear, quadratic;    /* a, b, c >= 0 of 1/(a + b r + c r^2); all 0: 1 */
    shade_vec3 spot_direction;     /* where the lamp points, any length; zero: not a spotlight */
    float      spot_exponent;      /* e; 0 or less: even light within the cone */
    float      spot_cos_cutoff;    /* cos(beta), beta from the axis to the edge; 0: 90 degrees */
} shade_light;

typedef enum shade_model {
    SHADE_MODEL_BLINN_PHONG = 0,     /* iterations three and four: (N.H)^n             [Blinn77] */
    SHADE_MODEL_PHONG,               /* (R.V)^n in place of (N.H)^n                    [Phong75] */
    SHADE_MODEL_LAMBERT,             /* iteration two: emission, ambient, diffuse */
    SHADE_MODEL_AMBIENT,             /* iteration one: emission, ambient */
    SHADE_MODEL_EMISSIVE,            /* iteration zero: emission */
    SHADE_MODEL_COOL_TO_WARM         /* k_e + shade_cool_to_warm of the first light    [Gooch98] */
} shade_model;

enum {                                 /* shade_lighting.flags */
    SHADE_FLAG_TWO_SIDED          = 1,     /* -N replaces N where N.V < 0 */
    SHADE_FLAG_TWO_SIDED_ABS      = 2,     /* |N.L| replaces N.L in the diffuse term alone */
    SHADE_FLAG_UNGATED_SPECULAR   = 4,     /* B is 1: highlights reach behind the terminator */
    SHADE_FLAG_WEIGHTED_SPECULAR  = 8,     /* k_s max(0, N.L) (N.H)^n, as a BRDF is weighted */
    SHADE_FLAG_ATTENUATED_AMBIENT = 16,    /* distance and cone dim I_La, as in OpenGL 1.x */
    SHADE_FLAG_INFINITE_VIEWER    = 32     /* eye is the direction toward the viewer everywhere */
};
enum {                                 /* shade_lighting.terms; 0 = all */
    SHADE_TERM_EMISSION = 1, SHADE_TERM_AMBIENT = 2, SHADE_TERM_DIFFUSE = 4, SHADE_TERM_SPECULAR = 8
};

/* The lights of a scene and the lighting equation.  Positions, normals and eye must be in one space
   with orthogonal axes of equal scale: world or eye space, never clip space.  On the outline of a
   coarse mesh some interpolated normals point away from the viewer.  SHADE_FLAG_TWO_SIDED flips
   these, which shows as specks; a finer mesh has fewer.
     To draw a mesh unlit, set terms to SHADE_TERM_AMBIENT and ambient to 1, 1, 1: you see k_a times
   vertex colour and map. */
typedef struct shade_lighting {
    const shade_light *lights;         /* NULL: none; shade_draw_mesh then refuses a count */
    int         light_count;           /* a negative one counts as 0 */
    shade_vec3  ambient;               /* I_a, one for the scene */
    shade_model model;                 /* unknown: BLINN_PHONG; shade_draw_mesh refuses it */
    unsigned    flags;                 /* SHADE_FLAG_... */
    unsigned    terms;                 /* SHADE_TERM_... */
    shade_vec3  cool, warm;            /* for COOL_TO_WARM; zero: (.4,.4,.7) and (.8,.6,.6) */
} shade_lighting;

/* The four terms of the equation, in linear RGB, unclamped.  Their sum is the light. */
typedef struct shade_terms { shade_vec3 emission, ambient, diffuse, specular; } shade_terms;

typedef enum shade_format {
    SHADE_FORMAT_RGBA8 = 0,      /* bytes R, G, B, A in memory order */
    SHADE_FORMAT_BGRA8,          /* bytes B, G, R, A, as Win32, X11, Cairo and Qt surfaces use */
    SHADE_FORMAT_RGB565,         /* a native uint16, red in the high bits */
    SHADE_FORMAT_RGB565_SWAPPED, /* its two bytes exchanged, as displays on a serial bus use */
    SHADE_FORMAT_RGBA32F,        /* four floats, neither clamped nor encoded as sRGB */
    SHADE_FORMAT_A8              /* for textures only: a byte of alpha; R = G = B = 1, never sRGB */
} shade_format;

typedef enum shade_wrap {        /* what u and v beyond 0 .. 1 show */
    SHADE_WRAP_REPEAT = 0,       /* the picture again: u - floor(u) */
    SHADE_WRAP_CLAMP,            /* the texels at its edge */
    SHADE_WRAP_MIRROR            /* the picture again, every other time reversed */
} shade_wrap;
typedef enum shade_filter {
    SHADE_FILTER_BILINEAR = 0,   /* the four nearest texels, weighted by distance */
    SHADE_FILTER_NEAREST,        /* the texel at u, v */
    SHADE_FILTER_TRILINEAR       /* bilinear in two mipmaps, by the level of detail [Williams83] */
} shade_filter;

/* A picture to sample.  u runs right and v DOWN from the top left corner of row 0; texel (i, j) has
   its centre at ((i + 1/2) / width, (j + 1/2) / height).  A bad texture samples as white.  Mipmap
   levels use the base level's wrap and filter; the base level replaces a bad one. */
typedef struct shade_texture {
    const void  *pixels;
    int          width, height;            /* texels, 1 .. 16384 */
    int          stride;                   /* texels from row to row, >= width; 0: width */
    shade_format format;
    int          srgb;                     /* non-zero: 8 and 5-6-5 bits are sRGB */
    shade_wrap   wrap_u, wrap_v;
    shade_filter filter;
    const struct shade_texture *mipmaps;   /* levels 1, 2, ...; only TRILINEAR reads them */
    int          mipmap_count;             /* at most 16 count; negative: none */
} shade_texture;

/* A picture and its depth buffer, in your memory. */
typedef struct shade_target {
    int   width, height;         /* of the whole picture, 1 .. 16384 pixels */
    int   stride;                /* pixels from row to row of color and depth, >= width; 0: width */
    shade_format format;
    void  *color;                /* NULL: depth only */
    float *depth;                /* NULL: no depth buffer; every fragment passes */
    int   srgb;                  /* non-zero: 8 and 5-6-5 bits are stored as sRGB */
    int   dither;                /* non-zero: 4 x 4 ordered dither in 5-6-5 bits */
    int   clip_x, clip_y;        /* draws and clears change only this rectangle, cut to the */
    int   clip_width, clip_height;    /* picture, so nothing if it is empty; four zeros: all */
    int   row_offset, row_count; /* a strip: color and depth point at row row_offset and hold */
                                 /* row_count rows; count 0: all rows of the picture */
} shade_target;

typedef enum shade_interpolation {
    SHADE_INTERPOLATION_PERSPECTIVE = 0,    /* correct: linear in the plane of the triangle */
    SHADE_INTERPOLATION_AFFINE,             /* linear on the screen, to show why that is wrong */
    SHADE_INTERPOLATION_CONSTANT            /* the value of the triangle's first vertex */
} shade_interpolation;
/* The faces that are left out.  A front face is counter-clockwise on the screen. */
typedef enum shade_cull { SHADE_CULL_NONE = 0, SHADE_CULL_BACK, SHADE_CULL_FRONT } shade_cull;
typedef enum shade_compare {     /* how a fragment's depth must compare with the stored one */
    SHADE_COMPARE_LESS = 0, SHADE_COMPARE_LESS_EQUAL, SHADE_COMPARE_GREATER,
    SHADE_COMPARE_GREATER_EQUAL, SHADE_COMPARE_EQUAL, SHADE_COMPARE_ALWAYS
} shade_compare;
typedef enum shade_blend {       /* s: the fragment, a: its alpha, d: the pixel, in linear light */
    SHADE_BLEND_REPLACE = 0,     /* s */
    SHADE_BLEND_OVER,            /* straight alpha: s a + d (1 - a); alpha: a + d_a (1 - a) */
    SHADE_BLEND_ADD              /* s + d, all four channels */
} shade_blend;

/* The rasterizer state that all draws share.  The depth of a pixel depends on the positions of its
   triangle alone: all passes over one mesh give the same depth, to the bit, however they shade and
   interpolate. */
typedef struct shade_raster {
    shade_cull    cull;
    shade_compare depth_test;
    shade_blend   blend;
    int   depth_read_only;       /* non-zero: test, do not write */
    int   depth_zero_to_one;     /* non-zero: clip space has 0 <= z <= w */
    float depth_bias;            /* added to depth, which is then clamped to [0, 1]; -1e-3, for */
                                 /* example, for lines on a mesh; on steep faces they need more */
} shade_raster;

typedef enum shade_shading {
    SHADE_SHADING_PER_FRAGMENT = 0,    /* N and P are interpolated, each pixel is lit [Phong75] */
    SHADE_SHADING_PER_VERTEX,          /* vertices are lit, colours interpolated    [Gouraud71] */
    SHADE_SHADING_PER_FACE             /* each face is lit at its centroid, with its own normal */
} shade_shading;

/* What happened to the triangles of one call; each call starts from zero.
     triangles = skipped + culled + clipped + rejected + drawn
   Without chunks skipped is 0, and none of the six numbers depends on the clip rectangle. */
typedef struct shade_stats {
    long long triangles;
    long long skipped;           /* their chunk cannot be seen in the clip rectangle */
    long long culled;            /* they face the wrong way, or have no area after snapping */
    long long clipped;           /* wholly outside the view volume, not merely cut by it */
    long long rejected;          /* a corner in clip space is NaN, infinite or beyond 1e30 */
    long long drawn;
    long long fragments;         /* pixels in the clip rectangle that passed the depth test and */
                                 /* were not discarded; a pixel counts for each triangle */
} shade_stats;

SHADE__OPEN

/*------------------------------------------------------------------------------------------ >>light
   The equations of >>model.  All vectors point away from the surface.  Every function is defined
   for all inputs.  Vectors up to 1e12, with colours up to 1e6, never give NaN or infinity.  "Any
   length" means 1e-18 to 1e18; a shorter vector counts as zero.

   Accuracy: the error against exact arithmetic is below

     5e-5 max(1, |exact|, I) max(1, (n + e) / 100)

   where I is the brightest light that arrives, before its cone dims it.  This holds for attenuation
   coefficients >= 0, k <= 1 and lights up to 1e6, away from the jumps of the equation: N.L, L.S -
   cos(beta) and, with SHADE_FLAG_TWO_SIDED, N.V must differ from 0 by more than 1e-6, and |L + V|
   must exceed 2e-6.  A power with an exponent between 0 and 1 is infinitely steep at 0: its base
   must differ from 0 by 1e-3.  A lamp with w other than 0 and 1 stands at xyz / w, rounded to
   floats.                                                                                 >>draw */

/* Lamps of one colour: I_d = I_s = color, no ambient light, no attenuation.  direction_of_travel is
   the direction in which the light travels, aim the direction in which the lamp points, target -
   position; both may have any length.  cutoff_radians is the angle from the axis to the edge of the
   cone, 0 .. pi.  Any other value, for example 45 meant as degrees, gives a spot_cos_cutoff of NaN,
   which draws refuse with SHADE_ERROR_LIGHTS.  exponent is e >= 0. */
SHADEDEF shade_light shade_directional_light(shade_vec3 direction_of_travel, shade_vec3 color);
SHADEDEF shade_light shade_point_light(shade_vec3 position, shade_vec3 color);
SHADEDEF shade_light shade_spot_light(shade_vec3 position, shade_vec3 aim, float cutoff_radians,
                                      float exponent, shade_vec3 color);

/* How much of a lamp arrives at P if nothing is in the way: spot / (a + b r + c r^2), a factor of
   I_d and I_s; 1 for a lamp at infinity without a cone.  *to_light becomes L, unit, from P toward
   the lamp.  Where P is the lamp, or a lamp at infinity has no direction, L is zero, and a cone
   with cos(beta) > 0 gives no light.  *distance becomes r, or FLT_MAX at infinity.  Either may be
   NULL.  For light NULL all three are zero. */
SHADEDEF float shade_light_at(const shade_light *light, shade_vec3 point, shade_vec3 *to_light,
                              float *distance);
/* The same for a packet: point and to_light are three rows of SHADE_LANES floats, amount is one
   row.  to_light and amount may be NULL, or lie in the rows of point.  Without a light or a point
   both are zero. */
SHADEDEF void shade_light_at_lanes(const shade_light *light, const float *point, float *to_light,
                                   float *amount);

/* The light that leaves P toward the eye, term by term.  N may have any length.  With N = 0 only
   emission and ambient light remain; COOL_TO_WARM gives the mean of both tones.  eye is the
   viewer's position, or with SHADE_FLAG_INFINITE_VIEWER the direction toward the viewer.  P, N, eye
   and the lights are in one space.  material NULL is white Lambert: k_d = k_a = 1.  lighting NULL
   gives zeros. */
SHADEDEF shade_terms shade_evaluate(const shade_lighting *lighting, const shade_material *material,
                                    shade_vec3 eye, shade_vec3 point, shade_vec3 normal);

/* The sum of the four terms: iteration four. */
SHADEDEF shade_vec3 shade_lit(const shade_lighting *lighting, const shade_material *material,
                              shade_vec3 eye, shade_vec3 point, shade_vec3 normal);

/* The surface points of a packet, in rows of SHADE_LANES floats.  A vector is three consecutive
   rows: for example in->varying[k], or n[0] of your own float n[3][SHADE_LANES]. */
typedef struct shade_rows {
    const float *position;      /* P: 3 rows, x, y and z */
    const float *normal;        /* N: 3 rows, of any length */
    const float *albedo;        /* 3 rows that multiply k_d and k_a; NULL: 1 */
    const float *specular;      /* 3 rows that multiply k_s; NULL: 1 */
    const float *visibility;    /* 1 row for each light, multiplies its I_d and I_s; NULL: 1 */
} shade_rows;

/* shade_lit for a packet: call it in your fragment shader.  Lane i of the rows gives lane i of rgb,
   three rows that must not overlap the others.  A lane depends on itself alone and has the bits of
   shade_lit.
     Visibility 0 is full shadow; 0.5, for example, halves the lamp, and values are not clamped.  It
   never hides ambient light, and COOL_TO_WARM ignores it.  rgb is 0 where lighting, rows, position
   or normal is NULL. */
SHADEDEF void shade_lit_lanes(const shade_lighting *lighting, const shade_material *material,
                              shade_vec3 eye, const shade_rows *rows, float *rgb);

/* The single terms.  Pass unit vectors as N, L and V: they are used as they are. */

/* max(0, N.L) */
SHADEDEF float shade_lambert(shade_vec3 normal, shade_vec3 to_light);
/* B max(0, R.V)^n with R = 2 (N.L) N - L; 0 where N.L <= 0.  n is the exponent.      [Phong75] */
SHADEDEF float shade_phong_specular(shade_vec3 normal, shade_vec3 to_light, shade_vec3 to_eye,
                                    float exponent);
/* B max(0, N.H)^n with H = (L + V) / |L + V|; 0 where N.L <= 0 or |L + V|^2 < 1e-12. [Blinn77] */
SHADEDEF float shade_blinn_phong_specular(shade_vec3 normal, shade_vec3 to_light, shade_vec3 to_eye,
                                          float exponent);
/* 1 / (a + b r + c r^2), at most 1e20, which is also the result for a sum that is negative or NaN.
   It is 1 where a = b = c = 0; where only a is 0, r counts as max(r, 1e-4).  r is 0 .. 1e18. */
SHADEDEF float shade_attenuation(float a, float b, float c, float r);
/* max(0, L.S)^e where L.S >= cos_cutoff, else 0, with S = -aim / |aim| and L toward the light.  It
   is 1 where aim is zero.  exponent is e; negative counts as 0. */
SHADEDEF float shade_spot(shade_vec3 to_light, shade_vec3 aim, float cos_cutoff, float exponent);

/* The reflectance f_r: reflected light is f_r I (N.L).  It is k_d + k_s (N.H)^n for BLINN_PHONG,
   k_d + k_s (R.V)^n for PHONG, k_d for LAMBERT, else 0.  It has no B: the weight N.L does the same.
   N, L and V are unit vectors.  material NULL is white Lambert. */
SHADEDEF shade_vec3 shade_brdf(const shade_material *material, shade_model model, shade_vec3 normal,
                               shade_vec3 to_light, shade_vec3 to_eye);
/* cool + k_w (warm - cool) with k_w = (1 + N.L) / 2.  N and L are unit vectors.      [Gooch98] */
SHADEDEF shade_vec3 shade_cool_to_warm(shade_vec3 normal, shade_vec3 to_light, shade_vec3 cool,
                                       shade_vec3 warm);
/* 4 n: the Blinn-Phong exponent that gives a highlight of about the size of Phong's exponent n when
   the light comes from the viewer's side. */
SHADEDEF float shade_blinn_exponent(float phong_exponent);
/* x^n.  x is clamped to [0, 1].  NaN and negative numbers count as 0, both as x and as n.  x^0 is 1
   for every x.  The result is never NaN; its absolute error is below 2e-6 for n up to 1e6. */
SHADEDEF float shade_power(float x, float n);

/* From sRGB to linear light and back, component by component.  Components are clamped to [0, 1],
   NaN counts as 0, and the absolute error is below 4e-6.                              [IEC61966] */
SHADEDEF shade_vec3 shade_linear_from_srgb(shade_vec3 display);
SHADEDEF shade_vec3 shade_srgb_from_linear(shade_vec3 linear);
/* The linear colour of the sRGB colour 0xRRGGBB; the upper 8 bits are ignored. */
SHADEDEF shade_vec3 shade_rgb(uint32_t rrggbb);

/*------------------------------------------------------------------------------------------- >>draw
   Vertex shader, clipping, rasterization, fragment shader, depth test, blending.  Bad arguments are
   refused before any pixel changes, in this order: NULLs, target, mesh, state, lights, texture,
   indices.  Nothing is ever written outside the target's rows, width and clip rectangle.
                                                                                          >>tools */

/* ---- results, clearing, textures */

/* What a result means and which fields to check, in English; never NULL. */
SHADEDEF const char *shade_result_string(shade_result result);

/* Fills the clip rectangle of color, with a linear RGBA stored as a draw would store it, and of
   depth, with the number as it is, not clamped.  A buffer that is NULL is left out.  NaN as depth
   is SHADE_ERROR_ARGUMENT.  An empty clip rectangle is SHADE_OK, and nothing changes. */
SHADEDEF shade_result shade_clear(const shade_target *target, shade_vec4 color, float depth);

/* The texture's linear RGBA at u, v; white for NULL or a bad texture.  lod is the level of detail,
   log2 of texels per pixel: for example 1 where a pixel is two texels wide.  A negative lod counts
   as 0, and so do NaN and infinity in u, v and lod. */
SHADEDEF shade_vec4 shade_sample(const shade_texture *texture, float u, float v, float lod);
/* The same for a packet, in rows of SHADE_LANES floats.  lod NULL means 0.  rgba is four rows that
   must not overlap the others.  Where u, v or rgba is NULL, nothing is written. */
SHADEDEF void shade_sample_lanes(const shade_texture *texture, const float *u, const float *v,
                                 const float *lod, float *rgba);

/* ---- shaders and pipelines */

/* Packets, the arguments of shaders.  Lanes from count on repeat lane count - 1, because shaders
   compute every lane. */
typedef struct shade_vertex_ids {                 /* vertices to shade */
    int      count;
    uint32_t index[SHADE_LANES];                  /* OpenGL's gl_VertexID: fetch attributes by it */
} shade_vertex_ids;
typedef struct shade_vertices {
    SHADE_ALIGNED float clip[4][SHADE_LANES];     /* clip-space position, preset to 0 */
    float varying[SHADE_MAX_VARYINGS][SHADE_LANES];    /* preset to 0 */
} shade_vertices;
typedef struct shade_fragments {                  /* pixels to shade, of any triangles of a draw */
    int      count;
    SHADE_ALIGNED float x[SHADE_LANES];           /* pixel centre, window space */
    float    y[SHADE_LANES];
    float    z[SHADE_LANES];                      /* depth as stored */
    float    varying[SHADE_MAX_VARYINGS][SHADE_LANES];    /* only pipeline.varyings rows are set */
    uint32_t primitive[SHADE_LANES];              /* index of the triangle in this draw */
    uint32_t front[SHADE_LANES];                  /* 1: front-facing, 0: back-facing */
    float    lod[SHADE_LANES];                    /* of pipeline.lod_texture; 0 without one */
    shade_vec3 eye;                               /* of a draw state, in world space; 0 in */
                                                  /* shade_draw.  See shade_draw_mesh */
} shade_fragments;
typedef struct shade_colors {
    SHADE_ALIGNED float color[4][SHADE_LANES];    /* linear RGBA, preset to 0, 0, 0, 1 */
    uint32_t discard[SHADE_LANES];                /* preset to 0; any other value discards the */
                                                  /* fragment (shade_draw needs may_discard) */
} shade_colors;

/* Shaders work on whole packets: the compiler turns plain loops with SHADE_EACH_LANE into vector
   code. */
typedef void shade_vertex_shader(const void *uniforms, const shade_vertex_ids *SHADE_RESTRICT in,
                                 shade_vertices *SHADE_RESTRICT out);
typedef void shade_fragment_shader(const void *uniforms, const shade_fragments *SHADE_RESTRICT in,
                                   shade_colors *SHADE_RESTRICT out);

/* What shade_draw draws with.  If you set lod_texture, fragments have a lod for shade_sample_lanes:
   log2 of the longer of the two steps, in texels of level 0, that (u, v) makes to the next pixel
   right and below.  The steps are the exact derivatives of the perspective interpolation at the
   pixel, for every interpolation. */
typedef struct shade_pipeline {
    shade_vertex_shader   *vertex;
    shade_fragment_shader *fragment;              /* NULL: depth only */
    const void            *uniforms;              /* passed to both shaders */
    int                    varyings;              /* floats per vertex, 0 .. SHADE_MAX_VARYINGS */
    shade_interpolation    interpolation;
    shade_raster           raster;
    int                    may_discard;           /* non-zero: depth is tested after the shader */
    const shade_texture   *lod_texture;           /* NULL: no lod */
    int                    lod_varying;           /* k: varyings k, k + 1 are its u, v */
} shade_pipeline;

/* Draws index_count / 3 triangles.  indices NULL means vertices 0, 1, 2, ...  A negative count is
   SHADE_ERROR_MESH.  An index_count that 3 does not divide, and an index at or past vertex_count,
   are SHADE_ERROR_INDEX.  Vertices shared by nearby triangles are usually shaded once.  Each
   triangle is front or back facing as a whole, by its corners on the screen.  stats may be NULL.
   Without a colour buffer the fragment shader runs only where may_discard is set.
     The time of a triangle grows with the rows of its box and with the tiles of 32 x 8 pixels that
   it crosses.  For example, the diagonal of a picture of 16384 rows, of any width, takes less than
   1 ms if depth was just cleared, or 2 ms if every row lies on its own 4 kB page (make bench).
     To use threads, let each draw the same triangles with its own clip rectangle or target; the
   pixels are the same as from one thread, to the bit. */
SHADEDEF shade_result shade_draw(const shade_target *target, const shade_pipeline *pipeline,
                                 const uint32_t *indices, int index_count, int vertex_count,
                                 shade_stats *stats);

/* ---- meshes */

/* A mesh in your arrays, each with vertex_count elements.  Strides are BYTES from one element to
   the next, multiples of 4; 0 means tightly packed.  For example, colors of R, G, B, A have a
   stride of 16.  A stride below the size of an element is not refused: elements then overlap, and
   shade_explain reports it. */
typedef struct shade_mesh {
    const float *positions;  int position_stride;    /* x, y, z */
    const float *normals;    int normal_stride;      /* any length; NULL: each face has its own */
    const float *texcoords;  int texcoord_stride;    /* u, v */
    const float *colors;     int color_stride;       /* R, G, B: multiplies k_d and k_a; NULL: 1 */
    int vertex_count;
    const uint32_t *indices; int index_count;        /* NULL: indices16, or 0, 1, 2, ... */
    const struct shade_chunk *chunks; int chunk_count;    /* NULL and 0: no triangle is skipped */
    const uint16_t *indices16;                       /* in place of indices, which are then NULL */
} shade_mesh;

/* Triangles first .. first + count - 1 of a mesh, and a box around them in object space.  A mesh
   with chunks is drawn and picked chunk after chunk.  A chunk is skipped whole if its box cannot be
   seen, or if the ray misses it.  A triangle in two chunks is drawn twice, one in none is not
   drawn, and with chunk_count 0 nothing is drawn.  The library trusts the box: one that is too
   small hides triangles, and does no other harm; one with NaN or low > high is never skipped. */
typedef struct shade_chunk {
    shade_vec3 low, high;
    int first, count;
} shade_chunk;

typedef struct shade_draw_state {                 /* how one mesh is drawn */
    shade_mat4 model, view, projection;           /* zero: identity.  model is affine, and view */
                                                  /* does not scale */
    const shade_material *material;               /* NULL: white Lambert */
    shade_lighting lighting;                      /* light positions in world space */
    shade_shading shading;
    const shade_texture *diffuse_map;             /* multiplies k_d, k_a; needs texcoords */
    float transparency;                           /* 0 opaque .. 1 invisible */
    float alpha_cutoff;                           /* 0 .. 1; less alpha is discarded */
    shade_raster raster;
    shade_fragment_shader *fragment;              /* NULL: the equations; see shade_draw_mesh */
    const void *uniforms;                         /* passed to fragment */
} shade_draw_state;

/* Where the fragment shader of a draw state finds its input: the first row of each vector in
   shade_fragments.varying. */
enum {
    SHADE_VARYING_POSITION = 0,                   /* P, world space */
    SHADE_VARYING_NORMAL = 3,                     /* N, world space; unit at the vertices alone */
    SHADE_VARYING_COLOR = 6,                      /* of the vertices; 1 without colours */
    SHADE_VARYING_TEXCOORD = 9                    /* u, v; 0 without texcoords */
};

/* Draws a mesh lit by the equations of >>model in world space.  The eye is the position of the
   camera in view, or with SHADE_FLAG_INFINITE_VIEWER the camera's backward axis.  PER_FACE lights
   the centroid, with the face's normal and the colour of the first vertex; a map still varies from
   pixel to pixel.
     Light takes the eye from view alone.  If your projection moves the centre of projection,
   highlights are wrong.  If your camera looks along +z, as left-handed ones do, its backward axis
   points away from the viewer: negate eye in a shader of your own.  shade_explain reports both
   where it would change the picture.
     Alpha is (1 - transparency) times the map's alpha.  REPLACE stores colour and alpha, OVER
   blends by alpha, ADD adds the colour times alpha.  Fragments with an alpha below alpha_cutoff are
   discarded, in depth-only draws too, and stats does not count them.  Draw opaque meshes first,
   then the transparent ones from back to front; transparency 1 still writes depth.
     A fragment shader in the state replaces the equations; it needs PER_FRAGMENT shading.  It gets
   the SHADE_VARYING_... above, lod of diffuse_map, and the eye of the equations: pass in->eye to
   shade_lit_lanes, and sample maps yourself.  Alpha is (1 - transparency) times your color[3]; ADD,
   OVER and alpha_cutoff use that.  Depth-only draws call your shader only if alpha_cutoff > 0. */
SHADEDEF shade_result shade_draw_mesh(const shade_target *target, const shade_mesh *mesh,
                                      const shade_draw_state *state, shade_stats *stats);

/*------------------------------------------------------------------------------------------ >>tools
   Tools built on the renderer: explanations, chunks, lines, shapes, rays, pictures, presets.  Each
   that returns a shade_result checks its arguments before it changes anything but stats and count.
   A NULL that is not allowed is SHADE_ERROR_ARGUMENT; a bad target or mesh gives the result that a
   draw of it gives.  A picture to read or write must have color, else it is SHADE_ERROR_TARGET.
                                                                                       >>plumbing */

/* ---- explanations */

/* Says in one sentence why a draw gives no picture, or a wrong one, and which field to change; ""
   where nothing is suspicious; never NULL.  Call it after shade_draw_mesh, with the same arguments
   and the stats and depth that it wrote; without stats it cannot say everything.  It names the
   field of every refusal, and recognises matrices that are transposed, swapped or made from
   degrees, meshes out of view, culling, depth that was not cleared, and light that does not arrive
   or clips.
     It writes nothing: it draws the mesh again and again, changing one thing at a time, and counts
   pixels.  It calls a thing missing only if no pixel shows it.  It takes the time of many
   frames and more stack than shade_draw_mesh (bench/stack.c prints how much): call it when a
   picture is wrong, not in every frame.  state.fragment is called many times more than by the draw,
   at times with NaN in what the draw presets, so it must have no side effects.  The sentence is
   a constant: do not free it. */
SHADEDEF const char *shade_explain(const shade_target *target, const shade_mesh *mesh,
                                   const shade_draw_state *state, const shade_stats *stats);
/* The same for shade_draw: call it after the draw, with its arguments and the stats that it wrote,
   or NULL.  It runs the draw again without a picture, several times, and counts what your shaders
   return: positions that are NaN or out of view, discarded, black or transparent pixels, and what
   raster.cull, the depth test and the clip rectangle leave out.  Your shaders must have no side
   effects, as state.fragment for shade_explain.  It does not change the target. */
SHADEDEF const char *shade_explain_draw(const shade_target *target, const shade_pipeline *pipeline,
                                        const uint32_t *indices, int index_count, int vertex_count,
                                        const shade_stats *stats);

/* ---- chunks */

/* The number of chunks that shade_mesh_chunks makes of index_count indices; triangles 0 means 128.
   For a mesh without indices pass vertex_count.  0 for negative numbers, and where index_count is
   no multiple of 3. */
SHADEDEF int shade_chunk_count(int index_count, int triangles);
/* Cuts a mesh into chunks of up to `triangles` triangles (0 means 128) and computes their boxes.
   Chunks that the mesh already has are ignored; corners that are NaN or infinite are ignored in the
   box.
     With indices NULL the triangles stay in their order, which is good if neighbours in the list
   are neighbours in space.  Otherwise give indices room for index_count entries, or vertex_count if
   the mesh has no indices: it receives the triangles sorted in space.  Sorting splits the list at
   the median of its longest axis, and the halves again, in n log n steps, without further memory.
   The order is the same on every machine.
     Then set mesh.chunks to chunks, and mesh.chunk_count to shade_chunk_count.  If you gave
   indices, set mesh.indices and mesh.index_count to them, and mesh.indices16 to NULL.
     chunks has room for capacity entries; with too few the result is SHADE_ERROR_CAPACITY.  It is
   SHADE_ERROR_ARGUMENT for a negative number, and if chunks or indices overlap each other or the
   mesh's positions and indices.  In all of these cases nothing changes. */
SHADEDEF shade_result shade_mesh_chunks(const shade_mesh *mesh, int triangles, shade_chunk *chunks,
                                        int capacity, uint32_t *indices);

/* ---- lines */

typedef enum shade_cap { SHADE_CAP_BUTT = 0, SHADE_CAP_SQUARE } shade_cap;
typedef struct shade_line_state {
    shade_mat4    clip_from_points;               /* zero: identity */
    float         width;                          /* in pixels; 0 means 1; at most 2^25 counts */
    shade_cap     cap;                            /* SQUARE adds half the width, to close joints */
    shade_vec4    color;                          /* linear RGBA; alpha is straight, for OVER */
    shade_raster  raster;                         /* cull is ignored */
} shade_line_state;
/* Draws point_count / 2 lines between pairs of points.  Each is a rectangle on the screen, drawn as
   two triangles, which stats counts.  For lines over a filled mesh use SHADE_COMPARE_LESS_EQUAL and
   a negative depth_bias, such as -1e-3.  A line with equal ends is nothing, or a square with
   SHADE_CAP_SQUARE.  An odd or negative count, or one beyond 715827882, is SHADE_ERROR_MESH; a
   width that is negative, NaN or infinite is SHADE_ERROR_STATE. */
SHADEDEF shade_result shade_draw_lines(const shade_target *target, const shade_vec3 *points,
                                       int point_count, const shade_line_state *state,
                                       shade_stats *stats);
/* Says in one sentence why your lines do not show, as shade_explain_draw does; "" where nothing is
   suspicious, and where only a part of them is hidden.  It also recognises a transposed
   clip_from_points, and view times projection. */
SHADEDEF const char *shade_explain_lines(const shade_target *target, const shade_vec3 *points,
                                         int point_count, const shade_line_state *state,
                                         const shade_stats *stats);

/* ---- shape: boxes, normals, edges */

/* The least box around the corners of a mesh's triangles, in object space.  Corners that are NaN or
   infinite are ignored; if no corner is finite, low is 1, 1, 1 and high 0, 0, 0. */
SHADEDEF shade_result shade_mesh_bounds(const shade_mesh *mesh, shade_vec3 *low, shade_vec3 *high);
/* 0 only if nothing in the box, in object space, can reach a pixel of the target's clip rectangle
   and strip.  shade_draw_mesh skips chunks by this test; with it you can skip meshes, or ranges of
   indices in your own pipelines.  It allows for all rounding of transforms and clipping, and for
   any w.  A zero matrix is the identity.  1 for NaN, for low > high, and for a bad target. */
SHADEDEF int shade_box_visible(const shade_target *target, shade_mat4 clip_from_object,
                               int depth_zero_to_one, shade_vec3 low, shade_vec3 high);
/* The view that shows a box in world space: it looks at the middle from the side of toward_eye, a
   direction of any length (zero: +z), with up as in shade_mat4_look_at.  With a perspective the
   eye, which shade_mat4_eye gives, is as near as -w <= x, y <= w allows at all eight corners; near
   and far do not count.  Sides of an off-centre frustum that exclude the view axis are ignored.  If
   your projection turns or moves the eye, the view undoes it: for example a left-handed one, which
   looks along +z.  Without perspective the eye is one diagonal of the box away.  Returns the
   identity for NaN, infinity and low > high. */
SHADEDEF shade_mat4 shade_mat4_fit(shade_mat4 projection, shade_vec3 low, shade_vec3 high,
                                   shade_vec3 toward_eye, shade_vec3 up);

/* Fills normals[vertex_count].  The normal of a vertex is the mean of the normals of its faces,
   weighted by the angle of each face there, and made unit.  Faces with all corners exactly on a
   line do not count, nor do those with a corner that is NaN or infinite.  The normal of a vertex
   without faces is zero.                                                                [Thurmer98]
     What a function of this part fills must not overlap the mesh's positions, indices and chunks:
   the result is SHADE_ERROR_ARGUMENT, and nothing changes.  Its normals are not read: normals may
   be mesh->normals.  Between the vertices of an interleaved array is room for other data. */
SHADEDEF shade_result shade_mesh_normals(const shade_mesh *mesh, shade_vec3 *normals);
/* Fills one normal for each corner of each triangle, index_count of them or, without indices,
   vertex_count.  It is the mean, as above, over those faces around the corner's position that
   differ from the corner's own face by at most the crease angle: n . n_face >= cos_crease.  For
   example, cos_crease 0.5 keeps edges of more than 60 degrees hard.  To draw with them, give each
   corner a vertex of its own: a mesh without indices, with the position of each index.  Vertices of
   equal position count as one.  Time grows with the square of the number of faces around a
   position.  memory must be aligned to 4, have shade_mesh_corner_normals_bytes bytes (0 for a bad
   mesh), and must overlap neither the mesh nor normals.  Fewer bytes are SHADE_ERROR_CAPACITY, a
   cos_crease of NaN is SHADE_ERROR_STATE. */
SHADEDEF size_t       shade_mesh_corner_normals_bytes(const shade_mesh *mesh);
SHADEDEF shade_result shade_mesh_corner_normals(const shade_mesh *mesh, float cos_crease,
                                                shade_vec3 *normals, void *memory, size_t bytes);

/* Lists each edge of a mesh once, with a < b and its one or two triangles (-1: no second one); a
   third triangle makes a further entry.  Entries are sorted by a, then b.  Give edges room for
   index_count entries (without indices, vertex_count); with less you get SHADE_ERROR_CAPACITY, and
   the number needed in *count.  After any other error *count is 0.  An edge from a vertex to itself
   is left out. */
typedef struct shade_edge { uint32_t a, b; int32_t triangle[2]; } shade_edge;
SHADEDEF shade_result shade_mesh_edges(const shade_mesh *mesh, shade_edge *edges, int capacity,
                                       int *count);
/* 1 if (e.n0)(e.n1) <= 0, where e, to_eye, goes from the edge to the eye: of the two faces, with
   normals n0 and n1, one is seen from the front, the other from behind.  0 for NaN. */
SHADEDEF int shade_is_silhouette(shade_vec3 to_eye, shade_vec3 n0, shade_vec3 n1);
/* 1 if n0.n1 <= cos_crease, for unit normals: for example, 0.5 finds edges at which the faces turn
   by 60 degrees or more.  0 for NaN. */
SHADEDEF int shade_is_crease(shade_vec3 n0, shade_vec3 n1, float cos_crease);

/* ---- rays */

/* The world-space ray through window point x, y (pixel centres are at + 1/2), for every camera that
   draws.  Only the product of projection and view counts, not which of the two holds the camera.
     In a perspective, left-handed or not, the ray starts at the eye, where clip x, y and w are 0,
   and points to where w grows.  Rays are parallel if w is constant along them, or changes by less
   than 3e-5 of itself from near to far.  Then the ray starts where clip z = -w: on the near plane
   or, if z is from 0 to w, on a plane far - near in front of it.  It points to where depth grows,
   and so meets first what SHADE_COMPARE_LESS draws.
     Its direction is a unit vector.  A width or height below 1 counts as 1.  The ray is zero where
   it would not be finite, for a degenerate camera (both w and depth are constant), and for a zero
   matrix, which is not the identity here: in place of the zero matrices of a draw state pass
   shade_mat4_identity(). */
typedef struct shade_ray { shade_vec3 origin, direction; } shade_ray;
SHADEDEF shade_ray shade_pixel_ray(shade_mat4 view, shade_mat4 projection, int width, int height,
                                   float x, float y);
/* 1 if the ray meets the triangle, from either side: at origin + t direction with t >= 0, which is
   barycentric.x a + barycentric.y b + barycentric.z c.  A triangle with all corners exactly on a
   line is never hit.  t and barycentric may be NULL.                                 [Moller97] */
SHADEDEF int shade_intersect(shade_ray ray, shade_vec3 a, shade_vec3 b, shade_vec3 c, float *t,
                             shade_vec3 *barycentric);
/* The index of the nearest triangle of a mesh that a world-space ray meets, in the sense of
   shade_intersect; ties go to the lowest index.  model places the mesh (zero: identity).
   Degenerate triangles are never hit, nor is a point that rounding puts outside of its triangle's
   box.  Returns -1 if no triangle is hit, or if the mesh is bad; *t and *barycentric do not change
   then.  Either may be NULL.  The call looks at every triangle, or with chunks at the triangles of
   each box that the ray meets; indices of other triangles are not checked. */
SHADEDEF int shade_pick(const shade_mesh *mesh, shade_mat4 model, shade_ray ray, float *t,
                        shade_vec3 *barycentric);

/* ---- pictures and presets */

/* Writes the picture, or the rows of a strip, as a binary PPM ("P6"): R, G and B as they are
   stored, in 8 bits, without alpha.  RGBA32F is clamped, and encoded if srgb is set.  Your sink
   gets the file piece by piece, from first to last; if it returns non-zero, the call ends with
   SHADE_ERROR_IO.  shade_write_ppm replaces a file of this name.  One that could not be written
   completely is not removed. */
typedef int shade_write_fn(void *user, const void *bytes, size_t size);
SHADEDEF shade_result shade_encode_ppm(shade_write_fn *sink, void *user,
                                       const shade_target *target);
/* The same pixels as a PNG, which browsers and desktops open: 8 bits of R, G and B, and an sRGB
   chunk if srgb is set.  On the gallery it is a fifth as long as the PPM on average
   (tests/scripts/png.sh), and never longer by more than 13 %, a byte a row, and 90 bytes.  It takes
   less than 4 kB of stack. */
SHADEDEF shade_result shade_encode_png(shade_write_fn *sink, void *user,
                                       const shade_target *target);
#ifndef SHADE_NO_STDIO
SHADEDEF shade_result shade_write_ppm(const char *path, const shade_target *target);
SHADEDEF shade_result shade_write_png(const char *path, const shade_target *target);
#endif

/* Supersampling: each pixel of out becomes the mean of factor x factor pixels of in, in linear
   light.  in must be factor times as wide and high, and so must row_offset and row_count of its
   strip; factor is 1 .. 8.  Factor 1 converts formats, and may do so in place where the pixels are
   of equal size: out then has the color and stride of in.  Only the clip rectangle of out changes,
   and depth never.  If out overlaps the pixels of in that are read in any other way, the result is
   SHADE_ERROR_ARGUMENT. */
SHADEDEF shade_result shade_resolve(const shade_target *out, const shade_target *in, int factor);

/* The number of levels below the full size (each halves both sides, rounding down, until 1 x 1),
   and the bytes they need, tightly packed.  0 for an invalid size or format. */
SHADEDEF int    shade_mipmap_count(int width, int height);
SHADEDEF size_t shade_mipmap_bytes(int width, int height, shade_format format);
/* Fills shade_mipmap_count levels, and memory of shade_mipmap_bytes (aligned to 4), with means by
   area in linear light, and points the texture at them.  Its filter stays what it is: set it to
   SHADE_FILTER_TRILINEAR for them to be read.  levels, memory, the texels and the texture itself
   must not overlap: the result is SHADE_ERROR_ARGUMENT, and nothing changes.  Fewer bytes are
   SHADE_ERROR_CAPACITY, a bad texture SHADE_ERROR_TEXTURE. */
SHADEDEF shade_result shade_build_mipmaps(shade_texture *texture, shade_texture *levels,
                                          void *memory, size_t bytes);

/* The classic materials of the OpenGL "teapots" program, with its numbers, which are sRGB values.
   Use them as they are with a target without srgb; pass them through shade_linear_material for a
   target with srgb.  Shininess is the last column of the table times 128.        [Kilgard94] */
typedef enum shade_preset {
    SHADE_PRESET_EMERALD = 0, SHADE_PRESET_JADE, SHADE_PRESET_OBSIDIAN, SHADE_PRESET_PEARL,
    SHADE_PRESET_RUBY, SHADE_PRESET_TURQUOISE,
    SHADE_PRESET_BRASS, SHADE_PRESET_BRONZE, SHADE_PRESET_CHROME, SHADE_PRESET_COPPER,
    SHADE_PRESET_GOLD, SHADE_PRESET_SILVER,
    SHADE_PRESET_BLACK_PLASTIC, SHADE_PRESET_CYAN_PLASTIC, SHADE_PRESET_GREEN_PLASTIC,
    SHADE_PRESET_RED_PLASTIC, SHADE_PRESET_WHITE_PLASTIC, SHADE_PRESET_YELLOW_PLASTIC,
    SHADE_PRESET_BLACK_RUBBER, SHADE_PRESET_CYAN_RUBBER, SHADE_PRESET_GREEN_RUBBER,
    SHADE_PRESET_RED_RUBBER, SHADE_PRESET_WHITE_RUBBER, SHADE_PRESET_YELLOW_RUBBER,
    SHADE_PRESET_COUNT
} shade_preset;
/* A preset's material, and its name: "emerald", "black plastic", ...  A preset out of range is
   white Lambert and its name is "". */
SHADEDEF shade_material shade_preset_material(shade_preset preset);
SHADEDEF const char    *shade_preset_name(shade_preset preset);
/* The material with its four colours passed through shade_linear_from_srgb. */
SHADEDEF shade_material shade_linear_material(shade_material display);

SHADE__CLOSE

/*--------------------------------------------------------------------------------------- >>plumbing
   What inline functions and loops over lanes need of compilers, and what flags do to bits.

   Fast math.  Compiled by gcc, the implementation has the same bits with -ffast-math, -Ofast and
   their parts.  clang has no pragma that keeps the bits there, so the implementation refuses
   -ffast-math and -ffinite-math-only.  It cannot see the other parts, nor -ffp-contract=fast, which
   overrides the pragmas of >>plumbing: do not use them with clang.  A program linked with
   -ffast-math flushes denormal numbers to zero, which only SHADE_FORMAT_RGBA32F and exponents far
   below 1 show.
     Inline functions are compiled into your files.  Their bits change only with -ffast-math, -Ofast
   and the parts of these, and with -ffp-contract=fast: of clang, or of gcc beside -std=c99.
   Attributes and pragmas that turn fused instructions on for a part of a file may change them too.
     Your own sums of products, as in a shader, follow your flags: where the processor can (arm64,
   riscv64, s390x, -march=haswell), gcc and clang round a * b + c once.  Compile files that must
   give the same bits everywhere with -ffp-contract=off.

   C++.  A module may export all functions: export using ::shade_dot;  To include this file inside a
   namespace, include <float.h>, <stddef.h> and <stdint.h> before the namespace, for the
   implementation <assert.h> and <stdio.h> too, for MSVC <math.h>.

   tcc 0.9.27 for x86-64 has a bug: a function that returns a shade_vec3 writes 16 bytes in place of
   12.  The last 4 may fall on the variable that was declared last before the call, if its size is
   4, 12, 20, ... bytes: an int, a float, a shade_material.  So some declarations of this file stand
   in an order that avoids this, and SHADE_EACH_LANE has a 64-bit counter in tcc.
                                                                                           >>math */

/* Floats must be evaluated as floats, denormal ones too.  Compilers that do otherwise are refused,
   without further errors; tools that check without <float.h>, as cppcheck does, are not.  On s390x
   gcc -std=c99 evaluates floats as doubles, as glibc once did; SHADE__BEGIN turns that off for this
   file.  m68k -m68040 says that it evaluates floats as floats, but only rounds their mantissa. */
#define SHADE__EVAL_FLOAT
#if (defined(FLT_MANT_DIG) && (FLT_MANT_DIG != 24 || DBL_MANT_DIG != 53)) || \
    (defined(__SIZEOF_INT__) && __SIZEOF_INT__ < 4)
#error "shade.h needs an int of 32 bits, and IEEE numbers: a float of 24 bits, a double of 53"
#undef SHADE_IMPLEMENTATION
#elif defined(__s390x__) && defined(__GNUC__) && __GNUC__ >= 12 && !defined(__clang__)
#undef SHADE__EVAL_FLOAT
#define SHADE__EVAL_FLOAT _Pragma("GCC optimize(\"excess-precision=fast\")")
#elif defined(__m68k__) && defined(__HAVE_68881__)
#error "shade.h: the registers of this FPU are wider than floats; for m68k: -msoft-float and \
libraries made for it"
#undef SHADE_IMPLEMENTATION
#elif defined(__ALTIVEC__) && !defined(__VSX__)
#error "shade.h: AltiVec takes denormal floats for 0; for POWER: -mno-altivec, or -mvsx"
#undef SHADE_IMPLEMENTATION
#elif defined(__TINYC__) && defined(__i386__)
#error "shade.h: tcc for i386 evaluates floats in a wider type; use gcc -msse2 -mfpmath=sse"
#undef SHADE_IMPLEMENTATION
#elif defined(__PCC__)
#error "shade.h: pcc 1.2.0 loses structs that nested calls return; use gcc, clang or tcc"
#undef SHADE_IMPLEMENTATION
#elif defined(FLT_EVAL_METHOD) && FLT_EVAL_METHOD != 0 && FLT_EVAL_METHOD != 16
#error "shade.h: floats are evaluated in a wider type; for 32-bit x86: -msse2 -mfpmath=sse, for \
s390x: -std=gnu99 or -fexcess-precision=fast"
#undef SHADE_IMPLEMENTATION
#endif

/* The functions of >>math are SHADE__EXPORT, because a C++ module cannot export static functions.
   Inline functions of the implementation are SHADE__INLINE, that is static: they differ with the
   options of the file. */
#define SHADE__INLINE static SHADE__ALWAYS_INLINE
#ifdef __cplusplus
#define SHADE__EXPORT SHADE__ALWAYS_INLINE
#else
#define SHADE__EXPORT SHADE__INLINE
#endif

/* Compilers optimise the builtin even with -ffreestanding. */
#ifndef SHADE_MEMCPY
#ifdef SHADE__GNU
#define SHADE_MEMCPY __builtin_memcpy
#else
#include <string.h>
#define SHADE_MEMCPY memcpy
#endif
#endif
#ifdef SHADE_NO_LIBM
#define SHADE__SQRT shade__own_sqrt
#elif defined(__cplusplus) && defined(SHADE__GNU)
#define SHADE__SQRT __builtin_sqrtf    /* <math.h> in a namespace is 200 more errors */
#else
#include <math.h>
#define SHADE__SQRT sqrtf
#endif

/* A product in an inline function.  Where the processor has fused multiply-add, gcc fuses products
   and sums in your file, in inlined functions too, despite the pragmas of this file; gcc
   -std=c99 does not.  fma(a, b, -0) has the bits of a b, and cannot be fused again.  AltiVec's fma
   takes denormal numbers for 0: there the fma is one of doubles, which is exact, rounded once. */
#if defined(__ALTIVEC__) && defined(SHADE__GNU) && !defined(__clang__)
#define SHADE__TIMES(a, b) ((float)__builtin_fma((double)(a), (double)(b), -0.0))
#elif defined(__FP_FAST_FMAF) && defined(SHADE__GNU) && !defined(__clang__) && \
    (defined(__cplusplus) || !defined(__STRICT_ANSI__))
#define SHADE__TIMES(a, b) __builtin_fmaf(a, b, -0.0f)
#else
#define SHADE__TIMES(a, b) ((a) * (b))
#endif

/* SHADE_EACH_LANE(i) { ... } runs the block for i = 0 .. SHADE_LANES - 1.  Compilers turn it into
   vector code where the block is straight arithmetic on arrays indexed by i.  Without the pragma
   they would unroll the loop before they vectorise it, which is 1.5 to 2.4 times slower.  Put
   braces around the whole where it follows an if. */
#if defined(__clang__)
#define SHADE__NO_UNROLL _Pragma("clang loop unroll(disable)")
#define SHADE__UNROLL_4
#define SHADE__UNROLL_16
#elif defined(__GNUC__) && __GNUC__ >= 8
#define SHADE__NO_UNROLL _Pragma("GCC unroll 1")
#ifdef __OPTIMIZE_SIZE__
#define SHADE__UNROLL_4
#define SHADE__UNROLL_16
#else
#define SHADE__UNROLL_4 _Pragma("GCC unroll 4")
#define SHADE__UNROLL_16 _Pragma("GCC unroll 16")
#endif
#else
#define SHADE__NO_UNROLL
#define SHADE__UNROLL_4
#define SHADE__UNROLL_16
#endif
#ifdef __TINYC__
#define SHADE__COUNTER ptrdiff_t
#else
#define SHADE__COUNTER int
#endif
#ifdef __clang__    /* AVX-512 gathers take longer than loads one by one */
#define SHADE__ONE_BY_ONE _Pragma("clang loop vectorize(disable)")
#else
#define SHADE__ONE_BY_ONE
#endif
#define SHADE__FOR(i, n) SHADE__NO_UNROLL for (SHADE__COUNTER i = 0; i < (n); i++)
#define SHADE_EACH_LANE(i) SHADE__FOR(i, SHADE_LANES)

/* Between SHADE__BEGIN and SHADE__END names have C linkage, and arithmetic has the same bits under
   all options.  SHADE__BEGIN turns off the parts of -ffast-math.  It also turns off contraction,
   which rounds a * b + c once on some processors and twice on others; for gcc >>machine does that.
     gcc compiles an inlined function with the options of its caller.  So inline functions are exact
   where the implementation calls them; where you call them, SHADE__TIMES keeps their bits.
     clang still applies -ffast-math to ?: and to calls: see the #error in >>machine.
     SHADE__END restores the state before SHADE__BEGIN.  Where clang has no stack of states it
   restores the state of the command line.  MSVC restores float_control alone: after this file
   contraction stays off, which is the default of /fp:precise since 2022, but not of /fp:fast. */
#if defined(__clang__) && \
    ((__clang_major__ >= 13 && (defined(__x86_64__) || defined(__i386__))) || \
     (__clang_major__ >= 16 && defined(__aarch64__)))
#define SHADE__BEGIN _Pragma("float_control(push)") _Pragma("float_control(precise, on)") \
    _Pragma("clang fp contract(off)") SHADE__OPEN
#define SHADE__END SHADE__CLOSE _Pragma("float_control(pop)")
#elif defined(__clang__)
#define SHADE__BEGIN _Pragma("STDC FP_CONTRACT OFF") SHADE__OPEN
#define SHADE__END SHADE__CLOSE _Pragma("STDC FP_CONTRACT DEFAULT")
#elif defined(_MSC_VER)
#define SHADE__BEGIN __pragma(float_control(push)) __pragma(float_control(precise, on)) \
    __pragma(fp_contract(off)) SHADE__OPEN
#define SHADE__END SHADE__CLOSE __pragma(float_control(pop))
#elif defined(__GNUC__)
#define SHADE__BEGIN _Pragma("GCC push_options") \
    _Pragma("GCC optimize(\"no-unsafe-math-optimizations\", \"no-finite-math-only\")") \
    _Pragma("GCC optimize(\"no-associative-math\", \"no-reciprocal-math\", \"signed-zeros\")") \
    SHADE__EVAL_FLOAT SHADE__OPEN
#define SHADE__END SHADE__CLOSE _Pragma("GCC pop_options")
#else
#define SHADE__BEGIN SHADE__OPEN
#define SHADE__END SHADE__CLOSE
#endif

SHADE__BEGIN

/*------------------------------------------------------------------------------------------- >>math
   Vectors are inline; the bodies of most matrix functions stand in >>matrix.  Names without a
   suffix work on shade_vec3.  Vectors up to 1e12 and matrices up to 1e6 give finite results.
                                                                                        >>machine */

SHADE__EXPORT shade_vec2 shade_v2(float x, float y)
{
    const shade_vec2 v = { x, y };
    return v;
}

SHADE__EXPORT shade_vec3 shade_v3(float x, float y, float z)
{
    const shade_vec3 v = { x, y, z };
    return v;
}

SHADE__EXPORT shade_vec4 shade_v4(float x, float y, float z, float w)
{
    const shade_vec4 v = { x, y, z, w };
    return v;
}

/* The bit pattern of a number, and back. */
SHADE__EXPORT float shade__bits_float(uint32_t u)
{
    float f;
    SHADE_MEMCPY(&f, &u, 4);
    return f;
}

SHADE__EXPORT uint32_t shade__float_bits(float f)
{
    uint32_t u;
    SHADE_MEMCPY(&u, &f, 4);
    return u;
}

SHADE__EXPORT double shade__bits_double(uint64_t u)
{
    double d;
    SHADE_MEMCPY(&d, &u, 8);
    return d;
}

SHADE__EXPORT uint64_t shade__double_bits(double d)
{
    uint64_t u;
    SHADE_MEMCPY(&u, &d, 8);
    return u;
}

/* Square root of x > 0 in double, within 2^-51.8. */
SHADE__EXPORT double shade__root(double x)
{
    double y = shade__bits_double(0x5FE6EB50C7B537A9u - (shade__double_bits(x) >> 1));
    for (int k = 0; k < 5; k++) y *= 1.5 - 0.5 * x * y * y;
    return x * y;
}

/* The correctly rounded square root, as sqrtf gives it: the root of a float is at least 2^-51 from
   the middle between two floats, and shade__root errs by less.  Unlike sqrtf it is 0 for -0 and
   NaN. */
SHADE__EXPORT float shade__own_sqrt(float x)
{
    if (!(x > 0) || x > FLT_MAX) return x > 0 ? x : 0;
    return (float)shade__root((double)x);
}

SHADE__EXPORT float shade__sqrt(float x) { return SHADE__SQRT(x); }

/* a b, rounded before it is added to anything. */
SHADE__EXPORT float shade__times(float a, float b) { return SHADE__TIMES(a, b); }

SHADE__EXPORT shade_vec3 shade_add(shade_vec3 a, shade_vec3 b)
{
    return shade_v3(a.x + b.x, a.y + b.y, a.z + b.z);
}

SHADE__EXPORT shade_vec3 shade_sub(shade_vec3 a, shade_vec3 b)
{
    return shade_v3(a.x - b.x, a.y - b.y, a.z - b.z);
}

/* The product of each component, as of two colours. */
SHADE__EXPORT shade_vec3 shade_mul(shade_vec3 a, shade_vec3 b)
{
    return shade_v3(shade__times(a.x, b.x), shade__times(a.y, b.y), shade__times(a.z, b.z));
}

SHADE__EXPORT shade_vec3 shade_scale(shade_vec3 v, float s)
{
    return shade_v3(shade__times(v.x, s), shade__times(v.y, s), shade__times(v.z, s));
}

/* a + s b */
SHADE__EXPORT shade_vec3 shade_madd(shade_vec3 a, float s, shade_vec3 b)
{
    return shade_add(a, shade_scale(b, s));
}

SHADE__EXPORT shade_vec3 shade_neg(shade_vec3 v) { return shade_v3(-v.x, -v.y, -v.z); }
SHADE__EXPORT float shade_dot(shade_vec3 a, shade_vec3 b)
{
    return shade__times(a.x, b.x) + shade__times(a.y, b.y) + shade__times(a.z, b.z);
}

/* Right-handed: x cross y = z. */
SHADE__EXPORT shade_vec3 shade_cross(shade_vec3 a, shade_vec3 b)
{
    return shade_v3(shade__times(a.y, b.z) - shade__times(a.z, b.y),
                    shade__times(a.z, b.x) - shade__times(a.x, b.z),
                    shade__times(a.x, b.y) - shade__times(a.y, b.x));
}

/* |v|: infinity for a component beyond 1.9e19, 0 if all are below 2e-23. */
SHADE__EXPORT float shade_length(shade_vec3 v) { return shade__sqrt(shade_dot(v, v)); }
SHADE__EXPORT float shade_distance(shade_vec3 a, shade_vec3 b)
{
    return shade_length(shade_sub(a, b));
}

/* v / |v|; zero where |v| < 1e-18, and where |v|^2 overflows, from 1.8e19 on; NaN where a component
   is NaN or infinite. */
SHADE__EXPORT shade_vec3 shade_normalize(shade_vec3 v)
{
    float d = shade_dot(v, v);
    return shade_scale(v, d >= 1e-36f ? 1 / shade__sqrt(d) : 0);
}

/* a + t (b - a): exactly a at t = 0; at t = 1 b, up to the rounding of b - a.  t is not clamped. */
SHADE__EXPORT shade_vec3 shade_lerp(shade_vec3 a, shade_vec3 b, float t)
{
    return shade_madd(a, t, shade_sub(b, a));
}

/* The lesser, or the greater, of each component; b's where one of the two is NaN. */
SHADE__EXPORT float shade__minf(float a, float b) { return a < b ? a : b; }
SHADE__EXPORT float shade__maxf(float a, float b) { return a > b ? a : b; }
SHADE__EXPORT shade_vec3 shade_min(shade_vec3 a, shade_vec3 b)
{
    return shade_v3(shade__minf(a.x, b.x), shade__minf(a.y, b.y), shade__minf(a.z, b.z));
}

SHADE__EXPORT shade_vec3 shade_max(shade_vec3 a, shade_vec3 b)
{
    return shade_v3(shade__maxf(a.x, b.x), shade__maxf(a.y, b.y), shade__maxf(a.z, b.z));
}

/* max(lo, min(v, hi)) of each component; NaN in v gives hi. */
SHADE__EXPORT shade_vec3 shade_clamp(shade_vec3 v, shade_vec3 lo, shade_vec3 hi)
{
    return shade_max(shade_min(v, hi), lo);
}

/* GLSL's reflect, I - 2 (N.I) N: I points TO the surface, the result away from it.  N is unit. */
SHADE__EXPORT shade_vec3 shade_reflect(shade_vec3 incident, shade_vec3 n)
{
    return shade_madd(incident, -2 * shade_dot(n, incident), n);
}

/* The mirror direction of the books, R = 2 (N.L) N - L = reflect(-L, N): L and R both point away
   from the surface.  N is unit. */
SHADE__EXPORT shade_vec3 shade_mirror(shade_vec3 to_light, shade_vec3 n)
{
    return shade_reflect(shade_neg(to_light), n);
}

/* H = (L + V) / |L + V| of unit L and V that both point away from the surface; zero where
   |L + V|^2 < 1e-12.                                                                 [Blinn77] */
SHADE__EXPORT shade_vec3 shade_halfway(shade_vec3 to_light, shade_vec3 to_eye)
{
    shade_vec3 h = shade_add(to_light, to_eye);
    return shade_dot(h, h) < 1e-12f ? shade_v3(0, 0, 0) : shade_normalize(h);
}

/* (b - a) x (c - a) made unit: it points to the side from which a, b, c are counter-clockwise.
   Zero where b or c is a; for three points on a line zero or, by rounding, some unit vector. */
SHADE__EXPORT shade_vec3 shade_face_normal(shade_vec3 a, shade_vec3 b, shade_vec3 c)
{
    return shade_normalize(shade_cross(shade_normalize(shade_sub(b, a)),
                                       shade_normalize(shade_sub(c, a))));
}

SHADE__EXPORT shade_vec2 shade_add2(shade_vec2 a, shade_vec2 b)
{
    return shade_v2(a.x + b.x, a.y + b.y);
}

SHADE__EXPORT shade_vec2 shade_sub2(shade_vec2 a, shade_vec2 b)
{
    return shade_v2(a.x - b.x, a.y - b.y);
}

SHADE__EXPORT shade_vec2 shade_scale2(shade_vec2 v, float s)
{
    return shade_v2(shade__times(v.x, s), shade__times(v.y, s));
}

SHADE__EXPORT float shade_dot2(shade_vec2 a, shade_vec2 b)
{
    return shade__times(a.x, b.x) + shade__times(a.y, b.y);
}

SHADE__EXPORT shade_vec2 shade_lerp2(shade_vec2 a, shade_vec2 b, float t)
{
    return shade_add2(a, shade_scale2(shade_sub2(b, a), t));
}

SHADE__EXPORT shade_vec4 shade_add4(shade_vec4 a, shade_vec4 b)
{
    return shade_v4(a.x + b.x, a.y + b.y, a.z + b.z, a.w + b.w);
}

SHADE__EXPORT shade_vec4 shade_sub4(shade_vec4 a, shade_vec4 b)
{
    return shade_v4(a.x - b.x, a.y - b.y, a.z - b.z, a.w - b.w);
}

SHADE__EXPORT shade_vec4 shade_scale4(shade_vec4 v, float s)
{
    return shade_v4(shade__times(v.x, s), shade__times(v.y, s), shade__times(v.z, s),
                    shade__times(v.w, s));
}

SHADE__EXPORT float shade_dot4(shade_vec4 a, shade_vec4 b)
{
    return shade__times(a.x, b.x) + shade__times(a.y, b.y) + shade__times(a.z, b.z) +
           shade__times(a.w, b.w);
}

SHADE__EXPORT shade_vec4 shade_lerp4(shade_vec4 a, shade_vec4 b, float t)
{
    return shade_add4(a, shade_scale4(shade_sub4(b, a), t));
}

SHADE__EXPORT shade_vec3 shade__xyz(shade_vec4 v) { return shade_v3(v.x, v.y, v.z); }
SHADE__EXPORT shade_vec4 shade__xyzw(shade_vec3 v, float w) { return shade_v4(v.x, v.y, v.z, w); }
SHADE__EXPORT shade_mat3 shade__m3(shade_vec3 a, shade_vec3 b, shade_vec3 c)
{
    const shade_mat3 m = { { a, b, c } };
    return m;
}

SHADE__EXPORT shade_mat4 shade__m4(shade_vec4 a, shade_vec4 b, shade_vec4 c, shade_vec4 d)
{
    const shade_mat4 m = { { a, b, c, d } };
    return m;
}

/* The product of a matrix and a column vector, m v. */
SHADE__EXPORT shade_vec3 shade_mat3_transform(shade_mat3 m, shade_vec3 v)
{
    const shade_vec3 xy = shade_add(shade_scale(m.col[0], v.x), shade_scale(m.col[1], v.y));
    return shade_add(xy, shade_scale(m.col[2], v.z));
}

SHADE__EXPORT shade_vec4 shade_mat4_transform(shade_mat4 m, shade_vec4 v)
{
    const shade_vec4 xy = shade_add4(shade_scale4(m.col[0], v.x), shade_scale4(m.col[1], v.y));
    const shade_vec4 xyz = shade_add4(xy, shade_scale4(m.col[2], v.z));
    return shade_add4(xyz, shade_scale4(m.col[3], v.w));
}

/* The product a b, which transforms by b first, then by a. */
SHADE__EXPORT shade_mat3 shade_mat3_mul(shade_mat3 a, shade_mat3 b)
{
    for (int k = 0; k < 3; k++) b.col[k] = shade_mat3_transform(a, b.col[k]);
    return b;
}

SHADE__EXPORT shade_mat4 shade_mat4_mul(shade_mat4 a, shade_mat4 b)
{
    for (int k = 0; k < 4; k++) b.col[k] = shade_mat4_transform(a, b.col[k]);
    return b;
}

/* m (p, 1) divided by its w; not divided where w = 0. */
SHADE__EXPORT shade_vec3 shade_mat4_transform_point(shade_mat4 m, shade_vec3 p)
{
    shade_vec4 h = shade_mat4_transform(m, shade__xyzw(p, 1));
    return h.w == 0 ? shade__xyz(h) : shade_v3(h.x / h.w, h.y / h.w, h.z / h.w);
}

/* m (d, 0): translation does not move a direction.  The result is not made unit. */
SHADE__EXPORT shade_vec3 shade_mat4_transform_direction(shade_mat4 m, shade_vec3 d)
{
    return shade__xyz(shade_mat4_transform(m, shade__xyzw(d, 0)));
}

/* det(m) m^-T: its columns are cross products of the columns of m. */
SHADE__EXPORT shade_mat3 shade__cofactors(shade_mat3 m)
{
    return shade__m3(shade_cross(m.col[1], m.col[2]), shade_cross(m.col[2], m.col[0]),
                     shade_cross(m.col[0], m.col[1]));
}

/* (m^-1)^T itself, not a multiple like shade_normal_matrix.  The zero matrix where the determinant
   is 0, or where its reciprocal or an entry of the result is beyond FLT_MAX (for entries of m up to
   1e6). */
SHADE__EXPORT shade_mat3 shade_mat3_inverse_transpose(shade_mat3 m)
{
    shade_mat3 c = shade__cofactors(m);
    float det = shade_dot(m.col[0], c.col[0]), s = det != 0 ? 1 / det : 0;
    shade_vec3 a = shade_scale(c.col[0], s), b = shade_scale(c.col[1], s);
    shade_vec3 d = shade_scale(c.col[2], s), none = shade_v3(0, 0, 0);
    if (s * s <= 1e30f) return shade__m3(a, b, d);    /* |entries| <= 1e6: products below 1e28 */
    s = shade_dot(a, none) + shade_dot(b, none) + shade_dot(d, none);
    return s == 0 ? shade__m3(a, b, d) : shade__m3(none, none, none);    /* NaN: not finite */
}

/* The bodies of these stand in >>matrix.  An inverse is the zero matrix if the determinant is
   computed as 0, or if an entry or 1 / determinant is beyond FLT_MAX. */
SHADEDEF shade_mat3 shade_mat3_identity(void);
SHADEDEF shade_mat3 shade_mat3_from_mat4(shade_mat4 m);    /* the upper left 3 x 3 */
SHADEDEF shade_mat3 shade_mat3_transpose(shade_mat3 m);
SHADEDEF float      shade_mat3_determinant(shade_mat3 m);  /* col[0] . (col[1] x col[2]) */
SHADEDEF shade_mat3 shade_mat3_inverse(shade_mat3 m);      /* computed in float */
SHADEDEF shade_mat4 shade_mat4_identity(void);
SHADEDEF shade_mat4 shade_mat4_transpose(shade_mat4 m);
SHADEDEF float      shade_mat4_determinant(shade_mat4 m);  /* computed in double */
SHADEDEF shade_mat4 shade_mat4_inverse(shade_mat4 m);      /* computed in double */
SHADEDEF shade_mat4 shade_mat4_translation(shade_vec3 v);  /* takes p to p + v */
SHADEDEF shade_mat4 shade_mat4_scaling(shade_vec3 v);      /* takes p to shade_mul(p, v) */

/* degrees pi / 180 */
SHADEDEF float      shade_radians(float degrees);

/* Rotation by the right-hand rule about an axis of any length; the identity for a zero axis.  Sine
   and cosine are the library's own, exact to float rounding for |radians| < 1e5.  An angle beyond
   1e9, or NaN, counts as 0. */
SHADEDEF shade_mat4 shade_mat4_rotation(float radians, shade_vec3 axis);

/* World to eye space: eye goes to the origin, center to the -z axis, up to the upper half of the
   y-z plane.  If up is zero or parallel to the line of sight, another up is chosen.  If eye =
   center, the camera looks down -z. */
SHADEDEF shade_mat4 shade_mat4_look_at(shade_vec3 eye, shade_vec3 center, shade_vec3 up);

/* Where a view looks from: the point that it takes to the origin, computed in double.  0, 0, 0 if
   the view is singular, or not finite. */
SHADEDEF shade_vec3 shade_mat4_eye(shade_mat4 view);

/* Eye to clip space.  fovy is the whole vertical angle in radians, aspect is width / height, near
   and far (n, f) are distances along the line of sight.  l, r, b, t are the left, right, bottom and
   top sides of the view, in eye space: of frustum where it is n away, of ortho at any distance.
   perspective, frustum and ortho take z to [-w, w], as OpenGL does; near > far reverses depth.
   perspective_reversed has no far plane: z is near everywhere and w = -z_eye, so that z/w falls
   from 1 at near to 0 at infinity; use it with depth_zero_to_one and SHADE_COMPARE_GREATER.
     Degenerate input gives the matrix that takes every point to (0, 0, 2, 1), so that nothing is
   drawn: near = far, aspect = 0, left = right, bottom = top, fovy outside (0, pi), NaN, infinity,
   and near <= 0 or far <= 0, which ortho alone allows. */
SHADEDEF shade_mat4 shade_mat4_perspective(float fovy, float aspect, float near_z, float far_z);
SHADEDEF shade_mat4 shade_mat4_perspective_reversed(float fovy, float aspect, float near_z);
SHADEDEF shade_mat4 shade_mat4_frustum(float l, float r, float b, float t, float n, float f);
SHADEDEF shade_mat4 shade_mat4_ortho(float l, float r, float b, float t, float n, float f);

/* The matrix that transforms normals where m transforms points: sign(det) times the cofactors of
   the upper left 3 x 3.  It is the inverse transpose up to the positive factor |det|, and is
   defined for singular m as well: flattening keeps the normal of the plane.  Make transformed
   normals unit.  Entries are products of two of m's: for a scale of 1e-10 they are 1e-20, which
   shade_normalize takes for zero.  Pass such an m times a large number. */
SHADEDEF shade_mat3 shade_normal_matrix(shade_mat4 m);

SHADE__END
#endif /* SHADE_H */

#ifdef SHADE_IMPLEMENTATION
#ifndef SHADE__IMPLEMENTED
#define SHADE__IMPLEMENTED

/*---------------------------------------------------------------------------------------- >>machine
   What the implementation needs of compilers and processors.                              >>base */

/* No pragma keeps clang's -ffast-math away from ?: and calls, and minima and maxima would then lose
   NaN and -0. */
#if defined(__clang__) && !defined(SHADE_ALLOW_FAST_MATH) && \
    (defined(__FAST_MATH__) || (defined(__FINITE_MATH_ONLY__) && __FINITE_MATH_ONLY__ > 0))
#error "shade.h: clang's -ffast-math gives other bits; compile this file with -fno-fast-math, or \
define SHADE_ALLOW_FAST_MATH"
#endif

#ifndef SHADE_NO_STDIO
#include <stdio.h>
#ifdef _MSC_VER    /* its headers call fopen deprecated */
#define SHADE__CREATE(file, path) fopen_s(&file, path, "wb")
#else
#define SHADE__CREATE(file, path) file = fopen(path, "wb")
#endif
#endif
#ifndef SHADE_ASSERT
#ifdef SHADE_NO_LIBM
#define SHADE_ASSERT(x) ((void)0)
#else
#include <assert.h>
#define SHADE_ASSERT(x) assert(x)
#endif
#endif
#ifndef SHADE_MEMSET
#ifdef SHADE__GNU
#define SHADE_MEMSET __builtin_memset
#else
#include <string.h>
#define SHADE_MEMSET memset
#endif
#endif

SHADE__BEGIN

/* The hot loops that have a second, specialised copy; -Os has none.  bench/run.sh copies prints
   what each copy gains and how many bytes it takes.  A copy must gain 1 % of its best scene for
   every 2 kB, or it is removed. */
enum {
    SHADE__PLAIN = 1,      /* light without rows of albedo and specular */
    SHADE__LESS = 2,       /* the depth test LESS, with depth written */
    SHADE__FULL = 4,       /* tiles inside a triangle */
    SHADE__BOUNDED = 8,    /* tiles behind big triangles are skipped */
    SHADE__NARROW = 16,    /* small triangles of one column of tiles */
    SHADE__SHORT = 32,     /* runs of up to 8 pixels */
    SHADE__LONG = 64,      /* 32 pixels of a run at a time */
    SHADE__MEDIUM = 128    /* small triangles of up to four columns of tiles */
};
#ifdef __OPTIMIZE_SIZE__
#define SHADE__SPECIALIZE 0
#elif !defined(SHADE__SPECIALIZE)
#define SHADE__SPECIALIZE 255
#endif
#define SHADE__HAS(copy) (SHADE__SPECIALIZE & (copy))    /* 0: this copy is not compiled */

/* gcc would turn loops that fill rows into memset or rep stos, which costs 9 % of a flat fill.  -O2
   makes debug builds fast too.  SHADE__AS_COMPILED keeps the user's own -O, to count branches. */
#if defined(__GNUC__) && !defined(__clang__)
#if defined(__OPTIMIZE_SIZE__) || defined(SHADE__AS_COMPILED)
#pragma GCC optimize("fp-contract=off", "no-tree-loop-distribute-patterns")
#else
#pragma GCC optimize("O2", "fp-contract=off", "no-tree-loop-distribute-patterns", \
                     "no-inline-functions")
#endif
/* The Windows ABI preserves only the low half of ymm6 to ymm15.  gcc 12's -fipa-ra assumes that all
   256 bits survive a tail call into an AVX2 build, and light comes out wrong. */
#ifdef _WIN64
#pragma GCC optimize("no-ipa-ra")
#endif
#endif

#ifdef SHADE__GNU
#define SHADE__NOINLINE __attribute__((noinline))
#define SHADE__COLD __attribute__((noinline, cold))    /* cold code is a quarter smaller */
/* gcc treats a function that only cold functions call as cold, and does not vectorise it. */
#define SHADE__HOT __attribute__((noinline, hot))
#define SHADE__LOWEST_BIT __builtin_ctz
#define SHADE__UNLIKELY(x) __builtin_expect((x) != 0, 0)
typedef uint32_t __attribute__((may_alias)) shade__word;    /* reads memory of any type */
#else
#ifdef _MSC_VER
#define SHADE__NOINLINE __declspec(noinline)
#else
#define SHADE__NOINLINE
#endif
#define SHADE__COLD SHADE__NOINLINE
#define SHADE__HOT SHADE__NOINLINE
#define SHADE__LOWEST_BIT shade__lowest_bit
#define SHADE__UNLIKELY(x) (x)
typedef uint32_t shade__word;    /* compilers that do not optimise by type */
#endif

/* k = 0 .. 3, unrolled: gcc would keep the four sums of a loop in memory, which slows mipmaps. */
#define SHADE__FOR_4(k) SHADE__UNROLL_4 for (int k = 0; k < 4; k++)

/* The floats in a vector of the build for any processor. */
#ifdef __AVX512VL__
#define SHADE__ANY_WIDTH 16
#elif defined(__AVX2__)
#define SHADE__ANY_WIDTH 8
#else
#define SHADE__ANY_WIDTH 4
#endif

/* On x86-64 gcc and clang compile each hot loop up to four times from one always-inlined body: for
   any processor, for SSE4.1, for AVX2 and for AVX-512.  A call runs the best build that the
   processor supports.  All builds give the same bits, because none uses FMA.  For example,

     SHADE__DISPATCH(shade__push, (shade__draw *d, const shade__run *run, int runs), (d, run, runs),
                     shade__push_body(d, run, runs))

   becomes five functions.  Four are builds, made by SHADE__BUILD: shade__push_any,
   shade__push_sse41, shade__push_avx512 and

     __attribute__((target("avx2"))) static SHADE__HOT void
     shade__push_avx2(shade__draw *d, const shade__run *run, int runs)
     {
         enum { shade__width = 8 };
         shade__push_body(d, run, runs);
     }

   The body may use shade__width, the number of floats in a vector.  The fifth function is the one
   to call, made by SHADE__CALL_BEST:

     static void shade__push(shade__draw *d, const shade__run *run, int runs)
     {
         const int best = SHADE__LEVEL;
         if (best == 3) shade__push_avx512(d, run, runs);
         else if (best == 2) shade__push_avx2(d, run, runs);
         else if (best == 1) shade__push_sse41(d, run, runs);
         else shade__push_any(d, run, runs);
     }

   Elsewhere shade__push calls shade__push_any, the only build.  Tests define SHADE__LEVEL as an int
   expression, 0 to 3, to force a build, and SHADE__TILE_TESTED to count tested tiles. */
#ifndef SHADE__TILE_TESTED
#define SHADE__TILE_TESTED() ((void)0)
#endif
#define SHADE__BUILD(name, attribute, width, parameters, body) \
    attribute static SHADE__HOT void name parameters \
    { \
        enum { shade__width = width }; \
        body; \
    }
#if !defined(SHADE_NO_DISPATCH) && defined(__x86_64__) && defined(SHADE__GNU)
/* __builtin_cpu_supports reads __cpu_model, which the compiler's library fills before main.  zig,
   and clang for Microsoft's ABI, link libraries without it; there shade__best_build executes cpuid.
   zig defines no macro of its own, but its standard library lies beside its headers. */
#ifdef __clang__
#if defined(_MSC_VER) || __has_include(<../std/std.zig>)
#define SHADE__ASK_PROCESSOR
#endif
#endif
#ifndef SHADE__LEVEL
#ifdef SHADE__ASK_PROCESSOR
#define SHADE__LEVEL shade__best_build()
#else
#define SHADE__LEVEL \
    (__builtin_cpu_supports("avx512vl") && __builtin_cpu_supports("avx512bw") && \
     __builtin_cpu_supports("avx512dq") ? 3 : __builtin_cpu_supports("avx2") ? 2 : \
     __builtin_cpu_supports("sse4.1") ? 1 : 0)
#endif
#endif
#ifdef SHADE__ASK_PROCESSOR
/* Returns EBX of a leaf of cpuid, and sets *ecx to its ECX. */
SHADE__INLINE uint32_t shade__cpuid(uint32_t leaf, uint32_t *ecx)
{
    uint32_t ebx, edx;
    __asm__("cpuid" : "+a"(leaf), "=b"(ebx), "=c"(*ecx), "=d"(edx) : "2"(0));
    return ebx;
}

/* The build for a processor, 0 to 3 as in SHADE__LEVEL.  basic is ECX of leaf 1, features is EBX of
   leaf 7, and saved is XCR0, the registers that the operating system saves.  AVX-512 needs the
   features AVX2, F, DQ, BW and VL, and saved masks and 512-bit vectors; AVX2 needs saved 256-bit
   vectors; SSE4.1 is bit 19 of basic.                                                [Intel25] */
SHADE__INLINE int shade__build_for(uint32_t basic, uint32_t features, uint32_t saved)
{
    if (!(~features & 0xC0030020u) && !(~saved & 0xE6)) return 3;
    if ((features & 0x20) && !(~saved & 6)) return 2;
    return basic >> 19 & 1;
}

/* 1 + the build, or 0 before the first call: the only variable of the library.  In a virtual
   machine each cpuid traps and takes 5 us or more; a draw of one triangle takes less than 2 us.
   Threads that race here store the same number. */
static int shade__known_build;
/* xgetbv does not trap where OSXSAVE, bit 27 of leaf 1, is set.  Such a processor has leaf 13, and
   so leaf 7. */
static SHADE__COLD int shade__ask_processor(void)
{
    uint32_t basic, edx, saved = 0, features = shade__cpuid(7, &basic);
    int best;
    shade__cpuid(1, &basic);
    if (basic >> 27 & 1) __asm__ volatile("xgetbv" : "=a"(saved), "=d"(edx) : "c"(0));
    best = shade__build_for(basic, features, saved);
    __atomic_store_n(&shade__known_build, best + 1, __ATOMIC_RELAXED);
    return best;
}

SHADE__INLINE int shade__best_build(void)
{
    const int known = __atomic_load_n(&shade__known_build, __ATOMIC_RELAXED);
    return known ? known - 1 : shade__ask_processor();
}
#endif

#ifdef __clang__
#define SHADE__AVX512 __attribute__((target("avx512f,avx512bw,avx512dq,avx512vl")))
#else
#define SHADE__AVX512 \
    __attribute__((target("avx512f,avx512bw,avx512dq,avx512vl,prefer-vector-width=512")))
#endif
#define SHADE__CALL_BEST(name, for_sse41, for_avx512, parameters, arguments, body) \
    SHADE__BUILD(name##_any, , SHADE__ANY_WIDTH, parameters, body) \
    SHADE__BUILD(name##_avx2, __attribute__((target("avx2"))), 8, parameters, body) \
    static void name parameters \
    { \
        const int best = SHADE__LEVEL; \
        if (best == 3) for_avx512 arguments; \
        else if (best == 2) name##_avx2 arguments; \
        else if (best == 1) for_sse41 arguments; \
        else name##_any arguments; \
    }
#define SHADE__DISPATCH(name, parameters, arguments, body) \
    SHADE__BUILD(name##_sse41, __attribute__((target("sse4.1"))), SHADE__ANY_WIDTH, parameters, \
                 body) \
    SHADE__BUILD(name##_avx512, SHADE__AVX512, 16, parameters, body) \
    SHADE__CALL_BEST(name, name##_sse41, name##_avx512, parameters, arguments, body)
/* For loops that SSE4.1 makes no faster: the build for any processor serves in its place. */
#define SHADE__DISPATCH_AVX(name, parameters, arguments, body) \
    SHADE__BUILD(name##_avx512, SHADE__AVX512, 16, parameters, body) \
    SHADE__CALL_BEST(name, name##_any, name##_avx512, parameters, arguments, body)
/* For loops that AVX-512 makes no faster either: the AVX2 build serves in its place. */
#define SHADE__DISPATCH_AVX2(name, parameters, arguments, body) \
    SHADE__CALL_BEST(name, name##_any, name##_avx2, parameters, arguments, body)
#else
#define SHADE__DISPATCH(name, parameters, arguments, body) \
    SHADE__BUILD(name##_any, , SHADE__ANY_WIDTH, parameters, body) \
    static void name parameters { name##_any arguments; }
#define SHADE__DISPATCH_AVX SHADE__DISPATCH
#define SHADE__DISPATCH_AVX2 SHADE__DISPATCH
#endif

/*------------------------------------------------------------------------------------------- >>base
   The vocabulary: floats as bit patterns, selects and clamps without branches, rows of vectors.
     holds   Loops over lanes select by masks and clamp as integers, because gcc turns float selects
             into branches and leaves the loop scalar.  A mask is all ones or all zeros.
                                                                                         >>matrix */

#define SHADE__ZERO(x) SHADE_MEMSET(&(x), 0, sizeof(x))

SHADE__INLINE int shade__min(int a, int b) { return a < b ? a : b; }
SHADE__INLINE int shade__max(int a, int b) { return a > b ? a : b; }

/* 1 << i.  Shifts that differ from lane to lane do not vectorise on SSE2. */
static const uint32_t shade__bit[32] = {
    0x1, 0x2, 0x4, 0x8, 0x10, 0x20, 0x40, 0x80, 0x100, 0x200, 0x400, 0x800, 0x1000, 0x2000,
    0x4000, 0x8000, 0x10000, 0x20000, 0x40000, 0x80000, 0x100000, 0x200000, 0x400000, 0x800000,
    0x1000000, 0x2000000, 0x4000000, 0x8000000, 0x10000000, 0x20000000, 0x40000000, 0x80000000
};

/* The index of the lowest bit that is set.   pre: x != 0 */
SHADE__INLINE int shade__lowest_bit(uint32_t x)
{
    int n = 0;
    while (!(x >> n & 1)) n++;
    return n;
}

/* x where the mask is set, else +0. */
SHADE__INLINE float shade__keep(float x, uint32_t mask)
{
    return shade__bits_float(shade__float_bits(x) & mask);
}

/* b where the mask is set, else a. */
SHADE__INLINE uint32_t shade__choose(uint32_t a, uint32_t b, uint32_t mask)
{
    return a ^ ((a ^ b) & mask);
}

SHADE__INLINE float shade__select(float a, float b, uint32_t mask)
{
    return shade__bits_float(shade__choose(shade__float_bits(a), shade__float_bits(b), mask));
}

/* (float)n for n < 2^31.  SSE2 and AVX2 convert only signed integers. */
SHADE__INLINE float shade__number(uint32_t n) { return (float)(int32_t)n; }

/* |x| */
SHADE__INLINE double shade__abs(double x)
{
    return shade__bits_double(shade__double_bits(x) & 0x7FFFFFFFFFFFFFFFu);
}

SHADE__INLINE uint32_t shade__mask(int condition) { return 0u - (uint32_t)condition; }

/* The bit pattern of a float as a signed integer, and back.  Non-negative floats have the same
   order as their patterns, and all negative ones lie below them. */
SHADE__INLINE int32_t shade__ordinal(float x) { return (int32_t)shade__float_bits(x); }
SHADE__INLINE float shade__from_ordinal(int32_t i) { return shade__bits_float((uint32_t)i); }

/* clamp(x, lo, hi) by the order of bit patterns.
   pre: 0 <= lo <= hi; x is not NaN, unless its sign bit is clear: then it gives hi.  The sign of
   other NaNs differs between processors, and would choose between lo and hi */
SHADE__INLINE float shade__clamp_bits(float x, float lo, float hi)
{
    const int32_t i = shade__max(shade__ordinal(x), shade__ordinal(lo));
    return shade__from_ordinal(shade__min(i, shade__ordinal(hi)));
}

/* clamp(x, 0, 1); NaN gives 0. */
SHADE__INLINE float shade__saturate(float x)
{
    const int32_t i = shade__ordinal(shade__keep(x, shade__mask(x > 0)));
    return shade__from_ordinal(shade__min(i, 0x3F800000));
}

/* |x| <= limit, which is finite; 0 for NaN. */
SHADE__INLINE int shade__within(float x, float limit)
{
    return (int32_t)(shade__float_bits(x) & 0x7FFFFFFFu) <= shade__ordinal(limit);
}

SHADE__INLINE int shade__is_zero(shade_vec3 v)
{
    return !((shade__float_bits(v.x) | shade__float_bits(v.y) | shade__float_bits(v.z)) << 1);
}

/* shade_normalize out of line, for code outside of lane loops: it saves 160 bytes a call. */
static SHADE__NOINLINE shade_vec3 shade__unit_vector(shade_vec3 v) { return shade_normalize(v); }

/* 1/sqrt(x) for lanes, with a relative error below 1.1e-7 for normal x; other x give an arbitrary
   number.  A bit trick with a tuned Newton step [Kadlec10] is accurate to 6.5e-4; one cubic step,
   y + y e (1/2 + 3/8 e) with e = 1 - x y^2, does the rest.  sqrtf may set errno, which would keep
   the loop scalar. */
SHADE__INLINE float shade__rsqrt_normal(float x)
{
    float y = shade__bits_float(0x5F1FFFF9u - (shade__float_bits(x) >> 1)), e;
    y *= 0.703952253f * (2.38924456f - x * y * y);
    e = 1 - x * y * y;
    return y + y * e * (0.5f + 0.375f * e);
}

/* The same, but 0 for x < 1e-36: vectors shorter than 1e-18 normalise to zero. */
SHADE__INLINE float shade__rsqrt(float x)
{
    return shade__keep(shade__rsqrt_normal(x), shade__mask(x >= 1e-36f));
}

/* Three rows of floats: a vector for each lane. */
typedef struct shade__v3 { float x[SHADE_LANES], y[SHADE_LANES], z[SHADE_LANES]; } shade__v3;

/* Rows that a loop over lanes reads or writes; no two of them overlap. */
typedef const float     *SHADE_RESTRICT shade__in;
typedef const int32_t   *SHADE_RESTRICT shade__in_ints;
typedef const uint32_t  *SHADE_RESTRICT shade__in_bits;
typedef const shade__v3 *SHADE_RESTRICT shade__in_v3;
typedef float     *SHADE_RESTRICT shade__out;
typedef int32_t   *SHADE_RESTRICT shade__out_ints;
typedef uint32_t  *SHADE_RESTRICT shade__out_bits;
typedef shade__v3 *SHADE_RESTRICT shade__out_v3;

SHADE__INLINE shade_vec3 shade__at(const shade__v3 *rows, int i)
{
    return shade_v3(rows->x[i], rows->y[i], rows->z[i]);
}

SHADE__INLINE void shade__put(shade__v3 *rows, int i, shade_vec3 v)
{
    rows->x[i] = v.x;
    rows->y[i] = v.y;
    rows->z[i] = v.z;
}

/* Puts a vector into four rows, stride floats apart. */
SHADE__INLINE void shade__put4(float *rows, int stride, int i, shade_vec4 v)
{
    rows[i] = v.x;
    rows[i + stride] = v.y;
    rows[i + 2 * stride] = v.z;
    rows[i + 3 * stride] = v.w;
}

/* Three rows of floats as vectors, to read or to write.  NULL stays NULL. */
SHADE__INLINE const shade__v3 *shade__rows_in(const float *rows)
{
    return (const shade__v3 *)(const void *)rows;
}

SHADE__INLINE shade__v3 *shade__rows_out(float *rows) { return (shade__v3 *)(void *)rows; }

/* Vectors of doubles. */
SHADE__INLINE void shade__double3(shade_vec3 v, double *to)
{
    to[0] = (double)v.x;
    to[1] = (double)v.y;
    to[2] = (double)v.z;
}

static double shade__dot3(const double *a, const double *b)
{
    return a[0] * b[0] + a[1] * b[1] + a[2] * b[2];
}

/* Makes v unit, or zero where it is shorter than 1e-18. */
static void shade__unit3(double *v)
{
    double d = shade__dot3(v, v), k = d >= 1e-36 ? 1 / shade__root(d) : 0;
    for (int i = 0; i < 3; i++) v[i] *= k;
}

SHADEDEF const char *shade_result_string(shade_result result)
{
    switch (result) {
    case SHADE_OK: return "no error";
    case SHADE_ERROR_ARGUMENT:
        return "bad argument: a pointer that is NULL or not aligned to 4, NaN, a factor, sizes "
               "that do not match, an output that overlaps an input";
    case SHADE_ERROR_TARGET:
        return "bad target: width, height, stride, format, color and depth both NULL, "
               "clip_width, clip_height, row_offset, row_count";
    case SHADE_ERROR_MESH:
        return "bad mesh: positions NULL, a negative count, a stride that is negative or not a "
               "multiple of 4, chunks beyond the triangles, or indices and indices16 both set";
    case SHADE_ERROR_STATE:
        return "bad state: an unknown enumerator, transparency, alpha_cutoff, depth_bias, width, "
               "varyings, cos_crease, or a fragment shader without per-fragment shading";
    case SHADE_ERROR_LIGHTS:
        return "bad lighting: lights NULL with a light_count, unknown model, NaN spot_cos_cutoff";
    case SHADE_ERROR_TEXTURE:
        return "bad texture: pixels NULL, width, height, stride, format, wrap, filter, or "
               "lod_varying";
    case SHADE_ERROR_INDEX:
        return "bad indices: one at or past vertex_count, or not a whole number of triangles";
    case SHADE_ERROR_CAPACITY: return "not enough room in the caller's memory";
    case SHADE_ERROR_IO: return "writing failed";
    default: return "unknown result";
    }
}

/*----------------------------------------------------------------------------------------- >>matrix
   The matrix functions of >>math, by the formulas that GLM uses.
     holds   A degenerate camera takes every point to z = 2, w = 1, which is outside near or far in
             every convention of depth: nothing is drawn.                                 >>power */

/* Sine and cosine.  The argument is reduced to r = x - k pi/2.  pi/2 is split into two parts, and
   the high one has 33 bits, so that k times it is exact.  Up to |k| = 2^20 r is off by 1e-16;
   beyond, by 2^-53 of x, far less than the distance between two floats.  Floats beyond 1e9 lie 64
   or more apart, too far for an angle: they count as 0.  Taylor series on [-pi/4, pi/4] follow;
   their next terms are below 5e-17. */
static SHADE__COLD void shade__sincos(float radians, double *sine, double *cosine)
{
    if (!shade__within(radians, 1e9f)) radians = 0;
    double x = (double)radians, q = x * 0.63661977236758134;
    long long k = (long long)(q < 0 ? q - 0.5 : q + 0.5);
    double r = (x - (double)k * 1.57079632673412561417) - (double)k * 6.07710050650619224932e-11;
    double t = r * r, s, c;
    s = r + r * t * (-1 / 6.0 + t * (1 / 120.0 + t * (-1 / 5040.0 + t * (1 / 362880.0 +
        t * (-1 / 39916800.0 + t * (1 / 6227020800.0 - t / 1307674368000.0))))));
    c = 1 - t * (0.5 - t * (1 / 24.0 - t * (1 / 720.0 - t * (1 / 40320.0 - t * (1 / 3628800.0 -
        t * (1 / 479001600.0 - t * (1 / 87178291200.0 - t / 20922789888000.0)))))));
    *sine = k & 1 ? c : s;
    *cosine = k & 1 ? s : c;
    if (k & 2) *sine = -*sine;
    if ((k + 1) & 2) *cosine = -*cosine;
}

/* The 16 floats of a matrix, column by column. */
static const float *shade__entries(const shade_mat4 *m) { return (const float *)m; }

SHADEDEF float shade_radians(float degrees)
{
    return (float)((double)degrees * 0.017453292519943295769);
}

SHADEDEF shade_mat3 shade_mat3_from_mat4(shade_mat4 m)
{
    return shade__m3(shade__xyz(m.col[0]), shade__xyz(m.col[1]), shade__xyz(m.col[2]));
}

SHADEDEF shade_mat3 shade_mat3_transpose(shade_mat3 m)
{
    shade_mat3 t = m;
    for (int k = 0; k < 9; k++) ((float *)&t)[k] = ((const float *)&m)[k % 3 * 3 + k / 3];
    return t;
}

SHADEDEF float shade_mat3_determinant(shade_mat3 m)
{
    return shade_dot(m.col[0], shade_cross(m.col[1], m.col[2]));
}

SHADEDEF shade_mat3 shade_mat3_inverse(shade_mat3 m)
{
    return shade_mat3_transpose(shade_mat3_inverse_transpose(m));
}

SHADEDEF shade_mat3 shade_normal_matrix(shade_mat4 m)
{
    shade_mat3 a = shade_mat3_from_mat4(m), c = shade__cofactors(a);
    if (shade_mat3_determinant(a) < 0)
        for (int k = 0; k < 3; k++) c.col[k] = shade_neg(c.col[k]);
    return c;
}

/* m times the power of 2 that takes the greatest entry of its first three columns to 1 .. 2, so
   that its normal matrix neither vanishes nor overflows.   pre: entries below 2^127 */
static shade_mat4 shade__sized(shade_mat4 m)
{
    float *entry = (float *)&m;
    int most = 0;
    for (int k = 0; k < 12; k++)
        most = shade__max(most, shade__ordinal(entry[k]) & 0x7F800000);
    for (int k = 0; k < 12; k++) entry[k] *= shade__from_ordinal(0x7F000000 - most);
    return m;
}

/* shade_mat4_mul as a call: one copy of its code. */
static SHADE__NOINLINE shade_mat4 shade__mat4_product(const shade_mat4 *a, const shade_mat4 *b)
{
    return shade_mat4_mul(*a, *b);
}

SHADEDEF shade_mat4 shade_mat4_scaling(shade_vec3 v)
{
    return shade__m4(shade_v4(v.x, 0, 0, 0), shade_v4(0, v.y, 0, 0),
                     shade_v4(0, 0, v.z, 0), shade_v4(0, 0, 0, 1));
}

SHADEDEF shade_mat4 shade_mat4_identity(void) { return shade_mat4_scaling(shade_v3(1, 1, 1)); }

/* A matrix that was never filled in, all of it zero, counts as the identity. */
static shade_mat4 shade__or_identity(shade_mat4 m)
{
    for (int k = 0; k < 16; k++)
        if (shade__entries(&m)[k] != 0) return m;
    return shade_mat4_identity();
}

SHADEDEF shade_mat3 shade_mat3_identity(void)
{
    return shade_mat3_from_mat4(shade_mat4_identity());
}

SHADEDEF shade_mat4 shade_mat4_translation(shade_vec3 v)
{
    shade_mat4 m = shade_mat4_identity();
    m.col[3] = shade__xyzw(v, 1);
    return m;
}

SHADEDEF shade_mat4 shade_mat4_transpose(shade_mat4 m)
{
    shade_mat4 t = m;
    for (int k = 0; k < 16; k++) ((float *)&t)[k] = shade__entries(&m)[k % 4 * 4 + k / 4];
    return t;
}

static void shade__doubles(const float *from, int n, double *to)
{
    for (int k = 0; k < n; k++) to[k] = (double)from[k];
}

static shade_mat4 shade__mat4_of(const double e[16])
{
    float entry[16];
    shade_mat4 m;
    for (int k = 0; k < 16; k++) entry[k] = (float)e[k];
    SHADE_MEMCPY(&m, entry, sizeof m);
    return m;
}

/* The 2 x 2 minors of columns a and b, in rows xy xz xw yz yw zw. */
static void shade__minors(const double *a, const double *b, double *m)
{
    for (int i = 0; i < 3; i++)
        for (int k = i + 1; k < 4; k++) *m++ = a[i] * b[k] - b[i] * a[k];
}

/* Writes the entries e and the minors s of columns 0 and 1, c of columns 2 and 3; returns the
   determinant. */
static double shade__expand(const shade_mat4 *m, double *e, double *s, double *c)
{
    shade__doubles(shade__entries(m), 16, e);
    shade__minors(e, e + 4, s);
    shade__minors(e + 8, e + 12, c);
    return s[0] * c[5] - s[1] * c[4] + s[2] * c[3] + s[3] * c[2] - s[4] * c[1] + s[5] * c[0];
}

SHADEDEF float shade_mat4_determinant(shade_mat4 m)
{
    double e[16], s[6], c[6];
    return (float)shade__expand(&m, e, s, c);
}

static int shade__is_finite(const shade_mat4 *m)
{
    for (int k = 0; k < 16; k++)
        if (!shade__within(shade__entries(m)[k], FLT_MAX)) return 0;
    return 1;
}

/* The matrix with these entries.  Where good is 0 or an entry is not finite, as after a division by
   zero: the degenerate camera, or with w = 0 the zero matrix. */
static shade_mat4 shade__finite_or(int good, const double e[16], float w)
{
    shade_mat4 none, m = shade__mat4_of(e);
    SHADE__ZERO(none);
    none.col[3] = shade_v4(0, 0, 2 * w, w);
    return good && shade__is_finite(&m) ? m : none;
}

/* Cramer's rule.  Columns come in pairs, 0 with 1 and 2 with 3: row i of the inverse is made of
   column i ^ 1 and the minors of the other pair.  A determinant of 0 leaves no entry finite.  Not
   inlined: gcc 12's SLP vectoriser loses the rounding to float where two neighbouring values go
   double -> float -> double, as they would after inlining. */
SHADEDEF SHADE__NOINLINE shade_mat4 shade_mat4_inverse(shade_mat4 m)
{
    double e[16], inverse[16], s[6], c[6], k = 1 / shade__expand(&m, e, s, c);
    for (int i = 0; i < 4; i++) {
        const double *v = e + 4 * (i ^ 1), *o = i < 2 ? c : s;
        const double sign = 1 - 2 * (i & 1);
        const double x = sign * v[0], y = sign * v[1], z = sign * v[2], w = sign * v[3];
        double *row = inverse + i;
        row[0] = (y * o[5] - z * o[4] + w * o[3]) * k;
        row[4] = (-x * o[5] + z * o[2] - w * o[1]) * k;
        row[8] = (x * o[4] - y * o[2] + w * o[0]) * k;
        row[12] = (-x * o[3] + y * o[1] - z * o[0]) * k;
    }
    return shade__finite_or(1, inverse, 0);
}

SHADEDEF shade_vec3 shade_mat4_eye(shade_mat4 view)
{
    return shade_mat4_transform_point(shade_mat4_inverse(view), shade_v3(0, 0, 0));
}

/* Rodrigues' formula: c 1 + s [a]x + (1 - c) a a^T, with a the unit axis. */
SHADEDEF shade_mat4 shade_mat4_rotation(float radians, shade_vec3 axis)
{
    double sine, cosine;
    float c;
    shade_vec3 a = shade__unit_vector(axis), s, t;
    if (shade__is_zero(a)) return shade_mat4_identity();
    shade__sincos(radians, &sine, &cosine);
    c = (float)cosine;
    s = shade_scale(a, (float)sine);
    t = shade_scale(a, (float)(1 - cosine));
    return shade__m4(shade__xyzw(shade_madd(shade_v3(c, s.z, -s.y), t.x, a), 0),
                     shade__xyzw(shade_madd(shade_v3(-s.z, c, s.x), t.y, a), 0),
                     shade__xyzw(shade_madd(shade_v3(s.y, -s.x, c), t.z, a), 0),
                     shade_v4(0, 0, 0, 1));
}

SHADEDEF shade_mat4 shade_mat4_look_at(shade_vec3 eye, shade_vec3 center, shade_vec3 up)
{
    shade_vec3 f = shade__unit_vector(shade_sub(center, eye)), r, u;
    if (shade__is_zero(f)) f = shade_v3(0, 0, -1);
    r = shade__unit_vector(shade_cross(f, shade__unit_vector(up)));
    if (shade__is_zero(r)) {     /* replace up by an axis far from f */
        up = f.y * f.y < 0.5f ? shade_v3(0, 1, 0) : shade_v3(0, 0, 1);
        r = shade__unit_vector(shade_cross(f, up));
    }
    /* where up was nearly parallel to f, r is not yet at a right angle to it */
    r = shade__unit_vector(shade_madd(r, -shade_dot(r, f), f));
    u = shade_cross(r, f);
    return shade__m4(shade_v4(r.x, u.x, -f.x, 0), shade_v4(r.y, u.y, -f.y, 0),
                     shade_v4(r.z, u.z, -f.z, 0),
                     shade_v4(-shade_dot(r, eye), -shade_dot(u, eye), shade_dot(f, eye), 1));
}

/* A perspective that maps eye coordinate z to depth (scale z + offset) / -z.  In it y stands for
   1 / tan(fovy / 2). */
static shade_mat4 shade__perspective(float fovy, float aspect, int good, double scale,
                                     double offset)
{
    double s, c;
    shade__sincos(fovy / 2, &s, &c);
    good = good && fovy > 0 && fovy < 3.2f && c > 0 && shade__within(aspect, FLT_MAX);
    const double y = c / s;
    const double e[16] = { y / (double)aspect, 0, 0, 0, 0, y, 0, 0,
                           0, 0, scale, -1, 0, 0, offset, 0 };
    return shade__finite_or(good, e, 1);
}

SHADEDEF shade_mat4 shade_mat4_perspective(float fovy, float aspect, float near_z, float far_z)
{
    const double n = (double)near_z, f = (double)far_z, d = n - f;
    return shade__perspective(fovy, aspect, n > 0 && f > 0, (n + f) / d, 2 * n * f / d);
}

SHADEDEF shade_mat4 shade_mat4_perspective_reversed(float fovy, float aspect, float near_z)
{
    return shade__perspective(fovy, aspect, near_z > 0, 0, (double)near_z);
}

/* The projection of a box in eye space, or of the frustum on the box's near face.  side: left,
   right, bottom, top, near, far. */
static shade_mat4 shade__box_projection(int frustum, const float side[6])
{
    double v[6], e[16] = { 0 };
    shade__doubles(side, 6, v);
    const double w = v[1] - v[0], h = v[3] - v[2], n = v[4], f = v[5], d = n - f;
    const double x = (v[1] + v[0]) / w, y = (v[3] + v[2]) / h, z = (n + f) / d;
    const double k = frustum ? 2 * n : 2;
    double *column = e + (frustum ? 8 : 12);
    e[0] = k / w;
    e[5] = k / h;
    column[0] = frustum ? x : -x;
    column[1] = frustum ? y : -y;
    column[2] = z;
    column[3] = frustum ? -1 : 1;
    e[frustum ? 14 : 10] = frustum ? k * f / d : k / d;
    return shade__finite_or(!frustum || (n > 0 && f > 0), e, 1);
}

SHADEDEF shade_mat4 shade_mat4_frustum(float l, float r, float b, float t, float n, float f)
{
    const float side[6] = { l, r, b, t, n, f };
    return shade__box_projection(1, side);
}

SHADEDEF shade_mat4 shade_mat4_ortho(float l, float r, float b, float t, float n, float f)
{
    const float side[6] = { l, r, b, t, n, f };
    return shade__box_projection(0, side);
}

/*------------------------------------------------------------------------------------------ >>power
   x^n = 2^(-u), u = -n log2 x, without libm: the same bits everywhere, and loops over lanes that
   vectorise.
     in      x in [0, 1], n >= 0          out  a value in [0, 1], absolute error below 5e-7
     method  minimax polynomials.  log2(1 + f) = f P(f) on [sqrt(1/2) - 1, sqrt(2) - 1]: P has the
             least error relative to -log2 x, which stays below 1e-6 in floats.  A power turns
             that into at most 1e-6 / e.  Two degrees more would give 2.7e-8 and cost 4 to 7 % of
             lit packets.  2^-r = 1 + r Q(r) on [-1/2, 1/2]: relative error 1.1e-7, in floats 2e-7.
             All figures were measured over all floats in [0, 1].                        >>pixels */

/* -log2 x for x >= 0 that is not subnormal; 127 for x = 0, -128 for infinity.  The addend carries
   into the exponent for a mantissa of sqrt(2) and above: near x = 1 the exponent part is 0, and no
   digit is lost.   post: >= 0 for x <= 1, finite for any bits */
SHADE__INLINE float shade__neg_log2(float x)
{
    uint32_t t = shade__float_bits(x) + (0x3F800000u - 0x3F3504F3u);
    float f = shade__bits_float((t & 0x007FFFFFu) + 0x3F3504F3u) - 1, p = 0.179595634f;
    p = p * f - 0.274312615f;
    p = p * f + 0.294831961f;
    p = p * f - 0.358653575f;
    p = p * f + 0.480665863f;
    p = p * f - 0.721388757f;
    p = p * f + 1.4426949f;
    return 127 - shade__number(t >> 23) - f * p;
}

/* 2^-u for u >= 0, infinity included; exactly 1 at 0, exactly 0 from 126 on.   post: 0 .. 1 */
SHADE__INLINE float shade__exp2_neg(float u)
{
    const uint32_t some = shade__mask(shade__ordinal(u) < 0x42FC0000);    /* 126 */
    float v = shade__keep(u, some), r, q = -0.00132647273f;
    int32_t k = (int32_t)(v + 0.5f);
    r = v - (float)k;
    q = q * r + 0.00967151299f;
    q = q * r - 0.0555073358f;
    q = q * r + 0.240222424f;
    q = q * r - 0.693147004f;
    q = q * r + 1;
    return shade__keep(shade__bits_float(shade__float_bits(q) - ((uint32_t)k << 23)), some);
}

/* Marks a missing cosine: x^n is 0 for it, even for n = 0. */
#define SHADE__NEVER (-2.0f)

/* n times -log2(min(x, 1)), for shade__exp2_neg.  For x <= least it is 126, which gives 0; least is
   0 for n > 0, and SHADE__NEVER for n = 0.   pre: n >= 0, finite */
SHADE__INLINE float shade__power_log(float x, float n)
{
    const float least = shade__keep(SHADE__NEVER, shade__mask(!(n > 0)));
    const int32_t i = shade__min(shade__ordinal(x), 0x3F800000);
    const float u = n * shade__neg_log2(shade__from_ordinal(i));
    return shade__select(126.0f, u, shade__mask(x > least));
}

SHADEDEF float shade_power(float x, float n)
{
    float c = shade__saturate(x), subnormal = 0;
    if (!(n > 0)) return 1;
    if (!shade__within(n, FLT_MAX)) n = FLT_MAX;
    if (c > 0 && c < FLT_MIN) {    /* c 2^24 is normal; from n = 8 on the result is 0 anyway */
        c *= 16777216;
        subnormal = 24 * shade__minf(n, 8);
    }
    return shade__exp2_neg(shade__power_log(c, n) + subnormal);
}

/*----------------------------------------------------------------------------------------- >>pixels
   Display colours, linear light, and how each format stores a pixel.
     in      bytes of any format, or linear floats          out  linear floats, or a stored pixel
     holds   A new packed format of 1 or 2 bytes, or of four channels of 8 bits, is an enumerator
             and an entry of shade__layouts.
     source  sRGB curve [IEC61966]                                                        >>lamps */

/* From linear light to sRGB and back in two steps, the logarithm and the curve.  Each step gets its
   own loop over lanes: one loop for both has more constants than registers, and one lit triangle in
   RGB565 takes 1.1 to 1.2 times as long.
   pre: 0 <= c <= 1   post: 0 <= result <= 1 (tried with every such float) */
SHADE__INLINE float shade__encode_log(float c) { return shade__neg_log2(c) * (1 / 2.4f); }

SHADE__INLINE float shade__encode_curve(float c, float u)
{
    const float curve = 1.055f * shade__exp2_neg(u) - 0.055f;
    return shade__select(12.92f * c, curve, shade__mask(c > 0.0031308f));
}

SHADE__INLINE float shade__decode_log(float c)
{
    return shade__neg_log2((c + 0.055f) * (1 / 1.055f)) * 2.4f;
}

SHADE__INLINE float shade__decode_curve(float c, float u)
{
    return shade__select(c * (1 / 12.92f), shade__exp2_neg(u), shade__mask(c > 0.04045f));
}

/* The same with c clamped, out of line, for code outside of lane loops. */
static SHADE__NOINLINE float shade__encode(float c)
{
    c = shade__saturate(c);
    return shade__encode_curve(c, shade__encode_log(c));
}

static SHADE__NOINLINE float shade__decode(float c)
{
    c = shade__saturate(c);
    return shade__decode_curve(c, shade__decode_log(c));
}

SHADEDEF shade_vec3 shade_srgb_from_linear(shade_vec3 linear)
{
    return shade_v3(shade__encode(linear.x), shade__encode(linear.y), shade__encode(linear.z));
}

SHADEDEF shade_vec3 shade_linear_from_srgb(shade_vec3 display)
{
    return shade_v3(shade__decode(display.x), shade__decode(display.y), shade__decode(display.z));
}

SHADEDEF shade_vec3 shade_rgb(uint32_t rrggbb)
{
    const shade_vec3 display = shade_v3((float)(rrggbb >> 16 & 255) / 255,
                                        (float)(rrggbb >> 8 & 255) / 255,
                                        (float)(rrggbb & 255) / 255);
    return shade_linear_from_srgb(display);
}

/* How a format stores a pixel.  A packed pixel is an integer of up to 32 bits.  Its channel k (R,
   G, B, A) is pixel >> shade__shift(l, k) & full[k]; on little-endian processors colours lie below
   bit 31, because shade__texel reads them in place as a signed number.  A channel that the format
   lacks is 1: one bit above the stored ones, set by shade__load_packed.  RGBA32F uses only the
   field bytes. */
typedef struct shade__layout {
    uint8_t bytes;       /* of a pixel in memory */
    uint8_t swapped;     /* non-zero: its two bytes are not in the processor's order */
    uint8_t shift[4];
    uint8_t full[4];     /* the value of each channel that means 1 */
} shade__layout;

static const shade__layout shade__layouts[] = {    /* in the order of shade_format */
    { 4, 0, { 0, 8, 16, 24 }, { 255, 255, 255, 255 } },    /* RGBA8 */
    { 4, 0, { 16, 8, 0, 24 }, { 255, 255, 255, 255 } },    /* BGRA8 */
    { 2, 0, { 11, 5, 0, 16 }, { 31, 63, 31, 1 } },         /* RGB565 */
    { 2, 1, { 11, 5, 0, 16 }, { 31, 63, 31, 1 } },         /* RGB565_SWAPPED */
    { 16, 0, { 0, 0, 0, 0 }, { 1, 1, 1, 1 } },             /* RGBA32F */
    { 1, 0, { 8, 8, 8, 0 }, { 1, 1, 1, 255 } }             /* A8 */
};

/* 1 if an enumerator lies in 0 .. last.  The sign of an enumeration depends on the compiler. */
#define SHADE__KNOWN(value, last) ((unsigned)(value) <= (unsigned)(last))

SHADE__INLINE int shade__is_format(shade_format format)
{
    return (unsigned)format < sizeof shade__layouts / sizeof *shade__layouts;
}

static size_t shade__pixel_bytes(shade_format format) { return shade__layouts[format].bytes; }

/* 1 if the processor stores the low byte of an integer first. */
SHADE__INLINE int shade__low_byte_first(void)
{
    const uint32_t one = 1;
    uint8_t first;
    SHADE_MEMCPY(&first, &one, 1);
    return first;
}

/* The lowest bit of channel k in a packed pixel.  Pixels of 4 bytes are bytes in memory order, and
   big-endian processors have the first byte on top. */
SHADE__INLINE int shade__shift(const shade__layout *l, int k)
{
    return l->bytes == 4 && !shade__low_byte_first() ? 24 - l->shift[k] : l->shift[k];
}

/* Channel k of a packed pixel as a number from 0 to full. */
SHADE__INLINE float shade__channel(uint32_t packed, const shade__layout *l, int k)
{
    return shade__number(packed >> shade__shift(l, k) & l->full[k]);
}

/* 1 if colours are stored as sRGB: floats never are, and A8 has no colours. */
SHADE__INLINE int shade__is_encoded(int srgb, const shade__layout *l)
{
    return srgb && l->full[0] > 1;
}

/* The low two bytes of u, exchanged. */
SHADE__INLINE uint32_t shade__swap16(uint32_t u) { return (u >> 8 & 255) | (u & 255) << 8; }

/* Loads a packed pixel.  In 1 or 2 bytes, the bit above them is set.  4 bytes may also be the bits
   of a float. */
SHADE__INLINE uint32_t shade__load_packed(const uint8_t *p, const int bytes, const int swapped)
{
    uint32_t word;
    uint16_t half;
    if (bytes == 2) {
        SHADE_MEMCPY(&half, p, 2);
        return (swapped ? shade__swap16(half) : half) | 0x10000;
    }
    if (bytes == 1) return *p | 0x100u;
    SHADE_MEMCPY(&word, p, 4);
    return word;
}

/* Loads a pixel in packed form, or its four floats into rows that are SHADE_LANES apart. */
SHADE__INLINE void shade__load_pixel(const shade__layout *l, const uint8_t *p, uint32_t *packed,
                                     float *rgba)
{
    if (l->bytes < 16) *packed = shade__load_packed(p, l->bytes, l->swapped);
    else
        SHADE__FOR_4(k) SHADE_MEMCPY(rgba + k * SHADE_LANES, p + 4 * k, 4);
}

/* Stores a pixel from its packed form, or from four rows of floats that are SHADE_LANES apart. */
SHADE__INLINE void shade__store_pixel(const shade__layout *l, uint8_t *p, uint32_t packed,
                                      const float *rgba)
{
    const uint16_t half = (uint16_t)(l->swapped ? shade__swap16(packed) : packed);
    if (l->bytes == 4) SHADE_MEMCPY(p, &packed, 4);
    else if (l->bytes == 2) SHADE_MEMCPY(p, &half, 2);
    else if (l->bytes == 1) *p = (uint8_t)packed;
    else
        SHADE__FOR_4(k) SHADE_MEMCPY(p + 4 * k, rgba + k * SHADE_LANES, 4);
}

/* The number of rows of the picture in the target's memory. */
SHADE__INLINE int shade__rows_held(const shade_target *t)
{
    return t->row_count ? t->row_count : t->height;
}

SHADE__INLINE int shade__stride_of(const shade_target *t)
{
    return t->stride ? t->stride : t->width;
}

/* The index of pixel (x, y) in color and depth. */
SHADE__INLINE size_t shade__offset_of(const shade_target *t, int x, int y)
{
    return (size_t)(y - t->row_offset) * (size_t)shade__stride_of(t) + (size_t)x;
}

/* The first byte of pixel `index`. */
SHADE__INLINE uint8_t *shade__pixel(uint8_t *color, size_t index, size_t bytes)
{
    return color + index * bytes;
}

/* ---- tables of numbers */

/* The bytes of sRGB targets, floor(255 encode(c) + 1/2), by table; shade__pack_bytes reads it.
   Halving the bit pattern of c gives a rough square root; that root times 372, rounded down, is the
   number of the cell.  The first entry is for cell 4, the last for cell 372.  Within a cell the
   byte changes at most once.  The entry has the low 24 bits of the first float after the change,
   and above them the byte of that float.  For example, in the last cell 0xFF7EDC0E means 255 from
   the float 0x3F7EDC0E on, and 254 before.  If bit 23 of c minus the entry is set, c lies before
   that float, and its byte is one less.  A cell without a change has the entry of another cell,
   with a change fewer than 2^23 floats away.  An sRGB picture of a teapot takes .95 of the time
   with AVX-512, and .81 with AVX2 and SSE2. */
static const uint32_t shade__byte_steps[] = {
    0x011F22B3u, 0x011F22B3u, 0x02EEB40Eu, 0x02EEB40Eu, 0x02EEB40Eu, 0x02EEB40Eu, 0x0346EB61u,
    0x0346EB61u, 0x048B3E5Du, 0x05B3070Bu, 0x05B3070Bu, 0x06DACFB7u, 0x06DACFB7u, 0x07014C32u,
    0x08153089u, 0x092914DFu, 0x0A3CF936u, 0x0B50F2CBu, 0x0C65FB9Au, 0x0D7C3404u, 0x0E89D064u,
    0x0F96233Au, 0x10A314BBu, 0x11B0A736u, 0x12BEDCB9u, 0x12BEDCB9u, 0x13CDB76Cu, 0x14DD3966u,
    0x14DD3966u, 0x15ED64ACu, 0x16FE3B45u, 0x1707DF94u, 0x1810F91Cu, 0x191A6B35u, 0x1A2436C3u,
    0x1B2E5CCBu, 0x1C38DE1Du, 0x1D43BBA7u, 0x1E4EF641u, 0x1F5A8EE1u, 0x20668654u, 0x2172DD74u,
    0x227F9513u, 0x23865704u, 0x248D1493u, 0x248D1493u, 0x25940399u, 0x269B247Fu, 0x27A277A8u,
    0x27A277A8u, 0x28A9FD78u, 0x29B1B65Bu, 0x2AB9A29Cu, 0x2AB9A29Cu, 0x2BC1C2ACu, 0x2CCA16E8u,
    0x2CCA16E8u, 0x2DD29FA7u, 0x2DD29FA7u, 0x2EDB5D4Eu, 0x2FE45035u, 0x2FE45035u, 0x30ED78B9u,
    0x30ED78B9u, 0x31F6D735u, 0x320035FDu, 0x33051BB5u, 0x340A1CEFu, 0x350F39D6u, 0x3614728Fu,
    0x3719C746u, 0x381F382Cu, 0x3924C565u, 0x3A2A6F25u, 0x3B30358Cu, 0x3C3618BCu, 0x3D3C18ECu,
    0x3E423639u, 0x3F4870CCu, 0x3F4870CCu, 0x404EC8D5u, 0x41553E75u, 0x425BD1D3u, 0x4362831Du,
    0x4469526Du, 0x4469526Du, 0x45703FF2u, 0x46774BCBu, 0x477E7627u, 0x477E7627u, 0x4882DF92u,
    0x49869374u, 0x4A8A56CDu, 0x4A8A56CDu, 0x4B8E29AEu, 0x4C920C2Bu, 0x4D95FE52u, 0x4D95FE52u,
    0x4E9A0038u, 0x4F9E11EBu, 0x4F9E11EBu, 0x50A23381u, 0x51A6650Eu, 0x51A6650Eu, 0x52AAA6A0u,
    0x52AAA6A0u, 0x53AEF84Au, 0x54B35A16u, 0x54B35A16u, 0x55B7CC1Cu, 0x56BC4E6Eu, 0x56BC4E6Eu,
    0x57C0E116u, 0x57C0E116u, 0x58C58429u, 0x59CA37B7u, 0x59CA37B7u, 0x5ACEFBD2u, 0x5ACEFBD2u,
    0x5BD3D08Du, 0x5BD3D08Du, 0x5CD8B5F6u, 0x5CD8B5F6u, 0x5DDDAC18u, 0x5EE2B30Du, 0x5EE2B30Du,
    0x5FE7CADBu, 0x5FE7CADBu, 0x60ECF398u, 0x60ECF398u, 0x61F22D55u, 0x61F22D55u, 0x62F7781Fu,
    0x62F7781Fu, 0x63FCD403u, 0x6401208Au, 0x6503DFB2u, 0x6606A780u, 0x670977FAu, 0x680C512Cu,
    0x680C512Cu, 0x690F3319u, 0x6A121DCBu, 0x6B15114Au, 0x6C180D9Bu, 0x6D1B12C4u, 0x6E1E20D2u,
    0x6F2137C9u, 0x702457B5u, 0x71278097u, 0x71278097u, 0x722AB279u, 0x732DED66u, 0x74313163u,
    0x75347E6Eu, 0x7637D49Eu, 0x7637D49Eu, 0x773B33F0u, 0x783E9C69u, 0x79420E15u, 0x7A4588FBu,
    0x7A4588FBu, 0x7B490D21u, 0x7C4C9A8Eu, 0x7D50314Au, 0x7E53D15Bu, 0x7E53D15Bu, 0x7F577AC9u,
    0x805B2D97u, 0x815EE9D3u, 0x815EE9D3u, 0x8262AF7Eu, 0x83667E9Eu, 0x83667E9Eu, 0x846A5742u,
    0x856E3967u, 0x86722516u, 0x86722516u, 0x87761A57u, 0x887A1930u, 0x887A1930u, 0x897E21A9u,
    0x8A8119E3u, 0x8A8119E3u, 0x8B8327CAu, 0x8C853A89u, 0x8C853A89u, 0x8D875225u, 0x8E896EA1u,
    0x8E896EA1u, 0x8F8B9000u, 0x908DB646u, 0x908DB646u, 0x918FE176u, 0x918FE176u, 0x92921191u,
    0x9394469Cu, 0x9394469Cu, 0x9496809Au, 0x9598BF8Du, 0x9598BF8Du, 0x969B037Au, 0x969B037Au,
    0x979D4C62u, 0x989F9A4Au, 0x989F9A4Au, 0x99A1ED35u, 0x99A1ED35u, 0x9AA44526u, 0x9AA44526u,
    0x9BA6A222u, 0x9CA90429u, 0x9CA90429u, 0x9DAB6B41u, 0x9DAB6B41u, 0x9EADD76Bu, 0x9EADD76Bu,
    0x9FB048ABu, 0xA0B2BF02u, 0xA0B2BF02u, 0xA1B53A6Du, 0xA1B53A6Du, 0xA2B7BB01u, 0xA2B7BB01u,
    0xA3BA40B2u, 0xA3BA40B2u, 0xA4BCCB86u, 0xA4BCCB86u, 0xA5BF5B82u, 0xA6C1F0A7u, 0xA6C1F0A7u,
    0xA7C48AF7u, 0xA7C48AF7u, 0xA8C72A7Au, 0xA8C72A7Au, 0xA9C9CF2Eu, 0xA9C9CF2Eu, 0xAACC791Au,
    0xAACC791Au, 0xABCF283Du, 0xABCF283Du, 0xACD1DC9Eu, 0xACD1DC9Eu, 0xADD4963Du, 0xADD4963Du,
    0xAED75520u, 0xAED75520u, 0xAFDA1945u, 0xAFDA1945u, 0xB0DCE2B3u, 0xB0DCE2B3u, 0xB1DFB169u,
    0xB1DFB169u, 0xB2E2856Du, 0xB2E2856Du, 0xB3E55EBDu, 0xB3E55EBDu, 0xB4E83D63u, 0xB4E83D63u,
    0xB5EB215Bu, 0xB5EB215Bu, 0xB6EE0AAEu, 0xB6EE0AAEu, 0xB6EE0AAEu, 0xB7F0F95Bu, 0xB7F0F95Bu,
    0xB8F3ED68u, 0xB8F3ED68u, 0xB9F6E6D4u, 0xB9F6E6D4u, 0xBAF9E5A4u, 0xBAF9E5A4u, 0xBBFCE9DDu,
    0xBBFCE9DDu, 0xBCFFF37Bu, 0xBCFFF37Bu, 0xBD018145u, 0xBE030B81u, 0xBF049877u, 0xC0062827u,
    0xC107BA93u, 0xC2094FBBu, 0xC30AE7A1u, 0xC30AE7A1u, 0xC40C8247u, 0xC50E1FAEu, 0xC60FBFD6u,
    0xC71162C3u, 0xC8130873u, 0xC8130873u, 0xC914B0EAu, 0xCA165C27u, 0xCB180A2Eu, 0xCC19BAFDu,
    0xCD1B6E99u, 0xCD1B6E99u, 0xCE1D2501u, 0xCF1EDE38u, 0xD0209A3Cu, 0xD1225912u, 0xD1225912u,
    0xD2241ABAu, 0xD325DF36u, 0xD427A687u, 0xD427A687u, 0xD52970AFu, 0xD62B3DADu, 0xD72D0D87u,
    0xD72D0D87u, 0xD82EE038u, 0xD930B5C3u, 0xDA328E2Au, 0xDA328E2Au, 0xDB34696Au, 0xDC36478Eu,
    0xDD382892u, 0xDD382892u, 0xDE3A0C78u, 0xDF3BF33Fu, 0xE03DDCEAu, 0xE03DDCEAu, 0xE13FC979u,
    0xE241B8EFu, 0xE241B8EFu, 0xE343AB4Bu, 0xE445A091u, 0xE445A091u, 0xE54798C0u, 0xE64993DBu,
    0xE74B91E2u, 0xE74B91E2u, 0xE84D92D8u, 0xE94F96BCu, 0xE94F96BCu, 0xEA519D91u, 0xEB53A756u,
    0xEB53A756u, 0xEC55B40Fu, 0xED57C3BCu, 0xED57C3BCu, 0xEE59D65Eu, 0xEF5BEBF5u, 0xEF5BEBF5u,
    0xF05E0485u, 0xF160200Du, 0xF160200Du, 0xF2623E91u, 0xF364600Cu, 0xF364600Cu, 0xF4668487u,
    0xF4668487u, 0xF568ABFBu, 0xF66AD672u, 0xF66AD672u, 0xF76D03E4u, 0xF86F345Cu, 0xF86F345Cu,
    0xF97167D1u, 0xF97167D1u, 0xFA739E4Eu, 0xFB75D7CBu, 0xFB75D7CBu, 0xFC781452u, 0xFD7A53DBu,
    0xFD7A53DBu, 0xFE7C9671u, 0xFE7C9671u, 0xFF7EDC0Eu, 0xFF7EDC0Eu
};

/* The linear light of sRGB maps: shade__decode(v * (1 / full)) for v = 0 .. full, with full 31,
   then 63, then 255.  Without the table such maps take 1.6 to 2.6 times as long.  Blending and
   >>image use v / full instead, which rounds differently for half of the values. */
static const float shade__map_light[] = {
    /* of 5 bits */
    0.0f, 0.002496754f, 0.005370535f, 0.009529466f, 0.015133498f, 0.022298891f, 0.031130087f,
    0.041722555f, 0.05416453f, 0.06853846f, 0.084921464f, 0.103386834f, 0.12400404f, 0.14683922f,
    0.1719559f, 0.19941482f, 0.2292746f, 0.26159173f, 0.29642117f, 0.33381578f, 0.3738262f,
    0.41650215f, 0.4618934f, 0.5100463f, 0.561007f, 0.6148205f, 0.67153054f, 0.73117995f,
    0.7938106f, 0.8594641f, 0.92818093f, 1.0f,
    /* of 6 bits */
    0.0f, 0.0012285616f, 0.0024571232f, 0.0037251292f, 0.005260758f, 0.007113466f, 0.009299629f,
    0.011834532f, 0.0147324195f, 0.01800686f, 0.021670656f, 0.025735997f, 0.030214584f,
    0.035117615f, 0.040455855f, 0.046239696f, 0.05247916f, 0.059184093f, 0.06636382f, 0.07402735f,
    0.08218383f, 0.090841666f, 0.10000957f, 0.109695666f, 0.11990798f, 0.13065435f, 0.14194246f,
    0.15377991f, 0.16617416f, 0.17913225f, 0.19266148f, 0.20676865f, 0.22146069f, 0.23674424f,
    0.25262606f, 0.26911265f, 0.28621048f, 0.30392578f, 0.32226485f, 0.34123364f, 0.36083812f,
    0.38108414f, 0.40197766f, 0.42352486f, 0.44573134f, 0.46860218f, 0.49214357f, 0.51636094f,
    0.5412597f, 0.5668448f, 0.59312195f, 0.6200962f, 0.64777285f, 0.6761569f, 0.70525324f,
    0.7350675f, 0.76560414f, 0.7968683f, 0.8288649f, 0.86159855f, 0.8950742f, 0.92929673f,
    0.9642704f, 1.0f,
    /* of 8 bits */
    0.0f, 3.03527e-4f, 6.07054e-4f, 9.1058103e-4f, 0.001214108f, 0.001517635f, 0.0018211621f,
    0.002124689f, 0.002428216f, 0.002731743f, 0.00303527f, 0.003346533f, 0.003676508f, 0.004024719f,
    0.0043914416f, 0.0047769533f, 0.0051815165f, 0.00560539f, 0.006048832f, 0.0065120906f,
    0.0069954097f, 0.007499031f, 0.008023189f, 0.008568116f, 0.009134047f, 0.009721206f,
    0.010329814f, 0.010960093f, 0.01161225f, 0.012286495f, 0.012983042f, 0.013702083f, 0.01444383f,
    0.015208507f, 0.015996296f, 0.016807366f, 0.017641941f, 0.018500213f, 0.019382358f,
    0.020288572f, 0.021219019f, 0.022173889f, 0.023153365f, 0.024157636f, 0.02518686f, 0.026241219f,
    0.027320884f, 0.02842604f, 0.029556839f, 0.030713446f, 0.031896036f, 0.033104777f, 0.03433982f,
    0.035601318f, 0.03688945f, 0.038204376f, 0.039546233f, 0.0409152f, 0.042311415f, 0.04373501f,
    0.045186177f, 0.046665058f, 0.048171777f, 0.049706522f, 0.0512694f, 0.05286059f, 0.054480225f,
    0.056128457f, 0.057805423f, 0.05951124f, 0.06124608f, 0.06301006f, 0.06480332f, 0.06662601f,
    0.06847823f, 0.07036014f, 0.072271876f, 0.074213564f, 0.076185346f, 0.078187376f, 0.08021979f,
    0.08228277f, 0.08437623f, 0.08650045f, 0.088655524f, 0.090841666f, 0.093058914f, 0.09530745f,
    0.09758734f, 0.099898726f, 0.10224174f, 0.1046165f, 0.10702312f, 0.10946173f, 0.11193246f,
    0.11443541f, 0.11697074f, 0.11953851f, 0.12213884f, 0.12477186f, 0.12743774f, 0.13013655f,
    0.13286836f, 0.13563338f, 0.13843165f, 0.1412633f, 0.1441285f, 0.14702725f, 0.1499598f,
    0.15292618f, 0.15592647f, 0.15896085f, 0.16202937f, 0.16513224f, 0.16826944f, 0.17144115f,
    0.17464745f, 0.17788845f, 0.18116431f, 0.18447503f, 0.18782082f, 0.19120175f, 0.19461788f,
    0.19806933f, 0.20155628f, 0.20507872f, 0.20863687f, 0.21223074f, 0.21586046f, 0.21952613f,
    0.22322786f, 0.22696576f, 0.23073992f, 0.23455045f, 0.23839743f, 0.24228096f, 0.24620117f,
    0.25015813f, 0.2541519f, 0.25818264f, 0.26225045f, 0.26635537f, 0.27049756f, 0.2746771f,
    0.27889404f, 0.28314853f, 0.28744063f, 0.29177046f, 0.29613814f, 0.3005437f, 0.30498722f,
    0.3094689f, 0.31398875f, 0.31854683f, 0.32314333f, 0.3277783f, 0.33245176f, 0.33716387f,
    0.34191474f, 0.34670436f, 0.35153288f, 0.35640043f, 0.36130708f, 0.3662529f, 0.37123805f,
    0.37626243f, 0.38132623f, 0.38642955f, 0.39157254f, 0.39675516f, 0.40197766f, 0.40724003f,
    0.4125424f, 0.41788483f, 0.42326748f, 0.4286905f, 0.43415385f, 0.4396574f, 0.44520125f,
    0.45078576f, 0.45641094f, 0.46207684f, 0.46778363f, 0.47353125f, 0.47931993f, 0.4851497f,
    0.49102062f, 0.49693277f, 0.5028863f, 0.50888115f, 0.51491755f, 0.52099544f, 0.52711517f,
    0.53327644f, 0.5394797f, 0.5457247f, 0.5520116f, 0.5583406f, 0.5647118f, 0.5711251f,
    0.57758075f, 0.5840788f, 0.5906192f, 0.5972022f, 0.6038277f, 0.610496f, 0.61720693f, 0.6239608f,
    0.6307576f, 0.6375973f, 0.6444801f, 0.65140605f, 0.65837526f, 0.6653877f, 0.67244357f,
    0.67954284f, 0.6866856f, 0.69387203f, 0.70110214f, 0.70837593f, 0.7156937f, 0.72305536f,
    0.73046106f, 0.73791075f, 0.7454045f, 0.75294244f, 0.76052475f, 0.76815134f, 0.7758224f,
    0.7835379f, 0.79129803f, 0.79910284f, 0.80695236f, 0.81484663f, 0.8227858f, 0.8307699f,
    0.838799f, 0.8468733f, 0.8549926f, 0.8631573f, 0.87136716f, 0.87962246f, 0.887923f, 0.8962694f,
    0.9046611f, 0.91309875f, 0.9215818f, 0.930111f, 0.9386857f, 0.9473067f, 0.9559735f, 0.9646865f,
    0.9734454f, 0.98225087f, 0.9911022f, 1.0f
};

SHADE__INLINE const float *shade__map_light_of(int full)
{
    return shade__map_light + (full == 255 ? 96 : full - 31);
}

/*------------------------------------------------------------------------------------------ >>lamps
   One light: constructors, and how much of it arrives at a point.
     in      a shade_light, rows of P     out  shade__arrival: rows of L and of the amount of light
     way     prepare_lamp once a lamp; arrive: come_from_infinity or come_from_point, meet_cone,
             attenuate, apply_cone
     holds   Loops run over the SHADE_LANES points of a packet, or over SHADE__POINT copies of a
             single point, through the same code: both get the same bits.  shade_attenuation and
             shade_spot, which only you call, compute one factor each by the plain formula.  The
             error of 1/sqrt stands in >>base, the error of powers in >>power.            >>terms */

static shade_light shade__plain_light(shade_vec4 position, shade_vec3 color)
{
    shade_light light;
    SHADE__ZERO(light);
    light.position = position;
    light.diffuse = light.specular = color;
    return light;
}

SHADEDEF shade_light shade_directional_light(shade_vec3 direction_of_travel, shade_vec3 color)
{
    return shade__plain_light(shade__xyzw(shade_neg(direction_of_travel), 0), color);
}

SHADEDEF shade_light shade_point_light(shade_vec3 position, shade_vec3 color)
{
    return shade__plain_light(shade__xyzw(position, 1), color);
}

SHADEDEF shade_light shade_spot_light(shade_vec3 position, shade_vec3 aim, float cutoff_radians,
                                      float exponent, shade_vec3 color)
{
    double s, c;
    shade_light light = shade_point_light(position, color);
    shade__sincos(cutoff_radians, &s, &c);
    light.spot_direction = aim;
    light.spot_exponent = exponent;
    light.spot_cos_cutoff = (float)c;
    if (!(cutoff_radians >= 0 && cutoff_radians <= 3.1415927410125732f))
        light.spot_cos_cutoff = shade__bits_float(0x7FC00000u);
    return light;
}

SHADEDEF float shade_attenuation(float a, float b, float c, float r)
{
    if (shade__is_zero(shade_v3(a, b, c))) return 1;
    if (a == 0) r = shade__maxf(r, 1e-4f);
    return 1 / shade__maxf(a + b * r + c * (r * r), 1e-20f);
}

SHADEDEF float shade_spot(shade_vec3 to_light, shade_vec3 aim, float cos_cutoff, float exponent)
{
    shade_vec3 axis = shade_neg(shade__unit_vector(aim));
    float cosine = shade_dot(to_light, axis);
    if (shade__is_zero(axis)) return 1;
    return cosine >= cos_cutoff ? shade_power(cosine, exponent) : 0;
}

/* A light prepared for loops over lanes. */
typedef struct shade__lamp {
    const shade_light *light;
    shade_vec3 at;          /* its position, or at infinity the unit L */
    shade_vec3 axis;        /* S of the cone, unit; zero: no cone */
    float a, least_r;       /* a of the attenuation, or 1 for none; the least r */
    int infinite, spot;
    int falls;              /* the attenuation depends on r */
    /* The light that one surface reflects of it, set by >>surface. */
    shade_vec3 ambient, diffuse, specular;    /* k_a I_La, k_d I_d, k_s I_s */
    int on;                 /* 0: the three are zero, and no other field is set */
} shade__lamp;

static void shade__prepare_lamp(const shade_light *light, shade__lamp *lamp)
{
    const shade_vec4 at = light->position;
    lamp->light = light;
    lamp->infinite = at.w == 0;
    lamp->at = shade__xyz(at);
    if (lamp->infinite) lamp->at = shade_normalize(lamp->at);
    else if (at.w != 1) lamp->at = shade_v3(at.x / at.w, at.y / at.w, at.z / at.w);

    lamp->axis = light->spot_direction;
    if (!shade__is_zero(lamp->axis)) lamp->axis = shade_neg(shade__unit_vector(lamp->axis));
    lamp->spot = !shade__is_zero(lamp->axis);

    lamp->falls = !lamp->infinite && !shade__is_zero(shade_v3(0, light->linear, light->quadratic));
    lamp->a = light->constant;
    lamp->least_r = lamp->a == 0 ? 1e-4f : 0.0f;
    if (!lamp->falls && lamp->a == 0) lamp->a = 1;
}

/* How much of a lamp arrives at the points of a packet. */
typedef struct shade__arrival {
    SHADE_ALIGNED shade__v3 to_light;    /* L, unit */
    float r[SHADE_LANES];                /* |P - lamp|; not set at infinity */
    float ls[SHADE_LANES];               /* L.S inside the cone, else SHADE__NEVER */
    float halvings[SHADE_LANES];         /* -log2 of the factor of the cone, (L.S)^e */
    float amount[SHADE_LANES];           /* the share of I_d and I_s that arrives */
    uint32_t any;    /* 0: no lane is inside the cone, and amount is not set */
} shade__arrival;

SHADE__INLINE void shade__come_from_infinity(const shade__lamp *lamp, const int n,
                                             shade__arrival *SHADE_RESTRICT a)
{
    const shade_vec3 to_light = lamp->at;
    SHADE__FOR(i, n) {
        shade__put(&a->to_light, i, to_light);
        a->amount[i] = 1;
    }
}

/* L and r. */
SHADE__INLINE void shade__come_from_point(const shade__lamp *lamp, shade__in_v3 point, const int n,
                                          shade__out r, shade__out_v3 to)
{
    const shade_vec3 at = lamp->at;
    SHADE__FOR(i, n) {
        shade_vec3 to_light = shade_sub(at, shade__at(point, i));
        float square = shade_dot(to_light, to_light), root = shade__rsqrt(square);
        /* the order of the next two matters to tcc: see >>plumbing */
        r[i] = square * root;
        shade__put(to, i, shade_scale(to_light, root));
    }
}

/* L.S; returns all ones if a lane is inside the cone, else 0. */
SHADE__INLINE uint32_t shade__meet_cone(const shade__lamp *lamp, const int n,
                                        shade__arrival *SHADE_RESTRICT a)
{
    const shade_vec3 axis = lamp->axis;
    const float cos_cutoff = lamp->light->spot_cos_cutoff;
    uint32_t any = 0;
    SHADE__FOR(i, n) {
        float ls = shade_dot(shade__at(&a->to_light, i), axis);
        uint32_t inside = shade__mask(ls >= cos_cutoff);
        a->ls[i] = shade__select(SHADE__NEVER, ls, inside);
        any |= inside;
    }
    return any;
}

/* amount = 1 / (a + b r + c r^2).  An r that is NaN, infinite or beyond 1e18 counts as 1e18.  A sum
   of infinities of both signs is NaN and gives 1e20, as in shade_attenuation. */
SHADE__INLINE void shade__attenuate(const shade__lamp *lamp, const int n,
                                    shade__arrival *SHADE_RESTRICT to)
{
    const float a = lamp->a, b = lamp->light->linear, c = lamp->light->quadratic;
    const float least_r = lamp->least_r;
    SHADE__FOR(i, n) {
        float r = shade__keep(to->r[i], 0x7FFFFFFF), sum;
        r = shade__clamp_bits(r, least_r, 1e18f);
        sum = a + b * r + c * (r * r);
        to->amount[i] = 1 / shade__select(1e-20f, sum, shade__mask(sum > 1e-20f));
    }
}

/* The same for b = c = 0: amount is 1 / a, or 0 where r is NaN because P is too far away. */
SHADE__INLINE void shade__attenuate_evenly(float a, const int n, shade__arrival *SHADE_RESTRICT to)
{
    const float even = 1 / shade__maxf(a, 1e-20f);
    SHADE__FOR(i, n) {
        to->amount[i] = shade__keep(even, shade__mask(to->r[i] >= 0));
    }
}

/* amount times (L.S)^e inside the cone, times 0 outside. */
SHADE__INLINE void shade__apply_cone(float exponent, const int n, shade__arrival *SHADE_RESTRICT a)
{
    const float e = shade__minf(exponent, FLT_MAX);
    SHADE__FOR(i, n) { a->halvings[i] = shade__power_log(a->ls[i], e); }
    SHADE__FOR(i, n) { a->amount[i] *= shade__exp2_neg(a->halvings[i]); }
}

/* The same for e = 0. */
SHADE__INLINE void shade__apply_cone_evenly(const int n, shade__arrival *SHADE_RESTRICT a)
{
    SHADE__FOR(i, n) {
        const uint32_t inside = shade__mask(a->ls[i] > SHADE__NEVER);
        a->amount[i] = shade__keep(a->amount[i], inside);
    }
}

SHADE__INLINE void shade__arrive_body(const shade__lamp *lamp, const shade__v3 *point, const int n,
                                      shade__arrival *a)
{
    if (lamp->infinite) shade__come_from_infinity(lamp, n, a);
    else shade__come_from_point(lamp, point, n, a->r, &a->to_light);

    a->any = lamp->spot ? shade__meet_cone(lamp, n, a) : 1;
    if (!a->any) return;

    if (lamp->falls) shade__attenuate(lamp, n, a);
    else if (!lamp->infinite) shade__attenuate_evenly(lamp->a, n, a);
    if (!lamp->spot) return;

    if (lamp->light->spot_exponent > 0) shade__apply_cone(lamp->light->spot_exponent, n, a);
    else shade__apply_cone_evenly(n, a);
}

/* A single point is computed as one vector of equal lanes, by the build for any processor. */
enum { SHADE__POINT = SHADE__ANY_WIDTH < SHADE_LANES ? SHADE__ANY_WIDTH : SHADE_LANES };

/* The number of points that a loop runs over.  Builds with wider vectors than the one for any
   processor always run over a whole packet.  The build for any processor rounds n down to whole
   vectors, so that the compiler emits no remainder loop. */
SHADE__INLINE int shade__points(int n, int width)
{
    if (width != SHADE__ANY_WIDTH) return SHADE_LANES;
    return shade__max(n & -(int)SHADE__POINT, SHADE__POINT);
}

SHADE__DISPATCH_AVX(shade__arrive,
                    (const shade__lamp *lamp, const shade__v3 *point, int n, shade__arrival *a),
                    (lamp, point, n, a),
                    shade__arrive_body(lamp, point, shade__points(n, shade__width), a))

SHADEDEF void shade_light_at_lanes(const shade_light *light, const float *point, float *to_light,
                                   float *amount)
{
    shade__arrival a;
    shade__lamp lamp;
    if (light && point) {
        shade__prepare_lamp(light, &lamp);
        shade__arrive(&lamp, shade__rows_in(point), SHADE_LANES, &a);
        if (!a.any) SHADE__ZERO(a.amount);
    } else SHADE__ZERO(a);
    if (to_light) SHADE_MEMCPY(to_light, &a.to_light, sizeof a.to_light);
    if (amount) SHADE_MEMCPY(amount, a.amount, sizeof a.amount);
}

static void shade__fill_point(shade_vec3 v, shade__v3 *rows)
{
    for (int i = 0; i < SHADE__POINT; i++) shade__put(rows, i, v);
}

SHADEDEF float shade_light_at(const shade_light *light, shade_vec3 point, shade_vec3 *to_light,
                              float *distance)
{
    shade__arrival a;
    shade__v3 block;
    shade__lamp lamp;
    float r = 0;
    if (light) {
        shade__fill_point(point, &block);
        shade__prepare_lamp(light, &lamp);
        r = lamp.infinite ? FLT_MAX : shade_distance(lamp.at, point);
        shade__arrive_any(&lamp, &block, SHADE__POINT, &a);
    } else SHADE__ZERO(a);
    if (to_light) *to_light = shade__at(&a.to_light, 0);
    if (distance) *distance = r;
    return a.any ? a.amount[0] : 0;
}

/*------------------------------------------------------------------------------------------ >>terms
   The terms of >>model one by one, for a single point.
     in      unit vectors                  out  cosines, powers, colours
     holds   Square roots are shade__sqrt's, rounded correctly: the last bits may differ from >>lit.
     source  [Phong75], [Blinn77], [Gooch98]                                            >>surface */

SHADEDEF float shade_lambert(shade_vec3 normal, shade_vec3 to_light)
{
    return shade__maxf(shade_dot(normal, to_light), 0);
}

/* R.V = 1 - |R - V|^2 / 2 for unit vectors; 0 where L or V is zero.  In this form errors in the
   lengths of the vectors cancel near 1, where a power would magnify them. */
SHADE__INLINE float shade__mirror_cosine(shade_vec3 normal, shade_vec3 to_light, shade_vec3 to_eye)
{
    shade_vec3 mirrored = shade_scale(normal, 2 * shade_dot(normal, to_light));
    shade_vec3 d = shade_sub(mirrored, shade_add(to_light, to_eye));
    const int none = shade__is_zero(to_light) || shade__is_zero(to_eye);
    return none ? 0 : 1 - 0.5f * shade_dot(d, d);
}

/* (R.V)^n or (N.H)^n, without the factor B. */
static SHADE__NOINLINE float shade__highlight(int phong, shade_vec3 normal, shade_vec3 to_light,
                                              shade_vec3 to_eye, float exponent)
{
    shade_vec3 half;
    if (phong) return shade_power(shade__mirror_cosine(normal, to_light, to_eye), exponent);
    half = shade_halfway(to_light, to_eye);
    return shade__is_zero(half) ? 0 : shade_power(shade_dot(normal, half), exponent);
}

SHADEDEF float shade_phong_specular(shade_vec3 normal, shade_vec3 to_light, shade_vec3 to_eye,
                                    float exponent)
{
    return shade_dot(normal, to_light) > 0
        ? shade__highlight(1, normal, to_light, to_eye, exponent) : 0;
}

SHADEDEF float shade_blinn_phong_specular(shade_vec3 normal, shade_vec3 to_light, shade_vec3 to_eye,
                                          float exponent)
{
    return shade_dot(normal, to_light) > 0
        ? shade__highlight(0, normal, to_light, to_eye, exponent) : 0;
}

/* The material of calls that pass NULL. */
static shade_material shade__white_lambert(void)
{
    const shade_vec3 white = shade_v3(1, 1, 1);     /* before m, for tcc: see >>plumbing */
    shade_material m;
    SHADE__ZERO(m);
    m.ambient = m.diffuse = white;
    return m;
}

SHADEDEF shade_vec3 shade_brdf(const shade_material *material, shade_model model, shade_vec3 normal,
                               shade_vec3 to_light, shade_vec3 to_eye)
{
    const int phong = model == SHADE_MODEL_PHONG;
    shade_material m = material ? *material : shade__white_lambert();
    if (phong || model == SHADE_MODEL_BLINN_PHONG) {
        float lobe = shade__highlight(phong, normal, to_light, to_eye, m.shininess);
        return shade_madd(m.diffuse, lobe, m.specular);
    }
    return model == SHADE_MODEL_LAMBERT ? m.diffuse : shade_v3(0, 0, 0);
}

SHADEDEF shade_vec3 shade_cool_to_warm(shade_vec3 normal, shade_vec3 to_light, shade_vec3 cool,
                                       shade_vec3 warm)
{
    return shade_lerp(cool, warm, 0.5f + 0.5f * shade_dot(normal, to_light));
}

SHADEDEF float shade_blinn_exponent(float phong_exponent) { return 4 * phong_exponent; }

/*---------------------------------------------------------------------------------------- >>surface
   The light for all points of a call: defaults are filled in, materials multiplied by lights, and
   terms that are off set to zero.
     in      a shade_lighting, a material, the eye      out  shade__surface
     way     begin_surface: terms_of, ambient; then begin_tone, or reflect_lamp of the first lamps
                                                                                            >>lit */

/* The first SHADE__LAMPS lights are prepared once a draw, the others anew for each packet. */
enum { SHADE__LAMPS = SHADE_LANES < 64 ? 1 : 4 };

typedef struct shade__surface {
    const shade_lighting *lighting;
    shade_material material;
    unsigned terms;
    shade_vec4 eye;         /* w = 0: a viewer at infinity */
    shade_vec3 emission;
    shade_vec3 ambient;     /* k_a times the ambient light that is not attenuated */
    shade_vec3 cool, warmth;    /* the tone's: cool, and warm - cool */
    int tone;               /* cool to warm by one lamp; else the equation */
    int lamps;              /* lights to loop over; 0 if no term needs them; 1 for a tone */
    uint32_t ungated;       /* all ones with UNGATED_SPECULAR, else 0 */
    uint32_t sign;          /* a mask for N.L in the diffuse term: TWO_SIDED_ABS clears its sign */
    shade__lamp lamp[SHADE__LAMPS];    /* the first lights, or the tone's */
} shade__surface;

/* The terms of the model that lighting->terms selects. */
static unsigned shade__terms_of(const shade_lighting *lighting)
{
    const unsigned terms = lighting->terms ? lighting->terms : ~0u;
    switch (lighting->model) {
    case SHADE_MODEL_EMISSIVE: return terms & SHADE_TERM_EMISSION;
    case SHADE_MODEL_AMBIENT: return terms & (SHADE_TERM_EMISSION | SHADE_TERM_AMBIENT);
    case SHADE_MODEL_LAMBERT: return terms & ~(unsigned)SHADE_TERM_SPECULAR;
    case SHADE_MODEL_COOL_TO_WARM: return terms & (SHADE_TERM_EMISSION | SHADE_TERM_DIFFUSE);
    default: return terms;
    }
}

/* k I, or zero if the term is off, even for NaN. */
SHADE__INLINE shade_vec3 shade__product(unsigned on, shade_vec3 k, shade_vec3 light)
{
    return on ? shade_mul(k, light) : shade_v3(0, 0, 0);
}

static void shade__reflect_lamp(const shade__surface *s, const shade_light *light,
                                shade__lamp *lamp)
{
    const shade_material *m = &s->material;
    const unsigned flags = s->lighting->flags, terms = s->terms;
    const unsigned ambient = flags & SHADE_FLAG_ATTENUATED_AMBIENT ? terms : 0;
    lamp->ambient = shade__product(ambient & SHADE_TERM_AMBIENT, m->ambient, light->ambient);
    lamp->diffuse = shade__product(terms & SHADE_TERM_DIFFUSE, m->diffuse, light->diffuse);
    lamp->specular = shade__product(terms & SHADE_TERM_SPECULAR, m->specular, light->specular);
    lamp->on = !shade__is_zero(lamp->ambient) || !shade__is_zero(lamp->diffuse) ||
               !shade__is_zero(lamp->specular);
    if (!lamp->on) return;

    shade__prepare_lamp(light, lamp);
}

/* Cool to warm uses only L of the first light; without lights L is zero.              [Gooch98] */
static SHADE__COLD void shade__begin_tone(shade__surface *s)
{
    const shade_lighting *l = s->lighting;
    SHADE__ZERO(s->lamp[0]);
    s->lamp->infinite = 1;
    if (s->lamps > 0) shade__prepare_lamp(l->lights, s->lamp);
    s->lamp->spot = s->lamp->falls = 0;
    s->lamps = 1;

    s->cool = shade__is_zero(l->cool) ? shade_v3(0.4f, 0.4f, 0.7f) : l->cool;
    s->warmth = shade__is_zero(l->warm) ? shade_v3(0.8f, 0.6f, 0.6f) : l->warm;
    s->warmth = shade_sub(s->warmth, s->cool);
}

/* k_a times the sum of I_a and, unless ATTENUATED_AMBIENT is set, the I_La of all lights. */
static shade_vec3 shade__ambient(const shade__surface *s)
{
    const shade_lighting *l = s->lighting;
    shade_vec3 sum = l->ambient;
    if (!(s->terms & SHADE_TERM_AMBIENT)) return shade_v3(0, 0, 0);
    if (!(l->flags & SHADE_FLAG_ATTENUATED_AMBIENT))
        for (ptrdiff_t k = 0; k < s->lamps; k++)    /* not int, for tcc: see >>plumbing */
            sum = shade_add(sum, l->lights[k].ambient);
    return shade_mul(sum, s->material.ambient);
}

static SHADE__NOINLINE void shade__begin_surface(const shade_lighting *lighting,
                                                 const shade_material *material, shade_vec3 eye,
                                                 shade__surface *s)
{
    const shade_vec3 none = shade_v3(0, 0, 0);
    const unsigned flags = lighting->flags, terms = shade__terms_of(lighting);
    unsigned by_lamps = SHADE_TERM_DIFFUSE | SHADE_TERM_SPECULAR;
    if (flags & SHADE_FLAG_ATTENUATED_AMBIENT) by_lamps |= SHADE_TERM_AMBIENT;
    s->lighting = lighting;
    s->terms = terms;
    s->material = material ? *material : shade__white_lambert();
    s->eye = shade__xyzw(eye, flags & SHADE_FLAG_INFINITE_VIEWER ? 0.0f : 1.0f);
    s->ungated = shade__mask((flags & SHADE_FLAG_UNGATED_SPECULAR) != 0);
    s->sign = flags & SHADE_FLAG_TWO_SIDED_ABS ? 0x7FFFFFFF : 0xFFFFFFFF;

    s->lamps = lighting->lights ? shade__max(lighting->light_count, 0) : 0;
    s->emission = terms & SHADE_TERM_EMISSION ? s->material.emission : none;
    s->emission = shade_add(s->emission, none);    /* -0 becomes 0, as it does under a lamp */
    s->ambient = shade__ambient(s);

    s->tone = lighting->model == SHADE_MODEL_COOL_TO_WARM && (terms & SHADE_TERM_DIFFUSE);
    if (s->tone) {
        shade__begin_tone(s);
        return;
    }
    if (!(terms & by_lamps)) s->lamps = 0;
    for (int k = 0; k < s->lamps && k < SHADE__LAMPS; k++)
        shade__reflect_lamp(s, &lighting->lights[k], &s->lamp[k]);
}

/*-------------------------------------------------------------------------------------------- >>lit
   The whole equation of >>model, for a packet or for one point.
     in      shade_rows, a shade__surface         out  rows of rgb
     way     lit_rows: begin_light; then for each lamp add_lamp: arrive_at, horizon, shine (half or
             mirrored, raise), combine
     holds   The light of one lamp is cut into short loops over rows.  One loop for all of it takes
             1.5 times as long, because its live values outgrow the registers.  A lamp that reaches
             no lane (horizon, cone) ends after its first loops.                         >>state */

/* The rows of a packet while the lamps add their light, one after the other. */
typedef struct shade__lit {
    const shade__surface *surface;
    const shade__lamp *lamp;
    const shade_rows *rows;
    shade__arrival a;             /* of the lamp */
    shade__v3 to_eye;             /* V, unit */
    float rn[SHADE_LANES];        /* 1/|N|; negative where N is flipped toward the viewer */
    float nl[SHADE_LANES];        /* N.L, signed */
    float h2[SHADE_LANES];        /* |L + V|^2 */
    float cosine[SHADE_LANES];    /* N.H or R.V */
    float highlight[SHADE_LANES]; /* B (N.H)^n or B (R.V)^n */
} shade__lit;

SHADE__INLINE void shade__inverse_lengths(shade__in_v3 normal, const int n, shade__out rn)
{
    SHADE__FOR(i, n) {
        shade_vec3 m = shade__at(normal, i);
        rn[i] = shade__rsqrt(shade_dot(m, m));
    }
}

/* Toward the viewer, not unit.  eye.w is 1, or 0 for a viewer at infinity. */
SHADE__INLINE shade_vec3 shade__view(shade_vec4 eye, shade_vec3 point)
{
    return shade_madd(shade__xyz(eye), -eye.w, point);
}

/* Flips the sign of rn where N points away from the viewer. */
SHADE__INLINE void shade__two_sides(shade__in_v3 point, shade__in_v3 normal, shade_vec4 eye,
                                    const int n, shade__out rn)
{
    SHADE__FOR(i, n) {
        shade_vec3 to_eye = shade__view(eye, shade__at(point, i));
        uint32_t turned = shade__mask(shade_dot(shade__at(normal, i), to_eye) < 0);
        turned &= 0x80000000u;
        rn[i] = shade__bits_float(shade__float_bits(rn[i]) ^ turned);
    }
}

SHADE__INLINE void shade__viewer(shade__in_v3 point, shade_vec4 eye, const int n, shade__out_v3 to)
{
    SHADE__FOR(i, n) {
        shade_vec3 to_eye = shade__view(eye, shade__at(point, i));
        float root = shade__rsqrt(shade_dot(to_eye, to_eye));
        shade__put(to, i, shade_scale(to_eye, root));
    }
}

/* N.L; returns all ones if a lane faces the lamp, else 0. */
SHADE__INLINE uint32_t shade__horizon(shade__in_v3 normal, const int n,
                                      shade__lit *SHADE_RESTRICT r)
{
    uint32_t any = 0;
    SHADE__FOR(i, n) {
        float nl = shade_dot(shade__at(normal, i), shade__at(&r->a.to_light, i)) * r->rn[i];
        r->nl[i] = nl;
        any |= shade__mask(nl > 0);
    }
    return any;
}

/* 1 if there is a highlight: where N.L > 0 or, if ungated, wherever N is not zero.  ungated >> 1
   clears the sign, so that |rn| takes the place of N.L. */
SHADE__INLINE int shade__gate(float nl, float rn, uint32_t ungated)
{
    uint32_t either = shade__float_bits(nl) & ~ungated;
    either |= shade__float_bits(rn) & ungated >> 1;
    return shade__bits_float(either) > 0;
}

/* N.H, or SHADE__NEVER where there is no highlight or no H.  Returns all ones if L and V are nearly
   opposite in a lane, |L + V|^2 < SHADE__OPPOSITE; shade__half_opposite then computes it again. */
#define SHADE__OPPOSITE 1e-3f
SHADE__INLINE uint32_t shade__half(shade__in_v3 normal, const int n, shade__lit *SHADE_RESTRICT r)
{
    const uint32_t ungated = r->surface->ungated;
    uint32_t opposite = 0;
    SHADE__FOR(i, n) {
        shade_vec3 half = shade_add(shade__at(&r->a.to_light, i), shade__at(&r->to_eye, i));
        /* the order of the next two matters to tcc: see >>plumbing */
        r->cosine[i] = shade_dot(shade__at(normal, i), half);
        float h2 = shade_dot(half, half);
        opposite |= shade__mask(h2 < SHADE__OPPOSITE);
        r->h2[i] = h2;
    }
    SHADE__FOR(i, n) {
        float h2 = r->h2[i], rn = r->rn[i];
        float nh = r->cosine[i] * (rn * shade__rsqrt_normal(h2));
        uint32_t exists = shade__mask(shade__gate(r->nl[i], rn, ungated));
        exists &= shade__mask(h2 >= 1e-12f);
        r->cosine[i] = shade__select(SHADE__NEVER, nh, exists);
    }
    return opposite;
}

/* Computes N.H in double, from the positions, in lanes where L and V are nearly opposite and L + V
   has few digits in float.  The same float square as above selects the lanes, so that the bits of
   a lane do not depend on its neighbours. */
static SHADE__COLD void shade__half_opposite(const shade__v3 *point, const shade__v3 *normal,
                                             const int n, shade__lit *r)
{
    const shade_vec4 at = r->lamp->light->position, eye = r->surface->eye;
    const double w = at.w == 0 ? 1 : (double)at.w, placed = at.w == 0 ? 0 : 1;
    double lamp[3], viewer[3];
    shade__double3(shade__xyz(at), lamp);
    shade__double3(shade__xyz(eye), viewer);
    for (int i = 0; i < n; i++) {
        double m[3], l[3], v[3], p[3], h2, nh;
        if (!(r->h2[i] < SHADE__OPPOSITE)) continue;
        if (!shade__gate(r->nl[i], r->rn[i], r->surface->ungated)) continue;

        shade__double3(shade__at(point, i), p);
        shade__double3(shade__at(normal, i), m);
        for (int k = 0; k < 3; k++) {
            l[k] = lamp[k] / w - placed * p[k];
            v[k] = viewer[k] - (double)eye.w * p[k];
        }
        shade__unit3(l);
        shade__unit3(v);
        shade__unit3(m);
        for (int k = 0; k < 3; k++) l[k] += v[k];
        h2 = shade__dot3(l, l);
        shade__unit3(l);
        nh = r->rn[i] < 0 ? -shade__dot3(m, l) : shade__dot3(m, l);
        r->cosine[i] = h2 >= 1e-12 ? (float)nh : SHADE__NEVER;
    }
}

/* R.V as in shade__mirror_cosine, or SHADE__NEVER where the gate is shut. */
SHADE__INLINE void shade__mirrored(shade__in_v3 normal, const int n, shade__lit *SHADE_RESTRICT r)
{
    const uint32_t ungated = r->surface->ungated;
    SHADE__FOR(i, n) {
        float nl = r->nl[i], rn = r->rn[i], cosine;
        shade_vec3 to_light = shade__at(&r->a.to_light, i), to_eye = shade__at(&r->to_eye, i);
        shade_vec3 d = shade_scale(shade__at(normal, i), 2 * nl * rn);
        d = shade_sub(d, shade_add(to_light, to_eye));
        /* declared here, after calls that return vectors, for tcc: see >>plumbing */
        uint32_t exists = shade__mask(shade_dot(to_eye, to_eye) > 0);
        exists &= shade__mask(shade_dot(to_light, to_light) > 0);
        cosine = shade__keep(1 - 0.5f * shade_dot(d, d), exists);
        cosine = shade__select(SHADE__NEVER, cosine, shade__mask(shade__gate(nl, rn, ungated)));
        r->cosine[i] = cosine;
    }
}

/* The highlight times max(0, N.L). */
SHADE__INLINE void shade__weigh(const int n, shade__lit *SHADE_RESTRICT r)
{
    SHADE__FOR(i, n) {
        float nl = r->nl[i];
        r->highlight[i] *= shade__keep(nl, shade__mask(nl > 0));
    }
}

/* amount *= visibility.  An amount of 0, outside the cone, stays 0 even for a visibility of NaN. */
SHADE__INLINE void shade__shadow(shade__in visibility, const int n, shade__out amount)
{
    SHADE__FOR(i, n) {
        amount[i] = shade__keep(amount[i] * visibility[i], shade__mask(amount[i] != 0));
    }
}

/* Rows of ones: the default of albedo and specular. */
#define SHADE__ONES_8 1, 1, 1, 1, 1, 1, 1, 1
#define SHADE__ONES_16 SHADE__ONES_8, SHADE__ONES_8
#define SHADE__ONES_32 SHADE__ONES_16, SHADE__ONES_16
#define SHADE__ONES_64 SHADE__ONES_32, SHADE__ONES_32
#define SHADE__ONES_128 SHADE__ONES_64, SHADE__ONES_64
#define SHADE__ONES_256 SHADE__ONES_128, SHADE__ONES_128
#define SHADE__ONES(lanes) { SHADE__ONES_##lanes }
#define SHADE__THREE_ROWS(lanes) { SHADE__ONES(lanes), SHADE__ONES(lanes), SHADE__ONES(lanes) }
SHADE_ALIGNED static const shade__v3 shade__ones = SHADE__THREE_ROWS(SHADE_LANES);

/* The albedo or the specular factors of a packet; 1 where there are no rows. */
SHADE__INLINE const shade__v3 *shade__factors(const float *rows)
{
    return rows ? shade__rows_in(rows) : &shade__ones;
}

/* Adds light to rgb of lane i, or 0 where the mask is not set. */
SHADE__INLINE void shade__add_to(shade__v3 *rgb, int i, shade_vec3 light, uint32_t mask)
{
    light.x = shade__keep(light.x, mask);
    light.y = shade__keep(light.y, mask);
    light.z = shade__keep(light.z, mask);
    shade__put(rgb, i, shade_add(shade__at(rgb, i), light));
}

/* rgb = emission + ambient albedo */
SHADE__INLINE void shade__begin_light(const shade__surface *s, shade__in_v3 albedo, const int n,
                                      shade__out_v3 rgb)
{
    const shade_vec3 emission = s->emission, ambient = s->ambient;
    SHADE__FOR(i, n) {
        shade_vec3 light = shade_mul(ambient, shade__at(albedo, i));
        shade__put(rgb, i, shade_add(emission, light));
    }
}

/* rgb += (cool + k_w (warm - cool)) albedo, k_w = (1 + N.L) / 2                      [Gooch98] */
SHADE__INLINE void shade__add_tone(const shade__lit *SHADE_RESTRICT r, shade__in_v3 albedo,
                                   const int n, shade__out_v3 rgb)
{
    const shade_vec3 cool = r->surface->cool, warmth = r->surface->warmth;
    SHADE__FOR(i, n) {
        shade_vec3 light = shade_madd(cool, 0.5f + 0.5f * r->nl[i], warmth);
        shade__add_to(rgb, i, shade_mul(light, shade__at(albedo, i)), ~0u);
    }
}

/* rgb += amount k_a I_La albedo.  Lanes outside the cone add exactly 0, even for NaN colours, as if
   the lamp had been skipped. */
SHADE__INLINE void shade__add_ambient(const shade__lit *SHADE_RESTRICT r, shade__in_v3 albedo,
                                      const int n, shade__out_v3 rgb)
{
    const shade_vec3 ambient = r->lamp->ambient;
    SHADE__FOR(i, n) {
        const float amount = r->a.amount[i];
        shade_vec3 light = shade_scale(ambient, amount);
        light = shade_mul(light, shade__at(albedo, i));
        shade__add_to(rgb, i, light, shade__mask(amount != 0));
    }
}

/* rgb += amount (albedo k_d I_d max(0, N.L) + tint k_s I_s highlight).  surface->sign turns N.L
   into |N.L| for TWO_SIDED_ABS.  Lanes out of the lamp's reach add exactly 0: N.L may be infinite
   there.  plain: albedo and tint are 1. */
SHADE__INLINE void shade__combine(const shade__lit *SHADE_RESTRICT r, shade__in_v3 albedo,
                                  shade__in_v3 tint, const int plain, const int n,
                                  shade__out_v3 rgb)
{
    const shade_vec3 k_d = r->lamp->diffuse, k_s = r->lamp->specular;
    const uint32_t sign = r->surface->sign, ungated = r->surface->ungated;
    SHADE__FOR(i, n) {
        float nl = shade__keep(r->nl[i], sign), amount = r->a.amount[i];
        uint32_t front = shade__mask(nl > 0);
        uint32_t reached = (front | ungated) & shade__mask(amount != 0);
        shade_vec3 diffuse = plain ? k_d : shade_mul(k_d, shade__at(albedo, i));
        shade_vec3 specular = plain ? k_s : shade_mul(k_s, shade__at(tint, i));
        diffuse = shade_scale(diffuse, shade__keep(nl, front) * amount);
        shade_vec3 light = shade_madd(diffuse, r->highlight[i] * amount, specular);
        shade__add_to(rgb, i, light, reached);
    }
}

/* power = base^exponent, in two loops: in a single one the constants outgrow the registers, and a
   light takes 1.5 times as long. */
SHADE__INLINE void shade__raise(shade__in base, float exponent, const int n, shade__out power)
{
    exponent = exponent > 0 ? shade__minf(exponent, FLT_MAX) : 0;
    SHADE__FOR(i, n) { power[i] = shade__power_log(base[i], exponent); }
    SHADE__FOR(i, n) { power[i] = shade__exp2_neg(power[i]); }
}

SHADE__INLINE void shade__shine(const shade__v3 *point, const shade__v3 *normal, const int n,
                                shade__lit *r)
{
    const shade__surface *s = r->surface;
    if (shade__is_zero(r->lamp->specular)) {
        SHADE__ZERO(r->highlight);
        return;
    }
    if (s->lighting->model == SHADE_MODEL_PHONG) shade__mirrored(normal, n, r);
    else if (shade__half(normal, n, r)) shade__half_opposite(point, normal, n, r);
    shade__raise(r->cosine, s->material.shininess, n, r->highlight);
    if (s->lighting->flags & SHADE_FLAG_WEIGHTED_SPECULAR) shade__weigh(n, r);
}

/* L and amount of a lamp.  Single points use the build for any processor. */
SHADE__INLINE void shade__arrive_at(const shade__v3 *point, const int n, shade__lit *r)
{
    if (n == SHADE_LANES) shade__arrive(r->lamp, point, n, &r->a);
    else shade__arrive_any(r->lamp, point, n, &r->a);
}

/* Adds the light of lamp k.  Ambient light that is not attenuated has been added before. */
SHADE__INLINE void shade__add_lamp(int k, const int n, shade__lit *r, shade__v3 *rgb)
{
    const shade__surface *s = r->surface;
    const shade__v3 *point = shade__rows_in(r->rows->position);
    const shade__v3 *normal = shade__rows_in(r->rows->normal);
    const shade__v3 *albedo = shade__factors(r->rows->albedo);
    const float *visibility = r->rows->visibility;
    shade__lamp fresh;
    uint32_t any;
    if (k >= SHADE__LAMPS) shade__reflect_lamp(s, &s->lighting->lights[k], &fresh);
    r->lamp = k < SHADE__LAMPS ? &s->lamp[k] : &fresh;
    if (!s->tone && !r->lamp->on) return;
    shade__arrive_at(point, n, r);
    if (!r->a.any) return;

    any = shade__horizon(normal, n, r);
    if (s->tone) {
        shade__add_tone(r, albedo, n, rgb);
        return;
    }
    if (!shade__is_zero(r->lamp->ambient)) shade__add_ambient(r, albedo, n, rgb);
    if (!(any | s->ungated | ~s->sign)) return;

    shade__shine(point, normal, n, r);
    if (visibility) shade__shadow(visibility + (size_t)k * SHADE_LANES, n, r->a.amount);
    if (SHADE__HAS(SHADE__PLAIN) && !r->rows->albedo && !r->rows->specular)
        shade__combine(r, albedo, albedo, 1, n, rgb);
    else shade__combine(r, albedo, shade__factors(r->rows->specular), 0, n, rgb);
}

SHADE__INLINE void shade__lit_rows_body(const shade__surface *s, const shade_rows *rows,
                                        const int n, shade__v3 *rgb)
{
    const shade__v3 *point = shade__rows_in(rows->position);
    const shade__v3 *normal = shade__rows_in(rows->normal);
    const float *albedo = shade__is_zero(s->ambient) ? NULL : rows->albedo;
    shade__lit r;
    r.surface = s;
    r.rows = rows;
    shade__begin_light(s, shade__factors(albedo), n, rgb);
    if (!s->lamps) return;

    shade__inverse_lengths(normal, n, r.rn);
    if (s->lighting->flags & SHADE_FLAG_TWO_SIDED) shade__two_sides(point, normal, s->eye, n, r.rn);
    shade__viewer(point, s->eye, n, &r.to_eye);
    for (int k = 0; k < s->lamps; k++) shade__add_lamp(k, n, &r, rgb);
}
SHADE__DISPATCH_AVX(shade__lit_rows,
                    (const shade__surface *s, const shade_rows *rows, int n, shade__v3 *rgb),
                    (s, rows, n, rgb),
                    shade__lit_rows_body(s, rows, shade__points(n, shade__width), rgb))

static void shade__lit_packet(const shade__surface *s, const shade_rows *rows, float *rgb)
{
    shade__lit_rows(s, rows, SHADE_LANES, shade__rows_out(rgb));
}

SHADEDEF void shade_lit_lanes(const shade_lighting *lighting, const shade_material *material,
                              shade_vec3 eye, const shade_rows *rows, float *rgb)
{
    shade__surface s;
    if (!rgb) return;
    if (!lighting || !rows || !rows->position || !rows->normal) {
        SHADE_MEMSET(rgb, 0, 3 * SHADE_LANES * sizeof *rgb);
        return;
    }
    shade__begin_surface(lighting, material, eye, &s);
    shade__lit_packet(&s, rows, rgb);
}

SHADEDEF shade_vec3 shade_lit(const shade_lighting *lighting, const shade_material *material,
                              shade_vec3 eye, shade_vec3 point, shade_vec3 normal)
{
    shade__v3 p, n, rgb;
    shade_rows rows;
    shade__surface s;
    if (!lighting) return shade_v3(0, 0, 0);
    SHADE__ZERO(rows);
    shade__fill_point(point, &p);
    shade__fill_point(normal, &n);
    rows.position = p.x;
    rows.normal = n.x;
    shade__begin_surface(lighting, material, eye, &s);
    shade__lit_rows_any(&s, &rows, SHADE__POINT, &rgb);
    return shade__at(&rgb, 0);
}

SHADEDEF shade_terms shade_evaluate(const shade_lighting *lighting, const shade_material *material,
                                    shade_vec3 eye, shade_vec3 point, shade_vec3 normal)
{
    shade_terms t;
    shade_vec3 *term[4] = { &t.emission, &t.ambient, &t.diffuse, &t.specular };
    SHADE__ZERO(t);
    if (!lighting) return t;
    for (unsigned k = 0; k < 4; k++) {
        shade_lighting one = *lighting;
        one.terms = 1u << k;
        if (!lighting->terms || (lighting->terms & one.terms))
            *term[k] = shade_lit(&one, material, eye, point, normal);
    }
    return t;
}

/*------------------------------------------------------------------------------------------ >>state
   The state of a draw, by owner.  All of it lies on the stack of the call: shade__draw has 26.2 kB
   at the defaults, the queue 12.9 and the batch 8.8 of these.  bench/stack.c measures whole calls:
   a lit mesh with a map takes up to 45.8 kB where triangles are clipped, 47.4 kB with clang.

     plan      >>drive       fixed before the first triangle, read by all stages
     supply    >>drive       the triangles not yet taken
     incoming  >>vertices    vertices of a batch until they have window positions
     batch     >>vertices    vertices in the window and the triangles among them
     setup     >>triangles   up to SHADE__TRIANGLES triangles, a lane each
     bounds    >>cover       depths: big triangles hide all that lies behind them
     queue     >>fragments   pixels that passed the depth test, until a packet of them is shaded

     The life of a packet.  A stage calls the next one through its prototype below:

       indices -> take_batch -> shade_vertices -> to_window        up to SHADE_LANES vertices
                                     |            clip space -> window, outcodes
                                     v
                  triangles: drop, clip (a fan) or add             SHADE__TRIANGLES at a time
                                     |
                                     v
                  set_up -> cover -> tiles: edges, depth test      32 x 8 pixels at a time
                                     |      runs of pixels in rows
                                     v
                  push: values over w, and squared steps of lod,   until SHADE_LANES are full
                        into lanes of the queue
                                     |
                                     v
                  flush: values times w, lod -> fragment shader    SHADE_LANES pixels
                         -> store
                                                                                       >>vertices */

typedef struct shade__draw shade__draw;

/* Pixels x .. x + n - 1 of row y, inside a triangle of the setup. */
typedef struct shade__run { int32_t x, y, n, triangle; } shade__run;

/* The depth test as masks: the comparisons that pass, and whether depth is written. */
typedef struct shade__compare { uint32_t less, equal, greater, always, write; } shade__compare;

/* The values of a vertex are z, 1/w and the varyings.  With a lod_texture, but without perspective,
   u and v follow once more, divided by w. */
enum {
    SHADE__FIRST = 2,                 /* z and 1/w stand before the varyings */
    SHADE__SIDE_MAX = 16384,          /* pixels or texels of a side of a picture */
    SHADE__VALUES_MAX = (SHADE_MAX_VARYINGS + SHADE__FIRST + 2 + 7) / 8 * 8,
    /* at least 4 vertices of the most values; take_batch needs 3 */
    SHADE__BATCH_FLOATS = SHADE_LANES * 8 + (SHADE_LANES < 64 ? 4 : 2) * SHADE__VALUES_MAX,
    SHADE__BATCH_TRIANGLES = 3 * SHADE_LANES / 2,
    SHADE__PARTS = SHADE_LANES < 64 ? 2 : 8,          /* of a batch */
    SHADE__TRIANGLES = SHADE_LANES < 64 ? 4 : 16,     /* set up at a time */
    SHADE__BOUNDS = SHADE_LANES * SHADE_LANES / 32,   /* depths in shade__bounds */
    SHADE__CLIP_VERTICES = 13,        /* see >>clip */
    SHADE__TILE = 32, SHADE__TILE_ROWS = 8    /* pixels that >>tiles tests together */
};

/* The plan of a draw.  Its flags, all set by shade__make_plan:

     flag            set where                                        read by
     zero_to_one     the raster says so                               >>vertices, >>clip
     early           there is depth and no shader may discard         >>tiles (rows of a tile)
     queued          the fragment shader's result is used             >>tiles (sends runs)
     less_only       early, the test is LESS, and depth is written    >>tiles (its own copy)
     inputs_unread   a library_shader, early is set, no dither        >>fragments */
typedef struct shade__plan {
    const shade_target   *target;
    const shade_pipeline *pipe;
    uint8_t *color;                   /* NULL: none */
    float   *depth;                   /* NULL: none */
    float   *tested;                  /* the depths that >>tiles reads: the buffer, or a dummy
                                         row that passes every test */
    const shade__layout *layout;      /* of the target's pixels */
    int      stride, row_offset;      /* pixels from row to row; the first row that memory holds */
    int      x0, y0, x1, y1;          /* clip rectangle, the last two exclusive */
    int      values, value_stride;    /* floats of a vertex; its stride, a multiple of 8 */
    int      first_divided;           /* values from this one on are kept divided by w */
    int      lod_u;                   /* u / w is this value, v / w the next; 0: no lod_texture */
    int      varyings;
    int      zero_to_one;
    int      early;                   /* depth is tested by >>tiles */
    int      queued;                  /* fragments go to the queue */
    int      less_only;               /* the early test is LESS, and depth is written */
    int      inputs_unread;           /* x, y, z, primitive, front and presets are not read */
    shade_vec3 eye;                   /* for the fragment shader; 0 without a draw state */
    shade__compare compare;           /* the test of the draw */
    shade__compare tile_test;         /* the test of >>tiles: it lets all pass unless early */
    float    away;                    /* 1: greater depth is farther; -1: less is; 0: no bounds */
    double   half_width, half_height; /* of the picture, in 1/256 pixels */
} shade__plan;

typedef struct shade__vertex {        /* a vertex after the vertex shader */
    int32_t  x, y;                    /* window, 24.8 fixed point */
    uint32_t out;                     /* the planes it is outside of: SHADE__OUT_... */
    float    clip[4];
} shade__vertex;

/* A part of a batch: triangles first, first + 1, ... up to the first of the next part are triangles
   primitive, primitive + 1, ... of the draw. */
typedef struct shade__part { int first; uint32_t primitive; } shade__part;

typedef struct shade__batch {
    int           count;              /* triangles */
    int           parts;
    shade__part   part[SHADE__PARTS + 1];
    uint8_t       corner[SHADE__BATCH_TRIANGLES][4];    /* as in shade__setup */
    uint32_t      out;                /* the outcodes of all its vertices, ORed */
    shade__vertex vertex[SHADE_LANES];
    SHADE_ALIGNED float value[SHADE__BATCH_FLOATS];
} shade__batch;

typedef struct shade__incoming {
    shade_vertices   vertices;
    shade_vertex_ids ids;
    uint32_t known[2 * SHADE_LANES];  /* direct-mapped cache: an index in the batch */
    uint8_t  slot_of[2 * SHADE_LANES];    /* and its vertex */
} shade__incoming;

/* What clipping leaves of a triangle: a fan around its first corner. */
typedef struct shade__polygon {
    shade__vertex vertex[SHADE__CLIP_VERTICES];
    float    value[SHADE__CLIP_VERTICES * SHADE__VALUES_MAX];
    uint8_t  corner[SHADE__CLIP_VERTICES];
    int      count;                   /* corners, in order */
    uint32_t taken;                   /* bit v: vertex v is in use */
    int      in_front;                /* the triangle's corners all have w > 0 */
    int64_t  area;                    /* twice, in 1/65536 pixel, of the whole polygon */
} shade__polygon;

typedef struct shade__setup {
    /* the triangles as they were submitted */
    const shade__vertex *vertex;      /* indexed by corner: vertices of the batch or of a fan */
    const float *value;               /* and their values */
    int      count;
    int      of_fan;                  /* pieces of one clipped triangle, which has been counted */
    uint32_t primitive[SHADE__TRIANGLES];
    uint8_t  corner[SHADE__TRIANGLES][4];    /* the last: the vertex that CONSTANT takes */

    /* the triangles set up, with their corners in `order`: corner 0 is the far corner */
    SHADE_ALIGNED int64_t e[3][SHADE__TRIANGLES];   /* edges at the box's first pixel */
    int32_t  ex[3][SHADE__TRIANGLES], ey[3][SHADE__TRIANGLES];    /* their steps in x and y */
    int32_t  x0[SHADE__TRIANGLES], y0[SHADE__TRIANGLES];    /* the box of pixels, ends included; */
    int32_t  x1[SHADE__TRIANGLES], y1[SHADE__TRIANGLES];    /* empty where x1 < x0 or y1 < y0 */
    float    side[4][SHADE__TRIANGLES];      /* x1 y1 x2 y2 from the far corner, over 2 area */
    float    x_ref[SHADE__TRIANGLES], y_ref[SHADE__TRIANGLES];    /* 1/2 - far corner, exact */
    float    z0[SHADE__TRIANGLES];           /* the plane of depth: at the far corner */
    float    zx[SHADE__TRIANGLES], zy[SHADE__TRIANGLES];          /* and its steps in x and y */
    float    z_low[SHADE__TRIANGLES], z_high[SHADE__TRIANGLES];   /* of the corners, in [0, 1] */
    uint32_t order[SHADE__TRIANGLES]; /* an order of shade__make_planes; 3 .. 5: front-facing */
} shade__setup;

typedef struct shade__bounds {
    int   log_width, log_height;      /* log2 of the pixels that share a bound */
    int   across;                     /* bounds side by side; 0: not yet begun */
    float farthest[SHADE__BOUNDS];    /* at least plan.away times the depth of any pixel there */
} shade__bounds;

typedef struct shade__queue {
    shade_fragments f;                /* with perspective, its varyings are divided by w: the */
                                      /* flush multiplies them before the shader reads them */
    float    rw[SHADE_LANES];         /* 1/w, interpolated */
    float    step_square[SHADE_LANES];    /* |step to the next pixel|^2, in texels: for lod */
    uint32_t offset[SHADE_LANES];     /* of the pixel in color and depth, from the strip's first */
} shade__queue;

typedef struct shade__frustum shade__frustum;    /* of >>seen */

/* Indices of 32 bits or of 16; both NULL: 0, 1, 2, ... */
typedef struct shade__indices { const uint32_t *wide; const uint16_t *narrow; } shade__indices;

SHADE__INLINE uint32_t shade__index(shade__indices list, size_t i)
{
    if (list.wide) return list.wide[i];
    return list.narrow ? list.narrow[i] : (uint32_t)i;
}

/* The triangles of a draw, handed out in their order. */
typedef struct shade__supply {
    shade__indices indices;
    int first, end;                   /* of the triangles being taken */
    int (*more)(shade__draw *);       /* shade__next_chunk, linked with meshes only; or NULL */
    int chunks;                       /* how many are left */
    const shade_chunk *chunk;         /* the next one */
    const shade__frustum *frustum;    /* what they are tested against */
} shade__supply;

struct shade__draw {
    shade__plan    plan;
    shade__supply *supply;
    shade_stats    stats;
    float          spare_depth[SHADE__TILE];    /* a dummy row of depths */
    shade__bounds  bounds;
    shade__batch   batch;
    shade__setup   setup;
    union {                           /* one after the other in the same memory: */
        shade__incoming incoming;     /* until shade__to_window has returned */
        shade__queue    queue;        /* from shade__triangles to its last flush */
    } u;
};

/* vertices: takes the next triangles and their vertices, up to SHADE_LANES; then shades these */
static void shade__take_batch(shade__draw *d);
static void shade__shade_vertices(shade__draw *d);
/* triangles: sets up the batch's, SHADE__TRIANGLES at a time: edges, box, depth */
static void shade__triangles(shade__draw *d);
/* clip: the polygon that near, far, w > 0 and the guard band leave of a triangle; 0: nothing */
static int shade__clip(const shade__draw *d, const uint8_t corner[4], shade__polygon *polygon);
/* cover: finds the pixels of triangles that pass the depth test, tile by tile, as runs */
static void shade__cover(shade__draw *d, int count);
/* fragments: queues the runs; shades the queue when it is full and after each batch */
static void shade__push(shade__draw *d, const shade__run *run, int runs);
static void shade__flush(shade__draw *d);
/* store: late depth test, blending, formats; to the caller's memory */
static void shade__store(shade__draw *d, shade_colors *c);

/*--------------------------------------------------------------------------------------- >>vertices
   A batch: up to SHADE_LANES vertices, shaded and projected as one packet, and their triangles.
     in      indices                      out  vertices and their values; corners of triangles
     way     take_batch: take_triangles; shade_vertices: the user's shader, to_window: classify,
             project, gather
     holds   A vertex is shaded once a batch, or again if an index that shares its cache slot (equal
             modulo 2 SHADE_LANES) was taken in between.  A vertex without a window position gets a
             harmless one and a bit in its outcode; >>triangles then drops or clips its triangles.
                                                                                      >>triangles */

enum {
    SHADE__OUT_NEAR = 16, SHADE__OUT_FAR = 32,
    SHADE__OUT_GUARD_LEFT = 64, SHADE__OUT_GUARD_RIGHT = 128,
    SHADE__OUT_GUARD_BOTTOM = 256, SHADE__OUT_GUARD_TOP = 512,
    SHADE__OUT_GUARD = 15 << 6,                  /* each side of the guard band */
    SHADE__OUT_W = 1024,                         /* w < 2^-60 */
    SHADE__OUT_BAD = 2048,                       /* NaN, infinite or beyond 1e30 */
    SHADE__OUT_VOLUME = 63 | SHADE__OUT_W,       /* left, right, bottom, top; near, far; w */
    SHADE__OUT_CLIP = SHADE__OUT_NEAR | SHADE__OUT_FAR | SHADE__OUT_GUARD | SHADE__OUT_W,
    /* these leave a vertex without a window position */
    SHADE__OUT_UNPLACED = SHADE__OUT_GUARD | SHADE__OUT_W | SHADE__OUT_BAD
};
static const float shade__w_least = 8.67361738e-19f;    /* 2^-60 */

/* A window coordinate in 24.8: floor(256 X + 1/2) with X = (c/w + 1) size/2; half is 128 times the
   size, with its sign.
   pre: |c| <= 3 w, but for rounding   post: |result| <= 2^24; the sum is positive and below
   2^26, so that the cast rounds down */
SHADE__INLINE int32_t shade__snap(float c, float w, double half, double offset)
{
    return (int32_t)(((double)c / (double)w * half + offset + 0.5) + 16777216.0) - 16777216;
}

/* Window depth of z/w. */
SHADE__INLINE float shade__window_depth(float z, float w, double scale, double offset)
{
    return (float)((double)z / (double)w * scale + offset);
}

typedef struct shade__projected {           /* rows of projected vertices */
    SHADE_ALIGNED float x[SHADE_LANES];    /* clip space, made harmless */
    float    y[SHADE_LANES], w[SHADE_LANES];
    int32_t  x_fx8[SHADE_LANES], y_fx8[SHADE_LANES];
    uint32_t out[SHADE_LANES];
    float    z[SHADE_LANES], rw[SHADE_LANES];
} shade__projected;

/* All ones where |c| > 1e30 or NaN. */
SHADE__INLINE uint32_t shade__beyond(float c)
{
    return shade__mask(!shade__within(c, 1e30f));
}

/* Bits 0 .. 3: the point is left of, right of, below or above the square |x|, |y| <= limit. */
SHADE__INLINE uint32_t shade__sides_passed(float x, float y, float limit)
{
    return (shade__mask(x < -limit) & 1) | (shade__mask(x > limit) & 2) |
           (shade__mask(y < -limit) & 4) | (shade__mask(y > limit) & 8);
}

SHADE__INLINE uint32_t shade__outcode(float x, float y, float z, float w, int zero_to_one)
{
    const uint32_t nearer = shade__mask(z < (zero_to_one ? 0 : -w)) & SHADE__OUT_NEAR;
    const uint32_t farther = shade__mask(z > w) & SHADE__OUT_FAR;
    const uint32_t bad = shade__beyond(x) | shade__beyond(y) | shade__beyond(z) | shade__beyond(w);
    return shade__sides_passed(x, y, w) | nearer | farther | (bad & SHADE__OUT_BAD) |
           (shade__mask(w < shade__w_least) & SHADE__OUT_W);
}

/* Outcodes and clip positions.  A vertex without a window position gets 0, 0, 0, 1. */
SHADE__INLINE void shade__classify(const shade_vertices *SHADE_RESTRICT v, int zero_to_one,
                                   shade__projected *SHADE_RESTRICT p)
{
    shade__in cx = v->clip[0], cy = v->clip[1], cz = v->clip[2], cw = v->clip[3];
    SHADE_EACH_LANE(i) {
        const float x = cx[i], y = cy[i], z = cz[i], w = cw[i];
        const uint32_t out = shade__outcode(x, y, z, w, zero_to_one) |
                             shade__sides_passed(x, y, 3 * w) << 6;
        const uint32_t unplaced = shade__mask((out & SHADE__OUT_UNPLACED) != 0);
        p->out[i] = out;
        p->x[i] = shade__keep(x, ~unplaced);
        p->y[i] = shade__keep(y, ~unplaced);
        p->z[i] = shade__keep(z, ~unplaced);
        p->w[i] = shade__select(w, 1, unplaced);
    }
}

SHADE__INLINE void shade__project(double half_width, double half_height, int zero_to_one,
                                  shade__projected *SHADE_RESTRICT p)
{
    const double scale = zero_to_one ? 1 : 0.5, offset = zero_to_one ? 0 : 0.5;
    SHADE_EACH_LANE(i) { p->x_fx8[i] = shade__snap(p->x[i], p->w[i], half_width, half_width); }
    SHADE_EACH_LANE(i) { p->y_fx8[i] = shade__snap(p->y[i], p->w[i], -half_height, half_height); }
    SHADE_EACH_LANE(i) { p->z[i] = shade__window_depth(p->z[i], p->w[i], scale, offset); }
    SHADE_EACH_LANE(i) { p->rw[i] = 1 / p->w[i]; }
}

/* Turns rows into one record for each vertex, so that a triangle finds its corners in one place. */
SHADE__INLINE void shade__gather(const shade__plan *SHADE_RESTRICT plan, int n,
                                 const shade_vertices *SHADE_RESTRICT v,
                                 const shade__projected *SHADE_RESTRICT p,
                                 shade__batch *SHADE_RESTRICT b)
{
    const int stride = plan->value_stride, varyings = plan->varyings;
    b->out = 0;
    for (int i = 0; i < n; i++) {
        shade__vertex *to = &b->vertex[i];
        float *value = b->value + i * stride;
        to->x = p->x_fx8[i];
        to->y = p->y_fx8[i];
        to->out = p->out[i];
        b->out |= p->out[i];
        SHADE__FOR_4(k) to->clip[k] = v->clip[k][i];
        value[0] = p->z[i];
        value[1] = p->rw[i];
    }

    for (int k = SHADE__FIRST; k < plan->values; k++) {
        const int again = k - varyings - SHADE__FIRST;    /* u and v a second time */
        const float *from = v->varying[again < 0 ? k - SHADE__FIRST
                                                 : plan->pipe->lod_varying + again];
        float *to = b->value + k;
        if (k < plan->first_divided)
            for (int i = 0; i < n; i++) to[i * stride] = from[i];
        else
            for (int i = 0; i < n; i++) to[i * stride] = from[i] * p->rw[i];
    }
}

SHADE__INLINE void shade__to_window_body(shade__draw *d, const shade_vertices *vertices)
{
    const shade__plan *plan = &d->plan;
    shade__projected p;
    shade__classify(vertices, plan->zero_to_one, &p);
    shade__project(plan->half_width, plan->half_height, plan->zero_to_one, &p);
    shade__gather(plan, d->u.incoming.ids.count, vertices, &p, &d->batch);
}
SHADE__DISPATCH_AVX2(shade__to_window, (shade__draw *d, const shade_vertices *vertices),
                     (d, vertices), shade__to_window_body(d, vertices))

static void shade__shade_vertices(shade__draw *d)
{
    shade_vertices *v = &d->u.incoming.vertices;
    shade_vertex_ids *ids = &d->u.incoming.ids;
    const int varyings = d->plan.varyings;
    for (int i = ids->count; i < SHADE_LANES; i++) ids->index[i] = ids->index[ids->count - 1];
    SHADE__ZERO(v->clip);
    if (varyings) SHADE_MEMSET(v->varying, 0, (size_t)varyings * sizeof v->varying[0]);
    d->plan.pipe->vertex(d->plan.pipe->uniforms, ids, v);
    shade__to_window(d, v);
}

/* Takes up to `most` triangles from `first` on, as long as there are at most `room` vertices;
   returns the number taken.  A cache hit takes no branch: slot and index are written anyway, and
   only the count differs.  A branch would be mispredicted every other time, which costs 2 % of a
   dense mesh. */
SHADE__INLINE int shade__take_triangles(shade__incoming *in, shade__indices indices, uint32_t first,
                                        int most, int room, uint8_t (*corner)[4])
{
    uint32_t *index_of = in->ids.index, at = 3 * first;
    int n = 0, vertices = in->ids.count;
    for (; n < most && vertices <= room; n++) {
        for (int k = 0; k < 3; k++, at++) {
            const uint32_t index = shade__index(indices, at);
            const int entry = (int)(index & (2 * SHADE_LANES - 1)), hit = in->known[entry] == index;
            const int slot = vertices + ((in->slot_of[entry] - vertices) & -hit);
            index_of[vertices] = index;
            vertices += 1 - hit;
            in->known[entry] = index;
            in->slot_of[entry] = (uint8_t)slot;
            corner[n][k] = (uint8_t)slot;
        }
        corner[n][3] = corner[n][0];
    }
    in->ids.count = vertices;
    return n;
}

/* Makes a batch of the next triangles of the draw; its count is 0 at the end. */
static void shade__take_batch(shade__draw *d)
{
    shade__incoming *in = &d->u.incoming;
    shade__batch *b = &d->batch;
    shade__supply *s = d->supply;
    /* with this many vertices one more triangle fits */
    const int room = shade__min(SHADE_LANES, (int)SHADE__BATCH_FLOATS / d->plan.value_stride) - 3;

    SHADE_MEMSET(in->known, 255, sizeof in->known);    /* no index: counts end at 2^31 */
    in->ids.count = b->count = b->parts = 0;
    while (b->count < SHADE__BATCH_TRIANGLES && in->ids.count <= room && b->parts < SHADE__PARTS) {
        if (s->first == s->end && !(s->more && s->more(d))) break;
        const int most = shade__min(SHADE__BATCH_TRIANGLES - b->count, s->end - s->first);
        b->part[b->parts].first = b->count;
        b->part[b->parts++].primitive = (uint32_t)s->first;
        const int taken = shade__take_triangles(in, s->indices, (uint32_t)s->first, most, room,
                                                b->corner + b->count);
        b->count += taken;
        s->first += taken;
    }
    b->part[b->parts].first = b->count;
}

/*-------------------------------------------------------------------------------------- >>triangles
   Each triangle of a batch is dropped, cut by >>clip, or set up, SHADE__TRIANGLES at a time, a lane
   each: three snapped vertices become three edge functions, a box of pixels and the plane of depth.
   The planes of the other values are made when a pixel is drawn.                       [Pineda88]
     in      positions in 24.8 fixed point, |x|, |y| <= 2^24; depths and 1/w
     out     triangles set up in the order of submission, to >>cover
     way     triangles: sort_out: draw_fan, add_triangles; draw_setup: set_up: fetch_corners, areas,
             choose_turns, turn, box, make_edge, sides, depth_plane, cull
     holds   For the edge p to q and the pixel centre at 256 (i, j) + 128:
               256 e(i,j) + rest = (q.x - p.x)(y - p.y) - (q.y - p.y)(x - p.x) + bias
             A pixel is inside where all three e >= 0.  The coefficients of i and j are multiples
             of 256, so rest is the same for all pixels, and steps of e are exact.  Neighbours get
             exactly opposite edges.  All values are integers below 2^53, exact in double.

             Corners are reordered so that they turn clockwise on the screen and corner 0 is the far
             corner, the farthest from the eye.  Planes start there: its 1/w is the smallest, and
             rounding hurts it most.  The bias of the edges 0 1, 1 2, 2 0 is the top-left rule:

                 0 -----> 1        top edge, bias 0
                  ^      /         A centre exactly on a shared edge is inside the triangle
        left edge  \    /          that has the edge on its top or left, and outside the
        bias 0      \  v           other one, because there e + bias is -1: it belongs to
                     2             one of them.  Right and bottom edges: bias -1.
                                                                                           >>clip */

/* Corners of the triangles being set up: as submitted, or in the order of the setup, which puts the
   far corner first and leaves rw out. */
typedef struct shade__corner_rows {
    SHADE_ALIGNED int32_t x[3][SHADE__TRIANGLES];
    int32_t y[3][SHADE__TRIANGLES];
    float   z[3][SHADE__TRIANGLES], rw[3][SHADE__TRIANGLES];
} shade__corner_rows;

/* As masks: which corner comes first, and whether the other two are swapped. */
typedef struct shade__turns {
    SHADE_ALIGNED uint32_t first_is_1[SHADE__TRIANGLES];
    uint32_t first_is_2[SHADE__TRIANGLES], flipped[SHADE__TRIANGLES];
} shade__turns;

/* floor(v / 256)   pre: |v| < 2^30 */
SHADE__INLINE int32_t shade__floor256(int32_t v)
{
    return (int32_t)((uint32_t)(v + 0x40000000) >> 8) - 0x400000;
}

/* Twice the signed area in 1/65536 pixel; positive where a, b, c turn clockwise on the screen (y
   points down).   pre: |x|, |y| <= 2^24   post: |area| <= 2^51 */
SHADE__INLINE int64_t shade__area(const shade__vertex *a, const shade__vertex *b,
                                  const shade__vertex *c)
{
    return (int64_t)(b->x - a->x) * (c->y - a->y) - (int64_t)(c->x - a->x) * (b->y - a->y);
}

/* Rows of memory of any type, as words. */
SHADE__INLINE shade__word *shade__words(void *rows) { return (shade__word *)rows; }

/* Reads the corners of the triangles into rows; lanes without a triangle repeat triangle 0. */
SHADE__INLINE void shade__fetch_corners(shade__setup *SHADE_RESTRICT s, int stride,
                                        shade__corner_rows *SHADE_RESTRICT c)
{
    SHADE_ALIGNED int32_t xy[3][2 * SHADE__TRIANGLES];
    SHADE_ALIGNED float zw[3][2 * SHADE__TRIANGLES];
    for (int i = s->count; i < SHADE__TRIANGLES; i++) SHADE_MEMCPY(s->corner[i], s->corner[0], 4);
    for (int i = 0; i < SHADE__TRIANGLES; i++) {
        for (int k = 0; k < 3; k++) {    /* x, y begin a vertex, and z, 1/w its values */
            const int v = s->corner[i][k];
            SHADE_MEMCPY(&xy[k][2 * i], &s->vertex[v], 8);
            SHADE_MEMCPY(&zw[k][2 * i], s->value + v * stride, 8);
        }
    }

    for (int k = 0; k < 3; k++) {
        SHADE__FOR(i, SHADE__TRIANGLES) {
            c->x[k][i] = xy[k][2 * i];
            c->y[k][i] = xy[k][2 * i + 1];
        }
        SHADE__FOR(i, SHADE__TRIANGLES) {
            c->z[k][i] = zw[k][2 * i];
            c->rw[k][i] = zw[k][2 * i + 1];
        }
    }
}

/* area: twice the signed area.  inverse: 256 / |area|, or 256 for an area of 0: programs may trap
   divisions by zero. */
SHADE__INLINE void shade__areas(const shade__corner_rows *SHADE_RESTRICT c, shade__out area,
                                double *SHADE_RESTRICT inverse)
{
    SHADE__FOR(i, SHADE__TRIANGLES) {
        double x1 = c->x[1][i] - c->x[0][i], y1 = c->y[1][i] - c->y[0][i];
        double x2 = c->x[2][i] - c->x[0][i], y2 = c->y[2][i] - c->y[0][i];
        double a = x1 * y2 - x2 * y1;
        area[i] = (float)a;
        inverse[i] = 256 / (shade__abs(a) + (a == 0 ? 1 : 0));
    }
}

/* Chooses the order of the corners, far corner first, and writes its number, 0 .. 5, to order. */
SHADE__INLINE void shade__choose_turns(const shade__corner_rows *SHADE_RESTRICT c, shade__in area,
                                       shade__turns *SHADE_RESTRICT t, shade__out_bits order)
{
    SHADE__FOR(i, SHADE__TRIANGLES) {
        float r0 = c->rw[0][i], r1 = c->rw[1][i], r2 = c->rw[2][i];
        uint32_t below = shade__mask(r1 < r0);
        uint32_t last = (below & shade__mask(r2 < r1)) | (~below & shade__mask(r2 < r0));
        uint32_t flipped = shade__mask(area[i] < 0);
        t->first_is_1[i] = below & ~last;
        t->first_is_2[i] = last;
        t->flipped[i] = flipped;
        order[i] = (below & ~last & 1) + (last & 2) + (flipped & 3);
    }
}

/* Reorders one value of the three corners: the far corner first, then the others in their order, or
   swapped where flipped is set. */
SHADE__INLINE void shade__turn(const shade__word *SHADE_RESTRICT v,
                               const shade__turns *SHADE_RESTRICT t, shade__word *SHADE_RESTRICT to)
{
    SHADE__FOR(i, SHADE__TRIANGLES) {
        const uint32_t is_1 = t->first_is_1[i], is_2 = t->first_is_2[i];
        uint32_t a = v[i], b = v[i + SHADE__TRIANGLES], c = v[i + 2 * SHADE__TRIANGLES];
        uint32_t next = shade__choose(shade__choose(b, c, is_1), a, is_2);
        uint32_t last = shade__choose(shade__choose(c, a, is_1), b, is_2);
        to[i] = shade__choose(shade__choose(a, b, is_1), c, is_2);
        to[i + SHADE__TRIANGLES] = shade__choose(next, last, t->flipped[i]);
        to[i + 2 * SHADE__TRIANGLES] = shade__choose(last, next, t->flipped[i]);
    }
}

/* The range of pixel centres between three corners along one axis, within lo .. hi, ends included.
   pre: |corner| <= 2^24, 0 <= lo, hi < 2^14
   post: 0 <= first <= 2^16, -2^16 - 1 <= last < 2^14; the box is empty where first > last */
SHADE__INLINE void shade__box(int32_t (*corner)[SHADE__TRIANGLES], int32_t lo, int32_t hi,
                              shade__out_ints first, shade__out_ints last)
{
    shade__in_ints a = corner[0], b = corner[1], c = corner[2];
    SHADE__FOR(i, SHADE__TRIANGLES) {
        int32_t least = shade__min(shade__min(a[i], b[i]), c[i]);
        int32_t most = shade__max(shade__max(a[i], b[i]), c[i]);
        first[i] = shade__max(shade__floor256(least + 127), lo);
        last[i] = shade__min(shade__floor256(most - 128), hi);
    }
}

/* The nearest integer   pre: |x| < 2^51 */
SHADE__INLINE int64_t shade__round(double x)
{
    return (int64_t)(shade__double_bits(x + 6755399441055744.0) - 0x4338000000000000u);
}

/* The edge from corner k to the next, at the first pixel of the box, and its steps.  With the
   integer v = 256 e + rest, e = floor(v / 256) is v / 256 - 127.5/256 rounded to the nearest.  Left
   edges have dy < 0, top edges dy = 0 and dx > 0: their bias is 0, the others' -1.
   pre: |q - p| <= 2^25, so that all is exact   post: |e| <= 2^43, |step| <= 2^25 */
SHADE__INLINE void shade__make_edge(const shade__corner_rows *SHADE_RESTRICT c, int k,
                                    shade__setup *SHADE_RESTRICT s)
{
    const int next = k < 2 ? k + 1 : 0;
    SHADE__FOR(i, SHADE__TRIANGLES) {
        const int32_t dx = c->x[next][i] - c->x[k][i], dy = c->y[next][i] - c->y[k][i];
        const double x = s->x0[i] * 256 + 128 - c->x[k][i];
        const double y = s->y0[i] * 256 + 128 - c->y[k][i];
        const double bias = 2 * dy - (dx > 0 ? 1 : 0) < 0 ? 0 : -1;
        const double e = dx * y - dy * x + bias;
        s->e[k][i] = shade__round(e * (1 / 256.0) - 127.5 / 256);
        s->ex[k][i] = -dy;
        s->ey[k][i] = dx;
    }
}

/* The sides from the far corner to 1 and 2 over twice the area, for planes: x1, y1, x2, y2. */
SHADE__INLINE void shade__sides(const shade__corner_rows *SHADE_RESTRICT c,
                                const double *SHADE_RESTRICT inverse,
                                shade__setup *SHADE_RESTRICT s)
{
    for (int k = 0; k < 2; k++)
        SHADE__FOR(i, SHADE__TRIANGLES) {
            s->side[2 * k][i] = (float)((c->x[k + 1][i] - c->x[0][i]) * inverse[i]);
            s->side[2 * k + 1][i] = (float)((c->y[k + 1][i] - c->y[0][i]) * inverse[i]);
        }
}

/* The plane of depth.  Pixels clamp it to the least and greatest depth of the corners, because on
   slivers rounding leaves that range.   post: z_low, z_high in [0, 1] */
SHADE__INLINE void shade__depth_plane(const shade__corner_rows *SHADE_RESTRICT c, float bias,
                                      shade__setup *SHADE_RESTRICT s)
{
    SHADE__FOR(i, SHADE__TRIANGLES) {
        float z0 = c->z[0][i], z1 = c->z[1][i], z2 = c->z[2][i], d1 = z1 - z0, d2 = z2 - z0;
        float least = shade__select(z0, z1, shade__mask(z1 < z0));
        float most = shade__select(z0, z1, shade__mask(z1 > z0));
        least = shade__select(least, z2, shade__mask(z2 < least));
        most = shade__select(most, z2, shade__mask(z2 > most));
        s->z_low[i] = shade__clamp_bits(least + bias, 0, 1);
        s->z_high[i] = shade__clamp_bits(most + bias, 0, 1);
        s->z0[i] = z0 + bias;
        s->zx[i] = d1 * s->side[3][i] - d2 * s->side[1][i];
        s->zy[i] = d2 * s->side[0][i] - d1 * s->side[2][i];
    }
    SHADE__FOR(i, SHADE__TRIANGLES) {
        s->x_ref[i] = 0.5f - (float)c->x[0][i] * (1 / 256.0f);
        s->y_ref[i] = 0.5f - (float)c->y[0][i] * (1 / 256.0f);
    }
}

/* Empties the boxes of culled triangles, by x1 = -1; returns their number. */
SHADE__INLINE int shade__cull(shade__setup *SHADE_RESTRICT s, shade_cull cull, shade__in area)
{
    const uint32_t back = shade__mask(cull == SHADE_CULL_BACK);
    const uint32_t front = shade__mask(cull == SHADE_CULL_FRONT);
    const int n = s->count;
    int culled = 0;
    SHADE__FOR(i, SHADE__TRIANGLES) {
        uint32_t none = shade__mask(area[i] == 0), facing = shade__mask(area[i] < 0);
        uint32_t gone = (none | (facing & front) | (~facing & back)) & shade__mask(i < n);
        culled += (int)(gone & 1);
        s->x1[i] = (int32_t)((uint32_t)s->x1[i] | gone);
    }
    return culled;
}

SHADE__INLINE void shade__set_up_body(shade__draw *d)
{
    shade__setup *s = &d->setup;
    const shade__plan *plan = &d->plan;
    const shade_raster *raster = &plan->pipe->raster;
    SHADE_ALIGNED float area[SHADE__TRIANGLES];
    SHADE_ALIGNED double inverse[SHADE__TRIANGLES];
    shade__corner_rows given, c;
    shade__turns turns;
    shade__fetch_corners(s, plan->value_stride, &given);
    shade__areas(&given, area, inverse);
    shade__choose_turns(&given, area, &turns, s->order);
    shade__turn(shade__words(&given.x), &turns, shade__words(&c.x));
    shade__turn(shade__words(&given.y), &turns, shade__words(&c.y));
    shade__turn(shade__words(&given.z), &turns, shade__words(&c.z));
    shade__box(c.x, plan->x0, plan->x1 - 1, s->x0, s->x1);
    shade__box(c.y, plan->y0, plan->y1 - 1, s->y0, s->y1);
    for (int k = 0; k < 3; k++) shade__make_edge(&c, k, s);
    shade__sides(&c, inverse, s);
    shade__depth_plane(&c, raster->depth_bias, s);

    if (!s->of_fan) {
        const int culled = shade__cull(s, raster->cull, area);
        d->stats.culled += culled;
        d->stats.drawn += s->count - culled;
    }
}
SHADE__DISPATCH_AVX2(shade__set_up, (shade__draw *d), (d), shade__set_up_body(d))

/* Sets up and draws the triangles collected so far. */
static void shade__draw_setup(shade__draw *d)
{
    const int n = d->setup.count;
    if (!n) return;
    shade__set_up(d);
    d->setup.count = 0;
    shade__cover(d, n);
}

/* Adds consecutive triangles; the first is triangle primitive of the draw. */
SHADE__INLINE void shade__add_triangles(shade__draw *d, uint8_t (*corner)[4], int count,
                                        uint32_t primitive)
{
    shade__setup *s = &d->setup;
    while (count > 0) {
        const int n = shade__min(count, SHADE__TRIANGLES - s->count);
        for (int i = 0; i < n; i++) {
            SHADE_MEMCPY(s->corner[s->count + i], corner[i], 4);
            s->primitive[s->count + i] = primitive++;
        }
        corner += n;
        count -= n;
        s->count += n;
        if (s->count == SHADE__TRIANGLES) shade__draw_setup(d);
    }
}

/* Clips a triangle and draws the resulting fan.  The area of the whole polygon decides culling.
   Pieces that snapping has turned the other way are left out. */
static SHADE__COLD void shade__draw_fan(shade__draw *d, const uint8_t corner[4], uint32_t primitive)
{
    const shade_cull cull = d->plan.pipe->raster.cull;
    shade__setup *s = &d->setup;
    shade__polygon polygon;
    if (!shade__clip(d, corner, &polygon)) {
        d->stats.clipped++;
        return;
    }
    if (!polygon.area || cull == (polygon.area < 0 ? SHADE_CULL_FRONT : SHADE_CULL_BACK)) {
        d->stats.culled++;
        return;
    }
    d->stats.drawn++;
    shade__draw_setup(d);    /* first the triangles submitted before */

    s->vertex = polygon.vertex;
    s->value = polygon.value;
    s->of_fan = 1;
    for (int i = 1; i + 1 < polygon.count; i++) {
        const uint8_t *corner_of = polygon.corner;
        uint8_t piece[1][4] = { { corner_of[0], corner_of[i], corner_of[i + 1], 0 } };
        const shade__vertex *v = polygon.vertex;
        const int64_t area = shade__area(&v[piece[0][0]], &v[piece[0][1]], &v[piece[0][2]]);
        if (area && (area < 0) == (polygon.area < 0)) shade__add_triangles(d, piece, 1, primitive);
    }
    shade__draw_setup(d);

    s->vertex = d->batch.vertex;
    s->value = d->batch.value;
    s->of_fan = 0;
}

/* Rejects, clips or adds a triangle of the batch, by where its corners are. */
SHADE__INLINE void shade__sort_out(shade__draw *d, int triangle, uint32_t primitive)
{
    const shade__vertex *v = d->batch.vertex;
    const uint8_t *corner = d->batch.corner[triangle];
    const uint32_t out0 = v[corner[0]].out, out1 = v[corner[1]].out, out2 = v[corner[2]].out;
    const uint32_t any = out0 | out1 | out2;
    if (any) {
        if (any & SHADE__OUT_BAD) {
            d->stats.rejected++;
            return;
        }
        if (out0 & out1 & out2 & SHADE__OUT_VOLUME) {
            d->stats.clipped++;
            return;
        }
        if (any & SHADE__OUT_CLIP) {
            shade__draw_fan(d, corner, primitive);
            return;
        }
    }
    shade__add_triangles(d, d->batch.corner + triangle, 1, primitive);
}

static void shade__triangles(shade__draw *d)
{
    shade__batch *b = &d->batch;
    d->setup.vertex = b->vertex;
    d->setup.value = b->value;
    d->setup.count = 0;
    d->u.queue.f.count = 0;
    for (int i = 0; i < b->parts; i++) {
        const int first = b->part[i].first, end = b->part[i + 1].first;
        uint32_t primitive = b->part[i].primitive;
        if (!b->out) shade__add_triangles(d, b->corner + first, end - first, primitive);
        else for (int k = first; k < end; k++) shade__sort_out(d, k, primitive++);
    }
    shade__draw_setup(d);
    shade__flush(d);
}

/*------------------------------------------------------------------------------------------- >>clip
   Cuts triangles that cross near, far, w = 2^-60 (behind the eye) or the guard band, |x| and |y| at
   most 3 w, plane by plane, and leaves a fan.                                     [Sutherland74]
     in      three vertices of the batch     out  a polygon
     way     clip: polygon_of; clip_plane: new_vertex; polygon_to_window; apex
     method  SHADE__CLIP_VERTICES is 13: 3 corners, 7 more because each plane adds at most one, 2
             while a plane cuts, and vertex 0, kept for CONSTANT.  A polygon that rounding made
             concave may need more vertices, and is dropped.  >>triangles drops other triangles:
             shade__sort_out those with all corners outside one plane, shade__draw_fan those that
             clipping leaves culled or without area.

               3w  +-----------------------+
                   |      guard band       |      A corner between the picture and the guard band
                   |      +---------+      |      stays: the box of pixels ends at the picture
                w  |      |   c ---------- p - b  anyway.  A corner beyond the band is cut off:
                   |      | picture |      |      q and p replace b, and the polygon a q p c is a
               -w  |      +---------+      q      fan around a corner for which all its triangles
                   |         a        '    |      turn the same way, here a q p and a p c.
              -3w  +-----------------------+

     holds   A new vertex is computed from the inner to the outer end of its edge, so that
             neighbours get the same bits and no crack opens.                             >>tiles */

/* Returns the signed distance to a plane times a positive factor; it is >= 0 inside. */
static double shade__distance_to(const float *clip, uint32_t plane, int zero_to_one)
{
    double p[4];
    shade__doubles(clip, 4, p);
    const double x = p[0], y = p[1], z = p[2], w = p[3];
    switch (plane) {
    case SHADE__OUT_NEAR: return zero_to_one ? z : z + w;
    case SHADE__OUT_FAR: return w - z;
    case SHADE__OUT_GUARD_LEFT: return 3 * w + x;
    case SHADE__OUT_GUARD_RIGHT: return 3 * w - x;
    case SHADE__OUT_GUARD_BOTTOM: return 3 * w + y;
    case SHADE__OUT_GUARD_TOP: return 3 * w - y;
    default: return w - (double)shade__w_least;
    }
}

/* The number at the fraction t between two numbers, in double, then rounded to float. */
static float shade__between(float from, float to, double t)
{
    const double a = (double)from;
    return (float)(a + t * ((double)to - a));
}

/* Adds the vertex where an edge crosses a plane, at the fraction t from in to out.  On the screen
   that is the fraction s = d_in w_out / (d_in w_out - d_out w_in).  Since d_out is negative, both
   terms are positive and no digits are lost, however different the two w are.
   pre: d_in >= 0 > d_out, a bit of taken is free */
static uint8_t shade__new_vertex(const shade__plan *plan, shade__polygon *p, int in, int out,
                                 double d_in, double d_out)
{
    double t = d_in / (d_in - d_out), s = t;
    const int v = SHADE__LOWEST_BIT(~p->taken), stride = plan->value_stride;
    const float *from = p->vertex[in].clip, *to = p->vertex[out].clip;
    SHADE_ASSERT(v < SHADE__CLIP_VERTICES);
    p->taken |= 1u << v;
    if (p->in_front) {    /* else the edge may have no place on the screen */
        /* rounding may leave a new vertex without w */
        double inner = d_in * (double)shade__maxf(to[3], shade__w_least);
        s = inner / (inner - d_out * (double)shade__maxf(from[3], shade__w_least));
    }
    for (int k = 0; k < 4; k++) p->vertex[v].clip[k] = shade__between(from[k], to[k], t);
    for (int k = SHADE__FIRST; k < plan->values; k++) {
        const float a = p->value[in * stride + k], b = p->value[out * stride + k];
        p->value[v * stride + k] = shade__between(a, b, k < plan->first_divided ? s : t);
    }
    return (uint8_t)v;
}

/* pre: taken has vertex 0 and the corners   post: at most SHADE__CLIP_VERTICES corners, since each
   new one takes a bit of taken */
static void shade__clip_plane(const shade__plan *plan, shade__polygon *p, uint32_t plane)
{
    const int zero_to_one = plan->zero_to_one;
    uint8_t kept[SHADE__CLIP_VERTICES];
    int count = 0;
    for (int i = 0; i < p->count; i++) {
        if (p->taken + 1 >= 1u << SHADE__CLIP_VERTICES) {    /* an edge adds one at most */
            p->count = 0;    /* rounding made it concave, and no place is free: drop it */
            return;
        }
        uint8_t a = p->corner[i], b = p->corner[i + 1 < p->count ? i + 1 : 0];
        double da = shade__distance_to(p->vertex[a].clip, plane, zero_to_one);
        double db = shade__distance_to(p->vertex[b].clip, plane, zero_to_one);
        if (da >= 0) kept[count++] = a;
        if (da >= 0 && db < 0) kept[count++] = shade__new_vertex(plan, p, a, b, da, db);
        if (da < 0 && db >= 0) kept[count++] = shade__new_vertex(plan, p, b, a, db, da);
    }

    p->count = count;
    p->taken = 1;
    for (int i = 0; i < count; i++) {
        p->corner[i] = kept[i];
        p->taken |= 1u << kept[i];
    }
}

/* Makes the polygon of a triangle.  Its values are linear in clip space: values over w are
   multiplied by w.  Returns the planes that the triangle crosses. */
static uint32_t shade__polygon_of(const shade__plan *plan, const shade__batch *b,
                                  const uint8_t corner[4], shade__polygon *p)
{
    const int stride = plan->value_stride;
    uint32_t out = 0;
    p->count = 3;
    p->taken = 7;
    p->in_front = 1;
    SHADE__ZERO(p->value);
    for (int i = 0; i < 3; i++) {
        const float *value = b->value + corner[i] * stride;
        const shade__vertex *v = &b->vertex[corner[i]];
        float w = v->out & SHADE__OUT_UNPLACED ? 1 : v->clip[3];
        p->vertex[i] = *v;
        p->corner[i] = (uint8_t)i;
        for (int k = SHADE__FIRST; k < plan->values; k++)
            p->value[i * stride + k] = value[k] * (k < plan->first_divided ? 1 : w);
        out |= v->out;
        p->in_front &= v->clip[3] > 0;
    }
    return out;
}

/* Window positions and values of the corners, computed as in >>vertices.
   post: |x|, |y| <= 2^23 */
static void shade__polygon_to_window(const shade__plan *plan, shade__polygon *p)
{
    const int zero_to_one = plan->zero_to_one;
    const double half_width = plan->half_width, half_height = plan->half_height;
    for (int i = 0; i < p->count; i++) {
        shade__vertex *v = &p->vertex[p->corner[i]];
        float w = shade__maxf(v->clip[3], shade__w_least), rw = 1 / w;
        float *value = p->value + p->corner[i] * plan->value_stride;
        for (int k = 0; k < 3; k++)    /* rounding may leave a new vertex a little outside */
            v->clip[k] = shade__maxf(-3 * w, shade__minf(v->clip[k], 3 * w));
        v->x = shade__snap(v->clip[0], w, half_width, half_width);
        v->y = shade__snap(v->clip[1], w, -half_height, half_height);
        value[0] = shade__window_depth(v->clip[2], w, zero_to_one ? 1 : 0.5, zero_to_one ? 0 : 0.5);
        value[1] = rw;
        for (int k = plan->first_divided; k < plan->values; k++) value[k] *= rw;
    }
}

/* Twice the area of the triangle of corners a, a + i, a + i + 1. */
static int64_t shade__fan_area(const shade__polygon *p, int a, int i)
{
    return shade__area(&p->vertex[p->corner[a]], &p->vertex[p->corner[(a + i) % p->count]],
                       &p->vertex[p->corner[(a + i + 1) % p->count]]);
}

/* Returns a corner around which all triangles of the fan turn as the polygon does, or 0 if there is
   none: snapping may have dented the polygon. */
static int shade__apex(const shade__polygon *p)
{
    for (int a = 0; a < p->count; a++) {
        int good = 1;
        for (int i = 1; i + 1 < p->count; i++) {
            int64_t s = shade__fan_area(p, a, i);
            good &= p->area < 0 ? s <= 0 : s >= 0;
        }
        if (good) return a;
    }
    return 0;
}

static int shade__clip(const shade__draw *d, const uint8_t corner[4], shade__polygon *polygon)
{
    const shade__plan *plan = &d->plan;
    const uint32_t out = shade__polygon_of(plan, &d->batch, corner, polygon);
    uint8_t order[SHADE__CLIP_VERTICES];
    int apex;
    for (uint32_t plane = SHADE__OUT_NEAR; plane <= SHADE__OUT_W && polygon->count; plane *= 2)
        if (out & plane) shade__clip_plane(plan, polygon, plane);
    if (polygon->count < 3) return 0;

    shade__polygon_to_window(plan, polygon);
    polygon->area = 0;
    for (int i = 1; i + 1 < polygon->count; i++) polygon->area += shade__fan_area(polygon, 0, i);
    apex = shade__apex(polygon);
    for (int i = 0; i < polygon->count; i++)
        order[i] = polygon->corner[(apex + i) % polygon->count];
    SHADE_MEMCPY(polygon->corner, order, (size_t)polygon->count);
    return 1;
}

/*------------------------------------------------------------------------------------------ >>tiles
   The pixels of a tile that are inside a triangle and pass the depth test.
     in      a triangle that was set up, tiles of its box
     out     depth (early test), runs of pixels for >>fragments
     way     tile_columns, tile_depth, tile_edges; test_tile: test_columns; add_tile: add_set, send
     method  A tile is 32 x 8 pixels.  For each edge, a tile is outside (skipped), inside (the edge
             is ignored) or crossed.  In a crossed tile |e| <= 32 |ex| + 7 |ey| fits 32 bits,
             however large the triangle is.  Rows of tiles begin and end at the edges, so that time
             depends on the number of tiles that the triangle touches.

               x                    x + columns       columns: tested, a multiple of the vectors
               |     skip                |            skip: tested, but left out, because the tile
               . . . | # # # # - - # # # |  row 0           was moved left into the clip rectangle
               . . . | - # # # # # # # # |  row 1     #: inside and passed; a bit of set[row]
                       |     |     |   |
                       run 0       run 1              runs of row 0: x, y, n of pixels in a row

             The only run of a row stays open: the next tile to the right may extend it.
     holds   Stores stay in the clip rectangle, that is, in the pixels of this thread.  A value at
             a pixel has the same bits whichever tile it is in: the base of its row plus the step
             in x times the exact distance.                                               >>cover */

enum {
    SHADE__RUNS = SHADE_LANES < 64 ? 12 : 16,
    SHADE__RUNS_AHEAD = SHADE__RUNS - (int)SHADE__TILE_ROWS,    /* leaves one for each row */
    SHADE__SKIPPED = -(1 << 30)    /* e of a skipped pixel: it stays negative in all rows */
};

/* Edge functions in 32 bits: e at pixel (x, y), and their steps in x and y. */
typedef struct shade__edges { int x, y; int32_t e[3], ex[3], ey[3]; } shade__edges;

/* A triangle while its pixels are found. */
typedef struct shade__triangle {
    int      x0, y0, x1, y1;          /* the box of pixels, ends included */
    int      index;                   /* in the setup */
    int64_t  e[3];                    /* edge functions at pixel (x0, y0) */
    shade__edges edges;               /* the steps; e is set by shade__cover_columns alone */
    float    x_ref, y_ref;
    float    z0, zx, zy, z_low, z_high;
} shade__triangle;

/* Up to 32 pixels of up to 8 rows. */
typedef struct shade__tile {
    int      x, y, rows;
    int      skip, columns;           /* columns left out, on the left; columns tested */
    float   *depth;                   /* of the first pixel */
    int      stride;
    const shade__edges *edges;        /* what the pixels are tested against */
    float    row_z[SHADE__TILE_ROWS]; /* depth of each row at the far corner's x */
    uint32_t set[SHADE__TILE_ROWS];   /* bit i: pixel x + i is drawn */
    uint32_t any;                     /* 0: all sets are empty */
} shade__tile;

/* Runs of pixels on their way to the queue, sent when the array is nearly full. */
typedef struct shade__runs {
    shade__run run[SHADE__RUNS + 1];  /* the last is a sentinel that no run can extend */
    int count;
    int next;                         /* not of the runs: the triangle of the setup to draw next */
    int open[SHADE__TILE_ROWS];       /* the run in each row that the next tile may extend */
} shade__runs;

SHADE__INLINE void shade__triangle_of(const shade__setup *s, int i, shade__triangle *t)
{
    t->x0 = t->edges.x = s->x0[i];
    t->y0 = t->edges.y = s->y0[i];
    t->x1 = s->x1[i];
    t->y1 = s->y1[i];
    t->index = i;
    for (int k = 0; k < 3; k++) {
        t->e[k] = s->e[k][i];
        t->edges.ex[k] = s->ex[k][i];
        t->edges.ey[k] = s->ey[k][i];
    }
    t->x_ref = s->x_ref[i];
    t->y_ref = s->y_ref[i];
    t->z0 = s->z0[i];
    t->zx = s->zx[i];
    t->zy = s->zy[i];
    t->z_low = s->z_low[i];
    t->z_high = s->z_high[i];
}

/* Depth of the triangle's plane in row y, at the x of the far corner. */
SHADE__INLINE float shade__row_depth(const shade__triangle *t, int y)
{
    return t->z0 + t->zy * ((float)y + t->y_ref);
}

/* ---- edges in rectangles */

/* Edge k at pixel (x, y).   pre: the pixel is in the picture   post: within 2^45 */
SHADE__INLINE int64_t shade__edge_at(const shade__triangle *t, int k, int64_t x, int64_t y)
{
    return t->e[k] + (x - t->x0) * t->edges.ex[k] + (y - t->y0) * t->edges.ey[k];
}

/* The least value of edge k in a rectangle minus its value at the first pixel; never positive.
   pre: the rectangle is at most 2^14 wide and high   post: within 2^40 */
SHADE__INLINE int64_t shade__edge_fall(const shade__triangle *t, int k, int64_t columns,
                                       int64_t rows)
{
    const int64_t across = (columns - 1) * t->edges.ex[k], down = (rows - 1) * t->edges.ey[k];
    return (across < 0 ? across : 0) + (down < 0 ? down : 0);
}

/* Moves *first and *last inward, to the columns in which each edge has a pixel inside, in at least
   one of the rows.  The crossing is off by less than 0.016 pixel; a column within that error of the
   crossing is kept.
   pre: rows of the box   post: *first does not fall, *last does not rise; both stay within -1 ..
   SHADE__SIDE_MAX pixels of t->x0 */
static SHADE__NOINLINE void shade__cut_columns(const shade__triangle *t, int y, int rows,
                                               int *first, int *last)
{
    for (int k = 0; k < 3; k++) {
        const int32_t ex = t->edges.ex[k];
        const int64_t ey = t->edges.ey[k];
        const int64_t e = t->e[k] + (y - t->y0 + (ey > 0 ? rows - 1 : 0)) * ey;
        const float x = -(float)e / (float)(ex ? ex : 1);    /* where e is 0 */
        const float near_x = shade__minf(shade__maxf(x, -2), SHADE__SIDE_MAX);
        if (ex > 0) *first = shade__max(*first, t->x0 + (int)(near_x + 0.984f));
        if (ex < 0) *last = shade__min(*last, t->x0 + (int)(near_x + 0.016f));
    }
}

/* The edges in a tile of 32 columns; an edge with the whole tile inside becomes 0.  Returns 1 if
   all three do.   pre: each edge has an inside pixel in the tile or in the column next to it
   post: |e| <= 32 |ex| + 7 |ey| <= 39 2^25 */
SHADE__INLINE int shade__tile_edges(const shade__triangle *t, const shade__tile *tile,
                                    shade__edges *edges)
{
    int inside = 1;
    edges->x = tile->x;
    edges->y = tile->y;
    for (int k = 0; k < 3; k++) {
        const int64_t e = shade__edge_at(t, k, tile->x, tile->y);
        const int crosses = e + shade__edge_fall(t, k, SHADE__TILE, tile->rows) < 0;
        edges->e[k] = crosses ? (int32_t)e : 0;
        edges->ex[k] = crosses ? t->edges.ex[k] : 0;
        edges->ey[k] = crosses ? t->edges.ey[k] : 0;
        inside &= !crosses;
    }
    return inside;
}

/* ---- runs */

SHADE__INLINE void shade__close_runs(shade__runs *r)
{
    for (int k = 0; k < SHADE__TILE_ROWS; k++) r->open[k] = SHADE__RUNS;
}

static SHADE__NOINLINE void shade__send(shade__draw *d, shade__runs *r)
{
    if (r->count && d->plan.queued) shade__push(d, r->run, r->count);
    r->count = 0;
    shade__close_runs(r);
}

SHADE__INLINE void shade__set_run(shade__run *run, int triangle, int x, int y, int n)
{
    run->x = x;
    run->y = y;
    run->n = n;
    run->triangle = triangle;
}

/* Adds the runs of a set, in which bit i stands for pixel x + i of row y.   post: r has room for a
   run in each row of a tile */
static SHADE__NOINLINE void shade__add_set(shade__draw *d, shade__runs *r, int triangle, int x,
                                           int y, uint32_t set)
{
    while (set) {
        const int first = SHADE__LOWEST_BIT(set);
        const int n = SHADE__LOWEST_BIT(~(set >> first));    /* ~ is not 0: full sets are one run */
        if (r->count == SHADE__RUNS) shade__send(d, r);
        shade__set_run(&r->run[r->count++], triangle, x + first, y, n);
        set &= set + (set & (0u - set));    /* clears its lowest run */
    }
    if (r->count > SHADE__RUNS_AHEAD) shade__send(d, r);
}

SHADE__INLINE int shade__count_bits(uint32_t m)
{
    m = m - (m >> 1 & 0x55555555u);
    m = (m & 0x33333333u) + (m >> 2 & 0x33333333u);
    return (int)(((m + (m >> 4)) & 0x0F0F0F0Fu) * 0x01010101u >> 24);
}

/* Adds the runs of a tile; returns the number of their pixels.  Nearly every set is one run or
   empty, so each row writes its run behind the others without a branch, and counts it only if it
   is new.  joined: if the run begins where the open run of its row ends, the open one grows
   instead.  For example, after a run of columns 20 .. 31 in the tile before, a run from column 32
   on is not new. */
SHADE__INLINE int shade__add_tile(shade__draw *d, shade__runs *r, int triangle,
                                  const shade__tile *tile, const int joined)
{
    int pixels = 0, count;
    if (!tile->any) return 0;
    if (SHADE__UNLIKELY(r->count > SHADE__RUNS_AHEAD)) shade__send(d, r);
    count = r->count;
    for (int k = 0; k < tile->rows; k++) {
        const uint32_t set = tile->set[k], lowest = set & (0u - set);
        const int n = shade__count_bits(set);
        shade__run *run = &r->run[count];
        shade__run *open = &r->run[joined ? r->open[k] : SHADE__RUNS];
        int extends;
        pixels += n;
        if (SHADE__UNLIKELY(set & (set + lowest))) {
            r->count = count;    /* the set has several runs */
            shade__add_set(d, r, triangle, tile->x, tile->y + k, set);
            count = r->count;
            continue;
        }
        shade__set_run(run, triangle, tile->x + SHADE__LOWEST_BIT(set | 0x80000000u),
                       tile->y + k, n);
        extends = joined && open->x + open->n == run->x;
        if (joined) {
            open->n += extends ? n : 0;
            r->open[k] = extends ? r->open[k] : n ? count : SHADE__RUNS;    /* or the sentinel */
        }
        count += n && !extends;
    }
    r->count = count;
    return pixels;
}

/* ---- pixels */

/* The depth test of z against the stored depth s, as a mask. */
SHADE__INLINE uint32_t shade__passes(shade__compare c, const int less_only, float z, float s)
{
    if (less_only) return shade__mask(z < s);
    return (shade__mask(z < s) & c.less) | (shade__mask(z == s) & c.equal) |
           (shade__mask(z > s) & c.greater) | c.always;
}

/* Tests columns at .. at + width - 1 of a tile by depth and, unless copy has SHADE__FULL, by its
   three edges.  SHADE__LESS: the test is LESS, and depth is written.  Depth that is not written may
   lie in read-only memory, or be shared with other threads: the loop stores nothing there, not even
   the old value.  The loops are plain because SHADE__FOR makes clang 14 keep the rows in memory.
   pre: depth holds the columns, at + width <= 32 */
SHADE__INLINE void shade__test_columns(const shade__plan *SHADE_RESTRICT plan,
                                       const shade__triangle *SHADE_RESTRICT t,
                                       shade__tile *SHADE_RESTRICT tile, int at, const int width,
                                       const int copy)
{
    const int less_only = copy & SHADE__LESS, full = copy & SHADE__FULL;
    const shade__edges *edges = tile->edges;
    const shade__compare test = plan->tile_test;
    const float zx = t->zx, x_ref = t->x_ref, z_low = t->z_low, z_high = t->z_high;
    const int x = tile->x + at, skip = tile->skip - at, i0 = x - edges->x, j0 = tile->y - edges->y;
    const int32_t ax = edges->ex[0], ay = edges->ey[0], a = edges->e[0] + i0 * ax + j0 * ay;
    const int32_t bx = edges->ex[1], by = edges->ey[1], b = edges->e[1] + i0 * bx + j0 * by;
    const int32_t cx = edges->ex[2], cy = edges->ey[2], c = edges->e[2] + i0 * cx + j0 * cy;
    const int rows = tile->rows, stride = tile->stride;
    float *SHADE_RESTRICT depth = tile->depth + at;
    float updated[SHADE__TILE];
    int32_t e0[SHADE__TILE], e1[SHADE__TILE], e2[SHADE__TILE];
    float z_step[SHADE__TILE];
    uint32_t all = 0;
    for (int i = 0; i < width; i++) {
        e0[i] = i < skip ? SHADE__SKIPPED : a + i * ax;
        e1[i] = b + i * bx;
        e2[i] = c + i * cx;
        z_step[i] = zx * ((float)(x + i) + x_ref);
    }

    for (int r = 0; r < rows; r++, depth += stride) {
        const float row_z = tile->row_z[r];
        uint32_t any = 0;
        for (int i = 0; i < width; i++) {
            float z = shade__clamp_bits(row_z + z_step[i], z_low, z_high);
            uint32_t m = shade__mask(full || (e0[i] | e1[i] | e2[i]) >= 0);
            m &= shade__passes(test, less_only, z, depth[i]);
            if (less_only) depth[i] = shade__select(depth[i], z, m);
            else updated[i] = shade__select(depth[i], z, m);
            any |= m & shade__bit[i];
            if (full) continue;    /* clang would store them */
            e0[i] += ay;
            e1[i] += by;
            e2[i] += cy;
        }
        if (!less_only && test.write) SHADE_MEMCPY(depth, updated, (size_t)width * sizeof *depth);
        tile->set[r] |= any << at;
        all |= any;
    }
    tile->any |= all;
}

/* Tests a tile, with a specialised copy for the commonest depth test. */
SHADE__INLINE void shade__test_tile(const shade__plan *plan,
                                    const shade__triangle *SHADE_RESTRICT t,
                                    shade__tile *SHADE_RESTRICT tile, const int width,
                                    const int full)
{
    const int less = SHADE__HAS(SHADE__LESS) && plan->less_only;
    const int slim = width > 8 && tile->columns <= 8;
    SHADE__TILE_TESTED();
    tile->any = 0;
    SHADE__FOR(r, SHADE__TILE_ROWS) {
        tile->set[r] = 0;
        tile->row_z[r] = shade__row_depth(t, tile->y + r);
    }
    if (slim) {
        if (less) shade__test_columns(plan, t, tile, 0, 8, SHADE__LESS);
        else shade__test_columns(plan, t, tile, 0, 8, 0);
        return;
    }
    for (int at = tile->skip & -width; at < tile->columns; at += width) {
        if (less) shade__test_columns(plan, t, tile, at, width, SHADE__LESS | full);
        else shade__test_columns(plan, t, tile, at, width, full);
    }
}

/* Tests a tile of a medium or large triangle, with a copy for tiles wholly inside it. */
SHADE__DISPATCH(shade__test_large,
                (const shade__plan *plan, const shade__triangle *SHADE_RESTRICT t,
                 shade__tile *SHADE_RESTRICT tile, int full),
                (plan, t, tile, full),
                if (SHADE__HAS(SHADE__FULL) && full)
                    shade__test_tile(plan, t, tile, SHADE__TILE, SHADE__FULL);
                else shade__test_tile(plan, t, tile, shade__width, 0))

/* The columns of a tile for n pixels from x on: 8, or whole vectors.  A tile that would leave the
   clip rectangle is moved to the left, and skips the columns before x. */
SHADE__INLINE void shade__tile_columns(const shade__plan *plan, int x, int n, const int width,
                                       shade__tile *tile)
{
    tile->columns = width > 8 && n <= 8 ? 8 : (n + width - 1) & -width;
    tile->x = shade__max(shade__min(x, plan->x1 - tile->columns), plan->x0);
    tile->skip = x - tile->x;
}

/* Finds the depths of a tile.  Without an early test all its rows are draw.spare_depth. */
SHADE__INLINE void shade__tile_depth(const shade__plan *plan, shade__tile *tile)
{
    const size_t early = (size_t)plan->early, row = (size_t)(tile->y - plan->row_offset);
    tile->depth = plan->tested + early * (row * (size_t)plan->stride + (size_t)tile->x);
    tile->stride = plan->early * plan->stride;
}

/* Tests a tile wider than the n columns of the clip rectangle: each row is copied, tested and
   copied back. */
static SHADE__NOINLINE void shade__test_copy(const shade__plan *plan, const shade__triangle *t,
                                             int n, shade__tile *tile)
{
    const size_t bytes = (size_t)n * sizeof(float);
    float copy[SHADE__TILE];
    shade__tile row = *tile;
    SHADE__ZERO(copy);
    row.rows = 1;
    row.depth = copy;
    tile->any = 0;
    for (int r = 0; r < tile->rows; r++, row.y++) {
        float *depth = tile->depth + (ptrdiff_t)r * tile->stride;
        SHADE_MEMCPY(copy, depth, bytes);
        shade__test_large(plan, t, &row, 0);
        if (plan->tile_test.write) SHADE_MEMCPY(depth, copy, bytes);
        tile->set[r] = row.set[0] & (UINT32_MAX >> (SHADE__TILE - n));
        tile->any |= tile->set[r];
    }
}

/*------------------------------------------------------------------------------------------ >>cover
   Draws triangles tile by tile.  Big triangles leave a bound of depth for each rectangle of tiles
   that they fill; tiles of later triangles that lie behind it are skipped.              [Greene93]
     in      triangles set up                    out  runs of pixels for >>fragments
     way     cover: cover_small, cover_medium: cover_columns; cover_large: next_stretch,
             cover_stretch
     method  LESS, LESS_EQUAL, GREATER and GREATER_EQUAL only ever bring depth nearer.  Once a
             triangle fills a rectangle, no pixel there is farther than the triangle is in the
             farthest corner of the rectangle.  Slopes are below 2^34, so all sums are finite, and
             rounding is monotonic: corners bound every depth between them, to the bit.  With bounds
             1000 big triangles, 163 Mpixel of overdraw, are drawn 3.7 times as fast with AVX-512,
             and 6.2 times with SSE2.

             A triangle in a row of bounds, #, cut into stretches:

               |      ./|########|########|#hidden#|####\   |
                      ^s.x                                ^s.end
                      1-|2----------------|        |3-----|

             A stretch ends before a hidden bound, and where the triangle starts or stops filling
             bounds.  Stretch 2 fills its bounds, and brings them nearer.             >>fragments */

/* Columns x .. last of rows y .. bottom of a triangle's box.  In these rows the triangle extends to
   column end.  inside: all of these pixels are inside it. */
typedef struct shade__stretch { int x, y, last, bottom, end, inside; } shade__stretch;

/* ---- bounds */

/* Cuts the clip rectangle into tiles or rectangles of them, SHADE__BOUNDS at most.
   pre: the rectangle is not empty, within 2^14   post: neither logarithm is above 14 */
static void shade__begin_bounds(const shade__plan *plan, shade__bounds *b)
{
    int w = plan->x1 - plan->x0 - 1, h = plan->y1 - plan->y0 - 1;
    b->log_width = 5;
    b->log_height = 3;
    while (((w >> b->log_width) + 1) * ((h >> b->log_height) + 1) > SHADE__BOUNDS) {
        if (b->log_height < b->log_width) b->log_height++;
        else b->log_width++;
    }
    b->across = (w >> b->log_width) + 1;
    for (int i = 0; i < SHADE__BOUNDS; i++) b->farthest[i] = FLT_MAX;
}

/* away times the depth at pixel x: it grows with the distance.  The depth has the bits that the
   depth test sees.  row_z is the depth at the x of the far corner. */
SHADE__INLINE float shade__signed_depth(float away, const shade__triangle *t, float row_z, int x)
{
    return away * shade__clamp_bits(row_z + t->zx * ((float)x + t->x_ref), t->z_low, t->z_high);
}

/* least has the least value of each edge in a rectangle.  Returns 1 if the same rectangle, moved
   `right` pixels to the right (to the left if negative), lies inside all edges. */
SHADE__INLINE int shade__all_inside(const shade__triangle *t, const int64_t least[3], int right)
{
    int64_t crossed = 0;
    for (int k = 0; k < 3; k++) crossed |= least[k] + (int64_t)t->edges.ex[k] * right;
    return crossed >= 0;
}

/* Finds the next stretch of rows s->y .. s->bottom, which lie in one row of bounds.  Sets s->x to
   the first column that is not hidden, or beyond s->end if all are hidden.  Sets s->last to the
   last column before one that is hidden or differs in s->inside.  Brings nearer the bounds that the
   triangle fills. */
static SHADE__NOINLINE void shade__next_stretch(const shade__plan *plan, shade__bounds *b,
                                                const shade__triangle *t, shade__stretch *s)
{
    const float away = plan->away;
    /* the directions in which the triangle gets farther */
    const int rightward = away * t->zx > 0, downward = away * t->zy > 0;
    const float z_near = shade__row_depth(t, downward ? s->y : s->bottom);
    const float z_far = shade__row_depth(t, downward ? s->bottom : s->y);
    const int size = 1 << b->log_width, row = (s->y - plan->y0) >> b->log_height;
    const int top = plan->y0 + (row << b->log_height);
    const int bottom = shade__min(top + (1 << b->log_height), plan->y1) - 1;
    const int whole = s->y == top && s->bottom == bottom;
    int64_t least[3];

    for (int k = 0; k < 3; k++)
        least[k] = shade__edge_at(t, k, t->x0, s->y) +
                   shade__edge_fall(t, k, size, s->bottom - s->y + 1);
    for (int from = s->x; from <= s->end; from = s->last + 1) {
        const int cell = (from - plan->x0) >> b->log_width, first = plan->x0 + cell * size;
        const int to = shade__min(first + size - 1, s->end);
        const int inside = shade__all_inside(t, least, first - t->x0);
        float *farthest = &b->farthest[row * b->across + cell];
        const int hidden = shade__signed_depth(away, t, z_near, rightward ? from : to) > *farthest;

        if (from > s->x && (hidden || inside != s->inside)) return;
        s->inside = inside;
        s->last = to;
        if (hidden) s->x = to + 1;
        else if (inside && whole)
            *farthest = shade__minf(*farthest, shade__signed_depth(away, t, z_far,
                                                                   rightward ? to : from));
    }
}

/* ---- triangles */

/* Draws a stretch of a triangle.  In the last stretch of a row, tiles begin at the edges, and the
   last tile may overrun the end.  In other stretches tiles begin at multiples of 32 columns, as
   bounds do. */
SHADE__INLINE void shade__cover_stretch(shade__draw *d, const shade__triangle *t, shade__runs *runs,
                                        const shade__stretch *s)
{
    const shade__plan *plan = &d->plan;
    const int across = plan->x1 - plan->x0;
    shade__edges edges;
    shade__tile tile;
    int pixels = 0, inside;
    SHADE__ZERO(edges);    /* as for tiles that are inside */
    tile.edges = &edges;
    for (int y = s->y; y <= s->bottom; y += SHADE__TILE_ROWS) {
        int first = s->x, last = s->last;
        tile.y = y;
        tile.rows = shade__min(SHADE__TILE_ROWS, s->bottom - y + 1);
        shade__close_runs(runs);
        if (!s->inside) {
            shade__cut_columns(t, y, tile.rows, &first, &last);
            if (s->last < s->end) first -= (first - plan->x0) & (SHADE__TILE - 1);
        }
        for (int x = first; x <= last; x += SHADE__TILE) {
            shade__tile_columns(plan, x, shade__min(SHADE__TILE, last - x + 1),
                                SHADE__TILE / 2, &tile);
            inside = s->inside || shade__tile_edges(t, &tile, &edges);
            shade__tile_depth(plan, &tile);
            if (across < tile.columns) shade__test_copy(plan, t, across, &tile);
            else shade__test_large(plan, t, &tile,
                                   inside && tile.columns - tile.skip == SHADE__TILE);
            pixels += shade__add_tile(d, runs, t->index, &tile, 1);
        }
    }
    if (!plan->pipe->may_discard) d->stats.fragments += pixels;
}

/* Is the box at most `columns` wide, and do its edge functions fit 32 bits, with a margin of 31
   pixels?  They do if two sides span at most 2^17 / 256 = 512 pixels across and down: |step| <=
   2^18 for all three, and |e| <= 2^29 in the box, as corners and pixels are within 2^18. */
SHADE__INLINE int shade__is_small(const shade__setup *s, int i, int columns)
{
    const int32_t most = 1 << 17;
    const int32_t side = (s->ex[0][i] + most) | (s->ey[0][i] + most) |
                         (s->ex[1][i] + most) | (s->ey[1][i] + most);
    return s->x1[i] - s->x0[i] < columns && !(side & -2 * most);
}

/* Is the whole tile outside an edge? */
SHADE__INLINE int shade__tile_outside(const shade__edges *edges, const shade__tile *tile)
{
    int32_t most = 0;
    for (int k = 0; k < 3; k++) {
        const int32_t ex = edges->ex[k], ey = edges->ey[k];
        const int right = ex > 0 ? SHADE__TILE - 1 : 0, down = ey > 0 ? tile->rows - 1 : 0;
        most |= edges->e[k] + (tile->x - edges->x + right) * ex + (tile->y - edges->y + down) * ey;
    }
    return most < 0;
}

/* Draws a small triangle, one column of tiles after the other.  Each tile is tested by all three
   edges.  narrow: there is only one column of tiles.  Returns the number of pixels that passed. */
SHADE__INLINE int shade__cover_columns(shade__draw *d, shade__triangle *t, shade__runs *runs,
                                       const int width, const int narrow)
{
    const shade__plan *plan = &d->plan;
    shade__tile tile;
    int pixels = 0;
    for (int k = 0; k < 3; k++) t->edges.e[k] = (int32_t)t->e[k];
    tile.edges = &t->edges;
    for (int x = t->x0; x <= (narrow ? t->x0 : t->x1); x += SHADE__TILE) {
        const int n = t->x1 - x + 1;
        shade__tile_columns(plan, x, narrow ? n : shade__min(SHADE__TILE, n), width, &tile);
        for (tile.y = t->y0; tile.y <= t->y1; tile.y += SHADE__TILE_ROWS) {
            tile.rows = shade__min(SHADE__TILE_ROWS, t->y1 - tile.y + 1);
            if (!narrow && shade__tile_outside(&t->edges, &tile)) continue;
            shade__tile_depth(plan, &tile);
            if (narrow) shade__test_tile(plan, t, &tile, width, 0);
            else shade__test_large(plan, t, &tile, 0);
            pixels += shade__add_tile(d, runs, t->index, &tile, 0);
        }
    }
    return pixels;
}

/* Draws a small triangle of up to four columns of tiles and returns 1, or returns 0 for other
   triangles.  Once bounds have begun, shade__cover_large draws all of them, because it skips hidden
   tiles. */
static SHADE__NOINLINE int shade__cover_medium(shade__draw *d, shade__runs *runs, int index)
{
    const shade__plan *plan = &d->plan;
    shade__triangle t;
    int pixels;
    if (d->bounds.across || plan->x1 - plan->x0 < SHADE__TILE ||
        !shade__is_small(&d->setup, index, 4 * SHADE__TILE))
        return 0;
    shade__triangle_of(&d->setup, index, &t);
    pixels = shade__cover_columns(d, &t, runs, SHADE__TILE / 2, 0);
    if (!plan->pipe->may_discard) d->stats.fragments += pixels;
    return 1;
}

/* Draws the parts of any triangle that bounds do not hide. */
static SHADE__HOT void shade__cover_large(shade__draw *d, shade__runs *runs, int index)
{
    const shade__plan *plan = &d->plan;
    shade__bounds *b = &d->bounds;
    shade__triangle t;
    shade__stretch s;
    int bounded;
    shade__triangle_of(&d->setup, index, &t);
    bounded = SHADE__HAS(SHADE__BOUNDED) && t.x1 - t.x0 >= SHADE__TILE - 1 &&
              t.y1 - t.y0 >= SHADE__TILE_ROWS - 1 && plan->away != 0;
    if (bounded && !b->across) shade__begin_bounds(plan, b);
    for (s.y = t.y0; s.y <= t.y1; s.y = s.bottom + 1) {
        /* a row of bounds, or all rows at once */
        const int below = bounded ? (s.y - plan->y0) | ((1 << b->log_height) - 1)
                                  : SHADE__SIDE_MAX;
        s.bottom = shade__min(t.y1, plan->y0 + below);
        s.x = t.x0;
        s.end = t.x1;
        if (bounded) shade__cut_columns(&t, s.y, s.bottom - s.y + 1, &s.x, &s.end);
        for (; s.x <= s.end; s.x = s.last + 1) {
            s.last = s.end;
            s.inside = 0;
            if (bounded) shade__next_stretch(plan, b, &t, &s);
            if (s.x <= s.last) shade__cover_stretch(d, &t, runs, &s);
        }
    }
}

/* Draws triangles of the setup from runs->next on, up to count or to the first that is not small
   and narrow.  If the clip rectangle is narrower than a tile, no triangle counts as small, because
   only shade__cover_large calls shade__test_copy. */
SHADE__INLINE void shade__cover_small_body(shade__draw *d, shade__runs *runs, int count,
                                           const int width)
{
    const shade__plan *plan = &d->plan;
    const shade__setup *s = &d->setup;
    const int wide = plan->x1 - plan->x0 >= SHADE__TILE;
    int pixels = 0, i = runs->next;
    for (; i < count; i++) {
        shade__triangle t;
        if (((s->x1[i] - s->x0[i]) | (s->y1[i] - s->y0[i])) < 0) continue;
        if (!wide || !shade__is_small(s, i, SHADE__TILE)) break;
        shade__triangle_of(s, i, &t);
        pixels += shade__cover_columns(d, &t, runs, width, 1);
    }
    runs->next = i;
    if (!plan->pipe->may_discard) d->stats.fragments += pixels;
}
SHADE__DISPATCH_AVX(shade__cover_small, (shade__draw *d, shade__runs *runs, int count),
                    (d, runs, count), shade__cover_small_body(d, runs, count, shade__width))

/* Draws all triangles of the setup.  The three functions are called one after the other to save
   stack; the last one can draw any triangle. */
static void shade__cover(shade__draw *d, int count)
{
    shade__runs runs;
    runs.count = 0;
    runs.run[SHADE__RUNS].x = runs.run[SHADE__RUNS].n = -1;
    for (runs.next = 0; runs.next < count; runs.next++) {
        if (SHADE__HAS(SHADE__NARROW)) shade__cover_small(d, &runs, count);
        if (runs.next >= count) break;
        if (SHADE__HAS(SHADE__MEDIUM) && shade__cover_medium(d, &runs, runs.next)) continue;
        shade__cover_large(d, &runs, runs.next);
    }
    shade__send(d, &runs);
}

/*-------------------------------------------------------------------------------------- >>fragments
   Pixels that passed, of all triangles of a batch, get their values and wait in a queue until a
   packet is full; it is then shaded and stored.  On dense meshes this measured 2 to 3 times as fast
   as a packet for each run.
     in      runs of pixels; the first run of a triangle makes its planes
     out     packets of fragments for the shader, its colours for >>store
     way     push: make_planes, push_run: append; flush: replicate, undivide, the user's shader,
             store
     holds   With perspective, varyings in the queue are divided by w; the flush multiplies them by
             w for the shader.  Lanes from count on repeat the last one.                 >>texels */

enum { SHADE__WIDE = SHADE_LANES < 32 ? SHADE_LANES : 32 };    /* most pixels appended at once */

/* The planes of a triangle's values: value = base + gy (y + y_ref) + gx (x + x_ref). */
typedef struct shade__planes {
    SHADE_ALIGNED float base[SHADE__VALUES_MAX];
    float    gx[SHADE__VALUES_MAX], gy[SHADE__VALUES_MAX];
    float    x_ref, y_ref;            /* 1/2 - position of the far corner, in pixels; exact */
    float    z_low, z_high, rw_low, rw_high;    /* depth and 1/w are clamped to these */
    uint32_t primitive, front;
} shade__planes;

/* Pixels x, x + 1, ... of row y, for the lanes of the queue from lane on.  The first `back` lanes
   are not written: a piece of 8 lanes with only 5 free at the end of the queue begins 3 lanes, and
   3 pixels, before them. */
typedef struct shade__piece { int x, y, lane, back; } shade__piece;

/* The planes of all values in one loop.  k: the sides from the far corner to corner 1 (x, y) and to
   corner 2 (z, w), divided by twice the area. */
SHADE__INLINE void shade__slopes(shade__in v0, shade__in v1, shade__in v2, shade_vec4 k, int stride,
                                 shade__planes *SHADE_RESTRICT t)
{
    for (int s = 0; s < stride; s += 8) {
        SHADE__FOR(i, 8) {
            float d1 = v1[s + i] - v0[s + i], d2 = v2[s + i] - v0[s + i];
            t->base[s + i] = v0[s + i];
            t->gx[s + i] = d1 * k.w - d2 * k.y;
            t->gy[s + i] = d2 * k.x - d1 * k.z;
        }
    }
}

SHADE__INLINE void shade__make_planes(const shade__plan *plan, const shade__setup *s, int i,
                                      shade__planes *t)
{
    static const uint8_t orders[6][3] = { { 0, 1, 2 }, { 1, 2, 0 }, { 2, 0, 1 },
                                          { 0, 2, 1 }, { 1, 0, 2 }, { 2, 1, 0 } };
    const int stride = plan->value_stride;
    const uint8_t *corner = s->corner[i], *order = orders[s->order[i]];
    const float *v0 = s->value + corner[order[0]] * stride;
    const float *v1 = s->value + corner[order[1]] * stride;
    const float *v2 = s->value + corner[order[2]] * stride;
    const shade_vec4 side = shade_v4(s->side[0][i], s->side[1][i], s->side[2][i], s->side[3][i]);
    shade__slopes(v0, v1, v2, side, stride, t);
    t->base[0] = s->z0[i];    /* with the bias */
    t->z_low = s->z_low[i];
    t->z_high = s->z_high[i];
    t->rw_low = v0[1];    /* of the far corner */
    t->rw_high = shade__maxf(v0[1], shade__maxf(v1[1], v2[1]));
    t->x_ref = s->x_ref[i];
    t->y_ref = s->y_ref[i];
    t->primitive = s->primitive[i];
    t->front = s->order[i] > 2;

    if (plan->pipe->interpolation == SHADE_INTERPOLATION_CONSTANT) {
        const float *value = s->value + corner[3] * stride;
        for (int k = SHADE__FIRST; k < plan->first_divided; k++) {
            t->base[k] = value[k];
            t->gx[k] = t->gy[k] = 0;
        }
    }
}

/* Appends the squared length, in texels, of the longer step of (u, v) to the next pixel, in 8
   lanes.  With u = U / q and q = 1/w, du/dx = (U_x - u q_x) / q, which stays moderate for any w. */
SHADE__INLINE void shade__append_step(const shade__plan *SHADE_RESTRICT plan,
                                      const shade__planes *SHADE_RESTRICT t, shade__in value,
                                      shade__piece p, shade__queue *q)
{
    shade__in rw = q->rw + p.lane;
    shade__out step = q->step_square + p.lane;
    const int k = plan->lod_u;
    const float w = (float)plan->pipe->lod_texture->width;
    const float h = (float)plan->pipe->lod_texture->height;
    const float u0 = value[k], v0 = value[k + 1], x_ref = t->x_ref;
    const float ux = t->gx[k], vx = t->gx[k + 1], qx = t->gx[1];
    const float uy = t->gy[k], vy = t->gy[k + 1], qy = t->gy[1];
    SHADE__FOR(i, 8) {
        float px = (float)(p.x + i) + x_ref, r = 1 / rw[i];
        float u = (u0 + ux * px) * r, v = (v0 + vx * px) * r;
        float a = (ux - u * qx) * r * w, b = (vx - v * qx) * r * h;
        float c = (uy - u * qy) * r * w, e = (vy - v * qy) * r * h;
        float right = a * a + b * b, below = c * c + e * e;
        float longer = shade__select(right, below, shade__mask(below > right));
        step[i] = shade__select(longer, step[i], shade__mask(i < p.back));
    }
}

/* Interpolates one value at width pixels of a row, into lanes of the queue. */
SHADE__INLINE void shade__append_plane(float value, float step, shade__in px, int back,
                                       shade__out to, const int width)
{
    SHADE__FOR(i, width) {
        to[i] = shade__select(value + step * px[i], to[i], shade__mask(i < back));
    }
}

/* Appends window position, triangle and facing; only called if a shader reads them. */
SHADE__INLINE void shade__append_inputs(const shade__planes *SHADE_RESTRICT t, float row_z,
                                       shade__piece p, shade__in px,
                                       shade_fragments *SHADE_RESTRICT f, const int width)
{
    const float centre = (float)p.y + 0.5f, zx = t->gx[0];
    const int x = p.x, c = p.lane, back = p.back;
    SHADE__FOR(i, width) {
        const uint32_t keep = shade__mask(i < back);
        float z = shade__clamp_bits(row_z + zx * px[i], t->z_low, t->z_high);
        f->x[c + i] = shade__select((float)(x + i) + 0.5f, f->x[c + i], keep);
        f->y[c + i] = shade__select(centre, f->y[c + i], keep);
        f->z[c + i] = shade__select(z, f->z[c + i], keep);
        f->primitive[c + i] = shade__choose(t->primitive, f->primitive[c + i], keep);
        f->front[c + i] = shade__choose(t->front, f->front[c + i], keep);
    }
}

/* Writes width lanes of the queue.  For a constant p.back of 0 the compiler drops the selects. */
SHADE__INLINE void shade__append(shade__draw *SHADE_RESTRICT d,
                                 const shade__planes *SHADE_RESTRICT t, shade__in value,
                                 shade__piece p, const int width)
{
    const shade__plan *plan = &d->plan;
    shade__queue *SHADE_RESTRICT q = &d->u.queue;
    const float x_ref = t->x_ref, rw0 = value[1], rw_dx = t->gx[1];
    const uint32_t above = (uint32_t)(p.y - plan->row_offset) * (uint32_t)plan->stride;
    const uint32_t offset = above + (uint32_t)p.x;
    const int x = p.x, c = p.lane, back = p.back;
    float px[SHADE__WIDE];
    SHADE__FOR(i, width) {
        const uint32_t keep = shade__mask(i < back);
        float rw;
        px[i] = (float)(x + i) + x_ref;
        rw = shade__clamp_bits(rw0 + rw_dx * px[i], t->rw_low, t->rw_high);
        q->rw[c + i] = shade__select(rw, q->rw[c + i], keep);
        q->offset[c + i] = shade__choose(offset + (uint32_t)i, q->offset[c + i], keep);
    }
    for (int k = 0; k < plan->varyings; k++)
        shade__append_plane(value[SHADE__FIRST + k], t->gx[SHADE__FIRST + k], px,
                            back, q->f.varying[k] + c, width);
    if (!plan->inputs_unread) shade__append_inputs(t, value[0], p, px, &q->f, width);
}

/* Values of the planes in row y, at the x of the far corner. */
SHADE__INLINE void shade__row_values(const shade__planes *SHADE_RESTRICT t, int count, int y,
                                     shade__out value)
{
    const float py = (float)y + t->y_ref;
    for (int s = 0; s < count; s += 8) {
        SHADE__FOR(k, 8) { value[s + k] = t->base[s + k] + t->gy[s + k] * py; }
    }
}

/* Appends one run; shades the queue each time it is full.   post: it is not full */
SHADE__INLINE void shade__push_run(shade__draw *d, const shade__planes *t, const float *value,
                                   const shade__run *run)
{
    const shade__plan *plan = &d->plan;
    shade__queue *q = &d->u.queue;
    int x = run->x, n = run->n;
    shade__piece p;
    p.y = run->y;
    /* a short run fits one piece: saves 5 % of a dense mesh */
    if (SHADE__HAS(SHADE__SHORT) && n <= 8 && SHADE_LANES - q->f.count > 8 && !plan->lod_u) {
        p.x = x;
        p.lane = q->f.count;
        p.back = 0;
        shade__append(d, t, value, p, 8);
        q->f.count += n;
        return;
    }

    while (n > 0) {
        const int room = SHADE_LANES - q->f.count, back = shade__max(0, 8 - room);
        const int wide = SHADE__HAS(SHADE__LONG) && n > 8 && room >= SHADE__WIDE;
        const int width = wide ? SHADE__WIDE : 8;
        const int take = shade__min(n, width - back);
        p.x = x - back;    /* the packet may end within the 8 lanes of a piece */
        p.lane = q->f.count - back;
        p.back = wide ? 0 : back;
        if (wide) shade__append(d, t, value, p, SHADE__WIDE);
        else shade__append(d, t, value, p, 8);
        if (plan->lod_u)
            for (int i = 0; i < width; i += 8, p.x += 8, p.lane += 8)
                shade__append_step(plan, t, value, p, q);
        x += take;
        n -= take;
        q->f.count += take;
        if (q->f.count == SHADE_LANES) shade__flush(d);
    }
}

SHADE__INLINE void shade__push_body(shade__draw *d, const shade__run *run, int runs)
{
    shade__planes t;
    SHADE_ALIGNED float value[SHADE__VALUES_MAX];
    for (int k = 0; k < runs; k++) {
        if (!k || run[k].triangle != run[k - 1].triangle)
            shade__make_planes(&d->plan, &d->setup, run[k].triangle, &t);
        shade__row_values(&t, d->plan.value_stride, run[k].y, value);
        shade__push_run(d, &t, value, &run[k]);
    }
}
SHADE__DISPATCH(shade__push, (shade__draw *d, const shade__run *run, int runs), (d, run, runs),
                shade__push_body(d, run, runs))

/* Fills lanes n, n + 1, ... of a row with lane n - 1. */
static void shade__repeat(void *row, int n)
{
    shade__word *to = shade__words(row);
    for (int i = n; i < SHADE_LANES; i++) to[i] = to[n - 1];
}

/* Fills the rest of a packet with its last lane. */
static void shade__replicate(shade__queue *q, const shade__plan *plan)
{
    const int n = q->f.count;
    for (int k = 0; k < plan->varyings; k++) shade__repeat(q->f.varying[k], n);
    shade__repeat(q->rw, n);
    shade__repeat(q->step_square, n);
    if (plan->inputs_unread) return;
    shade__repeat(q->f.x, n);
    shade__repeat(q->f.y, n);
    shade__repeat(q->f.z, n);
    shade__repeat(q->f.primitive, n);
    shade__repeat(q->f.front, n);
}

/* Multiplies n rows of varyings by w.  1/w is positive: shade__append clamps it to the range of the
   three vertices. */
SHADE__INLINE void shade__undivide(shade__in rw, shade__out varying, int n)
{
    SHADE_ALIGNED float w[SHADE_LANES];
    SHADE_EACH_LANE(i) { w[i] = 1 / rw[i]; }
    for (int k = 0; k < n; k++, varying += SHADE_LANES) {
        SHADE_EACH_LANE(i) { varying[i] *= w[i]; }
    }
}

SHADE__INLINE void shade__flush_body(shade__draw *d)
{
    const shade__plan *plan = &d->plan;
    shade__queue *q = &d->u.queue;
    shade_colors c;
    if (q->f.count == 0) return;
    if (q->f.count < SHADE_LANES) shade__replicate(q, plan);
    if (plan->first_divided == SHADE__FIRST && plan->varyings)
        shade__undivide(q->rw, q->f.varying[0], plan->varyings);
    if (plan->lod_u) {    /* log2 of the step; NaN counts as a step of 0 */
        SHADE_EACH_LANE(i) {
            float square = shade__keep(q->step_square[i], shade__mask(q->step_square[i] >= 0));
            q->f.lod[i] = -0.5f * shade__neg_log2(square);
        }
    }

    SHADE_EACH_LANE(i) { c.color[3][i] = 1; }
    if (!plan->inputs_unread) {    /* else our shader sets all that is read: saves 1 % */
        SHADE_EACH_LANE(i) { c.color[0][i] = c.color[1][i] = c.color[2][i] = 0; }
        SHADE_EACH_LANE(i) { c.discard[i] = 0; }
        if (!plan->lod_u) SHADE__ZERO(q->f.lod);
        q->f.eye = plan->eye;
    }
    plan->pipe->fragment(plan->pipe->uniforms, &q->f, &c);
    shade__store(d, &c);
    q->f.count = 0;
}
SHADE__DISPATCH_AVX2(shade__flush, (shade__draw *d), (d), shade__flush_body(d))

/*----------------------------------------------------------------------------------------- >>texels
   Texels of one level for blocks of lanes: along both axes the texel before and after a coordinate
   and its weight, then the pairs of texels above and below.
     in      a good texture, rows u and v     out  a shade__reader; pairs of texels as words
     way     open_level: address; then fetch: fetch_pair or fetch_apart
     holds   Every index lies in the texture, for any u and v.                          >>texture */

/* A sentence about the fault of a texture, or NULL. */
SHADE__INLINE const char *shade__texture_fault(const shade_texture *t)
{
    if (!t->pixels) return "The texture's pixels are NULL; point them at its texels.";
    if (t->width < 1 || t->width > SHADE__SIDE_MAX || t->height < 1 || t->height > SHADE__SIDE_MAX)
        return "The texture's width and height must be from 1 to 16384 texels.";
    if (t->stride && t->stride < t->width)
        return "The texture's stride is less than its width; it counts texels, 0 means the width.";
    if (!shade__is_format(t->format))
        return "The texture's format is not a SHADE_FORMAT_... value.";
    if (!SHADE__KNOWN(t->wrap_u, SHADE_WRAP_MIRROR) || !SHADE__KNOWN(t->wrap_v, SHADE_WRAP_MIRROR))
        return "The texture's wrap_u or wrap_v is not a SHADE_WRAP_... value.";
    if (!SHADE__KNOWN(t->filter, SHADE_FILTER_TRILINEAR))
        return "The texture's filter is not a SHADE_FILTER_... value.";
    return NULL;
}

static int shade__texture_good(const shade_texture *t) { return t && !shade__texture_fault(t); }

/* A block is 16 lanes, or the whole packet if that is smaller.  Loops run over blocks, so that a
   single sample costs one block. */
enum {
    SHADE__BLOCK = SHADE_LANES < 16 ? SHADE_LANES : 16,
    SHADE__BLOCKS = SHADE_LANES / SHADE__BLOCK     /* of a packet */
};

/* The blocks that hold n lanes. */
SHADE__INLINE int shade__blocks_of(int n) { return (n + SHADE__BLOCK - 1) / SHADE__BLOCK; }

/* SHADE__EACH_BLOCK(i, blocks) { ... } runs the code for the lanes i of the first blocks: with 2
   blocks, for example, for i = 0 .. 31.  The inner loop, over one block, has a constant length: it
   becomes vector code without a remainder. */
#define SHADE__EACH_BLOCK(i, blocks) \
    for (int i##_block = 0; i##_block < SHADE__BLOCK * (blocks); i##_block += SHADE__BLOCK) \
        SHADE__NO_UNROLL for (int i = i##_block; i < i##_block + SHADE__BLOCK; i++)

/* One axis of a level: for each lane, the texels before and after its coordinate. */
typedef struct shade__axis {
    int size;                    /* in texels */
    shade_wrap wrap;
    uint32_t unit;               /* the step of i from texel to texel */
    SHADE_ALIGNED uint32_t i[2][SHADE_LANES];
    float weight[SHADE_LANES];    /* of the texel after it; 0 if nearest */
} shade__axis;

/* One level of a texture, and the texels that some blocks of lanes read. */
typedef struct shade__reader {
    const uint8_t *pixels;
    const shade__layout *layout;
    size_t y_bytes;              /* bytes per unit of y.i: 1, or the length of a row for
                                    textures above 4 GB; x.i is in bytes */
    int nearest, blocks;
    uint32_t apart[SHADE__BLOCKS];        /* 0: in this block each pair is 8 adjacent bytes */
    shade__axis x, y;
    uint32_t pair[2][SHADE_LANES];        /* the bytes before the left texel, above and below */
} shade__reader;

/* Finds the two texels and the weight for each coordinate, which may be any float, even NaN.
   post: 0 <= i[0], i[1] <= (size - 1) unit */
SHADE__INLINE void shade__address(shade__in c, int blocks, int nearest,
                                  shade__axis *SHADE_RESTRICT a)
{
    const shade_wrap wrap = a->wrap;
    const int32_t last = a->size - 1;
    /* beyond an end: the texel of the other end if the texture repeats, else of this end */
    const int32_t before = wrap == SHADE_WRAP_REPEAT ? last : 0;
    const int32_t after = wrap == SHADE_WRAP_REPEAT ? 0 : last;
    const float limit = wrap == SHADE_WRAP_CLAMP ? FLT_MAX : 16777215.0f;
    const float period = wrap == SHADE_WRAP_MIRROR ? 0.5f : 1.0f;
    const float n = (float)a->size, half = nearest ? 0.0f : 0.5f;
    const uint32_t unit = a->unit;
    SHADE_ALIGNED float along[SHADE_LANES];    /* from 0 to 1 */

    /* Floats from 2^24 on are even integers, the start of a period: they become 0 unless the
       texture clamps.  NaN and infinity always do. */
    SHADE__EACH_BLOCK(i, blocks) {
        const uint32_t usable = shade__mask(shade__within(c[i], limit));
        along[i] = shade__keep(c[i], usable) * period;
    }
    if (wrap == SHADE_WRAP_CLAMP) {
        SHADE__EACH_BLOCK(i, blocks) { along[i] = shade__clamp_bits(along[i], 0, 1); }
    } else {
        SHADE__EACH_BLOCK(i, blocks) {
            float part = along[i] - (float)(int32_t)along[i];
            along[i] = part + shade__keep(1, shade__mask(part < 0));
        }
    }
    if (wrap == SHADE_WRAP_MIRROR) {
        SHADE__EACH_BLOCK(i, blocks) {
            float twice = 2 * along[i];
            along[i] = shade__select(twice, 2 - twice, shade__mask(twice > 1));
        }
    }

    SHADE__EACH_BLOCK(i, blocks) {
        float s = along[i] * n - half;
        int32_t i0 = (int32_t)s - (s < 0 ? 1 : 0);    /* floor(s), as s >= -1/2 */
        i0 = shade__min(i0, last);    /* nearest: a coordinate of 1 would lie beyond the end */
        a->weight[i] = s - (float)i0;
        a->i[0][i] = (uint32_t)(i0 < 0 ? before : i0) * unit;
        a->i[1][i] = (uint32_t)(i0 < last ? i0 + 1 : after) * unit;
    }
}

/* Finds the texels of a level for blocks of lanes.  y.i counts bytes, or rows if the level has more
   bytes than 32 bits can count. */
SHADE__INLINE void shade__open_level(const shade_texture *t, const float *u, const float *v,
                                     int blocks, shade__reader *r)
{
    const uint32_t bytes = shade__layouts[t->format].bytes;
    const size_t pitch = (size_t)(t->stride ? t->stride : t->width) * bytes;
    const int wide = (uint64_t)pitch * (uint64_t)t->height > UINT32_MAX;
    r->pixels = (const uint8_t *)t->pixels;
    r->layout = &shade__layouts[t->format];
    r->nearest = t->filter == SHADE_FILTER_NEAREST;
    r->blocks = blocks;
    r->y_bytes = wide ? pitch : 1;
    r->x.size = t->width;
    r->x.wrap = t->wrap_u;
    r->x.unit = bytes;
    r->y.size = t->height;
    r->y.wrap = t->wrap_v;
    r->y.unit = wide ? 1 : (uint32_t)pitch;
    shade__address(u, blocks, r->nearest, &r->x);
    shade__address(v, blocks, r->nearest, &r->y);
    if (r->nearest) {
        SHADE__ZERO(r->x.weight);
        SHADE__ZERO(r->y.weight);
    }
    for (int b = 0; b < blocks; b++) {
        uint32_t apart = (uint32_t)(bytes != 4 || wide);
        SHADE__FOR(k, SHADE__BLOCK) {
            const int i = b * SHADE__BLOCK + (int)k;
            apart |= (r->x.i[1][i] - r->x.i[0][i]) ^ bytes;
            r->pair[0][i] = r->y.i[0][i] + r->x.i[0][i];
            r->pair[1][i] = r->y.i[1][i] + r->x.i[0][i];
        }
        r->apart[b] = apart;
    }
}

/* Fetches a block of pairs that may lie apart, from lane i on; p is the first texel. */
SHADE__INLINE void shade__fetch_apart(const shade__reader *r, const uint8_t *p, int line, int i,
                                      const int bytes, shade__word *to)
{
    const uint32_t *row = r->y.i[line], *left = r->x.i[0], *right = r->x.i[1];
    const size_t y_bytes = r->y_bytes;
    const int swapped = r->layout->swapped;
    for (const int end = i + SHADE__BLOCK; i < end; i++) {
        const uint8_t *at = p + row[i] * y_bytes;
        to[2 * i] = shade__load_packed(at + left[i], bytes, swapped);
        to[2 * i + 1] = shade__load_packed(at + right[i], bytes, swapped);
    }
}

SHADE__INLINE void shade__fetch_pair(const uint8_t *left, shade__word *to)
{
    SHADE_MEMCPY(to, left, 8);
}

/* Fetches the pairs of the line above (0) or below (1), left and right alternating, one word each;
   of RGBA32F texels, the words of channel k.  Not inlined, because gcc would vectorise the loads,
   which takes longer. */
static SHADE__NOINLINE void shade__fetch(const shade__reader *r, int line, int k, shade__word *to)
{
    const uint8_t *p = r->pixels + 4 * k;
    const uint32_t *pair = r->pair[line];
    const int bytes = r->layout->bytes;
    for (int first = 0; first < r->blocks * SHADE__BLOCK; first += SHADE__BLOCK) {
        if (!r->apart[first / SHADE__BLOCK]) {
            for (int i = first; i < first + SHADE__BLOCK; i += 4) {
                shade__fetch_pair(p + pair[i], to + 2 * i);
                shade__fetch_pair(p + pair[i + 1], to + 2 * i + 2);
                shade__fetch_pair(p + pair[i + 2], to + 2 * i + 4);
                shade__fetch_pair(p + pair[i + 3], to + 2 * i + 6);
            }
        } else if (bytes == 2) shade__fetch_apart(r, p, line, first, 2, to);
        else if (bytes == 1) shade__fetch_apart(r, p, line, first, 1, to);
        else shade__fetch_apart(r, p, line, first, 4, to);
    }
}

/*---------------------------------------------------------------------------------------- >>texture
   Filters texels, one mipmap after the other: four texels are blended to one colour.
     in      rows u, v, lod               out  four rows of linear RGBA, SHADE_LANES apart
     way     shade_sample_lanes: sample_levels: read_level: open_level of >>texels; filter:
             filter_packed or filter_floats: fetch, blend_packed, blend_encoded or blend_floats;
             add_level
     holds   Each mipmap has the weight max(0, 1 - |lod - level|), which is trilinear filtering.
                                                                                    [Williams83]
                                                                                          >>store */

/* Channel k of a packed texel, from 0 to 1.  On little-endian processors red, green and blue are
   not shifted down: in place, times 1 / mask, they give the same product, and as they lie below bit
   31 they are a positive int32_t.  Bilinear textures gain 4 to 10 %. */
SHADE__INLINE float shade__texel(uint32_t packed, const shade__layout *l, int k)
{
    const int shift = shade__shift(l, k), down = k < 3 && shade__low_byte_first() ? 0 : shift;
    const uint32_t mask = (uint32_t)l->full[k] << (shift - down);
    return shade__number(packed >> down & mask) * (1 / shade__number(mask));
}

/* Four texels, blended: a and b are left and right above, c and d left and right below. */
SHADE__INLINE float shade__blend_four(float a, float b, float c, float d, float x, float y)
{
    float top = a + x * (b - a), low = c + x * (d - c);
    return top + y * (low - top);
}

/* The same for channel k of packed texels, a pair above and a pair below. */
SHADE__INLINE float shade__bilinear(const shade__layout *l, int k, const uint32_t *above,
                                    const uint32_t *below, float x, float y)
{
    return shade__blend_four(shade__texel(above[0], l, k), shade__texel(above[1], l, k),
                             shade__texel(below[0], l, k), shade__texel(below[1], l, k), x, y);
}

/* Blends the colours of a block of packed texels. */
SHADE__INLINE void shade__blend_colors(const shade__layout *l, shade__in_bits above,
                                       shade__in_bits below, shade__in x, shade__in y,
                                       shade__out rgb)
{
    SHADE__FOR(i, SHADE__BLOCK) {
        const uint32_t *a = above + 2 * i, *b = below + 2 * i;
        rgb[i] = shade__bilinear(l, 0, a, b, x[i], y[i]);
        rgb[i + SHADE_LANES] = shade__bilinear(l, 1, a, b, x[i], y[i]);
        rgb[i + 2 * SHADE_LANES] = shade__bilinear(l, 2, a, b, x[i], y[i]);
    }
}

/* Blends their alpha, which is 1 where all texels are opaque: bilinear textures gain 2 to 7 %. */
SHADE__INLINE void shade__blend_alpha(const shade__layout *l, shade__in_bits above,
                                      shade__in_bits below, shade__in x, shade__in y,
                                      shade__out alpha)
{
    const uint32_t full = (uint32_t)l->full[3] << shade__shift(l, 3);
    uint32_t opaque = full;
    SHADE__FOR(i, 2 * SHADE__BLOCK) { opaque &= above[i] & below[i]; }
    if (opaque == full) {
        SHADE__FOR(i, SHADE__BLOCK) { alpha[i] = 1; }
        return;
    }
    SHADE__FOR(i, SHADE__BLOCK) {
        alpha[i] = shade__bilinear(l, 3, above + 2 * i, below + 2 * i, x[i], y[i]);
    }
}

/* Blends all channels of packed texels. */
SHADE__INLINE void shade__blend_packed(const shade__reader *r, shade__in_bits texel, shade__out out)
{
    const shade__layout l = *r->layout;
    for (int b = 0; b < r->blocks * SHADE__BLOCK; b += SHADE__BLOCK) {
        const uint32_t *above = texel + 2 * b, *below = above + 2 * SHADE_LANES;
        shade__blend_colors(&l, above, below, r->x.weight + b, r->y.weight + b, out + b);
        shade__blend_alpha(&l, above, below, r->x.weight + b, r->y.weight + b,
                           out + b + 3 * SHADE_LANES);
    }
}

/* The linear light of a block of sRGB texels, by channel and by corner: left and right above, left
   and right below. */
typedef struct shade__four_lights { float c[3][4][SHADE__BLOCK]; } shade__four_lights;

/* Looks up a texel of 4 bytes.  Floats are copied as integers, because processors store more of
   these at a time. */
SHADE__INLINE void shade__look_up_bytes(const uint8_t *p, int red, int i, const int corner,
                                        shade__four_lights *to)
{
    const float *light = shade__map_light_of(255);
    SHADE_MEMCPY(&to->c[0][corner][i], &light[p[red]], 4);
    SHADE_MEMCPY(&to->c[1][corner][i], &light[p[1]], 4);
    SHADE_MEMCPY(&to->c[2][corner][i], &light[p[2 - red]], 4);
}

/* Looks up the sRGB texels of the block of pairs at texel.  Not inlined, because gcc would
   vectorise it, which takes longer. */
static SHADE__NOINLINE void shade__look_up(const shade__layout *l, const uint32_t *texel,
                                           shade__four_lights *SHADE_RESTRICT to)
{
    enum { below = 2 * SHADE_LANES };
    const uint8_t *p = (const uint8_t *)texel;
    const int red = l->shift[0] / 8;
    if (l->bytes == 4) {
        for (int i = 0; i < SHADE__BLOCK; i++, p += 8) {
            shade__look_up_bytes(p, red, i, 0, to);
            shade__look_up_bytes(p + 4, red, i, 1, to);
            shade__look_up_bytes(p + 4 * below, red, i, 2, to);
            shade__look_up_bytes(p + 4 * below + 4, red, i, 3, to);
        }
        return;
    }
    for (int n = 0; n < 4 * SHADE__BLOCK; n++) {
        const uint32_t word = texel[n / 4 * 2 + n % 2 + (n & 2 ? below : 0)];
        for (int k = 0; k < 3; k++)
            to->c[k][n % 4][n / 4] =
                shade__map_light_of(l->full[k])[word >> l->shift[k] & l->full[k]];
    }
}

/* Blends a block of sRGB texels into four rows; the upper pairs begin at `above`.  With both
   weights 0 the result is the left texel above. */
SHADE__INLINE void shade__blend_encoded(const shade__reader *r, const uint32_t *above, shade__in x,
                                        shade__in y, shade__out out)
{
    const shade__layout l = *r->layout;
    const uint32_t *below = above + 2 * SHADE_LANES;
    SHADE_ALIGNED shade__four_lights t;
    shade__look_up(&l, above, &t);
    /* alpha first, while the stores of shade__look_up finish: saves 2 to 4 % */
    SHADE__FOR(i, SHADE__BLOCK) {
        out[3 * SHADE_LANES + i] =
            shade__bilinear(&l, 3, above + 2 * i, below + 2 * i, x[i], y[i]);
    }
    for (int k = 0; k < 3; k++) {
        const float *a = t.c[k][0], *b = t.c[k][1], *c = t.c[k][2], *d = t.c[k][3];
        SHADE__FOR(i, SHADE__BLOCK) {
            out[k * SHADE_LANES + i] = shade__blend_four(a[i], b[i], c[i], d[i], x[i], y[i]);
        }
    }
}

/* Blends one channel of float texels, in the order of pairs.  A texel of weight 0 is left out: 0
   times infinity would be NaN. */
SHADE__INLINE void shade__blend_floats(const shade__reader *r, shade__in c, shade__out out)
{
    const float *second = c + 2 * SHADE_LANES;
    const int blocks = r->blocks;
    SHADE__EACH_BLOCK(i, blocks) {
        float x = r->x.weight[i], y = r->y.weight[i], c0 = c[2 * i], c2 = second[2 * i];
        uint32_t right = shade__mask(x > 0), below = shade__mask(y > 0);
        float top = c0 + shade__keep(x * (c[2 * i + 1] - c0), right);
        float low = c2 + shade__keep(x * (second[2 * i + 1] - c2), right);
        out[i] = top + shade__keep(y * (low - top), below);
    }
}

/* Adds one channel of a level times its weight; nothing for a weight of 0, since 0 times infinity
   would be NaN. */
SHADE__INLINE void shade__add_level(shade__in c, shade__in weight, int blocks, shade__out out)
{
    SHADE__EACH_BLOCK(i, blocks) {
        out[i] += shade__keep(weight[i] * c[i], shade__mask(weight[i] > 0));
    }
}

/* Filters one channel of texels of four floats. */
SHADE__INLINE void shade__filter_floats(const shade__reader *r, int k, float *row)
{
    SHADE_ALIGNED float value[4 * SHADE_LANES];
    shade__fetch(r, 0, k, shade__words(value));
    if (r->nearest) {    /* -0 becomes 0, as in a blend */
        SHADE__EACH_BLOCK(i, r->blocks) { row[i] = value[2 * i] + 0; }
        return;
    }
    shade__fetch(r, 1, k, shade__words(value + 2 * SHADE_LANES));
    shade__blend_floats(r, value, row);
}

/* Filters all channels of packed texels. */
SHADE__INLINE void shade__filter_packed(const shade__reader *r, int encoded, float *to)
{
    const shade__layout l = *r->layout;
    const int blocks = r->blocks;
    SHADE_ALIGNED uint32_t texel[4 * SHADE_LANES];
    shade__fetch(r, 0, 0, texel);
    if (r->nearest && !encoded) {
        for (int k = 0; k < 4; k++) {
            float *row = to + k * SHADE_LANES;
            SHADE__EACH_BLOCK(i, blocks) { row[i] = shade__texel(texel[2 * i], &l, k); }
        }
        return;
    }
    shade__fetch(r, 1, 0, texel + 2 * SHADE_LANES);
    if (!encoded) {
        shade__blend_packed(r, texel, to);
        return;
    }
    for (int i = 0; i < blocks * SHADE__BLOCK; i += SHADE__BLOCK)
        shade__blend_encoded(r, texel + 2 * i, r->x.weight + i, r->y.weight + i, to + i);
}

/* Filters the texels of a level.  Sets four rows, or adds to them if there are weights. */
SHADE__INLINE void shade__filter(const shade__reader *r, int encoded, const float *weight,
                                 float *out)
{
    SHADE_ALIGNED float level[4 * SHADE_LANES];
    float *to = weight ? level : out;
    if (r->layout->bytes == 16)
        for (int k = 0; k < 4; k++) shade__filter_floats(r, k, to + k * SHADE_LANES);
    else shade__filter_packed(r, encoded, to);
    if (!weight) return;
    for (int k = 0; k < 4; k++)
        shade__add_level(level + k * SHADE_LANES, weight, r->blocks, out + k * SHADE_LANES);
}

SHADE__INLINE void shade__read_level_body(const shade_texture *t, const float *u, const float *v,
                                          const float *weight, int blocks, float *out)
{
    shade__reader r;
    shade__open_level(t, u, v, blocks, &r);
    shade__filter(&r, shade__is_encoded(t->srgb, r.layout), weight, out);
}
SHADE__DISPATCH(shade__read_level,
                (const shade_texture *t, const float *u, const float *v, const float *weight,
                 int blocks, float *out), (t, u, v, weight, blocks, out),
                shade__read_level_body(t, u, v, weight, blocks, out))

/* Samples a texture with mipmaps: the levels that any lane needs, weighted. */
static SHADE__NOINLINE void shade__sample_levels(const shade_texture *t, const float *u,
                                                 const float *v, const float *lod, int blocks,
                                                 float *out)
{
    const int levels = shade__min(t->mipmap_count, 16);
    int least = levels, most = 0;
    SHADE_ALIGNED float level[SHADE_LANES];
    SHADE_ALIGNED float weight[SHADE_LANES];
    SHADE__EACH_BLOCK(i, blocks) {
        float finite = shade__keep(lod[i], shade__mask(shade__within(lod[i], FLT_MAX)));
        level[i] = shade__clamp_bits(finite, 0, (float)levels);
        least = shade__min(least, (int)level[i]);
        most = shade__max(most, (int)level[i]);
    }
    for (int k = 0; k < 4; k++) {
        SHADE__EACH_BLOCK(i, blocks) { out[i + k * SHADE_LANES] = 0; }
    }

    for (int k = least; k <= shade__min(most + 1, levels); k++) {
        shade_texture source = *t;
        uint32_t used = 0;
        SHADE__EACH_BLOCK(i, blocks) {
            float away = shade__keep(level[i] - (float)k, 0x7FFFFFFF);
            weight[i] = shade__clamp_bits(1 - away, 0, 1);
            used |= shade__float_bits(weight[i]);
        }
        if (k && shade__texture_good(&t->mipmaps[k - 1])) {    /* else the picture itself */
            source = t->mipmaps[k - 1];
            source.wrap_u = t->wrap_u;
            source.wrap_v = t->wrap_v;
            source.filter = t->filter;
        }
        if (used) shade__read_level(&source, u, v, weight, blocks, out);
    }
}

/* Samples blocks of lanes of a good texture. */
static void shade__sample(const shade_texture *t, const float *u, const float *v, const float *lod,
                          int blocks, float *out)
{
    if (lod && t->filter == SHADE_FILTER_TRILINEAR && t->mipmaps && t->mipmap_count > 0)
        shade__sample_levels(t, u, v, lod, blocks, out);
    else shade__read_level(t, u, v, NULL, blocks, out);
}

SHADEDEF void shade_sample_lanes(const shade_texture *texture, const float *u, const float *v,
                                 const float *lod, float *rgba)
{
    if (!u || !v || !rgba) return;
    if (!shade__texture_good(texture)) {
        for (int i = 0; i < 4 * SHADE_LANES; i++) rgba[i] = 1;
        return;
    }
    shade__sample(texture, u, v, lod, SHADE__BLOCKS, rgba);
}

SHADEDEF shade_vec4 shade_sample(const shade_texture *texture, float u, float v, float lod)
{
    float us[SHADE__BLOCK], vs[SHADE__BLOCK], lods[SHADE__BLOCK], out[4 * SHADE_LANES];
    if (!shade__texture_good(texture)) return shade_v4(1, 1, 1, 1);
    for (int i = 0; i < SHADE__BLOCK; i++) {
        us[i] = u;
        vs[i] = v;
        lods[i] = lod;
    }
    shade__sample(texture, us, vs, lods, 1, out);
    return shade_v4(out[0], out[SHADE_LANES], out[2 * SHADE_LANES], out[3 * SHADE_LANES]);
}

/*------------------------------------------------------------------------------------------ >>store
   Writes the colours of a packet to the caller's memory: late depth test, blending, formats.
     in      rows of linear RGBA, the queue's pixels     out  colour, and with may_discard depth
     way     store: late_depth; store_blended: unpack, blend; pack; scatter
     holds   Pixels are stored in drawing order.  A byte of linear light is floor(255 clamp(c) +
             1/2), NaN is 0.  The four rows of colours are SHADE_LANES apart.             >>check */

/* The thresholds of a 4 x 4 ordered dither at window positions x, y: the bits of x ^ y and of y,
   interleaved and reversed.   pre: 0 <= x, y < 2^31   post: 0 < threshold < 1 */
SHADE__INLINE void shade__dither(shade__in x, shade__in y, shade__out threshold, int blocks)
{
    SHADE__EACH_BLOCK(i, blocks) {
        uint32_t v = (uint32_t)(int32_t)y[i], d = (uint32_t)(int32_t)x[i] ^ v;
        uint32_t rank = (d & 1) << 3 | (v & 1) << 2 | (d & 2) | (v & 2) >> 1;
        threshold[i] = (shade__number(rank) + 0.5f) * 0.0625f;
    }
}

/* Channel k of a packed pixel: c, which may be any float, clamped to [0, 1], scaled to full, and
   rounded up if its fraction reaches 1 - threshold. */
SHADE__INLINE uint32_t shade__pack_channel(float c, const shade__layout *l, int k, float threshold)
{
    const int32_t number = (int32_t)(shade__saturate(c) * (float)l->full[k] + threshold);
    return (uint32_t)number << shade__shift(l, k);
}

SHADE__INLINE void shade__pack_channels(const shade__layout *layout, shade__in rgba,
                                        shade__in threshold, shade__out_bits packed, int blocks)
{
    const shade__layout l = *layout;
    SHADE__EACH_BLOCK(i, blocks) {
        packed[i] = shade__pack_channel(rgba[i], &l, 0, threshold[i]) |
                    shade__pack_channel(rgba[i + SHADE_LANES], &l, 1, threshold[i]) |
                    shade__pack_channel(rgba[i + 2 * SHADE_LANES], &l, 2, threshold[i]) |
                    shade__pack_channel(rgba[i + 3 * SHADE_LANES], &l, 3, threshold[i]);
    }
}

/* Packs linear colours into bytes.  For BGRA8 red and blue change places, so that all shifts are
   constants: a flat fill in cache gains 3 to 6 %. */
SHADE__INLINE void shade__pack_linear(const shade__layout *layout, shade__in rgba,
                                      shade__out_bits packed, int blocks)
{
    const shade__layout *l = &shade__layouts[SHADE_FORMAT_RGBA8];
    const int low = layout->shift[0] / 8 * SHADE_LANES, high = 2 * SHADE_LANES - low;
    SHADE__EACH_BLOCK(i, blocks) {
        packed[i] = shade__pack_channel(rgba[i + low], l, 0, 0.5f) |
                    shade__pack_channel(rgba[i + SHADE_LANES], l, 1, 0.5f) |
                    shade__pack_channel(rgba[i + high], l, 2, 0.5f) |
                    shade__pack_channel(rgba[i + 3 * SHADE_LANES], l, 3, 0.5f);
    }
}

/* The byte of a colour in sRGB, in three steps: its bits, clamped to 2^-13 (byte 0) .. 1 (byte
   255); its cell of shade__byte_steps; the byte, from the entry of the cell. */
SHADE__INLINE int32_t shade__srgb_bits(float c)
{
    const float kept = shade__keep(c, shade__mask(c > 0));
    return shade__max(shade__min(shade__ordinal(kept), 0x3F800000), 0x39000000);
}

SHADE__INLINE uint32_t shade__srgb_cell(int32_t bits)
{
    const float root = shade__from_ordinal((bits >> 1) + 0x1FC00000);
    return (uint32_t)(int32_t)(root * 372) - 4;
}

SHADE__INLINE uint32_t shade__srgb_byte(int32_t bits, uint32_t step)
{
    return (step >> 24) - (((uint32_t)bits - step) >> 23 & 1);
}

/* Packs colours as sRGB, and alpha, into bytes. */
SHADE__INLINE void shade__pack_bytes(const shade__layout *layout, shade__in rgba,
                                     shade__out_bits packed, int blocks)
{
    const shade__layout l = *layout;
    SHADE_ALIGNED int32_t c[SHADE_LANES];    /* the bits of colours */
    SHADE_ALIGNED uint32_t step[SHADE_LANES];
    SHADE__EACH_BLOCK(i, blocks) {
        packed[i] = shade__pack_channel(rgba[i + 3 * SHADE_LANES], &l, 3, 0.5f);
    }
    for (int k = 0; k < 3; k++) {
        const int shift = shade__shift(&l, k);
        SHADE__EACH_BLOCK(i, blocks) {
            c[i] = shade__srgb_bits(rgba[i + k * SHADE_LANES]);
            step[i] = shade__srgb_cell(c[i]);
        }
        for (int at = 0; at < blocks * SHADE__BLOCK; at += SHADE__BLOCK)
            SHADE__ONE_BY_ONE
            SHADE__FOR(i, SHADE__BLOCK) { step[at + i] = shade__byte_steps[step[at + i]]; }
        SHADE__EACH_BLOCK(i, blocks) {
            packed[i] |= shade__srgb_byte(c[i], step[i]) << shift;
        }
    }
}

/* Packs blocks of colours for the target.  Colours for pixels of 2 bytes in sRGB are encoded in
   place.  Only dithering reads x and y.  RGBA32F colours are left as they are. */
SHADE__INLINE void shade__pack_body(const shade_target *t, float *rgba, const float *x,
                                    const float *y, uint32_t *packed, int blocks)
{
    const shade__layout *l = &shade__layouts[t->format];
    const int encoded = shade__is_encoded(t->srgb, l);
    SHADE_ALIGNED float threshold[SHADE_LANES];
    if (l->bytes == 16) return;

    if (l->bytes == 4) {
        if (encoded) shade__pack_bytes(l, rgba, packed, blocks);
        else shade__pack_linear(l, rgba, packed, blocks);
        return;
    }
    if (encoded)
        for (int k = 0; k < 3; k++) {
            float *c = rgba + k * SHADE_LANES;
            SHADE_ALIGNED float u[SHADE_LANES];
            SHADE__EACH_BLOCK(i, blocks) {
                c[i] = shade__saturate(c[i]);
                u[i] = shade__encode_log(c[i]);
            }
            SHADE__EACH_BLOCK(i, blocks) { c[i] = shade__encode_curve(c[i], u[i]); }
        }
    SHADE__EACH_BLOCK(i, blocks) { threshold[i] = 0.5f; }
    if (t->dither && l->bytes == 2) shade__dither(x, y, threshold, blocks);
    shade__pack_channels(l, rgba, threshold, packed, blocks);
}
SHADE__DISPATCH(shade__pack,
                (const shade_target *t, float *rgba, const float *x, const float *y,
                 uint32_t *packed, int blocks), (t, rgba, x, y, packed, blocks),
                shade__pack_body(t, rgba, x, y, packed, blocks))

/* Unpacks a block of pixels to linear light.  RGBA32F pixels are in rgba already. */
SHADE__INLINE void shade__unpack_body(const shade_target *t, shade__in_bits packed, shade__out rgba)
{
    const shade__layout l = shade__layouts[t->format];
    const int encoded = shade__is_encoded(t->srgb, &l);
    if (l.bytes == 16) return;
    for (int k = 0; k < 4; k++) {
        float *c = rgba + k * SHADE_LANES;
        SHADE__FOR(i, SHADE__BLOCK) {
            c[i] = shade__channel(packed[i], &l, k) / (float)l.full[k];
        }
        if (encoded && k < 3) {
            float u[SHADE__BLOCK];
            SHADE__FOR(i, SHADE__BLOCK) { u[i] = shade__decode_log(c[i]); }
            SHADE__FOR(i, SHADE__BLOCK) { c[i] = shade__decode_curve(c[i], u[i]); }
        }
    }
}
SHADE__DISPATCH_AVX2(shade__unpack, (const shade_target *t, const uint32_t *packed, float *rgba),
                     (t, packed, rgba), shade__unpack_body(t, packed, rgba))

/* Packs n pixels and stores them at p.  The first is pixel (x, y) of the target, for dithering.
   pre: 0 < n <= SHADE_LANES; the rows hold whole blocks of numbers */
static void shade__store_run(const shade_target *t, float *rgba, int x, int y, int n, uint8_t *p)
{
    const shade__layout l = shade__layouts[t->format];
    SHADE_ALIGNED float px[SHADE_LANES];
    SHADE_ALIGNED float py[SHADE_LANES];
    SHADE_ALIGNED uint32_t packed[SHADE_LANES] = { 0 };    /* floats are stored from rgba */
    SHADE_EACH_LANE(i) {
        px[i] = (float)(x + i) + 0.5f;
        py[i] = (float)y + 0.5f;
    }
    shade__pack(t, rgba, px, py, packed, shade__blocks_of(n));
    if (l.bytes == 4) {
        SHADE_MEMCPY(p, packed, (size_t)n * 4);
        return;
    }
    for (int i = 0; i < n; i++) shade__store_pixel(&l, p + i * l.bytes, packed[i], rgba + i);
}

/* Tests and writes depth in drawing order, after a shader that may discard.  alive is 1 for lanes
   that store their colour, else 0. */
static void shade__late_depth(shade__draw *d, const uint32_t *discard, uint32_t *alive)
{
    const shade__plan *plan = &d->plan;
    const shade__queue *q = &d->u.queue;
    for (int i = 0; i < q->f.count; i++) {
        int passes = discard[i] == 0;
        if (passes && plan->depth) {
            float *p = plan->depth + q->offset[i], z = q->f.z[i];
            passes = shade__passes(plan->compare, 0, z, *p) != 0;
            if (passes && plan->compare.write) *p = z;
        }
        alive[i] = (uint32_t)passes;
        d->stats.fragments += passes;
    }
}

/* Stores the lanes first .. last - 1 that are alive, or all if alive is NULL. */
SHADE__INLINE void shade__scatter(const shade__draw *d, const uint32_t *alive, const float *rgba,
                                  const uint32_t *packed, int first, int last)
{
    const shade__layout l = *d->plan.layout;
    uint8_t *color = d->plan.color;
    for (int i = first; i < last; i++) {
        uint8_t *p = shade__pixel(color, d->u.queue.offset[i], l.bytes);
        if (!alive || alive[i]) shade__store_pixel(&l, p, packed[i], rgba + i);
    }
}

/* Stores all lanes in pixels of 4 bytes; a block of adjacent pixels is stored as one vector. */
SHADE__INLINE void shade__scatter_words(uint8_t *SHADE_RESTRICT color, shade__in_bits offset,
                                        shade__in_bits packed, int count)
{
    int i = 0;
    for (; i + SHADE__BLOCK <= count; i += SHADE__BLOCK) {
        const uint32_t first = offset[i];
        uint32_t apart = 0;
        SHADE__FOR(k, SHADE__BLOCK) { apart |= offset[i + k] - (first + (uint32_t)k); }
        if (!apart) {
            SHADE_MEMCPY(shade__pixel(color, first, 4), packed + i, SHADE__BLOCK * 4);
            continue;
        }
        for (int k = i; k < i + SHADE__BLOCK; k++)
            SHADE_MEMCPY(shade__pixel(color, offset[k], 4), packed + k, 4);
    }
    for (; i < count; i++) SHADE_MEMCPY(shade__pixel(color, offset[i], 4), packed + i, 4);
}

/* Blends a block of colours with the stored ones, by OVER or ADD, into stored.  To add a mode, add
   its sum here, its number in shade__raster_fault, its use of alpha in shade__mesh_alpha and
   shade__judge, and in shade__black_is_meant whether black may be meant. */
SHADE__INLINE void shade__blend(shade_blend blend, shade__in rgba, shade__out stored)
{
    const uint32_t over = shade__mask(blend == SHADE_BLEND_OVER);
    for (int k = 0; k < 4; k++) {
        const uint32_t scaled = k < 3 ? over : 0;    /* OVER multiplies colours, not alpha, by a */
        SHADE__FOR(i, SHADE__BLOCK) {
            const int at = k * SHADE_LANES + (int)i;
            float a = rgba[3 * SHADE_LANES + i], t = shade__select(1, 1 - a, over);
            stored[at] = rgba[at] * shade__select(1, a, scaled) + stored[at] * t;
        }
    }
}

/* Blends and stores in drawing order, in pieces of up to a block.  A piece ends where the offsets
   stop rising, so it holds no pixel twice.  The other lanes of its block are not stored. */
static SHADE__NOINLINE void shade__store_blended(const shade__draw *d, const uint32_t *alive,
                                                 const float *rgba, uint32_t *packed)
{
    const shade__plan *plan = &d->plan;
    const shade__queue *q = &d->u.queue;
    const shade__layout l = *plan->layout;
    SHADE_ALIGNED float stored[4 * SHADE_LANES] = { 0 };
    for (int i = 0, last; i < q->f.count; i = last) {
        const int base = shade__min(i, SHADE_LANES - SHADE__BLOCK);
        for (last = i; last < base + SHADE__BLOCK && last < q->f.count; last++) {
            if (last > i && q->offset[last] <= q->offset[last - 1]) break;
            shade__load_pixel(&l, shade__pixel(plan->color, q->offset[last], l.bytes),
                              packed + last, stored + last);
        }
        shade__unpack(plan->target, packed + base, stored + base);
        shade__blend(plan->pipe->raster.blend, rgba + base, stored + base);
        shade__pack(plan->target, stored + base, q->f.x + base, q->f.y + base, packed + base, 1);
        shade__scatter(d, alive, stored, packed, i, last);
    }
}

/* Tests the depth of the queue's packet, if it was not tested early, and stores its colours. */
SHADE__INLINE void shade__store_body(shade__draw *d, shade_colors *c)
{
    const shade__plan *plan = &d->plan;
    const shade__queue *q = &d->u.queue;
    SHADE_ALIGNED uint32_t packed[SHADE_LANES];
    uint32_t alive[SHADE_LANES], *only = plan->pipe->may_discard ? alive : NULL;
    if (only) shade__late_depth(d, c->discard, alive);
    if (!plan->color) return;

    if (plan->pipe->raster.blend != SHADE_BLEND_REPLACE) {
        SHADE_EACH_LANE(i) { packed[i] = 0; }
        shade__store_blended(d, only, c->color[0], packed);
        return;
    }
    shade__pack(plan->target, c->color[0], q->f.x, q->f.y, packed, SHADE__BLOCKS);
    if (plan->layout->bytes == 4 && !only)
        shade__scatter_words(plan->color, q->offset, packed, q->f.count);
    else shade__scatter(d, only, c->color[0], packed, 0, q->f.count);
}
SHADE__DISPATCH_AVX2(shade__store, (shade__draw *d, shade_colors *c), (d, c),
                     shade__store_body(d, c))

/*------------------------------------------------------------------------------------------ >>check
   Checks arguments.  A fault is the sentence that shade_explain says about it.  Callers that need
   only a shade_result inline the check, and the compiler drops the sentences.
     in      targets, meshes, states, indices
     out     NULL, or the fault; a shade_result
     holds   draw_refusal in >>drive, mesh_refusal in >>mesh and lines_refusal in >>lines are the
             ladders of the calls.  shade__mesh_varyings is counted here, because a draw that needs
             more than SHADE_MAX_VARYINGS is refused.                                      >>seen */

SHADE__INLINE const char *shade__target_fault(const shade_target *t)
{
    const uint64_t pixels = (uint64_t)shade__rows_held(t) * (uint64_t)shade__stride_of(t);
    if (!t->color && !t->depth)
        return "target.color and target.depth are both NULL; point one of them at your memory.";
    if (t->width < 1 || t->width > SHADE__SIDE_MAX || t->height < 1 || t->height > SHADE__SIDE_MAX)
        return "target.width and target.height must be from 1 to 16384 pixels.";
    if (t->stride && t->stride < t->width)
        return "target.stride is less than target.width; it counts pixels, and 0 means the width.";
    if (!shade__is_format(t->format) || t->format == SHADE_FORMAT_A8)
        return "target.format is unknown, or SHADE_FORMAT_A8, which only textures can have.";
    if (t->clip_width < 0 || t->clip_height < 0)
        return "target.clip_width or target.clip_height is negative; all four clip fields zero "
               "mean the whole picture.";
    if (t->row_count < 0 || t->row_offset < 0 || (t->row_offset && !t->row_count) ||
        (t->row_count && t->row_offset > t->height - t->row_count))
        return "target.row_offset and target.row_count reach beyond target.height or are negative, "
               "or row_count is 0 for a strip.";
    if (pixels > 0xFFFFFFFFu || pixels > SIZE_MAX / 16)
        return "target.stride times the number of rows exceeds 2^32 - 1 pixels, or memory where "
               "size_t has 32 bits.";
    return NULL;
}

static shade_result shade__check_target(const shade_target *t)
{
    return shade__target_fault(t) ? SHADE_ERROR_TARGET : SHADE_OK;
}

static int shade__corner_count(const shade_mesh *m)
{
    return m->indices || m->indices16 ? m->index_count : m->vertex_count;
}

SHADE__INLINE const char *shade__mesh_fault(const shade_mesh *m)
{
    const int strides = m->position_stride | m->normal_stride | m->texcoord_stride |
                        m->color_stride;
    if (m->vertex_count < 0) return "mesh.vertex_count is negative; it counts vertices.";
    if (!m->positions && m->vertex_count)
        return "mesh.positions is NULL while mesh.vertex_count is not 0.";
    if (m->indices && m->indices16)
        return "mesh.indices and mesh.indices16 are both set; one of them must be NULL.";
    if ((m->indices || m->indices16) && m->index_count < 0)
        return "mesh.index_count is negative; it counts indices, three a triangle.";
    if (strides < 0 || strides % 4)
        return "mesh.position_stride, normal_stride, texcoord_stride or color_stride is negative "
               "or not a multiple of 4; strides count bytes, not floats, and 0 means tightly "
               "packed.";

    if (m->chunk_count < 0) return "mesh.chunk_count is negative; it counts mesh.chunks.";
    if (!m->chunks)
        return m->chunk_count ? "mesh.chunks is NULL while mesh.chunk_count is not 0." : NULL;
    for (const shade_chunk *c = m->chunks; c < m->chunks + m->chunk_count; c++)
        if (c->first < 0 || c->count < 0 || c->first > shade__corner_count(m) / 3 - c->count)
            return "A chunk of mesh.chunks reaches beyond the triangles of the mesh, or its first "
                   "or count is negative; they count triangles, not indices.";
    return NULL;
}

SHADE__INLINE const char *shade__raster_fault(const shade_raster *r)
{
    if (!SHADE__KNOWN(r->cull, SHADE_CULL_FRONT))
        return "raster.cull is not a SHADE_CULL_... value.";
    if (!SHADE__KNOWN(r->depth_test, SHADE_COMPARE_ALWAYS))
        return "raster.depth_test is not a SHADE_COMPARE_... value.";
    if (!SHADE__KNOWN(r->blend, SHADE_BLEND_ADD))
        return "raster.blend is not a SHADE_BLEND_... value.";
    if (!shade__within(r->depth_bias, FLT_MAX))
        return "raster.depth_bias is NaN or infinite; 0 means none.";
    return NULL;
}

/* The first varying of each attribute of a mesh; -1: the draw does not have it.

     varying                       0        3        6
     lit per fragment              P        N        albedo   u v at 9, without colours at 6
     no lamps, or depth alone      albedo   u v
     lit per vertex or face        light
     the same, with a map          light    rest     u v
     state.fragment                P        N        albedo   u v at 9; always all 11

   A map multiplies the light of vertices, but not the rest of it (emission, highlights). */
typedef struct shade__mesh_varyings {
    int point, normal, light, rest, albedo, uv;
    int count;
} shade__mesh_varyings;

/* Takes the next n varyings if they are wanted. */
static int shade__take_varyings(shade__mesh_varyings *r, int n, int wanted)
{
    const int first = r->count;
    if (!wanted) return -1;
    r->count += n;
    return first;
}

static shade__mesh_varyings shade__varyings_of(const shade_draw_state *state, int map, int tinted,
                                               int pn_unread)
{
    const int custom = state->fragment != NULL;
    const int by_pixel = state->shading == SHADE_SHADING_PER_FRAGMENT && !pn_unread;
    const int by_vertex = state->shading != SHADE_SHADING_PER_FRAGMENT && !pn_unread;
    shade__mesh_varyings r;
    SHADE__ZERO(r);
    r.point = shade__take_varyings(&r, 3, by_pixel);
    r.normal = shade__take_varyings(&r, 3, by_pixel);
    r.light = shade__take_varyings(&r, 3, by_vertex);
    r.rest = shade__take_varyings(&r, 3, by_vertex && map);
    r.albedo = shade__take_varyings(&r, 3, !by_vertex && (custom || tinted));
    r.uv = shade__take_varyings(&r, 2, custom || map);
    return r;
}

SHADE__INLINE const char *shade__state_fault(const shade_mesh *m, const shade_draw_state *state)
{
    if (!SHADE__KNOWN(state->shading, SHADE_SHADING_PER_FACE))
        return "state.shading is not a SHADE_SHADING_... value.";
    if (!(state->transparency >= 0 && state->transparency <= 1))
        return "state.transparency must be from 0 (opaque) to 1 (invisible).";
    if (!(state->alpha_cutoff >= 0 && state->alpha_cutoff <= 1))
        return "state.alpha_cutoff must be from 0 (nothing is cut) to 1.";
    if (state->fragment && state->shading != SHADE_SHADING_PER_FRAGMENT)
        return "state.fragment needs state.shading to be SHADE_SHADING_PER_FRAGMENT.";
    if (shade__varyings_of(state, state->diffuse_map && m->texcoords, m->colors != NULL, 0).count >
        SHADE_MAX_VARYINGS)
        return "SHADE_MAX_VARYINGS is too small for this draw, which needs 6 varyings, 9 with "
               "mesh.colors, 2 more with state.diffuse_map, or 11 with state.fragment; lit by "
               "vertex or face 3, or 8 with state.diffuse_map.";
    return shade__raster_fault(&state->raster);
}

SHADE__INLINE const char *shade__lights_fault(const shade_lighting *l)
{
    if (!l->lights && l->light_count > 0)
        return "lighting.lights is NULL while lighting.light_count is not 0.";
    if (!SHADE__KNOWN(l->model, SHADE_MODEL_COOL_TO_WARM))
        return "lighting.model is not a SHADE_MODEL_... value.";
    for (int i = 0; i < l->light_count; i++)
        if (l->lights[i].spot_cos_cutoff != l->lights[i].spot_cos_cutoff)
            return "A light's spot_cos_cutoff is NaN: shade_spot_light takes a cutoff from 0 to pi "
                   "in radians; use shade_radians for degrees.";
    return NULL;
}

SHADE__INLINE const char *shade__pipeline_fault(const shade_pipeline *p)
{
    if (!SHADE__KNOWN(p->interpolation, SHADE_INTERPOLATION_CONSTANT))
        return "pipeline.interpolation is not a SHADE_INTERPOLATION_... value.";
    if (p->varyings < 0 || p->varyings > SHADE_MAX_VARYINGS)
        return "pipeline.varyings must be from 0 to SHADE_MAX_VARYINGS.";
    return shade__raster_fault(&p->raster);
}

SHADE__INLINE const char *shade__lod_fault(const shade_pipeline *p)
{
    if (p->lod_texture && (p->lod_varying < 0 || p->lod_varying >= p->varyings - 1))
        return "pipeline.lod_varying must be from 0 to pipeline.varyings - 2, which are u and v.";
    return p->lod_texture ? shade__texture_fault(p->lod_texture) : NULL;
}

/* All ones if one of the indices first .. end - 1 is n or more.  They are compared in lanes,
   because each thread that draws a band checks all of them. */
SHADE__INLINE uint32_t shade__any_beyond(shade__indices list, int first, int end, uint32_t n)
{
    uint32_t beyond = 0;
    int i = first;
    for (; end - i >= 16; i += 16)
        SHADE__FOR(k, 16) { beyond |= shade__mask(shade__index(list, (size_t)(i + k)) >= n); }
    for (; i < end; i++) beyond |= shade__mask(shade__index(list, (size_t)i) >= n);
    return beyond;
}

/* Checks count indices from first on; each width has a loop of its own. */
static SHADE__NOINLINE shade_result shade__check_indices(shade__indices list, int first, int count,
                                                         int vertex_count)
{
    const shade__indices wide = { list.wide, NULL }, narrow = { NULL, list.narrow };
    const int end = first + count;
    uint32_t beyond;
    if (count % 3) return SHADE_ERROR_INDEX;
    if (wide.wide) beyond = shade__any_beyond(wide, first, end, (uint32_t)vertex_count);
    else if (narrow.narrow) beyond = shade__any_beyond(narrow, first, end, (uint32_t)vertex_count);
    else beyond = end > vertex_count;
    return beyond ? SHADE_ERROR_INDEX : SHADE_OK;
}

static shade__indices shade__indices_of(const shade_mesh *m)
{
    const shade__indices list = { m->indices, m->indices16 };
    return list;
}

static shade_result shade__check_corners(const shade_mesh *m)
{
    return shade__check_indices(shade__indices_of(m), 0, shade__corner_count(m), m->vertex_count);
}

/* Pieces of memory: count pieces of size bytes, each stride bytes behind the one before. */
typedef struct shade__strided {
    const void *first;
    size_t count, size, stride;
} shade__strided;

static shade__strided shade__array(const void *first, size_t bytes)
{
    const shade__strided one = { first, first && bytes, bytes, 1 };
    return one;
}

/* Is a byte in both?  For example, an array that lies between the positions of interleaved vertices
   does not overlap them.  k is the first piece of b that ends behind the start of a piece of a. */
static int shade__overlap(shade__strided a, shade__strided b)
{
    const uintptr_t b0 = (uintptr_t)b.first;
    for (size_t i = 0; i < a.count; i++) {
        const uintptr_t low = (uintptr_t)a.first + i * a.stride;
        const size_t k = low < b0 + b.size ? 0 : (low - b0 - b.size) / b.stride + 1;
        if (k < b.count && b0 + k * b.stride < low + a.size) return 1;
    }
    return 0;
}

/* Does one of the first `outs` of n arrays overlap another of them? */
static int shade__any_overlap(const shade__strided *array, int outs, int n)
{
    for (int i = 0; i < outs; i++)
        for (int k = i + 1; k < n; k++)
            if (shade__overlap(array[i], array[k])) return 1;
    return 0;
}

/* Two arrays to be filled from a mesh, the second maybe empty: SHADE_ERROR_ARGUMENT if they overlap
   each other, the positions, indices or chunks of the mesh, or the struct of the mesh. */
static shade_result shade__check_outs(const shade_mesh *m, shade__strided out, shade__strided other)
{
    const size_t corners = (size_t)shade__corner_count(m);
    shade__strided array[7];
    array[0] = out;
    array[1] = other;
    array[2] = shade__array(m, sizeof *m);
    array[3] = shade__array(m->indices, corners * sizeof *m->indices);
    array[4] = shade__array(m->indices16, corners * sizeof *m->indices16);
    array[5] = shade__array(m->chunks, (size_t)m->chunk_count * sizeof *m->chunks);
    array[6].first = m->positions;
    array[6].count = (size_t)m->vertex_count;
    array[6].size = sizeof(shade_vec3);
    array[6].stride = m->position_stride ? (size_t)m->position_stride : array[6].size;
    return shade__any_overlap(array, 2, 7) ? SHADE_ERROR_ARGUMENT : SHADE_OK;
}

/*------------------------------------------------------------------------------------------- >>seen
   The clip rectangle, and tests of boxes against the planes of the view volume.
     in      a target, a matrix, boxes           out  the chunks of a mesh that are drawn
     way     see_chunks: frustum_of; then next_chunk: in_view, as batches need triangles
     holds   A box with a pixel in the clip rectangle is never skipped; rounding is allowed for.
     method  A box that lies outside one plane is invisible.                             >>drive */

/* Sets r to the clip rectangle, cut to the picture and the strip: x0, y0, x1, y1, the last two
   exclusive.  Returns 0 if it is empty. */
static int shade__clip_rectangle(const shade_target *t, int *r)
{
    int64_t x1 = (int64_t)t->clip_x + t->clip_width, y1 = (int64_t)t->clip_y + t->clip_height;
    int all = !t->clip_x && !t->clip_y && !t->clip_width && !t->clip_height;
    int top = t->row_offset, bottom = top + shade__rows_held(t);
    r[0] = shade__max(t->clip_x, 0);
    r[1] = shade__max(t->clip_y, top);
    r[2] = all || x1 > t->width ? t->width : (int)x1;
    r[3] = all || y1 > bottom ? bottom : (int)y1;
    return r[0] < r[2] && r[1] < r[3];
}

/* The planes of the view volume in object space: left, right, top, bottom, near, and far three
   times, to fill the lanes.  A point is outside where k.(P, 1) < 0.  size is in double too: with
   floats gcc 12.2 takes the stores to both rows for dead and drops them. */
enum { SHADE__PLANES = 8 };
struct shade__frustum {
    double k[4][SHADE__PLANES];
    double size[4][SHADE__PLANES];    /* the sum of the |terms| of k, to bound its rounding */
};

/* Plane i of the frustum: sign (c - limit w) >= 0 in clip space, where c is x, y or z for row 0, 1
   or 2. */
static void shade__frustum_plane(const shade_mat4 *m, int row, double sign, double limit, int i,
                                 shade__frustum *f)
{
    for (int k = 0; k < 4; k++) {
        const double a = (double)shade__entries(m)[4 * k + row], w = (double)m->col[k].w;
        f->k[k][i] = sign * (a - limit * w);
        f->size[k][i] = shade__abs(a) + shade__abs(limit * w) + (double)FLT_MIN;
    }
}

/* The planes of the clip rectangle, near and far.  The rectangle extends half a pixel beyond the
   centres of its pixels, and snapping and clipping move an edge by less. */
static SHADE__COLD void shade__frustum_of(const shade_target *t, const shade_mat4 *clip_from_object,
                                          int zero_to_one, shade__frustum *f)
{
    const double w = t->width, h = t->height;
    int r[4];
    shade__clip_rectangle(t, r);    /* an empty one shows nothing anyway */
    shade__frustum_plane(clip_from_object, 0, 1, 2.0 * r[0] / w - 1, 0, f);
    shade__frustum_plane(clip_from_object, 0, -1, 2.0 * r[2] / w - 1, 1, f);
    shade__frustum_plane(clip_from_object, 1, -1, 1 - 2.0 * r[1] / h, 2, f);
    shade__frustum_plane(clip_from_object, 1, 1, 1 - 2.0 * r[3] / h, 3, f);
    shade__frustum_plane(clip_from_object, 2, 1, zero_to_one ? 0 : -1, 4, f);
    for (int i = 5; i < SHADE__PLANES; i++) shade__frustum_plane(clip_from_object, 2, -1, 1, i, f);
    if (!shade__is_finite(clip_from_object)) SHADE__ZERO(*f);    /* no box lies outside */
}

/* Returns 0 if the box lies outside one plane, else 1.  For the centre c and half the extent h the
   greatest value of a plane is k.(c, 1) + |k|.h.  Vertices are transformed in float, with an error
   of 2^-22 of the sum of the |products|, and each of 7 clips adds 2^-24 of it; 2^-20 covers both.
   FLT_MIN in frustum.size covers products that underflow, with an error of 2^-148. */
static SHADE__NOINLINE int shade__in_view(const shade__frustum *f, shade_vec3 low, shade_vec3 high)
{
    double from[3], c[3], h[3], m[3];
    uint64_t signs = 0;
    if (!(low.x <= high.x && low.y <= high.y && low.z <= high.z)) return 1;
    shade__double3(low, from);
    shade__double3(high, h);
    for (int k = 0; k < 3; k++) {
        c[k] = (from[k] + h[k]) / 2;
        h[k] -= c[k];
        m[k] = shade__abs(c[k]) + h[k];
    }
    if (!(m[0] + m[1] + m[2] <= DBL_MAX)) return 1;
    SHADE__FOR(i, SHADE__PLANES) {
        double most = f->k[0][i] * c[0] + f->k[1][i] * c[1] + f->k[2][i] * c[2] + f->k[3][i];
        double off = f->size[0][i] * m[0] + f->size[1][i] * m[1];
        off += f->size[2][i] * m[2] + f->size[3][i];
        most += shade__abs(f->k[0][i]) * h[0];
        most += shade__abs(f->k[1][i]) * h[1];
        most += shade__abs(f->k[2][i]) * h[2];
        signs |= shade__double_bits(most + off * (1 / 1048576.0));
    }
    return !(signs >> 63);
}

/* Takes the next chunk that can be visible; returns 0 if there is none. */
static int shade__next_chunk(shade__draw *d)
{
    shade__supply *s = d->supply;
    for (; s->chunks > 0; s->chunks--) {
        const shade_chunk *c = s->chunk++;
        d->stats.triangles += c->count;
        s->first = c->first;
        s->end = c->first + c->count;
        if (c->count && shade__in_view(s->frustum, c->low, c->high)) {
            s->chunks--;
            return 1;
        }
        d->stats.skipped += c->count;
    }
    s->end = s->first;
    return 0;
}

/* Prepares the supply of a mesh's chunks that can be visible, in place of all its triangles. */
static void shade__see_chunks(const shade_target *t, const shade_mat4 *clip_from_object,
                              int zero_to_one, const shade_mesh *mesh, shade__frustum *frustum,
                              shade__supply *s)
{
    shade__frustum_of(t, clip_from_object, zero_to_one, frustum);
    s->end = 0;
    s->more = shade__next_chunk;
    s->chunks = mesh->chunk_count;
    s->chunk = mesh->chunks;
    s->frustum = frustum;
}

/*------------------------------------------------------------------------------------------ >>drive
   The public calls: arguments are checked before any pixel changes, then batch follows batch.
     in      the arguments of a call             out  pixels and stats, or a shade_result
     way     shade_draw: draw_refusal, supply_all; run_draw: make_plan, then take_batch,
             shade_vertices and triangles until no triangle is left.  shade_clear: clear_pattern,
             fill
                                                                                         >>mesh */

static shade__compare shade__compare_of(const shade_raster *r)
{
    /* for LESS, LESS_EQUAL, ...: 1 if less passes, + 2 if equal does, + 4 if greater does */
    static const uint32_t passing[] = { 1, 3, 4, 6, 2, 0 };
    const uint32_t passes = passing[r->depth_test];
    shade__compare c;
    c.less = 0u - (passes & 1);
    c.equal = 0u - (passes >> 1 & 1);
    c.greater = 0u - (passes >> 2);
    c.always = shade__mask(r->depth_test == SHADE_COMPARE_ALWAYS);
    c.write = shade__mask(!r->depth_read_only);
    return c;
}

/* Not SHADE__COLD: gcc propagates `cold` to callers, here shade__run_draw, and from there to every
   stage; their loops would stay scalar (4 times slower). */
static SHADE__NOINLINE void shade__make_plan(const shade_target *t, const shade_pipeline *p,
                                             int library_shader, shade__plan *plan)
{
    const int perspective = p->interpolation == SHADE_INTERPOLATION_PERSPECTIVE;
    const int early = t->depth && !p->may_discard, kept = early && !p->raster.depth_read_only;
    int clip[4];
    if (!shade__clip_rectangle(t, clip)) SHADE__ZERO(clip);
    plan->target = t;
    plan->pipe = p;
    plan->color = p->fragment ? (uint8_t *)t->color : NULL;
    plan->depth = plan->tested = t->depth;
    plan->layout = &shade__layouts[t->format];
    plan->stride = shade__stride_of(t);
    plan->row_offset = t->row_offset;
    plan->x0 = clip[0];
    plan->y0 = clip[1];
    plan->x1 = clip[2];
    plan->y1 = clip[3];
    plan->varyings = p->varyings;
    plan->values = SHADE__FIRST + p->varyings;
    plan->first_divided = perspective ? SHADE__FIRST : plan->values;
    plan->lod_u = p->lod_texture ? plan->first_divided + (perspective ? p->lod_varying : 0) : 0;
    if (p->lod_texture && !perspective) plan->values += 2;
    plan->value_stride = (plan->values + 7) / 8 * 8;
    plan->zero_to_one = p->raster.depth_zero_to_one != 0;
    plan->compare = shade__compare_of(&p->raster);
    plan->early = early;
    plan->tile_test = plan->compare;
    if (!early) plan->tile_test.always = UINT32_MAX;
    plan->queued = p->fragment && (plan->color || p->may_discard);
    plan->less_only = kept && p->raster.depth_test == SHADE_COMPARE_LESS;
    plan->inputs_unread = library_shader && early && !t->dither;
    plan->away = kept ? (float)((plan->compare.less != 0) - (plan->compare.greater != 0)) : 0;
    plan->half_width = t->width * 128;
    plan->half_height = t->height * 128;
}

/* Draws to a checked target, and changes the pipeline; it cannot fail, and returns SHADE_OK.
   library_shader: the fragment shader is one of this file, not the caller's. */
static shade_result shade__run_draw(const shade_target *target, shade_pipeline *pipe,
                                    int library_shader, shade_vec3 eye, shade__supply *supply,
                                    shade_stats *stats)
{
    shade__draw d;
    if (!pipe->fragment) pipe->may_discard = 0;
    if (!pipe->fragment || (!target->color && !pipe->may_discard)) {    /* no shader reads them */
        pipe->varyings = 0;
        pipe->lod_texture = NULL;
    }
    shade__make_plan(target, pipe, library_shader, &d.plan);
    d.plan.eye = eye;
    SHADE__ZERO(d.spare_depth);
    if (!d.plan.early) d.plan.tested = d.spare_depth;
    SHADE__ZERO(d.stats);
    /* lanes without a vertex or triangle compute too: their input must be defined */
    SHADE__ZERO(d.batch.value);
    SHADE__ZERO(d.setup);
    SHADE__ZERO(d.u.incoming.slot_of);
    d.bounds.across = 0;
    d.supply = supply;
    d.stats.triangles = supply->end;
    for (;;) {
        shade__take_batch(&d);
        if (!d.batch.count) break;
        shade__shade_vertices(&d);
        shade__triangles(&d);
    }
    if (stats) *stats = d.stats;
    return SHADE_OK;
}

/* Prepares the supply of all triangles of a list, one after the other. */
static void shade__supply_all(shade__indices indices, int index_count, shade__supply *s)
{
    s->indices = indices;
    s->first = 0;
    s->end = index_count / 3;
    s->more = NULL;
}

/* Returns why shade_draw refuses a draw, and sets *why to the sentence about it. */
SHADE__INLINE shade_result shade__draw_refusal(const shade_target *t, const shade_pipeline *p,
                                               shade__indices list, int index_count,
                                               int vertex_count, const char **why)
{
    *why = NULL;
    if (!t || !p || !p->vertex)
        *why = !t   ? "target is NULL, and must not be."
               : !p ? "pipeline is NULL, and must not be."
                    : "pipeline.vertex is NULL, and must not be.";
    if (*why) return SHADE_ERROR_ARGUMENT;
    *why = shade__target_fault(t);
    if (*why) return SHADE_ERROR_TARGET;
    if (index_count < 0 || vertex_count < 0) *why = "index_count or vertex_count is negative.";
    if (*why) return SHADE_ERROR_MESH;
    *why = shade__pipeline_fault(p);
    if (*why) return SHADE_ERROR_STATE;
    *why = shade__lod_fault(p);
    if (*why) return SHADE_ERROR_TEXTURE;

    if (index_count % 3)
        *why = "index_count is not a multiple of 3; it counts indices, three a triangle.";
    else if (shade__check_indices(list, 0, index_count, vertex_count))
        *why = "indices holds an index at or past vertex_count or, without indices, index_count "
               "exceeds vertex_count, which counts vertices, not floats.";
    return *why ? SHADE_ERROR_INDEX : SHADE_OK;
}

SHADEDEF shade_result shade_draw(const shade_target *target, const shade_pipeline *pipeline,
                                 const uint32_t *indices, int index_count, int vertex_count,
                                 shade_stats *stats)
{
    const shade__indices list = { indices, NULL };
    shade__supply supply;
    shade_pipeline pipe;
    const char *why;
    const shade_result result = shade__draw_refusal(target, pipeline, list, index_count,
                                                    vertex_count, &why);
    if (stats) SHADE__ZERO(*stats);
    if (result) return result;

    shade__supply_all(list, index_count, &supply);
    pipe = *pipeline;
    return shade__run_draw(target, &pipe, 0, shade_v3(0, 0, 0), &supply, stats);
}

/* Fills n bytes by repeating a pattern of 256 bytes. */
static void shade__fill(uint8_t *SHADE_RESTRICT p, shade__in pattern, size_t n)
{
    for (; n >= 256; n -= 256, p += 256) SHADE_MEMCPY(p, pattern, 256);
    SHADE_MEMCPY(p, pattern, n);
}

/* Writes 256 bytes of a colour, for pixels from (x, y) on: 8 packed pixels, twice the period of the
   dither, repeated. */
static void shade__clear_pattern(const shade_target *t, shade_vec4 color, int x, int y,
                                 uint8_t *pattern)
{
    const size_t period = 8 * shade__pixel_bytes(t->format);
    float rgba[4 * SHADE_LANES];
    for (int i = 0; i < SHADE__BLOCK; i++) shade__put4(rgba, SHADE_LANES, i, color);
    shade__store_run(t, rgba, x, y, 8, pattern);
    for (size_t i = period; i < 256; i++) pattern[i] = pattern[i - period];
}

SHADEDEF shade_result shade_clear(const shade_target *target, shade_vec4 color, float depth)
{
    shade_result result = target ? shade__check_target(target) : SHADE_ERROR_ARGUMENT;
    size_t bytes, n;
    float pattern[64], depths[64];
    int clip[4];
    if (!result && depth != depth) result = SHADE_ERROR_ARGUMENT;
    if (result || !shade__clip_rectangle(target, clip)) return result;

    bytes = shade__pixel_bytes(target->format);
    n = (size_t)(clip[2] - clip[0]);
    for (int i = 0; i < 64; i++) depths[i] = depth;
    for (int y = clip[1]; y < clip[3]; y++) {
        size_t at = shade__offset_of(target, clip[0], y);
        if (target->depth) shade__fill((uint8_t *)(target->depth + at), depths, n * 4);
        if (!target->color) continue;
        if (y == clip[1] || target->dither)
            shade__clear_pattern(target, color, clip[0], y, (uint8_t *)pattern);
        shade__fill((uint8_t *)target->color + at * bytes, pattern, n * bytes);
    }
    return SHADE_OK;
}

/*------------------------------------------------------------------------------------------- >>mesh
   A mesh is drawn by a vertex shader and a fragment shader, as by any pipeline.
     in      arrays in object space    out  varyings in world space: P, N, albedo; or one lit colour
     way     shade_draw_mesh: mesh_refusal; scene_of: plan_scene; draw_scene: run_draw, or
             draw_chunks, which calls run_draw; that calls the shaders.  mesh_vertex:
             fetch_vertices, fetch_faces, light_vertices.  mesh_fragment: mesh_colors: lit_map;
             mesh_alpha.  shade__mesh_varyings in >>check says which varyings they use
     holds   If faces have their own normals or light, every corner of a triangle is a vertex: its
             index is 3 times the triangle's plus the corner's number.  If no shader reads P and N,
             they are not computed: textured floors without lamps are drawn 1.15 to 1.23 times as
             fast, with colours 1.02 to 1.04 times.                                       >>lines */

typedef struct shade__scene {            /* uniforms of the mesh shaders */
    const shade_mesh *mesh;
    const shade_draw_state *state;
    shade_mat4 clip_from_object, world_from_object;
    shade_mat3 normal_matrix;
    shade_vec3 eye;
    shade_lighting lighting;             /* with a map and light at vertices, only the terms that
                                            the map multiplies */
    unsigned unmapped;                   /* then: the terms that it does not */
    shade__surface surface;              /* made from lighting */
    const shade_texture *map;            /* NULL: none */
    uint32_t white_map;                  /* all ones: the map counts as white, with its holes */
    int face_normals;                    /* N is the normal of the face */
    int corners;                         /* every corner is a vertex */
    int has_picture;                     /* the target has a picture */
    int tinted;                          /* a shader reads the colours of the mesh */
    int lit_vertices;                    /* light is computed at vertices, or once a face */
    int pn_unread;                       /* no shader reads P and N */
    shade__mesh_varyings first;          /* of each attribute */
} shade__scene;

enum { SHADE__TERM_NONE = 128 };    /* no term at all, since 0 means all */

/* Element i of an array of vectors.  stride: in bytes; 0 if they follow each other. */
SHADE__INLINE shade_vec3 shade__vec3_at(const float *array, int stride, uint32_t i)
{
    float v[3];
    SHADE_MEMCPY(v, (const char *)array + (size_t)i * (size_t)(stride ? stride : 12), 12);
    return shade_v3(v[0], v[1], v[2]);
}

SHADE__INLINE uint32_t shade__corner_index(const shade_mesh *m, uint32_t corner)
{
    return shade__index(shade__indices_of(m), corner);
}

/* The position of a corner; corners are counted through all triangles. */
SHADE__INLINE shade_vec3 shade__corner(const shade_mesh *m, uint32_t corner)
{
    return shade__vec3_at(m->positions, m->position_stride, shade__corner_index(m, corner));
}

/* Writes the corners of a triangle to p and returns their shade_face_normal. */
static SHADE__NOINLINE shade_vec3 shade__face_normal(const shade_mesh *m, uint32_t triangle,
                                                     shade_vec3 *p)
{
    for (uint32_t k = 0; k < 3; k++) p[k] = shade__corner(m, 3 * triangle + k);
    return shade_face_normal(p[0], p[1], p[2]);
}

/* The vertex of lane i of a packet. */
SHADE__INLINE uint32_t shade__vertex_of(const shade__scene *s, const shade_vertex_ids *in, int i)
{
    return s->corners ? shade__corner_index(s->mesh, in->index[i]) : in->index[i];
}

/* Fetches the vertices of a packet, in object space: rows of P and, if a shader reads them, of N
   and albedo. */
static SHADE__NOINLINE void shade__fetch_vertices(const shade__scene *s, const shade_vertex_ids *in,
                                                  shade__v3 *point, shade__v3 *normal,
                                                  shade__v3 *albedo)
{
    const shade_mesh *m = s->mesh;
    const int with_normals = !s->face_normals && !s->pn_unread;
    for (int i = 0; i < SHADE_LANES; i++) {
        uint32_t v = shade__vertex_of(s, in, i);
        shade__put(point, i, shade__vec3_at(m->positions, m->position_stride, v));
        if (with_normals) shade__put(normal, i, shade__vec3_at(m->normals, m->normal_stride, v));
        if (s->tinted) shade__put(albedo, i, shade__vec3_at(m->colors, m->color_stride, v));
    }
}

/* Computes the normal of each face for all its corners, which follow each other in the packet; with
   SHADE_SHADING_PER_FACE its centroid and the colour of its first vertex too. */
static SHADE__NOINLINE void shade__fetch_faces(const shade__scene *s, const shade_vertex_ids *in,
                                               shade__v3 *point, shade__v3 *normal,
                                               shade__v3 *albedo)
{
    const shade_mesh *m = s->mesh;
    const int per_face = s->state->shading == SHADE_SHADING_PER_FACE;
    shade_vec3 p[3], n = shade_v3(0, 0, 0), middle = n;
    uint32_t seen = UINT32_MAX;
    for (int i = 0; i < SHADE_LANES; i++) {
        const uint32_t face = in->index[i] / 3, v = shade__corner_index(m, 3 * face);
        if (face != seen) {
            n = shade__face_normal(m, face, p);
            middle = shade_add(shade_sub(p[1], p[0]), shade_sub(p[2], p[0]));
            middle = shade_madd(p[0], 1 / 3.0f, middle);
            seen = face;
        }
        shade__put(normal, i, n);
        if (!per_face) continue;

        shade__put(point, i, middle);
        if (s->tinted) shade__put(albedo, i, shade__vec3_at(m->colors, m->color_stride, v));
    }
}

/* clip = m (P, 1) */
SHADE__INLINE void shade__lane_clip(shade_mat4 m, shade__in_v3 point, shade__out clip)
{
    SHADE_EACH_LANE(i) {
        const shade_vec4 p = shade__xyzw(shade__at(point, i), 1);
        shade__put4(clip, SHADE_LANES, i, shade_mat4_transform(m, p));
    }
}

/* P = m (P, 1), without a division because models are affine. */
SHADE__INLINE void shade__lane_world(shade_mat4 m, shade__out_v3 point)
{
    SHADE_EACH_LANE(i) {
        const shade_vec4 p = shade__xyzw(shade__at(point, i), 1);
        shade__put(point, i, shade__xyz(shade_mat4_transform(m, p)));
    }
}

/* N = m N / |m N|, because interpolation between vertices starts from unit normals. */
SHADE__INLINE void shade__lane_normal(shade_mat3 m, shade__out_v3 normal)
{
    SHADE_EACH_LANE(i) {
        shade_vec3 n = shade_mat3_transform(m, shade__at(normal, i));
        shade__put(normal, i, shade_scale(n, shade__rsqrt(shade_dot(n, n))));
    }
}

static SHADE__NOINLINE void shade__fetch_texcoords(const shade__scene *s,
                                                   const shade_vertex_ids *in, float *u)
{
    const shade_mesh *m = s->mesh;
    const size_t stride = m->texcoord_stride ? (size_t)m->texcoord_stride : 8;
    for (int i = 0; i < SHADE_LANES; i++) {
        const char *p = (const char *)m->texcoords + shade__vertex_of(s, in, i) * stride;
        SHADE_MEMCPY(u + i, p, 4);
        SHADE_MEMCPY(u + i + SHADE_LANES, p + 4, 4);
    }
}

/* Writes the light of vertices to rows 0 .. 2 of rgb.  With a map these are the part that the map
   multiplies, and rows 3 .. 5 get the rest. */
static void shade__light_vertices(const shade__scene *s, const shade__v3 *point,
                                  const shade__v3 *normal, const float *albedo, float *rgb)
{
    shade_rows rows;
    SHADE__ZERO(rows);
    rows.position = point->x;
    rows.normal = normal->x;
    rows.albedo = albedo;
    shade__lit_packet(&s->surface, &rows, rgb);
    if (s->map) {
        shade_lighting rest = s->lighting;
        rest.terms = s->unmapped;
        shade_lit_lanes(&rest, s->state->material, s->eye, &rows, rgb + 3 * SHADE_LANES);
    }
}

/* The rows of a vector that begins at a varying, or spare ones for -1. */
SHADE__INLINE shade__v3 *shade__varying_rows(shade_vertices *out, int first, shade__v3 *spare)
{
    return first < 0 ? spare : shade__rows_out(out->varying[first]);
}

/* Fetches attributes into the rows of their varyings, or into spare rows if the draw needs them but
   passes them to no fragment. */
static void shade__mesh_vertex(const void *uniforms, const shade_vertex_ids *SHADE_RESTRICT in,
                               shade_vertices *SHADE_RESTRICT out)
{
    const shade__scene *s = (const shade__scene *)uniforms;
    const int custom = s->state->fragment != NULL;
    shade__v3 spare[3];
    shade__v3 *point = shade__varying_rows(out, s->first.point, &spare[0]);
    shade__v3 *normal = shade__varying_rows(out, s->first.normal, &spare[1]);
    shade__v3 *albedo = shade__varying_rows(out, s->first.albedo, &spare[2]);
    shade__fetch_vertices(s, in, point, normal, albedo);
    shade__lane_clip(s->clip_from_object, point, out->clip[0]);
    if (!s->pn_unread) {
        if (s->face_normals) shade__fetch_faces(s, in, point, normal, albedo);
        shade__lane_world(s->world_from_object, point);
        shade__lane_normal(s->normal_matrix, normal);
    }
    if (custom && !s->tinted)
        for (int i = 0; i < SHADE_LANES; i++) shade__put(albedo, i, shade_v3(1, 1, 1));
    if (s->lit_vertices)
        shade__light_vertices(s, point, normal, s->tinted ? albedo->x : NULL,
                              out->varying[s->first.light]);
    if (s->first.uv >= 0 && s->mesh->texcoords)
        shade__fetch_texcoords(s, in, out->varying[s->first.uv]);
}

/* Multiplies alpha (from the map, the shader, or 1) by the opacity, applies the cut-off, and for
   ADD scales the colour by alpha. */
static void shade__mesh_alpha(const shade__scene *s, shade_colors *SHADE_RESTRICT out)
{
    const float opacity = 1 - s->state->transparency, cutoff = s->state->alpha_cutoff;
    SHADE_EACH_LANE(i) { out->color[3][i] *= opacity; }
    if (cutoff > 0) {
        SHADE_EACH_LANE(i) { out->discard[i] |= shade__mask(out->color[3][i] >= cutoff) + 1; }
    }
    if (s->has_picture && s->state->raster.blend == SHADE_BLEND_ADD) {
        SHADE_EACH_LANE(i) {
            float a = out->color[3][i];
            out->color[0][i] *= a;
            out->color[1][i] *= a;
            out->color[2][i] *= a;
        }
    }
}

/* Lights fragments with the map as their albedo: rgb holds its colours, and receives the light.
   Not inlined, so that only maps take its stack. */
static SHADE__NOINLINE void shade__lit_map(const shade__scene *s, const shade_rows *rows,
                                           float *rgb)
{
    float albedo[3 * SHADE_LANES];
    shade_rows mapped = *rows;
    SHADE_MEMCPY(albedo, rgb, sizeof albedo);
    if (rows->albedo)
        for (int i = 0; i < 3 * SHADE_LANES; i++) albedo[i] *= rows->albedo[i];
    mapped.albedo = albedo;
    shade__lit_packet(&s->surface, &mapped, rgb);
}

/* The rows of a vector that begins at a varying; NULL for -1. */
SHADE__INLINE const float *shade__varying_row(const shade_fragments *in, int first)
{
    return first < 0 ? NULL : in->varying[first];
}

/* The colours of fragments: the map, lit at each pixel by P and N, or multiplied by the light of
   the vertices.  Draws without a picture need the map alone, for the holes that it cuts. */
static void shade__mesh_colors(const shade__scene *s, const shade_fragments *SHADE_RESTRICT in,
                               shade_colors *SHADE_RESTRICT out)
{
    const shade__mesh_varyings *first = &s->first;
    float *to = out->color[0];
    if (s->map)
        shade_sample_lanes(s->map, in->varying[first->uv], in->varying[first->uv + 1],
                           s->map->mipmap_count ? in->lod : NULL, to);
    if (!s->has_picture) return;
    if (s->white_map)
        for (int i = 0; i < 3 * SHADE_LANES; i++) to[i] = 1;

    if (!s->lit_vertices) {
        shade_rows rows;
        SHADE__ZERO(rows);
        rows.position = shade__varying_row(in, first->point);
        rows.normal = shade__varying_row(in, first->normal);
        rows.albedo = shade__varying_row(in, first->albedo);
        if (s->map) shade__lit_map(s, &rows, to);
        else shade__lit_packet(&s->surface, &rows, to);
    } else if (s->map) {
        const float *light = in->varying[first->light], *rest = in->varying[first->rest];
        for (int i = 0; i < 3 * SHADE_LANES; i++) to[i] = light[i] * to[i] + rest[i];
    } else SHADE_MEMCPY(to, in->varying[first->light], 3 * sizeof in->varying[0]);
}

static void shade__mesh_fragment(const void *uniforms, const shade_fragments *SHADE_RESTRICT in,
                                 shade_colors *SHADE_RESTRICT out)
{
    const shade__scene *s = (const shade__scene *)uniforms;
    if (s->state->fragment) s->state->fragment(s->state->uniforms, in, out);
    else shade__mesh_colors(s, in, out);
    shade__mesh_alpha(s, out);
}

/* Decides what the shaders do.   pre: mesh, state, has_picture, map and surface are set */
static void shade__plan_scene(shade__scene *s)
{
    const shade_mesh *m = s->mesh;
    const shade_draw_state *state = s->state;
    const int per_fragment = state->shading == SHADE_SHADING_PER_FRAGMENT;
    s->face_normals = !m->normals || state->shading == SHADE_SHADING_PER_FACE;
    s->pn_unread = !state->fragment && (!s->has_picture || (per_fragment && !s->surface.lamps));
    s->lit_vertices = !per_fragment && !s->pn_unread;
    s->corners = s->face_normals && !s->pn_unread;
    s->tinted = m->colors && (s->has_picture || state->fragment);
    s->first = shade__varyings_of(state, s->map != NULL, s->tinted, s->pn_unread);
}

/* Not inlined: its temporaries would take half a kilobyte of stack during the whole draw. */
static SHADE__COLD void shade__scene_of(const shade_target *target, const shade_mesh *mesh,
                                        const shade_draw_state *state, shade__scene *s)
{
    const unsigned matte = SHADE_TERM_AMBIENT | SHADE_TERM_DIFFUSE;
    const shade_mat4 view = shade__or_identity(state->view);
    s->mesh = mesh;
    s->state = state;
    s->has_picture = target->color != NULL;
    s->map = mesh->texcoords ? state->diffuse_map : NULL;
    s->white_map = 0;
    s->world_from_object = shade__or_identity(state->model);
    s->clip_from_object = shade__or_identity(state->projection);
    s->clip_from_object = shade__mat4_product(&s->clip_from_object, &view);
    s->clip_from_object = shade__mat4_product(&s->clip_from_object, &s->world_from_object);
    s->normal_matrix = shade_normal_matrix(shade__sized(s->world_from_object));
    s->eye = state->lighting.flags & SHADE_FLAG_INFINITE_VIEWER
                 ? shade_mat4_transform_direction(shade_mat4_inverse(view), shade_v3(0, 0, 1))
                 : shade_mat4_eye(view);

    s->lighting = state->lighting;
    if (s->map && state->shading != SHADE_SHADING_PER_FRAGMENT) {
        const unsigned terms = state->lighting.terms ? state->lighting.terms : ~0u;
        s->lighting.terms = (terms & matte) | SHADE__TERM_NONE;
        s->unmapped = (terms & ~matte) | SHADE__TERM_NONE;
    }
    shade__begin_surface(&s->lighting, state->material, s->eye, &s->surface);
    shade__plan_scene(s);
}

/* Draws the chunks of a mesh that can be visible.  Not inlined, so that only meshes with chunks
   have the planes on the stack. */
static SHADE__NOINLINE shade_result shade__draw_chunks(const shade_target *target,
                                                       shade_pipeline *p, const shade__supply *all,
                                                       shade_stats *stats)
{
    const shade__scene *scene = (const shade__scene *)p->uniforms;
    shade__supply supply = *all;
    shade__frustum frustum;
    shade__see_chunks(target, &scene->clip_from_object, p->raster.depth_zero_to_one,
                      scene->mesh, &frustum, &supply);
    return shade__run_draw(target, p, !scene->state->fragment, scene->eye, &supply, stats);
}

/* Draws a checked scene, with the vertex shader of meshes and the given fragment shader. */
static shade_result shade__draw_scene(const shade_target *target, const shade__scene *scene,
                                      shade_fragment_shader *fragment, int may_discard,
                                      shade_stats *stats)
{
    const shade_mesh *mesh = scene->mesh;
    const shade_draw_state *state = scene->state;
    shade_pipeline p;
    shade__supply supply;
    shade__supply_all(shade__indices_of(mesh), shade__corner_count(mesh), &supply);
    if (scene->corners) SHADE__ZERO(supply.indices);
    SHADE__ZERO(p);
    p.vertex = shade__mesh_vertex;
    p.may_discard = may_discard;
    p.fragment = fragment;
    p.uniforms = scene;
    p.varyings = scene->first.count;
    if (scene->map && (scene->map->mipmap_count || state->fragment)) {
        p.lod_texture = scene->map;
        p.lod_varying = scene->first.uv;
    }
    if (state->shading == SHADE_SHADING_PER_FACE && !scene->map)
        p.interpolation = SHADE_INTERPOLATION_CONSTANT;
    p.raster = state->raster;
    if (mesh->chunks) return shade__draw_chunks(target, &p, &supply, stats);
    return shade__run_draw(target, &p, !state->fragment, scene->eye, &supply, stats);
}

/* Returns why shade_draw_mesh refuses a draw, and sets *why to the sentence about it. */
SHADE__INLINE shade_result shade__mesh_refusal(const shade_target *t, const shade_mesh *m,
                                               const shade_draw_state *s, const char **why)
{
    *why = NULL;
    if (!t) *why = "target is NULL; pass the address of a shade_target.";
    else if (!m) *why = "mesh is NULL; pass the address of a shade_mesh.";
    else if (!s) *why = "state is NULL; pass the address of a shade_draw_state.";
    if (*why) return SHADE_ERROR_ARGUMENT;
    *why = shade__target_fault(t);
    if (*why) return SHADE_ERROR_TARGET;
    *why = shade__mesh_fault(m);
    if (*why) return SHADE_ERROR_MESH;
    *why = shade__state_fault(m, s);
    if (*why) return SHADE_ERROR_STATE;
    *why = shade__lights_fault(&s->lighting);
    if (*why) return SHADE_ERROR_LIGHTS;
    if (m->texcoords && s->diffuse_map) *why = shade__texture_fault(s->diffuse_map);
    if (*why) return SHADE_ERROR_TEXTURE;

    if (shade__corner_count(m) % 3)
        *why = "mesh.index_count is not a multiple of 3 or, without mesh.indices, "
               "mesh.vertex_count is not; they count indices and vertices, three a triangle.";
    else if (shade__check_corners(m))
        *why = "mesh.indices holds an index at or past mesh.vertex_count; vertex_count counts "
               "vertices, not floats, and indices are 32 bits wide, or 16 in mesh.indices16.";
    return *why ? SHADE_ERROR_INDEX : SHADE_OK;
}

SHADEDEF shade_result shade_draw_mesh(const shade_target *target, const shade_mesh *mesh,
                                      const shade_draw_state *state, shade_stats *stats)
{
    shade__scene scene;
    const char *why;
    const shade_result result = shade__mesh_refusal(target, mesh, state, &why);
    if (stats) SHADE__ZERO(*stats);
    if (result) return result;

    shade__scene_of(target, mesh, state, &scene);
    return shade__draw_scene(target, &scene, shade__mesh_fragment,
                             state->alpha_cutoff > 0 || (state->fragment && target->color), stats);
}

/*------------------------------------------------------------------------------------------ >>lines
   A line is a rectangle on the screen, drawn as two triangles by the pipeline above.
     in      pairs of points
     out     pixels with the coverage, depth test and blending of triangles
     way     shade_draw_lines: lines_refusal, stroke_of; run_draw, which calls the shaders.
             stroke_vertex: stroke_corner: stroke_end, stroke_part: trim.  stroke_color
     holds   A segment is cut at the near and far planes first, so that both ends have a place on
             the screen.  A segment outside becomes triangles outside, which count as clipped.
                                                                                         >>camera */

typedef struct shade__stroke {           /* uniforms of the line shaders */
    const shade_vec3 *points;
    const shade_line_state *state;
    double clip_from_points[16];         /* column-major */
    double half[2];                      /* half the width and height of the picture, in pixels */
    double half_line;                    /* half the width of the lines, in pixels */
} shade__stroke;

/* Shortens t[0] .. t[1], a part of a segment, to its part inside a plane.  a and b are the signed
   distances of the segment's ends.  Nothing is left where t[1] < t[0]. */
static void shade__trim(double a, double b, double *t)
{
    if (a < 0 && b < 0) t[1] = -1;
    else if (a < 0 && a / (a - b) > t[0]) t[0] = a / (a - b);
    else if (b < 0 && a / (a - b) < t[1]) t[1] = a / (a - b);
}

/* Sets p to the point at the fraction t of a segment, and at[] to its place relative to the middle
   of the picture, in pixels, y up. */
static void shade__stroke_point(const shade__stroke *s, double end[2][4], double t, double *p,
                                double *at)
{
    for (int i = 0; i < 4; i++) p[i] = end[0][i] + t * (end[1][i] - end[0][i]);
    for (int i = 0; i < 2; i++) at[i] = p[i] / p[3] * s->half[i];
}

/* Finds the part t[0] .. t[1] of a segment that is drawn, and its unit direction on the screen.
   The segment is cut at near, far and w > 0, then 3 half widths and 2 pixels outside the picture,
   so that the cut ends stay out of view; they are exact to 1/256 pixel.  Returns 0 if nothing is
   left. */
static int shade__stroke_part(const shade__stroke *s, double end[2][4], double *t, double *dir)
{
    const double w0 = end[0][3], w1 = end[1][3], z0 = end[0][2], z1 = end[1][2];
    /* not 0: rounding moves t by up to 1e-16, and w by that times the difference of the two */
    const double least = (w0 > w1 ? w0 - w1 : w1 - w0) * 1e-14 + (double)shade__w_least;
    const int zero_to_one = s->state->raster.depth_zero_to_one != 0;
    double p[4], at[2][2], length = 0;
    t[0] = 0;
    t[1] = 1;
    shade__trim(z0 + (zero_to_one ? 0 : w0), z1 + (zero_to_one ? 0 : w1), t);
    shade__trim(w0 - z0, w1 - z1, t);
    shade__trim(w0 - least, w1 - least, t);
    if (!(t[0] <= t[1])) return 0;
    for (int j = 0; j < 2; j++) shade__stroke_point(s, end, t[j], p, at[j]);
    for (int i = 0; i < 2; i++) {
        const double limit = 1 + (3 * s->half_line + 2) / s->half[i];
        shade__trim(limit * w0 - end[0][i], limit * w1 - end[1][i], t);
        shade__trim(limit * w0 + end[0][i], limit * w1 + end[1][i], t);
        dir[i] = at[1][i] - at[0][i];
        length += dir[i] * dir[i];
    }
    if (length > 0) {
        length = shade__root(length);
        dir[0] /= length;
        dir[1] /= length;
    } else dir[0] = 1;
    return t[0] <= t[1];
}

/* The greatest width, 2000 times the largest picture.  Wider lines are drawn with this width.
   Their corners stay within 2^28 pictures of the middle, so that in clip space, where |w| <= 1e30,
   they do not overflow. */
#define SHADE__WIDEST 33554432.0f

/* The clip-space position of a point. */
static void shade__stroke_end(const shade__stroke *s, size_t point, double end[4])
{
    const double *m = s->clip_from_points;
    double v[3];
    shade__double3(s->points[point], v);
    for (int i = 0; i < 4; i++)
        end[i] = m[i] * v[0] + m[i + 4] * v[1] + m[i + 8] * v[2] + m[i + 12];
}

/* Corner 0 .. 3 of the rectangle around points[2 * segment] and the next, in clip space.  A segment
   that is not drawn gets a point outside; one with bad numbers gets a point that is rejected. */
static shade_vec4 shade__stroke_corner(const shade__stroke *s, uint32_t segment, int corner)
{
    const double half = s->half_line;
    const int k = corner & 1;
    int placed = 1;
    double end[2][4], t[2], p[4], at[2], dir[2], side, along;
    for (int j = 0; j < 2; j++) {
        shade__stroke_end(s, 2 * (size_t)segment + (size_t)j, end[j]);
        for (int i = 0; i < 4; i++) placed &= end[j][i] >= -1e30 && end[j][i] <= 1e30;
    }
    if (!placed) return shade_v4(FLT_MAX, 2, 2, 1);
    if (!shade__stroke_part(s, end, t, dir)) return shade_v4(2, 2, 2, 1);
    shade__stroke_point(s, end, t[k], p, at);
    side = corner & 2 ? half : -half;
    along = s->state->cap != SHADE_CAP_SQUARE ? 0 : k ? half : -half;
    at[0] += dir[0] * along - dir[1] * side;
    at[1] += dir[1] * along + dir[0] * side;
    p[3] = (double)(float)p[3];    /* the w that divides x and y later */
    return shade_v4((float)(at[0] / s->half[0] * p[3]), (float)(at[1] / s->half[1] * p[3]),
                    (float)p[2], (float)p[3]);
}

static void shade__stroke_vertex(const void *uniforms, const shade_vertex_ids *SHADE_RESTRICT in,
                                 shade_vertices *SHADE_RESTRICT out)
{
    static const uint8_t corner[6] = { 0, 1, 3, 0, 3, 2 };
    for (int i = 0; i < SHADE_LANES; i++)
        shade__put4(out->clip[0], SHADE_LANES, i,
                    shade__stroke_corner((const shade__stroke *)uniforms, in->index[i] / 6,
                                         corner[in->index[i] % 6]));
}

static void shade__stroke_color(const void *uniforms, const shade_fragments *SHADE_RESTRICT in,
                                shade_colors *SHADE_RESTRICT out)
{
    shade_vec4 c = ((const shade__stroke *)uniforms)->state->color;
    (void)in;
    SHADE_EACH_LANE(i) { shade__put4(out->color[0], SHADE_LANES, i, c); }
}

SHADE__INLINE const char *shade__stroke_fault(const shade_line_state *state)
{
    shade_raster raster = state->raster;
    if (!shade__within(state->width, FLT_MAX) || state->width < 0)
        return "state.width must be a number of pixels; 0 means 1.";
    if (!SHADE__KNOWN(state->cap, SHADE_CAP_SQUARE))
        return "state.cap is not a SHADE_CAP_... value.";
    raster.cull = SHADE_CULL_NONE;
    return shade__raster_fault(&raster);
}

/* Prepares the uniforms of the line shaders, and their pipeline. */
static void shade__stroke_of(const shade_target *target, const shade_vec3 *points,
                             const shade_line_state *state, shade__stroke *s, shade_pipeline *p)
{
    const shade_mat4 m = shade__or_identity(state->clip_from_points);
    shade__doubles(shade__entries(&m), 16, s->clip_from_points);
    s->points = points;
    s->state = state;
    s->half[0] = target->width / 2.0;
    s->half[1] = target->height / 2.0;
    s->half_line = (double)shade__minf(state->width > 0 ? state->width : 1, SHADE__WIDEST) / 2;
    SHADE__ZERO(*p);
    p->raster = state->raster;
    p->raster.cull = SHADE_CULL_NONE;
    p->vertex = shade__stroke_vertex;
    p->fragment = shade__stroke_color;
    p->uniforms = s;
}

/* Returns why shade_draw_lines refuses a draw, and sets *why to the sentence about it. */
SHADE__INLINE shade_result shade__lines_refusal(const shade_target *t, const shade_vec3 *points,
                                                int point_count, const shade_line_state *state,
                                                const char **why)
{
    *why = NULL;
    if (!t || !state || (!points && point_count > 0))
        *why = !t       ? "target is NULL, and must not be."
               : !state ? "state is NULL, and must not be."
                        : "points is NULL while point_count is not 0.";
    if (*why) return SHADE_ERROR_ARGUMENT;
    *why = shade__target_fault(t);
    if (*why) return SHADE_ERROR_TARGET;
    if (point_count < 0 || point_count % 2 || point_count > INT32_MAX / 3)
        *why = "point_count is negative, odd, or beyond 715827882; it counts points, two a line.";
    if (*why) return SHADE_ERROR_MESH;
    *why = shade__stroke_fault(state);
    return *why ? SHADE_ERROR_STATE : SHADE_OK;
}

SHADEDEF shade_result shade_draw_lines(const shade_target *target, const shade_vec3 *points,
                                       int point_count, const shade_line_state *state,
                                       shade_stats *stats)
{
    const shade__indices in_order = { NULL, NULL };
    shade_pipeline p;
    shade__stroke s;
    shade__supply supply;
    const char *why;
    const shade_result result = shade__lines_refusal(target, points, point_count, state, &why);
    if (stats) SHADE__ZERO(*stats);
    if (result) return result;

    shade__stroke_of(target, points, state, &s, &p);
    shade__supply_all(in_order, 3 * point_count, &supply);
    return shade__run_draw(target, &p, 1, shade_v3(0, 0, 0), &supply, stats);
}

/*----------------------------------------------------------------------------------------- >>camera
   The eye and line of sight of a draw: one camera for rays, fitted views and explanations.
     in      projection, view             out  a shade__camera, in double
     way     camera_of: ray_through
     holds   A camera depends on the product of both matrices alone, not on how it is split between
             them.                                                                      >>normals */

typedef struct shade__camera {
    double row[4][4];    /* of the product, clip from world: rows x, y, z and w */
    double eye[3];       /* the centre of projection, where x, y and w are 0; zero if rays are
                            parallel */
    double sight[3];     /* unit: where w grows fastest, or where parallel rays point; zero if
                            the camera is degenerate */
    int perspective;     /* 0: rays are parallel */
    int reversed;        /* a perspective with greater depth near the eye */
} shade__camera;

static SHADE__NOINLINE shade_vec3 shade__single3(const double *v)
{
    return shade_v3((float)v[0], (float)v[1], (float)v[2]);
}

SHADE__INLINE void shade__cross3(const double *a, const double *b, double *c)
{
    c[0] = a[1] * b[2] - a[2] * b[1];
    c[1] = a[2] * b[0] - a[0] * b[2];
    c[2] = a[0] * b[1] - a[1] * b[0];
}

/* Makes v unit, for any length; zero if it is zero or not finite. */
static void shade__direction3(double *v)
{
    const double sum = shade__abs(v[0]) + shade__abs(v[1]) + shade__abs(v[2]);
    for (int k = 0; k < 3; k++) v[k] = sum > 0 && sum <= DBL_MAX ? v[k] / sum : 0;
    shade__unit3(v);
}

/* The ray through x/w and y/w: the line where the planes of both meet.  In a perspective it starts
   on the plane w = 0 and points to where w grows, else on z = -w and to where z/w grows. */
static void shade__ray_through(const shade__camera *c, double x, double y, double *from,
                               double *direction)
{
    const double *z = c->row[2], *w = c->row[3];
    double a[4], b[4], start[4], ab[3], aw[3], wb[3], p[3], q[3], along, w_there = 1;
    for (int k = 0; k < 4; k++) {
        a[k] = c->row[0][k] - x * w[k];
        b[k] = c->row[1][k] - y * w[k];
        start[k] = c->perspective ? w[k] : z[k] + w[k];
    }
    /* a x b, without the term w x w that only rounding would leave */
    shade__cross3(c->row[0], c->row[1], ab);
    shade__cross3(c->row[0], w, aw);
    shade__cross3(w, c->row[1], wb);
    for (int k = 0; k < 3; k++) direction[k] = ab[k] - y * aw[k] - x * wb[k];
    shade__cross3(b, start, p);
    shade__cross3(start, a, q);
    along = shade__dot3(start, direction);
    for (int k = 0; k < 3; k++) {
        const double sum = a[3] * p[k] + b[3] * q[k] + start[3] * direction[k];
        from[k] = along != 0 ? -sum / along : 0;
    }

    if (!c->perspective) w_there = shade__dot3(w, from) + w[3];
    for (int k = 0; k < 3; k++) {
        if (along == 0) direction[k] = 0;
        if ((along < 0) != (w_there < 0)) direction[k] = -direction[k];
    }
    shade__direction3(direction);
}

/* Parallel rays: w should be constant, but rounded entries make it vary a little.  For near = n and
   far = f the ratio of row w's product to row z's is (f - n) / (f + n); below 2^-16 it counts as
   rounding. */
static void shade__camera_of(const shade_mat4 *projection, const shade_mat4 *view, shade__camera *c)
{
    double p[16], v[16], direction[3];
    shade__doubles(shade__entries(projection), 16, p);
    shade__doubles(shade__entries(view), 16, v);
    for (int k = 0; k < 16; k++) {
        const double *a = p + k % 4, *b = v + k / 4 * 4;
        c->row[k % 4][k / 4] = a[0] * b[0] + a[4] * b[1] + a[8] * b[2] + a[12] * b[3];
    }
    shade__cross3(c->row[0], c->row[1], direction);
    c->perspective = shade__abs(shade__dot3(c->row[3], direction)) >
                     shade__abs(shade__dot3(c->row[2], direction)) * (1 / 65536.0);
    shade__ray_through(c, 0, 0, c->eye, c->sight);
    c->reversed = c->perspective && shade__dot3(c->row[2], c->eye) + c->row[2][3] > 0;
    for (int k = 0; k < 3; k++) {
        if (c->perspective) c->sight[k] = c->row[3][k];
        else c->eye[k] = 0;
    }
    shade__direction3(c->sight);
}

/*---------------------------------------------------------------------------------------- >>normals
   Normals of vertices and corners: sums over the faces around them.
     in      meshes, the caller's memory         out  the caller's normals
     way     mesh_normals: sum_normals: load_faces; find_faces: find_edge, find_wedge,
             find_angle; add_face.
             mesh_corner_normals: sort_corners, triangle_normal, corner_angle
     method  normals of faces, weighted by their angle at the vertex                 [Thurmer98]
                                                                                          >>shape */

#define SHADE__TAN_PI_8 0.4142135623730951    /* of pi/8 */

/* atan(s) for |s| <= tan(pi/8) */
SHADE__INLINE double shade__arc(double s)
{
    double a = 0;
    SHADE__UNROLL_16 for (int k = 25; k > 0; k -= 2) a = 1.0 / k - a * s * s;
    return a * s;
}

/* b where x has its sign set, else a.  SSE2 compares no integers of 64 bits. */
SHADE__INLINE double shade__by_sign(double a, double b, double x)
{
    const uint64_t mask = 0u - (shade__double_bits(x) >> 63), bits = shade__double_bits(a);
    return shade__bits_double(bits ^ ((bits ^ shade__double_bits(b)) & mask));
}

/* atan2(y, x), within 1e-9.  atan q = pi/4 + atan((q - 1) / (q + 1)) keeps the argument of the
   series below tan(pi/8).   pre: y >= 0, both finite, not both 0 */
SHADE__INLINE double shade__lane_angle(double y, double x)
{
    const double quarter = 0.78539816339744830962, ax = shade__abs(x), t = (y - ax) / (y + ax);
    const double low = t + SHADE__TAN_PI_8, high = SHADE__TAN_PI_8 - t;    /* < 0: t is low, high */
    const double over = shade__by_sign(shade__by_sign(y - ax, y, low), -ax, high);
    const double under = shade__by_sign(shade__by_sign(y + ax, ax, low), y, high);
    const double from = shade__by_sign(shade__by_sign(quarter, 0, low), 2 * quarter, high);
    const double a = shade__arc(over / under) + from;
    return shade__by_sign(a, 4 * quarter - a, x);
}

/* The same, or 0 for two zeros and for NaN. */
static double shade__angle(double y, double x)
{
    return shade__abs(x) + y > 0 ? shade__lane_angle(y, x) : 0;
}

/* Returns 1 if six doubles sum to 0 exactly.  x[0] .. x[i - 1] are kept as a sum of parts that do
   not overlap; it is 0 only if each part is.  a + b becomes sum and, exactly, the error of sum.
                                                                                     [Shewchuk97] */
static int shade__sum_is_zero(double x[6])
{
    double rough = 0, size = 0;
    for (int i = 0; i < 6; i++) {
        rough += x[i];
        size += shade__abs(x[i]);
    }
    if (shade__abs(rough) > size * 1e-15) return 0;    /* more than five roundings can cause */
    for (int i = 1; i < 6; i++) {
        for (int k = 0; k < i; k++) {
            const double a = x[i], b = x[k], sum = a + b, rounded = sum - a;
            x[k] = (a - (sum - rounded)) + (b - rounded);
            x[i] = sum;
        }
    }
    for (int i = 0; i < 6; i++)
        if (x[i] != 0) return 0;
    return 1;
}

/* Returns 0 if three points lie exactly on a line.  Products of two floats are exact in double,
   while differences of far and near points may round. */
static int shade__has_area(const shade_vec3 p[3])
{
    double v[4][3];
    for (int k = 0; k < 4; k++) shade__double3(p[k % 3], v[k]);
    for (int i = 0; i < 3; i++) {
        const int j = i < 2 ? i + 1 : 0;
        double x[6];
        for (int k = 0; k < 3; k++) {
            const double *a = v[k], *b = v[k + 1];
            x[2 * k] = a[i] * b[j];
            x[2 * k + 1] = -a[j] * b[i];
        }
        if (!shade__sum_is_zero(x)) return 1;
    }
    return 0;
}

/* The unit normal of triangle t; zero where it has no area or a corner that is not finite. */
static shade_vec3 shade__triangle_normal(const shade_mesh *m, uint32_t t)
{
    shade_vec3 p[3], n = shade__face_normal(m, t, p);
    const int good = shade__within(shade_dot(n, n), 2) && shade__has_area(p);
    return good ? n : shade_v3(0, 0, 0);
}

/* The corner that is steps further around the triangle of a corner. */
static uint32_t shade__corner_after(uint32_t corner, uint32_t steps)
{
    return corner / 3 * 3 + (corner + steps) % 3;
}

/* The angle of a triangle at a corner, in radians. */
static float shade__corner_angle(const shade_mesh *m, uint32_t corner)
{
    const shade_vec3 p = shade__corner(m, corner);
    const shade_vec3 q = shade__corner(m, shade__corner_after(corner, 1));
    const shade_vec3 r = shade__corner(m, shade__corner_after(corner, 2));
    shade_vec3 a = shade__unit_vector(shade_sub(q, p)), b = shade__unit_vector(shade_sub(r, p));
    return (float)shade__angle((double)shade_length(shade_cross(a, b)), (double)shade_dot(a, b));
}

static shade_result shade__check_mesh(const shade_mesh *m)
{
    return shade__mesh_fault(m) ? SHADE_ERROR_MESH : SHADE_OK;
}

/* Checks a mesh, and that out, the other argument, is not NULL. */
static shade_result shade__check_shape(const shade_mesh *m, const void *out)
{
    return m && out ? shade__check_mesh(m) : SHADE_ERROR_ARGUMENT;
}

/* Checks the number of all indices, and the indices of a chunk. */
static shade_result shade__check_range(const shade_mesh *m, const shade_chunk *c)
{
    if (shade__corner_count(m) % 3) return SHADE_ERROR_INDEX;
    return shade__check_indices(shade__indices_of(m), 3 * c->first, 3 * c->count, m->vertex_count);
}

/* Faces in lanes.  Edge k goes from corner k to the next, and wedge k lies between it and the edge
   that comes to the corner.  Rows of vectors are x, y, z. */
typedef struct shade__wedge {
    float normal[3][SHADE__BLOCK];    /* unit */
    float sine[SHADE__BLOCK], cosine[SHADE__BLOCK];
    float angle[SHADE__BLOCK];        /* in radians */
} shade__wedge;

typedef struct shade__faces {
    float corner[3][3][SHADE__BLOCK];
    float edge[3][3][SHADE__BLOCK];    /* unit; zero where the lane is odd */
    shade__wedge wedge[3];
    uint32_t odd[SHADE__BLOCK];        /* all ones: too short, long or slim for these loops */
} shade__faces;

/* The square root, rounded to the nearest float as sqrtf does it.  One step of Newton for 1/sqrt(x)
   and one for the root leave less than 2^-52; no root of a float is nearer than 2^-51 to the middle
   between two floats.   pre: x is normal */
SHADE__INLINE float shade__sqrt_normal(float x)
{
    const double d = (double)x;
    double y = (double)shade__rsqrt_normal(x), root;
    y *= 1.5 - 0.5 * d * y * y;
    root = d * y;
    return (float)(root + 0.5 * y * (d - root * root));
}

/* The length of a vector with this sum of squares.  Outside of least .. 1e38, and for NaN, it is 1,
   and the lane is odd. */
SHADE__INLINE float shade__length_of(float squares, float least, uint32_t *odd)
{
    *odd = shade__mask(squares < least) | shade__mask(!shade__within(squares, 1e38f));
    return shade__sqrt_normal(shade__select(squares, 1, *odd));
}

/* The edge from p to q, by the roundings of shade_normalize. */
SHADE__INLINE void shade__find_edge(float (*SHADE_RESTRICT p)[SHADE__BLOCK],
                                    float (*SHADE_RESTRICT q)[SHADE__BLOCK],
                                    float (*SHADE_RESTRICT edge)[SHADE__BLOCK],
                                    shade__out_bits odd)
{
    SHADE__FOR(i, SHADE__BLOCK) {
        const float x = q[0][i] - p[0][i], y = q[1][i] - p[1][i], z = q[2][i] - p[2][i];
        uint32_t bad;
        const float scale = 1 / shade__length_of(x * x + y * y + z * z, 1e-36f, &bad);
        edge[0][i] = shade__keep(x * scale, ~bad);
        edge[1][i] = shade__keep(y * scale, ~bad);
        edge[2][i] = shade__keep(z * scale, ~bad);
        odd[i] |= bad;
    }
}

/* The wedge at a corner: its normal by the roundings of shade_face_normal, sine and cosine by those
   of shade__corner_angle, up to the signs of zeros. */
SHADE__INLINE void shade__find_wedge(float (*SHADE_RESTRICT to)[SHADE__BLOCK],
                                     float (*SHADE_RESTRICT from)[SHADE__BLOCK], float least,
                                     shade__wedge *SHADE_RESTRICT w, shade__out_bits odd)
{
    SHADE__FOR(i, SHADE__BLOCK) {
        const float x = to[1][i] * from[2][i] - to[2][i] * from[1][i];
        const float y = to[2][i] * from[0][i] - to[0][i] * from[2][i];
        const float z = to[0][i] * from[1][i] - to[1][i] * from[0][i];
        uint32_t bad;
        const float length = shade__length_of(x * x + y * y + z * z, least, &bad);
        const float scale = 1 / length;
        w->normal[0][i] = x * scale;
        w->normal[1][i] = y * scale;
        w->normal[2][i] = z * scale;
        w->sine[i] = length;
        w->cosine[i] = -(to[0][i] * from[0][i] + to[1][i] * from[1][i] + to[2][i] * from[2][i]);
        odd[i] |= bad;
    }
}

SHADE__INLINE void shade__find_angle(shade__wedge *SHADE_RESTRICT w)
{
    SHADE__FOR(i, SHADE__BLOCK) {
        w->angle[i] = (float)shade__lane_angle((double)w->sine[i], (double)w->cosine[i]);
    }
}

/* Finds edges and wedges of faces from their corners.  A face with a sine above 1e-5 at corner 0
   has area, because the roundings of edges turn them by less than 1e-6. */
SHADE__INLINE void shade__find_faces_body(shade__faces *f)
{
    SHADE__FOR(i, SHADE__BLOCK) { f->odd[i] = 0; }
    for (int k = 0; k < 3; k++)
        shade__find_edge(f->corner[k], f->corner[k < 2 ? k + 1 : 0], f->edge[k], f->odd);
    shade__find_wedge(f->edge[2], f->edge[0], 1e-10f, &f->wedge[0], f->odd);
    shade__find_wedge(f->edge[0], f->edge[1], 1e-36f, &f->wedge[1], f->odd);
    shade__find_wedge(f->edge[1], f->edge[2], 1e-36f, &f->wedge[2], f->odd);
    for (int k = 0; k < 3; k++) shade__find_angle(&f->wedge[k]);
}
SHADE__DISPATCH_AVX2(shade__find_faces, (shade__faces *f), (f), shade__find_faces_body(f))

/* Loads n faces from t on.  The other lanes repeat the first. */
static void shade__load_faces(const shade_mesh *m, uint32_t t, int n, shade__faces *f)
{
    for (int i = 0; i < SHADE__BLOCK; i++) {
        const uint32_t first = 3 * (t + (uint32_t)(i < n ? i : 0));
        for (uint32_t k = 0; k < 3; k++) {
            const shade_vec3 p = shade__corner(m, first + k);
            f->corner[k][0][i] = p.x;
            f->corner[k][1][i] = p.y;
            f->corner[k][2][i] = p.z;
        }
    }
}

/* Adds face t, which is lane i, to the sums of its vertices. */
static void shade__add_face(const shade_mesh *m, uint32_t t, const shade__faces *f, int i,
                            shade_vec3 *normals)
{
    const shade__wedge *w = f->wedge;
    shade_vec3 n = shade_v3(w->normal[0][i], w->normal[1][i], w->normal[2][i]);
    if (f->odd[i]) n = shade__triangle_normal(m, t);
    for (uint32_t k = 0; k < 3; k++) {
        const uint32_t corner = 3 * t + k;
        const float angle = f->odd[i] ? shade__corner_angle(m, corner) : w[k].angle[i];
        shade_vec3 *sum = &normals[shade__corner_index(m, corner)];
        *sum = shade_madd(*sum, angle, n);
    }
}

/* Sums the faces around each vertex, weighted by their angles.  Lanes take a third of the time of
   one face after another with SSE2, a fifth with AVX2. */
static void shade__sum_normals(const shade_mesh *m, shade_vec3 *normals)
{
    const int count = shade__corner_count(m) / 3;
    SHADE_ALIGNED shade__faces faces;
    for (int t = 0; t < count; t += SHADE__BLOCK) {
        const int n = shade__min(count - t, SHADE__BLOCK);
        shade__load_faces(m, (uint32_t)t, n, &faces);
        shade__find_faces(&faces);
        for (int i = 0; i < n; i++) shade__add_face(m, (uint32_t)(t + i), &faces, i, normals);
    }
}

SHADEDEF shade_result shade_mesh_normals(const shade_mesh *mesh, shade_vec3 *normals)
{
    shade_result result = shade__check_shape(mesh, normals);
    size_t bytes;
    if (!result) result = shade__check_corners(mesh);
    if (result) return result;
    bytes = (size_t)mesh->vertex_count * sizeof *normals;
    result = shade__check_outs(mesh, shade__array(normals, bytes), shade__array(NULL, 0));
    if (result) return result;

    SHADE_MEMSET(normals, 0, bytes);
    shade__sum_normals(mesh, normals);
    for (ptrdiff_t i = 0; i < mesh->vertex_count; i++) normals[i] = shade_normalize(normals[i]);
    return SHADE_OK;
}

/* Returns 1 if two corners have the same position; NaN equals nothing. */
static int shade__same_position(const shade_mesh *m, uint32_t i, uint32_t j)
{
    return shade__is_zero(shade_sub(shade__corner(m, i), shade__corner(m, j)));
}

/* The edge from a corner to the next corner of its triangle. */
static shade_edge shade__edge_from(const shade_mesh *m, uint32_t corner)
{
    const uint32_t p = shade__corner_index(m, corner);
    const uint32_t q = shade__corner_index(m, shade__corner_after(corner, 1));
    shade_edge e;
    e.a = p < q ? p : q;
    e.b = p < q ? q : p;
    e.triangle[0] = (int32_t)(corner / 3);
    e.triangle[1] = -1;
    return e;
}

/* Byte k of the sort key of a corner: its edge, a before b, or its position, with 0 for -0. */
SHADE__INLINE uint32_t shade__key_byte(const shade_mesh *m, int edges, uint32_t corner, int k)
{
    uint32_t word;
    if (edges) {
        const shade_edge e = shade__edge_from(m, corner);
        word = k < 4 ? e.b : e.a;
    } else {
        const shade_vec3 p = shade__corner(m, corner);
        word = shade__float_bits((k < 4 ? p.x : k < 8 ? p.y : p.z) + 0);
    }
    return word >> 8 * (k & 3) & 255;
}

/* Sorts the corners 0 .. count - 1 byte by byte, which takes the same time for all keys.  Corners
   with equal keys stay in ascending order.  other has room for count more. */
static void shade__sort_corners(const shade_mesh *m, int edges, uint32_t count, uint32_t *order,
                                uint32_t *other)
{
    for (uint32_t i = 0; i < count; i++) order[i] = i;
    for (int k = 0; k < (edges ? 8 : 12); k++) {    /* even: the last step sorts into `order` */
        uint32_t start[257] = { 0 }, *sorted = other;
        for (uint32_t i = 0; i < count; i++) start[shade__key_byte(m, edges, i, k) + 1]++;
        for (int b = 0; b < 256; b++) start[b + 1] += start[b];
        for (uint32_t i = 0; i < count; i++) {
            const uint32_t to = start[shade__key_byte(m, edges, order[i], k)]++;
            sorted[to] = order[i];
        }
        other = order;
        order = sorted;
    }
}

/* The memory that the normals of corners need; 0 if there are more than size_t can count. */
static size_t shade__corner_bytes(size_t corners)
{
    return corners <= SIZE_MAX / 16 ? 16 * corners : 0;
}

SHADEDEF size_t shade_mesh_corner_normals_bytes(const shade_mesh *mesh)
{
    if (!mesh || shade__check_mesh(mesh) || shade__check_corners(mesh)) return 0;
    return shade__corner_bytes((size_t)shade__corner_count(mesh));
}

SHADEDEF shade_result shade_mesh_corner_normals(const shade_mesh *mesh, float cos_crease,
                                                shade_vec3 *normals, void *memory, size_t bytes)
{
    const int corners = mesh ? shade__corner_count(mesh) : 0;
    const int usable = (memory || !corners) && (uintptr_t)memory % 4 == 0;
    shade_result result = shade__check_shape(mesh, usable ? normals : NULL);
    uint32_t *order, count;
    size_t used;
    float *angle;
    shade_vec3 *face;
    if (result) return result;
    count = (uint32_t)corners;
    if (cos_crease != cos_crease) return SHADE_ERROR_STATE;
    result = shade__check_corners(mesh);
    if (result) return result;
    used = shade__corner_bytes(count);
    if (bytes < used || (count && !used)) return SHADE_ERROR_CAPACITY;
    result = shade__check_outs(mesh, shade__array(normals, count * sizeof *normals),
                               shade__array(memory, used));
    if (result || !count) return result;
    order = (uint32_t *)memory;
    angle = (float *)(void *)(order + 2 * (size_t)count);
    face = (shade_vec3 *)(void *)(angle + count);
    for (uint32_t i = 0; i < count; i++) angle[i] = shade__corner_angle(mesh, i);
    for (uint32_t t = 0; t < count / 3; t++) face[t] = shade__triangle_normal(mesh, t);
    shade__sort_corners(mesh, 0, count, order, order + count);
    for (uint32_t first = 0, end = 0; first < count; first = end) {
        do end++;
        while (end < count && shade__same_position(mesh, order[first], order[end]));
        for (uint32_t i = first; i < end; i++) {
            shade_vec3 n = face[order[i] / 3], mean = shade_v3(0, 0, 0);
            for (uint32_t j = first; j < end; j++) {
                shade_vec3 other = face[order[j] / 3];
                if (i == j || shade_dot(n, other) >= cos_crease)
                    mean = shade_madd(mean, angle[order[j]], other);
            }
            normals[order[i]] = shade__unit_vector(mean);
        }
    }
    return SHADE_OK;
}

/*------------------------------------------------------------------------------------------ >>shape
   The shape of a mesh: its edges, its box, and the view that shows the box.
     in      meshes, boxes, a projection         out  the caller's edges; boxes, a view
     way     mesh_edges: sort_corners and edge_from of >>normals.  mesh_bounds: box_chunk.
             box_visible: frustum_of and in_view of >>seen.
             mat4_fit: camera_of, frame_of, step_back
     method  edges by sorting                                                            >>chunks */

/* The caller's array, of 16 bytes a corner, is scratch memory too: the sorted corners lie in its
   last quarter.  The i corners read so far have made at most i edges, which end at byte 16 i.  The
   next corner stands at byte 12 corners + 4 i, which is not before that, because i <= corners. */
SHADEDEF shade_result shade_mesh_edges(const shade_mesh *mesh, shade_edge *edges, int capacity,
                                       int *count)
{
    shade_result result;
    uint32_t *order;
    int corners, kept = 0;
    if (!count) return SHADE_ERROR_ARGUMENT;
    *count = 0;
    result = capacity < 0 ? SHADE_ERROR_ARGUMENT
                          : shade__check_shape(mesh, capacity ? (void *)edges : count);
    if (!result) result = shade__check_corners(mesh);
    if (result) return result;
    corners = shade__corner_count(mesh);
    if (capacity < corners) {
        *count = corners;
        return SHADE_ERROR_CAPACITY;
    }
    result = shade__check_outs(mesh, shade__array(edges, (size_t)corners * sizeof *edges),
                               shade__array(NULL, 0));
    if (result || !corners) return result;
    order = (uint32_t *)(void *)edges + 3 * (size_t)corners;
    shade__sort_corners(mesh, 1, (uint32_t)corners, order, order - corners);
    for (int i = 0; i < corners; i++) {
        shade_edge e = shade__edge_from(mesh, order[i]), *last = kept ? &edges[kept - 1] : NULL;
        int same = last && last->a == e.a && last->b == e.b;
        if (e.a == e.b) continue;    /* of a triangle without area */
        if (same && e.triangle[0] == shade__max(last->triangle[0], last->triangle[1])) continue;
        if (same && last->triangle[1] < 0) last->triangle[1] = e.triangle[0];
        else edges[kept++] = e;
    }
    *count = kept;
    return SHADE_OK;
}

SHADEDEF int shade_is_silhouette(shade_vec3 to_eye, shade_vec3 n0, shade_vec3 n1)
{
    return (double)shade_dot(to_eye, n0) * (double)shade_dot(to_eye, n1) <= 0;
}

SHADEDEF int shade_is_crease(shade_vec3 n0, shade_vec3 n1, float cos_crease)
{
    return shade_dot(n0, n1) <= cos_crease;
}

SHADE__INLINE int shade__finite3(shade_vec3 v)
{
    return shade__within(v.x, FLT_MAX) && shade__within(v.y, FLT_MAX) &&
           shade__within(v.z, FLT_MAX);
}

/* Computes the box around the finite corners of a chunk; low > high if there are none. */
static void shade__box_chunk(const shade_mesh *m, shade_chunk *c)
{
    c->low = shade_v3(FLT_MAX, FLT_MAX, FLT_MAX);
    c->high = shade_neg(c->low);
    for (uint32_t k = 3 * (uint32_t)c->first; k < 3 * (uint32_t)(c->first + c->count); k++) {
        const shade_vec3 p = shade__corner(m, k);
        if (!shade__finite3(p)) continue;
        c->low = shade_min(c->low, p);
        c->high = shade_max(c->high, p);
    }
}

SHADEDEF shade_result shade_mesh_bounds(const shade_mesh *mesh, shade_vec3 *low, shade_vec3 *high)
{
    shade_chunk all;
    shade_result result = shade__check_shape(mesh, low ? high : NULL);
    if (!result) result = shade__check_corners(mesh);
    if (result) return result;
    all.first = 0;
    all.count = shade__corner_count(mesh) / 3;
    shade__box_chunk(mesh, &all);
    *low = all.low.x <= all.high.x ? all.low : shade_v3(1, 1, 1);
    *high = all.low.x <= all.high.x ? all.high : shade_v3(0, 0, 0);
    return SHADE_OK;
}

SHADEDEF int shade_box_visible(const shade_target *target, shade_mat4 clip_from_object,
                               int depth_zero_to_one, shade_vec3 low, shade_vec3 high)
{
    shade__frustum frustum;
    if (!target || shade__check_target(target)) return 1;
    clip_from_object = shade__or_identity(clip_from_object);
    shade__frustum_of(target, &clip_from_object, depth_zero_to_one, &frustum);
    return shade__in_view(&frustum, low, high);
}

/* The camera as a matrix: columns right, up and back, and a point on the line of sight.  It is
   exactly the identity for an eye on the z axis that looks down -z. */
static shade_mat4 shade__frame_of(const shade__camera *c)
{
    const double *sight = c->sight;
    const double up = shade__dot3(c->row[1], sight), ahead = shade__dot3(c->eye, sight);
    double x[3], y[3], at[3];
    for (int k = 0; k < 3; k++) {
        y[k] = c->row[1][k] - up * sight[k];
        at[k] = c->eye[k] - ahead * sight[k];
    }
    shade__direction3(y);
    shade__cross3(sight, y, x);
    return shade__m4(shade__xyzw(shade__single3(x), 0), shade__xyzw(shade__single3(y), 0),
                     shade__xyzw(shade_neg(shade__single3(sight)), 0),
                     shade__xyzw(shade__single3(at), 1));
}

/* Returns how far an eye in the middle of a box must step back along z: until all eight corners lie
   inside the four side planes; for each plane only its worst corner is tested. */
static double shade__step_back(const shade_mat4 *projection, const double *view, shade_vec3 low,
                               shade_vec3 high)
{
    const float corner[2][4] = { { low.x, low.y, low.z, 1 }, { high.x, high.y, high.z, 1 } };
    double step = -DBL_MAX;
    for (int side = 0; side < 4; side++) {
        const float *row = shade__entries(projection) + side / 2;
        const double sign = side & 1 ? -1 : 1;
        double plane[4], least = 0;
        for (int k = 0; k < 4; k++)
            plane[k] = (double)projection->col[k].w + sign * (double)row[4 * k];
        for (int k = 0; k < 4; k++) {
            double n = 0;
            for (int i = 0; i < 4; i++) n += plane[i] * view[4 * k + i];
            least += n * (double)corner[n < 0][k];
        }
        if (plane[2] < 0 && least / plane[2] > step) step = least / plane[2];
    }
    return step;
}

/* The distance grows by a factor 1 + 6e-8 to absorb rounding to float. */
SHADEDEF shade_mat4 shade_mat4_fit(shade_mat4 projection, shade_vec3 low, shade_vec3 high,
                                   shade_vec3 toward_eye, shade_vec3 up)
{
    const shade_vec3 half = shade_scale(shade_sub(high, low), 0.5f);
    const int is_box = low.x <= high.x && low.y <= high.y && low.z <= high.z;
    shade__camera camera;
    shade_mat4 view = shade_mat4_look_at(toward_eye, shade_v3(0, 0, 0), up);
    double v[16], step = 2 * (double)shade_length(half);
    shade_mat4 frame = shade_mat4_identity();
    shade__camera_of(&projection, &frame, &camera);
    if (camera.perspective) {
        frame = shade__frame_of(&camera);
        projection = shade__mat4_product(&projection, &frame);
    }
    view.col[3] = shade__xyzw(
        shade_neg(shade_mat4_transform_direction(view, shade_add(low, half))), 1);
    shade__doubles(shade__entries(&view), 16, v);
    if (camera.perspective) step = shade__step_back(&projection, v, low, high);
    v[14] -= step;
    view.col[3].z = (float)(v[14] - shade__abs(v[14]) * 6e-8);
    view = shade__mat4_product(&frame, &view);
    if (!is_box || !shade__finite3(toward_eye) || !shade__finite3(up) || !shade__is_finite(&view))
        return shade_mat4_identity();
    return view;
}

/*----------------------------------------------------------------------------------------- >>chunks
   Sorts the triangles of a mesh in space and cuts them into chunks with boxes.
     in      meshes                              out  the caller's chunks and indices
     way     mesh_chunks: sort_triangles: split: longest_axis, partition; then box_chunk
     method  The list is split across its longest axis, at the border of a chunk nearest to the
             middle, and the two parts are split again.
     holds   The order depends only on the mesh and the size of chunks: it is the same on every
             machine.                                                                      >>rays */

/* The default size of chunks.  Of 64, 128, 256 and 512 triangles it is the fastest on 16 bands, and
   within 1 % of the fastest on one thread. */
enum { SHADE__CHUNK = 128 };

/* An integer key in the order of floats; NaN lies beyond the infinities. */
static uint32_t shade__value_key(float value)
{
    const uint32_t bits = shade__float_bits(value);
    return bits >> 31 ? ~bits : bits | 0x80000000u;
}

static float shade__key_value(uint32_t key)
{
    return shade__bits_float(key >> 31 ? key & 0x7FFFFFFFu : ~key);
}

/* The key of a triangle along an axis: the sum of its corners, as an ordinal. */
static uint32_t shade__centroid_key(const shade_mesh *m, const uint32_t *triangle, int axis)
{
    float sum = 0;
    for (int k = 0; k < 3; k++) {
        const shade_vec3 p = shade__vec3_at(m->positions, m->position_stride, triangle[k]);
        sum += axis == 0 ? p.x : axis == 1 ? p.y : p.z;
    }
    return shade__value_key(sum);
}

/* The indices of triangle i of a list. */
static uint32_t *shade__three(uint32_t *list, int i) { return list + 3 * (size_t)i; }

/* The axis along which triangles lie furthest apart, with the least and greatest key there. */
static int shade__longest_axis(const shade_mesh *m, uint32_t *triangles, int count, uint32_t *low,
                               uint32_t *high)
{
    uint32_t least[3] = { UINT32_MAX, UINT32_MAX, UINT32_MAX }, most[3] = { 0, 0, 0 };
    int longest = 0;
    for (int i = 0; i < count; i++) {
        for (int axis = 0; axis < 3; axis++) {
            const uint32_t key = shade__centroid_key(m, shade__three(triangles, i), axis);
            if (key < least[axis]) least[axis] = key;
            if (key > most[axis]) most[axis] = key;
        }
    }
    for (int axis = 1; axis < 3; axis++)
        if (shade__key_value(most[axis]) - shade__key_value(least[axis]) >
            shade__key_value(most[longest]) - shade__key_value(least[longest]))
            longest = axis;
    *low = least[longest];
    *high = most[longest];
    return longest;
}

/* Moves the triangles with a key of at most pivot to the front; returns their number. */
static int shade__partition(const shade_mesh *m, uint32_t *triangles, int count, int axis,
                            uint32_t pivot)
{
    int front = 0;
    for (int i = 0; i < count; i++) {
        uint32_t *a = shade__three(triangles, front), *b = shade__three(triangles, i);
        if (shade__centroid_key(m, b, axis) > pivot) continue;
        for (int k = 0; k < 3; k++) {
            const uint32_t other = a[k];
            a[k] = b[k];
            b[k] = other;
        }
        front++;
    }
    return front;
}

/* Moves the first half of the triangles along the longest axis to the front.  The first 8 steps
   take the middle of the range of values as pivot, which is 1.25 times as fast; the others take the
   middle of the range of keys, so that there are never more than 40 steps. */
static void shade__split(const shade_mesh *m, uint32_t *triangles, int count, int half)
{
    uint32_t low, high;
    const int axis = shade__longest_axis(m, triangles, count, &low, &high);
    for (int step = 0; low < high; step++) {
        const double middle = ((double)shade__key_value(low) + (double)shade__key_value(high)) / 2;
        uint32_t pivot = low + (high - low) / 2;
        if (step < 8 && middle >= -3e38 && middle <= 3e38) {
            pivot = shade__value_key((float)middle);
            pivot = pivot < low ? low : pivot >= high ? high - 1 : pivot;
        }
        const int front = shade__partition(m, triangles, count, axis, pivot);
        if (front == half) return;
        if (front > half) {
            count = front;
            high = pivot;
        } else {
            triangles = shade__three(triangles, front);
            count -= front;
            half -= front;
            low = pivot + 1;
        }
    }
}

/* Sorts triangles in space.  Lists are halved at the border of a chunk until a chunk is left. */
static void shade__sort_triangles(const shade_mesh *m, uint32_t *triangles, int count, int chunk)
{
    while (count > chunk) {
        const int half = ((count - 1) / chunk + 1) / 2 * chunk;
        shade__split(m, triangles, count, half);
        shade__sort_triangles(m, triangles, half, chunk);
        triangles = shade__three(triangles, half);
        count -= half;
    }
}

static int shade__chunk_size(int triangles) { return triangles ? triangles : SHADE__CHUNK; }

SHADEDEF int shade_chunk_count(int index_count, int triangles)
{
    if (index_count <= 0 || index_count % 3 || triangles < 0) return 0;
    return (index_count / 3 - 1) / shade__chunk_size(triangles) + 1;
}

SHADEDEF shade_result shade_mesh_chunks(const shade_mesh *mesh, int triangles, shade_chunk *chunks,
                                        int capacity, uint32_t *indices)
{
    shade_mesh listed;
    shade_result result;
    const int size = shade__chunk_size(triangles);
    int corners, count;
    if (!mesh || triangles < 0 || capacity < 0 || (!chunks && capacity))
        return SHADE_ERROR_ARGUMENT;
    listed = *mesh;
    listed.chunks = NULL;
    listed.chunk_count = 0;
    result = shade__check_mesh(&listed);
    if (!result) result = shade__check_corners(&listed);
    if (result) return result;
    corners = shade__corner_count(&listed);
    count = shade_chunk_count(corners, triangles);
    if (capacity < count) return SHADE_ERROR_CAPACITY;
    result = shade__check_outs(&listed, shade__array(chunks, (size_t)count * sizeof *chunks),
                               shade__array(indices, (size_t)corners * sizeof *indices));
    if (result) return result;
    if (indices && corners) {
        for (int i = 0; i < corners; i++) indices[i] = shade__corner_index(&listed, (uint32_t)i);
        shade__sort_triangles(&listed, indices, corners / 3, size);
        listed.indices = indices;
        listed.indices16 = NULL;
        listed.index_count = corners;
    }
    for (int i = 0; i < count; i++) {
        chunks[i].first = i * size;
        chunks[i].count = shade__min(size, corners / 3 - i * size);
        shade__box_chunk(&listed, &chunks[i]);
    }
    return SHADE_OK;
}

/*------------------------------------------------------------------------------------------- >>rays
   Rays through pixels, and the triangles of meshes that they meet.
     in      rays in world space, meshes         out  the nearest triangle
     way     pick: object_ray_of, meets_box; pick_triangle: meets_box, shade_intersect
     method  Cramer's rule in double [Moller97]; boxes are tested by slabs
     holds   A ray that meets a triangle meets the box of each chunk that contains it.    >>image */

/* c = a - b */
SHADE__INLINE void shade__sub3(shade_vec3 a, shade_vec3 b, double *c)
{
    double from[3];
    shade__double3(a, c);
    shade__double3(b, from);
    for (int k = 0; k < 3; k++) c[k] -= from[k];
}

/* Is w the same for all x and y? */
static int shade__w_by_z(const shade_mat4 *m) { return m->col[0].w == 0 && m->col[1].w == 0; }

static int shade__is_affine(const shade_mat4 *m)
{
    return shade__w_by_z(m) && m->col[2].w == 0 && m->col[3].w == 1;
}

SHADEDEF shade_ray shade_pixel_ray(shade_mat4 view, shade_mat4 projection, int width, int height,
                                   float x, float y)
{
    shade__camera c;
    shade_ray ray;
    double from[3], direction[3];
    shade__camera_of(&projection, &view, &c);
    shade__ray_through(&c, 2 * (double)x / shade__max(width, 1) - 1,
                       1 - 2 * (double)y / shade__max(height, 1), from, direction);
    ray.origin = shade__single3(c.perspective ? c.eye : from);
    ray.direction = shade__single3(direction);
    if (!shade__finite3(ray.origin) || !shade__finite3(ray.direction)) SHADE__ZERO(ray);
    return ray;
}

/* With s = origin - a, q = d x s and det = d.n, Cramer's rule gives t = -s.n / det, u = f.q / det
   and v = -e.q / det. */
SHADEDEF int shade_intersect(shade_ray ray, shade_vec3 a, shade_vec3 b, shade_vec3 c, float *t,
                             shade_vec3 *barycentric)
{
    const shade_vec3 p[3] = { a, b, c };
    double d[3], e[3], f[3], s[3], n[3], q[3], det, u, v, at;
    shade__sub3(b, a, e);
    shade__sub3(c, a, f);
    shade__cross3(e, f, n);
    shade__double3(ray.direction, d);
    shade__sub3(ray.origin, a, s);
    shade__cross3(d, s, q);
    det = shade__dot3(d, n);
    if (det == 0) return 0;    /* programs may trap divisions by zero */
    u = shade__dot3(f, q) / det;
    v = -shade__dot3(e, q) / det;
    at = -shade__dot3(s, n) / det;
    if (!(u >= 0 && v >= 0 && u + v <= 1 && at >= 0 && at <= 3e38)) return 0;
    if (!shade__has_area(p)) return 0;
    if (t) *t = (float)at;
    if (barycentric) *barycentric = shade_v3((float)(1 - (u + v)), (float)u, (float)v);
    return 1;
}

/* A ray in object space, for tests of boxes.  Its coordinates are multiplied by the determinant of
   the model matrix, which saves a division: coordinate i is the dot product with the cross product
   of the two other columns.  World positions are rounded sums of products: slack times the sum of
   the products' sizes bounds their error. */
typedef struct shade__object_ray {
    double origin[3], direction[3];
    double scale;                     /* the determinant */
    double slack[3];                  /* the product of the other columns' sizes times 2^-20 */
    double size[3];                   /* of the columns: the sum of |x|, |y| and |z| */
    double reach;                     /* the size of the translation and of the ray's origin */
    int affine;                       /* 0: the matrix divides by w, and no box is tested */
} shade__object_ray;

static void shade__object_ray_of(const shade_mat4 *m, shade_ray ray, shade__object_ray *s)
{
    double column[4][3], normal[3], origin[3], direction[3];
    s->affine = shade__is_affine(m);
    for (int k = 0; k < 4; k++) shade__double3(shade__xyz(m->col[k]), column[k]);
    shade__double3(ray.direction, direction);
    shade__sub3(ray.origin, shade__xyz(m->col[3]), origin);
    s->reach = (double)FLT_MIN;    /* world positions and t may be denormal */
    for (int k = 0; k < 3; k++) {
        s->size[k] = shade__abs(column[k][0]) + shade__abs(column[k][1]) +
                     shade__abs(column[k][2]);
        s->reach += shade__abs(origin[k]) + 2 * shade__abs(column[3][k]);
    }
    for (int k = 0; k < 3; k++) {
        const int a = k < 2 ? k + 1 : 0, b = k > 0 ? k - 1 : 2;
        shade__cross3(column[a], column[b], normal);
        s->origin[k] = shade__dot3(origin, normal);
        s->direction[k] = shade__dot3(direction, normal);
        s->slack[k] = s->size[a] * s->size[b] * (1 / 1048576.0);
    }
    s->scale = shade__dot3(column[2], normal);
}

/* Finds the range[0] .. range[1] of t, at most limit, in which the ray may be inside a box;
   rounding is allowed for.  Returns 0 if it misses the box there.  A larger box never has a smaller
   range: a ray that meets the box of a triangle meets the box of its chunk. */
static int shade__meets_box(const shade__object_ray *s, shade_vec3 low, shade_vec3 high,
                            float limit, double *range)
{
    double from[3], to[3], size = s->reach;
    range[0] = 0;
    range[1] = (double)limit;
    if (!s->affine || !(low.x <= high.x && low.y <= high.y && low.z <= high.z)) return 1;
    shade__double3(low, from);
    shade__double3(high, to);
    for (int k = 0; k < 3; k++) {
        const double a = shade__abs(from[k]), b = shade__abs(to[k]);
        size += s->size[k] * (a > b ? a : b);
    }
    for (int k = 0; k < 3; k++) {
        const double a = from[k] * s->scale, b = to[k] * s->scale, slack = s->slack[k] * size;
        const double low_end = (a < b ? a : b) - slack - s->origin[k];
        const double high_end = (a < b ? b : a) + slack - s->origin[k], d = s->direction[k];
        if (d == 0) {
            if (low_end > 0 || high_end < 0) return 0;
            continue;
        }
        const double enter = (d > 0 ? low_end : high_end) / d;
        const double leave = (d > 0 ? high_end : low_end) / d;
        if (enter > range[0]) range[0] = enter;
        if (leave < range[1]) range[1] = leave;
    }
    return !(range[0] > range[1]);
}

/* The nearest triangle so far. */
typedef struct shade__hit { int triangle; float t; shade_vec3 barycentric; } shade__hit;

/* A hit counts only if its point lies in the triangle's own box; then it lies in the box of every
   chunk that has the triangle.  So if a ray is nearly in the plane of a triangle, where rounding
   decides, the answer is the same with chunks and without. */
static void shade__pick_triangle(const shade_mesh *mesh, const shade_mat4 *model, shade_ray ray,
                                 const shade__object_ray *local, int triangle, shade__hit *hit)
{
    shade_vec3 p[3], q[3], where;
    double range[2];
    float t;
    for (uint32_t k = 0; k < 3; k++) q[k] = shade__corner(mesh, 3 * (uint32_t)triangle + k);
    if (!shade__meets_box(local, shade_min(q[0], shade_min(q[1], q[2])),
                          shade_max(q[0], shade_max(q[1], q[2])), hit->t, range))
        return;
    for (uint32_t k = 0; k < 3; k++) p[k] = shade_mat4_transform_point(*model, q[k]);
    if (!shade_intersect(ray, p[0], p[1], p[2], &t, &where)) return;
    if ((double)t < range[0] || (double)t > range[1]) return;
    if (t == hit->t && triangle > hit->triangle) return;    /* t <= hit->t, as range ends there */
    /* model may round three points on a line to a triangle with area */
    if (!shade__has_area(q)) return;
    hit->triangle = triangle;
    hit->t = t;
    hit->barycentric = where;
}

SHADEDEF int shade_pick(const shade_mesh *mesh, shade_mat4 model, shade_ray ray, float *t,
                        shade_vec3 *barycentric)
{
    shade__object_ray local;
    shade__hit hit;
    shade_chunk all;
    const shade_chunk *chunk = &all;
    int chunks = 1;
    SHADE__ZERO(all);
    if (!mesh || shade__check_mesh(mesh)) return -1;
    all.low.x = 1;    /* low > high: it is never skipped */
    all.count = shade__corner_count(mesh) / 3;
    if (mesh->chunks) {
        chunk = mesh->chunks;
        chunks = mesh->chunk_count;
    }
    model = shade__or_identity(model);
    shade__object_ray_of(&model, ray, &local);
    hit.triangle = -1;
    hit.t = FLT_MAX;    /* beyond every hit */
    for (; chunks > 0; chunks--, chunk++) {
        double range[2];
        if (!shade__meets_box(&local, chunk->low, chunk->high, hit.t, range)) continue;
        if (shade__check_range(mesh, chunk)) return -1;
        for (int i = 0; i < chunk->count; i++)
            shade__pick_triangle(mesh, &model, ray, &local, chunk->first + i, &hit);
    }
    if (hit.triangle >= 0 && t) *t = hit.t;
    if (hit.triangle >= 0 && barycentric) *barycentric = hit.barycentric;
    return hit.triangle;
}

/*------------------------------------------------------------------------------------------ >>image
   Makes pictures from pictures: smaller ones, and mipmaps.
     in      a picture of any format             out  means in linear light
     way     resolve and build_mipmaps: open_decoder; convert: reduce: means, halve or shrink;
             store_run of >>store
     method  A channel has few values: each is decoded once a call.                       >>files */

SHADE__INLINE uint8_t *shade__pixel_at(const shade_target *t, int x, int y)
{
    return (uint8_t *)t->color + shade__offset_of(t, x, y) * shade__pixel_bytes(t->format);
}

/* Checks a target that must have colours. */
static shade_result shade__check_picture(const shade_target *t)
{
    if (!t) return SHADE_ERROR_ARGUMENT;
    return t->color ? shade__check_target(t) : SHADE_ERROR_TARGET;
}

/* Along one axis, texel i of a mipmap covers a share of each of pixels 2 i, 2 i + 1 and, if the
   size is odd, 2 i + 2 of the level above.  For example, 5 pixels become 2 texels, 2.5 pixels each:
   texel 0 has the shares 1, 1, 0.5 and texel 1 has 0.5, 1, 1. */
typedef struct shade__shares { int pixels; double share[3]; } shade__shares;

/* Tables to make a level of mipmaps. */
enum { SHADE__DOUBLES = SHADE_LANES < 64 ? 1 : 512 };    /* 1: no table, to save stack */
typedef struct shade__halving {
    double light[SHADE__DOUBLES];       /* the values of the decoder: 1.1 to 1.3 times as fast */
    shade__shares column[SHADE_LANES];  /* of the texels of a packet */
} shade__halving;

/* The linear light of packed pixels: table[k] is indexed by the value of channel k. */
typedef struct shade__decoder {
    const shade_target *from;
    int factor;                 /* of each side; for mipmaps 2, about */
    shade__halving *halving;    /* NULL: no mipmaps are made */
    shade__layout layout;
    const float *table[4];
    float value[512];    /* of colours, of alpha, then 0; channels of equal size share values */
} shade__decoder;

static void shade__open_decoder(const shade_target *t, int factor, shade__decoder *d)
{
    const shade__layout l = shade__layouts[t->format];
    const int encoded = shade__is_encoded(t->srgb, &l);
    float *at = d->value;
    SHADE__ZERO(*d);
    d->layout = l;
    d->from = t;
    d->factor = factor;
    for (int k = 0; k < 4; k++) {
        d->table[k] = at;
        if ((k == 1 || k == 2) && l.full[k] == l.full[0]) {
            d->table[k] = d->table[0];
            continue;
        }
        for (int v = 0; v <= l.full[k]; v++) {
            const float c = (float)v / (float)l.full[k];
            *at++ = encoded && k < 3 ? shade__decode(c) : c;
        }
    }
}

/* The linear light of channel k of a pixel of `bytes` bytes.  Loops pass 4 and 16 as constants, and
   a copy of the layout, which no store can change: means are 2.5 times as fast. */
SHADE__INLINE float shade__light_of(const shade__decoder *d, const shade__layout *l,
                                    const uint8_t *p, int k, const int bytes)
{
    float c;
    if (bytes == 16) {
        SHADE_MEMCPY(&c, p + 4 * k, 4);
        return c;
    }
    if (bytes == 4) return d->table[k][p[l->shift[k] / 8]];
    return d->table[k][shade__load_packed(p, bytes, l->swapped) >> l->shift[k] & l->full[k]];
}

/* The bytes from row to row of the picture that is read. */
static size_t shade__pitch(const shade__decoder *d)
{
    return (size_t)shade__stride_of(d->from) * d->layout.bytes;
}

/* The means of factor x factor pixels, for n pixels of a smaller picture. */
SHADE__INLINE void shade__means(const shade__decoder *d, const uint8_t *p, const int factor, int n,
                                const int bytes, float *mean)
{
    const shade__layout l = d->layout;
    const size_t pitch = shade__pitch(d);
    const float count = (float)(factor * factor);
    for (int i = 0; i < n; i++, p += factor * bytes) {
        const uint8_t *at = p;
        float sum[4] = { 0, 0, 0, 0 };
        for (int j = 0; j < factor; j++, at += pitch)
            for (int s = 0; s < factor; s++)
                SHADE__FOR_4(k) sum[k] += shade__light_of(d, &l, at + s * bytes, k, bytes);
        SHADE__FOR_4(k) mean[k * SHADE_LANES + i] = sum[k] / count;
    }
}

/* The light of channel k of the pixel of 4 bytes at p, for sums in double. */
SHADE__INLINE double shade__light_4(const shade__decoder *d, const shade__layout *l,
                                    const uint8_t *p, int k)
{
    if (SHADE__DOUBLES == 1) return (double)shade__light_of(d, l, p, k, 4);
    return d->halving->light[(k == 3 ? 256 : 0) + p[l->shift[k] / 8]];
}

static shade__shares shade__shares_of(int size, int smaller, int i)
{
    const double scale = (double)size / smaller, from = i * scale, to = (i + 1) * scale;
    shade__shares c = { size == smaller ? 1 : 2 + size % 2, { 0, 0, 0 } };
    for (int k = 0; k < c.pixels; k++) {
        const int first = 2 * i + k;
        c.share[k] = (first + 1 < to ? first + 1 : to) - (first > from ? first : from);
    }
    return c;
}

/* The means of 2 x 2 pixels of 4 bytes.  Their sums are exact in double. */
SHADE__INLINE void shade__halve(const shade__decoder *d, const uint8_t *p, int n, float *mean)
{
    const shade__layout l = d->layout;
    const size_t pitch = shade__pitch(d);
    for (int k = 0; k < 4; k++)
        for (int i = 0; i < n; i++) {
            const uint8_t *a = p + 8 * i, *b = a + pitch;
            double sum = shade__light_4(d, &l, a, k) + shade__light_4(d, &l, a + 4, k);
            sum += shade__light_4(d, &l, b, k) + shade__light_4(d, &l, b + 4, k);
            mean[k * SHADE_LANES + i] = (float)(sum * 0.25);
        }
}

/* The same for any format and size. */
SHADE__INLINE void shade__shrink(const shade__decoder *d, const shade__shares *rows,
                                 const uint8_t *p, int n, const int bytes, float *mean)
{
    const shade__layout l = d->layout;
    const size_t pitch = shade__pitch(d);
    const shade__shares *column = d->halving->column;
    const int columns = column->pixels, lines = rows->pixels;
    for (int i = 0; i < n; i++, p += 2 * bytes) {
        const shade__shares *c = &column[i];
        const uint8_t *at = p;
        double sum[4] = { 0, 0, 0, 0 }, all = 0;
        for (int j = 0; j < lines; j++, at += pitch)
            for (int s = 0; s < columns; s++) {
                const double share = c->share[s] * rows->share[j];
                const uint8_t *q = at + s * bytes;
                SHADE__FOR_4(k) {
                    const double light = bytes == 4 ? shade__light_4(d, &l, q, k)
                                                    : (double)shade__light_of(d, &l, q, k, bytes);
                    sum[k] += light * share;
                }
                all += share;
            }
        SHADE__FOR_4(k) mean[k * SHADE_LANES + i] = (float)(sum[k] / all);
    }
}

/* The light of pixels x .. x + n - 1 of row y of a smaller picture: means of factor x factor
   pixels, or of the pixels that the texels of a mipmap cover. */
static void shade__reduce(const shade__decoder *d, const shade_target *to, int x, int y, int n,
                          float *mean)
{
    const shade_target *from = d->from;
    const int bytes = d->layout.bytes, factor = d->factor;
    const uint8_t *p = shade__pixel_at(from, x * factor, y * factor);
    if (d->halving) {
        const shade__shares rows = shade__shares_of(from->height, to->height, y);
        const int even = rows.pixels == 2 && d->halving->column[0].pixels == 2;
        if (bytes == 4 && even) shade__halve(d, p, n, mean);
        else if (bytes == 4) shade__shrink(d, &rows, p, n, 4, mean);
        else shade__shrink(d, &rows, p, n, bytes, mean);
    } else if (bytes == 4 && factor == 2) shade__means(d, p, 2, n, 4, mean);
    else if (bytes == 4) shade__means(d, p, factor, n, 4, mean);
    else if (bytes == 16) shade__means(d, p, factor, n, 16, mean);
    else shade__means(d, p, factor, n, bytes, mean);
}

/* Makes the clip rectangle of a picture from the decoder's picture. */
static void shade__convert(const shade__decoder *d, const shade_target *to)
{
    shade__halving *h = d->halving;
    float rgba[4 * SHADE_LANES] = { 0 };
    int clip[4];
    shade__clip_rectangle(to, clip);
    for (int x = clip[0]; x < clip[2]; x += SHADE_LANES) {
        const int n = shade__min(SHADE_LANES, clip[2] - x);
        if (h)
            for (int i = 0; i < n; i++)
                h->column[i] = shade__shares_of(d->from->width, to->width, x + i);
        for (int y = clip[1]; y < clip[3]; y++) {
            shade__reduce(d, to, x, y, n, rgba);
            shade__store_run(to, rgba, x, y, n, shade__pixel_at(to, x, y));
        }
    }
}

/* The pixels of a picture from x, y on, in rows of width pixels. */
static shade__strided shade__pixel_rows(const shade_target *t, int x, int y, int width, int rows)
{
    const size_t bytes = shade__pixel_bytes(t->format);
    const shade__strided p = { shade__pixel_at(t, x, y), (size_t)rows, (size_t)width * bytes,
                               (size_t)shade__stride_of(t) * bytes };
    return p;
}

/* Would shade_resolve overwrite pixels that it has yet to read?  In place it reads each just before
   it writes it. */
static int shade__resolves_into_itself(const shade_target *out, const shade_target *in, int factor)
{
    int clip[4], width, rows;
    const int in_place = factor == 1 && out->color == in->color &&
                         shade__stride_of(out) == shade__stride_of(in) &&
                         shade__pixel_bytes(out->format) == shade__pixel_bytes(in->format);
    if (in_place || !shade__clip_rectangle(out, clip)) return 0;
    width = clip[2] - clip[0];
    rows = clip[3] - clip[1];
    return shade__overlap(shade__pixel_rows(out, clip[0], clip[1], width, rows),
                          shade__pixel_rows(in, clip[0] * factor, clip[1] * factor, width * factor,
                                            rows * factor));
}

SHADEDEF shade_result shade_resolve(const shade_target *out, const shade_target *in, int factor)
{
    shade_result result;
    shade__decoder decoder;
    if (!out || !in) return SHADE_ERROR_ARGUMENT;
    result = shade__check_picture(out);
    if (!result) result = shade__check_picture(in);
    if (result) return result;
    if (factor < 1 || factor > 8 || in->width != out->width * factor ||
        in->height != out->height * factor || in->row_offset != out->row_offset * factor ||
        shade__rows_held(in) != shade__rows_held(out) * factor ||
        shade__resolves_into_itself(out, in, factor))
        return SHADE_ERROR_ARGUMENT;

    shade__open_decoder(in, factor, &decoder);
    shade__convert(&decoder, out);
    return SHADE_OK;
}

SHADEDEF int shade_mipmap_count(int width, int height)
{
    int n = 0;
    if (width < 1 || height < 1 || shade__max(width, height) > SHADE__SIDE_MAX) return 0;
    for (int size = shade__max(width, height); size > 1; size /= 2) n++;
    return n;
}

SHADEDEF size_t shade_mipmap_bytes(int width, int height, shade_format format)
{
    size_t bytes = 0;
    if (!shade__is_format(format)) return 0;
    for (int k = shade_mipmap_count(width, height); k > 0; k--) {
        width = shade__max(width / 2, 1);
        height = shade__max(height / 2, 1);
        bytes += (size_t)width * (size_t)height * shade__pixel_bytes(format);
    }
    return bytes;
}

/* The full size of a texture, as a target that is read. */
static shade_target shade__picture_of(const shade_texture *t)
{
    shade_target p;
    SHADE__ZERO(p);
    p.width = t->width;
    p.height = t->height;
    p.stride = t->stride;
    p.format = t->format;
    p.srgb = t->srgb;
    p.color = (void *)(uintptr_t)t->pixels;
    return p;
}

/* A level of a texture, which has no levels itself. */
static shade_texture shade__level_of(const shade_texture *t, const shade_target *picture)
{
    shade_texture level = *t;
    level.pixels = picture->color;
    level.width = picture->width;
    level.height = picture->height;
    level.stride = 0;
    level.mipmaps = NULL;
    level.mipmap_count = 0;
    return level;
}

SHADEDEF shade_result shade_build_mipmaps(shade_texture *texture, shade_texture *levels,
                                          void *memory, size_t bytes)
{
    shade_target from, to;
    shade__decoder decoder;
    shade__halving halving;
    shade__strided array[4];
    size_t used;
    const int count = texture ? shade_mipmap_count(texture->width, texture->height) : 0;
    if (!texture || (count && (!levels || !memory || (uintptr_t)memory % 4)))
        return SHADE_ERROR_ARGUMENT;
    if (!shade__texture_good(texture)) return SHADE_ERROR_TEXTURE;
    used = shade_mipmap_bytes(texture->width, texture->height, texture->format);
    if (bytes < used) return SHADE_ERROR_CAPACITY;
    from = shade__picture_of(texture);
    array[0] = shade__array(memory, used);
    array[1] = shade__array(levels, (size_t)count * sizeof *levels);
    array[2] = shade__array(texture, sizeof *texture);
    array[3] = shade__pixel_rows(&from, 0, 0, from.width, from.height);
    if (shade__any_overlap(array, 3, 4)) return SHADE_ERROR_ARGUMENT;
    shade__open_decoder(&from, 2, &decoder);
    decoder.halving = &halving;
    for (int v = 0; v < SHADE__DOUBLES; v++) halving.light[v] = (double)decoder.value[v];
    for (int n = 0; n < count; n++, from = to) {
        to = from;
        to.width = shade__max(from.width / 2, 1);
        to.height = shade__max(from.height / 2, 1);
        to.stride = 0;
        to.color = memory;
        shade__convert(&decoder, &to);
        memory = shade__pixel_at(&to, 0, to.height);
        levels[n] = shade__level_of(texture, &to);
    }
    texture->mipmaps = levels;
    texture->mipmap_count = count;
    return SHADE_OK;
}

/*------------------------------------------------------------------------------------------ >>files
   Pictures as files: PPM and PNG.
     in      a picture of any format             out  the bytes of a file, for a sink
     way     encode_ppm: rgb_run.  encode_png: png_head, png_pixels: png_row, to try filters and to
             pack: rgb_run, filtered, take_byte: end_run: put_symbol, put_bits: put_byte: put_chunk
     holds   The bytes of a file depend on the pixels alone, not on SHADE_LANES or the processor.
     method  PNG: each row takes the filter that makes it shortest.  Its bytes are packed by the
             fixed codes of deflate; those that repeat the bytes one or three before them are a run.
                                                                 [ISO15948] [Deutsch96] >>presets */

enum {
    SHADE__FILE_RUN = 64,      /* pixels that are converted at a time */
    SHADE__PNG_DATA = 2816,    /* bytes of data in a chunk; the 12 around them are 0.5 % */
    SHADE__PNG_REPEAT = 257    /* the longest run; 258 would have a symbol by a rule of its own */
};

/* Channel k of a pixel as a byte.  Stored sRGB passes unchanged; only floats are encoded. */
static uint8_t shade__byte_of(const shade_target *t, const shade__layout *l, const uint8_t *p,
                              int k)
{
    float c;
    int32_t bits;
    if (l->bytes == 16) SHADE_MEMCPY(&c, p + 4 * k, 4);
    else c = shade__channel(shade__load_packed(p, l->bytes, l->swapped), l, k) / (float)l->full[k];
    if (l->bytes < 16 || !t->srgb) return (uint8_t)(shade__saturate(c) * 255 + 0.5f);
    bits = shade__srgb_bits(c);
    return (uint8_t)shade__srgb_byte(bits, shade__byte_steps[shade__srgb_cell(bits)]);
}

/* R, G and B of the pixels x .. x + n - 1 of row y. */
static void shade__rgb_run(const shade_target *t, int x, int y, int n, uint8_t *rgb)
{
    const shade__layout l = shade__layouts[t->format];
    const uint8_t *p = shade__pixel_at(t, x, y);
    for (int i = 0; i < n; i++, p += l.bytes)
        for (int k = 0; k < 3; k++)
            *rgb++ = l.bytes == 4 ? p[l.shift[k] / 8] : shade__byte_of(t, &l, p, k);
}

static char *shade__decimal(char *p, int n)
{
    if (n > 9) p = shade__decimal(p, n / 10);
    *p = (char)('0' + n % 10);
    return p + 1;
}

/* Binary PPM: "P6", width, height, 255, then R, G, B bytes from the top row on. */
SHADEDEF shade_result shade_encode_ppm(shade_write_fn *sink, void *user, const shade_target *target)
{
    char head[32] = "P6\n", *p = head + 3;
    uint8_t rgb[3 * SHADE__FILE_RUN];
    shade_result result = sink ? shade__check_picture(target) : SHADE_ERROR_ARGUMENT;
    if (result) return result;
    p = shade__decimal(p, target->width);
    *p++ = ' ';
    p = shade__decimal(p, shade__rows_held(target));
    SHADE_MEMCPY(p, "\n255\n", 5);
    if (sink(user, head, (size_t)(p + 5 - head))) return SHADE_ERROR_IO;

    for (int y = 0; y < shade__rows_held(target); y++)
        for (int x = 0; x < target->width; x += SHADE__FILE_RUN) {
            const int n = shade__min(SHADE__FILE_RUN, target->width - x);
            shade__rgb_run(target, x, target->row_offset + y, n, rgb);
            if (sink(user, rgb, (size_t)n * 3)) return SHADE_ERROR_IO;
        }
    return SHADE_OK;
}

/* A PNG that is being written. */
typedef struct shade__png {
    const shade_target *target;
    shade_write_fn *sink;
    void *user;
    int failed;              /* non-zero: the sink has failed, and is not called again */
    int before[3];           /* the bytes taken last, the last one first; -1: none yet */
    int repeats;             /* of the last ones, those held back because they repeat others */
    int distances;           /* a mask of what they all repeat: 1 the byte before each, 2 that
                                three before */
    uint32_t sum[2];         /* Adler-32 of the bytes taken */
    uint32_t bits;           /* packed bits that are no whole byte yet, from the lowest on */
    int bit_count;
    uint32_t size;           /* of the data in chunk */
    uint8_t chunk[SHADE__PNG_DATA + 12];    /* size, name, data, CRC-32 */
} shade__png;

/* The highest byte first, as in all numbers of a PNG. */
static void shade__store_big(uint8_t *p, uint32_t number)
{
    for (int k = 0; k < 4; k++) p[k] = (uint8_t)(number >> (24 - 8 * k));
}

static uint32_t shade__crc32(const uint8_t *p, size_t n)
{
    uint32_t crc = 0xFFFFFFFFu;
    for (size_t i = 0; i < n; i++) {
        crc ^= p[i];
        for (int k = 0; k < 8; k++) crc = crc >> 1 ^ (0xEDB88320u & shade__mask(crc & 1));
    }
    return ~crc;
}

/* Hands the data in the chunk to the sink, and empties the chunk. */
static void shade__put_chunk(shade__png *f, const char *name)
{
    uint8_t *crc = f->chunk + 8 + f->size;
    shade__store_big(f->chunk, f->size);
    SHADE_MEMCPY(f->chunk + 4, name, 4);
    shade__store_big(crc, shade__crc32(f->chunk + 4, 4 + f->size));
    if (!f->failed) f->failed = f->sink(f->user, f->chunk, 12 + f->size);
    f->size = 0;
}

static void shade__put_byte(shade__png *f, uint32_t byte)
{
    if (f->size == SHADE__PNG_DATA) shade__put_chunk(f, "IDAT");
    f->chunk[8 + f->size++] = (uint8_t)byte;
}

/* Packs count bits, from the lowest on.   pre: count <= 16 */
static void shade__put_bits(shade__png *f, uint32_t bits, int count)
{
    f->bits |= bits << f->bit_count;
    f->bit_count += count;
    for (; f->bit_count >= 8; f->bit_count -= 8) {
        shade__put_byte(f, f->bits & 255);
        f->bits >>= 8;
    }
}

/* Packs the fixed code of a symbol, from its highest bit on: 0 .. 255 is a byte, 256 the end,
   257 .. 285 a length. */
static void shade__put_symbol(shade__png *f, uint32_t symbol)
{
    uint32_t code = symbol + 48, turned = 0;
    int count = 8;
    if (symbol > 279) code = symbol - 88;
    else if (symbol > 255) {
        code = symbol - 256;
        count = 7;
    } else if (symbol > 143) {
        code = symbol + 256;
        count = 9;
    }
    for (int k = 0; k < count; k++) turned = turned << 1 | (code >> k & 1);
    shade__put_bits(f, turned, count);
}

/* Packs the bytes that repeat others: three or more as a length and a distance.  A length of n + 3
   has the symbol 257 + n for n < 8; above, its symbol has the 3 highest bits of n, and the others
   follow. */
static void shade__end_run(shade__png *f)
{
    const uint32_t n = (uint32_t)f->repeats - 3;
    int more = 0;
    if (f->repeats < 3)
        for (int k = f->repeats - 1; k >= 0; k--) shade__put_symbol(f, (uint32_t)f->before[k]);
    else {
        while (n >> more > 7) more++;
        shade__put_symbol(f, 257 + 4 * (uint32_t)more + (n >> more));
        shade__put_bits(f, n & ((1u << more) - 1), more);
        shade__put_bits(f, f->distances & 1 ? 0 : 8, 5);    /* distance 1, or 3 */
    }
    f->repeats = 0;
}

static void shade__take_byte(shade__png *f, int byte)
{
    const int same = (byte == f->before[0]) | (byte == f->before[2]) << 1;
    f->sum[0] = (f->sum[0] + (uint32_t)byte) % 65521;
    f->sum[1] = (f->sum[1] + f->sum[0]) % 65521;
    if (f->repeats && (!(f->distances & same) || f->repeats == SHADE__PNG_REPEAT))
        shade__end_run(f);
    f->distances = f->repeats ? f->distances & same : same;
    if (f->distances) f->repeats++;
    else shade__put_symbol(f, (uint32_t)byte);
    f->before[2] = f->before[1];
    f->before[1] = f->before[0];
    f->before[0] = byte;
}

/* A run of pixels, and the pixels above, each behind the pixel to its left; 0 beyond the edges of
   the picture. */
typedef struct shade__png_rows {
    uint8_t here[3 * SHADE__FILE_RUN + 3], above[3 * SHADE__FILE_RUN + 3];
} shade__png_rows;

static void shade__png_rows_at(const shade_target *t, int x, int y, int n, shade__png_rows *rows)
{
    const int left = x > 0, at = 3 - 3 * left;
    SHADE__ZERO(*rows);
    shade__rgb_run(t, x - left, y, n + left, rows->here + at);
    if (y > t->row_offset) shade__rgb_run(t, x - left, y - 1, n + left, rows->above + at);
}

/* Byte i of a run minus a guess.  Filter 0 guesses 0; filter 2 the byte above; filter 4 that one of
   left, above and corner (above left) which is nearest to left + above - corner. */
static int shade__filtered(const shade__png_rows *rows, int filter, int i)
{
    const int left = rows->here[i], above = rows->above[i + 3], corner = rows->above[i];
    const int from_left = shade__max(above - corner, corner - above);
    const int from_above = shade__max(left - corner, corner - left);
    const int sum = left + above - 2 * corner, from_corner = shade__max(sum, -sum);
    int guess = filter ? above : 0;
    if (filter == 4) {
        if (from_corner < from_above) guess = corner;
        if (from_left <= from_above && from_left <= from_corner) guess = left;
    }
    return (rows->here[i + 3] - guess) & 255;
}

/* Takes a row in a filter.  With pack 0 it only returns about how many bits that would need: 1 for
   a byte that repeats the one three before it, else the length of its code. */
static uint32_t shade__png_row(shade__png *f, int y, int filter, int pack)
{
    const shade_target *t = f->target;
    shade__png_rows rows;
    uint32_t bits = 0;
    int before[3] = { 0, 0, 0 };
    if (pack) shade__take_byte(f, filter);
    for (int x = 0; x < t->width; x += SHADE__FILE_RUN) {
        const int n = shade__min(SHADE__FILE_RUN, t->width - x);
        shade__png_rows_at(t, x, y, n, &rows);
        for (int i = 0; i < 3 * n; i++) {
            const int byte = shade__filtered(&rows, filter, i);
            if (pack) shade__take_byte(f, byte);
            bits += byte == before[i % 3] ? 1 : byte < 144 ? 8 : 9;
            before[i % 3] = byte;
        }
    }
    return bits;
}

/* The chunks before the pixels: the size of the picture, 8 bits, RGB, and the only methods that
   there are; and whether it is sRGB. */
static void shade__png_head(shade__png *f)
{
    static const uint8_t rest[5] = { 8, 2, 0, 0, 0 };
    shade__store_big(f->chunk + 8, (uint32_t)f->target->width);
    shade__store_big(f->chunk + 12, (uint32_t)shade__rows_held(f->target));
    SHADE_MEMCPY(f->chunk + 16, rest, 5);
    f->size = 13;
    shade__put_chunk(f, "IHDR");
    if (!f->target->srgb) return;
    shade__put_byte(f, 0);    /* rendering intent: perceptual */
    shade__put_chunk(f, "sRGB");
}

/* One stream of zlib: two bytes, one block of deflate with fixed codes, and Adler-32.  Filters 1
   and 3 would save 0.2 % of the gallery. */
static void shade__png_pixels(shade__png *f)
{
    const int top = f->target->row_offset, end = top + shade__rows_held(f->target);
    shade__put_bits(f, 0x0178, 16);
    shade__put_bits(f, 3, 3);
    for (int y = top; y < end && !f->failed; y++) {
        uint32_t least = UINT32_MAX;
        int best = 0;
        for (int filter = 0; filter < 5; filter += 2) {
            const uint32_t bits = shade__png_row(f, y, filter, 0);
            if (bits < least) best = filter;
            least = bits < least ? bits : least;
        }
        shade__png_row(f, y, best, 1);
    }
    shade__end_run(f);
    shade__put_symbol(f, 256);
    shade__put_bits(f, 0, 7);    /* fills the last byte */
    for (int k = 3; k >= 0; k--) shade__put_byte(f, f->sum[k / 2] >> k % 2 * 8);
    shade__put_chunk(f, "IDAT");
}

SHADEDEF shade_result shade_encode_png(shade_write_fn *sink, void *user, const shade_target *target)
{
    shade__png file;
    const shade_result result = sink ? shade__check_picture(target) : SHADE_ERROR_ARGUMENT;
    if (result) return result;
    SHADE__ZERO(file);
    file.target = target;
    file.sink = sink;
    file.user = user;
    for (int k = 0; k < 3; k++) file.before[k] = -1;
    file.sum[0] = 1;
    file.failed = sink(user, "\x89PNG\r\n\x1A\n", 8);
    shade__png_head(&file);
    shade__png_pixels(&file);
    shade__put_chunk(&file, "IEND");
    return file.failed ? SHADE_ERROR_IO : SHADE_OK;
}

#ifndef SHADE_NO_STDIO
static int shade__write_file(void *user, const void *bytes, size_t size)
{
    return fwrite(bytes, 1, size, (FILE *)user) != size;
}

typedef shade_result shade__encoder(shade_write_fn *sink, void *user, const shade_target *target);
static shade_result shade__write(const char *path, const shade_target *target,
                                 shade__encoder *encode)
{
    FILE *file;
    shade_result result = path ? shade__check_picture(target) : SHADE_ERROR_ARGUMENT;
    if (result) return result;
    SHADE__CREATE(file, path);
    if (!file) return SHADE_ERROR_IO;
    result = encode(shade__write_file, file, target);
    if (fclose(file)) result = SHADE_ERROR_IO;
    return result;
}

SHADEDEF shade_result shade_write_ppm(const char *path, const shade_target *target)
{
    return shade__write(path, target, shade_encode_ppm);
}

SHADEDEF shade_result shade_write_png(const char *path, const shade_target *target)
{
    return shade__write(path, target, shade_encode_png);
}
#endif

/*---------------------------------------------------------------------------------------- >>presets
   The classic materials, as colours of a display.
     source  [Kilgard94]                                                                 >>replay */

/* One row of the table: name; k_a, k_d, k_s, shininess / 128. */
typedef struct shade__preset_entry {
    const char *name;
    float ar, ag, ab, dr, dg, db, sr, sg, sb, shininess;
} shade__preset_entry;

/* Returns NULL if there is no such material. */
static const shade__preset_entry *shade__preset(int preset)
{
    static const shade__preset_entry table[SHADE_PRESET_COUNT] = {
        { "emerald", 0.0215f, 0.1745f, 0.0215f, 0.07568f, 0.61424f, 0.07568f,
            0.633f, 0.727811f, 0.633f, 0.6f },
        { "jade", 0.135f, 0.2225f, 0.1575f, 0.54f, 0.89f, 0.63f,
            0.316228f, 0.316228f, 0.316228f, 0.1f },
        { "obsidian", 0.05375f, 0.05f, 0.06625f, 0.18275f, 0.17f, 0.22525f,
            0.332741f, 0.328634f, 0.346435f, 0.3f },
        { "pearl", 0.25f, 0.20725f, 0.20725f, 1, 0.829f, 0.829f,
            0.296648f, 0.296648f, 0.296648f, 0.088f },
        { "ruby", 0.1745f, 0.01175f, 0.01175f, 0.61424f, 0.04136f, 0.04136f,
            0.727811f, 0.626959f, 0.626959f, 0.6f },
        { "turquoise", 0.1f, 0.18725f, 0.1745f, 0.396f, 0.74151f, 0.69102f,
            0.297254f, 0.30829f, 0.306678f, 0.1f },
        { "brass", 0.329412f, 0.223529f, 0.027451f, 0.780392f, 0.568627f, 0.113725f,
            0.992157f, 0.941176f, 0.807843f, 0.21794872f },
        { "bronze", 0.2125f, 0.1275f, 0.054f, 0.714f, 0.4284f, 0.18144f,
            0.393548f, 0.271906f, 0.166721f, 0.2f },
        { "chrome", 0.25f, 0.25f, 0.25f, 0.4f, 0.4f, 0.4f, 0.774597f, 0.774597f, 0.774597f, 0.6f },
        { "copper", 0.19125f, 0.0735f, 0.0225f, 0.7038f, 0.27048f, 0.0828f,
            0.256777f, 0.137622f, 0.086014f, 0.1f },
        { "gold", 0.24725f, 0.1995f, 0.0745f, 0.75164f, 0.60648f, 0.22648f,
            0.628281f, 0.555802f, 0.366065f, 0.4f },
        { "silver", 0.19225f, 0.19225f, 0.19225f, 0.50754f, 0.50754f, 0.50754f,
            0.508273f, 0.508273f, 0.508273f, 0.4f },
        { "black plastic", 0, 0, 0, 0.01f, 0.01f, 0.01f, 0.5f, 0.5f, 0.5f, 0.25f },
        { "cyan plastic", 0, 0.1f, 0.06f, 0, 0.50980392f, 0.50980392f,
            0.50196078f, 0.50196078f, 0.50196078f, 0.25f },
        { "green plastic", 0, 0, 0, 0.1f, 0.35f, 0.1f, 0.45f, 0.55f, 0.45f, 0.25f },
        { "red plastic", 0, 0, 0, 0.5f, 0, 0, 0.7f, 0.6f, 0.6f, 0.25f },
        { "white plastic", 0, 0, 0, 0.55f, 0.55f, 0.55f, 0.7f, 0.7f, 0.7f, 0.25f },
        { "yellow plastic", 0, 0, 0, 0.5f, 0.5f, 0, 0.6f, 0.6f, 0.5f, 0.25f },
        { "black rubber", 0.02f, 0.02f, 0.02f, 0.01f, 0.01f, 0.01f, 0.4f, 0.4f, 0.4f, 0.078125f },
        { "cyan rubber", 0, 0.05f, 0.05f, 0.4f, 0.5f, 0.5f, 0.04f, 0.7f, 0.7f, 0.078125f },
        { "green rubber", 0, 0.05f, 0, 0.4f, 0.5f, 0.4f, 0.04f, 0.7f, 0.04f, 0.078125f },
        { "red rubber", 0.05f, 0, 0, 0.5f, 0.4f, 0.4f, 0.7f, 0.04f, 0.04f, 0.078125f },
        { "white rubber", 0.05f, 0.05f, 0.05f, 0.5f, 0.5f, 0.5f, 0.7f, 0.7f, 0.7f, 0.078125f },
        { "yellow rubber", 0.05f, 0.05f, 0, 0.5f, 0.5f, 0.4f, 0.7f, 0.7f, 0.04f, 0.078125f }
    };
    return preset >= 0 && preset < SHADE_PRESET_COUNT ? &table[preset] : NULL;
}

SHADEDEF shade_material shade_preset_material(shade_preset preset)
{
    const shade__preset_entry *row = shade__preset((int)preset);
    shade_material m = shade__white_lambert();
    if (!row) return m;
    m.ambient = shade_v3(row->ar, row->ag, row->ab);
    m.diffuse = shade_v3(row->dr, row->dg, row->db);
    m.specular = shade_v3(row->sr, row->sg, row->sb);
    m.shininess = row->shininess * 128;
    return m;
}

SHADEDEF const char *shade_preset_name(shade_preset preset)
{
    const shade__preset_entry *row = shade__preset((int)preset);
    return row ? row->name : "";
}

SHADEDEF shade_material shade_linear_material(shade_material display)
{
    display.emission = shade_linear_from_srgb(display.emission);
    display.ambient = shade_linear_from_srgb(display.ambient);
    display.diffuse = shade_linear_from_srgb(display.diffuse);
    display.specular = shade_linear_from_srgb(display.specular);
    return display;
}

#ifndef SHADE_NO_EXPLAIN

/*----------------------------------------------------------------------------------------- >>replay
   A pipeline or lines are drawn again without a picture, and what their shaders return is counted.
     in      arguments of shade_draw or shade_draw_lines       out  a shade__tally
     way     run_again: replay_vertex, replay_fragment: count_colors: count_color
     method  Shaders of this section call the given ones and look at what these wrote.
     holds   The caller's memory is only read, unless the caller's own shaders write.    >>survey */

/* What a fragment shader returned for some fragments, without those that it discards. */
typedef struct shade__color_counts {
    long long count;
    long long nan;           /* of these: a channel is NaN, and 0 or NaN in the picture; */
    long long clear;         /* alpha is 0 or less; */
    long long none;          /* no channel is above 0; */
    long long dark;          /* no channel is above 8 of 255; */
    long long bright;        /* a channel is 16 or more */
} shade__color_counts;

/* What the shaders returned in one run. */
typedef struct shade__tally {
    shade_stats stats;                   /* fragments: neither discarded nor hidden */
    uint32_t    outside;                 /* the SHADE__OUT_... bits that all vertices share */
    int         any_xy, any_w, other_w;  /* 1: some x or y is not 0; a w is not 0; not 1 */
    long long   fragments, discarded;    /* hidden ones too; those that the shader discards */
    shade__color_counts all, stored;     /* stored: those that have the stored depth */
    int         rows_written;            /* varyings that the vertex shader writes */
    int         reads_more;              /* the fragment shader reads rows past pipe.varyings */
    int         vertex_lanes_left;       /* 1: a shader wrote lane 0 of a packet, and left all */
    int         fragment_lanes_left;     /*    others alone */
} shade__tally;

/* The bits of a NaN that no arithmetic gives: it marks floats that no shader has written. */
#define SHADE__UNWRITTEN 0x7FC5AD1Eu

/* A draw that is run again. */
typedef struct shade__replay {
    const shade_target *target;          /* the caller's */
    const shade_line_state *lines;       /* NULL: the pipeline is the caller's */
    const shade__stroke *stroke;         /* of lines */
    shade__indices      indices;
    int                 corners;
    shade_pipeline      pipe;            /* the given one */
    shade_mesh          mesh;            /* zero: a survey needs a mesh and a state */
    shade_draw_state    state;           /* zero, but for its raster */
} shade__replay;

/* One run of it, for its shaders. */
typedef struct shade__rerun {
    const shade__replay *replay;
    shade_vertex_shader *vertex;
    float                far_depth, far_margin;    /* depths this near to far_depth do not count */
    shade_fragment_shader *fragment;     /* NULL: it is not called */
    int                  checks;         /* what the caller's shaders read and write is checked */
    shade__tally        *tally;
} shade__rerun;

/* Channels below this are stored as 8 of 255 at most (8.3 in 5-6-5 bits); in floats they are below
   FLT_MIN. */
static float shade__dim_of(const shade_target *t)
{
    const shade__layout *l = &shade__layouts[t->format];
    const float dim = 8.5f / 255;
    if (l->bytes == 16) return FLT_MIN;
    return shade__is_encoded(t->srgb, l) ? shade__decode(dim) : dim;
}

/* Channel k of a pixel as it is stored: a float, or a code.   pre: the pixel is in the clip
   rectangle, and there is a picture */
static float shade__stored(const shade_target *t, int x, int y, int k)
{
    const shade__layout *l = &shade__layouts[t->format];
    const uint8_t *p = (const uint8_t *)t->color + shade__offset_of(t, x, y) * l->bytes;
    float light;
    if (l->bytes < 16) return shade__channel(shade__load_packed(p, l->bytes, l->swapped), l, k);
    SHADE_MEMCPY(&light, p + 4 * k, 4);
    return light;
}

/* Counts the colour of lane i. */
static void shade__count_color(const shade_target *t, const shade_fragments *in,
                               const shade_colors *c, int i, shade_blend blend,
                               shade__color_counts *to)
{
    const float alpha = c->color[3][i], dim = shade__dim_of(t);
    const int veiled = blend == SHADE_BLEND_OVER && alpha != alpha;
    const int x = (int)in->x[i], y = (int)in->y[i];
    float most = 0;
    int nan = 0;
    for (int k = 0; k < 3; k++) {
        const float light = c->color[k][i];
        const int is_nan = light != light || veiled;
        if (is_nan) {    /* 0 or NaN in the picture */
            const float stored = shade__stored(t, x, y, k);
            nan |= !(stored > 0) && !(stored < 0);
        }
        most = shade__maxf(light, most);
    }
    to->count++;
    to->nan += nan;
    to->clear += alpha <= 0;
    to->none += most <= 0;
    to->dark += most < dim;
    to->bright += most >= 16;
}

/* Is the depth of lane i the stored one? */
static int shade__has_stored_depth(const shade_target *t, const shade_fragments *in, int i)
{
    return t->depth &&
           t->depth[shade__offset_of(t, (int)in->x[i], (int)in->y[i])] == in->z[i];
}

/* Counts the colours of a packet in the caller's clip rectangle. */
static void shade__count_colors(const shade_target *t, const shade_fragments *in,
                                const shade_colors *c, const shade_raster *raster,
                                shade__tally *tally)
{
    int clip[4];
    shade__clip_rectangle(t, clip);
    for (int i = 0; i < in->count; i++) {
        const int x = (int)in->x[i], y = (int)in->y[i];
        if (c->discard[i] || x < clip[0] || y < clip[1] || x >= clip[2] || y >= clip[3]) continue;
        shade__count_color(t, in, c, i, raster->blend, &tally->all);
        if (shade__has_stored_depth(t, in, i))
            shade__count_color(t, in, c, i, raster->blend, &tally->stored);
    }
}

static void shade__mark(float *row, int count)
{
    for (int i = 0; i < count; i++) row[i] = shade__bits_float(SHADE__UNWRITTEN);
}

static int shade__is_unwritten(float x) { return shade__float_bits(x) == SHADE__UNWRITTEN; }

/* Is lane 0 of the rows written, but no other lane of the packet? */
static int shade__lanes_are_left(const float *rows, int row_count, int count)
{
    int written = 0;
    for (int k = 0; k < row_count; k++)
        for (int i = 1; i < count; i++) written |= !shade__is_unwritten(rows[k * SHADE_LANES + i]);
    for (int k = 0; k < row_count && count > 1 && !written; k++)
        if (!shade__is_unwritten(rows[k * SHADE_LANES])) return 1;
    return 0;
}

/* Looks at what the vertex shader writes of a packet. */
static SHADE__NOINLINE void shade__check_vertices(const shade_pipeline *p,
                                                  const shade_vertex_ids *in, shade__tally *t)
{
    shade_vertices out;
    shade__mark(&out.clip[0][0], 4 * SHADE_LANES);
    shade__mark(&out.varying[0][0], SHADE_MAX_VARYINGS * SHADE_LANES);
    p->vertex(p->uniforms, in, &out);
    t->vertex_lanes_left |= shade__lanes_are_left(out.clip[0], 4, in->count);
    for (int k = 0; k < SHADE_MAX_VARYINGS; k++)
        if (!shade__is_unwritten(out.varying[k][0]))
            t->rows_written = shade__max(t->rows_written, k + 1);
}

/* Looks at what a fragment shader reads and writes of a packet.  Its colours must change with the
   rows past varyings, and be the same again with the first ones: else the shader is random, and
   proves nothing. */
static SHADE__NOINLINE void shade__check_fragments(shade_fragment_shader *shader,
                                                   const void *uniforms, int varyings,
                                                   const shade_fragments *in, shade__tally *t)
{
    shade_fragments f = *in;
    shade_colors c[3];
    int differ = 0, again = 1;
    for (int run = 0; run < 3; run++) {
        for (int k = varyings; k < SHADE_MAX_VARYINGS; k++)
            for (int i = 0; i < SHADE_LANES; i++) f.varying[k][i] = run == 1 ? 0.75f : 0.25f;
        shade__mark(c[run].color[0], 4 * SHADE_LANES);
        SHADE__ZERO(c[run].discard);
        shader(uniforms, &f, &c[run]);
    }
    for (int k = 0; k < 4; k++)
        for (int i = 0; i < in->count; i++) {
            const uint32_t first = shade__float_bits(c[0].color[k][i]);
            differ |= first != shade__float_bits(c[1].color[k][i]);
            again &= first == shade__float_bits(c[2].color[k][i]);
        }
    t->reads_more |= differ && again;
    t->fragment_lanes_left |= shade__lanes_are_left(c[0].color[0], 3, in->count);
}

static void shade__replay_vertex(const void *uniforms, const shade_vertex_ids *SHADE_RESTRICT in,
                                 shade_vertices *SHADE_RESTRICT out)
{
    const shade__rerun *run = (const shade__rerun *)uniforms;
    const shade_pipeline *pipe = &run->replay->pipe;
    run->vertex(pipe->uniforms, in, out);
    if (run->checks) shade__check_vertices(pipe, in, run->tally);
    for (int i = 0; i < in->count; i++) {
        const float x = out->clip[0][i], y = out->clip[1][i], w = out->clip[3][i];
        const uint32_t bits =
            shade__outcode(x, y, out->clip[2][i], w, pipe->raster.depth_zero_to_one);
        if (!(bits & SHADE__OUT_BAD)) run->tally->outside &= bits;
        run->tally->any_xy |= x != 0 || y != 0;
        run->tally->any_w |= w != 0;
        run->tally->other_w |= w != 1;
    }
}

/* Calls the given shader if a draw would. */
static void shade__replay_fragment(const void *uniforms, const shade_fragments *SHADE_RESTRICT in,
                                   shade_colors *SHADE_RESTRICT out)
{
    const shade__rerun *run = (const shade__rerun *)uniforms;
    const shade_pipeline *pipe = &run->replay->pipe;
    const shade_target *target = run->replay->target;
    shade__tally *t = run->tally;
    if (run->fragment && (target->color || pipe->may_discard))
        run->fragment(pipe->uniforms, in, out);
    if (run->checks && run->fragment && target->color)
        shade__check_fragments(run->fragment, pipe->uniforms, pipe->varyings, in, t);
    t->fragments += in->count;
    for (int i = 0; i < in->count; i++) {
        t->discarded += out->discard[i] != 0;
        if (!pipe->may_discard) out->discard[i] = 0;
        if (run->far_margin > 0 && shade__within(in->z[i] - run->far_depth, run->far_margin))
            out->discard[i] = 1;
    }
    if (run->fragment && target->color)
        shade__count_colors(target, in, out, &pipe->raster, t);
}

enum {                                   /* how a draw is run again */
    SHADE__UNDISCARDED = 1,              /* the fragment shader is not called */
    SHADE__CHECKS = 2                    /* what shaders read and write is checked */
};

/* Runs the draw, with a raster and into a picture that may differ from the given ones.  far_range:
   farthest and far_margin of a survey.  vertex NULL: the given one. */
static shade__tally shade__run_again(const shade__replay *r, const shade_target *picture,
                                     const shade_raster *raster, shade_vertex_shader *vertex,
                                     const float far_range[2], unsigned how)
{
    shade__rerun run;
    shade__tally tally;
    shade__supply supply;
    shade_target t = *picture;
    shade_pipeline p = r->pipe;
    SHADE__ZERO(tally);
    tally.outside = ~0u;
    run.replay = r;
    run.vertex = vertex ? vertex : p.vertex;
    run.fragment = how & SHADE__UNDISCARDED ? NULL : p.fragment;
    run.checks = !r->lines && how & SHADE__CHECKS;
    run.far_depth = far_range[0];
    run.far_margin = far_range[1];
    run.tally = &tally;
    t.color = NULL;
    p.vertex = shade__replay_vertex;
    p.fragment = shade__replay_fragment;
    p.uniforms = &run;
    p.raster = *raster;
    p.may_discard = p.raster.depth_read_only = 1;
    shade__supply_all(r->indices, r->corners, &supply);
    shade__run_draw(&t, &p, 0, shade_v3(0, 0, 0), &supply, &tally.stats);
    return tally;
}

/* The clip-space positions of points, each three times. */
static void shade__point_vertex(const void *uniforms, const shade_vertex_ids *SHADE_RESTRICT in,
                                shade_vertices *SHADE_RESTRICT out)
{
    double end[4];
    for (int i = 0; i < SHADE_LANES; i++) {
        shade__stroke_end((const shade__stroke *)uniforms, in->index[i] / 3, end);
        for (int k = 0; k < 4; k++) out->clip[k][i] = (float)end[k];
    }
}

/*----------------------------------------------------------------------------------------- >>survey
   Experiments: a draw is made again with something changed, and pixels are counted.
     in      arguments of a draw           out  numbers of pixels, stats; depths of some pixels
     way     open_survey of >>questions; then a change to a copy, and count or take_probes of it:
             draw_trial: draw_scene of >>mesh, with judge as its fragment shader; or run_again
     holds   A survey is a draw.  An experiment changes a copy of it, q, and draws the copy.  The
             caller's memory is only read.  The mesh's fragment shader is called by tally_of alone.
                                                                                      >>questions */

enum {
    SHADE__SUSPECTS = 16,                /* the most lamps that experiments use */
    SHADE__PROBES = 256                  /* pixels in which depths are compared; a power of 2 */
};

/* The fragments of one sampled pixel, in drawing order. */
typedef struct shade__probe {
    uint32_t pixel_id;                   /* 0: none yet */
    float    nearest, farthest, last;    /* depths */
    uint32_t front, any_front;           /* 1: the nearest is front-facing; any is */
} shade__probe;

/* The given draw, and the one drawn in its place.  No pointer leads into the survey itself, so that
   a copy is a survey of its own. */
typedef struct shade__survey {
    const shade__replay    *replay;      /* the draw, if it is not one of a mesh; NULL: a mesh */
    const shade_target     *target;      /* the caller's */
    const shade_mesh       *given_mesh;
    const shade_draw_state *given_state;
    const shade_stats      *given_stats; /* NULL: none were passed */

    shade_target     picture;            /* the pixels and the depth test of the experiment */
    shade_mesh       mesh;
    shade_draw_state state;              /* but its material and lamps follow */
    shade_material   material;           /* the given one, or white */
    shade_light      lamp[SHADE__SUSPECTS];
    int              lamps_replaced;     /* lamp is in use, not state.lighting.lights */
    uint32_t         white_map;          /* the map counts as white, with its holes */
    float            far_margin;         /* depths this near to farthest do not count; 0: all do */
    int              lit_only;           /* count only pixels lit in the caller's picture */
    unsigned         how;                /* SHADE__UNDISCARDED, SHADE__CHECKS */

    int   clip[4], whole;                /* the clip rectangle; is it the whole picture? */
    int   exact;                         /* 1: the experiment draws exactly the fragments that
                                            are visible in the caller's picture */
    float dim;                           /* of shade__dim_of: channels below it are dark */
    shade__camera camera;
    float farthest;                      /* depth of pixels that do not show the mesh */
    int   eye_replaced;                  /* light takes eye, not the eye of state.view */
    shade_vec3 eye;
} shade__survey;

/* One drawing of a survey, for its fragment shader. */
typedef struct shade__trial {
    shade__scene scene;                  /* first, as the shaders of meshes expect */
    const shade__survey *survey;
    float         least;                 /* pixels count if a channel has this; 0: all do */
    uint32_t      every;                 /* samples one pixel of this many; 0: none */
    shade__probe *probes;
    shade__tally *tally;                 /* for shade__tally_mesh */
} shade__trial;

/* Notes the depth of lane i, if its pixel is sampled. */
static void shade__take_probe(const shade__trial *trial, const shade_fragments *in, int i)
{
    const uint32_t pixel_id = (uint32_t)in->x[i] + (uint32_t)in->y[i] * SHADE__SIDE_MAX + 1;
    const uint32_t hash = pixel_id * 2654435769u >> 8;
    shade__probe *at = trial->probes + hash / trial->every % SHADE__PROBES;
    const float z = in->z[i];
    const float sign = 2 * trial->survey->farthest - 1;
    float nearer = 1;
    if (hash % trial->every || (at->pixel_id && at->pixel_id != pixel_id)) return;
    if (at->pixel_id) nearer = (at->nearest - z) * sign;
    if (!at->pixel_id || (z - at->farthest) * sign > 0) at->farthest = z;
    if (nearer > 1e-6f) {
        at->nearest = z;
        at->front = 0;
    }
    if (nearer > -1e-6f) at->front |= in->front[i];
    at->pixel_id = pixel_id;
    at->last = z;
    at->any_front |= in->front[i];
}

/* Is the pixel in the caller's picture brighter than 8 of 255, or, in floats, above 0?  In 5-6-5
   bits 1/31 of red or blue and 2/63 of green are brighter too. */
static int shade__is_lit_there(const shade_target *t, int x, int y)
{
    const shade__layout *l = &shade__layouts[t->format];
    int any = 0;
    for (int k = 0; k < 3; k++)
        any |= shade__stored(t, x, y, k) * 255 > (l->bytes < 16 ? 8 * (float)l->full[k] : 0);
    return any;
}

/* Does lane i pass the depth test of the picture of a survey, which follows this shader? */
static int shade__passes_there(const shade__survey *s, const shade_fragments *in, int i)
{
    const shade_target *t = &s->picture;
    return !t->depth ||
           shade__passes(shade__compare_of(&s->state.raster), 0, in->z[i],
                         t->depth[shade__offset_of(t, (int)in->x[i], (int)in->y[i])]) != 0;
}

/* The fragment shader of experiments: it discards fragments that do not count. */
static void shade__judge(const void *uniforms, const shade_fragments *SHADE_RESTRICT in,
                         shade_colors *SHADE_RESTRICT out)
{
    const shade__trial *trial = (const shade__trial *)uniforms;
    const shade__survey *s = trial->survey;
    const int over = s->state.raster.blend == SHADE_BLEND_OVER;
    shade__mesh_colors(&trial->scene, in, out);
    shade__mesh_alpha(&trial->scene, out);
    for (int i = 0; i < in->count; i++) {
        const float a = over ? out->color[3][i] : 1;
        int counts = !(trial->least > 0);
        for (int k = 0; k < 3; k++) counts |= out->color[k][i] * a >= trial->least;
        if (s->far_margin > 0) counts &= !shade__within(in->z[i] - s->farthest, s->far_margin);
        if (s->lit_only) counts &= shade__is_lit_there(s->target, (int)in->x[i], (int)in->y[i]);
        if (!counts) out->discard[i] = 1;
        if (trial->every && !out->discard[i] && shade__passes_there(s, in, i))
            shade__take_probe(trial, in, i);
    }
}

/* Calls the mesh's own fragment shader, and counts what it returns. */
static void shade__tally_mesh(const void *uniforms, const shade_fragments *SHADE_RESTRICT in,
                              shade_colors *SHADE_RESTRICT out)
{
    const shade__trial *trial = (const shade__trial *)uniforms;
    const shade__survey *s = trial->survey;
    shade__mesh_fragment(&trial->scene, in, out);
    shade__check_fragments(s->state.fragment, s->state.uniforms, SHADE_MAX_VARYINGS, in,
                           trial->tally);
    trial->tally->fragments += in->count;
    for (int i = 0; i < in->count; i++) trial->tally->discarded += out->discard[i] != 0;
    shade__count_colors(s->target, in, out, &s->state.raster, trial->tally);
}

/* Draws the mesh of a survey.   pre: least, every and probes of the trial are set */
static shade_stats shade__draw_trial(const shade__survey *s, shade__trial *trial)
{
    shade_target t = s->picture;
    shade_draw_state state = s->state;
    shade_stats stats;
    state.material = &s->material;
    if (s->lamps_replaced) state.lighting.lights = s->lamp;
    if (!(trial->least > 0) && !trial->tally) t.color = NULL;
    shade__scene_of(&t, &s->mesh, &state, &trial->scene);
    trial->scene.white_map = s->white_map;
    if (s->eye_replaced) {
        shade_vec4 *eye = &trial->scene.surface.eye;
        trial->scene.eye = s->eye;
        *eye = shade__xyzw(s->eye, eye->w);
    }
    trial->survey = s;
    t.color = NULL;
    /* may_discard = 1 makes >>fragments set x, y and z, which judge reads */
    shade__draw_scene(&t, &trial->scene, trial->tally ? shade__tally_mesh : shade__judge, 1,
                      &stats);
    return stats;
}

/* Runs lines or a pipeline.  vertex NULL: the given shader. */
static shade__tally shade__replay_of(const shade__survey *s, shade_vertex_shader *vertex)
{
    const float far_range[2] = { s->farthest, s->far_margin };
    return shade__run_again(s->replay, &s->picture, &s->state.raster, vertex, far_range,
                            s->how);
}

/* Counts the colours of all fragments in the clip rectangle.   pre: there is a fragment shader of
   the caller, or the draw is one of lines */
static shade__tally shade__tally_of(const shade__survey *s)
{
    shade__survey q = *s;
    shade__trial trial;
    shade__tally tally;
    q.picture = *s->target;
    q.picture.depth = NULL;
    q.how = SHADE__CHECKS;
    if (s->replay) return shade__replay_of(&q, NULL);

    q.state.fragment = s->given_state->fragment;
    q.state.alpha_cutoff = s->given_state->alpha_cutoff;
    SHADE__ZERO(trial);
    SHADE__ZERO(tally);
    trial.tally = &tally;
    tally.stats = shade__draw_trial(&q, &trial);
    return tally;
}

/* Returns the stats of a drawing.  fragments counts pixels with a channel of least or more; all, if
   the draw is not one of a mesh. */
static shade_stats shade__stats_of(const shade__survey *s, float least)
{
    shade__trial trial;
    if (s->replay) return shade__replay_of(s, NULL).stats;
    SHADE__ZERO(trial);
    trial.least = least;
    return shade__draw_trial(s, &trial);
}

static long long shade__count(const shade__survey *s, float least)
{
    return shade__stats_of(s, least).fragments;
}

/* Returns how many pixels are covered. */
static long long shade__covered(const shade__survey *s) { return shade__count(s, 0); }

/* Is a pixel of the mesh brighter than 8 of 255?  Highlights are widened, because narrow ones may
   lie between pixels. */
static int shade__shows(shade__survey *s)
{
    shade__survey wide = *s;
    wide.material.shininess = shade__minf(wide.material.shininess, 4);
    return shade__count(&wide, s->dim) > 0;
}

/* Do two surveys differ in the number of pixels, of all or of bright ones? */
static int shade__differ(const shade__survey *a, const shade__survey *b)
{
    if (shade__covered(a) != shade__covered(b)) return 1;
    if (a->target->color)
        for (float least = 0.5f; least > 0.03f; least *= 0.7f)
            if (shade__count(a, least) != shade__count(b, least)) return 1;
    return 0;
}

/* Is there a pixel of sqrt(dim) or more?  A surface that reflects sqrt(dim) of it gives dim. */
static int shade__bright(const shade__survey *s)
{
    return shade__count(s, shade__sqrt(s->dim)) > 0;
}

/* Samples pixels.  In a perspective the nearest is the nearest to the eye, for any depth test. */
static void shade__take_probes(const shade__survey *s, shade__probe probes[SHADE__PROBES])
{
    shade__survey q = *s;
    shade__trial trial;
    if (q.camera.perspective) q.farthest = (float)!q.camera.reversed;
    q.state.raster.depth_bias = 0;    /* depths at the end of their range would be equal */
    SHADE__ZERO(trial);
    trial.every = 1 + (uint32_t)(shade__covered(&q) * 2 / SHADE__PROBES);
    trial.probes = probes;
    for (int k = 0; k < SHADE__PROBES; k++) SHADE__ZERO(probes[k]);
    shade__draw_trial(&q, &trial);
}

/* Does any sampled pixel show a fragment that is not its nearest?  (last = 1: the last drawn one;
   0: the farthest.) */
static int shade__hides_nearest(const shade__survey *s, int last)
{
    shade__probe probes[SHADE__PROBES];
    int n = 0;
    shade__take_probes(s, probes);
    for (int k = 0; k < SHADE__PROBES; k++) {
        const float other = last ? probes[k].last : probes[k].farthest;
        n += !shade__within(other - probes[k].nearest, 1e-6f);
    }
    return n > 0;
}

/*-------------------------------------------------------------------------------------- >>questions
   Surveys are opened and asked: which fragments does the picture show, where is the mesh?
     in      arguments of a draw           out  a shade__survey; answers, most of them 0 or 1
     way     open_survey: look_at_all.  look_at_seen: look_through, coincides, is_opaque
     holds   A question draws copies of a survey; only look_... changes the one that it is given.
                                                                                        >>numbers */

/* ---- which fragments are drawn */

/* All fragments, in the whole picture, without a depth test. */
static void shade__look_at_all(shade__survey *q)
{
    SHADE__ZERO(q->picture);
    q->picture.width = q->target->width;
    q->picture.height = q->target->height;
    q->picture.color = q->target->color;
    q->exact = 0;
}

/* All fragments in the clip rectangle. */
static void shade__look_in_clip(shade__survey *q)
{
    q->picture = *q->target;
    q->picture.depth = NULL;
}

/* The fragments in the clip rectangle that pass this depth test now. */
static void shade__look_through(shade__survey *q, shade_compare test)
{
    q->picture = *q->target;
    q->state.raster.depth_test = test;
}

/* Do more fragments have the stored depth than were drawn?  Then faces coincide. */
static int shade__coincides(const shade__survey *s)
{
    return s->given_stats && shade__covered(s) > s->given_stats->fragments;
}

/* Does each fragment replace the colour behind it? */
static int shade__is_opaque(const shade__survey *s)
{
    const shade_draw_state *d = s->given_state;
    return d->raster.blend == SHADE_BLEND_REPLACE ||
           (d->raster.blend == SHADE_BLEND_OVER && d->transparency == 0 && !d->diffuse_map);
}

/* Draws what the picture shows: after a whole, opaque draw, the fragments with the stored depth.
   Stored depth cannot identify the visible fragments of a band, of blended draws, or with a
   depth_bias.  Then all fragments are drawn: a fault found in none of them is not in the picture.
   If depth is not written, fragments that passed hide others. */
static void shade__look_at_seen(shade__survey *q)
{
    const shade_raster *r = &q->given_state->raster;
    shade__look_through(q, r->depth_read_only ? r->depth_test : SHADE_COMPARE_EQUAL);
    if (q->whole && q->target->depth &&
        (r->depth_read_only || (shade__is_opaque(q) && r->depth_bias == 0)) && shade__covered(q))
        q->exact = !r->depth_read_only && !shade__coincides(q);
    else shade__look_at_all(q);
}

/* The number of pixels that pass the depth test now: all, if there is no depth. */
static long long shade__passed(const shade__survey *s)
{
    shade__survey q = *s;
    shade__look_through(&q, s->given_state->raster.depth_test);
    return shade__covered(&q);
}

/* Did the draw store pixels?  Without stats: does one pass the depth test, or have this depth? */
static int shade__is_drawn(const shade__survey *s)
{
    shade__survey q = *s;
    if (s->given_stats) return s->given_stats->fragments > 0;
    shade__look_through(&q, SHADE_COMPARE_EQUAL);
    return shade__passed(s) || shade__covered(&q);
}

/* n is few: at most a tenth of all, or 0 if the survey is not exact. */
static int shade__few(const shade__survey *s, long long n, long long all)
{
    return n * 10 <= (s->exact ? all : 0);
}

/* Does the picture show a pixel with a brightness from least to most?  If it is unknown which
   fragments are hidden, every fragment must be in that range. */
static int shade__has_pixels(const shade__survey *s, float least, float most)
{
    const shade_raster *r = &s->given_state->raster;
    int known = s->target->depth && !r->depth_read_only && r->depth_bias == 0;
    shade__survey q = *s;
    long long n;
    if (!s->exact && known) {
        shade__look_through(&q, SHADE_COMPARE_EQUAL);
        known = !shade__coincides(&q);
    }
    n = shade__count(&q, least) - shade__count(&q, most);
    return n > 0 && (s->exact || known || n == shade__covered(s));
}

/* Does the picture show a pixel brighter than 12 of 255, which is more than 8 in each format? */
static int shade__lights_up(const shade__survey *s)
{
    return shade__has_pixels(s, 1.5f * s->dim, FLT_MAX);
}

/* Makes a survey of the given draw: all its fragments, and depth is not written. */
static void shade__open_survey(const shade_target *target, const shade_mesh *mesh,
                               const shade_draw_state *state, const shade_stats *stats,
                               shade__survey *s)
{
    SHADE__ZERO(*s);
    s->target = target;
    s->given_mesh = mesh;
    s->given_state = state;
    s->given_stats = stats;
    shade__look_at_all(s);
    s->mesh = *mesh;
    s->state = *state;
    s->state.raster.depth_read_only = 1;
    s->state.model = shade__or_identity(s->state.model);
    s->state.view = shade__or_identity(s->state.view);
    s->state.projection = shade__or_identity(s->state.projection);
    if (s->state.fragment) s->state.alpha_cutoff = 0;
    s->state.fragment = NULL;
    s->material = state->material ? *state->material : shade__white_lambert();

    shade__clip_rectangle(target, s->clip);    /* is not empty: shade__clip_fault */
    s->whole = s->clip[2] - s->clip[0] == target->width &&
               s->clip[3] - s->clip[1] == target->height;
    shade__camera_of(&s->state.projection, &s->state.view, &s->camera);
    s->farthest = (float)!(target->depth ? (int)shade__compare_of(&state->raster).greater
                                         : s->camera.reversed);

    s->dim = shade__dim_of(target);
}

/* ---- questions that need no drawing */

/* What the vertices of lines or a pipeline are. */
static shade__tally shade__vertices_of(const shade__survey *s)
{
    return shade__replay_of(s, s->replay->lines ? shade__point_vertex : NULL);
}

/* The SHADE__OUT_... bits that all corners share.  If z is 0 at the eye, but for the rounding of
   floats, depth is the same everywhere, and near and far cannot be told apart. */
static uint32_t shade__outside(const shade__survey *s)
{
    const double *z = s->camera.row[2];
    shade_mat4 m = shade__mat4_product(&s->state.projection, &s->state.view);
    uint32_t all = ~0u;
    if (s->replay) return shade__vertices_of(s).outside;
    m = shade__mat4_product(&m, &s->state.model);
    for (int i = 0; i < shade__corner_count(&s->mesh); i++) {
        const shade_vec3 p = shade__corner(&s->mesh, (uint32_t)i);
        const shade_vec4 c = shade_mat4_transform(m, shade__xyzw(p, 1));
        all &= shade__outcode(c.x, c.y, c.z, c.w, s->state.raster.depth_zero_to_one);
    }
    if (s->camera.perspective &&
        shade__abs(shade__dot3(z, s->camera.eye) + z[3]) <= 1e-6 * shade__abs(z[3]))
        all &= ~(uint32_t)(SHADE__OUT_NEAR | SHADE__OUT_FAR);
    return all;
}

/* Does the caller's depth buffer hold different values, because something was drawn before? */
static int shade__depth_varies(const shade_target *t)
{
    int clip[4];
    if (!t->depth) return 0;
    shade__clip_rectangle(t, clip);
    for (int y = clip[1]; y < clip[3]; y++)
        for (int x = clip[0]; x < clip[2]; x++)
            if (shade__float_bits(t->depth[shade__offset_of(t, x, y)]) !=
                shade__float_bits(t->depth[shade__offset_of(t, clip[0], clip[1])]))
                return 1;
    return 0;
}

static int shade__eye_inside(const shade__survey *s)
{
    const shade_mat4 object = shade__mat4_product(&s->state.view, &s->state.model);
    shade__camera c;
    shade_vec3 low, high, eye;
    shade__camera_of(&s->state.projection, &object, &c);
    shade_mesh_bounds(&s->mesh, &low, &high);
    eye = shade__single3(c.eye);
    return c.perspective && shade__is_zero(shade_sub(shade_clamp(eye, low, high), eye));
}

/* Is depth constant on planes at a right angle to the line of sight? */
static int shade__faces_ahead(const shade__camera *c)
{
    double across[3];
    shade__cross3(c->row[2], c->row[3], across);
    return c->perspective &&
           shade__dot3(across, across) <= 1e-10 * shade__dot3(c->row[2], c->row[2]) *
                                              shade__dot3(c->row[3], c->row[3]);
}

/*---------------------------------------------------------------------------------------- >>numbers
   Numbers that make no sense in any picture.
     in      a survey, or the mesh           out  a sentence, or SHADE__GO_ON
     way     no_mesh: arrays_cross, indices_are_halves; bad_number: bad_matrix, bad_lamp,
             positions_are_bad, floats_are_coarse, bad_attribute                         >>doubts */

/* A question has three answers: a sentence, or one of these. */
#define SHADE__GO_ON ((const char *)0)   /* nothing is found: the next question is asked */
#define SHADE__SILENT ""                 /* it may be meant: nothing is said, and no more asked */

/* The bytes that an array of the mesh spans: from its first element to the end of its last. */
typedef struct shade__span {
    uintptr_t from, to;
    int       stride;
} shade__span;

static shade__span shade__span_of(const shade_mesh *m, const float *array, int stride, int bytes)
{
    shade__span s;
    s.stride = stride ? stride : bytes;
    s.from = s.to = (uintptr_t)array;
    if (array) s.to += (uintptr_t)(m->vertex_count - 1) * (uintptr_t)s.stride + (uintptr_t)bytes;
    return s;
}

/* Do two arrays with different strides share bytes? */
static int shade__arrays_cross(const shade_mesh *m)
{
    const shade__span span[4] = { shade__span_of(m, m->positions, m->position_stride, 12),
                                  shade__span_of(m, m->normals, m->normal_stride, 12),
                                  shade__span_of(m, m->colors, m->color_stride, 12),
                                  shade__span_of(m, m->texcoords, m->texcoord_stride, 8) };
    for (int a = 0; a < 4; a++)
        for (int b = 0; b < a; b++)
            if (span[a].stride != span[b].stride && span[a].from < span[b].to &&
                span[b].from < span[a].to)
                return m->vertex_count > 1;
    return 0;
}

/* Are the indices 32-bit ones, read by halves?  The high halves of small indices are 0. */
static int shade__indices_are_halves(const shade_mesh *m)
{
    const int high = shade__low_byte_first();
    uint32_t others = 0;
    if (!m->indices16 || m->index_count < 6) return 0;
    for (int i = 0; i < m->index_count; i++) {
        if ((i & 1) != high) others |= m->indices16[i];
        else if (m->indices16[i]) return 0;
    }
    return others != 0;
}

/* Is the mesh empty, or are its arrays not those that were meant? */
static const char *shade__no_mesh(const shade_mesh *m)
{
    if (!shade__corner_count(m) || (m->chunks && !m->chunk_count))
        return "There is no triangle to draw: mesh.index_count is 0, or mesh.vertex_count without "
               "mesh.indices, or mesh.chunk_count with mesh.chunks.";
    if ((uint32_t)m->position_stride - 1 < 11 || (uint32_t)m->normal_stride - 1 < 11 ||
        (m->colors && (uint32_t)m->color_stride - 1 < 11) ||
        (m->texcoords && (uint32_t)m->texcoord_stride - 1 < 7))
        return "mesh.position_stride, normal_stride or color_stride is below 12, or "
               "texcoord_stride below 8, so that elements overlap; strides count bytes, not "
               "floats, and 0 means tightly packed.";
    if (shade__arrays_cross(m))
        return "Two arrays of the mesh run through each other with different strides: set "
               "position_stride, normal_stride, color_stride and texcoord_stride of interleaved "
               "vertices to the bytes of a whole vertex.";
    if (shade__indices_are_halves(m))
        return "Every other entry of mesh.indices16 is 0: the array holds indices of 32 bits, "
               "which belong in mesh.indices.";
    return SHADE__GO_ON;
}

/* ---- matrices and numbers of the state */

/* Does the last column hold what belongs in the last row?  That is (0, 0, 0, 1), or (0, 0, -1, 0)
   of a perspective, or (0, 0, 1, 0) of a left-handed one.  Two kinds of matrices look like that
   rightly, and give 0: those that flatten, for shadows on planes, and projections from one point,
   in which w grows with z alone. */
static int shade__is_transposed(const shade_mat4 *m)
{
    const shade_vec4 z = m->col[2], last = m->col[3];
    const int from_point = shade__w_by_z(m) &&
                           !shade__within(z.x * z.x + z.y * z.y + z.z * z.z - 1, 0.01f);
    if (shade_mat4_determinant(*m) == 0) return 0;
    if (last.w == 0)    /* z.w is not 0, 1 or -1 */
        return (last.z == 1 || last.z == -1) && z.w * (1 - z.w * z.w) != 0;
    return last.w == 1 && shade__is_zero(shade__xyz(last)) && !shade__is_affine(m) && !from_point;
}

/* Do the rows of z and w come from a perspective times a view: parallel, with w of length 1? */
static int shade__is_camera(const shade_mat4 *m)
{
    const shade_mat4 one = shade_mat4_identity();
    shade__camera c;
    shade__camera_of(m, &one, &c);
    return shade__faces_ahead(&c) && shade__abs(shade__dot3(c.row[3], c.row[3]) - 1) < 1e-3;
}

/* Does the matrix only turn, mirror and move? */
static int shade__is_rigid(const shade_mat4 *m)
{
    int rigid = shade__is_affine(m);
    for (int j = 0; j < 3; j++)
        for (int k = 0; k <= j; k++) {
            const float d = shade_dot(shade__xyz(m->col[j]), shade__xyz(m->col[k]));
            rigid &= shade__within(d - (float)(j == k), 0.01f);
        }
    return rigid;
}

/* Is the last row (0, 0, 0, w) with w other than 1? */
static int shade__scales_w(const shade_mat4 *m)
{
    return shade__w_by_z(m) && m->col[2].w == 0 && m->col[3].w != 1;
}

/* Is the view transposed, and does the picture change if it is not? */
static int shade__view_by_rows(const shade__survey *s)
{
    shade__survey q = *s;
    if (!shade__is_transposed(&s->state.view) || s->state.view.col[3].w == 0) return 0;
    q.state.view = shade_mat4_transpose(s->state.view);
    if (shade__is_transposed(&s->state.projection))
        q.state.projection = shade_mat4_transpose(s->state.projection);
    return shade__differ(&q, s);
}

/* Does state.model hold a perspective?  A matrix for shadows on a plane flattens. */
static int shade__model_is_camera(const shade__survey *q)
{
    const shade_mat4 one = shade_mat4_identity();
    shade__camera c;
    shade__camera_of(&q->state.model, &one, &c);
    return !shade__is_affine(&q->state.model) && shade__faces_ahead(&c) &&
           shade_mat4_determinant(q->state.model) != 0;
}

static const char shade__model_holds_projection[] =
    "state.model holds a projection, which belongs in state.projection: light is computed in the "
    "space that state.model leads to.";

static const char shade__projection_rows[] =
    "state.projection looks transposed (row-major): of a projection alone, the -1 belongs in "
    "col[2].w; pass it through shade_mat4_transpose.";

/* Do columns 0, 1 and 3 stand at right angles? */
static int shade__at_right_angles(const shade_mat4 *m)
{
    static const int pair[3][2] = { { 0, 1 }, { 0, 3 }, { 1, 3 } };
    int turned = 1;
    for (int k = 0; k < 3; k++) {
        const shade_vec3 a = shade__xyz(m->col[pair[k][0]]), b = shade__xyz(m->col[pair[k][1]]);
        turned &= shade__within(shade_dot(a, b), 1e-4f * shade_length(a) * shade_length(b));
    }
    return turned;
}

/* Is the transpose of m a camera without shear, though m is none?  Then its rows x, y and w, the
   columns of m, stand at right angles. */
static int shade__is_camera_by_rows(const shade_mat4 *m)
{
    const shade_mat4 turned = shade_mat4_transpose(*m);
    return !shade__is_affine(m) && !shade__is_camera(m) && shade__is_camera(&turned) &&
           shade__at_right_angles(m);
}

/* Does state.projection hold projection times view by rows? */
static int shade__camera_by_rows(const shade__survey *s)
{
    shade__survey q = *s;
    if (!shade__is_camera_by_rows(&s->state.projection)) return 0;
    q.state.projection = shade_mat4_transpose(s->state.projection);
    return shade__is_drawn(s) && shade__differ(&q, s);
}

static const char *shade__bad_matrix(const shade__survey *s)
{
    const shade_mat4 *model = &s->state.model, *view = &s->state.view, *p = &s->state.projection;
    if (!shade__is_finite(model) || !shade__is_finite(view) || !shade__is_finite(p))
        return "state.model, state.view or state.projection holds a NaN or infinity.";
    if (shade__is_transposed(model))
        return "state.model looks transposed (row-major): its translation belongs in col[3]; pass "
               "it through shade_mat4_transpose.";
    if (shade__view_by_rows(s))
        return "state.view looks transposed (row-major): its translation belongs in col[3]; pass "
               "it through shade_mat4_transpose.";
    if (shade__model_is_camera(s) && !s->given_state->fragment &&
        s->state.lighting.light_count > 0)
        return shade__model_holds_projection;
    if (shade__camera_by_rows(s))
        return "state.projection is row-major: it is no camera, but its transpose is one; pass it "
               "through shade_mat4_transpose.";
    if (shade__scales_w(model) || shade__scales_w(view))
        return "The last row of state.model or state.view is not 0, 0, 0, 1: set col[3].w to 1.";
    if (shade__is_zero(shade__xyz(p->col[0])) && p->col[0].w == 0)
        return "state.projection is the matrix that cameras return for bad arguments: fovy must be "
               "in radians and below pi (use shade_radians for degrees), near and far above 0 and "
               "different, the aspect not 0, left not equal to right, bottom not to top.";
    if (!shade__is_affine(view) || (!shade__is_rigid(view) && shade__is_rigid(p) &&
                                    !shade__is_zero(shade__xyz(p->col[3]))))
        return "state.view holds a projection, which belongs in state.projection: light takes the "
               "eye from state.view.  Are the two swapped?";
    if (p->col[3].w == 0 && p->col[2].z == 0 && shade__faces_ahead(&s->camera) &&
        !s->state.raster.depth_zero_to_one)
        return "state.projection comes from shade_mat4_perspective_reversed, which needs "
               "raster.depth_zero_to_one = 1, SHADE_COMPARE_GREATER and depth cleared to 0.";
    return SHADE__GO_ON;
}

static const char *shade__bad_lamp(const shade_light *l)
{
    const shade_vec3 least = shade_min(l->ambient, shade_min(l->diffuse, l->specular));
    const float *number = (const float *)l;
    for (size_t k = 0; k < sizeof *l / sizeof *number; k++)
        if (number[k] != number[k]) return "A light of lighting.lights holds a NaN.";
    if (!shade__is_zero(l->spot_direction) && !shade__within(l->spot_cos_cutoff, 1.001f))
        return "A light's spot_cos_cutoff is outside -1 .. 1: it is the cosine of the angle, not "
               "the angle; make the light with shade_spot_light.";
    if (shade_dot4(l->position, l->position) == 0 && !shade__is_zero(l->diffuse))
        return "A light's position is 0, 0, 0 with w = 0, a direction without length, so that it "
               "lights nothing; fill it with shade_directional_light or shade_point_light.";
    if (least.x < 0 || least.y < 0 || least.z < 0)
        return "A light of lighting.lights has a negative colour: it takes light away from what it "
               "shines on.";
    if (l->constant < 0 || l->linear < 0 || l->quadratic < 0)
        return "A light's constant, linear or quadratic is negative: attenuation divides by "
               "constant + linear r + quadratic r^2, at the distance r.";
    return SHADE__GO_ON;
}

/* Are corners beyond 1e12, or does the draw reject triangles, as for NaN and infinity? */
static int shade__positions_are_bad(const shade__survey *s)
{
    shade__survey all = *s;
    shade_vec3 low, high;
    all.mesh.chunks = NULL;
    all.mesh.chunk_count = 0;
    shade_mesh_bounds(&all.mesh, &low, &high);
    low = shade_max(high, shade_neg(low));
    return low.x > 1e12f || low.y > 1e12f || low.z > 1e12f || shade__stats_of(&all, 0).rejected > 0;
}

/* Does a triangle with an area use a float that is NaN, infinite, or so large (beyond 1e18) that
   its square may overflow? */
static int shade__attribute_is_wild(const shade_mesh *m, const float *array, int stride,
                                    int floats)
{
    const size_t bytes = (size_t)(stride ? stride : floats * 4);
    for (int i = 0; array && i < shade__corner_count(m) / 3 * 3; i++)
        for (int k = 0; k < floats; k++) {
            const size_t at = shade__corner_index(m, (uint32_t)i) * bytes + (size_t)k * 4;
            shade_vec3 p[3];
            float number;
            SHADE_MEMCPY(&number, (const char *)array + at, 4);
            if (!shade__within(number, 1e18f) &&
                !shade__is_zero(shade__face_normal(m, (uint32_t)i / 3, p)))
                return 1;
        }
    return 0;
}

/* Looks at the attributes that the draw reads. */
static const char *shade__bad_attribute(const shade__survey *s)
{
    const shade_mesh *m = s->given_mesh;
    const shade_draw_state *d = s->given_state;
    const int lit = d->lighting.light_count > 0 && d->shading != SHADE_SHADING_PER_FACE;
    if (!s->target->color) return SHADE__GO_ON;
    if ((d->fragment || lit) && shade__attribute_is_wild(m, m->normals, m->normal_stride, 3))
        return "mesh.normals hold NaN, infinite or huge numbers (beyond 1e18), which no lamp "
               "lights: normals must be floats, and mesh.normal_stride counts bytes; "
               "shade_mesh_normals fills them.";
    if (shade__attribute_is_wild(m, m->colors, m->color_stride, 3))
        return "mesh.colors hold NaN, infinite or huge numbers (beyond 1e18): they are three "
               "floats each, not bytes, and mesh.color_stride counts bytes.";
    if ((d->fragment || d->diffuse_map) &&
        shade__attribute_is_wild(m, m->texcoords, m->texcoord_stride, 2))
        return "mesh.texcoords hold NaN, infinite or huge numbers (beyond 1e18): they are two "
               "floats each, and mesh.texcoord_stride counts bytes.";
    return SHADE__GO_ON;
}

/* Are neighbouring floats at the mesh's farthest coordinate more than a pixel apart?  The mesh is
   taken to be sqrt(covered pixels) wide, or 16 if nothing is drawn. */
static int shade__floats_are_coarse(const shade__survey *s)
{
    shade_vec3 low, high, size, most;
    float step, wide, pixels = (float)shade__covered(s);
    if (!(s->given_stats && s->given_stats->fragments) && !shade__depth_varies(s->target))
        pixels = 256;
    shade_mesh_bounds(s->given_mesh, &low, &high);
    size = shade_sub(high, low);
    most = shade_max(high, shade_neg(low));
    wide = shade__maxf(size.x, shade__maxf(size.y, size.z));
    step = shade__maxf(most.x, shade__maxf(most.y, most.z)) * FLT_EPSILON / 2;
    return wide > 0 && step * shade__sqrt(pixels) > wide;
}

/* The number of triangles that a draw of the mesh counts. */
static long long shade__triangles_of(const shade_mesh *m)
{
    long long count = 0;
    if (!m->chunks) return shade__corner_count(m) / 3;
    for (int i = 0; i < m->chunk_count; i++) count += m->chunks[i].count;
    return count;
}

static int shade__chunks_leave_out(const shade_mesh *m)
{
    return shade__triangles_of(m) < shade__corner_count(m) / 3;
}

static const char *shade__bad_number(const shade__survey *s)
{
    const shade_lighting *l = &s->state.lighting;
    const char *why = shade__bad_matrix(s);
    if (s->given_stats && s->given_stats->triangles != shade__triangles_of(s->given_mesh))
        return "stats are not of this draw: they do not count as many triangles as the mesh has; "
               "pass the stats that shade_draw_mesh wrote.";
    if (!why && l->light_count < 0)
        why = "lighting.light_count is negative, which counts as 0; it counts lighting.lights.";
    for (int i = 0; i < l->light_count && !why; i++) why = shade__bad_lamp(&l->lights[i]);
    if (!why && shade__positions_are_bad(s))
        why = "mesh.positions hold NaN, infinite or huge numbers (beyond 1e12), or the matrices "
              "make them so: positions must be floats, and mesh.position_stride counts bytes.";
    if (!why && shade__floats_are_coarse(s))
        why = "mesh.positions lie so far from 0 that floats are too coarse for the mesh: subtract "
              "its middle from all positions, of the eye and the lamps as well, in double.";
    return why ? why : shade__bad_attribute(s);
}

/*----------------------------------------------------------------------------------------- >>doubts
   Numbers that are possible, but seldom right.
     in      a survey of a mesh that shows   out  a sentence, or SHADE__GO_ON
     way     doubt: chunks_leave_out, boxes_are_small; doubt_of_view, doubt_of_map,
             doubt_of_surface                                                            >>unseen */

static const char shade__left_out[] =
    "The counts of mesh.chunks sum to fewer triangles than the mesh has, and the others are not "
    "drawn: pass all the chunks that shade_mesh_chunks made, and check its result.";
static const char shade__wrong_box[] =
    "A box of mesh.chunks does not contain its triangles, so that they may vanish: call "
    "shade_mesh_chunks again after positions change.";

static int shade__boxes_are_small(const shade_mesh *m)
{
    int beyond = 0;
    for (int k = 0; k < m->chunk_count; k++) {
        const shade_chunk *given = &m->chunks[k];
        shade_chunk c = *given;
        shade__box_chunk(m, &c);
        if (given->low.x <= given->high.x && c.low.x <= c.high.x)
            beyond += !shade__is_zero(shade_sub(shade_min(c.low, given->low), given->low)) +
                      !shade__is_zero(shade_sub(shade_max(c.high, given->high), given->high));
    }
    return beyond;
}

/* The map, if the library reads it and not a shader of the caller. */
static const shade_texture *shade__map_of(const shade__survey *s)
{
    return s->target->color && !s->given_state->fragment ? s->given_state->diffuse_map : NULL;
}

/* Does u go up to the width of the map in texels? */
static int shade__u_reaches(const shade_mesh *m, int width)
{
    const size_t stride = m->texcoord_stride ? (size_t)m->texcoord_stride : 8;
    float most = 0, u;
    for (int i = 0; i < m->vertex_count; i++) {
        SHADE_MEMCPY(&u, (const char *)m->texcoords + (size_t)i * stride, sizeof u);
        if (u > most) most = u;
    }
    return width >= 16 && most >= (float)(width - 1) && most <= (float)width;
}

/* Has a level another size than shade_build_mipmaps gives it? */
static int shade__levels_differ(const shade_texture *map)
{
    int differ = 0;
    for (int k = 1; map->mipmaps && k <= map->mipmap_count && k <= 16; k++)
        differ |= map->mipmaps[k - 1].width != shade__max(1, map->width >> k) ||
                  map->mipmaps[k - 1].height != shade__max(1, map->height >> k);
    return differ;
}

static const char *shade__doubt_of_map(const shade__survey *s)
{
    const shade_texture *map = shade__map_of(s);
    const char *why;
    if (!map) return SHADE__GO_ON;
    why = shade__texture_fault(map);
    if (why) return why;
    if (!s->mesh.texcoords)
        return "state.diffuse_map is set while mesh.texcoords is NULL, so that it is not drawn.";
    if (shade_mipmap_count(map->width, map->height) &&
        (map->filter == SHADE_FILTER_TRILINEAR || map->mipmap_count) &&
        (!map->mipmaps || map->mipmap_count <= 0))
        return "state.diffuse_map has SHADE_FILTER_TRILINEAR or a mipmap_count, but no mipmaps; "
               "fill them with shade_build_mipmaps.";
    if (map->filter == SHADE_FILTER_TRILINEAR && shade__levels_differ(map))
        return "A level of state.diffuse_map.mipmaps is not max(1, width >> k) by "
               "max(1, height >> k) texels, for k from 1 on: fill them with shade_build_mipmaps.";
    if (shade__u_reaches(&s->mesh, map->width))
        return "mesh.texcoords reach the width of state.diffuse_map: they go from 0 to "
               "1 over the map, whatever its size.";
    return SHADE__GO_ON;
}

/* Is the aspect of the projection, computed from its rows x and y across the line of sight, other
   than the picture's, and does that show?  Cells of a terminal are twice as high as wide. */
static int shade__aspect_is_wrong(const shade__survey *s)
{
    const shade_mat4 none = shade_mat4_identity();
    const double w = s->target->width, h = s->target->height;
    double x[3], y[3], wide, high;
    shade__survey mended = *s;
    shade__camera c;
    shade__camera_of(&s->state.projection, &none, &c);
    shade__cross3(c.row[0], c.sight, x);
    shade__cross3(c.row[1], c.sight, y);
    wide = shade__dot3(x, x) * w * w;
    high = shade__dot3(y, y) * h * h;
    if (s->state.projection.col[3].w != 0 || !shade__faces_ahead(&c) ||
        shade__abs(shade__dot3(x, y) * w * h) > 1e-3 * wide ||
        (h < 128 && shade__abs(wide - 4 * high) < 0.24 * high) ||
        shade__abs(wide - high) <= 0.06 * wide)
        return 0;
    for (int k = 0; k < 4; k++)
        mended.state.projection.col[k].x *= shade__sqrt((float)(high / wide));
    return shade__differ(s, &mended);
}

static const char *shade__doubt_of_view(const shade__survey *s)
{
    const shade_mat4 *p = &s->state.projection;
    if (!shade__is_rigid(&s->state.view) && !shade__is_rigid(p))
        return "state.view scales or shears, but it must only turn and move, as shade_mat4_look_at "
               "does; scale by state.model.";
    if (shade__aspect_is_wrong(s))
        return "The aspect of state.projection is not that of the picture: pass width / height of "
               "the target as floats to shade_mat4_perspective.";
    if (s->given_state->view.col[3].w == 0 && p->col[3].w == 0 && p->col[3].x == 0 &&
        p->col[3].y == 0 && shade__eye_inside(s))
        return "state.view is unset, so that the eye is at the origin, inside the mesh's box; make "
               "it with shade_mat4_look_at.";
    return SHADE__GO_ON;
}

static const char *shade__doubt_of_surface(const shade__survey *s)
{
    const shade_draw_state *d = s->given_state;
    const shade_vec3 e = s->material.emission;
    if (s->target->color && !d->fragment && d->lighting.light_count > 0 && !d->lighting.terms &&
        e.x >= 1 && e.y >= 1 && e.z >= 1 && s->target->format != SHADE_FORMAT_RGBA32F &&
        d->lighting.model < SHADE_MODEL_EMISSIVE && !shade__is_zero(s->material.diffuse))
        return "state.material.emission alone makes everything white, whatever light arrives: it "
               "is the light that a surface emits by itself, 0 for most.";
    return SHADE__GO_ON;
}

static const char *shade__doubt(const shade__survey *s)
{
    const shade_target *t = s->target;
    const shade_raster *r = &s->given_state->raster;
    const char *why;
    if (shade__chunks_leave_out(s->given_mesh)) return shade__left_out;
    if (shade__boxes_are_small(s->given_mesh)) return shade__wrong_box;
    if ((t->clip_x > 0 && t->clip_width > shade__max(t->width / 2, t->width - t->clip_x)) ||
        (t->clip_y > 0 && t->clip_height > shade__max(t->height / 2, t->height - t->clip_y)))
        return "target.clip_x + clip_width or clip_y + clip_height lies beyond the picture: they "
               "are sizes, not the other corner.";
    if (t->depth && (r->depth_bias >= 1 || r->depth_bias <= -1))
        return "raster.depth_bias makes the depth of all pixels 0 or 1: it is added to depths from "
               "0 to 1, so even 1e-5 is large.";
    why = shade__doubt_of_view(s);
    if (!why) why = shade__doubt_of_map(s);
    return why ? why : shade__doubt_of_surface(s);
}

/*----------------------------------------------------------------------------------------- >>unseen
   Why no pixel of the whole picture shows the draw: of a mesh, of lines or of a pipeline.
     in      a survey                        out  a sentence, or another answer
     way     climb the ladder nothing: climb_to
     method  Ladders: tables of questions and answers, tried from top to bottom.  For example: with
             culling off, are there pixels?  Then raster.cull is at fault.               >>hidden */

/* ---- ladders */

typedef struct shade__rung {
    int (*holds)(shade__survey *q);      /* asks whether the answer is true; may change q */
    const char *answer;
    int (*mend)(shade__survey *q);       /* does what the sentence advises; returns whether the
                                            mesh then shows.  NULL: there is nothing to try */
} shade__rung;

enum {
    SHADE__RUNGS = 24,                   /* more than any ladder has: the rest is zero */
    SHADE__EACH_ALONE = 0,               /* each rung changes a copy of its own */
    SHADE__KEEPS_CHANGES = 1             /* a rung sees the changes of all rungs above it, so that
                                            two faults at once are found */
};

/* Rungs are tried from top to bottom; the first that holds gives the answer. */
typedef struct shade__ladder {
    int changes;                         /* SHADE__EACH_ALONE or SHADE__KEEPS_CHANGES */
    shade__rung rung[SHADE__RUNGS];      /* ends with zeros */
} shade__ladder;

/* Returns the first rung that holds, or NULL; never NULL if the ladder ends with shade__always. */
static const shade__rung *shade__climb_to(const shade__survey *s, const shade__ladder *ladder)
{
    shade__survey q = *s;
    for (const shade__rung *rung = ladder->rung; rung->holds; rung++) {
        if (ladder->changes == SHADE__EACH_ALONE) q = *s;
        if (rung->holds(&q)) return rung;
    }
    return NULL;
}

static const char *shade__climb(const shade__survey *s, const shade__ladder *ladder)
{
    const shade__rung *rung = shade__climb_to(s, ladder);
    return rung ? rung->answer : SHADE__GO_ON;
}

/* Does the advice of a rung help by itself, with all else as given?  If not, there are several
   faults. */
static int shade__helps(const shade__survey *seen, const shade__rung *rung)
{
    shade__survey q = *seen;
    return rung->mend && rung->mend(&q);
}

static int shade__always(shade__survey *q) { return q != NULL; }

static int shade__appears(shade__survey *q) { return shade__covered(q) > 0; }

/* ---- no pixel of the whole picture shows it */

static int shade__chunks_are_few(shade__survey *q)
{
    q->mesh.chunks = NULL;
    q->mesh.chunk_count = 0;
    return shade__chunks_leave_out(q->given_mesh) && shade__covered(q);
}

static int shade__culled_inside(shade__survey *q)
{
    q->state.raster.cull = SHADE_CULL_NONE;
    return shade__eye_inside(q) && shade__covered(q);
}

static int shade__fronts_are_culled(shade__survey *q)
{
    return q->given_state->raster.cull == SHADE_CULL_FRONT && shade__covered(q);
}

/* Is the mesh one of many in a scene, with fragments for less than a quarter of the picture?  Such
   a mesh may well be hidden, or seen edge-on. */
static int shade__is_scattered(shade__survey *q)
{
    return shade__covered(q) * 4 < (long long)q->target->width * q->target->height &&
           shade__depth_varies(q->target);
}

static int shade__all_cut(shade__survey *q)
{
    q->state.alpha_cutoff = 0;
    return shade__appears(q);
}

static int shade__projection_by_rows(shade__survey *q)
{
    shade__survey turned = *q;
    turned.state.projection = shade_mat4_transpose(q->state.projection);
    if (!shade__is_transposed(&q->state.projection) &&
        !shade__is_camera_by_rows(&q->state.projection))
        return 0;
    return !q->replay && shade__covered(&turned);
}

/* Does every triangle lie outside of the view volume? */
static int shade__is_beside(shade__survey *q)
{
    const shade_stats stats = shade__stats_of(q, 0);
    return stats.clipped + stats.rejected == stats.triangles;
}

static int shade__model_has_camera(shade__survey *q) { return shade__model_is_camera(q); }

static int shade__model_projects(shade__survey *q) { return !shade__is_affine(&q->state.model); }

static int shade__projection_is_none(shade__survey *q)
{
    return !q->replay && shade__is_rigid(&q->state.projection) && shade__is_beside(q);
}

/* The bits of the plane where depth is greatest, counted from the eye. */
static uint32_t shade__far_plane(const shade__survey *s)
{
    const int reversed = s->replay ? s->farthest == 0 : s->camera.reversed;
    return reversed ? SHADE__OUT_NEAR : SHADE__OUT_FAR;
}

static int shade__w_is_zero(shade__survey *q)
{
    return q->replay && shade__is_beside(q) && !shade__vertices_of(q).any_w;
}

/* Is w 1 everywhere, as without a projection?  Degenerate cameras make x and y 0 as well. */
static int shade__w_is_one(shade__survey *q)
{
    shade__tally t;
    if (!q->replay || q->replay->lines || !shade__is_beside(q)) return 0;
    t = shade__vertices_of(q);
    return t.any_xy && !t.other_w;
}

static int shade__beyond_far(shade__survey *q)
{
    const uint32_t out = shade__is_beside(q) ? shade__outside(q) : 0;
    return (out & shade__far_plane(q)) && (q->replay || !(out & SHADE__OUT_W));
}

static int shade__view_is_inverse(shade__survey *q)
{
    shade__survey inverse = *q;
    if (q->replay) return 0;
    inverse.state.view = shade_mat4_inverse(q->state.view);
    return shade__appears(&inverse);
}

static int shade__behind_eye(shade__survey *q)
{
    return shade__is_beside(q) && (shade__outside(q) & SHADE__OUT_W);
}

static int shade__before_near(shade__survey *q)
{
    return shade__is_beside(q) && (shade__outside(q) & (SHADE__OUT_NEAR | SHADE__OUT_FAR));
}

/* ---- the matrix of lines */

/* Is the draw one of lines?  Then *m is their matrix. */
static int shade__matrix_of(const shade__survey *q, shade_mat4 *m)
{
    if (!q->replay || !q->replay->lines) return 0;
    *m = shade__or_identity(q->replay->lines->clip_from_points);
    return 1;
}

static int shade__matrix_is_none(shade__survey *q)
{
    shade_mat4 m;
    return shade__matrix_of(q, &m) && shade__is_rigid(&m) && shade__is_beside(q);
}

/* Is w = -z, as in view times projection, though the rest is not a projection?  In one, far is
   -col[3].z / (col[2].z + 1), which is not negative beyond rounding. */
static int shade__matrix_is_exchanged(shade__survey *q)
{
    shade_mat4 m;
    return shade__matrix_of(q, &m) && shade__w_by_z(&m) && m.col[2].w == -1 && m.col[3].w == 0 &&
           shade__at_right_angles(&m) &&    /* as in view times projection */
           (!shade__is_camera(&m) || (m.col[2].z > -0.99f && m.col[3].z < 0));
}

/* Do the lines show with the transposed matrix?  If they show with the given one, only a transposed
   one that is a camera without shear proves it. */
static int shade__matrix_by_rows(shade__survey *q)
{
    shade__survey shown = *q;
    shade__stroke stroke;
    shade__replay by_rows;
    shade_mat4 m, turned;
    if (!shade__matrix_of(q, &m)) return 0;
    turned = shade_mat4_transpose(m);
    if (shade__appears(q) && !shade__is_camera_by_rows(&m)) return 0;
    if (!shade__is_transposed(&m) && (shade__is_affine(&m) || shade__is_camera(&m) ||
                                      !shade__is_camera(&turned)))
        return 0;

    by_rows = *q->replay;
    stroke = *by_rows.stroke;
    shade__doubles(shade__entries(&turned), 16, stroke.clip_from_points);
    by_rows.pipe.uniforms = &stroke;
    shown.replay = &by_rows;
    return shade__appears(&shown);
}

static const char shade__lines_by_rows[] =
    "state.clip_from_points looks transposed (row-major): pass it through shade_mat4_transpose.";

/* ---- why nothing is in view */

static const shade__ladder shade__nothing = {
    SHADE__KEEPS_CHANGES, {
        { shade__chunks_are_few, shade__left_out, NULL },
        { shade__appears, shade__wrong_box, NULL },
        { shade__culled_inside,
          "raster.cull leaves out every triangle in view, and the eye lies inside the mesh's box: "
          "set state.view, or move the eye out.", NULL },
        { shade__fronts_are_culled,
          "raster.cull is SHADE_CULL_FRONT, and every triangle in view is front-facing; use "
          "SHADE_CULL_BACK or SHADE_CULL_NONE.", NULL },
        { shade__appears,
          "raster.cull is SHADE_CULL_BACK, and every triangle in view faces away: front is "
          "counter-clockwise on the screen.  Reverse the winding, or use SHADE_CULL_NONE; a "
          "state.model that mirrors, or another matrix, reverses it as well.", NULL },
        { shade__is_scattered, SHADE__SILENT, NULL },
        { shade__all_cut,
          "state.alpha_cutoff is above every alpha of the mesh, (1 - transparency) times the "
          "alpha of diffuse_map; lower it.", NULL },
        { shade__projection_by_rows, shade__projection_rows, NULL },
        { shade__matrix_is_none,
          "Every line lies outside the cube from -1 to 1: state.clip_from_points is unset, or not "
          "a projection; it is projection times view, in this order.", NULL },
        { shade__matrix_is_exchanged,
          "state.clip_from_points looks like view times projection: shade_mat4_mul takes "
          "projection first, then view.", NULL },
        { shade__matrix_by_rows, shade__lines_by_rows, NULL },
        { shade__model_has_camera, shade__model_holds_projection, NULL },
        { shade__model_projects, SHADE__SILENT, NULL },
        { shade__projection_is_none,
          "Every triangle lies outside the cube from -1 to 1: state.projection is unset, or not a "
          "projection; make it with shade_mat4_perspective or shade_mat4_ortho.", NULL },
        { shade__w_is_zero,
          "w is 0 everywhere: pipeline.vertex must write out->clip[3], which is 1 without a "
          "projection; or the matrix is not projection times view, in this order.", NULL },
        { shade__w_is_one,
          "All of it lies beside the picture, before near or beyond far, and w is 1 everywhere: "
          "pipeline.vertex must write projection times view times model times (P, 1).  If that is "
          "shade_mat4_ortho, its box must hold the positions.", NULL },
        { shade__beyond_far,
          "All of it lies beyond the far plane of the projection (state.projection); raise far, or "
          "move the eye nearer.  A camera made with near = far, with degrees for radians, or with "
          "an aspect of 0 puts all there.", NULL },
        { shade__view_is_inverse,
          "The mesh is out of view, but the inverse of state.view would show it: state.view takes "
          "the world to the eye, as shade_mat4_look_at does.", NULL },
        { shade__behind_eye,
          "All of it lies behind the eye, where w is negative: a camera looks down -z in its own "
          "space; check the view and the model matrix.", NULL },
        { shade__before_near,
          "All of it lies nearer than the near plane of the projection (state.projection), or "
          "behind the eye; lower near, or move the eye back.", NULL },
        { shade__is_beside,
          "All of it lies beside the picture, before near or beyond far; check state.model, and "
          "where the camera looks (state.view, state.projection), or what takes their place.",
          NULL },
        { shade__always,
          "No pixel centre is covered: all is too small on the screen, seen edge-on, beside the "
          "picture, or without area, because a scale of state.model is 0, corners coincide (equal "
          "entries of mesh.indices), or state.width of lines is far below 1.", NULL },
    }
};

/*----------------------------------------------------------------------------------------- >>hidden
   Why a draw that covers pixels stored none of them, or perhaps none.
     in      a survey                        out  a sentence, or another answer
     way     climb the ladders wrong_test and not_stored
     holds   A mesh outside one band or strip is not reported, because another band may show it.
                                                                                          >>black */

static const char shade__all_discarded[] =
    "state.fragment discards all pixels of the mesh, or gives them an alpha below "
    "state.alpha_cutoff.";

/* Would the reverse test show another depth in some pixel? */
static int shade__test_is_turned(shade__survey *q)
{
    const shade_raster *r = &q->given_state->raster;
    return q->target->depth && shade__faces_ahead(&q->camera) && !r->depth_read_only &&
           r->depth_test < SHADE_COMPARE_EQUAL && (float)q->camera.reversed == q->farthest &&
           shade__hides_nearest(q, 0);
}

/* Is near beyond far in a perspective?  With C = col[2].z and D = col[3].z, near = D / (C - 1) and
   far = D / (C + 1). */
static int shade__near_is_beyond_far(shade__survey *q)
{
    const shade_mat4 *p = &q->state.projection;
    const float c = p->col[2].z, d = p->col[3].z;
    return p->col[2].w == -1 && p->col[3].w == 0 && !q->state.raster.depth_zero_to_one &&
           d / (c - 1) > d / (c + 1) && d / (c + 1) > 0 && shade__test_is_turned(q);
}

static const shade__ladder shade__wrong_test = {
    SHADE__EACH_ALONE, {
        { shade__near_is_beyond_far,
          "near of state.projection is beyond far, which turns depth round, so that nothing passes "
          "or far surfaces hide near ones: exchange the two; or, if it is meant, use "
          "SHADE_COMPARE_GREATER with depth cleared to 0.", NULL },
        { shade__test_is_turned,
          "raster.depth_test does not fit state.projection, so that nothing passes or far surfaces "
          "hide near ones: use SHADE_COMPARE_LESS with depth cleared to 1, or with "
          "shade_mat4_perspective_reversed SHADE_COMPARE_GREATER with depth cleared to 0.", NULL }
    }
};

/* Is the clip rectangle the whole picture, or a band or strip of it?  Other bands may show what
   this one does not. */
static int shade__is_band(const shade_target *t)
{
    int clip[4];
    shade__clip_rectangle(t, clip);
    return t->row_count || clip[2] - clip[0] == t->width || clip[3] - clip[1] == t->height;
}

static int shade__beside_clip(shade__survey *q)
{
    shade__look_in_clip(q);
    return !shade__is_band(q->target) && !shade__covered(q);
}

/* Does the mesh have pixels in the clip rectangle, and does none of them pass the depth test? */
static int shade__is_hidden(const shade__survey *s)
{
    shade__survey q = *s;
    shade__look_in_clip(&q);
    return shade__covered(&q) && !shade__passed(s);
}

static int shade__shader_discards(shade__survey *q)
{
    return q->given_stats && q->given_state->fragment && !q->replay && shade__passed(q);
}

/* Do all pixels have the depth of the far plane, with the bias of s, so that they never pass a test
   without equality? */
static int shade__is_far(const shade__survey *s)
{
    const shade_compare test = s->given_state->raster.depth_test;
    shade__survey q = *s;
    shade__look_at_all(&q);
    q.far_margin = FLT_MIN;
    return (test == SHADE_COMPARE_LESS || test == SHADE_COMPARE_GREATER) && !shade__covered(&q);
}

/* Was depth not cleared?  Without stats the mesh itself may be stored. */
static int shade__depth_uncleared(shade__survey *q)
{
    if (!shade__is_hidden(q) || q->state.raster.depth_test == SHADE_COMPARE_EQUAL ||
        shade__is_drawn(q))
        return 0;
    shade__look_through(q, q->farthest > 0 ? SHADE_COMPARE_LESS : SHADE_COMPARE_GREATER);
    q->state.raster.depth_bias = 1 - 2 * q->farthest;    /* not even the nearest depth passes */
    if (shade__covered(q)) return 0;

    q->state.raster.depth_bias = 0;
    return !shade__is_far(q);
}

/* Is the mesh hidden in the whole picture, and not a small part of a scene?  Sets q's bias to 0. */
static int shade__all_hidden(shade__survey *q)
{
    const int hidden = (q->whole || (q->replay && !shade__is_band(q->target))) &&
                       shade__is_hidden(q);
    q->state.raster.depth_bias = 0;
    return hidden && !shade__is_scattered(q);
}

static int shade__nothing_is_equal(shade__survey *q)
{
    return q->given_state->raster.depth_test == SHADE_COMPARE_EQUAL && shade__all_hidden(q);
}

static int shade__depth_is_far(shade__survey *q)
{
    if ((!q->replay && !q->camera.perspective) || !shade__is_far(q)) return 0;    /* as biased */
    return shade__all_hidden(q) && shade__is_far(q);    /* it has set the bias to 0 */
}

/* Do more than half of the pixels of lines pass if depth is off by 2e-6?  Planes that coincide
   differ by less. */
static int shade__lines_lie_in_surfaces(shade__survey *q)
{
    const shade_compare test = q->given_state->raster.depth_test;
    long long all;
    if (!q->replay || !q->replay->lines || test == SHADE_COMPARE_EQUAL || shade__is_drawn(q))
        return 0;
    shade__look_in_clip(q);
    all = shade__covered(q);
    shade__look_through(q, q->farthest > 0 ? SHADE_COMPARE_LESS : SHADE_COMPARE_GREATER);
    q->state.raster.depth_bias = 2e-6f * (1 - 2 * q->farthest);
    return shade__covered(q) * 2 > all;
}

static int shade__depth_hides(shade__survey *q)
{
    const int hidden = !shade__is_drawn(q) || shade__is_far(q);    /* with the given bias */
    if (!hidden || !shade__all_hidden(q)) return 0;
    q->far_margin = 1e-6f;    /* floats are too coarse to tell which is nearer */
    return shade__covered(q) > 0;
}

static const shade__ladder shade__not_stored = {
    SHADE__EACH_ALONE, {
        { shade__beside_clip,
          "All of it lies beside the clip rectangle of target.clip_x, clip_y, clip_width and "
          "clip_height; all four zero mean everywhere.", NULL },
        { shade__shader_discards, shade__all_discarded, NULL },
        { shade__nothing_is_equal,
          "raster.depth_test is SHADE_COMPARE_EQUAL, but target.depth does not hold the depth of "
          "what is drawn: draw it with SHADE_COMPARE_LESS, first or instead.", NULL },
        { shade__depth_uncleared,
          "target.depth holds 0 where it is drawn (1 with SHADE_COMPARE_GREATER) or NaN, so that "
          "nothing passes raster.depth_test: call shade_clear before drawing, with a depth of 1, "
          "or of 0 for a reversed projection.", NULL },
        { shade__depth_is_far,
          "Every pixel has the depth of the far plane, so that nothing passes raster.depth_test.  "
          "For a sky, use SHADE_COMPARE_LESS_EQUAL (reversed: SHADE_COMPARE_GREATER_EQUAL); else "
          "near of the projection is too small for floats, compared with far: raise near.", NULL },
        { shade__lines_lie_in_surfaces,
          "The lines lie in surfaces that target.depth already holds, and these hide them: use "
          "SHADE_COMPARE_LESS_EQUAL and a small negative raster.depth_bias; or call shade_clear, "
          "if they are lines of the frame before.", NULL },
        { shade__depth_hides,
          "It is hidden by depth that target.depth already holds: from other draws, from the frame "
          "before if shade_clear was not called, or from a draw of the same triangles, which then "
          "need SHADE_COMPARE_LESS_EQUAL; or raster.depth_bias pushes it back.", NULL }
    }
};

/*------------------------------------------------------------------------------------------ >>black
   Why a mesh is drawn, but black: the surface, then the lamps.
     in      a survey                        out  the rung that holds, and whether its advice helps
     way     climb_to: the ladder black; helps: the mend of its rung
     holds   A sentence is true of the visible pixels: of all, or of the share that its rung tests.
             Black: none is brighter than 8 of 255.                                       >>wrong */

/* ---- other surfaces and lamps */

/* The mesh and its map are white; the map keeps its holes. */
static void shade__drop_colors(shade__survey *q)
{
    q->mesh.colors = NULL;
    q->white_map = 1;
}

/* The material reflects all light, with wide highlights; white Lambert, for NULL, stays without. */
static void shade__polish(shade__survey *q)
{
    const shade_vec3 one = shade_v3(1, 1, 1);
    q->material.diffuse = q->material.ambient = one;
    if (q->given_state->material) q->material.specular = one;
    q->material.shininess = shade__minf(shade__maxf(q->material.shininess, 1), 4);
}

static void shade__whiten(shade__survey *q)
{
    shade__drop_colors(q);
    shade__polish(q);
}

/* One white lamp, and no other light. */
static void shade__light_by(shade__survey *q, shade_vec4 position, unsigned flags)
{
    shade_lighting *l = &q->state.lighting;
    SHADE__ZERO(*l);
    l->light_count = 1;
    l->flags = flags;
    q->lamps_replaced = 1;
    q->lamp[0] = shade_point_light(shade_v3(0, 0, 0), shade_v3(1, 1, 1));
    q->lamp[0].position = position;
}

/* Copies the first of the given lamps into the survey. */
static void shade__copy_lamps(shade__survey *q)
{
    shade_lighting *l = &q->state.lighting;
    l->light_count = shade__min(l->light_count, SHADE__SUSPECTS);
    q->lamps_replaced = 1;
    for (int i = 0; i < l->light_count; i++) q->lamp[i] = l->lights[i];
}

/* The first of the given lamps, without attenuation and exponent. */
static void shade__light_everywhere(shade__survey *q)
{
    shade__copy_lamps(q);
    for (int i = 0; i < q->state.lighting.light_count; i++) {
        shade_light *lamp = &q->lamp[i];
        lamp->constant = lamp->linear = lamp->quadratic = lamp->spot_exponent = 0;
    }
}

/* One white lamp at the eye, and no other light. */
static void shade__light_from_eye(shade__survey *q)
{
    const shade__camera *c = &q->camera;
    const double *at = c->perspective ? c->eye : c->sight;
    const float sign = c->perspective ? 1 : 1 - 2 * q->farthest;    /* sight leads to depth 1 */
    shade__light_by(q, shade_v4((float)at[0] * sign, (float)at[1] * sign, (float)at[2] * sign,
                                (float)c->perspective), 0);
}

/* The lamps lose their cones.   pre: shade__copy_lamps */
static void shade__open_cones(shade__survey *q)
{
    for (int i = 0; i < q->state.lighting.light_count; i++)
        q->lamp[i].spot_direction = shade_v3(0, 0, 0);
}

static void shade__whiten_lamps(shade__survey *q)
{
    for (int i = 0; i < q->state.lighting.light_count; i++)
        q->lamp[i].diffuse = q->lamp[i].specular = shade_v3(1, 1, 1);
}

/* Lights every fragment, where there is room for its position and normal. */
static void shade__light_fragments(shade__survey *q)
{
    if (SHADE_MAX_VARYINGS > (q->state.diffuse_map ? 7 : 5))
        q->state.shading = SHADE_SHADING_PER_FRAGMENT;
}

/* ---- the mesh is drawn, but black: the surface */

/* True if the mesh shows once blending is off, or if even a white emissive surface stays invisible.
   From here on blending is off. */
static int shade__alpha_is_zero(shade__survey *q)
{
    shade__survey glow = *q;
    const int blended = q->state.raster.blend != SHADE_BLEND_REPLACE;
    glow.material.emission = shade_v3(1, 1, 1);
    glow.state.lighting.model = SHADE_MODEL_EMISSIVE;
    glow.state.lighting.terms = 0;
    q->state.raster.blend = SHADE_BLEND_REPLACE;
    return blended && (!shade__shows(&glow) || shade__shows(q));
}

/* Outlines made of back faces are black on purpose, and so are shadows blended over a ground. */
static int shade__black_is_meant(shade__survey *q)
{
    const shade_raster *r = &q->given_state->raster;
    const shade_material *m = &q->material;
    const shade_vec3 most = shade_max(shade_max(m->emission, m->ambient),
                                      shade_max(m->diffuse, m->specular));
    return shade__is_zero(most) && (r->cull == SHADE_CULL_FRONT || r->blend == SHADE_BLEND_OVER);
}

static int shade__shading_is_coarse(shade__survey *q)
{
    shade__light_fragments(q);
    return shade__lights_up(q);
}

/* Do face normals give light that SHADE_SHADING_PER_FRAGMENT would not? */
static int shade__faces_are_lit(shade__survey *q)
{
    if (q->given_state->shading != SHADE_SHADING_PER_FACE) return 0;
    q->mesh.normals = NULL;
    return shade__shows(q);
}

static int shade__terms_are_few(shade__survey *q)
{
    shade_lighting *l = &q->state.lighting;
    l->terms = 0;
    if (l->model > SHADE_MODEL_PHONG) l->model = SHADE_MODEL_BLINN_PHONG;
    return shade__lights_up(q);
}

/* Are the colours dark even under white ambient light, and does the mesh show without them? */
static int shade__colors_are_black(shade__survey *q)
{
    shade__survey evenly = *q;
    evenly.material.ambient = evenly.state.lighting.ambient = shade_v3(1, 1, 1);
    evenly.state.lighting.model = SHADE_MODEL_AMBIENT;
    evenly.state.lighting.terms = SHADE_TERM_AMBIENT;
    if (shade__bright(&evenly)) return 0;

    shade__drop_colors(q);
    return shade__lights_up(q);
}

static int shade__material_is_black(shade__survey *q)
{
    shade__whiten(q);
    return shade__bright(q) && shade__lights_up(q);
}

static const char shade__transparent[] =
    "Alpha is 0, or so small that blending leaves nothing of the mesh: it is 1 - "
    "state.transparency, times the alpha of state.diffuse_map.";
static const char shade__behind[] =
    "Every lamp is behind nine tenths or more of the visible pixels, on the side that the normals "
    "point away from: turn mesh.normals (or the winding, if there are no normals), move "
    "light.position, which is in world space, or reverse the direction in which light travels, set "
    "SHADE_FLAG_TWO_SIDED, or check state.view: is the eye inside the mesh?";
static const char shade__black_colors[] =
    "mesh.colors, or the texels of state.diffuse_map, are black where the mesh is in view; "
    "check mesh.texcoords and the picture.";
static const char shade__no_normals[] =
    "mesh.normals are zero or NaN, so that no lamp lights them; fill them with shade_mesh_normals, "
    "or make mesh.normals NULL.";
static const char shade__fall_off[] =
    "Attenuation, or spot_exponent, leaves too little of every light to be seen; lower its "
    "constant, linear or quadratic, or raise the light's diffuse and specular.";
static const char shade__no_cone[] =
    "No cone of a spotlight shows on the visible pixels; check spot_direction and spot_cos_cutoff, "
    "the cosine of an angle in radians.";
static const char shade__no_color[] =
    "The lights have no colour, or are too dark: raise light.diffuse, or move them so that they do "
    "not only graze the visible surfaces; no highlight reaches the eye.";
static const char shade__multiply[] =
    "The visible pixels are black or almost: state.material, mesh.normals, mesh.colors, the map, "
    "alpha, lighting.terms and the lights work together, and several of them may be at fault.";

/* ---- the mesh is black, or lit by ambient light alone: the lamps */

static int shade__lights_are_none(shade__survey *q)
{
    return q->state.lighting.light_count <= 0 && !shade__shows(q);
}

static int shade__count_is_zero(shade__survey *q)
{
    return q->state.lighting.lights && shade__lights_are_none(q);
}

/* Are all normals in view zero or NaN?  Ungated highlights of exponent 0 are 1 for all others. */
static int shade__lacks_normals(shade__survey *q)
{
    shade__survey ungated = *q;
    shade__light_by(&ungated, shade_v4(0, 0, 1, 0), SHADE_FLAG_UNGATED_SPECULAR);
    ungated.material.specular = shade_v3(1, 1, 1);
    ungated.material.shininess = 0;
    return q->mesh.normals && q->state.shading != SHADE_SHADING_PER_FACE && !shade__shows(&ungated);
}

/* Leaves only the terms of lamps in the survey, without blending.  Returns whether any is left. */
static int shade__lamps_alone(shade__survey *q)
{
    shade_lighting *l = &q->state.lighting;
    const unsigned lamps = SHADE_TERM_DIFFUSE | SHADE_TERM_SPECULAR;
    l->terms = (l->terms ? l->terms : ~0u) & lamps;
    q->state.raster.blend = SHADE_BLEND_REPLACE;
    return l->model <= SHADE_MODEL_LAMBERT && l->terms;
}

/* Do nine tenths of the visible pixels face away from every lamp, and would two-sided light show
   them?  Cones and attenuation are off. */
static int shade__lamps_behind(shade__survey *q)
{
    const shade_vec3 glow = q->material.emission;
    const long long all = shade__covered(q);
    shade__survey each = *q;
    shade_lighting *l = &each.state.lighting;
    each.state.shading = q->given_state->shading;
    shade__whiten(&each);
    if (!shade__lamps_alone(&each) || l->light_count > SHADE__SUSPECTS ||
        q->state.raster.cull == SHADE_CULL_FRONT || glow.x + glow.y + glow.z > 3 * q->dim)
        return 0;
    if (!shade__few(q, shade__count(&each, q->dim), all)) return 0;

    if (q->state.shading == SHADE_SHADING_PER_FACE) each.mesh.normals = NULL;
    shade__light_fragments(&each);
    l->flags |= SHADE_FLAG_TWO_SIDED_ABS;
    if (!shade__lights_up(&each)) return 0;

    l->flags = q->state.lighting.flags;
    l->model = SHADE_MODEL_LAMBERT;
    l->terms = SHADE_TERM_DIFFUSE;
    shade__light_everywhere(&each);
    shade__open_cones(&each);
    shade__whiten_lamps(&each);
    return shade__few(q, shade__count(&each, FLT_MIN), all);
}

static int shade__lamps_fall_off(shade__survey *q)
{
    shade__whiten(q);
    shade__light_everywhere(q);
    return shade__bright(q) && shade__lights_up(q);
}

static int shade__cones_miss(shade__survey *q)
{
    shade__survey white = *q;
    shade__whiten_lamps(&white);
    shade__open_cones(q);
    return !shade__bright(&white) && shade__bright(q) && shade__lights_up(q);
}

/* Is there light after all that does more than graze the surface? */
static int shade__sides_show(shade__survey *q)
{
    q->state.lighting.flags |= SHADE_FLAG_TWO_SIDED_ABS;
    q->state.lighting.model = SHADE_MODEL_LAMBERT;
    q->state.lighting.terms = SHADE_TERM_DIFFUSE;
    if (q->state.shading == SHADE_SHADING_PER_FACE) q->mesh.normals = NULL;
    shade__light_fragments(q);
    return shade__count(q, 0.05f) > 0;
}

static int shade__lamps_are_many(shade__survey *q)
{
    return q->given_state->lighting.light_count > SHADE__SUSPECTS;
}

/* ---- what the sentences about black meshes advise */

static int shade__mend_alpha(shade__survey *q)
{
    q->state.raster.blend = SHADE_BLEND_REPLACE;
    return shade__lights_up(q);
}

static int shade__mend_colors(shade__survey *q)
{
    shade__drop_colors(q);
    return shade__lights_up(q);
}

static int shade__mend_material(shade__survey *q)
{
    shade__polish(q);
    return shade__lights_up(q);
}

static int shade__mend_attenuation(shade__survey *q)
{
    shade__light_everywhere(q);
    return shade__lights_up(q);
}

static int shade__mend_cones(shade__survey *q)
{
    shade__copy_lamps(q);
    shade__open_cones(q);
    return shade__lights_up(q);
}

/* Do lamps light the mesh now?  Where none were given, ambient light does. */
static int shade__lamps_help(shade__survey *q)
{
    shade_lighting *l = &q->state.lighting;
    if (q->given_state->lighting.light_count <= 0) l->ambient = shade_v3(1, 1, 1);
    return l->model <= SHADE_MODEL_LAMBERT && shade__lights_up(q);
}

static int shade__mend_normals(shade__survey *q)
{
    shade__whiten(q);    /* the surface may be black as well */
    q->mesh.normals = NULL;
    return shade__lamps_help(q);
}

static int shade__mend_sides(shade__survey *q)
{
    shade__whiten(q);
    q->state.lighting.flags |= SHADE_FLAG_TWO_SIDED_ABS;
    return shade__lamps_help(q);
}

/* A lamp at the eye in place of the given ones. */
static int shade__mend_color(shade__survey *q)
{
    const shade_lighting given = q->state.lighting;
    shade__light_from_eye(q);
    q->state.lighting.terms = given.terms;
    q->state.lighting.model = given.model;
    return shade__lamps_help(q);
}

static int shade__mend_lamps(shade__survey *q)
{
    shade__whiten(q);
    return shade__mend_color(q);
}

static const shade__ladder shade__black = {
    SHADE__KEEPS_CHANGES, {
        { shade__alpha_is_zero, shade__transparent, shade__mend_alpha },
        { shade__shading_is_coarse,
          "state.shading lights only vertices, or centroids of faces, and no light reaches these, "
          "though it reaches pixels between them; use SHADE_SHADING_PER_FRAGMENT.",
          shade__shading_is_coarse },
        { shade__shows, shade__multiply, NULL },
        { shade__faces_are_lit, shade__multiply, NULL },
        { shade__terms_are_few,
          "lighting.terms or lighting.model leaves out every term that would be seen (0 means all "
          "terms, and the model SHADE_MODEL_BLINN_PHONG); for ambient light alone set "
          "lighting.ambient.", shade__terms_are_few },
        { shade__shows, shade__multiply, NULL },
        { shade__colors_are_black, shade__black_colors, shade__mend_colors },
        { shade__shows, shade__multiply, NULL },
        { shade__material_is_black,
          "state.material reflects nothing, or almost nothing, of the light in the scene: lamps "
          "need diffuse or specular, lighting.ambient needs material.ambient; NULL is white.",
          shade__mend_material },
        { shade__count_is_zero,
          "lighting.light_count is 0 while lighting.lights is set, and lighting.ambient is dark; "
          "set light_count.", shade__mend_lamps },
        { shade__lights_are_none,
          "There is no light: lighting.lights is NULL and lighting.ambient is dark; add a light, "
          "or ambient light.", shade__mend_lamps },
        { shade__lacks_normals, shade__no_normals, shade__mend_normals },
        { shade__lamps_behind, shade__behind, shade__mend_sides },
        { shade__lamps_fall_off, shade__fall_off, shade__mend_attenuation },
        { shade__cones_miss, shade__no_cone, shade__mend_cones },
        { shade__lamps_are_many, shade__multiply, NULL },
        { shade__sides_show, shade__multiply, NULL },
        { shade__always, shade__no_color, shade__mend_color }
    }
};

/*------------------------------------------------------------------------------------------ >>wrong
   Why a mesh shows in a wrong picture: depth, winding, and then light.
     in      a survey                        out  a sentence, or another answer
     way     climb the ladders wrong_picture and wrong_light; climb_to flat
     holds   A sentence is true of the visible pixels: of all, or of the share that its rung tests.
                                                                                        >>verdict */

/* ---- the mesh is drawn, but wrongly */

/* In nine tenths of the pixels with a front face, is a back face nearer? */
static int shade__is_inside_out(const shade__survey *s)
{
    shade__probe probes[SHADE__PROBES];
    uint32_t fronts = 0, behind = 0;
    shade__survey q = *s;
    const int ahead = s->state.projection.col[2].z < 0;    /* depth grows away from the eye */
    if (!shade__is_affine(&s->state.model) || shade__eye_inside(s) ||
        (!q.camera.perspective && ahead && q.farthest == 0)) return 0;
    q.state.raster.cull = SHADE_CULL_NONE;
    shade__take_probes(&q, probes);
    for (int k = 0; k < SHADE__PROBES; k++) {
        fronts += probes[k].any_front;
        behind += probes[k].any_front & !probes[k].front;
    }
    return fronts > 23 && behind * 10 >= fronts * 9;    /* fewer prove too little */
}

static int shade__backs_in_view(shade__survey *q)
{
    return q->state.raster.cull == SHADE_CULL_BACK && shade__is_inside_out(q);
}

/* Does light depend on the side that normals point to? */
static int shade__sides_matter(const shade__survey *s)
{
    const unsigned flags = SHADE_FLAG_TWO_SIDED | SHADE_FLAG_TWO_SIDED_ABS;
    shade__survey both = *s;
    both.state.lighting.flags |= SHADE_FLAG_TWO_SIDED_ABS;
    return s->exact && !(s->state.lighting.flags & flags) &&
           shade__count(&both, s->dim) != shade__count(s, s->dim);
}

static int shade__wound_inward(shade__survey *q)
{
    const int face_normals = !q->mesh.normals || q->state.shading == SHADE_SHADING_PER_FACE;
    if (!face_normals || !shade__sides_matter(q)) return 0;
    shade__look_at_all(q);
    return shade__is_inside_out(q);
}

/* Is there a pixel where the last fragment is not the nearest? */
static int shade__lacks_depth(shade__survey *q)
{
    const shade_raster *r = &q->given_state->raster;
    if (r->blend != SHADE_BLEND_REPLACE) return 0;
    if (q->target->depth && r->depth_test != SHADE_COMPARE_ALWAYS) {
        if (!r->depth_read_only) return 0;
        shade__look_through(q, r->depth_test);
    }
    return shade__hides_nearest(q, 1);
}

/* Edges by the number of other triangles that have them: none (open), one (pairs) or more
   (crowded).  turned: both of a pair go through it in the same direction, so that one is wound the
   other way. */
typedef struct shade__seams { int open, pairs, crowded, turned; } shade__seams;

/* Counts the edge from corner k of a triangle to the next. */
static void shade__count_edge(const shade_mesh *m, int triangle, int k, shade__seams *seams)
{
    const shade_vec3 a = shade__corner(m, (uint32_t)(3 * triangle + k));
    const shade_vec3 b = shade__corner(m, (uint32_t)(3 * triangle + (k + 1) % 3));
    int same = 0, opposite = 0;
    for (int i = 0; i < shade__corner_count(m) / 3 * 3; i++) {
        const shade_vec3 c = shade__corner(m, (uint32_t)i);
        const int at_a = shade__is_zero(shade_sub(c, a)), at_b = shade__is_zero(shade_sub(c, b));
        shade_vec3 next;
        if ((!at_a && !at_b) || i / 3 == triangle) continue;
        next = shade__corner(m, (uint32_t)(i / 3 * 3 + (i + 1) % 3));
        same += at_a && shade__is_zero(shade_sub(next, b));
        opposite += at_b && shade__is_zero(shade_sub(next, a));
    }
    seams->open += same + opposite == 0;
    seams->crowded += same + opposite > 1;
    if (same + opposite != 1) return;
    seams->pairs++;
    seams->turned += same;
}

/* Looks at as many triangles as take the time of some frames: all of a small mesh. */
static shade__seams shade__seams_of(const shade_mesh *m)
{
    const int all = shade__corner_count(m) / 3;
    const int step = 1 + (int)((double)all * all / 4e6);
    shade__seams seams = { 0, 0, 0, 0 };
    for (int i = 0; i < all; i += step) {
        shade_vec3 p[3];
        if (shade__is_zero(shade__face_normal(m, (uint32_t)i, p))) continue;
        for (int k = 0; k < 3; k++) shade__count_edge(m, i, k, &seams);
    }
    return seams;
}

/* Are the triangles no surface, but crowd around edges? */
static int shade__are_crowded(const shade__seams *seams)
{
    return seams->crowded * 10 > seams->pairs;
}

/* Is at least one pair in `of` turned?  Fewer than one in a hundred may belong to a knot in the
   mesh.  A quad has two open edges a triangle; loose triangles, as without indices, have more. */
static int shade__is_turned(const shade__survey *s, int of)
{
    const shade__seams seams = shade__seams_of(s->given_mesh);
    return seams.turned > 1 && seams.turned * of >= seams.pairs &&
           seams.open <= 2 * seams.pairs && !shade__are_crowded(&seams);
}

/* Is a face left out, but not its neighbour? */
static int shade__culled_both_ways(shade__survey *q)
{
    return q->state.raster.cull != SHADE_CULL_NONE && shade__is_turned(q, 100);
}

static int shade__culled_often_both_ways(shade__survey *q)
{
    return q->state.raster.cull != SHADE_CULL_NONE && shade__is_turned(q, 10);
}

static int shade__view_mirrors(shade__survey *q)
{
    return shade_mat4_determinant(q->state.view) < 0 && shade__backs_in_view(q);
}

static const char shade__both_ways[] =
    "Faces are wound both ways: some neighbours, fewer than a tenth, go through their common edge "
    "in the same direction.  If mesh.indices is not forgotten, wind all faces counter-clockwise as "
    "seen from outside; until then use SHADE_CULL_NONE and SHADE_FLAG_TWO_SIDED.";
static const char shade__often_both_ways[] =
    "Faces are wound both ways: a tenth or more of all neighbours go through their common edge in "
    "the same direction.  If mesh.indices is not forgotten, wind all faces counter-clockwise as "
    "seen from outside; until then use SHADE_CULL_NONE and SHADE_FLAG_TWO_SIDED.";
static const char shade__mirrored_view[] =
    "state.view mirrors, since its determinant is negative, so that front faces count as back "
    "faces: make it with shade_mat4_look_at, which only turns and moves.";

static const char shade__inward[] =
    "The mesh is drawn inside out, or is a room seen through its wall: its triangles are wound "
    "clockwise, or state.model, state.view or state.projection mirrors; reverse the winding or "
    "raster.cull.";

static const shade__ladder shade__wrong_picture = {
    SHADE__EACH_ALONE, {
        { shade__culled_often_both_ways, shade__often_both_ways, NULL },
        { shade__culled_both_ways, shade__both_ways, NULL },
        { shade__view_mirrors, shade__mirrored_view, NULL },
        { shade__backs_in_view, shade__inward, NULL },
        { shade__lacks_depth,
          "Triangles drawn later hide nearer ones, because target.depth is NULL, raster.depth_test "
          "is SHADE_COMPARE_ALWAYS, or raster.depth_read_only is set; test and write depth.", NULL }
    }
};

/* ---- the mesh is lit, but wrongly */

static int shade__is_clipped(shade__survey *q)
{
    const long long lit = q->exact ? shade__count(q, q->dim) : shade__covered(q);
    long long clipped;
    q->material.emission = shade_v3(0, 0, 0);
    clipped = shade__count(q, 2);
    return q->target->format != SHADE_FORMAT_RGBA32F && q->whole &&
           q->state.raster.blend != SHADE_BLEND_OVER &&
           !shade__few(q, lit, shade__covered(q)) &&
           clipped * 8 >= lit * (8 - q->exact);
}

/* Does the light of lamps hit colours of 0, so that only highlights show? */
static int shade__colors_are_zero(shade__survey *q)
{
    unsigned *terms = &q->state.lighting.terms;
    if (*terms && !(*terms & SHADE_TERM_DIFFUSE)) return 0;
    *terms = SHADE_TERM_DIFFUSE;
    return q->state.lighting.model <= SHADE_MODEL_LAMBERT && !shade__count(q, FLT_MIN) &&
           q->state.raster.blend == SHADE_BLEND_REPLACE && shade__colors_are_black(q);
}

/* Does a lamp at the eye leave a third of the visible pixels dark, on faces wound toward it? */
static int shade__normals_turned(shade__survey *q)
{
    shade_lighting *l = &q->state.lighting;
    const long long all = shade__covered(q);
    shade__seams seams;
    long long toward;
    if (!q->mesh.normals || q->state.shading == SHADE_SHADING_PER_FACE ||
        q->state.raster.cull == SHADE_CULL_FRONT || !shade__sides_matter(q))
        return 0;
    q->state.raster.cull = SHADE_CULL_BACK;
    shade__light_fragments(q);
    shade__light_from_eye(q);
    shade__whiten(q);
    toward = shade__count(q, FLT_MIN);
    l->flags = SHADE_FLAG_TWO_SIDED_ABS;    /* normals of 0 are dark from both sides */
    if (all <= 11) return 0;    /* fewer prove little */

    if ((shade__count(q, FLT_MIN) - toward) * 3 < all) return 0;
    seams = shade__seams_of(q->given_mesh);
    return !shade__are_crowded(&seams);
}

/* Do all normals lack negative components, though at least an eighth of the faces need one? */
static int shade__normals_differ(const shade_mesh *m)
{
    int behind = 0, before = 0;
    for (int i = 0; i < shade__corner_count(m); i += 3) {
        shade_vec3 p[3], n = shade_v3(0, 0, 0);
        float side;
        for (int k = 0; k < 3; k++) {
            const uint32_t v = shade__corner_index(m, (uint32_t)(i + k));
            const shade_vec3 at = shade__vec3_at(m->normals, m->normal_stride, v);
            if (at.x < 0 || at.y < 0 || at.z < 0) return 0;
            n = shade_add(n, at);
        }
        side = shade_dot(n, shade__face_normal(m, (uint32_t)i / 3, p));
        behind += side < 0;
        before += side > 0;
    }
    return behind && 7 * behind >= before && 7 * before >= behind;
}

static int shade__normals_disagree(shade__survey *q)
{
    const long long lit = shade__count(q, q->dim);
    if (!q->mesh.normals || q->state.raster.cull != SHADE_CULL_NONE || !q->exact ||
        !shade__normals_differ(&q->mesh))
        return 0;
    q->mesh.normals = NULL;
    return shade__count(q, q->dim) != lit;
}

static int shade__alpha_is_stored(shade__survey *q)
{
    const shade_draw_state *d = q->given_state;
    return d->transparency > 0 && d->transparency < 1 && d->alpha_cutoff == 0 &&
           d->raster.blend == SHADE_BLEND_REPLACE &&    /* dimmed by 2 %, and not still white */
           shade__has_pixels(q, 0.02f / d->transparency, 1 / (1 - d->transparency));
}

/* Do highlights cover more than they would on a polished surface? */
static int shade__highlights_are_wide(shade__survey *q)
{
    long long all;
    if (q->state.lighting.terms) return 0;
    q->state.lighting.terms = SHADE_TERM_SPECULAR;
    all = shade__count(q, q->dim);
    if (q->material.shininess >= 1 || !q->exact) return 0;
    q->material.shininess = 50;
    return shade__count(q, q->dim) < all;
}

/* Does light use another eye than the camera has, and would the picture differ with the camera's?
   A one-point projection, with w = 1 at the origin of view, has its eye elsewhere on purpose. */
static int shade__eye_is_astray(shade__survey *q)
{
    const shade__camera *c = &q->camera;
    const shade_mat4 camera = shade_mat4_inverse(q->state.view);
    const shade_vec3 at = shade__xyz(camera.col[3]);
    const unsigned terms = q->state.lighting.terms;
    shade__survey given = *q;
    q->eye_replaced = 1;
    if (q->state.lighting.flags & SHADE_FLAG_INFINITE_VIEWER) {
        q->eye = shade_neg(shade__single3(c->sight));
        if (shade_dot(shade__xyz(camera.col[2]), q->eye) >= 0) return 0;
    } else {
        q->eye = shade__single3(c->eye);
        if (!c->perspective || q->state.projection.col[3].w == 1 ||
            shade_distance(q->eye, at) <= 1e-3f * (shade_length(q->eye) + shade_length(at)))
            return 0;
    }
    return (!terms || terms & SHADE_TERM_SPECULAR) && q->exact && shade__differ(q, &given);
}

/* Would the winding, or normals that disagree with it, be blamed? */
static int shade__winding_is_wrong(const shade__survey *s)
{
    shade__survey faces = *s, turned = *s, inward = *s;
    const int face_normals = !s->mesh.normals || s->state.shading == SHADE_SHADING_PER_FACE;
    return (face_normals && shade__sides_matter(&faces)) || shade__normals_turned(&turned) ||
           shade__wound_inward(&inward);
}

static int shade__lit_both_ways(shade__survey *q)
{
    return shade__winding_is_wrong(q) && shade__is_turned(q, 100);
}

static int shade__lit_often_both_ways(shade__survey *q)
{
    return shade__winding_is_wrong(q) && shade__is_turned(q, 10);
}

static int shade__light_is_mirrored(shade__survey *q)
{
    shade__survey turned = *q, inward = *q;
    return shade_mat4_determinant(q->state.view) < 0 &&
           (shade__normals_turned(&turned) || shade__wound_inward(&inward));
}

/* Light from behind is meant where other light shows the mesh. */
static int shade__lamps_are_behind_all(shade__survey *q)
{
    shade__survey unlit = *q;
    const unsigned terms = q->state.lighting.terms;
    unlit.state.lighting.terms = (terms ? terms : ~0u) & (SHADE_TERM_EMISSION | SHADE_TERM_AMBIENT);
    return !(unlit.state.lighting.terms && shade__shows(&unlit)) && shade__lamps_behind(q);
}

static const shade__ladder shade__wrong_light = {
    SHADE__EACH_ALONE, {
        { shade__is_clipped,
          "Almost all that is lit is clipped to white: colours of lighting.lights, "
          "lighting.ambient, state.material and mesh.colors are linear, with 1 for full light, not "
          "255.", NULL },
        { shade__lit_often_both_ways, shade__often_both_ways, NULL },
        { shade__lit_both_ways, shade__both_ways, NULL },
        { shade__light_is_mirrored, shade__mirrored_view, NULL },
        { shade__lamps_are_behind_all, shade__behind, NULL },
        { shade__colors_are_zero, shade__black_colors, NULL },
        { shade__normals_turned,
          "mesh.normals point away from the eye on faces that are wound toward it: turn "
          "mesh.normals, fill them with shade_mesh_normals, or reverse the winding, as a mirroring "
          "model does.",
          NULL },
        { shade__eye_is_astray,
          "Highlights belong to another eye: light takes the eye from state.view, in which +z "
          "points back to the viewer, but state.projection moves the eye or looks along +z: leave "
          "that to state.view alone.", NULL },
        { shade__wound_inward, shade__inward, NULL },
        { shade__normals_disagree,
          "mesh.normals have no negative component, and lie behind some of the faces: are they "
          "stored as colours, n / 2 + 1 / 2?  shade_mesh_normals fills them.", NULL },
        { shade__alpha_is_stored,
          "state.transparency is stored as alpha and dims nothing, because raster.blend is "
          "SHADE_BLEND_REPLACE; use SHADE_BLEND_OVER.", NULL },
        { shade__highlights_are_wide,
          "state.material.shininess is below 1, so that highlights cover all that lamps light; 5 "
          "is dull, 100 polished (tables from 0 to 1 mean 128 times that).", NULL }
    }
};

/* True if lamp light is visible, or not expected (no diffuse colour, emission, a model without
   lamps).  Other light is off from here on. */
static int shade__lamps_show(shade__survey *q)
{
    return !shade__lamps_alone(q) || !shade__is_zero(q->material.emission) ||
           shade__is_zero(q->material.diffuse) || shade__shows(q);
}

/* Meshes may be without lamps on purpose: bright ones, and overlays without normals. */
static int shade__unlit_is_meant(shade__survey *q)
{
    const shade_vec3 light = q->state.lighting.ambient;
    return q->state.lighting.light_count <= 0 &&
           (!q->mesh.normals || light.x + light.y + light.z >= 1);
}

static int shade__white_shows(shade__survey *q)
{
    shade__whiten(q);
    return shade__shows(q);
}

static const shade__ladder shade__flat = {
    SHADE__KEEPS_CHANGES, {
        { shade__lamps_show, SHADE__GO_ON, NULL },
        { shade__count_is_zero,
          "Only ambient light arrives: lighting.light_count is 0 while lighting.lights is set.",
          shade__mend_lamps },
        { shade__unlit_is_meant, SHADE__GO_ON, NULL },
        { shade__lights_are_none,
          "Only ambient light arrives, which shows no form: lighting.lights is NULL.",
          shade__mend_lamps },
        { shade__white_shows, SHADE__GO_ON, NULL },
        { shade__lacks_normals, shade__no_normals, shade__mend_normals },
        { shade__lamps_fall_off, shade__fall_off, shade__mend_attenuation },
        { shade__cones_miss, shade__no_cone, shade__mend_cones },
        { shade__lamps_are_many, SHADE__GO_ON, NULL },
        { shade__sides_show, SHADE__GO_ON, NULL },
        { shade__always, shade__no_color, shade__mend_color }
    }
};

/*---------------------------------------------------------------------------------------- >>verdict
   The calls that explain a draw in one sentence, and their way through the ladders.
     in      arguments of a draw, its stats  out  a constant sentence; "" for nothing
     way     shade_explain: mesh_refusal, no_mesh, clip_fault; open_survey; why: bad_number; the
             ladder nothing, or wrong_test and not_stored; why_wrong: the ladders wrong_picture,
             black by why_black, wrong_light, flat; doubt.  shade_explain_draw,
             shade_explain_lines: explain_replay: why: bad_run; the same ladders; why_plain:
             why_faint                                                                     >>refs */

/* ---- the colours of a fragment shader of the caller, or of lines */

/* The fragments that are visible for certain, or all: a fault that all of them have is visible. */
static const shade__color_counts *shade__visible(const shade__survey *s, const shade__tally *t)
{
    const shade_raster *r = &s->given_state->raster;
    const int known = r->blend == SHADE_BLEND_REPLACE && !r->depth_read_only && t->stored.count &&
                      !(s->given_stats && t->stored.count > s->given_stats->fragments);
    return known ? &t->stored : &t->all;
}

static const char *shade__why_faint(const shade__survey *s)
{
    const shade_raster *raster = &s->given_state->raster;
    const int lines = s->replay && s->replay->lines;
    const shade__tally t = shade__tally_of(s);
    const shade__color_counts *v = shade__visible(s, &t);
    if (!s->replay && t.fragments && t.discarded == t.fragments)
        return shade__all_discarded;
    if (!v->count) return SHADE__GO_ON;
    if (t.fragment_lanes_left)
        return "The fragment shader (state.fragment, pipeline.fragment) writes lane 0 of a packet "
               "alone: it must write every lane, in a loop SHADE_EACH_LANE(i) over "
               "out->color[k][i].";
    if (s->replay && t.reads_more && t.rows_written > s->replay->pipe.varyings)
        return "pipeline.varyings is smaller than the number of rows that pipeline.vertex writes "
               "and pipeline.fragment reads, so that the last ones are not interpolated; raise it.";
    if (s->replay && !s->replay->pipe.may_discard && t.discarded)
        return "pipeline.fragment sets discard, which needs pipeline.may_discard = 1.";
    if (v->nan)
        return lines ? "state.color holds NaN, which is stored as black."
                     : "The fragment shader gives NaN, which is stored as black: check its "
                       "uniforms, divisions, and roots of negative numbers.";
    if (raster->blend != SHADE_BLEND_REPLACE && s->state.transparency == 1)
        return shade__transparent;
    if (raster->blend == SHADE_BLEND_OVER)
        return v->clear == v->count
                   ? "Alpha is 0 everywhere, so that SHADE_BLEND_OVER leaves nothing: it is "
                     "out->color[3] of the fragment shader, or state.color.w of lines."
                   : SHADE__GO_ON;
    if (raster->blend == SHADE_BLEND_ADD) {
        if (v->none == v->count)
            return "All colours are black, so that SHADE_BLEND_ADD adds nothing.";
    } else if (v->dark == v->count && lines)
        return v->clear == v->count ? "state.color is not set: the lines are drawn in black."
                                    : SHADE__GO_ON;
    else if (v->dark == v->count && raster->cull != SHADE_CULL_FRONT)
        return "The fragment shader (state.fragment, pipeline.fragment) gives black everywhere: "
               "check out->color[0] to [2], which it must write in each lane, its uniforms, and "
               "the varyings.";    /* not of outlines */
    return v->bright * 10 >= v->count * 9 && s->target->format != SHADE_FORMAT_RGBA32F
               ? "Almost all colours are clipped to white, or a full channel: in out->color, and "
                 "in state.color of lines, 1 is full light, not 255."
               : SHADE__GO_ON;
}

/* ---- the way through the ladders */

static const char *shade__why_black(const shade__survey *seen)
{
    shade__survey q = *seen;
    const shade__rung *rung;
    if (shade__black_is_meant(&q)) return SHADE__GO_ON;
    rung = shade__climb_to(seen, &shade__black);
    return shade__helps(seen, rung) ? rung->answer : shade__multiply;
}

/* Is every pixel of the mesh dark, below least in each channel, or dark in the caller's picture? */
static int shade__is_dark(const shade__survey *seen, float least)
{
    shade__survey q = *seen;
    if ((!q.whole && shade__is_band(q.target)) || shade__black_is_meant(&q)) return 0;
    if (!q.exact) shade__look_in_clip(&q);
    q.lit_only = 1;
    return !shade__count(&q, least);
}

/* Looks at a picture in which the mesh has pixels.  Light is judged if the library computes it. */
static const char *shade__why_wrong(const shade__survey *s)
{
    shade__survey seen = *s, q;
    const int opaque = shade__is_opaque(s);
    const char *why = shade__climb(s, &shade__wrong_picture);
    const shade__rung *rung;
    shade__look_at_seen(&seen);
    if (why || !s->target->color || !shade__covered(&seen)) return why;
    if (s->given_state->fragment) return shade__why_faint(s);
    q = seen;
    if (!opaque) q.dim /= 8;    /* layers add up */
    if (!shade__shows(&q) || (!shade__shows(&seen) && shade__is_dark(&seen, 0)))
        return shade__why_black(&seen);
    why = shade__climb(&seen, &shade__wrong_light);
    if (why) return why;

    rung = shade__climb_to(&q, &shade__flat);
    if (!rung->answer && shade__is_dark(&seen, opaque ? seen.dim : 0)) return shade__multiply;
    shade__lamps_alone(&seen);
    return shade__helps(&seen, rung) ? rung->answer : SHADE__GO_ON;
}

/* Faults of a pipeline or of lines that show in any run. */
static const char *shade__bad_run(const shade__survey *s)
{
    const shade__replay *r = s->replay;
    shade__survey q = *s;
    shade__tally t;
    q.how = SHADE__CHECKS;
    t = shade__replay_of(&q, NULL);
    if (t.vertex_lanes_left)
        return "pipeline.vertex writes lane 0 of a packet alone: it must write every lane, in a "
               "loop SHADE_EACH_LANE(i) over in->index[i] and out->clip[k][i].";
    if (t.stats.rejected)
        return r->lines ? "The points, or state.clip_from_points, hold NaN, infinite or huge "
                          "numbers (beyond 1e30), so that lines are left out."
                        : "pipeline.vertex gives NaN, infinite or huge positions (beyond 1e30), so "
                          "that triangles are left out: check its uniforms and what it reads.";
    shade__look_in_clip(&q);
    q.how = 0;
    t = shade__replay_of(&q, NULL);
    if (r->pipe.may_discard && t.fragments && t.discarded == t.fragments)
        return "pipeline.fragment discards all pixels.";
    return SHADE__GO_ON;
}

/* Looks at a picture in which lines or a pipeline have pixels.  A draw of depth alone is a pass
   before others, or counts pixels: no colour is missed. */
static const char *shade__why_plain(const shade__survey *s)
{
    shade__survey q = *s;
    if (!s->replay->pipe.fragment && !s->target->depth)
        return "pipeline.fragment is NULL, so that only depth is drawn, but target.depth is NULL.";
    if (shade__matrix_by_rows(&q)) return shade__lines_by_rows;
    return s->replay->pipe.fragment && s->target->color ? shade__why_faint(s) : SHADE__GO_ON;
}

static const char *shade__why(const shade__survey *s)
{
    const int sure = s->given_stats && s->given_stats->fragments > 0;
    const char *why = s->replay ? shade__bad_run(s) : shade__bad_number(s);
    shade__survey all = *s;
    all.how = SHADE__UNDISCARDED;
    if (why) return why;
    if (!sure && !shade__covered(&all)) return shade__climb(&all, &shade__nothing);

    why = shade__climb(s, &shade__wrong_test);
    if (!why && !sure) why = shade__climb(s, &shade__not_stored);
    if (why || !shade__is_drawn(s)) return why;
    if (s->replay) return shade__why_plain(s);

    why = shade__why_wrong(s);
    return why ? why : shade__doubt(s);
}

/* Says that the clip rectangle is empty; silent where it lies beside the strip. */
static const char *shade__clip_fault(const shade_target *t)
{
    shade_target picture = *t;
    int clip[4];
    picture.row_offset = picture.row_count = 0;
    if (!shade__clip_rectangle(&picture, clip))
        return "The clip rectangle is empty or outside the picture: check target.clip_x, clip_y, "
               "clip_width and clip_height; all four zero mean everywhere.";
    return shade__clip_rectangle(t, clip) ? SHADE__GO_ON : SHADE__SILENT;
}

SHADEDEF SHADE__COLD const char *shade_explain(const shade_target *target, const shade_mesh *mesh,
                                               const shade_draw_state *state,
                                               const shade_stats *stats)
{
    shade__survey s;
    const char *why;
    shade__mesh_refusal(target, mesh, state, &why);
    if (!why) why = shade__no_mesh(mesh);
    if (!why) why = shade__clip_fault(target);
    if (why) return why;

    shade__open_survey(target, mesh, state, stats, &s);
    why = shade__why(&s);
    return why ? why : "";
}

/* Explains lines or a pipeline.   pre: all of r but mesh and state is set */
static const char *shade__explain_replay(shade__replay *r, const shade_stats *stats)
{
    shade__survey s;
    const char *why = shade__clip_fault(r->target);
    if (why) return why;
    SHADE__ZERO(r->mesh);
    SHADE__ZERO(r->state);
    r->state.raster = r->pipe.raster;
    shade__open_survey(r->target, &r->mesh, &r->state, stats, &s);
    s.replay = r;
    s.farthest = (float)!shade__compare_of(&r->pipe.raster).greater;
    why = shade__why(&s);
    return why ? why : "";
}

SHADEDEF SHADE__COLD const char *shade_explain_draw(const shade_target *target,
                                                    const shade_pipeline *pipeline,
                                                    const uint32_t *indices, int index_count,
                                                    int vertex_count, const shade_stats *stats)
{
    const shade__indices list = { indices, NULL };
    const char *why;
    shade__replay r;
    shade__draw_refusal(target, pipeline, list, index_count, vertex_count, &why);
    if (!why && !index_count)
        why = "There is no triangle to draw: index_count is 0; without indices it counts vertices.";
    if (why) return why;

    SHADE__ZERO(r);
    r.target = target;
    r.indices = list;
    r.corners = index_count;
    r.pipe = *pipeline;
    return shade__explain_replay(&r, stats);
}

SHADEDEF SHADE__COLD const char *shade_explain_lines(const shade_target *target,
                                                     const shade_vec3 *points, int point_count,
                                                     const shade_line_state *state,
                                                     const shade_stats *stats)
{
    const char *why;
    shade__stroke stroke;
    shade__replay r;
    shade__lines_refusal(target, points, point_count, state, &why);
    if (!why && !point_count) why = "There is no line to draw: point_count is 0.";
    if (why) return why;

    SHADE__ZERO(r);
    r.target = target;
    r.lines = state;
    r.corners = 3 * point_count;
    r.stroke = &stroke;
    shade__stroke_of(target, points, state, &stroke, &r.pipe);
    return shade__explain_replay(&r, stats);
}

#else /* SHADE_NO_EXPLAIN */

SHADEDEF const char *shade_explain(const shade_target *target, const shade_mesh *mesh,
                                   const shade_draw_state *state, const shade_stats *stats)
{
    (void)target;
    (void)mesh;
    (void)state;
    (void)stats;
    return "";
}

SHADEDEF const char *shade_explain_lines(const shade_target *target, const shade_vec3 *points,
                                         int point_count, const shade_line_state *state,
                                         const shade_stats *stats)
{
    (void)target;
    (void)points;
    (void)point_count;
    (void)state;
    (void)stats;
    return "";
}

SHADEDEF const char *shade_explain_draw(const shade_target *target, const shade_pipeline *pipeline,
                                        const uint32_t *indices, int index_count, int vertex_count,
                                        const shade_stats *stats)
{
    (void)target;
    (void)pipeline;
    (void)indices;
    (void)index_count;
    (void)vertex_count;
    (void)stats;
    return "";
}
#endif

SHADE__END
#endif /* SHADE__IMPLEMENTED */
#endif /* SHADE_IMPLEMENTATION */

/*------------------------------------------------------------------------------------------- >>refs
   [Blinn77]      J. F. Blinn, "Models of Light Reflection for Computer Synthesized Pictures",
                  SIGGRAPH 1977, Computer Graphics 11(2), 192-198.
   [Deutsch96]    P. Deutsch, "DEFLATE Compressed Data Format Specification version 1.3",
                  RFC 1951, 1996.
   [Gooch98]      A. Gooch, B. Gooch, P. Shirley, E. Cohen, "A Non-Photorealistic Lighting Model
                  for Automatic Technical Illustration", SIGGRAPH 1998, 447-452.
   [Gouraud71]    H. Gouraud, "Continuous Shading of Curved Surfaces", IEEE Transactions on
                  Computers C-20(6), 623-629.
   [Greene93]     N. Greene, M. Kass, G. Miller, "Hierarchical Z-Buffer Visibility", SIGGRAPH 1993.
   [IEC61966]     IEC 61966-2-1:1999, the sRGB colour space.
   [Intel25]      Intel 64 and IA-32 Architectures Software Developer's Manual, volume 1, 2025,
                  chapters 14 and 15.
   [ISO15948]     ISO/IEC 15948:2003, Portable Network Graphics, the W3C's recommendation of 2003.
   [Kadlec10]     J. Kadlec, "Improving the fast inverse square root", 2010: the constant and its
                  Newton step.
   [Kilgard94]    The materials of teapots.c, Silicon Graphics 1993, M. J. Kilgard 1994.
   [Moller97]     T. Moeller, B. Trumbore, "Fast, Minimum Storage Ray/Triangle Intersection",
                  Journal of Graphics Tools 2(1), 21-28.
   [Phong75]      B. T. Phong, "Illumination for Computer Generated Pictures", Communications of the
                  ACM 18(6), 311-317.
   [Pineda88]     J. Pineda, "A Parallel Algorithm for Polygon Rasterization", SIGGRAPH 1988,
                  Computer Graphics 22(4), 17-20.
   [Shewchuk97]   J. R. Shewchuk, "Adaptive Precision Floating-Point Arithmetic and Fast Robust
                  Geometric Predicates", Discrete & Computational Geometry 18(3), 305-363.
   [Sutherland74] I. E. Sutherland, G. W. Hodgman, "Reentrant Polygon Clipping", Communications of
                  the ACM 17(1), 32-42.
   [Thurmer98]    G. Thuermer, C. A. Wuethrich, "Computing Vertex Normals from Polygonal Facets",
                  Journal of Graphics Tools 3(1), 43-46.
   [Williams83]   L. Williams, "Pyramidal Parametrics", SIGGRAPH 1983, Computer Graphics 17(3),
                  1-11.
*/

/*---------------------------------------------------------------------------------------- >>history
   1.4 unreleased, 1.3 of 2026-11-27, 1.2 of 2026-11-23, 1.1 of 2026-11-22, 1.0 of 2026-11-21;
   CHANGELOG.md says what each brought.
   From 1.1 on pixels are part of the interface: each 1.x draws the pixels of 1.1, to the bit.
*/

/*---------------------------------------------------------------------------------------- >>license
   shade.h is available under two licences; choose the one you like.

   Alternative A - Public Domain (www.unlicense.org)

   This is free and unencumbered software released into the public domain.

   Anyone is free to copy, modify, publish, use, compile, sell, or distribute this software, either
   in source code form or as a compiled binary, for any purpose, commercial or non-commercial, and
   by any means.

   In jurisdictions that recognize copyright laws, the author or authors of this software dedicate
   any and all copyright interest in the software to the public domain. We make this dedication for
   the benefit of the public at large and to the detriment of our heirs and successors. We intend
   this dedication to be an overt act of relinquishment in perpetuity of all present and future
   rights to this software under copyright law.

   THE SOFTWARE IS PROVIDED "AS IS", WITHOUT WARRANTY OF ANY KIND, EXPRESS OR IMPLIED, INCLUDING
   BUT NOT LIMITED TO THE WARRANTIES OF MERCHANTABILITY, FITNESS FOR A PARTICULAR PURPOSE AND
   NONINFRINGEMENT. IN NO EVENT SHALL THE AUTHORS BE LIABLE FOR ANY CLAIM, DAMAGES OR OTHER
   LIABILITY, WHETHER IN AN ACTION OF CONTRACT, TORT OR OTHERWISE, ARISING FROM, OUT OF OR IN
   CONNECTION WITH THE SOFTWARE OR THE USE OR OTHER DEALINGS IN THE SOFTWARE.

   Alternative B - MIT License

   Copyright (c) 2026 the authors of shade.h

   Permission is hereby granted, free of charge, to any person obtaining a copy of this software
   and associated documentation files (the "Software"), to deal in the Software without
   restriction, including without limitation the rights to use, copy, modify, merge, publish,
   distribute, sublicense, and/or sell copies of the Software, and to permit persons to whom the
   Software is furnished to do so, subject to the following conditions:

   The above copyright notice and this permission notice shall be included in all copies or
   substantial portions of the Software.

   THE SOFTWARE IS PROVIDED "AS IS", WITHOUT WARRANTY OF ANY KIND, EXPRESS OR IMPLIED, INCLUDING
   BUT NOT LIMITED TO THE WARRANTIES OF MERCHANTABILITY, FITNESS FOR A PARTICULAR PURPOSE AND
   NONINFRINGEMENT. IN NO EVENT SHALL THE AUTHORS OR COPYRIGHT HOLDERS BE LIABLE FOR ANY CLAIM,
   DAMAGES OR OTHER LIABILITY, WHETHER IN AN ACTION OF CONTRACT, TORT OR OTHERWISE, ARISING FROM,
   OUT OF OR IN CONNECTION WITH THE SOFTWARE OR THE USE OR OTHER DEALINGS IN THE SOFTWARE.
*/
