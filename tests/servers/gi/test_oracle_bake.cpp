#include "tests/servers/gi/agreement.h"
#include "tests/servers/gi/oracle_probe.h"
#include "tests/shared_dir.h"

#include "servers/gi/voxelizer.h"

#include <doctest/doctest.h>

#include <string>

namespace {

using namespace cl;
using tests::Agreement;

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
            const Expected<gi::BakedOctree> baked = gi::voxelize(probe->grid, probe->surfaces);
            REQUIRE(baked.has_value());
            const Expected<gi::Octree> ours = gi::decode_octree(baked->dynamic_data);
            REQUIRE(ours.has_value());

            CHECK(ours->levels == theirs->levels);
            CHECK(ours->dims == theirs->dims);
            const Agreement a = tests::agreement(*ours, *theirs);
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
