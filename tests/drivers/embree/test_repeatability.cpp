#include "tests/drivers/embree/traced_world.h"

#include "core/threads.h"

#include <doctest/doctest.h>

#include <utility>

using namespace cl;
using namespace cl::tests;
using embree::PathOptions;

namespace {

/// A bit of everything that chance decides on.
Image picture(uint32_t seed) {
    PathOptions options;
    options.samples = 4;
    options.seed = seed;
    TracedWorld world(options, {50, 34}); // no whole tiles
    SkyDesc sky;
    sky.size = {8, 4};
    for (int i = 0; i < 8 * 4 * 3; ++i) {
        sky.radiance.push_back(static_cast<float>(i % 7));
    }
    EnvironmentDesc e;
    e.background_mode = BackgroundMode::Sky;
    e.sky = world.server.sky_create(sky);
    REQUIRE(world.server.environment_set(world.environment, e));
    MaterialDesc gloss;
    gloss.roughness = 0.3f;
    MaterialDesc veil = lambert(glm::vec3(0.7f));
    veil.transparent = true;
    veil.albedo.a = 0.5f;
    world.add(square(4.0f), gloss);
    world.add(square(4.0f),
              lambert(glm::vec3(0.3f))); // in the same place: which one is met must not depend on chance
    world.add(cube(), veil, placed({0, 0.5f, 0}));
    world.add(cube(), glowing({3, 2, 1}), placed({1.5f, 0.7f, 0}, glm::mat3(0.4f)));
    for (int i = 0; i < 40; ++i) {
        world.add(cube(), lambert(glm::vec3(0.5f)),
                  placed({-2.0f + 0.1f * static_cast<float>(i), 0.1f, 1.0f}, glm::mat3(0.12f)));
    }
    LightDesc lamp;
    lamp.shadow = true;
    world.add(lamp, placed({0, 2, 1}));
    world.look({0, 3, 4}, {0, 0.3f, 0}, 4.0f);
    return world.radiance();
}

/// The process's own number of threads, again, whatever a test does.
struct ThreadsRestored {
    ~ThreadsRestored() { set_thread_count(0); }
};

} // namespace

TEST_SUITE("drivers/embree/repeatability") {
    TEST_CASE("the same seed gives the same bits for any number of threads, another seed others") {
        const ThreadsRestored restored;
        set_thread_count(1);
        const Image one = picture(7);
        for (int threads : {2, 5}) {
            CAPTURE(threads);
            set_thread_count(threads);
            CHECK(picture(7).data == one.data);
        }
        CHECK(picture(8).data != one.data);
    }

    TEST_CASE("tracing leaves the number of threads alone") {
        const ThreadsRestored restored;
        set_thread_count(3);
        static_cast<void>(picture(1));
        CHECK(thread_count() == 3);
    }
}
