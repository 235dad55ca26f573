/* 1.1.h - the interface of version 1.1, but for what a library does not show, which inline.c
   has.  abi.sh compares today's library with one of these functions, which do nothing there. */
#include <stddef.h>
#include <stdint.h>

typedef struct shade_vec2 {
    float x, y;
} shade_vec2;
typedef struct shade_vec3 {
    float x, y, z;
} shade_vec3;
typedef struct shade_vec4 {
    float x, y, z, w;
} shade_vec4;
typedef struct shade_mat3 {
    shade_vec3 col[3];
} shade_mat3;
typedef struct shade_mat4 {
    shade_vec4 col[4];
} shade_mat4;
typedef enum shade_result {
    SHADE_OK = 0,
    SHADE_ERROR_ARGUMENT,
    SHADE_ERROR_TARGET,
    SHADE_ERROR_MESH,
    SHADE_ERROR_STATE,
    SHADE_ERROR_LIGHTS,
    SHADE_ERROR_TEXTURE,
    SHADE_ERROR_INDEX,
    SHADE_ERROR_CAPACITY,
    SHADE_ERROR_IO
} shade_result;
typedef struct shade_material {
    shade_vec3 emission;
    shade_vec3 ambient;
    shade_vec3 diffuse;
    shade_vec3 specular;
    float shininess;
} shade_material;
typedef struct shade_light {
    shade_vec4 position;
    shade_vec3 ambient;
    shade_vec3 diffuse;
    shade_vec3 specular;
    float constant, linear, quadratic;
    shade_vec3 spot_direction;
    float spot_exponent;
    float spot_cos_cutoff;
} shade_light;
typedef enum shade_model {
    SHADE_MODEL_BLINN_PHONG = 0,
    SHADE_MODEL_PHONG,
    SHADE_MODEL_LAMBERT,
    SHADE_MODEL_AMBIENT,
    SHADE_MODEL_EMISSIVE,
    SHADE_MODEL_COOL_TO_WARM
} shade_model;
typedef struct shade_lighting {
    const shade_light *lights;
    int light_count;
    shade_vec3 ambient;
    shade_model model;
    unsigned flags;
    unsigned terms;
    shade_vec3 cool, warm;
} shade_lighting;
typedef struct shade_terms {
    shade_vec3 emission, ambient, diffuse, specular;
} shade_terms;
typedef enum shade_format {
    SHADE_FORMAT_RGBA8 = 0,
    SHADE_FORMAT_BGRA8,
    SHADE_FORMAT_RGB565,
    SHADE_FORMAT_RGB565_SWAPPED,
    SHADE_FORMAT_RGBA32F,
    SHADE_FORMAT_A8
} shade_format;
typedef enum shade_wrap { SHADE_WRAP_REPEAT = 0, SHADE_WRAP_CLAMP, SHADE_WRAP_MIRROR } shade_wrap;
typedef enum shade_filter {
    SHADE_FILTER_BILINEAR = 0,
    SHADE_FILTER_NEAREST,
    SHADE_FILTER_TRILINEAR
} shade_filter;
typedef struct shade_texture {
    const void *pixels;
    int width, height, stride;
    shade_format format;
    int srgb;
    shade_wrap wrap_u, wrap_v;
    shade_filter filter;
    const struct shade_texture *mipmaps;
    int mipmap_count;
} shade_texture;
typedef struct shade_target {
    int width, height;
    int stride;
    shade_format format;
    void *color;
    float *depth;
    int srgb;
    int dither;
    int clip_x, clip_y;
    int clip_width, clip_height;
    int row_offset, row_count;
} shade_target;
typedef enum shade_interpolation {
    SHADE_INTERPOLATION_PERSPECTIVE = 0,
    SHADE_INTERPOLATION_AFFINE,
    SHADE_INTERPOLATION_CONSTANT
} shade_interpolation;
typedef enum shade_cull { SHADE_CULL_NONE = 0, SHADE_CULL_BACK, SHADE_CULL_FRONT } shade_cull;
typedef enum shade_compare {
    SHADE_COMPARE_LESS = 0,
    SHADE_COMPARE_LESS_EQUAL,
    SHADE_COMPARE_GREATER,
    SHADE_COMPARE_GREATER_EQUAL,
    SHADE_COMPARE_EQUAL,
    SHADE_COMPARE_ALWAYS
} shade_compare;
typedef enum shade_blend { SHADE_BLEND_REPLACE = 0, SHADE_BLEND_OVER, SHADE_BLEND_ADD } shade_blend;
typedef struct shade_raster {
    shade_cull cull;
    shade_compare depth_test;
    shade_blend blend;
    int depth_read_only;
    int depth_zero_to_one;
    float depth_bias;
} shade_raster;
typedef enum shade_shading {
    SHADE_SHADING_PER_FRAGMENT = 0,
    SHADE_SHADING_PER_VERTEX,
    SHADE_SHADING_PER_FACE
} shade_shading;
typedef struct shade_stats {
    long long triangles;
    long long skipped;
    long long culled;
    long long clipped;
    long long rejected;
    long long drawn;
    long long fragments;
} shade_stats;
#pragma GCC push_options

