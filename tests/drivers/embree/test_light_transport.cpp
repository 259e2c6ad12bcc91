#include "tests/drivers/embree/traced_world.h"

#include <doctest/doctest.h>

#include <cmath>

using namespace cl;
using namespace cl::tests;
using embree::LightSearch;
using embree::PathOptions;

namespace {

constexpr float kPi = 3.14159265359f;

/// Form factor from a point to a parallel rectangle above it, a corner of which is straight above (Howell's
/// catalogue of configuration factors, B-4). @param a, b  edges over distance
float corner_form_factor(float a, float b) {
    const float ra = std::sqrt(1.0f + a * a), rb = std::sqrt(1.0f + b * b);
    return (a / ra * std::atan(b / ra) + b / rb * std::atan(a / rb)) / (2.0f * kPi);
}

} // namespace

TEST_SUITE("drivers/embree/light_transport") {
    TEST_CASE(
        "in light of one radiance from all around, white Lambert surfaces have that radiance everywhere") {
        PathOptions options;
        options.samples = 16;
        options.depth = 1000; // corners keep light for long
        TracedWorld world(options, {16, 16});
        const glm::vec3 around(0.5f, 0.25f, 1.0f);
        world.set_ambient(around);
        world.add(square(4.0f), lambert(glm::vec3(1.0f)));
        world.add(cube(), lambert(glm::vec3(1.0f)), placed({0.0f, 0.5f, 0.0f}));
        world.look({3, 3, 4}, {0, 0.3f, 0}, 3.0f);
        const glm::vec3 got = world.mean();
        for (int c = 0; c < 3; ++c) {
            CHECK(got[c] == doctest::Approx(around[c]).epsilon(0.01)); // what the roulette leaves of noise
        }
    }

    TEST_CASE("a closed grey room that glows has the radiance of the geometric series: paths go to the end") {
        const float albedo = 0.8f, emission = 0.2f;
        MaterialDesc wall = lambert(glm::vec3(albedo));
        wall.emission_enabled = true;
        wall.emission = encoded(glm::vec3(1.0f));
        wall.emission_energy = emission;
        wall.cull_mode = CullMode::Front; // seen from inside
        PathOptions options;
        options.samples = 64;
        options.depth = 1000;
        TracedWorld world(options, {16, 16});
        world.add(cube(), wall, placed({0, 0, 0}, glm::mat3(4.0f)));
        world.look({0, 0, 1.5f}, {0, 0, 0}, 2.0f);
        CHECK(world.mean().x == doctest::Approx(emission / (1.0f - albedo)).epsilon(0.01));
        options.depth = 2;
        TracedWorld short_paths(options, {16, 16});
        short_paths.add(cube(), wall, placed({0, 0, 0}, glm::mat3(4.0f)));
        short_paths.look({0, 0, 1.5f}, {0, 0, 0}, 2.0f);
        const float two_bounces = emission * (1.0f + albedo + albedo * albedo);
        CHECK(short_paths.mean().x == doctest::Approx(two_bounces).epsilon(0.01));
    }

    TEST_CASE("a floor under a square lamp has the radiance of the form factor, whichever way light is "
              "looked for") {
        const float half = 0.7f, height = 1.3f, emission = 5.0f, albedo = 0.6f;
        const float factor = 4.0f * corner_form_factor(half / height, half / height);
        for (LightSearch search : {LightSearch::Mis, LightSearch::ByEmitters, LightSearch::ByBounces}) {
            CAPTURE(static_cast<int>(search));
            PathOptions options;
            options.samples = 256;
            options.light_search = search;
            TracedWorld world(options);
            world.add(square(5.0f), lambert(glm::vec3(albedo)));
            world.add(square(half), glowing(glm::vec3(emission)), placed({0, height, 0}, upside_down()));
            world.look({0, 0.5f, 0}, {0, 0, 0}, 0.01f); // from under the lamp
            CHECK(world.mean().x == doctest::Approx(albedo * emission * factor).epsilon(0.01));
        }
    }

    TEST_CASE(
        "a floor that touches an upright strip of light has the radiance of the crossed strings, up to the "
        "edge") {
        // Nearest to the edge points on the strip have weights without bound: cut off, or tried too seldom,
        // they cost an area-sampling path tracer a percent of such a scene's light.
        const float width = 0.5f, height = 0.1f, emission = 6.0f, albedo = 0.7f, half_length = 50.0f;
        const float factor = (width + height - std::hypot(width, height)) / (2.0f * width);
        const glm::mat3 upright(glm::vec3(0, 0, half_length), glm::vec3(1, 0, 0),
                                glm::vec3(0, 0.5f * height, 0));
        for (LightSearch search : {LightSearch::Mis, LightSearch::ByBounces}) {
            CAPTURE(static_cast<int>(search));
            PathOptions options;
            options.samples = 512;
            options.light_search = search;
            TracedWorld world(options, {32, 32});
            world.add(square(half_length), lambert(glm::vec3(albedo)));
            world.add(square(1.0f), glowing(glm::vec3(emission)), placed({0, 0.5f * height, 0}, upright));
            world.look({0.5f * width, 1, 0}, {0.5f * width, 0, 0}, width);
            CHECK(world.mean().x == doctest::Approx(albedo * emission * factor).epsilon(0.003));
        }
    }

    TEST_CASE(
        "the ways to look for light agree in a scene with gloss, glow of two sizes and half-seen surfaces") {
        glm::vec3 means[3];
        for (LightSearch search : {LightSearch::Mis, LightSearch::ByEmitters, LightSearch::ByBounces}) {
            PathOptions options;
            options.samples = 512;
            options.light_search = search;
            TracedWorld world(options, {16, 16});
            MaterialDesc gloss;
            gloss.albedo = encoded({0.7f, 0.5f, 0.3f});
            gloss.roughness = 0.5f;
            gloss.metallic = 0.3f;
            MaterialDesc veil = glowing({0.5f, 1.0f, 2.0f});
            veil.transparent = true;
            veil.albedo.a = 0.4f;
            veil.cull_mode = CullMode::Disabled;
            world.add(square(3.0f), gloss);
            world.add(cube(), lambert(glm::vec3(0.5f)), placed({0.8f, 0.5f, 0}));
            world.add(square(0.6f), glowing(glm::vec3(4.0f)), placed({-0.5f, 1.5f, 0}, upside_down()));
            world.add(square(1.0f), veil, placed({0.5f, 1.0f, 1.0f}, looking({0.3f, 1, 0.2f})));
            world.look({0, 3, 4}, {0, 0.3f, 0}, 3.0f);
            means[static_cast<int>(search)] = world.mean();
        }
        for (int c = 0; c < 3; ++c) {
            CHECK(means[1][c] == doctest::Approx(means[0][c]).epsilon(0.02));
            CHECK(means[2][c] == doctest::Approx(means[0][c]).epsilon(0.02));
        }
    }

    TEST_CASE("a small sun in the sky lights a floor by its solid angle, whichever way it is looked for") {
        // A sky that is black but for a square of texels around the zenith's side.
        SkyDesc sky;
        sky.size = {64, 32};
        sky.radiance.resize(size_t{64} * 32 * 3, 0.0f);
        double expected = 0.0;
        const float sun = 20.0f;
        for (int y = 6; y < 10; ++y) {
            for (int x = 0; x < 64; ++x) {
                for (size_t c = 0; c < 3; ++c) {
                    sky.radiance[(static_cast<size_t>(y) * 64 + static_cast<size_t>(x)) * 3 + c] = sun;
                }
            }
        }
        // Bilinear look-up makes ramps of the band's edges: integrate what is looked up.
        for (int i = 0; i < 3200; ++i) {
            const double v = (i + 0.5) / 3200.0 * 32.0, tilt = v / 32.0 * 3.14159265358979;
            const double ramp = std::min(v - 5.5, 10.5 - v),
                         height = sun * std::min(1.0, std::max(0.0, ramp));
            if (tilt < 1.5707963) {
                expected += height * std::cos(tilt) * std::sin(tilt) * 2.0 * (3.14159265358979 / 3200.0);
            }
        }
        for (LightSearch search : {LightSearch::Mis, LightSearch::ByEmitters, LightSearch::ByBounces}) {
            CAPTURE(static_cast<int>(search));
            PathOptions options;
            options.samples = 512;
            options.light_search = search;
            TracedWorld world(options);
            EnvironmentDesc e;
            e.background_mode = BackgroundMode::Sky;
            e.sky = world.server.sky_create(sky);
            e.sky_orientation = looking({0.6f, 0.0f, 0.8f}); // about the vertical: changes nothing
            REQUIRE(world.server.environment_set(world.environment, e));
            world.add(square(3.0f), lambert(glm::vec3(0.5f)));
            world.look({0, 1, 0}, {0, 0, 0}, 0.1f);
            CHECK(world.mean().x == doctest::Approx(0.5 * expected).epsilon(0.01));
        }
    }
}
