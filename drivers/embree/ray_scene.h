#pragma once

#include "drivers/embree/traced_item.h"

#include "core/expected.h"

#include <glm/vec2.hpp>
#include <glm/vec3.hpp>

#include <cstdint>
#include <limits>
#include <memory>
#include <optional>
#include <span>

namespace cl::embree {

/// Who asks: not every surface is there for everyone.
enum class RayKind : uint8_t {
    Camera, ///< meets what the camera's cull mask lets through
    Path,   ///< light on its way between surfaces
    Shadow, ///< from a surface to a lamp: meets what casts shadows
};

struct Ray {
    glm::vec3 origin{0.0f};
    glm::vec3 direction{0.0f}; ///< unit length
    float near_m = 0.0f;
    float far_m = std::numeric_limits<float>::infinity();
};

struct Hit {
    uint32_t item = 0, triangle = 0;
    glm::vec2 barycentric{0.0f}; ///< weights of the second and third corner
    bool front = true;
};

/// The surfaces of a scene, found by ray: Embree's bounding volume hierarchy over all items' triangles.
///
/// A side that the material culls is not there, as the scene pass and its shadow maps have it: for a shadow
/// ray that is the side that faces the lamp, for all others the side that the ray comes to. A surface with an
/// opacity below 1 stops that share of the rays: which ones, a hash of the ray's seed and the triangle
/// decides, so that the order in which Embree finds triangles does not matter.
class RayScene {
public:
    /// Borrows the items, which must outlive it unmoved. @param camera_mask  layers that camera rays meet
    /// @return OutOfMemory or Unsupported if Embree says so.
    [[nodiscard]] static Expected<RayScene> build(std::span<const TracedItem> items, uint32_t camera_mask);
    ~RayScene();
    RayScene(const RayScene&) = delete;
    RayScene& operator=(const RayScene&) = delete;
    RayScene(RayScene&&) noexcept;
    RayScene& operator=(RayScene&&) noexcept;

    [[nodiscard]] std::optional<Hit> first_hit(const Ray& ray, RayKind kind, uint32_t seed) const noexcept;
    [[nodiscard]] bool is_blocked(const Ray& ray, RayKind kind, uint32_t seed) const noexcept;

private:
    struct Impl;
    explicit RayScene(std::unique_ptr<Impl> impl);
    std::unique_ptr<Impl> impl_;
};

/// `point` moved off a surface along `normal` (unit length), as far as its rounding makes needful.
/// Source: Waechter and Binder 2019, "A Fast and Robust Method for Avoiding Self-Intersection" (Ray Tracing
/// Gems 6).
[[nodiscard]] glm::vec3 offset_point(const glm::vec3& point, const glm::vec3& normal) noexcept;

} // namespace cl::embree
