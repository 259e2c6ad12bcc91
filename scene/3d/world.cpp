#include "scene/3d/world.h"

#include "scene/3d/camera.h"
#include "scene/3d/spatial.h"
#include "scene/3d/world_environment.h"
#include "scene/main/scene_tree.h"

#include "servers/visual_server.h"

#include "core/io/log.h"

#include <algorithm>
#include <utility>

namespace cl::scene {

World::World() = default;

World::World(VisualServer& server, const ViewportOptions& viewport)
    : server_(&server), viewport_size_(viewport.size) {
    scenario_.adopt(server, server.scenario_create());
    viewport_.adopt(server, server.viewport_create(viewport.size, viewport.to_window));
    static_cast<void>(server.viewport_set_scenario(viewport_.get(), scenario_.get()));
}

World::~World() = default;

void World::set_viewport_size(glm::ivec2 size) {
    viewport_size_ = size;
    if (server_) {
        static_cast<void>(server_->viewport_set_size(viewport_.get(), size));
    }
}

void World::set_current_camera(Camera& camera) {
    current_camera_ = &camera;
    if (server_) {
        static_cast<void>(server_->viewport_set_camera(viewport_.get(), camera.camera_rid()));
    }
}

void World::camera_entered(Camera& camera) {
    cameras_.push_back(&camera);
    if (!current_camera_ || camera.wants_current()) {
        set_current_camera(camera);
    }
}

void World::camera_exited(Camera& camera) {
    cameras_.erase(std::remove(cameras_.begin(), cameras_.end(), &camera), cameras_.end());
    if (current_camera_ != &camera) {
        return;
    }
    current_camera_ = nullptr;
    if (!cameras_.empty()) {
        set_current_camera(*cameras_.front());
    } else if (server_) {
        static_cast<void>(server_->viewport_set_camera(viewport_.get(), RID{}));
    }
}

Ref<Environment> World::environment() const {
    const auto has_one = [](const WorldEnvironment* node) { return node->environment() != nullptr; };
    const auto last = std::find_if(world_environments_.rbegin(), world_environments_.rend(), has_one);
    return last != world_environments_.rend() ? (*last)->environment() : fallback_environment_;
}

void World::set_fallback_environment(Ref<Environment> environment) {
    fallback_environment_ = std::move(environment);
    environment_changed();
}

void World::world_environment_entered(WorldEnvironment& node) {
    if (!world_environments_.empty()) {
        log_warning("a second WorldEnvironment '" + node.path().to_string() + "' overrides '" +
                    world_environments_.back()->path().to_string() + "'");
    }
    world_environments_.push_back(&node);
    environment_changed();
}

void World::world_environment_exited(WorldEnvironment& node) {
    world_environments_.erase(std::remove(world_environments_.begin(), world_environments_.end(), &node),
                              world_environments_.end());
    environment_changed();
}

void World::environment_changed() {
    if (server_) {
        const Ref<Environment> shown = environment();
        static_cast<void>(
            server_->scenario_set_environment(scenario_.get(), shown ? shown->rid(*server_) : RID{}));
    }
}

void World::queue_transform(Spatial& node) {
    moved_.push_back(node.handle());
}

void World::flush_transforms() {
    for (const std::weak_ptr<Object*>& handle : std::exchange(moved_, {})) {
        const std::shared_ptr<Object*> object = handle.lock();
        Spatial* node = object ? dynamic_cast<Spatial*>(*object) : nullptr;
        if (node && node->is_inside_tree() && &node->tree()->world() == this) {
            node->tell_transform_changed();
        }
    }
}

} // namespace cl::scene
