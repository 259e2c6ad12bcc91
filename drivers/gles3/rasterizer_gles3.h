#pragma once

#include "drivers/gl_context.h"
#include "drivers/gles3/cone_path.h"

#include "servers/rasterizer.h"

#include "core/expected.h"

#include <memory>

namespace cl::gles3 {

/// Figures beyond FrameStats, for tests and bench.
struct RendererCounters {
    size_t scene_variants = 0; ///< scene programs compiled so far
    size_t caster_variants = 0;
    bool prepass = false;        ///< of the last frame
    bool cones_gathered = false; ///< ... whose cones were traced on the CPU
};

/// The renderer on OpenGL ES 3.0: forward shading, shadow maps, voxel cone tracing (ARCHITECTURE.md has the
/// passes). Any error that GL reports during a call fails that call. Main thread only; several may live side
/// by side.
class RasterizerGLES3 final : public Rasterizer {
public:
    /// @param context  where to draw; owned from now on.
    /// @param cone_path  where the cones of GI probes are traced; Gathered needs cones::can_gather()
    /// @return Unsupported if the driver cannot render to half floats, or what a shader's compiler said.
    [[nodiscard]] static Expected<std::unique_ptr<RasterizerGLES3>>
    create(std::unique_ptr<drivers::GLContext> context, ConePath cone_path = ConePath::Best);
    ~RasterizerGLES3() override;
    RasterizerGLES3(const RasterizerGLES3&) = delete;
    RasterizerGLES3& operator=(const RasterizerGLES3&) = delete;

    [[nodiscard]] RasterizerInfo info() const override;
    Expected<RID> texture_create(const Image& image, const TextureParams& params,
                                 TextureColorSpace space) override;
    Expected<RID> mesh_create(std::span<const MeshSurface> surfaces) override;
    Expected<RID> sky_create(const SkyDesc& sky) override;
    Expected<RID> gi_volume_create(const GIVolumeDesc& desc) override;
    Status gi_volume_upload(RID volume, int mip, glm::ivec3 offset, glm::ivec3 size,
                            std::span<const uint8_t> rgba8) override;
    Expected<RID> gi_field_create(const GIFieldDesc& desc) override;
    Status gi_field_upload(RID field, std::span<const uint32_t> light,
                           std::span<const uint16_t> air) override;
    Expected<RID> target_create(glm::ivec2 size) override;
    Status free(RID rid) override;
    Status draw(RID target, const Frame& frame) override;
    Expected<Image> target_read(RID target, TargetFormat format) override;
    [[nodiscard]] FrameStats last_stats() const override;
    void present() override;

    [[nodiscard]] RendererCounters counters() const;
    [[nodiscard]] drivers::GLContext& context() noexcept;

private:
    struct Impl;
    explicit RasterizerGLES3(std::unique_ptr<Impl> impl);
    std::unique_ptr<Impl> impl_;
};

} // namespace cl::gles3
