/* stand.h - turns a mesh upright, whichever axis is up in its file. */
#ifndef MODEL_STAND_H
#define MODEL_STAND_H

#include "../shared/mesh.h"
#include <string.h>

/* The rows of a rotation that takes an upright axis (x y z -x -y -z) to +y, then turns about +y */
static inline void upright_rows(int up, float turn, double row[3][3])
{
    /* axis k of the picture is sign * axis of the model */
    static const int axis[6][3] = { { 1, 0, 2 }, { 0, 1, 2 }, { 0, 2, 1 },
                                    { 1, 0, 2 }, { 0, 1, 2 }, { 0, 2, 1 } };
    static const double sign[6][3] = { { -1, 1, 1 }, { 1, 1, 1 },   { 1, 1, -1 },
                                       { 1, -1, 1 }, { -1, -1, 1 }, { 1, -1, 1 } };
    shade_mat4 m = shade_mat4_rotation(turn, shade_v3(0, 1, 0));
    float c[16];
    memcpy(c, &m, sizeof c);
    for (int i = 0; i < 3; i++)
        for (int k = 0; k < 3; k++) row[i][k] = 0;
    for (int i = 0; i < 3; i++)
        for (int k = 0; k < 3; k++) row[i][axis[up][k]] += (double)c[4 * k + i] * sign[up][k];
}

static inline void rotate_rows(float *v, size_t n, double row[3][3])
{
    for (size_t i = 0; i < n; i++, v += 3) {
        double x = (double)v[0], y = (double)v[1], z = (double)v[2];
        for (int k = 0; k < 3; k++) v[k] = (float)(row[k][0] * x + row[k][1] * y + row[k][2] * z);
    }
}

/* The mesh upright, turned, and one unit large about the origin */
static inline void mesh_stand(owned_mesh *m, int up, float turn)
{
    double row[3][3];
    size_t n = (size_t)m->view.vertex_count;
    upright_rows(up, turn, row);
    mesh_normalize(m, 0);
    rotate_rows(m->positions, n, row);
    rotate_rows(m->normals, n, row);
}
#endif
