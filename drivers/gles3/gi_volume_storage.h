#pragma once

#include "drivers/gles3/gl/texture.h"
#include "drivers/gles3/rid_kinds.h"

#include "servers/rasterizer.h"

#include "core/expected.h"
#include "core/rid.h"

#include <cstdint>
#include <span>

namespace cl::gles3 {

/// The light volumes of GI probes: RGBA8 with mips, trilinear and linear between mips, clamped to the edge,
/// LOD clamped to the last level (spec gi-shading section 4.1).
class GIVolumeStorage {
public:
    /// A 1-cell volume of zeros for unused samplers: every sampler of a draw must have a texture.
    [[nodiscard]] static Expected<GIVolumeStorage> create();

    /// All texels of all levels are 0.
    /// @return InvalidArgument if a size is not a power of two or there are more mips than sizes,
    ///         Unsupported beyond the driver's limit.
    [[nodiscard]] Expected<RID> create(const GIVolumeDesc& desc);
    /// Replaces a box of one level, as Rasterizer::gi_volume_upload says.
    Status upload(RID rid, int mip, glm::ivec3 offset, glm::ivec3 size, std::span<const uint8_t> rgba8);
    /// nullptr if stale.
    [[nodiscard]] const gl::Texture3D* get(RID rid) const noexcept { return volumes_.get(rid); }
    [[nodiscard]] const gl::Texture3D& empty() const noexcept { return empty_; }
    bool free(RID rid) { return volumes_.free(rid); }

private:
    explicit GIVolumeStorage(gl::Texture3D empty) : empty_(std::move(empty)) {}
    RID_Owner<gl::Texture3D> volumes_{static_cast<uint32_t>(RIDKind::GIVolume)};
    gl::Texture3D empty_;
};

} // namespace cl::gles3
