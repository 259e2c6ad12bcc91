#pragma once

#include "servers/rasterizer.h"
#include "servers/visual/first_error.h"

#include "core/rid.h"

#include <optional>

namespace cl {

/// Skies: a panorama in memory until first drawn, prepared by the rasteriser from then on.
class SkyStorage {
public:
    explicit SkyStorage(Rasterizer& rasterizer);

    RID make(SkyDesc desc);
    bool free(RID sky);
    [[nodiscard]] bool owns(RID sky) const noexcept { return skies_.owns(sky); }
    [[nodiscard]] size_t size() const noexcept { return skies_.size(); }
    /// The rasteriser's sky, prepared now if need be; null if `sky` is not one or cannot be prepared.
    RID uploaded(RID sky, FirstError& errors);

private:
    struct Sky {
        std::optional<SkyDesc> desc; ///< until uploaded
        RID upload;
    };
    Rasterizer& rasterizer_;
    RID_Owner<Sky> skies_;
};

} // namespace cl
