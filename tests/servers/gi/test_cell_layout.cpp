#include "tests/servers/gi/hand_made_octree.h"

#include "servers/gi/relight.h"

#include <doctest/doctest.h>

namespace {

using namespace cl;
using tests::kPlusX;
using tests::kPlusY;
using tests::kPlusZ;

using Sums = std::vector<int32_t>;

TEST_SUITE("servers/gi/cell_layout") {
    TEST_CASE("emission is where the sums start: 1024 times what the word decodes to") {
        // Direction (1, 0x80 / 255, 0), length 8 * 0x40 / 255.
        const gi::CellLayout layout =
            gi::make_layout(tests::make_octree({{{1, 2, 3}, kPlusZ, 0xFFFFFF, 0xFF800040}}));
        const float length = float(0x40) / 255.0f * 8.0f;
        CHECK(gi::emission_energies(layout) ==
              Sums{int32_t(length * 1024.0f), int32_t(float(0x80) / 255.0f * length * 1024.0f), 0});
    }

    TEST_CASE("leaves come in slot order with their own words and places") {
        const gi::CellLayout layout = gi::make_layout(
            tests::make_octree({{{63, 63, 63}, kPlusX}, {{0, 1, 0}, kPlusY, 0x123456}, {{1, 0, 0}, kPlusZ}}));
        REQUIRE(layout.leaves.size() == 3);
        CHECK(layout.leaves[0].voxel == glm::u16vec3(1, 0, 0));
        CHECK(layout.leaves[1].voxel == glm::u16vec3(0, 1, 0));
        CHECK(layout.leaves[2].voxel == glm::u16vec3(63, 63, 63));
        CHECK(layout.leaves[1].albedo == glm::u8vec3(0x12, 0x34, 0x56));
        CHECK(layout.leaves[1].normal.y == 1.0f);
        CHECK(layout.leaves[1].normal.x == doctest::Approx(-1.0 / 255.0));
        for (int level = 0; level < 7; ++level) {
            for (uint32_t cell = layout.level_begin[size_t(level)];
                 cell < layout.level_begin[size_t(level) + 1]; ++cell) {
                CHECK(int(layout.voxels[cell].x) < (1 << level));
                for (uint32_t child = layout.first_child[level < 6 ? cell : 0];
                     level < 6 && child < layout.first_child[cell + 1]; ++child) {
                    CHECK(layout.voxels[child] / uint16_t(2) == layout.voxels[cell]);
                }
            }
        }
        CHECK(layout.leaf_bitmap.look(63, 63, 63).leaf);
        CHECK_FALSE(layout.leaf_bitmap.look(0, 0, 0).leaf);
    }
}

} // namespace
