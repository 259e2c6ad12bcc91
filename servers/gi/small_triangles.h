#pragma once

#include "servers/gi/cell_intervals.h"

#include <glm/vec3.hpp>

#include <array>
#include <cstdint>
#include <vector>

namespace cl::gi {

/// Finds the leaves of triangles that are hardly larger than one, each on its own: most of the way down the
/// tree such a triangle lies within one cell. The leaves are those that descending with the full test at each
/// cell finds, to the bit.
class SmallTriangles {
public:
    explicit SmallTriangles(const Grid& grid);

    /// Slots from the root to each leaf, three bits a level.
    class Leaves {
    public:
        [[nodiscard]] const uint32_t* begin() const noexcept { return leaves_.data(); }
        [[nodiscard]] const uint32_t* end() const noexcept { return leaves_.data() + count_; }

    private:
        friend class SmallTriangles;
        static constexpr uint32_t kMost = 64;
        std::array<uint32_t, kMost> leaves_;
        uint32_t count_ = 0;
    };

    /// The leaves inside the grid that a triangle touches. @return false if it is too large, or touches an
    /// inner cell none of whose children it touches; `leaves` are of no use then.
    [[nodiscard]] bool find_leaves(const glm::vec3 (&vertices)[3], Leaves& leaves) const noexcept;

private:
    struct Triangle {
        const glm::vec3 (&vertices)[3];
        float4 corners[3]; ///< x, y, z, 0
        float4 least, most;
        bool is_sliver;
    };
    struct Level {
        float size_m;   ///< of cells
        uint8_t inside; ///< children that lie inside the grid
    };
    bool descend(const Triangle& triangle, const CellPlace& place, Leaves& leaves) const noexcept;

    float most_m_;
    CellIntervals intervals_;
    std::vector<Level> levels_; ///< but that of leaves
};

} // namespace cl::gi
