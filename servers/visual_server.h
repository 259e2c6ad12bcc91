#pragma once

#include "servers/gi/probe_data.h"
#include "servers/mesh_surface.h"
#include "servers/rasterizer.h"
#include "servers/render_types.h"

#include "core/expected.h"
#include "core/image.h"
#include "core/math/transform.h"
#include "core/rid.h"

#include <memory>
#include <span>
#include <string>
#include <vector>

namespace cl {

struct RenderSettings {
    GIMode gi_mode = GIMode::Auto;
    Quality quality = Quality::High;
    Color clear_color{0.3f, 0.3f, 0.3f, 1.0f};
    int shadow_filter = 1;
    int shadow_atlas_size = 4096;
    int directional_shadow_size = 4096;
};

/// Figures of the last draw() and of the probes, for --stats.
struct ServerStats {
    FrameStats frame;        ///< summed over the viewports
    double relight_ms = 0.0; ///< last change of light to volume ready to draw, without the wait for the next
                             ///< step: work on the cells and upload, summed over the probes that changed
    double upload_ms = 0.0;  ///< the upload's part of it
    double transport_ms = 0.0; ///< making the light transport of GIMode::Auto
    int lights = 0;            ///< visible ones that stand in a scenario
    int instances = 0;         ///< of meshes that stand in a scenario
};

/// The only door from scene to renderer. RIDs are plain handles; a stale or foreign one is logged once,
/// answered with InvalidArgument, and drawing goes on. Main thread only.
class VisualServer {
public:
    explicit VisualServer(std::unique_ptr<Rasterizer> rasterizer);
    ~VisualServer();
    VisualServer(const VisualServer&) = delete;
    VisualServer& operator=(const VisualServer&) = delete;

    // --- data ------------------------------------------------------------------------------------
    /// Keeps the image until it was drawn in each colour space that materials use it in (albedo and emission
    /// are colours, all else numbers), then lets go of it. Null RID, and a line in the log, if pixels are
    /// missing.
    RID texture_create(Image image, const TextureParams& params = {});
    /// The same without a copy: the image is shared with the caller, who must not change it.
    RID texture_create(std::shared_ptr<const Image> image, const TextureParams& params = {});
    /// Pixel size of a texture; InvalidArgument if stale.
    Expected<glm::ivec2> texture_size(RID texture) const;

    RID material_create(const MaterialDesc& desc = {});
    Status material_set(RID material, const MaterialDesc& desc);

    /// @return what validate_surface() says of the first bad surface.
    Expected<RID> mesh_create(std::vector<MeshSurface> surfaces);
    Status mesh_surface_set_material(RID mesh, int surface, RID material);

    RID light_create(const LightDesc& desc);
    Status light_set(RID light, const LightDesc& desc);

    RID sky_create(SkyDesc desc);
    RID environment_create(const EnvironmentDesc& desc = {});
    Status environment_set(RID environment, const EnvironmentDesc& desc);

    RID camera_create(const CameraDesc& desc = {});
    Status camera_set(RID camera, const CameraDesc& desc);

    // --- GI probes -------------------------------------------------------------------------------
    RID gi_probe_create();
    /// Replaces all data: the probe starts over (spec gi-probe-data section 1: assignment recreates the
    /// state). With an empty blob it pairs by its bounds and is drawn as the null probe (spec gi-shading
    /// section 2); a probe that was never given data has no effect.
    /// @return ParseError if the blob or a number is not valid; the probe then has no data.
    Status gi_probe_set_data(RID probe, const gi::ProbeData& data);
    /// Live parameters: read each draw, or polled (propagation). No set-up is needed.
    Status gi_probe_set_energy(RID probe, float energy);
    Status gi_probe_set_bias(RID probe, float bias_cells);
    Status gi_probe_set_normal_bias(RID probe, float normal_bias_m);
    Status gi_probe_set_propagation(RID probe, float propagation);
    Status gi_probe_set_interior(RID probe, bool interior);
    Status gi_probe_set_dynamic_range(RID probe, int dynamic_range);

    // --- scenarios and instances -----------------------------------------------------------------
    RID scenario_create();
    Status scenario_set_environment(RID scenario, RID environment); ///< null RID: none

    /// An instance of a mesh, light or GI probe in a scenario. `base` null: nothing is drawn.
    RID instance_create(RID base, RID scenario);
    /// Another base drops the surface materials.
    Status instance_set_base(RID instance, RID base);
    Status instance_set_scenario(RID instance, RID scenario); ///< null RID: nowhere
    /// Lights and GI probes stand with the orthonormalised transform.
    Status instance_set_transform(RID instance, const Transform& world_from_local);
    Status instance_set_visible(RID instance, bool visible);
    Status instance_set_layers(RID instance, uint32_t mask);
    /// Null RID: the mesh's own.
    Status instance_set_surface_material(RID instance, int surface, RID material);
    Status instance_set_material_override(RID instance, RID material);
    Status instance_set_casting(RID instance, ShadowCasting casting);
    Status instance_set_use_in_baked_light(RID instance, bool on);
    Status instance_set_extra_margin(RID instance, float margin_m);

    // --- viewports -------------------------------------------------------------------------------
    RID viewport_create(glm::ivec2 size, bool to_window = false);
    Status viewport_set_size(RID viewport, glm::ivec2 size);
    Status viewport_set_scenario(RID viewport, RID scenario);
    Status viewport_set_camera(RID viewport, RID camera); ///< null RID: nothing but the background
    /// The last frame drawn: Srgb8 (RGBA8) or LinearFloat (RGBF).
    Expected<Image> viewport_read(RID viewport, TargetFormat format);

    /// Frees any RID of this server. Instances of a freed base become empty, those of a freed scenario are
    /// nowhere; what used a freed texture, material, sky, environment or camera goes on without.
    Status free(RID rid);

    // --- frames ----------------------------------------------------------------------------------
    void set_settings(const RenderSettings& settings);
    [[nodiscard]] const RenderSettings& settings() const;

    /// One frame: instances, viewports, then one step of each probe's state machine, as Godot orders it
    /// (spec gi-update section 2). @return the first error of the rasteriser.
    Status draw();
    /// False if draw() would show what it showed last, in every viewport: a window may sleep. After a window
    /// was uncovered it has to be drawn all the same.
    [[nodiscard]] bool has_changed();
    /// Steps the probes until none has anything to do: what is drawn next is settled. While it waits for the
    /// first light of all, it has the shaders compiled of viewports that were not drawn yet.
    void settle();
    /// True while a probe is being lit or uploaded, or would be on the next step.
    [[nodiscard]] bool is_settled();

    [[nodiscard]] ServerStats stats() const;
    [[nodiscard]] RasterizerInfo rasterizer_info() const;
    [[nodiscard]] Rasterizer& rasterizer(); ///< for tests

    /// Empty once the server is gone: a holder of RIDs asks it before freeing them.
    [[nodiscard]] std::weak_ptr<VisualServer> weak() const noexcept { return self_; }

private:
    struct Impl;
    [[nodiscard]] Impl& edit(); ///< by which all calls go that may change a picture
    std::unique_ptr<Impl> impl_;
    // Owns nothing, and is the last member: weak() is empty before anything else is torn down.
    std::shared_ptr<VisualServer> self_{this, [](VisualServer*) {}};
};

} // namespace cl
