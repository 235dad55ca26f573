/* scenes.c - the scenes.  Each is a function that fills the struct shade.h draws from, under the
   GLSL of its equation: read one against the other.  The names in both are those of >>model in
   shade.h; lamp, attenuation, spot and toward stand in gl.c. */
#include "scenes.h"
#include <math.h>
#include <string.h>

/* ----------------------------------------------------------------------------------- geometry */

static void put(shape *m, shade_vec3 p, shade_vec3 n, float u, float v)
{
    int at = m->vertex_count++;
    float *P = m->positions + 3 * at, *N = m->normals + 3 * at, *C = m->colors + 3 * at;
    P[0] = p.x;
    P[1] = p.y;
    P[2] = p.z;
    N[0] = n.x;
    N[1] = n.y;
    N[2] = n.z;
    m->texcoords[2 * at] = u;
    m->texcoords[2 * at + 1] = v;
    C[0] = 0.55f + 0.45f * sinf(9 * u);
    C[1] = 0.55f + 0.45f * sinf(7 * v + 1);
    C[2] = 0.55f + 0.45f * sinf(5 * u + 11 * v);
}

static void corner3(shape *m, int a, int b, int c)
{
    uint32_t *to = m->indices + m->index_count;
    to[0] = (uint32_t)a;
    to[1] = (uint32_t)b;
    to[2] = (uint32_t)c;
    m->index_count += 3;
}

static void cells(shape *m, int rows, int columns, int first)    /* counter-clockwise in u, v */
{
    for (int i = 0; i < rows; i++) {
        for (int j = 0; j < columns; j++) {
            int a = first + i * (columns + 1) + j, c = a + columns + 1;
            corner3(m, a, a + 1, c + 1);
            corner3(m, a, c + 1, c);
        }
    }
}

/* A ring around the y axis; its parts hide one another and never meet. */
static void torus(shape *m, int rows, int columns)
{
    const double turn = 6.283185307179586;
    for (int i = 0; i <= rows; i++) {
        for (int j = 0; j <= columns; j++) {
            double a = turn * (i % rows) / rows, b = turn * (j % columns) / columns;
            double r = 1.4 + 0.7 * cos(b);
            put(m, shade_v3((float)(r * sin(a)), (float)(0.7 * sin(b)), (float)(r * cos(a))),
                shade_v3((float)(cos(b) * sin(a)), (float)sin(b), (float)(cos(b) * cos(a))),
                (float)i / (float)rows, (float)j / (float)columns);
        }
    }
    for (int i = 0; i < rows; i++) {
        for (int j = 0; j < columns; j++) {
            int a = i * (columns + 1) + j, c = a + columns + 1;
            corner3(m, a, c, c + 1);
            corner3(m, a, c + 1, a + 1);
        }
    }
}

/* A cloth y = f(x, z) that shows both of its sides. */
static void cloth(shape *m, int side)
{
    for (int i = 0; i <= side; i++)
        for (int j = 0; j <= side; j++) {
            double u = (double)j / side, v = (double)i / side, x = 4 * u - 2, z = 2 - 4 * v;
            double y = 0.55 * sin(2.1 * x + 0.3) * cos(1.3 * z);
            double dx = 0.55 * 2.1 * cos(2.1 * x + 0.3) * cos(1.3 * z);
            double dz = -0.55 * 1.3 * sin(2.1 * x + 0.3) * sin(1.3 * z);
            put(m, shade_v3((float)x, (float)y, (float)z),
                shade_v3((float)-dx, 1, (float)-dz), (float)u, (float)v);
        }
    cells(m, side, side, 0);
}

/* The square |x|, |z| <= half of the plane y = height, texels of the map one length wide */
static void floor_of(shape *m, float half, float height, int pieces, float length)
{
    for (int i = 0; i <= pieces; i++)
        for (int j = 0; j <= pieces; j++) {
            float x = half * (2 * (float)j / (float)pieces - 1);
            float z = half * (1 - 2 * (float)i / (float)pieces);
            put(m, shade_v3(x, height, z), shade_v3(0, 1, 0), x / (length * MAP_SIDE),
                z / (length * MAP_SIDE));
        }
    cells(m, pieces, pieces, 0);
}

/* Overlapping triangles, each in a plane z of its own */
static void layers(shape *m, int count)
{
    for (int k = 0; k < count; k++) {
        float a = 2.4f * (float)k, z = 1 - 2.0f * (float)((7 * k) % count) / (float)count;
        for (int j = 0; j < 3; j++, a += 2.0f) {
            float x = 0.5f * sinf(3.1f * (float)k) + 1.5f * cosf(a);
            put(m, shade_v3(x, 0.4f * cosf(1.7f * (float)k) + 1.2f * sinf(a), z),
                shade_v3(0, 0, 1), 0.13f * (float)k, 0.31f * (float)k + 0.05f * (float)j);
        }
        corner3(m, 3 * k, 3 * k + 1, 3 * k + 2);
    }
    m->has_colors = 1;
}

/* -------------------------------------------------------------------------------------- state */

static draw *add_draw(scene *s)
{
    draw *d = &s->draws[s->draw_count++];
    d->state.view = s->draws[0].state.view;
    d->state.projection = s->draws[0].state.projection;
    d->state.lighting = s->draws[0].state.lighting;
    d->material = shade_preset_material(SHADE_PRESET_BRONZE);
    return d;
}

