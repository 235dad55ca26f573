/* clip.c - clipping: polygons of every size against each plane, with corners anywhere; corners of
   what is left on the screen; the fan. */
#define SHADE_LANES 128
#include "prove.h"

static shade__polygon p;
static shade__plan plan;

static void any_polygon(void)
{
    for (int i = 0; i < SHADE__CLIP_VERTICES; i++) {
        for (int k = 0; k < 4; k++)    /* what is farther is rejected before */
            p.vertex[i].clip[k] = Frama_C_float_interval(-1e31f, 1e31f);
        p.vertex[i].x = ANY_WITHIN(1 << 24);
        p.vertex[i].y = ANY_WITHIN(1 << 24);
        p.corner[i] = Frama_C_unsigned_char_interval(0, SHADE__CLIP_VERTICES - 1);
    }
    any_floats(p.value, SHADE__CLIP_VERTICES * SHADE__VALUES_MAX);
    p.in_front = ANY_OF(0, 1);
    p.taken = Frama_C_unsigned_int_interval(1, (1u << SHADE__CLIP_VERTICES) - 1);
    plan.values = plan.value_stride = SHADE__VALUES_MAX;
    plan.first_divided = ANY_OF(SHADE__FIRST, SHADE__VALUES_MAX);
    plan.zero_to_one = ANY_OF(0, 1);
    plan.half_width = Frama_C_float_interval(128, 2097152);
    plan.half_height = Frama_C_float_interval(128, 2097152);
}

static void prove_plane(uint32_t plane)
{
    p.count = ANY_OF(0, SHADE__CLIP_VERTICES);
    shade__clip_plane(&plan, &p, plane);
    /*@ assert 0 <= p.count <= SHADE__CLIP_VERTICES; */
    for (int i = 0; i < SHADE__CLIP_VERTICES; i++) {
        /*@ assert p.corner[i] < SHADE__CLIP_VERTICES; */
    }
}

/* the window position of a corner, w by octaves from 2^-60 to 2^100, and where it is too small */
static void prove_place(float w)
{
    for (int k = 0; k < 3; k++)
        p.vertex[12].clip[k] = Frama_C_float_interval(-1e32f, 1e32f);
    p.vertex[12].clip[3] = w;
    shade__place_polygon(&plan, &p);
    /*@ assert -16777216 <= p.vertex[12].x <= 16777216; */
    /*@ assert -16777216 <= p.vertex[12].y <= 16777216; */
}

static void prove_fan(int count)
{
    p.count = count;
    const int64_t area = shade__fan_area(&p, ANY_OF(0, count - 1), ANY_OF(1, count - 2));
    /*@ assert -2251799813685248 <= area <= 2251799813685248; */
    p.area = area;
    const int apex = shade__apex(&p);
    /*@ assert 0 <= apex < count; */
}

int main(void)
{
    any_polygon();
    for (int count = 3; count <= SHADE__CLIP_VERTICES; count++) prove_fan(count);
    for (uint32_t plane = SHADE__OUT_NEAR; plane <= SHADE__OUT_W; plane *= 2) prove_plane(plane);
    p.count = 1;
    p.corner[0] = 12;
    for (int k = -60; k < 100; k++) {
        const uint32_t one = (uint32_t)(127 + k) << 23;
        prove_place(float_of_bits(one, one + 0x800000u));
    }
    prove_place(float_of_bits(0, 0x217FFFFFu));
    prove_place(float_of_bits(0x80000000u, 0xFF7FFFFFu));
    return 0;
}
