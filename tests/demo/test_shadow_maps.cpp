#include "demo/offscreen_server.h"

#include "scene/3d/camera.h"
#include "scene/3d/directional_light.h"
#include "scene/3d/mesh_instance.h"
#include "scene/3d/omni_light.h"
#include "scene/3d/spot_light.h"
#include "scene/3d/world.h"
#include "scene/main/scene_tree.h"
#include "scene/register_types.h"
#include "scene/resources/primitive_meshes.h"

#include "core/image.h"
#include "core/object/class_registry.h"

#include <doctest/doctest.h>
#include <glm/gtc/matrix_transform.hpp>
#include <glm/trigonometric.hpp>

#include <algorithm>
#include <cmath>
#include <utility>
#include <vector>

// GIMode::Auto without a probe: what its shadow maps do, on pictures.
namespace {

using namespace cl;

enum class Lamp { Sun, Omni, Spot };
constexpr Lamp kLamps[] = {Lamp::Sun, Lamp::Omni, Lamp::Spot};

Transform looking(const glm::vec3& eye_m, const glm::vec3& target_m) {
    const glm::mat4 m = glm::inverse(glm::lookAt(eye_m, target_m, glm::vec3(0.1f, 1.0f, 0.2f)));
    return {glm::mat3(m), glm::vec3(m[3])};
}

/// Boxes and a lamp; every length times `scale`.
class Set {
public:
    Set(std::unique_ptr<VisualServer> server, float scale) : tree_(std::move(server), {.size = {96, 54}}) {
        root_ = std::make_unique<scene::Spatial>();
        scale_ = scale;
    }
    void box(const glm::vec3& center_m, const glm::vec3& size_m) {
        auto& node = root_->add_new<scene::MeshInstance>("Box");
        node.set_mesh(make_ref<scene::CubeMesh>(scene::CubeShape{.size = size_m * scale_}));
        node.set_translation(center_m * scale_);
    }
    /// A room about the origin, without a gap.
    void room(float half_m, float thick_m) {
        for (int axis = 0; axis < 3; ++axis) {
            for (const float side : {-1.0f, 1.0f}) {
                glm::vec3 center(0.0f);
                glm::vec3 size(2.0f * (half_m + thick_m));
                center[axis] = side * (half_m + 0.5f * thick_m);
                size[axis] = thick_m;
                box(center, size);
            }
        }
    }
    void camera(const glm::vec3& eye_m, const glm::vec3& target_m) {
        auto& node = root_->add_new<scene::Camera>("Camera");
        node.set_transform(looking(eye_m * scale_, target_m * scale_));
        node.set_near(0.05f * scale_);
        node.set_far(100.0f * scale_);
    }
    void lamp(Lamp kind, const glm::vec3& from_m) {
        if (kind == Lamp::Sun) {
            lamp_ = &root_->add_new<scene::DirectionalLight>("Lamp");
        } else if (kind == Lamp::Omni) {
            lamp_ = &root_->add_new<scene::OmniLight>("Lamp");
        } else {
            lamp_ = &root_->add_new<scene::SpotLight>("Lamp");
        }
        aim(from_m, glm::vec3(0.0f));
        cast(true);
    }
    void aim(const glm::vec3& from_m, const glm::vec3& target_m) {
        lamp_->set_transform(looking(from_m * scale_, target_m * scale_));
    }
    void set_mode(GIMode mode) {
        tree_.server()->set_settings({.gi_mode = mode, .clear_color = {0, 0, 0, 1}});
    }
    void cast(bool shadow) {
        lamp_->edit([&](LightDesc& d) {
            d.shadow = shadow;
            d.range_m = 8.0f * scale_;
            d.directional_max_distance_m = 100.0f * scale_;
        });
    }
    std::vector<uint8_t> picture() {
        if (root_) {
            REQUIRE(tree_.set_scene(std::move(root_)).ok());
        }
        tree_.step(1.0 / 60.0);
        REQUIRE(tree_.draw_settled().ok());
        const Expected<Image> image =
            tree_.server()->viewport_read(tree_.world().viewport(), TargetFormat::Srgb8);
        REQUIRE(image.has_value());
        return image->data;
    }

private:
    std::unique_ptr<scene::Spatial> root_; ///< until the first picture
    scene::Light* lamp_ = nullptr;
    float scale_ = 1.0f;
    scene::SceneTree tree_;
};

/// Runs `body(Set&)`, or says why not.
template <typename Body>
void on_set(float scale, int shadow_filter, const Body& body) {
    scene::register_scene_types(ClassRegistry::instance());
    Expected<std::unique_ptr<VisualServer>> server = demo::make_offscreen_server();
    if (!server) {
        MESSAGE("skipped: " << server.error().to_string());
        return;
    }
    CAPTURE(scale);
    CAPTURE(shadow_filter);
    server->get()->set_settings(
        {.gi_mode = GIMode::Auto, .clear_color = {0, 0, 0, 1}, .shadow_filter = shadow_filter});
    Set set(std::move(*server), scale);
    body(set);
}

/// Runs `body(Set&, lamp)` for all lamps and sizes.
template <typename Body>
void on_each_set(const Body& body) {
    for (const float scale : {0.1f, 1.0f, 10.0f}) {
        for (const Lamp lamp : kLamps) {
            CAPTURE(static_cast<int>(lamp));
            on_set(scale, 1, [&](Set& set) { body(set, lamp); });
        }
    }
}

/// Largest colour of a picture.
int brightest(const std::vector<uint8_t>& picture) {
    int most = 0;
    for (size_t i = 0; i < picture.size(); ++i) {
        most = std::max(most, i % 4 == 3 ? 0 : static_cast<int>(picture[i]));
    }
    return most;
}

/// What an omni looks at, which turns its map: sides, edges and corners of the cube of its faces fall
/// everywhere.
const glm::vec3 kAims[] = {{0, 0, 0},           {1, -0.2f, 0.4f},      {-0.5f, 0.3f, 0.2f},
                           {0.3f, 0.9f, -0.7f}, {-0.4f, -0.6f, -0.4f}, {0.1f, -0.3f, 0.9f}};

} // namespace

