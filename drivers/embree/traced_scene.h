#pragma once

#include "drivers/embree/camera_rays.h"
#include "drivers/embree/emitters.h"
#include "drivers/embree/environment.h"
#include "drivers/embree/lamp.h"
#include "drivers/embree/ray_scene.h"
#include "drivers/embree/traced_item.h"

#include "servers/rasterizer.h"

#include "core/expected.h"

#include <functional>
#include <memory>
#include <vector>

namespace cl::embree {

/// How a Frame's RIDs are followed to what the rasteriser holds.
struct SceneResources {
    std::function<std::shared_ptr<const TriangleSurface>(RID mesh, int surface)> surface; ///< null if stale
    Material::FindTexture texture;
    std::function<const SkyPanorama*(RID)> sky;
};

/// All that the paths of one picture need, made from a Frame that holds the whole scene. Does not move: its
/// parts point to each other.
class TracedScene {
public:
    [[nodiscard]] static Expected<std::unique_ptr<TracedScene>> build(const Frame& frame,
                                                                      const SceneResources& resources);
    ~TracedScene() = default;
    TracedScene(const TracedScene&) = delete;
    TracedScene& operator=(const TracedScene&) = delete;

    [[nodiscard]] const CameraRays& camera() const noexcept { return camera_; }
    [[nodiscard]] const RayScene& rays() const noexcept { return *rays_; }
    [[nodiscard]] const std::vector<TracedItem>& items() const noexcept { return items_; }
    [[nodiscard]] const std::vector<Lamp>& lamps() const noexcept { return lamps_; }
    [[nodiscard]] const Emitters& emitters() const noexcept { return emitters_; }
    [[nodiscard]] const Environment& environment() const noexcept { return environment_; }
    [[nodiscard]] int64_t triangle_count() const noexcept;

private:
    TracedScene(const Frame& frame, const SceneResources& resources, std::vector<TracedItem> items);

    CameraRays camera_;
    std::vector<TracedItem> items_;
    std::vector<Lamp> lamps_;
    Emitters emitters_;
    Environment environment_;
    std::unique_ptr<RayScene> rays_; ///< set by build()
};

} // namespace cl::embree
