#include "servers/visual/sky_storage.h"

#include "servers/radiosity/sky_bins.h"
#include "servers/visual/rid_kinds.h"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <utility>

namespace cl {
namespace {

/// Means over the texels that fall into each bin, by their solid angle (spec scene-classes section 14.2: u
/// runs with atan2(x, -z), v from the zenith). Bins that no texel's centre falls into take the nearest
/// texel's.
std::vector<glm::vec3> bins_of(const SkyDesc& sky) {
    std::vector<glm::vec3> sums(radiosity::kSkyBins, glm::vec3(0.0f));
    std::vector<float> weights(radiosity::kSkyBins, 0.0f);
    const auto radiance = [&sky](int x, int y) {
        const float* texel = &sky.radiance[(size_t(y) * size_t(sky.size.x) + size_t(x)) * 3];
        return glm::vec3(texel[0], texel[1], texel[2]);
    };
    for (int y = 0; y < sky.size.y; ++y) {
        const float theta = (float(y) + 0.5f) / float(sky.size.y) * std::numbers::pi_v<float>;
        for (int x = 0; x < sky.size.x; ++x) {
            const float phi = (float(x) + 0.5f) / float(sky.size.x) * 2.0f * std::numbers::pi_v<float>;
            const float r = std::sin(theta);
            const uint32_t bin = radiosity::sky_bin({r * std::sin(phi), std::cos(theta), -r * std::cos(phi)});
            sums[bin] += r * radiance(x, y);
            weights[bin] += r;
        }
    }
    for (uint32_t bin = 0; bin < radiosity::kSkyBins; ++bin) {
        if (weights[bin] > 0.0f) {
            sums[bin] /= weights[bin];
            continue;
        }
        const glm::vec3 d = radiosity::sky_direction(bin);
        const float turn = std::atan2(d.x, -d.z) / (2.0f * std::numbers::pi_v<float>);
        const float height = std::acos(std::clamp(d.y, -1.0f, 1.0f)) / std::numbers::pi_v<float>;
        sums[bin] = radiance(std::min(int((turn - std::floor(turn)) * float(sky.size.x)), sky.size.x - 1),
                             std::min(int(height * float(sky.size.y)), sky.size.y - 1));
    }
    return sums;
}

} // namespace

SkyStorage::SkyStorage(Rasterizer& rasterizer)
    : rasterizer_(rasterizer), skies_(static_cast<uint32_t>(RIDKind::Sky)) {}

RID SkyStorage::make(SkyDesc desc) {
    const bool whole = desc.size.x > 0 && desc.size.y > 0 &&
                       desc.radiance.size() == size_t{3} * size_t(desc.size.x) * size_t(desc.size.y);
    std::vector<glm::vec3> bins = whole ? bins_of(desc) : std::vector<glm::vec3>{};
    return skies_.make({std::move(desc), {}, std::move(bins)});
}

bool SkyStorage::free(RID rid) {
    const Sky* sky = skies_.get(rid);
    if (sky && sky->upload) {
        static_cast<void>(rasterizer_.free(sky->upload)); // a backend that lost it has nothing left to free
    }
    return skies_.free(rid);
}

std::span<const glm::vec3> SkyStorage::bins(RID rid) const noexcept {
    const Sky* sky = skies_.get(rid);
    return sky ? std::span<const glm::vec3>(sky->bins) : std::span<const glm::vec3>{};
}

RID SkyStorage::uploaded(RID rid, FirstError& errors) {
    Sky* sky = skies_.get(rid);
    if (!sky || !sky->desc) {
        return sky ? sky->upload : RID{};
    }
    Expected<RID> created = rasterizer_.sky_create(*sky->desc);
    sky->desc.reset(); // uploaded, or refused once and for all
    if (!created) {
        errors.note(created.error());
        return {};
    }
    return sky->upload = *created;
}

} // namespace cl
