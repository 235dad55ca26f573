/* explain_more.c - where sentences of shade_explain begin: each is said on one side of its limit,
   and not on the other, a step away.  The ball of mistakes.h is the scene. */
#include "unit.h"
#include "mistakes.h"

/* The words are said where miss is 0, and not where it is 1 .. misses: a sentence of several
   conditions has a miss for each. */
typedef struct limit {
    const char *name, *words;
    void (*make)(stage *s, int miss);
    int misses;
    struct limit *next;
} limit;
LISTED(limit);
#define NEAR(name, misses, words)                                                                  \
    static void near_##name(stage *s, int miss);                                                   \
    LIST(limit, name, #name, words, near_##name, misses)                                           \
    static void near_##name(stage *s, int miss)

NEAR(color_stride, 2, "elements overlap")
{
    s->mesh.colors = miss < 2 ? &s->color[0].x : NULL;
    s->mesh.color_stride = miss == 1 ? 12 : 8;
}
NEAR(texcoord_stride, 2, "elements overlap")
{
    s->mesh.texcoords = miss < 2 ? &s->texcoord[0].x : NULL;
    s->mesh.texcoord_stride = miss == 1 ? 8 : 4;
}
NEAR(positions, 1, "mesh.positions hold NaN") { s->position[40].x = miss ? 9e11f : 1.1e12f; }
NEAR(lamp_nan, 1, "holds a NaN") { s->lamps[1].diffuse.y = miss ? 0.5f : NAN; }
NEAR(attenuation, 1, "quadratic is negative") { s->lamps[0].linear = miss ? 1e-6f : -1e-6f; }
NEAR(last_row, 1, "The last row")
{
    s->state.model = shade_mat4_identity();
    s->state.model.col[3].w = miss ? 1.0f : 1.5f;
}
NEAR(cutoff, 1, "radians; use shade_radians")
{
    s->lamps[1] = shade_spot_light(s->eye, shade_neg(s->eye), miss ? 3.1415927f : 45, 0, WHITE);
}
NEAR(stats, 1, "stats are not") { s->other_stats = !miss; }
/* w = 1 - z/3: the matrix of a one-point perspective, and translation(1/3, 0, -1/3) by rows */
NEAR(by_rows, 1, "transposed")
{
    memset(&s->state.view, 0, sizeof s->state.view);
    s->state.projection = shade_mat4_identity();
    s->state.projection.col[2] = shade_v4(0, 0, -0.2f, -1 / 3.0f);
    s->state.model = shade_mat4_translation(shade_v3(0, 0, miss ? 4.0f : 1.7f));
    if (!miss) {
        s->state.projection =
            shade_mat4_transpose(shade_mat4_translation(shade_v3(0.3f, 0, -1.8f)));
        s->state.model = shade_mat4_translation(shade_v3(0, 0, 1.5f));
    }
}
NEAR(equal, 1, "is SHADE_COMPARE_EQUAL")
{
    s->state.raster.depth_test = SHADE_COMPARE_EQUAL;
    if (miss) {
        shade_draw_state first = s->state;
        first.raster.depth_test = SHADE_COMPARE_LESS;
        shade_clear(&s->target, shade_v4(0, 0, 0, 1), 1);
        shade_draw_mesh(&s->target, &s->mesh, &first, NULL);
        s->clear = NAN;
    }
}
NEAR(far_plane, 1, "Every pixel of the mesh has the depth of the far plane")
{
    s->z_near = miss ? 1e-5f : 1e-8f;
    stage_look(s);
}
NEAR(view_by_rows, 1, "state.view looks transposed")
{
    if (miss) s->state.view = s->state.projection;
    s->state.view = shade_mat4_transpose(s->state.view);
    if (miss) s->state.projection = shade_mat4_identity();
}
NEAR(beyond_far, 1, "beyond the far plane")
{
    s->state.model = shade_mat4_translation(shade_v3(0, 0, -200));
    s->state.projection = shade_mat4_ortho(-60, 60, -60, 60, -100, 100);
    if (miss) {    /* a view that moves all corners to the eye */
        memset(&s->state.view, 0, sizeof s->state.view);
        s->state.view.col[3].w = 1;
        stage_reverse(s, s->z_near);
    }
}
/* A triangle twice in the same place, which covers most of the picture. */
static void near_triangles(stage *s)
{
    s->mesh.indices = NULL;
    s->mesh.vertex_count = 6;
    for (int i = 0; i < 6; i++) {
        const float x = i % 3 == 1 ? 3.0f : -1, y = i % 3 == 2 ? 3.0f : -1;
        s->position[i] = shade_v3(x, y, 0);
        s->normal[i] = shade_v3(0, 0, 1);
    }
    stage_place(s, shade_v3(0, 0, 3), s->center);
    stage_lamp(s, shade_directional_light(shade_v3(0, 0, -1), WHITE));
}
/* A lamp that grazes one vertex, and is behind the two others: light of vertices fills the triangle
   from there. */
NEAR(behind_of_pixels, 1, "Every lamp is behind")
{
    near_triangles(s);
    s->mesh.vertex_count = 3;
    s->normal[0] = shade_v3(0.995f, 0, -0.1f);
    stage_lamp(s, shade_directional_light(shade_v3(0, 0, 1), shade_v3(10, 10, 10)));
    s->material.specular = BLACK;
    if (miss) {
        s->material.diffuse = BLACK;
        s->state.shading = SHADE_SHADING_PER_VERTEX;
    }
}
/* The triangle that another one hides does not count. */
NEAR(material_of_twins, 1, "state.material reflects")
{
    near_triangles(s);
    for (int i = 0; i < 6; i++) s->color[i] = miss && i < 3 ? BLACK : WHITE;
    s->mesh.colors = &s->color[0].x;
    s->lamps[0].specular = s->material.diffuse = BLACK;
}
/* A lamp above the eye leaves the ball's lower part in the dark; how much, decides its height. */
NEAR(behind, 1, "Every lamp is behind")
{
    stage_lamp(s, shade_directional_light(shade_v3(0, miss ? -1.5f : -0.3f, 1), WHITE));
    stage_place(s, shade_v3(0, 0, 4), s->center);
}
/* A small triangle with a highlight, and a large one with none.  Diffuse light is not asked for,
   but decides whether the large one faces the lamp. */
NEAR(behind_of_highlights, 1, "Every lamp is behind")
{
    near_triangles(s);
    for (int i = 0; i < 6; i++) {
        s->position[i].x = s->position[i].x * (i < 3 ? 0.1f : 0.5f) + (i < 3 ? -1.5f : 0.5f);
        if (i < 3) s->position[i].y *= 0.1f;
        else s->normal[i] = shade_v3(0, 1, miss ? 0.1f : -0.1f);
    }
    s->state.lighting.terms = SHADE_TERM_AMBIENT | SHADE_TERM_SPECULAR;
    s->state.lighting.ambient = s->material.ambient = WHITE;
    s->material.shininess = 60;
}
/* Both triangles face away, but the small one shines at a flat angle where highlights are open. */
NEAR(behind_of_open_highlights, 1, "Every lamp is behind")
{
    near_behind_of_highlights(s, 0);
    for (int i = 0; i < 6; i++)
        s->normal[i] = i < 3 ? shade_v3(1, 0, -0.02f) : shade_v3(0, 1, -1);
    s->material.shininess = 0.5f;
    s->state.lighting.flags = miss ? 0 : SHADE_FLAG_UNGATED_SPECULAR;
}
/* Wide ones show on more than a tenth. */
NEAR(behind_of_wide_highlights, 1, "Every lamp is behind")
{
    near_behind(s, 0);
    s->state.lighting.flags = miss ? SHADE_FLAG_UNGATED_SPECULAR : 0;
}
/* A dim lamp that grazes one vertex is not before the pixels to which its light spreads. */
NEAR(behind_of_vertices, 1, "Every lamp is behind")
{
    near_behind_of_pixels(s, 0);
    s->state.shading = SHADE_SHADING_PER_VERTEX;
    s->normal[0].z = miss ? -1.0f : -0.1f;
    s->state.lighting.terms = SHADE_TERM_AMBIENT | SHADE_TERM_DIFFUSE;
    s->state.lighting.ambient = s->material.ambient = WHITE;
    stage_lamp(s, shade_directional_light(shade_v3(0, 0, 1), shade_v3(0.3f, 0.3f, 0.3f)));
}
/* Emission of one channel is light, too. */
NEAR(behind_of_emission, 3, "Every lamp is behind")
{
    near_behind(s, 0);
    if (miss == 1) s->material.emission.x = 0.5f;
    if (miss == 2) s->material.emission.y = 0.5f;
    if (miss == 3) s->material.emission.z = 0.5f;
}
/* A narrow cone on the ball: its light is before faces in view, though it meets few of them. */
NEAR(behind_of_a_cone, 1, "Every lamp is behind")
{
    stage_place(s, shade_v3(0, 0, 4), s->center);
    stage_lamp(s, stage_spot(s, miss ? 0.02f : 0.2f, 0));
    if (!miss) {
        s->lamps[0].position.z = -6;
        s->lamps[0].spot_direction.z = 1;
    }
}
/* A spot of light that is white may be meant, and a part of the picture does not tell. */
NEAR(clipped, 2, "is clipped to white")
{
    shade_light lamp = stage_spot(s, miss == 1 ? 0.02f : 0.25f, 0);
    if (miss == 2) {
        s->target.clip_x = 10;
        s->target.clip_width = STAGE_WIDTH - 20;
        s->target.clip_height = STAGE_HEIGHT;
    }
    lamp.diffuse = lamp.specular = shade_v3(9, 9, 9);
    stage_lamp(s, lamp);
}
NEAR(attenuated, 1, "Attenuation")
{
    s->material.specular = BLACK;
    s->state.lighting.light_count = 1;
    s->lamps[0].quadratic = miss ? 0.2f : 0.4f;    /* 12 and 7 of 255 are left */
}
NEAR(cone, 1, "No cone")
{
    stage_lamp(s, shade_spot_light(s->eye, shade_v3(0, miss ? -1.0f : 1.0f, -4), 0.2f, 0, WHITE));
}
/* The second lamp, which is dark, meets the mesh. */
NEAR(cone_of_two, 1, "No cone")
{
    const shade_vec3 dark = shade_v3(1e-3f, 1e-3f, 1e-3f);
    near_cone(s, 0);
    s->lamps[1] =
        shade_spot_light(s->eye, shade_v3(0, miss ? 0.0f : 1.0f, -4), 0.2f, 0, dark);
    s->state.lighting.light_count = 2;
}
NEAR(no_colour, 1, "no colour")
{
    const float light = miss ? 0.08f : 0.02f;
    s->material.specular = BLACK;
    stage_lamp(s, shade_point_light(s->eye, shade_v3(light, light, light)));
}
NEAR(no_light, 1, "There is no light")
{
    const float light = miss ? 0.06f : 0.03f;
    s->state.lighting.lights = NULL;
    s->state.lighting.light_count = 0;
    s->mesh.normals = NULL;
    s->state.lighting.ambient = shade_v3(light, light, light);
}
NEAR(material, 1, "state.material reflects")
{
    const float albedo = miss ? 0.04f : 0.02f;
    s->material.diffuse = shade_v3(albedo, albedo, albedo);
    s->material.specular = BLACK;
}
NEAR(alpha, 1, "Alpha is 0")
{
    s->state.raster.blend = SHADE_BLEND_OVER;
    s->state.transparency = miss ? 0.9f : 0.99f;
}
/* Terms that show nothing, and would not show more if none were left out: there is no lamp. */
NEAR(terms, 1, "leaves out every term")
{
    s->state.lighting.terms = SHADE_TERM_EMISSION;
    if (miss) s->state.lighting.light_count = 0;
}
/* hidden by highlights, which white colours would not be */
NEAR(colors, 1, "mesh.colors, or the texels")
{
    for (int i = 0; i < STAGE_VERTICES; i++) s->color[i] = miss ? shade_v3(1e-3f, 0, 0) : BLACK;
    s->mesh.colors = &s->color[0].x;
}
NEAR(shader, 1, "leaves all pixels") { s->state.fragment = miss ? shader_white : shader_black; }
/* Of glass, a shader is said to leave black only where it may have been meant to show. */
NEAR(shader_of_glass, 1, "leaves all pixels")
{
    near_shader(s, miss);
    s->state.raster.blend = SHADE_BLEND_OVER;
    s->state.transparency = 0.5f;
}
NEAR(shader_of_no_alpha, 1, "leaves all pixels")    /* which is stored */
{
    near_shader(s, miss);
    s->state.transparency = 1;
}
NEAR(shader_of_nothing, 1, "Alpha is 0")
{
    near_shader(s, 0);
    s->state.raster.blend = SHADE_BLEND_OVER;
    s->state.transparency = miss ? 0.5f : 1.0f;
}
NEAR(discards, 1, "discards all")
{
    s->state.fragment = miss ? shader_white : shader_that_discards;
}
NEAR(inside_out, 2, "inside out")
{
    s->mesh.normals = NULL;
    if (!miss) stage_turn(s, 0);
    s->lamps[0].position = shade_v4(0, 1, 9, 1);
    s->lamps[1] = shade_directional_light(shade_v3(0, 1, 0.4f), WHITE);
    if (miss == 2) {    /* a model that holds the camera may mean anything */
        stage_turn(s, 0);
        s->state.model = shade_mat4_mul(s->state.projection, s->state.view);
        memset(&s->state.view, 0, sizeof s->state.view);
        memset(&s->state.projection, 0, sizeof s->state.projection);
    }
}
/* Parallel sight; where the farthest fragment is asked for, backs are what one sees. */
NEAR(inside_out_of_boxes, 1, "inside out")
{
    near_inside_out(s, 0);
    s->state.projection = shade_mat4_ortho(-2, 2, -2, 2, 0.1f, 30);
    if (miss) {
        s->state.raster.depth_test = SHADE_COMPARE_GREATER;
        s->clear = 0;
    }
}
/* A square, and before it the back of another, which leaves a twentieth or more of it in view */
NEAR(inside_out_of_nine_tenths, 1, "inside out")
{
    static const float x[6] = { 0, 1, 1, 0, 1, 0 }, y[6] = { 0, 0, 1, 0, 1, 1 };
    near_triangles(s);
    s->mesh.vertex_count = 12;
    for (int i = 0; i < 12; i++) {
        const int back = i > 5, k = back ? 11 - i : i;
        const float share = !back ? 1.8f : miss ? 1.8f * 0.85f : 1.8f * 0.95f;
        s->position[i] = shade_v3(x[k] * share - 0.9f, y[k] * 1.8f - 0.9f, back ? 0.5f : 0.0f);
        s->normal[i] = shade_v3(0, 0, 1);
    }
    s->state.projection = shade_mat4_ortho(-1, 1, -1, 1, 0.1f, 9);
    s->state.raster.cull = SHADE_CULL_BACK;
}
/* With a triangle behind the eye, which is within the box then, it may be a room. */
NEAR(inside_out_around_the_eye, 1, "inside out")
{
    near_inside_out_of_nine_tenths(s, 0);
    stage_look(s);
    for (int i = 12; i < 15; i++) s->position[i] = shade_v3((float)(i % 2), (float)(i - 13), 6);
    if (miss) s->mesh.vertex_count = 15;
}
NEAR(later, 1, "Triangles drawn later")
{
    s->state.raster.depth_read_only = 1;
    s->state.raster.cull = miss ? SHADE_CULL_BACK : SHADE_CULL_NONE;
}
/* A ball of some 60 pixels */
NEAR(later_of_few, 1, "Triangles drawn later")
{
    near_later(s, miss);
    stage_place(s, shade_v3(0, 0, 18), s->center);
}
NEAR(always, 1, "Triangles drawn later")
{
    s->state.raster.depth_test = SHADE_COMPARE_ALWAYS;
    s->state.raster.cull = miss ? SHADE_CULL_BACK : SHADE_CULL_NONE;
}
NEAR(test_is_turned, 2, "does not fit")
{
    s->state.raster.depth_test = SHADE_COMPARE_GREATER;
    s->clear = 0;
    s->state.raster.cull = miss ? SHADE_CULL_BACK : SHADE_CULL_NONE;    /* one face a pixel */
    if (miss == 2) s->state.projection = shade_mat4_ortho(-2, 2, -2, 2, 1, 9);
}
/* The nearer of two triangles comes last. */
NEAR(test_is_turned_of_layers, 1, "does not fit")
{
    near_triangles(s);
    for (int i = 3; i < 6; i++) s->position[i].z = miss ? 0.0f : 1.0f;
    s->state.raster.depth_test = SHADE_COMPARE_GREATER;
    s->clear = 0;
}
/* The matrix of perspective_reversed, and one whose planes of equal depth lean */
NEAR(reversed, 1, "perspective_reversed")
{
    s->state.projection = shade_mat4_perspective_reversed(s->fovy, s->aspect, s->z_near);
    if (miss) s->state.projection.col[0].z = 0.2f;
}
/* A model so large that its clip coordinates are no numbers */
NEAR(overflow, 1, "mesh.positions hold NaN")
{
    const shade_mat4 larger = shade_mat4_scaling(shade_v3(9, 9, 9));
    const float size = miss ? 1.0f : 1e38f;
    s->state.model = shade_mat4_scaling(shade_v3(size, size, size));
    s->state.projection = shade_mat4_mul(s->state.projection, larger);
}
NEAR(turned, 1, "point away from the eye")
{
    for (int i = 0; i < STAGE_VERTICES; i++)
        if (s->position[i].x < (miss ? -0.3f : 0.3f)) s->normal[i] = shade_neg(s->normal[i]);
    s->state.raster.cull = SHADE_CULL_BACK;
}
/* Nineteen of twenty faces whose normals lie on this side of them are turned. */
static void near_turned_by_normals(stage *s, float side)
{
    for (int t = 0; t < STAGE_INDICES; t += 3) {
        uint32_t *i = s->index + t;
        shade_vec3 outward = BLACK, n = BLACK;
        for (int k = 0; k < 3; k++) {
            outward = shade_add(outward, s->position[i[k]]);
            n = shade_add(n, s->normal[i[k]]);
        }
        if (side * shade_dot(n, outward) > 0 && t / 3 % 20) {
            const uint32_t first = i[0];
            i[0] = i[1];
            i[1] = first;
        }
    }
}
NEAR(normals_as_colours, 3, "no negative component")    /* all of them, or all but one */
{
    for (int i = 0; i < STAGE_VERTICES; i++) {
        s->normal[i] = shade_scale(shade_add(s->normal[i], WHITE), 0.5f);
    }
    if (miss == 1) s->normal[60].z = -0.1f;
    if (miss == 2) near_turned_by_normals(s, -1);
    if (miss == 3) near_turned_by_normals(s, 1);
}
NEAR(stored_alpha, 1, "stored as alpha")
{
    s->state.transparency = 0.5f;
    s->state.raster.blend = miss ? SHADE_BLEND_OVER : SHADE_BLEND_REPLACE;
}
/* What is white at half of its light as well */
NEAR(stored_alpha_of_white, 1, "stored as alpha")
{
    near_triangles(s);
    near_stored_alpha(s, 0);
    s->target.format = SHADE_FORMAT_RGBA32F;
    s->mesh.vertex_count = 3;
    s->material.specular = BLACK;
    if (miss) stage_lamp(s, shade_directional_light(shade_v3(0, 0, -1), shade_v3(9, 9, 9)));
}
NEAR(shininess, 1, "shininess is below 1") { s->material.shininess = miss ? 1.0f : 0.9f; }
NEAR(emission, 5, "emission alone")
{
    s->material.emission = shade_v3(1, 1, miss == 1 ? 0.99f : 1.0f);
    if (miss == 2) s->target.format = SHADE_FORMAT_RGBA32F;
    if (miss == 3) s->state.lighting.model = SHADE_MODEL_EMISSIVE;
    if (miss == 4) s->material.diffuse = BLACK;
    if (miss == 5) s->material.emission.y = 0.99f;
}
NEAR(bias, 1, "depth of all pixels") { s->state.raster.depth_bias = miss ? -0.9f : -1.0f; }
/* A mesh that a view without its last 1 puts at one depth, beyond far or not */
NEAR(beside_of_one_depth, 1, "beside the picture, before near")
{
    s->state.view.col[3].w = 0;
    s->state.projection = shade_mat4_mul(s->state.projection, s->state.view);
    memset(&s->state.view, 0, sizeof s->state.view);
    if (miss) s->state.projection = shade_mat4_perspective(s->fovy, s->aspect, 50, 90);
}
NEAR(clip, 1, "lies beyond the picture")
{
    s->target.clip_x = 40;
    s->target.clip_width = miss ? STAGE_WIDTH - 40 : STAGE_WIDTH - 39;
    s->target.clip_height = STAGE_HEIGHT - 1;
}
NEAR(box, 2, "does not contain its triangles")
{
    stage_chunk(s, shade_v3(-1, -1, -1), shade_v3(1, miss ? 1 : 0.999f, 1));
    if (miss == 2) {    /* a part without triangles has a box, and no need of one */
        s->mesh.chunks = s->chunks;
        s->mesh.chunk_count = 2;
        s->chunks[0] = s->chunks[1] = s->chunk;
        s->chunks[1].first = s->chunk.count;
        s->chunks[1].count = 0;
    }
}
NEAR(unset_view, 2, "state.view is unset")
{
    memset(&s->state.view, 0, sizeof s->state.view);
    s->state.model = shade_mat4_translation(shade_v3(0, 0, miss ? -3.0f : -0.5f));
    s->state.lighting.flags = SHADE_FLAG_TWO_SIDED;
    s->material.specular = BLACK;
    if (miss == 2) {    /* off centre, the projection may be meant to hold the camera */
        s->state.model.col[3].z = -0.5f;
        s->state.projection.col[3].y = 0.01f;
    }
}
/* A second eye is told where highlights need it. */
NEAR(second_eye, 2, "Highlights belong")
{
    const shade_mat4 there = shade_mat4_translation(shade_v3(0, 0, -4));
    s->state.view = shade_mat4_identity();
    s->state.projection = shade_mat4_mul(
        shade_mat4_perspective(s->fovy, s->aspect, s->z_near, s->z_far), there);
    s->state.lighting.terms = SHADE_TERM_AMBIENT | SHADE_TERM_DIFFUSE | SHADE_TERM_SPECULAR;
    if (miss == 1) {    /* the eye decides on sides, but there are no highlights */
        s->state.lighting.terms = SHADE_TERM_AMBIENT | SHADE_TERM_DIFFUSE;
        s->state.lighting.flags = SHADE_FLAG_TWO_SIDED;
    }
    if (miss == 2) {    /* highlights on hidden faces alone */
        for (int i = 0; i < STAGE_VERTICES; i++)
            if (s->position[i].z > -0.3f) s->normal[i] = BLACK;
        s->state.lighting.ambient = shade_v3(0.1f, 0.1f, 0.1f);
        s->material.specular = WHITE;
        s->material.shininess = 1;
        stage_lamp(s, shade_point_light(shade_v3(9, 0, -3), WHITE));
    }
}
/* Beside a map, which highlights do not multiply, they are lit apart. */
NEAR(second_eye_of_vertices, 1, "Highlights belong")
{
    near_second_eye(s, miss);
    stage_map(s);
    s->state.shading = SHADE_SHADING_PER_VERTEX;
}
NEAR(texels, 2, "reach the width")
{
    stage_map(s);
    s->map.width = 16;
    s->map.height = STAGE_TEXELS / 16;
    for (int i = 0; i < STAGE_VERTICES; i++)
        s->texcoord[i] =
            shade_scale2(s->texcoord[i], miss == 1 ? 14.0f : miss == 2 ? 16.5f : 15.5f);
}
NEAR(aspect, 4, "The aspect of")    /* 4 % and 2 % wide */
{
    s->aspect = miss == 1 ? 1.53f : 1.56f;
    stage_look(s);
    if (miss == 2) s->state.projection.col[1].x = 0.1f;    /* rows that lean have no aspect, ... */
    if (miss == 4) s->state.projection.col[1].x = -0.1f;
    if (miss == 3) {    /* depth alone, which has no more pixels */
        s->target.color = NULL;
        s->eye = shade_v3(0, 0, 1.1f);
        stage_look(s);
    }
}
/* 80 x 24 cells, twice as high as wide: the picture's aspect is 160 / 24 of the screen */
NEAR(aspect_of_cells, 1, "The aspect of")
{
    s->target.width = 80;
    s->target.height = 24;
    s->aspect = miss ? 80 / 48.0f : 80 / 30.0f;
    stage_look(s);
}

NEAR(aspect_of_pixels, 1, "The aspect of")    /* no terminal has so many rows */
{
    s->target.width = s->target.stride = 48;
    s->target.height = miss ? 127 : 128;
    s->aspect = 24.0f / (float)s->target.height;
    stage_look(s);
}

TEST(explain_more, each_sentence_has_its_limit)
{
    stage *s = stage_open();
    for (const limit *l = limit_first; l; l = l->next)
        for (int miss = 0; miss <= l->misses; miss++) {
            stage_of_ball(s);
            l->make(s, miss);
            const char *said = stage_explain(s, 1);
            CHECK_SAY((strstr(said, l->words) == NULL) == (miss > 0), "%s, miss %d: \"%s\"",
                      l->name, miss, said);
        }
    free(s);
}

/* Without stats, a mesh that a bias moved to depth 0 is not said to be at the far plane. */
TEST(explain_more, a_bias_that_shows_a_far_mesh_is_not_called_far)
{
    stage *s = stage_open();
    near_far_plane(s, 0);
    CHECK(strstr(stage_explain(s, 0), "far plane") != NULL);
    s->state.raster.depth_bias = -1;
    CHECK(strstr(stage_explain(s, 0), "depth of all pixels") != NULL);
    free(s);
}

/* A lamp beyond the sixteenth may be the one that lights. */
TEST(explain_more, of_more_than_sixteen_lamps_none_is_said_to_be_behind)
{
    shade_light behind[17];
    stage *s = stage_open();
    for (int i = 0; i < 17; i++)
        behind[i] = shade_directional_light(shade_v3(0, 0.25f, 1), WHITE);
    s->state.lighting.lights = behind;
    for (int count = 16; count < 18; count++) {
        s->state.lighting.light_count = count;
        CHECK((strstr(stage_explain(s, 1), "Every lamp is behind") == NULL) == (count == 17));
    }
    free(s);
}

/* The same picture by any split of the camera between view and projection. */
TEST(explain_more, aspect_and_depth_are_those_of_the_camera)
{
    stage *s = stage_open();
    const shade_mat4 turn = shade_mat4_rotation(0.4f, shade_v3(1, 2, 3));
    for (int k = 0; k < 2; k++) {
        stage_of_ball(s);
        s->aspect = 1.2f;
        stage_look(s);
        if (k) s->state.raster.depth_test = SHADE_COMPARE_GREATER;
        if (k) s->clear = 0;
        s->state.view = shade_mat4_mul(shade_mat4_inverse(turn), s->state.view);
        s->state.projection = shade_mat4_mul(s->state.projection, turn);
        CHECK(strstr(stage_explain(s, 1), k ? "does not fit" : "The aspect of"));
    }
    free(s);
}

/* A pixel is lit if one channel of it is: 2 is 0x40000000 as a float, a byte of 0x40 alone. */
static void shader_of_a_channel(const void *uniforms, const shade_fragments *SHADE_RESTRICT in,
                                shade_colors *SHADE_RESTRICT out)
{
    const float *color = (const float *)uniforms;
    (void)in;
    for (int k = 0; k < 4; k++) SHADE_EACH_LANE(i) { out->color[k][i] = color[k]; }
}
TEST(explain_more, a_shader_that_lights_one_channel_leaves_no_black)
{
    static const struct { shade_format format; float light; int lit; } row[] = {
        { SHADE_FORMAT_RGBA32F, 2, 1 },         { SHADE_FORMAT_RGBA32F, 0, 0 },
        { SHADE_FORMAT_RGBA8, 64 / 255.0f, 1 }, { SHADE_FORMAT_RGBA8, 9 / 255.0f, 1 },
        { SHADE_FORMAT_RGBA8, 8 / 255.0f, 0 },  { SHADE_FORMAT_RGB565, 4 / 63.0f, 1 },
        { SHADE_FORMAT_BGRA8, 64 / 255.0f, 1 }, { SHADE_FORMAT_RGB565_SWAPPED, 4 / 63.0f, 1 }
    };
    stage *s = stage_open();
    for (int k = 0; k < TEST_COUNT(row) * 3; k++) {
        float color[4] = { 0, 0, 0, 1 };
        const char *said;
        stage_of_ball(s);
        color[k % 3] = row[k / 3].light;
        s->target.format = row[k / 3].format;
        s->state.fragment = shader_of_a_channel;
        s->state.uniforms = color;
        said = stage_explain(s, 1);
        CHECK_SAY(row[k / 3].lit ? !*said : strstr(said, "leaves all pixels") != NULL,
                  "row %d: \"%s\"", k, said);
    }
    free(s);
}
