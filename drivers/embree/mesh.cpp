#include "drivers/embree/mesh.h"

#include <utility>

namespace cl::embree {

namespace {

/// The corners in drawing order: indices, or the vertices one after the other.
class Corners {
public:
    explicit Corners(const SurfaceArrays& arrays) : arrays_(arrays) {}
    [[nodiscard]] size_t count() const noexcept {
        return arrays_.indices.empty() ? arrays_.positions.size() : arrays_.indices.size();
    }
    [[nodiscard]] uint32_t operator[](size_t i) const noexcept {
        return arrays_.indices.empty() ? static_cast<uint32_t>(i) : arrays_.indices[i];
    }

private:
    const SurfaceArrays& arrays_;
};

/// Every second triangle of a strip is wound the other way and is turned back here.
std::vector<glm::uvec3> triangles_of(const Corners& c, PrimitiveType primitive) {
    std::vector<glm::uvec3> triangles;
    switch (primitive) {
    case PrimitiveType::Triangles:
        for (size_t i = 0; i + 2 < c.count(); i += 3) {
            triangles.emplace_back(c[i], c[i + 1], c[i + 2]);
        }
        break;
    case PrimitiveType::TriangleStrip:
        for (size_t i = 0; i + 2 < c.count(); ++i) {
            const size_t odd = i & 1;
            triangles.emplace_back(c[i + odd], c[i + 1 - odd], c[i + 2]);
        }
        break;
    case PrimitiveType::TriangleFan:
        for (size_t i = 1; i + 1 < c.count(); ++i) {
            triangles.emplace_back(c[0], c[i], c[i + 1]);
        }
        break;
    case PrimitiveType::Points:
    case PrimitiveType::Lines:
    case PrimitiveType::LineStrip:
    case PrimitiveType::LineLoop:
        break;
    }
    return triangles;
}

} // namespace

Expected<TriangleMesh> triangulate(std::span<const MeshSurface> surfaces) {
    TriangleMesh mesh;
    for (const MeshSurface& surface : surfaces) {
        Expected<SurfaceArrays> arrays = decode_surface(surface);
        if (!arrays) {
            return arrays.error();
        }
        auto made = std::make_shared<TriangleSurface>();
        made->arrays = std::move(*arrays);
        made->triangles = triangles_of(Corners(made->arrays), surface.primitive);
        mesh.surfaces.push_back(std::move(made));
    }
    return mesh;
}

} // namespace cl::embree
