#include "drivers/gles3/sky_filter.h"

#include <doctest/doctest.h>
#include <glm/common.hpp>
#include <glm/geometric.hpp>

#include <algorithm>
#include <cmath>
#include <vector>

namespace {

using namespace cl;
using namespace cl::gles3;

/// A panorama of f(direction), directions as Panorama has them.
template <typename F>
Panorama panorama_of(int width, const F& f) {
    constexpr float kPi = 3.14159265f;
    const glm::ivec2 size(width, width / 2);
    std::vector<glm::vec3> texels;
    for (int y = 0; y < size.y; ++y) {
        for (int x = 0; x < size.x; ++x) {
            const float phi = 2.0f * kPi * (float(x) + 0.5f) / float(size.x);
            const float theta = kPi * (float(y) + 0.5f) / float(size.y);
            texels.push_back(f(glm::vec3(std::sin(phi) * std::sin(theta), std::cos(theta),
                                         std::cos(phi) * std::sin(theta))));
        }
    }
    return Panorama(size, std::move(texels));
}

float worst_relative(const ParaboloidMap& map, const glm::vec3& expected) {
    float worst = 0.0f;
    for (const glm::vec3& texel : map.texels) {
        const glm::vec3 off = glm::abs(texel / expected - 1.0f);
        worst = std::max(worst, std::max(off.x, std::max(off.y, off.z)));
    }
    return worst;
}

/// Godot's irradiance as the specification sums it, term by term (scene-classes section 14.4).
float specified_irradiance(const glm::vec3& n, float (*sky)(const glm::vec3&)) {
    constexpr float kPi = 3.14159265f;
    const glm::vec3 x = glm::cross(glm::vec3(0, 1, 0), n);
    const glm::vec3 y = glm::cross(n, x);
    double sum = 0.0;
    int count = 0;
    for (float phi = 0.0f; phi < 2.0f * kPi; phi += 0.03f) {
        for (float theta = 0.0f; theta < 0.5f * kPi; theta += 0.03f, ++count) {
            const glm::vec3 h = std::sin(theta) * std::cos(phi) * x + std::sin(theta) * std::sin(phi) * y +
                                std::cos(theta) * n;
            sum += sky(h) * std::cos(theta) * std::sin(theta);
        }
    }
    return float(kPi * sum / count);
}

/// Brighter upwards, as the look-up sees it: by the direction's height as it is.
float gradient(const glm::vec3& d) {
    return 1.0f + std::clamp(d.y, -1.0f, 1.0f);
}

TEST_SUITE("drivers/gles3/sky_filter") {
    TEST_CASE("a uniform sky gives its radiance at every roughness") {
        const glm::vec3 color(0.2f, 1.0f, 3.0f);
        const Panorama sky = panorama_of(64, [&](const glm::vec3&) { return color; });
        for (const ParaboloidMap& layer : filter_radiance(sky, 16)) {
            CHECK(layer.width == 16);
            CHECK(worst_relative(layer, color) < 1e-5f);
        }
    }

    TEST_CASE(
        "a uniform sky gives 0.988 of its radiance as irradiance: Godot's sum stops before the horizon") {
        const glm::vec3 color(0.2f, 1.0f, 3.0f);
        const Panorama sky = panorama_of(64, [&](const glm::vec3&) { return color; });
        CHECK(worst_relative(filter_irradiance(sky), 0.98783f * color) < 1e-4f);
    }

    TEST_CASE("irradiance is the specification's sum, with its frame that is not normalised") {
        const Panorama sky = panorama_of(256, [](const glm::vec3& d) { return glm::vec3(gradient(d)); });
        const ParaboloidMap map = filter_irradiance(sky);
        for (const glm::vec3 direction : {glm::vec3(0, 1, 0), glm::vec3(0, -1, 0), glm::vec3(1, 0, 0),
                                          glm::vec3(0.3f, 0.8f, -0.5f), glm::vec3(-0.6f, -0.4f, 0.7f)}) {
            const glm::vec3 n = glm::normalize(direction);
            CAPTURE(n.y);
            // Bilinear look-up of 32 texels: half a texel's change of the gradient.
            CHECK(map.sample(n).r == doctest::Approx(specified_irradiance(n, gradient)).epsilon(0.01));
        }
    }

    TEST_CASE("a direction is looked up at the texel it comes from") {
        for (const glm::ivec2 texel :
             {glm::ivec2(2, 3), glm::ivec2(7, 4), glm::ivec2(4, 11), glm::ivec2(3, 14)}) {
            ParaboloidMap map{8, std::vector<glm::vec3>(128, glm::vec3(0.0f))};
            map.texels[size_t(texel.y) * 8 + size_t(texel.x)] = glm::vec3(1.0f);
            CAPTURE(texel.x);
            CAPTURE(texel.y);
            CHECK(map.sample(ParaboloidMap::direction_at(texel, 8)).r == doctest::Approx(1.0f).epsilon(1e-4));
        }
    }
}

} // namespace
