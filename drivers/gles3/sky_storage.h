#pragma once

#include "drivers/gles3/gl/texture.h"
#include "drivers/gles3/rid_kinds.h"

#include "servers/render_types.h"

#include "core/expected.h"
#include "core/rid.h"

namespace cl::gles3 {

/// A sky's maps, all RGBA16F, linear radiance.
struct StoredSky {
    gl::Texture2D panorama;   ///< with mips, repeats around
    gl::Texture2D irradiance; ///< dual paraboloid
    gl::Texture3D radiance;   ///< dual paraboloids by roughness along z
    int panorama_width = 0;   ///< [texels]
};

class SkyStorage {
public:
    /// 1-texel stand-ins for the samplers of frames without a sky.
    [[nodiscard]] static Expected<SkyStorage> create();

    /// Filters the maps on all worker threads: about 0.2 s for 1024x512 on two.
    /// @return InvalidArgument if the radiance does not fill the size, Unsupported beyond the driver's
    /// limits.
    [[nodiscard]] Expected<RID> create(const SkyDesc& desc);
    /// nullptr if stale.
    [[nodiscard]] const StoredSky* get(RID rid) const noexcept { return skies_.get(rid); }
    [[nodiscard]] const StoredSky& none() const noexcept { return none_; }
    bool free(RID rid) { return skies_.free(rid); }

private:
    explicit SkyStorage(StoredSky none) : none_(std::move(none)) {}
    RID_Owner<StoredSky> skies_{static_cast<uint32_t>(RIDKind::Sky)};
    StoredSky none_;
};

} // namespace cl::gles3
