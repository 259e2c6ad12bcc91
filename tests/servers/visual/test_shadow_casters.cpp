#include "tests/servers/server_fixture.h"

#include <doctest/doctest.h>

#include <functional>
#include <set>
#include <vector>

using namespace cl;
using tests::at;
using tests::ServerFixture;

namespace {

LightDesc shadowing(LightType type, float range_m = 3.0f) {
    LightDesc desc;
    desc.type = type;
    desc.range_m = range_m;
    desc.shadow = true;
    return desc;
}

/// A box in view with a shadowing omni light on it: the first light of each frame.
struct ShadowFixture : ServerFixture {
    RID mesh_rid = mesh();
    RID box = place(mesh_rid);
    RID light_base = server.light_create(shadowing(LightType::Omni));
    RID light = place(light_base);

    const std::vector<CasterItem>& casters() { return draw().casters.at(0); }
    uint64_t version() { return draw().lights.at(0).casters_version; }
};

} // namespace

TEST_SUITE("servers/visual/shadow_casters") {
    TEST_CASE("off casts nothing; on, double-sided and shadows-only do, and double-sided says so") {
        ShadowFixture f;
        CHECK(f.casters().size() == 1);
        REQUIRE(f.server.instance_set_casting(f.box, ShadowCasting::DoubleSided));
        CHECK(f.casters().at(0).double_sided);
        REQUIRE(f.server.instance_set_casting(f.box, ShadowCasting::Off));
        CHECK(f.casters().empty());
        f.place_box(0.5f, 0.0f, 0.0f); // still something to light
        REQUIRE(f.server.instance_set_casting(f.box, ShadowCasting::ShadowsOnly));
        CHECK(f.casters().size() == 2);
        CHECK(f.draw().opaque.size() == 1);
    }

    TEST_CASE("a hidden instance casts nothing, one out of view does") {
        ShadowFixture f;
        const RID behind = f.place(f.mesh_rid, at(0.0f, 0.0f, 2.0f));
        CameraDesc camera;
        camera.world_from_camera = at(0.0f, 0.0f, 1.2f); // the second box is behind the camera
        REQUIRE(f.server.camera_set(f.camera, camera));
        CHECK(f.draw().opaque.size() == 1);
        CHECK(f.casters().size() == 2);
        REQUIRE(f.server.instance_set_visible(behind, false));
        CHECK(f.casters().size() == 1);
    }

    TEST_CASE("an omni or spot light has the casters whose box touches its own, a directional one has all") {
        ShadowFixture f;
        f.place(f.mesh_rid, at(3.5f, 0.0f, 0.0f)); // touches the omni's box
        f.place(f.mesh_rid, at(3.6f, 3.6f, 0.0f)); // does not
        const RID sun = f.place_light(shadowing(LightType::Directional));
        const dummy::RecordedFrame& frame = f.draw();
        REQUIRE(frame.lights.size() == 2);
        CHECK(frame.lights[0].key == sun);
        CHECK(frame.casters[0].size() == 3);
        CHECK(frame.casters[1].size() == 2);
        const AABB all = frame.frame.casters_bounds;
        CHECK(all.position == glm::vec3(-0.5f, -0.5f, -0.5f));
        CHECK(all.end().x == doctest::Approx(4.1));
        CHECK(all.end().y == doctest::Approx(4.1));
    }

    TEST_CASE("a light without shadow has no casters, nor has a spot of 90 degrees and more") {
        ShadowFixture f;
        LightDesc desc = shadowing(LightType::Omni);
        desc.shadow = false;
        REQUIRE(f.server.light_set(f.light_base, desc));
        CHECK(f.casters().empty());
        desc = shadowing(LightType::Spot);
        desc.spot_angle_deg = 89.0f;
        REQUIRE(f.server.light_set(f.light_base, desc));
        CHECK(f.casters().size() == 1);
        desc.spot_angle_deg = 90.0f;
        REQUIRE(f.server.light_set(f.light_base, desc));
        CHECK(f.casters().empty());
    }

    TEST_CASE("surfaces whose material casts no shadow are left out") {
        ShadowFixture f;
        MaterialDesc glass;
        glass.transparent = true;
        const RID material = f.server.material_create(glass);
        REQUIRE(f.server.instance_set_material_override(f.box, material));
        CHECK(f.casters().empty());
        glass.alpha_scissor = true;
        REQUIRE(f.server.material_set(material, glass));
        CHECK(f.casters().size() == 1);
    }

    TEST_CASE("the casters' version stays while nothing changes, also while the camera moves") {
        ShadowFixture f;
        const uint64_t version = f.version();
        CHECK(version != 0);
        CHECK(f.version() == version);
        CameraDesc camera;
        camera.world_from_camera = at(0.0f, 0.5f, 8.0f);
        REQUIRE(f.server.camera_set(f.camera, camera));
        f.place(f.mesh_rid, at(30.0f, 0.0f, 0.0f)); // out of the light's reach
        CHECK(f.version() == version);
    }

    TEST_CASE("the casters' version changes with whatever would change the shadow, and never returns") {
        ShadowFixture f;
        const RID material = f.server.material_create();
        const RID late = f.place(f.mesh_rid, at(1.0f, 0.0f, 0.0f));
        std::set<uint64_t> seen{f.version()};
        const auto check = [&](const char* what, const std::function<Status()>& change) {
            CAPTURE(what);
            REQUIRE(change());
            CHECK(seen.insert(f.version()).second);
        };
        check("caster moved", [&] { return f.server.instance_set_transform(late, at(1.5f, 0.0f, 0.0f)); });
        check("caster hidden", [&] { return f.server.instance_set_visible(late, false); });
        check("caster shown", [&] { return f.server.instance_set_visible(late, true); });
        check("casting", [&] { return f.server.instance_set_casting(late, ShadowCasting::DoubleSided); });
        check("override", [&] { return f.server.instance_set_material_override(late, material); });
        check("material", [&] {
            MaterialDesc desc;
            desc.cull_mode = CullMode::Disabled;
            return f.server.material_set(material, desc);
        });
        // so that the material's is not the latest version of all when it goes
        check("caster moved again",
              [&] { return f.server.instance_set_transform(late, at(1.4f, 0.0f, 0.0f)); });
        check("material freed", [&] { return f.server.free(material); });
        check("caster freed", [&] { return f.server.free(late); });
        check("light moved", [&] { return f.server.instance_set_transform(f.light, at(0.0f, 0.1f, 0.0f)); });
        check("light changed", [&] {
            LightDesc desc = shadowing(LightType::Omni);
            desc.shadow_bias_m = 0.3f;
            return f.server.light_set(f.light_base, desc);
        });
        check("caster added", [&] {
            f.place(f.mesh_rid, at(0.0f, 1.0f, 0.0f));
            return Status{};
        });
    }
}
