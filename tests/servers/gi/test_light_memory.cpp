#include "tests/servers/gi/relight_scene.h"

#include "servers/gi/light_memory.h"

#include <doctest/doctest.h>

#include <random>

using namespace cl;

namespace {

TEST_SUITE("servers/gi/light_memory") {
    TEST_CASE("any history of lights through the memory ends in the sums of those that are left") {
        const gi::CellLayout layout = gi::make_layout(tests::busy_octree());
        std::vector<gi::CachedLight> lights = tests::busy_lights();
        REQUIRE(!lights.empty());
        for (int i = 0; i < 8; ++i) { // more than are remembered, two of them alike
            lights.push_back(lights[0]);
            lights.back().energy = float(1 + i / 2);
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
}

} // namespace
