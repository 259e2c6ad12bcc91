#include "tests/scene/scene_fixture.h"

#include "scene/3d/gi_probe.h"
#include "scene/3d/mesh_instance.h"
#include "scene/resources/array_mesh.h"
#include "scene/resources/primitive_meshes.h"
#include "scene/resources/spatial_material.h"

#include <doctest/doctest.h>

#include <cmath>
#include <span>

using namespace cl;
using namespace cl::scene;
using cl::tests::register_types;

namespace {

Ref<SpatialMaterial> colored(const Color& albedo) {
    auto material = make_ref<SpatialMaterial>();
    SpatialParams params = material->params();
    params.albedo = albedo;
    material->set_params(params);
    return material;
}

MeshInstance& add_box(Node& parent, std::string_view name, glm::vec3 center_m, glm::vec3 size_m) {
    auto& node = parent.add_new<MeshInstance>(name);
    auto cube = make_ref<CubeMesh>();
    REQUIRE(cube->set("size", size_m) == SetResult::Done);
    node.set_mesh(cube);
    node.set_translation(center_m);
    node.set_use_in_baked_light(true);
    return node;
}

/// A closed room, inside -1..1 on each axis, with walls 0.1 m thick.
Spatial& add_room(Node& parent) {
    auto& room = parent.add_new<Spatial>("Room");
    for (int axis = 0; axis < 3; ++axis) {
        for (float side : {-1.05f, 1.05f}) {
            glm::vec3 center(0.0f);
            glm::vec3 size(2.2f);
            center[axis] = side;
            size[axis] = 0.1f;
            add_box(room, "Wall", center, size);
        }
    }
    return room;
}

gi::Octree octree_of(const GIProbe& probe) {
    REQUIRE(probe.data());
    Expected<gi::Octree> octree = gi::decode_octree(probe.data()->data().dynamic_data);
    REQUIRE(octree.has_value());
    return std::move(*octree);
}

} // namespace

