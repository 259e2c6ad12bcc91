#include "tests/servers/gi/volume_of.h"

#include "servers/gi/cone_trace.h"

#include <doctest/doctest.h>
#include <glm/geometric.hpp>

#include <random>

namespace {

using namespace cl;
using tests::FilledVolume;

gi::Cone cone_to(const glm::vec3& direction, float tan_half, float max_distance) {
    return {.origin = glm::vec3(8.0f),
            .direction = glm::normalize(direction),
            .tan_half_aperture = tan_half,
            .first_distance = 1.5f,
            .max_distance = max_distance};
}

TEST_SUITE("servers/gi/cone_trace") {
    TEST_CASE("steps are half the cone's diameter, and colour is not multiplied by its own opacity") {
        // 51 / 255 = 0.2 and 102 / 255 = 0.4 everywhere: each sample brings them, thinned by what is before
        // it.
        const FilledVolume fog(16, [](int, int) { return glm::u8vec4(102, 0, 0, 51); });
        const gi::VolumeSampler volume = fog.sampler();
        // At 1.5 the diameter is 2 * 0.577 * 1.5 = 1.731: the second sample is at 2.3655, the third
        // at 3.7303.
        const auto trace = [&](float max) { return gi::trace_cone(volume, cone_to({1, 2, 3}, 0.577f, max)); };
        CHECK(trace(1.4f) == glm::vec4(0.0f));
        CHECK(trace(2.3f).r == doctest::Approx(0.4));
        CHECK(trace(2.3f).a == doctest::Approx(0.2));
        CHECK(trace(2.4f).r == doctest::Approx(0.4 + 0.8 * 0.4));
        CHECK(trace(2.4f).a == doctest::Approx(0.2 + 0.8 * 0.2));
        CHECK(trace(3.72f).a == doctest::Approx(0.36));
        CHECK(trace(3.74f).a == doctest::Approx(0.36 + 0.64 * 0.2));
        // Below one voxel a cone is no thinner than that: steps of 0.5.
        const auto thin = gi::trace_cone(volume, cone_to({1, 0, 0}, 0.0f, 2.6f)); // at 1.5, 2 and 2.5
        CHECK(thin.a == doctest::Approx(1.0 - 0.8 * 0.8 * 0.8));
    }

    TEST_CASE("the march ends when 0.95 of the light's way is covered") {
        const FilledVolume half(16, [](int, int) { return glm::u8vec4(0, 0, 0, 128); });
        const glm::vec4 got = gi::trace_cone(half.sampler(), cone_to({0, 1, 0}, 0.577f, 1000.0f));
        // 1 - (127 / 255)^5 is the first beyond 0.95.
        CHECK(got.a == doctest::Approx(1.0 - std::pow(127.0 / 255.0, 5.0)));
    }

    TEST_CASE("where radiance is L times opacity every cone gathers L times the opacity it met") {
        std::mt19937 random(4);
        const FilledVolume room(16, [&random](int, int) {
            const auto a = uint8_t(random() % 200);
            return glm::u8vec4(a, a / 2 * 2, 0, a);
        });
        const gi::VolumeSampler volume = room.sampler();
        std::normal_distribution<float> n;
        for (int i = 0; i < 100; ++i) {
            const gi::Cone cone = cone_to({n(random), n(random), n(random)}, 0.2f * float(i % 6), 30.0f);
            const glm::vec4 got = gi::trace_cone(volume, cone);
            CHECK(got.a > 0.1f);
            CHECK(got.r == doctest::Approx(got.a).epsilon(1e-4));
            CHECK(got.b == 0.0f);
        }
    }

    TEST_CASE("a wide cone reads the level whose texels are as wide as it is") {
        const FilledVolume levels(16, [](int level, int) { return glm::u8vec4(50 * level, 0, 0, 0); });
        // One sample at distance 4 with a diameter of 4 voxels: level 2, of 100 / 255.
        gi::Cone cone = cone_to({1, 0, 0}, 0.5f, 4.5f);
        cone.first_distance = 4.0f;
        CHECK(gi::trace_cone(levels.sampler(), cone).r == doctest::Approx(100.0 / 255.0));
        // A diameter of 64 voxels: the last level there is, 4.
        cone.tan_half_aperture = 8.0f;
        CHECK(gi::trace_cone(levels.sampler(), cone).r == doctest::Approx(200.0 / 255.0));
    }

    TEST_CASE("beyond the volume its edge goes on") {
        const FilledVolume edge(
            16, [](int, int i) { return i % 16 == 15 ? glm::u8vec4(200, 0, 0, 0) : glm::u8vec4(0); });
        gi::Cone cone = cone_to({1, 0, 0}, 0.0f, 100.4f);
        cone.first_distance = 100.0f;
        CHECK(gi::trace_cone(edge.sampler(), cone).r == doctest::Approx(200.0 / 255.0));
    }
}

} // namespace