static void camera(scene *s, shade_vec3 eye, shade_vec3 center, float fovy)
{
    shade_draw_state *state = &s->draws[0].state;
    s->eye = eye;
    state->view = shade_mat4_look_at(eye, center, shade_v3(0, 1, 0));
    state->projection = shade_mat4_perspective(fovy, (float)WIDTH / HEIGHT, 0.5f, 60);
}

/* The usual look: a torus, tilted, seen from above */
static draw *usual(scene *s, const char *name, shade_model model)
{
    draw *d = add_draw(s);
    s->name = name;
    torus(&d->mesh, 40, 24);
    camera(s, shade_v3(0.3f, 2.6f, 4.1f), shade_v3(0.07f, 0.05f, 0), 0.85f);
    d->state.model = shade_mat4_rotation(0.4f, shade_v3(1, 0.3f, 0.6f));
    d->state.lighting.model = model;
    d->state.lighting.ambient = shade_v3(0.2f, 0.25f, 0.3f);
    d->material = shade_preset_material(SHADE_PRESET_GOLD);
    d->material.emission = shade_v3(0.03f, 0.01f, 0.05f);
    return d;
}

static void sun(scene *s)
{
    s->lights[s->light_count++] = shade_directional_light(shade_v3(-1, -1.6f, -0.8f),
                                                          shade_v3(0.8f, 0.75f, 0.7f));
}

static shade_light *lamp(scene *s, shade_vec3 at, shade_vec3 color)
{
    shade_light *l = &s->lights[s->light_count++];
    *l = shade_point_light(at, color);
    l->ambient = shade_scale(color, 0.05f);
    l->constant = 0.4f;
    l->linear = 0.12f;
    l->quadratic = 0.03f;
    return l;
}

static void checked_map(scene *s, shade_filter filter)
{
    shade_texture *t = &s->map;
    unsigned char *to = (unsigned char *)s->texels;
    for (int y = 0; y < MAP_SIDE; y++) {
        for (int x = 0; x < MAP_SIDE; x++, to += 4) {
            int dark = ((x >> 2) + (y >> 2)) & 1;
            to[0] = (unsigned char)(dark ? 40 + 5 * x : 250 - 3 * y);
            to[3] = 255;
            to[1] = (unsigned char)(dark ? 60 + (x * y) % 90 : 210);
            to[2] = (unsigned char)(7 * y);
        }
    }
    t->pixels = s->texels;
    t->width = t->height = MAP_SIDE;
    t->filter = filter;
    if (filter == SHADE_FILTER_TRILINEAR)
        shade_build_mipmaps(t, s->levels, s->level_texels, sizeof s->level_texels);
    s->has_map = 1;
}

/* ------------------------------------------------------------------------------------- models */

/* iteration zero: k_e */
static const char emissive[] =
    "vec3 lit(vec3 P, vec3 N, vec3 albedo) { return k_e; }\n";
static void scene_emissive(scene *s)
{
    usual(s, "emissive", SHADE_MODEL_EMISSIVE)->material.emission = shade_v3(0.9f, 0.5f, 0.2f);
    s->equation = emissive;
    sun(s);
}

/* iteration one: k_e + k_a (I_a + sum of I_La) */
static const char ambient[] =
    "vec3 lit(vec3 P, vec3 N, vec3 albedo) {\n"
    "  vec3 I = k_e + albedo * k_a * I_a;\n"
    "  for (int j = 0; j < LIGHTS; j++) I += albedo * k_a * light[j].I_La;\n"
    "  return I;\n"
    "}\n";
static void scene_ambient(scene *s)
{
    draw *d = usual(s, "ambient, vertex colours", SHADE_MODEL_AMBIENT);
    s->equation = ambient;
    d->mesh.has_colors = 1;
    d->material.ambient = shade_v3(0.8f, 0.7f, 0.9f);
    d->state.lighting.ambient = shade_v3(0.6f, 0.6f, 0.5f);
    lamp(s, shade_v3(3, 3, 3), shade_v3(1, 1, 2));
    lamp(s, shade_v3(-3, 2, 1), shade_v3(2, 0, 0));
}

/* iteration two: + k_d I_d (N.L) where it is positive */
static const char lambert[] =
    "vec3 lit(vec3 P, vec3 N, vec3 albedo) {\n"
    "  vec3 I = k_e + albedo * k_a * I_a;\n"
    "  for (int j = 0; j < LIGHTS; j++) {\n"
    "    vec3 l = toward(light[j], P), L = normalize(l);\n"
    "    I += albedo * k_a * light[j].I_La;\n"
    "    I += attenuation(light[j], length(l)) * spot(light[j], L) *\n"
    "         albedo * k_d * light[j].I_d * max(dot(N, L), 0.0);\n"
    "  }\n"
    "  return I;\n"
    "}\n";
static void scene_lambert(scene *s)
{
    draw *d = usual(s, "Lambert, sun, vertex colours", SHADE_MODEL_LAMBERT);
    s->equation = lambert;
    d->mesh.has_colors = 1;
    d->material.diffuse = shade_v3(0.9f, 0.95f, 1);
    sun(s);
}

