#pragma once

#include "core/expected.h"
#include "core/math/aabb.h"
#include "core/math/transform.h"

#include <glm/vec3.hpp>

#include <cstdint>
#include <span>
#include <vector>

namespace cl::gi {

/// What a GIProbeData resource holds (spec gi-probe-data section 2), with that resource's defaults.
struct ProbeData {
    AABB bounds{glm::vec3(0.0f), glm::vec3(1.0f)}; ///< true box, probe-local [m]
    float cell_size_m = 1.0f;
    Transform cells_from_local;        ///< `to_cell_xform`
    std::vector<int32_t> dynamic_data; ///< header and cells, section 5; empty = never baked
    int dynamic_range = 1;
    float energy = 1.0f;
    float bias_cells = 0.4f;
    float normal_bias_m = 0.4f;
    float propagation = 1.0f;
    bool interior = false;
    bool compress = false;
};

/// The cells that a probe of some extents has. N = 64, 128, 256 or 512 leaf cells along the longest axis.
struct Grid {
    glm::ivec3 dims{0}; ///< [cells], powers of two
    int levels = 0;     ///< 7 to 10; N = 2^(levels - 1)
    float cell_size_m = 0.0f;
    AABB box;       ///< true box, probe-local
    AABB cubic_box; ///< root cell: the cube of the longest axis
    Transform cells_from_local;
};
/// Section 3 of gi-probe-data. @param subdivision 64, 128, 256 or 512.
/// @return InvalidArgument where Godot would hang or make a zero-sized grid: an extent that is not in 1e-6 to
/// 1e9 m
///         (beyond, float32 loses the cells), or an axis thinner than half a cell.
[[nodiscard]] Expected<Grid> compute_grid(const glm::vec3& extents_m, int subdivision);

/// Where the cells of baked data lie.
struct GridScale {
    float cell_size_m = 1.0f;
    Transform cells_from_local;
};
/// Those of `data`, with all digits that a bake of its box computes where they agree in the six that Godot's
/// text keeps: a saved bake then looks as it did before it was saved. The last digit decides whether surfaces
/// on a face of the box lie inside. @param levels  of the octree, 7 to 10
[[nodiscard]] GridScale grid_scale(const ProbeData& data, int levels) noexcept;

inline constexpr uint32_t kNoChild = 0xFFFFFFFFu;

/// One octree cell, as stored (section 5.2).
struct Cell {
    uint32_t children[8];
    uint32_t albedo;      ///< 0x00RRGGBB, sRGB-encoded
    uint32_t emission;    ///< 0xRRGGBBLL
    uint32_t normal;      ///< 0x00XXYYZZ
    uint32_t level_alpha; ///< level in bits 31..16, alpha in 15..0
};

struct Octree {
    int levels = 0;
    glm::ivec3 dims{0};
    uint32_t leaf_count = 0;
    std::vector<Cell> cells; ///< cell 0 is the root
};
/// Reads and validates a blob: version, sizes, counts, child indices, levels (section 5.4). Never trusts a
/// number: it allocates in proportion to the ints given, and what it returns is a tree whose cells all lie
/// inside dims.
/// @return ParseError "dynamic_data: expected ..., found ..." for the first int or cell that is wrong.
[[nodiscard]] Expected<Octree> decode_octree(std::span<const int32_t> dynamic_data);
/// Writes a blob; padding ints are 0, where Godot leaves whatever memory held (section 5.1).
[[nodiscard]] std::vector<int32_t> encode_octree(const Octree& octree);

} // namespace cl::gi
