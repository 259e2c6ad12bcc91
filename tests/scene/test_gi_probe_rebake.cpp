#include "tests/scene/scene_fixture.h"

#include "scene/3d/gi_probe.h"
#include "scene/3d/mesh_instance.h"
#include "scene/resources/array_mesh.h"
#include "scene/resources/primitive_meshes.h"
#include "scene/resources/spatial_material.h"
#include "scene/resources/texture.h"

#include "core/threads.h"

#include <doctest/doctest.h>

#include <memory>
#include <random>
#include <string>
#include <utility>
#include <vector>

using namespace cl;
using namespace cl::scene;
using cl::tests::register_types;

namespace {

std::shared_ptr<const Image> noise(uint32_t seed) {
    std::mt19937 random(seed);
    auto image = std::make_shared<Image>(Image{.size = {16, 16}, .format = PixelFormat::RGB8, .data = {}});
    for (int i = 0; i < 16 * 16 * 3; ++i) {
        image->data.push_back(uint8_t(random()));
    }
    return image;
}

/// Boxes and a ball around the middle, one with a texture, and a probe.
class Room {
public:
    Room() {
        register_types();
        texture->set_image(noise(1));
        for (int i = 0; i < 6; ++i) {
            material.push_back(make_ref<SpatialMaterial>());
            auto& node = scene.add_new<MeshInstance>("Thing" + std::to_string(i));
            node.set_use_in_baked_light(true);
            node.set_mesh(i == 0 ? Ref<Mesh>(make_ref<SphereMesh>()) : Ref<Mesh>(make_ref<CubeMesh>()));
            node.set_scale(glm::vec3(0.3f));
            node.set_translation({0.25f * float(i) - 0.7f, 0.1f * float(i * i % 5), 0.6f - 0.2f * float(i)});
            REQUIRE(node.set_surface_material(0, material.back()) == SetResult::Done);
            thing.push_back(&node);
        }
        material[1]->set_texture(TextureSlot::Albedo, texture);
        probe->set_extents(glm::vec3(1.2f));
        REQUIRE(probe->set_subdiv(GIProbeSubdiv::Cells64) == SetResult::Done);
    }

    void paint(size_t number, const Color& albedo) const {
        SpatialParams params = material[number]->params();
        params.albedo = albedo;
        material[number]->set_params(params);
    }

    /// Bakes again, and with a probe that never baked. @return whether the results are the same.
    [[nodiscard]] bool agrees() {
        const Expected<BakeFigures> again = probe->bake();
        const std::unique_ptr<Node> copy = probe->duplicate();
        auto* fresh = dynamic_cast<GIProbe*>(copy.get());
        fresh->set_data({});
        const Expected<BakeFigures> whole = fresh->bake(&scene, {}, BakeFor::Once);
        REQUIRE((again.has_value() && whole.has_value()));
        CHECK(again->cells == whole->cells);
        CHECK(again->leaves == whole->leaves);
        CHECK(again->triangles == whole->triangles);
        CHECK(again->meshes == whole->meshes);
        return cells() == fresh->data()->data().dynamic_data;
    }
    [[nodiscard]] const std::vector<int32_t>& cells() const { return probe->data()->data().dynamic_data; }

    Spatial scene;
    GIProbe* probe = &scene.add_new<GIProbe>("Probe");
    std::vector<MeshInstance*> thing;
    std::vector<Ref<SpatialMaterial>> material;
    Ref<ImageTexture> texture = make_ref<ImageTexture>();
};

} // namespace

TEST_SUITE("scene/3d/gi_probe_rebake") {
    TEST_CASE("a probe that bakes again gets what a new one gets, whatever was edited") {
        for (const int threads : {1, 3}) {
            set_thread_count(threads);
            Room room;
            REQUIRE(room.agrees());
            auto changes = [&room, before = room.cells()]() mutable {
                REQUIRE(room.agrees());
                return before != std::exchange(before, room.cells());
            };
            CHECK_FALSE(changes());
            room.thing[2]->set_translation({0.5f, -0.6f, 0.1f});
            CHECK(changes());
            room.thing[0]->set_rotation_degrees({10, 20, 30});
            CHECK(changes());
            room.paint(3, {0.9f, 0.1f, 0.2f, 1.0f});
            CHECK(changes());
            room.texture->set_image(noise(2));
            CHECK(changes());
            room.texture->set_image(noise(2)); // another object with the same pixels
            CHECK_FALSE(changes());
            REQUIRE(room.thing[1]->set_surface_material(0, nullptr) == SetResult::Done);
            CHECK(changes());
            REQUIRE(room.thing[4]->mesh()->set("size", glm::vec3(3, 1, 1)) == SetResult::Done); // in place
            CHECK(changes());
            room.thing[5]->set_visible(false);
            CHECK(changes());
            room.thing[5]->set_visible(true);
            CHECK(changes());
            room.probe->set_rotation_degrees({0, 30, 0});
            CHECK(changes());
            room.probe->set_extents({1.2f, 0.7f, 1.0f});
            CHECK(changes());
            REQUIRE(room.probe->set_subdiv(GIProbeSubdiv::Cells128) == SetResult::Done);
            CHECK(changes());
        }
        set_thread_count(0);
    }

    TEST_CASE("cells that did not come from the last bake are not taken over") {
        Room room;
        REQUIRE(room.agrees());
        const Ref<GIProbeData> first = room.probe->data();
        const std::vector<int32_t> cells = room.cells();
        std::vector<int32_t> other = cells;
        other.back() ^= 1; // of the last leaf: still valid
        REQUIRE(first->set("dynamic_data", PoolIntArray(other)) == SetResult::Done);
        CHECK(room.agrees());
        auto second = make_ref<GIProbeData>();
        REQUIRE(second->set("dynamic_data", PoolIntArray(other)) == SetResult::Done);
        room.probe->set_data(second);
        CHECK(room.agrees());
        room.probe->set_data(nullptr);
        CHECK(room.agrees());
        CHECK(room.cells() == cells);
    }

    TEST_CASE("a damaged surface stays out of every bake") {
        Room room;
        class Damaged final : public Mesh {
        public:
            Damaged() {
                SurfaceArrays arrays;
                arrays.positions = {{0, 0, 0}, {1, 0, 0}, {0, 1, 0}};
                surface_ = *encode_surface(arrays, PrimitiveType::Triangles);
                surface_.vertices.pop_back();
            }
            std::span<const MeshSurface> surfaces() const override { return std::span(&surface_, 1); }
            Ref<Material> surface_material(int) const override { return nullptr; }

        private:
            MeshSurface surface_;
        };
        auto& node = room.scene.add_new<MeshInstance>("Damaged");
        node.set_mesh(make_ref<Damaged>());
        node.set_use_in_baked_light(true);
        CHECK(room.agrees());
        room.thing[0]->set_translation({0, 0, 0});
        CHECK(room.agrees());
    }

    TEST_CASE("a cancelled bake leaves data and memory to go on from") {
        Room room;
        REQUIRE(room.agrees());
        const std::vector<int32_t> cells = room.cells();
        room.thing[3]->set_translation({0, 0.5f, 0});
        const auto cancelled = room.probe->bake(nullptr, [](float share) { return share == 0.0f; });
        REQUIRE(!cancelled.has_value());
        CHECK(cancelled.error().code == ErrorCode::Cancelled);
        CHECK(room.cells() == cells);
        CHECK(room.agrees());
    }
}
