#include "tests/scene/scene_fixture.h"

#include "scene/3d/camera.h"
#include "scene/3d/directional_light.h"
#include "scene/3d/gi_probe.h"
#include "scene/3d/mesh_instance.h"
#include "scene/3d/omni_light.h"
#include "scene/3d/spot_light.h"
#include "scene/3d/world.h"
#include "scene/3d/world_environment.h"
#include "scene/main/scene_tree.h"
#include "scene/resources/array_mesh.h"
#include "scene/resources/primitive_meshes.h"
#include "scene/resources/spatial_material.h"

#include "drivers/dummy/dummy_rasterizer.h"

#include "servers/rasterizer_checked.h"
#include "servers/visual_server.h"

#include <doctest/doctest.h>
#include <glm/geometric.hpp>

using namespace cl;
using namespace cl::scene;
using cl::dummy::CallKind;
using cl::dummy::RecordedFrame;
using cl::tests::register_types;

namespace {

/// A tree with a camera at (0, 0, 10) that looks along -Z, drawn into a recording.
class Recording {
public:
    Recording() {
        register_types();
        auto dummy = std::make_unique<dummy::DummyRasterizer>();
        recorder = dummy.get();
        tree = std::make_unique<SceneTree>(
            std::make_unique<VisualServer>(std::make_unique<RasterizerChecked>(std::move(dummy))),
            ViewportOptions{.size = {64, 64}, .to_window = false});
        RenderSettings settings;
        settings.gi_mode = GIMode::Cones; // the volumes are what these tests look at
        tree->server()->set_settings(settings);
        camera = &tree->root().add_new<Camera>("Camera");
        camera->set_translation({0, 0, 10});
    }
    const RecordedFrame& draw() {
        REQUIRE(tree->draw().ok());
        REQUIRE(recorder->last_frame() != nullptr);
        return *recorder->last_frame();
    }
    MeshInstance& add_cube(std::string_view name = "Cube") {
        auto& cube = tree->root().add_new<MeshInstance>(name);
        cube.set_mesh(make_ref<CubeMesh>());
        return cube;
    }
    [[nodiscard]] VisualServer& server() const { return *tree->server(); }

    dummy::DummyRasterizer* recorder = nullptr;
    std::unique_ptr<SceneTree> tree;
    Camera* camera = nullptr;
};

Ref<SpatialMaterial> rough(float roughness) {
    auto material = make_ref<SpatialMaterial>();
    SpatialParams params;
    params.roughness = roughness;
    material->set_params(params);
    return material;
}

Ref<Environment> with_exposure(float exposure) {
    auto environment = make_ref<Environment>();
    EnvironmentDesc desc;
    desc.exposure = exposure;
    environment->set_desc(desc);
    return environment;
}

} // namespace

