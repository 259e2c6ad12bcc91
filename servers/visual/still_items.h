#pragma once

#include "servers/radiosity/still_scene.h"
#include "servers/visual/instance_storage.h"
#include "servers/visual/storage.h"

#include <cstdint>
#include <memory>
#include <vector>

namespace cl {

/// An instance as light transport will see it: everything shared, so that another thread may read it while
/// the scene goes on.
struct StillItem {
    struct Surface {
        MaterialDesc material;
        std::shared_ptr<const Image> albedo_map, emission_map;
    };
    RID instance;
    uint64_t version = 0; ///< of the instance
    uint64_t look = 0;    ///< newest version of instance, mesh and materials
    Transform world_from_local;
    std::shared_ptr<const std::vector<MeshSurface>> mesh;
    std::vector<Surface> surfaces;
};

/// True if a material's surfaces take part in light transport: those that are solid or have holes.
[[nodiscard]] bool is_solid(const MaterialDesc& material) noexcept;

/// What an instance shows, with its materials.
[[nodiscard]] StillItem describe_still(const Storage& storage, RID rid, const Instance& instance);
/// The newest version of anything that describe_still() would tell: cheap, for every frame.
[[nodiscard]] uint64_t look_of(const Storage& storage, const Instance& instance) noexcept;

/// True if any surface of an instance is glossy.
[[nodiscard]] bool is_glossy(const Storage& storage, const Instance& instance) noexcept;

/// True if any surface of an instance is lit by the air, or has its normal bent by what the air knows.
/// @param is_still  its solid surfaces are lit by patches
[[nodiscard]] bool reads_air(const Storage& storage, const Instance& instance, bool is_still) noexcept;

/// All triangles of the items, in world space. Triangles with a number that is not finite are left out.
[[nodiscard]] radiosity::StillScene make_still_scene(std::span<const StillItem> items);

} // namespace cl