/* iterations three and four */
static const char blinn_phong[] =
    "vec3 lit(vec3 P, vec3 N, vec3 albedo) {\n"
    "  vec3 V = normalize(eye - P), I = k_e + albedo * k_a * I_a;\n"
    "  for (int j = 0; j < LIGHTS; j++) {\n"
    "    vec3 l = toward(light[j], P), L = normalize(l), H = normalize(L + V);\n"
    "    float fade = attenuation(light[j], length(l)) * spot(light[j], L);\n"
    "    float B = dot(N, L) > 0.0 ? 1.0 : 0.0;\n"
    "    I += albedo * k_a * light[j].I_La;\n"
    "    I += fade * B * (albedo * k_d * light[j].I_d * dot(N, L) +\n"
    "                     k_s * light[j].I_s * pow(max(dot(N, H), 0.0), n));\n"
    "  }\n"
    "  return I;\n"
    "}\n";
static void scene_blinn_phong(scene *s)
{
    usual(s, "Blinn-Phong, sun", SHADE_MODEL_BLINN_PHONG);
    s->equation = blinn_phong;
    sun(s);
}

static void scene_lights(scene *s)
{
    usual(s, "sun, lamps that fade, spot", SHADE_MODEL_BLINN_PHONG);
    s->equation = blinn_phong;
    sun(s);
    lamp(s, shade_v3(2.5f, 1, 2), shade_v3(0.9f, 0.2f, 0.1f));
    lamp(s, shade_v3(-3, 1.5f, 1), shade_v3(0.1f, 0.4f, 1.3f));
    s->lights[s->light_count++] = shade_spot_light(
        shade_v3(0.5f, 4, 1), shade_v3(-0.1f, -4, -0.4f), 0.4f, 12, shade_v3(0.5f, 1.2f, 0.4f));
}

static void scene_spots(scene *s)
{
    draw *d = usual(s, "spots on a floor", SHADE_MODEL_BLINN_PHONG);
    memset(&d->mesh, 0, sizeof d->mesh);
    floor_of(&d->mesh, 6, 0, 1, 1);
    camera(s, shade_v3(0.4f, 5, 5.5f), shade_v3(0.1f, 0, 0.2f), 0.8f);
    memset(&d->state.model, 0, sizeof d->state.model);
    s->equation = blinn_phong;
    for (int k = 0; k < 4; k++) {
        float x = k & 1 ? 1.7f : -1.6f, z = k & 2 ? 1.3f : -1.4f;
        s->lights[s->light_count++] =
            shade_spot_light(shade_v3(x, 3, z), shade_v3(-0.2f * x, -3, 0.1f), 0.35f,
                             (float)(8 + 12 * k), shade_v3(0.4f + 0.3f * (float)k, 0.9f, 0.7f));
        s->lights[k].constant = 0.5f;
        s->lights[k].quadratic = 0.04f;
    }
}

/* Phong: R in place of H */
static const char phong[] =
    "vec3 lit(vec3 P, vec3 N, vec3 albedo) {\n"
    "  vec3 V = normalize(eye - P), I = k_e + albedo * k_a * I_a;\n"
    "  for (int j = 0; j < LIGHTS; j++) {\n"
    "    vec3 l = toward(light[j], P), L = normalize(l), R = reflect(-L, N);\n"
    "    float fade = attenuation(light[j], length(l)) * spot(light[j], L);\n"
    "    float B = dot(N, L) > 0.0 ? 1.0 : 0.0;\n"
    "    I += albedo * k_a * light[j].I_La;\n"
    "    I += fade * B * (albedo * k_d * light[j].I_d * dot(N, L) +\n"
    "                     k_s * light[j].I_s * pow(max(dot(R, V), 0.0), n));\n"
    "  }\n"
    "  return I;\n"
    "}\n";
static void scene_phong(scene *s)
{
    usual(s, "Phong, a lamp", SHADE_MODEL_PHONG)->material.shininess = 18;
    s->equation = phong;
    lamp(s, shade_v3(3, 4, 3), shade_v3(2, 2, 2));
}

/* [Gooch98] */
static const char cool_to_warm[] =
    "vec3 lit(vec3 P, vec3 N, vec3 albedo) {\n"
    "  vec3 L = normalize(toward(light[0], P));\n"
    "  return k_e + albedo * mix(cool, warm, (1.0 + dot(N, L)) / 2.0);\n"
    "}\n";
static void scene_cool_to_warm(scene *s)
{
    draw *d = usual(s, "cool to warm", SHADE_MODEL_COOL_TO_WARM);
    s->equation = cool_to_warm;
    d->mesh.has_colors = 1;
    d->state.lighting.cool = shade_v3(0.1f, 0.2f, 0.75f);
    d->state.lighting.warm = shade_v3(0.9f, 0.6f, 0.3f);
    sun(s);
}

/* SHADE_FLAG_TWO_SIDED: N toward the viewer first */
static const char two_sided[] =
    "vec3 lit(vec3 P, vec3 N, vec3 albedo) {\n"
    "  vec3 V = normalize(eye - P), I = k_e + albedo * k_a * I_a;\n"
    "  if (dot(N, V) < 0.0) N = -N;\n"
    "  for (int j = 0; j < LIGHTS; j++) {\n"
    "    vec3 L = normalize(toward(light[j], P)), H = normalize(L + V);\n"
    "    float B = dot(N, L) > 0.0 ? 1.0 : 0.0;\n"
    "    I += B * (albedo * k_d * light[j].I_d * dot(N, L) +\n"
    "              k_s * light[j].I_s * pow(max(dot(N, H), 0.0), n));\n"
    "  }\n"
    "  return I;\n"
    "}\n";