TEST_SUITE("scene/3d/visual_instance") {
    TEST_CASE(
        "a mesh is drawn where its node is, while it is in the tree, visible and on a layer that is seen") {
        Recording r;
        MeshInstance& cube = r.add_cube();
        CHECK(r.draw().opaque.size() == 1);
        cube.set_translation({1, 2, 3});
        REQUIRE(r.draw().opaque.size() == 1);
        CHECK(r.draw().opaque[0].world_from_local == cube.global_transform());
        cube.set_visible(false);
        CHECK(r.draw().opaque.empty());
        cube.set_visible(true);
        cube.set_layers(2);
        r.camera->set_cull_mask(1);
        CHECK(r.draw().opaque.empty());
        r.camera->set_cull_mask(3);
        CHECK(r.draw().opaque.size() == 1);
        Expected<std::unique_ptr<Node>> removed = r.tree->root().remove_child(cube);
        CHECK(r.draw().opaque.empty());
        REQUIRE(r.tree->root().add_child(std::move(*removed)).ok());
        REQUIRE(r.draw().opaque.size() == 1);
        CHECK(r.draw().opaque[0].world_from_local.origin == glm::vec3(1, 2, 3));
    }

    TEST_CASE("what moves or hides a parent moves and hides the mesh") {
        Recording r;
        auto& parent = r.tree->root().add_new<Spatial>("Parent");
        auto& cube = parent.add_new<MeshInstance>("Cube");
        cube.set_mesh(make_ref<CubeMesh>());
        parent.set_translation({0, 1, 0});
        REQUIRE(r.draw().opaque.size() == 1);
        CHECK(r.draw().opaque[0].world_from_local.origin == glm::vec3(0, 1, 0));
        parent.set_visible(false);
        CHECK(r.draw().opaque.empty());
    }

    TEST_CASE("materials reach the picture in their order: override, slot, the mesh's own") {
        Recording r;
        MeshInstance& cube = r.add_cube();
        CHECK(r.draw().opaque_materials.at(0).is_default);
        auto own = make_ref<CubeMesh>();
        own->set_material(rough(0.1f));
        cube.set_mesh(own);
        CHECK(r.draw().opaque_materials.at(0).roughness == 0.1f);
        CHECK(cube.set_surface_material(0, rough(0.2f)) == SetResult::Done);
        CHECK(r.draw().opaque_materials.at(0).roughness == 0.2f);
        const Ref<SpatialMaterial> over = rough(0.3f);
        cube.set_material_override(over);
        CHECK(r.draw().opaque_materials.at(0).roughness == 0.3f);
        SpatialParams params = over->params();
        params.roughness = 0.4f;
        over->set_params(params); // a change of the resource needs no help of the node
        CHECK(r.draw().opaque_materials.at(0).roughness == 0.4f);
        cube.set_material_override(nullptr);
        CHECK(r.draw().opaque_materials.at(0).roughness == 0.2f);
    }

    TEST_CASE("materials that were set outside of the tree are there when the node enters, and survive a new "
              "shape") {
        Recording r;
        auto node = std::make_unique<MeshInstance>();
        const auto mesh = make_ref<CubeMesh>();
        node->set_mesh(mesh);
        CHECK(node->set_surface_material(0, rough(0.2f)) == SetResult::Done);
        node->set_use_in_baked_light(true);
        REQUIRE(r.tree->root().add_child(std::move(node)).ok());
        CHECK(r.draw().opaque_materials.at(0).roughness == 0.2f);
        CHECK(r.draw().opaque.at(0).receives_baked_light);
        const RID before = r.draw().opaque.at(0).mesh;
        REQUIRE(mesh->set("size", glm::vec3(1.0f)) == SetResult::Done);
        REQUIRE(r.draw().opaque.size() == 1);
        CHECK(r.draw().opaque[0].mesh != before);
        CHECK(r.draw().opaque_materials.at(0).roughness == 0.2f);
        CHECK(r.recorder->live().meshes == 1);
    }

    TEST_CASE("shadow casting is passed on") {
        Recording r;
        auto& sun = r.tree->root().add_new<DirectionalLight>("Sun");
        sun.edit([](LightDesc& d) { d.shadow = true; });
        MeshInstance& cube = r.add_cube();
        CHECK(r.draw().casters.at(0).size() == 1);
        CHECK(cube.set_cast_shadow(ShadowCasting::Off) == SetResult::Done);
        CHECK(r.draw().casters.at(0).empty());
        CHECK(cube.set_cast_shadow(ShadowCasting::ShadowsOnly) == SetResult::Done);
        CHECK(r.draw().casters.at(0).size() == 1);
        CHECK(r.draw().opaque.empty());
        CHECK(cube.set_cast_shadow(ShadowCasting::DoubleSided) == SetResult::Done);
        CHECK(r.draw().casters.at(0).at(0).double_sided);
    }
}