#pragma GCC optimize("no-unsafe-math-optimizations", "no-finite-math-only")

#pragma GCC optimize("no-associative-math", "no-reciprocal-math", "signed-zeros")

shade_light shade_directional_light(shade_vec3 direction_of_travel, shade_vec3 color);
shade_light shade_point_light(shade_vec3 position, shade_vec3 color);
shade_light shade_spot_light(shade_vec3 position, shade_vec3 aim, float cutoff_radians,
                             float exponent, shade_vec3 color);
float shade_light_at(const shade_light *light, shade_vec3 point, shade_vec3 *to_light,
                     float *distance);
void shade_light_at_lanes(const shade_light *light, const float *point, float *to_light,
                          float *amount);
shade_terms shade_evaluate(const shade_lighting *lighting, const shade_material *material,
                           shade_vec3 eye, shade_vec3 point, shade_vec3 normal);
shade_vec3 shade_lit(const shade_lighting *lighting, const shade_material *material, shade_vec3 eye,
                     shade_vec3 point, shade_vec3 normal);
typedef struct shade_rows {
    const float *position;
    const float *normal;
    const float *albedo;
    const float *specular;
    const float *visibility;
} shade_rows;
void shade_lit_lanes(const shade_lighting *lighting, const shade_material *material, shade_vec3 eye,
                     const shade_rows *rows, float *rgb);
float shade_lambert(shade_vec3 normal, shade_vec3 to_light);
float shade_phong_specular(shade_vec3 normal, shade_vec3 to_light, shade_vec3 to_eye,
                           float exponent);
float shade_blinn_phong_specular(shade_vec3 normal, shade_vec3 to_light, shade_vec3 to_eye,
                                 float exponent);
float shade_attenuation(float a, float b, float c, float r);
float shade_spot(shade_vec3 to_light, shade_vec3 aim, float cos_cutoff, float exponent);
shade_vec3 shade_brdf(const shade_material *material, shade_model model, shade_vec3 normal,
                      shade_vec3 to_light, shade_vec3 to_eye);
shade_vec3 shade_cool_to_warm(shade_vec3 normal, shade_vec3 to_light, shade_vec3 cool,
                              shade_vec3 warm);
