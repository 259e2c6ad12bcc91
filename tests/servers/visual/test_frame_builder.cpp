#include "tests/servers/probe_octree.h"
#include "tests/servers/server_fixture.h"

#include <doctest/doctest.h>
#include <glm/matrix.hpp>

#include <algorithm>
#include <random>
#include <set>
#include <vector>

using namespace cl;
using tests::at;
using tests::ServerFixture;

namespace {

std::vector<float> depths(const std::vector<DrawItem>& items) {
    std::vector<float> result;
    for (const DrawItem& item : items) {
        result.push_back(item.view_depth_m);
    }
    return result;
}

LightDesc omni(float range_m = 50.0f) {
    LightDesc desc;
    desc.range_m = range_m;
    return desc;
}

LightDesc sun() {
    LightDesc desc;
    desc.type = LightType::Directional;
    return desc;
}

} // namespace

TEST_SUITE("servers/visual/frame_builder") {
    TEST_CASE("what is in front of the camera is drawn, what is behind, beside or beyond is not") {
        ServerFixture f;
        f.place_box(0.0f, 0.0f, 0.0f);    // 10 m ahead
        f.place_box(0.0f, 0.0f, 20.0f);   // behind
        f.place_box(200.0f, 0.0f, 0.0f);  // beside
        f.place_box(0.0f, 0.0f, -200.0f); // beyond the far plane
        f.place_box(0.0f, 0.0f, 10.3f);   // around the camera
        const std::vector<float> found = depths(f.draw().opaque);
        REQUIRE(found.size() == 2);
        CHECK(found[0] == doctest::Approx(-0.3));
        CHECK(found[1] == doctest::Approx(10.0));
    }

    TEST_CASE("a box of which any corner would be on the screen is never culled") {
        ServerFixture f;
        std::mt19937 random(5);
        std::uniform_real_distribution<float> d(-40.0f, 40.0f), angle(0.0f, 6.28f);
        const RID mesh = f.mesh({1.0f, 0.5f, 2.0f});
        std::vector<glm::vec3> origins;
        for (int i = 0; i < 400; ++i) {
            origins.emplace_back(d(random), d(random), d(random));
            f.place(mesh, at(origins.back().x, origins.back().y, origins.back().z));
        }
        for (int look = 0; look < 10; ++look) {
            CameraDesc camera;
            camera.projection = look % 3 == 0 ? Projection::Orthogonal : Projection::Perspective;
            camera.size_m = 30.0f;
            camera.world_from_camera.basis =
                basis_from_euler_yxz({angle(random), angle(random), angle(random)});
            camera.world_from_camera.origin = {d(random), d(random), d(random)};
            REQUIRE(f.server.camera_set(f.camera, camera));
            const dummy::RecordedFrame& frame = f.draw();
            std::set<std::tuple<float, float, float>> drawn;
            for (const DrawItem& item : frame.opaque) {
                const glm::vec3 o = item.world_from_local.origin;
                drawn.insert({o.x, o.y, o.z});
            }
            CHECK(drawn.size() < origins.size());
            const glm::mat4 clip_from_world =
                projection_matrix(camera, {64, 64}) * camera.world_from_camera.inverse().to_mat4();
            for (const glm::vec3& origin : origins) {
                bool visible = false;
                for (int corner = 0; corner < 8; ++corner) {
                    const glm::vec3 sign(corner & 1 ? 1.0f : -1.0f, corner & 2 ? 1.0f : -1.0f,
                                         corner & 4 ? 1.0f : -1.0f);
                    const glm::vec4 c =
                        clip_from_world * glm::vec4(origin + sign * glm::vec3(1.0f, 0.5f, 2.0f), 1.0f);
                    visible = visible || (std::abs(c.x) < c.w && std::abs(c.y) < c.w && std::abs(c.z) < c.w);
                }
                if (visible) {
                    REQUIRE(drawn.contains({origin.x, origin.y, origin.z}));
                }
            }
        }
    }

    TEST_CASE(
        "hidden, shadows-only and masked-out instances are not drawn; a world of another viewport neither") {
        ServerFixture f;
        const RID hidden = f.place_box(0, 0, 0), shadow = f.place_box(1, 0, 0), layer = f.place_box(2, 0, 0),
                  elsewhere = f.place_box(3, 0, 0);
        CHECK(f.draw().opaque.size() == 4);
        REQUIRE(f.server.instance_set_visible(hidden, false));
        CHECK(f.draw().opaque.size() == 3);
        REQUIRE(f.server.instance_set_casting(shadow, ShadowCasting::ShadowsOnly));
        CHECK(f.draw().opaque.size() == 2);
        REQUIRE(f.server.instance_set_layers(layer, 1u << 5));
        CHECK(f.draw().opaque.size() == 2);
        CameraDesc camera;
        camera.world_from_camera = at(0.0f, 0.0f, 10.0f);
        camera.cull_mask = 1u;
        REQUIRE(f.server.camera_set(f.camera, camera));
        CHECK(f.draw().opaque.size() == 1);
        REQUIRE(f.server.instance_set_scenario(elsewhere, f.server.scenario_create()));
        CHECK(f.draw().opaque.empty());
    }

    TEST_CASE("the material is the override's, else the instance's for the surface, else the mesh's, else "
              "the default") {
        ServerFixture f;
        const auto material = [&f](float roughness) {
            MaterialDesc desc;
            desc.roughness = roughness;
            return f.server.material_create(desc);
        };
        const RID of_mesh = material(0.1f), of_instance = material(0.2f), override = material(0.3f);
        const RID mesh = f.mesh(glm::vec3(0.5f), 2);
        const RID instance = f.place(mesh);
        const auto drawn = [&f](size_t surface) {
            const dummy::RecordedFrame& frame = f.draw();
            REQUIRE(frame.opaque.size() == 2);
            for (size_t i = 0; i < 2; ++i) {
                if (frame.opaque[i].surface == static_cast<int>(surface)) {
                    return frame.opaque_materials[i];
                }
            }
            FAIL("the surface was not drawn");
            return MaterialDesc{};
        };
        CHECK(drawn(1).is_default);
        REQUIRE(f.server.mesh_surface_set_material(mesh, 1, of_mesh));
        CHECK(drawn(1).roughness == 0.1f);
        CHECK(!drawn(1).is_default);
        CHECK(drawn(0).is_default);
        REQUIRE(f.server.instance_set_surface_material(instance, 1, of_instance));
        CHECK(drawn(1).roughness == 0.2f);
        REQUIRE(f.server.instance_set_material_override(instance, override));
        CHECK(drawn(0).roughness == 0.3f);
        CHECK(drawn(1).roughness == 0.3f);
        // a freed material falls through to the next
        REQUIRE(f.server.free(override));
        CHECK(drawn(1).roughness == 0.2f);
        REQUIRE(f.server.free(of_instance));
        CHECK(drawn(1).roughness == 0.1f);
        REQUIRE(f.server.instance_set_surface_material(instance, 1, RID{}));
        REQUIRE(f.server.mesh_surface_set_material(mesh, 1, RID{}));
        CHECK(drawn(1).is_default);
    }

    TEST_CASE(
        "opaque items come front to back in depth steps, transparent ones by priority, then back to front") {
        ServerFixture f;
        MaterialDesc glass;
        glass.transparent = true;
        const RID low = f.server.material_create(glass);
        glass.render_priority = 1;
        const RID high = f.server.material_create(glass);
        for (int i = 0; i < 6; ++i) {
            const float z = static_cast<float>((i * 5) % 6) * -7.0f;
            f.place_box(0.0f, 0.0f, z);
            REQUIRE(f.server.instance_set_material_override(f.place_box(1.0f, 0.0f, z), i < 3 ? low : high));
        }
        const dummy::RecordedFrame& frame = f.draw();
        const std::vector<float> opaque = depths(frame.opaque);
        REQUIRE(opaque.size() == 6);
        CHECK(std::is_sorted(opaque.begin(), opaque.end()));
        REQUIRE(frame.transparent.size() == 6);
        for (size_t i = 1; i < 6; ++i) {
            const int before = frame.transparent_materials[i - 1].render_priority;
            const int now = frame.transparent_materials[i].render_priority;
            CHECK(before <= now);
            CHECK(
                (before < now || frame.transparent[i - 1].view_depth_m >= frame.transparent[i].view_depth_m));
        }
    }

    TEST_CASE("each instance gets the first 8 omni and 8 spot lights in pair order; hidden and masked ones "
              "do not count") {
        ServerFixture f;
        const RID box = f.place_box(0, 0, 0);
        f.draw();
        std::vector<RID> omnis, spots;
        for (int i = 0; i < 12; ++i) {
            omnis.push_back(f.place_light(omni()));
            f.draw(); // one a frame: pair order is creation order
            LightDesc spot = omni();
            spot.type = LightType::Spot;
            spots.push_back(f.place_light(spot, at(0, 0, 5)));
            f.draw();
        }
        const auto keys = [&f](bool omni_lights) {
            const dummy::RecordedFrame& frame = f.draw();
            const DrawItem& item = frame.opaque.at(0);
            std::vector<RID> result;
            for (int i = 0; i < (omni_lights ? item.omni_count : item.spot_count); ++i) {
                const auto n = static_cast<size_t>(i);
                result.push_back(frame.lights.at(omni_lights ? item.omnis[n] : item.spots[n]).key);
            }
            return result;
        };
        CHECK(keys(true) == std::vector<RID>(omnis.begin(), omnis.begin() + 8));
        CHECK(keys(false) == std::vector<RID>(spots.begin(), spots.begin() + 8));
        REQUIRE(f.server.instance_set_visible(omnis[0], false));
        CHECK(keys(true) == std::vector<RID>(omnis.begin() + 1, omnis.begin() + 9));
        REQUIRE(f.server.instance_set_layers(box, 2u));
        LightDesc masked = omni();
        masked.cull_mask = 1u;
        const RID other = f.place_light(masked);
        f.draw();
        CHECK(keys(true).size() == 8);
        for (RID key : keys(true)) {
            CHECK(key != other);
        }
    }

    TEST_CASE("directional lights come first, are global, and skip what their mask leaves out") {
        ServerFixture f;
        f.place_light(omni());
        const RID first = f.place_light(sun());
        LightDesc masked = sun();
        masked.cull_mask = 2u;
        const RID second = f.place_light(masked);
        const RID hidden = f.place_light(sun());
        REQUIRE(f.server.instance_set_visible(hidden, false));
        f.place_box(0, 0, 0);
        const dummy::RecordedFrame& frame = f.draw();
        REQUIRE(frame.frame.directional_count == 2);
        REQUIRE(frame.lights.size() == 3);
        CHECK(frame.lights[0].key == first);
        CHECK(frame.lights[1].key == second);
        CHECK(frame.opaque.at(0).directional_mask == 1u);
        CHECK(frame.opaque.at(0).omni_count == 1);
    }

    TEST_CASE("no more than 16 directional lights are drawn") {
        ServerFixture f;
        for (int i = 0; i < 20; ++i) {
            f.place_light(sun());
        }
        CHECK(f.draw().frame.directional_count == 16);
    }

    TEST_CASE("local lights that light nothing drawn are left out of the frame") {
        ServerFixture f;
        f.place_box(0, 0, 0);
        f.place_light(omni(1.0f), at(0, 0, 40));
        const RID near_by = f.place_light(omni(1.0f), at(0, 1, 0));
        const dummy::RecordedFrame& frame = f.draw();
        REQUIRE(frame.lights.size() == 1);
        CHECK(frame.lights[0].key == near_by);
    }

    TEST_CASE("lights stand without scale") {
        ServerFixture f;
        f.place_box(0, 0, 0);
        Transform scaled = at(0.0f, 1.0f, 0.0f);
        scaled.basis = basis_from_euler_yxz({0.3f, 0.2f, 0.1f}) * glm::mat3(3.0f);
        f.place_light(omni(), scaled);
        const Transform placed = f.draw().lights.at(0).world_from_light;
        CHECK(glm::determinant(placed.basis) == doctest::Approx(1.0));
        CHECK(placed.origin == scaled.origin);
    }

    TEST_CASE("a mesh with a mirrored transform says so") {
        ServerFixture f;
        Transform mirrored;
        mirrored.basis[0] = {-1.0f, 0.0f, 0.0f};
        f.place(f.mesh(), mirrored);
        CHECK(f.draw().opaque.at(0).mirrored);
    }

    TEST_CASE("the camera's environment wins over the world's; without either there is none") {
        ServerFixture f;
        CHECK(!f.draw().frame.has_environment);
        EnvironmentDesc desc;
        desc.exposure = 2.0f;
        const RID of_world = f.server.environment_create(desc);
        REQUIRE(f.server.scenario_set_environment(f.scenario, of_world));
        CHECK(f.draw().frame.environment.exposure == 2.0f);
        desc.exposure = 3.0f;
        SkyDesc sky;
        sky.size = {2, 1};
        sky.radiance.assign(6, 1.0f);
        desc.sky = f.server.sky_create(sky);
        desc.background_mode = BackgroundMode::Sky;
        CameraDesc camera;
        camera.environment = f.server.environment_create(EnvironmentDesc{});
        REQUIRE(f.server.environment_set(camera.environment, desc));
        REQUIRE(f.server.camera_set(f.camera, camera));
        CHECK(f.draw().frame.environment.exposure == 3.0f);
        CHECK(f.draw().frame.environment.sky); // the rasteriser's own: RasterizerChecked knows it
        CHECK(f.dummy->live().skies == 1);
        REQUIRE(f.server.free(camera.environment));
        CHECK(f.draw().frame.environment.exposure == 2.0f);
        REQUIRE(f.server.free(of_world));
        CHECK(!f.draw().frame.has_environment);
    }

    TEST_CASE("an instance is shaded by its first two probes; one not set up yet counts, as the null probe") {
        ServerFixture f;
        f.place_box(0, 0, 0);
        std::vector<RID> bases;
        for (int i = 0; i < 3; ++i) {
            gi::ProbeData data = tests::floor_probe_data();
            data.energy = static_cast<float>(i + 1);
            bases.push_back(f.server.gi_probe_create());
            REQUIRE(f.server.gi_probe_set_data(bases.back(), data));
            f.place(bases.back());
        }
        {
            const dummy::RecordedFrame& frame = f.draw(); // before any was set up
            REQUIRE(frame.gi_probes.size() == 2);
            CHECK(frame.opaque.at(0).gi_probes == std::array<int16_t, 2>{0, 1});
            for (const GIProbeShading& probe : frame.gi_probes) {
                CHECK(!probe.volume);
                CHECK(probe.multiplier == 0.0f);
                CHECK(probe.bounds_cells == glm::vec3(0.0f));
                CHECK(probe.cells_from_world == Transform{});
                CHECK(!probe.blend_ambient);
            }
        }
        f.server.settle();
        const dummy::RecordedFrame& frame = f.draw();
        REQUIRE(frame.gi_probes.size() == 2);
        CHECK(frame.gi_probes[0].multiplier == 4.0f * 3.0f); // the last in the tree pairs first
        CHECK(frame.gi_probes[1].multiplier == 4.0f * 2.0f);
        CHECK(frame.gi_probes[0].volume);
        CHECK(frame.gi_probes[0].size == glm::ivec3(64, 8, 8));
        CHECK(frame.gi_probes[0].bounds_cells == glm::vec3(64, 8, 8));
        CHECK(frame.gi_probes[0].blend_ambient);
        CHECK(frame.gi_probes[0].cells_from_world.xform({0, 0, 0}) == glm::vec3(32, 4, 4));
    }

    TEST_CASE("a probe's live parameters are those of the frame; with GI off no probe is referenced") {
        ServerFixture f;
        const RID box = f.place_box(0, 0, 0);
        REQUIRE(f.server.instance_set_use_in_baked_light(box, true));
        const RID base = f.server.gi_probe_create();
        REQUIRE(f.server.gi_probe_set_data(base, tests::floor_probe_data()));
        const RID probe = f.place(base);
        f.server.settle();
        REQUIRE(f.server.gi_probe_set_energy(base, 0.5f));
        REQUIRE(f.server.gi_probe_set_bias(base, 2.5f));
        REQUIRE(f.server.gi_probe_set_normal_bias(base, 0.25f));
        REQUIRE(f.server.gi_probe_set_interior(base, true));
        REQUIRE(f.server.instance_set_transform(probe, at(1.0f, 0.0f, 0.0f)));
        {
            const dummy::RecordedFrame& frame = f.draw();
            REQUIRE(frame.gi_probes.size() == 1);
            CHECK(frame.opaque.at(0).receives_baked_light);
            CHECK(frame.gi_probes[0].multiplier == 2.0f);
            CHECK(frame.gi_probes[0].bias_cells == 2.5f);
            CHECK(frame.gi_probes[0].normal_bias_m == 0.25f);
            CHECK(!frame.gi_probes[0].blend_ambient);
            CHECK(frame.gi_probes[0].cells_from_world.xform({1, 0, 0}) == glm::vec3(32, 4, 4));
        }
        RenderSettings settings;
        settings.gi_mode = GIMode::Off;
        f.server.set_settings(settings);
        const dummy::RecordedFrame& frame = f.draw();
        CHECK(frame.gi_probes.empty());
        CHECK(frame.opaque.at(0).gi_probes == std::array<int16_t, 2>{-1, -1});
        CHECK(frame.frame.gi_mode == GIMode::Off);
    }

    TEST_CASE("the multiplier follows the texels: a new dynamic range counts from the upload on") {
        ServerFixture f;
        f.place_box(0, 0, 0);
        const RID base = f.server.gi_probe_create();
        REQUIRE(f.server.gi_probe_set_data(base, tests::floor_probe_data()));
        f.place(base);
        f.server.settle();
        REQUIRE(f.server.gi_probe_set_dynamic_range(base, 8));
        CHECK(f.draw().gi_probes.at(0).multiplier == 4.0f);
        f.server.settle();
        CHECK(f.draw().gi_probes.at(0).multiplier == 8.0f);
    }

    TEST_CASE("two servers told the same draw the same, whatever else came and went before") {
        const auto drawn = [](int detour) {
            ServerFixture f;
            std::vector<RID> extra;
            for (int i = 0; i < detour; ++i) {
                extra.push_back(f.place_box(static_cast<float>(i), 3.0f, 0.0f));
            }
            f.draw();
            for (RID rid : extra) {
                REQUIRE(f.server.free(rid));
            }
            const RID mesh = f.mesh();
            for (int i = 0; i < 40; ++i) {
                f.place(mesh, at(static_cast<float>(i % 7) - 3.0f, static_cast<float>(i % 3),
                                 static_cast<float>(-i)));
            }
            return depths(f.draw().opaque);
        };
        CHECK(drawn(0).size() == 40);
        CHECK(drawn(0) == drawn(0));
        std::vector<float> direct = drawn(0), after = drawn(25);
        std::sort(direct.begin(), direct.end());
        std::sort(after.begin(), after.end());
        CHECK(direct == after);
    }
}
