#pragma once

#include "servers/rasterizer.h"
#include "servers/visual/first_error.h"

#include "core/rid.h"

#include <glm/vec3.hpp>

#include <optional>
#include <span>
#include <vector>

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
    /// Mean radiance of each of radiosity's sky bins, in the sky's own space; empty if `sky` is not one.
    [[nodiscard]] std::span<const glm::vec3> bins(RID sky) const noexcept;

private:
    struct Sky {
        std::optional<SkyDesc> desc; ///< until uploaded
        RID upload;
        std::vector<glm::vec3> bins;
    };
    Rasterizer& rasterizer_;
    RID_Owner<Sky> skies_;
};

} // namespace cl
