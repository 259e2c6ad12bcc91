#include "demo/cli/scene_camera.h"

#include "scene/3d/camera.h"
#include "scene/3d/mesh_instance.h"
#include "scene/3d/world.h"

#include <fmt/format.h>
#include <glm/geometric.hpp>
#include <glm/trigonometric.hpp>

#include <cmath>
#include <optional>

namespace cl::demo {

namespace {

/// Box around everything visible, in world space [m].
std::optional<AABB> visible_bounds(scene::Node& root) {
    std::optional<AABB> bounds;
    root.for_each_in_subtree([&bounds](scene::Node& node) {
        const auto* instance = dynamic_cast<scene::MeshInstance*>(&node);
        if (instance && instance->mesh() && instance->is_visible_in_tree()) {
            const AABB box = transformed(instance->global_transform(), instance->mesh()->aabb());
            bounds = bounds ? bounds->merged(box) : box;
        }
    });
    return bounds;
}

/// A camera that has the whole scene in view, from the front, a little above and to the right.
void add_framing_camera(scene::Node& root) {
    const AABB bounds = visible_bounds(root).value_or(AABB{glm::vec3(-1.0f), glm::vec3(2.0f)});
    auto& camera = root.add_new<scene::Camera>("FramingCamera");
    const float radius_m = std::max(0.5f * glm::length(bounds.size), 1e-3f);
    const float distance_m = radius_m / std::sin(0.5f * glm::radians(camera.fov()));
    camera.set_near(0.01f * radius_m);
    camera.set_far(distance_m + 2.0f * radius_m);
    camera.set_translation(bounds.center() + glm::normalize(glm::vec3(0.5f, 0.35f, 1.0f)) * distance_m);
    camera.look_at(bounds.center());
    camera.make_current();
}

} // namespace

Status choose_camera(scene::SceneTree& tree, scene::Node& root, const Options& options) {
    if (!options.camera_path.empty()) {
        auto* camera = root.get_node_as<scene::Camera>(options.camera_path);
        if (!camera) {
            return Error{ErrorCode::NotFound, fmt::format("--camera: expected the path of a Camera, found {}",
                                                          options.camera_path)};
        }
        camera->make_current();
    }
    if (!tree.world().current_camera()) {
        add_framing_camera(root);
    }
    return {};
}

} // namespace cl::demo
