#include "tests/captured_stderr.h"
#include "tests/servers/probe_octree.h"
#include "tests/servers/server_fixture.h"

#include <doctest/doctest.h>

#include <algorithm>
#include <cmath>
#include <functional>
#include <random>
#include <string>
#include <vector>

using namespace cl;
using dummy::CallKind;
using tests::at;
using tests::ServerFixture;

namespace {

Image small_image() {
    Image image;
    image.size = {2, 2};
    image.data.assign(16, 128);
    return image;
}

size_t lines_in(const std::string& text) {
    return static_cast<size_t>(std::count(text.begin(), text.end(), '\n'));
}

} // namespace

TEST_SUITE("servers/visual_server") {
    TEST_CASE("a stale or foreign RID is refused each time, logged once, and drawing goes on") {
        ServerFixture f;
        f.place_box(0, 0, 0);
        const RID light = f.server.light_create({});
        REQUIRE(f.server.free(light));
        const tests::CapturedStderr captured;
        for (int i = 0; i < 3; ++i) {
            const Status status = f.server.light_set(light, {});
            REQUIRE(!status);
            CHECK(status.error().code == ErrorCode::InvalidArgument);
            CHECK(status.error().message == "light_set: expected a light, found RID " +
                                                std::to_string(light.slot) +
                                                ":1, which is freed or of another kind");
            CHECK(f.draw().opaque.size() == 1);
        }
        CHECK(lines_in(captured.text()) == 1);
        CHECK(captured.text().starts_with("error: light_set: expected a light"));
    }

    TEST_CASE("every call that takes a RID refuses the null RID, a freed one and one of another kind") {
        ServerFixture f;
        const RID freed = f.mesh();
        REQUIRE(f.server.free(freed));
        const tests::CapturedStderr quiet;
        const RID texture = f.server.texture_create(small_image());
        const RID camera = f.server.camera_create();
        const RID instance = f.place_box(0, 0, 0), mesh = f.mesh();
        VisualServer& s = f.server;
        for (RID bad : {RID{}, freed, camera}) {
            CAPTURE(bad.slot);
            CHECK(!s.texture_size(bad));
            CHECK(!s.material_set(bad, {}));
            CHECK(!s.mesh_surface_set_material(bad, 0, {}));
            CHECK(!s.light_set(bad, {}));
            CHECK(!s.environment_set(bad, {}));
            CHECK(!s.gi_probe_set_data(bad, {}));
            CHECK(!s.gi_probe_set_energy(bad, 1.0f));
            CHECK(!s.gi_probe_set_interior(bad, true));
            CHECK(!s.gi_probe_set_dynamic_range(bad, 4));
            CHECK(!s.scenario_set_environment(bad, {}));
            CHECK(!s.instance_set_base(bad, {}));
            CHECK(!s.instance_set_transform(bad, {}));
            CHECK(!s.instance_set_visible(bad, true));
            CHECK(!s.viewport_set_size(bad, {1, 1}));
            CHECK(!s.viewport_read(bad, TargetFormat::Srgb8));
        }
        for (RID bad : {freed, texture}) {
            CHECK(!s.camera_set(bad, {}));
            CHECK(!s.instance_set_base(instance, bad));
            CHECK(!s.instance_set_scenario(instance, bad));
            CHECK(!s.instance_set_material_override(instance, bad));
            CHECK(!s.instance_set_surface_material(instance, 0, bad));
            CHECK(!s.mesh_surface_set_material(mesh, 0, bad));
            CHECK(!s.viewport_set_camera(f.viewport, bad));
            CHECK(!s.viewport_set_scenario(f.viewport, bad));
            CHECK(!s.scenario_set_environment(f.scenario, bad));
        }
        CHECK(!s.free(freed));
        CHECK(!s.free(RID{}));
        MaterialDesc desc;
        desc.ao_texture = mesh;
        CHECK(!s.material_set(s.material_create(), desc));
        CHECK(f.draw().opaque.size() == 1);
    }

    TEST_CASE(
        "numbers that are not finite, and surfaces that are not there, are refused and change nothing") {
        ServerFixture f;
        const RID box = f.place_box(0, 0, 0);
        const RID base = f.server.light_create({});
        f.place(base);
        const tests::CapturedStderr quiet;
        const float nan = std::nanf("");
        CHECK(!f.server.instance_set_transform(box, at(nan, 0, 0)));
        CHECK(!f.server.instance_set_extra_margin(box, nan));
        LightDesc light;
        light.energy = nan;
        CHECK(!f.server.light_set(base, light));
        CameraDesc camera;
        camera.world_from_camera.basis[1].x = INFINITY;
        CHECK(!f.server.camera_set(f.camera, camera));
        CHECK(!f.server.instance_set_surface_material(box, 1, {}));
        CHECK(!f.server.instance_set_surface_material(box, -1, {}));
        const dummy::RecordedFrame& frame = f.draw();
        REQUIRE(frame.opaque.size() == 1);
        CHECK(frame.opaque[0].world_from_local == Transform{});
        CHECK(frame.light_descs.at(0).energy == 1.0f);
        Image torn = small_image();
        torn.data.pop_back();
        CHECK(!f.server.texture_create(torn));
    }

    TEST_CASE("every call that may change a picture says so until the next frame; others do not") {
        ServerFixture f;
        VisualServer& s = f.server;
        const RID mesh = f.mesh(), box = f.place(mesh), material = s.material_create();
        const RID light = s.light_create({}), environment = s.environment_create();
        const RID probe = s.gi_probe_create();
        const std::function<void()> edits[] = {
            [&] { s.texture_create(small_image()); },
            [&] { CHECK(s.material_set(material, {})); },
            [&] { f.mesh(); },
            [&] { CHECK(s.mesh_surface_set_material(mesh, 0, material)); },
            [&] { CHECK(s.light_set(light, {})); },
            [&] { s.sky_create({}); },
            [&] { CHECK(s.environment_set(environment, {})); },
            [&] { CHECK(s.camera_set(f.camera, {})); },
            [&] { CHECK(s.gi_probe_set_data(probe, {})); },
            [&] { CHECK(s.gi_probe_set_energy(probe, 2.0f)); },
            [&] { CHECK(s.gi_probe_set_bias(probe, 2.0f)); },
            [&] { CHECK(s.gi_probe_set_normal_bias(probe, 2.0f)); },
            [&] { CHECK(s.gi_probe_set_propagation(probe, 0.5f)); },
            [&] { CHECK(s.gi_probe_set_interior(probe, true)); },
            [&] { CHECK(s.gi_probe_set_dynamic_range(probe, 2)); },
            [&] { CHECK(s.scenario_set_environment(f.scenario, environment)); },
            [&] { s.instance_create(mesh, f.scenario); },
            [&] { CHECK(s.instance_set_base(box, light)); },
            [&] { CHECK(s.instance_set_base(box, mesh)); },
            [&] { CHECK(s.instance_set_scenario(box, f.scenario)); },
            [&] { CHECK(s.instance_set_transform(box, at(1, 0, 0))); },
            [&] { CHECK(s.instance_set_visible(box, true)); },
            [&] { CHECK(s.instance_set_layers(box, 3)); },
            [&] { CHECK(s.instance_set_surface_material(box, 0, material)); },
            [&] { CHECK(s.instance_set_material_override(box, material)); },
            [&] { CHECK(s.instance_set_casting(box, ShadowCasting::Off)); },
            [&] { CHECK(s.instance_set_use_in_baked_light(box, true)); },
            [&] { CHECK(s.instance_set_extra_margin(box, 1.0f)); },
            [&] {
                CHECK(s.viewport_set_size(f.viewport, {32, 32}));
            },
            [&] { CHECK(s.viewport_set_camera(f.viewport, f.camera)); },
            [&] { CHECK(s.viewport_set_scenario(f.viewport, f.scenario)); },
            [&] { s.set_settings(s.settings()); },
            [&] { CHECK(s.free(material)); },
        };
        CHECK(s.has_changed()); // nothing was drawn yet
        for (size_t i = 0; i < std::size(edits); ++i) {
            CAPTURE(i);
            f.draw();
            static_cast<void>(s.stats());
            static_cast<void>(s.settings());
            static_cast<void>(s.viewport_read(f.viewport, TargetFormat::Srgb8));
            CHECK(!s.has_changed());
            edits[i]();
            CHECK(s.has_changed());
        }
    }

    TEST_CASE("meshes, textures and skies reach the rasteriser when first drawn, once") {
        ServerFixture f;
        const RID texture = f.server.texture_create(small_image());
        MaterialDesc desc;
        desc.albedo_texture = texture;
        const RID material = f.server.material_create(desc);
        const RID instance = f.place(f.mesh(), at(500, 0, 0));
        REQUIRE(f.server.instance_set_material_override(instance, material));
        f.draw(); // out of sight
        CHECK(f.dummy->count(CallKind::MeshCreate) == 0);
        CHECK(f.dummy->count(CallKind::TextureCreate) == 0);
        REQUIRE(f.server.instance_set_transform(instance, Transform{}));
        f.draw();
        f.draw();
        CHECK(f.dummy->count(CallKind::MeshCreate) == 1);
        CHECK(f.dummy->count(CallKind::TextureCreate) == 1);
    }

    TEST_CASE("a texture is decoded from sRGB where it is a colour and not where it is a number") {
        ServerFixture f;
        const RID instance = f.place_box(0, 0, 0);
        const RID texture = f.server.texture_create(small_image());
        MaterialDesc desc;
        desc.albedo_texture = desc.emission_texture = texture;
        desc.metallic_texture = desc.roughness_texture = desc.normal_texture = desc.ao_texture = texture;
        REQUIRE(f.server.instance_set_material_override(instance, f.server.material_create(desc)));
        const MaterialDesc drawn = f.draw().opaque_materials.at(0);
        CHECK(f.dummy->live().textures == 2);
        for (RID rid : {drawn.albedo_texture, drawn.emission_texture}) {
            CHECK(f.dummy->texture_space(rid) == TextureColorSpace::Srgb);
        }
        for (RID rid :
             {drawn.metallic_texture, drawn.roughness_texture, drawn.normal_texture, drawn.ao_texture}) {
            CHECK(f.dummy->texture_space(rid) == TextureColorSpace::Linear);
        }
        CHECK(f.server.texture_size(texture).value() == glm::ivec2(2, 2));
        REQUIRE(f.server.free(texture));
        CHECK(f.dummy->live().textures == 0);
        CHECK(!f.draw().opaque_materials.at(0).albedo_texture);
    }

    TEST_CASE("the server lets go of an image once it is uploaded in every space that materials use") {
        ServerFixture f;
        auto image = std::make_shared<const Image>(small_image());
        const std::weak_ptr<const Image> watch = image;
        const RID texture = f.server.texture_create(std::move(image));
        MaterialDesc as_color, as_number;
        as_color.albedo_texture = texture;
        as_number.normal_texture = texture;
        const RID color = f.server.material_create(as_color), number = f.server.material_create(as_number);
        const RID instance = f.place_box(0, 0, 0);
        REQUIRE(f.server.instance_set_material_override(instance, color));
        f.draw();
        CHECK(!watch.expired()); // the other material is alive
        REQUIRE(f.server.instance_set_material_override(instance, number));
        f.draw();
        CHECK(watch.expired());
        CHECK(f.dummy->live().textures == 2);
    }

    TEST_CASE(
        "a use in the other space that comes after the image is gone warns and draws with what there is") {
        ServerFixture f;
        const RID texture = f.server.texture_create(small_image());
        MaterialDesc desc;
        desc.albedo_texture = texture;
        const RID instance = f.place_box(0, 0, 0);
        REQUIRE(f.server.instance_set_material_override(instance, f.server.material_create(desc)));
        f.draw();
        desc = {};
        desc.normal_texture = texture;
        REQUIRE(f.server.instance_set_material_override(instance, f.server.material_create(desc)));
        const tests::CapturedStderr captured;
        CHECK(f.draw().opaque_materials.at(0).normal_texture);
        f.draw();
        CHECK(captured.text() ==
              "warning: texture 0: its image was released before a material first used it as "
              "numbers; create it again to use it so\n");
    }

    TEST_CASE("what the rasteriser refuses is reported by draw() once, and the rest is drawn") {
        ServerFixture f;
        f.place_box(0, 0, 0);
        f.place_box(1, 0, 0);
        f.dummy->fail_next(CallKind::MeshCreate, {ErrorCode::Unsupported, "too many vertices", {}});
        const Status drawn = f.server.draw();
        REQUIRE(!drawn);
        CHECK(drawn.error().message == "too many vertices");
        REQUIRE(f.dummy->last_frame());
        CHECK(f.dummy->last_frame()->opaque.size() == 1);
        CHECK(f.server.draw());
    }

    TEST_CASE("changing the base drops the surface materials; a freed base leaves an empty instance") {
        ServerFixture f;
        const RID first = f.mesh(), second = f.mesh();
        const RID instance = f.place(first);
        MaterialDesc desc;
        desc.roughness = 0.25f;
        REQUIRE(f.server.instance_set_surface_material(instance, 0, f.server.material_create(desc)));
        CHECK(f.draw().opaque_materials.at(0).roughness == 0.25f);
        REQUIRE(f.server.instance_set_base(instance, first)); // no change
        CHECK(f.draw().opaque_materials.at(0).roughness == 0.25f);
        REQUIRE(f.server.instance_set_base(instance, second));
        CHECK(f.draw().opaque_materials.at(0).is_default);
        REQUIRE(f.server.free(second));
        CHECK(f.draw().opaque.empty());
        REQUIRE(f.server.instance_set_base(instance, first));
        CHECK(f.draw().opaque.size() == 1);
    }

    TEST_CASE("a freed scenario leaves its instances nowhere, and they can go elsewhere") {
        ServerFixture f;
        const RID instance = f.place_box(0, 0, 0);
        REQUIRE(f.server.free(f.scenario));
        CHECK(f.draw().opaque.empty());
        const RID other = f.server.scenario_create();
        REQUIRE(f.server.instance_set_scenario(instance, other));
        REQUIRE(f.server.viewport_set_scenario(f.viewport, other));
        CHECK(f.draw().opaque.size() == 1);
    }

    TEST_CASE("freeing everything, in any order, leaves nothing in the rasteriser") {
        for (unsigned seed = 1; seed <= 40; ++seed) {
            CAPTURE(seed);
            std::mt19937 random(seed);
            ServerFixture f;
            const RID texture = f.server.texture_create(small_image());
            MaterialDesc desc;
            desc.albedo_texture = desc.roughness_texture = texture;
            const RID material = f.server.material_create(desc);
            SkyDesc sky;
            sky.size = {2, 1};
            sky.radiance.assign(6, 0.5f);
            const RID sky_rid = f.server.sky_create(sky);
            EnvironmentDesc environment;
            environment.sky = sky_rid;
            const RID environment_rid = f.server.environment_create(environment);
            REQUIRE(f.server.scenario_set_environment(f.scenario, environment_rid));
            const RID mesh = f.mesh();
            const RID box = f.place(mesh);
            REQUIRE(f.server.instance_set_material_override(box, material));
            LightDesc lamp;
            lamp.shadow = true;
            const RID light = f.server.light_create(lamp);
            const RID light_instance = f.place(light);
            const RID probe = f.server.gi_probe_create();
            REQUIRE(f.server.gi_probe_set_data(probe, tests::floor_probe_data()));
            const RID probe_instance = f.place(probe);
            f.draw();
            if (seed % 2 == 0) {
                f.server.settle();
            } // else freed while the worker may be at it
            f.draw();
            CHECK(f.dummy->live() == dummy::LiveCounts{2, 1, 1, 1, 1});
            std::vector<RID> all{texture,    material, sky_rid,        environment_rid, mesh,
                                 box,        light,    light_instance, probe,           probe_instance,
                                 f.scenario, f.camera, f.viewport};
            std::shuffle(all.begin(), all.end(), random);
            for (RID rid : all) {
                REQUIRE(f.server.free(rid));
                if (random() % 3 == 0) {
                    REQUIRE(f.server.draw());
                }
            }
            REQUIRE(f.server.draw());
            CHECK(f.dummy->live() == dummy::LiveCounts{});
            CHECK(f.server.is_settled());
        }
    }

    TEST_CASE("a viewport reads what was drawn at its size, and says so before it was drawn") {
        ServerFixture f;
        RenderSettings settings;
        settings.clear_color = {1.0f, 0.0f, 0.0f, 1.0f};
        f.server.set_settings(settings);
        const Expected<Image> before = f.server.viewport_read(f.viewport, TargetFormat::Srgb8);
        REQUIRE(!before);
        CHECK(before.error().message == "viewport_read: expected a viewport that was drawn");
        f.draw();
        REQUIRE(f.server.viewport_set_size(f.viewport, {8, 4}));
        f.draw();
        const Expected<Image> after = f.server.viewport_read(f.viewport, TargetFormat::Srgb8);
        REQUIRE(after);
        CHECK(after->size == glm::ivec2(8, 4));
        CHECK(after->data[0] == 255);
        CHECK(f.dummy->live().targets == 1);
    }

    TEST_CASE("a viewport without camera or world draws the background; one without size draws nothing") {
        ServerFixture f;
        f.place_box(0, 0, 0);
        REQUIRE(f.server.viewport_set_camera(f.viewport, {}));
        CHECK(f.draw().opaque.empty());
        REQUIRE(f.server.viewport_set_camera(f.viewport, f.camera));
        REQUIRE(f.server.viewport_set_scenario(f.viewport, {}));
        CHECK(f.draw().opaque.empty());
        REQUIRE(f.server.viewport_set_size(f.viewport, {0, 5}));
        f.dummy->forget_calls();
        CHECK(f.server.draw());
        CHECK(f.dummy->count(CallKind::Draw) == 0);
    }

    TEST_CASE("a window's viewport is drawn to the null target and presented once a frame") {
        ServerFixture f;
        const RID window = f.server.viewport_create({32, 16}, /*to_window=*/true);
        f.draw();
        CHECK(f.dummy->count(CallKind::Present) == 1);
        CHECK(f.dummy->count(CallKind::Draw) == 2);
        CHECK(f.dummy->live().targets == 1);
        REQUIRE(f.server.free(window));
        f.draw();
        CHECK(f.dummy->count(CallKind::Present) == 1);
    }

    TEST_CASE("the figures of a frame are summed over the viewports") {
        ServerFixture f;
        f.place_box(0, 0, 0);
        f.draw();
        CHECK(f.server.stats().frame.draw_calls == 1);
        CHECK(f.server.stats().frame.triangles == 12);
        const RID second = f.server.viewport_create({16, 16});
        REQUIRE(f.server.viewport_set_scenario(second, f.scenario));
        REQUIRE(f.server.viewport_set_camera(second, f.camera));
        f.draw();
        CHECK(f.server.stats().frame.draw_calls == 2);
        CHECK(f.server.stats().frame.triangles == 24);
    }
}
