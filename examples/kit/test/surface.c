/* surface.c - the MTL reader of examples/kit/read/mtl.h: any bytes fill the surfaces of
   a model with colours that can be drawn, or stop with an error. */
#include "input.h"
#include "examples/kit/read/mtl.h"

static void surface_check(const model_surface *s)
{
    const shade_material *k = &s->material;
    const float v[12] = { k->emission.x, k->emission.y, k->emission.z, k->ambient.x,
                          k->ambient.y,  k->ambient.z,  k->diffuse.x,  k->diffuse.y,
                          k->diffuse.z,  k->specular.x, k->specular.y, k->specular.z };
    for (int i = 0; i < 12; i++) HOLDS(v[i] >= 0 && v[i] <= 1);
    HOLDS(k->shininess >= 0 && k->shininess <= 10000);
    HOLDS(s->transparency >= 0 && s->transparency <= 1);
    HOLDS(!s->map || (s->map[0] && !strchr(s->map, '\n')));
    if (!s->set) HOLDS(!s->map && s->transparency == 0);
}

int LLVMFuzzerTestOneInput(const uint8_t *data, size_t size)
{
    static const char *const names[3] = { "a", "b c", "" };
    static const model empty;
    model m = empty;
    uint8_t *bytes;
    char error[80];
    mesh_reader r = mesh_about("a.mtl", error, sizeof error);
    int failed;
    if (size > GUARD_ROOM) return 0;
    bytes = (uint8_t *)guard_take(size, 1);
    if (size) memcpy(bytes, data, size);
    guard_seal(bytes);
    for (int i = 0; i < 3; i++) HOLDS(model_find_surface(&m, names[i], strlen(names[i]), 1) == i);
    r.line = 1;
    r.at = r.begin = bytes;
    r.end = bytes + size;
    error[0] = 0;
    failed = mtl_read(&r, &m);
    HOLDS(m.surface_count == 3);
    for (int i = 0; i < 3; i++) surface_check(&m.surface[i]);
    HOLDS(!failed == !error[0] && strlen(error) < sizeof error && !strchr(error, '\n'));
    HOLDS(!failed || !strncmp(error, "a.mtl:", 6));
    model_free(&m);
    guard_close();
    return 0;
}
