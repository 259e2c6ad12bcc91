#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

namespace cl::gi {

/// A triangle and a leaf that it touches.
struct LeafPlot {
    uint32_t leaf; ///< slots from the root to the leaf, three bits a level: numbers in the order of the tree
    uint32_t triangle;
};

/// Level of the cells, bricks, that are built each on its own.
inline constexpr int kBakeBrickLevel = 3;
inline constexpr uint32_t kBakeBricks = 1u << (3 * kBakeBrickLevel);

/// Plots sorted by brick, on all workers.
class LeafPlots {
public:
    LeafPlots() = default;
    /// @param parts   plots whose triangles ascend, each part's above those of the one before
    /// @param levels  of the tree
    LeafPlots(std::span<const std::span<const LeafPlot>> parts, int levels);

    /// A brick's plots; triangles ascend.
    /// @param number  slots from the root to the brick, three bits a level; below kBakeBricks
    [[nodiscard]] std::span<const LeafPlot> of_brick(uint32_t number) const noexcept {
        return plots_.empty()
                   ? std::span<const LeafPlot>()
                   : std::span(plots_).subspan(begin_[number], begin_[number + 1] - begin_[number]);
    }
    /// The same, by leaf, then triangle.
    [[nodiscard]] std::vector<LeafPlot> sorted_by_leaf(uint32_t number) const;

private:
    int leaf_bits_ = 0; ///< of LeafPlot::leaf within a brick
    std::vector<LeafPlot> plots_;
    std::vector<size_t> begin_; ///< of each brick, and the end
};

} // namespace cl::gi
