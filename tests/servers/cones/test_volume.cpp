#include "servers/cones/volume.h"

#include <doctest/doctest.h>

#include <algorithm>
#include <numeric>
#include <vector>

using namespace cl;

TEST_SUITE("servers/cones/volume") {
    TEST_CASE("levels halve down to one texel an axis, and are dark until they are filled") {
        const cones::Volume volume({8, 2, 4}, 4);
        CHECK(volume.size(0) == glm::ivec3(8, 2, 4));
        CHECK(volume.size(1) == glm::ivec3(4, 1, 2));
        CHECK(volume.size(3) == glm::ivec3(1, 1, 1));
        for (int level = 0; level < 4; ++level) {
            const auto bytes = volume.rgba8(level);
            CHECK(std::all_of(bytes.begin(), bytes.end(), [](uint8_t b) { return b == 0; }));
        }
    }

    TEST_CASE("a box lands where it is said to, and changes nothing else") {
        cones::Volume volume({4, 4, 4}, 3);
        std::vector<uint8_t> box(2 * 3 * 1 * 4);
        std::iota(box.begin(), box.end(), uint8_t(1));
        volume.upload(0, {1, 1, 2}, {2, 3, 1}, box);
        const auto bytes = volume.rgba8(0);
        size_t changed = 0;
        for (int z = 0; z < 4; ++z) {
            for (int y = 0; y < 4; ++y) {
                for (int x = 0; x < 4; ++x) {
                    const uint8_t got = bytes[size_t((z * 4 + y) * 4 + x) * 4];
                    const bool inside = z == 2 && y >= 1 && (x == 1 || x == 2);
                    CHECK(got == (inside ? ((y - 1) * 2 + (x - 1)) * 4 + 1 : 0));
                    changed += inside ? 1 : 0;
                }
            }
        }
        CHECK(changed == 6);
        CHECK(std::all_of(volume.rgba8(1).begin(), volume.rgba8(1).end(), [](uint8_t b) { return b == 0; }));
    }
}
