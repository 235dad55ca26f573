/* queue.c - the queue of fragments at every fill level: runs of any length appended, planes made,
   packets shaded and stored. */
#define SHADE_LANES 16
#include "prove.h"

enum { PIXELS = 64 };

static shade__draw d;
static shade_target target;
static shade_pipeline pipe;
static uint32_t color[4 * PIXELS];
static float depth[PIXELS], value[SHADE__BATCH_FLOATS];
static shade_colors colors;

static void shader(const void *uniforms, const shade_fragments *in, shade_colors *out)
{
    (void)uniforms;
    (void)in;
    any_floats(out->color[0], 4 * SHADE_LANES);
    for (int i = 0; i < SHADE_LANES; i++)
        out->discard[i] = Frama_C_unsigned_int_interval(0, 0xFFFFFFFFu);
}

/* value_stride as many floats a vertex; runs of two triangles */
static void prove_push(int varyings, int stride, int lod)
{
    static shade_texture texture;
    shade__setup *s = &d.setup;
    shade__run run[2];
    d.plan.varyings = varyings;
    d.plan.values = varyings + SHADE__FIRST + lod;
    d.plan.first_divided = ANY_OF(SHADE__FIRST, d.plan.values);
    d.plan.value_stride = stride;
    d.plan.lod_u = lod ? varyings + SHADE__FIRST : 0;
    d.plan.inputs_unread = ANY_OF(0, 1);
    d.plan.stride = ANY_OF(1, INT32_MAX);
    d.plan.row_offset = ANY_OF(0, 16383);
    texture.width = texture.height = ANY_OF(1, 16384);
    pipe.lod_texture = &texture;
    pipe.interpolation = (shade_interpolation)ANY_OF(0, SHADE_INTERPOLATION_CONSTANT);
    s->value = value;
    for (int i = 0; i < SHADE__TRIANGLES; i++) {
        s->turn[i] = (uint32_t)ANY_OF(0, 5);
        for (int k = 0; k < 4; k++) s->side[k][i] = any_float();
        for (int k = 0; k < 4; k++)
            s->corner[i][k] = Frama_C_unsigned_char_interval(
                0, (unsigned char)(shade__min(SHADE_LANES, SHADE__BATCH_FLOATS / stride) - 1));
    }
    any_floats(s->x_ref, SHADE__TRIANGLES);
    any_floats(s->y_ref, SHADE__TRIANGLES);
    any_floats(s->z0, SHADE__TRIANGLES);
    any_floats(s->z_low, SHADE__TRIANGLES);
    any_floats(s->z_high, SHADE__TRIANGLES);
    for (int k = 0; k < 2; k++) {
        run[k].x = ANY_OF(0, 16383);
        run[k].y = ANY_OF(0, 32767);
        run[k].n = ANY_OF(0, 16384);
        run[k].triangle = ANY_OF(0, SHADE__TRIANGLES - 1);
    }
    d.u.queue.f.count = ANY_OF(0, SHADE_LANES - 1);
    shade__push_body(&d, run, 2);
    /*@ assert 0 <= d.u.queue.f.count < SHADE_LANES; */
}

static void prove_flush(int count)
{
    d.plan.varyings = ANY_OF(0, SHADE_MAX_VARYINGS);
    d.plan.first_divided = ANY_OF(SHADE__FIRST, SHADE__FIRST + SHADE_MAX_VARYINGS);
    d.plan.lod_u = ANY_OF(0, 1);
    d.plan.inputs_unread = ANY_OF(0, 1);
    d.u.queue.f.count = count;
    shade__flush_body(&d);
    /*@ assert d.u.queue.f.count == 0; */
}

/* pixels anywhere in memory that ends with the last of them */
static void prove_store(shade_format format, shade_blend blend, int may_discard)
{
    target.format = format;
    target.srgb = 0;
    target.dither = ANY_OF(0, 1);
    d.plan.layout = &shade__layouts[format];
    d.plan.color = (uint8_t *)color + sizeof color - PIXELS * d.plan.layout->bytes;
    d.plan.depth = depth;
    d.plan.compare.less = any_mask();
    d.plan.compare.equal = any_mask();
    d.plan.compare.greater = any_mask();
    d.plan.compare.always = any_mask();
    d.plan.compare.write = any_mask();
    pipe.raster.blend = blend;
    pipe.may_discard = may_discard;
    for (int i = 0; i < SHADE_LANES; i++) {
        d.u.queue.offset[i] = Frama_C_unsigned_int_interval(0, PIXELS - 1);
        d.u.queue.f.x[i] = Frama_C_float_interval(0.5, 16383.5);
        d.u.queue.f.y[i] = Frama_C_float_interval(0.5, 16383.5);
        d.u.queue.f.primitive[i] = Frama_C_unsigned_int_interval(0, 0xFFFFFFFFu);
    }
    d.u.queue.f.count = ANY_OF(0, SHADE_LANES);
    shader(0, &d.u.queue.f, &colors);
    shade__store_body(&d, &colors);
}

int main(void)
{
    any_floats(value, SHADE__BATCH_FLOATS);
    any_floats(depth, PIXELS);
    any_ints((int32_t *)color, 4 * PIXELS, INT32_MIN, INT32_MAX);
    d.plan.target = &target;
    d.plan.pipe = &pipe;
    pipe.fragment = shader;
    prove_push(0, 8, 0);
    prove_push(6, 8, 0);
    prove_push(SHADE_MAX_VARYINGS, SHADE__VALUES_MAX, 2);
    for (int count = 0; count <= SHADE_LANES; count++) prove_flush(count);
    prove_store(SHADE_FORMAT_RGBA8, SHADE_BLEND_REPLACE, 0);
    prove_store(SHADE_FORMAT_RGBA8, SHADE_BLEND_OVER, 1);
    prove_store(SHADE_FORMAT_RGB565, SHADE_BLEND_REPLACE, 0);
    prove_store(SHADE_FORMAT_RGB565_SWAPPED, SHADE_BLEND_ADD, 0);
    /* not replaced: floats are not packed, so that the word handed on, which nobody looks at, is
       unset there */
    prove_store(SHADE_FORMAT_RGBA32F, SHADE_BLEND_OVER, 1);
    return 0;
}
