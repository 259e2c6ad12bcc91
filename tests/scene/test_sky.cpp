#include "tests/scene/scene_fixture.h"

#include "scene/resources/sky.h"

#include <doctest/doctest.h>

#include <algorithm>
#include <cmath>

using namespace cl;
using namespace cl::scene;
using cl::tests::register_types;

namespace {

glm::vec3 texel(const SkyDesc& sky, int x, int y) {
    const float* p = sky.radiance.data() +
                     (static_cast<size_t>(y) * static_cast<size_t>(sky.size.x) + static_cast<size_t>(x)) * 3;
    return {p[0], p[1], p[2]};
}

glm::ivec2 brightest(const SkyDesc& sky) {
    size_t best = 0;
    for (size_t i = 0; i < sky.radiance.size(); i += 3) {
        best = sky.radiance[i] > sky.radiance[best] ? i : best;
    }
    const int index = static_cast<int>(best / 3);
    return {index % sky.size.x, index / sky.size.x};
}

/// A small disk of pure red light, so that its place can be read off the image.
ProceduralSkyParams with_sun(float latitude_deg, float longitude_deg) {
    ProceduralSkyParams p;
    p.sky_energy = p.ground_energy = 0.0f;
    p.sun_color = {1, 0, 0, 1};
    p.sun_angle_min_deg = 3.0f;
    p.sun_angle_max_deg = 4.0f;
    p.sun_latitude_deg = latitude_deg;
    p.sun_longitude_deg = longitude_deg;
    p.texture_size = 0;
    return p;
}

} // namespace

TEST_SUITE("scene/resources/sky") {
    TEST_CASE("a procedural sky runs from the top colour over the horizon to the bottom colour, linearised") {
        ProceduralSkyParams p;
        p.sun_energy = 0.0f;
        p.sun_angle_max_deg = 0.0f;
        p.sun_angle_min_deg = 0.0f;
        const SkyDesc sky = make_procedural_panorama(p);
        CHECK(sky.size == glm::ivec2(1024, 512));
        const auto near = [](const glm::vec3& a, const glm::vec3& b) {
            return std::abs(a.r - b.r) < 0.01f && std::abs(a.g - b.g) < 0.01f && std::abs(a.b - b.b) < 0.01f;
        };
        CHECK(near(texel(sky, 300, 0), linear_from_srgb(p.sky_top_color.rgb())));
        CHECK(near(texel(sky, 300, 511), linear_from_srgb(p.ground_bottom_color.rgb())));
        // The curves are steep at the horizon: one row off it is still near the horizon's colour in blue.
        CHECK(texel(sky, 300, 255).b ==
              doctest::Approx(linear_from_srgb(p.sky_horizon_color.b)).epsilon(0.05));
        CHECK(texel(sky, 300, 256).b ==
              doctest::Approx(linear_from_srgb(p.ground_horizon_color.b)).epsilon(0.2));
    }

    TEST_CASE("the sun stands towards -z, and positive longitude moves it towards +x as displayed") {
        // Displayed column u = atan2(d.x, -d.z) / 2 pi: -z at 0, +x at 0.25.
        const SkyDesc ahead = make_procedural_panorama(with_sun(30.0f, 0.0f));
        const glm::ivec2 at = brightest(ahead);
        CHECK((at.x < 4 || at.x > ahead.size.x - 4));
        CHECK(at.y == doctest::Approx(ahead.size.y * 60 / 180).epsilon(0.1));

        const SkyDesc right = make_procedural_panorama(with_sun(30.0f, 90.0f));
        CHECK(brightest(right).x == doctest::Approx(right.size.x / 4).epsilon(0.1));
    }

    TEST_CASE("the sun is not linearised and does not shine below the horizon") {
        ProceduralSkyParams p = with_sun(30.0f, 0.0f);
        p.sun_color = {0.5f, 0, 0, 1};
        const SkyDesc sky = make_procedural_panorama(p);
        const glm::ivec2 at = brightest(sky);
        CHECK(texel(sky, at.x, at.y).r == doctest::Approx(0.5f).epsilon(0.01));
        const SkyDesc sunken = make_procedural_panorama(with_sun(-30.0f, 0.0f));
        CHECK(*std::max_element(sunken.radiance.begin(), sunken.radiance.end()) == 0.0f);
    }

    TEST_CASE("values are those that a shared-exponent texel can hold") {
        const SkyDesc sky = make_procedural_panorama(ProceduralSkyParams{.texture_size = 0});
        for (size_t i = 0; i < sky.radiance.size(); i += 3) {
            const float largest = std::max({sky.radiance[i], sky.radiance[i + 1], sky.radiance[i + 2]});
            const float step = std::ldexp(1.0f, std::ilogb(largest) + 1 - 9);
            for (size_t c = 0; c < 3; ++c) {
                const float steps = sky.radiance[i + c] / step;
                REQUIRE(steps == std::floor(steps));
            }
        }
    }

    TEST_CASE("an 8-bit panorama is decoded from sRGB, a float one is taken as it is") {
        register_types();
        const auto panorama_of = [](Image image) {
            auto texture = make_ref<ImageTexture>();
            texture->set_image(std::make_shared<const Image>(std::move(image)));
            PanoramaSky sky;
            sky.set_panorama(texture);
            return sky.describe();
        };
        const SkyDesc bytes =
            panorama_of({.size = {1, 1}, .format = PixelFormat::RGB8, .data = {255, 128, 0}});
        CHECK(bytes.radiance[0] == doctest::Approx(1.0f));
        CHECK(bytes.radiance[1] == doctest::Approx(0.2158f).epsilon(1e-3));
        Image floats{.size = {1, 1}, .format = PixelFormat::RGBF, .data = std::vector<uint8_t>(12)};
        const float values[3] = {4.0f, 0.5f, 0.0f};
        std::copy_n(reinterpret_cast<const uint8_t*>(values), 12, floats.data.begin());
        CHECK(panorama_of(floats).radiance == std::vector<float>{4.0f, 0.5f, 0.0f});
        CHECK(PanoramaSky().describe().size == glm::ivec2(0));
    }
}
