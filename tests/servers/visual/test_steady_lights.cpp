#include "servers/visual/steady_lights.h"

#include <doctest/doctest.h>

#include <algorithm>

using namespace cl;

namespace {

/// Three lamps under a sky, and the step that is next.
struct World {
    SteadyLights steady;
    radiosity::Lighting lighting;
    uint64_t step = 0;

    World() {
        lighting.sources.resize(3);
        for (size_t i = 0; i < 3; ++i) {
            lighting.sources[i].position.x = float(i);
        }
        lighting.sky.assign(4, glm::vec3(1.0f));
        mark();
    }
    int mark(Rest rest = Rest::AfterSteps) {
        steady.mark(lighting, ++step, rest);
        return int(std::count_if(lighting.sources.begin(), lighting.sources.end(),
                                 [](const radiosity::Source& s) { return s.steady; })) +
               (lighting.sky_steady ? 1 : 0);
    }
};

} // namespace

TEST_SUITE("servers/visual/steady_lights") {
    TEST_CASE("what is there first is steady, and stays so while only its radiance changes") {
        World world;
        CHECK(world.mark() == 4);
        world.lighting.sources[1].radiance = glm::vec3(7.0f);
        CHECK(world.mark() == 4);
        world.lighting.sources.erase(world.lighting.sources.begin());
        CHECK(world.mark() == 3);
    }

    TEST_CASE("lamps and skies that change are not, until they rest, one at a time") {
        World world;
        world.lighting.sources[0].position.y = 1.0f;
        world.lighting.sources[1].position.y = 1.0f;
        world.lighting.sky[0] = glm::vec3(0.0f);
        for (uint64_t i = 0; i < kRestSteps; ++i) {
            CHECK(world.mark() == 1);
            CHECK(world.lighting.sources[2].steady);
        }
        CHECK(world.mark() == 2);
        CHECK(world.mark() == 4);
    }

    TEST_CASE("what moves alone is as good as steady") {
        World world;
        for (int i = 0; i < 5; ++i) {
            world.lighting.sources[1].position.y += 1.0f;
            CHECK(world.mark() == 4);
        }
        world.lighting.sources[2].position.y += 1.0f;
        CHECK(world.mark() == 2);
    }

    TEST_CASE("at once is at once, and lasts") {
        World world;
        world.lighting.sources[0].range_m = 9.0f;
        world.lighting.sources[1].range_m = 9.0f;
        CHECK(world.mark() == 2);
        CHECK(world.mark(Rest::AtOnce) == 4);
        CHECK(world.mark() == 4);
    }
}
