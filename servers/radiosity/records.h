#pragma once

#include "servers/radiosity/links.h"
#include "servers/radiosity/patches.h"

#include <cstdint>
#include <vector>

namespace cl::radiosity {

/// The patches at which irradiance is gathered; all others interpolate. Dense where surfaces are near each
/// other, sparse in the open: irradiance caching on a still scene, where the records' places can be settled
/// beforehand. Source: Ward, Rubinstein and Clear 1988; Ward and Heckbert 1992.
struct Records {
    std::vector<uint32_t> patch;
    std::vector<float> spacing_m; ///< to its neighbours, about
    Links links;                  ///< a point a record
    /// Mean radiance that each gets from surfaces that shine by themselves.
    std::vector<glm::vec3> emitted;
    /// What interpolation blurs of that: added to what patches interpolate. Empty where nothing shines.
    std::vector<glm::vec3> emitted_detail;

    /// Weights of records at patches: patch p has those in [first[p], first[p + 1]); they add up to 1.
    /// Patches that see nothing have none.
    struct Share {
        uint32_t record;
        float weight;
    };
    std::vector<uint32_t> first;
    std::vector<Share> shares;

    [[nodiscard]] std::span<const Share> of_patch(uint32_t p) const noexcept {
        return std::span(shares).subspan(first[p], first[p + 1] - first[p]);
    }
};

[[nodiscard]] Records make_records(const StillScene& scene, const RayScene& rays, const Patches& patches);

} // namespace cl::radiosity