float shade_blinn_exponent(float phong_exponent);
float shade_power(float x, float n);
typedef enum shade_preset {
    SHADE_PRESET_EMERALD = 0,
    SHADE_PRESET_JADE,
    SHADE_PRESET_OBSIDIAN,
    SHADE_PRESET_PEARL,
    SHADE_PRESET_RUBY,
    SHADE_PRESET_TURQUOISE,
    SHADE_PRESET_BRASS,
    SHADE_PRESET_BRONZE,
    SHADE_PRESET_CHROME,
    SHADE_PRESET_COPPER,
    SHADE_PRESET_GOLD,
    SHADE_PRESET_SILVER,
    SHADE_PRESET_BLACK_PLASTIC,
    SHADE_PRESET_CYAN_PLASTIC,
    SHADE_PRESET_GREEN_PLASTIC,
    SHADE_PRESET_RED_PLASTIC,
    SHADE_PRESET_WHITE_PLASTIC,
    SHADE_PRESET_YELLOW_PLASTIC,
    SHADE_PRESET_BLACK_RUBBER,
    SHADE_PRESET_CYAN_RUBBER,
    SHADE_PRESET_GREEN_RUBBER,
    SHADE_PRESET_RED_RUBBER,
    SHADE_PRESET_WHITE_RUBBER,
    SHADE_PRESET_YELLOW_RUBBER,
    SHADE_PRESET_COUNT
} shade_preset;
shade_material shade_preset_material(shade_preset preset);
const char *shade_preset_name(shade_preset preset);
shade_vec3 shade_linear_from_srgb(shade_vec3 display);
shade_vec3 shade_srgb_from_linear(shade_vec3 linear);
shade_vec3 shade_rgb(uint32_t rrggbb);
shade_material shade_linear_material(shade_material display);
const char *shade_result_string(shade_result result);
shade_result shade_clear(const shade_target *target, shade_vec4 color, float depth);
typedef int shade_write_fn(void *user, const void *bytes, size_t size);
shade_result shade_encode_ppm(shade_write_fn *sink, void *user, const shade_target *target);
shade_result shade_write_ppm(const char *path, const shade_target *target);
shade_result shade_resolve(const shade_target *out, const shade_target *in, int factor);
shade_vec4 shade_sample(const shade_texture *texture, float u, float v, float lod);
void shade_sample_lanes(const shade_texture *texture, const float *u, const float *v,
                        const float *lod, float *rgba);
int shade_mipmap_count(int width, int height);
size_t shade_mipmap_bytes(int width, int height, shade_format format);
shade_result shade_build_mipmaps(shade_texture *texture, shade_texture *levels, void *memory,
                                 size_t bytes);
typedef struct shade_vertex_ids {
    int count;
    uint32_t index[128];
} shade_vertex_ids;
typedef struct shade_vertices {
    __attribute__((aligned(64))) float clip[4][128];
    float varying[16][128];
} shade_vertices;
typedef struct shade_fragments {
    int count;
    __attribute__((aligned(64))) float x[128];
    float y[128];
    float z[128];
    float varying[16][128];
    uint32_t primitive[128];
    uint32_t front[128];
    float lod[128];
} shade_fragments;
typedef struct shade_colors {
    __attribute__((aligned(64))) float color[4][128];
    uint32_t discard[128];
} shade_colors;
typedef void shade_vertex_shader(const void *uniforms, const shade_vertex_ids *restrict in,
                                 shade_vertices *restrict out);
typedef void shade_fragment_shader(const void *uniforms, const shade_fragments *restrict in,
                                   shade_colors *restrict out);
typedef struct shade_pipeline {
    shade_vertex_shader *vertex;
    shade_fragment_shader *fragment;
    const void *uniforms;
    int varyings;
    shade_interpolation interpolation;
    shade_raster raster;
    int may_discard;
    const shade_texture *lod_texture;
    int lod_varying;
} shade_pipeline;
shade_result shade_draw(const shade_target *target, const shade_pipeline *pipeline,
                        const uint32_t *indices, int index_count, int vertex_count,
                        shade_stats *stats);
typedef struct shade_mesh {
    const float *positions;
    int position_stride;
    const float *normals;
    int normal_stride;
    const float *texcoords;
    int texcoord_stride;
    const float *colors;
    int color_stride;
    int vertex_count;
    const uint32_t *indices;
    int index_count;
    const struct shade_chunk *chunks;
    int chunk_count;
} shade_mesh;
typedef struct shade_chunk {
    shade_vec3 low, high;
    int first, count;
} shade_chunk;
typedef struct shade_draw_state {
    shade_mat4 model, view, projection;
    const shade_material *material;
    shade_lighting lighting;
    shade_shading shading;
    const shade_texture *diffuse_map;
    float transparency;
    float alpha_cutoff;
    shade_raster raster;
    shade_fragment_shader *fragment;
    const void *uniforms;
} shade_draw_state;
shade_result shade_draw_mesh(const shade_target *target, const shade_mesh *mesh,
                             const shade_draw_state *state, shade_stats *stats);
