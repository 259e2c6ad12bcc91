#pragma once

#include "scene/resources/environment.h"
#include "scene/resources/server_rid.h"

#include "core/object/object.h"
#include "core/ref.h"

#include <glm/vec2.hpp>

#include <memory>
#include <vector>

namespace cl {
class VisualServer;
}

namespace cl::scene {

class Camera;
class Spatial;
class WorldEnvironment;
struct ViewportOptions;

/// What the 3D nodes of one tree share: the scenario that they are drawn in, the viewport that shows it, the
/// current camera and the environment.
class World {
public:
    /// A world that nobody sees.
    World();
    World(VisualServer& server, const ViewportOptions& viewport);
    ~World();
    World(const World&) = delete;
    World& operator=(const World&) = delete;

    /// nullptr for a world that nobody sees.
    [[nodiscard]] VisualServer* server() const noexcept { return server_; }
    [[nodiscard]] RID scenario() const noexcept { return scenario_.get(); }
    [[nodiscard]] RID viewport() const noexcept { return viewport_.get(); }
    [[nodiscard]] glm::ivec2 viewport_size() const noexcept { return viewport_size_; }
    void set_viewport_size(glm::ivec2 size);

    /// The camera that the viewport shows: the one made current last, else the first that entered the tree;
    /// nullptr if there is none.
    [[nodiscard]] Camera* current_camera() const noexcept { return current_camera_; }
    /// `camera` must be inside the tree.
    void set_current_camera(Camera& camera);
    /// Camera node's own business: on entering and leaving the tree.
    void camera_entered(Camera& camera);
    void camera_exited(Camera& camera);

    /// The environment that is shown where the current camera has none: that of the WorldEnvironment that
    /// entered last and has one, else the fallback; null if there is none.
    [[nodiscard]] Ref<Environment> environment() const;
    /// The project's default environment.
    void set_fallback_environment(Ref<Environment> environment);
    /// WorldEnvironment node's own business: on entering, leaving, and another environment.
    void world_environment_entered(WorldEnvironment& node);
    void world_environment_exited(WorldEnvironment& node);
    void environment_changed();

    /// Has `node` told once of its new transform on the next flush_transforms().
    void queue_transform(Spatial& node);
    /// Sends TransformChanged to the nodes that moved. What moves meanwhile waits for the next flush.
    void flush_transforms();

private:
    VisualServer* server_ = nullptr;
    ServerRID scenario_;
    ServerRID viewport_;
    glm::ivec2 viewport_size_{1024, 600};
    std::vector<Camera*> cameras_; // inside the tree, in order of entering
    Camera* current_camera_ = nullptr;
    std::vector<WorldEnvironment*> world_environments_; // inside the tree, in order of entering
    Ref<Environment> fallback_environment_;
    std::vector<std::weak_ptr<Object*>> moved_;
};

} // namespace cl::scene
