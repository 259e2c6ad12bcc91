#include "drivers/embree/traced_scene.h"

#include <utility>

namespace cl::embree {

TracedScene::TracedScene(const Frame& frame, const SceneResources& resources, std::vector<TracedItem> items)
    : camera_(frame), items_(std::move(items)), lamps_(frame.lights.begin(), frame.lights.end()),
      emitters_(items_),
      environment_(frame, frame.has_environment ? resources.sky(frame.environment.sky) : nullptr) {}

Expected<std::unique_ptr<TracedScene>> TracedScene::build(const Frame& frame,
                                                          const SceneResources& resources) {
    std::vector<TracedItem> items;
    items.reserve(frame.world.size());
    for (const WorldItem& item : frame.world) {
        std::shared_ptr<const TriangleSurface> surface = resources.surface(item.mesh, item.surface);
        if (!surface) {
            return Error{ErrorCode::InvalidArgument, "draw: expected a live mesh in each item", {}};
        }
        items.emplace_back(item, std::move(surface), resources.texture);
    }
    std::unique_ptr<TracedScene> scene(new TracedScene(frame, resources, std::move(items)));
    Expected<RayScene> rays = RayScene::build(scene->items_, frame.camera.cull_mask);
    if (!rays) {
        return rays.error();
    }
    scene->rays_ = std::make_unique<RayScene>(std::move(*rays));
    return scene;
}

int64_t TracedScene::triangle_count() const noexcept {
    int64_t count = 0;
    for (const TracedItem& item : items_) {
        count += static_cast<int64_t>(item.surface->triangles.size());
    }
    return count;
}

} // namespace cl::embree
