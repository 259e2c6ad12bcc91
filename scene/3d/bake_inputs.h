#pragma once

#include "scene/3d/bake_materials.h"
#include "scene/3d/gi_probe_bake.h"

#include "servers/mesh_surface.h"

#include <cstdint>
#include <memory>
#include <optional>
#include <span>
#include <vector>

namespace cl::scene {

/// What items make a bake plot: their surfaces of triangles, in order, but damaged ones, which a warning
/// tells of. What items share is looked at, decoded and captured once, on all workers; decoded only where it
/// is asked for.
class BakeInputs {
public:
    /// @param items   live as long
    /// @param memory  null: nothing is kept, and there are no digests
    BakeInputs(std::span<const BakeItem> items, BakeMemory* memory);

    /// Of each surface: contents, place and material.
    [[nodiscard]] std::vector<Digest> digests() const;
    /// Live as long as this.
    [[nodiscard]] std::vector<gi::PlotSurface> plots(std::span<const uint32_t> numbers);
    [[nodiscard]] std::vector<gi::PlotSurface> all_plots();
    [[nodiscard]] int64_t triangle_count() const;

private:
    /// A surface that perhaps many items show.
    struct Stored {
        const MeshSurface* surface;
        std::optional<Error> damage;
        Digest digest;
        std::unique_ptr<SurfaceArrays> arrays; ///< null: not decoded yet
    };
    struct Placed {
        const BakeItem* item;
        size_t stored, material; ///< numbers
    };

    void list_surfaces(std::span<const BakeItem> items, std::vector<const Material*>& materials);
    void check_surfaces(bool with_digests);
    void decode(std::span<const uint32_t> numbers);

    std::vector<Stored> stored_;
    std::vector<Placed> placed_;
    std::optional<BakeMaterials> materials_; ///< always there after construction
};

} // namespace cl::scene
