/* The point that the C lines of the pages speak of: light from above, 5 away, a viewer in front. */
const shade_vec3 P = { 0, 0, 0 }, N = { 0, 0, 1 }, eye = { 0, 0, 4 };
const shade_vec3 L = { 0, 0.6f, 0.8f }, V = { 0, 0, 1 }, white = { 1, 1, 1 };
const shade_vec3 R = shade_mirror(L, N), H = shade_halfway(L, V);
const shade_material brass = shade_preset_material(SHADE_PRESET_BRASS);
shade_light lamp = shade_point_light(shade_v3(0, 3, 4), white);
shade_lighting lighting = { .lights = &lamp, .light_count = 1, .ambient = { 0.3f, 0.3f, 0.3f } };