const char *shade_explain(const shade_target *target, const shade_mesh *mesh,
                          const shade_draw_state *state, const shade_stats *stats);
int shade_chunk_count(int index_count, int triangles);
shade_result shade_mesh_chunks(const shade_mesh *mesh, int triangles, shade_chunk *chunks,
                               int capacity, uint32_t *indices);
int shade_box_visible(const shade_target *target, shade_mat4 clip_from_object,
                      int depth_zero_to_one, shade_vec3 low, shade_vec3 high);
typedef enum shade_cap { SHADE_CAP_BUTT = 0, SHADE_CAP_SQUARE } shade_cap;
typedef struct shade_line_state {
    shade_mat4 clip_from_points;
    float width;
    shade_cap cap;
    shade_vec4 color;
    shade_raster raster;
} shade_line_state;
shade_result shade_draw_lines(const shade_target *target, const shade_vec3 *points, int point_count,
                              const shade_line_state *state, shade_stats *stats);
shade_result shade_mesh_normals(const shade_mesh *mesh, shade_vec3 *normals);
size_t shade_mesh_corner_normals_bytes(const shade_mesh *mesh);
shade_result shade_mesh_corner_normals(const shade_mesh *mesh, float cos_crease,
                                       shade_vec3 *normals, void *memory, size_t bytes);
typedef struct shade_edge {
    uint32_t a, b;
    int32_t triangle[2];
} shade_edge;
shade_result shade_mesh_edges(const shade_mesh *mesh, shade_edge *edges, int capacity, int *count);
int shade_is_silhouette(shade_vec3 to_eye, shade_vec3 n0, shade_vec3 n1);
int shade_is_crease(shade_vec3 n0, shade_vec3 n1, float threshold);
typedef struct shade_ray {
    shade_vec3 origin, direction;
} shade_ray;
shade_ray shade_pixel_ray(shade_mat4 view, shade_mat4 projection, int width, int height, float x,
                          float y);
int shade_intersect(shade_ray ray, shade_vec3 a, shade_vec3 b, shade_vec3 c, float *t,
                    shade_vec3 *barycentric);
int shade_pick(const shade_mesh *mesh, shade_mat4 model, shade_ray ray, float *t,
               shade_vec3 *barycentric);
shade_mat3 shade_mat3_identity(void);
shade_mat3 shade_mat3_from_mat4(shade_mat4 m);
shade_mat3 shade_mat3_transpose(shade_mat3 m);
float shade_mat3_determinant(shade_mat3 m);
shade_mat3 shade_mat3_inverse(shade_mat3 m);
shade_mat4 shade_mat4_identity(void);
shade_mat4 shade_mat4_transpose(shade_mat4 m);
float shade_mat4_determinant(shade_mat4 m);
shade_mat4 shade_mat4_inverse(shade_mat4 m);
shade_mat4 shade_mat4_translation(shade_vec3 v);
shade_mat4 shade_mat4_scaling(shade_vec3 v);
float shade_radians(float degrees);
shade_mat4 shade_mat4_rotation(float radians, shade_vec3 axis);
shade_mat4 shade_mat4_look_at(shade_vec3 eye, shade_vec3 center, shade_vec3 up);
shade_mat4 shade_mat4_perspective(float fovy, float aspect, float near_z, float far_z);
shade_mat4 shade_mat4_perspective_reversed(float fovy, float aspect, float near_z);
shade_mat4 shade_mat4_frustum(float l, float r, float b, float t, float n, float f);
shade_mat4 shade_mat4_ortho(float l, float r, float b, float t, float n, float f);
shade_mat3 shade_normal_matrix(shade_mat4 m);
