#include "tests/servers/radiosity/still_rooms.h"

#include <doctest/doctest.h>
#include <glm/common.hpp>

#include <algorithm>
#include <vector>

using namespace cl;
using namespace cl::radiosity;
using tests::LitRoom;
using tests::RoomBuilder;

TEST_SUITE("servers/radiosity/field_map") {
    TEST_CASE("the air of any number of probes fits a texture, and none shares texels with another's") {
        RoomBuilder builder;
        builder.box(builder.material(glm::vec3(0.5f)), glm::vec3(0.0f), glm::vec3(1.0f));
        const auto scene = builder.take();
        for (const size_t count : {1u, 3u, 150u}) {
            CAPTURE(count);
            std::vector<ProbeBox> probes(count, tests::probe_with_cells(2.0f / 128.0f, 2.0f));
            for (size_t i = 0; i < count; ++i) {
                probes[i].world_from_probe.origin.x = 3.0f * float(i);
            }
            const LitRoom room(scene, probes);
            const FieldMap& map = room.map;
            REQUIRE(map.probes.size() == count);
            for (int axis = 0; axis < 3; ++axis) {
                CHECK(map.air[axis] <= 2048);
            }
            std::vector<int> owners(size_t(map.air.x) * size_t(map.air.y) * size_t(map.air.z), 0);
            for (const FieldMap::Probe& probe : map.probes) {
                const glm::ivec3 end = probe.air_at + probe.bricks * glm::ivec3(1, 1, 4);
                REQUIRE(glm::min(end, map.air) == end);
                for (int z = probe.air_at.z; z < end.z; ++z) {
                    for (int y = probe.air_at.y; y < end.y; ++y) {
                        for (int x = probe.air_at.x; x < end.x; ++x) {
                            ++owners[(size_t(z) * size_t(map.air.y) + size_t(y)) * size_t(map.air.x) +
                                     size_t(x)];
                        }
                    }
                }
            }
            CHECK(std::count_if(owners.begin(), owners.end(), [](int n) { return n > 1; }) == 0);
        }
    }
}
