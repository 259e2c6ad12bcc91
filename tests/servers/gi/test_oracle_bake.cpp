#include "tests/servers/gi/oracle_probe.h"
#include "tests/shared_dir.h"

#include "servers/gi/voxelizer.h"

#include <doctest/doctest.h>

#include <cstdlib>
#include <map>

namespace {

using namespace cl;

/// Cells by place: level and origin, so that trees whose arrays are in different orders can be compared.
using CellMap = std::map<uint64_t, const gi::Cell*>;

void add_cells(const gi::Octree& tree, uint32_t index, int level, glm::ivec3 origin, CellMap& map) {
    const gi::Cell& cell = tree.cells[index];
    map[(uint64_t(level) << 60) | (uint64_t(origin.z) << 40) | (uint64_t(origin.y) << 20) |
        uint64_t(origin.x)] = &cell;
    const int half = level < tree.levels - 1 ? 1 << (tree.levels - 2 - level) : 0;
    for (int slot = 0; slot < 8; ++slot) {
        if (cell.children[slot] != gi::kNoChild) {
            const glm::ivec3 bits(slot & 1, (slot >> 1) & 1, slot >> 2);
            add_cells(tree, cell.children[slot], level + 1, origin + bits * half, map);
        }
    }
}

struct Agreement {
    size_t common = 0, ours_only = 0, theirs_only = 0;
    size_t bytes = 0, equal = 0, within_one = 0;
    size_t inner = 0, inner_equal = 0;
};

void compare_words(const gi::Cell& a, const gi::Cell& b, Agreement& result) {
    const auto compare = [&](uint32_t x, uint32_t y, int count) {
        for (int i = 0; i < count; ++i) {
            const int difference = std::abs(int((x >> (8 * i)) & 255u) - int((y >> (8 * i)) & 255u));
            ++result.bytes;
            result.equal += difference == 0;
            result.within_one += difference <= 1;
        }
    };
    compare(a.albedo, b.albedo, 3);
    compare(a.emission, b.emission, 4);
    compare(a.normal, b.normal, 3);
    compare(a.level_alpha, b.level_alpha, 2);
}

Agreement agreement(const gi::Octree& ours, const gi::Octree& theirs) {
    CellMap our_cells, their_cells;
    add_cells(ours, 0, 0, glm::ivec3(0), our_cells);
    add_cells(theirs, 0, 0, glm::ivec3(0), their_cells);
    const uint64_t leaf_level = uint64_t(ours.levels - 1);
    Agreement result;
    for (const auto& [place, cell] : our_cells) {
        const auto found = their_cells.find(place);
        if ((place >> 60) < leaf_level) {
            ++result.inner;
            result.inner_equal +=
                found != their_cells.end() && found->second->level_alpha == cell->level_alpha;
        } else if (found == their_cells.end()) {
            ++result.ours_only;
        } else {
            ++result.common;
            compare_words(*cell, *found->second, result);
        }
    }
    for (const auto& [place, cell] : their_cells) {
        result.theirs_only += (place >> 60) == leaf_level && our_cells.find(place) == our_cells.end();
    }
    return result;
}

struct OracleBake {
    const char* scene;
    const char* probe;
};

TEST_SUITE("servers/gi/voxelizer") {
    TEST_CASE("the oracle scenes bake to Godot's cells") {
        const auto shared = tests::shared_dir();
        if (!shared) {
            MESSAGE("skipped: no reference material");
            return;
        }
        for (const OracleBake& bake :
             {OracleBake{"cornell_omni", "Probe"}, OracleBake{"cornell_emissive", "Probe"},
              OracleBake{"sun_room", "Probe"}, OracleBake{"spot_bounce", "Probe"},
              OracleBake{"thin_wall", "Probe"}, OracleBake{"two_probes", "ProbeA"},
              OracleBake{"two_probes", "ProbeB"}, OracleBake{"courtyard", "Probe"}}) {
            const std::string name = std::string(bake.scene) + "_" + bake.probe;
            CAPTURE(name);
            const Expected<gi::Octree> theirs =
                gi::decode_octree(tests::load_dynamic_data(*shared / "oracle/godot" / (name + ".tres.xz")));
            REQUIRE_MESSAGE(theirs.has_value(), (theirs ? "" : theirs.error().message));
            const auto probe = tests::load_oracle_probe(
                *shared / "oracle/scenes" / (std::string(bake.scene) + ".tscn"), bake.probe);
            const Expected<gi::Octree> ours = gi::voxelize(probe->grid, probe->surfaces);
            REQUIRE(ours.has_value());

            CHECK(ours->levels == theirs->levels);
            CHECK(ours->dims == theirs->dims);
            CHECK(gi::decode_octree(gi::encode_octree(*ours)).has_value());
            const Agreement a = agreement(*ours, *theirs);
            const double overlap = double(a.common) / double(a.common + a.ours_only + a.theirs_only);
            MESSAGE(name << ": " << a.common << " leaves in both, " << a.ours_only << " ours only, "
                         << a.theirs_only << " theirs only; " << a.bytes - a.equal << " of " << a.bytes
                         << " bytes differ, " << a.bytes - a.within_one << " by more than 1; "
                         << a.inner - a.inner_equal << " of " << a.inner << " inner alphas differ; cells "
                         << ours->cells.size() << " and " << theirs->cells.size());
            // All of it is equal where this was written. The margin is for compilers that fuse multiplies and
            // adds.
            CHECK(overlap >= 0.999);
            CHECK(double(a.within_one) >= 0.999 * double(a.bytes));
            CHECK(double(a.inner_equal) >= 0.999 * double(a.inner));
        }
    }
}

} // namespace
