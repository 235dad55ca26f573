/* solutions.c - the assignments that calls of the library solve, in the starters' signatures. */
#include "shade.h"

float lambert(shade_vec3 N, shade_vec3 L) { return shade_lambert(N, L); }

shade_vec3 mirror(shade_vec3 L, shade_vec3 N) { return shade_mirror(L, N); }

shade_vec3 halfway(shade_vec3 L, shade_vec3 V) { return shade_halfway(L, V); }

float phong(shade_vec3 N, shade_vec3 L, shade_vec3 V, float n)
{
    return shade_phong_specular(N, L, V, n);
}

float attenuation(float a, float b, float c, float r) { return shade_attenuation(a, b, c, r); }

float spot(shade_vec3 L, shade_vec3 aim, float cos_cutoff, float e)
{
    return shade_spot(L, aim, cos_cutoff, e);
}

shade_mat3 normal_matrix(shade_mat4 model) { return shade_normal_matrix(model); }

/* The pixel of a triangle that is drawn: corners in 1/256 pixel, into 8 x 8 pixels. */
static void vertex(const void *uniforms, const shade_vertex_ids *SHADE_RESTRICT in,
                   shade_vertices *SHADE_RESTRICT out)
{
    const float *corners = (const float *)uniforms;
    SHADE_EACH_LANE(k)
    {
        out->clip[0][k] = corners[in->index[k]] / 1024 - 1;
        out->clip[1][k] = 1 - corners[3 + in->index[k]] / 1024;
        out->clip[3][k] = 1;
    }
}
static void white(const void *uniforms, const shade_fragments *SHADE_RESTRICT in,
                  shade_colors *SHADE_RESTRICT out)
{
    (void)uniforms;
    (void)in;
    SHADE_EACH_LANE(k) { out->color[0][k] = 1; }
}
int covers(const int x[3], const int y[3], int i, int j)
{
    const float corners[6] = { (float)x[0], (float)x[1], (float)x[2],
                               (float)y[0], (float)y[1], (float)y[2] };
    uint32_t pixels[8 * 8] = { 0 };
    const shade_target target = { .width = 8, .height = 8, .color = pixels };
    const shade_pipeline pipeline = { .vertex = vertex, .fragment = white, .uniforms = corners };
    shade_draw(&target, &pipeline, NULL, 3, 3, NULL);
    return (pixels[8 * j + i] & 255) != 0;
}

shade_vec3 iteration_four(const shade_lighting *lighting, const shade_material *m, shade_vec3 eye,
                          shade_vec3 P, shade_vec3 N)
{
    return shade_lit(lighting, m, eye, P, N);
}
