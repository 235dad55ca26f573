/* shade.h - classic local shading and an exact z-buffer rasterizer in one C99 file
   Public domain or MIT, as you like: the end of the file has both.

   Emission, ambient, Lambert, Phong and Blinn-Phong light ("iteration four" of the graphics
   courses, over any number of directional, point and spot lights), the vector and matrix maths
   they need, and a small, fast triangle rasterizer with programmable vertex and fragment shaders
   to see them with.  It allocates nothing, keeps no global state, starts no thread and draws into
   memory that you own.  The pixels are the same bits on every compiler and processor: the
   arithmetic is IEEE single and double precision, never contracted.

   Use: in exactly one C or C++ file

       #define SHADE_IMPLEMENTATION
       #include "shade.h"

   and plain #include "shade.h" elsewhere.  Link with -lm (for sqrtf alone; see SHADE_NO_LIBM).

       #include <stdio.h>
       static uint32_t pixels[480 * 640];  static float depth[480 * 640];

       int main(void) {
           static const float corner[] = { -1, -1, 0,   1, -1, 0,   0, 1, 0 };
           shade_target target = { 640, 480 };
           shade_mesh mesh = { corner };
           shade_draw_state state = { 0 };
           shade_stats stats;
           shade_result result;
           shade_light sun = shade_directional_light(shade_v3(0, 0, -1), shade_v3(1, 0.8f, 0.5f));
           target.color = pixels;
           target.depth = depth;
           mesh.vertex_count = 3;
           state.projection = shade_mat4_perspective(1, 640 / 480.0f, 0.1f, 10);
           state.view = shade_mat4_look_at(shade_v3(0, 0, 3), shade_v3(0, 0, 0), shade_v3(0, 1, 0));
           state.lighting.lights = &sun;
           state.lighting.light_count = 1;
           shade_clear(&target, shade_v4(0.1f, 0.1f, 0.2f, 1), 1);
           result = shade_draw_mesh(&target, &mesh, &state, &stats);
           if (result) puts(shade_result_string(result));
           if (!stats.fragments) puts(shade_explain(&target, &mesh, &state, &stats));
           return shade_write_ppm("triangle.ppm", &target);
       }

   It does not open windows, parse model files, start threads, emulate OpenGL, or do shadows,
   reflections or physically based materials.                                            >>about

   >>contents
     About      >>about  >>contents  >>conventions  >>model
     Public     >>config  >>types  >>inline  >>math  >>light  >>draw
     Inside     >>target  >>base  >>matrix  >>power  >>color  >>lighting  >>arrival  >>lanes
                >>state  >>vertices  >>triangles  >>clip  >>blocks  >>cover  >>fragments  >>texture
                >>store  >>check  >>drive  >>mesh  >>lines  >>shape  >>survey  >>explain  >>image
     Sources    >>refs  >>history  >>license

   >>conventions
     World        right-handed; the camera looks down -z, +y is up.  Angles in radians.
     Matrices     column vectors, stored by columns: (float *)&m is a matrix of OpenGL, GLM, cglm.
     Clip space   -w <= x, y, z <= w; with depth_zero_to_one 0 <= z <= w.  Near and far both clip.
     Window       x right, y DOWN, row 0 on top.  Pixel (i,j) has its centre at (i + 1/2, j + 1/2).
                  X = (x/w + 1) width/2,   Y = (1 - y/w) height/2.
     Depth        0 near, 1 far, test LESS, cleared to 1.  Reversed: depth_zero_to_one,
                  shade_mat4_perspective_reversed, SHADE_COMPARE_GREATER and a clear value of 0.
     Front face   counter-clockwise as seen on the screen.
     Coverage     vertices snapped to floor(256 X + 1/2) / 256, exact integer edges, top-left rule.
     Directions   N, L, V, H, R are unit and all point AWAY from the surface.
     Colour       linear light, unclamped; stored in 8 and 5-6-5 bits as clamp(c, 0, 1) to nearest,
                  NaN as 0.
     Names        _ws world   _cs clip   _ss screen   _fx8 24.8 fixed point   rw 1/w
                  shade__x private

   >>model   Every equation of light in this file, with its symbols ("iteration four"):

     I = k_e + k_a I_a + SUM over lights j of { k_a I_La,j
             + spot_j / (a_j + b_j r_j + c_j r_j^2) B_j (k_d I_d,j (N.L_j) + k_s I_s,j (N.H_j)^n) }

     k_e k_a k_d k_s n   emission, ambient, diffuse, specular, shininess of the shade_material
     I_a                 ambient light of the scene
     I_La I_d I_s        ambient, diffuse and specular light of one lamp
     a b c, r            attenuation coefficients, distance to the lamp (at infinity: factor 1)
     spot                (L.S)^e where L.S >= cos(beta), else 0; -S is where the lamp points
     B                   1 where N.L > 0, else 0
     H                   (L + V) / |L + V|; SHADE_MODEL_PHONG has (R.V)^n instead, R = 2 (N.L) N - L
*/
#ifndef SHADE_H
#define SHADE_H
#define SHADE_VERSION 10100    /* major * 10000 + minor * 100 + patch */

/*----------------------------------------------------------------------------------------- >>config
   Options, each defined before the #include, the same for every file of a program:

     SHADE_IMPLEMENTATION     also compile the function bodies; in one file only
     SHADE_STATIC             all functions static: a private copy in this file
     SHADEDEF                 linkage of public functions; default extern (static with SHADE_STATIC)
     SHADE_ASSERT(x)          guards the library's own invariants; default assert(x)
     SHADE_LANES              fragments a packet, a power of two from 8 to 256; default 128;
                              16 for small stacks
     SHADE_MAX_VARYINGS       floats a vertex can hand to fragments, 1 .. 64; default 16; meshes
                              lit per fragment need 6, 9 with colours, 8 or 11 with a map, 11 with
                              a fragment shader of their state
     SHADE_NO_STDIO           leaves out shade_write_ppm and <stdio.h>
     SHADE_NO_LIBM            freestanding: only <stddef.h>, <stdint.h>, <float.h>; implies
                              NO_STDIO, NO_DISPATCH and no assertions
     SHADE_MEMCPY(d, s, n)    default memcpy; SHADE_MEMSET(d, c, n) default memset
     SHADE_NO_DISPATCH        one build of each loop, for the processor the compiler was told of;
                              set by itself with zig and with clang for Microsoft's ABI
     SHADE_ALLOW_FAST_MATH    clang compiles the implementation with -ffast-math as well, to other
                              bits, and bad data may get through

   SHADE_LANES and SHADE_MAX_VARYINGS are written as plain decimal numbers: the linker's names of
   functions that take packets end in them, and files that disagree do not link.  A program may have
   any capital letter as a macro; of small ones e, g, i, j, o and q, but not in the implementation.
   gcc gives the same bits with -ffast-math, -Ofast and their parts.  clang cannot be told to: where
   it compiles the implementation, -ffast-math and -ffinite-math-only are refused.  It does not say
   that it has the other parts, or -ffp-contract=fast, which fuses against the pragma below: do not
   give it these.  In your own files, inline functions follow your flags.  A program linked with
   -ffast-math flushes denormal numbers to zero, which SHADE_FORMAT_RGBA32F shows.
   tcc 0.9.27 on x86-64 stores 16 bytes for the 12 of a returned shade_vec3, over an int or float
   declared last before the call, in your functions too; SHADE_EACH_LANE counts in 8 bytes there. */
#include <float.h>
#include <stddef.h>
#include <stdint.h>

#ifndef SHADE_LANES
#define SHADE_LANES 128
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

/* shade_draw_16_8 is what the linker sees of shade_draw with 16 lanes and 8 varyings.  Files that
   disagree would draw nothing, or write past their packets. */
#define SHADE__JOIN(name, lanes, varyings) name##_##lanes##_##varyings
#define SHADE__LINKED(name, lanes, varyings) SHADE__JOIN(name, lanes, varyings)
#if SHADE_LANES != 128 || SHADE_MAX_VARYINGS != 16
#define shade_draw SHADE__LINKED(shade_draw, SHADE_LANES, SHADE_MAX_VARYINGS)
#define shade_draw_mesh SHADE__LINKED(shade_draw_mesh, SHADE_LANES, SHADE_MAX_VARYINGS)
#define shade_lit_lanes SHADE__LINKED(shade_lit_lanes, SHADE_LANES, SHADE_MAX_VARYINGS)
#define shade_light_at_lanes SHADE__LINKED(shade_light_at_lanes, SHADE_LANES, SHADE_MAX_VARYINGS)
#define shade_sample_lanes SHADE__LINKED(shade_sample_lanes, SHADE_LANES, SHADE_MAX_VARYINGS)
#endif

#ifdef SHADE_NO_LIBM
#undef SHADE_NO_STDIO
#define SHADE_NO_STDIO
#endif

/*------------------------------------------------------------------------------------------ >>types
   Plain structs, passed by value.  Zeroed fields always mean the default. */

typedef struct shade_vec2 { float x, y; } shade_vec2;
typedef struct shade_vec3 { float x, y, z; } shade_vec3;
typedef struct shade_vec4 { float x, y, z, w; } shade_vec4;
typedef struct shade_mat3 { shade_vec3 col[3]; } shade_mat3;    /* columns */
typedef struct shade_mat4 { shade_vec4 col[4]; } shade_mat4;

typedef enum shade_result {
    SHADE_OK = 0,
    SHADE_ERROR_ARGUMENT,    /* a NULL the call cannot do without, a factor, sizes that differ */
    SHADE_ERROR_TARGET,      /* size, stride, format, clip rectangle or strip; no memory */
    SHADE_ERROR_MESH,        /* positions, a count, a stride, a chunk */
    SHADE_ERROR_STATE,       /* an enumerator or range of a draw state, pipeline or line state */
    SHADE_ERROR_LIGHTS,      /* lights NULL with a count, an unknown model */
    SHADE_ERROR_TEXTURE,     /* a texture, or the varyings of its level of detail */
    SHADE_ERROR_INDEX,       /* an index at or past vertex_count, or no whole number of triangles */
    SHADE_ERROR_CAPACITY,    /* the caller's array is too small */
    SHADE_ERROR_IO           /* a file or the caller's write function failed */
} shade_result;

/* Property of a surface, linear RGB.  For energy's sake k_d + k_s <= 1 in each channel is usual,
   not required. */
typedef struct shade_material {
    shade_vec3 emission;     /* k_e */
    shade_vec3 ambient;      /* k_a */
    shade_vec3 diffuse;      /* k_d */
    shade_vec3 specular;     /* k_s */
    float      shininess;    /* n >= 0; negative counts as 0 */
} shade_material;

/* One lamp.  shade_directional_light and its sisters below fill it in. */
typedef struct shade_light {
    shade_vec4 position;           /* w = 0: the direction TOWARD a distant light; else at xyz/w */
    shade_vec3 ambient;            /* I_La: not attenuated, see SHADE_FLAG_ATTENUATED_AMBIENT */
    shade_vec3 diffuse;            /* I_d */
    shade_vec3 specular;           /* I_s */
    float      constant, linear, quadratic;    /* a, b, c of 1/(a + b r + c r^2); all zero: 1 */
    shade_vec3 spot_direction;     /* where the lamp points, any length; zero: not a spotlight */
    float      spot_exponent;      /* e; 0: a cone of even light */
    float      spot_cos_cutoff;    /* cos(beta), beta from the axis to the edge of the cone */
} shade_light;

typedef enum shade_model {
    SHADE_MODEL_BLINN_PHONG = 0,     /* iterations three and four: (N.H)^n             [Blinn77] */
    SHADE_MODEL_PHONG,               /* (R.V)^n in place of (N.H)^n                    [Phong75] */
    SHADE_MODEL_LAMBERT,             /* iteration two: emission, ambient, diffuse */
    SHADE_MODEL_AMBIENT,             /* iteration one: emission, ambient */
    SHADE_MODEL_EMISSIVE,            /* iteration zero: emission */
    SHADE_MODEL_COOL_TO_WARM         /* shade_cool_to_warm to the first light, k_e     [Gooch98] */
} shade_model;

enum {                                 /* shade_lighting.flags */
    SHADE_FLAG_TWO_SIDED          = 1,     /* turn N toward the viewer first, where N.V < 0 */
    SHADE_FLAG_TWO_SIDED_ABS      = 2,     /* |N.L| in the diffuse term alone */
    SHADE_FLAG_UNGATED_SPECULAR   = 4,     /* no B: highlights reach behind the terminator */
    SHADE_FLAG_WEIGHTED_SPECULAR  = 8,     /* k_s max(0, N.L) (N.H)^n, as a BRDF is weighted */
    SHADE_FLAG_ATTENUATED_AMBIENT = 16,    /* I_La by distance and cone, as OpenGL's fixed part */
    SHADE_FLAG_INFINITE_VIEWER    = 32     /* eye: direction toward the viewer, at every point */
};
enum {                                 /* shade_lighting.terms; 0 = all */
    SHADE_TERM_EMISSION = 1, SHADE_TERM_AMBIENT = 2, SHADE_TERM_DIFFUSE = 4, SHADE_TERM_SPECULAR = 8
};

/* The light that falls on a scene, and the equation that answers it.  Positions, normals and eye
   may live in any one space whose axes are orthogonal and of equal scale: world or eye space,
   never clip space.  SHADE_FLAG_TWO_SIDED with interpolated normals flips some on the outline of a
   coarse mesh, where they already point away from the viewer: specks that a finer mesh loses. */
typedef struct shade_lighting {
    const shade_light *lights;         /* NULL with a count: none (shade_draw_mesh refuses it) */
    int         light_count;           /* below 0 counts as 0 */
    shade_vec3  ambient;               /* I_a, once for the scene */
    shade_model model;                 /* unknown: BLINN_PHONG (shade_draw_mesh refuses it) */
    unsigned    flags;
    unsigned    terms;
    shade_vec3  cool, warm;            /* of COOL_TO_WARM; zero: (.4,.4,.7), (.8,.6,.6) */
} shade_lighting;

typedef struct shade_terms { shade_vec3 emission, ambient, diffuse, specular; } shade_terms;

typedef enum shade_format {
    SHADE_FORMAT_RGBA8 = 0,      /* bytes R, G, B, A in memory order */
    SHADE_FORMAT_BGRA8,          /* bytes B, G, R, A: windows of Win32, X11, Cairo, Qt */
    SHADE_FORMAT_RGB565,         /* a native uint16, red in the high bits */
    SHADE_FORMAT_RGB565_SWAPPED, /* its two bytes exchanged: displays on a serial bus */
    SHADE_FORMAT_RGBA32F,        /* four floats, stored as they come; srgb does not touch them */
    SHADE_FORMAT_A8              /* of textures alone: a byte of alpha, R = G = B = 1; never sRGB */
} shade_format;

typedef enum shade_wrap {
    SHADE_WRAP_REPEAT = 0, SHADE_WRAP_CLAMP, SHADE_WRAP_MIRROR
} shade_wrap;
typedef enum shade_filter {
    SHADE_FILTER_BILINEAR = 0,   /* the four nearest texels, weighted by distance */
    SHADE_FILTER_NEAREST,        /* the texel that u, v lie in */
    SHADE_FILTER_TRILINEAR       /* bilinear in the two nearest mipmaps, weighted [Williams83] */
} shade_filter;

/* A picture to sample: u right, v DOWN from the top left corner of row 0; texel (i, j) has its
   centre at ((i + 1/2) / width, (j + 1/2) / height).  A bad texture samples as white. */
typedef struct shade_texture {
    const void  *pixels;
    int          width, height, stride;    /* texels, sizes 1 .. 16384; stride 0 = width */
    shade_format format;
    int          srgb;                     /* non-zero: 8 and 5-6-5 bits decoded before filtering */
    shade_wrap   wrap_u, wrap_v;
    shade_filter filter;
    const struct shade_texture *mipmaps;   /* levels 1, 2, ..., read by TRILINEAR alone */
    int          mipmap_count;
} shade_texture;

/* A picture and its depth buffer in the caller's memory. */
typedef struct shade_target {
    int   width, height;         /* of the whole picture, 1 .. 16384 pixels */
    int   stride;                /* pixels from row to row, of depth too; 0 = width */
    shade_format format;
    void  *color;                /* NULL: depth only */
    float *depth;                /* NULL: no depth buffer, every test passes */
    int   srgb;                  /* non-zero: 8 and 5-6-5 bits are encoded to sRGB when stored */
    int   dither;                /* non-zero: 4 x 4 ordered dither when stored in 5-6-5 bits */
    int   clip_x, clip_y;        /* draw and clear only here, cut to the picture; all four zero: */
    int   clip_width, clip_height;         /* everywhere.  Empty: nothing is drawn */
    int   row_offset, row_count; /* a strip: color and depth hold these rows alone; count 0: all */
} shade_target;

typedef enum shade_interpolation {
    SHADE_INTERPOLATION_PERSPECTIVE = 0,    /* correct: linear in the plane of the triangle */
    SHADE_INTERPOLATION_AFFINE,             /* linear on the screen, to show the fault */
    SHADE_INTERPOLATION_CONSTANT            /* the value of the first vertex, as submitted */
} shade_interpolation;
typedef enum shade_cull { SHADE_CULL_NONE = 0, SHADE_CULL_BACK, SHADE_CULL_FRONT } shade_cull;
typedef enum shade_compare {     /* a fragment passes when its depth is ... than the stored one */
    SHADE_COMPARE_LESS = 0, SHADE_COMPARE_LESS_EQUAL, SHADE_COMPARE_GREATER,
    SHADE_COMPARE_GREATER_EQUAL, SHADE_COMPARE_EQUAL, SHADE_COMPARE_ALWAYS
} shade_compare;
typedef enum shade_blend {       /* s the fragment's colour, a its alpha, d what is there; linear */
    SHADE_BLEND_REPLACE = 0,     /* s */
    SHADE_BLEND_OVER,            /* straight alpha: s a + d (1 - a); alpha: a + d_a (1 - a) */
    SHADE_BLEND_ADD              /* s + d, all four channels */
} shade_blend;

/* What happens to triangles and pixels, in every kind of draw.  Depth decides by positions alone:
   passes over one mesh give the same depth to the bit, whatever they shade and interpolate. */
typedef struct shade_raster {
    shade_cull    cull;
    shade_compare depth_test;
    shade_blend   blend;
    int   depth_read_only;       /* non-zero: test, do not write */
    int   depth_zero_to_one;     /* non-zero: clip space has 0 <= z <= w */
    float depth_bias;            /* added to window depth; what is stored is clamped to [0, 1] */
} shade_raster;

typedef enum shade_shading {
    SHADE_SHADING_PER_FRAGMENT = 0,    /* N, P interpolated, N made unit again, lit   [Phong75] */
    SHADE_SHADING_PER_VERTEX,          /* lit at the vertices, colours interpolated [Gouraud71] */
    SHADE_SHADING_PER_FACE             /* lit once, at the centroid, with the geometric normal */
} shade_shading;

/* What became of the triangles of one call; written from zero by each call.
   triangles = skipped + culled + clipped + rejected + drawn.  Without chunks skipped is 0, and the
   others do not depend on the clip rectangle. */
typedef struct shade_stats {
    long long triangles;
    long long skipped;           /* in a chunk that cannot be seen in the clip rectangle */
    long long culled;            /* facing, or zero area after snapping */
    long long clipped;           /* nothing of it inside the view volume */
    long long rejected;          /* a position that is NaN, infinite or beyond 1e30 */
    long long drawn;
    long long fragments;         /* pixels that passed the depth test (inside the clip rectangle) */
} shade_stats;

/*----------------------------------------------------------------------------------------- >>inline
   What declarations and inline functions need of compilers. */

/* Floats must be evaluated as floats.  For s390x gcc's -std=c99 says double, as glibc had it once;
   SHADE__BEGIN turns that off for this file. */
#if defined(__s390x__) && defined(__GNUC__) && __GNUC__ >= 12 && !defined(__clang__)
#define SHADE__EVAL_FLOAT _Pragma("GCC optimize(\"excess-precision=fast\")")
#elif defined(FLT_EVAL_METHOD) && FLT_EVAL_METHOD != 0 && FLT_EVAL_METHOD != 16
#ifdef __s390x__
#error "shade.h: floats are evaluated in double; compile with -std=gnu99 or -fexcess-precision=fast"
#else
#error "shade.h: floats are evaluated in a wider type; for 32-bit x86: -msse2 -mfpmath=sse"
#endif
#else
#define SHADE__EVAL_FLOAT
#endif

#if defined(__GNUC__) || defined(__clang__)
#define SHADE__INLINE static inline __attribute__((always_inline))
#define SHADE__UNUSED __attribute__((unused))
#define SHADE__64_BYTES __attribute__((aligned(64)))
#elif defined(_MSC_VER)
#define SHADE__INLINE static __forceinline
#define SHADE__UNUSED
#define SHADE__64_BYTES __declspec(align(64))
#else
#define SHADE__INLINE static inline
#define SHADE__UNUSED
#define SHADE__64_BYTES
#endif

/* Rows of packets begin with a vector: unaligned they straddle two lines of cache, 4 % of a lit
   floor, 12 % of a flat fill in cache.  Small packets are for small stacks. */
#if SHADE_LANES < 64
#define SHADE_ALIGNED
#else
#define SHADE_ALIGNED SHADE__64_BYTES
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

/* the builtin is folded with -ffreestanding as well */
#ifndef SHADE_MEMCPY
#if defined(__GNUC__) || defined(__clang__)
#define SHADE_MEMCPY(d, s, n) __builtin_memcpy(d, s, n)
#else
#include <string.h>
#define SHADE_MEMCPY(d, s, n) memcpy(d, s, n)
#endif
#endif
#ifdef SHADE_NO_LIBM
#define SHADE__SQRT(x) shade__own_sqrt(x)
#else
#include <math.h>
#define SHADE__SQRT(x) sqrtf(x)
#endif

/* SHADE_EACH_LANE(i) { ... }   runs the block for i = 0 .. SHADE_LANES - 1.  Compilers turn it into
   vector code when the body is straight arithmetic on arrays indexed by i.  Without the pragma they
   unroll the loop before they vectorise it: 1.5 to 2.4 times slower.  After an if, put braces
   around the whole. */
#if defined(__clang__)
#define SHADE__NO_UNROLL _Pragma("clang loop unroll(disable)")
#elif defined(__GNUC__) && __GNUC__ >= 8
#define SHADE__NO_UNROLL _Pragma("GCC unroll 1")
#else
#define SHADE__NO_UNROLL
#endif
#ifdef __TINYC__
#define SHADE__FOR(i, n) for (ptrdiff_t i = 0; i < (n); i++)
#else
#define SHADE__FOR(i, n) SHADE__NO_UNROLL for (int i = 0; i < (n); i++)
#endif
#define SHADE_EACH_LANE(i) SHADE__FOR(i, SHADE_LANES)

/* C linkage; and arithmetic as it is written, whatever the compiler's options say, because other
   arithmetic gives other bits.  Off are: contraction of a * b + c to one rounding, which depends on
   the processor, and the parts of -ffast-math.  gcc decides again where a function is inlined, by
   the options of the caller: of this file's functions those of the implementation are exact, and
   the inline ones in them.  clang stays fast in ?: and calls, see >>target.  Where clang keeps a
   stack of such states the one before comes back at the end, elsewhere that of the options. */
#ifdef __cplusplus
#define SHADE__OPEN extern "C" {
#define SHADE__CLOSE }
#else
#define SHADE__OPEN
#define SHADE__CLOSE
#endif
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
   Vectors inline; matrices below, their bodies in >>matrix.  Un-suffixed names work on shade_vec3.
   Any finite input gives finite output while it stays below 1e12 (vectors) and 1e6 (matrices). */

SHADE__INLINE shade_vec2 shade_v2(float x, float y) { shade_vec2 v; v.x = x; v.y = y; return v; }
SHADE__INLINE shade_vec3 shade_v3(float x, float y, float z)
{
    shade_vec3 v; v.x = x; v.y = y; v.z = z; return v;
}
SHADE__INLINE shade_vec4 shade_v4(float x, float y, float z, float w)
{
    shade_vec4 v; v.x = x; v.y = y; v.z = z; v.w = w; return v;
}

/* The pattern of a number, and back. */
SHADE__INLINE float shade__bits_float(uint32_t u) { float f; SHADE_MEMCPY(&f, &u, 4); return f; }
SHADE__INLINE uint32_t shade__float_bits(float f) { uint32_t u; SHADE_MEMCPY(&u, &f, 4); return u; }
SHADE__INLINE double shade__bits_double(uint64_t u) { double d; SHADE_MEMCPY(&d, &u, 8); return d; }
SHADE__INLINE uint64_t shade__double_bits(double d)
{
    uint64_t u; SHADE_MEMCPY(&u, &d, 8); return u;
}

/* Square root of x > 0 in double, to 2^-50. */
SHADE__INLINE double shade__root(double x)
{
    double y = shade__bits_double(0x5FE6EB50C7B537A9u - (shade__double_bits(x) >> 1));
    for (int k = 0; k < 5; k++) y *= 1.5 - 0.5 * x * y * y;
    return x * y;
}
/* Correctly rounded square root, as sqrtf: the root of a float is at least 2^-51 from the middle
   between two floats, and shade__root errs by less.  x <= 0 or NaN gives 0. */
static inline float shade__own_sqrt(float x)
{
    if (!(x > 0) || x > FLT_MAX) return x > 0 ? x : 0;
    return (float)shade__root((double)x);
}
SHADE__INLINE float shade__sqrt(float x) { return SHADE__SQRT(x); }

SHADE__INLINE shade_vec3 shade_add(shade_vec3 a, shade_vec3 b)
{
    return shade_v3(a.x + b.x, a.y + b.y, a.z + b.z);
}
SHADE__INLINE shade_vec3 shade_sub(shade_vec3 a, shade_vec3 b)
{
    return shade_v3(a.x - b.x, a.y - b.y, a.z - b.z);
}
/* component by component, as colour times colour */
SHADE__INLINE shade_vec3 shade_mul(shade_vec3 a, shade_vec3 b)
{
    return shade_v3(a.x * b.x, a.y * b.y, a.z * b.z);
}
SHADE__INLINE shade_vec3 shade_scale(shade_vec3 v, float s)
{
    return shade_v3(v.x * s, v.y * s, v.z * s);
}
/* a + s b */
SHADE__INLINE shade_vec3 shade_madd(shade_vec3 a, float s, shade_vec3 b)
{
    return shade_v3(a.x + s * b.x, a.y + s * b.y, a.z + s * b.z);
}
SHADE__INLINE shade_vec3 shade_neg(shade_vec3 v) { return shade_v3(-v.x, -v.y, -v.z); }
SHADE__INLINE float shade_dot(shade_vec3 a, shade_vec3 b)
{
    return a.x * b.x + a.y * b.y + a.z * b.z;
}
/* right-handed: x cross y = z */
SHADE__INLINE shade_vec3 shade_cross(shade_vec3 a, shade_vec3 b)
{
    return shade_v3(a.y * b.z - a.z * b.y, a.z * b.x - a.x * b.z, a.x * b.y - a.y * b.x);
}
SHADE__INLINE float shade_length(shade_vec3 v) { return shade__sqrt(shade_dot(v, v)); }
SHADE__INLINE float shade_distance(shade_vec3 a, shade_vec3 b)
{
    return shade_length(shade_sub(a, b));
}
/* v / |v|; zero where |v| < 1e-18 */
SHADE__INLINE shade_vec3 shade_normalize(shade_vec3 v)
{
    float d = shade_dot(v, v);
    return shade_scale(v, d >= 1e-36f ? 1 / shade__sqrt(d) : 0);
}
/* a + t (b - a): exactly a at t = 0, b to rounding at t = 1; t is not clamped */
SHADE__INLINE shade_vec3 shade_lerp(shade_vec3 a, shade_vec3 b, float t)
{
    return shade_madd(a, t, shade_sub(b, a));
}
SHADE__INLINE float shade__minf(float a, float b) { return a < b ? a : b; }
SHADE__INLINE float shade__maxf(float a, float b) { return a > b ? a : b; }
SHADE__INLINE shade_vec3 shade_min(shade_vec3 a, shade_vec3 b)
{
    return shade_v3(shade__minf(a.x, b.x), shade__minf(a.y, b.y), shade__minf(a.z, b.z));
}
SHADE__INLINE shade_vec3 shade_max(shade_vec3 a, shade_vec3 b)
{
    return shade_v3(shade__maxf(a.x, b.x), shade__maxf(a.y, b.y), shade__maxf(a.z, b.z));
}
/* max(lo, min(v, hi)) by component; a NaN in v gives hi */
SHADE__INLINE shade_vec3 shade_clamp(shade_vec3 v, shade_vec3 lo, shade_vec3 hi)
{
    return shade_max(shade_min(v, hi), lo);
}
/* GLSL's reflect: I - 2 (N.I) N.  I arrives AT the surface, the result leaves it.  N unit. */
SHADE__INLINE shade_vec3 shade_reflect(shade_vec3 incident, shade_vec3 n)
{
    return shade_madd(incident, -2 * shade_dot(n, incident), n);
}
/* The books' mirror direction R = 2 (N.L) N - L = reflect(-L, N). L and R both leave the
   surface. N unit. */
SHADE__INLINE shade_vec3 shade_mirror(shade_vec3 to_light, shade_vec3 n)
{
    return shade_reflect(shade_neg(to_light), n);
}
/* H = (L + V) / |L + V| of unit L and V, both away from the surface; zero where |L + V|^2 <
   1e-12. [Blinn77] */
SHADE__INLINE shade_vec3 shade_halfway(shade_vec3 to_light, shade_vec3 to_eye)
{
    shade_vec3 h = shade_add(to_light, to_eye);
    return shade_dot(h, h) < 1e-12f ? shade_v3(0, 0, 0) : shade_normalize(h);
}
/* Unit normal (b - a) x (c - a), toward the side that sees a, b, c counter-clockwise; zero for a
   degenerate one. */
SHADE__INLINE shade_vec3 shade_face_normal(shade_vec3 a, shade_vec3 b, shade_vec3 c)
{
    return shade_normalize(shade_cross(shade_normalize(shade_sub(b, a)),
                                       shade_normalize(shade_sub(c, a))));
}

SHADE__INLINE shade_vec2 shade_add2(shade_vec2 a, shade_vec2 b)
{
    return shade_v2(a.x + b.x, a.y + b.y);
}
SHADE__INLINE shade_vec2 shade_sub2(shade_vec2 a, shade_vec2 b)
{
    return shade_v2(a.x - b.x, a.y - b.y);
}
SHADE__INLINE shade_vec2 shade_scale2(shade_vec2 v, float s) { return shade_v2(v.x * s, v.y * s); }
SHADE__INLINE float shade_dot2(shade_vec2 a, shade_vec2 b) { return a.x * b.x + a.y * b.y; }
SHADE__INLINE shade_vec2 shade_lerp2(shade_vec2 a, shade_vec2 b, float t)
{
    return shade_add2(a, shade_scale2(shade_sub2(b, a), t));
}
SHADE__INLINE shade_vec4 shade_add4(shade_vec4 a, shade_vec4 b)
{
    return shade_v4(a.x + b.x, a.y + b.y, a.z + b.z, a.w + b.w);
}
SHADE__INLINE shade_vec4 shade_sub4(shade_vec4 a, shade_vec4 b)
{
    return shade_v4(a.x - b.x, a.y - b.y, a.z - b.z, a.w - b.w);
}
SHADE__INLINE shade_vec4 shade_scale4(shade_vec4 v, float s)
{
    return shade_v4(v.x * s, v.y * s, v.z * s, v.w * s);
}
SHADE__INLINE float shade_dot4(shade_vec4 a, shade_vec4 b)
{
    return a.x * b.x + a.y * b.y + a.z * b.z + a.w * b.w;
}
SHADE__INLINE shade_vec4 shade_lerp4(shade_vec4 a, shade_vec4 b, float t)
{
    return shade_add4(a, shade_scale4(shade_sub4(b, a), t));
}

SHADE__INLINE shade_vec3 shade__xyz(shade_vec4 v) { return shade_v3(v.x, v.y, v.z); }
SHADE__INLINE shade_vec4 shade__xyzw(shade_vec3 v, float w) { return shade_v4(v.x, v.y, v.z, w); }
SHADE__INLINE shade_mat3 shade__m3(shade_vec3 a, shade_vec3 b, shade_vec3 c)
{
    shade_mat3 m; m.col[0] = a; m.col[1] = b; m.col[2] = c; return m;
}
SHADE__INLINE shade_mat4 shade__m4(shade_vec4 a, shade_vec4 b, shade_vec4 c, shade_vec4 d)
{
    shade_mat4 m; m.col[0] = a; m.col[1] = b; m.col[2] = c; m.col[3] = d; return m;
}
/* m v */
SHADE__INLINE shade_vec3 shade_mat3_transform(shade_mat3 m, shade_vec3 v)
{
    return shade_v3(m.col[0].x * v.x + m.col[1].x * v.y + m.col[2].x * v.z,
                    m.col[0].y * v.x + m.col[1].y * v.y + m.col[2].y * v.z,
                    m.col[0].z * v.x + m.col[1].z * v.y + m.col[2].z * v.z);
}
SHADE__INLINE shade_vec4 shade_mat4_transform(shade_mat4 m, shade_vec4 v)
{
    return shade_v4(m.col[0].x * v.x + m.col[1].x * v.y + m.col[2].x * v.z + m.col[3].x * v.w,
                    m.col[0].y * v.x + m.col[1].y * v.y + m.col[2].y * v.z + m.col[3].y * v.w,
                    m.col[0].z * v.x + m.col[1].z * v.y + m.col[2].z * v.z + m.col[3].z * v.w,
                    m.col[0].w * v.x + m.col[1].w * v.y + m.col[2].w * v.z + m.col[3].w * v.w);
}
/* a b: the transform that does b first */
SHADE__INLINE shade_mat3 shade_mat3_mul(shade_mat3 a, shade_mat3 b)
{
    return shade__m3(shade_mat3_transform(a, b.col[0]), shade_mat3_transform(a, b.col[1]),
                     shade_mat3_transform(a, b.col[2]));
}
SHADE__INLINE shade_mat4 shade_mat4_mul(shade_mat4 a, shade_mat4 b)
{
    return shade__m4(shade_mat4_transform(a, b.col[0]), shade_mat4_transform(a, b.col[1]),
                     shade_mat4_transform(a, b.col[2]), shade_mat4_transform(a, b.col[3]));
}
/* m (p, 1), divided by its w; not divided where w = 0 */
SHADE__INLINE shade_vec3 shade_mat4_transform_point(shade_mat4 m, shade_vec3 p)
{
    shade_vec4 h = shade_mat4_transform(m, shade__xyzw(p, 1));
    return h.w == 0 ? shade__xyz(h) : shade_v3(h.x / h.w, h.y / h.w, h.z / h.w);
}
/* m (d, 0): translation does not move a direction; not made unit */
SHADE__INLINE shade_vec3 shade_mat4_transform_direction(shade_mat4 m, shade_vec3 d)
{
    return shade__xyz(shade_mat4_transform(m, shade__xyzw(d, 0)));
}

/* det m^-T: the columns are cross products of the columns of m */
SHADE__INLINE shade_mat3 shade__cofactors(shade_mat3 m)
{
    return shade__m3(shade_cross(m.col[1], m.col[2]), shade_cross(m.col[2], m.col[0]),
                     shade_cross(m.col[0], m.col[1]));
}
/* (m^-1)^T, sign and scale kept; the zero matrix where the determinant is 0 or its reciprocal or,
   for entries up to 1e6, the result is beyond floats */
SHADE__INLINE shade_mat3 shade_mat3_inverse_transpose(shade_mat3 m)
{
    shade_mat3 c = shade__cofactors(m);
    float det = shade_dot(m.col[0], c.col[0]), s = det != 0 ? 1 / det : 0;
    shade_vec3 a = shade_scale(c.col[0], s), b = shade_scale(c.col[1], s);
    shade_vec3 d = shade_scale(c.col[2], s), none = shade_v3(0, 0, 0);
    if (s * s <= 1e30f) return shade__m3(a, b, d);    /* |entries| <= 1e6: products below 1e28 */
    s = shade_dot(a, none) + shade_dot(b, none) + shade_dot(d, none);
    return s == 0 ? shade__m3(a, b, d) : shade__m3(none, none, none);    /* NaN: not finite */
}

/* Matrices by formula; their bodies stand in >>matrix.  An inverse with an entry beyond FLT_MAX is
   the zero matrix as well. */
SHADEDEF shade_mat3 shade_mat3_identity(void);
SHADEDEF shade_mat3 shade_mat3_from_mat4(shade_mat4 m);    /* the upper left 3 x 3 */
SHADEDEF shade_mat3 shade_mat3_transpose(shade_mat3 m);
SHADEDEF float      shade_mat3_determinant(shade_mat3 m);  /* a . (b x c) of the columns */
SHADEDEF shade_mat3 shade_mat3_inverse(shade_mat3 m);      /* zero where the determinant is 0 */
SHADEDEF shade_mat4 shade_mat4_identity(void);
SHADEDEF shade_mat4 shade_mat4_transpose(shade_mat4 m);
SHADEDEF float      shade_mat4_determinant(shade_mat4 m);  /* computed in double */
SHADEDEF shade_mat4 shade_mat4_inverse(shade_mat4 m);      /* in double; zero where singular */
SHADEDEF shade_mat4 shade_mat4_translation(shade_vec3 v);
SHADEDEF shade_mat4 shade_mat4_scaling(shade_vec3 v);

/* degrees times pi / 180 */
SHADEDEF float      shade_radians(float degrees);

/* Rotation by the right-hand rule about an axis of any length; the identity for a zero axis.
   Sine and cosine are the library's own, exact to float rounding for |radians| < 1e5 (beyond
   1e9, or NaN, it counts as 0). */
SHADEDEF shade_mat4 shade_mat4_rotation(float radians, shade_vec3 axis);

/* World to eye: eye goes to the origin, center onto the -z axis, up into the upper half of the
   y-z plane. up parallel to the line of sight: some finite up is taken. eye = center: looks down
   -z. */
SHADEDEF shade_mat4 shade_mat4_look_at(shade_vec3 eye, shade_vec3 center, shade_vec3 up);

/* Eye to clip. fovy is the whole vertical angle, aspect is width / height, near and far are
   distances. perspective, frustum, ortho: z to [-w, w], as OpenGL; near beyond far turns depth
   round. perspective_reversed: no far plane, z = near at every depth and w = -z_eye, so z/w falls
   from 1 at near to 0 at infinity; use with depth_zero_to_one and GREATER. Degenerate input
   (near = far, aspect 0, left = right, fovy outside (0, pi), NaN, near or far <= 0 but in ortho):
   the matrix that takes every point to (0, 0, 2, 1), so that nothing is drawn. */
SHADEDEF shade_mat4 shade_mat4_perspective(float fovy, float aspect, float near_z, float far_z);
SHADEDEF shade_mat4 shade_mat4_perspective_reversed(float fovy, float aspect, float near_z);
SHADEDEF shade_mat4 shade_mat4_frustum(float l, float r, float b, float t, float n, float f);
SHADEDEF shade_mat4 shade_mat4_ortho(float l, float r, float b, float t, float n, float f);

/* The matrix that takes normals where m takes points: sign(det) times the cofactors of the upper
   left 3 x 3. Equal to the inverse transpose up to the positive factor |det|, and defined for
   singular m as well (flattening keeps the normal of the plane). Make the result unit after use. */
SHADEDEF shade_mat3 shade_normal_matrix(shade_mat4 m);

/*------------------------------------------------------------------------------------------ >>light
   The equations of >>model.  All vectors point away from the surface.  Everything is defined: no
   input that is free of NaN and infinity gives one.  Error against exact arithmetic, with I the
   brightest light arriving, before its cone dims it: below 5e-5 max(1, |exact|, I) max(1, (n + e) /
   100).  That holds for coefficients of attenuation >= 0, k <= 1 and lights up to 1e6, away from
   the jumps: where N.L, L.S - cos(beta) and, with SHADE_FLAG_TWO_SIDED, N.V differ from 0 by more
   than 1e-6, and |L + V| > 2e-6.  A power with an exponent between 0 and 1 is infinitely steep at
   0: its base has to differ from 0 by 1e-3.  A lamp whose w is neither 0 nor 1 stands at xyz / w
   rounded to floats. */

/* color becomes I_d and I_s; ambient 0, no attenuation.  direction_of_travel: the way light flies;
   aim: where the lamp points; both of any length.  cutoff: from the axis to the edge of the cone,
   0 .. pi.  exponent: e >= 0. */
SHADEDEF shade_light shade_directional_light(shade_vec3 direction_of_travel, shade_vec3 color);
SHADEDEF shade_light shade_point_light(shade_vec3 position, shade_vec3 color);
SHADEDEF shade_light shade_spot_light(shade_vec3 position, shade_vec3 aim, float cutoff_radians,
                                      float exponent, shade_vec3 color);

/* How much of a lamp arrives at P when nothing is in the way: spot / (a + b r + c r^2), to be
   multiplied by I_d or I_s; 1 for a lamp at infinity without a cone.  *L: unit, from P toward the
   lamp, zero where P is the lamp (which is dark then if it has a cone with cos(beta) > 0).
   *distance: r, or FLT_MAX at infinity.  Either may be NULL.  light NULL: all zero. */
SHADEDEF float shade_light_at(const shade_light *light, shade_vec3 point, shade_vec3 *to_light,
                              float *distance);
/* The same for a packet: P and L three rows of SHADE_LANES floats, amount one; L or amount may be
   NULL. */
SHADEDEF void shade_light_at_lanes(const shade_light *light, const float *point, float *to_light,
                                   float *amount);

/* Light leaving P toward eye, term by term.  N is made unit here (zero stays zero: emission and
   ambient are left).  eye: the viewer's position, or the direction toward it with
   SHADE_FLAG_INFINITE_VIEWER.  P, N, eye, lights in one space.  material NULL: white Lambert, that
   is k_d = k_a = 1; lighting NULL: zeros. */
SHADEDEF shade_terms shade_evaluate(const shade_lighting *lighting, const shade_material *material,
                                    shade_vec3 eye, shade_vec3 point, shade_vec3 normal);

/* The sum of the four terms: iteration four. */
SHADEDEF shade_vec3 shade_lit(const shade_lighting *lighting, const shade_material *material,
                              shade_vec3 eye, shade_vec3 point, shade_vec3 normal);

/* What the lanes of a packet are lit with: rows of SHADE_LANES floats.  NULL means the default. */
typedef struct shade_rows {
    const float *position;      /* P: 3 rows, x row, y row, z row */
    const float *normal;        /* N: 3 rows, of any length */
    const float *albedo;        /* 3 rows that multiply k_d and k_a; NULL: 1 */
    const float *specular;      /* 3 rows that multiply k_s; NULL: 1 */
    const float *visibility;    /* one row a light, which multiplies its I_d and I_s; NULL: 1 */
} shade_rows;

/* shade_lit for a packet, what fragment shaders call: lane i of the rows gives lane i of rgb (3
   rows, which must not overlap the others).  Three rows follow each other: pass in->varying[k], or
   n[0] of a float n[3][SHADE_LANES].  Visibility is 0 in full shadow; any value multiplies as it
   is; ambient light is never hidden; COOL_TO_WARM knows no shadow.  Each lane depends on itself
   alone and has the bits of shade_lit.  lighting, rows, position or normal NULL: rgb is 0. */
SHADEDEF void shade_lit_lanes(const shade_lighting *lighting, const shade_material *material,
                              shade_vec3 eye, const shade_rows *rows, float *rgb);

/* The terms one by one.  N, L, V unit, taken as given. */
/* max(0, N.L) */
SHADEDEF float shade_lambert(shade_vec3 normal, shade_vec3 to_light);
/* B max(0, R.V)^n, n the exponent, R = 2 (N.L) N - L; 0 where N.L <= 0               [Phong75] */
SHADEDEF float shade_phong_specular(shade_vec3 normal, shade_vec3 to_light, shade_vec3 to_eye,
                                    float exponent);
/* B max(0, N.H)^n, H = (L + V) / |L + V|; 0 where N.L <= 0 or |L + V|^2 < 1e-12      [Blinn77] */
SHADEDEF float shade_blinn_phong_specular(shade_vec3 normal, shade_vec3 to_light,
                                          shade_vec3 to_eye, float exponent);
/* 1 / (a + b r + c r^2), at most 1e20.  a = b = c = 0: 1.  a = 0: r is taken as max(r, 1e-4). */
SHADEDEF float shade_attenuation(float a, float b, float c, float r);
/* (L.S)^e where L.S >= cos_cutoff, else 0; S = -aim / |aim|.  L toward the light.  aim zero: 1. */
SHADEDEF float shade_spot(shade_vec3 to_light, shade_vec3 aim, float cos_cutoff, float exponent);

/* The reflectance f_r that, times irradiance I (N.L), is the reflected light: k_d + k_s (N.H)^n for
   BLINN_PHONG, k_d + k_s (R.V)^n for PHONG, k_d for LAMBERT, 0 else.  Ungated: the weight N.L does
   that.  N, L, V unit. */
SHADEDEF shade_vec3 shade_brdf(const shade_material *material, shade_model model, shade_vec3 normal,
                               shade_vec3 to_light, shade_vec3 to_eye);
/* cool + k_w (warm - cool), k_w = (1 + N.L) / 2.  N, L unit.                         [Gooch98] */
SHADEDEF shade_vec3 shade_cool_to_warm(shade_vec3 normal, shade_vec3 to_light, shade_vec3 cool,
                                       shade_vec3 warm);
/* 4 alpha: the Blinn-Phong exponent whose highlight, lit from the front, looks like Phong's. */
SHADEDEF float shade_blinn_exponent(float phong_exponent);
/* x^n for x in [0, 1] (clamped to it), n >= 0 (below 0 counts as 0); x^0 = 1, also 0^0.  Never
   NaN.  Absolute error below 2e-6 for n up to 1e6. */
SHADEDEF float shade_power(float x, float n);

/* The classic materials of the OpenGL "teapots" program, in its own numbers: colours as a display
   shows them.  A target without srgb takes them as they are; one with srgb takes what
   shade_linear_material makes of them.  Shininess is the table's last column times 128.
                                                                                      [Kilgard94] */
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
/* The material, and its name: "emerald", "black plastic", ...  Out of range: white Lambert, "". */
SHADEDEF shade_material shade_preset_material(shade_preset preset);
SHADEDEF const char    *shade_preset_name(shade_preset preset);

/* Between a display's colours and linear light: the sRGB curve of each component, clamped to
   [0, 1], NaN as 0; absolute error below 4e-6.                                       [IEC61966] */
SHADEDEF shade_vec3 shade_linear_from_srgb(shade_vec3 display);
SHADEDEF shade_vec3 shade_srgb_from_linear(shade_vec3 linear);
/* The linear colour of 0xRRGGBB as a display shows it; bits above 24 are ignored. */
SHADEDEF shade_vec3 shade_rgb(uint32_t rrggbb);
/* The four colours of a material through shade_linear_from_srgb; shininess stays. */
SHADEDEF shade_material shade_linear_material(shade_material display);

/*------------------------------------------------------------------------------------------- >>draw
   vertex shader -> assemble -> clip -> rasterize -> fragment shader -> depth, blend, store.
   Bad arguments are refused before any pixel changes, in this order: NULLs, target, mesh, state,
   lights, texture, indices.  Nothing is ever written outside the target's rows, width and clip
   rectangle. */

/* What a result means, with the fields to look at, in English; never NULL. */
SHADEDEF const char *shade_result_string(shade_result result);

/* Fills the clip rectangle of both buffers.  A NaN depth is SHADE_ERROR_ARGUMENT. */
SHADEDEF shade_result shade_clear(const shade_target *target, shade_vec4 color, float depth);

/* The picture (of a strip: its rows) as a binary PPM, "P6".  RGBA32F is clamped, and encoded where
   srgb is set.  A write function that returns non-zero ends it with SHADE_ERROR_IO; a file that
   could not be written whole stays behind. */
typedef int shade_write_fn(void *user, const void *bytes, size_t size);
SHADEDEF shade_result shade_encode_ppm(shade_write_fn *sink, void *user,
                                       const shade_target *target);
#ifndef SHADE_NO_STDIO
SHADEDEF shade_result shade_write_ppm(const char *path, const shade_target *target);
#endif

/* out = in, averaged over factor x factor pixels in linear light: supersampling.  in is factor
   times as wide and high (its strip has factor times the rows); factor 1 .. 8, 1 converts formats
   and may do so in place where pixels are of equal size.  Depth is left alone; out's clip
   rectangle holds. */
SHADEDEF shade_result shade_resolve(const shade_target *out, const shade_target *in, int factor);

/* A texture at u, v, linear RGBA.  lod: level of detail, log2 of texels per pixel; below 0 counts
   as 0.  NaN or infinite u, v, lod count as 0. */
SHADEDEF shade_vec4 shade_sample(const shade_texture *texture, float u, float v, float lod);
/* The same for a packet: rows of SHADE_LANES floats; lod NULL: 0; rgba: 4 rows that do not overlap
   the others. */
SHADEDEF void shade_sample_lanes(const shade_texture *texture, const float *u, const float *v,
                                 const float *lod, float *rgba);
/* Levels below the full size, each half as wide and high, rounded down, to 1 x 1; and their bytes,
   packed tightly.  0 for sizes or formats that no texture has. */
SHADEDEF int    shade_mipmap_count(int width, int height);
SHADEDEF size_t shade_mipmap_bytes(int width, int height, shade_format format);
/* Fills levels[shade_mipmap_count] and memory (aligned to 4, shade_mipmap_bytes) with means in
   linear light, and points the texture at them. */
SHADEDEF shade_result shade_build_mipmaps(shade_texture *texture, shade_texture *levels,
                                          void *memory, size_t bytes);

/* Packets.  The lanes from count on repeat the last live one: compute every lane. */
typedef struct shade_vertex_ids {                 /* vertices to shade */
    int      count;
    uint32_t index[SHADE_LANES];                  /* gl_VertexID; fetch your own attributes by it */
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
    float    varying[SHADE_MAX_VARYINGS][SHADE_LANES];    /* rows past pipeline.varyings: unset */
    uint32_t primitive[SHADE_LANES];              /* index of the triangle in this draw */
    uint32_t front[SHADE_LANES];                  /* 1: front-facing, 0: back-facing */
    float    lod[SHADE_LANES];                    /* of pipeline.lod_texture; without it 0 */
} shade_fragments;
typedef struct shade_colors {
    SHADE_ALIGNED float color[4][SHADE_LANES];    /* linear RGBA, preset to 0, 0, 0, 1 */
    uint32_t discard[SHADE_LANES];                /* preset to 0; else: the pixel stays as it was */
} shade_colors;

/* Shaders work on whole packets: write plain loops with SHADE_EACH_LANE and the compiler makes
   vectors. */
typedef void shade_vertex_shader(const void *uniforms, const shade_vertex_ids *SHADE_RESTRICT in,
                                 shade_vertices *SHADE_RESTRICT out);
typedef void shade_fragment_shader(const void *uniforms, const shade_fragments *SHADE_RESTRICT in,
                                   shade_colors *SHADE_RESTRICT out);

/* With lod_texture, fragments come with lod = log2 of the longer of the two steps, in its texels,
   that u, v make from a pixel to the next one right and below: the exact derivatives of the
   perspective interpolation at the pixel, whatever interpolation is, for shade_sample_lanes. */
typedef struct shade_pipeline {
    shade_vertex_shader   *vertex;
    shade_fragment_shader *fragment;              /* NULL: depth only */
    const void            *uniforms;              /* handed to both shaders */
    int                    varyings;              /* floats per vertex, 0 .. SHADE_MAX_VARYINGS */
    shade_interpolation    interpolation;
    shade_raster           raster;
    int                    may_discard;           /* depth is tested and written after the shader */
    const shade_texture   *lod_texture;           /* NULL: no lod */
    int                    lod_varying;           /* k: varyings k, k + 1 are its u, v */
} shade_pipeline;

/* Draws index_count / 3 triangles.  indices NULL: vertices 0, 1, 2, ...  A vertex shared by near
   triangles is shaded about once.  Clipped are near and far, x and y only beyond 3 w.  Facing is
   decided once per triangle, on the screen.  stats may be NULL.  No colour buffer: the fragment
   shader runs only where may_discard is set.  Threads: let each draw the same with its own clip
   rectangle (or target); same bits as one thread. */
SHADEDEF shade_result shade_draw(const shade_target *target, const shade_pipeline *pipeline,
                                 const uint32_t *indices, int index_count, int vertex_count,
                                 shade_stats *stats);

typedef struct shade_mesh {       /* caller's arrays; strides in BYTES, 0 = tight, multiples of 4 */
    const float *positions;  int position_stride;    /* x, y, z */
    const float *normals;    int normal_stride;      /* any length; NULL: the normal of each face */
    const float *texcoords;  int texcoord_stride;    /* u, v */
    const float *colors;     int color_stride;       /* R, G, B: multiplies k_d and k_a; NULL: 1 */
    int vertex_count;
    const uint32_t *indices; int index_count;        /* NULL: vertices in threes */
    const struct shade_chunk *chunks; int chunk_count;    /* NULL: all triangles, none skipped */
} shade_mesh;

/* Triangles first .. first + count - 1 of a mesh, and a box around them in object space.  With
   chunks, exactly their triangles are drawn and picked, chunk after chunk (a list of 0: nothing),
   and those whose box cannot be seen, or met by a ray, are skipped whole: a triangle in two chunks
   is drawn twice, one in none is not drawn.  A box is believed: one that is too small hides
   triangles, and nothing else; one with NaN, or with low > high, is always looked into. */
typedef struct shade_chunk {
    shade_vec3 low, high;
    int first, count;
} shade_chunk;

typedef struct shade_draw_state {                 /* how one mesh is drawn */
    shade_mat4 model, view, projection;           /* zero: identity; view without scale */
    const shade_material *material;               /* NULL: white Lambert */
    shade_lighting lighting;                      /* light positions in world space */
    shade_shading shading;
    const shade_texture *diffuse_map;             /* times k_d and k_a; ignored without texcoords */
    float transparency;                           /* 0 opaque .. 1 invisible */
    float alpha_cutoff;                           /* pixels of less alpha are cut; 0 .. 1 */
    shade_raster raster;
    shade_fragment_shader *fragment;              /* NULL: the equations; see shade_draw_mesh */
    const void *uniforms;                         /* handed to it */
} shade_draw_state;

/* A whole mesh by the equations of >>model, in world space.  The eye is the camera of view (with
   SHADE_FLAG_INFINITE_VIEWER: its backward axis).  Per face: lit at the centroid with the
   geometric normal, in the colour of the first vertex; a map still varies by the pixel.
     Alpha is (1 - transparency) times the map's.  REPLACE stores colour and alpha, OVER blends by
   alpha, ADD adds the colour times alpha.  Pixels whose alpha is below alpha_cutoff keep colour
   and depth, in depth-only draws too, and are no fragments of stats; equal alpha is drawn.  Draw
   what is opaque first, the rest from back to front; transparency 1 still writes depth.
     A fragment shader of the state colours the pixels of PER_FRAGMENT shading in place of the
   equations.  It gets P in varyings 0 .. 2, N in 3 .. 5 (world space; unit at the vertices, not
   between them), the vertex colour in 6 .. 8 (1 without colours), u, v in 9 and 10 (0 without
   texcoords), and lod of diffuse_map.  It samples maps by itself: alpha is (1 - transparency) times
   its color[3], and ADD, OVER and alpha_cutoff work on that.  What it discards is discarded.  In
   depth-only draws it is called where alpha_cutoff > 0 alone. */
SHADEDEF shade_result shade_draw_mesh(const shade_target *target, const shade_mesh *mesh,
                                      const shade_draw_state *state, shade_stats *stats);

/* Why a draw gives no picture, or the wrong one, and which field to change: one plain sentence, ""
   where nothing is suspicious; never NULL.  Pass what shade_draw_mesh took, after it, with its
   stats; NULL stats: what cannot be told without them is left out.  It knows every refusal by its
   field, matrices that are transposed, swapped or in degrees, meshes out of view, culling, depth
   that was not cleared, light that does not arrive.  Nothing is written, not even to a static
   variable.  Looks at every triangle twice: for when a picture is black, not for every frame. */
SHADEDEF const char *shade_explain(const shade_target *target, const shade_mesh *mesh,
                                   const shade_draw_state *state, const shade_stats *stats);

/* How many chunks shade_mesh_chunks makes of a list of indices; triangles as there.  0 for negative
   numbers, and for an index_count that is no multiple of 3. */
SHADEDEF int shade_chunk_count(int index_count, int triangles);
/* Fills chunks with the boxes of runs of so many triangles (0: 128) of the mesh, whose own chunks
   are ignored.  A corner that is NaN or infinite is left out of its box.
     indices NULL: the triangles stay in their order, which serves where neighbours in the list are
   neighbours in space.  Else room for as many indices as the mesh has, or vertices where it has
   none: it receives the triangles sorted in space, for mesh.indices of draws and picks.  Sorting
   splits the list at the median of its longest axis again and again, in n log n steps and no other
   memory; the order is the same on every machine.
     chunks, room for capacity of them, and indices overlap none of the mesh's arrays.  Too little
   capacity: SHADE_ERROR_CAPACITY, and nothing changes. */
SHADEDEF shade_result shade_mesh_chunks(const shade_mesh *mesh, int triangles, shade_chunk *chunks,
                                        int capacity, uint32_t *indices);
/* 0 only if nothing inside the box can reach a pixel of the target's clip rectangle and strip:
   draws of meshes skip chunks by it, your own pipelines ranges of their indices.  It allows for all
   rounding of transforms and clipping, and for any w.  A zero matrix is the identity.  1 for NaN,
   for low > high, and for a bad target, which the draw refuses. */
SHADEDEF int shade_box_visible(const shade_target *target, shade_mat4 clip_from_object,
                               int depth_zero_to_one, shade_vec3 low, shade_vec3 high);

typedef enum shade_cap { SHADE_CAP_BUTT = 0, SHADE_CAP_SQUARE } shade_cap;
typedef struct shade_line_state {
    shade_mat4    clip_from_points;               /* zero: identity */
    float         width;                          /* pixels; 0: 1 */
    shade_cap     cap;                            /* SQUARE: half the width longer, closes joints */
    shade_vec4    color;
    shade_raster  raster;                         /* cull is ignored */
} shade_line_state;
/* point_count / 2 lines between pairs of points, each the two triangles of its rectangle on the
   screen; stats count triangles.  Over a filled mesh use SHADE_COMPARE_LESS_EQUAL with a small
   negative bias.  An odd or negative count is SHADE_ERROR_MESH. */
SHADEDEF shade_result shade_draw_lines(const shade_target *target, const shade_vec3 *points,
                                       int point_count, const shade_line_state *state,
                                       shade_stats *stats);

/* normals[vertex_count]: the unit mean of the faces around each vertex, weighted by their angle
   there; zero for a vertex without faces.  Faces without area add nothing.           [Thurmer98] */
SHADEDEF shade_result shade_mesh_normals(const shade_mesh *mesh, shade_vec3 *normals);
/* normals[index_count]: the mean, as above, of those faces around the corner's position whose
   normals have a cosine of at least cos_crease with the corner's own face; vertices of equal
   position are one.  Time grows with the square of the faces around a position.  memory: aligned
   to 4, shade_mesh_corner_normals_bytes (0 for a bad mesh). */
SHADEDEF size_t       shade_mesh_corner_normals_bytes(const shade_mesh *mesh);
SHADEDEF shade_result shade_mesh_corner_normals(const shade_mesh *mesh, float cos_crease,
                                                shade_vec3 *normals, void *memory, size_t bytes);

/* The edges of a mesh, each once, a < b, with one or two triangles (-1: none); a third triangle
   makes a further entry.  Sorted by a, then b.  Room for index_count entries is enough; less is
   refused with SHADE_ERROR_CAPACITY and the number in *count. */
typedef struct shade_edge { uint32_t a, b; int32_t triangle[2]; } shade_edge;
SHADEDEF shade_result shade_mesh_edges(const shade_mesh *mesh, shade_edge *edges, int capacity,
                                       int *count);
/* (e.n0)(e.n1) <= 0: one face is seen from the front, the other from behind.  e: edge to eye. */
SHADEDEF int shade_is_silhouette(shade_vec3 to_eye, shade_vec3 n0, shade_vec3 n1);
/* n0.n1 <= threshold, unit normals. */
SHADEDEF int shade_is_crease(shade_vec3 n0, shade_vec3 n1, float threshold);

/* World-space ray through window point x, y (pixel centres at + 1/2), direction unit: from the
   eye, or with an orthographic projection from the near plane.  A degenerate camera: direction
   zero. */
typedef struct shade_ray { shade_vec3 origin, direction; } shade_ray;
SHADEDEF shade_ray shade_pixel_ray(shade_mat4 view, shade_mat4 projection, int width, int height,
                                   float x, float y);
/* 1 if the ray meets the triangle, from either side, at origin + t direction, t >= 0, at the point
   barycentric.x a + barycentric.y b + barycentric.z c.  t and barycentric may be NULL.
                                                                                      [Moller97] */
SHADEDEF int shade_intersect(shade_ray ray, shade_vec3 a, shade_vec3 b, shade_vec3 c, float *t,
                             shade_vec3 *barycentric);
/* The index of the nearest triangle of a mesh that a world-space ray meets, as shade_intersect
   does, with the mesh placed by model (zero: identity); of equally near ones the lowest index.  One
   whose points lie on a line is not met, however model rounds them, and a point that rounding puts
   outside of the triangle's own box does not count.  -1: none, or a bad mesh; *t and *barycentric
   are left alone then.  Either may be NULL.  Looks at every triangle, or at those of the chunks
   whose box the ray meets; of a mesh with chunks only their indices are checked. */
SHADEDEF int shade_pick(const shade_mesh *mesh, shade_mat4 model, shade_ray ray, float *t,
                        shade_vec3 *barycentric);

SHADE__END
#endif /* SHADE_H */

#ifdef SHADE_IMPLEMENTATION
#ifndef SHADE__IMPLEMENTED
#define SHADE__IMPLEMENTED

/*----------------------------------------------------------------------------------------- >>target
   What the implementation needs of compilers and processors.                              >>base */

/* clang has no pragma that makes ?: and calls exact: minima and maxima would lose NaN and -0. */
#if defined(__clang__) && !defined(SHADE_ALLOW_FAST_MATH) && \
    (defined(__FAST_MATH__) || (defined(__FINITE_MATH_ONLY__) && __FINITE_MATH_ONLY__ > 0))
#error "shade.h: clang's -ffast-math gives other bits; compile this file with -fno-fast-math, or \
define SHADE_ALLOW_FAST_MATH"
#endif

#ifndef SHADE_NO_STDIO
#include <stdio.h>
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
#if defined(__GNUC__) || defined(__clang__)
#define SHADE_MEMSET(d, c, n) __builtin_memset(d, c, n)
#else
#include <string.h>
#define SHADE_MEMSET(d, c, n) memset(d, c, n)
#endif
#endif

SHADE__BEGIN

/* whether what is only faster has code of its own */
#ifdef __OPTIMIZE_SIZE__
#define SHADE__TWICE 0
#else
#define SHADE__TWICE 1
#endif

/* gcc would also turn loops that fill rows into calls or rep stos: 9 % of a flat fill.
   Not as for counting branches. */
#if defined(__GNUC__) && !defined(__clang__)
#if defined(__OPTIMIZE_SIZE__) || defined(SHADE__AS_COMPILED)
#pragma GCC optimize("fp-contract=off", "no-tree-loop-distribute-patterns")
#else
#pragma GCC optimize("O2", "fp-contract=off", "no-tree-loop-distribute-patterns", \
                     "no-inline-functions")
#endif
#endif

#if defined(__GNUC__) || defined(__clang__)
#define SHADE__NOINLINE __attribute__((noinline))
#define SHADE__COLD __attribute__((noinline, cold))    /* a quarter smaller */
#define SHADE__LOWEST_BIT(x) __builtin_ctz(x)
#define SHADE__UNLIKELY(x) __builtin_expect((x) != 0, 0)
typedef uint32_t __attribute__((may_alias)) shade__word;    /* of memory of any type */
#else
#ifdef _MSC_VER
#define SHADE__NOINLINE __declspec(noinline)
#else
#define SHADE__NOINLINE
#endif
#define SHADE__COLD SHADE__NOINLINE
#define SHADE__LOWEST_BIT(x) shade__lowest_bit(x)
#define SHADE__UNLIKELY(x) (x)
typedef uint32_t shade__word;
#endif

#ifndef SHADE__ANY_WIDTH
#ifdef __AVX512VL__
#define SHADE__ANY_WIDTH 16
#elif defined(__AVX2__)
#define SHADE__ANY_WIDTH 8
#else
#define SHADE__ANY_WIDTH 4
#endif
#endif

/* __builtin_cpu_supports asks __cpu_model, which the libraries that clang links for Microsoft's
   ABI and those of zig do not have.  zig has no macro: its headers lie beside its own library. */
#ifdef SHADE_NO_LIBM
#undef SHADE_NO_DISPATCH
#define SHADE_NO_DISPATCH
#elif defined(__clang__) && !defined(SHADE_NO_DISPATCH)
#if defined(_MSC_VER) || __has_include(<../std/std.zig>)
#define SHADE_NO_DISPATCH
#endif
#endif

/* Wide code from any build: on x86-64 the bodies of hot loops (name_body, always inlined) are
   compiled for SSE2, AVX2 and AVX-512 and chosen by the processor at each call, without a global
   of ours. Same bits on every path: no FMA. SHADE__LEVEL may be defined to an int expression (0,
   1, 2) by tests to force a path. */
#define SHADE__BUILD(name, level, attribute, width, parameters, arguments) \
    attribute static SHADE__NOINLINE void name##_##level parameters \
    { \
        enum { shade__width = width }; \
        name##_body arguments; \
    }
#define SHADE__DISPATCH_ANY(name, parameters, arguments) \
    typedef void name##_fn parameters; \
    SHADE__BUILD(name, any, , SHADE__ANY_WIDTH, parameters, arguments)
#if !defined(SHADE_NO_DISPATCH) && defined(__x86_64__) && (defined(__GNUC__) || defined(__clang__))
#ifndef SHADE__LEVEL
#define SHADE__LEVEL \
    (__builtin_cpu_supports("avx512vl") && __builtin_cpu_supports("avx512bw") && \
     __builtin_cpu_supports("avx512dq") ? 2 : __builtin_cpu_supports("avx2") ? 1 : 0)
#endif
#ifdef __clang__
#define SHADE__AVX512 __attribute__((target("avx512f,avx512bw,avx512dq,avx512vl")))
#else
#define SHADE__AVX512 \
    __attribute__((target("avx512f,avx512bw,avx512dq,avx512vl,prefer-vector-width=512")))
#endif
#define SHADE__AVX2 __attribute__((target("avx2")))
#define SHADE__DISPATCH(name, parameters, arguments) \
    SHADE__DISPATCH_ANY(name, parameters, arguments) \
    SHADE__BUILD(name, avx2, SHADE__AVX2, 8, parameters, arguments) \
    SHADE__BUILD(name, avx512, SHADE__AVX512, 16, parameters, arguments) \
    static name##_fn *name##_pick(void) \
    { \
        int level = SHADE__LEVEL; \
        return level == 2 ? name##_avx512 : level == 1 ? name##_avx2 : name##_any; \
    }
/* for loops that AVX-512 makes no faster */
#define SHADE__DISPATCH_AVX2(name, parameters, arguments) \
    SHADE__DISPATCH_ANY(name, parameters, arguments) \
    SHADE__BUILD(name, avx2, SHADE__AVX2, 8, parameters, arguments) \
    static name##_fn *name##_pick(void) { return (SHADE__LEVEL) ? name##_avx2 : name##_any; }
#else
#define SHADE__DISPATCH(name, parameters, arguments) \
    SHADE__DISPATCH_ANY(name, parameters, arguments) \
    static name##_fn *name##_pick(void) { return name##_any; }
#define SHADE__DISPATCH_AVX2 SHADE__DISPATCH
#endif

/*------------------------------------------------------------------------------------------- >>base
   Words the rest is written in: numbers as bit patterns, clamps without branches, dispatch.
     holds   Loops over lanes select by masks and clamp by integers, because gcc turns float selects
             into branches and leaves the loop scalar.  A mask is all ones or zeros.   >>matrix */

#define SHADE__ZERO(x) SHADE_MEMSET(&(x), 0, sizeof(x))

SHADE__INLINE int shade__min(int a, int b) { return a < b ? a : b; }
SHADE__INLINE int shade__max(int a, int b) { return a > b ? a : b; }

/* 1 << i: shifts that differ per lane do not vectorise on SSE2 */
static const uint32_t shade__bit[32] = {
    0x1, 0x2, 0x4, 0x8, 0x10, 0x20, 0x40, 0x80, 0x100, 0x200, 0x400, 0x800, 0x1000, 0x2000,
    0x4000, 0x8000, 0x10000, 0x20000, 0x40000, 0x80000, 0x100000, 0x200000, 0x400000, 0x800000,
    0x1000000, 0x2000000, 0x4000000, 0x8000000, 0x10000000, 0x20000000, 0x40000000, 0x80000000
};

/* index of the lowest bit set; x != 0 */
SHADE__INLINE int shade__lowest_bit(uint32_t x)
{
    int n = 0;
    while (!(x >> n & 1)) n++;
    return n;
}
/* x where the mask is set, else +0 */
SHADE__INLINE float shade__keep(float x, uint32_t mask)
{
    return shade__bits_float(shade__float_bits(x) & mask);
}
/* b where the mask is set, else a */
SHADE__INLINE uint32_t shade__choose(uint32_t a, uint32_t b, uint32_t mask)
{
    return a ^ ((a ^ b) & mask);
}
SHADE__INLINE float shade__select(float a, float b, uint32_t mask)
{
    return shade__bits_float(shade__choose(shade__float_bits(a), shade__float_bits(b), mask));
}
/* |x| */
SHADE__INLINE double shade__size(double x)
{
    return shade__bits_double(shade__double_bits(x) & 0x7FFFFFFFFFFFFFFFu);
}
SHADE__INLINE uint32_t shade__mask(int condition) { return 0u - (uint32_t)condition; }

/* clamp(x, lo, hi) by the integer order of bit patterns, which is the order of non-negative
   floats and puts every negative below them.   pre: 0 <= lo <= hi; x is not NaN: its sign, which
   differs between processors, would choose the end */
SHADE__INLINE float shade__clamp_bits(float x, float lo, float hi)
{
    int32_t i = (int32_t)shade__float_bits(x), least = (int32_t)shade__float_bits(lo);
    i = shade__min(shade__max(i, least), (int32_t)shade__float_bits(hi));
    return shade__bits_float((uint32_t)i);
}
/* clamp(x, 0, 1), NaN 0 */
SHADE__INLINE float shade__unit(float x)
{
    int32_t i = (int32_t)shade__float_bits(shade__keep(x, shade__mask(x > 0)));
    return shade__bits_float((uint32_t)shade__min(i, 0x3F800000));
}
/* |x| finite and at most limit, which is finite */
SHADE__INLINE int shade__within(float x, float limit)
{
    return (shade__float_bits(x) & 0x7FFFFFFFu) <= shade__float_bits(limit);
}
SHADE__INLINE int shade__is_zero(shade_vec3 v)
{
    return !((shade__float_bits(v.x) | shade__float_bits(v.y) | shade__float_bits(v.z)) << 1);
}
SHADE__INLINE int shade__finite3(shade_vec3 v)
{
    return shade__within(v.x, FLT_MAX) && shade__within(v.y, FLT_MAX) &&
           shade__within(v.z, FLT_MAX);
}
/* shade_normalize where no loop over lanes wants it: one copy of its 160 bytes */
static SHADE__NOINLINE shade_vec3 shade__unit_vector(shade_vec3 v) { return shade_normalize(v); }

/* 1/sqrt(x) for lanes; below 1e-36 some number.  A bit trick and its tuned Newton step [Kadlec10],
   error 6.5e-4, then one cubic step y + y e (1/2 + 3/8 e), e = 1 - x y^2.  Relative error below
   2e-7 over all normal x.  sqrtf would keep the loop scalar: it may set errno. */
SHADE__INLINE float shade__rsqrt_normal(float x)
{
    float y = shade__bits_float(0x5F1FFFF9u - (shade__float_bits(x) >> 1)), e;
    y *= 0.703952253f * (2.38924456f - x * y * y);
    e = 1 - x * y * y;
    return y + y * e * (0.5f + 0.375f * e);
}
/* 0 where x < 1e-36, so that vectors shorter than 1e-18 normalise to zero */
SHADE__INLINE float shade__rsqrt(float x)
{
    return shade__keep(shade__rsqrt_normal(x), shade__mask(x >= 1e-36f));
}

/* Rows of vectors. */
typedef struct shade__v3 { float x[SHADE_LANES], y[SHADE_LANES], z[SHADE_LANES]; } shade__v3;

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
/* The same of four rows, stride apart. */
SHADE__INLINE void shade__put4(float *rows, int stride, int i, shade_vec4 v)
{
    rows[i] = v.x;
    rows[i + stride] = v.y;
    rows[i + 2 * stride] = v.z;
    rows[i + 3 * stride] = v.w;
}
/* Three rows of floats as the public functions take them; NULL stays NULL. */
SHADE__INLINE const shade__v3 *shade__rows_of(const float *rows)
{
    return (const shade__v3 *)(const void *)rows;
}

SHADEDEF const char *shade_result_string(shade_result result)
{
    switch (result) {
    case SHADE_OK: return "no error";
    case SHADE_ERROR_ARGUMENT:
        return "bad argument: a pointer that must not be NULL, a factor, sizes that do not fit";
    case SHADE_ERROR_TARGET:
        return "bad target: width, height, stride, format, color and depth both NULL, "
               "clip_width, clip_height, row_offset, row_count";
    case SHADE_ERROR_MESH:
        return "bad mesh: positions NULL, a negative count, a stride that is negative or no "
               "multiple of 4, chunks outside of the triangles";
    case SHADE_ERROR_STATE:
        return "bad state: an unknown enumerator, transparency, alpha_cutoff, depth_bias, width, "
               "varyings, cos_crease, or a fragment shader without per-fragment shading";
    case SHADE_ERROR_LIGHTS: return "bad lighting: lights NULL with a light_count, unknown model";
    case SHADE_ERROR_TEXTURE:
        return "bad texture: pixels NULL, width, height, stride, format, wrap, filter, or "
               "lod_varying";
    case SHADE_ERROR_INDEX:
        return "bad indices: one at or past vertex_count, or no whole number of triangles";
    case SHADE_ERROR_CAPACITY: return "not enough room in the caller's memory";
    case SHADE_ERROR_IO: return "writing failed";
    default: return "unknown result";
    }
}

/*----------------------------------------------------------------------------------------- >>matrix
   Matrices of the public part: formulas as in GLM, the sums of inverses in double.
     holds   Degenerate cameras put every point at z = 2, w = 1, outside near or far in every
             convention of depth: nothing is drawn.                                     >>power */

/* Sine and cosine, to 1e-16 of the reduced argument: x - k pi/2 with pi/2 in two parts, the high
   one of 33 bits so that k times it is exact for |k| < 2^20, and Taylor series on [-pi/4, pi/4]
   (next terms below 5e-17). */
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
    float s = shade_dot(a.col[0], c.col[0]) < 0 ? -1.0f : 1.0f;
    for (int k = 0; k < 3; k++) c.col[k] = shade_scale(c.col[k], s);
    return c;
}

/* shade_mat4_mul as one copy */
static SHADE__NOINLINE shade_mat4 shade__mat4_product(const shade_mat4 *a, const shade_mat4 *b)
{
    return shade_mat4_mul(*a, *b);
}
static shade_mat4 shade__zero_matrix(void)
{
    shade_mat4 m;
    SHADE__ZERO(m);
    return m;
}
SHADEDEF shade_mat4 shade_mat4_scaling(shade_vec3 v)
{
    return shade__m4(shade_v4(v.x, 0, 0, 0), shade_v4(0, v.y, 0, 0), shade_v4(0, 0, v.z, 0),
                     shade_v4(0, 0, 0, 1));
}
SHADEDEF shade_mat4 shade_mat4_identity(void) { return shade_mat4_scaling(shade_v3(1, 1, 1)); }
static shade_mat4 shade__or_identity(shade_mat4 m)
{
    for (int k = 0; k < 16; k++)
        if (((const float *)&m)[k] != 0) return m;
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
    for (int k = 0; k < 16; k++) ((float *)&t)[k] = ((const float *)&m)[k % 4 * 4 + k / 4];
    return t;
}

static void shade__doubles(const shade_mat4 *m, double *e)
{
    for (int k = 0; k < 16; k++) e[k] = (double)((const float *)m)[k];
}

/* The 2 x 2 minors of columns a, b, of rows xy xz xw yz yw zw: what determinant and inverse
   share. */
static void shade__minors(const double *a, const double *b, double *m)
{
    for (int i = 0; i < 3; i++)
        for (int k = i + 1; k < 4; k++) *m++ = a[i] * b[k] - b[i] * a[k];
}
/* The entries, the minors of either pair of columns, and the determinant. */
static double shade__expand(const shade_mat4 *m, double *e, double *s, double *c)
{
    shade__doubles(m, e);
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
        if (!shade__within(((const float *)m)[k], FLT_MAX)) return 0;
    return 1;
}
/* The matrix of a camera, or the degenerate one where it is none or an entry is not finite, as
   after a division by zero. */
static shade_mat4 shade__camera(int exists, double xx, double yy, shade_vec4 z, shade_vec4 w)
{
    shade_mat4 none = shade__zero_matrix();
    shade_mat4 m = shade__m4(shade_v4((float)xx, 0, 0, 0), shade_v4(0, (float)yy, 0, 0), z, w);
    none.col[3] = shade_v4(0, 0, 2, 1);
    return exists && shade__is_finite(&m) ? m : none;
}
/* Cramer's rule: row i is made of the other column of its pair (0, 1 or 2, 3) and the minors of the
   other pair.  A determinant of 0 leaves no entry finite.
   Not inlined: gcc 12 drops the rounding where doubles become floats and two of them doubles again
   next to each other (its SLP vectoriser), as they would in shade_pixel_ray. */
SHADEDEF SHADE__NOINLINE shade_mat4 shade_mat4_inverse(shade_mat4 m)
{
    double e[16], s[6], c[6], k = 1 / shade__expand(&m, e, s, c);
    for (int i = 0; i < 4; i++) {
        const double *v = e + 4 * (i ^ 1), *o = i < 2 ? c : s, sign = 1 - 2 * (i & 1);
        const double x = sign * v[0], y = sign * v[1], z = sign * v[2], w = sign * v[3];
        float *row = (float *)&m + i;
        row[0] = (float)((y * o[5] - z * o[4] + w * o[3]) * k);
        row[4] = (float)((-x * o[5] + z * o[2] - w * o[1]) * k);
        row[8] = (float)((x * o[4] - y * o[2] + w * o[0]) * k);
        row[12] = (float)((-x * o[3] + y * o[1] - z * o[0]) * k);
    }
    return shade__is_finite(&m) ? m : shade__zero_matrix();
}

/* c 1 + s [a]x + (1 - c) a a^T */
SHADEDEF shade_mat4 shade_mat4_rotation(float radians, shade_vec3 axis)
{
    double s, c;
    shade_vec3 a = shade__unit_vector(axis), sa, t;
    if (shade__is_zero(a)) return shade_mat4_identity();
    shade__sincos(radians, &s, &c);
    sa = shade_scale(a, (float)s);
    t = shade_scale(a, (float)(1 - c));
    return shade__m4(shade__xyzw(shade_madd(shade_v3((float)c, sa.z, -sa.y), t.x, a), 0),
                     shade__xyzw(shade_madd(shade_v3(-sa.z, (float)c, sa.x), t.y, a), 0),
                     shade__xyzw(shade_madd(shade_v3(sa.y, -sa.x, (float)c), t.z, a), 0),
                     shade_v4(0, 0, 0, 1));
}

SHADEDEF shade_mat4 shade_mat4_look_at(shade_vec3 eye, shade_vec3 center, shade_vec3 up)
{
    shade_vec3 f = shade__unit_vector(shade_sub(center, eye)), r, u;
    if (shade__is_zero(f)) f = shade_v3(0, 0, -1);
    r = shade__unit_vector(shade_cross(f, shade__unit_vector(up)));
    if (shade__is_zero(r)) {     /* any axis that f is far from stands in for up */
        up = f.y * f.y < 0.5f ? shade_v3(0, 1, 0) : shade_v3(0, 0, 1);
        r = shade__unit_vector(shade_cross(f, up));
    }
    /* square again where up was nearly parallel */
    r = shade__unit_vector(shade_madd(r, -shade_dot(r, f), f));
    u = shade_cross(r, f);
    return shade__m4(shade_v4(r.x, u.x, -f.x, 0), shade_v4(r.y, u.y, -f.y, 0),
                     shade_v4(r.z, u.z, -f.z, 0),
                     shade_v4(-shade_dot(r, eye), -shade_dot(u, eye), shade_dot(f, eye), 1));
}

/* 1 / tan(fovy / 2), or what no float can hold for fovy outside (0, pi) */
static double shade__focal(float fovy)
{
    double s, c;
    shade__sincos(fovy / 2, &s, &c);
    return fovy > 0 && fovy < 3.2f && c > 0 ? c / s : DBL_MAX;
}
SHADEDEF shade_mat4 shade_mat4_perspective(float fovy, float aspect, float near_z, float far_z)
{
    double y = shade__focal(fovy), n = (double)near_z, f = (double)far_z, d = n - f;
    return shade__camera(n > 0 && f > 0, y / (double)aspect, y,
                         shade_v4(0, 0, (float)((n + f) / d), -1),
                         shade_v4(0, 0, (float)(2 * n * f / d), 0));
}
SHADEDEF shade_mat4 shade_mat4_perspective_reversed(float fovy, float aspect, float near_z)
{
    double y = shade__focal(fovy);
    return shade__camera(near_z > 0, y / (double)aspect, y, shade_v4(0, 0, 0, -1),
                         shade_v4(0, 0, near_z, 0));
}
/* A box of eye space, or the frustum whose face at near is that of the box. */
static shade_mat4 shade__box_camera(int frustum, double l, double r, double b, double t, double n,
                                    double f)
{
    const double w = r - l, h = t - b, d = n - f, k = frustum ? 2 * n : 2;
    const float x = (float)((r + l) / w), y = (float)((t + b) / h), z = (float)((n + f) / d);
    if (!frustum)
        return shade__camera(1, k / w, k / h, shade_v4(0, 0, (float)(k / d), 0),
                             shade_v4(-x, -y, z, 1));
    return shade__camera(n > 0 && f > 0, k / w, k / h, shade_v4(x, y, z, -1),
                         shade_v4(0, 0, (float)(k * f / d), 0));
}
SHADEDEF shade_mat4 shade_mat4_frustum(float l, float r, float b, float t, float n, float f)
{
    return shade__box_camera(1, (double)l, (double)r, (double)b, (double)t, (double)n, (double)f);
}
SHADEDEF shade_mat4 shade_mat4_ortho(float l, float r, float b, float t, float n, float f)
{
    return shade__box_camera(0, (double)l, (double)r, (double)b, (double)t, (double)n, (double)f);
}

/*------------------------------------------------------------------------------------------ >>power
   x^n = 2^(-u), u = -n log2 x, without libm: the same bits everywhere, and loops over lanes that
   vectorise.
     in      x in [0, 1], n >= 0          out  a value in [0, 1], absolute error below 5e-7
     method  minimax polynomials: log2(1 + f) = f P(f) on [sqrt(1/2) - 1, sqrt(2) - 1], where the
             error relative to -log2 x of the whole x is least: below 1e-6 in floats, which a power
             turns into at most 1e-6 / e; two degrees more would give 2.7e-8 and cost 4 to 7 % of
             lit packets.  2^-r = 1 + r Q(r) on [-1/2, 1/2], relative error 9.2e-8.  All figures
             were measured over all floats in [0, 1].                                  >>lighting */

/* -log2 x, 0 <= x <= 1 not subnormal; 127 for x = 0. The addend carries into the exponent where
   the mantissa is at or above sqrt(2), so that near x = 1 the exponent part is 0 and no digit is
   lost.   post: >= 0 for those x, finite for any bits */
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
    return (float)(127 - (int32_t)(t >> 23)) - f * p;
}
/* 2^-u, u >= 0 or infinite; exactly 1 at 0, exactly 0 from 126 on.   post: 0 .. 1 */
SHADE__INLINE float shade__exp2_neg(float u)
{
    const uint32_t some = shade__mask((int32_t)shade__float_bits(u) < 0x42FC0000);    /* 126 */
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
#define SHADE__NEVER -2.0f    /* in the place of a cosine: its power is 0, the zeroth as well */
/* n (-log2 min(x, 1)); 126 or more where the power is 0: unless x > least, which is 0 if n > 0,
   else SHADE__NEVER.   pre: n >= 0, finite */
SHADE__INLINE float shade__power_log(float x, float n, float least)
{
    int32_t i = shade__min((int32_t)shade__float_bits(x), 0x3F800000);
    float u = n * shade__neg_log2(shade__bits_float((uint32_t)i));
    return shade__select(126.0f, u, shade__mask(x > least));
}
SHADEDEF float shade_power(float x, float n)
{
    float c = shade__unit(x), subnormal = 0;
    if (!(n > 0)) return 1;
    if (!shade__within(n, FLT_MAX)) n = FLT_MAX;
    if (c > 0 && c < FLT_MIN) {
        c *= 16777216;
        subnormal = 24 * shade__minf(n, 8);
    }
    return shade__exp2_neg(shade__power_log(c, n, 0) + subnormal);
}

/*------------------------------------------------------------------------------------------ >>color
   Colours of a display, linear colours, and the pixels of memory.
     in      bytes of any format, or linear floats          out  linear floats, or a stored pixel
     source  sRGB curve [IEC61966]                                                   >>lighting */

/* 0 <= c <= 1, and so is the result, of either: held for every such float */
SHADE__INLINE float shade__srgb_encode(float c)
{
    float curve = 1.055f * shade__exp2_neg(shade__neg_log2(c) * (1 / 2.4f)) - 0.055f;
    return shade__select(12.92f * c, curve, shade__mask(c > 0.0031308f));
}
SHADE__INLINE float shade__srgb_decode(float c)
{
    float curve = shade__exp2_neg(shade__neg_log2((c + 0.055f) * (1 / 1.055f)) * 2.4f);
    return shade__select(c * (1 / 12.92f), curve, shade__mask(c > 0.04045f));
}
/* The same of any c, clamped, as one copy each. */
static SHADE__NOINLINE float shade__encode(float c) { return shade__srgb_encode(shade__unit(c)); }
static SHADE__NOINLINE float shade__decode(float c) { return shade__srgb_decode(shade__unit(c)); }
SHADEDEF shade_vec3 shade_srgb_from_linear(shade_vec3 c)
{
    return shade_v3(shade__encode(c.x), shade__encode(c.y), shade__encode(c.z));
}
SHADEDEF shade_vec3 shade_linear_from_srgb(shade_vec3 c)
{
    return shade_v3(shade__decode(c.x), shade__decode(c.y), shade__decode(c.z));
}
SHADEDEF shade_vec3 shade_rgb(uint32_t rgb)
{
    return shade_linear_from_srgb(shade_v3((float)(rgb >> 16 & 255) / 255,
                                           (float)(rgb >> 8 & 255) / 255,
                                           (float)(rgb & 255) / 255));
}
SHADEDEF shade_material shade_linear_material(shade_material display)
{
    display.emission = shade_linear_from_srgb(display.emission);
    display.ambient = shade_linear_from_srgb(display.ambient);
    display.diffuse = shade_linear_from_srgb(display.diffuse);
    display.specular = shade_linear_from_srgb(display.specular);
    return display;
}

static size_t shade__pixel_bytes(shade_format format)
{
    if (format == SHADE_FORMAT_RGBA32F) return 16;
    if (format == SHADE_FORMAT_A8) return 1;
    return format == SHADE_FORMAT_RGB565 || format == SHADE_FORMAT_RGB565_SWAPPED ? 2 : 4;
}
/* the two bytes of u < 2^16 exchanged */
SHADE__INLINE uint32_t shade__swap16(uint32_t u) { return u >> 8 | (u & 255) << 8; }

/* which of the 4 bytes of a pixel is channel k: R, G, B, A; and the other way round */
SHADE__INLINE int shade__channel_byte(shade_format format, int k)
{
    return format == SHADE_FORMAT_BGRA8 && k < 3 ? 2 - k : k;
}
/* where it lies in the native integer */
SHADE__INLINE int shade__channel_shift(shade_format format, int k)
{
    static const uint8_t shift565[4] = { 11, 5, 0, 16 };
    const int byte = shade__channel_byte(format, k);
    const uint32_t one = 1;
    uint8_t first;
    if (shade__pixel_bytes(format) == 2) return shift565[k];
    if (format == SHADE_FORMAT_A8) return 8 * k;
    SHADE_MEMCPY(&first, &one, 1);
    return first ? 8 * byte : 24 - 8 * byte;
}
/* Stores one pixel: its packed form, or its four floats, stride apart. */
SHADE__INLINE void shade__store_pixel(shade_format format, uint8_t *p, uint32_t packed,
                                      const float *rgba, int stride)
{
    const size_t bytes = shade__pixel_bytes(format);
    uint16_t u = (uint16_t)packed;
    if (bytes == 4) SHADE_MEMCPY(p, &packed, 4);
    else if (bytes == 2) SHADE_MEMCPY(p, &u, 2);
    else if (bytes == 1) *p = (uint8_t)(packed >> 24);
    else
        for (int k = 0; k < 4; k++) SHADE_MEMCPY(p + 4 * k, rgba + k * stride, 4);
}
/* Loads one pixel: its packed form, where the alpha of 16 bits and the colours of A8 are 1, or its
   four floats, stride apart. */
SHADE__INLINE void shade__load_pixel(shade_format format, const uint8_t *p, uint32_t *packed,
                                     float *rgba, int stride)
{
    const size_t bytes = shade__pixel_bytes(format);
    uint16_t u;
    if (bytes == 4) SHADE_MEMCPY(packed, p, 4);
    else if (bytes == 2) {
        SHADE_MEMCPY(&u, p, 2);
        *packed = 0x10000 | (format == SHADE_FORMAT_RGB565_SWAPPED ? shade__swap16(u) : u);
    } else if (bytes == 1) *packed = (uint32_t)*p << 24 | 0xFFFFFF;
    else
        for (int k = 0; k < 4; k++) SHADE_MEMCPY(rgba + k * stride, p + 4 * k, 4);
}
/* The full value of channel k of a packed format. */
SHADE__INLINE uint32_t shade__channel_full(shade_format format, int k)
{
    if (shade__pixel_bytes(format) != 2) return 255;
    return k == 3 ? 1 : k == 1 ? 63 : 31;
}
/* whether what is stored is sRGB */
SHADE__INLINE int shade__is_encoded(const shade_target *t)
{
    return t->srgb && t->format < SHADE_FORMAT_RGBA32F;
}
SHADE__INLINE int shade__rows_held(const shade_target *t)
{
    return t->row_count ? t->row_count : t->height;
}
SHADE__INLINE int shade__stride_of(const shade_target *t)
{
    return t->stride ? t->stride : t->width;
}
/* Index of a pixel in color and depth. */
SHADE__INLINE size_t shade__offset_of(const shade_target *t, int x, int y)
{
    return (size_t)(y - t->row_offset) * (size_t)shade__stride_of(t) + (size_t)x;
}
SHADE__INLINE uint8_t *shade__pixel_at(const shade_target *t, int x, int y)
{
    return (uint8_t *)t->color + shade__offset_of(t, x, y) * shade__pixel_bytes(t->format);
}

/*--------------------------------------------------------------------------------------- >>lighting
   Lamps, single terms, presets: what is computed for one point, with exact roots and divisions;
   and what a packet is lit by.                                                       >>arrival */

SHADEDEF shade_light shade_directional_light(shade_vec3 direction_of_travel, shade_vec3 color)
{
    shade_light light;
    SHADE__ZERO(light);
    light.position = shade__xyzw(shade_neg(direction_of_travel), 0);
    light.diffuse = light.specular = color;
    return light;
}
SHADEDEF shade_light shade_point_light(shade_vec3 position, shade_vec3 color)
{
    shade_light light = shade_directional_light(position, color);
    light.position = shade__xyzw(position, 1);
    return light;
}
SHADEDEF shade_light shade_spot_light(shade_vec3 position, shade_vec3 aim, float cutoff_radians,
                                      float exponent,
                                      shade_vec3 color)
{
    double s, c;
    shade_light light = shade_point_light(position, color);
    shade__sincos(cutoff_radians, &s, &c);
    light.spot_direction = aim;
    light.spot_exponent = exponent;
    light.spot_cos_cutoff = (float)c;
    return light;
}

/* R.V of unit N, L, V, as (|R|^2 + |V|^2 - |R - V|^2) / 2, |R| = |L|: near 1, where a power
   magnifies errors, those of the vectors' lengths cancel.  Zero L or V: 0. */
SHADE__INLINE float shade__mirror_cosine(shade_vec3 normal, shade_vec3 to_light, shade_vec3 to_eye)
{
    shade_vec3 mirrored = shade_scale(normal, 2 * shade_dot(normal, to_light));
    shade_vec3 d = shade_sub(mirrored, shade_add(to_light, to_eye));
    return shade__is_zero(to_light) || shade__is_zero(to_eye) ? 0 : 1 - 0.5f * shade_dot(d, d);
}

SHADEDEF float shade_lambert(shade_vec3 normal, shade_vec3 to_light)
{
    return shade__maxf(shade_dot(normal, to_light), 0);
}
/* (R.V)^n or (N.H)^n, ungated. */
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
    if (!(shade_dot(normal, to_light) > 0)) return 0;
    return shade__highlight(1, normal, to_light, to_eye, exponent);
}
SHADEDEF float shade_blinn_phong_specular(shade_vec3 normal, shade_vec3 to_light,
                                          shade_vec3 to_eye, float exponent)
{
    if (!(shade_dot(normal, to_light) > 0)) return 0;
    return shade__highlight(0, normal, to_light, to_eye, exponent);
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
SHADEDEF shade_vec3 shade_brdf(const shade_material *material, shade_model model,
                               shade_vec3 normal, shade_vec3 to_light, shade_vec3 to_eye)
{
    const int phong = model == SHADE_MODEL_PHONG;
    shade_material m = material ? *material : shade_preset_material(SHADE_PRESET_COUNT);
    if (phong || model == SHADE_MODEL_BLINN_PHONG) {
        const float lobe = shade__highlight(phong, normal, to_light, to_eye, m.shininess);
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

/* One row of the table: name; k_a, k_d, k_s, shininess / 128. [Kilgard94] */
typedef struct shade__preset_row {
    const char *name;
    float ar, ag, ab, dr, dg, db, sr, sg, sb, shininess;
} shade__preset_row;
static const shade__preset_row *shade__preset(int preset)
{
    static const shade__preset_row table[SHADE_PRESET_COUNT + 1] = {
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
        { "yellow rubber", 0.05f, 0.05f, 0, 0.5f, 0.5f, 0.4f, 0.7f, 0.7f, 0.04f, 0.078125f },
        { "", 1, 1, 1, 1, 1, 1, 0, 0, 0, 0 }    /* white Lambert */
    };
    return &table[preset < 0 || preset > SHADE_PRESET_COUNT ? (int)SHADE_PRESET_COUNT : preset];
}
SHADEDEF shade_material shade_preset_material(shade_preset preset)
{
    const shade__preset_row *row = shade__preset((int)preset);
    shade_material m;
    m.emission = shade_v3(0, 0, 0);
    m.ambient = shade_v3(row->ar, row->ag, row->ab);
    m.diffuse = shade_v3(row->dr, row->dg, row->db);
    m.specular = shade_v3(row->sr, row->sg, row->sb);
    m.shininess = row->shininess * 128;
    return m;
}
SHADEDEF const char *shade_preset_name(shade_preset preset)
{
    return shade__preset((int)preset)->name;
}

/* A light as lanes read it, and what one surface makes of its light. */
typedef struct shade__lamp {
    shade_vec3 at;                /* a point, or the unit direction toward a light at infinity */
    shade_vec3 axis;              /* S of the cone, unit; zero: none */
    float a, nearest;             /* of attenuation: a of the lamp, or 1 for none; least r */
    int infinite, falls, spot;    /* falls: attenuation depends on r */
    const shade_light *light;
    shade_vec3 diffuse, specular;       /* k_d I_d, k_s I_s */
    shade_vec3 base, slope;       /* of shade__ramp */
    int gloss, ramp;              /* whether there is a highlight, a ramp */
    int on;                       /* whether there is anything */
    int masked;                   /* a cone, or colours that are not finite: shade__combine */
} shade__lamp;

/* So many are prepared once for a draw, others for each packet. */
enum { SHADE__LAMPS = SHADE_LANES < 64 ? 1 : 4 };

/* What packets are lit by: defaults filled in, terms that are off set to zero. */
typedef struct shade__job {
    const shade_lighting *lighting;
    shade__lamp lamp[SHADE__LAMPS];
    shade_vec4 eye;               /* w = 0: a viewer at infinity */
    const shade_material *m;
    shade_material white;         /* where there is none */
    shade_vec3 emission;
    shade_vec3 ambient;           /* k_a times the light that no lamp attenuates */
    unsigned terms;
    int lamps, tone;              /* tone: cool to warm, by one lamp */
    uint32_t open;                /* mask of a flag */
    uint32_t sign;                /* of N.L in the diffuse term: the mask that keeps or clears it */
} shade__job;

static void shade__begin_terms(const shade_lighting *lighting, const shade_material *material,
                               shade_vec3 eye, shade__job *j)
{
    const shade_vec3 none = shade_v3(0, 0, 0);
    const shade_model model = lighting->model;
    unsigned terms = lighting->terms ? lighting->terms : ~0u;
    if (model == SHADE_MODEL_EMISSIVE) terms &= SHADE_TERM_EMISSION;
    if (model == SHADE_MODEL_AMBIENT) terms &= SHADE_TERM_EMISSION | SHADE_TERM_AMBIENT;
    if (model == SHADE_MODEL_LAMBERT) terms &= ~(unsigned)SHADE_TERM_SPECULAR;
    if (model == SHADE_MODEL_COOL_TO_WARM) terms &= SHADE_TERM_EMISSION | SHADE_TERM_DIFFUSE;
    j->terms = terms;
    j->tone = model == SHADE_MODEL_COOL_TO_WARM && (terms & SHADE_TERM_DIFFUSE);
    j->lighting = lighting;
    j->eye = shade__xyzw(eye, lighting->flags & SHADE_FLAG_INFINITE_VIEWER ? 0.0f : 1.0f);
    j->m = material;
    if (!material) {
        j->white = shade_preset_material(SHADE_PRESET_COUNT);
        j->m = &j->white;
    }
    j->emission = terms & SHADE_TERM_EMISSION ? j->m->emission : none;
    j->emission = shade_add(j->emission, none);    /* no -0, which a lamp's 0 would change */
    j->ambient = terms & SHADE_TERM_AMBIENT ? lighting->ambient : none;
    j->lamps = lighting->lights ? lighting->light_count : 0;
    if ((terms & SHADE_TERM_AMBIENT) && !(lighting->flags & SHADE_FLAG_ATTENUATED_AMBIENT))
        for (int k = 0; k < j->lamps; k++)
            j->ambient = shade_add(j->ambient, lighting->lights[k].ambient);
    if (terms & SHADE_TERM_AMBIENT) j->ambient = shade_mul(j->ambient, j->m->ambient);
    j->open = shade__mask((lighting->flags & SHADE_FLAG_UNGATED_SPECULAR) != 0);
    j->sign = lighting->flags & SHADE_FLAG_TWO_SIDED_ABS ? 0x7FFFFFFF : 0xFFFFFFFF;
}

/*---------------------------------------------------------------------------------------- >>arrival
   What of a lamp arrives at the points of a packet: direction, attenuation, cone.
     in      a light, rows of P           out  shade__arrival
     holds   Lanes are SHADE_LANES for packets, SHADE__POINT for a point alone, which takes the same
             way.  Error of 1/sqrt and powers: >>base, >>power.                         >>lanes */

/* A point is one vector of the build for any processor.  That one takes any number of vectors,
   which compilers know to leave no remainder, the others whole packets. */
enum { SHADE__POINT = SHADE__ANY_WIDTH < SHADE_LANES ? SHADE__ANY_WIDTH : SHADE_LANES };
#define SHADE__LANES_OF(n) \
    (shade__width == SHADE__ANY_WIDTH ? shade__max((n) & -(int)SHADE__POINT, SHADE__POINT) \
                                      : SHADE_LANES)

/* k I of each term that is on, else zero whatever they hold. */
static void shade__products(const shade_light *light, const shade__job *j, shade__lamp *p)
{
    const shade_vec3 none = shade_v3(0, 0, 0);
    const unsigned on = j->terms, flags = j->lighting->flags;
    const int ramp = (on & SHADE_TERM_AMBIENT) && (flags & SHADE_FLAG_ATTENUATED_AMBIENT);
    p->base = none;
    p->slope = ramp ? shade_mul(j->m->ambient, light->ambient) : none;
    p->diffuse = on & SHADE_TERM_DIFFUSE ? shade_mul(j->m->diffuse, light->diffuse) : none;
    p->specular = on & SHADE_TERM_SPECULAR ? shade_mul(j->m->specular, light->specular) : none;
    p->ramp = !shade__is_zero(p->slope);
    p->gloss = !shade__is_zero(p->specular);
    p->on = p->gloss || p->ramp || !shade__is_zero(p->diffuse);
}
/* The lamp of a light; j may be NULL.  It may be off, the rest unset, if it lights nothing of j. */
static SHADE__NOINLINE void shade__lamp_of(const shade_light *light, const shade__job *j,
                                          shade__lamp *p)
{
    const shade_vec4 at = light->position;
    p->on = 1;
    p->diffuse = p->specular = shade_v3(0, 0, 0);
    if (j) shade__products(light, j, p);
    if (!p->on) return;
    p->at = shade__xyz(at);
    p->infinite = at.w == 0;
    if (p->infinite) p->at = shade_normalize(p->at);
    else if (at.w != 1) p->at = shade_v3(at.x / at.w, at.y / at.w, at.z / at.w);
    p->axis = light->spot_direction;
    if (!shade__is_zero(p->axis)) p->axis = shade_neg(shade__unit_vector(p->axis));
    p->spot = !shade__is_zero(p->axis);
    p->a = light->constant;
    p->nearest = p->a == 0 ? 1e-4f : 0.0f;
    p->falls = !p->infinite && !shade__is_zero(shade_v3(0, light->linear, light->quadratic));
    if (!p->falls && p->a == 0) p->a = 1;
    p->light = light;
    p->masked = p->spot || !(shade__finite3(p->diffuse) && shade__finite3(p->specular));
}
/* The lamp of a tone: cool + k_w (warm - cool), L toward the first light.             [Gooch98] */
static SHADE__COLD void shade__tone_of(const shade__job *j, shade__lamp *p)
{
    const shade_lighting *l = j->lighting;
    if (j->lamps > 0) shade__lamp_of(l->lights, NULL, p);
    else {
        SHADE__ZERO(*p);
        p->infinite = 1;
    }
    p->spot = 0;
    p->on = p->ramp = 1;
    p->base = shade__is_zero(l->cool) ? shade_v3(0.4f, 0.4f, 0.7f) : l->cool;
    p->slope = shade__is_zero(l->warm) ? shade_v3(0.8f, 0.6f, 0.6f) : l->warm;
    p->slope = shade_sub(p->slope, p->base);
}

static SHADE__NOINLINE void shade__begin_job(const shade_lighting *lighting,
                                             const shade_material *material, shade_vec3 eye,
                                             shade__job *j)
{
    shade__begin_terms(lighting, material, eye, j);
    for (int k = 0; k < j->lamps && k < SHADE__LAMPS; k++)
        shade__lamp_of(&lighting->lights[k], j, &j->lamp[k]);
}

/* What of a lamp arrives at a block of points. */
typedef struct shade__arrival {
    SHADE_ALIGNED shade__v3 to_light;    /* unit */
    float att[SHADE_LANES];       /* r, then attenuation times cone */
    float cosine[SHADE_LANES];    /* L.S, where there is a cone; then N.L, signed */
    uint32_t any;                 /* zero: no lane is inside the cone, att is unset */
} shade__arrival;
SHADE__INLINE void shade__directional(const shade__lamp *SHADE_RESTRICT lamp, const int n,
                                      shade__arrival *SHADE_RESTRICT a)
{
    SHADE__FOR(i, n) {
        shade__put(&a->to_light, i, lamp->at);
        a->att[i] = 1;
    }
}
SHADE__INLINE void shade__point(const shade__lamp *SHADE_RESTRICT lamp,
                                const shade__v3 *SHADE_RESTRICT point, const int n,
                                shade__arrival *SHADE_RESTRICT to)
{
    SHADE__FOR(i, n) {
        shade_vec3 to_light = shade_sub(lamp->at, shade__at(point, i));
        float d = shade_dot(to_light, to_light), rl = shade__rsqrt(d);
        /* before the call that returns a vector: what tcc does to d then, see >>config */
        to->att[i] = d * rl;
        shade__put(&to->to_light, i, shade_scale(to_light, rl));
    }
}
/* L.S, or SHADE__NEVER outside the cone; returns non-zero if some lane is inside */
SHADE__INLINE uint32_t shade__cone(const shade__lamp *SHADE_RESTRICT lamp, const int n,
                                   shade__arrival *SHADE_RESTRICT a)
{
    const float cos_cutoff = lamp->light->spot_cos_cutoff;
    uint32_t any = 0;
    SHADE__FOR(i, n) {
        float cosine = shade_dot(shade__at(&a->to_light, i), lamp->axis);
        uint32_t inside = shade__mask(cosine >= cos_cutoff);
        a->cosine[i] = shade__select(SHADE__NEVER, cosine, inside);
        any |= inside;
    }
    return any;
}
/* att from r, which is NaN or infinite where P is beyond 1e18 and then counts as far.  A sum that
   overflows both ways is NaN and gives 1e20, as in shade_attenuation. */
SHADE__INLINE void shade__attenuate(const shade__lamp *SHADE_RESTRICT lamp, const int n,
                                    float *SHADE_RESTRICT att)
{
    const float b = lamp->light->linear, c = lamp->light->quadratic;
    SHADE__FOR(i, n) {
        float r = shade__clamp_bits(shade__keep(att[i], 0x7FFFFFFF), lamp->nearest, 1e18f);
        float sum = lamp->a + b * r + c * (r * r);
        att[i] = 1 / shade__select(1e-20f, sum, shade__mask(sum > 1e-20f));
    }
}
/* The same where it does not depend on r. */
SHADE__INLINE void shade__even(float x, const int n, float *SHADE_RESTRICT att)
{
    SHADE__FOR(i, n) { att[i] = shade__keep(x, shade__mask(att[i] >= 0)); }
}
/* First half of a power: x becomes n (-log2 x). */
SHADE__INLINE void shade__log_row(float exponent, const int n, float *SHADE_RESTRICT x)
{
    const float most = exponent > 0 ? shade__minf(exponent, FLT_MAX) : 0;
    const float least = exponent > 0 ? 0 : SHADE__NEVER;
    SHADE__FOR(i, n) { x[i] = shade__power_log(x[i], most, least); }
}
/* Second half for the cone: att times (L.S)^e. */
SHADE__INLINE void shade__gather_beam(const int n, shade__arrival *SHADE_RESTRICT a)
{
    SHADE__FOR(i, n) { a->att[i] *= shade__exp2_neg(a->cosine[i]); }
}
/* The same where e = 0. */
SHADE__INLINE void shade__gather_disc(const int n, shade__arrival *SHADE_RESTRICT a)
{
    SHADE__FOR(i, n) {
        a->att[i] = shade__keep(a->att[i], shade__mask(a->cosine[i] > SHADE__NEVER));
    }
}
/* L and att of one lamp. */
SHADE__INLINE void shade__light_at_body(const shade__lamp *lamp, const shade__v3 *point,
                                        const int n, shade__arrival *a)
{
    uint32_t any = shade__mask(1);
    if (lamp->infinite) shade__directional(lamp, n, a);
    else shade__point(lamp, point, n, a);
    if (lamp->spot) any = shade__cone(lamp, n, a);
    a->any = any;
    if (!any) return;
    if (lamp->falls) shade__attenuate(lamp, n, a->att);
    else if (!lamp->infinite)
        shade__even(1 / shade__maxf(lamp->a, 1e-20f), n, a->att);
    if (!lamp->spot) return;
    if (lamp->light->spot_exponent > 0) {
        shade__log_row(lamp->light->spot_exponent, n, a->cosine);
        shade__gather_beam(n, a);
    } else shade__gather_disc(n, a);
}
SHADE__DISPATCH(shade__light_at,
                     (const shade__lamp *lamp, const shade__v3 *point, int n, shade__arrival *a),
                     (lamp, point, SHADE__LANES_OF(n), a))

SHADEDEF void shade_light_at_lanes(const shade_light *light, const float *point, float *to_light,
                                   float *amount)
{
    shade__arrival a;
    shade__lamp lamp;
    if (light && point) {
        shade__lamp_of(light, NULL, &lamp);
        shade__light_at_pick()(&lamp, shade__rows_of(point), SHADE_LANES, &a);
        if (!a.any) SHADE__ZERO(a.att);
    } else SHADE__ZERO(a);
    if (to_light) SHADE_MEMCPY(to_light, &a.to_light, 3 * SHADE_LANES * sizeof *to_light);
    if (amount) SHADE_MEMCPY(amount, a.att, sizeof a.att);
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
    shade__fill_point(point, &block);
    if (light) {
        shade__lamp_of(light, NULL, &lamp);
        r = lamp.infinite ? FLT_MAX : shade_distance(lamp.at, point);
        shade__light_at_any(&lamp, &block, SHADE__POINT, &a);
    } else SHADE__ZERO(a);
    if (to_light) *to_light = shade__at(&a.to_light, 0);
    if (distance) *distance = r;
    return a.any ? a.att[0] : 0;
}
/*------------------------------------------------------------------------------------------ >>lanes
   The equations of >>model for a packet, or for one point.  The light of one lamp is cut into short
   loops over rows of temporaries: one fused loop per light measured 1.5 times slower, its many
   live values outgrow the processor.
     in      shade_rows                               out  rows of rgb
     holds   A lamp that reaches no lane (horizon, cone) is left after its first loops.
                                                                                        >>state */

typedef struct shade__lit {
    shade__arrival a;             /* of one lamp; in the end a.L.x holds its highlight */
    float rn[SHADE_LANES];        /* +-1/|N|: minus where N is turned toward the viewer */
    shade__v3 to_eye;             /* unit, toward the viewer */
} shade__lit;

/* Toward the viewer, not unit.  eye.w is 0 for a viewer at infinity, else 1. */
SHADE__INLINE shade_vec3 shade__view(shade_vec4 eye, shade_vec3 point)
{
    return shade_madd(shade__xyz(eye), -eye.w, point);
}
/* 1/|N| */
SHADE__INLINE void shade__lengths(const shade__v3 *SHADE_RESTRICT normal, const int n,
                                  float *SHADE_RESTRICT rn)
{
    SHADE__FOR(i, n) {
        shade_vec3 m = shade__at(normal, i);
        rn[i] = shade__rsqrt(shade_dot(m, m));
    }
}
/* its sign */
SHADE__INLINE void shade__two_sides(const shade__v3 *SHADE_RESTRICT point,
                                    const shade__v3 *SHADE_RESTRICT normal, shade_vec4 eye,
                                    const int n, float *SHADE_RESTRICT rn)
{
    SHADE__FOR(i, n) {
        shade_vec3 to_eye = shade__view(eye, shade__at(point, i));
        uint32_t turned = shade__mask(shade_dot(shade__at(normal, i), to_eye) < 0) & 0x80000000u;
        rn[i] = shade__bits_float(shade__float_bits(rn[i]) ^ turned);
    }
}
SHADE__INLINE void shade__viewer(const shade__v3 *SHADE_RESTRICT point, shade_vec4 eye, const int n,
                                 shade__v3 *SHADE_RESTRICT to)
{
    SHADE__FOR(i, n) {
        shade_vec3 to_eye = shade__view(eye, shade__at(point, i));
        shade__put(to, i, shade_scale(to_eye, shade__rsqrt(shade_dot(to_eye, to_eye))));
    }
}
/* N.L; returns non-zero if some lane faces the lamp */
SHADE__INLINE uint32_t shade__horizon(const shade__v3 *SHADE_RESTRICT normal, const int n,
                                      shade__lit *SHADE_RESTRICT r)
{
    uint32_t any = 0;
    SHADE__FOR(i, n) {
        float nl = shade_dot(shade__at(normal, i), shade__at(&r->a.to_light, i)) * r->rn[i];
        r->a.cosine[i] = nl;
        any |= shade__mask(nl > 0);
    }
    return any;
}

/* a.att becomes k_w = (1 + N.L) / 2. */
SHADE__INLINE void shade__warmth(const int n, shade__lit *SHADE_RESTRICT r)
{
    SHADE__FOR(i, n) { r->a.att[i] = 0.5f + 0.5f * r->a.cosine[i]; }
}

/* B, or where the lobe is open: whether there is N. */
SHADE__INLINE int shade__gate(float nl, float rn, uint32_t open)
{
    uint32_t either = (shade__float_bits(nl) & ~open) | (shade__float_bits(rn) & open >> 1);
    return shade__bits_float(either) > 0;
}
/* a.L.x becomes N.H, or SHADE__NEVER where the gate is shut or there is no H; a.L.y: |L + V|^2.
   Returns non-zero if some lane has it below SHADE__NEAR, for shade__half_near.  Rows are read and
   written by one pointer: in builds with gcc -O0 two ways to one would leave the loop scalar. */
#define SHADE__NEAR 1e-3f
SHADE__INLINE uint32_t shade__half(const shade__v3 *SHADE_RESTRICT normal, uint32_t open,
                                   const int n, shade__lit *SHADE_RESTRICT r)
{
    shade__v3 *to_light = &r->a.to_light;
    uint32_t near_zero = 0;
    SHADE__FOR(i, n) {
        shade_vec3 half = shade_add(shade__at(to_light, i), shade__at(&r->to_eye, i));
        float h2 = shade_dot(half, half);
        near_zero |= shade__mask(h2 < SHADE__NEAR);
        to_light->x[i] = shade_dot(shade__at(normal, i), half);
        to_light->y[i] = h2;
    }
    SHADE__FOR(i, n) {
        float h2 = to_light->y[i], rn = r->rn[i];
        float nh = to_light->x[i] * (rn * shade__rsqrt_normal(h2));
        uint32_t lit = shade__mask(shade__gate(r->a.cosine[i], rn, open));
        to_light->x[i] = shade__select(SHADE__NEVER, nh, shade__mask(h2 >= 1e-12f) & lit);
    }
    return near_zero;
}
/* The same in doubles. */
static void shade__double3(shade_vec3 v, double *to)
{
    to[0] = (double)v.x;
    to[1] = (double)v.y;
    to[2] = (double)v.z;
}
static double shade__dot3(const double *a, const double *b)
{
    return a[0] * b[0] + a[1] * b[1] + a[2] * b[2];
}
/* A vector of doubles made unit; zero below 1e-18. */
static void shade__unit3(double *v)
{
    double d = shade__dot3(v, v), k = d >= 1e-36 ? 1 / shade__root(d) : 0;
    for (int i = 0; i < 3; i++) v[i] *= k;
}
/* The lanes where L and V are nearly opposite, again from the positions, in double: their sum keeps
   few digits in float.  The square in float decides which they are, as it decides for the packet:
   a lane has the same bits whatever its neighbours hold. */
static SHADE__COLD void shade__half_near(const shade_vec4 at, const shade__v3 *point,
                                         const shade__v3 *normal, shade_vec4 eye, uint32_t open,
                                         const int n, shade__lit *r)
{
    const double w = at.w == 0 ? 1 : (double)at.w, k = at.w == 0 ? 0 : 1, s = (double)eye.w;
    const float *lamp = (const float *)&at, *from = (const float *)&eye;
    for (int i = 0; i < n; i++) {
        double m[3], l[3], v[3], h2, nh;
        if (!(r->a.to_light.y[i] < SHADE__NEAR)) continue;
        if (!shade__gate(r->a.cosine[i], r->rn[i], open)) continue;
        for (int j = 0; j < 3; j++) {
            const int lane = j * SHADE_LANES + i;
            const double p = (double)((const float *)point)[lane];
            m[j] = (double)((const float *)normal)[lane];
            l[j] = (double)lamp[j] / w - k * p;
            v[j] = (double)from[j] - s * p;
        }
        shade__unit3(l);
        shade__unit3(v);
        shade__unit3(m);
        for (int j = 0; j < 3; j++) l[j] += v[j];
        h2 = shade__dot3(l, l);
        shade__unit3(l);
        nh = r->rn[i] < 0 ? -shade__dot3(m, l) : shade__dot3(m, l);
        r->a.to_light.x[i] = h2 >= 1e-12 ? (float)nh : SHADE__NEVER;
    }
}
/* a.L.x becomes R.V, as shade__mirror_cosine, or SHADE__NEVER where the gate is shut */
SHADE__INLINE void shade__mirrored(const shade__v3 *SHADE_RESTRICT normal, uint32_t open,
                                   const int n, shade__lit *SHADE_RESTRICT r)
{
    shade__v3 *rows = &r->a.to_light;
    SHADE__FOR(i, n) {
        float nl = r->a.cosine[i], rn = r->rn[i];
        shade_vec3 to_light = shade__at(rows, i), to_eye = shade__at(&r->to_eye, i);
        shade_vec3 d = shade_scale(shade__at(normal, i), 2 * nl * rn);
        d = shade_sub(d, shade_add(to_light, to_eye));
        /* after the calls that return vectors: see >>config about tcc */
        uint32_t exists = shade__mask(shade_dot(to_eye, to_eye) > 0);
        exists &= shade__mask(shade_dot(to_light, to_light) > 0);
        float cosine = shade__keep(1 - 0.5f * shade_dot(d, d), exists);
        rows->x[i] = shade__select(SHADE__NEVER, cosine, shade__mask(shade__gate(nl, rn, open)));
    }
}
/* Second half of a power for the highlight: a.L.x = B (N.H)^n. */
SHADE__INLINE void shade__gloss(const int n, shade__lit *SHADE_RESTRICT r)
{
    SHADE__FOR(i, n) { r->a.to_light.x[i] = shade__exp2_neg(r->a.to_light.x[i]); }
}
/* a.L.x times max(0, N.L) */
SHADE__INLINE void shade__weigh(const int n, shade__lit *SHADE_RESTRICT r)
{
    SHADE__FOR(i, n) {
        float nl = r->a.cosine[i];
        r->a.to_light.x[i] *= shade__keep(nl, shade__mask(nl > 0));
    }
}

/* Of a lane.  Inlined with rows NULL, the choice and its factor of 1 vanish. */
SHADE__INLINE shade_vec3 shade__albedo(const shade__v3 *rows, int i)
{
    return rows ? shade__at(rows, i) : shade_v3(1, 1, 1);
}
/* v where the mask is set, else +0 */
SHADE__INLINE shade_vec3 shade__keep3(shade_vec3 v, uint32_t mask)
{
    return shade_v3(shade__keep(v.x, mask), shade__keep(v.y, mask), shade__keep(v.z, mask));
}
SHADE__INLINE void shade__add_to(shade__v3 *rgb, int i, shade_vec3 light)
{
    shade__put(rgb, i, shade_add(shade__at(rgb, i), light));
}
/* rgb += att (albedo k_d I_d max(0, N.L) + tint k_s I_s gloss); |N.L| where sign clears its sign.
   masked: a lane that the light does not reach adds 0 whatever it holds, because a packet that the
   light reaches nowhere is left out.  Without it the lane adds 0 times its factors, which must be
   finite. */
SHADE__INLINE void shade__combine(const shade__lamp *SHADE_RESTRICT lamp,
                                  const shade__job *SHADE_RESTRICT job,
                                  const shade__v3 *SHADE_RESTRICT albedo,
                                  const shade__v3 *SHADE_RESTRICT tint, const int masked,
                                  const int n, const shade__lit *SHADE_RESTRICT r,
                                  shade__v3 *SHADE_RESTRICT rgb)
{
    const uint32_t sign = job->sign, open = job->open, all = shade__mask(!masked);
    SHADE__FOR(i, n) {
        float nl = shade__keep(r->a.cosine[i], sign), att = r->a.att[i];
        uint32_t front = shade__mask(nl > 0), lit = (front | open) & shade__mask(att != 0);
        shade_vec3 diffuse = shade_mul(lamp->diffuse, shade__albedo(albedo, i));
        diffuse = shade_scale(diffuse, shade__keep(nl, front) * att);
        shade_vec3 specular = shade_mul(lamp->specular, shade__albedo(tint, i));
        shade_vec3 light = shade_madd(diffuse, r->a.to_light.x[i] * att, specular);
        shade__add_to(rgb, i, shade__keep3(light, lit | all));
    }
}
/* rgb = base + slope albedo */
SHADE__INLINE void shade__begin_light(shade_vec3 base, shade_vec3 slope,
                                      const shade__v3 *SHADE_RESTRICT albedo, const int n,
                                      shade__v3 *SHADE_RESTRICT rgb)
{
    SHADE__FOR(i, n) {
        shade__put(rgb, i, shade_add(base, shade_mul(slope, shade__albedo(albedo, i))));
    }
}
/* rgb += (base + att slope) albedo; without tone, 0 outside the cone whatever the colours are, as
   where no lane of the packet is inside. */
SHADE__INLINE void shade__ramp(const shade__lamp *SHADE_RESTRICT lamp, uint32_t tone,
                               const shade__v3 *SHADE_RESTRICT albedo, const int n,
                               const shade__lit *SHADE_RESTRICT r, shade__v3 *SHADE_RESTRICT rgb)
{
    SHADE__FOR(i, n) {
        const float att = r->a.att[i];
        shade_vec3 light = shade_madd(lamp->base, att, lamp->slope);
        light = shade_mul(light, shade__albedo(albedo, i));
        shade__add_to(rgb, i, shade__keep3(light, shade__mask(att != 0) | tone));
    }
}
/* att times visibility; 0 stays 0 outside the cone, as where no lane of the packet is inside */
SHADE__INLINE void shade__hide(const float *SHADE_RESTRICT visibility, const int n,
                               float *SHADE_RESTRICT att)
{
    SHADE__FOR(i, n) { att[i] = shade__keep(att[i] * visibility[i], shade__mask(att[i] != 0)); }
}

/* One of the copies of shade__combine, whose rows are there or not, so that the loop does not ask:
   it would stay scalar.  Only the last copy goes without the mask, which costs 2 %. */
SHADE__INLINE void shade__add_light(const shade__job *j, const shade__lamp *lamp,
                                    const shade_rows *rows, const int n,
                                    const shade__lit *SHADE_RESTRICT r,
                                    shade__v3 *SHADE_RESTRICT rgb)
{
    const shade__v3 *albedo = shade__rows_of(rows->albedo);
    const shade__v3 *tint = shade__rows_of(rows->specular);
    if (!SHADE__TWICE || (tint && albedo)) shade__combine(lamp, j, albedo, tint, 1, n, r, rgb);
    else if (tint) shade__combine(lamp, j, NULL, tint, 1, n, r, rgb);
    else if (albedo) shade__combine(lamp, j, albedo, NULL, 1, n, r, rgb);
    else if (lamp->masked || rows->visibility) shade__combine(lamp, j, NULL, NULL, 1, n, r, rgb);
    else shade__combine(lamp, j, NULL, NULL, 0, n, r, rgb);
}
/* Adds light k to rgb, but its unattenuated ambient light. */
SHADE__INLINE void shade__add_lamp(const shade__job *j, const shade_rows *rows,
                                   shade__light_at_fn *light_at, int k, const int n,
                                   shade__lit *r, shade__v3 *rgb)
{
    const shade__v3 *point = shade__rows_of(rows->position);
    const shade__v3 *normal = shade__rows_of(rows->normal);
    const shade__v3 *albedo = shade__rows_of(rows->albedo);
    shade__lamp own;
    const shade__lamp *lamp = &own;
    uint32_t any;
    if (j->tone) shade__tone_of(j, &own);
    else if (k < SHADE__LAMPS) lamp = &j->lamp[k];
    else shade__lamp_of(&j->lighting->lights[k], j, &own);
    if (!lamp->on) return;
    light_at(lamp, point, n, &r->a);
    if (!r->a.any) return;
    any = shade__horizon(normal, n, r);
    if (j->tone) shade__warmth(n, r);
    if (lamp->ramp) {
        const uint32_t tone = shade__mask(j->tone);
        if (!SHADE__TWICE || albedo) shade__ramp(lamp, tone, albedo, n, r, rgb);
        else shade__ramp(lamp, tone, NULL, n, r, rgb);
    }
    if (j->tone || !(any | j->open | ~j->sign)) return;
    if (lamp->gloss) {
        if (j->lighting->model == SHADE_MODEL_PHONG) shade__mirrored(normal, j->open, n, r);
        else if (shade__half(normal, j->open, n, r))
            shade__half_near(lamp->light->position, point, normal, j->eye, j->open, n, r);
        shade__log_row(j->m->shininess, n, r->a.to_light.x);
        shade__gloss(n, r);
        if (j->lighting->flags & SHADE_FLAG_WEIGHTED_SPECULAR) shade__weigh(n, r);
    } else SHADE__ZERO(r->a.to_light.x);
    if (rows->visibility) shade__hide(rows->visibility + (size_t)k * SHADE_LANES, n, r->a.att);
    shade__add_light(j, lamp, rows, n, r, rgb);
}

SHADE__INLINE void shade__lit_body(const shade__job *j, const shade_rows *rows,
                                   shade__light_at_fn *light_at, const int n, shade__v3 *rgb)
{
    const shade__v3 *point = shade__rows_of(rows->position);
    const shade__v3 *normal = shade__rows_of(rows->normal);
    const shade__v3 *ambient = shade__is_zero(j->ambient) ? NULL : shade__rows_of(rows->albedo);
    const int lamps = j->tone ? 1 : j->lamps;
    shade__lit r;
    shade__lengths(normal, n, r.rn);
    if (j->lighting->flags & SHADE_FLAG_TWO_SIDED) shade__two_sides(point, normal, j->eye, n, r.rn);
    shade__viewer(point, j->eye, n, &r.to_eye);
    if (!SHADE__TWICE || ambient) shade__begin_light(j->emission, j->ambient, ambient, n, rgb);
    else shade__begin_light(j->emission, j->ambient, NULL, n, rgb);
    for (int k = 0; k < lamps; k++) shade__add_lamp(j, rows, light_at, k, n, &r, rgb);
}
SHADE__DISPATCH(shade__lit,
                (const shade__job *j, const shade_rows *rows, shade__light_at_fn *light_at, int n,
                 shade__v3 *rgb),
                (j, rows, light_at, SHADE__LANES_OF(n), rgb))
static void shade__lit_packet(const shade__job *j, const shade_rows *rows, float *rgb)
{
    shade__lit_pick()(j, rows, shade__light_at_pick(), SHADE_LANES, (shade__v3 *)(void *)rgb);
}
SHADEDEF void shade_lit_lanes(const shade_lighting *lighting, const shade_material *material,
                              shade_vec3 eye, const shade_rows *rows, float *rgb)
{
    shade__job j;
    if (!lighting || !rows || !rows->position || !rows->normal || !rgb) {
        if (rgb) SHADE_MEMSET(rgb, 0, 3 * SHADE_LANES * sizeof *rgb);
        return;
    }
    shade__begin_job(lighting, material, eye, &j);
    shade__lit_packet(&j, rows, rgb);
}
SHADEDEF shade_vec3 shade_lit(const shade_lighting *lighting, const shade_material *material,
                              shade_vec3 eye, shade_vec3 point, shade_vec3 normal)
{
    shade__v3 p, n, rgb;
    shade_rows rows;
    shade__job j;
    if (!lighting) return shade_v3(0, 0, 0);
    shade__fill_point(point, &p);
    shade__fill_point(normal, &n);
    SHADE__ZERO(rows);
    rows.position = p.x;
    rows.normal = n.x;
    shade__begin_job(lighting, material, eye, &j);
    shade__lit_any(&j, &rows, shade__light_at_any, SHADE__POINT, &rgb);
    return shade__at(&rgb, 0);
}
SHADEDEF shade_terms shade_evaluate(const shade_lighting *lighting, const shade_material *material,
                                    shade_vec3 eye, shade_vec3 point, shade_vec3 normal)
{
    shade_terms t;
    shade_vec3 *term[4] = { &t.emission, &t.ambient, &t.diffuse, &t.specular };
    SHADE__ZERO(t);
    for (unsigned k = 0; k < 4 && lighting; k++) {
        shade_lighting one = *lighting;
        one.terms = 1u << k;
        if (!lighting->terms || (lighting->terms & one.terms))
            *term[k] = shade_lit(&one, material, eye, point, normal);
    }
    return t;
}

/*------------------------------------------------------------------------------------------ >>state
   What a draw knows, by owner; all of it lies on the stack of the call.  The way of a triangle:

     >>draw        checks, then batch after batch of the triangles among SHADE_LANES vertices
     >>vertices    shades and projects the vertices of a batch in one packet: shade__batch
     >>triangles   sets up SHADE__TRIANGLES of them at a time, in lanes: shade__packet
     >>clip        ... after cutting those that cross near, far or the guard band
     >>cover       finds the pixels of each, tests depth: runs; >>blocks leaves out what is hidden
     >>fragments   queues the runs and shades a packet when it is full: shade__queue
     >>store       late depth test, blending, formats: the caller's memory

     holds   A stage calls the next through the one pointer that the choice of processor needs.
                                                                                     >>vertices */

typedef struct shade__draw shade__draw;
/* pixels x .. x + n - 1 of row y, inside the triangle of a lane of the packet */
typedef struct shade__run { int32_t x, y, n, lane; } shade__run;

typedef struct shade__runs shade__runs;
typedef struct shade__stages {        /* hot loops, in the widest code the processor runs */
    void (*place)(shade__draw *, const shade_vertices *);
    void (*setup)(shade__draw *);
    void (*clip)(shade__draw *, const uint8_t *corner, uint32_t primitive);
    void (*cover)(shade__draw *, int count);
    void (*spans)(shade__draw *, shade__runs *, int lane);
    void (*push)(shade__draw *, const shade__run *, int runs);
    void (*flush)(shade__draw *);
    void (*store)(shade__draw *, shade_colors *);
    void (*pack)(const shade_target *, float *rgba, int stride, const float *x, const float *y,
                 uint32_t *packed, int blocks);
} shade__stages;

typedef struct shade__compare { uint32_t less, equal, greater, always, write; } shade__compare;

/* A vertex's values are z, rw, the varyings, and where the level of detail is asked for without
   perspective, u and v once more, times rw. */
enum {
    SHADE__FIRST = 2,                 /* z and rw stand before the varyings */
    SHADE__VALUES_MAX = (SHADE_MAX_VARYINGS + SHADE__FIRST + 2 + 7) / 8 * 8,
    SHADE__BATCH_FLOATS = SHADE_LANES * 8 + (SHADE_LANES < 64 ? 4 : 2) * SHADE__VALUES_MAX,
    SHADE__BATCH_TRIANGLES = 3 * SHADE_LANES / 2,
    SHADE__PARTS = SHADE_LANES < 64 ? 2 : 8,
    SHADE__TRIANGLES = SHADE_LANES < 64 ? 4 : 16,
    SHADE__BLOCKS = SHADE_LANES * SHADE_LANES / 32
};

typedef struct shade__plan {          /* fixed once for the draw, read by every stage */
    const shade_target   *target;
    const shade_pipeline *pipe;
    shade__stages stage;
    uint8_t *color;                   /* NULL: none */
    float   *depth;                   /* NULL: none */
    size_t   pixel_bytes;
    int      stride, row_offset;      /* pixels from row to row; the row memory starts with */
    int      x0, y0, x1, y1;          /* clip rectangle, the last two exclusive */
    int      values, value_stride;    /* floats a vertex in use; from vertex to vertex, 8 k */
    int      divided;                 /* the first value that is kept times rw */
    int      lod;                     /* the value that is u times rw, v behind it; 0: no lod */
    int      varyings;
    int      early, queued;           /* depth is tested by >>cover; fragments go to the queue */
    int      plain;                   /* the early test is LESS, and depth is written */
    int      own, bare;               /* shaders of this file; nobody reads where fragments are */
    int      zero_to_one;
    shade__compare compare;
    float    toward;                  /* 1, -1: greater, less depth is farther; 0: no blocks kept */
    float    half_width, half_height; /* of the picture, in 1/256 pixels: below 2^22, exact */
} shade__plan;

typedef struct shade__vertex {        /* a vertex after the vertex shader */
    int32_t  x, y;                    /* window, 24.8 fixed point */
    uint32_t out;                     /* planes it is outside of: SHADE__OUT_... */
    float    clip[4];
} shade__vertex;
/* Triangles of a batch that follow each other in the draw, from one on to that of the next part. */
typedef struct shade__part { int first; uint32_t primitive; } shade__part;
typedef struct shade__batch {
    int           count;              /* triangles */
    int           parts;
    shade__part   part[SHADE__PARTS + 1];
    shade__vertex vertex[SHADE_LANES];
    SHADE_ALIGNED float value[SHADE__BATCH_FLOATS];
    uint8_t       corner[3 * SHADE__BATCH_TRIANGLES];    /* vertices of the triangles */
} shade__batch;
typedef struct shade__incoming {      /* the vertices of a batch until they are placed */
    shade_vertices   vertices;
    shade_vertex_ids ids;
    uint32_t known[2 * SHADE_LANES];  /* direct-mapped: an index that is in the batch */
    uint8_t slot_of[2 * SHADE_LANES]; /* its vertex */
} shade__incoming;

typedef struct shade__packet {        /* triangles being set up, a lane each */
    SHADE_ALIGNED float side[4][SHADE__TRIANGLES];     /* from corner 0 to 1, to 2, over the area */
    int32_t  x[3][SHADE__TRIANGLES], y[3][SHADE__TRIANGLES];    /* turned by >>triangles */
    float    z[3][SHADE__TRIANGLES];  /* depths; then its plane: at corner 0, step in x, in y */
    float    rw[3][SHADE__TRIANGLES]; /* 1/w; then the range of depth */
    int32_t  e[3][SHADE__TRIANGLES];  /* edge functions at the box's corner, where they fit */
    int32_t  dx[3][SHADE__TRIANGLES], dy[3][SHADE__TRIANGLES];  /* their steps in x and y */
    int32_t  box[4][SHADE__TRIANGLES];       /* x0, y0, x1, y1, both ends included; or empty */
    uint32_t primitive[SHADE__TRIANGLES];
    uint8_t  corner[SHADE__TRIANGLES][4];    /* as submitted; the last: what CONSTANT takes */
    uint32_t turn[SHADE__TRIANGLES];  /* order of the corners 0 .. 5; from 3 on front-facing */
    uint32_t fits;                    /* bit i: 32 bits hold the edges of lane i */
    const shade__vertex *vertex;      /* what corner speaks of, */
    const float *value;               /* and its values */
    int      count;
    int      pieces;                  /* of a clipped triangle, which has been counted */
} shade__packet;

typedef struct shade__hidden {        /* what big triangles of the draw hide: >>blocks */
    int   log_width, log_height;      /* of a block */
    int   across;                     /* blocks side by side; 0: not yet begun */
    float farthest[SHADE__BLOCKS];    /* toward times the depth that nothing in the block exceeds */
} shade__hidden;

typedef struct shade__queue {
    shade_fragments f;                /* as the fragment shader gets it */
    float    rw[SHADE_LANES];         /* 1/w, interpolated; then w */
    uint32_t offset[SHADE_LANES];     /* of the pixel in color and depth, from the strip's first */
} shade__queue;

/* The planes around what can be seen, in object space: left, right, top, bottom, near, and far
   thrice, to fill the lanes; outside where k.(P, 1) < 0.  Were size of float, gcc 12.2 would drop
   the stores to both: it addresses one row by the other, at half the stride, and takes them for
   dead. */
enum { SHADE__PLANES = 8 };
typedef struct shade__frustum {
    double k[4][SHADE__PLANES];
    double size[4][SHADE__PLANES];    /* of the numbers that k was made of, for rounding */
} shade__frustum;
/* The triangles of a draw, handed out in their order. */
typedef struct shade__supply {
    const uint32_t *indices;          /* NULL: 0, 1, 2, ... */
    int first, end;                   /* of the triangles at hand */
    int (*more)(shade__draw *);       /* shade__next_chunk, which others do not link; or NULL */
    int chunks;                       /* how many are left */
    const shade_chunk *chunk;         /* the next of them, */
    const shade__frustum *frustum;    /* and by what they are tested */
} shade__supply;

struct shade__draw {
    shade__plan   plan;
    shade__supply *supply;
    shade_stats   stats;
    shade__hidden hidden;
    shade__batch  batch;
    shade__packet packet;
    union { shade__incoming in; shade__queue queue; } u;    /* first one, then the other */
};

/*--------------------------------------------------------------------------------------- >>vertices
   A batch: up to SHADE_LANES different vertices, shaded and projected as one packet, and the
   triangles among them.
     in      indices                      out  vertices and their values; corners of triangles
     holds   A vertex is shaded once per batch.  Vertices without a window position get a harmless
             one and a bit that sends their triangles through >>clip.               >>triangles */

enum {
    SHADE__OUT_NEAR = 16, SHADE__OUT_FAR = 32,
    SHADE__OUT_GUARD = 64 | 128 | 256 | 512,     /* left, right, bottom, top of the guard band */
    SHADE__OUT_W = 1024,                         /* w < 2^-60 */
    SHADE__OUT_BAD = 2048,                       /* NaN, infinite or beyond 1e30 */
    SHADE__OUT_VOLUME = 63 | SHADE__OUT_W,       /* left, right, bottom, top; near, far */
    SHADE__OUT_CLIP = SHADE__OUT_NEAR | SHADE__OUT_FAR | SHADE__OUT_GUARD | SHADE__OUT_W,
    /* has no window position */
    SHADE__OUT_UNPLACED = SHADE__OUT_GUARD | SHADE__OUT_W | SHADE__OUT_BAD
};
static const float shade__w_least = 8.67361738e-19f;    /* 2^-60 */

/* Window coordinate in 24.8: floor(256 X + 1/2), X = (c/w + 1) size/2; half is 128 times the
   size, signed.   pre: |c| <= 3 w, about   post: |result| <= 2^24; the sum is positive and below
   2^26, so that the cast truncates to floor */
SHADE__INLINE int32_t shade__snap(float c, float w, double half, double offset)
{
    return (int32_t)(((double)c / (double)w * half + offset + 0.5) + 16777216.0) - 16777216;
}
/* z/w to window depth */
SHADE__INLINE float shade__window_depth(float z, float w, double scale, double offset)
{
    return (float)((double)z / (double)w * scale + offset);
}

typedef struct shade__placed {           /* rows of projected vertices */
    SHADE_ALIGNED float x[SHADE_LANES];    /* clip space, made harmless */
    float    y[SHADE_LANES], w[SHADE_LANES];
    int32_t  x_fx8[SHADE_LANES], y_fx8[SHADE_LANES];
    uint32_t out[SHADE_LANES];
    float    z[SHADE_LANES], rw[SHADE_LANES];
} shade__placed;

SHADE__INLINE uint32_t shade__beyond(float c)     /* all ones where |c| > 1e30 or NaN */
{
    return shade__mask((int32_t)(shade__float_bits(c) & 0x7FFFFFFFu) > 0x7149F2CA);
}
/* Left, right, below, above of a square: bits 0 .. 3. */
SHADE__INLINE uint32_t shade__sides_passed(float x, float y, float limit)
{
    return (shade__mask(x < -limit) & 1) | (shade__mask(x > limit) & 2) |
           (shade__mask(y < -limit) & 4) | (shade__mask(y > limit) & 8);
}
/* Outcodes; x, y, w kept where the vertex has a window position, else 0, 0, 1. */
SHADE__INLINE void shade__classify(const shade_vertices *SHADE_RESTRICT v, int zero_to_one,
                                   shade__placed *SHADE_RESTRICT p)
{
    const float *SHADE_RESTRICT cx = v->clip[0], *SHADE_RESTRICT cy = v->clip[1];
    const float *SHADE_RESTRICT cz = v->clip[2], *SHADE_RESTRICT cw = v->clip[3];
    SHADE_EACH_LANE(i) {
        float x = cx[i], y = cy[i], z = cz[i], w = cw[i], low = zero_to_one ? 0 : -w;
        uint32_t bad = shade__beyond(x) | shade__beyond(y) | shade__beyond(z) | shade__beyond(w);
        uint32_t out = shade__sides_passed(x, y, w) | shade__sides_passed(x, y, 3 * w) << 6;
        out |= (shade__mask(z < low) & SHADE__OUT_NEAR) | (shade__mask(z > w) & SHADE__OUT_FAR) |
               (shade__mask(w < shade__w_least) & SHADE__OUT_W) | (bad & SHADE__OUT_BAD);
        p->out[i] = out;
        bad = shade__mask((out & SHADE__OUT_UNPLACED) != 0);
        p->x[i] = shade__keep(x, ~bad);
        p->y[i] = shade__keep(y, ~bad);
        p->z[i] = shade__keep(z, ~bad);
        p->w[i] = shade__select(w, 1, bad);
    }
}
SHADE__INLINE void shade__project(double half_width, double half_height, int zero_to_one,
                                  shade__placed *SHADE_RESTRICT p)
{
    const double scale = zero_to_one ? 1 : 0.5, offset = zero_to_one ? 0 : 0.5;
    SHADE_EACH_LANE(i) { p->x_fx8[i] = shade__snap(p->x[i], p->w[i], half_width, half_width); }
    SHADE_EACH_LANE(i) { p->y_fx8[i] = shade__snap(p->y[i], p->w[i], -half_height, half_height); }
    SHADE_EACH_LANE(i) { p->z[i] = shade__window_depth(p->z[i], p->w[i], scale, offset); }
    SHADE_EACH_LANE(i) { p->rw[i] = 1 / p->w[i]; }
}
/* From rows to one record per vertex: what triangles read lies together. */
SHADE__INLINE void shade__gather(const shade__plan *SHADE_RESTRICT plan, int n,
                                 const shade_vertices *SHADE_RESTRICT v,
                                 const shade__placed *SHADE_RESTRICT p,
                                 shade__batch *SHADE_RESTRICT b)
{
    const int stride = plan->value_stride, varyings = plan->varyings;
    for (int i = 0; i < n; i++) {
        shade__vertex *to = &b->vertex[i];
        float *value = b->value + i * stride;
        to->x = p->x_fx8[i];
        to->y = p->y_fx8[i];
        to->out = p->out[i];
        for (int k = 0; k < 4; k++) to->clip[k] = v->clip[k][i];
        value[0] = p->z[i];
        value[1] = p->rw[i];
    }
    for (int k = SHADE__FIRST; k < plan->values; k++) {
        const int again = k - varyings - SHADE__FIRST;    /* of u and v, a second time */
        const float *from = v->varying[again < 0 ? k - SHADE__FIRST
                                                 : plan->pipe->lod_varying + again];
        float *to = b->value + k;
        if (k < plan->divided)
            for (int i = 0; i < n; i++) to[i * stride] = from[i];
        else
            for (int i = 0; i < n; i++) to[i * stride] = from[i] * p->rw[i];
    }
}
SHADE__INLINE void shade__place_body(shade__draw *d, const shade_vertices *vertices)
{
    const shade__plan *plan = &d->plan;
    shade__placed p;
    shade__classify(vertices, plan->zero_to_one, &p);
    shade__project((double)plan->half_width, (double)plan->half_height, plan->zero_to_one, &p);
    shade__gather(plan, d->u.in.ids.count, vertices, &p, &d->batch);
}
SHADE__DISPATCH_AVX2(shade__place, (shade__draw *d, const shade_vertices *vertices), (d, vertices))

static void shade__shade_vertices(shade__draw *d)
{
    shade_vertices *v = &d->u.in.vertices;
    const int varyings = d->plan.varyings;
    for (int i = d->u.in.ids.count; i < SHADE_LANES; i++)
        d->u.in.ids.index[i] = d->u.in.ids.index[d->u.in.ids.count - 1];
    SHADE__ZERO(v->clip);
    if (varyings) SHADE_MEMSET(v->varying, 0, (size_t)varyings * sizeof v->varying[0]);
    d->plan.pipe->vertex(d->plan.pipe->uniforms, &d->u.in.ids, v);
    d->plan.stage.place(d, v);
}

/* Whether the box may be seen: 0 if it lies outside of one plane.  With its centre c and half its
   size h the greatest value of a plane is k.(c, 1) + |k|.h.  Vertices are transformed in float,
   off by 2^-22 of the sum of the products' sizes, and each of 7 clips rounds by 2^-24 of that;
   2^-20 covers both.  Products that underflow are off by 2^-148, which FLT_MIN in the sizes
   covers. */
static SHADE__NOINLINE int shade__in_view(const shade__frustum *f, shade_vec3 low, shade_vec3 high)
{
    const double cx = ((double)low.x + (double)high.x) / 2, hx = (double)high.x - cx;
    const double cy = ((double)low.y + (double)high.y) / 2, hy = (double)high.y - cy;
    const double cz = ((double)low.z + (double)high.z) / 2, hz = (double)high.z - cz;
    const double mx = shade__size(cx) + hx, my = shade__size(cy) + hy, mz = shade__size(cz) + hz;
    uint64_t signs = 0;
    if (!(low.x <= high.x && low.y <= high.y && low.z <= high.z)) return 1;
    if (!(mx + my + mz <= DBL_MAX)) return 1;
    SHADE__FOR(i, SHADE__PLANES) {
        double most = f->k[0][i] * cx + f->k[1][i] * cy + f->k[2][i] * cz + f->k[3][i];
        double off = f->size[0][i] * mx + f->size[1][i] * my;
        off += f->size[2][i] * mz + f->size[3][i];
        most += shade__size(f->k[0][i]) * hx;
        most += shade__size(f->k[1][i]) * hy;
        most += shade__size(f->k[2][i]) * hz;
        signs |= shade__double_bits(most + off * (1 / 1048576.0));
    }
    return !(signs >> 63);
}
/* Moves on to the next chunk that may be seen; 0 where there is none. */
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

/* Takes up to most triangles from first on, while their vertices find room; returns how many.
   Whether a vertex is known or new, both its slot and its index are written and the count tells: a
   branch here would be missed for every other one (2 % of a dense mesh). */
SHADE__INLINE int shade__take_triangles(shade__incoming *in, const uint32_t *indices,
                                        uint32_t first, int most, int room, uint8_t *corner)
{
    uint32_t *index_of = in->ids.index, at = 3 * first;
    int n = 0, vertices = in->ids.count;
    for (; n < most && vertices <= room; n++) {
        for (int k = 0; k < 3; k++, at++) {
            const uint32_t index = indices ? indices[at] : at;
            const int place = (int)(index & (2 * SHADE_LANES - 1)), hit = in->known[place] == index;
            const int slot = vertices + ((in->slot_of[place] - vertices) & -hit);
            index_of[vertices] = index;
            vertices += 1 - hit;
            in->known[place] = index;
            in->slot_of[place] = (uint8_t)slot;
            *corner++ = (uint8_t)slot;
        }
    }
    in->ids.count = vertices;
    return n;
}
/* A batch of the triangles that follow in the draw; none are left where its count is 0. */
static void shade__take_batch(shade__draw *d)
{
    shade__incoming *in = &d->u.in;
    shade__batch *b = &d->batch;
    shade__supply *s = d->supply;
    const int room = shade__min(SHADE_LANES, (int)SHADE__BATCH_FLOATS / d->plan.value_stride) - 3;
    SHADE_MEMSET(in->known, 255, sizeof in->known);    /* no index: counts end at 2^31 */
    in->ids.count = b->count = b->parts = 0;
    while (b->count < SHADE__BATCH_TRIANGLES && in->ids.count <= room && b->parts < SHADE__PARTS) {
        if (s->first == s->end && !(s->more && s->more(d))) break;
        const int most = shade__min(SHADE__BATCH_TRIANGLES - b->count, s->end - s->first);
        b->part[b->parts].first = b->count;
        b->part[b->parts++].primitive = (uint32_t)s->first;
        const int taken = shade__take_triangles(in, s->indices, (uint32_t)s->first, most, room,
                                                b->corner + 3 * b->count);
        b->count += taken;
        s->first += taken;
    }
    b->part[b->parts].first = b->count;
}

/*-------------------------------------------------------------------------------------- >>triangles
   Triangle setup, SHADE__TRIANGLES at a time, a lane each: three snapped vertices to three edge
   functions, a box of pixels and the plane of depth; the planes of the other values follow where
   a pixel is drawn. [Pineda88]
     in      positions in 24.8 fixed point, |x|, |y| <= 2^24; depths and 1/w
     out     a packet in the order of submission, each triangle to >>cover
     holds   For the edge p to q and the pixel centre at 256 (i, j) + 128:
               256 e(i,j) + rest = (q.x - p.x)(y - p.y) - (q.y - p.y)(x - p.x) + bias
             is inside where e >= 0; bias 0 on top and left edges, -1 on others; dividing by 256
             with floor keeps the sign, since the coefficients of i and j are multiples of 256.
             Neighbours get exactly opposite edges.  |q - p| < 2^25, |y - p.y| < 2^25: products stay
             below 2^50 and sums below 2^51, so that doubles are exact.
             Corner 0 is the farthest, whose 1/w is the smallest: there rounding hurts most.
                                                                                         >>clip */

/* floor(v / 256)   pre: |v| < 2^62 */
SHADE__INLINE int64_t shade__floor256(int64_t v)
{
    return (int64_t)((uint64_t)(v + ((int64_t)1 << 62)) >> 8) - ((int64_t)1 << 54);
}
/* the same in lanes   pre: |v| < 2^30 */
SHADE__INLINE int32_t shade__floor256_32(int32_t v)
{
    return (int32_t)((uint32_t)(v + 0x40000000) >> 8) - 0x400000;
}
/* Twice the signed area in 1/65536 pixel; positive where a, b, c turn clockwise as seen (y is
   down).   pre: |x|, |y| <= 2^24   post: |area| <= 2^51 */
SHADE__INLINE int64_t shade__area(const shade__vertex *a, const shade__vertex *b,
                                  const shade__vertex *c)
{
    return (int64_t)(b->x - a->x) * (c->y - a->y) - (int64_t)(c->x - a->x) * (b->y - a->y);
}

/* Three rows of one value turned in place: first comes corner 0, 1 or 2, then the others in the
   order of submission, or the reverse where mirrored is set. */
SHADE__INLINE void shade__turn(shade__word *SHADE_RESTRICT v, const uint32_t *SHADE_RESTRICT one,
                               const uint32_t *SHADE_RESTRICT two,
                               const uint32_t *SHADE_RESTRICT mirrored)
{
    SHADE__FOR(i, SHADE__TRIANGLES) {
        uint32_t a = v[i], b = v[i + SHADE__TRIANGLES], c = v[i + 2 * SHADE__TRIANGLES];
        uint32_t next = shade__choose(shade__choose(b, c, one[i]), a, two[i]);
        uint32_t last = shade__choose(shade__choose(c, a, one[i]), b, two[i]);
        v[i] = shade__choose(shade__choose(a, b, one[i]), c, two[i]);
        v[i + SHADE__TRIANGLES] = shade__choose(next, last, mirrored[i]);
        v[i + 2 * SHADE__TRIANGLES] = shade__choose(last, next, mirrored[i]);
    }
}
/* The rows of a value of the packet. */
SHADE__INLINE shade__word *shade__words(void *rows) { return (shade__word *)rows; }

/* Twice the area, in doubles (exact), and 256 over its size; 256 where it is 0, for programs that
   trap divisions by zero. */
SHADE__INLINE void shade__areas(const shade__packet *SHADE_RESTRICT p, float *SHADE_RESTRICT area,
                                double *SHADE_RESTRICT inverse)
{
    SHADE__FOR(i, SHADE__TRIANGLES) {
        double x1 = p->x[1][i] - p->x[0][i], y1 = p->y[1][i] - p->y[0][i];
        double x2 = p->x[2][i] - p->x[0][i], y2 = p->y[2][i] - p->y[0][i];
        double a = x1 * y2 - x2 * y1;
        area[i] = (float)a;
        inverse[i] = 256 / (shade__size(a) + (a == 0 ? 1 : 0));
    }
}
/* Which corner comes first, and whether the others are swapped. */
SHADE__INLINE void shade__turns(const shade__packet *SHADE_RESTRICT p,
                                const float *SHADE_RESTRICT area, uint32_t *SHADE_RESTRICT one,
                                uint32_t *SHADE_RESTRICT two, uint32_t *SHADE_RESTRICT mirrored)
{
    SHADE__FOR(i, SHADE__TRIANGLES) {
        float r0 = p->rw[0][i], r1 = p->rw[1][i], r2 = p->rw[2][i];
        uint32_t below = shade__mask(r1 < r0);
        uint32_t last = (below & shade__mask(r2 < r1)) | (~below & shade__mask(r2 < r0));
        two[i] = last;
        one[i] = below & ~last;
        mirrored[i] = shade__mask(area[i] < 0);
    }
}
/* Pixel centres between the extremes of one axis, in lo .. hi, both included; and the extent.
   pre: |a|, |b|, |c| <= 2^24, 0 <= lo, hi < 2^14
   post: 0 <= first <= 2^16, -2^16 - 1 <= last < 2^14; the box is empty where first > last */
SHADE__INLINE void shade__box(const int32_t *SHADE_RESTRICT a, const int32_t *SHADE_RESTRICT b,
                              const int32_t *SHADE_RESTRICT c, int32_t lo, int32_t hi,
                              int32_t *SHADE_RESTRICT first, int32_t *SHADE_RESTRICT last,
                              float *SHADE_RESTRICT extent)
{
    SHADE__FOR(i, SHADE__TRIANGLES) {
        int32_t least = shade__min(shade__min(a[i], b[i]), c[i]);
        int32_t most = shade__max(shade__max(a[i], b[i]), c[i]);
        first[i] = shade__max(shade__floor256_32(least + 127), lo);
        last[i] = shade__min(shade__floor256_32(most - 128), hi);
        extent[i] = (float)(most - least);
    }
}
/* The edge from p to q at pixel (x0, y0), 0 where 32 bits do not hold it, and its steps.
   pre: where fits is set, |q - p| and the way from p to the centre of (x0, y0) are at most the
   extents that shade__sizes found to fit   post: |e| <= 2^30, |step| <= 2^25 */
SHADE__INLINE void shade__edge(const int32_t *SHADE_RESTRICT px, const int32_t *SHADE_RESTRICT py,
                               const int32_t *SHADE_RESTRICT qx, const int32_t *SHADE_RESTRICT qy,
                               const int32_t *SHADE_RESTRICT x0, const int32_t *SHADE_RESTRICT y0,
                               const int32_t *SHADE_RESTRICT fits, int32_t *SHADE_RESTRICT e,
                               int32_t *SHADE_RESTRICT step_x, int32_t *SHADE_RESTRICT step_y)
{
    SHADE__FOR(i, SHADE__TRIANGLES) {
        int32_t dx = qx[i] - px[i], dy = qy[i] - py[i];
        int32_t x = x0[i] * 256 + 128 - px[i], y = y0[i] * 256 + 128 - py[i];
        int32_t bias = 2 * dy - (dx > 0 ? 1 : 0) < 0 ? 0 : -1;    /* dy < 0, or 0 and dx > 0 */
        double v = (double)dx * (double)y - (double)dy * (double)x + (double)bias;
        v = shade__bits_double(shade__double_bits(v) & (uint64_t)(int64_t)fits[i]);
        e[i] = (int32_t)(v * (1 / 256.0) + 1073741824.0) - 1073741824;
        step_x[i] = -dy;
        step_y[i] = dx;
    }
}
/* The sides from corner 0 to 1 and to 2 over the area, for planes: x1, y1, x2, y2. */
SHADE__INLINE void shade__sides(shade__packet *SHADE_RESTRICT p,
                                const double *SHADE_RESTRICT inverse)
{
    SHADE__FOR(i, SHADE__TRIANGLES) {
        const double k = inverse[i];
        p->side[0][i] = (float)((p->x[1][i] - p->x[0][i]) * k);
        p->side[1][i] = (float)((p->y[1][i] - p->y[0][i]) * k);
        p->side[2][i] = (float)((p->x[2][i] - p->x[0][i]) * k);
        p->side[3][i] = (float)((p->y[2][i] - p->y[0][i]) * k);
    }
}
/* Depth: its plane, and its range, to which planes are cut, as rounding may leave it at a
   sliver's edge.   post: low, high in [0, 1] */
SHADE__INLINE void shade__depth_plane(const shade__packet *SHADE_RESTRICT p, float bias,
                                      float *SHADE_RESTRICT z, float *SHADE_RESTRICT z1,
                                      float *SHADE_RESTRICT z2, float *SHADE_RESTRICT low,
                                      float *SHADE_RESTRICT high)
{
    SHADE__FOR(i, SHADE__TRIANGLES) {
        float a = z[i], b = z1[i], c = z2[i], d1 = b - a, d2 = c - a;
        float least = shade__select(a, b, shade__mask(b < a));
        float most = shade__select(a, b, shade__mask(b > a));
        least = shade__select(least, c, shade__mask(c < least));
        most = shade__select(most, c, shade__mask(c > most));
        low[i] = shade__clamp_bits(least + bias, 0, 1);
        high[i] = shade__clamp_bits(most + bias, 0, 1);
        z[i] = a + bias;
        z1[i] = d1 * p->side[3][i] - d2 * p->side[1][i];
        z2[i] = d2 * p->side[0][i] - d1 * p->side[2][i];
    }
}
/* Whether 32 bits hold the edge functions within 44 pixels of the vertices, where
   |256 e| <= |q.x - p.x| |y - p.y| + |q.y - p.y| |x - p.x|; with 2 % for rounding.  Not where the
   box is empty: its corner may be far from them. */
SHADE__INLINE void shade__sizes(const shade__packet *SHADE_RESTRICT p,
                                const float *SHADE_RESTRICT w, const float *SHADE_RESTRICT h,
                                int32_t *SHADE_RESTRICT fits)
{
    SHADE__FOR(i, SHADE__TRIANGLES) {
        float most = w[i] * (h[i] + 11264) + h[i] * (w[i] + 11264);
        int32_t across = p->box[2][i] - p->box[0][i], down = p->box[3][i] - p->box[1][i];
        fits[i] = (int32_t)(shade__mask(most < 2.7e11f) &    /* 2^38 */
                            shade__mask((across | down) >= 0));
    }
}

/* The corners of the packet's triangles to rows; lanes without a triangle repeat the first. */
SHADE__INLINE void shade__fetch_corners(shade__packet *SHADE_RESTRICT p, int stride)
{
    SHADE_ALIGNED int32_t xy[3][2 * SHADE__TRIANGLES];
    SHADE_ALIGNED float zw[3][2 * SHADE__TRIANGLES];
    for (int i = p->count; i < SHADE__TRIANGLES; i++) SHADE_MEMCPY(p->corner[i], p->corner[0], 4);
    for (int i = 0; i < SHADE__TRIANGLES; i++) {
        for (int k = 0; k < 3; k++) {
            const int v = p->corner[i][k];
            SHADE_MEMCPY(&xy[k][2 * i], &p->vertex[v], 8);
            SHADE_MEMCPY(&zw[k][2 * i], p->value + v * stride, 8);
        }
    }
    for (int k = 0; k < 3; k++) {
        SHADE__FOR(i, SHADE__TRIANGLES) {
            p->x[k][i] = xy[k][2 * i];
            p->y[k][i] = xy[k][2 * i + 1];
        }
        SHADE__FOR(i, SHADE__TRIANGLES) {
            p->z[k][i] = zw[k][2 * i];
            p->rw[k][i] = zw[k][2 * i + 1];
        }
    }
}
/* Which triangles are culled, where they are counted; the boxes of those that are not drawn are
   emptied. */
SHADE__INLINE int shade__cull(shade__packet *SHADE_RESTRICT p, shade_cull cull,
                              const float *SHADE_RESTRICT area,
                              const uint32_t *SHADE_RESTRICT mirrored)
{
    const uint32_t back = shade__mask(cull == SHADE_CULL_BACK);
    const uint32_t front = shade__mask(cull == SHADE_CULL_FRONT);
    const int n = p->count;
    int culled = 0;
    SHADE__FOR(i, SHADE__TRIANGLES) {
        uint32_t gone = shade__mask(area[i] == 0) | (mirrored[i] & front) | (~mirrored[i] & back);
        gone &= shade__mask(i < n);
        culled += (int)(gone & 1);
        p->box[2][i] = (int32_t)((uint32_t)p->box[2][i] | gone);
    }
    return culled;
}

/* Sets up the packet. */
SHADE__INLINE void shade__setup_body(shade__draw *d)
{
    shade__packet *p = &d->packet;
    const shade__plan *plan = &d->plan;
    SHADE_ALIGNED uint32_t one[SHADE__TRIANGLES], two[SHADE__TRIANGLES];
    SHADE_ALIGNED uint32_t mirrored[SHADE__TRIANGLES];
    SHADE_ALIGNED float area[SHADE__TRIANGLES], w[SHADE__TRIANGLES], h[SHADE__TRIANGLES];
    SHADE_ALIGNED double inverse[SHADE__TRIANGLES];
    SHADE_ALIGNED int32_t fits[SHADE__TRIANGLES];
    void *const rows[3] = { p->x, p->y, p->z };
    uint32_t set = 0;
    int culled;
    shade__fetch_corners(p, plan->value_stride);
    shade__areas(p, area, inverse);
    shade__turns(p, area, one, two, mirrored);
    for (int k = 0; k < 3; k++) shade__turn(shade__words(rows[k]), one, two, mirrored);
    shade__box(p->x[0], p->x[1], p->x[2], plan->x0, plan->x1 - 1, p->box[0], p->box[2], w);
    shade__box(p->y[0], p->y[1], p->y[2], plan->y0, plan->y1 - 1, p->box[1], p->box[3], h);
    shade__sizes(p, w, h, fits);
    for (int k = 0; k < 3; k++) {
        const int q = k < 2 ? k + 1 : 0;
        shade__edge(p->x[k], p->y[k], p->x[q], p->y[q], p->box[0], p->box[1], fits, p->e[k],
                    p->dx[k], p->dy[k]);
    }
    shade__sides(p, inverse);
    shade__depth_plane(p, plan->pipe->raster.depth_bias, p->z[0], p->z[1], p->z[2], p->rw[0],
                       p->rw[1]);
    SHADE__FOR(i, SHADE__TRIANGLES) {
        p->turn[i] = (one[i] & 1) + (two[i] & 2) + (mirrored[i] & 3);
        set |= (uint32_t)fits[i] & shade__bit[i];
    }
    p->fits = set;
    if (p->pieces) return;
    culled = shade__cull(p, plan->pipe->raster.cull, area, mirrored);
    d->stats.culled += culled;
    d->stats.drawn += p->count - culled;
}
SHADE__DISPATCH_AVX2(shade__setup, (shade__draw *d), (d))

/* Sets up the packet, and has its triangles drawn. */
static void shade__draw_packet(shade__draw *d)
{
    const int n = d->packet.count;
    if (!n) return;
    d->plan.stage.setup(d);
    d->packet.count = 0;
    d->plan.stage.cover(d, n);
}
/* Adds a triangle to the packet; the first corner is what CONSTANT takes. */
SHADE__INLINE void shade__add_triangle(shade__draw *d, const uint8_t *corner, int first,
                                       uint32_t primitive)
{
    shade__packet *p = &d->packet;
    uint8_t *to = p->corner[p->count];
    for (int k = 0; k < 3; k++) to[k] = corner[k];
    to[3] = (uint8_t)first;
    p->primitive[p->count++] = primitive;
    if (p->count == SHADE__TRIANGLES) shade__draw_packet(d);
}
/* A triangle of a batch, sorted out by where its corners are. */
SHADE__INLINE void shade__sort_out(shade__draw *d, const uint8_t *corner, uint32_t primitive)
{
    const shade__vertex *v = d->batch.vertex;
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
            d->plan.stage.clip(d, corner, primitive);
            return;
        }
    }
    shade__add_triangle(d, corner, corner[0], primitive);
}
/* The triangles of a batch, packet after packet drawn. */
static void shade__triangles(shade__draw *d)
{
    const shade__batch *b = &d->batch;
    shade__packet *p = &d->packet;
    p->vertex = b->vertex;
    p->value = b->value;
    p->count = 0;
    d->u.queue.f.count = 0;
    for (int i = 0; i < b->parts; i++) {
        const int first = b->part[i].first;
        const uint32_t primitive = b->part[i].primitive;
        for (int k = first; k < b->part[i + 1].first; k++)
            shade__sort_out(d, b->corner + 3 * k, primitive + (uint32_t)(k - first));
    }
    shade__draw_packet(d);
    d->plan.stage.flush(d);
}

/*------------------------------------------------------------------------------------------- >>clip
   Triangles that cross the near or far plane, or the guard band |x|, |y| <= 3 w: a polygon is cut
   plane by plane and drawn as a fan.                                              [Sutherland74]
     in      three vertices of the batch  out  up to 16 triangles for >>triangles
     holds   A new vertex is computed from the inner to the outer end of its edge, so that
             neighbours get the same bits and no crack opens.  Facing is that of the whole polygon.
                                                                                       >>blocks */

/* 3, one more for each of 7 planes, two while one cuts, and the first, for CONSTANT */
enum { SHADE__CLIP_VERTICES = 13 };

/* Signed distance to a plane, times a positive factor; inside >= 0. */
static double shade__distance_to(const float *clip, uint32_t plane, int zero_to_one)
{
    double x = (double)clip[0], y = (double)clip[1], z = (double)clip[2], w = (double)clip[3];
    switch (plane) {
    case SHADE__OUT_NEAR: return zero_to_one ? z : z + w;
    case SHADE__OUT_FAR: return w - z;
    case 64: return 3 * w + x;
    case 128: return 3 * w - x;
    case 256: return 3 * w + y;
    case 512: return 3 * w - y;
    default: return w - (double)shade__w_least;
    }
}

typedef struct shade__polygon {
    shade__vertex vertex[SHADE__CLIP_VERTICES];
    float   value[(int)SHADE__CLIP_VERTICES * (int)SHADE__VALUES_MAX];
    uint8_t corner[SHADE__CLIP_VERTICES];
    int     count;          /* corners, in order */
    uint32_t taken;         /* vertices in use: bit v */
    int     on_screen;      /* values before plan.divided are linear on the screen: all w > 0 */
} shade__polygon;

/* The vertex where an edge leaves through a plane, t of the way from in to out; on the screen that
   is t w_out / (w_in + t (w_out - w_in)) of the way, here without a difference: no digit is lost
   however far apart the two w are.   pre: d_in >= 0 > d_out, a bit of taken is free */
static uint8_t shade__new_vertex(const shade__plan *plan, shade__polygon *p, int in, int out,
                                 double d_in, double d_out)
{
    double t = d_in / (d_in - d_out), s = t;
    const int v = SHADE__LOWEST_BIT(~p->taken), stride = plan->value_stride;
    SHADE_ASSERT(v < SHADE__CLIP_VERTICES);
    p->taken |= 1u << v;
    if (p->on_screen) {    /* rounding may leave a new vertex without w */
        double inner = d_in * (double)shade__maxf(p->vertex[out].clip[3], shade__w_least);
        s = inner / (inner - d_out * (double)shade__maxf(p->vertex[in].clip[3], shade__w_least));
    }
    for (int k = 0; k < 4; k++) {
        double a = (double)p->vertex[in].clip[k];
        p->vertex[v].clip[k] = (float)(a + t * ((double)p->vertex[out].clip[k] - a));
    }
    for (int k = SHADE__FIRST; k < plan->values; k++) {
        double a = (double)p->value[in * stride + k], way = k < plan->divided ? s : t;
        p->value[v * stride + k] = (float)(a + way * ((double)p->value[out * stride + k] - a));
    }
    return (uint8_t)v;
}
/* pre: taken has vertex 0 and the corners   post: at most SHADE__CLIP_VERTICES corners, as each new
   one takes a bit */
static void shade__clip_plane(const shade__plan *plan, shade__polygon *p, uint32_t plane)
{
    const int zero_to_one = plan->zero_to_one;
    uint8_t kept[SHADE__CLIP_VERTICES];
    int count = 0;
    for (int i = 0; i < p->count; i++) {
        if (p->taken + 1 >= 1u << SHADE__CLIP_VERTICES) {    /* an edge makes one at most */
            p->count = 0;    /* coordinates so far apart that rounding bent the polygon */
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

/* The polygon of a triangle with its values not yet times rw.  Returns the planes it crosses. */
static uint32_t shade__polygon_of(const shade__plan *plan, const shade__batch *b,
                                  const uint8_t *corner, shade__polygon *p)
{
    const int stride = plan->value_stride;
    uint32_t out = 0;
    p->count = 3;
    p->taken = 7;
    p->on_screen = 1;
    SHADE__ZERO(p->value);
    for (int i = 0; i < 3; i++) {
        const float *value = b->value + corner[i] * stride;
        const shade__vertex *v = &b->vertex[corner[i]];
        float w = v->out & SHADE__OUT_UNPLACED ? 1 : v->clip[3];
        p->vertex[i] = *v;
        p->corner[i] = (uint8_t)i;
        for (int k = SHADE__FIRST; k < plan->values; k++)
            p->value[i * stride + k] = value[k] * (k < plan->divided ? 1 : w);
        out |= v->out;
        p->on_screen &= v->clip[3] > 0;
    }
    return out;
}
/* Window positions and values of its corners, as >>vertices makes them.
   post: |x|, |y| <= 2^24 */
static void shade__place_polygon(const shade__plan *plan, shade__polygon *p)
{
    const int zero_to_one = plan->zero_to_one;
    for (int i = 0; i < p->count; i++) {
        shade__vertex *v = &p->vertex[p->corner[i]];
        float w = shade__maxf(v->clip[3], shade__w_least), rw = 1 / w;
        float *value = p->value + p->corner[i] * plan->value_stride;
        for (int k = 0; k < 3; k++)    /* rounding may leave a new vertex a little outside */
            v->clip[k] = shade__maxf(-3 * w, shade__minf(v->clip[k], 3 * w));
        v->x = shade__snap(v->clip[0], w, (double)plan->half_width, (double)plan->half_width);
        v->y = shade__snap(v->clip[1], w, -(double)plan->half_height, (double)plan->half_height);
        value[0] = shade__window_depth(v->clip[2], w, zero_to_one ? 1 : 0.5, zero_to_one ? 0 : 0.5);
        value[1] = rw;
        for (int k = plan->divided; k < plan->values; k++) value[k] *= rw;
    }
}
/* Twice the area of the triangle of corners a, a + i, a + i + 1. */
static int64_t shade__fan_area(const shade__polygon *p, int a, int i)
{
    return shade__area(&p->vertex[p->corner[a]], &p->vertex[p->corner[(a + i) % p->count]],
                       &p->vertex[p->corner[(a + i + 1) % p->count]]);
}
/* The corner from which no piece of the fan is turned the other way (snapping may dent a
   polygon): 0 if all fail. */
static int shade__apex(const shade__polygon *p, int64_t area)
{
    for (int a = 0; a < p->count; a++) {
        int good = 1;
        for (int i = 1; i + 1 < p->count; i++) {
            int64_t s = shade__fan_area(p, a, i);
            good &= area < 0 ? s <= 0 : s >= 0;
        }
        if (good) return a;
    }
    return 0;
}

/* Clips, then draws or counts one triangle. */
static SHADE__COLD void shade__clip_triangle(shade__draw *d, const uint8_t *corner,
                                             uint32_t primitive)
{
    const shade__plan *plan = &d->plan;
    const shade_cull cull = plan->pipe->raster.cull;
    shade__packet *packet = &d->packet;
    shade__polygon p;
    uint32_t out = shade__polygon_of(plan, &d->batch, corner, &p);
    int64_t area = 0;
    int apex;
    for (uint32_t plane = SHADE__OUT_NEAR; plane <= SHADE__OUT_W && p.count; plane *= 2)
        if (out & plane) shade__clip_plane(plan, &p, plane);
    if (p.count < 3) {
        d->stats.clipped++;
        return;
    }
    shade__place_polygon(plan, &p);
    for (int i = 1; i + 1 < p.count; i++) area += shade__fan_area(&p, 0, i);
    if (area == 0 || cull == (area < 0 ? SHADE_CULL_FRONT : SHADE_CULL_BACK)) {
        d->stats.culled++;
        return;
    }
    d->stats.drawn++;
    shade__draw_packet(d);    /* what was submitted before */
    packet->vertex = p.vertex;
    packet->value = p.value;
    packet->pieces = 1;
    apex = shade__apex(&p, area);
    for (int i = 1; i + 1 < p.count; i++) {
        const int64_t piece = shade__fan_area(&p, apex, i);
        uint8_t fan[3];
        for (int k = 0; k < 3; k++) fan[k] = p.corner[k ? (apex + i + k - 1) % p.count : apex];
        if (piece == 0 || (piece < 0) != (area < 0)) continue;
        shade__add_triangle(d, fan, 0, primitive);
    }
    shade__draw_packet(d);
    packet->vertex = d->batch.vertex;
    packet->value = d->batch.value;
    packet->pieces = 0;
}

/*----------------------------------------------------------------------------------------- >>blocks
   What a big triangle hides from those after it in the same draw: a bound of depth for each block
   of pixels, so that hidden blocks are left out whole.                                   [Greene93]
     in      triangles at least 32 x 8 pixels           out  the blocks to look at
     holds   With the tests that only ever bring depth nearer (less, greater, or equal), no pixel of
             a block is farther than the farthest corner of a triangle that filled it.  Slopes are
             below 2^34, so all sums are finite; rounding is monotonic, so corners bound every depth
             between, to the bit.  1000 big triangles, 163 Mpixel of overdraw: 3.7 times as fast,
             with SSE2 6.2 times.                                                       >>cover */

/* A triangle while its pixels are looked for. */
typedef struct shade__triangle {
    int      x0, y0, x1, y1;          /* pixels whose centre may be inside, both ends included */
    int      lane, in_32_bits;        /* of the packet; |e| < 2^30 in and 40 pixels around box */
    int32_t  e[3], dx[3], dy[3];      /* edge functions at pixel (x0, y0), their steps */
    float    x_ref, y_ref;            /* 1/2 - position of corner 0, pixels; exact */
    float    z, z_dx, z_dy;           /* plane of depth: at corner 0, steps */
    float    z_low, z_high;
} shade__triangle;

/* From a position in 24.8 to the centre of pixel 0: exact. */
SHADE__INLINE float shade__reference(int32_t v) { return 0.5f - (float)v * (1 / 256.0f); }
/* The edge functions at pixel (x0, y0) in 64 bits.   post: |e| <= 2^44 */
static void shade__wide_edges(const shade__packet *p, const shade__triangle *t, int64_t *e)
{
    for (int k = 0; k < 3; k++) {
        const int64_t dx = t->dy[k], dy = -(int64_t)t->dx[k];
        const int64_t x = t->x0 * 256 + 128 - p->x[k][t->lane];
        const int64_t y = t->y0 * 256 + 128 - p->y[k][t->lane];
        e[k] = shade__floor256(dx * y - dy * x + (dy < 0 || (dy == 0 && dx > 0) ? 0 : -1));
    }
}

/* Depth of the triangle's plane at x = x_ref of row y. */
SHADE__INLINE float shade__row_depth(const shade__triangle *t, int y)
{
    return t->z + t->z_dy * ((float)y + t->y_ref);
}
/* Cuts the clip rectangle into blocks of 32 x 8 pixels or more, SHADE__BLOCKS at most.
   pre: the rectangle is not empty, within 2^14   post: neither logarithm is above 14 */
static SHADE__UNUSED void shade__begin_blocks(const shade__plan *plan, shade__hidden *hidden)
{
    int w = plan->x1 - plan->x0 - 1, h = plan->y1 - plan->y0 - 1;
    hidden->log_width = 5;
    hidden->log_height = 3;
    while (((w >> hidden->log_width) + 1) * ((h >> hidden->log_height) + 1) > SHADE__BLOCKS) {
        if (hidden->log_height < hidden->log_width) hidden->log_height++;
        else hidden->log_width++;
    }
    hidden->across = (w >> hidden->log_width) + 1;
    for (int i = 0; i < SHADE__BLOCKS; i++) hidden->farthest[i] = FLT_MAX;
}
/* toward times the depth of the triangle's plane at pixel x of a row that begins with z0: the bits
   that >>cover tests */
SHADE__INLINE float shade__key(float toward, const shade__triangle *t, float z0, int x)
{
    return toward * shade__clamp_bits(z0 + t->z_dx * ((float)x + t->x_ref), t->z_low, t->z_high);
}
/* In rows y .. bottom of the triangle's box, of one row of blocks: moves *x to the next block that
   has a pixel of the triangle and is not hidden, beyond the box if there is none, and returns the
   last pixel before one that has not or is.   pre: |edge| <= 2^44 */
SHADE__UNUSED static SHADE__NOINLINE int shade__next_blocks(
    const shade__plan *plan, shade__hidden *hidden, const shade__triangle *t, const int64_t *edge,
    int *x, int y, int bottom)
{
    const float toward = plan->toward;
    const int right = toward * t->z_dx > 0, down = toward * t->z_dy > 0;
    const float z_near = shade__row_depth(t, down ? y : bottom);
    const float z_far = shade__row_depth(t, down ? bottom : y);
    const int row = (y - plan->y0) >> hidden->log_height, size = 1 << hidden->log_width;
    const int whole =
        y == plan->y0 + (row << hidden->log_height) &&
        bottom == shade__min(plan->y0 + ((row + 1) << hidden->log_height), plan->y1) - 1;
    int64_t most[3], least[3];        /* of the edges in a block at x0, wherever it is cut */
    for (int k = 0; k < 3; k++) {
        const int64_t dx = t->dx[k], dy = t->dy[k], e = edge[k] + dy * (y - t->y0);
        const int64_t across = dx * (size - 1), up = dy * (bottom - y);
        most[k] = e + (across > 0 ? across : 0) + (up > 0 ? up : 0);
        least[k] = e + (across < 0 ? across : 0) + (up < 0 ? up : 0);
    }
    for (int from = *x, to; from <= t->x1; from = to + 1) {
        const int column = (from - plan->x0) >> hidden->log_width;
        const int first = plan->x0 + column * size, last = shade__min(first + size, plan->x1) - 1;
        float *farthest = &hidden->farthest[row * hidden->across + column];
        int64_t outside = 0, inside = 0;    /* negative: an edge has all, has some pixel outside */
        int skip;
        to = shade__min(last, t->x1);
        for (int k = 0; k < 3; k++) {
            const int64_t e = (int64_t)t->dx[k] * (first - t->x0);
            outside |= most[k] + e;
            inside |= least[k] + e;
        }
        skip = outside < 0 || shade__key(toward, t, z_near, right ? from : to) > *farthest;
        if (skip && from > *x) return from - 1;
        if (skip) *x = to + 1;
        else if (inside >= 0 && whole)
            *farthest = shade__minf(*farthest, shade__key(toward, t, z_far, right ? to : from));
    }
    return t->x1;
}

/*------------------------------------------------------------------------------------------ >>cover
   Which pixels of a triangle are inside and pass the depth test; runs of them go to the queue.
     in      a triangle of the packet, with its box
     out     depth (early test), runs of pixels for >>fragments
     method  Narrower than SHADE__WINDOW: columns of pixels, each asked for the three edges, 8 rows
             before the first becomes a run.  Wider: exact spans, the first and last pixel of each
             row from its three edges, 8 rows at once in lanes where 32 bits hold the edges, row by
             row in 64 bits else; then the depth test in windows.  A value at a pixel has the same
             bits however it is reached: row base, then gx times the exact distance.
     holds   A window stays inside the clip rectangle: stores rewrite only pixels of this thread.
                                                                                    >>fragments */

/* The triangle of a lane of the packet. */
SHADE__INLINE void shade__triangle_of(const shade__packet *p, int i, shade__triangle *t)
{
    t->x0 = p->box[0][i];
    t->y0 = p->box[1][i];
    t->x1 = p->box[2][i];
    t->y1 = p->box[3][i];
    for (int k = 0; k < 3; k++) {
        t->e[k] = p->e[k][i];
        t->dx[k] = p->dx[k][i];
        t->dy[k] = p->dy[k][i];
    }
    t->lane = i;
    t->in_32_bits = p->fits >> i & 1;
    t->x_ref = shade__reference(p->x[0][i]);
    t->y_ref = shade__reference(p->y[0][i]);
    t->z = p->z[0][i];
    t->z_dx = p->z[1][i];
    t->z_dy = p->z[2][i];
    t->z_low = p->rw[0][i];
    t->z_high = p->rw[1][i];
}

/* Runs of pixels on their way to the queue, handed over when there are as many as fit. */
enum { SHADE__RUNS = SHADE_LANES < 64 ? 12 : 16, SHADE__WINDOW = 32 };
struct shade__runs { shade__run run[SHADE__RUNS]; int count; };

SHADE__INLINE void shade__send(shade__draw *d, shade__runs *r)
{
    if (r->count && d->plan.queued) d->plan.stage.push(d, r->run, r->count);
    r->count = 0;
}
/* pre: r has room for one */
SHADE__INLINE void shade__add_run(shade__runs *r, int lane, int x, int y, int n)
{
    shade__run *run = &r->run[r->count++];
    run->x = x;
    run->y = y;
    run->n = n;
    run->lane = lane;
}
/* The runs of a set; bit i stands for pixel x + i of row y. */
static SHADE__NOINLINE void shade__add_set(shade__draw *d, shade__runs *r, int lane, int x, int y,
                                           uint32_t set)
{
    while (set) {
        const int first = SHADE__LOWEST_BIT(set);
        const int n = SHADE__LOWEST_BIT(~(set >> first));    /* the set lacks one of 32 */
        if (r->count == SHADE__RUNS) shade__send(d, r);
        shade__add_run(r, lane, x + first, y, n);
        set &= set + (set & (0u - set));    /* without its lowest run */
    }
}

typedef struct shade__rows8 { int32_t first[8], last[8]; } shade__rows8;    /* from x0; of 8 rows */

/* Pixels 0 .. n - 1 of 8 rows where e + i dx + r dy >= 0 for all three edges.  An edge with dx < 0
   is looked at from the right end, so that each asks for the first i with e + i |dx| >= 0.  The
   quotient in float is off by less than 1/100, so the truncated one is the answer, or one or two
   below it.
   pre: in_32_bits, rows and n within the box   post: 0 <= first <= n + 2, -3 <= last < n */
SHADE__INLINE void shade__spans_small(const shade__triangle *SHADE_RESTRICT t, int row, int n,
                                      shade__rows8 *SHADE_RESTRICT s)
{
    SHADE__FOR(r, 8) {
        s->first[r] = 0;
        s->last[r] = n - 1;
    }
    for (int k = 0; k < 3; k++) {
        const int32_t dx = t->dx[k], dy = t->dy[k], step = dx < 0 ? -dx : dx;
        const int32_t e0 = t->e[k] + row * dy + (dx < 0 ? (n - 1) * dx : 0);
        const float inverse = step ? 1 / (float)step : (float)n, limit = (float)n;
        const int32_t left = dx < 0 ? 0 : -1, right = dx < 0 ? -1 : 0, end = n - 1;
        SHADE__FOR(r, 8) {
            int32_t e = e0 + r * dy, q = (int32_t)shade__clamp_bits((float)-e * inverse, 0, limit);
            int32_t i, j;
            e += q * step;
            j = e < 0 ? 1 : 0;
            e += j * step;
            j += e < 0 ? 1 : 0;
            i = (q + j) & left;
            j = end - ((q + j) & right);
            s->first[r] = shade__max(s->first[r], i);
            s->last[r] = shade__min(s->last[r], j);
        }
    }
}

/* First (dx > 0) or last (dx < 0) i in 0 .. n - 1 with e + i dx >= 0; n or -1 if none is.  The
   quotient, correctly rounded and below 2^14, is whole or at least 2^-25 from a whole number: so
   truncation is exact.   pre: |e| <= 2^45, 0 < |dx| <= 2^25, 1 <= n <= 2^14 */
static int shade__crossing(int64_t e, int32_t dx, int n)
{
    double q = -(double)e / dx;
    int i = q <= 0 ? 0 : q >= n ? n : (int)q;
    if (dx > 0) return i < n && e + (int64_t)i * dx < 0 ? i + 1 : i;
    return q < 0 ? -1 : shade__min(i, n - 1);
}
static void shade__spans_big(const shade__triangle *t, const int64_t *edge, int row, int n,
                             shade__rows8 *s)
{
    for (int r = 0; r < 8; r++) {
        int first = 0, last = n - 1;
        for (int k = 0; k < 3; k++) {
            int64_t e = edge[k] + (int64_t)(row + r) * t->dy[k];
            if (t->dx[k] > 0) first = shade__max(first, shade__crossing(e, t->dx[k], n));
            else if (t->dx[k] < 0) last = shade__min(last, shade__crossing(e, t->dx[k], n));
            else if (e < 0) last = -1;
        }
        s->first[r] = first;
        s->last[r] = last;
    }
}

/* Where row y begins in depth. */
SHADE__INLINE float *shade__depth_row(const shade__plan *plan, int y)
{
    return plan->depth + (size_t)(y - plan->row_offset) * (size_t)plan->stride;
}

/* The depth test of z against the stored s, as masks.  plain: LESS. */
SHADE__INLINE uint32_t shade__passes(shade__compare c, const int plain, float z, float s)
{
    if (plain) return shade__mask(z < s);
    return (shade__mask(z < s) & c.less) | (shade__mask(z == s) & c.equal) |
           (shade__mask(z > s) & c.greater) | c.always;
}
/* Tests pixels x + skip .. x + skip + n - 1 of a window at x; z0: depth of the row's plane at
   x_ref.  Writes depth; returns the set of those that passed, bit i for pixel x + i. */
SHADE__INLINE uint32_t shade__test(shade__compare c, const shade__triangle *SHADE_RESTRICT t,
                                   float z0, int x, int skip, int n, float *SHADE_RESTRICT depth,
                                   const int width, const int plain)
{
    const float z_dx = t->z_dx, x_ref = t->x_ref, z_low = t->z_low, z_high = t->z_high;
    const int last = skip + n - 1;
    uint32_t set = 0;
    SHADE__FOR(i, width) {
        float z = shade__clamp_bits(z0 + z_dx * ((float)(x + i) + x_ref), z_low, z_high);
        uint32_t m = shade__mask(((i - skip) | (last - i)) >= 0);
        m &= shade__passes(c, plain, z, depth[i]);
        depth[i] = shade__select(depth[i], z, plain ? m : m & c.write);
        set |= m & shade__bit[i];
    }
    return set;
}
SHADE__INLINE int shade__count_bits(uint32_t m)
{
    m = m - (m >> 1 & 0x55555555u);
    m = (m & 0x33333333u) + (m >> 2 & 0x33333333u);
    return (int)(((m + (m >> 4)) & 0x0F0F0F0Fu) * 0x01010101u >> 24);
}

/* One run, unless it is empty. */
SHADE__INLINE void shade__add_length(shade__draw *d, shade__runs *r, int lane, int x, int y, int n)
{
    if (!n) return;
    if (r->count == SHADE__RUNS) shade__send(d, r);
    shade__add_run(r, lane, x, y, n);
}
/* The depth test of n pixels from x on in row y, all inside the triangle.  They are taken in
   windows of 32, the last in one of 16 or 32 that may have to begin further left, or, where the
   clip rectangle is narrower, one by one.  Neighbours that all pass make one run. */
SHADE__INLINE void shade__span(shade__draw *d, const shade__triangle *t, shade__runs *r, int x,
                               int y, int n)
{
    const shade__plan *plan = &d->plan;
    const float z = shade__row_depth(t, y);
    float *row = shade__depth_row(plan, y);
    int length = 0;
    for (int take; n > 0; x += take, n -= take) {
        int width = SHADE__TWICE && plan->plain && n > 16 ? 32 : 16;
        int at = shade__min(x, plan->x1 - width), skip;
        uint32_t set;
        if (at < plan->x0) {
            width = 1;
            at = x;
        }
        skip = x - at;
        take = shade__min(n, width - skip);
        if (SHADE__TWICE && width == 32)
            set = shade__test(plan->compare, t, z, at, skip, take, row + at, 32, 1);
        else if (SHADE__TWICE && width == 16)
            set = shade__test(plan->compare, t, z, at, skip, take, row + at, 16, 0);
        else
            set = shade__test(plan->compare, t, z, at, skip, take, row + at,
                              SHADE__TWICE ? 1 : width, 0);
        set >>= skip;
        d->stats.fragments += shade__count_bits(set);
        if (!plan->queued) continue;
        if (set == 0xFFFFFFFFu >> (32 - take)) {
            length += take;
            continue;
        }
        shade__add_length(d, r, t->lane, x - length, y, length);
        length = 0;
        if (set) shade__add_set(d, r, t->lane, x, y, set);
    }
    shade__add_length(d, r, t->lane, x - length, y, length);
}

/* Draws the triangle's pixels in columns x0 .. x1 and rows y .. y1 of its box. */
SHADE__INLINE void shade__cover_part(shade__draw *d, const shade__triangle *t, const int64_t *edge,
                                     shade__runs *runs, int x0, int y, int x1, int y1)
{
    const shade__plan *plan = &d->plan;
    const int n = t->x1 - t->x0 + 1, low = x0 - t->x0, high = x1 - t->x0;
    shade__rows8 s;
    for (; y <= y1; y += 8) {
        int rows = shade__min(8, y1 - y + 1);
        if (t->in_32_bits) shade__spans_small(t, y - t->y0, n, &s);
        else shade__spans_big(t, edge, y - t->y0, n, &s);
        for (int r = 0; r < rows; r++) {
            int first = shade__max(s.first[r], low), x = t->x0 + first;
            int length = shade__min(s.last[r], high) - first + 1;
            if (length <= 0) continue;
            if (plan->early) {
                shade__span(d, t, runs, x, y + r, length);
                continue;
            }
            if (!plan->pipe->may_discard) d->stats.fragments += length;
            shade__add_length(d, runs, t->lane, x, y + r, length);
        }
    }
}

/* Rows y .. y + rows - 1 of a column of width pixels from x on, of a triangle whose edges 32 bits
   hold: the three edges asked for every pixel, then the depth test.  Adds to set bit at + i for
   pixel x + i of each row.
   pre: the rows and columns are in the clip rectangle, at most 40 pixels from the box; rows <= 8,
   at + width <= 32 */
SHADE__INLINE void shade__cover_column(const shade__plan *SHADE_RESTRICT plan,
                                       const shade__triangle *SHADE_RESTRICT t,
                                       const float *SHADE_RESTRICT row_z, int x, int y, int rows,
                                       int at, uint32_t *SHADE_RESTRICT set, const int width,
                                       const int plain)
{
    const shade__compare test = plan->compare;
    const float z_dx = t->z_dx, x_ref = t->x_ref, z_low = t->z_low, z_high = t->z_high;
    const int32_t i0 = x - t->x0, j0 = y - t->y0;
    const int32_t adx = t->dx[0], ady = t->dy[0], a = t->e[0] + i0 * adx + j0 * ady;
    const int32_t bdx = t->dx[1], bdy = t->dy[1], b = t->e[1] + i0 * bdx + j0 * bdy;
    const int32_t cdx = t->dx[2], cdy = t->dy[2], c = t->e[2] + i0 * cdx + j0 * cdy;
    float *SHADE_RESTRICT depth = shade__depth_row(plan, y) + x;
    const int stride = plan->stride;
    int32_t e0[16], e1[16], e2[16];
    float zx[16];
    SHADE__FOR(i, width) {
        e0[i] = a + i * adx;
        e1[i] = b + i * bdx;
        e2[i] = c + i * cdx;
        zx[i] = z_dx * ((float)(x + i) + x_ref);
    }
    for (int r = 0; r < rows; r++, depth += stride) {
        const float z0 = row_z[r];
        uint32_t any = 0;
        SHADE__FOR(i, width) {
            float z = shade__clamp_bits(z0 + zx[i], z_low, z_high);
            uint32_t m = shade__mask((e0[i] | e1[i] | e2[i]) >= 0);
            m &= shade__passes(test, plain, z, depth[i]);
            depth[i] = shade__select(depth[i], z, plain ? m : m & test.write);
            any |= m & shade__bit[i];
            e0[i] += ady;
            e1[i] += bdy;
            e2[i] += cdy;
        }
        set[r] |= any << at;
    }
}
/* A triangle at most 32 pixels wide, with the early depth test: columns, 8 rows at a time, so that
   the depths of a row arrive while others are tested. */
SHADE__INLINE void shade__cover_narrow(shade__draw *d, const shade__triangle *SHADE_RESTRICT t,
                                       shade__runs *SHADE_RESTRICT runs, const int width)
{
    const shade__plan *plan = &d->plan;
    const int plain = SHADE__TWICE && plan->plain;
    const int n = t->x1 - t->x0 + 1, wide = width > 8 && n <= 8 ? 8 : (n + width - 1) & -width;
    const int start = shade__min(t->x0, plan->x1 - wide);
    int fragments = 0;
    for (int y = t->y0; y <= t->y1; y += 8) {
        const int rows = shade__min(8, t->y1 - y + 1);
        uint32_t set[8];
        float row_z[8];
        SHADE__FOR(r, 8) { set[r] = 0; }
        SHADE__FOR(r, 8) { row_z[r] = t->z + t->z_dy * ((float)(y + r) + t->y_ref); }
        if (width > 8 && n <= 8) {
            if (plain) shade__cover_column(plan, t, row_z, start, y, rows, 0, set, 8, 1);
            else shade__cover_column(plan, t, row_z, start, y, rows, 0, set, 8, 0);
        } else {
            for (int at = 0; at < n; at += width) {
                const int x = start + at;
                if (plain) shade__cover_column(plan, t, row_z, x, y, rows, at, set, width, 1);
                else shade__cover_column(plan, t, row_z, x, y, rows, at, set, width, 0);
            }
        }
        if (SHADE__UNLIKELY(runs->count > SHADE__RUNS - 8)) shade__send(d, runs);
        for (int r = 0; r < rows; r++) {    /* nearly every set is one run or empty */
            const uint32_t all = set[r], lowest = all & (0u - all), more = all & (all + lowest);
            fragments += shade__count_bits(all);
            if (SHADE__UNLIKELY(more)) {
                shade__add_set(d, runs, t->lane, start, y + r, all);
                if (runs->count > SHADE__RUNS - 8) shade__send(d, runs);
                continue;
            }
            shade__add_run(runs, t->lane, start + SHADE__LOWEST_BIT(all | 0x80000000u), y + r,
                           shade__count_bits(all));
            runs->count -= !all;
        }
    }
    d->stats.fragments += fragments;
}
/* Any other triangle: spans, of blocks that are not hidden. */
SHADE__INLINE void shade__spans_body(shade__draw *d, shade__runs *runs, int lane)
{
    const shade__plan *plan = &d->plan;
    shade__triangle t;
    int64_t edge[3];
    int blocks;
    shade__triangle_of(&d->packet, lane, &t);
    shade__wide_edges(&d->packet, &t, edge);
    blocks = SHADE__TWICE && t.x1 - t.x0 >= 31 && t.y1 - t.y0 >= 7 && plan->toward != 0;
    if (blocks && !d->hidden.across) shade__begin_blocks(plan, &d->hidden);
    for (int y = t.y0, bottom; y <= t.y1; y = bottom + 1) {
        const int below = blocks ? (y - plan->y0) | ((1 << d->hidden.log_height) - 1) : 16384;
        bottom = shade__min(t.y1, plan->y0 + below);
        for (int x = t.x0, last; x <= t.x1; x = last + 1) {
            last = t.x1;
            if (blocks) last = shade__next_blocks(plan, &d->hidden, &t, edge, &x, y, bottom);
            if (x <= last) shade__cover_part(d, &t, edge, runs, x, y, last, bottom);
        }
    }
}
SHADE__DISPATCH(shade__spans, (shade__draw *d, shade__runs *runs, int lane), (d, runs, lane))

/* All triangles of the packet that are drawn. */
SHADE__INLINE void shade__cover_body(shade__draw *d, int count, const int width)
{
    const shade__packet *p = &d->packet;
    const int windows = d->plan.early && d->plan.x1 - d->plan.x0 >= SHADE__WINDOW;
    shade__runs runs;
    runs.count = 0;
    for (int i = 0; i < count; i++) {
        shade__triangle t;
        const int across = p->box[2][i] - p->box[0][i], down = p->box[3][i] - p->box[1][i];
        if ((across | down) < 0) continue;
        if (!windows || !(p->fits >> i & 1) || across >= SHADE__WINDOW - 1) {
            d->plan.stage.spans(d, &runs, i);
            continue;
        }
        shade__triangle_of(p, i, &t);
        shade__cover_narrow(d, &t, &runs, width);
    }
    shade__send(d, &runs);
}
SHADE__DISPATCH(shade__cover, (shade__draw *d, int count), (d, count, shade__width))

/*-------------------------------------------------------------------------------------- >>fragments
   The queue of pixels that passed, over the triangles of a batch; a full packet is shaded and
   stored.  Shading waiting fragments together measured 2 to 3 times faster on dense meshes than a
   packet per span.
     in      runs of pixels of a triangle, whose planes are made with the first
     out     packets of fragments for the shader, its colours for >>store
     holds   Values of the queue are times rw until the packet is shaded.  The lanes from count on
             repeat the last one before a shader sees them.                            >>texture */

enum {    /* most pixels appended at once */
    SHADE__WIDE = SHADE_LANES < 32 ? SHADE_LANES : 32,
    SHADE__NARROW = SHADE_LANES < 16 ? SHADE_LANES : 16
};
/* The planes of a triangle's values: value = base + gy (y + y_ref) + gx (x + x_ref). */
typedef struct shade__planes {
    SHADE_ALIGNED float base[SHADE__VALUES_MAX];
    float    gx[SHADE__VALUES_MAX], gy[SHADE__VALUES_MAX];
    float    x_ref, y_ref;            /* 1/2 - position of corner 0, pixels; exact */
    float    z_low, z_high, rw_low, rw_high;    /* planes are cut to these */
    uint32_t primitive, front;
} shade__planes;

/* All in one loop; k: the sides over the area. */
SHADE__INLINE void shade__slopes(const float *SHADE_RESTRICT v0, const float *SHADE_RESTRICT v1,
                                 const float *SHADE_RESTRICT v2, shade_vec4 k, int stride,
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
SHADE__INLINE void shade__make_planes(const shade__plan *plan, const shade__packet *p, int i,
                                      shade__planes *t)
{
    static const uint8_t order[6][3] = { { 0, 1, 2 }, { 1, 2, 0 }, { 2, 0, 1 },
                                         { 0, 2, 1 }, { 1, 0, 2 }, { 2, 1, 0 } };
    const int stride = plan->value_stride;
    const uint8_t *corner = p->corner[i], *turn = order[p->turn[i]];
    const float *v0 = p->value + corner[turn[0]] * stride;
    const float *v1 = p->value + corner[turn[1]] * stride;
    const float *v2 = p->value + corner[turn[2]] * stride;
    const shade_vec4 side = shade_v4(p->side[0][i], p->side[1][i], p->side[2][i], p->side[3][i]);
    shade__slopes(v0, v1, v2, side, stride, t);
    t->base[0] = p->z[0][i];    /* with the bias */
    t->z_low = p->rw[0][i];
    t->z_high = p->rw[1][i];
    t->rw_low = v0[1];
    t->rw_high = shade__maxf(v0[1], shade__maxf(v1[1], v2[1]));
    t->x_ref = shade__reference(p->x[0][i]);
    t->y_ref = shade__reference(p->y[0][i]);
    t->primitive = p->primitive[i];
    t->front = p->turn[i] > 2;
    if (plan->pipe->interpolation == SHADE_INTERPOLATION_CONSTANT) {
        const float *value = p->value + corner[3] * stride;
        for (int s = SHADE__FIRST; s < plan->divided; s++) {
            t->base[s] = value[s];
            t->gx[s] = t->gy[s] = 0;
        }
    }
}

/* The longer step of u, v to the next pixel, squared, in texels, in 8 lanes: with u = U / q,
   q = rw, the derivative du/dx is (U_x - u q_x) / q, quotients that keep their size whatever w
   is. */
SHADE__INLINE void shade__append_lod(const shade__plan *SHADE_RESTRICT plan,
                                     const shade__planes *SHADE_RESTRICT t,
                                     const float *SHADE_RESTRICT row, int x, int back,
                                     const float *SHADE_RESTRICT rw, float *SHADE_RESTRICT lod)
{
    const int k = plan->lod;
    const float w = (float)plan->pipe->lod_texture->width;
    const float h = (float)plan->pipe->lod_texture->height;
    const float u0 = row[k], v0 = row[k + 1], x_ref = t->x_ref;
    const float ux = t->gx[k], vx = t->gx[k + 1], qx = t->gx[1];
    const float uy = t->gy[k], vy = t->gy[k + 1], qy = t->gy[1];
    SHADE__FOR(i, 8) {
        float px = (float)(x + i) + x_ref, r = 1 / rw[i];
        float u = (u0 + ux * px) * r, v = (v0 + vx * px) * r;
        float a = (ux - u * qx) * r * w, b = (vx - v * qx) * r * h;
        float c = (uy - u * qy) * r * w, e = (vy - v * qy) * r * h;
        float right = a * a + b * b, below = c * c + e * e;
        float step = shade__select(right, below, shade__mask(below > right));
        lod[i] = shade__select(step, lod[i], shade__mask(i < back));
    }
}

/* One row of a plane into width lanes of the queue, but the first back of them. */
SHADE__INLINE void shade__append_plane(float value, float step, const float *SHADE_RESTRICT px,
                                       int back, float *SHADE_RESTRICT to, const int width)
{
    SHADE__FOR(i, width) {
        to[i] = shade__select(value + step * px[i], to[i], shade__mask(i < back));
    }
}
/* Where the pixels are, which shaders of this file do not ask. */
SHADE__INLINE void shade__append_place(const shade__planes *SHADE_RESTRICT t, float z0, int x,
                                       int y, const float *SHADE_RESTRICT px, int back,
                                       shade_fragments *SHADE_RESTRICT f, int c, const int width)
{
    const float centre = (float)y + 0.5f, z_dx = t->gx[0];
    SHADE__FOR(i, width) {
        const uint32_t keep = shade__mask(i < back);
        float z = shade__clamp_bits(z0 + z_dx * px[i], t->z_low, t->z_high);
        f->x[c + i] = shade__select((float)(x + i) + 0.5f, f->x[c + i], keep);
        f->y[c + i] = shade__select(centre, f->y[c + i], keep);
        f->z[c + i] = shade__select(z, f->z[c + i], keep);
        f->primitive[c + i] = shade__choose(t->primitive, f->primitive[c + i], keep);
        f->front[c + i] = shade__choose(t->front, f->front[c + i], keep);
    }
}
/* Writes width lanes of the queue from lane c on: pixels x, x + 1, ... of row y.  The first back of
   them keep what they hold; where back is the constant 0 the choice vanishes. */
SHADE__INLINE void shade__append(shade__draw *SHADE_RESTRICT d,
                                 const shade__planes *SHADE_RESTRICT t,
                                 const float *SHADE_RESTRICT row, int x, int y, int c, int back,
                                 const int width)
{
    const shade__plan *plan = &d->plan;
    shade__queue *SHADE_RESTRICT q = &d->u.queue;
    const float x_ref = t->x_ref, rw0 = row[1], rw_dx = t->gx[1];
    const uint32_t offset = (uint32_t)(y - plan->row_offset) * (uint32_t)plan->stride + (uint32_t)x;
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
        shade__append_plane(row[SHADE__FIRST + k], t->gx[SHADE__FIRST + k], px, back,
                            q->f.varying[k] + c, width);
    if (plan->bare) return;
    shade__append_place(t, row[0], x, y, px, back, &q->f, c, width);
}

/* Values of the planes at x = x_ref of row y. */
SHADE__INLINE void shade__row(const shade__planes *SHADE_RESTRICT t, int stride, int y,
                              float *SHADE_RESTRICT row)
{
    const float py = (float)y + t->y_ref;
    for (int s = 0; s < stride; s += 8) {
        SHADE__FOR(k, 8) { row[s + k] = t->base[s + k] + t->gy[s + k] * py; }
    }
}

/* Appends one run, shading the queue whenever it is full.   post: it is not full */
SHADE__INLINE void shade__push_run(shade__draw *d, const shade__planes *t, const float *row, int x,
                                   int y, int n)
{
    const shade__plan *plan = &d->plan;
    shade__queue *q = &d->u.queue;
    /* nothing to carry from window to window: 5 % of a dense mesh */
    if (SHADE__TWICE && n <= 8 && SHADE_LANES - q->f.count > 8 && !plan->lod) {
        shade__append(d, t, row, x, y, q->f.count, 0, 8);
        q->f.count += n;
        return;
    }
    while (n > 0) {
        const int room = SHADE_LANES - q->f.count, back = shade__max(0, 8 - room);
        const int from = x - back, c = q->f.count - back;    /* the packet may end in the window */
        const int width = SHADE__TWICE && n > 8 && room >= SHADE__WIDE ? SHADE__WIDE : 8;
        const int take = shade__min(n, width - back);
        if (SHADE__TWICE && width > 8) shade__append(d, t, row, from, y, c, 0, SHADE__WIDE);
        else shade__append(d, t, row, from, y, c, back, 8);
        for (int i = 0; plan->lod && i < width; i += 8)
            shade__append_lod(plan, t, row, from + i, back, q->rw + c + i, q->f.lod + c + i);
        x += take;
        n -= take;
        q->f.count += take;
        if (q->f.count == SHADE_LANES) plan->stage.flush(d);
    }
}
SHADE__INLINE void shade__push_body(shade__draw *d, const shade__run *run, int runs)
{
    shade__planes t;
    SHADE_ALIGNED float row[SHADE__VALUES_MAX];
    for (int k = 0; k < runs; k++) {
        if (!k || run[k].lane != run[k - 1].lane)
            shade__make_planes(&d->plan, &d->packet, run[k].lane, &t);
        shade__row(&t, d->plan.value_stride, run[k].y, row);
        shade__push_run(d, &t, row, run[k].x, run[k].y, run[k].n);
    }
}
SHADE__DISPATCH(shade__push, (shade__draw *d, const shade__run *run, int runs),
                (d, run, runs))

/* The lanes of a row from n on. */
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
    shade__repeat(q->f.lod, n);
    if (plan->bare) return;
    shade__repeat(q->f.x, n);
    shade__repeat(q->f.y, n);
    shade__repeat(q->f.z, n);
    shade__repeat(q->f.primitive, n);
    shade__repeat(q->f.front, n);
}
/* Rows of varyings times w = 1/rw.  rw of a covered pixel lies between its vertices' and is
   positive. */
SHADE__INLINE void shade__divide(float *SHADE_RESTRICT rw, float *SHADE_RESTRICT varying, int n)
{
    SHADE_EACH_LANE(i) { rw[i] = 1 / rw[i]; }
    for (int k = 0; k < n; k++, varying += SHADE_LANES) {
        SHADE_EACH_LANE(i) { varying[i] *= rw[i]; }
    }
}
/* lod from the squared step; NaN as 0 */
SHADE__INLINE void shade__levels(float *SHADE_RESTRICT lod)
{
    SHADE_EACH_LANE(i) {
        float square = shade__keep(lod[i], shade__mask(lod[i] >= 0));
        lod[i] = -0.5f * shade__neg_log2(square);
    }
}
/* Shades what waits. */
SHADE__INLINE void shade__flush_body(shade__draw *d)
{
    const shade__plan *plan = &d->plan;
    shade__queue *q = &d->u.queue;
    shade_colors c;
    if (q->f.count == 0) return;
    if (q->f.count < SHADE_LANES) shade__replicate(q, plan);
    if (plan->divided == SHADE__FIRST && plan->varyings)
        shade__divide(q->rw, q->f.varying[0], plan->varyings);
    if (plan->lod) shade__levels(q->f.lod);
    SHADE_EACH_LANE(i) { c.color[3][i] = 1; }
    if (!plan->own) {    /* shaders of this file set what is read of them: 2 % of a teapot */
        SHADE_EACH_LANE(i) { c.color[0][i] = c.color[1][i] = c.color[2][i] = 0; }
        SHADE_EACH_LANE(i) { c.discard[i] = 0; }
        if (!plan->lod) SHADE__ZERO(q->f.lod);
    }
    plan->pipe->fragment(plan->pipe->uniforms, &q->f, &c);
    plan->stage.store(d, &c);
    q->f.count = 0;
}
SHADE__DISPATCH_AVX2(shade__flush, (shade__draw *d), (d))

/*---------------------------------------------------------------------------------------- >>texture
   Texels filtered for blocks of lanes: places and weights of both axes, a pair of texels of each of
   two rows, then their blend, level by level.
     in      rows u, v, lod               out  rows of linear RGBA
     holds   Every index lies in the texture whatever u and v are.  Mipmaps are read level by level,
             each weighted by max(0, 1 - |lod - level|), as trilinear filtering is.    [Williams83]
                                                                                        >>store */

/* What is wrong with a texture, as a sentence; NULL: nothing. */
SHADE__INLINE const char *shade__texture_fault(const shade_texture *t)
{
    if (!t->pixels) return "The texture's pixels are NULL; point them at its texels.";
    if (t->width < 1 || t->height < 1 || t->width > 16384 || t->height > 16384)
        return "The texture's width and height must be from 1 to 16384 texels.";
    if (t->stride && t->stride < t->width)
        return "The texture's stride is less than its width; it counts texels, 0 means the width.";
    if ((unsigned)t->format > SHADE_FORMAT_A8)
        return "The texture's format is no SHADE_FORMAT_... value.";
    if ((unsigned)t->wrap_u > SHADE_WRAP_MIRROR || (unsigned)t->wrap_v > SHADE_WRAP_MIRROR)
        return "The texture's wrap_u or wrap_v is no SHADE_WRAP_... value.";
    if ((unsigned)t->filter > SHADE_FILTER_TRILINEAR)
        return "The texture's filter is no SHADE_FILTER_... value.";
    return NULL;
}
static int shade__texture_good(const shade_texture *t) { return t && !shade__texture_fault(t); }

/* Loops run over blocks, so that a single sample costs one of them. */
enum { SHADE__BLOCK = SHADE_LANES < 16 ? SHADE_LANES : 16 };
#define SHADE__EACH_BLOCK(i, blocks) \
    for (int i##_block = 0; i##_block < SHADE__BLOCK * (blocks); i##_block += SHADE__BLOCK) \
        SHADE__NO_UNROLL for (int i = i##_block; i < i##_block + SHADE__BLOCK; i++)

/* Lanes filtered at a time: 2.5 % slower than whole packets of 128, for 4.6 kB less of stack. */
enum { SHADE__TEXELS = SHADE_LANES < 64 ? SHADE_LANES : 64 };

/* One axis: texel before and after, and the weight of the one after. */
typedef struct shade__axis {
    SHADE_ALIGNED uint32_t i0[SHADE__TEXELS];
    uint32_t i1[SHADE__TEXELS];
    float f[SHADE__TEXELS];
} shade__axis;

/* c: coordinates, any bits   post: 0 <= i0, i1 < size */
SHADE__INLINE void shade__address(const float *SHADE_RESTRICT c, int blocks, int size,
                                  shade_wrap wrap, int nearest, shade__axis *SHADE_RESTRICT a)
{
    const int32_t last = size - 1;
    /* the texel beyond an end: the other end, or the same */
    const int32_t before = wrap == SHADE_WRAP_REPEAT ? last : 0;
    const int32_t after = wrap == SHADE_WRAP_REPEAT ? 0 : last;
    const float n = (float)size, half = nearest ? 0.0f : 0.5f;
    const float period = wrap == SHADE_WRAP_MIRROR ? 0.5f : 1.0f;
    if (wrap == SHADE_WRAP_CLAMP) {
        SHADE__EACH_BLOCK(i, blocks) {
            int32_t bits = (int32_t)(shade__float_bits(c[i]) & 0x7FFFFFFFu);
            float x = shade__keep(c[i], shade__mask(bits < 0x7F800000));
            a->f[i] = shade__clamp_bits(x, 0, 1);
        }
    } else {
        SHADE__EACH_BLOCK(i, blocks) {
            /* from 2^24 on all floats are even wholes, where a period begins; NaN and infinity join
               them */
            int32_t bits = (int32_t)(shade__float_bits(c[i]) & 0x7FFFFFFFu);
            uint32_t usable = shade__mask(bits < 0x4B800000);
            float x = shade__keep(c[i], usable) * period;
            float part = x - (float)(int32_t)x;
            a->f[i] = part + shade__keep(1, shade__mask(part < 0));
        }
    }
    if (wrap == SHADE_WRAP_MIRROR) {
        SHADE__EACH_BLOCK(i, blocks) {
            float twice = 2 * a->f[i];
            a->f[i] = shade__select(twice, 2 - twice, shade__mask(twice > 1));
        }
    }
    SHADE__EACH_BLOCK(i, blocks) {
        float inside = a->f[i];
        float s = inside * n - half;
        int32_t i0 = (int32_t)s - (s < 0 ? 1 : 0);    /* floor(s) for s >= -1/2 */
        i0 = shade__min(i0, last);    /* the end, 1, where nearest; any mode of rounding */
        a->f[i] = s - (float)i0;
        a->i0[i] = (uint32_t)(i0 < 0 ? before : i0);
        a->i1[i] = (uint32_t)(i0 < last ? i0 + 1 : after);
    }
}

/* Texels of a block to bytes along the row, rows to bytes or, with pitch 1, as they are.  Returns 0
   if every right texel is the one after its left one. */
SHADE__INLINE uint32_t shade__locate(uint32_t *SHADE_RESTRICT left, uint32_t *SHADE_RESTRICT right,
                                     uint32_t *SHADE_RESTRICT above, uint32_t *SHADE_RESTRICT below,
                                     int shift, uint32_t pitch)
{
    uint32_t apart = 0;
    SHADE__FOR(i, SHADE__BLOCK) {
        apart |= (right[i] - left[i]) ^ 1;
        left[i] <<= shift;
        right[i] <<= shift;
        above[i] *= pitch;
        below[i] *= pitch;
    }
    return apart;
}
/* The channels of packed texels, the lowest first: texel >> shift & mask, times step.  Three stay
   where they lie; their steps are those of the number over a power of two, the same products. */
typedef struct shade__layout {
    uint32_t mask[4];
    int      shift[4];
    float    step[4];
} shade__layout;

/* A texel of 32 bits or a word of a wider one; one of 16 bits, and alpha in bit 16; or one of 8
   bits on top, and white below. */
SHADE__INLINE uint32_t shade__texel(const uint8_t *p, const int bytes, const int swapped)
{
    uint32_t word;
    uint16_t t;
    if (bytes == 1) return (uint32_t)*p << 24 | 0xFFFFFF;
    if (bytes == 4) {
        SHADE_MEMCPY(&word, p, 4);
        return word;
    }
    SHADE_MEMCPY(&t, p, 2);
    return (swapped ? shade__swap16(t) : t) | 0x10000;
}
/* A block of pairs that may lie apart. */
SHADE__INLINE void shade__fetch_apart(const uint8_t *p, const int bytes, const int swapped,
                                      size_t unit, const shade__axis *x, const uint32_t *row,
                                      int first, shade__word *to)
{
    for (int i = first; i < first + SHADE__BLOCK; i++) {
        const uint8_t *line = p + row[i] * unit;
        to[2 * i] = shade__texel(line + x->i0[i], bytes, swapped);
        to[2 * i + 1] = shade__texel(line + x->i1[i], bytes, swapped);
    }
}
/* Texels of a row, left and right in turns, in one word each.  unit: bytes a step of row.  Out of
   line: gcc makes vectors of the loads otherwise, which takes longer. */
static SHADE__NOINLINE void shade__fetch_pairs(const uint8_t *p, shade_format format, size_t unit,
                                               const shade__axis *x, const uint32_t *row,
                                               const uint32_t *apart, int blocks, shade__word *to)
{
    const size_t bytes = shade__pixel_bytes(format);
    for (int k = 0; k < SHADE__BLOCK * blocks; k += SHADE__BLOCK) {
        if (!*apart++) {
            for (int i = k; i < k + SHADE__BLOCK; i++) {
                const uint8_t *left = p + (row[i] + x->i0[i]);
                SHADE_MEMCPY(to + 2 * i, left, 8);
            }
        } else if (bytes == 2)
            shade__fetch_apart(p, 2, format == SHADE_FORMAT_RGB565_SWAPPED, unit, x, row, k, to);
        else if (bytes == 1) shade__fetch_apart(p, 1, 0, unit, x, row, k, to);
        else shade__fetch_apart(p, 4, 0, unit, x, row, k, to);
    }
}
SHADE__INLINE float shade__scaled(uint32_t number, float scale)
{
    return (float)(int32_t)number * scale;
}
/* The bilinear blend of c[0] .. c[3]: left, right above, left, right below */
SHADE__INLINE float shade__bilinear(uint32_t c0, uint32_t c1, uint32_t c2, uint32_t c3,
                                    float scale, float x, float y)
{
    float left = shade__scaled(c0, scale), top = left + x * (shade__scaled(c1, scale) - left);
    float from = shade__scaled(c2, scale), low = from + x * (shade__scaled(c3, scale) - from);
    return top + y * (low - top);
}
/* All channels of packed texels, from the lowest up. */
SHADE__INLINE void shade__blend_packed(const uint32_t *texel, int blocks,
                                       const shade__layout *l, const shade__axis *axis,
                                       float *SHADE_RESTRICT r0, float *SHADE_RESTRICT r1,
                                       float *SHADE_RESTRICT r2, float *SHADE_RESTRICT r3)
{
    const uint32_t *second = texel + 2 * SHADE__TEXELS;
    const uint32_t m0 = l->mask[0], m1 = l->mask[1], m2 = l->mask[2];
    const int n = l->shift[3];
    const float s0 = l->step[0], s1 = l->step[1], s2 = l->step[2], s3 = l->step[3];
    SHADE__EACH_BLOCK(i, blocks) {
        const uint32_t a = texel[2 * i], b = texel[2 * i + 1];
        const uint32_t c = second[2 * i], d = second[2 * i + 1];
        const float x = axis[0].f[i], y = axis[1].f[i];
        r0[i] = shade__bilinear(a & m0, b & m0, c & m0, d & m0, s0, x, y);
        r1[i] = shade__bilinear(a & m1, b & m1, c & m1, d & m1, s1, x, y);
        r2[i] = shade__bilinear(a & m2, b & m2, c & m2, d & m2, s2, x, y);
        r3[i] = shade__bilinear(a >> n, b >> n, c >> n, d >> n, s3, x, y);
    }
}
/* One channel of packed texels as floats. */
SHADE__INLINE void shade__decode_texels(const uint32_t *texel, int blocks, int shift,
                                        uint32_t mask, float step, int decoded,
                                        float *SHADE_RESTRICT c)
{
    SHADE__EACH_BLOCK(i, blocks) { c[i] = shade__scaled(texel[i] >> shift & mask, step); }
    if (!decoded) return;
    SHADE__EACH_BLOCK(i, blocks) { c[i] = shade__srgb_decode(c[i]); }
}
/* The nearest ones; -0 is 0, as where it is blended. */
SHADE__INLINE void shade__pick_floats(const float *c, int blocks, float *SHADE_RESTRICT out)
{
    SHADE__EACH_BLOCK(i, blocks) { out[i] = c[2 * i] + 0; }
}
/* One channel of texels as floats, in the order of pairs.  What has no weight is not touched, so
   that an infinite texel stays where it is. */
SHADE__INLINE void shade__blend_floats(const float *c, int blocks, const shade__axis *axis,
                                       float *SHADE_RESTRICT out)
{
    const float *second = c + 2 * SHADE__TEXELS;
    SHADE__EACH_BLOCK(i, blocks) {
        float x = axis[0].f[i], y = axis[1].f[i], c0 = c[2 * i], c2 = second[2 * i];
        uint32_t right = shade__mask(x > 0), below = shade__mask(y > 0);
        float top = c0 + shade__keep(x * (c[2 * i + 1] - c0), right);
        float low = c2 + shade__keep(x * (second[2 * i + 1] - c2), right);
        out[i] = top + shade__keep(y * (low - top), below);
    }
}
/* out += weight c */
SHADE__INLINE void shade__add_level(const float *c, const float *weight, int blocks,
                                    float *SHADE_RESTRICT out)
{
    SHADE__EACH_BLOCK(i, blocks) {
        out[i] += shade__keep(weight[i] * c[i], shade__mask(weight[i] > 0));
    }
}
/* out (4 rows, stride apart) = one level at u, v; with weights, += weight times it.  How it wraps
   and filters comes from the base. */
SHADE__INLINE void shade__level_body(const shade_texture *base, const shade_texture *level,
                                     const float *u, const float *v, int blocks,
                                     const float *weight, float *out, int stride)
{
    enum { texels = SHADE__TEXELS };
    static const shade__layout layouts[2] = {
        { { 255, 255 << 8, 255 << 16, 255 }, { 0, 0, 0, 24 },
          { 1.0f / 255, 1.0f / 255 / 256, 1.0f / 255 / 65536, 1.0f / 255 } },
        { { 31, 63 << 5, 31 << 11, 1 }, { 0, 0, 0, 16 },
          { 1.0f / 31, 1.0f / 63 / 32, 1.0f / 31 / 2048, 1 } }
    };
    shade__axis axis[2];
    SHADE_ALIGNED uint32_t texel[4 * texels];
    SHADE_ALIGNED float value[4 * texels];
    SHADE_ALIGNED float blend[texels];
    uint32_t apart[(int)texels / (int)SHADE__BLOCK];
    const uint32_t *line[2];
    const shade_format format = level->format;
    const uint8_t *p = (const uint8_t *)level->pixels;
    const size_t bytes = shade__pixel_bytes(format);
    const size_t pitch = (size_t)(level->stride ? level->stride : level->width) * bytes;
    /* where 32 bits cannot count the bytes, rows are counted */
    const size_t unit = (uint64_t)pitch * (uint64_t)level->height > UINT32_MAX ? pitch : 1;
    const int half = bytes == 2, floats = bytes == 16;
    const int shift = bytes == 1 ? 0 : half ? 1 : floats ? 4 : 2;
    const int srgb = level->srgb && !floats && bytes > 1;
    const int nearest = base->filter == SHADE_FILTER_NEAREST, rows = nearest ? 1 : 2;
    const shade__layout *l = &layouts[half];
    /* channels from the lowest bits up: in bytes of a word, or blue first */
    const shade_format order = half ? SHADE_FORMAT_BGRA8 : format;
    const int flip = bytes != 4 ? 0 : shade__channel_shift(SHADE_FORMAT_RGBA8, 0) / 8;
    for (int k = 0; k < 2; k++)
        shade__address(k ? v : u, blocks, k ? level->height : level->width,
                       k ? base->wrap_v : base->wrap_u, nearest, &axis[k]);
    for (int b = 0; b < blocks; b++) {
        const int i = b * SHADE__BLOCK;
        apart[b] = shade__locate(axis[0].i0 + i, axis[0].i1 + i, axis[1].i0 + i, axis[1].i1 + i,
                                 shift, unit > 1 ? 1 : (uint32_t)pitch);
        if (bytes != 4 || unit > 1) apart[b] = 1;
    }
    line[0] = axis[1].i0;
    line[1] = axis[1].i1;
    for (int j = 0; j < rows && !floats; j++)
        shade__fetch_pairs(p, format, unit, axis, line[j], apart, blocks, texel + 2 * j * texels);
    if (!floats && !nearest && !srgb) {
        float *to = weight ? value : out;
        const int across = weight ? texels : stride;
        shade__blend_packed(texel, blocks, l, axis,
                            to + shade__channel_byte(order, 0 ^ flip) * across,
                            to + shade__channel_byte(order, 1 ^ flip) * across,
                            to + shade__channel_byte(order, 2 ^ flip) * across,
                            to + shade__channel_byte(order, 3 ^ flip) * across);
        for (int k = 0; weight && k < 4; k++)
            shade__add_level(value + k * texels, weight, blocks, out + k * stride);
        return;
    }
    for (int k = 0; k < 4; k++) {
        const int channel = shade__channel_byte(order, k ^ flip);
        float *row = weight ? blend : out + channel * stride;
        for (int j = 0; j < rows; j++) {
            float *to = value + 2 * j * texels;
            if (floats)
                shade__fetch_pairs(p + 4 * k, format, unit, axis, line[j], apart, blocks,
                                   shade__words(to));
            else
                shade__decode_texels(texel + 2 * j * texels, 2 * blocks, l->shift[k], l->mask[k],
                                     l->step[k], srgb && channel < 3, to);
        }
        if (nearest) shade__pick_floats(value, blocks, row);
        else shade__blend_floats(value, blocks, axis, row);
        if (weight) shade__add_level(row, weight, blocks, out + channel * stride);
    }
}
SHADE__DISPATCH(shade__level,
                (const shade_texture *base, const shade_texture *level, const float *u,
                 const float *v, int blocks, const float *weight, float *out, int stride),
                (base, level, u, v, blocks, weight, out, stride))

/* Blocks of lanes of a good texture; out: 4 rows, stride apart. */
static SHADE__NOINLINE void shade__sample(const shade_texture *t, const float *u, const float *v,
                                          const float *lod, int blocks, float *out, int stride)
{
    shade__level_fn *sample = shade__level_pick();
    const int levels = t->filter == SHADE_FILTER_TRILINEAR && t->mipmaps && t->mipmap_count > 0 &&
                       lod ? shade__min(t->mipmap_count, 16) : 0;
    int last;
    int32_t least = levels ? INT32_MAX : 0, most = 0;    /* bits of the levels of detail */
    SHADE_ALIGNED float level[SHADE__TEXELS];
    SHADE_ALIGNED float weight[SHADE__TEXELS];
    if (levels) {
        SHADE__EACH_BLOCK(i, blocks) {
            int32_t bits = (int32_t)(shade__float_bits(lod[i]) & 0x7FFFFFFFu);
            float finite = shade__keep(lod[i], shade__mask(bits < 0x7F800000));
            level[i] = shade__clamp_bits(finite, 0, (float)levels);
            bits = (int32_t)shade__float_bits(level[i]);
            least = shade__min(least, bits);
            most = shade__max(most, bits);
        }
        for (int k = 0; k < 4 * blocks; k++)
            SHADE_MEMSET(out + k % 4 * stride + k / 4 * SHADE__BLOCK, 0, 4 * SHADE__BLOCK);
    }
    last = shade__min((int)shade__bits_float((uint32_t)most) + 1, levels);
    for (int k = (int)shade__bits_float((uint32_t)least); k <= last; k++) {
        const shade_texture *source = k ? &t->mipmaps[k - 1] : t;
        uint32_t used = !levels;
        if (levels) {
            SHADE__EACH_BLOCK(i, blocks) {
                uint32_t away = shade__float_bits(level[i] - (float)k) & 0x7FFFFFFFu;
                weight[i] = shade__clamp_bits(1 - shade__bits_float(away), 0, 1);
                used |= shade__float_bits(weight[i]);
            }
        }
        if (k && !shade__texture_good(source)) source = t;
        if (used) sample(t, source, u, v, blocks, levels ? weight : NULL, out, stride);
    }
}
SHADEDEF void shade_sample_lanes(const shade_texture *texture, const float *u, const float *v,
                                 const float *lod, float *rgba)
{
    if (!u || !v || !rgba) return;
    if (!shade__texture_good(texture)) {
        for (int i = 0; i < 4 * SHADE_LANES; i++) rgba[i] = 1;
        return;
    }
    for (int i = 0; i < SHADE_LANES; i += SHADE__TEXELS)
        shade__sample(texture, u + i, v + i, lod ? lod + i : lod,
                      (int)SHADE__TEXELS / (int)SHADE__BLOCK, rgba + i, SHADE_LANES);
}
SHADEDEF shade_vec4 shade_sample(const shade_texture *texture, float u, float v, float lod)
{
    float us[SHADE__BLOCK], vs[SHADE__BLOCK], lods[SHADE__BLOCK], out[4 * SHADE__BLOCK];
    if (!shade__texture_good(texture)) return shade_v4(1, 1, 1, 1);
    for (int i = 0; i < SHADE__BLOCK; i++) {
        us[i] = u;
        vs[i] = v;
        lods[i] = lod;
    }
    shade__sample(texture, us, vs, lods, 1, out, SHADE__BLOCK);
    return shade_v4(out[0], out[SHADE__BLOCK], out[2 * SHADE__BLOCK], out[3 * SHADE__BLOCK]);
}

SHADEDEF int shade_mipmap_count(int width, int height)
{
    int n = 0;
    if (width < 1 || height < 1 || shade__max(width, height) > 16384) return 0;
    for (int size = shade__max(width, height); size > 1; size /= 2) n++;
    return n;
}
SHADEDEF size_t shade_mipmap_bytes(int width, int height, shade_format format)
{
    size_t bytes = 0;
    if ((unsigned)format > SHADE_FORMAT_A8) return 0;
    for (int k = shade_mipmap_count(width, height); k > 0; k--) {
        width = shade__max(width / 2, 1);
        height = shade__max(height / 2, 1);
        bytes += (size_t)width * (size_t)height * shade__pixel_bytes(format);
    }
    return bytes;
}
/*------------------------------------------------------------------------------------------ >>store
   Colours of a packet to the caller's memory: late depth test, blending, formats.
     in      rows of linear RGBA, the queue's pixels        out  depth (with may_discard), colour
     holds   Pixels are stored in drawing order.  8 bits: floor(255 clamp(c) + 1/2); NaN is 0.
                                                                                        >>check */

SHADE__INLINE void shade__encode_row(float *SHADE_RESTRICT c, int blocks)
{
    SHADE__EACH_BLOCK(i, blocks) { c[i] = shade__srgb_encode(shade__unit(c[i])); }
}
/* Thresholds of the 4 x 4 ordered dither at window positions x, y: the bits of x ^ y and y,
   interleaved and reversed   pre: 0 <= x, y < 2^31   post: in (0, 1) */
SHADE__INLINE void shade__dither(const float *SHADE_RESTRICT x, const float *SHADE_RESTRICT y,
                                 float *SHADE_RESTRICT threshold, int blocks)
{
    SHADE__EACH_BLOCK(i, blocks) {
        uint32_t v = (uint32_t)(int32_t)y[i], d = (uint32_t)(int32_t)x[i] ^ v;
        uint32_t rank = (d & 1) << 3 | (v & 1) << 2 | (d & 2) | (v & 2) >> 1;
        threshold[i] = ((float)(int32_t)rank + 0.5f) * 0.0625f;
    }
}
/* Pixels of 5-6-5 bits: clamp(c, 0, 1) in steps of 1 / full, up from the threshold on; or, where
   that is NULL, of 8 bits a channel to nearest.  Any bits of floats.   post: 5-6-5 below 2^16 */
SHADE__INLINE void shade__pack_channels(shade_format format, const float *SHADE_RESTRICT rgba,
                                        int stride, const float *SHADE_RESTRICT threshold,
                                        uint32_t *SHADE_RESTRICT packed, int blocks)
{
    const int wide = !threshold;
    const int r = wide ? shade__channel_shift(format, 0) : 11;
    const int g = wide ? shade__channel_shift(format, 1) : 5;
    const int b = wide ? shade__channel_shift(format, 2) : 0;
    const int a = wide ? shade__channel_shift(format, 3) : 0;
    const float full = wide ? 255 : 31, full_g = wide ? 255 : 63, full_a = wide ? 255 : 0;
    SHADE__EACH_BLOCK(i, blocks) {
        float half = threshold ? threshold[i] : 0.5f;
        int32_t cr = (int32_t)(shade__unit(rgba[i]) * full + half);
        int32_t cg = (int32_t)(shade__unit(rgba[i + stride]) * full_g + half);
        int32_t cb = (int32_t)(shade__unit(rgba[i + 2 * stride]) * full + half);
        int32_t ca = (int32_t)(shade__unit(rgba[i + 3 * stride]) * full_a + half);
        packed[i] = (uint32_t)cr << r | (uint32_t)cg << g | (uint32_t)cb << b | (uint32_t)ca << a;
    }
}
/* Blocks of lanes for the target's format; encodes rgb in place where it asks for sRGB.  x, y are
   read where it asks for dither. */
SHADE__INLINE void shade__pack_body(const shade_target *t, float *rgba, int stride, const float *x,
                                    const float *y, uint32_t *packed, int blocks)
{
    SHADE_ALIGNED float threshold[SHADE_LANES];
    if (t->format == SHADE_FORMAT_RGBA32F) return;
    for (int k = 0; k < 3 && t->srgb; k++) shade__encode_row(rgba + k * stride, blocks);
    if (shade__pixel_bytes(t->format) != 2) {
        shade__pack_channels(t->format, rgba, stride, NULL, packed, blocks);
        return;
    }
    SHADE_EACH_LANE(i) { threshold[i] = 0.5f; }
    if (t->dither) shade__dither(x, y, threshold, blocks);
    shade__pack_channels(t->format, rgba, stride, threshold, packed, blocks);
    if (t->format == SHADE_FORMAT_RGB565_SWAPPED) {
        SHADE__EACH_BLOCK(i, blocks) { packed[i] = shade__swap16(packed[i]); }
    }
}
SHADE__DISPATCH(shade__pack,
                (const shade_target *t, float *rgba, int stride, const float *x, const float *y,
                 uint32_t *packed, int blocks),
                (t, rgba, stride, x, y, packed, blocks))

/* Rows of n pixels as they are stored; those of RGBA32F are there already. */
SHADE__INLINE void shade__unpack(shade_format format, const uint32_t *SHADE_RESTRICT packed,
                                 const int n, float *SHADE_RESTRICT rgba)
{
    if (format == SHADE_FORMAT_RGBA32F) return;
    for (int k = 0; k < 4; k++) {
        const int shift = shade__channel_shift(format, k);
        const uint32_t full = shade__channel_full(format, k);
        float *c = rgba + k * n;
        SHADE__FOR(i, n) {
            c[i] = (float)(int32_t)(packed[i] >> shift & full) / (float)(int32_t)full;
        }
    }
}
SHADE__INLINE void shade__decode_row(float *SHADE_RESTRICT c)
{
    SHADE__FOR(i, SHADE__BLOCK) { c[i] = shade__srgb_decode(c[i]); }
}
/* Rows of a block in linear light from its packed pixels. */
SHADE__INLINE void shade__linear_body(const shade_target *t, const uint32_t *packed, float *rgba)
{
    shade__unpack(t->format, packed, SHADE__BLOCK, rgba);
    for (int k = 0; k < 3 && shade__is_encoded(t); k++) shade__decode_row(rgba + k * SHADE__BLOCK);
}
SHADE__DISPATCH_AVX2(shade__linear, (const shade_target *t, const uint32_t *packed, float *rgba),
                     (t, packed, rgba))

/* Packs a block of pixels and stores the first n of them at p; x, y of the first are read where the
   target dithers. */
static void shade__store_block(const shade_target *t, float *rgba, int x, int y, int n, uint8_t *p)
{
    float px[SHADE__BLOCK], py[SHADE__BLOCK];
    uint32_t packed[SHADE__BLOCK] = { 0 };
    for (int i = 0; i < SHADE__BLOCK; i++) {
        px[i] = (float)(x + i) + 0.5f;
        py[i] = (float)y + 0.5f;
    }
    shade__pack_pick()(t, rgba, SHADE__BLOCK, px, py, packed, 1);
    for (int i = 0; i < n; i++, p += shade__pixel_bytes(t->format))
        shade__store_pixel(t->format, p, packed[i], rgba + i, SHADE__BLOCK);
}

/* Depth test and write in drawing order, after a shader that may discard.  Turns the discard row
   into marks of the lanes that stay. */
static void shade__late_depth(shade__draw *d, uint32_t *discard)
{
    const shade__plan *plan = &d->plan;
    const shade__queue *q = &d->u.queue;
    for (int i = 0; i < q->f.count; i++) {
        int alive = discard[i] == 0;
        if (alive && plan->depth) {
            float *p = plan->depth + q->offset[i], z = q->f.z[i];
            alive = shade__passes(plan->compare, 0, z, *p) != 0;
            if (alive && plan->compare.write) *p = z;
        }
        discard[i] = (uint32_t)alive;
        d->stats.fragments += alive;
    }
}

/* Stores lanes first .. last - 1 that are alive (NULL: all); lane i stands at i - base of packed
   and of the rows of rgba. */
SHADE__INLINE void shade__scatter(const shade__draw *d, const uint32_t *alive, const float *rgba,
                                  int stride, const uint32_t *packed, int base, int first, int last)
{
    const uint32_t *offset = d->u.queue.offset;
    for (int i = first; i < last; i++) {
        uint8_t *p = d->plan.color + (size_t)offset[i] * d->plan.pixel_bytes;
        if (!alive || alive[i])
            shade__store_pixel(d->plan.target->format, p, packed[i - base],
                               rgba + i - base, stride);
    }
}
/* The whole packet in pixels of 4 bytes: neighbours that lie side by side together. */
SHADE__INLINE void shade__scatter_words(uint8_t *SHADE_RESTRICT color,
                                        const uint32_t *SHADE_RESTRICT offset,
                                        const uint32_t *SHADE_RESTRICT packed, int count)
{
    int i = 0;
    for (; i + SHADE__NARROW <= count; i += SHADE__NARROW) {
        const uint32_t first = offset[i];
        uint32_t apart = 0;
        SHADE__FOR(k, SHADE__NARROW) { apart |= offset[i + k] - (first + (uint32_t)k); }
        if (!apart) {
            SHADE_MEMCPY(color + (size_t)first * 4, packed + i, SHADE__NARROW * 4);
            continue;
        }
        for (int k = i; k < i + SHADE__NARROW; k++)
            SHADE_MEMCPY(color + (size_t)offset[k] * 4, packed + k, 4);
    }
    for (; i < count; i++) SHADE_MEMCPY(color + (size_t)offset[i] * 4, packed + i, 4);
}

/* out = rgba blended with what is stored, a block of lanes */
SHADE__INLINE void shade__blend(shade_blend blend, const float *SHADE_RESTRICT rgba,
                                const float *SHADE_RESTRICT stored, float *SHADE_RESTRICT out)
{
    enum { size = SHADE__BLOCK };
    uint32_t over = shade__mask(blend == SHADE_BLEND_OVER);
    SHADE__FOR(i, size) {
        float a = rgba[i + 3 * SHADE_LANES], s = shade__select(1, a, over);
        float t = shade__select(1, 1 - a, over);
        out[i] = rgba[i] * s + stored[i] * t;
        out[i + size] = rgba[i + SHADE_LANES] * s + stored[i + size] * t;
        out[i + 2 * size] = rgba[i + 2 * SHADE_LANES] * s + stored[i + 2 * size] * t;
        out[i + 3 * size] = a + stored[i + 3 * size] * t;
    }
}
/* Blends and stores in pieces of up to a block, in drawing order.  The lanes of a piece belong to
   one triangle, so that no pixel comes twice in it. */
static SHADE__NOINLINE void shade__store_blended(const shade__draw *d, const float *rgba,
                                                 const uint32_t *alive)
{
    enum { size = SHADE__BLOCK };
    const shade__plan *plan = &d->plan;
    const shade__queue *q = &d->u.queue;
    shade__linear_fn *linear = shade__linear_pick();
    for (int i = 0, last; i < q->f.count; i = last) {
        int base = shade__min(i, SHADE_LANES - size);
        float stored[4 * size] = { 0 }, out[4 * size];
        uint32_t packed[size] = { 0 };
        for (last = i; last < base + size && last < q->f.count; last++) {
            if (q->f.primitive[last] != q->f.primitive[i]) break;
            shade__load_pixel(plan->target->format,
                              plan->color + (size_t)q->offset[last] * plan->pixel_bytes,
                              packed + (last - base), stored + (last - base), size);
        }
        linear(plan->target, packed, stored);
        shade__blend(plan->pipe->raster.blend, rgba + base, stored, out);
        plan->stage.pack(plan->target, out, size, q->f.x + base, q->f.y + base, packed, 1);
        shade__scatter(d, alive, out, size, packed, base, i, last);
    }
}

/* Stores the colours of the queue's packet. */
SHADE__INLINE void shade__store_body(shade__draw *d, shade_colors *c)
{
    const shade__plan *plan = &d->plan;
    shade__queue *q = &d->u.queue;
    const uint32_t *alive = plan->pipe->may_discard ? c->discard : NULL;
    SHADE_ALIGNED uint32_t packed[SHADE_LANES];
    if (alive) shade__late_depth(d, c->discard);
    if (!plan->color) return;
    if (plan->pipe->raster.blend != SHADE_BLEND_REPLACE) {
        shade__store_blended(d, c->color[0], alive);
        return;
    }
    plan->stage.pack(plan->target, c->color[0], SHADE_LANES, q->f.x, q->f.y, packed,
                     (int)SHADE_LANES / (int)SHADE__BLOCK);
    if (plan->pixel_bytes == 4 && !alive)
        shade__scatter_words(plan->color, q->offset, packed, q->f.count);
    else shade__scatter(d, alive, c->color[0], SHADE_LANES, packed, 0, 0, q->f.count);
}
SHADE__DISPATCH_AVX2(shade__store, (shade__draw *d, shade_colors *c), (d, c))

/*------------------------------------------------------------------------------------------ >>check
   Whether arguments can be used.  A fault is a sentence that names the field, for shade_explain;
   where only its being there matters, the function is inlined and the sentence left out.
     in      targets, meshes, states, indices
     out     NULL, or the fault; a shade_result                                          >>drive */

SHADE__INLINE const char *shade__target_fault(const shade_target *t)
{
    const uint64_t pixels = (uint64_t)shade__rows_held(t) * (uint64_t)shade__stride_of(t);
    if (!t->color && !t->depth)
        return "target.color and target.depth are both NULL; point one of them at your memory.";
    if (t->width < 1 || t->width > 16384 || t->height < 1 || t->height > 16384)
        return "target.width and target.height must be from 1 to 16384 pixels.";
    if (t->stride && t->stride < t->width)
        return "target.stride is less than target.width; it counts pixels, and 0 means the width.";
    if ((unsigned)t->format > SHADE_FORMAT_RGBA32F)
        return "target.format is unknown, or SHADE_FORMAT_A8, which only textures can have.";
    if (t->clip_width < 0 || t->clip_height < 0)
        return "target.clip_width or target.clip_height is negative; all four clip fields zero "
               "mean the whole picture.";
    if (t->row_count < 0 || t->row_offset < 0 || (t->row_offset && !t->row_count) ||
        (t->row_count && t->row_offset > t->height - t->row_count))
        return "target.row_offset and target.row_count reach beyond target.height or are negative, "
               "or row_count is 0 for a strip.";
    if (pixels > 0xFFFFFFFFu || pixels > SIZE_MAX / 16)
        return "target.stride times the number of rows exceeds 2^32 - 1 pixels.";
    return NULL;
}
static shade_result shade__check_target(const shade_target *t)
{
    return shade__target_fault(t) ? SHADE_ERROR_TARGET : SHADE_OK;
}

static int shade__corner_count(const shade_mesh *m)
{
    return m->indices ? m->index_count : m->vertex_count;
}
SHADE__INLINE int shade__chunk_outside(const shade_chunk *c, int triangles)
{
    return c->first < 0 || c->count < 0 || c->first > triangles - c->count;
}
/* What is wrong with the arrays of a mesh, its chunks apart. */
SHADE__INLINE const char *shade__mesh_fault(const shade_mesh *m)
{
    const int strides = m->position_stride | m->normal_stride | m->texcoord_stride |
                        m->color_stride;
    if (m->vertex_count < 0) return "mesh.vertex_count is negative; it counts vertices.";
    if (!m->positions && m->vertex_count)
        return "mesh.positions is NULL while mesh.vertex_count is not 0.";
    if (m->indices && m->index_count < 0)
        return "mesh.index_count is negative; it counts indices, three a triangle.";
    if (strides < 0 || strides % 4)
        return "mesh.position_stride, normal_stride, texcoord_stride or color_stride is negative "
               "or no multiple of 4; strides count bytes, not floats, and 0 means tightly packed.";
    return NULL;
}
SHADE__INLINE const char *shade__chunks_fault(const shade_mesh *m)
{
    if (m->chunk_count < 0) return "mesh.chunk_count is negative; it counts mesh.chunks.";
    if (!m->chunks)
        return m->chunk_count ? "mesh.chunks is NULL while mesh.chunk_count is not 0." : NULL;
    for (int i = 0; i < m->chunk_count; i++)
        if (shade__chunk_outside(&m->chunks[i], shade__corner_count(m) / 3))
            return "A chunk of mesh.chunks reaches beyond the triangles of the mesh, or its first "
                   "or count is negative; they count triangles, not indices.";
    return NULL;
}
static shade_result shade__check_mesh(const shade_mesh *m)
{
    return shade__mesh_fault(m) || shade__chunks_fault(m) ? SHADE_ERROR_MESH : SHADE_OK;
}

SHADE__INLINE const char *shade__raster_fault(const shade_raster *r)
{
    if ((unsigned)r->cull > SHADE_CULL_FRONT) return "raster.cull is no SHADE_CULL_... value.";
    if ((unsigned)r->depth_test > SHADE_COMPARE_ALWAYS)
        return "raster.depth_test is no SHADE_COMPARE_... value.";
    if ((unsigned)r->blend > SHADE_BLEND_ADD) return "raster.blend is no SHADE_BLEND_... value.";
    if (!shade__within(r->depth_bias, FLT_MAX))
        return "raster.depth_bias is NaN or infinite; 0 means none.";
    return NULL;
}
/* How many varyings the shaders of meshes take. */
static int shade__mesh_varyings(const shade_mesh *m, const shade_draw_state *state)
{
    const int map = state->diffuse_map && m->texcoords;
    if (state->fragment) return 11;
    if (state->shading != SHADE_SHADING_PER_FRAGMENT) return map ? 8 : 3;
    return (m->colors ? 9 : 6) + (map ? 2 : 0);
}
SHADE__INLINE const char *shade__state_fault(const shade_mesh *m, const shade_draw_state *state)
{
    if ((unsigned)state->shading > SHADE_SHADING_PER_FACE)
        return "state.shading is no SHADE_SHADING_... value.";
    if (!(state->transparency >= 0 && state->transparency <= 1))
        return "state.transparency must be from 0 (opaque) to 1 (invisible).";
    if (!(state->alpha_cutoff >= 0 && state->alpha_cutoff <= 1))
        return "state.alpha_cutoff must be from 0 (nothing is cut) to 1.";
    if (state->fragment && state->shading != SHADE_SHADING_PER_FRAGMENT)
        return "state.fragment needs state.shading to be SHADE_SHADING_PER_FRAGMENT.";
    if (shade__mesh_varyings(m, state) > SHADE_MAX_VARYINGS)
        return "SHADE_MAX_VARYINGS is too small for this draw, which needs 6 varyings, 9 with "
               "mesh.colors, 2 more with state.diffuse_map, or 11 with state.fragment.";
    return shade__raster_fault(&state->raster);
}
SHADE__INLINE const char *shade__lights_fault(const shade_lighting *l)
{
    if (!l->lights && l->light_count > 0)
        return "lighting.lights is NULL while lighting.light_count is not 0.";
    if ((unsigned)l->model > SHADE_MODEL_COOL_TO_WARM)
        return "lighting.model is no SHADE_MODEL_... value.";
    return NULL;
}
static SHADE__COLD shade_result shade__check_pipeline(const shade_pipeline *p)
{
    if ((unsigned)p->interpolation > SHADE_INTERPOLATION_CONSTANT || p->varyings < 0 ||
        p->varyings > SHADE_MAX_VARYINGS || shade__raster_fault(&p->raster))
        return SHADE_ERROR_STATE;
    if (p->lod_texture && (!shade__texture_good(p->lod_texture) || p->lod_varying < 0 ||
                           p->lod_varying >= p->varyings - 1))
        return SHADE_ERROR_TEXTURE;
    return SHADE_OK;
}

/* The highest of n lists of 16 indices. */
SHADE__INLINE void shade__highest_body(const uint32_t *SHADE_RESTRICT indices, ptrdiff_t n,
                                       uint32_t *SHADE_RESTRICT highest)
{
    for (; n > 0; n--, indices += 16) {
        SHADE__FOR(i, 16) { highest[i] = indices[i] > highest[i] ? indices[i] : highest[i]; }
    }
}
SHADE__DISPATCH(shade__highest, (const uint32_t *indices, ptrdiff_t n, uint32_t *highest),
                (indices, n, highest))
/* In lanes, because each band of a picture looks at all of them. */
static SHADE__NOINLINE shade_result shade__check_indices(const uint32_t *indices, int index_count,
                                                         int vertex_count)
{
    uint32_t highest[16] = { 0 };
    int i = 0;
    if (index_count % 3 || (!indices && index_count > vertex_count)) return SHADE_ERROR_INDEX;
    if (!indices || !index_count) return SHADE_OK;
    if (SHADE__TWICE) {
        i = index_count & ~15;
        shade__highest_pick()(indices, i / 16, highest);
        for (int k = 1; k < 16; k++)
            if (highest[k] > highest[0]) highest[0] = highest[k];
    }
    for (; i < index_count; i++)
        if (indices[i] > highest[0]) highest[0] = indices[i];
    return highest[0] < (uint32_t)vertex_count ? SHADE_OK : SHADE_ERROR_INDEX;
}

/*------------------------------------------------------------------------------------------ >>drive
   The public calls: arguments checked before any pixel changes, then batch after batch. >>mesh */

/* The same for a target whose colours are asked for. */
static shade_result shade__check_picture(const shade_target *t)
{
    if (!t) return SHADE_ERROR_ARGUMENT;
    return t->color ? shade__check_target(t) : SHADE_ERROR_TARGET;
}
/* Clip rectangle, cut to the picture and the strip: x0, y0, x1, y1, the ends exclusive. 0 if
   empty. */
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
/* Plane i: sign (row - limit w) of clip space, where row 0 is x, 1 y, 2 z. */
static void shade__frustum_plane(const shade_mat4 *m, int row, double sign, double limit, int i,
                                 shade__frustum *f)
{
    for (int k = 0; k < 4; k++) {
        const double a = (double)((const float *)&m->col[k])[row], w = (double)m->col[k].w;
        f->k[k][i] = sign * (a - limit * w);
        f->size[k][i] = shade__size(a) + shade__size(limit * w) + (double)FLT_MIN;
    }
}
/* The planes of the clip rectangle, near and far.  The rectangle is that of whole pixels, half a
   pixel around their centres: more than snapping and clipping move an edge. */
static SHADE__COLD void shade__frustum_of(const shade_target *t, const shade_mat4 *clip_from_object,
                                       int zero_to_one, shade__frustum *f)
{
    const double w = t->width, h = t->height;
    int r[4];
    (void)shade__clip_rectangle(t, r);    /* of an empty one nothing is seen, whatever its planes */
    shade__frustum_plane(clip_from_object, 0, 1, 2.0 * r[0] / w - 1, 0, f);
    shade__frustum_plane(clip_from_object, 0, -1, 2.0 * r[2] / w - 1, 1, f);
    shade__frustum_plane(clip_from_object, 1, -1, 1 - 2.0 * r[1] / h, 2, f);
    shade__frustum_plane(clip_from_object, 1, 1, 1 - 2.0 * r[3] / h, 3, f);
    shade__frustum_plane(clip_from_object, 2, 1, zero_to_one ? 0 : -1, 4, f);
    for (int i = 5; i < SHADE__PLANES; i++) shade__frustum_plane(clip_from_object, 2, -1, 1, i, f);
    if (!shade__is_finite(clip_from_object)) SHADE__ZERO(*f);    /* outside of none */
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

static shade__compare shade__compare_of(const shade_raster *r)
{
    /* of LESS, LESS_EQUAL, ...: 1 where less passes, 2 equal, 4 greater */
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
static SHADE__COLD void shade__make_plan(const shade_target *t, const shade_pipeline *p, int own,
                                         shade__plan *plan)
{
    const int perspective = p->interpolation == SHADE_INTERPOLATION_PERSPECTIVE;
    const int early = t->depth && !p->may_discard, kept = early && !p->raster.depth_read_only;
    int clip[4];
    if (!shade__clip_rectangle(t, clip)) SHADE__ZERO(clip);
    plan->target = t;
    plan->pipe = p;
    plan->stage.place = shade__place_pick();
    plan->stage.setup = shade__setup_pick();
    plan->stage.clip = shade__clip_triangle;
    plan->stage.cover = shade__cover_pick();
    plan->stage.spans = shade__spans_pick();
    plan->stage.push = shade__push_pick();
    plan->stage.flush = shade__flush_pick();
    plan->stage.store = shade__store_pick();
    plan->stage.pack = shade__pack_pick();
    plan->color = p->fragment ? (uint8_t *)t->color : NULL;
    plan->depth = t->depth;
    plan->pixel_bytes = shade__pixel_bytes(t->format);
    plan->stride = shade__stride_of(t);
    plan->row_offset = t->row_offset;
    plan->x0 = clip[0];
    plan->y0 = clip[1];
    plan->x1 = clip[2];
    plan->y1 = clip[3];
    plan->varyings = p->varyings;
    plan->values = SHADE__FIRST + p->varyings;
    plan->divided = perspective ? SHADE__FIRST : plan->values;
    plan->lod = p->lod_texture ? plan->divided + (perspective ? p->lod_varying : 0) : 0;
    if (p->lod_texture && !perspective) plan->values += 2;
    plan->value_stride = (plan->values + 7) / 8 * 8;
    plan->zero_to_one = p->raster.depth_zero_to_one != 0;
    plan->compare = shade__compare_of(&p->raster);
    plan->early = early;
    plan->queued = p->fragment && (plan->color || p->may_discard);
    plan->plain = kept && p->raster.depth_test == SHADE_COMPARE_LESS;
    /* blending tells triangles apart, dither asks for x and y */
    plan->own = own;
    plan->bare = own && early && p->raster.blend == SHADE_BLEND_REPLACE && !t->dither;
    plan->toward = kept ? (float)((plan->compare.less != 0) - (plan->compare.greater != 0)) : 0;
    plan->half_width = (float)(t->width * 128);
    plan->half_height = (float)(t->height * 128);
}

/* The draw to a target that has been checked.  pipe: a copy, which it changes.  how: SHADE__OWN
   where the shaders are of this file, SHADE__CORNERS where each index is a vertex of its own. */
enum { SHADE__OWN = 1, SHADE__CORNERS = 2 };
static shade_result shade__run_draw(const shade_target *target, shade_pipeline *pipe, int how,
                                    shade__supply *supply, shade_stats *stats)
{
    shade__draw d;
    if (how & SHADE__CORNERS) supply->indices = NULL;
    if (!pipe->fragment) pipe->may_discard = 0;
    if (!pipe->fragment || (!target->color && !pipe->may_discard)) {    /* nobody reads them */
        pipe->varyings = 0;
        pipe->lod_texture = NULL;
    }
    shade__make_plan(target, pipe, how & SHADE__OWN, &d.plan);
    SHADE__ZERO(d.stats);
    SHADE__ZERO(d.batch.value);
    SHADE__ZERO(d.packet);
    SHADE__ZERO(d.u.in.ids);
    SHADE__ZERO(d.u.in.slot_of);
    d.hidden.across = 0;
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
/* All triangles of a list that is good, one after the other. */
static shade_result shade__supply_all(const uint32_t *indices, int index_count, int vertex_count,
                                      shade__supply *s)
{
    s->indices = indices;
    s->first = 0;
    s->end = index_count / 3;
    s->more = NULL;
    return shade__check_indices(indices, index_count, vertex_count);
}
/* How every call begins that draws: its arguments given, the target good. */
static shade_result shade__begin(const shade_target *t, int given, shade_stats *stats)
{
    if (stats) SHADE__ZERO(*stats);
    return t && given ? shade__check_target(t) : SHADE_ERROR_ARGUMENT;
}
SHADEDEF shade_result shade_draw(const shade_target *target, const shade_pipeline *pipeline,
                                 const uint32_t *indices, int index_count, int vertex_count,
                                 shade_stats *stats)
{
    shade__supply supply;
    shade_pipeline pipe;
    shade_result result = shade__begin(target, pipeline && pipeline->vertex, stats);
    if (!result && (index_count < 0 || vertex_count < 0)) result = SHADE_ERROR_MESH;
    if (!result) result = shade__check_pipeline(pipeline);
    if (!result) result = shade__supply_all(indices, index_count, vertex_count, &supply);
    if (result) return result;
    pipe = *pipeline;
    return shade__run_draw(target, &pipe, 0, &supply, stats);
}

/* Fills n bytes with a pattern of 256, whole vectors at a time. */
static void shade__fill(uint8_t *SHADE_RESTRICT p, const float *SHADE_RESTRICT pattern, size_t n)
{
    for (; n >= 256; n -= 256, p += 256) SHADE_MEMCPY(p, pattern, 256);
    SHADE_MEMCPY(p, pattern, n);
}

/* 256 bytes of a colour at (x, y): the period of the dither divides 8 pixels. */
static void shade__clear_pattern(const shade_target *t, shade_vec4 color, int x, int y,
                                 uint8_t *pattern)
{
    const size_t period = 8 * shade__pixel_bytes(t->format);
    float rgba[4 * SHADE__BLOCK];
    for (int i = 0; i < SHADE__BLOCK; i++) shade__put4(rgba, SHADE__BLOCK, i, color);
    shade__store_block(t, rgba, x, y, 8, pattern);
    for (size_t i = period; i < 256; i++) pattern[i] = pattern[i - period];
}
SHADEDEF shade_result shade_clear(const shade_target *target, shade_vec4 color, float depth)
{
    shade_result result = shade__begin(target, 1, NULL);
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

/* Pixels x .. x + n - 1 of row y, at most a block: means of factor x factor pixels each. */
static void shade__resolve_block(const shade_target *out, const shade_target *in, int factor,
                                 int x, int y, int n, uint8_t *to)
{
    enum { size = SHADE__BLOCK };
    shade__linear_fn *linear = shade__linear_pick();
    float rgba[4 * size] = { 0 }, c[4 * size] = { 0 };
    uint32_t packed[size] = { 0 };
    for (int i = 0; i < factor * factor; i++) {
        for (int p = 0; p < n; p++)
            shade__load_pixel(in->format, shade__pixel_at(in, (x + p) * factor + i % factor,
                                                          y * factor + i / factor),
                              packed + p, c + p, size);
        linear(in, packed, c);
        for (int k = 0; k < 4 * size; k++) rgba[k] += c[k];
    }
    for (int k = 0; k < 4 * size; k++) rgba[k] /= (float)(factor * factor);
    shade__store_block(out, rgba, x, y, n, to);
}
SHADEDEF shade_result shade_resolve(const shade_target *out, const shade_target *in, int factor)
{
    shade_result result;
    int clip[4];
    if (!out || !in) return SHADE_ERROR_ARGUMENT;
    result = shade__check_picture(out);
    if (!result) result = shade__check_picture(in);
    if (result) return result;
    if (factor < 1 || factor > 8 || in->width != out->width * factor ||
        in->height != out->height * factor || in->row_offset != out->row_offset * factor ||
        shade__rows_held(in) != shade__rows_held(out) * factor)
        return SHADE_ERROR_ARGUMENT;
    shade__clip_rectangle(out, clip);
    for (int y = clip[1]; y < clip[3]; y++)
        for (int x = clip[0]; x < clip[2]; x += SHADE__BLOCK)
            shade__resolve_block(out, in, factor, x, y, shade__min(SHADE__BLOCK, clip[2] - x),
                                 shade__pixel_at(out, x, y));
    return SHADE_OK;
}

/* How much of first .. first + 1 lies in from .. to. */
static double shade__overlap(int first, double from, double to)
{
    return (first + 1 < to ? first + 1 : to) - (first > from ? first : from);
}
/* The mean of the part of a picture that texel (x, y) of a smaller one covers, in linear light. */
static void shade__shrink(const shade_target *from, const shade_target *to, int x, int y,
                          float *mean)
{
    const int encoded = shade__is_encoded(from);
    double sum[4] = { 0, 0, 0, 0 }, all = 0;
    const double sx = (double)from->width / to->width, sy = (double)from->height / to->height;
    for (int j = (int)(y * sy); j < from->height && j < (y + 1) * sy; j++)
        for (int i = (int)(x * sx); i < from->width && i < (x + 1) * sx; i++) {
            double share = shade__overlap(i, x * sx, (x + 1) * sx);
            float c[4];
            uint32_t packed = 0;
            share *= shade__overlap(j, y * sy, (y + 1) * sy);
            shade__load_pixel(from->format, shade__pixel_at(from, i, j), &packed, c, 1);
            shade__unpack(from->format, &packed, 1, c);
            for (int k = 0; k < 4; k++) {
                if (encoded && k < 3) c[k] = shade__decode(c[k]);
                sum[k] += (double)c[k] * share;
            }
            all += share;
        }
    for (int k = 0; k < 4; k++) mean[SHADE__BLOCK * k] = (float)(sum[k] / all);
}
SHADEDEF shade_result shade_build_mipmaps(shade_texture *texture, shade_texture *levels,
                                          void *memory, size_t bytes)
{
    shade_target from, to;
    const int count = texture ? shade_mipmap_count(texture->width, texture->height) : 0;
    if (!texture || (count && (!levels || !memory || (uintptr_t)memory % 4)))
        return SHADE_ERROR_ARGUMENT;
    if (!shade__texture_good(texture)) return SHADE_ERROR_TEXTURE;
    if (bytes < shade_mipmap_bytes(texture->width, texture->height, texture->format))
        return SHADE_ERROR_CAPACITY;
    SHADE__ZERO(from);
    from.width = texture->width;
    from.height = texture->height;
    from.stride = texture->stride;
    from.format = texture->format;
    from.srgb = texture->srgb;
    from.color = (void *)(uintptr_t)texture->pixels;
    for (int n = 0; n < count; n++, from = to) {
        to = from;
        to.width = shade__max(from.width / 2, 1);
        to.height = shade__max(from.height / 2, 1);
        to.stride = 0;
        to.color = memory;
        for (int y = 0; y < to.height; y++)
            for (int x = 0; x < to.width; x += SHADE__BLOCK) {
                const int texels = shade__min(SHADE__BLOCK, to.width - x);
                float rgba[4 * SHADE__BLOCK] = { 0 };
                for (int i = 0; i < texels; i++) shade__shrink(&from, &to, x + i, y, rgba + i);
                shade__store_block(&to, rgba, x, y, texels, shade__pixel_at(&to, x, y));
            }
        memory = shade__pixel_at(&to, 0, to.height);
        levels[n] = *texture;
        levels[n].pixels = to.color;
        levels[n].width = to.width;
        levels[n].height = to.height;
        levels[n].stride = 0;
        levels[n].mipmaps = NULL;
        levels[n].mipmap_count = 0;
    }
    texture->mipmaps = levels;
    texture->mipmap_count = count;
    return SHADE_OK;
}

/*------------------------------------------------------------------------------------------- >>mesh
   The fixed pipeline: a mesh drawn by two ordinary shaders of the programmable one.
     in      object-space arrays       out  varyings in world space: P, N, albedo; or one lit colour
     holds   Where each face has values of its own (flat, or no normals), every corner is a vertex:
             its index is 3 times the triangle's plus the corner, and the shader looks up the
             mesh's.                                                                    >>lines */

typedef struct shade__scene {            /* uniforms of the mesh shaders */
    const shade_mesh *mesh;
    const shade_draw_state *state;
    shade_mat4 clip_from_object, world_from_object;
    shade_mat3 normal_matrix;
    shade_vec3 eye;
    int face_normals;                    /* then every corner is a vertex of its own */
    const shade_texture *map;            /* NULL: none */
    int uv;                              /* the varying that is u, v behind it, if any is */
    int colored;                         /* the target has a picture */
    shade_lighting lighting;             /* at vertices of a mapped mesh without what follows */
    unsigned unmapped;                   /* terms that the map does not multiply */
    shade__job job;                      /* of lighting */
} shade__scene;

enum {
    SHADE__TERM_NONE = 128,    /* no term at all, since 0 means all */
    /* vectors that lit vertices keep on the stack; with 15 varyings they lie in rows of the output
       that nobody reads, 4 kB less */
    SHADE__APART = SHADE_MAX_VARYINGS < 15 ? 3 : 1
};

/* Element i of an array of vectors with a stride in bytes, 0 = tight. */
SHADE__INLINE shade_vec3 shade__vec3_at(const float *array, int stride, uint32_t i)
{
    float v[3];
    SHADE_MEMCPY(v, (const char *)array + (size_t)i * (size_t)(stride ? stride : 12), 12);
    return shade_v3(v[0], v[1], v[2]);
}
SHADE__INLINE uint32_t shade__corner_index(const shade_mesh *m, uint32_t corner)
{
    return m->indices ? m->indices[corner] : corner;
}
/* Position of corner 0, 1, ... of the triangles. */
SHADE__INLINE shade_vec3 shade__corner(const shade_mesh *m, uint32_t corner)
{
    return shade__vec3_at(m->positions, m->position_stride, shade__corner_index(m, corner));
}
/* The corners of a triangle, and shade_face_normal of them. */
static SHADE__NOINLINE shade_vec3 shade__face_normal(const shade_mesh *m, uint32_t triangle,
                                                     shade_vec3 *p)
{
    for (uint32_t k = 0; k < 3; k++) p[k] = shade__corner(m, 3 * triangle + k);
    return shade_face_normal(p[0], p[1], p[2]);
}
/* The vertex of lane i of a packet. */
SHADE__INLINE uint32_t shade__vertex_of(const shade__scene *s, const shade_vertex_ids *in, int i)
{
    return s->face_normals ? shade__corner_index(s->mesh, in->index[i]) : in->index[i];
}
/* Three rows of a packet, from one on. */
SHADE__INLINE shade__v3 *shade__three_rows(float *row) { return (shade__v3 *)(void *)row; }

/* Object-space attributes of a packet to rows of P, N and albedo. */
static SHADE__NOINLINE void shade__fetch_vertices(const shade__scene *s, const shade_vertex_ids *in,
                                                  shade__v3 *point, shade__v3 *normal,
                                                  shade__v3 *albedo)
{
    const shade_mesh *m = s->mesh;
    for (int i = 0; i < SHADE_LANES; i++) {
        uint32_t v = shade__vertex_of(s, in, i);
        shade__put(point, i, shade__vec3_at(m->positions, m->position_stride, v));
        if (!s->face_normals)
            shade__put(normal, i, shade__vec3_at(m->normals, m->normal_stride, v));
        if (m->colors) shade__put(albedo, i, shade__vec3_at(m->colors, m->color_stride, v));
    }
}
/* Normals of faces; with per_face their centroids and first colours too.  The corners of a face
   come one after the other. */
static SHADE__NOINLINE void shade__fetch_faces(const shade__scene *s, const shade_vertex_ids *in,
                                               int per_face, shade__v3 *point, shade__v3 *normal,
                                               shade__v3 *albedo)
{
    const shade_mesh *m = s->mesh;
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
        if (m->colors) shade__put(albedo, i, shade__vec3_at(m->colors, m->color_stride, v));
    }
}

/* clip = m (P, 1) */
SHADE__INLINE void shade__lane_clip(shade_mat4 m, const shade__v3 *SHADE_RESTRICT point,
                                    float *SHADE_RESTRICT clip)
{
    SHADE_EACH_LANE(i) {
        const shade_vec4 p = shade__xyzw(shade__at(point, i), 1);
        shade__put4(clip, SHADE_LANES, i, shade_mat4_transform(m, p));
    }
}
/* P = m (P, 1); an affine model, so no division */
SHADE__INLINE void shade__lane_world(shade_mat4 m, shade__v3 *SHADE_RESTRICT point)
{
    SHADE_EACH_LANE(i) {
        const shade_vec4 p = shade__xyzw(shade__at(point, i), 1);
        shade__put(point, i, shade__xyz(shade_mat4_transform(m, p)));
    }
}
/* N = m N / |m N|; interpolation between vertices starts from unit normals */
SHADE__INLINE void shade__lane_normal(shade_mat3 m, shade__v3 *SHADE_RESTRICT normal)
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
/* Varyings per fragment: P, N, albedo if there is one, u, v if there is a map; all of them for a
   fragment shader of the state.  Lit: the colour, or with a map what it multiplies, the rest, u,
   v. */
static void shade__mesh_vertex(const void *uniforms, const shade_vertex_ids *SHADE_RESTRICT in,
                               shade_vertices *SHADE_RESTRICT out)
{
    const shade__scene *s = (const shade__scene *)uniforms;
    const shade_shading shading = s->state->shading;
    const int lit = shading != SHADE_SHADING_PER_FRAGMENT;
    shade_rows rows;
    shade__v3 apart[SHADE__APART], *point, *normal, *albedo;
    point = SHADE__APART == 1 || !lit ? shade__three_rows(out->varying[6 * lit]) : apart;
    normal = point + 1;
    albedo = normal + 1;
    shade__fetch_vertices(s, in, point, normal, albedo);
    shade__lane_clip(s->clip_from_object, point, out->clip[0]);
    if (s->face_normals)
        shade__fetch_faces(s, in, shading == SHADE_SHADING_PER_FACE, point, normal, albedo);
    shade__lane_world(s->world_from_object, point);
    shade__lane_normal(s->normal_matrix, normal);
    SHADE__ZERO(rows);
    rows.position = point->x;
    rows.normal = normal->x;
    rows.albedo = s->mesh->colors ? albedo->x : NULL;
    if (lit) shade__lit_packet(&s->job, &rows, out->varying[0]);
    if (lit && s->map) {
        shade_lighting rest = s->lighting;
        rest.terms = s->unmapped;
        shade_lit_lanes(&rest, s->state->material, s->eye, &rows,
                        (float *)out->varying + 3 * SHADE_LANES);
    }
    if (s->state->fragment && !s->mesh->colors)
        for (int i = 0; i < SHADE_LANES; i++) shade__put(albedo, i, shade_v3(1, 1, 1));
    if (s->map || (s->state->fragment && s->mesh->texcoords))
        shade__fetch_texcoords(s, in, out->varying[s->uv]);
}

/* The row of alpha holds the map's, the fragment shader's, or 1: what is stored, what is cut by it,
   what ADD is to add. */
static void shade__mesh_alpha(const shade__scene *s, shade_colors *SHADE_RESTRICT out)
{
    const float opacity = 1 - s->state->transparency, cutoff = s->state->alpha_cutoff;
    if (!s->state->fragment) SHADE__ZERO(out->discard);
    SHADE_EACH_LANE(i) { out->color[3][i] *= opacity; }
    if (cutoff > 0) {
        SHADE_EACH_LANE(i) { out->discard[i] |= shade__mask(out->color[3][i] >= cutoff) + 1; }
    }
    if (s->colored && s->state->raster.blend == SHADE_BLEND_ADD) {
        SHADE_EACH_LANE(i) {
            float a = out->color[3][i];
            out->color[0][i] *= a;
            out->color[1][i] *= a;
            out->color[2][i] *= a;
        }
    }
}
/* The light of the rows by the map's colours, which are in rgb and become it.  A call of its own,
   so that only maps take its stack. */
static SHADE__NOINLINE void shade__lit_map(const shade__scene *s, const shade_rows *rows,
                                           float *rgb)
{
    float both[3 * SHADE_LANES];
    shade_rows mapped = *rows;
    SHADE_MEMCPY(both, rgb, sizeof both);
    for (int i = 0; rows->albedo && i < 3 * SHADE_LANES; i++) both[i] *= rows->albedo[i];
    mapped.albedo = both;
    shade__lit_packet(&s->job, &mapped, rgb);
}
/* The map, and with it the light of N and P that arrive per pixel, or the colour that arrives
   (Gouraud and flat); without a picture the map alone, for the holes it cuts. */
static void shade__mesh_colors(const shade__scene *s, const shade_fragments *SHADE_RESTRICT in,
                               shade_colors *SHADE_RESTRICT out)
{
    const float *varying = (const float *)in->varying;
    float *to = (float *)out->color;
    if (s->map)
        shade_sample_lanes(s->map, in->varying[s->uv], in->varying[s->uv + 1],
                           s->map->mipmap_count ? in->lod : NULL, to);
    if (s->colored && s->state->shading == SHADE_SHADING_PER_FRAGMENT) {
        shade_rows rows;
        SHADE__ZERO(rows);
        rows.position = varying;
        rows.normal = varying + 3 * SHADE_LANES;
        if (s->mesh->colors) rows.albedo = varying + 6 * SHADE_LANES;
        if (s->map) shade__lit_map(s, &rows, to);
        else shade__lit_packet(&s->job, &rows, to);
    } else if (s->colored && s->map) {
        for (int i = 0; i < 3 * SHADE_LANES; i++)
            to[i] = varying[i] * to[i] + varying[i + 3 * SHADE_LANES];
    } else if (s->colored) SHADE_MEMCPY(to, varying, 3 * sizeof in->varying[0]);
}
static void shade__mesh_fragment(const void *uniforms, const shade_fragments *SHADE_RESTRICT in,
                                 shade_colors *SHADE_RESTRICT out)
{
    const shade__scene *s = (const shade__scene *)uniforms;
    if (s->state->fragment) s->state->fragment(s->state->uniforms, in, out);
    else shade__mesh_colors(s, in, out);
    shade__mesh_alpha(s, out);
}

/* Not inlined: its temporaries would lie under the whole draw, half a kilobyte of stack. */
static SHADE__COLD void shade__scene_of(const shade_target *target, const shade_mesh *mesh,
                                        const shade_draw_state *state, shade__scene *s)
{
    shade_mat4 view = shade__or_identity(state->view), camera = shade_mat4_inverse(view);
    s->mesh = mesh;
    s->state = state;
    s->colored = target->color != NULL;
    s->world_from_object = shade__or_identity(state->model);
    s->clip_from_object = shade__or_identity(state->projection);
    s->clip_from_object = shade__mat4_product(&s->clip_from_object, &view);
    s->clip_from_object = shade__mat4_product(&s->clip_from_object, &s->world_from_object);
    s->normal_matrix = shade_normal_matrix(s->world_from_object);
    s->eye = state->lighting.flags & SHADE_FLAG_INFINITE_VIEWER
                ? shade_mat4_transform_direction(camera, shade_v3(0, 0, 1))
                : shade_mat4_transform_point(camera, shade_v3(0, 0, 0));
    s->face_normals = !mesh->normals || state->shading == SHADE_SHADING_PER_FACE;
    s->map = mesh->texcoords ? state->diffuse_map : NULL;
    s->uv = shade__mesh_varyings(mesh, state) - 2;
    s->lighting = state->lighting;
    s->unmapped = 0;
    if (s->map && state->shading != SHADE_SHADING_PER_FRAGMENT) {
        const unsigned terms = state->lighting.terms ? state->lighting.terms : ~0u;
        const unsigned matte = SHADE_TERM_AMBIENT | SHADE_TERM_DIFFUSE;
        s->lighting.terms = (terms & matte) | SHADE__TERM_NONE;
        s->unmapped = (terms & ~matte) | SHADE__TERM_NONE;
    }
    shade__begin_job(&s->lighting, state->material, s->eye, &s->job);
}

/* A function of its own, so that only meshes with chunks have the planes on the stack. */
static SHADE__NOINLINE shade_result shade__draw_chunks(const shade_target *target,
                                                       shade_pipeline *p, int how,
                                                       shade_stats *stats)
{
    const shade__scene *scene = (const shade__scene *)p->uniforms;
    const shade_mesh *mesh = scene->mesh;
    shade__frustum frustum;
    shade__supply supply;
    shade__frustum_of(target, &scene->clip_from_object, p->raster.depth_zero_to_one, &frustum);
    SHADE__ZERO(supply);
    supply.indices = mesh->indices;
    supply.more = shade__next_chunk;
    supply.chunks = mesh->chunk_count;
    supply.chunk = mesh->chunks;
    supply.frustum = &frustum;
    return shade__run_draw(target, p, how, &supply, stats);
}
SHADEDEF shade_result shade_draw_mesh(const shade_target *target, const shade_mesh *mesh,
                                      const shade_draw_state *state, shade_stats *stats)
{
    shade_pipeline p;
    shade__scene scene;
    shade__supply supply;
    int how;
    shade_result result = shade__begin(target, mesh && state, stats);
    if (!result) result = shade__check_mesh(mesh);
    if (!result && shade__state_fault(mesh, state)) result = SHADE_ERROR_STATE;
    if (!result && shade__lights_fault(&state->lighting)) result = SHADE_ERROR_LIGHTS;
    if (result) return result;
    if (mesh->texcoords && state->diffuse_map && !shade__texture_good(state->diffuse_map))
        return SHADE_ERROR_TEXTURE;
    result = shade__supply_all(mesh->indices, shade__corner_count(mesh), mesh->vertex_count,
                               &supply);
    if (result) return result;
    shade__scene_of(target, mesh, state, &scene);
    how = state->fragment ? 0 : SHADE__OWN;
    SHADE__ZERO(p);
    p.vertex = shade__mesh_vertex;
    p.may_discard = state->alpha_cutoff > 0 || (state->fragment && target->color);
    p.fragment = shade__mesh_fragment;
    p.uniforms = &scene;
    p.varyings = scene.uv + 2;
    if (scene.map && (scene.map->mipmap_count || state->fragment)) p.lod_texture = scene.map;
    p.lod_varying = scene.uv;
    if (state->shading == SHADE_SHADING_PER_FACE && !scene.map)
        p.interpolation = SHADE_INTERPOLATION_CONSTANT;
    p.raster = state->raster;
    if (scene.face_normals) how |= SHADE__CORNERS;
    if (mesh->chunks) return shade__draw_chunks(target, &p, how, stats);
    return shade__run_draw(target, &p, how, &supply, stats);
}

/*------------------------------------------------------------------------------------------ >>lines
   Lines as rectangles of the screen, two triangles each, drawn by the pipeline above.
     in      pairs of points           out  what triangles give: same coverage, depth test, blending
     holds  A segment is cut at the near and far planes first, so that both ends have a place on the
             screen.  One that lies outside becomes a triangle outside, and is counted as clipped.
                                                                                        >>shape */

typedef struct shade__stroke {           /* uniforms of the line shaders */
    const shade_vec3 *points;
    const shade_line_state *state;
    double clip_from_points[16];         /* columns */
    double half[2];                      /* half the picture, pixels */
    double half_width;
} shade__stroke;

/* Of the part t[0] .. t[1] of a segment with distances a, b to a plane at its ends, what is
   inside. */
static void shade__cut(double a, double b, double *t)
{
    if (a < 0 && b < 0) t[1] = -1;
    else if (a < 0 && a / (a - b) > t[0]) t[0] = a / (a - b);
    else if (b < 0 && a / (a - b) < t[1]) t[1] = a / (a - b);
}
/* The point t of the way, and where it lies from the middle of the picture, in pixels, y up. */
static void shade__stroke_point(const shade__stroke *s, double end[2][4], double t, double *p,
                                double *at)
{
    for (int i = 0; i < 4; i++) p[i] = end[0][i] + t * (end[1][i] - end[0][i]);
    for (int i = 0; i < 2; i++) at[i] = p[i] / p[3] * s->half[i];
}
/* What of a segment is drawn, t[0] .. t[1], and its direction on the screen: cut where it leaves
   near, far and w > 0, then a margin outside the picture that its width and caps do not reach
   across, so that far ends keep their 1/256 pixel.  0: nothing. */
static int shade__stroke_part(const shade__stroke *s, double end[2][4], double *t, double *dir)
{
    const double w0 = end[0][3], w1 = end[1][3], z0 = end[0][2], z1 = end[1][2];
    /* w of a place: what rounding leaves of it in t */
    const double least = (w0 > w1 ? w0 - w1 : w1 - w0) * 1e-14 + (double)shade__w_least;
    const int zero_to_one = s->state->raster.depth_zero_to_one != 0;
    double p[4], at[2][2], length = 0;
    t[0] = 0;
    t[1] = 1;
    shade__cut(z0 + (zero_to_one ? 0 : w0), z1 + (zero_to_one ? 0 : w1), t);
    shade__cut(w0 - z0, w1 - z1, t);
    shade__cut(w0 - least, w1 - least, t);
    if (!(t[0] <= t[1])) return 0;
    for (int j = 0; j < 2; j++) shade__stroke_point(s, end, t[j], p, at[j]);
    for (int i = 0; i < 2; i++) {
        const double limit = 1 + (3 * s->half_width + 2) / s->half[i];
        shade__cut(limit * w0 - end[0][i], limit * w1 - end[1][i], t);
        shade__cut(limit * w0 + end[0][i], limit * w1 + end[1][i], t);
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
/* Corner 0 .. 3 of the rectangle around points 2 i and 2 i + 1, in clip space; a place outside for
   one that is not drawn or is rejected. */
static shade_vec4 shade__stroke_corner(const shade__stroke *s, uint32_t segment, int corner)
{
    const double *m = s->clip_from_points, width = s->half_width;
    const int k = corner & 1;
    int placed = 1;
    double end[2][4], t[2], p[4], at[2], dir[2], side, along;
    for (int j = 0; j < 2; j++) {
        double v[3];
        shade__double3(s->points[2 * (size_t)segment + (size_t)j], v);
        for (int i = 0; i < 4; i++) {
            end[j][i] = m[i] * v[0] + m[i + 4] * v[1] + m[i + 8] * v[2] + m[i + 12];
            placed &= end[j][i] >= -1e30 && end[j][i] <= 1e30;
        }
    }
    if (!placed) return shade_v4(FLT_MAX, 2, 2, 1);
    if (!shade__stroke_part(s, end, t, dir)) return shade_v4(2, 2, 2, 1);
    shade__stroke_point(s, end, t[k], p, at);
    side = corner & 2 ? width : -width;
    along = s->state->cap != SHADE_CAP_SQUARE ? 0 : k ? width : -width;
    at[0] += dir[0] * along - dir[1] * side;
    at[1] += dir[1] * along + dir[0] * side;
    p[3] = (double)(float)p[3];
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

SHADEDEF shade_result shade_draw_lines(const shade_target *target, const shade_vec3 *points,
                                       int point_count, const shade_line_state *state,
                                       shade_stats *stats)
{
    shade_pipeline p;
    shade__stroke s;
    shade__supply supply;
    shade_mat4 clip_from_points;
    shade_result result = shade__begin(target, state && (points || point_count <= 0), stats);
    if (result) return result;
    if (point_count < 0 || point_count % 2 || point_count > INT32_MAX / 3) return SHADE_ERROR_MESH;
    SHADE__ZERO(p);
    p.raster = state->raster;
    p.raster.cull = SHADE_CULL_NONE;
    if (!(state->width >= 0 && state->width <= FLT_MAX) ||
        (unsigned)state->cap > SHADE_CAP_SQUARE || shade__raster_fault(&p.raster))
        return SHADE_ERROR_STATE;
    s.points = points;
    s.state = state;
    clip_from_points = shade__or_identity(state->clip_from_points);
    shade__doubles(&clip_from_points, s.clip_from_points);
    s.half[0] = target->width / 2.0;
    s.half[1] = target->height / 2.0;
    s.half_width = (state->width > 0 ? (double)state->width : 1) / 2;
    p.vertex = shade__stroke_vertex;
    p.fragment = shade__stroke_color;
    p.uniforms = &s;
    (void)shade__supply_all(NULL, 3 * point_count, 3 * point_count, &supply);
    return shade__run_draw(target, &p, SHADE__OWN, &supply, stats);
}

/*------------------------------------------------------------------------------------------ >>shape
   What a mesh knows of its shape: normals of vertices and corners, edges; and rays through it.
     in      meshes, the caller's memory         out  the caller's arrays
     method  normals of faces weighted by their angle at the vertex [Thurmer98]; edges by sorting;
             rays against triangles by Cramer's rule [Moller97]                        >>survey */

/* Angle between a vector of length y and components: atan2(y, x), y >= 0, within 1e-9. atan t =
   pi/4 + atan((t - 1) / (t + 1)) keeps the argument of the series below tan(pi/8). */
static double shade__angle(double y, double x)
{
    const double quarter = 0.78539816339744830962;
    double ax = x < 0 ? -x : x, t, s, a = 0;
    if (!(ax + y > 0)) return 0;
    t = (y - ax) / (y + ax);
    s = t < -0.4142135623730951 ? y / ax : t > 0.4142135623730951 ? -ax / y : t;
    for (int k = 25; k > 0; k -= 2) a = 1.0 / k - a * s * s;
    a = a * s + (t < -0.4142135623730951 ? 0 : t > 0.4142135623730951 ? 2 * quarter : quarter);
    return x < 0 ? 4 * quarter - a : a;
}
/* Unit normal of triangle t; zero without area or with a corner that is not finite. */
static shade_vec3 shade__triangle_normal(const shade_mesh *m, uint32_t t)
{
    shade_vec3 p[3], n = shade__face_normal(m, t, p);
    return shade__within(shade_dot(n, n), 2) ? n : shade_v3(0, 0, 0);
}
/* The corner some steps on in the same triangle. */
static uint32_t shade__corner_after(uint32_t corner, uint32_t steps)
{
    return corner / 3 * 3 + (corner + steps) % 3;
}
/* Angle of a triangle at a corner, radians. */
static float shade__corner_angle(const shade_mesh *m, uint32_t corner)
{
    const shade_vec3 p = shade__corner(m, corner);
    const shade_vec3 q = shade__corner(m, shade__corner_after(corner, 1));
    const shade_vec3 r = shade__corner(m, shade__corner_after(corner, 2));
    shade_vec3 a = shade__unit_vector(shade_sub(q, p)), b = shade__unit_vector(shade_sub(r, p));
    return (float)shade__angle((double)shade_length(shade_cross(a, b)), (double)shade_dot(a, b));
}
/* out: what must not be NULL */
static shade_result shade__check_shape(const shade_mesh *m, const void *out)
{
    return m && out ? shade__check_mesh(m) : SHADE_ERROR_ARGUMENT;
}
static shade_result shade__check_corners(const shade_mesh *m)
{
    return shade__check_indices(m->indices, shade__corner_count(m), m->vertex_count);
}

/* The indices of a chunk, and the number of all. */
static shade_result shade__check_range(const shade_mesh *m, const shade_chunk *c)
{
    if (shade__corner_count(m) % 3) return SHADE_ERROR_INDEX;
    if (!m->indices) return SHADE_OK;
    return shade__check_indices(m->indices + 3 * (size_t)c->first, 3 * c->count, m->vertex_count);
}

SHADEDEF shade_result shade_mesh_normals(const shade_mesh *mesh, shade_vec3 *normals)
{
    shade_result result = shade__check_shape(mesh, normals);
    if (!result) result = shade__check_corners(mesh);
    if (result) return result;
    SHADE_MEMSET(normals, 0, (size_t)mesh->vertex_count * sizeof *normals);
    for (uint32_t t = 0; t < (uint32_t)shade__corner_count(mesh) / 3; t++) {
        shade_vec3 n = shade__triangle_normal(mesh, t);
        for (uint32_t k = 3 * t; k < 3 * t + 3; k++) {
            shade_vec3 *sum = &normals[shade__corner_index(mesh, k)];
            *sum = shade_madd(*sum, shade__corner_angle(mesh, k), n);
        }
    }
    for (ptrdiff_t i = 0; i < mesh->vertex_count; i++) normals[i] = shade__unit_vector(normals[i]);
    return SHADE_OK;
}

/* NaN equals nothing */
static int shade__same_position(const shade_mesh *m, uint32_t i, uint32_t j)
{
    return shade__is_zero(shade_sub(shade__corner(m, i), shade__corner(m, j)));
}
/* The edge from a corner to the next of its triangle. */
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
/* Byte k of what corners are sorted by: position, where -0 + 0 is 0; or their edge, a before b. */
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
/* Triangles of a chunk where the caller does not say: of 64, 128, 256 and 512 what is fastest on 16
   bands, and within 1 % on one thread. */
enum { SHADE__CHUNK = 128 };

/* Corners 0 .. count - 1, sorted byte by byte, which takes the same time whatever they are; equal
   ones ascend.  other: room for as many. */
static void shade__sort_corners(const shade_mesh *m, int edges, uint32_t count, uint32_t *order,
                                uint32_t *other)
{
    for (uint32_t i = 0; i < count; i++) order[i] = i;
    for (int k = 0; k < (edges ? 8 : 12); k++) {    /* an even number, which ends in order */
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
SHADEDEF size_t shade_mesh_corner_normals_bytes(const shade_mesh *mesh)
{
    if (shade__check_shape(mesh, &mesh) || shade__check_corners(mesh)) return 0;
    return 16 * (size_t)shade__corner_count(mesh);
}
SHADEDEF shade_result shade_mesh_corner_normals(const shade_mesh *mesh, float cos_crease,
                                                shade_vec3 *out, void *memory, size_t bytes)
{
    const int corners = mesh ? shade__corner_count(mesh) : 0;
    const int usable = (memory || !corners) && (uintptr_t)memory % 4 == 0;
    shade_result result = shade__check_shape(mesh, usable ? out : NULL);
    uint32_t *order, count;
    float *angle;
    shade_vec3 *face;
    if (result) return result;
    count = (uint32_t)corners;
    if (cos_crease != cos_crease) return SHADE_ERROR_STATE;
    result = shade__check_corners(mesh);
    if (result) return result;
    if (bytes < 16 * (size_t)count) return SHADE_ERROR_CAPACITY;
    if (!count) return SHADE_OK;
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
            out[order[i]] = shade__unit_vector(mean);
        }
    }
    return SHADE_OK;
}

/* Sorted are corners, in the last quarter of edges: where i of them have become entries, these end
   before corner i, as 16 i <= 12 corners + 4 i. */
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
    if (!corners) return SHADE_OK;
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
/* Three times the centroid of a triangle along an axis, as an integer in the same order (NaN beyond
   the infinities, by its bits). */
static uint32_t shade__centroid_key(const shade_mesh *m, const uint32_t *triangle, int axis)
{
    float sum = 0;
    for (int k = 0; k < 3; k++) {
        const shade_vec3 p = shade__vec3_at(m->positions, m->position_stride, triangle[k]);
        sum += axis == 0 ? p.x : axis == 1 ? p.y : p.z;
    }
    const uint32_t bits = shade__float_bits(sum);
    return bits >> 31 ? ~bits : bits | 0x80000000u;
}
static float shade__key_value(uint32_t key)
{
    return shade__bits_float(key >> 31 ? key & 0x7FFFFFFFu : ~key);
}
/* The axis along which the centroids of triangles reach furthest, its least and greatest key. */
static int shade__longest_axis(const shade_mesh *m, const uint32_t *triangles, int count,
                               uint32_t *low, uint32_t *high)
{
    uint32_t least[3] = { UINT32_MAX, UINT32_MAX, UINT32_MAX }, most[3] = { 0, 0, 0 };
    int longest = 0;
    for (int i = 0; i < count; i++) {
        for (int axis = 0; axis < 3; axis++) {
            const uint32_t key = shade__centroid_key(m, triangles + 3 * (size_t)i, axis);
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
/* Moves the triangles whose key is at most pivot to the front; returns how many there are. */
static int shade__partition(const shade_mesh *m, uint32_t *triangles, int count, int axis,
                            uint32_t pivot)
{
    int front = 0;
    for (int i = 0; i < count; i++) {
        uint32_t *a = triangles + 3 * (size_t)front, *b = triangles + 3 * (size_t)i;
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
/* Moves the first half by the longest axis to the front.  The pivot halves the range of values, and
   after 8 steps that of keys, so that no list takes more than 40. */
static void shade__split(const shade_mesh *m, uint32_t *triangles, int count, int half)
{
    uint32_t low, high;
    const int axis = shade__longest_axis(m, triangles, count, &low, &high);
    for (int step = 0; low < high; step++) {
        const double middle = ((double)shade__key_value(low) + (double)shade__key_value(high)) / 2;
        uint32_t pivot = low + (high - low) / 2;
        if (step < 8 && middle >= -3e38 && middle <= 3e38) {
            const uint32_t bits = shade__float_bits((float)middle);
            pivot = bits >> 31 ? ~bits : bits | 0x80000000u;
            pivot = pivot < low ? low : pivot >= high ? high - 1 : pivot;
        }
        const int front = shade__partition(m, triangles, count, axis, pivot);
        if (front == half) return;
        if (front > half) {
            count = front;
            high = pivot;
        } else {
            triangles += 3 * (size_t)front;
            count -= front;
            half -= front;
            low = pivot + 1;
        }
    }
}
/* Sorts triangles in space: halves of whole chunks, again and again. */
static void shade__sort_triangles(const shade_mesh *m, uint32_t *triangles, int count, int chunk)
{
    while (count > chunk) {
        const int half = ((count - 1) / chunk + 1) / 2 * chunk;
        shade__split(m, triangles, count, half);
        shade__sort_triangles(m, triangles, half, chunk);
        triangles += 3 * (size_t)half;
        count -= half;
    }
}
/* The box around the finite corners of a chunk; low is above high where there are none. */
static void shade__box_chunk(const shade_mesh *m, shade_chunk *c)
{
    c->low = shade_v3(FLT_MAX, FLT_MAX, FLT_MAX);
    c->high = shade_neg(c->low);
    for (uint32_t k = 3 * (uint32_t)c->first; k < 3 * (uint32_t)(c->first + c->count); k++) {
        const shade_vec3 p = shade__corner(m, k);
        if (!shade__within(p.x, FLT_MAX) || !shade__within(p.y, FLT_MAX) ||
            !shade__within(p.z, FLT_MAX))
            continue;
        c->low = shade_min(c->low, p);
        c->high = shade_max(c->high, p);
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
    shade_mesh sorted;
    shade_result result;
    const int size = shade__chunk_size(triangles);
    int corners, count;
    if (!mesh || triangles < 0 || capacity < 0 || (!chunks && capacity))
        return SHADE_ERROR_ARGUMENT;
    sorted = *mesh;
    sorted.chunk_count = 0;
    result = shade__check_mesh(&sorted);
    if (!result) result = shade__check_corners(&sorted);
    if (result) return result;
    corners = shade__corner_count(&sorted);
    count = shade_chunk_count(corners, triangles);
    if (capacity < count) return SHADE_ERROR_CAPACITY;
    if (indices && corners) {
        for (int i = 0; i < corners; i++) indices[i] = shade__corner_index(mesh, (uint32_t)i);
        shade__sort_triangles(mesh, indices, corners / 3, size);
        sorted.indices = indices;
        sorted.index_count = corners;
    }
    for (int i = 0, first = 0; i < count; i++, first += chunks[i - 1].count) {
        chunks[i].first = first;
        chunks[i].count = shade__min(size, corners / 3 - first);
        shade__box_chunk(&sorted, &chunks[i]);
    }
    return SHADE_OK;
}
SHADEDEF int shade_is_silhouette(shade_vec3 to_eye, shade_vec3 n0, shade_vec3 n1)
{
    return shade_dot(to_eye, n0) * shade_dot(to_eye, n1) <= 0;
}
SHADEDEF int shade_is_crease(shade_vec3 n0, shade_vec3 n1, float threshold)
{
    return shade_dot(n0, n1) <= threshold;
}

SHADEDEF shade_ray shade_pixel_ray(shade_mat4 view, shade_mat4 projection, int width, int height,
                                   float x, float y)
{
    shade_ray ray;
    shade_mat4 camera = shade_mat4_inverse(view);
    shade_mat4 m = shade_mat4_inverse(shade__mat4_product(&projection, &view));
    float nx = 2 * x / (float)shade__max(width, 1) - 1,
          ny = 1 - 2 * y / (float)shade__max(height, 1);
    shade_vec4 from = shade_mat4_transform(m, shade_v4(nx, ny, -1, 1));
    shade_vec4 to = shade_mat4_transform(m, shade_v4(nx, ny, 0.5f, 1));
    shade_vec3 forward = shade_mat4_transform_direction(camera, shade_v3(0, 0, -1)), d;
    ray.origin = shade_mat4_transform_point(m, shade_v3(nx, ny, -1));
    if (projection.col[0].w != 0 || projection.col[1].w != 0 || projection.col[2].w != 0) {
        ray.origin = shade_mat4_transform_point(camera, shade_v3(0, 0, 0));
        from = shade__xyzw(ray.origin, 1);
    }
    d = shade_sub(shade_scale(shade__xyz(to), from.w), shade_scale(shade__xyz(from), to.w));
    ray.direction = shade__unit_vector(shade_dot(d, forward) < 0 ? shade_neg(d) : d);
    return ray;
}

SHADE__INLINE void shade__cross3(const double *a, const double *b, double *c)
{
    c[0] = a[1] * b[2] - a[2] * b[1];
    c[1] = a[2] * b[0] - a[0] * b[2];
    c[2] = a[0] * b[1] - a[1] * b[0];
}
/* c = a - b */
SHADE__INLINE void shade__sub3(shade_vec3 a, shade_vec3 b, double *c)
{
    c[0] = (double)a.x - (double)b.x;
    c[1] = (double)a.y - (double)b.y;
    c[2] = (double)a.z - (double)b.z;
}
/* e = b - a, f = c - a, n = e x f; 0 if n is zero.  It is for a triangle without area where the
   differences of its floats are exact in double. */
static int shade__edges3(shade_vec3 a, shade_vec3 b, shade_vec3 c, double *e, double *f, double *n)
{
    shade__sub3(b, a, e);
    shade__sub3(c, a, f);
    shade__cross3(e, f, n);
    return n[0] != 0 || n[1] != 0 || n[2] != 0;
}
/* With s = origin - a, q = d x s and D = d.n, Cramer's rule gives t = -s.n / D, u = f.q / D,
   v = -e.q / D. */
SHADEDEF int shade_intersect(shade_ray ray, shade_vec3 a, shade_vec3 b, shade_vec3 c, float *t,
                             shade_vec3 *barycentric)
{
    double d[3], e[3], f[3], s[3], n[3], q[3], det, u, v, at;
    shade__edges3(a, b, c, e, f, n);
    shade__double3(ray.direction, d);
    shade__sub3(ray.origin, a, s);
    shade__cross3(d, s, q);
    det = shade__dot3(d, n);
    if (det == 0) return 0;    /* no division by zero, for programs that trap it */
    u = shade__dot3(f, q) / det;
    v = -shade__dot3(e, q) / det;
    at = -shade__dot3(s, n) / det;
    if (!(u >= 0 && v >= 0 && u + v <= 1 && at >= 0 && at <= 3e38)) return 0;
    if (t) *t = (float)at;
    if (barycentric) *barycentric = shade_v3((float)(1 - (u + v)), (float)u, (float)v);
    return 1;
}

/* A ray in object space, its coordinates times the determinant of the model's matrix: component i
   is along the cross product of the two other columns.  The sizes are those of the products that
   vertices in world space are made of, for their rounding. */
typedef struct shade__slabs {
    double origin[3], direction[3], scale;    /* scale: the determinant */
    double slack[3];                  /* |column| |column| of the cross product, times 2^-20 */
    double size[3], reach;            /* of the columns; of the last one and the ray's origin */
    int affine;                       /* else there are no slabs */
} shade__slabs;

static void shade__slabs_of(const shade_mat4 *m, shade_ray ray, shade__slabs *s)
{
    double column[4][3], normal[3], origin[3], direction[3];
    s->affine = m->col[0].w == 0 && m->col[1].w == 0 && m->col[2].w == 0 && m->col[3].w == 1;
    for (int k = 0; k < 4; k++) shade__double3(shade__xyz(m->col[k]), column[k]);
    shade__double3(ray.direction, direction);
    shade__sub3(ray.origin, shade__xyz(m->col[3]), origin);
    for (int k = 0; k < 3; k++)
        s->size[k] = shade__size(column[k][0]) + shade__size(column[k][1]) +
                     shade__size(column[k][2]);
    for (int k = 0; k < 3; k++) {
        const int a = k < 2 ? k + 1 : 0, b = k > 0 ? k - 1 : 2;
        shade__cross3(column[a], column[b], normal);
        s->origin[k] = shade__dot3(origin, normal);
        s->direction[k] = shade__dot3(direction, normal);
        s->slack[k] = s->size[a] * s->size[b] * (1 / 1048576.0);
        s->scale = shade__dot3(column[k], normal);
    }
    s->reach = shade__size(origin[0]) + shade__size(origin[1]) + shade__size(origin[2]);
    for (int k = 0; k < 3; k++) s->reach += 2 * shade__size(column[3][k]);
    s->reach += (double)FLT_MIN;    /* for world positions and t that are denormal */
}
/* Where the ray may be inside the box of a triangle or a chunk, as rounding makes it: range[0] ..
   range[1], at most limit.  0 if it does not meet it up to there.  A larger box never gives a
   smaller range, so that a triangle is met through the box of its chunk if it is met through its
   own. */
static int shade__slabs_met(const shade__slabs *s, shade_vec3 low, shade_vec3 high, float limit,
                            double *range)
{
    double from[3], to[3], size = s->reach;
    range[0] = 0;
    range[1] = (double)limit;
    if (!s->affine || !(low.x <= high.x && low.y <= high.y && low.z <= high.z)) return 1;
    shade__double3(low, from);
    shade__double3(high, to);
    for (int k = 0; k < 3; k++) {
        const double a = shade__size(from[k]), b = shade__size(to[k]);
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

/* A triangle counts where its point lies in its own box, and so in that of each chunk that has it:
   a ray nearly in its plane, of which rounding leaves nothing, meets it in any order or never. */
static void shade__pick_triangle(const shade_mesh *mesh, const shade_mat4 *model, shade_ray ray,
                                 const shade__slabs *slabs, int triangle, shade__hit *hit)
{
    shade_vec3 p[3], q[3], where;
    double e[3], f[3], n[3], range[2];
    float t;
    for (uint32_t k = 0; k < 3; k++) q[k] = shade__corner(mesh, 3 * (uint32_t)triangle + k);
    if (!shade__slabs_met(slabs, shade_min(q[0], shade_min(q[1], q[2])),
                          shade_max(q[0], shade_max(q[1], q[2])), hit->t, range))
        return;
    for (uint32_t k = 0; k < 3; k++) p[k] = shade_mat4_transform_point(*model, q[k]);
    if (!shade_intersect(ray, p[0], p[1], p[2], &t, &where)) return;
    if ((double)t < range[0] || (double)t > range[1]) return;
    if (t == hit->t && triangle > hit->triangle) return;
    /* three points of a line, which rounding parts when they are turned */
    if (!shade__edges3(q[0], q[1], q[2], e, f, n)) return;
    hit->triangle = triangle;
    hit->t = t;
    hit->barycentric = where;
}
SHADEDEF int shade_pick(const shade_mesh *mesh, shade_mat4 model, shade_ray ray, float *t,
                        shade_vec3 *barycentric)
{
    shade__slabs slabs;
    shade__hit hit;
    shade_chunk all;
    const shade_chunk *chunk = &all;
    int chunks = 1;
    SHADE__ZERO(all);
    if (shade__check_shape(mesh, &ray)) return -1;
    all.low.x = 1;    /* above high: always looked into */
    all.count = shade__corner_count(mesh) / 3;
    if (mesh->chunks) {
        chunk = mesh->chunks;
        chunks = mesh->chunk_count;
    }
    model = shade__or_identity(model);
    shade__slabs_of(&model, ray, &slabs);
    hit.triangle = -1;
    hit.t = FLT_MAX;    /* no intersection is as far */
    for (; chunks > 0; chunks--, chunk++) {
        double range[2];
        if (!shade__slabs_met(&slabs, chunk->low, chunk->high, hit.t, range)) continue;
        if (shade__check_range(mesh, chunk)) return -1;
        for (int i = 0; i < chunk->count; i++)
            shade__pick_triangle(mesh, &model, ray, &slabs, chunk->first + i, &hit);
    }
    if (hit.triangle >= 0 && t) *t = hit.t;
    if (hit.triangle >= 0 && barycentric) *barycentric = hit.barycentric;
    return hit.triangle;
}

/*----------------------------------------------------------------------------------------- >>survey
   What a draw of a mesh came to, looked at again: for >>explain.
     in      what shade_draw_mesh took     out  shade__survey: counts, and points that are visible
     holds   Nothing is written.  A pass counts what becomes of the triangles; a second one takes at
             most SHADE__POINTS points of those that are drawn, and compares them with the depth
             buffer.                                                                   >>explain */

enum {
    SHADE__POINTS = 256,     /* points of the mesh that are looked at */
    SHADE__SUSPECTS = 16     /* lamps that are tried without their cone, or their attenuation */
};
typedef enum shade__fate {   /* what becomes of a triangle */
    SHADE__REJECTED, SHADE__BEHIND, SHADE__BEFORE_NEAR, SHADE__BEYOND_FAR, SHADE__BESIDE,
    SHADE__NO_AREA, SHADE__FRONT, SHADE__BACK, SHADE__FATES
} shade__fate;

typedef struct shade__corners {          /* of one triangle */
    shade_vec3 object[3], world[3];
    shade_vec4 clip[3];
} shade__corners;
typedef struct shade__walk { int chunk, next, end; } shade__walk;

typedef struct shade__survey {
    const shade_target     *target;
    const shade_mesh       *mesh;
    const shade_draw_state *state;
    const shade_stats      *stats;       /* NULL: not known */
    shade__scene scene;
    shade_mat4 projection, camera;       /* camera: from eye to world */
    shade_mat4 clip_from_world;
    shade_vec3 eye;
    int whole;                           /* the clip rectangle is the picture, in memory as well */
    int clip[4];
    long long triangles, drawn, fate[SHADE__FATES];    /* triangles: without those rejected */
    shade_vec3 low, high, origin;        /* the box of the corners, and the first; world space */
    double area, volume, sum[3];         /* twice the area, 6 times the volume, vectors of area */
    long long boxes;                     /* triangles that leave the box of their chunk */
    long long with, against;             /* triangles wound as their vertex normals say, or not */
    int seen, cut;                       /* points in the clip rectangle; below alpha_cutoff */
    int failed, unbiased;                /* of seen: not drawn by their depth; but without bias */
    int zeros, ones, nans;               /* of seen: the depth buffer holds 0, 1, NaN */
    int held, untouched;                 /* of seen: it holds the mesh; it holds what is behind */
    int vague;                           /* of seen: too far away for depth to tell */
    int clear;                           /* points of an alpha below 1/255 */
    int points;                          /* that are visible */
    shade_vec3 point[SHADE__POINTS], normal[SHADE__POINTS], albedo[SHADE__POINTS];
} shade__survey;

static int shade__is_perspective(const shade_mat4 *m)
{
    return m->col[3].w == 0 && m->col[2].w != 0 && m->col[0].w == 0 && m->col[1].w == 0;
}

/* ---- the first pass: what becomes of the triangles */

/* The next triangle of the draw; -1 behind the last. */
static int shade__next_triangle(const shade_mesh *m, shade__walk *w)
{
    while (w->next == w->end) {
        const int more = m->chunks ? m->chunk_count : 1;
        if (w->chunk >= more) return -1;
        w->next = m->chunks ? m->chunks[w->chunk].first : 0;
        w->end = w->next + (m->chunks ? m->chunks[w->chunk].count : shade__corner_count(m) / 3);
        w->chunk++;
    }
    return w->next++;
}
static void shade__corners_of(const shade__survey *s, int triangle, shade__corners *c)
{
    for (int k = 0; k < 3; k++) {
        const shade_vec3 p = shade__corner(s->mesh, 3 * (uint32_t)triangle + (uint32_t)k);
        c->object[k] = p;
        c->clip[k] = shade_mat4_transform(s->scene.clip_from_object, shade__xyzw(p, 1));
        c->world[k] = shade__xyz(shade_mat4_transform(s->scene.world_from_object,
                                                      shade__xyzw(p, 1)));
    }
}
static uint32_t shade__outcode(shade_vec4 c, int zero_to_one)
{
    const float low = zero_to_one ? 0 : -c.w;
    const uint32_t bad = shade__beyond(c.x) | shade__beyond(c.y) | shade__beyond(c.z) |
                         shade__beyond(c.w);
    return shade__sides_passed(c.x, c.y, c.w) | (shade__mask(c.z < low) & SHADE__OUT_NEAR) |
           (shade__mask(c.z > c.w) & SHADE__OUT_FAR) | (bad & SHADE__OUT_BAD) |
           (shade__mask(c.w < shade__w_least) & SHADE__OUT_W);
}
/* Twice the signed area on the screen times w0 w1 w2: its sign holds behind the eye as well. */
static double shade__homogeneous_area(const shade_vec4 *c)
{
    double x[3], y[3], w[3];
    for (int k = 0; k < 3; k++) {
        x[k] = (double)c[k].x;
        y[k] = (double)c[k].y;
        w[k] = (double)c[k].w;
    }
    return x[0] * (y[1] * w[2] - y[2] * w[1]) - y[0] * (x[1] * w[2] - x[2] * w[1]) +
           w[0] * (x[1] * y[2] - x[2] * y[1]);
}
static shade__fate shade__fate_of(const shade__survey *s, const shade__corners *c)
{
    uint32_t any = 0, all = ~0u;
    double area, least = 0;
    for (int k = 0; k < 3; k++) {
        const uint32_t out = shade__outcode(c->clip[k], s->state->raster.depth_zero_to_one);
        any |= out;
        all &= out;
    }
    if (any & SHADE__OUT_BAD) return SHADE__REJECTED;
    if (all & SHADE__OUT_W) return SHADE__BEHIND;
    if (all & SHADE__OUT_NEAR) return SHADE__BEFORE_NEAR;
    if (all & SHADE__OUT_FAR) return SHADE__BEYOND_FAR;
    if (all & 15) return SHADE__BESIDE;
    area = shade__homogeneous_area(c->clip);
    if (!(any & SHADE__OUT_W))    /* below 2^-15 of a pixel: the corners are snapped to one line */
        least = (double)c->clip[0].w * (double)c->clip[1].w * (double)c->clip[2].w * 1.2e-4 /
                ((double)s->target->width * (double)s->target->height);
    return area > least ? SHADE__FRONT : area < -least ? SHADE__BACK : SHADE__NO_AREA;
}
static int shade__is_drawn(const shade__survey *s, shade__fate fate)
{
    const shade_cull cull = s->state->raster.cull;
    return (fate == SHADE__FRONT && cull != SHADE_CULL_FRONT) ||
           (fate == SHADE__BACK && cull != SHADE_CULL_BACK);
}
/* Is a corner outside of the box of its chunk?  A box that is always looked into holds anything. */
static int shade__leaves_box(const shade_mesh *m, const shade__walk *w, const shade__corners *c)
{
    const shade_chunk *box = m->chunks ? &m->chunks[w->chunk - 1] : NULL;
    for (int k = 0; box && k < 3; k++) {
        const shade_vec3 p = c->object[k];
        if (box->low.x <= box->high.x && (p.x < box->low.x || p.x > box->high.x)) return 1;
        if (box->low.y <= box->high.y && (p.y < box->low.y || p.y > box->high.y)) return 1;
        if (box->low.z <= box->high.z && (p.z < box->low.z || p.z > box->high.z)) return 1;
    }
    return 0;
}
/* Adds a triangle to box, areas, volume, and to with or against. */
static void shade__measure(shade__survey *s, int triangle, const shade__corners *c)
{
    double e[3], f[3], n[3], p[3];
    shade_vec3 normal = shade_v3(0, 0, 0), face;
    shade__sub3(c->world[1], c->world[0], e);
    shade__sub3(c->world[2], c->world[0], f);
    shade__cross3(e, f, n);
    if (s->triangles == 1) s->origin = s->low = s->high = c->world[0];
    for (int k = 0; k < 3; k++) {
        s->low = shade_min(s->low, c->world[k]);
        s->high = shade_max(s->high, c->world[k]);
        s->sum[k] += n[k];
    }
    shade__sub3(c->world[0], s->origin, p);
    s->volume += p[0] * n[0] + p[1] * n[1] + p[2] * n[2];
    s->area += (double)shade_length(shade_v3((float)n[0], (float)n[1], (float)n[2]));
    if (!s->mesh->normals) return;
    for (uint32_t k = 0; k < 3; k++)
        normal = shade_add(normal, shade__vec3_at(s->mesh->normals, s->mesh->normal_stride,
                                   shade__corner_index(s->mesh, 3 * (uint32_t)triangle + k)));
    face = shade_face_normal(c->object[0], c->object[1], c->object[2]);
    s->with += shade_dot(face, normal) > 0;
    s->against += shade_dot(face, normal) < 0;
}
static void shade__count_fates(shade__survey *s)
{
    shade__walk w;
    shade__corners c;
    SHADE__ZERO(w);
    for (int t = shade__next_triangle(s->mesh, &w); t >= 0; t = shade__next_triangle(s->mesh, &w)) {
        shade__fate fate;
        shade__corners_of(s, t, &c);
        fate = shade__fate_of(s, &c);
        s->fate[fate]++;
        s->drawn += shade__is_drawn(s, fate);
        if (fate == SHADE__REJECTED) continue;
        s->triangles++;
        s->boxes += shade__leaves_box(s->mesh, &w, &c);
        shade__measure(s, t, &c);
    }
}

/* ---- the second pass: points of the triangles that are drawn */

/* Compares a point with the depth buffer.  The depths of two neighbours on the line of sight tell
   whether what the buffer holds is the mesh itself; far: the one behind.  Whether it is hidden. */
static int shade__look_behind(shade__survey *s, shade_vec3 p, float depth, float stored)
{
    const shade_raster *r = &s->state->raster;
    const shade__compare test = shade__compare_of(r);
    const float step = 0.02f * shade_distance(s->low, s->high);
    const int orthographic = !shade__is_perspective(&s->projection);
    const shade_vec3 to_eye = orthographic ? shade__xyz(s->camera.col[2]) : shade_sub(s->eye, p);
    const shade_vec3 by = shade_scale(shade_normalize(to_eye), step);
    float around[2];
    int fails, holds;
    for (int k = 0; k < 2; k++) {
        const shade_vec3 q = k ? shade_sub(p, by) : shade_add(p, by);
        const shade_vec4 v = shade_mat4_transform(s->clip_from_world, shade__xyzw(q, 1));
        const double scale = r->depth_zero_to_one ? 1 : 0.5;
        around[k] = v.w > 0 ? shade__window_depth(v.z, v.w, scale, 1 - scale) : depth;
    }
    fails = !shade__passes(test, 0, depth + r->depth_bias, stored);
    s->unbiased += fails && shade__passes(test, 0, depth, stored);
    s->zeros += stored == 0;
    s->ones += stored == 1;
    s->nans += stored != stored;
    if (around[0] > around[1]) {    /* reversed: compare in the other direction */
        around[0] = -around[0];
        around[1] = -around[1];
        stored = -stored;
    }
    s->vague += around[1] - around[0] < 1e-6f;
    holds = stored >= around[0] && stored <= around[1];
    s->held += holds;
    s->failed += fails || holds;
    s->untouched += stored > around[1];
    return stored < around[0];
}
/* Whether the point is in the clip rectangle; there it is compared with the depth buffer. */
static int shade__point_hidden(shade__survey *s, shade_vec3 p, shade_vec4 clip)
{
    const shade_target *t = s->target;
    const double scale = s->state->raster.depth_zero_to_one ? 1 : 0.5;
    const int x = shade__min((int)((clip.x / clip.w + 1) * (float)t->width / 2), t->width - 1);
    const int y = shade__min((int)((1 - clip.y / clip.w) * (float)t->height / 2), t->height - 1);
    if (x < s->clip[0] || y < s->clip[1] || x >= s->clip[2] || y >= s->clip[3]) return 0;
    s->seen++;
    if (!t->depth) return 0;
    return shade__look_behind(s, p, shade__window_depth(clip.z, clip.w, scale, 1 - scale),
                              t->depth[shade__offset_of(t, x, y)]);
}
/* Three values of the corners at barycentric b. */
static shade_vec3 shade__between(const shade_vec3 *v, shade_vec3 b)
{
    return shade_madd(shade_madd(shade_scale(v[0], b.x), b.y, v[1]), b.z, v[2]);
}
/* N, the product of colour and map, and its alpha, as the fragment shader has them. */
static float shade__surface_at(const shade__survey *s, int triangle, const shade__corners *c,
                               shade_vec3 b, shade_vec3 *normal, shade_vec3 *albedo)
{
    const shade_mesh *m = s->mesh;
    shade_vec3 n[3], color[3], uv[3];
    shade_vec4 texel = shade_v4(1, 1, 1, 1);
    for (uint32_t k = 0; k < 3; k++) {
        const uint32_t v = shade__corner_index(m, 3 * (uint32_t)triangle + k);
        float at[2] = { 0, 0 };
        n[k] = s->scene.face_normals ? shade_face_normal(c->object[0], c->object[1], c->object[2])
                                     : shade__vec3_at(m->normals, m->normal_stride, v);
        n[k] = shade_normalize(shade_mat3_transform(s->scene.normal_matrix, n[k]));
        color[k] = m->colors ? shade__vec3_at(m->colors, m->color_stride, v) : shade_v3(1, 1, 1);
        if (s->scene.map)
            SHADE_MEMCPY(at, (const char *)m->texcoords +
                             v * (size_t)(m->texcoord_stride ? m->texcoord_stride : 8), 8);
        uv[k] = shade_v3(at[0], at[1], 0);
    }
    uv[0] = shade__between(uv, b);
    if (s->scene.map) texel = shade_sample(s->scene.map, uv[0].x, uv[0].y, 0);
    *normal = shade__between(n, b);
    *albedo = shade_mul(shade__between(color, b), shade__xyz(texel));
    return (1 - s->state->transparency) * texel.w;
}
/* always: a point that no depth buffer hides */
static void shade__take_point(shade__survey *s, int triangle, const shade__corners *c, shade_vec3 b,
                              int always)
{
    const int at = s->points;
    shade_vec4 clip = shade_scale4(c->clip[0], b.x);
    float alpha;
    clip = shade_add4(clip, shade_scale4(c->clip[1], b.y));
    clip = shade_add4(clip, shade_scale4(c->clip[2], b.z));
    s->point[at] = shade__between(c->world, b);
    alpha = shade__surface_at(s, triangle, c, b, &s->normal[at], &s->albedo[at]);
    if (!always) {
        const int out = shade__outcode(clip, s->state->raster.depth_zero_to_one) != 0;
        if (out) return;
        if (!s->state->fragment && alpha < s->state->alpha_cutoff) {
            s->cut++;
            return;
        }
        if (shade__point_hidden(s, s->point[at], clip)) return;
    }
    s->clear += !s->state->fragment && alpha < 1 / 255.0f;
    s->points = at + 1;
}
/* The middles of the upright triangles of a lattice with so many rows. */
static void shade__take_points(shade__survey *s, int triangle, const shade__corners *c, int rows)
{
    for (int i = 0; i < rows; i++)
        for (int k = 0; i + k < rows; k++) {
            const float u = ((float)i + 1 / 3.0f) / (float)rows;
            const float v = ((float)k + 1 / 3.0f) / (float)rows;
            shade__take_point(s, triangle, c, shade_v3(1 - u - v, u, v), 0);
        }
}
static void shade__take_faces(shade__survey *s)
{
    const int most = SHADE__POINTS - SHADE__SUSPECTS;
    const long long every = (s->drawn - 1) / most + 1, faces = (s->drawn - 1) / every + 1;
    shade__walk w;
    shade__corners c;
    long long number = 0;
    int rows = 1;
    while ((rows + 1) * (rows + 2) / 2 * faces <= most) rows++;
    SHADE__ZERO(w);
    for (int t = shade__next_triangle(s->mesh, &w); t >= 0; t = shade__next_triangle(s->mesh, &w)) {
        shade__corners_of(s, t, &c);
        if (!shade__is_drawn(s, shade__fate_of(s, &c))) continue;
        if (number++ % every == 0) shade__take_points(s, t, &c, rows);
    }
}

/*---------------------------------------------------------------------------------------- >>explain
   Why a draw gives no picture, or the wrong one, in one sentence.
     in      what shade_draw_mesh took, its stats      out  a constant sentence; "" for nothing
     holds   What only a band or a strip shows is never told: others may show the rest.  At most
             SHADE__POINTS points are lit.                                               >>image */

/* ---- arguments: the refusals of shade_draw_mesh, in its order */

static const char *shade__indices_fault(const shade_mesh *m)
{
    if (!shade__check_indices(m->indices, shade__corner_count(m), m->vertex_count)) return NULL;
    if (shade__corner_count(m) % 3 == 0)
        return "mesh.indices holds an index at or past mesh.vertex_count; vertex_count counts "
               "vertices, not floats, and indices are 32 bits wide.";
    return m->indices ? "mesh.index_count is no multiple of 3; it counts indices, three a triangle."
                      : "mesh.vertex_count is no multiple of 3, and mesh.indices is NULL.";
}
static const char *shade__refusal(const shade_target *t, const shade_mesh *m,
                                  const shade_draw_state *s)
{
    const char *fault;
    if (!t) return "target is NULL; pass the address of a shade_target.";
    if (!m) return "mesh is NULL; pass the address of a shade_mesh.";
    if (!s) return "state is NULL; pass the address of a shade_draw_state.";
    fault = shade__target_fault(t);
    if (!fault) fault = shade__mesh_fault(m);
    if (!fault) fault = shade__chunks_fault(m);
    if (!fault) fault = shade__state_fault(m, s);
    if (!fault) fault = shade__lights_fault(&s->lighting);
    if (!fault && m->texcoords && s->diffuse_map) fault = shade__texture_fault(s->diffuse_map);
    return fault ? fault : shade__indices_fault(m);
}
static int shade__overlaps(int stride, int bytes) { return stride && stride < bytes; }

static const char *shade__suspect_mesh(const shade_mesh *m)
{
    if (!shade__corner_count(m))
        return m->indices ? "mesh.index_count is 0, so there are no triangles to draw; set it."
                          : "mesh.vertex_count is 0, so there are no triangles to draw; set it.";
    if (m->chunks && !m->chunk_count)
        return "mesh.chunk_count is 0 while mesh.chunks is not NULL, so no triangle is drawn; set "
               "chunk_count, or make chunks NULL.";
    if (shade__overlaps(m->position_stride, 12) ||
        (m->normals && shade__overlaps(m->normal_stride, 12)) ||
        (m->texcoords && shade__overlaps(m->texcoord_stride, 8)) ||
        (m->colors && shade__overlaps(m->color_stride, 12)))
        return "A stride of the mesh is shorter than one element; position_stride, normal_stride, "
               "texcoord_stride and color_stride count bytes, not floats, and 0 means tight.";
    return NULL;
}

/* ---- matrices */

static int shade__is_affine(const shade_mat4 *m)
{
    return m->col[0].w == 0 && m->col[1].w == 0 && m->col[2].w == 0 && m->col[3].w == 1;
}
/* Turns, moves and mirrors, but does not scale. */
static int shade__is_rigid(const shade_mat4 *m)
{
    int good = shade__is_affine(m);
    for (int i = 0; i < 3; i++)
        for (int k = 0; k <= i; k++) {
            const float d = shade_dot(shade__xyz(m->col[i]), shade__xyz(m->col[k]));
            good &= shade__within(d - (i == k ? 1.0f : 0.0f), 0.01f);
        }
    return good;
}
/* A translation in the row where column-major matrices have 0, 0, 0, 1. */
static int shade__is_transposed(const shade_mat4 *m)
{
    return shade__is_zero(shade__xyz(m->col[3])) && m->col[3].w == 1 && !shade__is_affine(m);
}
/* Columns that all vanish but the last, (0, 0, 2, 1): what cameras give for bad arguments. */
static int shade__is_no_camera(const shade_mat4 *m)
{
    for (int k = 0; k < 14; k++)
        if (((const float *)m)[k] != 0) return 0;
    return m->col[3].z == 2 && m->col[3].w == 1;
}
static const char *shade__suspect_numbers(const shade_draw_state *s)
{
    if (!shade__is_finite(&s->model)) return "state.model holds a NaN or an infinite number.";
    if (!shade__is_finite(&s->view)) return "state.view holds a NaN or an infinite number.";
    if (!shade__is_finite(&s->projection))
        return "state.projection holds a NaN or an infinite number.";
    if (shade__is_no_camera(&s->projection) || shade__is_no_camera(&s->view))
        return "state.projection is the matrix that cameras give for bad arguments: fovy must be "
               "in radians and below pi (use shade_radians for degrees), near and far above 0 and "
               "different, the aspect not 0, left not equal to right, bottom not to top.";
    return NULL;
}
static const char *shade__suspect_matrices(const shade_draw_state *s)
{
    const shade_mat4 view = shade__or_identity(s->view), *p = &s->projection;
    const char *fault = shade__suspect_numbers(s);
    if (fault) return fault;
    if (shade__is_transposed(&s->model))
        return "state.model looks transposed (row-major): its translation belongs into col[3]; "
               "pass it through shade_mat4_transpose.";
    if (shade__is_transposed(&view))
        return "state.view looks transposed (row-major): its translation belongs into col[3]; "
               "pass it through shade_mat4_transpose.";
    if ((p->col[3].z == -1 || p->col[3].z == 1) && p->col[3].w == 0 &&
        p->col[2].w * (1 - p->col[2].w * p->col[2].w) != 0)    /* none of 0, 1, -1 */
        return "state.projection looks transposed (row-major): its -1 belongs into col[2].w; pass "
               "it through shade_mat4_transpose.";
    if (!shade__is_affine(&view) || (!shade__is_rigid(&view) && shade__is_rigid(p) &&
                                     !shade__is_zero(shade__xyz(p->col[3]))))
        return "state.view holds a projection: state.view and state.projection look swapped.";
    if (shade_mat4_determinant(view) == 0)
        return "state.view is singular, it has no inverse and so no eye; make it with "
               "shade_mat4_look_at.";
    if (shade__is_perspective(p) && (p->col[0].z != 0 || p->col[1].z != 0) &&
        !shade__is_zero(shade_v3(p->col[0].y, p->col[1].x, 0)))
        return "state.projection looks multiplied in the wrong order: shade_mat4_mul(a, b) applies "
               "b first, so that projection times view is shade_mat4_mul(projection, view).";
    if (shade__is_perspective(p) && p->col[2].z == 0 && !s->raster.depth_zero_to_one)
        return "state.projection is that of shade_mat4_perspective_reversed, which needs "
               "raster.depth_zero_to_one = 1, SHADE_COMPARE_GREATER and depth cleared to 0.";
    return NULL;
}

static int shade__eye_inside(const shade__survey *s)
{
    return s->eye.x >= s->low.x && s->eye.y >= s->low.y && s->eye.z >= s->low.z &&
           s->eye.x <= s->high.x && s->eye.y <= s->high.y && s->eye.z <= s->high.z;
}

/* ---- nothing is drawn */

/* Has anything been drawn?  Then the depth buffer holds different values. */
static int shade__depth_varies(const shade__survey *s)
{
    const shade_target *t = s->target;
    const int looks = shade__min(256, 256 * (s->clip[2] - s->clip[0]));    /* none in nothing */
    float first = 0;
    for (int k = 0; k < looks && t->depth; k++) {
        const int x = s->clip[0] + (s->clip[2] - s->clip[0]) * (2 * (k & 15) + 1) / 32;
        const int y = s->clip[1] + (s->clip[3] - s->clip[1]) * (2 * (k >> 4) + 1) / 32;
        const float depth = t->depth[shade__offset_of(t, x, y)];
        if (!k) first = depth;
        if (depth != first) return 1;
    }
    return 0;
}
/* Is this one of the small meshes of a scene, whose box is below half of the picture in width
   and height, and not far away?  Then it may be hidden, or beside the picture, with right. */
static int shade__is_scattered(const shade__survey *s)
{
    shade_vec3 low = shade_v3(8, 8, 0), high = shade_v3(-8, -8, 0);
    for (int k = 0; k < 8; k++) {
        const shade_vec3 p = shade_v3(k & 1 ? s->low.x : s->high.x, k & 2 ? s->low.y : s->high.y,
                                      k & 4 ? s->low.z : s->high.z);
        const shade_vec4 c = shade_mat4_transform(s->clip_from_world, shade__xyzw(p, 1));
        if (!(c.w > 0) || shade__sides_passed(c.x, c.y, 8 * c.w)) return 0;
        low = shade_min(low, shade_v3(c.x / c.w, c.y / c.w, 0));
        high = shade_max(high, shade_v3(c.x / c.w, c.y / c.w, 0));
    }
    return high.x - low.x < 1 && high.y - low.y < 1 && shade__depth_varies(s);
}
static const char *shade__why_outside(const shade__survey *s)
{
    const shade_mat4 view = shade__or_identity(s->state->view), *p = &s->projection;
    const long long depth = s->fate[SHADE__BEFORE_NEAR] + s->fate[SHADE__BEYOND_FAR];
    const shade_vec3 middle = shade_lerp(s->low, s->high, 0.5f);
    const shade_mat4 turned = shade__mat4_product(p, &s->camera);
    const shade_vec4 seen = shade_mat4_transform(turned, shade__xyzw(middle, 1));
    if (shade__is_transposed(p))
        return "state.projection looks transposed (row-major): translations stand in col[3]; pass "
               "it through shade_mat4_transpose.";
    if (shade__is_perspective(p) && !s->state->raster.depth_zero_to_one && p->col[2].w == -1 &&
        (p->col[3].z / (p->col[2].z - 1) <= 0 || p->col[3].z / (p->col[2].z + 1) <= 0))
        return "state.projection has a near or far plane at or behind the eye: near and far must "
               "be above 0, and shade_mat4_mul(projection, view) applies view first.";
    if (shade__is_affine(p) && shade__is_rigid(p))
        return "Every triangle lies outside of the cube from -1 to 1: state.projection is unset, "
               "or no projection; make it with shade_mat4_perspective or shade_mat4_ortho.";
    if (s->triangles == s->fate[SHADE__BEYOND_FAR])
        return "Every triangle lies beyond the far plane of state.projection; move far out, or the "
               "eye of state.view nearer.";
    if (!shade__outcode(seen, s->state->raster.depth_zero_to_one) && !shade__is_zero(s->eye))
        return "The mesh is out of view, but the inverse of state.view would show it: state.view "
               "takes the world to the eye, as shade_mat4_look_at does.";
    if (s->triangles == s->fate[SHADE__BEHIND] + s->fate[SHADE__BEFORE_NEAR] &&
        s->fate[SHADE__BEHIND])
        return "The whole mesh lies behind the eye: the camera of state.view looks down -z in its "
               "own space; check state.view and state.model.";
    if (s->triangles == s->fate[SHADE__BEFORE_NEAR])
        return "Every triangle lies nearer than the near plane of state.projection, or behind the "
               "eye of state.view; move near in, or the eye back.";
    if (depth) return "Every triangle lies outside of what state.view and state.projection show, "
                      "before near, beyond far or beside the picture.";
    if (shade__depth_varies(s)) return NULL;    /* a mesh of several: it may stand there */
    return shade__is_rigid(&view)
               ? "The whole mesh lies beside the picture; check state.model, and where state.view "
                 "looks."
               : "The whole mesh lies beside the picture; state.view scales, but it must only turn "
                 "and move.";
}
static const char *shade__why_culled(const shade__survey *s)
{
    if (shade__eye_inside(s))
        return "raster.cull leaves out every triangle in view, and the eye lies inside of the "
               "mesh's box: set state.view, or move the eye out.";
    if (s->state->raster.cull == SHADE_CULL_FRONT)
        return "raster.cull is SHADE_CULL_FRONT, and every triangle in view is front-facing; use "
               "SHADE_CULL_BACK or SHADE_CULL_NONE.";
    if (shade_mat4_determinant(s->scene.world_from_object) < 0)
        return "state.model mirrors, so that every triangle in view faces away and raster.cull "
               "leaves it out; mirror without a negative scale, or cull SHADE_CULL_FRONT.";
    return "raster.cull is SHADE_CULL_BACK, and every triangle in view faces away: front is "
           "counter-clockwise on the screen; reverse the winding, or use SHADE_CULL_NONE.";
}
static const char *shade__why_nothing(const shade__survey *s)
{
    const long long rejected = s->fate[SHADE__REJECTED];
    const long long facing = s->fate[SHADE__FRONT] + s->fate[SHADE__BACK];
    if (rejected && !s->triangles)
        return "mesh.positions hold NaN, infinite or huge numbers, or state.model, state.view and "
               "state.projection make such of them (beyond 1e30).";
    if (facing) return shade__why_culled(s);
    if (s->fate[SHADE__NO_AREA] && shade_mat4_determinant(s->scene.world_from_object) == 0)
        return "state.model scales by 0, so that no triangle has an area.";
    if (s->fate[SHADE__NO_AREA])
        return "No triangle in view has an area on the screen: the mesh is smaller than a pixel, "
               "seen edge-on, or its corners coincide; check mesh.positions and mesh.indices.";
    return shade__why_outside(s);
}

/* ---- triangles are drawn, but no pixel */

static const char *shade__why_depth(const shade__survey *s)
{
    const shade_raster *r = &s->state->raster;
    const int greater = r->depth_test == SHADE_COMPARE_GREATER ||
                        r->depth_test == SHADE_COMPARE_GREATER_EQUAL;
    if (s->nans == s->seen)
        return "target.depth holds NaN where the mesh is; call shade_clear before drawing.";
    if (r->depth_test == SHADE_COMPARE_EQUAL && (s->stats || s->untouched == s->seen))
        return "raster.depth_test is SHADE_COMPARE_EQUAL, and target.depth does not hold this "
               "mesh; draw its depth first.";
    if (!greater && s->zeros == s->seen)
        return "target.depth holds 0 where the mesh is, so that nothing is nearer: shade_clear was "
               "not called, or cleared depth to 0, which raster.depth_test GREATER wants.";
    if (greater && s->ones == s->seen)
        return "target.depth holds 1 where the mesh is, and raster.depth_test wants greater depth: "
               "call shade_clear with 0 for a reversed projection, else use SHADE_COMPARE_LESS.";
    if (!s->stats || s->vague > s->seen / 2) return NULL;
    if (s->held > s->seen / 2)
        return "target.depth already holds this mesh: call shade_clear before each frame, or draw "
               "a second pass with SHADE_COMPARE_LESS_EQUAL.";
    if (s->unbiased) return "raster.depth_bias pushes the mesh behind what target.depth holds.";
    if (!s->whole || shade__is_scattered(s)) return NULL;
    return "The mesh is hidden behind what target.depth holds: other meshes, or the frame before "
           "where shade_clear was not called.";
}
static const char *shade__why_no_fragment(const shade__survey *s)
{
    const float most = 1 - s->state->transparency;    /* alpha, but for texels beyond 1 */
    const int cut = s->points + s->seen ? 0 : s->cut, scattered = shade__is_scattered(s);
    const int sure = (s->stats != NULL) & s->whole & (s->cut > 8) & !scattered;
    const char *why = NULL;
    if (s->stats && s->stats->fragments > 0) return NULL;
    if (cut && ((s->state->alpha_cutoff > most) | sure))
        return "state.alpha_cutoff is above every alpha of the mesh, which is (1 - transparency) "
               "times that of diffuse_map; lower it.";
    if (s->seen && s->failed >= (s->stats ? s->seen - s->seen / 4 : s->seen))
        why = shade__why_depth(s);    /* beside an outline the buffer is free */
    if (why || !s->stats || !s->whole || (s->failed | s->cut | scattered)) return why;
    if (s->state->fragment && (s->target->color || s->state->alpha_cutoff > 0))
        return "No pixel is left: state.fragment discards all of them, or their alpha is below "
               "state.alpha_cutoff.";
    return "No triangle covers the centre of a pixel: the mesh is too small on the screen; check "
           "the scale of state.model and the distance of state.view.";
}

/* ---- there are pixels, but something of them is wrong */

static const char *shade__suspect_lamps(const shade_lighting *l)
{
    for (int i = 0; i < l->light_count; i++) {
        const shade_light *lamp = &l->lights[i];
        if (!shade__is_zero(lamp->spot_direction) && !shade__within(lamp->spot_cos_cutoff, 1.001f))
            return "A light's spot_cos_cutoff is outside of -1 .. 1: it is the cosine of the "
                   "angle, not the angle; make the light with shade_spot_light.";
    }
    return NULL;
}
/* -1: the projection and the view show the world mirrored; -1 for LESS with a projection whose
   depth falls with distance, and for GREATER with one whose depth rises. */
static const char *shade__suspect_order(const shade__survey *s)
{
    const shade_compare test = s->state->raster.depth_test;
    const int less = test == SHADE_COMPARE_LESS || test == SHADE_COMPARE_LESS_EQUAL;
    const int greater = test == SHADE_COMPARE_GREATER || test == SHADE_COMPARE_GREATER_EQUAL;
    const float slope = s->projection.col[3].z;
    if (!s->target->depth || s->drawn < 2 || s->state->raster.depth_read_only ||
        !shade__is_perspective(&s->projection))
        return NULL;
    if (less && slope > 0)
        return "state.projection is reversed, depth falls with distance, but raster.depth_test is "
               "SHADE_COMPARE_LESS: use SHADE_COMPARE_GREATER and clear depth to 0.";
    if (greater && slope < 0)
        return "raster.depth_test is SHADE_COMPARE_GREATER, but state.projection is not reversed, "
               "so that what is far hides what is near: use SHADE_COMPARE_LESS.";
    return NULL;
}
/* Is all of the mesh on one side of the plane of a triangle (1), or in it (2)? */
static int shade__one_side(const shade__survey *s, int triangle)
{
    const shade_mesh *m = s->mesh;
    const float near_enough = 1e-4f * shade_distance(s->low, s->high);
    float least = 0, most = 0;
    shade__corners c;
    shade_vec3 n;
    int above, below;
    shade__corners_of(s, triangle, &c);
    n = shade_face_normal(c.world[0], c.world[1], c.world[2]);
    for (int i = 0; i < shade__corner_count(m); i++) {
        const shade_vec3 p = shade__corner(m, (uint32_t)i);
        const shade_vec4 q = shade_mat4_transform(s->scene.world_from_object, shade__xyzw(p, 1));
        const float d = shade_dot(n, shade_sub(shade__xyz(q), c.world[0]));
        if (d < least) least = d;
        if (d > most) most = d;
    }
    above = least >= -near_enough;
    below = most <= near_enough;
    return above + below;
}
/* Can triangles that are drawn hide each other? */
static int shade__hides_itself(const shade__survey *s)
{
    const int triangles = shade__corner_count(s->mesh) / 3, every = (triangles - 1) / 32 + 1;
    const shade_cull cull = s->state->raster.cull;
    const int one_facing = (cull != 0) | !s->fate[SHADE__FRONT] | !s->fate[SHADE__BACK];
    for (int t = 0; t < triangles; t += every)
        if (shade__one_side(s, t) < (one_facing ? 1 : 2)) return 1;
    return 0;
}
/* A closed mesh has no sum of area vectors, a nearly closed one little.  1: it is wound
   counter-clockwise as seen from outside, -1: from inside, 0: it is open or flat. */
static int shade__winding(const shade__survey *s)
{
    const double sum = s->sum[0] * s->sum[0] + s->sum[1] * s->sum[1] + s->sum[2] * s->sum[2];
    const double least = 1e-3 * s->area * (double)shade_distance(s->low, s->high);
    if (!(sum <= 0.01 * s->area * s->area)) return 0;
    return (s->volume > least) - (s->volume < -least);
}
/* Are the front faces of the screen those inside?  An open mesh is judged by its normals. */
static int shade__is_inside_out(const shade__survey *s)
{
    const shade_mat4 view = shade__or_identity(s->state->view), *p = &s->projection;
    const int mirrored = (shade_mat4_determinant(view) < 0) !=
                         ((double)p->col[0].x * (double)p->col[1].y < 0);
    const int turned = mirrored != (shade_mat4_determinant(s->scene.world_from_object) < 0);
    const int winding = shade__winding(s);
    const long long wrong = turned ? s->with : s->against, right = s->with + s->against - wrong;
    if (s->state->raster.cull != SHADE_CULL_BACK || shade__eye_inside(s)) return 0;
    if (winding) return mirrored ? winding > 0 : winding < 0;
    return wrong > 9 * right + 8;
}
/* Do the normals of a closed mesh that is seen from outside point into it? */
static int shade__has_inward_normals(const shade__survey *s)
{
    const int flags = SHADE_FLAG_TWO_SIDED | SHADE_FLAG_TWO_SIDED_ABS;
    const int turned = shade_mat4_determinant(s->scene.world_from_object) < 0;
    const int winding = turned ? -shade__winding(s) : shade__winding(s);
    const long long wrong = winding > 0 ? s->against : s->with;
    const long long right = s->with + s->against - wrong;
    if (shade__eye_inside(s) || s->scene.face_normals || s->state->fragment ||
        (s->state->lighting.flags & (unsigned)flags) || !winding)
        return 0;
    return wrong > 9 * right + 8;
}
/* A material with a hue of its own may share a state with meshes that have a map. */
static int shade__is_grey(const shade_material *m)
{
    return !m || (m->diffuse.x == m->diffuse.y && m->diffuse.y == m->diffuse.z);
}
static const char *shade__suspect_picture(const shade__survey *s)
{
    const shade_draw_state *state = s->state;
    const shade_raster *r = &state->raster;
    const char *fault = shade__suspect_order(s);
    if (fault) return fault;
    if (s->fate[SHADE__REJECTED])
        return "Some triangles are left out, since mesh.positions hold NaN, infinite or huge "
               "numbers there.";
    if (shade__is_inside_out(s))
        return "The mesh is drawn inside out: its triangles are wound clockwise, or state.model, "
               "state.view or state.projection mirrors; reverse the winding or raster.cull.";
    if (shade__has_inward_normals(s))
        return "mesh.normals point into the mesh, so that it is lit from the wrong side; turn them "
               "round, or let shade_mesh_normals make them.";
    if (state->diffuse_map && !s->mesh->texcoords && !state->fragment &&
        shade__is_grey(state->material))
        return "state.diffuse_map is ignored, since mesh.texcoords is NULL.";
    if (!s->target->depth && r->blend == SHADE_BLEND_REPLACE && s->drawn > 1 &&
        shade__hides_itself(s))
        return "target.depth is NULL, so that the triangles drawn last hide those before them, not "
               "the near ones the far ones; give the target a depth buffer.";
    if (s->stats && s->stats->fragments && s->seen > 8 && s->untouched == s->seen &&
        !r->depth_read_only && !state->fragment && state->alpha_cutoff <= 0 && s->whole)
        return "target.depth holds nothing of this draw: shade_clear was called after it, or it "
               "went to another target.";
    return NULL;
}

/* ---- there are pixels, but no light on them */

/* The brightest channel at a point; NaN counts as dark, as it is stored. */
static float shade__brightness(const shade__survey *s, int i, const shade_lighting *l,
                               const shade_material *m, int bare, int turned)
{
    const shade_vec3 white = shade_v3(1, 1, 1), albedo = bare ? white : s->albedo[i];
    const shade_vec3 n = turned ? shade_neg(s->normal[i]) : s->normal[i];
    shade_material by = *m;
    shade_vec3 c;
    by.diffuse = shade_mul(by.diffuse, albedo);
    by.ambient = shade_mul(by.ambient, albedo);
    if (by.shininess > 4) by.shininess = 4;    /* no highlight hides between points */
    c = shade_lit(l, &by, s->scene.eye, s->point[i], n);
    return shade_max(shade_max(c, shade_v3(c.y, c.z, 0)), shade_v3(c.z, 0, 0)).x;
}
static int shade__is_lit(const shade__survey *s, const shade_lighting *l, const shade_material *m,
                         int bare, int turned)
{
    /* 1/255 of a display */
    const int linear = !s->target->srgb && s->target->format != SHADE_FORMAT_RGBA32F;
    const float least = linear ? 1 / 255.0f : 1 / 255.0f / 12.92f;
    for (int i = 0; i < s->points; i++)
        if (shade__brightness(s, i, l, m, bare, turned) >= least) return 1;
    return 0;
}
/* The same with the first lamps changed: without their cone, without attenuation. */
static int shade__is_lit_without(const shade__survey *s, const shade_material *m, int cone,
                                 int attenuation)
{
    shade_light lamp[SHADE__SUSPECTS];
    shade_lighting l = s->state->lighting;
    l.light_count = shade__min(l.light_count, SHADE__SUSPECTS);
    for (int i = 0; i < l.light_count; i++) {
        lamp[i] = l.lights[i];
        if (cone) lamp[i].spot_direction = shade_v3(0, 0, 0);
        if (attenuation) lamp[i].constant = lamp[i].linear = lamp[i].quadratic = 0;
    }
    l.lights = lamp;
    return shade__is_lit(s, &l, m, 0, 0);
}
/* Where the axis of a spotlight, or the shortest way from a lamp to the nearest point's plane,
   meets the mesh: a pool of light may be smaller than the distance of points. */
static void shade__take_pools(shade__survey *s)
{
    const shade_lighting *l = &s->state->lighting;
    for (int i = 0; i < l->light_count && i < SHADE__SUSPECTS; i++) {
        const shade_light *lamp = &l->lights[i];
        float least = FLT_MAX;
        shade_ray ray;
        shade_vec3 b;
        int triangle;
        if (lamp->position.w == 0) continue;
        ray.origin = shade_scale(shade__xyz(lamp->position), 1 / lamp->position.w);
        ray.direction = shade_normalize(lamp->spot_direction);
        for (int k = 0; k < s->points && shade__is_zero(lamp->spot_direction); k++) {
            const float d = shade_distance(ray.origin, s->point[k]);
            if (d >= least) continue;
            least = d;
            ray.direction = shade_neg(shade_normalize(s->normal[k]));
        }
        triangle = shade_pick(s->mesh, s->scene.world_from_object, ray, NULL, &b);
        if (triangle >= 0) {
            shade__corners c;
            shade__corners_of(s, triangle, &c);
            shade__take_point(s, triangle, &c, b, 1);
        }
    }
}
static const char *shade__why_lamps(const shade__survey *s, const shade_material *m)
{
    const shade_lighting *l = &s->state->lighting;
    int dark = 1, flat = 1;
    for (int i = 0; i < l->light_count; i++)
        dark &= shade__is_zero(l->lights[i].diffuse) && shade__is_zero(l->lights[i].specular);
    for (int i = 0; i < s->points; i++) flat &= shade__is_zero(s->normal[i]);
    if (l->light_count <= 0 && l->lights)
        return "lighting.light_count is 0 while lighting.lights is set, and lighting.ambient is "
               "dark; set light_count.";
    if (l->light_count <= 0)
        return "There is no light: lighting.lights is NULL and lighting.ambient is dark; add a "
               "light, or ambient light.";
    if (dark)
        return "The lights have no colour: diffuse and specular of every lighting.lights are zero.";
    if (flat)
        return "mesh.normals are zero, so that no lamp lights them; fill them by "
               "shade_mesh_normals, or make mesh.normals NULL.";
    if (shade__is_lit(s, l, m, 0, 1))
        return shade__eye_inside(s)
                   ? "The eye lies inside of the mesh's box and sees faces whose normals point "
                     "away from every lamp; check state.view, or move the eye out."
                   : "Every lamp is behind the faces in view, on the side that their normals point "
                     "away from: turn mesh.normals (without them the winding), move "
                     "light.position, or set SHADE_FLAG_TWO_SIDED.";
    if (shade__is_lit_without(s, m, 1, 0))
        return "No cone of the lights meets what is in view; check spot_direction and "
               "spot_cos_cutoff, the cosine of an angle in radians.";
    if (shade__is_lit_without(s, m, 0, 1))
        return "Attenuation leaves less than 1/255 of every light; lower its constant, linear or "
               "quadratic, or raise the light's diffuse and specular.";
    return "No lamp reaches the faces in view; check light.position, spot_direction, attenuation, "
           "and colours.";
}
static const char *shade__why_dark(const shade__survey *s)
{
    const shade_material white = { { 0, 0, 0 }, { 1, 1, 1 }, { 1, 1, 1 }, { 0, 0, 0 }, 0 };
    const shade_material *m = s->state->material ? s->state->material : &white;
    const shade_raster *r = &s->state->raster;
    const int black = shade__is_zero(m->emission) && shade__is_zero(m->ambient) &&
                      shade__is_zero(m->diffuse) && shade__is_zero(m->specular);
    shade_lighting l = s->state->lighting;
    if (shade__is_lit(s, &l, m, 0, 0)) return NULL;
    /* shadows are blended over a ground, outlines are back faces: black is meant */
    if (black && (r->blend == SHADE_BLEND_OVER || r->cull == SHADE_CULL_FRONT)) return NULL;
    if (black)
        return "state.material is black: emission, ambient, diffuse and specular are all zero; set "
               "diffuse, or pass NULL for white.";
    l.terms = 0;
    if (shade__is_lit(s, &l, m, 0, 0))
        return "lighting.terms leaves out every term that would be seen; 0 means all.";
    l.model = SHADE_MODEL_BLINN_PHONG;
    if (shade__is_lit(s, &l, m, 0, 0))
        return "lighting.model leaves out the terms that would be seen: SHADE_MODEL_EMISSIVE has "
               "material.emission alone, SHADE_MODEL_AMBIENT ambient light too.";
    if (shade__is_lit(s, &l, m, 1, 0))
        return s->mesh->colors ? "mesh.colors, or the texels of state.diffuse_map, are black where "
                                 "the mesh is in view."
                               : "The texels of state.diffuse_map are black where the mesh is in "
                                 "view; check mesh.texcoords and the picture.";
    if (shade__is_lit(s, &l, &white, 0, 0))
        return "state.material reflects nothing of the light that there is: lamps need diffuse or "
               "specular, lighting.ambient needs material.ambient.";
    return shade__why_lamps(s, m);
}
static const char *shade__why_invisible(const shade__survey *s)
{
    const shade_blend blend = s->state->raster.blend;
    if (s->state->transparency >= 1)
        return "state.transparency is 1, which is invisible; 0 is opaque.";
    if (blend != SHADE_BLEND_REPLACE && s->clear == shade__max(s->points, 1))
        return "The alpha of state.diffuse_map is 0 where the mesh is in view, so that "
               "raster.blend leaves nothing of it.";
    return NULL;
}

/* ---- the order of the questions: what stands first explains what follows */

static SHADE__COLD const char *shade__why_drawn(shade__survey *s)
{
    const int pixels = !s->stats || s->stats->fragments > 0;
    const char *why;
    shade__take_faces(s);
    why = shade__why_no_fragment(s);
    if (!why) why = shade__suspect_lamps(&s->state->lighting);
    if (!why) why = shade__suspect_picture(s);
    if (why || !s->target->color || s->state->fragment || !pixels) return why;
    why = shade__why_invisible(s);
    if (why || !s->points || s->state->raster.blend == SHADE_BLEND_ADD) return why;
    shade__take_pools(s);
    return shade__why_dark(s);
}
static SHADE__COLD const char *shade__why(shade__survey *s)
{
    const shade_target *t = s->target;
    const int all[4] = { 0, 0, t->width, t->height };
    const shade_mat4 view = shade__or_identity(s->state->view);
    s->whole = shade__clip_rectangle(t, s->clip);
    for (int k = 0; k < 4; k++) s->whole &= s->clip[k] == all[k];
    shade__scene_of(t, s->mesh, s->state, &s->scene);
    s->projection = shade__or_identity(s->state->projection);
    s->camera = shade_mat4_inverse(view);
    s->clip_from_world = shade__mat4_product(&s->projection, &view);
    s->eye = shade_mat4_transform_point(s->camera, shade_v3(0, 0, 0));
    shade__count_fates(s);
    if (s->boxes)
        return "A box of mesh.chunks does not hold its triangles, which may be skipped by it: make "
               "the chunks again with shade_mesh_chunks after the positions have changed.";
    if (!s->drawn) return shade__why_nothing(s);
    return shade__why_drawn(s);
}
SHADEDEF const char *shade_explain(const shade_target *target, const shade_mesh *mesh,
                                   const shade_draw_state *state, const shade_stats *stats)
{
    const char *why = shade__refusal(target, mesh, state);
    shade_target picture;
    shade__survey s;
    int clip[4];
    if (!why) why = shade__suspect_mesh(mesh);
    if (!why) why = shade__suspect_matrices(state);
    if (why) return why;
    picture = *target;
    picture.row_offset = picture.row_count = 0;
    if (!shade__clip_rectangle(&picture, clip))
        return "The clip rectangle is empty or outside of the picture: check target.clip_x, "
               "clip_y, clip_width and clip_height; all four zero mean everywhere.";
    SHADE__ZERO(s);
    s.target = target;
    s.mesh = mesh;
    s.state = state;
    s.stats = stats;
    why = shade__why(&s);
    return why ? why : "";
}

/*------------------------------------------------------------------------------------------ >>image
   Pictures as binary PPM: "P6", width, height, 255, then R, G, B bytes from the top row on, as a
   target of 8 bits would have them.
                                                                                         >>refs */

static char *shade__decimal(char *p, int n)
{
    if (n > 9) p = shade__decimal(p, n / 10);
    *p = (char)('0' + n % 10);
    return p + 1;
}
SHADEDEF shade_result shade_encode_ppm(shade_write_fn *sink, void *user,
                                       const shade_target *target)
{
    uint8_t pixels[4 * SHADE__BLOCK], rgb[3 * SHADE__BLOCK];
    char head[32] = "P6\n", *p = head + 3;
    shade_target from, to;
    shade_result result = sink ? shade__check_picture(target) : SHADE_ERROR_ARGUMENT;
    if (result) return result;
    p = shade__decimal(p, target->width);
    *p++ = ' ';
    p = shade__decimal(p, shade__rows_held(target));
    SHADE_MEMCPY(p, "\n255\n", 5);
    if (sink(user, head, (size_t)(p + 5 - head))) return SHADE_ERROR_IO;
    from = to = *target;
    from.srgb = 0;
    to.format = SHADE_FORMAT_RGBA8;
    to.srgb = target->srgb && target->format == SHADE_FORMAT_RGBA32F;
    for (int y = 0; y < shade__rows_held(target); y++) {
        for (int x = 0; x < target->width; x += SHADE__BLOCK) {
            int n = shade__min(SHADE__BLOCK, target->width - x);
            shade__resolve_block(&to, &from, 1, x, y + target->row_offset, n, pixels);
            for (int i = 0; i < n; i++) SHADE_MEMCPY(rgb + 3 * i, pixels + 4 * i, 3);
            if (sink(user, rgb, (size_t)n * 3)) return SHADE_ERROR_IO;
        }
    }
    return SHADE_OK;
}

#ifndef SHADE_NO_STDIO
static int shade__write_file(void *user, const void *bytes, size_t size)
{
    return fwrite(bytes, 1, size, (FILE *)user) != size;
}
SHADEDEF shade_result shade_write_ppm(const char *path, const shade_target *target)
{
    FILE *file;
    shade_result result = path ? shade__check_picture(target) : SHADE_ERROR_ARGUMENT;
    if (result) return result;
    file = fopen(path, "wb");
    if (!file) return SHADE_ERROR_IO;
    result = shade_encode_ppm(shade__write_file, file, target);
    if (fclose(file)) result = SHADE_ERROR_IO;
    return result;
}
#endif

SHADE__END
#endif /* SHADE__IMPLEMENTED */
#endif /* SHADE_IMPLEMENTATION */

/*------------------------------------------------------------------------------------------- >>refs
   [Blinn77]      J. F. Blinn, "Models of Light Reflection for Computer Synthesized Pictures",
                  SIGGRAPH 1977, Computer Graphics 11(2), 192-198.
   [Gooch98]      A. Gooch, B. Gooch, P. Shirley, E. Cohen, "A Non-Photorealistic Lighting Model
                  for Automatic Technical Illustration", SIGGRAPH 1998, 447-452.
   [Gouraud71]    H. Gouraud, "Continuous Shading of Curved Surfaces", IEEE Transactions on
                  Computers C-20(6), 623-629.
   [Greene93]     N. Greene, M. Kass, G. Miller, "Hierarchical Z-Buffer Visibility", SIGGRAPH 1993.
   [IEC61966]     IEC 61966-2-1:1999, the sRGB colour space.
   [Kadlec10]     J. Kadlec, "Improving the fast inverse square root", 2010: the constant and its
                  Newton step.
   [Kilgard94]    The materials of teapots.c, Silicon Graphics 1993, M. J. Kilgard 1994.
   [Moller97]     T. Moeller, B. Trumbore, "Fast, Minimum Storage Ray/Triangle Intersection",
                  Journal of Graphics Tools 2(1), 21-28.
   [Phong75]      B. T. Phong, "Illumination for Computer Generated Pictures", Communications of the
                  ACM 18(6), 311-317.
   [Pineda88]     J. Pineda, "A Parallel Algorithm for Polygon Rasterization", SIGGRAPH 1988,
                  Computer Graphics 22(4), 17-20.
   [Sutherland74] I. E. Sutherland, G. W. Hodgman, "Reentrant Polygon Clipping", Communications of
                  the ACM 17(1), 32-42.
   [Thurmer98]    G. Thuermer, C. A. Wuethrich, "Computing Vertex Normals from Polygonal Facets",
                  Journal of Graphics Tools 3(1), 43-46.
   [Williams83]   L. Williams, "Pyramidal Parametrics", SIGGRAPH 1983, Computer Graphics 17(3),
                  1-11.
*/

/*---------------------------------------------------------------------------------------- >>history
   1.1    2026-11-22   An error for each kind of argument; shade_explain; shade_rows, which takes
                       the place of the last arguments of shade_lit_lanes; fragment shaders of draw
                       states; chunks; SHADE_FORMAT_A8; shade_radians.  From here on the pixels
                       are part of the interface: each 1.x draws those of 1.1, to the bit.
   1.0    2026-11-21   First numbered version: the equations of >>model for points and packets,
                       meshes, programmable shaders, textures, lines, normals, edges, rays.
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