TEST_SUITE("scene/3d/light") {
    TEST_CASE("a light is described as its properties say, orthonormal, and follows them") {
        Recording r;
        auto& parent = r.tree->root().add_new<Spatial>("Parent");
        parent.set_scale({2, 2, 2});
        auto& lamp = parent.add_new<SpotLight>("Lamp");
        lamp.set_translation({1, 0, 0});
        CHECK(lamp.set("spot_angle", 30) == SetResult::Done);
        CHECK(lamp.set("spot_range", 12.5) == SetResult::Done);
        CHECK(lamp.set("light_color", Color{1, 0.5f, 0.25f, 1}) == SetResult::Done);
        r.add_cube();
        REQUIRE(r.draw().lights.size() == 1);
        const LightDesc expected = lamp.desc();
        CHECK(r.draw().light_descs[0] == expected);
        CHECK(expected.type == LightType::Spot);
        CHECK(expected.spot_angle_deg == 30.0f);
        CHECK(expected.range_m == 12.5f);
        CHECK(expected.color == Color{1, 0.5f, 0.25f, 1});
        const Transform& at = r.draw().lights[0].world_from_light;
        CHECK(at.origin == glm::vec3(2, 0, 0));
        CHECK(glm::length(at.basis[0]) == doctest::Approx(1.0));
        CHECK(lamp.set("light_energy", 7) == SetResult::Done);
        CHECK(r.draw().light_descs[0].energy == 7.0f);
    }

    TEST_CASE("a light stays of its kind") {
        register_types();
        OmniLight lamp;
        LightDesc other;
        other.type = LightType::Directional;
        lamp.set_desc(other);
        CHECK(lamp.desc().type == LightType::Omni);
    }

    TEST_CASE("an editor's light and a hidden one light nothing") {
        Recording r;
        r.add_cube();
        auto& lamp = r.tree->root().add_new<OmniLight>("Lamp");
        CHECK(r.draw().lights.size() == 1);
        lamp.set_editor_only(true);
        CHECK(r.draw().lights.empty());
        lamp.set_visible(false);
        lamp.set_editor_only(false);
        CHECK(r.draw().lights.empty());
        lamp.set_visible(true);
        CHECK(r.draw().lights.size() == 1);
    }
}

TEST_SUITE("scene/3d/camera") {
    TEST_CASE("the first camera is current until another asks to be, and again when that has left") {
        Recording r;
        auto& second = r.tree->root().add_new<Camera>("Second");
        second.set_fov(30.0f);
        CHECK(r.camera->is_current());
        CHECK(r.draw().frame.camera.fov_deg == 70.0f);
        second.make_current();
        CHECK(second.is_current());
        CHECK(!r.camera->is_current());
        CHECK(r.draw().frame.camera.fov_deg == 30.0f);
        second.queue_free();
        r.tree->step(0.1);
        CHECK(r.camera->is_current());
        CHECK(r.draw().frame.camera.fov_deg == 70.0f);
        r.camera->queue_free();
        r.tree->step(0.1);
        CHECK(r.tree->world().current_camera() == nullptr);
        CHECK(r.tree->draw().ok());
    }

    TEST_CASE("a camera that a file makes current takes over when it enters") {
        Recording r;
        auto camera = std::make_unique<Camera>();
        CHECK(camera->set("current", true) == SetResult::Done);
        CHECK(camera->set("fov", 20) == SetResult::Done);
        const Camera& entered = *camera;
        REQUIRE(r.tree->root().add_child(std::move(camera)).ok());
        CHECK(entered.is_current());
        CHECK(r.draw().frame.camera.fov_deg == 20.0f);
        CHECK(!r.camera->wants_current()); // being first is not saved as a wish
    }

    TEST_CASE("the eye is moved along its own axes, and scale does not matter") {
        Recording r;
        r.camera->set_rotation_degrees({0, 90, 0});
        r.camera->set_scale({3, 3, 3});
        r.camera->set_h_offset(1.0f);
        r.camera->set_v_offset(2.0f);
        const Transform eye = r.draw().frame.camera.world_from_camera;
        CHECK(glm::length(eye.origin - glm::vec3(0, 2, 9)) < 1e-5f); // its X is the world's -Z
        CHECK(glm::length(eye.basis[2] - glm::vec3(1, 0, 0)) < 1e-6f);
        CHECK(glm::length(r.camera->desc().world_from_camera.origin - eye.origin) < 1e-6f);
    }

    TEST_CASE("the lens is passed on as it is set") {
        Recording r;
        CHECK(r.camera->set_projection(Projection::Frustum) == SetResult::Done);
        CHECK(r.camera->set_keep_aspect(KeepAspect::Width) == SetResult::Done);
        CHECK(r.camera->set_size(3.0f) == SetResult::Done);
        r.camera->set_frustum_offset({0.5f, -0.5f});
        r.camera->set_near(0.2f);
        r.camera->set_far(50.0f);
        const CameraDesc lens = r.draw().frame.camera;
        CHECK(lens.projection == Projection::Frustum);
        CHECK(lens.keep_aspect == KeepAspect::Width);
        CHECK(lens.size_m == 3.0f);
        CHECK(lens.frustum_offset == glm::vec2(0.5f, -0.5f));
        CHECK(lens.near_m == 0.2f);
        CHECK(lens.far_m == 50.0f);
    }
}

