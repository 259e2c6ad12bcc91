#include "servers/gi/octree_writer.h"

#include "core/large_pages.h"

#include <utility>

namespace cl::gi {

namespace {

constexpr size_t kChildren = 8, kLevelAlpha = 11; ///< in a cell's ints

size_t begin_of(size_t cell) {
    return kHeaderInts + cell * kCellInts;
}

} // namespace

std::span<const int32_t> cells_of(std::span<const int32_t> dynamic_data, size_t first,
                                  size_t count) noexcept {
    return dynamic_data.subspan(begin_of(first), count * kCellInts);
}

OctreeWriter::OctreeWriter(int levels, const glm::ivec3& dims, size_t cell_count) {
    ints_.reserve(begin_of(cell_count));
    ask_for_large_pages(ints_.data(), begin_of(cell_count) * sizeof(int32_t));
    ints_.assign(kHeaderInts, 0);
    ints_[1] = levels;
    ints_[2] = dims.x;
    ints_[3] = dims.y;
    ints_[4] = dims.z;
}

void OctreeWriter::append(const Cell& cell) {
    append(std::span(&cell, 1), 0);
}

void OctreeWriter::append(std::span<const Cell> cells, uint32_t shift) {
    const auto* ints = reinterpret_cast<const int32_t*>(cells.data()); // of the same size, signs aside
    append(std::span(ints, cells.size() * kCellInts), shift);
}

void OctreeWriter::append(std::span<const int32_t> cells, uint32_t shift) {
    const size_t begin = ints_.size();
    ints_.insert(ints_.end(), cells.begin(), cells.end());
    if (shift == 0) {
        return;
    }
    for (size_t cell = begin; cell < ints_.size(); cell += kCellInts) {
        for (size_t slot = 0; slot < kChildren; ++slot) {
            int32_t& child = ints_[cell + slot];
            child = uint32_t(child) == kNoChild ? child : int32_t(uint32_t(child) + shift);
        }
    }
}

void OctreeWriter::set_child(uint32_t cell, int slot, uint32_t child) noexcept {
    ints_[begin_of(cell) + size_t(slot)] = int32_t(child);
}

void OctreeWriter::set_level_alpha(uint32_t cell, uint32_t word) noexcept {
    ints_[begin_of(cell) + kLevelAlpha] = int32_t(word);
}

std::vector<int32_t> OctreeWriter::finish(uint32_t leaf_count) {
    ints_[5] = int32_t(next());
    ints_[6] = int32_t(leaf_count);
    return std::move(ints_);
}

} // namespace cl::gi
