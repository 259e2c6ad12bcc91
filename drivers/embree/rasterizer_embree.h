#pragma once

#include "drivers/embree/path_tracer.h"

#include "servers/rasterizer.h"

#include <functional>
#include <memory>

namespace cl::embree {

/// Draws by path tracing on the CPU: slow, and right. It is what the other rasterisers are held to. The same
/// options and frame give the same picture to the bit, for any number of threads.
///
/// Left out, as it is no part of how light goes: fog, points and lines, blend modes but Mix, no_depth_test.
/// GI volumes and fields are refused: the server does not make any, since this backend wants the whole scene.
class RasterizerEmbree final : public Rasterizer {
public:
    /// Told the share of the picture that is done, 0 to 1, from any thread but never from two at once.
    using Progress = std::function<void(float)>;
    explicit RasterizerEmbree(const PathOptions& options, Progress progress = {});
    ~RasterizerEmbree() override;
    RasterizerEmbree(const RasterizerEmbree&) = delete;
    RasterizerEmbree& operator=(const RasterizerEmbree&) = delete;

    [[nodiscard]] RasterizerInfo info() const override;
    [[nodiscard]] FrameContents frame_contents() const override { return FrameContents::WholeScene; }
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

private:
    struct Impl;
    std::unique_ptr<Impl> impl_;
};

} // namespace cl::embree
