#include "tests/servers/gi/primitive_arrays.h"

#include <glm/geometric.hpp>

#include <cmath>
#include <cstdlib>

namespace cl::tests {

namespace {

/// Rule Q of two interleaved faces of one quad each: rows of two columns, `base` the first vertex.
void add_pair_indices(SurfaceArrays& a, uint32_t base) {
    const uint32_t previous = base;
    const uint32_t current = base + 4;
    for (uint32_t face = 0; face < 2; ++face) {
        const uint32_t p = previous + face;
        const uint32_t t = current + face;
        for (const uint32_t index : {p, p + 2, t, p + 2, t + 2, t}) {
            a.indices.push_back(index);
        }
    }
}

void add_vertex(SurfaceArrays& a, const glm::vec3& position, const glm::vec3& normal, const glm::vec2& uv) {
    a.positions.push_back(position);
    a.normals.push_back(normal);
    a.uvs.push_back(uv);
}

} // namespace

SurfaceArrays cube_arrays(const glm::vec3& size_m) {
    SurfaceArrays a;
    const glm::vec3 s = size_m * -0.5f;
    constexpr float kThird = 1.0f / 3.0f;
    for (int j = 0; j < 2; ++j) {
        const float y = s.y + float(j) * size_m.y;
        const float v = float(j) / 2.0f;
        for (int i = 0; i < 2; ++i) {
            const float x = s.x + float(i) * size_m.x;
            const float u = float(i) / 3.0f;
            add_vertex(a, {x, -y, -s.z}, {0, 0, 1}, {u, v});
            add_vertex(a, {-x, -y, s.z}, {0, 0, -1}, {2.0f * kThird + u, v});
        }
    }
    for (int j = 0; j < 2; ++j) {
        const float y = s.y + float(j) * size_m.y;
        const float v = float(j) / 2.0f;
        for (int i = 0; i < 2; ++i) {
            const float z = s.z + float(i) * size_m.z;
            const float u = float(i) / 3.0f;
            add_vertex(a, {-s.x, -y, -z}, {1, 0, 0}, {kThird + u, v});
            add_vertex(a, {s.x, -y, z}, {-1, 0, 0}, {u, 0.5f + v});
        }
    }
    for (int j = 0; j < 2; ++j) {
        const float z = s.z + float(j) * size_m.z;
        const float v = float(j) / 2.0f;
        for (int i = 0; i < 2; ++i) {
            const float x = s.x + float(i) * size_m.x;
            const float u = float(i) / 3.0f;
            add_vertex(a, {-x, -s.y, -z}, {0, 1, 0}, {kThird + u, 0.5f + v});
            add_vertex(a, {x, s.y, -z}, {0, -1, 0}, {2.0f * kThird + u, 0.5f + v});
        }
    }
    for (const uint32_t base : {0u, 8u, 16u}) {
        add_pair_indices(a, base);
    }
    return a;
}

SurfaceArrays sphere_arrays() {
    constexpr int kSegments = 64;
    constexpr int kRings = 32;
    constexpr double kPi = 3.14159265358979323846;
    SurfaceArrays a;
    for (int j = 0; j <= kRings + 1; ++j) {
        const float v = float(j) / float(kRings + 1);
        const float w = float(std::sin(kPi * double(v)));
        const float y = float(2.0 * 0.5 * std::cos(kPi * double(v)));
        for (int i = 0; i <= kSegments; ++i) {
            const float u = float(i) / float(kSegments);
            const float x = float(std::sin(double(u) * (kPi * 2.0)));
            const float z = float(std::cos(double(u) * (kPi * 2.0)));
            const glm::vec3 p(x * w, y, z * w);
            add_vertex(a, p, glm::normalize(p), {u, v});
            if (i > 0 && j > 0) {
                const uint32_t t = uint32_t(j * (kSegments + 1) + i);
                const uint32_t p_i = t - uint32_t(kSegments + 1);
                for (const uint32_t index : {p_i - 1, p_i, t - 1, p_i, t, t - 1}) {
                    a.indices.push_back(index);
                }
            }
        }
    }
    return a;
}

SurfaceArrays quad_arrays(const glm::vec2& size_m) {
    const glm::vec2 h = size_m * 0.5f;
    const glm::vec3 corners[4] = {{-h.x, -h.y, 0}, {-h.x, h.y, 0}, {h.x, h.y, 0}, {h.x, -h.y, 0}};
    const glm::vec2 uvs[4] = {{0, 1}, {0, 0}, {1, 0}, {1, 1}};
    SurfaceArrays a;
    for (const int corner : {0, 1, 2, 0, 2, 3}) {
        add_vertex(a, corners[corner], {0, 0, 1}, uvs[corner]);
    }
    return a;
}

SurfaceArrays as_stored(const SurfaceArrays& arrays) {
    const Expected<MeshSurface> surface = encode_surface(arrays, PrimitiveType::Triangles);
    const Expected<SurfaceArrays> decoded = decode_surface(*surface);
    return *decoded;
}

} // namespace cl::tests
