#pragma once

#include "servers/rasterizer.h"
#include "servers/visual/instance_storage.h"
#include "servers/visual/storage.h"

#include <optional>
#include <span>
#include <vector>

namespace cl {

/// The material a surface is drawn with: the instance's override, its own for the surface, the mesh's, the
/// default (spec scene-classes section 4).
[[nodiscard]] MaterialStorage::Resolved surface_material(Storage& storage, const Instance& instance,
                                                         const Mesh& mesh, int surface, FirstError& errors);

/// Collects what casts the shadows of one frame's lights.
class ShadowCasters {
public:
    ShadowCasters(Storage& storage, InstanceStorage& instances) : storage_(storage), instances_(instances) {}

    void clear();
    /// Casters of a light: of an omni or spot light those whose box overlaps its own; of a directional one
    /// all. Fills `casters_version` at once; the spans come with finish(), when the list has stopped growing.
    void add_light(Scenario& scenario, Instance& light_instance, const Light& light, LightItem& item,
                   FirstError& errors);
    /// Sets `casters` of the lights added, which are `lights` in the order they were added in.
    void finish(std::span<LightItem> lights);
    /// World box of what casts directional shadows.
    [[nodiscard]] const AABB& directional_bounds() const noexcept { return directional_bounds_; }

private:
    struct Range {
        size_t begin = 0, count = 0;
    };
    Range collect(Scenario& scenario, const std::optional<AABB>& box, FirstError& errors);
    void add_instance(RID rid, const Instance& instance, FirstError& errors);
    /// True if the range is not what `memory` holds, which it then does.
    bool remember(Range range, uint64_t light_version, CasterMemory& memory) const;

    Storage& storage_;
    InstanceStorage& instances_;
    std::vector<CasterItem> casters_;
    std::vector<CasterMemory::Key> keys_; ///< of casters_, one for one
    std::vector<Range> ranges_;           ///< of the lights added
    std::optional<Range> directional_;    ///< shared by all directional lights
    AABB directional_bounds_;
    std::vector<RID> found_;
};

} // namespace cl
