/* rows.h - shade_lit_lanes with its rows one by one. */
#ifndef ROWS_H
#define ROWS_H

static inline void lit_rows(const shade_lighting *lighting, const shade_material *material,
                            shade_vec3 eye, const float *position, const float *normal,
                            const float *albedo, const float *visibility, float *rgb)
{
    const shade_rows rows = { position, normal, albedo, NULL, visibility };
    shade_lit_lanes(lighting, material, eye, &rows, rgb);
}

#endif
