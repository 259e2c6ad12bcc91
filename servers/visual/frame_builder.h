#pragma once

#include "servers/rasterizer.h"
#include "servers/visual/field_driver.h"
#include "servers/visual/frustum.h"
#include "servers/visual/instance_storage.h"
#include "servers/visual/shadow_casters.h"
#include "servers/visual/storage.h"
#include "servers/visual_server.h"

#include "core/rid.h"

#include <vector>

namespace cl {

/// What is looked at, and from where.
struct View {
    glm::ivec2 size{0}; ///< [pixels]
    RID scenario, camera;
    FrameContents contents = FrameContents::InView;
};

/// Turns a view into the Frame that a rasteriser draws: culls, picks materials, lights and probes, and sorts.
/// The result depends on what stands in the scenario, never on the layout of the trees.
class FrameBuilder {
public:
    FrameBuilder(Storage& storage, InstanceStorage& instances, const FieldDriver& fields);

    /// Uploads what is seen for the first time. Instances must be up to date.
    /// @return pointers and spans into the builder, good until the next build()
    const Frame& build(const View& view, const RenderSettings& settings, FirstError& errors);

private:
    void clear(const View& view, const RenderSettings& settings);
    void resolve_environment(const Scenario* scenario, FirstError& errors);
    void add_directional_lights(const Scenario& scenario);
    /// Everything that is visible, wherever it stands: FrameContents::WholeScene.
    void add_world(const Scenario& scenario, FirstError& errors);
    void add_world_instance(const Instance& instance, FirstError& errors);
    void add_visible_instances(const Scenario& scenario, const Frustum& frustum, FirstError& errors);
    void add_instance(RID rid, Instance& instance, FirstError& errors);
    void choose_lights(const Instance& instance, DrawItem& item);
    void choose_probes(const Instance& instance, DrawItem& item);
    int light_index(RID light);
    int probe_index(RID probe);
    void add_casters(Scenario& scenario, FirstError& errors);
    void sort_items();

    /// What draw order goes by.
    struct SortKey {
        float nearest_depth_m = 0.0f; ///< of the world box: an instance's origin may be anywhere
        RID instance, material;
    };

    Storage& storage_;
    InstanceStorage& instances_;
    const FieldDriver& fields_;
    ShadowCasters casters_;
    Frame frame_;
    uint64_t frame_number_ = 0;
    std::vector<RID> seen_;
    std::vector<DrawItem> items_;
    std::vector<SortKey> keys_; ///< of items_, one for one
    std::vector<DrawItem> opaque_, transparent_;
    std::vector<LightItem> lights_;
    std::vector<GIProbeShading> probes_;
    std::vector<WorldItem> world_;
};

} // namespace cl
