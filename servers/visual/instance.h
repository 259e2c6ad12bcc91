#pragma once

#include "servers/probe/probe_machine.h"
#include "servers/visual/box_tree.h"
#include "servers/visual_server.h"

#include "core/math/aabb.h"
#include "core/math/transform.h"
#include "core/rid.h"

#include <cstdint>
#include <memory>
#include <optional>
#include <vector>

namespace cl {

/// What an instance shows.
enum class InstanceKind : uint8_t { Empty, Mesh, DirectionalLight, LocalLight, GIProbe };

/// Which casters a light's shadow was last drawn with, to know when it must be drawn again.
struct CasterMemory {
    struct Key {
        RID instance;
        int surface = 0;
        uint64_t version = 0;
        friend bool operator==(const Key&, const Key&) = default;
    };
    std::vector<Key> keys;
    uint64_t light_version = 0;
    uint64_t version = 0; ///< LightItem::casters_version
};

/// A base placed in a scenario.
struct Instance {
    RID base, scenario; ///< null: nothing, nowhere
    InstanceKind kind = InstanceKind::Empty;
    Transform world_from_local;
    bool visible = true;
    uint32_t layers = 1;
    /// May be shorter than the mesh has surfaces. Null RID: the mesh's own.
    std::vector<RID> surface_materials;
    RID material_override;
    ShadowCasting casting = ShadowCasting::On;
    bool use_in_baked_light = false;
    float extra_margin_m = 0.0f;
    uint64_t version = 0;       ///< changes when its shadow, or the shadows it casts, would
    uint64_t still_version = 0; ///< look_of() that the GI field knows; 0: it is not in it

    // Kept by InstanceStorage: true of the last update().
    bool queued = false;
    std::optional<BoxTree::Entry> tree_entry; ///< set while it can be paired
    AABB world_bounds;                        ///< of tree_entry
    uint64_t pair_sequence = 0;               ///< later entries pair later
    std::vector<RID> lights, probes;          ///< of a mesh: local lights and probes in the order they paired

    std::unique_ptr<ProbeMachine> probe; ///< of a GI probe in a scenario
    CasterMemory casters;                ///< of a light

    // Kept by FrameBuilder: its place in the frame being built.
    uint64_t frame = 0;
    int frame_index = -1;
};

/// A world: what stands in it, findable by box.
struct Scenario {
    RID environment;
    BoxTree meshes, local_lights, gi_probes;
    std::vector<RID> directional_lights; ///< in the order they came
    uint64_t next_pair_sequence = 1;
};

} // namespace cl
