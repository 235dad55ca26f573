/* cover.c - pixels inside triangles, hidden depth, the queue of fragments.
   Each part is a driver of prove.sh. */

#ifdef PROVE_tiles
/* Pixels inside triangles: edges in rectangles anywhere in the picture, and columns of
   tiles, the last of them at the end of the memory of depths. */
#include "prove.h"

enum { FAR = 1 << 24, WIDTH = 64, ROWS = 16 };

static shade__triangle t;
static shade__edges edges;
static shade__tile tile;
static shade__plan plan;
static float depth[WIDTH * ROWS];

/* any slope, any edge that a box within 16384 pixels may reach */
static void prove_reach(void)
{
    int64_t least[3];
    t.x0 = ANY_OF(0, 16383);
    t.y0 = ANY_OF(0, 16383);
    for (int k = 0; k < 3; k++) {
        t.e[k] = ANY_WITHIN(1 << 30) * (int64_t)16384;
        t.edges.ex[k] = ANY_WITHIN(2 * FAR);
        t.edges.ey[k] = ANY_WITHIN(2 * FAR);
    }
    for (int k = 0; k < 3; k++) {
        const int64_t e = shade__edge_at(&t, k, ANY_OF(0, 16383), ANY_OF(0, 16383));
        least[k] = e + shade__edge_fall(&t, k, ANY_OF(1, 16384), ANY_OF(1, 16384));
        /*@ assert -35184372088832 <= e <= 35184372088832; */
    }
    const int inside = shade__all_inside(&t, least, ANY_WITHIN(16384));
    /*@ assert 0 <= inside <= 1; */
}

/* columns of rows that the box has, or that a tile has below it */
static void prove_cut(void)
{
    int first = t.x0, last = ANY_OF(0, 16383);
    shade__cut_columns(&t, ANY_OF(0, 16383), ANY_OF(1, 16384), &first, &last);
    /*@ assert 0 <= first <= 32767 && -1 <= last <= 16383; */
}

/* Columns of a tile at the end of the memory of depths, at pixel (8192, 8192): only differences of
   positions count.  More rows touch more. */
static void prove_columns(int width, int less_only, int full)
{
    tile.x = 8192;
    tile.y = 8192;
    tile.rows = SHADE__TILE_ROWS;
    tile.skip = ANY_OF(0, SHADE__TILE - 1);
    tile.columns = SHADE__TILE;
    tile.stride = WIDTH;
    tile.depth = depth + WIDTH * (ROWS - SHADE__TILE_ROWS) + WIDTH - SHADE__TILE;
    for (int r = 0; r < SHADE__TILE_ROWS; r++) {
        tile.set[r] = 0;
        tile.row_z[r] = any_float();
    }
    tile.edges = &edges;
    shade__test_columns(&plan, &t, &tile, SHADE__TILE - width, width,
                        (less_only ? SHADE__LESS : 0) | (full ? SHADE__FULL : 0));
}

/* The edges of a small triangle: anywhere in the 1024 rows of its box, from 31 pixels before its
   first to the last of its columns of tiles. */
static void prove_small(int width, int less_only)
{
    for (int k = 0; k < 3; k++) {
        edges.e[k] = ANY_WITHIN(1 << 29);
        edges.ex[k] = ANY_WITHIN(1 << 18);
        edges.ey[k] = ANY_WITHIN(1 << 18);
    }
    edges.x = 8192 + ANY_OF(1 - 4 * SHADE__TILE, SHADE__TILE - 1);
    edges.y = 8192 - ANY_OF(0, 127) * SHADE__TILE_ROWS;
    prove_columns(width, less_only, 0);
    tile.rows = ANY_OF(1, SHADE__TILE_ROWS);
    const int outside = shade__tile_outside(&edges, &tile);
    /*@ assert 0 <= outside <= 1; */
}

/* Edges that cross a tile.  The guard band is 3 pictures wide and high, so that steps are below
   3 16384 256 < 2^24. */
static void prove_crossed(int width, int less_only, int full)
{
    for (int k = 0; k < 3; k++) {
        edges.e[k] = ANY_WITHIN(39 * FAR);
        edges.ex[k] = ANY_WITHIN(FAR);
        edges.ey[k] = ANY_WITHIN(FAR);
    }
    edges.x = edges.y = 8192;
    prove_columns(width, less_only, full);
}

