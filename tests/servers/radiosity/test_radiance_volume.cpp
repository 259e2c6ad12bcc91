#include "tests/servers/radiosity/still_rooms.h"

#include "servers/radiosity/radiance_volume.h"

#include <doctest/doctest.h>

#include <algorithm>
#include <cstdlib>
#include <vector>

using namespace cl;
using namespace cl::radiosity;
using tests::LitRoom;
using tests::RoomBuilder;

TEST_SUITE("servers/radiosity/radiance_volume") {
    TEST_CASE("surfaces that send out the same radiance show it on every level, however little they cover") {
        RoomBuilder builder;
        builder.box(builder.material(glm::vec3(0.5f)), {0.1f, -0.2f, 0.05f}, {0.9f, 0.7f, 0.5f});
        const ProbeBox probe = tests::probe_with_cells(0.05f, 1.4f);
        const LitRoom room(builder.take(), {&probe, 1});
        Solution solution = room.solve(tests::darkness());
        std::fill(solution.leaving.begin(), solution.leaving.end(), gi::splat(3.0f));
        const RadianceVolume volume = make_radiance_volume(*room.transport, 0, solution);
        CHECK(volume.range == doctest::Approx(3.0f)); // a mean weighted by area
        size_t shown = 0, partly_covered = 0;
        for (const RadianceVolume::Level& level : volume.levels) {
            for (size_t i = 0; i < level.rgba8.size(); i += 4) {
                const int opacity = level.rgba8[i + 3];
                // Radiance is the range times (rgb / a)^2: rgb equals a, but for the rounding of both.
                CHECK(std::abs(int(level.rgba8[i]) - opacity) <= 1);
                shown += opacity > 0 ? 1 : 0;
                partly_covered += opacity > 0 && opacity < 255 ? 1 : 0;
            }
        }
        CHECK(shown > 100);
        CHECK(partly_covered > 10);
    }
}
