#include "tests/servers/gi/hand_made_octree.h"
#include "tests/servers/gi/relight_scene.h"

#include "servers/gi/bricks.h"
#include "servers/gi/relight.h"

#include "core/threads.h"

#include <doctest/doctest.h>

#include <algorithm>
#include <limits>

namespace {

using namespace cl;
using tests::busy_lights;
using tests::busy_octree;
using tests::kPlusX;

using Sums = std::vector<int32_t>;

TEST_SUITE("servers/gi/downsample") {
    /// Two leaves, alone in a parent that is alone in its own, and so on to the root.
    struct Pair {
        gi::CellLayout layout =
            gi::make_layout(tests::make_octree({{{0, 0, 0}, kPlusX}, {{1, 0, 0}, kPlusX}}));
        gi::CellEnergies energies;

        int red_of_level(int level) const {
            return energies.rgb[size_t(layout.level_begin[size_t(level)]) * 3];
        }
    };

    TEST_CASE("propagation 0 is the mean over eight, black where there is no child") {
        Pair p;
        gi::energies_from_leaves(p.layout, Sums{1000, 0, 0, 3001, 0, 0}, 0.0f, p.energies);
        CHECK(p.red_of_level(6) == 1000);
        CHECK(p.red_of_level(5) == 500); // 4001 / 8 = 500.125
        CHECK(p.red_of_level(4) == 63);  // 62.5 rounds away from zero
        CHECK(p.red_of_level(3) == 8);
    }

    TEST_CASE("propagation 1 is the mean over the children that exist: light does not dim upward") {
        Pair p;
        gi::energies_from_leaves(p.layout, Sums{1000, 0, 0, 3001, 0, 0}, 1.0f, p.energies);
        CHECK(p.red_of_level(5) == 2001); // 2000.5 rounds away from zero
        CHECK(p.red_of_level(4) == 2001);
        CHECK(p.red_of_level(0) == 2001);
    }

    TEST_CASE("propagation 0.7 divides by 8 + (n - 8) * 0.7") {
        Pair p;
        gi::energies_from_leaves(p.layout, Sums{1000, 0, 0, 3001, 0, 0}, 0.7f, p.energies);
        CHECK(p.red_of_level(5) == 1053); // 4001 / 3.8 = 1052.9
        CHECK(p.red_of_level(4) == 340);  // 1053 / 3.1 = 339.7
    }

    TEST_CASE("sums clamp to what an energy can hold, where Godot wraps") {
        Pair p;
        gi::energies_from_leaves(p.layout, Sums{70000, -5, 65535, 1 << 24, 0, 0}, 1.0f, p.energies);
        const size_t leaf = size_t(p.layout.level_begin[6]) * 3;
        CHECK(p.energies.rgb[leaf] == 65535);
        CHECK(p.energies.rgb[leaf + 1] == 0);
        CHECK(p.energies.rgb[leaf + 2] == 65535);
        CHECK(p.red_of_level(5) == 65535);
    }

    TEST_CASE("a root alone and any propagation give black, not a division by zero") {
        const gi::CellLayout layout = gi::make_layout(tests::make_octree({}));
        for (const float propagation : {0.0f, 1.0f, 2.0f, -3.0f, std::numeric_limits<float>::quiet_NaN()}) {
            gi::CellEnergies energies;
            gi::energies_from_leaves(layout, {}, propagation, energies);
            CHECK(energies.rgb == std::vector<gi::Energy>{0, 0, 0});
        }
    }

    TEST_CASE("inner energies do not depend on threads or on what was there before") {
        const gi::CellLayout layout = gi::make_layout(busy_octree());
        Sums sums = gi::emission_energies(layout);
        gi::inject_light(layout, busy_lights()[0], 1, sums);
        gi::CellEnergies one;
        set_thread_count(1);
        gi::energies_from_leaves(layout, sums, 0.7f, one);
        gi::CellEnergies four;
        four.rgb.assign(layout.cell_count() * 3, 12345);
        set_thread_count(4);
        gi::energies_from_leaves(layout, sums, 0.7f, four);
        set_thread_count(0);
        CHECK(one.rgb == four.rgb);
    }

    TEST_CASE("summing anew only what changed gives the energies of all, and names the bricks that differ") {
        const gi::CellLayout layout = gi::make_layout(busy_octree());
        Sums sums = gi::emission_energies(layout);
        gi::CellEnergies energies;
        for (const std::vector<uint8_t>& bricks :
             gi::energies_from_leaves(layout, sums, 0.7f, energies).mips) {
            CHECK(std::count(bricks.begin(), bricks.end(), 1) == ptrdiff_t(bricks.size())); // new
        }
        size_t changes = 0;
        for (const gi::CachedLight& light : busy_lights()) {
            for (const float propagation : {0.7f, 0.2f}) {
                const std::vector<gi::Energy> before = energies.rgb;
                gi::inject_light(layout, light, 1, sums);
                const gi::ChangedBricks changed =
                    gi::energies_from_leaves(layout, sums, propagation, energies);
                gi::CellEnergies fresh;
                gi::energies_from_leaves(layout, sums, propagation, fresh);
                REQUIRE(energies.rgb == fresh.rgb);
                for (size_t mip = 0; mip < size_t(layout.levels); ++mip) {
                    const gi::MipBricks in = gi::bricks_of_mip(layout, mip);
                    for (size_t i = 0; i < in.bricks.size(); ++i) {
                        const size_t brick = in.bricks.begin + i;
                        const gi::CellRange cells =
                            gi::cells_below(layout, {brick, brick + 1}, in.texel_level - in.brick_level);
                        const auto at = [&](size_t cell) { return before.begin() + ptrdiff_t(cell) * 3; };
                        const bool differs = !std::equal(at(cells.begin), at(cells.end),
                                                         energies.rgb.begin() + ptrdiff_t(cells.begin) * 3);
                        REQUIRE((changed.mips[mip][i] != 0) == differs);
                        changes += differs ? 1 : 0;
                    }
                }
            }
        }
        CHECK(changes > 100);
    }
}

} // namespace