static void scene_two_sided(scene *s)
{
    draw *d = usual(s, "two-sided cloth, flat", SHADE_MODEL_BLINN_PHONG);
    memset(&d->mesh, 0, sizeof d->mesh);
    cloth(&d->mesh, 16);
    d->state.model = shade_mat4_rotation(1.2f, shade_v3(1, 0.2f, 0.1f));
    d->state.lighting.flags = SHADE_FLAG_TWO_SIDED;
    d->state.shading = SHADE_SHADING_PER_FACE;
    s->equation = two_sided;
    sun(s);
    s->lights[s->light_count++] = shade_directional_light(shade_v3(0.7f, 1, -1),
                                                          shade_v3(0.3f, 0.5f, 0.9f));
}

/* SHADE_FLAG_TWO_SIDED_ABS: |N.L| on the diffuse term alone */
static const char two_sided_abs[] =
    "vec3 lit(vec3 P, vec3 N, vec3 albedo) {\n"
    "  vec3 V = normalize(eye - P), I = k_e + albedo * k_a * I_a;\n"
    "  for (int j = 0; j < LIGHTS; j++) {\n"
    "    vec3 L = normalize(toward(light[j], P)), H = normalize(L + V);\n"
    "    float B = dot(N, L) > 0.0 ? 1.0 : 0.0;\n"
    "    I += albedo * k_d * light[j].I_d * abs(dot(N, L)) +\n"
    "         B * k_s * light[j].I_s * pow(max(dot(N, H), 0.0), n);\n"
    "  }\n"
    "  return I;\n"
    "}\n";
static void scene_two_sided_abs(scene *s)
{
    usual(s, "|N.L|", SHADE_MODEL_BLINN_PHONG)->state.lighting.flags = SHADE_FLAG_TWO_SIDED_ABS;
    s->equation = two_sided_abs;
    sun(s);
}

/* SHADE_FLAG_WEIGHTED_SPECULAR: k_s (N.L) (N.H)^n */
static const char weighted[] =
    "vec3 lit(vec3 P, vec3 N, vec3 albedo) {\n"
    "  vec3 V = normalize(eye - P), I = k_e + albedo * k_a * I_a;\n"
    "  for (int j = 0; j < LIGHTS; j++) {\n"
    "    vec3 l = toward(light[j], P), L = normalize(l), H = normalize(L + V);\n"
    "    float fade = attenuation(light[j], length(l)) * spot(light[j], L);\n"
    "    I += albedo * k_a * light[j].I_La;\n"
    "    I += fade * max(dot(N, L), 0.0) * (albedo * k_d * light[j].I_d +\n"
    "         k_s * light[j].I_s * pow(max(dot(N, H), 0.0), n));\n"
    "  }\n"
    "  return I;\n"
    "}\n";
static void scene_weighted(scene *s)
{
    usual(s, "specular weighted by N.L", SHADE_MODEL_BLINN_PHONG)->state.lighting.flags =
        SHADE_FLAG_WEIGHTED_SPECULAR;
    s->equation = weighted;
    lamp(s, shade_v3(2, 4, 3), shade_v3(2, 2, 2));
}

/* shade_rows.specular, from a fragment shader of the draw state: the colours of the vertices are
   those of the highlights alone */
static const char specular_row[] =
    "vec3 lit(vec3 P, vec3 N, vec3 tint) {\n"
    "  vec3 V = normalize(eye - P), I = k_e + k_a * I_a;\n"
    "  for (int j = 0; j < LIGHTS; j++) {\n"
    "    vec3 l = toward(light[j], P), L = normalize(l), H = normalize(L + V);\n"
    "    float fade = attenuation(light[j], length(l)) * spot(light[j], L);\n"
    "    float B = dot(N, L) > 0.0 ? 1.0 : 0.0;\n"
    "    I += k_a * light[j].I_La + fade * B * (k_d * light[j].I_d * dot(N, L) +\n"
    "         tint * k_s * light[j].I_s * pow(max(dot(N, H), 0.0), n));\n"
    "  }\n"
    "  return I;\n"
    "}\n";
static void tinted_highlights(const void *uniforms, const shade_fragments *SHADE_RESTRICT in,
                              shade_colors *SHADE_RESTRICT out)
{
    const scene *s = (const scene *)uniforms;
    const shade_draw_state *state = &s->draws[0].state;
    const shade_rows rows = { .position = in->varying[0], .normal = in->varying[3],
                              .specular = in->varying[6] };
    shade_lit_lanes(&state->lighting, state->material, s->eye, &rows, out->color[0]);
}

static void scene_specular_row(scene *s)
{
    draw *d = usual(s, "k_s by the pixel, shader of a state", SHADE_MODEL_BLINN_PHONG);
    s->equation = specular_row;
    d->mesh.has_colors = 1;
    d->material.specular = shade_v3(2, 2, 2);
    d->state.fragment = tinted_highlights;
    d->state.uniforms = s;
    sun(s);
    lamp(s, shade_v3(2, 4, 3), shade_v3(2, 2, 2));
}

