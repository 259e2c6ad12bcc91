#pragma once

#include <glm/vec3.hpp>

#include <cstdint>
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
    /// True: what it lights is worth keeping apart from other light, as it is likely to stay but for its
    /// radiance. Results differ by rounding.
    bool steady = true;
    friend bool operator==(const Source&, const Source&) = default;

    /// The same with radiance 1: what tells where its light goes.
    [[nodiscard]] Source unit() const {
        Source s = *this;
        s.radiance = glm::vec3(1.0f);
        s.steady = true;
        return s;
    }
};

/// All that lights a scene.
struct Lighting {
    std::vector<Source> sources;
    std::vector<glm::vec3> sky; ///< radiance of each sky bin, linear
    std::vector<bool> interior; ///< one a probe: no sky light for what lies in its box
    bool sky_steady = true;     ///< as Source::steady, of the sky
    friend bool operator==(const Lighting&, const Lighting&) = default;
};

} // namespace cl::radiosity
