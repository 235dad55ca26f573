/* picked.h - lenses, and what a screen shows of a scene of triangles: the oracle of picks. */
#ifndef PICKED_H
#define PICKED_H

/* The picture of the numbers of a mesh's triangles, as a fragment shader sees them, says at each
   pixel what the ray through it meets. */
static inline void pick_ids(const void *uniforms, const shade_fragments *SHADE_RESTRICT in,
                     shade_colors *SHADE_RESTRICT out)
{
    (void)uniforms;
    for (int i = 0; i < SHADE_LANES; i++) out->color[0][i] = (float)in->primitive[i] + 1;
}

enum { PICK_W = 40, PICK_H = 30 };

/* The triangles of a scene as the screen has them. */
typedef struct picked_screen {
    shade_vec4 clip[PICK_VERTICES];
    ref_triangle seen[PICK_TRIANGLES];
    int usable[PICK_TRIANGLES], triangles;
} picked_screen;

static inline void picked_screen_of(picked_screen *p, const pick_scene *s,
                                    shade_mat4 clip_from_mesh)
{
    p->triangles = pick_triangles(s);
    for (int k = 0; k < PICK_VERTICES; k++) {
        shade_vec3 at = s->position[k];
        p->clip[k] = shade_mat4_transform(clip_from_mesh, shade_v4(at.x, at.y, at.z, 1));
    }
    for (int n = 0; n < p->triangles; n++) {
        uint32_t v[3];
        for (int k = 0; k < 3; k++)
            v[k] = s->mesh.indices ? s->index[3 * n + k] : (uint32_t)(3 * n + k);
        p->usable[n] = ref_triangle_of(&p->seen[n], &p->clip[v[0]], &p->clip[v[1]],
                                       &p->clip[v[2]], PICK_W, PICK_H);
    }
}

/* 0 at the edge of a triangle, and where two depths are nearer to each other than 1e-4 and what
   corners snapped by 1/256 pixel change; reversed: the greatest depth is the nearest. */
static inline int picked_for_sure(const picked_screen *p, double X, double Y, int reversed)
{
    double nearest = 1, end_of_nearest = 1, second = 1;
    int covered = 0;
    for (int n = 0; n < p->triangles; n++) {
        const ref_triangle *t = &p->seen[n];
        int in = p->usable[n] ? ref_covers(t, X, Y, 0.02, 0, 0) : 0;
        if (in < 0) return 0;
        if (in == 0) continue;
        covered = 1;
        double at = ref_depth(t, X, Y, 0), z = reversed ? 1 - at : at;
        double snap = (fabs(ref_depth(t, X + 1, Y, 0) - at) + fabs(ref_depth(t, X, Y + 1, 0) - at));
        if (z < nearest - 1e-12) {
            second = fmin(second, 2 * nearest - end_of_nearest);
            nearest = z;
            end_of_nearest = z + snap / 256;
        } else if (z > nearest + 1e-12) {
            second = fmin(second, z - snap / 256);
        }
    }
    return !covered || second - end_of_nearest >= 1e-4;
}

/* A perspective whose eye is where the view has it, or, with w = 1 - z / k, k in front of it. */
static inline shade_mat4 random_lens(void)
{
    const float aspect = rnd_log(0.5, 2), fovy = rnd_float(0.2, 2);
    const float l = rnd_float(-0.9, -0.1), b = rnd_float(-0.9, -0.1);
    shade_mat4 p = shade_mat4_perspective(fovy, aspect, 0.1f, 100);
    switch (rnd_int(0, 3)) {
    case 0: return p;
    case 1: return shade_mat4_perspective_reversed(fovy, aspect, 0.1f);
    case 2: return shade_mat4_frustum(l, l + 1, b, b + 1, 1, 100);
    default:
        p = shade_mat4_scaling(shade_v3(1 / aspect, 1, -0.1f));
        p.col[2].w = -1 / rnd_log(0.5, 2);
        return p;
    }
}

/* ---------------------------------------------------------------------------------------- rays */

typedef struct ray_camera {
    shade_mat4 view, projection;
    int width, height;
    int ortho, reversed; /* infinite, z to [0, w] */
} ray_camera;

enum { RAY_WIDTH = 80, RAY_HEIGHT = 60, RAY_TRIANGLES = 800 };

typedef struct ray_scene {
    shade_vec3 position[3 * RAY_TRIANGLES], normal[3 * RAY_TRIANGLES], color[3 * RAY_TRIANGLES];
    shade_vec4 clip[3 * RAY_TRIANGLES], id[RAY_TRIANGLES];
    ref_triangle seen[RAY_TRIANGLES];
    int count;
    shade_light lights[2];
    shade_material material;
    shade_mesh mesh;
    shade_draw_state state;
    ray_camera camera;
} ray_scene;

static inline void ray_triangle(ray_scene *s, const d3 p[3], const d3 n[3])
{
    for (int k = 0; k < 3; k++) {
        int at = 3 * s->count + k;
        s->position[at] = d3_round(p[k]);
        s->normal[at] = d3_round(n[k]);
        d3 c = d3_scale(p[k], 0.06); /* smooth, so that slivers have no steep colours */
        s->color[at] = shade_v3((float)(0.6 + c.x), (float)(0.6 + c.y), (float)(0.6 + c.z));
    }
    s->count++;
}

static inline void ray_ball(ray_scene *s, d3 centre, double radius, int across, int up)
{
    for (int j = 0; j < up; j++)
        for (int i = 0; i < across; i++) {
            d3 n[4], p[4];
            for (int k = 0; k < 4; k++) {
                double a = 6.283185307179586 * ((i + (k == 1 || k == 2)) % across) / across;
                double b = 3.141592653589793 * ((j + k / 2 + 0.0) / up - 0.5);
                if (j + k / 2 == 0 || j + k / 2 == up) a = 0;
                n[k] = d3_of(cos(b) * cos(a), sin(b), -cos(b) * sin(a));
                p[k] = d3_add(centre, d3_scale(n[k], radius));
            }
            d3 pa[3] = { p[0], p[1], p[2] }, na[3] = { n[0], n[1], n[2] };
            d3 pb[3] = { p[0], p[2], p[3] }, nb[3] = { n[0], n[2], n[3] };
            if (j > 0) ray_triangle(s, pa, na);
            if (j < up - 1) ray_triangle(s, pb, nb);
        }
}

#endif