/* ----------------------------------------------------------------------- shading and transforms */

static void scene_gouraud(scene *s)
{
    scene_lights(s);
    s->name = "Gouraud, four lights";
    s->draws[0].state.shading = SHADE_SHADING_PER_VERTEX;
}

static void scene_flat(scene *s)
{
    scene_lights(s);
    s->name = "flat, four lights, back culled";
    s->draws[0].state.shading = SHADE_SHADING_PER_FACE;
    s->draws[0].state.raster.cull = SHADE_CULL_BACK;
    s->draws[0].mesh.has_colors = 1;
}

static void scene_front_culled(scene *s)
{
    draw *d = usual(s, "front culled", SHADE_MODEL_BLINN_PHONG);
    s->equation = two_sided;
    d->state.lighting.flags = SHADE_FLAG_TWO_SIDED;
    d->state.raster.cull = SHADE_CULL_FRONT;
    d->state.lighting.terms = 0;
    sun(s);
}

/* gl.c has transpose(inverse(model)), shade.h has sign(det) times the cofactors */
static void scene_scaled(scene *s)
{
    draw *d = usual(s, "non-uniform scale, mirrored", SHADE_MODEL_BLINN_PHONG);
    s->equation = blinn_phong;
    d->state.model = shade_mat4_mul(shade_mat4_rotation(0.6f, shade_v3(1, 0.2f, 0.5f)),
                                    shade_mat4_scaling(shade_v3(-1.2f, 0.5f, 0.8f)));
    sun(s);
    lamp(s, shade_v3(-2, 3, 3), shade_v3(0.8f, 0.4f, 1));
}

/* ------------------------------------------------------------------------------------- buffers */

static const char painted[] = "vec3 lit(vec3 P, vec3 N, vec3 albedo) { return albedo; }\n";
static draw *paint(scene *s, const char *name, int count, float alpha)
{
    draw *d = usual(s, name, SHADE_MODEL_LAMBERT);
    s->equation = painted;
    memset(&d->mesh, 0, sizeof d->mesh);
    memset(&d->state.model, 0, sizeof d->state.model);
    layers(&d->mesh, count);
    camera(s, shade_v3(0.2f, 0.3f, 4), shade_v3(0, 0, 0), 0.8f);
    d->alpha = alpha;
    return d;
}

static void scene_less(scene *s) { paint(s, "depth LESS", 24, 1); }

static void scene_greater(scene *s)
{
    draw *d = paint(s, "depth GREATER, reversed", 24, 1);
    d->state.projection = shade_mat4_perspective_reversed(0.8f, (float)WIDTH / HEIGHT, 0.5f);
    d->state.raster.depth_zero_to_one = 1;
    d->state.raster.depth_test = SHADE_COMPARE_GREATER;
    s->clear_depth = 0;
}

/* Many layers need a picture of floats: in 8 bits each adds a rounding of 1/2. */
static void scene_over(scene *s)
{
    draw *d = paint(s, "blend OVER, 12 layers, floats", 12, 0.4f);
    d->state.raster.blend = SHADE_BLEND_OVER;
    d->state.raster.depth_test = SHADE_COMPARE_ALWAYS;
    s->format = SHADE_FORMAT_RGBA32F;
}

/* 1/2 (1 + 0.6 + 0.6^2) = 0.98 of rounding: two layers and the background */
static void scene_over_8(scene *s)
{
    draw *d = paint(s, "blend OVER, 2 layers, 8 bits", 2, 0.4f);
    d->state.raster.blend = SHADE_BLEND_OVER;
    d->state.raster.depth_test = SHADE_COMPARE_ALWAYS;
}

static void scene_add(scene *s)
{
    draw *d = paint(s, "blend ADD, depth kept, floats", 8, 0.1f);
    d->state.raster.blend = SHADE_BLEND_ADD;
    d->state.raster.depth_read_only = 1;
    s->format = SHADE_FORMAT_RGBA32F;
    for (int i = 0; i < 3 * d->mesh.vertex_count; i++) d->mesh.colors[i] *= 0.15f;
}

/* A floor and, in its plane but cut otherwise, a smaller one that only the bias brings forward;
   LESS on the same plane alone would be noise. */
static void scene_bias(scene *s)
{
    draw *d = usual(s, "depth bias", SHADE_MODEL_LAMBERT);
    s->equation = lambert;
    memset(&d->mesh, 0, sizeof d->mesh);
    memset(&d->state.model, 0, sizeof d->state.model);
    floor_of(&d->mesh, 3, 0, 1, 1);
    sun(s);
    d = add_draw(s);
    floor_of(&d->mesh, 1.5f, 0, 7, 1);
    d->material = shade_preset_material(SHADE_PRESET_RUBY);
    d->state.raster.depth_bias = -0.0005f;
    d->state.model = shade_mat4_rotation(0.5f, shade_v3(0, 1, 0));
}

/* ----------------------------------------------------------------------------------- clipping */

static void scene_near(scene *s)
{
    draw *d = usual(s, "near plane", SHADE_MODEL_BLINN_PHONG);
    s->equation = blinn_phong;
    camera(s, shade_v3(0.05f, 0.8f, 2.4f), shade_v3(0.6f, -0.1f, 0), 1.1f);
    d->state.projection = shade_mat4_perspective(1.1f, (float)WIDTH / HEIGHT, 1.1f, 60);
    sun(s);
}