TEST_SUITE("scene/3d/gi_probe") {
    TEST_CASE("one glowing quad bakes to the cells that Godot bakes") {
        register_types(); // spec gi-probe-data section 6
        Spatial scene;
        auto& quad = scene.add_new<MeshInstance>("Quad");
        auto mesh = make_ref<QuadMesh>();
        REQUIRE(mesh->set("size", glm::vec2(0.5f, 0.25f)) == SetResult::Done);
        quad.set_mesh(mesh);
        quad.set_translation({-0.3f, 0.2f, 0.01f});
        quad.set_use_in_baked_light(true);
        const Ref<SpatialMaterial> material = colored({0.8f, 0.4f, 0.2f, 1.0f});
        SpatialParams params = material->params();
        params.emission_enabled = true;
        params.emission = {1.0f, 0.5f, 0.0f, 1.0f};
        params.emission_energy = 2.0f;
        material->set_params(params);
        CHECK(quad.set_surface_material(0, material) == SetResult::Done);
        auto& probe = scene.add_new<GIProbe>("Probe");
        CHECK(probe.set_subdiv(GIProbeSubdiv::Cells64) == SetResult::Done);
        probe.set_extents({1.0f, 0.5f, 0.75f});

        const Expected<BakeFigures> figures = probe.bake();
        REQUIRE(figures.has_value());
        CHECK(figures->size == glm::ivec3(64, 32, 64));
        CHECK(figures->cells == 223);
        CHECK(figures->leaves == 153);
        CHECK(figures->triangles == 2);
        CHECK(figures->meshes == 1);
        const gi::ProbeData& data = probe.data()->data();
        CHECK(data.bounds == AABB{{-1.0f, -0.5f, -0.75f}, {2.0f, 1.0f, 1.5f}});
        CHECK(data.cell_size_m == 0.03125f);
        CHECK(data.cells_from_local == Transform{glm::mat3(32.0f), {32.0f, 16.0f, 24.0f}});
        CHECK(data.dynamic_range == 4);
        CHECK(data.bias_cells == 1.5f);
        CHECK(data.normal_bias_m == 0.0f);
        CHECK(data.propagation == 0.7f);
        REQUIRE(data.dynamic_data.size() == 2692);
        CHECK(data.dynamic_data[1] == 7);
        const auto cell = [&](size_t i) { return std::span(data.dynamic_data).subspan(16 + 12 * i, 12); };
        CHECK(cell(6)[8] == 13395507);
        CHECK(cell(6)[9] == -462290873);
        CHECK(cell(6)[10] == 8355839);
        CHECK(cell(6)[11] == 458751);
        CHECK(cell(1)[6] == 2);
        CHECK(cell(1)[7] == 31);
    }

    TEST_CASE("a closed room bakes to six walls around an empty middle") {
        register_types();
        Spatial scene;
        add_room(scene);
        auto& probe = scene.add_new<GIProbe>("Probe");
        probe.set_extents(glm::vec3(1.1f));
        CHECK(probe.set_subdiv(GIProbeSubdiv::Cells64) == SetResult::Done);
        const Expected<BakeFigures> figures = probe.bake();
        REQUIRE(figures.has_value());
        CHECK(figures->meshes == 6);
        CHECK(figures->triangles == 72);
        const gi::Octree octree = octree_of(probe);
        CHECK(octree.dims == glm::ivec3(64));
        // Each wall shows two faces of 64^2 cells; where walls meet they share some.
        CHECK(octree.leaf_count > 6 * 58 * 58);
        CHECK(octree.leaf_count < 6 * 3 * 2 * 64 * 64);
        CHECK(figures->leaves == octree.leaf_count);
    }

    TEST_CASE("what is hidden, not flagged, outside the box or not below the start stays out") {
        register_types();
        Spatial scene;
        Spatial& inside = scene.add_new<Spatial>("Inside");
        add_box(inside, "Used", {0, 0, 0}, glm::vec3(0.5f));
        add_box(inside, "NotFlagged", {0, 0, 0}, glm::vec3(0.5f)).set_use_in_baked_light(false);
        Spatial& hidden = inside.add_new<Spatial>("Hidden");
        add_box(hidden, "BelowHidden", {0, 0, 0}, glm::vec3(0.5f));
        hidden.set_visible(false);
        add_box(hidden.add_new<Node>("Plain"), "ChainBroken", {0, 0, 0}, glm::vec3(0.5f));
        add_box(inside, "Touching", {1.5f, 0, 0}, glm::vec3(1.0f));
        add_box(inside, "Overlapping", {1.4f, 0, 0}, glm::vec3(1.0f));
        add_box(scene, "Beside", {0, 0, 0}, glm::vec3(0.5f));
        CHECK(collect_bake_items(inside, Transform(), glm::vec3(1.0f)).size() == 3);
        CHECK(collect_bake_items(scene, Transform(), glm::vec3(1.0f)).size() == 4);
        CHECK(collect_bake_items(hidden, Transform(), glm::vec3(1.0f)).size() == 1);
    }

    TEST_CASE("layers, shadows, levels of detail and a box of the mesh's own keep nothing out of a bake") {
        register_types();
        Spatial scene;
        MeshInstance& box = add_box(scene, "Box", {0, 0, 0}, glm::vec3(0.5f));
        box.set_layers(0);
        CHECK(box.set_cast_shadow(ShadowCasting::ShadowsOnly) == SetResult::Done);
        box.set_lod_range({.min_distance_m = 5.0f, .max_distance_m = 6.0f});
        box.mesh()->set_custom_aabb({glm::vec3(100.0f), glm::vec3(1.0f)});
        CHECK(collect_bake_items(scene, Transform(), glm::vec3(1.0f)).size() == 1);
    }

    TEST_CASE("each surface is baked with the override, else the instance's own, else the mesh's material; "
              "lines are "
              "not baked") {
        register_types();
        auto mesh = make_ref<ArrayMesh>();
        for (const PrimitiveType type :
             {PrimitiveType::Triangles, PrimitiveType::Lines, PrimitiveType::Triangles}) {
            SurfaceArrays arrays;
            arrays.positions = {{-0.5f, -0.5f, 0}, {0.5f, -0.5f, 0}, {0, 0.5f, 0}, {0, 0, 0.5f}};
            arrays.indices = {0, 1, 2};
            if (type == PrimitiveType::Lines) {
                arrays.indices = {0, 3};
            }
            REQUIRE(mesh->add_surface_from_arrays(arrays, type).ok());
        }
        const auto of_mesh = colored({1, 0, 0, 1}), of_slot = colored({0, 1, 0, 1}),
                   over = colored({0, 0, 1, 1});
        mesh->set_surface_material(0, of_mesh);
        mesh->set_surface_material(2, of_mesh);
        MeshInstance instance;
        instance.set_mesh(mesh);
        instance.set_use_in_baked_light(true);
        CHECK(instance.set_surface_material(2, of_slot) == SetResult::Done);
        const auto materials = [&instance] {
            return collect_bake_items(instance, Transform(), glm::vec3(1.0f)).at(0).materials;
        };
        CHECK(materials() == std::vector<Ref<Material>>{of_mesh, nullptr, of_slot});
        instance.set_material_override(over);
        CHECK(materials() == std::vector<Ref<Material>>{over, over, over});
        const Expected<BakeResult> baked = bake_probe(
            instance, {.extents_m = glm::vec3(1.0f), .subdivision = 64, .world_from_probe = Transform()});
        REQUIRE(baked.has_value());
        CHECK(baked->figures.triangles == 2);
    }

    TEST_CASE("meshes that a node builds are baked with the mesh's own materials, flag or no flag") {
        register_types();
        class Builder final : public Spatial {
        public:
            std::vector<BakeMesh> bake_meshes() const override {
                Transform up;
                up.origin = {0, 1, 0};
                return {{Transform(), mesh}, {up, mesh}, {up, nullptr}};
            }
            Ref<CubeMesh> mesh = make_ref<CubeMesh>();
        };
        Builder builder;
        builder.set_translation({0, 0, 1});
        builder.mesh->set_material(colored({1, 0, 0, 1}));
        const std::vector<BakeItem> items = collect_bake_items(builder, Transform(), glm::vec3(4.0f));
        REQUIRE(items.size() == 2);
        CHECK(items[1].probe_from_mesh.origin == glm::vec3(0, 1, 1));
        REQUIRE(items[1].materials.size() == 1);
        CHECK(items[1].materials[0] == builder.mesh->surface_material(0));
        builder.set_visible(false);
        CHECK(collect_bake_items(builder, Transform(), glm::vec3(4.0f)).empty());
    }

    TEST_CASE("a probe turned and scaled with its scene bakes the same cells, for scale does not count") {
        register_types();
        Spatial scene;
        add_room(scene);
        auto& probe = scene.add_new<GIProbe>("Probe");
        probe.set_extents(glm::vec3(1.3f, 1.2f, 1.15f));
        CHECK(probe.set_subdiv(GIProbeSubdiv::Cells64) == SetResult::Done);
        REQUIRE(probe.bake().has_value());
        const uint32_t leaves = octree_of(probe).leaf_count;
        scene.set_rotation_degrees({0, 90, 0});
        scene.set_translation({4, 0, 0});
        probe.set_scale({3, 3, 3});
        const Expected<BakeFigures> turned = probe.bake();
        REQUIRE(turned.has_value());
        CHECK(std::abs(static_cast<double>(turned->leaves) - leaves) < 0.01 * leaves); // rounding of the turn
    }

    TEST_CASE("a bake puts its result into the data that is there, and makes it where there is none") {
        register_types();
        Spatial scene;
        add_room(scene);
        auto& probe = scene.add_new<GIProbe>("Probe");
        probe.set_extents(glm::vec3(1.1f));
        CHECK(probe.set_subdiv(GIProbeSubdiv::Cells64) == SetResult::Done);
        probe.set_energy(2.0f);
        CHECK(probe.set_dynamic_range(8) == SetResult::Done);
        REQUIRE(probe.bake().has_value());
        const Ref<GIProbeData> data = probe.data();
        REQUIRE(data);
        CHECK(data->data().energy == 2.0f);
        CHECK(data->data().dynamic_range == 8);
        const std::vector<int32_t> first = data->data().dynamic_data;
        REQUIRE(probe.bake().has_value());
        CHECK(probe.data() == data);
        CHECK(data->data().dynamic_data == first); // nothing changed: the same to the bit
    }

    TEST_CASE("extents that give no grid are an error and leave the data alone") {
        register_types();
        GIProbe probe;
        probe.set_extents({1.0f, 0.0f, 1.0f});
        const Expected<BakeFigures> refused = probe.bake();
        REQUIRE(!refused.has_value());
        CHECK(refused.error().code == ErrorCode::InvalidArgument);
        CHECK(!probe.data());
    }

    TEST_CASE("a bake that its progress cancels changes nothing") {
        register_types();
        Spatial scene;
        add_room(scene);
        auto& probe = scene.add_new<GIProbe>("Probe");
        probe.set_extents(glm::vec3(1.1f));
        CHECK(probe.set_subdiv(GIProbeSubdiv::Cells64) == SetResult::Done);
        const Expected<BakeFigures> cancelled = probe.bake(nullptr, [](float) { return false; });
        REQUIRE(!cancelled.has_value());
        CHECK(cancelled.error().code == ErrorCode::Cancelled);
        CHECK(!probe.data());
        float last = 0.0f;
        REQUIRE(probe
                    .bake(nullptr,
                          [&last](float share) {
                              CHECK(share >= last);
                              last = share;
                              return true;
                          })
                    .has_value());
        CHECK(last > 0.0f);
    }

    TEST_CASE("live parameters are written through to the data, the others are not, and assigning data "
              "pushes none") {
        register_types();
        GIProbe probe;
        auto data = make_ref<GIProbeData>();
        probe.set_energy(3.0f);
        probe.set_data(data);
        CHECK(data->data().energy == 1.0f);
        probe.set_energy(2.0f);
        probe.set_bias(1.0f);
        probe.set_normal_bias(0.5f);
        probe.set_propagation(0.25f);
        probe.set_interior(true);
        probe.set_compress(true);
        CHECK(probe.set_dynamic_range(9) == SetResult::Done);
        probe.set_extents(glm::vec3(2.0f));
        CHECK(data->data().energy == 2.0f);
        CHECK(data->data().bias_cells == 1.0f);
        CHECK(data->data().normal_bias_m == 0.5f);
        CHECK(data->data().propagation == 0.25f);
        CHECK(data->data().interior);
        CHECK(data->data().compress);
        CHECK(data->data().dynamic_range == 1);
        CHECK(data->data().bounds == AABB{{0, 0, 0}, {1, 1, 1}});
    }

    TEST_CASE("a copy of a probe has data of its own") {
        register_types();
        GIProbe probe;
        auto data = make_ref<GIProbeData>();
        data->set_energy(5.0f);
        probe.set_data(data);
        const std::unique_ptr<Node> copy = probe.duplicate();
        const auto* copied = dynamic_cast<GIProbe*>(copy.get());
        REQUIRE(copied != nullptr);
        REQUIRE(copied->data());
        CHECK(copied->data() != data);
        CHECK(copied->data()->data().energy == 5.0f);
        copied->data()->set_energy(1.0f);
        CHECK(data->data().energy == 5.0f);
    }
}
