/* mathgl.c - one ball by MathGL (Debian: libmgl-dev).  Reads 9 numbers: size, ambient light,
   colour 3, at 3, brightness; writes R, G, B from the top left.

   cc -O2 mathgl.c -lmgl -lm -o mathgl */
#include <math.h>
#include <mgl2/mgl_cf.h>
#include <stdio.h>

int main(void)
{
    enum { N = 601 }; /* of the front: normals of a pole would be wrong */
    float v[9];
    char color[20];
    HMGL gr;
    HMDT x = mgl_create_data_size(N, N, 1);
    HMDT y = mgl_create_data_size(N, N, 1);
    HMDT z = mgl_create_data_size(N, N, 1);
    for (int i = 0; i < 9; i++)
        if (scanf("%f", &v[i]) != 1) return 1;
    gr = mgl_create_graph((int)v[0], (int)v[0]);
    for (int j = 0; j < N; j++)
        for (int i = 0; i < N; i++) {
            const double u = tan(1.4 * (2.0 * i / (N - 1) - 1)),
                         w = tan(1.4 * (2.0 * j / (N - 1) - 1));
            const double r = sqrt(u * u + w * w + 1);
            mgl_data_set_value(x, u / r, i, j, 0);
            mgl_data_set_value(y, w / r, i, j, 0);
            mgl_data_set_value(z, 1 / r, i, j, 0);
        }
    mgl_set_quality(gr, 2);
    mgl_clf_rgb(gr, 0, 0, 0);
    mgl_set_ranges(gr, -1, 1, -1, 1, -1, 1);
    mgl_set_light(gr, 1);
    mgl_set_ambbr(gr, v[1]);
    for (int i = 1; i < 10; i++) mgl_set_light_n(gr, i, 0);
    mgl_add_light_ext(gr, 0, v[5], v[6], v[7], 'w', v[8], 0);
    mgl_set_light_n(gr, 0, 1);
    snprintf(color, sizeof color, "{x%02x%02x%02x}", (int)(255 * v[2] + .5f),
             (int)(255 * v[3] + .5f), (int)(255 * v[4] + .5f));
    mgl_surf_xy(gr, x, y, z, color, "");
    mgl_finish(gr);
    fwrite(mgl_get_rgb(gr), 1, 3 * (size_t)v[0] * (size_t)v[0], stdout);
    return 0;
}