/* corners some hundred pictures away, behind the eye and past the far plane */
static void scene_guard_band(scene *s)
{
    draw *d = usual(s, "guard band, far plane", SHADE_MODEL_BLINN_PHONG);
    s->equation = blinn_phong;
    memset(&d->mesh, 0, sizeof d->mesh);
    memset(&d->state.model, 0, sizeof d->state.model);
    floor_of(&d->mesh, 900, -1, 1, 1);
    camera(s, shade_v3(0.3f, 0.5f, 2), shade_v3(0.1f, 0, -0.5f), 0.9f);
    lamp(s, shade_v3(1, 2, -3), shade_v3(2, 1.6f, 1.2f));
}

/* ----------------------------------------------------------------------------------- textures */

static draw *textured(scene *s, const char *name, shade_filter filter)
{
    draw *d = usual(s, name, SHADE_MODEL_LAMBERT);
    memset(&d->mesh, 0, sizeof d->mesh);
    memset(&d->state.model, 0, sizeof d->state.model);
    d->mesh.has_texcoords = 1;
    s->equation = lambert;
    camera(s, shade_v3(0.3f, 1.6f, 3), shade_v3(0.1f, 0, 0.1f), 0.9f);
    d->material.diffuse = d->material.ambient = shade_v3(1, 1, 1);
    checked_map(s, filter);
    sun(s);
    return d;
}

static const char sampled[] =
    "uniform sampler2D map;\n"
    "vec4 texel(vec2 uv) { return textureLod(map, uv, 0.0); }\n";
static void scene_nearest(scene *s)
{
    /* texels of 20 pixels and more: the fewer borders, the fewer ties */
    floor_of(&textured(s, "nearest, perspective", SHADE_FILTER_NEAREST)->mesh, 4, 0, 1, 0.4f);
    s->seam = 0.4f;
    s->texel = sampled;
}

static void scene_bilinear(scene *s)
{
    floor_of(&textured(s, "bilinear, mirrored, clamped", SHADE_FILTER_BILINEAR)->mesh, 6, 0, 1,
             0.09f);
    s->map.wrap_u = SHADE_WRAP_MIRROR;
    s->map.wrap_v = SHADE_WRAP_CLAMP;
    s->texel = sampled;
}

/* GL may take its lod from differences over four pixels.  Here it is exact: u/w, v/w and 1/w are
   linear on the screen, so that their differences are their derivatives wherever they are taken. */
static const char exact_lod[] =
    "uniform sampler2D map;\n"
    "vec4 texel(vec2 uv) {\n"
    "  float q = gl_FragCoord.w;\n"
    "  vec2 size = vec2(textureSize(map, 0));\n"
    "  vec2 dx = size * (dFdx(uv * q) - uv * dFdx(q)) / q;\n"
    "  vec2 dy = size * (dFdy(uv * q) - uv * dFdy(q)) / q;\n"
    "  float lod = 0.5 * log2(max(dot(dx, dx), dot(dy, dy)));\n"
    "  return textureLod(map, uv, lod);\n"
    "}\n";
static void scene_trilinear(scene *s)
{
    floor_of(&textured(s, "trilinear, exact lod", SHADE_FILTER_TRILINEAR)->mesh, 20, 0, 1, 0.05f);
    s->texel = exact_lod;
}

/* [IEC61966] */
static const char encoded[] =
    "vec3 stored(vec3 rgb) {\n"
    "  vec3 c = clamp(rgb, 0.0, 1.0);\n"
    "  return mix(12.92 * c, 1.055 * pow(c, vec3(1.0 / 2.4)) - 0.055,\n"
    "             greaterThan(c, vec3(0.0031308)));\n"
    "}\n";
static void scene_srgb(scene *s)
{
    scene_lights(s);
    s->name = "sRGB target, four lights";
    s->stored = encoded;
    s->srgb = 1;
}

/* --------------------------------------------------------------------------- alpha and its uses */

/* The map as it is, with alpha: a soft spot of each 16 x 16 texels, or whole texels out of it. */
static void spots_of(scene *s, shade_format format, int holes)
{
    unsigned char *at = (unsigned char *)s->texels;
    for (int y = 0; y < MAP_SIDE; y++) {
        for (int x = 0; x < MAP_SIDE; x++, at += 4) {
            int dx = x % 16 - 7, dy = y % 16 - 7, away = dx * dx + dy * dy;
            unsigned char red = at[0];
            at[3] = (unsigned char)(away > 60 ? 50 : 255 - 3 * away);
            if (holes) at[3] = (unsigned char)((x / 2 + 3 * (y / 2)) % 5 < 2 ? 90 : 200);
            if (format == SHADE_FORMAT_BGRA8) {
                at[0] = at[2];
                at[2] = red;
            }
        }
    }
    s->map.format = format;
}

