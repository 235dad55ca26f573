// glm.cpp - a program whose vectors and matrices are GLM's.  Arrays go to shade.h by pointer,
// matrices, stored by columns there and here, as the same bits: std::bit_cast of C++20.  The
// implementation is in an object of its own, compiled from cmake/shade.c.
#include "shade.h"
#include <bit>
#include <glm/glm.hpp>
#include <glm/gtc/matrix_transform.hpp>
#include <vector>

static shade_mat4 as_shade(const glm::mat4 &m) { return std::bit_cast<shade_mat4>(m); }
static shade_vec3 as_shade(const glm::vec3 &v) { return std::bit_cast<shade_vec3>(v); }

int main(int argc, char **argv)
{
    const int n = 33, width = 640, height = 480;
    std::vector<glm::vec3> positions, normals(n * n);
    std::vector<glm::uvec3> triangles;
    for (unsigned k = 0; k < n * n; k++) {        // the monkey saddle
        glm::vec2 p = glm::vec2(k % n, k / n) / 16.0f - 1.0f;
        positions.push_back({ p, (p.x * p.x - 3 * p.y * p.y) * p.x / 2 });
        if (k % n == n - 1 || k / n == n - 1) continue;
        triangles.push_back({ k, k + 1, k + n + 1 });
        triangles.push_back({ k, k + n + 1, k + n });
    }
    std::vector<uint32_t> color(width * height);
    std::vector<float> depth(width * height);
    shade_target target = { .width = width, .height = height, .color = color.data(),
                            .depth = depth.data(), .srgb = 1 };
    shade_mesh mesh = { .positions = &positions[0].x, .normals = &normals[0].x,
                        .vertex_count = n * n, .indices = &triangles[0].x,
                        .index_count = 3 * (int)triangles.size() };
    shade_mesh_normals(&mesh, (shade_vec3 *)normals.data());
    shade_light lamp = shade_point_light(as_shade(glm::vec3(4, -2, 5)), as_shade(glm::vec3(1)));
    shade_material jade = shade_linear_material(shade_preset_material(SHADE_PRESET_JADE));
    glm::mat4 view = glm::lookAt(glm::vec3(3, -5, 4), glm::vec3(0), glm::vec3(0, 0, 1));
    glm::mat4 projection = glm::perspective(0.5f, (float)width / height, 0.1f, 100.0f);
    shade_draw_state state = { .view = as_shade(view), .projection = as_shade(projection),
                               .material = &jade };
    state.lighting = { .lights = &lamp, .light_count = 1, .ambient = as_shade(glm::vec3(0.2f)),
                       .flags = SHADE_FLAG_TWO_SIDED };
    // with GLM_FORCE_DEPTH_ZERO_TO_ONE: state.raster.depth_zero_to_one = 1;
    shade_clear(&target, { 0.02f, 0.03f, 0.05f, 1 }, 1);
    shade_draw_mesh(&target, &mesh, &state, nullptr);
    return shade_write_ppm(argc > 1 ? argv[1] : "glm.ppm", &target);
}
