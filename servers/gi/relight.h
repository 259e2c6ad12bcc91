#pragma once

#include "servers/gi/leaf_bitmap.h"
#include "servers/gi/probe_data.h"
#include "servers/render_types.h"

#include <glm/common.hpp>
#include <glm/ext/vector_uint3_sized.hpp>
#include <glm/vec3.hpp>

#include <cstdint>
#include <optional>
#include <span>
#include <vector>

namespace cl::gi {

// Relighting as pure functions on spans: layout, then sums of lights per leaf, then energies, then texture
// bytes: those that Godot 3.2.3 uploads, in every mip.

/// What relighting reads of a light (spec gi-update section 4); compared exactly, field by field.
struct CachedLight {
    LightType type = LightType::Omni;
    Transform cells_from_light; ///< L2C * light global
    glm::vec3 color{1.0f};      ///< sRGB-encoded numbers, used as they are
    float energy = 1.0f;        ///< light_energy * light_indirect_energy
    float range_m = 5.0f;
    float attenuation = 1.0f;
    float spot_angle_deg = 45.0f;
    float spot_attenuation = 1.0f;
    bool visible = true;
    friend bool operator==(const CachedLight&, const CachedLight&) = default;
};

using Energy = uint16_t; ///< 1024 = radiance 1.0

/// The octree laid out for relighting: its cells level by level from the root, each level in slot order
/// (Morton-like), so that every pass reads memory from one end to the other. Structure only; energies are
/// kept by the caller.
struct CellLayout {
    int levels = 0;
    glm::ivec3 dims{0};
    struct Leaf {
        glm::u16vec3 voxel{0};
        glm::u8vec3 albedo{0};
        glm::vec3 normal{0.0f}; ///< byte / 255 * 2 - 1, not renormalised
        uint32_t emission = 0;  ///< Cell::emission
    };
    std::vector<Leaf> leaves;          ///< the cells of the last level
    std::vector<uint32_t> level_begin; ///< first cell of each level, and the number of cells
    std::vector<glm::u16vec3> voxels;  ///< per cell, at its own level
    std::vector<uint8_t> opacity;      ///< per cell
    /// Per cell above the leaves, and the end: its children are [first_child[i], first_child[i + 1]).
    std::vector<uint32_t> first_child;
    LeafBitmap leaf_bitmap;

    [[nodiscard]] size_t cell_count() const noexcept { return voxels.size(); }
};
/// Spec gi-update section 3, step 2. @param octree  as decode_octree() returns it.
[[nodiscard]] CellLayout make_layout(const Octree& octree);

/// Energies of all cells.
struct CellEnergies {
    std::vector<Energy> rgb;          ///< 3 * cell count, in the order of the layout
    std::optional<float> propagation; ///< that inner cells were made with; none: they hold nothing yet
};

/// Per mip, and per brick of it (bricks.h, in the order of the layout): 1 if an energy in it changed. Mips go
/// on to the root, also where the texture ends sooner.
struct ChangedBricks {
    std::vector<std::vector<uint8_t>> mips;
};

/// Emission as energy of each leaf [3 per leaf]: where the sums of inject_light() start (section 3, step 2).
[[nodiscard]] std::vector<int32_t> emission_energies(const CellLayout& layout);

/// A leaf that a light reaches, and the share of the light that the surface there receives.
struct LitLeaf {
    uint32_t leaf = 0;
    float share = 0.0f; ///< cosine, falloff and cone
};

/// The leaves that a light reaches (section 5), in their order: what does not depend on its colour and
/// energy, nor on whether it is visible. The same for any number of threads. None if its numbers are not
/// finite. Lamps light some leaves through walls, those that Godot lights (section 5.4, clip_planes.h).
/// Departs from Godot: a leaf exactly on a spot's axis is lit where Godot's arc cosine may be NaN.
[[nodiscard]] std::vector<LitLeaf> find_lit_leaves(const CellLayout& layout, const CachedLight& light);

/// True if both lights reach the same leaves by the same shares.
[[nodiscard]] bool reach_alike(const CachedLight& a, const CachedLight& b) noexcept;

/// True if the light adds nothing anywhere: it is invisible or black, or its numbers are not finite.
[[nodiscard]] bool is_dark(const CachedLight& light) noexcept;

/// Adds (sign +1) or removes (sign -1) the bounce of a light at the leaves that it reaches. Sums are int32
/// and exact, so removing a light restores the numbers from before it came; one light adds at most 2^24
/// (radiance 16384), so that more than a hundred of the strongest fit.
/// @param leaf_energies  3 per leaf, in the order of layout.leaves; 1024 = radiance 1.0.
void add_light(const CellLayout& layout, std::span<const LitLeaf> lit, const CachedLight& light, int sign,
               std::span<int32_t> leaf_energies);

/// find_lit_leaves() and add_light(), unless the light is dark.
void inject_light(const CellLayout& layout, const CachedLight& light, int sign,
                  std::span<int32_t> leaf_energies);

/// Energies of every cell from the leaves' sums (clamped to 0..65535 here, where Godot wraps), down-sampled
/// level by level (section 6). The same bytes for any history of light edits.
/// @param leaf_energies  3 per leaf, unclamped sums of emission and lights, kept between calls.
/// @param propagation    0: mean over eight children, empty ones black; 1: mean over those that exist.
/// @param energies  new, or as a former call for the same layout left them: then only cells above leaves that
///                  changed are summed anew, unless propagation changed.
/// @return what differs from before; all, if `energies` were new.
ChangedBricks energies_from_leaves(const CellLayout& layout, std::span<const int32_t> leaf_energies,
                                   float propagation, CellEnergies& energies);

/// How texels are kept: as they are, or by way of Godot's DXT5 blocks (section 7.1, s3tc.h).
enum class TexelCoding : uint8_t { Plain, Dxt5 };

/// Levels of a texture of plain texels: dims are halved until one of them is 1.
[[nodiscard]] int mip_count(const glm::ivec3& dims) noexcept;
/// Levels of a layout's texture. 0 if it is too thin for blocks (s3tc.h).
[[nodiscard]] int mip_count(const CellLayout& layout, TexelCoding coding) noexcept;

/// Boxes of a texture whose level m has dims >> m texels, and the texels that go there.
struct TexelBoxes {
    struct Box {
        int mip = 0;
        glm::ivec3 offset{0}, size{0}; ///< [texels]
        size_t first_byte = 0;
        [[nodiscard]] size_t bytes() const { return size_t(size.x) * size_t(size.y) * size_t(size.z) * 4; }
    };
    std::vector<Box> boxes;
    std::vector<uint8_t> rgba8; ///< at least what the boxes need; x fastest, then y, then z

    [[nodiscard]] std::span<const uint8_t> texels_of(const Box& box) const {
        return std::span(rgba8).subspan(box.first_byte, box.bytes());
    }
};

/// rgb = energy / dynamic range, a = opacity (section 7), for each brick in `changed`. Texels of no brick, as
/// those that no cell lies in, are 0.
/// @param dynamic_range  less than 1 counts as 1.
/// @param out  replaced; its memory is used again.
void encode_bricks(const CellLayout& layout, const CellEnergies& energies, int dynamic_range,
                   TexelCoding coding, const ChangedBricks& changed, TexelBoxes& out);

} // namespace cl::gi
