#pragma once

#include "servers/gi/captured_map.h"
#include "servers/gi/probe_data.h"

#include "core/image.h"

#include <glm/vec2.hpp>
#include <glm/vec3.hpp>

#include <functional>
#include <memory>
#include <span>
#include <vector>

namespace cl::gi {

/// A material as the bake sees it: albedo and emission, sRGB-encoded numbers used as they are
/// (spec gi-bake section 3).
struct MaterialCapture {
    CapturedMap albedo;
    CapturedMap emission;
};

struct CaptureInput {
    glm::vec3 albedo_color{1.0f};
    const Image* albedo_texture = nullptr; ///< null: none
    glm::vec3 emission_color{0.0f};        ///< times energy
    float emission_energy = 1.0f;
    bool emission_multiply = false;
    const Image* emission_texture = nullptr;
    friend bool operator==(const CaptureInput&, const CaptureInput&) = default;
};
[[nodiscard]] MaterialCapture capture_material(const CaptureInput& input);

/// Godot's cubic resize to RGBA8 (spec gi-bake section 3), byte for byte. @param image  RGBA8, or RGB8 with
/// alpha 255
[[nodiscard]] Image resize_cubic_rgba8(const Image& image, glm::ivec2 size);

/// Triangles to plot: one surface of one instance. Spans live until voxelize() returns.
struct PlotSurface {
    Transform local_from_mesh; ///< probe-local [m] from mesh
    std::span<const glm::vec3> positions;
    std::span<const glm::vec3> normals;        ///< mesh space, empty = none
    std::span<const glm::vec2> uvs;            ///< empty = none
    std::span<const uint32_t> indices;         ///< empty = consecutive vertices; leftovers are dropped
    const MaterialCapture* material = nullptr; ///< never null
};

/// Called with the share of the plot that is done, in [0, 1], never less than before; returning false
/// cancels. One call at a time, but perhaps on a worker thread.
using BakeProgress = std::function<bool(float)>;

/// Most cells of a bake: 3.5 GiB of them.
inline constexpr uint32_t kMaxCells = 1u << 26;

struct BakeLimits {
    uint32_t max_cells = kMaxCells; ///< kMaxCells at most
};

/// An octree as a probe keeps it.
struct BakedOctree {
    std::vector<int32_t> dynamic_data; ///< as encode_octree() writes it
    uint32_t cell_count = 0;           ///< of all levels
    uint32_t leaf_count = 0;
};

/// Voxelises surfaces into an octree: plot, fix-up and quantisation of spec gi-bake sections 4 to 6.
/// Godot 3.2.3 bakes the same cells; their order in the array is depth first here, where Godot's is the order
/// of creation. The result is the same for any number of threads.
/// @return InvalidArgument if a surface's arrays do not fit together or its material is missing; Cancelled if
///         `progress` said so; OutOfMemory beyond `limits`.
/// Departs: triangles with coordinates that are not finite or beyond 1e12 m are left out.
[[nodiscard]] Expected<BakedOctree> voxelize(const Grid& grid, std::span<const PlotSurface> surfaces,
                                             const BakeProgress& progress = {},
                                             const BakeLimits& limits = {});

/// Separating-axis test of gi-bake section 4.1; touching counts as overlap. float32 throughout.
[[nodiscard]] bool triangle_overlaps_box(const glm::vec3& center, const glm::vec3& half, const glm::vec3& a,
                                         const glm::vec3& b, const glm::vec3& c) noexcept;

} // namespace cl::gi
