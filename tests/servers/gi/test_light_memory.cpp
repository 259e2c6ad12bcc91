#include "tests/servers/gi/relight_scene.h"

#include "servers/gi/light_memory.h"

#include <doctest/doctest.h>

#include <algorithm>
#include <limits>
#include <random>

using namespace cl;

namespace {

TEST_SUITE("servers/gi/light_memory") {
    TEST_CASE("any history of lights through the memory ends in the sums of those that are left") {
        const gi::CellLayout layout = gi::make_layout(tests::busy_octree());
        std::vector<gi::CachedLight> lights = tests::busy_lights();
        REQUIRE(!lights.empty());
        for (int i = 0; i < 8; ++i) { // in the same place, two of them alike
            lights.push_back(lights[0]);
            lights.back().energy = float(i / 2); // 0: dark
        }
        std::mt19937 random(5);
        for (int round = 0; round < 20; ++round) {
            gi::LightMemory memory;
            std::vector<int32_t> sums = gi::emission_energies(layout);
            std::vector<bool> shines(lights.size(), false);
            for (int edit = 0; edit < 40; ++edit) {
                const size_t i = random() % lights.size();
                memory.inject(layout, lights[i], shines[i] ? -1 : 1, sums);
                shines[i] = !shines[i];
            }
            std::vector<int32_t> expected = gi::emission_energies(layout);
            for (size_t i = 0; i < lights.size(); ++i) {
                if (shines[i]) {
                    gi::inject_light(layout, lights[i], 1, expected);
                }
            }
            CHECK(sums == expected);
        }
    }

    TEST_CASE("which leaves a light reaches depends on its place and shape, not on its colour") {
        const gi::CellLayout layout = gi::make_layout(tests::busy_octree());
        const auto same = [&](const gi::CachedLight& a, const gi::CachedLight& b) {
            const std::vector<gi::LitLeaf> of_a = gi::find_lit_leaves(layout, a);
            const std::vector<gi::LitLeaf> of_b = gi::find_lit_leaves(layout, b);
            return std::equal(of_a.begin(), of_a.end(), of_b.begin(), of_b.end(),
                              [](const gi::LitLeaf& x, const gi::LitLeaf& y) {
                                  return x.leaf == y.leaf && x.share == y.share;
                              });
        };
        for (const gi::CachedLight& light : tests::busy_lights()) {
            REQUIRE(!gi::find_lit_leaves(layout, light).empty());
            gi::CachedLight other = light;
            other.color = {0.1f, 2.0f, 0.0f};
            other.energy = -0.3f;
            other.visible = false;
            CHECK(gi::reach_alike(light, other));
            CHECK(same(light, other));
            other.cells_from_light.origin.x += 1.0f;
            other.cells_from_light.basis = tests::facing({0.6f, -0.2f, 0.5f});
            CHECK_FALSE(gi::reach_alike(light, other));
            CHECK_FALSE(same(light, other));
        }
    }

    TEST_CASE("a light that is hidden, black or not finite is dark") {
        gi::CachedLight light = tests::omni({20.0f, 50.0f, 10.0f}, 80.0f);
        CHECK_FALSE(gi::is_dark(light));
        light.energy = -1.0f; // takes light away
        CHECK_FALSE(gi::is_dark(light));
        light.energy = 0.0005f; // less than one unit
        CHECK(gi::is_dark(light));
        light.energy = std::numeric_limits<float>::infinity();
        CHECK(gi::is_dark(light));
        light = tests::omni({20.0f, 50.0f, 10.0f}, 80.0f);
        light.visible = false;
        CHECK(gi::is_dark(light));
    }
}

} // namespace
