#include "tests/scene/scene_fixture.h"

#include "scene/3d/mesh_instance.h"
#include "scene/resources/array_mesh.h"
#include "scene/resources/primitive_meshes.h"
#include "scene/resources/spatial_material.h"

#include <doctest/doctest.h>

using namespace cl;
using namespace cl::scene;
using cl::tests::register_types;

namespace {

/// A mesh of `surfaces` single triangles.
Ref<ArrayMesh> make_mesh(int surfaces) {
    auto mesh = make_ref<ArrayMesh>();
    SurfaceArrays triangle;
    triangle.positions = {{0, 0, 0}, {1, 0, 0}, {0, 1, 0}};
    for (int i = 0; i < surfaces; ++i) {
        REQUIRE(mesh->add_surface_from_arrays(triangle, PrimitiveType::Triangles).ok());
    }
    return mesh;
}

std::vector<std::string> stored_names(const Object& object) {
    std::vector<std::string> names;
    for (const Object::PropertyValue& p : object.stored_properties()) {
        names.push_back(p.name.str());
    }
    return names;
}

} // namespace

TEST_SUITE("scene/3d/mesh_instance") {
    TEST_CASE("material slots exist once the mesh is set, one a surface") {
        register_types();
        MeshInstance node;
        const auto material = make_ref<SpatialMaterial>();
        CHECK(node.set("material/0", material) == SetResult::Refused);
        CHECK(!node.has_property("material/0"));
        CHECK(node.extra_properties().empty()); // lost, as in Godot: not written back beside the real slot
        node.set_mesh(make_mesh(2));
        CHECK(node.set("material/1", material) == SetResult::Done);
        CHECK(node.set("material/2", material) == SetResult::Refused);
        CHECK(node.set("material/-1", material) == SetResult::UnknownProperty);
        CHECK(node.set("material/0", 5) == SetResult::WrongType);
        CHECK(node.get("material/0").is_nil());
        CHECK(node.get("material/1").to_object() == material.get());
        CHECK(node.set("material/1", Variant()) == SetResult::Done);
        CHECK(node.surface_material(1) == nullptr);
    }

    TEST_CASE("another mesh empties the slots") {
        register_types();
        MeshInstance node;
        node.set_mesh(make_mesh(1));
        CHECK(node.set_surface_material(0, make_ref<SpatialMaterial>()) == SetResult::Done);
        node.set_mesh(make_mesh(3));
        for (int i = 0; i < 3; ++i) {
            CHECK(node.surface_material(i) == nullptr);
        }
        CHECK(node.set_surface_material(3, nullptr) == SetResult::Refused);
        node.set_mesh(nullptr);
        CHECK(!node.has_property("material/0"));
    }

    TEST_CASE("slots are saved after the mesh, all of them, empty ones too") {
        register_types();
        MeshInstance node;
        node.set_use_in_baked_light(true);
        node.set_mesh(make_mesh(2));
        CHECK(stored_names(node) ==
              std::vector<std::string>{"use_in_baked_light", "mesh", "material/0", "material/1"});
    }

    TEST_CASE("slots follow a mesh that changes, and keep what still has a place") {
        register_types();
        MeshInstance node;
        const Ref<ArrayMesh> mesh = make_mesh(1);
        node.set_mesh(mesh);
        const auto material = make_ref<SpatialMaterial>();
        CHECK(node.set_surface_material(0, material) == SetResult::Done);
        SurfaceArrays triangle;
        triangle.positions = {{0, 0, 0}, {1, 0, 0}, {0, 1, 0}};
        REQUIRE(mesh->add_surface_from_arrays(triangle, PrimitiveType::Triangles).ok());
        CHECK(node.surface_material(0) == material);
        CHECK(node.set_surface_material(1, material) == SetResult::Done);
        mesh->clear_surfaces();
        CHECK(!node.has_property("material/0"));
    }

    TEST_CASE("a surface is drawn with the override, else its slot, else the mesh's own material") {
        register_types();
        MeshInstance node;
        const auto own = make_ref<SpatialMaterial>();
        const auto slot = make_ref<SpatialMaterial>();
        const auto over = make_ref<SpatialMaterial>();
        auto cube = make_ref<CubeMesh>();
        CHECK(node.active_material(0) == nullptr);
        node.set_mesh(cube);
        CHECK(node.active_material(0) == nullptr);
        cube->set_material(own);
        CHECK(node.active_material(0) == own);
        CHECK(node.set_surface_material(0, slot) == SetResult::Done);
        CHECK(node.active_material(0) == slot);
        node.set_material_override(over);
        CHECK(node.active_material(0) == over);
    }
}
