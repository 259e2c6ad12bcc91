#pragma once

#include "servers/gi/probe_data.h"

#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

namespace cl::gi {

// The ints of GIProbeData.dynamic_data: a header, then the cells as they are in memory.
inline constexpr size_t kHeaderInts = 16;
inline constexpr size_t kCellInts = 12;
static_assert(sizeof(Cell) == kCellInts * sizeof(int32_t), "a Cell is a cell record as stored");

/// Cells in a row. @param dynamic_data  which has them
[[nodiscard]] std::span<const int32_t> cells_of(std::span<const int32_t> dynamic_data, size_t first,
                                                size_t count) noexcept;

/// Writes an octree cell after cell to where it stays: its memory is touched once.
class OctreeWriter {
public:
    /// @param cell_count  there will be
    OctreeWriter(int levels, const glm::ivec3& dims, size_t cell_count);

    /// Number of the cell that is appended next.
    [[nodiscard]] uint32_t next() const noexcept {
        return uint32_t((ints_.size() - kHeaderInts) / kCellInts);
    }
    void append(const Cell& cell);
    /// @param cells  of an octree: whole ones
    /// @param shift  from their child indices to this octree's, modulo 2^32
    void append(std::span<const int32_t> cells, uint32_t shift);
    void append(std::span<const Cell> cells, uint32_t shift);
    void set_child(uint32_t cell, int slot, uint32_t child) noexcept;
    void set_level_alpha(uint32_t cell, uint32_t word) noexcept;
    [[nodiscard]] std::vector<int32_t> finish(uint32_t leaf_count);

private:
    std::vector<int32_t> ints_;
};

} // namespace cl::gi