TEST_SUITE("scene/3d/world_environment") {
    TEST_CASE("the camera's environment goes before the world's, the last world's before the first, and the "
              "fallback comes last") {
        Recording r;
        CHECK(!r.draw().frame.has_environment);
        r.tree->world().set_fallback_environment(with_exposure(5.0f));
        CHECK(r.draw().frame.environment.exposure == 5.0f);
        auto& first = r.tree->root().add_new<WorldEnvironment>("First");
        CHECK(r.draw().frame.environment.exposure == 5.0f); // it has none yet
        first.set_environment(with_exposure(2.0f));
        CHECK(r.draw().frame.environment.exposure == 2.0f);
        auto& second = r.tree->root().add_new<WorldEnvironment>("Second");
        second.set_environment(with_exposure(3.0f));
        CHECK(r.draw().frame.environment.exposure == 3.0f);
        r.camera->set_environment(with_exposure(4.0f));
        CHECK(r.draw().frame.environment.exposure == 4.0f);
        r.camera->set_environment(nullptr);
        CHECK(r.draw().frame.environment.exposure == 3.0f);
        REQUIRE(r.tree->root().remove_child(second).has_value());
        CHECK(r.draw().frame.environment.exposure == 2.0f);
        first.set_environment(nullptr);
        CHECK(r.draw().frame.environment.exposure == 5.0f);
        r.tree->world().set_fallback_environment(nullptr);
        CHECK(!r.draw().frame.has_environment);
    }
}

TEST_SUITE("scene/3d/gi_probe_in_a_tree") {
    TEST_CASE("assigning data, even the same, starts the probe over; a probe without data has no effect") {
        Recording r;
        MeshInstance& cube = r.add_cube();
        cube.set_use_in_baked_light(true);
        auto& probe = r.tree->root().add_new<GIProbe>("Probe");
        probe.set_extents(glm::vec3(2.0f));
        CHECK(probe.set_subdiv(GIProbeSubdiv::Cells64) == SetResult::Done);
        CHECK(r.draw().gi_probes.empty());
        REQUIRE(probe.bake().has_value());
        REQUIRE(r.tree->draw_settled().ok());
        CHECK(r.recorder->count(CallKind::VolumeCreate) == 1);
        CHECK(r.recorder->last_frame()->gi_probes.size() == 1);
        probe.set_data(probe.data());
        REQUIRE(r.tree->draw_settled().ok());
        CHECK(r.recorder->count(CallKind::VolumeCreate) == 2);
        CHECK(r.recorder->live().volumes == 1);
        probe.set_energy(2.0f);
        REQUIRE(r.tree->draw_settled().ok());
        CHECK(r.recorder->count(CallKind::VolumeCreate) == 2);               // read live
        CHECK(r.recorder->last_frame()->gi_probes.at(0).multiplier == 8.0f); // dynamic range 4
        probe.set_data(nullptr);
        REQUIRE(r.tree->draw_settled().ok());
        CHECK(r.recorder->last_frame()->gi_probes.empty());
        CHECK(r.recorder->live().volumes == 0);
    }
}

