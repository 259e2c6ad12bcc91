#pragma once

#include "servers/rasterizer.h"

#include <memory>
#include <unordered_map>
#include <vector>

namespace cl {

/// Wraps a backend and checks every argument before it gets there, so that backends need not: sizes, mips,
/// spans, RIDs of the right kind, indices of a Frame. What is wrong is answered with InvalidArgument "call:
/// expected ..., found ..." and never reaches the backend.
class RasterizerChecked final : public Rasterizer {
public:
    explicit RasterizerChecked(std::unique_ptr<Rasterizer> backend);

    [[nodiscard]] RasterizerInfo info() const override { return backend_->info(); }
    [[nodiscard]] FrameContents frame_contents() const override { return backend_->frame_contents(); }
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
    [[nodiscard]] FrameStats last_stats() const override { return backend_->last_stats(); }
    void present() override { backend_->present(); }

    [[nodiscard]] Rasterizer& backend() noexcept { return *backend_; }

private:
    enum class Kind : uint8_t { Texture, Mesh, Sky, Volume, Field, Target };
    /// What must be known of a living thing to check later calls.
    struct Thing {
        Kind kind;
        size_t surfaces = 0; ///< of a mesh
        GIVolumeDesc volume;
        size_t field_slots = 0, field_points = 0; ///< of a field
    };
    Expected<RID> keep(Expected<RID> made, Thing thing);
    [[nodiscard]] const Thing* find(RID rid, Kind kind) const noexcept;
    [[nodiscard]] Status check_target(const char* call, RID target) const;
    [[nodiscard]] Status check_frame(const Frame& frame) const;
    [[nodiscard]] Status check_surface(RID mesh, int surface, const MaterialDesc* material) const;
    [[nodiscard]] Status check_item(const Frame& frame, const DrawItem& item) const;
    [[nodiscard]] Status check_light(const Frame& frame, size_t index) const;
    [[nodiscard]] Status check_probe(const GIProbeShading& probe) const;

    std::unique_ptr<Rasterizer> backend_;
    std::unordered_map<RID, Thing> things_;
};

} // namespace cl
