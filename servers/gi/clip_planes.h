#pragma once

#include <glm/vec3.hpp>

#include <array>

namespace cl::gi {

/// The planes at which the march of a light's rays starts when the light lies farther out, as Godot 3.2.3
/// keeps them (spec gi-update sections 5.1 and 5.4).
///
/// A direction is meant to set them just outside the grid: at dims + 1 where it falls, at -1 where it rises.
/// Godot resets a plane only when its axis falls and lowers it by one when it rises; so a lamp, which turns
/// to leaf after leaf, drags planes through the grid, and rays that start at them pass whatever is before.
/// Its pictures show that light, hence ours for `--gi cones`.
///
/// A default object is the state at a light's first leaf. It is also what no turn at all does to a state:
/// turns of a run of leaves add up to one object that `then()` applies, so that runs can be worked on side by
/// side.
class ClipPlanes {
public:
    /// @param direction  unit length, cells; components below 1e-5 own no plane.
    void turn_to(const glm::ivec3& dims, const glm::vec3& direction) noexcept;

    /// Applies the turns that `later` went through, if it started from a default object.
    void then(const ClipPlanes& later) noexcept;

    /// The start of the segment from..to, moved along it to each plane that it crosses, in their order.
    /// [cells]
    [[nodiscard]] glm::vec3 clipped_start(glm::vec3 from, const glm::vec3& to) const noexcept;

private:
    struct Plane {
        glm::vec3 normal{0.0f}; ///< 1 on every axis that ever owned the plane
        float d = 0.0f;         ///< distance, or, if no turn has set it, what turns add to it; whole cells
        bool is_set = false;
    };
    std::array<Plane, 3> planes_;
    int count_ = 0; ///< planes that the last direction owns
};

} // namespace cl::gi
