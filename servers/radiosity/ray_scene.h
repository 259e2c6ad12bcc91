#pragma once

#include "servers/radiosity/still_scene.h"

#include "core/expected.h"

#include <glm/vec2.hpp>
#include <glm/vec3.hpp>

#include <cstdint>
#include <memory>
#include <span>

namespace cl::radiosity {

struct Ray {
    glm::vec3 origin{0.0f};    ///< [m]
    glm::vec3 direction{0.0f}; ///< unit length, or the whole segment where max_t is 1
    float max_t = 1e30f;
};

inline constexpr uint32_t kMiss = 0xFFFFFFFFu;

struct Hit {
    uint32_t triangle = kMiss;
    float t = 0.0f;
    glm::vec2 barycentric{0.0f}; ///< weights of vertices 1 and 2
    bool is_front = false;       ///< of a two-sided surface: either side
};

/// What rays meet in a still scene: exact triangles, holes of cut-out surfaces left open. Any number of
/// threads may ask at once. Library: Embree 3.
class RayScene {
public:
    /// The scene must outlive it. @return OutOfMemory or Unsupported with the library's word for it.
    static Expected<RayScene> create(const StillScene& scene);
    RayScene(const RayScene&) = delete;
    RayScene& operator=(const RayScene&) = delete;
    RayScene(RayScene&&) noexcept;
    RayScene& operator=(RayScene&&) noexcept;
    ~RayScene();

    /// The nearest hit of each ray; hits.size() == rays.size().
    void trace(std::span<const Ray> rays, std::span<Hit> hits) const noexcept;
    enum class Side : uint8_t { Front, Back };
    /// The nearest hit on one side of surfaces, whatever shows its other side before it.
    void trace_side(Side side, std::span<const Ray> rays, std::span<Hit> hits) const noexcept;
    /// True if anything lies on a ray's way.
    [[nodiscard]] bool is_blocked(const Ray& ray) const noexcept;
    /// True if anything lies between two points.
    [[nodiscard]] bool is_blocked(const glm::vec3& from, const glm::vec3& to) const noexcept {
        return is_blocked({from, to - from, 1.0f});
    }

    /// is_blocked() of each of many rays that start near each other and go to one place, faster.
    /// blocked.size() == rays.size()
    void find_blocked(std::span<const Ray> rays, std::span<uint8_t> blocked) const noexcept;

    /// Unit length, out of a triangle's front; 0 if it is degenerate.
    [[nodiscard]] const glm::vec3& normal(uint32_t triangle) const noexcept;

    struct Impl;

private:
    explicit RayScene(std::unique_ptr<Impl> impl);
    std::unique_ptr<Impl> impl_;
};

} // namespace cl::radiosity
