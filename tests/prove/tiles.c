/* tiles.c - pixels inside triangles: edges in rectangles anywhere in the picture, and columns of
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
