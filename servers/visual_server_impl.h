#pragma once

#include "servers/visual/field_driver.h"
#include "servers/visual/frame_builder.h"
#include "servers/visual/instance_storage.h"
#include "servers/visual/probe_driver.h"
#include "servers/visual/stale_rids.h"
#include "servers/visual/storage.h"
#include "servers/visual_server.h"

#include "core/threads.h"

#include <cstdint>
#include <memory>
#include <string_view>
#include <utility>

namespace cl {

struct Viewport {
    glm::ivec2 size{0};
    bool to_window = false;
    RID scenario, camera;
    RID target; ///< the rasteriser's; null until first drawn, or the window
    glm::ivec2 target_size{0};
    bool drawn = false;
};

/// The parts behind the door. The order of members is the order they may use each other in; destruction runs
/// it backwards, so that probes give up their jobs before the worker is waited for, and volumes before the
/// rasteriser.
struct VisualServer::Impl {
    explicit Impl(std::unique_ptr<Rasterizer> backend)
        : rasterizer(std::move(backend)), storage(*rasterizer), instances(storage, *rasterizer),
          probes(storage, instances, *rasterizer, worker), fields(storage, instances, *rasterizer, worker),
          frames(storage, instances, fields) {}

    /// Calls f(Instance&) -> Status, or refuses the RID in the name of `call`.
    template <typename F>
    Status with_instance(std::string_view call, RID rid, F&& f) {
        Instance* instance = instances.get(rid);
        return instance ? f(*instance) : stale.refuse(call, "an instance", rid);
    }
    /// `rid` must be null or live in its owner.
    template <typename Owner>
    Status check_or_null(std::string_view call, std::string_view expected, RID rid, const Owner& owner) {
        return !rid || owner.owns(rid) ? Status{} : stale.refuse(call, expected, rid);
    }
    /// False if GI is off or the rasteriser follows light itself.
    [[nodiscard]] bool lights_by_gi() const;
    Status step_gi(Rest rest);
    Status let_light_come();
    [[nodiscard]] bool gi_is_settled();
    /// Grows whenever new light is there to be drawn.
    [[nodiscard]] uint64_t gi_uploads() const { return probes.uploads() + fields.uploads(); }
    void compile_shaders_meanwhile();
    Status ensure_target(Viewport& viewport);
    Status draw_viewport(Viewport& viewport);

    std::unique_ptr<Rasterizer> rasterizer;
    StaleRIDs stale;
    Storage storage;
    WorkerQueue worker;
    InstanceStorage instances;
    ProbeDriver probes;
    FieldDriver fields;
    FrameBuilder frames;
    RID_Owner<Viewport> viewports{static_cast<uint32_t>(RIDKind::Viewport)};
    RenderSettings settings;
    FrameStats frame_stats;
    bool edited = true;         ///< since the last draw()
    uint64_t drawn_uploads = 0; ///< gi_uploads() that the last draw() began with
};

} // namespace cl