TEST_SUITE("scene/main/server_ownership") {
    TEST_CASE("all that nodes made in the server is gone with them, and all that resources made with those") {
        Recording r;
        auto& scene = r.tree->root().add_new<Spatial>("Scene");
        auto& cube = scene.add_new<MeshInstance>("Cube");
        cube.set_mesh(make_ref<CubeMesh>());
        auto& lamp = scene.add_new<OmniLight>("Lamp");
        auto& eye = scene.add_new<Camera>("Eye");
        auto& probe = scene.add_new<GIProbe>("Probe");
        probe.set_data(make_ref<GIProbeData>());
        eye.set_environment(make_ref<Environment>());
        REQUIRE(r.draw().opaque.size() == 1);
        const std::vector<RID> owned{cube.instance_rid(),
                                     lamp.instance_rid(),
                                     lamp.light_rid(),
                                     eye.camera_rid(),
                                     probe.instance_rid(),
                                     cube.mesh()->rid(r.server()),
                                     probe.data()->rid(r.server()),
                                     eye.environment()->rid(r.server())};
        scene.queue_free();
        r.tree->step(0.1);
        for (size_t i = 0; i < owned.size(); ++i) {
            CAPTURE(i);
            CHECK(owned[i].is_valid());
            CHECK(!r.server().free(owned[i]).ok()); // freed before
        }
        CHECK(r.recorder->live().meshes == 0);
        CHECK(r.server().stats().instances == 0);
        CHECK(r.server().stats().lights == 0);
    }

    TEST_CASE("a node that is removed keeps nothing in the server, and is told all again on its return") {
        Recording r;
        auto& lamp = r.tree->root().add_new<OmniLight>("Lamp");
        r.add_cube();
        lamp.edit([](LightDesc& d) { d.energy = 3.0f; });
        Expected<std::unique_ptr<Node>> removed = r.tree->root().remove_child(lamp);
        REQUIRE(removed.has_value());
        CHECK(!lamp.light_rid().is_valid());
        CHECK(!lamp.instance_rid().is_valid());
        lamp.edit([](LightDesc& d) { d.energy = 4.0f; });
        lamp.set_layers(2);
        lamp.set_visible(false);
        lamp.set_visible(true);
        CHECK(r.draw().lights.empty());
        REQUIRE(r.tree->root().add_child(std::move(*removed)).ok());
        REQUIRE(r.draw().lights.size() == 1);
        CHECK(r.draw().light_descs[0].energy == 4.0f);
    }

    TEST_CASE("resources outlive a server, and serve the next") {
        auto mesh = make_ref<CubeMesh>();
        const auto material = rough(0.5f);
        for (int i = 0; i < 2; ++i) {
            Recording r;
            auto& cube = r.tree->root().add_new<MeshInstance>("Cube");
            cube.set_mesh(mesh);
            cube.set_material_override(material);
            REQUIRE(r.draw().opaque.size() == 1);
            CHECK(r.draw().opaque_materials.at(0).roughness == 0.5f);
        }
    }

    TEST_CASE("a tree without a server runs, and says that it cannot draw") {
        register_types();
        SceneTree tree;
        tree.root().add_new<MeshInstance>("Cube").set_mesh(make_ref<CubeMesh>());
        tree.root().add_new<OmniLight>("Lamp").set_editor_only(true);
        tree.root().add_new<Camera>("Camera").set_fov(50.0f);
        tree.root().add_new<WorldEnvironment>("Environment").set_environment(make_ref<Environment>());
        tree.root().add_new<GIProbe>("Probe").set_data(make_ref<GIProbeData>());
        tree.step(0.1);
        REQUIRE(!tree.draw().ok());
        CHECK(tree.draw().error().message == "expected a tree with a VisualServer to draw it");
    }
}
