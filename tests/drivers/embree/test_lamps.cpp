#include "tests/drivers/embree/traced_world.h"

#include <doctest/doctest.h>

#include <cmath>

using namespace cl;
using namespace cl::tests;
using embree::PathOptions;

namespace {

PathOptions one_bounce() {
    PathOptions options;
    options.samples = 4;
    return options;
}

/// Radiance of a floor of albedo 0.5 at the origin, seen from above at a slant, under one lamp.
glm::vec3 lit_floor(const LightDesc& lamp, const Transform& place) {
    TracedWorld world(one_bounce());
    world.add(square(10.0f), lambert(glm::vec3(0.5f)));
    world.add(lamp, place);
    world.look({1, 1, 1}, {0, 0, 0}, 0.001f);
    return world.mean();
}

} // namespace

TEST_SUITE("drivers/embree/lamps") {
    TEST_CASE("a floor under an omni light has albedo times colour, energy, falloff and cosine") {
        LightDesc lamp;
        lamp.color = encoded({1.0f, 0.5f, 0.25f});
        lamp.energy = 3.0f;
        lamp.range_m = 6.0f;
        lamp.attenuation = 1.7f;
        lamp.shadow = true;
        const glm::vec3 at(1.0f, 2.0f, -0.5f);
        const float distance = glm::length(at);
        const float expected = 0.5f * 3.0f * std::pow(1.0f - distance / 6.0f, 1.7f) * at.y / distance;
        const glm::vec3 got = lit_floor(lamp, placed(at));
        CHECK(got.x == doctest::Approx(expected).epsilon(0.001));
        CHECK(got.y == doctest::Approx(0.5f * expected).epsilon(0.001));
        CHECK(got.z == doctest::Approx(0.25f * expected).epsilon(0.001));
        lamp.range_m = 2.0f;
        CHECK(lit_floor(lamp, placed(at)) == glm::vec3(0.0f));
    }

    TEST_CASE("a spot light fades to its rim, a directional one by nothing but the cosine") {
        LightDesc spot;
        spot.type = LightType::Spot;
        spot.range_m = 8.0f;
        spot.spot_angle_deg = 40.0f;
        spot.spot_angle_attenuation = 0.8f;
        const glm::vec3 at(0.0f, 3.0f, 0.0f);
        const float tilt = glm::radians(25.0f); // the axis points past the origin
        const glm::mat3 aim = looking({std::sin(tilt), -std::cos(tilt), 0.0f});
        const float rim = (1.0f - std::cos(tilt)) / (1.0f - std::cos(glm::radians(40.0f)));
        const float expected = 0.5f * (1.0f - 3.0f / 8.0f) * (1.0f - std::pow(rim, 0.8f));
        CHECK(lit_floor(spot, placed(at, aim)).x == doctest::Approx(expected).epsilon(0.001));
        CHECK(lit_floor(spot, placed(at, looking({1, -1, 0}))).x <
              1e-3f); // outside: Godot's rim is 0.0001 wide
        LightDesc sun;
        sun.type = LightType::Directional;
        sun.energy = 2.0f;
        const glm::vec3 way = glm::normalize(glm::vec3(1, -2, 0.5f));
        CHECK(lit_floor(sun, placed({7, 7, 7}, looking(way))).x == doctest::Approx(-way.y).epsilon(0.001));
    }

    TEST_CASE("shadows fall only where the lamp, the surface and what stands between allow them") {
        LightDesc lamp;
        lamp.shadow = true;
        lamp.range_m = 10.0f;
        struct Case {
            const char* name;
            bool shadow;
            ShadowCasting casting;
            bool receives;
            float expected; ///< share of the light that arrives
        };
        const float open = 0.5f * (1.0f - 2.0f / 10.0f);
        for (const Case& c : {Case{"all on", true, ShadowCasting::On, true, 0.0f},
                              Case{"lamp off", false, ShadowCasting::On, true, 1.0f},
                              Case{"caster off", true, ShadowCasting::Off, true, 1.0f},
                              Case{"caster hidden", true, ShadowCasting::ShadowsOnly, true, 0.0f},
                              Case{"receiver off", true, ShadowCasting::On, false, 1.0f}}) {
            CAPTURE(c.name);
            TracedWorld world(one_bounce());
            MaterialDesc floor = lambert(glm::vec3(0.5f));
            floor.do_not_receive_shadows = !c.receives;
            world.add(square(10.0f), floor);
            const RID caster =
                world.add(cube(), lambert(glm::vec3(0.0f)), placed({0, 1, 0}, glm::mat3(0.3f)));
            REQUIRE(world.server.instance_set_casting(caster, c.casting));
            lamp.shadow = c.shadow;
            world.add(lamp, placed({0, 2, 0}));
            world.look({3, 1, 0}, {0, 0, 0}, 0.001f);
            CHECK(world.mean().x == doctest::Approx(c.expected * open).epsilon(0.001));
        }
    }

    TEST_CASE("a culled side lets light pass, as in the scene pass; a double-sided shadow does not") {
        for (ShadowCasting casting : {ShadowCasting::On, ShadowCasting::DoubleSided}) {
            TracedWorld world(one_bounce());
            world.add(square(10.0f), lambert(glm::vec3(0.5f)));
            // Faces the floor: its back is to the sun.
            const RID roof =
                world.add(square(2.0f), lambert(glm::vec3(0.0f)), placed({0, 1, 0}, upside_down()));
            REQUIRE(world.server.instance_set_casting(roof, casting));
            LightDesc sun;
            sun.type = LightType::Directional;
            sun.shadow = true;
            world.add(sun, placed({0, 0, 0}, looking({0, -1, 0})));
            world.look({0, 3, 0}, {0, 0, 0}, 0.001f); // through the roof's back
            const float expected = casting == ShadowCasting::On ? 0.5f : 0.0f;
            CHECK(world.mean().x == doctest::Approx(expected));
        }
    }

    TEST_CASE("a negative light takes away what the same light gives, and a cull mask leaves surfaces out") {
        LightDesc lamp;
        TracedWorld world(one_bounce());
        const RID floor = world.add(square(10.0f), lambert(glm::vec3(0.5f)));
        world.add(lamp, placed({0, 1, 0}));
        lamp.negative = true;
        const RID dark = world.add(lamp, placed({0, 1, 0}));
        world.look({1, 1, 1}, {0, 0, 0}, 0.001f);
        CHECK(std::abs(world.mean().x) < 1e-6f);
        REQUIRE(world.server.instance_set_visible(dark, false));
        CHECK(world.mean().x > 0.1f);
        REQUIRE(world.server.instance_set_layers(floor, 2));
        lamp.negative = false;
        lamp.cull_mask = 1;
        TracedWorld masked(one_bounce());
        const RID other = masked.add(square(10.0f), lambert(glm::vec3(0.5f)));
        REQUIRE(masked.server.instance_set_layers(other, 2));
        masked.add(lamp, placed({0, 1, 0}));
        masked.look({1, 1, 1}, {0, 0, 0}, 0.001f);
        CHECK(masked.mean() == glm::vec3(0.0f));
    }

    TEST_CASE("a lamp that the scene keeps out of global illumination lights only what the camera sees") {
        float seen[2], bounced[2];
        for (int i = 0; i < 2; ++i) {
            PathOptions options;
            options.samples = 256;
            TracedWorld world(options);
            LightDesc lamp;
            lamp.bake_mode = i == 0 ? LightBakeMode::Disabled : LightBakeMode::Indirect;
            world.add(square(2.0f), lambert(glm::vec3(0.8f)));
            world.add(square(2.0f), lambert(glm::vec3(0.8f)), placed({0, 2, 0}, upside_down()));
            lamp.type = LightType::Spot; // shines on the floor alone
            world.add(lamp, placed({0, 1, 0}, looking({0, -1, 0})));
            world.look({0, 1.5f, 0.01f}, {0, 0, 0}, 0.5f);
            seen[i] = world.mean().x;
            world.look({0, 0.5f, 0.01f}, {0, 2, 0}, 0.5f);
            bounced[i] = world.mean().x;
        }
        CHECK(seen[0] > 0.2f);
        CHECK(seen[1] > seen[0]);
        CHECK(bounced[0] == 0.0f);
        CHECK(bounced[1] > 0.01f);
    }
}
