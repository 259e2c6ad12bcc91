#include "tests/servers/gi/hand_made_octree.h"
#include "tests/servers/gi/relight_scene.h"

#include "servers/gi/bricks.h"

#include <doctest/doctest.h>

namespace {

using namespace cl;

TEST_SUITE("servers/gi/bricks") {
    TEST_CASE("the bricks of a mip share its cells among them, each those of a cube of eight") {
        for (const gi::CellLayout& layout :
             {gi::make_layout(tests::busy_octree()),
              gi::make_layout(tests::make_octree({{{1, 2, 3}, tests::kPlusX}}, {64, 32, 64}))}) {
            for (size_t mip = 0; mip < size_t(layout.levels); ++mip) {
                const gi::MipBricks in = gi::bricks_of_mip(layout, mip);
                CHECK(in.texel_level == size_t(layout.levels) - 1 - mip);
                const size_t depth = in.texel_level - in.brick_level;
                CHECK((depth == gi::kBrickLevels || in.brick_level == 0));
                size_t next = layout.level_begin[in.texel_level];
                for (size_t brick = in.bricks.begin; brick < in.bricks.end; ++brick) {
                    const gi::CellRange cells = gi::cells_below(layout, {brick, brick + 1}, depth);
                    CHECK(cells.begin == next);
                    CHECK(cells.size() > 0);
                    next = cells.end;
                    for (size_t cell = cells.begin; cell < cells.end; ++cell) {
                        const glm::ivec3 above = glm::ivec3(layout.voxels[cell]) >> int(depth);
                        REQUIRE(above == glm::ivec3(layout.voxels[brick]));
                    }
                }
                CHECK(next == layout.level_begin[in.texel_level + 1]);
            }
        }
    }
}

} // namespace
