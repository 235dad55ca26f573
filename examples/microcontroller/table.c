/* table.c - writes the teapot as constant arrays, to be compiled into flash. */
#include "../shared/teapot.h"
#include <stdio.h>

enum { PIECES = 5, MOST = 2000 };    /* along each edge of a patch; vertices of that */

int main(void)
{
    static float position[3 * MOST], normal[3 * MOST];
    static uint32_t index[12 * MOST];
    const int vertices = teapot_vertex_count(PIECES), indices = teapot_index_count(PIECES);
    teapot_build(PIECES, position, normal, NULL, index);
    printf("enum { TEAPOT_VERTICES = %d, TEAPOT_INDICES = %d };\n", vertices, indices);
    printf("static const float teapot_vertices[TEAPOT_VERTICES][6] = {    /* P, N */\n");
    for (int i = 0; i < vertices; i++) {
        const float *p = position + 3 * i, *n = normal + 3 * i;
        printf("{ %af, %af, %af, %af, %af, %af },\n", (double)p[0], (double)p[1], (double)p[2],
               (double)n[0], (double)n[1], (double)n[2]);
    }
    printf("};\nstatic const uint32_t teapot_indices[TEAPOT_INDICES] = {\n");
    for (int i = 0; i < indices; i++) printf("%u,%s", (unsigned)index[i], i % 12 < 11 ? " " : "\n");
    printf("};\n");
    return 0;
}
