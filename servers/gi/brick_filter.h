#pragma once

#include "servers/gi/leaf_plots.h"
#include "servers/gi/probe_data.h"

#include <glm/vec3.hpp>

#include <array>

namespace cl::gi {

class TopReach;

/// Tells triangles that touch none of some bricks, most of them, from the boxes around the triangles.
class BrickFilter {
public:
    BrickFilter(const Grid& grid, const TopReach& bricks);
    /// False: the triangle touches none of the bricks.
    [[nodiscard]] bool may_touch(const glm::vec3 (&vertices)[3]) const noexcept;

private:
    static constexpr int kSide = 1 << kBakeBrickLevel; ///< bricks along an edge of the root cell
    glm::vec3 root_m_;
    float bricks_per_m_;
    std::array<bool, kBakeBricks> wanted_{}; ///< x fastest, then y, then z
};

} // namespace cl::gi
