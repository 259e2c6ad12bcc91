#include "tests/servers/server_fixture.h"

#include <doctest/doctest.h>

#include <algorithm>

using namespace cl;
using namespace cl::tests;

TEST_SUITE("servers/visual/world_items") {
    TEST_CASE("a rasteriser that wants the whole scene gets what is out of view, but not what is hidden") {
        ServerFixture f;
        f.dummy->set_frame_contents(FrameContents::WholeScene);
        const RID mesh = f.server.mesh_create({box_surface()}).value();
        const auto stand = [&](float z) {
            const RID instance = f.server.instance_create(mesh, f.scenario);
            REQUIRE(f.server.instance_set_transform(instance, at(0, 0, z)));
            return instance;
        };
        stand(0);
        const RID behind = stand(1000);
        REQUIRE(f.server.instance_set_layers(behind, 6));
        const RID hidden = stand(1);
        REQUIRE(f.server.instance_set_visible(hidden, false));
        const RID shadow = stand(2);
        REQUIRE(f.server.instance_set_casting(shadow, ShadowCasting::ShadowsOnly));
        LightDesc sun;
        sun.type = LightType::Directional;
        f.server.instance_create(f.server.light_create(sun), f.scenario);
        const RID far_lamp = f.server.instance_create(f.server.light_create({}), f.scenario);
        REQUIRE(f.server.instance_set_transform(far_lamp, at(0, 0, 5000)));
        REQUIRE(f.server.draw());
        const dummy::RecordedFrame& frame = *f.dummy->last_frame();
        REQUIRE(frame.world.size() == 3);
        CHECK(frame.opaque.empty());
        CHECK(frame.world[1].world_from_local.origin.z == 1000.0f);
        CHECK(frame.world[1].layers == 6);
        CHECK(frame.world[2].casting == ShadowCasting::ShadowsOnly);
        REQUIRE(frame.lights.size() == 2);
        CHECK(frame.frame.directional_count == 1);
        CHECK(frame.lights[1].world_from_light.origin.z == 5000.0f);
        f.dummy->set_frame_contents(FrameContents::InView);
        REQUIRE(f.server.draw());
        CHECK(f.dummy->last_frame()->world.empty());
        CHECK(f.dummy->last_frame()->opaque.size() == 1);
    }
}
