#pragma once

#include "servers/gi/probe_data.h"
#include "servers/render_types.h"

#include <cstdint>
#include <span>
#include <vector>

namespace cl::gi {

/// What relighting reads of a light (spec gi-update section 4); compared exactly, field by field.
struct CachedLight {
    LightType type = LightType::Omni;
    Transform cells_from_light;      ///< L2C * light global
    glm::vec3 color{1.0f};           ///< sRGB-encoded numbers, used as they are
    float energy = 1.0f;             ///< light_energy * light_indirect_energy
    float range_m = 5.0f;
    float attenuation = 1.0f;
    float spot_angle_deg = 45.0f;
    float spot_attenuation = 1.0f;
    bool visible = true;
    friend bool operator==(const CachedLight&, const CachedLight&) = default;
};

using Energy = uint16_t; ///< 1024 = radiance 1.0

/// The octree laid out for relighting: leaves in slot order (Morton-like), cells level by level.
/// Structure only; the energies live in LightVolume.
struct CellLayout {
    int levels = 0;
    glm::ivec3 dims{0};
    struct Leaf {
        uint32_t cell;
        glm::u16vec3 voxel;
        glm::u8vec3 albedo;
        glm::vec3 normal; ///< byte / 255 * 2 - 1, not renormalised
    };
    std::vector<Leaf> leaves;
    std::vector<Cell> cells;                           ///< copy of the octree's
    std::vector<glm::u16vec3> voxels;                  ///< per cell, at its own level
    std::vector<std::vector<uint32_t>> cells_of_level; ///< post-order within a level
};
[[nodiscard]] CellLayout make_layout(const Octree& octree);

/// Energies of all cells [3 per cell].
struct CellEnergies {
    std::vector<Energy> rgb; ///< 3 * cell count
};
/// Emission as energy of each leaf [3 per leaf]: where the sums of inject_light() start (section 3, step 2).
[[nodiscard]] std::vector<int32_t> emission_energies(const CellLayout& layout);

/// Adds (sign +1) or removes (sign -1) one light's bounce at every leaf it reaches (section 5).
/// Sums are int32 and exact, so taking a light out restores the bytes from before it came; they never wrap.
/// @param leaf_energies  3 per leaf, in the order of layout.leaves; 1024 = radiance 1.0.
/// Departs from Godot: the clip planes are reset for each leaf, so no light passes walls (section 5.4).
void inject_light(const CellLayout& layout, const CachedLight& light, int sign, std::span<int32_t> leaf_energies);

/// Energies of every cell from the leaves' sums (clamped to 0..65535 here, where Godot wraps), down-sampled level
/// by level (section 6). The same bytes for any history of light edits.
/// @param leaf_energies  3 per leaf, unclamped sums of emission and lights, kept between calls.
void energies_from_leaves(const CellLayout& layout, std::span<const int32_t> leaf_energies, float propagation,
                          CellEnergies& out);

/// One texture level: RGBA8, size dims >> mip (section 7).
struct MipLevel {
    glm::ivec3 size{0};
    std::vector<uint8_t> rgba8; ///< x fastest, then y, then z
};
[[nodiscard]] int mip_count(const glm::ivec3& dims) noexcept;
/// rgb = energy / dynamic range, a = opacity (section 7). `levels` is reused between calls.
void encode_mips(const CellLayout& layout, const CellEnergies& energies, int dynamic_range,
                 std::vector<MipLevel>& levels);

} // namespace cl::gi
