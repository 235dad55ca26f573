/* inline.c - what of 1.1's interface no library shows: inline functions, and the values of
   enumerators that no argument has the type of.  This file compiles, or the interface shrank. */
#include "shade.h"

#define HAS(value, number) typedef char has_##value[(value) == (number) ? 1 : -1]
HAS(SHADE_FLAG_TWO_SIDED, 1);
HAS(SHADE_FLAG_TWO_SIDED_ABS, 2);
HAS(SHADE_FLAG_UNGATED_SPECULAR, 4);
HAS(SHADE_FLAG_WEIGHTED_SPECULAR, 8);
HAS(SHADE_FLAG_ATTENUATED_AMBIENT, 16);
HAS(SHADE_FLAG_INFINITE_VIEWER, 32);
HAS(SHADE_TERM_EMISSION, 1);
HAS(SHADE_TERM_AMBIENT, 2);
HAS(SHADE_TERM_DIFFUSE, 4);
HAS(SHADE_TERM_SPECULAR, 8);
HAS(SHADE_LANES, 128);
HAS(SHADE_MAX_VARYINGS, 16);

shade_vec2 (*const old_v2)(float, float) = shade_v2;
shade_vec3 (*const old_v3)(float, float, float) = shade_v3;
shade_vec4 (*const old_v4)(float, float, float, float) = shade_v4;
shade_vec3 (*const old_add)(shade_vec3, shade_vec3) = shade_add;
shade_vec3 (*const old_sub)(shade_vec3, shade_vec3) = shade_sub;
shade_vec3 (*const old_mul)(shade_vec3, shade_vec3) = shade_mul;
shade_vec3 (*const old_scale)(shade_vec3, float) = shade_scale;
shade_vec3 (*const old_madd)(shade_vec3, float, shade_vec3) = shade_madd;
shade_vec3 (*const old_neg)(shade_vec3) = shade_neg;
float (*const old_dot)(shade_vec3, shade_vec3) = shade_dot;
shade_vec3 (*const old_cross)(shade_vec3, shade_vec3) = shade_cross;
float (*const old_length)(shade_vec3) = shade_length;
float (*const old_distance)(shade_vec3, shade_vec3) = shade_distance;
shade_vec3 (*const old_normalize)(shade_vec3) = shade_normalize;
shade_vec3 (*const old_lerp)(shade_vec3, shade_vec3, float) = shade_lerp;
shade_vec3 (*const old_min)(shade_vec3, shade_vec3) = shade_min;
shade_vec3 (*const old_max)(shade_vec3, shade_vec3) = shade_max;
shade_vec3 (*const old_clamp)(shade_vec3, shade_vec3, shade_vec3) = shade_clamp;
shade_vec3 (*const old_reflect)(shade_vec3, shade_vec3) = shade_reflect;
shade_vec3 (*const old_mirror)(shade_vec3, shade_vec3) = shade_mirror;
shade_vec3 (*const old_halfway)(shade_vec3, shade_vec3) = shade_halfway;
shade_vec3 (*const old_face_normal)(shade_vec3, shade_vec3, shade_vec3) = shade_face_normal;
shade_vec2 (*const old_add2)(shade_vec2, shade_vec2) = shade_add2;
shade_vec2 (*const old_sub2)(shade_vec2, shade_vec2) = shade_sub2;
shade_vec2 (*const old_scale2)(shade_vec2, float) = shade_scale2;
float (*const old_dot2)(shade_vec2, shade_vec2) = shade_dot2;
shade_vec2 (*const old_lerp2)(shade_vec2, shade_vec2, float) = shade_lerp2;
shade_vec4 (*const old_add4)(shade_vec4, shade_vec4) = shade_add4;
shade_vec4 (*const old_sub4)(shade_vec4, shade_vec4) = shade_sub4;
shade_vec4 (*const old_scale4)(shade_vec4, float) = shade_scale4;
float (*const old_dot4)(shade_vec4, shade_vec4) = shade_dot4;
shade_vec4 (*const old_lerp4)(shade_vec4, shade_vec4, float) = shade_lerp4;
shade_vec3 (*const old_mat3_transform)(shade_mat3, shade_vec3) = shade_mat3_transform;
shade_vec4 (*const old_mat4_transform)(shade_mat4, shade_vec4) = shade_mat4_transform;
shade_mat3 (*const old_mat3_mul)(shade_mat3, shade_mat3) = shade_mat3_mul;
shade_mat4 (*const old_mat4_mul)(shade_mat4, shade_mat4) = shade_mat4_mul;
shade_vec3 (*const old_mat4_transform_point)(shade_mat4, shade_vec3) = shade_mat4_transform_point;
shade_vec3 (*const old_mat4_transform_direction)(shade_mat4, shade_vec3) =
    shade_mat4_transform_direction;
shade_mat3 (*const old_mat3_inverse_transpose)(shade_mat3) = shade_mat3_inverse_transpose;
