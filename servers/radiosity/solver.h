#pragma once

#include "servers/radiosity/sky_bins.h"
#include "servers/radiosity/transport.h"

#include <glm/vec3.hpp>
#include <glm/vec4.hpp>

#include <array>
#include <atomic>
#include <cstdint>
#include <span>
#include <vector>

namespace cl::radiosity {

enum class SourceType : uint8_t { Directional, Omni, Spot };

/// A light as it bounces (spec scene-classes sections 6 to 9). A white Lambert surface facing it sends out
/// `radiance`.
struct Source {
    SourceType type = SourceType::Omni;
    glm::vec3 radiance{1.0f}; ///< linear colour * energy * indirect energy; negative for negative lights
    glm::vec3 position{0.0f}; ///< [m]
    glm::vec3 to_light{0.0f, 0.0f, 1.0f}; ///< unit, of directional and spot lights: against their rays
    float range_m = 5.0f;
    float attenuation = 1.0f;
    float cos_spot_angle = 0.0f;
    float spot_attenuation = 1.0f;
    bool shadow = true; ///< false: shines through everything
    friend bool operator==(const Source&, const Source&) = default;
};

/// All that lights a scene.
struct Lighting {
    std::vector<Source> sources;
    std::vector<glm::vec3> sky; ///< radiance of each sky bin, linear
    std::vector<bool> interior; ///< one a probe: no sky light for what lies in its box
    friend bool operator==(const Lighting&, const Lighting&) = default;
};

/// Light that arrives, as radiance averaged over the cosine-weighted hemisphere (irradiance / pi), linear:
/// times albedo it is what a surface sends out.
struct Solution {
    std::vector<glm::vec3> arriving; ///< one a patch, without light straight from sources
    std::vector<glm::vec3> leaving;  ///< one a patch: emission and all light it sends on
    int bounces = 0;
};

/// Light straight from a source at each patch, shadows by rays.
[[nodiscard]] std::vector<glm::vec3> direct_light(const Transport& transport, const Source& source);

/// Light of each source at each patch, kept so that a change of one light costs the rays of one. For one
/// transport.
class DirectCache {
public:
    /// Light straight from all sources at each patch; what is new is traced, what is not in `sources` is
    /// forgotten. Sums run in the order of the sources: the same numbers whatever was kept.
    [[nodiscard]] std::vector<glm::vec3> gather(const Transport& transport, std::span<const Source> sources);

private:
    struct Known {
        Source source;
        std::vector<glm::vec3> at_patches;
    };
    static constexpr size_t kMostKnown =
        32; ///< more are traced each time: memory is 12 bytes a patch and source
    std::vector<Known> known_;
};

/// Lights the patches and lets the light bounce until less than a thousandth is missing.
/// The same numbers for any number of threads. @param stop  gives up early with an unusable result
/// @param cache  of this transport; null: none
[[nodiscard]] Solution solve(const Transport& transport, const Lighting& lighting,
                             const std::atomic<bool>& stop, DirectCache* cache = nullptr);

} // namespace cl::radiosity
