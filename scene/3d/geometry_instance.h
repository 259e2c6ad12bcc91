#pragma once

#include "scene/3d/visual_instance.h"
#include "scene/resources/material.h"

#include "servers/visual_server.h"

namespace cl::scene {

/// A node with a surface: how it is drawn, whether it casts shadows and takes part in GI.
class GeometryInstance : public VisualInstance {
public:
    static constexpr std::string_view kClassName = "GeometryInstance";
    static void bind(ClassBuilder<GeometryInstance>& c);

    /// Replaces the materials of all surfaces; null: none.
    [[nodiscard]] const Ref<Material>& material_override() const noexcept { return material_override_; }
    void set_material_override(Ref<Material> material);
    [[nodiscard]] ShadowCasting cast_shadow() const noexcept { return cast_shadow_; }
    SetResult set_cast_shadow(ShadowCasting casting);
    /// Grows the box used for culling and pairing on all sides [m]; refused below 0.
    [[nodiscard]] float extra_cull_margin() const noexcept { return extra_cull_margin_m_; }
    SetResult set_extra_cull_margin(float margin_m);
    /// Included in GI bakes, and shaded with the probe's biases.
    [[nodiscard]] bool use_in_baked_light() const noexcept { return use_in_baked_light_; }
    void set_use_in_baked_light(bool on);

    /// Distances between which the node was meant to be drawn; kept for saving, without effect [m].
    struct LodRange {
        float min_distance_m = 0.0f, min_hysteresis_m = 0.0f, max_distance_m = 0.0f, max_hysteresis_m = 0.0f;
    };
    [[nodiscard]] const LodRange& lod_range() const noexcept { return lod_; }
    void set_lod_range(const LodRange& range) { lod_ = range; }

protected:
    void describe_instance(VisualServer& server, RID instance) override;

private:
    Ref<Material> material_override_;
    ShadowCasting cast_shadow_ = ShadowCasting::On;
    float extra_cull_margin_m_ = 0.0f;
    bool use_in_baked_light_ = false;
    LodRange lod_;
};

} // namespace cl::scene
