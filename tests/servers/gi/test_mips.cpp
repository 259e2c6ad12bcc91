#include "tests/servers/gi/hand_made_octree.h"
#include "tests/servers/gi/relight_scene.h"

#include "servers/gi/relight.h"

#include <doctest/doctest.h>

namespace {

using namespace cl;
using tests::busy_lights;
using tests::busy_octree;
using tests::kPlusX;

using Sums = std::vector<int32_t>;

TEST_SUITE("servers/gi/mips") {
    TEST_CASE("levels halve until one side is 1") {
        CHECK(gi::mip_count({64, 32, 64}) == 6);
        CHECK(gi::mip_count({128, 128, 128}) == 8);
        CHECK(gi::mip_count({64, 1, 64}) == 1);
        const gi::CellLayout layout =
            gi::make_layout(tests::make_octree({{{1, 2, 3}, kPlusX}}, {64, 32, 64}));
        gi::CellEnergies energies;
        std::vector<gi::MipLevel> levels;
        gi::energies_from_leaves(layout, Sums{0, 0, 0}, 0.7f, energies);
        gi::encode_mips(layout, energies, 4, levels);
        REQUIRE(levels.size() == 6);
        CHECK(levels[0].size == glm::ivec3(64, 32, 64));
        CHECK(levels[5].size == glm::ivec3(2, 1, 2));
        CHECK(levels[5].rgba8.size() == 16);
    }

    TEST_CASE("a texel is energy over the dynamic range, then over four, clipped; empty texels are zero") {
        const gi::CellLayout layout = gi::make_layout(tests::make_octree({{{3, 2, 1}, kPlusX}}));
        gi::CellEnergies energies;
        std::vector<gi::MipLevel> levels;
        const auto texel = [&](int dynamic_range, int32_t energy) {
            gi::energies_from_leaves(layout, Sums{energy, 0, 0}, 1.0f, energies);
            gi::encode_mips(layout, energies, dynamic_range, levels);
            return int(levels[0].rgba8[((1 * 64 + 2) * 64 + 3) * 4]);
        };
        CHECK(texel(1, 1024) == 255); // 256, clipped
        CHECK(texel(1, 1023) == 255);
        CHECK(texel(1, 1019) == 254);
        CHECK(texel(4, 1024) == 64);
        CHECK(texel(4, 1039) == 64); // 1039 / 4 = 259, 259 >> 2 = 64
        CHECK(texel(3, 1024) == 85);
        CHECK(texel(16, 65535) == 255);
        CHECK(texel(0, 512) == 128); // counts as 1
        size_t occupied = 0;
        for (size_t i = 0; i < levels[0].rgba8.size(); i += 4) {
            occupied += levels[0].rgba8[i + 3] != 0;
        }
        CHECK(occupied == 1);
        CHECK(levels[0].rgba8[((1 * 64 + 2) * 64 + 3) * 4 + 3] == 255);
        // The same leaf in every mip, thinned to an eighth each time: 65535 / 8 = 8191 -> 31, then 3.
        CHECK(levels[1].rgba8[((0 * 32 + 1) * 32 + 1) * 4 + 3] == 31);
        CHECK(levels[2].rgba8[3] == 3);
    }

    TEST_CASE("encoding into the levels of a former relight leaves no trace of it") {
        const gi::CellLayout layout = gi::make_layout(busy_octree());
        gi::CellEnergies energies;
        std::vector<gi::MipLevel> reused;
        Sums sums = gi::emission_energies(layout);
        for (const gi::CachedLight& light : busy_lights()) {
            gi::inject_light(layout, light, 1, sums);
        }
        gi::energies_from_leaves(layout, sums, 0.7f, energies);
        gi::encode_mips(layout, energies, 1, reused);
        const std::vector<uint8_t> bright = reused[0].rgba8;
        sums = gi::emission_energies(layout);
        gi::energies_from_leaves(layout, sums, 0.3f, energies);
        std::vector<gi::MipLevel> fresh;
        gi::encode_mips(layout, energies, 4, fresh);
        gi::encode_mips(layout, energies, 4, reused);
        CHECK(bright != fresh[0].rgba8);
        for (size_t m = 0; m < fresh.size(); ++m) {
            CHECK(fresh[m].rgba8 == reused[m].rgba8);
        }
    }
}

} // namespace
