/* readme_prelude.h - what fragments of the README may speak of without declaring it. */
#ifndef README_PRELUDE_H
#define README_PRELUDE_H
#include "shade.h"

#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

static int width, height, index_count, vertex_count;
static uint32_t *pixels, *indices;
static float *depth, *positions, *normals;
static void *uniforms;
static shade_target target, band;
static shade_mesh mesh;
static shade_draw_state state;
static shade_lighting lighting;
static shade_light light, sun, lamp, lights[8];
static shade_material material, gold;
static shade_pipeline pipeline;
static shade_stats stats;
static shade_result result;
static shade_mat4 model, view, projection;
static shade_vec3 P, N, L, V, H, eye, color;
static void vertex_shader(const void *u, const shade_vertex_ids *SHADE_RESTRICT in,
                          shade_vertices *SHADE_RESTRICT out);
static void fragment_shader(const void *u, const shade_fragments *SHADE_RESTRICT in,
                            shade_colors *SHADE_RESTRICT out);
#endif