TEST_SUITE("demo/shadow_maps") {
    TEST_CASE("[gl] a flat surface does not shade itself, however the light falls on it") {
        on_each_set([](Set& set, Lamp lamp) {
            set.box({0, -0.1f, 0}, {6, 0.2f, 6});
            set.camera({1.5f, 3, 2}, {0, 0, 0});
            const float tilt = glm::radians(70.0f);
            set.lamp(lamp, 2.0f * glm::vec3(std::sin(tilt), std::cos(tilt), 0.3f));
            const std::vector<uint8_t> with_shadow = set.picture();
            set.cast(false);
            CHECK(set.picture() == with_shadow);
            CHECK(*std::max_element(with_shadow.begin(), with_shadow.end()) > 40);
        });
    }

    TEST_CASE("[gl] a room of walls that are thin to its shadow map stays dark") {
        on_each_set([](Set& set, Lamp lamp) {
            set.room(1.0f, 0.02f);
            set.box({0, -1.5f, 0}, {6, 0.2f, 6});
            set.camera({0.8f, 0.6f, 0.8f}, {-0.5f, -0.8f, -0.5f});
            set.lamp(lamp, {0.9f, 2.2f, 0.5f});
            CHECK(brightest(set.picture()) == 0);
        });
    }

    TEST_CASE("[gl] what an omni reaches is lit as without shadows, across all faces of its map") {
        for (const float scale : {0.01f, 1.0f, 100.0f}) {
            for (const int filter : {0, 1, 2}) {
                on_set(scale, filter, [](Set& set) {
                    const glm::vec3 kFrom_m{0.1f, 0.4f, 0.0f}; // near: four faces and more see the plane
                    set.box({0, -0.1f, 0}, {16, 0.2f, 16});
                    set.camera({0.3f, 5, 0.2f}, {0, 0, 0});
                    set.lamp(Lamp::Omni, kFrom_m);
                    set.cast(false);
                    const std::vector<uint8_t> without_shadow = set.picture();
                    set.cast(true);
                    for (const glm::vec3& aim_m : kAims) {
                        set.aim(kFrom_m, aim_m);
                        CHECK(set.picture() == without_shadow);
                    }
                    CHECK(brightest(without_shadow) > 40);
                });
            }
        }
    }

    TEST_CASE("[gl] an omni in a case of thin walls lights nothing around it") {
        for (const float scale : {0.1f, 1.0f, 10.0f}) {
            on_set(scale, 1, [](Set& set) {
                const glm::vec3 kFrom_m{0.02f, 0.05f, -0.03f};
                set.room(0.2f, 0.01f);
                set.room(1.0f, 0.1f);
                set.camera({0.9f, 0.8f, 0.9f}, {0, 0, 0});
                set.lamp(Lamp::Omni, kFrom_m);
                for (const glm::vec3& aim_m : kAims) {
                    set.aim(kFrom_m, aim_m);
                    CHECK(brightest(set.picture()) == 0);
                }
                set.cast(false);
                CHECK(brightest(set.picture()) > 40);
            });
        }
    }

    TEST_CASE("[gl] an omni's map is drawn anew for another mode of global illumination") {
        on_set(1.0f, 1, [](Set& set) {
            set.box({0, -0.1f, 0}, {6, 0.2f, 6});
            set.box({0, 0.5f, 0}, {0.5f, 0.5f, 0.5f});
            set.camera({1.5f, 3, 2}, {0, 0, 0});
            set.lamp(Lamp::Omni, {0.4f, 2, 0.2f});
            const std::vector<uint8_t> in_auto = set.picture();
            set.set_mode(GIMode::Off);
            const std::vector<uint8_t> off = set.picture();
            set.set_mode(GIMode::Auto);
            CHECK(set.picture() == in_auto);
            set.set_mode(GIMode::Off);
            CHECK(set.picture() == off);
            set.cast(false);
            CHECK(set.picture() != off);
        });
    }
}
