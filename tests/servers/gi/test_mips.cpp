#include "tests/servers/gi/hand_made_octree.h"
#include "tests/servers/gi/relight_scene.h"
#include "tests/servers/gi/whole_mips.h"

#include "servers/gi/relight.h"

#include <doctest/doctest.h>

#include <algorithm>

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
        gi::energies_from_leaves(layout, Sums{0, 0, 0}, 0.7f, energies);
        const std::vector<tests::MipLevel> levels = tests::whole_mips(layout, energies, 4);
        REQUIRE(levels.size() == 6);
        CHECK(levels[0].size == glm::ivec3(64, 32, 64));
        CHECK(levels[5].size == glm::ivec3(2, 1, 2));
        CHECK(levels[5].rgba8.size() == 16);
    }

    TEST_CASE("a texel is energy over the dynamic range, then over four, clipped; empty texels are zero") {
        const gi::CellLayout layout = gi::make_layout(tests::make_octree({{{3, 2, 1}, kPlusX}}));
        gi::CellEnergies energies;
        std::vector<tests::MipLevel> levels;
        const auto texel = [&](int dynamic_range, int32_t energy) {
            gi::energies_from_leaves(layout, Sums{energy, 0, 0}, 1.0f, energies);
            levels = tests::whole_mips(layout, energies, dynamic_range);
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

    TEST_CASE("every energy is divided exactly, by any dynamic range") {
        const gi::CellLayout layout = gi::make_layout(busy_octree());
        gi::CellEnergies energies;
        const size_t leaves = layout.leaves.size();
        for (const int dynamic_range : {1, 2, 3, 4, 7, 10, 16, 1000, 16383, 16384, 1 << 30}) {
            for (int first = 0; first < 65536; first += int(leaves)) {
                Sums sums;
                for (int i = 0; i < int(leaves); ++i) {
                    sums.insert(sums.end(), {first + i, 0, 0});
                }
                gi::energies_from_leaves(layout, sums, 1.0f, energies);
                const std::vector<tests::MipLevel> levels =
                    tests::whole_mips(layout, energies, dynamic_range);
                for (int i = 0; i < int(leaves) && first + i < 65536; ++i) {
                    const glm::ivec3 v(layout.leaves[size_t(i)].voxel);
                    const int expected = std::min((first + i) / dynamic_range / 4, 255);
                    REQUIRE(int(levels[0].rgba8[size_t((v.z * 64 + v.y) * 64 + v.x) * 4]) == expected);
                }
            }
        }
    }

    TEST_CASE("bricks that changed, put into the former texture, make the one of a fresh set-up") {
        const gi::CellLayout layout = gi::make_layout(busy_octree());
        for (const gi::TexelCoding coding : {gi::TexelCoding::Plain, gi::TexelCoding::Dxt5}) {
            Sums sums = gi::emission_energies(layout);
            gi::CellEnergies energies;
            gi::TexelBoxes boxes;
            std::vector<tests::MipLevel> levels;
            size_t bricks_before = 0;
            for (const gi::CachedLight& light : busy_lights()) {
                for (const int sign : {1, -1, 1}) {
                    gi::inject_light(layout, light, sign, sums);
                    const gi::ChangedBricks changed = gi::energies_from_leaves(layout, sums, 0.7f, energies);
                    gi::encode_bricks(layout, energies, 4, coding, changed, boxes);
                    tests::put(layout, coding, boxes, levels);
                    CHECK((bricks_before == 0 || boxes.boxes.size() < bricks_before));
                    bricks_before = bricks_before == 0 ? boxes.boxes.size() : bricks_before;
                    gi::CellEnergies fresh;
                    gi::energies_from_leaves(layout, sums, 0.7f, fresh);
                    const std::vector<tests::MipLevel> whole = tests::whole_mips(layout, fresh, 4, coding);
                    REQUIRE(levels.size() == whole.size());
                    for (size_t m = 0; m < whole.size(); ++m) {
                        REQUIRE(levels[m].rgba8 == whole[m].rgba8);
                    }
                }
            }
            const gi::ChangedBricks none = gi::energies_from_leaves(layout, sums, 0.7f, energies);
            gi::encode_bricks(layout, energies, 4, coding, none, boxes);
            CHECK(boxes.boxes.empty());
        }
    }
}

} // namespace
