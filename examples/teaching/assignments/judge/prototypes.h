/* prototypes.h - the functions of a task, as its page has them.  The compiler reads it before the
   student's file, too.  TASK is the number of the task. */
#if TASK == 1
float lambert(shade_vec3 N, shade_vec3 L);
#elif TASK == 2
shade_vec3 mirror(shade_vec3 L, shade_vec3 N);
#elif TASK == 3
shade_vec3 halfway(shade_vec3 L, shade_vec3 V);
float phong(shade_vec3 N, shade_vec3 L, shade_vec3 V, float n);
#elif TASK == 4
float attenuation(float a, float b, float c, float r);
#elif TASK == 5
float spot(shade_vec3 L, shade_vec3 aim, float cos_cutoff, float e);
#elif TASK == 6
shade_mat3 normal_matrix(shade_mat4 model);
#elif TASK == 7
int covers(const int x[3], const int y[3], int i, int j);
#elif TASK == 8
float depth_at(const float w[3], const float z[3], const float abc[3]);
#elif TASK == 9
shade_vec2 texture_at(const float w[3], const shade_vec2 uv[3], const float abc[3]);
#elif TASK == 10
shade_vec3 iteration_four(const shade_lighting *lighting, const shade_material *m, shade_vec3 eye,
                          shade_vec3 P, shade_vec3 N);
#elif TASK == 11
shade_vec3 color_at(const float x[3], const float y[3], const shade_vec3 color[3], float px,
                    float py);
#elif TASK == 12
float level(float du_dx, float dv_dx, float du_dy, float dv_dy, float size);
float bilinear(const float texel[16], float u, float v);
#elif TASK == 13
int clip_near(const shade_vec4 corner[3], shade_vec4 kept[4]);
#elif TASK == 14
shade_vec3 bumped(shade_vec3 N, shade_vec3 T, shade_vec3 texel);
#elif TASK == 15
int lit(const float depth[16], shade_mat4 lamp, shade_vec3 P, float bias);
#endif