/* Opaque first, then what lets it through, its depth kept. */
static draw *over_a_torus(scene *s, const char *name, shade_blend blend)
{
    draw *d = textured(s, name, SHADE_FILTER_BILINEAR);
    shade_material torn = d->material;
    d->mesh.has_texcoords = 0;
    torus(&d->mesh, 40, 24);
    d->material = shade_preset_material(SHADE_PRESET_RUBY);
    s->texel = sampled;
    s->format = SHADE_FORMAT_RGBA32F;
    camera(s, shade_v3(0.2f, 3.4f, 4.2f), shade_v3(0, 0, 0), 0.8f);
    d = add_draw(s);
    d->material = torn;
    d->mesh.has_texcoords = 1;
    d->state.raster.blend = blend;
    d->state.raster.depth_read_only = 1;
    d->state.raster.depth_test = SHADE_COMPARE_LESS_EQUAL;
    d->state.model = shade_mat4_translation(shade_v3(0.1f, 0.9f, 0.5f));
    return d;
}

static void scene_glass(scene *s)
{
    draw *d = over_a_torus(s, "OVER, alpha of a BGRA8 map", SHADE_BLEND_OVER);
    spots_of(s, SHADE_FORMAT_BGRA8, 0);
    cloth(&d->mesh, 12);
    d->state.transparency = 0.3f;
}

static void scene_glow(scene *s)
{
    draw *d = over_a_torus(s, "ADD, alpha of a map", SHADE_BLEND_ADD);
    spots_of(s, SHADE_FORMAT_RGBA8, 0);
    cloth(&d->mesh, 12);
    d->state.transparency = 0.55f;
}

/* and, in 8 bits, through one layer: two roundings of 1/2, one of them times 1 - a */
static void scene_pane(scene *s)
{
    draw *d = over_a_torus(s, "OVER, transparency, Gouraud, BGRA8", SHADE_BLEND_OVER);
    d->mesh.has_texcoords = 0;
    s->format = SHADE_FORMAT_BGRA8;
    floor_of(&d->mesh, 1.1f, 0, 3, 0.1f);
    d->state.transparency = 0.6f;
    d->state.shading = SHADE_SHADING_PER_VERTEX;
    d->material = shade_preset_material(SHADE_PRESET_CYAN_PLASTIC);
    s->equation = lambert;
    d->material.specular = shade_v3(0, 0, 0);
}

/* Holes of whole texels, through which lies what is below; depth stays open there. */
static draw *sieve(scene *s, const char *name, shade_filter filter, float length)
{
    draw *d = textured(s, name, filter);
    floor_of(&d->mesh, 4, 0, 1, length);
    s->texel = sampled;
    d->state.alpha_cutoff = 0.5f;
    return d;
}

static void scene_cutoff(scene *s)
{
    draw *d = sieve(s, "alpha cutoff, nearest", SHADE_FILTER_NEAREST, 0.4f);
    spots_of(s, SHADE_FORMAT_RGBA8, 1);
    s->seam = 0.4f;
    d = add_draw(s);
    floor_of(&d->mesh, 6, -0.8f, 4, 1);
}

/* the same with the alpha's own value stored */
static void scene_cutoff_over(scene *s)
{
    draw *d = sieve(s, "alpha cutoff and OVER, bilinear", SHADE_FILTER_BILINEAR, 0.07f);
    spots_of(s, SHADE_FORMAT_RGBA8, 0);
    s->seam = 0.07f;
    d->state.raster.blend = SHADE_BLEND_OVER;
    d->state.transparency = 0.2f;
    d->state.alpha_cutoff = 0.3f;
    s->format = SHADE_FORMAT_RGBA32F;
}

/* ------------------------------------------------------------------------------ passes of depth */

/* Depth alone first, then only what equals it, in another shading each time: a bit of difference
   would tear holes. */
static void scene_passes(scene *s)
{
    scene_lights(s);
    s->name = "depth alone, LESS_EQUAL flat";
    s->draws[0].depth_only = 1;
    draw *d = add_draw(s);
    d->mesh = s->draws[0].mesh;
    d->state.model = s->draws[0].state.model;
    d->state.raster.depth_test = SHADE_COMPARE_LESS_EQUAL;
    d->state.shading = SHADE_SHADING_PER_FACE;
}

static void scene_more_passes(scene *s)
{
    scene_passes(s);
    s->name = "depth, EQUAL Gouraud, EQUAL ADD";
    s->draws[1].state.raster.depth_test = SHADE_COMPARE_EQUAL;
    s->draws[1].state.shading = SHADE_SHADING_PER_VERTEX;
    draw *d = add_draw(s);
    d->mesh = s->draws[0].mesh;
    d->state.model = s->draws[0].state.model;
    d->state.raster.depth_test = SHADE_COMPARE_EQUAL;
    d->state.raster.blend = SHADE_BLEND_ADD;
    d->state.transparency = 0.5f;
    s->format = SHADE_FORMAT_RGBA32F;
}

static void scene_bgra(scene *s)
{
    scene_lights(s);
    s->name = "BGRA8, sRGB, four lights";
    s->format = SHADE_FORMAT_BGRA8;
    s->stored = encoded;
    s->srgb = 1;
}

/* -------------------------------------------------------------------------------------- shadows */

