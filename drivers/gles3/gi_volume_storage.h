#pragma once

#include "drivers/gles3/cone_path.h"
#include "drivers/gles3/gl/texture.h"
#include "drivers/gles3/rid_kinds.h"

#include "servers/cones/volume.h"
#include "servers/rasterizer.h"

#include "core/expected.h"
#include "core/rid.h"

#include <cstdint>
#include <optional>
#include <span>

namespace cl::gles3 {

/// The light volumes of GI probes: RGBA8 with mips, trilinear and linear between mips, clamped to the edge,
/// LOD clamped to the last level (spec gi-shading section 4.1). Where cones are traced on the CPU a volume is
/// there, and a texture only once a shader has asked for it.
class GIVolumeStorage {
public:
    /// A 1-cell volume of zeros for unused samplers: every sampler of a draw must have a texture.
    /// @param cones  Gathered, or else InShader
    [[nodiscard]] static Expected<GIVolumeStorage> create(ConePath cones = ConePath::InShader);

    /// All texels of all levels are 0.
    /// @return InvalidArgument if a size is not a power of two or there are more mips than sizes,
    ///         Unsupported beyond the driver's limit.
    [[nodiscard]] Expected<RID> create(const GIVolumeDesc& desc);
    /// Replaces a box of one level, as Rasterizer::gi_volume_upload says.
    Status upload(RID rid, int mip, glm::ivec3 offset, glm::ivec3 size, std::span<const uint8_t> rgba8);
    /// For shaders. nullptr if stale, or if the driver has no memory for it.
    [[nodiscard]] const gl::Texture3D* get(RID rid);
    /// For cones on the CPU. nullptr if stale, or if only shaders look into it.
    [[nodiscard]] cones::Volume* cpu_volume(RID rid) noexcept;
    [[nodiscard]] const gl::Texture3D& empty() const noexcept { return empty_; }
    bool free(RID rid) { return volumes_.free(rid); }

private:
    /// At least one of the two is there; both have the same texels.
    struct Stored {
        std::optional<gl::Texture3D> texture;
        std::optional<cones::Volume> cpu;
    };
    GIVolumeStorage(gl::Texture3D empty, ConePath cones) : empty_(std::move(empty)), cones_(cones) {}
    RID_Owner<Stored> volumes_{static_cast<uint32_t>(RIDKind::GIVolume)};
    gl::Texture3D empty_;
    ConePath cones_;
};

} // namespace cl::gles3
