// The ints of GIProbeData.dynamic_data (spec gi-probe-data section 5).
#include "servers/gi/octree_writer.h"

#include <fmt/format.h>

#include <cstring>

namespace cl::gi {

namespace {

Error parse_error(std::string message) {
    return {ErrorCode::ParseError, "dynamic_data: " + std::move(message)};
}

bool is_power_of_two(int64_t v) {
    return v > 0 && (v & (v - 1)) == 0;
}

/// The header's fields as the unsigned numbers they are.
struct Header {
    uint32_t version, levels, dims[3], cell_count, leaf_count;
};

Status check_header(const Header& h, size_t int_count) {
    if (h.version != 0) {
        return parse_error(fmt::format("expected version 0 in int 0, found {}", h.version));
    }
    if (h.levels < 7 || h.levels > 10) {
        return parse_error(fmt::format("expected 7 to 10 levels in int 1, found {}", h.levels));
    }
    const uint32_t longest = 1u << (h.levels - 1);
    for (int i = 0; i < 3; ++i) {
        if (!is_power_of_two(h.dims[i]) || h.dims[i] > longest) {
            return parse_error(fmt::format("expected a power of two up to {} in int {}, found {}", longest,
                                           2 + i, h.dims[i]));
        }
    }
    const size_t cells = (int_count - kHeaderInts) / kCellInts;
    if (h.cell_count != cells) {
        return parse_error(fmt::format("expected {} cells in int 5, found {}", cells, h.cell_count));
    }
    return {};
}

/// Checks cells in the order of the array. Children come after their parent, so when a cell is reached, its
/// own parent has already said where it lies: one pass, no recursion, and a cycle shows as a child that is
/// not later.
class CellChecker {
public:
    CellChecker(const Octree& octree) : octree_(octree), place_(octree.cells.size()) {
        place_[0].has_parent = true;
    }

    Status check() {
        for (uint32_t i = 0; i < octree_.cells.size(); ++i) {
            if (Status s = check_cell(i); !s) {
                return s;
            }
        }
        if (leaves_ != octree_.leaf_count) {
            return parse_error(
                fmt::format("expected {} leaves in int 6, found {}", leaves_, octree_.leaf_count));
        }
        return {};
    }

private:
    /// What a cell's parent says of it.
    struct Place {
        uint16_t origin[3] = {0, 0, 0}; ///< [leaf cells]
        uint8_t level = 0;
        bool has_parent = false;
    };

    Status check_cell(uint32_t index) {
        const Place place = place_[index];
        if (!place.has_parent) {
            return parse_error(fmt::format("expected a parent of cell {}, found none", index));
        }
        const uint32_t level = octree_.cells[index].level_alpha >> 16;
        if (level != place.level) {
            return parse_error(
                fmt::format("expected level {} of cell {}, found {}", place.level, index, level));
        }
        const bool is_leaf = int(level) == octree_.levels - 1;
        leaves_ += is_leaf ? 1 : 0;
        for (uint32_t slot = 0; slot < 8; ++slot) {
            const uint32_t child = octree_.cells[index].children[slot];
            if (child == kNoChild) {
                continue;
            }
            if (is_leaf) {
                return parse_error(fmt::format("expected no children of leaf cell {}, found {} in slot {}",
                                               index, child, slot));
            }
            if (Status s = place_child(index, slot, child); !s) {
                return s;
            }
        }
        return {};
    }

    Status place_child(uint32_t parent, uint32_t slot, uint32_t child) {
        if (child <= parent || child >= octree_.cells.size()) {
            return parse_error(fmt::format("expected child {} of cell {} in {} to {}, found {}", slot, parent,
                                           uint64_t(parent) + 1, octree_.cells.size() - 1, child));
        }
        Place& place = place_[child];
        if (place.has_parent) {
            return parse_error(
                fmt::format("expected one parent of cell {}, found a second, cell {}", child, parent));
        }
        place.has_parent = true;
        place.level = uint8_t(place_[parent].level + 1);
        const int half = 1 << (octree_.levels - 1 - place.level);
        for (int axis = 0; axis < 3; ++axis) {
            const int origin = place_[parent].origin[axis] + (((slot >> axis) & 1) ? half : 0);
            if (origin >= octree_.dims[axis]) {
                return parse_error(fmt::format("expected cell {} below {} on {}, found it at {}", child,
                                               octree_.dims[axis], "xyz"[axis], origin));
            }
            place.origin[axis] = uint16_t(origin);
        }
        return {};
    }

    const Octree& octree_;
    std::vector<Place> place_;
    uint32_t leaves_ = 0;
};

} // namespace

Expected<Octree> decode_octree(std::span<const int32_t> dynamic_data) {
    const size_t n = dynamic_data.size();
    if (n < kHeaderInts + kCellInts || (n - kHeaderInts) % kCellInts != 0) {
        return parse_error(fmt::format("expected 16 + 12 * cells ints, at least 28, found {}", n));
    }
    Header header{};
    std::memcpy(&header, dynamic_data.data(), sizeof header);
    if (Status s = check_header(header, n); !s) {
        return s.error();
    }
    Octree octree;
    octree.levels = int(header.levels);
    octree.dims = {int(header.dims[0]), int(header.dims[1]), int(header.dims[2])};
    octree.leaf_count = header.leaf_count;
    octree.cells.resize(header.cell_count);
    std::memcpy(octree.cells.data(), dynamic_data.data() + kHeaderInts, octree.cells.size() * sizeof(Cell));
    if (Status s = CellChecker(octree).check(); !s) {
        return s.error();
    }
    return octree;
}

std::vector<int32_t> encode_octree(const Octree& octree) {
    OctreeWriter writer(octree.levels, octree.dims, octree.cells.size());
    writer.append(octree.cells, 0);
    return writer.finish(octree.leaf_count);
}

} // namespace cl::gi