/* Blinn-Phong, and the soft shadow of a ball before the lamps; ambient light is not hidden */
static const char shadowed[] =
    "float seen(lamp j, vec3 P) {\n"
    "  vec3 L = normalize(toward(j, P)), c = ball.xyz - P;\n"
    "  return clamp((length(c - dot(c, L) * L) - ball.w) / (0.5 * ball.w), 0.0, 1.0);\n"
    "}\n"
    "vec3 lit(vec3 P, vec3 N, vec3 albedo) {\n"
    "  vec3 V = normalize(eye - P), I = k_e + albedo * k_a * I_a;\n"
    "  for (int j = 0; j < LIGHTS; j++) {\n"
    "    vec3 l = toward(light[j], P), L = normalize(l), H = normalize(L + V);\n"
    "    float fade = attenuation(light[j], length(l)) * spot(light[j], L) * seen(light[j], P);\n"
    "    float B = dot(N, L) > 0.0 ? 1.0 : 0.0;\n"
    "    I += albedo * k_a * light[j].I_La;\n"
    "    I += fade * B * (albedo * k_d * light[j].I_d * dot(N, L) +\n"
    "                     k_s * light[j].I_s * pow(max(dot(N, H), 0.0), n));\n"
    "  }\n"
    "  return I;\n"
    "}\n";
static void scene_shadows(scene *s)
{
    draw *d = usual(s, "sun, lamp, spot behind a ball", SHADE_MODEL_BLINN_PHONG);
    memset(&d->mesh, 0, sizeof d->mesh);
    floor_of(&d->mesh, 6, 0, 1, 1);
    camera(s, shade_v3(0.4f, 5, 5.5f), shade_v3(0.1f, 0, 0.2f), 0.8f);
    memset(&d->state.model, 0, sizeof d->state.model);
    s->equation = shadowed;
    s->ball = shade_v4(0.1f, 1, 0.2f, 0.5f);
    sun(s);
    lamp(s, shade_v3(2.5f, 3, 1), shade_v3(1.4f, 0.8f, 0.4f));
    s->lights[s->light_count++] = shade_spot_light(shade_v3(-2, 4, 0), shade_v3(2, -4, 0.3f), 0.6f,
                                                   6, shade_v3(0.4f, 0.8f, 1.6f));
}

/* -------------------------------------------------- the notes' shaders and their twins, twins.h */

/* Massey's camera and light, a coarse torus, as in examples/lessons/38_glsl_twins.c */
static void twin(scene *s, const char *name, int k)
{
    draw *d = add_draw(s);
    s->name = name;
    s->twin = 1 + k;
    torus(&d->mesh, 20, 8);
    d->mesh.has_colors = 1;
    camera(s, shade_v3(0, 0, 5), shade_v3(0, 0, 0), 67 * 0.01745329252f);
    d->state.model = shade_mat4_rotation(0.8f, shade_v3(1, 0, 0));
    s->lights[s->light_count++] = shade_directional_light(shade_v3(0, 0, -1), shade_v3(1, 1, 1));
}

static void scene_twin_color(scene *s) { twin(s, "notes: colours of vertices", TWIN_COLOR); }
static void scene_twin_gouraud(scene *s) { twin(s, "notes: brass, vertex shader", TWIN_GOURAUD); }
static void scene_twin_phong(scene *s) { twin(s, "notes: brass, fragment shader", TWIN_PHONG); }

twin_uniforms scene_twin(const scene *s)
{
    const draw *d = &s->draws[0];
    shade_vec4 to = s->lights[0].position;
    twin_uniforms u;
    u.Model = d->state.model;
    u.View = d->state.view;
    u.Projection = d->state.projection;
    u.Normal = shade_normal_matrix(shade_mat4_mul(u.View, u.Model));
    u.direction = shade_v4(-to.x, -to.y, -to.z, 0);
    u.p = d->mesh.positions;
    u.n = d->mesh.normals;
    u.color = d->mesh.colors;
    return u;
}

/* ---------------------------------------------------------------------------------------------- */

static void (*const builders[])(scene *) = {
    scene_emissive,  scene_ambient,     scene_lambert,      scene_blinn_phong,  scene_phong,
    scene_lights,    scene_spots,       scene_cool_to_warm, scene_two_sided,    scene_two_sided_abs,
    scene_weighted,  scene_gouraud,     scene_flat,         scene_front_culled, scene_scaled,
    scene_less,      scene_greater,     scene_over,         scene_over_8,       scene_add,
    scene_bias,      scene_near,        scene_guard_band,   scene_nearest,      scene_bilinear,
    scene_trilinear, scene_srgb,        scene_glass,        scene_glow,         scene_pane,
    scene_cutoff,    scene_cutoff_over, scene_passes,       scene_more_passes,  scene_bgra,
    scene_shadows,   scene_twin_color,  scene_twin_gouraud, scene_twin_phong,   scene_specular_row
};

int scene_count(void) { return (int)(sizeof builders / sizeof builders[0]); }

void scene_build(scene *s, int which)
{
    memset(s, 0, sizeof *s);
    s->background = shade_v4(0.1f, 0.12f, 0.16f, 1);
    s->clear_depth = 1;
    builders[which](s);
    for (int k = 0; k < s->draw_count; k++) {
        shade_draw_state *state = &s->draws[k].state;
        if (k) state->lighting = s->draws[0].state.lighting;
        state->material = &s->draws[k].material;
        state->lighting.lights = s->lights;
        state->lighting.light_count = s->light_count;
        if (s->has_map && s->draws[k].mesh.has_texcoords) state->diffuse_map = &s->map;
    }
}