int main(void)
{
    any_floats(depth, WIDTH * ROWS);
    t.zx = any_float();
    t.x_ref = any_float();
    t.z_low = any_float();
    t.z_high = any_float();
    plan.tile_test.less = any_mask();
    plan.tile_test.equal = any_mask();
    plan.tile_test.greater = any_mask();
    plan.tile_test.always = any_mask();
    plan.tile_test.write = any_mask();
    prove_reach();
    prove_cut();
    for (int less_only = 0; less_only < 2; less_only++) {
        prove_small(8, less_only);
        prove_small(16, less_only);
        prove_crossed(16, less_only, 0);
        prove_crossed(SHADE__TILE, less_only, 1);
    }
    return 0;
}
#endif

#ifdef PROVE_bounds
/* Bounds of hidden depth: any clip rectangle within 16384, any triangle in it. */
/* eva: -eva-slevel-function shade__begin_bounds:40 */
#define SHADE_LANES 128
#include "prove.h"

enum { FAR = 1 << 24 };

static shade__bounds bounds;
static shade__plan plan;
static shade__triangle t;

static void prove_begin(void)
{
    plan.x0 = ANY_OF(0, 16383);
    plan.y0 = ANY_OF(0, 16383);
    plan.x1 = ANY_OF(1, 16384);
    plan.y1 = ANY_OF(1, 16384);
    if (plan.x0 >= plan.x1 || plan.y0 >= plan.y1) return;
    shade__begin_bounds(&plan, &bounds);
    /*@ assert 5 <= bounds.log_width <= 14 && 3 <= bounds.log_height <= 14; */
    /*@ assert -511 <= bounds.across <= 512; */
}

/* As many rows of bounds, each across wide at most, as there can be; for 2^w x 2^h pixels each.
   The rectangle begins at (3, 5): only differences count. */
static void prove_next(int across, int w, int h)
{
    const int rows = SHADE__BOUNDS / across;
    const int right = shade__min(16383, 2 + (across << w));
    const int low = shade__min(16383, 4 + (rows << h));
    shade__stretch s;
    bounds.log_width = w;
    bounds.log_height = h;
    bounds.across = ANY_OF(1, across);
    plan.x1 = ANY_OF(4, 16384);
    plan.y1 = ANY_OF(6, 16384);
    t.x0 = ANY_OF(3, right);
    t.y0 = ANY_OF(5, low);
    t.x1 = ANY_OF(3, right);
    t.y1 = ANY_OF(5, low);
    for (int k = 0; k < 3; k++) t.e[k] = ANY_WITHIN(1 << 30) * (int64_t)16384;
    s.x = ANY_OF(3, right);
    s.y = ANY_OF(5, low);
    s.bottom = ANY_OF(5, low);
    s.end = t.x1;
    s.last = s.end;
    s.inside = 0;
    plan.away = Frama_C_float_interval(-1, 1);
    shade__next_stretch(&plan, &bounds, &t, &s);
    /*@ assert 2 <= s.last <= 16383 && 3 <= s.x <= 16384; */
}

/* Bounds of one size, from all in one column to all in one row. */
static void prove_sizes(int w, int h)
{
    /*@ loop unroll 80; */
    for (int rows = SHADE__BOUNDS; rows > 0; rows = SHADE__BOUNDS / (SHADE__BOUNDS / rows + 1))
        prove_next(SHADE__BOUNDS / rows, w, h);
}

int main(void)
{
    prove_begin();
    plan.x0 = 3;
    plan.y0 = 5;
    for (int k = 0; k < 3; k++) {
        t.edges.ex[k] = ANY_WITHIN(2 * FAR);
        t.edges.ey[k] = ANY_WITHIN(2 * FAR);
    }
    t.x_ref = any_float();
    t.y_ref = any_float();
    t.z0 = any_float();
    t.zx = any_float();
    t.zy = any_float();
    t.z_low = any_float();
    t.z_high = any_float();
    any_floats(bounds.farthest, SHADE__BOUNDS);
    for (int h = 3; h <= 14; h++) {
        prove_sizes(shade__max(h, 5), h);
        if (h > 4 && h < 14) prove_sizes(h + 1, h);
    }
    return 0;
}
#endif

#ifdef PROVE_queue
/* The queue of fragments at every fill level: runs of any length appended, planes made,
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
        s->order[i] = (uint32_t)ANY_OF(0, 5);
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
#endif
