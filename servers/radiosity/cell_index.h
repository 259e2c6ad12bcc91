#pragma once

#include "core/math/transform.h"

#include <glm/common.hpp>
#include <glm/vec3.hpp>

#include <bit>
#include <cstdint>
#include <span>
#include <vector>

namespace cl::radiosity {

/// A box of cubic cells somewhere in the world.
struct CellGrid {
    glm::ivec3 dims{0}; ///< [cells]
    float cell_m = 1.0f;
    Transform cells_from_world; ///< [m] -> [cells]
    Transform world_from_cells;

    [[nodiscard]] bool contains(const glm::vec3& cells) const noexcept {
        return cells.x >= 0.0f && cells.y >= 0.0f && cells.z >= 0.0f && cells.x < float(dims.x) &&
               cells.y < float(dims.y) && cells.z < float(dims.z);
    }
    [[nodiscard]] glm::ivec3 bricks() const noexcept { return (dims + 3) / 4; }
    /// Order of cells: bricks of 4 x 4 x 4 (x fastest), cells within a brick likewise.
    [[nodiscard]] uint64_t order(const glm::ivec3& cell) const noexcept {
        const glm::ivec3 b = cell >> 2, n = bricks(), c = cell & 3;
        return ((uint64_t(b.z) * uint64_t(n.y) + uint64_t(b.y)) * uint64_t(n.x) + uint64_t(b.x)) * 64 +
               uint64_t(c.x | (c.y << 2) | (c.z << 4));
    }
    [[nodiscard]] glm::ivec3 cell_at(uint64_t order) const noexcept {
        const glm::ivec3 n = bricks();
        const int bit = int(order & 63), brick = int(order >> 6);
        const glm::ivec3 b(brick % n.x, brick / n.x % n.y, brick / (n.x * n.y));
        return b * 4 + glm::ivec3(bit & 3, (bit >> 2) & 3, bit >> 4);
    }
};

/// Numbers the occupied cells of a grid: a bit for each of the 64 cells of a brick, and the number of its
/// first, so that a cell's number is a sum of bits away. 16 bytes a brick; the shader reads the same words.
class CellIndex {
public:
    struct Brick {
        uint32_t low = 0, high = 0; ///< occupied cells of the brick, in order
        uint32_t first = 0;         ///< number of its first occupied cell
        uint32_t low_count = 0;     ///< bits in `low`
    };
    static constexpr uint32_t kNone = 0xFFFFFFFFu;

    CellIndex() = default;
    /// @param orders  CellGrid::order() of the occupied cells, ascending, each once
    CellIndex(const CellGrid& grid, std::span<const uint64_t> orders) : grid_dims_(grid.dims) {
        const glm::ivec3 n = grid.bricks();
        bricks_dims_ = n;
        bricks_.resize(size_t(n.x) * size_t(n.y) * size_t(n.z));
        for (uint64_t order : orders) {
            Brick& b = bricks_[order >> 6];
            ((order & 32) ? b.high : b.low) |= 1u << (order & 31);
        }
        for (Brick& b : bricks_) {
            b.first = count_;
            b.low_count = uint32_t(std::popcount(b.low));
            count_ += b.low_count + uint32_t(std::popcount(b.high));
        }
    }
    /// Has the memory fetched that find() will read. @param cell  of the grid
    void prefetch(const glm::ivec3& cell) const noexcept { __builtin_prefetch(&brick_of(cell)); }
    /// Number of an occupied cell, kNone for any other and outside the grid.
    [[nodiscard]] uint32_t find(const glm::ivec3& cell) const noexcept {
        if (uint32_t(cell.x) >= uint32_t(grid_dims_.x) || uint32_t(cell.y) >= uint32_t(grid_dims_.y) ||
            uint32_t(cell.z) >= uint32_t(grid_dims_.z)) {
            return kNone;
        }
        const glm::ivec3 c = cell & 3;
        const Brick& brick = brick_of(cell);
        const uint32_t bit = uint32_t(c.x | (c.y << 2) | (c.z << 4));
        const uint32_t word = bit < 32 ? brick.low : brick.high;
        const uint32_t mask = 1u << (bit & 31);
        if ((word & mask) == 0) {
            return kNone;
        }
        return brick.first + (bit < 32 ? 0u : brick.low_count) + uint32_t(std::popcount(word & (mask - 1)));
    }
    [[nodiscard]] uint32_t size() const noexcept { return count_; }
    [[nodiscard]] std::span<const Brick> bricks() const noexcept { return bricks_; }

private:
    [[nodiscard]] const Brick& brick_of(const glm::ivec3& cell) const noexcept {
        const glm::ivec3 b = cell >> 2;
        return bricks_[(size_t(b.z) * size_t(bricks_dims_.y) + size_t(b.y)) * size_t(bricks_dims_.x) +
                       size_t(b.x)];
    }

    glm::ivec3 grid_dims_{0}, bricks_dims_{0};
    uint32_t count_ = 0;
    std::vector<Brick> bricks_;
};

} // namespace cl::radiosity
